"""The free surface of a section's layers: the part of their outline that no wall holds. Needs no YADE.

A mass of disks without friction that is drawn everywhere along the normal of the nearest free face, into the mass, is
in balance with the surface as it is, whatever its shape: the pull has a potential, the depth below the surface, and the
surface is a level of it. Horizontal ground is the special case that gravity has.
"""

from __future__ import annotations

import numpy as np

from . import geometry

__all__ = ["PRESSED", "faces", "inward", "lifted", "raised"]

PRESSED = 0.011  # of the thickness: what a packing of the shipped density and grading loses where it is pressed


def faces(section) -> geometry.Edges:
    """The free edges of the layers' outline, the mass on their left; those of a ring follow each other as they do
    there. Edges are cut where walls end.
    """
    table, walls = geometry.edges(section.outline), _walls(section)
    reach = 3 * section.tolerance
    found = []
    for k, (a, t, length) in enumerate(zip(table.start, table.direction, table.length)):
        cuts = {0.0, float(length)}
        for end in np.concatenate(walls):
            along = float(_dot(end - a, t))
            if reach < along < length - reach and geometry.distance(*(end - a - along * t)) <= reach:
                cuts.add(along)
        cuts = sorted(cuts)
        for begin, end in zip(cuts, cuts[1:]):
            middle = a + 0.5 * (begin + end) * t
            if geometry.nearest(middle[None, :], *walls)[0][0] > reach:
                found.append((a + begin * t, t, end - begin, bool(table.convex_start[k]), bool(table.convex_end[k])))
    if not found:
        return geometry.Edges(np.zeros((0, 2)), np.zeros((0, 2)), np.zeros(0), np.zeros(0, bool), np.zeros(0, bool))
    return geometry.Edges(*map(np.array, zip(*found)))


def inward(section, x, y):
    """Unit vectors (n, 2) along which the depth grows at points (arrays x, y [m], shape (n,)), and their depths [m]
    below the nearest free face, negative outside the layers.
    """
    free, points = faces(section), np.column_stack((x, y))
    away, way, which = geometry.nearest(points, *_ends(free))
    inside = np.zeros(len(points), bool)
    for polygon in geometry.parts(section.outline):
        inside |= geometry.contains(polygon, *points.T)
    sign = np.where(inside, 1.0, -1.0)
    normal = free.normal[which]
    along = np.sum((points - free.start[which]) * free.direction[which], axis=1)
    beside = (along > 0) & (along < free.length[which]) | (away == 0)
    with np.errstate(invalid="ignore"):
        up = np.where(beside[:, None], normal, (sign / away)[:, None] * way)
    return up, sign * away


def raised(section, share):
    """The layers' outline with its free surface moved outward by a ``share`` of the thickness below it, a shapely
    MultiPolygon.

    The thickness at a vertex is the distance to the walls, along the face's normal, from a point of the face a largest
    diameter away, and no more than the greatest depth of the part that it belongs to; where the surface meets a wall it
    slides along it.
    """
    free, walls, step = _ends(faces(section)), _walls(section), section.largest
    polygons = []
    for polygon in geometry.parts(section.outline):
        table = geometry.edges(polygon)
        middle = table.start + 0.5 * table.length[:, None] * table.direction
        is_free = geometry.nearest(middle, *free)[0] <= 3 * section.tolerance
        rings, first, deepest = [], 0, _greatest_depth(table, free)
        for ring in (polygon.exterior, *polygon.interiors):
            n = len(ring.coords) - 1
            rings.append(
                _moved(
                    table,
                    is_free,
                    first,
                    n,
                    lambda point, way: share * min(deepest, _thickness(point, way, walls)),
                    step,
                )
            )
            first += n
        polygons.append(geometry.Polygon(rings[0], rings[1:]))
    return geometry.MultiPolygon(polygons)


def lifted(section, line, share):
    """A polyline (n, 2) from left to right within the layers, moved up by a ``share`` of the thickness between it and
    the walls below.
    """
    walls, along = _walls(section), np.gradient(line, axis=0)
    up = np.column_stack((-along[:, 1], along[:, 0])) / geometry.distance(*along.T)[:, None]
    return line + up * [[share * _thickness(point, -n, walls)] for point, n in zip(line, up)]


def _greatest_depth(table, free):
    """Of the points of a part's rim below its free surface [m]."""
    shares = np.linspace(0, 1, 9)[:-1, None, None]
    rim = (table.start + shares * table.length[:, None] * table.direction).reshape(-1, 2)
    return float(geometry.nearest(rim, *free)[0].max())


def _moved(table, is_free, first, count, rise, step):
    """Vertices of a ring, edges ``first`` to ``first + count``, each moved so that its free edges go outward by
    ``rise(point, way in)`` of a point ``step`` [m] away.
    """
    moved = []
    for k in range(count):
        edges = [first + (k - 1) % count, first + k]
        vertex, normals = table.start[edges[1]], -table.normal[edges]  # outward
        beside = [sign * min(step, 0.5 * table.length[e]) * table.direction[e] for e, sign in zip(edges, (-1, 1))]
        offsets = [rise(vertex + b, -n) if is_free[e] else 0.0 for e, n, b in zip(edges, normals, beside)]
        turn = normals[0, 0] * normals[1, 1] - normals[0, 1] * normals[1, 0]
        if abs(turn) > 0.05:  # 3°
            (p, q), ((a, b), (c, d)) = offsets, normals
            moved.append(vertex + np.array([p * d - b * q, a * q - p * c]) / turn)
        else:
            moved.append(vertex + max(offsets) * normals[int(np.argmax(offsets))])
    return moved


def _thickness(point, direction, walls):
    """Distance [m] from a point to the first wall in a direction; 0 where there is none."""
    start, end = walls
    along, off = end - start, start - point
    turn = direction[0] * along[:, 1] - direction[1] * along[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        way = (off[:, 0] * along[:, 1] - off[:, 1] * along[:, 0]) / turn
        share = (off[:, 0] * direction[1] - off[:, 1] * direction[0]) / turn
    hit = (np.abs(turn) > 0) & (way > 0) & (share >= -1e-9) & (share <= 1 + 1e-9)
    return float(way[hit].min()) if hit.any() else 0.0


def _dot(points, way):
    """Scalar products of vectors (…, 2) with one (2,); unlike those of BLAS they have the same bits with every
    library.
    """
    return points[..., 0] * way[0] + points[..., 1] * way[1]


def _walls(section):
    """Starts and ends of all pieces of the walls, two arrays (n, 2)."""
    return geometry.pieces([w.points for w in section.walls])


def _ends(table):
    """Starts and ends of edges, two arrays (n, 2)."""
    return table.start, table.start + table.length[:, None] * table.direction
