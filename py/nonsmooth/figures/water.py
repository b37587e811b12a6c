"""Water in the ground: pressure heads, flow lines, heads and the free surface of a seepage, and pressures in time."""

from typing import NamedTuple

import matplotlib
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from matplotlib.tri import Triangulation

from ..model import geometry
from ..system import checks
from ..water import phreatic
from ..water.fields import MeshField
from . import given, style

__all__ = ["pore_pressures", "seepage"]

SEEPAGE = checks.has("mesh head flux wet", "give a Seepage, as water.seepage.solve(...) returns one")
FIELD = checks.kind(MeshField, "give a MeshField; a PhreaticLine becomes one by .on(mesh)")
LAYERED = (
    lambda v: v is None or hasattr(v, "layers"),
    "give a Section, as section.load('circle') returns one, or None",
)
TIMES = (
    lambda v: v is None or isinstance(v, (list, tuple, np.ndarray)) and len(v) > 0,
    "give a list of times [s], or None for those of the field's states",
)
COLOURS = "Blues"
FEWEST, HEADS = 6, 11  # steps of colours, and lines of equal head with both ends
WIDTH, LEAST, MOST = 8.0, 1.6, 7.0  # inches of a picture, and its smallest and largest height
FLOW_LINES = 12
STILL = 1e-6  # gradient of the head below which water stands, but for rounding
ACROSS = 160  # places at which flow lines are looked for, along the longer side


@given.takes(result=SEEPAGE, section=LAYERED)
@style.styled
def seepage(result, section=None, path=None, pdf=False):
    """The pressure head p/γ_w in colours, lines of equal head (dotted), flow lines, and the free surface (thick).

    ``result``: a :class:`~nonsmooth.water.seepage.Seepage`; ``section``: a Section, whose layers are drawn over it.
    Flow lines begin on the line of middle head: between two of them the same flows across it.
    """
    mesh = result.mesh
    fig, ax, triangles = _body(mesh, section)
    drawn = _fill(ax, triangles, result.pressure_head, result.pressure_head.max())
    fig.colorbar(drawn, ax=ax, shrink=0.8, label="pressure head $p/γ_w$ [m]")
    still = np.ptp(result.head) <= 1e-9 * max(np.abs(result.head).max(), 1e-300)
    handles = []
    if not still:
        levels = np.linspace(result.head.min(), result.head.max(), HEADS)[1:-1]
        dry = result.wet < 0.5
        shown = Triangulation(*mesh.nodes.T, mesh.triangles, mask=None if dry.all() else dry)
        ax.tricontour(shown, result.head, levels, colors=style.LINES["grey"], linewidths=0.8, linestyles=":")
        _flow_lines(ax, result)
        handles = [
            Line2D([], [], color=style.LINES["grey"], lw=0.8, ls=":", label="equal head, a tenth of its range apart"),
            Line2D([], [], color=style.LINES["orange"], lw=0.8, label="flow line"),
        ]
    lines = result.phreatic_line()
    for line in lines:
        ax.plot(*line.T, color=style.WATER, lw=2.2, zorder=6)
    if lines:
        handles.append(Line2D([], [], color=style.WATER, lw=2.2, label="free surface"))
    if handles:
        ax.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.01), ncol=len(handles))
    style.scale_bar(ax)
    return style.save(fig, path, pdf)


@given.takes(field=FIELD, times=TIMES, section=LAYERED)
@style.styled
def pore_pressures(field, times=None, section=None, path=None, pdf=False, flow=None):
    """Pore pressures at several times, one panel below the other, in one scale of colours.

    ``field``: a :class:`~nonsmooth.water.fields.MeshField`; ``times`` [s]: those of its states where None; ``section``:
    as of :func:`seepage`; ``flow``: a function of the time that gives heads [m] at the nodes, fluxes [m/s] and wet
    shares of the triangles, whose flow lines are drawn, and the largest conductivity [m/s]. The free surface is drawn
    thick.
    """
    times = field.times if times is None else list(times)
    states = [field.at(time) for time in times]
    fig, panels, triangles = _body(field.mesh, section, len(times))
    top = max(float(state.max()) for state in states)
    for ax, time, state in zip(np.atleast_1d(panels), times, states):
        drawn = _fill(ax, triangles, state / 1e3, top / 1e3)
        if 0 < np.count_nonzero(state > 0) < len(state):
            ax.tricontour(triangles, state, [0.0], colors=style.WATER, linewidths=2.2)
        seen = None if flow is None else _Flow(field.mesh, *flow(time))
        if seen is not None and np.abs(seen.flux[seen.wet > 0.5]).max(initial=0.0) > STILL * seen.fastest:
            _flow_lines(ax, seen)
        ax.set_title(f"t = {style.seconds(time, max(np.abs(times)))}", loc="left")
    fig.colorbar(drawn, ax=panels, shrink=0.8, label="pore pressure [kPa]")
    style.scale_bar(np.atleast_1d(panels)[-1])
    return style.save(fig, path, pdf)


class _Flow(NamedTuple):
    """What :func:`_flow_lines` asks of a Seepage."""

    mesh: object
    head: np.ndarray
    flux: np.ndarray
    wet: np.ndarray
    fastest: float


def _body(mesh, section, count=1):
    """A figure, its axes (one, or ``count`` below each other) with the layers' outlines, and the triangles."""
    x0, y0, x1, y1 = mesh.bounds
    height = float(np.clip(WIDTH * 0.8 * (y1 - y0) / (x1 - x0), LEAST, MOST)) + 0.35
    fig = style.figure(WIDTH, height * count + 0.3, layout="constrained")
    panels = fig.subplots(count, 1)
    margin = 0.02 * max(x1 - x0, y1 - y0)
    for ax in np.atleast_1d(panels):
        style.frame(ax, x0 - margin, x1 + margin, y0 - margin, y1 + margin)
        for layer in section.layers if section is not None else ():
            ring = np.vstack((layer.points, layer.points[:1]))
            ax.plot(*ring.T, color=style.INK, lw=0.8, zorder=5)
        if section is None:
            rim = LineCollection(mesh.nodes[mesh.border], colors=style.INK, linewidths=0.8, capstyle="round", zorder=5)
            ax.add_collection(rim, autolim=False)
    return fig, panels, Triangulation(*mesh.nodes.T, mesh.triangles)


def _fill(ax, triangles, values, top):
    """Colours of values from 0 to at least ``top``, in round steps; what is below 0 stays white."""
    step = style.nice(max(top, 1e-9) / FEWEST)
    levels = step * np.arange(int(np.ceil(max(top, 1e-9) / step - 1e-9)) + 1)
    colours = matplotlib.colormaps[COLOURS](np.linspace(0.12, 0.9, len(levels) - 1))
    return ax.tricontourf(triangles, values, levels, colors=colours, zorder=1)


def _flow_lines(ax, result):
    x0, y0, x1, y1 = result.mesh.bounds
    nx, ny = (max(8, round(ACROSS * length / max(x1 - x0, y1 - y0))) for length in (x1 - x0, y1 - y0))
    # off the borders, along which lines would lie one upon another
    x, y = (a + (b - a) * (np.arange(n) + 0.5) / n for a, b, n in ((x0, x1, nx), (y0, y1, ny)))
    points = np.column_stack([v.ravel() for v in np.meshgrid(x, y)])
    where = result.mesh.locate(points)
    inside = (where >= 0) & (result.wet[where] > 0.5)
    flux = np.where(inside[:, None], result.flux[where], np.nan).reshape(len(y), len(x), 2)
    places = _equal_flows(result)
    places = places[(places >= (x[0], y[0])).all(axis=1) & (places <= (x[-1], y[-1])).all(axis=1)]
    if len(places):
        lines = ax.streamplot(
            x,
            y,
            flux[..., 0],
            flux[..., 1],
            start_points=places,
            broken_streamlines=False,
            color=style.LINES["orange"],
            linewidth=0.8,
            arrowsize=0.7,
        )
        lines.lines.set_zorder(4)


def _equal_flows(result):
    """Places (k, 2) on the line of middle head between which flows the same."""
    middle = 0.5 * (result.head.min() + result.head.max())
    across = phreatic.lines(result.mesh, result.head - middle)
    begin, end = geometry.pieces(across) if across else (np.zeros((0, 2)), np.zeros((0, 2)))
    where = result.mesh.locate(0.5 * (begin + end))
    way = end - begin
    flow = np.abs(way[:, 0] * result.flux[where, 1] - way[:, 1] * result.flux[where, 0])
    flow = np.where((where >= 0) & (result.wet[where] > 0.5), flow, 0.0)
    total = np.concatenate(([0.0], np.cumsum(flow)))
    if not total[-1] > 0:
        return np.zeros((0, 2))
    wanted = total[-1] * (np.arange(FLOW_LINES) + 0.5) / FLOW_LINES
    piece = np.searchsorted(total, wanted, side="right") - 1
    return begin[piece] + ((wanted - total[piece]) / flow[piece])[:, None] * way[piece]
