"""Figure of readings of what the paper leaves open: the strain of the peak in biaxial tests against the water that the slope bears."""

import math

import numpy as np
from matplotlib.patches import Rectangle

from ..laboratory.readings import PAPER, SHIPPED
from . import style

_strain, _octaves = PAPER["strain_peak"]
_water, _metres = PAPER["water_highest_m"]
PEAK = (_strain / 2**_octaves, _strain * 2**_octaves)  # strains of the peak that count as the paper's
NEAR = (0.1, 0.7)  # within which two points share a label: logarithm of the strain, and m of water
WATER = (_water - _metres, _water + _metres)  # m of water that do


@style.styled
def tradeoff(rows, path=None, pdf=False):
    """Each row (see `laboratory.readings.run`) a numbered point, lines from its lowest to its highest packing, the paper's range a box; the numbers' names and distances stand beside it, nearest first."""
    rows = sorted(rows, key=lambda row: np.inf if row["distance"] is None else row["distance"])
    fig = style.figure(10.2, 0.24 * len(rows) + 2.2 if len(rows) > 14 else 5.6, layout="constrained")
    ax, names = fig.subplots(1, 2, width_ratios=(1.6, 1.0))
    ax.add_patch(
        Rectangle((100 * PEAK[0], WATER[0]), 100 * (PEAK[1] - PEAK[0]), WATER[1] - WATER[0], color="#dcebf7", zorder=0)
    )
    ax.text(100 * PEAK[1] * 0.97, WATER[1] - 0.2, "the paper", ha="right", va="top", color=style.WATER)
    places = {}  # of points: those too near for a number each share one label
    for k, row in enumerate(rows):
        x, y = row["strain_peak"], row["water_highest_m"]
        if x is None or y is None:
            continue
        colour = style.LINES["orange"] if row["name"] == SHIPPED else style.INK
        # from the lowest to the highest packing
        for values, at, across in ((row["strain_peak_each"], y, True), (row["water_highest_m_each"], x, False)):
            known = [v for v in values if v is not None]
            ends = [100 * v for v in (min(known), max(known))] if across else [min(known), max(known)]
            line = (ends, [at, at]) if across else ([100 * at] * 2, ends)
            ax.plot(*line, "-", color=colour, lw=0.8, alpha=0.4, zorder=2)
        ax.plot(100 * x, y, "o", ms=4.5, color=colour, zorder=3)
        near = (p for p in places if abs(math.log(p[0] / x)) < NEAR[0] and abs(p[1] - y) < NEAR[1])
        places.setdefault(next(near, (x, y)), []).append((k + 1, colour))
    for (x, y), numbers in places.items():
        ax.annotate(
            ", ".join(str(number) for number, _ in numbers),
            (100 * x, y),
            xytext=(5, 4),
            textcoords="offset points",
            color=numbers[0][1],
            fontsize=8.5,
            zorder=4,
            path_effects=style.EDGE,
        )
    ax.set_xscale("log")
    ticks = (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0)
    ax.set_xticks(ticks, [f"{t:g}" for t in ticks])
    ax.minorticks_off()
    ax.set(xlabel="strain of the peak under 4, 8 and 16 MPa [%]", ylabel="highest water table of the slope [m]")
    names.axis("off")
    for k, row in enumerate(rows):
        told = "–" if row["distance"] is None else f"{row['distance']:.2f}"
        bold = "bold" if row["name"] == SHIPPED else "normal"
        y = 1 - (k + 1.5) / (len(rows) + 1.5)
        names.text(0.0, y, f"{k + 1}", ha="right", va="center", fontsize=9, fontweight=bold)
        names.text(0.04, y, style.plain(row["label"]), va="center", fontsize=9, fontweight=bold)
        names.text(1.0, y, told, ha="right", va="center", fontsize=9, fontweight=bold)
    names.text(1.0, 1.0, "distance", ha="right", va="top", fontsize=9, color="#777777")
    return style.save(fig, path, pdf)
