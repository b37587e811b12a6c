"""The same problems solved by Siconos, which shares no line with our solver: cones, local solutions and stopping test
are its own.
"""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from ... import contact
from . import disk_problems
from .claims import Claims, Findings
from .registry import check
from .siconos_solve import ROOT, OracleError, error_by_siconos, solve_with_ours, solve_with_siconos

SUBJECT = "Against Siconos"
ROUNDING = 1e-14  # a relative residual below this is an exact solution in double precision
FALL = 9.81 * 5e-3  # m/s, what a free disk gains in a step
METRIC = 5  # between the two residuals, once both are relative to the same size
METRIC_WHY = (
    "its tolerance; the two measures weigh contacts by other powers of the mass and project on a cone or on intervals, which a "
    "factor of 5 covers"
)
SAME_WHY = "the tolerance itself, and rounding"


# ---- small random problems -----------------------------------------------------------------------
@check("Random clusters with friction, solved by Siconos too", subject=SUBJECT, seconds=3)
def siconos_random_friction(bench):
    """Three to 22 disks of random radii, masses and velocities fly at each other and at a floor; up to some 50
    contacts, some of them open. Every fifth disk cannot turn, every eighth cannot move sideways. Siconos's
    ``fc2d_driver`` (nonlinear Gauss-Seidel, each contact solved exactly) solves the same step in its own form: cone
    :math:`|T|\\le\\mu N`, normal velocity changed to :math:`U^n+\\mu|U^t|` (De Saxcé).

    Both forms have the same solutions, so velocities must agree to what both leave over. Forces of closed loops of
    contacts may differ: there they are not unique. Each solver is given the same number as tolerance on its own test:
    ours is the natural map relative to the rms impulse, Siconos's the same relative to :math:`|q|`.
    """
    return _random_problems(bench, {})


@check(
    "Random clusters with friction, rolling resistance and cohesion, solved by Siconos too", subject=SUBJECT, seconds=3
)
def siconos_random_rolling_cohesion(bench):
    """The same as without rolling and cohesion, but two thirds of the contacts resist rolling with an arm up to
    :math:`0.2\\,\\ell` and two thirds bear tension. Siconos's ``rolling_fc2d_driver`` knows the cone
    :math:`|T|\\le\\mu\\hat N,\\ |\\Gamma|\\le\\mu_r\\ell\\hat N` with :math:`U^n+\\mu|U^t|+\\mu_r\\ell|w|`. Cohesion is
    put in by the shift :math:`\\hat N = N+F_a`, :math:`\\hat q = q - W(F_a,0,0)`: eqs 1 to 6 of the paper say nothing
    else.
    """
    return _random_problems(bench, {"rolling": True, "cohesion": True})


def _random_problems(bench, kind, tolerance=1e-10, sweeps=200000, count=20):
    rows, speeds, theirs_left, ours_left, by_siconos, ratios, above, indeterminate = [], [], [], [], [], [], 0, 0
    for seed in range(count):
        problem = disk_problems.random_cluster(seed, 3 + seed, **kind)
        theirs = solve_with_siconos(problem, bench.folder, tolerance, sweeps)
        ours = solve_with_ours(problem, tolerance, sweeps)
        further = solve_with_ours(problem, _as_far(tolerance, theirs), sweeps)
        error, q_over_p = error_by_siconos(problem, bench.folder, ours.impulse)
        speeds.append(_speed_differences(theirs, ours, _radii(problem)).max())
        theirs_left.append(theirs.residual.relative / q_over_p)
        by_siconos.append(error * q_over_p)
        ours_left.append(ours.residual.relative)
        above += max(ours.residual.relative, ROUNDING) > max(theirs.residual.relative, ROUNDING)
        ratios.append(max(further.residual.relative, ROUNDING) / max(theirs.residual.relative, ROUNDING))
        forces = np.abs(theirs.impulse - ours.impulse).max() / np.abs(ours.impulse).max()
        indeterminate += forces > 1e4 * tolerance
        figures = [
            [str(a.sweeps), f"{a.residual.force_rms:.1e}", f"{a.residual.speed_rms:.1e}"] for a in (theirs, ours)
        ]
        rows.append(
            [str(seed), str(len(problem.length)), *figures[0], *figures[1], f"{speeds[-1]:.1e}", f"{forces:.1e}"]
        )
    claims = Claims(against="Siconos")
    why = "1e-10 of what stops disks of 1 m/s, times 1000: the condition of W for chains of up to 20 disks"
    claims.at_most(
        "largest difference of a disk's velocity (turning: times the radius) [m/s]", max(speeds), 1e3 * tolerance, why
    )
    claims.at_most(
        "Siconos's largest residual in our measure, times |p|/|q|", max(theirs_left), METRIC * tolerance, METRIC_WHY
    )
    what = "Siconos's error of our impulses by its own function, times |q|/|p|, largest"
    claims.at_most(what, max(by_siconos), METRIC * tolerance, METRIC_WHY)
    claims.at_most("our largest relative residual at the same number", max(ours_left), tolerance * (1 + 1e-6), SAME_WHY)
    why = f"at or below on every problem is what is asked for; below {ROUNDING:g} both count as exact"
    what = "our residual over Siconos's, ours asked for what Siconos reached, largest of all problems"
    claims.at_most(what, max(ratios), 1.0, why)
    remarks = [
        f"With the same number as tolerance our residual is above Siconos's on {above} of {count} problems, though never above the tolerance: each "
        "stops at the first sweep that passes its own test. Ours is relative to the rms impulse; Siconos's is relative to |q|, and fc2d first wants "
        "the change of a sweep below it as well.",
        f"On {indeterminate} of {count} problems an impulse differs by more than 1e-6 of the largest one while velocities agree: closed loops of "
        "contacts leave them undetermined.",
    ]
    heads = (
        "seed | contacts | Siconos: sweeps | N | m/s | ours: sweeps | N | m/s | velocities differ by [m/s] | "
        "impulses by [of the largest]"
    ).split(" | ")
    caption = f"Tolerance {tolerance:g} for both; N and m/s: rms natural-map residual of either in our measure, as a force and as a velocity"
    return Findings(claims=claims, tables=[(caption, heads, rows)], remarks=remarks)


# ---- steps of packings ---------------------------------------------------------------------------
@check("A packing of 5,000 disks at rest, solved by Siconos too", subject=SUBJECT, seconds=60, quick=10)
def siconos_packing(bench):
    """The packing that LMGC90 made (``tests/data``), at rest, with friction, from a cold start: all weight has yet to
    find its way to the floor. The packing is hyperstatic, so forces are not unique. Velocities are, but for disks that
    friction lets wedge or fall: both are solutions of Coulomb's law. A disk counts as one of those if the two solutions
    move it apart by more than a tenth of what a free disk gains in the step, although both leave far less over. A quick
    run takes the contacts of the lowest sixteenth of its height.
    """
    x, y, r = np.loadtxt(_data("lmgc90_5000_disks.txt.gz"), usecols=(0, 1, 2)).T
    width = 409.59035
    walls = [(0, 0, 0, 1), (0, 0, 1, 0), (width, 0, -1, 0)]
    # what overlaps LMGC90 left would lift the packing if they were taken back
    problem = disk_problems.of_disks(x, y, r, walls, relaxation=0, rolling=0)
    if bench.quick:
        problem = disk_problems.below(problem, y.max() / 16)
    return _one_step(bench, problem, tolerance=1e-5, sweeps=30000)


@check("A slope at failure, solved by Siconos too", subject=SUBJECT, seconds=40, quick=None)
def siconos_slope_at_failure(bench):
    """A step of the paper's slope with 1,200 disks, just before the backstop reaches its strength (t₁;
    ``tests/data/slope_t1.h5``): bonds, rolling resistance, water; from a cold start. Siconos's rolling solver, cohesion
    shifted.
    """
    return _one_step(bench, contact.load(_data("slope_t1.h5")), tolerance=1e-6, sweeps=60000)


@check("The moving avalanche, solved by Siconos too", subject=SUBJECT, seconds=30, quick=None)
def siconos_avalanche(bench):
    """A step of the same slope at its largest kinetic energy (t₄; ``tests/data/avalanche_t4.h5``): impacts, sliding,
    rolling and residual cohesion, from a cold start.
    """
    return _one_step(bench, contact.load(_data("avalanche_t4.h5")), tolerance=1e-6, sweeps=60000)


def _one_step(bench, problem, tolerance, sweeps):
    radii, moved = _radii(problem), problem.inverse_mass.any(axis=1)
    moved[np.setdiff1d(np.arange(len(moved)), problem.body)] = False  # what nothing touches falls alike
    bench.progress("both at ten times the tolerance")
    before = [
        solve_with_siconos(problem, bench.folder, 10 * tolerance, sweeps),
        solve_with_ours(problem, 10 * tolerance, sweeps),
    ]
    bench.progress("Siconos")
    theirs = solve_with_siconos(problem, bench.folder, tolerance, sweeps)
    bench.progress("ours")
    ours = solve_with_ours(problem, tolerance, sweeps)
    further = solve_with_ours(problem, _as_far(tolerance, theirs), sweeps)
    equal = solve_with_ours(problem, _as_far(1.0, theirs), sweeps)
    error, q_over_p = error_by_siconos(problem, bench.folder, ours.impulse)
    differences_before = _speed_differences(*before, radii)[moved]
    differences = _speed_differences(theirs, further, radii)[moved]
    other = differences > 0.1 * FALL
    forces = further.residual.force_rms / theirs.residual.force_rms
    velocities = further.residual.speed_rms / theirs.residual.speed_rms
    claims = Claims(against="Siconos")
    claims.at_most("our relative residual at the same number", ours.residual.relative, tolerance * (1 + 1e-6), SAME_WHY)
    what = "Siconos's residual in our measure, times |p|/|q|"
    claims.at_most(what, theirs.residual.relative / q_over_p, METRIC * tolerance, METRIC_WHY)
    what = "Siconos's error of our impulses by its own function, times |q|/|p|"
    claims.at_most(what, error * q_over_p, METRIC * tolerance, METRIC_WHY)
    why = "at or below is what is asked for"
    claims.at_most("our residual over Siconos's as a force, ours asked for what Siconos reached", forces, 1.0, why)
    why = "the same in the other unit, though tolerances are on forces"
    claims.at_most(
        "our residual over Siconos's as a velocity, ours asked for what Siconos reached", velocities, 1.0, why
    )
    why = "1 % of what a free disk gains in the step"
    claims.at_most("median difference of the disks' velocities [m/s]", np.median(differences), 0.01 * FALL, why)
    why = "two solvers of one law approach each other; a tenth would be linear, slow modes leave more"
    what = "the same, over that at ten times the tolerance"
    claims.at_most(what, np.median(differences) / np.median(differences_before), 0.5, why)
    why = "the rest wedges or falls, as friction leaves open; a few in a hundred disks of a packing are that loose"
    claims.at_least(
        "share of disks that both move the same, to a tenth of a step's free fall", 1 - other.mean(), 0.98, why
    )
    caption = f"From a cold start; tolerance {tolerance:g}; residuals in our measure, one thread each; each row of ours names its tolerance"
    named = (
        (theirs, theirs.solver),
        (ours, "ours, the same number"),
        (further, "ours, the lower of that and what Siconos reached"),
        (equal, "ours, what Siconos reached"),
    )
    remarks = [
        f"With the same number as tolerance our residual is {ours.residual.force_rms / theirs.residual.force_rms:.2f} times Siconos's. The numbers "
        f"do not mean the same: ours is relative to the rms impulse, Siconos's to |q|, which is {q_over_p:.2f} times as large here. So our solver "
        "was also asked for the residual that Siconos had reached.",
        f"Impulses of the two solutions differ by {_relative_difference(theirs.impulse, further.impulse, problem):.2g} (rms, relative): hyperstatic "
        "forces are not unique.",
        f"{int(other.sum())} of {len(other)} disks move differently by more than a tenth of a step's free fall; the largest difference is "
        f"{differences.max():.2g} m/s. Both keep the law to {max(theirs.residual.speed_largest, further.residual.speed_largest):.1g} m/s at every contact.",
    ]
    heads = ["solver", "sweeps", "seconds", "rms [N]", "largest [N]", "rms [m/s]", "largest [m/s]"]
    curves = (
        "Residual in our measure against sweeps, from a cold start. Plain Gauss-Seidel is the method of both; ours runs it inside Nesterov's "
        "extrapolation."
    )
    table = caption, heads, [_row(a, name) for a, name in named]
    plot = _curves(bench, problem, theirs), curves
    return Findings(claims, tables=[table], plots=[plot], remarks=remarks)


def _row(answer, name):
    r = answer.residual
    return [
        name,
        str(answer.sweeps),
        f"{answer.seconds:.2f}",
        f"{r.force_rms:.2e}",
        f"{r.force_largest:.2e}",
        f"{r.speed_rms:.2e}",
        f"{r.speed_largest:.2e}",
    ]


def _curves(bench, problem, theirs):
    """Residuals after fixed numbers of sweeps: each point a run of its own."""
    counts = [n for n in (1, 3, 10, 30, 100, 300, 1000, 3000) if n <= (30 if bench.quick else theirs.sweeps)]
    solvers = {
        theirs.solver: lambda n: solve_with_siconos(problem, bench.folder, 1e-15, n, check_every=10),
        "ours, plain Gauss-Seidel": lambda n: solve_with_ours(problem, 1e-15, n, "gaussSeidel", check_every=10),
        "ours": lambda n: solve_with_ours(problem, 1e-15, n, check_every=10),
    }
    figure = Figure(figsize=(6.4, 4.0))
    axes = figure.subplots()
    for (name, solver), marker in zip(solvers.items(), "osD"):
        bench.progress(f"residual against sweeps, {name}")
        axes.loglog(counts, [solver(n).residual.force_rms for n in counts], marker=marker, ms=4, label=name)
    axes.set(xlabel="sweeps", ylabel="rms residual [N]")
    axes.grid(alpha=0.3)
    axes.legend()
    return figure


# ---- comparisons ---------------------------------------------------------------------------------
def _as_far(tolerance, theirs):
    """The tolerance for our solver to be at or below what Siconos reached; a hundredth less, for rounding."""
    return min(tolerance, max(0.99 * theirs.residual.relative, ROUNDING))


def _radii(problem):
    """Lever of each body's turning [m], to compare it with its velocity: its largest lever in any contact, (b,)."""
    radii = np.zeros(len(problem.inverse_mass))
    for column, side in ((1, 0), (3, 1)):
        np.maximum.at(radii, problem.body[:, side], np.abs(problem.lever[:, column]))
    return radii


def _speed_differences(a, b, radii):
    """Of every body [m/s], turning times the radius."""
    difference = a.velocity - b.velocity
    return np.sqrt(difference[:, 0] ** 2 + difference[:, 1] ** 2 + (radii * difference[:, 2]) ** 2)


def _relative_difference(a, b, problem):
    scale = np.column_stack([np.ones(len(a)), np.ones(len(a)), 1 / problem.length])
    return float(np.linalg.norm((a - b) * scale) / np.linalg.norm(b * scale))


def _data(name):
    path = ROOT / "tests" / "data" / name
    if not path.exists():
        raise OracleError(
            f"{path} is not there: this check needs the data of a source checkout (tests/data/README.md says where they come from)"
        )
    return path
