"""Impacts: restitution, friction, several at once, landing; and the elasticity of a chain that is not solved."""

from __future__ import annotations

import math
import random

import numpy as np
from matplotlib.figure import Figure

from yade import O

from .claims import Claims, Findings
from .registry import check
from .small_scenes import G, begin, contacts, disk, material, run, wall, weight

RADIUS = 0.5
EXACT = "the impact law is exact; left are the solve, 1e-12, and rounding"


@check("Restitution head-on", subject="Impacts", seconds=1)
def restitution_head_on(bench):
    """Newton's impact law: the speed of approach times e is the speed of separation. For two equal disks with v₁ = 1
    and v₂ = −2 m/s the centre of mass keeps −0.5 m/s and the approach is 3 m/s, so they leave with −0.5 ∓ 1.5 e. The
    loss is (1 − e²) times the energy of approach, ½ (m/2) 3². Against a wall a disk leaves with −e times its speed and
    loses (1 − e²) ½ m v². Of two coefficients the larger holds: one body has e, the other none.

    With e = 0 a gap that closes within a step is first closed exactly and the rest of the speed lost in the next step;
    with e > 0 the bodies part in the step in which they would meet.
    """
    claims = Claims()
    for e in (0.0, 0.5, 1.0):
        O.reset()
        springy, other = material(0.3, restitution=e), material(0.3)
        left, right = disk(-1, 0, springy, velocity=(1, 0)), disk(1, 0, other, velocity=(-2, 0))
        bench_engine = begin()
        run(600)
        approach = 0.25 * left.state.mass * 9
        name = f"e = {e:g}: "
        claims.near(name + "first disk [m/s]", left.state.vel[0], -0.5 - 1.5 * e, EXACT, absolute=1e-9)
        claims.near(name + "second disk [m/s]", right.state.vel[0], -0.5 + 1.5 * e, EXACT, absolute=1e-9)
        claims.near(
            name + "loss [J]", bench_engine.impactLoss, (1 - e**2) * approach, EXACT, absolute=1e-9 * approach
        )
        claims.at_most(name + "error of the energy balance [J]", abs(bench_engine.energyError), 1e-9 * approach, EXACT)
        O.reset()
        springy, other = material(0.3, restitution=e), material(0.3)
        wall([(0, -5), (0, 5)], other)
        flying = disk(1, 0, springy, velocity=(-2, 0))
        begin()
        run(600)
        claims.near(name + "speed after a wall [m/s]", flying.state.vel[0], 2 * e, EXACT, absolute=1e-9)
    return Findings(claims)


@check("A disk that falls lands on the floor", subject="Impacts", seconds=1)
def landing(bench):
    """A disk falls from rest through H = 0.1 m onto a floor with e = 0. In the scheme it falls by g h² n(n+1)/2 in n
    steps. The step in which it would pass the floor closes the gap exactly, neither more nor less (Signorini's
    condition with the gap in it: U + g/h ≥ 0), so the disk rests with a gap of zero and no overlap. The loss is m g H
    exactly: what the balance misses in a step, m g h times half its gain of speed, sums to nothing between rest and
    rest. Until it touches, the contact, which is known beforehand, must not carry force.
    """
    stuff, height = material(0.3), 0.1
    wall([(-5, 0), (5, 0)], stuff)
    body = disk(0, RADIUS + height, stuff)
    e, s = begin(gravity=(0, -G, 0)), body.state
    early, landed = 0.0, math.inf
    while O.time < 0.3:
        gap = s.pos[1] - RADIUS
        run(1)
        force = max((i.phys.normal for i in contacts()), default=0.0)
        if gap > -s.vel[1] * O.dt + 1e-9:  # not closed by the end of the step
            early = max(early, force)
        elif not math.isfinite(landed):
            landed = O.time
    fall = math.ceil(-0.5 + math.sqrt(0.25 + 2 * height / (G * O.dt**2)))
    claims = Claims()
    claims.near("step in which it lands", landed / O.dt, fall, "a count; time is a sum of steps", absolute=1e-6)
    why = "none acts across a gap that stays open; rounding"
    claims.at_most("force before it touches [N]", early, 1e-9 * weight(body), why)
    why = "rounding of positions, 1e-16 m, over 300 steps"
    claims.at_most("gap at rest [m]", abs(s.pos[1] - RADIUS), 1e-12, why)
    claims.at_most("largest overlap [ℓ]", e.overlapWorstEver, 1e-12, "the gap is closed exactly, never passed")
    claims.near("loss [J]", e.impactLoss, weight(body) * height, EXACT, relative=1e-9)
    claims.near("force on the floor [N]", contacts()[0].phys.normal, weight(body), EXACT, relative=1e-9)
    return Findings(claims)


def _glance(ratio, e, friction, spin, pair, speed=1.0):
    """Slip, normal speed and r ω after the impact of a disk with the normal speed ``speed`` and the slip ``ratio`` ·
    ``speed``, in its units.
    """
    O.reset()
    stuff = material(friction, restitution=e)
    slip = ratio * speed
    if pair:  # two disks in mirror image, each with half of everything
        first = disk(-RADIUS, 0, stuff, velocity=(speed / 2, -slip / 2))
        second = disk(RADIUS, 0, stuff, velocity=(-speed / 2, slip / 2))
    else:
        wall([(0, -5), (0, 5)], stuff)
        # the touching rim moves with slip
        second = disk(RADIUS, 0, stuff, velocity=(-speed, slip + RADIUS * spin), spin=spin)
    begin(dt=1e-4)
    run(1)
    s = second.state
    normal, tangential = s.vel[0], s.vel[1]
    if pair:
        t = first.state
        normal, tangential = normal - t.vel[0], tangential - t.vel[1]
        return (tangential - RADIUS * (s.angVel[2] + t.angVel[2])) / speed, normal / speed, s.angVel[2] * RADIUS / speed
    return (tangential - RADIUS * s.angVel[2]) / speed, normal / speed, s.angVel[2] * RADIUS / speed


@check("Oblique impacts stick or slide", subject="Impacts", seconds=1)
def oblique_impact(bench):
    """A disk meets a wall with the normal speed U_n and the slip U_t of its rim. The impulse P_n = m (1 + e) U_n stops
    and returns it. At the rim the effective mass against slip is 1/(1/m + r²/I) = m/3, so to end the slip takes P_t = m
    U_t/3. That is below μ P_n if U_t ≤ 3 μ (1 + e) U_n: the impact *sticks*, U_t⁺ = 0. Otherwise it *slides* and U_t⁺ =
    U_t − 3 μ (1 + e) U_n. Either way the spin changes by r Δω = 2 P_t/m.

    Two equal disks have half the mass against approach, m/2, and half that against slip, m/6: the same limit, the same
    slip after. In the computation the graphs are asked at the end of the step, so friction sees the whole impulse P_n,
    restitution included, and does not return slip.
    """
    friction, claims = 0.2, Claims()
    ratios = np.linspace(0, 2, 9 if bench.quick else 21)
    figure = Figure(figsize=(6.4, 3.4))
    axes = figure.add_subplot()
    for pair, what in ((False, "wall"), (True, "two disks")):
        worst = np.zeros(3)
        for e in (0.0, 0.5, 1.0):
            limit = 3 * friction * (1 + e)
            found = []
            for ratio in ratios:
                slip, normal, spin = _glance(ratio, e, friction, spin=0.7, pair=pair)
                lost = min(ratio, limit)
                # r Δω = 2 P_t/m with P_t = lost m/3 (m/6 for two), slowing the rim: counter-clockwise
                expected = (ratio - lost, e, 2 * lost / 3 + 0.35 if not pair else lost / 3)
                worst = np.maximum(worst, np.abs(np.subtract((slip, normal, spin), expected)))
                found.append(slip)
            axes.plot(
                ratios,
                found,
                "ox"[pair],
                markersize=4,
                color={0: "#0072B2", 0.5: "#D55E00", 1: "#009E73"}[e],
                label=f"e = {e:g}, {what}",
            )
            if not pair:
                axes.plot(ratios, np.maximum(0, ratios - limit), color="#777777", linewidth=0.8)
        for name, value in zip(("slip after", "normal speed after", "spin after (r ω)"), worst):
            claims.at_most(f"{what}: largest error of the {name} [U_n]", value, 1e-9, EXACT)
        for side in (-1, 1):
            slip, _, _ = _glance(3 * friction * 1.5 * (1 + side * 1e-6), 0.5, friction, 0.0, pair)
            beyond = 3 * friction * 1.5 * 1e-6 if side > 0 else 0.0
            claims.near(
                f"{what}, e = 0.5: slip after, {'1e-6 beyond' if side > 0 else '1e-6 below'} the limit of sticking [U_n]",
                slip,
                beyond,
                EXACT,
                absolute=1e-10,
            )
    axes.set(xlabel="slip before, U_t/U_n", ylabel="slip after")
    axes.legend(frameon=False, ncol=2)
    return Findings(claims, plots=[(figure, "Slip after an impact with μ = 0.2; lines: derivation.")])


@check("Newton's cradle, with and without gaps", subject="Impacts", seconds=1)
def cradle(bench):
    """A disk with the speed 1 hits a row of four others at rest, e = 1. In a real cradle the blow is handed on in turn,
    and only the last one leaves. A scheme that balances a step at once does that only if there are gaps: with gaps of
    more than one step's way each impact has a step of its own, and two equal disks exchange velocities.

    If the disks touch, all contacts act in the same step. Newton's law asks for U⁺ ≥ −e U⁻ at each: separation with e
    at the first contact, and no approach at the others, where there was none before. So the four move as one, with v +
    e, and momentum gives v = (1 − 4 e)/5 for the first disk: it comes back with 0.6 and the four leave with 0.4.
    Momentum and energy are kept just as well. This is a property of Newton's law for several impacts at once, shared by
    every Moreau-type scheme; it is no error, but no cradle either.
    """
    claims = Claims()
    for gap, expected in ((2e-3, (0, 0, 0, 0, 1)), (0.0, (-0.6, 0.4, 0.4, 0.4, 0.4))):
        O.reset()
        stuff = material(0.0, restitution=1)
        disks = [disk((2 * RADIUS + gap) * k, 0, stuff) for k in range(5)]
        disks[0].state.pos = (-2e-3, 0, 0)
        disks[0].state.vel = (1, 0, 0)
        begin(dt=1e-3 if gap == 0 else 2e-4)
        run(200)
        speeds = [b.state.vel[0] for b in disks]
        where = f"gaps of {gap * 1e3:g} mm: "
        for k, (v, x) in enumerate(zip(speeds, expected)):
            claims.near(f"{where}disk {k + 1} [m/s]", v, x, EXACT, absolute=1e-9)
        claims.near(where + "energy [of before]", sum(v**2 for v in speeds), 1, EXACT, relative=1e-9)
    remark = "Where the order of impacts matters, leave gaps and take a step that resolves them."
    return Findings(claims, remarks=[remark])


# ---- a chain that is not solved -------------------------------------------------------------------


class Chain:
    """Disks in a row between a wall at the left and a force F [N] on the last one, at rest, slightly overlapping, with
    no correction of overlaps.

    ``at_rest``: the reactions that balance F are there already; else none.
    """

    def __init__(self, count=50, force=1e5, at_rest=True, dt=1e-3, overlap=1e-3, **options):
        O.reset()
        self.count, self.force = count, force
        stuff = material(0.0)
        wall([(0, -2), (0, 2)], stuff)
        spacing = 2 * RADIUS * (1 - overlap)
        self.disks = [disk(RADIUS * (1 - overlap) + spacing * k, 0, stuff) for k in range(count)]
        O.forces.setPermF(self.disks[-1].id, (-force, 0, 0))
        self.engine = begin(dt=dt, relaxationRate=0)
        if at_rest:
            run(1)
        for name, value in options.items():
            setattr(self.engine, name, value)
        self.mode = math.pi / (2 * count)  # κ: wave number of the gravest mode, times the diameter

    def stir(self, speed):
        """Velocities of the gravest mode, without reactions to match."""
        for k, b in enumerate(self.disks):
            b.state.vel = (speed * math.sin(self.mode * (k + 0.5)), 0, 0)

    def follow(self, steps):
        """Amplitude of the gravest mode's velocity after each step [m/s], the initial one first."""
        shape = np.sin(self.mode * (np.arange(self.count) + 0.5))
        found = np.empty((steps + 1, self.count))
        for k in range(steps + 1):
            found[k] = [b.state.vel[0] for b in self.disks]
            if k < steps:
                O.step()
        return 2 / self.count * found @ shape


def oscillation(amplitudes):
    """Period and decay time, in samples, of a sequence that obeys a_{k+1} = A a_k − B a_{k−1} (least squares)."""
    a = np.asarray(amplitudes)
    (big, small), *_ = np.linalg.lstsq(np.column_stack([a[1:-1], -a[:-2]]), a[2:], rcond=None)
    return 2 * math.pi / math.acos(big / (2 * math.sqrt(small))), -2 / math.log(small)


def expected_oscillation(mode, sweeps, order=None):
    """Period and decay time in steps; ``order``: q of a sweep in long waves, None for two colours, which is exact."""
    left = math.cos(mode) ** (2 * sweeps) if order is None else math.exp(-order * sweeps * mode**2)
    return 2 * math.pi / math.acos(math.sqrt(left)), -2 / math.log(left)


def random_chain(count, sweeps, steps, seed=1):
    """The same chain with sweeps in random order, in plain Python: amplitude of the gravest mode's velocity after each
    step, the initial one first.

    Unit mass; impulses are taken from those at rest, which changes nothing in a linear problem.
    """
    dice, mode = random.Random(seed), math.pi / (2 * count)
    shape = np.sin(mode * (np.arange(count) + 0.5))
    v, p = [0.0, *shape], [0.0] * count  # v[0]: the wall
    found = [1.0]
    for _ in range(steps):
        u = [0.0] + [v[k + 1] + p[k] - (p[k + 1] if k + 1 < count else 0.0) for k in range(count)]
        for _ in range(sweeps):
            for k in dice.sample(range(count), count):
                change = -(u[k + 1] - u[k]) * (1.0 if k == 0 else 0.5)
                p[k] += change
                u[k + 1] += change
                if k:
                    u[k] -= change
        v = u
        found.append(2 / count * float(shape @ v[1:]))
    return np.array(found)


@check(
    "A chain that is not solved behaves elastically, a solved one does not", subject="Incomplete convergence", seconds=2
)
def elastic_chain(bench):
    """A chain of rigid disks solved with a fixed number N of Gauss-Seidel sweeps a step carries damped sound waves
    (Unger, Brendel, Wolf and Kertész 2002, Phys. Rev. E 65, 061305; Unger and Kertész 2002, arXiv:cond-mat/0211696).
    Their chain, 50 disks between a wall and a constant force, has c = √(q N) d/h and the diffusion q N d²/h with q =
    0.797. With N = 40 this means a period of 35.6 steps for the gravest mode and a decay time of 63.5. Here is why, and
    what our order of sweeps must give instead.

    *One step.* Let W be the Delassus operator of the normal contacts, G the iteration matrix of one sweep, P the
    impulses that a step starts from and P* those that solve it. N sweeps leave the error e = Gᴺ (P − P*), and the
    velocities at the end of the step miss the law by U = W e. The next step has to undo U, so its solution is P*′ = P_s
    − W⁻¹ U = P_s − e, with P_s the impulses at rest. It starts from P* + e. So errors obey e″ = Gᴺ (2 e′ − e): with γ
    an eigenvalue of Gᴺ, z² = γ (2 z − 1), z = γ ± i √(γ (1 − γ)) and z z̄ = γ. A mode decays by √γ a step and turns by
    arccos √γ a step.

    *One sweep.* For a chain with one wall and one free end Jacobi's iteration matrix has the eigenvalues cos κ, κ = (2
    j − 1) π/(2 n), with the shape cos κ c at contact c. Our contacts are swept in two colours (every other contact
    first), a consistent order in Young's sense, where Gauss-Seidel has the squares: γ = cos κ to the power 2 N. In long
    waves this is exp(−q N κ²) with **q = 1**. So with n = 50 and N = 40 the period is 2 π / arccos (cos κ)ᴺ = 31.7
    steps and the decay time −1/(N ln cos κ) = 50.7 steps.

    *Their q.* In a sweep of random order a contact takes the new impulse of a neighbour that came before it, else the
    old one. Following the influence outwards, it goes on for as long as each next contact came earlier still: a run of
    m + 1 contacts in falling order has the probability 1/(m + 1)!, and each link halves it. Summing the squares of the
    distances gives 2 q = 4 √e − 5, so **q = 2 √e − 5/2 = 0.7974**, their figure; with it the formulas above give 35.5
    and 63.5 steps. A few lines of Python that sweep at random show it.

    *The solved chain.* With the accelerated method and a tolerance of 1e-10 there is no wave: a force put on the end of
    a chain without forces is at the wall in the same step, and nothing moves. After 40 plain sweeps the wall feels
    nothing of it yet.
    """
    figure, claims, rows = Figure(figsize=(7.4, 3.4)), Claims(), []
    wave, law = figure.subplots(1, 2)
    exact = "the recurrence is exact for the linear chain; left is the start, a mode of Jacobi's method, which loses 5e-4 in the first sweep"
    for sweeps in (20, 40) if bench.quick else (5, 10, 20, 40, 80):
        bench.progress(f"{sweeps} sweeps")
        chain = Chain(method="gaussSeidel", maxIterations=sweeps, tolerance=1e-300)
        chain.stir(1e-3)
        amplitudes = chain.follow(200)
        period, decay = oscillation(amplitudes[2:])
        wanted = expected_oscillation(chain.mode, sweeps)
        speed = math.sqrt((2 * math.pi / period) ** 2 + 1 / decay**2) / chain.mode
        rows.append(
            [
                str(sweeps),
                f"{period:.4f} ({wanted[0]:.4f})",
                f"{decay:.4f} ({wanted[1]:.4f})",
                f"{speed:.4f} ({math.sqrt(sweeps):.4f})",
            ]
        )
        claims.near(f"{sweeps} sweeps: period [h]", period, wanted[0], exact, relative=1e-5)
        claims.near(f"{sweeps} sweeps: decay time [h]", decay, wanted[1], exact, relative=1e-5)
        law.plot(sweeps, speed, "o", color="#0072B2", markersize=4)
        if sweeps == 40:
            q = (speed**2) / sweeps
            why = "long waves: N κ² = 0.04 is the next term"
            claims.near("q of our sweep, from (c h/d)²/N", q, 1, why, relative=0.03)
            wave.plot(amplitudes / amplitudes[0], linewidth=1, label="40 sweeps, two colours")
            turn, fade = 2 * math.pi / wanted[0], wanted[1]
            k = np.arange(0, 201, 2)
            # the recurrence from the first two velocities, in closed form
            a0, a1 = amplitudes[2] / amplitudes[0], amplitudes[3] / amplitudes[0]
            tail = (a1 * math.exp(1 / fade) - a0 * math.cos(turn)) / math.sin(turn)
            wave.plot(
                k + 2,
                np.exp(-k / fade) * (a0 * np.cos(turn * k) + tail * np.sin(turn * k)),
                "k.",
                markersize=2.5,
                label="derivation",
            )
    bench.progress("random order")
    random_order = 2 * math.sqrt(math.e) - 2.5
    amplitudes = random_chain(50, 40, 150)
    period, decay = oscillation(amplitudes)
    why = "their figure has three decimals"
    claims.near("q of random sweeps, 2 √e − 5/2", random_order, 0.797, why, absolute=5e-4, against="Unger et al. 2002")
    why = "one series of orders; and their formula is that of long waves, ours gives 35.5"
    claims.near("random sweeps (Python): period [h]", period, 35.6, why, relative=0.02, against="Unger et al. 2002")
    why = "one series of orders: chance moves it by some per cent"
    claims.near("random sweeps (Python): decay time [h]", decay, 63.5, why, relative=0.05, against="Unger et al. 2002")
    wave.plot(amplitudes, linewidth=1, label="40 sweeps, random order")
    wave.set(xlabel="step", ylabel="velocity of the gravest mode")
    wave.legend(frameon=False)
    fine = np.linspace(1, 45 if bench.quick else 85)
    law.plot(fine, np.sqrt(fine), color="#0072B2", linewidth=1, label="q = 1, two colours")
    law.plot(fine, np.sqrt(random_order * fine), color="#D55E00", linewidth=1, label="q = 0.797, random order")
    law.set(xlabel="sweeps a step", ylabel="speed of sound [d/h]")
    law.legend(frameon=False)

    bench.progress("solved")
    unsolved = Chain(at_rest=False, method="gaussSeidel", maxIterations=40, tolerance=1e-300)
    run(1)
    felt = contacts()[0].phys.normal / unsolved.force
    solved = Chain(at_rest=False, tolerance=1e-10)
    run(1)
    free = solved.force * O.dt / solved.disks[-1].state.mass
    why = "news has diffused over √(2 N) = 9 of 50 disks: exp(−50²/(4 N)) = 2e-7, with a wide margin"
    claims.at_most("40 plain sweeps: force at the wall in the first step [F]", felt, 1e-3, why)
    why = "tolerance 1e-10 times the chain's condition number, 4e3, and a margin"
    what = "accelerated, 1e-10: force at the wall in the first step [F]"
    claims.near(what, contacts()[0].phys.normal / solved.force, 1, why, absolute=1e-6)
    why = "the same error, against the speed that the last disk would get alone"
    claims.at_most("accelerated, 1e-10: fastest disk [F h/m]", solved.engine.maxSpeed / free, 1e-6, why)
    plot = figure, "Left: velocity after a start in the gravest mode. Right: speed of sound; dots: computed."
    heads = ["sweeps", "period [h]", "decay time [h]", "speed of sound [d/h]"]
    table = "Gravest mode of 50 disks; in brackets, derived (speed: in long waves)", heads, rows
    return Findings(claims, plots=[plot], tables=[table])
