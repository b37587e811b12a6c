"""Runs side by side: what is kept, what is removed, in what order they run, and what a failure says. The processes are
made up.
"""

import json
import threading

import pytest

from yade.nonsmooth import errors
from yade.nonsmooth.running import kept_runs, processes, side_by_side
from yade.nonsmooth.system import keys, output_folder


class MadeUpError(errors.UserError):
    pass


@pytest.fixture
def called(monkeypatch):
    """Names of the folders whose function was called, in order; a folder named "bad" fails."""
    names = []

    def call(function, folder, arguments, threads=1):
        names.append(folder.name)
        if folder.name == "bad":
            raise processes.RunError("no such rock")
        return {"double": 2 * arguments["value"]}

    monkeypatch.setattr(processes, "call", call)
    return names


def made(home, *names, key="k", work=None):
    return [
        side_by_side.Run(name, home / name, print, {"value": k}, key, (work or {}).get(name, 1.0))
        for k, name in enumerate(names)
    ]


def test_the_costly_ones_run_first_and_results_keep_their_order(tmp_path, called):
    found = side_by_side.run(made(tmp_path, "a", "b", "c", work={"b": 5.0}), 1)
    assert called == ["b", "a", "c"] and [one["double"] for one in found] == [0, 2, 4]
    assert all(one["process_wall_s"] >= 0 for one in found)
    assert json.loads((tmp_path / "c" / "result.json").read_text())["found"] == found[2]


@pytest.mark.parametrize("threads", [0, 1, 3])
def test_as_many_run_at_a_time_as_were_asked_for(threads):
    """Calls that wait for each other: as many as can meet, and no more; none asked for is one."""
    least, most, inside, guard = max(1, threads), 0, 0, threading.Lock()
    meet = threading.Barrier(least)

    def call(_):
        nonlocal inside, most
        with guard:
            inside += 1
            most = max(most, inside)
        meet.wait(30.0)  # s; broken where fewer run
        with guard:
            inside -= 1

    with processes.pool(threads) as made_up:
        list(made_up.map(call, range(4 * least)))
    assert most == least


def test_a_resume_keeps_what_has_ended_with_the_same_key(tmp_path, called):
    side_by_side.run(made(tmp_path, "a", "b"), 2)
    shares = []
    kept_runs.Progress(tmp_path / "b")(0.5)
    side_by_side.run(
        [*made(tmp_path, "a"), *made(tmp_path, "b", key="other")],
        1,
        resume=True,
        progress=lambda share, ended: shares.append((share, ended)),
    )
    assert sorted(called[:2]) == ["a", "b"] and called[2:] == ["b"] and shares[-1] == (1.0, 2)
    assert kept_runs.kept(tmp_path / "b", "other", print) and not kept_runs.kept(tmp_path / "b", "k", print)
    side_by_side.run(made(tmp_path, "a"), 1)
    assert called[3:] == ["a"]  # without resume all is done again


@pytest.mark.parametrize("resume, go_on, left", [(True, True, True), (True, False, False), (False, True, False)])
def test_what_a_halted_run_wrote_stays_only_for_a_function_that_goes_on(tmp_path, monkeypatch, resume, go_on, left):
    (tmp_path / "a").mkdir()
    kept_runs.begin(tmp_path / "a", "k")
    for name in ("checkpoint", "result.json"):
        (tmp_path / "a" / name).write_text("{}")
    kept_runs.Progress(tmp_path / "a")(0.7)
    monkeypatch.setattr(processes, "call", lambda function, folder, arguments: {"share": kept_runs.share(folder)})
    found = side_by_side.run(made(tmp_path, "a"), 1, resume=resume, go_on=go_on)
    assert found[0]["share"] == 0.0  # an earlier result or share is none of this run's
    assert (tmp_path / "a" / "checkpoint").exists() == left
    if not go_on:  # nobody goes on who does not say so
        kept_runs.begin(tmp_path / "a", "k")
        (tmp_path / "a" / "checkpoint").write_text("{}")
        (tmp_path / "a" / "result.json").unlink()
        side_by_side.run(made(tmp_path, "a"), 1, resume=resume)
        assert not (tmp_path / "a" / "checkpoint").exists()


@pytest.mark.parametrize("part", ["engines_key", "statements"])
def test_a_resume_takes_nothing_of_other_engines_or_code(tmp_path, called, monkeypatch, part):
    side_by_side.run(made(tmp_path, "a"), 1)
    (tmp_path / "a" / "checkpoint").write_text("{}")
    monkeypatch.setattr(keys, part, lambda *_: "others")
    assert kept_runs.kept(tmp_path / "a", "k") is None and not kept_runs.begun(tmp_path / "a", "k")
    side_by_side.run(made(tmp_path, "a"), 1, resume=True, go_on=True)
    assert called == ["a", "a"] and not (tmp_path / "a" / "checkpoint").exists()
    side_by_side.run(made(tmp_path, "a"), 1, resume=True, go_on=True)
    assert called == ["a", "a"]  # of these


def test_a_halted_run_is_not_removed_by_another(tmp_path, called):
    """One that has a checkpoint, for functions that go on from it; what has ended, or has none, is made anew."""

    def halted(key, *files):
        kept_runs.begin(tmp_path / "a", key, print)
        (tmp_path / "a" / "checkpoint").mkdir(exist_ok=True)
        for name in ("checkpoint/checkpoint.json", *files):
            (tmp_path / "a" / name).write_text("{}")

    (tmp_path / "a").mkdir()
    halted("k")
    for key, resume, said in (
        ("k", False, "a: holds a run that was halted, .*--resume, or give another --out"),
        ("other", False, "a: holds a run that was halted"),
        ("other", True, "a: holds a run of other parameters that was halted; give the same ones, or another --out"),
    ):
        with pytest.raises(MadeUpError, match=said):
            side_by_side.run(made(tmp_path, "b", "a", key=key), 1, resume, MadeUpError, go_on=True)
        assert called == [] and (tmp_path / "a" / "checkpoint" / "checkpoint.json").exists()
    side_by_side.run(made(tmp_path, "a"), 1, True, MadeUpError, go_on=True)
    assert called == ["a"]
    halted("k", "result.json")
    side_by_side.run(made(tmp_path, "a"), 1, False, MadeUpError, go_on=True)
    assert called == ["a", "a"]
    (tmp_path / "a" / "result.json").unlink()
    halted("k")
    side_by_side.run(made(tmp_path, "a"), 1, False, MadeUpError)
    assert called == ["a", "a", "a"]


def test_clearing_a_folder_leaves_the_lock_of_who_holds_it(tmp_path, called):
    output_folder.claim(tmp_path / "a", "a command")
    (tmp_path / "a" / "old" / "deep").mkdir(parents=True)
    kept_runs.begin(tmp_path / "a", "another")  # the folder of an earlier run
    side_by_side.run(made(tmp_path, "a"), 1)
    assert (tmp_path / "a" / output_folder.LOCK).exists() and not (tmp_path / "a" / "old").exists()


def test_a_folder_that_no_run_has_made_is_not_emptied(tmp_path, called):
    (tmp_path / "a" / "notes").mkdir(parents=True)
    (tmp_path / "a" / "thesis.tex").write_text("mine")
    with pytest.raises(MadeUpError, match="a: holds notes, which no run has left there"):
        side_by_side.run(made(tmp_path, "b", "a"), 1, error=MadeUpError)
    assert called == [] and (tmp_path / "a" / "thesis.tex").read_text() == "mine" and not (tmp_path / "b").exists()
    # halfway through the removal of an earlier run it is still one of a run
    kept_runs.begin(tmp_path / "a", "another")
    kept_runs.forsake(tmp_path / "a")
    assert kept_runs.foreign(tmp_path / "a") is None and not kept_runs.begun(tmp_path / "a", "another")


@pytest.mark.parametrize("name", ["", ".", "..", "a/b", "/tmp/a", 3])
def test_a_run_stays_below_its_folder(name):
    with pytest.raises(MadeUpError, match="as the name of a run: give a word"):
        side_by_side.folder_of("out", name, MadeUpError)


def test_a_failure_is_told_after_the_others_have_ended(tmp_path, called):
    with pytest.raises(MadeUpError, match=r"^bad: no such rock; go on$"):
        side_by_side.run(made(tmp_path, "bad", "a"), 1, error=MadeUpError, advice="; go on")
    assert called == ["bad", "a"] and kept_runs.kept(tmp_path / "a", "k") is not None


def test_two_runs_of_one_folder_are_refused_before_any_runs(tmp_path, called):
    with pytest.raises(MadeUpError, match=r"^a, b: two runs of one name; rename$"):
        side_by_side.check(made(tmp_path, "b", "a", "c", "a", "b"), MadeUpError, "; rename")
    with pytest.raises(MadeUpError, match="^a: two runs of one name"):
        side_by_side.run(made(tmp_path, "a", "b", "a"), 1, error=MadeUpError)
    assert called == [] and not (tmp_path / "a").exists()


def test_a_run_has_done_what_it_has_noted_and_all_once_it_has_a_result(tmp_path):
    assert kept_runs.share(tmp_path) == 0
    for noted, share in (("0.2500", 0.25), ("1.0000", 0.99), ("", 0), ("half", 0)):
        (tmp_path / "progress").write_text(noted)
        assert kept_runs.share(tmp_path) == share
    kept_runs.keep(tmp_path, "k", {})
    assert kept_runs.share(tmp_path) == 1


def test_what_a_run_was_made_by_is_kept_and_what_changed_since_is_named(tmp_path, called, monkeypatch):
    side_by_side.run(made(tmp_path, "a"), 1)
    kept = json.loads((tmp_path / "a" / kept_runs.MADE_BY).read_text())
    assert (kept["input"], kept["engines"], kept["code"]) == ("k", keys.engines_key(), keys.made_by(print))
    assert kept_runs.changed(tmp_path / "a") == kept_runs.changed(tmp_path / "a", "k", print) == []
    assert kept_runs.changed(tmp_path / "a", "other") == ["input"]
    whole = keys.statements
    monkeypatch.setattr(keys, "statements", lambda path: "x" if path.name == "slope_packing.py" else whole(path))
    monkeypatch.setattr(keys, "engines_key", lambda: "others")
    assert kept_runs.changed(tmp_path / "a") == ["engines", "studies/slope/slope_packing.py"]
    assert kept_runs.changed(tmp_path / "none") is None
