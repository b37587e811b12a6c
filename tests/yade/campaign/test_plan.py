"""A plan of runs in its folder: whose result is whose, what goes into the table, what is refused; the runs are made up.
Needs no YADE.
"""

import csv
import json
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import synthetic_slope as synthetic  # noqa: E402

plan, sweep, keys, processes, installation, section = (
    synthetic.load(name)
    for name in (
        "campaign.plan",
        "campaign.sweep",
        "system.keys",
        "running.processes",
        "system.installation",
        "model.section",
    )
)
kept_runs = synthetic.load("running.kept_runs")
SHIPPED = section.load("interface")


@pytest.fixture
def called(monkeypatch):
    """Stands for the processes: (function, folder's name, arguments) of the runs that were done, in order."""
    made = []

    def call(function, folder, arguments, threads=1):
        made.append((function, folder.name, arguments))
        if arguments.get("breaks"):
            raise processes.RunError("it broke")
        return {"twice": 2 * arguments["x"]}

    monkeypatch.setattr(processes, "call", call)
    monkeypatch.setattr(installation, "engines", lambda: Path(__file__))  # of no build
    return made


def planned(number=3, base=0, function="some.module:run", **arguments):
    """Runs r0, r1 …, with x = base, base + 1 …"""
    return plan.Plan(
        "made up",
        function,
        tuple(plan.Planned(f"r{k}", {"x": base + k}, {"x": base + k, **arguments}) for k in range(number)),
    )


# ---- whose result is whose ----------------------------------------------------------------------------
def test_a_runs_key_is_of_what_its_function_takes():
    """Name, values for the table and cost do not tell what it computes; each of its arguments does."""
    one = plan.Planned("a", {"seed": 1}, {"data": {"gravity": 9.81}, "end": None})
    assert one.key == plan.Planned("b", {"friction": 2}, {"end": None, "data": {"gravity": 9.81}}, work=7.0).key
    for arguments in (
        {"data": {"gravity": 1.62}, "end": None},
        {"data": {"gravity": 9.81}, "end": 5.0},
        {"data": {"gravity": 9.81}},
    ):
        assert plan.Planned("a", {"seed": 1}, arguments).key != one.key


def test_the_same_values_of_another_section_are_another_run():
    """A sweep over the same seeds, where all disks are a little smaller, or another material has another friction."""
    over = {"seed": [1, 2]}
    mine = sweep.sweep(SHIPPED, over)
    again = sweep.sweep(SHIPPED, over)
    assert [one.key for one in again.runs] == [one.key for one in mine.runs] and mine.runs[0].key != mine.runs[1].key
    with_values = synthetic.load("model.section.values").with_values
    for key, value in (("materials.rock.friction", 0.123), ("gravity", 1.62)):
        other = sweep.sweep(with_values(SHIPPED, {key: value}), over)
        assert [one.values for one in other.runs] == [one.values for one in mine.runs]
        assert not {one.key for one in other.runs} & {one.key for one in mine.runs}
    until = sweep.sweep(SHIPPED, over, end=3.0)
    assert until.runs[0].key != mine.runs[0].key


def test_no_result_of_other_input_is_taken(tmp_path, called):
    """The same names and values, and another number among the arguments: all are done again, and none is collected
    before.
    """
    planned(g=9.81).run(tmp_path, 1)
    other = planned(g=1.62)
    called.clear()
    other.write(tmp_path)
    with pytest.raises(plan.PlanError, match="3 of 3 runs have no result of this input"):
        plan.collect(tmp_path)
    other.run(tmp_path, 1, resume=True)
    assert [(name, arguments["g"]) for _, name, arguments in called] == [(f"r{k}", 1.62) for k in range(3)]
    called.clear()
    other.run(tmp_path, 1, resume=True)
    assert not called


# ---- the plan and its runs ----------------------------------------------------------------------------
def test_each_run_is_done_by_the_plans_function_in_a_folder_of_its_name(tmp_path, called):
    shares = []
    table = planned(g=9.81).run(tmp_path, 1, progress=lambda share, ended: shares.append((share, ended)))
    assert called == [("some.module:run", f"r{k}", {"x": k, "g": 9.81}) for k in range(3)]
    assert shares[-1] == (1.0, 3)
    assert table["run"] == ["r0", "r1", "r2"] and table["x"] == [0, 1, 2] and table["twice"] == [0, 2, 4]
    assert all((tmp_path / "runs" / name / "result.json").is_file() for name in table["run"])


def test_a_plan_is_read_as_it_was_written(tmp_path, called):
    made = plan.Plan("made up", "m:f", (plan.Planned("a", {"s": [1, 2]}, {"x": None}, 4.0),), notes=("a word",))
    made.write(tmp_path)
    again = plan.read(tmp_path)
    assert again == made and again.notes == ()  # notes are not kept, and do not count
    assert json.loads((tmp_path / "plan.json").read_text()) == {
        "format": 1,
        "title": "made up",
        "function": "m:f",
        "runs": [{"name": "a", "values": {"s": [1, 2]}, "arguments": {"x": None}, "work": 4.0}],
    }


@pytest.mark.parametrize(
    "text, message",
    [
        (None, "plan.json: there is no plan; make one with --plan, or give the folder of one"),
        ("{", "plan.json: the plan cannot be read .*; make it again with --plan"),
        ("[]", "plan.json: the plan cannot be read"),
        ("{}", "plan.json: the plan cannot be read"),
        ('{"format": 2}', "plan.json: another version of this package wrote this plan; make it again with --plan"),
        ('{"format": 1, "title": "t", "function": "f"}', "plan.json: the plan cannot be read"),
        ('{"format": 1, "title": "t", "function": "f", "runs": [{"name": "a", "odd": 1}]}', "the plan cannot be read"),
        ("[" * 100000, "plan.json: the plan cannot be read"),
    ],
    ids=["none", "half", "list", "empty", "format", "runs", "keys", "deep"],
)
def test_what_is_no_plan_is_refused(tmp_path, text, message):
    if text is not None:
        (tmp_path / "plan.json").write_text(text)
    with pytest.raises(plan.PlanError, match=message):
        plan.read(tmp_path)
    with pytest.raises(plan.PlanError, match=message):
        plan.run_one(tmp_path, 0)
    with pytest.raises(plan.PlanError, match=message):
        plan.collect(tmp_path)


@pytest.mark.parametrize(
    "which, message",
    [
        (3, "no number 3: give one from 0 to 2"),
        (-1, "no number -1: give one from 0 to 2"),
        ("r3", "no run is called 'r3': see .*plan.json"),
        ("0", "no run is called '0'"),
    ],
)
def test_a_run_that_the_plan_has_not_is_refused(tmp_path, called, which, message):
    planned().write(tmp_path)
    with pytest.raises(plan.PlanError, match=message):
        plan.run_one(tmp_path, which)
    assert not called


def test_one_run_by_its_name_or_number(tmp_path, called):
    planned(base=5).write(tmp_path)
    assert plan.run_one(tmp_path, 2)["twice"] == 14 and plan.run_one(tmp_path, "r0")["twice"] == 10
    assert [name for _, name, _ in called] == ["r2", "r0"]
    assert plan.run_one(tmp_path, "r2")["twice"] == 14 and len(called) == 2  # it is kept
    with pytest.raises(
        plan.PlanError, match="^[^:]*: 1 of 3 runs have no result .*: r1; run them, or go on with --resume$"
    ):
        plan.collect(tmp_path)


def test_a_run_that_fails_alone_is_told(tmp_path, called):
    planned(breaks=True).write(tmp_path)
    with pytest.raises(plan.PlanError, match="^r1: it broke$"):
        plan.run_one(tmp_path, 1)


@pytest.mark.parametrize(
    "number, names", [(3, "r0, r1, r2; run"), (4, "r0, r1, r2 and 1 more; run"), (9, "r0, r1, r2 and 6 more; run")]
)
def test_runs_that_are_missing_are_named_three_at_most(tmp_path, called, number, names):
    planned(number).write(tmp_path)
    with pytest.raises(plan.PlanError, match=f"{number} of {number} runs have no result .*: {names}"):
        plan.collect(tmp_path)


# ---- the table ----------------------------------------------------------------------------------------
def ended(folder, made, results):
    """A plan whose runs have ended with these results."""
    made.write(folder)
    for one, result in zip(made.runs, results, strict=True):
        kept_runs.keep(folder / "runs" / one.name, one.key, result, made.function)
    return folder


def test_numbers_of_any_depth_are_columns_and_texts_are_not(tmp_path, called):
    """Of all texts, a slope's verdict and why its times are missing go into the table."""
    nan, inf = float("nan"), float("-inf")
    results = [
        {
            "verdict": "stood",
            "times_missing": {"t1": "it did not move", "t2": None},
            "n": 3,
            "ok": False,
            "none": None,
            "nan": nan,
            "inf": inf,
            "text": "no",
            "list": [1.0],
            "deep": {"x": 0.5, "verdict": "no", "more": {"y": -1, "times_missing": {"t1": "no"}, "no": "text"}},
        },
        {"verdict": "failed dry", "times_missing": {}, "n": 4, "late": 1.5},
    ]
    table = plan.collect(ended(tmp_path, planned(2), results))
    assert table == {
        "run": ["r0", "r1"],
        "x": [0, 1],
        "verdict": ["stood", "failed dry"],
        "times_missing.t1": ["it did not move", None],
        "times_missing.t2": [None, None],
        "n": [3, 4],
        "ok": [False, None],
        "none": [None, None],
        "nan": [None, None],
        "inf": [None, None],
        "deep.x": [0.5, None],
        "deep.more.y": [-1, None],
        "late": [None, 1.5],
    }
    with open(tmp_path / "table.csv", newline="") as file:
        rows = list(csv.reader(file))
    assert rows[0] == list(table)
    assert rows[1:] == [
        ["r0", "0", "stood", "it did not move", "", "3", "False", "", "", "", "0.5", "-1", ""],
        ["r1", "1", "failed dry", "", "", "4", "", "", "", "", "", "", "1.5"],
    ]


def test_means_are_written_where_seeds_were_varied_and_nowhere_else(tmp_path, called):
    values = [{"friction": f, "seed": s} for f in (0.3, 0.6) for s in (1, 2)]
    seeds = plan.Plan("made up", "m:f", tuple(plan.Planned(f"r{k}", v, v) for k, v in enumerate(values)))
    plan.collect(ended(tmp_path / "seeds", seeds, [{"n": n} for n in (1.0, 3.0, 10.0, 30.0)]))
    told = json.loads((tmp_path / "seeds" / "means.json").read_text())
    assert (told["title"], told["varied"]) == ("made up", ["friction"])
    assert [(row["values"], row["numbers"]["n"]["mean"]) for row in told["rows"]] == [
        ({"friction": 0.3}, 2.0),
        ({"friction": 0.6}, 20.0),
    ]
    plan.collect(ended(tmp_path / "none", planned(2), [{"n": 1.0}, {"n": 2.0}]))
    assert not (tmp_path / "none" / "means.json").exists()


def test_means_of_each_combination_and_verdict():
    """Of eight runs by two frictions, two densities and two seeds, one of which stood; and of runs without seeds or
    verdicts, each a row of its own.
    """
    combos = [(f, d, s) for f in (0.3, 0.6) for d in (1, 2) for s in (7, 8)]
    table = {
        "run": [f"r{k}" for k in range(8)],
        **{name: [c[k] for c in combos] for k, name in enumerate(("friction", "density", "seed"))},
        "verdict": ["failed"] * 3 + ["stood"] + ["failed"] * 4,
        "times_missing.t1": [None, None, None, "it stood", "late", None, None, None],
        "n": [1.0, 3.0, 5.0, 100.0, 7.0, 9.0, None, 11.0],
    }
    rows = plan.means(table, ["friction", "density", "seed"])
    assert [(*r["values"].values(), r["verdict"], r["seeds"], r["of"], r["numbers"]["n"]["mean"]) for r in rows] == [
        (0.3, 1, "failed", [7, 8], 2, 2.0),
        (0.3, 2, "failed", [7], 2, 5.0),
        (0.3, 2, "stood", [8], 2, 100.0),
        (0.6, 1, "failed", [7, 8], 2, 8.0),
        (0.6, 2, "failed", [7, 8], 2, None),  # one of the two has no value
    ]
    assert [r["times_missing"] for r in rows] == [
        {"t1": [None, None]},
        {"t1": [None]},
        {"t1": ["it stood"]},
        {"t1": ["late", None]},
        {"t1": [None, None]},
    ]
    assert all(set(r["numbers"]) == {"n"} for r in rows)
    # 1 to both sides of 2 is a standard error of 1; Student's t of one degree of freedom, 97.5 %
    assert rows[0]["numbers"]["n"]["half_width"] == pytest.approx(12.7062, abs=1e-4)
    assert rows[1]["numbers"]["n"]["half_width"] is None
    alone = plan.means({"run": ["a", "b"], "friction": [0.3, 0.6], "n": [1.0, 2.0]}, ["friction"])
    assert [(r["values"], r["verdict"], r["seeds"], r["of"]) for r in alone] == [
        ({"friction": 0.3}, None, [], 1),
        ({"friction": 0.6}, None, [], 1),
    ]


@pytest.mark.parametrize(
    "table, varied, said",
    [
        ({"friction": [0.3]}, ["friction"], "^table: the table has no column 'run'; it has friction$"),
        (
            {"run": ["a"], "friction": [0.3], "seed": [1]},
            ["friction", "water.rate"],
            "^varied: the table has no column 'water.rate'; it has run, friction, seed$",
        ),
        (
            {"run": ["a"]},
            "seed",
            r"^varied 'seed': give the list of the keys that were varied, as \['seed', 'water.rate'\]$",
        ),
        ({"run": ["a"]}, [7], r"^varied \[7\]: give the list of the keys"),
        ([["a"]], ["seed"], "^table .*give the table of a plan"),
    ],
)
def test_a_table_without_what_was_varied_has_no_means(table, varied, said):
    with pytest.raises(plan.PlanError, match=said):
        plan.means(table, varied)
