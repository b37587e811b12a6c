"""Hard against soft: the mathematics of errors, work and rates on made-up data; tiny slopes in both worlds; a resume that keeps what has finished."""

import dataclasses
import json
import math
import os
import shutil
from pathlib import Path

import numpy as np
import pytest

from yade.nonsmooth import packing, section, slope, worlds
from yade.nonsmooth.comparison import answers, cases, collapses, cost, course, deposits, precision, runs, slopes, summary
from yade.nonsmooth.comparison.outcomes import Cost, Outcome

SHIPPED = Path(slopes.section.__file__).parent / "sections" / "jiufengershan.yaml"
# The shipped section with short stages and a looser solve, so that a run takes seconds.
QUICK = {"packing_fraction: 0.848": "packing_fraction: 0.82", "ramp: 4.0": "ramp: 1.0", "time_max: 30.0": "time_max: 1.2",
         "dry: 3.0": "dry: 0.3", "tolerance: 2e-6": "tolerance: 1e-3", "max_iterations: 300": "max_iterations: 40"}


# ---- deposits -------------------------------------------------------------------------------------
def test_overlap_of_deposits():
    """Two rectangles of disks, shifted by a third of their length: they share two thirds, so half of what either covers."""
    x, y = (v.ravel().astype(float) for v in np.meshgrid(np.arange(60), np.arange(6)))
    r = np.full(x.size, 0.5)
    one, shifted, away = (deposits.outline(x + d, y, r) for d in (0, 20, 200))
    assert deposits.overlap(one, one) == pytest.approx(1, abs=1e-12)
    assert deposits.overlap(one, shifted) == pytest.approx(0.5, abs=0.01)  # rounded corners of the outline
    assert deposits.overlap(one, away) == 0
    # 60 by 6 with pores closed; dents between disks along the rim, and circles drawn with 16 corners, take some per cent
    assert one.area == pytest.approx(360, rel=0.05)


# ---- errors, work, rates --------------------------------------------------------------------------
def outcome(front, seed=1, water=10.0, world="hard", wall=10.0, **case):
    """An Outcome whose front moves linearly to ``front`` in 10 s and whose deposit is a row of disks from 0 to ``front``."""
    t = np.linspace(0, 10, 101)
    x = np.arange(0, front + 0.1)
    return Outcome(cases.Case(world, "made up", 10, seed, **case), {"water_at_failure_m": water, "front_travel_m": front},
                   {"abscissa": t, "front": front * t / 10},
                   {}, None, (x, np.zeros_like(x), np.full_like(x, 0.5)), {}, 0.0, 0.0, Cost(100, 0.1, wall, 10.0, wall / 10))


def test_error_has_its_parts():
    found = precision.parts(outcome(110.0, water=12.0), outcome(100.0), ("water_at_failure_m",))
    assert found["front"] == pytest.approx(0.1 / math.sqrt(3), rel=0.01)  # rms of a difference that grows from 0 to a tenth
    assert found["water_at_failure_m"] == pytest.approx(0.2)
    assert found["deposit"] == pytest.approx(1 - 101 / 111, abs=0.005)  # 101 of 111 disks in common
    whole = precision.error(outcome(110.0, water=12.0), outcome(100.0), ("water_at_failure_m",))
    assert whole == pytest.approx(math.sqrt(sum(v**2 for v in found.values()) / 3))
    assert precision.error(outcome(100.0), outcome(100.0)) == 0


def test_a_curve_that_has_ended_keeps_its_value():
    """Half of the time both are equal, then one has ended at 1 and the other goes on to 2."""
    one, other = np.linspace(0, 1, 11), np.linspace(0, 2, 21)
    found = precision.curve_difference(one, one, other, other)
    assert found == pytest.approx(math.sqrt(1 / 6) / 2, rel=0.01)  # rms of 0 on the first half, of 0 to 1 on the second, over 2


def test_scatter_is_the_median_of_all_pairs():
    seeds = [outcome(f, seed=k) for k, f in enumerate((100.0, 100.0, 110.0))]
    pairs = sorted([0.0, 0.0] + [precision.error(a, b) for a, b in ((seeds[0], seeds[2]), (seeds[2], seeds[0]))] * 2)
    assert precision.scatter(seeds) == pytest.approx(np.median(pairs))
    assert math.isnan(precision.scatter(seeds[:1]))


def test_work_at_equal_error():
    hard, soft = [(10, 0.2), (20, 0.1), (40, 0.05)], [(30, 0.3), (90, 0.1), (400, 0.08)]
    found = precision.compare_work(hard, soft)
    # both reach 0.08: hard in 40 s (0.05), soft in 400 s
    assert (found.error, found.hard, found.soft, found.factor, found.at_scatter) == (0.08, 2, 2, 10.0, False)
    found = precision.compare_work(hard, soft, floor=0.15)
    assert (found.error, found.hard, found.soft, found.factor, found.at_scatter) == (0.15, 1, 1, 4.5, True)
    assert precision.compare_work(hard, [(30, math.nan)]) is None


def test_rates_and_lines_between_logarithms():
    moduli = np.array([1e7, 1e8, 1e9, 1e10])
    fit = precision.power_law(moduli, 3e3 / moduli)
    assert fit.power == pytest.approx(-1) and fit(1e8) == pytest.approx(3e-5) and fit.power_error == pytest.approx(0, abs=1e-9)
    assert precision.power_law([1e7], [1.0]) is None
    value, beyond = precision.loglog(1e11, moduli, np.sqrt(moduli))
    assert value == pytest.approx(math.sqrt(1e11)) and beyond
    value, beyond = precision.loglog(3e8, moduli, np.sqrt(moduli))
    assert value == pytest.approx(math.sqrt(3e8)) and not beyond
    assert math.isnan(precision.loglog(0.0, moduli, moduli)[0])


def test_forces_at_the_same_contacts():
    one = {(0, 1): 1.0, (1, 2): 3.0, (2, 3): 2.0}
    assert precision.force_difference(one, one) == (0.0, pytest.approx(1.0))
    other = {(0, 1): 1.0, (1, 2): 3.0, (3, 4): 2.0}  # a contact gone, another come
    rms, correlation = precision.force_difference(other, one)
    assert rms == pytest.approx(math.sqrt(8 / 4) / 2) and correlation < 1


def test_difference_and_scatter_over_seeds():
    found = summary.estimate([10.0, 11.0, 12.0], [10.5, 11.6, 12.4])
    assert found["hard"]["mean"] == pytest.approx(11) and found["hard"]["sd"] == pytest.approx(1)
    assert found["difference"] == pytest.approx(0.5)
    assert found["difference_95"] == pytest.approx(4.303 * 0.1 / math.sqrt(3), rel=1e-3)  # Student's t for two degrees of freedom
    assert found["within_scatter"] is True
    assert summary.estimate([10.0, 10.1], [12.0, 12.1])["within_scatter"] is False
    assert summary.estimate([10.0], [12.0])["within_scatter"] is None
    assert summary.estimate([None, 10.0], [12.0, 11.0])["difference"] == pytest.approx(1.0)  # the seed without a failure is left out


def test_cost_at_equal_overlap():
    """Overlaps as 1/E and costs as √E: a hundredth of the softest's overlap takes a hundred times E, so ten times its cost."""
    soft = [{"stiffness_Pa": e, "overlap_mean_rel": 1e6 / e, "overlap_worst_rel": 1e7 / e, "rate": 2e-4 * math.sqrt(e), "time_step_s": 10 / math.sqrt(e),
             "wall_s_per_step": 2e-3} for e in (1e8, 1e9, 1e10)]
    hard = {"overlap_mean_rel": 1e-4, "overlap_worst_rel": 1e-2, "rate": 4.0}
    found = cost.summarise({"hard": {"moving": hard, "rest": {**hard, "overlap_mean_rel": 1e-6}}, "soft": {"moving": soft, "rest": soft}})
    assert found["soft_over_hard_wall_equal_overlap"] == pytest.approx(2e-4 * 1e5 / 4) and found["equal_overlap_extrapolated"] is False
    assert found["soft_over_hard_wall_rock_stiffness"] == pytest.approx(2e-4 * 1e5 / 4)
    assert found["states"]["moving"]["equal_worst_overlap"] == pytest.approx(2e-4 * math.sqrt(1e9) / 4, rel=1e-6)
    assert found["states"]["rest"]["equal_overlap"] == pytest.approx(2e-4 * 1e6 / 4) and found["states"]["rest"]["equal_overlap_extrapolated"] is True


def test_cost_of_a_stiffness_that_was_not_run():
    """Steps as 1/√E exactly; a step takes 2 ms with the softest and 4 ms with the stiffest, and no more beyond."""
    found = [precision.soft_rate(e, [1e9, 1e7], [1e-4, 1e-3], [4e-3, 2e-3]) for e in (1e8, 1e11, 1e6)]
    assert [f[0] for f in found] == pytest.approx([math.sqrt(8e-6) / (1e-3 / math.sqrt(10)), 4e-3 / 1e-5, 2e-3 / (1e-3 * math.sqrt(10))])
    assert [f[1] for f in found] == [False, True, True]
    assert math.isnan(precision.soft_rate(math.nan, [1e9], [1e-4], [1e-3])[0])


# ---- plans and answers ----------------------------------------------------------------------------
def test_plan_has_every_run_once():
    made = cases.plan("slope", 300, [1, 2, 3], [1e8, 1e7, 1e9])
    assert len(made.ensemble) == 3 and made.ensemble[0][1].stiffness == 1e8  # the middle one
    assert [c.stiffness for c in made.sweep] == [1e7, 1e8, 1e9]
    assert made.numerics[-1].step < 1 and made.damping.damping_moving == made.damping.damping and made.damping.stiffness == 1e8
    assert len(made.cases) == len({c.name for c in made.cases}) == 3 + 3 + 2 + 4 + 1  # hard, soft of the middle, other stiffnesses, numerics, damping


@pytest.mark.parametrize("change, wanted", [({"stiffnesses": [1e8]}, "--stiffness"), ({"stiffnesses": [-1, 1e8]}, "--stiffness"),
                                            ({"seeds": [1, 1]}, "--seeds"),
                                            ({"seeds": []}, "--seeds"), ({"damping": 1.0}, "--damping")])
def test_lists_that_cannot_be_used(change, wanted):
    with pytest.raises(cases.ComparisonError, match=wanted):
        cases.plan(**{"source": "slope", "disks": 300, "seeds": [1, 2], "stiffnesses": [1e8, 1e9], **change})


def test_numbers_for_readers():
    assert answers.number(2.034e8, "N/m") == "203 MN/m" and answers.number(None, "m") == "not known" and answers.number(0.5, "1") == "0.5"
    assert answers.number(12345.0, "m") == "12345 m"
    # one unit for both, that of the mean
    assert answers.spread(4.58e6, 3.59e5, "Pa") == "4.58 ± 0.36 MPa" and answers.spread(15.94, 6.1, "m") == "15.9 ± 6.1 m"
    assert answers.spread(None, None, "m") == "not known" and answers.spread(2.0, None, "1") == "2"


# ---- one slope, two worlds ------------------------------------------------------------------------
@pytest.fixture(scope="module")
def source(tmp_path_factory):
    text = SHIPPED.read_text()
    for old, new in QUICK.items():
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    path = tmp_path_factory.mktemp("section") / "quick.yaml"
    path.write_text(text)
    return path


def test_the_same_disks_and_bonds_in_both_worlds(source):
    s = dataclasses.replace(section.load(source).with_disks(300), seed=1)
    made = packing.cached_pack(s)
    found = {}
    for world in (None, worlds.Soft(1e8, (s.disks.d_min, s.disks.d_max))):
        from yade import O

        built = slope.build(s, made, world)
        layers = slope.layers_of(built)
        table = built.solver.disks if world else None
        O.step()
        found[bool(world)] = (built.solver.bond(), layers.tolist(), [O.bodies[built.first_disk + k].shape.radius for k in range(built.count)])
        assert world is None or table["mass"].sum() == pytest.approx(2500 * math.pi * np.sum(made.r**2))
    # the same gaps are bonded; at the backstop a few of some hundred may be the hard world's alone
    assert found[False][1:] == found[True][1:] and 0.9 * found[False][0] <= found[True][0] <= found[False][0]


@pytest.fixture(scope="module")
def compared(source, tmp_path_factory):
    """Two seeds, two stiffnesses, a few seconds of simulation each."""
    out = tmp_path_factory.mktemp("compared")
    told, questions = course.compare("slope", out, [1, 2], disks=300, source=str(source), stiffnesses=[1e7, 1e8], threads=2, without=course.PARTS,
                                     options={"end": 1.0})
    return out, told, questions


def test_summary_and_report(compared):
    out, told, questions = compared
    assert json.loads((out / "summary.json").read_text()) == told
    for key in ("water_at_failure_hard_m", "water_at_failure_soft_m", "front_travel_hard_m", "front_travel_soft_m", "deposit_overlap_fraction",
                "soft_over_hard_wall_equal_overlap", "soft_over_hard_wall_rock_stiffness"):
        assert key in told
    # the same packing, which has hardly moved
    assert 0.7 < told["deposit_overlap_fraction"] <= 1
    by_name = {run["name"]: run for run in told["runs"]}
    soft, softer = (by_name[f"soft-{e}Pa-seed1"] for e in ("1e08", "1e07"))
    # springs under one load yield as 1/E; twofold slack, since the mass moves in other ways
    assert 5 < softer["overlap_rest_rel"] / soft["overlap_rest_rel"] < 20
    # and the stable step goes with 1/√E: √10 times as many steps, rounded to rows
    assert soft["cost"]["steps"] / softer["cost"]["steps"] == pytest.approx(math.sqrt(10), rel=0.1)
    page = (out / "report.html").read_text()
    assert page.index("Do both models fail") < page.index("<h2>") and "://" not in page.replace("http://www.w3.org",
        "") and page.count("data:image/png") >= 10
    assert [q[0] for q in questions] == ["Do both models fail at the same water table and run out as far, within the scatter over seeds?",
                                         course.COST_QUESTION]


def test_series_of_both_worlds_have_the_same_columns(compared):
    out, _, _ = compared
    heads = {folder.name.split("-")[0]: (folder / "series.csv").read_text().splitlines()[0].split(",") for folder in sorted((out / "runs").iterdir())}
    from yade.nonsmooth import experiment

    assert heads["hard"] == list(experiment.COLUMNS)
    assert heads["soft"] == [name for name in experiment.COLUMNS if name not in experiment.OF_SOLVER]


def test_resume_keeps_what_has_finished(compared, source, tmp_path):
    out, told, _ = compared
    copy = tmp_path / "copy"
    shutil.copytree(out, copy)
    gone = copy / "runs" / "soft-1e07Pa-seed1" / "result.json"
    gone.unlink()
    before = {path: path.stat().st_mtime_ns for path in copy.glob("runs/*/result.json")}
    again, _ = course.compare("slope", copy, [1, 2], disks=300, source=str(source), stiffnesses=[1e7, 1e8], threads=1, without=course.PARTS,
                              options={"end": 1.0}, resume=True)
    assert {path: path.stat().st_mtime_ns for path in before} == before and gone.exists()
    values = {run["name"]: run["values"] for run in told["runs"]}
    assert {run["name"]: run["values"] for run in again["runs"]} == values  # soft runs give the same bits on one thread too


def test_a_run_that_fails_says_so_and_keeps_the_others(tmp_path):
    made = [cases.Case("hard", "no-such-section", 300, 1)]
    with pytest.raises(cases.ComparisonError, match="no-such-section.*--resume"):
        runs.run(slopes.run, made, tmp_path, 1)


# ---- a column -------------------------------------------------------------------------------------
def test_a_column_in_both_worlds(tmp_path):
    options = {"aspect": 1.0}
    found = {}
    for case in (cases.Case("hard", "", 100, 1, options=options), cases.Case("soft", "", 100, 1, 0.5, stiffness=3e7, damping=0.2, damping_moving=0.02,
                                                                            model="cohesion_moment", options=options)):
        folder = tmp_path / case.name
        folder.mkdir()
        found[case.world] = collapses.COLUMN.measure(case, folder, collapses.run_column(folder, **dataclasses.asdict(case)))
    # so few grains scatter by more than half; a column that does not spread, or flies apart, is out by far more than a factor of three
    assert 1 / 3 < found["hard"].values["front_travel_m"] / found["soft"].values["front_travel_m"] < 3
    assert found["soft"].overlap > 1e-4 > found["hard"].overlap
    assert len(found["hard"].forces) > 30 and len(found["soft"].forces) > 30


def test_the_script_refuses_in_one_line(tmp_path):
    import subprocess

    script = Path(os.environ["YADE_PREFIX"]).parents[1] / "scripts" / "compare_hard_soft.py"
    for options, wanted in ((("--scenario", "biaxial", "--aspect", "2"), "--aspect"),
                            (("--cost", "--scenario", "pile"), "--cost")):
        done = subprocess.run([script, *options, "--out", tmp_path], capture_output=True, text=True)
        assert done.returncode != 0 and wanted in done.stderr and "Traceback" not in done.stderr
