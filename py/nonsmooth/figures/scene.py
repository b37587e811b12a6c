"""Any scene as it stands, whoever made it: disks, walls, bonds and forces, see :mod:`nonsmooth.scene_arrays`."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgba, to_rgba_array
from matplotlib.lines import Line2D

from ..records import RecordsError
from ..world.scene_arrays import read
from . import given, style
from .forces import force_bars
from .style import COMPRESSION, INK, TENSION, WALL

__all__ = ["Look", "draw", "paint"]

MATERIALS = ("#dcc9a0", "#b8d3ea", "#cfe3c4", "#e9c9d8", "#f3e2a9", "#d9d2e9")  # pale, as forces are drawn on them
FIXED = "#c9c9c6"
NEAR = 0.2  # of what moves, its length or height: how far around it disks that are held are shown
BAR = 0.35  # diameters, width of the bar of the reference force
PALER = 0.5  # share of white in bodies' own colours, where forces are drawn on them
COLOURS = ("bodies", "materials")


class Look:
    """What all pictures of one scene share, from ``scenes``, the times at which it is drawn: the limits, the scale of
    forces, and where colours come from.

    ``forces``, ``view``, ``colours``: as of :func:`draw`. ``box``: the limits (x0, x1, y0, y1) [m], with room for the
    scale below; ``reference`` [N]: the force whose bar is ``width`` [m] wide, None where there is no force. Raises
    RecordsError for a view and for colours that cannot be used.
    """

    def __init__(self, scenes, forces=True, view=None, colours=None):
        self.own = checked_colours(colours) != "materials" and all(s.colour is not None for s in scenes)
        if colours == "bodies" and not self.own:
            raise RecordsError(
                "colours 'bodies': the disks have colours that differ from disk to disk, as YADE's random ones do; give bodies a color, or leave colours out"
            )
        self.box = _box(scenes) if view is None else checked_view(view)
        strengths = [np.abs(s.cn[s.cn != 0]) for s in scenes] if forces else []
        strengths = np.concatenate(strengths) if strengths else np.zeros(0)
        # a few large ones would hide the others
        self.reference = float(np.quantile(strengths, 0.95)) if len(strengths) else None
        self.width = BAR * 2 * float(np.median(np.concatenate([s.r for s in scenes])))
        self.signs = [
            (sign, colour, word)
            for sign, colour, word in ((1, COMPRESSION, "compression"), (-1, TENSION, "tension"))
            if self.reference and any(np.any(sign * s.cn > 0) for s in scenes)
        ]

    def colours_of(self, scene):
        """RGBA (n, 4)."""
        if not self.own:
            colours = to_rgba_array(MATERIALS)[scene.material % len(MATERIALS)]
            colours[scene.fixed] = to_rgba(FIXED)
            return colours
        paler = PALER if self.reference else 0.0
        return np.column_stack([paler + (1 - paler) * scene.colour, np.ones(len(scene.x))])


def _box(scenes):
    """Limits around all disks at all times that can move, with those near them that cannot, as of a long floor; around
    all where none can move.
    """
    scenes = [s for s in scenes if np.isfinite(s.x).all() and np.isfinite(s.y).all()]
    if not scenes:
        raise RecordsError("places of disks are not finite numbers; the scene cannot be drawn")
    whole = _ends([(s, slice(None)) for s in scenes])
    free = _ends([(s, ~s.fixed) for s in scenes if not s.fixed.all()] or [(s, slice(None)) for s in scenes])
    extent = max(free[1] - free[0], free[3] - free[2])
    near = NEAR * extent
    left, low = max(whole[0], free[0] - near), max(whole[2], free[2] - near)
    right, high = min(whole[1], free[1] + near), min(whole[3], free[3] + near)
    margin = 0.06 * max(right - left, high - low)
    return left - margin, right + margin, low - 1.8 * margin, high + margin  # room for the scale


def _ends(chosen):
    """The outermost edges (left, right, low, high) [m] of disks, pairs of a scene and which of its disks."""
    ends = [
        (np.min((s.x - s.r)[k]), np.max((s.x + s.r)[k]), np.min((s.y - s.r)[k]), np.max((s.y + s.r)[k]))
        for s, k in chosen
    ]
    return tuple(float(f(side)) for f, side in zip((min, max, min, max), zip(*ends)))


def checked_colours(colours):
    """What a caller gives as ``colours`` of :func:`draw`. Raises RecordsError."""
    if colours is not None and colours not in COLOURS:
        raise RecordsError(f"colours {colours!r}: give {' or '.join(map(repr, COLOURS))}, or nothing")
    return colours


def checked_view(view):
    """Limits as of :func:`draw`, as numbers. Raises RecordsError."""
    try:
        x0, x1, y0, y1 = (float(v) for v in view)
    except (TypeError, ValueError):
        x0 = x1 = y0 = y1 = math.nan
    if not (x0 < x1 and y0 < y1 and all(map(math.isfinite, (x0, x1, y0, y1)))):
        raise RecordsError(f"view {view!r}: give (x0, x1, y0, y1) in metres, x0 below x1 and y0 below y1")
    return x0, x1, y0, y1


def paint(ax, scene, look):
    """Draws a scene on axes whose limits are ``look.box``; returns the artists."""
    made = [style.draw_disks(ax, scene, look.colours_of(scene), edge="#8f8a80", width=0.4)]
    made.append(LineCollection(scene.walls, colors=WALL, linewidths=1.6, capstyle="round", zorder=4))
    made += [(ax.axvline if axis == 0 else ax.axhline)(at, color=WALL, lw=1.6, zorder=4) for axis, at in scene.axes]
    held = (scene.cj >= 0) & scene.bonded
    bonds = [
        np.array([[scene.x[i], scene.y[i]], [scene.x[j], scene.y[j]]]) for i, j in zip(scene.ci[held], scene.cj[held])
    ]
    made.append(LineCollection(bonds, colors=INK, linewidths=0.5, zorder=2.5))
    for sign, colour, _ in look.signs:
        bars = force_bars(scene, np.flatnonzero(sign * scene.cn > 0), look.reference, look.width)
        made.append(PolyCollection(bars, facecolors=colour, edgecolors="none", zorder=3))
    for artist in made:
        if artist.axes is None:
            ax.add_collection(artist, autolim=False)
    return made


def scales(ax, look, size=8.5):
    """The scale of lengths in the lower right corner of the axes, and that of forces in the left one, in letters of
    ``size`` points: bars of a round force, as wide as they are in the picture.
    """
    style.scale_bar(ax, 0.97, 0.02, 0.2)
    if not look.signs:
        return
    ax.apply_aspect()
    extent = ax.get_window_extent()
    points = 72 / ax.figure.dpi * extent.width / (look.box[1] - look.box[0])  # a metre
    force = style.nice(look.reference)
    newtons, unit = style.force_unit(force)
    ax.legend(
        handles=[
            Line2D([], [], color=colour, lw=look.width * force / look.reference * points, solid_capstyle="butt",
                   label=f"{word} {force / newtons:g} {unit.removesuffix('/m')}")
            for _, colour, word in look.signs
        ],
        loc="lower left", bbox_to_anchor=(0.0, -0.01), borderaxespad=0.2, fontsize=size, handlelength=1.8, frameon=True, facecolor="white", edgecolor="none", framealpha=0.85,
        ncol=2 if extent.width * 72 / ax.figure.dpi > 330 else 1, columnspacing=1.2, labelspacing=0.25,
    ).set_zorder(8)  # fmt: skip


@given.takes(O=given.DRAWN)
@style.styled
def draw(O, path=None, pdf=False, ax=None, forces=True, view=None, colours=None):
    """The scene of any script in one line, ``figures.draw(O, "scene.png")``: disks, walls black, bonds thin lines, and
    with ``forces`` bars from centre to centre, as wide as the normal force is large: blue compression, red tension,
    with their scale in the left corner.

    ``O``: YADE's, or a scene_arrays.Scene; ``ax``: axes to draw on, of a figure of one's own, which is then returned
    and not written. ``view``: limits (x0, x1, y0, y1) [m]; None: around all disks. ``colours``: "bodies", the colours
    that the bodies have (``shape.color``), paler where forces are drawn on them; "materials", a colour for each
    material, and grey for disks that cannot move; None: those of the bodies where they have been chosen (see
    :func:`nonsmooth.scene_arrays.read`), else those of the materials. :func:`animate` makes a video. Raises
    RecordsError for a scene without disks, and for a view or colours that cannot be used.
    """
    scene = read(O)
    look = Look([scene], forces, view, colours)
    x0, x1, y0, y1 = look.box
    fig = ax.figure if ax is not None else style.figure(9.0, min(12.0, max(1.5, 9.0 * (y1 - y0) / (x1 - x0))))
    mine = ax if ax is not None else fig.add_axes([0, 0, 1, 1])
    style.frame(mine, *look.box)
    paint(mine, scene, look)
    scales(mine, look)
    return style.save(fig, None if ax is not None else path, pdf)
