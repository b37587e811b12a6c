"""A packing at rest by LMGC90: its step in our arrays, the same step by us, and a hundred steps in YADE."""

import numpy as np
from matplotlib.figure import Figure
from scipy.stats import ks_2samp

from yade import O

from ... import contact
from ...world import tables
from . import lmgc90_packing as lp
from .claims import Claims, Findings
from .registry import check

SUBJECT = "A packing of 5,000 disks by LMGC90"


@check("LMGC90's step in our arrays: geometry, velocities, momentum and graphs", subject=SUBJECT, seconds=3)
def lmgc90_step_in_our_arrays(bench):
    """LMGC90 2025.rc1 wrote out one step of 5,000 disks at rest in a box: positions, velocities before and after, and
    for each of 10,531 contacts the forces, the gap at the end and the relative velocities. The disks are put into YADE
    at x + h/2 v, where LMGC90 (θ = 1/2) looks at its contacts. Our contact problem is then its problem: same pairs,
    frames, gaps g and free velocities v + h g.

    Held against its figures: gap + h vn must be its gap at the end; its velocities after the step must give its vn and
    vt in our frames; with its forces as impulses, M (v⁺ − v)/h must equal weight plus forces for every disk; and the
    natural map must vanish to what its own tolerance allows. LMGC90 stopped at "Quad" 1e-6, so our figure of that test
    must come out just below 1e-6 for its forces: this checks our reading of the test.

    Two differences are known. LMGC90 writes vn and vt as each contact's own last visit left them, exactly 0 where it
    presses, and the bodies' velocities from the reactions before that visit: they differ by that visit's change. And
    its levers are the radii, where ours reach to the middle of the gap or overlap, r + g/2; for comparison, its levers
    are put into our arrays."""
    dump = lp.load()
    engine = lp.build(dump, tolerance=1e-3)
    O.step()
    problem = lp.dump_step(bench.folder / "step.h5")
    theirs = lp.with_radius_levers(problem, dump)
    impulse, at = lp.impulses_of(dump, problem)

    table = tables.contacts(engine)
    keys = lp.pair_keys(np.c_[table["id1"], table["id2"]])
    order = np.argsort(keys)
    gap = table["gap"][order[np.searchsorted(keys, lp.pair_keys(dump.pair), sorter=order)]]
    gap_error = np.abs(gap + lp.H * dump.vn - dump.gap_end).max()
    u = lp.relative_velocities(theirs, np.r_[dump.velocity_end, np.zeros((3, 3))])[at]
    velocity_error = lp.velocities_of(theirs, impulse)[: lp.DISKS] - dump.velocity_end
    inertia = np.c_[dump.mass, dump.mass, 0.5 * dump.mass * dump.r**2]
    unbalanced = np.abs(velocity_error) * inertia / lp.H
    rms_force = float(np.sqrt((dump.fn**2 + dump.ft**2).mean()))
    residual, changes = contact.residual(theirs, impulse), contact.velocity_changes(theirs, impulse)
    ours = contact.residual(problem, impulse)
    carried = lp.balance(dump, theirs, impulse)
    last_visit = (
        "the change by LMGC90's last visit, Quad 1e-6: that share of W P, which is 1.3 m/s (rms), "
        "and some 16 times as much at the worst contact"
    )
    claims = Claims(against="LMGC90")
    why = "the same pairs, all of them"
    claims.near("contacts with a gap below LMGC90's alert distance", (table["gap"] < lp.ALERT).sum(), len(dump.fn), why)
    why = "coordinates of 400 m have a rounding of 6e-14 m, the sides' tilt is known to 17 digits over 90 m"
    claims.at_most("gap + h vn, largest difference from its gap at the end [m]", gap_error, 2e-12, why)
    claims.at_most(
        "U^n from its velocities, largest difference from vn [m/s]", np.abs(u[:, 0] - dump.vn).max(), 2e-5, last_visit
    )
    claims.at_most("the same, rms [m/s]", np.sqrt(((u[:, 0] - dump.vn) ** 2).mean()), 2e-6, last_visit)
    claims.at_most(
        "U^t from its velocities, largest difference from −vt [m/s]", np.abs(u[:, 1] + dump.vt).max(), 3e-5, last_visit
    )
    why = "it stopped at 1e-6: that share of the rms contact force"
    what = "force that its step misses in a disk's balance of momentum, largest [N]"
    claims.at_most(what, unbalanced[:, :2].max(), 1e-6 * rms_force, why)
    why = "the same, radii being near 1 m"
    claims.at_most(
        "torque that it misses in a disk's balance, largest [N m]", unbalanced[:, 2].max(), 1e-6 * rms_force, why
    )
    why = "Newton's law for the sum over all disks, with its forces: rounding"
    what = "share of the weight carried by floor and sides, and falling"
    claims.near(what, carried.carried + carried.falling, 1, why, absolute=1e-11)
    why = "it stopped at the first look, one in 50 sweeps, that found less than 1e-6"
    claims.between("our figure of its test Quad", changes.quad, 0.3e-6, 1e-6, why)
    why = (
        "an rms like Quad's, weighted with impulses instead of velocities: near its tolerance, no more can be said "
        "beforehand"
    )
    claims.at_most("residual of its forces, relative", residual.relative, 2e-6, why)
    why = "the same times the rms contact force"
    claims.at_most("residual as a force, rms [N]", residual.force_rms, 2e-6 * rms_force, why)
    why = "1e-6 of what one contact's force alone would give a disk in a step, some 1 m/s, with a margin of 10"
    claims.at_most("residual as a velocity, rms [m/s]", residual.speed_rms, 1e-5, why)
    why = "half an overlap (up to 1e-4 m) times the rolling of neighbours"
    claims.at_most("with our levers instead: residual as a velocity, rms [m/s]", ours.speed_rms, 1e-4, why)
    rows = [
        [
            name,
            f"{r.relative:.2e}",
            f"{r.force_rms:.2f}",
            f"{r.force_largest:.1f}",
            f"{r.speed_rms:.1e}",
            f"{r.speed_largest:.1e}",
            f"{c.quad:.2e}",
            f"{c.qm16:.2e}",
            f"{c.maxm:.2e}",
        ]
        for name, r, c in (
            ("its levers, r", residual, changes),
            ("ours, r + g/2", ours, contact.velocity_changes(problem, impulse)),
        )
    ]
    heads = ["levers", "relative", "rms [N]", "largest [N]", "rms [m/s]", "largest [m/s]", "Quad", "QM/16", "Maxm"]
    table = "LMGC90's forces in our problem: the natural-map residual, and its own tests' figures.", heads, rows
    return Findings(claims, tables=[table])


def _missed(dump, engine):
    """What the step's contact forces and weight miss of M (v⁺ − v)/h, (n, 2) [N] and (n,) [N m]; from the scene's
    interactions and states, not from the solver's arrays."""
    table, after = tables.contacts(engine), tables.bodies(engine)
    first, second = table["id1"], table["id2"]
    n = np.c_[table["nx"], table["ny"]]  # YADE's, from the first body to the second; turned about, n and t keep N and T
    push = table["normal"][:, None] * n + table["tangential"][:, None] * np.c_[-n[:, 1], n[:, 0]]  # on the second body
    force, torque = np.zeros((lp.DISKS + 3, 2)), np.zeros(lp.DISKS + 3)
    centre, at = np.r_[dump.middle, np.zeros((3, 2))], np.c_[table["x"], table["y"]]
    for body, f in ((second, push), (first, -push)):
        arm = at - centre[body]
        np.add.at(force, body, f)
        np.add.at(torque, body, arm[:, 0] * f[:, 1] - arm[:, 1] * f[:, 0])
    gained = dump.mass[:, None] * (np.c_[after["vx"], after["vy"]] - dump.velocity[:, :2]) / lp.H
    spun = 0.5 * dump.mass * dump.r**2 * (after["omega"] - dump.velocity[:, 2]) / lp.H
    return gained - force[: lp.DISKS] + np.outer(dump.mass, (0, lp.G)), spun - torque[: lp.DISKS]


def _over_mean_at_depth(force, height, layers=15):
    """N/⟨N⟩ with the mean of the layer that a contact stands in, of layers that hold equally many contacts: forces grow
    with depth.
    """
    layer = np.searchsorted(np.quantile(height, np.linspace(0, 1, layers + 1)[1:-1]), height)
    return force / (np.bincount(layer, force) / np.bincount(layer))[layer]


@check("One step by us: sums, distribution of forces, coordination", subject=SUBJECT, seconds=4)
def lmgc90_step_by_us(bench):
    """The step is solved by YADE from a cold start (no forces known), and by the solver again from LMGC90's forces.

    What can be compared. Every disk's momentum must balance to rounding, whatever the solver's tolerance, since
    velocities are made from the forces. What the floor carries and the momentum left must add up to the weight. The
    distribution of normal forces and the number of pressed contacts are properties of the packing and must agree within
    what two solutions of one packing differ. Under gravity forces grow with depth, so N is taken over the mean ⟨N⟩ of
    its layer (a fifteenth of the contacts).

    What cannot. A rigid packing with friction is hyperstatic: its single forces are not unique. LMGC90 itself, started
    cold on this packing, differs from the forces it was warm started with by 0.3 to 0.43 of the mean normal force
    (rms), with a correlation of 0.95. Ours may differ as much, not more. Nor is the floor's share exact: a cold solve
    leaves to fall what a solve that knows the forces holds, here about 1 % (disks whose gaps, up to g h² = 0.25 mm, may
    still close)."""
    dump = lp.load()
    engine = lp.build(dump, tolerance=1e-5)
    O.step()
    problem = lp.dump_step(bench.folder / "step.h5")
    theirs, at = lp.impulses_of(dump, problem)
    warm = contact.solve(problem, start=theirs, tolerance=1e-6, max_iterations=20000)

    missed, missed_torque = _missed(dump, engine)
    warm_missed = (
        np.abs(lp.velocities_of(problem, warm.impulse) - warm.velocity)[: lp.DISKS, :2] * dump.mass[:, None] / lp.H
    ).max()
    cold = problem.impulse
    sums = {
        name: lp.balance(dump, problem, p) for name, p in (("cold", cold), ("warm", warm.impulse), ("LMGC90", theirs))
    }

    normal = {"LMGC90": dump.fn, "cold": cold[at, 0] / lp.H, "warm": warm.impulse[at, 0] / lp.H}
    mean = dump.fn[dump.fn > 0].mean()
    i, j = dump.pair.T
    height = np.where(j < lp.DISKS, 0.5 * (dump.y[i] + dump.y[j.clip(max=lp.DISKS - 1)]), dump.y[i])
    pressed = {name: f > 1e-3 * mean for name, f in normal.items()}
    share = {name: _over_mean_at_depth(f[pressed[name]], height[pressed[name]]) for name, f in normal.items()}
    coordination = {name: float(2 * p[dump.pair[:, 1] < lp.DISKS].sum() / lp.DISKS) for name, p in pressed.items()}
    either = (dump.fn > 0) | (normal["cold"] > 0)
    rms = np.sqrt(((normal["cold"] - dump.fn)[either] ** 2).mean()) / mean
    correlation = np.corrcoef(normal["cold"][either], dump.fn[either])[0, 1]
    below = {name: float((s < 1).mean()) for name, s in share.items()}
    # a of exp(−a N/⟨N⟩), the likeliest one for N > 2 ⟨N⟩
    decay = {name: float(1 / (s[s > 2] - 2).mean()) for name, s in share.items()}
    largest = float(np.abs(normal["cold"]).max())
    claims = Claims()
    why = "rounding (1e-16) of sums of some ten forces of up to 2e7 N, with a margin of 10"
    claims.at_most(
        "cold: force missing in a disk's balance of momentum, largest [N]", np.abs(missed).max(), 1e-14 * largest, why
    )
    why = "rounding of coordinates of 400 m (6e-14 m) times forces of up to 2e7 N, ten contacts"
    what = "cold: torque missing in a disk's balance of angular momentum, largest [N m]"
    claims.at_most(what, np.abs(missed_torque).max(), 6e-13 * largest, why)
    why = "the same rounding"
    claims.at_most(
        "warm: force missing in a disk's balance of momentum, largest [N]", warm_missed, 1e-14 * largest, why
    )
    why = "Newton's law for the sum over all disks: rounding"
    what = "cold: share carried by floor and sides, and falling"
    claims.near(what, sums["cold"].carried + sums["cold"].falling, 1, why, absolute=1e-11)
    why = "LMGC90's warm solution carries 1.000; up to 2 % is left to gaps that close in the step"
    claims.between(
        "cold: share of the weight that is carried", sums["cold"].carried, 0.98, 1.001, why, against="LMGC90"
    )
    why = "the sides' friction, 2e-3 of the weight, is not unique"
    what = "warm: share of the weight on the floor"
    claims.near(what, sums["warm"].floor, sums["LMGC90"].floor, why, absolute=2e-3, against="LMGC90")
    why = "what a tolerance of 1e-6 leaves undecided across 30 layers"
    claims.near(
        "warm: share carried", sums["warm"].carried, sums["LMGC90"].carried, why, absolute=5e-4, against="LMGC90"
    )
    why = "the nearest solution to a solution is itself, but for our levers r + g/2"
    what = "warm: rms difference of normal forces over the mean"
    value = np.sqrt(((normal["warm"] - dump.fn) ** 2)[pressed["LMGC90"]].mean()) / mean
    claims.at_most(what, value, 0.05, why, against="LMGC90")
    why = "LMGC90 cold differs from LMGC90 warm by 0.3 to 0.43; less would be no fault, far less would be no cold start"
    claims.between(
        "cold: rms difference of normal forces over the mean", rms, 0.2, 0.43, why, against="LMGC90 with itself"
    )
    why = "LMGC90 cold against warm: 0.95"
    claims.between("cold: correlation of normal forces", correlation, 0.93, 1, why, against="LMGC90 with itself")
    why = (
        "chance alone gives 0.02 for 8,800 independent forces (5 % level); forces of one disk are not independent, "
        "twice that"
    )
    what = "cold: Kolmogorov-Smirnov distance of N/⟨N⟩ from LMGC90's"
    claims.at_most(what, ks_2samp(share["cold"], share["LMGC90"]).statistic, 0.04, why, against="LMGC90")
    why = "rattlers rest on one side or the other: some per cent of the contacts"
    claims.near(
        "cold: coordination number", coordination["cold"], coordination["LMGC90"], why, relative=0.03, against="LMGC90"
    )
    why = "four times what chance makes of 8,800 independent contacts"
    what = "cold: share of pressed contacts below the mean force"
    claims.near(what, below["cold"], below["LMGC90"], why, absolute=0.02, against="LMGC90")
    why = (
        "1,300 forces in the tail: 3 % by chance in each, 4 % in the difference; not independent, so twice that and "
        "more"
    )
    what = "cold: decay a of the strong forces, exp(−a N/⟨N⟩) above 2 ⟨N⟩"
    claims.near(what, decay["cold"], decay["LMGC90"], why, relative=0.1, against="LMGC90")
    quantiles = (0.1, 0.25, 0.5, 0.75, 0.9, 0.99)
    rows = [
        [
            name,
            f"{np.mean(normal[name][pressed[name]]) / 1e6:.3f}",
            *(f"{q:.3f}" for q in np.quantile(share[name], quantiles)),
            f"{below[name]:.3f}",
            f"{decay[name]:.2f}",
            f"{coordination[name]:.3f}",
            f"{sums[name].floor:.4f}",
            f"{sums[name].sides:+.4f}",
        ]
        for name in ("LMGC90", "cold", "warm")
    ]
    heads = [
        "solution",
        "⟨N⟩ [MN]",
        *(f"{q:g}" for q in quantiles),
        "below mean",
        "decay",
        "coordination",
        "floor",
        "sides",
    ]
    remark = (
        f"Cold: {engine.iterations} sweeps to {engine.residual:.1e}. "
        f"Warm, from LMGC90's forces: {warm.iterations} sweeps to {warm.relative:.1e}. "
        f"Between LMGC90's forces and ours from a cold start: correlation {correlation:.3f}, rms difference {rms:.2f} of the mean. "
        "Radjai (1996) found over 60 % of the contacts below the mean and a decay of 1.4 in packings without gravity; "
        f"here {below['LMGC90']:.3f} and {decay['LMGC90']:.2f} in LMGC90's solution, {below['cold']:.3f} and {decay['cold']:.2f} in ours."
    )
    title = (
        "Normal forces over their mean at the same depth: quantiles; coordination number; shares of the weight on the "
        "floor and by friction at the sides."
    )
    table = title, heads, rows
    return Findings(
        claims, plots=[_distribution(share), _scatter(dump.fn, normal["cold"], mean)], tables=[table], remarks=[remark]
    )


def _distribution(share):
    figure = Figure(figsize=(7.5, 4.2))
    axes = figure.add_subplot()
    bins = np.linspace(0, 7, 36)
    for name, style in (("LMGC90", "o-"), ("cold", "s-"), ("warm", "^:")):
        density, _ = np.histogram(share[name], bins, density=True)
        label = name if name == "LMGC90" else f"ours, {name}"
        axes.semilogy(
            0.5 * (bins[1:] + bins[:-1]), np.where(density > 0, density, np.nan), style, ms=4, lw=1, label=label
        )
    x = np.linspace(1, 6, 50)
    axes.semilogy(x, 0.7 * np.exp(1.4 * (1 - x)), "k--", lw=0.8, label="slope of Radjai 1996, exp(1.4 (1 − N/⟨N⟩))")
    axes.set_xlabel("N/⟨N⟩, ⟨N⟩ at its depth")
    axes.set_ylabel("probability density")
    axes.legend()
    return figure, (
        "Distribution of normal forces above 0.001 of the mean, LMGC90's solution and ours; "
        "the dashed line shows a slope, its height is free."
    )


def _scatter(theirs, ours, mean):
    figure = Figure(figsize=(4.8, 4.8))
    axes = figure.add_subplot()
    axes.plot(theirs / mean, ours / mean, ".", ms=1.5, alpha=0.5)
    axes.plot([0, 8], [0, 8], "k-", lw=0.8)
    axes.set(xlabel="N/⟨N⟩, LMGC90", ylabel="N/⟨N⟩, ours from a cold start", xlim=(0, 8), ylim=(0, 8), aspect="equal")
    return figure, (
        "The same contacts' forces in both solutions. Forces of a hyperstatic packing are not unique: "
        "LMGC90's cold start scatters as much about its warm one."
    )


@check("A hundred steps in YADE: the packing stays at rest", subject=SUBJECT, seconds=60, quick=12)
def lmgc90_packing_stays_at_rest(bench):
    """The scene starts from LMGC90's velocities and forces and makes a hundred steps of 5 ms.

    With κ = 0 no overlap is taken back, as in LMGC90, and nothing should happen but what was happening: a few rattlers
    fall and roll (they hold 112 of the 115 J in LMGC90's step, and gain more as they go on). What must not happen is a
    drift of the disks that carry: displacements that grow with the number of steps. An error of the solve of relative
    size τ lets them creep, by a distance proportional to τ, so the median displacement must fall tenfold when τ does.
    The same error makes the packing swing slowly, as Unger and Kertész (2002) derived for chains: what is not converged
    acts as elasticity. The kinetic energy of the carrying disks, the fastest hundredth apart (rattlers' neighbours), is
    compared with W g h²/2 = 83 kJ, what all disks would gain by falling freely for one step. "Carrying" is a disk whose
    normal forces in LMGC90's step add up to three times its weight or more.

    With κ = 0.2, our default, LMGC90's overlaps (up to 1.2e-4 ℓ, mean 3e-6 ℓ) are taken back at once. Pushing apart 30
    layers by κ g/h each sends the whole packing up by some mm/s: the floor bears up to 1.16 of the weight in the first
    step, and the energy dies out in some fifty steps. That is a property of the overlaps it begins with; they must
    shrink, and the floor must bear the weight on the mean.

    The residual does not say whether the weight is borne: the sums over the walls are taken from O.forces."""
    dump = lp.load()
    carried = np.zeros(lp.DISKS + 3)
    np.add.at(carried, dump.pair.ravel(), np.repeat(dump.fn, 2))
    carrying = carried[: lp.DISKS] >= 3 * lp.G * dump.mass
    runs = [("1e-4", 1e-4, 0.0), ("1e-5", 1e-5, 0.0)] + (
        [] if bench.quick else [("1e-6", 1e-6, 0.0), ("1e-5, κ = 0.2", 1e-5, 0.2)]
    )
    found = {}
    for name, tolerance, rate in runs:
        bench.progress(f"a hundred steps, tolerance {name}")
        found[name] = _hundred_steps(dump, carrying, tolerance, rate)
    scale = 0.5 * dump.weight * lp.G * lp.H**2
    drift = {name: np.median(run["moved"]) for name, run in found.items()}
    fine = found["1e-5"]
    claims = Claims()
    why = "5e-4 of the weight over a hundred steps is a speed of 2.5 mm/s: it rests on the mean"
    claims.between("mean share of the weight carried, tolerance 1e-5", fine["carried"].mean(), 0.9995, 1.0005, why)
    why = "a swing of the packing by 0.1 mm/s within a step is 2e-3 of g h"
    claims.at_most("share on the floor, standard deviation over the steps", fine["floor"].std(), 2e-3, why)
    why = "the sides' friction, 2e-3 of the weight, is not unique"
    claims.near("share on the floor, mean", fine["floor"].mean(), 0.9985, why, absolute=2e-3, against="LMGC90")
    why = (
        "the residual as a velocity is 3e-5 m/s a contact; added up over 30 layers that is 9 J, 1.1e-4; five times "
        "that is allowed"
    )
    what = "kinetic energy of 99 % of the carrying disks, largest over the steps, over W g h²/2"
    claims.at_most(what, fine["energy"].max() / scale, 5e-4, why)
    why = "between the tolerance's ratio, 10, and its square, 100, to a factor of 2"
    claims.between(
        "the same energy at 1e-4 over that at 1e-5", found["1e-4"]["energy"].max() / fine["energy"].max(), 5, 200, why
    )
    why = "creep is proportional to the tolerance, to a factor of 3"
    claims.between("median displacement at 1e-4 over that at 1e-5", drift["1e-4"] / drift["1e-5"], 3, 30, why)
    why = "3e-5 of a mean diameter: some 2e-4 m/s for all of the time, were it steady"
    claims.at_most("median displacement of carrying disks in 0.5 s, tolerance 1e-5 [m]", drift["1e-5"], 1e-4, why)
    why = "overlaps appear where paths curve, at rattlers; LMGC90 took none back either"
    claims.at_most(
        "largest overlap at the end over that at the beginning", fine["overlap"][-1] / fine["overlap"][0], 1.5, why
    )
    if not bench.quick:
        settled = found["1e-5, κ = 0.2"]
        why = "as above; the smallest ones begin to feel the rattlers"
        claims.between("median displacement at 1e-5 over that at 1e-6", drift["1e-5"] / drift["1e-6"], 3, 40, why)
        why = "what goes up comes down within the hundred steps"
        claims.near("κ = 0.2: mean share of the weight carried", settled["carried"].mean(), 1, why, absolute=1e-3)
        why = "(1 − κ)^100 is nothing; new ones are made by rattlers and by the packing's coming down"
        what = "κ = 0.2: largest overlap at the end over that at the beginning"
        claims.at_most(what, settled["overlap"][-1] / settled["overlap"][0], 0.1, why)
        why = "impacts take it in some fifty steps"
        what = "κ = 0.2: energy of 99 % of the carrying disks after a hundred steps over its largest"
        claims.at_most(what, settled["energy"][-10:].mean() / settled["energy"].max(), 0.05, why)
    rows = [
        [
            name,
            f"{run['sweeps'][1:].mean():.1f}",
            f"{run['sweeps'].max()}",
            f"{run['carried'].mean():.5f}",
            f"{run['floor'].mean():.4f} ± {run['floor'].std():.4f}",
            f"{run['energy'].max():.3g}",
            f"{run['energy'][-10:].mean():.3g}",
            f"{run['rattlers'][-1]:.3g}",
            f"{drift[name]:.1e}",
            f"{run['moved'].max():.1e}",
            f"{run['overlap'][0]:.1e} → {run['overlap'][-1]:.1e}",
        ]
        for name, run in found.items()
    ]
    heads = (
        "tolerance | sweeps, mean | most | carried | floor | energy [J], largest | last ten steps | "
        "all others' [J] | moved [m], median | largest | worst overlap [ℓ]"
    ).split(" | ")
    title = (
        "A hundred steps from LMGC90's velocities and forces; energy: 99 % of the carrying disks, without the "
        "fastest."
    )
    table = title, heads, rows
    return Findings(claims, plots=[_history(found)], tables=[table])


def _hundred_steps(dump, carrying, tolerance, rate, steps=100):
    """Histories of length ``steps``: sweeps, shares of the weight, energies [J], worst overlap [ℓ]; and ``moved``, of
    the carrying disks [m].
    """
    O.reset()
    engine = lp.build(dump, tolerance=tolerance, relaxationRate=rate, maxIterations=5000)
    lp.warm_start(dump)
    names = ("sweeps", "floor", "carried", "energy", "rattlers", "overlap")
    rows = []
    for _ in range(steps):
        O.step()
        b = tables.bodies(engine)
        energy = 0.5 * dump.mass * (b["vx"] ** 2 + b["vy"] ** 2) + 0.25 * dump.mass * dump.r**2 * b["omega"] ** 2
        calm = np.sort(energy[carrying])[: int(0.99 * carrying.sum())].sum()
        floor, left, right = (-O.forces.f(wall)[1] / dump.weight for wall in (lp.FLOOR, lp.LEFT, lp.RIGHT))
        rows.append((engine.iterations, floor, floor + left + right, calm, energy.sum() - calm, engine.overlapWorst))
    moved = np.hypot(*(np.c_[b["x"], b["y"]] - dump.middle).T)[carrying]
    return {**{name: np.array(column) for name, column in zip(names, zip(*rows))}, "moved": moved}


def _history(found):
    figure = Figure(figsize=(9, 6))
    top, bottom = figure.subplots(2, 1, sharex=True)
    for name, run in found.items():
        top.semilogy(run["energy"], label=f"tolerance {name}")
        bottom.plot(run["floor"], label=name)
    top.set_ylabel("kinetic energy [J]")
    top.legend()
    bottom.set(xlabel="step", ylabel="share of the weight on the floor")
    return figure, "Kinetic energy of 99 % of the carrying disks, and what the floor bears; W g h²/2 is 83 kJ."
