"""Masses far apart: heavy bodies on light ones."""

from __future__ import annotations

import math

from matplotlib.figure import Figure

from yade import O
from yade.wrapper import NscdMat

from ...world import scene
from .claims import Claims, Findings
from .registry import check
from .small_scenes import G, engine, run, wall

LIGHT = 1000  # kg/m³
WEIGHT = "patches around mass jumps are solved to 1e-5 of a step's fall; a weight is asked for to 1e-3"


def _begin():
    O.engines, O.dt = scene.engines(gravity=(0, -G, 0)), 5e-3
    return engine()


def _stuff(ratio=1.0):
    O.materials.append(NscdMat(density=LIGHT * ratio, frictionAngle=math.atan(0.5)))
    return O.materials[-1]


def _borne(walls):
    return -sum(O.forces.f(b.id)[1] for b in walls)


def _column(light, ratio, steps):
    """A disk of that many times the mass on so many light ones: what the floor bears in each step, as a share of the
    weight.
    """
    O.reset()
    floor = wall([(-5, 0), (5, 0)], _stuff())
    disks = [
        O.bodies.append(scene.disk((0, 0.5 + k), 0.5, _stuff(ratio if k == light else 1))) for k in range(light + 1)
    ]
    e, weight, shares = _begin(), G * sum(O.bodies[k].state.mass for k in disks), []
    for _ in range(steps):
        run(1)
        shares.append(_borne(floor) / weight)
    return shares, e, light + 0.5 - O.bodies[disks[-1]].state.pos[1]


def _boulder(sizes, rows, steps):
    """A boulder of 1 m on rows of pebbles so many times smaller: the same."""
    O.reset()
    stuff, small = _stuff(), 0.5 / sizes
    count = max(6, int(1.3 * sizes))
    width = 2 * small * count
    walls = wall([(0, 1), (0, 0), (width, 0), (width, 1)], stuff)
    top = small * (1 + (rows - 1) * math.sqrt(3))
    for b in range(rows):
        for a in range(count - b % 2):
            O.bodies.append(scene.disk(((2 * a + 1 + b % 2) * small, small * (1 + b * math.sqrt(3))), small, stuff))
    inside = (rows - 1) % 2 == count % 2  # whether a pebble lies below the middle
    up = small + 0.5 if not inside else math.sqrt((small + 0.5) ** 2 - small**2)
    O.bodies.append(scene.disk((width / 2, top + up), 0.5, stuff))
    e, weight, shares = _begin(), G * sum(b.state.mass for b in O.bodies if b.dynamic), []
    for _ in range(steps):
        run(1)
        shares.append(_borne(walls) / weight)
    return shares, e


@check("A heavy disk on light ones", subject="Statics", seconds=5)
def heavy_on_light(bench):
    """A disk of R times the mass of the n disks below it, at the tolerance and sweeps that everybody has. Whatever R
    is, the floor bears m g (n + R) in every step from the first on, since nothing moves. The residual of impulses alone
    does not see the light disks: it called solved, at R = 1e4, what bore 1.35 times the weight, and at 1e6 the light
    disk was gone.
    """
    claims, figure = Claims(), Figure(figsize=(6.4, 3.4))
    axes = figure.add_subplot()
    for light, marker in ((1, "o"), (10, "s")):
        ratios, errors = (1e1, 1e2, 1e3, 1e4, 1e5, 1e6), []
        for ratio in ratios:
            shares, e, sunk = _column(light, ratio, 50)
            errors.append(max(abs(s - 1) for s in shares))
            name = f"{ratio:g} on {light}: "
            claims.at_most(name + "error of the floor's force in any step", errors[-1], 1e-3, WEIGHT)
            why = "overlaps of 1e-4 are left at each contact"
            claims.at_most(name + "sunk or lifted [d]", abs(sunk), 3e-4 * (light + 1), why)
            claims.near(name + "steps above the tolerance", e.unconverged, 0, "a count")
        axes.loglog(ratios, [max(x, 1e-9) for x in errors], marker=marker, label=f"on {light}")
    axes.axhline(1e-3, color="#777777", linewidth=0.7, linestyle="--")
    axes.set(xlabel="ratio of masses", ylabel="worst error of the floor's force")
    axes.legend(frameon=False)
    return Findings(claims, plots=[(figure, "Worst step of fifty; dashed: what is asked.")])


@check("A boulder on pebbles", subject="Statics", seconds=20)
def boulder_on_pebbles(bench):
    """A boulder of 1 m on rows of pebbles between two walls. At rest floor and walls bear the weight of all in every
    step. Masses are as the square of the sizes: 2,500 and 40,000.
    """
    claims, figure = Claims(), Figure(figsize=(6.4, 3.4))
    axes = figure.add_subplot()
    for sizes, rows in ((50, 2), (200, 1)):
        shares, e = _boulder(sizes, rows, 60)
        rests = shares[30:]
        axes.plot(shares, label=f"1 : {sizes}, {rows} row{'s' if rows > 1 else ''}")
        claims.at_most(
            f"1 : {sizes}: error of the force from step to step", max(abs(s - 1) for s in rests), 1e-3, WEIGHT
        )
        claims.near(f"1 : {sizes}: warnings", e.unsolved, 0, "a count")
    axes.set(xlabel="step", ylabel="force on floor and walls over weight")
    axes.legend(frameon=False)
    return Findings(claims, plots=[(figure, "From the first step on.")])
