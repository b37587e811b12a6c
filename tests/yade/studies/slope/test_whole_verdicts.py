"""Small slopes that stand, collapse before the water, are shaken by a script, or run on soft contacts: what is said of
them, and when they end.
"""

import dataclasses
import warnings
from types import SimpleNamespace

import numpy as np
import pytest
from slope_scenes import SMALL, write_changed
from yade import O
from yade.minieigenHP import Vector3
from yade.nonsmooth import course, experiment, records, section, similar, worlds
from yade.nonsmooth.studies.slope import slope_packing
from yade.wrapper import PyRunner

pytestmark = pytest.mark.usefixtures("empty")


def made(folder, mirrored=False, size=1.0, **changes):
    """The small slope with parts of its data changed, by their keys."""

    def change(data):
        for key, value in changes.items():
            if key in ("materials",):
                for name, more in value.items():
                    data[key][name] |= more
            else:
                data[key] = value

    found = section.load(str(write_changed(folder, change)))
    found = similar.mirrored(found) if mirrored else found
    return found if size == 1.0 else similar.scaled(found, size)


STRONG = {
    "rock": {"tensile_strength": 1e7, "friction": 0.9, "residual_friction": 0.9},
    "fb": {"tensile_strength": 1e7},
    "dp": {"friction": 3.0},
}
#: it slides as soon as gravity has grown
WEAK = {"rock": {"tensile_strength": 1e3}, "fb": {"tensile_strength": 100.0}, "dp": {"friction": 0.1}}


def begun(chosen, folder):
    return experiment.begin(chosen, folder)


def told(run):
    """Its summary, without a warning of numpy's."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return run.summarise(1)


def wet(rate, plane="DP", **more):
    water = {"plane": plane, "volume": "bulk", "table": {"rate": rate} if rate else {"points": [[0.0, 0.0]]}}
    return {"water": water | more, "materials": STRONG}


@pytest.mark.parametrize("mirrored, size", [(False, 1.0), (True, 1.0), (False, 0.25)])
def test_a_slope_that_stands_ends_where_nothing_more_can_come(mirrored, size, tmp_path):
    chosen = made(tmp_path, mirrored, size, **wet(4.0))
    run = begun(chosen, tmp_path)
    run.run()
    summary, series = told(run), records.read_series(tmp_path / "series.csv")
    assert summary["verdict"] == "stood" and summary["finished"] and "disks wet (100 %)" in summary["verdict_says"]
    # the highest disks' centres are some 5 m above the plane, and the table rises by 4 m/s; then it is still for 1.06 s
    # and 0.3 s
    span = (series["time_s"][-1] - summary["times_s"]["t0"]) / np.sqrt(size)
    assert 2.2 < span < 5.0 < chosen.stages.end.time / np.sqrt(size) == pytest.approx(30.0)
    assert summary["water_highest_m"] > 5.0 * size and (series["wet_disks"][-2:] == summary["disks"]).all()
    assert summary["water_at_failure_m"] is None and summary["failed_dry_s"] is None
    assert summary["times_missing"] == dict.fromkeys(("t1", "t2", "t3", "t4", "t5"), "the slope did not move off")
    assert (tmp_path / "end.npz").exists()


@pytest.mark.parametrize("kind", ["no water", "table at 0"])
def test_a_dry_slope_that_stands_ends_soon(kind, tmp_path):
    chosen = made(tmp_path, **wet(0.0))
    if kind == "no water":
        chosen = dataclasses.replace(chosen, water=None)
    run = begun(chosen, tmp_path)
    run.run()
    summary = told(run)
    assert summary["verdict"] == "stood" and O.time < 3.0  # t0 at 0.5 s at the earliest, and 1.36 s of rest
    assert ("without water" if kind == "no water" else ", dry") in summary["verdict_says"]


def test_a_run_waits_for_what_a_script_may_do(tmp_path):
    """With an end, with engines of a script, and attached; ``stands`` overrules."""
    for k, (end, engines, stands, waits) in enumerate(
        [
            (3.0, [], None, True),
            (3.0, [], True, False),
            (None, [PyRunner(command="pass", iterPeriod=10**9)], None, True),
            (None, [], None, False),
        ]
    ):
        chosen = made(tmp_path, **wet(0.0))
        chosen = dataclasses.replace(
            chosen, stages=dataclasses.replace(chosen.stages, end=dataclasses.replace(chosen.stages.end, time=4.0))
        )
        O.reset()
        run = begun(chosen, tmp_path / str(k))
        O.engines = O.engines + engines
        run.run(end, stands=stands)
        ended = 3.0 if end else run.state.settled + 4.0
        assert (O.time == pytest.approx(ended, abs=0.021)) == waits and (O.time < 2.8) != waits, k  # a row
    run = begun(chosen, tmp_path / "attached")
    run.attach()
    O.run(500, True)  # 2.5 s, long after it would have ended
    assert run.state.stage == "water" and run.state.quiet_since < O.time - 1.5


def test_a_slope_that_collapses_slowly_has_not_failed_by_water(tmp_path):
    """No speed counts here, only its way: of its centre of mass, in the root of its area."""
    chosen = made(tmp_path, materials=WEAK)
    packed = slope_packing.of(chosen)
    run = begun(chosen, tmp_path)
    run.scales = dataclasses.replace(run.scales, going_speed=1e9, moving_speed=1e9)
    run.run(6.0)
    series, size = records.read_series(tmp_path / "series.csv"), np.sqrt(chosen.area)
    way = np.abs(series["centroid_x_m"] - np.average(packed.x, weights=packed.r**2)) / size
    assert way[0] < 1e-3  # as it was packed
    first = series["time_s"][way >= course.COLLAPSED][0]
    assert run.state.failed_dry == first and not (series["water_m"] > 0).any()
    assert told(run)["verdict"] == "failed dry"


# what a script does in the dry rest, and once the table stands at 0
@pytest.mark.parametrize("when, water", [(0.4, True), (1.5, True), (1.5, False)])
def test_a_slope_that_a_script_shook_has_not_failed_dry(when, water, tmp_path):
    chosen = made(tmp_path, **wet(0.0))
    chosen = chosen if water else dataclasses.replace(chosen, water=None)
    begun(chosen, tmp_path).run(when)
    run = experiment.resume(chosen, tmp_path)
    assert run.state.outside == 0.0 and run.state.rested is not None  # to the last bit, until then
    for k in range(run.slope.count):
        O.bodies[run.slope.first_disk + k].state.vel = Vector3(4.0 * chosen.side, 2.0, 0)
    run.run(when + 2.0)
    summary = told(run)
    assert (
        summary["verdict"] == "moved dry" and summary["failed_dry_s"] is None and "a script" in summary["verdict_says"]
    )
    assert summary["moved_dry_s"] == pytest.approx(when, abs=0.041)  # within two rows
    # half the mass by the square of the speed: a slice of 1 m of 12 m by 12 m at 2,500 kg/m³ and 4.5 m/s
    assert run.state.outside == pytest.approx(0.5 * 2500 * 0.82 * chosen.area * 20, rel=0.1)  # of the packing's density
    assert summary["water_at_failure_m"] is None


def test_a_resumed_run_ends_where_it_would_have(tmp_path):
    chosen = made(tmp_path, **wet(4.0))
    begun(chosen, tmp_path / "whole").run()
    O.reset()
    begun(chosen, tmp_path / "halved").run(1.2)
    run = experiment.resume(chosen, tmp_path / "halved")
    run.run()
    assert told(run)["verdict"] == "stood"
    for name in ("series.csv", "walls.csv", "end.npz"):
        assert (tmp_path / "halved" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes(), name


def test_a_run_that_is_stopped_while_it_settles_has_a_verdict_too(tmp_path, in_process):
    """In a sweep, and by the command; one that has failed by then says so."""
    run = begun(made(tmp_path, **wet(4.0)), tmp_path / "sweep")
    run.run(0.1)
    summary = told(run)
    assert summary["verdict"] == "not over" and summary["verdict_says"].endswith("while the slope settled")
    assert summary["simulated_s"] == pytest.approx(0.1, abs=1e-9)
    run.state = dataclasses.replace(run.state, failed_dry=0.06)
    assert told(run)["verdict"] == "failed dry"
    source = write_changed(tmp_path, lambda data: None)
    done = in_process("slope.py", "--section", source, "--end", 0.1, "--out", tmp_path / "out", "--no-figures")
    assert done.status == 0 and "The run was stopped at 0.1 s, while the slope settled." in done.out
    assert "go on with --resume" in done.out


def test_soft_contacts_have_a_verdict_too(tmp_path):
    """Of its settling, and of what follows: softer and slower, so that its stages are short here."""
    chosen = made(tmp_path, **wet(0.0))
    world = worlds.Soft(1e7, (chosen.disks.d_min, chosen.disks.d_max), verlet=-chosen.numerics.verlet_distance)
    run = experiment.begin(chosen, tmp_path, world=world)
    run.run(0.1)
    assert run.state.outside is None  # nobody counts it
    run.state = dataclasses.replace(run.state, stage="done", settled=0.05, t0=0.06, quiet_since=0.06)
    summary = told(run)
    assert summary["verdict"] in ("stood", "not at rest") and summary["energy_losses_J_per_m"] is None
    run.state = dataclasses.replace(run.state, failed_dry=0.08, moving=0.08, rested=0.06)
    assert told(run)["verdict"] == "moved dry"  # or its weight: nobody knows


@pytest.mark.parametrize(
    "kind, t4, told",
    [("stood", None, False), ("not over", None, False), ("slid", None, True), ("failed by water", 9.0, True)],
)
def test_an_error_of_energy_is_told_of_a_slope_that_moved(kind, t4, told):
    """Beside the little that a slope at rest turns over, any error is large: that of one that was stopped before it
    moved was told as 54.
    """
    from yade.nonsmooth.studies.slope import slope_command

    line = slope_command.number_line(
        "energy_error_rel", {"energy_error_rel": 54.2, "verdict": kind, "times_s": {"t4": t4}}
    )
    assert line.split()[1] == ("54.2" if told else "-")


@pytest.mark.parametrize("terminal, told", [(False, [1.0, 4.0]), (True, [1.0, 2.0, 3.0, 4.0])])
def test_progress_is_a_line_each_five_seconds_in_a_file_and_moves_on_a_terminal(monkeypatch, terminal, told):
    """Four calls, 2 s of the clock from one to the next; a run that goes on for longer than foreseen has no more than
    all behind it.
    """
    from yade.nonsmooth.studies.slope import slope_command

    bar, seen, now = slope_command.Bar(), [], [100.0]
    monkeypatch.setattr(bar.bar, "refresh", lambda: seen.append(bar.bar.n))
    monkeypatch.setattr(slope_command.sys, "stderr", SimpleNamespace(isatty=lambda: terminal))
    monkeypatch.setattr(slope_command.time, "monotonic", lambda: now[0])
    for k in range(1, 5):
        bar("settle", float(k), 3.5)
        assert bar.bar.total == max(3.5, k) and bar.bar.desc == "settle  "
        now[0] += 2.0
    assert seen == told
