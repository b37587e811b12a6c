"""Sides of a sample as a flexible membrane: the pressure acts on the outermost disks.

The outline of the disks is that of the Delaunay triangles of their centres whose circumscribed circle is below
:data:`LARGEST_VOID` in radius (an alpha shape). Between two platens it has a left and a right chain of disks. A chain's
edge of length L with the outward normal n carries −σ₃ L n, half on each of its disks; from a chain's ends the membrane
goes straight to the platens. Horizontally the two sides then balance by construction.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import Delaunay

from ...errors import UserError

__all__ = ["MembraneError", "boundary", "forces", "sides"]

LARGEST_VOID = 1.0  # largest diameters


class MembraneError(UserError, RuntimeError):
    """The outline of the sample is no longer one line from platen to platen."""


def boundary(x, y, r):
    """Indices of the disks along the outline, once around counterclockwise; ``x``, ``y``, ``r`` [m]: arrays of shape
    (n,).

    Raises MembraneError where there is no outline, or none that closes.
    """
    places = np.column_stack((x, y))
    triangles = Delaunay(places).simplices
    a, b, c = (places[triangles[:, k]] for k in range(3))
    twice = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    sides = np.hypot(*(b - a).T) * np.hypot(*(c - b).T) * np.hypot(*(a - c).T)
    keep = sides < np.abs(twice) * 2 * LARGEST_VOID * 2 * r.max()
    flip = twice < 0
    triangles[flip] = triangles[flip][:, [0, 2, 1]]
    triangles = triangles[keep]
    edges = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    there, back = (
        edges[:, 0].astype(np.int64) * len(x) + edges[:, 1],
        edges[:, 1].astype(np.int64) * len(x) + edges[:, 0],
    )
    after = {}
    for p, q in edges[~np.isin(back, there)].tolist():
        after.setdefault(p, []).append(q)
    if not after:
        raise MembraneError("the sample has no outline; ask for more disks")
    # at a disk where the outline touches itself, the rightmost turn stays outside; a disk that has come off belongs to
    # no triangle
    start = min(after, key=lambda k: (x[k] - r[k], k))
    chain, before = [start], places[start] - np.array([0.0, -1.0])
    while True:
        here = chain[-1]
        choices = after[here]
        came = places[here] - before

        def turn(q):
            go = places[q] - places[here]
            return np.arctan2(came[0] * go[1] - came[1] * go[0], came @ go)

        follow = min(choices, key=turn)
        if follow == start:
            return np.array(chain)
        if len(chain) > len(edges):
            raise MembraneError(
                "the outline of the sample does not close; more disks, or a smaller strain, keep it whole"
            )
        before = places[here]
        chain.append(follow)


def sides(x, y, r, bottom, top):
    """The left chain from the top to the bottom, and the right one from the bottom to the top (arrays of indices).

    ``bottom``, ``top``: heights of the platens [m]. Raises MembraneError where there is no such chain.
    """
    loop = boundary(x, y, r)
    near = 0.6 * r.max()
    low = np.flatnonzero(y[loop] - r[loop] - bottom < near)
    high = np.flatnonzero(top - y[loop] - r[loop] < near)
    if not len(low) or not len(high):
        raise MembraneError("no disk of the sample's outline is near a platen")
    corner = {
        name: int(where[np.argmin(sign * x[loop[where]])])
        for name, where, sign in (
            ("bottom left", low, 1),
            ("bottom right", low, -1),
            ("top left", high, 1),
            ("top right", high, -1),
        )
    }
    n = len(loop)

    def part(begin, end):
        return loop[(begin + np.arange((end - begin) % n + 1)) % n]

    return part(corner["top left"], corner["bottom left"]), part(corner["bottom right"], corner["top right"])


def forces(x, y, r, bottom, top, pressure):
    """Forces of the membrane [N/m], shape (n, 2), zero inside; and the area between the two chains [m²].

    ``x``, ``y``, ``r`` [m]: shape (n,); ``bottom``, ``top``: heights of the platens [m]; ``pressure``: σ₃ [Pa]. Raises
    MembraneError, see :func:`sides`.
    """
    total = np.zeros((len(x), 2))
    left, right = sides(x, y, r, bottom, top)
    area = 0.0
    for chain, sign in ((left, -1), (right, 1)):
        ends = (top, bottom) if chain is left else (bottom, top)
        px, py = x[chain] + sign * r[chain], y[chain]
        dx, dy = np.diff(px), np.diff(py)
        # outward normal times length, for a walk with the sample on the left
        fx, fy = -pressure * dy, pressure * dx
        for k, share in ((slice(None, -1), 0.5), (slice(1, None), 0.5)):
            np.add.at(total, (chain[k], 0), share * fx)
            np.add.at(total, (chain[k], 1), share * fy)
        # to the platens, straight up or down
        total[chain[0], 0] += -pressure * (py[0] - ends[0])
        total[chain[-1], 0] += -pressure * (ends[1] - py[-1])
        wx, wy = np.concatenate(([px[0]], px, [px[-1]])), np.concatenate(([ends[0]], py, [ends[1]]))
        area += float(np.sum(0.5 * (wx[1:] + wx[:-1]) * np.diff(wy)))
    return total, area
