"""A cycle of stress in a sheared sample: curves, and chains of forces before and after the drop (the paper's Figure
6).
"""

import numpy as np
from matplotlib.patches import Patch

from ..measure import cycles
from . import biaxial, style

__all__ = ["cycle"]

MARGIN = 0.002  # of strain, to each side of the cycle
BUILD, DROP = "#dcebf7", "#fbd9c0"


@style.styled
def cycle(series, rows, before, after, words, path=None, pdf=False):
    """Left: deviator stress, volumetric strain and kinetic energy against axial strain around a cycle; right: forces in
    the whole sample before and after the drop, to one scale.

    ``series``: columns of `laboratory.biaxial.COLUMNS`; ``rows``: the laboratory.cycles.Cycle; ``before``, ``after``:
    Snapshots at its peak and at its end; ``words``: of the sample. Blue: the stress builds up; orange: it drops. Raises
    RecordsError for a series without one of the columns.
    """
    names = ("strain", "volumetric_strain", cycles.ENERGY)
    strain, volume, energy = style.need(series, *names)
    deviator, strain = cycles.deviator(series), 100 * strain
    ratio = np.ptp(before.y) / np.ptp(before.x)
    fig = style.figure(12.4, 0.9 + 3.0 * ratio, layout="constrained")
    grid = fig.add_gridspec(3, 3, width_ratios=(1.55, 1, 1))
    curves = [fig.add_subplot(grid[k, 0]) for k in range(3)]
    edges = strain[[rows.begin, rows.peak, rows.end]]
    shown = (strain >= edges[0] - 100 * MARGIN) & (strain <= edges[2] + 100 * MARGIN)
    labels = ("σ₁ − σ₃ [MPa]", "volumetric strain [%]\n(dilation positive)", "kinetic energy [kJ/m]")
    for ax, values, label in zip(curves, (deviator / biaxial.MEGA, 100 * volume, 1e-3 * energy), labels):
        ax.axvspan(edges[0], edges[1], color=BUILD, lw=0, zorder=0)
        ax.axvspan(edges[1], edges[2], color=DROP, lw=0, zorder=0)
        ax.plot(strain[shown], values[shown], color=style.INK, lw=1.1, marker=".", ms=3)
        ax.set_ylabel(label)
        ax.set_xlim(strain[shown][0], strain[shown][-1])
    curves[2].set_ylim(0, None)
    for ax in curves[:2]:
        ax.set_xticklabels([])
    curves[2].set_xlabel("axial strain ε₁ [%]")
    curves[0].legend(
        handles=[Patch(color=BUILD, label="the stress builds up"), Patch(color=DROP, label="it drops")],
        loc="lower left",
        fontsize=8,
    )
    curves[0].set_title(words, loc="left")
    strong = biaxial.strong(before)
    for k, (snapshot, row, name) in enumerate(((before, rows.peak, "before the drop"), (after, rows.end, "after it"))):
        ax = fig.add_subplot(grid[:, 1 + k])
        biaxial.draw_chains(ax, snapshot, strong, before, after)
        ax.set_title(f"{name}, at {strain[row]:.2f} %: {deviator[row] / biaxial.MEGA:.1f} MPa")
    return style.save(fig, path, pdf)
