"""A slope from Python without a file, what it leaves out, and a run opened from its folder, in YADE and without it."""

import ast
import dataclasses
import importlib.util
import json
import re
import subprocess
import sys

import numpy as np
import pytest
import shell
from slope_scenes import SMALL
from shell import ROOT
from yade import nonsmooth
from yade.nonsmooth import records, runs, section, similar
from yade.nonsmooth.model import scales
from yade.nonsmooth.model.section import data as section_data

SHIPPED = section.load("jiufengershan")
EXAMPLE = ROOT / "doc" / "examples" / "own_slope.py"
FIELDS = ("name", "description", "gravity", "walls", "layers", "interfaces", "water", "stages", "numerics", "seed")


def data_of(s, *left_out):
    return {k: v for k, v in section_data.plain(s).items() if k not in left_out}


@pytest.mark.parametrize(
    "made",
    [
        *(section.load(name) for name in section.shipped()),
        section.load(str(SMALL)),
        similar.mirrored(SHIPPED),
        section.load("interface").with_disks(1500),
    ],
    ids=lambda s: f"{s.name} {s.side:g}",
)
def test_a_section_and_its_data_are_the_same(made, tmp_path):
    section_data.write(made, tmp_path / "section.yaml")
    for again in (section.of(section_data.plain(made)), section.load(str(tmp_path / "section.yaml"))):
        assert all(getattr(again, name) == getattr(made, name) for name in FIELDS), [
            name for name in FIELDS if getattr(again, name) != getattr(made, name)
        ]
        assert dict(again.materials) == dict(made.materials) and again.disks == dataclasses.replace(
            made.disks, count=None
        )
        assert again.key("settled") == made.key("settled")


def test_what_is_left_out_is_the_papers_in_proportion():
    bare = data_of(SHIPPED, "gravity", "seed", "stages", "numerics", "description")
    bare["disks"] = {"diameter": [1.0, 4.0]}
    bare["water"] = {"plane": "DP", "table": {"rate": 1.0}}
    made = section.of(bare)
    # area is that of scales, to the last bit
    # but for the pressing: bonded as it was packed
    settle = dataclasses.replace(SHIPPED.stages.settle, bond="before")
    assert made.stages == dataclasses.replace(SHIPPED.stages, settle=settle) and not made.pressed
    assert made.numerics == SHIPPED.numerics and (made.gravity, made.seed) == (9.81, 1)
    assert made.water == dataclasses.replace(
        SHIPPED.water, unit_weight=made.water.unit_weight
    ) and made.water.unit_weight == pytest.approx(9810)
    assert made.water.pressure_gradient_xy == pytest.approx(
        SHIPPED.water.pressure_gradient_xy
    ) and made.disks == dataclasses.replace(SHIPPED.disks, packing_fraction=0.84)
    # a quarter of the size: times and speeds go as its root
    quarter = similar.scaled(SHIPPED, 0.25)
    small = {k: v for k, v in data_of(quarter, "gravity", "seed", "stages", "numerics").items()}
    small["water"] = {"plane": "DP", "table": {"rate": 1.0}}
    small = section.of(small)

    def ask(s):
        return (
            s.stages.dry,
            s.stages.end.time,
            s.stages.settle.speed_rest,
            s.numerics.time_step,
            s.release_distance,
            s.stages.end.rest_fraction,
        )

    assert ask(small) == pytest.approx(ask(quarter), rel=1e-9)
    # on the Moon all goes slower
    moon = section.of(bare, gravity=9.81 / 4)
    assert moon.stages.dry == pytest.approx(2 * SHIPPED.stages.dry) and moon.numerics.time_step == pytest.approx(
        2 * SHIPPED.numerics.time_step
    )
    assert moon.stages.settle.speed_rest == pytest.approx(
        SHIPPED.stages.settle.speed_rest / 2
    ) and moon.water.unit_weight == pytest.approx(9810 / 4)


def test_a_part_that_is_given_stands():
    made = section.of(
        data_of(SHIPPED, "stages", "numerics"),
        stages={"settle": {"ramp": 7.0}, "end": {"time": 33.0}},
        numerics={"tolerance": 1e-5},
    )
    assert (made.stages.settle.ramp, made.stages.end.time, made.numerics.tolerance) == (7.0, 33.0, 1e-5)
    # as a file without it
    assert (
        made.stages.settle.time_max == SHIPPED.stages.settle.time_max
        and made.numerics.max_iterations == 300
        and made.numerics.path is None
    )


def test_tuples_and_arrays_are_points():
    data = data_of(SHIPPED)
    data["walls"][0]["vertices"] = np.array(data["walls"][0]["vertices"])
    data["walls"] = tuple(data["walls"])
    data["layers"][0]["vertices"] = tuple(map(tuple, data["layers"][0]["vertices"]))
    data["seed"] = np.int64(1)
    assert section.of(data).walls == SHIPPED.walls


@pytest.mark.parametrize(
    "change, message",
    [
        (dict(gravitation=9.81), "hill: gravitation: unknown key; did you mean 'gravity'?"),
        (dict(gravity="9,81"), "hill: gravity: '9,81' is text; needed: acceleration"),
        (dict(walls=[]), "hill: walls: has 0 entries; needed: a list of walls"),
        (dict(disks={"diameter": [2.0, 1.0]}), "hill: disks.diameter: the smallest, 2 m, exceeds"),
        (dict(seed=float("nan")), "hill: seed: nan is no finite number"),
    ],
)
def test_what_is_wrong_is_told_as_of_a_file_but_for_the_line(change, message):
    with pytest.raises(section.SectionError) as refused:
        section.of(data_of(SHIPPED), "hill", **change)
    assert str(refused.value).startswith(message) and "line" not in str(refused.value)


# ---- runs -----------------------------------------------------------------------------------------


def test_a_run_is_opened_from_its_folder(whole):
    run = runs.open_run(whole.folder)
    assert run.summary == json.loads((whole.folder / "summary.json").read_text()) and run.section.key(
        "settled"
    ) == whole.section.key("settled")
    assert all(np.array_equal(run.series[name], values) for name, values in whole.series.items()) and set(
        run.walls["wall"]
    ) == {"DP", "FB", "SS"}
    assert (
        len(run.breaks["step"]) > 5 and run.snapshot("end").step == records.read_snapshot(whole.folder / "end.npz").step
    )
    near = run.snapshot(3.0)
    assert abs(near.time_s - 3.0) <= 2.5 * scales.of(run.section).row_seconds * 1.001  # every fifth row
    for name in set(runs.FIGURES) - {"toe", "erosion", "shaking", "slip_surface", "water"}:
        assert run.figure(name).axes
    for name in ("toe", "erosion", "shaking", "slip_surface", "water"):
        with pytest.raises(runs.RunError, match=f"the figure {name} needs a later stage"):
            run.figure(name)
    labels = {line.get_label() for ax in run.figure("forces").axes for line in ax.lines}
    assert "$N'_{FB}$  normal on FB" in labels


def test_what_a_run_has_not_is_told(whole, tmp_path):
    with pytest.raises(runs.RunError, match="no section.yaml"):
        runs.open_run(tmp_path)
    section_data.write(SHIPPED, tmp_path / "section.yaml")
    with pytest.raises(runs.RunError, match="summary.json: missing"):
        runs.open_run(tmp_path).summary
    run = runs.open_run(whole.folder)
    with pytest.raises(runs.RunError, match="no figure is called 'chains'; give one of force_chains"):
        run.figure("chains")
    with pytest.raises(runs.RunError, match="give series, walls, breaks, eroded or slip_surface"):
        run.frame("serie")


def test_a_frame_has_the_columns(whole, monkeypatch):
    run = runs.open_run(whole.folder)
    frame, walls = run.frame("series"), run.frame("walls")
    assert list(frame.columns) == list(runs.SlopeRun.COLUMNS) and np.array_equal(
        frame["front_m"], run.series["front_m"]
    )
    assert walls.groupby("wall").normal_N_per_m.max()["FB"] == run.series["fb_normal_N_per_m"].max()
    monkeypatch.setitem(sys.modules, "pandas", None)  # as where it is not installed
    with pytest.raises(runs.RunError, match="apt install python3-pandas"):
        run.frame("series")


def test_a_slopes_video_is_drawn_where_it_is_missing(whole, tmp_path):
    """Of the small slope's run, whose folder has none of its own."""
    for path in whole.folder.iterdir():
        (tmp_path / path.name).symlink_to(path)
    (tmp_path / "avalanche.mp4").unlink(missing_ok=True)
    shown = runs.open_run(tmp_path).video()
    assert (tmp_path / "avalanche.mp4").read_bytes()[4:8] == b"ftyp" and "data:video/mp4;base64" in shown._repr_html_()
    empty = tmp_path / "empty"
    empty.mkdir()
    for name in ("section.yaml", "series.csv", "summary.json"):
        (empty / name).symlink_to(whole.folder / name)
    with pytest.raises(runs.RunError, match="written no snapshot yet"):
        runs.open_run(empty).video()


PLAIN = """\
import sys
sys.path.insert(0, {py!r})
from nonsmooth import packing, runs, section, similar
from nonsmooth.model.section import data as section_data
run = runs.open_run({folder!r})
print(run.summary["front_travel_m"], len(run.figure("deposit").axes), similar.mirrored(run.section).side, len(packing.pack(run.section)))
assert not any(name == "yade" or name.startswith("yade.") for name in sys.modules), "YADE was imported"
"""


def test_a_plain_python_opens_runs_makes_sections_and_packs(whole):
    """As a notebook's kernel does: no YADE is there."""
    done = subprocess.run(
        ["/usr/bin/python3", "-c", PLAIN.format(py=str(ROOT / "py"), folder=str(whole.folder))],
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    travel, axes, side, disks = done.stdout.split()
    assert float(travel) == whole.summary["front_travel_m"] and (axes, side, disks) == ("1", "-1.0", "315")


PURE = (
    "model.rocks model.ground_motion model.ground_motion.synthetic measure.newmark model.section model.section.data model.section.values model.section.defaults model.section.checks model.section.reader model.roles model.section.similar model.scales model.geometry model.free_surface packing packing.files packing.checks course course.driver course.slope records studies.runs studies.slope.results studies.paper.paper_figures measure.characteristic_times studies.slope.verdict studies.slope.frames measure.toe studies.slope.run_figures "
    "measure measure.ground measure.fronts measure.surface measure.energy measure.force_stages measure.layers measure.travel measure.weakening figures figures.moving figures.runouts figures.biaxial figures.columns figures.law figures.rock_table figures.film figures.video figures.paraview studies.lessons system.whole_files running.kept_runs world.tables errors world.scene_arrays figures.scene measure.velocity_profiles figures.cycle figures.spreading "
    "measure.statistics report report.page system.keys system.installation records.checkpoints running.processes running.side_by_side system.output_folder commands.section_arguments campaign campaign.plan campaign.sweep studies.paper.paper_slopes campaign.cluster studies.laboratory.biaxial_test "
    "studies.laboratory.campaign measure.strength measure.fluctuations measure.bands measure.toe_bands studies.laboratory.report studies.laboratory.effects studies.laboratory.calibration studies.laboratory.wall_shear studies.paper.readings studies.paper.reading_numbers studies.paper.closing_decision studies.paper.readings_figure studies.laboratory.table1 studies.laboratory.rock_table studies.laboratory.pressing measure.cycles "
    "studies.laboratory.tension_test studies.laboratory.tension_campaign studies.laboratory.tension_report measure.tensile measure.fracture measure.weakest_cut measure.vertical_cut campaign.laboratory system.requirements world.worlds studies.heaps.column studies.heaps.pile studies.heaps.grains studies.heaps.study studies.heaps.report campaign.heaps campaign.scripts campaign.comparisons world.soft studies.heaps.profiles"
)


def imported_with(module):
    """[(module of the package, package of others that it imports)], for ``module`` and all that is imported with it;
    read from the sources.
    """
    package, seen, waiting, found = ROOT / "py" / "nonsmooth", set(), [module], []
    while waiting:
        name = waiting.pop()
        if name in seen:
            continue
        seen.add(name)
        path = package / (name.replace(".", "/") + ".py")
        at = name.split(".")[:-1]
        if not path.exists():
            path, at = package / name.replace(".", "/") / "__init__.py", name.split(".")
        if at:  # a package's own module comes with each of its modules
            waiting.append(".".join(at))
        for node in ast.parse(path.read_text()).body:  # what is imported when the module is
            if isinstance(node, ast.Import):
                found += [(name, one.name) for one in node.names]
            if isinstance(node, ast.ImportFrom):
                if node.level == 0:
                    found += [(name, f"{node.module}.{one.name}") for one in node.names]
                    continue
                base = at[: len(at) - node.level + 1] + (node.module.split(".") if node.module else [])
                for one in node.names:
                    inner = [*base, one.name]
                    is_module = (package / "/".join(inner)).with_suffix(".py").exists() or (
                        package / "/".join(inner) / "__init__.py"
                    ).exists()
                    waiting.append(".".join(inner if is_module else base))
    assert module in seen
    return found


@pytest.mark.parametrize("module", PURE.split())
def test_a_module_of_the_house_that_needs_no_yade_imports_none(module):
    """Read from its source, with all that it imports of the package (doc/house.rst)."""
    assert not [(by, what) for by, what in imported_with(module) if what.split(".")[0] == "yade"]


@pytest.mark.parametrize(
    "module",
    "studies.slope.experiment campaign studies.slope.slope_run campaign.script_run studies.laboratory.biaxial studies.comparison.slopes studies.heaps.column judges.benchmark.steps".split(),
)
def test_a_process_that_draws_nothing_waits_for_no_library_that_draws(module):
    """They take as long as the rest of a start, and a sweep starts hundreds."""
    slow = ("matplotlib", "meshio", "docutils", "pandas", "scipy.stats")
    assert not [(by, what) for by, what in imported_with(module) if what.startswith(slow)]


def test_a_slope_of_ones_own_in_some_lines(tmp_path):
    """The script that the documentation prints."""
    lines = [line for line in EXAMPLE.read_text().splitlines() if line.strip()]
    assert len(lines) <= 17
    done = shell.run("yade-nonsmooth", EXAMPLE, limit=300, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "m of water; figures: force_chains.png forces.png" in done.stdout
    run = runs.open_run(tmp_path / "out" / "hill")
    assert (
        run.section.name == "My hill"
        and run.summary["finished"]
        and run.summary["water_at_failure_m"] > 0.5
        and run.summary["front_travel_m"] > 5
    )


def test_every_package_of_the_face_says_what_is_public():
    for name in (*nonsmooth.FACE, *nonsmooth.__all__):
        module = importlib.import_module(f"yade.nonsmooth.{name}") if name != "harden" else nonsmooth
        assert module.__all__, name
        for one in module.__all__:
            assert hasattr(module, one) or importlib.util.find_spec(f"{module.__name__}.{one}"), (name, one)


def test_the_page_of_the_package_begins_with_what_people_build_on():
    """doc/python.rst names the public modules of doc/house.rst, the face first, and none of the judges."""
    page = (ROOT / "doc" / "python.rst").read_text(encoding="utf-8")
    named = [name for line in re.findall(r"^\.\. package-modules:: (.+)$", page, re.M) for name in line.split()]
    house = (ROOT / "doc" / "house.rst").read_text(encoding="utf-8")
    public = re.findall(
        r"``([a-z_.]+)``", house[house.index("Scripts and notebooks may build on") : house.index("These names stay")]
    )
    assert set(public) - {"__all__"} <= set(named) and len(named) == len(set(named))
    face = ["section", "experiment", "runs", "campaign", "scene", "figures", "laboratory"]
    assert [name for name in named if name in face] == face and named[0] == "section"
    assert not {name.split(".")[0] for name in named} & {"judges", "studies"}
