"""The figure of sliding blocks, read from its artists. Needs no YADE."""

import numpy as np
import pytest

import drawn
import synthetic_slope as synthetic

figures, records = synthetic.load("figures.sliding_block"), synthetic.load("records")


def course(**more):
    t = np.linspace(0.1, 1, 10)
    told = {"time_s": t, "slip_m": 2 * t, "speed_m_per_s": 3 * t, "normal_stress_Pa": np.full(10, 4e6)}
    return {**told, "strength_Pa": np.linspace(2e6, 1e6, 10), **more}


def test_strength_and_speed_of_a_block_without_heat():
    one = course()
    fig = figures.sliding_block([("dry", one)], closed_forms=[("known", [0, 1], [1, 0.5])])
    strength, speed = fig.axes
    assert np.allclose(drawn.points(drawn.line(strength, "dry")).T, (one["slip_m"], one["strength_Pa"] / 2e6))
    assert np.allclose(drawn.points(drawn.line(strength, "known")).T, ([0, 1], [1, 0.5]))
    assert np.allclose(drawn.points(speed.lines[0]).T, (one["time_s"], one["speed_m_per_s"]))
    assert strength.get_xlabel() == "slip [m]" and speed.get_xlabel() == "time [s]"


def test_temperature_and_pressure_where_there_are_some():
    warm = course(temperature_degC=np.linspace(20, 60, 10))
    wet = course(temperature_degC=np.linspace(20, 30, 10), pressure_Pa=np.linspace(0, 2e6, 10))
    fig = figures.sliding_block([("dry", course()), ("warm", warm), ("wet", wet)])
    strength, _, temperature, pressure = fig.axes
    assert len(temperature.lines) == 2 and len(pressure.lines) == 1
    assert drawn.colour(pressure.lines[0]) == drawn.colour(drawn.line(strength, "wet"))
    assert np.allclose(drawn.points(pressure.lines[0])[:, 1], wet["pressure_Pa"] / 4e6)
    assert np.allclose(drawn.points(temperature.lines[0])[:, 1], warm["temperature_degC"])
    assert len(figures.sliding_block([("warm", warm)]).axes) == 3


def test_what_cannot_be_drawn_is_refused():
    with pytest.raises(records.RecordsError, match="there is no block to draw"):
        figures.sliding_block([])
    with pytest.raises(records.RecordsError, match="speed_m_per_s"):
        figures.sliding_block([("x", {k: v for k, v in course().items() if k != "speed_m_per_s"})])
    with pytest.raises(records.RecordsError, match="give a list of cases"):
        figures.sliding_block([course()])
