"""What decides the course of a slope's run: functions of the state and of what a row sees of the slope, which give the
next state. Needs no YADE.

Rules:

* bonds are made in the packing as it is, without load; then gravity grows to its value during ``stages.settle.ramp``;
* settled: the mean speed is below ``stages.settle.speed_rest``, or ``time_max`` has passed; the dry rest begins;
* failed dry: before t0 the mean speed has reached 2 m/s, or the mass has collapsed: its centre has gone
  :data:`COLLAPSED` of its size sideways, or :data:`CRACKED_WAY` of it with :data:`CRACKED` of the bonds broken; or the
  mean speed is 0.2 m/s at t0, or comes to that without having been below 0.02 m/s since. The water does not rise, or no
  further; the slope is followed until it rests. What moved it, its weight or something else, says
  :mod:`yade.nonsmooth.studies.slope.verdict`;
* t0: the dry rest ends, the water begins to rise, and the times of triggers (:mod:`yade.nonsmooth.course.triggers`)
  count from here;
* moving, t2: the mean speed reaches 0.2 m/s: the slope no longer just follows the water. With ``water.hold: motion``
  the table stays where it is from here on, and the solver's tolerance is ``tolerance_moving``, until the mean speed is
  down to a tenth of its maximum; from there it falls with the speed, down to ``tolerance``. A slope that comes to rest
  again without having got going does not count as moving: the table then goes on rising;
* still: the slope does not move, its water table has stood at one height for 5 s, and no trigger acts:
  the tolerance is a quarter of ``tolerance``, since nothing but the solver's error is left to move a disk, and over a
  minute a looser solve breaks a bond or two that bear all they can;
* a field of water (lines, files, seepage) has its states at their times since t0, whether the slope moves or not; as
  long as one is to come, the slope is not still, and does not stand;
* rows and snapshots are of the first steps that end at, or less than half a step before, whole multiples of their
  distance in time, from the beginning on;
* speeds and times in this list are those of the shipped section, and scaled for another (:mod:`.scales`);
* with soft contacts there is no tolerance: what goes from one value to another while the slope moves is the
  integrator's damping;
* end: the mean speed has been below ``rest_fraction`` of its maximum for ``rest_hold`` seconds, or the slope stands and
  nothing is left that could change it, or ``end.time`` has passed. It stands where for 5 s, and for ``rest_hold``
  seconds more, the mean speed has been no more than ``stages.settle.speed_rest``, no bond broke and no other disk got
  wet, no trigger acts or may any more, and the water table stays where it is or above all disks; a script that may do more to it says so. While a trigger acts or is to come, or a window that does
  not hold takes disks out, neither counts as its end.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

from . import triggers
from .triggers import erosion, shaking

__all__ = [
    "COLLAPSED",
    "FRAME_ROWS",
    "STAGES",
    "Seen",
    "State",
    "after",
    "care",
    "collapsed",
    "damping",
    "field_begin",
    "flowing",
    "foreseen",
    "gravity_share",
    "loads_since",
    "keeps_frame",
    "next_row",
    "noted",
    "passed",
    "stands",
    "tolerance",
    "water_table",
]

STAGES = ("settle", "dry", "water")  # by their number in the series
FRAME_ROWS = 5  # between two snapshots, for the video and the figures
SLOW_FRACTION = 0.1  # of the largest mean speed, see above
STILL_SHARE = 0.25  # the tolerance of a slope that is still, of itself
# Slopes of some hundred disks that stand move their centre by less than 0.002 of their size while they are loaded, and
# lose 2 % of their bonds at most, rocks that fall off their face included; those that collapse go 0.03 and more, and
# lose 12 % and more.
COLLAPSED = 0.01  # way of the mass's centre, in its size (the root of its area)
CRACKED, CRACKED_WAY = 0.1, 0.002  # of the bonds, with such a way
# for the progress bar alone
# s of a usual settling and of a usual avalanche; m of water that a usual slope bears
SETTLING, MOTION, RISE = (8.0, 55.0, 25.0)


@dataclass
class State:
    """Where the experiment stands, all of which goes into checkpoints; times in s of the simulation, None while they
    have not come.
    """

    stage: str = "settle"  # settle, dry, water, done
    settled: float | None = None
    t0: float | None = None
    moving: float | None = None
    failed_dry: float | None = None  # the slope did not wait for the water
    rested: float | None = None  # it first was at rest under all of its weight, before it moved
    outside: float | None = (
        0.0  # J/m, the most that came from elsewhere than weight and water until it moved; None where nobody counts it
    )
    wet: bool = False  # water has acted on a disk before it moved
    stood: bool = False  # at t0 or since, before it moved
    water_hold: float | None = None
    table: float = 0.0  # height of the water table ...
    table_since: float = 0.0  # ... and the time since when it has been there
    water_delay: float = 0.0  # how long the table stood still while the slope moved and came to rest again
    erosion_taken: dict = field(default_factory=dict)  # {window of the section: its time when it last took disks out}
    erosion_delay: float = 0.0  # how long those that hold stood still, as water_delay
    eroded_shift_x: float = 0.0  # m, by which the mass's centre has jumped as disks were taken out ...
    eroded_shift_y: float = 0.0
    front0: float | None = None
    speed_max: float = 0.0
    speed_before: float = 0.0  # the largest before t0
    centre: float | None = None  # x of the mass's centre as it was packed [m]
    quiet_since: float | None = None  # the slope stands and nothing is left that could change it
    quiet_broken: float = 0.0  # what must not change meanwhile: the part of bonds that is broken ...
    quiet_wet: int = 0  # ... and the number of wet disks
    resting_since: float | None = None
    bonds_initial: int = 0
    contacts_initial: int = 0
    packing_fraction: float | None = 0.0
    frames: int = 0
    overlap_mean_worst: float = 0.0
    wall_s: float = 0.0
    wall_packing_s: float = 0.0
    wall_steps_s: float = 0.0  # of wall_s: steps alone, without records ...
    wall_moving_s: float = 0.0  # ... and of these, the ones of the water stage
    moving_s: float = 0.0  # ... and how much they simulated
    first_step: int = 0


@dataclass(frozen=True)
class Seen:
    """What a row sees of the slope: ``time`` [s] and length of the last ``step`` [s], mean ``speed`` [m/s], height of
    the ``water`` table [m], None where the section has none, and whether states of a field of water are ``coming``.

    ``way``: of the mass's centre since it was packed, sideways, in its size; ``broken``: part of the bonds that is
    broken; ``wet``: number of wet disks; ``top``: height of the highest disk's centre above the water's plane [m];
    ``outside``: energy from elsewhere than weight and water [J/m], None where nobody counts it; ``more``: whether a
    script may do more to the slope, whatever the course is.
    """

    time: float
    step: float
    speed: float
    water: float | None = None
    coming: bool = False
    way: float = 0.0
    broken: float = 0.0
    wet: int = 0
    top: float = math.inf
    outside: float | None = 0.0
    more: bool = True


# ---- the state --------------------------------------------------------------------------------------
def noted(state, seen, scales):
    """The State with what counts before a row is written: whether the slope got going or collapsed before the water,
    its largest mean speed since it counts, and what has acted on it.
    """
    before = state.stage != "water"
    s = replace(state, speed_before=max(state.speed_before, seen.speed) if before else state.speed_before)
    if s.failed_dry is None and s.moving is None:
        none = s.outside is None or seen.outside is None
        s = replace(s, outside=None if none else max(s.outside, seen.outside), wet=s.wet or seen.wet > 0)
    if before and s.failed_dry is None and (seen.speed >= scales.going_speed or collapsed(seen)):
        return replace(s, failed_dry=seen.time, speed_max=s.speed_before)
    return replace(s, speed_max=0.0 if before and s.failed_dry is None else max(s.speed_max, seen.speed))


def collapsed(seen):
    """Whether the mass has collapsed, by its way and its broken bonds."""
    return seen.way >= COLLAPSED or (seen.broken >= CRACKED and seen.way >= CRACKED_WAY)


def after(state, seen, section, scales):
    """The State after a row that :func:`noted` has seen: in the same stage, or in the next."""
    settle = section.stages.settle
    if state.rested is None and state.failed_dry is None and state.moving is None:
        if seen.time >= settle.ramp and seen.speed <= settle.speed_rest:
            state = replace(state, rested=seen.time)
    made = {"settle": _settle, "dry": _dry, "water": _water}[state.stage](state, seen, section, scales)
    return erosion.noted(state, made, seen, section)


def _settle(state, seen, section, scales):
    stage = section.stages.settle
    resting = seen.speed <= stage.speed_rest or passed(seen, stage.time_max)
    if seen.time < stage.ramp or not (resting or state.failed_dry is not None):  # one that has failed is not waited for
        return state
    return replace(state, stage="dry", settled=seen.time, table_since=seen.time)


def _dry(state, seen, section, scales):
    if not passed(seen, state.settled + section.stages.dry):
        return state
    failed_dry = seen.time if state.failed_dry is None and seen.speed >= scales.moving_speed else state.failed_dry
    state = replace(state, stage="water", t0=seen.time, failed_dry=failed_dry, stood=seen.speed < scales.stopped_speed)
    return state if failed_dry is None else replace(state, moving=failed_dry, water_hold=0.0)


def _water(state, seen, section, scales):
    stages, s = section.stages, replace(state, stood=state.stood or seen.speed < scales.stopped_speed)
    follows, rises = stages.water_hold == "motion", seen.water is not None
    if s.moving is None and seen.speed >= scales.moving_speed:
        s = replace(
            s,
            moving=seen.time,
            failed_dry=s.failed_dry if s.stood else seen.time,
            water_hold=seen.water if rises and (follows or not s.stood) else s.water_hold,
        )
    elif (
        s.moving is not None
        and s.failed_dry is None
        and seen.speed < scales.stopped_speed
        and s.speed_max < scales.going_speed
    ):
        if rises and follows:
            s = replace(s, water_delay=s.water_delay + (seen.time - s.moving), water_hold=None)
        s = replace(s, moving=None)
    if rises and s.water_hold is None and not isinstance(stages.water_hold, str) and seen.water >= stages.water_hold:
        s = replace(s, water_hold=float(stages.water_hold))
    resting = s.moving is not None and seen.speed < stages.end.rest_fraction * s.speed_max
    since = (seen.time if s.resting_since is None else s.resting_since) if resting else None
    height = seen.water if rises else 0.0
    s = _quieted(s, seen, section)
    rested = resting and passed(seen, stages.end.rest_hold, since) and _load_is_last(s, seen, section)
    over = rested or passed(seen, s.settled + stages.end.time)
    return replace(
        s,
        stage="done" if over or (not seen.more and stands(s, seen, section, scales)) else "water",
        resting_since=since,
        table=height,
        table_since=s.table_since if height == s.table and not seen.coming else seen.time,
    )


def _quieted(s, seen, section):
    """The State with the time since when the slope has been at rest, with the same bonds and the same wet disks, under
    the last load that comes.
    """
    calm = s.moving is None and seen.speed <= section.stages.settle.speed_rest and _load_stays(s, seen, section)
    same = (s.quiet_broken, s.quiet_wet) == (seen.broken, seen.wet)
    since = None if not calm else s.quiet_since if s.quiet_since is not None and same else seen.time
    return replace(s, quiet_since=since, quiet_broken=seen.broken, quiet_wet=seen.wet)


def _load_is_last(s, seen, section):
    """Whether no trigger acts or may any more, and no state of a field of water is to come."""
    return triggers.over(s, seen, section) and not seen.coming


def _load_stays(s, seen, section):
    """Whether the load does not change any more: nothing is to come (:func:`_load_is_last`), and no disk gets wet or dry
    by the table, as it stays where it is, or above all of them.
    """
    if not _load_is_last(s, seen, section):
        return False
    table = water_table(s, section)
    if table is None:
        return True
    coming = [seen.water, *(height for time, height in zip(*table) if time > seen.time)]
    return min(coming) == max(coming) or min(coming) > seen.top


def loads_since(state):
    """The time from which an earthquake counts [s], see :func:`yade.nonsmooth.course.triggers.shaking.since`."""
    return shaking.since(state.t0, state.failed_dry)


def stands(state, seen, section, scales):
    """Whether the slope has stood so long under the last load that comes that nothing is left which could change it:
    until it is solved more tightly, and at rest since.
    """
    hold = scales.still_seconds + section.stages.end.rest_hold
    return state.quiet_since is not None and passed(seen, hold, state.quiet_since)


def passed(seen, time, since=0.0):
    """Whether a row is the first at or after a time [s], to half a step."""
    return seen.time - since >= time - 0.5 * seen.step


# ---- what follows from it ---------------------------------------------------------------------------
def water_table(state, section):
    """Times [s] and heights [m] of the water table, two lists; None before t0, and where the water is none."""
    if state.t0 is None or section.water_table is None:
        return None
    if state.water_hold is not None:
        return [state.t0], [state.water_hold]
    water = section.water
    times, heights = (list(map(float, column)) for column in zip(*water.table))
    if water.rate:
        span = section.stages.end.time
        times.append(times[-1] + span)
        heights.append(heights[-1] + water.rate * span)
    return [state.t0 + state.water_delay + t for t in times], heights


def field_begin(state, section):
    """The time [s] at which that of the section's field of water is 0; None before t0, where the slope did not wait for
    the water, and where the section has no such field.
    """
    return None if section.water_field is None or state.water_hold is not None else state.t0


def flowing(speed, largest):
    """From 0 at rest to 1 on the move, by a mean speed and the largest that there was."""
    return min(1.0, speed / (SLOW_FRACTION * largest))


def care(state, seen, section, scales):
    """How exactly contacts want to be computed in the water stage: (from 0 at rest to 1 on the move, whether the slope
    is still).
    """
    # reactions at rest depend on how the mass came to rest, so more care while it slows down
    return (
        0.0 if state.moving is None else flowing(seen.speed, state.speed_max),
        state.moving is None
        and seen.time - state.table_since >= scales.still_seconds
        and not triggers.acting(state, seen, section),
    )


def tolerance(flowing, still, numerics):
    """Of the solver, from what :func:`care` returned."""
    return max((STILL_SHARE if still else 1.0) * numerics.tolerance, flowing * numerics.tolerance_moving)


def damping(flowing, rest, moving):
    """Of the integrator with soft contacts, whose values are ``rest`` and ``moving``; ``flowing``: as :func:`care`
    returned it.
    """
    return (1 - flowing) * rest + flowing * moving


def gravity_share(time, settle):
    """The part of gravity that acts at a time [s]: it grows linearly during the ramp of the settling stage."""
    return min(1.0, time / settle.ramp) if settle.ramp > 0 else 1.0


def next_row(time, step, seconds):
    """Number of the row that ends next, counted from time 0, where rows are ``seconds`` apart: on the same steps after
    a resume.
    """
    return math.floor((time + 0.5 * step) / seconds) + 1


def keeps_frame(state, row):
    """Whether a snapshot is taken at a row, by its number."""
    return (state.stage != "settle" or state.failed_dry is not None) and row % FRAME_ROWS == 0


def foreseen(state, time, section):
    """Simulated time at which the run may end [s]: an estimate for the progress bar."""
    stages = section.stages
    if state.stage == "done":
        return time
    settled = state.settled if state.settled is not None else max(SETTLING, time)
    shaken = shaking.lasts(section)
    if state.moving is not None:
        last = max(state.moving + MOTION, state.t0 + shaken)
        return max(min(last, settled + stages.end.time), time)
    rate = section.water.rate if section.water else 0
    rise = RISE / rate if rate and stages.water_hold == "motion" else shaken or stages.end.time
    return max(min(settled + stages.dry + rise + MOTION, settled + stages.end.time), time)
