#!/usr/bin/env python3
"""A disk falls onto a floor and bounces: prints the speed of each impact and how high the disk rises after it.

Exercise 1 of doc/exercises.rst. Parameters come from a table (yade-batch), or are those below.
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), "--threads", "1", *sys.argv[1:]])

from yade import utils
from yade.nonsmooth.scene import disk, engines, segments

# height [m] of the fall; restitution of the impact; bounces to wait for; time step [s]
utils.readParamsFromTable(height=1.0, restitution=0.5, bounces=3, dt=1e-3)
from yade.params import table

RADIUS, G = 0.1, 9.81
stuff = NscdMat(density=2500, frictionAngle=0.5, restitution=table.restitution)
O.materials.append(stuff)
O.bodies.append(segments([(-1, 0), (1, 0)], stuff, sense=1))
ball = O.bodies[O.bodies.append(disk((0, RADIUS + table.height), RADIUS, stuff))].state

O.engines = engines(gravity=(0, -G, 0))
O.dt = table.dt
print("impact   time [s]   before [m/s]   after [m/s]   rise [m]")
for k in range(1, table.bounces + 1):
    before = 0.0
    while ball.vel[1] <= 0:  # down to the floor: the step of the impact turns the velocity
        before = -ball.vel[1]
        O.step()
        if ball.vel[1] == 0 and before > 0:  # it stays on the floor
            break
    at, after, top = O.time, ball.vel[1], 0.0
    while ball.vel[1] > 0:
        top = max(top, ball.pos[1] - RADIUS)
        O.step()
    print("%6d %10.3f %14.4f %13.4f %10.4f" % (k, at, before, after, top))
    if after == 0:
        break
print(f"steps {O.iter}")
utils.waitIfBatch()
