"""The solver's method against others, by work, and what the thickness of a packing asks of it."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from ... import contact
from . import disk_problems, lmgc90_packing as lp, sweep_methods
from .claims import Claims, Findings
from .registry import check

SUBJECT = "The solver"
SHIPPED, PLAIN = "accelerated (shipped)", "Gauss-Seidel"
TOLERANCES = (1e-3, 1e-4, 1e-5)


def _cases(bench):
    """Name, problem and first guess of what the methods have to solve."""
    slope, moving = (contact.load(lp.DATA / name) for name in ("slope_t1.h5", "avalanche_t4.h5"))
    cases = [
        ("a slope's start, cold", slope, np.zeros_like(slope.warm_start)),
        ("an avalanche, from the step before", moving, moving.warm_start),
    ]
    if not bench.quick:
        _, problem, _ = lp.step_problem(bench.folder)
        cases.append(("LMGC90's packing, cold", problem, np.zeros_like(problem.warm_start)))
    return cases


def _work(curve, tolerance):
    """Work after which the residual was first below the tolerance; infinite where it was not."""
    below = np.flatnonzero(curve[:, 1] <= tolerance)
    return float(curve[below[0], 0]) if len(below) else np.inf


@check("Ways to solve a contact problem, by work", subject=SUBJECT, seconds=330, quick=25)
def ways_to_solve(bench):
    """Which method reaches a residual with least work decides how fast a step is. Eight are held side by side on
    problems of this project's scenes and LMGC90's packing, as prototypes in NumPy (:code:`sweep_methods`), which have
    nothing but the formulas in common with the solver in C++. Work is counted in visits of every contact. A combination
    of velocities and impulses is not counted; ADMM's factorisation and back substitution are, by their operations.

    What is expected: plain Gauss-Seidel spreads news as a diffusion does, so its work grows with the square of the
    thickness; over-relaxation wins a constant; extrapolation makes a wave of it. Sweeps forth and back cost twice and
    spread both ways at once. A gradient of all contacts at once must take steps short enough for the stiffest group of
    contacts and loses a factor. Conjugate gradients and Anderson's extrapolation gain where the set of open and sliding
    contacts has settled, and fall back where it changes. ADMM solves for all velocities at once, but its projections
    know nothing of each other, and a penalty that suits stiff rows is slow for soft ones.

    The prototypes of the solver's two methods must need the sweeps that it needs, and their impulses must have the
    residual that its own measure says. Sweeps are compared at 1e-3: later, restarts decide, and a different order of
    contacts has them elsewhere."""
    most = 600 if bench.quick else 3000
    tolerance = 1e-4 if bench.quick else 1e-5
    curves, claims, rows = {}, Claims(), []
    for name, problem, start in _cases(bench):
        for method in sweep_methods.METHODS:
            bench.progress(f"{name}, {method}")
            curve, impulse = sweep_methods.run(problem, method, start, tolerance, most)
            curves[name, method] = curve
            works = [_work(curve, t) for t in TOLERANCES]
            rows.append([name, method, *(f"{w:,.0f}" if np.isfinite(w) else "-" for w in works), f"{curve[-1, 1]:.1e}"])
            if method == SHIPPED:
                why = "rounding gathered over hundreds of sweeps"
                what = f"{name}: residual of the prototype's impulses by the solver's measure"
                value = contact.residual(problem, impulse).relative
                claims.near(what, value, curve[-1, 1], why, relative=1e-3, against="the solver in C++")
        for method, way in ((SHIPPED, "accelerated"), (PLAIN, "gaussSeidel")):
            own = [contact.solve(problem, way, start=start, tolerance=t, max_iterations=most) for t in TOLERANCES]
            rows.append(
                [
                    name,
                    f"{method}, in C++",
                    *(f"{s.iterations:,}" if s.converged else "-" for s in own),
                    f"{own[-1].relative:.1e}",
                ]
            )
            why = (
                "one look, while no strip rests; it visits strip by strip, the prototype the whole. No restart has "
                "decided by then"
            )
            claims.near(
                f"{name}: sweeps of {method} to 1e-3",
                _work(curves[name, method], 1e-3),
                _sweeps_until(
                    lambda s: s.relative <= 1e-3,
                    problem,
                    way,
                    start,
                    sweep_methods.LOOK,
                    most,
                    look=2 * sweep_methods.LOOK,
                ),
                why,
                absolute=10,
                relative=0.02,
                against="the solver in C++",
            )
        gain = min(_work(curves[name, PLAIN], 1e-4), most) / _work(curves[name, SHIPPED], 1e-4)
        why = "no theory for a problem with friction; extrapolation was worth 7 to 14 on LMGC90's packing"
        claims.at_least(f"{name}: work of Gauss-Seidel over that of the shipped method, to 1e-4", gain, 3, why)
    heads = ["problem", "method", *(f"to {t:.0e}" for t in TOLERANCES), "residual at the end"]
    table = f"Work in sweeps until a residual is reached; -: not within {most:,}, or not asked for.", heads, rows
    return Findings(claims, tables=[table], plots=[_side_by_side(curves)])


def _sweeps_until(done, problem, method, start, step, most, look=None):
    """Sweeps of the solver in C++ from ``start``, in steps, until ``done(solution)``; infinite where it does not come
    to that. Its own test of convergence is not asked.

    ``look``: sweeps between two looks at the residual; none before the end where it is None.
    """
    # an accelerated sweep remembers those before it, so each look begins anew
    goes_on = method == "gaussSeidel"
    for count in range(step, most + 1, step):
        sweeps = step if goes_on else count
        s = contact.solve(
            problem, method=method, start=start, tolerance=1e-300, max_iterations=sweeps, check_every=look or sweeps
        )
        if done(s):
            return count
        if goes_on:
            start = s.impulse
    return np.inf


def _side_by_side(curves):
    names = list(dict.fromkeys(name for name, _ in curves))
    figure = Figure(figsize=(4.6 * len(names), 5.2))
    for ax, name in zip(figure.subplots(1, len(names), sharey=True, squeeze=False)[0], names):
        for k, method in enumerate(sweep_methods.METHODS):
            curve = curves[name, method]
            shown = curve[:, 0] > 0
            ax.loglog(
                curve[shown, 0],
                curve[shown, 1],
                color="#222222" if method == SHIPPED else f"C{k}",
                lw=2.6 if method == SHIPPED else 1.2,
                label=method,
                zorder=9 if method == SHIPPED else 2,
            )
        ax.set(title=name, xlabel="work in sweeps")
        ax.grid(color="#e3e3e3", lw=0.7)
    figure.axes[0].set_ylabel("residual (natural map, relative)")
    figure.subplots_adjust(left=0.2 / len(names), right=0.985, bottom=0.27, top=0.93, wspace=0.07)
    figure.legend(*figure.axes[0].get_legend_handles_labels(), loc="lower center", ncol=len(names) + 1, frameon=False)
    return figure, "Residual against work. A point is a look at the residual, every ten sweeps."


def _sweeps_to_carry(problem, weight, method, step, most):
    """Sweeps from zero impulses until walls and floor first bear ``weight`` [N s]; infinite where they do not."""
    return _sweeps_until(lambda s: lp.carried(problem, s.impulse) >= weight, problem, method, "cold", step, most)


@check("Sweeps from a cold start against the thickness of the packing", subject=SUBJECT, seconds=10, quick=5)
def sweeps_by_thickness(bench):
    """A load is known to the floor when news of it has crossed the packing. LMGC90's packing, 31 diameters deep, is cut
    at 1/8, 1/4 and 1/2 of its height, which leaves packings of the same disks and the same width. Gauss-Seidel spreads
    news as a diffusion: the sweeps until the ground bears 99 % of what it bears in the end must grow with the square of
    the thickness. Nesterov's extrapolation makes a wave of it, whose sweeps must grow with the thickness itself.
    Surfaces, sides and an arch here and there make the exponents uncertain by a few tenths.

    The residual does not say this: as a mean over all contacts of what one alone would change, it falls to 1e-4 in
    about as many sweeps at every thickness, with less and less of the weight carried by then when it is looser. That is
    why the weight is asked for beside it.
    """
    dump, problem, _ = lp.step_problem(bench.folder)
    diameter = 2 * dump.r.mean()
    floor = dump.y.min() - 0.5 * diameter
    height = np.percentile(dump.y, 99) - floor
    found, rows = {}, []
    for share in (1 / 8, 1 / 4, 1 / 2, 1)[: 3 if bench.quick else 4]:
        bench.progress(f"{share:g} of the height")
        part = problem if share == 1 else disk_problems.below(problem, floor + share * height)
        layers = share * height / diameter
        weight = 0.99 * lp.carried(
            part, contact.solve(part, start="cold", tolerance=1e-6, max_iterations=50_000, check_every=50).impulse
        )
        found[layers] = (
            _sweeps_to_carry(part, weight, "accelerated", 5, 500),
            _sweeps_to_carry(part, weight, "gaussSeidel", 50, 10_000),
        )
        loose = contact.solve(part, start="cold", tolerance=1e-4, max_iterations=1000)
        rows.append(
            [
                f"{layers:.1f}",
                f"{len(part.length):,}",
                *(f"{n:,}" for n in found[layers]),
                f"{found[layers][0] / layers:.1f}",
                f"{loose.iterations}",
            ]
        )
    layers, (fast, plain) = np.array(list(found)), np.array(list(found.values()), float).T

    def slope(counts):
        return float(np.polyfit(np.log(layers), np.log(counts), 1)[0])

    claims = Claims()
    why = "looked at every 5 of 15 sweeps in the thinnest"
    claims.near("accelerated: power of the thickness with which sweeps grow", slope(fast), 1, why, absolute=0.3)
    why = "looked at every 50 of 100 sweeps in the thinnest"
    claims.near("Gauss-Seidel: the same", slope(plain), 2, why, absolute=0.4)
    why = "a guard: 4 when this check was written; a wave that crosses less than a layer in six sweeps is none"
    claims.between("accelerated: sweeps for each layer, thickest packing", fast[-1] / layers[-1], 2, 6, why)
    why = "thickness over its square"
    claims.at_most("accelerated sweeps over plain ones, thickest packing", fast[-1] / plain[-1], 0.1, why)
    heads = (
        "diameters deep | contacts | accelerated | Gauss-Seidel | accelerated, for each layer | "
        "accelerated, to a residual of 1e-4"
    ).split(" | ")
    table = "Sweeps from a cold start until floor and sides bear 99 % of what they bear in the end.", heads, rows
    return Findings(claims, tables=[table], plots=[_by_thickness(layers, fast, plain)])


def _by_thickness(layers, fast, plain):
    figure = Figure(figsize=(6, 4.2), layout="constrained")
    ax = figure.subplots()
    for counts, power, colour, name in ((plain, 2, "C0", "Gauss-Seidel"), (fast, 1, "C1", "accelerated")):
        ax.loglog(layers, counts, "o", color=colour, label=name)
        ax.loglog(
            layers,
            counts[-1] * (layers / layers[-1]) ** power,
            color=colour,
            lw=0.9,
            ls=(0, (4, 3)),
            label=f"∝ thickness{'²' if power == 2 else ''}",
        )
    ax.set(xlabel="thickness [disk diameters]", ylabel="sweeps until 99 % of the weight is carried")
    ax.set_xticks(layers, [f"{value:.0f}" for value in layers])
    ax.minorticks_off()
    ax.grid(color="#e3e3e3", lw=0.7)
    ax.legend(frameon=False)
    return figure, "Sweeps from a cold start until floor and sides bear 99 % of what they bear in the end."
