"""What the measurements say together: the headline figures of ``benchmark.json``, and tables of text."""

from __future__ import annotations

import json
from pathlib import Path

from tabulate import tabulate

from ...system.whole_files import write_json

__all__ = ["HEADLINES", "keep", "number", "scale_table", "summarise", "table", "with_quartiles"]

#: Headline figures, by their keys one in the other, and what each is; medians where there is a distribution. Steps are
#: of the slope at rest, with as many threads as were asked for.
HEADLINES = {
    "sweep_ns_per_contact": "a sweep, for each contact, one thread [ns]",
    "sweep_speedup_over_scalar": "the same, over contacts swept one at a time",
    "sweep_speedup_two_threads": "a sweep on one thread, over two",
    "fraction_of_bandwidth_bound": "time to stream through the blocks, over a sweep's",
    "step_ms": "a step [ms]",
    "soft_step_ms": "a step of YADE's soft contacts [ms]",
    "step_over_soft_step": "the one over the other",
    "simulated_second_over_soft": "the same, for a second of simulation",
    "outside_solve_over_solve/rest": "of a step, all but the solve and the correction, over these two, mean over mean",
    "outside_solve_over_solve/moving": "the same while the slope moves",
    "correction_over_step": "of a step, taking back errors of position, mean over mean",
    "correction_over_step_moving": "the same while the slope moves",
    "slip_law_over_step": "what slip laws on all walls add to a step while the slope moves, over one without",
    "warm_sweeps_mean": "sweeps of a step, mean",
    "cold_sweeps_to_1e-4": "sweeps to a residual of 1e-4 from zero",
}


def _of(measured, state, threads):
    return next(m for m in measured if m["state"] == state and m["threads"] == threads)


def _outside_over_solve(measured):
    """The correction of positions counts as solve: it sweeps the same blocks. Means, since a stage that works in some
    steps only, as a search of the collider does, has no part in a median."""
    solve = measured["stage_ms"]["solve"]["mean"] + measured["stage_ms"]["correct"]["mean"]
    return (measured["step_ms"]["mean"] - solve) / solve


def summarise(found) -> dict:
    """``found`` of suite.run with the headline figures before it, quartiles of those that have them, and the mean time
    of each stage at rest and on the move.
    """
    rest, moving, soft = (_of(found["steps"], state, found["threads"]) for state in ("rest", "moving", "soft"))
    sweeps, cold, hard = found["sweeps"], found["cold_start"]["slope"], {"rest": rest, "moving": moving}
    step, soft_step = rest["step_ms"]["median"], soft["step_ms"]["median"]
    spreads = {
        "sweep_ns_per_contact": sweeps["ns_per_contact"]["best"],
        "sweep_speedup_over_scalar": sweeps["speedup_over_reference"]["best"],
        "sweep_speedup_two_threads": sweeps["speedup_two_threads"],
        "step_ms": rest["step_ms"],
        "soft_step_ms": soft["step_ms"],
        "slip_law_over_step": found["slip_laws"]["over_step"],
    }
    return {
        **{name: s["median"] for name, s in spreads.items()},
        "step_over_soft_step": step / soft_step,
        "simulated_second_over_soft": step / rest["time_step_s"] / (soft_step / soft["time_step_s"]),
        "outside_solve_over_solve": {state: _outside_over_solve(m) for state, m in hard.items()},
        **{
            f"correction_over_step{which}": m["stage_ms"]["correct"]["mean"] / m["step_ms"]["mean"]
            for which, m in (("", rest), ("_moving", moving))
        },
        "stage_ms": {state: {name: s["mean"] for name, s in m["stage_ms"].items()} for state, m in hard.items()},
        "cold_sweeps_to_1e-4": cold["sweeps"],
        "warm_sweeps_mean": rest["sweeps_mean"],
        "fraction_of_bandwidth_bound": sweeps["fraction_of_bandwidth_bound"]["working_set"],
        "quartiles": {name: s["quartiles"] for name, s in spreads.items()},
        **found,
    }


def keep(path, summary, space):
    """Writes ``benchmark.json``. What was measured in ``space``, whose names begin so, stands in it beside what was
    measured of a slope: either leaves what an earlier run has written of the other.
    """
    try:
        before = json.loads(Path(path).read_text())
    except (OSError, ValueError):
        before = None
    others = before.items() if isinstance(before, dict) else ()
    write_json(path, {**{name: value for name, value in others if name.startswith("space") != space}, **summary})


def _at(summary, name):
    for key in name.split("/"):
        summary = summary[key]
    return summary


def number(value) -> str:
    """A number as tables have it."""
    return f"{value:.4g}"


def with_quartiles(spread) -> str:
    """A median and its quartiles, see statistics.spread."""
    return "{:.3g} ({:.3g} … {:.3g})".format(spread["median"], *spread["quartiles"])


def step_rows(steps) -> list:
    """Rows of a table of text with a column for each of ``steps``: what their stages take, and how much there is to do; "-"
    where a step has no such thing.
    """
    # a stage that works in some steps only, as the collider does, shows in the mean alone
    rows = [
        (f"{name}, mean", *(number(m["stage_ms"][name]["mean"]) if name in m["stage_ms"] else "-" for m in steps))
        for name in steps[0]["stage_ms"]
    ]
    counts = (("sweeps, mean", "sweeps_mean"), ("contacts", "contacts"), ("candidates", "candidates"))
    return rows + [(name, *(number(m[key]) if key in m else "-" for m in steps)) for name, key in counts]


def table(summary) -> str:
    """Tables of text: headlines, steps by stage, sweeps by path, cold starts."""
    rows = [
        (what, number(_at(summary, name)), " … ".join(map(number, summary["quartiles"].get(name, ()))))
        for name, what in HEADLINES.items()
    ]
    parts = [tabulate(rows, ("", "", "quartiles"), disable_numparse=True)]
    steps = [(f"{m['state']}, {m['threads']} thr.", m) for m in summary["steps"]]
    rows = [("step", *(with_quartiles(m["step_ms"]) for _, m in steps)), *step_rows([m for _, m in steps])]
    parts.append(tabulate(rows, ("[ms]", *(name for name, _ in steps)), disable_numparse=True))
    found = summary["sweeps"]
    rows = [
        (
            name.replace("_", " "),
            with_quartiles(s),
            with_quartiles(found["speedup_over_reference"][name]) if name != "reference" else "1",
        )
        for name, s in found["ns_per_contact"].items()
    ]
    parts.append(tabulate(rows, ("sweep", "ns a contact", "over reference"), disable_numparse=True))
    rate = found["bandwidth_GB_per_s"]
    bound = found["fraction_of_bandwidth_bound"]
    parts.append(
        f"memory: {rate['working_set']:.1f} GB/s over the {found['working_set_MB']:.1f} MB of the blocks, {rate['memory']:.1f} GB/s over what no "
        f"cache holds; a sweep takes {1 / bound['working_set']:.2f} and {1 / bound['memory']:.2f} times as long"
    )
    rows = [
        (
            name,
            str(c["contacts"]),
            str(c["sweeps"]),
            f"{c['share_of_weight']:.4f}",
            f"{c['sweeps_tight']} ({c['residual_tight']:.0e})",
        )
        for name, c in summary["cold_start"].items()
    ]
    heads = (
        "cold start | contacts | sweeps to 1e-4 | load on the ground, relative to a tight solve | "
        "sweeps of that (residual)"
    ).split(" | ")
    parts.append(tabulate(rows, heads, disable_numparse=True))
    m = summary["machine"]
    parts.append(
        f"{m['cpu']}, {m['cores']} cores, {m['compiler']}, path {m['best_path']}, load {m['load_average'][0]:.1f}, {m['date']}"
    )
    return "\n\n".join(parts)


def scale_table(found) -> str:
    """Table of text of what scale.run found: one row a size."""
    threads = str(found["threads"])
    rows = [
        (
            str(s["disks"]),
            str(s["candidates"]),
            f"{s['packing_s']:.0f}",
            f"{s['building_s']:.1f}",
            f"{1e-3 * s['bytes_per_contact']:.2f}",
            f"{1e-3 * s['bytes_per_contact_viewed']:.2f}",
            f"{1e-3 * s['bytes_per_disk']:.2f}",
            f"{1e-3 * s['soft_memory']['bytes_per_disk']:.2f}" if "soft_memory" in s else "-",
            with_quartiles(s["step_ms"]),
            number(s["sweeps_mean"]),
            with_quartiles(s["sweep_ns_per_contact"]["1"]),
            with_quartiles(s["sweep_ns_per_contact"][threads]),
            str(s["cold_start"]["sweeps"]) if "cold_start" in s else "-",
        )
        for s in found["sizes"]
    ]
    heads = (
        "disks",
        "contacts",
        "packing [s]",
        "building [s]",
        "kB a contact",
        "with interactions",
        "kB a disk",
        "with soft contacts",
        "step [ms]",
        "sweeps",
        "ns a contact and sweep",
        f"{threads} threads",
        "cold sweeps to 1e-4",
    )
    return tabulate(rows, heads, disable_numparse=True)
