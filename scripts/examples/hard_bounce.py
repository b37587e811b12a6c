#!/usr/bin/env python3
"""A disk falls onto another one: prints how high it bounces.

soft_bounce.py and hard_bounce.py are twins: an ordinary YADE script with springs at the contacts, and the same with Contact Dynamics.
They differ between the lines "# [" and "# ]" only: in the numerics, the material, the functors and the engines.
Parameters come from a table (yade-batch), or are those below.
"""
import os, sys
if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), "--threads", "1", *sys.argv[1:]])

import math

from yade import utils
from yade.nonsmooth import parameters
from yade.nonsmooth.scene import disk

# [ numerics
numerics = dict(dt=1e-3, tolerance=1e-5)
# ]
# clear height of the fall [m], bounces to wait for
utils.readParamsFromTable(height=1.0, bounces=3, **numerics)
from yade.params import table

parameters.positive(table, "height", "dt")
parameters.whole(table, "bounces")

# [ material
rock = NscdMat(density=2500, frictionAngle=math.atan(0.3), restitution=0.9)
# ]
O.materials.append(rock)

# one disk is held, the other one falls onto it
O.bodies.append(disk((0, 0), 0.5, rock, fixed=True))
ball = O.bodies[O.bodies.append(disk((0, 1 + table.height), 0.5, rock))]

# [ functors, engines, time step
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.05)], verletDist=0.05),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1.05)],
        [Ip2_NscdMat_NscdMat_NscdPhys()],
        [Law2_ScGeom_NscdPhys_SignoriniCoulomb()]),
    ContactDynamicsEngine(tolerance=table.tolerance),
    NewtonIntegrator(damping=0, gravity=(0, -9.81, 0)),
]
# ]
O.dt = table.dt

heights, upwards = [], False
longest = 100 * math.sqrt(2 * table.height / 9.81)  # in units of the fall: a disk that has come to rest bounces no more
while len(heights) < table.bounces and O.time < longest:
    O.step()
    if upwards and ball.state.vel[1] <= 0:  # the highest point of a bounce
        heights.append(ball.state.pos[1] - 1)
    upwards = ball.state.vel[1] > 0

print(f"steps {O.iter}")
for number, height in enumerate(heights, 1):
    print(f"height of bounce {number} [of the height before] {height / ([table.height] + heights)[number - 1]:.4f}")
if len(heights) < table.bounces:
    print("it bounces no more")
utils.waitIfBatch()
