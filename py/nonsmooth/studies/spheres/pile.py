"""A pile on a round plate with a low rim: spheres rest in a tube on it, the tube is taken away, what is too much
falls over the edge, and a cone stays at its angle of repose.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...measure import sphere_heaps as measures
from . import columns, walls as shapes
from .column import RoundColumn

__all__ = ["PlatePile"]

RIM = 0.5  # mean diameters, height of the plate's rim: it holds the lowest grains, which would roll away


@dataclass(frozen=True)
class PlatePile(RoundColumn):
    """A pile before its tube is taken away. ``aspect``: height over radius in the tube, so high that the flanks meet;
    ``size``: radius of plate and tube in mean diameters.
    """

    aspect: float = 0.9

    KIND = "pile"
    COLUMNS = columns.PILE

    def stand(self, walls, top):
        """A tube up to ``top`` [m] on the rim of a plate."""
        rim = RIM * self.diameter
        walls.add(shapes.mantle(self.radius, rim, top), "gate", smooth=True)
        walls.add(shapes.mantle(self.radius, 0.0, rim))
        walls.add(shapes.disc(self.radius))

    def sink(self):
        """Height [m] below which spheres are taken out."""
        return -2 * self.diameters()[1]

    def _on_it(self, places):
        return measures.connected(places.at, places.r) & (places.at[:, 2] > 0)

    def row(self, places, state):
        """Values of its own columns for Places; ``state``: that of the course."""
        distance, height = measures.profile(places.at, places.r, self._on_it(places))
        inner = distance < self.radius - self.diameter  # without the rim, where the heap ends as a wall
        angle = measures.repose(distance[inner], height[inner])
        return {"repose_deg": 0.0 if math.isnan(angle) else angle, "lost_spheres": state["out"]}

    def wall_gaps(self, places):
        """Gaps [m] between spheres and walls that are there after the release, arrays (n,)."""
        above = (shapes.room(places.at[:, :2], self.radius) > 0) & (places.at[:, 2] > 0)
        return [np.where(above, places.at[:, 2] - places.r, math.inf)]

    def moving(self, places):
        """Which spheres must rest for the course to end, bool (n,)."""
        return self._on_it(places)

    def results(self, series, places, state):
        """Numbers of a run at its end, a dictionary."""
        return {
            "radius_m": self.radius,
            "height_m": state["height"],
            "final_height_rel": float(series["height_m"][-1]) / self.radius,
            "repose_deg": float(series["repose_deg"][-1]) or None,
            "lost_spheres": state["out"],
        }
