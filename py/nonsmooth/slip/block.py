"""A block that slides on one cell of a slip surface: at a given speed, or down a slope by its weight.

A step of length h, as a scene makes it: the law's strength τ is that of the state and speed before;
v⁺ = max(0, v + h (τ_d − τ)/m) with the driving stress τ_d and the mass m over an area; the slip is h (v + v⁺)/2 and its
heat τ times that.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..records.columns import STEP, Column, declared
from ..system import checks
from .laws import SlipError

__all__ = ["COLUMNS", "STEP", "Driven", "OnSlope", "Until", "slide"]

COLUMNS = declared(
    Column("time_s", "s", "time since slip began"),
    Column("slip_m", "m", "distance that the block has slid"),
    Column("speed_m_per_s", "m/s", "of the block, at the end of the step"),
    Column("normal_stress_Pa", "Pa", "that presses the block on the surface"),
    Column("strength_Pa", "Pa", "shear strength of the step"),
    Column("heat_J_per_m2", "J/m²", "made by sliding so far"),
    Column("temperature_degC", "°C", "mean of the zone", optional=True),
    Column("hottest_degC", "°C", "highest in the zone; in a layer of melt that of its middle", optional=True),
    Column("pressure_Pa", "Pa", "mean excess pore pressure of the zone", optional=True),
    Column("vapour", "1", "1 from where the water of the zone boils on", optional=True),
    Column("reacted", "1", "mean share of the zone that has reacted", optional=True),
    Column("melt_m", "m", "thickness of the layer of melt", optional=True),
)


@dataclass(frozen=True)
class Driven:
    """A block that something drives at a constant ``speed`` [m/s] under ``normal_stress`` [Pa]. Raises SlipError for
    what is not positive.
    """

    speed: float
    normal_stress: float

    def __post_init__(self):
        for name in ("speed", "normal_stress"):
            checks.number(name, getattr(self, name), SlipError, "give a number above 0", above=0)


@dataclass(frozen=True)
class OnSlope:
    """A layer of the ``depth`` [m] (normal to the slope) and ``density`` [kg/m³] on a slope of ``dip`` [°], with
    ``speed`` [m/s] to begin with, under ``gravity`` [m/s²]. Raises SlipError for what makes no sense.
    """

    dip: float
    depth: float
    density: float
    speed: float = 0.0
    gravity: float = 9.81

    def __post_init__(self):
        checks.number("dip", self.dip, SlipError, "give degrees from 0 to less than 90", least=0, below=90)
        for name in ("depth", "density", "gravity"):
            checks.number(name, getattr(self, name), SlipError, "give a number above 0", above=0)
        checks.number("speed", self.speed, SlipError, "give 0 or a number above", least=0)

    @property
    def mass(self):
        """Over an area [kg/m²]."""
        return self.density * self.depth

    @property
    def normal_stress(self):
        """σ [Pa]."""
        return self.mass * self.gravity * math.cos(math.radians(self.dip))

    @property
    def driving_stress(self):
        """τ_d [Pa]."""
        return self.mass * self.gravity * math.sin(math.radians(self.dip))


@dataclass(frozen=True)
class Until:
    """When a block is left: after ``time`` [s], ``slip`` [m], or where strength has fallen to a ``share`` of its first,
    whichever comes first; also where it stops. Raises SlipError for what is not positive.
    """

    time: float = 60.0
    slip: float = math.inf
    share: float = 0.0

    def __post_init__(self):
        checks.number("time", self.time, SlipError, "give seconds above 0", above=0)
        if self.slip != math.inf:
            checks.number("slip", self.slip, SlipError, "give metres above 0", above=0)
        checks.number("share", self.share, SlipError, "give a share from 0 to below 1", least=0, below=1)


def slide(law, drive, step, until=Until()):
    """A block on a cell of ``law`` (:class:`.laws.SlipLaw`) until it is left: {column: array} of :data:`COLUMNS`, a
    row a step, of which those are there that the law has.

    ``drive``: :class:`Driven` or :class:`OnSlope`; ``step``: h [s]. A block that its first strength holds has one
    row, in which it has not moved. Raises SlipError for a step that is not positive, or more than ten million of them.
    """
    checks.number("step", step, SlipError, "give seconds above 0", above=0)
    if until.time / step > 1e7:
        raise SlipError(
            f"step {step:g}: {until.time / step:.0g} steps to {until.time:g} s; give longer steps or less time"
        )
    law.prepare(step)
    cells = law.cells(1, drive.normal_stress)
    own, sees = cells.columns, _Seen(law)
    speed = drive.speed
    gains = 0.0 if isinstance(drive, Driven) else step / drive.mass
    push = 0.0 if isinstance(drive, Driven) else drive.driving_stress
    cells.slip_rate[0] = speed
    heat, first, rows = 0.0, None, []
    for number in range(1, round(until.time / step) + 1):
        strength = float(law.strength(cells)[0])
        first = strength if first is None else first
        after = max(0.0, speed + gains * (push - strength))
        path = 0.5 * (speed + after) * step
        cells.path[0], cells.heat[0], cells.slip_rate[0] = path, strength * path, after
        law.advance(cells)
        heat += strength * path
        speed = after
        slip = float(cells.slip[0])
        rows.append((number * step, slip, speed, drive.normal_stress, strength, heat, *sees(law, own, speed)))
        if speed == 0 or slip >= until.slip or strength < until.share * first:
            break
    names = [*list(COLUMNS)[:6], *sees.names]
    return dict(zip(names, np.array(rows).T))


class _Seen:
    """What of a law's columns goes into a row."""

    def __init__(self, law):
        probe = law.cells().columns
        self.melts = "melt_thickness" in probe
        self.names = [
            *(("temperature_degC", "hottest_degC") if "temperature" in probe else ()),
            *(("pressure_Pa", "vapour") if "pressure" in probe else ()),
            *(("reacted",) if "reacted" in probe else ()),
            *(("melt_m",) if self.melts else ()),
        ]

    def __call__(self, law, own, speed):
        row = []
        if "temperature_degC" in self.names:
            molten = self.melts and own["melt_thickness"][0] > 0
            row += [law.zone_mean(own["temperature"])[0], own["temperature"][0].max()]
            if molten:
                row[-1] = law.melt_hottest(speed)
        if "pressure_Pa" in self.names:
            row += [law.zone_mean(own["pressure"])[0], own["vapour"][0]]
        if "reacted" in self.names:
            row.append(law.zone_mean(own["reacted"])[0])
        if self.melts:
            row.append(own["melt_thickness"][0])
        return row
