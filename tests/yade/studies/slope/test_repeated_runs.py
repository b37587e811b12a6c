"""Experiment.run() called several times: it goes on, and an end without sense is refused before anything is touched."""

import math

import pytest
from slope_scenes import SMALL
from yade import O
from yade.nonsmooth import experiment, packing, records, section, worlds
from yade.nonsmooth.errors import UserError
from yade.wrapper import CourseRunner

pytestmark = pytest.mark.usefixtures("empty")
RECORDS = ("series.csv", "walls.csv")


def begun(folder):
    O.reset()
    return experiment.begin(section.load(str(SMALL)), folder)


def bytes_of(folder):
    return [(folder / name).read_bytes() for name in RECORDS]


@pytest.fixture
def in_one(tmp_path):
    """The bytes of a run of 0.3 s in one call."""
    begun(tmp_path / "one").run(0.3)
    return bytes_of(tmp_path / "one")


def test_a_run_in_three_calls_has_the_bits_of_one(in_one, tmp_path):
    run = begun(tmp_path / "three")
    for end in (0.1, 0.2, 0.3):
        run.run(end)
        assert end - 0.5 * O.dt <= O.time < end + run.scales.row_seconds + O.dt  # a row at most beyond it
        # the records of each part are whole when it ends
        assert records.read_series(tmp_path / "three" / "series.csv")["time_s"][-1] == pytest.approx(O.time, abs=1e-12)
    assert bytes_of(tmp_path / "three") == in_one


@pytest.mark.parametrize("end", [0, -1.0, 0.1, math.nan, math.inf, "x", [0.3], True])
def test_an_end_without_sense_is_refused_and_the_run_goes_on_with_another(end, in_one, tmp_path):
    folder = tmp_path / "out"
    run = begun(folder)
    with pytest.raises(ValueError, match="^end 0: the run is at"):
        run.run(0)  # as the first call
    run.run(0.1)
    step, before = O.iter, bytes_of(folder)
    with pytest.raises(
        ValueError, match="^end .*: the run is at 0.1.* s of simulated time; give a later time"
    ) as refusal:
        run.run(end)
    assert isinstance(refusal.value, UserError) and "\n" not in str(refusal.value)  # one line, no traceback
    assert (O.iter, bytes_of(folder)) == (step, before)
    run.run(0.3)
    assert bytes_of(folder) == in_one


def test_a_run_goes_on_after_a_step_that_was_refused(in_one, tmp_path):
    run = begun(tmp_path / "out")
    run.run(0.1)
    tolerance, run.slope.solver.tolerance = run.slope.solver.tolerance, -1.0
    with pytest.raises(UserError, match="tolerance"):
        run.run(0.3)
    run.slope.solver.tolerance = tolerance
    run.run(0.3)
    assert bytes_of(tmp_path / "out") == in_one


def test_a_run_goes_on_by_the_engine_and_back(in_one, tmp_path):
    run = begun(tmp_path / "out")
    run.run(0.1)
    run.attach()
    while O.time < 0.2 - 0.5 * O.dt:  # a row is due, which the engine would write as the next step begins
        O.step()
    run.run(0.3)
    assert not any(isinstance(e, CourseRunner) for e in O.engines)
    assert bytes_of(tmp_path / "out") == in_one


def test_time_between_two_calls_is_not_the_runs(tmp_path, monkeypatch):
    clock = [0.0]
    monkeypatch.setattr(experiment.time, "monotonic", lambda: clock[0])
    run = begun(tmp_path / "out")
    run.run(0.05)
    clock[0] = 1e6
    run.run(0.1)
    assert run.state.wall_s == 0.0  # a clock that stands while it runs


def test_records_that_were_changed_between_two_calls_are_not_written_to(tmp_path):
    run = begun(tmp_path / "out")
    run.run(0.1)
    path = tmp_path / "out" / "series.csv"
    path.write_text(path.read_text().replace("step", "stop"))
    before = path.read_bytes()
    with pytest.raises(records.RecordsError, match="series.csv: .*has been changed since"):
        run.run(0.2)
    assert path.read_bytes() == before


def test_a_run_that_is_killed_after_its_last_checkpoint_has_nothing_left_to_do(tmp_path):
    """What a command or a campaign does with its end when it resumes such a run: no refusal."""
    chosen = section.load(str(SMALL))
    begun(tmp_path / "out").run(0.1)
    O.reset()
    again = experiment.resume(chosen, tmp_path / "out")
    assert again.reached(0.1) and not again.reached(0.2) and not again.reached()


def test_what_a_script_writes_before_it_runs_the_experiment_acts(tmp_path):
    """A disk thrown upwards before the first call rises; in 0.1 s gravity, which grows, takes less than 1 m/s of its
    30.
    """
    run = begun(tmp_path / "out")
    top = max((b for b in O.bodies if b.dynamic), key=lambda b: b.state.pos[1])
    begins = top.state.pos[1]
    top.state.vel = (0, 30, 0)
    run.run(0.1)
    assert O.bodies[top.id].state.pos[1] - begins > 2.0


def test_a_soft_run_begins_with_a_packing_of_ones_own_and_rows_of_the_rigid_one(tmp_path):
    """Every second disk of a packing; each step divides a row of the rigid run, and the slope keeps its damping."""
    chosen = section.load(str(SMALL))
    whole = packing.cached_pack(chosen)
    half = packing.Packing(*(getattr(whole, name)[::2] for name in ("x", "y", "r", "layer")))
    soft = worlds.Soft(2e7, (0.5, 1.0))
    O.reset()
    run = experiment.begin(chosen, tmp_path / "soft", packing=half, world=soft, damping_moving=0.03)
    rows = run.scales.row_seconds / O.dt
    assert rows == pytest.approx(round(rows), abs=1e-9) and O.dt <= soft.step_for(
        [chosen.materials[layer.material] for layer in chosen.layers]
    )
    assert run.slope.count == len(half) and not run.hard and run.damping == (soft.damping, 0.03)
    with pytest.raises(worlds.WorldError, match="hard contacts have no damping"):
        experiment.begin(chosen, tmp_path / "hard", damping_moving=0.03)
    assert not (tmp_path / "hard").exists()  # nothing was made


def test_each_scene_knows_its_own_course(tmp_path):
    """A run that another one followed in this process does not take its rows."""
    first = begun(tmp_path / "first")
    first.attach()
    second = begun(tmp_path / "second")
    runner = second.attach()
    while O.time < 0.2 + 0.5 * O.dt:
        O.step()
    second.checkpoint()
    rows = len(records.read_series(tmp_path / "second" / "series.csv")["step"])
    assert runner.course is second and rows == round(0.2 / second.scales.row_seconds) > 1
    first.checkpoint()
    assert len(records.read_series(tmp_path / "first" / "series.csv")["step"]) == 0
