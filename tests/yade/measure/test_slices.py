"""Bishop's factor on circles: closed forms, published slopes, and what is no circle. Needs no YADE."""

import math

import numpy as np
import pytest

import synthetic_slope as synthetic

slices = synthetic.load("measure.slices")

#: ACADS 1(c) in the survey's own coordinates (Giam and Donald 1989), kPa as Pa: sand, two soils with cohesion.
SAND = [(30, 25), (40, 27), (50, 29), (54, 31), (70, 31), (70, 35), (50, 35)], 0.0, 38.0
MIDDLE = [(40, 27), (52, 24), (70, 24), (70, 31), (54, 31), (50, 29)], 5.3e3, 23.0
LOWER = [(20, 20), (70, 20), (70, 24), (52, 24), (40, 27), (30, 25), (20, 25)], 7.2e3, 20.0
FACE = [(20, 20), (70, 20), (70, 35), (50, 35), (30, 25), (20, 25)]


def soil(outline, cohesion, friction_deg, weight=20e3):
    return slices.Soil(np.array(outline, float), cohesion, friction_deg, weight)


def acads_1c():
    return [soil(*one, 19.5e3) for one in (SAND, MIDDLE, LOWER)]


def test_a_circle_in_clay_has_its_moments_in_balance():
    """With φ = 0: F = c R² Δθ over the moment of the weight about the centre. Ground that fills the circle to the
    centre's height has none, so the moment is that of a load on its right half.
    """
    radius, load, end = 10.0, 4.0, 9.9
    clay = soil([(-30, -30), (30, -30), (30, load), (0, load), (0, 0), (-30, 0)], 50e3, 0.0)
    found = slices.bishop([clay], 0.0, 0.0, radius, (-end, end))
    moment = 20e3 * load * end**2 / 2
    # sixty slices sum the length of the arc, which is steep at its ends, to a per cent
    assert found == pytest.approx(50e3 * radius**2 * 2 * math.asin(end / radius) / moment, rel=0.01)


def test_a_vertical_cut_in_clay_stands_by_taylors_number():
    """F = 3.83 c/γH on toe circles (Taylor)."""
    clay = soil([(-30, -20), (30, -20), (30, 10), (0, 10), (0, 0), (-30, 0)], 40e3, 0.0)
    found = slices.worst_circle([clay], (-1e-6, 0.0), (2.0, 29.0))
    assert found.factor == pytest.approx(3.83 * 40e3 / (20e3 * 10), rel=0.01)
    assert math.hypot(found.x, found.y) == pytest.approx(found.radius, rel=1e-3)  # through the toe


def test_published_slopes_have_their_factors():
    """ACADS 1(a): Bishop 0.987; Griffiths and Lane's first: charts 1.380; ACADS 1(c): 1.39 by the referee, and 1.405 on
    the circle about (34.12, 43.25) that another program has found.
    """
    first = slices.worst_circle([soil(FACE, 3e3, 19.6)], (22.0, 34.0), (48.0, 68.0))
    assert first.factor == pytest.approx(0.987, rel=0.01)
    lane = soil([(0, 0), (40, 0), (40, 10), (20, 10)], 10e3, 20.0)
    assert slices.worst_circle([lane], (1e-6, 5.0), (18.0, 39.0)).factor == pytest.approx(1.380, rel=0.01)
    third = slices.worst_circle(acads_1c(), (22.0, 34.0), (48.0, 68.0))
    assert third.factor == pytest.approx(1.39, rel=0.01)
    there = slices.bishop(acads_1c(), 34.121, 43.254, 18.781, (29.702, 50.991))
    assert there == pytest.approx(1.405, rel=0.01) and there > third.factor


def test_a_mirrored_slope_has_the_same_factor():
    there = [slices.Soil(one.outline * (-1, 1), *list(vars(one).values())[1:]) for one in acads_1c()]
    circle = -34.121, 43.254, 18.781
    mine = slices.bishop(acads_1c(), 34.121, *circle[1:], (30.0, 50.9))
    assert slices.bishop(there, *circle, (-50.9, -30.0)) == pytest.approx(mine, rel=1e-9)


def test_it_has_no_unit_of_its_own():
    """Lengths 1,000 times as large, strengths as much, the same weight: the same factor."""
    small, large = (
        slices.bishop(
            [soil(np.multiply(FACE, k), 3e3 * k, 19.6)], 29.57 * k, 53.48 * k, 28.48 * k, (30.1 * k, 50.9 * k)
        )
        for k in (1.0, 1e3)
    )
    assert 0.9 < small < 1.1 and large == pytest.approx(small, rel=1e-9)


def test_the_ground_is_the_top_of_what_lies_there():
    x = (25.0, 40.0, 60.0, 19.0)
    assert slices.ground(acads_1c(), x) == pytest.approx([25.0, 30.0, 35.0, math.nan], nan_ok=True)


def test_what_is_no_slide_has_no_factor():
    level = soil([(-30, -20), (30, -20), (30, 0), (-30, 0)], 40e3, 20.0)
    assert slices.bishop([level], 0.0, 5.0, 10.0, (-8.0, 8.0)) == math.inf  # in balance by symmetry
    face = soil(FACE, 3e3, 19.6)
    assert slices.bishop([face], 30.0, 40.0, 30.0, (25.0, 55.0)) == math.inf  # it leaves the soil below
    assert slices.bishop([face], 40.0, 40.0, 5.0, (25.0, 55.0)) == math.inf  # no arc is so wide
    with pytest.raises(slices.SlicesError, match="no circle from x = 100 to 110 m up to 48 to 68 m"):
        slices.worst_circle([face], (100.0, 110.0), (48.0, 68.0))
