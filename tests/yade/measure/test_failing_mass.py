"""Which disks fail, of made-up displacements. Needs no YADE."""

import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import synthetic_slope as synthetic  # noqa: E402

failing_mass = synthetic.load("measure.failing_mass")


def test_a_block_that_slides_over_ground_that_stays():
    way = np.r_[np.full(60, 0.5), np.full(140, 1e-4)]
    assert failing_mass.failing(way).tolist() == [True] * 60 + [False] * 140


def test_one_disk_that_falls_far_is_not_all_that_fails():
    way = np.r_[50.0, np.full(399, 0.5), np.full(600, 0.001)]  # 0.1 % of them
    assert failing_mass.failing(way).sum() == 400


def test_a_disk_counts_from_a_fifth_of_the_fastest_on():
    way = np.r_[np.ones(50), 0.21, 0.19, np.zeros(48)]
    assert failing_mass.failing(way)[50:52].tolist() == [True, False]


def test_what_stays_all_of_it_does_not_fail():
    assert not failing_mass.failing(np.zeros(5)).any() and len(failing_mass.failing([])) == 0


def test_a_way_is_the_distance_of_two_places():
    def at(x, y):
        return SimpleNamespace(x=np.array(x, float), y=np.array(y, float))

    assert failing_mass.ways(at([0, 1], [0, 1]), at([3, 1], [-4, 1])).tolist() == [5.0, 0.0]
