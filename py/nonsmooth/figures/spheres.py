"""Figures of scenes of spheres: cuts on the way, run-out of columns, discharge of hoppers, angles of drums and piles.
Needs no YADE.
"""

from __future__ import annotations

import math

import numpy as np
from matplotlib.collections import EllipseCollection
from matplotlib.ticker import MaxNLocator

from ..measure import sphere_laws as laws
from ..records import RecordsError
from . import style
from .style import LINES

__all__ = ["course", "discharge", "reposes", "runout", "tilts"]

MOST = 6  # cuts of one figure
MARKERS = ("o", "s", "^", "D", "v", "P")


@style.styled
def course(seen, run, path=None, pdf=False):
    """A run of spheres at some times: a slice two mean diameters thick along the axis, seen from the side; colours say
    how far from the axis, or how high in a drum, a sphere began.

    ``seen``: Places of the run in the order of time (:func:`.studies.spheres.places.read_all`), with ``at`` (n, 3),
    ``r``, ``number``, ``time_s``; ``run``: its numbers. Of more than six times the first, the last and four between
    are drawn.
    """
    if not len(seen):
        raise RecordsError("no places are kept: let the run go on to its end")
    kind, unit, size = run["scene"]["kind"], run["unit_s"], run["scene"]["diameter"]
    if len(seen) > MOST:
        seen = [seen[k] for k in np.unique(np.linspace(0, len(seen) - 1, MOST).round().astype(int))]
    first = seen[0]
    began = np.full(int(max(p.number.max() for p in seen)) + 1, np.nan)
    by = first.at[:, 2] if kind in ("drum", "hopper", "triaxial") else np.hypot(first.at[:, 0], first.at[:, 1])
    began[first.number] = np.argsort(np.argsort(by, kind="stable"), kind="stable") * 5 // len(by)
    # what rolls far ahead of the mass would make all else small
    reach = max(float(np.percentile(np.abs(p.at[:, 0]), 97)) for p in seen) + 3 * size
    high = max(float(np.max(p.at[:, 2] + p.r)) for p in seen)
    low = min(0.0, min(float(np.min(p.at[:, 2] - p.r)) for p in seen))
    if kind in ("drum", "hopper"):
        reach = 1.05 * run["radius_m"]
    if kind == "drum":
        high, low = run["radius_m"], -run["radius_m"]
    columns = min(2 if 2 * reach > 1.6 * (high - low) else 3, len(seen))
    rows = math.ceil(len(seen) / columns)
    wide = (9.0 - 0.5) / columns - 0.15
    fig = style.figure(9.0, rows * (wide * (high - low + size) / (2 * reach) + 0.4) + 0.5, layout="constrained")
    axes = fig.subplots(rows, columns, squeeze=False, sharex=True, sharey=True).ravel()
    for ax, p in zip(axes, seen):
        cut = np.abs(p.at[:, 1]) < size
        order = np.argsort(np.abs(p.at[cut, 1]))[::-1]
        x, z, r = p.at[cut, 0][order], p.at[cut, 2][order], p.r[cut][order]
        colours = style.layer_colours(began[p.number[cut][order]].astype(int))
        ax.add_collection(
            EllipseCollection(
                2 * r, 2 * r, np.zeros(len(r)), units="x", offsets=np.column_stack((x, z)), transOffset=ax.transData,
                facecolors=colours, edgecolors="#00000055", linewidths=0.2,
            )
        )  # fmt: skip
        _draw_walls(ax, run)
        ax.set_xlim(-reach, reach)
        ax.set_ylim(low - 0.5 * size, high + 0.5 * size)
        ax.set_aspect("equal")
        ax.xaxis.set_major_locator(MaxNLocator(5, prune="both"))
        ax.set_title(f"{p.time_s / unit:.1f} T", loc="right", fontsize=9, pad=2)
    for ax in axes[len(seen) :]:
        ax.set_visible(False)
    told = {"drum": r"\sqrt{R/g}", "triaxial": r"d\,\sqrt{\rho/\sigma_3}"}.get(kind, r"\sqrt{h_0/g}")
    fig.supxlabel(f"x [m]          $T={told}$ = {unit:.3g} s", fontsize=9.5)
    fig.supylabel("z [m]", fontsize=9.5)
    return style.save(fig, path, pdf)


def _draw_walls(ax, run):
    kind, radius = run["scene"]["kind"], run.get("radius_m")
    line = dict(color=style.WALL, lw=1.2, zorder=0)
    if kind == "triaxial":  # whose plates stand where the spheres end
        return
    if kind == "drum":
        turn = np.linspace(0, 2 * math.pi, 200)
        ax.plot(radius * np.cos(turn), radius * np.sin(turn), **line)
    elif kind == "column":
        ax.axhline(0, **line)
    elif kind == "pile":
        ax.plot([-radius, radius], [0, 0], **line)
    else:
        half = 0.5 * run["opening_m"]
        for side in (-1, 1):
            ax.plot([side * half, side * radius, side * radius], [0, 0, 2 * run["height_m"]], **line)
    if kind in ("column", "pile"):
        for side in (-1, 1):
            ax.axvline(side * radius, color=LINES["grey"], lw=0.8, ls=(0, (4, 3)), zorder=0)


def _log_axes(ax):
    ax.set_xscale("log")
    ax.set_yscale("log")
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_formatter(lambda v, _: f"{v:g}")
        axis.set_minor_formatter("")
    ticks = (0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1, 2, 3, 5, 10, 20, 50)
    for axis, ends in ((ax.set_xticks, ax.get_xlim()), (ax.set_yticks, ax.get_ylim())):
        axis([t for t in ticks if ends[0] <= t <= ends[1]])
    ax.grid(color="#e3e3e3", lw=0.7, which="major")
    ax.set_axisbelow(True)


def _with(groups, name):
    """Those that have a mean: a hopper that was stopped early has no rate, a column without friction no run-out."""
    return [group for group in groups if group[name]["mean"] is not None]


def _bars(groups, name):
    """Means and half widths, 0 where there is none."""
    pairs = [(group[name]["mean"], group[name]["half_width"] or 0.0) for group in groups]
    return np.array([m for m, _ in pairs], float), np.array([h for _, h in pairs])


@style.styled
def runout(groups, path=None, pdf=False):
    """Run-out and final height of round columns against the aspect ratio, means over seeds with their 95 % intervals,
    and the published laws.

    ``groups``: of :func:`.studies.spheres.report.summarise`.
    """
    if not groups:
        raise RecordsError("there are no columns to draw; give one or more")
    fig = style.figure(10, 4.6, layout="constrained")
    worlds = list(dict.fromkeys(group["world"] for group in groups))
    panels = (
        ("runout_rel", "Run-out", r"$(r_\infty-r_0)/r_0$", laws.RUNOUT),
        ("final_height_rel", "Final height", r"$h_\infty/r_0$", laws.HEIGHT),
    )
    for ax, (name, title, label, published) in zip(fig.subplots(1, 2), panels):
        every = [group["aspect"]["mean"] for group in groups]
        low, high = 0.85 * min(every), 1.15 * max(every)
        for law, colour, dash in zip(published, (LINES["orange"], LINES["green"]), ("--", ":")):
            named = law.source  # of the first of its lines that is drawn
            for k, ends in enumerate(((low, min(law.change, high)), (max(law.change, low), high))):
                if ends[0] < ends[1]:
                    c, n = law.pieces[k]
                    ax.plot(ends, [c * a**n for a in ends], color=colour, ls=dash, label=named)
                    named = None
        for world, colour, marker in zip(worlds, (LINES["blue"], LINES["purple"]), MARKERS):
            mine = [group for group in _with(groups, name) if group["world"] == world]
            if not mine:
                continue
            (x, dx), (y, dy) = _bars(mine, "aspect"), _bars(mine, name)
            ax.errorbar(
                x,
                y,
                dy,
                dx,
                ls="none",
                marker=marker,
                ms=5,
                mfc="white",
                color=colour,
                capsize=2,
                label=f"{world} spheres",
            )
            if name == "runout_rel" and "runout_95_rel" in mine[0]:
                y, _ = _bars(mine, "runout_95_rel")
                mass = f"{world} spheres, 95 % of the mass"
                ax.plot(x, y, ls="none", marker="x", ms=4, color=colour, alpha=0.7, label=mass)
        _log_axes(ax)
        ax.set_xlabel("aspect ratio $a=h_0/r_0$")
        ax.set_ylabel(label)
        ax.set_title(title, loc="left")
        ax.legend(loc="upper left", fontsize=8)
    return style.save(fig, path, pdf)


@style.styled
def discharge(series, summary, path=None, pdf=False):
    """What has left hoppers against time, and the rate beside Beverloo's law against the opening.

    ``series``: {name: columns of series.csv}; ``summary``: of :func:`.studies.spheres.report.summarise`.
    """
    if not series:
        raise RecordsError("there are no hoppers to draw; give one or more")
    fig = style.figure(10, 4.4, layout="constrained")
    left, right = fig.subplots(1, 2)
    openings = sorted({run["scene"]["opening"] for run in summary["runs"].values()})
    tints = dict(zip(openings, style.line_colours(len(openings))))
    shown = set()
    for name, run in summary["runs"].items():
        s, asked = series[name], run["scene"]
        unit = math.sqrt(asked["diameter"] / asked["gravity"])
        key = asked["opening"], run["world"]
        label = None if key in shown else f"D = {asked['opening']:g} d, {run['world']}"
        shown.add(key)
        mass = np.asarray(s["discharged_spheres"], float) / run["spheres"]
        dash = "-" if run["world"] == "hard" else ":"
        left.plot(np.asarray(s["time_s"]) / unit, mass, color=tints[asked["opening"]], ls=dash, lw=1.2, label=label)
    left.set_xlabel(r"time since the opening [$\sqrt{d/g}$]")
    left.set_ylabel("share of the spheres that has left")
    left.legend(loc="lower right", fontsize=8)
    groups = summary["groups"]
    fine = np.linspace(min(2.0, 0.8 * openings[0]), 1.1 * openings[-1], 200)
    right.plot(
        fine,
        0.58 * np.maximum(fine - 1.4, 0) ** 2.5,
        color=LINES["orange"],
        ls="--",
        label="Beverloo, C = 0.58, k = 1.4",
    )
    for world, colour, marker in zip(
        dict.fromkeys(g["world"] for g in groups), (LINES["blue"], LINES["purple"]), MARKERS
    ):
        mine = [group for group in _with(groups, "rate_rel") if group["world"] == world]
        if not mine:
            continue
        y, dy = _bars(mine, "rate_rel")
        x = [group["asked"]["opening"] for group in mine]
        right.errorbar(
            x, y, dy, ls="none", marker=marker, ms=5, mfc="white", color=colour, capsize=2, label=f"{world} spheres"
        )
    right.set_xlabel("opening $D/d$")
    right.set_ylabel(r"rate $W/(\rho_b\,\sqrt{g}\,d^{5/2})$")
    right.legend(loc="upper left", fontsize=8)
    for ax in (left, right):
        ax.grid(color="#e3e3e3", lw=0.7)
        ax.set_axisbelow(True)
    return style.save(fig, path, pdf)


@style.styled
def tilts(series, summary, path=None, pdf=False):
    """Angle of the surface in drums against how far they have turned. Arguments as of :func:`discharge`."""
    if not series:
        raise RecordsError("there are no drums to draw; give one or more")
    fig = style.figure(7.2, 4.0, layout="constrained")
    ax = fig.subplots()
    for (name, run), colour in zip(summary["runs"].items(), style.line_colours(len(series))):
        s = series[name]
        ax.plot(s["turned_deg"], s["tilt_deg"], color=colour, lw=1.3, label=f"{name}: {run['tilt_deg']:.1f}°")
        ax.plot(s["turned_deg"], s["tilt_surface_deg"], color=colour, lw=0.6, alpha=0.6)
    ax.set_xlabel("angle by which the drum has turned [°]")
    ax.set_ylabel("angle of the surface [°]\n(thick: by the centre of mass, thin: by the tops)")
    ax.grid(color="#e3e3e3", lw=0.7)
    ax.legend(loc="lower right", fontsize=8)
    return style.save(fig, path, pdf)


@style.styled
def reposes(groups, path=None, pdf=False):
    """Angle of repose of piles against friction, a line for each rolling friction; means over seeds with their 95 %
    intervals. ``groups``: of :func:`.studies.spheres.report.summarise`.
    """
    if not groups:
        raise RecordsError("there are no piles to draw; give one or more")
    fig = style.figure(6.4, 4.2, layout="constrained")
    ax = fig.subplots()
    groups = _with(groups, "repose_deg")
    lines = sorted({(group["world"], group["asked"]["rolling_friction"]) for group in groups})
    for (world, rolling), colour, marker in zip(lines, style.line_colours(len(lines)), MARKERS * 9):
        mine = sorted(
            (g for g in groups if (g["world"], g["asked"]["rolling_friction"]) == (world, rolling)),
            key=lambda g: g["asked"]["friction"],
        )
        y, dy = _bars(mine, "repose_deg")
        x = [group["asked"]["friction"] for group in mine]
        ax.errorbar(
            x,
            y,
            dy,
            marker=marker,
            ms=5,
            mfc="white",
            color=colour,
            capsize=2,
            lw=1,
            label=rf"$\mu_r$ = {rolling:g}, {world}",
        )
    ax.set_xlabel(r"friction $\mu_s$")
    ax.set_ylabel("angle of repose [°]")
    ax.set_ylim(bottom=0)
    ax.grid(color="#e3e3e3", lw=0.7)
    if lines:
        ax.legend(loc="lower left", fontsize=8)
    return style.save(fig, path, pdf)
