"""How far a mass has come."""

import numpy as np

__all__ = ["front_of", "front"]


def front_of(x, r, side=1.0, share=0.999):
    """Position x [m] that ``share`` of the disks' area has not passed: the front, without a few runaway disks.

    ``x``, ``r``: arrays (N,) [m]; ``side``: 1 for a mass that runs to the right, −1 to the left.
    """
    ahead = side * x
    order = np.argsort(ahead, kind="stable")
    area = np.cumsum(r[order] ** 2)
    at = int(np.searchsorted(area, share * area[-1]))
    return side * float(ahead[order][at] + r[order][at])


def front(snapshot, side=1.0, share=0.999, layers=None):
    """:func:`front_of` a snapshot's disks, or those of the layers with these numbers alone."""
    chosen = slice(None) if layers is None else np.isin(snapshot.layer, layers)
    return front_of(snapshot.x[chosen], snapshot.r[chosen], side, share)
