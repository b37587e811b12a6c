"""The weakest cut through a bonded sample: what it bears in tension at most, from its bonds alone.

Let the part above a cut move up as one rigid body. A bond across the cut, whose normal has the components n_y along the
pull and n_x across it, opens with n_y and slips with n_x. At the tip of its cone, N = −F_a and T = 0, it does the work
F_a n_y. That is the plastic work of the cone with its associated flow where the motion lies in the normal cone of the
tip, n_y ≥ μ abs(n_x); other bonds jam, and no cut goes through them. By the upper bound theorem of limit analysis no
associated sample bears more than the sum of F_a n_y over any cut; and one whose shear does not dilate, as here, bears
no more than the associated one (Radenkovic 1961). The least of these sums is a minimum cut of a graph, and equals its
maximum flow.

Disks that turn, and parts that do, make real samples weaker than that.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

__all__ = ["WeakestCut", "find"]

UNITS = 10**5  # of the largest bond's strength, as the flow is one of whole numbers
JAMMED = 2**30


@dataclass(frozen=True)
class WeakestCut:
    """``force`` [N/m] that the cut bears at most; ``bonds``: indices of those that cross it."""

    force: float
    bonds: np.ndarray


def find(x, y, bonds, strengths, friction, bottom, top):
    """The WeakestCut across the y direction.

    ``x``, ``y`` [m]: centres of n disks; ``bonds``: pairs of them, (m, 2); ``strengths``: F_a of each [N/m], (m,);
    ``friction``: μ of bonds; ``bottom``, ``top``: indices of the disks that the platens hold, which no cut parts from
    them. Raises ValueError where a platen holds no disk.
    """
    from scipy.sparse import csr_matrix
    from scipy.sparse.csgraph import breadth_first_order, maximum_flow

    if not len(bottom) or not len(top):
        raise ValueError("a platen holds no disk: give the indices of those that it holds")
    x, y, bonds = np.asarray(x, float), np.asarray(y, float), np.asarray(bonds, int)
    strengths, n = np.asarray(strengths, float), len(x)
    low, high = np.where(y[bonds[:, 0]] < y[bonds[:, 1]], bonds.T, bonds.T[::-1])
    nx, ny = x[high] - x[low], y[high] - y[low]
    length = np.hypot(nx, ny)
    unit = strengths.max() / UNITS
    bears = np.where(ny >= friction * np.abs(nx), np.rint(strengths * ny / length / unit), JAMMED)
    held = np.full(len(bottom), n), np.asarray(bottom), np.asarray(top), np.full(len(top), n + 1)
    # from the lower platen up; a bond whose upper disk belongs to the lower part would have to close
    rows, columns = np.concatenate((low, high, held[0], held[2])), np.concatenate((high, low, held[1], held[3]))
    capacity = np.concatenate((bears, np.full(len(low) + len(bottom) + len(top), JAMMED))).astype(np.int32)
    graph = csr_matrix((capacity, (rows, columns)), shape=(n + 2, n + 2))
    flow = maximum_flow(graph, n, n + 1)
    left = graph - flow.flow
    left.eliminate_zeros()
    reached = np.zeros(n + 2, bool)
    reached[breadth_first_order(left, n, return_predecessors=False)] = True
    return WeakestCut(flow.flow_value * unit, np.flatnonzero(reached[low] != reached[high]))
