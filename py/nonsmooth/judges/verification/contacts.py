"""Contacts without bonds: sliding, rolling, driven walls, stacks."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

from yade import O
from yade.minieigenHP import Vector3

from .claims import Claims, Findings
from .registry import check
from .small_scenes import G, begin, contacts, disk, engine, material, run, set_gravity, wall, weight

RADIUS = 0.5
EXACT = "the scheme is exact under constant forces; left are the solve, 1e-12, and rounding"
AT_REST = "one step of free fall is some 1e-2 m/s; left is the solve, 1e-12 of it, over all steps"
EDGE = 1e-6  # relative distance from a threshold


class Incline:
    """A disk at rest on a plane of slope ``tangent``, made of pieces, with gravity straight down."""

    def __init__(self, tangent, friction, rolling=0.0, turns=True, length=8.0, dt=1e-3):
        O.reset()
        dip = math.atan(tangent)
        self.along, self.normal = Vector3(math.cos(dip), -math.sin(dip), 0), Vector3(math.sin(dip), math.cos(dip), 0)
        stuff = material(friction, rolling)
        wall([(0, 0), tuple(length * self.along)[:2]], stuff, piece=RADIUS / 2)
        self.start = 0.35 * self.along + RADIUS * self.normal
        self.state = disk(*tuple(self.start)[:2], stuff, blocked="zXY" if turns else "zXYZ").state
        begin(gravity=(0, -G, 0), dt=dt)

    @property
    def speed(self):
        """Speed down the incline [m/s]."""
        return self.state.vel.dot(self.along)

    @property
    def surface_speed(self):
        """r ω, positive where the disk turns as if it rolled down."""
        return -RADIUS * self.state.angVel[2]

    @property
    def path(self):
        """Way down the incline since the begin [m]."""
        return (self.state.pos - self.start).dot(self.along)


@check("A slider on a plane of 21°", subject="Sliding and rolling", seconds=1)
def slider_on_a_plane(bench):
    """A disk that may not turn is a slider. Along a plane of dip θ it has the acceleration a = g (sin θ − μ cos θ) by
    Coulomb's law (eq. 3 and 4 of Taboada and Estrada 2009 with no cohesion). With θ = 21° and μ = 0.3 this is 0.768
    m/s², and 5 m take √(10 m / a) = 3.61 s; without friction it is g sin θ = 3.516 m/s².

    Moreau's scheme moves with the velocity of a step's end, so from rest v = a t and x = a t (t + h)/2 hold exactly:
    the time for 5 m comes out early by half a step. The plane is cut into pieces of half a radius: a joint between two
    of them must give neither a bump nor a second contact that carries force.
    """
    claims, figure = Claims(), Figure(figsize=(6.4, 3.4))
    axes = figure.add_subplot()
    tangent, dip = math.tan(math.radians(21)), math.radians(21)
    for friction, tabulated in ((0.3, 0.768), (0.0, 3.516)):
        expected = G * (math.sin(dip) - friction * math.cos(dip))
        slope = Incline(tangent, friction, turns=False)
        bump, most, times, speeds = 0.0, 0, [], []
        while slope.path < 5:
            before = slope.path
            run(1)
            bump = max(bump, abs(slope.state.vel.dot(slope.normal)))
            most = max(most, sum(i.phys.normal > 0 for i in contacts()))
            times.append(O.time)
            speeds.append(slope.speed)
        arrival = O.time - O.dt * (slope.path - 5) / (slope.path - before)
        name = f"μ = {friction:g}: "
        claims.near(name + "acceleration [m/s²]", slope.speed / O.time, expected, EXACT, relative=1e-9)
        why = "the tabulated figure has three decimals"
        claims.near(name + "acceleration as tabulated [m/s²]", slope.speed / O.time, tabulated, why, absolute=5e-4)
        why = "one step; half of one is the scheme's own"
        claims.near(name + "time for 5 m [s]", arrival, math.sqrt(10 / expected), why, absolute=O.dt)
        why = "joints are straight to rounding, 1e-16 m a step of 1e-3 s"
        claims.at_most(name + "largest speed off the plane [m/s]", bump, 1e-9, why)
        claims.at_most(name + "contacts that carry force at a time", most, 1, "one plane, one contact")
        axes.plot(times, speeds, label=f"μ = {friction:g}")
        axes.plot(times[::200], expected * np.array(times[::200]), "k.", markersize=3)
    axes.set(xlabel="time [s]", ylabel="speed along the plane [m/s]")
    axes.legend(frameon=False)
    return Findings(claims, plots=[(figure, "Lines: computed. Dots: derivation.")])


def incline_accelerations(tangent, friction, rolling):
    """(a, r α) of a disk on a plane [m/s²], see :func:`disk_on_an_incline`."""
    c = G / math.hypot(1, tangent)  # g cos θ
    if tangent <= min(friction, 2 * rolling):
        return 0.0, 0.0
    if friction < 2 * rolling:
        return c * (tangent - friction), 0.0
    if tangent <= 3 * friction - 4 * rolling:
        a = 2 / 3 * c * (tangent - 2 * rolling)
        return a, a
    return c * (tangent - friction), 2 * c * (friction - 2 * rolling)


@check("A disk on an incline rests, rolls, slips or slides", subject="Sliding and rolling", seconds=1)
def disk_on_an_incline(bench):
    """The torque that resists rolling is at most Γ = μ_r ℓ N with ℓ = d = 2 r at a wall (eq. 6), the shear force at
    most μ_s N. With N = m g cos θ and the disk's inertia m r²/2, rolling without slip means m a = m g sin θ − T and (m
    r²/2)(a/r) = T r − 2 μ_r r N, hence

    * a = ⅔ g (sin θ − 2 μ_r cos θ), positive only if tan θ > 2 μ_r: below that the disk stays (if it does not slide);
    * T = ⅓ m g (sin θ + 4 μ_r cos θ), which is at most μ_s N while tan θ ≤ 3 μ_s − 4 μ_r;
    * beyond that it slips: a = g (sin θ − μ_s cos θ) and r α = 2 (μ_s − 2 μ_r) g cos θ;
    * where μ_s < 2 μ_r friction cannot turn it, and it slides without turning once tan θ > μ_s.

    The first three meet without a jump. All of them hold step by step (v = a t), so a and α are read from 100 steps.
    The thresholds are looked at from a relative distance of 1e-6.
    """
    figure = Figure(figsize=(7.4, 3.4))
    panels, claims = figure.subplots(1, 2, sharey=True), Claims()
    for axes, (friction, rolling) in zip(panels, ((0.3, 0.1), (0.3, 0.2))):
        tangents = np.linspace(0.02, 0.8, 10 if bench.quick else 40)
        found = []
        for tangent in tangents:
            slope = Incline(tangent, friction, rolling)
            run(100)
            found.append((slope.speed / O.time, slope.surface_speed / O.time))
        expected = [incline_accelerations(t, friction, rolling) for t in tangents]
        worst = np.abs(np.array(found) - expected).max() / G
        what = f"μ_s = {friction:g}, μ_r = {rolling:g}: largest error of a or r α over {len(tangents)} slopes [g]"
        claims.at_most(what, worst, 1e-9, EXACT)
        fine = np.linspace(0.02, 0.8, 400)
        curves = np.array([incline_accelerations(t, friction, rolling) for t in fine])
        for column, name, colour in ((0, "a", "#0072B2"), (1, "r α", "#D55E00")):
            axes.plot(fine, curves[:, column], color=colour, linewidth=1, label=f"{name}, derivation")
            axes.plot(
                tangents, np.array(found)[:, column], "o", color=colour, markersize=3.5, label=f"{name}, computed"
            )
        axes.set(xlabel="tan θ", title=f"μ_s = {friction:g}, μ_r = {rolling:g}")
    panels[0].set(ylabel="acceleration [m/s²]")
    panels[0].legend(frameon=False)

    friction, rolling = 0.3, 0.1
    start, slip = 2 * rolling, 3 * friction - 4 * rolling
    slope = Incline(start * (1 - EDGE), friction, rolling)
    run(200)
    claims.at_most(
        "just below tan θ = 2 μ_r: speed after 0.2 s [m/s]", abs(slope.speed) + abs(slope.surface_speed), 1e-10, AT_REST
    )
    slope = Incline(start * (1 + EDGE), friction, rolling)
    run(200)
    ramp = "1e-6 beyond the threshold the driving force is the difference of two that are solved to 1e-12: six digits"
    excess = 2 / 3 * G / math.hypot(1, start) * start * EDGE
    claims.near("just above tan θ = 2 μ_r: acceleration [m/s²]", slope.speed / O.time, excess, ramp, relative=1e-4)
    slope = Incline(slip * (1 - EDGE), friction, rolling)
    run(200)
    claims.at_most(
        "just below tan θ = 3 μ_s − 4 μ_r: speed of slip [m/s]", abs(slope.speed - slope.surface_speed), 1e-10, AT_REST
    )
    slope = Incline(slip * (1 + EDGE), friction, rolling)
    run(200)
    what = "just above tan θ = 3 μ_s − 4 μ_r: growth of slip [m/s²]"
    value = (slope.speed - slope.surface_speed) / O.time
    claims.near(what, value, G / math.hypot(1, slip) * slip * EDGE, ramp, relative=1e-4)
    caption = (
        "Acceleration of the centre and of the rim over the slope, from rest. Left: rests, rolls, slips. Right: with "
        "2 μ_r > μ_s it never turns."
    )
    plot = figure, caption
    return Findings(claims, plots=[plot])


@check("A spinning disk set down on a floor", subject="Sliding and rolling", seconds=1)
def spinning_disk(bench):
    """A disk with the spin ω₀ and no speed touches a floor. It slips, and friction μ m g drives it on and takes its
    spin. With rolling friction μ_r the torque Γ = 2 μ_r r m g (ℓ = 2 r) brakes the spin as well:

    * v = μ g t and r ω = r ω₀ − 2 (μ + 2 μ_r) g t, so slip ends at t₁ = r ω₀ / ((3 μ + 4 μ_r) g) with v₁ = μ r ω₀ / (3
      μ + 4 μ_r);
    * the slip falls in proportion to time, so sliding takes μ m g · r ω₀ t₁ / 2;
    * without rolling friction v₁ = r ω₀ / 3 whatever μ is (spin about a point of the floor is kept, v + r ω/2 = r
      ω₀/2), the sliding loss is m r² ω₀² / 6, two thirds of all energy, and the disk rolls on for ever;
    * with it the disk then slows down by 4/3 μ_r g and stops after t₁ + 3 v₁ / (4 μ_r g); all of m r² ω₀² / 4 is lost.

    Losses are sums of P · (U before + U after)/2, exact for constant mass. Only the step in which slip ends does not
    end with it.
    """
    friction, spin, claims = 0.3, 10.0, Claims()
    figure = Figure(figsize=(7.4, 3.4))
    for axes, rolling in zip(figure.subplots(1, 2, sharey=True), (0.0, 0.05)):
        O.reset()
        stuff = material(friction, rolling)
        wall([(-40, 0), (40, 0)], stuff)
        body = disk(0, RADIUS, stuff, spin=-spin)  # clockwise: drives it towards +x
        e, s = begin(gravity=(0, -G, 0)), body.state
        rim, energy = RADIUS * spin, 0.25 * s.mass * (RADIUS * spin) ** 2
        slip_ends, speed = rim / ((3 * friction + 4 * rolling) * G), friction * rim / (3 * friction + 4 * rolling)
        end = slip_ends + 3 * speed / (4 * rolling * G) + 0.2 if rolling else 2.5 * slip_ends
        times, speeds, rims, rolls_at, stops_at = [], [], [], math.inf, math.inf
        while O.time < end:
            run(1)
            times.append(O.time)
            speeds.append(s.vel[0])
            rims.append(-RADIUS * s.angVel[2])
            if abs(speeds[-1] - rims[-1]) < 1e-8 * rim:
                rolls_at = min(rolls_at, O.time)
            if abs(speeds[-1]) + abs(rims[-1]) < 1e-8 * rim:
                stops_at = min(stops_at, O.time)
        name = f"μ_r = {rolling:g}: "
        late = "it rolls at the end of the step in which slip ends, up to one later"
        claims.near(name + "time at which slip ends [s]", rolls_at, slip_ends, late, absolute=1.01 * O.dt)
        at_half = np.searchsorted(times, slip_ends / 2)
        half_way = rim - 2 * (friction + 2 * rolling) * G * times[at_half]
        claims.near(name + "r ω half-way [m/s]", rims[at_half], half_way, EXACT, relative=1e-9)
        if rolling:
            why = "the two changes of regime take up to one step each"
            stop = slip_ends + 3 * speed / (4 * rolling * G)
            claims.near(name + "time at which it stops [s]", stops_at, stop, why, absolute=2.01 * O.dt)
            why = "the step in which slip ends errs by its share of slip, (h/t₁)² = 5e-6"
            slid, lost = friction * s.mass * G * rim * slip_ends / 2, e.slidingLoss + e.rollingLoss
            claims.near(name + "sliding loss [J]", e.slidingLoss, slid, why, relative=1e-5)
            claims.near(name + "sliding and rolling loss [J]", lost, energy, EXACT, relative=1e-9)
        else:
            claims.near(name + "final speed [m/s]", speeds[-1], rim / 3, EXACT, relative=1e-9)
            claims.near(name + "final r ω [m/s]", rims[-1], rim / 3, EXACT, relative=1e-9)
            claims.near(name + "sliding loss [J]", e.slidingLoss, 2 / 3 * energy, EXACT, relative=1e-9)
            why = "there is no torque to dissipate; rounding"
            claims.at_most(name + "rolling loss [J]", abs(e.rollingLoss), 1e-9 * energy, why)
        claims.at_most(name + "error of the energy balance [J]", abs(e.energyError), 1e-9 * energy, EXACT)
        axes.plot(times, speeds, label="v")
        axes.plot(times, rims, label="r ω")
        axes.axvline(slip_ends, color="#777777", linewidth=0.7, linestyle="--")
        axes.set(xlabel="time [s]", title=f"μ_r = {rolling:g}")
        axes.legend(frameon=False)
    figure.axes[0].set(ylabel="speed [m/s]")
    plot = figure, "Speed of the centre and of the rim; the dashed line is the derived end of slip."
    return Findings(claims, plots=[plot])


class Squeeze:
    """A disk between a floor driven at ``below`` and a roof driven at ``above`` [m/s], which ``load`` [N] presses down;
    no gravity.
    """

    def __init__(self, load, above, below, friction=0.3, rolling=0.0, dt=1e-4, rolls=False):
        O.reset()
        stuff = material(friction, rolling)
        (self.floor,) = wall([(-40, 0), (40, 0)], stuff, velocity=(below, 0))
        (self.roof,) = wall([(-40, 2 * RADIUS), (40, 2 * RADIUS)], stuff, velocity=(above, 0))
        self.roof.state.mass = 1000
        self.roof.state.blockedDOFs = "xzXYZ"  # it may move up and down
        self.disk = disk(0, RADIUS, stuff)
        if rolls:  # begins in steady motion
            self.disk.state.vel = ((above + below) / 2, 0, 0)
            self.disk.state.angVel = (0, 0, (below - above) / (2 * RADIUS))
        O.forces.setPermF(self.roof.id, (0, -load, 0))
        begin(dt=dt)

    @property
    def kinetic(self):
        """Kinetic energy of the disk [J/m]."""
        s = self.disk.state
        return 0.5 * (s.mass * s.vel.squaredNorm() + s.inertia[2] * s.angVel[2] ** 2)

    def force(self, body):
        """Force of the contacts on the wall along x [N]."""
        return O.forces.f(body.id)[0]


@check("A disk between two driven walls", subject="Sliding and rolling", seconds=1)
def disk_between_driven_walls(bench):
    """A disk lies between a floor that is driven with u₂ and a roof that is driven with u₁ and pressed down with the
    force N; there is no gravity. Rolling without slip on both asks for v − r ω = u₁ and v + r ω = u₂, so v = (u₁ +
    u₂)/2 and ω = (u₂ − u₁)/(2 r), counter-clockwise positive.

    From rest, with u₁ = 1 m/s and u₂ = −0.4 m/s, both contacts slip at first: the shear forces μ N cancel in sum and
    turn the disk with (r ω)′ = −4 μ N/m. The floor stops slipping when r ω = u₂, after t₁ = m (−u₂)/(4 μ N). Then it
    sticks with the shear force μ N/3, the centre gains v′ = 4 μ N/(3 m), and the roof stops slipping when v = (u₁ +
    u₂)/2, after another 3 m v/(4 μ N). The walls do the work μ N (u₁ t₂ − u₂ t₁ + u₂ (t₂ − t₁)/3); it becomes the
    disk's energy and sliding loss.

    In steady motion with rolling friction each contact resists with Γ = 2 μ_r r N, so the shear forces must be T = 2
    μ_r N: the walls' power T (u₁ − u₂) is the rolling loss 2 Γ ω. If a torque τ resists as well, T = 2 μ_r N + τ/(2 r):
    the walls can turn the disk only while this is at most μ N, that is with a squeeze above N* = τ / (2 r (μ − 2 μ_r)).
    With less both slip, and the spin changes by (2 r (μ − 2 μ_r) N − τ)/(m r²/2) a second.

    The roof is free along one axis only, so its contacts take the solver's general path and not that of the blocks.
    """
    load, above, below, friction, claims = 2e4, 1.0, -0.4, 0.3, Claims()
    squeeze = Squeeze(load, above, below)
    s, e = squeeze.disk.state, engine()
    t1 = s.mass * -below / (4 * friction * load)
    t2 = t1 + 3 * s.mass * (above + below) / 2 / (4 * friction * load)
    times, speeds, rims = [], [], []
    while O.time < 2 * t2:
        run(1)
        times.append(O.time)
        speeds.append(s.vel[0])
        rims.append(RADIUS * s.angVel[2])
    work = friction * load * (above * t2 - below * t1 + below * (t2 - t1) / 3)
    early = np.searchsorted(times, t1 / 2)
    late = np.searchsorted(times, t2 - O.dt)
    claims.near(
        "both slip: r ω after t₁/2 [m/s]",
        rims[early],
        -4 * friction * load / s.mass * times[early],
        EXACT,
        relative=1e-9,
    )
    why = "t₁ falls into a step: one step's gain"
    claims.near(
        "the floor sticks: v just before t₂ [m/s]",
        speeds[late],
        4 / 3 * friction * load / s.mass * (times[late] - t1),
        why,
        absolute=4 / 3 * friction * load / s.mass * O.dt,
    )
    claims.near("steady speed (u₁ + u₂)/2 [m/s]", speeds[-1], (above + below) / 2, EXACT, relative=1e-9)
    claims.near("steady r ω = (u₂ − u₁)/2 [m/s]", rims[-1], (below - above) / 2, EXACT, relative=1e-9)
    why = "t₁ and t₂ fall into steps: two steps' work"
    claims.near("work of the walls [J]", e.wallWork, work, why, absolute=2 * friction * load * (above - below) * O.dt)
    claims.near(
        "work of the walls less sliding loss [J]", e.wallWork - e.slidingLoss, squeeze.kinetic, EXACT, relative=1e-9
    )
    why = "there are none; rounding"
    claims.at_most("other losses [J]", abs(e.rollingLoss) + abs(e.impactLoss) + abs(e.debondingLoss), 1e-9 * work, why)

    rolling, spin = 0.05, (below - above) / (2 * RADIUS)
    squeeze = Squeeze(load, above, below, rolling=rolling, rolls=True)
    e, steps = engine(), 500
    run(steps)
    for what, value, wanted in (
        ("shear force 2 μ_r N of the roof [N]", -squeeze.force(squeeze.roof), 2 * rolling * load),
        ("work of the walls [J]", e.wallWork, 2 * rolling * load * (above - below) * O.time),
        ("loss [J]", e.rollingLoss, 2 * 2 * rolling * RADIUS * load * abs(spin) * O.time),
    ):
        claims.near(f"rolling friction: {what}", value, wanted, EXACT, relative=1e-8)
    why = "nothing slips; the solve's 1e-12 and rounding"
    claims.at_most("rolling friction: sliding loss [J]", abs(e.slidingLoss), 1e-8 * abs(e.rollingLoss), why)

    torque = 2000.0
    enough, changes = torque / (2 * RADIUS * (friction - 2 * rolling)), []
    for side in (1, -1):
        squeeze = Squeeze(enough * (1 + side * EDGE), above, below, rolling=rolling, rolls=True, dt=1e-3)
        O.forces.setPermT(squeeze.disk.id, (0, 0, torque))  # against the spin, which is clockwise
        run(200)
        changes.append((squeeze.disk.state.angVel[2] - spin) / O.time)
    why = "the torque alone would give 8 rad/s²; the solve, 1e-12 of it, may drift over 200 steps"
    claims.at_most("squeeze just above N*: change of spin [rad/s²]", abs(changes[0]), 1e-9, why)
    why = "1e-6 of the torque, known to the solve's 1e-12 and to the change of N while the roof begins to carry"
    claims.near(
        "squeeze just below N*: change of spin [rad/s²]",
        changes[1],
        torque * EDGE / squeeze.disk.state.inertia[2],
        why,
        relative=1e-3,
    )
    figure = Figure(figsize=(6.4, 3.4))
    axes = figure.add_subplot()
    axes.plot(times, speeds, label="v")
    axes.plot(times, rims, label="r ω")
    for t in (t1, t2):
        axes.axvline(t, color="#777777", linewidth=0.7, linestyle="--")
    axes.set(xlabel="time [s]", ylabel="speed [m/s]")
    axes.legend(frameon=False)
    return Findings(
        claims, plots=[(figure, "From rest; dashed: t₁ (the floor stops slipping) and t₂ (the roof does).")]
    )


def _stack(count, stuff):
    (floor,) = wall([(-5, 0), (5, 0)], stuff)
    return floor, [disk(0, RADIUS + 2 * RADIUS * k, stuff) for k in range(count)]


@check("A stack of fifty disks carries its weight", subject="Statics", seconds=1)
def stack_of_disks(bench):
    """In a straight stack at rest the contact below disk k, counted from the top, carries k m g, and the floor all of
    it. The problem has one solution, so the solve must find it to its tolerance. Its condition number is that of a
    chain, (4/π²) n² · 4 = 4e3 for n = 50: a residual of 1e-12 leaves forces good to about 4e-9.
    """
    stuff = material(0.3, 0.1)
    floor, disks = _stack(50, stuff)
    e = begin(gravity=(0, -G, 0), dt=5e-3)
    run(100)
    found, one = [i.phys.normal for i in contacts()], weight(disks[0])
    worst = max(abs(n / (one * (50 - k)) - 1) for k, n in enumerate(found))
    digits = "residual 1e-12 times the chain's condition number, 4e3, and ten times more for the top contact, which carries one part in 50"
    claims = Claims()
    claims.near("contacts", len(found), 50, "a count")
    claims.near("force on the floor [N]", -O.forces.f(floor.id)[1], 50 * one, digits, relative=1e-7)
    claims.at_most("largest relative error of a contact's force", worst, 1e-6, digits)
    why = "1e-6 of a step's fall, 0.05 m/s, from the same error of force"
    claims.at_most("fastest disk [m/s]", e.maxSpeed, 1e-7, why)
    claims.at_most("largest overlap [ℓ]", e.overlapWorst, 1e-9, "that speed times a step of 5e-3 s")
    return Findings(claims)


def _reactions():
    """N, T and Γ/ℓ of all contacts [N]."""
    return np.array([(i.phys.normal, i.phys.tangential, i.phys.torque / i.phys.length) for i in contacts()])


@check("A time step that changes at rest does nothing", subject="Statics", seconds=1)
def changed_time_step(bench):
    """The solve starts from the last step's reactions. They are kept as forces and multiplied by the present h, so that
    a stack at rest stays solved whatever O.dt becomes: impulses and free velocities are both proportional to h, and the
    relative residual does not change. A start from the last impulses themselves would be off by the ratio of the steps,
    and here nothing may repair it: after a tight solve at h = 5 ms the solver is left with one plain sweep a step at
    most and a tolerance of 1e-7.

    Two structures at rest: a stack of 20 disks (normal forces only), and a row of three disks bonded to a fixed one
    under gravity (shear forces and torques; no normal force at all). Both must keep all reactions while h jumps by
    factors between 1/10 and 4, without a single sweep.
    """
    claims, rows = Claims(), []
    steps = (5e-3, 2.5e-3, 1e-2, 1e-3, 4e-3)
    for name in ("stack", "bonded row"):
        O.reset()
        if name == "stack":
            _, disks = _stack(20, material(0.3, 0.1))
            e = begin(gravity=(0, -G, 0), dt=steps[0])
        else:
            stuff = material(0.5, 0.2, tensileStrength=1e7)
            disk(0, 0, stuff, fixed=True)
            disks = [disk(2 * RADIUS * k, 0, stuff) for k in (1, 2, 3)]
            e = begin(dt=steps[0])
            run(1)
            e.bond()
            set_gravity(0, -G)
        run(20)
        before, places = _reactions(), [b.state.pos for b in disks]
        largest = np.abs(before).max()
        e.method, e.maxIterations, e.tolerance = "gaussSeidel", 1, 1e-7
        sweeps, unconverged, changed, fastest = e.totalIterations, e.unconverged, 0.0, 0.0
        for h in steps[1:]:
            O.dt = h
            for _ in range(5):
                run(1)
                now = _reactions()
                same = now.shape == before.shape and largest > 0  # else a contact was lost, or never bore anything
                changed = max(changed, np.abs(now - before).max() / largest if same else math.inf)
                fastest = max(fastest, e.maxSpeed / (G * h))
            rows.append([name, f"{h:g}", f"{e.residual:.1e}", f"{changed:.1e}"])
        moved = max((b.state.pos - p).norm() for b, p in zip(disks, places))
        why = "a count: the start is the solution"
        claims.near(f"{name}: sweeps after the changes", e.totalIterations - sweeps, 0, why)
        claims.near(f"{name}: steps above the tolerance", e.unconverged - unconverged, 0, "a count")
        why = (
            "forces are kept, not computed anew: rounding and the first solve's 1e-12 times a condition number up to "
            "1e3"
        )
        claims.at_most(f"{name}: largest change of a reaction", changed, 1e-7, why)
        why = "the first solve's error of force, in parts of a disk's weight"
        claims.at_most(f"{name}: fastest disk, in g h", fastest, 1e-6, why)
        claims.at_most(f"{name}: farthest move [m]", moved, 1e-8, "20 steps with that speed")
    heads = ["structure", "h [s]", "residual", "change"]
    table = "Residuals before any sweep, and the largest relative change of a reaction so far", heads, rows
    return Findings(claims, tables=[table])
