"""The measure by which closing bonds become the default or do not, on made-up rows: each criterion fails alone. Needs
no YADE.
"""

import pytest

import synthetic_slope as synthetic
from made_up_readings import made_up

decision, reading_numbers = (
    synthetic.load(f"studies.paper.{name}") for name in ("closing_decision", "reading_numbers")
)

SHIPPED = made_up("shipped", "smooth")


def closing(inside=5, banded=5, samples=5, **changes):
    """A row with five samples, of which so many peak ``inside`` the paper's range of strains, and so many have two
    bands.
    """
    row = made_up(
        "closing-0.02", "rough", [[0.01, 0.01 if k < inside else 0.0012, 0.01] for k in range(samples)], **changes
    )
    for k, sample in enumerate(row["samples"]):
        sample["bands_at_1_percent"] = 2 if k < banded else 1
    return row


def test_the_measure_is_the_one_that_was_written_down():
    """Its numbers are not to be moved to what is found; those of means are the paper's."""
    assert (decision.SAMPLES, decision.DISKS, decision.LEAST) == (5, 2000, 4)
    assert [bounds[1:] for bounds in decision.COUNTED.values()] == [
        ("strain_peak", 0.005, 0.02),
        ("bands_at_1_percent", 2, 2),
    ]
    assert list(decision.MEANS) == ["c", "d", "e"]
    numbers = {name: bounds for one in decision.MEANS.values() for name, bounds in one.items()}
    assert numbers == {
        "cohesion_peak_kPa": (88, 25),
        "friction_peak_deg": (38.5, 2),
        "friction_residual_deg": (26.2, 2),
        "water_highest_m": (22.5, 4),
    }
    assert numbers == {name: reading_numbers.PAPER[name] for name in numbers}


def test_a_rock_that_meets_all_becomes_the_default():
    for row in (closing(), closing(inside=4, banded=4, friction_residual_deg=28.1, water_highest_m=18.6)):
        found = decision.verdict(row, SHIPPED)
        assert found["default"] is True and not found["lost"] and all(c["met"] for c in found["criteria"].values())


@pytest.mark.parametrize(
    "criterion, changes",
    [
        ("a", {"inside": 3}),
        ("b", {"banded": 3}),
        ("c", {"cohesion_peak_kPa": 62.9}),
        ("c", {"friction_peak_deg": 40.6}),
        ("d", {"friction_residual_deg": 28.3}),
        ("e", {"water_highest_m": 26.6}),
        ("e", {"water_highest_m": None}),
    ],
)
def test_each_criterion_fails_alone(criterion, changes):
    # a shipped reading that meets none of the numbers has none to lose
    poor = {name: 3 * wanted for name, (wanted, _) in reading_numbers.PAPER.items() if name != "strain_peak"}
    shipped = made_up("shipped", "smooth", [[0.001] * 3] * 5, **poor)
    found = decision.verdict(closing(**changes), shipped)
    assert [key for key, c in found["criteria"].items() if not c["met"]] == [criterion]
    assert found["default"] is False and found["lost"] == []


def test_a_number_that_the_shipped_reading_meets_must_not_be_lost():
    """Residual cohesion is no criterion of its own."""
    row = closing(cohesion_residual_kPa=26.1)
    found = decision.verdict(row, SHIPPED)
    assert all(c["met"] for c in found["criteria"].values()) and found["lost"] == ["cohesion_residual_kPa"]
    assert found["default"] is False
    assert decision.verdict(row, made_up("shipped", "smooth", cohesion_residual_kPa=27.0))["default"] is True


@pytest.mark.parametrize("row", [closing(samples=4), closing(samples=6), closing(disks=1000)])
def test_other_samples_decide_nothing(row):
    assert decision.verdict(row, SHIPPED)["default"] is None


def test_verdicts_are_of_closing_readings_beside_the_shipped_one_between_smooth_platens():
    rough = made_up("shipped", "rough", cohesion_residual_kPa=50.0)
    rows = [rough, SHIPPED, made_up("gap-0.02", "smooth"), closing(cohesion_residual_kPa=26.1)]
    (found,) = decision.verdicts(rows)
    assert (found["name"], found["platens"], found["lost"]) == ("closing-0.02", "rough", ["cohesion_residual_kPa"])
    assert decision.verdicts([rough, closing()]) == []
    title, heads, ((label, platens, *criteria, lost, default),) = decision.table([found])
    assert (label, platens, lost, default) == ("closing-0.02", "rough", "residual cohesion [kPa]", "no")
    assert criteria == ["5 of 5: yes", "5 of 5: yes", "88, 38.5: yes", "26.2: yes", "22.5: yes"]
    assert heads[5].endswith("[°] 26.2 ± 2") and len(heads) == 9


def test_what_was_not_run_is_undecided_until_something_fails():
    """Samples under one pressure tell a and b alone. A slope that did not fail was run, and does not meet e."""
    alone = dict.fromkeys(("cohesion_peak_kPa", "friction_peak_deg", "cohesion_residual_kPa"))
    alone |= dict.fromkeys(("friction_residual_deg", "water_highest_m")) | {"water_highest_m_each": []}
    found = decision.verdict(closing(**alone), SHIPPED)
    assert [c["met"] for c in found["criteria"].values()] == [True, True, None, None, None]
    assert found["default"] is None and found["lost"] == []
    assert decision.verdict(closing(inside=3, **alone), SHIPPED)["default"] is False
    dry = decision.verdict(closing(water_highest_m=None), SHIPPED)
    assert dry["criteria"]["e"]["met"] is False and dry["default"] is False
    (line,) = decision.table([found])[2]
    assert [text.split(": ")[-1] for text in line[2:7]] == ["yes", "yes", "undecided", "undecided", "undecided"]
