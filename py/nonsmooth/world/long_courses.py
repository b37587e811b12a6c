"""Courses of more steps than anybody waits for, which are refused before anything is computed."""

from __future__ import annotations

import math

__all__ = ["MOST_STEPS", "check"]

MOST_STEPS = 1e9  # of a run, days of work even for a few grains
USUAL_SHARE = 0.5  # a soft world's step_share where none is given


def check(lasts, usual, duration, world, step, unit_step, error):
    """Raises ``error``, a class, with the parameter that makes a course so long and what would do.

    ``lasts``: the course [s]; ``usual``: that of the usual ``duration`` [T], which may be None; ``world``: hard or soft,
    with time steps of ``step`` [s]; ``unit_step``: a hard world's for a path of one mean diameter [s].
    """
    steps = lasts / step if step > 0 else math.inf
    if steps <= MOST_STEPS:
        return
    over = 1.05 * steps / MOST_STEPS  # 5 %, so that what is given with two digits is taken
    if duration is not None and lasts > 1.001 * usual:
        told, remedy = f"duration {duration:g} T", f"{duration / over:.2g} or less"
    elif world.name == "hard":
        path = world.time_step / unit_step
        told, remedy = f"path {path:g}", f"{path * over:.2g} or more"
    elif world.step_share * over <= USUAL_SHARE:
        told, remedy = f"step_share {world.step_share:g}", f"{world.step_share * over:.2g} or more"
    else:
        told, remedy = f"stiffness {world.stiffness:g} Pa", f"{world.stiffness / over**2:.2g} or less"
    raise error(f"{told}: that is {steps:.1e} steps to the end of the course; give {remedy}")
