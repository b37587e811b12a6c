"""When triggers begin, act and are over, and what a slope's course makes of it. Needs no YADE."""

import dataclasses
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import synthetic_slope as synthetic  # noqa: E402

course, triggers, shaking, scales, section = (
    synthetic.load(name)
    for name in ("course", "course.triggers", "course.triggers.shaking", "model.scales", "model.section")
)
DRY = section.load("jiufengershan_shaken")  # 30 s from 1 s after t0 on
T0, BEGIN, END = 7.0, 8.0, 38.0
REST = 1e-4  # m/s


def test_a_slope_without_triggers_has_none():
    other = section.load("circle")
    assert shaking.lasts(other) == 0 and not shaking.began(other, T0, 1e9)
    for time in (T0, 1e9):
        seen = course.Seen(time, 0.01, REST)
        assert triggers.over(state(), seen, other) and not triggers.acting(state(), seen, other)


def test_times_count_from_t0():
    assert shaking.lasts(DRY) == 31.0
    for time, began, acting, over in (
        (T0, False, False, False),
        (BEGIN, False, False, False),
        (BEGIN + 0.1, True, True, False),
        (END - 0.1, True, True, False),
        (END, True, False, True),
        (END + 9, True, False, True),
    ):
        seen = course.Seen(time, 0.01, REST)
        told = (shaking.began(DRY, T0, time), triggers.acting(state(), seen, DRY), triggers.over(state(), seen, DRY))
        assert told == (began, acting, over), time
        assert shaking.shakes(DRY, T0, time) is acting


def test_nothing_begins_before_t0_nor_on_a_slope_that_failed_before():
    assert shaking.since(None, None) is None and shaking.since(7.0, 3.0) is None and shaking.since(7.0, 7.0) is None
    assert shaking.since(7.0, None) == 7.0 and shaking.since(7.0, 9.0) == 7.0  # one that failed later
    assert not shaking.began(DRY, None, 50.0)
    for before in (state(t0=None), state(failed_dry=3.0)):
        seen = course.Seen(BEGIN + 1, 0.01, REST)
        assert triggers.over(before, seen, DRY) and not triggers.acting(before, seen, DRY)


def test_each_kind_answers_the_same_questions():
    for kind in triggers.KINDS:
        assert {"over", "acting"} <= set(kind.__all__)


def state(**values):
    at = dict(stage="water", settled=4.0, t0=T0, rested=4.0, stood=True, table_since=4.0)
    return course.State(**at | values)


def after(given, time, speed=REST, more=False):
    """The State after a row that sees a slope of this speed."""
    at = scales.of(DRY)
    seen = course.Seen(time, 0.01, speed, None, more=more)
    return course.after(course.noted(given, seen, at), seen, DRY, at)


@pytest.mark.parametrize("time, quiet", [(T0 + 0.5, False), (20.0, False), (END - 0.2, False), (END, True)])
def test_a_slope_is_not_quiet_while_something_is_to_come(time, quiet):
    """However still it stands between two shocks, and before the first."""
    assert (after(state(), time).quiet_since == time) is quiet


def test_a_run_waits_for_the_records_end():
    """A slope that moved and rests again, before the record is over and after it: as long as it takes, and 5 s more."""
    moved = state(moving=12.0, speed_max=3.0, resting_since=14.0)
    assert after(moved, 30.0).stage == "water"
    assert after(moved, END - 0.1).stage == "water" and after(moved, END).stage == "done"
    late = dataclasses.replace(moved, resting_since=END - 1)
    assert after(late, END + 3.9).stage == "water" and after(late, END + 4.1).stage == "done"


def test_the_longest_time_ends_it_all_the_same():
    last = 4.0 + DRY.stages.end.time
    assert after(state(), last).stage == "done"


def test_contacts_are_computed_tightly_while_the_ground_shakes_and_no_tighter():
    at = scales.of(DRY)
    still = {
        time: course.care(state(), course.Seen(time, 0.01, REST), DRY, at)[1] for time in (T0 + 0.5, 20.0, END, 60.0)
    }
    # the table has stood since 4 s, which counts from 9 s on
    assert still == {T0 + 0.5: False, 20.0: False, END: True, 60.0: True}


def test_the_bar_foresees_the_record():
    assert course.foreseen(state(), 10.0, DRY) == 4.0 + DRY.stages.dry + 31.0 + 55.0
    late = dataclasses.replace(DRY, shaking=dataclasses.replace(DRY.shaking, begin=60.0))
    assert course.foreseen(state(moving=10.0), 10.0, late) == T0 + 90.0
    assert course.foreseen(state(moving=10.0), 10.0, DRY) == 10.0 + 55.0  # an avalanche that goes on after it
