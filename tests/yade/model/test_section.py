"""Sections: the shipped one, what it derives, and one clear message for each kind of bad input."""

import dataclasses
import datetime
import itertools
import math
import re
import sys
from pathlib import Path

import numpy as np
import pytest
import yaml

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "py"))
from nonsmooth.errors import OldNameWarning  # noqa: E402
from nonsmooth.model import geometry  # noqa: E402
from nonsmooth.model.section import data as section_data  # noqa: E402
from nonsmooth.section import FOLDER, Disks, SectionError, block, load, of, shipped  # noqa: E402

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
    assert "jiufengershan" in shipped()
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
    assert section.water.pressure_gradient_xy == pytest.approx([-9810 * math.cos(b) * n for n in section.normal])
    assert section.water.height(22.5) == 22.5
    assert section.water.point == (0.0, 0.0)


@pytest.mark.parametrize("dip", [-35.0, 0.0, 21.0, 80.0])
def test_water_that_flows_along_the_plane_lifts_and_drags(section, dip):
    """Paper, 3.4 and Figure 4: buoyancy, γ_w upwards, and seepage, γ_w sin β down the plane; together they are along
    its normal.
    """
    water = dataclasses.replace(section.water, dip=dip)
    b = math.radians(dip)
    down, normal = np.array([math.cos(b), -math.sin(b)]), np.array(
        water.normal
    )  # down to the right, for dips below 0 too
    force = -np.array(water.pressure_gradient_xy)
    assert force == pytest.approx(np.array([0, 9810]) + 9810 * math.sin(b) * down, abs=1e-8)
    assert (force @ down, force @ normal) == pytest.approx((0, 9810 * math.cos(b)), abs=1e-8)
    # still water: buoyancy alone, on any plane, to the bit
    still = dataclasses.replace(water, pressure_gradient="hydrostatic").pressure_gradient_xy
    assert [c.hex() for c in still] == [(0.0).hex(), (-9810.0).hex()]


@pytest.mark.parametrize(
    "old, new, said",
    [
        ("buoyant", "parallel_seepage", "; write `pressure_gradient: parallel_seepage`"),
        (
            [3.0, 5e3],
            (-3.0, -5e3),
            ", for the force per volume, which is −∇p; write `pressure_gradient: [-3.0, -5000.0]`",
        ),
    ],
)
def test_the_old_name_of_the_pressure_gradient_is_read_with_one_warning(tmp_path, old, new, said):
    path = tmp_path / "s.yaml"
    path.write_text(changed(water__pressure_gradient=None, water__gradient=old))
    with pytest.warns(OldNameWarning) as told:
        read = load(path)
    line = 1 + [line.strip() for line in path.read_text().split("\n")].index(
        "gradient: buoyant" if old == "buoyant" else "gradient:"
    )
    assert [str(one.message) for one in told] == [
        f"{path}: line {line}: water.gradient: is the old name of pressure_gradient{said}"
    ]
    assert read.water.pressure_gradient == new
    # what a run keeps of it has the new name
    assert "gradient" not in section_data.plain(read)["water"]


def test_the_water_rises_by_its_table_and_then_at_its_rate(section):
    water = dataclasses.replace(section.water, table=((0.0, 2.0), (10.0, 4.0), (20.0, 3.0)), rate=0.5)
    # exact but for rounding
    assert water.height(np.array([-5.0, 0.0, 5.0, 10.0, 15.0, 20.0, 24.0])) == pytest.approx([2, 2, 3, 4, 3.5, 3, 5])


@pytest.mark.parametrize("distribution, median", [("uniform_by_volume", 8 / 5), ("uniform_by_number", 5 / 2)])
def test_sizes_by_quantile(distribution, median):
    """From the smallest to the largest; the median of d⁻² between 1 and 4 is 2 · 1 · 4/(1 + 4)."""
    disks = Disks(1.0, 4.0, distribution, 0.84)
    assert disks.diameters([0.0, 0.5, 1.0]) == pytest.approx([1, median, 4])
    quantiles = (np.arange(10_000) + 0.5) / 10_000
    # by the rule of midpoints
    assert disks.mean_square == pytest.approx(np.mean(disks.diameters(quantiles) ** 2), rel=1e-6)


def test_the_smallest_and_the_largest_disk_are_of_all_layers(section):
    """The shipped section has disks of 1 to 4 m; layers may have smaller and larger ones of their own, and where all
    have, the section's count no longer.
    """

    def of(low, high):
        return dataclasses.replace(section.disks, d_min=low, d_max=high)

    def own(**sizes):
        return dataclasses.replace(
            section,
            layers=tuple(
                dataclasses.replace(layer, disks=of(*sizes[f"k{k}"]) if f"k{k}" in sizes else None)
                for k, layer in enumerate(section.layers)
            ),
        )

    assert (section.smallest, section.largest, section.mixed) == (1.0, 4.0, False)
    for made, sizes in (
        (own(k0=(2.0, 7.0)), (1.0, 7.0)),
        (own(k1=(0.5, 2.0)), (0.5, 4.0)),
        (own(k1=(0.5, 2.0), k3=(6.0, 9.0)), (0.5, 9.0)),
        (own(**{f"k{k}": (2.0, 3.0) for k in range(len(section.layers))}), (2.0, 3.0)),
    ):
        assert (made.smallest, made.largest, made.mixed) == (*sizes, True)


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


def test_a_block_of_rock_is_filled_as_high_as_it_is(section):
    """Samples are pressed between walls, or not at all: never raised as the layers of a pressed slope are."""
    made = block(30.0, 60.0, seed=4)
    assert made.area == 1800.0 and made.growth == 1.0 and made.seed == 4
    assert made.materials["rock"] == section.materials["rock"] and not made.pressed and section.growth > 1.005


def test_with_rock_changes_the_layers_alone(section):
    wwr = dataclasses.replace(section.materials["rock"], name="wwr", bond_creation_distance=0.015)
    other = section.with_rock(wwr)
    assert other.materials["rock"] == dataclasses.replace(wwr, name="rock")
    assert all(other.materials[k] == m for k, m in section.materials.items() if k != "rock")
    # the same packing, another slope
    assert other.key() == section.key() and other.key("settled") != section.key("settled")
    with pytest.raises(SectionError, match="no density"):
        section.with_rock(section.materials["ss"])


def test_count_in_the_file(tmp_path):
    path = tmp_path / "s.yaml"
    path.write_text(changed(disks__count=2000))
    assert sum(load(path).disk_counts()) == pytest.approx(2000, abs=2)


@pytest.mark.parametrize("count", [0, -5, 2.5, True, math.nan, math.inf, 10**12])
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
    path.write_text(
        TEXT.replace("100.0e3          # Pa", "1e5")
        .replace("plane: DP  ", "plane: {point: [1, 2], dip: 10}")
        .replace("pressure_gradient: parallel_seepage", "pressure_gradient: [0, -5000]")
        .replace("{rate: 1.0}", "{points: [[0, 1], [10, 6]]}")
    )
    s = load(path)
    assert s.materials["rock"].tensile_strength == 1e5
    assert (
        s.water.pressure_gradient == s.water.pressure_gradient_xy == (0.0, -5e3)
        and s.water.wall is None
        and s.water.dip == 10
    )
    # that of the slope
    assert s.water.normal == pytest.approx(
        (math.sin(math.radians(10)), math.cos(math.radians(10)))
    ) and s.dip == pytest.approx(21, abs=1e-4)
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
    "negative size": (dict(disks__diameter=[-1.0, 4.0]), "disks.diameter[0]: -1.0", "1e-6 or more"),
    "sizes turned round": (dict(disks__diameter=[4.0, 1.0]), "disks.diameter", "smaller one first"),
    "NaN": (dict(gravity=math.nan), "gravity: nan", "finite"),
    "infinite vertex": (
        dict(walls__0__vertices=[[-1428.378, math.inf], [0.0, 0.0]]),
        "walls[DP].vertices[0][1]: inf",
        "finite",
    ),
    "text for a number": (dict(gravity="fast"), "gravity: 'fast' is text", "m/s²"),
    "true for a number": (dict(gravity=True), "gravity: True is true or false", "m/s²"),
    "count": (dict(disks__count=2.5), "disks.count: 2.5 is no whole number", "1 to 10000000"),
    "unknown material": (
        dict(walls__1__material="steel"),
        "walls[FB].material: 'steel' is not defined",
        "rock, dp, fb, ss",
    ),
    "name taken": (dict(layers__2__name="L1"), "layers[L1].name: 'L1' is taken", "own name"),
    "no density": (dict(materials__rock__density=None), "no density", "kg/m³"),
    "no strength": (dict(materials__fb__tensile_strength=None), "without tensile_strength", "bonded: false"),
    "weakening rock": (
        dict(materials__rock__slip_weakening={"law": "step", "critical_slip": 1.0}),
        "slip_weakening",
        "walls only",
    ),
    "hole between walls": (
        dict(walls__1__vertices=[[0.5, 0.0], [23.294, 60.683]]),
        "a hole of 0.5 m",
        "the same point",
    ),
    "hole below": (dict(walls__0__vertices=[[-1000.0, 383.86], [0.0, 0.0]]), "disks could fall out", "extend a wall"),
    "self-crossing wall": (
        dict(walls__2__vertices=[[23.294, 60.683], [473, 21], [473, 50], [100, 0]]),
        "crosses itself",
        "order",
    ),
    "vertex twice": (
        dict(walls__0__vertices=[[-1428.378, 548.303], [0.0, 0.0], [0.0, 0.0]]),
        "two vertices in a row",
        "remove one",
    ),
    "overlap": (
        dict(layers__1__vertices=[[4.0, 10.0], [9.318, 24.273], [-1378.666, 547.215], [-1389.518, 542.384]]),
        "layers[L2].vertices: overlaps layer L1",
        "touch at most",
    ),
    "bow tie": (
        dict(layers__0__vertices=[[0.0, 0.0], [-1389.518, 542.384], [4.659, 12.137], [-1400.371, 537.552]]),
        "Self-intersection",
        "in order around",
    ),
    "flat layer": (
        dict(layers__0__vertices=[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]),
        "layers[L1].vertices",
        "in order around",
    ),
    "two vertices": (dict(layers__0__vertices=[[0.0, 0.0], [1.0, 0.0]]), "has 2 entries", "three or more"),
    "thin layers": (dict(disks__diameter=[1.0, 200.0]), "no room", "smaller diameters"),
    "unknown plane": (dict(water__plane="XX"), "no wall is called 'XX'", "DP, FB, SS"),
    "bent plane": (dict(water__plane="SS"), "SS is not straight", "straight wall"),
    "rate and points": (dict(water__table={"rate": 1.0, "points": [[0, 0]]}), "water.table: has 2 entries", "either"),
    "times falling": (dict(water__table={"points": [[0, 0], [5, 1], [4, 2]]}), "water.table.points[2]", "rising order"),
    "no path": (dict(numerics__path=0.0), "numerics.path: 0.0", "left out, all steps are as long"),
    "hidden infinity": (dict(stages__dry=1e308), "stages.dry: 1e+308 is too large", "at most 1e+18"),
    "400 digits": (dict(gravity=10**400), "gravity: a number of more than", "at most 1e+18"),
    "5000 digits": (dict(numerics__max_iterations="@" + "9" * 5000), "no valid YAML", "correct the file"),
    "far away": (dict(layers__0__vertices=[[0.0, 0.0], [1e9, 0.0], [2.0, 5.0]]), "vertices[1][0]: 1000000000.0", "1e7"),
    "too many disks": (dict(disks__count=10**12), "disks.count: 1000000000000", "1 to 10000000"),
    "too small disks": (dict(disks__diameter=[1e-5, 2e-5]), "disks would fill the layers", "larger diameters"),
    "no gravity": (dict(gravity=0.0), "gravity: 0.0", "9.81 on Earth"),
    "gravity in the sea of numbers": (dict(gravity=9.81e6), "gravity: 9810000.0", "9.81 on Earth"),
    "density in g/cm³": (dict(materials__rock__density=2.5), "materials.rock.density: 2.5", "rock has some 2500"),
    "density in mg/m³": (dict(materials__rock__density=2.5e9), "materials.rock.density: 2500000000.0", "300 to 10000"),
    "long step": (
        dict(numerics__time_step=0.3),
        "numerics.time_step: in 0.3 s the smallest disk, 1 m, would fall past its own diameter",
        "less than 0.23 s",
    ),
    "step of nothing": (dict(numerics__time_step=1e-300), "numerics.time_step: 1e-300", "1e-9 or more"),
    "old and new name": (dict(water__gradient="buoyant"), "water.gradient: is the old name", "leave `gradient` out"),
    "no gradient": (
        dict(water__pressure_gradient=[0, -0.0]),
        "water.pressure_gradient: is zero",
        "leave the key `water` out",
    ),
    "no such gradient": (dict(water__pressure_gradient="buoyant"), "'buoyant' is not allowed", "hydrostatic, or"),
    "upright water": (dict(water__plane={"point": [0, 0], "dip": -90}), "water.plane.dip: -90", "above -90"),
    "no such role": (dict(walls__1__role="wall"), "walls[FB].role: 'wall'", "slip (a slip surface)"),
    "nothing slides": (
        dict(walls__0__role="ground", walls__1__role="ground"),
        "walls: none of them has the role slip",
        "role: slip",
    ),
    "reversed floor": (
        dict(walls__0__vertices=[[0.0, 0.0], [-1428.378, 548.303]]),
        "walls[DP].vertices: from (0, 0) to (-1428.378, 548.303) the layers lie " "to the right",
        "the other way round",
    ),
    "reversed valley": (
        dict(walls__2__vertices=[[2100.0, 601.633], [1000.0, 21.313], [23.294, 60.683]]),
        "both FB and SS end at (23.294, 60.683)",
        "the other way round",
    ),
    "crossing walls": (
        dict(
            walls__2__vertices=[
                [23.294, 60.683],
                [473.0, 21.0],
                [473.0, 300.0],
                [-20.0, 300.0],
                [-20.0, -50.0],
                [50.0, -50.0],
            ]
        ),
        "walls[SS].vertices: the wall crosses or covers DP",
        "meet at vertices only",
    ),
    "wall twice": (
        dict(walls__1__vertices=[[-1428.378, 548.303], [0.0, 0.0]]),
        "walls[FB].vertices: the wall crosses or covers DP",
        "meet at vertices only",
    ),
    "sliver": (
        dict(layers__0__vertices=[[0.0, 0.0], [-1400.371, 537.5521], [-1400.371, 537.552]]),
        "layers[L1].vertices: the layer is thinner",
        "thickness",
    ),
    "all at one place": (
        dict(
            walls=[{"name": "a", "material": "ss", "vertices": [[1, 1], [1, 1]]}],
            layers=[{"name": "a", "material": "rock", "vertices": [[1, 1], [1, 1], [1, 1]]}],
        ),
        "no extent",
        "1e-5 m apart",
    ),
    "a date": (dict(seed=datetime.date(2020, 1, 2)), "seed: '2020-01-02' is text", "whole number"),
    "unprintable": (dict(layers__0__name="a\x1b[2J"), "layers", "can be printed"),
    "hold": (dict(stages__water={"hold": "maybe"}), "stages.water.hold: 'maybe'", "motion, never"),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_values(case, refused):
    keys, what, remedy = BAD[case]
    message = refused(changed(**keys).replace("'@", "").replace("9'", "9"))
    assert what in message and remedy in message
    assert ": line " in message or any(words in message for words in ("no room", "disks would fill", "no valid YAML"))


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("first", [False, True])
def test_a_wall_may_begin_within_another(first, turned):
    """At one of its inner vertices, whichever of the two stands first and from whichever end; a step away from there it
    leaves a hole.
    """
    data = section_data.plain(load("jiufengershan"))
    top, foot = data["walls"][0]["vertices"]
    middle = [top[0] / 2, top[1] / 2]
    data["walls"][0]["vertices"] = [top, middle, foot]
    for away in (0.0, 0.5):
        post = [[middle[0], middle[1] - away], [middle[0] - 50, middle[1] - 200]]
        wall = {"name": "post", "role": "ground", "material": "ss", "vertices": post[::-1] if turned else post}
        made = data | {"walls": [wall, *data["walls"]] if first else [*data["walls"], wall]}
        if away:
            with pytest.raises(SectionError, match="a hole of [0-9.]+ m"):
                of(made)
        else:
            assert [w.name for w in of(made).walls].count("post") == 1


def test_line_of_a_number_that_replaces_a_borrowed_one(refused):
    borrowing = "  stone:\n    <<: *rock\n    bond_creation_distance: much\n"
    text = TEXT.replace("  rock: ", "  rock: &rock ", 1).replace("  ss: ", borrowing + "  ss: ", 1)
    assert (
        f"line {1 + text[:text.index('distance: much')].count(chr(10))}: materials.stone.bond_creation_distance"
        in refused(text)
    )


def test_line_number(refused):
    text = TEXT.replace("distribution: uniform", "distribution: even")
    assert f"line {1 + text[:text.index('distribution: even')].count(chr(10))}: disks.distribution" in refused(text)


WRONG = {"gravity": -1, "walls__0__role": "slope", "layers__0__name": 3, "seed": "one", "numerics__path": -2}


@pytest.mark.parametrize("pair", itertools.combinations(WRONG, 2))
def test_of_two_errors_the_one_that_stands_first_is_told(pair, refused):
    text = changed(**{key: WRONG[key] for key in pair})
    lines = {}
    for key in pair:  # where each stands, as it is told when it is alone
        alone = refused(changed(**{key: WRONG[key]}))
        lines[int(re.search(r"line (\d+)", alone)[1])] = alone.partition(": line")[2].partition(": ")[2]
    told = refused(text)
    assert told.endswith("(and 1 more to correct)")
    assert f"line {min(lines)}: {lines[min(lines)]}" in told


@pytest.mark.parametrize(
    "text, what",
    [
        ("", "nothing"),
        ("- 1\n", "a list"),
        ("name: [1\n", "line 2"),
        ("name: a\nname: b\n", "given twice"),
        ("1: 2\n", "is no text"),
        ("name: !!python/object:os.system x\n", "could not determine a constructor"),
        ("name: x\n", "(and 3 more to correct)"),
    ],
)
def test_bad_files(text, what, refused):
    assert what in refused(text)


HOSTILE = {
    "list as a key": ("? [a]\n: b\n", "a list or a map stands where a key is needed"),
    "no int": ("name: !!int x\n", "no valid YAML"),
    "empty int": ("name: !!int ''\n", "no valid YAML"),
    "no bool": ("name: !!bool x\n", "no valid YAML"),
    "no time": ("name: !!timestamp x\n", "no valid YAML"),
    "alias of itself": ("name: &a [*a]\n", "line 1: an alias stands for a list or a map that holds it"),
    "alias of what is around it": ("name: &a {b: {c: *a}}\n", "an alias stands for"),
    "aliases multiply": (
        "a: &a0 [1, 1]\n" + "".join(f"a{k}: &a{k} [*a{k - 1}, *a{k - 1}]\n" for k in range(1, 40)),
        "more than 50000 values",
    ),
    "merges multiply": (
        "a: &a0 {x: 1}\n" + "".join(f"a{k}: &a{k} {{<<: [*a{k - 1}, *a{k - 1}]}}\n" for k in range(1, 40)),
        "more than 50000 values",
    ),
    "deep": ("name: " + 51 * "[" + 51 * "]", "inside each other more than 50 times"),
    "not too deep": ("name: " + 50 * "[" + 50 * "]", "the key 'walls' is missing"),
    "very deep": ("name: " + 9000 * "[", "inside each other more than 50 times"),
    "large": ("name: |\n" + 60_000 * "  ten chars\n", "more than 500000 bytes"),
    "base 60": (TEXT.replace("gravity: 9.81", "gravity: 1:30"), "gravity: '1:30' is text"),
    "base 8": (TEXT.replace("seed: 1 ", "seed: 010 "), "seed: '010' is text"),
    "long words": ("? " + 100_000 * "x" + "\n: " + 100_000 * "y" + "\n" + TEXT, "unknown key"),
    "many materials": (
        "materials:\n"
        + "".join(f"  m{k}: 1\n" for k in range(20_000))
        + TEXT[: TEXT.index("materials:")]
        + TEXT[TEXT.index("\ndisks:") :],
        "(and 199 more to correct)",
    ),
}


@pytest.mark.parametrize("case", HOSTILE)
def test_hostile_files(case, refused):
    text, what = HOSTILE[case]
    message = refused(text)
    assert what in message and len(message) < 1000


def test_a_count_may_be_written_with_a_point(tmp_path):
    path = tmp_path / "s.yaml"
    path.write_text(changed(seed=3.0, numerics__max_iterations=3e2, disks__count=2000.0))
    made = load(path)
    assert [(type(v), v) for v in (made.seed, made.numerics.max_iterations, made.disks.count)] == [
        (int, 3),
        (int, 300),
        (int, 2000),
    ]


def test_a_barrier_may_begin_where_two_walls_meet(tmp_path):
    path = tmp_path / "s.yaml"
    data = yaml.safe_load(TEXT)
    del data["water"]
    data["walls"] = [
        {"name": n, "material": "ss", "vertices": v}
        for n, v in (
            ("floor", [[0, 0], [100, 0]]),
            ("floor 2", [[100, 0], [200, 0]]),
            ("barrier", [[100, 0], [100, 20]]),
        )
    ]
    data["layers"] = [{"name": "column", "material": "rock", "vertices": [[0, 0], [20, 0], [20, 40], [0, 40]]}]
    path.write_text(yaml.safe_dump(data))
    assert len(load(path).walls) == 3


def test_disks_so_small_that_a_step_takes_them_past_each_other(section):
    tiny = dataclasses.replace(section, numerics=dataclasses.replace(section.numerics, time_step=0.2))
    with pytest.raises(SectionError, match="100000 disks.*lower numerics.time_step below 0.15 s, or ask for fewer"):
        tiny.with_disks(100_000)


def test_a_file_without_end_is_refused():
    with pytest.raises(SectionError, match="more than 500000 bytes"):
        load("/dev/zero")


def test_unreadable_files(tmp_path):
    (tmp_path / "b.yaml").write_bytes(b"\xff\xfe\x00")
    for name, what in (
        (tmp_path / "none.yaml", "no such file"),
        (tmp_path, "cannot be read"),
        (tmp_path / "b.yaml", "UTF-8"),
        ("no-such-section", "jiufengershan"),
        ("x" * 5000, "no path.*jiufengershan"),
        ("x" * 5000 + ".yaml", "cannot be read"),
        ("a\0b", "no path|no such|neither"),
    ):
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
        math.pi / 4 * (1 + 1 / 2 + 1 / 4), rel=1e-4
    )
    bent = geometry.edges(geometry.Polygon([(0, 0), (2, 0), (2, 2), (1, 1), (0, 2)]))
    assert bent.convex_start.sum() == 4 and bent.convex_end.sum() == 4
    inside = geometry.contains(square, np.array([1.0, 3.0, 1.9]), np.array([1.0, 1.0, -0.1]))
    assert inside.tolist() == [True, False, False]
