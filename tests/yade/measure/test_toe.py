"""The passive strength of a slab's toe against sums done by hand. Needs no YADE."""
import dataclasses
import math
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import synthetic_slope as synthetic  # noqa: E402

results, section, toe = (synthetic.load(name) for name in ("studies.slope.results", "model.section", "measure.toe"))
SHIPPED = section.load("jiufengershan")
BETA = math.radians(21)
BULK = 2500 * 0.84 * 9.81  # N/m³


def test_push_and_resistance_of_the_dry_slab():
    found = toe.passive(SHIPPED, 88e3, 38.5, 0.84)
    # of the shipped section; looked for within a hundredth of the length
    assert found.thickness_m == pytest.approx(65, rel=1e-4)
    # the plane's ends are rounded
    assert found.push_dry == pytest.approx(BULK * SHIPPED.area * (math.sin(BETA) - 0.3 * math.cos(BETA)), rel=1e-5)
    k = math.tan(math.radians(45 + 38.5 / 2)) ** 2
    assert found.resistance_dry == pytest.approx(
        k * 0.5 * BULK * math.cos(BETA) * 65**2 + 2 * 88e3 * math.sqrt(k) * 65, rel=1e-4
    )


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


def board(dip, volume="disk", length=400.0, thick=20.0, size=1.0):
    """A rectangular slab on a plane that dips by ``dip`` degrees, to the left where that is negative; its foot is at
    (30, 7) m.
    """
    b, way = math.radians(abs(dip)), 1 if dip >= 0 else -1
    places = [
        (-s * math.cos(b) + n * math.sin(b), s * math.sin(b) + n * math.cos(b))
        for s, n in ((0, 0), (length, 0), (length, thick), (0, thick))
    ]
    foot = (size * 30.0, size * 7.0)
    layer = section.Layer("slab", "rock", tuple((foot[0] + size * way * x, foot[1] + size * y) for x, y in places))
    return dataclasses.replace(
        SHIPPED, layers=(layer,), water=dataclasses.replace(SHIPPED.water, point=foot, dip=dip, volume=volume)
    )


@pytest.mark.parametrize("dip", [20.0, -20.0])
@pytest.mark.parametrize("volume", ["disk", "bulk"])
@pytest.mark.parametrize("size", [1.0, 0.01])
@pytest.mark.parametrize("up, down", [(1, 0), (0.9, 0.2), (1, -0.2)])
def test_a_rectangular_slab_fails_where_a_quadratic_equation_says(dip, volume, size, up, down):
    """Push and resistance are polynomials of the height h: ½ K u h² + (μ u + v) L h + P(0) − R(0) = 0, with −∇p's parts
    u along the normal and v down the plane: ``up`` times γ_w cos β and ``down`` times γ_w sin β."""
    fraction, friction_deg, mu, length, thick, cohesion = 0.8, 35.0, 0.3, 400.0 * size, 20.0 * size, 20e3 * size
    b, k = math.radians(20.0), math.tan(math.radians(45 + friction_deg / 2)) ** 2
    bulk, lift = 2500 * fraction * 9.81, 9810 * math.cos(b) * (fraction if volume == "disk" else 1.0)
    push = bulk * length * thick * (math.sin(b) - mu * math.cos(b))
    resistance = k * bulk * math.cos(b) * thick**2 / 2 + 2 * cohesion * math.sqrt(k) * thick
    drag = down * lift * math.tan(b)
    lift *= up
    p, q = (mu + drag / lift) * length / k, 2 * (resistance - push) / (k * lift)
    height = -p + math.sqrt(p * p + q)
    assert 0.05 * thick < height < 0.95 * thick
    made = board(dip, volume, size=size)
    if (up, down) != (1, 0):  # of the flow along the plane, which a section has by name
        side, u, v = math.copysign(1, dip), up * 9810 * math.cos(b), down * 9810 * math.sin(b)
        gradient = (-side * (u * math.sin(b) + v * math.cos(b)), -(u * math.cos(b) - v * math.sin(b)))
        made = dataclasses.replace(made, water=dataclasses.replace(made.water, pressure_gradient=gradient))
    found = toe.passive(made, cohesion, friction_deg, fraction)
    assert found.thickness_m == pytest.approx(thick, rel=1e-9)  # rounding of turned vertices
    assert (found.push_dry, found.resistance_dry) == pytest.approx((push, resistance), rel=1e-8)
    assert found.water_m == pytest.approx(height, rel=1e-7) and found.push_N_per_m == pytest.approx(
        push + (mu * lift + drag) * length * height, rel=1e-7
    )


def test_the_toe_is_the_lower_end():
    """A slab that is thinner at its crown has its thickness where it is held, whichever way it dips."""
    for dip in (20.0, -20.0):
        made = board(dip)
        wedge = dataclasses.replace(
            made,
            layers=(
                dataclasses.replace(made.layers[0], vertices=made.layers[0].vertices[:2] + made.layers[0].vertices[3:]),
            ),
        )
        # 20 m at the foot, nothing at the crown; looked for within a hundredth of the length
        assert toe.passive(wedge, 20e3, 35.0, 0.8).thickness_m == pytest.approx(20.0, rel=0.02)
