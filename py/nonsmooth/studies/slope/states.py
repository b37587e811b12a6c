"""The slope at rest, on the move, and on soft contacts, as saved scenes: made once and kept in the cache, so that every
measurement begins with the same bits.

Slopes are not pressed, which would take hours with a million disks and changes no cost of a step. At rest: bonded as
packed, under its weight, dry, a second after the settling of a slope experiment ended. On the move: from there the wall
DP loses its friction and the backstop FB all its strength, the water table stands at 20 m, and the slope runs until its
mean speed is 5 m/s. Soft: YADE's own contacts in the place of the rigid ones at rest, after a second in which gaps have
closed and springs have taken up the weight.
"""

from __future__ import annotations

import dataclasses
import tempfile
from pathlib import Path

from yade import O, config

from ...errors import UserError
from ...model import section
from ...records import checkpoints
from ...running.kept_runs import Progress
from ...system import cache, keys
from ...world.stepping import advance
from . import experiment, soft_contacts

__all__ = ["NAMES", "BenchmarkError", "exist", "folder_of", "load", "make"]

NAMES = ("rest", "moving", "soft")
REST_SECONDS = 1.0  # of simulation after the settling ...
REST_SPEED = 0.05  # ... and the largest mean speed that counts as rest then [m/s]
WEAKENED = ("DP", "FB")  # walls, see above
WATER_HEIGHT = 20.0  # of the moving slope [m]
SPEED = 5.0  # its mean speed [m/s] ...
MOVING_SECONDS = 20.0  # ... or what it has reached after so much simulated time
SOFT_SECONDS = 1.0  # of simulation on soft contacts
SPEED_LEAST = 0.2  # m/s, below which a slope does not count as moving
PROGRESS_STEPS = 20  # between two notes of how far the making is
KEPT_DAYS = 14  # without use; every build of the engines has states of its own


class BenchmarkError(UserError, RuntimeError):
    """A measurement that cannot be made; the message says why and what helps."""


def section_of(source, disks):
    """The section ``source`` (a file, or the name of a shipped one) with about so many disks.

    Raises section.SectionError where there is no room for them, BenchmarkError where it has no water or lacks a wall
    that is weakened.
    """
    chosen = dataclasses.replace(section.load(source), pressed=False).with_disks(disks)
    settle = dataclasses.replace(chosen.stages.settle, bond="before")
    chosen = dataclasses.replace(chosen, stages=dataclasses.replace(chosen.stages, settle=settle))
    missing = [name for name in WEAKENED if name not in {wall.name for wall in chosen.walls}]
    if missing or chosen.water_table is None:
        raise BenchmarkError(
            f"{source}: there is no {'wall ' + missing[0] if missing else 'water table'}, which the moving slope needs; take jiufengershan or a "
            "section made from it"
        )
    return chosen


def key_of(chosen):
    """What a saved state depends on: section, water, seed, YADE, the engines, and the code that builds and runs the
    scene.
    """
    return keys.key_of(
        {
            "section": chosen.key("settled"),
            "water": dataclasses.asdict(chosen.water),
            "seed": chosen.seed,
            "yade": config.version,
            "made by": keys.making_key(__name__),
        }
    )


def folder_of(chosen) -> Path:
    """Where the states of a Section are kept, in the cache folder "benchmark"."""
    return cache.folder("benchmark") / key_of(chosen)[:32]


def exist(source, disks):
    """Whether all states are there."""
    home = folder_of(section_of(source, disks))
    return all(checkpoints.exists(home / name) for name in NAMES)


def make(folder, source, disks):
    """Makes all states; returns an empty dictionary. Writes the share done to ``folder/progress`` (see processes.call).

    Raises BenchmarkError where the slope does not come to rest, or does not begin to move.
    """
    chosen = section_of(source, disks)
    cache.clear(KEPT_DAYS, "benchmark")
    note = Progress(folder)
    built = _settle(chosen, lambda share: note(0.5 * share))
    _save("rest", chosen, built)
    _move(built, lambda share: note(0.5 + 0.3 * share))
    _save("moving", chosen, built)
    load(source, disks, "rest")
    soft_contacts.soften(built)
    _run_soft(lambda share: note(0.8 + 0.2 * share))
    _save("soft", chosen, built)
    return {}


def load(source, disks, name):
    """Loads the state ``name`` into YADE.

    Raises BenchmarkError where it is missing or damaged.
    """
    chosen = section_of(source, disks)
    checkpoints.read(folder_of(chosen) / name, key_of(chosen), BenchmarkError, "run again")
    cache.used(folder_of(chosen))


def _save(name, chosen, built):
    checkpoints.write(folder_of(chosen) / name, key_of(chosen), {"disks": built.count, "time_s": O.time})


def _settle(chosen, progress):
    """The settling of a slope experiment, which then ends instead of raising the water."""
    stages = dataclasses.replace(chosen.stages, dry=0.0, end=dataclasses.replace(chosen.stages.end, time=REST_SECONDS))
    dry = dataclasses.replace(
        chosen, stages=stages, water=dataclasses.replace(chosen.water, table=((0.0, 0.0),), rate=0.0)
    )
    foreseen = chosen.stages.settle.ramp + 1.5 + REST_SECONDS
    with tempfile.TemporaryDirectory() as records:
        run = experiment.begin(dry, records, lambda stage, now, _: progress(min(1.0, now / foreseen)))
        run.run()
    built = run.slope
    if built.solver.meanSpeed > REST_SPEED or run.state.failed_dry is not None:
        raise BenchmarkError(
            f"{chosen.source}: {built.count} disks do not come to rest (mean speed {built.solver.meanSpeed:.2g} m/s after {O.time:.1f} s); "
            "take more disks, or stronger materials"
        )
    return built


def _move(built, progress):
    solver, begin = built.solver, O.time
    for name in WEAKENED:
        material = built.wall_material(name)
        material.frictionAngle = material.residualFrictionAngle = 0
        material.tensileStrength = material.residualTensileStrength = 0
    solver.updateStrengths()
    solver.tolerance = built.section.numerics.tolerance_moving
    built.water.times, built.water.heights = [begin], [WATER_HEIGHT]
    while solver.meanSpeed < SPEED and O.time < begin + MOVING_SECONDS:
        advance(PROGRESS_STEPS)
        progress(min(1.0, solver.meanSpeed / SPEED))
    if solver.meanSpeed < SPEED_LEAST:
        raise BenchmarkError(
            f"the slope of {built.count} disks does not move {MOVING_SECONDS:g} s after its wall DP has lost its friction (mean speed "
            f"{solver.meanSpeed:.2g} m/s); take another number of disks"
        )


def _run_soft(progress):
    steps = round(SOFT_SECONDS / O.dt)
    for k in range(0, steps, PROGRESS_STEPS):
        advance(min(PROGRESS_STEPS, steps - k))
        progress(k / steps)
