"""How the computation went: the energy balance and the contact solver."""

import numpy as np

from ..measure.energy import balance_error
from . import given, style
from .style import INK, LINES

__all__ = ["energy", "solver"]


def _row(fig, rows, titles, time, times):
    axes = fig.subplots(rows, 1, sharex=True)
    for k, (ax, title) in enumerate(zip(np.atleast_1d(axes), titles)):
        ax.set_xlim(time[0], max(time[-1], time[0] + 1e-9))
        ax.set_title(title, loc="left", pad=26 if times and k == 0 else 6)
        style.mark_times(ax, times, labels=k == 0)
        ax.grid(axis="y", color="#e3e3e3", lw=0.7)
        ax.set_axisbelow(True)
    axes[-1].set_xlabel("time [s]")
    return axes


@given.takes(series=given.SERIES)
@style.styled
def energy(series, path=None, times=None, pdf=False, limit=0.02):
    """Where the energy goes, against time, and what the balance leaves over.

    ``series``: dict of columns. Above: changes since the first row of kinetic and potential energy, work of the water,
    losses and correction energy per metre of width; below: the error of the balance in per cent of all that the run
    turns over (:func:`~nonsmooth.measure.energy.balance_error`) with ``limit`` as a dashed line. ``times``: t0 to t5 to
    mark.
    """
    lines = (
        ("energy_potential_J", "potential", "blue", "-"),
        ("energy_sliding_J", "lost by sliding", "orange", "-"),
        ("energy_rolling_J", "lost by rolling", "orange", (0, (5, 1.5))),
        ("energy_impact_J", "lost in impacts", "orange", (0, (1, 1))),
        ("energy_kinetic_J", "kinetic", "green", "-"),
        ("energy_water_J", "work of pore water", "sky", (0, (4, 1.5))),
        ("energy_bonds_J", "lost on bonds", "purple", (0, (1, 1))),
        ("energy_correction_J", "overlap correction", "grey", (0, (3, 1, 1, 1))),
    )
    if "energy_eroded_J" in series:
        lines += (("energy_eroded_J", "left with disks taken out", "purple", "-"),)
    time, _, *values = style.need(series, "time_s", "energy_error_rel", *(name for name, *_ in lines))
    error = balance_error(series)
    values = [v - v[0] for v in values]
    largest = max(max(np.abs(v).max() for v in values), 1e-300)
    factor, unit = next(((f, u) for f, u in ((1e9, "GJ"), (1e6, "MJ"), (1e3, "kJ")) if largest >= f), (1.0, "J"))
    fig = style.figure(10, 6.6, layout="constrained")
    above, below = _row(
        fig,
        2,
        ("Energy since the start", "Error of the balance, of all that is turned over"),
        time,
        style.known_times(times),
    )
    above.get_gridspec().set_height_ratios((2.4, 1))
    for (_, label, colour, dash), v in zip(lines, values):
        above.plot(time, v / factor, color=LINES[colour], ls=dash, label=label)
    above.axhline(0, color="#555555", lw=0.7)
    above.set_ylabel(f"energy [{unit}/m]")
    above.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    below.plot(time, 100 * error, color=INK, lw=1.1)
    below.axhline(0, color="#555555", lw=0.7)
    for sign in (1, -1):
        below.axhline(sign * 100 * limit, color=LINES["orange"], lw=0.9, ls=(0, (4, 3)))
    reach = 130 * max(limit, np.abs(error).max())
    below.set_ylim(-reach if error.min() < 0 else -0.05 * reach, reach)
    below.text(1.005, 100 * limit, f"limit {100 * limit:g} %", transform=below.get_yaxis_transform(), va="center",
               color=LINES["orange"], fontsize=9)  # fmt: skip
    below.set_ylabel("error [%]")
    return style.save(fig, path, pdf)


@given.takes(series=given.SERIES)
@style.styled
def solver(series, path=None, times=None, pdf=False):
    """Sweeps, residual and overlaps of the contact solver against time.

    ``series``: dict of columns. Overlaps in per cent of the mean diameter with the project's limits (2 % worst, 0.1 %
    mean) as lines. ``times``: t0 to t5 to mark.
    """
    time, sweeps, residual, tolerance, worst, mean = style.need(
        series, "time_s", "iterations", "residual", "tolerance", "overlap_worst_rel", "overlap_mean_rel"
    )
    fig = style.figure(10, 8, layout="constrained")
    a, b, c = _row(
        fig, 3, ("Sweeps per step", "Residual at the end of the step", "Overlap of the contacts"), time,
        style.known_times(times),
    )  # fmt: skip
    dots = {"ls": "", "marker": ".", "ms": 2.2, "rasterized": True, "alpha": 0.5}
    window = (time[-1] - time[0]) / 100
    a.plot(time, sweeps, color=LINES["sky"], **dots)
    a.plot(time, style.running_mean(time, sweeps, window), color=LINES["blue"], label=f"mean {sweeps.mean():.0f}")
    a.set_ylim(0, 1.1 * max(sweeps.max(), 1))
    a.set_ylabel("sweeps")
    a.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    floor = residual[residual > 0].min() if (residual > 0).any() else 1e-16
    residual = np.maximum(residual, floor)
    b.plot(time, residual, color=LINES["sky"], **dots)
    within = np.mean(residual <= tolerance * (1 + 1e-6))
    b.plot(
        time,
        tolerance,
        color=LINES["orange"],
        lw=1.3,
        ls=(0, (4, 3)),
        label=f"tolerance, kept by\n{100 * within:.0f} % of the steps",
    )
    b.set_yscale("log")
    b.set_ylabel("residual [-]")
    b.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    for values, label, colour, limit in ((worst, "worst", "orange", 2.0), (mean, "mean", "blue", 0.1)):
        shown = np.where(values > 0, 100 * values, np.nan)
        c.plot(time, shown, color=LINES[colour], lw=1.2, label=label)
        c.axhline(limit, color=LINES[colour], lw=0.9, ls=(0, (4, 3)), label=f"limit {limit:g} %")
    c.set_yscale("log")
    c.set_ylabel("overlap [% of $\\ell$]")
    c.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return style.save(fig, path, pdf)
