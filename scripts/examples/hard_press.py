#!/usr/bin/env python3
"""A box of disks under a lid that a force presses: prints what floor, sides and lid bear.

soft_press.py and hard_press.py are twins: an ordinary YADE script with springs at the contacts, and the same with Contact Dynamics.
They differ between the lines "# [" and "# ]" only: in the numerics, the material, the functors and the engines.
Parameters come from a table (yade-batch), or are those below.
"""
import os, sys
if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), "--threads", "1", *sys.argv[1:]])

import math
import random

from yade import utils
from yade.nonsmooth import parameters
from yade.nonsmooth.scene import disk, segments

# [ numerics
numerics = dict(dt=1e-3, tolerance=1e-5)
# ]
# friction of the disks, pressure on the lid [Pa], seconds
utils.readParamsFromTable(friction=0.3, pressure=2e5, seconds=2, **numerics)
from yade.params import table

parameters.positive(table, "pressure", "seconds", "dt")
parameters.not_negative(table, "friction")

WIDTH = 1.5

# [ material
rock = NscdMat(density=2500, frictionAngle=math.atan(table.friction))
joint = NscdMat(frictionAngle=0, wall=True)
# ]
O.materials.append((rock, joint))

# floor, sides and lid without friction; each acts to the left of its direction
floor, = O.bodies.append(segments([(-1, 0), (WIDTH + 1, 0)], joint, sense=1))
right, = O.bodies.append(segments([(WIDTH, -1), (WIDTH, 6)], joint, sense=1))
left, = O.bodies.append(segments([(0, 6), (0, -1)], joint, sense=1))
lid, = O.bodies.append(segments([(WIDTH + 1, 2.0), (-1, 2.0)], joint, sense=1))
# The lid follows the force on it: no servo has to read what it bears. It has a mass, and may move up and down.
O.bodies[lid].state.mass = 200
O.bodies[lid].state.blockedDOFs = "xzXYZ"

dice = random.Random(1)
disks = []
for row in range(16):
    for column in range(12):
        radius = dice.uniform(0.04, 0.06)
        disks.append(O.bodies.append(disk((0.07 + 0.123 * column + dice.uniform(0, 0.005), 0.07 + 0.123 * row), radius, rock)))

# [ functors, engines, time step
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.05), Bo1_Segment_Aabb()], verletDist=0.01),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1.05), Ig2_Segment_Sphere_ScGeom(interactionDetectionFactor=1.05)],
        [Ip2_NscdMat_NscdMat_NscdPhys()],
        [Law2_ScGeom_NscdPhys_SignoriniCoulomb()]),
    ContactDynamicsEngine(tolerance=table.tolerance),
    NewtonIntegrator(damping=0, gravity=(0, -9.81, 0)),
]
# ]
O.dt = table.dt

for k in range(1, 21):  # all at once it would throw the lid onto the disks
    O.forces.setPermF(lid, (0, -table.pressure * WIDTH * k / 20, 0))
    O.run(max(1, round(0.05 / O.dt)), wait=True)
O.run(max(1, round(table.seconds / O.dt)), wait=True)

# forces of the last step: they stand in O.forces after the solver (or the law), until the next step begins
weight = 9.81 * sum(O.bodies[i].state.mass for i in disks)
height = O.bodies[lid].state.pos[1]
print(f"steps {O.iter}")
print(f"height under the lid [m] {height:.4f}")
print(f"load on the lid [N] {table.pressure * WIDTH + 9.81 * O.bodies[lid].state.mass:.1f}")
print(f"floor [N] {-O.forces.f(floor)[1]:.1f}")
print(f"weight of the disks [N] {weight:.1f}")
print(f"sides over lid [-] {0.5 * (O.forces.f(right)[0] - O.forces.f(left)[0]) / height / table.pressure:.3f}")
utils.waitIfBatch()
