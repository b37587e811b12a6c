"""A calibration's parameters, misfits, trials and bounds, by hand; made-up rocks in place of biaxial tests. Needs no
YADE. Whole searches are in test_laboratory.py.
"""

import dataclasses
import json
import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
import synthetic_slope as synthetic  # noqa: E402

calibration, campaign, materials, rocks = (
    synthetic.load(name)
    for name in ("studies.laboratory.calibration", "studies.laboratory.campaign", "model.materials", "model.rocks")
)
PEAK, ALL = calibration.Wanted(60e3, 34.0), calibration.Wanted(60e3, 34.0, 6e3, 25.0)


class Linear(calibration.Calibration):
    """A rock with c = σ_ext and φ = 45° + 10° ln μ_s, c_res = 0.5 σ_res, φ_res = 40° + 10° ln(10 μ_r)."""

    def test(self, material, disks, seeds):
        m = material
        return [
            m.tensile_strength,
            45 + 10 * math.log(m.friction),
            0.5 * m.residual_tensile_strength,
            40 + 10 * math.log(10 * m.rolling_friction),
        ]


@pytest.fixture
def rock():
    return materials.load("wwr")


@pytest.fixture
def search(rock, tmp_path):
    """A search of a made-up rock: search(wanted, **changes of the start material)."""
    return lambda wanted, kind=Linear, **changes: kind(
        wanted, dataclasses.replace(rock, **changes), tmp_path, 1, lambda text: None
    )


# ---- what a search begins with --------------------------------------------------------------------


def test_residual_strengths_are_wanted_where_their_angle_is():
    assert not PEAK.with_residual and ALL.with_residual


def test_parameters_begin_as_the_start_material_has_them(search):
    """Where the table of rocks does not hold σ_ext begins at 1.1 c and μ_s as it is; the share of the residual strength
    is kept, no less than 2 %, and a quarter without tensile strength.
    """
    found = search(ALL, rolling_friction=0.2, tensile_strength=50e3, residual_tensile_strength=10e3)
    assert found.names == ("tensile_strength", "friction", "rolling_friction", "residual_share")
    assert np.exp(found.x0) == pytest.approx([66e3, found.start.friction, 0.2, 0.2], rel=1e-12)  # rounding, as below
    none = search(ALL, rolling_friction=0.2, tensile_strength=50e3, residual_tensile_strength=0.0)
    assert np.exp(none.x0)[3] == pytest.approx(0.02, rel=1e-12)
    loose = search(ALL, rolling_friction=0.2, tensile_strength=0.0, residual_tensile_strength=0.0)
    assert np.exp(loose.x0)[3] == pytest.approx(0.25, rel=1e-12)
    assert search(PEAK).names == ("tensile_strength", "friction") and len(search(PEAK).x0) == 2


def test_the_table_of_rocks_is_asked_up_to_its_ends(search):
    low, high = rocks.interval()
    for angle, known in ((low, True), (high, True), (low - 1e-6, False), (high + 1e-6, False)):
        found = np.exp(search(calibration.Wanted(60e3, angle)).x0)
        assert (found[0] != pytest.approx(66e3, rel=1e-9)) == known


def test_the_first_jacobian_has_residual_cohesion_in_parts_of_the_peak(search):
    """Rows: ln c, φ, c_res/c, φ_res; a residual cohesion of a tenth counts a tenth, none at all 5 %."""
    assert search(PEAK).jacobian == pytest.approx(np.array([[1.0, 0.75], [0.0, 17.0]]))
    tenth, none = search(ALL).jacobian, search(calibration.Wanted(60e3, 34.0, 0.0, 25.0)).jacobian
    assert tenth.shape == (4, 4) and tenth[2] == pytest.approx([0.1, 0.0, 0.0, 0.1])
    assert none[2] == pytest.approx([0.05, 0.0, 0.0, 0.05]) and none[3] == pytest.approx([0.0, 12.0, 5.0, 0.0])


def test_the_material_of_a_trial(search, rock):
    """Residual friction is friction; what is not sought stays, the share of the residual strength among it."""
    peak = search(PEAK, tensile_strength=40e3, residual_tensile_strength=10e3, rolling_friction=0.15)
    found = peak.material(np.log([80e3, 0.4]))
    assert (found.tensile_strength, found.residual_tensile_strength) == (80e3, 20e3)
    assert (found.friction, found.residual_friction, found.rolling_friction, found.residual_rolling_friction) == (
        0.4,
        0.4,
        0.15,
        0.15,
    )
    assert found.name == "calibrated" and found.density == rock.density and found.envelope is None
    every = search(ALL).material(np.log([80e3, 0.4, 0.3, 0.5]))
    assert (every.residual_tensile_strength, every.rolling_friction, every.residual_rolling_friction) == (
        40e3,
        0.3,
        0.3,
    )


# ---- trials ---------------------------------------------------------------------------------------


def test_misfits_are_in_tolerances(search):
    """2 % of the cohesion and 0.7° are one each; a residual cohesion is in parts of the peak's."""
    peak = search(PEAK)
    assert peak.misfits([60e3 * math.exp(0.02), 33.3]) == pytest.approx([1.0, -1.0], rel=1e-9)
    assert peak.misfits([0.0, 34.0]) == pytest.approx([math.log(1e-3) / 0.02, 0.0])  # no cohesion is finite too
    found = search(ALL).misfits([60e3, 34.0, 6e3 - 2 * 0.02 * 60e3, 25.0 + 2.1])
    assert found == pytest.approx([0.0, 0.0, -2.0, 3.0], abs=1e-9)


def test_a_trial_is_made_once_and_kept(search, tmp_path):
    made = []

    class Counted(Linear):
        def test(self, *what):
            made.append(what)
            return super().test(*what)

    one = search(PEAK, Counted)
    x = np.log([60e3, 0.3])
    assert one.measure(x, 600, [1]) == pytest.approx(
        [60e3, 45 + 10 * math.log(0.3)]
    )  # of four strengths the wanted two
    assert one.measure(x, 600, [1]).shape == (2,) and len(made) == len(one.trials) == 1
    for other in ((x + 0.1, 600, [1]), (x, 700, [1]), (x, 600, [2])):
        one.measure(*other)
    assert len(made) == 4
    kept = json.loads((tmp_path / "trials.json").read_text())
    assert kept == one.trials and kept[0]["parameters"] == {"tensile_strength": 60e3, "friction": 0.3}
    assert (kept[1]["disks"], kept[2]["disks"], kept[3]["seeds"]) == (600, 700, [2])
    again = Counted(PEAK, one.start, tmp_path, 1, lambda text: None, resume=True)
    assert again.measure(x, 600, [1]) == pytest.approx(kept[0]["found"]) and len(made) == 4 and again.trials == kept[:1]


def test_what_a_trial_says(search, tmp_path):
    said = []
    for wanted in (PEAK, ALL):
        one = search(wanted)
        one.say = said.append
        one.measure(one.x0 * 0 + np.log([60e3, 0.5, 0.2, 0.4])[: len(one.names)], 600, [1])
    assert said[0] == "trial 1, 600 disks: tensile_strength 60000, friction 0.5 → c 60.0 kPa, φ 38.07°"
    # c_res = 0.5 · 0.4 · 60 kPa, φ_res = 40° + 10° ln 2
    assert said[1].endswith(
        "rolling_friction 0.2, residual_share 0.4 → c 60.0 kPa, φ 38.07°, c_res 12.0 kPa, φ_res 46.93°"
    )


def test_trials_that_cannot_be_read_are_named(search, rock, tmp_path):
    path = tmp_path / "trials.json"
    assert calibration.Calibration(PEAK, rock, tmp_path, 1, resume=True).known == []
    for text in ("{", '[{"found": [1, 2]}]', '[{"key": "a", "found": ["x"]}]', "3"):
        path.write_text(text)
        with pytest.raises(campaign.CampaignError, match=r"trials\.json: the trials .* remove the file"):
            calibration.Calibration(PEAK, rock, tmp_path, 1, resume=True)
    path.write_text('[{"key": "a", "found": [1, 2]}]')
    assert calibration.Calibration(PEAK, rock, tmp_path, 1, resume=True).known == [{"key": "a", "found": [1, 2]}]
    assert calibration.Calibration(PEAK, rock, tmp_path, 1).known == []  # a search that does not go on does not ask


@pytest.mark.parametrize("wanted, end", [(PEAK, 0.03), (ALL, 0.1)])
def test_tests_of_a_trial(rock, tmp_path, monkeypatch, wanted, end):
    """Each seed under 0.5, 3, 12 and 48 times the wanted cohesion; kilopascals become pascals; the folder goes."""
    asked = []

    def run(tests, folder, threads, resume, show):
        Path(folder).mkdir()
        asked.append((tests, threads, resume))
        return ["measured"]

    summary = dict(
        cohesion_peak_kPa=61.0, friction_peak_deg=33.0, cohesion_residual_kPa=5.0, friction_residual_deg=24.0
    )
    monkeypatch.setattr(campaign, "run", run)
    monkeypatch.setattr(campaign, "summarise", lambda material, measured, wall, threads: summary)
    found = calibration.Calibration(wanted, rock, tmp_path, 3, resume=True).test(rock, 700, [4, 5])
    assert found == ([61e3, 33.0, 5e3, 24.0] if wanted is ALL else [61e3, 33.0])
    ((tests, threads, resume),) = asked
    assert (threads, resume) == (3, True) and not list(tmp_path.iterdir())
    assert [(t.shape.seed, t.confining) for t in tests] == [(s, p * 60e3) for s in (4, 5) for p in (0.5, 3, 12, 48)]
    assert {(t.shape.count, t.strain) for t in tests} == {(700, end)}


# ---- the search -----------------------------------------------------------------------------------


def test_a_search_ends_where_nothing_is_missed(search):
    """The first trial has c = 60 kPa and φ = 34°; without a tolerance the search goes on."""
    x = np.log([60e3, math.exp(-1.1)])
    one = search(PEAK)
    found, misfit = one.search(600, [1], x, 9)
    # parameters have four digits, which is 10° · 1e-4/2 of the angle
    assert len(one.trials) == 1 and found == pytest.approx(x) and np.abs(misfit).max() < 1e-2
    assert len(search(PEAK).trials) == 0
    worse = search(PEAK)
    far, misfit = worse.search(600, [2], x + 0.5, 9)
    assert 1 < len(worse.trials) <= 9 and np.abs(misfit).max() <= 1 and far == pytest.approx(x, abs=0.07)


def test_a_search_returns_its_best_trial(search):
    """With two trials the second is the better one, or the first stays."""
    x = np.log([60e3, math.exp(-1.1)]) + np.array([0.3, 0.3])
    one = search(PEAK)
    found, misfit = one.search(600, [1], x, 3, enough=0.0)
    squares = [float(np.sum(one.misfits(t["found"]) ** 2)) for t in one.trials]
    assert float(misfit @ misfit) == pytest.approx(min(squares), rel=1e-12)
    best = one.trials[int(np.argmin(squares))]
    assert one.parameters(found) == best["parameters"]


def test_parameters_stay_within_their_bounds(search):
    """An angle of friction that the made-up rock would have at μ_s = e⁴: the search ends at μ_s = 2, its bound; one
    that begins beyond is put inside.
    """
    for start in (0.5, 9.0):
        one = search(calibration.Wanted(60e3, 85.0))
        found, misfit = one.search(600, [1], np.log([60e3, start]), 9)
        assert 1.5 < math.exp(found[1]) <= 2.0 and all(t["parameters"]["friction"] <= 2.0 for t in one.trials)
        assert misfit[1] == pytest.approx((45 + 10 * math.log(one.parameters(found)["friction"]) - 85) / 0.7)


def test_the_jacobian_learns_from_steps_that_are_no_scatter(search):
    """Broyden's update: along the step that was made the Jacobian becomes the difference quotient. Of a rock that is
    linear in logarithms it is its derivative there: (1, 0) of ln c and (0, 10°) of φ.
    """
    one = search(PEAK)
    one.search(600, [1], np.log([70e3, 0.5]), 2, enough=0.0)
    first, second = (np.log(list(t["parameters"].values())) for t in one.trials[:2])
    step = second - first
    assert np.linalg.norm(step) > calibration.LEARN
    # the step of the search has more digits than the trials' parameters have
    assert one.jacobian @ step == pytest.approx(np.array([[1, 0], [0, 10]]) @ step, rel=5e-3, abs=5e-3)


# ---- what it says in the end ----------------------------------------------------------------------


def test_what_strengths_tell_about_parameters():
    """J = diag(3, 4) turned: singular values 4 and 3, errors 1/3 and 1/4, and the least certain direction is that of
    the 3.
    """
    told = calibration.uniqueness(("a", "b"), np.array([[0.0, 4.0], [3.0, 0.0]]))
    assert told["singular_values"] == pytest.approx([4.0, 3.0], rel=1e-12) and told["parameters"] == ["a", "b"]
    assert told["parameter_error_rel"] == pytest.approx({"a": 1 / 3, "b": 1 / 4}, rel=1e-12)
    assert np.abs(list(told["least_certain_direction"].values())) == pytest.approx([1.0, 0.0], abs=1e-12)
    assert told["sensitivity"] == [[0.0, 4.0], [3.0, 0.0]]


def test_a_report_says_what_was_wanted_and_whether_it_was_reached(search):
    class Timed(Linear):
        def timed(self):
            return 1e-6, 1.0

    x = [60e3, math.exp(-1.1)]
    good = search(PEAK, Timed, tensile_strength=x[0] / 1.1, friction=x[1], rolling_friction=0.2)
    material, report = good.run((600, [1]), trials=(6, 0))
    assert report["reached"] and report["wanted"] == dataclasses.asdict(PEAK) and "μ_r" in report["given"]
    assert report["uncertainty_95"]["disks"] == 600 and report["uncertainty_95"]["samples"] == 1
    assert report["tolerances"] == {"cohesion_rel": 0.02, "friction_deg": 0.7}
    bad = search(calibration.Wanted(60e3, 85.0), Timed, rolling_friction=0.2)
    assert not bad.run((600, [2]), trials=(2, 0))[1]["reached"]
    four = search(ALL, Timed, rolling_friction=0.03)
    report = four.run((600, [3]), (900, [3, 4]), trials=(12, 8))[1]
    assert report["given"] == "four parameters from four strengths" and not report["quick"]
    assert report["uncertainty_95"]["samples"] == 2  # the fine samples
    # c_res/c = 0.5 share e^(ln σ_ext) / c: its derivative by either logarithm is c_res/c, in units of 2 %
    share = report["found"][2] / 60e3 / 0.02
    tells = np.array(report["sensitivity"])
    # a difference over 0.3 of logarithms is larger than the derivative by (e^0.3 − 1)/0.3
    grown = (math.exp(0.3) - 1) / 0.3
    assert tells[2, [0, 3]] / share == pytest.approx([grown, grown], rel=0.1)  # coarse and fine trials end apart
    assert tells[3, 2] == pytest.approx(10 / 0.7, rel=1e-3) and tells[1, 1] == pytest.approx(10 / 0.7, rel=1e-3)


# ---- how far it is ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "fine, wholes",
    [
        # a coarse trial is 600 disks of three seeds, a fine one 2000 of two; five of those, one for each of two
        # parameters, and four of these
        ((2000, (1, 2)), [5 * 1800 + 2 * 1800 + 4 * 4000, 2 * 1800 + 4 * 4000, 4 * 4000]),
        (None, [5 * 1800]),
    ],
)
def test_a_search_knows_how_much_is_left(search, monkeypatch, fine, wholes):
    """What trials were spared counts as done: nothing is done here, so that each stage begins with what it and those
    after it take.
    """
    made, told = search(PEAK), []
    monkeypatch.setattr(made, "_say_how_long", lambda *sizes: None)
    monkeypatch.setattr(made, "derivatives", lambda *where: told.append(made._whole))
    monkeypatch.setattr(calibration, "uniqueness", lambda names, jacobian: {})

    class Over(Exception):
        pass

    def stage(disks, seeds, x, trials, *stop):
        told.append(made._whole)
        if len(told) == len(wholes):
            raise Over
        return x, None

    monkeypatch.setattr(made, "search", stage)
    with pytest.raises(Over):
        made.run((600, (1, 2, 3)), fine)
    assert told == wholes and made.names == ("tensile_strength", "friction")


def test_how_far_a_search_is_counts_the_disks_of_all_its_trials(search):
    """Two trials, of 600 and of 900 disks, of a search over 3,000: a third of the way through the second it is at
    900 of 3,000; never past its end.
    """
    one, told = search(PEAK), []
    one.progress = lambda share, doing: told.append((share, doing))
    one._done, one._whole = 0.0, 3000
    one._show(600)(1.0, "shearing")
    one.trials.append({})
    show = one._show(900)
    show(1 / 3, "pressing")
    show(9.0, "pressing")
    assert told == [
        (pytest.approx(0.2), "trial 1: shearing"),
        (pytest.approx(0.3), "trial 2: pressing"),
        (1.0, "trial 2: pressing"),
    ]


@pytest.mark.parametrize("threads, at_once", [(1, 1), (2, 2), (8, 2)])
def test_how_long_a_step_and_a_test_take_is_measured(search, monkeypatch, tmp_path, threads, at_once):
    """Two tests that end after 12 s; of 30 and 50 steps, which took 1.2 and 2.0 s: 40 ms a step, and what is left
    of a test's time is its start. On several threads both go at once.
    """
    one, asked, clock = search(PEAK), [], iter((100.0, 112.0))
    one.threads = threads
    disks, strain = calibration.TIMED
    monkeypatch.setattr(calibration.pressing, "prepare", lambda shape, folder: asked.append((shape.count, folder)))

    def run(tests, folder, threads):
        asked.append((tests, threads))
        (folder / "runs").mkdir(parents=True)
        return [{"wall_steps_s": 1.2, "steps": 30}, {"wall_steps_s": 2.0, "steps": 50}]

    monkeypatch.setattr(campaign, "run", run)
    monkeypatch.setattr(calibration.time, "monotonic", lambda: next(clock))
    each, start = one.timed()
    assert each == pytest.approx(0.04 / disks, rel=1e-12)
    assert start == pytest.approx(12.0 * at_once / 2 - 1.6, rel=1e-12)
    prepared, (tests, given) = asked
    assert prepared == (disks, tmp_path / "timed" / "pressing") and given == threads
    assert [t.confining for t in tests] == [0.5 * 60e3, 48 * 60e3] and {t.strain for t in tests} == {strain}
    assert not (tmp_path / "timed").exists()


def test_a_test_that_is_all_steps_has_no_start(search, monkeypatch):
    one, clock = search(PEAK), iter((0.0, 1.0))
    monkeypatch.setattr(calibration.pressing, "prepare", lambda shape, folder: None)
    monkeypatch.setattr(campaign, "run", lambda tests, folder, threads: [{"wall_steps_s": 5.0, "steps": 10}] * 2)
    monkeypatch.setattr(calibration.time, "monotonic", lambda: next(clock))
    assert one.timed()[1] == 0.0
