"""Grains and floor of a heap: what a column and a pile have in common."""

from __future__ import annotations

import hashlib
import math
from dataclasses import asdict, dataclass, replace

import numpy as np

from ...errors import UserError
from ...model.section import Material, units
from ...packing import files as packing_files
from ...system import checks
from ...world import worlds
from ...world.soft.parameters import ROLLING_MODELS

__all__ = ["BASES", "FRACTION", "TOLERANCE", "Heap", "HeapError", "hard"]

BASES = ("smooth", "rough")
FRACTION = 0.82  # of the disks as they are packed, before they settle: loose enough for disks of one size
#: Values, with their units, beyond which areas, masses and times leave the range of what is computed with them.
RANGES = {"diameter": (1e-6, 1e3, "m"), "density": (1e-3, 1e6, "kg/m³"), "gravity": (1e-6, 1e6, "m/s²")}
PATH_PER_STEP = 0.1  # mean diameters, at the speed of a free fall from the top
TOLERANCE = 1e-4  # of the solver's residual, relative


class HeapError(UserError, ValueError):
    """A parameter that cannot be used; one message with key, value and what would do."""


@dataclass(frozen=True)
class Heap:
    """Grains, floor and box of a heap.

    ``disks``: number of disks; boxes of some hundred disks or fewer may miss it by some per cent, and a run says how
    many it has. ``diameter``: mean by number [m]; ``size_spread``: largest over smallest diameter, sizes being uniform
    by volume in between; ``density`` [kg/m³].
    ``friction``, ``rolling_friction`` (in units of ℓ), ``restitution``: of contacts between disks, and with the floor.
    ``base``: "smooth", a line, or "rough", disks of the same sizes glued side by side along it, their tops at y = 0.
    ``base_friction``: of the floor, not above ``friction``; None: the same.
    ``wall_friction``: of sides of the box that stay.
    ``seed``: of sizes and places. ``packing``: text file of ``x y r`` [m] to use instead; then ``disks``, ``diameter``,
    ``size_spread``, the shape of the box and ``seed`` come from the file, except that the seed also draws the sizes of
    a rough base.
    ``gravity`` [m/s²]. ``aspect``: of what is in the box, see the kinds of heaps.
    """

    disks: int = 2000
    diameter: float = 0.01
    size_spread: float = 1.5
    density: float = 2500.0
    friction: float = 0.5
    rolling_friction: float = 0.0
    restitution: float = 0.0
    base: str = "rough"
    base_friction: float | None = None
    wall_friction: float = 0.0
    seed: int = 1
    packing: str | None = None
    gravity: float = 9.81
    aspect: float = 1.0

    #: What it is, in its records, and what its aspect ratio is.
    KIND, ASPECT = "Heap", "height over width of the box"

    def __post_init__(self):
        for key, least in (("disks", 1), ("seed", 0)):
            checks.count(key, getattr(self, key), HeapError, f"give a whole number from {least}", least=least)

        def number(key, remedy, **bounds):
            checks.number(key, getattr(self, key), HeapError, remedy, **bounds)

        for key, (least, most, unit) in RANGES.items():
            number(key, f"give a number from {least:g} to {most:g} {unit}", least=least, most=most)
        for key in ("friction", "rolling_friction"):
            number(key, "give 0 or more", least=0)
            wrong = units.wrong(key, getattr(self, key))
            if wrong:
                raise HeapError(f"{key} {getattr(self, key):g}: {wrong}")
        number("size_spread", "give largest over smallest diameter, from 1 to 8", least=1, most=8)
        number("aspect", f"give {self.ASPECT}, from 0.05 to 100", least=0.05, most=100)
        number("restitution", "give a number from 0 to less than 1", least=0, below=1)
        if self.base not in BASES:
            raise HeapError(f"base {checks.shown(self.base)}: give one of {', '.join(BASES)}")
        number("wall_friction", f"give a number from 0 to friction, {self.friction:g}", least=0, most=self.friction)
        if self.base_friction is not None:
            remedy = f"give a number from 0 to friction, {self.friction:g}: of two materials in contact, the smaller friction holds"
            number("base_friction", remedy, least=0, most=self.friction)
        if self.packing is not None:
            checks.path("packing", self.packing, HeapError, "give the path of a text file of x y r [m], or None")

    # ---- sizes ----------------------------------------------------------------------------------------

    def diameters(self):
        """Smallest and largest diameter [m]."""
        if self.packing:
            r = self.read().r
            return 2 * float(r.min()), 2 * float(r.max())
        s = self.size_spread
        smallest = self.diameter * ((1 - 1 / s) / math.log(s) if s > 1 else 1.0)  # number density ∝ d⁻²
        return smallest, s * smallest

    def mean_diameter(self):
        """Mean diameter by number [m]."""
        return 2 * float(self.read().r.mean()) if self.packing else self.diameter

    def box_aspect(self):
        """Height over width of the box that the disks fill."""
        return self.aspect

    def shape(self):
        """What the disks are packed as, a :class:`~yade.nonsmooth.laboratory.pressing.Shape`."""
        from ..laboratory.pressing import Shape  # needs YADE, which the laws and measures beside this module do without

        smallest, largest = self.diameters()
        return Shape(int(self.disks), int(self.seed), smallest, largest, FRACTION, self.box_aspect(), None)

    def box(self):
        """Width and height [m] of the box that the disks fill, before they settle. Raises SampleError if it is less
        than four disks wide.
        """
        if self.packing:
            p = self.read()
            return float(np.max(p.x + p.r) - np.min(p.x - p.r)), float(np.max(p.y + p.r) - np.min(p.y - p.r))
        return tuple(map(float, self.shape().section().layers[0].points[2]))

    def place(self):
        """x [m] of the left side of the box."""
        raise NotImplementedError

    def gates(self):
        """Sides of the box that are taken away, of "left" and "right"."""
        raise NotImplementedError

    def read(self):
        """The packing of the file. Raises PackingError with file, line and remedy."""
        return packing_files.read_text(self.packing)

    # ---- scales of time -------------------------------------------------------------------------------

    def fall_time(self):
        """T = √(H/g) [s] of the box's height."""
        return math.sqrt(self.box()[1] / self.gravity)

    def time_step(self, path=PATH_PER_STEP):
        """Step [s] for hard contacts: the speed √(2 g H) of a fall from the top takes a disk over ``path`` mean
        diameters.
        """
        return path * self.mean_diameter() / math.sqrt(2 * self.gravity * self.box()[1])

    # ---- materials ------------------------------------------------------------------------------------

    def material(self):
        """The disks' section.Material."""
        return Material(
            "grains",
            friction=self.friction,
            residual_friction=self.friction,
            rolling_friction=self.rolling_friction,
            residual_rolling_friction=self.rolling_friction,
            restitution=self.restitution,
            density=self.density,
            bonded=False,
        )

    def floor_material(self):
        """The floor's section.Material."""
        friction = self.friction if self.base_friction is None else self.base_friction
        return replace(self.material(), name="floor", friction=friction, residual_friction=friction)

    def check_world(self, world):
        """Raises HeapError for grains with what soft contacts of this ``world`` have not, which would be dropped in
        silence: rolling resistance of a model without, and a restitution.
        """
        if world.name != "soft":
            return
        if self.rolling_friction > 0 and world.model not in ROLLING_MODELS:
            raise HeapError(
                f"rolling_friction {self.rolling_friction:g} with model {world.model!r}: contacts of this model do not resist rolling; take model "
                f"{', '.join(ROLLING_MODELS)}, which without bonds, as here, is friction with rolling, or rolling_friction 0"
            )
        if self.restitution > 0:
            raise HeapError(
                f"restitution {self.restitution:g} with world 'soft': springs have none of their own, an impact gives back what damping leaves, "
                f"{world.equivalent(self.material()).restitution:.3g} with damping {world.damping:g}; give restitution 0 and choose the damping"
            )

    def plain(self):
        """All parameters as JSON holds them, and for a packing file its content's checksum in place of its path."""
        return {"kind": self.KIND, **asdict(self), "packing": self.read().checksum if self.packing else None}


def hard(heap, path=PATH_PER_STEP, tolerance=TOLERANCE):
    """The world of rigid disks for a heap: the step of :meth:`Heap.time_step` for ``path``, solved to ``tolerance``."""
    return worlds.Hard(time_step=heap.time_step(path), tolerance=tolerance)


def sizes_along(heap, length, side):
    """Radii [m] of disks side by side that cover ``length`` [m], drawn as the heap's are; the same from the origin on
    for every length.

    ``side``: "left" or "right" of the origin, which differ in their draw.
    """
    smallest, largest = heap.diameters()
    seed = int.from_bytes(hashlib.sha256(f"{heap.seed} {side}".encode()).digest()[:8], "big")
    rng, found, reached = np.random.default_rng(seed), [], 0.0
    while reached < length:
        d = smallest * largest / (largest - rng.random() * (largest - smallest))
        found.append(d / 2)
        reached += d
    return np.array(found)
