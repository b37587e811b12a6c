"""A slope beside its control runs: how far it goes and what it leaves, its forces against the water that fails it, and
its speed with the times that other rules would give.
"""

import numpy as np
from matplotlib.lines import Line2D

from ..measure import centroid
from ..measure.characteristic_times import FASTER, RESTING
from ..measure.ground import ground_of
from ..measure.surface import deposit_profile
from ..system import checks
from . import given, style
from .forces import SKETCHED

__all__ = ["displacement", "forces_against_water", "speeds", "with_and_without"]

THIN, ALPHA = 0.9, 0.75  # of lines of single packings
LEADS = 5.0  # s before t2 that the onset is drawn from
MEGA = 1e6
LINES = given.cases("(series, t0)", given.SERIES, checks.real(""))


def displacement(series, t0):
    """Time since t0 [s] and way of the centre of mass since then [m], (rows,) each, of the rows from t0 on."""
    t, *_ = style.need(series, "time_s", "centroid_x_m", "centroid_y_m")
    late = t >= t0 - 1e-9
    t, x, y = (values[late] for values in (t, *centroid.path(series)))
    return t - t0, np.hypot(x - x[0], y - y[0]) if len(t) else t


@given.takes(
    cases=given.cases(
        "(label, [(series, t0)], first Snapshot, last Snapshot, walls)",
        None,
        LINES,
        given.SNAPSHOT,
        given.SNAPSHOT,
        given.WALLS,
    )
)
@style.styled
def with_and_without(cases, path=None, pdf=False):
    """Slopes beside those whose slip surface does not weaken, or with any other change: above, the way of their centres
    of mass against time, a thin line for each packing; below, what the first packing of each leaves, its layers by
    colour, over the initial surface.

    ``cases``: list of (label, [(series, t0 [s]), one a packing], initial Snapshot, final Snapshot, walls).
    """
    cases = list(cases)
    if not cases or not all(lines for _, lines, *_ in cases):
        raise style.RecordsError("there is no slope to draw; give at least one case with the series of one packing")
    grounds = [ground_of(walls) for *_, walls in cases]
    views = [style.view([start, end], ground) for (_, _, start, end, _), ground in zip(cases, grounds)]
    view = tuple(f(v[k] for v in views) for k, f in enumerate((min, max, min, max)))
    width, top = 9.0, 3.3
    height = width * (view[3] - view[2]) / (view[1] - view[0])
    total = top + height * len(cases) + 0.1
    fig = style.figure(width, total)
    ax = fig.add_axes([0.085, 1 - (top - 0.55) / total, 0.9, (top - 0.75) / total])
    colours = [style.LINES[name] for name in ("orange", "blue", "green", "purple", "sky", "grey")]
    for k, (label, lines, *_) in enumerate(cases):
        for n, (series, t0) in enumerate(lines):
            ax.plot(
                *displacement(series, t0),
                color=colours[k % len(colours)],
                lw=THIN,
                alpha=ALPHA,
                label=style.plain(label) if n == 0 else None,
            )
    ax.set(xlabel="time since the water began to rise [s]", ylabel="way of the centre of mass [m]")
    ax.set_ylim(bottom=0)
    ax.grid(color="#e3e3e3", lw=0.7)
    ax.legend(loc="upper left")
    for k, ((label, _, start, end, _), ground) in enumerate(zip(cases, grounds)):
        below = fig.add_axes([0, (0.1 + height * (len(cases) - 1 - k)) / total, 1, height / total])
        style.frame(below, *view)
        style.draw_walls(below, ground, named=("slip", "ground", "backstop"))
        style.draw_disks(below, end, style.layer_colours(end.layer))
        x, _, surface = deposit_profile(start, ground)
        below.plot(x, surface, color=style.INK, lw=1.2, ls=(0, (4, 2)), zorder=6)
        right = ground.side > 0
        below.text(
            0.985 if right else 0.015, 0.93, f"{style.plain(label)}, at {end.time_s:.0f} s", transform=below.transAxes, ha="right" if right else "left", va="top",
            fontsize=12, fontweight="bold", color=colours[k % len(colours)], zorder=8, path_effects=style.EDGE,
        )  # fmt: skip
        if k == len(cases) - 1:
            style.scale_bar(below, 0.2 if right else 0.95, 0.08, 0.15)
    return style.save(fig, path, pdf)


@given.takes(cases=given.cases("(series, times, friction)", given.SERIES, given.TIMES, checks.real("")))
@style.styled
def forces_against_water(cases, path=None, pdf=False, toe=None, walls=None):
    """The force on the backstops and the shear force on the slip surfaces against the height of the water table, from
    where it begins to rise until the slope accelerates: a thin line for each packing (the paper's section 6.1).

    ``cases``: list of (series, times t0 … t5 [s], friction of the slip surface). Dashed, of the mean dry slope: what
    its equations (19) to (21) say; they hold the friction of the slip surface for used up from the beginning on.
    ``walls``: a Section, for the names of its walls (those of the paper where it is left out). ``toe``: a
    :class:`~nonsmooth.measure.toe.Toe`, whose resistance, Rankine's passive limit of the foot, is dotted.
    """
    cases = [(series, style.known_times(times), friction) for series, times, friction in cases]
    cases = [one for one in cases if {"t0", "t2"} <= set(one[1])]
    if not cases:
        raise style.RecordsError(
            "no slope came to accelerate under rising water; give those of runs that have t0 and t2"
        )
    fig = style.figure(7.2, 5.2, layout="constrained")
    ax = fig.subplots()
    kinds = (("fb_normal_N_per_m", "green"), ("dp_shear_N_per_m", "blue"))
    dry, pulls, highest = [], [], 0.0
    for series, times, friction in cases:
        t, height, normal, water, push, shear = style.need(
            series,
            "time_s",
            "water_m",
            "dp_normal_total_N_per_m",
            "dp_water_N_per_m",
            "fb_normal_N_per_m",
            "dp_shear_N_per_m",
        )
        rising = (t >= times["t0"] - 1e-9) & (t <= times["t2"] + 1e-9)
        for (name, colour), values in zip(kinds, (push, shear)):
            ax.plot(height[rising], values[rising] / MEGA, color=style.LINES[colour], lw=THIN, alpha=ALPHA)
            if "t1" in times:
                k = int(np.searchsorted(t, times["t1"] - 1e-9))
                ax.plot(height[k], values[k] / MEGA, "o", ms=4, color=style.LINES[colour], zorder=5)
        first = int(np.flatnonzero(rising)[0])
        dry.append((push[first], shear[first], friction, normal[first]))
        pulls.append((height[rising], water[rising]))
        highest = max(highest, float(height[rising].max()))
    push, shear, friction, normal = np.mean(dry, axis=0)
    h = np.linspace(0, highest, 101)
    lift = np.mean([np.interp(h, *one) for one in pulls], axis=0)
    dash = {"lw": 1.6, "zorder": 4}
    ax.plot(h, (shear - friction * lift) / MEGA, color=style.INK, ls=(0, (5, 2)), **dash)
    ax.plot(h, friction * (normal - lift) / MEGA, color=style.LINES["purple"], ls=(0, (1, 1.2)), **dash)
    ax.plot(h, (push + friction * lift) / MEGA, color=style.INK, ls=(0, (5, 2)), **dash)
    names = SKETCHED if walls is None else {role: style.plain(ground_of(walls).name(role)) for role in SKETCHED}
    handles = [
        Line2D([], [], color=style.LINES["blue"], lw=1.4, label=f"shear force on {names['slip']}, each packing"),
        Line2D([], [], color=style.LINES["green"], lw=1.4, label=f"force on {names['backstop']}, each packing"),
        Line2D([], [], color=style.INK, ls="", marker="o", ms=4, label="$t_1$"),
        Line2D([], [], color=style.INK, ls=(0, (5, 2)), lw=1.6, label="(19), (21) from the dry forces"),
        Line2D([], [], color=style.LINES["purple"], ls=(0, (1, 1.2)), lw=1.6, label="(20): friction fully used"),
    ]
    if toe is not None:
        ax.plot(h, toe.resistance(h) / MEGA, color=style.LINES["orange"], ls="-.", lw=1.6, zorder=4)
        handles.append(
            Line2D([], [], color=style.LINES["orange"], ls="-.", lw=1.6, label="Rankine's passive limit of the toe")
        )
    ax.set(xlabel="height of the water table $h_w$ [m]", ylabel="force [MN/m]", xlim=(0, highest), ylim=(0, None))
    ax.grid(color="#e3e3e3", lw=0.7)
    ax.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.01), ncol=2)
    return style.save(fig, path, pdf)


@given.takes(
    cases=given.cases(
        "(series, summary with times_s, t2_by_speed_s and t5_by_speed_s)",
        given.SERIES,
        checks.holds("times_s t2_by_speed_s t5_by_speed_s", ""),
    )
)
@style.styled
def speeds(cases, path=None, pdf=False, moving=0.2):
    """Mean speeds against time from t3 on either side, a thin line for each packing: left, the onset, with the speeds
    by which t2 may be told and when each is reached for good; right, all of the motion, with the shares of the largest
    speed by which t5 may be told.

    ``cases``: list of (series, summary), the second with ``times_s``, ``t2_by_speed_s`` and ``t5_by_speed_s``
    (:func:`~nonsmooth.measure.characteristic_times.by_threshold`); ``moving``: speed of a slope that moves [m/s].
    """
    cases = [one for one in cases if one[1]["times_s"]["t3"] is not None]
    if not cases:
        raise style.RecordsError("no slope came into motion (t3); give those of runs that have")
    fig = style.figure(10.2, 4.6, layout="constrained")
    left, right = fig.subplots(1, 2)
    colours = [style.LINES[name] for name in ("sky", "green", "orange", "purple", "blue", "grey")]
    largest, ends, begins = 0.0, [], []
    for series, summary in cases:
        t, speed = style.need(series, "time_s", "speed_mean_m_per_s")
        t3 = summary["times_s"]["t3"]
        for ax in (left, right):
            ax.plot(t - t3, speed, color=style.LINES["grey"], lw=THIN, alpha=ALPHA, zorder=2)
        for k, percent in enumerate(FASTER):
            when = summary["t2_by_speed_s"][f"{percent}"]
            if when is not None:
                left.plot(when - t3, percent / 100 * moving, "o", ms=4.5, color=colours[k % len(colours)], zorder=4)
                begins.append(when - t3)
        for k, percent in enumerate(RESTING):
            when = summary["t5_by_speed_s"][f"{percent}"]
            if when is not None:
                right.plot(when - t3, percent / 100 * speed.max(), "o", ms=4.5, color=colours[k], zorder=4)
                ends.append(when - t3)
        largest = max(largest, float(speed.max()))

    def mean(name, percent):
        return [(s[name][f"{percent}"] - s["times_s"]["t3"]) for _, s in cases if s[name][f"{percent}"] is not None]

    for ax, name, percents, told in (
        (left, "t2_by_speed_s", FASTER, lambda p, v: f"{p / 100 * moving:.3g} m/s: {-np.mean(v):.1f} s before $t_3$"),
        (right, "t5_by_speed_s", RESTING, lambda p, v: f"{p} % of the largest: {np.mean(v):.1f} s after $t_3$"),
    ):
        handles = [
            Line2D([], [], ls="", marker="o", ms=5, color=colours[k % len(colours)], label=told(p, v))
            for k, p in enumerate(percents)
            if (v := mean(name, p))
        ]
        ax.legend(handles=handles, loc="upper left" if ax is left else "upper right", handletextpad=0.3)
        ax.set_xlabel("time since $t_3$ [s]")
        ax.grid(color="#e3e3e3", lw=0.7)
        ax.axvline(0, color="#555555", lw=0.8, ls=(0, (4, 3)))
    left.set(
        ylabel="mean speed [m/s]",
        xlim=(min(begins, default=0.0) - LEADS, 2.0),
        ylim=(0, 2.4 * FASTER[-1] / 100 * moving),
        title="onset: $t_2$ by a speed",
    )
    right.set(
        xlim=(min(begins, default=0.0), 1.05 * max(ends, default=1.0)),
        ylim=(0, 1.3 * largest),  # with room for the legend
        title="end: $t_5$ by a share of the largest speed",
    )
    return style.save(fig, path, pdf)
