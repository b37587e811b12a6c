#!/usr/bin/env python3
"""A direct shear box: the upper half is pulled along under a constant normal load; prints the shear stress on the way.

soft_shear.py and hard_shear.py are twins: an ordinary YADE script with springs at the contacts, and the same with Contact Dynamics.
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
numerics = dict(dt=1e-3, tolerance=1e-4)
# ]
# friction of the disks, normal stress [Pa], speed of the upper half [m/s], its way [m]
utils.readParamsFromTable(friction=0.5, pressure=1e5, speed=0.1, way=0.3, **numerics)
from yade.params import table

parameters.positive(table, "pressure", "speed", "way", "dt")
parameters.not_negative(table, "friction")

WIDTH, HALF = 3.0, 0.6

# [ material
rock = NscdMat(density=2500, frictionAngle=math.atan(table.friction))
# ]
O.materials.append(rock)

# Each wall acts to the left of its direction; a ledge closes each half where the other one leaves it. The upper half is pulled, and the lid sinks and rises
# under its load.
lower = O.bodies.append(segments([(0, HALF), (0, 0), (WIDTH, 0), (WIDTH, HALF), (WIDTH + 1, HALF)], rock, sense=1))
upper = O.bodies.append(segments([(WIDTH, HALF), (WIDTH, 3)], rock, sense=1)) + O.bodies.append(segments([(0, 3), (0, HALF), (-1, HALF)], rock, sense=1))
lid, = O.bodies.append(segments([(WIDTH + 1, 2.0), (-1, 2.0)], rock, sense=1))
O.bodies[lid].state.mass = 2000
O.bodies[lid].state.blockedDOFs = "xzXYZ"

dice = random.Random(1)
for row in range(16):
    for column in range(24):
        O.bodies.append(disk((0.07 + 0.123 * column + dice.uniform(0, 0.005), 0.07 + 0.123 * row), dice.uniform(0.04, 0.06), rock))

# [ functors, engines, time step
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.05), Bo1_Segment_Aabb()], verletDist=0.01),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1.05), Ig2_Segment_Sphere_ScGeom(interactionDetectionFactor=1.05)],
        [Ip2_NscdMat_NscdMat_NscdPhys()],
        [Law2_ScGeom_NscdPhys_SignoriniCoulomb()]),
    ContactDynamicsEngine(tolerance=table.tolerance),
    NewtonIntegrator(damping=0, gravity=(0, 0, 0)),
]
# ]
O.dt = table.dt

for k in range(1, 21):  # the load grows, and presses the disks together
    O.forces.setPermF(lid, (0, -table.pressure * WIDTH * k / 20, 0))
    O.run(max(1, round(0.05 / O.dt)), wait=True)
O.run(max(1, round(0.5 / O.dt)), wait=True)
print(f"height under the lid [m] {O.bodies[lid].state.pos[1]:.3f}")
for i in (*upper, lid):
    O.bodies[i].state.vel = (table.speed, 0, 0)

rows, stresses = 40, []
steps = max(1, round(table.way / table.speed / O.dt / rows / 4))
for k in range(1, rows + 1):
    shear = 0
    for _ in range(4):  # a mean over the row: contacts come and go
        O.run(steps, wait=True)
        shear += sum(O.forces.f(i)[0] for i in lower) / WIDTH / 4
    stresses.append(shear / table.pressure)
    if k % 5 == 0:
        print("way %.3f m: shear over normal stress %.3f, lid at %.4f m" % (k * table.way / rows, shear / table.pressure, O.bodies[lid].state.pos[1]), flush=True)

print(f"steps {O.iter}")
print(f"peak {max(stresses):.3f}")
print(f"second half {sum(stresses[rows // 2:]) / (rows - rows // 2):.3f}")
utils.waitIfBatch()
