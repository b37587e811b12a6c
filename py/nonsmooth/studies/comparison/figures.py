"""Figures of a comparison. Each takes data and the path of a PNG, which it returns, or the Figure without one; hard is
blue, soft orange, stiffer contacts darker.
"""

from __future__ import annotations

import numpy as np
from matplotlib.patches import Patch
from matplotlib.path import Path as Outline
from matplotlib.patches import PathPatch
from matplotlib.transforms import Bbox

from ...figures import style
from ...figures.style import INK, LINES
from ...measure.ground import ground_of
from .cases import modulus_label

__all__ = [
    "convergence",
    "cost",
    "cost_and_overlap",
    "courses",
    "deposits_overlaid",
    "force_distribution",
    "modes",
    "network",
    "overlaps",
    "work_precision",
]

HARD, SOFT, BOTH = LINES["blue"], LINES["orange"], "#b9b9c9"
SHADES = ("#f6c28b", "#ee9a4d", "#D55E00", "#8f3c00", "#4d1f00", "#2b1100")  # soft, from the softest to the stiffest
MARKS = {"hard": "o", "soft": "s"}


def shade(modulus, moduli):
    """Colour of a stiffness among ``moduli``."""
    order = sorted(moduli)
    return SHADES[min(len(SHADES) - 1, round(order.index(modulus) * (len(SHADES) - 2) / max(1, len(order) - 1)))]


def _patch(geometry, **options):
    vertices, codes = [], []
    for polygon in getattr(geometry, "geoms", [geometry]):
        if polygon.is_empty or polygon.geom_type != "Polygon":
            continue
        for ring in (polygon.exterior, *polygon.interiors):
            points = np.asarray(ring.coords)
            vertices.append(points)
            codes.append(np.r_[Outline.MOVETO, np.full(len(points) - 2, Outline.LINETO), Outline.CLOSEPOLY])
    if not vertices:
        return None
    return PathPatch(Outline(np.vstack(vertices), np.concatenate(codes)), **options)


@style.styled
def deposits_overlaid(hard, soft, begin, walls, share, path=None):
    """Both deposits over each other; ``hard``, ``soft``: outlines; ``begin``: outline before, or None; ``share``: of
    the area that both cover.
    """
    both = hard.intersection(soft)
    boxes = np.array([g.bounds for g in (hard, soft, *([begin] if begin is not None else []))])
    (x0, y0), (x1, y1) = boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)
    dx, dy = 0.02 * (x1 - x0), 0.06 * (y1 - y0)
    width = 11.0
    height = max(2.0, min(6.0, width * (y1 - y0 + 2 * dy) / (x1 - x0 + 2 * dx)))
    fig = style.figure(width, height + 0.5)
    ax = fig.add_axes([0, 0, 1, height / (height + 0.5)])
    style.frame(ax, x0 - dx, x1 + dx, y0 - dy, y1 + dy)
    style.draw_walls(ax, ground_of(walls))
    for geometry, colour, order in (
        (hard.difference(both), HARD, 2),
        (soft.difference(both), SOFT, 2),
        (both, BOTH, 2.1),
    ):
        patch = _patch(geometry, fc=colour, ec="none", zorder=order)
        if patch is not None:
            ax.add_patch(patch)
    handles = [
        Patch(color=BOTH, label=f"both: {100 * share:.0f} % of the area of either"),
        Patch(color=HARD, label="hard alone"),
        Patch(color=SOFT, label="soft alone"),
    ]
    if begin is not None:
        ax.add_patch(_patch(begin, fc="none", ec=INK, lw=0.9, ls=(0, (4, 2)), zorder=3))
        handles.append(Patch(fc="none", ec=INK, ls="--", label="before"))
    style.scale_bar(ax, 0.2, 0.06, 0.15)  # in the ground, where no deposit comes
    fig.legend(handles=handles, loc="upper center", ncol=len(handles))
    return style.save(fig, path)


@style.styled
def courses(groups, columns, abscissa, path=None):
    """Curves of many runs, one panel a column.

    ``groups``: list of (label, colour, list of {name: array}); runs of a group have one colour, the first line of it
    the label. ``columns``: list of (name, label of the axis, factor); ``abscissa``: (name, label, factor).
    """
    fig = style.figure(9.5, 1.0 + 2.3 * len(columns), layout="constrained")
    axes = np.atleast_1d(fig.subplots(len(columns), 1, sharex=True))
    for ax, (name, label, factor) in zip(axes, columns):
        for title, colour, runs in groups:
            for k, run in enumerate(runs):
                if name in run:
                    ax.plot(
                        abscissa[2] * np.asarray(run[abscissa[0]]),
                        factor * np.asarray(run[name]),
                        color=colour,
                        lw=1.6 if len(runs) == 1 else 1.0,
                        alpha=1.0 if len(runs) == 1 else 0.75,
                        label=title if k == 0 else None,
                    )
        ax.set_ylabel(label)
        ax.grid(color="#e3e3e3", lw=0.7)
        ax.set_axisbelow(True)
    axes[-1].set_xlabel(abscissa[1])
    axes[0].legend(loc="lower left", bbox_to_anchor=(0, 1.0), ncol=min(4, len(groups)))
    return style.save(fig, path)


@style.styled
def force_distribution(groups, path=None):
    """P(N/⟨N⟩) of the contacts under compression; ``groups``: list of (label, colour, forces [N/m])."""
    fig = style.figure(7.5, 4.8, layout="constrained")
    ax = fig.subplots()
    edges = np.linspace(0, 8, 33)
    at = 0.5 * (edges[1:] + edges[:-1])
    for label, colour, forces in groups:
        if len(forces):
            density, _ = np.histogram(forces / np.mean(forces), edges, density=False)
            seen = density > 0
            ax.plot(
                at[seen],
                (density / len(forces) / (edges[1] - edges[0]))[seen],
                color=colour,
                marker="o",
                ms=3,
                label=f"{label} ({len(forces)} contacts)",
            )
    ax.set_yscale("log")
    ax.set_xlabel("normal force over its mean, N/⟨N⟩")
    ax.set_ylabel("probability density P(N/⟨N⟩)")
    ax.grid(color="#e3e3e3", lw=0.7)
    ax.legend()
    return style.save(fig, path)


@style.styled
def modes(groups, path=None):
    """Broken bonds by mode as parts of all bonds; ``groups``: list of (label, colour, {mode: list over seeds})."""
    names = ("tension", "shear", "torque", "mixed")
    fig = style.figure(8.5, 4.2, layout="constrained")
    ax = fig.subplots()
    wide = 0.8 / len(groups)
    for k, (label, colour, counts) in enumerate(groups):
        means = [100 * float(np.mean(counts[n])) for n in names]
        spread = [100 * float(np.std(counts[n], ddof=1)) if len(counts[n]) > 1 else 0.0 for n in names]
        ax.bar(
            np.arange(len(names)) + (k + 0.5) * wide - 0.4,
            means,
            0.94 * wide,
            color=colour,
            yerr=spread if any(spread) else None,
            ecolor=INK,
            capsize=2,
            label=label,
        )
    ax.set_xticks(range(len(names)), ("tension", "shear", "torque", "several at once,\nor not known"))
    ax.set_ylabel("broken bonds [% of those made]")
    ax.legend()
    return style.save(fig, path)


def _log_axes(fig, xlabel, ylabel):
    ax = fig.subplots()
    ax.set(xscale="log", yscale="log")
    ax.set_xlabel(xlabel)
    ax.set_ylabel(ylabel)
    ax.grid(color="#e3e3e3", lw=0.7)
    return ax


@style.styled
def overlaps(moduli, rest, moving, hard_rest, hard_moving, path=None, when=("at rest", "while moving")):
    """Mean overlaps [mean diameters] against stiffness [Pa], the hard run's as lines (drawn at 1e-12 where they are
    less); ``when``: names of both states.
    """
    fig = style.figure(7.5, 4.8, layout="constrained")
    ax = _log_axes(fig, "Young's modulus [Pa]", "mean overlap [mean diameters]")
    for values, dash, mark, name in ((moving, "-", "s", when[1]), (rest, (0, (4, 2)), "o", when[0])):
        ax.plot(moduli, values, color=SOFT, ls=dash, marker=mark, label=f"soft, {name}")
    for value, dash, name in ((hard_moving, "-", when[1]), (hard_rest, (0, (4, 2)), when[0])):
        ax.axhline(max(value, 1e-12), color=HARD, ls=dash, label=f"hard, {name}: {value:.1e}")
    ax.legend()
    return style.save(fig, path)


@style.styled
def cost(moduli, rates, steps, hard_rate, hard_steps, path=None):
    """Wall time and number of steps for a second of simulation, against stiffness."""
    fig = style.figure(9.5, 4.2, layout="constrained")
    for ax, values, level, label in zip(
        fig.subplots(1, 2),
        (rates, steps),
        (hard_rate, hard_steps),
        ("wall time for a second of simulation [s]", "steps in a second of simulation"),
    ):
        ax.plot(moduli, values, color=SOFT, marker="s", label="soft")
        ax.axhline(level, color=HARD, label=f"hard: {level:.3g}")
        ax.set(xscale="log", yscale="log")
        ax.set_xlabel("Young's modulus [Pa]")
        ax.set_ylabel(label)
        ax.grid(color="#e3e3e3", lw=0.7)
        ax.legend()
    return style.save(fig, path)


@style.styled
def cost_and_overlap(panels, path=None):
    """Wall time for a second of simulation against mean overlap.

    ``panels``: list of (title, hard, [soft, …], factor) with dictionaries as cost.measure_hard and measure_soft return,
    softest first, and soft over hard at equal overlap (None: not known).
    """
    fig = style.figure(11, 4.8, layout="constrained")
    for ax, (title, hard, soft, factor) in zip(
        np.atleast_1d(fig.subplots(1, len(panels), sharex=True, sharey=True)), panels
    ):
        x, y = [s["overlap_mean_rel"] for s in soft], [s["rate"] for s in soft]
        ax.plot(x, y, color=SOFT, marker=MARKS["soft"], label="soft")
        for s in soft:
            ax.annotate(
                modulus_label(s["stiffness_Pa"]),
                (s["overlap_mean_rel"], s["rate"]),
                xytext=(6, 4),
                textcoords="offset points",
                fontsize=8,
                color=SOFT,
            )
        ax.plot([hard["overlap_mean_rel"]], [hard["rate"]], color=HARD, marker=MARKS["hard"], ms=8, ls="", label="hard")
        if factor:
            rate = factor * hard["rate"]
            ax.plot([x[-1], hard["overlap_mean_rel"]], [y[-1], rate], color=SOFT, ls=(0, (4, 2)), lw=1.0)
            ax.plot([hard["overlap_mean_rel"]] * 2, [hard["rate"], rate], color=INK, lw=0.9)
            ax.annotate(
                f"× {factor:.3g}",
                (hard["overlap_mean_rel"], np.sqrt(rate * hard["rate"])),
                xytext=(6, 0),
                textcoords="offset points",
            )
        ax.set(xscale="log", yscale="log")
        ax.margins(x=0.15, y=0.12)
        ax.set_title(title)
        ax.set_xlabel("mean overlap [mean diameters]")
        ax.grid(color="#e3e3e3", lw=0.7)
        ax.legend()
    fig.axes[0].set_ylabel("wall time for a second of simulation [s]")
    return style.save(fig, path)


@style.styled
def work_precision(panels, chance, path=None):
    """Error against wall time.

    ``panels``: list of (title, hard, soft, aside), each but the title a list of (wall [s], error, label); ``aside``:
    soft runs with open marks; ``chance``: scatter, NaN or None where unknown.
    """
    fig = style.figure(11, 5.2, layout="constrained")
    chance = chance if chance and np.isfinite(chance) else None
    panels = [(title, *(_drawable(points) for points in groups)) for title, *groups in panels]
    panes = list(zip(np.atleast_1d(fig.subplots(1, len(panels), sharex=True, sharey=True)), panels))
    for ax, (title, hard, soft, aside) in panes:
        for world, points, colour, name in (
            ("hard", hard, HARD, "hard"),
            ("soft", soft, SOFT, "soft"),
            ("soft", aside, SOFT, "soft, other bonds"),
        ):
            if not points:
                continue
            ax.plot(
                [p[0] for p in points],
                [p[1] for p in points],
                color=colour,
                ls="",
                marker=MARKS[world] if name == world else "D",
                ms=7,
                mfc=colour if name == world else "none",
                label=name,
            )
        if chance:
            ax.axhspan(1e-12, chance, color="#eeeeee", zorder=0)
            ax.axhline(chance, color=LINES["grey"], ls=(0, (4, 2)), label="scatter over seeds")
        ax.set(xscale="log", yscale="log")
        ax.margins(x=0.25)
        ax.set_title(title)
        ax.set_xlabel("wall time of the run's steps [s]")
        ax.grid(color="#e3e3e3", lw=0.7, which="both")
        ax.legend(loc="best")
    values = [p[1] for _, *groups in panels for points in groups for p in points] + ([chance] if chance else [])
    if values:  # of all panels, as they share the axis
        fig.axes[0].set_ylim(0.4 * min(values), 2.5 * max(values))
    fig.axes[0].set_ylabel("error (see text)")
    fig.draw_without_rendering()  # now places are final
    for ax, (_, hard, soft, aside) in panes:
        _name_points(ax, [(p, HARD) for p in hard] + [(p, SOFT) for p in (*soft, *aside)], chance)
    return style.save(fig, path)


def _drawable(points):
    """Those with an error that a logarithm has."""
    return [p for p in points if p[1] is not None and np.isfinite(p[1]) and p[1] > 0]


def _name_points(ax, named, level=None):
    """Writes the labels of ``named``, pairs ((x, y, label), colour), beside their points, clear of points, other
    labels, the legend and the line at ``level``.
    """
    taken = [
        Bbox.from_extents(x - 5, y - 5, x + 5, y + 5) for x, y in ax.transData.transform([p[:2] for p, _ in named])
    ] + [ax.get_legend().get_window_extent()]
    if level:
        y = ax.transData.transform((ax.get_xlim()[0], level))[1]
        taken.append(Bbox.from_extents(ax.bbox.xmin, y - 1, ax.bbox.xmax, y + 1))
    away = {"left": 7, "right": -7, "bottom": 2, "top": -2}
    for (x, y, label), colour in named:
        text = None
        for ha, va in (
            ("left", "bottom"),
            ("left", "top"),
            ("right", "bottom"),
            ("right", "top"),
            ("left", "bottom"),
        ):  # the first again where none is free
            if text:
                text.remove()
            text = ax.annotate(
                label,
                (x, y),
                xytext=(away[ha], away[va]),
                textcoords="offset points",
                fontsize=7.5,
                color=colour,
                ha=ha,
                va=va,
            )
            box = text.get_window_extent()
            if box.count_overlaps(taken) == 0 and ax.bbox.xmin < box.xmin and box.xmax < ax.bbox.xmax:
                break
        taken.append(box)


@style.styled
def convergence(moduli, rows, path=None):
    """Differences from the hard run against stiffness, a panel for each of ``rows``: (title, differences, scatter or
    None, power or None, scale or None).
    """
    across = 3
    down = -(-len(rows) // across)
    fig = style.figure(11, 0.6 + 2.5 * down, layout="constrained")
    axes = np.atleast_1d(fig.subplots(down, across, sharex=True)).ravel()
    for ax, (title, differences, chance, power, scale) in zip(axes, rows):
        d = np.array([np.nan if v is None else v for v in differences], float)
        good = np.isfinite(d) & (d > 0)
        ax.plot(np.asarray(moduli)[good], d[good], color=SOFT, marker="s", ls="")
        if power is not None and scale is not None:
            ax.plot(
                moduli,
                scale * np.asarray(moduli) ** power,
                color=SOFT,
                lw=0.9,
                ls=(0, (4, 2)),
                label=rf"$\propto E^{{{power:.2f}}}$",
            )
        if chance:
            ax.axhline(chance, color=LINES["grey"], lw=0.9, label="scatter over seeds")
        ax.set(xscale="log", yscale="log")
        ax.set_title(title, fontsize=9)
        ax.grid(color="#e3e3e3", lw=0.7)
        if ax.get_legend_handles_labels()[0]:
            ax.legend(fontsize=7.5)
    for ax in axes[len(rows) :]:
        ax.set_visible(False)
    for ax in axes[max(0, len(rows) - across) : len(rows)]:
        ax.set_xlabel("Young's modulus [Pa]")
        # above an empty place of the grid too, where the shared axis would leave them to that
        ax.tick_params(labelbottom=True)
    for ax in axes[::across]:
        ax.set_ylabel("relative difference")
    return style.save(fig, path)


@style.styled
def network(moduli, correlations, hard, path=None):
    """Correlation of normal forces at the same contacts with the hard run's; ``hard``: list of (label, correlation) of
    other hard runs.
    """
    fig = style.figure(7.5, 4.2, layout="constrained")
    ax = fig.subplots()
    ax.plot(moduli, [np.nan if c is None else c for c in correlations], color=SOFT, marker="s", label="soft")
    for k, (label, value) in enumerate(hard):
        if value is not None:
            ax.axhline(value, color=HARD, lw=1.0, ls=("-", "--", ":", "-.")[k % 4], label=label)
    ax.set_xscale("log")
    ax.set_ylim(top=1.02)
    ax.set_xlabel("Young's modulus [Pa]")
    ax.set_ylabel("correlation of contact forces with the hard run's")
    ax.grid(color="#e3e3e3", lw=0.7)
    ax.legend(fontsize=8)
    return style.save(fig, path)
