"""Readings of what the paper leaves open: what each changes, how near it is to the paper, and that runs which several share are made once."""

import math

import numpy as np
import pytest
from shapely.geometry import LineString, Polygon
from shapely.ops import unary_union
from yade.nonsmooth import section, section_data
from yade.nonsmooth.figures import readings as figures
from yade.nonsmooth.laboratory import biaxial_test, readings

SHIPPED = readings.READINGS[readings.SHIPPED]


def all_of(reading):
    return section_data.plain(readings.slope_of(reading, 3000, 1)), readings.tests_of(reading, 400, [1])


def test_the_default_is_the_shipped_section_and_its_rock():
    slope, tests = all_of(SHIPPED)
    assert slope == section_data.plain(section.load("jiufengershan").with_disks(3000))
    assert {t.material.bond_creation_distance for t in tests} == {slope["materials"]["rock"]["bond_creation_distance"]}
    assert [t.confining for t in tests] == list(readings.PRESSURES)
    assert {t.platens for t in tests} == {biaxial_test.Test.platens}


def test_each_reading_is_another_one():
    """No two have both the same slopes and the same tests: a slip of the pen in a key or a value would make one of them the default."""
    told = {name: repr(all_of(one)) for name, one in readings.READINGS.items()}
    assert len(set(told.values())) == len(told)


@pytest.mark.parametrize("name", ["packed", "packed-0.05"])
def test_what_is_not_pressed_is_so_in_both(name):
    slope, tests = all_of(readings.READINGS[name])
    assert not slope["disks"].get("pressed") and {t.shape.friction for t in tests} == {None}


@pytest.mark.parametrize(
    "name, thickness, inclination", [("toe-67.5", 67.5, 90), ("backstop-70", 65, 70), ("backstop-110", 65, 110)]
)
def test_the_toe_has_its_thickness_and_the_backstop_its_inclination(name, thickness, inclination):
    """Thickness normal to DP, and the angle in the mass between DP, upslope, and FB: to the rounding of the file, 1 mm in 65 m. Layers end on FB in equal parts, and the crown stays."""
    made, shipped = readings.slope_of(readings.READINGS[name], 3000, 1), section.load("jiufengershan")
    top = made.wall("FB").points[-1]
    assert np.dot(top, made.normal) == pytest.approx(thickness, abs=2e-3)
    assert math.degrees(math.acos(np.dot(top, made.downslope) / -np.hypot(*top))) == pytest.approx(
        inclination, abs=2e-3
    )
    assert made.wall("SS").points[0] == pytest.approx(top) and made.wall("DP").points == pytest.approx(
        shipped.wall("DP").points
    )
    for k, (layer, before) in enumerate(zip(made.layers, shipped.layers)):
        # the file gives them to the millimetre
        assert layer.points[:2] == pytest.approx(np.array([k / 5 * top, (k + 1) / 5 * top]), abs=1e-3)
        assert layer.points[2:] == pytest.approx(before.points[2:])


def test_layers_of_one_thickness_are_cut_by_the_surface():
    """Above DP: bottoms at 13.5 m times their number; five at the foot, the rest of 65 m being the uppermost's; three at the crown. Together they fill what the shipped ones fill,
    overlap nowhere, and none is thinner than the largest disk."""
    made, shipped = (readings.section_of(readings.READINGS[name]) for name in ("layers-13.5", readings.SHIPPED))
    axes = np.array([np.negative(shipped.downslope), shipped.normal])  # up DP, and off it
    polygons = [Polygon(np.array(layer.points) @ axes.T) for layer in made.layers]
    whole = unary_union([Polygon(np.array(layer.points) @ axes.T) for layer in shipped.layers])
    # the file gives places to a millimetre, along borders of 1.5 km: 2 m²
    assert unary_union(polygons).symmetric_difference(whole).area < 2 and sum(
        p.area for p in polygons
    ) == pytest.approx(whole.area, abs=2)
    for k, polygon in enumerate(polygons):
        at_foot = [off for up, off in polygon.exterior.coords if abs(up) < 1e-2]
        assert (min(at_foot), max(at_foot)) == pytest.approx((13.5 * k, min(13.5 * (k + 1), 65)), abs=2e-3)
    at_crown = whole.intersection(LineString([(1440, 0), (1440, 70)]))
    pieces = [p.intersection(at_crown).length for p in polygons]
    surface = 65 - (65 - 42) * 1440 / 1458
    assert pieces == pytest.approx([13.5, 13.5, surface - 27, 0, 0], abs=2e-3)
    for polygon in polygons[3:]:
        up = polygon.exterior.bounds[2]
        assert polygon.intersection(LineString([(up - 1e-3, 0), (up - 1e-3, 70)])).length == pytest.approx(4, abs=2e-3)


PAPER = {name: wanted for name, (wanted, _) in readings.PAPER.items()}


def test_misses_are_in_units_of_what_is_allowed():
    assert set(readings.misses(PAPER).values()) == {0.0}
    off = {name: wanted + allowed for name, (wanted, allowed) in readings.PAPER.items()} | {"strain_peak": 0.02}
    assert readings.misses(off) == pytest.approx(dict.fromkeys(PAPER, 1.0))
    # half the strain is as far from it as twice
    assert readings.misses(PAPER | {"strain_peak": 0.005, "water_highest_m": None}) == pytest.approx(
        dict.fromkeys(PAPER, 0.0) | {"strain_peak": -1.0, "water_highest_m": None}
    )


def test_points_that_coincide_share_a_label():
    """Two near each other, one beside them in strain, one in water; labels are the places in the list, by distance."""
    places = [(0.010, 20.0), (0.0105, 20.5), (0.0116, 20.0), (0.010, 21.0)]
    rows = [
        {
            "name": f"{k}",
            "label": f"{k}",
            "distance": float(k),
            "strain_peak": x,
            "strain_peak_each": [x],
            "water_highest_m": y,
            "water_highest_m_each": [y],
        }
        for k, (x, y) in enumerate(places)
    ]
    ax, names = figures.tradeoff(rows).axes
    assert [t.get_text() for t in ax.texts if t.get_text() != "the paper"] == ["1, 2", "3", "4"]
    assert [tuple(t.xy) for t in ax.texts[1:]] == [(1.0, 20.0), (1.16, 20.0), (1.0, 21.0)]


def test_small_runs_and_what_is_shared(tmp_path):
    """Sides rule samples alone, the backstop slopes alone: of three readings there are two kinds of samples and two of slopes."""
    chosen = {name: readings.READINGS[name] for name in ("rough", "membrane", "backstop-loose")}
    rows = readings.run(chosen, tmp_path, 600, 150, [1], strain=0.01, threads=2)
    assert sorted(p.name for p in (tmp_path / "samples").iterdir()) == ["membrane", "rough"]
    assert sorted(p.name for p in (tmp_path / "slopes").iterdir()) == ["backstop-loose", "rough"]
    rows = {row["name"]: row for row in rows}
    peak, water = ({name: row[key] for name, row in rows.items()} for key in ("friction_peak_deg", "water_highest_m"))
    assert peak["rough"] == peak["backstop-loose"] != peak["membrane"]
    assert water["rough"] == water["membrane"] is not None
    # one seed has no interval; a test of 1 % has no residual strength, so nobody says how near it is
    assert rows["rough"]["friction_peak_deg_95"] is None and rows["rough"]["misses"]["friction_residual_deg"] is None
    assert rows["rough"]["distance"] is None
    heads, lines = readings.table(list(rows.values()))
    assert lines[0][0] == "the paper" and {len(line) for line in lines} == {len(heads)}
    assert figures.tradeoff(list(rows.values()), tmp_path / "readings.png").stat().st_size > 1e4
