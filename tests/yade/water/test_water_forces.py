"""Forces of pore water on disks: still water, uniform uplift, parallel seepage, floating grains. Needs no YADE."""

import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth.water import forces, seepage  # noqa: E402
from nonsmooth.water.conditions import Head, PressureHead, SeepageFace  # noqa: E402
from nonsmooth.water.fields import MeshField, PhreaticLine, of_seepage  # noqa: E402
from nonsmooth.water.mesh import grid  # noqa: E402

GAMMA, PHI = 9810.0, 0.84
DICE = np.random.default_rng(2)
X, Y = DICE.uniform((0.5, 0.5), (29.5, 9.5), (300, 2)).T
R = DICE.uniform(0.1, 0.5, 300)
AREA = math.pi * math.fsum(R**2)
MESH = grid(np.linspace(0, 30, 61), np.linspace(0, 10, 21))


def sums(field, **options):
    return forces.on_disks(field, X, Y, R, **options).sum(axis=0)


def still(level=25.0):
    """Still water over all disks, as a line and as pressures in triangles."""
    line = PhreaticLine([[(0, level), (30, level)]])
    return line, line.on(MESH)


@pytest.mark.parametrize("kind", (0, 1), ids=("line", "triangles"))
def test_still_water_bears_the_weight_of_what_it_gives_way_to(kind):
    field = still()[kind]
    for options, volume in (
        ({}, AREA),  # Archimedes, on the solid
        ({"area": "bulk", "packing_fraction": PHI}, AREA / PHI),  # on the bulk
        ({"area": "bulk", "packing_fraction": PHI, "pore_water": True}, AREA),  # the bulk's less the water in the pores
    ):
        assert sums(field, **options) == pytest.approx((0, GAMMA * volume), rel=1e-10, abs=1e-10 * GAMMA * volume)


def test_a_share_of_the_bulk_of_each_disk():
    share = DICE.uniform(0.5, 1, 300)
    field = still()[0]
    expected = GAMMA * math.pi * math.fsum(R**2 / share)
    assert sums(field, area="bulk", packing_fraction=share)[1] == pytest.approx(expected, rel=1e-10)
    one, both = (sums(field, area="bulk", packing_fraction=share, pore_water=p) for p in (True, False))
    assert one[1] == pytest.approx(GAMMA * AREA, rel=1e-10) and both[1] > one[1]


def test_dry_disks_bear_nothing_and_carry_no_water():
    line = PhreaticLine([[(0, 5.0), (30, 5.0)]])
    found = forces.on_disks(line, X, Y, R, area="bulk", packing_fraction=PHI, pore_water=True)
    assert np.all(found[Y > 5] == 0) and found[Y < 5, 1] == pytest.approx(GAMMA * math.pi * R[Y < 5] ** 2, rel=1e-10)
    # a disk is wet as soon as its centre is: a hundredth of a millimetre below the line, at 0.1 Pa
    near = [
        forces.on_disks(line, [9.0], [y], [1.0], area="bulk", packing_fraction=PHI, pore_water=True)[0, 1]
        for y in (4.99999, 5.00001)
    ]
    assert near == pytest.approx([GAMMA * math.pi, 0.0], rel=1e-10)


def test_an_artesian_base_is_relieved_of_its_pressure():
    """A layer of H = 10 m on a base with the uniform pressure u: bulk forces sum to u on the base's length, and the
    weight of the layer is borne no more at u = γ_sat H.
    """
    u = 2.1e5
    found = seepage.solve(MESH, 1e-6, [PressureHead([(0, 0), (30, 0)], u / GAMMA), SeepageFace([(0, 10), (30, 10)])])
    share = AREA / (30 * 10)  # of these disks as of a bulk that fills the layer
    force = sums(of_seepage(found), area="bulk", packing_fraction=share)
    assert force[1] == pytest.approx(u * 30, rel=3e-4) and abs(force[0]) < 1e-6 * u * 30
    saturated = 21000.0
    assert saturated * 10 * 30 - force[1] == pytest.approx((saturated * 10 - u) * 30, abs=3e-4 * u * 30)


def test_grains_float_at_the_critical_gradient():
    """Upward flow through grains of 2,650 kg/m³ with a porosity of 0.4: i = (1 − n)(G − 1) = 0.99."""
    critical = forces.critical_gradient(0.6, 2650)
    assert critical == pytest.approx(0.99, rel=1e-12)
    weight = 2.65 * GAMMA * AREA
    for factor in (0.9, 1.0, 1.1):
        top, rise = 30.0, factor * critical * 10
        given = [Head([(0, 0), (30, 0)], top + rise), Head([(0, 10), (30, 10)], top)]
        field = of_seepage(seepage.solve(MESH, 1e-4, given))
        lift = sums(field, area="bulk", packing_fraction=0.6, pore_water=True)[1]
        assert lift - weight == pytest.approx((factor - 1) * critical / 0.6 * GAMMA * AREA, abs=1e-9 * weight)


def test_seepage_along_a_slope_in_both_book_keepings():
    """The paper's (18): −∇p is γ_w cos β along the normal. Disks of the solids' weight carry the pores' water down the
    slope, γ_w sin β (1 − φ)/φ of their area.
    """
    beta = math.radians(21)
    line = PhreaticLine([[(0, 60), (30, 60 - 30 * math.tan(beta))]], along=True)
    down, normal = np.array([math.cos(beta), -math.sin(beta)]), np.array([math.sin(beta), math.cos(beta)])
    bulk = sums(line, area="bulk", packing_fraction=PHI)
    assert (bulk @ down, bulk @ normal) == pytest.approx((0, GAMMA * math.cos(beta) * AREA / PHI), rel=1e-10, abs=1e-4)
    solid = sums(line, area="bulk", packing_fraction=PHI, pore_water=True)
    carried = GAMMA * (1 - PHI) / PHI * AREA
    assert (solid - bulk) @ down == pytest.approx(carried * math.sin(beta), rel=1e-10)
    assert solid @ normal == pytest.approx(GAMMA * math.cos(beta) * AREA, rel=1e-10)
    assert sums(line) == pytest.approx(PHI * bulk, rel=1e-10)


def test_forces_in_time():
    field = MeshField(MESH, (0, 10), np.array([1.0, 3.0])[:, None] * still()[1].pressures)
    assert sums(field, time=5)[1] == pytest.approx(2 * GAMMA * AREA, rel=1e-10)


def test_no_disks():
    assert forces.on_disks(still()[0], [], [], []).shape == (0, 2)


@pytest.mark.parametrize(
    "disks, options, message",
    [
        (([1, 2], [1], [1]), {}, "x, y, r of 2, 1 and 1 numbers: give as many of each"),
        (([1], [1], [0]), {}, "x, y, r .* radii above 0"),
        (([1], [math.nan], [1]), {}, "x, y, r .* finite"),
        (([1], [1], [1]), {"area": "half"}, "area 'half': give 'disk' or 'bulk'"),
        (([1], [1], [1]), {"area": "bulk"}, "packing_fraction None: give a number above 0"),
        (([1], [1], [1]), {"area": "bulk", "packing_fraction": 1.2}, "packing_fraction 1.2: give a number above 0"),
        (([1], [1], [1]), {"area": "bulk", "packing_fraction": [0.5, 0.5]}, "packing_fraction .*one for each disk"),
        (([1], [1], [1]), {"pore_water": True}, "pore_water True: give area='bulk' with it"),
    ],
)
def test_forces_without_sense(disks, options, message):
    with pytest.raises(forces.ForceError, match=message):
        forces.on_disks(still()[0], *disks, **options)


def test_what_is_no_field():
    with pytest.raises(forces.ForceError, match="field 9810: give a MeshField or a PhreaticLine"):
        forces.on_disks(9810, [1], [1], [1])


@pytest.mark.parametrize("numbers", ((0, 2650, 1000), (0.6, -1, 1000), (0.6, 2650, 0)))
def test_critical_gradients_without_sense(numbers):
    with pytest.raises(forces.ForceError, match="give a number above 0"):
        forces.critical_gradient(*numbers)
