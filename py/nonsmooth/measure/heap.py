"""Front, surface, angle of repose and overlaps of a heap, from the places of its disks alone: the same for hard and for
soft contacts.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

__all__ = ["NEAR", "TOUCH", "connected", "fronts", "gaps", "overlap", "repose", "surface"]

TOUCH = 0.05  # mean diameters; disks with a smaller gap belong together
NEAR = 0.01  # ℓ; pairs with a smaller gap are contacts of which the mean overlap is taken
WINDOW = 2.0  # mean diameters, width over which the surface is averaged


def gaps(x, y, r, margin):
    """Pairs with a gap below ``margin`` [m]: indices i < j, and gaps [m], arrays of one length; x, y, r of shape
    (n,).
    """
    pairs = cKDTree(np.column_stack((x, y))).query_pairs(2 * np.max(r) + margin, output_type="ndarray")
    i, j = pairs.T
    gap = np.hypot(x[i] - x[j], y[i] - y[j]) - r[i] - r[j]
    keep = gap < margin
    i, j, gap = i[keep], j[keep], gap[keep]
    order = np.lexsort((j, i))
    return i[order], j[order], gap[order]


def connected(x, y, r, touch=TOUCH):
    """Which disks belong to the mass, bool (n,): the largest set that hangs together over gaps below ``touch`` mean
    diameters.

    A disk that rolls ahead of the others by itself does not, nor one that is in the air.
    """
    i, j, _ = gaps(x, y, r, touch * 2 * np.mean(r))
    graph = coo_matrix((np.ones(len(i)), (i, j)), shape=(len(x), len(x)))
    label = connected_components(graph, directed=False)[1]
    return label == np.argmax(np.bincount(label))


def fronts(x, r, mass):
    """Leftmost and rightmost edge [m] of the disks of ``mass``, bool (n,)."""
    return float(np.min((x - r)[mass])), float(np.max((x + r)[mass]))


def surface(x, y, r, mass):
    """Height of the mass above y = 0 along x: arrays x, height [m].

    At each x it is the top of the highest disk that covers it, 0 where there is none, averaged over :data:`WINDOW` mean
    diameters.
    """
    x, y, r = x[mass], y[mass], r[mass]
    d = 2 * float(np.mean(r))
    left, right = float(np.min(x - r)), float(np.max(x + r))
    count = max(1, math.ceil((right - left) / (WINDOW * d)))
    fine = 20  # points to a window
    at = left + (np.arange(count * fine) + 0.5) * (right - left) / (count * fine)
    top = np.zeros(len(at))
    for a, b, c in zip(x, y, r):
        near = slice(*np.searchsorted(at, (a - c, a + c)))
        np.maximum(top[near], b + np.sqrt(np.maximum(c * c - (at[near] - a) ** 2, 0)), out=top[near])
    return at.reshape(count, fine).mean(axis=1), top.reshape(count, fine).mean(axis=1)


def repose(x, height):
    """Angles [degrees] of the left and the right flank of a surface; NaN for a flank with fewer than three points.

    Least-squares lines through the points between the foot and the top whose height is 20 to 80 % of the greatest.
    """
    top = int(np.argmax(height))
    found = []
    for side, sign in ((slice(None, top + 1), 1), (slice(top, None), -1)):
        a, h = x[side], height[side]
        part = (h >= 0.2 * height[top]) & (h <= 0.8 * height[top])
        found.append(
            math.degrees(math.atan(sign * np.polyfit(a[part], h[part], 1)[0]))
            if np.count_nonzero(part) > 2
            else math.nan
        )
    return tuple(found)


def overlap(x, y, r, walls, fixed=None):
    """Mean and largest overlap of contacts, in units of ℓ (r₁ + r₂; of a disk and a wall 2 r).

    ``walls``: distances [m] of the disks' centres from each wall, arrays of shape (n,); ``fixed``: x, y, r of disks
    that do not move, whose contacts with the others count. The mean is over contacts, pairs with a gap below
    :data:`NEAR`; those with a gap count as 0.
    """
    n = len(x)
    if fixed is not None:
        x, y, r = (np.concatenate(pair) for pair in zip((x, y, r), fixed))
    i, j, gap = gaps(x, y, r, NEAR * 2 * np.max(r))
    moving = i < n  # i < j, so the second disk is fixed if the first is
    found = [gap[moving] / (r[i] + r[j])[moving]]
    found += [(distance - r[:n]) / (2 * r[:n]) for distance in walls]
    rel = np.concatenate(found)
    rel = np.maximum(-rel[rel < NEAR], 0)
    return (float(rel.mean()), float(rel.max())) if len(rel) else (0.0, 0.0)
