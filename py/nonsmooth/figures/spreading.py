"""Profiles of speed behind the tips of columns that spread (the paper's Figure 7)."""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from ..records import RecordsError
from . import style
from .style import LINES

__all__ = ["profiles"]

TIMES = (LINES["blue"], LINES["orange"], LINES["purple"])  # of the three times of a column
BORDER = "#b00020"
FAST = 0.8  # √(g H₀), the end of the colours


@style.styled
def profiles(columns, path=None, pdf=False):
    """A row for each aspect ratio: the column of one seed while it spreads, by speed, with the border of what rests,
    and profiles of the mean speed at three places behind the tip.

    ``columns``: list of dictionaries with ``aspect``; ``seeds``: how many; ``rows``: of heaps.profiles.over_runs;
    ``shown``: number of the row that the picture is of; ``look``: a heaps.profiles.SpeedSpan of one seed, ``r`` [m],
    ``width``: L₀ [m], ``speed``: √(g H₀) [m/s] of it; and ``border``: places from the wall and heights [m] of the
    border, arrays (n,). Lines: means over seeds, with their 95 % interval; dashes of the same colour: the border.
    Raises RecordsError without columns.
    """
    if not columns:
        raise RecordsError("there are no columns to draw profiles of; give one or more")
    fig = style.figure(12.6, 0.9 + 2.75 * len(columns), layout="constrained")
    grid = fig.add_gridspec(len(columns), 4, width_ratios=(2.1, 1, 1, 1))
    scale = ScalarMappable(Normalize(0, FAST), "viridis")
    for k, column in enumerate(columns):
        ax = fig.add_subplot(grid[k, 0])
        _picture(ax, column, scale)
        for m in range(3):
            _profile(fig.add_subplot(grid[k, 1 + m]), column, m)
    fig.colorbar(
        scale,
        ax=fig.axes[-4],
        location="bottom",
        shrink=0.8,
        aspect=40,
        label="speed of the disks / √(g H₀)",
        extend="max",
    )
    return style.save(fig, path, pdf)  # fmt: skip


def _picture(ax, column, scale):
    look, width, row = column["look"], column["width"], column["rows"][column["shown"]]
    disks = type("Disks", (), dict(x=look.x / width, y=look.y / width, r=column["r"] / width))
    style.draw_disks(ax, disks, scale.to_rgba(np.hypot(look.u, look.v) / column["speed"]))
    at, height = column["border"]
    ax.plot(at / width, height / width, color=BORDER, lw=1.8, label="border of what rests")
    ax.axhline(0, color=style.WALL, lw=1.2)
    tip, top = look.tip / width, float(np.max(look.y + column["r"])) / width
    for place, letter in zip(row["places"], "abc"):
        x = (1 - place["behind"]) * tip
        ax.plot([x, x], [0, top], color=style.INK, lw=0.9, ls=(0, (3, 3)))
        ax.text(x, 1.03 * top, letter, ha="center", va="bottom", path_effects=style.EDGE)
    ax.set_xlim(-0.02 * tip, 1.03 * tip)
    ax.set_ylim(-0.02 * tip, max(1.4 * top, 0.3 * tip))
    ax.set_aspect("equal")
    ax.set_title(
        f"a = {column['aspect']:.2g}, {column['seeds']} seeds: the first, at {row['time_rel']['mean']:.1f} T",
        loc="left",
    )
    ax.set_ylabel("$y/L_0$")
    ax.set_xlabel("$x/L_0$")
    ax.legend(loc="upper right", fontsize=8)


def _profile(ax, column, m):
    """Speeds at one place, at all times."""
    highest, fastest = 0.0, 0.0
    for row, colour in zip(column["rows"], TIMES):
        place = row["places"][m]
        label = f"{row['at']:g} of the run-out, {row['time_rel']['mean']:.1f} T"
        if not place["regimes"]:
            continue
        name, count = max(place["regimes"].items(), key=lambda item: item[1])
        label += f"\n   {name}, {count} of {sum(place['regimes'].values())}"
        z = np.array(place["z_d"])
        mean, half = (
            np.array([one[key] or 0.0 for one in place["speed_rel"]], float) for key in ("mean", "half_width")
        )
        ax.plot(mean, z, color=colour, marker="o", ms=2.5, lw=1.4, label=label)
        ax.fill_betweenx(z, mean - half, mean + half, color=colour, alpha=0.18, lw=0)
        ax.axhline(place["border_rel"]["mean"] * place["height_d"]["mean"], color=colour, lw=1.0, ls=(0, (4, 2)))
        highest, fastest = max(highest, *(z + 0.5)), max(fastest, *np.abs(mean))
    ax.axvline(0, color="#999999", lw=0.7)
    share = 100 * column["rows"][0]["places"][m]["behind"]
    ax.set_title(f"{'abc'[m]}: {share:.0f} % of the way from the tip", loc="left", fontsize=9.5)
    if fastest > 0:
        ax.set_xlim(-0.3 * fastest, 1.4 * fastest)  # intervals of few seeds go beyond
    ax.set_ylim(0, 1.75 * max(highest, 1.0))  # room for the names
    ax.set_xlabel("speed along the floor / √(g H₀)")
    if m == 0:
        ax.set_ylabel("height [mean diameters]")
    ax.legend(loc="upper left", fontsize=7, handlelength=1.2, borderaxespad=0.1)
