"""When windows take disks out of a slope, by made-up histories of mean speeds. Needs no YADE."""

import dataclasses
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import synthetic_slope as synthetic  # noqa: E402
from test_course import STEP, steps  # noqa: E402

course, erosion, scales, section = (
    synthetic.load(name) for name in ("course", "course.triggers.erosion", "model.scales", "model.section")
)
SHIPPED = section.load("jiufengershan")
SQUARE = ((0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0))
T0 = 1.5  # s, of these histories: settled at 1 s, half a second dry


def cut(name="cut", begin=1.0, end=None, **keys):
    return section.Window(name, SQUARE, begin, begin if end is None else end, **keys)


def play(speed, *windows, until=30.0, end=80.0):
    """[(time since t0, {window: its time})] of the rows at which windows are due, and the last State."""
    stages = section.Stages(section.Settle(1.0, 3.0, 5e-3), 0.5, "motion", section.End(end, 0.02, 5.0))
    s = dataclasses.replace(SHIPPED, stages=stages, water=None, erosion=windows)
    at, state, time, found = scales.of(s), course.State(), 0.0, []
    while state.stage != "done" and time < until:
        time = course.next_row(time, STEP, at.row_seconds) * at.row_seconds
        seen = course.Seen(time, STEP, speed(time), more=False)
        before = state
        state = course.after(course.noted(state, seen, at), seen, s, at)
        due = erosion.due(before, state, s)
        if due:
            found.append((round(time - T0, 6), {w.name: round(t, 6) for w, t in due}))
    return found, state


def times(found, name="cut"):
    return [told[name] for _, told in found if name in told]


def test_a_window_that_takes_once_does_so_at_the_first_row_at_its_begin_or_after_it():
    assert play(steps(), cut())[0] == [(1.0, {"cut": 1.0})]
    assert play(steps(), cut(begin=1.004))[0] == [(1.0, {"cut": 1.0})]  # to half a step
    assert play(steps(), cut(begin=1.006))[0] == [(1.1, {"cut": 1.1})]
    assert play(steps(), cut(begin=0.0))[0] == [(0.0, {"cut": 0.0})]  # and at t0 itself


def test_one_with_an_end_takes_at_every_row_up_to_the_first_at_its_end_or_after_it():
    assert times(play(steps(), cut(end=1.3))[0]) == [1.0, 1.1, 1.2, 1.3]
    assert times(play(steps(), cut(end=1.31))[0]) == [1.0, 1.1, 1.2, 1.3, 1.4]
    assert times(play(steps(), cut(end=1.304))[0]) == [1.0, 1.1, 1.2, 1.3]


def test_windows_have_times_of_their_own():
    found = play(steps(), cut("a", 1.0, 1.2), cut("b", 1.1))[0]
    assert found == [(1.0, {"a": 1.0}), (1.1, {"a": 1.1, "b": 1.1}), (1.2, {"a": 1.2})]


def test_nothing_is_taken_of_a_slope_that_failed_dry():
    assert play(steps((0.5, 3.0)), cut(end=20.0), cut("river", end=20.0, hold="never"))[0] == []


def test_one_that_holds_stands_still_while_the_slope_moves_and_goes_on_later():
    """It moves from 1.3 s to 2.3 s after t0, and has not got going."""
    speed = steps((T0 + 1.3, 0.5), (T0 + 2.3, 1e-3))
    found, state = play(speed, cut("holds", 1.0, 1.5), cut("goes on", 1.0, 2.0, hold="never"))
    assert times(found, "holds") == [1.0, 1.1, 1.2, 1.3, 1.4, 1.5]
    assert [since for since, told in found if "holds" in told] == [1.0, 1.1, 1.2, 2.3, 2.4, 2.5]
    assert times(found, "goes on") == [round(1.0 + 0.1 * k, 1) for k in range(11)]
    assert state.erosion_delay == pytest.approx(1.0)


def test_it_stands_still_twice():
    speed = steps((T0 + 1.1, 0.5), (T0 + 2.1, 1e-3), (T0 + 2.3, 0.5), (T0 + 4.3, 1e-3))
    found, state = play(speed, cut(end=1.5))
    assert times(found) == [1.0, 1.1, 1.2, 1.3, 1.4, 1.5] and state.erosion_delay == pytest.approx(3.0)
    assert [since for since, _ in found] == [1.0, 2.1, 2.2, 4.3, 4.4, 4.5]


def test_one_that_holds_takes_nothing_of_an_avalanche():
    speed = steps((T0 + 1.3, 3.0))
    assert times(play(speed, cut(end=9.0))[0]) == [1.0, 1.1, 1.2]


def test_a_slope_is_not_over_while_a_window_may_yet_take():
    """One that stands ends 10 s after the last load has come."""
    ends = []
    for windows in ((), (cut(begin=20.0),), (cut(end=30.0),)):
        stages = section.Stages(section.Settle(1.0, 3.0, 5e-3), 0.5, "motion", section.End(80.0, 0.02, 5.0))
        s = dataclasses.replace(SHIPPED, stages=stages, water=None, erosion=windows)
        at, state, time = scales.of(s), course.State(), 0.0
        while state.stage != "done":
            time = course.next_row(time, STEP, at.row_seconds) * at.row_seconds
            seen = course.Seen(time, STEP, 1e-3, more=False)
            state = course.after(course.noted(state, seen, at), seen, s, at)
        ends.append(time - T0)
    assert ends == pytest.approx([10.1, 30.0, 40.0], abs=0.11)
    assert times(play(steps(), cut(begin=20.0), until=70.0)[0]) == [20.0]


def test_nothing_is_taken_in_the_row_that_ends_the_course():
    found, state = play(steps(), cut(end=9.0), end=5.0)
    assert state.stage == "done" and times(found)[-1] == pytest.approx(5.0 - 0.5 - 0.1)


def test_an_avalanche_is_over_while_a_window_that_holds_waits_and_not_while_another_takes():
    """It rests 10 s after it began, and is over 5 s later."""
    speed = steps((T0 + 2.0, 3.0), (T0 + 12.0, 1e-3))
    ended = {}
    for hold in ("motion", "never"):
        found, state = play(speed, cut(end=30.0, hold=hold), until=70.0)
        assert state.stage == "done" and len(found) > 5
        ended[hold] = state.resting_since, round(found[-1][0], 1)
    assert ended == {"motion": (pytest.approx(T0 + 12.0), 1.9), "never": (pytest.approx(T0 + 12.0), 30.0)}


def test_a_slope_from_which_disks_are_taken_is_not_still():
    s = dataclasses.replace(SHIPPED, water=None, erosion=(cut(end=20.0), cut("late", 25.0)))
    state, at = course.State(stage="water", t0=0.0, table_since=0.0), scales.of(s)

    def still(state, time):
        return course.care(state, course.Seen(time, STEP, 1e-3), s, at)[1]

    taking = dataclasses.replace(state, erosion_taken={"cut": 10.0})
    over = dataclasses.replace(state, erosion_taken={"cut": 20.0})
    assert (still(state, 9.0), still(taking, 10.0), still(over, 21.0)) == (True, False, True)
