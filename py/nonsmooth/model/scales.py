"""Speeds and times that decide the course of a slope's run, in proportion to the slope.

Two slopes of one shape and of sizes L and L' do the same if speeds are in the ratio √(g L / g' L') and times in the
ratio √(L g' / L' g) (Froude). So what is fixed for the shipped section, with L the root of the layers' area, is scaled
for any other; for the shipped one it has these values to the last bit.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

__all__ = ["Scales", "of"]

AREA = 78885.30336300003  # m² of the shipped section's layers
GRAVITY = 9.81  # m/s²


@dataclass(frozen=True)
class Scales:
    """``row_seconds``: between two rows of the series; ``mean_seconds``: over which forces are averaged for
    characteristic times; ``still_seconds``: without change, after which a solve is tighter; ``moving_speed``,
    ``stopped_speed``, ``going_speed``, ``approach_speed`` [m/s]: see :mod:`yade.nonsmooth.course.slope`,
    :mod:`yade.nonsmooth.studies.slope.slope`; ``correction_speed`` [m/s]: with which errors of position are taken back
    at most, the solver's own but for a similar section.

    The first two are rounded to 1, 2 or 5 times a power of ten (but for a similar section), and no shorter than a time
    step.
    """

    row_seconds: float
    mean_seconds: float
    still_seconds: float
    moving_speed: float
    stopped_speed: float
    going_speed: float
    approach_speed: float
    correction_speed: float


def of(section) -> Scales:
    """The scales of a Section; a similar one has those of its original, in proportion."""
    if section.like:
        original, time = of(section.like[0]), math.sqrt(section.like[1])  # and speeds
        return Scales(**{name: time * value for name, value in vars(original).items()})
    size, gravity = math.sqrt(section.area / AREA), section.gravity / GRAVITY
    speed, time = math.sqrt(size * gravity), math.sqrt(size / gravity)
    row = max(_round(0.1 * time), section.numerics.time_step)
    speeds = (0.2 * speed, 0.02 * speed, 2.0 * speed, 60.0 * speed)
    return Scales(row, max(_round(1.0 * time), row), 5.0 * time, *speeds, correction_speed=1.0)


def _round(seconds):
    """The nearest of 1, 2 and 5 times powers of ten, by ratio."""
    power = math.floor(math.log10(seconds))
    choices = [float(f"{digit}e{k}") for k in (power - 1, power, power + 1) for digit in (1, 2, 5)]
    return min(choices, key=lambda c: abs(math.log(c / seconds)))
