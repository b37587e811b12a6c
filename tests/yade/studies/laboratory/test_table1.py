"""The command that lays our strengths beside the paper's Table 1: from made-up tests of known strength to each figure,
its interval and its place.
"""

import json
import math

import pytest
from yade.nonsmooth.laboratory import biaxial_test, campaign, table1, wall_shear

C, ANGLE = 90e3, math.radians(37.0)
SEEDS = (1, 2, 3)


def major(minor, cohesion):
    """σ₁ at failure."""
    k = math.tan(math.pi / 4 + ANGLE / 2)
    return minor * k * k + 2 * cohesion * k


@pytest.fixture
def told(tmp_path, monkeypatch):
    """The cohesion grows by 2 kPa a seed; residual strengths are a tenth; walls have the friction of their material,
    and a cohesion of 10 kPa times the seed if bonded.
    """
    asked = {}

    def tested(tests, out, threads, resume, progress):
        asked["tests"] = (tests, out, threads, resume)
        progress(1.0, "tests")
        return [
            {
                "confining_Pa": t.confining,
                "seed": t.shape.seed,
                "sigma3_peak_Pa": t.confining,
                "sigma1_peak_Pa": major(t.confining, C + 2e3 * t.shape.seed),
                "sigma3_residual_Pa": t.confining,
                "sigma1_residual_Pa": major(t.confining, 0.1 * C),
                "residual_between_strains": [0.05, 0.1],
            }
            for t in tests
        ]

    def slid(tests, out, threads, resume, progress):
        asked["slides"] = (tests, out, threads, resume)
        progress(1.0, "slides")
        found = []
        for t in tests:
            cohesion = 10e3 * t.seed * t.material.bonded
            found.append(
                wall_shear.SlideResult(
                    t.pressure,
                    cohesion + t.material.friction * t.pressure,
                    t.pressure,
                    t.material.residual_friction * t.pressure,
                    0.9,
                    100,
                )
            )
        return found

    monkeypatch.setattr(campaign, "run", tested)
    monkeypatch.setattr(wall_shear, "run", slid)
    shares = []
    found = table1.run(
        tmp_path,
        77,
        SEEDS,
        [4e6, 1e6],
        (1, 3),
        (1e6, 2e6),
        0.1,
        "wwr",
        5,
        True,
        lambda share, doing: shares.append(share),
    )
    assert shares == [0.9, 1.0]
    return found, asked, tmp_path


def test_tests_are_those_that_were_asked_for(told):
    _, asked, out = told
    tests, where, threads, resume = asked["tests"]
    assert [(t.confining, t.shape.seed, t.shape.count, t.strain, t.shape.friction) for t in tests] == [
        (p, seed, 77, 0.1, 0.0) for seed in SEEDS for p in (1e6, 4e6)
    ]
    assert (
        (where, threads, resume) == (out / "rock", 5, True)
        and isinstance(tests[0], biaxial_test.BiaxialTest)
        and tests[0].material.name == "wwr"
    )
    slides, where, threads, resume = asked["slides"]
    assert (where, threads, resume) == (out / "walls", 5, True) and len({t.name for t in slides}) == len(
        slides
    ) == 4 * 2 * 2
    bonded = next(t.material for t in slides if t.material.name == "dp-bonded")
    assert (
        bonded.bonded
        and bonded.tensile_strength == 1e5
        and not next(t.material for t in slides if t.material.name == "dp").bonded
    )


def test_each_figure_is_in_its_place_with_its_interval(told):
    rows = {(one["row"], one["figure"]): (one["mean"], one["half_95"], one["paper"]) for one in told[0]["rows"]}
    # three seeds of 92, 94 and 96 kPa: 2/√3 times Student's 4.303; the envelope's fit is exact
    assert rows["WWR", "cohesion_peak"] == pytest.approx((94.0, 4.30265 * 2 / math.sqrt(3), 88.0), rel=1e-5)
    assert rows["WWR", "friction_peak"] == pytest.approx((37.0, 0.0, 38.5), abs=1e-6) and rows[
        "WWR", "cohesion_residual"
    ] == pytest.approx((9.0, 0.0, 13.0), abs=1e-6)
    # two seeds of 10 and 30 kPa: 10 times 12.706
    assert rows["FB", "cohesion_peak"] == pytest.approx((20.0, 127.062, 70.0), rel=1e-5) and rows[
        "DP, bonded", "cohesion_peak"
    ][0] == pytest.approx(20.0)
    for row, peak, residual in (
        ("DP", 0.3, 0.3),
        ("DP, bonded", 0.3, 0.3),
        ("FB", 0.7, 0.5),
        ("SS", 0.2, 0.2),
    ):  # the paper's coefficients
        assert rows[row, "friction_peak"][0] == pytest.approx(math.degrees(math.atan(peak))) and rows[
            row, "friction_residual"
        ][0] == pytest.approx(math.degrees(math.atan(residual)))
    assert (
        rows["DP", "cohesion_peak"][2] is None
        and rows["SS", "friction_peak"][2] is None
        and rows["SS", "friction_residual"][2] == 11.3
    )
    assert json.loads(json.dumps(told[0]))["rows"] == told[0]["rows"]


def test_the_papers_numbers_are_those_of_its_table_1():
    """Effective cohesion [kPa] and friction [°], largest and residual; a dash of the table is a number that is not
    there. The second row of DP is the same with the table's cohesion.
    """
    whole = ("cohesion_peak", "friction_peak", "cohesion_residual", "friction_residual")
    assert table1.PAPER == {
        "WWR": dict(zip(whole, (88, 38.5, 13, 26.2))),
        "DP": dict(zip(whole[1:], (16.7, 0, 16.7))),
        "DP, bonded": dict(zip(whole, (30, 16.7, 0, 16.7))),
        "FB": dict(zip(whole, (70, 35, 0, 26.6))),
        "SS": dict(zip(whole[2:], (0, 11.3))),
    }


def test_a_table_has_a_line_for_each_row(told):
    heads, rows = table1.table(told[0]["rows"])
    assert [row[0] for row in rows] == list(table1.PAPER) and all(len(row) == len(heads) == 5 for row in rows)
    assert rows[0][1] == "94.0 ± 5.0 (88)" and rows[4][2] == "11.3 ± 0.0 (–)"
    short = [
        {**one, "mean": None, "half_95": None}
        if one["figure"].endswith("residual")
        else {**one, "half_95": None, "mean": -0.01}
        for one in told[0]["rows"]
    ]
    assert table1.table(short)[1][0][1:] == ["0.0 (88)", "0.0 (38.5)", "not measured", "not measured"]
