"""What is said of made-up runs of every kind. Needs no YADE."""

import dataclasses
import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import known_slope  # noqa: E402
import synthetic_slope as synthetic  # noqa: E402

characteristic_times, results, verdict = (
    synthetic.load(name) for name in ("measure.characteristic_times", "studies.slope.results", "studies.slope.verdict")
)
SHIPPED = known_slope.SHIPPED
STATE = known_slope.STATE | {"outside": 0.0, "rested": 4.0, "quiet_since": None}
SHAKEN = dataclasses.replace(
    SHIPPED, shaking=synthetic.load("model.section").load("jiufengershan_shaken").shaking
)  # from 11 s to 41 s
RESTING = dict(speed_mean_m_per_s=lambda t: np.full(len(t), 1e-3), centroid_x_m=lambda t: np.full(len(t), 40.0))
SIZE = math.sqrt(SHIPPED.area)
DRY = dict(wet_disks=lambda t: 0 * t, water_m=lambda t: 0 * t)


def of(section=SHIPPED, until=100.0, columns={}, **state):  # noqa: B006 (it is not changed)
    """The Verdict of the known run up to a time [s], with other columns, functions of the time, and another state."""
    series = known_slope.series()
    series |= {name: values(series["time_s"]) for name, values in columns.items()}
    series = {name: values[series["time_s"] <= until + 1e-9] for name, values in series.items()}
    state = STATE | state
    chosen = characteristic_times.chosen_rows(series, state)
    return verdict.of(series, section, state, characteristic_times.of_run(chosen, section, state), disks=550)


def slid(share):
    """Columns of a slope whose centre creeps by a share of the mass's size in all, down to the left or to the right."""
    return RESTING | dict(centroid_x_m=lambda t: 40.0 + share * SIZE * np.clip((t - 20.0) / 10.0, 0, 1))


@pytest.mark.parametrize("side", [1, -1])
def test_a_slope_that_slid_and_was_held_has_not_stood(side):
    found = of(moving=None, columns=slid(0.012 * side))
    assert found.kind == "slid" and f"the slope slid by {0.012 * SIZE:.3g} m" in found.says
    assert of(moving=None, columns=slid(0.008 * side)).kind == "stood"


def test_a_slide_has_the_water_of_its_own_time_and_not_the_highest():
    """Down 2 % of the size from 20 s to 30 s: 1 % at 25 s, where the table, which rises by 0.5 m/s from 10 s to 30.5 s,
    is at 7.5 m.
    """
    said = of(moving=None, columns=slid(0.02)).says
    assert said.endswith(
        "; it had slid by 1 % of its size at 25.0 s, with the water table at 7.5 m and 110 disks wet (20 %)"
    ), said
    assert "10.25" not in said
    early = dict(wet_disks=lambda t: np.where(t > 27, 110, 0))
    assert of(moving=None, columns=slid(0.02) | early).says.endswith("with the water table at 7.5 m, below all disks")
    assert of(moving=None, columns=slid(0.02) | DRY).says.endswith("of its size at 25.0 s, dry")


def test_a_slope_slides_from_when_the_water_came():
    """5 % of its size in the seconds before t0 are no slide; where no water came they are."""
    early = RESTING | dict(centroid_x_m=lambda t: 40.0 + 0.05 * SIZE * np.clip((t - 6.0) / 3.0, 0, 1))
    assert of(moving=None, columns=early).kind == "stood"
    dry = of(moving=None, t0=None, columns=early)
    assert dry.kind == "slid" and f"by {0.05 * SIZE:.3g} m, its centre of mass sideways since it settled" in dry.says


@pytest.mark.parametrize("side", [1, -1])
def test_a_slope_that_failed_dry_says_how_far_its_front_went(side):
    """From where it is in the first row to where it is in the last, down the slope."""
    section = synthetic.load("model.section.similar").mirrored(SHIPPED) if side < 0 else SHIPPED
    columns = dict(front_m=lambda t: side * np.linspace(20.0, 150.0, len(t)))
    assert ", its front went 130 m, and " in of(section, failed_dry=3.0, columns=columns).says


def eroded(since=12.0, shift=0.0):
    """Columns of a slope of which 5 disks of 20 t/m together are taken out at a time [s], and whose centre jumps then
    by so much of the mass's size."""
    return dict(
        eroded_disks=lambda t: np.where(t >= since, 5, 0),
        eroded_kg_per_m=lambda t: np.where(t >= since, 2e4, 0.0),
        eroded_shift_x_m=lambda t: np.where(t >= since, shift * SIZE, 0.0),
        eroded_shift_y_m=lambda t: 0 * t,
    )


def test_a_slope_that_moves_off_once_disks_were_taken_out_failed_by_erosion():
    wet, dry = of(columns=eroded()), of(columns=eroded() | DRY)
    assert wet.kind == dry.kind == "failed by erosion"
    assert "the slope failed by erosion, with 5 disks (20 t/m) taken out of it; it began to move at " in wet.says
    assert "; water acted on it too, with the table at " in wet.says and "water" not in dry.says
    assert wet.before is None and dry.before == STATE["moving"]  # water_at_failure_m is of those that are wet
    after = STATE["moving"] + 1.0
    assert of(columns=eroded(after)).kind == "failed by water" and of(columns=eroded(after) | DRY).kind == "failed dry"
    assert of(failed_dry=3.0, columns=eroded(1.0)).kind == "failed dry"
    helped = of(outside=3e4, columns=eroded())
    assert helped.says.endswith("brought or taken 3e+04 J/m before, so it may not have been the erosion alone")


def test_one_that_stands_says_what_was_taken_out():
    assert of(moving=None, columns=RESTING | eroded()).says.endswith(" and 5 disks (20 t/m) taken out of it")
    one = RESTING | eroded() | dict(eroded_disks=lambda t: np.where(t >= 12.0, 1, 0))
    assert of(moving=None, columns=one).says.endswith(" and 1 disk (20 t/m) taken out of it")
    assert "taken out" not in of(moving=None, columns=RESTING | eroded(1e3)).says
    until = of(until=31.0, stage="water", columns=eroded())
    assert until.kind == "not over" and "it began to at" in until.says and "5 disks (20 t/m)" in until.says


def test_a_jump_of_the_centre_is_no_slide():
    """It is 5 % of the size where disks are taken out of one side; the rest stays where it is."""
    jump = RESTING | eroded(20.0, 0.05)
    jump |= dict(centroid_x_m=lambda t: 40.0 + np.where(t >= 20.0, 0.05 * SIZE, 0.0))
    assert of(moving=None, columns=jump).kind == "stood"
    back = jump | dict(centroid_x_m=lambda t: np.full(len(t), 40.0))  # where what is left came back by as much
    assert of(moving=None, columns=back).kind == "slid"


def test_every_verdict_is_said_and_each_has_its_meaning():
    found = {
        of().kind,
        of(moving=None, columns=RESTING).kind,
        of(failed_dry=3.0).kind,
        of(failed_dry=8.0, outside=1e6).kind,
        of(SHAKEN).kind,
        of(moving=None).kind,
        of(moving=None, columns=slid(0.05)).kind,
        of(stage="dry", until=9.0, moving=None, t0=None).kind,
        of(columns=eroded()).kind,
    }
    assert found | {verdict.RESTLESS} == set(verdict.MEANINGS) == set(verdict.TITLES)


@pytest.mark.parametrize("mirrored", [False, True])
def test_a_failure_by_water_has_its_height(mirrored):
    section = synthetic.load("model.section.similar").mirrored(SHIPPED) if mirrored else SHIPPED
    found = of(section)
    assert found.kind == "failed by water" and found.before is None and "with the table at 9.55 m" in found.says
    shaken = of(section, outside=2e6)
    assert (
        shaken.kind == "failed by water" and "2e+06 J/m before, so it may not have been the water alone" in shaken.says
    )


def test_a_failure_while_it_shakes_is_of_the_shaking_dry_or_wet():
    wet, dry = of(SHAKEN), of(dataclasses.replace(SHAKEN, water=None), columns=DRY)
    assert wet.kind == dry.kind == "failed by shaking" and wet.before is None
    assert ", with the water table at 10.25 m and 110 disks wet; it began to move at 30.5 s, 19.5 s after" in wet.says
    assert ", without water; it began" in dry.says and "largest acceleration is 4.9 m/s²" in dry.says
    motion = SHAKEN.shaking.motion
    up = dataclasses.replace(motion, horizontal=0 * motion.horizontal, vertical=2 * motion.horizontal)
    lifted = of(dataclasses.replace(SHAKEN, shaking=dataclasses.replace(SHAKEN.shaking, motion=up)))
    assert "largest acceleration is 9.8 m/s²" in lifted.says  # of either component
    pushed = of(SHAKEN, outside=2e6)
    assert "2e+06 J/m before, so it may not have been the shaking alone" in pushed.says


@pytest.mark.parametrize("moving, kind", [(10.9, "water"), (11.1, "shaking"), (40.9, "shaking"), (41.1, "water")])
def test_in_water_the_shaking_is_the_cause_while_it_lasts(moving, kind):
    assert of(SHAKEN, moving=moving, columns={"wet_disks": lambda t: 0 * t + 9}).kind == f"failed by {kind}"


def test_dry_it_is_the_cause_afterwards_too():
    """A slope that stood dry before the shaking, and moves off some seconds after it."""
    assert of(SHAKEN, moving=45.0, columns=DRY).kind == "failed by shaking"
    assert of(SHAKEN, moving=10.9, columns=DRY).kind == "failed dry"


def test_what_failed_by_its_weight_was_not_shaken():
    assert of(SHAKEN, failed_dry=3.0).kind == "failed dry"


def test_a_slope_that_stood_says_how_far_the_water_came():
    found = of(moving=None, columns=RESTING)
    assert found.kind == "stood" and found.says == (
        "the slope stood until the run ended at 100.0 s, with the water table at 10.25 m at most and 110 disks wet (20 %)"
    )
    early = of(moving=None, columns=RESTING, quiet_since=95.0)
    assert early.says.endswith("; it was at rest and nothing was to come that could change it")
    assert ", dry" in of(moving=None, columns=RESTING | DRY).says
    below = of(moving=None, columns=RESTING | {"wet_disks": lambda t: 0 * t})
    assert "at 10.25 m at most, below all disks" in below.says
    assert ", without water" in of(dataclasses.replace(SHIPPED, water=None), moving=None, columns=RESTING | DRY).says


def test_one_that_neither_moves_off_nor_rests():
    def speed(at):
        return RESTING | {"speed_mean_m_per_s": lambda t: np.full(len(t), at)}

    assert of(moving=None, columns=speed(0.0199)).kind == "stood"
    assert of(moving=None, columns=speed(0.0201)).kind == "not at rest"  # of the shipped section's 0.02 m/s


def test_a_failure_by_its_own_weight():
    found = of(failed_dry=3.0)
    assert (found.kind, found.before) == ("failed dry", 3.0)
    # late, with no disk wet: it is its weight where nothing else has done work on it
    late = of(columns=DRY)
    assert (late.kind, late.before) == ("failed dry", 30.5)
    assert of(columns={"wet_disks": lambda t: (t > 30.6).astype(int)}).kind == "failed dry"  # wet too late
    assert of(columns={"wet_disks": lambda t: (t > 30.4).astype(int)}).kind == "failed by water"


def test_a_slope_that_something_else_moved_has_not_failed_dry():
    for state in (dict(failed_dry=8.0), dict(columns=DRY)):
        found = of(**state, outside=1.5e6)
        assert found.kind == "moved dry" and "1.5e+06 J/m until then" in found.says
    # nobody counts it with soft contacts
    assert of(failed_dry=8.0, outside=None).kind == "moved dry"
    assert of(failed_dry=3.0, outside=None, rested=None).kind == "failed dry"


def test_a_run_that_was_stopped():
    settling = of(stage="settle", until=4.0, moving=None, t0=None, settled=None)
    assert settling.says == "the run was stopped at 4.0 s, while the slope settled"
    waiting = of(stage="water", until=25.0, moving=None)
    assert waiting.kind == "not over" and "while the slope stood, with the water table at 7.5 m at most" in waiting.says
    # it may come to rest again until it has got going, at 2 m/s
    assert of(stage="water", until=31.0).kind == "not over" and of(stage="water", until=40.0).kind == "failed by water"
    assert "had not come to rest at 40.0 s, when the run was stopped" in of(stage="water", until=40.0).says
    assert of(stage="water", until=31.0, failed_dry=3.0).kind == "failed dry"  # that is known


def test_speeds_are_those_of_the_slopes_size():
    """A slope of a quarter of the size that moves at 1.1 m/s has got going, at 1 m/s."""
    small, _ = known_slope.scaled(0.25)
    columns = {"speed_mean_m_per_s": lambda t: np.where(t > 30.4, 1.1, 0.0)}
    assert of(small, stage="water", until=50.0, columns=columns).kind == "failed by water"
    assert of(stage="water", until=50.0, columns=columns).kind == "not over"


def test_a_summary_has_no_water_at_failure_where_it_was_not_the_water(tmp_path):
    series = known_slope.series() | {name: values(known_slope.series()["time_s"]) for name, values in DRY.items()}
    told = results.summarise(known_slope.write(tmp_path, series), SHIPPED, STATE | {"outside": 2e6})
    assert (told["verdict"], told["moved_dry_s"], told["failed_dry_s"]) == ("moved dry", 30.5, None)
    assert told["water_at_failure_m"] is None and told["times_s"]["t2"] == 30.5
    assert results.moved_before_water(told) is None  # it had a t0
    told = results.summarise(tmp_path, SHIPPED, STATE | {"outside": 2e6, "failed_dry": 8.0})
    assert results.moved_before_water(told) == told["moved_dry_s"] == 8.0
    old = {"failed_dry_s": None, "times_s": {"t0": 3.0}}  # of a version before
    assert results.moved_before_water(old) is None
    assert results.moved_before_water(old | {"failed_dry_s": 7.0, "times_s": {"t0": None}}) == 7.0
