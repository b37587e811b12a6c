"""Area shares by Laguerre cells: lattices and packings that are stretched and sheared by known amounts. Needs no
YADE.
"""

import math
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth.errors import UserError  # noqa: E402
from nonsmooth.measure import local_packing  # noqa: E402

STRETCH = 1.03


def lattice(angle=60.0, count=20):
    """Equal disks of 2 m that touch along rows, whose rows lean by an angle [degrees]: (x, y, r)."""
    i, j = (a.ravel().astype(float) for a in np.meshgrid(np.arange(count), np.arange(count)))
    lean = math.radians(angle)
    return 2 * (i + j * math.cos(lean)), 2 * j * math.sin(lean), np.ones(count * count)


@pytest.fixture(scope="module")
def packing():
    """800 disks of 1 to 4 m in a square, at random places from which overlaps were pushed away."""
    dice = np.random.default_rng(5)
    r = 0.5 / (1 - 0.75 * (np.arange(800) + 0.5) / 800)
    side = math.sqrt((math.pi * r**2).sum() / 0.8)
    at = dice.uniform(0, side, (800, 2))
    for _ in range(600):
        i, j = cKDTree(at).query_pairs(4.0, output_type="ndarray").T
        way = at[i] - at[j]
        apart = np.hypot(*way.T)
        over = np.maximum(r[i] + r[j] - apart, 0)
        push = 0.4 * (over / apart)[:, None] * way
        for k in range(2):
            at[:, k] += np.bincount(i, push[:, k], 800) - np.bincount(j, push[:, k], 800)
            at[:, k] = np.clip(at[:, k], r, side - r)
    assert over.max() < 0.1
    return *at.T, r


def mean_diameter(r):
    return 2 * math.sqrt((r**2).mean())


def dilations(packing, x, y, over=3.0):
    """1 - φ/φ₀ around each disk of a packing that has come to ``x``, ``y``, and which of them lie deep."""
    d = mean_diameter(packing[2])
    before, now = local_packing.cells(*packing, d), local_packing.cells(x, y, packing[2], d)
    shares, at_first = local_packing.area_shares(x, y, over * d, now, before)
    deep = np.isclose(before.solid, math.pi * packing[2] ** 2, rtol=1e-9)
    with np.errstate(all="ignore"):  # at the rim a single cell may have no area
        return 1 - shares / at_first, deep


@pytest.mark.parametrize("angle, area", [(60, 2 * math.sqrt(3)), (90, 4), (75, 4 * math.sin(math.radians(75)))])
@pytest.mark.parametrize("along", [(STRETCH, 1), (STRETCH**0.5, STRETCH**0.5), (1.2, STRETCH / 1.2)])
def test_a_stretch_of_a_lattice_is_read_back(angle, area, along):
    """By each cell, and by neighbourhoods that have no rim."""
    x, y, r = lattice(angle)
    before, after = (local_packing.cells(a * x, b * y, r, 2.0) for a, b in ((1, 1), along))
    row, place = (a.ravel() for a in np.indices((20, 20)))
    from_rim = np.minimum(np.minimum(row, 19 - row), np.minimum(place, 19 - place))
    inside = from_rim >= 2
    assert before.area[inside] == pytest.approx(area, rel=1e-13)
    assert (after.area / before.area)[inside] == pytest.approx(STRETCH, rel=1e-12)
    assert after.solid[inside] == pytest.approx(math.pi, rel=1e-12)
    now, then = local_packing.area_shares(along[0] * x, along[1] * y, 4.0, after, before)
    assert (then / now)[from_rim >= 5] == pytest.approx(STRETCH, rel=1e-12)


def test_cells_of_unlike_disks_end_at_their_radical_lines():
    """One of radius 2 amid eight of radius 1, on the corners and sides of a square: radical lines by hand."""
    x, y = np.array([0, 4, 4, 0, -4, -4, -4, 0, 4.0]), np.array([0, 0, 4, 4, 4, 0, -4, -4, -4.0])
    r = np.array([2.0] + 8 * [1.0])
    found = local_packing.cells(x, y, r, 3.0)
    # from the middle to the line towards a disk at a distance a: (a² + 2² - 1²)/(2 a); those at corners cut some off
    beside, corner = 19 / 8, 35 / (8 * math.sqrt(2))
    cut = math.sqrt(2) * beside - corner
    assert found.area[0] == pytest.approx((2 * beside) ** 2 - 4 * cut**2, rel=1e-13)
    assert found.solid[0] == pytest.approx(4 * math.pi, rel=1e-13)
    # the whole square of centres; of the disks at its corners a quarter, of those at its sides a half
    assert found.area.sum() == pytest.approx(64, rel=1e-13)
    assert found.solid[1:] == pytest.approx(np.array(4 * [math.pi / 2, math.pi / 4]), rel=1e-13)


def test_a_stretched_packing_is_read_back_by_neighbourhoods_and_not_by_cells(packing):
    x, y, r = packing
    around, deep = dilations(packing, x * STRETCH**0.5, y * STRETCH**0.5)
    assert deep.sum() > 600
    assert around[deep].mean() == pytest.approx(1 - 1 / STRETCH, abs=5e-4) and around[deep].std() < 2e-3
    alone, _ = dilations(packing, x * STRETCH**0.5, y * STRETCH**0.5, over=1e-3)
    assert alone[deep].std() > 5 * around[deep].std()


@pytest.mark.parametrize("shear", ["pure", "simple", "other way"])
def test_a_shear_without_dilation_is_none(packing, shear):
    """A fifth of shear: no neighbourhood comes to 3 %; single cells do by the dozen."""
    x, y, r = packing
    to = {"pure": (1.1 * x, y / 1.1), "simple": (x + 0.2 * y, y), "other way": (x / 1.1, 1.1 * y)}[shear]
    around, deep = dilations(packing, *to)
    assert abs(around[deep].mean()) < 3e-3 and around[deep].std() < 5e-3 and around[deep].max() < 0.03
    alone, _ = dilations(packing, *to, over=1e-3)
    assert (alone[deep] > 0.03).sum() > 24


def test_a_free_surface_bounds_cells_and_a_crack_opens_them():
    """Two halves of a lattice move apart: the gap counts until it is wider than the widest void."""
    x, y, r = lattice(90)
    before = local_packing.cells(x, y, r, 2.0)
    assert before.area.sum() == pytest.approx((2 * 19) ** 2, rel=1e-12)  # the square of the centres

    def shares(gap):
        moved = np.where(x > 19, x + gap, x)
        cells = local_packing.cells(moved, y, r, 2.0)
        return cells.area.sum() - before.area.sum(), local_packing.area_shares(moved, y, 6.0, cells)[0]

    opened, share = shares(0.5)
    assert opened == pytest.approx(0.5 * 38, rel=1e-12)
    assert share.min() == pytest.approx(share[np.argmin(abs(x - 19) + abs(y - 19))], rel=0.02)
    closed, share = shares(8.0)
    assert closed == pytest.approx(-2 * 38, rel=1e-12) and share == pytest.approx(math.pi / 4, rel=1e-9)


def test_disks_without_others_around_have_no_share():
    x, y, r = lattice(60)
    far = (np.append(x, 500.0), np.append(y, 0.0), np.append(r, 1.0))
    cells = local_packing.cells(*far, 2.0)
    (share,) = local_packing.area_shares(*far[:2], 6.0, cells)
    assert share[-1] == 0 and cells.area[-1] == cells.solid[-1] == 0 and share[:-1].min() > 0.8
    for few in (lattice(60, 1), (np.arange(5.0), np.zeros(5), np.full(5, 0.5)), (np.zeros(0),) * 3):
        cells = local_packing.cells(*few, 2.0)
        assert not cells.area.any() and not np.any(local_packing.area_shares(*few[:2], 6.0, cells)[0])


def test_the_same_places_give_the_same_bits_and_others_order_the_same_numbers(packing):
    x, y, r = packing
    d = mean_diameter(r)
    first, second = local_packing.cells(x, y, r, d), local_packing.cells(x, y, r, d)
    assert first.area.tobytes() == second.area.tobytes() and first.solid.tobytes() == second.solid.tobytes()
    order = np.random.default_rng(1).permutation(len(r))
    turned = local_packing.cells(x[order], y[order], r[order], d)
    assert turned.area == pytest.approx(first.area[order], rel=1e-9, abs=1e-9)


def test_what_are_no_disks_is_refused():
    one = np.ones(3)
    with pytest.raises(UserError, match=r"arrays of the shapes x \(3,\), y \(3,\), r \(2,\): give flat ones"):
        local_packing.cells(one, one, one[:2], 1.0)
    with pytest.raises(UserError, match=r"void 0: give a length \[m\] above 0"):
        local_packing.cells(one, one, one, 0)
    with pytest.raises(UserError, match=r"reach nan: give a length"):
        local_packing.area_shares(one, one, math.nan, local_packing.Cells(one, one))
