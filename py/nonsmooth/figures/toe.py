"""The toe of a slope while it fails: how far its disks have turned, and the bands that they turned in (the paper's section 6.2)."""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.lines import Line2D

from ..measure import toe_bands
from ..measure.ground import ground_of
from . import given, style


@given.takes(before=given.SNAPSHOT, after=given.SNAPSHOT, section=given.SECTION)
@style.styled
def toe(before, after, section, path=None, pdf=False, friction_deg=None):
    """The toe by the rotation of its disks between two snapshots, with the bands found in it.

    ``before``, ``after``: Snapshots with the same disks, such as those of t1 and t3; ``section``: a Section; ``friction_deg``: angle of friction of the rock, for the bands of Rankine's
    passive wedge, left out where it is None. Disks stand where they are in ``after``. Dashed: edges of the bands that :func:`~nonsmooth.measure.toe_bands.find` finds; dotted, through the
    middles of the stretches that were looked at: Rankine's directions. None where the toe has too few disks.
    """
    chosen, up, off, thickness = toe_bands.toe(before, section)
    if chosen.sum() < toe_bands.FEWEST:
        return None
    ground, turned = ground_of(section), after.angle - before.angle
    down, normal = np.array(section.downslope), np.array(section.normal)
    corners = [
        ground.foot + h * thickness * normal - a * thickness * down
        for h in (0.0, 1.2)
        for a in (-0.3, toe_bands.REACH[1])
    ]
    x0, y0 = np.min(corners, axis=0)
    x1, y1 = np.max(corners, axis=0)
    width = 8.0
    fig = style.figure(width, width * (y1 - y0) / (x1 - x0) * 0.86 + 0.7, layout="constrained")
    ax = fig.subplots()
    limit = max(0.02, style.nice(float(np.quantile(np.abs(turned[chosen]), 0.95))))
    scale = ScalarMappable(Normalize(-limit, limit), "RdBu_r")
    near = (after.x > x0 - 2) & (after.x < x1 + 2) & (after.y > y0 - 2) & (after.y < y1 + 2)
    style.frame(ax, x0, x1, y0, y1)
    style.draw_disks(ax, after, scale.to_rgba(turned), near, edge="#00000030", width=0.15)
    style.draw_walls(ax, ground)
    size = 2 * float(np.sqrt(np.mean(before.r[chosen] ** 2)))
    handles, dashes = [], (0, (4, 2))
    for band, name in zip(
        toe_bands.find(before, after, section), ("band that rises towards the foot", "conjugate band")
    ):
        if band is None:
            continue
        through, way = np.array(band.through), np.array(band.direction)
        across = 0.5 * band.width * size * np.array((-way[1], way[0]))
        lines = [(through + side * across, way, dashes) for side in (-1, 1)]
        if friction_deg is not None:
            angle = np.radians(toe_bands.rankine(friction_deg))
            lines.append((through, np.sign(way @ down) * np.cos(angle) * down + np.sin(angle) * normal, ":"))
        for point, along, dash in lines:  # from the slip surface to the surface
            ends = [point + (h - (point - ground.foot) @ normal) / (along @ normal) * along for h in (0, thickness)]
            ax.plot(
                *np.transpose(ends),
                color=style.LINES["orange"] if dash == ":" else style.INK,
                lw=1.8,
                ls=dash,
                zorder=7,
            )
        label = f"{name}: {band.inclination_deg:.0f}° to the slope, {band.width:.1f} d wide"
        handles.append(Line2D([], [], color=style.INK, lw=1.8, ls=dashes, label=label))
    if friction_deg is not None and handles:
        handles.append(
            Line2D(
                [],
                [],
                color=style.LINES["orange"],
                lw=1.8,
                ls=":",
                label=f"Rankine: 45° − φ/2 = {toe_bands.rankine(friction_deg):.0f}°",
            )
        )
    if handles:
        ax.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.01), handlelength=3)
    fig.colorbar(
        scale,
        ax=ax,
        shrink=0.7,
        label=f"rotation from {before.time_s:.1f} s to {after.time_s:.1f} s [rad], counterclockwise positive",
        extend="both",
    )
    return style.save(fig, path, pdf)
