"""Numbers of a comparison from made-up runs whose answers are known. Needs no YADE."""

import json
import math
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import known_slope  # noqa: E402
import synthetic_slope as synthetic  # noqa: E402

cases, deposits, outcomes, precision, slopes, summary = (
    synthetic.load(f"studies.comparison.{name}")
    for name in ("cases", "deposits", "outcomes", "precision", "slopes", "summary")
)
records = synthetic.load("records")
SAME = 1e-9  # relative: rounding


def test_a_summary_is_what_json_can_hold():
    told = {1: (math.nan, np.float64(math.inf), np.float32(0.5)), "b": np.array([1, 2]), "c": np.bool_(True), "d": None}
    assert summary.clean(told) == {"1": [None, None, 0.5], "b": [1, 2], "c": True, "d": None}
    assert json.loads(json.dumps(summary.clean(told))) == summary.clean(told)


# ---- a slope's run ----------------------------------------------------------------------------------
def measured(folder, monkeypatch, section=known_slope.SHIPPED, **state):
    """The Outcome of the known run, which took 1000 s of wall time for 49,999 steps, 400 s of them for 60 s of
    motion.
    """
    monkeypatch.setattr(slopes, "section_of", lambda case: section)
    state = known_slope.STATE | {"wall_steps_s": 1000.0, "wall_moving_s": 400.0, "moving_s": 60.0} | state
    return slopes.measure(
        cases.Case("hard", "made up", 550, 1), folder, {"state": state, "steps": 49999, "simulated_s": 100.0}
    )


def test_a_slope_is_measured_as_its_summary_has_it(tmp_path, monkeypatch):
    series = known_slope.series()
    broken = {
        f"bonds_broken_{mode}": np.full(known_slope.COUNT, count)
        for mode, count in (("tension", 100), ("shear", 200), ("torque", 30), ("mixed", 4))
    }
    found = measured(known_slope.write(tmp_path, series | broken), monkeypatch)
    assert found.values == pytest.approx(
        {
            "water_at_failure_m": 9.55,  # of t1 = 29.1 s
            "front_travel_m": 1000.5,
            "centroid_travel_m": 250.0,
            "fb_force_at_failure_N_per_m": 195.95e6,
            "dp_shear_at_failure_N_per_m": 384.05e6,
            "fb_force_final_N_per_m": 91.9e6,
            "dp_shear_final_N_per_m": -29.05e6,
            "bonds_broken_share": 334 / 41000,
            "deposit_thickness_max_m": 36.0,
            "speed_mean_max_m_per_s": 30.0,
        },
        rel=SAME,
    )

    # from t0 on, and the clock begins when the slope moves
    def at(name, time):
        return found.curves[name][np.argmin(np.abs(found.curves["abscissa"] - time))]

    assert (found.curves["abscissa"][0], found.curves["abscissa"][-1]) == pytest.approx((10 - 30.5, 100 - 30.5))
    assert (at("front", -10.0), at("front", 29.5), at("front", 69.0)) == pytest.approx((0.0, 1100.0, 1000.5)) and at(
        "centroid", 57.5 - 30.5
    ) == pytest.approx(125.0, rel=SAME)
    # of the second before t0; and of the rows above a tenth of the largest speed, 33.0 to 82.2 s but for a second in
    # between, one of them with 0.004
    assert found.overlap_rest == pytest.approx(0.001, rel=SAME) and found.overlap == pytest.approx(
        0.002 + 0.002 / 482, rel=SAME
    )
    assert (
        found.cost.steps,
        found.cost.step_s,
        found.cost.wall_s,
        found.cost.simulated_s,
        found.cost.rate,
    ) == pytest.approx((49999, 100 / 49999, 1000.0, 100.0, 400 / 60))
    assert found.notes == [] and [len(part[0]) for part in (found.begin, found.end)] == [550, 441]


@pytest.mark.parametrize("failed_dry", [None, 3.0])
def test_a_slope_to_the_left_has_the_numbers_of_its_mirror(tmp_path, monkeypatch, failed_dry):
    """Of the same run with x of the other sign: each value and each curve to the last bit, since signs are all that
    changes.
    """
    for side in ("left", "right"):
        (tmp_path / side).mkdir()
    right = measured(known_slope.write(tmp_path / "right"), monkeypatch, failed_dry=failed_dry)
    flipped = {name: known_slope.series()[name] * -1.0 for name in ("front_m", "centroid_x_m")}
    ends = [lambda end=end: {**end(), "x": -end()["x"]} for end in (known_slope.begin, known_slope.end)]
    known_slope.write(tmp_path / "left", known_slope.series() | flipped, *ends)
    mirror = synthetic.load("model.section.similar").mirrored(known_slope.SHIPPED)
    state = dict(failed_dry=failed_dry, front0=-known_slope.STATE["front0"])
    left = measured(tmp_path / "left", monkeypatch, mirror, **state)
    assert left.values["front_travel_m"] > 1000 and left.values == right.values
    assert all((left.curves[name] == right.curves[name]).all() for name in right.curves)


def test_slopes_that_do_not_fail_by_water_are_told(tmp_path, monkeypatch):
    known_slope.write(tmp_path)
    dry = measured(tmp_path, monkeypatch, failed_dry=3.0)
    assert (
        dry.values["water_at_failure_m"] == 0
        and dry.values["front_travel_m"] == pytest.approx(1050.5)
        and dry.notes == ["the slope failed dry, at 3.0 s"]
    )
    assert dry.values["centroid_travel_m"] == pytest.approx(math.hypot(210, 180), rel=SAME)
    stood = measured(tmp_path, monkeypatch, moving=None, moving_s=0.0)
    # of all steps
    assert (
        stood.notes == ["the slope did not begin to move"]
        and stood.cost.rate == 10.0
        and stood.curves["abscissa"][0] == 0
    )
    # stopped before the water began to rise: the clock begins with the first row after settling, that of 5.1 s, and
    # ends with that of 100 s
    early = measured(tmp_path, monkeypatch, moving=None, t0=None, moving_s=0.0).curves["abscissa"]
    assert (early[0], early[-1]) == pytest.approx((0.0, 94.9), abs=1e-9)
    short = {name: values[:700] for name, values in known_slope.series().items()}
    assert measured(known_slope.write(tmp_path, short), monkeypatch).notes == [
        "stopped at 70 s, before the mass was at rest"
    ]


def test_forces_are_those_under_compression():
    made = SimpleNamespace(ci=np.array([3, 1, 2, 4]), cj=np.array([0, -2, 5, 6]), cn=np.array([1.0, 2.0, -3.0, 0.0]))
    assert slopes.forces_of(made) == {(0, 3): 1.0, (-2, 1): 2.0}


# ---- forces at contacts -----------------------------------------------------------------------------
def test_forces_that_differ_by_a_share():
    """All a tenth larger: rms of a tenth of √⟨N²⟩ over ⟨N⟩; turned about their mean: no correlation but the
    opposite.
    """
    one = {(0, k): float(k) for k in range(1, 6)}
    rms, correlation = precision.force_difference({pair: 1.1 * value for pair, value in one.items()}, one)
    assert rms == pytest.approx(0.1 * math.sqrt(11) / 3, rel=SAME) and correlation == pytest.approx(1.0, rel=SAME)
    assert precision.force_difference({pair: 6 - value for pair, value in one.items()}, one)[1] == pytest.approx(
        -1.0, rel=SAME
    )
    assert all(math.isnan(value) for value in precision.force_difference({(0, 1): 1.0}, {(0, 1): 1.0, (0, 2): 1.0}))


def test_a_power_has_the_error_of_its_fit():
    """Logarithms that miss a line by +e, −2e, +e over decades."""
    e, x = 0.01, np.array([1.0, 10.0, 100.0])
    found = precision.power_law(x, 5 * x**-0.5 * np.exp([e, -2 * e, e]))
    assert (found.power, found.scale, found.points) == pytest.approx((-0.5, 5.0, 3), rel=SAME)
    assert found.power_error == pytest.approx(math.sqrt(6 * e * e / 1 / (2 * math.log(10) ** 2)), rel=1e-6)
    # what is not positive is left out
    assert precision.power_law(np.append(x, [1e3, 1e4]), np.append(5 * x**-0.5, [0.0, math.nan])).points == 3
    assert math.isnan(precision.power_law([1.0, 2.0], [1.0, 2.0]).power_error)


# ---- the summary ------------------------------------------------------------------------------------
SEEDS, FRONTS = (1, 2, 3), {1: 100.0, 2: 104.0, 3: 111.0}  # of the hard runs; their standard deviation is √31
MODULI = (1e6, 1e8, 1e10)
WATER = {1: 10.0, 2: 12.0, 3: 14.0}


def made_up(case):
    """An Outcome. Hard: numerics move the front by a hundredth of the step's factor less one. Soft: a tenth of √(10⁸
    Pa/E) further, at a water table 1 m higher.
    """
    soft = case.world == "soft"
    share = 1 + 0.1 * math.sqrt(1e8 / case.stiffness) if soft else 1 + 0.01 * (case.step - 1)
    front, t = share * FRONTS[case.seed], np.linspace(0, 10, 101)
    overlap = 1e4 / case.stiffness if soft else 1e-3
    step = 1e3 / math.sqrt(case.stiffness) if soft else 2.0 * case.step
    wall = (0.2 + 0.01 * math.log10(case.stiffness)) if soft else 4.0 / case.tolerance**0.5  # s a step
    steps = round(100 / step)
    x = np.arange(0.0, round(front))
    values = {
        "water_at_failure_m": WATER[case.seed] + soft,
        "front_travel_m": front,
        "odd": None if case.seed == 2 and soft else 1.0 + soft,
    }
    return outcomes.Outcome(
        case,
        values,
        {"abscissa": t, "front": front * t / 10},
        {},
        None,
        (x, 0 * x, 0 * x + 0.5),
        {(k, k + 1): (1 + soft) * (1.0 + k) for k in range(4)},
        overlap,
        0.5 * overlap,
        outcomes.Cost(steps, step, wall * steps, 100.0, wall / step),
    )


@pytest.fixture(scope="module")
def told():
    scenario = SimpleNamespace(
        NAME="made up",
        KEYS=("water_at_failure_m",),
        CURVES={"front": "the front's way"},
        OVERLAP_WHEN=("at rest", "moving"),
        QUANTITIES=tuple(
            outcomes.Quantity(name, f"the {name}", "m") for name in ("water_at_failure_m", "front_travel_m", "odd")
        ),
    )
    plan = cases.plan("made up", 100, list(SEEDS), MODULI, ensemble=1e8)
    return summary.summarise(scenario, plan, {case: made_up(case) for case in plan.cases}), plan


def test_means_differences_and_scatter(told):
    found = told[0]["quantities"]
    front = found["front_travel_m"]
    assert (front["hard"]["mean"], front["soft"]["mean"]) == pytest.approx((105.0, 115.5), rel=SAME) and front["hard"][
        "sd"
    ] == pytest.approx(math.sqrt(31), rel=SAME)
    # soft over hard: a tenth of 100, 104 and 111, whose standard deviation is √0.31; Student's t for two degrees of
    # freedom
    assert front["difference"] == pytest.approx(10.5, rel=SAME) and front["difference_95"] == pytest.approx(
        4.30265 * math.sqrt(0.31 / 3), rel=1e-5
    )
    assert front["scatter"] == pytest.approx(math.sqrt(31 * (1 + 1.21) / 2), rel=SAME) and front["agree"] is False
    assert front["soft"]["values"] == pytest.approx([110.0, 114.4, 122.1], rel=SAME)
    water = found["water_at_failure_m"]
    assert (water["difference"], water["difference_95"], water["scatter"], water["agree"]) == pytest.approx(
        (1.0, 0.0, 2.0, True), abs=SAME
    )
    assert (
        found["odd"]["difference"] == 1.0
        and found["odd"]["soft"]["values"] == [2.0, None, 2.0]
        and found["odd"]["soft"]["mean"] == 2.0
    )
    assert (
        told[0]["water_at_failure_hard_m"],
        told[0]["water_at_failure_soft_m"],
        told[0]["front_travel_hard_m"],
        told[0]["front_travel_soft_m"],
    ) == pytest.approx((12.0, 13.0, 105.0, 115.5), rel=SAME)


def test_deposits_of_one_packing_and_of_different_ones(told):
    """Rows of 100, 104 and 111 disks, and of 110, 114 and 122 on soft contacts."""

    def ratio(*pairs):
        return np.mean([min(p) / max(p) for p in pairs])

    # rounded ends
    assert told[0]["deposit_overlap_fraction"] == pytest.approx(ratio((100, 110), (104, 114), (111, 122)), abs=2e-3)
    assert told[0]["deposit_overlap_fraction_between_seeds"] == pytest.approx(
        ratio((100, 104), (100, 111), (104, 111)), abs=2e-3
    )
    # the longer row of soft disks covers the hard one, which has more than its disks' area and less than their boxes'
    common = told[0]["deposit_overlap_m2_by_seed"]
    assert list(common) == ["1", "2", "3"] and all(
        math.pi / 4 * front < common[str(seed)] < front for seed, front in FRONTS.items()
    )
    assert common == pytest.approx(
        {str(hard.seed): made_up(hard).deposit.area for hard, _ in told[1].ensemble}, rel=SAME
    )
    assert told[0]["deposit_overlap_m2"] == pytest.approx(sum(common.values()) / 3, rel=SAME)


def test_differences_fall_with_the_stiffness_as_they_were_made(told):
    rows = told[0]["convergence"]["rows"]
    assert rows["front_travel_m"]["differences"] == pytest.approx([1.0, 0.1, 0.01], rel=1e-9) and rows[
        "front_travel_m"
    ]["power"] == pytest.approx(-0.5, rel=1e-9)
    assert (
        rows["front_travel_m"]["scatter"] == pytest.approx(math.sqrt(31) / 100, rel=SAME)
        and rows["front_travel_m"]["stiffest_within_scatter"] is True
    )
    # rms of a line, over the reference's largest; 400 points
    assert rows["front"]["differences"] == pytest.approx(np.array([1.0, 0.1, 0.01]) / math.sqrt(3), rel=0.01)
    assert rows["overlap"]["differences"] == pytest.approx([5e-3, 5e-5, 5e-7], rel=SAME) and rows["overlap"][
        "power"
    ] == pytest.approx(-1, rel=SAME)
    assert rows["water_at_failure_m"]["differences"] == pytest.approx([0.1] * 3, rel=1e-9) and rows[
        "water_at_failure_m"
    ]["scatter"] == pytest.approx(0.2, rel=1e-9)
    forces = told[0]["convergence"]["forces"]
    assert forces["rms_over_mean"] == pytest.approx([math.sqrt(30 / 4) / 2.5] * 3, rel=SAME) and forces[
        "hard_rms_over_mean"
    ] == [0.0] * len(forces["hard_runs"])
    assert len(forces["hard_runs"]) == 4 and "hard" not in forces["hard_runs"]


def test_costs_at_equal_overlap_and_at_a_rocks_stiffness(told):
    """10⁴/E is 0.001 at 10⁷ Pa, between two runs: a step there is √0.1 of that of 10⁶ Pa, and takes 0.27 s; a hard one
    takes 4 s for 2 s.
    """
    found = told[0]
    assert (
        found["stiffness_equal_overlap_Pa"] == pytest.approx(1e7, rel=1e-6)
        and found["equal_overlap_extrapolated"] is False
        and found["overlap_hard_rel"] == 1e-3
    )
    wall = math.sqrt(0.26 * 0.28)  # between logarithms
    assert found["soft_over_hard_wall_equal_overlap"] == pytest.approx(wall / (1e3 / math.sqrt(1e7)) / 2.0, rel=1e-6)
    assert (
        found["soft_over_hard_wall_rock_stiffness"] == pytest.approx(0.3 / 1e-2 / 2.0, rel=1e-6)
        and found["rock_stiffness_extrapolated"] is False
    )
    assert found["wall_s_per_simulated_s_hard"] == 2.0 and found["wall_s_per_simulated_s_soft"][
        "1e+08"
    ] == pytest.approx(0.28 / 0.1, rel=SAME)


def test_work_is_compared_at_what_both_reach(told):
    work, plan = told[0]["work_precision"], told[1]
    assert (work["reference_hard"], work["reference_soft"]) == (plan.numerics[-1].name, plan.sweep[-1].name)
    hard = {p["run"]: p for p in work["against_hard"]["hard"]}
    assert set(hard) == {c.name for c in plan.numerics[:-1]} and {p["run"] for p in work["against_own"]["soft"]} == {
        c.name for c in plan.sweep[:-1]
    }
    for name, one in hard.items():
        assert one["error"] == pytest.approx(
            math.sqrt(sum(part**2 for part in one["parts"].values()) / len(one["parts"])), rel=SAME
        ) and set(one["parts"]) == {"front", "deposit", "water_at_failure_m"}
    compared = work["against_hard"]["compared"]
    # seeds scatter more than numerics
    assert compared["at_scatter"] is True and compared["error"] == pytest.approx(work["scatter"], rel=SAME)
    # the cheapest hard run that is as good as that, and the cheapest soft one: 10⁸ Pa
    cheapest = min((p for p in hard.values() if p["error"] <= work["scatter"]), key=lambda p: p["wall_s"])
    soft = {p["run"]: p for p in work["against_hard"]["soft"]}
    good = min((p for p in soft.values() if p["error"] <= work["scatter"]), key=lambda p: p["wall_s"])
    assert (compared["hard"], compared["soft"]) == (cheapest["run"], good["run"]) and compared[
        "factor"
    ] == pytest.approx(good["wall_s"] / cheapest["wall_s"], rel=SAME)


def test_each_run_is_told_with_its_errors(told):
    runs = {run["name"]: run for run in told[0]["runs"]}
    assert set(runs) == {case.name for case in told[1].cases}
    for case in told[1].cases:
        told_of = [runs[case.name][key] for key in ("world", "seed", "stiffness_Pa", "step_factor", "tolerance_factor")]
        assert told_of == [case.world, case.seed, case.stiffness, case.step, case.tolerance]
    reference, stiffest = runs[told[1].numerics[-1].name], runs[told[1].sweep[-1].name]
    assert (
        reference["error_against_hard"]
        == reference["error_against_own_world"]
        == stiffest["error_against_own_world"]
        == 0
        and stiffest["error_against_hard"] > 0
    )


def test_the_work_of_a_run_grows_as_its_steps_and_sweeps_do():
    """In units of the hard run's: as many steps as a shorter step asks for, 10^0.6 times the sweeps for a hundredth of
    the tolerance; springs four times as stiff take twice the steps.
    """

    def hard(**numerics):
        return cases.work_of(cases.Case("hard", "made up", 550, 1, **numerics))

    def soft(stiffness):
        return cases.work_of(cases.Case("soft", "made up", 550, 1, stiffness=stiffness))

    assert hard() == 1 and hard(step=0.5) == 2 and hard(tolerance=0.01) == pytest.approx(10**0.6, rel=1e-12)
    assert soft(3e8) == 1 and soft(12e8) == 2
