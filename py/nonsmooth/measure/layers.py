"""What became of the order of layers: whether they have mixed (Taboada and Estrada 2009, [21], 5), and where folds have
turned it over ([118], [127]).
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

__all__ = ["mixing", "overturned", "overturned_length"]

NEAR = 0.25  # mean diameters: gap between neighbours, that a disk does not fit through
CELL = 3.0  # mean diameters, of a cell of a column: some nine disks
FEWEST = 4  # disks that tell the layer of a cell
TURNED = 0.5  # layers by which the mean of a cell is below that of the one under it, where order is turned over


def mixing(start, end, mass=None) -> float | None:
    """How far layers have mixed between two Snapshots: 0 for the layers as they lay, 1 where each disk has neighbours
    as if all disks had been dealt out at random.

    It is (s − s₀) / (s₁ − s₀), with s the share of pairs of neighbours (gaps below a quarter of a mean diameter) that
    are of two layers at the ``end``, s₀ that at the ``start``, and s₁ that of disks dealt out at random, 1 − Σ p² for
    layers with the parts p of all disks. A rigid slide has 0. Layers that stay whole and are drawn out have a little,
    as their borders grow; the number of layers' own disks does not matter. ``mass``: numbers of the layers that count,
    all where None. None for one layer, and for layers that were mixed at the start.
    """
    chosen = _chosen(start, mass)
    parts = np.bincount(start.layer[chosen]) / max(1, np.count_nonzero(chosen))
    dealt = 1.0 - float(np.sum(parts**2))
    before, after = (_foreign(one, _chosen(one, mass)) for one in (start, end))
    if before is None or after is None or dealt <= before:
        return None
    return (after - before) / (dealt - before)


def _chosen(snapshot, mass):
    return np.full(len(snapshot.x), True) if mass is None else np.isin(snapshot.layer, mass)


def _foreign(snapshot, chosen):
    """Share of pairs of neighbours that are of two layers; None where nobody has a neighbour."""
    x, y, r, layer = snapshot.x[chosen], snapshot.y[chosen], snapshot.r[chosen], snapshot.layer[chosen]
    if len(r) < 2:
        return None
    gap = NEAR * 2 * float(r.mean())
    i, j = cKDTree(np.column_stack((x, y))).query_pairs(2 * float(r.max()) + gap, output_type="ndarray").T
    near = np.hypot(x[i] - x[j], y[i] - y[j]) <= r[i] + r[j] + gap
    return float(np.mean(layer[i[near]] != layer[j[near]])) if near.any() else None


def overturned(snapshot, mass=None):
    """Where layers lie upside down, in columns of three mean diameters: the columns' centres x [m], rising, and the
    height [m] in each over which the layers' order goes down from one cell to the one above it, (columns,) each. Cells
    are three mean diameters high, and their layer is the mean of their disks, four at least. ``mass``: as of
    :func:`mixing`.
    """
    chosen = _chosen(snapshot, mass)
    x, y, layer = snapshot.x[chosen], snapshot.y[chosen], snapshot.layer[chosen]
    size = CELL * 2 * float(snapshot.r[chosen].mean())
    column, row = (np.floor(v / size).astype(int) for v in (x, y))
    first, low = column.min(), row.min()
    shape = (column.max() - first + 1, row.max() - low + 1)
    number, total = np.zeros(shape), np.zeros(shape)
    np.add.at(number, (column - first, row - low), 1.0)
    np.add.at(total, (column - first, row - low), layer)
    mean = np.divide(total, number, out=np.full(shape, np.nan), where=number >= FEWEST)
    turned = np.diff(mean, axis=1) <= -TURNED  # what is not known is not turned
    return (np.arange(shape[0]) + first + 0.5) * size, size * turned.sum(axis=1)


def overturned_length(snapshot, mass=None) -> float:
    """Length [m] along x over which the order of layers is turned over somewhere, see :func:`overturned`: of the
    overturned limbs of folds. 0 for layers that lie as they were laid down.
    """
    x, height = overturned(snapshot, mass)
    width = float(x[1] - x[0]) if len(x) > 1 else 0.0
    return width * int(np.count_nonzero(height))
