"""Columns, piles, scripts and lessons that a plain Python runs in processes of their own; what it needs for that, and
what it says where something is missing.
"""

import ast
import importlib
import json
import os
import re
import subprocess
import sys

import numpy as np
import pytest
import shell
from shell import ROOT
from yade.nonsmooth import campaign, errors, runs
from yade.nonsmooth.heaps import column, pile
from yade.nonsmooth.heaps.grains import HeapError
from yade.nonsmooth.running import processes
from yade.nonsmooth.system import requirements

PYTHON = "/usr/bin/python3"
SMALL = column.Column(disks=60, aspect=1.0, diameter=0.1)
EXERCISES = json.loads((ROOT / "doc" / "measured" / "exercises.json").read_text())


def plain(code, folder, *options, **changes):
    """What a plain Python prints for the code, with the package in its path."""
    return subprocess.run(
        [PYTHON, *options, "-c", code],
        env=shell.environment(PYTHONPATH=str(ROOT / "py"), **changes),
        cwd=folder,
        text=True,
        capture_output=True,
        timeout=300,
    )


# ---- columns and piles ------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def columns(tmp_path_factory):
    """A small column in both worlds, side by side: {world: HeapRun}, below one folder."""
    cases = {"hard": (SMALL, {}), "soft": (SMALL, dict(name="soft", stiffness=1e8))}
    return campaign.run_heaps(cases, tmp_path_factory.mktemp("columns"), threads=2, duration=2)


def test_both_worlds_begin_with_the_same_places_and_are_what_was_asked_for(columns):
    hard, soft = columns["hard"], columns["soft"]
    assert (hard.heap, soft.heap) == (SMALL, SMALL) and (hard.world, soft.world["stiffness"]) == ({}, 1e8)
    assert (hard.summary["world"], soft.summary["world"]) == ("hard", "soft")
    (t, places, r), (_, others, _) = hard.places(), soft.places()
    # springs settle under the weight before the gate goes, and some disks move aside; each keeps its place among its
    # neighbours, less than half a diameter away
    assert np.max(np.abs(np.array(places[0]) - np.array(others[0]))) < 0.25 * SMALL.diameter
    # it falls: the heap's centre of mass goes down, by the weight of which it gets its speed
    for run in (hard, soft):
        y = run.series["centroid_y_m"]
        assert y[-1] < 0.95 * y[0] and run.frame()["front_m"].iloc[-1] == run.series["front_m"][-1]
    assert t[0] == 0.0 and len(r) == hard.summary["disks"] and len(hard.figure().axes) == len(t)


def test_a_run_is_opened_again_and_one_of_another_kind_is_not(columns, tmp_path):
    again = campaign.open_heap(columns["soft"].folder)
    assert again.summary == columns["soft"].summary and again.heap == SMALL
    with pytest.raises(runs.RunError, match="no run of a column or pile"):
        campaign.open_heap(tmp_path)
    with pytest.raises(runs.RunError, match="give collapse"):
        again.figure("deposit")
    with pytest.raises(runs.RunError, match="no table is called 'walls'; give series"):
        again.frame("walls")


def test_one_pile_alone_and_a_resume_keeps_it(tmp_path):
    made = pile.Pile(disks=30, aspect=1.0, diameter=0.1)
    run = campaign.run_pile(made, tmp_path / "pile", duration=1)
    assert run.heap == made and run.summary["world"] == "hard"
    before = (run.folder / "series.csv").stat().st_mtime_ns
    assert campaign.run_pile(made, tmp_path / "pile", duration=1, resume=True).summary == run.summary
    assert (run.folder / "series.csv").stat().st_mtime_ns == before


@pytest.mark.parametrize(
    "wrong, message",
    [
        (dict(stiffness=1e8), "stiffness 100000000.0 with world 'hard': rigid disks have no such value"),
        (dict(world="soft"), "stiffness None: the soft world needs Young's modulus in Pa"),
        (dict(world="soft", stiffness=1e8, dampng=0.1), "dampng: no value of the soft world; give some of stiffness, model, damping"),
        (dict(world="springs"), "world 'springs': give hard or soft"),
        (dict(duration=0), "duration 0: give a number above 0"),
    ],
)  # fmt: skip
def test_a_wrong_value_is_refused_before_anything_runs(tmp_path, wrong, message):
    with pytest.raises(HeapError) as refused:
        campaign.run_column(SMALL, tmp_path / "none", **wrong)
    assert str(refused.value).startswith(message) and not (tmp_path / "none").exists()


def test_a_pile_is_no_column(tmp_path):
    with pytest.raises(HeapError, match="is no Column"):
        campaign.run_column(pile.Pile(disks=30), tmp_path / "none")


# ---- scripts ----------------------------------------------------------------------------------------

SCRIPT = """\
from yade import utils
from yade.nonsmooth.scene import disk, engines
numerics = dict(dt=1e-3)
utils.readParamsFromTable(speed=1.0, word="none", **numerics)
from yade.params import table
folder = found = function = request = None  # names that the process has too
stuff = NscdMat(density=2500)
O.materials.append(stuff)
O.bodies.append(disk((1, 2), 0.5, stuff))
O.bodies[0].state.vel = (table.speed, 0, 0)
O.engines, O.dt = engines(gravity=(0, 0, 0)), table.dt
print("time [s]   way [m]")
for k in range(1, 3):
    O.run(100, wait=True)
    print("%8.2f %9.4f" % (O.time, O.bodies[0].state.pos[0] - 1))
print(f"word {table.word}")
print(f"steps {O.iter}")
open("left.mp4", "wb").write(b"frames")
"""


@pytest.fixture
def script(tmp_path):
    path = tmp_path / "flies.py"
    path.write_text(SCRIPT)
    return path


def test_a_script_has_its_parameters_and_leaves_what_it_says_and_its_scene(script, tmp_path):
    run = campaign.run_script(script, tmp_path / "out", speed=3.0, word="three words #3")
    assert run.number("steps") == 200 and "word three words #3\n" in run.output
    # nothing acts on the disk: v t
    assert run.table("time [s]") == {"time [s]": [0.1, 0.2], "way [m]": [pytest.approx(0.3), pytest.approx(0.6)]}
    scene = run.scene()
    assert (scene.x.tolist(), scene.y.tolist(), scene.r.tolist()) == ([pytest.approx(1.6)], [2.0], [0.5])
    assert run.figure().axes and campaign.open_script(run.folder).output == run.output
    # the working folder is the run's: what the script leaves there is found
    assert "ZnJhbWVz" in run.video()._repr_html_()  # "frames", in base 64
    for ask, words in (
        (lambda: run.number("way"), "no line with 'way'"),
        (lambda: run.table("speed"), "begins with 'speed'"),
        # fmt: skip
        (lambda: run.video("right.mp4"), "no video called 'right.mp4' to show; give one of left.mp4"),
    ):
        with pytest.raises(runs.RunError, match=words):
            ask()


TABLES = """\
test    load [kN]  largest [kN, kN m]  bond ends at [m, rad]
pull          0.0            100.0000  0.0200
roll        100.0             25.0000  it holds
load 0.240  deflection of the tip [mm] 1.5000
stress [Pa], settlement [m]
20000 0.000123
40000 0.000223
height
1.5
disks 321, column [m]: 1.000 wide, 2.074 high
steps 4501
"""


@pytest.fixture
def said(tmp_path):
    """A run whose script has printed this."""

    def call(text):
        (tmp_path / "output.txt").write_text(text)
        return campaign.open_script(tmp_path)

    return call


def test_tables_of_words_of_commas_and_of_one_column_are_read(said):
    run = said(TABLES)
    columns = {"test": ["pull", "roll"], "load [kN]": [0.0, 100.0], "largest [kN, kN m]": [100.0, 25.0], "bond ends at [m, rad]": [0.02, "it holds"]}  # fmt: skip
    assert run.table("test") == columns
    assert run.table("stress") == {"stress [Pa]": [20000.0, 40000.0], "settlement [m]": [0.000123, 0.000223]}
    assert run.table("height") == {"height": [1.5]}
    frame = run.frame("test")
    assert list(frame.columns) == list(columns) and frame["largest [kN, kN m]"].tolist() == [100.0, 25.0]
    # which of them?
    for ask in (run.table, run.frame):
        with pytest.raises(
            runs.RunError, match=r"there are 'test', 'stress \[Pa\]'; give the begin of its line of names"
        ):
            ask()
        with pytest.raises(
            runs.RunError, match=r"no table of the output begins with 'load'; there are 'test', 'stress \[Pa\]'"
        ):
            ask("load")
        with pytest.raises(runs.RunError, match="first 3: give the begin of a table's line of names"):
            ask(3)


def test_the_only_table_needs_no_name_and_none_is_told(said):
    run = said("way 3\ntime [s]   way [m]\n0.1   2\n0.2   3\nsteps 4\n")
    assert run.table() == {"time [s]": [0.1, 0.2], "way [m]": [2.0, 3.0]} and run.frame()["way [m]"].tolist() == [2, 3]
    for ask in (run.table, run.frame):
        with pytest.raises(runs.RunError, match=r"begins with 'steps'; there is 'time \[s\]'"):
            ask("steps")
    run = said("steps 4\n")
    for first in (None, "steps"):
        with pytest.raises(runs.RunError, match="the script has printed no table; run.number"):
            run.frame(first)


def test_a_run_of_a_kind_without_tables_says_so(tmp_path):
    with pytest.raises(runs.RunError, match="a run of this kind has no table; its numbers are in run.summary"):
        campaign.ComparisonRun(tmp_path).frame()


def test_a_parameter_that_is_called_as_an_argument_is(script, tmp_path):
    script.write_text(SCRIPT.replace('word="none"', 'resume="none"').replace("table.word", "table.resume"))
    for given in ("yes", True, False):
        with pytest.raises(
            campaign.ScriptError, match=f"resume {given!r}: flies.py has a parameter of this name, .* run_scripts"
        ):
            campaign.run_script(script, tmp_path / "out", resume=given)
    assert not (tmp_path / "out").exists()
    found = campaign.run_scripts({"one": (script, {"resume": "yes"})}, tmp_path / "out")
    assert "word yes\n" in found["one"].output


@pytest.mark.parametrize(
    "call, words",
    [
        (lambda out: campaign.run_script(None, out), "script None: give the path of a YADE script"),
        (lambda out: campaign.run_script("a.py", None), "out None: give the path of a folder"),
        (lambda out: campaign.run_scripts([], out), r"cases \[\]: give a dictionary"),
        (lambda out: campaign.run_scripts({}, out), "cases {}: give a dictionary"),
        (lambda out: campaign.run_scripts({"one": "a.py"}, out), "case 'one', 'a.py': give"),
        (lambda out: campaign.run_scripts({"one": ("a.py", {})}, out, threads="all"), "threads 'all': give a whole number from 1"),
        (lambda out: campaign.run_scripts({"one": ("a.py", {})}, out, threads=0), "threads 0: give a whole number from 1"),
        (lambda out: campaign.run_column(SMALL, None), "out None: give the path of a folder"),
        (lambda out: campaign.run_column(None, out), "None: is no Column"),
        (lambda out: campaign.run_column(SMALL, out, duration="long"), "duration 'long': give a number above 0"),
        (lambda out: campaign.run_heaps(None, out), "cases None: give a dictionary"),
        (lambda out: campaign.run_heaps({"one": SMALL}, out), "case 'one', .*: give"),
        (lambda out: campaign.run_heaps({"one": (SMALL, {})}, out, threads=1.5), "threads 1.5: give a whole number from 1"),
        (lambda out: campaign.run_comparison("column", out, None), "seeds None: give whole numbers"),
        (lambda out: campaign.run_comparison("column", None, [1]), "out None: give the path of a folder"),
        (lambda out: campaign.run_comparison(7, out, [1]), "scenario 7: give one of"),
    ],
)  # fmt: skip
def test_wrong_types_are_named_before_anything_runs(tmp_path, call, words):
    with pytest.raises(errors.UserError, match=f"^{words}") as refusal:
        call(tmp_path / "out")
    assert isinstance(refusal.value, ValueError) and not (tmp_path / "out").exists()


def test_a_script_runs_without_parameters_and_again_with_a_resume_only_where_it_has_changed(
    script, tmp_path, monkeypatch
):
    monkeypatch.setenv("YADE_BATCH", f"{tmp_path}/of_others.table:2")  # which is not the scripts'
    cases = {"one": (script, {}), "two": (script, dict(speed=2.0))}
    first = campaign.run_scripts(cases, tmp_path / "out", threads=2)
    assert [run.table("time [s]")["way [m]"][-1] for run in first.values()] == pytest.approx([0.2, 0.4])
    marks = {name: (run.folder / "output.txt").stat().st_mtime_ns for name, run in first.items()}
    again = campaign.run_scripts({**cases, "two": (script, dict(speed=5.0))}, tmp_path / "out", resume=True)
    assert again["two"].table("time [s]")["way [m]"][-1] == pytest.approx(1.0)
    assert (again["one"].folder / "output.txt").stat().st_mtime_ns == marks["one"]


def test_a_script_that_fails_or_is_not_there_is_told(script, tmp_path):
    for parameters, message in (
        (dict(sped=1), "sped: flies.py reads no such parameter; did you mean 'speed'?"),
        (dict(depth=1), "depth: flies.py reads no such parameter; it reads speed, word, dt"),
        (dict(speed=float("nan")), "speed nan: give a finite number or a text"),
        (dict(speed=[1]), r"speed \[1\]: give a finite number or a text"),
    ):
        with pytest.raises(campaign.ScriptError, match=message):
            campaign.run_script(script, tmp_path / "out", **parameters)
    with pytest.raises(campaign.ScriptError, match="none.py: the script cannot be read"):
        campaign.run_script(tmp_path / "none.py", tmp_path / "out")
    assert not (tmp_path / "out").exists()
    script.write_text("raise ValueError('no ground')")
    with pytest.raises(campaign.ScriptError, match="ValueError: no ground"):
        campaign.run_script(script, tmp_path / "out")
    with pytest.raises(runs.RunError, match="no script has run here"):
        campaign.open_script(tmp_path / "out")


def test_lessons_are_called_by_their_names(tmp_path):
    assert {"incline", "pile", "column", "wedge", "beam", "slope"} <= set(campaign.lessons())
    with pytest.raises(
        campaign.ScriptError, match="lesson 'inclin': there is no such lesson; give one of beam, bounce, column"
    ):
        campaign.run_lesson("inclin", tmp_path / "out")
    with pytest.raises(campaign.ScriptError, match="world 'rigid': give hard or soft"):
        campaign.run_lesson("incline", tmp_path / "out", world="rigid")


def test_a_plain_python_runs_a_lesson(tmp_path):
    """As a notebook's kernel does; Coulomb's acceleration is exact, see test_examples.py."""
    done = plain(
        "import sys\n"
        "from nonsmooth import campaign\n"
        "run = campaign.run_lesson('incline', 'out', slope=30, seconds=0.5)\n"
        "print(run.table('friction/tan(slope)')['acceleration [m/s2]'][1], len(run.figure().axes))\n"
        "assert not any(name.split('.')[0] == 'yade' for name in sys.modules)\n",
        tmp_path,
    )
    assert done.returncode == 0, done.stderr
    assert [float(word) for word in done.stdout.split()] == [pytest.approx(0.25 * 9.81, abs=2e-4), 1.0]


def test_a_comparison_is_asked_for_and_opened_with_its_answers(tmp_path, monkeypatch):
    """What a comparison finds is judged in test_comparison.py: here a made-up one, by way of the function that a
    process calls.
    """
    asked, told = {}, [("Do both run out as far?", "yes", ["By 3 %."])]

    def compare(scenario, out, seeds, **more):
        asked.update(scenario=scenario, seeds=seeds, **more)
        for name, text in (("summary.json", '{"seeds": [1, 2]}'), ("report.html", "<html>"), ("figures/cost.png", "")):
            (out / name).parent.mkdir(exist_ok=True)
            (out / name).write_text(text)
        return {"seeds": seeds}, told

    def call(function, folder, arguments):
        module, name = function.split(":")
        found = getattr(importlib.import_module(f"yade.nonsmooth.{module}"), name)(folder, **arguments)
        (folder / "found.json").write_text(json.dumps(found))

    monkeypatch.setattr("yade.nonsmooth.studies.comparison.course.compare", compare)
    monkeypatch.setattr("yade.nonsmooth.running.processes.call", call)
    with pytest.raises(runs.RunError, match="no comparison has ended here"):
        campaign.open_comparison(tmp_path)
    found = campaign.run_comparison("column", tmp_path / "out", (1, 2), threads=2, disks=50)
    assert {key: asked[key] for key in ("scenario", "seeds", "threads", "resume", "disks")} == dict(
        scenario="column", seeds=[1, 2], threads=2, resume=False, disks=50
    )
    assert str(found) == "Do both run out as far? yes\n  By 3 %." and found.summary == {"seeds": [1, 2]}
    assert found.report.name == "report.html" and list(found.figures()) == ["cost"]
    assert campaign.open_comparison(tmp_path / "out").questions == found.questions == [tuple(told[0])]


def test_what_a_comparison_refuses_is_its_own_sentence(tmp_path):
    with pytest.raises(processes.RunError, match="^--disks 0: give a number above 0$"):
        campaign.run_comparison("column", tmp_path / "out", [1], disks=0)


# ---- videos -----------------------------------------------------------------------------------------


def test_a_run_without_a_video_says_what_would_make_one(tmp_path, columns):
    with pytest.raises(runs.RunError, match="no video to show"):
        columns["hard"].video()
    for name in ("a.mp4", "b.gif"):
        (tmp_path / name).write_bytes(b"frames")
    run = runs.Opened(tmp_path)
    with pytest.raises(runs.RunError, match="no video to show; give one of a.mp4, b.gif"):
        run.video()
    assert type(run.video("b.gif")).__name__ == "Image" and type(run.video("a.mp4")).__name__ == "Video"


# ---- what a plain Python needs ----------------------------------------------------------------------


def test_the_list_has_what_the_package_imports_and_the_set_up_installs_it():
    listed = requirements.listed()
    assert len({one.pip for one in listed}) == len(listed) and all(one.use for one in listed)
    # test_load.py holds the Debian packages against all imports; here the names of both lists
    script = f'. "{ROOT}/scripts/setup/packages.sh"; echo "${{PACKAGES_PROJECT[@]}}" "${{PACKAGES_NOTEBOOKS[@]}}"'
    known = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True).stdout.split()
    assert {one.debian for one in listed} <= set(known)
    imported = set()
    for path in (ROOT / "py" / "nonsmooth").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Import):
                imported |= {one.name.split(".")[0] for one in node.names}
            elif isinstance(node, ast.ImportFrom) and not node.level:
                imported.add(node.module.split(".")[0])
    foreign = (
        imported
        - set(sys.stdlib_module_names)
        - {"yade", "_nonsmooth_contact", "_nonsmooth_slip", "_nonsmooth_packing", "nonsmooth", "__main__"}
    )
    assert foreign & {"numpy", "IPython"} and foreign <= {one.module for one in listed}
    assert requirements.remedy("yaml") == "apt install python3-yaml, or pip install PyYAML"


@pytest.fixture
def without(tmp_path):
    """A folder of Debian's Python packages but for shapely and yaml."""
    home, place = tmp_path / "packages", "/usr/lib/python3/dist-packages"
    home.mkdir()
    for name in os.listdir(place):
        if not name.lower().startswith(("shapely", "yaml", "pyyaml", "_yaml")):
            (home / name).symlink_to(os.path.join(place, name))
    return home


SAID = "the module shapely, which is not installed for {python} (yaml is missing too): apt install python3-shapely python3-yaml, or pip install shapely PyYAML"


def test_a_missing_package_is_one_message(without, tmp_path):
    path = f"import sys; sys.path = [p for p in sys.path if 'packages' not in p] + [{str(without)!r}]\n"
    done = plain(f"{path}from nonsmooth import records\nprint('read')\nfrom nonsmooth import section", tmp_path)
    # what needs none of it works
    assert done.stdout == "read\n" and done.returncode == 1
    assert done.stderr == f"error: nonsmooth.model.section.erosion needs {SAID.format(python=PYTHON)}\n"
    # imports by others stay Python's own, and one who tries without is heard
    done = plain(
        f"{path}import nonsmooth\n"
        "for name in ('yaml', 'nonsmooth.section'):\n"
        "    try: __import__(name)\n"
        "    except ImportError as error: print(type(error).__name__, error.name)\n",
        tmp_path,
    )
    assert done.stdout == "ModuleNotFoundError yaml\nMissingPackage shapely\n", done.stderr


def test_a_notebook_shows_the_message_alone(tmp_path):
    """IPython asks an error how it is to be shown."""
    done = plain(
        "from IPython.core.interactiveshell import InteractiveShell\n"
        "shell = InteractiveShell.instance(colors='NoColor')\n"
        "shell.run_cell(\"from nonsmooth import section\\nsection.load('nowhere')\")\n"
        "shell.run_cell('1 / 0')\n",
        tmp_path,
        HOME=str(tmp_path),
    )
    lines = [line for line in done.stdout.splitlines() if line.strip()]
    assert lines[0].startswith("SectionError: ") and "nowhere" in lines[0] and "Traceback" not in lines[0]
    assert any("ZeroDivisionError" in line and "Traceback" in line for line in lines[1:]) and not any(
        "section.py" in line for line in lines
    )
    assert errors.UserError("why")._render_traceback_() == ["UserError: why"]


# ---- the exercise sheet -----------------------------------------------------------------------------


def test_the_sheets_numbers_are_the_known_ones():
    """doc/measured/exercises.json, which test_notebooks.py makes anew; bounds are what a step, or a bond's zone,
    leaves.
    """
    e = EXERCISES
    assert e["fall"]["speed"] == pytest.approx((2 * 9.81) ** 0.5, abs=9.81e-3)  # one step of 1 ms
    # the disk bounces within a step, 4 mm before or after the floor at 4.4 m/s; later impacts are relatively coarser
    assert e["fall"]["rises"] == pytest.approx([0.5**2, 0.5**4, 0.5**6], abs=2e-3)
    assert e["incline"]["acceleration"] == pytest.approx(e["incline"]["known"], abs=2e-4)  # digits printed
    assert e["springs"]["power"] == pytest.approx(-1, abs=0.01) and e["springs"]["slip_hard_mm"] == 0  # Hooke
    # speeds of a step's end make the way longer by h/t, 0.25 %, and bonds yield a little at the start
    assert e["wedge"]["way"] == pytest.approx(0.5 * 9.81 * (0.5 - 0.55 * 0.75**0.5) * 4, rel=0.01)
    assert e["bond"]["known"][3] == pytest.approx(0.5) and e["bond"]["known"][0] == 1
    # the force grows by 1e-3 a step, and the disk has moved visibly after a few
    assert all(0 < force - known < 0.01 for force, known in zip(e["bond"]["force"], e["bond"]["known"]))
    assert e["weakening"]["critical"] == pytest.approx(0.5, abs=0.051)  # a row of the table
    assert e["weakening"]["energy"] == pytest.approx(e["weakening"]["energy_known"], rel=2e-3)  # one step of a thousand
    assert e["beam"]["ratio"] == pytest.approx(4, rel=1e-4) and all(1 <= load < 1.2 for load in e["beam"]["load"])
    # it is seen once it has gone 2 cm, in a second or less, in which the water rises by 0.6 m
    assert all(0 < seen - wet < 0.6 for seen, wet in zip(e["slope"]["water"], e["slope"]["known"]))
    assert e["slope"]["full"] == pytest.approx([0.6 * dry for dry in e["slope"]["dry"]], rel=1e-5)  # γ'/γ of 2500 kg/m³
    assert 0.9 < e["columns"]["exponent"] < 1.2 and all(
        1.0 < c < 2.5 for c in e["columns"]["by_aspect"]
    )  # published: 1.2 a, 2.5 a


def test_the_sheet_names_what_there_is():
    page = (ROOT / "doc" / "exercises.rst").read_text()
    named = set(re.findall(r"``(scripts/[\w/]+\.py)``", page))
    assert len(named) >= 7 and all(os.access(ROOT / name, os.X_OK) for name in named)
    assert {path.name for path in (ROOT / "scripts" / "exercises").glob("*.py")} <= {
        name.split("/")[-1] for name in named
    }
