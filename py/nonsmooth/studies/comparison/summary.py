"""``summary.json``: what all runs of a comparison say together."""

from __future__ import annotations

import math
from dataclasses import asdict

import numpy as np

from ...measure.statistics import Estimate
from . import deposits, precision

__all__ = ["ROCK_STIFFNESS", "clean", "estimate", "stiffest_within", "summarise"]

ROCK_STIFFNESS = 1e10  # Pa


def clean(value):
    """A value as JSON can hold it: no NaN, no infinity, plain containers."""
    if isinstance(value, dict):
        return {str(k): clean(v) for k, v in value.items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return [clean(v) for v in value]
    if isinstance(value, (np.bool_, np.integer)):
        return value.item()
    if isinstance(value, (float, np.floating)):
        return float(value) if math.isfinite(value) else None
    return value


def estimate(hard, soft):
    """Means, standard deviations over seeds, and the paired difference of a quantity.

    ``hard``, ``soft``: values (or None) of the same seeds in the same order. ``scatter`` of the result: standard
    deviation over seeds (root mean square of both worlds'). ``agree``: True where the whole 95 % interval of the
    difference lies within the scatter, so that they differ by no more than two packings do; False where it does not and
    leaves zero out; None where so few seeds, or one alone, cannot tell.
    """

    def number(values):
        return [v for v in values if v is not None]

    pairs = [(a, b) for a, b in zip(hard, soft) if a is not None and b is not None]
    found = {}
    for world, values in (("hard", number(hard)), ("soft", number(soft))):
        found[world] = {
            "mean": float(np.mean(values)) if values else None,
            "sd": float(np.std(values, ddof=1)) if len(values) > 1 else None,
            "values": list(hard if world == "hard" else soft),
        }
    difference = Estimate.of([b - a for a, b in pairs]) if pairs else None
    found["difference"] = None if difference is None else difference.mean
    found["difference_95"] = None if difference is None or math.isnan(difference.half_width) else difference.half_width
    spreads = [found[w]["sd"] for w in ("hard", "soft")]
    if None in spreads or difference is None:
        found["scatter"] = found["agree"] = None
    else:
        found["scatter"] = math.sqrt(0.5 * sum(s * s for s in spreads))
        found["agree"] = _agree(difference, found["scatter"])
    return found


def _agree(difference, scatter):
    """See :func:`estimate`; one pair has no interval (NaN)."""
    size, half = abs(difference.mean), difference.half_width
    if size + half <= scatter:
        return True
    return False if size > half else None


def stiffest_within(differences, scatter):
    """Whether the last of ``differences``, that of the stiffest run, is no larger than ``scatter``; None where either
    is not known (NaN).
    """
    last = differences[-1]
    return last <= scatter if math.isfinite(last) and math.isfinite(scatter) else None


def _run(outcome, error, own):
    c = outcome.case
    return {
        "name": c.name,
        "label": c.label,
        "world": c.world,
        "seed": c.seed,
        "stiffness_Pa": c.stiffness,
        "step_factor": c.step,
        "tolerance_factor": c.tolerance,
        "values": outcome.values,
        "overlap_mean_rel": outcome.overlap,
        "overlap_rest_rel": outcome.overlap_rest,
        "cost": asdict(outcome.cost),
        "error_against_hard": error,
        "error_against_own_world": own,
        "notes": outcome.notes,
    }


def summarise(scenario, plan, outcomes):
    """The summary as a dictionary.

    ``scenario``: an experiment, see :mod:`outcomes`; ``plan``: a cases.ComparisonPlan; ``outcomes``: {Case: Outcome} of
    all its cases.
    """
    keys = scenario.KEYS
    pairs = [(outcomes[h], outcomes[s]) for h, s in plan.ensemble]
    hard, soft = ([p[k] for p in pairs] for k in (0, 1))
    quantities = {
        q.name: {
            "means": q.means,
            "unit": q.unit,
            **estimate([o.values.get(q.name) for o in hard], [o.values.get(q.name) for o in soft]),
        }
        for q in scenario.QUANTITIES
    }
    both = [(a, b) for a, b in pairs if a.deposit is not None and b.deposit is not None]
    deposit = [deposits.overlap(a.deposit, b.deposit) for a, b in both]
    common = {str(a.case.seed): deposits.common_area(a.deposit, b.deposit) for a, b in both}
    between = [
        deposits.overlap(a.deposit, b.deposit)
        for k, a in enumerate(hard)
        for b in hard[k + 1 :]
        if a.deposit is not None and b.deposit is not None
    ]

    def mean(name, world):
        return quantities[name][world]["mean"] if name in quantities else None

    numerics, sweep = [outcomes[c] for c in plan.numerics], [outcomes[c] for c in plan.sweep]
    chance = precision.scatter(hard, keys)
    work = _work(numerics, sweep, [outcomes[plan.fragile]] if plan.fragile else [], chance, keys)
    runs = [
        _run(
            o,
            precision.error(o, numerics[-1], keys),
            precision.error(o, numerics[-1] if o.case.world == "hard" else sweep[-1], keys),
        )
        for o in outcomes.values()
    ]
    summary = {
        "scenario": scenario.NAME,
        "disks": plan.ensemble[0][0].disks,
        "seeds": [h.seed for h, _ in plan.ensemble],
        "stiffnesses_Pa": [c.stiffness for c in plan.sweep],
        "ensemble_stiffness_Pa": plan.ensemble[0][1].stiffness,
        "damping": plan.ensemble[0][1].damping,
        "damping_moving": plan.ensemble[0][1].damping_moving,
        "step_share": plan.ensemble[0][1].step,
        "model": plan.ensemble[0][1].model,
        "water_at_failure_hard_m": mean("water_at_failure_m", "hard"),
        "water_at_failure_soft_m": mean("water_at_failure_m", "soft"),
        "front_travel_hard_m": mean("front_travel_m", "hard"),
        "front_travel_soft_m": mean("front_travel_m", "soft"),
        "deposit_overlap_fraction": float(np.mean(deposit)) if deposit else None,
        "deposit_overlap_m2": float(np.mean(list(common.values()))) if common else None,
        "deposit_overlap_m2_by_seed": common,
        "deposit_overlap_fraction_between_seeds": float(np.mean(between)) if between else None,
        **_cost(outcomes[plan.ensemble[0][0]], sweep),
        "work_precision": work,
        "convergence": _convergence(scenario, plan, outcomes, quantities, chance),
        "scatter": chance,
        "quantities": quantities,
        "runs": runs,
    }
    return clean(summary)


def _cost(hard, sweep):
    """Wall time for a second of simulation (see Cost.rate), soft over hard: at equal mean overlap (Outcome.overlap),
    and at a rock's stiffness.
    """
    moduli, overlaps, steps, walls = (
        [f(o) for o in sweep]
        for f in (
            lambda o: o.case.stiffness,
            lambda o: o.overlap,
            lambda o: o.cost.step_s,
            lambda o: o.cost.rate * o.cost.step_s,
        )
    )
    modulus, _ = precision.loglog(hard.overlap, overlaps, moduli)
    rate, beyond = precision.soft_rate(modulus, moduli, steps, walls)
    rock, rock_beyond = precision.soft_rate(ROCK_STIFFNESS, moduli, steps, walls)
    rates = [o.cost.rate for o in sweep]
    return {
        "soft_over_hard_wall_equal_overlap": rate / hard.cost.rate,
        "stiffness_equal_overlap_Pa": modulus,
        "equal_overlap_extrapolated": beyond,
        "soft_over_hard_wall_rock_stiffness": rock / hard.cost.rate,
        "rock_stiffness_extrapolated": rock_beyond,
        "overlap_hard_rel": hard.overlap,
        "wall_s_per_simulated_s_hard": hard.cost.rate,
        "wall_s_per_simulated_s_soft": dict(zip(map("{:g}".format, moduli), rates)),
    }


def _work(numerics, sweep, aside, chance, keys):
    """Work and precision of both worlds, against the finest hard run, and each against the finest of its own.

    ``aside``: soft outcomes that are shown but not compared.
    """

    def point(o, reference):
        return {
            "run": o.case.name,
            "label": o.case.label,
            "wall_s": o.cost.wall_s,
            "error": precision.error(o, reference, keys),
            "parts": precision.parts(o, reference, keys),
        }

    found = {"scatter": chance, "reference_hard": numerics[-1].case.name, "reference_soft": sweep[-1].case.name}
    for kind, references in (
        ("against_hard", (numerics[-1], numerics[-1])),
        ("against_own", (numerics[-1], sweep[-1])),
    ):
        lists = [[o for o in group if o is not reference] for group, reference in zip((numerics, sweep), references)]
        points = [
            [(o.cost.wall_s, precision.error(o, reference, keys)) for o in group]
            for group, reference in zip(lists, references)
        ]
        work = precision.compare_work(*points, chance)
        compared = None
        if work is not None:
            hard, soft = lists[0][work.hard].case, lists[1][work.soft].case
            compared = {
                "error": work.error,
                "at_scatter": work.at_scatter,
                "factor": work.factor,
                "hard": hard.name,
                "soft": soft.name,
                "hard_label": hard.label,
                "soft_label": soft.label,
            }
        found[kind] = {"compared": compared} | {
            world: [point(o, reference) for o in group]
            for world, group, reference in zip(
                ("hard", "soft", "soft_aside"), (*lists, aside), (*references, references[1])
            )
        }
    return found


def _convergence(scenario, plan, outcomes, quantities, chance):
    """Differences of soft runs from the hard run of the same packing, against stiffness, with the power of the
    stiffness that fits them best.
    """
    reference = outcomes[plan.ensemble[0][0]]
    sweep = [outcomes[c] for c in plan.sweep]
    moduli = [o.case.stiffness for o in sweep]
    rows = {
        "error": {
            "means": "error, all parts together",
            "differences": [precision.error(o, reference, scenario.KEYS) for o in sweep],
            "scatter": chance,
        }
    }
    for name in precision.parts(sweep[-1], reference):
        rows[name] = {
            "means": f"difference of {scenario.CURVES.get(name, name)}",
            "differences": [precision.parts(o, reference).get(name, math.nan) for o in sweep],
            "scatter": _median_part(plan, outcomes, name),
        }
    for q in scenario.QUANTITIES:
        base, spread = reference.values.get(q.name), quantities[q.name]["hard"]["sd"]
        if base:
            differences = [
                math.nan if o.values.get(q.name) is None else abs(o.values[q.name] / base - 1) for o in sweep
            ]
            rows[q.name] = {
                "means": q.means,
                "differences": differences,
                "scatter": math.nan if spread is None else spread / abs(base),
            }
    rows["overlap"] = {
        "means": f"mean overlap, {scenario.OVERLAP_WHEN[0]}",
        "differences": [o.overlap_rest for o in sweep],
        "scatter": math.nan,
    }
    for row in rows.values():
        fit = precision.power_law(moduli, row["differences"])
        row |= {
            "power": fit.power if fit else None,
            "power_error": fit.power_error if fit else None,
            "scale": fit.scale if fit else None,
            "stiffest_within_scatter": stiffest_within(row["differences"], row["scatter"]),
        }
    networks = [precision.force_difference(o.forces, reference.forces) for o in sweep]
    own = [
        precision.force_difference(outcomes[c].forces, reference.forces)
        for c in plan.numerics
        if outcomes[c] is not reference
    ]
    return {
        "stiffnesses_Pa": moduli,
        "rows": rows,
        "forces": {
            "rms_over_mean": [n[0] for n in networks],
            "correlation": [n[1] for n in networks],
            "hard_runs": [outcomes[c].case.label for c in plan.numerics if outcomes[c] is not reference],
            "hard_rms_over_mean": [n[0] for n in own],
            "hard_correlation": [n[1] for n in own],
        },
    }


def _median_part(plan, outcomes, name):
    hard = [outcomes[h] for h, _ in plan.ensemble]
    found = [precision.parts(a, b).get(name, math.nan) for a in hard for b in hard if a is not b]
    return float(np.nanmedian(found)) if found and not np.all(np.isnan(found)) else math.nan
