"""Meshes: grids, borders, where a point lies, and polygons by Gmsh. Needs no YADE."""

import math
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth import section  # noqa: E402
from nonsmooth.water import mesher, seepage  # noqa: E402
from nonsmooth.water.conditions import Reservoir, SeepageFace  # noqa: E402
from nonsmooth.water.mesh import Mesh, MeshError, grid  # noqa: E402

gmsh = pytest.mark.skipif(shutil.which("gmsh") is None, reason="Gmsh is not there (apt install gmsh)")
GRID = grid([0, 1, 2.5, 3, 4], [0, 0.5, 2])
#: A lower layer of 8 by 2 m, and an upper one whose corner lies in the middle of the lower one's edge.
LOWER, UPPER = [(0, 0), (8, 0), (8, 2), (0, 2)], [(3, 2), (8, 2), (8, 4)]


def test_a_grid_covers_its_rectangle_and_is_its_own_mirror_image():
    assert len(GRID.triangles) == 16 and GRID.area.sum() == pytest.approx(8) and GRID.area.min() > 0
    assert GRID.bounds == (0, 0, 4, 2)
    level = grid(np.linspace(0, 4, 5), np.linspace(0, 2, 4))
    centres = {tuple(np.round(c, 9)) for c in level.nodes[level.triangles].mean(axis=1)}
    assert {(round(4 - x, 9), y) for x, y in centres} == centres


def test_the_border_goes_around_the_body_with_it_on_the_left():
    ends = GRID.nodes[GRID.border]
    assert len(ends) == 12
    (ax, ay), (bx, by) = ends[:, 0].T, ends[:, 1].T
    assert 0.5 * math.fsum(ax * by - bx * ay) == pytest.approx(8)
    assert len(GRID.border_on([(0, 0), (4, 0)])) == 4 and len(GRID.border_on([(0.5, 0), (4, 0), (4, 1)])) == 4
    assert len(GRID.border_on([(0, 0.1), (4, 0.1)])) == 0


def test_gradients_of_linear_values():
    x, y = GRID.nodes.T
    assert GRID.gradient(3 * x - 2 * y) == pytest.approx(np.tile((3.0, -2.0), (16, 1)))
    assert GRID.gradient([x, y]).shape == (2, 16, 2)


def test_each_point_is_found_in_its_triangle():
    dice = np.random.default_rng(3)
    for mesh in (GRID, grid(np.geomspace(0.1, 100, 30) - 700, np.linspace(200, 203, 5))):
        shares = dice.dirichlet((1, 1, 1), len(mesh.triangles))
        points = np.einsum("mk,mkd->md", shares, mesh.nodes[mesh.triangles])
        assert np.array_equal(mesh.locate(points), np.arange(len(points)))
        centres = mesh.nodes[mesh.triangles].mean(axis=1)
        assert mesh.at(mesh.nodes[:, 0], centres, mesh.locate(centres)) == pytest.approx(centres[:, 0])


def test_points_on_edges_belong_to_one_triangle_and_those_outside_to_none():
    assert np.all(GRID.locate(GRID.nodes) >= 0)
    assert np.all(GRID.locate(GRID.nodes[GRID.border].mean(axis=1)) >= 0)
    out = [(-1e-6, 1), (4 + 1e-6, 1), (2, -1e-6), (2, 2 + 1e-6), (99, 99), (2, -99)]
    assert GRID.locate(out).tolist() == [-1] * 6
    # a notch in the body is outside, though within the box
    notched = Mesh.of(GRID.nodes, GRID.triangles[:-2])
    assert (notched.locate(GRID.nodes[GRID.triangles].mean(axis=1)) < 0).sum() == 2


def test_a_corner_that_ends_where_a_box_of_the_search_begins_is_found():
    """Nothing of the body lies beyond it there."""
    apart = Mesh.of([(0, 0), (1, 0), (0, 1), (2, 0), (3, 0), (2, 1)], [(0, 1, 2), (3, 4, 5)])
    assert apart.locate([(1, 0), (0, 1), (3, 0), (1.5, 0)]).tolist() == [0, 0, 1, -1]


def test_a_mesh_of_arrays_is_turned_and_rid_of_idle_nodes():
    mesh = Mesh.of([(9, 9), (0, 0), (1, 0), (0, 1)], [(1, 3, 2)])
    assert mesh.nodes.tolist() == [[0, 0], [1, 0], [0, 1]] and mesh.triangles.tolist() == [[0, 1, 2]]


@pytest.mark.parametrize(
    "arguments, message",
    [
        (([(0, 0), (1, 0)], [(0, 1, 2)]), r"triangle 0 has the node 2: give numbers from 0 to 1"),
        (([(0, 0), (1, 0), (2, 0)], [(0, 1, 2)]), r"triangle 0 at \(0, 0\) m has no area"),
        (([(0, 0), (1, 0), (0, np.inf)], [(0, 1, 2)]), r"nodes\[2\] \[0.0, inf\]: give finite numbers"),
        (([(0, 0), (1, 0), (0, 1)], [(0.0, 1, 2)]), r"triangles .*: give whole numbers of shape \(n, 3\)"),
        (([(0, 0), (1, 0), (0, 1)], [(0, 1, 2)], [1, 2]), r"layer of shape \(2,\): give a whole number for each of 1"),
        (("nodes", [(0, 1, 2)]), r"nodes 'nodes': give numbers of shape \(n, 2\)"),
    ],
)
def test_arrays_that_are_no_mesh(arguments, message):
    with pytest.raises(MeshError, match=message):
        Mesh.of(*arguments)


def test_lines_that_are_no_grid():
    with pytest.raises(MeshError, match=r"x\[0\] = 1 and x\[1\] = 0: lines of a grid must rise"):
        grid([1, 0], [0, 1])
    with pytest.raises(MeshError, match=r"y \[0\]: give two or more finite numbers"):
        grid([0, 1], [0])


# ---- polygons -------------------------------------------------------------------------------------


@gmsh
def test_layers_that_touch_have_common_nodes():
    mesh = mesher.triangulate([LOWER, UPPER], 0.5, names=("sand", "clay"))
    assert mesh.names == ("sand", "clay")
    assert mesh.area[mesh.layer == 0].sum() == pytest.approx(16) and mesh.area[mesh.layer == 1].sum() == pytest.approx(
        5
    )
    # the border of the whole: 8 + 2 + 2 at the lower one, 3 on its top, and two sides of the upper one
    ends = mesh.nodes[mesh.border]
    assert np.hypot(*(ends[:, 1] - ends[:, 0]).T).sum() == pytest.approx(15 + 2 + math.hypot(5, 2))
    common = np.intersect1d(mesh.triangles[mesh.layer == 0], mesh.triangles[mesh.layer == 1])
    assert len(common) >= 10 and mesh.nodes[common, 1] == pytest.approx(2)


@gmsh
def test_edges_have_the_size_that_is_asked_for():
    for size, finer in ((0.5, 0.5), ([1.0, 0.25], 0.25)):
        mesh = mesher.triangulate([LOWER, UPPER], size)
        mean = mesh.area[mesh.layer == 1].mean()
        assert 0.5 * finer**2 / 2.31 < mean < 2 * finer**2 / 2.31  # equilateral: √3/4
    far = mesh.nodes[mesh.triangles].mean(axis=1)[:, 0] < 1.5
    assert mesh.area[far & (mesh.layer == 0)].mean() > 4 * mean


@gmsh
def test_places_on_the_border_become_nodes():
    mesh = mesher.triangulate([LOWER], 0.7, points=[(8, 1.234), (0, 0.5)])
    for place in ((8, 1.234), (0, 0.5), *LOWER):
        assert np.hypot(*(mesh.nodes - place).T).min() < 1e-12


@gmsh
def test_the_same_polygons_give_the_same_bits_whatever_a_person_has_set(tmp_path, monkeypatch):
    one = mesher.triangulate([LOWER, UPPER], 0.3)
    (tmp_path / ".gmshrc").write_text("Mesh.MeshSizeFactor = 3;")
    (tmp_path / ".gmsh-options").write_text("Mesh.MeshSizeFactor = 3;")
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("GMSH_HOME", str(tmp_path))
    other = mesher.triangulate([LOWER, UPPER], 0.3)
    assert np.array_equal(one.nodes, other.nodes) and np.array_equal(one.triangles, other.triangles)


@gmsh
def test_the_layers_of_every_shipped_section():
    for name in section.shipped():
        s = section.load(name)
        mesh = mesher.of_section(s, s.mass_size / 12)
        assert mesh.names == tuple(layer.name for layer in s.layers)
        for k, layer in enumerate(s.layers):
            assert mesh.area[mesh.layer == k].sum() == pytest.approx(layer.area, rel=1e-6)


@gmsh
def test_a_dam_of_polygons_in_two_layers():
    """Of one conductivity, on triangles of any shape: the discharge is exact all the same."""
    below, above = [(0, 0), (5, 0), (5, 4), (0, 6)], [(0, 6), (5, 4), (5, 10), (0, 10)]
    mesh = mesher.triangulate([below, above], 0.4, points=[(5, 2)])
    right = [(5, 0), (5, 10)]
    result = seepage.solve(mesh, [1e-4, 1e-4], [Reservoir([(0, 0), (0, 10)], 10), Reservoir(right, 2)])
    assert result.through == pytest.approx(9.6e-4, rel=2e-3)
    assert np.interp([1.25, 2.5, 3.75], *result.phreatic_line()[0].T) == pytest.approx((9.546, 8.852, 7.893), rel=5e-3)
    # a drain of the upper one takes part of the water
    drained = [Reservoir([(0, 0), (0, 10)], 10), Reservoir(right, 2), SeepageFace([(0, 10), (5, 10)])]
    assert seepage.solve(mesh, [1e-4, 1e-3], drained).through > 1.5 * result.through


def test_without_gmsh_one_message_says_what_to_install(monkeypatch):
    monkeypatch.setattr(mesher.shutil, "which", lambda name: None)
    with pytest.raises(MeshError, match="^Gmsh.*is not installed: apt install gmsh, or pip install gmsh$"):
        mesher.triangulate([LOWER], 0.5)


def test_gmsh_that_fails_says_what_it_said(monkeypatch):
    monkeypatch.setattr(mesher.shutil, "which", lambda name: "/bin/false")
    with pytest.raises(MeshError, match="Gmsh made no mesh .status 1.: look for narrow gaps"):
        mesher.triangulate([LOWER], 0.5)

    def stays(*arguments, **options):
        raise subprocess.TimeoutExpired("gmsh", 600)

    monkeypatch.setattr(mesher.subprocess, "run", stays)
    with pytest.raises(MeshError, match="Gmsh did not make a mesh .*600 seconds.*: give a larger size"):
        mesher.triangulate([LOWER], 0.5)


@pytest.mark.parametrize(
    "polygons, options, message",
    [
        ([], {}, r"polygons \[\]: give one or more"),
        (None, {}, "polygons None: give one or more"),
        ([[(0, 0), (1, 1)]], {}, "polygon 0: it has fewer than three vertices; give"),
        ([[(0, 0), (1, 1), (1, 0), (0, 1)]], {}, "polygon 0: Self-intersection.*does not cross itself"),
        ([LOWER, [(2, 1), (4, 1), (4, 3)]], {"names": ("a", "b")}, "b overlaps a by 1.5 m²: give polygons that touch"),
        ([LOWER], {"size": 0}, "size 0: give a length of edges above 0"),
        ([LOWER], {"size": [1, 2]}, r"size \[1, 2\]: give one number \[m\], or one for each of 1 polygons"),
        ([LOWER], {"size": 1e-3}, "size 0.001: asks for 3.7e.07 triangles; give one that asks for 2e.06 or fewer"),
        ([LOWER], {"points": [(8, math.nan)]}, r"points\[0\] \[8.0, nan\]: give finite numbers"),
        ([LOWER], {"points": (8, 1)}, r"points \(8, 1\): give numbers of shape \(n, 2\)"),
        ([LOWER], {"points": [(8, 1), (4, 1)]}, r"points\[1\] \(4, 1\) lies 1 m from all borders: give places on"),
    ],
)
def test_polygons_without_sense(polygons, options, message):
    with pytest.raises(MeshError, match=message):
        mesher.triangulate(polygons, **{"size": 0.5, **options})
