"""The statements of the paper's section 6 on made-up series whose numbers are known. Needs no YADE."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth.measure import force_stages  # noqa: E402

TIMES = {"t0": 10.0, "t1": 30.0, "t2": 34.0, "t3": 40.0, "t4": 55.0, "t5": 80.0}
T = np.arange(0, 1001) / 10
SAME = 1e-9  # rounding


def line(*points):
    return np.interp(T, *zip(*points))


def series(**columns):
    """A slope of friction 0.4 that does as the paper says, but for the toe that FB's friction holds down, and for a
    push on FB a quarter too large.
    """
    water = line((10, 0), (30, 200), (34, 200), (40, 0))
    held = line((10, 0), (30, 20), (34, 20))
    normal = 1000 + held + line((40, 0), (80, -600))
    effective = normal - water
    shear = np.where(T <= 34, 0.4 * effective, np.where(T <= 80, 16.0 + 8.0 * np.sign(np.sin(40 * T)), -12.0))
    push = np.where(
        T <= 30, 100 + 1.25 * (400.0 - shear), line((30, 190), (32, 200), (34, 194), (40, 190), (55, 400), (80, 200))
    )
    made = {
        "dp_normal_total": normal, "dp_normal_effective": effective, "dp_water": water, "dp_shear": shear, "fb_normal": push, "fb_shear": 0.5 * held,
        "fb_normal_peak": push * np.where((T >= 30) & (T <= 34), 1.03 + 0.04 * (np.abs(T - 32) < 0.05), 9.0),
    }  # fmt: skip
    speed = line((34, 0), (40, 8), (55, 30), (80, 0))
    return {f"{k}_N_per_m": v for k, v in made.items()} | {"time_s": T, "speed_mean_m_per_s": speed} | columns


def told(rows=None, times=TIMES, friction=0.4):
    rows = rows or series()
    return force_stages.statements(rows, times, friction, lambda name, end: float(np.interp(end, T, rows[name])))


def test_each_number_is_what_the_series_says():
    found = told()
    assert tuple(found) == force_stages.NAMES
    expected = {
        "normal_change": 0.02,
        "normal_change_by_backstop": 0.5,  # as made up
        "shear_drop": (400 - 0.4 * 820) / (0.4 * 200),
        "shear_share": 1.0,
        "backstop_rise": 1.25,
        "backstop_span": 10 / 190,
        "backstop_swing": 0.07,
        "backstop_fall": 6 / 200,
        "release_rise": 1020 / 820,
        "normal_fall": 420 / 1020,
        "shear_moving": pytest.approx(0.04, abs=2e-3),  # about 16 of 400, to the sines' odd count
        "backstop_final": 200 / 190,
        "shear_final": -0.03,
    }
    for name, value in expected.items():
        assert found[name] == (value if not isinstance(value, float) else pytest.approx(value, rel=SAME)), name
    # Pearson's of two straight pieces each, by NumPy
    moving = (T >= 40) & (T <= 80)
    s = series()
    momentum = (s["dp_normal_total_N_per_m"] * s["speed_mean_m_per_s"])[moving]
    assert found["backstop_momentum"] == pytest.approx(
        np.corrcoef(s["fb_normal_N_per_m"][moving], momentum)[0, 1], rel=SAME
    )


def test_a_foot_that_loses_its_strength_before_the_slope_accelerates_shows():
    """Its force falls by a quarter of the largest, 200, and recovers a little by t2; what was lower before the largest
    is no fall.
    """
    s = series()
    push = line((10, 100), (32, 200), (33, 150), (34, 160))
    assert told(s | {"fb_normal_N_per_m": push})["backstop_fall"] == pytest.approx(0.25, rel=SAME)
    assert told(s | {"fb_normal_N_per_m": line((10, 100), (34, 200))})["backstop_fall"] == 0.0


def test_a_slip_surface_that_keeps_its_friction_or_water_that_stays_shows():
    s = series()
    kept = told(s | {"dp_shear_N_per_m": 0.4 * s["dp_normal_effective_N_per_m"]})
    assert kept["shear_moving"] > 0.5 and kept["shear_final"] > 0.1
    water = np.where(T > 34, 200.0, s["dp_water_N_per_m"])
    wet = told(s | {"dp_water_N_per_m": water, "dp_normal_effective_N_per_m": s["dp_normal_total_N_per_m"] - water})
    assert wet["release_rise"] == pytest.approx(1.0, rel=SAME)


@pytest.mark.parametrize(
    "missing, left",
    [
        (("t0",), ()),
        (("t1", "t2", "t3", "t4", "t5"), ()),
        (("t2", "t3"), force_stages.NAMES[:5]),
        (("t3",), force_stages.NAMES[:8]),
        (("t5",), force_stages.NAMES[:9]),
    ],
)
def test_what_the_run_has_not_reached_has_no_number(missing, left):
    found = told(times=TIMES | dict.fromkeys(missing))
    assert tuple(name for name, value in found.items() if value is not None) == left


def test_a_slope_without_a_backstop_or_with_two_frictions_has_the_other_numbers():
    whole, free, two = (
        told(),
        force_stages.statements(
            series(), TIMES, 0.4, lambda name, end: float(np.interp(end, T, series()[name])), False
        ),
        told(friction=None),
    )
    without = {
        "normal_change_by_backstop",
        "backstop_rise",
        "backstop_span",
        "backstop_swing",
        "backstop_fall",
        "backstop_momentum",
        "backstop_final",
    }
    assert free == {name: None if name in without else value for name, value in whole.items()}
    assert two == {name: None if name in {"shear_drop", "shear_share"} else value for name, value in whole.items()}


def test_nothing_is_divided_by_nothing():
    s = series()
    still = told(
        {name: np.where(T >= 0, values[0], values[0]) for name, values in s.items() if name != "time_s"} | {"time_s": T}
    )
    assert [
        still[name] for name in ("normal_change_by_backstop", "shear_drop", "backstop_rise", "backstop_momentum")
    ] == [None] * 4


def test_the_water_is_halved_where_its_force_is_half_of_that_at_t2():
    assert force_stages.water_halved(series(), TIMES) == pytest.approx(3.0)
    assert force_stages.water_halved(series(), TIMES | {"t2": None}) is None
    stays = series(dp_water_N_per_m=np.where(T < 50, 200.0, 101.0))
    assert force_stages.water_halved(stays, TIMES) is None
    assert force_stages.water_halved(series(dp_water_N_per_m=0 * T), TIMES) is None
