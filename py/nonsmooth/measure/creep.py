"""Creep: how fast something goes on moving, long after it has been loaded."""

from __future__ import annotations

import numpy as np

__all__ = ["BEGIN", "begin", "rate"]

BEGIN = 5.0  # s, by which the start has died away; of shorter records their half


def begin(end):
    """Time [s] from which a record that ends at ``end`` [s] counts."""
    return min(BEGIN, 0.5 * end)


def rate(time, way, end):
    """Slope of the straight line through ``way`` against ``time`` [s] from :func:`begin` of ``end`` on, by least
    squares, in the way's unit a minute; arrays or lists (n,). NaN where fewer than two points are left."""
    t, w = np.asarray(time, float), np.asarray(way, float)
    late = t >= begin(end)
    return 60.0 * float(np.polyfit(t[late], w[late], 1)[0]) if late.sum() > 1 else float("nan")
