"""Measures of spheres in space: edge, profile, repose, the surface in a drum, overlaps, the rate out of a hopper; from
places that are known. Needs no YADE.
"""
import math

import numpy as np
import pytest
import synthetic_slope as synthetic

measures, laws = (synthetic.load(f"measure.{name}") for name in ("sphere_heaps", "sphere_laws"))


def block(wide, high, r=0.5):
    """Spheres on a cubic lattice, of which neighbours touch, and their radii."""
    x, y, z = np.meshgrid(np.arange(wide), np.arange(wide), np.arange(high), indexing="ij")
    places = np.column_stack([one.ravel() for one in (x, y, z)]) * 2 * r + [0, 0, r]
    return places - [r * (wide - 1), r * (wide - 1), 0], np.full(len(places), r)


def cone(angle, radius=30.0, step=0.3, r=0.25):
    """Spheres whose tops lie on a cone with this slope [degrees], closer than they are wide."""
    x, y = (one.ravel() for one in np.meshgrid(*[np.arange(-radius, radius, step)] * 2))
    far = np.hypot(x, y)
    inside = far < radius
    top = math.tan(math.radians(angle)) * (radius - far)
    # the top of a sphere that a slope touches stands above its centre by r/cos
    return np.column_stack((x, y, top - r / math.cos(math.radians(angle))))[inside], np.full(inside.sum(), r)


def test_what_rolls_ahead_and_what_is_in_the_air_is_not_of_the_mass():
    places, r = block(3, 2)
    places = np.vstack((places, [[9.0, 0, 0.5], [0, 0, 7.0]]))
    r = np.append(r, [0.5, 0.5])
    assert measures.connected(places, r).tolist() == [True] * 18 + [False] * 2
    # a gap of 0.04 mean diameters belongs to it, one of 0.06 does not
    for gap, joined in ((0.04, 19), (0.06, 18)):
        near = np.vstack((places[:18], [[2.0 + gap, 0, 0.5]]))
        assert np.count_nonzero(measures.connected(near, r[:19])) == joined


def test_pairs_and_their_gaps():
    i, j, gap = measures.gaps(np.array([[0, 0, 0], [3, 0, 4], [0, 0, 2.2]]), np.array([1.0, 2.0, 1.0]), 0.5)
    # (0, 0, 2.2) and (3, 0, 4) are 3.499 apart, and 3 of that are radii: 0.499
    assert (i.tolist(), j.tolist()) == ([0, 1], [2, 2])
    assert gap == pytest.approx([0.2, math.hypot(3, 1.8) - 3], rel=1e-12)


def test_overlap_of_pairs_and_walls():
    places, r = np.array([[0, 0, 0.49], [0.98, 0, 0.5], [9, 0, 0.5]]), np.full(3, 0.5)
    mean, worst = measures.overlap(places, r, [places[:, 2] - r])
    # the pair, by its distance; the first one in the floor, 0.01 of its diameter; two that touch it
    pair = 1 - math.hypot(0.98, 0.01)
    assert worst == pytest.approx(pair, rel=1e-9)
    assert mean == pytest.approx((pair + 0.01) / 4, rel=1e-9)
    assert measures.overlap(places[2:] + 1, r[2:]) == (0.0, 0.0)


def test_the_profile_of_one_sphere_is_its_upper_half():
    at = np.array([[0.0, 0.0, 5.0]])
    distance, height = measures.profile(at, np.array([1.0]), np.ones(1, bool))
    (only,) = height
    assert distance == pytest.approx([0.5])  # a ring of half a diameter about the axis
    # the mean of 5 + sqrt(1 - r²) over r from 0 to 1; three places stand for the integral, whose midpoint rule is 1 % off
    assert only == pytest.approx(5 + math.pi / 4, rel=0.01)


@pytest.mark.parametrize("angle", (12, 25, 38))
def test_a_cone_has_its_angle_and_its_edge(angle):
    places, r = cone(angle)
    distance, height = measures.profile(places, r, np.ones(len(r), bool))
    # between spheres the surface is lower, everywhere by the same: some tenths of a radius, and no tilt but at the foot
    assert measures.repose(distance, height) == pytest.approx(angle, abs=0.3)
    assert measures.edge(distance, height, 0.25) == pytest.approx(
        30 - 0.25 / math.tan(math.radians(angle)), abs=1.0  # a ring is half a metre wide, and tops dip
    )


def test_a_flank_with_less_than_three_rings_has_no_angle():
    assert math.isnan(measures.repose(np.array([0.5, 1.5, 2.5]), np.array([1.0, 0.5, 0.0])))


def test_the_edge_of_a_profile_is_where_it_falls_below_for_the_last_time():
    distance = np.array([0.5, 1.5, 2.5, 3.5])
    assert measures.edge(distance, np.array([4.0, 0.2, 2.0, 0.0]), 0.5) == pytest.approx(2.5 + 0.75)
    assert measures.edge(distance, np.array([4.0, 3.0, 2.0, 1.0]), 0.5) == pytest.approx(4.0)  # all of the last ring
    assert measures.edge(distance, np.array([0.4, 0.3, 0.2, 0.1]), 0.5) == 0


def test_the_edge_of_the_farthest_is_a_mean_over_sectors():
    turn = 2 * math.pi * (np.arange(24) + 0.5) / 24
    far = np.linspace(3, 5.3, 24)
    places = np.column_stack((far * np.cos(turn), far * np.sin(turn), np.zeros(24)))
    r = np.full(24, 0.25)
    assert measures.edge_of_connected(places, r, np.ones(24, bool)) == pytest.approx(far.mean() + 0.25, rel=1e-12)
    some = np.arange(24) > 0  # a sector without spheres counts nothing
    assert measures.edge_of_connected(places, r, some) == pytest.approx((far[1:] + 0.25).sum() / 24, rel=1e-12)


def filled_drum(angle, radius=8.0):
    """Spheres of a drum about the y axis below a plane through its axis that rises by ``angle`` towards larger x."""
    grid = np.arange(-radius, radius, 0.35)
    x, y, z = (one.ravel() for one in np.meshgrid(grid, np.arange(0, 3, 0.5), grid))
    below = (np.hypot(x, z) < radius) & (z < math.tan(math.radians(angle)) * x)
    return np.column_stack((x, y, z))[below], np.full(below.sum(), 0.25)


@pytest.mark.parametrize("angle", (-35, 0, 20))
def test_the_surface_of_a_half_filled_drum(angle):
    places, r = filled_drum(angle)
    # where the surface rises to the right most of the mass is there; the lattice has steps along the plane
    assert measures.tilt(places, r) == pytest.approx(angle, abs=0.5)
    assert measures.tilt_of_surface(places, r, 8.0) == pytest.approx(angle, abs=1.0)
    other = places[:, [1, 0, 2]]  # about the x axis
    assert measures.tilt(other, r, axis=0) == measures.tilt(places, r)
    moved = places + [3.0, 0, -2.0]
    assert measures.tilt(moved, r, centre=(3.0, -2.0)) == pytest.approx(measures.tilt(places, r), abs=1e-9)


def test_a_large_sphere_weighs_more_than_a_small_one():
    # radii 1 and 2: eight times the weight below the axis, so the centre is eight ninths of the way down
    places = np.array([[9.0, 0, 0], [0, 0, -9.0]])
    assert measures.tilt(places, np.array([1.0, 2.0])) == pytest.approx(math.degrees(math.atan(1 / 8)), rel=1e-12)


def test_a_drum_with_two_strips_has_no_surface():
    assert math.isnan(measures.tilt_of_surface(np.array([[0.1, 0, 0], [1.2, 0, 0]]), np.full(2, 0.5), 8.0))


def test_the_rate_is_that_of_the_middle():
    time = np.linspace(0, 10, 101)
    mass = np.where(time < 1, 0, np.minimum(3 * (time - 1), 24.0))  # begins late, and ends
    assert measures.rate(time, mass) == pytest.approx(3.0, rel=1e-9)
    with pytest.raises(measures.SphereMeasureError, match="0 rows between 20 and 60 %"):
        measures.rate([0.0, 1.0], [0.0, 5.0])


def test_beverloo_by_hand():
    # 0.58 · 1500 · √9.81 · (0.06 − 1.4 · 0.01)^2.5
    assert measures.beverloo(0.06, 0.01, 1500.0) == pytest.approx(0.58 * 1500 * 9.81**0.5 * 0.046**2.5, rel=1e-12)
    assert measures.beverloo(0.013, 0.01, 1500.0) == 0


def test_published_laws_meet_where_they_change():
    """That of Lube et al. by 1 %, as they round, and that of Lajeunesse et al. by its factor."""
    lube, lajeunesse = laws.RUNOUT
    for law, off in ((lube, 0.02), (lajeunesse, 1e-12)):
        below, above = (c * law.change**n for c, n in law.pieces)
        assert above == pytest.approx(below, rel=off)
    assert laws.HEIGHT[1](np.array([0.5, 3.0])) == pytest.approx([0.5, 0.74])
