"""Edge, profile, angle of repose and overlaps of heaps of spheres in space, the tilt of what lies in a drum, and the
rate of what leaves a hopper, from places alone: the same for hard and for soft contacts.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from ..errors import UserError

__all__ = [
    "NEAR",
    "TOUCH",
    "SphereMeasureError",
    "beverloo",
    "connected",
    "edge",
    "edge_of_connected",
    "gaps",
    "overlap",
    "profile",
    "rate",
    "repose",
    "tilt",
    "tilt_of_surface",
]

TOUCH = 0.05  # mean diameters; spheres with a smaller gap belong together
NEAR = 0.01  # ℓ; pairs with a smaller gap are contacts of which the mean overlap is taken
SECTORS = 24  # of the edge
RING = 0.5  # mean diameters, width of the rings of a profile
FINE = 3  # places of a profile across a ring
AROUND = 72  # and around
FLANK = (0.2, 0.8)  # of the greatest height, between which a flank is fitted


class SphereMeasureError(UserError, ValueError):
    """Values that a measure cannot be taken of; the message says why."""


def gaps(places, r, margin):
    """Pairs with a gap below ``margin`` [m]: indices i < j, and gaps [m], arrays of one length; ``places`` (n, 3),
    ``r`` (n,) [m].
    """
    pairs = cKDTree(places).query_pairs(2 * float(np.max(r)) + margin, output_type="ndarray")
    i, j = pairs.T
    gap = np.linalg.norm(places[i] - places[j], axis=1) - r[i] - r[j]
    keep = gap < margin
    i, j, gap = i[keep], j[keep], gap[keep]
    order = np.lexsort((j, i))
    return i[order], j[order], gap[order]


def connected(places, r, touch=TOUCH):
    """Which spheres belong to the mass, bool (n,): the largest set that hangs together over gaps below ``touch`` mean
    diameters. One that rolls ahead by itself does not, nor one in the air.
    """
    i, j, _ = gaps(places, r, touch * 2 * float(np.mean(r)))
    graph = coo_matrix((np.ones(len(i)), (i, j)), shape=(len(r), len(r)))
    label = connected_components(graph, directed=False)[1]
    return label == np.argmax(np.bincount(label))


def profile(places, r, mass):
    """Height of the mass above z = 0 by the distance from the z axis: arrays distance, height [m].

    At each of 72 places around and three across a ring of half a mean diameter it is the top of the highest sphere that
    covers the place, 0 where there is none; the mean of these is the ring's height.
    """
    places, r = places[mass], r[mass]
    far = float(np.max(np.hypot(places[:, 0], places[:, 1]) + r))
    width = RING * 2 * float(np.mean(r))
    count = max(1, math.ceil(far / width))
    at = (np.arange(count * FINE) + 0.5) * width / FINE
    turn = (np.arange(AROUND) + 0.5) * 2 * math.pi / AROUND
    x, y = (np.outer(at, f(turn)).ravel() for f in (np.cos, np.sin))
    top = np.zeros(len(x))
    near = cKDTree(np.column_stack((x, y))).query_ball_point(places[:, :2], r)
    for (a, b, c), radius, covered in zip(places, r, near):
        square = radius**2 - (x[covered] - a) ** 2 - (y[covered] - b) ** 2
        top[covered] = np.maximum(top[covered], c + np.sqrt(np.maximum(square, 0)))
    return at.reshape(count, FINE).mean(axis=1), top.reshape(count, FINE * AROUND).mean(axis=1)


def edge(distance, height, least):
    """Radius [m] of the edge of a :func:`profile`: where the height falls below ``least`` [m] for the last time, by a
    line between two rings; 0 where it is nowhere so high.
    """
    high = np.flatnonzero(height >= least)
    if not len(high):
        return 0.0
    k = int(high[-1])
    if k + 1 == len(height):  # the mass ends in this ring
        return float(distance[k] + 0.5 * (distance[1] - distance[0] if k else 2 * distance[0]))
    share = (height[k] - least) / (height[k] - height[k + 1])
    return float(distance[k] + share * (distance[k + 1] - distance[k]))


def edge_of_connected(places, r, mass):
    """Radius [m] of a round mass by its farthest spheres: in each of 24 sectors about the z axis the farthest point
    of a sphere of ``mass``, bool (n,), and the mean of these. A sector without spheres counts 0.
    """
    x, y = places[mass, 0], places[mass, 1]
    sector = np.floor((np.arctan2(y, x) / (2 * math.pi)) % 1.0 * SECTORS).astype(int) % SECTORS
    farthest = np.zeros(SECTORS)
    np.maximum.at(farthest, sector, np.hypot(x, y) + r[mass])
    return float(farthest.mean())


def repose(distance, height):
    """Angle [degrees] of the flank of a :func:`profile`: a least-squares line through the rings whose height is 20 to
    80 % of the greatest; NaN for fewer than three of them.
    """
    least, most = (share * float(np.max(height)) for share in FLANK)
    part = (height >= least) & (height <= most)
    if np.count_nonzero(part) < 3:
        return math.nan
    return math.degrees(math.atan(-np.polyfit(distance[part], height[part], 1)[0]))


def tilt(places, r, axis=1, centre=(0.0, 0.0)):
    """Angle [degrees] by which the centre of mass is turned away from straight below the axis of a drum.

    The axis is horizontal, along coordinate ``axis`` (0 or 1), through ``centre``, (across, z) [m]. The centre of
    mass of what a flat surface cuts off from a cylinder lies on the line at right angles to it, so the angle is that
    of the surface; it is positive where the mass is turned towards larger values across.
    """
    across = places[:, 1 - axis] - centre[0]
    height = places[:, 2] - centre[1]
    weight = r**3
    return math.degrees(math.atan2(float(np.sum(weight * across)), -float(np.sum(weight * height))))


def tilt_of_surface(places, r, radius, axis=1, centre=(0.0, 0.0)):
    """Angle [degrees] of the surface of what lies in a drum of this ``radius`` [m]: a least-squares line through the
    tops of strips one mean diameter wide, over the middle half of the drum's width; NaN for fewer than three strips.
    Other arguments and signs as of :func:`tilt`: a surface that rises towards larger values across is positive.
    """
    width = 2 * float(np.mean(r))
    across = places[:, 1 - axis] - centre[0]
    strips = np.floor(across / width).astype(int)
    found = []
    for strip in np.unique(strips):
        at = (strip + 0.5) * width
        if abs(at) < 0.5 * radius:
            mine = strips == strip
            heights = np.sort(places[mine, 2] + r[mine])
            # of the strip's spheres that are highest along the axis, a sixth of the length of the drum each
            found.append((at, float(np.mean(heights[-3:]))))
    if len(found) < 3:
        return math.nan
    return math.degrees(math.atan(np.polyfit(*np.transpose(found), 1)[0]))


def overlap(places, r, walls=()):
    """Mean and largest overlap of contacts, in units of ℓ (r₁ + r₂; of a sphere and a wall 2 r).

    ``walls``: gaps [m] between each sphere and a wall, arrays of shape (n,). The mean is over contacts, pairs with a
    gap below :data:`NEAR`; those with a gap count as 0.
    """
    i, j, gap = gaps(places, r, NEAR * 2 * float(np.max(r)))
    rel = np.concatenate([gap / (r[i] + r[j]), *(wall / (2 * r) for wall in walls)])
    rel = np.maximum(-rel[rel < NEAR], 0)
    return (float(rel.mean()), float(rel.max())) if len(rel) else (0.0, 0.0)


def rate(time, mass, low=0.2, high=0.6):
    """Rate [kg/s] of what has left, by a least-squares line: ``time`` [s] and ``mass`` [kg] that has left, arrays
    (n,), and the part of the last mass between the shares ``low`` and ``high``. Raises SphereMeasureError for fewer
    than three values in between.
    """
    time, mass = np.asarray(time, float), np.asarray(mass, float)
    part = (mass >= low * mass[-1]) & (mass <= high * mass[-1])
    if np.count_nonzero(part) < 3 or not mass[-1] > 0:
        raise SphereMeasureError(
            f"{np.count_nonzero(part)} rows between {100 * low:g} and {100 * high:g} % of the mass that has left: a rate wants three; let more leave, or write more rows"
        )
    return float(np.polyfit(time[part], mass[part], 1)[0])


def beverloo(opening, diameter, bulk_density, gravity=9.81, factor=0.58, shrink=1.4):
    """Rate [kg/s] through a round opening in a flat bottom by Beverloo's law, C ρ_b √g (D − k d)^(5/2).

    ``opening`` D, ``diameter`` d [m]; ``bulk_density`` ρ_b [kg/m³], that of the packing; ``factor`` C and ``shrink`` k
    are his (0.55 to 0.65 and 1 to 2 are found). 0 for an opening that the law says is closed.
    """
    return factor * bulk_density * math.sqrt(gravity) * max(0.0, opening - shrink * diameter) ** 2.5
