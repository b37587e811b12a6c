"""All measurements, each in a YADE process of its own, one after the other."""

from __future__ import annotations

from dataclasses import dataclass

from ...studies.slope import states
from ...studies.slope.measuring import MeasuringCourse
from ...system import machine
from . import cold_start, slip_laws, steps, sweeps

__all__ = ["FULL", "QUICK", "Effort", "run"]


@dataclass(frozen=True)
class Effort:
    """How often things are repeated: timed steps of a run, turns of the sweeps' paths, and turns with and without slip
    laws.
    """

    steps: int
    repeats: int
    turns: int


FULL, QUICK = Effort(200, 30, 9), Effort(60, 10, 3)


def run(out, source, disks, threads, effort, progress=lambda share, doing: None):
    """Makes the states that are missing, and measures; returns everything as a dictionary that JSON can hold (see
    report.summarise).

    ``source``: section of the slope, see states.section_of; ``out``: folder that keeps each process's log below
    ``runs``; ``progress``: called with the share done and what is being done. Raises states.BenchmarkError with the
    first failure.
    """
    subject = {"source": source, "disks": disks}
    made = not states.exist(source, disks)
    per_thousand = disks / 1000
    seconds = {
        "states": 8 * per_thousand if made else 0,
        "steps": 2 + 0.01 * effort.steps * per_thousand,
        "sweeps": 5 + 0.06 * effort.repeats * per_thousand,
        "cold": 5 + 0.5 * per_thousand,
        "slip-laws": 2 + 2 * effort.turns * (1 + 0.01 * effort.steps * per_thousand),
    }
    counts = sorted({1, threads})
    total = seconds["states"] + 3 * len(counts) * seconds["steps"] + seconds["sweeps"] + 2 * seconds["cold"]
    course = MeasuringCourse(out, total + seconds["slip-laws"], progress)
    found = {
        "machine": machine.describe(),
        "section": source,
        "disks": disks,
        "threads": threads,
        "states_made": made,
        "steps": [],
    }
    if made:
        course.call("states", seconds["states"], states.make, subject, threads)
    for count in counts:
        for state in states.NAMES:
            timed = course.call(
                f"steps-{state}-{count}",
                seconds["steps"],
                steps.measure,
                {**subject, "state": state, "steps": effort.steps, "dump": state == "rest"},
                count,
            )
            found["steps"].append({"state": state, "threads": count, **timed})
    found["slip_laws"] = course.call(
        "slip-laws",
        seconds["slip-laws"],
        slip_laws.measure,
        {**subject, "count": effort.steps, "turns": effort.turns},
        threads,
    )
    problem = str(course.home / "steps-rest-1" / "step.h5")
    found["sweeps"] = course.call(
        "sweeps", seconds["sweeps"], sweeps.measure, {"problem": problem, "repeats": effort.repeats}, 2
    )
    found["cold_start"] = {
        "slope": course.call("cold-slope", seconds["cold"], cold_start.measure, {"problem": problem}),
        "lmgc90": course.call("cold-lmgc90", seconds["cold"], cold_start.lmgc90, {}),
    }
    return found
