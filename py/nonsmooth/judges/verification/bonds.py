"""Bonds: thresholds in each mode and combined, the ellipse, and rows of bonded disks that break where statics says."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Ellipse
from scipy.optimize import brentq

from yade import O

from ...world import tables
from .claims import Claims, Findings
from .registry import check
from .small_scenes import G, begin, contacts, disk, engine, material, run, set_gravity, weight

RADIUS = 0.5
LENGTH = 2 * RADIUS
SIGMA, FRICTION, ROLLING = 1e5, 0.3, 0.1
F_A = SIGMA * LENGTH
PUSH = 2e5  # N, the compression of some cases
JUST = 1e-6  # relative distance from a threshold that must be told
LEAST = 1e-10  # m/s: motion that counts; the solve leaves 1e-12 of F h/m = 2 m/s at most
DIGITS = "bisection to 1e-9; the least motion that counts, 1e-10 m/s, takes up to 6e-9 of a threshold of 3 kN"
RESIDUAL = dict(
    residualTensileStrength=0.25 * SIGMA, residualFrictionAngle=math.atan(0.2), residualRollingFriction=0.05
)


class Pair:
    """A fixed disk and a free one at ``angle`` to it, bonded; loads are given in the contact's frame."""

    def __init__(self, angle=0.0, zone=(1e-4, 1e-4), bonded=True, dt=0.02, **more):
        O.reset()
        self.c, self.s = math.cos(angle), math.sin(angle)
        stuff = material(
            FRICTION, ROLLING, tensileStrength=SIGMA, bondEllipseNormal=zone[0], bondEllipseTangential=zone[1], **more
        )
        self.fixed = disk(0, 0, stuff, fixed=True)
        self.free = disk(LENGTH * self.c, LENGTH * self.s, stuff)
        self.state, self.start, self.turn = self.free.state, self.free.state.pos, self.free.state.ori
        begin(dt=dt)
        run(1)
        if bonded:
            engine().bond()

    def load(self, normal=0.0, shear=0.0, torque=0.0):
        """Compression and shear [N] at the contact point on the free disk, torque about it [N m]."""
        O.forces.setPermF(self.free.id, (-normal * self.c - shear * self.s, -normal * self.s + shear * self.c, 0))
        # takes back the moment that the shear's lever makes
        O.forces.setPermT(self.free.id, (0, 0, torque - RADIUS * shear))

    @property
    def speed(self):
        """Of the centre and of the rim together [m/s]."""
        return self.state.vel.norm() + RADIUS * abs(self.state.angVel[2])

    def moves_under(self, loads):
        """Whether one step from rest, under these loads, sets the disk in motion."""
        self.state.pos, self.state.ori, self.state.vel, self.state.angVel = self.start, self.turn, (0, 0, 0), (0, 0, 0)
        self.load(**loads)
        run(1)
        return self.speed > LEAST

    def threshold(self, loads):
        """Greatest x for which ``loads(x)`` is carried, between 0.5 and 1.5, by bisection."""
        low, high = 0.5, 1.5
        while high - low > 1e-9:
            x = 0.5 * (low + high)
            low, high = (low, x) if self.moves_under(loads(x)) else (x, high)
        return 0.5 * (low + high)


def cases(adhesion, friction, rolling):
    """{name: (how it breaks or None, overload at which it is seen to break, loads as a function of x)}; x = 1 is the
    threshold.
    """
    pull = -0.5 * adhesion

    def shear(n):
        return friction * (adhesion + n)

    def torque(n):
        return rolling * LENGTH * (adhesion + n)

    return {
        "tension": ("tension", JUST, lambda x: dict(normal=-adhesion * x)),
        "shear": ("shear", JUST, lambda x: dict(shear=shear(0) * x)),
        "shear under compression": ("shear", JUST, lambda x: dict(normal=PUSH, shear=shear(PUSH) * x)),
        "shear under tension": ("shear", 1e-3, lambda x: dict(normal=pull, shear=-shear(pull) * x)),
        "torque": ("torque", JUST, lambda x: dict(torque=-torque(0) * x)),
        "torque under compression": ("torque", JUST, lambda x: dict(normal=PUSH, torque=torque(PUSH) * x)),
        "torque under tension": ("torque", 0.5, lambda x: dict(normal=pull, torque=torque(pull) * x)),
        "shear with 0.9 of the greatest torque": (
            "shear",
            JUST,
            lambda x: dict(normal=PUSH, shear=shear(PUSH) * x, torque=0.9 * torque(PUSH)),
        ),
        "torque with 0.9 of the greatest shear": (
            "torque",
            JUST,
            lambda x: dict(normal=PUSH, shear=0.9 * shear(PUSH), torque=torque(PUSH) * x),
        ),
        "shear and torque together": (
            None,
            JUST,
            lambda x: dict(normal=PUSH, shear=shear(PUSH) * x, torque=torque(PUSH) * x),
        ),
    }


def _breaks_as(pair):
    """Runs until the bond breaks; returns how, or 'not at all' within 10,000 steps."""
    for _ in range(10000):
        O.step()
        if engine().bonds == 0:
            return tables.BREAK_MODES[tables.breaks(engine())["mode"][0]]
    return "not at all"


@check("Thresholds of a bond", subject="Bonds", seconds=1)
def bond_thresholds(bench):
    """A bonded pair under a steady load stands still while (N, T, Γ) that balance the load lie within their thresholds:
    N at least −F_a, T at most μ_s (F_a + N) and Γ at most μ_r ℓ (F_a + N) in magnitude, with F_a = σ ℓ (eqs 1 to 6 of
    Taboada and Estrada 2009). One disk is fixed, so the balance has one solution, and the threshold is the load at
    which the other begins to move. Shear force and torque have thresholds of their own, which know of each other only
    through N: together they do not weaken the bond.

    The threshold is found by bisection, each trial one step from rest. Then, in fresh scenes, a bond under 1 − 1e-6 of
    it must hold for 300 steps and one under 1 + 1e-6 must break, by the mode that was loaded. Its ellipse is small here
    (1e-4 ℓ) so that this does not take long. Two cases need more load to break: tension straightens a bond that slips
    (by T d/ℓ, 3e-4 of the threshold at the ellipse's edge) or rolls (by some 7e-2), since the load keeps its direction.
    """
    claims, rows = Claims(), []
    for angle in (0.0, 2.0):
        for name, (mode, overload, loads) in cases(F_A, FRICTION, ROLLING).items():
            bench.progress(name)
            found = Pair(angle).threshold(loads)
            where = f"{name}, at {angle:g} rad"
            claims.near(where + ": threshold [of the derived one]", found, 1, DIGITS, relative=1e-8)
            pair = Pair(angle)
            pair.load(**loads(1 - JUST))
            run(300)
            moved = (pair.state.pos - pair.start).norm() if engine().bonds else math.inf
            why = "it rests, bonded; a yield of 1e-6 of the load would have moved it by 1e-3 m"
            claims.at_most(where + ": move in 6 s at 1 − 1e-6 [m]", moved, 1e-9, why)
            pair = Pair(angle)
            pair.load(**loads(1 + overload))
            ended = _breaks_as(pair)
            if mode:
                why = "it must be the mode that was loaded"
                claims.near(f"{where}: broke by {ended} at 1 + {overload:g}", ended == mode, 1, why)
            rows.append([name, f"{angle:g}", f"{found:.10f}", f"1 + {overload:g}", ended])
    heads = ["load", "angle", "threshold", "overload", "ended by"]
    table = "Thresholds found, in units of the derived ones, and how the bond ended above them", heads, rows
    return Findings(claims, tables=[table])


@check("Residual strength of a contact without a bond", subject="Bonds", seconds=1)
def residual_thresholds(bench):
    """Two touching disks without a bond obey the same three thresholds with the residual strengths: F_a = σ_res ℓ, and
    μ_s and μ_r of their own (Taboada and Estrada 2009, section 2.2). The pair's bond is taken away by hand; thresholds
    are then found by bisection as for the bond.
    """
    claims, found = Claims(), {}
    for name, (_, _, loads) in cases(0.25 * F_A, 0.2, 0.05).items():
        pair = Pair(angle=2.0, **RESIDUAL)
        engine().unbond()
        found[name] = pair.threshold(loads)
        claims.near(name + ": threshold [of the derived one]", found[name], 1, DIGITS, relative=1e-8)
    return Findings(claims)


@check("A bond breaks where its mark leaves the ellipse", subject="Bonds", seconds=1)
def bond_ellipse(bench):
    """A bond that yields lives until the point marked on one disk has left an ellipse fixed to the other, with the
    half-axes ε_n ℓ and ε_t ℓ (Figure 2b of Taboada and Estrada 2009). Three kinds of motion are forced on a pair, each
    so slowly that 1,000 steps lead to the edge (300 in a quick run); the step in which the bond ends is then known to
    one step's move.

    *Straight.* A free disk so heavy (1e12 kg) that no threshold slows it moves off at an angle φ to the normal, without
    turning. The mark moves as the disk, so the bond breaks after the path ℓ / √((cos φ/ε_n)² + (sin φ/ε_t)²): ε_n ℓ
    along the normal, ε_t ℓ along the tangent. Along the normal it resists with F_a all the way and takes F_a ε_n ℓ.

    *Sliding under compression.* The other disk is driven along the tangent; the free one, too heavy to turn, may move
    along the first normal only, and a force P presses it on. It goes round a circle of radius ℓ, so after the sideways
    path y the normal displacement is √(ℓ² − y²) − ℓ. With α the turn of the normal, N cos α − T sin α = P and T = μ_s
    (F_a + N), which sliding dissipates over ℓ dα.

    *Rolling under compression.* The other disk turns by ψ where it is; the free one rolls on it and may move along the
    first normal and turn. In the frame of the driven disk the mark draws a cardioid, d_n = ℓ cos ψ (1 − cos ψ) and d_t
    = ℓ sin ψ (1 − cos ψ): for small ψ it moves along the normal by ℓ ψ²/2. The torque μ_r ℓ (F_a + P) works over the
    relative rotation 2 ψ; it needs T = 2 μ_r (F_a + P), which is below the shear threshold as 2 μ_r < μ_s.
    """
    claims, zone, steps = Claims(), (0.02, 0.05), 300 if bench.quick else 1000
    one_step = f"one step's move, 1/{steps} of the way"
    ends, worst = [], 0.0
    for degrees in (0, 30, 60, 90) if bench.quick else range(0, 91, 10):
        pair, phi = Pair(zone=zone, dt=1e-3), math.radians(degrees)
        path = LENGTH / math.hypot(math.cos(phi) / zone[0], math.sin(phi) / zone[1])
        pair.state.mass = 1e12
        pair.state.inertia = (1e12,) * 3
        speed = path / (steps - 0.5) / O.dt
        pair.state.vel = (speed * math.cos(phi), speed * math.sin(phi), 0)
        engine().forgetEnergies()
        went, taken = _until_broken(lambda: ((pair.state.pos - pair.start).norm(), engine().debondingLoss), 2 * steps)
        ends.append((went * math.cos(phi), went * math.sin(phi)))
        worst = max(worst, abs(went / path - 1))
        if degrees == 0:
            claims.near(
                "energy that a bond takes in tension [J]",
                taken,
                F_A * zone[0] * LENGTH,
                one_step,
                relative=1.01 / steps,
            )
            claims.near("mode of the break along the normal (1 is tension)", contacts()[0].phys.brokenMode, 1, "a name")
    what = f"straight: largest relative error of the path over {len(ends)} directions"
    claims.at_most(what, worst, 1.01 / steps, one_step)

    pair = Pair(zone=(0.05, 0.02), dt=1e-3)
    path = brentq(
        lambda y: (y / (0.02 * LENGTH)) ** 2 + ((LENGTH - math.sqrt(LENGTH**2 - y**2)) / (0.05 * LENGTH)) ** 2 - 1,
        0,
        0.02 * LENGTH,
    )
    pair.state.blockedDOFs = "yzXY"
    pair.state.inertia = (1e12,) * 3
    pair.load(normal=PUSH)
    run(1)
    engine().forgetEnergies()
    pair.fixed.state.vel = (0, path / (steps - 0.5) / O.dt, 0)
    went, taken = _until_broken(lambda: (pair.fixed.state.pos[1], engine().slidingLoss), 2 * steps)
    alpha = np.linspace(0, -math.asin(went / LENGTH), 400)
    normal = (PUSH + FRICTION * F_A * np.sin(alpha)) / (np.cos(alpha) - FRICTION * np.sin(alpha))
    force = FRICTION * (F_A + normal)
    loss = LENGTH * np.sum(0.5 * (force[1:] + force[:-1]) * -np.diff(alpha))
    claims.near("sliding: path [m]", went, path, one_step, relative=1.01 / steps)
    why = f"the normal is that of a step's beginning: 1/{steps} of its turn, 0.02"
    claims.near("sliding: energy [J]", taken, loss, why, relative=0.02 / steps)
    claims.near("mode of the break (2 is shear)", contacts()[0].phys.brokenMode, 2, "a name")

    pair = Pair(zone=zone, dt=1e-2)
    angle = brentq(lambda a: math.hypot(math.cos(a) / zone[0], math.sin(a) / zone[1]) * (1 - math.cos(a)) - 1, 0, 1)
    pair.state.blockedDOFs = "yzXY"
    pair.load(normal=PUSH)
    run(1)
    engine().forgetEnergies()
    spin = angle / (steps - 0.5) / O.dt
    pair.fixed.state.angVel = (0, 0, spin)
    began = O.iter
    went, taken = _until_broken(lambda: (spin * O.dt * (O.iter - began), engine().rollingLoss), 2 * steps)
    claims.near("rolling: angle [rad]", went, angle, one_step, relative=1.01 / steps)
    why = "one step's move, and half a step in which the disk begins to turn"
    claims.near("rolling: energy [J]", taken, ROLLING * LENGTH * (F_A + PUSH) * 2 * angle, why, relative=1.51 / steps)
    claims.near("mode of the break (3 is torque)", contacts()[0].phys.brokenMode, 3, "a name")
    figure = Figure(figsize=(5, 4))
    axes = figure.add_subplot()
    axes.add_patch(Ellipse((0, 0), 2 * zone[0], 2 * zone[1], fill=False, linewidth=1))
    axes.plot(*np.array(ends).T / LENGTH, "o", markersize=4)
    axes.set(xlabel="d_n [ℓ]", ylabel="d_t [ℓ]", xlim=(-0.03, 0.03), ylim=(-0.06, 0.06))
    plot = figure, "Where the mark was when the bond broke, for straight paths; the ellipse is drawn."
    return Findings(claims, plots=[plot])


def _until_broken(read, most):
    """``read()``, two numbers, at the beginning of the step in which the one bond ends; nan if it lives for ``most``
    steps.
    """
    for _ in range(most):
        then = read()
        O.step()
        if engine().bonds == 0:
            return then
    return math.nan, math.nan


def row_of_disks(count, strength, both_ends=False, rolling=ROLLING, friction=FRICTION, zone=0.02):
    """A horizontal row of free disks, bonded to each other and to a fixed disk at one end or at both, before gravity
    acts; returns the free disks.

    ``strength``: F_a in units of one disk's weight.
    """
    O.reset()
    sigma = strength * math.pi * RADIUS**2 * 2500 * G / LENGTH
    stuff = material(friction, rolling, tensileStrength=sigma, bondEllipseNormal=zone, bondEllipseTangential=zone)
    disk(0, 0, stuff, fixed=True)
    disks = [disk(LENGTH * k, 0, stuff) for k in range(1, count + 1)]
    if both_ends:
        disk(LENGTH * (count + 1), 0, stuff, fixed=True)
    begin(dt=5e-3)
    run(1)
    engine().bond()
    set_gravity(0, -G)
    return disks


def _first_breaks(most):
    """Runs until a bond breaks; returns the pairs that broke in that step and the modes, empty lists if none does in
    ``most`` steps.
    """
    for _ in range(most):
        O.step()
        broken = tables.breaks(engine())
        if len(broken["step"]):
            return list(zip(broken["id1"].tolist(), broken["id2"].tolist())), [
                tables.BREAK_MODES[m] for m in broken["mode"]
            ]
    return [], []


@check("A bonded row held at one end", subject="Bonds", seconds=1)
def cantilever(bench):
    """n disks of weight w and diameter d stand out from a fixed one in a horizontal row. The contact that carries the
    last k of them bears no normal force, the shear force k w and the moment of their weights about it, w (d/2 + 3 d/2 +
    …) = w d k²/2. Each disk has three balances and each contact three reactions: the row is statically determined. The
    root bears most, n w against μ_s F_a and w d n²/2 against μ_r d F_a. So with A = F_a/w

    * the moment governs if √(2 μ_r A) < μ_s A, and then the longest row that holds has n ≤ √(2 μ_r A);
    * else shear does, and n ≤ μ_s A.

    Four cases. With μ_r = 0.1 and A = 281, √(2 μ_r A) = 7.5: seven disks hold, eight break by torque at the root. With
    μ_r = 1 and A = 15, μ_s A = 4.5 (against √(2 μ_r A) = 5.5): four hold, five break by shear at the root. And with
    eight disks, F_a a part in 1e5 above and below n² w/(2 μ_r): the row rests, or begins to turn about its root as one
    piece, driven by what the root does not bear.
    """
    claims, rows = Claims(), []
    for name, strength, rolling, holds in (("torque", 7.5**2 / (2 * 0.1), 0.1, 7), ("shear", 15.0, 1.0, 4)):
        bench.progress(name)
        disks = row_of_disks(holds, strength, rolling=rolling)
        start = [b.state.pos for b in disks]
        run(200)
        one, worst = weight(disks[0]), 0.0
        for k, i in enumerate(contacts()):
            left = holds - k
            shear, moment = left * one, left**2 / 2 * one * LENGTH
            worst = max(
                worst,
                abs(i.phys.normal) / one,
                abs(abs(i.phys.tangential) / shear - 1),
                abs(abs(i.phys.torque) / moment - 1),
            )
            rows.append(
                [
                    f"{holds} disks, contact {k + 1}",
                    f"{i.phys.normal / one:.1e}",
                    f"{i.phys.tangential / one:.6f} ({shear / one:g})",
                    f"{i.phys.torque / one / LENGTH:.6f} ({moment / one / LENGTH:g})",
                ]
            )
        claims.near(f"{name} governs: bonds of {holds} disks after 1 s", engine().bonds, holds, "a count")
        why = "it rests; one step's fall is 2.5e-4 m, and 200 steps are solved to 1e-12 times a condition number of n⁴"
        claims.at_most(
            f"{holds} disks: farthest move [m]", max((b.state.pos - p).norm() for b, p in zip(disks, start)), 1e-8, why
        )
        why = "residual 1e-12, condition number n⁴ or a few 1e3, and a margin"
        claims.at_most(f"{holds} disks: largest relative error of a reaction", worst, 1e-7, why)
        disks = row_of_disks(holds + 1, strength, rolling=rolling)
        pairs, modes = _first_breaks(2000)
        why = f"it must be; what broke: {pairs}, {modes}"
        what = f"{holds + 1} disks: the first bond to break is the root's, by {name}"
        claims.near(what, (pairs, modes) == ([(0, 1)], [name]), 1, why)
    claims += _edge(
        "eight disks", lambda strength: row_of_disks(8, strength), 8**2 / (2 * ROLLING), moment=8**2 / 2, turning=8
    )
    heads = ["contact", "N/w", "T/w", "Γ/(w d)"]
    table = "Reactions in units of the weight w and w d; in brackets, from statics", heads, rows
    return Findings(claims, tables=[table])


def _edge(name, build, strength, moment, turning, margin=1e-5):
    """Claims that a row rests with F_a/w a little above ``strength``, and begins to turn as derived with a little less.

    ``moment``: what hinges must bear [w d]; ``turning``: disks in a straight piece that turns about its end.
    """
    speeds = []
    for side in (1, -1):
        build(strength * (1 + side * margin))
        run(3)
        speeds.append(engine().maxSpeed)
    # of the piece about its end contact, in m d²: Σ 1/8 + (k − 1/2)²
    inertia = turning / 8 + turning**3 / 3 - turning / 12
    expected = margin * moment * G / inertia * 3 * O.dt * (turning - 0.5)
    claims = Claims()
    why = "it rests; a step's fall is 0.05 m/s, solved to 1e-12 times a condition number of n⁴"
    claims.at_most(f"{name}, F_a 1e-5 above what statics asks for: fastest disk [m/s]", speeds[0], 1e-9, why)
    why = "1e-5 of the moment is known to the same error, 1e-9, four digits"
    claims.near(
        f"{name}, F_a 1e-5 below: fastest disk after three steps [m/s]", speeds[1], expected, why, relative=1e-3
    )
    return claims


@check("A bonded row held at both ends", subject="Bonds", seconds=1)
def bridge(bench):
    """n disks hang in a horizontal row between two fixed disks by n + 1 bonds. Rigid bonds have no stiffness to share
    the load by, so statics leaves the moments of the ends open; a rigid-plastic structure stands as long as some
    distribution within the thresholds balances the load (static theorem of limit analysis), which the solver finds if
    there is one. While the row is straight, weights make no normal force, so the thresholds are constants, M_p = μ_r d
    F_a and μ_s F_a, and the theorem holds.

    With freely turning ends the moment at the contact after c disks would be w d c (n − c)/2. End moments M shift it to
    w d c (n − c)/2 − M. All stay within ± M_p if and only if the greatest is at most 2 M_p: w d n²/8 ≤ 2 M_p for even
    n, w d (n² − 1)/8 for odd n. Collapse has three hinges, at both ends and in the middle (two beside the middle disk
    for odd n). Shear asks for n w/2 ≤ μ_s F_a. With A = F_a/w the row holds for n² ≤ 16 μ_r A (n² − 1 for odd n) if n ≤
    2 μ_s A. With μ_r = 0.1 and A = 45 these are 72 and 27: eight disks hold (64), nine do not (80).

    Hinges that turn lengthen a row between fixed ends. This is of second order in the sag, but rigid bonds that
    lengthen pull with all of F_a, and with N = −F_a the other two thresholds vanish. So nothing is left of the strength
    once a row sags: it falls, and how its bonds end then is no matter of statics. Statics says where it begins to turn,
    which is read from the first step's velocities, and how fast: with F_a a part in 1e5 too small, the halves of a row
    of eight turn about their ends, each driven by that part of w d n²/8.
    """
    claims, strength = Claims(), 45.0
    bench.progress("holds")
    disks = row_of_disks(8, strength, both_ends=True)
    start = [b.state.pos for b in disks]
    run(200)
    claims.near("eight disks: bonds after 1 s", engine().bonds, 9, "a count")
    if not claims[0].passed:
        return Findings(claims, remarks=["The row of eight did not hold; nothing else was looked at."])
    one, torques = weight(disks[0]), np.array([i.phys.torque for i in contacts()])
    limit = ROLLING * strength
    why = "it rests; one step's fall is 2.5e-4 m"
    claims.at_most(
        "eight disks: farthest move [m]", max((b.state.pos - p).norm() for b, p in zip(disks, start)), 1e-8, why
    )
    why = "the threshold itself; rounding"
    claims.at_most("eight disks: largest moment, in M_p", np.abs(torques).max() / (limit * one * LENGTH), 1 + 1e-9, why)
    why = "balance: w d n²/8, whatever the ends bear; residual 1e-12 times the condition number"
    what = "eight disks: moment of an end less that of the middle, in w d"
    claims.near(what, abs(torques[0] - torques[4]) / one / LENGTH, 8, why, relative=1e-6)
    disks = row_of_disks(9, strength, both_ends=True)
    run(1)
    spins = np.array([0.0, *(b.state.angVel[2] for b in disks), 0.0])
    turns = np.abs(np.diff(spins)) / np.abs(np.diff(spins)).max()
    hinges = np.flatnonzero(turns > 1e-6).tolist()
    why = f"the collapse mechanism is unique; turning by more than 1e-6 of the most: {[h + 1 for h in hinges]}"
    claims.near(
        "nine disks: they turn at contacts 1, 5, 6 and 10 of ten and nowhere else", hinges == [0, 4, 5, 9], 1, why
    )
    pairs, modes = _first_breaks(1000)
    why = "it must collapse"
    claims.between("nine disks: bonds that break in the first step in which any does", len(pairs), 1, 10, why)
    bench.progress("threshold")
    claims += _edge(
        "eight disks",
        lambda strength: row_of_disks(8, strength, both_ends=True),
        8**2 / (16 * ROLLING),
        moment=8**2 / 8,
        turning=4,
    )
    figure = Figure(figsize=(6.4, 3))
    axes = figure.add_subplot()
    at = np.arange(9)
    axes.plot(at, torques / one / LENGTH, "o-", markersize=4, label="computed, eight disks")
    fine = np.linspace(0, 8, 100)
    axes.plot(
        fine,
        torques[0] / one / LENGTH + np.sign(torques[4] - torques[0]) * fine * (8 - fine) / 2,
        color="#777777",
        linewidth=0.8,
        label="w d c (n − c)/2 from there",
    )
    for side in (-1, 1):
        axes.axhline(side * limit, color="#D55E00", linewidth=0.8, linestyle="--")
    axes.set(xlabel="disks to the left of the contact", ylabel="Γ / (w d)")
    axes.legend(frameon=False)
    plot = figure, "Moments in the row of eight that holds; dashed: ± M_p."
    remark = f"Nine disks: first to break were the bonds {pairs}, by {', '.join(modes)}, at step {O.iter}."
    return Findings(claims, plots=[plot], remarks=[remark])
