"""Fluctuations of stress, contractions and breaks of biaxial tests, from made-up series. Needs no YADE."""

import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth.measure import fluctuations  # noqa: E402

STRAIN = 1e-4 * np.arange(1, 1001)  # to 10 %


def test_a_sine_of_stress_fluctuates_by_its_amplitude_over_root_two():
    """5 % of a stress that rises slowly, twenty waves a per cent: the mean over a per cent takes none of it out; to 2
    %, whole waves and the ends.
    """
    stress = 8e6 * (1 + 2 * STRAIN) * (1 + 0.05 * np.sin(2 * math.pi * STRAIN / 5e-4))
    assert fluctuations.fluctuation(STRAIN, stress) == pytest.approx(0.05 / math.sqrt(2), rel=0.02)
    assert (
        fluctuations.fluctuation(STRAIN, 8e6 * (1 + 2 * STRAIN)) < 1e-5
    )  # a straight line is its own mean, to half a row
    assert math.isnan(fluctuations.fluctuation(STRAIN[:50], stress[:50]))


@pytest.mark.parametrize("end", [0, -1])
def test_rows_count_up_to_the_middle_of_the_outermost_windows(end):
    """Twenty rows of 0.3 % of strain, of which one has a tenth more: the first, or the last, that lies between the
    middles of two windows. A window holds three and a third of them, so that it is off its mean by 0.07, and its
    neighbours by 0.03."""
    strain = 3e-3 * np.arange(1, 21)
    middle = strain[0] + 0.5 * fluctuations.WINDOW + 3e-3 * np.arange(16)  # while a window ends by the last row
    inside = np.flatnonzero((strain > middle[0]) & (strain < middle[-1]))
    stress = np.full(20, 10.0)
    stress[inside[end]] = 11.0
    assert fluctuations.fluctuation(strain, stress) > math.hypot(0.05, 0.02) / math.sqrt(len(inside))
    assert fluctuations.fluctuation(strain, np.full(20, 10.0)) < 1e-12


def test_contractions_are_falls_of_more_than_the_least():
    volume = np.array([0, 1, 2, 3, 1.5, 1.45, 2, 4, 3.95, 4.2, 5, 2.0, 2.05, 1.0])
    # from 3 to 1.45, not the dip by 0.05, and one with a ripple that goes on at the end
    assert fluctuations.contractions(volume, 0.1) == [(3, 5), (10, 13)]
    assert fluctuations.contractions(volume, 2.0) == [(10, 13)] and fluctuations.contractions(np.arange(9.0), 0.1) == []
    assert fluctuations.contractions(-np.arange(9.0), 0.1) == [(0, 8)]


def series():
    """Four contractions of 1.5 areas of a disk on the plateau from 5 to 10 %, three of them with a fall of stress; one
    before.
    """
    volume, stress = 2 * STRAIN.copy(), np.full(1000, 20e6)
    for k, drops in ((200, True), (520, True), (640, True), (760, True), (880, False)):
        volume[k : k + 10] -= np.linspace(0, 1, 10) * (1.5e-3 + 2e-4 * 9 * 10 / 9)  # the rise of ten rows besides
        volume[k + 10 :] -= 1.5e-3 + 2e-4 * 10
        stress[k + 5 : k + 10] *= 0.9 if drops else 1.1
    broken = {f"bonds_broken_{mode}": np.full(1000, float(n)) for mode, n in zip(fluctuations.MODES, (10, 60, 25, 5))}
    return {
        "strain": STRAIN, "volumetric_strain": volume, "sigma1_top_Pa": stress, "sigma1_bottom_Pa": stress, **broken,
    }  # fmt: skip


def test_what_a_test_says_of_its_plateau():
    found = fluctuations.measure(series(), (0.05, 0.1), 2000.0, 2.0)  # a disk is a thousandth of the sample
    assert found["contractions_per_percent"] == pytest.approx(4 / 5, rel=0.01)
    # rows on either side of a fall are of the slope: a tenth of a disk
    assert found["contraction_disks"] == pytest.approx(1.5, abs=0.4) and found["contraction_with_drop"] == 0.75
    assert found["broken_shares"] == pytest.approx({"tension": 0.1, "shear": 0.6, "torque": 0.25, "mixed": 0.05})
    assert 0.01 < found["stress_fluctuation_rel"] < 0.03  # by a tenth in a fiftieth of the rows


def test_a_test_without_breaks_contractions_or_plateau_has_no_numbers_of_them():
    still = {
        name: np.zeros(1000) if name.startswith("bonds") else values
        for name, values in (series() | {"volumetric_strain": STRAIN}).items()
    }
    found = fluctuations.measure(still, (0.05, 0.1), 2000.0, 2.0)
    assert (
        found["contraction_disks"] is None and found["contraction_with_drop"] is None and found["broken_shares"] is None
    )
    assert found["contractions_per_percent"] == 0
    short = fluctuations.measure(still, (0.2, 0.4), 2000.0, 2.0)
    assert short["stress_fluctuation_rel"] is None and short["contractions_per_percent"] is None
    # one row covers no strain
    assert fluctuations.measure(still, (0.05, 0.05), 2000.0, 2.0)["contractions_per_percent"] is None
