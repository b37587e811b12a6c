"""A finished (or interrupted) run of a slope, opened from its folder: its section, numbers, tables and figures. Needs no YADE.

Like this::

    run = runs.open_run("out/hill")
    run.summary["water_at_failure_m"]
    run.series["front_m"]              # {column: array}; run.frame("series") is a pandas.DataFrame
    run.figure("forces")               # a matplotlib Figure, with axes to draw on
"""

from __future__ import annotations

import json
from functools import cached_property
from pathlib import Path

from . import frames, records, results, section, section_data
from .errors import UserError

__all__ = ["FIGURES", "Run", "RunError", "open_run"]

FIGURES = results.PICTURES


class RunError(UserError, ValueError):
    """A folder that is no run, or what a run has not; the message says which and what helps."""


class Run:
    """``folder``: of the run, which is read where something is asked for."""

    def __init__(self, folder):
        self.folder = Path(folder)

    @cached_property
    def section(self):
        """The Section that was run."""
        return section.load(str(self.folder / section_data.FILE))

    @cached_property
    def summary(self) -> dict:
        """``summary.json``; RunError where the run has not come so far."""
        return json.loads(self._file(results.SUMMARY).read_text())

    @cached_property
    def series(self) -> dict:
        """Columns of ``series.csv``: {name: array (rows,)}."""
        return records.read_series(self._file("series.csv"))

    @cached_property
    def walls(self) -> dict:
        """Columns of ``walls.csv``: {name: array (rows,)}, a row for each wall and time."""
        return records.read_walls(self._file("walls.csv"))

    @cached_property
    def breaks(self) -> dict:
        """Broken bonds: {name: array}, see records.read_breaks."""
        return records.read_breaks(self._file(results.BREAKS))

    def frame(self, name):
        """``series``, ``walls`` or ``breaks`` as a pandas.DataFrame. Raises RunError for another name, and where pandas is not installed."""
        if name not in ("series", "walls", "breaks"):
            raise RunError(f"{self.folder}: no table is called {name!r}; give series, walls or breaks")
        try:
            import pandas
        except ImportError:
            raise RunError(
                "pandas is not installed: apt install python3-pandas, or take the arrays of run.series, run.walls and run.breaks"
            ) from None
        return pandas.DataFrame(getattr(self, name))

    def snapshot(self, name) -> records.Snapshot:
        """The disks at "t0" or "end", with their contacts, or at a time [s], that of the nearest snapshot."""
        if isinstance(name, str):
            return records.read_snapshot(self._file(f"{name}.npz"))
        shots = frames.of_run(self.folder, self.series)
        if not shots:
            raise RunError(f"{self.folder}: the run has written no snapshot yet; let it go on with --resume")
        return records.read_snapshot(frames.nearest(shots, name))

    def figure(self, name):
        """One of FIGURES as a matplotlib Figure that is not written. Raises RunError for another name, and where the run has not come to what it shows."""
        if name not in FIGURES:
            raise RunError(f"{self.folder}: no figure is called {name!r}; give one of {', '.join(FIGURES)}")
        found = self._drawing.figure(name)
        if found is None:
            raise RunError(
                f"{self.folder}: the run has not come to what {name} shows, failed before it, or has no wall or too few disks for it; let it go on with --resume if it has not ended"
            )
        return found

    @cached_property
    def _drawing(self):
        from . import run_figures  # brings matplotlib, which a reader of numbers need not wait for

        return run_figures.Drawing(self.folder, self.section, self.summary)

    def _file(self, name):
        path = self.folder / name
        if not path.is_file():
            raise RunError(f"{path}: missing; the run has not come so far, or nothing of the kind was run here")
        return path


def open_run(folder) -> Run:
    """The Run in a folder. Raises RunError where it is none."""
    if not (Path(folder) / section_data.FILE).is_file():
        raise RunError(
            f"{folder}: has no {section_data.FILE}, so no run of a slope of this version is here; give the folder that was given to --out"
        )
    return Run(folder)
