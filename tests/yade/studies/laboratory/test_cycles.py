"""Cycles of stress in made-up biaxial tests whose rises and drops are known. Needs no YADE."""

import numpy as np
import pytest

import synthetic_slope as synthetic

cycles = synthetic.load("measure.cycles")
STRAIN = 1e-4 * np.arange(1, 1001)  # to 10 %


def test_a_cycle_is_a_rise_and_a_drop_of_more_than_the_least():
    stress = np.array([5, 5.2, 5.1, 8, 7.9, 8.5, 6, 6.2, 5.5, 5.7, 7.0, 6.3, 4, 9.0])
    # ripples within both phases are theirs; from 8.5 to 6 is four fifths of the drop to 5.5; the last rise has no drop
    assert cycles.find(stress, 0.5) == [cycles.Cycle(0, 5, 6), cycles.Cycle(8, 10, 12)]
    assert cycles.find(stress, 1.9) == [cycles.Cycle(0, 5, 6)]  # to whose fall the rise of 1.5 belongs now
    assert cycles.find(stress, 5.0) == [] and cycles.find(np.arange(9.0), 0.5) == []
    # a fall at the beginning has no rise before it, one at the end may go on
    assert cycles.find([9.0, 5, 6, 8, 7], 0.5) == [cycles.Cycle(1, 3, 4)]


def test_the_drop_is_the_steepest_part_of_a_fall():
    """A slow fall by 2, a drop by 5 within three rows, and a slow one again: four fifths and more of what five rows
    have are in two rows. What falls slowly alone is no cycle.
    """
    slowly = np.linspace(0, -2, 21)
    stress = np.concatenate([[5, 11], 11 + slowly, [8.7, 6, 4], 4 + slowly, [9]])
    assert cycles.find(stress, 0.6) == [cycles.Cycle(0, 23, 25)]
    assert cycles.find(np.concatenate([[5, 11], 11 + slowly, [12]]), 0.6) == []  # 0.5 within five rows
    # it is one of the rise that follows
    assert cycles.find(np.concatenate([[5, 11], 11 + slowly, [12, 5]]), 0.6) == [cycles.Cycle(0, 23, 24)]


def series(build=40, drop=2, rise=2e6, dilates=lambda k: True, contracts=lambda k: True):
    """A deviator stress of 20 MPa to 5 %, then cycles of ``build`` and ``drop`` rows, ``rise`` high; the kinetic energy
    is 1 J, and 9 J in drops. The volume grows by 0.02 % and falls by 0.01 % in those cycles, by their number, that
    dilate and contract, and the other way round in others."""
    stress, volume, energy = np.full(1000, 20e6), np.zeros(1000), np.ones(1000)
    k, row, level = 0, 500, 0.0
    while row + build + drop < 1000:
        up, down = slice(row, row + build), slice(row + build, row + build + drop)
        stress[up] += np.linspace(0, rise, build + 1)[1:]
        stress[down] += np.linspace(rise, 0, drop + 1)[1:]
        top = level + (2e-4 if dilates(k) else -2e-4)
        volume[up] = np.linspace(level, top, build + 1)[1:]
        level = top - (1e-4 if contracts(k) else -1e-4)
        volume[down] = np.linspace(top, level, drop + 1)[1:]
        energy[down] = 9.0
        k, row = k + 1, row + build + drop
    stress[row:] += 0.1e6  # too little for another one, and no lower than the last
    volume[row:] = level
    return {
        "strain": STRAIN, "volumetric_strain": volume, "energy_kinetic_J": energy, "sigma1_top_Pa": stress + 9e6, "sigma1_bottom_Pa": stress + 7e6,
        "sigma3_left_Pa": np.full(1000, 8.5e6), "sigma3_right_Pa": np.full(1000, 7.5e6),
    }  # fmt: skip


def test_numbers_of_cycles_are_those_that_were_made():
    """Eleven cycles of 42 rows, 0.42 % of strain each, on a plateau of 5 %."""
    made = series()
    assert cycles.deviator(made)[:500] == pytest.approx(20e6)
    found = cycles.measure(made, (0.05, 0.1))
    assert tuple(found) == cycles.NUMBERS
    mean = 20e6 + np.mean(cycles.deviator(made)[499:] - 20e6)
    expected = {
        "cycles_per_percent": 11 / 5,
        "cycle_build_strain": 40e-4,
        "cycle_drop_strain": 2e-4,
        "cycle_drop_rel": 2e6 / mean,
        "cycle_dilates": 1.0,
        "cycle_contracts": 1.0,
        # in seven rows: from six before the peak to the row after it, of each cycle
        "cycle_contracts_by_chance": 11 * 8 / 494,
        "cycle_both": 1.0,
        "cycle_energy_build_rel": 1 / np.mean(made["energy_kinetic_J"][499:]),
        "cycle_energy_drop_rel": (2 * 9 + 5) / 7 / np.mean(made["energy_kinetic_J"][499:]),  # and five rows after it
    }
    assert found == pytest.approx(expected, rel=1e-9)  # rounding


def test_shares_are_those_of_the_cycles_that_do_so():
    """Of eleven cycles four do not dilate (0, 3, 6, 9) and two do not contract (3 and 4)."""
    found = cycles.measure(series(dilates=lambda k: k % 3 > 0, contracts=lambda k: k not in (3, 4)), (0.05, 0.1))
    assert found["cycle_dilates"] == pytest.approx(7 / 11) and found["cycle_contracts"] == pytest.approx(9 / 11)
    assert found["cycle_both"] == pytest.approx(6 / 11)


def test_small_waves_are_no_cycles_and_a_test_of_earlier_versions_has_no_energy():
    still = cycles.measure(series(rise=0.049 * 20e6), (0.05, 0.1))  # below 5 % of the mean
    assert still == dict.fromkeys(cycles.NUMBERS) | {"cycles_per_percent": 0.0}
    assert cycles.measure(series(rise=0.055 * 20e6), (0.05, 0.1))["cycles_per_percent"] == pytest.approx(11 / 5)
    old = {name: values for name, values in series().items() if name != "energy_kinetic_J"}
    found = cycles.measure(old, (0.05, 0.1))
    assert found["cycle_energy_drop_rel"] is None and found["cycle_both"] == 1.0
    assert cycles.measure(old, (0.2, 0.4)) == dict.fromkeys(cycles.NUMBERS)


def test_the_deepest_drop_between_two_strains_is_shown():
    made = series()
    for platen in ("top", "bottom"):
        made[f"sigma1_{platen}_Pa"][667:669] -= 1e6  # the lowest rows after the fourth peak, at 6.7 %
    assert cycles.deepest(made, 0.05, 0.1) == cycles.Cycle(625, 665, 667)
    # from a strain after that drop on, in the middle of a rise; all drops there are alike, to rounding
    found = cycles.deepest(made, STRAIN[699], 0.1)
    assert (found.peak - 707) % 42 == 0 and found.end == found.peak + 2 and found.begin in (699, found.peak - 40)
    assert cycles.deepest(made, 0.01, 0.04) is None and cycles.deepest(made, 0.2, 0.3) is None
