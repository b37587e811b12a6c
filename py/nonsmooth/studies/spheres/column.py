"""A round column of spheres that collapses on a floor (Lube et al. 2004; Lajeunesse et al. 2004).

Spheres rest in a tube without friction, which is taken away at once. The column of radius r₀ and height h₀ = a r₀
spreads to r∞.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...measure import sphere_heaps as measures
from . import columns, walls as shapes
from .grains import SphereScene

__all__ = ["RoundColumn", "filled"]

FILLED, LOOSER = (
    0.55,
    0.75,
)  # packing fraction of spheres that fell, and what a wall takes of it, in diameters over size
THIN = 0.5  # mean diameters of height, at which the mass ends


def filled(size):
    """Packing fraction by which the number of spheres follows from the shape that is asked for; ``size``: radius of the
    container in mean diameters. A run measures what it has.
    """
    return FILLED * (1 - LOOSER / size)


@dataclass(frozen=True)
class RoundColumn(SphereScene):
    """A column before its collapse. ``aspect``: a = h₀/r₀ that is asked for; a run measures its own at rest in the
    tube. ``size``: r₀ in mean diameters. The other parameters are those of :class:`.spheres.grains.SphereScene`.
    """

    aspect: float = 1.0
    size: float = 8.0

    KIND = "column"
    #: Columns of the series besides those of all scenes.
    COLUMNS = columns.COLUMN
    #: Times of the places that are kept, in units of T = √(h₀/g).
    FRAMES = (0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0)
    #: Longest course [T], and whether it ends at rest.
    DURATION, RESTS = 15.0, True

    def _check(self):
        self._number("aspect", "give height over radius of the column, from 0.1 to 20", least=0.1, most=20)
        self._number("size", "give the radius in mean diameters, from 2 to 100", least=2, most=100)

    @property
    def radius(self):
        """Of the tube [m]."""
        return self.size * self.diameter

    def sizes_told(self):
        """The parameters on which the number of spheres depends, with their values, in words."""
        return f"aspect {self.aspect:g}, size {self.size:g}"

    def count(self):
        """Number of spheres, by a packing fraction that is usual for such a container."""
        return max(1, round(filled(self.size) * math.pi * self.radius**2 * self.depth() / self.mean_volume()))

    def depth(self):
        """Depth [m] of what lies in the container."""
        return self.aspect * self.radius

    def inside(self, places, margin):
        """Which of the ``places`` (n, 3) [m] are in the container, ``margin`` [m] away from its walls: bool (n,)."""
        return np.hypot(places[:, 0], places[:, 1]) <= shapes.inner(self.radius) - margin

    def box(self):
        """Corners (low, high) [m] of a box around the container."""
        r = self.radius
        return (-r, -r, 0.0), (r, r, math.inf)

    def fall(self):
        """The highest fall [m], by which the step of hard contacts is chosen."""
        return self.depth()

    def stand(self, walls, top):
        """A tube up to ``top`` [m] on a floor."""
        walls.add(shapes.mantle(self.radius, 0.0, top), "gate", smooth=True)
        reach = 40 * self.radius * (1 + self.aspect)
        walls.box((0, 0, -self.radius), (reach, reach, self.radius))

    def sink(self):
        """Height [m] below which spheres are taken out; None where there is a floor."""
        return None

    def turning(self):
        """Angular velocity [rad/s] of walls about the y axis."""
        return 0.0

    def row(self, places, state):
        """Values of :attr:`COLUMNS` for Places; ``state``: that of the course."""
        mass = measures.connected(places.at, places.r)
        height = measures.profile(places.at, places.r, np.ones(len(places), bool))
        return {
            "edge_m": measures.edge(*height, THIN * self.diameter),
            "edge_connected_m": measures.edge_of_connected(places.at, places.r, mass),
            "farthest_m": float(np.max(np.hypot(places.at[:, 0], places.at[:, 1]) + places.r)),
            "connected_spheres": int(np.count_nonzero(mass)),
        }

    def wall_gaps(self, places):
        """Gaps [m] between spheres and walls that are there after the release, arrays (n,)."""
        return [places.at[:, 2] - places.r]

    def moving(self, places):
        """Which spheres must rest for the course to end, bool (n,)."""
        return measures.connected(places.at, places.r)

    def results(self, series, places, state):
        """Numbers of a run at its end, a dictionary."""
        mass = measures.connected(places.at, places.r)
        distance, height = measures.profile(places.at, places.r, np.ones(len(places), bool))
        angle = measures.repose(distance, height)
        order = np.argsort(np.hypot(places.at[:, 0], places.at[:, 1]))
        share = np.cumsum(places.r[order] ** 3) / np.sum(places.r**3)
        far = np.hypot(*places.at[order].T[:2])
        edge = float(series["edge_m"][-1])
        return {
            "radius_m": self.radius,
            "height_m": state["height"],
            "aspect": state["height"] / self.radius,
            # what has spread so thin that it is nowhere half a diameter high, as without friction, has no edge
            "edge_m": edge or None,
            "runout_rel": edge / self.radius - 1 if edge else None,
            "runout_connected_rel": float(series["edge_connected_m"][-1]) / self.radius - 1,
            "runout_95_rel": float(far[np.searchsorted(share, 0.95)]) / self.radius - 1,
            "runout_99_rel": float(far[np.searchsorted(share, 0.99)]) / self.radius - 1,
            "final_height_m": float(series["height_m"][-1]),
            "final_height_rel": float(series["height_m"][-1]) / self.radius,
            "repose_deg": None if math.isnan(angle) else angle,
            "connected_spheres": int(np.count_nonzero(mass)),
        }
