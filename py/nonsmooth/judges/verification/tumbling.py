"""Bonded bodies that turn: freely for many turns, and down a slope with its jumps."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.collections import EllipseCollection
from matplotlib.figure import Figure

from yade import O

from ...world import tables
from .claims import Claims, Findings
from .registry import check
from .small_scenes import DENSITY, G, begin, disk, engine, material, set_gravity, wall

STRENGTH = 1e9  # Pa: no bond here bears a hundredth of it
# ContactDynamicsEngine.correctionSlack [ℓ]; two angles half a diameter from a contact may differ by twice that
SLACK = 1e-4
MASS = DENSITY * math.pi * 0.25  # of a disk of 1 m [kg/m]


def boulder(rings):
    """Places [m] of disks of 1 m in a hexagon around the origin: 7, 19, 37, …, 397 disks for 1, 2, 3, …, 11 rings; a
    pair for none.
    """
    if rings == 0:
        return np.array([(-0.5, 0.0), (0.5, 0.0)])
    side = range(-rings, rings + 1)
    return np.array([(i + 0.5 * j, j * math.sqrt(0.75)) for i in side for j in side if abs(i + j) <= rings])


class Boulder:
    """Disks that are bonded where they touch, turning with ``omega`` [rad/s] about ``at``, which moves with
    ``drift``.
    """

    def __init__(self, rings, omega, at=(0, 0), drift=(0, 0), stuff=None):
        self.places, self.omega = boulder(rings), omega
        stuff = stuff or material(1.0, 0.5, tensileStrength=STRENGTH)
        self.disks = [disk(*(np.array(at) + p), stuff) for p in self.places]
        self.drift = np.array(drift, float)

    def bond(self):
        """Bonds the disks, which takes a step to find contacts, and sets them in motion."""
        start = [(d.state.pos, d.state.ori) for d in self.disks]
        engine().advance(1)
        self.bonds = engine().bond()
        for d, (place, turn), (x, y) in zip(self.disks, start, self.places):
            d.state.pos, d.state.ori = place, turn
            d.state.vel = (self.drift[0] - self.omega * y, self.drift[1] + self.omega * x, 0)
            d.state.angVel = (0, 0, self.omega)
        engine().forgetEnergies()

    def look(self):
        """Now: angles of the disks and of the boulder [rad], largest relative error of a distance, angular momentum
        about the origin and energy.
        """
        table = tables.bodies(engine())
        row = {int(k): n for n, k in enumerate(table["id"])}
        at = [row[d.id] for d in self.disks]
        x, y, spin, vx, vy, w = (table[c][at] for c in ("x", "y", "angle", "vx", "vy", "omega"))
        chord, first = np.array([x[-1] - x[0], y[-1] - y[0]]), self.places[-1] - self.places[0]
        orbit = math.atan2(chord[1], chord[0]) - math.atan2(first[1], first[0])
        apart = np.abs((spin - orbit + math.pi) % (2 * math.pi) - math.pi)
        away = np.hypot(*(self.places - self.places[0]).T)[1:]
        stretch = np.abs(np.hypot(x - x[0], y - y[0])[1:] / away - 1)
        angular = np.sum(MASS * (x * vy - y * vx) + MASS * 0.125 * w)
        energy = np.sum(0.5 * MASS * (vx**2 + vy**2) + 0.5 * MASS * 0.125 * w**2)
        return apart.max(), stretch.max(), angular, energy

    @property
    def lost(self):
        """Number of bonds that have broken."""
        e = engine()
        return e.brokenTension + e.brokenShear + e.brokenTorque + e.brokenMixed


def turn_freely(rings, omega, dt, turns, looks=20):
    """Rows (turns, difference of spin and orbit [rad], stretch, error of angular momentum and of energy, relative) and
    what the balance lists.
    """
    O.reset()
    it = Boulder(rings, omega)
    begin(dt=dt, tolerance=1e-8)
    it.bond()
    _, _, angular, energy = it.look()
    every = max(1, round(turns * 2 * math.pi / abs(omega) / dt / looks))
    rows = []
    for _ in range(looks):
        engine().advance(every)
        apart, stretch, now, kept = it.look()
        rows.append(
            (O.time * abs(omega) / (2 * math.pi), apart, stretch, abs(now / angular - 1), abs(kept / energy - 1))
        )
    e = engine()
    gone = abs(e.slidingLoss) + abs(e.rollingLoss) + abs(e.impactLoss)
    return np.array(rows), it.lost, e.debondingLoss, gone / energy, abs(e.correctionEnergy) / energy


@check("Bonded bodies that turn freely", subject="Bonds", seconds=90, quick=12)
def tumbling(bench):
    """Two bonded disks, and boulders of 7, 37 and 397, turn freely about their centre of mass, without gravity. Nothing
    acts from outside, and no bond bears as much as it can: so they keep their shape, each disk turns with the whole,
    and angular momentum and energy stay. A bond that holds does no work: nothing is lost in debonding, sliding or
    rolling.

    Each body's own step, x + h v and φ + h ω, would have the spins ahead of the orbit by ωh − arctan ωh in each step.
    Bodies that bonds hold together are turned as one instead (pkg/contact/plane/rigid_clusters.hpp). Rates from 0.1 to
    100 rad/s, steps from 0.1 to 10 ms, up to 0.1 rad a step; the pair and 37 disks for a thousand turns (fifty in a
    quick run).
    """
    many = 50 if bench.quick else 1000
    cases = [
        (0, 10, 1e-2, many),
        (0, 10, 1e-3, 10 if bench.quick else 100),
        (0, 100, 1e-4, 10 if bench.quick else 100),
        (0, 0.1, 1e-2, 1),
        (3, 10, 1e-2, many),
        (3, 100, 1e-3, 10 if bench.quick else 100),
        (1, 1, 1e-2, 5),
        (11, 10, 5e-3, 2 if bench.quick else 10),
    ]
    claims, figure = Claims(), Figure(figsize=(10, 3.6), layout="constrained")
    left, right = figure.subplots(1, 2, gridspec_kw={"wspace": 0.08})
    for rings, omega, dt, turns in cases:
        name = f"{len(boulder(rings))} disks, {omega:g} rad/s, steps of {dt * 1e3:g} ms, {turns} turns"
        bench.progress(name)
        rows, lost, debonding, gone, correction = turn_freely(rings, omega, dt, turns)
        claims.at_most(name + ": bonds lost", lost, 0, "none bears more than it can")
        why = "the slack of corrections, half a diameter from the contact"
        claims.at_most(name + ": spin and orbit apart [rad]", rows[:, 1].max(), 2 * SLACK, why)
        claims.at_most(name + ": stretch", rows[:, 2].max(), 2 * SLACK, "the slack of corrections, either way")
        claims.at_most(name + ": angular momentum [of the first]", rows[:, 3].max(), 1e-9, "rounding of the steps")
        why = "the solve's tolerance, 1e-8, step by step"
        claims.at_most(name + ": energy [of the first]", rows[:, 4].max(), 1e-4, why)
        claims.at_most(name + ": debonding loss [J]", abs(debonding), 0, "nothing yields")
        claims.at_most(name + ": sliding, rolling and impact losses [of the energy]", gone, 1e-5, why)
        claims.at_most(name + ": energy of corrections [of the whole]", correction, 1e-4, "as the energy itself")
        label = f"{len(boulder(rings))} disks, {omega:g} rad/s, {dt * 1e3:g} ms"
        left.loglog(rows[:, 0], np.maximum(rows[:, 1], 1e-16), ".-", lw=1, ms=3, label=label)
        right.loglog(rows[:, 0], np.maximum(rows[:, 4], 1e-17), ".-", lw=1, ms=3)
    pair = 10 * 1e-2 - math.atan(10 * 1e-2)
    turns = np.geomspace(0.05, 3)
    left.loglog(turns, pair * turns * 2 * math.pi / 0.1, "k:", lw=1)
    left.annotate("each body by itself, 0.1 rad a step", (0.04, 0.1), fontsize=7)
    left.axhline(2 * SLACK, color="0.6", lw=0.8)
    left.set(xlabel="turns", ylabel="spin and orbit apart [rad]", ylim=(1e-16, 1))
    right.set(xlabel="turns", ylabel="energy, relative error", ylim=(1e-17, 1e-2))
    right.legend(
        *left.get_legend_handles_labels(), loc="center left", bbox_to_anchor=(1, 0.5), fontsize=7, frameon=False
    )
    caption = (
        "Left: how far the spin of any disk is from the orbit of the whole (grey: what corrections leave; dotted: "
        "without turning bodies as one). Right: the energy."
    )
    plot = figure, caption
    return Findings(claims, plots=[plot])


def let_down(rings, dt, seconds, tolerance):
    """A boulder let go above a slope of 40° with a step in it, a valley and a counter slope; returns it and outlines
    (time, x, y) of its places.
    """
    O.reset()
    ground = material(0.5, 0.05, wall=True)
    wall([(-60, 50.35), (-30, 25.17), (-28, 20), (0, -3.5), (40, -3.5), (60, 16.5)], ground, piece=5)
    it = Boulder(rings, -2, at=(-48, 45 + 1.3 * rings), drift=(2, 0))
    begin(dt=dt, tolerance=tolerance)
    it.bond()
    set_gravity(0, -G)
    outlines = []
    every = 0.75
    while O.time < seconds:
        outlines.append((O.time, *np.array([(d.state.pos[0], d.state.pos[1]) for d in it.disks]).T))
        engine().advance(until=O.time + every)
    return it, outlines


@check("A bonded boulder tumbles down a slope in one piece", subject="Bonds", seconds=40, quick=6)
def boulder_on_a_slope(bench):
    """A boulder of bonded disks falls onto a slope of 40°, jumps and rolls over a step in it to the valley. Impacts are
    inelastic and no bond bears as much as it can, so the boulder must arrive in one piece, of the shape that it had,
    every disk turned as the whole. What the solver's tolerance lets bonds slip in an impact is taken back in the steps
    after it.
    """
    claims, figure = Claims(), Figure(figsize=(8, 4), layout="constrained")
    axes = figure.subplots()
    cases = (
        [(1, 1e-3, 1e-4), (3, 2e-3, 1e-4)]
        if bench.quick
        else [(1, 1e-3, 1e-4), (3, 2e-3, 1e-4), (3, 1e-4, 1e-5), (11, 2e-3, 1e-5)]
    )
    for rings, dt, tolerance in cases:
        count = len(boulder(rings))
        name = f"{count} disks, steps of {dt * 1e3:g} ms, tolerance {tolerance:g}"
        bench.progress(name)
        it, outlines = let_down(rings, dt, 9 if dt > 2e-4 else 4, tolerance)
        apart, stretch, _, _ = it.look()
        claims.near(name + ": bonds at the end", engine().bonds, it.bonds, "none bears more than it can")
        why = "the slack, and what the last impacts have left"
        claims.at_most(name + ": spins apart from the whole [rad]", apart, 20 * SLACK, why)
        claims.at_most(name + ": stretch", stretch, 10 * SLACK, "the same")
        if count == 37 and dt == 2e-3:
            for _, x, y in outlines:
                size = np.ones_like(x)  # diameters [m]
                disks = EllipseCollection(size, size, 0 * x, units="xy", offsets=np.column_stack([x, y]))
                disks.set(facecolor="tab:blue", edgecolor="white", linewidth=0.3, offset_transform=axes.transData)
                axes.add_collection(disks)
    axes.plot([-60, -30, -28, 0, 40, 60], [50.35, 25.17, 20, -3.5, -3.5, 16.5], color="0.4")
    axes.set(aspect="equal", xlabel="x [m]", ylabel="y [m]")
    return Findings(claims, plots=[(figure, "37 bonded disks every 0.75 s on their way down.")])
