#!/usr/bin/env python3
"""A row of bonded disks held at one end, under a growing weight: prints the weight at which it breaks, and where.

soft_beam.py and hard_beam.py are twins: an ordinary YADE script with springs at the contacts, and the same with Contact Dynamics.
They differ between the lines "# [" and "# ]" only. The bond at the root bears the moment of the whole row, n disks of weight w at the
levers R, 3R, 5R, ...: w R n². It breaks at the torque μ_r ℓ F_a with ℓ = 2R, so at the weight w = 2 μ_r F_a/n².
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
numerics = dict(dt=4e-5, young=1e10, damping=0.5)
# ]
# count of disks, strength [Pa] of the bonds, load: greatest weight in units of that which statics asks for, seconds of its growth
utils.readParamsFromTable(count=8, strength=2.5e6, load=1.2, seconds=20, **numerics)
from yade.params import table

parameters.positive(table, "strength", "load", "seconds", "dt")
parameters.whole(table, "count")

RADIUS, DENSITY, ROLLING, FRICTION = 0.25, 2500, 0.125, 0.5
mass = DENSITY * math.pi * RADIUS**2  # of a disk 1 m thick
bond = table.strength * 2 * RADIUS    # F_a [N]
asked = 2 * ROLLING * bond / (table.count**2 * mass)  # gravity at which the row breaks [m/s²]

# [ material
# YADE's thresholds: normalCohesion R², shearCohesion R², normalCohesion R³/4; with μ_r = 1/8 and one radius they are the same bond
rock = CohFrictMat(density=DENSITY, young=table.young, poisson=0.3, frictionAngle=math.atan(FRICTION), momentRotationLaw=True, alphaKr=1, alphaKtw=0,
                   etaRoll=2 * ROLLING, normalCohesion=bond / RADIUS**2, shearCohesion=FRICTION * bond / RADIUS**2)
# ]
O.materials.append(rock)

row = [O.bodies.append(disk((2 * RADIUS * k, 0), RADIUS, rock, fixed=k == 0)) for k in range(table.count + 1)]


def grow():
    """The weight grows with time; the run stops when a bond has broken."""
    share = table.load * min(1, O.time / table.seconds)
    newton.gravity = (0, -share * asked, 0)
    broken = broken_bonds()
    if broken:
        print(f"broken at the load [of that of statics] {share:.4f}")
        print(f"broken bonds, counted from the root {' '.join(str(k + 1) for k in broken)}")
        O.pause()


# [ functors, engines, bonds
def broken_bonds():
    return [k for k in range(table.count) if not O.interactions.has(k, k + 1, True) or O.interactions[k, k + 1].phys.cohesionBroken]


O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.01)], verletDist=0.05),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom6D(interactionDetectionFactor=1.01)],
        [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True)],
        [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(always_use_moment_law=True, useIncrementalForm=True)]),
    NewtonIntegrator(damping=table.damping, gravity=(0, 0, 0), label="newton"),
]
O.dt = table.dt
O.step()  # finds the contacts, and bonds them
# ]
O.engines += [PyRunner(command="grow()", iterPeriod=10)]

print(f"gravity at which statics breaks the row [m/s2] {asked:.4f}")
steps = round(1.05 * table.seconds / O.dt)
tip = O.bodies[row[-1]].state
for k in range(1, 6):  # a report at each fifth
    O.run(max(1, steps * k // 5 - O.iter), wait=True)
    if broken_bonds():
        break
    print("load %.3f  deflection of the tip [mm] %.4f" % (-newton.gravity[1] / asked, -1e3 * tip.pos[1]))
else:
    print("the row holds")
print(f"steps {O.iter}")
utils.waitIfBatch()
