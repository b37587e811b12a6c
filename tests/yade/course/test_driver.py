"""The driver of every course, by a made-up one: in which order it asks, when it writes checkpoints, and what Ctrl-C and
errors leave.
"""
import os
import signal
from types import SimpleNamespace

import pytest
from yade.nonsmooth.course import driver
from yade.nonsmooth.running import interrupts

pytestmark = pytest.mark.usefixtures("empty")


class MadeUp(driver.Course):
    """Four rows, which note what is asked of them; ``during``: called in the steps of each, with its number."""

    def __init__(self, during=lambda row: None):
        self.told, self.row, self.during = [], 0, during
        super().__init__(File(self.told))

    def _over(self):
        return self.row == 4

    def _steps(self):
        self.during(self.row + 1)
        self.row += 1
        return 10 * self.row

    def _look(self, made):
        self.told.append(made)

    def _save(self):
        self.told.append("save")

    def _finish(self):
        self.told.append("finish")

    def _where(self):
        return f"at row {self.row}"


class File:
    """Stands for a SeriesWriter."""

    closed = False

    def __init__(self, told):
        self.sync, self.reopen, self.close = (
            lambda word=word: told.append(word) for word in ("sync", "reopen", "close")
        )


def interrupt_at(row):
    return lambda now: os.kill(os.getpid(), signal.SIGINT) if now == row else None


@pytest.fixture
def heard():
    """Ctrl-C is heard, also in tests that run in the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_rows_follow_their_steps_to_the_end():
    course = MadeUp()
    driver.drive(course)
    assert course.told == ["reopen", 10, 20, 30, 40, "finish", "close"]
    assert course.spent["wall_steps_s"] > 0


def test_ctrl_c_ends_it_after_the_row_with_a_checkpoint_and_it_goes_on(heard):
    course = MadeUp(interrupt_at(2))
    with pytest.raises(interrupts.Interrupted) as stopped:
        driver.drive(course)
    assert str(stopped.value) == "at row 2; the checkpoint is written, go on with --resume"
    # rows are on the disk before the checkpoint that counts on them
    assert course.told == ["reopen", 10, 20, "sync", "save", "close"]
    course.told.clear()
    driver.drive(course)
    assert course.told == ["reopen", 30, 40, "finish", "close"]


def test_what_has_no_checkpoint_says_so(heard):
    course = MadeUp(interrupt_at(3))
    course.unsaved = "a made-up course"
    with pytest.raises(interrupts.Interrupted, match="^at row 3; a made-up course has no checkpoint, run it again$"):
        driver.drive(course)


def test_it_goes_on_after_an_error():
    """Steps that an engine refuses belong to no row."""
    refused = iter([ValueError("no")])

    def refuse(row):
        if row == 2:
            for error in refused:
                raise error

    course = MadeUp(refuse)
    with pytest.raises(ValueError, match="no"):
        driver.drive(course)
    driver.drive(course)
    assert course.told == ["reopen", 10, "reopen", 20, 30, 40, "finish", "close"]


@pytest.mark.parametrize("saving, rows", [(0.0, [2, 4]), (3.0, [2])])
def test_checkpoints_come_by_wall_time_and_take_a_fiftieth_of_it(saving, rows, monkeypatch):
    """Rows of 50 s, a checkpoint every 90 s: after two rows, and after two more unless writing the first took 3 s,
    which wants 150 s.
    """
    clock = SimpleNamespace(now=0.0)
    monkeypatch.setattr(driver.time, "monotonic", lambda: clock.now)

    def pass_time(row):
        clock.now += 50.0

    course = MadeUp(pass_time)
    saved = []

    def save():
        saved.append(course.row)
        clock.now += saving

    course._save = save
    driver.drive(course)
    assert saved == rows
