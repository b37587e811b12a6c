"""The passive strength of a slab's toe against sums done by hand."""
import dataclasses
import math

import pytest
from yade.nonsmooth import results, section, toe

SHIPPED = section.load("jiufengershan")
BETA = math.radians(21)
BULK = 2500 * 0.84 * 9.81  # N/m³


def test_push_and_resistance_of_the_dry_slab():
    found = toe.passive(SHIPPED, 88e3, 38.5, 0.84)
    assert found.thickness_m == pytest.approx(65, rel=1e-4)  # of the shipped section; looked for within a hundredth of the length
    assert found.push_dry == pytest.approx(BULK * SHIPPED.area * (math.sin(BETA) - 0.3 * math.cos(BETA)), rel=1e-5)  # the plane's ends are rounded
    k = math.tan(math.radians(45 + 38.5 / 2)) ** 2
    assert found.resistance_dry == pytest.approx(k * 0.5 * BULK * math.cos(BETA) * 65**2 + 2 * 88e3 * math.sqrt(k) * 65, rel=1e-4)


def test_the_toe_fails_where_water_makes_push_and_resistance_equal():
    found = toe.passive(SHIPPED, 88e3, 38.5, 0.84)
    h, k = found.water_m, math.tan(math.radians(45 + 38.5 / 2)) ** 2
    lift = 9810 * math.cos(BETA) * 0.84
    assert found.push_N_per_m == pytest.approx(found.resistance_dry - 0.5 * k * lift * h**2, rel=1e-4)
    # below the table lies a strip of the slab's length, 1,500 m, but for its upper end, which is cut at 45°
    assert found.push_N_per_m - found.push_dry == pytest.approx(0.3 * lift * h * (1500 - h / 2), rel=0.01)
    assert 18 < h < 20


def test_a_toe_that_never_or_always_fails_has_no_height():
    assert toe.passive(SHIPPED, 1e9, 38.5, 0.84).water_m is None
    assert toe.passive(SHIPPED, 0.0, 15.0, 0.84).water_m is None
    with pytest.raises(ValueError, match="no slab"):
        toe.passive(dataclasses.replace(SHIPPED, water=None), 88e3, 38.5, 0.84)


def test_a_run_is_set_beside_its_toe_by_height_and_by_force():
    envelope = SHIPPED.materials["rock"].envelope
    found = toe.passive(SHIPPED, envelope.cohesion, envelope.friction_deg, 0.84)
    told = results._passive(SHIPPED, 0.84, 20.0, 200e6)
    assert told["water_passive_m"] == found.water_m and told["passive_force_N_per_m"] == found.push_N_per_m
    assert told["water_at_failure_over_passive"] == pytest.approx(20.0 / found.water_m, rel=1e-12)  # rounding
    assert told["fb_force_at_failure_over_passive"] == pytest.approx(200e6 / found.push_N_per_m, rel=1e-12)
    stood = results._passive(SHIPPED, 0.84, None, None)
    assert stood["water_at_failure_over_passive"] is None and stood["fb_force_at_failure_over_passive"] is None
