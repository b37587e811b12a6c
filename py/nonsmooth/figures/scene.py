"""Any scene as it stands, whoever made it: disks, walls, bonds and forces. Reads YADE's objects by their attributes, and imports no YADE.

Disks are :class:`Sphere`; walls are Segment, Wall (along an axis), Box and Facet, seen along z. Contacts are hard or soft; a force is that of the last step.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgba, to_rgba_array

from . import style
from .forces import force_bars
from .style import COMPRESSION, INK, TENSION, WALL

__all__ = ["Drawn", "draw", "read"]

MATERIALS = ("#dcc9a0", "#b8d3ea", "#cfe3c4", "#e9c9d8", "#f3e2a9", "#d9d2e9")  # pale, as forces are drawn on them
FIXED = "#c9c9c6"
BAR = 0.35  # diameters, width of the bar of the reference force


@dataclass(frozen=True, eq=False)
class Drawn:
    """What is drawn. Disks: ``x``, ``y``, ``r`` [m], ``material`` (order in which materials come), ``fixed``: arrays (n,). ``walls``: list of arrays (2, 2), lines from point to
    point; ``axes``: list of (0 or 1, place [m]), lines along y or x. Contacts: disks ``ci``, ``cj`` (negative: a wall), points ``cx``, ``cy`` [m], normal force ``cn`` [N],
    compression positive, ``bonded``: arrays (c,)."""

    x: np.ndarray
    y: np.ndarray
    r: np.ndarray
    material: np.ndarray
    fixed: np.ndarray
    walls: list
    axes: list
    ci: np.ndarray
    cj: np.ndarray
    cx: np.ndarray
    cy: np.ndarray
    cn: np.ndarray
    bonded: np.ndarray


def read(O) -> Drawn:
    """The scene in a YADE ``O``. Raises RecordsError where there is no disk in it."""
    disks, walls, axes, order, kinds = [], [], [], {}, {}
    for b in O.bodies:
        if b is None or b.shape is None:
            continue
        kind, (x, y) = type(b.shape).__name__, (b.state.pos[0], b.state.pos[1])
        if kind == "Sphere":
            order[b.id] = len(disks)
            disks.append((x, y, b.shape.radius, kinds.setdefault(id_of(b.material), len(kinds)), "x" in b.state.blockedDOFs and "y" in b.state.blockedDOFs))
        elif kind == "Wall":
            axes += [(b.shape.axis, b.state.pos[b.shape.axis])] if b.shape.axis < 2 else []
        elif kind in ("Segment", "Box", "Facet"):
            turn = b.state.ori.toRotationMatrix()
            corners = np.array([[x + sum(turn[0, k] * c[k] for k in range(3)), y + sum(turn[1, k] * c[k] for k in range(3))] for c in _corners(kind, b.shape)])
            walls += [np.array([corners[k], corners[k - 1]]) for k in range(len(corners)) if len(corners) > 2 or k]
    if not disks:
        raise style.RecordsError("there is no disk in the scene; draw it when its bodies have been appended")
    contacts = [one for i in O.interactions if i.isReal and (one := _contact(i, order))]
    x, y, r, material, fixed = (np.array(column) for column in zip(*disks))
    ci, cj, cx, cy, cn, bonded = (np.array(column) for column in zip(*contacts)) if contacts else (np.zeros(0, int), np.zeros(0, int), *np.zeros((3, 0)), np.zeros(0, bool))
    return Drawn(x, y, r, material.astype(int), fixed.astype(bool), walls, axes, ci, cj, cx, cy, cn, bonded.astype(bool))


def id_of(material):
    """What tells a material from others: its place in O.materials, or its name, where it was not appended there."""
    return None if material is None else (material.id, material.label)


def _corners(kind, shape):
    """Points of a wall's outline in its own frame."""
    if kind == "Segment":
        return [(-shape.halfLength, 0, 0), (shape.halfLength, 0, 0)]
    if kind == "Box":
        a, b = shape.extents[0], shape.extents[1]
        return [(-a, -b, 0), (a, -b, 0), (a, b, 0), (-a, b, 0)]
    return [tuple(v) for v in shape.vertices]


def _contact(i, order):
    """(disk, other disk or −1, point, force, whether bonded), None where no disk is in it."""
    if i.geom is None or i.phys is None or not hasattr(i.geom, "normal") or not hasattr(i.phys, "normalForce"):
        return None
    a, b = order.get(i.id1, -1), order.get(i.id2, -1)
    if a < 0:
        a, b = b, a
    if a < 0:
        return None
    bonded = i.phys.bonded if hasattr(i.phys, "bonded") else not getattr(i.phys, "cohesionBroken", not getattr(i.phys, "isCohesive", False))
    point = getattr(i.geom, "contactPoint", (0.0, 0.0))
    return a, b, point[0], point[1], sum(i.phys.normalForce[k] * i.geom.normal[k] for k in range(3)), bonded


@style.styled
def draw(O, path=None, pdf=False, ax=None, forces=True):
    """The scene of any script in one line, ``figures.draw(O, "scene.png")``: disks in the colours of their materials (those that cannot move grey), walls black, bonds
    thin lines, and with ``forces`` bars from centre to centre, as wide as the normal force is large: blue compression, red tension.

    ``ax``: axes to draw on, of a figure of one's own, which is then returned and not written. Raises RecordsError for a scene without disks.
    """
    scene = read(O)
    left, right = float((scene.x - scene.r).min()), float((scene.x + scene.r).max())
    low, high = float((scene.y - scene.r).min()), float((scene.y + scene.r).max())
    margin = 0.06 * max(right - left, high - low)
    box = (left - margin, right + margin, low - 1.8 * margin, high + margin)  # room for the scale
    fig = ax.figure if ax is not None else style.figure(9.0, min(12.0, max(1.5, 9.0 * (box[3] - box[2]) / (box[1] - box[0]))))
    mine = ax if ax is not None else fig.add_axes([0, 0, 1, 1])
    style.frame(mine, *box)
    colours = to_rgba_array(MATERIALS)[scene.material % len(MATERIALS)]
    colours[scene.fixed] = to_rgba(FIXED)
    style.draw_disks(mine, scene, colours, edge="#8f8a80", width=0.4)
    mine.add_collection(LineCollection(scene.walls, colors=WALL, linewidths=1.6, capstyle="round", zorder=4), autolim=False)
    for axis, at in scene.axes:
        (mine.axvline if axis == 0 else mine.axhline)(at, color=WALL, lw=1.6, zorder=4)
    held = (scene.cj >= 0) & scene.bonded
    bonds = [np.array([[scene.x[i], scene.y[i]], [scene.x[j], scene.y[j]]]) for i, j in zip(scene.ci[held], scene.cj[held])]
    mine.add_collection(LineCollection(bonds, colors=INK, linewidths=0.5, zorder=2.5), autolim=False)
    if forces and np.any(scene.cn != 0):
        reference = float(np.quantile(np.abs(scene.cn[scene.cn != 0]), 0.95))  # a few large ones would hide the others
        width = BAR * 2 * float(np.median(scene.r))
        for sign, colour in ((1, COMPRESSION), (-1, TENSION)):
            bars = np.flatnonzero(sign * scene.cn > 0)
            mine.add_collection(PolyCollection(force_bars(scene, bars, reference, width), facecolors=colour, edgecolors="none", zorder=3), autolim=False)
    style.scale_bar(mine, 0.97, 0.02, 0.2)
    return style.save(fig, None if ax is not None else path, pdf)
