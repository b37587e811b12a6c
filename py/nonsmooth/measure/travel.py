"""How far a mass has come beside how deep it has fallen: the travel angle, or fahrböschung (Heim 1932; Taboada and
Estrada 2009, [21], [22]).
"""

from __future__ import annotations

import math

import numpy as np

from .fronts import front_disk

__all__ = ["NAMES", "travel"]

NAMES = ("travel_drop_m", "travel_run_m", "travel_angle_deg", "centroid_drop_m", "centroid_run_m", "centroid_angle_deg")


def travel(start, end, density, side=1.0, mass=None) -> dict[str, float | None]:
    """The numbers of :data:`NAMES`: drop and run [m] between the extreme points along the profile, from the highest
    point of the mass as it stood to the foot of its front as it came to rest, with the angle of the line through both,
    arctan(drop / run) [degrees]; and the same of the centre of mass. An angle is None where there is no run down the
    slope.

    ``start``, ``end``: Snapshots; ``density``: that of each layer [kg/m³], (layers,); ``side``: 1 for a slope that
    falls to the right, −1 to the left; ``mass``: numbers of the layers that are the mass, all where None. The front is
    that of :func:`.fronts.front_of`, without a few runaway disks.
    """
    x, y, r, weight = _mass(start, density, mass)
    x1, y1, r1, weight1 = _mass(end, density, mass)
    crown, last = int(np.argmax(y + r)), front_disk(x1, r1, side)

    def mean(values, weights):
        return float(np.average(values, weights=weights))

    extreme = _line(y[crown] + r[crown] - (y1[last] - r1[last]), side * (x1[last] - x[crown]) + r1[last])
    centre = _line(mean(y, weight) - mean(y1, weight1), side * (mean(x1, weight1) - mean(x, weight)))
    return dict(zip(NAMES, (*extreme, *centre), strict=True))


def _mass(snapshot, density, mass):
    """Places, radii and masses of the disks that are of the mass."""
    chosen = slice(None) if mass is None else np.isin(snapshot.layer, mass)
    weight = np.asarray(density, float)[snapshot.layer[chosen]] * snapshot.r[chosen] ** 2
    return snapshot.x[chosen], snapshot.y[chosen], snapshot.r[chosen], weight


def _line(drop, run):
    return float(drop), float(run), math.degrees(math.atan2(drop, run)) if run > 0 else None
