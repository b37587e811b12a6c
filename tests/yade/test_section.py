"""Sections: the shipped one, what it derives, and one clear message for each kind of bad input."""

import dataclasses
import math
import sys
from pathlib import Path

import numpy as np
import pytest
import yaml

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "py"))
from nonsmooth import geometry  # noqa: E402
from nonsmooth.section import FOLDER, SectionError, load, shipped  # noqa: E402

TEXT = (FOLDER / "jiufengershan.yaml").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def section():
    return load("jiufengershan")


@pytest.fixture
def refused(tmp_path):
    """Write a section and return the message it is refused with, which names file and line."""
    def run(text):
        path = tmp_path / "slope.yaml"
        path.write_text(text, encoding="utf-8")
        with pytest.raises(SectionError) as info:
            load(path)
        message = str(info.value)
        assert message.startswith(f"{path}: ")
        assert "\n" not in message
        return message
    return run


def changed(**keys):
    """The shipped section as text, with values set at paths such as disks__diameter or walls__1__vertices."""
    data = yaml.safe_load(TEXT)
    for path, value in keys.items():
        *way, last = [int(k) if k.isdigit() else k for k in path.split("__")]
        place = data
        for k in way:
            place = place[k]
        if value is None:
            del place[last]
        else:
            place[last] = value
    return yaml.safe_dump(data, sort_keys=False)


def test_is_the_slope_of_the_paper(section):
    assert shipped() == ["jiufengershan"]
    assert section.dip == pytest.approx(21, abs=1e-4)
    assert len(section.layers) == 5
    along, up = np.array(section.downslope), np.array(section.normal)
    v = np.vstack([layer.points for layer in section.layers])
    assert (v @ along).min() == pytest.approx(-1500, abs=0.01)
    assert (v @ along).max() == pytest.approx(0, abs=0.01)
    top = section.layers[-1].points
    assert (top @ up).max() == pytest.approx(65, abs=0.01)
    assert top[2] @ up == pytest.approx(42, abs=0.01)
    assert section.area == pytest.approx(78885, abs=5)
    assert 19_000 <= sum(section.disk_counts()) <= 21_500


def test_vectors_and_water(section):
    b = math.radians(21)
    assert section.downslope == pytest.approx((math.cos(b), -math.sin(b)), abs=1e-6)
    assert section.normal == pytest.approx((math.sin(b), math.cos(b)), abs=1e-6)
    assert section.water.gradient == pytest.approx([9810 * math.cos(b) * n for n in section.normal])
    assert section.water.height(22.5) == 22.5
    assert section.water.point == (0.0, 0.0)


def test_table_1(section):
    m = section.materials
    assert [m[k].friction for k in ("rock", "dp", "fb", "ss")] == [0.3, 0.3, 0.7, 0.2]
    assert [m[k].residual_friction for k in ("rock", "dp", "fb", "ss")] == [0.3, 0.3, 0.5, 0.2]
    assert [m[k].bonded for k in ("rock", "dp", "fb", "ss")] == [True, False, True, False]
    assert (m["rock"].tensile_strength, m["rock"].residual_tensile_strength) == (100e3, 25e3)
    assert m["dp"].critical_slip == 5 and m["ss"].critical_slip == math.inf
    assert all(x.rolling_friction == 0.1 and x.restitution == 0 and x.bond_ellipse == (0.02, 0.02) for x in m.values())


def test_walls_join_to_the_bit_and_hold_the_layers(section):
    dp, fb, ss = section.walls
    assert dp.vertices[-1] == fb.vertices[0] and fb.vertices[-1] == ss.vertices[0]
    assert ss.vertices[-1][1] > max(p[1] for layer in section.layers for p in layer.vertices)
    assert section.bounds == (-1428.378, 0.0, 2100.0, 601.633)
    assert section.wall("FB") is fb
    with pytest.raises(KeyError):
        section.wall("XX")


@pytest.mark.parametrize("count", [500, 3000, 100_000])
def test_with_disks_scales_diameters(section, count):
    other = section.with_disks(count)
    assert sum(other.disk_counts()) == pytest.approx(count, abs=2)
    assert other.disks.d_max / other.disks.d_min == pytest.approx(4)
    assert other.disks.d_min == pytest.approx(other.scale)
    assert other.layers == section.layers


def test_with_rock_changes_the_layers_alone(section):
    wwr = section.materials["wwr-sparse"]
    other = section.with_rock(wwr)
    assert other.materials["rock"] == dataclasses.replace(wwr, name="rock")
    assert all(other.materials[k] == m for k, m in section.materials.items() if k != "rock")
    assert other.key() == section.key() and other.key("settled") != section.key("settled")  # the same packing, another slope
    with pytest.raises(SectionError, match="no density"):
        section.with_rock(section.materials["ss"])


def test_count_in_the_file(tmp_path):
    path = tmp_path / "s.yaml"
    path.write_text(changed(disks__count=2000))
    assert sum(load(path).disk_counts()) == pytest.approx(2000, abs=2)


@pytest.mark.parametrize("count", [0, -5, 2.5, True])
def test_with_disks_refuses(section, count):
    with pytest.raises(SectionError, match="whole number from 1"):
        section.with_disks(count)


def test_disks_too_large_for_the_layers(section):
    with pytest.raises(SectionError, match="no room"):
        section.with_disks(8)


def test_key_is_of_what_matters(section, tmp_path):
    path = tmp_path / "other.yaml"
    path.write_text("# a comment\n" + changed(name="other", description="else", water__release_distance=7.0))
    other = load(path)
    assert other.key() == section.key() and other.key("settled") == section.key("settled")
    assert section.with_disks(3000).key() != section.key()
    softer = dataclasses.replace(section, gravity=1.6)
    assert softer.key() == section.key() and softer.key("settled") != section.key("settled")
    with pytest.raises(ValueError):
        section.key("nothing")


def test_numbers_as_in_yaml_1_2_and_water_variants(tmp_path):
    path = tmp_path / "s.yaml"
    path.write_text(TEXT.replace("100.0e3          # Pa", "1e5")
                    .replace("plane: DP  ", "plane: {point: [1, 2], dip: -10}")
                    .replace("gradient: buoyant", "gradient: [0, 5]").replace("{rate: 1.0}", "{points: [[0, 1], [10, 6]]}"))
    s = load(path)
    assert s.materials["rock"].tensile_strength == 1e5
    assert s.water.gradient == (0.0, 5.0) and s.water.wall is None and s.dip == -10
    assert s.downslope[0] < 0 and s.downslope[1] < 0 and s.normal[1] > 0
    assert s.water.height(np.array([-1.0, 5.0, 99.0])).tolist() == [1.0, 3.5, 6.0]


def test_without_a_path_all_steps_are_as_long(section, tmp_path):
    path = tmp_path / "s.yaml"
    path.write_text(changed(numerics__path=None))
    assert load(path).numerics.path is None and section.numerics.path > 0


def test_dry_section(tmp_path):
    path = tmp_path / "s.yaml"
    path.write_text(changed(water=None, stages__water=None))
    assert load(path).water is None
    assert load(path).dip == pytest.approx(21, abs=1e-4)


BAD = {
    "unknown key": (dict(materials__rock__frictoin=0.3), "materials.rock.frictoin", "did you mean 'friction'"),
    "missing key": (dict(materials__rock__friction=None), "materials.rock", "'friction' is missing"),
    "negative": (dict(materials__rock__friction=-0.3), "materials.rock.friction: -0.3", "0 or more"),
    "negative size": (dict(disks__diameter=[-1.0, 4.0]), "disks.diameter[0]: -1.0", "above 0"),
    "sizes turned round": (dict(disks__diameter=[4.0, 1.0]), "disks.diameter", "smaller one first"),
    "NaN": (dict(gravity=math.nan), "gravity: nan", "finite"),
    "infinite vertex": (dict(walls__0__vertices=[[-1428.378, math.inf], [0.0, 0.0]]), "walls[DP].vertices[0][1]: inf", "finite"),
    "text for a number": (dict(gravity="fast"), "gravity: 'fast' is text", "m/s²"),
    "true for a number": (dict(gravity=True), "gravity: True is true or false", "m/s²"),
    "count": (dict(disks__count=2.5), "disks.count: 2.5", "1 or more"),
    "unknown material": (dict(walls__1__material="steel"), "walls[FB].material: 'steel' is not defined", "rock, wwr-sparse, dp, fb, ss"),
    "name taken": (dict(layers__2__name="L1"), "layers[L1].name: 'L1' is taken", "own name"),
    "no density": (dict(materials__rock__density=None), "no density", "kg/m³"),
    "no strength": (dict(materials__fb__tensile_strength=None), "without tensile_strength", "bonded: false"),
    "weakening rock": (dict(materials__rock__slip_weakening={"law": "step", "critical_slip": 1.0}), "slip_weakening", "walls only"),
    "hole between walls": (dict(walls__1__vertices=[[0.5, 0.0], [23.294, 60.683]]), "a hole of 0.5 m", "the same point"),
    "hole below": (dict(walls__0__vertices=[[-1000.0, 383.86], [0.0, 0.0]]), "disks could fall out", "extend a wall"),
    "self-crossing wall": (dict(walls__2__vertices=[[23.294, 60.683], [473, 21], [473, 50], [100, 0]]), "crosses itself", "order"),
    "vertex twice": (dict(walls__0__vertices=[[-1428.378, 548.303], [0.0, 0.0], [0.0, 0.0]]), "two vertices in a row", "remove one"),
    "overlap": (dict(layers__1__vertices=[[4.0, 10.0], [9.318, 24.273], [-1378.666, 547.215], [-1389.518, 542.384]]),
                "overlaps layer L1", "touch at most"),
    "bow tie": (dict(layers__0__vertices=[[0.0, 0.0], [-1389.518, 542.384], [4.659, 12.137], [-1400.371, 537.552]]),
                "Self-intersection", "in order around"),
    "flat layer": (dict(layers__0__vertices=[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]), "layers[L1].vertices", "in order around"),
    "two vertices": (dict(layers__0__vertices=[[0.0, 0.0], [1.0, 0.0]]), "has 2 entries", "three or more"),
    "thin layers": (dict(disks__diameter=[1.0, 200.0]), "no room", "smaller diameters"),
    "unknown plane": (dict(water__plane="XX"), "no wall is called 'XX'", "DP, FB, SS"),
    "bent plane": (dict(water__plane="SS"), "SS is not straight", "straight wall"),
    "rate and points": (dict(water__table={"rate": 1.0, "points": [[0, 0]]}), "water.table: has 2 entries", "either"),
    "times falling": (dict(water__table={"points": [[0, 0], [5, 1], [4, 2]]}), "water.table.points[2]", "rising order"),
    "no path": (dict(numerics__path=0.0), "numerics.path: 0.0", "left out, all steps are as long"),
    "hold": (dict(stages__water={"hold": "maybe"}), "stages.water.hold: 'maybe'", "motion, never"),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_values(case, refused):
    keys, what, remedy = BAD[case]
    message = refused(changed(**keys))
    assert what in message and remedy in message
    assert ": line " in message or "no room" in message


def test_line_of_a_number_that_replaces_a_borrowed_one(refused):
    text = TEXT.replace("bond_creation_distance: 0.015", "bond_creation_distance: much")
    assert f"line {1 + text[:text.index('distance: much')].count(chr(10))}: materials.wwr-sparse.bond_creation_distance" in refused(text)


def test_line_number(refused):
    text = TEXT.replace("distribution: uniform", "distribution: even")
    assert f"line {1 + text[:text.index('distribution: even')].count(chr(10))}: disks.distribution" in refused(text)


@pytest.mark.parametrize("text, what", [
    ("", "nothing"), ("- 1\n", "a list"), ("name: [1\n", "line 2"), ("name: a\nname: b\n", "given twice"),
    ("1: 2\n", "is no text"), ("name: !!python/object:os.system x\n", "could not determine a constructor"),
    ("name: x\n", "(and 7 more to correct)")])
def test_bad_files(text, what, refused):
    assert what in refused(text)


def test_unreadable_files(tmp_path):
    (tmp_path / "b.yaml").write_bytes(b"\xff\xfe\x00")
    for name, what in ((tmp_path / "none.yaml", "no such file"), (tmp_path, "cannot be read"),
                       (tmp_path / "b.yaml", "UTF-8"), ("no-such-section", "jiufengershan")):
        with pytest.raises(SectionError, match=what):
            load(name)


def test_wall_that_stands_apart(tmp_path):
    path = tmp_path / "s.yaml"
    wall = {"name": "roof", "material": "ss", "vertices": [[0, 900], [10, 900]]}
    data = yaml.safe_load(TEXT)
    data["walls"].append(wall)
    path.write_text(yaml.safe_dump(data))
    with pytest.raises(SectionError, match="a hole of"):
        load(path)
    wall["apart"] = True
    path.write_text(yaml.safe_dump(data))
    assert load(path).wall("roof").apart


def test_column_with_free_cliff_and_wall_through_a_layer(tmp_path):
    """A vertical face may be free; a wall inside a layer may not be."""
    data = yaml.safe_load(TEXT)
    del data["water"]
    data["walls"] = [{"name": "floor", "material": "ss", "vertices": [[0, 0], [100, 0]]}]
    data["layers"] = [{"name": "column", "material": "rock", "vertices": [[0, 0], [20, 0], [20, 40], [0, 40]]}]
    path = tmp_path / "s.yaml"
    path.write_text(yaml.safe_dump(data))
    assert load(path).area == 800
    data["walls"].append({"name": "post", "material": "ss", "vertices": [[100, 0], [10, 20]]})
    path.write_text(yaml.safe_dump(data))
    with pytest.raises(SectionError, match="wall post runs through the layer"):
        load(path)


def test_geometry():
    square = geometry.Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
    assert geometry.area_inside([1, 0, 0, 5], [1, 1, 0, 5], [0.5] * 4, square) == pytest.approx(
        math.pi / 4 * (1 + 1 / 2 + 1 / 4), rel=1e-4)
    bent = geometry.edges(geometry.Polygon([(0, 0), (2, 0), (2, 2), (1, 1), (0, 2)]))
    assert bent.convex_start.sum() == 4 and bent.convex_end.sum() == 4
    inside = geometry.contains(square, np.array([1.0, 3.0, 1.9]), np.array([1.0, 1.0, -0.1]))
    assert inside.tolist() == [True, False, False]
