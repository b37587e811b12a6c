#!/usr/bin/env python3
"""Disks fall into a box and come to rest: prints the pile's height and its kinetic energy.

soft_pile.py and hard_pile.py are twins: an ordinary YADE script with springs at the contacts, and the same with Contact Dynamics.
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

# [ numerics
numerics = dict(dt=2e-4, young=2e8, damping=0.2)
# ]
# friction of the disks, seconds
utils.readParamsFromTable(friction=0.3, seconds=2.5, **numerics)
from yade.params import table

parameters.positive(table, "seconds", "dt")
parameters.not_negative(table, "friction")

WIDTH = 1.5

# [ material
rock = FrictMat(density=2500, young=table.young, poisson=0.3, frictionAngle=math.atan(table.friction))
# ]
O.materials.append(rock)

# walls of the box
O.bodies.append(utils.wall((0, 0, 0), axis=1, material=rock))
O.bodies.append(utils.wall((0, 0, 0), axis=0, material=rock))
O.bodies.append(utils.wall((WIDTH, 0, 0), axis=0, material=rock))

# disks in the plane z = 0: a disk's mass and inertia, motion in the plane
dice = random.Random(1)
disks = []
for row in range(17):
    for column in range(12):
        radius = dice.uniform(0.04, 0.06)
        body = utils.sphere((0.07 + 0.123 * column + dice.uniform(0, 0.005), 0.07 + 0.123 * row, 0), radius, material=rock)
        body.state.mass = rock.density * math.pi * radius**2
        body.state.inertia = Vector3(1, 1, 1) * 0.5 * body.state.mass * radius**2
        body.state.blockedDOFs = "zXY"
        disks.append(O.bodies.append(body))

# [ functors, engines, time step
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.01),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_FrictPhys()],
        [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(damping=table.damping, gravity=(0, -9.81, 0)),
]
# ]
O.dt = table.dt

O.run(max(1, round(table.seconds / O.dt)), wait=True)

states = [O.bodies[i].state for i in disks]
mass = sum(s.mass for s in states)
height = 2 * sum(s.mass * s.pos[1] for s in states) / mass  # of a level pile: twice that of its centre of mass
kinetic = sum(0.5 * s.mass * s.vel.squaredNorm() + 0.5 * s.inertia[2] * s.angVel[2] ** 2 for s in states)
print(f"steps {O.iter}")
print(f"pile height [m] {height:.4f}")
print(f"kinetic energy [J] {kinetic:.3e}")
print(f"lowest disk [m] {min(s.pos[1] for s in states):.4f}")
utils.waitIfBatch()
