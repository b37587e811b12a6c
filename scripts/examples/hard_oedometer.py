#!/usr/bin/env python3
"""An oedometer: a plate presses grains in a smooth box, stress by stress, and lets go. Prints the settlement.

soft_oedometer.py and hard_oedometer.py are twins: an ordinary YADE script with springs at the contacts, and the same with Contact Dynamics.
They differ between the lines "# [" and "# ]" only: in the numerics, the material, the functors and the engines.
Parameters come from a table (yade-batch), or are those below.
"""
import os, sys
if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), "--threads", "1", *sys.argv[1:]])

import random

from yade import utils
from yade.nonsmooth import parameters
from yade.nonsmooth.scene import disk, segments

# [ numerics
numerics = dict(dt=1e-3, tolerance=1e-5)
# ]
# largest stress [Pa], seconds for each stress
utils.readParamsFromTable(stress=4e5, seconds=0.5, **numerics)
from yade.params import table

parameters.positive(table, "seconds", "dt")
parameters.within(table, 1e4, 1e12, "stress")

WIDTH, MASS = 1.0, 200.0

# [ material
rock = NscdMat(density=2500, frictionAngle=0.5)
joint = NscdMat(frictionAngle=0, wall=True)
# ]
O.materials.append((rock, joint))

# a smooth box; the plate above is a body with a mass, which may move up and down
O.bodies.append(segments([(-0.5, 0), (WIDTH + 0.5, 0)], joint, sense=1))
O.bodies.append(segments([(0, 3), (0, -0.5)], joint, sense=1))
O.bodies.append(segments([(WIDTH, -0.5), (WIDTH, 3)], joint, sense=1))
(plate,) = O.bodies.append(segments([(WIDTH + 0.5, 1.2), (-0.5, 1.2)], joint, sense=1))
O.bodies[plate].state.mass = MASS
O.bodies[plate].state.blockedDOFs = "xzXYZ"

dice = random.Random(1)
for row in range(13):
    for column in range(12):
        shift = dice.uniform(-0.004, 0.004) + 0.02 * (row % 2)  # upright columns of disks would bear without being dense
        O.bodies.append(disk((0.046 + 0.08 * column + shift, 0.042 + 0.083 * row), dice.uniform(0.03, 0.04), rock))

# [ functors, engines, time step
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.05), Bo1_Segment_Aabb()], verletDist=0.005),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1.05), Ig2_Segment_Sphere_ScGeom(interactionDetectionFactor=1.05)],
        [Ip2_NscdMat_NscdMat_NscdPhys()],
        [Law2_ScGeom_NscdPhys_SignoriniCoulomb()]),
    ContactDynamicsEngine(tolerance=table.tolerance),
    NewtonIntegrator(damping=0, gravity=(0, -9.81, 0)),
]
# ]
O.dt = table.dt


def load(stress):
    """Brings the stress on the plate from what it was to this one, a twentieth at a time; returns the plate's height."""
    before = -O.forces.permF(plate)[1] / WIDTH
    for k in range(1, 21):  # all at once it would throw the plate onto the grains
        O.forces.setPermF(plate, (0, -(before + (stress - before) * k / 20) * WIDTH, 0))
        O.run(max(1, round(table.seconds / 20 / O.dt)), wait=True)
    O.run(max(1, round(table.seconds / O.dt)), wait=True)
    return O.bodies[plate].state.pos[1]


load(1e4)
first = load(1e4)  # the grains have settled under the plate
print("stress [Pa], settlement [m]")
stress, stresses = 1e4, []
while stress < table.stress:
    stress = min(2 * stress, table.stress)
    stresses.append(stress)
for stress in stresses + [1e4]:
    settled = first - load(stress)
    print(f"{stress:.0f} {settled:.6f}")
print(f"steps {O.iter}")
utils.waitIfBatch()
