"""Characteristic times of a slope's run, from its series and its state. Needs no YADE.

Rules (Taboada and Estrada 2009, section 6; what they leave open is ours):

* t0: the water table begins to rise; a slope that failed before that, by its dry weight, has neither t0 nor t1 to t3;
* t1, failure: the mean of N_FB, the normal force on the backstops, over one second first comes within 2 % of its
  largest value up to t2, the strength of the foot, and stays about there (paragraph 116); where there is no backstop,
  the slope begins to creep: the mean speed comes to 0.02 m/s and is not below it again before t2;
* t2, triggering: the slope begins to accelerate (paragraph 117): the mean speed comes to 0.2 m/s, and the slope does
  not come to rest again before it has got going; this is ``moving`` of :mod:`.course.slope`. Friction and pore pressure
  are whole then, but for a slope that had slipped and stopped before;
* t3: the mean of T_DP, the shear force on the slip surfaces, over one second has fallen by 90 % of its value at t2, and
  weakening has begun; none without weakening;
* t4: the largest kinetic energy since t2;
* t5: the mean speed falls below ``rest_fraction`` (2 %) of its maximum since t2 for good;
* they come in this order: a t3 after t4, where weakening takes less than 90 % of the shear force and the deposit
  happens to bear little, is none of triggering, and a t5 before t4 no rest. Such a time did not come, and
  :func:`missing` says why.

Weakening begins where D_c is reached by one per cent of the disks that fit along the slip surfaces, or half of the
friction is lost where a tenth of the load is borne on those with slip laws, so that one cell of many, at an end which few
disks press on, does not begin it. Where some lie one above another (stacks.py), D_c is reached so along one of them, and
T is then the shear force on that one. A slope that failed dry has t4
and t5 of all of its rows. One second, 0.02 and 0.2 m/s, are those of the shipped section, and scaled for another
(scales.py).
"""

from __future__ import annotations

import math

import numpy as np

from .. import records
from ..model import scales

__all__ = [
    "COLUMNS",
    "FASTER",
    "NAMES",
    "RESTING",
    "by_threshold",
    "chosen_rows",
    "columns",
    "kept_rows",
    "mean_of",
    "missing",
    "of_run",
    "reason_of",
    "weakening_begins",
]

NAMES = ("t0", "t1", "t2", "t3", "t4", "t5")
#: Columns of the series that the times follow from, see also :func:`columns`.
COLUMNS = (
    "step",
    "time_s",
    "stage",
    "fb_normal_N_per_m",
    "dp_shear_N_per_m",
    "weakened_disks",
    "speed_mean_m_per_s",
    "energy_kinetic_J",
)
#: Which times numbers of a summary are of, those first whose lack tells most.
NEEDED = {
    "water_at_failure_m": ("t1",),
    "fb_force_at_failure_N_per_m": ("t1",),
    "dp_shear_at_failure_N_per_m": ("t1",),
    "triggering_s": ("t2", "t3"),
    "weakening_s": ("t3",),
    "motion_s": ("t3", "t5"),
} | {f"times_s.{name}": (name,) for name in NAMES}
#: Speeds for which :func:`by_threshold` tells t2, in per cent of that of a slope that moves (0.2 m/s of the shipped
#: section), and shares of the largest mean speed for which it tells t5, in per cent.
FASTER, RESTING = (50, 100, 200, 300, 400, 500), (2, 5, 10)
LEVEL = 0.98  # of the strength of the foot
WEAKENED = 0.01  # of the disks along the slip surfaces
WEAKENED_LOAD = 0.1  # of their cells, by the load that they bear
CELLS = "cells_weakened_rel"  # that share, where slip surfaces have slip laws
FALLEN = 0.1  # of the shear force that is left at t3
SAME = 1e-9  # s, of one row's time


def columns(section) -> tuple[str, ...]:
    """All columns of a Section's series that its times follow from."""
    own = (
        records.column(name, surface) for surface in section.stacked for name in ("dp_shear_N_per_m", "weakened_disks")
    )
    return (*COLUMNS, *own, *([CELLS] if section.heated_surfaces else ()))


def chosen_rows(series, state):
    """The rows that a run is told by: those since it settled, but all of a slope that failed dry. ``state``: see
    :func:`of_run`.
    """
    return series if state.get("failed_dry") is not None else records.since_settled(series)


def mean_of(series, name, end, span):
    """Mean of a column over the rows of the ``span`` seconds up to ``end`` [s], a row's time; 0: that row alone. NaN
    where there is none.
    """
    t = series["time_s"]
    chosen = (t > end - _reach(t, span)) & (t <= end + SAME)
    return float(np.mean(series[name][chosen])) if chosen.any() else math.nan


def _reach(t, span):
    """How far back from a row's time [s] the rows of ``span`` seconds go."""
    row = (t[-1] - t[0]) / max(1, len(t) - 1)  # each tells of so long before its time, which it meets to half a step
    return max(span, row) - 0.5 * row + SAME


def _means(series, name, span):
    """:func:`mean_of` for each row, shape (rows,)."""
    t = series["time_s"]
    first, after = np.searchsorted(t, t - _reach(t, span), side="right"), np.arange(1, len(t) + 1)
    sums = np.add.reduceat(np.append(series[name], 0.0), np.column_stack([first, after]).ravel())[::2]
    return sums / (after - first)


def of_run(series, section, state) -> dict[str, float | None]:
    """t0 … t5 [s] of a run; None for those that did not come. ``series``: its :func:`chosen_rows`; ``state``: the
    fields of course.State as a mapping.
    """
    found = _of_run(series, section, state, scales.of(section))
    return {name: None if name in _out_of_order(found) else time for name, time in found.items()}


def _out_of_order(found):
    """{name: why} of times that are none, as they do not come in their order."""
    why, (t3, t4, t5) = {}, (found[name] for name in ("t3", "t4", "t5"))
    if None not in (t3, t4) and t3 > t4 + SAME:
        why["t3"] = "the shear force had fallen by 90 % only after the kinetic energy was largest (t4)"
    if None not in (t4, t5) and t5 < t4 - SAME:
        why["t5"] = "the kinetic energy was largest (t4) after the mean speed had become small for good"
    return why


def missing(series, section, state) -> dict[str, str]:
    """{name: why} of the times that did not come, in words. Arguments as of :func:`of_run`."""
    found = _of_run(series, section, state, scales.of(section))
    why = {name: _reason(name, series, section, state) for name in NAMES if found[name] is None}
    return dict(sorted((why | _out_of_order(found)).items()))


def reason_of(name, times_missing):
    """Why a run has not the number ``name`` of its summary, from its ``times_missing``; None where that does not
    tell.
    """
    return next((times_missing[time] for time in NEEDED.get(name, ()) if times_missing.get(time)), None)


def _reason(name, series, section, state):
    over = "the run ended" if state["stage"] == "done" else "the run was stopped"
    if name == "t5" and (state.get("failed_dry") is not None or state["moving"] is not None):
        return f"the slope had not come to rest when {over}"
    if state.get("failed_dry") is not None:
        return "the slope moved before the water came"
    if state["t0"] is None:
        return f"{over} before the water began to rise"
    if state["moving"] is None:
        return "the slope did not move off"
    if not section.slip_surfaces:
        return "there is no slip surface"
    begins, surface = _weakening(series, section, state)
    if begins is None:
        return "no slip surface weakened"
    return f"the shear force{f' on {surface}' * bool(surface)} did not fall by 90 %"


def _of_run(series, section, state, scale):
    """As :func:`of_run`, in whatever order they come."""
    times = dict.fromkeys(NAMES)
    if state.get("failed_dry") is not None:
        return times | _of_motion(series, section)
    times["t0"], times["t2"] = state["t0"], state["moving"]
    if times["t0"] is None or times["t2"] is None:
        return times | {"t2": None}
    times["t1"] = _failure(series, scale, times["t0"], times["t2"])
    (begins, surface), triggered = _weakening(series, section, state), _row(series, times["t2"])
    if begins is not None:
        name = "dp_shear_N_per_m"
        shear = _means(series, records.column(name, surface) if surface else name, scale.mean_seconds)
        late = series["time_s"] >= max(times["t2"], begins) - SAME
        fallen = np.flatnonzero(late & (shear <= FALLEN * shear[triggered]))
        times["t3"] = float(series["time_s"][fallen[0]]) if len(fallen) else None
    return times | _of_motion(series, section, triggered)


def weakening_begins(series, section, state) -> float | None:
    """When the slip surfaces begin to weaken [s], see above; None where they do not, and for a slope that failed dry.
    Arguments as of :func:`of_run`.
    """
    return _weakening(series, section, state)[0]


def _weakening(series, section, state):
    """When weakening begins [s], and along which slip surface, its name, of those one above another; None for what
    there is not.
    """
    if state.get("failed_dry") is not None or state["t0"] is None:
        return None, None
    name, lines = "weakened_disks", dict(section.slip_surfaces)
    # a series of a version before has no columns of each
    apart = [one for one in section.stacked if records.column(name, one) in series]
    kinds = [(one, records.column(name, one), [lines[one]]) for one in apart] or [(None, name, lines.values())]
    found = []
    for surface, column, points in kinds:
        length = float(sum(np.hypot(*np.diff(line, axis=0).T).sum() for line in points))
        enough = max(1.0, WEAKENED * length / math.sqrt(section.disks.mean_square))
        late = np.flatnonzero((series[column] >= enough) & (series["time_s"] >= state["t0"]))
        found += [(float(series["time_s"][late[0]]), surface)] if len(late) else []
    if CELLS in series:
        late = np.flatnonzero((series[CELLS] >= WEAKENED_LOAD) & (series["time_s"] >= state["t0"]))
        found += [(float(series["time_s"][late[0]]), None)] if len(late) else []
    return min(found, key=lambda one: one[0], default=(None, None))


def by_threshold(series, section, times) -> dict[str, dict[str, float | None]]:
    """What t2 and t5 would be by other rules, as the paper gives none: ``t2_by_speed_s``, {per cent of the speed of a
    slope that moves, one of :data:`FASTER`: since when the mean speed has not been below it [s], until t4}, and
    ``t5_by_speed_s``, {per cent of the largest mean speed, one of :data:`RESTING`: when it has fallen below it for good
    [s]}. None for what did not come. ``times``: what :func:`of_run` found; the other arguments as for it.
    """
    t, speed, moving = series["time_s"], series["speed_mean_m_per_s"], scales.of(section).moving_speed
    begun = {f"{percent}": None for percent in FASTER}
    if times["t2"] is not None and times["t4"] is not None:
        last = _row(series, times["t4"])
        for percent in FASTER:
            slow = np.flatnonzero(speed[: last + 1] < percent / 100 * moving)
            first = int(slow[-1]) + 1 if len(slow) else 0
            begun[f"{percent}"] = float(t[first]) if first <= last else None
    rested = {f"{percent}": None for percent in RESTING}
    if times["t4"] is not None:
        first = 0 if times["t2"] is None else _row(series, times["t2"])  # as for t5 itself
        rested = {f"{percent}": _rested(t[first:], speed[first:], percent / 100) for percent in RESTING}
    return {"t2_by_speed_s": begun, "t5_by_speed_s": rested}


def _rested(t, speed, share):
    """When a speed has fallen below a ``share`` of its largest for good [s]; None where it has not."""
    moving = np.flatnonzero(speed >= share * speed.max())
    return float(t[moving[-1] + 1]) if len(moving) and moving[-1] + 1 < len(t) else None


def _row(series, time):
    """Number of the last row up to a time [s]."""
    return max(0, int(np.searchsorted(series["time_s"], time + SAME)) - 1)


def _of_motion(series, section, first=0):
    """t4 and t5 [s] of the rows from number ``first`` on."""
    t, speed = series["time_s"][first:], series["speed_mean_m_per_s"][first:]
    times = {"t4": float(t[np.argmax(series["energy_kinetic_J"][first:])])}
    rested = _rested(t, speed, section.stages.end.rest_fraction)
    return times if rested is None else times | {"t5": rested}


def _failure(series, scale, t0, until):
    """t1 [s] of a slope that begins to accelerate at ``until`` [s]."""
    push = _pushes(series, scale, t0)
    rows = np.flatnonzero((series["time_s"] <= until + SAME) & ~np.isnan(push))
    if not len(rows):
        return float(series["time_s"][_creeps(series, scale, t0, until)])
    return float(series["time_s"][rows[np.argmax(push[rows] >= LEVEL * push[rows].max())]])


def _pushes(series, scale, t0):
    """Mean force on the backstops over the second before each row [N/m]; NaN where that is not all since t0, and where
    they have borne nothing yet.
    """
    force = series["fb_normal_N_per_m"]
    late = (series["time_s"] >= t0 + scale.mean_seconds - SAME) & (np.cumsum(force != 0) > 0)
    return np.where(late, _means(series, "fb_normal_N_per_m", scale.mean_seconds), np.nan)


def _creeps(series, scale, t0, until):
    """Number of the row from which on the mean speed has not been below that of a slope that stands, up to a time
    [s].
    """
    last = _row(series, until)
    slow = (series["time_s"] < t0 - SAME) | (series["speed_mean_m_per_s"] < scale.stopped_speed)
    slow = np.flatnonzero(slow[: last + 1])
    return min(int(slow[-1]) + 1, last) if len(slow) else 0


# ---- while a run goes on ----------------------------------------------------------------------------
def kept_rows(series, section, state) -> np.ndarray:
    """Which rows so far are or may still become t1 … t5: their numbers, rising. What is not among them will not be one
    of these times, whatever comes.

    ``series``: all rows so far, :data:`COLUMNS` at least; ``state``: the fields of course.State after the last of them
    as a mapping.
    """
    chosen, failed, scale = chosen_rows(series, state), state["failed_dry"] is not None, scales.of(section)
    times = _of_run(chosen, section, state, scale)
    found = {times[name] for name in NAMES[1:]}
    if not failed and not state["stood"]:
        # it may yet fail dry, and is then told from all rows
        found |= set(_of_motion(series, section).values())
    got_going = state["moving"] is not None and state["speed_max"] >= scale.going_speed
    if not failed and state["t0"] is not None and not got_going:
        # t2 has not come, or may be taken back (see course.slope)
        found |= _may_be_failure(chosen, scale, state["t0"])
    return np.array(sorted(_row(series, time) for time in found - {None}), int)


def _may_be_failure(series, scale, t0):
    """Times [s] that t1 may have when t2 comes, a set: what is first above a share of a largest force that is yet to
    come was a record when it came.
    """
    t, push = series["time_s"], np.nan_to_num(_pushes(series, scale, t0), nan=-np.inf)
    best = np.maximum.accumulate(push)
    record = push > np.append(-np.inf, best[:-1])
    found = set(t[record & (push >= LEVEL * best[-1])].tolist())
    if series["speed_mean_m_per_s"][-1] >= scale.stopped_speed:
        found.add(float(t[_creeps(series, scale, t0, t[-1])]))
    return found
