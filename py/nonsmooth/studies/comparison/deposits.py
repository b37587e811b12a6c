"""Areas of deposits, and of what two of them share."""

from __future__ import annotations

from shapely.geometry import Point
from shapely.ops import unary_union

__all__ = ["common_area", "outline", "overlap"]

CORNERS = 4  # of a quarter of a circle


def outline(x, y, r, closing=None):
    """The mass as a shapely geometry: the union of its disks, with pores closed. ``x``, ``y``, ``r``: arrays of shape
    (n,) [m].

    ``closing``: gaps narrower than twice this length [m] are filled (default: the mean radius).
    """
    a = float(r.mean()) if closing is None else closing
    return unary_union([Point(float(p), float(q)).buffer(float(s) + a, CORNERS) for p, q, s in zip(x, y, r)]).buffer(
        -a, CORNERS
    )


def overlap(one, other):
    """Area that two outlines share, as a part of what either covers: 1 for the same, 0 for none in common. ``one``,
    ``other``: of :func:`outline`.
    """
    whole = one.union(other).area
    return one.intersection(other).area / whole if whole > 0 else 0.0


def common_area(one, other):
    """Area that two outlines share [m²]."""
    return float(one.intersection(other).area)
