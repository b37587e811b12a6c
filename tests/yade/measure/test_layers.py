"""How far a mass has come and fallen, whether its layers have mixed, and where they are turned over, of made-up disks
whose answers are known. Needs no YADE.
"""

import dataclasses
import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import synthetic_slope as synthetic  # noqa: E402

layers, travel, surface = (synthetic.load(f"measure.{name}") for name in ("layers", "travel", "surface"))
SIDE = 60  # disks along and across a square of disks of 2 m


def square(layer=None, **changes):
    """A square lattice of disks, SIDE by SIDE, in three layers of twenty rows each from the bottom."""
    x, y = (2.0 * v.ravel() + 1.0 for v in np.meshgrid(np.arange(SIDE), np.arange(SIDE)))
    return synthetic.few(x, y, layer=np.repeat([0, 1, 2], SIDE * SIDE // 3) if layer is None else layer, **changes)


def turned(snapshot, angle):
    c, s = math.cos(angle), math.sin(angle)
    x, y = snapshot.x - SIDE, snapshot.y - SIDE
    return dataclasses.replace(snapshot, x=c * x - s * y, y=s * x + c * y)


# ---- mixing -------------------------------------------------------------------------------------------
def test_a_mass_that_moves_as_one_does_not_mix():
    start = square()
    away = dataclasses.replace(turned(start, 0.7), x=turned(start, 0.7).x + 900.0)
    assert layers.mixing(start, start) == 0.0 and layers.mixing(start, away) == pytest.approx(0.0, abs=1e-12)


def test_disks_that_are_dealt_out_at_random_are_mixed():
    """The share of neighbours of another layer scatters by some 0.5 / √7000 pairs, 0.6 %, of 2/3."""
    start = square()
    dealt = dataclasses.replace(start, layer=np.random.default_rng(4).permutation(start.layer))
    assert layers.mixing(start, dealt) == pytest.approx(1.0, abs=0.04)  # four of them


def test_layers_that_are_drawn_out_mix_as_their_borders_grow():
    """Six bands of ten rows for three of twenty: five borders for two, 60 pairs each of 2 · 60 · 59."""
    start = square()
    bands = dataclasses.replace(start, layer=np.repeat([0, 1, 2, 0, 1, 2], SIDE * SIDE // 6))

    def share(borders):
        return borders * SIDE / (2 * SIDE * (SIDE - 1))

    expected = (share(5) - share(2)) / (2 / 3 - share(2))
    assert layers.mixing(start, bands) == pytest.approx(expected, rel=1e-9) and expected < 0.05


def test_what_is_no_layer_or_apart_does_not_count():
    """A bed of layer 3 under the mass, mixed into it later; and disks that have lost all neighbours."""
    start = square()
    bed = np.where(np.arange(SIDE * SIDE) % 7 == 0, 3, start.layer)
    with_bed = dataclasses.replace(start, layer=bed)
    assert layers.mixing(with_bed, with_bed, mass=[0, 1, 2]) == 0.0
    assert layers.mixing(start, square(np.zeros(SIDE * SIDE, int))) is not None  # each snapshot has its own
    assert layers.mixing(square(np.zeros(SIDE * SIDE, int)), start) is None  # one layer
    scattered = dataclasses.replace(start, x=10 * start.x, y=10 * start.y)
    assert layers.mixing(start, scattered) is None
    one = synthetic.few([0.0], [0.0])
    assert layers.mixing(one, one) is None


# ---- layers turned over -------------------------------------------------------------------------------
def test_layers_as_they_were_laid_down_are_not_turned_over():
    assert layers.overturned_length(square()) == 0.0
    x, height = layers.overturned(square())
    assert np.diff(x) == pytest.approx(6.0) and not height.any()


def test_a_fold_turns_over_the_part_that_it_covers():
    """On the left third layers lie 0, 1, 2 and then 2, 1, 0 over them, as in a fold that leans to the right; the rest
    is as it was. Columns are 6 m wide.
    """
    start = square()
    recumbent = np.repeat([0, 1, 2, 2, 1, 0], SIDE * SIDE // 6)
    folded = dataclasses.replace(start, layer=np.where(start.x < 42, recumbent, start.layer))
    assert layers.overturned_length(folded) == pytest.approx(42.0, abs=1e-9)
    # of two borders where the order goes down, a cell each; a border within a cell may take two
    x, height = layers.overturned(folded)
    assert ((height[x < 42] >= 12.0) & (height[x < 42] <= 24.0)).all() and not height[x > 42].any()
    # upside down as a whole
    assert layers.overturned_length(dataclasses.replace(start, y=-start.y)) == pytest.approx(120.0, abs=12.0)
    # steep is not overturned
    assert layers.overturned_length(turned(start, math.radians(60))) < 12.0 + 1e-9


@pytest.mark.parametrize("disks, known", [(4, True), (3, False)])
def test_four_disks_tell_the_layer_of_a_cell(disks, known):
    """Two cells of 6 m, one above the other, the older layer on top; the upper one has few disks."""
    x = np.array([1.0, 3.0, 5.0, 1.0, 3.0, 5.0, *[1.0, 3.0, 5.0, 3.0][:disks]])
    y = np.array([1.0, 1.0, 1.0, 3.0, 3.0, 3.0, *[7.0, 7.0, 7.0, 9.0][:disks]])
    snapshot = synthetic.few(x, y, layer=[1] * 6 + [0] * disks)
    assert layers.overturned(snapshot)[1].tolist() == [6.0 if known else 0.0]


def test_what_the_columns_measure_goes_with_the_size():
    start = square()
    over = dataclasses.replace(start, y=-start.y)
    large = dataclasses.replace(over, x=5 * over.x, y=5 * over.y, r=5 * over.r)
    assert layers.overturned_length(large) == pytest.approx(5 * layers.overturned_length(over), rel=1e-9)


# ---- travel -------------------------------------------------------------------------------------------
def test_the_travel_angle_is_that_of_the_extreme_points():
    """Crown at (0, 200) with its top at 201; the front's disk, of two, at (500, 41) on the ground at 40."""
    start, end = synthetic.few([0.0, 30.0], [200.0, 180.0]), synthetic.few([400.0, 500.0], [50.0, 41.0])
    found = travel.travel(start, end, [2500.0])
    assert tuple(found) == travel.NAMES
    assert (found["travel_drop_m"], found["travel_run_m"]) == (161.0, 501.0)
    assert found["travel_angle_deg"] == pytest.approx(math.degrees(math.atan(161 / 501)), rel=1e-12)
    assert (found["centroid_drop_m"], found["centroid_run_m"]) == (190.0 - 45.5, 450.0 - 15.0)
    assert found["centroid_angle_deg"] == pytest.approx(math.degrees(math.atan(144.5 / 435)), rel=1e-12)

    def mirror(s):
        return dataclasses.replace(s, x=-s.x)

    assert travel.travel(mirror(start), mirror(end), [2500.0], -1.0) == pytest.approx(found, rel=1e-12)


def test_only_the_mass_travels_and_heavy_layers_count_more():
    """A bed of layer 1, higher and farther than the mass, is left out; of two layers the lower is three times as
    heavy.
    """
    start = synthetic.few([0.0, 10.0, -90.0], [200.0, 180.0, 900.0], layer=[0, 2, 1])
    end = synthetic.few([300.0, 400.0, 9000.0], [60.0, 41.0, 0.0], layer=[0, 2, 1])
    found = travel.travel(start, end, [3000.0, 1.0, 1000.0], mass=[0, 2])
    assert (found["travel_drop_m"], found["travel_run_m"]) == (161.0, 401.0)
    assert found["centroid_drop_m"] == pytest.approx((3 * 140 + 139) / 4)
    assert found["centroid_run_m"] == pytest.approx((3 * 300 + 390) / 4)


def test_what_does_not_come_down_the_slope_has_no_angle():
    start, end = synthetic.few([0.0], [10.0]), synthetic.few([-20.0], [5.0])
    found = travel.travel(start, end, [2500.0])
    assert found["travel_angle_deg"] is None and found["centroid_angle_deg"] is None


# ---- the thickness over the ground ---------------------------------------------------------------------
def test_the_hollow_before_the_backstop_is_no_ground():
    """The backstop stands over x = 0 to 23 m, the ground begins there; right and left of it too."""
    x = np.array([-300.0, -1.0, 12.0, 22.0, 30.0, 700.0])
    for side in (1.0, -1.0):
        walls = [(name, np.array([side, 1.0]) * v, role) for name, v, role in synthetic.Section.walls]
        assert surface.on_ground(side * x, walls).tolist() == [False] * 4 + [True] * 2
    assert not surface.on_ground(np.array([5000.0]), synthetic.Section.walls).any()  # beyond all walls
