"""The slope in profile: its state at the characteristic times (Figure 13) and the deposit it leaves."""

import numpy as np
from matplotlib.legend_handler import HandlerTuple
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from . import style
from .style import INK


def _time_label(label):
    """``t0`` as mathematics; anything else as it is."""
    return f"$t_{{{label[1:]}}}$" if label in style.TIME_NAMES else str(label)


def _foot(ax, snapshot, walls, view, first):
    """An inset in the empty sky with the foot of the slope, 260 m wide at the paper's size."""
    corner = style.foot(walls)
    wide = 0.17 * (corner[0] - view[0])
    x0, x1 = corner[0] - 0.75 * wide, corner[0] + 0.35 * wide
    left, right, top, bottom = 0.445, 0.79, 0.95, 0.33
    shape = (top - bottom) * (view[3] - view[2]) / ((right - left) * (view[1] - view[0]))
    y0 = corner[1] - 0.03 * wide
    y1 = y0 + shape * (x1 - x0)
    inset = ax.inset_axes([left, bottom, right - left, top - bottom], zorder=9)
    style.frame(inset, x0, x1, y0, y1)
    for spine in inset.spines.values():
        spine.set_visible(True)
    style.draw_walls(inset, walls, labels=("FB",))
    near = (np.abs(snapshot.x - (x0 + x1) / 2) < 0.6 * (x1 - x0)) & (np.abs(snapshot.y - (y0 + y1) / 2) < 0.7 * (y1 - y0))
    style.draw_disks(inset, snapshot, style.state_colours(snapshot), near)
    if snapshot.water_m > 0:
        style.water_line(inset, walls, snapshot.water_m)
    ax.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, fill=False, ec=INK, lw=0.8, zorder=6))
    if first:
        style.scale_bar(inset, 0.3, 0.07, 0.2)
        inset.text(0.97, 0.94, "foot, enlarged", transform=inset.transAxes, ha="right", va="top", fontsize=9)


@style.styled
def snapshots(cases, walls, path=None, pdf=False, close_up=True):
    """The slope at successive times, one below the other (the paper's Figure 13).

    ``cases``: list of (label, :class:`~nonsmooth.records.Snapshot`), labels such as "t0". Dry disks ochre, disks that
    feel pore pressure blue, released ones pink, shades alternating with the layers; the water table as a dashed line.
    All panels have the same limits and scale; ``close_up`` adds the foot of the slope, enlarged, to each, where the
    shear bands of the failure appear.
    """
    cases, walls = list(cases), style.as_walls(walls)
    if not cases:
        raise style.RecordsError("there is no snapshot to draw; give at least one (label, snapshot)")
    view = style.view([s for _, s in cases], walls)
    width, top, bottom = 10.5, 0.62, 0.1
    height = width * (view[3] - view[2]) / (view[1] - view[0])
    total = top + bottom + height * len(cases)
    fig = style.figure(width, total)
    for k, (label, snapshot) in enumerate(cases):
        ax = fig.add_axes([0, (bottom + height * (len(cases) - 1 - k)) / total, 1, height / total])
        style.frame(ax, *view)
        style.draw_walls(ax, walls, labels=("DP", "SS") if close_up else ("DP", "FB", "SS"))
        style.draw_disks(ax, snapshot, style.state_colours(snapshot))
        if snapshot.water_m > 0:
            style.water_line(ax, walls, snapshot.water_m)
        if close_up:
            _foot(ax, snapshot, walls, view, first=k == 0)
        meaning = style.TIME_NAMES.get(label)
        ax.text(
            0.985, 0.93, f"{_time_label(label)} = {snapshot.time_s:.1f} s" if meaning else f"{label}: {snapshot.time_s:.1f} s",
            transform=ax.transAxes, ha="right", va="top", fontsize=13, fontweight="bold", color=INK,
        )  # fmt: skip
        lines = [meaning] if meaning else []
        lines += [f"water table {snapshot.water_m:.1f} m" if snapshot.water_m > 0 else "no water"]
        lines += [f"wet {100 * (snapshot.wet & ~snapshot.released).mean():.0f} %, released {100 * snapshot.released.mean():.0f} %"]
        ax.text(
            0.985, 0.93 - 0.27 / height, "\n".join(lines), transform=ax.transAxes, ha="right", va="top", fontsize=9.5,
            linespacing=1.35, color="#444444",
        )  # fmt: skip
        if k:
            ax.plot([0, 1], [1, 1], transform=ax.transAxes, color="#bbbbbb", lw=0.8, clip_on=False, zorder=8)
        if k == len(cases) - 1:
            style.scale_bar(ax, 0.2, 0.1, 0.15)
    fig.legend(
        handles=[
            (Patch(color=pair[0]), Patch(color=pair[1])) for pair in (style.DRY, style.WET, style.RELEASED)
        ] + [Line2D([], [], color=style.WATER, ls=(0, (5, 2)), lw=1.3), Line2D([], [], color=style.WALL, lw=1.6)],
        labels=["dry", "under pore pressure", "pore pressure released", "water table", "walls: DP, FB, SS"],
        handler_map={tuple: HandlerTuple(ndivide=None, pad=0)}, loc="upper center", bbox_to_anchor=(0.5, 1 - 0.06 / total), ncol=5,
        handlelength=2.2, columnspacing=1.8, fontsize=9.5,
    )  # fmt: skip
    return style.save(fig, path, pdf)


def front_of(x, r, share=0.999):
    """Position x [m] that ``share`` of the disks' area has not passed: the front, without a few runaway disks."""
    order = np.argsort(x, kind="stable")
    area = np.cumsum(r[order] ** 2)
    at = int(np.searchsorted(area, share * area[-1]))
    return float(x[order][at] + r[order][at])


def front(snapshot, share=0.999):
    """:func:`front_of` a snapshot's disks."""
    return front_of(snapshot.x, snapshot.r, share)


def deposit_profile(snapshot, walls, bin_m=None):
    """Surface and base of the granular mass along x.

    Returns x, base, surface [m], each of shape (bins,), NaN where there is no disk (or no wall below). The surface is
    the highest point of any disk in a bin of ``bin_m`` (default: three mean diameters), the base the lowest wall at
    that x; the thickness, surface minus base, is vertical. Bins that hold less than a tenth of the mean number of
    disks are left out of the surface, so that single disks in flight do not count.
    """
    walls = style.as_walls(walls)
    bin_m = bin_m or 6 * float(snapshot.r.mean())
    low, high = (snapshot.x - snapshot.r).min(), (snapshot.x + snapshot.r).max()
    count = max(int(np.ceil((high - low) / bin_m)), 1)
    edges = low + bin_m * np.arange(count + 1)
    x = (edges[:-1] + edges[1:]) / 2
    surface = np.full(count, -np.inf)
    where = np.clip(((snapshot.x - low) / bin_m).astype(int), 0, count - 1)
    np.maximum.at(surface, where, snapshot.y + snapshot.r)
    number = np.bincount(where, minlength=count)
    surface[number < 0.1 * number[number > 0].mean()] = np.nan
    surface[~np.isfinite(surface)] = np.nan
    base = np.full(count, np.inf)
    for _, points in walls:
        for (xa, ya), (xb, yb) in zip(points[:-1], points[1:]):
            if xa == xb:
                continue
            inside = (x >= min(xa, xb)) & (x <= max(xa, xb))
            base[inside] = np.minimum(base[inside], ya + (yb - ya) * (x[inside] - xa) / (xb - xa))
    base[~np.isfinite(base)] = np.nan
    return x, base, surface


@style.styled
def deposit(snapshot, initial, walls, path=None, pdf=False):
    """The deposit with its layers over the initial profile.

    ``snapshot``, ``initial``: the final and the first :class:`~nonsmooth.records.Snapshot`. Annotated: the greatest
    vertical thickness (:func:`deposit_profile`), the travel of the front (:func:`front`) and of the centre of mass.
    """
    walls = style.as_walls(walls)
    x0, x1, y0, y1 = style.view([snapshot, initial], walls)
    y0 -= 0.14 * (y1 - y0)
    width = 12.5
    height = width * (y1 - y0) / (x1 - x0)
    fig = style.figure(width, height + 0.55)
    ax = fig.add_axes([0, 0, 1, height / (height + 0.55)])
    style.frame(ax, x0, x1, y0, y1)
    style.draw_walls(ax, walls)
    style.draw_disks(ax, snapshot, style.layer_colours(snapshot.layer))
    x, _, surface = deposit_profile(initial, walls)
    ax.plot(x, surface, color=INK, lw=1.4, ls=(0, (4, 2)), zorder=6)

    x, base, surface = deposit_profile(snapshot, walls)
    thickness = surface - base
    note = {"fontsize": 10.5, "color": INK, "zorder": 8, "bbox": {"fc": "white", "ec": "none", "alpha": 0.8, "pad": 1.5}}
    arrow = {"arrowstyle": "<|-|>", "color": INK, "lw": 1.3, "shrinkA": 0, "shrinkB": 0}
    if np.isfinite(thickness).any():
        k = int(np.nanargmax(thickness))
        ax.annotate("", (x[k], surface[k]), (x[k], base[k]), arrowprops=arrow, zorder=8)
        ax.annotate(
            f"thickest: {thickness[k]:.0f} m", (x[k], surface[k]), xytext=(0, 22), textcoords="offset points",
            ha="center", arrowprops={"arrowstyle": "-", "color": INK, "lw": 0.8}, **note,
        )  # fmt: skip
    a, b = front(initial), front(snapshot)
    level = y0 + 0.075 * (y1 - y0)
    for at in (a, b):
        ax.plot([at, at], [level - 0.02 * (y1 - y0), level + 0.16 * (y1 - y0)], color=INK, lw=0.9, ls=":", zorder=7)
    ax.annotate("", (b, level), (a, level), arrowprops={**arrow, "arrowstyle": "-|>"}, zorder=8)
    ax.text((a + b) / 2, level - 0.012 * (y1 - y0), f"front: {b - a:,.0f} m", ha="center", va="top", **note)
    centres = [np.average(np.column_stack([s.x, s.y]), axis=0, weights=s.r**2) for s in (initial, snapshot)]
    ax.plot(*centres[0], marker="o", mfc="white", mec=INK, ms=7, mew=1.5, zorder=8)
    ax.plot(*centres[1], marker="o", mfc=INK, mec="white", ms=8, mew=1.2, zorder=8)
    ax.annotate("", centres[1], centres[0], arrowprops={**arrow, "arrowstyle": "-|>", "shrinkA": 5, "shrinkB": 5}, zorder=7)
    along = np.hypot(*(centres[1] - centres[0]))
    ax.annotate(
        f"centre of mass: {along:,.0f} m", centres[0] + 0.12 * (centres[1] - centres[0]), xytext=(6, 6),
        textcoords="offset points", ha="left", va="bottom", **note,
    )  # fmt: skip
    style.scale_bar(ax, 0.985, 0.93, 0.15)
    layers = np.unique(snapshot.layer)[::-1]
    handles = [Patch(color=style.LAYERS[n % len(style.LAYERS)], label=f"layer {n + 1}") for n in layers]
    handles[0].set_label(f"layer {layers[0] + 1} (top)")
    handles.append(Line2D([], [], color=INK, lw=1.4, ls=(0, (4, 2)), label="initial surface"))
    handles.append(Line2D([], [], ls="", marker="o", mfc="white", mec=INK, mew=1.5, ms=6, label="centre of mass before"))
    handles.append(Line2D([], [], ls="", marker="o", color=INK, ms=6, label="and after"))
    fig.legend(handles=handles, loc="upper center", ncol=len(handles), handlelength=1.6, columnspacing=1.4)
    return style.save(fig, path, pdf)
