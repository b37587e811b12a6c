"""A hopper with a flat bottom and a round opening: spheres rest in a cylinder, the opening's lid is taken away, and
what leaves is counted and taken out below.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...measure import sphere_heaps as measures
from . import columns, walls as shapes
from .column import RoundColumn
from .grains import SpheresError

__all__ = ["RoundHopper"]

STILL = 8.0  # √(D/g), without a sphere that leaves, after which it is over
ROOM = 0.7  # of the height of the filling, in which its packing fraction is measured


@dataclass(frozen=True)
class RoundHopper(RoundColumn):
    """A hopper before it is opened. ``opening``: diameter D of the opening in mean diameters; ``size``: radius of the
    cylinder in mean diameters; ``aspect``: height of the filling over the radius.
    """

    aspect: float = 2.0
    opening: float = 6.0

    KIND = "hopper"
    COLUMNS = columns.HOPPER
    FRAMES = (0.0, 1.0, 3.0, 6.0, 10.0, 15.0, 25.0)
    DURATION, RESTS = 200.0, False

    def _check(self):
        super()._check()
        remedy = f"give the opening's diameter in mean diameters, from 1 to 1.8 size, {1.8 * self.size:g}"
        self._number("opening", remedy, least=1, most=1.8 * self.size)
        if self.opening <= 1.4:
            raise SpheresError(
                f"opening {self.opening:g}: Beverloo's law, beside which a rate is set, has no flow up to 1.4 diameters; give more"
            )

    def sizes_told(self):
        """The parameters on which the number of spheres depends, with their values, in words."""
        return f"aspect {self.aspect:g}, size {self.size:g}"

    def fall(self):
        """The highest fall [m], by which the step of hard contacts is chosen."""
        return (self.opening + 2) * self.diameter

    def hole(self):
        """Radius [m] of the corners of the opening, a polygon with the area of the circle."""
        n = shapes.SEGMENTS
        return 0.5 * self.opening * self.diameter * math.sqrt(2 * math.pi / (n * math.sin(2 * math.pi / n)))

    def stand(self, walls, top):
        """A cylinder up to ``top`` [m] on a bottom with a lid."""
        walls.add(shapes.mantle(self.radius, 0.0, top))
        walls.add(shapes.annulus(self.hole(), self.radius))
        walls.add(shapes.disc(self.hole()), "gate")

    def sink(self):
        """Height [m] below which spheres are taken out."""
        return -2 * self.diameters()[1]

    def row(self, places, state):
        """Values of its own columns for Places; ``state``: that of the course."""
        below = places.at[:, 2] < 0
        mass = self.density * 4 / 3 * math.pi * float(np.sum(places.r[below] ** 3))
        return {
            "discharged_spheres": state["out"] + int(np.count_nonzero(below)),
            "discharged_kg": state["out_kg"] + mass,
        }

    def wall_gaps(self, places):
        """Gaps [m] between spheres and walls that are there after the release, arrays (n,)."""
        on_bottom = np.hypot(*places.at.T[:2]) > self.hole()
        inside = places.at[:, 2] > 0
        return [
            np.where(on_bottom & inside, places.at[:, 2] - places.r, math.inf),
            np.where(inside, shapes.room(places.at[:, :2], self.radius) - places.r, math.inf),
        ]

    def moving(self, places):
        """Which spheres must rest for the course to end, bool (n,)."""
        return np.ones(len(places), bool)

    def over(self, rows):
        """Whether nothing more will leave; ``rows``: [(time [s], spheres that have left)]."""
        still = STILL * math.sqrt(self.opening * self.diameter / self.gravity)
        last = next((time for time, number in rows if number == rows[-1][1]), 0.0)
        return rows[-1][0] - last > still

    def bulk_density(self, places):
        """ρ_b [kg/m³] of spheres at rest in the cylinder: their mass up to 0.7 of their height, by the volume there."""
        height = ROOM * float(np.sort(places.at[:, 2])[-max(1, len(places) // 50) :].mean())
        # a sphere that the plane cuts counts with the part below
        part = np.clip((height - places.at[:, 2] + places.r) / (2 * places.r), 0, 1)
        volume = 4 / 3 * math.pi * float(np.sum(places.r**3 * part**2 * (3 - 2 * part)))
        room = 0.5 * shapes.SEGMENTS * math.sin(2 * math.pi / shapes.SEGMENTS) * self.radius**2 * height
        return self.density * volume / room

    def results(self, series, places, state):
        """Numbers of a run at its end, a dictionary."""
        found = {
            "opening_m": self.opening * self.diameter,
            "radius_m": self.radius,
            "height_m": state["height"],
            "bulk_density_kg_per_m3": state["bulk_density"],
            "packing_fraction": state["bulk_density"] / self.density,
            "discharged_spheres": int(series["discharged_spheres"][-1]),
            "discharged_share": float(series["discharged_spheres"][-1]) / state["spheres"],
        }
        law = measures.beverloo(self.opening * self.diameter, self.diameter, state["bulk_density"], self.gravity)
        try:
            rate = measures.rate(series["time_s"], series["discharged_kg"])
        except measures.SphereMeasureError:
            rate = None  # an arch over the opening holds it, or it was stopped early
        unit = state["bulk_density"] * math.sqrt(self.gravity) * self.diameter**2.5
        return found | {
            "rate_kg_per_s": rate,
            "rate_rel": None if rate is None else rate / unit,
            "beverloo_kg_per_s": law,
            "beverloo_rel": law / unit,
            "by_beverloo": None if rate is None or not law > 0 else rate / law,
        }
