"""What changes a slope's load by the clock, counted from t0: an earthquake. Needs no YADE.

Each trigger has a begin and an end; alone or together, they follow each other as their times say. The water table is
not among them: it also stops where the slope moves (:func:`.slope.water_table`). A slope whose triggers are not all
over is not at rest for good, however still it stands, and its run goes on. None begins on a slope that failed before
t0, by its dry weight.
"""

from __future__ import annotations

__all__ = ["acting", "begun", "over", "since", "spans"]


def spans(section) -> dict:
    """{trigger: (begin, end)} of a Section's triggers, in s since t0: "shaking"."""
    shaking = section.shaking
    return {} if shaking is None else {"shaking": (shaking.begin, shaking.end)}


def since(t0, failed_dry):
    """The time from which triggers count [s], t0; None before it, and for a slope that had failed dry by then."""
    return None if t0 is None or (failed_dry is not None and failed_dry <= t0) else t0


def begun(section, start, time) -> tuple:
    """The names of the triggers that have begun before a time [s], in their order; ``start``: :func:`since`."""
    return () if start is None else tuple(name for name, (begin, _) in spans(section).items() if time > start + begin)


def acting(section, start, time) -> tuple:
    """Those of them that are not over at that time."""
    return tuple(name for name in begun(section, start, time) if time < start + spans(section)[name][1])


def over(section, start, time) -> bool:
    """Whether no trigger acts at a time [s] or will, once t0 has come."""
    return start is None or all(time >= start + end for _, end in spans(section).values())
