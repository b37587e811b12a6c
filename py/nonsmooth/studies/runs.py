"""A finished (or interrupted) run of any study, opened from its folder: its numbers, tables, snapshots, figures and
video. Needs no YADE.

Like this::

    run = runs.open_run("out/hill")
    run.kind                           # "slope", "factor of safety", "biaxial test", "tension test", "slide", "heap"
                                       # or "spheres"
    run.summary["water_at_failure_m"]
    run.series["front_m"]              # {column: array}; run.frame("series") is a pandas.DataFrame
    run.figure("forces")               # a matplotlib Figure, with axes to draw on
    run.video()                        # the video, in the page of a notebook

What has no series, as a script or a comparison (``campaign``), is opened by what runs it; all have in common what
:class:`Opened` has.
"""

from __future__ import annotations

import json
from functools import cached_property
from pathlib import Path

from .. import records
from ..errors import UserError
from ..model import section
from ..model.section import data as section_data
from ..system import checks, requirements
from ..system.whole_files import whole
from .heaps import columns as heap_columns, study
from .laboratory import biaxial_test, tension_campaign, tension_test, wall_shear
from .safety import columns as safety_columns, results as safety_results
from .slope import columns as slope_columns, frames, run_files
from .spheres import columns as sphere_columns, study as sphere_study

__all__ = [
    "FIGURES",
    "BiaxialRun",
    "HeapRun",
    "Opened",
    "Run",
    "RunError",
    "RunFolderError",
    "SafetyRun",
    "SlideRun",
    "SlopeRun",
    "SpheresRun",
    "StudyRun",
    "TensionRun",
    "open_run",
]

FIGURES = run_files.PICTURES
VIDEOS = (".mp4", ".gif")  # as files of a run end
RESULT = "result.json"  # of a run in a process of its own


FOLDER = "give the path of a folder for the run"  # remedies that functions which make runs share
THREADS = "give a whole number from 1, how many run at a time"


class RunFolderError(UserError, ValueError):
    """A folder that is no run, or what a run has not; the message says which and what helps."""


RunError = RunFolderError  # its name for scripts and notebooks


class Opened:
    """The folder of a run of any kind. ``folder``: of the run, which is read where something is asked for."""

    #: Names of the tables that :meth:`frame` knows.
    TABLES = ("series",)
    #: Where the numbers of a run without tables stand.
    NUMBERS = "its numbers are in run.summary"

    def __init__(self, folder):
        self.folder = Path(checks.path("folder", folder, RunError, "give the path of the folder of a run"))

    def frame(self, name="series"):
        """One of :attr:`TABLES` as a pandas.DataFrame. Raises RunError for another name, and where pandas is not
        installed.
        """
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
        """The video that lies in the run's folder, with its bytes in it: what a notebook shows in its page (an object
        of IPython.display).

        ``name``: of the file, where there are several; ``width``: of the page [pixels]. Raises RunError where there is
        no video, MissingPackage without IPython.
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


class StudyRun(Opened):
    """The run of a study that writes a series."""

    #: What was run, in words.
    kind = None
    #: The columns that each series of this kind has, and those that it has where they are asked for: {name: Column}.
    COLUMNS, FURTHER = {}, {}

    @cached_property
    def series(self) -> dict:
        """Columns of ``series.csv``: {name: array (rows,)}."""
        return records.read_series(self._file("series.csv"))

    @property
    def columns(self) -> dict:
        """What the columns of the series are: {name: records.Column}."""
        known = self.COLUMNS | self.FURTHER
        return {name: known[records.stem(name)]._replace(name=name) for name in self.series}

    @cached_property
    def breaks(self) -> dict:
        """Broken bonds: {name: array}, see records.read_breaks. Raises RunError for a kind of run that keeps none."""
        return records.read_breaks(self._file(run_files.BREAKS))

    @cached_property
    def summary(self) -> dict:
        """Numbers of the run. Raises RunError where it has not ended."""
        return json.loads(self._file(RESULT).read_text())["found"]

    @cached_property
    def _asked(self):
        """Arguments of the function that made the run."""
        return json.loads(self._file("request.json").read_text())["arguments"]

    @property
    def snapshots(self) -> dict:
        """Files of the snapshots, by their names: {name: path}."""
        return {path.stem: path for path in whole(self.folder / run_files.SNAPSHOTS, "*.npz")}

    def snapshot(self, name) -> records.Snapshot:
        """The Snapshot of this name, one of :attr:`snapshots`, or at a time [s], that of the nearest. Raises RunError
        for another name, and where there is none.
        """
        found = self.snapshots
        if isinstance(name, str) and name in found:
            return records.read_snapshot(found[name])
        remedy = f"give a time [s], or one of {', '.join(found) or 'none: the run has written no snapshot yet'}"
        checks.number("snapshot", name, RunError, remedy)
        if not found:
            raise RunError(f"{self.folder}: the run has written no snapshot yet, or is of a kind that writes none")
        return min(map(records.read_snapshot, found.values()), key=lambda s: abs(s.time_s - name))


class SlopeRun(StudyRun):
    """A run of a slope."""

    kind, COLUMNS, FURTHER = "slope", slope_columns.COLUMNS, slope_columns.FURTHER
    #: The columns of ``walls.csv``: {name: Column}.
    WALL_COLUMNS = slope_columns.WALL_COLUMNS
    TABLES = ("series", "walls", "breaks", "eroded", "slip_surface")

    @cached_property
    def section(self):
        """The Section that was run."""
        return section.load(str(self.folder / section_data.FILE))

    @cached_property
    def summary(self) -> dict:
        """``summary.json``; RunError where the run has not come so far."""
        return json.loads(self._file(run_files.SUMMARY).read_text())

    @cached_property
    def walls(self) -> dict:
        """Columns of ``walls.csv``: {name: array (rows,)}, a row for each wall and time."""
        return records.read_walls(self._file("walls.csv"))

    @cached_property
    def eroded(self) -> dict:
        """Columns of ``eroded.csv``: {name: array (disks,)}, a row for each disk that was taken out. Raises RunError
        where the section has no windows that take some.
        """
        return records.read_eroded(self._file(run_files.LEDGER))

    @cached_property
    def slip_surface(self) -> dict:
        """Columns of ``slip_surface.csv``: {name: array (rows,)}, a row for each cell of a wall with a slip law, and
        time. Raises RunError where no wall has one.
        """
        return records.read_surfaces(self._file(run_files.SURFACE))

    @cached_property
    def slip_surface_arrays(self) -> dict:
        """The same by walls: {wall: {column: array}}, in time, in space, or (times, cells), see
        records.surface_arrays; of a run that goes on, or was killed, too.
        """
        return records.surface_arrays(self.slip_surface)

    @property
    def snapshots(self) -> dict:
        """Files of the snapshots, by their steps, and "t0" and "end" where the run has come so far: {name: path}."""
        ends = {
            path.stem: path for path in (self.folder / run_files.BEGIN, self.folder / run_files.END) if path.exists()
        }
        return {path.stem: path for _, path in frames.of_run(self.folder, self.series)} | ends

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
        """One of FIGURES as a matplotlib Figure that is not written. Raises RunError for another name, and where the
        run has not come to what it shows.
        """
        if name not in FIGURES:
            raise RunError(f"{self.folder}: no figure is called {name!r}; give one of {', '.join(FIGURES)}")
        found = self._drawing.figure(name)
        if found is None:
            raise RunError(
                f"{self.folder}: the figure {name} needs a later stage, a wall, windows or more disks than this run has; continue the run with --resume if it has not ended"
            )
        return found

    def video(self, name=None, width=720):
        """As :meth:`Opened.video`; where the run has left no video, it is drawn from its snapshots first, which takes a
        while. Raises RunError where there are none, or no ffmpeg.
        """
        if name is None and not whole(self.folder, "*.mp4"):
            made = self._drawing.video()
            if made is not None and made[0] is None:
                raise RunError(f"{self.folder}: {made[1]}")
        return super().video(name, width)

    def _no_video(self):
        return "the run has written no snapshot yet: let it go on with --resume"

    @cached_property
    def _drawing(self):
        from .slope import run_figures  # brings matplotlib, which a reader of numbers need not wait for

        return run_figures.Drawing(self.folder, self.section, self.summary)


Run = SlopeRun  # its name for scripts and notebooks


class SafetyRun(StudyRun):
    """A search for a factor of safety, see :mod:`~yade.nonsmooth.studies.safety`: its snapshots are "start" (the first rest), "rested" (the
    last one of a trial), and "before_failure" and "failed", of the trial that failed at the smallest factor.
    """

    kind, COLUMNS = "factor of safety", safety_columns.COLUMNS

    @cached_property
    def section(self):
        """The Section that was searched."""
        return section.load(str(self.folder / section_data.FILE))

    @cached_property
    def summary(self) -> dict:
        """``summary.json``: ``factor`` with its bracket ``factor_low`` and ``factor_high``, ``verdict`` and ``trials``;
        RunError where the search has not come so far.
        """
        return json.loads(self._file(safety_results.SUMMARY).read_text())

    @property
    def snapshots(self) -> dict:
        """Files of the snapshots, by their names: {name: path}."""
        return {path.stem: path for path in whole(self.folder, "*.npz")}

    def figure(self, name="displacements"):
        """``displacements`` against the factor, or the ``failing_mass``, as a matplotlib Figure that is not written.
        Raises RunError for another name, and where the search has not come to what it shows.
        """
        from .safety import pictures  # brings matplotlib, which a reader of numbers need not wait for

        if name not in pictures.FIGURES:
            raise RunError(f"{self.folder}: no figure is called {name!r}; give one of {', '.join(pictures.FIGURES)}")
        found = pictures.figure(self.folder, self.section, self.summary, name)
        if found is None:
            raise RunError(
                f"{self.folder}: the figure {name} needs a trial that has ended; the slope has not stood yet"
            )
        return found


class BiaxialRun(StudyRun):
    """A biaxial test, see :mod:`.laboratory.biaxial`: its snapshots are "begin", "1", "2", "4" (per cent of strain) and
    "end".
    """

    kind, COLUMNS = "biaxial test", biaxial_test.COLUMNS


class TensionRun(StudyRun):
    """A direct tension test, see :mod:`.laboratory.tension`: its snapshots are "begin", "peak", "0.5", "1", "2"
    (openings in half-axes of a mean bond's ellipse) and "end".
    """

    kind, COLUMNS = "tension test", tension_test.COLUMNS
    TABLES = ("series", "breaks")

    @cached_property
    def test(self):
        """The TensionTest that was run."""
        return tension_test.TensionTest.of(self._asked)

    @cached_property
    def strength(self) -> dict:
        """What the test says, see laboratory.tension_campaign.measure: ``tensile_strength_Pa``, ``strain_peak``, place
        and inclination of the break. Raises RunError where it has not ended.
        """
        self._file(RESULT)
        return tension_campaign.measure(self.test, self.folder)

    def figure(self, name="tension"):
        """``tension``: stress against strain, and the broken sample, as a matplotlib Figure that is not written. Raises
        RunError for another name, and where the test has not ended.
        """
        if name != "tension":
            raise RunError(f"{self.folder}: no figure is called {name!r}; give tension")
        from ..figures import tension  # brings matplotlib, which a reader of numbers need not wait for

        return tension.tests([(self.series, self.strength)], tension.Broken.of(self.folder, self.strength))


class SlideRun(StudyRun):
    """A block that slides on a wall, see :mod:`.laboratory.wall_shear`."""

    kind, COLUMNS = "slide", wall_shear.COLUMNS


class HeapRun(StudyRun):
    """A run of a column or a pile."""

    kind, COLUMNS = "heap", heap_columns.COLUMNS

    @cached_property
    def heap(self):
        """The Column or Pile that was run."""
        return study.KINDS[self._asked["kind"]](**self._asked["heap"])

    @property
    def world(self) -> dict:
        """What the world was asked for with, see heaps.study.world_of."""
        return self._asked["world"]

    def places(self):
        """Times [s] with the end last, a list of (x, y) of all disks for each, arrays (n,) [m], and radii (n,) [m].
        Raises HeapError where the run has kept none.
        """
        return study.frames(self.folder)

    def figure(self, name="collapse"):
        """``collapse``: the disks at several times, as a matplotlib Figure that is not written. Raises RunError for
        another name.
        """
        if name != "collapse":
            raise RunError(f"{self.folder}: no figure is called {name!r}; give collapse")
        from .heaps import report  # brings matplotlib, which a reader of numbers need not wait for

        return report.draw_collapse(self.heap, self.summary, self.folder)


class SpheresRun(StudyRun):
    """A run of a column, hopper, drum, pile or triaxial test of spheres in space."""

    kind = "spheres"
    COLUMNS = sphere_columns.COMMON
    FURTHER = {name: column for kind in sphere_study.KINDS.values() for name, column in kind.COLUMNS.items()}

    @cached_property
    def scene(self):
        """The RoundColumn, RoundHopper, TurningDrum, PlatePile or TriaxialTest that was run."""
        return sphere_study.KINDS[self._asked["kind"]](**self._asked["scene"])

    @property
    def world(self) -> dict:
        """What the world was asked for with, see spheres.grains.world_of."""
        return self._asked["world"]


def open_run(folder) -> StudyRun:
    """The run in a folder, of the kind that its section or the columns of its series tell. Raises RunError where it is
    none; of the folder of a study, which has runs in it, the message names them.
    """
    run = SlopeRun(folder)
    try:
        with (run.folder / "series.csv").open() as file:
            names = {records.stem(name) for name in file.readline().strip().split(",")}
    except (OSError, ValueError):
        names = {None}
    if (run.folder / section_data.FILE).is_file():
        return SafetyRun(folder) if names == set(SafetyRun.COLUMNS) else run
    for kind in (BiaxialRun, TensionRun, SlideRun, HeapRun):
        if names <= set(kind.COLUMNS):
            return kind(folder)
    if set(SpheresRun.COLUMNS) <= names <= set(SpheresRun.COLUMNS | SpheresRun.FURTHER):
        return SpheresRun(folder)
    if not run.folder.is_dir():
        raise RunError(f"{folder}: there is no such folder; give the folder of a run")
    if inner := sorted(path.parent.name for path in whole(run.folder / "runs", "*/series.csv")):
        raise RunError(
            f"{folder}: holds the runs of a study and is none itself; open one of them, {run.folder / 'runs' / inner[0]}"
            + (f", … {inner[-1]}" if len(inner) > 1 else "")
        )
    raise RunError(
        f"{folder}: has no {section_data.FILE}, and no series.csv with the columns of another study, so no run of this version is here; give the folder that was given to --out"
    )
