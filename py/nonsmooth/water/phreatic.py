"""The free surface in triangles: the share of a triangle that is wet, where p = 0 runs, and what a line crosses."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString
from shapely.ops import linemerge

from ..model import geometry

__all__ = ["crossed", "lines", "wet_share"]


def wet_share(pressure_heads):
    """The share of the area of triangles in which the pressure is above 0, (m,), and its derivatives by the three
    ``pressure_heads`` at the corners, both (m, 3).

    With one wet corner c the wet part is a triangle, of the share p_c²/((p_c − p_a)(p_c − p_b)); with two the dry part
    is. The share does not change when all pressures are multiplied.
    """
    order = np.argsort(pressure_heads, axis=1, kind="stable")
    low, middle, high = np.take_along_axis(pressure_heads, order, axis=1).T
    one, two = (high > 0) & (middle <= 0) & (low < high), (middle > 0) & (low < 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        wet = np.where(one, (high / (high - low)) * (high / (high - middle)), 0.0)
        dry = np.where(two, (low / (low - middle)) * (low / (low - high)), 0.0)
        by_low = np.where(one, wet / (high - low), -dry * (2 / low + 1 / (middle - low) + 1 / (high - low)))
        by_middle = np.where(one, wet / (high - middle), dry / (middle - low))
        by_high = np.where(one, wet * (2 / high - 1 / (high - low) - 1 / (high - middle)), dry / (high - low))
    # what is at 0 everywhere is full: still water that just reaches it
    share = np.where(one, wet, np.where(two, 1 - dry, np.where(low >= 0, 1.0, 0.0)))
    change = np.zeros(pressure_heads.shape)
    cut = (one | two)[:, None]
    np.put_along_axis(change, order, np.where(cut, np.stack((by_low, by_middle, by_high), axis=1), 0.0), axis=1)
    return share, change


def lines(mesh, pressure_head) -> list[np.ndarray]:
    """Where a field at the nodes, (n,), passes through 0: polylines (k, 2) [m], the longest first, each from left to
    right, or upwards where it ends above its beginning.
    """
    wet = pressure_head > 0
    ends = []
    for a, b in ((0, 1), (1, 2), (2, 0)):
        pair = np.sort(mesh.triangles[:, [a, b]], axis=1)  # the same place to the last bit from both sides
        first, second = pair.T
        cut = wet[first] != wet[second]
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where(cut, pressure_head[first] / (pressure_head[first] - pressure_head[second]), np.nan)
        ends.append(mesh.nodes[first] + share[:, None] * (mesh.nodes[second] - mesh.nodes[first]))
    ends = np.stack(ends, axis=1)
    ends = ends[np.isfinite(ends[..., 0]).sum(axis=1) == 2]
    pieces = [piece[np.isfinite(piece[:, 0])] for piece in ends]
    pieces = [LineString(piece) for piece in pieces if np.any(piece[0] != piece[1])]
    if not pieces:
        return []
    merged = linemerge(pieces)
    found = [np.asarray(line.coords)[:, :2] for line in getattr(merged, "geoms", [merged])]
    found = [line if tuple(line[0]) <= tuple(line[-1]) else line[::-1] for line in found]
    return sorted(found, key=lambda line: (-float(geometry.distance(*np.diff(line, axis=0).T).sum()), line.tolist()))


def crossed(mesh, start, end):
    """The pieces of a segment between two points (2,) [m] that lie in triangles: their shares of its length, (k,), and
    the triangle of each, (k,). A piece along an edge belongs to one of its two triangles.
    """
    way = end - start
    corner = mesh.nodes[mesh.triangles]
    g = mesh.shape_gradients
    at_start = np.sum(g * (start - corner[:, [1, 2, 0]]), axis=-1)  # shape functions, and how they change along
    along = g @ way
    with np.errstate(divide="ignore", invalid="ignore"):
        where = -at_start / along
    enters = np.where(along > 0, where, -np.inf).max(axis=1)
    leaves = np.where(along < 0, where, np.inf).min(axis=1)
    outside = ((along == 0) & (at_start < 0)).any(axis=1)
    enters, leaves = np.maximum(enters, 0), np.minimum(leaves, 1)
    met = ~outside & (leaves > enters)
    cuts = np.unique(np.concatenate((enters[met], leaves[met])))
    if len(cuts) < 2:
        return np.zeros(0), np.zeros(0, int)
    share, middle = np.diff(cuts), 0.5 * (cuts[1:] + cuts[:-1])
    within = mesh.locate(start + middle[:, None] * way)
    inside = (within >= 0) & (share > 0)
    return share[inside], within[inside]
