"""Characteristic times of a run, from a made-up series whose events are known."""

import numpy as np
import pytest

from yade.nonsmooth import results, section

ROW = 0.1  # s


def series(failure=30.0, weakening=35.0, backstop=True):
    """N_FB rises by 3 MN/m a second from 140 until `failure`, then stays; D_c is reached at `weakening`, when T_DP begins to fall
    by half a second; the speed peaks at 55 s and is back at zero at 85 s."""
    t = ROW * np.arange(1001)
    rise = 3e6 * np.clip(t - 10, 0, failure - 10)
    return {
        "time_s": t, "fb_normal_N_per_m": (140e6 + rise) * backstop,
        "dp_shear_N_per_m": (440e6 - rise) * np.where(t > weakening, 0.5 ** ((t - weakening) / 0.5), 1.0),
        "weakened_disks": np.where(t >= weakening - 1e-9, 400, 0), "energy_kinetic_J": np.interp(t, [35, 55, 85], [0, 1, 0]),
        "speed_mean_m_per_s": np.interp(t, [30, 55, 85], [0, 30, 0]),
    }


@pytest.fixture(scope="module")
def slope():
    return section.load("jiufengershan")


def test_times_of_a_whole_run(slope):
    times = results.characteristic_times(series(), slope, {"t0": 10.0, "moving": 30.5})
    # 2 % below 200 MN/m is 4/3 s of the rise; a mean over 1 s lags by 0.45 s
    assert times["t1"] == pytest.approx(30 - 4 / 3 + 0.45, abs=ROW)
    assert times["t2"] == pytest.approx(35, abs=1e-9)
    # a tenth after 3.32 half lives; the mean over 1 s of an exponential of half life 0.5 s lags by 0.55 s
    assert times["t3"] == pytest.approx(35 + 0.5 * np.log2(10) + 0.55, abs=2 * ROW)
    assert times["t4"] == pytest.approx(55, abs=1e-9)
    assert times["t5"] == pytest.approx(85 - 0.02 * 30, abs=2 * ROW)  # 2 % of the peak, 30 s before nothing


def test_a_slope_that_does_not_move_has_no_failure(slope):
    times = results.characteristic_times(series(), slope, {"t0": 10.0, "moving": None})
    assert times == {"t0": 10.0, "t1": None, "t2": None, "t3": None, "t4": None, "t5": None}


def test_without_backstop_failure_is_motion(slope):
    times = results.characteristic_times(series(backstop=False), slope, {"t0": 10.0, "moving": 30.5})
    assert times["t1"] == 30.5


def test_stopped_before_weakening(slope):
    short = {name: values[:340] for name, values in series().items()}  # until 34 s
    times = results.characteristic_times(short, slope, {"t0": 10.0, "moving": 30.5})
    assert times["t1"] == pytest.approx(30 - 4 / 3 + 0.45, abs=ROW) and times["t2"] is None and times["t5"] is None
