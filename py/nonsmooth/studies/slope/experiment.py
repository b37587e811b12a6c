"""A slope experiment: bond, load, rest dry, raise the water, follow the avalanche until it rests.

What decides its course stands in :mod:`yade.nonsmooth.course.slope`, and :mod:`yade.nonsmooth.course.driver` drives it;
here it is looked at, and what was decided is done. All that a run goes on with stands in :class:`.course.slope.State`,
which goes into checkpoints; nothing depends on wall time.

* a step is ``numerics.time_step``, or as short as the speeds of contacts want it (NonsmoothTimeStepper, where the
  section gives a ``path``);
* forces on walls are means over the steps since the row before, and the largest.
"""

from __future__ import annotations

import contextlib
import json
import math
import time
from dataclasses import asdict
from pathlib import Path

from yade import O
from yade.minieigenHP import Vector3
from yade.wrapper import NewtonIntegrator, PartialEngine, PyRunner

from ... import course, records
from ...course import State, driver
from ...course.triggers import erosion
from ...errors import UserError
from ...model import scales
from ...model.section import Section, data as section_data
from ...packing.files import Packing
from ...records import checkpoints
from ...system import checks, keys
from ...system.whole_files import remove
from ...water import WaterError, field_files, of_section
from ...world import pore_pressure, tables, worlds
from ...world.stepping import advance
from . import attached, frames, results, run_files, slope, slope_packing
from .attached import come_to, row  # noqa: F401  ROW calls it
from .columns import COLUMNS
from .error import ArgumentError, EndError, ExperimentError
from .monitoring import SlopeMonitor
from .water_release import WaterRelease

__all__ = ["ArgumentError", "EndError", "Experiment", "ExperimentError", "State", "COLUMNS", "begin", "resume"]

# what a CourseRunner calls: saved scenes have it, and know this module by its public name
ROW = "import yade.nonsmooth.experiment; yade.nonsmooth.experiment.row()"


class Experiment(driver.Course):
    """Runs a built :class:`~yade.nonsmooth.studies.slope.slope.Slope` and writes its records into ``folder``.

    ``progress``: called with (stage, seconds simulated, seconds foreseen) after every row. ``damping_moving``: of soft
    contacts, instead of their world's while the slope moves. A slope of soft contacts has no checkpoints. ``state``,
    ``mark``: of a checkpoint, see :func:`resume`; without them the records of an earlier run in ``folder`` are removed.
    ``field``: the section's pore pressures (:func:`.water.of_section.field`), found anew unless given.
    """

    def __init__(
        self, built, folder, state=None, layers=None, progress=None, damping_moving=None, mark=None, field=None
    ):
        if not isinstance(built, slope.Slope):
            raise UserError(f"built {checks.shown(built)}: give a Slope, as slope.build(section) returns one")
        folder = checks.path("folder", folder, UserError, "give the path of a folder")
        if state is None:
            run_files.check_folder(folder)
        self.field = of_section.field(built.section) if field is None else field
        self.monitor = SlopeMonitor(built, layers, self.field)
        self.hard, self.layers = self.monitor.hard, self.monitor.layers
        worlds.check_damping("hard" if self.hard else "soft", damping_moving)
        self.slope, self.section, self.folder = built, built.section, Path(folder)
        self.state = state or State()
        self.progress = progress or (lambda *_: None)
        self.scales = scales.of(self.section)
        by_dilatancy = self.section.water is not None and self.section.water.release is not None
        self.release = WaterRelease(built, mark and mark["release"]) if by_dilatancy else None
        self.stands = False  # see run
        self.unsaved = None if self.hard else "a slope of soft contacts"
        if state is None:
            checkpoints.forget(self.folder)  # before anything is written that it would not belong to
            run_files.forget(self.folder)
            with contextlib.suppress(OSError):  # the series says what is wrong with the folder
                self.folder.mkdir(parents=True, exist_ok=True)
        self.series = records.SeriesWriter(
            self.folder / "series.csv", self.monitor.columns, resume_from=mark and mark["series"], overwrite=True
        )
        if state is None:  # after the series, by which a run's folder is known
            kept = of_section.kept(self.section, self.field, self.folder)
            section_data.write(kept, self.folder / section_data.FILE)
        self.walls = self.monitor.open_walls(self.folder / "walls.csv", mark and mark["walls"])
        self.eroding = self.monitor.open_ledger(self.folder / run_files.LEDGER, mark and mark["eroded"])
        self.surfaces = self.monitor.open_surfaces(self.folder / run_files.SURFACE, mark and mark["slip_surface"])
        if state is None:
            self.frames = frames.Frames(self.folder, self.section)
        else:
            run_files.forget_later(self.folder, state.stage, O.iter)
            if state.t0 is not None:
                self.monitor.note_begin(self.folder / run_files.BEGIN)
            rows = records.read_series(self.folder / "series.csv")
            self.frames = frames.Frames(self.folder, self.section, rows, asdict(state))
        super().__init__(self.series, self.walls.file, *(one.file for one in (self.eroding, self.surfaces) if one))
        self.newton = next(e for e in O.engines if isinstance(e, NewtonIntegrator))
        self.damping = (self.newton.damping, self.newton.damping if damping_moving is None else damping_moving)
        if state is None:
            self._begin()

    # ---- the course ---------------------------------------------------------------------------
    def run(self, end=None, stands=None):
        """Runs until the experiment is over, or until ``end`` [s] of simulated time, to the row that comes then or
        next. It may be called again, with a later ``end`` or none, and goes on from where it was, also after
        :meth:`attach`, after Ctrl-C and after an error that has been mended. Where the experiment is over, nothing is
        left to do.

        ``stands``: whether a slope that stands, and that nothing to come can move, ends it (see
        :mod:`yade.nonsmooth.course.slope`). Otherwise it goes on to its longest time, so that a script can do more to
        it. Unless given, that ends a run without ``end`` in a scene that has no engines of a script (PyRunner, and
        those that push or move bodies).

        Ctrl-C ends it after the next row, with a checkpoint, by raising interrupts.Interrupted. O.bodies and
        O.interactions are up to date when it ends; within ``progress`` they are after the engine's ``view()``.

        Raises EndError, which is a ValueError, for an ``end`` that is no number or not after the present time, before
        anything is done; StepError where an engine refuses a step, and ExperimentError where a disk has left the
        section.
        """
        if end is not None:
            remedy = f"the run is at {O.time:.6g} s of simulated time; give a later time [s], or none to run until the experiment is over"
            end = checks.number("end", end, EndError, remedy)
            if come_to(end):
                raise EndError(f"end {end:g}: {remedy}")
        self._open()
        attached.detach(self)
        self.stands = end is None and not _scripted() if stands is None else stands
        self._end = end
        driver.drive(self)

    def _over(self):
        return self.reached(self._end)

    def _where(self):
        return f"at {O.time:.1f} s of simulated time"

    def _steps(self):
        """Those up to the next row; returns its number."""
        row = self.next_row()
        ends = row * self.scales.row_seconds
        while self.state.stage == "settle" and not self.hard and O.time < ends - 0.5 * O.dt:
            self.newton.gravity = self._gravity(O.time)
            advance()
        advance(until=ends, view=False)
        return row

    def next_row(self):
        """Number of the row that ends next."""
        return course.next_row(O.time, O.dt, self.scales.row_seconds)

    def reached(self, end=None):
        """Whether the experiment is over, or has come to ``end`` [s] of simulated time."""
        return self.state.stage == "done" or (end is not None and come_to(end))

    def summarise(self, threads=None) -> dict:
        """Writes ``summary.json`` of what has been run, and returns it, see :func:`~yade.nonsmooth.studies.slope.results.summarise`."""
        solver = self.slope.solver
        ever = (
            {"overlap_worst_ever": solver.overlapWorstEver, "way_worst_ever": solver.wayWorstEver} if self.hard else {}
        )
        state = asdict(self.state) | ever
        return results.summarise(self.folder, self.section, state, threads=threads)

    def draw(self):
        """Draws all figures that the records allow, and the video; returns their paths and notes. What has not been
        summarised yet is, see :meth:`summarise`.
        """
        from . import run_figures  # brings matplotlib, which a run that draws nothing need not wait for

        path = self.folder / run_files.SUMMARY
        summary = json.loads(path.read_text()) if path.exists() else self.summarise()
        return run_figures.draw(self.folder, self.section, summary)

    def attach(self, stands=False):
        """Lets steps by O.run(), O.step(), the viewer and yade-batch go through the course: a CourseRunner becomes the
        first of O.engines, which does what :meth:`run` does between steps, and pauses the run where the course is over;
        that ends with the step that has begun. Returns the engine. ``stands``: as of :meth:`run`; unless given, a slope
        that stands goes on to its longest time, as a script or a hand may do more to it between two steps.

        Raises ExperimentError for soft contacts, whose gravity :meth:`run` makes grow.
        """
        if not self.hard:
            raise ExperimentError(
                "a slope of soft contacts is driven by Experiment.run() alone: its gravity grows in Python; call that instead of O.run()"
            )
        self._open()
        self.stands = stands
        return attached.attach(self, ROW)

    def row_came(self, row, simulated, seconds):
        """The steps up to a row, its number, have been made by an engine: what they simulated, and took [s]."""
        self._pass_row(row, simulated, seconds)
        if self.state.stage == "done":
            self._finish()
            self._close()

    def _count(self, simulated, seconds):
        s = self.state
        s.wall_steps_s += seconds
        if s.moving is not None:
            s.wall_moving_s += seconds
            s.moving_s += simulated

    def _spend(self, seconds):
        self.state.wall_s += seconds

    def _look(self, row):
        """``row``: its number."""
        solver = self.slope.solver
        disks = tables.bodies(solver)
        self.monitor.inside(disks, self.folder)
        more = not self.stands or (self.release is not None and self.release.relaxes)
        seen = self.monitor.seen(self.state, disks, more)
        s = self.state = course.noted(self.state, seen, self.scales)
        s.overlap_mean_worst = max(s.overlap_mean_worst, solver.overlapMean)
        values, regular = self.monitor.row(s, disks), course.keeps_frame(s, row)
        self.series.write(values)
        s.frames += regular
        if self.frames.takes(values, regular, asdict(course.after(s, seen, self.section, self.scales))):
            self.snapshot(self.frames.path(O.iter))
        self.frames.tidy()
        self._decide(seen)
        self.progress(self.state.stage, O.time, course.foreseen(self.state, O.time, self.section))

    def _open(self):
        super()._open()
        remove([self.folder / run_files.SURFACE_ARRAYS], "of an earlier end of the run")

    def _finish(self):
        self.checkpoint()
        if self.surfaces is not None:
            self.surfaces.write_arrays(self.folder / run_files.SURFACE_ARRAYS)

    def _decide(self, seen):
        """Goes on to the next state, and does what the change means."""
        before, self.state = self.state, course.after(self.state, seen, self.section, self.scales)
        changed = self.state.stage if self.state.stage != before.stage else None
        if changed == "dry":
            self._settled()
        elif changed == "water":
            self._loaded()
        elif before.stage == "water":
            self._care(*course.care(self.state, seen, self.section, self.scales))
        table = course.water_table(self.state, self.section)
        if table != course.water_table(before, self.section):
            self.slope.water.times, self.slope.water.heights = table
        begin = course.field_begin(self.state, self.section)
        if begin != course.field_begin(before, self.section):
            self.slope.water.field = pore_pressure.field(self.field, begin)
        if self.release is not None:  # before disks go, and a checkpoint is written
            self.release.look(tables.bodies(self.slope.solver), self.state.moving is not None)
        due = erosion.due(before, self.state, self.section)
        if due:
            x, y = self.monitor.take_out(due, tables.bodies(self.slope.solver))
            self.state.eroded_shift_x += x
            self.state.eroded_shift_y += y
        if changed == "done":
            self.snapshot(self.folder / "end.npz", contacts=True)
        elif changed:
            self.checkpoint()

    def _begin(self):
        """The first steps, without gravity; bonds the packing as it is, unless that comes after gravity has grown."""
        s, solver = self.state, self.slope.solver
        self.newton.gravity = self._gravity(0.0)
        self.walls.hold()
        advance(view=False)  # finds the contacts
        s.first_step = O.iter
        if self.section.stages.settle.bond == "before":
            s.bonds_initial = solver.bond()
        advance(view=False)
        s.contacts_initial = solver.contacts
        s.centre = self.monitor.centroid(tables.bodies(solver))[0]
        self.walls.forget()
        if self.hard:
            solver.view()  # what a script writes to the bodies before it runs the experiment then counts
            # gravity grows by itself from here on
            solver.finalGravity, solver.gravityBegin, solver.gravityRamp = (
                self._gravity(math.inf),
                0.0,
                self.section.stages.settle.ramp,
            )

    def _gravity(self, time):
        """Gravity [m/s²] at a time [s]."""
        return Vector3(0, -course.gravity_share(time, self.section.stages.settle) * self.section.gravity, 0)

    def _settled(self):
        """Gravity acts, the slope rests: what has moved until now counts no longer."""
        s, solver = self.state, self.slope.solver
        self.newton.gravity = self._gravity(O.time)  # that of the last step was the one of its begin
        s.packing_fraction = self.monitor.packing_fraction() if s.failed_dry is None else None
        if self.section.stages.settle.bond == "after":
            s.bonds_initial, s.contacts_initial = solver.bond(), solver.contacts
        solver.forgetEnergies()
        self.walls.forget_slip()
        if self.slope.water:
            self.slope.water.forgetReleases()

    def _loaded(self):
        """It is t0."""
        disks = tables.bodies(self.slope.solver)
        self.state.front0 = self.monitor.front(disks)
        self.snapshot(self.folder / run_files.BEGIN, contacts=True)
        self.monitor.note_begin(self.folder / run_files.BEGIN)
        start = course.loads_since(self.state)
        if self.slope.shaking is not None and start is not None:
            self.slope.shaking.begin, self.slope.shaking.dead = start + self.section.shaking.begin, False

    def _care(self, flowing, still):
        """How exactly contacts are computed, see :func:`.course.slope.care`."""
        if self.hard:
            self.slope.solver.tolerance = course.tolerance(flowing, still, self.section.numerics)
        else:
            self.newton.damping = course.damping(flowing, *self.damping)

    # ---- records ------------------------------------------------------------------------------
    def snapshot(self, path, contacts=False):
        """Writes the present state; with ``contacts`` also the forces."""
        self.monitor.snapshot(path, self.state, contacts)

    # ---- checkpoints --------------------------------------------------------------------------
    def checkpoint(self):
        """Saves all that :func:`resume` needs; an earlier checkpoint is there until the new one is whole. With soft
        contacts the records alone.
        """
        super().checkpoint()

    def _save(self):
        records.write_breaks(self.folder / "breaks.csv", tables.breaks(self.slope.solver), self.slope.first_disk)
        if self.hard:
            checkpoints.write(
                self.folder,
                run_key(self.section),
                {
                    "walls": self.slope.walls,
                    "first_disk": self.slope.first_disk,
                    "count": self.slope.count,
                    "state": asdict(self.state),
                    "series": self.series.mark(),
                    "wall_series": self.walls.file.mark(),
                    "eroded": self.eroding and self.eroding.file.mark(),
                    "surfaces": self.surfaces and self.surfaces.file.mark(),
                    **({"release": self.release.content()} if self.release is not None else {}),
                },
            )
        self.frames.saved()


def _scripted():
    """Whether the scene has engines that a script has put there, which may do more to the slope."""
    return any(isinstance(e, (PyRunner, PartialEngine)) and not e.dead for e in O.engines)


def begin(section, folder, progress=None, packing=None, world=None, damping_moving=None, strengths=None):
    """A new :class:`Experiment` of a Section: packed, built and bonded.

    ``packing``: a Packing whose layers are the section's, that of :func:`.slope_packing.of` (from the cache) unless
    given; ``world``: one of :mod:`worlds`, rigid disks with the section's numerics (:func:`.slope.hard`) unless given;
    ``progress``, ``damping_moving``: as of Experiment. Rows of soft contacts come at the times of those of rigid disks:
    their step is shortened until it divides a row. ``strengths``: materials whose strengths the slope has instead of
    the section's from its first step on, as of :func:`.slope.set_strengths`.

    Raises ArgumentError for what is no Section, no folder or no Packing, WaterError for a field of water that cannot be
    had, WorldError for what is no world or has no such
    damping, and what slope_packing.of and slope.build raise.
    """
    _check(section, folder)
    if packing is not None and not isinstance(packing, Packing):
        raise ArgumentError(
            f"packing {checks.shown(packing)}: give a Packing, as packing.read_text(file) returns one, or none for one "
            "of our own"
        )
    if world is not None:
        worlds.check(world)
    worlds.check_damping("hard" if world is None else world, damping_moving)
    folder = Path(folder)
    run_files.check_folder(folder)
    field = of_section.field(section)
    folder.mkdir(parents=True, exist_ok=True)
    began = time.monotonic()
    packed = slope_packing.of(section) if packing is None else packing
    seconds = time.monotonic() - began
    built = slope.build(section, packed, world)
    if not slope.is_hard(built):
        row = scales.of(section).row_seconds
        O.dt = row / math.ceil(row / O.dt)
    if strengths is not None:
        slope.set_strengths(built, strengths, world)
    course = Experiment(built, folder, progress=progress, damping_moving=damping_moving, field=field)
    course.state.wall_packing_s = seconds
    return course


def _check(section, folder):
    """Raises ArgumentError for what is no Section, and for what is no folder."""
    if not isinstance(section, Section):
        raise ArgumentError(f"section {checks.shown(section)}: give a Section, as section.load('circle') returns one")
    checks.path("folder", folder, ArgumentError, "give the path of a folder for the run")


def run_key(section):
    """What must agree between a checkpoint and the section it is resumed with."""
    shaking = section.shaking
    return keys.key_of(
        {
            "key": section.key("settled"),
            "water": section.water_field.key
            if section.water_field
            else asdict(section.water)
            if section.water
            else None,
            "stages": asdict(section.stages),
            "seed": section.seed,
            "roles": [[item.name, item.role] for item in (*section.walls, *section.layers, *section.interfaces)],
        }
        | ({"erosion": [asdict(window) for window in section.erosion]} if section.erosion else {})
        | ({"shaking": [shaking.begin, shaking.digest]} if shaking else {})
    )


def resume(section, folder, progress=None):
    """An :class:`Experiment` that goes on from the checkpoint in ``folder``.

    Raises ArgumentError for what is no Section or no folder, ExperimentError where there is no checkpoint, where it is
    damaged, or where it belongs to another section, and RecordsError where the series is not as it was then. Nothing
    has been written then.
    """
    _check(section, folder)
    content = checkpoints.read(folder, run_key(section), ExperimentError)
    try:
        state, mark = State(**content["state"]), {"series": content["series"], "walls": content["wall_series"]}
        mark["eroded"] = content.get("eroded")  # none where nothing is taken out
        mark["slip_surface"] = content.get("surfaces")  # none where no wall has a slip law
    except (KeyError, TypeError) as error:
        raise ExperimentError(
            f"{folder}: the checkpoint cannot be read ({error}); remove {folder}/checkpoint and run without --resume"
        ) from None
    for name, one in mark.items():
        if one is not None:
            records.kept(Path(folder) / f"{name}.csv", one)  # all of them, before any is written to
    mark["release"] = content.get("release")
    O.engines = attached.others()  # without that of the run that saved it
    built = slope.find(section, content["walls"], content["first_disk"], content["count"])
    try:
        field = None if section.water_field is None else field_files.read(Path(folder) / of_section.FILE)
    except WaterError as error:
        raise ExperimentError(f"{error}; the run wrote this file when it began: run again without --resume") from None
    return Experiment(built, folder, state=state, progress=progress, mark=mark, field=field)
