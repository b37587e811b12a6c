"""A slope under all of its load, with strengths divided by a factor: packed, settled and wet as in any run, until it
rests or fails.
"""

from __future__ import annotations

from yade import O

from ...course import strength_reduction
from ...records import checkpoints
from ..slope import experiment

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
    section = asked.section
    if checkpoints.exists(folder):
        course = experiment.resume(section, folder, progress)
    else:
        strengths = asked.strengths(factor)
        course = experiment.begin(section, folder, progress, world=asked.make_world(), strengths=strengths)
    piece = PIECE * course.scales.still_seconds
    said = strength_reduction.loaded(course.state)
    while said is None:
        course.run(end=O.time + piece, stands=True)
        said = strength_reduction.loaded(course.state)
    return said, course.slope
