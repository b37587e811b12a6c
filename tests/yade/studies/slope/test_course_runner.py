"""A slope's course by the CourseRunner: O.run(), O.step() and yade-batch make the same rows as the script."""
import sys

import pytest
import shell
from contact_scenes import begin, floor, free_disk, material
from slope_scenes import SMALL
from yade import O
from yade.nonsmooth import experiment, section
from yade.nonsmooth.course import driver
from yade.nonsmooth.world.stepping import advance
from yade.wrapper import CourseRunner, PyRunner

pytestmark = pytest.mark.usefixtures("empty")

RECORDS = ("series.csv", "walls.csv", "breaks.csv", "t0.npz", "end.npz")


def bytes_of(folder):
    return {name: (folder / name).read_bytes() for name in RECORDS} | {
        p.name: p.read_bytes() for p in (folder / "snapshots").iterdir()
    }


def run_to_the_end(run, limit=50):
    for _ in range(limit):
        if run.state.stage == "done":
            return
        O.run(wait=True)
    raise AssertionError(f"not done after {limit} runs, at {O.time} s")


def test_o_run_goes_through_the_course_with_the_bits_of_the_script(whole, tmp_path):
    run = experiment.begin(section.load(str(SMALL)), tmp_path)
    runner = run.attach()
    assert isinstance(O.engines[0], CourseRunner) and not runner.dead
    run_to_the_end(run)
    assert runner.dead and bytes_of(tmp_path) == bytes_of(whole.folder)
    steps = O.iter
    O.run(3, wait=True)  # may go on, and writes no more
    assert O.iter == steps + 3 and bytes_of(tmp_path) == bytes_of(whole.folder)


def test_steps_of_any_kind_may_follow_each_other(whole, tmp_path):
    """O.step(), O.run(n), advance(), and others that look between them."""
    run = experiment.begin(section.load(str(SMALL)), tmp_path)
    run.attach()
    seen = []
    O.engines = O.engines + [PyRunner(command="seen.append(O.iter)", iterPeriod=37)]
    sys.modules["__main__"].__dict__["seen"] = seen
    for _ in range(30):
        O.step()
    O.run(200, wait=True)
    advance(150)
    O.step()
    run_to_the_end(run)
    assert len(seen) > 20 and bytes_of(tmp_path) == bytes_of(whole.folder)


def test_a_run_by_engine_is_resumed_by_either(whole, tmp_path):
    chosen = section.load(str(SMALL))
    for k, go_on in enumerate((lambda run: (run.attach(), run_to_the_end(run)), lambda run: run.run())):
        O.reset()
        out = tmp_path / str(k)
        run = experiment.begin(chosen, out)
        run.attach()
        driver.CHECKPOINT_SECONDS, before = 0.0, driver.CHECKPOINT_SECONDS  # after each row, by the engine
        driver.CHECKPOINT_SHARE, share = 1e9, driver.CHECKPOINT_SHARE
        try:
            O.run(400, wait=True)
        finally:
            driver.CHECKPOINT_SECONDS, driver.CHECKPOINT_SHARE = before, share
        assert run.state.stage != "done"
        run._close()
        O.reset()
        go_on(experiment.resume(chosen, out))
        assert bytes_of(out) == bytes_of(whole.folder)
        assert sum(isinstance(e, CourseRunner) for e in O.engines) == 1 - k


def test_a_command_sees_the_scene_between_two_steps():
    """Bodies as after the step before, also where nobody else looks: those that O.step() shows."""

    def scene_of():
        O.reset()
        stuff = material(0.4)
        floor(stuff)
        free_disk(0, 3, (0.5, 0, 0), stuff)
        begin(dt=1e-3)

    seen = sys.modules["__main__"].__dict__["seen"] = []
    scene_of()
    O.engines = [
        CourseRunner(
            label="looker",
            command="seen.append((O.iter, O.time, O.bodies[1].state.pos[1])); looker.nextTime += 0.01",
            nextTime=0.1,
        ),
        *O.engines,
    ]
    advance(200)
    scene_of()
    known = {}
    for _ in range(200):
        known[O.iter] = (O.iter, O.time, O.bodies[1].state.pos[1])
        O.step()
    assert [look[0] for look in seen] == list(range(100, 200, 10)) and seen == [known[look[0]] for look in seen]


def test_what_a_row_raises_ends_the_run(tmp_path, monkeypatch):
    run = experiment.begin(section.load(str(SMALL)), tmp_path)
    run.attach()

    def refuse(*_):
        raise experiment.ExperimentError("the disk is full of birds")

    monkeypatch.setattr(run, "_look", refuse)
    with pytest.raises(RuntimeError, match="full of birds"):
        for _ in range(50):
            O.step()
    assert run.state.stage == "settle"


def test_a_scene_loaded_by_itself_says_what_to_do(tmp_path):
    run = experiment.begin(section.load(str(SMALL)), tmp_path / "out")
    run.attach()
    O.run(5, wait=True)
    O.save(str(tmp_path / "scene.yade.gz"))
    O.load(str(tmp_path / "scene.yade.gz"))
    with pytest.raises(RuntimeError, match=r"experiment.resume\(section, folder\).attach"):
        for _ in range(50):
            O.step()


def test_a_runner_that_is_not_the_first_is_refused():
    with pytest.raises(RuntimeError, match="not the first of O.engines"):
        CourseRunner(command="pass")()  # by hand, in a new scene, which has no engines
    O.engines = [PyRunner(command="pass", iterPeriod=1), CourseRunner(command="pass")]
    with pytest.raises(RuntimeError, match="not the first of O.engines"):
        O.step()


BATCH = """\
import dataclasses
from yade import O, utils
from yade.nonsmooth import experiment, section
utils.readParamsFromTable(seed=3, noTableOk=True)
from yade.params import table
run = experiment.begin(dataclasses.replace(section.load({source!r}), seed=table.seed), {out!r} + str(table.seed))
run.attach()
O.run()
utils.waitIfBatch()
"""


def test_yade_batch_drives_a_slope(whole, tmp_path):
    script, table = tmp_path / "slope.py", tmp_path / "slope.table"
    script.write_text(BATCH.format(source=str(SMALL), out=str(tmp_path / "out-")))
    table.write_text("seed\n3\n")
    done = shell.batch(table, script, tmp_path, "slope.@.log")
    assert done.returncode == 0, done.stdout + done.stderr
    assert bytes_of(tmp_path / "out-3") == bytes_of(whole.folder)
