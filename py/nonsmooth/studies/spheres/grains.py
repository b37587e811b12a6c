"""Spheres of a scene in space: what a column, a hopper, a drum, a pile and a triaxial test have in common."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, fields

import numpy as np

from ...errors import UserError
from ...model.section import units
from ...system import checks, keys
from ...world import long_courses
from ...world import sphere_worlds as worlds
from ...world.choice import check_choice
from ..heaps.grains import RANGES

__all__ = ["PATH_PER_STEP", "TOLERANCE", "SphereScene", "Spheres", "SpheresError", "check_run", "key_of", "world_of"]

PATH_PER_STEP = 0.1  # mean diameters, at the speed of a free fall from the top, or at √(p/ρ) under a pressure
TOLERANCE = 1e-4  # of the solver's residual, relative
MOST_OVERLAP = 0.02  # diameters, largest overlap under its load that soft contacts may have
MOST_SPHERES = 200_000
_SOFT = tuple(one.name for one in fields(worlds.SoftSpheres) if one.name != "diameter")


class SpheresError(UserError, ValueError):
    """A parameter that cannot be used, or a run that cannot go on; one message with key, value and what would do."""


@dataclass(frozen=True)
class Spheres:
    """Spheres and what they touch, without gravity.

    ``diameter``: mean by number [m]; ``size_spread``: largest over smallest diameter, sizes being uniform by volume in
    between; ``density`` [kg/m³]; ``friction``, ``rolling_friction``, ``twisting_friction`` (the last two in units of ℓ)
    and ``restitution`` of all contacts, walls included; ``seed`` of sizes and places.
    """

    diameter: float = 0.01
    size_spread: float = 1.5
    density: float = 2500.0
    friction: float = 0.5
    rolling_friction: float = 0.05
    twisting_friction: float = 0.0
    restitution: float = 0.0
    seed: int = 1

    #: What it is, in its records.
    KIND = "spheres"
    #: Of a scene that has none.
    gravity = 0.0

    def __post_init__(self):
        checks.count("seed", self.seed, SpheresError, "give a whole number from 0", least=0)
        for key in ("diameter", "density"):
            self._range(key)
        for key in ("friction", "rolling_friction", "twisting_friction"):
            self._number(key, "give 0 or more", least=0)
            wrong = units.wrong(key, getattr(self, key)) if key != "twisting_friction" else None
            if wrong:
                raise SpheresError(f"{key} {getattr(self, key):g}: {wrong}")
        self._number("twisting_friction", "it is in mean diameters; give a number from 0 to 2", least=0, most=2)
        self._number("size_spread", "give largest over smallest diameter, from 1 to 4", least=1, most=4)
        self._number("restitution", "give a number from 0 to less than 1", least=0, below=1)
        self._check()
        if not 1 <= self.count() <= MOST_SPHERES:
            raise SpheresError(
                f"{self.sizes_told()}: that is {self.count()} spheres; give values for 1 to {MOST_SPHERES} of them"
            )

    def _number(self, key, remedy, **bounds):
        checks.number(key, getattr(self, key), SpheresError, remedy, **bounds)

    def _range(self, key):
        least, most, unit = RANGES[key]
        self._number(key, f"give a number from {least:g} to {most:g} {unit}", least=least, most=most)

    # ---- a kind's own -------------------------------------------------------------------------------
    def _check(self):
        """Raises SpheresError for its own parameters."""

    def sizes_told(self):
        """The parameters on which the number of spheres depends, with their values, in words."""
        raise NotImplementedError

    def count(self):
        """Number of spheres."""
        raise NotImplementedError

    def sites(self, radii):
        """Places (n, 3) [m] for spheres of these ``radii``, apart from each other. Raises SpheresError where they do
        not fit.
        """
        raise NotImplementedError

    def stand(self, walls, top):
        """Puts facets and boxes into the scene by ``walls``, a :class:`.walls.RoundWalls`."""
        raise NotImplementedError

    def time_step(self, path=PATH_PER_STEP):
        """Step [s] for hard contacts, in which a sphere of a usual speed goes over ``path`` mean diameters."""
        raise NotImplementedError

    def overlap(self, stiffness):
        """Overlap [mean diameters] of springs of this ``stiffness`` [Pa] under the load of the scene; and which spheres
        have it, in words.
        """
        raise NotImplementedError

    def effort(self):
        """How long a run takes beside others of its kind, in any unit."""
        raise NotImplementedError

    def lasts(self, duration=None):
        """Time [s] of a course; ``duration`` [T]: None: the usual one."""
        raise NotImplementedError

    def check_room(self):
        """Raises SpheresError where its spheres do not fit, as far as it can be told at once."""

    # ---- sizes --------------------------------------------------------------------------------------
    def diameters(self):
        """Smallest and largest diameter [m]."""
        s = self.size_spread  # a number density ∝ d⁻³ from a to s a has the mean 2 s a/(1 + s)
        return self.diameter * (1 + s) / (2 * s), self.diameter * (1 + s) / 2

    def mean_volume(self):
        """Mean volume of a sphere [m³], by number."""
        a, b = self.diameters()
        return math.pi / 6 * 2 * (a * b) ** 2 / (a + b)

    def radii(self):
        """Radii [m] of its spheres, (n,), drawn by the seed."""
        smallest = self.diameters()[0]
        drawn = np.random.default_rng([self.seed, 1]).random(self.count())
        return 0.5 * smallest / np.sqrt(1 - drawn * (1 - 1 / self.size_spread**2))

    # ---- materials ----------------------------------------------------------------------------------
    def material(self):
        """The SphereMaterial of spheres and walls."""
        names = ("density", "friction", "rolling_friction", "twisting_friction", "restitution")
        return worlds.SphereMaterial(**{name: getattr(self, name) for name in names})

    def check_world(self, world):
        """Raises SpheresError or SphereWorldError for springs that its load would crush, and for what they have not."""
        if world.name != "soft":
            return
        world.check(self.material())
        overlap, load = self.overlap(world.stiffness)
        if overlap > MOST_OVERLAP:
            raise SpheresError(
                f"stiffness {world.stiffness:g} Pa: spheres {load} would overlap by {100 * overlap:.2g} % of a diameter; "
                f"give {1.05 * overlap / MOST_OVERLAP * world.stiffness:.2g} or more"
            )

    def plain(self):
        """All parameters as JSON holds them."""
        return {"kind": self.KIND, **asdict(self)}


@dataclass(frozen=True)
class SphereScene(Spheres):
    """Spheres that rest in a container, under gravity. ``gravity`` [m/s²], along −z; the other parameters are those of
    :class:`Spheres`.
    """

    gravity: float = 9.81

    def __post_init__(self):
        self._range("gravity")
        super().__post_init__()

    # ---- a kind's own -------------------------------------------------------------------------------
    def inside(self, places, margin):
        """Which of the ``places`` (n, 3) [m] are in the container, ``margin`` [m] away from its walls: bool (n,)."""
        raise NotImplementedError

    def box(self):
        """Corners (low, high) [m] of a box around the container, which may be open to the top: high z is infinite."""
        raise NotImplementedError

    def fall(self):
        """The highest fall [m] that a sphere may come to, by which the step of hard contacts is chosen."""
        raise NotImplementedError

    def depth(self):
        """Depth [m] of what lies in the container."""
        raise NotImplementedError

    def sites(self, radii):
        """Places (n, 3) [m] for spheres of these ``radii``, apart from each other, from the bottom up: a close-packed
        lattice for the largest, each a little aside by the seed. Raises SpheresError where they do not fit.
        """
        spacing = 1.02 * self.diameters()[1]
        low, high = (np.asarray(corner, float) for corner in self.box())
        layer = spacing * math.sqrt(2 / 3)
        margin = 0.51 * spacing
        rng = np.random.default_rng([self.seed, 2])
        found, number, z = [], 0, low[2] + margin
        while number < len(radii) and z < high[2]:
            places = _layer(low, high, spacing, z, (len(found) % 2))
            places = places[self.inside(places, margin)]
            found.append(places)
            number += len(places)
            z += layer
        if number < len(radii):
            raise SpheresError(
                f"{self.sizes_told()}: {len(radii)} spheres do not fit into the container, {number} do; give a smaller filling"
            )
        places = np.concatenate(found)[: len(radii)]
        return places + rng.uniform(-0.005, 0.005, places.shape) * spacing

    # ---- scales of time -----------------------------------------------------------------------------
    def time_step(self, path=PATH_PER_STEP):
        """Step [s] for hard contacts: the speed of a free fall over :meth:`fall` takes a sphere over ``path`` mean
        diameters.
        """
        return path * self.diameter / math.sqrt(2 * self.gravity * self.fall())

    def overlap(self, stiffness):
        """As :meth:`Spheres.overlap`: the weight above a sphere at the bottom, ρ φ g H d² as of a column of its own, over
        its spring E d/2.
        """
        return 0.6 * self.density * self.gravity * self.depth() * 2 / stiffness, "at the bottom"

    def effort(self):
        """As :meth:`Spheres.effort`."""
        return self.count() * self.depth() / self.diameter

    def lasts(self, duration=None):
        """As :meth:`Spheres.lasts`."""
        return (self.DURATION if duration is None else duration) * math.sqrt(self.depth() / self.gravity)

    def check_room(self):
        """As :meth:`Spheres.check_room`."""
        self.sites(self.radii())


def _layer(low, high, spacing, z, odd):
    """Places (n, 3) of a hexagonal layer between the corners; ``odd``: 0 or 1, its shift from the one below."""
    row = spacing * math.sqrt(3) / 2
    ys = np.arange(low[1] + odd * spacing / math.sqrt(3) / 2, high[1], row)
    rows = []
    for k, y in enumerate(ys):
        xs = np.arange(low[0] + 0.5 * spacing * ((k + odd) % 2), high[0], spacing)
        rows.append(np.column_stack((xs, np.full(len(xs), y), np.full(len(xs), z))))
    return np.concatenate(rows) if rows else np.zeros((0, 3))


def world_of(scene, name="hard", path=None, tolerance=None, reach=None, **soft):
    """A world for Spheres. ``name``: "hard" with the step that :meth:`Spheres.time_step` gives for
    ``path``, ``tolerance`` and ``reach`` (None: 0.1, 1e-4 and 0.12); or "soft" with the fields of
    :class:`.sphere_worlds.SoftSpheres` but its diameters.

    Raises SpheresError or SphereWorldError for values that cannot be used, for those of the other world, and for what
    :meth:`Spheres.check_world` refuses.
    """
    given = (("path", path), ("tolerance", tolerance), ("reach", reach))
    rigid = {key: value for key, value in given if value is not None}
    check_choice(name, rigid, soft, _SOFT, "spheres", SpheresError)
    if name == "hard":
        return worlds.HardSpheres(
            time_step=scene.time_step(PATH_PER_STEP if path is None else path),
            tolerance=TOLERANCE if tolerance is None else tolerance,
            **({} if reach is None else {"reach": reach}),
        )
    made = worlds.SoftSpheres(diameter=scene.diameters(), **soft)
    scene.check_world(made)
    return made


def check_run(scene, world, duration=None):
    """Raises SpheresError before anything is computed where the spheres of a scene do not fit into its container, and
    where a course of ``duration`` [T], None: the usual one, has more steps in the ``world`` than anybody waits for.
    """
    scene.check_room()
    step = world.step_for([scene.material()])
    lasts, usual = scene.lasts(duration), scene.lasts()
    long_courses.check(lasts, usual, duration, world, step, scene.time_step(1.0), SpheresError)


def key_of(scene, world, duration):
    """Key of a run: of all that its result depends on but engines and code. ``world``: one of :func:`world_of`."""
    return keys.key_of({"scene": scene.plain(), "world": [world.name, asdict(world)], "duration": duration})
