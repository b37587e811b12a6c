"""A slope from its first step to its rest within seconds: what it does, and every column of its series recomputed by
hand.
"""
import numpy as np
import pytest
from by_hand import Known
from yade.nonsmooth import records
from yade.nonsmooth.studies.slope import frames
from yade.nonsmooth.studies.slope.columns import COLUMNS


def test_it_settles_gets_wet_fails_weakens_moves_and_rests(whole):
    s, times = whole.series, whole.summary["times_s"]
    assert whole.summary["finished"] is True and whole.state["stage"] == "done" and whole.state["failed_dry"] is None
    assert (
        None not in times.values()
        and times["t0"] < times["t1"] <= times["t2"] < times["t3"] < times["t4"] < times["t5"]
    )
    assert set(s["stage"]) == {0, 1, 2} and (np.diff(s["stage"]) >= 0).all()
    for name, least in (
        ("wet_disks", 50),
        ("released_disks", 50),
        ("weakened_disks", 10),
        ("speed_max_m_per_s", 3.0),
        ("water_m", 0.5),
        ("slip_mean_dp_m", 0.5),
    ):
        assert s[name].max() > least, name
    assert (
        np.abs(s["ss_normal_N_per_m"]).max() > 1e4
        and np.abs(s["fb_normal_N_per_m"]).max() > 1e4
        and s["dp_water_N_per_m"].max() > 1e5
    )
    for mode in ("tension", "shear", "torque", "mixed"):
        assert s[f"bonds_broken_{mode}"][-1] > 0, mode
    assert s["speed_mean_m_per_s"][-1] < 0.03 * s["speed_mean_m_per_s"].max()
    gravity, time = whole.watch.steps.gravity[:, 1], whole.watch.steps.time - whole.watch.steps.dt
    # it grows, and then it is whole
    assert gravity[2:] == pytest.approx(-9.81 * np.minimum(time[2:] / 0.3, 1), rel=1e-9)
    steps = np.diff(s["step"])
    # rows of 0.02 s, steps of 5 ms and shorter ones where disks are fast
    assert set(steps[s["stage"][1:] < 2]) == {4} and steps.max() > 4


#: Relative to the column's largest value; where not rounding of sums over thousands of steps, the reason stands beside.
CLOSE = {
    "slip_mean_dp_m": 1e-9,
    "energy_water_J": 1e-9,
    "energy_sliding_J": 1e-9,
    "energy_rolling_J": 1e-9,
    "energy_impact_J": 1e-9,
    "energy_bonds_J": 1e-9,
    "energy_error_rel": 1e-7,  # of a sum that cancels
    "energy_correction_J": 1e-6,
    "residual": 1e-6,
    "residual_N_per_m": 1e-6,  # velocities are computed anew, in another order of contacts
}


def test_every_column_is_recomputed(whole):
    assert set(whole.series) == set(COLUMNS) == {name for name in vars(Known) if name in COLUMNS}


@pytest.mark.parametrize("name", COLUMNS)
def test_a_column_is_what_the_steps_say(known, name):
    found, expected = known.series[name], getattr(known, name)()
    if COLUMNS[name].integer:
        assert np.array_equal(found, expected), np.flatnonzero(found != expected)[:5]
    else:
        assert np.abs(found - expected).max() <= CLOSE.get(name, 1e-9) * np.abs(expected).max(), np.argmax(
            np.abs(found - expected)
        )


def test_snapshots_tell_who_is_wet_released_and_weakened(whole, known):
    """Disk by disk, by hand from the steps; some that have gone the distance were never below the table, and are not
    released.
    """
    by_hand = {name: getattr(known, name)()[known.last] for name in ("wet", "ever_wet", "released", "moved")}
    weakened, seen = known.weakened(), np.zeros(3, int)
    for path in sorted((whole.folder / "snapshots").glob("*.npz")):
        shot = records.read_snapshot(path)
        (row,) = np.flatnonzero(whole.series["step"] == shot.step)
        for name in ("wet", "ever_wet", "released"):
            assert np.array_equal(getattr(shot, name), by_hand[name][row]), (name, shot.step)
        assert shot.weakened.shape == (315, 1) and np.array_equal(shot.weakened[:, 0], weakened[row]), shot.step
        assert shot.weakened.sum() == whole.series["weakened_disks"][row]
        seen += [shot.released.sum(), shot.weakened.sum(), (by_hand["moved"][row] & ~shot.ever_wet).sum()]
    assert (seen > 0).all() and not (shot.wet & shot.released).any()


def test_the_characteristic_times_have_snapshots_of_their_own(whole):
    """To the row; besides these there are those of every fifth row alone."""
    times = {name: t for name, t in whole.summary["times_s"].items() if name != "t0"}
    shots = frames.of_run(whole.folder, whole.series)
    for name, t in times.items():
        assert abs(records.read_snapshot(frames.nearest(shots, t)).time_s - t) < 1e-9, name
    even = frames.regular(shots, whole.series, whole.section, None)
    assert len(shots) > len(even) and {t for t, _ in shots} == {t for t, _ in even} | set(times.values())
    # rows of 0.02 s, met to half a step of 5 ms
    assert np.diff([t for t, _ in even]) == pytest.approx(0.1, abs=0.0051)
