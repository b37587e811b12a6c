"""The toe of a slope while it fails: how far its disks have turned, and the bands that they turned in (the paper's
section 6.2).
"""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.lines import Line2D

from ..measure import toe_bands
from ..measure.ground import ground_of
from ..records import in_both
from . import given, style

__all__ = ["toe", "toes"]

TURNED = given.snapshot("layer", "angle")
BEFORE_AND_AFTER = given.cases("(title, Snapshot before, Snapshot after, Section)", None, TURNED, TURNED, given.SECTION)
WIDTH, ACROSS = 8.0, 3  # inches of a toe alone; panels side by side


@given.takes(before=TURNED, after=TURNED, section=given.SECTION)
@style.styled
def toe(before, after, section, path=None, pdf=False, friction_deg=None):
    """The toe by the rotation of its disks between two snapshots, with the bands found in it.

    ``before``, ``after``: Snapshots with the same disks, such as those of t0 and t2; ``section``: a Section;
    ``friction_deg``: angle of friction of the rock, for the bands of Rankine's passive wedge, left out where it is
    None. Disks stand where they are in ``after``. Dashed: edges of the bands that
    :func:`~nonsmooth.measure.toe_bands.find` finds; dotted, through the middles of the stretches that were looked at:
    Rankine's directions. None where the toe has too few disks.
    """
    before, after = in_both(before, after)
    chosen, _, _, thickness = toe_bands.toe(before, section)
    if chosen.sum() < toe_bands.FEWEST:
        return None
    view = _view(section, thickness)
    fig = style.figure(WIDTH, WIDTH * _shape(view) * 0.86 + 0.7, layout="constrained")
    ax = fig.subplots()
    scale = _scale([(before, after, section)])
    _disks(ax, before, after, section, view, scale)
    handles = _bands(ax, before, after, section, thickness, friction_deg)
    if handles:
        ax.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.01), handlelength=3)
    told = f"rotation from {before.time_s:.1f} s to {after.time_s:.1f} s [rad], counterclockwise positive"
    fig.colorbar(scale, ax=ax, shrink=0.7, label=told, extend="both")
    return style.save(fig, path, pdf)


@given.takes(cases=BEFORE_AND_AFTER)
@style.styled
def toes(cases, path=None, pdf=False, friction_deg=None):
    """The toes of several slopes side by side, each as :func:`toe` draws it, with one scale of colours, whatever number
    of disks they have; bands and Rankine's directions where a toe has disks enough for them.

    ``cases``: list of (title, before, after, section), such as one for each packing; the rest as for :func:`toe`.
    """
    cases = [(title, *in_both(before, after), section) for title, before, after, section in cases]
    if not cases:
        raise style.RecordsError("there is no toe to draw; give at least one (title, before, after, section)")
    scale, across = _scale([one[1:] for one in cases]), min(len(cases), ACROSS)
    down = -(-len(cases) // across)
    views = [_view(section, toe_bands.toe(before, section)[3]) for _, before, _, section in cases]
    width = 2 * WIDTH / 3
    height = width * max(map(_shape, views)) + 0.35
    fig = style.figure(width * across, height * down + 0.75, layout="constrained")
    panels = fig.subplots(down, across, squeeze=False).ravel()
    for ax in panels[len(cases) :]:
        ax.axis("off")
    for ax, view, (title, before, after, section) in zip(panels, views, cases):
        _disks(ax, before, after, section, view, scale)
        ax.set_title(style.plain(title), loc="left")
        if toe_bands.tells(before, section):
            _bands(ax, before, after, section, toe_bands.toe(before, section)[3], friction_deg)
    told = "rotation [rad], counterclockwise positive"
    bar = fig.colorbar(scale, ax=panels.tolist(), location="bottom", shrink=0.4, aspect=40, label=told, extend="both")
    bar.set_ticks(np.linspace(*scale.get_clim(), 5))  # more of them would not have room below one panel
    return style.save(fig, path, pdf)


def _view(section, thickness):
    """Limits (x0, x1, y0, y1) [m] of a picture of the toe."""
    down, normal, foot = np.array(section.downslope), np.array(section.normal), ground_of(section).foot
    corners = [
        foot + h * thickness * normal - a * thickness * down for h in (0.0, 1.2) for a in (-0.3, toe_bands.REACH[1])
    ]
    (x0, y0), (x1, y1) = np.min(corners, axis=0), np.max(corners, axis=0)
    return x0, x1, y0, y1


def _shape(view):
    return (view[3] - view[2]) / (view[1] - view[0])


def _scale(cases):
    """Colours of rotations, to a round number near the largest in the toes of all (before, after, section)."""
    turned = [np.abs(after.angle - before.angle)[toe_bands.toe(before, section)[0]] for before, after, section in cases]
    turned = np.concatenate(turned)
    limit = max(0.02, style.nice(float(np.quantile(turned, 0.95)))) if len(turned) else 0.02
    return ScalarMappable(Normalize(-limit, limit), "RdBu_r")


def _disks(ax, before, after, section, view, scale):
    x0, x1, y0, y1 = view
    style.frame(ax, *view)
    near = (after.x > x0 - 2) & (after.x < x1 + 2) & (after.y > y0 - 2) & (after.y < y1 + 2)
    style.draw_disks(ax, after, scale.to_rgba(after.angle - before.angle), near, edge="#00000030", width=0.15)
    style.draw_walls(ax, ground_of(section))


def _bands(ax, before, after, section, thickness, friction_deg):
    """Draws edges of the bands that are found and Rankine's directions; returns handles of a legend."""
    foot, down, normal = ground_of(section).foot, np.array(section.downslope), np.array(section.normal)
    size = 2 * float(np.sqrt(np.mean(before.r[toe_bands.toe(before, section)[0]] ** 2)))
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
            ends = [point + (h - (point - foot) @ normal) / (along @ normal) * along for h in (0, thickness)]
            colour = style.LINES["orange"] if dash == ":" else style.INK
            ax.plot(*np.transpose(ends), color=colour, lw=1.8, ls=dash, zorder=7)
        label = f"{name}: {band.inclination_deg:.0f}° to the slope, {band.width:.1f} d wide"
        handles.append(Line2D([], [], color=style.INK, lw=1.8, ls=dashes, label=label))
    if friction_deg is not None and handles:
        label = f"Rankine: 45° − φ/2 = {toe_bands.rankine(friction_deg):.0f}°"
        handles.append(Line2D([], [], color=style.LINES["orange"], lw=1.8, ls=":", label=label))
    return handles
