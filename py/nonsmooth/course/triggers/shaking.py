"""When the ground of a section shakes (:mod:`yade.nonsmooth.model.section.shaking`): from the begin of its record to its
end, counted from t0. Needs no YADE.
"""

from __future__ import annotations

__all__ = ["acting", "began", "lasts", "over", "shakes", "since"]


def since(t0, failed_dry):
    """The time from which a record's begin counts [s], t0; None before it, and for a slope that had failed dry by then."""
    return None if t0 is None or (failed_dry is not None and failed_dry <= t0) else t0


def lasts(section) -> float:
    """When the record is over [s since t0], 0 where nothing shakes."""
    return 0.0 if section.shaking is None else section.shaking.end


def began(section, start, time) -> bool:
    """Whether the ground has begun to shake before a time [s]; ``start``: :func:`since`."""
    return section.shaking is not None and start is not None and time > start + section.shaking.begin


def shakes(section, start, time) -> bool:
    """Whether it does so at that time."""
    return began(section, start, time) and time < start + section.shaking.end


def over(state, seen, section) -> bool:
    """Whether the ground neither shakes nor will, once t0 has come."""
    start = since(state.t0, state.failed_dry)
    return start is None or section.shaking is None or seen.time >= start + section.shaking.end


def acting(state, seen, section) -> bool:
    """Whether the ground shakes."""
    return shakes(section, since(state.t0, state.failed_dry), seen.time)
