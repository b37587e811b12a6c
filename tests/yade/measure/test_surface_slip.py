"""Displacements along slip surfaces, of made-up disks that were moved by known ways. Needs no YADE."""

import dataclasses
import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import synthetic_slope as synthetic  # noqa: E402

surface_slip, section, similar, snapshots = (
    synthetic.load(name)
    for name in ("measure.surface_slip", "model.section", "model.section.similar", "records.snapshots")
)


def two_layers(interface=True):
    """A slab of two layers on a plane of 30°."""
    c, s = math.cos(math.radians(30)), 0.5

    def at(along, height):
        return [along * c + height * s, -along * s + height * c]

    made = dict(
        name="slabs",
        walls=[dict(name="plane", role="slip", material="plane", vertices=[at(-20, 0), at(20, 0)])],
        layers=[
            dict(
                name=name,
                material="rock",
                vertices=[at(-10, low), at(-low, low), at(-low - 3, low + 3), at(-10, low + 3)],
            )
            for name, low in (("lower", 0), ("upper", 3))[: 1 + interface]
        ],
        materials=dict(
            plane=dict(bonded=False, friction=0.7, rolling_friction=0.1),
            rock=dict(tensile_strength=1e5, friction=0.5, rolling_friction=0.1, density=2000.0),
        ),
        disks=dict(diameter=[0.5, 1.0]),
    )
    if interface:
        made["interfaces"] = [dict(name="joint", between=["lower", "upper"], material="plane", role="slip")]
    return section.of(made), np.array([c, -s])


def snapshot(**changes):
    """Six disks: 0 and 1 on the plane; 2 above them in the lower layer; 3 and 4 on it, in the upper; 5 on these."""
    made = dict(
        time_s=1.0,
        step=1,
        x=np.arange(6.0),
        y=np.zeros(6),
        r=np.full(6, 0.4),
        layer=np.array([0, 0, 0, 1, 1, 1]),
        ci=np.array([0, 1, 2, 3, 2, 5]),
        cj=np.array([-1, -1, 0, 2, 4, 3]),
        cn=np.ones(6),
        ct=np.zeros(6),
        cbonded=np.zeros(6, bool),
        cx=np.zeros(6),
        cy=np.zeros(6),
    )
    return snapshots.Snapshot(**made | changes)


def test_disks_are_those_that_touched_the_surface():
    made, way = two_layers()
    plane, joint = surface_slip.surfaces(made, snapshot())
    assert (plane.name, joint.name) == ("plane", "joint")
    assert plane.above.tolist() == [0, 1] and plane.below.tolist() == []
    assert joint.above.tolist() == [3, 4] and joint.below.tolist() == [2]  # whichever is named first in a contact
    assert plane.way == pytest.approx(way) and joint.way == pytest.approx(way, abs=1e-9)


def test_a_displacement_is_the_mean_way_down_the_surface():
    """The plane's two disks go 1 and 3 m down it; the joint's upper ones 5 m, the lower one 2 m, and what leaves the
    surface along its normal does not count.
    """
    made, way = two_layers()
    begin = snapshot()
    down = np.array([1.0, 3.0, 2.0, 5.0, 5.0, 100.0])
    off = np.array([0.0, 0.5, 0.0, 2.0, -2.0, 0.0])
    x, y = begin.x + down * way[0] - off * way[1], begin.y + down * way[1] + off * way[0]
    found = surface_slip.displacements(surface_slip.surfaces(made, begin), begin, x, y)
    assert found == pytest.approx({"plane": 2.0, "joint": 3.0}, rel=1e-12)


def test_a_mirrored_slope_slips_as_far():
    made, way = two_layers(interface=False)
    begin, mirrored = snapshot(), similar.mirrored(made)
    other = snapshot(x=-begin.x)
    x = begin.x + 2 * way[0]
    found = surface_slip.displacements(surface_slip.surfaces(made, begin), begin, x, begin.y + 2 * way[1])
    seen = surface_slip.displacements(surface_slip.surfaces(mirrored, other), other, -x, begin.y + 2 * way[1])
    assert found == seen == pytest.approx({"plane": 2.0})


def test_a_level_surface_slips_towards_the_side():
    """Of a slope that falls to the left by another surface, a level one slips to the left too."""
    made = section.of(
        name="chair",
        walls=[
            dict(name="seat", role="slip", material="plane", vertices=[[-10, 0], [0, 0]]),
            dict(name="back", role="slip", material="plane", vertices=[[0, 0], [20, 20]]),
        ],
        layers=[dict(name="rock", material="rock", vertices=[[-8, 0], [0, 0], [8, 8], [0, 8]])],
        materials=two_layers()[0].given.data["materials"],
        disks=dict(diameter=[0.5, 1.0]),
    )
    assert made.side == -1.0
    seat, back = surface_slip.surfaces(made, snapshot())
    assert seat.way == (-1.0, 0.0) and back.way == pytest.approx((-math.sqrt(0.5), -math.sqrt(0.5)))
    seat, _ = surface_slip.surfaces(similar.mirrored(made), snapshot())[::-1]
    assert seat.way == (1.0, 0.0)


def test_a_surface_that_nothing_touched_has_no_displacement():
    made, _ = two_layers()
    begin = snapshot(ci=np.zeros(0, int), cj=np.zeros(0, int))
    found = surface_slip.surfaces(made, begin)
    assert surface_slip.displacements(found, begin, begin.x + 1, begin.y) == {"plane": 0.0, "joint": 0.0}


def test_a_disk_that_is_gone_counts_no_longer():
    """Disk 1, which was on the plane, and disk 5 are gone: the plane's is the way of disk 0, and of nobody at last."""
    made, way = two_layers()
    begin = snapshot()
    found, along = surface_slip.surfaces(made, begin), np.array([1.0, 5.0, 2.0, 7.0, 4.0, 9.0])
    left = np.array([0, 2, 3, 4])
    x, y = (begin.x + along * way[0])[left], (begin.y + along * way[1])[left]
    told = surface_slip.displacements(found, begin, x, y, left)
    assert told["plane"] == pytest.approx(1.0) and told["joint"] == pytest.approx(5.5 - 2.0)
    last = surface_slip.displacements(found, begin, x[1:], y[1:], left[1:])
    assert last["plane"] == 0.0 and last["joint"] == told["joint"]


# ---- which half is ahead ----------------------------------------------------------------------------
def moved(begin, time, *ways, numbers=None):
    """The snapshot of :func:`snapshot` with the disks moved down a plane of 30° by ``ways`` [m]."""
    ways = np.array(ways)
    way = np.array([math.cos(math.radians(30)), -0.5])
    told = dict(time_s=time, x=begin.x + ways * way[0], y=begin.y + ways * way[1])
    if numbers is not None:
        names = ("x", "y", "r", "layer")
        told = {name: told.get(name, getattr(begin, name))[numbers] for name in names} | dict(
            time_s=time, number=np.array(numbers), **dict.fromkeys(("ci", "cj", "cn", "ct", "cbonded", "cx", "cy"))
        )
    return snapshot(**told)


def test_the_half_that_is_ahead_is_so_when_the_mean_comes_to_the_slip_asked_for():
    """Disks 0 and 1 on the plane, 0 the upper one: 2 and 1 m, then 8 and 3 m. The mean is 5 m at (5 - 1.5) / (5.5 -
    1.5) = 7/8 of the way between: 2 + 6 * 7/8 = 7.25 and 1 + 2 * 7/8 = 2.75 m."""
    made, _ = two_layers(interface=False)
    begin = snapshot()
    (plane,) = surface_slip.surfaces(made, begin)
    shots = [moved(begin, 2.0, 2, 1, 9, 9, 9, 9), moved(begin, 3.0, 8, 3, 9, 9, 9, 9)]
    assert surface_slip.halves(plane, begin, iter(shots), 5.0) == pytest.approx((7.25, 2.75), rel=1e-12)
    assert surface_slip.halves(plane, begin, shots[1:], 5.5) == pytest.approx((8, 3), rel=1e-12)
    assert surface_slip.halves(plane, begin, shots, 5.51) is None  # it never slips so far
    mirrored = similar.mirrored(made)
    (other,) = surface_slip.surfaces(mirrored, begin)
    turned = [dataclasses.replace(one, x=-one.x) for one in (begin, *shots)]
    assert surface_slip.halves(other, turned[0], turned[1:], 5.0) == pytest.approx((7.25, 2.75), rel=1e-12)


def test_of_an_interface_a_half_slips_on_the_one_below_it():
    """On the joint 3 and 5 above, 2 and 4 below: each pair lies in one half."""
    made, _ = two_layers()
    begin = snapshot(layer=np.array([0, 0, 0, 1, 0, 1]), ci=np.array([3, 5]), cj=np.array([2, 4]), **_no_forces(2))
    joint = next(one for one in surface_slip.surfaces(made, begin) if one.name == "joint")
    assert joint.above.tolist() == [3, 5] and joint.below.tolist() == [2, 4]
    shot = moved(begin, 2.0, 0, 0, 1, 7, 2, 4)
    assert surface_slip.halves(joint, begin, [shot], 4.0) == pytest.approx((6, 2), rel=1e-12)


def test_disks_that_are_gone_have_no_half():
    """With disk 0 taken out the upper half has no slip, and a surface that one disk touches has no second half."""
    made, _ = two_layers(interface=False)
    begin = snapshot(ci=np.array([0, 1, 3]), cj=np.array([-1, -1, -1]), **_no_forces(3))
    (plane,) = surface_slip.surfaces(made, begin)
    shot = moved(begin, 2.0, 9, 4, 9, 6, 9, 9, numbers=[1, 3])  # 1 in the upper half with 0, 3 in the lower
    assert surface_slip.halves(plane, begin, [shot], 5.0) == pytest.approx((4, 6), rel=1e-12)
    assert surface_slip.halves(plane._replace(above=plane.above[:1]), begin, [shot], 1.0) is None
    assert surface_slip.halves(plane._replace(above=plane.above[:0]), begin, [shot], 1.0) is None


def _no_forces(contacts):
    zero = np.zeros(contacts)
    return dict(cn=zero, ct=zero, cbonded=zero > 1, cx=zero, cy=zero)
