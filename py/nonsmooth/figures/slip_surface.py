"""What slip laws have found along the walls of a slope, in space and time."""

from __future__ import annotations

import numpy as np

from .. import records
from ..system import checks
from . import given, style

__all__ = ["slip_surface"]

CELLS = checks.holds(
    "wall cell time_s length_m slip_m friction hottest_degC", "give columns of slip_surface.csv, as run.slip_surface"
)
WIDTH, PANEL = 10.5, 2.2
LEAST = 1.0  # °C of the scale, so that a slope that stands does not look hot
SCALES = {"hottest_degC": ("hottest [°C]", "inferno"), "friction": ("friction, share left", "viridis")}


@given.takes(cells=CELLS)
@style.styled
def slip_surface(cells, path=None, pdf=False, times=None):
    """Of each wall, against time and the way along it: the highest temperature across the zone, where the law has one,
    on one scale for all walls, and the friction by that of its beginning; from when something slides. What came before
    slip was last set back, as when the slope has settled, is left out.

    ``cells``: columns of ``slip_surface.csv`` (:func:`~nonsmooth.records.read_surfaces`); ``times``: t0 to t5 to mark.
    Raises RecordsError where nothing has slipped.
    """
    every = records.surface_arrays(cells)
    walls = records.since_set_back(every)
    if not any(one["slip_m"].any() for one in walls.values()):
        raise style.RecordsError("no cell has slipped; give those of a run in which something slid on a wall")
    panels = [(wall, what) for wall, one in walls.items() for what in SCALES if what in one]
    fig = style.figure(WIDTH, PANEL * len(panels) + 0.6, layout="constrained")
    axes = np.atleast_1d(fig.subplots(len(panels), 1, sharex=True))
    heat = [one["hottest_degC"] for one in walls.values() if "hottest_degC" in one]
    limits = {"friction": (0, 1)}
    if heat:
        low, high = min(map(np.nanmin, heat)), max(map(np.nanmax, heat))
        limits["hottest_degC"] = (low, max(high, low + LEAST))
    begin, end = _begin(walls.values()), -np.inf
    for ax, (wall, what) in zip(axes, panels):
        values, (label, colours), (low, high) = walls[wall][what], SCALES[what], limits[what]
        if what == "friction":
            values = values / every[wall]["friction"][0]
        corners = _corners(walls[wall])
        shown = ax.pcolormesh(*corners, values.T, vmin=low, vmax=high, cmap=colours, rasterized=True)
        fig.colorbar(shown, ax=ax, pad=0.01, label=label)
        end = max(end, corners[0][-1])
        ax.set_xlim(begin, end)
        ax.set_ylabel(f"way along {style.plain(wall)} [m]")
        style.mark_times(ax, times or {})
    axes[-1].set_xlabel("time [s]")
    return style.save(fig, path, pdf)


def _begin(walls):
    """When the picture begins [s]: a tenth of what follows before anything has slid by a thousandth of the longest."""
    longest = max(one["slip_m"].max() for one in walls)
    slid = min(one["time_s"][(one["slip_m"] > 1e-3 * longest).any(axis=1)].min(initial=np.inf) for one in walls)
    first, last = min(one["time_s"][0] for one in walls), max(one["time_s"][-1] for one in walls)
    return max(float(first), float(slid - 0.1 * (last - slid)))


def _corners(one):
    """Edges of times (t + 1,), and of cells along the wall (c + 1,)."""
    time = one["time_s"]
    step = time[-1] - time[-2] if len(time) > 1 else 1.0
    return np.append(time, time[-1] + step), np.concatenate(([0.0], np.cumsum(one["length_m"])))
