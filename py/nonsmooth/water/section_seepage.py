"""Seepage through a section, state by state, and the open water over it: from the keys ``water.seepage`` to a field of
pressures.

The layers are meshed with nodes where levels of reservoirs meet their border. Walls are tight; what lies on no wall is
the free surface, open to air, to a reservoir and to rain. Each state is steady (:mod:`~nonsmooth.water.seepage`), and
begins from the one before, but for a rapid drawdown.

**Rapid drawdown.** Where water has had no time to drain, its free surface in the ground is where it was. The pressures
below it follow the new border at once, as water and grains are not compressed: div(K grad h) = 0 with h = y on the
free surface and on the bared face, h the level of what is left of the reservoir. In a long slope this is seepage
parallel to it, with the effective stresses that it had under water.

**Open water** between the ground and the highest level has triangles of its own, with the pressure of still water of
the level of the time. The ground under it is the highest layer or wall at each x.
"""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import spsolve
from shapely.geometry import MultiLineString
from shapely.ops import linemerge

from ..model import free_surface, geometry
from ..model.section.seepage import SeepageStates
from . import conditions, mesher, phreatic, seepage
from .equations import Equations
from .error import WaterError
from .fields import MeshField
from .mesh import Mesh

__all__ = ["course", "field", "flow", "undrained"]

KINDS = {
    "head": conditions.Head,
    "pressure_head": conditions.PressureHead,
    "reservoir": conditions.Reservoir,
    "inflow": conditions.Inflow,
}


class SectionSeepageError(WaterError):
    """Seepage of a section that cannot be computed; the message names the state."""


def field(water, section) -> MeshField:
    """The MeshField of SeepageStates of a Section, at the times of its states; open water included."""
    mesh, heads = course(water, section)
    pressures = [water.unit_weight * (head - mesh.nodes[:, 1]) for head in heads]
    times = [one.time for one in water.states]
    pond = _open_water(water, section)
    if pond is None:
        return MeshField(mesh, times, pressures)
    nodes, triangles, levels = pond
    pressures = [np.concatenate((p, water.unit_weight * (level - nodes[:, 1]))) for p, level in zip(pressures, levels)]
    both = Mesh.of(
        np.vstack((mesh.nodes, nodes)),
        np.vstack((mesh.triangles, triangles + len(mesh.nodes))),
        np.concatenate((mesh.layer, np.full(len(triangles), len(section.layers)))),
        (*mesh.names, "open water"),
    )
    return MeshField(both, times, pressures)


def course(water, section):
    """The mesh of the layers, and the heads [m] at its nodes in each of the states, (states, nodes)."""
    where = f"{section.source}: water.seepage"
    places = _places(water, section)
    try:
        mesh = mesher.of_section(section, water.size, places)
    except WaterError as error:
        raise SectionSeepageError(f"{where}: {error}") from None
    tensors = [seepage.tensor(along, across, dip) for _, along, across, dip in water.conductivity]
    options = {} if water.dry is None else {"dry": water.dry}
    heads = []
    for k, state in enumerate(water.states):
        try:
            asked = _conditions(state, mesh, section)
            before = heads[-1] if heads else None
            if state.drained:
                heads.append(seepage.solve(mesh, tensors, asked, start=before, **options).head)
            else:
                heads.append(undrained(mesh, tensors, asked, before))
        except WaterError as error:
            raise SectionSeepageError(f"{where}.states[{k}]: {error}") from None
    return mesh, np.array(heads)


def flow(section, found):
    """What tells the flow of a state of a Section's field ``found``, a MeshField: a function of the time [s] since t0
    that gives heads (n,) [m], Darcy's flux (m, 2) [m/s] and wet shares (m,) on its mesh, 0 in open water, and the
    largest conductivity [m/s]. None where the section has no seepage.
    """
    water = section.water_field
    if not isinstance(water, SeepageStates):
        return None
    mesh = found.mesh
    tensors = [seepage.tensor(along, across, dip) for _, along, across, dip in water.conductivity]
    tensors = np.array([*tensors, np.zeros((2, 2))])[np.minimum(mesh.layer, len(tensors))]

    def at(time):
        head = found.at(time) / water.unit_weight + mesh.nodes[:, 1]
        wet = phreatic.wet_share((head - mesh.nodes[:, 1])[mesh.triangles])[0] * (mesh.layer < len(section.layers))
        return head, -wet[:, None] * np.einsum("mij,mj->mi", tensors, mesh.gradient(head)), wet, float(tensors.max())

    return at


def undrained(mesh, conductivity, asked, before) -> np.ndarray:
    """Heads [m] at once after a change of the border, (n,): see above.

    ``conductivity``, ``asked``: as of :func:`.seepage.solve`; ``before``: heads (n,) [m] of the state before.
    """
    applied = conditions.apply(mesh, asked)
    y = mesh.nodes[:, 1]
    wet = before - y > -mesh.tolerance
    bared = wet & (applied.face > 0) & ~applied.fixed
    head = np.where(applied.fixed, applied.head, np.where(bared, y, before))
    given = applied.fixed | bared | ~wet
    problem = Equations(mesh, seepage.tensors(conductivity, mesh), applied)
    shape = (len(y), len(y))
    matrix = sparse.coo_matrix((problem.stiffness.ravel(), (problem.rows, problem.columns)), shape).tocsr()
    free = np.flatnonzero(~given)
    if len(free):
        right = applied.inflow[free] - matrix[free][:, np.flatnonzero(given)] @ head[given]
        head[free] = spsolve(matrix[free][:, free].tocsc(), right, permc_spec="MMD_AT_PLUS_A")
    return head


def _places(water, section):
    """Places (k, 2) [m] on the layers' border that become nodes: ends of free faces and of lines, and where levels of
    reservoirs meet the border.
    """
    free = free_surface.faces(section)
    end = free.start + free.length[:, None] * free.direction
    found = [free.start, end]
    levels = {one.reservoir for one in water.states if one.reservoir is not None}
    for k, state in enumerate(water.states):
        for i, one in enumerate(state.boundaries):
            if one.line is not None:
                found.append(_on_border(np.array(one.line), section, f"water.seepage.states[{k}].boundaries[{i}].line"))
            if one.kind == "reservoir":
                levels.add(one.value)
    low, high = np.minimum(free.start[:, 1], end[:, 1]), np.maximum(free.start[:, 1], end[:, 1])
    for level in sorted(levels):
        cut = (low < level) & (level < high)
        share = (level - free.start[cut, 1]) / (end[cut, 1] - free.start[cut, 1])
        x = free.start[cut, 0] + share * (end[cut, 0] - free.start[cut, 0])
        found.append(np.column_stack((x, np.full(len(x), level))))
    return np.concatenate(found)


def _on_border(line, section, where):
    """The points of a line (k, 2) [m] along the layers' border; raises SectionSeepageError for one that is not there."""
    rings = [np.vstack((layer.points, layer.points[:1])) for layer in section.layers]
    away = geometry.nearest(line, *geometry.pieces(rings))[0]
    k = int(np.argmax(away))
    if away[k] > section.tolerance:
        x, y = line[k]
        raise SectionSeepageError(
            f"{section.source}: {where}: its point ({x:.6g}, {y:.6g}) lies {away[k]:.3g} m from the layers' border; give "
            "points along it"
        )
    return line


def _conditions(state, mesh, section):
    """What happens at the mesh's border in a state, a list of conditions."""
    taken = np.zeros(len(mesh.border), bool)
    asked = []
    for one in state.boundaries:
        line = section.wall(one.wall).points if one.wall is not None else np.array(one.line)
        edges = mesh.border_on(line)
        if one.kind == "closed" and not len(edges):
            raise conditions.ConditionError("a closed boundary lies on no edge of the border: give a line along it")
        taken[edges] = True
        if one.kind in KINDS:
            asked.append(KINDS[one.kind](line, one.value))
        elif one.kind == "seepage_face":
            asked.append(conditions.SeepageFace(line))
    for wall in section.walls:
        taken[mesh.border_on(wall.points)] = True
    for line in _chains(mesh.nodes[mesh.border[~taken]]):
        asked.append(
            conditions.SeepageFace(line) if state.reservoir is None else conditions.Reservoir(line, state.reservoir)
        )
        if state.rain:
            asked.append(conditions.Rain(line, state.rain))
    return asked


def _chains(edges):
    """Polylines (k, 2) of edges (n, 2, 2), each from one end of a run of edges to the other."""
    if not len(edges):
        return []
    merged = linemerge(MultiLineString([tuple(map(tuple, ends)) for ends in edges.tolist()]))
    return [np.asarray(line.coords) for line in getattr(merged, "geoms", [merged])]


# ---- open water ---------------------------------------------------------------------------------------
def _open_water(water, section):
    """Nodes (n, 2), triangles (m, 3) between the ground and the highest level, and the level at each node in each
    state, (states, n) [m]; None where no reservoir stands over the ground.

    Where a state has no open water, its level is the lowest ground of all.
    """
    tops = [(one.reservoir, *(b.value for b in one.boundaries if b.kind == "reservoir")) for one in water.states]
    tops = [level for state in tops for level in state if level is not None]
    if not tops:
        return None
    columns = _columns(section, max(tops))
    if not columns:
        return None
    bottom = min(float(c[:, 1].min()) for c in columns)
    nodes, triangles, levels = [], [], []
    for corners in columns:
        first = sum(map(len, nodes))
        nodes.append(corners)
        triangles += [(first, first + k, first + k + 1) for k in range(1, len(corners) - 1)]
        floor = 0.5 * (corners[0] + corners[1])
        levels.append(np.repeat([[_level_over(floor, one, bottom)] for one in water.states], len(corners), axis=1))
    return np.vstack(nodes), np.array(triangles), np.hstack(levels)


def _level_over(place, state, none):
    """The level of the open water over a place of the ground in a state: that of the reservoir whose line is nearest,
    or that of the free surface.
    """
    found = [(one.value, np.array(one.line)) for one in state.boundaries if one.kind == "reservoir" and one.line]
    if found:
        away = [geometry.nearest(place[None, :], *geometry.pieces([line]))[0][0] for _, line in found]
        k = int(np.argmin(away))
        if state.reservoir is None or away[k] <= 1e-6 * max(1.0, float(np.abs(place).max())):
            return found[k][0]
    return none if state.reservoir is None else state.reservoir


def _columns(section, top):
    """Corners (3 or 4, 2) [m] of columns of open water between the ground and the level ``top``, each counter-clockwise
    from the left end of its floor.
    """
    rings = [np.vstack((layer.points, layer.points[:1])) for layer in section.layers]
    a, b = geometry.pieces([*rings, *(wall.points for wall in section.walls)])
    low, high = np.minimum(a[:, 0], b[:, 0]), np.maximum(a[:, 0], b[:, 0])
    cuts = np.unique(np.concatenate((low, high)))
    found = []
    for left, right in zip(cuts[:-1], cuts[1:]):
        there = (low <= left) & (right <= high) & (high > low)
        if not there.any():
            continue
        slope = (b[there, 1] - a[there, 1]) / (b[there, 0] - a[there, 0])
        heights = [a[there, 1] + slope * (x - a[there, 0]) for x in (left, right)]
        k = int(np.argmax(heights[0] + heights[1]))
        y0, y1 = float(heights[0][k]), float(heights[1][k])
        corners = [(left, y0)] * (y0 < top) + [(right, y1)] * (y1 < top)
        if not corners:
            continue
        if len(corners) == 2:
            corners += [(right, top), (left, top)]
        else:
            x = left + (top - y0) / (y1 - y0) * (right - left)
            corners = [(left, y0), (x, top), (left, top)] if y0 < top else [(x, top), (right, y1), (right, top)]
        if min(abs(c[0] - d[0]) + abs(c[1] - d[1]) for c, d in zip(corners, corners[1:])) > 1e-9 * (right - left):
            found.append(np.array(corners))
    return found
