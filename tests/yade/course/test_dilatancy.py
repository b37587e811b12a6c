"""Which share of the pressure dilatancy releases, by the rules of the course. Needs no YADE."""

import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth.course import dilatancy  # noqa: E402

NONE = np.zeros(1)


def after(*looks, drainage_time=None, whole=0.04):
    """The released share after looks of (dilation, seconds since the one before)."""
    share, largest, told = NONE, NONE, []
    for now, seconds in looks:
        share, largest = dilatancy.released(share, largest, np.array([now]), whole, seconds, drainage_time)
        told.append(float(share[0]))
    return told


def test_dilation_is_the_fall_of_the_area_share():
    found = dilatancy.dilation(np.array([0.8, 0.76, 0.84]), np.array([0.8, 0.8, 0.8]))
    assert found == pytest.approx([0, 0.05, -0.05], abs=1e-15)


def test_a_disk_that_stands_alone_then_or_now_holds_no_pressure():
    assert dilatancy.dilation(np.array([0.0, 0.8, 0.0]), np.array([0.8, 0.0, 0.0])).tolist() == [1, 1, 1]


def test_released_is_the_dilation_by_that_which_releases_all():
    assert after((0.01, 1.0)) == [pytest.approx(0.25)] and after((0.04, 1.0)) == [1.0] and after((0.2, 1.0)) == [1.0]
    assert after((-0.1, 1.0)) == [0.0]


def test_it_never_falls_without_drainage():
    assert after((0.01, 1), (0.03, 1), (-0.02, 1), (0.02, 1)) == pytest.approx([0.25, 0.75, 0.75, 0.75])


def test_what_is_released_already_stays_where_no_dilation_is_known():
    """A share that a disk has from elsewhere is not taken back."""
    share, largest = dilatancy.released(np.array([0.6]), NONE, np.array([0.01]), 0.04)
    assert share == 0.6 and largest == 0.01
    # nor does water come back in a look that took no time
    share, _ = dilatancy.released(np.array([0.6]), np.array([0.01]), np.array([0.01]), 0.04, drainage_time=2.0)
    assert share == 0.6


def test_water_flows_back_in_the_drainage_time():
    fall = math.exp(-0.5)
    told = after((0.02, 1.0), (0.02, 1.0), (0.01, 1.0), drainage_time=2.0)
    assert told == pytest.approx([0.5, 0.5 * fall, 0.5 * fall**2], rel=1e-14)
    # new dilation counts from the largest that there was
    told = after((0.02, 1.0), (0.01, 1.0), (0.03, 1.0), (0.2, 1.0), drainage_time=2.0)
    assert told[2:] == pytest.approx([0.5 * fall**2 + 0.25, (0.5 * fall**2 + 0.25) * fall + 0.25], rel=1e-14)


def test_a_long_drainage_time_is_none_and_a_short_one_releases_little():
    looks = [(0.001 * k, 0.1) for k in range(1, 40)]
    assert after(*looks, drainage_time=1e9) == pytest.approx(after(*looks), rel=1e-6)
    assert max(after(*looks, drainage_time=0.01)) < 0.03
    assert all(0 <= share <= 1 for share in after(*[(0.02 * k, 0.0) for k in range(9)], drainage_time=1.0))
