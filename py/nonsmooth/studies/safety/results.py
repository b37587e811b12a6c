"""What a search for the factor of safety says: its summary. Needs its records alone, no YADE."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ... import records
from ...course import strength_reduction as reduction
from ...measure import failing_mass
from ...model.materials import ENVELOPE
from ...system.whole_files import write_json

__all__ = ["BEFORE", "FAILED", "RESTED", "SERIES", "STABLE", "START", "SUMMARY", "TRIAL", "says", "summarise"]

SERIES, SUMMARY = "series.csv", "summary.json"
STABLE = "stable"  # folder of the scene in which the slope rested last
#: Snapshots: at the first rest, as the present trial began, in the last rest of a trial; and of the trial that failed
#: at the smallest factor, as it began and as it had failed.
START, TRIAL, RESTED, BEFORE, FAILED = "start.npz", "trial.npz", "rested.npz", "before_failure.npz", "failed.npz"


def says(summary) -> str:
    """What a search has found, a sentence."""
    low, high = summary["factor_low"], summary["factor_high"]
    if summary["verdict"] == reduction.FOUND:
        return f"factor of safety {summary['factor']:.3f}: the slope stands at {low:.3f} and fails at {high:.3f}"
    if ENVELOPE in summary["divided"] and summary["verdict"] in (reduction.STANDS, reduction.FALLS):
        does, factor = ("stands", low) if summary["verdict"] == reduction.STANDS else ("fails", high)
        return (
            f"the slope {does} with the envelope of its rock divided by {factor:.3g}, as far as was asked, or as the "
            "table of calibrated rocks goes"
        )
    if summary["verdict"] == reduction.STANDS:
        return f"the slope stands for ever: it does so with its strengths divided by {low:.3g}"
    if summary["verdict"] == reduction.FALLS:
        return f"the slope never stands: it fails with its strengths divided by {high:.3g}"
    return f"not over: the slope stands at {low}, and fails at {high}"


def summarise(folder, asked, state) -> dict:
    """Writes ``summary.json`` of what has been done, and returns it. ``asked``: an :class:`.asked.Asked`; ``state``:
    fields of :class:`.strength_reduction.SearchState`, a dictionary.
    """
    folder, s = Path(folder), asked.section
    verdict = state["outcome"] or "not over"
    low, high = state["stable"], state["failed"]
    summary = {
        "title": s.name,
        "verdict": verdict,
        "factor": 0.5 * (low + high) if verdict == reduction.FOUND else None,
        "factor_low": low,
        "factor_high": high,
        "divided": list(asked.quantities),
        "materials": None if asked.materials is None else list(asked.materials),
        "world": asked.world or {"name": "hard"},
        "seed": s.seed,
        "disks": None,
        "water_m": None,
        "failing_area_m2": None,
        "failing_share": None,
        "trials": state["trials"],
        "steps": state["steps"],
        "wall_s": state["wall_s"],
        "wall_steps_s": state["wall_steps_s"],
    }
    if (folder / START).is_file():
        start = records.read_snapshot(folder / START)
        summary |= {"disks": len(start.x), "water_m": start.water_m}
    if any(one["trial"] > 0 and one["verdict"] == reduction.FAILED for one in state["trials"]):
        before, after = (records.read_snapshot(folder / name) for name in (BEFORE, FAILED))
        fails, area = failing_mass.failing(failing_mass.ways(before, after)), np.pi * before.r**2
        summary["failing_area_m2"] = float(area[fails].sum())
        summary["failing_share"] = float(area[fails].sum() / area.sum())
    summary["verdict_says"] = says(summary)
    write_json(folder / SUMMARY, summary)
    return summary
