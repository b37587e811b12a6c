"""The table of calibrated rocks: angle of friction and cohesion against the friction of contacts. Needs no YADE."""

from __future__ import annotations

import numpy as np

from . import style

__all__ = ["table"]


@style.styled
def table(found, path=None, pdf=False):
    """Two panels against μ_s; dots: samples, squares: means with their 95 % interval, lines: the law between the rocks.

    ``found``: as `laboratory.rock_table.table` makes it. Returns the figure, or the path where one is given.
    """
    rows = found["rocks"]
    mu = np.array([row["friction"] for row in rows])
    between = np.exp(np.linspace(np.log(mu[0]), np.log(mu[-1]), 200))
    fig = style.figure(8.0, 3.6, layout="constrained")
    left, right = fig.subplots(1, 2)
    for ax, name, colour, label, law in (
        (left, "friction_angle_deg", style.LINES["blue"], "angle of friction φ [°]", (lambda v: v, lambda v: v)),
        (right, "cohesion_over_tensile_strength", style.LINES["orange"], "cohesion c / σ_ext", (np.log, np.exp)),
    ):
        means = np.array([row[name]["mean"] for row in rows])
        to, back = law
        ax.plot(
            between, back(np.interp(np.log(between), np.log(mu), to(means))), "-", color=colour, lw=1.4, label="law"
        )
        for row in rows:
            values = row[name]["values"]
            label_of = "sample" if row is rows[0] else None
            ax.plot(
                [row["friction"]] * len(values), values, "o", ms=3, color="#333333", mew=0, zorder=4, label=label_of
            )
        ax.errorbar(
            mu,
            means,
            [row[name]["half_width"] for row in rows],
            fmt="s",
            ms=5,
            color=colour,
            capsize=3,
            lw=1.4,
            label="mean, 95 % interval",
        )
        ax.set(xscale="log", xlabel="friction of contacts μ_s", ylabel=label, ylim=(0, None))
        ax.set_xticks(mu, [f"{m:g}" for m in mu])
        ax.minorticks_off()
        ax.grid(axis="y", color="#e3e3e3", lw=0.7)
        ax.legend(loc="lower right")
    return style.save(fig, path, pdf)
