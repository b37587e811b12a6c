"""What the figures share: colours, drawing of disks and walls, time marks, saving."""

import functools
import math
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import EllipseCollection
from matplotlib.colors import to_rgba_array
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from ..measure.weakening import stretch, stretches, weakened_share
from ..records import RecordsError
from ..system import checks
from ..system.whole_files import beside
from .given import PATH

__all__ = [
    "COMPRESSION",
    "DRY",
    "EDGE",
    "GROUND",
    "INK",
    "LAYERS",
    "LINES",
    "RC",
    "RELEASED",
    "STACKED",
    "STRONG",
    "TENSION",
    "TIME_NAMES",
    "WALL",
    "WATER",
    "WEAKENED",
    "WET",
    "draw_disks",
    "draw_walls",
    "draw_weakened",
    "figure",
    "force_unit",
    "frame",
    "known_times",
    "layer_colours",
    "length",
    "length_unit",
    "line_colours",
    "mark_times",
    "need",
    "nice",
    "plain",
    "running_mean",
    "save",
    "scale_bar",
    "seconds",
    "shade_phases",
    "state_colours",
    "styled",
    "symbol",
    "view",
    "water_line",
    "free_surface",
    "water_table",
    "with_settings",
]

# Told apart by lightness as well as by hue, so that they survive colour blindness and grey printing.
LAYERS = ("#5a2d0c", "#b5651d", "#e9a23b", "#f7d98b", "#8c8c7a")
DRY = ("#b89b6a", "#ddc99d")
WET = ("#1f5fa8", "#4a90d0")
RELEASED = ("#e06aa6", "#f5a9cd")
COMPRESSION, TENSION = "#1f5fa8", "#d62728"
GROUND, WALL, WATER, INK = "#e4e4e0", "#222222", "#0b6fb8", "#222222"
WATER_LINE = {"color": WATER, "lw": 1.3, "ls": (0, (5, 2)), "zorder": 5}
EDGE = [withStroke(linewidth=2, foreground="white")]  # of letters that lie over what is drawn
STRONG, WEAKENED = "#cdc6b4", "#b00020"  # of a slip surface: as strong as ever, and where D_c is passed
# Okabe and Ito's palette for lines.
LINES = {
    "blue": "#0072B2",
    "orange": "#D55E00",
    "green": "#009E73",
    "purple": "#9E4F86",
    "sky": "#4AA8DE",
    "grey": "#777777",
}

# of slip surfaces one above another; green is the backstop's
STACKED = [LINES[name] for name in ("blue", "orange", "purple", "sky", "grey")]

RC = {
    "font.size": 9.5, "axes.titlesize": 10.5, "axes.labelsize": 9.5, "legend.fontsize": 9, "axes.edgecolor": "#555555",
    "axes.linewidth": 0.7, "axes.spines.top": False, "axes.spines.right": False, "lines.linewidth": 1.5,
    "xtick.labelsize": 9, "ytick.labelsize": 9, "legend.frameon": False, "mathtext.default": "it", "pdf.fonttype": 42,
}  # fmt: skip

FINE = 2001  # places across a picture where the water table is compared with the ground
PLACES = (0.5, 0.35, 0.65, 0.2, 0.8, 0.08, 0.92)  # of the visible part of a wall, where its name may stand
EDGE_ROOM = 5  # pixels, between a name and the edge of its window
SCARCE = 0.04  # of the picture's width or height: of a wall that shows less of itself the name is left out

#: What the characteristic times of the paper (section 6) mark, and the phases between them.
TIME_NAMES = {
    "t0": "water begins to rise",
    "t1": "limit equilibrium",
    "t2": "triggering begins",
    "t3": "avalanche in motion",
    "t4": "during motion",
    "t5": "at rest",
}
PHASES = (
    ("t0", "t1", "water table rises", "#dcebf7"),
    ("t1", "t2", "failure", "#fff3c4"),
    ("t2", "t3", "triggering", "#fbd9c0"),
    ("t3", "t5", "avalanche motion", "#efe3ee"),
)


def figure(width, height, **options):
    """A figure of ``width`` by ``height`` inches with an Agg canvas and no global state."""
    fig = Figure(figsize=(width, height), facecolor="white", **options)
    FigureCanvasAgg(fig)
    return fig


def styled(function):
    """Run a figure function under this project's settings, see :func:`with_settings`. Raises RecordsError, before
    anything is drawn, for a ``path`` that no figure can have.
    """
    return checks.takes(RecordsError, path=PATH)(with_settings(function))


def with_settings(function):
    """Run what draws, as a film, under this project's settings, whatever the user's matplotlibrc says."""

    @functools.wraps(function)
    def run(*args, **options):
        with matplotlib.rc_context():
            matplotlib.rcdefaults()
            matplotlib.rcParams.update(RC)
            return function(*args, **options)

    return run


def save(fig, path=None, pdf=False, dpi=170):
    """Write the PNG (and a PDF beside it), whole or not at all; returns the PNG's path. Without one nothing is written,
    and the figure is returned.
    """
    if path is None:
        return fig
    path = Path(path)
    try:
        for target, fine in ((path, dpi), *([(path.with_suffix(".pdf"), 300)] if pdf else [])):
            with beside(target) as part:
                fig.savefig(part, dpi=fine)
    except OSError as error:
        raise RecordsError(f"{path}: figure cannot be written ({error.strerror}); choose a writable folder") from error
    return path


def need(series, *names):
    """Columns of a series; RecordsError if one is missing or there are no rows."""
    missing = [name for name in names if name not in series]
    if missing:
        raise RecordsError(f"the series has no column {', '.join(missing)}; draw a series written by this version")
    if len(series[names[0]]) == 0:
        raise RecordsError("the series has no rows; let the run go on for some steps before drawing it")
    return [np.asarray(series[name], dtype=float) for name in names]


def line_colours(count):
    """So many colours for lines, from the first again where there are more than :data:`LINES` has."""
    colours = list(LINES.values())
    return [colours[k % len(colours)] for k in range(count)]


def plain(text):
    """A name as text that is no formula, whatever it holds."""
    return str(text).replace("$", r"\$")


def symbol(letter, name):
    """A quantity of a wall: the wall's name is its index where it is a short word, or follows in brackets."""
    return (
        f"${letter}_{{{name}}}$"
        if name.isalnum() and name.isascii() and len(name) <= 4
        else f"${letter}$ ({plain(name)})"
    )


_LENGTHS = ((2, 1, "m"), (0.2, 100, "cm"), (0, 1000, "mm"))  # from which extent [m], in a metre, name
_TOLD_APART = 300  # lengths in a picture, at least


def length_unit(extent):
    """The unit of lengths in a picture ``extent`` [m] wide: (how many are a metre, its name)."""
    return next(rest for least, *rest in _LENGTHS if extent >= least)


def length(value, extent, digits=0):
    """A length [m] with the unit of a picture ``extent`` [m] wide, to a three-hundredth of its width and ``digits``
    more.
    """
    factor, unit = length_unit(extent)
    needed = math.ceil(math.log10(_TOLD_APART / max(factor * extent, 1e-9)))
    return f"{factor * value:,.{digits + max(0, needed)}f} {unit}"


def seconds(value, longest):
    """A time [s] with as many digits as times up to ``longest`` [s] are told apart by."""
    return f"{value:.{1 if longest >= 20 else 2 if longest >= 2 else 3}f} s"


def force_unit(largest):
    """The unit of forces up to ``largest`` [N/m]: (newtons in it, its name)."""
    return next((f, u) for f, u in ((1e6, "MN/m"), (1e3, "kN/m"), (1.0, "N/m")) if largest >= f or f == 1.0)


def known_times(times):
    """The characteristic times that are there (not None, not NaN), in order: dict name -> seconds."""
    times = getattr(times, "times", times) or {}
    return {k: float(times[k]) for k in sorted(times) if times[k] is not None and np.isfinite(times[k])}


def layer_colours(layer):
    """RGBA (N, 4): one colour for each layer, lowest darkest."""
    return to_rgba_array(LAYERS)[np.asarray(layer) % len(LAYERS)]


def state_colours(snapshot):
    """RGBA (N, 4): ochre, wet disks blue, those that were wet and have been released pink, each in two shades that
    alternate with the layers.
    """
    state = np.where(snapshot.released, 2, np.where(snapshot.wet, 1, 0))
    return to_rgba_array(DRY + WET + RELEASED)[2 * state + snapshot.layer % 2]


def draw_disks(ax, snapshot, colours, mask=slice(None), edge="none", width=0.0, zorder=2):
    """Disks with their true radii in data units; returns the collection."""
    diameters = 2 * snapshot.r[mask]
    disks = EllipseCollection(
        diameters, diameters, np.zeros_like(diameters), units="xy",
        offsets=np.column_stack([snapshot.x[mask], snapshot.y[mask]]), offset_transform=ax.transData,
        facecolors=colours[mask], edgecolors=edge, linewidths=width, zorder=zorder, rasterized=True,
    )  # fmt: skip
    ax.add_collection(disks, autolim=False)
    return disks


def draw_walls(ax, ground, named=None, size=9.5, width=1.6, apart=False):
    """Walls as lines with the ground below them filled, to the sides of the picture, and the names of those whose role
    is in ``named`` (all where None) beside them; ``apart``: where they do not cover each other nor what is written
    there already, and without those that have no such place.

    ``ground``: a :class:`~nonsmooth.measure.ground.Ground`. Returns the artists of interfaces between layers, which lie
    over the disks.
    """
    x0, x1 = ax.get_xlim()
    y0, y1 = ax.get_ylim()
    over, taken = [], _written(ax) if apart else None
    for wall in ground.walls:
        if wall.buried:
            continue
        points = wall.vertices
        ax.fill_between(points[:, 0], points[:, 1], y0 - (y1 - y0), color=GROUND, lw=0.6, zorder=0.5)
    for points in ground.beyond(x0, x1):
        ax.fill_between(points[:, 0], points[:, 1], y0 - (y1 - y0), color=GROUND, lw=0.6, zorder=0.4)
    for wall in ground.walls:
        drawn = ax.plot(
            wall.vertices[:, 0],
            wall.vertices[:, 1],
            color=WALL,
            lw=0.6 * width if wall.buried else width,
            ls=(0, (1, 1.5)) if wall.buried else "-",
            solid_capstyle="round",
            zorder=4,
        )
        if named is None or wall.role in named:
            drawn.append(_name_wall(ax, wall, ground.side, (x0, x1, y0, y1), size, taken))
        over += [one for one in drawn if one is not None] if wall.buried else []
    return over


def _written(ax):
    """Boxes, in pixels, of what is written on axes."""
    ax.apply_aspect()
    return [one.get_window_extent(ax.figure.canvas.get_renderer()) for one in (*ax.texts, *ax.lines)]


def _name_wall(ax, wall, side, box, size, taken=None):
    """Write a wall's name below the middle of its visible part, or beside it where it stands upright; returns it, None
    where so little of the wall is seen that it has none. ``taken``: boxes that it must not cover, to which its own is
    added: then it may stand elsewhere along the wall, and has no name without such a place.
    """
    x0, x1, y0, y1 = box
    leg = np.r_[0, np.cumsum(np.hypot(*np.diff(wall.vertices, axis=0).T))]
    along = np.linspace(0, leg[-1], 400)
    path = np.column_stack([np.interp(along, leg, wall.vertices[:, k]) for k in (0, 1)])
    seen = path[(path[:, 0] > x0) & (path[:, 0] < x1) & (path[:, 1] > y0) & (path[:, 1] < y1)]
    if len(seen) == 0 or max(np.ptp(seen[:, 0]) / (x1 - x0), np.ptp(seen[:, 1]) / (y1 - y0)) < SCARCE:
        return None
    for share in PLACES if taken is not None else PLACES[:1]:
        name = _wall_name(ax, wall, side, seen[int(share * len(seen))], size)
        if taken is None:
            return name
        covers = _moved_inside(ax, name)
        if not any(covers.overlaps(other) for other in taken):
            taken.append(covers)
            return name
        name.remove()
    return None


def _moved_inside(ax, name):
    """Moves a name sideways so that it is within the axes, if it is no longer than these; returns its box in pixels."""
    renderer, inside = ax.figure.canvas.get_renderer(), ax.get_window_extent()
    covers = name.get_window_extent(renderer)
    beyond = max(0.0, covers.x1 - inside.x1 + EDGE_ROOM) - max(0.0, inside.x0 + EDGE_ROOM - covers.x0)
    x, y = name.xyann
    name.xyann = (x - beyond * 72 / ax.figure.dpi, y)
    return name.get_window_extent(renderer)


def _wall_name(ax, wall, side, place, size):
    """A wall's name at a ``place`` (x, y) of it."""
    beside = wall.role == "backstop"
    return ax.annotate(
        plain(wall.name), place, xytext=(9 * side, -5) if beside else (-3 * side, -6), textcoords="offset points",
        ha=("left" if side > 0 else "right") if beside else "center", va="top", fontsize=size, fontweight="bold", color=INK, zorder=6, annotation_clip=True,
        path_effects=EDGE, bbox={"fc": "white", "ec": "none", "alpha": 0.7, "pad": 1.0} if wall.buried else None,
    )  # fmt: skip


def draw_weakened(ax, ground, snapshot):
    """The parts of walls and interfaces that have weakened, as thick lines; whether anything here can weaken, which a
    snapshot of an earlier version does not tell.
    """
    if snapshot.weakened is None or not ground.weakening:
        return False
    for column, wall in ground.weakening.items():
        for part in stretches(*weakened_share(snapshot, wall.vertices, column, ground.side)):
            points = stretch(wall.vertices, *part, ground.side)
            ax.plot(points[:, 0], points[:, 1], color=WEAKENED, lw=3.2, solid_capstyle="butt", zorder=4.5)
    return True


def frame(ax, x0, x1, y0, y1):
    """Equal scales, given limits, no axes."""
    ax.set_xlim(x0, x1)
    ax.set_ylim(y0, y1)
    ax.set_aspect("equal")
    ax.set_xticks([])
    ax.set_yticks([])
    for spine in ax.spines.values():
        spine.set_visible(False)


def view(cases, ground):
    """Limits that hold the disks of every snapshot, and some ground before the foot."""
    ahead = [ground.side * s.x for s in cases]  # as for a slope that falls to the right
    x0, foot = min(x.min() for x in ahead), ground.side * ground.foot[0]
    x1 = max(max(x.max() for x in ahead), foot + 0.12 * (foot - x0))
    y0 = min(s.y.min() for s in cases)
    y1 = max(s.y.max() for s in cases)
    ends = x0 - 0.012 * (x1 - x0), x1 + 0.03 * (x1 - x0)
    return (*(ends if ground.side > 0 else (-ends[1], -ends[0])), y0 - 0.09 * (y1 - y0), y1 + 0.03 * (y1 - y0))


def nice(value):
    """The largest of 1, 2, 5 times a power of ten that is not above ``value``."""
    power = 10.0 ** np.floor(np.log10(value))
    return max(m * power for m in (1, 2, 5) if m * power <= value * (1 + 1e-9))


def scale_bar(ax, x=0.97, y=0.07, share=0.2):
    """A bar of a round length, its right end at the axes fractions ``x``, ``y``."""
    x0, x1 = ax.get_xlim()
    long = nice(share * (x1 - x0))
    w = long / (x1 - x0)
    factor, unit = next(
        (f, u) for f, u, least in ((1, "m", 1), (100, "cm", 0.01), (1000, "mm", 0)) if long >= least * (1 - 1e-9)
    )
    ax.plot([x - w, x], [y, y], transform=ax.transAxes, color=INK, lw=3, solid_capstyle="butt", zorder=7)
    ax.text(
        x - w / 2, y + 0.02, f"{factor * long:g} {unit}", transform=ax.transAxes, ha="center", va="bottom", zorder=7
    )


def water_table(ax, ground, height):
    """Points (n, 2) [m] of the water table in a picture: its plane moved by ``height`` [m] along its normal. A plane of
    its own, as a reservoir's, goes on to the sides of the picture, and is left out (NaN) where it is in the ground
    below the walls. None where no plane is known."""
    points = ground.water_points(height)
    if points is None or ground.table_slope is None:
        return points
    x = np.linspace(*sorted(ax.get_xlim()), FINE)
    y = points[0, 1] + ground.table_slope * (x - points[0, 0])
    return np.column_stack([x, np.where(y > ground.surface(x), y, np.nan)])


def free_surface(lines):
    """Points (n, 2) of one line in a picture, of the polylines of a free surface, with NaN between them."""
    parts = [np.vstack((np.asarray(line, float), [[np.nan, np.nan]])) for line in lines]
    return np.vstack(parts) if parts else np.zeros((0, 2))


def water_line(ax, ground, height, **options):
    """The water table as a line, see :func:`water_table`; returns it, or None where no plane is known."""
    points = water_table(ax, ground, height)
    if points is None:
        return None
    return ax.plot(points[:, 0], points[:, 1], **{**WATER_LINE, **options})[0]


def shade_phases(ax, times, names=False):
    """Colour the phases between the characteristic times behind the curves; optionally write their names. The motion of
    a slope that has no t3 begins at t2.
    """
    t = known_times(times)
    x0, x1 = ax.get_xlim()
    for first, last, name, colour in PHASES if "t3" in t else (*PHASES, ("t2", *PHASES[-1][1:])):
        if first not in t or last not in t:
            continue
        a, b = max(t[first], x0), min(t[last], x1)
        if b <= a:
            continue
        ax.axvspan(a, b, color=colour, lw=0, zorder=0)
        room = (b - a) / (x1 - x0) * ax.figure.get_figwidth() * ax.get_position().width * 72
        if names and room > 5.2 * len(name):
            ax.text((a + b) / 2, 0.5, name, transform=ax.get_xaxis_transform(), ha="center", va="center", fontsize=9)


def mark_times(ax, times, labels=True, gap=0.028):
    """Vertical lines at the characteristic times; labels above the axes, spread where the times are close."""
    x0, x1 = ax.get_xlim()
    t = {k: v for k, v in known_times(times).items() if x0 <= v <= x1}
    for value in t.values():
        ax.axvline(value, color="#555555", lw=0.8, ls=(0, (4, 3)), zorder=1)
    if not labels or not t:
        return
    names = sorted(t, key=t.get)
    true = np.array([(t[n] - x0) / (x1 - x0) for n in names])
    shown = true.copy()
    for _ in range(200):  # push neighbours apart
        for i in range(len(shown) - 1):
            lack = gap - (shown[i + 1] - shown[i])
            if lack > 1e-9:
                shown[i] -= lack / 2
                shown[i + 1] += lack / 2
    for name, a, b in zip(names, true, shown):
        ax.plot([a, b], [1.0, 1.03], transform=ax.transAxes, color="#555555", lw=0.7, clip_on=False)
        ax.text(b, 1.035, f"$t_{{{name[1:]}}}$", transform=ax.transAxes, ha="center", va="bottom", fontsize=10.5)


def running_mean(abscissa, values, window):
    """Mean of ``values`` over the ``window`` centred on each place of ``abscissa``, which rises, in its units; the
    window shrinks towards both ends, so that it stays centred. Same shape."""
    half = np.minimum(window / 2, np.minimum(abscissa - abscissa[0], abscissa[-1] - abscissa)) + 1e-9 * window
    total = np.r_[0.0, np.cumsum(values)]
    a = np.searchsorted(abscissa, abscissa - half, side="left")
    b = np.searchsorted(abscissa, abscissa + half, side="right")
    return (total[b] - total[a]) / (b - a)
