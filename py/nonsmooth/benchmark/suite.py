"""All measurements, each in a YADE process of its own, one after the other."""

from __future__ import annotations

import threading
from dataclasses import dataclass
from pathlib import Path

from .. import processes
from . import cold_start, machine, soft_step, states, steps, sweeps

__all__ = ["FULL", "QUICK", "Effort", "run"]


@dataclass(frozen=True)
class Effort:
    """How often things are repeated: timed steps of a run, and turns of the sweeps' paths."""

    steps: int
    repeats: int


FULL, QUICK = Effort(200, 30), Effort(60, 10)


class _Course:
    """Calls functions in processes, in folders below ``home``, and shows how far they are; ``total``: seconds foreseen for all of them."""

    def __init__(self, home, total, progress):
        self.home, self.total, self.progress, self.gone = Path(home), total, progress, 0.0

    def call(self, name, seconds, function, arguments, threads=1):
        """``function(folder, **arguments)`` in a process of so many threads, foreseen to take so many seconds; raises states.BenchmarkError where it fails."""
        folder = self.home / name
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "progress").unlink(missing_ok=True)
        ended = threading.Event()
        watcher = threading.Thread(target=self._watch, args=(folder, seconds, ended), daemon=True)
        watcher.start()
        try:
            return processes.call(function, folder, arguments, threads)
        except RuntimeError as error:
            # the last line is the exception's own
            raise states.BenchmarkError(f"{str(error).strip().splitlines()[-1]} (all of it: {folder / 'log.txt'})") from None
        finally:
            ended.set()
            watcher.join()
            self.gone += seconds
            self.progress(min(1.0, self.gone / self.total), name)

    def _watch(self, folder, seconds, ended):
        while True:
            try:
                share = float((folder / "progress").read_text())
            except (OSError, ValueError):
                share = 0.0
            self.progress(min(1.0, (self.gone + share * seconds) / self.total), folder.name)
            if ended.wait(1.0):
                return


def run(out, source, disks, threads, effort, progress=lambda share, doing: None):
    """Makes the states that are missing, and measures; returns everything as a dictionary that JSON can hold (see report.summarise).

    ``source``: section of the slope, see states.section_of; ``out``: folder that keeps each process's log below ``runs``; ``progress``: called with the
    share done and what is being done. Raises states.BenchmarkError with the first failure.
    """
    subject = {"source": source, "disks": disks}
    made = not states.exist(source, disks)
    per_thousand = disks / 1000
    seconds = {"states": 8 * per_thousand if made else 0, "steps": 2 + 0.01 * effort.steps * per_thousand, "sweeps": 5 + 0.06 * effort.repeats * per_thousand,
               "cold": 5 + 0.5 * per_thousand}
    counts = sorted({1, threads})
    course = _Course(Path(out) / "runs", seconds["states"] + 3 * len(counts) * seconds["steps"] + seconds["sweeps"] + 2 * seconds["cold"], progress)
    found = {"machine": machine.describe(), "section": source, "disks": disks, "threads": threads, "states_made": made, "steps": [], "soft_steps": []}
    if made:
        course.call("states", seconds["states"], states.make, subject, threads)
    for count in counts:
        for state in states.NAMES:
            timed = course.call(f"steps-{state}-{count}", seconds["steps"], steps.measure,
                                {**subject, "state": state, "steps": effort.steps, "dump": state == "rest"}, count)
            found["steps"].append({"state": state, "threads": count, **timed})
        soft = course.call(f"soft-steps-{count}", seconds["steps"], soft_step.measure, {**subject, "steps": effort.steps}, count)
        found["soft_steps"].append({"threads": count, **soft})
    problem = str(course.home.resolve() / "steps-rest-1" / "step.h5")
    found["sweeps"] = course.call("sweeps", seconds["sweeps"], sweeps.measure, {"problem": problem, "repeats": effort.repeats}, 2)
    found["cold_start"] = {"slope": course.call("cold-slope", seconds["cold"], cold_start.measure, {"problem": problem}),
                           "lmgc90": course.call("cold-lmgc90", seconds["cold"], cold_start.lmgc90, {})}
    return found
