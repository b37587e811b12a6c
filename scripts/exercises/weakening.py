#!/usr/bin/env python3
"""A block is pulled along a joint that loses its friction with slip: prints the friction that the block meets on its
way.

Exercise 6 of doc/exercises.rst. Parameters come from a table (yade-batch), or are those below.
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), "--threads", "1", *sys.argv[1:]])

import math

from yade import utils
from yade.nonsmooth import parameters
from yade.nonsmooth.scene import disk, engines, segments

# friction of the joint, friction when it has lost its strength, the slip D_c [m] at which it has, law: linear, step or
# exponential; speed [m/s] of the block; time step [s]
utils.readParamsFromTable(friction=0.6, weakened=0.1, critical=0.5, law="linear", speed=0.1, dt=5e-3)
from yade.params import table

parameters.positive(table, "critical", "speed", "dt")
parameters.not_negative(table, "friction")
parameters.within(table, 0, table.friction, "weakened")
parameters.one_of(table, ("linear", "step", "exponential"), "law")

RADIUS, G = 0.5, 9.81
rock = NscdMat(density=2500, frictionAngle=math.atan(table.friction))
joint = SlipWeakeningMat(
    frictionAngle=math.atan(table.friction),
    wall=True,
    weakening=table.law,
    criticalSlip=table.critical,
    weakenedFrictionAngle=math.atan(table.weakened),
)
O.materials.append([rock, joint])
way = 2 * table.critical
O.bodies.append(segments([(-1, 0), (way + 1, 0)], joint, sense=1))
number = O.bodies.append(disk((0, RADIUS), RADIUS, rock))
block = O.bodies[number].state
block.blockedDOFs, block.vel = "xzXYZ", (table.speed, 0, 0)  # a block: it does not turn; what pulls it keeps its speed

O.engines = engines(gravity=(0, -G, 0))
O.dt = table.dt
weight, work = O.bodies[number].state.mass * G, 0.0
print("slip [m]   friction over weight")
rows, steps = 20, round(way / table.speed / O.dt)
for k in range(1, rows + 1):
    while O.iter < k * steps // rows:
        O.step()
        work += -O.forces.f(number)[0] * table.speed * O.dt
    print("%8.4f %22.5f" % (block.pos[0], -O.forces.f(number)[0] / weight))
# beyond what the weakened joint takes: the energy that breaking the joint costs
print(f"energy of weakening [J per m] {work - table.weakened * weight * block.pos[0]:.2f}")
print(f"weight [N per m] {weight:.3f}")
print(f"steps {O.iter}")
utils.waitIfBatch()
