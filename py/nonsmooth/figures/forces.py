"""Forces: the chains in the slope at rest (Figure 8) and the sums on its walls against time (Figure 12)."""

import itertools

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon, Rectangle

from .. import records
from ..measure.ground import ground_of
from . import given, style
from .style import COMPRESSION, INK, LINES, TENSION

__all__ = ["SKETCHED", "force_bars", "force_chains", "forces_against_time"]

CLOSER = 2.5  # of the second window on force chains to the first one, at least
SKETCHED = {"slip": "DP", "backstop": "FB"}  # names of the paper's walls, where nobody gives others


def force_bars(snapshot, chosen, reference, width):
    """Corners (C, 4, 2) of bars from centre to centre (or to a wall's contact point), ``width`` wide at
    ``reference``.
    """
    i, j = snapshot.ci[chosen], snapshot.cj[chosen]
    a = np.column_stack([snapshot.x[i], snapshot.y[i]])
    wall = j < 0
    b = np.column_stack([snapshot.x[j], snapshot.y[j]])
    b[wall] = np.column_stack([snapshot.cx[chosen], snapshot.cy[chosen]])[wall]
    along = b - a
    across = np.column_stack([-along[:, 1], along[:, 0]]) / np.maximum(np.hypot(*along.T), 1e-12)[:, None]
    half = across * (0.5 * width * np.abs(snapshot.cn[chosen]) / reference)[:, None]
    return np.stack([a - half, b - half, b + half, a + half], axis=1)


def _close_up(ax, snapshot, ground, box, reference, width, outline, letter):
    """One window of the slope, with its ``letter``: disks as outlines, normal forces as bars."""
    x0, x1, y0, y1 = box
    style.frame(ax, *box)
    for spine in ax.spines.values():
        spine.set_visible(True)
    ax.text(
        0.02, 0.97, letter, transform=ax.transAxes, ha="left", va="top", fontsize=13, fontweight="bold",
        bbox={"fc": "white", "ec": "#999999", "lw": 0.6, "pad": 3}, zorder=9,
    )  # fmt: skip
    style.scale_bar(ax, 0.965 if ground.side > 0 else 0.21, 0.045, 0.17)
    style.draw_walls(ax, ground, size=11, width=2, apart=True)
    reach = 2 * snapshot.r.max()
    seen = (np.abs(snapshot.x - (x0 + x1) / 2) < (x1 - x0) / 2 + reach) & (
        np.abs(snapshot.y - (y0 + y1) / 2) < (y1 - y0) / 2 + reach
    )
    pale = 0.30 * style.layer_colours(snapshot.layer) + 0.70
    pale[:, 3] = 1
    style.draw_disks(ax, snapshot, pale, seen, edge="#8f8a80", width=outline)
    chosen = np.flatnonzero(seen[snapshot.ci])
    for sign, colour, z in ((1, COMPRESSION, 3), (-1, TENSION, 3.5)):
        bars = chosen[sign * snapshot.cn[chosen] > 0]
        ax.add_collection(
            PolyCollection(
                force_bars(snapshot, bars, reference, width), facecolors=colour, edgecolors=colour if sign < 0 else "none",
                linewidths=0.35 if sign < 0 else 0, zorder=z, rasterized=True,
            ),
            autolim=False,
        )  # fmt: skip


def _force_scale(ax, reference, width):
    """Handles of a legend: lines as wide as bars of round forces are in the window ``ax``, which has its place and
    limits; the largest is not above ``reference``, of ``width`` [m].
    """
    forces = [style.nice(reference)]
    while len(forces) < 3:
        forces.append(style.nice(0.6 * forces[-1]))
    newtons, unit = style.force_unit(forces[0])
    ax.apply_aspect()
    points = 72 / ax.figure.dpi * ax.get_window_extent().width / abs(np.subtract(*ax.get_xlim()))  # a metre
    return [
        Line2D(
            [],
            [],
            color=COMPRESSION,
            lw=width * force / reference * points,
            solid_capstyle="butt",
            label=f"{force / newtons:g} {unit}",
        )
        for force in forces
    ]


@given.takes(snapshot=given.SNAPSHOT, walls=given.WALLS)
@style.styled
def force_chains(snapshot, walls, path=None, pdf=False, title=None):
    """The slope and the normal forces in its foot (the paper's Figure 8).

    ``snapshot``: a :class:`~nonsmooth.records.Snapshot` with contacts. ``walls``: see :mod:`nonsmooth.figures`.
    Above the whole slope by layers; below two windows at the foot (or at the lowest disk, where none is near it), with
    bars between the centres of disks that are in contact or bonded over a gap, as wide as the force is large (linear,
    the same in both windows), compression blue, tension red. Tensile bars have a hairline outline so that small ones
    can be seen. ``title``: what state it is, as "Initial state"; None: the snapshot's time.
    """
    ground = ground_of(walls)
    if len(snapshot.ci) == 0:
        raise style.RecordsError("the snapshot has no contacts, so no forces to draw; take one written with contacts")
    corner = ground.foot
    near = np.abs(snapshot.x - corner[0]) < 0.12 * np.ptp(snapshot.x)
    if not near.any():  # a mass that begins higher up
        near = np.argmin(snapshot.y - snapshot.r)
        corner = np.array([snapshot.x[near], (snapshot.y - snapshot.r)[near]])
    height = snapshot.y[near].max() - corner[1]
    size = 2 * np.median(snapshot.r)
    aspect = 4.95 / 4.1
    wide = max(1.35 * height * aspect, 30 * size)
    tight = min(26 * size, wide / CLOSER)
    boxes = []
    for w, right, below in ((wide, 0.2, 0.07), (tight, 0.22, 0.13)):
        h = w / aspect
        ends = sorted((corner[0] - ground.side * (1 - right) * w, corner[0] + ground.side * right * w))
        boxes.append((*ends, corner[1] - below * h, corner[1] + (1 - below) * h))
    x0, x1, y0, y1 = boxes[0]
    seen = (snapshot.cx > x0) & (snapshot.cx < x1) & (snapshot.cy > y0) & (snapshot.cy < y1)
    strength = np.abs(snapshot.cn[seen if seen.any() else slice(None)])
    reference = max(float(np.quantile(strength, 0.995)), 1e-12)
    width = 0.6 * size

    fig = style.figure(10.4, 9.0)
    top = fig.add_axes([0.01, 0.505, 0.98, 0.455])
    margin = 0.02 * np.ptp(snapshot.x)
    style.frame(
        top, min(snapshot.x.min(), boxes[0][0]) - margin, max(snapshot.x.max(), boxes[0][1]) + margin,
        min(snapshot.y.min(), boxes[0][2]) - margin, snapshot.y.max() + margin,
    )  # fmt: skip
    style.draw_walls(top, ground, named=("slip",), size=11)
    style.draw_disks(top, snapshot, style.layer_colours(snapshot.layer))
    style.scale_bar(top, 0.98 if ground.side > 0 else 0.22, 0.86)
    layers = np.unique(snapshot.layer)
    named = ground.layers or [f"{k + 1}" for k in range(layers[-1] + 1)]
    handles = [
        Patch(color=style.LAYERS[k % len(style.LAYERS)], label=style.plain(named[k]) + " (top)" * bool(k == layers[-1]))
        for k in layers[::-1]
    ]
    top.legend(
        handles=handles,
        title="layer",
        loc="lower left" if ground.side > 0 else "lower right",
        bbox_to_anchor=(0.06 if ground.side > 0 else 0.94, 0.02),
        handlelength=1.3,
    )
    fig.text(
        0.5, 0.985, f"{f't = {style.seconds(snapshot.time_s, snapshot.time_s)}' if title is None else style.plain(title)}: {len(snapshot.x):,} disks, {len(snapshot.ci):,} contacts, "
        f"{int((snapshot.cn < 0).sum()):,} of them in tension", ha="center", va="top", fontsize=11.5,
    )  # fmt: skip
    for ax, box, letter in (
        (fig.add_axes([0.012, 0.035, 0.476, 0.455]), boxes[0], "a"),
        (fig.add_axes([0.512, 0.035, 0.476, 0.455]), boxes[1], "b"),
    ):
        outline = 0.25 if letter == "a" else 0.7
        _close_up(ax, snapshot, ground, box, reference, width, outline, letter)
        bx0, bx1, by0, by1 = box
        top.add_patch(Rectangle((bx0, by0), bx1 - bx0, by1 - by0, fill=False, ec=INK, lw=1.1, zorder=6))
        top.text(
            bx0 if ground.side > 0 else bx1,
            by0,
            f"{letter} " if ground.side > 0 else f" {letter}",
            va="bottom",
            ha="right" if ground.side > 0 else "left",
            fontsize=11,
            fontweight="bold",
            zorder=7,
        )
    fig.legend(
        handles=[Patch(color=COMPRESSION, label="compression"), Patch(color=TENSION, label="tension"),
                 Line2D([], [], ls="", label="normal forces of contacts and bonds; in b:"), *_force_scale(ax, reference, width)],
        loc="lower center", ncol=6, bbox_to_anchor=(0.5, -0.006), handlelength=2.2, columnspacing=1.5,
    )  # fmt: skip
    return style.save(fig, path, pdf)


def _limits(curves, shown):
    """Limits that hold every mean and nearly all of the raw values, so that single impacts do not flatten the plot."""
    means = np.concatenate([mean[shown] for _, mean in curves])
    raw = np.concatenate([np.quantile(raw[shown], [0.005, 0.995]) for raw, _ in curves])
    low, high = min(means.min(), raw.min(), 0), max(means.max(), raw.max(), 0)
    pad = 0.06 * (high - low or 1)
    return low - pad, high + pad


def _own(series, ground):
    """(name, total normal force, effective one, shear force [N/m]) of each slip surface where some lie one above
    another; empty where none do, and for a series without columns of each.
    """
    names = ("dp_normal_total_N_per_m", "dp_normal_effective_N_per_m", "dp_shear_N_per_m")
    columns = {wall: [records.column(name, wall) for name in names] for wall in ground.stacked}
    if not all(column in series for of in columns.values() for column in of):
        return []
    return [(wall, *style.need(series, *of)) for wall, of in columns.items()]


def _sketch(ax, side, name, back, wet, rise=None, coloured=True):
    """What the symbols mean: a slope with the forces its walls exert (the inset of Figure 12); ``back``: name of the
    backstop, empty where there is none; ``rise``: of a water table that is a plane of its own, over its way down the
    slope, 0 where it is level; ``coloured``: whether a colour is a force's. Names that are no index have no room.
    """

    def symbol(letter, of):
        told = style.symbol(letter, of)
        return told if " (" not in told else f"${letter}$"

    style.frame(ax, *sorted((-10.8 * side, 4.6 * side)), -1.6, 6.6)

    def at(points):
        return np.asarray(points) * (side, 1)

    slope, after = np.tan(np.radians(21)), "left" if side > 0 else "right"
    plane = np.array([[-10, 10 * slope], [0, 0]])
    wall = np.array([[0, 0], [1.0, 2.6]])
    ax.add_patch(Polygon(at([plane[0], plane[1], wall[1], (-10, 10 * slope + 1.9)]), fc="#ead9b5", ec="none"))
    ax.plot(*at(np.vstack([plane, wall, [4.4, 2.4]] if back else [plane, [4.4, -0.4]])).T, color=style.WALL, lw=1.5)
    if wet and rise is None:
        water = plane + 0.85 * np.array([np.sin(np.radians(21)), np.cos(np.radians(21))])
        ax.plot(*at(water).T, color=style.WATER, lw=1.2, ls=(0, (4, 2)))
        ax.text(*at((-10.4, 4.75)), "$h_w$", color=style.WATER, ha="center", va="center", fontsize=9)
    elif wet:
        # from where it meets the slip surface, as far as the backstop, or out over the valley
        low, rise = 1.6, max(rise, 0.2 - slope)
        begin, end = -low / (slope + rise), 0.62 if back else 4.0
        water = np.array([[begin, low + rise * begin], [end, low + rise * end]])
        ax.plot(*at(water).T, color=style.WATER, lw=1.2, ls=(0, (4, 2)))
        ax.text(*at(water[1] + (0.35, 0.75)), "$h_w$", color=style.WATER, ha="center", va="center", fontsize=9)
    blue, orange = (LINES[colour] if coloured else INK for colour in ("blue", "orange"))
    arrow = {"arrowstyle": "-|>", "lw": 1.4, "shrinkA": 0, "shrinkB": 0}
    normal, down = np.array([0.358, 0.934]), np.array([0.934, -0.358])
    middle = np.array([-5.2, 5.2 * slope])
    ax.annotate("", at(middle), at(middle - 2.0 * normal), arrowprops={**arrow, "color": blue})
    ax.text(*at(middle - 2.6 * normal), symbol("N", name), ha="center", va="center", color=blue, fontsize=9.5)
    start = middle + 2.4 * down - 0.32 * normal
    ax.annotate("", at(start - 1.9 * down), at(start), arrowprops={**arrow, "color": orange})
    ax.text(
        *at(start + 0.1 * down - 0.75 * normal), symbol("T", name), ha=after, va="center", color=orange, fontsize=9.5
    )
    if back:
        push = wall.mean(axis=0)
        ax.annotate(
            "", at(push), at(push + 2.0 * np.array([0.93, -0.36])), arrowprops={**arrow, "color": LINES["green"]}
        )
        ax.text(*at(push + (2.1, -1.1)), symbol("N'", back), ha=after, va="center", color=LINES["green"], fontsize=9.5)


@given.takes(series=given.SERIES)
@style.styled
def forces_against_time(series, times, path=None, pdf=False, window=1.0, walls=None, verdict=None):
    """Forces on the slip surfaces and the backstops against time (the paper's Figure 12).

    ``series``: dict of columns (:func:`nonsmooth.records.read_series`). ``times``: dict t0 to t5 [s], or an object
    with such ``times``; missing ones are left out. ``walls``: see :mod:`nonsmooth.figures`; without them, they have the
    paper's names. (a) normal force on the slip surfaces (DP): total, effective, water, and the height of
    the water table (right axis); (b) shear force on them, normal force on the backstops (FB), and their changes since
    t0. What a slope has not, a backstop or water, is left out. Of slip surfaces one above another, which bear the same
    weight, each has lines of its own, without changes. On the left the whole run, on the right the failure and
    triggering alone (when t1 and t3 are known). Lines are means over ``window`` [s] once the avalanche moves (from t3),
    every value is drawn pale behind. ``verdict``: what became of the slope, in words.
    """
    time, water, total, effective, pore, shear, back = style.need(
        series, "time_s", "water_m", "dp_normal_total_N_per_m", "dp_normal_effective_N_per_m", "dp_water_N_per_m",
        "dp_shear_N_per_m", "fb_normal_N_per_m",
    )  # fmt: skip
    t = style.known_times(times)
    start = int(np.argmin(np.abs(time - t.get("t0", time[0]))))
    moving = t.get("t3", np.inf)

    ground = None if walls is None else ground_of(walls)
    name, rest = (SKETCHED[role] if ground is None else ground.name(role) for role in ("slip", "backstop"))
    base = SKETCHED["slip"] if ground is None else ground.base
    wet = bool(np.any(water > 0) or np.any(pore))
    head = getattr(walls, "water_field", None) is not None  # of a field of water, and no table's height
    told = f"mean pressure head on {style.plain(name)}" if head else "$h_w$  water table"
    own = [] if ground is None else _own(series, ground)
    largest = max(np.abs(values).max() for values in (total, shear, back, *(force for one in own for force in one[1:])))
    newtons, unit = style.force_unit(largest)

    def curve(values):
        values = values / newtons
        return values, np.where(time > moving, style.running_mean(time, values, window), values)

    of = style.symbol
    effect, change, push, push_change = of("N'", name), of(r"\Delta T", name), of("N'", rest), of(r"\Delta N'", rest)
    dashed = (0, (3, 1.2))
    if own:
        colours = dict(zip((one[0] for one in own), itertools.cycle(style.STACKED)))

        def of_wall(letter, wall, what):
            return f"${letter}$  {what} on {style.plain(wall)}"

        normal = [(of_wall("N", wall, "total"), curve(force), colours[wall], "-") for wall, force, _, _ in own]
        normal += [
            (of_wall("N'", wall, "effective"), curve(force), colours[wall], dashed) for wall, _, force, _ in own if wet
        ]
        other = [(of_wall("T", wall, "shear"), curve(force), colours[wall], "-") for wall, _, _, force in own]
        if rest:
            other.append((of_wall("N'", rest, "normal"), curve(back), LINES["green"], "-"))
    else:
        normal = [
            (f"{of('N', name)}  total", curve(total), LINES["blue"], "-"),
            (f"{effect}  effective", curve(effective), LINES["orange"], "-"),
            (f"{of('U', name)}  water pressure", curve(pore), LINES["sky"], "-"),
        ] if wet else [(f"{of('N', name)}  normal on {style.plain(name)}", curve(total), LINES["blue"], "-")]  # fmt: skip
        other = [
            (f"{of('T', name)}  shear on {style.plain(name)}", curve(shear), LINES["orange"], "-"),
            (f"{change}  since $t_0$", curve(shear - shear[start]), LINES["orange"], dashed),
        ]
        if rest:
            other.insert(1, (f"{push}  normal on {style.plain(rest)}", curve(back), LINES["green"], "-"))
            other.append((f"{push_change}  since $t_0$", curve(back - back[start]), LINES["green"], dashed))
    spans = [(time[0], max(time[-1], time[0] + 1e-9))]
    if "t1" in t and "t3" in t:
        d = max(t["t3"] - t["t1"], 0.03 * (spans[0][1] - spans[0][0]), 1e-9)
        spans.append((max(time[0], t["t1"] - 0.45 * d), min(time[-1], t["t3"] + 0.45 * d)))

    fig = style.figure(12.4, 8.6)
    lefts, widths = ([0.062, 0.685], [0.595, 0.255]) if len(spans) == 2 else ([0.062], [0.878])
    fig.text(
        0.062,
        0.975,
        f"Forces on {style.plain(name)} (slip surface{'s, each for itself' if own else ''})"
        + f" and {style.plain(rest)} (backstop)" * bool(rest),
        fontsize=13,
        va="top",
    )
    fig.text(
        0.062, 0.938, "per metre of width. " + (f"From $t_3$ on: lines are means over {window:g} s, pale: every value."
        if "t3" in t else "Every value is shown.") + (f" {verdict[0].upper()}{verdict[1:]}." if verdict else ""), fontsize=9.5, color="#555555", va="top",
    )  # fmt: skip
    rise = None if ground is None or ground.table_slope is None else ground.side * ground.table_slope
    _sketch(
        fig.add_axes([0.71, 0.865, 0.23, 0.135]), 1.0 if ground is None else ground.side, name, rest, wet, rise, not own
    )
    legend = []
    for column, (span, left, width) in enumerate(zip(spans, lefts, widths)):
        strip = fig.add_axes([left, 0.795, width, 0.03])
        strip.set_xlim(span)
        style.shade_phases(strip, t, names=True)
        strip.set_axis_off()
        for row, (lines, bottom) in enumerate(((normal, 0.45), (other, 0.065))):
            ax = fig.add_axes([left, bottom, width, 0.30])
            ax.set_xlim(span)
            style.shade_phases(ax, t)
            style.mark_times(ax, t, labels=row == 0, gap=0.022 * 0.595 / width)
            for label, (raw, mean), colour, dash in lines:
                late = time > moving
                if "since" not in label:  # the changes have the same scatter
                    ax.plot(time[late], raw[late], color=colour, lw=0.5, alpha=0.25, zorder=2)
                wide = (
                    3.2 if "total" in label and not own else 1.5
                )  # seen behind the effective force where they are equal
                ax.plot(time, mean, color=colour, ls=dash, lw=wide, label=label, zorder=3 + (wide < 2))
            ax.set_ylim(_limits([c for _, c, _, _ in lines], slice(None)))
            ax.axhline(0, color="#555555", lw=0.7, zorder=1.5)
            if column == 0:
                ax.set_ylabel(f"force [{unit}]")
                fig.text(
                    0.012, bottom + 0.325, "(a)" if row == 0 else "(b)", fontsize=12, fontweight="bold", va="center"
                )
                legend.append(ax.get_legend_handles_labels())
            else:
                ax.tick_params(labelleft=False)
            if row == 1:
                ax.set_xlabel("time [s]" if column == 0 else "time [s], failure and triggering enlarged")
            elif wet:
                table = ax.twinx()
                table.plot(time, water, color=INK, lw=1.1, ls=(0, (1, 1.2)), label=f"{told} (right axis)")
                # The same zero on both axes.
                low, high = ax.get_ylim()
                top = 1.25 * max(water.max(), 1e-9)
                table.set_ylim(top * low / high, top)
                table.set_yticks([v for v in table.get_yticks() if 0 <= v <= top])
                if column == len(spans) - 1:
                    over = f"water table above {style.plain(base)} [m]" if base else "water table [m]"
                    table.set_ylabel("mean pressure head [m]" if head else over)
                    table.spines["right"].set_visible(True)
                    handles, labels = table.get_legend_handles_labels()
                    legend[0] = (legend[0][0] + handles, legend[0][1] + labels)
                else:
                    table.tick_params(labelright=False, right=False)
    for (handles, labels), y in zip(legend, (0.866, 0.388)):
        fig.legend(
            handles, labels, loc="center left", bbox_to_anchor=(0.055, y), ncol=4, handlelength=2.4, columnspacing=1.6
        )
    return style.save(fig, path, pdf)
