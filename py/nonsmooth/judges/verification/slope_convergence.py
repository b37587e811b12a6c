"""Failure and runout of the slope against time step and tolerance."""

from __future__ import annotations

import dataclasses
import shutil
from pathlib import Path

from .cases import run_cases
from .claims import Claims, Findings
from .refinement import Sweep, plus_minus, sheet
from .registry import check
from .strength_convergence import STEP, TOLERANCE, TOLERANCES

STEPS = (40e-3, 20e-3, 10e-3, 5e-3, 2.5e-3)  # s
TOLERANCES_MOVING = (2e-3, 2e-4, 2e-5)
TOLERANCE_MOVING = 2e-4  # of the shipped section
SEEDS = range(1, 21)  # packings to choose from
# of the source checkout: 320 disks that do all within ten seconds of their time
SMALL = Path(__file__).resolve().parents[4] / "tests" / "data" / "small_slope.yaml"

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


FULL = Slopes(3000, STEPS, STEP, TOLERANCES, TOLERANCE, TOLERANCES_MOVING, TOLERANCE_MOVING, 10, 3, 1.0, (0.05, 0.15))
QUICK = Slopes(0, (5e-3, 2.5e-3), 5e-3, (1e-4, 1e-5), 1e-4, (2e-3, 5e-4), 2e-3, 2, 2, 0.2, (0.15, 0.5))


@check("Failure and runout of the slope against time step and tolerance", subject="Convergence", seconds=3000, quick=15)
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

    def case(seed, h, r, m):
        return dict(disks=k.disks, seed=seed, time_step=h, tolerance=r, tolerance_moving=m, bond="before")

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
            what = f"{name}, {sweep.varied} {sweep.default:g} over {sweep.finest:g}" + plus_minus(error)
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
    seeds, standing, fallen = list(SEEDS), [], []
    while seeds and len(standing) < kind.compared:
        lacking = kind.compared - len(standing)
        now, seeds = seeds[:lacking], seeds[lacking:]
        for seed, found in zip(now, run_cases(bench, slope, [case(s) for s in now])):
            (standing if found["water_hold_m"] is not None and found["water_hold_m"] > kind.stands else fallen).append(
                seed
            )
    return standing, fallen
