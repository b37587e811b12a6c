"""Figures of direct tension tests: stress against strain, the broken sample, and strengths of several campaigns."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from .. import records
from ..measure import tensile
from ..records.breaks import BREAK_MODES
from . import style
from .style import INK

__all__ = ["Broken", "strengths", "tests"]

KILO = 1e3
MODES = dict(zip(BREAK_MODES[1:], ("#d62728", "#1f5fa8", "#7b3fa0", "#e0a100")))  # colours of broken bonds
SCALES = {"disks": "disks of a sample", "inertial_number": "inertial number I of the loading"}


@dataclass(frozen=True)
class Broken:
    """A broken sample: Snapshots at the ``begin`` and the ``end``, its ``breaks`` (records.read_breaks), and the
    ``measured`` dictionary of its test.
    """

    begin: records.Snapshot
    end: records.Snapshot
    breaks: dict
    measured: dict

    @classmethod
    def of(cls, folder, measured):
        """Of the folder of a test. Raises RecordsError where a file is missing or damaged."""
        folder = Path(folder)
        shots = (records.read_snapshot(folder / "snapshots" / f"{name}.npz") for name in ("begin", "end"))
        return cls(*shots, records.read_breaks(folder / "breaks.csv"), measured)


@style.styled
def tests(curves, broken, path=None, pdf=False):
    """Stress against strain of several samples, and one of them after the test: disks coloured by their way along the
    pull, bonds that broke as dots where they broke, by what broke them, and the mean line of the break.

    ``curves``: list of (series, measured): columns of `laboratory.tension_test.COLUMNS`, and the test's dictionary of
    ``summary.json``; ``broken``: a Broken. Returns the figure, or the path where one is given.
    """
    ratio = np.ptp(broken.end.y) / np.ptp(broken.end.x)
    fig = style.figure(5.4 + 5.0 / ratio + 1.2, 5.2, layout="constrained")
    left, right = fig.subplots(1, 2, width_ratios=(5.4, 5.0 / ratio + 1.2))
    for (series, measured), colour in zip(curves, style.line_colours(len(curves))):
        left.plot(
            KILO * np.asarray(series["strain"]),
            tensile.tension(series) / KILO,
            color=colour,
            lw=1.2,
            label=f"seed {measured['seed']}",
        )
        left.plot(
            KILO * measured["strain_peak"],
            measured["tensile_strength_Pa"] / KILO,
            "o",
            ms=5,
            color=colour,
            mec="white",
            mew=0.7,
            zorder=5,
        )
    left.set(xlabel="axial strain ε [‰]", ylabel="tensile stress σ [kPa]", xlim=(0, None), ylim=(0, None))
    left.legend(loc="upper right")
    _sample(fig, right, broken)
    return style.save(fig, path, pdf)


def _sample(fig, ax, broken):
    begin, end, measured = broken.begin, broken.end, broken.measured
    way = end.y - begin.y
    most = max(float(np.abs(way).max()), 1e-12)
    scale = ScalarMappable(Normalize(-1000 * most, 1000 * most), "RdBu_r")
    m = 0.03 * np.ptp(end.x)
    style.frame(ax, end.x.min() - 2 * m, end.x.max() + 2 * m, end.y.min() - 2 * m, end.y.max() + 2 * m)
    style.draw_disks(ax, end, scale.to_rgba(1000 * way), edge="#00000030", width=0.15)
    for mode, colour in MODES.items():
        chosen = broken.breaks["mode"] == mode
        if chosen.any():
            ax.plot(
                broken.breaks["x_m"][chosen],
                broken.breaks["y_m"][chosen],
                "o",
                ms=3.5,
                color=colour,
                mec="white",
                mew=0.4,
                zorder=5,
                label=f"{mode} ({chosen.sum()})",
            )
    if measured["break_height_rel"] is not None:
        bottom, top = begin.walls[begin.walls[:, 0] == 1, 1]
        x = np.array([end.x.min(), end.x.max()])
        y = bottom + measured["break_height_rel"] * (top - bottom)
        slope = math.tan(math.radians(measured["break_angle_deg"]))
        if abs(slope) < 5:  # a steeper line leaves the sample
            ax.plot(x, y + slope * (x - x.mean()), color=INK, lw=1, ls=(0, (4, 3)), zorder=4)
    ax.set_title(f"{len(end.x):,} disks, seed {measured['seed']}")
    fig.colorbar(scale, ax=ax, shrink=0.6, label="way along the pull [mm]")
    if len(broken.breaks["mode"]):
        ax.legend(
            title="bonds that broke by",
            loc="upper center",
            bbox_to_anchor=(0.5, 0.0),
            ncol=2,
            fontsize=8,
            title_fontsize=8,
        )


@style.styled
def strengths(groups, path=None, pdf=False):
    """Tensile strength over that of the bonds against the number of disks and against the rate: dots samples, squares
    means with their 95 % interval, triangles the weakest cuts through the bonds. A panel for what varies, with the
    other as in most of the groups.

    ``groups``: as in ``summary.json`` of a campaign of tension tests.
    """
    names = [name for name in SCALES if len({row[name] for row in groups}) > 1] or ["disks"]
    fig = style.figure(3.8 * len(names) + 0.4, 3.8, layout="constrained")
    for ax, name in zip(fig.subplots(1, len(names), sharey=True, squeeze=False)[0], names):
        (other,) = set(SCALES) - {name}
        usual = Counter(row[other] for row in groups).most_common(1)[0][0]
        rows = sorted((row for row in groups if row[other] == usual), key=lambda row: row[name])
        values = [row[name] for row in rows]
        for row in rows:
            each = row["tensile_strength_rel"]["values"]
            ax.plot([row[name]] * len(each), each, "o", ms=3.5, color=style.LINES["blue"], alpha=0.4, mew=0)
        ax.errorbar(
            values,
            [row["tensile_strength_rel"]["mean"] for row in rows],
            [row["tensile_strength_rel"]["half_width"] or 0.0 for row in rows],
            fmt="s",
            ms=5,
            color=style.LINES["blue"],
            capsize=3,
            lw=1.4,
            label="tests",
        )
        cuts = [row["weakest_cut_rel"]["mean"] for row in rows]
        ax.plot(values, cuts, "^", ms=5, color=style.LINES["orange"], label="weakest cuts, an upper bound")
        ax.set(xscale="log", xlabel=SCALES[name])
        ax.set_xticks(sorted(set(values)), [f"{v:g}" for v in sorted(set(values))])
        ax.minorticks_off()
        ax.grid(axis="y", color="#e3e3e3", lw=0.7)
    first = fig.axes[0]
    first.set(ylabel="σ_t / σ_ext", ylim=(0, None))
    first.legend(loc="lower right")
    return style.save(fig, path, pdf)
