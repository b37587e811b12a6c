"""Profiles of speed, borders and regimes of made-up masses whose answer is known. Needs no YADE."""

import numpy as np
import pytest

import synthetic_slope as synthetic

velocity = synthetic.load("measure.velocity_profiles")
D = 0.02  # m, of all disks
H, U = 20 * D, 3.0  # m, m/s


def lattice(columns=30, rows=20):
    """Disks side by side in ``rows`` layers of one diameter, the lowest on the floor: x, y, r."""
    i, j = np.meshgrid(np.arange(columns), np.arange(rows))
    return (i.ravel() + 0.5) * D, (j.ravel() + 0.5) * D, np.full(columns * rows, 0.5 * D)


SHAPES = {
    # speed by z/h; border and fullness of the continuous profile; regime
    "plug": (lambda s: np.where(s > 0.05, 1.0, 0.6), 0.0, 0.98, "plug"),
    "simple shear": (lambda s: s, 0.1, 0.5, "simple shear"),
    # half at rest, and linear above: a tenth of U is reached a tenth of the way up the upper half
    "two layers": (lambda s: np.maximum(0, 2 * s - 1), 0.55, 0.25, "two layers"),
}


@pytest.mark.parametrize("name", SHAPES)
def test_each_regime_is_told_by_its_border_and_its_fullness(name):
    shape, border, full, regime = SHAPES[name]
    x, y, r = lattice()
    found = velocity.measure(x, y, r, U * shape(y / H), 0.1, 0.5, D)
    assert found.z == pytest.approx(D * (np.arange(20) + 0.5)) and found.speed == pytest.approx(U * shape(found.z / H))
    assert found.height == pytest.approx(H, rel=1e-12) and found.regime == regime
    # layers tell a place to half of themselves, and their topmost middle is half a layer below the surface: 2.5 %
    assert found.border / H == pytest.approx(border, abs=0.025)
    assert found.fullness == pytest.approx(full, abs=0.025)


def test_a_border_is_linear_between_two_layers_and_the_highest_place_that_is_slow():
    z = np.array([1.0, 3.0, 5.0, 7.0])
    assert velocity.border(z, np.array([0.0, 0.05, 0.25, 1.0])) == pytest.approx(3.5, rel=1e-12)
    # slow below a faster layer: that which lies above both counts
    assert velocity.border(z, np.array([0.5, 0.0, 0.4, 1.0])) == pytest.approx(3.5, rel=1e-12)
    assert velocity.border(z, np.array([0.2, 0.4, 1.0, 0.05])) == 0.0  # what is slow above the fastest is no deposit


@pytest.mark.parametrize(
    "rest, full, regime",
    [(0.26, 0.9, "two layers"), (0.24, 0.76, "plug"), (0.24, 0.74, "simple shear"), (0.0, 0.5, "simple shear")],
)
def test_the_bounds_between_regimes(rest, full, regime):
    assert velocity.regime(rest, full) == regime


def test_disks_count_by_their_area_and_within_their_window_only():
    x, y = np.array([0.5, 0.5, 3.0, 0.5]), np.array([0.5, 0.6, 0.5, 1.5])
    r, u = np.array([0.1, 0.2, 0.5, 0.5]), np.array([1.0, 2.0, 50.0, 4.0])
    z, speed = velocity.profile(x, y, r, u, 0.0, 0.7, 1.0)
    assert z == pytest.approx([0.5, 1.5]) and speed == pytest.approx([(0.01 + 2 * 0.04) / 0.05, 4.0])
    # a layer that is nearly empty ends the mass, and what flies above it does not count
    r[1] = 0.01
    z, speed = velocity.profile(x, y, r, u, 0.0, 0.7, 1.0)
    assert len(z) == 0
    assert velocity.measure(x, y, r, u, 5.0, 6.0, 1.0) is None


def test_what_is_no_faster_than_the_least_is_at_rest_to_its_surface():
    x, y, r = lattice()
    found = velocity.measure(x, y, r, 0.01 * y / H, 0.1, 0.5, D, least=0.01)
    assert found.regime == "at rest" and found.border == found.height and np.isnan(found.fullness)


def test_the_border_along_a_mass_is_that_of_each_piece():
    x, y, r = lattice()
    u = U * np.where(x < 0.3, np.maximum(0, 2 * y / H - 1), 1.0)
    found = velocity.borders(x, y, r, u, np.array([0.0, 0.3, 0.6, 0.9]), D)
    assert found[0] == pytest.approx(0.55 * H, abs=0.5 * D) and found[1] == 0.0 and np.isnan(found[2])


def test_speeds_are_differences_in_the_middle_of_two_looks():
    first = (2.0, np.array([0.0, 1.0], np.float32), np.array([5.0, 5.0], np.float32))
    then = (2.5, np.array([1.0, 1.0], np.float32), np.array([4.0, 6.0], np.float32))
    x, y, u, v = velocity.midway(first, then)
    assert [list(values) for values in (x, y, u, v)] == [[0.5, 1.0], [4.5, 5.5], [2.0, 0.0], [-2.0, 2.0]]
