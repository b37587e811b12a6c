#!/usr/bin/env python3
"""A rock wedge on a joint that is not quite steep enough to slide: prints how far it creeps.

soft_wedge.py and hard_wedge.py are twins: an ordinary YADE script with springs at the contacts, and the same with Contact Dynamics.
They differ between the lines "# [" and "# ]" only. The wedge is made of bonded disks; it rests by friction alone, and water in the
joint may rise and fall. Parameters come from a table (yade-batch), or are those below.
"""
import os, sys
if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), "--threads", "1", *sys.argv[1:]])

import math

from yade import plot, utils
from yade.nonsmooth import parameters
from yade.nonsmooth.measure import creep
from yade.nonsmooth.scene import disk, segments

# [ numerics
numerics = dict(dt=4e-4, young=1e9, damping=0.2)
# ]
# dip [°] of the joint, its friction, seconds; water: height [m] to which the water table rises above the joint every `period` [s];
# save: a file for the curve
utils.readParamsFromTable(dip=30, friction=0.65, seconds=60, water=0.5, period=2, save="", **numerics)
from yade.params import table

parameters.positive(table, "seconds", "period", "dt")
parameters.not_negative(table, "friction", "water")
parameters.within(table, 1, 89, "dip")

RADIUS, HEIGHT, FACE = 0.25, 5.0, math.radians(70)  # disks [m]; height of the wedge [m]; angle of its free face
DIP = math.radians(table.dip)

# [ material: bonds of 10 MPa, so that nothing breaks
rock = CohFrictMat(density=2500, young=table.young, poisson=0.3, frictionAngle=math.atan(table.friction), momentRotationLaw=True, alphaKr=1,
                   alphaKtw=0, etaRoll=0.25, normalCohesion=2e7 / RADIUS, shearCohesion=2e7 * table.friction / RADIUS)
joint = FrictMat(density=2500, young=table.young, poisson=0.3, frictionAngle=math.atan(table.friction))
# ]
O.materials.append([rock, joint])

# the joint rises to the right from the toe at (0, 0)
along, up = (math.cos(DIP), math.sin(DIP)), (-math.sin(DIP), math.cos(DIP))
O.bodies.append(segments([(-30 * along[0], -30 * along[1]), (15 * along[0], 15 * along[1])], joint, piece=2, sense=1))

# rows of touching disks along the joint, as far as they lie between the free face and the top
disks, wet = [], 0
for row in range(40):
    for column in range(40):
        s, h = RADIUS * (2 * column + 1 + row % 2), RADIUS * (1 + math.sqrt(3) * row)
        x, y = s * along[0] + h * up[0], s * along[1] + h * up[1]
        if x * math.sin(FACE) - y * math.cos(FACE) > RADIUS and y < HEIGHT:
            disks.append(O.bodies.append(disk((x, y), RADIUS, rock)))
            wet += h < table.water

# the water table is parallel to the joint; disks below it are lifted
times = [0.5 * table.period * k for k in range(2 + 2 * math.ceil(table.seconds / table.period))]
water = PorePressureEngine(planePoint=(0, 0, 0), planeNormal=(up[0], up[1], 0), times=times, heights=[table.water * (k % 2) for k in range(len(times))],
                           releaseDistance=math.inf, dead=not table.water)

# [ functors, engines, bonds
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.01), Bo1_Segment_Aabb()], verletDist=0.05),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom6D(interactionDetectionFactor=1.01), Ig2_Segment_Sphere_ScGeom()],
        [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True), Ip2_FrictMat_FrictMat_FrictPhys()],
        [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(always_use_moment_law=True, useIncrementalForm=True), Law2_ScGeom_FrictPhys_CundallStrack()]),
    water,
    NewtonIntegrator(damping=table.damping, gravity=(0, -9.81, 0)),
    PyRunner(command="record()", virtPeriod=0.1, initRun=False),
]
O.dt = table.dt
O.step()  # finds the contacts, and bonds them
# ]

states = [O.bodies[i].state for i in disks]
start = [s.pos for s in states]


def displacement():
    """Of the centroid down the joint, and the largest of a disk [mm]."""
    ways = [s.pos - p for s, p in zip(states, start)]
    mean = sum(ways, Vector3.Zero) / len(ways)
    return -1e3 * (mean[0] * along[0] + mean[1] * along[1]), 1e3 * max(w.norm() for w in ways)


def record():
    centroid, largest = displacement()
    plot.addData(t=O.time, centroid=centroid, largest=largest)


safety = table.friction / math.tan(DIP)  # friction the joint offers, by what the weight asks for
lift = wet / len(disks) * water.unitWeight / (rock.density * 9.81)
print("disks %d, safety factor dry %.3f, with the water at its highest %.3f" % (len(disks), safety, safety * (1 - lift)))
print("time [s]   down the joint [mm]   largest of a disk [mm]")
for end in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30, 40, 50, 60, 120, 300, 600, table.seconds):
    end = min(end, table.seconds)
    O.run(max(1, round((end - O.time) / O.dt)), wait=True)
    print("%8.2f %21.6f %24.6f" % (O.time, *displacement()), flush=True)
    if end == table.seconds:
        break
if table.save:
    plot.saveDataTxt(table.save)
rate = creep.rate(plot.data["t"], plot.data["centroid"], table.seconds)
if not math.isnan(rate):  # of a run that is long enough to have a curve
    print(f"creep after {creep.begin(table.seconds):g} s [mm/min] {rate:.6f}")
print(f"steps {O.iter}")
utils.waitIfBatch()
