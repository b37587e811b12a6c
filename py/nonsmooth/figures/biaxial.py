"""Figures of biaxial tests: what the paper's Figures 9 to 11 show."""

import math

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from matplotlib.patches import Patch

from ..measure import strength
from ..records import RecordsError
from ..records.snapshots import read_with
from ..world.scene_arrays import Scene
from . import forces, given, moving, style

__all__ = ["MEGA", "chains", "draw_chains", "effects", "film", "mohr", "rotations", "stress", "stress_strain", "strong"]

MEGA = 1e6
PAPER = {4e6: "#000000", 8e6: "#6e6e6e", 16e6: "#b4b4b4"}  # Pa, and the greys of its Figure 10
SEQUENCE = ("#0072B2", "#D55E00", "#009E73", "#9E4F86", "#E0A100", "#4AA8DE", "#777777")


def _colours(count):
    return [SEQUENCE[k % len(SEQUENCE)] for k in range(count)]


@style.styled
def stress_strain(tests, path=None, pdf=False):
    """Axial stress over σ₃ and volumetric strain against axial strain (the paper's Figure 10).

    ``tests``: list of (σ₃ [Pa], series, measured): columns of `laboratory.biaxial.COLUMNS`, and the test's dictionary
    of ``summary.json``. Thin: rows; thick: the means over 0.2 % of strain whose largest is the peak; dots: peaks;
    dashes: the mean on the plateau.
    """
    fig = style.figure(7.6, 7.4, layout="constrained")
    top, bottom = fig.subplots(2, 1, sharex=True, height_ratios=(1.5, 1))
    for (sigma3, series, measured), colour in zip(tests, _colours(len(tests))):
        strain, axial = 100 * np.asarray(series["strain"]), strength.axial_stress(series)
        begin, mean = strength.running_mean(series["strain"], axial, strength.PEAK_WINDOW)
        top.plot(strain, axial / sigma3, color=colour, lw=0.4, alpha=0.35)
        top.plot(100 * (begin + strength.PEAK_WINDOW / 2), mean / sigma3, color=colour, label=f"{sigma3 / MEGA:g}")
        top.plot(
            100 * measured["strain_peak"],
            measured["sigma1_peak_Pa"] / sigma3,
            "o",
            ms=5,
            color=colour,
            mec="white",
            mew=0.7,
            zorder=5,
        )
        begin, end = measured["residual_between_strains"]
        top.hlines(
            measured["sigma1_residual_Pa"] / sigma3,
            100 * begin,
            100 * min(end, strain[-1] / 100),
            color=colour,
            lw=1.2,
            ls=(0, (4, 2)),
        )
        bottom.plot(strain, 100 * np.asarray(series["volumetric_strain"]), color=colour)
    top.set(ylabel="σ₁ / σ₃  [-]", ylim=(0, None))
    top.legend(title="σ₃ [MPa]", ncol=min(4, len(tests)), loc="lower right")
    bottom.axhline(0, color="#999999", lw=0.7)
    bottom.set(xlabel="axial strain ε₁ [%]", ylabel="volumetric strain [%]\n(dilation positive)", xlim=(0, None))
    return style.save(fig, path, pdf)


@style.styled
def stress(tests, path=None, pdf=False):
    """Axial stress itself and volumetric strain against axial strain, as the paper's Figure 10 has them, so that the
    two can be laid over each other.

    ``tests``: as of :func:`stress_strain`. The paper's pressures, 4, 8 and 16 MPa, are drawn in its greys, or where
    none of them was tested all others, which are ours.
    """
    theirs = [test for test in tests if test[0] in PAPER]
    fig = style.figure(7.6, 7.4, layout="constrained")
    top, bottom = fig.subplots(2, 1, sharex=True, height_ratios=(1.5, 1))
    others = iter(_colours(len(tests)))
    for sigma3, series, _ in theirs or tests:
        colour = PAPER.get(sigma3) or next(others)
        strain, whose = 100 * np.asarray(series["strain"]), "the paper's" if theirs else "ours"
        top.plot(strain, strength.axial_stress(series) / MEGA, color=colour, lw=1, label=f"{sigma3 / MEGA:g} ({whose})")
        bottom.plot(strain, 100 * np.asarray(series["volumetric_strain"]), color=colour)
    top.set(ylabel="σ₁ [MPa]", ylim=(0, None))
    top.legend(title="σ₃ [MPa]", loc="upper right")
    bottom.axhline(0, color="#999999", lw=0.7)
    bottom.set(xlabel="axial strain ε₁ [%]", ylabel="volumetric strain [%]\n(dilation positive)", xlim=(0, None))
    return style.save(fig, path, pdf)


@style.styled
def mohr(summary, path=None, pdf=False):
    """Mohr circles at the peak and on the plateau with their envelopes (the paper's Figure 11); right: the circles of
    low pressure.

    ``summary``: of a campaign with an envelope. Several seeds: circles of all, envelope with the mean cohesion and
    friction.
    """
    fig = style.figure(10.4, 4.6, layout="constrained")
    whole, close = fig.subplots(1, 2)
    tests = summary["tests"]
    lowest = sorted({t["confining_Pa"] for t in tests})
    limit = lowest[max(0, min(2, len(lowest) - 2))]
    kinds = [
        (kind, colour)
        for kind, colour in (("peak", style.LINES["blue"]), ("residual", style.LINES["orange"]))
        if summary[f"cohesion_{kind}_kPa"] is not None
    ]
    for ax, chosen in ((whole, tests), (close, [t for t in tests if t["confining_Pa"] <= limit])):
        far = 1.05 * max(t["sigma1_peak_Pa"] for t in chosen) / MEGA
        high = 0.0
        for kind, colour in kinds:
            c, angle = summary[f"cohesion_{kind}_kPa"], summary[f"friction_{kind}_deg"]
            for t in chosen:
                a, b = t[f"sigma3_{kind}_Pa"] / MEGA, t[f"sigma1_{kind}_Pa"] / MEGA
                turn = np.linspace(0, math.pi, 181)
                ax.plot(
                    0.5 * (a + b) + 0.5 * (b - a) * np.cos(turn),
                    0.5 * (b - a) * np.sin(turn),
                    color=colour,
                    lw=0.9,
                    alpha=0.8,
                )
                high = max(high, 0.5 * (b - a))
            x = np.array([0, far])
            ax.plot(
                x,
                1e-3 * c + x * math.tan(math.radians(angle)),
                color=colour,
                lw=2,
                label=f"{kind}: c′ = {c:.0f} kPa, φ′ = {angle:.1f}°",
            )
        ax.set(
            xlim=(0, far),
            ylim=(0, 1.6 * high),
            xlabel="normal stress [MPa]",
            ylabel="shear stress [MPa]",
            aspect="equal",
        )
    whole.set_title(f"{len(tests)} tests")
    close.set_title("the lowest pressures, where cohesion shows")
    whole.legend(loc="upper left")
    return style.save(fig, path, pdf)


def _frame(ax, *snapshots):
    """One scale for all: around the left and lower edge of each and the largest size."""
    width, height = (max(np.ptp(getattr(s, axis)) for s in snapshots) for axis in "xy")
    m, s = 0.03 * width, snapshots[0]
    x0 = 0.5 * (s.x.min() + s.x.max() - width)
    style.frame(ax, x0 - m, x0 + width + m, s.y.min() - m, s.y.min() + height + m)


def film(paths, words, path):
    """A video of a sample in the colours of :func:`rotations`: ``paths`` of its frames
    (:meth:`.laboratory.biaxial.BiaxialCourse.frame`), ``words`` beside the time. Returns the ``path``, .mp4 or .gif.

    Raises RecordsError where there is no frame, for one without angles or walls, and for a file that cannot be made.
    """
    shots = [read_with(one, "a biaxial test", "angle", "walls") for one in paths]
    none, ids = np.zeros(0), np.zeros(0, int)
    if not shots:
        raise RecordsError("there are no frames to make a video of; let the test write some first")
    turned = [s.angle - shots[0].angle for s in shots]
    heights = [np.ptp(s.walls[s.walls[:, 0] == 1, 1]) for s in shots]
    scale, strains = _turns(turned), {s.time_s: 1 - height / heights[0] for s, height in zip(shots, heights)}
    frames = []
    for s, angle in zip(shots, turned):
        count = len(s.x)
        frames.append(
            (
                s.time_s,
                Scene(
                    s.x, s.y, s.r, np.zeros(count, int), np.zeros(count, bool), [],
                    [(int(axis), float(at)) for axis, at in s.walls],
                    ids, ids, none, none, none, none > 0, scale.to_rgba(angle)[:, :3],
                ),
            )
        )  # fmt: skip
    return moving.write(
        frames, path, words=lambda t, _: f"ε₁ = {100 * strains[t]:.2f} %,  {words}",
        bar=(scale, "rotation [rad], counterclockwise positive"),
    )  # fmt: skip


def _turns(turned):
    """The colours of rotations, arrays [rad] of which a fiftieth may be beyond the scale's ends."""
    limit = max(0.02, style.nice(float(np.quantile(np.abs(np.concatenate(turned)), 0.98))))
    return ScalarMappable(Normalize(-limit, limit), "RdBu_r")


@style.styled
@given.takes(begin=given.snapshot("angle"), panels=given.cases("(title, Snapshot)", None, given.snapshot("angle")))
def rotations(begin, panels, path=None, pdf=False):
    """The sample coloured by the rotation of its disks since the begin of shear (the paper's Figure 9).

    ``begin``: the Snapshot then; ``panels``: list of (title, Snapshot).
    """
    shown = [s for _, s in panels]
    ratio = max(np.ptp(s.y) for s in shown) / max(np.ptp(s.x) for s in shown)
    width = 3.4
    fig = style.figure(width * len(panels) + 0.9, width * ratio + 0.5, layout="constrained")
    axes = fig.subplots(1, len(panels), squeeze=False)[0]
    turned = [s.angle - begin.angle for _, s in panels]
    scale = _turns(turned)
    for ax, (title, s), angle in zip(axes, panels, turned):
        _frame(ax, s, *shown)
        style.draw_disks(ax, s, scale.to_rgba(angle), edge="#00000030", width=0.15)
        ax.set_title(title)
    fig.colorbar(scale, ax=axes, shrink=0.5, label="rotation [rad], counterclockwise positive", extend="both")
    return style.save(fig, path, pdf)


def strong(snapshot):
    """The force [N/m] that bars are as wide as disks at: a fiftieth of the contacts bears more."""
    return max(float(np.quantile(np.abs(snapshot.cn), 0.98)), 1e-12)


def draw_chains(ax, snapshot, reference, *framed):
    """Draws a sample with its normal forces as bars between centres, whose width is that at ``reference`` [N/m] by the
    force; ``framed``: Snapshots that the frame holds.
    """
    _frame(ax, *framed)
    style.draw_disks(ax, snapshot, np.tile([0.95, 0.94, 0.91, 1.0], (len(snapshot.x), 1)), edge="#c9c4ba", width=0.2)
    for sign, colour in ((1, style.COMPRESSION), (-1, style.TENSION)):
        chosen = np.flatnonzero(sign * snapshot.cn > 0)
        ax.add_collection(
            PolyCollection(
                forces.force_bars(snapshot, chosen, reference, 1.2 * np.median(snapshot.r)),
                facecolors=colour,
                lw=0,
                zorder=3,
                rasterized=True,
            ),
            autolim=False,
        )


@style.styled
def chains(snapshot, title, path=None, pdf=False):
    """Normal forces of a sample as bars between centres, compression blue, tension red."""
    ratio = np.ptp(snapshot.y) / np.ptp(snapshot.x)
    fig = style.figure(5.2, 5.2 * ratio + 0.7, layout="constrained")
    ax = fig.subplots()
    draw_chains(ax, snapshot, strong(snapshot), snapshot)
    ax.set_title(title)
    fig.legend(
        handles=[Patch(color=style.COMPRESSION, label="compression"), Patch(color=style.TENSION, label="tension")],
        loc="lower center",
        ncol=2,
        bbox_to_anchor=(0.5, -0.004),
    )
    return style.save(fig, path, pdf)


@style.styled
def effects(rows, path=None, pdf=False):
    """Angles of friction of peak and plateau against what varies, one panel an effect; dots: samples, lines: means with
    their 95 % interval.

    ``rows``: of `laboratory.effects.run`.
    """
    names = list(dict.fromkeys(row["effect"] for row in rows))
    fig = style.figure(3.1 * len(names), 4.0, layout="constrained")
    for ax, name in zip(fig.subplots(1, len(names), sharey=True, squeeze=False)[0], names):
        chosen = sorted((row for row in rows if row["effect"] == name), key=lambda row: row["value"])
        values = [row["value"] for row in chosen]
        for kind, colour, word in (
            ("peak", style.LINES["blue"], "peak"),
            ("residual", style.LINES["orange"], "plateau"),
        ):
            for row in chosen:
                ax.plot(
                    [row["value"]] * len(row[f"{kind}_deg"]),
                    row[f"{kind}_deg"],
                    "o",
                    ms=3.5,
                    color=colour,
                    alpha=0.35,
                    mew=0,
                )
            ax.errorbar(
                values,
                [row[f"{kind}_mean_deg"] for row in chosen],
                [row[f"{kind}_95_deg"] or 0.0 for row in chosen],
                fmt="s-",
                ms=5,
                color=colour,
                capsize=3,
                lw=1.4,
                label=word,
            )
        ax.axvline(
            next(row["value"] for row in chosen if row["usual"]), color="#777777", lw=1, ls=(0, (4, 3)), zorder=0
        )
        ax.set(xscale="log", xlabel=chosen[0]["label"])
        ax.set_xticks(values, [f"{v:g}" for v in values])
        ax.minorticks_off()
        ax.grid(axis="y", color="#e3e3e3", lw=0.7)
    first = fig.axes[0]
    first.set_ylabel("angle of friction [°]")
    first.set_ylim(0, None)
    first.legend(loc="lower right")
    return style.save(fig, path, pdf)
