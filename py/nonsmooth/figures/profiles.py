"""The slope in profile: its state at the characteristic times (Figure 13) and the deposit it leaves."""

import numpy as np
from matplotlib.legend_handler import HandlerTuple
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from ..measure.fronts import front
from ..measure.ground import ground_of
from ..measure.surface import deposit_profile
from ..records import in_both
from . import given, style
from .style import INK

__all__ = ["deposit", "snapshots"]


def _time_label(label):
    """``t0`` as mathematics; anything else as it is."""
    return f"$t_{{{label[1:]}}}$" if label in style.TIME_NAMES else str(label)


INSET = (0.445, 0.79)  # of the panel's width, of the close-up of a slope that falls to the right ...
LOWEST, HIGHEST = 0.33, 0.95  # ... and of its height, where nothing is in the way
LEAST = 0.35  # of the panel's height that a close-up takes


def _room(cases, ground, view):
    """Limits of the panels, and the close-up's box (left, bottom, width, height) as shares of a panel, in the sky:
    above all disks of all times.
    """
    x0, x1, y0, y1 = view
    left, right = INSET if ground.side > 0 else (1 - INSET[1], 1 - INSET[0])
    a, b = x0 + left * (x1 - x0), x0 + right * (x1 - x0)
    tops = [(s.y + s.r)[(s.x + s.r > a) & (s.x - s.r < b)] for s in cases]
    tops.append(
        np.concatenate(
            [wall.vertices[(wall.vertices[:, 0] > a) & (wall.vertices[:, 0] < b), 1] for wall in ground.walls]
        )
    )
    top = max(max((t.max() for t in tops if len(t)), default=y0), y0)
    bottom = max(LOWEST, (top - y0) / (y1 - y0) + 0.03)
    if bottom > HIGHEST - LEAST:  # more sky
        bottom = HIGHEST - LEAST
        y1 = y0 + (top - y0) / (bottom - 0.03)
    return (x0, x1, y0, y1), (left, bottom, right - left, HIGHEST - bottom)


def _foot(ax, snapshot, ground, view, place, first):
    """An inset in the empty sky with the foot of the slope, 260 m wide at the paper's size."""
    corner, side = ground.foot, ground.side
    wide = 0.17 * (corner[0] - view[0] if side > 0 else view[1] - corner[0])
    x0, x1 = sorted((corner[0] - 0.75 * side * wide, corner[0] + 0.35 * side * wide))
    shape = place[3] * (view[3] - view[2]) / (place[2] * (view[1] - view[0]))
    y0 = corner[1] - 0.03 * wide
    y1 = y0 + shape * (x1 - x0)
    inset = ax.inset_axes(place, zorder=9)
    style.frame(inset, x0, x1, y0, y1)
    for spine in inset.spines.values():
        spine.set_visible(True)
    style.draw_walls(inset, ground, named=("backstop", "obstacle"))
    near = (np.abs(snapshot.x - (x0 + x1) / 2) < 0.6 * (x1 - x0)) & (
        np.abs(snapshot.y - (y0 + y1) / 2) < 0.7 * (y1 - y0)
    )
    style.draw_disks(inset, snapshot, style.state_colours(snapshot), near)
    style.draw_weakened(inset, ground, snapshot)
    if snapshot.water_m > 0:
        style.water_line(inset, ground, snapshot.water_m)
    ax.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, fill=False, ec=INK, lw=0.8, zorder=6))
    if first:
        style.scale_bar(inset, 0.3 if side > 0 else 0.93, 0.07, 0.2)
        inset.text(
            0.97,
            0.94,
            "foot, enlarged",
            transform=inset.transAxes,
            ha="right",
            va="top",
            fontsize=9,
            zorder=8,
            bbox={"fc": "white", "ec": "none", "alpha": 0.8, "pad": 1.5},
        )


@given.takes(cases=given.WET, walls=given.WALLS)
@style.styled
def snapshots(cases, walls, path=None, pdf=False, close_up=True, free_surface=None):
    """The slope at successive times, one below the other (the paper's Figure 13).

    ``cases``: list of (label, :class:`~nonsmooth.records.Snapshot`), labels such as "t0". Dry disks ochre, disks that
    feel pore pressure blue, those that were wet and have been released pink, shades alternating with the layers; the
    water table as a dashed line; of slip surfaces the part whose disks have passed D_c red, where the snapshots tell
    (:mod:`~nonsmooth.measure.weakening`). All panels have the same limits and scale; ``close_up`` adds the foot of the
    slope, enlarged, to each, where the shear bands of the failure appear. ``free_surface``: of a field of water, the
    polylines (k, 2) [m] of a time [s], ``free_surface(time)``, in the place of a water table.
    """
    cases, ground = list(cases), ground_of(walls)
    if not cases:
        raise style.RecordsError("there is no snapshot to draw; give at least one (label, snapshot)")
    view, place = style.view([s for _, s in cases], ground), None
    if close_up and ground.of_role("slip"):
        view, place = _room([s for _, s in cases], ground, view)
    extent, longest = view[1] - view[0], max(s.time_s for _, s in cases)
    edge, align = (0.985, "right") if ground.side > 0 else (0.015, "left")
    width, top, bottom = 10.5, 0.62, 0.1
    height = width * (view[3] - view[2]) / (view[1] - view[0])
    total = top + bottom + height * len(cases)
    fig, weakens = style.figure(width, total), False
    for k, (label, snapshot) in enumerate(cases):
        ax = fig.add_axes([0, (bottom + height * (len(cases) - 1 - k)) / total, 1, height / total])
        style.frame(ax, *view)
        style.draw_walls(ax, ground, named=("slip", "ground") if place else None)
        style.draw_disks(ax, snapshot, style.state_colours(snapshot))
        weakens |= style.draw_weakened(ax, ground, snapshot)
        if free_surface is not None:
            ax.plot(*style.free_surface(free_surface(snapshot.time_s)).T, **style.WATER_LINE)
        elif snapshot.water_m > 0:
            style.water_line(ax, ground, snapshot.water_m)
        if place:
            _foot(ax, snapshot, ground, view, place, first=k == 0)
        meaning, at = style.TIME_NAMES.get(label), style.seconds(snapshot.time_s, longest)
        ax.text(
            edge, 0.93, f"{_time_label(label)} = {at}" if meaning else f"{style.plain(label)}: {at}",
            transform=ax.transAxes, ha=align, va="top", fontsize=13, fontweight="bold", color=INK, zorder=8, path_effects=style.EDGE,
        )  # fmt: skip
        lines = [meaning] if meaning else []
        what = "water table" if free_surface is None else "mean head"  # on the slip surfaces
        lines += [f"{what} {style.length(snapshot.water_m, extent, 1)}" if snapshot.water_m > 0 else "no water"]
        lines += [
            f"wet {100 * (snapshot.wet & ~snapshot.released).mean():.0f} %, released {100 * snapshot.released.mean():.0f} %"
        ]
        ax.text(
            edge, 0.93 - 0.27 / height, "\n".join(lines), transform=ax.transAxes, ha=align, va="top", fontsize=9.5,
            linespacing=1.35, color="#444444", zorder=8, path_effects=style.EDGE,
        )  # fmt: skip
        if k:
            ax.plot([0, 1], [1, 1], transform=ax.transAxes, color="#bbbbbb", lw=0.8, clip_on=False, zorder=8)
        if k == len(cases) - 1:
            style.scale_bar(ax, 0.2 if ground.side > 0 else 0.95, 0.1, 0.15)
    names = ", ".join(style.plain(wall.name) for wall in ground.walls)
    keys = [
        ((Patch(color=style.DRY[0]), Patch(color=style.DRY[1])), "dry"),
        ((Patch(color=style.WET[0]), Patch(color=style.WET[1])), "under pore pressure"),
        ((Patch(color=style.RELEASED[0]), Patch(color=style.RELEASED[1])), "pore pressure released"),
        (Line2D([], [], **style.WATER_LINE), "water table" if free_surface is None else "free surface"),
        (Line2D([], [], color=style.WALL, lw=1.6), f"walls: {names}" if len(names) <= 24 else "walls"),
    ]
    if weakens:
        keys.append((Line2D([], [], color=style.WEAKENED, lw=3.2), "weakened"))
    handles, labels = zip(*keys)
    fig.legend(
        handles=handles, labels=labels, handler_map={tuple: HandlerTuple(ndivide=None, pad=0)}, loc="upper center",
        bbox_to_anchor=(0.5, 1 - 0.06 / total), ncol=len(keys), handlelength=2.2, columnspacing=1.8, fontsize=9.5,
    )  # fmt: skip
    return style.save(fig, path, pdf)


@given.takes(snapshot=given.SNAPSHOT, initial=given.SNAPSHOT, walls=given.WALLS)
@style.styled
def deposit(snapshot, initial, walls, path=None, pdf=False):
    """The deposit with its layers over the initial profile.

    ``snapshot``, ``initial``: the final and the first :class:`~nonsmooth.records.Snapshot`. Annotated: the greatest
    vertical thickness (:func:`~nonsmooth.measure.surface.deposit_profile`), the travel of the front
    (:func:`~nonsmooth.measure.fronts.front`) and of the centre of mass.
    """
    ground = ground_of(walls)
    x0, x1, y0, y1 = style.view([snapshot, initial], ground)
    extent, side = x1 - x0, ground.side
    y0 -= 0.14 * (y1 - y0)
    width = 12.5
    height = width * (y1 - y0) / (x1 - x0)
    fig = style.figure(width, height + 0.55)
    ax = fig.add_axes([0, 0, 1, height / (height + 0.55)])
    style.frame(ax, x0, x1, y0, y1)
    style.draw_walls(ax, ground)
    style.draw_disks(ax, snapshot, style.layer_colours(snapshot.layer))
    x, _, surface = deposit_profile(initial, ground)
    ax.plot(x, surface, color=INK, lw=1.4, ls=(0, (4, 2)), zorder=6)

    x, base, surface = deposit_profile(snapshot, ground)
    thickness = surface - base
    note = {
        "fontsize": 10.5,
        "color": INK,
        "zorder": 8,
        "bbox": {"fc": "white", "ec": "none", "alpha": 0.8, "pad": 1.5},
    }
    arrow = {"arrowstyle": "<|-|>", "color": INK, "lw": 1.3, "shrinkA": 0, "shrinkB": 0}
    if np.isfinite(thickness).any():
        k = int(np.nanargmax(thickness))
        ax.annotate("", (x[k], surface[k]), (x[k], base[k]), arrowprops=arrow, zorder=8)
        ax.annotate(
            f"thickest: {style.length(thickness[k], extent)}", (x[k], surface[k]), xytext=(0, 22), textcoords="offset points",
            ha="center", arrowprops={"arrowstyle": "-", "color": INK, "lw": 0.8}, **note,
        )  # fmt: skip
    both = in_both(initial, snapshot)  # of what has been taken out nothing has come anywhere
    a, b = (front(one, side, layers=ground.mass) for one in both)
    level = y0 + 0.075 * (y1 - y0)
    for at in (a, b):
        ax.plot([at, at], [level - 0.02 * (y1 - y0), level + 0.16 * (y1 - y0)], color=INK, lw=0.9, ls=":", zorder=7)
    ax.annotate("", (b, level), (a, level), arrowprops={**arrow, "arrowstyle": "-|>"}, zorder=8)
    ax.text(
        (a + b) / 2,
        level - 0.012 * (y1 - y0),
        f"front: {style.length(side * (b - a), extent)}",
        ha="center",
        va="top",
        **note,
    )
    mass = slice(None) if ground.mass is None else np.isin(both[0].layer, ground.mass)
    centres = [np.average(np.column_stack([s.x, s.y])[mass], axis=0, weights=s.r[mass] ** 2) for s in both]
    ax.plot(*centres[0], marker="o", mfc="white", mec=INK, ms=7, mew=1.5, zorder=8)
    ax.plot(*centres[1], marker="o", mfc=INK, mec="white", ms=8, mew=1.2, zorder=8)
    ax.annotate(
        "", centres[1], centres[0], arrowprops={**arrow, "arrowstyle": "-|>", "shrinkA": 5, "shrinkB": 5}, zorder=7
    )
    along = np.hypot(*(centres[1] - centres[0]))
    style.scale_bar(ax, 0.985 if side > 0 else 0.165, 0.93, 0.15)
    layers = np.unique(snapshot.layer)[::-1]
    handles = [
        Patch(
            color=style.LAYERS[n % len(style.LAYERS)],
            label=style.plain(ground.layer(n)) + " (top)" * bool(n == layers[0]),
        )
        for n in layers
    ]
    handles.append(Line2D([], [], color=INK, lw=1.4, ls=(0, (4, 2)), label="initial surface"))
    handles.append(
        Line2D([], [], ls="", marker="o", mfc="white", mec=INK, mew=1.5, ms=6, label="centre of mass before")
    )
    # not beside the arrow, where the names of walls stand
    away = f"and after: {style.length(along, extent)} away"
    handles.append(Line2D([], [], ls="", marker="o", color=INK, ms=6, label=away))
    fig.legend(handles=handles, loc="upper center", ncol=len(handles), handlelength=1.6, columnspacing=1.4)
    return style.save(fig, path, pdf)
