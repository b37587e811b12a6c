#!/usr/bin/env python3
"""A slab of bonded rock on a dipping joint: water rises in it until it slides into the valley. Prints the water at failure and the run-out.

soft_slope.py and hard_slope.py are twins: an ordinary YADE script with springs at the contacts, and the same with Contact Dynamics.
They differ between the lines "# [" and "# ]" only. Statics: the slab slides when W sin β > μ (W cos β − U), with the weight W of all disks
and the water's lift U = γ_w cos β V on the volume V of those below the table.
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
numerics = dict(dt=4e-4, young=1e9, damping=0.2)
# ]
# dip [°] of the joint, its friction, strength [Pa] of the rock's bonds, rate [m/s] at which the water rises, seconds
utils.readParamsFromTable(dip=30, friction=0.65, strength=2e5, rate=0.3, seconds=25, **numerics)
from yade.params import table

parameters.positive(table, "strength", "seconds", "dt")
parameters.not_negative(table, "friction", "rate")
parameters.within(table, 1, 89, "dip")

RADIUS, ROWS, COLUMNS, FOOT = 0.5, 8, 36, 10.0  # disks of 1 m; the slab's lower end lies FOOT [m] above the valley, along the joint
DIP = math.radians(table.dip)

# [ material
# YADE's thresholds: normalCohesion R², shearCohesion R², normalCohesion R³/4; with μ_r = 1/8 and one radius they are the same bond
rock = CohFrictMat(density=2500, young=table.young, poisson=0.3, frictionAngle=math.atan(1.0), momentRotationLaw=True, alphaKr=1, alphaKtw=0,
                   etaRoll=0.25, normalCohesion=2 * table.strength / RADIUS, shearCohesion=2 * table.strength / RADIUS)
joint = FrictMat(density=2500, young=table.young, poisson=0.3, frictionAngle=math.atan(table.friction))
# ]
O.materials.append([rock, joint])

# the joint dips to the right, to the valley floor that begins at (0, 0)
along, up = (math.cos(DIP), -math.sin(DIP)), (math.sin(DIP), math.cos(DIP))
O.bodies.append(segments([(-70 * along[0], -70 * along[1]), (0, 0), (100, 0)], joint, piece=5, sense=1))
disks = []
for row in range(ROWS):
    for column in range(COLUMNS):
        s, h = -FOOT - RADIUS * (2 * column + 1 + row % 2), RADIUS * (1 + math.sqrt(3) * row)
        disks.append(O.bodies.append(disk((s * along[0] + h * up[0], s * along[1] + h * up[1]), RADIUS, rock)))

water = PorePressureEngine(planePoint=(0, 0, 0), planeNormal=(up[0], up[1], 0), releaseDistance=math.inf)

# statics: how many rows must be wet
for wet in range(ROWS + 1):
    if math.tan(DIP) > table.friction * (1 - wet / ROWS * water.unitWeight / (rock.density * 9.81)):
        print(f"water at failure by statics [m] {RADIUS * (1 + math.sqrt(3) * (wet - 1)):.3f} ({wet} of {ROWS} rows)")
        break
else:
    print("statics: the slab stands even when it is full of water")

# [ functors, engines, bonds
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.01), Bo1_Segment_Aabb()], verletDist=0.1),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom6D(interactionDetectionFactor=1.01), Ig2_Segment_Sphere_ScGeom()],
        [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True), Ip2_FrictMat_FrictMat_FrictPhys()],
        [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(always_use_moment_law=True, useIncrementalForm=True), Law2_ScGeom_FrictPhys_CundallStrack()]),
    water,
    NewtonIntegrator(damping=table.damping, label="newton"),
]
O.dt = table.dt
O.step()  # finds the contacts, and bonds them
for k in range(1, 101):  # springs would throw up a slab whose weight comes at once: it grows in steps
    newton.gravity = (0, -9.81 * k / 100, 0)
    O.run(20, wait=True)


def bonds():
    return sum(isinstance(i.phys, CohFrictPhys) and not i.phys.cohesionBroken for i in O.interactions if i.isReal)
# ]

# the water begins to rise
water.times, water.heights = [O.time, O.time + table.seconds], [0, table.rate * table.seconds]


def front():
    """[m]: 99 % of the disks lie left of it."""
    right = sorted(O.bodies[i].state.pos[0] for i in disks)
    return right[int(0.99 * (len(right) - 1))]


def displacement():
    """Mean of the disks' [m]."""
    return sum((s.pos - p).norm() for s, p in zip(states, start)) / len(states)


begun = O.time
states = [O.bodies[i].state for i in disks]
start, first, made = [s.pos for s in states], front(), bonds()
print(f"disks {len(disks)}, bonds {made}")
failure = broken = None
steps = max(1, round(0.1 / O.dt))
for k in range(1, round(table.seconds / (steps * O.dt)) + 1):
    O.run(steps, wait=True)
    moved = displacement()
    if failure is None and moved > 0.02:
        failure = water.height
        print(f"water at failure [m] {failure:.3f}")
    if broken is None and bonds() < made:
        broken = O.time - begun
        print(f"first bond broken after [s] {broken:.1f}")
    if k % 30 == 0:
        print("%5.1f s: water %6.3f m, mean displacement %9.4f m, bonds %d" % (O.time - begun, water.height, moved, bonds()), flush=True)

if failure is None:
    print("the slab stands")
print(f"travel of the front [m] {front() - first:.2f}")
print(f"broken bonds {made - bonds()}")
print(f"steps {O.iter}")
utils.waitIfBatch()
