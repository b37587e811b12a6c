"""Videos of any scene: frames that are kept while a script runs, drawn with one view and one scale of forces over all
of them.
"""

from __future__ import annotations

import base64
import contextlib
import itertools
import math
import tempfile
import weakref
from pathlib import Path

from ..records import RecordsError
from ..system import checks
from ..world.scene_arrays import read
from . import film, given, scene as pictures, style

__all__ = ["Recorder", "animate", "record", "recording"]

MOST, MEMORY = 200, 500_000_000  # frames and bytes that a recorder keeps
WIDE, HIGH, LEAST = 1280, 720, 480  # pixels: the largest size of the picture, and its least width
HEAD = 44  # pixels above it, with the time
BAR = 110  # pixels beside it, with a bar of colours
FPS = 25

_numbers = itertools.count()
_recorders = weakref.WeakValueDictionary()


class Recorder:
    """Keeps frames of the scene in a YADE ``O`` while it runs, for a video. :func:`record` and :func:`recording` make
    one.

    ``period`` [s] of the scene's own time between two frames; None: each step at first. ``most``: how many frames are
    kept, and ``memory``: how many bytes; where they do not suffice every second frame is dropped and the period
    doubled, so that a run of any length has a video of some hundred frames. Where the scene's time goes back, as after
    ``O.reset()``, the film begins anew.

    ``frames``: list of (time [s], :class:`.scene_arrays.Scene`). ``engine``: a PyRunner that keeps them, for O.engines.
    As a context manager with a ``path``: writes the video at the end of the block, and nothing where the block raises.
    In a notebook it shows the video. Raises RecordsError for numbers that cannot be used and for a path that no video
    has.
    """

    def __init__(self, O, period=None, most=MOST, memory=MEMORY, path=None, **drawn):
        from yade.wrapper import PyRunner

        _check_scene(O)
        _check_period(period)
        checks.count("most", most, RecordsError, "a video has 2 frames or more; give a whole number from 2 up", least=2)
        checks.number("memory", memory, RecordsError, "give bytes above 0", above=0)
        self.path, self.drawn = None if path is None else film.check(path), _drawn(drawn)
        self.frames, self._O, self._first, self._period, self._most, self._memory = [], O, period, period, most, memory
        self._next = -math.inf
        self._number = next(_numbers)
        _recorders[self._number] = self
        self.engine = PyRunner(
            command=f"__import__('yade.nonsmooth.figures.moving', fromlist=['tick']).tick({self._number})",
            iterPeriod=1,
            initRun=True,
        )

    @property
    def period(self):
        """Time [s] between two frames as it is now; None before the first step of one that was left out."""
        return self._period

    def attach(self):
        """Makes the engine the last of O.engines, where it is not among them."""
        if not any(getattr(e, "command", None) == self.engine.command for e in self._O.engines):
            self._O.engines = [*self._O.engines, self.engine]

    def detach(self):
        """Takes the engine out of O.engines."""
        self._O.engines = [e for e in self._O.engines if getattr(e, "command", None) != self.engine.command]

    def take(self, time=None):
        """Keeps the scene as it stands; ``time`` [s]: None for O.time. Nothing happens while there is no disk in it."""
        time = self._O.time if time is None else time
        try:
            frame = read(self._O)
        except RecordsError:
            return
        if self.frames and time < self.frames[-1][0]:
            self.frames, self._period = [], self._first
        self.frames.append((time, frame))
        while len(self.frames) > 2 and (
            len(self.frames) > self._most or sum(s.nbytes for _, s in self.frames) > self._memory
        ):
            self.frames = self.frames[::2]
            self._period = 2 * self._period if self._period else None
        # counted from the first frame, so that a period which is no multiple of the step does not drift
        begin, period = self.frames[0][0], self._period
        met = time - begin + 0.5 * abs(self._O.dt)  # due times so far are met to half a step
        self._next = begin + period * (math.floor(met / period + 1e-9) + 1) if period else time

    def _step(self):
        """What the engine calls at the end of a step."""
        step = self._O.dt
        now = self._O.time + step
        if self._period is None:
            self._period = step
        self._keep(now)
        # PyRunner's own period in time would drift by the steps that do not divide it
        self.engine.iterPeriod = max(1, round(min(1e6, (self._next - now) / step))) if step > 0 else 1

    def _keep(self, now):
        """Keeps the scene as that of the time ``now``, if a frame is due, to half a step, or the scene has begun
        anew.
        """
        if now >= self._next - 0.5 * abs(self._O.dt) or (self.frames and now < self.frames[-1][0]):
            self.take(now)

    def write(self, path=None, fps=FPS):
        """Writes the frames, and the scene as it stands at last, as a video, ``fps`` frames a second, from 0.1 to 100;
        ``path``: ends in .mp4 (by ffmpeg) or .gif. Returns the path.

        The file is replaced only by a whole one. Raises RecordsError where there is no frame, while the scene runs, and
        for a file that cannot be made.
        """
        path = film.check(self.path if path is None else path)
        if self._O.running:
            raise RecordsError(
                f"{path}: the scene still runs; call O.wait() before its video is written, or run it by O.run(..., wait=True)"
            )
        if not self.frames or self._O.time > self.frames[-1][0] + 0.5 * abs(self._O.dt):
            self.take()
        return write(self.frames, path, fps, **self.drawn)

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        if not self._O.running:
            self.detach()
        if kind is None and self.path is not None:
            self.write()

    def _repr_html_(self):
        with tempfile.TemporaryDirectory() as folder:
            kind = "gif" if film.missing() else "mp4"
            content = base64.b64encode(self.write(Path(folder) / f"film.{kind}").read_bytes()).decode()
        if kind == "gif":
            return f'<img src="data:image/gif;base64,{content}"/>'
        return f'<video controls loop style="max-width: 100%" src="data:video/mp4;base64,{content}"></video>'


def tick(number):
    """What a recorder's engine calls; of one that is gone, as after O.load() in another process, nothing."""
    recorder = _recorders.get(number)
    if recorder is not None:
        recorder._step()


def _check_scene(O):
    fits, remedy = given.SCENE
    if not fits(O):
        raise RecordsError(f"O {checks.shown(O)}: {remedy}")


def _check_period(period):
    if period is not None:
        remedy = "the time between two frames is above 0 s; give such a one, or leave it out"
        checks.number("period", period, RecordsError, remedy, above=0)


def _drawn(options):
    """Options of :func:`write`, with values that can be used."""
    unknown = set(options) - {"forces", "view", "colours"}
    if unknown:
        raise TypeError(f"unexpected argument {sorted(unknown)[0]!r}")
    if options.get("view") is not None:
        pictures.checked_view(options["view"])
    if options.get("colours") is not None:
        pictures.checked_colours(options["colours"])
    return options


def record(O, path=None, period=None, **options):
    """Keeps frames of whatever is run from now on: appends a recorder's engine to O.engines and returns the
    :class:`Recorder`::

        with figures.record(O, "fall.mp4", period=0.02):
            O.run(5000, wait=True)

    or, without ``with``, ``film = figures.record(O)`` before and ``film.write("fall.mp4")`` after the run. ``path``,
    ``period`` and ``options`` (``most``, ``memory``; ``forces``, ``view`` and ``colours`` of :func:`draw`) are those of
    :class:`Recorder`. Raises RecordsError, before anything is run.
    """
    made = Recorder(O, period, path=path, **options)
    made.take()
    made.attach()
    return made


@contextlib.contextmanager
def recording(O, path=None, period=None, **options):
    """The same for a block that makes O.engines itself, or several times, as a whole script does: the engine is
    appended whenever a run begins.
    """
    kind, made = type(O), Recorder(O, period, path=path, **options)
    usual = {name: getattr(kind, name) for name in ("run", "step")}

    def attached(function):
        def call(self, *given, **named):
            made._keep(self.time)
            made.attach()
            return function(self, *given, **named)

        return call

    for name, function in usual.items():
        setattr(kind, name, attached(function))
    try:
        with made:
            yield made
    finally:
        for name, function in usual.items():
            setattr(kind, name, function)


def animate(O, path=None, seconds=1.0, frames=None, period=None, fps=FPS, **drawn):
    """Runs a scene for ``seconds`` [s] of its own time and makes a video of it:
    ``figures.animate(O, "fall.mp4", seconds=3)``.

    ``frames``: how many, of equal distance in time, the first one not counted (default 100), or ``period`` [s]: the
    time between two of them; there are no more frames than steps. ``fps``: frames a second in the video, from 0.1
    to 100. ``forces``, ``view``, ``colours``: as of :func:`draw`; the view and the scale of forces are those of all
    frames together.

    Returns the ``path``, which ends in .mp4 (by ffmpeg) or .gif; without one a :class:`Recorder`, which a notebook
    shows as a video. Raises RecordsError, before a step is made, for what cannot be used, and StepError where an engine
    refuses a step.
    """
    if frames is not None and period is not None:
        raise RecordsError(
            f"frames {frames!r} and period {period!r}: each follows from the other and the seconds; give one of them"
        )
    checks.number("seconds", seconds, RecordsError, "give a time above 0 s", above=0)
    if frames is not None:
        checks.count("frames", frames, RecordsError, "give a whole number from 1 to 10000", most=10_000)
    _check_scene(O)
    _check_period(period)
    film.check_fps(fps)
    read(O)  # a scene without disks is refused now
    if not O.dt > 0:
        raise RecordsError(f"O.dt = {O.dt:g}: set the time step of the scene, above 0 s, before it is run")
    steps = max(1, round(seconds / O.dt))
    if period is None:  # no more frames than steps
        count = min(frames or 100, steps)
        dues = [seconds * k / count for k in range(1, count + 1)]
    else:
        period = max(period, O.dt)
        count = math.floor(seconds / period + 1e-9)
        dues = [k * period for k in range(1, min(count, steps) + 1)] + [seconds]
    made = Recorder(O, dues[0] if period is None else period, most=max(2, len(dues) + 1), path=path, **drawn)
    made.take()
    from ..world.stepping import advance

    begin = O.time
    for due in dues:
        ahead = round((begin + due - O.time) / O.dt)
        if ahead > 0 or O.time == begin:
            advance(max(1, ahead))
            made._keep(O.time)
    return made if path is None else made.write(fps=fps)


@style.with_settings
def write(frames, path, fps=FPS, words=None, bar=None, **drawn):
    """Writes ``frames``, a list of (time [s], :class:`.scene_arrays.Scene`), as the video ``path``; ``words``: of a
    time and a scene, said beside the time; ``bar``: a ScalarMappable that the colours are of, and what it shows.
    Others: as of :func:`animate`.

    Raises RecordsError where there is no frame, and for a file that cannot be made.
    """
    path = film.check(path)
    if not frames:
        raise RecordsError(
            f"{path}: no frame has been kept; put disks into the scene and run it before its video is written"
        )
    film.check_fps(fps)
    look, longest = pictures.Look([s for _, s in frames], **drawn), frames[-1][0]
    x0, x1, y0, y1 = look.box
    scale = min(WIDE / (x1 - x0), HIGH / (y1 - y0))
    # ffmpeg wants even numbers of pixels
    width, height = (
        2 * math.ceil(0.5 * v) for v in (max(LEAST, scale * (x1 - x0)) + BAR * bool(bar), scale * (y1 - y0) + HEAD)
    )
    stage = film.Stage(style.figure(width / 100, height / 100, dpi=100))
    side = BAR / width if bar else 0.0
    ax = stage.fig.add_axes([0, 0, 1 - side, 1 - HEAD / height])
    if bar:
        place = stage.fig.add_axes([1 - side + 12 / width, 0.15, 16 / width, 0.6])
        stage.fig.colorbar(bar[0], cax=place, label=bar[1], extend="both")
    style.frame(ax, *look.box)
    pictures.scales(ax, look, size=11)
    clock = stage.fig.text(12 / width, 1 - 8 / height, "", fontsize=15, fontweight="bold", va="top")
    said = stage.fig.text(1 - 12 / width, 1 - 11 / height, "", fontsize=11.5, va="top", ha="right", color="#444444")
    stage.set()

    def drawn_frames():
        for time, scene in frames:
            clock.set_text(f"t = {style.seconds(time, longest)}")
            said.set_text(words(time, scene) if words else f"{len(scene.x):,} disks")
            shown = pictures.paint(ax, scene, look)
            stage.moving = [*shown, clock, said]
            yield stage.picture()
            for artist in shown:
                artist.remove()

    note = film.write(path, stage.fig, drawn_frames(), fps)
    if note:
        raise RecordsError(f"{path}: {note}")
    return path
