"""How densely disks lie around each of them: the area share of disks in a neighbourhood, by Laguerre cells.

The cell of a disk is all that is nearer to it than to any other, by the power distance (x - c)² - r²: its sides are the
radical lines of neighbours, so that no disk reaches into the cell of another one, whatever their sizes. Cells of single
disks change by several per cent in a shear that changes no area, since their neighbours do; the mean over some disks
does not. So the share of a neighbourhood is the area of its disks by that of its cells.

Cells end where the mass does. The triangles between neighbours' centres fill it; one whose void is wide, the circle at
right angles to its three disks, lies outside. What is left of cells and disks within the other triangles counts, a disk
at the rim with a sector alone. So walls and the free surface bound the cells alike, and neither needs to be given.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import ConvexHull, QhullError, cKDTree

from ..errors import UserError
from ..system import checks

__all__ = ["VOID", "Cells", "area_shares", "cells"]

#: Radius of the widest void within a mass, in mean diameters: a dense packing has voids of 0.2, and a crack of twice
#: this width is one of the mass.
VOID = 1.0


@dataclass(frozen=True)
class Cells:
    """``area`` [m²] of each disk's Laguerre cell within the mass, and of the part of the disk, ``solid`` [m²], that
    lies within: both of shape (n,), and 0 for a disk with none around it.
    """

    area: np.ndarray
    solid: np.ndarray


def cells(x, y, r, void) -> Cells:
    """The Laguerre cells of disks at ``x``, ``y`` with the radii ``r``, each of shape (n,) [m], within the mass;
    ``void`` [m]: radius of the widest void that counts as within.

    Raises UserError for arrays that are not flat and equally long, and for a ``void`` that is not above 0.
    """
    x, y, r = _flat(x=x, y=y, r=r)
    checks.number("void", void, UserError, "give a length [m] above 0", above=0)
    centres = np.column_stack([x, y])
    triangles = _triangles(centres, r)
    area, solid = np.zeros(len(r)), np.zeros(len(r))
    if not len(triangles):
        return Cells(area, solid)
    corners, radii = centres[triangles], r[triangles]  # (m, 3, 2), (m, 3)
    # the void's centre, from the first corner: of equal power to all three
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    double = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    power = radii[:, :1] ** 2 - radii[:, 1:] ** 2
    p, q = ((u**2).sum(1) + power[:, 0]) / 2, ((v**2).sum(1) + power[:, 1]) / 2
    with np.errstate(divide="ignore", invalid="ignore"):  # of three disks in a line
        centre = np.column_stack([p * v[:, 1] - q * u[:, 1], q * u[:, 0] - p * v[:, 0]]) / double[:, None]
        within = (centre**2).sum(1) - radii[:, 0] ** 2 <= void**2
    within &= double > 0
    triangles, corners, radii = triangles[within], corners[within], radii[within]
    middle = corners[:, 0] + centre[within]
    for k in range(3):
        here = corners[:, k]
        sides, feet = [], []
        for other in (1, 2):
            o = (k + other) % 3
            side = corners[:, o] - here
            square = (side**2).sum(1)
            # where the radical line meets the side
            feet.append(side * ((square + radii[:, k] ** 2 - radii[:, o] ** 2) / (2 * square))[:, None])
            sides.append(side)
        to = middle - here
        own = (_cross(feet[0], to) + _cross(to, feet[1])) / 2
        angle = np.arctan2(_cross(*sides), (sides[0] * sides[1]).sum(1))
        area += np.bincount(triangles[:, k], own, len(r))
        solid += np.bincount(triangles[:, k], radii[:, k] ** 2 * angle / 2, len(r))
    return Cells(area, solid)


def area_shares(x, y, reach, *of) -> tuple[np.ndarray, ...]:
    """Area share of disks around each disk, of shape (n,), for each of these Cells, which are of the same disks at
    different times: of all whose centres are within ``reach`` [m] of its own at ``x``, ``y``, (n,) [m], the sum of
    ``solid`` by that of ``area``. So a neighbourhood is compared with the same disks at another time, and its
    composition does not count. 0 where a disk has no others around.

    Raises UserError for arrays that are not flat and equally long, and for a ``reach`` that is not above 0.
    """
    x, y = _flat(x=x, y=y)
    checks.number("reach", reach, UserError, "give a length [m] above 0", above=0)
    _flat(x=x, **{f"area of cells {k}": one.area for k, one in enumerate(of)})
    i, j = cKDTree(np.column_stack([x, y])).query_pairs(reach, output_type="ndarray").T

    def around(values):
        return values + np.bincount(i, values[j], len(x)) + np.bincount(j, values[i], len(x))

    return tuple(_ratio(around(one.solid), around(one.area)) for one in of)


def _ratio(solid, area):
    return np.divide(solid, area, out=np.zeros(len(solid)), where=area > 0)


def _flat(**arrays):
    """The arrays, of floats. Raises UserError where they are not flat and equally long."""
    found = [np.asarray(a, float) for a in arrays.values()]
    if found[0].ndim != 1 or any(a.shape != found[0].shape for a in found):
        told = ", ".join(f"{name} {a.shape}" for name, a in zip(arrays, found))
        raise UserError(f"arrays of the shapes {told}: give flat ones of one length, with a number for each disk")
    return found


def _cross(a, b):
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def _triangles(centres, r):
    """Triangles between neighbours, (m, 3) numbers of disks counter-clockwise: the lower hull of the points (x, y, x² +
    y² - r²).
    """
    if len(r) < 3:
        return np.zeros((0, 3), int)
    at = centres - centres.mean(axis=0)
    lifted = np.column_stack([at, (at**2).sum(1) - r**2])
    # a point far above: the lower side is the same, and disks on one circle are no flat hull
    top = [0.0, 0.0, lifted[:, 2].max() + np.ptp(at)]
    try:
        hull = ConvexHull(np.vstack([lifted, top]))
    except QhullError:  # all in one line
        return np.zeros((0, 3), int)
    below = hull.simplices[hull.equations[:, 2] < 0]
    below = below[(below < len(r)).all(axis=1)]
    a, b, c = (at[below[:, k]] for k in range(3))
    turned = _cross(b - a, c - a) < 0
    below[turned] = below[turned][:, ::-1]
    return below
