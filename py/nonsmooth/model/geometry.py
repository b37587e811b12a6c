"""Plane geometry of a section: polygons and polylines, in metres, x to the right and y up.

Shapely (1.8 of Debian 12 and 2.x of Debian 13) does the work; here is only what it has no
name for. Vertices are arrays or tuples of shape (n, 2); a polygon is not closed by repeating
its first vertex.

What a packing depends on has the same bits with every version of Shapely, GEOS and the C library: places come from the
given vertices, lengths from square roots (`hypot` is not specified to the last bit), sums from `fsum`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from shapely.geometry import LineString, MultiPolygon, Point, Polygon
from shapely.geometry.polygon import orient
from shapely.ops import linemerge, unary_union
from shapely.validation import explain_validity

__all__ = [
    "Edges",
    "area",
    "area_inside",
    "border",
    "distance",
    "edges",
    "invalid_reason",
    "nearest",
    "outline",
    "parts",
    "pieces",
    "sides",
    "straight",
    "uncovered",
]


def invalid_reason(vertices) -> str | None:
    """Why `vertices` (n, 2) are no simple polygon with an area, or None when they are one."""
    polygon = Polygon(vertices)
    if not polygon.is_valid:
        return explain_validity(polygon).replace("[", " at (").replace("]", ")").replace("Ring ", "")
    return None if polygon.area > 0 else "it has no area"


def parts(shape) -> list[Polygon]:
    """The polygons of a shapely shape, counter-clockwise with clockwise holes; lines are dropped."""
    if isinstance(shape, Polygon):
        return [] if shape.is_empty else [orient(shape, 1.0)]
    return [p for part in getattr(shape, "geoms", ()) for p in parts(part)]


def distance(x, y):
    """√(x² + y²) of arrays."""
    return np.sqrt(np.square(x) + np.square(y))


def pieces(polylines):
    """Starts and ends of the pieces of polylines, each of vertices (n, 2): two arrays (m, 2)."""
    lines = [np.asarray(p, float) for p in polylines]
    return np.concatenate([p[:-1] for p in lines]), np.concatenate([p[1:] for p in lines])


def nearest(points, start, end):
    """Distance [m] of points (n, 2) from the nearest of segments, the vector from there to the point, (n, 2), and the
    segment's number.
    """
    least, way, which = np.full(len(points), np.inf), np.zeros((len(points), 2)), np.zeros(len(points), int)
    for k, (a, b) in enumerate(zip(start, end)):
        along = b - a
        share = np.clip(np.sum((points - a) * along, axis=1) / np.sum(along * along), 0, 1)
        off = points - a - share[:, None] * along
        away = distance(*off.T)
        nearer = away < least
        least[nearer], way[nearer], which[nearer] = away[nearer], off[nearer], k
    return least, way, which


def area(vertices) -> float:
    """Area [m²] of a simple polygon, vertices (n, 2)."""
    v = np.asarray(vertices, float)
    w = np.roll(v, -1, axis=0)
    return 0.5 * abs(math.fsum((v[:, 0] * w[:, 1]).tolist() + (-v[:, 1] * w[:, 0]).tolist()))


def outline(polygons, tolerance: float) -> MultiPolygon:
    """Union of `polygons` (shapely, [m]), slits narrower than `tolerance` [m] closed, without idle vertices.

    Versions of GEOS begin rings elsewhere, differ in last bits, and simplify differently. So a vertex that lies within
    3 `tolerance` of one of the polygons' own is that one, others are rounded to `tolerance`/64, every ring begins at
    its leftmost, lowest vertex, and from there on vertices go that lie within 2 `tolerance` of the line through their
    neighbours.
    """
    closed = unary_union([p.buffer(tolerance, join_style=2) for p in polygons])
    closed = closed.buffer(-tolerance, join_style=2)
    given = np.array(
        sorted({tuple(v[:2]) for p in polygons for ring in (p.exterior, *p.interiors) for v in ring.coords})
    )
    exact = [
        Polygon(_exact(p.exterior, given, tolerance), sorted(_exact(hole, given, tolerance) for hole in p.interiors))
        for p in parts(closed)
    ]
    return MultiPolygon(sorted(exact, key=lambda p: list(p.exterior.coords)))


def _exact(ring, given, tolerance):
    """Vertices (tuples) of a ring, moved to those `given` (n, 2) or to a grid, from the leftmost on."""
    found = []
    for v in np.asarray(ring.coords)[:-1, :2]:
        away = distance(*(given - v).T)
        nearest = int(np.argmin(away))
        grid = tolerance / 64
        place = (
            tuple(given[nearest].tolist())
            if away[nearest] <= 3 * tolerance
            else tuple((np.rint(v / grid) * grid).tolist())
        )
        if place not in (found[-1:] + found[:1]):
            found.append(place)
    first = found.index(min(found))
    found, k = found[first:] + found[:first], 1
    while k < len(found) and len(found) > 3:
        if straight((found[k - 1], found[k], found[(k + 1) % len(found)]), 2 * tolerance):
            del found[k]
        else:
            k += 1
    return found


def border(one: Polygon, other: Polygon, tolerance: float) -> np.ndarray:
    """The longest stretch along which the rims of two polygons run together, from left to right, (n, 2) [m]; empty
    where there is none.
    """
    longest = LineString()
    for rim in (other.exterior, other.exterior.buffer(3 * tolerance)):  # by equal vertices, or nearly so
        common = one.exterior.intersection(rim)
        pieces = [g for g in getattr(common, "geoms", [common]) if g.geom_type == "LineString" and not g.is_empty]
        merged = linemerge(pieces) if len(pieces) > 1 else (pieces or [longest])[0]
        longest = max(
            (g for g in getattr(merged, "geoms", [merged]) if g.length > 10 * tolerance),
            key=lambda g: g.length,
            default=longest,
        )
        if not longest.is_empty:
            break
    if longest.is_empty:
        return np.zeros((0, 2))
    points = np.asarray(longest.simplify(2 * tolerance).coords)[:, :2]
    return points if points[0, 0] <= points[-1, 0] else points[::-1]


def straight(vertices, tolerance: float) -> bool:
    """Whether every vertex (n, 2) lies within `tolerance` [m] of the line through the ends."""
    v = np.asarray(vertices, float)
    along = v[-1] - v[0]
    length = math.hypot(*along)
    off = v - v[0]
    return length > 0 and bool(np.all(np.abs(off[:, 0] * along[1] - off[:, 1] * along[0]) <= tolerance * length))


def uncovered(region: MultiPolygon, walls, tolerance: float, slope: float = 0.02):
    """First piece of `region`'s underside that none of `walls` (polylines) supports, or None.

    The underside is every edge whose outward normal points down by more than `slope` (sine of
    the angle): a vertical face is a free face. Returns ((x0, y0), (x1, y1)) [m].
    """
    cover = unary_union([LineString(w).buffer(3 * tolerance) for w in walls])
    table = edges(region)
    for start, direction, length in zip(table.start, table.direction, table.length):
        if direction[0] <= slope:  # the inside is on the left, so the underside runs to the right
            continue
        left = LineString([start, start + length * direction]).difference(cover)
        pieces = [g for g in getattr(left, "geoms", [left]) if g.length > 10 * tolerance]
        if pieces:
            return tuple(pieces[0].coords[0][:2]), tuple(pieces[0].coords[-1][:2])
    return None


@dataclass(frozen=True)
class Edges:
    """Edges of a region with its inside on their left; arrays of length n or shape (n, 2).

    `convex_start`, `convex_end`: whether the region's angle at that vertex is below 180 degrees.
    """

    start: np.ndarray
    direction: np.ndarray
    length: np.ndarray
    convex_start: np.ndarray
    convex_end: np.ndarray

    @property
    def normal(self) -> np.ndarray:
        """Unit normals into the region, (n, 2)."""
        return np.column_stack((-self.direction[:, 1], self.direction[:, 0]))


def edges(region) -> Edges:
    """All boundary edges of a (multi-)polygon, holes included, in a fixed order."""
    start, direction, length, convex_start, convex_end = [], [], [], [], []
    for polygon in parts(region):
        for ring in (polygon.exterior, *polygon.interiors):
            v = np.asarray(ring.coords)[:-1, :2]
            along = np.roll(v, -1, axis=0) - v
            size = distance(along[:, 0], along[:, 1])
            t = along / size[:, None]
            before = np.roll(t, 1, axis=0)
            convex = before[:, 0] * t[:, 1] - before[:, 1] * t[:, 0] >= 0
            start.append(v)
            direction.append(t)
            length.append(size)
            convex_start.append(convex)
            convex_end.append(np.roll(convex, -1))
    return Edges(*(np.concatenate(a) for a in (start, direction, length, convex_start, convex_end)))


def sides(line) -> tuple[Edges, Edges]:
    """Edges of a polyline (n, 2) from left to right, for what lies on its left, above it, and for what lies on its
    right.
    """

    def of(points):
        along = np.diff(points, axis=0)
        size = distance(along[:, 0], along[:, 1])
        t = along / size[:, None]
        turns = t[:-1, 0] * t[1:, 1] - t[:-1, 1] * t[1:, 0] >= 0  # the ends go on straight
        return Edges(points[:-1], t, size, np.concatenate(([True], turns)), np.concatenate((turns, [True])))

    line = np.asarray(line, float)
    return of(line), of(line[::-1])


def area_inside(x, y, r, region) -> float:
    """Area [m²] of the disks (arrays x, y, r [m]) that lies in `region`.

    Disks across the border are cut as 64-gons that stand for the circle's area: relative error
    below 2e-3 of their part, and such disks are few. Overlaps count twice.
    """
    x, y, r = (np.asarray(a, float) for a in (x, y, r))
    total = 0.0
    for polygon in parts(region):
        table = edges(polygon)
        signed = np.full(x.shape, np.inf)
        for start, t, length in zip(table.start, table.direction, table.length):
            dx, dy = x - start[0], y - start[1]
            along = np.clip(dx * t[0] + dy * t[1], 0, length)
            signed = np.minimum(signed, np.hypot(dx - along * t[0], dy - along * t[1]))
        inside = contains(polygon, x, y)
        total += float(np.sum(math.pi * r[inside & (signed >= r)] ** 2))
        for i in np.flatnonzero(signed < r):
            circle = Point(x[i], y[i]).buffer(r[i])
            total += math.pi * r[i] ** 2 * circle.intersection(polygon).area / circle.area
    return total


def contains(polygon: Polygon, x, y) -> np.ndarray:
    """Which points (arrays x, y [m]) lie in `polygon`, by the crossing number; shape of x, bool."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    inside = np.zeros(x.shape, bool)
    for ring in (polygon.exterior, *polygon.interiors):
        v = np.asarray(ring.coords)[:, :2]
        for (xa, ya), (xb, yb) in zip(v[:-1], v[1:]):
            if ya != yb:
                crosses = (ya > y) != (yb > y)
                inside ^= crosses & (x < xa + (y - ya) * (xb - xa) / (yb - ya))
    return inside
