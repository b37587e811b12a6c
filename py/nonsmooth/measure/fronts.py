"""How far a mass has come."""

import numpy as np

__all__ = ["front_disk", "front_of", "front"]


def front_of(x, r, side=1.0, share=0.999):
    """Position x [m] that ``share`` of the disks' area has not passed: the front, without a few runaway disks.

    ``x``, ``r``: arrays (N,) [m]; ``side``: 1 for a mass that runs to the right, −1 to the left.
    """
    last = front_disk(x, r, side, share)
    return side * float(side * x[last] + r[last])


def front_disk(x, r, side=1.0, share=0.999):
    """Number of the disk at the front; arguments as of :func:`front_of`."""
    order = np.argsort(side * x, kind="stable")
    area = np.cumsum(r[order] ** 2)
    return int(order[int(np.searchsorted(area, share * area[-1]))])


def front(snapshot, side=1.0, share=0.999, layers=None):
    """:func:`front_of` a snapshot's disks, or those of the layers with these numbers alone."""
    chosen = slice(None) if layers is None else np.isin(snapshot.layer, layers)
    return front_of(snapshot.x[chosen], snapshot.r[chosen], side, share)
