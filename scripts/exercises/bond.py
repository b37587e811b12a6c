#!/usr/bin/env python3
"""Two bonded disks are pulled apart by a force that grows: prints the force at which the bond yields, by its tensile
strength.

Exercise 5 of doc/exercises.rst. The force may point away from the other disk (angle 0), or aside (90). Parameters come
from a table (yade-batch), or are those below.
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), "--threads", "1", *sys.argv[1:]])

import math

from yade import utils
from yade.nonsmooth import parameters
from yade.nonsmooth.scene import disk, engines

# angle [°] of the force from the line of centres; friction; strength [Pa] of the bond; radius [m]; seconds in which the
# force reaches twice that strength
utils.readParamsFromTable(angle=0, friction=0.5, strength=1e5, radius=0.5, seconds=4, dt=2e-3)
from yade.params import table

parameters.positive(table, "strength", "radius", "seconds", "dt")
parameters.not_negative(table, "friction")
parameters.within(table, 0, 180, "angle")

rock = NscdMat(density=2500, frictionAngle=math.atan(table.friction), tensileStrength=table.strength)
O.materials.append(rock)
O.bodies.append(disk((0, 0), table.radius, rock, fixed=True))
number = O.bodies.append(disk((0, 2 * table.radius), table.radius, rock))
upper, angle = O.bodies[number].state, math.radians(table.angle)
upper.blockedDOFs = "zXYZ"  # it does not turn: nothing is asked of rolling friction

O.engines = engines(gravity=(0, 0, 0))
O.dt = table.dt
O.step()  # finds the contact
contactDynamics.bond()
start, force = upper.pos, 0.0
bond = table.strength * 2 * table.radius  # F_a [N per m]
while (upper.pos - start).norm() < 1e-5 * table.radius and force < 3 * bond:
    force = 2 * bond * O.time / table.seconds
    O.forces.setPermF(number, (force * math.sin(angle), force * math.cos(angle), 0))
    O.step()
print(f"tensile strength of the bond [N per m] {bond:.1f}")
print(f"force at which it yields, by that strength {force / bond:.4f}" if force < 3 * bond else "the bond holds")
print(f"steps {O.iter}")
utils.waitIfBatch()
