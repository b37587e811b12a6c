"""The parts of a section: plain data that do not change. SI units (m, s, kg, N, Pa; a slice 1 m thick), x to the right,
y up. Needs no YADE.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np
from shapely.geometry import Polygon

from ...slip import laws as slip_laws, parameter_sets
from .. import geometry

__all__ = [
    "Disks",
    "End",
    "Envelope",
    "Interface",
    "Layer",
    "Material",
    "Numerics",
    "Settle",
    "SlipWeakening",
    "Stages",
    "SurfaceLaw",
    "Wall",
    "Water",
    "normal_of",
    "points_of",
]


@dataclass(frozen=True)
class SlipWeakening:
    """Strength of a wall beyond the slip `critical_slip` D_c [m] (paper, section 5.3).

    `law`: "step", "linear" or "exponential"; `friction` and `tensile_strength` [Pa] are what is left in the end.
    """

    law: str
    critical_slip: float
    friction: float = 0.0
    tensile_strength: float = 0.0


@dataclass(frozen=True)
class SurfaceLaw:
    """Law of a wall whose friction is found in cells along it, as disks slide and it heats (paper, section 4.3).

    `law`: names of laws that share a zone, none with `set`, the name of a shipped set of parameters; `parameters`:
    (key, number or tuple of numbers), of the laws, or those of the set that differ; `cell_length` [m] of a cell along
    the wall, 0: eight mean diameters of the disks.
    """

    law: tuple[str, ...] = ()
    set: str | None = None
    parameters: tuple[tuple[str, float | tuple[float, ...]], ...] = ()
    cell_length: float = 0.0

    def make(self) -> slip_laws.SlipLaw:
        """The law. Raises SlipError for names, keys and values that do not fit."""
        if self.set is not None:
            return parameter_sets.law(self.set, **dict(self.parameters))
        return slip_laws.SlipLaw(self.law, **dict(self.parameters))


@dataclass(frozen=True)
class Envelope:
    """Macroscopic peak strength of a material as biaxial tests measured it: `cohesion` [Pa], `friction_deg`
    [degrees].
    """

    cohesion: float
    friction_deg: float


@dataclass(frozen=True)
class Material:
    """Contact parameters (paper, section 2.2 and Table 1): strengths in Pa, lengths in units of ℓ."""

    name: str
    friction: float
    residual_friction: float
    rolling_friction: float
    residual_rolling_friction: float
    tensile_strength: float = 0.0
    residual_tensile_strength: float = 0.0
    bond_ellipse: tuple[float, float] = (0.02, 0.02)
    bond_creation_distance: float = 0.02
    bonds_close: bool = False
    restitution: float = 0.0
    density: float | None = None
    bonded: bool = True
    slip_weakening: SlipWeakening | None = None
    slip_law: SurfaceLaw | None = None
    envelope: Envelope | None = None

    @property
    def critical_slip(self) -> float:
        """D_c [m]; infinite without slip weakening."""
        return self.slip_weakening.critical_slip if self.slip_weakening else math.inf


@dataclass(frozen=True)
class Wall:
    """A polyline with a material; `vertices`: tuple of (x, y) [m], the mass on their left. Joints with other walls are
    bit-identical.

    `role`: "slip", "backstop", "ground" or "obstacle", see :mod:`.roles`.
    """

    name: str
    material: str
    vertices: tuple[tuple[float, float], ...]
    apart: bool = False
    role: str | None = None

    @property
    def points(self) -> np.ndarray:
        """Vertices as an array (n, 2) [m]."""
        return np.array(self.vertices)


@dataclass(frozen=True)
class Layer:
    """A polygon to be filled with disks; `vertices`: tuple of (x, y) [m], not closed.

    `role`: "mass", "bed" (erodible ground, counted apart) or "obstacle"; `disks`: its own, or None for those of the
    section.
    """

    name: str
    material: str
    vertices: tuple[tuple[float, float], ...]
    role: str = "mass"
    disks: Disks | None = None

    @property
    def points(self) -> np.ndarray:
        """Vertices as an array (n, 2) [m]."""
        return np.array(self.vertices)

    @property
    def polygon(self) -> Polygon:
        """The layer as a shapely polygon."""
        return Polygon(self.vertices)

    @property
    def area(self) -> float:
        """Area [m²]."""
        return geometry.area(self.vertices)

    def with_disks(self, factor: float) -> Layer:
        """The same layer with its own disks, where it has some, `factor` times as large."""
        return self if self.disks is None else dataclasses.replace(self, disks=self.disks.scaled(factor))


@dataclass(frozen=True)
class Interface:
    """Contacts of the disks of two layers, whose law is that of a `material`; `between`: names of the layers, the lower
    one first; `role`: "slip" or None; `flat`: disks are packed on their sides of the border, so that those of the two
    layers do not interlock."""

    name: str
    between: tuple[str, str]
    material: str
    role: str | None = None
    flat: bool = True


@dataclass(frozen=True)
class Disks:
    """Diameters `d_min` to `d_max` [m], distribution, packing fraction, and the count asked for (or None)."""

    d_min: float
    d_max: float
    distribution: str
    packing_fraction: float
    count: int | None = None

    def scaled(self, factor: float) -> Disks:
        """The same disks, `factor` times as large."""
        return dataclasses.replace(self, d_min=self.d_min * factor, d_max=self.d_max * factor)

    @property
    def mean_square(self) -> float:
        """Mean of d² [m²] over the disks by number."""
        a, b = self.d_min, self.d_max
        return a * b if self.distribution == "uniform_by_volume" else (a * a + a * b + b * b) / 3

    def diameters(self, quantile) -> np.ndarray:
        """Diameters [m] at `quantile` (array of numbers from 0 to 1) of the distribution by number."""
        q, a, b = np.asarray(quantile, float), self.d_min, self.d_max
        if self.distribution == "uniform_by_volume":  # density ~ d^-2 in two dimensions
            return 1 / (1 / a - q * (1 / a - 1 / b))
        return a + q * (b - a)


@dataclass(frozen=True)
class Release:
    """Release of pore pressure `by` "dilatancy" or "slip_or_dilatancy" (paper, section 5.4; `course.dilatancy`).

    `dilation`: fall of the area share of disks around a disk since failure, by what it was, that releases all of its
    water; `over`: radius of that neighbourhood in mean diameters; `drainage_time` [s], in which water flows back, None:
    never.
    """

    by: str
    dilation: float
    over: float
    drainage_time: float | None = None


@dataclass(frozen=True)
class Water:
    """Water table above a plane (paper, sections 3.4, 5.4).

    `point` (x, y) [m] on the plane; `dip` β [degrees], positive down to the right;
    `pressure_gradient`: "parallel_seepage", "hydrostatic", or ∇p (x, y) [N/m³]; a wet disk bears
    −∇p V; `volume` V "disk" or "bulk"; `table`: points (t, h) [s, m]; `rate` [m/s], the rise after
    the last point; `release_distance`: "critical_slip", that of the slip surface (see
    `Section.release_distance`), or [m]; `wall`: name of the wall the plane was given by, or None; `release`: None
    where slip alone releases.
    """

    unit_weight: float
    point: tuple[float, float]
    dip: float
    pressure_gradient: str | tuple[float, float]
    volume: str
    table: tuple[tuple[float, float], ...]
    rate: float
    release_distance: str | float
    wall: str | None = None
    release: Release | None = None

    @property
    def normal(self) -> tuple[float, float]:
        """Unit vector normal to the plane, upwards."""
        return normal_of(self.dip)

    @property
    def pressure_gradient_xy(self) -> tuple[float, float]:
        """∇p (x, y) [N/m³] itself.

        Parallel seepage: the force −∇p is γ_w cos β along the normal (eq. 18), which is the sum of buoyancy, γ_w up,
        and seepage, γ_w sin β down the plane. Hydrostatic: buoyancy alone.
        """
        if self.pressure_gradient == "hydrostatic":
            return 0.0, -self.unit_weight
        if self.pressure_gradient == "parallel_seepage":
            cos_dip = math.cos(math.radians(self.dip))
            # 0 - x, not -x: no negative zeros
            return tuple(0.0 - self.unit_weight * cos_dip * n for n in self.normal)
        return self.pressure_gradient

    def height(self, t):
        """Height [m] of the table above the plane at the time t [s] (scalar or array) since t0."""
        times, heights = np.array(self.table).T
        t = np.asarray(t, float)
        h = np.interp(t, times, heights) + self.rate * np.maximum(t - times[-1], 0)
        return h if h.ndim else float(h)


@dataclass(frozen=True)
class Settle:
    """Settling: at most `time_max` [s], until the mean speed is below `speed_rest` [m/s].

    Gravity grows to its value during the first `ramp` [s]. `bond`: "before" it grows, or "after" the packing has come
    to rest under it.
    """

    ramp: float
    time_max: float
    speed_rest: float
    bond: str = "before"


@dataclass(frozen=True)
class End:
    """End: at `time` [s] after settling at the latest.

    Or `rest_hold` [s] after the mean speed fell below `rest_fraction` of its maximum.
    """

    time: float
    rest_fraction: float
    rest_hold: float


@dataclass(frozen=True)
class Stages:
    """Course of the experiment; `dry` [s]; `water_hold`: "motion", "never" or a height [m]."""

    settle: Settle
    dry: float
    water_hold: str | float
    end: End

    @property
    def longest(self) -> float:
        """How long after t0 a run ends at the latest [s]."""
        return max(self.end.time - self.dry, 0.0)


@dataclass(frozen=True)
class Numerics:
    """`time_step` [s], at most so long that disks in contact go the `path` against each other in mean diameters (None:
    always as long); relative `tolerance`, and `tolerance_moving` while the slope moves, `max_iterations` a step,
    `verlet_distance` in smallest radii.
    """

    time_step: float
    tolerance: float
    tolerance_moving: float
    max_iterations: int
    verlet_distance: float
    path: float | None = None


def normal_of(dip: float) -> tuple[float, float]:
    """Unit vector normal to a plane that dips by so many degrees, upwards."""
    b = math.radians(dip)
    return math.sin(b), math.cos(b)


def points_of(vertices) -> tuple[tuple[float, float], ...]:
    """Vertices, a list of pairs, as tuples of floats."""
    return tuple((float(x), float(y)) for x, y in vertices)
