"""Samples as they are before a test: disks packed dense, and pressed on all sides until they carry.

The sample is packed just short of touching, uniform by volume as the slope is (Taboada and Estrada 2009, sections 3.2.2
and 5.1). Then it is pressed between four smooth walls without gravity and without rolling resistance; without friction
too, unless it is asked for, which gives the densest isotropic state that the packing allows, as the slope is pressed
(:mod:`..slope_packing`). Where it is asked for the sample stays as it was packed. Rigid disks without cohesion know no
stress of their own: under any pressure they come to rest in the same places. So a sample is pressed once, under a
pressure whose value sets the unit of time only, and kept in the cache beside the packings.

Times are counted in t_i = √(m/p), with m the mean mass of a disk per metre and p the pressure.
"""

from __future__ import annotations

import math
import shutil
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from ... import packing
from ...errors import UserError
from ...model import section
from ...running import processes
from ...system import cache, keys

__all__ = ["RAMP", "STEP", "WALL_MASS", "Pressed", "SampleError", "Shape", "cache_path", "load", "make", "prepare"]

PRESSURE = 1e6  # Pa
DENSITY = 2500.0  # kg/m³
WALL_MASS = 0.02  # of the sample's mass, of a wall that follows the pressure
STEP = 0.05  # t_i
RAMP = 400  # steps in which the pressure grows
TOLERANCE, MAX_ITERATIONS = 1e-5, 1000
SLACK = 1e-5  # ℓ, overlaps that stay; ten times as large ones would push springs, which may begin with these places
REST_SPEED = 3e-4  # √(p/ρ), mean speed at rest; loose disks without friction fly about for ever
REST_STRESS = 0.01  # p, what the mean on each of the four walls may differ from it at rest ...
REST_STEPS = 40  # ... over about so many steps; the walls go on swinging a little
LIMIT = 6000  # steps


class SampleError(UserError, RuntimeError):
    """A sample that cannot be made; the message says why and what helps."""


@dataclass(frozen=True)
class Shape:
    """A sample: about ``count`` disks of ``d_min`` to ``d_max`` [m], packed to ``fraction``, ``aspect`` times as high
    as wide.

    ``friction``: of the disks while they are pressed; None: not pressed at all, the disks stay as they were packed,
    just short of touching.
    """

    count: int
    seed: int
    d_min: float = 1.0
    d_max: float = 4.0
    fraction: float = 0.848
    aspect: float = 2.0
    friction: float | None = 0.0

    @property
    def mean_square(self):
        """Mean square of the diameters [m²] by number, uniform by volume."""
        return self.d_min * self.d_max

    def section(self):
        """A section with one layer, the sample: what `packing.pack` fills."""
        disks = section.Disks(self.d_min, self.d_max, "uniform_by_volume", self.fraction)
        width = math.sqrt(self.count * math.pi / 4 * self.mean_square / self.fraction / self.aspect)
        for _ in range(4):  # the packing is looser along its border, so the box is a little larger
            made = section.block(width, self.aspect * width, disks=disks, seed=self.seed, source="the sample")
            width *= math.sqrt(self.count / max(1, sum(made.disk_counts())))
        if width < 4 * self.d_max:
            raise SampleError(
                f"{self.count} disks of {self.d_min:g} to {self.d_max:g} m make a sample {width:.3g} m wide, "
                f"{width / self.d_max:.2g} of the largest disks: ask for more disks, or a smaller aspect than {self.aspect:g}"
            )
        return made


@dataclass(frozen=True, eq=False)
class Pressed:
    """Disks at rest: centres ``x``, ``y`` and radii ``r`` [m], arrays of length n, in a box of ``width`` and ``height``
    [m] with its corner at the origin.
    """

    x: np.ndarray
    y: np.ndarray
    r: np.ndarray
    width: float
    height: float

    @property
    def diameters(self):
        """The smallest and the largest [m]."""
        return 2 * float(self.r.min()), 2 * float(self.r.max())


CACHE = cache.Cache("samples", Pressed)


def cache_path(shape):
    """Where the pressed sample of a shape is kept. Other engines and other code press their own, so
    that a test has the same bits with and without a cache from earlier ones."""
    return CACHE.path(keys.key_of([asdict(shape), keys.making_key(__name__)]))


def load(shape):
    """The pressed sample from the cache; SampleError where it is not there or damaged."""
    path = cache_path(shape)
    if (found := CACHE.find(path)) is None:
        raise SampleError(f"{path}: there is no such sample; prepare it first")
    return found


def prepare(shape, folder):
    """Makes the pressed sample of a shape in a process of its own, unless it is in the cache. ``folder``: of that
    process's files alone; it is left only by a failure.

    Raises processes.RunError where it fails.
    """
    if CACHE.find(cache_path(shape)) is None:
        folder = Path(folder)
        folder.mkdir(parents=True, exist_ok=True)
        processes.call(make, folder, asdict(shape))
        shutil.rmtree(folder, ignore_errors=True)


def make(folder, **plain):
    """Packs and presses a sample in the running (empty) scene, and puts it into the cache.

    ``plain``: fields of a Shape. Returns numbers of the course. Raises SampleError if the sample does not come to rest.
    """
    from yade import O
    from yade.wrapper import NscdMat

    from ...world import scene, tables
    from ...world.stepping import until
    from .walls import SIDES, Walls

    shape = Shape(**plain)
    box = shape.section()
    made = packing.cached_pack(box)
    order = np.argsort(made.y, kind="stable")  # neighbours in space are neighbours in memory
    if shape.friction is None:
        CACHE.keep(cache_path(shape), Pressed(made.x[order], made.y[order], made.r[order], *box.layers[0].points[2]))
        return {"disks": len(made)}
    angle = math.atan(shape.friction)
    O.reset()
    stuff, smooth = NscdMat(density=DENSITY, frictionAngle=angle), NscdMat(frictionAngle=0.0, wall=True)
    O.materials.append((stuff, smooth))
    walls = Walls.around(*box.layers[0].points[2], smooth, smooth)
    O.bodies.append([scene.disk((float(made.x[k]), float(made.y[k])), float(made.r[k]), stuff) for k in order])
    O.engines = scene.engines(
        gravity=(0, 0, 0),
        reach=0.2,
        verlet=0.1 * shape.d_min,
        tolerance=TOLERANCE,
        maxIterations=MAX_ITERATIONS,
        correctionSlack=SLACK,
    )
    engine = scene.contact_dynamics()
    whole = DENSITY * float(np.sum(math.pi * made.r**2))
    O.dt = STEP * math.sqrt(whole / len(made) / PRESSURE)
    # heavy at first, so that the walls do not knock; light at last, so that they follow
    for name in ("right", "top"):
        walls.free(name, whole)
    slow, mean = REST_SPEED * math.sqrt(PRESSURE / DENSITY), dict.fromkeys(SIDES, 0.0)

    def press(_):
        walls.pressure = PRESSURE * min(1.0, max(1e-3, O.iter / RAMP) ** 2)
        if O.iter == 2 * RAMP:
            for name in ("right", "top"):
                walls.free(name, WALL_MASS * whole)
        walls.step()
        for name, stress in walls.stresses().items():
            mean[name] += (stress - mean[name]) / REST_STEPS

    def calm():
        return (
            O.iter > 2 * RAMP + REST_STEPS
            and engine.meanSpeed < slow
            and all(abs(s / PRESSURE - 1) < REST_STRESS for s in mean.values())
        )

    if not until(calm, LIMIT, make=press):
        raise SampleError(
            f"the sample does not come to rest under pressure: mean speed {engine.meanSpeed:g} m/s, wanted {slow:g} m/s, "
            f"stresses {mean}; try another seed"
        )
    t, corner = tables.bodies(engine), (walls.place("left")[0], walls.place("bottom")[1])
    found = Pressed(t["x"] - corner[0], t["y"] - corner[1], t["r"], walls.width(), walls.height())
    CACHE.keep(cache_path(shape), found)
    return {
        "steps": O.iter,
        "disks": len(made),
        "sweeps_mean": engine.totalIterations / O.iter,
        "overlap_worst_rel": engine.overlapWorst,
    }
