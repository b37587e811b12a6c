#!/usr/bin/env python3
"""A round column of spheres collapses on a rough floor: prints its run-out and what is left of its height.

The script builds a scene of soft contacts, as any script of YADE's does; harden(O) makes it rigid. With "soft" set it stays soft. Spheres settle in a
tube of facets; then the tube is taken away.
Parameters come from a table (yade-batch), or are those below.
"""
import os, sys
if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), "--threads", "1", *sys.argv[1:]])

import math

import numpy as np
from yade import geom, pack, utils
from yade.nonsmooth import harden, parameters

# aspect: height of the column by its radius; size: the radius by the spheres' mean diameter; friction and rolling friction of the spheres; seed of the packing;
# seconds after the tube has gone; soft: springs of `young` [Pa]
utils.readParamsFromTable(aspect=1.0, size=8.0, friction=0.5, rolling=0.05, seed=1, seconds=1.5, soft=False, young=1e7)
from yade.params import table

parameters.positive(table, "aspect", "size", "seconds", "young")
parameters.not_negative(table, "friction", "rolling")
parameters.whole(table, "seed", least=0)

RADIUS = 0.5  # of the column [m]
mean = RADIUS / table.size  # diameter of the spheres [m]
rock = O.materials.append(
    CohFrictMat(
        density=2500, young=table.young, poisson=0.3, frictionAngle=math.atan(table.friction), isCohesive=False,
        momentRotationLaw=True, etaRoll=2 * table.rolling, etaTwist=0,
    )
)
# a box, since YADE's law with rolling resistance has no contacts with walls
O.bodies.append(utils.box((0, 0, -1), (50, 50, 1), fixed=True, material=rock))
height = table.aspect * RADIUS
tube = O.bodies.append(
    geom.facetCylinder((0, 0, 1.5 * height), RADIUS, 3 * height + 8 * mean, segmentsNumber=24, wallMask=4, material=rock)
)
# as many spheres as fill the column at a packing fraction of 0.6
count = round(0.6 * math.pi * RADIUS**2 * height / (math.pi / 6 * mean**3))
rng = np.random.default_rng(table.seed)
step = 1.16 * mean
across = [(x, y) for x in np.arange(-RADIUS, RADIUS, step) for y in np.arange(-RADIUS, RADIUS, step) if math.hypot(x, y) < RADIUS - 0.72 * mean]
for k in range(count):
    x, y = across[k % len(across)]
    x, y = np.array([x, y]) + rng.uniform(-0.03, 0.03, 2) * mean
    O.bodies.append(utils.sphere((x, y, (0.7 + 1.25 * (k // len(across))) * mean), mean / 2 * rng.uniform(0.8, 1.2), material=rock))

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb(), Bo1_Box_Aabb()]),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom6D(), Ig2_Facet_Sphere_ScGeom6D(), Ig2_Box_Sphere_ScGeom6D()],
        [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys()],
        [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(always_use_moment_law=True, useIncrementalForm=True)],
    ),
    NewtonIntegrator(damping=0.1 if table.soft else 0, gravity=(0, 0, -9.81)),
]
O.dt = 0.5 * utils.PWaveTimeStep()
if not table.soft:
    print(harden(O))


def run(seconds):
    O.run(max(1, round(seconds / O.dt)), True)


spheres = [b for b in O.bodies if isinstance(b.shape, Sphere)]


def places():
    return np.array([b.state.pos for b in spheres])


run(3 * math.sqrt(2 * (3 * height + 8 * mean) / 9.81))
begun = places()
top = np.sort(begun[:, 2])[-max(1, len(spheres) // 50) :].mean() + mean / 2
for k in tube:
    O.bodies.erase(k)
run(table.seconds)
ended = places()
# the edge of the mass, without the few that roll away: where the heap is thinner than a grain on average
distance = np.sort(np.hypot(ended[:, 0], ended[:, 1]))
front = distance[int(0.98 * len(distance))]
left = np.sort(ended[:, 2])[-max(1, len(spheres) // 50) :].mean() + mean / 2
print(f"{len(spheres)} spheres, column {top / RADIUS:.2f} radii high")
print(f"run-out (r - r0)/r0 = {front / RADIUS - 1:.3f}, height left h/r0 = {left / RADIUS:.3f}")
