"""Many runs of columns or piles, each in a process of its own, kept in folders so that an interrupted study goes on."""

from __future__ import annotations

from dataclasses import asdict, fields
from pathlib import Path

import numpy as np

from ... import records
from ...running import kept_runs, side_by_side
from ...system import checks, keys
from ...system.whole_files import write_arrays
from ...world import worlds
from .column import Column
from .grains import PATH_PER_STEP, HeapError, check_damping
from .pile import Pile

__all__ = ["KINDS", "DURATION", "film", "frames", "key_of", "one", "planned", "run", "world_of"]

KINDS = {"column": Column, "pile": Pile}
TOLERANCE = 1e-4
_SOFT = tuple(one.name for one in fields(worlds.Soft) if one.name != "diameter")
DURATION = 15.0  # T, the longest course after the release


def world_of(heap, name="hard", path=None, tolerance=None, damping_moving=None, **soft):
    """A world for a heap. ``name``: "hard" with the step that :meth:`Heap.time_step` gives for ``path``, and ``tolerance`` (None: 0.1 and 1e-4); or "soft" with the fields of
    :class:`yade.nonsmooth.worlds.Soft` but its diameters. ``damping_moving``: no part of the world, but checked here; see :func:`course.run`.

    Raises HeapError or SoftError for values that cannot be used, for those of the other world, and HeapError for grains with what the springs have not: see :meth:`Heap.check_world`.
    """
    hard = {key: value for key, value in (("path", path), ("tolerance", tolerance)) if value is not None}
    for key, value in hard.items():
        checks.number(key, value, HeapError, "give a number above 0", above=0)
    if name == "hard" and soft:
        raise HeapError(
            f"{', '.join(f'{key} {value!r}' for key, value in soft.items())} with world 'hard': rigid disks have no such value; leave it out, or take world 'soft'"
        )
    if name == "soft" and hard:
        raise HeapError(
            f"{', '.join(f'{key} {value!r}' for key, value in hard.items())} with world 'soft': springs have no such value, their step is step_share of its limit; leave it out, or take world 'hard'"
        )
    unknown = [key for key in soft if key not in _SOFT]
    if unknown:
        raise HeapError(f"{', '.join(unknown)}: no value of the soft world; give some of {', '.join(_SOFT)}")
    if name == "hard":
        made = worlds.Hard(
            time_step=heap.time_step(hard.get("path", PATH_PER_STEP)), tolerance=hard.get("tolerance", TOLERANCE)
        )
    elif name == "soft":
        checks.number(
            "stiffness",
            soft.get("stiffness"),
            HeapError,
            "the soft world needs Young's modulus in Pa, above 0",
            above=0,
        )
        made = worlds.Soft(diameter=heap.diameters(), **soft)
        remedy = "the time step in units of its stability limit; give a number above 0, to 1 at most"
        checks.number("step_share", made.step_share, HeapError, remedy, above=0, most=1)
        made.equivalent(heap.material())  # refuses values that no soft contact has
        heap.check_world(made)
    else:
        raise HeapError(f"world {name!r}: give hard or soft")
    check_damping(made, damping_moving)
    return made


def key_of(heap, world, duration):
    """Key of a run, to tell whether a folder holds it. ``world``: arguments of :func:`world_of`, a dictionary."""
    made, moving = world_of(heap, **world), world.get("damping_moving")
    told = {"heap": heap.plain(), "world": [made.name, asdict(made)], "duration": duration}
    return keys.key_of(told if moving is None else told | {"damping_moving": moving})


def one(folder, kind, heap, world, duration):
    """Runs a heap in the running scene; ``kind``: of :data:`KINDS`, ``heap``: its parameters, ``world``: arguments of :func:`world_of`, a dictionary.

    Writes ``series.csv``, ``places.npz`` and ``film.npz`` to ``folder``, its share done to ``progress``, and returns the :meth:`~course.Result.summary`.
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
    times = sorted(result.frames)
    write_arrays(
        folder / "places.npz",
        compressed=True,
        time=times,
        x=[result.frames[t][0] for t in times],
        y=[result.frames[t][1] for t in times],
        r=result.r,
        x_end=result.x,
        y_end=result.y,
        connected=result.connected,
    )
    write_arrays(
        folder / "film.npz",
        compressed=True,
        time=list(result.film),
        x=[x for x, _ in result.film.values()],
        y=[y for _, y in result.film.values()],
    )
    return result.summary()


def frames(folder):
    """Places of a run below ``folder``: times [s] with the end last, a list of (x, y) for each, and radii [m]."""
    with np.load(Path(folder) / "places.npz", allow_pickle=False) as data:
        series = records.read_series(Path(folder) / "series.csv")
        return (
            [*data["time"].tolist(), float(series["time_s"][-1])],
            [*zip(data["x"], data["y"]), (data["x_end"], data["y_end"])],
            data["r"],
        )


def film(folder):
    """Places for the video of a run below ``folder``: times [s] at equal distances, a list of (x, y) for each, and radii [m]; three empty ones where a run of an earlier version has kept none."""
    path = Path(folder) / "film.npz"
    if not path.exists():
        return [], [], np.zeros(0)
    with np.load(path, allow_pickle=False) as data, np.load(Path(folder) / "places.npz", allow_pickle=False) as places:
        return data["time"].tolist(), [*zip(data["x"].astype(float), data["y"].astype(float))], places["r"]


def planned(name, folder, heap, world, duration=DURATION) -> side_by_side.Run:
    """A run as side_by_side.run takes it, checked: ``name``: for messages; ``world``: arguments of :func:`world_of`, a dictionary; ``duration``: see course.run.

    Raises what :func:`world_of` raises, and HeapError for what is no heap and for a duration that is no number above 0.
    """
    kind = next((kind for kind, made in KINDS.items() if type(heap) is made), None)
    if kind is None:
        raise HeapError(f"{heap!r}: is no heap; give a Column or a Pile")
    checks.number("duration", duration, HeapError, "give a number above 0, in units of T = √(H/g)", above=0)
    return side_by_side.Run(
        name,
        Path(folder),
        one,
        {"kind": kind, "heap": asdict(heap), "world": world, "duration": duration},
        key_of(heap, world, duration),
        heap.disks * heap.box()[1] / heap.mean_diameter(),
    )


def run(cases, out, threads=1, resume=False, duration=DURATION, progress=lambda share: None):
    """Runs ``cases``, {name: (heap, arguments of world_of)}, as many at a time as ``threads``, in ``out/runs/NAME``; returns {name: summary}.

    ``resume``: keep runs of these parameters that have ended. ``progress``: called with the share done, now and then; runs count by disks and fall height.
    Raises what :func:`planned` raises, before anything runs, and HeapError with the first failure after the others have ended.
    """
    made = [
        planned(name, side_by_side.folder_of(out, name, HeapError), heap, world, duration)
        for name, (heap, world) in cases.items()
    ]
    return dict(
        zip(cases, side_by_side.run(made, threads, resume, HeapError, progress=lambda share, ended: progress(share)))
    )
