#!/usr/bin/env python3
"""Blocks on an incline: prints how far and how fast each has slid, beside Coulomb's a = g (sin θ − μ cos θ).

soft_incline.py and hard_incline.py are twins: an ordinary YADE script with springs at the contacts, and the same with Contact Dynamics.
They differ between the lines "# [" and "# ]" only. A block is a disk that may not turn; each has a friction of its own.
Parameters come from a table (yade-batch), or are those below.
"""
import os, sys
if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), "--threads", "1", *sys.argv[1:]])

import math

from yade import utils
from yade.nonsmooth import parameters
from yade.nonsmooth.scene import disk, segments

# [ numerics
numerics = dict(dt=2e-4, young=1e8, damping=0.2)
# ]
# slope [°] of the incline, seconds
utils.readParamsFromTable(slope=25, seconds=2, **numerics)
from yade.params import table

parameters.positive(table, "seconds", "dt")
parameters.within(table, 0, 89, "slope")

RADIUS, G = 0.5, 9.81
ANGLE = math.radians(table.slope)
RATIOS = (0, 0.5, 0.9, 0.99, 1.01, 1.1)  # friction of the blocks, in units of tan θ

# [ material
def material(friction):
    return FrictMat(density=2500, young=table.young, poisson=0.3, frictionAngle=math.atan(friction))
# ]

along, up = (math.cos(ANGLE), -math.sin(ANGLE)), (math.sin(ANGLE), math.cos(ANGLE))
blocks = []
for k, ratio in enumerate(RATIOS):  # one incline each, one above the other: the lanes lie 1.6 m apart
    stuff = material(ratio * math.tan(ANGLE))
    O.materials.append(stuff)
    x, y = 1.6 * k * up[0], 1.6 * k * up[1]
    O.bodies.append(segments([(x - 2 * along[0], y - 2 * along[1]), (x + 50 * along[0], y + 50 * along[1])], stuff, piece=4, sense=1))
    body = disk((x + RADIUS * up[0], y + RADIUS * up[1]), RADIUS, stuff)
    body.state.blockedDOFs = "zXYZ"
    blocks.append(O.bodies.append(body))

# [ functors, engines, time step
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Segment_Aabb()], verletDist=0.2),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Segment_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_FrictPhys()],
        [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(damping=table.damping, gravity=(0, -G, 0)),
]
# ]
O.dt = table.dt
start = [O.bodies[i].state.pos for i in blocks]
O.run(max(1, round(table.seconds / O.dt)), wait=True)

print("friction/tan(slope)   slid [m]   speed [m/s]   acceleration [m/s2]   Coulomb's")
for i, p, ratio in zip(blocks, start, RATIOS):
    s = O.bodies[i].state
    slid, speed = (v[0] * along[0] + v[1] * along[1] for v in (s.pos - p, s.vel))
    print("%18.2f %11.6f %13.6f %21.4f %11.4f" % (ratio, slid, speed, speed / O.time, G * math.sin(ANGLE) * max(0, 1 - ratio)))
print(f"steps {O.iter}")
utils.waitIfBatch()
