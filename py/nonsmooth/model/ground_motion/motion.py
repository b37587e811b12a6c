"""A motion of the ground, and what follows from it by exact integration."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...errors import UserError
from ...system import checks

__all__ = ["BASELINES", "Drift", "GroundMotion", "GroundMotionError", "STANDARD_GRAVITY"]

STANDARD_GRAVITY = 9.80665  # m/s², of the unit g
LARGEST = 10 * STANDARD_GRAVITY  # m/s²; the largest that were ever recorded have some 4 g
LATEST = 1e6  # s
COMPONENTS = ("horizontal", "vertical")
#: What :meth:`GroundMotion.corrected` takes from the acceleration, and what is left at the end then.
BASELINES = {"constant": "no velocity", "line": "neither velocity nor displacement"}


class GroundMotionError(UserError, ValueError):
    """A motion of the ground that cannot be read, made or used; the message names what is wrong, where, and what
    helps.
    """


@dataclass(frozen=True)
class Drift:
    """What a motion leaves: ``velocity`` [m/s] and ``displacement`` [m] of the ground at the end of the record, each
    (horizontal, vertical). A ground that has come to rest has no velocity; near a fault it may have moved for good.
    """

    velocity: tuple[float, float]
    displacement: tuple[float, float]


@dataclass(frozen=True, eq=False)
class GroundMotion:
    """Accelerations of the ground, ``horizontal`` (to the right) and ``vertical`` (up; zeros where None) [m/s²], at the
    ``times`` [s], which rise: arrays (n,), n ≥ 2. Between two times an acceleration is a straight line; before the
    first and after the last time it is zero. ``name``: of the record; ``source``: where it comes from, and what has
    been done to it.

    Raises GroundMotionError for arrays of other shapes, values that are not finite, times that do not rise, and more
    than 10 g, which are values in another unit.
    """

    times: np.ndarray
    horizontal: np.ndarray
    vertical: np.ndarray | None = None
    name: str = "ground motion"
    source: str = "arrays"

    def __post_init__(self):
        for name in ("name", "source"):
            checks.text(name, getattr(self, name), GroundMotionError, "give words")
        given = {name: getattr(self, name) for name in ("times", *COMPONENTS)}
        if given["vertical"] is None:
            given["vertical"] = np.zeros(len(_column("horizontal", given["horizontal"])))
        for name, value in given.items():
            object.__setattr__(self, name, _column(name, value))
        self._check()

    def _check(self):
        t = self.times
        if len(t) < 2 or len({len(t), len(self.horizontal), len(self.vertical)}) > 1:
            raise GroundMotionError(
                f"times have {len(t)} values, horizontal {len(self.horizontal)} and vertical {len(self.vertical)}: "
                "give one acceleration of each for each time, of two times or more"
            )
        for name, most, unit in (("times", LATEST, "s"), *((one, LARGEST, "m/s²") for one in COMPONENTS)):
            values = getattr(self, name)
            for k in np.flatnonzero(~(np.abs(values) <= most))[:1]:
                remedy = (
                    f"give {unit}, at most {most:g}" if np.isfinite(values[k]) else "give a finite number for each time"
                )
                raise GroundMotionError(f"{name}[{k}] {values[k]:g}: {remedy}")
        for k in np.flatnonzero(np.diff(t) <= 0)[:1]:
            raise GroundMotionError(
                f"times[{k + 1}] {float(t[k + 1])!r} comes after {float(t[k])!r}: give times that rise, each once"
            )

    # ---- the motion in the course of time ---------------------------------------------------------------

    @property
    def duration(self) -> float:
        """From the first time to the last [s]."""
        return float(self.times[-1] - self.times[0])

    @cached_property
    def _nodes(self):
        """Accelerations, velocities and displacements at the times, from rest: three arrays (n, 2)."""
        a, dt = np.column_stack((self.horizontal, self.vertical)), np.diff(self.times)[:, None]
        v = np.vstack((np.zeros((1, 2)), np.cumsum(0.5 * dt * (a[:-1] + a[1:]), axis=0)))
        d = np.cumsum(v[:-1] * dt + dt**2 * (2 * a[:-1] + a[1:]) / 6, axis=0)
        return a, v, np.vstack((np.zeros((1, 2)), d))

    def _pieces(self, times):
        """Of times, an array of any shape: the number of the straight piece that each is in, the time since its
        beginning [s], the slope there (…, 2) [m/s³]; times before the first and after the last count as these.
        """
        t, a = self.times, self._nodes[0]
        inside = np.clip(times, t[0], t[-1])
        k = np.clip(np.searchsorted(t, inside, side="right") - 1, 0, len(t) - 2)
        return k, (inside - t[k])[..., None], ((a[k + 1] - a[k]) / (t[k + 1] - t[k])[..., None])

    def acceleration(self, times) -> np.ndarray:
        """Accelerations (…, 2) [m/s²], horizontal and vertical, at times (…) [s]."""
        times = _times(times)
        found = [np.interp(times, self.times, getattr(self, one), left=0.0, right=0.0) for one in COMPONENTS]
        return np.stack(found, axis=-1)

    def velocity(self, times) -> np.ndarray:
        """Velocities (…, 2) [m/s] of the ground, which is at rest before the first time, at times (…) [s]: the integral
        of the straight pieces, exact but for rounding.
        """
        k, since, slope = self._pieces(_times(times))
        a, v, _ = self._nodes
        return v[k] + since * (a[k] + 0.5 * since * slope)

    def displacement(self, times) -> np.ndarray:
        """Displacements (…, 2) [m] of the ground at times (…) [s], in the same way. After the last time the ground goes
        on with the velocity that it has then.
        """
        times = _times(times)
        k, since, slope = self._pieces(times)
        a, v, d = self._nodes
        after = np.maximum(times - self.times[-1], 0.0)[..., None]
        return d[k] + since * (v[k] + since * (a[k] / 2 + since * slope / 6)) + after * v[-1]

    def mean_over(self, begin, end) -> np.ndarray:
        """Mean accelerations (…, 2) [m/s²] over steps from ``begin`` to ``end`` (…) [s]. Steps that follow each other
        and cover the record add up to its integral, whatever their lengths: sum of mean times length.

        Raises GroundMotionError for a step that does not end after its beginning.
        """
        begin, end = _times(begin, "begin"), _times(end, "end")
        if not np.all(end > begin):
            raise GroundMotionError(
                f"begin {checks.shown(begin.tolist())}, end {checks.shown(end.tolist())}: give steps that end after "
                "they begin"
            )
        return (self.velocity(end) - self.velocity(begin)) / (end - begin)[..., None]

    # ---- numbers of the motion --------------------------------------------------------------------------

    @property
    def drift(self) -> Drift:
        """What is left at the end of the record, see :class:`Drift`."""
        _, v, d = self._nodes
        return Drift(tuple(v[-1].tolist()), tuple(d[-1].tolist()))

    def peak_acceleration(self, component="horizontal") -> float:
        """The largest acceleration to either side (PGA) [m/s²] of the ``component``, "horizontal" or "vertical"."""
        return float(np.abs(self._of(component)).max())

    def peak_velocity(self, component="horizontal") -> float:
        """The largest velocity to either side (PGV) [m/s], also where it lies between two times."""
        a, t = self._of(component), self.times
        turns = np.flatnonzero(a[:-1] * a[1:] < 0)
        between = t[turns] + (t[turns + 1] - t[turns]) * a[turns] / (a[turns] - a[turns + 1])
        return float(np.abs(self.velocity(np.r_[t, between])[:, COMPONENTS.index(component)]).max())

    def arias_intensity(self, component="horizontal") -> float:
        """π/(2 g) ∫ a² dt [m/s], with the standard g (Arias 1970); exact for the straight pieces."""
        return math.pi / (2 * STANDARD_GRAVITY) * float(self._squares(self._of(component)).sum())

    def significant_duration(self, component="horizontal") -> float:
        """The time [s] in which the integral of a² grows from 5 to 95 % of its end (Trifunac and Brady 1975); 0 for a
        component that is zero.
        """
        a = self._of(component)
        total = np.r_[0.0, np.cumsum(self._squares(a))]
        if total[-1] == 0:
            return 0.0
        return self._reaches(a, total, 0.95) - self._reaches(a, total, 0.05)

    def _squares(self, a):
        """∫ a² dt of each straight piece, (n − 1,)."""
        return np.diff(self.times) * (a[:-1] ** 2 + a[:-1] * a[1:] + a[1:] ** 2) / 3

    def _reaches(self, a, total, share):
        """The time at which the integral of a², ``total`` at the times, reaches a share of its end."""
        from scipy.optimize import brentq  # slow to import, and a run of a slope asks for no duration

        wanted = share * total[-1]
        k = int(np.searchsorted(total, wanted, side="right")) - 1
        length, slope = self.times[k + 1] - self.times[k], a[k + 1] - a[k]

        def lacks(part):
            ahead = a[k] + part * slope
            return total[k] + part * length * (a[k] ** 2 + a[k] * ahead + ahead**2) / 3 - wanted

        begin, end = lacks(0.0), lacks(1.0)
        part = 0.0 if begin >= 0 else 1.0 if end <= 0 else brentq(lacks, 0.0, 1.0, xtol=1e-14)
        return float(self.times[k] + part * length)

    def _of(self, component):
        if component not in COMPONENTS:
            raise GroundMotionError(f"component {checks.shown(component)}: give one of {', '.join(COMPONENTS)}")
        return getattr(self, component)

    def describe(self) -> str:
        """Name, source, length, peaks, intensity and drift, in some lines."""
        lines = [
            f"{self.name} ({self.source})",
            f"{len(self.times)} values over {self.duration:g} s, from {self.times[0]:g} s on",
        ]
        for k, name in enumerate(COMPONENTS):
            if not self._of(name).any():
                lines.append(f"{name}: none")
                continue
            peak = self.peak_acceleration(name)
            lines.append(
                f"{name}: PGA {peak:.4g} m/s² ({peak / STANDARD_GRAVITY:.3g} g), PGV {self.peak_velocity(name):.4g} "
                f"m/s, Arias intensity {self.arias_intensity(name):.4g} m/s, 5 to 95 % of it in "
                f"{self.significant_duration(name):.4g} s"
            )
            lines.append(
                f"{name}, left at the end of the record: velocity {self.drift.velocity[k]:.4g} m/s, displacement "
                f"{self.drift.displacement[k]:.4g} m"
            )
        return "\n".join(lines)

    # ---- other motions, each made by a call that says so ------------------------------------------------

    def scaled(self, peak=None, factor=None) -> GroundMotion:
        """The motion times a ``factor``, or so that the largest horizontal acceleration is ``peak`` [m/s²], above 0;
        both components by the same factor. Raises GroundMotionError for anything else.
        """
        if (peak is None) == (factor is None):
            raise GroundMotionError(
                f"peak {checks.shown(peak)}, factor {checks.shown(factor)}: give one, a peak in m/s² or a factor"
            )
        if peak is not None:
            peak = checks.number("peak", peak, GroundMotionError, "give an acceleration above 0 in m/s²", above=0)
            if not self.horizontal.any():
                raise GroundMotionError(f"peak {peak:g}: the horizontal motion is zero; give a factor")
            by = peak / self.peak_acceleration()
        else:
            by = checks.number("factor", factor, GroundMotionError, "give a number above 0", above=0)
        return self._changed(f"times {by:.6g}", horizontal=by * self.horizontal, vertical=by * self.vertical)

    def reversed(self) -> GroundMotion:
        """The motion seen from the other side: the horizontal component with the other sign, the vertical one as it
        is.
        """
        return self._changed("horizontal component reversed", horizontal=-self.horizontal)

    def along(self, angle) -> GroundMotion:
        """The horizontal component as a motion along a line that rises to the right by ``angle`` [degrees, from −90 to
        90]. Raises GroundMotionError where the vertical component is not zero.
        """
        remedy = "give degrees from -90 to 90, above 0 for a line that rises to the right"
        angle = checks.number("angle", angle, GroundMotionError, remedy, least=-90, most=90)
        if self.vertical.any():
            raise GroundMotionError(
                f"angle {angle:g}: the motion has a vertical component already; give a horizontal motion"
            )
        way = math.radians(angle)
        return self._changed(
            f"along a line at {angle:g} degrees",
            horizontal=math.cos(way) * self.horizontal,
            vertical=math.sin(way) * self.horizontal,
        )

    def starting(self, time) -> GroundMotion:
        """The same motion with its first time at ``time`` [s], as that at which a slope has come to rest."""
        time = checks.number("time", time, GroundMotionError, "give the seconds at which the motion begins")
        return self._changed(f"begins at {time:g} s", times=self.times - self.times[0] + time)

    def stretched(self, factor) -> GroundMotion:
        """The same accelerations, ``factor`` times as slow, a number above 0: all times from the first one on are
        multiplied by it. A similar slope, so many times as large as the square of ``factor``, does the same (Froude).
        """
        factor = checks.number("factor", factor, GroundMotionError, "give a number above 0", above=0)
        first = self.times[0]
        return self._changed(f"{factor:.6g} times as slow", times=first + factor * (self.times - first))

    def resampled(self, step) -> GroundMotion:
        """The values of the straight pieces at equal steps [s] from the first time on, and at the last time. Peaks
        between the new times are lost, and the integral changes: compare :attr:`drift`. Raises GroundMotionError for a
        step that is longer than the record, or makes more than ten million values.
        """
        least, most = 1e-7 * self.duration, self.duration
        remedy = f"give seconds, from {least:g} to {most:g}"
        step = checks.number("step", step, GroundMotionError, remedy, least=least, most=most)
        begin, end = float(self.times[0]), float(self.times[-1])
        times = begin + step * np.arange(math.ceil(self.duration / step - 1e-9))
        times = np.r_[times, end]
        h, v = self.acceleration(times).T
        return self._changed(f"resampled at {step:g} s", times=times, horizontal=h, vertical=v)

    def corrected(self, baseline) -> GroundMotion:
        """The motion with a baseline taken from each component of the acceleration over the length of the record.
        "constant": its mean, so that the ground has no velocity at the end. "line": the straight line with which it
        has neither velocity nor displacement at the end; this takes away what a fault has moved for good, too. Raises
        GroundMotionError for another baseline.
        """
        if baseline not in [*BASELINES]:
            raise GroundMotionError(f"baseline {checks.shown(baseline)}: give one of {', '.join(BASELINES)}")
        _, v, d = self._nodes
        length = self.duration
        since = (self.times - self.times[0])[:, None]
        constant, slope = v[-1] / length, np.zeros(2)
        if baseline == "line":  # c + s t, with ∫ = velocity and ∫∫ = displacement at the end
            slope = 12 * (0.5 * v[-1] * length - d[-1]) / length**3
            constant = v[-1] / length - 0.5 * slope * length
        h, u = (self._nodes[0] - constant - slope * since).T
        told = f"{baseline} taken from it, with {BASELINES[baseline]} at the end"
        return self._changed(told, horizontal=h, vertical=u)

    def _changed(self, what, **parts):
        return replace(self, source=f"{self.source}; {what}", **parts)


def _column(name, value):
    """A value as an array (n,) of floats that nobody changes."""
    try:
        found = np.asarray(value)
    except ValueError:  # lists of several lengths
        found = np.empty((0, 0))
    if found.ndim != 1 or found.dtype.kind not in "iuf":
        raise GroundMotionError(f"{name} {checks.shown(value)}: give numbers, a list or an array of shape (n,)")
    found = np.array(found, float)
    found.setflags(write=False)
    return found


def _times(value, name="times"):
    """Times that a motion is asked for, an array of any shape; GroundMotionError for what is none."""
    try:
        found = np.asarray(value)
    except ValueError:
        found = np.empty(0, object)
    if found.dtype.kind not in "iuf" or not np.isfinite(found).all():
        raise GroundMotionError(f"{name} {checks.shown(value)}: give seconds, finite numbers")
    return found.astype(float)
