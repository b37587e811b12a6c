#!/usr/bin/env python3
"""A column of disks collapses on a rough floor: prints its run-out and what is left of its height.

soft_column.py and hard_column.py are twins: an ordinary YADE script with springs at the contacts, and the same with Contact Dynamics.
They differ between the lines "# [" and "# ]" only. Disks settle behind a gate; then the gate is taken away.
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
from yade.nonsmooth.scene import disk

# [ numerics
# restitution: of impacts
numerics = dict(dt=1e-3, tolerance=1e-4, restitution=0)
# ]
# aspect: height of the column by its width; friction of the disks; seed of the packing; seconds after the gate has gone
utils.readParamsFromTable(aspect=2.0, friction=0.5, seed=1, seconds=3, **numerics)
from yade.params import table

parameters.positive(table, "aspect", "seconds", "dt")
parameters.not_negative(table, "friction")
parameters.whole(table, "seed", least=0)

WIDTH, SMALL, LARGE = 1.0, 0.03, 0.05  # of the column [m]; radii [m]

# [ material
parameters.within(table, 0, 1, "restitution")
rock = NscdMat(density=2500, frictionAngle=math.atan(table.friction), restitution=table.restitution)
# ]
O.materials.append(rock)

# a wall on the left, a floor of fixed disks, the gate
O.bodies.append(utils.wall((0, 0, 0), axis=0, material=rock))
floor_length = WIDTH * (3 + 4 * table.aspect)
O.bodies.append([disk(((2 * k + 1) * SMALL, -SMALL), SMALL, rock, fixed=True) for k in range(math.ceil(floor_length / (2 * SMALL)))])
gate = O.bodies.append(utils.wall((WIDTH, 0, 0), axis=0, material=rock))

dice = random.Random(table.seed)
disks, area = [], 0
while area < 0.83 * table.aspect * WIDTH**2:  # 0.83: about how dense disks of several sizes lie
    row, column = divmod(len(disks), 9)
    radius = dice.uniform(SMALL, LARGE)
    disks.append(O.bodies.append(disk((0.06 + 0.107 * column + dice.uniform(0, 0.01), 0.06 + 0.107 * row), radius, rock)))
    area += math.pi * radius**2

# [ functors, engines, time step
O.engines = [
    ForceResetter(),
    # the disks fall by metres before they settle: contacts are looked for as far as a step takes them
    InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.2), Bo1_Wall_Aabb()], verletDist=0.01),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1.2), Ig2_Wall_Sphere_ScGeom()],
        [Ip2_NscdMat_NscdMat_NscdPhys()],
        [Law2_ScGeom_NscdPhys_SignoriniCoulomb(reach=0.2)]),
    ContactDynamicsEngine(tolerance=table.tolerance),
    NewtonIntegrator(damping=0, gravity=(0, -9.81, 0)),
]
# ]
O.dt = table.dt


def shape():
    """Front [m]: 95 % of the disks lie left of it; height [m] of the heap at the wall: 95 % of those within 0.2 m of it lie below."""
    right = sorted(O.bodies[i].state.pos[0] + O.bodies[i].shape.radius for i in disks)
    tops = sorted(O.bodies[i].state.pos[1] + O.bodies[i].shape.radius for i in disks if O.bodies[i].state.pos[0] < 0.2 * WIDTH)
    return right[int(0.95 * (len(right) - 1))], tops[int(0.95 * (len(tops) - 1))] if tops else 0


O.run(max(1, round((1 + math.sqrt(table.aspect)) / O.dt)), wait=True)
front, height = shape()
print("disks %d, column [m]: %.3f wide, %.3f high" % (len(disks), front, height))

O.bodies.erase(gate)
released = O.time
for k in range(1, 7):
    O.run(max(1, round(table.seconds / 6 / O.dt)), wait=True)
    print("%.2f s: front at %.3f m, height at the wall %.3f m" % (O.time - released, *shape()))

final, left = shape()
kinetic = utils.kineticEnergy()
print(f"aspect ratio {height / front:.3f}")
print(f"run-out, by the column's width {(final - front) / front:.3f}")
print(f"height left, by the column's {left / height:.3f}")
print(f"kinetic energy [J] {kinetic:.3e}")
print(f"steps {O.iter}")
utils.waitIfBatch()
