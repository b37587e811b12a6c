"""Many runs of scenes of spheres, each in a process of its own, kept in folders so that an interrupted study goes on;
runs of rigid spheres go on from their checkpoints.
"""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path

from ...running import kept_runs, side_by_side
from ...system import checks
from .column import RoundColumn
from .drum import TurningDrum
from .grains import SpheresError, check_run, key_of, world_of
from .hopper import RoundHopper
from .pile import PlatePile
from .triaxial import TriaxialTest

__all__ = ["KINDS", "one", "planned", "run"]

KINDS = {kind.KIND: kind for kind in (RoundColumn, RoundHopper, TurningDrum, PlatePile, TriaxialTest)}


def one(folder, kind, scene, world, duration):
    """Runs a scene in YADE's; ``kind``: of :data:`KINDS`, ``scene``: its parameters, ``world``: arguments of
    :func:`.spheres.grains.world_of`, a dictionary; ``duration``: see :func:`.spheres.course.run`. Returns the numbers
    of the run.
    """
    from . import course, triaxial_course

    made = KINDS[kind](**scene)
    given = made, world_of(made, **world), folder
    if kind == TriaxialTest.KIND:
        return triaxial_course.run(*given, kept_runs.Progress(folder))
    return course.run(*given, duration, kept_runs.Progress(folder))


def planned(name, folder, scene, world, duration=None) -> side_by_side.Run:
    """A run as side_by_side.run takes it, checked: ``name``: for messages; ``world``: arguments of
    :func:`.spheres.grains.world_of`, a dictionary; ``duration`` [T], None: that of its kind, and of a triaxial test.

    Raises what :func:`.spheres.grains.world_of` and :func:`.spheres.grains.check_run` raise, and SpheresError for what
    is no scene and for a duration that is no number above 0.
    """
    if type(scene) not in KINDS.values():
        raise SpheresError(f"{checks.shown(scene)}: is no scene of spheres; give one of {', '.join(KINDS)}")
    if duration is not None and scene.KIND == TriaxialTest.KIND:
        raise SpheresError(f"duration {checks.shown(duration)}: a triaxial test ends at its strain; give that instead")
    if duration is not None:
        checks.number("duration", duration, SpheresError, "give a number above 0, in units of T", above=0)
    made = world_of(scene, **world)
    check_run(scene, made, duration)
    return side_by_side.Run(
        name,
        Path(folder),
        one,
        {"kind": scene.KIND, "scene": asdict(scene), "world": world, "duration": duration},
        key_of(scene, made, duration),
        scene.effort(),
    )


def run(cases, out, threads=1, resume=False, duration=None, progress=lambda share: None):
    """Runs ``cases``, {name: (scene, arguments of grains.world_of)}, as many at a time as ``threads``, in
    ``out/runs/NAME``; returns {name: numbers}.

    ``resume``: keep runs of these parameters that have ended, and go on with halted ones from their checkpoints;
    ``progress``: called with the share done, now and then. Raises what :func:`planned` raises, before anything runs,
    and SpheresError with the first failure after the others have ended.
    """
    made = [
        planned(name, side_by_side.folder_of(out, name, SpheresError), scene, world, duration)
        for name, (scene, world) in cases.items()
    ]
    found = side_by_side.run(
        made, threads, resume, SpheresError, progress=lambda share, ended: progress(share), go_on=True
    )
    return dict(zip(cases, found))
