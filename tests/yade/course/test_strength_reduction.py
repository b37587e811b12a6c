"""The rules of a search for the factor of safety, on made-up slopes that fail at a known factor. Needs no YADE."""

import dataclasses
import math
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import synthetic_slope as synthetic  # noqa: E402

course, reduction, scales, section, materials = (
    synthetic.load(name)
    for name in ("course", "course.strength_reduction", "model.scales", "model.section", "model.materials")
)
SHIPPED = section.load("jiufengershan")
AT = scales.of(SHIPPED)
STEP = 1e-2  # s


def rules(**numbers):
    return reduction.rules(SHIPPED, AT, **numbers)


def search(critical, loads=None, **numbers):
    """The State in which a search of a slope ends that fails at ``critical`` or more; ``loads``: the factor from which
    on it fails as it is loaded, which may be another.
    """
    chosen, state = rules(**numbers), reduction.SearchState()
    loads = critical if loads is None else loads
    while state.outcome is None:
        fails = state.factor >= (loads if state.stable is None else critical)
        state = reduction.after(state, (reduction.FAILED if fails else reduction.STABLE, "made up"), chosen)
        assert len(state.trials) < 500
    return state


@pytest.mark.parametrize("critical", [0.0523, 0.3, 0.7, 0.99, 1.01, 1.049, 1.5, 2.7, 9.9])
@pytest.mark.parametrize("step, within", [(0.1, 0.02), (0.5, 0.01), (0.05, 0.05), (1.0, 1e-4)])
def test_the_bracket_holds_the_factor_and_is_as_narrow_as_asked(critical, step, within):
    s = search(critical, step=step, within=within)
    assert s.outcome == reduction.FOUND
    assert s.stable < critical <= s.failed  # it fails at the factor itself
    assert s.failed - s.stable <= within * s.stable
    assert s.stable < reduction.factor_of_safety(s) < s.failed
    # the bracket is that of the trials, and only narrows
    stood = [t["factor"] for t in s.trials if t["verdict"] == reduction.STABLE]
    fell = [t["factor"] for t in s.trials if t["verdict"] == reduction.FAILED]
    assert (max(stood), min(fell)) == (s.stable, s.failed)
    assert stood == sorted(stood) and fell == sorted(fell, reverse=True)


def test_no_trial_loses_more_strength_than_a_step():
    """Each begins at the rest of the largest factor at which the slope stood."""
    for critical in (0.3, 0.7, 1.3, 4.0):
        stood = None
        for trial in search(critical).trials:
            if stood is not None:
                assert trial["factor"] <= stood * 1.1 * (1 + 1e-12)
            if trial["verdict"] == reduction.STABLE:
                stood = trial["factor"]


def test_a_slope_that_never_fails_says_so():
    s = search(math.inf)
    assert (s.outcome, s.stable, s.failed) == (reduction.STANDS, 10.0, None)
    assert reduction.factor_of_safety(s) is None
    assert search(math.inf, most=1.3).stable == 1.3


def test_a_slope_that_fails_as_it_is_has_a_factor_below_one():
    """It is loaded anew with more strength, and 1 is above its bracket, wherever a gentler loading would have got."""
    s = search(1.0)
    assert s.outcome == reduction.FOUND and s.failed == 1.0 and 0.98 <= s.stable < 1.0
    assert [t["factor"] for t in s.trials[:3]] == [1.0, 0.5, 0.55]
    assert search(3.0, loads=1.0).failed == 1.0


def test_a_slope_that_never_stands_says_so():
    s = search(0.0)
    assert (s.outcome, s.stable, s.failed) == (reduction.FALLS, None, 0.05)
    assert [t["factor"] for t in s.trials] == [1.0, 0.5, 0.25, 0.125, 0.0625, 0.05]
    assert search(0.3, least=0.5).outcome == reduction.FALLS and reduction.factor_of_safety(s) is None


def test_the_share_done_grows_to_one():
    chosen, state, shares = rules(), reduction.SearchState(), []
    while state.outcome is None:
        shares.append(reduction.share(state, chosen))
        fails = state.factor >= 1.7
        state = reduction.after(state, (reduction.FAILED if fails else reduction.STABLE, ""), chosen)
    shares.append(reduction.share(state, chosen))
    assert shares == sorted(shares) and shares[0] == 0 and shares[-1] == 1 and max(shares[:-1]) < 1


def test_the_share_of_a_bracket_is_by_the_halvings_that_are_left():
    chosen = rules()
    # 4 and 2 times as wide as wanted: 2 and 1 halvings
    for width, left in ((4, 2), (2, 1), (1, 0), (0.5, 0)):
        state = dataclasses.replace(reduction.SearchState(), stable=1.0, failed=1 + width * chosen.within)
        assert reduction.share(state, chosen) == pytest.approx(0.5 + 0.5 / (1 + left))


# ---- a trial ------------------------------------------------------------------------------------
def trial(speed, way=lambda t: 0.0, broken=lambda t: 0.0, **numbers):
    """What became of a trial with this history, and when [s]."""
    chosen, state, k = rules(**numbers), reduction.SearchState(began=3.0), 0
    while True:
        k += 1
        time = 0.1 * k
        seen = course.Seen(3.0 + time, STEP, speed(time), way=way(time), broken=broken(time))
        given = dataclasses.asdict(state)
        new, said = reduction.judged(state, seen, chosen)
        assert dataclasses.asdict(state) == given  # a function changes nothing that it is given
        if said is not None:
            return said[0], time
        state = new
        assert time < 100


REST, MOVING, HOLD = SHIPPED.stages.settle.speed_rest, 0.2, 5.0  # of the shipped section


def test_a_slope_at_rest_is_stable_after_a_while():
    assert trial(lambda t: 0.0) == (reduction.STABLE, pytest.approx(HOLD + 0.1))
    # from when it came to rest, at the speed of one that rests
    assert trial(lambda t: 0.0 if t > 2.05 else 0.1) == (reduction.STABLE, pytest.approx(HOLD + 2.1))
    assert trial(lambda t: REST)[0] == reduction.STABLE
    # and from when the last bond broke
    assert trial(lambda t: 0.0, broken=lambda t: 0.01 * (t > 3.05)) == (reduction.STABLE, pytest.approx(HOLD + 3.1))


def test_a_slope_that_moves_has_failed_at_once():
    assert trial(lambda t: 0.1 * t) == (reduction.FAILED, pytest.approx(2.0))  # m/s², up to 0.2 m/s
    verdict, time = trial(lambda t: MOVING * (t > 1.05))
    assert (verdict, time) == (reduction.FAILED, pytest.approx(1.1))


def test_a_mass_that_has_collapsed_has_failed_however_slowly():
    assert trial(lambda t: 0.1, way=lambda t: 0.001 * t)[1] == pytest.approx(10.0)
    assert trial(lambda t: 0.1, way=lambda t: 0.003, broken=lambda t: 0.02 * t)[1] == pytest.approx(5.0)


def test_a_slope_that_never_rests_has_failed_in_the_end():
    assert trial(lambda t: 2 * REST) == (reduction.FAILED, pytest.approx(reduction.LONGEST * HOLD))
    # one that creeps a little and stands is stable, with a bond broken now and then it is not
    assert trial(lambda t: 0.0, broken=lambda t: 1e-4 * int(t / 4))[0] == reduction.FAILED


def test_a_loading_by_the_rules_of_a_slopes_course():
    State = synthetic.load("course.slope").State
    assert reduction.loaded(State()) is None and reduction.loaded(State(stage="water")) is None
    assert reduction.loaded(State(failed_dry=2.0))[0] == reduction.FAILED
    assert reduction.loaded(State(stage="water", moving=12.0))[0] == reduction.FAILED
    assert reduction.loaded(State(stage="done", quiet_since=9.0))[0] == reduction.STABLE
    assert reduction.loaded(State(stage="done"))[0] == reduction.FAILED  # its longest time has passed


@pytest.mark.parametrize(
    "numbers, told",
    [
        ({"step": 0}, "step 0"),
        ({"step": 1.5}, "step 1.5"),
        ({"within": 0.2}, "from 1e-4 to the step, 0.1"),
        ({"within": 1e-6}, "within 1e-06"),
        ({"most": 1}, "most 1"),
        ({"least": 2}, "least 2"),
        ({"least": "a"}, "least 'a'"),
    ],
)
def test_numbers_that_make_no_sense(numbers, told):
    with pytest.raises(reduction.StrengthReductionError, match=told):
        rules(**numbers)


# ---- strengths ----------------------------------------------------------------------------------
def limits(m, normal, length=2.0):
    """Greatest shear force, torque and tension of a bond, by the law."""
    adhesion = m.tensile_strength * length
    return m.friction * (adhesion + normal), m.rolling_friction * length * (adhesion + normal), adhesion


@pytest.mark.parametrize("normal", [0.0, 3e5, -1e4])
def test_a_contact_bears_its_shear_and_its_torque_by_the_factor(normal):
    rock = SHIPPED.materials["rock"]
    shear, torque, tension = limits(rock, normal)
    less = materials.divided(rock, 1.25)
    assert limits(less, normal) == (pytest.approx(shear / 1.25), pytest.approx(torque / 1.25), tension)

    def of(*quantities):
        return limits(materials.divided(rock, 2.0, quantities), normal)

    # friction alone: the cohesion stays
    cohesion = shear - rock.friction * normal
    assert of("friction")[0] == pytest.approx(cohesion + 0.5 * rock.friction * normal)
    # cohesion alone: the friction stays
    assert of("cohesion")[0] == pytest.approx(0.5 * cohesion + rock.friction * normal)
    assert of("rolling_friction") == (shear, pytest.approx(0.5 * torque), tension)
    assert of("tension")[2] == pytest.approx(0.5 * tension)
    # all with tension: the cohesion falls twice
    assert of("friction", "cohesion", "tension")[0] == pytest.approx(0.25 * cohesion + 0.5 * rock.friction * normal)


def test_divided_are_residual_values_and_what_slip_leaves_too():
    rock = dataclasses.replace(
        SHIPPED.materials["rock"],
        residual_friction=0.2,
        residual_rolling_friction=0.08,
        residual_tensile_strength=3e3,
        slip_weakening=section.SlipWeakening("step", 5.0, 0.1, 2e3),
    )
    less = materials.divided(rock, 2.0)
    assert (less.residual_friction, less.residual_rolling_friction, less.residual_tensile_strength) == (0.1, 0.04, 3e3)
    assert (less.slip_weakening.friction, less.slip_weakening.tensile_strength) == (0.05, 2e3)
    alone = materials.divided(rock, 2.0, ("cohesion",))
    assert (alone.residual_tensile_strength, alone.slip_weakening.tensile_strength) == (1.5e3, 1e3)
    assert (alone.residual_friction, alone.slip_weakening.friction) == (0.2, 0.1)
    assert materials.divided(rock, 1.0) == rock  # to the last bit
    assert less.slip_weakening.critical_slip == 5.0 and less.density == rock.density
