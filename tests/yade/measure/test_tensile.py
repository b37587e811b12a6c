"""Tensile strength, breaks, weakest cuts and vertical cuts from made-up data whose answers are known. Needs no YADE."""

import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import synthetic_slope as synthetic  # noqa: E402

fracture, tensile, vertical, weakest_cut = (
    synthetic.load(f"measure.{name}") for name in ("fracture", "tensile", "vertical_cut", "weakest_cut")
)


# ---- curves ---------------------------------------------------------------------------------------


def series_of(opening, stress, apart=0.0, height=50.0):
    opening, stress = np.asarray(opening, float), np.asarray(stress, float)
    work = np.cumsum(stress * np.diff(opening, prepend=0.0)) * 4.0
    return {
        "opening_m": opening,
        "strain": opening / height,
        "tension_top_Pa": stress + apart,
        "tension_bottom_Pa": stress - apart,
        "work_J": work,
    }


def test_a_peak_is_a_mean_over_a_tenth_of_what_bonds_yield():
    """Rows of 1 mm; 90 kPa, with one row of 130 kPa and ten of 100 kPa, which are the peak: bonds yield over 0.1 m."""
    opening = 1e-3 * np.arange(1, 201)
    stress = np.full(200, 90e3)
    stress[20], stress[60:70] = 130e3, 100e3
    found = tensile.curve(series_of(opening, stress, apart=500.0), 0.1, 4.0)
    assert found.peak == pytest.approx(100e3, rel=1e-12)
    assert found.opening == pytest.approx(0.065) and found.strain == pytest.approx(0.065 / 50)
    assert found.end_rel == pytest.approx(0.9) and found.imbalance == pytest.approx(0.01)
    assert found.work == pytest.approx((189 * 90e3 + 130e3 + 10 * 100e3) * 1e-3)
    with pytest.raises(ValueError, match="ended at an opening of 0.005 m, before 0.01 m"):
        tensile.curve(series_of(opening[:5], stress[:5]), 0.1, 4.0)


# ---- breaks ---------------------------------------------------------------------------------------


def grid(columns, rows, slope=0.0):
    """Unit disks on a grid whose rows rise by ``slope``; bonds to the right and up; those that cross the middle."""
    i, k = (v.ravel() for v in np.meshgrid(np.arange(columns), np.arange(rows)))
    number = i + columns * k
    right = [(n, n + 1) for n, a in zip(number, i) if a < columns - 1]
    up = [(n, n + columns) for n, b in zip(number, k) if b < rows - 1]
    half = rows // 2
    crossing = [(a, b) for a, b in up if a // columns == half - 1]
    whole = right + [pair for pair in up if pair not in crossing]
    return i + 0.0, k + slope * i, np.full(len(i), 0.5), whole, crossing


@pytest.mark.parametrize("slope, angle", [(0.0, 0.0), (0.5, 26.565), (-0.5, -26.565)])
def test_a_break_has_its_place_and_inclination(slope, angle):
    x, y, r, whole, crossing = grid(9, 8, slope)
    scattered = whole[5]  # breaks within the lower piece
    found = fracture.find(x, y, r, [pair for pair in whole if pair != scattered], [*crossing, scattered])
    assert found.angle_deg == pytest.approx(angle, abs=1e-3) and found.thickness == pytest.approx(0, abs=1e-6)
    assert (found.x, found.y) == pytest.approx((4.0, 3.5 + 4 * slope)) and found.through
    assert (found.bonds, found.share) == (9, pytest.approx(0.9))


def test_a_band_is_as_thick_as_its_broken_bonds_scatter():
    """Uniform over 2 d: their standard deviation times √12."""
    dice = np.random.default_rng(1)
    n = 4000
    x, y = dice.uniform(0, 100, n), np.repeat(dice.uniform(-1, 1, n // 2), 2)
    x[1::2] = x[::2]
    found = fracture.find(x, y, np.full(n, 0.5), [], np.arange(n).reshape(-1, 2))
    assert found.thickness == pytest.approx(2.0, rel=0.03) and found.angle_deg == pytest.approx(0, abs=0.2)


def test_small_disks_count_less_and_lie_nearer_to_their_bond():
    """Bonds 1 m above and 2 m below by hand, of disks of 3 and 1 m, and of 1 m both."""
    x, y, r = [0, 0, 9, 9], [0.0, 2.0, -2.5, -1.5], [1.5, 0.5, 0.5, 0.5]
    found = fracture.find(x, y, r, [], [(0, 1), (2, 3)])
    # at 1.5 with the weight 2, at −2 with the weight 1
    assert found.y == pytest.approx((2 * 1.5 - 2.0) / 3) and found.x == pytest.approx(3.0)


def test_a_sample_in_one_piece_has_all_its_broken_bonds_and_one_break_has_no_line():
    x, y, r, whole, crossing = grid(4, 4)
    found = fracture.find(x, y, r, whole + crossing[1:], [*crossing[:1], whole[-1]])
    assert not found.through and found.bonds == 2 and found.share == 1
    assert fracture.find(x, y, r, whole, crossing[:1]) is None


# ---- weakest cuts ---------------------------------------------------------------------------------


def test_the_weakest_cut_of_a_grid_is_its_weakest_row():
    x, y, r, whole, crossing = grid(6, 8)
    bonds, n = np.array(whole + crossing), 48
    strengths = np.where(np.arange(len(bonds)) < len(whole), 3.0, 2.0)
    found = weakest_cut.find(x, y, bonds, strengths, 0.3, np.arange(6), np.arange(n - 6, n))
    assert found.force == pytest.approx(6 * 2.0, rel=1e-4)
    assert sorted(map(tuple, bonds[found.bonds])) == sorted(crossing)
    with pytest.raises(ValueError, match="a platen holds no disk"):
        weakest_cut.find(x, y, bonds, strengths, 0.3, [], [1])


def test_a_bond_counts_with_its_component_along_the_pull_and_jams_where_it_would_slip():
    """Two disks below one: bonds at 30° to the pull; with more friction than tan 60° they jam."""
    x, y = [0.0, 1.0, 0.5], [0.0, 0.0, math.sqrt(0.75)]

    def find(mu):
        return weakest_cut.find(x, y, [(0, 2), (2, 1)], [5.0, 5.0], mu, [0, 1], [2])

    assert find(0.3).force == pytest.approx(2 * 5 * math.sqrt(0.75), rel=1e-4) and len(find(0.3).bonds) == 2
    assert find(1.8).force > 1e4 and find(1.7).force == find(0.3).force


def test_a_cut_may_go_up_and_down_but_closes_no_bond():
    """Three columns: the weak bond of the middle one stands higher. A flat cut must take a strong one; one that steps
    up between the columns, which no bond holds, takes the weak ones.
    """
    x, y = np.repeat(np.arange(3.0), 4), np.tile(np.arange(4.0), 3)
    up = [(4 * c + k, 4 * c + k + 1) for c in range(3) for k in range(3)]
    strengths = [1.0 if (c, k) in ((0, 0), (1, 2), (2, 0)) else 4.0 for c in range(3) for k in range(3)]
    ends = [0, 4, 8], [3, 7, 11]
    assert weakest_cut.find(x, y, up, strengths, 0.3, *ends).force == pytest.approx(3.0, rel=1e-4)
    # a bond from the middle's lower part down to the left's upper part would close there
    aslant = [*up, (1, 6)]
    assert weakest_cut.find(x, y, aslant, [*strengths, 0.0], 0.3, *ends).force == pytest.approx(6.0, rel=1e-4)


# ---- vertical cuts --------------------------------------------------------------------------------


def test_a_cut_of_known_height():
    """c = 85.9 kPa, φ = 37.2°, γ = 20.6 kN/m³: the plane's height is 33.6 m (the facts); half of it without tensile
    strength, and the log spiral's with much of it.
    """

    def cut(t):
        return vertical.vertical_cut(85.9e3, 37.2, t, 20.6e3)

    none, much = cut(0.0), cut(100e3)
    assert none.plane == pytest.approx(33.6, abs=0.05)
    assert (none.height, none.crack, none.cracked) == (none.plane / 2, none.plane / 2, True)
    assert (much.height, much.crack, much.cracked) == (pytest.approx(0.966 * none.plane), 0.0, False)
    # each kPa that tears less shortens the crack by 1/(γ K_a)
    k = math.tan(math.radians(45 + 37.2 / 2)) ** 2
    assert cut(40e3).crack == pytest.approx(none.crack - 40e3 * k / 20.6e3, rel=1e-12)
    # at its tip Rankine's active stress is the tensile strength
    tip = cut(40e3).crack
    assert 20.6e3 * tip / k - 2 * 85.9e3 / math.sqrt(k) == pytest.approx(-40e3, rel=1e-12)


@pytest.mark.parametrize("phi", [0.0, 20.0, 37.2])
@pytest.mark.parametrize("tension", [0.0, 15e3])
def test_no_wedge_behind_a_crack_slips_at_a_smaller_height(phi, tension):
    """The balance of forces on wedges of all inclinations: the least height is at 45° + φ/2, and the formula's."""
    c, gamma = 60e3, 21e3
    found = vertical.vertical_cut(c, phi, tension, gamma)
    angle, friction = np.radians(np.linspace(phi + 5, 89, 4001)), math.radians(phi)
    # γ (H² − z²)/2 cot θ sin(θ − φ) = c (H − z)/sin θ cos φ
    heights = 2 * c * math.cos(friction) / (gamma * np.cos(angle) * np.sin(angle - friction)) - found.crack
    assert heights.min() == pytest.approx(found.plane - found.crack, rel=1e-6)
    assert np.degrees(angle[np.argmin(heights)]) == pytest.approx(45 + phi / 2, abs=0.05)
    assert found.height == pytest.approx(min(heights.min(), 0.966 * found.plane), rel=1e-6)


def test_heights_scale_with_strength_over_weight():
    one, other = vertical.vertical_cut(50e3, 35, 20e3, 20e3), vertical.vertical_cut(100e3, 35, 40e3, 10e3)
    assert (other.height, other.crack) == pytest.approx((4 * one.height, 4 * one.crack), rel=1e-12)


@pytest.mark.parametrize(
    "values, told",
    [
        ((0, 35, 0, 2e4), "cohesion 0: give a cohesion above 0 in Pa"),
        ((5e4, 90, 0, 2e4), "friction_deg 90: give degrees, from 0 to below 90"),
        ((5e4, 35, -1, 2e4), "tensile_strength -1: give a strength from 0 to c cot φ = 7.141e.04 Pa"),
        ((5e4, 35, 8e4, 2e4), "tensile_strength 80000.0: give a strength from 0"),
        ((5e4, 35, 0, float("nan")), "unit_weight nan: give a weight above 0"),
        (("1", 35, 0, 2e4), "cohesion '1': give a cohesion"),
    ],
)
def test_strengths_without_sense_are_one_message(values, told):
    with pytest.raises(vertical.VerticalCutError, match=told):
        vertical.vertical_cut(*values)
    assert vertical.vertical_cut(5e4, 0, 1e9, 2e4).height == pytest.approx(0.966 * 10)  # without friction no apex
