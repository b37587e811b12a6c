"""Hard against soft in space: a small round column by the whole comparison, a small triaxial test in both worlds, what
is read from their records, and what is refused before anything runs.
"""

import dataclasses
import json
import math

import numpy as np
import pytest
from yade import O
from yade.nonsmooth.studies.comparison import (
    cases,
    collapse_report,
    course,
    losses,
    options,
    report,
    spheres,
    triaxial_report,
)
from yade.nonsmooth.studies.spheres import column, grains, places, triaxial
from yade.nonsmooth.world import sphere_worlds

SOFTEST, STIFFER = 1e5, 1e6  # Pa
SMALL = {"size": 4.0, "aspect": 0.8}


def case(world="hard", step=1.0, given=None, **more):
    soft = dict(stiffness=STIFFER, damping=0.2) if world == "soft" else {}
    return cases.Case(world, "", 0, 1, step, options=SMALL if given is None else given, **{**soft, **more})


# ---- a round column -------------------------------------------------------------------------------
@pytest.fixture(scope="module")
def compared(tmp_path_factory):
    """One column of a hundred spheres by the whole comparison: two hard runs and two soft ones."""
    out = tmp_path_factory.mktemp("round")
    O.reset()
    told, questions = course.compare(
        "round-column", out, [1], stiffnesses=[SOFTEST, STIFFER], without=["numerics"], threads=2, options=SMALL
    )
    return out, told, questions


def test_a_round_column_is_compared_with_its_report(compared):
    out, told, questions = compared
    assert json.loads((out / "summary.json").read_text()) == told
    runs = {run["name"]: run for run in told["runs"]}
    assert sorted(runs) == [
        "hard-step0.5-tolerance0.5-seed1",
        "hard-step1-tolerance1-seed1",
        "soft-1e05Pa-seed1",
        "soft-1e06Pa-seed1",
    ]
    assert told["disks"] == column.RoundColumn(**SMALL).count() and told["model"] is None
    assert told["bonds"] == "no bonds between spheres in either world" and told["model_lacks"] == []
    hard, soft, softer = (runs[f"{name}-seed1"] for name in ("hard-step1-tolerance1", "soft-1e06Pa", "soft-1e05Pa"))
    # springs under one weight yield as 1/E; a third of slack, since some of the softest come together more
    assert 7 < softer["overlap_rest_rel"] / soft["overlap_rest_rel"] < 14
    assert hard["overlap_mean_rel"] < 0.1 * soft["overlap_mean_rel"]
    assert softer["cost"]["step_s"] / soft["cost"]["step_s"] == pytest.approx(math.sqrt(10), rel=1e-6)
    found = json.loads((out / "runs" / hard["name"] / "result.json").read_text())["found"]
    assert hard["values"]["rest_s"] == found["time_s"] == hard["cost"]["simulated_s"]
    assert [hard["values"][name] for name in spheres.COLUMN.KEYS] == [found["runout_rel"], found["final_height_rel"]]
    page = (out / "report.html").read_text()
    lead = page.partition("<h2>")[0]
    assert (
        f"{told['disks']} spheres, seeds 1: the same packings and the same parameters" in lead and "σ_res" not in lead
    )
    # motion over seeds and stiffnesses, energy, overlaps, cost, work, convergence; neither outlines nor forces
    assert page.count("data:image/png") == 7
    assert [text for text, *_ in questions] == [collapse_report.QUESTIONS[0][0], course.COST_QUESTION]
    assert [row[0] for _, _, rows in told["tables"][:1] for row in rows] == [q.means for q in spheres.COLUMN.QUANTITIES]


def test_both_worlds_begin_with_the_same_spheres(compared):
    out, _, _ = compared
    hard, soft = (
        places.read_all(out / "runs" / name)[0] for name in ("hard-step1-tolerance1-seed1", "soft-1e06Pa-seed1")
    )
    assert np.array_equal(hard.r, soft.r)
    # springs yield by a thousandth of a diameter each, and a sphere that is held loosely falls over a part of one
    assert np.median(np.linalg.norm(hard.at - soft.at, axis=1)) < 0.05 * 0.01


def test_a_column_is_measured_from_its_records(tmp_path):
    """The edge goes from 4 to 7, the centre of mass down by 3; it moves while its energy is above a hundredth of the
    largest.
    """
    rows = {
        "step": [0, 100, 200, 300],
        "time_s": [0.0, 1.0, 2.0, 3.0],
        "edge_m": [4.0, 5.0, 8.0, 7.0],
        "centroid_z_m": [5.0, 4.0, 2.5, 2.0],
        "energy_kinetic_J": [0.0, 100.0, 2.0, 0.5],
        "overlap_mean_rel": [0.01, 0.02, 0.04, 0.5],
    }
    lines = [",".join(rows), *(",".join(map(str, row)) for row in zip(*rows.values()))]
    (tmp_path / "series.csv").write_text("\n".join(lines) + "\n")
    told = {"runout_rel": 0.75, "final_height_rel": 0.4, "runout_99_rel": 0.9, "repose_deg": 22.0}
    told |= {"time_s": 3.0, "ended": True, "steps": 300, "time_step_s": 0.01, "wall_s": 6.0}
    one = spheres.COLUMN.measure(case(), tmp_path, told)
    assert one.values == {name: told[name] for name in list(told)[:4]} | {"rest_s": 3.0} and one.notes == []
    assert one.curves["front"].tolist() == [0, 1, 4, 3] and one.curves["centroid"].tolist() == [0, 1, 2.5, 3]
    assert (one.overlap, one.overlap_rest) == (pytest.approx(0.03), 0.01)
    assert (one.cost.wall_s, one.cost.simulated_s, one.cost.rate) == (6.0, 3.0, 2.0)
    assert one.deposit is None and one.forces == {}
    restless = spheres.COLUMN.measure(case(), tmp_path, {**told, "ended": False, "runout_rel": None})
    assert restless.values["rest_s"] is None and restless.values["runout_rel"] is None
    assert restless.notes == ["stopped before it was at rest"]


# ---- a triaxial test ------------------------------------------------------------------------------
#: A dense sample of some 140 spheres.
TEST = {"size": 5.0, "strain": 0.05, "friction_share": 0.0, "confining": 2e5}


@pytest.fixture(scope="module")
def tested(tmp_path_factory):
    """{world: (Outcome, numbers of the run)} of one sample."""
    found = {}
    for world in ("hard", "soft"):
        O.reset()
        folder = tmp_path_factory.mktemp(world)
        one = case(world, 0.8 if world == "soft" else 1.0, TEST, **({"stiffness": 2e8} if world == "soft" else {}))
        spheres.TRIAXIAL.prepare(one)
        ran = spheres.TRIAXIAL.run(folder, **dataclasses.asdict(one))
        found[world] = spheres.TRIAXIAL.measure(one, folder, ran), ran
    return found


def test_a_triaxial_test_in_both_worlds(tested):
    (hard, ran), (soft, soft_ran) = tested["hard"], tested["soft"]
    assert ran["scene"]["pressure"] == soft_ran["scene"]["pressure"] == 2e5
    assert (soft_ran["settings"]["stiffness"], soft_ran["settings"]["step_share"]) == (2e8, 0.8)
    assert ran["spheres"] == soft_ran["spheres"]
    for one, told in ((hard, ran), (soft, soft_ran)):
        assert one.values == {q.name: told[q.name] for q in spheres.TRIAXIAL.QUANTITIES}
        assert one.cost.simulated_s == pytest.approx(told["steps"] * told["time_step_s"], rel=1e-9)
        # the largest of the curve is the ratio of the peak, tan²(45° + φ/2)
        tangent = math.tan(math.radians(45 + one.values["peak_deg"] / 2))
        assert np.max(one.curves["stress"]) == pytest.approx(tangent**2, rel=1e-9)
        assert one.curves["abscissa"][np.argmax(one.curves["stress"])] == pytest.approx(one.values["strain_peak"])
        assert one.curves["volume"][-1] == pytest.approx(one.values["volumetric_strain_end"], abs=0.01)
    # σ₃/E = 1e-3: contacts overlap by some 2 (σ₁ + 2 σ₃)/3 E; the solver leaves 1e-4 at most
    assert 5e-4 < soft.overlap_rest < 4e-3 and soft.overlap > soft.overlap_rest and hard.overlap < 1e-4
    # so few spheres scatter by some degrees, springs of this stiffness by 4 to 35 % of the deviator
    assert soft.values["peak_deg"] == pytest.approx(hard.values["peak_deg"], abs=8)
    assert soft.values["isotropic_solid_fraction"] == pytest.approx(hard.values["isotropic_solid_fraction"], rel=0.03)


def test_the_report_of_a_triaxial_test_draws_stress_volume_and_packing(tested, tmp_path):
    (tmp_path / "figures").mkdir()
    plan = cases.plan("", 0, [1], [1e8, 2e8], options=TEST, damping_moving=None, model=None)
    hard, soft = (tested[world][0] for world in ("hard", "soft"))
    outcomes = {one: hard if one.world == "hard" else soft for one in plan.cases}
    made = triaxial_report.sections(tmp_path, spheres.TRIAXIAL, plan, outcomes, {})
    assert [(s.title, len(s.plots)) for s in made] == [("Stress and volume", 2), ("Packing in the middle", 1)]
    assert "running means over 1 % of strain" in made[0].plots[0][1]
    assert all(path.stat().st_size > 5000 for s in made for path, _ in s.plots)
    assert isinstance(made[0], report.ReportSection)


# ---- cases ----------------------------------------------------------------------------------------
def test_numerics_of_a_hard_run_are_multiples_of_the_scenes():
    scene = column.RoundColumn(**SMALL)
    usual = grains.world_of(scene)
    assert grains.world_of(scene, **spheres.world_of(case())) == usual
    coarse = grains.world_of(scene, **spheres.world_of(case(step=2.0, tolerance=10.0)))
    assert coarse == dataclasses.replace(
        usual, time_step=2 * usual.time_step, tolerance=10 * usual.tolerance, reach=2 * usual.reach
    )
    # a smaller step leaves the reach as it is
    fine = grains.world_of(scene, **spheres.world_of(case(step=0.5)))
    assert fine == dataclasses.replace(usual, time_step=0.5 * usual.time_step)
    soft = grains.world_of(scene, **spheres.world_of(case("soft", 0.7, damping=0.1)))
    assert soft == sphere_worlds.SoftSpheres(STIFFER, scene.diameters(), damping=0.1, step_share=0.7)


def test_defaults_run_and_have_no_bonds():
    for name in ("round-column", "triaxial"):
        experiment, _ = course.SCENARIOS[name]
        for modulus in experiment.DEFAULT_STIFFNESSES:
            experiment.check(case("soft", 0.8, {}, stiffness=modulus))
        assert experiment.ENSEMBLE_STIFFNESS in experiment.DEFAULT_STIFFNESSES
        assert losses.of_case(experiment, case("soft", 0.8, {}))[0].startswith("no bonds")
    assert spheres.TRIAXIAL.count({"size": 5.0}) == triaxial.TriaxialTest(size=5.0).count()


@pytest.mark.parametrize(
    "scenario, change, wanted",
    [
        ("round-column", {"stiffnesses": [1e4, 1e7]}, "stiffness 10000 Pa: spheres at the bottom would overlap"),
        ("triaxial", {"stiffnesses": [1e6, 1e8]}, "stiffness 1e\\+06 Pa: spheres under 100000 Pa would overlap"),
        ("triaxial", {"options": {"confining": 1e6}}, "stiffness 2e\\+07 Pa: spheres under 1e\\+06 Pa"),
        ("round-column", {"disks": 100}, "--disks 100: .* give --size"),
        ("round-column", {"options": {"base": "rough"}}, "options 'base': round-column has .*size"),
        ("round-column", {"options": {"size": 1.0}}, "size 1.0: give the radius"),
        ("triaxial", {"options": {"strain": 0.01}}, "strain 0.01: give the axial strain"),
        ("triaxial", {"damping": 1.0}, "--damping 1"),
    ],
)
def test_what_cannot_be_is_refused_before_anything_runs(tmp_path, scenario, change, wanted):
    with pytest.raises(Exception, match=wanted) as told:
        course.compare(scenario, tmp_path / "out", [1], **change)
    assert isinstance(told.value, (cases.CaseError, grains.SpheresError)) and not (tmp_path / "out").exists()


# ---- the command ----------------------------------------------------------------------------------
def test_options_of_the_command_reach_the_scene():
    read = options.read("", "--scenario triaxial --size 6 --confining 0.2 --strain 0.1 --friction 0.3".split())
    assert options.scenario_options(read) == {"size": 6.0, "confining": 2e5, "strain": 0.1, "friction": 0.3}
    scene = spheres.TRIAXIAL.scene(options.scenario_options(read), 7)
    assert scene == triaxial.TriaxialTest(size=6.0, pressure=2e5, strain=0.1, friction=0.3, seed=7)
    assert (read.damping, read.step_share, read.model, read.damping_moving, read.bonds) == (0.2, 0.8, None, None, None)
    read = options.read("", "--scenario round-column --size 5 --aspect 2 --friction 0.4".split())
    made = spheres.COLUMN.scene(options.scenario_options(read), 3)
    assert made == column.RoundColumn(size=5.0, aspect=2.0, friction=0.4, seed=3)


@pytest.mark.parametrize(
    "words",
    [
        "--scenario round-column --disks 500",
        "--scenario round-column --model friction",
        "--scenario round-column --damping-moving 0.1",
        "--scenario round-column --base rough",
        "--scenario round-column --strain 0.1",
        "--scenario round-column --bonds ductile",
        "--scenario triaxial --aspect 2",
        "--scenario triaxial --sides rigid",
        "--scenario triaxial --source wwr",
        "--scenario column --size 5",
        "--scenario biaxial --size 5",
    ],
)
def test_options_that_have_no_meaning_are_refused(words):
    _, scenario, flag, _ = words.split()
    with pytest.raises(
        cases.CaseError, match=f"{flag} .* with --scenario {scenario}: that does not apply there"
    ) as told:
        options.read("", words.split())
    assert ("--size" in str(told.value).partition("or take")[2]) == (scenario in ("round-column", "triaxial"))
