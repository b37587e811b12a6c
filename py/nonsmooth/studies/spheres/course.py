"""The course of a scene of spheres in a world: built at rest in its container, released, and followed to its end, with
rows, places and checkpoints in a folder (:mod:`recorded_course`).
"""

from __future__ import annotations

import math
import numpy as np

from yade import O

from ...system import checks
from ...world.stepping import advance, until
from . import places as files, preparation, scene as scenes
from .grains import SphereScene, SpheresError, check_run, world_of
from .recorded_course import RecordedCourse, follow

__all__ = ["run"]

RECORDS = 20  # to T
REST_SPEED = 0.02  # √(g d), rms speed of what must rest, at rest ...
REST_TIME = 0.5  # T, for so long
SETTLED_SPEED = 0.02  # √(g d), rms speed in the container before the release
SETTLE_LIMIT = 10.0  # T
PARTS = 10  # of a row, after each of which what has fallen out is taken out


class SphereCourse(RecordedCourse):
    """From the release to the end."""

    def __init__(self, scene, world, duration, folder, progress, told):
        super().__init__(scene, world, duration, folder, progress, told)
        self.limit, self.every = duration * self.unit, max(1, round(self.unit / RECORDS / O.dt))
        if told["series"] is None:
            self._look(None)

    @property
    def unit(self):
        """T [s]."""
        return math.sqrt(self.state["height"] / self.scene.gravity)

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
        s, now, found = self.state, self.now, self._seen()
        if not len(found):
            raise SpheresError(f"no sphere is left after {now:g} s: give another shape")
        row = self._row(found, self.scene.moving(found), self.scene.wall_gaps(found), self.scene.row(found, s))
        if "discharged_spheres" in row:
            s["left"] = [*s["left"], (now, row["discharged_spheres"])]
        slow = REST_SPEED * math.sqrt(self.scene.gravity * self.scene.diameter)
        s["calm"] = s["calm"] + 1 if now > self.unit and row["speed_rms_m_per_s"] < slow else 0
        while s["kept"] < len(self.scene.FRAMES) and now >= (self.scene.FRAMES[s["kept"]] - 1e-9) * self.unit:
            self._write(found)
            s["kept"] += 1
        self.progress(min(1.0, now / self.limit))

    def _results(self, series):
        return self.scene.results(series, files.read(self.folder / "snapshots" / "end.npz"), self.state)


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
    return follow(SphereCourse, _begin, scene, world, duration, folder, progress)
