"""Newmark's rigid block on a plane that shakes (Newmark 1965): how far it slides, for comparison with a slope of disks.

In the frame of the ground the block of unit mass is driven down the plane, of the dip β, by

    d = (g + a_y) sin β − a_x cos β      and pressed onto it by      p = (g + a_y) cos β + a_x sin β,

with the accelerations a of the ground, x in the direction in which the plane falls, y up. It resists with s = μ p +
c/m, c the cohesion and m the mass on a unit of area. It rests while ``|d| ≤ s``, slides down with the acceleration d −
s, and up with d + s. A motion that consists of straight pieces makes all of them straight, so that the velocity of the
block is a quadratic function of time within a piece: where it begins to slide, and where it stops or turns round, are
roots of linear and of quadratic equations, and no step of time is chosen.

These are own lines: pyNewmarkDisp, which computes such blocks too, is not in Debian 12 and needs Numba; and few lines
find the events exactly. Needs no YADE.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..errors import UserError
from ..model.ground_motion import GroundMotion
from ..system import checks

__all__ = ["Block", "NewmarkError", "Slide", "slide"]


class NewmarkError(UserError, ValueError):
    """A block, or a motion of the ground, that has no such slide; the message says why and what helps."""


@dataclass(frozen=True)
class Block:
    """A block on a plane of a ``dip`` [degrees], from 0 to less than 90, that falls to the right (``side`` 1) or to the
    left (−1), under ``gravity`` [m/s²].

    ``friction``: the coefficient μ, the same at rest and in motion; ``cohesion`` c [Pa], which slip does not destroy,
    and with it ``mass_per_area`` m [kg/m²], density times thickness along the normal. ``both_ways``: whether the block
    may slide up the plane, too; Newmark's does not.

    Raises NewmarkError for values of another kind, and for a block that slides without shaking.
    """

    dip: float
    friction: float
    cohesion: float = 0.0
    mass_per_area: float | None = None
    gravity: float = 9.81
    side: float = 1.0
    both_ways: bool = True

    def __post_init__(self):
        checks.number("dip", self.dip, NewmarkError, "give degrees, from 0 to less than 90", least=0, below=90)
        checks.number("friction", self.friction, NewmarkError, "give a coefficient from 0", least=0)
        checks.number("cohesion", self.cohesion, NewmarkError, "give a cohesion from 0 in Pa", least=0)
        checks.number("gravity", self.gravity, NewmarkError, "give an acceleration above 0 in m/s²", above=0)
        remedy = "give density times thickness in kg/m², above 0"
        if self.mass_per_area is not None:
            checks.number("mass_per_area", self.mass_per_area, NewmarkError, remedy, above=0)
        elif self.cohesion:
            raise NewmarkError(f"cohesion {self.cohesion:g} Pa without mass_per_area: {remedy}, with a cohesion")
        told = "give 1 where the plane falls to the right, -1 to the left"
        if abs(checks.number("side", self.side, NewmarkError, told)) != 1:
            raise NewmarkError(f"side {checks.shown(self.side)}: {told}")
        if not isinstance(self.both_ways, bool):
            raise NewmarkError(f"both_ways {checks.shown(self.both_ways)}: give True or False")
        if not self._reserve > 0:
            raise NewmarkError(
                f"friction {self.friction:g}, cohesion {self.cohesion:g} Pa on a dip of {self.dip:g} degrees: the "
                "block slides without shaking; give a friction above "
                f"{math.tan(math.radians(self.dip)):.4g}, or a cohesion"
            )

    @property
    def _bound(self):
        """c/m [m/s²]."""
        return self.cohesion / self.mass_per_area if self.cohesion else 0.0

    @property
    def _reserve(self):
        """What a block at rest can bear, down the plane, beside its weight [m/s²]."""
        b = math.radians(self.dip)
        return self.gravity * (self.friction * math.cos(b) - math.sin(b)) + self._bound

    def yield_acceleration(self, way="horizontal") -> float:
        """The acceleration of the ground [m/s²] above which the block slides down: "horizontal", against the direction
        in which it slides, g tan(φ − β) without cohesion; or "along" the plane, upwards. Raises NewmarkError for
        another way.
        """
        b = math.radians(self.dip)
        ways = {"horizontal": math.cos(b) + self.friction * math.sin(b), "along": 1.0}
        if way not in [*ways]:
            raise NewmarkError(f"way {checks.shown(way)}: give one of {', '.join(ways)}")
        return self._reserve / ways[way]

    def drive_and_resistance(self, acceleration) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """What drives the block down the plane, what presses it onto it and what resists, each (n,) [m/s²], under
        accelerations of the ground (n, 2) [m/s²].
        """
        b = math.radians(self.dip)
        x, y = self.side * acceleration[:, 0], self.gravity + acceleration[:, 1]
        pressed = y * math.cos(b) + x * math.sin(b)
        return y * math.sin(b) - x * math.cos(b), pressed, self.friction * pressed + self._bound


@dataclass(frozen=True, eq=False)
class Slide:
    """How a block slides: at ``times`` [s], which rise (those of the motion, and where it begins to slide, stops or
    turns), its ``displacement`` [m] and ``velocity`` [m/s] relative to the ground, positive down the plane; arrays
    (n,). The last time is that at which it has come to rest for good, or the end of the motion where that is later.
    """

    times: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    _acceleration: np.ndarray
    _slope: np.ndarray

    @property
    def permanent(self) -> float:
        """The displacement at the end [m]."""
        return float(self.displacement[-1])

    def at(self, times) -> np.ndarray:
        """Displacements [m] at any times [s], an array of the same shape; exact, as at the times of the slide."""
        times = np.asarray(times, float)
        k = np.maximum(np.searchsorted(self.times, times, side="right") - 1, 0)
        since = np.clip(times, self.times[0], self.times[-1]) - self.times[k]
        late = self._acceleration[k] / 2 + since * self._slope[k] / 6
        return self.displacement[k] + since * (self.velocity[k] + since * late)


def slide(block, motion) -> Slide:
    """The Slide of a :class:`Block` under a :class:`~nonsmooth.model.ground_motion.GroundMotion`.

    Raises NewmarkError for arguments of another kind, and where the motion would lift the block from its plane.
    """
    if not isinstance(block, Block):
        raise NewmarkError(f"block {checks.shown(block)}: give a newmark.Block")
    if not isinstance(motion, GroundMotion):
        raise NewmarkError(
            f"motion {checks.shown(motion)}: give a GroundMotion, as ground_motion.read(path) returns one"
        )
    drive, pressed, bears = block.drive_and_resistance(np.column_stack((motion.horizontal, motion.vertical)))
    for k in np.flatnonzero(pressed < 0)[:1]:
        raise NewmarkError(
            f"motion at {motion.times[k]:g} s: the ground falls away from the block; Newmark's block stays on its "
            "plane: give a smaller motion"
        )
    # what is left of the drive where the block slides down, or up; straight lines, each above 0 or below it where
    # the block at rest begins to slide
    down, up = drive - bears, drive + bears if block.both_ways else np.full(len(drive), math.inf)
    course = _Course()
    for k, (begin, end) in enumerate(zip(motion.times[:-1].tolist(), motion.times[1:].tolist())):
        lines = tuple(
            (one[k], (one[k + 1] - one[k]) / (end - begin) if np.isfinite(one[k]) else 0.0) for one in (down, up)
        )
        course.follow(begin, end, *lines)
    still = [np.ravel(one)[0] for one in block.drive_and_resistance(np.zeros((1, 2)))]
    course.come_to_rest(still[0] - still[2], still[0] + still[2] if block.both_ways else math.inf)
    return course.slide()


class _Course:
    """A slide that is followed from one straight piece of the motion to the next."""

    def __init__(self):
        self._now, self._place, self._speed, self._way = 0.0, 0.0, 0.0, 0  # 1: slides down, −1: up, 0: rests
        self._rows = []

    def follow(self, begin, end, down, up):
        """A piece from ``begin`` to ``end`` [s]; ``down``, ``up``: (value at the beginning, slope) of the acceleration
        of a block that slides down, or up.
        """
        since, length = 0.0, end - begin
        while since < length:
            self._now = begin + since
            if self._way == 0:
                start, way = min((_onset(down, since), 1), (_onset((-up[0], -up[1]), since), -1))
                if start > since:
                    self._keep(0.0, 0.0)
                since, self._way = (start, way) if start < length else (length, 0)
                continue
            value, slope = (self._way * part for part in (down if self._way > 0 else up))
            speed, pull = self._way * self._speed, value + slope * since
            if speed == 0:  # it begins to slide, where rounding may have left a pull that would hold it
                pull = max(pull, 0.0)
            stop = _stop(speed, pull, slope)
            self._go(min(stop, length - since), pull, slope)
            if stop <= length - since:
                self._speed, self._way = 0.0, 0
                # a slide too short for the clock must not begin again at the same time
                since = max(since + stop, math.nextafter(since, math.inf))
            else:
                since = length
        self._now = end

    def come_to_rest(self, down, up):
        """From where the motion has ended: constant accelerations, that hold the block."""
        pull = down if self._way > 0 else -up
        if self._speed != 0:
            last = self._now
            stop = _stop(self._way * self._speed, pull, 0.0)
            self._go(stop, pull, 0.0)
            self._now, self._speed = last + stop, 0.0
        self._keep(0.0, 0.0)

    def _go(self, time, pull, slope):
        """Slides on for a ``time``, with the acceleration ``pull`` + ``slope`` t the way it goes."""
        way = self._way
        self._keep(way * pull, way * slope)
        speed = way * self._speed
        self._place += way * time * (speed + time * (pull / 2 + time * slope / 6))
        self._speed = way * (speed + time * (pull + time * slope / 2))

    def _keep(self, acceleration, slope):
        self._rows.append((self._now, self._place, self._speed, acceleration, slope))

    def slide(self):
        """What has been followed. Of rows at the same time, as rounding makes them, the last is kept."""
        rows = np.array(self._rows)
        return Slide(*rows[np.r_[np.diff(rows[:, 0]) > 0, True]].T)


def _onset(line, since):
    """The first time from ``since`` on at which a straight line is above 0, or about to be; infinite where there is
    none.
    """
    value, slope = line
    ahead = value + slope * since
    if ahead > 0:
        return since
    return max(since, -value / slope) if slope > 0 else math.inf


def _stop(speed, pull, slope):
    """The first time above 0 at which ``speed`` + ``pull`` t + ``slope`` t²/2 is 0, ``speed`` ≥ 0; infinite where there
    is none.
    """
    if speed == 0:
        return -2 * pull / slope if slope < 0 else math.inf
    if slope == 0:
        return -speed / pull if pull < 0 else math.inf
    inner = pull**2 - 2 * slope * speed
    if inner < 0:
        return math.inf
    q = -(pull + math.copysign(math.sqrt(inner), pull))  # without the difference of two numbers that are nearly equal
    return min((one for one in (q / slope, 2 * speed / q) if one > 0), default=math.inf)
