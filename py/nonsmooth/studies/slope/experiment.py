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

import numpy as np

from yade import O
from yade.minieigenHP import Vector3
from yade.wrapper import ContactDynamicsEngine, CourseRunner, NewtonIntegrator, PartialEngine, PyRunner

from ... import course, packing, records
from ...course import State, driver
from ...errors import UserError
from ...measure.fronts import front_of
from ...model import scales
from ...model.section import Section, data as section_data
from ...records import checkpoints
from ...records.columns import without
from ...system import checks, keys
from ...world import tables, worlds
from ...world.stepping import advance
from . import frames, results, slope, slope_packing
from .columns import COLUMNS
from .wall_series import WallSeries

__all__ = ["ArgumentError", "EndError", "Experiment", "ExperimentError", "State", "COLUMNS", "begin", "resume"]

FORCE_SAMPLES = 100  # of the forces on walls in a row, with soft contacts; each step with hard ones

#: Columns that only a run of rigid disks has: of the contact solver, and of the energies that it sums up.
OF_SOLVER = (
    "iterations",
    "residual",
    "residual_N_per_m",
    "tolerance",
    "energy_water_J",
    "energy_walls_J",
    *records.LOSSES,
    "energy_correction_J",
    "energy_error_rel",
)


class ExperimentError(UserError, RuntimeError):
    """The run cannot go on; the message says why and what helps."""


class ArgumentError(ExperimentError, ValueError):
    """What an experiment cannot be made of; nothing has been written then."""


class EndError(ExperimentError, ValueError):
    """An end of a run that is no time to come; nothing has been done then, and the run can go on with another."""


class Experiment(driver.Course):
    """Runs a built :class:`~nonsmooth.studies.slope.slope.Slope` and writes its records into ``folder``.

    ``progress``: called with (stage, seconds simulated, seconds foreseen) after every row. ``damping_moving``: of soft
    contacts, instead of their world's while the slope moves. A slope of soft contacts has no checkpoints. ``state``,
    ``mark``: of a checkpoint, see :func:`resume`; without them the records of an earlier run in ``folder`` are removed.
    """

    def __init__(self, built, folder, state=None, layers=None, progress=None, damping_moving=None, mark=None):
        if not isinstance(built, slope.Slope):
            raise UserError(f"built {checks.shown(built)}: give a Slope, as slope.build(section) returns one")
        folder = checks.path("folder", folder, UserError, "give the path of a folder")
        if state is None:
            results.check_folder(folder)
        self.hard = isinstance(built.solver, ContactDynamicsEngine)
        worlds.check_damping("hard" if self.hard else "soft", damping_moving)
        self.slope, self.section, self.folder = built, built.section, Path(folder)
        self.state = state or State()
        self.layers = slope.layers_of(built) if layers is None else layers
        self.progress = progress or (lambda *_: None)
        self.scales = scales.of(self.section)
        # disks of the mass, where others are bed or obstacles
        mass = np.array([layer.role == "mass" for layer in self.section.layers])
        self.mass = None if mass.all() else mass[self.layers]
        # disks whose water slip surfaces bear: the lowest of them; and in part, each that has columns of its own
        self.borne = None if self.section.borne.all() else self.section.borne[self.layers]
        self.borne_by = {name: self.section.borne_by(name)[self.layers] for name in self.section.stacked}
        self.stands = False  # see run
        self.runner = None  # see attach
        self.unsaved = None if self.hard else "a slope of soft contacts"
        own = records.own_columns(self.section.stacked)
        self.columns = (COLUMNS if self.hard else without(COLUMNS, OF_SOLVER)) | {
            name: COLUMNS[records.stem(name)]._replace(name=name) for name in own
        }
        if state is None:
            checkpoints.forget(self.folder)  # before anything is written that it would not belong to
            results.forget(self.folder)
            with contextlib.suppress(OSError):  # the series says what is wrong with the folder
                self.folder.mkdir(parents=True, exist_ok=True)
        self.series = records.SeriesWriter(
            self.folder / "series.csv", self.columns, resume_from=mark and mark["series"], overwrite=True
        )
        if state is None:  # after the series, by which a run's folder is known
            section_data.write(self.section, self.folder / section_data.FILE)
        # soft steps are thousands a row, and as cheap as a look at the walls
        period = 1 if self.hard else max(1, int(self.scales.row_seconds / O.dt / FORCE_SAMPLES))
        self.walls = WallSeries(built, self.layers, self.folder / "walls.csv", period, mark and mark["walls"])
        if state is None:
            self.frames = frames.Frames(self.folder, self.section)
        else:
            results.forget_later(self.folder, state.stage, O.iter)
            rows = records.read_series(self.folder / "series.csv")
            self.frames = frames.Frames(self.folder, self.section, rows, asdict(state))
        super().__init__(self.series, self.walls.file)
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
            if _come_to(end):
                raise EndError(f"end {end:g}: {remedy}")
        self._open()
        self._detach()
        self.stands = end is None and not _scripted() if stands is None else stands
        self._end = end
        driver.drive(self)

    def _over(self):
        return self.reached(self._end)

    def _where(self):
        return f"at {O.time:.1f} s of simulated time"

    def _steps(self):
        """Those up to the next row; returns its number."""
        row = self._next()
        ends = row * self.scales.row_seconds
        while self.state.stage == "settle" and not self.hard and O.time < ends - 0.5 * O.dt:
            self.newton.gravity = self._gravity(O.time)
            advance()
        advance(until=ends, view=False)
        return row

    def _next(self):
        """Number of the row that ends next."""
        return course.next_row(O.time, O.dt, self.scales.row_seconds)

    def reached(self, end=None):
        """Whether the experiment is over, or has come to ``end`` [s] of simulated time."""
        return self.state.stage == "done" or (end is not None and _come_to(end))

    def summarise(self, threads=None) -> dict:
        """Writes ``summary.json`` of what has been run, and returns it, see :func:`.results.summarise`."""
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

        path = self.folder / results.SUMMARY
        summary = json.loads(path.read_text()) if path.exists() else self.summarise()
        return run_figures.draw(self.folder, self.section, summary)

    def attach(self, stands=False):
        """Lets steps by O.run(), O.step(), the viewer and yade-batch go through the course: a CourseRunner becomes the
        first of O.engines, which does what :meth:`run` does between steps, and pauses the run where the course is over;
        that ends with the step that has begun. Returns the engine. ``stands``: as of :meth:`run`; unless given, a slope
        that stands goes on to its longest time, as a script or a hand may do more to it between two steps.

        Raises ExperimentError for soft contacts, whose gravity :meth:`run` makes grow.
        """
        global _attached
        if not self.hard:
            raise ExperimentError(
                "a slope of soft contacts is driven by Experiment.run() alone: its gravity grows in Python; call that instead of O.run()"
            )
        self._open()
        _attached, self.stands = self, stands
        self.runner = CourseRunner(
            label="slopeCourse", command="import yade.nonsmooth.experiment; yade.nonsmooth.experiment.row()"
        )
        O.engines = [self.runner, *(e for e in O.engines if not isinstance(e, CourseRunner))]
        self._wait()
        return self.runner

    def _detach(self):
        """Takes the engine of :meth:`attach` out again; the row that it would have written as the next step begins is
        written now.
        """
        if self.runner is not None:
            if not self.runner.dead and _come_to(self.runner.nextTime):
                self._row_came()
            O.engines = [e for e in O.engines if not isinstance(e, CourseRunner)]
            self.runner = None

    def _wait(self):
        """For the next row, or, where the course is over, for none."""
        self._waiting = self._next(), O.time, time.perf_counter()
        self.runner.nextTime = self._waiting[0] * self.scales.row_seconds
        self.runner.dead = self.state.stage == "done"

    def _row_came(self):
        number, first, began = self._waiting
        self._pass_row(number, O.time - first, time.perf_counter() - began)
        self._wait()
        if self.state.stage == "done":
            self._finish()
            self._close()
            O.pause()

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
        self._inside(disks)
        seen = self._seen(disks)
        s = self.state = course.noted(self.state, seen, self.scales)
        s.overlap_mean_worst = max(s.overlap_mean_worst, solver.overlapMean)
        values, regular = self._row(disks), course.keeps_frame(s, row)
        self.series.write(values)
        s.frames += regular
        if self.frames.takes(values, regular, asdict(course.after(s, seen, self.section, self.scales))):
            self.snapshot(self.frames.path(O.iter))
        self.frames.tidy()
        self._decide(seen)
        self.progress(self.state.stage, O.time, course.foreseen(self.state, O.time, self.section))

    def _finish(self):
        self.checkpoint()

    def _seen(self, disks):
        e, water, made = self.slope.solver, self.slope.water, self.state.bonds_initial
        return course.Seen(
            O.time,
            O.dt,
            self._mean_speed(disks),
            water.height if water else None,
            way=0.0
            if self.state.centre is None
            else abs(self._centroid(disks)[0] - self.state.centre) / self.section.mass_size,
            broken=(e.brokenTension + e.brokenShear + e.brokenTorque + e.brokenMixed) / made if made else 0.0,
            wet=water.wetCount if water else 0,
            top=self._top(disks),
            outside=self._outside(e),
            more=not self.stands,
        )

    def _top(self, t):
        """Height of the highest disk's centre above the water's plane [m]; the table acts on those whose centres are
        below it.
        """
        water = self.section.water
        if water is None:
            return -math.inf
        (x, y), (nx, ny) = water.point, water.normal
        return float(np.max((t["x"] - x) * nx + (t["y"] - y) * ny))

    def _outside(self, e):
        """Energy that came from elsewhere than weight and water [J/m]: of walls that move, of what a script did between
        steps since the slope settled (until then gravity, which grows, is counted there too) and, as long as all is
        dry, of forces that others put on disks. None with soft contacts, which nobody counts. It is 0 to the last bit
        where nobody has done anything."""
        if not self.hard:
            return None
        wet = self.state.wet or (self.slope.water is not None and self.slope.water.wetCount > 0)
        brought = 0.0 if self.state.stage == "settle" else abs(e.broughtEnergy)
        return brought + abs(e.wallWork) + (0.0 if wet else abs(e.externalWork))

    def _decide(self, seen):
        """Goes on to the next state, and does what the change means."""
        before, self.state = self.state, course.after(self.state, seen, self.section, self.scales)
        changed = self.state.stage if self.state.stage != before.stage else None
        if changed == "dry":
            self._settled()
        elif changed == "water":
            self._loaded()
        elif before.stage == "water":
            self._care(*course.care(self.state, seen, self.scales))
        table = course.water_table(self.state, self.section)
        if table != course.water_table(before, self.section):
            self.slope.water.times, self.slope.water.heights = table
        if changed == "done":
            self.snapshot(self.folder / "end.npz", contacts=True)
        elif changed:
            self.checkpoint()

    def _begin(self):
        """The first steps, without gravity; bonds the packing as it is, unless that comes after gravity has grown."""
        s, solver = self.state, self.slope.solver
        self.newton.gravity = self._gravity(0.0)
        advance(view=False)  # finds the contacts
        s.first_step = O.iter
        if self.section.stages.settle.bond == "before":
            s.bonds_initial = solver.bond()
        advance(view=False)
        s.contacts_initial = solver.contacts
        s.centre = self._centroid(tables.bodies(solver))[0]
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
        s.packing_fraction = self._fraction() if s.failed_dry is None else None
        if self.section.stages.settle.bond == "after":
            s.bonds_initial, s.contacts_initial = solver.bond(), solver.contacts
        solver.forgetEnergies()
        self.walls.forget_slip()
        if self.slope.water:
            self.slope.water.forgetReleases()

    def _loaded(self):
        """It is t0."""
        disks = tables.bodies(self.slope.solver)
        self.state.front0 = self._front(disks)
        self.snapshot(self.folder / "t0.npz", contacts=True)

    def _care(self, flowing, still):
        """How exactly contacts are computed, see :func:`.course.slope.care`."""
        if self.hard:
            self.slope.solver.tolerance = course.tolerance(flowing, still, self.section.numerics)
        else:
            self.newton.damping = course.damping(flowing, *self.damping)

    def _mean_speed(self, t):
        """Of the disks of the mass [m/s]; ``t``: the disks' table."""
        return (
            self.slope.solver.meanSpeed if self.mass is None else float(np.mean(np.hypot(t["vx"], t["vy"])[self.mass]))
        )

    def _centroid(self, t):
        """Of the mass, (x, y) [m]."""
        if self.mass is None:
            return self.slope.solver.centroid[0], self.slope.solver.centroid[1]
        return tuple(float(np.average(t[name][self.mass], weights=t["r"][self.mass] ** 2)) for name in ("x", "y"))

    def _front(self, t):
        """Of the mass [m]."""
        chosen = slice(None) if self.mass is None else self.mass
        return front_of(t["x"][chosen], t["r"][chosen], self.section.side)

    def _fraction(self):
        """Packing fraction of the settled bulk; None where the layers are too thin to have one."""
        x, y, r = (tables.bodies(self.slope.solver)[name] for name in ("x", "y", "r"))
        return packing.packing_fraction(packing.Packing(x, y, r, self.layers), self.section.outline)

    # ---- records ------------------------------------------------------------------------------
    def _inside(self, t):
        """Raises where a disk of the table ``t`` has left the section's box, and where a script has erased or added
        some.
        """
        if len(t["x"]) != self.slope.count:
            raise ExperimentError(
                f"at t = {O.time:.3f} s the scene has {len(t['x'])} disks, and the slope {self.slope.count}: its records have a row for each from its beginning on. Let a script that drives a slope "
                "push disks or move walls, and neither erase nor add disks; without some from the beginning, give a packing without them (packing.read_text)"
            )
        x0, y0, x1, y1 = self.section.bounds
        margin = 0.1 * max(x1 - x0, y1 - y0)
        out = ~((t["x"] > x0 - margin) & (t["x"] < x1 + margin) & (t["y"] > y0 - margin) & (t["y"] < y1 + margin))
        if out.any():
            k = int(np.flatnonzero(out)[0])
            raise ExperimentError(
                f"disk {k} left the section at t = {O.time:.3f} s: it is at ({t['x'][k]:.1f}, {t['y'][k]:.1f}) m; close the walls of "
                f"{self.section.source} there, or lower numerics.time_step. What was written until now stays in {self.folder}"
            )

    def _row(self, disks):
        e, water, section = self.slope.solver, self.slope.water, self.section
        forces, of_surfaces = self.walls.take()
        dp, fb, ss = forces["slip"], forces["backstop"], forces["ground"]
        total = water.totalForce if water else (0.0, 0.0, 0.0)
        lift = total[0] * section.water.normal[0] + total[1] * section.water.normal[1] if water else 0.0
        u = lift * self._share(disks, self.borne) if water else 0.0
        slip, (x, y) = self.walls.slip(), self._centroid(disks)
        row = {
            "step": O.iter,
            "time_s": O.time,
            "stage": course.STAGES.index(self.state.stage),
            "water_m": water.height if water else 0.0,
            "dp_normal_total_N_per_m": dp[0] + u,
            "dp_normal_effective_N_per_m": dp[0],
            "dp_water_N_per_m": u,
            "dp_shear_N_per_m": dp[1],
            "fb_normal_N_per_m": fb[0],
            "fb_shear_N_per_m": fb[1],
            "ss_normal_N_per_m": ss[0],
            "ss_shear_N_per_m": ss[1],
            "dp_normal_peak_N_per_m": dp[2],
            "fb_normal_peak_N_per_m": fb[2],
            "ss_normal_peak_N_per_m": ss[2],
            "wet_disks": water.wetCount if water else 0,
            "released_disks": water.releasedCount if water else 0,
            "speed_mean_m_per_s": self._mean_speed(disks),
            "speed_max_m_per_s": e.maxSpeed,
            "front_m": self._front(disks),
            "centroid_x_m": x,
            "centroid_y_m": y,
            **tables.bonds(e),
            "contacts": e.contacts,
            "slip_mean_dp_m": slip.mean,
            "weakened_disks": slip.weakened,
            "overlap_worst_rel": e.overlapWorst,
            "overlap_mean_rel": e.overlapMean,
            "energy_kinetic_J": e.kineticEnergy,
            "energy_potential_J": e.potentialEnergy,
        }
        for name, force in of_surfaces.items():
            share = lift * self._share(disks, self.borne_by[name]) if water else 0.0
            row |= self._of_surface(name, force, share)
        return row | self._of_solver(e) if self.hard else row

    def _of_surface(self, name, force, u):
        """The columns of one of several slip surfaces one above another: its normal and shear force and peak, and the
        water's on what it bears [N/m].
        """
        slip = self.walls.slip(name)
        values = (force[0] + u, force[0], u, force[1], force[2], slip.mean, slip.weakened)
        return {records.column(column, name): value for column, value in zip(records.OWN, values, strict=True)}

    def _share(self, t, part):
        """The part of the water's force that acts on what slip surfaces bear: these disks, or this part of each (None:
        all). Forces go with areas.
        """
        if part is None:
            return 1.0
        wet = tables.water(self.slope.water, self.slope.first_disk, self.slope.count)[0] * t["r"] ** 2
        return float((wet[part] if part.dtype == bool else wet * part).sum() / wet.sum()) if wet.any() else 0.0

    def _of_solver(self, e):
        """The columns of OF_SOLVER."""
        losses = e.slidingLoss + e.rollingLoss + e.debondingLoss + e.impactLoss
        # gravity grows: no balance yet
        turned = losses + e.kineticEnergy + abs(e.externalWork) if self.state.stage != "settle" else 0.0
        return {
            "iterations": e.iterations,
            "residual": e.residual,
            "residual_N_per_m": e.residualForce,
            "tolerance": e.tolerance,
            "energy_water_J": e.externalWork,
            "energy_walls_J": e.wallWork,
            "energy_sliding_J": e.slidingLoss,
            "energy_rolling_J": e.rollingLoss,
            "energy_impact_J": e.impactLoss,
            "energy_bonds_J": e.debondingLoss,
            "energy_correction_J": e.correctionEnergy,
            "energy_error_rel": e.energyError / turned if turned > 0 else 0.0,
        }

    def snapshot(self, path, contacts=False):
        """Writes the present state; with ``contacts`` also the forces."""
        path.parent.mkdir(parents=True, exist_ok=True)
        built, water = self.slope, self.slope.water
        t = tables.bodies(built.solver)
        first, count = built.first_disk, built.count
        arrays = {name: t[name] for name in ("x", "y", "r", "angle", "vx", "vy")}
        arrays["wet"], arrays["released"], arrays["ever_wet"] = tables.water(water, first, count)
        arrays["weakened"] = self.walls.weakened()
        if contacts:
            wall_numbers = {i: k for k, ids in enumerate(built.walls.values()) for i in ids}
            arrays.update(tables.loaded_contacts(built.solver, first, wall_numbers))
        records.write_snapshot(
            path, time_s=O.time, step=O.iter, layer=self.layers, water_m=water.height if water else 0.0, **arrays
        )

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
                },
            )
        self.frames.saved()


def _come_to(end):
    """Whether less than half a step is missing to the time ``end`` [s]."""
    return not O.time < end - 0.5 * O.dt


def _scripted():
    """Whether the scene has engines that a script has put there, which may do more to the slope."""
    return any(isinstance(e, (PyRunner, PartialEngine)) and not e.dead for e in O.engines)


_attached = None  # that a CourseRunner drives


def row():
    """What the CourseRunner of :meth:`Experiment.attach` calls. Raises ExperimentError where there is no such
    Experiment, as after O.load().
    """
    if _attached is None or _attached.runner not in O.engines:
        raise ExperimentError(
            "this process does not know the stages of this slope, as the scene was loaded without its run: continue with experiment.resume(section, folder).attach()"
        )
    _attached._row_came()


def begin(section, folder, progress=None):
    """A new :class:`Experiment` of a Section: packed (from the cache), built and bonded. Raises ArgumentError for what
    is no Section or no folder, and what slope_packing.of and slope.build raise.
    """
    _check(section, folder)
    folder = Path(folder)
    results.check_folder(folder)
    folder.mkdir(parents=True, exist_ok=True)
    began = time.monotonic()
    packed = slope_packing.of(section)
    seconds = time.monotonic() - began
    course = Experiment(slope.build(section, packed), folder, progress=progress)
    course.state.wall_packing_s = seconds
    return course


def _check(section, folder):
    """Raises ArgumentError for what is no Section, and for what is no folder."""
    if not isinstance(section, Section):
        raise ArgumentError(f"section {checks.shown(section)}: give a Section, as section.load('circle') returns one")
    checks.path("folder", folder, ArgumentError, "give the path of a folder for the run")


def run_key(section):
    """What must agree between a checkpoint and the section it is resumed with."""
    return keys.key_of(
        {
            "key": section.key("settled"),
            "water": asdict(section.water) if section.water else None,
            "stages": asdict(section.stages),
            "seed": section.seed,
            "roles": [[item.name, item.role] for item in (*section.walls, *section.layers, *section.interfaces)],
        }
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
    except (KeyError, TypeError) as error:
        raise ExperimentError(
            f"{folder}: the checkpoint cannot be read ({error}); remove {folder}/checkpoint and run without --resume"
        ) from None
    for name, one in mark.items():
        records.kept(Path(folder) / f"{name}.csv", one)  # all of them, before any is written to
    O.engines = [e for e in O.engines if not isinstance(e, CourseRunner)]  # of the run that saved it
    built = slope.find(section, content["walls"], content["first_disk"], content["count"])
    return Experiment(built, folder, state=state, progress=progress, mark=mark)
