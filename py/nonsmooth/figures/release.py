"""How pore pressure goes from a slope that fails: by one rule of release beside others."""

import numpy as np
from matplotlib.colors import LinearSegmentedColormap, to_rgba
from matplotlib.lines import Line2D

from ..measure.ground import ground_of
from ..system import checks
from . import given, style

__all__ = ["releases"]

THIN, ALPHA = 0.9, 0.75  # of lines of single packings
AHEAD = 3.0  # s before t2 that are drawn
SHARES = LinearSegmentedColormap.from_list("released", [style.WET[0], style.RELEASED[0]])
LINES = given.cases("(series, times)", given.SERIES, given.TIMES)


def _colours(snapshot):
    """RGBA (N, 4): dry disks ochre, those that water has acted on from blue to pink by the share that is released."""
    share = snapshot.released.astype(float) if snapshot.released_share is None else snapshot.released_share
    made = SHARES(share)
    made[~(snapshot.wet | snapshot.released)] = to_rgba(style.DRY[0])
    return made


@given.takes(
    cases=given.cases(
        "(label, [(series, times)], Snapshot, walls)", None, LINES, given.snapshot("wet", "released"), given.WALLS
    ),
    seconds=checks.real("give a time [s]"),
)
@style.styled
def releases(cases, path=None, pdf=False, seconds=20.0):
    """Slopes of the same packings whose water is released by different rules: above, the force of the pore water on
    what the slip surfaces bear, by what it was at t2, a thin line for each packing, from t2 to ``seconds`` later;
    below, one packing of each with its disks coloured by how much of the pressure on them has been released.

    ``cases``: list of (label, [(series, times t0 … t5 [s]), one a packing], Snapshot, walls); slopes that did not
    accelerate are left out.
    """
    cases = [
        (label, [(one, style.known_times(times)) for one, times in lines], snapshot, ground_of(walls))
        for label, lines, snapshot, walls in cases
    ]
    cases = [
        (label, there, snapshot, ground)
        for label, lines, snapshot, ground in cases
        if (there := [(one, times["t2"]) for one, times in lines if "t2" in times])
    ]
    if not cases:
        raise style.RecordsError("no slope came to accelerate; give those of runs that have t2")
    views = [style.view([snapshot], ground) for _, _, snapshot, ground in cases]
    view = tuple(f(v[k] for v in views) for k, f in enumerate((min, max, min, max)))
    width, top = 9.0, 3.3
    height = width * (view[3] - view[2]) / (view[1] - view[0])
    total = top + height * len(cases) + 0.1
    fig = style.figure(width, total)
    ax = fig.add_axes([0.085, 1 - (top - 0.55) / total, 0.9, (top - 0.75) / total])
    colours = style.line_colours(len(cases))
    for colour, (_, lines, _, _) in zip(colours, cases):
        for series, t2 in lines:
            t, force = style.need(series, "time_s", "dp_water_N_per_m")
            whole = force[np.searchsorted(t, t2 - 1e-9)]
            shown = (t >= t2 - AHEAD) & (t <= t2 + seconds) & (whole > 0)
            ax.plot(t[shown] - t2, force[shown] / (whole or 1.0), color=colour, lw=THIN, alpha=ALPHA)
    handles = [Line2D([], [], color=c, lw=1.4, label=style.plain(label)) for c, (label, *_) in zip(colours, cases)]
    ax.set(xlabel="time since $t_2$ [s]", ylabel="force of the water, of that at $t_2$", xlim=(-AHEAD, seconds))
    ax.set_ylim(bottom=0)
    ax.grid(color="#e3e3e3", lw=0.7)
    ax.legend(handles=handles, loc="upper right")
    for k, (label, lines, snapshot, ground) in enumerate(cases):
        below = fig.add_axes([0, (0.1 + height * (len(cases) - 1 - k)) / total, 1, height / total])
        style.frame(below, *view)
        style.draw_walls(below, ground)
        style.draw_disks(below, snapshot, _colours(snapshot))
        right = ground.side > 0
        told = f"{style.plain(label)}, {snapshot.time_s - lines[0][1]:.1f} s after $t_2$"
        below.text(
            0.985 if right else 0.015, 0.93, told, transform=below.transAxes, ha="right" if right else "left", va="top",
            fontsize=12, fontweight="bold", color=colours[k], zorder=8, path_effects=style.EDGE,
        )  # fmt: skip
        if k == len(cases) - 1:
            style.scale_bar(below, 0.2 if right else 0.95, 0.08, 0.15)
    return style.save(fig, path, pdf)
