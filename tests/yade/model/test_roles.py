"""What walls are for, which way a slope falls, and the same slope mirrored or at another size. Needs no YADE."""

import dataclasses
import math

import numpy as np
import pytest

import synthetic_slope as synthetic
from slope_scenes import SHIPPED, write_changed

packing, roles, scales, section, similar = (
    synthetic.load(name)
    for name in ("packing", "model.roles", "model.scales", "model.section", "model.section.similar")
)
JIUFENGERSHAN = section.load("jiufengershan")


def written(tmp_path, change):
    """The shipped section with its data changed, read again."""
    return section.load(str(write_changed(tmp_path, change, SHIPPED)))


def nameless(data):
    for wall, name in zip(data["walls"], ("one", "two", "three")):
        wall["name"] = name
        wall.pop("role", None)
    data["water"]["plane"] = "one"


def test_walls_fall_whichever_way_their_vertices_stand():
    """Each from its upper end; a level one counts to the right, or to the side of those that fall."""
    falls, level = np.array([(0.0, 3.0), (4.0, 0.0)]), np.array([(1.0, 2.0), (6.0, 2.0)])
    for line, way in ((falls, (4, -3)), (level, (5, 0))):
        assert roles.chord([line]) == pytest.approx(way) and roles.chord([line[::-1]]) == pytest.approx(way)
    left = falls * (-1, 1)
    assert roles.chord([left, level[::-1], falls[:1]]) == pytest.approx((-9, -3))


def test_roles_follow_from_what_walls_do_and_not_from_their_names(tmp_path):
    made = written(tmp_path, nameless)
    assert [(w.name, w.role) for w in made.walls] == [("one", "slip"), ("two", "backstop"), ("three", "ground")]
    assert [w.name for w in made.of_role("slip", "ground")] == ["one", "three"] and made.of_role("obstacle") == ()


def test_without_water_and_weakening_the_mass_slides_on_what_it_lies_on(tmp_path):
    def dry(data):
        nameless(data)
        del data["water"], data["materials"]["dp"]["slip_weakening"]

    assert [w.role for w in written(tmp_path, dry).walls] == ["slip", "backstop", "ground"]


def test_what_weakens_with_slip_is_a_slip_surface(tmp_path):
    def weak(data):
        nameless(data)
        data["walls"][1]["material"] = "dp"

    assert [w.role for w in written(tmp_path, weak).walls] == ["slip", "slip", "ground"]


def test_what_a_file_says_stands(tmp_path):
    def said(data):
        nameless(data)
        for wall, role in zip(data["walls"], ("ground", "slip", "obstacle")):
            wall["role"] = role

    assert [w.role for w in written(tmp_path, said).walls] == ["ground", "slip", "obstacle"]


def test_a_wall_that_nothing_leans_against_is_no_backstop(tmp_path):
    """The valley's far side faces upslope too; so does a backstop that stands away from the layers."""

    def away(data):
        nameless(data)
        data["walls"][1]["vertices"] = [[100.0, 0.0], [123.294, 60.683]]
        data["walls"].insert(1, {"name": "gap", "material": "ss", "vertices": [[0.0, 0.0], [100.0, 0.0]]})
        data["walls"][3]["vertices"][0] = [123.294, 60.683]
        data["layers"] = [
            data["layers"][0] | {"vertices": [[0.0, 0.0], [-100.0, 80.0], [-1346.109, 561.711], [-1400.371, 537.552]]}
        ]

    assert [w.role for w in written(tmp_path, away).walls] == ["slip", "ground", "ground", "ground"]


def test_what_a_bed_leans_against_is_no_backstop(tmp_path):
    """A layer in the valley lies on the wall's part that rises: a backstop of the mass that does, but not of a bed."""

    def filled(role):
        def change(data):
            nameless(data)
            data["layers"].append(
                {
                    "name": "fill",
                    "material": "rock",
                    "role": role,
                    "vertices": [[1000.0, 21.313], [1200.0, 74.9027], [1000.0, 74.9027]],
                }
            )

        return change

    assert [w.role for w in written(tmp_path, filled("mass")).walls] == ["slip", "backstop", "backstop"]
    assert [w.role for w in written(tmp_path, filled("bed")).walls] == ["slip", "backstop", "ground"]


def test_a_slope_falls_along_the_chords_of_its_slip_surfaces(tmp_path):
    chair = section.load("chair")
    (back, seat), dip = chair.of_role("slip"), math.degrees(math.atan2(560 - 150, 640))
    assert (back.name, seat.name, chair.side) == ("back", "seat", 1.0) and chair.dip == pytest.approx(dip, rel=1e-12)
    circle = section.load("circle")
    assert circle.side == -1.0 and circle.dip == pytest.approx(-math.degrees(math.atan2(40, 90)), rel=1e-12)
    assert (
        circle.downslope == pytest.approx((-90 / math.hypot(90, 40), -40 / math.hypot(90, 40)))
        and circle.normal[1] > 0 > circle.normal[0]
    )


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("turned", [False, True])
def test_a_level_slip_surface_goes_with_those_that_fall(side, turned):
    """A back from (-60, 40) to (-20, 0) and a level seat up to the origin; drawn from either end."""
    back, seat = np.array([(-60.0, 40.0), (-20.0, 0.0)]), np.array([(-20.0, 0.0), (0.0, 0.0)])
    lines = [one[:: -1 if turned else 1] * (side, 1) for one in (seat, back)]
    assert roles.chord(lines).tolist() == [60.0 * side, -40.0]
    assert roles.dip_of(*roles.chord(lines)) == pytest.approx(side * math.degrees(math.atan2(40, 60)))
    assert roles.chord(lines[:1]).tolist() == [20.0, 0.0]  # alone, to the right


@pytest.mark.parametrize("name", section.shipped())
def test_mirrored_twice_a_section_is_as_it_was(name):
    here = section.load(name)
    there = similar.mirrored(here)
    assert (
        there.side == -here.side
        and there.dip == -here.dip
        and there.disk_counts() == here.disk_counts()
        and there.area == here.area
    )
    assert {w.name: w.role for w in there.walls} == {w.name: w.role for w in here.walls} == {
        w.name: w.role for w in roles.assigned(unsaid(there))
    } or name == "chair"
    again = similar.mirrored(there)
    assert (again.walls, again.layers, again.water) == (here.walls, here.layers, here.water)


def unsaid(s):
    return dataclasses.replace(s, walls=tuple(dataclasses.replace(w, role=None) for w in s.walls))


def test_a_mirrored_section_is_checked_like_any_other(tmp_path):
    def flip(data):
        for item in (*data["walls"], *data["layers"]):
            item["vertices"] = [[0.0 - x, y] for x, y in reversed(item["vertices"])]
        data["walls"].reverse()

    read = written(tmp_path, flip)
    assert (read.walls, read.layers) == (similar.mirrored(JIUFENGERSHAN).walls, similar.mirrored(JIUFENGERSHAN).layers)
    there = similar.mirrored(JIUFENGERSHAN).water
    assert (there.point, there.dip, there.pressure_gradient, there.wall) == (
        read.water.point,
        read.water.dip,
        read.water.pressure_gradient,
        "DP",
    )
    assert (read.water.point, read.water.dip, read.side) == ((0.0, 0.0), -JIUFENGERSHAN.water.dip, -1.0)
    circle = section.load("circle").water  # whose plane is a point and a dip
    there = similar.mirrored(section.load("circle")).water
    assert (there.point, there.dip) == ((0.0 - circle.point[0], circle.point[1]), 0.0 - circle.dip)
    # to the last bit, as a vector too
    x, y = JIUFENGERSHAN.water.pressure_gradient_xy
    assert read.water.pressure_gradient_xy == (-x, y)
    vector = dataclasses.replace(
        JIUFENGERSHAN, water=dataclasses.replace(JIUFENGERSHAN.water, pressure_gradient=(3e3, -5e3))
    )
    assert similar.mirrored(vector).water.pressure_gradient == (-3e3, -5e3)
    assert similar.mirrored(similar.mirrored(vector)).water == vector.water


def test_a_mirrored_section_has_the_mirrored_packing():
    here = JIUFENGERSHAN.with_disks(600)
    one, other = packing.pack(here), packing.pack(similar.mirrored(here))
    assert (
        np.array_equal(one.x, -other.x)
        and all(np.array_equal(getattr(one, name), getattr(other, name)) for name in ("y", "r", "layer"))
        and one.x.min() < -1000
    )


def test_a_slope_of_another_size_has_the_scales_that_go_with_it():
    """Froude: times and speeds as the root of lengths, stresses as lengths."""
    big, small = JIUFENGERSHAN, similar.scaled(JIUFENGERSHAN, 0.01)
    assert (
        small.area == pytest.approx(1e-4 * big.area)
        and small.disk_counts() == big.disk_counts()
        and small.dip == pytest.approx(big.dip)
    )
    assert small.wall("DP").points == pytest.approx(0.01 * big.wall("DP").points)
    assert (
        small.numerics.time_step,
        small.stages.dry,
        small.stages.end.time,
        small.stages.settle.ramp,
    ) == pytest.approx((1e-3, 0.3, 15.0, 0.4))
    assert (small.stages.settle.speed_rest, small.water.rate, small.release_distance) == pytest.approx(
        (5e-4, 0.1, 0.05)
    )
    rock, dp = small.materials["rock"], small.materials["dp"]
    assert (
        rock.tensile_strength,
        rock.residual_tensile_strength,
        rock.envelope.cohesion,
        dp.slip_weakening.critical_slip,
    ) == pytest.approx((1e3, 250.0, 859.0, 0.05))
    assert (rock.friction, rock.density, rock.bond_ellipse, rock.bond_creation_distance, small.gravity) == (
        0.3,
        2500.0,
        (0.02, 0.02),
        0.025,
        9.81,
    )
    assert (small.water.unit_weight, small.water.pressure_gradient_xy, small.numerics.path) == (
        big.water.unit_weight,
        big.water.pressure_gradient_xy,
        big.numerics.path,
    )
    of, to = scales.of(big), scales.of(small)
    assert (to.moving_speed, to.going_speed, to.still_seconds, to.row_seconds) == pytest.approx(
        (0.1 * of.moving_speed, 0.1 * of.going_speed, 0.1 * of.still_seconds, 0.01)
    )


def test_heights_and_times_of_a_table_and_of_its_hold_scale_too(tmp_path):
    def course(data):
        data["water"]["table"] = {"points": [[0, 0], [20, 8]]}
        data["stages"]["water"]["hold"] = 6.0

    small = similar.scaled(written(tmp_path, course), 0.25)
    assert small.water.table == ((0.0, 0.0), (10.0, 2.0)) and small.stages.water_hold == 1.5


@pytest.mark.parametrize("factor", [0.0, -1.0, math.nan, 1e-9, 1e9])
def test_sizes_out_of_all_bounds_are_refused(factor):
    with pytest.raises(section.SectionError, match="give a factor from"):
        similar.scaled(JIUFENGERSHAN, factor)
