"""A slope under all of its load, with strengths divided by a factor: packed, settled and wet as in any run, until it
rests or fails.
"""

from __future__ import annotations

import math

from yade import O

from ...course import strength_reduction
from ...model import scales
from ...records import checkpoints
from ..slope import experiment, slope, slope_packing

__all__ = ["folder_of", "load"]

PIECE = 2.0  # times of stillness, after which a loading is looked at: one that fails need not run out


def folder_of(folder, factor):
    """Where the records of a loading are, below the folder of the search."""
    return folder / f"loading-{factor:.6g}"


def load(asked, folder, factor, progress=None):
    """Loads the slope of an :class:`.asked.Asked` in the running scene, with strengths divided by ``factor``; returns
    what became of it, as :func:`.strength_reduction.loaded` does, and the :class:`.slope.Slope`.

    Goes on from a checkpoint in its ``folder``, if there is one. Raises what a slope's run raises.
    """
    section, world = asked.section, asked.make_world()
    if checkpoints.exists(folder):
        course = experiment.resume(section, folder, progress)
    else:
        built = slope.build(section, slope_packing.of(section), world)
        if world is not None:  # rows end with steps
            row = scales.of(section).row_seconds
            O.dt = row / math.ceil(row / O.dt)
        slope.set_strengths(built, asked.strengths(factor), world)
        course = experiment.Experiment(built, folder, progress=progress)
    piece = PIECE * course.scales.still_seconds
    said = strength_reduction.loaded(course.state)
    while said is None:
        course.run(end=O.time + piece, stands=True)
        said = strength_reduction.loaded(course.state)
    return said, course.slope
