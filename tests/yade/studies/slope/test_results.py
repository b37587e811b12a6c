"""Characteristic times and summary of made-up runs whose answers are known. Needs no YADE."""

import dataclasses
import json
import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import known_slope  # noqa: E402
import synthetic_slope as synthetic  # noqa: E402

records, results, toe, characteristic_times = (
    synthetic.load(name) for name in ("records", "studies.slope.results", "measure.toe", "measure.characteristic_times")
)
force_stages = synthetic.load("measure.force_stages")
SHIPPED, STATE = known_slope.SHIPPED, known_slope.STATE
SAME = 1e-9  # relative: rounding of sums over a thousand rows
TIMES = {"t0": 10.0, "t1": 29.1, "t2": 30.5, "t3": 39.1, "t4": 55.0, "t5": 84.5}
WEAKENS = 35.0


def times_of(series, **state):
    """Of the rows that a run is told by, as a summary has them."""
    state = STATE | state
    return characteristic_times.of_run(characteristic_times.chosen_rows(series, state), SHIPPED, state)


def changed(**columns):
    """The known series with other columns: arrays, or functions of the time."""
    series = known_slope.series()
    return series | {name: values(series["time_s"]) if callable(values) else values for name, values in columns.items()}


def until(end):
    return {name: values[known_slope.series()["time_s"] <= end + 1e-9] for name, values in known_slope.series().items()}


# ---- names ------------------------------------------------------------------------------------------
def test_all_numbers_of_a_summary_are_known_before(tmp_path):
    """What ``--draw`` of a sweep may name: with a backstop, an envelope, water along a wall; and no more than a run may
    have.
    """
    plan = synthetic.load("campaign.plan")
    summary = results.summarise(known_slope.write(tmp_path), SHIPPED, STATE)
    found = {name for name in plan.numbers(summary) if name != "verdict" and not name.startswith("times_missing.")}
    known = results.numbers_of(SHIPPED)
    assert len(set(known)) == len(known)
    # toe_bands without a band is one number that is null, and walls have losses where a run tells them
    assert found - {"toe_bands", "toe_bands_triggering"} <= set(known)
    assert all(
        name.startswith(("toe_bands.", "toe_bands_triggering.", "sliding_on_walls_J_per_m."))
        for name in set(known) - found
    ), (set(known) - found)
    bare = dataclasses.replace(SHIPPED, water=None)
    assert set(known) - set(results.numbers_of(bare)) == set(results.PASSIVE)
    assert set(results.BED) <= set(results.numbers_of(known_slope.section.load("interface"))) and not set(
        results.BED
    ) & set(known)


# ---- means ------------------------------------------------------------------------------------------
def test_a_mean_is_over_the_seconds_up_to_a_time():
    t = np.arange(1, 101) / 10
    series = {"time_s": t, "x": t**2}
    # ten rows, 4.1 to 5.0 s
    assert characteristic_times.mean_of(series, "x", 5.0, 1.0) == pytest.approx(
        np.mean(np.arange(41, 51) ** 2) / 100, rel=SAME
    )
    assert characteristic_times.mean_of(series, "x", 5.0, 0.0) == pytest.approx(25.0) and characteristic_times.mean_of(
        series, "x", 5.04, 0.1
    ) == pytest.approx(25.0)
    assert math.isnan(characteristic_times.mean_of(series, "x", 0.05, 0.01))
    # rows end up to half a step before or after their tenths, and are ten a second all the same
    for early, late in ((0.005, 0.0), (0.0, 0.005)):
        uneven = {"time_s": t - np.where(np.arange(100) % 2 == 0, early, late), "x": np.arange(100.0)}
        for k in (49, 50):
            assert (
                characteristic_times.mean_of(uneven, "x", uneven["time_s"][k], 1.0) == k - 4.5
                and characteristic_times.mean_of(uneven, "x", uneven["time_s"][k], 0.0) == k
            )


# ---- characteristic times ---------------------------------------------------------------------------
def test_times_of_a_whole_run():
    """t1: the mean over 1 s of 140 + 3 (t − 10) MN/m comes to 98 % of that at t2, 199.7; t3: the mean of T_DP over 1 s,
    379.85 MN/m at t2, to a tenth; t5: 85.03 − 0.02 · 28.03 s.
    """
    assert times_of(known_slope.series()) == pytest.approx(TIMES, abs=1e-9)


def test_means_of_all_rows_are_those_of_each():
    """Rows of uneven lengths too."""
    series = known_slope.series()
    series["time_s"] = series["time_s"] - np.where(np.arange(len(series["time_s"])) % 3 == 0, 0.004, 0.0)
    for span in (1.0, 0.25, 0.0):
        found = characteristic_times._means(series, "dp_shear_N_per_m", span)
        wanted = [characteristic_times.mean_of(series, "dp_shear_N_per_m", t, span) for t in series["time_s"]]
        assert found == pytest.approx(wanted, rel=1e-12, abs=1e-6)  # N/m: rounding of ten numbers of 1e8


def test_t1_is_of_the_largest_force_up_to_t2_and_of_the_water_alone():
    higher = times_of(
        changed(fb_normal_N_per_m=lambda t: known_slope.series()["fb_normal_N_per_m"] + 900e6 * ((t > 6) & (t < 10.05)))
    )
    assert higher["t1"] == TIMES["t1"]  # a second that begins before t0 is none
    later = times_of(
        changed(fb_normal_N_per_m=lambda t: np.where(t > 30.55, 900e6, known_slope.series()["fb_normal_N_per_m"]))
    )
    assert later["t1"] == TIMES["t1"]  # nor does what comes after t2 count
    # with the slope on the move at 41 s: 98 % of the largest force of all, 300 MN/m from 40.1 s on
    assert times_of(known_slope.series(), moving=42.0)["t1"] == 41.0


def test_t2_is_where_the_slope_begins_to_move_whether_it_weakens_or_not():
    assert times_of(known_slope.series(), moving=33.0)["t2"] == 33.0
    no_weakening = times_of(changed(weakened_disks=lambda t: np.full(len(t), 7)))
    assert no_weakening == pytest.approx(TIMES | {"t3": None}, abs=1e-9)


@pytest.mark.parametrize(
    "diameters, before, after, found",
    [
        ((1.0, 4.0), 7, 8, 35.0),  # 1530 m hold 765 disks of √(1 · 4) m: 7.65 are a hundredth
        ((1.2, 4.0), 7, 8, 32.0),  # 6.98
        ((1.0, 3.6), 7, 8, None),  # 8.06
        ((90.0, 90.0), 1, 1, 32.0),  # one at least
        ((90.0, 90.0), 0, 0, None),
    ],
)
def test_weakening_begins_with_a_hundredth_of_the_disks_along_the_plane(diameters, before, after, found):
    section = dataclasses.replace(
        SHIPPED, disks=dataclasses.replace(SHIPPED.disks, d_min=diameters[0], d_max=diameters[1])
    )
    series = characteristic_times.chosen_rows(
        changed(weakened_disks=lambda t: np.select([t < 32 - 1e-9, t < 35 - 1e-9], [0, before], after)), STATE
    )
    assert characteristic_times.weakening_begins(series, section, STATE) == found
    assert (characteristic_times.of_run(series, section, STATE)["t3"] is None) == (found is None)
    assert characteristic_times.weakening_begins(series, section, STATE | {"failed_dry": 3.0}) is None


@pytest.mark.parametrize("share, found", [(0.101, 32.0), (0.099, None)])
def test_cells_of_slip_laws_weaken_a_slope_without_weakened_disks(share, found):
    """From 32 s on, a tenth of their length; before t0 it does not count."""
    series = changed(weakened_disks=lambda t: 0 * t)
    t = series["time_s"]
    series["cells_weakened_rel"] = np.select([t < 9, t < 32 - 1e-9], [1.0, 0.0], share)
    series = characteristic_times.chosen_rows(series, STATE)
    assert characteristic_times.weakening_begins(series, SHIPPED, STATE) == found
    times = characteristic_times.of_run(series, SHIPPED, STATE)
    assert times == pytest.approx(TIMES if found else TIMES | {"t3": None}, abs=1e-9)


def test_a_slope_that_weakened_and_stopped_has_t3_after_t2():
    """Its shear force was nothing while it weakened, 32 to 33 s; it moved for good at 34 s."""
    series = changed(
        weakened_disks=lambda t: np.where(t < 32 - 1e-9, 0, 8),
        dp_shear_N_per_m=lambda t: np.where(np.abs(t - 33) < 1.05, 0.0, known_slope.series()["dp_shear_N_per_m"]),
    )
    state = dict(moving=36.0)
    found = times_of(series, **state)
    assert (
        characteristic_times.weakening_begins(characteristic_times.chosen_rows(series, STATE), SHIPPED, STATE) == 32.0
    )
    # T_DP at t2: 365 (1 − 0.55/4) = 314.8 MN/m
    assert (found["t2"], found["t3"]) == (36.0, pytest.approx(39.1))


def test_t3_is_a_tenth_of_the_mean_shear():
    """From 35 s on it falls from 365 MN/m by a quarter a second; with a rest of 9 or of 11 % of the mean at t2, it
    comes to a tenth, or does not.
    """
    for rest, comes in ((0.09, True), (0.11, False)):
        series = changed(
            dp_shear_N_per_m=lambda t: np.where(t <= 35, 365e6, np.maximum(365e6 * (1 - (t - 35) / 4), rest * 365e6))
        )
        assert (times_of(series)["t3"] is not None) == comes
    once = times_of(
        changed(dp_shear_N_per_m=lambda t: np.where(np.abs(t - 20) < 2, 0.0, known_slope.series()["dp_shear_N_per_m"]))
    )
    assert once == pytest.approx(TIMES, abs=1e-9)  # what was before t2 does not count
    early = times_of(
        changed(dp_shear_N_per_m=lambda t: np.where((t > 31) & (t < 33), 0.0, known_slope.series()["dp_shear_N_per_m"]))
    )
    assert early == pytest.approx(TIMES, abs=1e-9)  # nor does what is before the weakening


def test_t4_and_t5_are_the_top_and_the_last_fall():
    stirred = times_of(
        changed(speed_mean_m_per_s=lambda t: known_slope.series()["speed_mean_m_per_s"] + (np.abs(t - 95) < 0.05))
    )
    assert stirred["t4"] == 55.0 and stirred["t5"] == pytest.approx(95.1, abs=1e-9)
    before = times_of(
        changed(
            energy_kinetic_J=lambda t: np.where(t < 20, 9e9, known_slope.series()["energy_kinetic_J"]),
            speed_mean_m_per_s=lambda t: np.where(
                np.abs(t - 20) < 0.05, 900.0, known_slope.series()["speed_mean_m_per_s"]
            ),
        )
    )
    assert before == pytest.approx(TIMES, abs=1e-9)  # what was before t2 is not of the motion
    assert times_of(until(84.4))["t5"] is None and times_of(until(84.5))["t5"] == pytest.approx(84.5, abs=1e-9)
    late = dataclasses.replace(
        SHIPPED,
        stages=dataclasses.replace(SHIPPED.stages, end=dataclasses.replace(SHIPPED.stages.end, rest_fraction=0.1)),
    )
    # 85.03 − 0.1 · 28.03 s
    assert characteristic_times.of_run(characteristic_times.chosen_rows(known_slope.series(), STATE), late, STATE)[
        "t5"
    ] == pytest.approx(82.3, abs=1e-9)


def missing_of(series, **state):
    state = STATE | state
    return characteristic_times.missing(characteristic_times.chosen_rows(series, state), SHIPPED, state)


def test_times_come_in_their_order_or_say_why_not():
    """The shear force falls to a tenth after the kinetic energy was largest, before and after the slope is at rest; and
    that is largest after it is at rest.
    """
    known = known_slope.series()
    for at in (60.0, 90.0):
        late = changed(dp_shear_N_per_m=lambda t: np.where(t > at, 0.0, 365e6))
        found = times_of(late)
        assert found == pytest.approx(TIMES | {"t3": None}, abs=1e-9)
        assert missing_of(late) == {
            "t3": "the shear force had fallen by 90 % only after the kinetic energy was largest (t4)"
        }
    early = changed(dp_shear_N_per_m=lambda t: np.where(t > 54.0, 0.0, 365e6))
    assert times_of(early)["t3"] == pytest.approx(54.9, abs=1e-9) and missing_of(early) == {}  # just before t4, 55 s
    turns = changed(energy_kinetic_J=lambda t: np.where(np.abs(t - 95) < 0.05, 9e9, known["energy_kinetic_J"]))
    assert (times_of(turns)["t4"], times_of(turns)["t5"]) == (95.0, None) and list(missing_of(turns)) == ["t5"]


def test_each_time_that_did_not_come_has_its_reason():
    known = known_slope.series()
    assert missing_of(known) == {}
    assert missing_of(known, moving=None) == dict.fromkeys(("t1", "t2", "t3", "t4", "t5"), "the slope did not move off")
    dry = missing_of(until(9.0), stage="dry", t0=None, moving=None)
    assert set(dry.values()) == {"the run was stopped before the water began to rise"} and len(dry) == 6
    assert missing_of(changed(weakened_disks=lambda t: 0 * t)) == {"t3": "no slip surface weakened"}
    kept = changed(dp_shear_N_per_m=lambda t: np.full(len(t), 365e6))
    assert missing_of(kept) == {"t3": "the shear force did not fall by 90 %"}
    failed = missing_of(until(84.0), failed_dry=3.0)
    assert failed == dict.fromkeys(("t0", "t1", "t2", "t3"), "the slope moved before the water came") | {
        "t5": "the slope had not come to rest when the run ended"
    }


def test_a_slope_that_does_not_move_has_no_failure():
    nothing = dict.fromkeys(TIMES)
    assert times_of(known_slope.series(), moving=None) == nothing | {"t0": 10.0}
    assert times_of(until(9.0), t0=None, moving=None) == nothing


def test_without_backstop_failure_is_where_it_begins_to_creep():
    """0.02 m/s, or more, for good before t2."""
    creeping = dict(
        fb_normal_N_per_m=lambda t: 0 * t,
        speed_mean_m_per_s=lambda t: np.select(
            [np.abs(t - 22) < 1, (t > 28.95) & (t < 30.45)], [0.1, 0.021], known_slope.series()["speed_mean_m_per_s"]
        ),
    )
    assert times_of(changed(**creeping)) == pytest.approx(TIMES | {"t1": 29.0}, abs=1e-9)
    # a backstop that has borne nothing until then, and one that bears only in the second before
    creeping["fb_normal_N_per_m"] = lambda t: np.where(t > 40, 90e6, 0.0)
    assert times_of(changed(**creeping))["t1"] == pytest.approx(29.0)
    creeping["fb_normal_N_per_m"] = lambda t: np.where(t > 30.45, 90e6, 0.0)
    assert times_of(changed(**creeping))["t1"] == pytest.approx(30.5)
    # no second of the water yet: it does not creep but stands, and moves
    assert times_of(until(10.9), moving=10.3)["t1"] == 10.3


def test_stopped_before_weakening():
    assert times_of(until(34.0)) == {
        "t0": 10.0,
        "t1": pytest.approx(TIMES["t1"]),
        "t2": 30.5,
        "t3": None,
        "t4": 34.0,
        "t5": None,
    }


def test_a_slope_that_failed_dry_has_the_times_of_its_motion():
    """Of all rows: kinetic energy is largest while it settles, at once, and 2 % of 45 m/s are passed at 85.03 − 0.03 ·
    28.03 s.
    """
    assert times_of(known_slope.series(), failed_dry=3.0) == {
        "t0": None,
        "t1": None,
        "t2": None,
        "t3": None,
        "t4": 0.1,
        "t5": pytest.approx(84.2),
    }


# ---- the summary ------------------------------------------------------------------------------------
PASSIVE = toe.passive(SHIPPED, 85.9e3, 37.2, 0.84)
# at t1; means over a second are values half a second before
WATER, BACK, SHEAR = (0.5 * 19.1, 140e6 + 3e6 * (19.1 - 0.45), 440e6 - 3e6 * (19.1 - 0.45))
DRY_BACK, DRY_SHEAR = 140e6 - 0.45e6, 440e6 + 0.9e6
LOST = 9.5e9

#: Each key of summary.json: its answer, and the powers of length, time and mass of 1 m³ of rock by which it grows with
#: a slope's size.
# of the stacks that known_slope piles up: tops 20 m above the plane, middles 17 m below these, and on the floor 30 m
# and once 36 m
CROWN = known_slope.plane(-996.0) + 20.0
STACK = [known_slope.plane(-1000.0 + 12 * k + 4) + 3.0 for k in range(50)]
CENTRE = (11 * sum([21.313 + 13.0] * 39 + [21.313 + 19.0]) + 300.0) / 441
FELL = sum(STACK) / 50 - CENTRE
RAN = (11 * sum(480.0 + 12 * k for k in range(40)) + 990.0) / 441 - (-1000.0 + 12 * 24.5)
KNOWN = {
    "section": ("Jiufengershan", None),
    "verdict": ("failed by water", None),
    "verdict_says": ("the slope failed by water, with the table at 9.55 m; it began to move at 30.5 s", "text"),
    "finished": (True, None),
    "disks": (550, None),
    "contacts_initial": (43000, None),
    "bonds_initial": (41000, None),
    "packing_fraction": (0.84, None),
    "time_step_s": (1e-2, None),
    "path_rel": (0.1, None),
    "steps": (49999, None),
    "simulated_s": (95.0, "time"),
    "wall_s": (321.0, None),
    "wall_packing_s": (12.5, None),
    "threads": (3, None),
    "iterations_mean": ((525 * 10 + 425 * 30) / 950, None),
    "tolerance": (1e-6, None),
    "tolerance_moving": (2e-4, None),
    "residual_p95": (1e-8 * 902.55, None),
    "residual_N_per_m_p95": (3 * 902.55, None),  # of 1 to 950
    "residual_p95_over_tolerance": (
        0.01 * 427.55,
        None,
    ),  # half of the rows have a tolerance 200 times as large, so these and four others are the smallest
    "overlap_worst_rel": (0.03, None),
    "way_worst_rel": (0.4, None),
    "overlap_mean_rel": (0.004, None),
    "failed_dry_s": (None, None),
    "moved_dry_s": (None, None),
    "times_s": (TIMES, "time"),
    "times_missing": ({}, None),
    "water_at_failure_m": (WATER, "length"),
    "water_highest_m": (0.5 * 20.5, "length"),
    "fb_force_dry_N_per_m": (DRY_BACK, "force"),
    "fb_force_at_failure_N_per_m": (BACK, "force"),
    "fb_force_final_N_per_m": (90e6 + 2e6 * 0.95, "force"),  # 98.1 to 100 s
    "fb_force_highest_N_per_m": (199.7e6, "force"),  # at t2
    "bonds_broken_at_failure_rel": (0.0, None),
    "dp_shear_dry_N_per_m": (DRY_SHEAR, "force"),
    "dp_shear_at_failure_N_per_m": (SHEAR, "force"),
    "dp_shear_final_N_per_m": (-20e6 - 1e6 * 9.05, "force"),
    "weakening_begins_s": (WEAKENS, "time"),
    "triggering_s": (8.6, "time"),
    "weakening_s": (4.1, "time"),
    "motion_s": (45.4, "time"),
    "front_travel_m": (1000.5, "length"),
    "centroid_travel_m": (250.0, "length"),
    "speed_max_m_per_s": (61.5, "speed"),
    "speed_mean_max_m_per_s": (30.0, "speed"),
    "deposit_thickness_max_m": (36.0, "length"),
    "deposit_thickness_ground_m": (36.0, "length"),
    # from the top of the first stack on the plane to below the disk in the air, which is more than a thousandth of the
    # disks
    "travel_drop_m": (CROWN - 298.0, "length"),
    "travel_run_m": (992.0 + 1000.0, "length"),
    "travel_angle_deg": (math.degrees(math.atan2(CROWN - 298.0, 1992.0)), None),
    "centroid_drop_m": (FELL, "length"),
    "centroid_run_m": (RAN, "length"),
    "centroid_angle_deg": (math.degrees(math.atan2(FELL, RAN)), None),
    "mixing": (None, None),  # of one layer
    "overturned_m": (0.0, None),
    # it comes to 0.25 m/s at 30.5 s and goes on by 1.123 m/s²; it goes down from 30 m/s by 1.070 m/s² from 57 s on
    "t2_by_speed_s": ({"50": 30.5, "100": 30.5, "200": 30.7, "300": 30.9, "400": 31.0, "500": 31.2}, "time"),
    "t5_by_speed_s": ({"2": 84.5, "5": 83.7, "10": 82.3}, "time"),
    "bulking_factor": (14472 / 12000, None),
    "energy_dissipated_J_per_m": (LOST, "energy"),
    "energy_losses_J_per_m": ({"sliding": 6e9, "rolling": 1e9, "impact": 2e9, "bonds": 0.5e9}, "energy"),
    "sliding_on_walls_J_per_m": ({}, None),  # it has no rows of walls
    "heat_on_walls_J_per_m": ({}, None),
    "energy_correction_rel": (1.9e8 / LOST, None),
    "energy_error_rel": (
        0.01 * (LOST * 40 / 55 + 2e9 + 3e9) / LOST,
        None,
    ),  # at 70 s: losses, kinetic energy and |water|
    "force_stages": (
        dict.fromkeys(force_stages.NAMES)  # it has no forces normal to the plane
        | {
            "backstop_rise": (BACK - DRY_BACK) / (DRY_SHEAR - SHEAR),
            "backstop_span": (199.7e6 - BACK) / BACK,  # up to 30.5 s
            "backstop_swing": -1.0,  # nor peaks
            "backstop_fall": 0.0,  # it does not
            "shear_moving": -20e6 / DRY_SHEAR,
            "shear_final": (-20e6 - 1e6 * 9.55) / DRY_SHEAR,
            "backstop_final": (90e6 + 2e6 * 0.45) / BACK,
        },
        None,
    ),
    "toe_bands": (None, None),  # no snapshots of its failure
    "toe_bands_triggering": (None, None),
    "water_passive_m": (PASSIVE.water_m, "length"),
    "water_at_failure_over_passive": (WATER / PASSIVE.water_m, None),
    "passive_resistance_dry_N_per_m": (PASSIVE.resistance_dry, "force"),
    "passive_force_N_per_m": (PASSIVE.push_N_per_m, "force"),
    "fb_force_at_failure_over_passive": (BACK / PASSIVE.push_N_per_m, None),
}


def near(value, unit=1.0):
    """What a value is expected to be in another unit, to rounding."""
    if isinstance(value, dict):
        return {name: near(one, unit) for name, one in value.items()}
    return pytest.approx(unit * value, rel=SAME) if isinstance(value, float) else value


def summary_of(folder, section=SHIPPED, **state):
    """The summary as its file has it."""
    told = results.summarise(folder, section, STATE | state, threads=3)
    assert json.loads((folder / "summary.json").read_text()) == json.loads(json.dumps(told))
    return told


def assert_known(found, without=(), **other):
    """A summary has the known values, but for ``other``, and no keys besides."""
    wanted = {name: value for name, (value, _) in KNOWN.items() if name not in without} | other
    assert set(found) == set(wanted)
    for name, value in wanted.items():
        assert found[name] == near(value), name


def test_each_key_of_a_summary(tmp_path):
    assert_known(summary_of(known_slope.write(tmp_path)))


def test_the_worst_overlap_is_that_of_all_steps(tmp_path):
    # rows saw a larger one
    assert_known(summary_of(known_slope.write(tmp_path), overlap_worst_ever=0.015), overlap_worst_rel=0.02)


NOT_AT_REST = {"finished": False} | dict.fromkeys(
    (
        "fb_force_final_N_per_m",
        "dp_shear_final_N_per_m",
        "deposit_thickness_max_m",
        "deposit_thickness_ground_m",
        *(name for name in KNOWN if name.startswith(("travel_", "centroid_"))),
        "overturned_m",
        "bulking_factor",
    )
)


def test_a_run_that_goes_on_has_no_end(tmp_path):
    known_slope.write(tmp_path, until(70.0), stop=None)
    share = 40 / 55
    assert_known(
        summary_of(tmp_path, stage="water"),
        **NOT_AT_REST,
        times_s=TIMES | {"t5": None},
        times_missing={"t5": "the slope had not come to rest when the run was stopped"},
        verdict_says=KNOWN["verdict_says"][0] + "; it had not come to rest at 70.0 s, when the run was stopped",
        motion_s=None,
        t5_by_speed_s=dict.fromkeys(KNOWN["t5_by_speed_s"][0]),
        force_stages=KNOWN["force_stages"][0] | dict.fromkeys(("shear_moving", "shear_final", "backstop_final")),
        steps=34999,
        simulated_s=65.0,
        iterations_mean=(525 * 10 + 125 * 30) / 650,
        residual_p95=1e-8 * 617.55,
        residual_N_per_m_p95=3 * 617.55,
        residual_p95_over_tolerance=0.01 * 442.55,
        front_travel_m=1200 - 99.5 * 10 / 25 - 100,
        energy_dissipated_J_per_m=share * LOST,
        energy_correction_rel=1.9e8 / LOST,
        energy_losses_J_per_m={name: share * value for name, value in KNOWN["energy_losses_J_per_m"][0].items()},
        energy_error_rel=0.01 * (LOST * share + 2e9 + 3e9) / (LOST * share),
    )


def test_a_run_that_waits_for_the_water_has_no_failure(tmp_path):
    known_slope.write(tmp_path, until(9.0), start=None, stop=None)
    found = summary_of(tmp_path, stage="dry", t0=None, moving=None, front0=None)
    assert found["times_s"] == dict.fromkeys(TIMES) and found["force_stages"] == dict.fromkeys(force_stages.NAMES)
    for name in (
        "disks",
        "water_at_failure_m",
        "fb_force_dry_N_per_m",
        "dp_shear_dry_N_per_m",
        "front_travel_m",
        "weakening_begins_s",
        "triggering_s",
        "weakening_s",
        "motion_s",
        *NOT_AT_REST,
        "water_at_failure_over_passive",
        "fb_force_at_failure_over_passive",
    ):
        assert not found[name], name
    # nothing has been turned
    assert found["energy_correction_rel"] == found["energy_error_rel"] == found["energy_dissipated_J_per_m"] == 0
    assert found["water_passive_m"] == near(PASSIVE.water_m)  # of the rock, not of the run


def test_a_run_that_failed_dry_is_told_from_its_beginning(tmp_path):
    known_slope.write(tmp_path)
    gone = dict.fromkeys(
        (
            "water_at_failure_m",
            "fb_force_dry_N_per_m",
            "fb_force_at_failure_N_per_m",
            "fb_force_highest_N_per_m",
            "bonds_broken_at_failure_rel",
            "dp_shear_dry_N_per_m",
            "dp_shear_at_failure_N_per_m",
            "water_highest_m",
            "weakening_begins_s",
            "triggering_s",
            "weakening_s",
            "motion_s",
            "bulking_factor",
            "water_at_failure_over_passive",
            "fb_force_at_failure_over_passive",
        )
    )

    def between(low, high):
        """The percentile of a thousand rows, between the 950 since it settled and the 50 before."""
        return low + 0.05 * (high - low)

    assert_known(
        summary_of(tmp_path, failed_dry=3.0),
        **gone,
        force_stages=dict.fromkeys(force_stages.NAMES),
        failed_dry_s=3.0,
        verdict="failed dry",
        verdict_says="the slope failed dry, at 3.0 s: it does not bear its own weight, and nothing here is a failure by water. "
        "Its mean speed came to 45 m/s, its front went 1.05e+03 m, and 0 of 41,000 bonds broke",
        times_missing=dict.fromkeys(("t0", "t1", "t2", "t3"), "the slope moved before the water came"),
        times_s=dict.fromkeys(("t0", "t1", "t2", "t3")) | {"t4": 0.1, "t5": 84.2},
        t2_by_speed_s=dict.fromkeys(KNOWN["t2_by_speed_s"][0]),
        t5_by_speed_s={"2": 84.2, "5": 83.0, "10": 80.9},  # of 45 m/s
        front_travel_m=1050.5,
        centroid_travel_m=math.hypot(210, 180),
        iterations_mean=(50 * 5000 + 525 * 10 + 425 * 30) / 1000,
        speed_max_m_per_s=999.0,
        speed_mean_max_m_per_s=45.0,
        overlap_worst_rel=0.5,
        overlap_mean_rel=0.4,
        residual_p95=between(950e-8, 1.0),
        residual_N_per_m_p95=between(2850.0, 1e9),
        residual_p95_over_tolerance=between(4.75, 1e6),
    )
    # energies are those since it settled, when they begin anew


def test_the_centre_of_mass_has_come_to_where_it_is_in_the_last_row(tmp_path):
    """From (−500, 300) m at t0; the known run moves 200 m and 150 m from there, and 7 m and 3 m more in its last row
    alone.
    """
    series = known_slope.series()
    series["centroid_x_m"][-1] += 7.0
    series["centroid_y_m"][-1] -= 3.0
    found = summary_of(known_slope.write(tmp_path, series))
    assert found["centroid_travel_m"] == near(math.hypot(207, 153))


def test_without_losses_energies_are_of_the_motion(tmp_path):
    still = {name: 0 * values if name in records.LOSSES else values for name, values in known_slope.series().items()}
    found = summary_of(known_slope.write(tmp_path, still))
    assert found["energy_correction_rel"] == near(1.9e8 / 4e9) and found["energy_error_rel"] == near(0.01 * 5e9 / 4e9)
    assert found["energy_dissipated_J_per_m"] == 0


@pytest.mark.filterwarnings("ignore:divide by zero", "ignore:invalid value")
def test_what_is_no_number_is_null(tmp_path):
    found = summary_of(
        known_slope.write(tmp_path, changed(tolerance=lambda t: 0 * t, dp_shear_N_per_m=lambda t: 0 * t))
    )
    assert (
        found["residual_p95_over_tolerance"] is None
        and found["force_stages"]["backstop_rise"] is None
        and found["residual_p95"] == near(KNOWN["residual_p95"][0])
    )


def test_a_rock_without_envelope_is_not_set_beside_its_toe(tmp_path):
    known_slope.write(tmp_path)
    bare = dataclasses.replace(
        SHIPPED, materials={**SHIPPED.materials, "rock": dataclasses.replace(SHIPPED.materials["rock"], envelope=None)}
    )
    dry = dataclasses.replace(SHIPPED, water=None)
    for section in (bare, dry):
        assert set(summary_of(tmp_path, section)) == {name for name in KNOWN if "passive" not in name}


@pytest.mark.parametrize("size", [0.25, 4.0])
def test_a_slope_of_another_size_has_the_same_summary_in_its_units(tmp_path, size):
    """Lengths, times, speeds, forces per metre and energies per metre grow as L, √L, √L, L² and L³ (Froude); all else
    is the same.
    """
    section, time = known_slope.scaled(size)
    units = {"length": size, "time": time, "speed": time, "force": size**2, "energy": size**3, None: 1.0}
    of_columns = {
        "time_s": "time",
        **{name: "length" for name in ("water_m", "front_m", "centroid_x_m", "centroid_y_m")},
        **{name: "speed" for name in ("speed_mean_m_per_s", "speed_max_m_per_s")},
        **{name: "energy" for name in known_slope.COLUMNS if name.startswith("energy") and name.endswith("_J")},
        **{
            name: "force"
            for name in known_slope.COLUMNS
            if name.endswith("N_per_m") and not name.startswith("residual")
        },
    }

    def stretch(made):
        return lambda: {name: size * values if name in "xyr" else values for name, values in made().items()}

    series = {name: units[of_columns.get(name)] * values for name, values in known_slope.series().items()}
    known_slope.write(tmp_path, series, stretch(known_slope.begin), stretch(known_slope.end))
    found = summary_of(
        tmp_path,
        section,
        **{name: time * STATE[name] for name in ("settled", "t0", "moving")},
        front0=size * STATE["front0"],
    )
    assert set(found) == set(KNOWN)
    assert found.pop("verdict_says").startswith(f"the slope failed by water, with the table at {9.55 * size:.4g} m")
    for name, (value, unit) in KNOWN.items():
        if unit == "text":
            continue
        # the toe's height is where two curves cross, found to 2e-12 of a metre
        assert found[name] == (
            pytest.approx(units[unit] * value, rel=1e-7) if "passive" in name else near(value, units[unit])
        ), name


def test_a_toe_is_told_from_snapshots_of_two_times(tmp_path):
    """Of t1 and t3, and of t0 and t2; that of t0 is a file of its own."""
    known_slope.write(tmp_path)
    every = records.read_series(tmp_path / "series.csv")
    (tmp_path / "snapshots").mkdir()
    for name in ("t1", "t2", "t3"):
        row = int(np.argmin(np.abs(every["time_s"] - TIMES[name])))
        records.write_snapshot(
            tmp_path / "snapshots" / f"{int(every['step'][row]):08d}.npz",
            time_s=float(every["time_s"][row]), step=int(every["step"][row]), water_m=0.0, **known_slope.begin(),
        )  # fmt: skip
    seen = results.while_it_fails(tmp_path, every, TIMES)
    assert [s.time_s for s in seen] == [TIMES["t1"], TIMES["t3"]]
    seen = results.while_it_fails(tmp_path, every, TIMES, "t0", "t2")
    assert [s.time_s for s in seen] == [0.0, TIMES["t2"]]  # its file says nothing of its time here
    for name, between in (("t3", ()), ("t0", ("t0", "t2")), ("t2", ("t0", "t2"))):
        assert results.while_it_fails(tmp_path, every, TIMES | {name: None}, *between) is None
    # the fifty stacks there are too far up the slope to be a toe
    found = summary_of(tmp_path)
    for name in ("toe_bands", "toe_bands_triggering"):
        assert found[name] == {
            "towards_foot": None,
            "conjugate": None,
            "both_conjugate": None,
            "rankine_deg": pytest.approx(45 - 37.2 / 2),
        }
