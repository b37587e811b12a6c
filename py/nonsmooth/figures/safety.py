"""Figures of searches for the factor of safety: displacements against the factor, the failing mass, and factors against
the number of disks.
"""

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import to_rgba
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ..measure import failing_mass
from ..measure.ground import ground_of
from ..records import RecordsError
from . import given, style
from .style import INK

__all__ = ["by_disks", "displacements", "failing_mass_on_section"]

STOOD, FAILED, BRACKET, STAYS = "#2c6fae", "#b5341c", "#f0e2c4", "#d9d3c6"
SLOPES = ("#2c6fae", "#b5341c", "#4f7d3a")
APART = 1.05  # by which dots of slopes with as many disks stand apart
MARGIN = 0.12  # around the disks, of their extent
KINDS = {"stable": ("o", STOOD, "came to rest"), "failed": ("X", FAILED, "failed")}


@given.takes(trials=given.ROWS)
@style.styled
def displacements(trials, bracket=(None, None), path=None, pdf=False):
    """Displacements of the mass against the factor by which strengths are divided: at the end of each trial, mean (with
    a line along the trials that came to rest) and largest.

    ``trials``: as ``summary["trials"]`` of a search, dictionaries with ``factor``, ``verdict``, ``displacement_mean_m``
    and ``displacement_max_m`` [m]; loadings, which have no displacement, are left out. ``bracket``: the largest factor
    at which the slope stood and the smallest at which it failed, shaded; None where there is none. Raises RecordsError
    where no trial has a displacement.
    """
    moved = [one for one in trials if one.get("displacement_mean_m") is not None]
    if not moved:
        raise RecordsError("trials: none has a displacement; a search draws them once the slope has stood")
    fig = style.figure(6.4, 4.2)
    ax = fig.add_axes([0.13, 0.14, 0.84, 0.72])
    ways = [one[name] for one in moved for name in ("displacement_mean_m", "displacement_max_m")]
    unit, name = style.length_unit(max(ways))
    low, high = bracket
    if low is not None and high is not None:
        ax.axvspan(low, high, color=BRACKET, lw=0, zorder=0)
    stood = sorted((one["factor"], one["displacement_mean_m"]) for one in moved if one["verdict"] == "stable")
    ax.plot(*zip(*[(f, unit * way) for f, way in stood] or [((), ())]), color=STOOD, lw=1.2, zorder=2)
    handles = []
    for verdict, (marker, colour, told) in KINDS.items():
        of = [one for one in moved if one["verdict"] == verdict]
        for key, filled in (("displacement_max_m", False), ("displacement_mean_m", True)):
            ax.plot(
                [one["factor"] for one in of],
                [unit * one[key] for one in of],
                marker,
                color=colour,
                mfc=colour if filled else "white",
                ms=6,
                zorder=3,
            )
        handles.append(Line2D([], [], ls="", marker=marker, color=colour, label=told))
    handles.append(Line2D([], [], ls="", marker="o", color=INK, mfc="white", label="largest of a disk"))
    if low is not None and high is not None:
        handles.append(Patch(color=BRACKET, label=f"bracket: {low:.3f} to {high:.3f}"))
    ax.set_yscale("symlog", linthresh=max(unit * _least(ways), 1e-9))
    ax.set(xlabel="factor by which strengths are divided", ylabel=f"displacement [{name}]")
    ax.grid(axis="y", color="#e3e3e3", lw=0.7)
    fig.legend(handles=handles, loc="upper center", ncol=len(handles), frameon=False, fontsize=8.5)
    return style.save(fig, path, pdf)


def _least(ways):
    """The smallest displacement that is none by rounding: a hundred-thousandth of the largest at least."""
    return max(min((way for way in ways if way > 0), default=1.0), 1e-5 * max(ways))


@given.takes(before=given.snapshot(), after=given.snapshot(), walls=given.WALLS)
@style.styled
def failing_mass_on_section(before, after, walls, title="", path=None, pdf=False):
    """The slope as it begins to fail: the disks of the failing mass, coloured by their way between two Snapshots, over
    those that stay.

    ``before``, ``after``: of the trial that failed at the smallest factor; ``walls``: a Section or walls, see
    :mod:`nonsmooth.figures`.
    """
    ground, way = ground_of(walls), failing_mass.ways(before, after)
    fails = failing_mass.failing(way)
    x0, x1, y0, y1 = (before.x - before.r).min(), (before.x + before.r).max(), before.y.min(), before.y.max()
    margin = MARGIN * max(x1 - x0, y1 - y0)
    view = x0 - margin, x1 + margin, y0 - margin, y1 + margin
    width, top = 9.0, 0.5
    height = width * (view[3] - view[2]) / (view[1] - view[0])
    fig = style.figure(width, height + top)
    ax = fig.add_axes([0, 0, 1, height / (height + top)])
    style.frame(ax, *view)
    style.draw_walls(ax, ground)
    colours = np.tile(to_rgba(STAYS), (len(way), 1))
    shades = colormaps["YlOrRd"]
    most = float(way.max()) or 1.0
    colours[fails] = shades(0.25 + 0.75 * way[fails] / most)
    style.draw_disks(ax, before, colours)
    if before.water_m:
        style.water_line(ax, ground, before.water_m)
    style.scale_bar(ax)
    unit, name = style.length_unit(most)
    handles = [
        Patch(color=STAYS, label="stays"),
        Patch(color=shades(1.0), label=f"fails, and has moved by up to {unit * most:.2g} {name}"),
    ]
    fig.legend(handles=handles, loc="upper right", ncol=2, frameon=False)
    if title:
        fig.text(0.015, 1 - 0.12 / (height + top), style.plain(title), va="top", fontsize=11, color=INK)
    return style.save(fig, path, pdf)


@given.takes(found=given.ROWS)
@style.styled
def by_disks(found, path=None, pdf=False):
    """Factors of safety over published ones against the number of disks: a dot for each packing, a line through the
    means, and a band of a tenth around 1.

    ``found``: a dictionary for each slope with its ``label``, the ``published`` factor, ``disks``, numbers, and
    ``factors``, for each of these numbers a list of those of its packings.
    """
    fig = style.figure(6.4, 4.2)
    ax = fig.add_axes([0.12, 0.14, 0.85, 0.74])
    ax.axhspan(0.9, 1.1, color=BRACKET, lw=0, zorder=0)
    ax.axhline(1.0, color=INK, lw=0.8, zorder=1)
    for k, one in enumerate(found):
        colour = SLOPES[k % len(SLOPES)]
        at = np.array(one["disks"], float) * APART ** (k - 0.5 * (len(found) - 1))
        over = [np.array(factors, float) / one["published"] for factors in one["factors"]]
        for x, values in zip(at, over):
            ax.plot(np.full(len(values), x), values, "o", color=colour, mfc="white", ms=5, zorder=3)
        ax.plot(at, [values.mean() for values in over], "s-", color=colour, ms=6, lw=1.2, zorder=2, label=one["label"])
    ax.set_xscale("log")
    ticks = sorted({n for one in found for n in one["disks"]})
    ax.set_xticks(ticks, [f"{n:,}" for n in ticks], minor=False)
    ax.set_xticks([], minor=True)
    ax.set(xlabel="disks", ylabel="factor of safety over the published one")
    ax.grid(axis="y", color="#e3e3e3", lw=0.7)
    fig.legend(loc="upper center", ncol=len(found), frameon=False, fontsize=8.5)
    return style.save(fig, path, pdf)
