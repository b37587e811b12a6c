"""A block on a cell of a slip surface: its motion for laws whose answer is known, when it is left, and the command."""

import csv
import json
import math
from types import SimpleNamespace

import numpy as np
import pytest
from yade.nonsmooth.slip import block, parameter_sets
from yade.nonsmooth.slip.laws import SlipError, SlipLaw

STEEP = dict(dip=30, depth=20, density=2000)
SLIDES = 9.81 * (math.sin(math.radians(30)) - 0.2 * math.cos(math.radians(30)))  # [m/s²] with f = 0.2


def test_a_block_slides_as_coulomb_says():
    course = block.slide(SlipLaw("none", friction=0.2), block.OnSlope(**STEEP, speed=1.5), 0.01, block.Until(time=2))
    t = 0.01 * np.arange(1, 201)
    assert np.allclose(course["time_s"], t) and np.allclose(course["speed_m_per_s"], 1.5 + SLIDES * t)
    assert np.allclose(course["slip_m"], 1.5 * t + SLIDES * t**2 / 2)  # exact for a constant acceleration
    strength = 0.2 * 20 * 2000 * 9.81 * math.cos(math.radians(30))
    assert np.allclose(course["strength_Pa"], strength)
    assert np.allclose(course["heat_J_per_m2"], strength * course["slip_m"])
    assert list(course) == list(block.COLUMNS)[:6]


def test_a_block_stops_where_friction_holds_it_and_does_not_slide_up():
    course = block.slide(SlipLaw("none", friction=0.8), block.OnSlope(**STEEP, speed=1.0), 1e-3, block.Until(time=9))
    slows = 9.81 * (0.8 * math.cos(math.radians(30)) - math.sin(math.radians(30)))
    assert course["speed_m_per_s"][-1] == 0 and abs(course["time_s"][-1] - 1 / slows) <= 1e-3
    assert abs(course["slip_m"][-1] - 0.5 / slows) < 1e-3
    stays = block.slide(SlipLaw("none", friction=0.8), block.OnSlope(**STEEP), 1e-3)
    assert len(stays["slip_m"]) == 1 and stays["slip_m"][0] == 0


def test_strength_that_is_lost_lets_it_fall_freely():
    law = SlipLaw("step", friction=0.2, critical_slip=1.0)
    course = block.slide(law, block.OnSlope(**STEEP), 1e-3, block.Until(time=3))
    lost = int(np.argmax(course["strength_Pa"] == 0))
    assert course["slip_m"][lost - 1] >= 1.0 > course["slip_m"][lost - 2]  # strength is that before the step
    gains = np.diff(course["speed_m_per_s"][lost:])
    assert np.allclose(gains, 1e-3 * 9.81 * math.sin(math.radians(30)))


def test_a_driven_block_keeps_its_speed_and_is_left_where_it_was_said():
    law = SlipLaw("linear", friction=0.5, critical_slip=4.0)
    course = block.slide(law, block.Driven(2.0, 1e6), 0.01, block.Until(slip=1.0))
    assert np.all(course["speed_m_per_s"] == 2) and abs(course["slip_m"][-1] - 1.0) < 0.021
    half = block.slide(law, block.Driven(2.0, 1e6), 0.01, block.Until(share=0.5))
    assert half["strength_Pa"][-1] < 0.25e6 <= half["strength_Pa"][-2]
    assert len(block.slide(law, block.Driven(2.0, 1e6), 0.01, block.Until(time=0.5))["slip_m"]) == 50


@pytest.mark.parametrize(
    "wrong, said",
    [
        (lambda: block.OnSlope(90, 1, 1), "dip 90: give degrees"),
        (lambda: block.OnSlope(20, 0, 1), "depth 0: give a number above 0"),
        (lambda: block.OnSlope(20, 1, math.nan), "density nan"),
        (lambda: block.OnSlope(20, 1, 1, -1), "speed -1: give 0 or a number above"),
        (lambda: block.Driven(0, 1), "speed 0: give a number above 0"),
        (lambda: block.Driven(1, -1), "normal_stress -1"),
        (lambda: block.Until(time=0), "time 0: give seconds"),
        (lambda: block.Until(slip=-1), "slip -1: give metres"),
        (lambda: block.Until(share=1), "share 1: give a share"),
        (lambda: block.slide(SlipLaw("none", friction=0), block.Driven(1, 1), 0), "step 0: give seconds"),
        (
            lambda: block.slide(SlipLaw("none", friction=0), block.Driven(1, 1), 1e-7),
            "step 1e-07: 6e\\+08 steps to 60 s",
        ),
    ],
)
def test_what_makes_no_sense_is_refused(wrong, said):
    with pytest.raises(SlipError, match=said):
        wrong()


@pytest.mark.parametrize(
    "name, own",
    [
        ("vaiont", ("temperature_degC", "hottest_degC", "pressure_Pa", "vapour")),
        ("calcite", ("temperature_degC", "hottest_degC", "reacted")),
        ("gabbro", ("temperature_degC", "hottest_degC", "melt_m")),
        ("silica_gel", ()),
    ],
)
def test_a_series_has_what_its_law_has(name, own):
    course = block.slide(parameter_sets.law(name), block.Driven(1.0, 1e6), 0.01, block.Until(time=0.1))
    assert tuple(course)[6:] == own


def test_gabbro_melts_as_the_paper_quotes_it():
    """Paragraph 96: friction about 1, then 0.5 with a layer of 0.13 mm, at 0.85 m/s and some MPa."""
    course = block.slide(parameter_sets.law("gabbro"), block.Driven(0.85, 1.5e6), 2e-3, block.Until(time=100))
    friction = course["strength_Pa"] / 1.5e6
    assert friction[0] == pytest.approx(0.8) and friction.max() == pytest.approx(1.0)
    assert friction[-1] == pytest.approx(0.5, abs=0.01) and course["melt_m"][-1] == pytest.approx(0.13e-3, rel=0.02)
    assert course["hottest_degC"][-1] > course["temperature_degC"][-1] == pytest.approx(1100)


# ---- the command ------------------------------------------------------------------------------------


@pytest.fixture
def ran(in_process, tmp_path):
    """Calls the command with words: what it said, its folder, and the summary."""

    def run(*words):
        done = in_process("sliding_block.py", *words, "--out", tmp_path)
        assert done.status == 0, done.err
        return SimpleNamespace(
            out=done.out, folder=tmp_path, summary=json.loads((tmp_path / "summary.json").read_text())
        )

    return run


def test_the_command_writes_series_summary_and_figure(ran):
    done = ran("--set", "vaiont", "--dip", 22, "--share", 0.009)
    with open(done.folder / "block.csv") as file:
        rows = list(csv.DictReader(file))
    shares = done.summary["vaiont"]["shares"]
    assert float(rows[-1]["slip_m"]) == done.summary["vaiont"]["end"]["slip_m"]
    assert shares["0.01"]["slip_m"] == pytest.approx(5.936, rel=0.01)  # as the check of a zone that leaks has it
    assert 1.7 < shares["0.5"]["time_s"] < 1.9 and rows[0]["step"] == "1" and rows[0]["temperature_degC"]
    assert (done.folder / "block.png").stat().st_size > 10000
    assert "vaiont: " in done.out and "1% at 5.9" in done.out


def test_several_sets_have_a_series_each(ran):
    done = ran("--set", "lucas", "slow_decay", "--time", 0.5)
    assert {path.name for path in done.folder.glob("*.csv")} == {"block-lucas.csv", "block-slow_decay.csv"}
    assert done.summary["lucas"]["shares"]["0.1"] is None


def test_laws_that_share_a_zone_go_together(ran):
    values = "friction=0.6 thickness=0.005 heat_capacity=2.7e6 thermal_diffusivity=5e-7 hydraulic_diffusivity=1e-6"
    flash = "pressurization_coefficient=1e5 weakened_friction=0.12 weakening_temperature=915 asperity_slip=5e-6"
    values = [*values.split(), *flash.split(), "contact_strength=3e9"]
    done = ran("--law", "thermal_pressurization", "flash_heating", "--value", *values, "--time", 1)
    end = done.summary["thermal_pressurization+flash_heating"]["end"]
    assert end["pressure_Pa"] > 0 and end["strength_Pa"] < 0.22e6  # 0.2189 of 1 MPa, less the pressure


def test_the_command_tells_laws_and_sets(in_process):
    done = in_process("sliding_block.py", "--list")
    assert done.status == 0 and "hydraulic_diffusivity" in done.out and "--set vaiont: " in done.out
    assert "0.01 (fitted: to 5 m of slip" in done.out
