"""A video of the avalanche from its snapshots (Animation S1 of the paper), by matplotlib and ffmpeg."""

import itertools
import textwrap
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.patches import Patch

from .. import records
from ..measure.ground import ground_of
from ..records import RecordsError
from ..records.given import FILE
from ..records.snapshots import read_with
from ..system import checks
from . import film, given, style

__all__ = ["FORCES", "write_mp4"]

SNAPSHOTS = (
    lambda v: given.CASES[0](v) and (not isinstance(v, (list, tuple)) or all(FILE[0](one) for one in v)),
    "give a list of the files of a run's snapshots, in the order of time",
)
SERIES = (lambda v: v is None or given.SERIES[0](v), f"{given.SERIES[1]}, or None for no forces")
SMALLEST, LARGEST = 64, 8192  # pixels, that have room for something, and that players play

FORCES = (  # column, symbol, meaning, role of the walls, colour
    ("dp_normal_effective_N_per_m", "N'", "effective normal force", "slip", "blue"),
    ("dp_shear_N_per_m", "T", "shear force", "slip", "orange"),
    ("fb_normal_N_per_m", "N'", "normal force", "backstop", "green"),
)


class _Frames(film.Stage):
    """The artists of one video."""

    def __init__(self, ground, view, first, size, series, times, window, longest, free_surface=None):
        width, height = size
        super().__init__(style.figure(width / 100, height / 100, dpi=100))
        self.slope, self.extent, self.longest = ground, view[1] - view[0], longest
        room = 0.355 if series is not None else 0.0
        self.ax = self.fig.add_axes([0, room, 1, 0.91 - room])
        x0, x1, y0, y1 = view
        # Widen the view to the shape of the axes, so that equal scales fill them: sky above, ground below.
        shape = height * (0.91 - room) / width
        if (y1 - y0) < shape * (x1 - x0):
            y0 -= 0.5 * (shape * (x1 - x0) - (y1 - y0))
            y1 = y0 + shape * (x1 - x0)
        else:
            extra = 0.5 * ((y1 - y0) / shape - (x1 - x0))
            x0, x1 = x0 - extra, x1 + extra
        style.frame(self.ax, x0, x1, y0, y1)
        inside = style.draw_walls(self.ax, ground, size=12)
        style.scale_bar(self.ax, 0.975 if ground.side > 0 else 0.145, 0.06, 0.12)
        self._legend()
        self.disks, self.numbers = style.draw_disks(self.ax, first, style.state_colours(first)), _numbers(first)
        self.free_surface = free_surface
        if free_surface is None:
            self.water = style.water_line(self.ax, ground, 0.0)
        else:
            self.water = self.ax.plot([], [], **style.WATER_LINE)[0]
        self.clock = self.fig.text(0.015, 0.985, "", fontsize=17, fontweight="bold", va="top")
        self.state = self.fig.text(0.16, 0.98, "", fontsize=13, va="top", color="#444444")
        self.moving = [a for a in (self.disks, *inside, self.water, self.clock, self.state) if a is not None]
        self.cursors = []
        if series is not None:
            self._forces(series, times, window)
        self.set()

    def _legend(self):
        handles = [
            Patch(color=pair[0], label=label)
            for pair, label in ((style.DRY, "dry"), (style.WET, "under pore pressure"), (style.RELEASED, "released"))
        ]
        self.fig.legend(handles=handles, loc="upper right", ncol=3, fontsize=12, handlelength=1.2, columnspacing=1.3)

    def _forces(self, series, times, window):
        drawn = [
            (name, letter, meaning, self.slope.name(role), style.LINES[colour])
            for name, letter, meaning, role, colour in FORCES
            if self.slope.of_role(role)
        ]
        own = [
            (records.column("dp_shear_N_per_m", wall), "T", "shear force", wall, colour)
            for wall, colour in zip(self.slope.stacked, itertools.cycle(style.STACKED))
        ]
        # slip surfaces one above another: the shear force on each, and none on all of them
        if own and all(name in series for name, *_ in own):
            drawn = own + [one for one in drawn if not one[0].startswith("dp_")]
        time, *forces = style.need(series, "time_s", *(name for name, *_ in drawn))
        newtons, unit = style.force_unit(max(np.abs(force).max() for force in forces))
        ax = self.fig.add_axes([0.06, 0.085, 0.68, 0.225])
        ax.set_xlim(time[0], max(time[-1], time[0] + 1e-9))
        style.shade_phases(ax, times)
        style.mark_times(ax, times, gap=0.03)
        late = style.known_times(times).get("t3", np.inf)
        for (_, letter, meaning, name, colour), force in zip(drawn, forces):
            smooth = np.where(time > late, style.running_mean(time, force, window), force) / newtons
            said = f"{meaning} on {style.plain(name)}"
            symbol = style.symbol(letter, name)
            # beside the axes is room for some forty letters
            label = f"{symbol}  {said}" if len(said) + len(name) <= 34 else f"{symbol}\n{textwrap.fill(said, 34)}"
            ax.plot(time, smooth, color=colour, label=label)
        ax.axhline(0, color="#555555", lw=0.7)
        ax.set_xlabel("time [s]", fontsize=11)
        ax.set_ylabel(f"force [{unit}]", fontsize=11)
        self.fig.legend(*ax.get_legend_handles_labels(), loc="center left", bbox_to_anchor=(0.745, 0.2), fontsize=10.5)
        self.cursors = [ax.axvline(time[0], color=style.INK, lw=1.6, zorder=9)]
        self.moving += self.cursors

    def show(self, snapshot):
        """Draw one snapshot; returns the picture as bytes (RGBA)."""
        offsets, colours = np.full((len(self.numbers), 2), np.nan), np.zeros((len(self.numbers), 4))
        there = np.searchsorted(self.numbers, _numbers(snapshot))
        offsets[there] = np.column_stack([snapshot.x, snapshot.y])
        colours[there] = style.state_colours(snapshot)
        self.disks.set_offsets(offsets)  # one that has been taken out since is nowhere
        self.disks.set_facecolors(colours)
        if self.free_surface is not None:
            self.water.set_data(*style.free_surface(self.free_surface(snapshot.time_s)).T)
        elif self.water is not None:
            self.water.set_data(*style.water_table(self.ax, self.slope, snapshot.water_m).T)
            self.water.set_visible(snapshot.water_m > 0)
        self.clock.set_text(f"t = {style.seconds(snapshot.time_s, self.longest)}")
        what = "water table" if self.free_surface is None else "head on the slip surface"
        water = f"{what} {style.length(snapshot.water_m, self.extent, 1)}    " if self.water is not None else ""
        self.state.set_text(
            f"{water}mean speed {np.hypot(snapshot.vx, snapshot.vy).mean():.{1 if self.extent >= 20 else 2}f} m/s"
        )
        for cursor in self.cursors:
            cursor.set_xdata([snapshot.time_s, snapshot.time_s])
        return self.picture()


def _numbers(snapshot):
    """Which disks a Snapshot has, rising."""
    return np.arange(len(snapshot.x)) if snapshot.number is None else snapshot.number


def _pixels(size):
    """Width and height of a video, as whole numbers. Raises RecordsError."""
    remedy = f"give (width, height) in pixels, two even whole numbers from {SMALLEST} to {LARGEST}"
    found = checks.numbers_of("size", size, RecordsError, remedy, least=2, most=2)
    if any(v % 2 or not SMALLEST <= v <= LARGEST for v in found):
        raise RecordsError(f"size {checks.shown(size)}: {remedy}")
    return tuple(map(int, found))


def _sample(paths):
    """The first, the last and some snapshots between: enough to choose the limits of the picture."""
    last = len(paths) - 1
    return [_read(paths[k]) for k in sorted({0, last // 2, 3 * last // 4, last})]


def _read(path):
    return read_with(path, "a slope", "layer", "vx", "vy", "wet", "released", "water_m")


@given.takes(snapshot_paths=SNAPSHOTS, walls=given.WALLS, path=FILE, series=SERIES)
def write_mp4(
    snapshot_paths,
    walls,
    path,
    fps=15,
    series=None,
    times=None,
    size=(1280, 720),
    window=1.0,
    progress=None,
    free_surface=None,
):
    """Write an MP4 with one frame for each snapshot, in the given order.

    ``snapshot_paths``: files of :func:`~nonsmooth.records.write_snapshot` of one run (contacts are not needed); they
    are read one by one. ``walls``: see :mod:`nonsmooth.figures`. ``size``: pixels, even numbers. ``series`` (with
    ``times``): adds a strip of forces against time with a cursor, means over ``window`` [s] once the avalanche moves.
    ``progress``: called with (frames done, all frames) after each frame. ``free_surface``: as of figures.snapshots.
    Returns (path, None), or (None, note) when
    there is no ffmpeg or it failed; a file that was there before is replaced only by a whole new one. Raises
    :class:`~nonsmooth.records.RecordsError` for a name, size or number of frames a second (``fps``) that no video can
    have, if there is no snapshot, one is unreadable, or their numbers of disks differ.
    """
    paths, path, ground = [Path(p) for p in snapshot_paths], film.named(path), ground_of(walls)
    film.check_fps(fps)
    size = _pixels(size)
    if not paths:
        raise RecordsError("there are no snapshots to make a video of; let the run write some first")
    if film.missing():
        return None, f"no video: {film.missing()}"
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(style.RC)
        sample = _sample(paths)
        longest = sample[-1].time_s
        view = style.view(sample, ground)
        frames = _Frames(ground, view, sample[0], size, series, times, window, longest, free_surface)

        def pictures():
            for done, name in enumerate(paths, start=1):
                snapshot = _read(name)
                if not np.isin(_numbers(snapshot), _numbers(sample[0])).all() or (
                    snapshot.number is None and len(snapshot.x) != len(sample[0].x)
                ):
                    raise RecordsError(
                        f"{name}: {len(snapshot.x)} disks, but {paths[0]} has {len(sample[0].x)}; give snapshots of one run only"
                    )
                yield frames.show(snapshot)
                if progress:
                    progress(done, len(paths))

        note = film.write(path, frames.fig, pictures(), fps)
    return (None, note) if note else (path, None)
