"""Deposits of several runs of one slope, one below the other, with how far their fronts have come."""

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ..measure.fronts import front
from ..measure.ground import ground_of
from ..records import in_both
from . import given, style
from .style import INK

__all__ = ["runouts"]


FIRST_AND_LAST = given.cases(
    "(label, Snapshot of the beginning, Snapshot of the end)", None, given.SNAPSHOT, given.SNAPSHOT
)


@given.takes(cases=FIRST_AND_LAST, walls=given.WALLS)
@style.styled
def runouts(cases, walls, path=None, pdf=False):
    """Where masses have come to rest, in panels of one scale.

    ``cases``: list of (label, :class:`~nonsmooth.records.Snapshot` of the beginning, and of the end); ``walls``: see
    :mod:`nonsmooth.figures`. Disks have the colours of their layers; dotted the front of the mass before and after,
    with its travel. Raises RecordsError where there is no case.
    """
    cases, ground = list(cases), ground_of(walls)
    if not cases:
        raise style.RecordsError("there is no run to draw; give at least one (label, first snapshot, last snapshot)")
    view = style.view([s for _, *both in cases for s in both], ground)
    width, top = 10.5, 0.45
    height = width * (view[3] - view[2]) / (view[1] - view[0])
    total = top + height * len(cases)
    fig = style.figure(width, total)
    edge, align = (0.985, "right") if ground.side > 0 else (0.015, "left")
    for k, (label, first, last) in enumerate(cases):
        ax = fig.add_axes([0, height * (len(cases) - 1 - k) / total, 1, height / total])
        style.frame(ax, *view)
        style.draw_walls(ax, ground, named=None if k == 0 else ())
        style.draw_disks(ax, last, style.layer_colours(last.layer))
        a, b = (front(s, ground.side, layers=ground.mass) for s in in_both(first, last))
        for at in (a, b):
            ax.axvline(at, color=INK, lw=0.9, ls=":", zorder=7)
        level = view[2] + 0.06 * (view[3] - view[2])
        ax.annotate(
            "",
            (b, level),
            (a, level),
            arrowprops={"arrowstyle": "-|>", "color": INK, "lw": 1.3, "shrinkA": 0, "shrinkB": 0},
            zorder=8,
        )
        ax.text(
            edge,
            0.93,
            f"{style.plain(label)}: front {style.length(ground.side * (b - a), view[1] - view[0])}",
            transform=ax.transAxes,
            ha=align,
            va="top",
            fontsize=12,
            fontweight="bold",
            color=INK,
            bbox={"fc": "white", "ec": "none", "alpha": 0.8, "pad": 2},
            zorder=9,
        )
        if k:
            ax.plot([0, 1], [1, 1], transform=ax.transAxes, color="#bbbbbb", lw=0.8, clip_on=False, zorder=8)
    style.scale_bar(ax, 0.2 if ground.side > 0 else 0.95, 0.1, 0.15)
    layers = np.unique(np.concatenate([last.layer for *_, last in cases]))
    fig.legend(
        handles=[Patch(color=style.LAYERS[n % len(style.LAYERS)], label=style.plain(ground.layer(n))) for n in layers]
        + [Line2D([], [], color=INK, lw=0.9, ls=":", label="front of the mass, before and after")],
        loc="upper center",
        ncol=len(layers) + 1,
    )
    return style.save(fig, path, pdf)
