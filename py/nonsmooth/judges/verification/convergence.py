"""Strength, failure and runout against time step and tolerance."""

from __future__ import annotations

import dataclasses
import math
import shutil
from pathlib import Path

import numpy as np

from ...figures import style
from ...measure.statistics import standard_error
from ...system.whole_files import write_arrays
from .cases import run_cases
from .claims import Claims, Findings
from .registry import check

SUBJECT = "Convergence"
STEPS = (20e-3, 10e-3, 5e-3, 2.5e-3, 1.25e-3)  # s
SLOPE_STEPS = (40e-3, 20e-3, 10e-3, 5e-3, 2.5e-3)
TOLERANCES = (1e-4, 1e-5, 1e-6, 1e-7)
TOLERANCES_MOVING = (2e-3, 2e-4, 2e-5)
SLOPE_SEEDS = range(1, 21)  # packings to choose from
STEP, TOLERANCE, TOLERANCE_MOVING = 10e-3, 1e-6, 2e-4  # of the shipped section
# of the source checkout: 320 disks that do all within ten seconds of their time
SMALL = Path(__file__).resolve().parents[4] / "tests" / "data" / "small_slope.yaml"
WIDTH, HEIGHT = 30.0, 60.0  # m, of the bonded sample: about 500 disks of 1 to 4 m
SPEED, RAMP = 0.05, 4.0  # m/s of the platen in compression, and seconds in which it is reached
PULL = 0.02  # m/s in tension


# ---- a bonded sample ------------------------------------------------------------------------------


def strength(folder, seed, pull, time_step, tolerance, speed, strain):
    """Peak stress of a bonded sample of the shipped section's rock between two platens.

    ``pull``: 1 for tension, with platens glued on, 0 for compression; ``speed`` [m/s] of the upper platen, reached
    after a ramp; ``strain``: at the end. The curve goes to ``curve.npz`` in the folder.
    """
    from yade import O
    from yade.wrapper import NscdMat

    from ... import packing
    from ...model import section
    from ...world import scene

    sample = section.block(WIDTH, HEIGHT, seed=seed)
    made, m = packing.cached_pack(sample), sample.materials["rock"]
    rock = scene.material(m)
    glue = dict(tensileStrength=1e7, bondsToAll=True, bondCreationDistance=m.bond_creation_distance) if pull else {}
    platen = NscdMat(frictionAngle=math.atan(0.3), wall=True, **glue)
    O.materials.append((rock, platen))
    O.bodies.append([scene.disk((float(x), float(y)), float(r), rock) for x, y, r in zip(made.x, made.y, made.r)])
    bottom, top = (
        O.bodies.append(scene.segments(ends, platen, sense=1))[0]
        for ends in (((-WIDTH, 0), (2 * WIDTH, 0)), ((2 * WIDTH, HEIGHT), (-WIDTH, HEIGHT)))
    )
    O.engines = scene.engines(
        gravity=(0, 0, 0), reach=0.2, verlet=0.2 * float(made.r.min()), tolerance=tolerance, maxIterations=5000
    )
    O.dt = time_step
    engine = scene.contact_dynamics()
    O.step()
    bonds, sign = engine.bond(), 1 if pull else -1
    moving, start, rows = O.bodies[top].state, O.bodies[top].state.pos[1], []
    while abs(moving.pos[1] - start) < strain * HEIGHT:
        moving.vel = (0, sign * speed * min(1.0, O.time / RAMP), 0)
        O.step()
        # force on the platens, positive in the sense of the test
        rows.append(
            (O.time, abs(moving.pos[1] - start), -sign * O.forces.f(top)[1], sign * O.forces.f(bottom)[1], engine.bonds)
        )
    time, path, above, below, alive = np.array(rows).T
    force = 0.5 * (above + below)
    window = max(1, round(0.5 / time_step))  # the mean over half a second
    smooth = np.convolve(force, np.ones(window) / window, "valid")
    k = int(np.argmax(smooth))
    write_arrays(folder / "curve.npz", path=path, force=force, bonds=alive)
    middle = slice(k, k + window)
    return {
        "peak_Pa": smooth[k] / WIDTH,
        "path_m": float(path[middle].mean()),
        "work_J_per_m2": float(np.sum(force * np.diff(path, prepend=0))) / WIDTH,
        "imbalance": float(abs(above[middle].mean() - below[middle].mean())) / smooth[k],
        "bonds": bonds,
        "broken": int(bonds - alive[-1]),
        "disks": len(made),
        "sweeps": engine.totalIterations / engine.steps,
        "unconverged": engine.unconverged,
    }


# ---- the slope ------------------------------------------------------------------------------------

KEEP = (
    "water_at_failure_m front_travel_m centroid_travel_m deposit_thickness_max_m fb_force_at_failure_N_per_m "
    "speed_mean_max_m_per_s motion_s triggering_s weakening_s bulking_factor energy_error_rel "
    "energy_correction_rel overlap_worst_rel iterations_mean residual_p95_over_tolerance times_s finished "
    "disks steps packing_fraction bonds_initial"
).split()


def slope(folder, disks, seed, time_step, tolerance, tolerance_moving, slack=None, bond=None):
    """The shipped section with about so many disks, or with ``disks`` = 0 the small section of the tests, until its
    avalanche rests; ``slack``: errors of position that stay [ℓ], None: those that stay in slopes; ``bond``: before or
    after gravity has grown, None: as the section has it. The packing is made with the section's own numbers.
    """
    from ... import records
    from ...measure import characteristic_times
    from ...model import section
    from ...studies.slope import experiment, results, slope as builder, slope_packing
    from ...world import tables

    chosen = section.load("jiufengershan").with_disks(disks) if disks else section.load(str(SMALL))
    settle = chosen.stages.settle if bond is None else dataclasses.replace(chosen.stages.settle, bond=bond)
    shipped = dataclasses.replace(chosen, seed=seed, stages=dataclasses.replace(chosen.stages, settle=settle))
    numerics = dataclasses.replace(
        shipped.numerics,
        time_step=time_step,
        path=shipped.numerics.path * time_step / shipped.numerics.time_step,
        tolerance=tolerance,
        tolerance_moving=tolerance_moving,
        max_iterations=1000,
    )
    s = dataclasses.replace(shipped, numerics=numerics)
    world = None if slack is None else builder.hard(s, slack)
    run = experiment.begin(s, folder, packing=slope_packing.of(shipped), world=world)
    built = run.slope
    run.run()
    state = {**dataclasses.asdict(run.state), "overlap_worst_ever": built.solver.overlapWorstEver}
    summary = results.summarise(folder, s, state)
    for part in ("snapshots", "checkpoint"):
        shutil.rmtree(folder / part, ignore_errors=True)
    series = characteristic_times.chosen_rows(records.read_series(folder / "series.csv"), state)
    return {name: summary[name] for name in KEEP} | {
        "moving_s": None if run.state.moving is None else run.state.moving - run.state.t0,
        "water_hold_m": run.state.water_hold,
        "settled_s": run.state.settled,
        "unconverged": built.solver.unconverged,
        "breaks_logged": len(tables.breaks(built.solver)["step"]),
        "bonds_alive": int(series["bonds_alive"][-1]),
        "broken": records.broken_bonds(series),
    }


# ---- sweeps over one number -----------------------------------------------------------------------


@dataclasses.dataclass
class Sweep:
    """A quantity of the same samples for several values of one number; ``values``: {value: {seed: quantity}}."""

    varied: str  # in words
    unit: str
    default: float
    values: dict

    @classmethod
    def of(cls, cases, found, key, quantity, default, **fixed):
        """From the cases in which all but ``key`` have the values in ``fixed``; cases without the quantity (None) are
        left out.
        """
        values = {}
        for case, result in zip(cases, found):
            if all(case[name] == value for name, value in fixed.items()) and result[quantity] is not None:
                values.setdefault(case[key], {})[case["seed"]] = result[quantity]
        return cls(*AXES[key], default, dict(sorted(values.items())))

    @property
    def finest(self):
        """The smallest of the values."""
        return min(self.values)

    def change(self, value, reference):
        """Change from ``reference`` to ``value`` of the same seeds over the mean of the reference's: (mean, its
        standard error; NaN for one seed).
        """
        a, b = self.values[value], self.values[reference]
        common = [seed for seed in a if seed in b]
        changes, mean = [a[seed] - b[seed] for seed in common], np.mean([b[seed] for seed in common])
        return float(np.mean(changes) / mean), float(standard_error(changes) / mean)

    def largest_step(self):
        """Largest mean change from one value to the next finer one, of values up to ten times the default."""
        order = [value for value in sorted(self.values) if value <= 10 * (1 + 1e-9) * self.default]
        return max((self.change(b, a) for a, b in zip(order, order[1:])), key=lambda change: abs(change[0]))

    def scatter(self):
        """Standard deviation over seeds at the default, relative to the mean; NaN for one seed."""
        at = list(self.values[self.default].values())
        return float(np.std(at, ddof=1) / np.mean(at)) if len(at) > 1 else math.nan

    def draw(self, ax, scale, relative):
        """Every seed as a thin line, the mean with its standard error as a thick one; the default as a dashed vertical.

        ``relative``: changes from the finest value in per cent of its mean (see :meth:`change`) instead of the quantity
        times ``scale``.
        """
        order, points = sorted(self.values), {}
        for v in order:
            for seed, x in self.values[v].items():
                points.setdefault(seed, {})[v] = x * scale
        if relative:
            points = {seed: line for seed, line in points.items() if self.finest in line}
            mean = np.mean([line[self.finest] for line in points.values()])
            points = {
                seed: {v: 100 * (x - line[self.finest]) / mean for v, x in line.items()}
                for seed, line in points.items()
            }
        for line in points.values():
            ax.plot(line.keys(), line.values(), color="#0072B2", lw=0.8, alpha=0.5)
        columns = [[line[v] for line in points.values() if v in line] for v in order]
        ax.errorbar(
            order,
            [np.mean(c) for c in columns],
            [np.nan_to_num(standard_error(c)) for c in columns],
            fmt="o-",
            color="#0072B2",
            lw=1.8,
            ms=4.5,
            capsize=3,
        )
        ax.axvline(self.default, color="#777777", lw=1, ls=(0, (4, 3)))
        ax.set(xscale="log", xlabel=f"{self.varied} [{self.unit}]")
        ax.set_xticks(order, [f"{v:g}" for v in order])
        ax.minorticks_off()
        if relative:
            ax.axhline(0, color="#555555", lw=0.7)
            # at least 5 %, so that a rounding error does not fill the panel, and what the panels that share the axis
            # need
            reach = max(5, *(1.2 * abs(x) for line in points.values() for x in line.values()), *map(abs, ax.get_ylim()))
            ax.set_ylim(-reach, reach)
        else:
            ax.set_ylim(0, 1.2 * max(map(max, columns)))

    def rows(self, scale):
        """Rows of text: value, mean, standard error, change from the finest."""
        for v in sorted(self.values, reverse=True):
            at = [x * scale for x in self.values[v].values()]
            mean, error = self.change(v, self.finest)
            yield [
                f"{v:g}",
                f"{np.mean(at):.4g}",
                f"{standard_error(at):.2g}",
                f"{100 * mean:+.2f} ± {100 * error:.2f}",
            ]


AXES = {
    "time_step": ("time step", "s"),
    "tolerance": ("tolerance", "-"),
    "tolerance_moving": ("tolerance in motion", "-"),
}


def _plus_minus(error):
    return f", ± {error:.3f}" if math.isfinite(error) else ""


# ---- checks ---------------------------------------------------------------------------------------


@style.styled
def sheet(bench, name, title, panels, relative=False):
    """Panels side by side, (sweep, scale, label of the y axis) each; written into the check's folder as ``name`` and
    returned.
    """
    figure = style.figure(3.2 * len(panels), 3.3, layout="constrained")
    for ax, (sweep, scale, label) in zip(figure.subplots(1, len(panels), squeeze=False, sharey=relative)[0], panels):
        sweep.draw(ax, scale, relative)
        ax.set_ylabel(label)
        ax.grid(axis="y", color="#e3e3e3", lw=0.7)
    figure.suptitle(title, x=0.01, ha="left", fontsize=10.5)
    style.save(figure, bench.folder / name)
    return figure


@check("Strength of a bonded sample against time step and tolerance", subject=SUBJECT, seconds=250, quick=35)
def strength_convergence(bench):
    """A bond resists with an impulse of up to h F_a a step, so a bad choice of the time step h can lend a sample
    strength that is not in its bonds: Abramian and Staron (2020) show for Contact Dynamics that a larger h raises the
    effective cohesion. Bonds are also looked at once a step, so a bond that is being pulled apart at the speed u
    outlives its ellipse by up to u h. A loose tolerance goes the other way: what is not solved creeps, and fails early.
    What is claimed is the change from the finest value to the default, and from one value to the next up to ten times
    the default; a tolerance of a hundred times the default is run too, to show what it does.

    A sample of 30 m by 60 m, about 500 disks of the shipped section's rock, all bonded, is compressed between two
    platens at 0.05 m/s, and pulled at 0.02 m/s between platens that it is glued to. There is no gravity and no lateral
    pressure. The strength is the largest mean stress over half a second, taken as the mean of both platens. Inertia:
    the ramp of 4 s takes ρ H v̇ below 2 kPa. Changes are taken sample by sample, so that the scatter between samples,
    which is far larger, drops out. What remains is that a sample of rigid disks with friction has several ways to fail
    at nearly the same load; runs at half the platen's speed show how much that is.
    """
    seeds = (1,) if bench.quick else (1, 2, 3, 4)
    steps, tolerances = (STEPS[1:3], TOLERANCES[1:3]) if bench.quick else (STEPS, TOLERANCES)
    at = {(h, TOLERANCE) for h in steps} | {(STEP, r) for r in tolerances}
    cases = [
        dict(kind, seed=s, time_step=h, tolerance=r)
        for s in seeds
        for h, r in sorted(at, reverse=True)
        for kind in KINDS.values()
    ]
    if not bench.quick:
        cases += [
            dict(kind, speed=kind["speed"] / 2, seed=s, time_step=STEP, tolerance=TOLERANCE)
            for s in seeds
            for kind in KINDS.values()
        ]
    found = run_cases(bench, strength, cases)
    claims, panels, tables = [], [], []
    for name, kind in KINDS.items():
        for key, default, fixed in (
            ("time_step", STEP, {"tolerance": TOLERANCE}),
            ("tolerance", TOLERANCE, {"time_step": STEP}),
        ):
            sweep = Sweep.of(cases, found, key, "peak_Pa", default, **kind, **fixed)
            panels.append((sweep, 1e-3, f"change of strength in {name} [%]"))
            tables.append(
                (
                    f"{name.capitalize()}, mean of {len(seeds)} samples",
                    [
                        f"{sweep.varied} [{sweep.unit}]",
                        "strength [kPa]",
                        "its standard error",
                        "change from the finest [%]",
                    ],
                    list(sweep.rows(1e-3)),
                )
            )
            claims += _strength_claims(name, sweep, PRECISION[name])
    text = (
        "Change of the strength of bonded samples with the time step and the solver's tolerance; thin: single samples, thick: mean, "
        "dashed: the shipped section's value"
    )
    if not bench.quick:
        tables.append(_half_speed(cases, found))
    drawn = sheet(
        bench,
        "convergence_strength.png",
        "Strength of a bonded sample: change from the finest value",
        panels,
        relative=True,
    )
    return Findings(claims, plots=[(drawn, text)], tables=tables)


def _strength_claims(name, sweep, precision):
    scatter = (
        f"between samples the strength scatters by {100 * sweep.scatter():.0f} %"
        if len(sweep.values[sweep.default]) > 1
        else "one sample only"
    )
    claims = Claims()
    if sweep.finest < sweep.default:
        mean, error = sweep.change(sweep.default, sweep.finest)
        why = precision[2] + "; " + scatter
        what = f"strength in {name}, {sweep.varied} {sweep.default:g} over {sweep.finest:g}" + _plus_minus(error)
        claims.near(what, 1 + mean, 1, why, absolute=precision[0], against="the finest")
    step, error = sweep.largest_step()
    why = (
        "the coarse values are meant to show where a trend begins; none is coarser than ten times the default; "
        + scatter
    )
    what = f"strength in {name}, largest change from one value of the {sweep.varied} to the next" + _plus_minus(error)
    claims.near(what, 1 + step, 1, why, absolute=precision[1], against="the next finer")
    return claims


def _half_speed(cases, found):
    """Table of the strengths at half the platen's speed, which tells how much of a difference is the rate's."""
    rows = []
    for name, kind in KINDS.items():
        at = {
            speed: {
                c["seed"]: f["peak_Pa"]
                for c, f in zip(cases, found)
                if c["pull"] == kind["pull"]
                and c["speed"] == speed
                and (c["time_step"], c["tolerance"]) == (STEP, TOLERANCE)
            }
            for speed in (kind["speed"], kind["speed"] / 2)
        }
        whole, half = at.values()
        rows += [
            [name, str(s), f"{whole[s] / 1e3:.4g}", f"{half[s] / 1e3:.4g}", f"{100 * (half[s] / whole[s] - 1):+.2f}"]
            for s in whole
        ]
    return (
        "Half the speed of the platen",
        ["", "sample", "strength [kPa]", "at half the speed [kPa]", "change [%]"],
        rows,
    )


#: What is claimed of the strength: default against finest, one value against the next, and why.
PRECISION = {
    "compression": (
        0.02,
        0.05,
        "the sample fails along one of several paths, and anything that differs can lead to another one, whose strength is another by some per cent",
    ),
    "tension": (0.005, 0.01, "the first crack's load; a bond's yield force does not depend on the step"),
}
KINDS = {"compression": dict(pull=0, speed=SPEED, strain=0.002), "tension": dict(pull=1, speed=PULL, strain=0.001)}


@dataclasses.dataclass(frozen=True)
class Slopes:
    """What :func:`slope_convergence` looks at: ``disks`` of :func:`slope`; values of its numbers, coarse to fine, with
    the default of each; packings that ``compared`` default and finest, and those of the values ``between``; the water
    [m] that a packing must bear to be looked at (``stands``).
    """

    disks: int
    steps: tuple
    step: float
    tolerances: tuple
    tolerance: float
    tolerances_moving: tuple
    moving: float
    compared: int
    between: int
    stands: float
    limits: tuple  # of the change of the water at failure and of the runout, relative


FULL = Slopes(
    3000, SLOPE_STEPS, STEP, TOLERANCES, TOLERANCE, TOLERANCES_MOVING, TOLERANCE_MOVING, 10, 3, 1.0, (0.05, 0.15)
)
QUICK = Slopes(0, (5e-3, 2.5e-3), 5e-3, (1e-4, 1e-5), 1e-4, (2e-3, 5e-4), 2e-3, 2, 2, 0.2, (0.15, 0.5))


@check("Failure and runout of the slope against time step and tolerance", subject=SUBJECT, seconds=3000, quick=15)
def slope_convergence(bench):
    """The whole experiment of the shipped section, with 3,000 disks instead of 21,000. The packing is made once, with
    the section's own numbers, and bonded before gravity grows on it, so that all runs of a packing begin with the same
    disks and the same bonds: a packing that is bonded where it rests has other bonds with every other number, and is
    another slope. Packings that move before the water has risen by 1 m are left out. Loading, rise of the water by 1
    m/s, failure and avalanche are those of ``scripts/jiufengershan.py``, but for at most 1,000 sweeps a step instead of
    300, so that tight tolerances are reached.

    Two results count. The height of the water when the slope begins to move (mean speed 0.2 m/s) comes from the
    strength of the foot at rest, so it must not depend on the time step or on ``tolerance``. The runout is that of many
    collisions; two runs that differ in anything, if only in the last bit, lead to different places of single disks. So
    a change is taken as the mean over packings, packing by packing: ten for the defaults against the finest value of
    each number, three for the values between, which show where a trend begins. (With three packings for all, the
    runout's mean change had a standard error of 9 %, which cannot tell 15 % from nothing.)

    In a quick run the small section of the tests takes its place, with two packings, the default and one finer value of
    each number; so few scatter more, and the limits are three times as wide.
    """
    k = QUICK if bench.quick else FULL
    # what counts most first, so that an interrupted check has something of everything
    default = (k.step, k.tolerance, k.moving)
    at = (
        [(h, *default[1:]) for h in k.steps]
        + [(k.step, r, k.moving) for r in k.tolerances]
        + [(*default[:2], r) for r in k.tolerances_moving]
    )
    compared = {
        default,
        (k.steps[-1], *default[1:]),
        (k.step, k.tolerances[-1], k.moving),
        (*default[:2], k.tolerances_moving[-1]),
    }
    case = lambda seed, h, r, m: dict(
        disks=k.disks, seed=seed, time_step=h, tolerance=r, tolerance_moving=m, bond="before"
    )  # noqa: E731
    standing, fallen = _standing(bench, k, lambda seed: case(seed, *default))
    cases = [
        case(s, *numbers)
        for numbers in dict.fromkeys(at)
        for s in standing[: k.compared if numbers in compared else k.between]
    ]
    found = run_cases(bench, slope, cases)
    axes = (
        ("time_step", k.step, {"tolerance": k.tolerance, "tolerance_moving": k.moving}),
        ("tolerance", k.tolerance, {"time_step": k.step, "tolerance_moving": k.moving}),
        ("tolerance_moving", k.moving, {"time_step": k.step, "tolerance": k.tolerance}),
    )
    claims, tables, failure, runout = Claims(), [], [], []
    for quantity, name, panels, limit, why in (
        (
            "water_hold_m",
            "water at failure",
            failure,
            k.limits[0],
            "which bond breaks first differs with anything that differs, by a few per cent of the height in most packings, by a quarter in one of ten",
        ),
        (
            "front_travel_m",
            "travel of the front",
            runout,
            k.limits[1],
            "runs of one packing differ by 10 % and more without a trend, for collisions amplify every difference",
        ),
    ):
        for key, default, fixed in axes:
            if quantity == "water_hold_m" and key == "tolerance_moving":
                continue  # begins to count after the failure
            sweep = Sweep.of(cases, found, key, quantity, default, **fixed)
            panels.append((sweep, 1, f"{name} [m]"))
            tables.append(
                (
                    f"{name.capitalize()}, mean of {k.compared} packings ({k.between} between default and finest)",
                    [
                        f"{sweep.varied} [{sweep.unit}]",
                        f"{name} [m]",
                        "its standard error",
                        "change from the finest [%]",
                    ],
                    list(sweep.rows(1)),
                )
            )
            mean, error = sweep.change(sweep.default, sweep.finest)
            scatter = f"between packings it scatters by {100 * sweep.scatter():.0f} %"
            what = f"{name}, {sweep.varied} {sweep.default:g} over {sweep.finest:g}" + _plus_minus(error)
            claims.near(what, 1 + mean, 1, f"{why}; {scatter}", absolute=limit, against="the finest")
    keys = (
        "disks steps iterations_mean residual_p95_over_tolerance unconverged energy_error_rel "
        "energy_correction_rel overlap_worst_rel"
    ).split()
    tables.append(
        (
            "All runs",
            ["seed", "time step [s]", "tolerance", "in motion", *keys],
            [
                [
                    str(c["seed"]),
                    *(f"{c[name]:g}" for name in ("time_step", "tolerance", "tolerance_moving")),
                    *(f"{f[key]:.4g}" for key in keys),
                ]
                for c, f in zip(cases, found)
            ],
        )
    )
    thin = "thin: single packings, thick: mean, dashed: the shipped section's value"
    shown = (
        (
            "failure",
            "Failure of the slope",
            failure,
            "Height of the water table when the slope begins to move (mean speed 0.2 m/s)",
        ),
        ("runout", "Runout of the avalanche", runout, "Distance that the front has gone when the avalanche rests"),
    )
    plots = [
        (sheet(bench, f"convergence_{name}.png", f"{title}, {found[0]['disks']:,} disks", panels), f"{says}; {thin}")
        for name, title, panels, says in shown
    ]
    left = f"Left out, as they did not stand dry: packings of seed {', '.join(map(str, fallen))}."
    return Findings(claims, plots=plots, tables=tables, remarks=[left] if fallen else [])


def _standing(bench, kind, case):
    """Seeds of the first packings that bear the dry slope, as many as are compared, and of those that were passed over.
    ``case``: of a seed.
    """
    seeds, standing, fallen = list(SLOPE_SEEDS), [], []
    while seeds and len(standing) < kind.compared:
        lacking = kind.compared - len(standing)
        now, seeds = seeds[:lacking], seeds[lacking:]
        for seed, found in zip(now, run_cases(bench, slope, [case(s) for s in now])):
            (standing if found["water_hold_m"] is not None and found["water_hold_m"] > kind.stands else fallen).append(
                seed
            )
    return standing, fallen
