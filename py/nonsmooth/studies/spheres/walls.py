"""Walls of round containers as triangles and boxes: plain data, which :mod:`.spheres.scene` puts into a world. Needs no
YADE.
"""

from __future__ import annotations

import math

import numpy as np

__all__ = ["SEGMENTS", "RoundWalls", "annulus", "disc", "inner", "mantle", "room"]

SEGMENTS = 24  # of a round wall


class RoundWalls:
    """What a scene stands on and in: ``facets`` of (three corners (3, 3) [m], smooth, group) and ``boxes`` of (centre,
    half extents [m], smooth, group). ``group``: "wall", "gate" (taken away at the release) or "turning".
    """

    def __init__(self):
        self.facets, self.boxes = [], []

    def add(self, triangles, group="wall", smooth=False):
        """``triangles``: (n, 3, 3) [m]; ``smooth``: without friction."""
        self.facets += [(np.asarray(t, float), smooth, group) for t in triangles]

    def box(self, centre, half, group="wall", smooth=False):
        """A box along the axes."""
        self.boxes.append((tuple(map(float, centre)), tuple(map(float, half)), smooth, group))


def inner(radius):
    """The radius [m] up to which a round wall of this ``radius`` is open: its sides are chords."""
    return radius * math.cos(math.pi / SEGMENTS)


def room(at, radius):
    """Distances [m] of places ``at`` (n, 2) across the axis from the nearest side of a round wall, (n,); negative
    outside.
    """
    turn = 2 * math.pi * (np.arange(SEGMENTS) + 0.5) / SEGMENTS
    return inner(radius) - np.max(at @ np.array([np.cos(turn), np.sin(turn)]), axis=1)


def _ring(radius):
    turn = 2 * math.pi * np.arange(SEGMENTS + 1) / SEGMENTS
    ring = radius * np.column_stack((np.cos(turn), np.sin(turn)))
    ring[-1] = ring[0]  # the same bits, so that the last facet meets the first
    return ring


def mantle(radius, low, high, axis=2):
    """The side of a cylinder about coordinate ``axis`` from ``low`` to ``high`` [m] along it: triangles (n, 3, 3)."""
    ring, found = _ring(radius), []

    def at(k, along):
        point = list(ring[k])
        point.insert(axis, along)
        return point

    for k in range(SEGMENTS):
        a, b, c, d = at(k, low), at(k + 1, low), at(k + 1, high), at(k, high)
        found += [(a, b, c), (a, c, d)]
    return np.array(found)


def annulus(radius_in, radius_out, z=0.0):
    """A flat ring at height ``z`` [m], whose inner and outer corners stand beside each other: triangles (n, 3, 3)."""
    low, high, found = _ring(radius_in), _ring(radius_out), []
    for k in range(SEGMENTS):
        a, b, c, d = ((*p, z) for p in (low[k], high[k], high[k + 1], low[k + 1]))
        found += [(a, b, c), (a, c, d)]
    return np.array(found)


def disc(radius, z=0.0):
    """A flat disc at height ``z`` [m]: triangles (n, 3, 3)."""
    ring = _ring(radius)
    return np.array([((0.0, 0.0, z), (*ring[k], z), (*ring[k + 1], z)) for k in range(SEGMENTS)])
