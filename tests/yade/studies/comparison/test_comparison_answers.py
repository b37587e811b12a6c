"""The sentences with which a comparison answers its questions, word by word, for made-up summaries. Needs no YADE."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import synthetic_slope as synthetic  # noqa: E402

answers = synthetic.load("studies.comparison.answers")


# ---- numbers ----------------------------------------------------------------------------------------
@pytest.mark.parametrize("unit", ["N/m", "Pa", "N"])
def test_a_force_or_a_pressure_has_the_prefix_that_leaves_one_to_three_digits_before_the_point(unit):
    """Just below, at and above each power of a thousand, with either sign."""
    for power, prefix, below in ((3, "k", ""), (6, "M", "k"), (9, "G", "M"), (12, "T", "G")):
        for sign in (1, -1):
            value, minus = sign * 10.0**power, "-" * (sign < 0)
            assert answers.number(value, unit) == f"{minus}1 {prefix}{unit}"
            assert answers.number(2.5 * value, unit) == f"{minus}2.5 {prefix}{unit}"
            assert answers.number(0.5 * value, unit) == f"{minus}500 {below}{unit}"
    assert answers.number(0.0, unit) == f"0 {unit}" and answers.number(0.02, unit) == f"0.02 {unit}"
    assert answers.number(4.0e15, unit) == f"4000 T{unit}"  # no prefix beyond that


@pytest.mark.parametrize(
    "value, unit, digits, text",
    [
        (None, "m", 3, "not known"),
        (None, "Pa", 2, "not known"),
        (2.0e5, "m", 3, "200000 m"),  # metres have no prefix
        (12345.0, "m", 3, "12345 m"),
        (0.0123456, "m", 3, "0.0123 m"),
        (0.0123456, "m", 2, "0.012 m"),
        (1.5e6, "m", 3, "1.5e+06 m"),  # a million and more, and less than a thousandth, as powers
        (0.001, "m", 3, "0.001 m"),
        (1.25e-5, "m", 3, "1.25e-05 m"),
        (0.5, "1", 3, "0.5"),  # a ratio has no unit
        (0.5, "", 3, "0.5"),
    ],
)
def test_a_number_is_written_for_a_reader(value, unit, digits, text):
    assert answers.number(value, unit, digits) == text


@pytest.mark.parametrize(
    "mean, sd, unit, text",
    [
        (196e6, 2.54e6, "N/m", "196 ± 2.5 MN/m"),
        (1.5e9, 2e6, "Pa", "1.5 ± 0.002 GPa"),  # in the mean's unit
        (-30e3, 41.0, "N", "-30 ± 0.041 kN"),
        (9.55, 0.234, "m", "9.55 ± 0.23 m"),
        (0.25, 0.03, "1", "0.25 ± 0.03"),
        (4.0, None, "m", "4 m"),  # of one run
        (None, None, "m", "not known"),
        (None, 1.0, "m", "not known"),
    ],
)
def test_a_mean_and_its_deviation_have_one_unit(mean, sd, unit, text):
    assert answers.spread(mean, sd, unit) == text


# ---- whether both worlds agree ------------------------------------------------------------------------
def quantity(
    agree, hard=(9.0, 10.0, 11.0), soft=(9.0, 11.0, 10.0), means="the water table at failure", unit="m", **other
):
    """A quantity of a summary: 10 ± 1 hard, 10.5 ± 2 soft, a difference of 0.5 ± 0.25 and a scatter of 1.5, in
    ``unit``; ``hard`` and ``soft``: a value a seed.
    """
    return {
        "means": means,
        "unit": unit,
        "hard": {"mean": 10.0, "sd": 1.0, "values": list(hard)},
        "soft": {"mean": 10.5, "sd": 2.0, "values": list(soft)},
        "difference": 0.5,
        "difference_95": 0.25,
        "scatter": 1.5,
        "agree": agree,
    } | other


def same(*quantities, **summary):
    names = [f"q{k}" for k in range(len(quantities))]
    return answers.answer_same({"seeds": [1, 2, 3], "quantities": dict(zip(names, quantities)), **summary}, names)


@pytest.mark.parametrize(
    "agree, verdict, words",
    [
        (True, "yes", "they differ by no more than two packings do"),
        (False, "no", "they differ"),
        (None, "not told", "more seeds are needed to tell"),
    ],
)
def test_whether_a_quantity_agrees_is_said_with_its_numbers(agree, verdict, words):
    assert same(quantity(agree)) == (
        verdict,
        [
            "The water table at failure: 10 ± 1 m hard, 10.5 ± 2 m soft. The difference of the same packings is 0.5 m ± 0.25 m (95 % confidence), "
            f"the scatter over seeds 1.5 m: {words}."
        ],
    )


def test_the_verdict_is_of_all_quantities():
    yes, no, untold = (quantity(agree) for agree in (True, False, None))
    for quantities, verdict in (
        ((yes, yes), "yes"),
        ((no, no), "no"),
        ((yes, no), "in part"),
        ((no, yes), "in part"),
        ((yes, untold), "not told"),
        ((no, untold), "not told"),
        ((untold, yes, no), "not told"),
    ):
        found, sentences = same(*quantities)
        assert found == verdict and len(sentences) == len(quantities)


def test_quantities_stand_in_the_order_in_which_they_were_asked_for():
    summary = {"seeds": [1], "quantities": {n: quantity(True, means=f"the {n}", hard=[1.0], soft=[1.0]) for n in "ab"}}
    assert [s[:5] for s in answers.answer_same(summary, ["b", "a"])[1]] == ["The b", "The a"]
    assert len(answers.answer_same(summary, ["b"])[1]) == 1  # and no other


@pytest.mark.parametrize(
    "hard, soft, words",
    [
        ((9.0, 10.0, 11.0), (9.0, 11.0, 10.0), ""),
        ((9.0, None, 11.0), (9.0, 11.0, 10.0), " (in 2 hard and 3 soft runs of 3 it came to that)"),
        ((9.0, 10.0, 11.0), (None, None, 10.0), " (in 3 hard and 1 soft runs of 3 it came to that)"),
        ((0.0, None, 0.0), (None, None, None), " (in 2 hard and 0 soft runs of 3 it came to that)"),  # zero is a value
    ],
)
def test_runs_in_which_a_quantity_has_no_value_are_told(hard, soft, words):
    (sentence,) = same(quantity(True, hard, soft))[1]
    assert sentence.startswith(f"The water table at failure: 10 ± 1 m hard, 10.5 ± 2 m soft{words}. The difference")


@pytest.mark.parametrize("gone", ["difference_95", "scatter"])
def test_without_an_interval_or_a_scatter_nothing_is_told_of_the_difference(gone):
    assert same(quantity(None, **{gone: None})) == (
        "not told",
        [
            "The water table at failure: 10 ± 1 m hard, 10.5 ± 2 m soft; with these runs difference cannot be told from scatter."
        ],
    )


def test_forces_are_told_in_their_prefix():
    big = {"mean": 2e8, "sd": 3e6, "values": [2e8] * 3}
    made = quantity(False, means="the force at failure", unit="N/m") | {"hard": big, "soft": big}
    (sentence,) = same(made | {"difference": -4e5, "difference_95": 3e3, "scatter": 1.25e6})[1]
    assert sentence == (
        "The force at failure: 200 ± 3 MN/m hard, 200 ± 3 MN/m soft. The difference of the same packings is -400 kN/m ± 3 kN/m (95 % confidence), "
        "the scatter over seeds 1.25 MN/m: they differ."
    )


@pytest.mark.parametrize(
    "known, words",
    [
        (
            {"deposit_overlap_fraction": 0.875},
            "Deposits of the same packing cover each other by 87.5 % of the area that either covers.",
        ),
        (
            {"deposit_overlap_fraction": 0.5, "deposit_overlap_m2": 12000.0},
            "Deposits of the same packing cover each other by 50 % of the area that either covers (12000 m² in common).",
        ),
        (
            {
                "deposit_overlap_fraction": 0.0,
                "deposit_overlap_m2": 0.0,
                "deposit_overlap_fraction_between_seeds": 0.25,
            },
            "Deposits of the same packing cover each other by 0 % of the area that either covers (0 m² in common); hard deposits of different seeds by 25 %.",
        ),
        ({"deposit_overlap_fraction": None, "deposit_overlap_m2": 3.0}, None),
        ({"deposit_overlap_m2": 3.0, "deposit_overlap_fraction_between_seeds": 0.25}, None),
    ],
)
def test_deposits_are_told_where_there_are_some(known, words):
    verdict, sentences = same(quantity(True), **known)
    assert verdict == "yes" and sentences[1:] == ([] if words is None else [words])


# ---- which world costs less ---------------------------------------------------------------------------
def costs(against_hard=None, against_own=None, **other):
    """A summary's costs: without any answer, but for what is given."""
    return {
        "work_precision": {"against_hard": {"compared": against_hard}, "against_own": {"compared": against_own}},
        "soft_over_hard_wall_equal_overlap": None,
        "equal_overlap_extrapolated": False,
        "overlap_hard_rel": None,
        "stiffness_equal_overlap_Pa": None,
        "soft_over_hard_wall_rock_stiffness": None,
        "rock_stiffness_extrapolated": False,
    } | other


def compared(factor, at_scatter=False):
    """A comparison of work: ``factor`` is soft wall time over hard wall time."""
    return {
        "factor": factor,
        "error": 0.02,
        "at_scatter": at_scatter,
        "hard_label": "hard, step × 2",
        "soft_label": "soft, E = 10 MPa",
    }


@pytest.mark.parametrize(
    "factor, cheaper, told", [(4.0, "hard", "4"), (0.25, "soft", "4"), (1.5, "hard", "1.5"), (0.8, "soft", "1.25")]
)
def test_who_costs_less_is_who_takes_less_wall_time(factor, cheaper, told):
    """A factor of 4, soft over hard: rigid disks take a quarter of the time. One of 1/4: soft contacts do."""
    assert answers.answer_costs(costs(compared(factor))) == (
        cheaper,
        [
            f"At equal accuracy (error 0.02 against the finest hard run: the smallest that both reach) {cheaper} costs less, by a factor of {told}: "
            "“hard, step × 2” against “soft, E = 10 MPa”."
        ],
    )


def test_an_accuracy_that_is_the_scatter_is_told():
    (sentence,) = answers.answer_costs(costs(compared(4.0, at_scatter=True)))[1]
    assert (
        "(error 0.02 against the finest hard run: the scatter over seeds, below which errors tell nothing)" in sentence
    )


def test_each_against_its_own_finest_run_decides_nothing():
    """What each reaches against itself does not tell who is dearer at the same accuracy."""
    own = "Each against the finest run of its own world, at an error of 0.005: a factor of 0.25, soft over hard."
    assert answers.answer_costs(costs(None, {"error": 0.005, "factor": 0.25})) == ("not told", [own])
    verdict, sentences = answers.answer_costs(costs(compared(4.0), {"error": 0.005, "factor": 0.25}))
    assert verdict == "hard" and sentences[1:] == [own]
    assert answers.answer_costs(costs()) == ("not told", [])


@pytest.mark.parametrize("beyond", [True, False])
def test_wall_times_at_equal_overlap_and_at_a_rocks_stiffness(beyond):
    overlap = {
        "soft_over_hard_wall_equal_overlap": 2.0,
        "equal_overlap_extrapolated": beyond,
        "overlap_hard_rel": 0.00123,
        "stiffness_equal_overlap_Pa": 2.5e8,
    }
    rock = {"soft_over_hard_wall_rock_stiffness": 15.0, "rock_stiffness_extrapolated": beyond}
    told = [
        "At equal mean overlap (0.0012 of the mean diameter, which takes a Young's modulus of 250 MPa) a second of simulation costs soft contacts "
        "2 times the wall time of hard ones." + " That stiffness was not run: the factor is extrapolated." * beyond,
        "At a rock's stiffness, 10 GPa, 15 times" + (" (extrapolated)." if beyond else "."),
    ]
    assert list(answers.answer_cost(costs(**overlap))) == told[:1]
    assert list(answers.answer_cost(costs(**rock))) == told[1:]
    assert list(answers.answer_cost(costs())) == []
    # what is asked for all goes last, and decides nothing
    assert answers.answer_costs(costs(**overlap, **rock)) == ("not told", told)
