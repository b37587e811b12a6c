"""Measures of triaxial tests, from contacts, places and curves that are known. Needs no YADE."""
import math

import numpy as np
import pytest
import synthetic_slope as synthetic

measures, columns = (synthetic.load(name) for name in ("measure.triaxial", "studies.spheres.columns"))


def test_the_stress_of_a_lattice_under_unequal_forces():
    """Per sphere of a cubic lattice with the spacing a one contact along each axis, of the force F_k: σ_k = F_k/a²."""
    a, force = 0.2, np.diag([3.0, 5.0, 7.0])
    found = measures.stress(np.tile(force, (10, 1)), np.tile(a * np.eye(3), (10, 1)), 10 * a**3)
    assert found == pytest.approx(np.diag([3.0, 5.0, 7.0]) / a**2, rel=1e-12)
    # a shear force along x at a contact along z is the shear stress on the face across z
    sheared = measures.stress([[2.0, 0, 0]], [[0, 0, a]], a**3)
    assert sheared[0, 2] == pytest.approx(2 / a**2, rel=1e-12) and np.count_nonzero(sheared) == 1


def test_spheres_that_faces_cut_count_with_what_is_within():
    """A sphere in the middle, one cut in half by a face, one at a corner (an eighth), and one outside."""
    at = [(0.5, 0.5, 0.5), (1.0, 0.5, 0.5), (1.0, 1.0, 1.0), (1.3, 0.5, 0.5)]
    r = np.full(4, 0.2)
    volume = 4 / 3 * math.pi * 0.2**3
    found = measures.solid_fraction(at, r, np.zeros(3), np.ones(3))
    assert found == pytest.approx(volume * (1 + 1 / 2 + 1 / 8), rel=1e-12)
    # a cap of the height h = r/2 has π h² (3 r − h)/3
    cap = math.pi * 0.1**2 * (0.6 - 0.1) / 3
    assert measures.solid_fraction([(1.1, 0.5, 0.5)], [0.2], (0, 0, 0), (1, 1, 1)) == pytest.approx(cap, rel=1e-12)


def test_the_fraction_of_a_lattice_does_not_depend_on_where_the_box_lies():
    """Over all places of a box of whole periods in a cubic lattice: π/6, also in its corners."""
    x = np.arange(-2, 6) * 1.0
    at = np.array(np.meshgrid(x, x, x)).reshape(3, -1).T
    for shift in (0.0, 0.2, 0.5, 0.81):
        found = measures.solid_fraction(at, np.full(len(at), 0.5), np.full(3, shift), np.full(3, shift + 2))
        assert found == pytest.approx(math.pi / 6, rel=1e-12)


def test_rattlers_are_taken_out_again_and_again():
    """A tetrahedron whose corners also touch a plate, and a chain of two that hangs on one of them."""
    first = np.array([0, 0, 0, 1, 1, 2, -1, -1, -2, -1, 3, 4])
    second = np.array([1, 2, 3, 2, 3, 3, 0, 1, 2, 3, 4, 5])
    there, number = measures.backbone(first, second, np.ones(12), 6, 4)
    # 5 has one contact; without it 4 has one too
    assert there.tolist() == [True] * 4 + [False] * 2 and number.tolist() == [4, 4, 4, 4, 0, 0]
    assert measures.coordination(there, number, np.ones(6, bool)) == (4.0, pytest.approx(2 / 6))
    inside = np.array([True, False, False, False, True, False])
    assert measures.coordination(there, number, inside) == (4.0, 0.5)
    # a contact that bears a ten-thousandth of the mean is none: all fall, one after the other
    weak = np.where(np.arange(12) == 6, 1e-4, 1.0)
    there, number = measures.backbone(first, second, weak, 6, 4)
    assert not there.any() and not number.any()
    assert measures.coordination(there, number, np.ones(6, bool)) == (0.0, 1.0)


def made(strain, ratio, minor=1e5, contacts=1.0):
    series = {name: np.zeros(len(strain)) for name in columns.TRIAXIAL}
    series["strain"] = strain
    series["volumetric_strain"] = 0.1 * strain
    for name in ("left", "right", "front", "back"):
        series[f"sigma_{name}_Pa"] = np.full(len(strain), minor)
    series["sigma_left_Pa"] = series["sigma_left_Pa"] * 0.98
    series["sigma_back_Pa"] = series["sigma_back_Pa"] * 1.02
    for name in ("bottom", "top"):
        series[f"sigma_{name}_Pa"] = minor * ratio
    series["contacts_sigma3_Pa"] = np.full(len(strain), minor)
    series["contacts_sigma1_Pa"] = minor * (1 + contacts * (ratio - 1))
    return series


def test_strengths_of_a_curve_with_a_peak():
    """σ₁/σ₃ = 3 from a strain of 0.05 to 0.06, and 2 from 0.1 on; 30° and arcsin 1/3."""
    strain = np.arange(1, 151) * 0.002
    ratio = np.where((strain > 0.0501) & (strain < 0.0601), 3.0, 2.0)
    found = measures.strengths(made(strain, ratio, contacts=1.03))
    assert found["peak_deg"] == pytest.approx(30, rel=1e-9)
    assert found["strain_peak"] == pytest.approx(0.055, rel=1e-9)
    assert found["sigma1_peak_Pa"] / found["sigma3_peak_Pa"] == pytest.approx(3, rel=1e-9)
    assert found["critical_deg"] == pytest.approx(math.degrees(math.asin(1 / 3)), rel=1e-9)
    assert found["sigma1_critical_Pa"] == pytest.approx(2e5) and found["sigma3_critical_Pa"] == pytest.approx(1e5)
    assert found["critical_error_deg"] == pytest.approx(0, abs=1e-9)
    assert found["contacts_difference_rel"] == pytest.approx(0.03, rel=1e-9)
    assert found["plates_difference_rel"] == 0 and found["volumetric_strain_end"] == pytest.approx(0.03)


def test_the_critical_state_is_the_mean_of_the_last_third():
    strain = np.arange(1, 151) * 0.002
    found = measures.strengths(made(strain, np.where(strain > 0.199, 1.5 + (strain - 0.25), 9.0)))
    # rows from 0.2 or 0.202 to 0.3, whose mean is 0.25 or 0.251
    assert found["sigma1_critical_Pa"] == pytest.approx(1.5005e5, abs=51)


def test_the_friction_of_an_angle_lies_between_those_beside_it():
    friction, angle = (0.3, 0.1, 0.5), (20.0, 10.0, 21.0)
    assert measures.friction_at(friction, angle, 15.0) == pytest.approx(0.2)
    assert measures.friction_at(friction, angle, 20.5) == pytest.approx(0.4)
    assert measures.friction_at(friction, angle, 25.0) is None and measures.friction_at((0.3,), (20.0,), 20.0) is None


def test_a_test_that_ended_at_once_has_no_strength():
    found = measures.strengths(made(np.array([0.002, 0.004]), np.array([1.2, 1.3])))
    assert found["peak_deg"] is None and found["critical_deg"] is None and found["volumetric_strain_end"] == 0.0004
