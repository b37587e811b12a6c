"""Hard and soft contacts compared from any Python, as scripts/compare_hard_soft.py does it, and the result opened from
its folder.

    from nonsmooth import campaign

    found = campaign.run_comparison("column", "out/compare", seeds=[1, 2, 3], disks=200, stiffnesses=[1e8, 1e9])
    print(found)
    found.summary["stiffnesses_Pa"], found.figures()
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from functools import cached_property
from pathlib import Path

from ..errors import UserError
from ..running import processes
from ..studies import runs
from ..system import checks, output_folder
from ..system.whole_files import whole

__all__ = ["ComparisonError", "ComparisonRun", "open_comparison", "run_comparison"]

COMMAND = "compare_hard_soft.py"  # which writes the same records
FUNCTION = "studies.comparison.course:answered"
ANSWERS = "found.json"


class ComparisonError(UserError, ValueError):
    """A comparison that makes no sense; the message says what would."""


class ComparisonRun(runs.Opened):
    """A comparison; printed, its questions with their answers."""

    TABLES = ()

    @cached_property
    def summary(self) -> dict:
        """``summary.json``, see :mod:`..comparison.summary`."""
        return json.loads(self._file("summary.json").read_text())

    @cached_property
    def questions(self) -> list:
        """(question, verdict, sentences) of each. Raises RunError where the command made the comparison, which does not
        keep them.
        """
        return [tuple(one) for one in json.loads(self._file(ANSWERS).read_text())["questions"]]

    @property
    def report(self) -> Path:
        """Path of the page with all figures and tables."""
        return self._file("report.html")

    def figures(self) -> dict:
        """Paths of the figures (PNG), by their names."""
        return {path.stem: path for path in sorted(whole(self.folder / "figures", "*.png"))}

    def __str__(self):
        return "\n\n".join("\n  ".join([f"{text} {verdict}", *lines]) for text, verdict, lines in self.questions)


def open_comparison(folder) -> ComparisonRun:
    """The ComparisonRun in a folder. Raises RunError where it is none."""
    found = ComparisonRun(folder)
    if not all((found.folder / name).is_file() for name in ("summary.json", "report.html")):
        raise runs.RunError(f"{folder}: no comparison has ended here; give the folder that was given to it")
    return found


def run_comparison(scenario, out, seeds, threads=1, resume=False, **options) -> ComparisonRun:
    """Runs a comparison in the folder ``out``, as many runs at a time as ``threads``, and opens it.

    ``scenario``: "slope", "biaxial", "column", "pile", or of spheres "round-column" or "triaxial"; ``seeds``: of the
    packings; ``options``: ``disks``, ``stiffnesses`` [Pa], ``without`` and the others of comparison.course.compare; ``resume``: keep runs that have
    ended. Raises ComparisonError for a scenario, seeds, a folder or threads that make no sense, processes.RunError
    where values cannot be used, with the reason, or where a run fails; FolderError where another process works in the
    folder.
    """
    known = ("slope", "biaxial", "column", "pile", "round-column", "triaxial")
    if scenario not in known:
        raise ComparisonError(f"scenario {checks.shown(scenario)}: give one of {', '.join(known)}")
    checks.path("out", out, ComparisonError, runs.FOLDER)
    threads = checks.count("threads", threads, ComparisonError, runs.THREADS)
    remedy = "give whole numbers from 0, seeds of the packings, as [1, 2, 3]"
    if isinstance(seeds, str) or not isinstance(seeds, Iterable):
        raise ComparisonError(f"seeds {checks.shown(seeds)}: {remedy}")
    seeds = [checks.count("seeds", seed, ComparisonError, remedy, least=0) for seed in seeds]
    with output_folder.claimed(out, COMMAND, resume):
        arguments = {"scenario": scenario, "seeds": seeds, "threads": threads, "resume": resume, **options}
        processes.call(FUNCTION, out, arguments)
    return ComparisonRun(out)
