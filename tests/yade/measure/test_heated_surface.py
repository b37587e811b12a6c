"""How a slip surface loses its strength, from made-up series and cells. Needs no YADE."""
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import synthetic_slope as synthetic  # noqa: E402

heated, records = synthetic.load("measure.heated_surface"), synthetic.load("records")
near = dict(rel=1e-9)  # rounding


def series(**changes):
    """A row each second. The slope settles for 5 s, with a speed and a slip of its own; from t = 10 s on it moves by
    2 (t - 10) m/s until 15 s, its slip is (t - 10)² m, and its friction falls by 30 % a second.
    """
    t = np.arange(0.0, 21.0)
    late, settling = np.maximum(t - 10, 0), t < 5
    found = {
        "time_s": t,
        "step": np.arange(21),
        "stage": np.where(settling, 0, 2),
        "speed_mean_m_per_s": np.where(settling, 50.0, np.where(late < 5, 2 * late, 20 - 2 * late)),
        "cells_slip_m": np.where(settling, 9.0, late**2),
        "cells_friction_rel": np.where(settling, 0.01, np.maximum(1 - 0.3 * late, 0.04)),
    }
    return found | {name: change(t) for name, change in changes.items()}


def test_it_begins_where_the_mean_speed_passes_a_tenth_of_a_metre_per_second():
    """2 m/s² times 0.05 s, after 10 s; what came before it, and was slower again, does not count, nor does what
    follows the fastest row.
    """
    assert heated.begin(series()) == pytest.approx(10.05, **near)
    speed = series()["speed_mean_m_per_s"]
    early = series(speed_mean_m_per_s=lambda t: np.where(t == 7, 1.5, speed))
    assert heated.begin(early) == pytest.approx(10.05, **near)
    again = series(speed_mean_m_per_s=lambda t: np.where(t == 18, 0.0, speed))
    assert heated.begin(again) == pytest.approx(10.05, **near)
    assert heated.begin(series(speed_mean_m_per_s=lambda t: np.where(t < 5, speed, 0.099))) is None
    # nor is known when a slope began that moved as soon as it had settled
    assert heated.begin(series(speed_mean_m_per_s=lambda t: np.where(t < 5, speed, t))) is None


@pytest.mark.parametrize("share, late", [(0.7, 1.0), (0.55, 1.5), (0.1, 3.0), (0.05, 3 + 0.05 / 0.06)])
def test_strength_is_lost_between_two_rows(share, late):
    """In each of which slip is a line: between 1 and 4 m, and between 9 and 16 m."""
    found = heated.lost(series(), share)
    low = int(late + 1e-9)
    slip = low**2 + (late - low) * (2 * low + 1)
    assert found == pytest.approx(
        {"time_s": 10 + late, "after_s": late - 0.05, "slip_m": slip, "speed_m_per_s": 2 * late}, **near
    )
    assert heated.lost(series(), 0.03) is None


CELLS = {
    "time_s": np.repeat([13.0, 13.2, 14.0], 3),
    "wall": np.array(["a", "a", "b"] * 3),
    "length_m": np.array([1.0, 3.0, 4.0] * 3),
    "temperature_degC": np.array([10.0, 20, 90, 30, 50, 95, 70, 70, 99]),
    "hottest_degC": np.array([15.0, 25, 99, 35, 80, 99, 75, 75, 99]),
    "cell": np.array([0, 1, 0] * 3),
    "slip_m": np.array([0.0, 0, 0, 5, 1, 9, 12, 2, 9]),
    "friction": np.array([0.4, 0.4, 0.4, 0.1, 0.3, 0.01, 0.03, 0.2, 0.01]),
}


def test_cells_come_to_a_share_each_by_itself():
    """Of two cells of wall a one has less than half, from the second row on; the one of wall b less than a tenth."""
    assert heated.of_cells(CELLS, ["a"], 0.5) == {"share": 0.5, "slip_m": 5.0, "temperature_degC": 30.0}
    found = heated.of_cells(CELLS, ["a", "b"], 0.1)
    assert found == pytest.approx({"share": 2 / 3, "slip_m": 10.5, "temperature_degC": 82.5}, **near)
    assert heated.of_cells(CELLS, ["a"], 0.05) is None


@pytest.mark.parametrize(
    "time, walls, mean, high",
    [(13.05, ["a"], 17.5, 25), (13.11, ["a"], 45, 80), (99, ["a"], 70, 75), (13.2, ["a", "b"], 70, 99)],
)
def test_temperatures_are_those_of_the_nearest_row_on_these_walls(time, walls, mean, high):
    assert heated.temperatures(CELLS, walls, time) == pytest.approx((mean, high), **near)


def test_numbers_of_a_run():
    found = heated.numbers(series(), CELLS, ["a"])
    assert list(found) == ["friction_rel"] + [
        f"{name}_{percent}"
        for percent in (50, 10, 5)
        for name in (
            *("after_s", "slip_m", "speed_m_per_s", "temperature_degC", "hottest_degC"),
            *("cells_share", "cells_slip_m", "cells_temperature_degC"),
        )
    ]
    assert [found[f"cells_{name}_50"] for name in ("share", "slip_m", "temperature_degC")] == [0.5, 5.0, 30.0]
    assert found["friction_rel"] == 0.04
    assert [found[f"{name}_10"] for name in ("after_s", "slip_m", "speed_m_per_s")] == pytest.approx(
        [2.95, 9, 6], **near
    )
    assert (found["temperature_degC_10"], found["hottest_degC_10"]) == (17.5, 25.0)  # at 13 s
    assert (found["temperature_degC_5"], found["hottest_degC_5"]) == (70.0, 75.0)
    stiff = heated.numbers(series(cells_friction_rel=lambda t: 1.0 - 0.3 * (t > 12)), CELLS, ["a"])
    assert stiff.pop("friction_rel") == pytest.approx(0.7)
    assert {value for name, value in stiff.items() if not name.startswith("cells_")} == {None}
    cold = CELLS | {name: np.full(9, np.nan) for name in ("temperature_degC", "hottest_degC")}
    found = heated.numbers(series(), cold, ["a"])
    assert found["temperature_degC_10"] is None and found["after_s_10"] is not None


@pytest.mark.parametrize("walls, wrong", [(["a", "c"], "'c'"), ("a", "'a'"), ("ab", "'ab'")])
def test_a_wall_that_has_no_cells_is_refused(walls, wrong):
    for ask in (lambda: heated.numbers(series(), CELLS, walls), lambda: heated.temperatures(CELLS, walls, 13.0)):
        with pytest.raises(records.RecordsError, match=f"^walls: {wrong}: give a list of walls that have cells: a, b$"):
            ask()
    # also where nothing is weak enough to ask for temperatures
    with pytest.raises(records.RecordsError, match="^walls: "):
        heated.numbers(series(cells_friction_rel=lambda t: 1 + 0 * t), CELLS, walls)


def test_a_series_without_cells_is_refused():
    plain = {name: values for name, values in series().items() if not name.startswith("cells")}
    assert heated.begin(plain) == heated.begin(series())  # which any slope has
    for ask in (heated.rows, lambda s: heated.lost(s, 0.1)):
        with pytest.raises(
            records.RecordsError, match="no column cells_slip_m; give that of a slope whose slip surface has"
        ):
            ask(plain)


def test_what_are_no_cells_is_refused():
    with pytest.raises(records.RecordsError, match="no column wall; give those of slip_surface.csv"):
        heated.numbers(series(), {"DP": {}}, ["DP"])
