"""Whether a packing belongs to a section: what a file of disks of one's own is asked before anything runs."""

from __future__ import annotations

import math

import numpy as np

from ..model import geometry
from . import overlaps
from .files import PackingError

__all__ = ["FEWEST", "check", "sparse_layers"]

FEWEST = 30  # disks of a layer; fewer are a handful of grains, whose strength is a matter of chance

# A settled packing of another code has moved a little, and keeps the overlaps that its contacts need.
WORST_OVERLAP = 0.02  # of the mean diameter of a pair, or of a disk's at a wall
MEAN_OVERLAP = 1e-3
SIZES = 0.05  # relative, beyond the section's diameters
COVERED = 0.1  # relative, of the area that the section's disks cover
OUTSIDE = 2.0  # largest diameters above the layers ...
AWAY = 2.0  # ... and from the disk's own one


def sparse_layers(packing, section) -> list:
    """Sentences, one for each layer of the section with fewer than :data:`FEWEST` disks in the packing; obstacles are
    bodies, and may have as few as they like.
    """
    count = np.bincount(packing.layer, minlength=len(section.layers))
    return [
        f"LAYER {layer.name} HOLDS {n} DISKS: fewer than {FEWEST} tell little of a layer; give it smaller disks (its own `disks`), or ask for more (--disks)"
        for layer, n in zip(section.layers, count.tolist())
        if n < FEWEST and layer.role != "obstacle"
    ]


def check(packing, section, source) -> None:
    """Raise PackingError where `packing`, read from `source`, is none of `section`: layers, sizes, overlaps, places, or
    how much of the layers it fills.
    """
    remedy = "give a packing of this section, or the section that it was made for"

    def refuse(what, helps=remedy):
        return PackingError(f"{source}: {what}; {helps}")

    def at(k):
        return f"disk {k} at ({packing.x[k]:.6g}, {packing.y[k]:.6g}) m"

    names = [layer.name for layer in section.layers]
    bad = np.flatnonzero((packing.layer < 0) | (packing.layer >= len(names)))
    if len(bad):
        raise refuse(
            f"{at(bad[0])} belongs to layer {packing.layer[bad[0]]}, and the section has {len(names)}",
            f"give 0 ({names[0]}) to {len(names) - 1} ({names[-1]})",
        )
    low, high = section.smallest / 2, section.largest / 2
    for k in (int(np.argmin(packing.r)), int(np.argmax(packing.r))):
        if not low * (1 - SIZES) <= packing.r[k] <= high * (1 + SIZES):
            raise refuse(
                f"{at(k)} has a radius of {packing.r[k]:.4g} m, and the section's disks have {low:.4g} to {high:.4g} m",
                "give the section the diameters of the file (disks.diameter, or --disks with its number), or scale the file",
            )
    _check_places(packing, section, refuse, at)
    # centres in one cell are nearer than 0.85 of the smallest diameter; and what is not there need not be paired
    cell = np.floor(np.column_stack((packing.x, packing.y)) / (1.2 * low))
    order = np.lexsort(cell.T)
    twice = np.flatnonzero((np.diff(cell[order], axis=0) == 0).all(axis=1))
    if len(twice):
        raise refuse(
            f"{at(order[twice[0]])} and {at(order[twice[0] + 1])} overlap by more than a tenth of their mean diameter"
        )
    found = overlaps(packing)
    if found.worst > WORST_OVERLAP or found.mean > MEAN_OVERLAP:
        raise refuse(
            f"disks overlap by up to {found.worst:.2g} of their mean diameter, {found.mean:.2g} in the mean of close pairs",
            f"give a packing whose disks overlap by at most {WORST_OVERLAP:g}, and {MEAN_OVERLAP:g} in the mean",
        )
    has, wanted = math.pi * math.fsum(packing.r**2), sum(section.disk_areas())
    if not abs(has / wanted - 1) <= COVERED:
        raise refuse(
            f"disks fill {has / section.area:.3f} of the layers, and the section's fill {wanted / section.area:.3f}",
            "give a packing of the section's density, or set disks.packing_fraction to that of the file",
        )


def _check_places(packing, section, refuse, at):
    """Disks are inside the layers' outline, clear of all walls, and near their own layers."""
    x, y, r, most = packing.x, packing.y, packing.r, 2 * WORST_OVERLAP
    x0, y0, x1, y1 = section.outline.bounds
    reach = OUTSIDE * section.largest
    far = np.flatnonzero((x < x0 - reach) | (x > x1 + reach) | (y < y0 - reach) | (y > y1 + reach))
    if len(far):
        raise refuse(
            f"{at(far[0])} lies outside the layers, which reach from ({x0:.6g}, {y0:.6g}) to ({x1:.6g}, {y1:.6g}) m"
        )
    inside = np.zeros(len(packing), bool)
    for polygon in geometry.parts(section.outline):
        inside |= geometry.contains(polygon, x, y)
    places = np.column_stack((x, y))
    away = _distance(places, [_closed(layer) for layer in section.layers])
    for wall in section.walls:
        gap = _distance(places, [wall.points])
        # outside, and the way back to the layers is through the wall
        behind = ~inside & (gap <= away + 3 * section.tolerance)
        bad = np.flatnonzero((gap < (1 - most) * r) | behind)
        if len(bad):
            k = bad[0]
            raise refuse(
                f"{at(k)} lies {'beyond' if behind[k] else 'in'} the wall {wall.name}, {gap[k]:.3g} m from it, with a radius of {r[k]:.3g} m"
            )
    outside = np.flatnonzero(~inside & (away > reach))
    if len(outside):
        raise refuse(f"{at(outside[0])} lies {away[outside[0]]:.4g} m outside the layers")
    for number, layer in enumerate(section.layers):
        mine = np.flatnonzero(packing.layer == number)
        if not len(mine):
            raise refuse(
                f"no disk belongs to layer {number} ({layer.name})",
                "give lines of x y r layer, with the layers' numbers from 0",
            )
        strays = mine[~geometry.contains(layer.polygon, x[mine], y[mine])]
        gap = _distance(places[strays], [_closed(layer)])
        far = np.flatnonzero(gap > AWAY * section.largest)
        if len(far):
            raise refuse(
                f"{at(strays[far[0]])} belongs to layer {number} ({layer.name}) and lies {gap[far[0]]:.4g} m outside it",
                "give lines of x y r layer, with the number, from 0, of the layer that the disk is in",
            )


def _closed(layer):
    return np.vstack((layer.points, layer.points[:1]))


def _distance(places, lines):
    """Distance [m] of places (n, 2) from the nearest of polylines (n, 2)."""
    return geometry.nearest(places, *geometry.pieces(lines))[0]
