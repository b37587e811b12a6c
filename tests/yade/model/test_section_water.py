"""Water of a section that is no table: what its keys mean, what comes back from them, and what is refused. Needs no
YADE.
"""

import copy
import re
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "py"))
from nonsmooth import section, similar  # noqa: E402
from nonsmooth.model.section import data as section_data  # noqa: E402
from nonsmooth.model.section.folder import SCHEMA  # noqa: E402
from nonsmooth.model.section.reader import read  # noqa: E402
from nonsmooth.water import of_section  # noqa: E402
from nonsmooth.water import field_files  # noqa: E402
from nonsmooth.water.fields import FieldError, MeshField, PhreaticLine  # noqa: E402
from nonsmooth.water.mesh import grid  # noqa: E402

SMALL = ROOT / "tests" / "data" / "small_slope.yaml"
LINES = [
    {"time": 1.0, "points": [[-40.0, 16.0], [10.0, -2.0]]},
    {"time": 3.0, "points": [[-40.0, 18.5], [-20.0, 12.0], [0.0, 2.0], [10.0, 2.0]]},
]
PHREATIC = {"volume": "bulk", "phreatic": {"lines": LINES}}


def data(water=PHREATIC, **keys):
    """The small slope's data with other water."""
    made = read(SMALL, SCHEMA).data
    del made["stages"]["water"]
    return {**made, "water": copy.deepcopy(water), **keys}


def refusal(change, water=PHREATIC):
    """The message about data of a section that ``change(data)`` has changed."""
    made = data(water)
    change(made)
    with pytest.raises(section.SectionError) as error:
        section.of(made)
    return str(error.value)


# ---- what keys mean ---------------------------------------------------------------------------------
def test_lines_have_the_values_of_the_file_and_defaults_for_the_rest():
    made = section.of(data())
    water = made.water_field
    assert made.water is water and made.water_table is None and made.stages.water_hold == "never"
    assert water.lines == tuple((one["time"], tuple(map(tuple, one["points"]))) for one in LINES)
    assert (water.flow, water.outside, water.volume, water.unit_weight) == ("sideways", "refuse", "bulk", 9810.0)
    assert made.release_distance == 0.5  # D_c of the plane
    table = section.load(str(SMALL))
    assert table.water_field is None and table.water_table is table.water


def test_the_data_of_a_section_give_it_again():
    made = section.of(data())
    again = section.of(section_data.plain(made))
    assert again.water == made.water and again.stages == made.stages
    assert made.with_values({"seed": 4}).water == made.water
    assert made.with_values({"water.phreatic.flow": "along"}).water.flow == "along"


def test_a_mirrored_slope_has_mirrored_lines():
    made = section.of(data())
    mirrored = similar.mirrored(made)
    assert mirrored.water.lines[1][1] == ((-10.0, 2.0), (0.0, 2.0), (20.0, 12.0), (40.0, 18.5))
    assert similar.mirrored(mirrored).water == made.water
    points = np.random.default_rng(2).uniform((-36, -5), (9, 18), (200, 2))
    here, there = of_section.field(made), of_section.field(mirrored)
    assert there.pressure(points * (-1, 1), 2.0) == pytest.approx(here.pressure(points, 2.0), rel=1e-12)


def test_a_similar_slope_has_lines_in_proportion():
    made = section.of(data())
    large = similar.scaled(made, 4.0)
    assert large.water.lines[0] == (2.0, ((-160.0, 64.0), (40.0, -8.0)))
    assert large.with_values({"seed": 3}).water == large.water
    assert large.with_values({"seed": 3}).like[0].water == made.water


# ---- the field --------------------------------------------------------------------------------------
@pytest.mark.parametrize("flow", ["sideways", "along"])
def test_the_field_below_lines_is_exact(flow):
    """At all places and at times between states; pressures along a line that turns are linear in time."""
    made = section.of(data({"phreatic": {"lines": LINES, "flow": flow}, "unit_weight": 9500.0}))
    field = of_section.field(made)
    line = PhreaticLine([one["points"] for one in LINES], [1.0, 3.0], 9500.0, flow == "along")
    points = np.random.default_rng(3).uniform((-40, -9), (10, 29), (500, 2))
    for time in (1.0, 3.0, 7.0, *((2.2,) if flow == "sideways" else ())):
        assert field.pressure(points, time) == pytest.approx(line.pressure(points, time), rel=1e-12, abs=1e-9)
        assert field.gradient(points, time) == pytest.approx(line.gradient(points, time), rel=1e-9, abs=1e-6)
    assert field.at(2.0) == pytest.approx(0.5 * (field.at(1.0) + field.at(3.0)))


def test_pressures_grow_from_nothing_until_the_first_state():
    field = of_section.field(section.of(data()))
    assert list(field.times) == [0.0, 1.0, 3.0] and not field.at(0.0).any()
    assert field.at(0.25) == pytest.approx(0.25 * field.at(1.0), rel=1e-12)
    lines = [{**LINES[0], "time": 0.0}]
    assert list(of_section.field(section.of(data({"phreatic": {"lines": lines}}))).times) == [0.0]


def test_open_water_above_the_ground_is_still():
    lines = [{"time": 0.0, "points": [[-40.0, 12.0], [10.0, 12.0]]}]
    field = of_section.field(section.of(data({"phreatic": {"lines": lines, "flow": "along"}})))
    points = np.array([[0.0, 11.0], [5.0, 4.0], [-5.0, 5.0]])  # two of them over the ground
    assert field.gradient(points) == pytest.approx(np.array([[0.0, -9810.0]] * 3))
    assert field.pressure([[0.0, 12.5]]) == 0


def test_a_section_with_a_table_has_no_field_and_what_is_no_section_is_refused():
    assert of_section.field(section.load(str(SMALL))) is None
    with pytest.raises(FieldError, match="give a Section"):
        of_section.field("circle")


# ---- files ------------------------------------------------------------------------------------------
@pytest.fixture
def files(tmp_path):
    """Files of a field that covers the layers, with two states: HDF5, and two VTK files; (folder, MeshField)."""
    import meshio

    mesh = grid(np.linspace(-50, 20, 36), np.linspace(-5, 25, 16))
    x, y = mesh.nodes.T
    field = MeshField(mesh, [2.0, 4.0], [9810 * (3 - 0.3 * x - y), 9810 * (5 - 0.25 * x - y)])
    field_files.write(field, tmp_path / "field.h5")
    for k, pressures in enumerate(field.pressures):
        cells = [("triangle", mesh.triangles)]
        meshio.Mesh(np.column_stack((mesh.nodes, 0 * x)), cells, {"p": pressures}).write(tmp_path / f"state{k}.vtk")
    return tmp_path, field


def of_file(folder, **keys):
    return section.of(data({"field": {"file": str(folder / "field.h5"), **keys}}))


def test_a_file_has_its_field_with_its_times(files):
    folder, field = files
    found = of_section.field(of_file(folder))
    assert list(found.times) == [0.0, 2.0, 4.0] and not found.pressures[0].any()
    assert np.array_equal(found.pressures[1:], field.pressures) and np.array_equal(found.mesh.nodes, field.mesh.nodes)
    slow = of_section.field(of_file(folder, stretch=3.0))
    assert list(slow.times) == [0.0, 6.0, 12.0] and np.array_equal(slow.pressures[1:], field.pressures)


def test_files_of_states_have_the_times_of_the_section(files):
    folder, field = files
    states = [{"time": t, "file": str(folder / f"state{k}.vtk")} for k, t in enumerate((0.0, 7.0))]
    found = of_section.field(section.of(data({"field": {"states": states, "name": "p", "stretch": 9.0}})))
    assert list(found.times) == [0.0, 7.0] and found.pressures == pytest.approx(field.pressures, rel=1e-12)


def test_paths_of_a_section_file_begin_at_its_folder(files, monkeypatch):
    import yaml

    folder, _ = files
    (folder / "slope.yaml").write_text(yaml.safe_dump(data({"field": {"file": "field.h5"}})))
    monkeypatch.chdir("/")
    made = section.load(str(folder / "slope.yaml"))
    assert made.water.files == (str(folder / "field.h5"),)
    assert section.of(section_data.plain(made)).water == made.water


def test_a_mirrored_and_a_larger_field(files):
    folder, field = files
    made = of_file(folder)
    mirrored, large = similar.mirrored(made), similar.scaled(made, 4.0)
    points = np.random.default_rng(4).uniform((-30, 0), (0, 15), (100, 2))
    there = of_section.field(mirrored)
    assert there.pressure(points * (-1, 1), 3.0) == pytest.approx(field.pressure(points, 3.0), rel=1e-9)
    wide = of_section.field(large)
    assert list(wide.times) == [0.0, 4.0, 8.0]
    assert wide.pressure(4 * points, 6.0) == pytest.approx(4 * field.pressure(points, 3.0), rel=1e-9)
    assert similar.mirrored(mirrored).water == made.water and large.with_values({"seed": 2}).water == large.water
    assert similar.scaled(section.of(section_data.plain(made)), 4.0).water == large.water


def test_a_run_keeps_its_field_beside_its_section(files, tmp_path):
    folder, field = files
    made, home = of_file(folder, mirrored=False, stretch=2.0), tmp_path / "run"
    home.mkdir()
    found = of_section.field(made)
    section_data.write(of_section.kept(made, found, home), home / "section.yaml")
    (folder / "field.h5").unlink()
    home = home.rename(tmp_path / "moved")
    again = of_section.field(section.load(str(home / "section.yaml")))
    assert np.array_equal(again.pressures, found.pressures) and np.array_equal(again.times, found.times)
    assert np.array_equal(again.mesh.nodes, found.mesh.nodes)
    assert np.array_equal(again.mesh.triangles, found.mesh.triangles)


def test_water_with_other_files_has_another_key(files):
    folder, field = files
    one = of_file(folder)
    field_files.write(MeshField(field.mesh, field.times, 2 * field.pressures), folder / "other.h5")
    other = section.of(data({"field": {"file": str(folder / "other.h5")}}))
    (folder / "copy.h5").write_bytes((folder / "field.h5").read_bytes())
    copied = section.of(data({"field": {"file": str(folder / "copy.h5")}}))
    assert one.water.key == copied.water.key != other.water.key


def test_a_field_must_cover_the_layers(files):
    folder, _ = files
    mesh = grid(np.linspace(-30, 20, 26), np.linspace(-5, 25, 16))
    field_files.write(MeshField(mesh, [0.0], [9810 * (3 - mesh.nodes[:, 1])]), folder / "field.h5")
    with pytest.raises(FieldError) as error:
        of_section.field(of_file(folder))
    said = str(error.value)
    assert re.match(
        r"section: water.field: .*field.h5: its mesh, which lies within -30, -5, 20, 25 m, does not cover", said
    )
    assert "water.outside: dry" in said
    made = section.of(data({"field": {"file": str(folder / "field.h5")}, "outside": "dry"}))
    assert of_section.field(made).pressure([[-35.0, 0.0]], 0.0, outside="dry") == 0


def test_a_mesh_with_a_hole_does_not_cover_what_lies_in_it(files):
    folder, field = files
    keep = np.linalg.norm(field.mesh.nodes[field.mesh.triangles].mean(axis=1) - (-16.0, 9.0), axis=1) > 3.0
    from nonsmooth.water.mesh import Mesh

    holed = Mesh.of(field.mesh.nodes, field.mesh.triangles[keep])
    field_files.write(MeshField(holed, [0.0], [np.zeros(len(holed.nodes))]), folder / "field.h5")
    with pytest.raises(FieldError, match="does not cover the layers"):
        of_section.field(of_file(folder))


def test_files_that_are_refused(files):
    folder, _ = files
    said = []
    for field in (
        {"file": str(folder / "none.h5")},
        {"file": str(folder / "field.h5"), "sha256": 64 * "0"},
        {"file": str(folder / "field.h5"), "states": [{"time": 0.0, "file": "x"}]},
        {},
        {"states": [{"time": 1.0, "file": str(folder / "state0.vtk")}, {"time": 1.0, "file": "x"}]},
        {
            "states": [
                {"time": 1.0, "file": str(folder / "state0.vtk")},
                {"time": 2.0, "file": str(folder / "none.vtk")},
            ]
        },
    ):
        with pytest.raises(section.SectionError) as error:
            section.of(data({"field": field}))
        said.append(str(error.value))
    parts = (
        ("water.field.file", "none.h5 cannot be read (No such file", "HDF5"),
        ("water.field.sha256", "has the checksum", "leave `sha256` out"),
        ("water.field: has both `file` and `states`", "give one file"),
        ("water.field: has neither `file` nor `states`", "give one file"),
        ("water.field.states[1].time: the time 1 s does not follow 1 s", "rising"),
        ("water.field.states[1].file", "none.vtk cannot be read (No such file"),
    )
    for one, wanted in zip(said, parts, strict=True):
        assert all(part in one for part in wanted) and "\n" not in one, one
    with pytest.raises(FieldError, match="^section: water.field: .*field.h5: has no dataset q; it has"):
        of_section.field(of_file(folder, name="q"))


# ---- what is refused --------------------------------------------------------------------------------
def put(*way, value):
    def change(made):
        place = made
        for word in way[:-1]:
            place = place[word]
        place[way[-1]] = value

    return change


OF_LINES = ("water", "phreatic", "lines")
REFUSED = {
    "two kinds": (put("water", "plane", value="DP"), "water.phreatic: plane and phreatic are given", "keep one"),
    "a table's key": (
        put("water", "pressure_gradient", value="hydrostatic"),
        "water.phreatic: pressure_gradient and phreatic",
        "keep one",
    ),
    "no kind": (
        lambda made: made["water"].pop("phreatic"),
        "the key 'plane' is missing",
        "phreatic, field or seepage instead",
    ),
    "held": (
        put("stages", "water", value={"hold": "motion"}),
        "stages.water.hold: a water table can be held, and this water is water.phreatic",
        "leave `stages.water` out",
    ),
    "times": (
        put(*OF_LINES, 1, "time", value=1.0),
        "water.phreatic.lines[1].time: the time 1 s does not follow 1 s",
        "rising",
    ),
    "back": (
        put(*OF_LINES, 1, "points", value=[[-40.0, 18.0], [5.0, 2.0], [5.0, 1.0]]),
        "water.phreatic.lines[1].points[2]: the line goes from x = 5 to x = 5 m",
        "rising x",
    ),
    "short": (
        put(*OF_LINES, 0, "points", value=[[-30.0, 12.0], [5.0, 0.5]]),
        "water.phreatic.lines[0].points: the line at t = 1 s goes from x = -30 to x = 5 m, and the layers from -36 to",
        "water.outside: dry",
    ),
    "short to the right": (
        put(*OF_LINES, 0, "points", value=[[-40.0, 16.0], [-5.0, 2.0]]),
        "water.phreatic.lines[0].points: the line at t = 1 s goes from x = -40 to x = -5 m",
        "water.outside: dry",
    ),
    "above the ground": (
        put(*OF_LINES, 1, "points", value=[[-40.0, 18.5], [-20.0, 18.0], [5.0, 0.5]]),
        "lines[1].points: at t = 3 s and x = -36 m the line lies at y = 18.4 m, above the ground at 16.78",
        "level where open water stands",
    ),
    "above the ground beyond the layers": (
        put(*OF_LINES, 1, "points", value=[[-40.0, 16.0], [5.0, 1.0], [30.0, 8.0]]),
        "above the ground at",
        "level where open water stands",
    ),
    "nan": (put(*OF_LINES, 0, "points", 0, 1, value=float("nan")), "nan is no finite number", "finite"),
    "one point": (put(*OF_LINES, 0, "points", value=[[0.0, 0.0]]), "water.phreatic.lines[0].points", "2 to 5000"),
    "a negative time": (put(*OF_LINES, 0, "time", value=-1), "-1 is not allowed", "since t0"),
    "flow": (put("water", "phreatic", "flow", value="down"), "'down' is not allowed", "sideways"),
    "a level line that ends in the ground": (
        put(*OF_LINES, 1, "points", value=[[-40.0, 18.5], [-36.0, 12.0], [-5.0, 12.0], [5.0, 2.0]]),
        "above the ground at",
        "a point where the water's edge meets the ground",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_refused_is_named_with_its_value_and_a_remedy(case):
    change, *parts = REFUSED[case]
    said = refusal(change)
    assert all(part in said for part in parts) and "\n" not in said, said


def late(kind, time):
    """The small slope's data with water that comes to its last state at a ``time`` [s] after t0."""
    if kind == "table":
        made = read(SMALL, SCHEMA).data
        made["water"] = {"plane": "DP", "table": {"points": [[0.0, 0.0], [time, 1.0]]}}
        return made
    states = {
        "phreatic": {"lines": [LINES[0], LINES[1] | {"time": time}]},
        "seepage": {"size": 4.0, "conductivity": 1e-5, "states": [{"time": 0.5}, {"time": time, "rain": 1e-6}]},
    }
    return data({"volume": "bulk", kind: states[kind]})


@pytest.mark.parametrize("kind", ["table", "phreatic", "seepage"])
def test_water_that_comes_after_the_run_is_refused(kind):
    """The run ends at the latest stages.end.time after settling, and t0 is stages.dry after it."""
    stages = section.load(str(SMALL)).stages
    longest, more = stages.end.time - stages.dry, stages.dry / 2
    assert more > 0 and section.of(late(kind, longest)).water
    with pytest.raises(section.SectionError) as error:
        section.of(late(kind, longest + more))
    said, place = str(error.value), {"table": "table.points", "phreatic": "phreatic.lines", "seepage": "seepage.states"}
    assert f"water.{place[kind]}" in said and f"{longest + more:g} s after t0 is no time of the run" in said
    assert f"give stages.end.time of {int(np.ceil(stages.end.time + more))} s and more" in said and "\n" not in said


def test_lines_without_a_common_part_are_refused():
    lines = [{"time": 0.0, "points": [[-40.0, 5.0], [-30.0, 5.0]]}, {"time": 1.0, "points": [[-20.0, 5.0], [0.0, 1.0]]}]
    made = section.of(data({"phreatic": {"lines": lines}, "outside": "dry"}))
    with pytest.raises(FieldError, match="section: water.phreatic.lines: the lines have no x in common"):
        of_section.field(made)
