"""Meshes of polygons, made by Gmsh.

Gmsh is the one mesher of polygons that Debian 12 and Debian 13 both have: Triangle is not free, and MeshPy, which has
it inside, is not in Debian. It comes with 40 MB to fetch, mostly of a CAD kernel that is not used here. So what needs
no polygon, as :func:`~nonsmooth.water.mesh.grid` and all fields, works without it.

The *program* is called, and not its Python module, which would load those libraries into the process, YADE's too, and
take Ctrl-C over. One thread, and a home folder without a person's own options, give the same mesh to the last bit from
the same version of Gmsh. Another version may give another mesh, and results that differ by less than their error. A
mesh that must stay is kept in a file (:mod:`~nonsmooth.water.field_files`).
"""

from __future__ import annotations

import math
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from ..model import geometry
from ..system import checks
from .mesh import CLOSE, Mesh, MeshError, array

__all__ = ["of_section", "triangulate"]

MOST = 2_000_000  # triangles; the linear solver takes minutes for a tenth of them
PATIENCE = 600  # s, for Gmsh


def of_section(section, size, points=()) -> Mesh:
    """The mesh of the layers of a :class:`~nonsmooth.section.Section`, see :func:`triangulate`."""
    layers = section.layers
    return triangulate([layer.vertices for layer in layers], size, points, [layer.name for layer in layers])


def triangulate(polygons, size, points=(), names=()) -> Mesh:
    """A mesh of one or more simple polygons that may touch and must not overlap, one a layer; made by Gmsh.

    ``polygons``: vertices (n, 2) [m] of each, not closed; ``size``: length [m] of edges, one for all or one for each
    polygon; ``points``: places (k, 2) [m] on borders that become nodes, as where a reservoir's level meets the ground;
    ``names``: of the polygons, for messages. Common borders have common nodes. Raises MeshError for a polygon that
    crosses itself or overlaps another, for sizes that are not above 0 or ask for too many triangles, for a point that
    lies on no border, and where Gmsh is not there or fails.
    """
    if not isinstance(polygons, (list, tuple)) or not polygons:
        raise MeshError(f"polygons {checks.shown(polygons)}: give one or more, each with three vertices or more [m]")
    names = tuple(names) or tuple(f"polygon {k}" for k in range(len(polygons)))
    rings = [_ring(vertices, name) for vertices, name in zip(polygons, names)]
    sizes = [size] * len(rings) if np.ndim(size) == 0 else list(size)
    if len(sizes) != len(rings):
        raise MeshError(f"size {checks.shown(size)}: give one number [m], or one for each of {len(rings)} polygons")
    sizes = [checks.number("size", one, MeshError, "give a length of edges above 0 [m]", above=0) for one in sizes]
    asked = math.fsum(geometry.area(ring) / (0.43 * one**2) for ring, one in zip(rings, sizes))
    if asked > MOST:
        raise MeshError(
            f"size {checks.shown(size)}: asks for {asked:.2g} triangles; give one that asks for {MOST:.2g} or fewer"
        )
    _refuse_overlaps(rings, names)
    corners = np.vstack(rings)
    tolerance = CLOSE * math.dist(corners.min(axis=0), corners.max(axis=0))
    points = array("points", points, 2) if len(points) else np.zeros((0, 2))
    away = geometry.nearest(points, *geometry.pieces([np.vstack((r, r[:1])) for r in rings]))[0]
    if np.any(away > tolerance):
        k = int(np.argmax(away))
        raise MeshError(
            f"points[{k}] ({points[k, 0]:.6g}, {points[k, 1]:.6g}) lies {away[k]:.3g} m from all borders: "
            "give places on a polygon's border"
        )
    return _by_gmsh(*_joined(rings, points, sizes, tolerance), names)


def _ring(vertices, name):
    """Vertices of a simple polygon, counter-clockwise."""
    ring = array(name, vertices, 2)
    if len(ring) > 1 and np.array_equal(ring[0], ring[-1]):
        ring = ring[:-1]
    reason = "it has fewer than three vertices" if len(ring) < 3 else geometry.invalid_reason(ring)
    if reason:
        raise MeshError(f"{name}: {reason}; give the vertices of a polygon that does not cross itself, in their order")
    return np.asarray(geometry.parts(geometry.Polygon(ring))[0].exterior.coords)[:-1, :2]


def _refuse_overlaps(rings, names):
    shapes = [geometry.Polygon(ring) for ring in rings]
    for k, one in enumerate(shapes):
        for other, name in zip(shapes[:k], names):
            common = one.intersection(other).area
            if common > 1e-6 * min(one.area, other.area):
                raise MeshError(f"{names[k]} overlaps {name} by {common:.3g} m²: give polygons that touch at most")


def _joined(rings, points, sizes, tolerance):
    """Places (n, 2), the length of edges at each, and the rings as node numbers. Each vertex or point that lies on an
    edge is a node of it, so that neighbours have common edges.
    """
    places, lengths, numbers = [], [], []
    for ring, size in zip([*rings, *points[:, None, :]], [*sizes, *[max(sizes)] * len(points)]):
        numbers.append([])
        for place in ring:
            near = [k for k, known in enumerate(places) if math.dist(known, place) <= tolerance]
            if not near:
                places.append(tuple(map(float, place)))
                lengths.append(size)
            numbers[-1].append(near[0] if near else len(places) - 1)
            lengths[numbers[-1][-1]] = min(lengths[numbers[-1][-1]], size)
    places, lengths, chains = np.array(places), np.array(lengths), []
    for ring, size in zip(numbers[: len(rings)], sizes):
        chain = []
        for a, b in zip(ring, [*ring[1:], *ring[:1]]):
            away = geometry.nearest(places, places[[a]], places[[b]])[0]
            along = (places - places[a]) @ (places[b] - places[a])
            on = np.flatnonzero((away <= tolerance) & (along > 0) & (along < along[b]))
            lengths[on] = np.minimum(lengths[on], size)
            chain += [a, *on[np.argsort(along[on], kind="stable")]]
        chains.append([node for node, before in zip(chain, chain[-1:] + chain[:-1]) if node != before])
    return places, lengths, chains


def _by_gmsh(places, lengths, chains, names):
    program = shutil.which("gmsh")
    if program is None:
        raise MeshError("Gmsh, which makes meshes of polygons, is not installed: apt install gmsh, or pip install gmsh")
    import meshio  # late: what needs no file needs no meshio

    with tempfile.TemporaryDirectory(prefix="nonsmooth-mesh-") as folder:
        source, target = Path(folder, "section.geo"), Path(folder, "section.msh")
        source.write_text(_geo(places, lengths, chains))
        command = [program, "-2", "-nt", "1", "-v", "1", "-format", "msh41", "-bin", "-o", str(target), str(source)]
        alone = {**os.environ, "GMSH_HOME": folder, "HOME": folder}  # no options of a person's own
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, env=alone)
        except (OSError, subprocess.TimeoutExpired) as error:
            raise MeshError(f"Gmsh did not make a mesh ({error}): give a larger size") from None
        if done.returncode != 0 or not target.exists():
            said = " ".join((done.stderr + done.stdout).split())[-200:]
            raise MeshError(
                f"Gmsh made no mesh ({said or f'status {done.returncode}'}): look for narrow gaps between polygons"
            )
        read = meshio.read(target, file_format="gmsh")
    triangles = np.concatenate([b.data for b in read.cells if b.type == "triangle"]).astype(int)
    which = [d for b, d in zip(read.cells, read.cell_data["gmsh:physical"]) if b.type == "triangle"]
    return Mesh.of(read.points[:, :2], triangles, np.concatenate(which).astype(int) - 1, names)


def _geo(places, lengths, chains):
    """The polygons in Gmsh's language; numbers with all their digits."""
    text = ["Mesh.Algorithm = 6;", "Mesh.RandomSeed = 1;", "Mesh.MeshSizeExtendFromBoundary = 1;"]
    text += [
        f"Point({k + 1}) = {{{x!r}, {y!r}, 0, {s!r}}};"
        for k, ((x, y), s) in enumerate(zip(places.tolist(), lengths.tolist()))
    ]
    edges = {}
    for k, chain in enumerate(chains):
        loop = []
        for a, b in zip(chain, [*chain[1:], *chain[:1]]):
            key = (min(a, b), max(a, b))
            if key not in edges:
                edges[key] = len(edges) + 1
                text.append(f"Line({edges[key]}) = {{{key[0] + 1}, {key[1] + 1}}};")
            loop.append(str(edges[key] if a < b else -edges[key]))
        text.append(f"Curve Loop({k + 1}) = {{{', '.join(loop)}}};")
        text += [f"Plane Surface({k + 1}) = {{{k + 1}}};", f"Physical Surface({k + 1}) = {{{k + 1}}};"]
    return "\n".join(text) + "\n"
