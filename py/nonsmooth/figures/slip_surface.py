"""What slip laws have found along the walls of a slope, in space and time."""

from __future__ import annotations

import numpy as np

from ..system import checks
from . import given, style

__all__ = ["slip_surface"]

CELLS = checks.holds(
    "wall cell time_s length_m slip_m friction hottest_degC", "give columns of slip_surface.csv, as run.slip_surface"
)
WIDTH, PANEL = 10.5, 2.2


@given.takes(cells=CELLS)
@style.styled
def slip_surface(cells, path=None, pdf=False, times=None):
    """Of each wall, against time and the way along it: the highest temperature across the zone, where the law has one,
    and the friction by that of its beginning; from when something slides.

    ``cells``: columns of ``slip_surface.csv`` (:func:`~nonsmooth.records.read_surfaces`); ``times``: t0 to t5 to mark.
    Raises RecordsError where nothing has slipped.
    """
    if not len(cells["slip_m"]) or not np.any(cells["slip_m"] > 0):
        raise style.RecordsError("no cell has slipped; give those of a run in which something slid on a wall")
    walls = list(dict.fromkeys(cells["wall"].tolist()))
    of_walls = [_of(cells, wall) for wall in walls]
    panels = [(wall, one, what) for wall, one in zip(walls, of_walls) for what in _whats(one)]
    fig = style.figure(WIDTH, PANEL * len(panels) + 0.6, layout="constrained")
    axes = np.atleast_1d(fig.subplots(len(panels), 1, sharex=True))
    for ax, (wall, (time, edges, table), what) in zip(axes, panels):
        values = table[what]
        if what == "friction":
            shown = ax.pcolormesh(time, edges, values / values[:, :1], vmin=0, vmax=1, cmap="viridis", rasterized=True)
            label = "friction, share left"
        else:
            shown = ax.pcolormesh(time, edges, values, cmap="inferno", rasterized=True)
            label = "hottest [°C]"
        fig.colorbar(shown, ax=ax, pad=0.01, label=label)
        ax.set_xlim(_begin(cells), time[-1])
        ax.set_ylabel(f"way along {style.plain(wall)} [m]")
        style.mark_times(ax, times or {})
    axes[-1].set_xlabel("time [s]")
    return style.save(fig, path, pdf)


def _begin(cells):
    """When the picture begins [s]: a tenth of what follows before anything has slid by a thousandth of the longest."""
    slid = cells["time_s"][cells["slip_m"] > 1e-3 * cells["slip_m"].max()]
    return max(float(cells["time_s"].min()), float(slid.min() - 0.1 * (cells["time_s"].max() - slid.min())))


def _whats(of_wall):
    """Columns that are drawn of a wall."""
    _, _, table = of_wall
    return (*(["hottest_degC"] if np.isfinite(table["hottest_degC"]).any() else []), "friction")


def _of(cells, wall):
    """Edges of times (t + 1,), and of cells along the wall (c + 1,), and {column: values (c, t)}."""
    mine = cells["wall"] == wall
    time, count = np.unique(cells["time_s"][mine]), int(cells["cell"][mine].max()) + 1
    length = cells["length_m"][mine][:count]
    step = np.diff(time, append=2 * time[-1] - time[-2] if len(time) > 1 else time[-1] + 1)
    table = {name: cells[name][mine].reshape(len(time), count).T for name in ("hottest_degC", "friction")}
    return np.append(time, time[-1] + step[-1]), np.concatenate(([0.0], np.cumsum(length))), table
