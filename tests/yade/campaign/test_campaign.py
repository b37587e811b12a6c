"""A plan of runs: what it makes of a section, what it keeps and collects, and that it is the same run here, through
Snakemake and as a job of Slurm.
"""

import csv
import fcntl
import json
import shutil
import subprocess
import sys
import warnings

import oracles
import pytest
import shell
from shell import ROOT
from yade.nonsmooth import campaign, figures, section
from yade.nonsmooth.model.section import data as section_data
from yade.nonsmooth.running import kept_runs, processes
from yade.nonsmooth.system import keys, output_folder

SHIPPED = section.load("interface")
PYTHON = "/usr/bin/python3"
EXAMPLE = ROOT / "doc" / "examples" / "sweep.py"


def of(one):
    """The Section of a planned run."""
    return section.of(one.arguments["data"], one.name)


def test_all_combinations_are_planned_and_each_has_its_values():
    over = {"materials.rock.friction": [0.2, 0.4, 0.8], "water.table.rate": [0.5, 1], "seed": (3, 4)}
    plan = campaign.sweep(SHIPPED, over, end=7.0, figures=True)
    assert len(plan.runs) == 12 and len({one.name for one in plan.runs}) == 12 and plan.title == SHIPPED.name
    assert [one.values["seed"] for one in plan.runs] == [3, 4] * 6 and plan.runs[
        -1
    ].name == "friction=0.8_rate=1_seed=4"
    for one in plan.runs:
        made = of(one)
        assert (made.materials["rock"].friction, made.water.rate, made.seed) == tuple(one.values.values())
        assert (one.arguments["end"], one.arguments["figures"]) == (7.0, True) and one.work == sum(made.disk_counts())
        assert (
            made.walls == SHIPPED.walls
            and made.layers == SHIPPED.layers
            and made.materials["joint"] == SHIPPED.materials["joint"]
        )
    assert campaign.sweep(SHIPPED, {}).runs[0].name == "run"


@pytest.mark.parametrize("resume", [False, True])
def test_a_slope_alone_is_run_with_what_it_was_given(tmp_path, monkeypatch, resume):
    """Its checkpoint is forgotten unless it goes on from it; what the process is told is what a planned run is told."""
    inside, told = sys.modules[campaign.run_slope.__module__], []
    monkeypatch.setattr(inside.checkpoints, "forget", lambda out: told.append(("forget", out)))
    monkeypatch.setattr(inside.processes, "call", lambda *call: told.append(call))
    monkeypatch.setattr(inside.runs, "open_run", lambda out: f"the run in {out.name}")
    out = tmp_path / "one"
    if resume:
        out.mkdir()
    assert campaign.run_slope(SHIPPED, out, end=7.0, figures=True, resume=resume, threads=3) == "the run in one"
    planned = campaign.sweep(SHIPPED, {}, end=7.0, figures=True)
    assert told == [("forget", out)] * (not resume) + [(planned.function, out, planned.runs[0].arguments, 3)]


def test_items_of_lists_go_by_their_names_and_lists_are_values_too():
    plan = campaign.sweep(
        SHIPPED, {"interfaces.joint.material": ["joint", "rock"], "disks.diameter": [[1.0, 2.0], [1.5, 3.0]]}
    )
    assert [one.name for one in plan.runs] == [
        "material=joint_diameter=1.0x2.0",
        "material=joint_diameter=1.5x3.0",
        "material=rock_diameter=1.0x2.0",
        "material=rock_diameter=1.5x3.0",
    ]
    assert of(plan.runs[3]).interfaces[0].material == "rock" and (
        of(plan.runs[3]).disks.d_min,
        of(plan.runs[3]).disks.d_max,
    ) == (1.5, 3.0)
    first = SHIPPED.walls[0]
    wall = of(campaign.sweep(SHIPPED, {f"walls.{first.name}.role": ["obstacle"]}).runs[0])
    assert [w.role for w in wall.walls] == ["obstacle", *(w.role for w in SHIPPED.walls[1:])] and len(wall.walls) > 1
    both = campaign.sweep(SHIPPED, {"materials.rock.friction": [0.1], "materials.joint.friction": [0.2]})
    assert both.runs[0].name == "rock.friction=0.1_joint.friction=0.2"  # as many words as tell them apart
    long = campaign.sweep(SHIPPED, {"description": ["a" * 200, "b" * 200]})
    assert [one.name for one in long.runs] == ["0000", "0001"]


def test_the_release_from_water_follows_a_swept_critical_slip():
    key, values = "materials.dp.slip_weakening.critical_slip", [1, 2, 5, 10]
    plan = campaign.sweep(section.load("jiufengershan"), {key: values})
    assert [(of(one).materials["dp"].critical_slip, of(one).release_distance) for one in plan.runs] == [
        (v, v) for v in values
    ]
    assert plan.notes == ()
    # a number stands, and what then differs is said, for each run that it differs in
    joint = "materials.joint.slip_weakening.critical_slip"
    fixed = campaign.sweep(SHIPPED, {joint: [2.0, 60.0, 5.0]})
    assert [of(one).release_distance for one in fixed.runs] == [60.0] * 3
    assert [note.partition(":")[0] for note in fixed.notes] == ["critical_slip=2.0", "critical_slip=5.0"]
    both = campaign.sweep(SHIPPED, {joint: [2.0, 3.0], "water.release_distance": ["critical_slip"]})
    assert [of(one).release_distance for one in both.runs] == [2.0, 3.0] and both.notes == ()


@pytest.mark.parametrize(
    "over, message",
    [
        (
            {"materials.rok.friction": [0.1]},
            "materials.rok.friction: there is no 'rok' in materials of the section; did you mean 'rock'?",
        ),
        (
            {"walls.none.material": ["rock"]},
            "walls.none.material: there is no 'none' in walls of the section; there are ",
        ),
        ({"seed.more": [1]}, "seed.more: there is no 'more' in seed of the section; nothing can be varied there"),
        ({"seed": []}, "seed: no value to run with"),
        ({"seed": [1, 2, 1]}, "seed: 1, 2, 1: a value stands twice"),
        (
            {"water.table.rate": [1, 2], "water.table": [{"rate": 3}]},
            "water.table.rate and water.table: the value of the second takes the place of that of the first; name water.table first",
        ),
        (
            {"seed": range(101), "gravity": [1.0 + k for k in range(100)]},
            "101 × 100 = 10100 runs; a plan has 10000 at most",
        ),
    ],
)
def test_what_cannot_be_planned_is_told(over, message):
    with pytest.raises(campaign.PlanError) as refused:
        campaign.sweep(SHIPPED, over)
    assert str(refused.value).startswith(message)


@pytest.mark.parametrize(
    "over, message",
    [
        ({"seeds": [1]}, "seeds=1: seeds: unknown key; did you mean 'seed'?"),
        ({"materials.rock.friction": [0.1, -1]}, "friction=-1: materials.rock.friction: -1 is not allowed"),
    ],
)
def test_a_combination_that_is_no_section_is_named_before_anything_runs(over, message):
    with pytest.raises(section.SectionError) as refused:
        campaign.sweep(SHIPPED, over)
    assert str(refused.value).startswith(message)


# ---- its folder; the processes are made up ---------------------------------------------------------


@pytest.fixture
def called(monkeypatch):
    """Names of the runs that were done, in order; one of friction 0.9 fails."""
    names = []

    def call(function, folder, arguments, threads=1):
        names.append(folder.name)
        assert function == "studies.slope.slope_run:run"
        made = section.of(arguments["data"])
        if made.materials["rock"].friction == 0.9:
            raise processes.RunError("it broke")
        return {
            "verdict": "failed by water",
            "rest": None,
            "twice": 2 * made.seed,
            "text": "left out",
            "list": [1],
            "worst": float("inf"),
            "times": {"t0": 0.5 * made.seed, "more": {"ok": True}},
        }

    monkeypatch.setattr(processes, "call", call)
    return names


def planned(frictions=(0.3, 0.6), seeds=(1, 2)):
    return campaign.sweep(SHIPPED, {"materials.rock.friction": list(frictions), "seed": list(seeds)})


def test_the_table_has_values_and_numbers_of_each_run(tmp_path, called):
    table = planned().run(tmp_path, 2)
    assert sorted(called) == sorted(one.name for one in planned().runs)
    walls = table.pop("process_wall_s")
    assert all(0 <= w for w in walls)
    assert table == {
        "run": [one.name for one in planned().runs],
        "materials.rock.friction": [0.3, 0.3, 0.6, 0.6],
        "seed": [1, 2, 1, 2],
        "verdict": ["failed by water"] * 4,
        "rest": [None] * 4,
        "twice": [2, 4, 2, 4],
        "worst": [None] * 4,
        "times.t0": [0.5, 1.0, 0.5, 1.0],
        "times.more.ok": [True] * 4,
    }
    with open(tmp_path / "table.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert (
        [row["times.t0"] for row in rows] == ["0.5", "1.0", "0.5", "1.0"]
        and rows[0]["rest"] == ""
        and list(rows[0])[:3] == ["run", "materials.rock.friction", "seed"]
    )
    again = campaign.read(tmp_path)
    assert again == planned() and campaign.collect(tmp_path)["twice"] == [2, 4, 2, 4]


def test_the_means_are_over_seeds_alone(tmp_path, called):
    planned().run(tmp_path, 2)
    told = json.loads((tmp_path / "means.json").read_text())
    assert told["varied"] == ["materials.rock.friction"]
    assert [row["values"] for row in told["rows"]] == [{"materials.rock.friction": f} for f in (0.3, 0.6)]
    for row in told["rows"]:
        assert row["seeds"] == [1, 2] and set(row["numbers"]) > {"twice", "rest", "times.t0"}
        twice = row["numbers"]["twice"]
        # 1 to both sides of 3 is a standard error of 1, and Student's t of one degree of freedom 12.706
        assert twice == {"mean": 3.0, "half_width": pytest.approx(12.706, abs=1e-3), "values": [2, 4]}
        assert row["numbers"]["rest"] == {"mean": None, "half_width": None, "values": [None, None]}
    campaign.sweep(SHIPPED, {"materials.rock.friction": [0.3]}).run(tmp_path / "one", 1)
    assert not (tmp_path / "one" / "means.json").exists()  # no seed was varied


def table_of_kinds():
    """Five slopes of one friction, three of which failed by water, and two of another, which stood."""
    return {
        "run": list("abcdefg"),
        "friction": [0.3] * 5 + [0.6] * 2,
        "seed": [1, 2, 3, 4, 5, 1, 2],
        "verdict": ["failed by water", "stood", "failed by water", "failed by water", "stood", "stood", "stood"],
        "height": [10.0, None, 11.0, 12.0, None, None, None],
        "travel": [100.0, 0.0, 110.0, 120.0, 1.0, 0.0, 2.0],
        "motion_s": [30.0, None, None, 40.0, None, None, None],
        "times_missing.t3": [None, "it did not move", "nothing weakened", None, *["it did not move"] * 3],
    }


def test_results_that_are_none_are_refused_before_anything_runs(tmp_path, in_process):
    words = ("--section", "interface", "--over", "materials.joint.friction=0.5,0.6", "--out", tmp_path / "no")
    for name, near in (
        ("front_travl_m", "front_travel_m"),
        ("times_s.t11", "times_s.t1"),
        ("verdict", None),
        ("fb_normal", None),
    ):
        done = in_process("sweep.py", *words, "--draw", f"motion_s,{name}")
        assert done.status == 1 and not (tmp_path / "no").exists()
        assert done.last.startswith(f"error: --draw {name}: no result is called so; ")
        assert near is None or f"did you mean {near!r}" in done.last


def test_a_result_that_no_run_has_is_drawn_as_none(tmp_path, called, in_process):
    """It is known, and the slopes have not come so far: a panel that says so, and no error after all the runs."""
    planned((0.3, 0.5)).run(tmp_path, 1)
    done = in_process("sweep.py", "--out", tmp_path, "--collect", "--draw", "twice,water_at_failure_m")
    assert done.status == 0 and "means.png" in done.out, done.err


def test_all_of_a_large_legend_is_in_the_picture():
    """Twelve lines of two keys with long names, and all kinds: within the figure, clear of the panels, and each line
    with a look of its own.
    """
    kinds = ("failed by water", "stood", "slid", "failed dry", "moved dry", "not at rest", "not over")
    key = "materials.weathered rock of the upper layer.residual_rolling_friction"
    number = {"values": [1.0, 2.0], "mean": 1.5, "half_width": 0.5}
    rows = [
        {"values": {key: f, "materials.joint.friction": a, "materials.rock.friction": b, "seed_of": "s"}, "verdict": kind, "numbers": {"travel": number, "none": {"values": [None, None], "mean": None, "half_width": None}}}
        for f in (0.1, 0.2) for a in (0.3, 0.4, 0.5) for b in (0.5, 0.6, 0.7, 0.8) for kind in kinds
    ]  # fmt: skip
    for names in (["travel"], ["travel", "none", "travel"]):
        fig = figures.means(rows, key, names)
        fig.draw_without_rendering()
        width, height = fig.bbox.size
        (legend,) = fig.legends
        box = legend.get_window_extent()
        assert box.x0 >= 0 and box.x1 <= width and box.y1 <= height
        for ax in fig.axes:
            whole = ax.get_tightbbox()
            assert whole.y1 < box.y0 and 0 <= whole.y0 and ax.get_window_extent().height == pytest.approx(2.7 * fig.dpi)
        texts = [" ".join(t.get_text().split()) for t in legend.get_texts()]
        assert len(texts) == 12 + len(kinds) and "joint.friction = 0.3, rock.friction = 0.5, seed_of = s" in texts
        lines = [one for one in legend.get_lines() if one.get_linestyle() != "None"]
        assert len({(one.get_color(), one._dash_pattern[1] and tuple(one._dash_pattern[1])) for one in lines}) == 12


def test_no_mean_is_over_slopes_that_stood_and_slopes_that_failed():
    rows = campaign.means(table_of_kinds(), ["friction", "seed"])
    assert [(row["values"]["friction"], row["verdict"], row["seeds"], row["of"]) for row in rows] == [
        (0.3, "failed by water", [1, 3, 4], 5),
        (0.3, "stood", [2, 5], 5),
        (0.6, "stood", [1, 2], 2),
    ]
    assert [row["numbers"]["height"]["mean"] for row in rows] == [11.0, None, None]
    assert [row["numbers"]["travel"]["mean"] for row in rows] == [110.0, 0.5, 1.0]
    assert all(set(row["numbers"]) == {"height", "travel", "motion_s"} for row in rows)
    assert rows[0]["times_missing"] == {"t3": [None, "nothing weakened", None]}
    alone = {name: values[:1] for name, values in table_of_kinds().items() if name != "verdict"}
    assert campaign.means(alone, ["friction", "seed"])[0]["verdict"] is None  # of another function


def test_panels_keep_kinds_apart_and_say_who_has_no_result():
    rows = campaign.means(table_of_kinds(), ["friction", "seed"])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        fig = figures.means(rows, "friction", ["travel", "height", "motion_s"])
        none = figures.means(rows[1:], "friction", ["height"])
        fig.draw_without_rendering()
        none.draw_without_rendering()
    travel, height, motion = fig.axes
    said = " ".join(motion.texts[0].get_text().split())
    assert said.endswith("without this value: 1 failed by water: nothing weakened; 4 stood: it did not move")
    assert len({ax.get_xlim() for ax in (*fig.axes, *none.axes)}) == 1
    squares = [
        one
        for one in travel.lines
        if one.get_marker() == "s" and len(one.get_xdata()) == 1 and one.get_markersize() == 6
    ]
    circles = [
        one
        for one in travel.lines
        if one.get_marker() == "o" and len(one.get_xdata()) == 2 and one.get_markersize() == 6
    ]
    assert [one.get_ydata().tolist() for one in squares] == [[110.0]]
    assert [one.get_ydata().tolist() for one in circles] == [[0.5, 1.0]]
    assert {t.get_text() for t in fig.legends[0].get_texts()} == {"failed by water", "stood"}
    assert not travel.texts and "without this value: 4 stood" in height.texts[0].get_text()
    (empty,) = none.axes
    assert empty.texts[0].get_text() == "no run has this value:\n4 stood" and not empty.lines


def test_results_are_drawn_against_what_was_varied(tmp_path, called):
    table = planned((0.3, 0.5, 0.6)).run(tmp_path, 2)
    done = shell.run("sweep.py", "--out", tmp_path, "--collect", "--draw", "twice,times.t0")
    assert done.returncode == 0 and "means.png" in done.stdout and (tmp_path / "means.png").stat().st_size > 1e4
    done = shell.run("sweep.py", "--out", tmp_path, "--collect", "--draw", "twicce")
    assert done.returncode != 0 and "did you mean 'twice'?" in done.stderr
    for name in ("run", "seed"):  # columns that are no results
        assert shell.run("sweep.py", "--out", tmp_path, "--collect", "--draw", name).returncode != 0
    # without seeds each run is a mean of one
    alone = campaign.sweep(SHIPPED, {"materials.rock.friction": [0.3, 0.6]}).run(tmp_path / "alone", 1)
    one = campaign.means(alone, ["materials.rock.friction"])
    assert [(row["seeds"], row["numbers"]["twice"]["half_width"]) for row in one] == [([], None)] * 2
    done = shell.run(
        "sweep.py", "--section", "interface", "--over", "seed=1,2", "--draw", "twice", "--out", tmp_path / "no"
    )
    assert done.returncode != 0 and "only the seed was varied" in done.stderr and not (tmp_path / "no").exists()
    rows = campaign.means(table, ["materials.rock.friction", "seed"])
    (ax,) = figures.means(rows, "materials.rock.friction", ["twice"]).axes
    *dots, bars = (
        line.get_xydata().tolist()
        for line in ax.lines
        if len(line.get_xydata()) in (2, 3) and line.get_marker() in "os"
    )
    assert dots == [[[f, 2], [f, 4]] for f in (0.3, 0.5, 0.6)] and bars == [[f, 3] for f in (0.3, 0.5, 0.6)]


def test_a_plan_holds_its_folder_while_it_runs_and_no_longer(tmp_path, called, monkeypatch):
    """A notebook's process lives on, and a shell may go on with --resume; others are kept out meanwhile."""

    def free():
        with open(tmp_path / output_folder.LOCK, "a") as other:
            try:
                fcntl.flock(other, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                return False
            return True

    found = []
    planned().run(tmp_path, 1, progress=lambda share, ended: found.append(free()))
    assert found and not any(found) and free()


def test_a_plan_that_grows_keeps_what_has_ended(tmp_path, called):
    planned().run(tmp_path, 1)
    called.clear()
    table = planned(seeds=(2, 3)).run(tmp_path, 1, resume=True)
    assert called == ["friction=0.3_seed=3", "friction=0.6_seed=3"] and table["twice"] == [4, 6, 4, 6]


def test_no_result_of_other_code_is_collected(tmp_path, called, monkeypatch):
    planned().run(tmp_path, 1)
    monkeypatch.setattr(keys, "statements", lambda path: "later")
    with pytest.raises(
        campaign.PlanError,
        match=r"4 of 4 runs have no result of this input, these engines and this code: friction=0.3_seed=1, .* and 1 more; run them",
    ):
        campaign.collect(tmp_path)


def test_a_failure_is_told_and_the_others_are_kept(tmp_path, called):
    with pytest.raises(
        campaign.PlanError,
        match=r"^friction=0.9_seed=1: it broke \(and 1 more\); what has ended is kept, go on with --resume$",
    ):
        planned((0.3, 0.9)).run(tmp_path, 2)
    with pytest.raises(campaign.PlanError, match="2 of 4 runs have no result"):
        campaign.collect(tmp_path)
    kept = [
        one.name
        for one in planned((0.3, 0.9)).runs
        if kept_runs.kept(tmp_path / "runs" / one.name, one.key, planned().function)
    ]
    assert kept == ["friction=0.3_seed=1", "friction=0.3_seed=2"]


def test_one_run_by_name_or_number_is_done_once(tmp_path, called):
    planned().write(tmp_path)
    assert (
        campaign.run_one(tmp_path, "friction=0.6_seed=1")["twice"] == 2
        and campaign.run_one(tmp_path, 2)["twice"] == 2
        and campaign.run_one(tmp_path, 0)["twice"] == 2
    )
    assert called == ["friction=0.6_seed=1", "friction=0.3_seed=1"]
    for which, message in ((4, "no number 4: give one from 0 to 3"), ("seed=9", "no run is called 'seed=9'")):
        with pytest.raises(campaign.PlanError, match=message):
            campaign.run_one(tmp_path, which)


def test_the_files_for_a_cluster_name_all_runs(tmp_path):
    planned().write(tmp_path)
    assert (
        "#SBATCH --array=0-3\n" in (tmp_path / "array.sh").read_text()
        and '--number "$SLURM_ARRAY_TASK_ID"' in (tmp_path / "array.sh").read_text()
    )
    script = (tmp_path / "Snakefile").read_text()
    assert (
        all(f'"{one.name}": "{keys.run_key(one.key, planned().function)}"' in script for one in planned().runs)
        and script.count("sweep.py") == 2
    )


@pytest.mark.parametrize(
    "text, message",
    [(None, "there is no plan"), ("{", "the plan cannot be read"), ('{"format": 0}', "another version")],
)
def test_a_folder_that_has_no_plan_is_told(tmp_path, text, message):
    if text is not None:
        (tmp_path / "plan.json").write_text(text)
    with pytest.raises(campaign.PlanError, match=message):
        campaign.read(tmp_path)


# ---- real runs --------------------------------------------------------------------------------------


def told(folder):
    """What a run found, but for how long it took."""
    found = json.loads((folder / "summary.json").read_text())
    return {k: v for k, v in found.items() if "wall" not in k}


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    """The documentation's script, as it is printed, run by a plain Python in a folder of its own."""
    home = tmp_path_factory.mktemp("swept")
    done = subprocess.run(
        [PYTHON, str(EXAMPLE)],
        cwd=home,
        env=shell.environment(PYTHONPATH=str(ROOT / "py")),
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0, done.stderr
    return home / "out" / "sweep", done.stdout


def test_the_sweep_of_the_documentation(swept):
    out, said = swept
    table = campaign.collect(out)
    assert len(table["run"]) == 18 and set(table["finished"]) == {True}
    assert all(
        len(set(table[name])) == count for name, count in ((list(table)[1], 3), (list(table)[2], 3), ("seed", 2))
    )
    first = campaign.read(out).runs[0]
    assert section_data.plain(section.load(str(out / "runs" / first.name / "section.yaml"))) == first.arguments["data"]
    means = {tuple(line.split()[-4:-3]) for line in said.splitlines()[-9:]}
    assert len(means) > 1 and all(line.split()[-1] == "2" for line in said.splitlines()[-9:])  # nine rows of two seeds


def test_snakemake_and_an_array_job_do_the_same_runs(swept, tmp_path):
    """Bit by bit, but for how long they took: three runs each, the others are taken over from here."""
    program = oracles.program("snakemake", "its runs were not held against those done here")
    mine, out = tmp_path / "sweep", swept[0]
    mine.mkdir()
    campaign.read(out).write(mine)
    names = [one.name for one in campaign.read(out).runs]
    for name in names[6:]:
        shutil.copytree(out / "runs" / name, mine / "runs" / name)
    # the first three by Slurm's script; Snakemake, which takes what there is for done, does the next three
    for number in range(3):
        subprocess.run(
            ["sh", "array.sh"],
            cwd=mine,
            env=shell.environment(SLURM_ARRAY_TASK_ID=str(number)),
            check=True,
            timeout=120,
        )
    assert [name for name in names if (mine / "runs" / name / "result.json").exists()] == names[:3] + names[6:]
    script = (mine / "Snakefile").read_text()
    assert all(f'"{keys.run_key(one.key, campaign.read(mine).function)}"' in script for one in campaign.read(mine).runs)
    (mine / "Snakefile").write_text(script.replace(sys.executable, PYTHON))  # this process is YADE's
    done = shell.run(program, "--cores", 2, "--nocolor", cwd=mine)
    assert done.returncode == 0, done.stderr[-3000:]
    assert all(told(mine / "runs" / name) == told(out / "runs" / name) for name in names)
    assert all(
        (mine / "runs" / name / "series.csv").read_bytes() == (out / "runs" / name / "series.csv").read_bytes()
        for name in names
    )
    here, there = campaign.collect(out), campaign.collect(mine)
    assert {k: v for k, v in here.items() if "wall" not in k} == {k: v for k, v in there.items() if "wall" not in k}
    # nothing is left to do
    done = shell.run(program, "--cores", 2, "--nocolor", cwd=mine, limit=120)
    assert "Nothing to be done" in done.stderr


def test_a_run_that_was_killed_goes_on(swept, tmp_path):
    """From its checkpoint, to the same records; without one from the begin."""
    out, name = swept[0], campaign.read(swept[0]).runs[0].name
    mine = tmp_path / "sweep"
    shutil.copytree(out, mine)
    (mine / "runs" / name / "result.json").unlink()
    (mine / "runs" / name / "summary.json").unlink()
    campaign.run_one(mine, name)
    assert told(mine / "runs" / name) == told(out / "runs" / name)
    for file in ("series.csv", "walls.csv", "breaks.csv"):
        assert (mine / "runs" / name / file).read_bytes() == (out / "runs" / name / file).read_bytes()


def test_a_sweep_over_diameters_beside_a_count_says_what_counts():
    over = {"disks.diameter": [[1.0, 2.0], [1.5, 3.0]]}
    assert not any("ratio" in note for note in campaign.sweep(SHIPPED, over).notes)
    notes = campaign.sweep(SHIPPED.with_disks(3000), over).notes
    assert "of disks.diameter only the ratio counts" in notes[0]
