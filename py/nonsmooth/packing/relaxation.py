"""Disks freed of overlaps, by the library ``pkg/packing``: the harmonic overlap energy is minimised (FIRE; Bitzek et
al. 2006). That alone jams near a fraction of 0.84, so disks of nearly the same size, one squeezed and one less so,
change places on the way: the sizes stay, and the energy falls.

The library takes as many threads as OpenMP has, those of YADE (-j) or of OMP_NUM_THREADS, and one for each 20,000
disks at most; the bits do not depend on it. Lengths in m. Needs no YADE, but this project's module ``_nonsmooth_packing``.
"""

from __future__ import annotations

import math

import numpy as np

from ..system import installation

__all__ = ["close_pairs", "disks", "pushes", "relax"]

SWEEPS = 40_000  # most FIRE steps
SWAP_EVERY = 20


def _library():
    return installation.module("_nonsmooth_packing")


def _edges(table):
    return table.start, table.direction, table.length, table.convex_start, table.convex_end


def close_pairs(x, y, r, margin):
    """Pairs of disks (arrays i, j with i < j) with a gap below `margin`, sorted."""
    return _library().close_pairs(x, y, r, margin)


def pushes(x, y, r, margin, table):
    """Disks near edges (a :class:`.geometry.Edges`), with a gap below `margin` or a little beyond the edge, as arrays
    by pair: disk, edge, overlap (0 where there is none), and the direction into the region, x and y.
    """
    return _library().pushes(x, y, r, margin, _edges(table))


def disks(x, y, r, layer, borders, threads=0):
    """The disks as the library moves them. `borders`: pairs of a table of edges and of the disks that it acts on (bool
    by disk, None: all). `threads`: 0 for OpenMP's.
    """
    order = np.lexsort((r, layer))
    tables = [(_edges(table), acts) for table, acts in borders]
    return _library().Relaxation(x, y, r, layer, order, tables, threads)


def relax(disks, target, rng, progress=None):
    """Move the disks until no overlap, relative to the mean diameter, exceeds the target, or the sweeps are used up."""
    shown, n = 0.0, len(disks)
    for sweep in range(SWEEPS):
        swaps = sweep % SWAP_EVERY == SWAP_EVERY - 1
        worst = disks.forces(swaps)
        if progress and sweep % 100 == 0:
            shown = max(shown, min(0.99, math.log(2 / max(worst, target)) / math.log(2 / target)))
            progress(shown)
        if worst < target:
            return
        if swaps:
            # Growth squeezes the small one in turn; asking for more gain than its growth packs far more slowly.
            stride = int(rng.integers(1, max(2, n // 50)))
            disks.exchange(int(rng.integers(0, 2 * stride)), stride)
        disks.step()
