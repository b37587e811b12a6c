#!/usr/bin/env python3
"""A disk falls onto a floor and bounces: prints the speed of each impact and how high the disk rises after it.

Exercise 1 of doc/exercises.rst. Parameters come from a table (yade-batch), or are those below.
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), "--threads", "1", *sys.argv[1:]])

from yade import utils
from yade.nonsmooth import parameters
from yade.nonsmooth.scene import disk, engines, segments

# height [m] of the fall; restitution of the impact; bounces to wait for; time step [s]
utils.readParamsFromTable(height=1.0, restitution=0.5, bounces=3, dt=1e-3)
from yade.params import table

parameters.positive(table, "height", "dt")
parameters.within(table, 0, 1, "restitution")
parameters.whole(table, "bounces")

RADIUS, G = 0.1, 9.81
stuff = NscdMat(density=2500, frictionAngle=0.5, restitution=table.restitution)
O.materials.append(stuff)
O.bodies.append(segments([(-1, 0), (1, 0)], stuff, sense=1))
ball = O.bodies[O.bodies.append(disk((0, RADIUS + table.height), RADIUS, stuff))].state

O.engines = engines(gravity=(0, -G, 0))
O.dt = table.dt
print("impact   time [s]   before [m/s]   after [m/s]   rise [m]")
kick = G * O.dt  # what gravity takes in a step: a floor that gives more has been met
for k in range(1, table.bounces + 1):
    before, given = 0.0, 0.0
    while given < 0.5 * kick:  # until the floor gives the disk some velocity
        before = -ball.vel[1]
        O.step()
        given = ball.vel[1] + before + kick
    while ball.vel[1] < -0.5 * kick:  # what is left of the gap: the disk lands within the next step
        O.step()
    at, after, top = O.time, max(0.0, ball.vel[1]), 0.0
    while ball.vel[1] > 0:
        top = max(top, ball.pos[1] - RADIUS)
        O.step()
    print("%6d %10.3f %14.4f %13.4f %10.4f" % (k, at, before, after, top))
    if after < kick:
        print("the disk stays on the floor")
        break
print(f"steps {O.iter}")
utils.waitIfBatch()
