"""A finished (or interrupted) run of a slope, opened from its folder: its section, numbers, tables, figures and video. Needs no YADE.

Like this::

    run = runs.open_run("out/hill")
    run.summary["water_at_failure_m"]
    run.series["front_m"]              # {column: array}; run.frame("series") is a pandas.DataFrame
    run.figure("forces")               # a matplotlib Figure, with axes to draw on
    run.video()                        # the video, in the page of a notebook

Runs of other kinds (``campaign``) are opened by what runs them; they have in common what :class:`Opened` has.
"""

from __future__ import annotations

import json
from functools import cached_property
from pathlib import Path

from ... import records
from ...errors import UserError
from ...model import section
from ...model.section import data as section_data
from ...system import checks, requirements
from ...system.whole_files import whole
from . import frames, results

__all__ = ["FIGURES", "Opened", "Run", "RunError", "open_run"]

FIGURES = results.PICTURES
VIDEOS = (".mp4", ".gif")  # as files of a run end


FOLDER = "give the path of a folder for the run"  # remedies that functions which make runs share
THREADS = "give a whole number from 1, how many run at a time"


class RunError(UserError, ValueError):
    """A folder that is no run, or what a run has not; the message says which and what helps."""


class Opened:
    """The folder of a run of any kind. ``folder``: of the run, which is read where something is asked for."""

    #: Names of the tables that :meth:`frame` knows.
    TABLES = ("series",)
    #: Where the numbers of a run without tables stand.
    NUMBERS = "its numbers are in run.summary"

    def __init__(self, folder):
        self.folder = Path(checks.path("folder", folder, RunError, "give the path of the folder of a run"))

    def frame(self, name="series"):
        """One of :attr:`TABLES` as a pandas.DataFrame. Raises RunError for another name, and where pandas is not installed."""
        if not self.TABLES:
            raise RunError(f"{self.folder}: a run of this kind has no table; {self.NUMBERS}")
        if name not in self.TABLES:
            *first, last = self.TABLES
            raise RunError(
                f"{self.folder}: no table is called {name!r}; give {', '.join(first)}{' or ' * bool(first)}{last}"
            )
        arrays = " and ".join(f"run.{one}" for one in self.TABLES)
        return self._as_frame(getattr(self, name), f"take the arrays of {arrays}")

    def _as_frame(self, columns, instead):
        """Columns as a pandas.DataFrame; ``instead``: what to do without pandas."""
        try:
            import pandas
        except ImportError:
            raise RunError(f"pandas is not installed: {requirements.remedy('pandas')}, or {instead}") from None
        return pandas.DataFrame(columns)

    def video(self, name=None, width=720):
        """The video that lies in the run's folder, with its bytes in it: what a notebook shows in its page (an object of IPython.display).

        ``name``: of the file, where there are several; ``width``: of the page [pixels]. Raises RunError where there is no video, MissingPackage without IPython.
        """
        if name is not None:
            checks.text("name", name, RunError, "give the name of a video in the folder of the run, or None")
        checks.number("width", width, RunError, "give pixels of the page, above 0", above=0)
        found = {path.name: path for ending in VIDEOS for path in whole(self.folder, f"*{ending}")}
        if name is None and len(found) == 1:
            (name,) = found
        if name not in found:
            which = "no video" if name is None else f"no video called {name!r}"
            advice = f"give one of {', '.join(sorted(found))}" if found else self._no_video()
            raise RunError(f"{self.folder}: {which} to show; {advice}")
        from IPython import display

        if name.endswith(".gif"):
            return display.Image(filename=str(found[name]), width=width)
        return display.Video(str(found[name]), embed=True, width=width)

    def _no_video(self):
        return "a run of this kind has one where it wrote one into its folder"

    def _file(self, name):
        path = self.folder / name
        if not path.is_file():
            raise RunError(f"{path}: missing; the run has not reached that stage, or this folder holds no such run")
        return path


class Run(Opened):
    """A run of a slope."""

    TABLES = ("series", "walls", "breaks")

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

    def snapshot(self, name) -> records.Snapshot:
        """The disks at "t0" or "end", with their contacts, or at a time [s], that of the nearest snapshot."""
        if name in ("t0", "end"):
            return records.read_snapshot(self._file(f"{name}.npz"))
        checks.number("snapshot", name, RunError, "give 't0', 'end' or a time [s]")
        shots = frames.of_run(self.folder, self.series)
        if not shots:
            raise RunError(f"{self.folder}: the run has written no snapshot yet; continue it with --resume")
        return records.read_snapshot(frames.nearest(shots, name))

    def figure(self, name):
        """One of FIGURES as a matplotlib Figure that is not written. Raises RunError for another name, and where the run has not come to what it shows."""
        if name not in FIGURES:
            raise RunError(f"{self.folder}: no figure is called {name!r}; give one of {', '.join(FIGURES)}")
        found = self._drawing.figure(name)
        if found is None:
            raise RunError(
                f"{self.folder}: the figure {name} needs a later stage, a wall or more disks than this run has; continue the run with --resume if it has not ended"
            )
        return found

    def video(self, name=None, width=720):
        """As :meth:`Opened.video`; where the run has left no video, it is drawn from its snapshots first, which takes a while. Raises RunError where there are none, or no ffmpeg."""
        if name is None and not whole(self.folder, "*.mp4"):
            made = self._drawing.video()
            if made is not None and made[0] is None:
                raise RunError(f"{self.folder}: {made[1]}")
        return super().video(name, width)

    def _no_video(self):
        return "the run has written no snapshot yet: let it go on with --resume"

    @cached_property
    def _drawing(self):
        from . import run_figures  # brings matplotlib, which a reader of numbers need not wait for

        return run_figures.Drawing(self.folder, self.section, self.summary)


def open_run(folder) -> Run:
    """The Run in a folder. Raises RunError where it is none."""
    run = Run(folder)
    if not (run.folder / section_data.FILE).is_file():
        raise RunError(
            f"{folder}: has no {section_data.FILE}, so no run of a slope of this version is here; give the folder that was given to --out"
        )
    return run
