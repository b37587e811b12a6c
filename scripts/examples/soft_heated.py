#!/usr/bin/env python3
"""Blocks on surfaces that weaken as they heat: prints the slip after which 10 % of the strength are left, beside the closed form.

soft_heated.py and hard_heated.py are twins: an ordinary YADE script with springs at the contacts, and the same with Contact Dynamics.
They differ between the lines "# [" and "# ]" only. A block is a row of disks that may not turn, as heavy as a layer of rock. It slides on a zone of wet clay
that its work heats; the water expands, cannot leave, and bears more and more of the weight: τ = f σ exp(−δ/D_c), with D_c = ρc h/(f Λ) and the slip δ.
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
from yade.nonsmooth.slip import surface
from yade.nonsmooth.slip.laws import SlipLaw

# [ numerics
numerics = dict(dt=1e-3, young=1e9, damping=0.2)
# ]
# slope [°], friction before slip, thickness [m] of the zone, depth [m] of the rock, normal to the slope, seconds
utils.readParamsFromTable(slope=25, friction=0.4, thickness=7.5e-3, depth=100, seconds=3, **numerics)
from yade.params import table

parameters.positive(table, "friction", "thickness", "depth", "seconds", "dt")
parameters.within(table, 1, 89, "slope")
parameters.within(table, 1e-4, 1, "thickness")  # m: a step slides less than the slip that weakens it
parameters.within(table, 1, 1000, "depth")  # m: deeper the water boils before it bears the rock

RADIUS, COUNT, G = 0.5, 24, 9.81
CELL = 8.0  # m of a surface that share a temperature; those of the block's middle lie below it until it has slid so far
ANGLE = math.radians(table.slope)
HEAT, PRESSURE, COLD = 2.85e6, 6.7e4, 15  # ρc [J/m³/K] of the zone, Λ [Pa/K] by which its water's pressure grows, temperature [°C] before slip
# thickness of the zone and depth of the rock in units of the table's, speed [m/s] at first; the last one has no zone, and keeps its friction
LANES = {"heated": (1, 1, 0), "half as deep": (1, 0.5, 0), "twice as thick": (2, 1, 0), "pushed": (1, 1, 1), "constant": (0, 1, 0)}

along, up = (math.cos(ANGLE), -math.sin(ANGLE)), (math.sin(ANGLE), math.cos(ANGLE))
CELLS = math.ceil((2 * RADIUS * COUNT + table.seconds + G * table.seconds**2 / 2) / CELL)  # of a surface, more than any block needs
origins, blocks, walls = [], [], []  # of each lane: its upper end, ids of disks, id of the wall

# [ material
parameters.positive(table, "young")
parameters.within(table, 0, 1, "damping")
grounds = []  # of each wall: its law, the law's cells, their friction


def rock(density):
    return FrictMat(density=density, young=table.young, poisson=0.3, frictionAngle=0)


def ground(law):
    """The material of a wall, and cells with the state of its law, which springs do not know."""
    law.prepare(table.dt)
    cells = law.cells(CELLS)
    law.strength(cells)
    grounds.append((law, cells, [law.friction()] * len(cells.slip)))
    return FrictMat(young=table.young, poisson=0.3, frictionAngle=0)


def couple():
    """What the engine of the hard twin does in each step: cells get the stress, the slip and the heat of their contacts, contacts the friction of the law."""
    for ids, wall, origin, (law, cells, friction) in zip(blocks, walls, origins, grounds):
        pressed, slid, lost = ([0] * len(friction) for _ in range(3))
        for i in ids:
            if not O.interactions.has(wall, i, True):
                continue
            contact, state = O.interactions[wall, i].phys, O.bodies[i].state
            c = int(((state.pos[0] - origin[0]) * along[0] + (state.pos[1] - origin[1]) * along[1]) / CELL)
            if not 0 <= c < len(pressed):
                raise parameters.ParameterError(f"dt {table.dt}: a block has left its plane; take less, or more damping")
            normal, speed = contact.normalForce.norm(), max(0, state.vel[0] * along[0] + state.vel[1] * along[1])
            pressed[c] += normal
            slid[c] += normal * speed
            lost[c] += contact.shearForce.norm() * speed
            contact.tangensOfFrictionAngle = friction[c]
        for c, normal in enumerate(pressed):
            cells.slip_rate[c] = slid[c] / normal if normal else 0
            cells.path[c] = cells.slip_rate[c] * table.dt
            span = min(cells.slip[c] + cells.path[c], CELL / 2)  # m of slip over which the stress is a mean, since forces swing
            cells.normal_stress[c] += (cells.path[c] / span if cells.slip[c] else 1) * (normal / CELL - cells.normal_stress[c])
            cells.heat[c] = lost[c] * table.dt / CELL
        law.advance(cells)
        friction[:] = [strength / stress if stress else law.friction() for strength, stress in zip(law.strength(cells), cells.normal_stress)]


def seen(k):
    """Slip [m], friction and temperature [°C] below the middle of a block."""
    _, cells, friction = grounds[k]
    return float(cells.slip[1]), float(friction[1]), float(cells.columns["temperature"][1])
# ]

for k, (thick, deep, _) in enumerate(LANES.values()):  # one incline each, one above the other
    law = SlipLaw("none", friction=table.friction)
    if thick:
        law = SlipLaw("thermal_pressurization", friction=table.friction, thickness=thick * table.thickness, heat_capacity=HEAT, temperature=COLD,
                      pressurization_coefficient=PRESSURE, thermal_diffusivity=0, hydraulic_diffusivity=0)  # neither heat nor water leaves the zone
    stuff, wall = rock(2400 * deep * table.depth * 2 * RADIUS / (math.pi * RADIUS**2)), ground(law)
    O.materials.append([stuff, wall])
    x, y = 2.5 * k * up[0], 2.5 * k * up[1]
    origins.append((x, y))
    walls += O.bodies.append(segments([(x, y), (x + CELLS * CELL * along[0], y + CELLS * CELL * along[1])], wall, sense=1))
    row = [((2 * n + 1) * RADIUS * along[0] + RADIUS * up[0], (2 * n + 1) * RADIUS * along[1] + RADIUS * up[1]) for n in range(COUNT)]
    blocks.append([O.bodies.append(disk((x + a, y + b), RADIUS, stuff)) for a, b in row])
    for i in blocks[-1]:
        O.bodies[i].state.blockedDOFs = "zXYZ"

# [ functors, engines, time step
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Segment_Aabb()], verletDist=0.2),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Segment_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_FrictPhys()],
        [Law2_ScGeom_FrictPhys_CundallStrack()]),
    PyRunner(command="couple()", iterPeriod=1),
    NewtonIntegrator(damping=table.damping, label="newton"),
]
O.dt = table.dt
for k in range(1, 101):  # springs would throw up a block whose weight comes at once: it grows in steps, as yet without the share that drives
    newton.gravity = tuple(-G * math.cos(ANGLE) * k / 100 * u for u in (*up, 0))
    O.run(20, wait=True)
# ]
newton.gravity = (0, -G, 0)
for ids, (_, _, speed) in zip(blocks, LANES.values()):
    for i in ids:
        O.bodies[i].state.vel = (speed * along[0], speed * along[1], 0)
starts, begun = [O.bodies[ids[0]].state.pos for ids in blocks], O.time

curves = {name: [(0, 0, 1, 0)] for name, (thick, _, _) in LANES.items() if thick}  # time [s], slip [m], share of the strength that is left, warmer by [K]


def look():
    """A row of each curve, at the end of a step."""
    for k, rows in enumerate(curves.values()):
        slip, friction, temperature = seen(k)
        rows.append((O.time + O.dt - begun, slip, friction / table.friction, temperature - COLD))


O.engines += [PyRunner(command="look()", iterPeriod=max(1, round(0.01 / O.dt)))]
O.run(max(1, round(table.seconds / O.dt)), wait=True)


def left(rows, share):
    """The row of a curve at which this share of the strength is left, between two others; None where more is."""
    for before, after in zip(rows, rows[1:]):
        if after[2] < share:
            part = (before[2] - share) / (before[2] - after[2])
            return [a + part * (b - a) for a, b in zip(before, after)]


def way(k):
    """How far [m] a block has slid, and its speed [m/s]."""
    state = O.bodies[blocks[k][0]].state
    return [v[0] * along[0] + v[1] * along[1] for v in (state.pos - starts[k], state.vel)]


print("a tenth is left  after [s]   slip [m]   closed form   warmer by [K]   closed form   way at the end [m]   speed [m/s]")
for k, (name, rows) in enumerate(curves.items()):
    thick, deep, _ = LANES[name]
    found = left(rows, 0.1)
    if not found:
        print("%-14s: %.1f %% are left after %.3f m" % (name, 100 * rows[-1][2], rows[-1][1]))
        continue
    time, slip, _, rise = found
    critical = HEAT * thick * table.thickness / (table.friction * PRESSURE)  # D_c [m]
    stress = 2400 * deep * table.depth * G * math.cos(ANGLE)                 # σ [Pa]
    print("%-14s   %9.3f   %8.4f   %11.4f   %13.3f   %11.3f   %18.3f   %11.3f" % (name, time, slip, critical * math.log(10), rise, 0.9 * stress / PRESSURE, *way(k)))
print("constant friction   way [m] %.3f   speed [m/s] %.3f" % tuple(way(-1)))
print(f"steps {O.iter}")
utils.waitIfBatch()
