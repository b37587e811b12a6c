"""Shear bands in the toe of a slope while it fails, beside those of Rankine's passive wedge (Taboada and Estrada 2009,
section 6.2).

In the toe the largest compression is parallel to the slip surface, between the mass that pushes and the backstop that
holds. Bands of a Mohr-Coulomb material are inclined to it by 45° − φ/2: the one that rises towards the foot carries the
mass over the backstop, the other is its conjugate. They are found as those of a biaxial sample are (:mod:`.bands`),
from how far disks have turned between two snapshots, with the slope's normal for the horizontal.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..records import in_both
from . import bands
from .ground import ground_of

__all__ = ["FEWEST", "REACH", "ToeBand", "conjugate", "find", "rankine", "tells", "toe"]

# thicknesses of the mass at the foot, up the slope from there: where the first band is looked for, which leaves the toe
# near the foot, and where its conjugate, which rises from where the first one meets the slip surface
REACH = (1.6, 3.0)
FEWEST = 500  # disks that tell of bands: their width is five to eight disks


@dataclass(frozen=True)
class ToeBand:
    """``inclination_deg`` to the slope, 0 to 90; ``through``: a point (x, y) [m] of it; ``direction``: unit vector
    along it, towards the surface; ``width`` [d], ``rotation`` [rad], counterclockwise positive, and ``contrast`` as of
    :class:`.bands.Band`."""

    inclination_deg: float
    through: tuple[float, float]
    direction: tuple[float, float]
    width: float
    rotation: float
    contrast: float


def rankine(friction_deg):
    """Inclination [°] of the bands of a passive wedge to the largest compression, by the angle of friction [°]."""
    return 45 - friction_deg / 2


def conjugate(one, other):
    """Whether two bands of the toe (None: not found) are conjugate by the rule for samples: both there, and equally
    steep to :data:`.bands.CONJUGATE` degrees.
    """
    return None not in (one, other) and abs(one.inclination_deg - other.inclination_deg) <= bands.CONJUGATE


def toe(snapshot, section, reach=REACH[1]):
    """Which disks are the toe, (n,) bool, their distances up the slope from the foot and off it [m], (n,) each, and the
    mass's thickness at the foot [m]; ``reach``: how far it goes up the slope, in thicknesses."""
    down, normal = np.array(section.downslope), np.array(section.normal)
    places = np.column_stack((snapshot.x, snapshot.y)) - ground_of(section).foot
    up, off = -places @ down, places @ normal
    size = 2 * float(snapshot.r.mean())
    near = (up > 0) & (up < 10 * size) & (off > 0)
    thickness = float(np.quantile(off[near] + snapshot.r[near], 0.98)) if near.any() else 0.0
    return (up > 0) & (up < reach * thickness) & (off > 0) & (off < 1.1 * thickness), up, off, thickness


def tells(snapshot, section):
    """Whether both stretches of the toe have disks enough that a band which is not found is not there."""
    return all(toe(snapshot, section, reach)[0].sum() >= FEWEST for reach in REACH)


def find(before, after, section):
    """The bands that disks of the toe turned in between two snapshots: (the one that rises towards the foot, its
    conjugate), each a :class:`ToeBand` or None.

    ``before``, ``after``: Snapshots with the same disks; ``section``: a Section. (None, None) where the toe has fewer
    than :data:`FEWEST` disks.
    """
    before, after = in_both(before, after)
    return tuple(_band(before, after, section, reach, sign) for reach, sign in zip(REACH, (-1, 1)))


def _band(before, after, section, reach, sign):
    """One that rises up the slope (``sign`` 1) or down (−1), from the disks within so many thicknesses of the foot."""
    chosen, up, off, _ = toe(before, section, reach)
    if chosen.sum() < FEWEST:
        return None
    # the normal to the right and upslope up: as it is for a slope that falls to the right, mirrored for another
    turned = section.side * (after.angle - before.angle)[chosen]
    x, y = off[chosen], up[chosen]
    # what rises to the left in this frame rises towards the foot; disks turn clockwise there, and the other way round
    # in the conjugate
    band = bands.find(x, y, before.r[chosen], turned)[0 if sign > 0 else 1]
    if band is None or sign * band.angle_deg < 0:
        return None
    return _in_the_slope(band, 0.5 * np.array((x.min() + x.max(), y.min() + y.max())), section)


def _in_the_slope(band, centre, section):
    angle = np.radians(band.angle_deg)
    way = np.array((np.cos(angle), np.sin(angle)))  # (off the slope, up the slope)
    through = centre + band.offset * np.array((-way[1], way[0]))
    normal, down = np.array(section.normal), np.array(section.downslope)
    place = ground_of(section).foot + through[0] * normal - through[1] * down
    direction = way[0] * normal - way[1] * down
    return ToeBand(
        float(90 - abs(band.angle_deg)),
        tuple(map(float, place)),
        tuple(map(float, direction)),
        band.width,
        section.side * band.rotation,
        band.contrast,
    )
