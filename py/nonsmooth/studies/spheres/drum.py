"""A drum that turns slowly about a horizontal axis, partly filled with spheres: the angle of their surface."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...measure import sphere_heaps as measures
from . import columns, walls as shapes
from .column import filled
from .grains import SphereScene

__all__ = ["TurningDrum"]


@dataclass(frozen=True)
class TurningDrum(SphereScene):
    """A drum about the y axis. ``size``: its radius R and ``length``: its length, in mean diameters; ``filling``:
    share of its volume that the packing takes; ``froude``: ω² R/g; ``turns``: how far it turns, of which the second
    half counts. The ends have no friction.
    """

    size: float = 10.0
    length: float = 6.0
    filling: float = 0.35
    froude: float = 0.01
    turns: float = 0.5

    KIND = "drum"
    COLUMNS = columns.DRUM
    FRAMES = (0.0, 5.0, 10.0, 15.0, 20.0)
    RESTS = False

    def _check(self):
        self._number("size", "give the drum's radius in mean diameters, from 3 to 100", least=3, most=100)
        self._number("length", "give the drum's length in mean diameters, from 2 to 200", least=2, most=200)
        self._number("filling", "give the share of the drum that is filled, from 0.05 to 0.5", least=0.05, most=0.5)
        self._number("froude", "give the Froude number, above 0 and below 1", above=0, below=1)
        self._number("turns", "give how often it turns, from 0.05 to 100", least=0.05, most=100)

    @property
    def radius(self):
        """Of the drum [m]."""
        return self.size * self.diameter

    @property
    def half(self):
        """Half of its length [m]."""
        return 0.5 * self.length * self.diameter

    @property
    def DURATION(self):  # noqa: N802 (a constant of the other kinds)
        """Time of all turns, in units of T = √(R/g)."""
        return 2 * math.pi * self.turns / math.sqrt(self.froude)

    def sizes_told(self):
        """The parameters on which the number of spheres depends, with their values, in words."""
        return f"size {self.size:g}, length {self.length:g}, filling {self.filling:g}"

    def count(self):
        """Number of spheres, by a packing fraction that is usual for such a container."""
        volume = self.filling * math.pi * self.radius**2 * 2 * self.half
        return max(1, round(filled(self.size) * volume / self.mean_volume()))

    def depth(self):
        """Depth [m] of what lies in the container."""
        return self.radius

    def inside(self, places, margin):
        """Which of the ``places`` (n, 3) [m] are in the container, ``margin`` [m] away from its walls: bool (n,)."""
        across = np.hypot(places[:, 0], places[:, 2])
        return (across <= shapes.inner(self.radius) - margin) & (np.abs(places[:, 1]) <= self.half - margin)

    def box(self):
        """Corners (low, high) [m] of a box around the container."""
        r = self.radius
        return (-r, -self.half, -r), (r, self.half, r)

    def fall(self):
        """The highest fall [m], by which the step of hard contacts is chosen."""
        return 0.5 * self.radius

    def stand(self, walls, top):
        """The drum and its ends."""
        walls.add(shapes.mantle(self.radius, -self.half, self.half, axis=1), "turning")
        r = 1.5 * self.radius
        for side in (-1, 1):
            walls.box((0, side * (self.half + 0.5 * r), 0), (r, 0.5 * r, r), smooth=True)

    def sink(self):
        """None: nothing is taken out."""
        return None

    def turning(self):
        """ω [rad/s] about the y axis."""
        return math.sqrt(self.froude * self.gravity / self.radius)

    def row(self, places, state):
        """Values of :attr:`COLUMNS` for Places."""
        # a turn about y takes what is at the bottom towards smaller x, where the surface then is high
        line = -measures.tilt_of_surface(places.at, places.r, self.radius)
        return {
            "turned_deg": math.degrees(self.turning() * places.time_s),
            "tilt_deg": -measures.tilt(places.at, places.r),
            "tilt_surface_deg": 0.0 if math.isnan(line) else line,
        }

    def wall_gaps(self, places):
        """Gaps [m] between spheres and the ends, arrays (n,)."""
        return [self.half - np.abs(places.at[:, 1]) - places.r]  # the sides turn

    def moving(self, places):
        """All spheres."""
        return np.ones(len(places), bool)

    def results(self, series, places, state):
        """Numbers of a run at its end: means over the second half of what it has turned."""
        late = series["turned_deg"] >= 0.5 * series["turned_deg"][-1]

        def of(name):
            values = series[name][late]
            return float(values.mean()), float(values.std())

        (tilt, swing), (surface, surface_swing) = of("tilt_deg"), of("tilt_surface_deg")
        return {
            "radius_m": self.radius,
            "angular_velocity_rad_per_s": self.turning(),
            "turned_deg": float(series["turned_deg"][-1]),
            "tilt_deg": tilt,
            "tilt_swing_deg": swing,
            "tilt_surface_deg": surface,
            "tilt_surface_swing_deg": surface_swing,
        }
