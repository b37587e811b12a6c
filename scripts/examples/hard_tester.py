#!/usr/bin/env python3
"""Pairs of bonded disks that YADE's LawTester pulls, shears and rolls: prints the most that each contact bears, beside the thresholds of the law.

soft_tester.py and hard_tester.py are twins: an ordinary YADE script with springs at the contacts, and the same with Contact Dynamics.
They differ between the lines "# [" and "# ]" only. A LawTester gives both disks of its pair their motion. So nothing presses them together; where a
load shall, one disk is let go along the normal, and a force presses it. The law says F_a = σ ℓ, T_max = μ_s (F_a + N) and Γ_max = μ_r ℓ (F_a + N).
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
numerics = dict(dt=1e-3, tolerance=1e-9)
# ]
# strength [Pa] and friction of the bonds, load [of F_a] on half of the pairs, steps of a path, angle [°] of the lines of centres: 0, 90, 180 or 270
utils.readParamsFromTable(strength=1e5, friction=0.5, load=1, steps=4000, angle=0, **numerics)
from yade.params import table

parameters.positive(table, "strength", "dt")
parameters.not_negative(table, "friction", "load")
parameters.whole(table, "steps")
parameters.one_of(table, (0, 90, 180, 270), "angle")

RADIUS, DENSITY, ROLLING = 0.5, 2500, 0.125
LENGTH = 2 * RADIUS              # ℓ [m]
BOND = table.strength * LENGTH   # F_a [N]
# what the second disk does to the first: along the normal and across it [ℓ], and about z [rad]; LawTester takes angles for angular velocities, and so for 1/dt of them
PATHS = dict(pull=dict(disPath=[(0, 0, 0), (0.03, 0, 0)]), shear=dict(disPath=[(0, 0, 0), (0, 0.03, 0)]),
             roll=dict(rotPath=[(0, 0, 0), (0, 0, 0.5 / table.dt)]))
# from the first disk to the second one, and across: whole numbers, so that each is an axis, which a disk may be blocked along
ALONG = {0: (1, 0), 90: (0, 1), 180: (-1, 0), 270: (0, -1)}[table.angle]
ACROSS = (-ALONG[1], ALONG[0])
REST = 500                       # steps in which the load arrives, before the path begins

# [ material
rock = NscdMat(density=DENSITY, frictionAngle=math.atan(table.friction), rollingFriction=ROLLING, tensileStrength=table.strength)
# ]
O.materials.append(rock)

tests = []  # what is done, load [N], LawTester
for way, load in (("pull", 0), ("shear", 0), ("shear", table.load * BOND), ("roll", 0), ("roll", table.load * BOND)):
    lane = -3 * RADIUS * len(tests)
    ids = [O.bodies.append(disk([s * a + lane * b for a, b in zip(ALONG, ACROSS)], RADIUS, rock, fixed=True)) for s in (0, LENGTH)]
    tests.append((way, load, LawTester(ids=ids, pathSteps=[REST, table.steps], idWeight=0.5, **PATHS[way])))
    O.forces.setPermF(ids[1], (-load * ALONG[0], -load * ALONG[1], 0))
ended = []
curves = {(way, load): [] for way, load, _ in tests}  # rows: displacement [m, rad], normal force [N], and the force that answers [N, N m]


def let_go():
    """A LawTester blocks all: a disk under a load may move along the normal again."""
    for _, load, tester in tests:
        if load:
            O.bodies[tester.ids[1]].state.blockedDOFs = "yzXYZ" if ALONG[0] else "xzXYZ"


def end_broken():
    """A LawTester needs its contact: where the bond has ended, so does the test, and both disks stay."""
    for _, _, tester in tests:
        if O.iter > 0 and not tester.dead and not bonded(*tester.ids):
            tester.dead = True
            for i in tester.ids:
                O.bodies[i].state.vel = O.bodies[i].state.angVel = (0, 0, 0)


def record():
    for way, load, tester in tests:
        rows = curves[way, load]
        if O.iter <= REST or tester in ended:
            continue
        if tester.dead:  # the last row: what is left
            ended.append(tester)
        force, torque = (of(tester.ids[0]) for of in (O.forces.f, O.forces.t))  # of the contact alone: the load is on the other disk
        normal, across = (force[0] * d[0] + force[1] * d[1] for d in (ALONG, ACROSS))
        done = tester.uuPrev
        way_done, answer = dict(pull=(done[0] * LENGTH, normal), shear=(done[1] * LENGTH, across), roll=(done[5] * O.dt, torque[2]))[way]
        rows.append((way_done, -normal, abs(answer)))


# [ functors, engines, bonds
def bonded(a, b):
    return O.interactions.has(a, b, True) and O.interactions[a, b].phys.bonded


O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.05)], verletDist=0.05),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1.05)],
        [Ip2_NscdMat_NscdMat_NscdPhys()],
        [Law2_ScGeom_NscdPhys_SignoriniCoulomb()]),
    PyRunner(command="end_broken()", iterPeriod=1),
    *(tester for _, _, tester in tests),
    PyRunner(command="let_go()", iterPeriod=1),
    ContactDynamicsEngine(tolerance=table.tolerance, label="contactDynamics"),
    NewtonIntegrator(damping=0, gravity=(0, 0, 0)),
]
O.dt = table.dt
O.step()
contactDynamics.bond()
# ]
O.engines += [PyRunner(command="record()", iterPeriod=1)]
O.run(REST + table.steps, wait=True)


def threshold(way, normal):
    return dict(pull=BOND, shear=table.friction * (BOND + normal), roll=ROLLING * LENGTH * (BOND + normal))[way]


print("test    load [kN]  largest [kN, kN m]  threshold [kN, kN m]  bond ends at [m, rad]")
for way, load, tester in tests:
    rows = curves[way, load]
    most = max(rows, key=lambda row: row[2])
    ends = "%.4f" % rows[-1][0] if tester in ended else "it holds"
    print("%-7s %9.1f %19.4f %21.4f  %s" % (way, 1e-3 * load, 1e-3 * most[2], 1e-3 * threshold(way, max(0, most[1])), ends))
print(f"steps {O.iter}")
utils.waitIfBatch()
