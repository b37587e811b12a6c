#!/usr/bin/env python3
"""Disks in a drum that turns: prints the angle at which their centre of mass hangs.

soft_drum.py and hard_drum.py are twins: an ordinary YADE script with springs at the contacts, and the same with Contact Dynamics.
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
from yade.nonsmooth.scene import arc, disk

# [ numerics
numerics = dict(dt=2e-4, young=1e8, damping=0.2)
# ]
# friction of the disks and of the drum, seconds a turn, turns
utils.readParamsFromTable(friction=0.5, turn=20, turns=0.6, **numerics)
from yade.params import table

parameters.positive(table, "turn", "turns", "dt")
parameters.not_negative(table, "friction")

RADIUS = 1.0

# [ material
rock = FrictMat(density=2500, young=table.young, poisson=0.3, frictionAngle=math.atan(table.friction))
# ]
O.materials.append(rock)

# the drum: a circle that acts inwards; a disk that would slip on smooth walls is carried along by friction
drum = O.bodies.append(arc((0, 0), RADIUS, 0, 2 * math.pi, rock))

dice = random.Random(1)
disks = []
for row in range(16):
    for column in range(16):
        x, y = 0.115 * (column - 7.5), 0.115 * (row - 7.5)
        if math.hypot(x, y) < RADIUS - 0.07 and y < 0.25:
            disks.append(O.bodies.append(disk((x, y), dice.uniform(0.04, 0.055), rock)))

# [ functors, engines, time step
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Arc_Aabb()], verletDist=0.01),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Arc_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_FrictPhys()],
        [Law2_ScGeom_FrictPhys_CundallStrack()]),
    RotationEngine(rotateAroundZero=True, zeroPoint=(0, 0, 0), rotationAxis=(0, 0, 1), ids=drum, label="drive"),
    NewtonIntegrator(damping=table.damping, gravity=(0, -9.81, 0)),
]
# ]
O.dt = table.dt
drive.angularVelocity = 0
O.run(max(1, round(1.5 / O.dt)), wait=True)  # they fall
drive.angularVelocity = 2 * math.pi / table.turn


def angle():
    """Of the disks' centre of mass from the vertical through the drum's centre [degrees]."""
    states = [O.bodies[i].state for i in disks]
    x, y = (sum(s.mass * s.pos[k] for s in states) for k in (0, 1))
    return math.degrees(math.atan2(x, -y))


angles = []
for k in range(1, 61):
    O.run(max(1, round(table.turns * table.turn / 60 / O.dt)), wait=True)
    angles.append(angle())
    if k % 10 == 0:
        print("%.2f turns: %.1f degrees" % (k * table.turns / 60, angles[-1]), flush=True)

late = angles[len(angles) // 3:]
print(f"steps {O.iter}")
print(f"disks {len(disks)}, in the drum {sum(O.bodies[i].state.pos.norm() < RADIUS for i in disks)}")
print(f"mean angle [degrees] {sum(late) / len(late):.2f}")
print(f"largest angle [degrees] {max(angles):.2f}")
utils.waitIfBatch()
