"""Many runs of columns or piles, each in a process of its own, kept in folders so that an interrupted study goes on."""

from __future__ import annotations

from dataclasses import asdict, fields
from pathlib import Path

import numpy as np

from ... import records
from ...running import kept_runs, side_by_side
from ...system import checks, keys
from ...system.whole_files import remove, whole
from ...world import long_courses, worlds
from ...world.choice import check_choice
from .column import GranularColumn
from .grains import HeapError, hard
from .pile import Pile

__all__ = ["KINDS", "DURATION", "film", "frames", "key_of", "one", "planned", "run", "world_of"]

KINDS = {"column": GranularColumn, "pile": Pile}
_SOFT = tuple(one.name for one in fields(worlds.Soft) if one.name != "diameter")
DURATION = 15.0  # T, the longest course after the release
SNAPSHOTS, FRAMES = "snapshots", "frames"  # folders of what is kept on the way, and of the video's


def world_of(heap, name="hard", path=None, tolerance=None, damping_moving=None, **soft):
    """A world for a heap. ``name``: "hard" with the step that :meth:`Heap.time_step` gives for ``path``, and
    ``tolerance`` (None: 0.1 and 1e-4); or "soft" with the fields of :class:`yade.nonsmooth.worlds.Soft` but its
    diameters. ``damping_moving``: no part of the world, but checked here; see :func:`course.run`.

    Raises HeapError, SoftError or WorldError for values that cannot be used, for those of the other world, and
    HeapError for grains with what the springs have not: see :meth:`Heap.check_world`.
    """
    rigid = {key: value for key, value in (("path", path), ("tolerance", tolerance)) if value is not None}
    check_choice(name, rigid, soft, _SOFT, "disks", HeapError)
    if name == "hard":
        made = hard(heap, **rigid)
    else:
        made = worlds.Soft(diameter=heap.diameters(), **soft)
        remedy = "the time step in units of its stability limit; give a number above 0, to 1 at most"
        checks.number("step_share", made.step_share, HeapError, remedy, above=0, most=1)
        made.equivalent(heap.material())  # refuses values that no soft contact has
        heap.check_world(made)
    worlds.check_damping(made, damping_moving)
    return made


def key_of(heap, world, duration):
    """Key of a run, to tell whether a folder holds it. ``world``: arguments of :func:`world_of`, a dictionary."""
    made, moving = world_of(heap, **world), world.get("damping_moving")
    told = {"heap": heap.plain(), "world": [made.name, asdict(made)], "duration": duration}
    return keys.key_of(told if moving is None else told | {"damping_moving": moving})


def one(folder, kind, heap, world, duration):
    """Runs a heap in the running scene; ``kind``: of :data:`KINDS`, ``heap``: its parameters, ``world``: arguments of
    :func:`world_of`, a dictionary.

    Writes ``series.csv``, ``snapshots`` and ``frames`` to ``folder``, its share done to ``progress``, and returns the
    :meth:`~course.HeapResult.summary`.
    """
    from . import course

    folder, made = Path(folder), KINDS[kind](**heap)
    result = course.run(
        made,
        world_of(made, **world),
        duration,
        progress=kept_runs.Progress(folder),
        damping_moving=world.get("damping_moving"),
    )
    with records.SeriesWriter(folder / "series.csv", course.COLUMNS, overwrite=True) as series:
        for row in zip(*(result.series[name].tolist() for name in course.COLUMNS)):
            series.write(dict(zip(course.COLUMNS, row)))
    _write(folder, result)
    return result.summary()


def _write(folder, result):
    """The disks of a run as records.Snapshots: on the way and in the end, and compact ones for the video."""
    kept, film = folder / SNAPSHOTS, folder / FRAMES
    remove([*whole(kept, "*.npz"), *whole(film, "*.npz")], "left from an earlier run")

    def step(time):
        return round(time / result.time_step)

    for time, (x, y) in result.frames.items():
        records.write_snapshot(kept / f"{step(time):08d}.npz", time_s=time, step=step(time), x=x, y=y, r=result.r)
    end = {name: result.series[name][-1] for name in ("time_s", "step")}
    records.write_snapshot(kept / "end.npz", **end, x=result.x, y=result.y, r=result.r)
    for time, (x, y) in result.film.items():
        path = film / f"{step(time):08d}.npz"
        records.write_snapshot(path, compact=True, time_s=time, step=step(time), x=x, y=y, r=result.r)


def _places(folder):
    shots = [records.read_snapshot(path) for path in whole(folder, "*.npz")]
    return [s.time_s for s in shots], [(s.x, s.y) for s in shots], shots[-1].r if shots else np.zeros(0)


def frames(folder):
    """Places of a run below ``folder``: times [s] with the end last, a list of (x, y) for each, and radii [m]. Raises
    HeapError where there are none.
    """
    found = _places(Path(folder) / SNAPSHOTS)
    if not found[0]:
        raise HeapError(
            f"{folder}: has no {SNAPSHOTS}, as runs that have not ended and those of earlier versions; run it again"
        )
    return found


def film(folder):
    """Places for the video of a run below ``folder``: times [s] at equal distances, a list of (x, y) for each, and
    radii [m]; three empty ones where it has kept none.
    """
    return _places(Path(folder) / FRAMES)


def planned(name, folder, heap, world, duration=DURATION) -> side_by_side.Run:
    """A run as side_by_side.run takes it, checked: ``name``: for messages; ``world``: arguments of :func:`world_of`, a
    dictionary; ``duration``: see course.run.

    Raises what :func:`world_of` raises, and HeapError for what is no heap, for a duration that is no number above 0 and
    for a course of more steps than anybody waits for.
    """
    kind = next((kind for kind, made in KINDS.items() if type(heap) is made), None)
    if kind is None:
        raise HeapError(f"{heap!r}: is no heap; give a Column or a Pile")
    checks.number("duration", duration, HeapError, "give a number above 0, in units of T = √(H/g)", above=0)
    made, unit = world_of(heap, **world), heap.fall_time()
    step = made.step_for([heap.material()])
    long_courses.check(duration * unit, DURATION * unit, duration, made, step, heap.time_step(1.0), HeapError)
    return side_by_side.Run(
        name,
        Path(folder),
        one,
        {"kind": kind, "heap": asdict(heap), "world": world, "duration": duration},
        key_of(heap, world, duration),
        heap.disks * heap.box()[1] / heap.mean_diameter(),
    )


def run(cases, out, threads=1, resume=False, duration=DURATION, progress=lambda share: None):
    """Runs ``cases``, {name: (heap, arguments of world_of)}, as many at a time as ``threads``, in ``out/runs/NAME``;
    returns {name: summary}.

    ``resume``: keep runs of these parameters that have ended. ``progress``: called with the share done, now and then;
    runs count by disks and fall height. Raises what :func:`planned` raises, before anything runs, and HeapError with
    the first failure after the others have ended.
    """
    made = [
        planned(name, side_by_side.folder_of(out, name, HeapError), heap, world, duration)
        for name, (heap, world) in cases.items()
    ]
    return dict(
        zip(cases, side_by_side.run(made, threads, resume, HeapError, progress=lambda share, ended: progress(share)))
    )
