"""A slope under an earthquake: the motion of the ground, and below it how far slip surfaces have slipped."""

from __future__ import annotations

import numpy as np

from ..system import checks
from . import given, style

__all__ = ["shaking"]

ROWS = (("acceleration", "m/s²"), ("velocity", "m/s"), ("displacement", "m"))  # of the ground, from the top
CURVES = given.cases(
    "(label, time, slip)",
    (lambda v: isinstance(v, str), ""),
    *2 * ((lambda v: isinstance(v, (list, tuple, np.ndarray)), ""),),
)
#: Horizontal, vertical: told apart by lightness too.
COMPONENTS = (("horizontal", style.INK, 1.2), ("vertical", style.LINES["sky"], 0.9))


@given.takes(surfaces=CURVES, blocks=CURVES)
@style.styled
def shaking(time, acceleration, velocity, displacement, surfaces=(), blocks=(), title=None, path=None, pdf=False):
    """Acceleration, velocity and displacement of the ground against time, one above another, and below them, against
    the same time, the slip along surfaces beside that of Newmark's block.

    ``time`` [s] (n,); ``acceleration`` [m/s²], ``velocity`` [m/s] and ``displacement`` [m] at these times, (n,)
    horizontal or (n, 2) horizontal and vertical, as a :class:`~nonsmooth.model.ground_motion.GroundMotion` gives them;
    a vertical component that is zero is left out. ``surfaces``: (label, time (m,) [s], slip (m,) [m]) of each slip
    surface, drawn as full lines; ``blocks``: the same of blocks, drawn as broken lines, in the colour of the surface
    that has the same place in the list. What is left at the end stands in the legend. ``title``: as the name and source
    of a motion, which say where it is synthetic.
    """
    time = _numbers("time", time, (1,))
    ground = [
        _numbers(name, value, (1, 2), len(time))
        for (name, _), value in zip(ROWS, (acceleration, velocity, displacement))
    ]
    curves = [
        [(label, *_curve(what, label, t, slip)) for label, t, slip in given_curves]
        for what, given_curves in (("surfaces", surfaces), ("blocks", blocks))
    ]
    slips = any(curves)
    fig = style.figure(10.0, 6.6 if slips else 4.6, layout="constrained")
    axes = fig.subplots(
        3 + slips, 1, sharex=True, squeeze=False, height_ratios=[1.3, 1.0, 1.0, *([2.0] if slips else [])]
    )[:, 0]
    shown = [k for k in (0, 1) if any(values.ndim == 2 and values[:, 1].any() for values in ground) or k == 0]
    for ax, (name, unit), values in zip(axes, ROWS, ground):
        for k in shown:
            column = values if values.ndim == 1 else values[:, k]
            if k == 0 or values.ndim == 2:
                label, colour, width = COMPONENTS[k]
                ax.plot(time, column, color=colour, lw=width, label=label, zorder=3 - k)
        ax.axhline(0, color="#999999", lw=0.6, zorder=0)
        ax.set_ylabel(f"{name}\n[{unit}]")
    if len(shown) > 1:
        axes[0].legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    _mark_peak(axes[0], time, ground[0])
    _mark_drift(axes[2], ground)
    if slips:
        _draw_slips(axes[3], *curves)
    last = max([time[-1], *(t[-1] for group in curves for _, t, _ in group)])
    axes[-1].set(xlabel="time [s]", xlim=(time[0], last))
    fig.align_ylabels(axes)
    if title is not None:
        axes[0].set_title(style.plain(title), loc="left")
    return style.save(fig, path, pdf)


def _mark_peak(ax, time, values):
    horizontal = values if values.ndim == 1 else values[:, 0]
    k = int(np.argmax(np.abs(horizontal)))
    ax.plot(time[k], horizontal[k], "o", ms=4, color=style.WEAKENED, zorder=4)
    ax.annotate(
        f"{abs(horizontal[k]):.2f} m/s²", (time[k], horizontal[k]), xytext=(6, 0), textcoords="offset points",
        va="center", color=style.WEAKENED, path_effects=style.EDGE, zorder=5,
    )  # fmt: skip


def _mark_drift(ax, ground):
    """What the base has left at the end, horizontally, since nobody has corrected it."""
    velocity, place = (float(np.ravel(values[-1])[0]) for values in ground[1:])
    told = f"left at the end, horizontally: {velocity:.2g} m/s, {place:.2g} m".replace("-", "−")
    ax.text(0.995, 1.0, told, transform=ax.transAxes, ha="right", va="bottom", fontsize=8.5)


def _draw_slips(ax, surfaces, blocks):
    colours = style.line_colours(max(len(surfaces), len(blocks)))
    for group, dashes in ((surfaces, "-"), (blocks, (0, (5, 2)))):
        for (label, t, slip), colour in zip(group, colours):
            told = f"{style.plain(label)}: {slip[-1]:.3g} m"
            ax.plot(t, slip, color=colour, ls=dashes, lw=1.6 if dashes == "-" else 1.3, label=told)
    ax.axhline(0, color="#999999", lw=0.6, zorder=0)
    ax.set_ylabel("slip [m]")
    ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


def _curve(what, label, time, slip):
    t = _numbers(f"{what}, time of {label!r}", time, (1,))
    return t, _numbers(f"{what}, slip of {label!r}", slip, (1,), len(t))


def _numbers(name, value, dimensions, rows=None):
    """An array of finite numbers with one of the ``dimensions`` and as many ``rows``; RecordsError for others."""
    try:
        found = np.asarray(value)
    except ValueError:
        found = np.empty(0, object)
    fits = found.dtype.kind in "iuf" and found.ndim in dimensions and len(found) > 0 and np.isfinite(found).all()
    if not fits or rows not in (None, len(found)) or found.shape[1:] not in ((), (2,)):
        shapes = " or ".join("(n,)" if k == 1 else "(n, 2)" for k in dimensions)
        told = "" if rows is None else f", with n = {rows} as the time has"
        raise style.RecordsError(f"{name} {checks.shown(value)}: give finite numbers, an array {shapes}{told}")
    return found.astype(float)
