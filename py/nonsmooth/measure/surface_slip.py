"""How far the mass has slipped along slip surfaces since t0: the permanent displacement that an earthquake leaves.

A slip surface's disks are those that touched it at t0: of a wall the disks on it, of an interface those of each layer
that touched the other's. Its displacement is the mean way of these disks down the surface, from end to end of it; of an
interface that of the upper layer's less that of the lower's. A surface that nothing touched has none. Needs no YADE.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..model import roles

__all__ = ["Surface", "displacements", "halves", "surfaces"]


class Surface(NamedTuple):
    """A slip surface: its ``name``, the direction ``way`` down it (x, y), and the numbers of the disks ``above`` and,
    of an interface, ``below``.
    """

    name: str
    way: tuple[float, float]
    above: np.ndarray
    below: np.ndarray


def surfaces(section, begin) -> list[Surface]:
    """The slip surfaces of a Section with the disks that touch them in the Snapshot ``begin``, which has contacts."""
    numbers = {wall.name: k for k, wall in enumerate(section.walls)}
    between = {one.name: section.numbers_of(one) for one in section.interfaces}
    found = []
    for name, line in section.slip_surfaces:
        chord = roles.chord([line])
        way = chord / math.hypot(*chord)
        if way @ section.downslope < 0:  # of a level surface below a slope that falls to the left
            way = -way
        if name in numbers:
            above, below = begin.ci[begin.cj == -1 - numbers[name]], np.zeros(0, int)
        else:
            above, below = _across(begin, *between[name])
        found.append(Surface(name, tuple(way.tolist()), np.unique(above), np.unique(below)))
    return found


def _across(begin, lower, upper):
    """The disks of the upper layer that touch the lower one's, and those."""
    disks = begin.cj >= 0
    a, b = begin.ci[disks], begin.cj[disks]
    a, b = np.r_[a, b], np.r_[b, a]
    chosen = (begin.layer[a] == upper) & (begin.layer[b] == lower)
    return a[chosen], b[chosen]


def displacements(found, begin, x, y, numbers=None) -> dict[str, float]:
    """{name: displacement [m], positive down the surface} of :func:`surfaces`, from the Snapshot ``begin`` to centres
    at ``x``, ``y`` (n,) [m]. ``numbers`` (n,): which disks these are where some are gone, which count no longer.
    """
    there = np.arange(len(begin.x)) if numbers is None else numbers
    told, along = {}, np.full(len(begin.x), np.nan)
    for one in found:
        along[there] = (x - begin.x[there]) * one.way[0] + (y - begin.y[there]) * one.way[1]
        told[one.name] = _mean(along, one.above) - _mean(along, one.below)
    return told


def halves(surface, begin, shots, slip) -> tuple[float, float] | None:
    """How far the upper and the lower half of a Surface have slipped since the Snapshot ``begin`` when all of it has, in
    the mean, slipped by ``slip`` [m]: a pair [m], linear between two snapshots; None where it never has, or where a half
    has no disk. Weakening that spreads down a surface finds the upper half ahead (Taboada and Estrada 2009, [117]).

    ``shots``: Snapshots in the course of time, which may be read one by one; disks that are gone count no longer. The
    halves part the line between the first and the last of the disks that touched the surface.
    """
    along = begin.x * surface.way[0] + begin.y * surface.way[1]
    on = np.r_[surface.above, surface.below]
    if not len(on):
        return None
    middle = (along[on].min() + along[on].max()) / 2
    upper = surface._replace(
        name=f"{surface.name}, upper half",
        above=surface.above[along[surface.above] < middle],
        below=surface.below[along[surface.below] < middle],
    )
    lower = surface._replace(
        name=f"{surface.name}, lower half",
        above=np.setdiff1d(surface.above, upper.above),
        below=np.setdiff1d(surface.below, upper.below),
    )
    if not len(upper.above) or not len(lower.above):
        return None
    before = np.zeros(3)
    for shot in shots:
        now = np.array([*displacements((surface, upper, lower), begin, shot.x, shot.y, shot.number).values()])
        if now[0] >= slip > before[0]:
            share = (slip - before[0]) / (now[0] - before[0])
            return tuple((before + share * (now - before))[1:].tolist())
        before = now
    return None


def _mean(values, chosen):
    values = values[chosen]
    values = values[~np.isnan(values)]
    return float(np.mean(values)) if len(values) else 0.0
