"""Any scene as it stands, whoever made it: disks, walls, bonds and forces, see :mod:`nonsmooth.scene_arrays`."""

from __future__ import annotations

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgba, to_rgba_array

from ..scene_arrays import read
from . import style
from .forces import force_bars
from .style import COMPRESSION, INK, TENSION, WALL

__all__ = ["draw"]

MATERIALS = ("#dcc9a0", "#b8d3ea", "#cfe3c4", "#e9c9d8", "#f3e2a9", "#d9d2e9")  # pale, as forces are drawn on them
FIXED = "#c9c9c6"
BAR = 0.35  # diameters, width of the bar of the reference force


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
    fig = (
        ax.figure
        if ax is not None
        else style.figure(9.0, min(12.0, max(1.5, 9.0 * (box[3] - box[2]) / (box[1] - box[0]))))
    )
    mine = ax if ax is not None else fig.add_axes([0, 0, 1, 1])
    style.frame(mine, *box)
    colours = to_rgba_array(MATERIALS)[scene.material % len(MATERIALS)]
    colours[scene.fixed] = to_rgba(FIXED)
    style.draw_disks(mine, scene, colours, edge="#8f8a80", width=0.4)
    mine.add_collection(
        LineCollection(scene.walls, colors=WALL, linewidths=1.6, capstyle="round", zorder=4), autolim=False
    )
    for axis, at in scene.axes:
        (mine.axvline if axis == 0 else mine.axhline)(at, color=WALL, lw=1.6, zorder=4)
    held = (scene.cj >= 0) & scene.bonded
    bonds = [
        np.array([[scene.x[i], scene.y[i]], [scene.x[j], scene.y[j]]]) for i, j in zip(scene.ci[held], scene.cj[held])
    ]
    mine.add_collection(LineCollection(bonds, colors=INK, linewidths=0.5, zorder=2.5), autolim=False)
    if forces and np.any(scene.cn != 0):
        reference = float(np.quantile(np.abs(scene.cn[scene.cn != 0]), 0.95))  # a few large ones would hide the others
        width = BAR * 2 * float(np.median(scene.r))
        for sign, colour in ((1, COMPRESSION), (-1, TENSION)):
            bars = np.flatnonzero(sign * scene.cn > 0)
            mine.add_collection(
                PolyCollection(
                    force_bars(scene, bars, reference, width), facecolors=colour, edgecolors="none", zorder=3
                ),
                autolim=False,
            )
    style.scale_bar(mine, 0.97, 0.02, 0.2)
    return style.save(fig, None if ax is not None else path, pdf)
