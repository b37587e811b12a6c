"""When the windows of a section take disks out of a slope (:mod:`yade.nonsmooth.model.section.erosion`). Needs no YADE.

Rules:

* a window takes at the rows from the first at its begin, or after it, to the first at its end, or after it; where both
  are one time, at one row;
* with ``hold: motion`` it takes nothing while the slope moves; where the slope comes to rest again without having got
  going, it goes on where it was, later by as long as that took;
* no window takes anything before t0, of a slope that failed dry, or once the course is over; the course is not over
  while one may, but that those which hold are not waited for once the slope has got going.
"""

from __future__ import annotations

from dataclasses import replace

__all__ = ["acting", "clock", "due", "noted", "over"]


def clock(window, state, time) -> float:
    """The time of a Window [s since t0] at a ``time`` [s] of a slope whose t0 has come."""
    return time - state.t0 - (state.erosion_delay if window.hold == "motion" else 0.0)


def noted(before, state, seen, section):
    """The State after a row, with the time at which each window has taken last, where ``state`` is without that and
    ``before`` is that of the row before.
    """
    if not section.erosion or state.stage != "water" or state.failed_dry is not None:
        return state
    if before.moving is not None and state.moving is None:
        state = replace(state, erosion_delay=state.erosion_delay + (seen.time - before.moving))
    taken = dict(state.erosion_taken)
    for window in section.erosion:
        if window.hold == "motion" and state.moving is not None:
            continue
        now = clock(window, state, seen.time)
        if now >= window.begin - 0.5 * seen.step and not _over(window, state, seen.step):
            taken[window.name] = now
    return replace(state, erosion_taken=taken)


def due(before, state, section) -> list:
    """The windows that take disks out after a row, and their times: [(Window, time [s since t0])]; ``before``,
    ``state``: the State before the row, and that of :func:`noted`.
    """
    last, now = before.erosion_taken, state.erosion_taken
    return [(w, now[w.name]) for w in section.erosion if w.name in now and now[w.name] != last.get(w.name)]


def over(state, seen, section) -> bool:
    """Whether no window takes disks any more, of those that do not hold where the slope moves."""
    goes_on = [w for w in section.erosion if w.hold == "never" or state.moving is None]
    return state.failed_dry is not None or all(_over(window, state, seen.step) for window in goes_on)


def acting(state, seen, section) -> bool:
    """Whether a window has begun to take disks and goes on."""
    return any(w.name in state.erosion_taken and not _over(w, state, seen.step) for w in section.erosion)


def _over(window, state, step):
    last = state.erosion_taken.get(window.name)
    return last is not None and last >= window.end - 0.5 * step
