"""The free surface of layers: which edges no wall holds, which way is in, and the outline raised by a share of the
thickness.
"""

import dataclasses
import math
import sys
from pathlib import Path

import numpy as np
import pytest
from shapely.geometry import Polygon

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth import similar  # noqa: E402
from nonsmooth.model import free_surface, geometry  # noqa: E402
from nonsmooth.section import load, shipped  # noqa: E402

SLOPE = load("jiufengershan")


def with_wall(section, name, vertices):
    walls = tuple(dataclasses.replace(w, vertices=vertices) if w.name == name else w for w in section.walls)
    return dataclasses.replace(section, walls=walls)


def test_free_are_the_top_and_the_cut_of_the_crown():
    free = free_surface.faces(SLOPE)
    ends = {tuple(p) for p in free.start.tolist()} | {
        tuple(np.round(s + n * t, 9)) for s, n, t in zip(free.start, free.length, free.direction)
    }
    assert ends == {(23.294, 60.683), (-1346.109, 561.711), (-1400.371, 537.552)}  # vertices of the layers
    assert free.length.sum() == pytest.approx(
        math.dist((23.294, 60.683), (-1346.109, 561.711)) + math.dist((-1346.109, 561.711), (-1400.371, 537.552)),
        abs=1e-6,
    )


def test_a_triangle_as_thin_as_idle_vertices_lie_off_a_line_keeps_its_three():
    """10 m long and 0.18 mm high, with vertices that count as idle within 0.2 mm: two would be no polygon."""
    thin = Polygon([(0, 0), (10, 0), (5, 1.8e-4)])
    found = geometry.outline([thin], 1e-4)
    assert len(found.geoms) == 1 and len(found.geoms[0].exterior.coords) == 4
    # a pointed corner is cut off where rims are moved out and in again
    assert found.area == pytest.approx(thin.area, rel=0.5)


def test_both_sides_of_a_line_with_a_dent_and_a_hump():
    """From left to right it turns to the left, to the right, and to the left again. What lies above has less than 180°
    where it turns to the left, what lies below where it turns to the right; ends go on straight."""
    line = np.array([(0.0, 0.0), (3.0, 0.0), (6.0, 4.0), (9.0, 4.0), (9.0, 6.0)])
    above, below = geometry.sides(line)
    assert above.length == pytest.approx([3, 5, 3, 2]) and below.length == pytest.approx([2, 3, 5, 3])
    assert above.direction[1] == pytest.approx((0.6, 0.8)) and below.direction[2] == pytest.approx((-0.6, -0.8))
    assert above.convex_start.tolist() == [True, True, False, True] and above.convex_end.tolist() == [
        True,
        False,
        True,
        True,
    ]
    assert below.convex_start.tolist() == [True, False, True, False] and below.convex_end.tolist() == [
        False,
        True,
        False,
        True,
    ]


def test_an_edge_is_cut_where_its_wall_ends():
    """FB half as high as the layers holds the lower half of their face."""
    half = with_wall(SLOPE, "FB", ((0.0, 0.0), (11.647, 30.3415)))
    more = free_surface.faces(half).length.sum() - free_surface.faces(SLOPE).length.sum()
    assert more == pytest.approx(math.hypot(11.647, 30.3415), abs=1e-6)


@pytest.mark.parametrize("name", shipped())
def test_the_way_in_is_the_gradient_of_the_depth(name):
    """By differences over 1e-4 of the largest disk, at points of the layers; all but those at the kinks where two faces
    are equally near.
    """
    section = load(name)
    x0, y0, x1, y1 = section.outline.bounds
    x, y = np.random.default_rng(1).random((2, 20000)) * ((x1 - x0,), (y1 - y0,)) + ((x0,), (y0,))
    inside = np.any([geometry.contains(p, x, y) for p in geometry.parts(section.outline)], axis=0)
    x, y, step = x[inside], y[inside], 1e-4 * section.largest
    way, depth = free_surface.inward(section, x, y)
    east, north = (free_surface.inward(section, x + dx, y + dy)[1] for dx, dy in ((step, 0), (0, step)))
    away = np.abs(np.column_stack((east - depth, north - depth)) / step - way).max(axis=1)
    assert len(x) > 500 and (depth > 0).all() and np.allclose(np.hypot(*way.T), 1, atol=1e-12)
    assert np.mean(away < 1e-3) > 0.99


def test_the_depth_of_points_is_measured_from_the_nearest_face_and_negative_above():
    a, b = np.array((23.294, 60.683)), np.array((-1346.109, 561.711))
    t = (b - a) / math.dist(a, b)
    n = np.array((-t[1], t[0]))  # into the mass: it is on the left of an edge
    points = [a + 700 * t + depth * n for depth in (30.0, 1.0, -2.0)]
    way, depth = free_surface.inward(SLOPE, *np.array(points).T)
    assert depth == pytest.approx((30, 1, -2), abs=1e-9) and np.allclose(way, n, atol=1e-12)


def test_a_point_beyond_a_corner_is_drawn_towards_it():
    a, b = np.array((23.294, 60.683)), np.array((-1346.109, 561.711))
    beyond = a + 12 * (a - b) / math.dist(a, b)  # over SS, on the line of the top
    way, depth = free_surface.inward(SLOPE, beyond[:1], beyond[1:])
    assert depth == pytest.approx(-12, abs=1e-9) and way[0] == pytest.approx((b - a) / math.dist(a, b), abs=1e-9)


def test_a_mirrored_slope_has_mirrored_ways():
    x, y = np.linspace(-1300, 10, 50), np.linspace(540, 20, 50)
    here, there = free_surface.inward(SLOPE, x, y), free_surface.inward(similar.mirrored(SLOPE), -x, y)
    assert np.allclose(here[0] * (-1, 1), there[0], atol=1e-12) and np.allclose(here[1], there[1], atol=1e-9)


def test_a_raised_surface_is_higher_by_the_share_of_the_thickness_below_it():
    """Of a tenth: 6.5 m at the foot, where the layers are 65 m thick and FB stands across them, less a disk's way up
    the surface (its fall of 0.9° on 4 m).
    """
    found = np.array(geometry.parts(free_surface.raised(SLOPE, 0.1))[0].exterior.coords)
    foot = found[np.argmin(np.hypot(*(found - (23.294, 60.683)).T))]
    along = np.array((23.294, 60.683)) / math.hypot(23.294, 60.683)
    assert (foot - (23.294, 60.683)) @ along == pytest.approx(6.5, abs=0.02)
    assert foot[0] * along[1] - foot[1] * along[0] == pytest.approx(0, abs=1e-9)  # it slides along FB
    assert any(np.array_equal(v, (0.0, 0.0)) for v in found)  # what lies on walls stays
    # the whole area by the share, but for the crown's cut, which also goes outward
    assert geometry.parts(free_surface.raised(SLOPE, 0.01))[0].area / SLOPE.outline.area == pytest.approx(
        1.0101, abs=2e-4
    )


@pytest.mark.parametrize("name", shipped())
def test_raised_by_nothing_it_is_the_outline_and_by_more_it_holds_it(name):
    section = load(name)
    same, more = free_surface.raised(section, 0.0), free_surface.raised(section, 0.02)
    assert all(p.is_valid for p in geometry.parts(more)) and same.symmetric_difference(section.outline).area < 1e-6
    assert section.outline.difference(more).area < 1e-3 * section.outline.area
    # a share of 2 % of thicknesses that differ along the surface, each at most the greatest depth
    assert 1.012 < more.area / section.outline.area < 1.03


def test_a_line_within_the_layers_is_lifted_by_the_share_of_what_is_below_it():
    line = np.array(((-1000.0, 400.0 + 20.0), (-500.0, 208.0 + 20.0)))
    dip = math.radians(SLOPE.dip)
    below = (line[:, 1] + line[:, 0] * math.tan(dip)) * math.cos(dip)
    lifted = free_surface.lifted(SLOPE, line, 0.1)
    above = (lifted[:, 1] + lifted[:, 0] * math.tan(dip)) * math.cos(dip)
    # along the line's normal, which is DP's to a fraction of a degree
    assert above / below == pytest.approx(1.1, abs=1e-3)


def test_an_outline_has_no_idle_vertices():
    """Vertices within 2 mm of the line through their neighbours go, of a triangle too; a slit of 1 mm between two
    layers is closed, one of 10 mm stays.
    """

    def ring(*points):
        return geometry.outline([geometry.Polygon(points)], 1e-3)

    def vertices(found):
        return [[tuple(v) for v in p.exterior.coords[:-1]] for p in found.geoms]

    assert vertices(ring((0, 0), (4, 0.001), (8, 0), (8, 6))) == [[(0, 0), (8, 0), (8, 6)]]
    assert vertices(ring((0, 0), (4, 0), (8, 0), (8, 6), (0, 6))) == [[(0, 0), (8, 0), (8, 6), (0, 6)]]
    assert vertices(ring((0, 0), (4, 0.01), (8, 0), (8, 6))) == [[(0, 0), (4, 0.01), (8, 0), (8, 6)]]

    def box(x0, x1):
        return geometry.Polygon([(x0, 0), (x1, 0), (x1, 2), (x0, 2)])

    assert vertices(geometry.outline([box(0, 3), box(3.001, 5)], 1e-3)) == [[(0, 0), (5, 0), (5, 2), (0, 2)]]
    assert len(vertices(geometry.outline([box(0, 3), box(3.01, 5)], 1e-3))) == 2


def test_the_greatest_depth_is_sought_along_edges_too():
    """A rim along 8 m, which begins at a free end and has another one 14 m on: 7 m from both at 7 m, an eighth of the
    edge before its end; the way back has its points elsewhere.
    """
    table = geometry.edges(geometry.Polygon([(0, 0), (3, -0.01), (8, 0)]))
    ends = np.array([(0.0, 0.0), (14.0, 0.0)])
    for edges in (table, geometry.edges(geometry.Polygon([(0, 0), (8, 0), (3, 0.01)]))):
        assert free_surface._greatest_depth(edges, (ends, ends + (0.0, 1e-6))) == pytest.approx(7.0, abs=1e-5)
