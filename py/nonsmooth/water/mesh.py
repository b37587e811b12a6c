"""Meshes of triangles in the plane, those of grids, and where a point lies in one. Polygons are meshed by
:mod:`~nonsmooth.water.mesher`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..model import geometry
from ..system import checks
from .error import WaterError

__all__ = ["Mesh", "MeshError", "array", "grid"]

CLOSE = 1e-6  # of a mesh's size: points nearer than this are one, as in a section
FLAT = 1e-12  # of its longest side squared: a triangle with a smaller area has none


class MeshError(WaterError):
    """A mesh that cannot be made or used."""


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles in the plane.

    ``nodes``: places (n, 2) [m]; ``triangles``: three node numbers each, counter-clockwise, (m, 3); ``layer``: the
    number of the polygon that each lies in, (m,); ``names``: of these polygons. :meth:`of` makes one of arrays and
    checks it.
    """

    nodes: np.ndarray
    triangles: np.ndarray
    layer: np.ndarray
    names: tuple[str, ...] = ()

    @classmethod
    def of(cls, nodes, triangles, layer=None, names=()) -> Mesh:
        """A mesh of nodes (n, 2) [m] and triangles (m, 3), checked.

        Clockwise triangles are turned, and nodes that no triangle has are left out. ``layer``: (m,), 0 for all where
        it is None. Raises MeshError for other shapes, numbers that are not finite, nodes that are not there, and
        triangles without an area.
        """
        nodes, triangles = array("nodes", nodes, 2), array("triangles", triangles, 3, whole=True)
        layer = np.zeros(len(triangles), int) if layer is None else np.asarray(layer)
        if layer.shape != (len(triangles),) or not np.issubdtype(layer.dtype, np.integer):
            raise MeshError(f"layer of shape {layer.shape}: give a whole number for each of {len(triangles)} triangles")
        bad = np.argwhere((triangles < 0) | (triangles >= len(nodes)))
        if len(bad):
            raise MeshError(
                f"triangle {bad[0, 0]} has the node {triangles[tuple(bad[0])]}: give numbers from 0 to {len(nodes) - 1}"
            )
        double = _double_areas(nodes, triangles)
        side = nodes[triangles] - nodes[triangles[:, [1, 2, 0]]]
        flat = np.flatnonzero(np.abs(double) <= FLAT * np.square(side).sum(axis=-1).max(axis=1))
        if len(flat):
            x, y = nodes[triangles[flat[0], 0]]
            raise MeshError(f"triangle {flat[0]} at ({x:.6g}, {y:.6g}) m has no area: remove it, or mend its nodes")
        used, renumbered = np.unique(triangles, return_inverse=True)
        triangles = renumbered.reshape(triangles.shape)
        triangles = np.where(double[:, None] < 0, triangles[:, [0, 2, 1]], triangles)
        return cls(nodes[used], triangles, layer.astype(int), tuple(map(str, names)))

    @cached_property
    def area(self) -> np.ndarray:
        """Area of each triangle [m²], (m,)."""
        return 0.5 * _double_areas(self.nodes, self.triangles)

    @cached_property
    def shape_gradients(self) -> np.ndarray:
        """Gradients of the three linear shape functions of each triangle [1/m], (m, 3, 2)."""
        corner = self.nodes[self.triangles]
        opposite = corner[:, [2, 0, 1]] - corner[:, [1, 2, 0]]
        return np.stack((-opposite[..., 1], opposite[..., 0]), axis=-1) / (2 * self.area[:, None, None])

    @cached_property
    def border(self) -> np.ndarray:
        """Edges that one triangle alone has, node numbers (k, 2), the body on their left, in the triangles' order."""
        edge = self.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
        key = np.sort(edge, axis=1)
        _, first, count = np.unique(key[:, 0] * len(self.nodes) + key[:, 1], return_index=True, return_counts=True)
        return edge[np.sort(first[count == 1])]

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """The smallest box: (x_min, y_min, x_max, y_max) [m]."""
        return (*map(float, self.nodes.min(axis=0)), *map(float, self.nodes.max(axis=0)))

    @property
    def tolerance(self) -> float:
        """Distance [m] below which two points are one."""
        return CLOSE * math.dist(self.bounds[:2], self.bounds[2:])

    def gradient(self, values) -> np.ndarray:
        """Gradient in each triangle, (…, m, 2), of values at the nodes, (…, n)."""
        return np.einsum("...mk,mkd->...md", np.asarray(values)[..., self.triangles], self.shape_gradients)

    def border_on(self, line) -> np.ndarray:
        """Numbers of the border's edges that lie on a polyline (k, 2) [m], within :attr:`tolerance`."""
        ends = self.nodes[self.border]
        where = np.vstack((ends[:, 0], ends[:, 1], ends.mean(axis=1)))
        away, _, _ = geometry.nearest(where, *geometry.pieces([line]))
        return np.flatnonzero((away.reshape(3, -1) <= self.tolerance).all(axis=0))

    def locate(self, points) -> np.ndarray:
        """The triangle in which each of ``points`` (k, 2) [m] lies, (k,); −1 for those outside the mesh.

        A point on an edge, or outside by less than rounding, belongs to the triangle in which it lies deepest, the
        first of equals.
        """
        points = np.asarray(points, float).reshape(-1, 2)
        first, listed = self._cells
        x0, y0, wide, count = self._raster
        cell = np.floor((points - (x0, y0)) / wide).astype(int)
        inside = ((cell >= 0) & (cell <= count)).all(axis=1)
        number = np.where(
            inside, np.minimum(cell[:, 0], count[0] - 1) * count[1] + np.minimum(cell[:, 1], count[1] - 1), 0
        )
        held = np.where(inside, first[number + 1] - first[number], 0)
        who = np.repeat(np.arange(len(points)), held)
        offset = np.arange(len(who)) - np.repeat(np.cumsum(held) - held, held)
        where = listed[np.repeat(first[number], held) + offset]
        deep = self._shares(points[who], where).min(axis=1)
        found = np.full(len(points), -1)
        order = np.lexsort((where, -deep, who))
        order = order[deep[order] >= -1e-9]
        mine, begin = np.unique(who[order], return_index=True)
        found[mine] = where[order[begin]]
        return found

    def at(self, values, points, where) -> np.ndarray:
        """Values (…, n) at the nodes, interpolated at points (k, 2) [m] that lie in the triangles ``where`` (k,)."""
        return np.sum(np.asarray(values)[..., self.triangles[where]] * self._shares(points, where), axis=-1)

    def _shares(self, points, where):
        """Values of the three shape functions, (k, 3)."""
        corner = self.nodes[self.triangles[where]]
        off = np.asarray(points)[:, None, :] - corner[:, [1, 2, 0]]
        return np.sum(self.shape_gradients[where] * off, axis=-1)

    @cached_property
    def _raster(self):
        """A grid of boxes of a triangle's size: its origin x and y, the boxes' width and height, and their counts."""
        low, high = self.nodes.min(axis=0), self.nodes.max(axis=0)
        count = np.maximum(1, np.rint((high - low) / math.sqrt(2 * float(np.mean(self.area))))).astype(int)
        return low[0], low[1], (high - low) / count, count

    @cached_property
    def _cells(self):
        """Triangles by the boxes of :attr:`_raster` that they may touch: where each box begins, and the list."""
        x0, y0, wide, count = self._raster
        corner = (self.nodes[self.triangles] - (x0, y0)) / wide
        low = np.clip(np.floor(corner.min(axis=1) - 1e-6).astype(int), 0, count - 1)
        high = np.clip(np.floor(corner.max(axis=1) + 1e-6).astype(int), 0, count - 1)
        spread = high - low + 1
        held = spread.prod(axis=1)
        who = np.repeat(np.arange(len(held)), held)
        offset = np.arange(len(who)) - np.repeat(np.cumsum(held) - held, held)
        box = (low[who, 0] + offset // spread[who, 1]) * count[1] + low[who, 1] + offset % spread[who, 1]
        order = np.argsort(box, kind="stable")
        first = np.searchsorted(box[order], np.arange(count.prod() + 1))
        return first, who[order]


def grid(x, y) -> Mesh:
    """The mesh of a grid with lines at ``x`` and ``y`` [m], both rising: node ``j len(x) + i`` is (x[i], y[j]).

    Each rectangle is cut along one diagonal, neighbours along the other one, so that an even number of rectangles side
    by side is its own mirror image. Raises MeshError for lines that do not rise.
    """
    lines = []
    for name, values in (("x", x), ("y", y)):
        line = np.array(checks.numbers_of(name, values, MeshError, "give two or more finite numbers [m]", least=2))
        falls = np.flatnonzero(np.diff(line) <= 0)
        if len(falls):
            k = falls[0]
            raise MeshError(
                f"{name}[{k}] = {line[k]:g} and {name}[{k + 1}] = {line[k + 1]:g}: lines of a grid must rise"
            )
        lines.append(line)
    x, y = lines
    i, j = (a.ravel() for a in np.meshgrid(np.arange(len(x) - 1), np.arange(len(y) - 1)))
    a = j * len(x) + i
    b, c, d = a + 1, a + len(x) + 1, a + len(x)
    rising = ((i + j) % 2 == 0)[:, None]  # the diagonal
    below = np.where(rising, np.column_stack((a, b, c)), np.column_stack((a, b, d)))
    above = np.where(rising, np.column_stack((a, c, d)), np.column_stack((b, c, d)))
    return Mesh.of(np.column_stack([v.ravel() for v in np.meshgrid(x, y)]), np.vstack((below, above)))


def _double_areas(nodes, triangles):
    a, b, c = (nodes[triangles[:, k]] for k in range(3))
    return (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (c[:, 0] - a[:, 0]) * (b[:, 1] - a[:, 1])


def array(name, values, width, error=MeshError, whole=False):
    """The ``values`` as an array (n, width) of finite numbers, n of 1 or more, or of ``whole`` ones; raises ``error``
    with the name, the value and what would do where they are none.
    """
    try:
        found = np.asarray(values) if whole else np.asarray(values, float)
    except (TypeError, ValueError):
        found = np.zeros(0)
    if found.ndim != 2 or found.shape[1] != width or not len(found) or whole and found.dtype.kind not in "iu":
        raise error(f"{name} {checks.shown(values)}: give {'whole ' * whole}numbers of shape (n, {width})")
    bad = np.flatnonzero(~np.isfinite(found).all(axis=1))
    if len(bad):
        raise error(f"{name}[{bad[0]}] {found[bad[0]].tolist()}: give finite numbers")
    return found
