"""Public functions that are given a value of another kind than they take: one line with the argument, the value and
what would do, before anything is done.
"""

import math

import numpy as np
import pytest
from yade import O
from yade.nonsmooth import (
    campaign,
    experiment,
    figures,
    ground_motion,
    newmark,
    paraview,
    records,
    runs,
    scene,
    section,
    section_values,
    similar,
    tables,
    video,
    worlds,
)
from yade.nonsmooth.errors import UserError
from yade.nonsmooth.heaps import column
from yade.nonsmooth.laboratory import (
    biaxial_test,
    campaign as tests_of_rock,
    materials,
    pressing,
    report,
    tension_report,
    tension_test,
)
from yade.nonsmooth.system import checks
from yade.wrapper import ContactDynamicsEngine, NscdMat, PorePressureEngine

pytestmark = pytest.mark.usefixtures("empty")
NAN, INF = math.nan, math.inf
CIRCLE = section.load("circle")
TENSION = tension_test.TensionTest(materials.load("wwr"), pressing.Shape(300, 1))


def stuff():
    return NscdMat(density=2500)


# ---- the checks -----------------------------------------------------------------------------------


class Refused(ValueError):
    pass


@pytest.mark.parametrize("value", [None, "1", [1], True, NAN, INF, -INF, 1j])
def test_what_is_no_number(value):
    with pytest.raises(Refused, match="^length .*: give metres$"):
        checks.number("length", value, Refused, "give metres")


def test_bounds_of_a_number_from_both_sides():
    for value, bounds in ((1.0, dict(least=1)), (1, dict(most=1)), (1.01, dict(above=1)), (0.99, dict(below=1))):
        assert checks.number("x", value, Refused, "", **bounds) == value
    for value, bounds in ((0.99, dict(least=1)), (1.01, dict(most=1)), (1, dict(above=1)), (1.0, dict(below=1))):
        with pytest.raises(Refused):
            checks.number("x", value, Refused, "", **bounds)


def test_what_is_no_count():
    assert checks.count("n", 3, Refused, "", least=3, most=3) == 3
    for value in (None, "3", 3.0, True, NAN, 2, 4):
        with pytest.raises(Refused):
            checks.count("n", value, Refused, "give 3", least=3, most=3)


def test_a_value_is_shown_on_one_line_and_cut():
    assert checks.shown("a\nb") == r"'a\nb'" and len(checks.shown(list(range(1000)))) == checks.LONGEST + 1
    assert checks.shown("/a" * 100 + "/figure.xyz").endswith("/figure.xyz'")
    # sixty characters, quotes and all, are shown as they are; of more 36 and 24
    assert checks.shown("x" * 58) == repr("x" * 58) and checks.shown("x" * 59) == f"'{35 * 'x'}…{23 * 'x'}'"
    assert "\n" not in checks.shown(CIRCLE)


def test_a_decorated_function_is_called_as_before_and_python_says_what_is_missing():
    @checks.takes(Refused, x=checks.real("give a number"))
    def twice(x, y=2):
        """Doubles."""
        return x * y

    assert (twice(3), twice(x=3, y=4), twice.__name__, twice.__doc__) == (6, 12, "twice", "Doubles.")
    with pytest.raises(Refused, match="^x 'a': give a number$"):
        twice("a")
    with pytest.raises(TypeError, match="missing 1 required"):
        twice()


# ---- public functions -----------------------------------------------------------------------------

FLOOR = [(0, 0), (1, 0)]
BREAKS = dict.fromkeys(("step", "time", "id1", "id2", "mode", "x", "y"), np.zeros(0))  # as tables.breaks has them
ROWS = [{"values": {"seed": 1}, "numbers": {"front_m": {"values": [2.0], "mean": 2.0, "half_width": None}}}]
CALLS = [
    ("section", lambda v: section.load(v), (None, [1], -1, NAN, {}), "give the path of a YAML file, or one of: acads_1a"),
    ("circle.yaml: disks|.*: disks", lambda v: CIRCLE.with_disks(v), (None, "600", [600], -1, NAN, INF, 600.5, True), "give a whole number from 1 to"),
    (".*: rock", lambda v: CIRCLE.with_rock(v), (None, "wwr", [1], -1), "give a Material, or the plain data"),
    (".*: a critical slip of", lambda v: CIRCLE.with_critical_slip(v), (None, "1", [1], -1, NAN, INF), "give a distance above 0"),
    (".*: values", lambda v: CIRCLE.with_values(v), (None, "seed", [1], -1), "give a dictionary {key: value}"),
    ("key", lambda v: CIRCLE.with_values({v: 1}), (None, 3, NAN, (1, 2), ()), "give words with dots"),
    ("section: data", lambda v: section.of(v), ("x", [1], -1), "give a dictionary with the keys"),
    ("section", lambda v: section_values.given(v), (None, "circle", [1]), "give a Section"),
    ("section", lambda v: similar.mirrored(v), (None, "circle", {}), "give a Section"),
    ("section", lambda v: similar.scaled(v, 2), (None, "circle", {}), "give a Section"),
    (".*: factor", lambda v: similar.scaled(CIRCLE, v), (None, "2", [2], -1, 0, NAN, INF), "give a factor from 1e-05 to 1000"),
    ("section", lambda v: experiment.begin(v, "out"), (None, "circle", {}), "give a Section"),
    ("section", lambda v: experiment.resume(v, "out"), (None, "circle", {}), "give a Section"),
    ("folder", lambda v: experiment.begin(CIRCLE, v), (None, 3, [1], ""), "give the path of a folder"),
    ("packing", lambda v: experiment.begin(CIRCLE, "out", packing=v), ("circle.txt", {}, 3), "give a Packing"),
    ("world", lambda v: experiment.begin(CIRCLE, "out", world=v), ("soft", {}, 3), "give"),
    ("folder", lambda v: runs.open_run(v), (None, 3, [1]), "give the path of the folder of a run"),
    ("folder", lambda v: campaign.open_script(v), (None, 3, [1]), "give the path of the folder of a run"),
    ("folder", lambda v: campaign.open_heap(v), (None, 3, [1]), "give the path of the folder of a run"),
    ("folder", lambda v: campaign.open_comparison(v), (None, 3, [1]), "give the path of the folder of a run"),
    ("snapshot", lambda v: runs.Run("out").snapshot(v), (None, "t9", [1], NAN), "give 't0', 'end' or a time"),
    ("path", lambda v: records.read_series(v), (None, 3, [1], {}), "give the path of a file"),
    ("path", lambda v: records.read_walls(v), (None, 3, [1], {}), "give the path of a file"),
    ("path", lambda v: records.read_surface_arrays(v), (None, 3, [1], {}), "give the path of slip_surface.csv or slip_surface.h5"),
    ("cells", lambda v: records.surface_arrays(v), (None, "x", [1], {"wall": []}), "give columns of slip_surface.csv"),
    ("surfaces", lambda v: records.since_set_back(v), (None, "x", [1], {"circle": {"slip_m": 3}}), "give arrays by walls"),
    ("surfaces", lambda v: records.write_surface_arrays(v, "a.h5", {}), (None, "x", [1], {"circle": {"slip_m": 3}}), "give arrays by walls"),
    ("columns", lambda v: records.write_surface_arrays({}, "a.h5", v), (None, "x", [1]), "give what the columns are"),
    ("path", lambda v: records.read_breaks(v), (None, 3, [1], {}), "give the path of a file"),
    ("path", lambda v: records.read_snapshot(v), (None, 3, [1], {}), "give the path of a file"),
    ("path", lambda v: ground_motion.read(v), (None, 3, [1], {}), "give the path of a .AT2 or a CSV file"),
    ("unit", lambda v: ground_motion.read("a.AT2", unit=v), (3, [1], "ft/s2"), "give one of m/s2, g, cm/s2, gal"),
    ("times", lambda v: ground_motion.GroundMotion(v, [1.0, 2.0]), (None, "ab", {}, [[0, 1]]), "give numbers"),
    ("motion", lambda v: newmark.slide(newmark.Block(20, 0.5), v), (None, "a.AT2", [1]), "give a GroundMotion"),
    ("friction", lambda v: newmark.Block(20, v), (None, "0.5", [1], -1, NAN, INF, True), "give a coefficient from 0"),
    ("surfaces", lambda v: figures.shaking(FLOOR, FLOOR, FLOOR, FLOOR, v), (None, "x", 3, ["DP"]), "give a list of cases"),
    ("engine", lambda v: tables.bodies(v), (None, "x", [1], stuff()), "give the ContactDynamicsEngine"),
    ("engine", lambda v: tables.bodies(v), (PorePressureEngine(),), "give the ContactDynamicsEngine"),
    ("engine", lambda v: tables.contacts(v), (None, PorePressureEngine()), "give the ContactDynamicsEngine"),
    ("engine", lambda v: tables.loaded_contacts(v, 0, {}), (None, 3), "give the ContactDynamicsEngine"),
    ("engine", lambda v: tables.breaks(v), (None, 3), "give the ContactDynamicsEngine"),
    ("engine", lambda v: tables.water(v, 0, 1), ("x", 3, ContactDynamicsEngine()), "give the PorePressureEngine"),
    ("material", lambda v: tables.slip(v, 0, 1), (None, stuff()), "give a SlipWeakeningMat"),
    ("path", lambda v: records.write_snapshot(v), (None, 3, [1], ""), "give the path of the file to write"),
    ("path", lambda v: records.write_breaks(v, BREAKS), (None, 3, [1]), "give the path of the file to write"),
    ("breaks", lambda v: records.write_breaks("breaks.csv", v), (None, "x", [1], {}), "give broken bonds"),
    ("path", lambda v: records.SeriesWriter(v, ["step"]), (None, 3, [1], ""), "give the path of the file to write"),
    ("columns", lambda v: records.SeriesWriter("s.csv", v), (None, "step", 3), "give the names of the columns"),
    ("snapshot", lambda v: paraview.write_disks(v, "a.vtu"), (None, "end", [1]), "give a Snapshot"),
    ("snapshot", lambda v: paraview.write_contacts(v, "a.vtu"), (None, "end", [1]), "give a Snapshot"),
    ("path", lambda v: paraview.write_walls(CIRCLE, v), (None, 3, [1], ""), "give the path of the file to write"),
    ("section", lambda v: paraview.write_walls(v, "a.vtu"), (None, "circle", 3), "give a Section"),
    ("breaks", lambda v: paraview.write_breaks(v, "a.vtu"), (None, "x", {}, BREAKS), "give broken bonds"),
    ("surfaces", lambda v: paraview.write_slip_surface(v, CIRCLE, 1.0, "a.vtu"), (None, "x", [1], {"circle": 3}, {"circle": {"slip_m": 3}}), "give arrays by walls, as run.slip_surface_arrays"),
    ("section", lambda v: paraview.write_slip_surface({}, v, 1.0, "a.vtu"), (None, "circle", 3), "give a Section"),
    ("time", lambda v: paraview.write_slip_surface({}, CIRCLE, v, "a.vtu"), (None, "1", NAN, INF), "give seconds"),
    ("O", lambda v: paraview.write_scene_walls(v, "a.vtu"), (None, "x", 3), "give YADE's O"),
    ("entries", lambda v: paraview.write_collection(v, "a.pvd"), (None, "x", [1], [(1, 2, 3)]), r"give a list of \(time, file\) pairs"),
    ("snapshot_paths", lambda v: video.write_mp4(v, CIRCLE, "a.mp4"), (None, "x", 3, {}), "give a list of the files of a run's snapshots"),
    ("walls", lambda v: video.write_mp4([], v, "a.mp4"), (None, "circle", 3, [1]), "give a Section, or walls"),
    ("path", lambda v: video.write_mp4([], CIRCLE, v), (None, 3, [1], ""), "give the path of the file to write"),
    (".*film", lambda v: video.write_mp4([], CIRCLE, v), ("film", "film.avi"), "a video ends in .mp4 or .gif"),
    ("snapshot_paths", lambda v: video.write_mp4(v, CIRCLE, "a.mp4"), ([1], ["a.npz", None]), "give a list of the files of a run's snapshots"),
    ("fps", lambda v: video.write_mp4(["a.npz"], CIRCLE, "a.mp4", fps=v), (None, "15", 0, -1, 101, NAN, INF), "give frames a second, from 0.1 to 100"),
    ("size", lambda v: video.write_mp4(["a.npz"], CIRCLE, "a.mp4", size=v), (None, 720, "720", (1280,), (1280, 721), (0, 0), (62, 64), (64, 8194), (NAN, 720)), "two even whole numbers from 64 to 8192"),
    ("window", lambda v: video.write_mp4(["a.npz"], CIRCLE, "a.mp4", window=v), (None, "1", 0, -1, NAN, INF), "give the seconds that a mean is over"),
    ("series", lambda v: video.write_mp4(["a.npz"], CIRCLE, "a.mp4", series=v), ("x", [1]), "give columns {name: array}"),
    ("times", lambda v: video.write_mp4(["a.npz"], CIRCLE, "a.mp4", times=v), ("x", 3, [1], {"t0": "5"}), "give {'t0': seconds"),
    (r"entries\[0\]: time", lambda v: paraview.write_collection([(v, "a.vtu")], "a.pvd"), (None, "1", NAN, INF), "give seconds"),
    (r"entries\[0\]: file", lambda v: paraview.write_collection([(1.0, v)], "a.pvd"), (None, 3, "a.vtu", "."), "give the path of a file|there is no such file; write it first"),
    ("section", lambda v: similar.with_disks_of(v, CIRCLE, 2), (None, "circle"), "give a Section"),
    ("original", lambda v: similar.with_disks_of(CIRCLE, v, 2), (None, "circle"), "give the Section that this one is like"),
    ("factor", lambda v: similar.with_disks_of(CIRCLE, CIRCLE, v), (None, "2", NAN), "give the ratio of sizes"),
    ("packing", lambda v: similar.mirrored_packing(v), (None, "circle", [1]), "give a Packing"),
    ("packing", lambda v: similar.scaled_packing(v, 2), (None, "circle", [1]), "give a Packing"),
    ("built", lambda v: experiment.Experiment(v, "out"), (None, "circle", CIRCLE), "give a Slope, as slope.build"),
    ("summary", lambda v: report.table(v), (None, "x", {}, {"tests": []}), "give the summary of a campaign of biaxial tests, of one or more"),
    ("summary", lambda v: report.pressures(v), (None, "x", {"tests": []}, {"by_pressure": []}), "give the summary of a campaign"),
    ("summary", lambda v: report.draw("out", v), (None, "x", {"tests": []}, {"tests": [], "seeds": []}), "give the summary of a campaign"),
    ("out", lambda v: report.draw(v, {"tests": [{}], "seeds": [1]}), (None, 3, ""), "give the path of the folder"),
    ("summary", lambda v: tension_report.table(v), (None, "x", {}), "give the summary of a campaign of tension tests"),
    ("summary", lambda v: tension_report.draw("out", v), (None, "x", {"groups": []}), "give the summary of a campaign of tension tests"),
    ("out", lambda v: tension_report.draw(v, {"tests": [{}], "groups": [{}]}), (None, 3, ""), "give the path of the folder"),
    ("material", lambda v: tension_test.TensionTest(v, None), (None, "wwr", 3), "give a section.Material"),
    ("tests", lambda v: campaign.run_tension_tests(v, "out"), (None, "x", [1], 3, []), "give a list of tension_test.TensionTest|give one tension_test.TensionTest or more"),
    ("out", lambda v: campaign.run_tension_test(TENSION, v), (None, 3, ""), "give the path of a folder for the tests"),
    ("base", lambda v: campaign.sweep(v, {}), (None, "circle", {}), "give a Section"),
    ("over", lambda v: campaign.sweep(CIRCLE, v), (None, "seed", [1], 3), "give a dictionary {key: values}"),
    ("seed:", lambda v: campaign.sweep(CIRCLE, {"seed": v}), (None, "12", 3), "give the values to run with"),
    ("end", lambda v: campaign.sweep(CIRCLE, {"seed": [1]}, end=v), ("x", [1], -1, 0, NAN, INF), "give seconds of simulated time"),
    ("made", lambda v: campaign.run_slope(v, "out"), (None, "circle", {}), "give a Section"),
    ("out", lambda v: campaign.run_slope(CIRCLE, v), (None, 3, [1]), "give the path of a folder"),
    ("threads", lambda v: campaign.run_slope(CIRCLE, "out", threads=v), (None, "2", 0, 1.5), "give a whole number from 1"),
    ("out", lambda v: campaign.read(v), (None, 3), "give the path of the folder of a plan"),
    ("table", lambda v: campaign.means(v, ["seed"]), (None, "x", [1], {}, {"seed": [1]}), "give the table of a plan|the table has no column 'run'"),
    ("varied", lambda v: campaign.means({"run": ["a"], "seed": [1]}, v), (None, "seed", [1], ["friction"]), "give the list of the keys|the table has no column 'friction'; it has run, seed"),
    ("lesson", lambda v: campaign.lesson(v), (None, 3, [1]), "give one of beam, bounce"),
    ("disk, centre", lambda v: scene.disk(v, 1, stuff()), (None, "xy", 3, [1], (NAN, 0), (0, INF), (1, 2, 3, 4)), r"give \(x, y\)"),
    (r"disk at \(0, 0\): radius", lambda v: scene.disk((0, 0), v, stuff()), (None, "1", [1], 0, -1, NAN, INF), "give a positive radius"),
    ("material", lambda v: scene.disk((0, 0), 1, v), (None, "rock", [1], 7, NAN), "give a material"),
    ("material", lambda v: scene.segments(FLOOR, v), (None, "rock", [1]), "give a material"),
    ("vertices", lambda v: scene.segments(v, stuff()), (None, 3, "ab", ["ab", "cd"]), "give a list of two or more"),
    ("sense =", lambda v: scene.segments(FLOOR, stuff(), sense=v), (None, "left", [1], 2, NAN), "give .1"),
    ("piece =", lambda v: scene.segments(FLOOR, stuff(), piece=v), ("1", [1], 0, -1, NAN, INF), "give a positive length"),
    ("radius =", lambda v: scene.arc((0, 0), v, 0, 1, stuff()), (None, "1", [1], 0, -1, NAN), "give a positive length"),
    ("arc, centre", lambda v: scene.arc(v, 1, 0, 1, stuff()), (None, "x", 3), r"give \(x, y\)"),
    ("arc, end", lambda v: scene.arc((0, 0), 1, 0, v, stuff()), (None, "x", [1], NAN, INF), "give an angle"),
    ("inside", lambda v: scene.arc((0, 0), 1, 0, 1, stuff(), inside=v), ("yes", 3, [1]), "give True"),
    ("gravity", lambda v: scene.engines(gravity=v), (None, -9.81, "down", (0, -9.81), (0, NAN, 0)), r"give \(x, y, z\)"),
    ("reach", lambda v: scene.engines(reach=v), (None, "far", [1], -1, NAN), "give a gap in mean diameters"),
    ("adhesion_range", lambda v: scene.engines(adhesion_range=v), (None, "far", -1, NAN), "give a gap in mean diameters"),
    ("verlet", lambda v: scene.engines(verlet=v), (None, "far", NAN), "give a margin"),
    ("ends|vertices", lambda v: scene.plate(v, stuff()), (None, "x", 3, [(0, 0)], [(0, 0), (1, NAN)]), "give"),
    ("force =", lambda v: scene.plate(FLOOR, stuff(), force=v), (None, "1", NAN), "give a finite number"),
    ("m", lambda v: scene.material(v), (None, "rock", [1]), "give a section.Material"),
    ("m", lambda v: scene.wall_material(v), (None, "rock", [1]), "give a section.Material"),
    ("one", lambda v: scene.join(v, v, (1, 0, 0)), (None, 3), "give a body"),
    ("O", lambda v: figures.draw(v), (None, "x", [1], 3), "give YADE's O"),
    ("path", lambda v: figures.draw(O, v), (3, [1], ""), "give the name of a PNG"),
    ("O", lambda v: figures.record(v), (None, "x", [1]), "give YADE's O"),
    ("O", lambda v: figures.animate(v), (None, "x", [1]), "give YADE's O"),
    ("series", lambda v: figures.energy(v), (None, "x", [1], 3), "give columns {name: array}"),
    ("series", lambda v: figures.solver(v), (None, "x", [1]), "give columns {name: array}"),
    ("series", lambda v: figures.forces_against_time(v, {}), (None, "x", [1]), "give columns {name: array}"),
    ("snapshot", lambda v: figures.force_chains(v, CIRCLE), (None, "end", [1]), "give a Snapshot"),
    ("snapshot", lambda v: figures.deposit(v, v, CIRCLE), (None, "end", [1]), "give a Snapshot"),
    ("walls", lambda v: figures.runouts([], v), (None, "circle", 3, [1]), "give a Section, or walls"),
    ("cases", lambda v: figures.snapshots(v, CIRCLE), (None, "t0", 3, ["t0"], [("t0", "end")], [("t0",)]), r"give a list of cases, each \(label, Snapshot\)"),
    ("cases", lambda v: figures.markers(v, CIRCLE), (None, ["t0"], [("t0", "end")]), r"give a list of cases, each \(label, Snapshot\)"),
    ("cases", lambda v: figures.weakening(v, CIRCLE), (None, "t0", 3, ["t0"], [("t0", None)]), "give a list of cases, each a Snapshot"),
    ("cases", lambda v: figures.runouts(v, CIRCLE), (None, ["t0"], [("t0", "end")]), "give a list of cases, each .label, Snapshot of the beginning"),
    ("cases", lambda v: figures.toes(v), (None, ["t0"], [("t0", "end", "end", CIRCLE)]), "give a list of cases, each .title, Snapshot before"),
    ("cases", lambda v: figures.with_and_without(v), (None, ["t0"], [("a", [({}, "0")], None, None, CIRCLE)]), "give a list of cases, each .label, "),
    ("cases", lambda v: figures.forces_against_water(v), (None, ["t0"], [({}, {"t0": "1"}, 0.3)], [({}, {}, None)]), "give a list of cases, each .series, times"),
    ("cases", lambda v: figures.speeds(v), (None, ["t0"], [({}, {})]), "give a list of cases, each .series, summary"),
    ("moving", lambda v: figures.speeds([], moving=v), (None, "1", 0, NAN), "give a speed in m/s"),
    ("number", lambda v: figures.markers([], CIRCLE, number=v), (None, "1", 0, 1.5, True), "give a whole number from 1"),
    ("friction_deg", lambda v: figures.toes([], friction_deg=v), ("30", -1, 90, NAN), "give degrees from 0 to less than 90"),
    ("limit", lambda v: figures.energy({}, limit=v), (None, "2", 0, -1, NAN, INF), "give a number above 0"),
    ("window", lambda v: figures.forces_against_time({}, {}, window=v), (None, "1", 0, -1, NAN, INF), "give the seconds that a mean is over"),
    ("times", lambda v: figures.forces_against_time({}, v), ("x", 3, [1], {"t0": "5"}), "give {'t0': seconds"),
    ("times", lambda v: figures.energy({}, times=v), ("x", 3, [1], {"t0": "5"}), "give {'t0': seconds"),
    ("before", lambda v: figures.toe(v, v, CIRCLE), (None, "t0", 3), "give a Snapshot"),
    ("material", lambda v: figures.contact_law(v), (None, "rock", 3), "give a section.Material"),
    ("dip", lambda v: figures.water_forces(v), (None, "30", [1], NAN), "give the slope"),
    ("rows", lambda v: figures.means(v, "seed", ["a"]), (None, "x", [1], []), "give rows|nothing to draw"),
    ("key", lambda v: figures.means(ROWS, v, ["front_m"]), (None, 3, "friction"), "the rows have no such values; give one of seed"),
    ("names", lambda v: figures.means(ROWS, "seed", v), (["front"], ["front_m", "t9"], []), "the rows have no such numbers; give some of front_m|nothing to draw"),
    ("heap", lambda v: column.run(v, worlds.Hard(1e-3)), (None, "x", [1]), "give a Column or a Pile"),
    ("world", lambda v: column.build(column.Column(), v), (3, "hard", [1]), r"give worlds.Hard\(...\)"),
    ("material", lambda v: materials.load(v), (None, 3, [1]), "give one of wwr, dp"),
    ("material", lambda v: biaxial_test.BiaxialTest(v, 1e6, None), (None, "wwr", 3), "give a section.Material"),
    ("tests", lambda v: tests_of_rock.run(v, "out", 1), (None, "x", [1], 3, []), "give a list of biaxial_test.BiaxialTest|give one biaxial_test.BiaxialTest or more"),
    ("out", lambda v: tests_of_rock.run([], v, 1), (None, 3), "give the path of a folder"),
    ("threads", lambda v: tests_of_rock.run([], "out", v), (None, "2", 0), "give a whole number from 1"),
]  # fmt: skip


@pytest.mark.parametrize("name, call, values, remedy", CALLS, ids=[f"{k}-{name}" for k, (name, *_) in enumerate(CALLS)])
def test_a_value_of_another_kind_is_named(tmp_path, monkeypatch, name, call, values, remedy):
    monkeypatch.chdir(tmp_path)
    for value in values:
        with pytest.raises(UserError, match=f"^({name}).*{remedy}") as refusal:
            call(value)
        assert "\n" not in str(refusal.value), value
    assert not list(tmp_path.iterdir()) and len(O.bodies) == 0 and O.iter == 0
