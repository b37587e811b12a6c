#!/usr/bin/env python3
"""A cloud of disks falls into a box and comes to rest: prints what the box bears.

soft_deposit.py and hard_deposit.py are twins: an ordinary YADE script with springs at the contacts, and the same with Contact Dynamics.
They differ between the lines "# [" and "# ]" only: in the numerics, the material, the functors and the engines.
Parameters come from a table (yade-batch), or are those below.
"""
import os, sys
if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), "--threads", "1", *sys.argv[1:]])

from yade import log, pack, plot, utils
from yade.nonsmooth import parameters
from yade.nonsmooth.scene import disks, segments

# [ numerics
numerics = dict(dt=1e-3, tolerance=1e-5)
# ]
# mean radius [m] and its spread, unbalanced force at rest, longest time [s]
utils.readParamsFromTable(radius=0.03, spread=0.3, rest=0.02, seconds=5, **numerics)
from yade.params import table

parameters.positive(table, "rest", "seconds", "dt")
parameters.within(table, 0.005, 0.2, "radius")
parameters.within(table, 0, 0.9, "spread")

# [ material
rock = NscdMat(density=2500, frictionAngle=0.5)
# ]
O.materials.append(rock)

# a box of 1 m that is open above: walls act to the left of their direction
floor, left, right = (O.bodies.append(segments(ends, rock, sense=1))[0] for ends in ([(-0.2, 0), (1.2, 0)], [(0, 3), (0, -0.2)], [(1, -0.2), (1, 3)]))
log.setLevel("SpherePack", 2)  # errors alone: that a flat box has no volume is known
cloud = pack.SpherePack()
cloud.makeCloud((0, 0, 0), (1, 1.5, 0), rMean=table.radius, rRelFuzz=table.spread, seed=1)  # flat: both corners have one z
grains = O.bodies.append(disks(cloud, rock))

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


def look():
    """A row for the plot; the run ends where forces are in balance."""
    unbalanced = utils.unbalancedForce()
    plot.addData(time=O.time, unbalanced=unbalanced, kinetic=utils.kineticEnergy())
    if O.time > 1 and unbalanced < table.rest or O.time > table.seconds:
        O.pause()


O.engines = O.engines + [PyRunner(command="look()", virtPeriod=0.02)]
O.run(wait=True)

plot.plots = {"time": ("unbalanced", None, "kinetic")}  # plot.plot() shows it
weight = 9.81 * sum(O.bodies[i].state.mass for i in grains)
bears = [O.forces.f(i) for i in (floor, left, right)]
print(f"steps {O.iter}")
print(f"time [s] {O.time:.2f}")
print(f"unbalanced force [-] {plot.data['unbalanced'][-1]:.4f}")
print(f"kinetic energy [J] {plot.data['kinetic'][-1]:.2e}, at most {max(plot.data['kinetic']):.0f}")
print(f"floor and sides bear [of the weight] {-sum(f[1] for f in bears) / weight:.4f}")
print(f"height of the highest disk [m] {max(O.bodies[i].state.pos[1] for i in grains):.3f}")
utils.waitIfBatch()
