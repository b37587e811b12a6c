"""What the courses of spheres have in common: they keep rows, places and checkpoints in a folder, and give the numbers of
a run.

Checkpoints are those of rigid spheres. A scene of soft contacts has none: a file changes the order of its contacts, and
with it the last bits.
"""

from __future__ import annotations

import math
from dataclasses import asdict
from pathlib import Path

import numpy as np

from yade import O
from yade.wrapper import ContactDynamicsEngine

from ... import records
from ...course import driver
from ...measure import sphere_heaps as measures
from ...records import checkpoints
from ...system import checks
from . import places as files, scene as scenes
from .columns import COMMON
from .grains import SpheresError, key_of

__all__ = ["RecordedCourse", "columns_of", "follow"]


def columns_of(kind):
    """{name: Column} of the series of a kind of Spheres."""
    own = [name for name in COMMON if name != "wall_s"]
    return {name: COMMON[name] for name in own} | kind.COLUMNS | {"wall_s": COMMON["wall_s"]}


class RecordedCourse(driver.Course):
    """A course of ``scene``, Spheres, in a ``world``; ``duration``: part of the checkpoint's key; ``told``: what a
    checkpoint kept, or a begin made: the state, with the step ``begin`` and the wall times, the bodies, and the mark of
    the series.

    A kind of course defines ``unit``, ``_ended`` and ``_results``, and what a Course does.
    """

    NAME = "scene"  # what is followed, in words

    def __init__(self, scene, world, duration, folder, progress, told):
        self.scene, self.world, self.duration, self.folder, self.progress = scene, world, duration, folder, progress
        self.unsaved = None if world.name == "hard" else f"a {self.NAME} of soft spheres"
        self.state, self.bodies = told["state"], scenes.Bodies(**told["bodies"])
        self.series = records.SeriesWriter(
            folder / "series.csv", columns_of(type(scene)), resume_from=told["series"], overwrite=True
        )
        super().__init__(self.series, spent=self.state)

    @property
    def unit(self):
        """The unit of time of the course [s]."""
        raise NotImplementedError

    def _ended(self) -> bool:
        """Whether the course came to its end, not only to that of its time."""
        raise NotImplementedError

    def _results(self, series) -> dict:
        """What the kind of scene tells of the course; ``series``: of all rows, as records.read_series gives it."""
        raise NotImplementedError

    @property
    def now(self):
        """Time since the begin [s]."""
        return (O.iter - self.state["begin"]) * O.dt

    def _places(self):
        return scenes.places(self.bodies, self.now, O.iter - self.state["begin"])

    def _seen(self):
        """The Places now, with bodies and interactions up to date."""
        ContactDynamicsEngine().view()
        return self._places()

    def _row(self, found, still, gaps, own):
        """Writes a row: values of :data:`.columns.COMMON` for the Places ``found``, and the kind's ``own``. ``still``,
        bool (n,): those whose speed counts; ``gaps``: between spheres and walls [m], arrays (n,). Returns the row.
        """
        mean, worst = measures.overlap(found.at, found.r, gaps)
        weight = found.r**3
        row = {
            "step": found.step,
            "time_s": found.time_s,
            "spheres": len(found),
            "centroid_z_m": float(np.sum(weight * found.at[:, 2]) / np.sum(weight)),
            "height_m": float(np.max(found.at[:, 2] + found.r)),
            "speed_rms_m_per_s": math.sqrt(float(np.mean(found.speed[still] ** 2))) if still.any() else 0.0,
            "energy_kinetic_J": scenes.kinetic_energy(self.bodies),
            "overlap_mean_rel": mean,
            "overlap_worst_rel": worst,
            **own,
            "wall_s": self.state["wall_steps_s"],
        }
        self.series.write(row)
        return row

    def _write(self, found, name=None):
        """Writes Places as a snapshot; ``name``: None for that of its step."""
        files.write(self.folder / "snapshots" / f"{name or f'{found.step:08d}'}.npz", found)

    def _save(self):
        if self.unsaved is None:
            told = {"state": self.state, "bodies": self.bodies.plain(), "series": self.series.mark()}
            checkpoints.write(self.folder, key_of(self.scene, self.world, self.duration), told)

    def _finish(self):
        self._write(self._places(), "end")

    def numbers(self) -> dict:
        """The numbers of the run, a dictionary that JSON can hold."""
        series = records.read_series(self.folder / "series.csv")
        return {
            "world": self.world.name,
            "settings": {k: list(v) if isinstance(v, tuple) else v for k, v in asdict(self.world).items()},
            "scene": self.scene.plain(),
            "spheres": self.state["spheres"],
            **self._results(series),
            "ended": bool(self._ended()),
            "time_s": float(series["time_s"][-1]),
            "unit_s": self.unit,
            "time_step_s": O.dt,
            "steps": int(series["step"][-1]),
            "wall_s": float(self.state["wall_steps_s"]),
            "overlap_mean_rel": float(np.mean(series["overlap_mean_rel"])),
            "overlap_worst_rel": float(np.max(series["overlap_worst_rel"])),
        }


def follow(kind, begin, scene, world, duration, folder, progress) -> dict:
    """Follows a kind of RecordedCourse to its end, from the checkpoint in the ``folder`` where there is one, else from what
    begin(scene, world) makes; returns its numbers. Raises SpheresError for a folder that cannot be used and for a
    checkpoint of another run.
    """
    folder = Path(checks.path("folder", folder, SpheresError, "give the path of a folder for the run's records"))
    (folder / "snapshots").mkdir(parents=True, exist_ok=True)
    if world.name == "hard" and checkpoints.exists(folder):
        told = checkpoints.read(folder, key_of(scene, world, duration), SpheresError)
    else:
        told = begin(scene, world)
    course = kind(scene, world, duration, folder, progress, told)
    driver.drive(course)
    return course.numbers()
