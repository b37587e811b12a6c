"""Slopes under an earthquake, from the section's key to the run's records: against Newmark's block, hard and soft,
stopped and resumed, mirrored, with water, and what is said of them.
"""

import json

import numpy as np
import pytest
import shell
import sliding_block
import yaml
from yade import O
from yade.nonsmooth import experiment, ground_motion, newmark, records, runs, section, similar, worlds
from yade.nonsmooth.measure import surface_slip
from yade.nonsmooth.studies.safety.asked import Asked, SafetyError
from yade.nonsmooth.studies.slope import results, run_files

FRICTION = 0.75  # on a plane of 30°, where tan is 0.577
SHAKING = {"synthetic": {"peak": 7.0, "duration": 4.0, "frequency": 2.0, "seed": 3, "vertical_peak": 1.0}, "begin": 0.5}
pytestmark = pytest.mark.usefixtures("empty")


def block(**values):
    """A block on a plane that only friction holds, shaken; see sliding_block."""
    made = sliding_block.data(friction=FRICTION, tension=0.0)
    made["materials"]["plane"]["bonded"] = False
    made["numerics"]["time_step"] = 2e-3
    return section.of(made | {"shaking": SHAKING} | values)


def run(made, folder, end=None, **how):
    course = experiment.begin(made, folder, **how)
    course.run(end, stands=True)
    return course


def of_newmark(made):
    return newmark.slide(
        newmark.Block(sliding_block.DIP, FRICTION, gravity=made.gravity, side=made.side), made.shaking.motion
    )


@pytest.fixture(scope="module")
def shaken(tmp_path_factory):
    """The block's section, series, and summary."""
    folder = tmp_path_factory.mktemp("shaken") / "run"
    made = block()
    course = run(made, folder)
    return made, folder, records.read_series(folder / "series.csv"), course.summarise()


def test_a_block_slips_as_newmarks(shaken):
    """Steps of 2 ms begin and end each of some ten slides a step late: 1 %."""
    made, _, series, summary = shaken
    exact = of_newmark(made)
    assert exact.permanent > 0.1 and summary["displacements_m"]["plane"] == pytest.approx(exact.permanent, rel=0.01)
    assert summary["displacements_m"] == json.loads((shaken[1] / "summary.json").read_text())["displacements_m"]


def test_each_row_has_the_slip_and_the_acceleration_of_its_time(shaken):
    made, folder, series, _ = shaken
    t0 = records.read_snapshot(folder / run_files.BEGIN).time_s
    since = series["time_s"] - t0 - made.shaking.begin
    exact = of_newmark(made)
    during = (since > 0) & (since < made.shaking.motion.duration)
    assert during.sum() > 20
    slip = series["displacement_m:plane"]
    assert np.abs(slip[during] - exact.at(since[during])).max() < 0.015 * exact.permanent
    assert np.abs(slip[since < -0.01]).max() < 1e-6
    h = 2e-3
    x, y = made.shaking.motion.mean_over(since[during] - h, since[during]).T
    assert series["ground_acceleration_x_m_per_s2"][during] == pytest.approx(x, abs=1e-6)
    assert series["ground_acceleration_y_m_per_s2"][during] == pytest.approx(y, abs=1e-6)
    for late in (since <= 0, since > made.shaking.motion.duration + h):
        assert not series["ground_acceleration_x_m_per_s2"][late].any()


def test_the_run_goes_on_until_the_record_is_over(shaken):
    """Though the block stands between two shocks, and before the first, for longer than the time of a rest."""
    made, folder, series, summary = shaken
    t0 = records.read_snapshot(folder / run_files.BEGIN).time_s
    assert summary["finished"] and series["time_s"][-1] > t0 + made.shaking.end


def test_the_energies_balance(shaken):
    """What the ground's shaking brings, in its frame, goes into sliding."""
    _, _, series, summary = shaken
    assert series["energy_water_J"][-1] > 0 and abs(series["energy_error_rel"][-1]) < 1e-3
    gained = {name: values[-1] - values[series["time_s"] <= 0.5][-1] for name, values in series.items()}
    lost = sum(gained[name] for name in records.LOSSES)
    assert lost == pytest.approx(gained["energy_water_J"] - gained["energy_potential_J"], rel=2e-3)


def test_the_summary_tells_of_the_record(shaken):
    made, _, _, summary = shaken
    told = summary["shaking"]
    assert told["peak_acceleration_m_per_s2"] == pytest.approx(7.0) and told["duration_s"] == pytest.approx(4.0)
    assert told["begin_s"] == 0.5 and "seed 3" in told["record"]
    numbers = results.numbers_of(made)
    assert all(f"shaking.{name}" in numbers for name in told if name != "record")
    assert "displacements_m.plane" in numbers
    assert told["drift_displacement_m"] == made.shaking.motion.drift.displacement[0]


def test_a_record_may_be_a_file(shaken, tmp_path):
    """The same motion from a CSV gives the same bits, and the run keeps it."""
    made, folder, _, _ = shaken
    ground_motion.write_csv(made.shaking.motion, tmp_path / "record.csv")
    again = block(shaking={"file": str(tmp_path / "record.csv"), "begin": 0.5})
    run(again, tmp_path / "run")
    assert (tmp_path / "run" / "series.csv").read_bytes() == (folder / "series.csv").read_bytes()
    (tmp_path / "record.csv").unlink()
    assert runs.open_run(tmp_path / "run").section.shaking == made.shaking


def test_stopped_and_resumed_amid_a_shock_it_has_the_same_bits(shaken, tmp_path):
    made, folder, series, _ = shaken
    t0 = records.read_snapshot(folder / run_files.BEGIN).time_s
    course = run(made, tmp_path / "run", end=t0 + 1.4)
    course.checkpoint()
    O.reset()
    again = experiment.resume(section.load(str(tmp_path / "run" / "section.yaml")), tmp_path / "run")
    again.run(stands=True)
    for name in ("series.csv", "walls.csv", "breaks.csv"):
        assert (tmp_path / "run" / name).read_bytes() == (folder / name).read_bytes()


def test_another_record_does_not_resume_it(shaken, tmp_path):
    course = run(block(), tmp_path / "run", end=0.5)
    course.checkpoint()
    O.reset()
    other = block(shaking={**SHAKING, "peak": 4.0})
    with pytest.raises(experiment.ExperimentError, match="belongs to other settings"):
        experiment.resume(other, tmp_path / "run")


def test_mirrored_it_slips_as_far(shaken, tmp_path):
    made, _, series, _ = shaken
    other = similar.mirrored(made)
    from yade.nonsmooth.studies.slope import slope_packing

    course = run(other, tmp_path / "run", packing=similar.mirrored_packing(slope_packing.of(made)))
    mirrored = records.read_series(tmp_path / "run" / "series.csv")
    assert course.state.stage == "done"
    assert mirrored["displacement_m:plane"] == pytest.approx(series["displacement_m:plane"], rel=1e-9, abs=1e-12)
    assert mirrored["ground_acceleration_x_m_per_s2"] == pytest.approx(-series["ground_acceleration_x_m_per_s2"])


def test_four_times_as_large_it_slips_four_times_as_far(shaken, tmp_path):
    made, _, _, summary = shaken
    run(similar.scaled(made, 4.0), tmp_path / "run")
    rows = records.read_series(tmp_path / "run" / "series.csv")
    assert rows["displacement_m:plane"][-1] == pytest.approx(4 * summary["displacements_m"]["plane"], rel=1e-9)


def test_soft_disks_shake_by_the_same_code(tmp_path):
    """Springs that give by 1e-3 of a diameter, and a damper at rest: within 5 % of Newmark's block."""
    made = block(shaking={**SHAKING, "synthetic": SHAKING["synthetic"] | {"duration": 2.0}})
    course = run(made, tmp_path / "run", world=worlds.Soft(stiffness=1e9, diameter=(0.6, 1.0), damping=0.05))
    slip = records.read_series(tmp_path / "run" / "series.csv")["displacement_m:plane"][-1]
    assert course.state.stage == "done" and slip == pytest.approx(of_newmark(made).permanent, rel=0.05)


def test_what_moves_while_it_shakes_has_failed_by_shaking(tmp_path):
    """A block that weakens and slides away; the water, which is below it, and its weight have no part in it."""
    made = block(shaking={**SHAKING, "peak": 8.0})
    weak = made.with_values(
        {
            ("materials", "plane", "slip_weakening"): {"law": "step", "critical_slip": 0.05, "friction": 0.3},
            "water": {"plane": "plane", "table": {"points": [[0, 0.01]]}},
        }
    )
    folder = tmp_path / "run"
    course = experiment.begin(weak, folder)
    course.run(3.5, stands=True)
    summary = course.summarise()
    assert summary["verdict"] == "failed by shaking" and summary["failed_dry_s"] is None
    assert "after the record began, whose largest acceleration is 8 m/s²" in summary["verdict_says"]
    assert summary["times_s"]["t2"] is not None
    assert "a script" not in summary["verdict_says"] and course.state.outside == 0.0


def test_slip_surfaces_are_found_again_after_a_resume(shaken, tmp_path):
    made, folder, _, _ = shaken
    begin = records.read_snapshot(folder / run_files.BEGIN)
    (found,) = surface_slip.surfaces(made, begin)
    assert found.above.tolist() == [4, 13]  # the others of the lowest row hang on these


def test_the_script_that_compares_peaks(tmp_path):
    """Of a small slope that stands at 1 m/s² and is carried off at 30, dry, with water, and by rising water alone."""
    motion = {"peak": 1.0, "duration": 3.0, "frequency": 1.0}
    water = shell.ROOT / "tests" / "data" / "small_slope.yaml"
    dry = {"base": str(water), "water": None, "shaking": {"synthetic": motion}}
    wet = {"base": str(water), "water": {"table": {"rate": None, "points": [[0, 0.2]]}}, "shaking": dry["shaking"]}
    for name, content in (("dry", dry), ("wet", wet)):
        (tmp_path / f"{name}.yaml").write_text(yaml.safe_dump(content))
    done = shell.example(
        "shaken_slopes.py",
        tmp_path,
        dry=f"'{tmp_path}/dry.yaml'",
        wet=f"'{tmp_path}/wet.yaml'",
        water=f"'{water}'",
        disks=150,
        dry_peaks="[1,30]",
        wet_peaks="[30]",
        seeds=2,
        folder=f"'{tmp_path}/out'",
    )
    assert done.returncode == 0, done.stderr
    told = json.loads((tmp_path / "out" / "shaken.json").read_text())
    counts = {name: (one["stood"], one["failed"]) for name, one in told.items()}
    assert counts == {"dry_1": (2, 0), "dry_30": (0, 2), "wet_30": (0, 2), "water": (0, 2)}
    for seed in (1, 2):
        end = json.loads((tmp_path / "out" / "dry" / "runs" / f"peak=30_seed={seed}" / "summary.json").read_text())
        numbers = told["dry_30"]["when_failed"]
        assert numbers["slip_m"]["values"][seed - 1] == end["displacements_m"]["DP"]
        moved = end["times_s"]["t2"] - end["times_s"]["t0"] - end["shaking"]["begin_s"]
        assert numbers["moves_s"]["values"][seed - 1] == pytest.approx(moved) and moved > 0
        assert f"after it began, front {numbers['front_travel_m']['mean']:.0f}" in done.stdout
    for name in ("shaken", "shaken_runouts"):
        assert (tmp_path / "out" / f"{name}.png").stat().st_size > 1000


def test_a_search_for_the_factor_of_safety_does_not_shake():
    with pytest.raises(SafetyError, match="shaking: a search does not shake the slope; leave `shaking` out"):
        Asked(block())
