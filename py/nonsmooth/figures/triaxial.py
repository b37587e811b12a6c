"""Figures of triaxial tests of spheres: curves of stress and volume, and the angle of friction against that of the
contacts. Needs no YADE.
"""

from __future__ import annotations

import numpy as np

from ..measure import sphere_laws as laws, triaxial as measures
from ..records import RecordsError
from . import style
from .style import LINES

__all__ = ["angles", "curves"]

MARKERS = ("o", "s", "^", "D", "v", "P")


def _grid(*axes):
    for ax in axes:
        ax.grid(color="#e3e3e3", lw=0.7)
        ax.set_axisbelow(True)


def _told(run):
    asked = run["scene"]
    return asked["friction"], asked["friction_share"], asked["pressure"], run["world"]


@style.styled
def curves(series, summary, path=None, pdf=False):
    """Deviator stress over mean stress, and volumetric strain, against axial strain: a line for each run, a colour for
    each case.

    ``series``: {name: columns of series.csv}; ``summary``: of :func:`.studies.spheres.report.summarise`.
    """
    if not series:
        raise RecordsError("there are no triaxial tests to draw; give one or more")
    fig = style.figure(7.2, 6.4, layout="constrained")
    top, bottom = fig.subplots(2, 1, sharex=True, height_ratios=(1.4, 1))
    cases = list(dict.fromkeys(_told(run) for run in summary["runs"].values()))
    words = ("μ", "share", "σ₃ =", "")
    differ = [k for k in range(4) if k == 0 or len({case[k] for case in cases}) > 1]
    tints = dict(zip(cases, style.line_colours(len(cases))))
    shown = set()
    for name, run in summary["runs"].items():
        s, case = series[name], _told(run)
        one, three = measures.axial(s), measures.lateral(s)
        parts = [f"{words[k]} {case[k]:g}" if k < 3 else case[k] for k in differ]
        label = None if case in shown else ", ".join(parts) + (" Pa" if 2 in differ else "")
        shown.add(case)
        strain = 100 * np.asarray(s["strain"])
        line = dict(color=tints[case], lw=0.9, alpha=0.85)
        top.plot(strain, 3 * (one - three) / (one + 2 * three), label=label, **line)
        bottom.plot(strain, 100 * np.asarray(s["volumetric_strain"]), **line)
    top.set_ylabel("deviator over mean stress q/p")
    top.set_ylim(bottom=0)
    top.legend(loc="upper right", fontsize=8, ncol=2)
    bottom.axhline(0, color="#999999", lw=0.7)
    bottom.set(xlabel="axial strain ε₁ [%]", ylabel="volumetric strain [%]\n(dilation positive)", xlim=(0, None))
    _grid(top, bottom)
    return style.save(fig, path, pdf)


def _bars(ax, groups, x, name, **how):
    pairs = sorted(
        (x(g["asked"]), g[name]["mean"], g[name]["half_width"] or 0.0) for g in groups if g[name]["mean"] is not None
    )
    if pairs:
        at, y, dy = np.transpose(pairs)
        ax.errorbar(at, y, dy, ms=5, mfc="white", capsize=2, lw=1, **how)


@style.styled
def angles(groups, path=None, pdf=False):
    """Angle of friction, of the critical state and of the peak, against the friction of the contacts; and packing
    fraction and coordination under isotropic pressure against that which the spheres had while they were pressed, with
    published values. Means over seeds with their 95 % intervals.

    ``groups``: of :func:`.studies.spheres.report.summarise`.
    """
    if not groups:
        raise RecordsError("there are no triaxial tests to draw; give one or more")
    fig = style.figure(10, 4.6, layout="constrained")
    grid = fig.add_gridspec(2, 2, width_ratios=(1.35, 1))
    left, upper, lower = fig.add_subplot(grid[:, 0]), fig.add_subplot(grid[0, 1]), fig.add_subplot(grid[1, 1])
    shares = sorted({(g["world"], g["asked"]["friction_share"]) for g in groups})
    for (world, share), colour, marker in zip(shares, style.line_colours(len(shares)), MARKERS):
        mine = [g for g in groups if (g["world"], g["asked"]["friction_share"]) == (world, share)]
        named = {0.0: "dense", 1.0: "loose"}.get(share, f"share {share:g}") + ("" if world == "hard" else f", {world}")
        how = dict(color=colour, marker=marker)
        _bars(left, mine, lambda a: a["friction"], "critical_deg", label=f"critical state, {named}", **how)
        _bars(left, mine, lambda a: a["friction"], "peak_deg", label=f"peak, {named}", ls=":", **how)
        for ax, name in ((upper, "isotropic_solid_fraction"), (lower, "isotropic_coordination")):
            _bars(ax, mine, lambda a: a["friction"] * share, name, label=named, **{**how, "ls": "none"})
    start, source = laws.PLATEAU_FROM
    end = left.get_xlim()[1]
    left.set_xlim(left=min(-0.02, left.get_xlim()[0]))
    if end > start:
        left.axvspan(start, end, color=LINES["orange"], alpha=0.12, lw=0, label=f"plateau of {source}")
        left.set_xlim(right=end)
    for ax, values in ((upper, laws.ISOTROPIC.solid_fraction), (lower, laws.ISOTROPIC.coordination)):
        published = dict(ls="none", marker="x", ms=8, mew=2, color=LINES["orange"], zorder=4)
        ax.plot(laws.ISOTROPIC.friction, values, label=laws.ISOTROPIC.source, **published)
    left.set(xlabel=r"friction of the contacts $\mu_s$", ylabel="angle of friction φ [°]", ylim=(0, None))
    left.legend(loc="lower right", fontsize=8)
    upper.set(ylabel="packing fraction Φ", title="under isotropic pressure")
    lower.set(ylabel="coordination z", xlabel="friction while pressed")
    upper.legend(loc="upper right", fontsize=8)
    _grid(left, upper, lower)
    return style.save(fig, path, pdf)
