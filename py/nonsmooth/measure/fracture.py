"""Where a sample has come apart: place, inclination and thickness of the break, from the bonds that broke.

The pieces of a sample are what its bonds still hold together. The bonds that broke between two pieces are the break;
those that broke within a piece are scattered damage, and left out.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

__all__ = ["Fracture", "find"]


@dataclass(frozen=True)
class Fracture:
    """``x``, ``y`` [m]: middle of the break; ``angle_deg`` of its mean line to the horizontal, above −90 and up to 90,
    positive where it rises to the right; ``thickness`` [d]: of a band that scatters about this line as the broken bonds
    do, with d the root of the mean square of the diameters; ``bonds``: how many broke in it; ``share``: of all that
    broke; ``through``: whether it parts the disk with the lowest centre from that with the highest.
    """

    x: float
    y: float
    angle_deg: float
    thickness: float
    bonds: int
    share: float
    through: bool


def find(x, y, r, alive, broken):
    """The Fracture of a sample, None where fewer than two bonds broke.

    ``x``, ``y``, ``r`` [m]: disks before the test, (n,); ``alive``, ``broken``: pairs of disks whose bonds hold, and
    whose bonds broke, (m, 2). Where the sample is still in one piece all broken bonds count. Bonds count by their mean
    diameters, as they bear.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    x, y, r = (np.asarray(v, float) for v in (x, y, r))
    alive, broken = (np.asarray(pairs, int).reshape(-1, 2) for pairs in (alive, broken))
    if len(broken) < 2:
        return None
    graph = coo_array((np.ones(len(alive)), (alive[:, 0], alive[:, 1])), shape=(len(x), len(x)))
    piece = connected_components(graph, directed=False)[1]
    apart = piece[broken[:, 0]] != piece[broken[:, 1]]
    chosen = broken[apart] if apart.sum() > 1 else broken
    a, b = chosen[:, 0], chosen[:, 1]
    weight = r[a] + r[b]
    # the point between two disks that is as near to both
    share = (r[a] / weight)[:, None]
    places = np.column_stack((x[a], y[a])) * (1 - share) + np.column_stack((x[b], y[b])) * share
    middle = np.average(places, axis=0, weights=weight)
    away = places - middle
    values, ways = np.linalg.eigh((away * weight[:, None]).T @ away / weight.sum())
    along = ways[:, 1]
    angle = math.degrees(math.atan2(along[1], along[0]))
    angle = angle - 180 if angle > 90 else angle + 180 if angle <= -90 else angle
    d = math.sqrt(np.mean((2 * r) ** 2))
    return Fracture(
        float(middle[0]),
        float(middle[1]),
        angle,
        math.sqrt(12 * max(0.0, values[0])) / d,
        len(chosen),
        len(chosen) / len(broken),
        bool(piece[np.argmin(y)] != piece[np.argmax(y)]),
    )
