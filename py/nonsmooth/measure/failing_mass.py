"""Which disks of a slope fail: those that move with the fastest while the others stay."""

from __future__ import annotations

import numpy as np

__all__ = ["MOVED", "failing", "ways"]

FASTEST = 0.99  # quantile of the ways, so that a disk that falls alone counts for little ...
MOVED = 0.2  # ... and the part of it from which on a disk belongs to what fails


def ways(before, after):
    """Way of each disk between two Snapshots of the same disks [m], (n,)."""
    return np.hypot(after.x - before.x, after.y - before.y)


def failing(way):
    """Whether each disk belongs to the failing mass, bool (n,), from their ways (n,) [m]; none where nothing moved."""
    way = np.asarray(way, float)
    most = np.quantile(way, FASTEST) if len(way) else 0.0
    return way >= MOVED * most if most > 0 else np.zeros(len(way), bool)
