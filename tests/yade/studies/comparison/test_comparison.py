"""Hard against soft: the mathematics of errors, work and rates on made-up data; plans, options and what reports say."""

import base64
import dataclasses
import json
import math
from pathlib import Path
from types import SimpleNamespace

import drawn
import numpy as np
import pytest

from yade.nonsmooth import section, worlds
from yade.nonsmooth.figures import style
from yade.nonsmooth.studies.comparison import (
    answers,
    biaxial_report,
    biaxials,
    cases,
    collapses,
    common,
    cost,
    cost_report,
    course,
    deposits,
    figures,
    losses,
    options,
    precision,
    report,
    slopes,
    summary,
)
from yade.nonsmooth.studies.comparison.outcomes import Cost, Outcome
from yade.nonsmooth.system import machine


@pytest.mark.parametrize("step, tolerance", [(2.0, 10.0), (0.5, 1.0)])
def test_numerics_of_a_hard_run_are_multiples_of_the_sections(step, tolerance):
    """Its step and the path of a step alike, so that both rule as often; those of soft runs stay."""
    usual = section.load("jiufengershan").numerics
    case = cases.Case("hard", "jiufengershan", 600, 3, step=step, tolerance=tolerance)
    made = slopes.section_of(case)
    n = made.numerics
    assert (n.time_step, n.path) == (step * usual.time_step, usual.path and step * usual.path) and made.seed == 3
    assert (n.tolerance, n.tolerance_moving) == (tolerance * usual.tolerance, tolerance * usual.tolerance_moving)
    assert usual.path, "a section whose steps have no path tells nothing of it"
    assert slopes.section_of(dataclasses.replace(case, world="soft")).numerics == usual


def test_walls_without_strength_hold_nothing():
    """Neither before nor after they have slipped, and no bonds; other walls stay, and so does the distance after which
    these weaken.
    """
    shipped = section.load("jiufengershan")
    made = cost._without_strength(shipped, {"DP", "FB"})
    for wall, before in zip(made.walls, shipped.walls):
        m, was = made.materials[wall.material], shipped.materials[before.material]
        if wall.name not in ("DP", "FB"):
            assert m == was
            continue
        assert (m.friction, m.residual_friction, m.tensile_strength, m.residual_tensile_strength) == (0, 0, 0, 0)
        assert m.bonded is False and m.slip_weakening == was.slip_weakening
    assert shipped.materials["fb"].bonded and set(shipped.materials) < set(made.materials)


def test_captions_name_the_packing_of_which_all_stiffnesses_are_shown(monkeypatch, tmp_path):
    """That of the first pair."""
    plan = SimpleNamespace(ensemble=[(SimpleNamespace(seed=k), SimpleNamespace(seed=k)) for k in (3, 4)])
    monkeypatch.setattr(common.figures, "courses", lambda groups, *others: groups)
    for name in ("by_seed", "by_stiffness"):
        monkeypatch.setattr(common, name, lambda plan, outcomes, of, name=name: name)
    assert common.motion_section(tmp_path, plan, [], "time [s]").plots == [
        ("by_seed", "All seeds."),
        ("by_stiffness", "All stiffnesses, seed 3."),
    ]
    for stiffness, plot in ((True, ("by_stiffness", "All stiffnesses, seed 3.")), (False, ("by_seed", "All seeds."))):
        made = common.course_section("Water", tmp_path, plan, [], (), (), stiffness)
        assert made.title == "Water" and made.plots == [plot]


# ---- deposits -------------------------------------------------------------------------------------
def test_the_outline_of_one_disk_has_sixteen_corners():
    """Drawn on a circle wider by the mean radius, and taken in by as much: a regular polygon whose sides are that much
    nearer to the centre.
    """
    (r,) = radius = np.array([2.0])
    inner = 2 * r * math.cos(math.pi / 16) - r
    outline = deposits.outline(np.array([5.0]), np.array([-1.0]), radius)
    # rounding, and corners that are taken in: none, since all sides are equally far
    assert outline.area == pytest.approx(16 * math.tan(math.pi / 16) * inner**2, rel=1e-6)


def test_overlap_of_deposits():
    """Two rectangles of disks, shifted by a third of their length: they share two thirds, so half of what either
    covers.
    """
    x, y = (v.ravel().astype(float) for v in np.meshgrid(np.arange(60), np.arange(6)))
    r = np.full(x.size, 0.5)
    one, shifted, away = (deposits.outline(x + d, y, r) for d in (0, 20, 200))
    assert deposits.overlap(one, one) == pytest.approx(1, abs=1e-12)
    assert deposits.overlap(one, shifted) == pytest.approx(0.5, abs=0.01)  # rounded corners of the outline
    assert deposits.overlap(one, away) == 0
    assert (
        deposits.common_area(one, shifted) == pytest.approx(2 / 3 * one.area, rel=0.01)
        and deposits.common_area(one, away) == 0
    )
    # 60 by 6 with pores closed; dents between disks along the rim, and circles drawn with 16 corners, take some per
    # cent
    assert one.area == pytest.approx(360, rel=0.05)


# ---- errors, work, rates --------------------------------------------------------------------------
def outcome(front, seed=1, water=10.0, world="hard", wall=10.0, **case):
    """An Outcome whose front moves linearly to ``front`` in 10 s and whose deposit is a row of disks from 0 to
    ``front``.
    """
    t = np.linspace(0, 10, 101)
    x = np.arange(0, front + 0.1)
    return Outcome(
        cases.Case(world, "made up", 10, seed, **case),
        {"water_at_failure_m": water, "front_travel_m": front},
        {"abscissa": t, "front": front * t / 10},
        {},
        None,
        (x, np.zeros_like(x), np.full_like(x, 0.5)),
        {},
        0.0,
        0.0,
        Cost(100, 0.1, wall, 10.0, wall / 10),
    )


def test_error_has_its_parts():
    found = precision.parts(outcome(110.0, water=12.0), outcome(100.0), ("water_at_failure_m",))
    # rms of a difference that grows from 0 to a tenth
    assert found["front"] == pytest.approx(0.1 / math.sqrt(3), rel=0.01)
    assert found["water_at_failure_m"] == pytest.approx(0.2)
    assert found["deposit"] == pytest.approx(1 - 101 / 111, abs=0.005)  # 101 of 111 disks in common
    whole = precision.error(outcome(110.0, water=12.0), outcome(100.0), ("water_at_failure_m",))
    assert whole == pytest.approx(math.sqrt(sum(v**2 for v in found.values()) / 3))
    assert precision.error(outcome(100.0), outcome(100.0)) == 0


def test_a_curve_that_has_ended_keeps_its_value():
    """Half of the time both are equal, then one has ended at 1 and the other goes on to 2."""
    one, other = np.linspace(0, 1, 11), np.linspace(0, 2, 21)
    found = precision.curve_difference(one, one, other, other)
    # rms of 0 on the first half, of 0 to 1 on the second, over 2
    assert found == pytest.approx(math.sqrt(1 / 6) / 2, rel=0.01)
    # over 1 where the reference is the one that has ended
    assert precision.curve_difference(other, other, one, one) == pytest.approx(math.sqrt(1 / 6), rel=0.01)


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


def test_a_run_with_other_bonds_is_shown_and_not_compared():
    hard = [outcome(104.0, wall=10.0), outcome(100.0, wall=40.0)]
    soft = [outcome(110.0, world="soft", wall=w, stiffness=e) for w, e in ((30.0, 1e8), (90.0, 1e9))]
    fragile = outcome(101.0, world="soft", wall=1.0, stiffness=1e8, fragile=True)  # the cheapest and nearest of all
    work = summary._work(hard, soft, [fragile], math.nan, ())
    found = work["against_hard"]
    assert [p["label"] for p in found["soft_aside"]] == ["soft, E = 100 MPa, fragile bonds"]
    assert found["soft_aside"][0]["error"] == pytest.approx(precision.error(fragile, hard[-1]))
    assert found["compared"]["soft"] == soft[0].case.name and len(found["soft"]) == 2 and len(found["hard"]) == 1
    panels = [
        (
            "made up",
            *(
                [(p["wall_s"], p["error"], p["label"]) for p in found[world]]
                for world in ("hard", "soft", "soft_aside")
            ),
        )
    ]
    (ax,) = figures.work_precision(panels, None).axes
    assert (
        drawn.points(drawn.line(ax, "soft, other bonds")).tolist() == [[1.0, found["soft_aside"][0]["error"]]]
        and len(drawn.points(drawn.line(ax, "soft"))) == 2
    )


def test_the_stiffest_run_is_not_the_stiffest_that_can_be_told():
    assert summary.stiffest_within([0.5, 0.05], 0.1) is True and summary.stiffest_within([0.05, 0.5], 0.1) is False
    assert (
        summary.stiffest_within([0.5, 0.05, math.nan], 0.1) is None and summary.stiffest_within([0.5], math.nan) is None
    )


def test_rates_and_lines_between_logarithms():
    moduli = np.array([1e7, 1e8, 1e9, 1e10])
    fit = precision.power_law(moduli, 3e3 / moduli)
    assert (
        fit.power == pytest.approx(-1)
        and fit(1e8) == pytest.approx(3e-5)
        and fit.power_error == pytest.approx(0, abs=1e-9)
    )
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
    # Student's t for two degrees of freedom
    assert found["difference_95"] == pytest.approx(4.303 * 0.1 / math.sqrt(3), rel=1e-3)
    assert found["agree"] is True
    assert summary.estimate([10.0, 10.1], [12.0, 12.1])["agree"] is False
    assert summary.estimate([10.0], [12.0])["agree"] is None
    # by hand: 0.7 ± 12.706 · 0.2 spans the scatter and zero; 0.2 ± 0.041 leaves zero out and is small beside the
    # scatter of 1.0
    assert summary.estimate([10.0, 11.0], [10.5, 11.9])["agree"] is None
    assert summary.estimate([10.0, 11.0, 12.0], [10.2, 11.2, 12.2 + 1e-9])["agree"] is True
    # the seed without a failure is left out
    assert summary.estimate([None, 10.0], [12.0, 11.0])["difference"] == pytest.approx(1.0)


def test_cost_at_equal_overlap():
    """Overlaps as 1/E and costs as √E: a hundredth of the softest's overlap takes a hundred times E, so ten times its
    cost.
    """
    soft = [
        {
            "stiffness_Pa": e,
            "overlap_mean_rel": 1e6 / e,
            "overlap_worst_rel": 1e7 / e,
            "rate": 2e-4 * math.sqrt(e),
            "time_step_s": 10 / math.sqrt(e),
            "wall_s_per_step": 2e-3,
        }
        for e in (1e8, 1e9, 1e10)
    ]
    hard = {"overlap_mean_rel": 1e-4, "overlap_worst_rel": 1e-2, "rate": 4.0}
    found = cost.summarise(
        {"hard": {"moving": hard, "rest": {**hard, "overlap_mean_rel": 1e-6}}, "soft": {"moving": soft, "rest": soft}}
    )
    assert (
        found["soft_over_hard_wall_equal_overlap"] == pytest.approx(2e-4 * 1e5 / 4)
        and found["equal_overlap_extrapolated"] is False
    )
    assert found["soft_over_hard_wall_rock_stiffness"] == pytest.approx(2e-4 * 1e5 / 4)
    assert found["states"]["moving"]["equal_worst_overlap"] == pytest.approx(2e-4 * math.sqrt(1e9) / 4, rel=1e-6)
    assert (
        found["states"]["rest"]["equal_overlap"] == pytest.approx(2e-4 * 1e6 / 4)
        and found["states"]["rest"]["equal_overlap_extrapolated"] is True
    )
    moving = found["states"]["moving"]
    assert (moving["overlap_power"], moving["rate_power"]) == pytest.approx((-1.0, 0.5), abs=1e-9)  # as made


def test_a_second_of_simulation_costs_the_median_of_the_blocks():
    found = cost._found(0.01, 50, [2e-3, 1e-3, 9e-3], [(1e-4, 1e-3), (3e-4, 5e-3), (2e-4, 2e-3)], 7, 0.1)
    assert found["wall_s_per_step"] == 2e-3 and found["rate"] == pytest.approx(0.2)  # 100 steps
    assert found["overlap_mean_rel"] == pytest.approx(2e-4) and found["overlap_worst_rel"] == 5e-3
    assert (found["steps"], found["contacts"], found["mean_speed_m_per_s"]) == (50, 7, 0.1)


def costs_told(*moduli):
    """What cost.run finds where overlaps go as 1/E, of soft contacts of these moduli [Pa]."""
    one = {
        "time_step_s": 1e-3,
        "wall_s_per_step": 1e-3,
        "overlap_mean_rel": 1e-3,
        "overlap_worst_rel": 1e-2,
        "rate": 1.0,
        "contacts": 10,
        "mean_speed_m_per_s": 0.1,
    }
    soft = [{**one, "stiffness_Pa": e, "overlap_mean_rel": 1e6 / e, "overlap_worst_rel": 1e7 / e} for e in moduli]
    told = cost.summarise({"hard": {"moving": one, "rest": one}, "soft": {"moving": soft, "rest": soft}})
    return told | summary.clean(
        {
            "disks": 10,
            "threads": 1,
            "steps_timed": 5,
            "relax_s": 1.0,
            "model": "friction",
            "bonds": "no bonds",
            "step_share": 0.8,
            "model_lacks": ["moments: none"],
            "damping": 0.2,
            "damping_moving": 0.02,
            "machine": machine.describe(),
        }
    )


def test_the_report_of_cost_names_bonds_and_losses(tmp_path, monkeypatch):
    told = costs_told(1e8, 1e9)
    monkeypatch.chdir(tmp_path)
    for _ in range(2):  # a resume writes it again
        cost_report.write(Path("out/cost"), told)  # as the command has it
    out = tmp_path / "out" / "cost"
    page = (out / "report.html").read_text()
    assert base64.b64encode((out / "figures" / "cost_and_overlap.png").read_bytes()).decode() in page
    assert (
        "friction, no bonds, 0.8 of the stable" in page
        and "Lost with friction, beside what cohesion_moment loses: moments: none." in page
    )
    # the page's table, for whoever quotes it
    ((title, heads, rows),) = json.loads((out / "summary.json").read_text())["tables"]
    assert title == "Cost and overlap" and [row[:2] for row in rows] == [
        [state, contacts]
        for state in ("during the avalanche", "at rest")
        for contacts in ("hard", "soft, E = 100 MPa", "soft, E = 1 GPa")
    ]
    assert dict(zip(heads, rows[2]))["mean overlap"] == "0.001"


def test_one_stiffness_gives_no_exponent_and_the_report_of_cost_says_so(tmp_path):
    """What equal overlap takes is not told as a number that is not known; what was measured is."""
    ((_, verdict, sentences),) = cost_report.write(tmp_path, costs_told(1e8))
    assert verdict == "not known" and sentences[0] == (
        "During the avalanche a second of simulation takes 1 s of wall time with rigid disks, and 1 times as long with "
        "soft contacts of E = 100 MPa, whose mean overlap is 0.01 of the mean diameter, that of rigid ones 0.001. One "
        "stiffness gives no exponent, of overlaps or of cost, so what soft contacts of equal overlap take is not "
        "known; give --stiffness two values or more. A rock's stiffness, 10 GPa, would take 10 times as long as rigid disks "
        "(extrapolated)."
    )
    ((_, _, (sentence, *_)),) = cost_report.write(tmp_path / "other", costs_told(81e6))
    assert "whose mean overlap is 0.012 of the mean diameter" in sentence  # two digits
    page = (tmp_path / "report.html").read_text()
    assert "E not known" not in page and "as another: ." not in page and page.count(cost_report.ONE_STIFFNESS) == 3
    ((_, _, sentences),) = cost_report.write(tmp_path, costs_told(1e8, 1e9))
    assert "One stiffness" not in "".join(sentences) and ". Soft contacts of equal mean overlap" in sentences[0]


def test_cost_of_a_stiffness_that_was_not_run():
    """Steps as 1/√E exactly; a step takes 2 ms with the softest and 4 ms with the stiffest, and no more beyond."""
    found = [precision.soft_rate(e, [1e9, 1e7], [1e-4, 1e-3], [4e-3, 2e-3]) for e in (1e8, 1e11, 1e6)]
    assert [f[0] for f in found] == pytest.approx(
        [math.sqrt(8e-6) / (1e-3 / math.sqrt(10)), 4e-3 / 1e-5, 2e-3 / (1e-3 * math.sqrt(10))]
    )
    assert [f[1] for f in found] == [False, True, True]
    assert math.isnan(precision.soft_rate(math.nan, [1e9], [1e-4], [1e-3])[0])


# ---- plans and answers ----------------------------------------------------------------------------
def test_plan_has_every_run_once():
    made = cases.plan("slope", 300, [1, 2, 3], [1e8, 1e7, 1e9])
    assert len(made.ensemble) == 3 and made.ensemble[0][1].stiffness == 1e8  # the middle one
    assert [c.stiffness for c in made.sweep] == [1e7, 1e8, 1e9]
    assert (
        made.numerics[-1].step < 1
        and made.damping.damping_moving == made.damping.damping
        and made.damping.stiffness == 1e8
    )
    # hard, soft of the middle, other stiffnesses, numerics, damping
    assert len(made.cases) == len({c.name for c in made.cases}) == 3 + 3 + 2 + 4 + 1


@pytest.mark.parametrize(
    "change, wanted",
    [
        ({"stiffnesses": [1e8]}, "--stiffness"),
        ({"stiffnesses": [-1, 1e8]}, "--stiffness"),
        ({"stiffnesses": [math.nan, 1e8]}, "--stiffness"),
        ({"stiffnesses": [1e8, math.inf]}, "--stiffness"),
        ({"seeds": [1, 1]}, "--seeds"),
        ({"seeds": [-1]}, "--seeds -1"),
        ({"seeds": []}, "--seeds"),
        ({"damping": 1.0}, "--damping"),
        ({"damping_moving": -0.1}, "--damping-moving"),
        ({"step_share": 1.5}, "--step-share 1.5"),
        ({"ensemble": -1e9}, "--ensemble-stiffness"),
    ],
)
def test_lists_that_cannot_be_used(change, wanted):
    with pytest.raises(cases.CaseError, match=wanted):
        cases.plan(**{"source": "slope", "disks": 300, "seeds": [1, 2], "stiffnesses": [1e8, 1e9], **change})


@pytest.mark.parametrize(
    "change, wanted",
    [
        ({"stiffnesses": [-1e8]}, "--stiffness -1e\\+08"),
        ({"disks": 0}, "--disks 0"),
        ({"steps": 0}, "--steps 0"),
        ({"damping": 2.0}, "--damping 2"),
        ({"step_share": 0.0}, "--step-share 0"),
    ],
)
def test_cost_refuses_before_it_measures(tmp_path, change, wanted):
    with pytest.raises(cases.CaseError, match=wanted):
        cost.run(tmp_path, **{"source": "jiufengershan", "disks": 300, "threads": 1, "stiffnesses": [1e8], **change})
    assert not list(tmp_path.iterdir())


def test_options_and_their_defaults():
    slope_, biaxial, measured = (
        options.read("", words) for words in ([], ["--scenario", "biaxial", "--confining", "2"], ["--cost"])
    )
    assert (slope_.seeds, slope_.model, slope_.bonds, slope_.damping, slope_.damping_moving) == (
        [1, 2, 3, 4, 5],
        "cohesion_moment",
        "ductile",
        0.2,
        0.02,
    )
    assert (slope_.step_share, slope_.without, slope_.disks, slope_.stiffness, slope_.steps) == (
        0.8,
        [],
        None,
        None,
        None,
    )
    assert biaxial.damping_moving is None and options.scenario_options(biaxial) == {"confining": 2e6}
    assert measured.steps == 300 and measured.damping_moving == 0.02 and measured.seeds is None


@pytest.mark.parametrize(
    "words, wanted",
    [
        ("--cost --bonds fragile --seeds 1 2", "--seeds 1 2, --bonds fragile with --cost"),
        ("--cost --without damping", "--without damping"),
        ("--cost --end 3", "--end 3"),
        ("--cost --aspect 2", "--aspect 2"),
        ("--cost --confining 2", "--confining 2"),
        ("--cost --ensemble-stiffness 1e9", "--ensemble-stiffness 1e\\+09"),
        ("--cost --scenario pile", "--cost with --scenario pile"),
        ("--scenario column --source wwr", "--source wwr with --scenario column"),
        ("--scenario pile --bonds ductile", "--bonds ductile"),
        ("--scenario biaxial --damping-moving 0.1", "--damping-moving 0.1 with --scenario biaxial"),
        ("--steps 30", "--steps 30 with --scenario slope"),
        ("--scenario slope --sides rigid", "--sides rigid"),
        ("--cost --disks 0", "--disks 0"),
        ("--disks -5", "--disks -5"),
        ("--threads 0", "--threads 0"),
        ("--cost --steps 4", "--steps 4: give 5"),
        ("--stiffness 1e8,nan", "--stiffness 1e\\+08,nan"),
        ("--end inf", "--end inf"),
        ("--model jcfpm --bonds fragile", "--bonds fragile with --model jcfpm"),
        ("--model friction --bonds ductile", "has no bonds"),
    ],
)
def test_options_that_do_not_apply(words, wanted):
    with pytest.raises(cases.CaseError, match=wanted):
        options.read("", words.split())


def soft_case(model="cohesion_moment", source="", disks=300, **more):
    return cases.Case(
        "soft", source, disks, 1, 0.8, stiffness=1e9, damping=0.2, damping_moving=0.02, model=model, **more
    )


@pytest.mark.parametrize("experiment, source", [(slopes, "jiufengershan"), (biaxials, "wwr")])
def test_what_the_report_says_of_bonds_and_losses(experiment, source):
    assert losses.of_case(experiment, soft_case(source=source)) == ("ductile bonds", [])
    assert losses.of_case(experiment, soft_case(source=source, fragile=True)) == ("fragile bonds", [])
    bonds, lost = losses.of_case(experiment, soft_case("jcfpm", source))
    assert bonds.startswith("fragile bonds") and any(line.startswith("moments") for line in lost)
    bonds, lost = losses.of_case(experiment, soft_case("friction", source))
    assert bonds.startswith("no bonds") and [line.split(":")[0] for line in lost] == ["bonds", "moments"]
    told = course.lacks({"model": "friction", "model_lacks": lost})
    assert len(told) == 2 and told[0].startswith("Lost with friction") and "bonds" in told[0]


def test_the_report_says_which_strength_is_not_the_same():
    """σ_res, which no soft model has and which is therefore not among what one model lacks beside another."""
    chosen = SimpleNamespace(ensemble=[(SimpleNamespace(disks=300), soft_case())])
    told = dict(seeds=[1, 2], stiffnesses_Pa=[1e9], bonds="ductile bonds", model="cohesion_moment", model_lacks=[])
    lead = course._lead(chosen, slopes, told | dict(runs_wall_s=1.0, wall_s=1.0, threads=1))
    assert "300 disks, seeds 1, 2" in lead[0] and "but for the residual tensile strength σ_res" in lead[0]


def test_columns_have_no_bonds_to_lose():
    assert losses.of_case(collapses.COLUMN, soft_case()) == ("no bonds between disks in either world", [])
    assert losses.of_case(collapses.PILE, soft_case("friction")) == ("no bonds between disks in either world", [])


def test_springs_too_weak_for_a_tall_column_are_refused_at_once():
    def sweep(aspect):
        return cases.plan(
            "", collapses.COLUMN.DISKS, [1], collapses.COLUMN.DEFAULT_STIFFNESSES, options={"aspect": aspect}
        ).sweep

    course.check_stiffnesses(collapses.COLUMN, sweep(2.0))
    with pytest.raises(cases.CaseError, match="--stiffness 1e\\+08: .* as --stiffness 1e\\+09,1e\\+10,1e\\+11"):
        course.check_stiffnesses(collapses.COLUMN, sweep(6.0))
    course.check_stiffnesses(slopes, [soft_case()])  # others have no such limit


def test_a_biaxial_test_needs_the_wall_time_of_its_steps_and_a_plateau(tmp_path):
    with pytest.raises(cases.CaseError, match="wall_steps_s.*--resume"):
        biaxials.measure(soft_case(source="wwr"), tmp_path, {"wall_s": 1.0})
    for strain in (0.001, 1.0, math.nan):
        with pytest.raises(cases.CaseError, match="--strain"):
            biaxials.test_of(soft_case(source="wwr", options={"strain": strain}))


def test_every_experiment_says_what_its_overlap_is():
    for experiment, _ in course.SCENARIOS.values():
        assert (
            experiment.OVERLAP.startswith("Mean overlap of")
            and len(experiment.OVERLAP_WHEN) == 2
            and experiment.COST_WHEN
        )
    assert "1 %" in collapses.COLUMN.OVERLAP


def test_the_report_of_a_biaxial_test(tmp_path, monkeypatch):
    """Made-up tests: overlaps are told as they were taken, the mean speed is drawn, and the run with fragile bonds is
    marked.
    """
    made = cases.plan("wwr", 100, [1, 2], [1e8, 1e9], damping_moving=None, bonds_run=True)
    strain = np.linspace(0, 0.06, 50)
    outcomes = {}
    for k, case in enumerate(made.cases):
        series = {"strain": strain, "bonds_alive": np.linspace(100, 40, 50), "speed_mean_m_per_s": np.full(50, 1e-3)}
        series |= {f"bonds_broken_{mode}": np.linspace(0, 15, 50) for mode in ("tension", "shear", "torque", "mixed")}
        outcomes[case] = Outcome(
            case,
            {"sigma1_peak_Pa": 4e6 + 1e4 * k},
            {"abscissa": strain, "stress": 4 + 0.1 * k + strain, "volume": strain},
            series,
            None,
            None,
            {(0, 1): 1.0, (1, 2): 2.0 + k, (2, 3): 1.5},
            1e-3,
            2e-3,
            Cost(100, 1e-3, 10.0 + k, 0.1, 100.0),
        )
    told = summary.summarise(biaxials, made, outcomes)
    assert (
        told["deposit_overlap_m2"] is None
        and told["convergence"]["rows"]["overlap"]["means"] == "mean overlap, before the test"
    )
    assert [p["run"] for p in told["work_precision"]["against_own"]["soft_aside"]] == [made.fragile.name]
    (tmp_path / "figures").mkdir()
    drawn.keep(monkeypatch, style)
    sections = [
        *biaxial_report.sections(tmp_path, biaxials, made, outcomes, told),
        *report.common_sections(tmp_path, biaxials, made, outcomes, told),
    ]
    by_title = {s.title: s for s in sections}
    assert "no kinetic energy" in by_title["Motion"].text[0] and by_title["Overlaps and cost"].plots[0][1].startswith(
        biaxials.OVERLAP
    )
    assert (
        "of the test" in by_title["Overlaps and cost"].plots[1][1]
        and "The open mark" in by_title["Work and precision"].text[0]
    )
    assert by_title["All runs"].tables[0][1][-2] == "mean overlap, at its end"


def test_numbers_for_readers():
    assert (
        answers.number(2.034e8, "N/m") == "203 MN/m"
        and answers.number(None, "m") == "not known"
        and answers.number(0.5, "1") == "0.5"
    )
    assert answers.number(12345.0, "m") == "12345 m"
    # one unit for both, that of the mean
    assert (
        answers.spread(4.58e6, 3.59e5, "Pa") == "4.58 ± 0.36 MPa" and answers.spread(15.94, 6.1, "m") == "15.9 ± 6.1 m"
    )
    assert answers.spread(None, None, "m") == "not known" and answers.spread(2.0, None, "1") == "2"


def test_the_overlap_of_a_snapshot_is_of_pairs_of_disks():
    """Overlaps of 2 % of the mean diameter and none; what touches a wall does not count."""
    made = SimpleNamespace(
        x=np.array([0.0, 1.47, 4.0]),
        y=np.zeros(3),
        r=np.array([0.5, 1.0, 0.5]),
        ci=np.array([0, 1, 2]),
        cj=np.array([1, 2, -1]),
    )
    assert biaxials._overlap(made) == pytest.approx(0.01, rel=1e-9)


def test_the_limit_of_stiffness_is_that_of_the_heap():
    """What passes before anything runs stands later; and what is refused is not far below: disks settle by some per
    cent of the box.
    """
    from yade.nonsmooth.heaps import column, course as heap_course, grains

    heap, least = column.Column(disks=100, aspect=1.0), collapses.COLUMN.least_stiffness(
        soft_case(disks=100, options={"aspect": 1.0})
    )
    heap_course.build(heap, worlds.Soft(least, heap.diameters()))
    with pytest.raises(grains.HeapError, match="overlap"):
        heap_course.build(heap, worlds.Soft(0.8 * least, heap.diameters()))
