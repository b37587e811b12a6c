"""Columns of disks that lay across the layers of a slope, followed through its motion: what is folded, sheared, and not
mixed.
"""

import numpy as np
from matplotlib.colors import to_rgba_array
from matplotlib.patches import Patch

from ..measure.ground import ground_of
from . import given, style

__all__ = ["MARKERS", "columns", "markers"]

# of columns of disks that are followed: told apart by lightness and hue, none a layer's colour
MARKERS = ("#0072B2", "#B00020", "#009E73", "#4B2E83")
COLUMN = 3.0  # mean diameters, width of a column
PALE = 0.45  # of a layer's colour that is left where no column is


def columns(start, walls, number=16):
    """Which column each disk of a Snapshot lies in, of ``number`` thin ones normal to the slope at equal distances
    along it, (n,) int; −1 for none.
    """
    ground = ground_of(walls)
    down = np.array(getattr(walls, "downslope", (ground.side, 0.0)))
    along = start.x * down[0] + start.y * down[1]
    mass = np.full(len(along), True) if ground.mass is None else np.isin(start.layer, ground.mass)
    low, high = along[mass].min(), along[mass].max()
    middles = low + (np.arange(number) + 0.5) * (high - low) / number
    nearest = np.argmin(np.abs(along[:, None] - middles), axis=1)
    width = COLUMN * 2 * float(start.r[mass].mean())
    return np.where(mass & (np.abs(along - middles[nearest]) <= width / 2), nearest, -1)


@given.takes(cases=given.LABELLED, section=given.SECTION)
@style.styled
def markers(cases, section, path=None, pdf=False, number=16):
    """What becomes of thin columns of disks that lay across the layers: tilted and bent they show shear, turned over
    with the layers they show folds, scattered they would show mixing.

    ``cases``: list of (label, Snapshot), the first that of the slope at rest with all of its disks, as "t0", "t4",
    "t5", one panel each; ``section``: a Section; ``number``: of columns, normal to the slope. Layers are pale, lowest
    darkest.
    """
    cases, ground = list(cases), ground_of(section)
    if not cases:
        raise style.RecordsError("there is no snapshot to draw; give at least one (label, snapshot)")
    column = columns(cases[0][1], section, number)
    x0, x1, y0, y1 = style.view([s for _, s in cases], ground)
    width, top = 10.5, 0.45
    height = width * (y1 - y0) / (x1 - x0)
    total = top + height * len(cases)
    fig = style.figure(width, total)
    strong = to_rgba_array([MARKERS[k % len(MARKERS)] for k in range(number)])
    for k, (label, snapshot) in enumerate(cases):
        ax = fig.add_axes([0, height * (len(cases) - 1 - k) / total, 1, height / total])
        style.frame(ax, x0, x1, y0, y1)
        style.draw_walls(ax, ground, named=("slip", "ground", "backstop"))
        colours = PALE * style.layer_colours(snapshot.layer) + (1 - PALE)
        colours[:, 3] = 1
        of = column if getattr(snapshot, "number", None) is None else column[snapshot.number]
        colours[of >= 0] = strong[of[of >= 0]]
        style.draw_disks(ax, snapshot, colours)
        meaning = style.TIME_NAMES.get(label)
        edge, align = (0.985, "right") if ground.side > 0 else (0.015, "left")
        told = f"$t_{{{label[1:]}}}$, {meaning}" if meaning else style.plain(label)
        ax.text(
            edge, 0.93, f"{told}: {snapshot.time_s:.0f} s", transform=ax.transAxes, ha=align, va="top", fontsize=12, fontweight="bold", color=style.INK, zorder=8,
            path_effects=style.EDGE,
        )  # fmt: skip
        if k == len(cases) - 1:
            style.scale_bar(ax, 0.2 if ground.side > 0 else 0.95, 0.08, 0.15)
    handles = [Patch(color=MARKERS[0], label="disks that lay in thin columns normal to the slope at $t_0$")]
    for n in np.unique(cases[0][1].layer)[::-1]:
        pale = PALE * np.array(to_rgba_array(style.LAYERS[n % len(style.LAYERS)]))[0, :3] + (1 - PALE)
        handles.append(Patch(color=pale, label=style.plain(ground.layer(n))))
    fig.legend(handles=handles, loc="upper center", ncol=len(handles), handlelength=1.6, columnspacing=1.4)
    return style.save(fig, path, pdf)
