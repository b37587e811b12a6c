"""What our solver and Siconos are held to on the same contact problems, in the plane and in space: on small random ones,
and on one step of a packing.
"""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from ...contact import SpaceProblem
from .claims import Claims, Findings
from .siconos_solve import error_by_siconos, solve_with_ours, solve_with_siconos

__all__ = ["EQUAL", "FALL", "METRIC", "ROUNDING", "of_one_step", "of_random_problems"]

ROUNDING = 1e-14  # a relative residual below this is an exact solution in double precision
FALL = 9.81 * 5e-3  # m/s, what a free grain gains in a step
EQUAL = 1e-6  # m/s, of velocities that are unique
METRIC = 5  # between the two residuals, once both are relative to the same size
METRIC_WHY = (
    "its tolerance; the two measures weigh contacts by other powers of the mass and project on a cone or on intervals, which a "
    "factor of 5 covers"
)
SAME_WHY = "the tolerance itself, and rounding"


def of_random_problems(bench, problems, tolerance=1e-10, sweeps=200000):
    """Both solve small problems that have one answer, to the same number as tolerance."""
    rows, speeds, theirs_left, ours_left, by_siconos, ratios, above, indeterminate = [], [], [], [], [], [], 0, 0
    count, grain = len(problems), _grain(problems[0])
    for seed, problem in enumerate(problems):
        theirs = solve_with_siconos(problem, bench.folder, tolerance, sweeps)
        ours = solve_with_ours(problem, tolerance, sweeps)
        further = solve_with_ours(problem, _as_far(tolerance, theirs), sweeps)
        error, over_p = error_by_siconos(problem, bench.folder, ours.impulse)
        speeds.append(_speed_differences(theirs, ours, _radii(problem)).max())
        theirs_left.append(theirs.residual.relative / over_p)
        by_siconos.append(error * over_p)
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
    why = (
        f"{tolerance:g} of what stops {grain}s of 1 m/s, times 1000: the condition of W for chains of up to 20 {grain}s"
    )
    what = f"largest difference of a {grain}'s velocity (turning: times the radius) [m/s]"
    claims.at_most(what, max(speeds), 1e3 * tolerance, why)
    claims.at_most(
        "Siconos's largest residual in our measure, times |p| over what its error is relative to",
        max(theirs_left),
        METRIC * tolerance,
        METRIC_WHY,
    )
    what = "Siconos's error of our impulses by its own function, times what it is relative to over |p|, largest"
    claims.at_most(what, max(by_siconos), METRIC * tolerance, METRIC_WHY)
    claims.at_most("our largest relative residual at the same number", max(ours_left), tolerance * (1 + 1e-6), SAME_WHY)
    why = f"at or below on every problem is what is asked for; below {ROUNDING:g} both count as exact"
    what = "our residual over Siconos's, ours asked for what Siconos reached, largest of all problems"
    claims.at_most(what, max(ratios), 1.0, why)
    change = ", and fc2d first wants the change of a sweep below it as well" if " fc2d" in theirs.solver else ""
    remarks = [
        f"With the same number as tolerance our residual is above Siconos's on {above} of {count} problems, though never above the tolerance: each "
        f"stops at the first sweep that passes its own test. Ours is relative to the rms impulse, Siconos's to |q| or |p|{change}.",
        f"On {indeterminate} of {count} problems an impulse differs by more than 1e-6 of the largest one while velocities agree: closed loops of "
        "contacts leave them undetermined.",
    ]
    heads = (
        "seed | contacts | Siconos: sweeps | N | m/s | ours: sweeps | N | m/s | velocities differ by [m/s] | "
        "impulses by [of the largest]"
    ).split(" | ")
    caption = f"Tolerance {tolerance:g} for both; N and m/s: rms natural-map residual of either in our measure, as a force and as a velocity"
    return Findings(claims=claims, tables=[(caption, heads, rows)], remarks=remarks)


def of_one_step(bench, problem, tolerance, sweeps, loose=0.02, starts=0, check_every=1, drawn=3000):
    """Both solve one step of a packing from a cold start; forces of it, and velocities of a few grains, are not unique.

    ``loose``: share of grains at most that may move otherwise; ``starts``: how many other first guesses tell which
    velocities are unique, which are then compared to :data:`EQUAL`; ``check_every``: sweeps between two looks of Siconos
    at its error; ``drawn``: sweeps at most in the plot.
    """
    grain = _grain(problem)
    radii, moved = _radii(problem), problem.inverse_mass.any(axis=1)
    moved[np.setdiff1d(np.arange(len(moved)), problem.body)] = False  # what nothing touches falls alike
    bench.progress("both at ten times the tolerance")
    before = [
        solve_with_siconos(problem, bench.folder, 10 * tolerance, sweeps, check_every),
        solve_with_ours(problem, 10 * tolerance, sweeps),
    ]
    bench.progress("Siconos")
    theirs = solve_with_siconos(problem, bench.folder, tolerance, sweeps, check_every)
    bench.progress("ours")
    ours = solve_with_ours(problem, tolerance, sweeps)
    further = _at_or_below(problem, tolerance, theirs, sweeps)
    equal = _at_or_below(problem, 1.0, theirs, sweeps)
    error, over_p = error_by_siconos(problem, bench.folder, ours.impulse)
    differences_before = _speed_differences(*before, radii)[moved]
    differences = _speed_differences(theirs, further, radii)[moved]
    other = differences > 0.1 * FALL
    forces = further.residual.force_rms / theirs.residual.force_rms
    velocities = further.residual.speed_rms / theirs.residual.speed_rms
    claims = Claims(against="Siconos")
    claims.at_most("our relative residual at the same number", ours.residual.relative, tolerance * (1 + 1e-6), SAME_WHY)
    what = "Siconos's residual in our measure, times |p| over what its error is relative to"
    claims.at_most(what, theirs.residual.relative / over_p, METRIC * tolerance, METRIC_WHY)
    what = "Siconos's error of our impulses by its own function, times what it is relative to over |p|"
    claims.at_most(what, error * over_p, METRIC * tolerance, METRIC_WHY)
    why = "at or below is what is asked for"
    claims.at_most("our residual over Siconos's as a force, ours asked for what Siconos reached", forces, 1.0, why)
    why = "the same in the other unit: tolerances are on forces, and ours is asked again where that was not enough"
    claims.at_most(
        "our residual over Siconos's as a velocity, ours asked for what Siconos reached", velocities, 1.0, why
    )
    why = "at or below Siconos's residual in both units at the same cost or less"
    claims.at_most("our sweeps to what Siconos reached, over Siconos's", equal.sweeps / theirs.sweeps, 1.0, why)
    why = f"1 % of what a free {grain} gains in the step"
    claims.at_most(f"median difference of the {grain}s' velocities [m/s]", np.median(differences), 0.01 * FALL, why)
    why = "two solvers of one law approach each other; a tenth would be linear, slow modes leave more"
    what = "the same, over that at ten times the tolerance"
    claims.at_most(what, np.median(differences) / np.median(differences_before), 0.5, why)
    why = f"the rest wedges or falls, as friction leaves open; a few in a hundred {grain}s of a packing are that loose"
    claims.at_least(
        f"share of {grain}s that both move the same, to a tenth of a step's free fall", 1 - other.mean(), 1 - loose, why
    )
    if starts:
        bench.progress("ours from other starts")
        _of_unique_velocities(claims, problem, theirs, 0.1 * tolerance, sweeps, starts, moved)
    caption = f"From a cold start; tolerance {tolerance:g}; residuals in our measure, one thread each; each row of ours names its tolerance"
    named = (
        (theirs, theirs.solver),
        (ours, "ours, the same number"),
        (further, "ours, the lower of that and what Siconos reached"),
        (equal, "ours, what Siconos reached"),
    )
    remarks = [
        f"With the same number as tolerance our residual is {ours.residual.force_rms / theirs.residual.force_rms:.2f} times Siconos's. The numbers "
        f"do not mean the same: ours is relative to the rms impulse, Siconos's to |q| or |p|, {over_p:.2f} times as large here. So our solver "
        "was also asked for the residual that Siconos had reached.",
        f"Impulses of the two solutions differ by {_relative_difference(theirs.impulse, further.impulse, problem):.2g} (rms, relative): hyperstatic "
        "forces are not unique.",
        f"{int(other.sum())} of {len(other)} {grain}s move differently by more than a tenth of a step's free fall; the largest difference is "
        f"{differences.max():.2g} m/s. Both keep the law to {max(theirs.residual.speed_largest, further.residual.speed_largest):.1g} m/s at every contact.",
    ]
    heads = ["solver", "sweeps", "seconds", "rms [N]", "largest [N]", "rms [m/s]", "largest [m/s]"]
    curves = (
        "Residual in our measure against sweeps, from a cold start. Plain Gauss-Seidel is the method of both; ours runs it inside Nesterov's "
        "extrapolation."
    )
    table = caption, heads, [_row(a, name) for a, name in named]
    plot = _curves(bench, problem, theirs, drawn), curves
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


def _curves(bench, problem, theirs, drawn):
    """Residuals after fixed numbers of sweeps: each point a run of its own."""
    counts = [
        n for n in (1, 3, 10, 30, 100, 300, 1000, 3000) if n <= (30 if bench.quick else min(theirs.sweeps, drawn))
    ]
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


# ---- what is unique ------------------------------------------------------------------------------
def _of_unique_velocities(claims, problem, theirs, tolerance, sweeps, starts, moved):
    """Velocities that our own solver finds again from impulses by chance are taken for unique, and Siconos's are held
    against those; what differs beside them is not unique either if our solver stays at Siconos's answer.
    """
    grain, radii = _grain(problem), _radii(problem)
    ours = solve_with_ours(problem, tolerance, sweeps)
    size, unique = np.sqrt(np.mean(ours.impulse**2)), moved.copy()
    for seed in range(starts):
        start = np.random.default_rng(seed).normal(0, size, ours.impulse.shape)
        again = solve_with_ours(problem, tolerance, sweeps, start=start)
        unique &= _speed_differences(again, ours, radii) <= EQUAL
    why = "so that nearly all are compared; the rest wedges or falls, as friction leaves open"
    what = f"share of {grain}s whose velocity we find again from {starts} starts by chance, to {EQUAL:g} m/s"
    claims.at_least(what, unique.sum() / moved.sum(), 0.9, why)
    same = (_speed_differences(theirs, ours, radii) <= EQUAL)[unique].mean()
    why = f"{EQUAL:g} m/s is asked for; a few are loose that no start of ours has shown, which the next claim looks at"
    claims.at_least(f"share of those that Siconos moves the same, to {EQUAL:g} m/s", same, 0.98, why)
    stayed = solve_with_ours(problem, tolerance, sweeps, start=theirs.impulse)
    change = _speed_differences(stayed, theirs, radii)[moved].max()
    why = "both are answers then: 1 % of what a free one gains in the step, where those that differ do so by a tenth of it"
    what = f"largest change of a {grain}'s velocity as our solver goes on from Siconos's impulses, to a tenth of its residual [m/s]"
    claims.at_most(what, change, 0.01 * FALL, why)


# ---- comparisons ---------------------------------------------------------------------------------
def _as_far(tolerance, theirs):
    """The tolerance for our solver to be at or below what Siconos reached; a hundredth less, for rounding."""
    return min(tolerance, max(0.99 * theirs.residual.relative, ROUNDING))


def _at_or_below(problem, tolerance, theirs, sweeps):
    """Ours, asked for the lower of the tolerance and what Siconos reached; again where that is not at or below it in newtons or
    as a velocity: the rms impulse of the two is not the same.
    """
    asked = _as_far(tolerance, theirs)
    found = solve_with_ours(problem, asked, sweeps)
    for _ in range(5):
        ours, other = found.residual, theirs.residual
        above = max(ours.force_rms / other.force_rms, ours.speed_rms / other.speed_rms)
        if above <= 1:
            break
        asked *= 0.9 / above
        found = solve_with_ours(problem, asked, sweeps)
    return found


def _grain(problem):
    return "sphere" if isinstance(problem, SpaceProblem) else "disk"


def _radii(problem):
    """Lever of each body's turning [m], to compare it with its velocity: its largest lever in any contact, (b,)."""
    radii = np.zeros(len(problem.inverse_mass))
    columns = (0, 1) if isinstance(problem, SpaceProblem) else (1, 3)
    for side, column in enumerate(columns):
        np.maximum.at(radii, problem.body[:, side], np.abs(problem.lever[:, column]))
    return radii


def _speed_differences(a, b, radii):
    """Of every body [m/s], turning times the radius."""
    difference = a.velocity - b.velocity
    moving = {3: 2, 6: 3}[difference.shape[1]]  # columns of v, in the plane and in space; the others turn
    difference[:, moving:] *= radii[:, None]
    return np.linalg.norm(difference, axis=1)


def _relative_difference(a, b, problem):
    scale = np.ones_like(b)
    scale[:, {3: 2, 6: 3}[b.shape[1]] :] /= problem.length[:, None]
    return float(np.linalg.norm((a - b) * scale) / np.linalg.norm(b * scale))
