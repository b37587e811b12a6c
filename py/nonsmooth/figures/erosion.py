"""What windows have taken out of a slope: which disks, when, and how fast the slope moved."""

from __future__ import annotations

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.lines import Line2D

from ..measure.ground import ground_of
from ..system import checks
from . import given, style

__all__ = ["erosion"]

LEDGER = checks.holds("window disk time_s window_time_s mass_kg_per_m", "give the ledger, as run.eroded has it")
WINDOWS = checks.has("walls erosion", "give a Section that has `erosion`")
PALE = 0.3  # of a layer's colour that is left where no disk was taken out
COLOURS = "plasma"
DASHES = ("-", (0, (5, 2)), (0, (1, 1.5)), (0, (5, 1.5, 1, 1.5)))


@given.takes(initial=given.SNAPSHOT, ledger=LEDGER, section=WINDOWS, series=given.SERIES)
@style.styled
def erosion(initial, ledger, section, series, path=None, pdf=False, times=None):
    """Above, the slope at the beginning: disks that were taken out by the time at which they were, the others pale, and
    each window where it was at its begin (thin) and when it took its last disk. Below, the mass that each window has
    taken out against time, with the mean speed of the slope.

    ``initial``: the Snapshot of t0, with all disks; ``ledger``: columns of ``eroded.csv``
    (:func:`~nonsmooth.records.read_eroded`); ``section``: a Section with windows; ``series``: columns of the run;
    ``times``: t0 to t5 to mark. Raises RecordsError where nothing was taken out.
    """
    if not len(ledger["disk"]):
        raise style.RecordsError("the ledger is empty; give that of a run in which windows have taken disks out")
    time, speed = style.need(series, "time_s", "speed_mean_m_per_s")
    ground = ground_of(section)
    view = style.view([initial], ground)
    width, low = 10.5, 2.9
    height = width * (view[3] - view[2]) / (view[1] - view[0])
    total = height + low + 0.1
    fig = style.figure(width, total)
    ax = fig.add_axes([0, (low + 0.1) / total, 1, height / total])
    scale = _slope(ax, initial, ledger, section, ground, view)
    bar = fig.colorbar(
        scale, cax=ax.inset_axes([0.62 if ground.side > 0 else 0.1, 0.9, 0.25, 0.03]), orientation="horizontal"
    )
    bar.set_label("taken out at [s]", labelpad=2)
    _curves(fig.add_axes([0.075, 0.55 / total, 0.85, (low - 0.95) / total]), ledger, section, time, speed, times)
    return style.save(fig, path, pdf)


def _slope(ax, initial, ledger, section, ground, view):
    """The upper panel; returns the scale of the colours."""
    style.frame(ax, *view)
    style.draw_walls(ax, ground)
    first, last = float(ledger["time_s"].min()), float(ledger["time_s"].max())
    scale = ScalarMappable(Normalize(first, max(last, first + 1e-9)), COLOURS)
    colours = PALE * style.layer_colours(initial.layer) + (1 - PALE)
    colours[:, 3] = 1
    colours[ledger["disk"]] = scale.to_rgba(ledger["time_s"])
    style.draw_disks(ax, initial, colours)
    for window, dashes in zip(section.erosion, _dashes(section)):
        took = ledger["window_time_s"][ledger["window"] == window.name]
        places = [(window.begin, 0.9)] + ([(float(took.max()), 2.0)] if len(took) else [])
        for when, wide in places if window.moves else places[-1:]:
            points = window.outline(when)
            ax.plot(*np.vstack([points, points[:1]]).T, color=style.INK, lw=wide, ls=dashes, zorder=6)
    style.scale_bar(ax, 0.2 if ground.side > 0 else 0.95, 0.1, 0.15)
    return scale


def _curves(ax, ledger, section, time, speed, times):
    """The lower panel."""
    ax.set_xlim(time[0], max(time[-1], time[0] + 1e-9))
    style.mark_times(ax, style.known_times(times))
    handles = []
    for window, dashes in zip(section.erosion, _dashes(section)):
        mine = ledger["window"] == window.name
        mass = 1e-3 * np.cumsum(ledger["mass_kg_per_m"][mine])
        at = np.concatenate([[time[0]], ledger["time_s"][mine], [time[-1]]])
        ax.step(
            at,
            np.concatenate([[0.0], mass, mass[-1:] if len(mass) else [0.0]]),
            where="post",
            color=style.INK,
            ls=dashes,
        )
        told = f"{style.plain(window.name)}: {np.count_nonzero(mine)} disks, {mass[-1] if len(mass) else 0.0:.3g} t/m"
        handles.append(Line2D([], [], color=style.INK, ls=dashes, label=told))
    ax.set(xlabel="time [s]", ylabel="taken out [t/m]", ylim=(0, None))
    beside, colour = ax.twinx(), style.LINES["orange"]
    beside.plot(time, speed, color=colour, lw=1.1)
    beside.set_ylim(0, None)
    beside.set_ylabel("mean speed [m/s]", color=colour)
    handles.append(Line2D([], [], color=colour, lw=1.1, label="mean speed"))
    ax.legend(handles=handles, loc="upper left")


def _dashes(section):
    return [DASHES[k % len(DASHES)] for k in range(len(section.erosion))]
