"""What decides a search for the factor of safety by strength reduction: functions of plain data, which give the next
state. Needs no YADE.

The factor of safety is the number by which the strengths must be divided for the slope to fail. Rules:

* the slope is loaded with its strengths as they are, factor 1, until it rests; a slope that fails then has a factor
  below 1, and is loaded anew with strengths multiplied by 2, 4, … until it stands;
* growth: from the state of rest the factor grows by ``step`` of itself, trial by trial, each from where the one before
  came to rest, until the slope fails;
* bisection: then the bracket between the largest factor at which the slope stood and the smallest at which it failed is
  halved, each trial from the rest at the former, until it is no wider than ``within`` of itself;
* failed: in a trial the mean speed has reached that of a slope that moves, or the mass has collapsed (both as
  :mod:`~yade.nonsmooth.course.slope` has them, from the trial's beginning on), or it has not come to rest within ``longest``;
* stable: for ``hold`` the mean speed was that of a slope at rest at most, and no bond broke;
* a slope that still stands at the factor ``most`` stands for ever, as far as anybody asks; one that fails even at
  ``least`` never stands.

A slope may stand at a factor at which another course of loading would have moved it; a bracket is that of this course.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

from ..errors import UserError
from ..system import checks
from . import slope

__all__ = [
    "FAILED",
    "FALLS",
    "FOUND",
    "LOADING_STEP",
    "STABLE",
    "STANDS",
    "Rules",
    "SearchState",
    "StrengthReductionError",
    "after",
    "factor_of_safety",
    "judged",
    "loaded",
    "rules",
    "share",
]

STABLE, FAILED = "stable", "failed"  # what became of a trial
FOUND, STANDS, FALLS = "found", "stands", "falls"  # what became of a search
LOADING_STEP = 0.5  # of the factor, from one loading that fails to the next
LONGEST = 12.0  # holds, of a trial
MOVES, COLLAPSES, RESTLESS = "it moves", "it has collapsed", "it does not come to rest"


class StrengthReductionError(UserError, ValueError):
    """A search that makes no sense; the message names the number, its value and what would do."""


@dataclass(frozen=True)
class Rules:
    """Numbers of a search, see above. ``step``, ``within``: shares of a factor; ``most``, ``least``: factors; ``hold``,
    ``longest`` [s]; ``rest_speed``, ``moving_speed`` [m/s].
    """

    step: float
    within: float
    most: float
    least: float
    hold: float
    longest: float
    rest_speed: float
    moving_speed: float


@dataclass
class SearchState:
    """Where a search stands, all of which goes into checkpoints.

    ``factor``: of the trial that comes or goes on; ``stable``, ``failed``: largest factor at which the slope stood, and
    smallest at which it failed, None while there is none; ``outcome``: one of :data:`FOUND`, :data:`STANDS`,
    :data:`FALLS` where it is over; ``trials``: those that have ended, dictionaries with ``factor``, ``verdict`` and
    ``why``, and what the study tells of them.
    Of the trial that goes on: ``began`` [s], ``centre`` (x, y) [m] of the mass and ``broken`` bonds then, ``bonds``
    that held; ``quiet_since`` [s] and ``quiet_broken``: since when it is at rest, with the same share of broken bonds.
    """

    factor: float = 1.0
    stable: float | None = None
    failed: float | None = None
    outcome: str | None = None
    trials: list = field(default_factory=list)
    began: float = 0.0
    centre: tuple = (0.0, 0.0)
    bonds: int = 0
    broken: int = 0
    quiet_since: float | None = None
    quiet_broken: float = 0.0
    steps: int = 0  # of the search, before the present trial ...
    seconds: float = 0.0  # ... and what they simulated
    first_step: int = 0  # of the scene, at the trial's beginning
    wall_s: float = 0.0
    wall_steps_s: float = 0.0


def rules(section, scales, step=0.1, within=0.02, most=10.0, least=0.05) -> Rules:
    """The :class:`Rules` for a Section with its :class:`~.model.scales.Scales`.

    Raises StrengthReductionError for a number that makes no sense.
    """
    at_most = "give a share of the factor above 0, at most 1, as 0.1"
    checks.number("step", step, StrengthReductionError, at_most, above=0, most=1)
    fine = f"give a share of the factor from 1e-4 to the step, {step:g}"
    checks.number("within", within, StrengthReductionError, fine, least=1e-4, most=step)
    checks.number("most", most, StrengthReductionError, "give a factor above 1, at most 1e6", above=1, most=1e6)
    checks.number("least", least, StrengthReductionError, "give a factor from 1e-6 to 1", least=1e-6, most=1)
    hold = scales.still_seconds
    rest = section.stages.settle.speed_rest
    numbers = map(float, (step, within, most, least))
    return Rules(*numbers, hold, LONGEST * hold, rest, scales.moving_speed)


def judged(state, seen, rules):
    """The state after a row of a trial, and what became of the trial: (:data:`STABLE` or :data:`FAILED`, why), or None
    while it goes on. ``seen``: a :class:`.slope.Seen` whose ``way`` and ``broken`` count from the trial's beginning.
    """
    if seen.speed >= rules.moving_speed:
        return state, (FAILED, MOVES)
    if slope.collapsed(seen):
        return state, (FAILED, COLLAPSES)
    calm = seen.speed <= rules.rest_speed
    same = state.quiet_since is not None and seen.broken == state.quiet_broken
    since = None if not calm else state.quiet_since if same else seen.time
    state = replace(state, quiet_since=since, quiet_broken=seen.broken)
    if since is not None and slope.passed(seen, rules.hold, since):
        return state, (STABLE, f"at rest for {rules.hold:.3g} s")
    if slope.passed(seen, rules.longest, state.began):
        return state, (FAILED, RESTLESS)
    return state, None


def loaded(state):
    """What became of a loading, from the :class:`.slope.State` of a slope that is loaded: as :func:`judged` has it, or
    None while it goes on.
    """
    if state.failed_dry is not None or state.moving is not None:
        return FAILED, MOVES if state.failed_dry is None else "it moves or collapses under its dry weight"
    if state.stage != "done":
        return None
    return (STABLE, "at rest under all of its load") if state.quiet_since is not None else (FAILED, RESTLESS)


def after(state, said, rules, **told):
    """The state after a trial that has ended: with the factor of the next one, or with an outcome. ``said``: verdict
    and why, as :func:`judged` and :func:`loaded` return them; ``told``: more of the trial, for ``trials``.
    """
    verdict, why = said
    s = replace(
        state,
        trials=[*state.trials, {"factor": state.factor, "verdict": verdict, "why": why, **told}],
        quiet_since=None,
        quiet_broken=0.0,
    )
    if verdict == STABLE:
        s.stable = s.factor
    else:
        s.failed = s.factor
    if s.stable is None:
        if s.factor <= rules.least:
            return replace(s, outcome=FALLS)
        return replace(s, factor=max(s.factor * LOADING_STEP, rules.least))
    grown = s.stable * (1 + rules.step)
    if s.failed is None:
        return replace(s, outcome=STANDS) if s.stable >= rules.most else replace(s, factor=min(grown, rules.most))
    if s.failed - s.stable <= rules.within * s.stable:
        return replace(s, outcome=FOUND)
    # no trial begins with a greater loss of strength than a step of growth
    return replace(s, factor=min(grown, 0.5 * (s.stable + s.failed)))


def factor_of_safety(state) -> float | None:
    """The middle of the bracket; None where there is none."""
    return None if state.stable is None or state.failed is None else 0.5 * (state.stable + state.failed)


def share(state, rules) -> float:
    """The part of a search that is done, from 0 to 1: an estimate for the progress bar."""
    if state.outcome is not None:
        return 1.0
    grown = len(state.trials) / (len(state.trials) + 6)  # it is not known how far it will grow
    if state.stable is None or state.failed is None or state.failed > state.stable * (1 + rules.step) ** 2:
        return 0.5 * grown
    left = max(0.0, math.log2((state.failed / state.stable - 1) / rules.within))
    return 0.5 + 0.5 / (1 + left)
