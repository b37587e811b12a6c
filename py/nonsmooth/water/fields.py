"""Pore pressure in the plane and in time, as plain data: on the nodes of triangles, or below a phreatic line.

Both kinds of field answer the same questions, ``pressure(points, time)`` and ``gradient(points, time)``. Between two
states a pressure, or the height of a line, is linear in time; before the first and after the last it stays. Where the
pressure is not above 0 the ground is dry: there is no pressure and no gradient. What lies outside a field is refused,
or dry where the caller says so.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..system import checks
from .error import WaterError
from .mesh import Mesh, array

__all__ = ["FieldError", "MeshField", "PhreaticLine", "UNIT_WEIGHT", "of_seepage", "state_at"]

UNIT_WEIGHT = 9810.0  # γ_w [N/m³]
OUTSIDE = ("refuse", "dry")


class FieldError(WaterError):
    """A field of pore pressure that cannot be made, or that is asked where it is not known."""


@dataclass(frozen=True, eq=False)
class MeshField:
    """Pore pressures at the nodes of a mesh, linear in its triangles.

    ``mesh``: a :class:`~nonsmooth.water.mesh.Mesh`; ``times``: of the states [s], rising, (t,); ``pressures`` [Pa], (t,
    n); below 0 in dry ground, so that the free surface lies where they pass through 0, within a triangle and between
    two times. Raises FieldError for other shapes, times that do not rise, and pressures that are not finite.
    """

    mesh: Mesh
    times: np.ndarray
    pressures: np.ndarray

    def __post_init__(self):
        if not isinstance(self.mesh, Mesh):
            raise FieldError(f"mesh {checks.shown(self.mesh)}: give a Mesh, as mesh.grid(...) makes one")
        times = _times(self.times)
        try:
            pressures = np.array(self.pressures, float)
        except (TypeError, ValueError):
            pressures = np.zeros(0)
        expected = (len(times), len(self.mesh.nodes))
        if pressures.shape != expected:
            raise FieldError(
                f"pressures of shape {pressures.shape}: give {expected}, a pressure [Pa] at each time for each node"
            )
        bad = np.argwhere(~np.isfinite(pressures))
        if len(bad):
            (k, n), (x, y) = bad[0], self.mesh.nodes[bad[0, 1]]
            raise FieldError(
                f"pressure {pressures[k, n]:g} Pa at ({x:.6g}, {y:.6g}) m, t = {times[k]:g} s: give finite "
                "pressures, below 0 where it is dry"
            )
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "pressures", pressures)

    def at(self, time) -> np.ndarray:
        """Pressures [Pa] at the nodes at a time [s], (n,), below 0 in dry ground."""
        first, share = state_at(self.times, time)
        return _between(self.pressures, first, share)

    def pressure(self, points, time=0.0, outside="refuse") -> np.ndarray:
        """Pressures [Pa] at ``points`` (k, 2) [m] and a ``time`` [s], (k,).

        ``outside``: "refuse" raises FieldError for a point outside the mesh, "dry" gives 0 there.
        """
        points, where = self._located(points, outside)
        return np.where(where >= 0, np.maximum(self.mesh.at(self.at(time), points, where), 0.0), 0.0)

    def gradient(self, points, time=0.0, outside="refuse") -> np.ndarray:
        """∇p [Pa/m] at ``points`` (k, 2) [m], that of the triangle in which each lies, 0 where it is dry, (k, 2);
        ``outside``: as of :meth:`pressure`.
        """
        points, where = self._located(points, outside)
        values = self.at(time)
        wet = (where >= 0) & (self.mesh.at(values, points, where) > 0)
        return np.where(wet[:, None], self.mesh.gradient(values)[where], 0.0)

    def gradients(self, time=0.0) -> np.ndarray:
        """∇p [Pa/m] of all triangles at a ``time`` [s], (m, 2), as if none were dry."""
        return self.mesh.gradient(self.at(time))

    def require(self, points, what="points"):
        """Raises FieldError where one of ``points`` (k, 2) [m] lies outside the mesh; ``what`` they are, for the
        message.
        """
        points = array(what, points, 2, FieldError)
        out = np.flatnonzero(self.mesh.locate(points) < 0)
        if len(out):
            x, y = points[out[0]]
            box = ", ".join(f"{v:.6g}" for v in self.mesh.bounds)
            raise FieldError(
                f"{what}: {len(out)} of {len(points)} lie outside the mesh of the water, the first at "
                f"({x:.6g}, {y:.6g}) m; give a mesh that covers them (this one lies within {box}), or let them be "
                "dry (outside='dry')"
            )

    def _located(self, points, outside):
        _ask(outside)
        points = array("points", points, 2, FieldError)
        if outside == "refuse":
            self.require(points)
        return points, self.mesh.locate(points)


@dataclass(frozen=True, eq=False)
class PhreaticLine:
    """Pore pressure below a phreatic line, one state or several in time.

    ``lines``: of each state, vertices (k, 2) [m] from left to right; ``times``: of the states [s], rising; between two
    states the height is linear in time, whatever vertices they have. ``unit_weight``: γ_w [N/m³]. ``along``: how water
    flows below the line. False: sideways, so that p = γ_w (Y − y), of a height Y(x); in still water, where the line is
    level, this is exact. True: along the line, as down a long slope, so that p = γ_w (Y − y) cos²α, of the line's slope
    α at x.

    Raises FieldError for a line of fewer than two points, one that is not single-valued (x must rise), and for times
    that do not rise.
    """

    lines: tuple
    times: np.ndarray = (0.0,)
    unit_weight: float = UNIT_WEIGHT
    along: bool = False

    def __post_init__(self):
        times, lines = _times(self.times), []
        if isinstance(self.lines, np.ndarray) and self.lines.ndim == 2:
            raise FieldError("lines: one line was given; give a list of lines, one for each time")
        if len(self.lines) != len(times):
            raise FieldError(f"lines: {len(self.lines)} were given for {len(times)} times; give one line for each time")
        for k, given in enumerate(self.lines):
            line = array(f"lines[{k}]", given, 2, FieldError)
            if len(line) < 2:
                raise FieldError(f"lines[{k}] {checks.shown(given)}: give two points or more [m]")
            back = np.flatnonzero(np.diff(line[:, 0]) <= 0)
            if len(back):
                a, b = line[back[0], 0], line[back[0] + 1, 0]
                raise FieldError(
                    f"lines[{k}] goes from x = {a:.6g} to x = {b:.6g} m: give points with rising x, so that "
                    "each x has one height"
                )
            lines.append(line)
        checks.number("unit_weight", self.unit_weight, FieldError, "give a number above 0 [N/m³]", above=0)
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "lines", tuple(lines))

    def heights(self, x, time=0.0, outside="refuse"):
        """Height Y [m] of the line at ``x`` (k,) [m] and a ``time`` [s], and its slope dY/dx there, both (k,).

        At a vertex the slope is that of the piece on the right. ``outside``: "refuse" raises FieldError for an x beyond
        the ends of the line, "dry" gives NaN and 0.
        """
        _ask(outside)
        x = np.asarray(x, float).ravel()
        first, share = state_at(self.times, time)
        states = [self.lines[first]] + ([self.lines[first + 1]] if share else [])
        low, high = max(s[0, 0] for s in states), min(s[-1, 0] for s in states)
        out = ~((x >= low) & (x <= high))
        if outside == "refuse" and out.any():
            k = int(np.argmax(out))
            raise FieldError(
                f"x = {x[k]:.6g} m lies beyond the phreatic line, which goes from {low:.6g} to {high:.6g} m at "
                f"t = {time:g} s; give a longer line, or let it be dry (outside='dry')"
            )
        both = []
        for line in states:
            piece = np.clip(np.searchsorted(line[:, 0], x, side="right") - 1, 0, len(line) - 2)
            slope = (np.diff(line[:, 1]) / np.diff(line[:, 0]))[piece]
            both.append((line[piece, 1] + slope * (x - line[piece, 0]), slope))
        height, slope = (_between(np.array(part), 0, share) for part in zip(*both))
        return np.where(out, np.nan, height), np.where(out, 0.0, slope)

    def pressure(self, points, time=0.0, outside="refuse") -> np.ndarray:
        """Pressures [Pa] at ``points`` (k, 2) [m] and a ``time`` [s], (k,); ``outside``: as of :meth:`heights`."""
        deep, slope = self._below(points, time, outside)
        return self._weight(slope) * np.fmax(deep, 0.0)

    def gradient(self, points, time=0.0, outside="refuse") -> np.ndarray:
        """∇p [Pa/m] at ``points`` (k, 2) [m] and a ``time`` [s], (k, 2), 0 above the line; ``outside``: as of
        :meth:`heights`.
        """
        deep, slope = self._below(points, time, outside)
        grow = self._weight(slope)[:, None] * np.column_stack((slope, np.full(len(slope), -1.0)))
        return np.where(deep[:, None] > 0, grow, 0.0)

    def on(self, mesh, outside="refuse") -> MeshField:
        """The same as a :class:`MeshField`, its pressures at the nodes of a ``mesh``: exact for a straight line, and
        near the vertices of others to the length of an edge.
        """
        pressures = []
        for time in self.times:
            deep, slope = self._below(mesh.nodes, time, outside)
            pressures.append(self._weight(slope) * np.nan_to_num(deep, nan=0.0))
        return MeshField(mesh, self.times, pressures)

    def _below(self, points, time, outside):
        points = array("points", points, 2, FieldError)
        height, slope = self.heights(points[:, 0], time, outside)
        return height - points[:, 1], slope

    def _weight(self, slope):
        return self.unit_weight / (1 + np.square(slope) if self.along else np.ones(len(slope)))


def of_seepage(results, times=(0.0,), unit_weight=UNIT_WEIGHT) -> MeshField:
    """The field of one :class:`~nonsmooth.water.seepage.Seepage`, or of a list of them, on one mesh, at ``times`` [s].

    Raises FieldError for results on several meshes, and as :class:`MeshField`.
    """
    results = list(results) if isinstance(results, (list, tuple)) else [results]
    if not results or any(one.mesh is not results[0].mesh for one in results):
        raise FieldError(f"{len(results)} results: give one or more on the same mesh")
    return MeshField(results[0].mesh, times, [unit_weight * one.pressure_head for one in results])


def state_at(times, time):
    """The state before a ``time`` [s], and the share of the way to the next one: its number, and a number from 0 to
    below 1. Raises FieldError for a time that is no finite number.
    """
    time = checks.number("time", time, FieldError, "give a finite number [s]")
    if time <= times[0]:
        return 0, 0.0
    if time >= times[-1]:
        return len(times) - 1, 0.0
    first = int(np.searchsorted(times, time, side="right")) - 1
    return first, float((time - times[first]) / (times[first + 1] - times[first]))


def _between(states, first, share):
    return states[first] if share == 0 else states[first] + share * (states[first + 1] - states[first])


def _times(values):
    times = np.array(checks.numbers_of("times", values, FieldError, "give one or more finite numbers [s]"))
    falls = np.flatnonzero(np.diff(times) <= 0)
    if len(falls):
        k = int(falls[0])
        raise FieldError(f"times[{k}] = {times[k]:g} and times[{k + 1}] = {times[k + 1]:g}: times must rise")
    return times


def _ask(outside):
    if outside not in OUTSIDE:
        raise FieldError(f"outside {checks.shown(outside)}: give 'refuse' or 'dry'")
