"""Slip surfaces one above another, as two weak interfaces in one slope. Needs no YADE.

Each of them bears the weight of all that lies above it, so a sum over them would count this weight once for each. What
may be added are surfaces side by side: pieces of one surface, or of two slopes. So the columns ``dp_…`` are sums over
the *lowest* slip surfaces, those with no other below, which bear the mass between them; and where a slope has others
above, each has columns of its own (:func:`.records.columns.column`).
"""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon
from shapely.ops import unary_union

__all__ = ["levels", "part_beside"]

OVERLAP = 0.1  # of the shorter one's way along x: surfaces that share less lie side by side
SAMPLES = 65  # places at which the heights of two surfaces are compared
# of a layer's area: a smaller part that hangs over the end of a surface, as ends across the slope do, counts with the
# rest
SHARE = 0.1


def levels(lines):
    """How many of the polylines, each (n, 2) [m], lie below each one, one above another: 0 for those with none below. A
    list.

    One lies above another where they share a tenth, or more, of the way along x of the shorter one, and it is higher
    there on average. Without a way along x, as a vertical one, a line lies beside all others.
    """
    below = [[j for j, other in enumerate(lines) if j != i and _above(line, other)] for i, line in enumerate(lines)]
    found = [0] * len(lines)
    for _ in lines:  # as many rounds as a chain is long at most
        found = [max((found[j] + 1 for j in under), default=0) for under in below]
    return [min(k, len(lines) - 1) for k in found]


def _above(line, other):
    (a, b), (c, d) = ((points[:, 0].min(), points[:, 0].max()) for points in (line, other))
    low, high = max(a, c), min(b, d)
    if high - low <= OVERLAP * min(b - a, d - c):
        return False
    x = np.linspace(low, high, SAMPLES)
    return float(np.mean(_height(line, x) - _height(other, x))) > 0


def _height(line, x):
    order = np.argsort(line[:, 0], kind="stable")
    return np.interp(x, line[order, 0], line[order, 1])


def part_beside(polygons, lines, above=True):
    """The part of each polygon's area that lies above, or else below, one of the polylines, each (n, 2) [m]: an array
    (polygons,), with small rests of either as 0 and 1.
    """
    bounds = np.array([polygon.bounds for polygon in polygons])
    far = bounds[:, 3].max() + 1.0 if above else bounds[:, 1].min() - 1.0
    pieces = [
        Polygon([a, b, (b[0], far), (a[0], far)])
        for line in lines
        for a, b in zip(line.tolist(), line[1:].tolist())
        if a[0] != b[0]
    ]
    region = unary_union([piece.buffer(0) for piece in pieces])
    share = np.array([polygon.intersection(region).area / polygon.area for polygon in polygons])
    return np.where(share < SHARE, 0.0, np.where(share > 1 - SHARE, 1.0, share))
