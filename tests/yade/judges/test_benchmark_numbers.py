"""What the benchmark says follows from made-up times, whose answers are known. No scene, no clock."""
import re
from types import SimpleNamespace

import _nonsmooth_contact
import numpy as np
import pytest
from yade.nonsmooth import contact
from yade.nonsmooth.judges.benchmark import report, scale, slip_laws, steps, sweeps
from yade.nonsmooth.studies.slope import measuring as course, states

ONE = 1000  # contacts of the problem
#: Seconds of a sweep over ONE contacts, by path, threads and precision.
COST = {
    ("reference", 1, "double"): 0.040,
    ("portable", 1, "mixed"): 0.020,
    ("best", 1, "double"): 0.016,
    ("best", 1, "mixed"): 0.010,
    ("best", 2, "mixed"): 0.005,
}


@pytest.fixture
def made_up(monkeypatch):
    """Solves that take half a second once, and COST for each sweep and ONE contacts; memory that gives 2 GB/s, and 8
    GB/s what fits a cache.
    """
    size = _nonsmooth_contact.bytes_per_contact

    def solve(problem, max_iterations, threads, path, precision, **others):
        seconds = 0.5 + COST[path, threads, precision] * max_iterations * len(problem.length) / ONE
        return SimpleNamespace(iterations=max_iterations, seconds=seconds)

    def stream(bytes_each, passes):
        return [bytes_each / (8e9 if bytes_each == ONE * size else 2e9)] * passes

    monkeypatch.setattr(contact, "load", lambda path: SimpleNamespace(length=np.ones(int(path))))
    monkeypatch.setattr(contact, "solve", solve)
    monkeypatch.setattr(_nonsmooth_contact, "stream_seconds", stream)
    return size


def medians(spreads):
    return {name: one["median"] for name, one in spreads.items()}


def test_what_is_said_of_sweeps_follows_from_their_times(made_up):
    found = sweeps.measure("", str(ONE), 3)
    assert found["contacts"] == ONE and found["working_set_MB"] == pytest.approx(1e-6 * ONE * made_up)
    assert medians(found["ns_per_contact"]) == pytest.approx(
        dict(reference=40_000, portable=20_000, double=16_000, best=10_000, best_two_threads=5_000)
    )
    assert medians(found["speedup_over_reference"]) == pytest.approx(
        dict(portable=2, double=2.5, best=4, best_two_threads=8)
    )
    assert found["speedup_two_threads"]["median"] == pytest.approx(2)
    assert found["bandwidth_GB_per_s"] == pytest.approx(dict(working_set=8, memory=2))
    # memory would bring the blocks in ONE size / rate, where a sweep takes 10 ms
    assert found["fraction_of_bandwidth_bound"] == pytest.approx(
        dict(working_set=ONE * made_up / 8e9 / 0.010, memory=ONE * made_up / 2e9 / 0.010)
    )


def test_sweeps_by_size_are_told_for_each_contact(made_up):
    found = scale.measure_sweeps("", ["1000", "4000"], 2)["sweeps"]
    # the same for each contact, so the larger one took four times as long
    assert [medians(one) for one in found] == [pytest.approx({"1": 10_000, "2": 5_000})] * 2


def steps_of(state, threads, step_ms, time_step_s, **stages):
    """One measurement, as suite.run has it: a step's median and mean differ, its stages' means add up."""
    return {
        "state": state,
        "threads": threads,
        "step_ms": {"median": step_ms, "quartiles": [0.9 * step_ms, 1.2 * step_ms], "mean": sum(stages.values())},
        "stage_ms": {name: {"median": 0.0, "quartiles": [0.0, 0.0], "mean": ms} for name, ms in stages.items()},
        "time_step_s": time_step_s,
        "sweeps_mean": 12.0 + step_ms,
        "contacts": 100,
    }


@pytest.fixture
def found(made_up):
    return {
        "threads": 2,
        "steps": [
            # what one thread takes is not what is asked for
            steps_of("rest", 1, 50.0, 5e-3, solve=30.0, correct=10.0, collide=20.0),
            steps_of("moving", 1, 60.0, 5e-3, solve=30.0, correct=10.0, collide=20.0),
            steps_of("soft", 1, 5.0, 1e-3, collide=5.0),
            steps_of("rest", 2, 6.0, 5e-3, solve=2.0, correct=0.5, collide=4.0),
            steps_of("moving", 2, 9.0, 5e-3, solve=6.0, correct=2.0, collide=2.0),
            steps_of("soft", 2, 2.0, 1e-3, collide=2.5),
        ],
        "sweeps": sweeps.measure("", str(ONE), 3),
        "slip_laws": {"over_step": {"median": 0.02, "quartiles": [0.01, 0.04], "mean": 0.3}, "cells": 9},
        "cold_start": {
            name: dict(contacts=7, sweeps=n, share_of_weight=0.98, sweeps_tight=900, residual_tight=1e-8)
            for name, n in (("slope", 230), ("lmgc90", 330))
        },
        "machine": dict(cpu="made up", cores=2, compiler="c", best_path="avx", load_average=[0.5], date="today"),
    }


def test_headlines_follow_from_their_parts(found):
    told = report.summarise(found)
    assert told["step_ms"] == 6.0 and told["soft_step_ms"] == 2.0 and told["step_over_soft_step"] == 3.0
    # 1.2 s of wall time for a second of simulation, against 2 s
    assert told["simulated_second_over_soft"] == pytest.approx(0.6)
    # (6.5 - 2.5)/2.5 and (10 - 8)/8
    assert told["outside_solve_over_solve"] == pytest.approx(dict(rest=1.6, moving=0.25))
    assert told["correction_over_step"] == pytest.approx(0.5 / 6.5)
    assert told["correction_over_step_moving"] == pytest.approx(0.2)
    assert told["stage_ms"]["moving"] == dict(solve=6.0, correct=2.0, collide=2.0)
    assert told["cold_sweeps_to_1e-4"] == 230 and told["warm_sweeps_mean"] == 18.0
    assert told["slip_law_over_step"] == 0.02 and told["quartiles"]["slip_law_over_step"] == [0.01, 0.04]
    assert told["sweep_ns_per_contact"] == pytest.approx(10_000)
    assert told["sweep_speedup_over_scalar"] == pytest.approx(4)
    assert told["fraction_of_bandwidth_bound"] == pytest.approx(
        found["sweeps"]["fraction_of_bandwidth_bound"]["working_set"]
    )
    assert told["quartiles"]["step_ms"] == pytest.approx([5.4, 7.2])
    assert set(told["quartiles"]) <= set(report.HEADLINES)


def test_the_printed_table_says_the_headlines_with_their_words(found):
    told = report.summarise(found)
    rows = report.table(told).splitlines()[2:]
    for (name, what), row in zip(report.HEADLINES.items(), rows):
        value = told
        for key in name.split("/"):
            value = value[key]
        assert row.startswith(what + "  ") and row[len(what) :].split()[0] == f"{value:.4g}", name
    (step,) = (row for row in rows if row.startswith("step  "))
    # with their quartiles, by state and threads in the order measured
    assert re.split(r"\s{2,}", step)[1:] == [f"{ms} ({0.9 * ms:.3g} … {1.2 * ms:.3g})" for ms in (50, 60, 5, 6, 9, 2)]


def test_what_slip_laws_add_is_told_turn_by_turn(monkeypatch):
    """Steps of 10 and 11 ms, 20 and 20, 10 and 12: each is set beside that of its own turn, and turns begin with either."""
    took = {"given": iter((10.0, 20.0, 10.0)), "found": iter((11.0, 20.0, 12.0))}
    order, now = [], []

    class Timed:
        def run(self, count):
            assert count == 40
            return self

        def summary(self):
            return {"step_ms": {"median": next(took[now[-1]])}}

    def on_walls(make):
        now.append({slip_laws._given: "given", slip_laws._found: "found"}[make])
        return [type("M", (), {"cellCount": lambda self: 7})()] * 2

    monkeypatch.setattr(slip_laws.states, "load", lambda *asked: order.append(asked))
    monkeypatch.setattr(slip_laws, "_on_walls", on_walls)
    monkeypatch.setattr(slip_laws.steps, "TimedSteps", Timed)
    found = slip_laws.measure("", "jiufengershan", 300, 40, 3)
    assert order == [("jiufengershan", 300, "moving")] * 6
    assert now == ["given", "found", "found", "given", "given", "found"]
    assert (found["given_ms"], found["found_ms"], found["cells"]) == ([10.0, 20.0, 10.0], [11.0, 20.0, 12.0], 14)
    assert found["over_step"]["median"] == pytest.approx(0.1) and found["over_step"]["mean"] == pytest.approx(0.1)


def test_a_block_of_steps_is_divided_by_their_number(monkeypatch):
    """Blocks of ten steps and the rest of them; every call of the clock is a second later, every step gives its engine
    1 ms.
    """
    clock = iter(range(100))
    monkeypatch.setattr(steps.time, "perf_counter", lambda: float(next(clock)))
    timed = object.__new__(steps.TimedSteps)
    engine = SimpleNamespace(execTime=0)
    timed.engines, timed.solver, timed.rows = [(engine, "collide")], None, []

    def advance(count, **others):
        engine.execTime += 1_000_000 * count

    monkeypatch.setattr(steps, "advance", advance)
    timed.run(25, warm_up=3)
    # a row of a run reads a table of the disks, which counts as a part of its steps
    tables = []
    solver = SimpleNamespace(stageSeconds={"solve": 0.0}, bodyTable=lambda: tables.append(engine.execTime))
    hard = object.__new__(steps.TimedSteps)
    hard.engines, hard.solver, hard.rows = [], solver, []
    made = engine.execTime
    hard.run(20, warm_up=0)
    assert tables == [made + 10_000_000, made + 20_000_000]
    assert [row["step"] for row in timed.rows] == [0.1, 0.1, 0.2]  # a second for ten, ten and five
    assert [row["collide"] for row in timed.rows] == pytest.approx([1e-3] * 3)
    assert [row["other"] for row in timed.rows] == pytest.approx([0.099, 0.099, 0.199])
    assert timed.summary()["stage_ms"]["collide"]["mean"] == pytest.approx(1.0)
    assert timed.summary()["step_ms"]["median"] == pytest.approx(100.0)


def test_a_stage_that_the_solvers_clock_does_not_know_has_yades_timer(monkeypatch):
    """In space YADE's own engines search and integrate, and the clock has 0 for them; what it has counts once."""
    search, loop = SimpleNamespace(execTime=0), SimpleNamespace(execTime=0)
    solver = SimpleNamespace(stageSeconds={"collide": 0.0, "interactions": 1.0}, bodyTable=lambda: None)

    def advance(count, **others):
        search.execTime += 2_000_000 * count
        loop.execTime += 4_000_000 * count
        now = solver.stageSeconds["interactions"]
        solver.stageSeconds = {"collide": 0.0, "interactions": now + 3e-3 * count}

    monkeypatch.setattr(steps, "advance", advance)
    timed = object.__new__(steps.TimedSteps)
    timed.engines, timed.solver, timed.rows = [(search, "collide"), (loop, "interactions")], solver, []
    (row,) = timed.run(10, warm_up=0).rows
    assert (row["collide"], row["interactions"]) == pytest.approx((2e-3, 3e-3))
    assert row["other"] == pytest.approx(row["step"] - 5e-3)


# ---- how far it is ----------------------------------------------------------------------------------


def test_the_states_shares_of_their_making_follow_each_other(monkeypatch, tmp_path):
    """A half of it settles, three tenths move, two are soft; each stage tells of its beginning, its middle and its
    end.
    """
    told = []

    def stage(*arguments):
        for share in (0.0, 0.5, 1.0):
            arguments[-1](share)

    for name in ("section_of", "_save", "load"):
        monkeypatch.setattr(states, name, lambda *arguments: None)
    monkeypatch.setattr(states.cache, "clear", lambda *arguments: None)
    monkeypatch.setattr(states.soft_contacts, "soften", lambda built: None)
    monkeypatch.setattr(states, "Progress", lambda folder: told.append)
    for name in ("_settle", "_move", "_run_soft"):
        monkeypatch.setattr(states, name, stage)
    states.make(tmp_path, "made_up", 100)
    assert told == pytest.approx([0, 0.25, 0.5, 0.5, 0.65, 0.8, 0.8, 0.9, 1.0], abs=1e-12)  # rounding


def test_a_course_of_measurements_makes_its_folders(tmp_path, monkeypatch):
    """Below a folder that is not there yet; a second call in it finds no progress of the first."""
    asked = []

    def call(function, folder, arguments, threads):
        asked.append((function, folder, arguments, threads, (folder / "progress").exists()))
        (folder / "progress").write_text("1")
        return 3.0

    monkeypatch.setattr(course.processes, "call", call)
    made = course.MeasuringCourse(tmp_path / "new" / "out", 100.0, lambda *arguments: None)
    for gone in (30.0, 60.0):
        assert made.call("sweeps", 30.0, "module:name", {"disks": 3}, threads=2) == 3.0 and made.gone == gone
    assert asked == [("module:name", tmp_path / "new" / "out" / "runs" / "sweeps", {"disks": 3}, 2, False)] * 2


@pytest.mark.parametrize("noted, share", [("0.5", 0.4), ("", 0.2), (None, 0.2), ("9", 1.0)])
def test_a_course_of_measurements_says_how_far_it_is(tmp_path, noted, share):
    """Of 100 s foreseen 20 s are gone, and one of 40 s has noted its share; what takes longer than foreseen does not go
    beyond the whole.
    """
    told, turns = [], iter([False, True])
    made = course.MeasuringCourse(tmp_path, 100.0, lambda *arguments: told.append(arguments))
    made.gone = 20.0
    (tmp_path / "sweeps").mkdir()
    if noted is not None:
        (tmp_path / "sweeps" / "progress").write_text(noted)
    made._watch(tmp_path / "sweeps", 40.0, SimpleNamespace(is_set=lambda: next(turns), wait=lambda seconds: None))
    assert told == [(pytest.approx(share), "sweeps")]
