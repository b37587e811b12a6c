"""The course of a scene of spheres in a world: built at rest in its container, released, and followed to its end, with
rows, places and checkpoints in a folder.

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
from ...world.stepping import advance, until
from . import places as files, preparation, scene as scenes
from .columns import COMMON
from .grains import SphereScene, SpheresError, check_run, key_of, world_of

__all__ = ["columns_of", "common_row", "run"]

RECORDS = 20  # to T
REST_SPEED = 0.02  # √(g d), rms speed of what must rest, at rest ...
REST_TIME = 0.5  # T, for so long
SETTLED_SPEED = 0.02  # √(g d), rms speed in the container before the release
SETTLE_LIMIT = 10.0  # T
PARTS = 10  # of a row, after each of which what has fallen out is taken out


def columns_of(kind):
    """{name: Column} of the series of a kind of SphereScene."""
    own = [name for name in COMMON if name != "wall_s"]
    return {name: COMMON[name] for name in own} | kind.COLUMNS | {"wall_s": COMMON["wall_s"]}


def common_row(found, bodies, still, gaps):
    """Values of :data:`.columns.COMMON` for the Places ``found``, but for ``wall_s``. ``still``, bool (n,): those whose
    speed counts; ``gaps``: between spheres and walls [m], arrays (n,).
    """
    mean, worst = measures.overlap(found.at, found.r, gaps)
    weight = found.r**3
    return {
        "step": found.step,
        "time_s": found.time_s,
        "spheres": len(found),
        "centroid_z_m": float(np.sum(weight * found.at[:, 2]) / np.sum(weight)),
        "height_m": float(np.max(found.at[:, 2] + found.r)),
        "speed_rms_m_per_s": math.sqrt(float(np.mean(found.speed[still] ** 2))) if still.any() else 0.0,
        "energy_kinetic_J": scenes.kinetic_energy(bodies),
        "overlap_mean_rel": mean,
        "overlap_worst_rel": worst,
    }


class SphereCourse(driver.Course):
    """From the release to the end; ``told``: what a checkpoint kept, see :meth:`_save`."""

    def __init__(self, scene, world, duration, folder, progress, told):
        self.scene, self.world, self.duration, self.folder, self.progress = scene, world, duration, folder, progress
        self.unsaved = None if world.name == "hard" else "a scene of soft spheres"
        self.state, self.bodies = told["state"], scenes.Bodies(**told["bodies"])
        self.unit = math.sqrt(self.state["height"] / scene.gravity)
        self.limit, self.every = duration * self.unit, max(1, round(self.unit / RECORDS / O.dt))
        self.series = records.SeriesWriter(
            folder / "series.csv", columns_of(type(scene)), resume_from=told["series"], overwrite=True
        )
        super().__init__(self.series, spent=self.state)
        if told["series"] is None:
            self._look(None)

    @property
    def now(self):
        """Time since the release [s]."""
        return (O.iter - self.state["begin"]) * O.dt

    @property
    def rested(self):
        """Whether what must rest has done so for long enough."""
        return self.state["calm"] * self.every * O.dt >= REST_TIME * self.unit

    def _ended(self):
        if self.scene.RESTS:
            return self.rested
        return hasattr(self.scene, "over") and self.scene.over(self.state["left"])

    def _over(self):
        return self.now >= self.limit * (1 - 1e-9) or self._ended()

    def _where(self):
        return f"at {self.now / self.unit:.1f} of {self.duration:g} T"

    def _steps(self):
        sink = self.scene.sink()
        if sink is None:
            advance(self.every, view=False)
            return
        for part in np.array_split(np.arange(self.every), min(self.every, PARTS)):
            advance(len(part))
            number, mass = scenes.take_out(self.bodies, sink)
            self.state["out"] += number
            self.state["out_kg"] += mass

    def _look(self, made):
        ContactDynamicsEngine().view()
        s, now = self.state, self.now
        found = scenes.places(self.bodies, now, O.iter - s["begin"])
        if not len(found):
            raise SpheresError(f"no sphere is left after {now:g} s: give another shape")
        common = common_row(found, self.bodies, self.scene.moving(found), self.scene.wall_gaps(found))
        row = {**common, **self.scene.row(found, s), "wall_s": s["wall_steps_s"]}
        self.series.write(row)
        if "discharged_spheres" in row:
            s["left"] = [*s["left"], (now, row["discharged_spheres"])]
        slow = REST_SPEED * math.sqrt(self.scene.gravity * self.scene.diameter)
        s["calm"] = s["calm"] + 1 if now > self.unit and common["speed_rms_m_per_s"] < slow else 0
        while s["kept"] < len(self.scene.FRAMES) and now >= (self.scene.FRAMES[s["kept"]] - 1e-9) * self.unit:
            files.write(self.folder / "snapshots" / f"{found.step:08d}.npz", found)
            s["kept"] += 1
        self.progress(min(1.0, now / self.limit))

    def _save(self):
        if self.unsaved is None:
            told = {"state": self.state, "bodies": self.bodies.plain(), "series": self.series.mark()}
            checkpoints.write(self.folder, key_of(self.scene, self.world, self.duration), told)

    def _finish(self):
        found = scenes.places(self.bodies, self.now, O.iter - self.state["begin"])
        files.write(self.folder / "snapshots" / "end.npz", found)


def _begin(scene, world):
    """Puts the spheres into the world, lets it rest, and opens the gate; what a :class:`SphereCourse` begins with."""
    ready = preparation.prepared(scene)
    height = preparation.height_of(scene, ready)
    top = float(np.max(ready.at[:, 2] + ready.r)) + 2 * scene.diameter
    bodies = scenes.put(scene, world, ready.at, ready.r, top)
    speed_unit = math.sqrt(scene.gravity * scene.diameter)

    def speed():
        return math.sqrt(float(np.mean(scenes.places(bodies).speed ** 2))) / speed_unit

    unit = math.sqrt(height / scene.gravity)
    every = max(1, round(unit / RECORDS / O.dt))
    # springs yield under the weight first; hard spheres have nothing to do
    if not until(lambda: speed() < SETTLED_SPEED, SETTLE_LIMIT * unit / O.dt, every):
        raise SpheresError(
            f"the spheres do not come to rest in their container in the {world.name} world: rms speed {speed():.2g} √(g d) after {SETTLE_LIMIT:.0f} T, "
            f"wanted {SETTLED_SPEED:g}; give a smaller time step or tolerance, or more damping"
        )
    state = dict(
        begin=O.iter, height=height, calm=0, kept=0, out=0, out_kg=0.0, left=[], spheres=len(ready), wall_s=0.0
    )
    state |= {"wall_steps_s": 0.0}
    if hasattr(scene, "bulk_density"):
        state["bulk_density"] = scene.bulk_density(ready)
    scenes.open_gate(bodies)
    return {"state": state, "bodies": bodies.plain(), "series": None}


@checks.takes(SpheresError, scene=checks.kind(SphereScene, "give a RoundColumn, RoundHopper, TurningDrum or PlatePile"))
def run(scene, world=None, folder=None, duration=None, progress=lambda share: None) -> dict:
    """Builds a SphereScene in a ``world`` (of :mod:`.sphere_worlds`; None: :func:`.spheres.grains.world_of` of the
    scene), lets it rest in its container, releases it and follows it to its end, with records in ``folder``; returns
    the numbers of the run, a dictionary that JSON can hold.

    A checkpoint in the folder is gone on from. ``duration``: longest course after the release in units of T (None:
    that of its kind): √(h₀/g), of a drum √(R/g). ``progress``: called with the share of it that is done. Written:
    series.csv, ``snapshots`` (:mod:`.spheres.places`), and ``checkpoint``. Raises SpheresError or SphereWorldError
    for what cannot be used, for spheres that do not come to rest, and for a checkpoint of another run.
    """
    world = world_of(scene) if world is None else world
    scene.check_world(world)
    duration = scene.DURATION if duration is None else duration
    checks.number("duration", duration, SpheresError, "give a number above 0, in units of T", above=0)
    check_run(scene, world, duration)
    folder = Path(checks.path("folder", folder, SpheresError, "give the path of a folder for the run's records"))
    (folder / "snapshots").mkdir(parents=True, exist_ok=True)
    if world.name == "hard" and checkpoints.exists(folder):
        told = checkpoints.read(folder, key_of(scene, world, duration), SpheresError)
    else:
        told = _begin(scene, world)
    course = SphereCourse(scene, world, duration, folder, progress, told)
    driver.drive(course)
    return _numbers(course)


def _numbers(course):
    s, scene = course.state, course.scene
    series = records.read_series(course.folder / "series.csv")
    end = files.read(course.folder / "snapshots" / "end.npz")
    return {
        "world": course.world.name,
        "settings": {k: list(v) if isinstance(v, tuple) else v for k, v in asdict(course.world).items()},
        "scene": scene.plain(),
        "spheres": s["spheres"],
        **scene.results(series, end, s),
        "ended": bool(course._ended()),
        "time_s": float(series["time_s"][-1]),
        "unit_s": course.unit,
        "time_step_s": O.dt,
        "steps": int(series["step"][-1]),
        "wall_s": float(s["wall_steps_s"]),
        "overlap_mean_rel": float(np.mean(series["overlap_mean_rel"])),
        "overlap_worst_rel": float(np.max(series["overlap_worst_rel"])),
    }
