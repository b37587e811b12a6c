"""The trials of a search for the factor of safety: strengths divided, the slope looked at until it rests or fails, and
back to the last rest where it has failed.

Each trial begins from a file: the scene in which the slope rested last (``stable/``) is loaded, its strengths are set,
and the scene is saved (``checkpoint/``) and loaded again. So a search that is killed and resumed makes the same steps
as one that is not, of soft contacts too, whose order a file changes. Rigid disks have checkpoints within a trial as
well; a trial of soft ones begins anew.
"""

from __future__ import annotations

import math
from dataclasses import asdict
from pathlib import Path

import numpy as np

from yade import O
from yade.wrapper import ContactDynamicsEngine

from ... import course, records
from ...course import driver, strength_reduction as reduction
from ...model import scales
from ...model.section import data as section_data
from ...records import checkpoints
from ...water import of_section
from ...world import tables
from ...world.stepping import advance
from ..slope import slope
from . import loading, results
from .asked import SafetyError
from .columns import COLUMNS

__all__ = ["Search", "run"]


class Search(driver.Course):
    """The trials of an :class:`.asked.Asked` in ``folder``, from a checkpoint's content ``told`` on."""

    def __init__(self, asked, folder, told, progress):
        self.asked, self.folder, self.section, self.progress = asked, Path(folder), asked.section, progress
        self.rules, self.scales, self.world = asked.rules(), scales.of(asked.section), asked.make_world()
        self.state = reduction.SearchState(**told["state"])
        self.series = records.SeriesWriter(
            self.folder / results.SERIES, COLUMNS, resume_from=told["series"], overwrite=True
        )
        self.placed = {name: told[name] for name in ("walls", "first_disk", "count")}
        super().__init__(self.series)
        self._find()
        if told["new"]:
            self._begin()

    # ---- the driver's -------------------------------------------------------------------------
    def _over(self):
        return self.state.outcome is not None

    def _where(self):
        return f"in trial {self._number} at a factor of {self.state.factor:.4g}"

    def _steps(self):
        row = course.next_row(O.time, O.dt, self.scales.row_seconds)
        advance(until=row * self.scales.row_seconds, view=False)

    def _look(self, made):
        t = tables.bodies(self.built.solver)
        broken = self._broken()
        s = self.state
        x, y = (self._mean(t[axis], t["r"]) for axis in ("x", "y"))
        speed = float(np.mean(np.hypot(t["vx"], t["vy"])[self.mass]))
        self.series.write(self._row(t, speed))
        seen = course.Seen(
            O.time,
            O.dt,
            speed,
            way=math.hypot(x - s.centre[0], y - s.centre[1]) / self.section.mass_size,
            broken=(broken - s.broken) / s.bonds if s.bonds else 0.0,
        )
        self.state, said = reduction.judged(s, seen, self.rules)
        if said is not None:
            self._end(said, t)
        self.progress(reduction.share(self.state, self.rules), self._where())

    def _count(self, simulated, seconds):
        self.state.wall_steps_s += seconds

    def _spend(self, seconds):
        self.state.wall_s += seconds

    def _save(self):
        if self.asked.hard or self._over():
            self._write(self.folder)

    def _finish(self):
        self.checkpoint()

    # ---- trials -------------------------------------------------------------------------------
    @property
    def _number(self):
        return 1 + sum(one["trial"] > 0 for one in self.state.trials)

    def _begin(self):
        """A trial, from the last rest on."""
        checkpoints.read(self.folder / results.STABLE, self.asked.key, SafetyError)
        self._find()
        slope.set_strengths(self.built, self.asked.strengths(self.state.factor), self.world)
        t, s, solver = tables.bodies(self.built.solver), self.state, self.built.solver
        s.began, s.first_step = O.time, O.iter
        s.centre = tuple(self._mean(t[axis], t["r"]) for axis in ("x", "y"))
        s.bonds = solver.bonds
        self.snapshot(results.TRIAL, t)
        for file in self.files:
            file.sync()
        self._write(self.folder)
        checkpoints.read(self.folder, self.asked.key, SafetyError)
        self._find()

    def _end(self, said, t):
        """A trial has ended; ``t``: table of the disks."""
        s = self.state
        steps, seconds = O.iter - s.first_step, O.time - s.began
        way = self._ways(t)
        told = {
            "trial": self._number,
            "steps": steps,
            "seconds": seconds,
            "displacement_mean_m": float(way.mean()),
            "displacement_max_m": float(way.max()),
            "bonds_broken": self._broken() - s.broken,
        }
        if said[0] == reduction.FAILED:
            self.snapshot(results.FAILED, t)
            before = records.read_snapshot(self.folder / results.TRIAL)
            records.write_snapshot(self.folder / results.BEFORE, **vars(before))
        self.state = reduction.after(s, said, self.rules, **told)
        self.state.steps += steps
        self.state.seconds += seconds
        if said[0] == reduction.STABLE:
            self.snapshot(results.RESTED, t)
            rest(self.asked, self.folder, self.placed)
        if self.state.outcome is None:
            self._begin()

    # ---- the scene ----------------------------------------------------------------------------
    def _find(self):
        """Takes up the scene that is there."""
        self.built = found(self.asked, self.placed)
        layers = slope.layers_of(self.built)
        roles = np.array([layer.role == "mass" for layer in self.section.layers])
        self.mass = np.ones(len(layers), bool) if not roles.any() else roles[layers]
        self.layers = layers
        if isinstance(self.built.solver, ContactDynamicsEngine):
            self.built.solver.tolerance = course.tolerance(0.0, True, self.section.numerics)
        start = records.read_snapshot(self.folder / results.START)
        self.start = start.x, start.y

    def _mean(self, values, radii):
        return float(np.average(values[self.mass], weights=radii[self.mass] ** 2))

    def _ways(self, t):
        """Displacements of the disks of the mass since the first rest [m]."""
        return np.hypot(t["x"] - self.start[0], t["y"] - self.start[1])[self.mass]

    def _broken(self):
        return sum(value for name, value in tables.bonds(self.built.solver).items() if name != "bonds_alive")

    def _row(self, t, speed):
        solver, water, s, way = self.built.solver, self.built.water, self.state, self._ways(t)
        return {
            "step": s.steps + O.iter - s.first_step,
            "time_s": s.seconds + O.time - s.began,
            "trial": self._number,
            "factor": s.factor,
            "water_m": water.height if water else 0.0,
            "speed_mean_m_per_s": speed,
            "speed_max_m_per_s": solver.maxSpeed,
            "displacement_mean_m": float(way.mean()),
            "displacement_max_m": float(way.max()),
            **tables.bonds(solver),
            "contacts": solver.contacts,
        }

    def snapshot(self, name, t):
        """Writes the disks of the table ``t`` into the file ``name`` of the search's folder."""
        write_snapshot(self.folder / name, self.built, self.layers, t)

    def _write(self, folder):
        told = {"state": asdict(self.state), "series": self.series.mark(), "new": False, **self.placed}
        checkpoints.write(folder, self.asked.key, told)


def found(asked, placed):
    """The :class:`.slope.Slope` of a scene that is there; ``placed``: its ``walls``, ``first_disk`` and ``count``."""
    built, world = slope.find(asked.section, **placed), asked.make_world()
    if world is not None:
        layers, rocks = slope.layers_of(built), [asked.section.materials[one.material] for one in asked.section.layers]
        ids = built.first_disk + np.arange(built.count)
        built.solver = world.measures([(m, ids[layers == k].tolist()) for k, m in enumerate(rocks)])
    return built


def rest(asked, folder, placed):
    """Saves the scene as the one in which the slope rested last."""
    checkpoints.write(folder / results.STABLE, asked.key, placed)


def write_snapshot(path, built, layers, t):
    """Writes the disks of the table ``t`` of a Slope."""
    arrays = {name: t[name] for name in ("x", "y", "r", "angle", "vx", "vy")}
    arrays["wet"] = tables.water(built.water, built.first_disk, built.count)[0]
    records.write_snapshot(
        path, time_s=O.time, step=O.iter, layer=layers, water_m=built.water.height if built.water else 0.0, **arrays
    )


def run(asked, folder, progress=lambda share, doing: None) -> dict:
    """Searches the factor of safety of an :class:`.asked.Asked` in the running scene, with records below ``folder``,
    and goes on from a checkpoint in it, if there is one; returns the summary, see :func:`~yade.nonsmooth.studies.safety.results.summarise`.

    ``progress``: called now and then with the share done and what is being done. Raises what a slope's run raises,
    SafetyError for a checkpoint that is damaged or of another search, and interrupts.Interrupted after Ctrl-C.
    """
    folder = Path(folder)
    if checkpoints.exists(folder):
        told = checkpoints.read(folder, asked.key, SafetyError)
        state = reduction.SearchState(**told["state"])
    else:
        state, told = _loaded(asked, folder, progress)
    if state.outcome is None:
        search = Search(asked, folder, told, progress)
        driver.drive(search)
        state = search.state
    return results.summarise(folder, asked, asdict(state))


def _loaded(asked, folder, progress):
    """Loads the slope until it stands at some factor: the SearchState then, and what a :class:`Search` begins with."""
    state, rules = reduction.SearchState(), asked.rules()
    kept = of_section.kept(asked.section, of_section.field(asked.section), _made(folder))
    section_data.write(kept, folder / section_data.FILE)
    while state.stable is None and state.outcome is None:
        factor = state.factor

        def note(stage, now, foreseen, factor=factor):
            progress(0.2 * now / max(foreseen, now), f"loading at a factor of {factor:.4g}")

        said, built = loading.load(asked, loading.folder_of(folder, factor), factor, note)
        state = reduction.after(state, said, rules, trial=0, seconds=O.time)
    if state.stable is None:
        return state, None
    t, layers = tables.bodies(built.solver), slope.layers_of(built)
    write_snapshot(folder / results.START, built, layers, t)
    placed = {"walls": built.walls, "first_disk": built.first_disk, "count": built.count}
    rest(asked, folder, placed)
    return state, {"state": asdict(state), "series": None, "new": True, **placed}


def _made(folder):
    folder.mkdir(parents=True, exist_ok=True)
    return folder
