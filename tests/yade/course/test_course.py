"""The rules of a slope's course, each by a made-up history of mean speeds. Needs no YADE."""

import ast
import dataclasses
import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import synthetic_slope as synthetic  # noqa: E402

course, rules, scales, section = (
    synthetic.load(name) for name in ("course", "course.slope", "model.scales", "model.section")
)
SHIPPED = section.load("jiufengershan")
STEP = 1e-2  # s
ROUNDING = 1e-9  # of sums of some hundred times and heights


def slope(hold="motion", rate=1.0, points=((0.0, 0.0),), rest_hold=5.0, end=80.0, water=True):
    """The shipped section with short stages: gravity in 1 s, settled at 3 s at the latest, half a second dry."""
    stages = section.Stages(section.Settle(1.0, 3.0, 5e-3), 0.5, hold, section.End(end, 0.02, rest_hold))
    made = dataclasses.replace(SHIPPED.water, table=points, rate=rate) if water else None
    return dataclasses.replace(SHIPPED, stages=stages, water=made)


@dataclasses.dataclass
class Row:
    """One row of a history: what was seen, and the state and what followed from it after that."""

    time: float
    speed: float
    height: float
    state: object
    flowing: float | None
    still: bool | None
    table: tuple | None


def play(s, speed, start=None, also=lambda time: {}):
    """Rows of a slope whose mean speed at a time is ``speed(time)``, until it is done; ``start``: a State to go on
    from, and its time; ``also(time)``: what else is seen then.
    """
    at = scales.of(s)
    state, time = start or (course.State(), 0.0)
    table, rows = course.water_table(state, s), []
    while state.stage != "done":
        row = course.next_row(time, STEP, at.row_seconds)
        time = row * at.row_seconds
        # as the engine has it in the step that ends the row
        height = None if s.water is None else float(np.interp(time, *table)) if table else 0.0
        seen = course.Seen(time, STEP, speed(time), height, **also(time))
        given = dataclasses.astuple(state)
        new = course.noted(state, seen, at)
        assert dataclasses.astuple(state) == given  # a function changes nothing that it is given
        given, before = dataclasses.astuple(new), new.stage
        state = course.after(new, seen, s, at)
        assert dataclasses.astuple(new) == given
        table = course.water_table(state, s)
        care = course.care(state, seen, s, at) if before == "water" else (None, None)
        rows.append(Row(time, seen.speed, height, state, *care, table))
        assert time < 200  # s; each of them ends
    return rows


def steps(*pairs, rest=1e-3):
    """A speed that is v from a time on, for each pair (time, v); ``rest`` before."""

    def speed(time):
        found = [v for since, v in pairs if time >= since - ROUNDING]
        return found[-1] if found else rest

    return speed


def at(rows, time):
    """The row that ends at a time."""
    return min(rows, key=lambda row: abs(row.time - time))


def close(value):
    return pytest.approx(value, abs=ROUNDING)


def test_the_module_needs_no_yade():
    imported = {
        alias.name
        for node in ast.walk(ast.parse(Path(rules.__file__).read_text()))
        if isinstance(node, ast.Import)
        for alias in node.names
    }
    imported |= {
        node.module or node.names[0].name
        for node in ast.walk(ast.parse(Path(rules.__file__).read_text()))
        if isinstance(node, ast.ImportFrom)
    }
    # of the room, by the first of their names
    assert imported == {"__future__", "math", "dataclasses", "triggers"}


# ---- settling and dry rest --------------------------------------------------------------------------
# never: after the longest time
@pytest.mark.parametrize(
    "speed, settled",
    [
        (steps(), 1.0),  # at rest all the time: once gravity acts, and not before
        (steps((0.0, 0.1), (1.75, 4e-3)), 1.8),  # comes to rest
        (steps((0.0, 5e-3)), 1.0),  # at the speed that counts as rest
        (steps((0.0, 5.1e-3)), 3.0),
    ],
)
def test_settled(speed, settled):
    rows = play(slope(), speed)
    state = rows[-1].state
    assert state.settled == close(settled) and state.t0 == close(settled + 0.5) and state.failed_dry is None
    assert [row.state.stage for row in rows if row.time < settled - ROUNDING] == ["settle"] * (round(10 * settled) - 1)
    assert {row.state.stage for row in rows if settled - ROUNDING <= row.time < settled + 0.45} == {"dry"}


@pytest.mark.parametrize("early, passed", [(0.49, True), (0.51, False)])
def test_times_are_met_to_half_a_step(early, passed):
    s, at = slope(), scales.of(slope())
    for state, time, stage in (
        (course.State(), 3.0, "dry"),
        (course.State("dry", settled=2.0), 2.5, "water"),
        (course.State("water", settled=2.0, t0=2.5), 82.0, "done"),
        (
            course.State("water", settled=2.0, t0=2.5, moving=3.0, stood=True, speed_max=9.0, resting_since=10.0),
            15.0,
            "done",
        ),
    ):
        assert (
            course.after(state, course.Seen(time - early * STEP, STEP, 0.01, 0.0), s, at).stage == stage
        ) == passed, state


def test_gravity_grows_in_proportion():
    settle = section.Settle(4.0, 30.0, 5e-3)
    assert [course.gravity_share(t, settle) for t in (0.0, 1.0, 4.0, 9.0)] == [0.0, 0.25, 1.0, 1.0]
    assert course.gravity_share(0.0, section.Settle(0.0, 30.0, 5e-3)) == 1.0


# ---- the water --------------------------------------------------------------------------------------
def test_the_water_begins_at_t0_and_not_before():
    rows = play(slope(), steps())
    t0 = rows[-1].state.t0
    assert t0 == close(1.5)
    assert all(row.table is None for row in rows if row.time < t0 - ROUNDING)
    for row in rows:
        assert row.height == close(max(0.0, row.time - t0))
    points = play(slope(points=((0.0, 2.0), (10.0, 4.0)), rate=0.5), steps())
    assert [at(points, t0 + t).height for t in (0.1, 5.0, 10.0, 14.0)] == [close(h) for h in (2.02, 3.0, 4.0, 6.0)]
    assert play(slope(points=((0.0, 2.0), (10.0, 4.0)), rate=0.0), steps())[-1].height == close(4.0)


@pytest.mark.parametrize("hold, level", [("motion", 10.0), ("never", None), (7.3, 7.3), (12.0, 12.0), (40.0, 40.0)])
def test_where_the_table_stays(hold, level):
    """The slope moves 10 s after t0, at a table of 10 m, and goes on."""
    rows = play(slope(hold, end=60.0), steps((11.5, 0.2), (12.0, 30.0)))
    t0, last = 1.5, rows[-1]
    assert last.state.moving == close(11.5) and last.state.failed_dry is None and last.state.stood
    for row in rows:
        free = max(0.0, row.time - t0)
        assert row.height == close(free if level is None else min(free, level))
    assert last.state.water_hold == (None if level is None else close(level))
    assert at(rows, 11.4).state.water_hold == (close(7.3) if hold == 7.3 else None)
    assert last.state.table == close(last.height) and last.state.water_delay == 0


def test_a_slope_without_water_has_no_table():
    last = play(slope(water=False), steps((10.0, 3.0), (30.0, 0.0)))[-1].state
    assert (
        last.moving == close(10.0)
        and last.water_hold is None
        and last.table == 0
        and last.failed_dry is None
        and last.resting_since == close(30.0)
    )


# ---- moving, and stopping again ---------------------------------------------------------------------
def test_below_its_speed_nothing_moves():
    last = play(slope(), steps((5.0, 0.199)))[-1].state
    assert last.moving is None and last.water_hold is None and last.speed_max == 0.199


def test_a_slope_that_stops_again_goes_on_rising_with_its_delay():
    """It stirs at 5 s for 2 s, and at 11 s for 3 s; half the way it is slow, but has not stopped."""
    rows = play(
        slope(end=40.0),
        steps((5.0, 0.3), (6.0, 0.021), (7.0, 0.019), (11.0, 0.5), (14.0, 0.0), (20.0, 0.4), (22.0, 3.0)),
    )

    def heights(*times):
        return [at(rows, t).height for t in times]

    assert at(rows, 6.9).state.moving == close(5.0) and at(rows, 7.0).state.moving is None
    assert heights(5.0, 6.0, 7.0) == [close(3.5)] * 3  # held
    # goes on from there, and is held again
    assert heights(7.1, 10.0, 11.0, 12.0, 14.0) == [close(h) for h in (3.6, 6.5, 7.5, 7.5, 7.5)]
    assert [at(rows, t).state.water_delay for t in (6.9, 7.0, 13.9, 14.0)] == [close(d) for d in (0.0, 2.0, 2.0, 5.0)]
    last = rows[-1].state
    assert (
        heights(15.0, 20.0, 30.0) == [close(h) for h in (8.5, 13.5, 13.5)]
        and last.moving == close(20.0)
        and last.failed_dry is None
    )
    assert np.diff([row.height for row in rows]).max() < 0.1 + ROUNDING  # no jump anywhere: 1 m/s, ten rows a second


@pytest.mark.parametrize("fastest, goes_on", [(1.99, True), (2.0, False)])
def test_one_that_has_got_going_does_not_begin_again(fastest, goes_on):
    s = slope(end=25.0, rest_hold=1e9)
    last = play(s, steps((5.0, fastest), (6.0, 1e-3)))[-1]
    assert (last.state.moving is None) == goes_on and last.height == close(24.5 - 1.0 if goes_on else 3.5)


def test_a_delay_only_where_motion_holds_the_table():
    rows = play(slope("never", end=20.0), steps((5.0, 0.3), (7.0, 0.0)))
    assert rows[-1].state.water_delay == 0 and rows[-1].height == close(19.5) and rows[-1].state.moving is None
    rows = play(slope(5.0, end=20.0), steps((5.0, 0.3), (7.0, 0.0)))
    assert rows[-1].state.water_delay == 0 and rows[-1].height == close(5.0) and rows[-1].state.moving is None


def test_the_largest_speed_counts_from_the_water_on():
    rows = play(slope(), steps((0.0, 0.7), (0.9, 1e-3), (6.0, 0.1)))
    assert at(rows, 1.2).state.speed_max == 0 and rows[-1].state.speed_max == 0.1


# ---- failed dry -------------------------------------------------------------------------------------
# never stood since
@pytest.mark.parametrize(
    "speed, failed, settled, table",
    [
        (steps((0.4, 2.0), (0.6, 1.0), (6.0, 0.0)), 0.4, 1.0, 0.0),  # while gravity grows: not waited for once it acts
        (steps((0.0, 0.1), (2.0, 2.0), (6.0, 0.0)), 2.0, 2.0, 0.0),  # at once where it acts
        (steps((1.2, 2.5), (6.0, 0.0)), 1.2, 1.0, 0.0),  # in the dry rest
        (steps((1.45, 0.2), (6.0, 0.0)), 1.5, 1.0, 0.0),  # on the move at t0
        (steps((1.45, 0.15), (3.5, 0.2), (6.0, 0.0)), 3.5, 1.0, 2.0),
    ],
)
def test_a_slope_fails_dry(speed, failed, settled, table):
    rows = play(slope(), speed)
    last = rows[-1].state
    assert last.failed_dry == close(failed) and last.settled == close(settled) and last.t0 == close(settled + 0.5)
    assert (
        last.moving == close(failed)
        and last.water_hold == close(table)
        and max(row.height for row in rows) == close(table)
    )
    assert last.speed_max == max(row.speed for row in rows if row.time >= min(failed, last.t0) - ROUNDING)
    # followed until it rests, and no longer
    assert last.resting_since == close(6.0) and rows[-1].time == close(11.0) and rows[-1].state.water_delay == 0


# at t0 itself
@pytest.mark.parametrize(
    "speed, moving",
    [
        (steps((0.4, 1.99), (0.6, 1e-3), (5.0, 0.3), (5.5, 9.0)), 5.0),  # did not get going, and stood
        # stood after t0, if only for a moment
        (steps((1.45, 0.19), (1.95, 0.0199), (2.05, 0.1), (5.0, 0.2), (5.5, 9.0)), 5.0),
        (steps((1.45, 0.0199), (1.55, 0.1), (5.0, 0.2), (5.5, 9.0)), 5.0),
    ],
)
def test_a_slope_that_has_stood_fails_by_water(speed, moving):
    last = play(slope(end=12.0), speed)[-1].state
    assert last.failed_dry is None and last.moving == close(moving) and last.stood and last.water_hold == close(3.5)


# a mass that has gone so far of its size since it was packed, with so many of its bonds broken
@pytest.mark.parametrize(
    "way, broken, collapsed",
    [(0.0101, 0.0, True), (0.0099, 0.09, False), (0.0021, 0.101, True), (0.0019, 0.9, False), (0.0099, 0.101, True)],
)
@pytest.mark.parametrize("since", [0.4, 1.2])  # while gravity grows, and in the dry rest
def test_a_mass_that_collapses_slowly_has_not_waited_for_the_water(way, broken, collapsed, since):
    """At 1.9 m/s and less, and at rest again before the water would rise."""
    speed = steps((since - 0.1, 1.9), (since, 0.1), (since + 0.1, 1e-3))
    rows = play(
        slope(end=12.0), speed, also=lambda t: dict(way=way, broken=broken) if t >= since - ROUNDING else dict(way=0.0)
    )
    last = rows[-1].state
    assert (last.failed_dry == close(since)) if collapsed else last.failed_dry is None
    assert max(row.height for row in rows) == close(0.0 if collapsed else 11.5)
    if collapsed:  # it rests by a part of the speed that it had had before it counted
        assert last.speed_max == 1.9 and last.moving == close(since) and rows[-1].time < 8.0


def test_a_slope_that_has_failed_by_water_does_not_collapse_dry():
    rows = play(
        slope(end=20.0), steps((5.0, 9.0), (9.0, 0.0)), also=lambda t: dict(way=0.3 if t > 5 else 0.0, broken=0.5)
    )
    assert rows[-1].state.failed_dry is None and rows[-1].state.moving == close(5.0)


def test_what_acted_on_it_until_it_moved_is_kept():
    """Energy from elsewhere, and whether a disk had been wet: what comes later does not count."""

    def seen(t):
        return dict(outside=7.0 if 1.2 < t < 1.4 else 3.0 if t < 5.05 else 99.0, wet=int(t > 5.05))

    last = play(slope(end=12.0), steps((5.0, 3.0), (9.0, 0.0)), also=seen)[-1].state
    assert (last.outside, last.wet, last.moving, last.rested) == (7.0, False, close(5.0), close(1.0))
    wet = play(slope(end=12.0), steps((5.0, 3.0)), also=lambda t: dict(wet=int(t > 4.0), outside=None))[-1].state
    assert wet.wet and wet.outside is None
    # not while gravity grows, nor above the speed of rest
    assert play(slope(end=12.0), steps((0.0, 6e-3), (7.0, 5e-3)))[-1].state.rested == close(7.0)


def test_one_that_failed_dry_waits_for_no_water():
    """It stops, has never got going, and is the same failure still."""
    rows = play(slope(rest_hold=1e9, end=20.0), steps((1.45, 0.3), (4.0, 0.0), (8.0, 0.3), (9.0, 0.0)))
    assert {(row.state.moving, row.state.water_hold) for row in rows if row.time > 1.6} == {
        (rows[-1].state.failed_dry, 0.0)
    } and rows[-1].height == 0


# ---- how exactly contacts are computed ----------------------------------------------------------------
def test_still_is_five_seconds_at_one_height():
    dry = play(slope(rate=0.0, end=20.0), steps())
    assert [row.still for row in dry if row.still is not None] == [
        row.time - 1.0 >= 5.0 - ROUNDING for row in dry if row.time > 1.5 + ROUNDING
    ]
    assert not any(row.still for row in play(slope(), steps()))  # the table rises
    held = play(slope(3.0, end=20.0), steps())
    arrived = next(row.time for row in held if row.state.water_hold is not None)
    assert arrived == close(4.5) and [row.time for row in held if row.still][0] == close(arrived + 5.0)
    # from 9.45 s to 9.55 s
    late = play(slope(points=((0.0, 0.0), (7.95, 0.0), (8.05, 1.0)), rate=0.0, end=20.0), steps())
    assert [row.still for row in late if row.time > 6.05] == [
        not 9.45 < row.time < 14.55 for row in late if row.time > 6.05
    ]
    moving = play(slope(3.0, end=20.0), steps((9.0, 0.3), (15.0, 0.0)))
    assert (
        {row.still for row in moving if 9.0 - ROUNDING < row.time < 14.95} == {False}
        and at(moving, 15.0).still
        and at(moving, 16.0).still
    )


def test_the_tolerance_by_state_and_speed():
    numerics = dataclasses.replace(SHIPPED.numerics, tolerance=1e-6, tolerance_moving=2e-4)
    for flowing, still, wanted in (
        (0.0, False, 1e-6),
        (0.0, True, 0.25e-6),
        (1.0, False, 2e-4),
        (0.5, False, 1e-4),
        (1e-3, False, 1e-6),
        (0.01, False, 2e-6),
    ):
        assert course.tolerance(flowing, still, numerics) == pytest.approx(wanted, rel=1e-12)  # rounding
    assert [course.damping(flowing, 0.2, 0.04) for flowing in (0.0, 0.25, 1.0)] == pytest.approx(
        [0.2, 0.16, 0.04], rel=1e-12
    )


def test_care_grows_as_the_slope_slows_down():
    rows = play(slope(), steps((5.0, 0.5), (6.0, 40.0), (8.0, 4.0), (9.0, 3.0), (10.0, 1.0), (11.0, 0.2), (12.0, 0.0)))
    found = [at(rows, time + 0.5).flowing for time in (3.0, 5.0, 6.0, 8.0, 9.0, 10.0, 11.0, 12.0)]
    assert found == pytest.approx([0, 1, 1, 1, 0.75, 0.25, 0.05, 0], rel=1e-12, abs=1e-15)  # of a tenth of 40 m/s
    assert at(rows, 3.5).state.moving is None and at(rows, 12.5).state.moving is not None


# ---- the end ----------------------------------------------------------------------------------------
def test_it_ends_when_it_has_rested():
    """Below 2 % of 40 m/s; a stir in between begins the rest anew, and one at that speed is no rest."""
    rows = play(slope(), steps((5.0, 40.0), (10.0, 0.79), (14.0, 0.8), (14.1, 0.5), (19.1, 0.3)))
    assert (
        rows[-1].time == close(19.1) and rows[-1].state.stage == "done" and rows[-1].state.resting_since == close(14.1)
    )
    assert at(rows, 13.9).state.resting_since == close(10.0) and at(rows, 14.0).state.resting_since is None
    assert play(slope(rest_hold=2.0), steps((5.0, 40.0), (10.0, 0.79)))[-1].time == close(12.0)


def test_it_ends_when_its_time_has_passed():
    assert play(slope(end=12.0), steps((5.0, 40.0)))[-1].time == close(13.0)  # after settling, at 1 s
    rows = play(slope(end=12.0, rest_hold=1.0), steps())
    assert rows[-1].time == close(13.0) and rows[-1].state.resting_since is None  # one that does not move does not rest


def standing(**seen):
    return lambda time: dict(more=False) | {name: one(time) if callable(one) else one for name, one in seen.items()}


@pytest.mark.parametrize(
    "hold, rate, points, top, ends",
    [
        ("motion", 1.0, [(0.0, 0.0)], 10.0, 11.6 + 10.0),  # the table is above 10 m from 11.6 s on, and rises
        ("motion", 1.0, [(0.0, 0.0)], 100.0, 81.0),  # it never comes so far
        (4.0, 1.0, [(0.0, 0.0)], 10.0, 5.5 + 10.0),  # held at 4 m
        ("never", 0.0, [(0.0, 0.0)], 10.0, 1.6 + 10.0),  # it stays at 0
        ("never", 0.0, [(0.0, 0.0), (2.0, 6.0)], 10.0, 3.5 + 10.0),
        ("never", 0.0, [(0.0, 0.0), (2.0, 20.0), (30.0, 20.0), (32.0, 3.0)], 10.0, 33.5 + 10.0),  # it will fall again
    ],
)
def test_a_slope_that_stands_under_its_last_load_ends_its_run(hold, rate, points, top, ends):
    """t0 is 1.5 s; it is still after 5 s, and rest_hold is 5 s."""
    rows = play(slope(hold, rate, tuple(points)), steps(), also=standing(top=top))
    assert rows[-1].time == pytest.approx(ends, abs=0.1 + ROUNDING)  # a row
    longest = play(slope(hold, rate, tuple(points)), steps(), also=standing(top=top, more=True))
    assert longest[-1].time == close(81.0)  # where a script may do more to it
    assert [dataclasses.astuple(row.state) for row in longest[: len(rows) - 1]] == [
        dataclasses.astuple(row.state) for row in rows[:-1]
    ]


def test_a_slope_without_water_that_stands_ends_its_run():
    assert play(slope(water=False), steps(), also=standing())[-1].time == close(1.6 + 10.0)


def test_while_states_of_a_field_of_water_are_to_come_it_neither_stands_nor_is_still():
    rows = play(slope(water=False), steps(), also=standing(coming=lambda t: t < 20.0))
    assert rows[-1].time == close(20.0 + 10.0)
    still = [row.time for row in rows if row.still]
    assert still[0] == close(19.9 + 5.0)  # the last row that saw one was that before


# what goes on until 9 s
@pytest.mark.parametrize(
    "speed, seen",
    [
        (steps((0.0, 0.0051), (9.0, 0.005)), {}),  # it creeps
        (steps(), dict(broken=lambda t: 1e-3 * min(90, round(10 * t)))),  # bonds break
        (steps(), dict(wet=lambda t: min(90, round(10 * t)))),  # disks get wet
    ],
)
def test_as_long_as_anything_goes_on_it_does_not_end(speed, seen):
    rows = play(slope("never", 0.0), speed, also=standing(**seen))
    assert rows[-1].time == close(9.0 + 10.0)


# ---- rows -------------------------------------------------------------------------------------------
def test_rows_are_multiples_of_their_distance():
    for time, number in ((0.0, 1), (0.0949, 1), (0.0951, 2), (0.1, 2), (0.1049, 2), (7.3 - 1e-9, 74), (7.3 + 1e-9, 74)):
        assert course.next_row(time, STEP, 0.1) == number  # the row that ends next, to half a step
    whole = play(slope(), steps((5.0, 0.3), (7.0, 0.0), (9.0, 9.0), (20.0, 0.0)))
    for k in (5, 12, 45, 60, 75, 120):  # gone on with from any state, it is the same
        resumed = play(slope(), steps((5.0, 0.3), (7.0, 0.0), (9.0, 9.0), (20.0, 0.0)), (whole[k].state, whole[k].time))
        assert [dataclasses.astuple(row.state) for row in resumed] == [
            dataclasses.astuple(row.state) for row in whole[k + 1 :]
        ]


def test_snapshots_are_every_fifth_row_once_it_counts():
    def kept(state):
        return [row for row in range(1, 21) if course.keeps_frame(state, row)]

    assert kept(course.State()) == [] and kept(course.State(failed_dry=0.3)) == [5, 10, 15, 20]
    assert kept(course.State("dry")) == kept(course.State("water")) == [5, 10, 15, 20]


# ---- other sizes ------------------------------------------------------------------------------------
def test_the_shipped_section_has_the_scales_that_it_had():
    for s in (SHIPPED, SHIPPED.with_disks(3000)):
        assert dataclasses.astuple(scales.of(s)) == (0.1, 1.0, 5.0, 0.2, 0.02, 2.0, 60.0, 1.0)  # to the last bit


@pytest.mark.parametrize(
    "size, gravity, row, mean",
    [
        (2e-3, 1.0, 5e-3, 0.05),
        (1e-6, 1.0, 1e-4, 1e-3),
        (1.0, 100.0, 0.01, 0.1),
        (12.0, 1.0, 0.5, 5.0),
        (8.0, 1.0, 0.2, 2.0),
        (0.4, 1.0, 0.05, 0.5),
    ],
)
def test_scales_of_other_slopes(size, gravity, row, mean):
    """Rows and means are the nearest of 1, 2 and 5 times a power of ten, by ratio: √12 = 3.46 is 1.45 times less than 5
    and 1.73 times more than 2.
    """
    other, speed, time = scaled(slope(), size, gravity)
    found = scales.of(dataclasses.replace(other, numerics=dataclasses.replace(SHIPPED.numerics, time_step=1e-5)))
    assert (
        found.moving_speed,
        found.stopped_speed,
        found.going_speed,
        found.approach_speed,
        found.correction_speed,
    ) == pytest.approx((0.2 * speed, 0.02 * speed, 2 * speed, 60 * speed, 1.0), rel=1e-12)
    assert found.still_seconds == pytest.approx(5 * time, rel=1e-12) and (found.row_seconds, found.mean_seconds) == (
        row,
        mean,
    )


def test_rows_are_no_closer_than_steps():
    coarse = scales.of(dataclasses.replace(SHIPPED, numerics=dataclasses.replace(SHIPPED.numerics, time_step=0.25)))
    slow = scales.of(dataclasses.replace(SHIPPED, numerics=dataclasses.replace(SHIPPED.numerics, time_step=2.5)))
    assert (coarse.row_seconds, coarse.mean_seconds) == (0.25, 1.0) and (slow.row_seconds, slow.mean_seconds) == (
        2.5,
        2.5,
    )


def scaled(s, size, gravity):
    """A section ``size`` times as large in a ``gravity`` times as strong one, with its stages and its water in
    proportion; and its units of speed and time.
    """
    speed, time = math.sqrt(size * gravity), math.sqrt(size / gravity)
    layers = tuple(
        dataclasses.replace(layer, vertices=tuple((size * x, size * y) for x, y in layer.vertices))
        for layer in s.layers
    )
    settle, end, hold = s.stages.settle, s.stages.end, s.stages.water_hold
    stages = section.Stages(
        section.Settle(time * settle.ramp, time * settle.time_max, speed * settle.speed_rest),
        time * s.stages.dry,
        hold if isinstance(hold, str) else size * hold,
        section.End(time * end.time, end.rest_fraction, time * end.rest_hold),
    )
    water = dataclasses.replace(
        s.water, table=tuple((time * t, size * h) for t, h in s.water.table), rate=speed * s.water.rate
    )
    return dataclasses.replace(s, layers=layers, gravity=gravity * s.gravity, stages=stages, water=water), speed, time


HISTORIES = {
    "water": steps(
        (5.0, 0.3),
        (6.0, 0.021),
        (7.0, 0.019),
        (11.0, 0.5),
        (14.0, 0.0),
        (20.0, 0.4),
        (22.0, 30.0),
        (30.0, 1.0),
        (35.0, 0.0),
    ),
    "dry": steps((1.45, 0.21), (6.0, 0.0)),
    "dry early": steps((0.4, 2.1), (6.0, 0.0)),
    "never stood": steps((1.45, 0.15), (3.5, 0.21), (6.0, 0.0)),
    "still": steps(),
}


@pytest.mark.parametrize("name", HISTORIES)
@pytest.mark.parametrize("size, gravity", [(0.25, 1.0), (4.0, 4.0), (1.0, 0.25)])
@pytest.mark.parametrize("hold", ["motion", 3.0])
def test_slopes_of_other_sizes_do_the_same_in_their_units(name, size, gravity, hold):
    """Rows of these are 0.05, 0.1 and 0.2 s apart, exactly in proportion."""
    small, history = slope(hold, end=45.0), HISTORIES[name]
    other, speed, time = scaled(small, size, gravity)
    assert scales.of(other).row_seconds == pytest.approx(0.1 * time, rel=1e-12)
    reference, found = play(small, history), play(other, lambda t: speed * history(t / time))
    assert len(found) == len(reference)
    units = {"speed_max": speed, "speed_before": speed, "table": size, "water_hold": size}
    units |= dict.fromkeys(
        (
            "settled",
            "t0",
            "moving",
            "failed_dry",
            "rested",
            "table_since",
            "water_delay",
            "resting_since",
            "quiet_since",
        ),
        time,
    )
    for a, b in zip(reference, found):
        for field in dataclasses.fields(a.state):
            value, scaled_value = getattr(a.state, field.name), getattr(b.state, field.name)
            if field.name in units and value is not None:
                assert scaled_value == pytest.approx(units[field.name] * value, abs=ROUNDING), (a.time, field.name)
            else:
                assert scaled_value == value, (a.time, field.name)
        assert (a.still, a.height * size) == (b.still, pytest.approx(b.height, abs=ROUNDING))
        assert a.flowing is b.flowing is None or a.flowing == pytest.approx(b.flowing, abs=ROUNDING)


# ---- what is foreseen -------------------------------------------------------------------------------
def test_the_end_is_foreseen():
    """55 s of motion; before that 25 m of water, or the whole time where nothing holds it; never the past, and never
    after the latest end.
    """
    s = slope(end=150.0, rate=0.5)
    assert course.foreseen(course.State("done", settled=1.0, moving=9.0), 70.0, s) == 70.0
    assert course.foreseen(course.State("water", settled=1.0, t0=1.5, moving=9.0), 20.0, s) == 64.0
    assert course.foreseen(course.State("water", settled=1.0, t0=1.5, moving=99.0), 100.0, s) == 151.0
    assert course.foreseen(course.State("water", settled=1.0, t0=1.5, moving=9.0), 70.0, s) == 70.0
    assert course.foreseen(course.State("dry", settled=1.0), 1.2, s) == 1.0 + 0.5 + 50.0 + 55.0
    assert (
        course.foreseen(course.State(), 2.0, s) == 8.0 + 0.5 + 50.0 + 55.0
        and course.foreseen(course.State(), 10.0, s) == 115.5
    )
    assert course.foreseen(course.State("dry", settled=1.0), 1.2, slope("never", end=150.0)) == 151.0
