"""The packing library's face in Python without YADE: its sums are NumPy's, and arrays that do not fit are refused."""

import numpy as np
import pytest

import _nonsmooth_packing as packing

BOX = ([[0, 0], [9, 0], [9, 9], [0, 9]], [[1, 0], [0, 1], [-1, 0], [0, -1]], [9] * 4, [True] * 4, [True] * 4)
DISKS = {"x": [2.0, 4.0], "y": [3.0, 3.0], "r": [1.0, 1.5], "layer": [0, 0], "order": [0, 1], "borders": [(BOX, None)]}


@pytest.mark.parametrize("count", [0, 1, 7, 8, 9, 127, 128, 129, 136, 1000, 8191, 8192, 8193, 16_391, 100_003])
def test_sums_are_those_of_numpy(count):
    """Of the NumPy that packings' bits come from; another one may sum in another order."""
    values = np.random.default_rng(count).normal(size=count)
    assert packing.numpy_sum(values) == np.sum(values)
    assert packing.numpy_sum(-values) == -np.sum(values)


def test_two_disks_push_each_other():
    disks = packing.Relaxation(**DISKS)
    assert len(disks) == 2 and disks.forces(True) == pytest.approx(0.4)
    assert disks.force_x == pytest.approx([-0.5, 0.5]) and disks.squeeze == pytest.approx([0.5, 0.5])
    disks.step()
    assert disks.x[0] < 2 and disks.x[1] > 4 and disks.y.tolist() == [3, 3] and disks.r.tolist() == [1, 1.5]


@pytest.mark.parametrize(
    "change, what",
    [
        ({"x": [2.0]}, "one length"),
        ({"r": [[1.0, 1.5]]}, "one length"),
        ({"x": [], "y": [], "r": [], "layer": [], "order": []}, "no disk"),
        ({"r": [1.0, 0.0]}, "radii above 0"),
        ({"y": [1.0, np.nan]}, "finite"),
        ({"layer": [0]}, "layer and order"),
        ({"order": [0]}, "layer and order"),
        ({"order": [1, 1]}, "layer and order"),
        ({"order": [1, 2]}, "layer and order"),
        ({"borders": [(BOX[:4], None)]}, "edges are a tuple"),
        ({"borders": [((BOX[0][:3], *BOX[1:]), None)]}, "shape"),
        ({"borders": [((*BOX[:4], [True]), None)]}, "one length"),
        ({"borders": [(BOX, [True])]}, "each disk"),
    ],
)
def test_what_does_not_fit_is_refused(change, what):
    with pytest.raises(ValueError, match=what):
        packing.Relaxation(**{**DISKS, **change})


def test_the_order_of_calls_is_held():
    disks = packing.Relaxation(**DISKS)
    for call in (disks.step, lambda: disks.exchange(0, 1)):
        with pytest.raises(RuntimeError, match="before it"):
            call()
    disks.forces(True)
    with pytest.raises(ValueError, match="stride 1"):
        disks.exchange(0, 0)


def test_other_arrays_that_do_not_fit():
    for call in (
        lambda: packing.close_pairs([0.0], [0.0, 1.0], [1.0], 0.0),
        lambda: packing.pushes([0.0], [], [1.0], 0.0, BOX),
    ):
        with pytest.raises(ValueError, match="one length"):
            call()
    none = packing.pushes([], [], [], 0.0, BOX)
    assert [len(a) for a in none] == [0] * 5 and [len(a) for a in packing.close_pairs([], [], [], 0.0)] == [0, 0]
