"""Figures of heaps: profiles on the way, runout and height against the aspect ratio."""

import numpy as np

from ..measure import heap as measures, power_laws as scaling
from ..records import RecordsError
from ..world.scene_arrays import Scene
from . import moving, style
from .style import LINES

__all__ = ["beside", "collapse", "film", "runout"]

MARKERS = ("o", "s", "^", "D", "v", "P")


def _stripes(x):
    """RGBA (n, 4): five colours from left to right, of disks where they began."""
    return style.layer_colours(np.minimum(4, np.argsort(np.argsort(x, kind="stable"), kind="stable") * 5 // len(x)))


def film(times, places, r, unit, path, gate=None):
    """A video of a heap's course in the colours of :func:`collapse`: arguments as there; ``path`` ends in .mp4 or .gif.
    The gate is there at the first time only.

    Returns the path. Raises RecordsError where there is no place, and for a file that cannot be made.
    """
    if not len(times):
        raise RecordsError("no places are kept: run the heap with frames")
    colours, none = _stripes(places[0][0])[:, :3], np.zeros(0)
    ends = [measures.fronts(x, r, measures.connected(x, y, r)) for x, y in (places[0], places[-1])]
    left, right, high = min(e[0] for e in ends), max(e[1] for e in ends), max(float(np.max(y + r)) for _, y in places)
    margin = 0.04 * max(right - left, high)
    view = (left - margin, right + margin, -2.2 * margin, high + margin)  # room for the scale
    whole = np.zeros(len(r), int)
    frames = []
    for k, (t, (x, y)) in enumerate(zip(times, places)):
        gates = [np.array([[g, 0.0], [g, high]]) for g in gate or () if k == 0]
        ids = np.zeros(0, int)
        frames.append(
            (t, Scene(x, y, r, whole, whole > 0, gates, [(1, 0.0)], ids, ids, none, none, none, none > 0, colours))
        )
    return moving.write(
        frames, path, fps=15, words=lambda t, _: f"{t / unit:.1f} T,  $T=\\sqrt{{H_0/g}}={unit:.2f}$ s", view=view
    )


@style.styled
def collapse(times, places, r, unit, path=None, width=None, gate=None, pdf=False):
    """Disks of a heap at several times, one below the other, to one scale, each with the outline of its connected mass.

    ``times`` [s]; ``places``: (x, y) for each, arrays of shape (n,) [m]; ``r`` [m]; ``unit``: T = √(H₀/g) [s].
    ``gate``: x of lines where sides stood. ``width``: L₀ [m], the unit of the axes; None: metres. The last time is
    called the end.
    """
    if not len(times):
        raise RecordsError("no places are kept: run the heap with frames")
    scale = width or 1.0
    joined = [measures.connected(x, y, r) for x, y in places]
    # what rolls far ahead of the mass would make all else small
    left = min(measures.fronts(x, r, m)[0] for (x, _), m in zip(places, joined))
    right = max(measures.fronts(x, r, m)[1] for (x, _), m in zip(places, joined))
    span = 1.06 * (right - left)
    heights = [max(float(np.max((y + r)[m])), 0.1 * span) for (_, y), m in zip(places, joined)]
    # placed by hand, in inches: the same scale and the same left edge for all
    margin, between, below = 0.62, 0.18, 0.5
    wide = min(7.2, (10.5 - below - between * len(times)) * span / (1.07 * sum(heights)))
    tall = [1.07 * h / span * wide for h in heights]
    whole = (margin + wide + 0.1, below + sum(tall) + between * len(times))
    fig = style.figure(*whole)
    tops = whole[1] - np.cumsum([between + h for h in tall])
    axes = [
        fig.add_axes((margin / whole[0], bottom / whole[1], wide / whole[0], h / whole[1]))
        for bottom, h in zip(tops, tall)
    ]
    colours = _stripes(places[0][0])
    for k, (ax, t, (x, y), mass) in enumerate(zip(axes, times, places, joined)):
        shown = type("Disks", (), dict(x=x / scale, y=y / scale, r=r / scale))
        style.draw_disks(ax, shown, colours)
        at, height = measures.surface(x, y, r, mass)
        ax.plot(at / scale, height / scale, color=style.INK, lw=1.0)
        ax.axhline(0, color=style.WALL, lw=1.2)
        for g in gate or ():
            ax.axvline(g / scale, color=LINES["grey"], lw=0.9, ls=(0, (4, 3)))
        ax.set_xlim((left - 0.01 * span) / scale, (left + 0.99 * span) / scale)
        ax.set_ylim(-0.02 * heights[k] / scale, 1.05 * heights[k] / scale)
        if k < len(times) - 1:
            ax.set_xticklabels([])
        name = "at rest" if k == len(times) - 1 else f"t = {t / unit:.1f} T"
        ax.text(0.99, 0.93, f"{name} ({t:.2f} s)", transform=ax.transAxes, ha="right", va="top")
        ax.set_ylabel("$y/L_0$" if width else "$y$ [m]")
    axes[-1].set_xlabel(("$x/L_0$" if width else "$x$ [m]") + f"          $T=\\sqrt{{H_0/g}}={unit:.2f}$ s")
    return style.save(fig, path, pdf)


@style.styled
def beside(runs, path=None, pdf=False):
    """Several runs of one heap: the deposit of each, one below the other and to one scale, and beside them the fall of
    the centres of mass.

    ``runs``: {label: run}, each with ``summary`` and ``series`` of heaps.course.HeapResult, ``places()`` as
    heaps.study.frames and its ``heap``, as a campaign.HeapRun. Lengths are in units of L₀, times in T = √(H₀/g) of
    each.
    """
    if not runs:
        raise RecordsError("there are no runs to set beside each other; give one or more")
    shown = []
    for label, run in runs.items():
        _, places, r = run.places()
        x, y, width = *places[-1], run.summary["width_m"]
        mass = measures.connected(x, y, r)
        first = places[0][0]
        colours = np.minimum(4, np.argsort(np.argsort(first, kind="stable"), kind="stable") * 5 // len(first))
        disks = type("Disks", (), dict(x=(x - run.heap.place()) / width, y=y / width, r=r / width))
        shown.append((label, run, disks, mass, style.layer_colours(colours)))
    left = min(float((d.x - d.r)[m].min()) for _, _, d, m, _ in shown)
    right = max(float((d.x + d.r)[m].max()) for _, _, d, m, _ in shown)
    top = max(float((d.y + d.r)[m].max()) for _, _, d, m, _ in shown)
    margin = 0.03 * (right - left)
    tall = 5.6 * (top + 2 * margin) / (right - left + 2 * margin) + 0.35
    fig = style.figure(11.0, max(3.4, 0.7 + tall * len(shown)), layout="constrained")
    grid = fig.add_gridspec(len(shown), 2, width_ratios=(1.35, 1))
    for k, (label, _, disks, _, colours) in enumerate(shown):
        ax = fig.add_subplot(grid[k, 0])
        style.draw_disks(ax, disks, colours)
        ax.axhline(0, color=style.WALL, lw=1.2)
        ax.set_xlim(left - margin, right + margin)
        ax.set_ylim(-margin, top + margin)
        ax.set_aspect("equal")
        ax.set_ylabel("$y/L_0$")
        ax.set_title(label, loc="left")
        if k < len(shown) - 1:
            ax.set_xticklabels([])
    ax.set_xlabel("$x/L_0$")
    way = fig.add_subplot(grid[:, 1])
    tints = (LINES["blue"], LINES["orange"], LINES["green"], LINES["purple"], LINES["sky"], LINES["grey"])
    for k, (label, run, *_) in enumerate(shown):
        s, told = run.series, run.summary
        way.plot(
            s["time_s"] / told["fall_time_s"],
            s["centroid_y_m"] / s["centroid_y_m"][0],
            color=tints[k % len(tints)],
            label=f"{label}: run-out {told['runout_rel']:.2f}",
        )
    way.set_xlabel("time since the release, $t/T$")
    way.set_ylabel("height of the centre of mass, by that at the release")
    way.grid(color="#e3e3e3", lw=0.7)
    way.legend(loc="upper right", fontsize=9)
    return style.save(fig, path, pdf)


@style.styled
def runout(groups, path=None, pdf=False):
    """Runout and final height against the aspect ratio, on logarithmic axes, with fits and the published laws.

    ``groups``: {label: {"aspect", "runout", "height": arrays (n,); "fits": {"runout", "height": pairs of scaling.Fit or
    None}; "changes": {"runout", "height": the aspect ratio between the two}}}.
    """
    fig = style.figure(10, 4.9, layout="constrained")
    panels = (
        ("runout", "Runout", "$(L_f-L_0)/L_0$", scaling.RUNOUT),
        ("height", "Final height", "$H_f/L_0$", scaling.HEIGHT),
    )
    for ax, (name, title, label, laws) in zip(fig.subplots(1, 2), panels):
        every = np.concatenate([g["aspect"] for g in groups.values()])
        low, high = 0.85 * every.min(), 1.15 * every.max()
        for law, colour, dash in zip(laws, (LINES["orange"], LINES["green"]), ("--", ":")):
            named = law.source  # of the first of its lines that is drawn
            for k, ends in enumerate(((low, min(law.change, high)), (max(law.change, low), high))):
                if ends[0] < ends[1]:
                    c, n = law.pieces[k]
                    ax.plot(ends, [c * a**n for a in ends], color=colour, ls=dash, label=named)
                    named = None
        for (group, g), colour, marker in zip(
            groups.items(), (LINES["blue"], LINES["purple"], LINES["sky"], LINES["grey"]) * 3, MARKERS * 2
        ):
            ax.plot(g["aspect"], g[name], ls="none", marker=marker, ms=5, mfc="white", color=colour, label=group)
            for k, fit in enumerate(g["fits"][name]):
                if fit is not None:
                    change = g["changes"][name]
                    inside = g["aspect"][g["aspect"] < change] if k == 0 else g["aspect"][g["aspect"] >= change]
                    ends = np.array([inside.min(), inside.max()])
                    sure = "" if np.isnan(fit.exponent_95) else f"\\pm{fit.exponent_95:.2f}"
                    ax.plot(
                        ends,
                        fit(ends),
                        color=colour,
                        lw=1.2,
                        label=f"fit: ${fit.factor:.2f}\\,a^{{{fit.exponent:.2f}{sure}}}$",
                    )
        ax.set_xscale("log")
        ax.set_yscale("log")
        for axis in (ax.xaxis, ax.yaxis):
            axis.set_major_formatter(lambda v, _: f"{v:g}")
            axis.set_minor_formatter("")
        ax.set_xticks([t for t in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50) if low <= t <= high])
        lowest, highest = ax.get_ylim()
        ax.set_yticks([t for t in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100) if lowest <= t <= highest])
        ax.set_xlabel("aspect ratio $a=H_0/L_0$")
        ax.set_ylabel(label)
        ax.set_title(title, loc="left")
        ax.grid(color="#e3e3e3", lw=0.7, which="major")
        ax.set_axisbelow(True)
        ax.legend(loc="upper left", fontsize=8)
    return style.save(fig, path, pdf)
