"""Impacts that follow from impacts in the same step: chains of disks over small gaps, and an elastic gas."""

from __future__ import annotations

import math
import random

import numpy as np
from matplotlib.figure import Figure

from yade import O

from .claims import Claims, Findings
from .registry import check
from .small_scenes import begin, disk, material, run, wall

SPEED = 10.0  # m/s, of the first disk; 1 % of a diameter in a step of 1 ms
BLUE, RED, GREEN, GREY = "#0072B2", "#D55E00", "#009E73", "#777777"


def chain(count, gap, e, **options):
    """Disks of 1 m in a row with gaps [m], the first with SPEED; the bodies and the engine."""
    O.reset()
    stuff = material(0.0, restitution=e)
    disks = [disk((1 + gap) * k, 0, stuff) for k in range(count)]
    disks[0].state.vel = (SPEED, 0, 0)
    return disks, begin(**{"tolerance": 1e-8, **options})


def speeds(disks):
    """Speeds of the disks along x [m/s], (n,)."""
    return np.array([b.state.vel[0] for b in disks])


def in_order_of_time(count, gap, e, until):
    """Places and velocities of the same chain at the times ``until``, one impact after the other; the time of each."""
    x, v, now, found = (1 + gap) * np.arange(count), np.zeros(count), 0.0, []
    v[0] = SPEED
    for time in until:
        while True:
            closing = v[:-1] - v[1:]
            with np.errstate(divide="ignore"):
                when = np.where(closing > 1e-8, np.maximum(np.diff(x) - 1, 0) / closing, math.inf)
            k = int(np.argmin(when))
            if now + when[k] > time:
                break
            x, now = x + when[k] * v, now + when[k]
            change = 0.5 * (1 + e) * closing[k]
            v[k] -= change
            v[k + 1] += change
        x, now = x + (time - now) * v, time
        found.append((x.copy(), v.copy()))
    return found


def gas(count=50, width=3.0, **options):
    """Elastic disks in a box, at random; the engine and the disks."""
    O.reset()
    dice, stuff = random.Random(3), material(0.0, restitution=1)
    wall([(0, 0), (width, 0), (width, width), (0, width), (0, 0)], stuff, piece=2)
    disks = []
    while len(disks) < count:
        r = dice.uniform(0.07, 0.13)
        x, y = dice.uniform(r, width - r), dice.uniform(r, width - r)
        if all(math.hypot(x - b.state.pos[0], y - b.state.pos[1]) > r + b.shape.radius + 1e-4 for b in disks):
            disks.append(disk(x, y, stuff, radius=r, velocity=(dice.gauss(0, 3), dice.gauss(0, 3))))
    return begin(tolerance=1e-4, reach=0.2, **options), disks


def kinetic(disks):
    """Kinetic energy of the disks' translation [J/m]."""
    return sum(0.5 * b.state.mass * b.state.vel.squaredNorm() for b in disks)


@check("Impacts that follow from impacts in one step", subject="Impacts", seconds=20, quick=8)
def following_impacts(bench):
    """A disk with 10 m/s hits a row of others at rest, with gaps that are smaller than the 10 mm it goes in a step.
    Each disk that is hit hits the next in the same step. Newton's law for each impact in its turn gives, for equal
    disks, u = (1 − e) v/2 to the first and (1 + e) v/2 to the second. With e = 1 all speed goes to the last disk,
    whatever the gaps, and energy is kept. With e < 1 the wave gets slower and those behind catch up, again and again; a
    few lines of Python that look for the next impact and go there say where and how fast all disks are.

    If such impacts were left to the step's solve (``maxImpacts=0``), all but the first would stop without restitution,
    since their gaps have not closed at the step's beginning.

    In a gas of 50 elastic disks that fill half of a box, a part of the impacts is of this kind: energy is kept if these
    are followed, and lost if they are not.
    """
    claims, figure = Claims(), Figure(figsize=(10, 3.4), constrained_layout=True)
    kept, course, box = figure.subplots(1, 3)

    gaps = np.linspace(0, 0.02, 9 if bench.quick else 21)
    for count, colour in ((3, GREEN), (5, BLUE), (20, RED)):
        found = {}
        for most in (1000, 0):
            energies = []
            for gap in gaps:
                disks, e = chain(count, gap, 1.0, maxImpacts=most)
                run(30 + 2 * int(gap * (count - 1) / SPEED / O.dt))
                energies.append(speeds(disks) @ speeds(disks) / SPEED**2)
                if most and gap > 0:
                    off = np.abs(speeds(disks) - SPEED * (np.arange(count) == count - 1)).max()
                    found["speed"] = max(found.get("speed", 0), off)
            kept.plot(
                100 * gaps,
                energies,
                "o-" if most else "x:",
                color=colour,
                markersize=4,
                linewidth=0.8,
                label=f"{count} disks" + ("" if most else ", not followed"),
            )
            if most:
                found["energy"] = np.abs(np.array(energies) - 1).max()
        why = "without gaps the solve's tolerance, 1e-8, times the square of the length; else rounding"
        claims.at_most(f"{count} elastic disks, gaps to 2 %: largest change of energy", found["energy"], 1e-6, why)
        why = "rounding of 20 impacts at 10 m/s"
        claims.at_most(
            f"{count} elastic disks, gaps above 0: largest error of a speed [m/s]", found["speed"], 1e-9, why
        )
    kept.set(xlabel="gap [% of a diameter]", ylabel="energy after / before", ylim=(-0.02, 1.05))
    kept.legend(frameon=False, fontsize=6)

    times = np.arange(1, 41) * 2e-3
    for e, colour in ((1.0, GREEN), (0.9, BLUE), (0.5, RED)):
        for gap in (0.003, 0.0137):
            disks, engine = chain(5, gap, e)
            ours = []
            for _ in times:
                run(2)
                ours.append(([b.state.pos[0] for b in disks], speeds(disks)))
            known = in_order_of_time(5, gap, e, times)
            way = np.array([[np.array(x) - (1 + gap) * np.arange(5) for x, _ in series] for series in (ours, known)])
            why = "each impact is at its time; rounding"
            what = f"e = {e:g}, gaps of {100 * gap:g} %: largest error of a place in 80 ms [m]"
            claims.at_most(what, np.abs(way[0] - way[1]).max(), 1e-9, why, against="impacts in the order of time")
            what = f"e = {e:g}, gaps of {100 * gap:g} %: largest error of a speed at its end [m/s]"
            value = np.abs(ours[-1][1] - known[-1][1]).max()
            claims.at_most(what, value, 1e-9, why, against="impacts in the order of time")
            why = "rounding"
            what = f"e = {e:g}, gaps of {100 * gap:g} %: error of the energy balance [J]"
            claims.at_most(what, abs(engine.energyError), 1e-9 * 50 * disks[0].state.mass, why)
            if gap == 0.003:
                for k in range(5):
                    course.plot(
                        1e3 * times,
                        1e3 * way[1][:, k],
                        "-",
                        color=colour,
                        linewidth=0.6,
                        label=f"e = {e:g}" if k == 0 else None,
                    )
                    course.plot(1e3 * times[::3], 1e3 * way[0][::3, k], ".", color=colour, markersize=3)
    course.set(xlabel="time [ms]", ylabel="way of each disk [mm]", ylim=(-5, 200))
    course.legend(frameon=False, fontsize=7)

    seconds = 1 if bench.quick else 5
    for most, colour, name in ((1000, BLUE, "followed"), (0, RED, "not followed")):
        bench.progress(f"gas, {name}")
        engine, disks = gas(maxImpacts=most)
        first, series = kinetic(disks), [1.0]
        for _ in range(50):
            run(20 * seconds)
            series.append(kinetic(disks) / first)
        box.plot(np.linspace(0, seconds, 51), series, color=colour, linewidth=1, label=name)
        lost = 1 - series[-1]
        if most:
            why = (
                "impacts on walls that stay alone are the solve's, whose tolerance is 1e-4 of their impulses, up and "
                "down"
            )
            claims.at_most("elastic gas: largest change of energy", np.abs(np.array(series) - 1).max(), 1e-5, why)
            why = "rounding"
            claims.at_most("elastic gas: error of the energy balance", abs(engine.energyError) / first, 1e-9, why)
            why = "at a wall a disk bounces one step early; others pass it meanwhile by (h v)²/2 ℓ"
            claims.at_most("elastic gas: largest overlap [ℓ]", engine.overlapWorstEver, 1e-3, why)
        else:
            why = "e = 1: all that is lost is missed; rounding"
            what = "elastic gas, not followed: what is told to be missed"
            claims.near(what, engine.missedRestitution / first, lost, why, relative=0.01)
    box.set(xlabel="time [s]", ylabel="energy of the gas / at the beginning")
    box.legend(frameon=False)
    caption = (
        "Left: energy that a chain of elastic disks keeps, by its gaps. Middle: ways of five disks with gaps of 3 mm; "
        "lines: impacts in the order of time, dots: computed. Right: energy of a gas of 50 elastic disks."
    )
    plot = figure, caption
    return Findings(claims, plots=[plot])
