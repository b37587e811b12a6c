"""The factor of safety of a block whose own is known exactly; of both worlds, with water, and after a stop."""

import dataclasses
import json
import math
import os
import random
import signal

import numpy as np
import pytest
import shell
import sliding_block
import yaml
from shell import ROOT
from yade import O
from yade.nonsmooth import records, runs, section
from yade.nonsmooth.course import driver, strength_reduction as reduction
from yade.nonsmooth.model import materials, rocks
from yade.nonsmooth.records import checkpoints
from yade.nonsmooth.running import processes
from yade.nonsmooth.studies.safety import asked as safety_asked, pictures, results, search
from yade.nonsmooth.studies.slope import slope, slope_packing

SOFT = {"name": "soft", "stiffness": 1e9}
FINE = {"step": 0.05, "within": 0.004}
# speeds and times of these 16 disks: an excess of 0.1 % of strength moves them by 0.03 m/s within the longest trial
ROUNDING = 1e-9
KILLS = int(os.environ.get("NONSMOOTH_KILLS", "2"))


def found(folder, world=None, made=None, numbers=FINE, **values):
    """Summary of a search of the block in its ``folder``, and its exact factor, by the disks that lie there. ``made``:
    another Section of a block on a plane of this dip.
    """
    O.reset()
    made = made or sliding_block.block(**values)
    asked = safety_asked.Asked(made, materials=("plane",), world=world or {}, numbers=numbers)
    summary = search.run(asked, folder)
    checkpoints.read(folder / "stable", asked.key, RuntimeError)
    plane = made.materials["plane"]
    water, built = (0.0, 0.0), next((e for e in O.engines if type(e).__name__ == "PorePressureEngine"), None)
    if built is not None:
        O.step()  # what acts on the disks is not saved
        water = made.side * built.totalForce[0], built.totalForce[1]
        assert built.wetCount > 0
    return summary, sliding_block.exact((plane.friction, plane.tensile_strength), water)


def holds(summary, exact, slack=0.0):
    """Whether the bracket holds the exact factor and is as narrow as asked."""
    low, high = summary["factor_low"], summary["factor_high"]
    assert summary["verdict"] == "found" and high - low <= FINE["within"] * low
    assert low * (1 - slack) <= exact <= high * (1 + slack), (low, exact, high)
    return True


def test_a_dry_block_has_its_exact_factor(tmp_path):
    summary, exact = found(tmp_path)
    assert 1.1 < exact < 1.5 and holds(summary, exact)
    assert summary["failing_share"] == pytest.approx(1.0)  # all of it slides
    assert summary["wall_s"] > summary["wall_steps_s"] > 0
    # the growth goes by its steps, and each trial is told
    grown = [t["factor"] for t in summary["trials"]]
    assert grown[:3] == pytest.approx([1.0, 1.05, 1.1025]) and grown[0] == 1.0
    assert [t["trial"] for t in summary["trials"]] == list(range(len(grown)))


def test_friction_alone_is_that_of_a_block_without_cohesion(tmp_path):
    """On a plane that is not bonded: tan φ / tan β."""
    summary, exact = found(tmp_path, tension=0.0, friction=0.7)
    assert exact == pytest.approx(0.7 / math.tan(math.radians(sliding_block.DIP)), rel=1e-6)
    assert holds(summary, exact)


def test_water_lowers_it_by_what_it_lifts(tmp_path):
    dry = found(tmp_path / "dry")[1]
    summary, exact = found(tmp_path / "wet", table=1.2)
    assert exact < dry - 0.05 and holds(summary, exact)
    assert summary["water_m"] == pytest.approx(1.2)


def test_priests_block_with_water_in_its_crack(tmp_path):
    """By limit equilibrium 1.048; with a face of exactly 60° it is the 1.049 that is quoted."""
    c, s, tan = math.cos(math.radians(30)), 0.5, math.tan(math.radians(30))
    weight, crack, plane = 25 * 329.55, 0.5 * 9.81 * 3.75**2, 0.5 * 9.81 * 3.75 * 30  # kN/m
    book = (20 * 30 + (weight * c - plane - crack * s) * tan) / (weight * s + crack * c)
    assert book == pytest.approx(1.048, abs=5e-4)
    made = section.load("priest")
    summary, exact = found(tmp_path, made=made)
    assert holds(summary, exact)
    assert exact == pytest.approx(book, rel=0.01)  # the disks' weight and bonds are the book's to some per cent
    assert summary["factor"] == pytest.approx(book, rel=0.02)


def test_a_block_that_fails_as_it_is_has_a_factor_below_one(tmp_path):
    summary, exact = found(tmp_path, friction=0.3)
    assert 0.5 < exact < 0.9 and holds(summary, exact)
    assert [t["factor"] for t in summary["trials"][:2]] == [1.0, 0.5]
    assert [t["trial"] for t in summary["trials"][:3]] == [0, 0, 1]


def test_soft_contacts_by_the_same_search(tmp_path):
    summary, exact = found(tmp_path, world=SOFT)
    assert holds(summary, exact, slack=0.01)  # bonds and springs bend; the bracket itself is 0.4 % wide


def test_a_block_on_a_level_plane_stands_for_ever(tmp_path, monkeypatch):
    monkeypatch.setattr(sliding_block, "DIP", 0.0)
    made = sliding_block.block()
    O.reset()
    asked = safety_asked.Asked(made, numbers={"most": 1.3})
    summary = search.run(asked, tmp_path)
    assert (summary["verdict"], summary["factor"], summary["factor_low"]) == ("stands", None, 1.3)
    assert summary["verdict_says"] == "the slope stands for ever: it does so with its strengths divided by 1.3"
    assert summary["failing_area_m2"] is None and not (tmp_path / "failed.npz").exists()


def test_a_block_without_any_strength_never_stands(tmp_path):
    summary = search.run(
        safety_asked.Asked(sliding_block.block(friction=0.0, tension=0.0), numbers={"least": 0.5}), tmp_path
    )
    assert (summary["verdict"], summary["factor"], summary["factor_high"]) == ("falls", None, 0.5)
    assert "never stands" in summary["verdict_says"] and summary["disks"] is None
    assert len(summary["trials"]) == 2


def test_materials_that_are_not_named_stay():
    made = sliding_block.block()
    asked = safety_asked.Asked(made, materials=("plane",), quantities=("friction",))
    assert asked.strengths(2.0)["rock"] == made.materials["rock"]
    assert asked.strengths(2.0)["plane"].friction == sliding_block.FRICTION / 2
    assert safety_asked.Asked(made).strengths(2.0)["rock"].friction == made.materials["rock"].friction / 2


def test_a_divided_envelope_is_that_of_the_rocks_and_walls_keep_theirs():
    """A rock of the table has the contacts for c/F and tan φ/F; a wall's own c and tan φ are divided."""
    made = section.load("acads_1c")
    asked = safety_asked.Asked(made, quantities=("envelope",))
    less = asked.strengths(1.25)
    for name in ("lower", "middle", "sand"):
        assert less[name] == rocks.reduced(made.materials[name], 1.25), name
        e, whole = less[name].envelope, made.materials[name].envelope
        assert e.cohesion == pytest.approx(whole.cohesion / 1.25)
        tan, before = (math.tan(math.radians(one.friction_deg)) for one in (e, whole))
        assert tan == pytest.approx(before / 1.25)
    assert less["rough"] == materials.divided(made.materials["rough"], 1.25)
    assert asked.strengths(1.0) == dict(made.materials)
    # some materials alone
    one = safety_asked.Asked(made, quantities=("envelope",), materials=("sand",)).strengths(1.25)
    assert one["lower"] == made.materials["lower"] and one["sand"] == less["sand"]


def test_factors_stay_within_the_table_that_is_divided_by():
    made = section.load("acads_1c")
    asked = safety_asked.Asked(made, quantities=("envelope",))
    reaches = [rocks.reach(made.materials[name]) for name in ("lower", "middle", "sand")]
    rules = asked.rules()
    assert rules.most == min(most for _, most in reaches) < 2.5 and rules.least == max(low for low, _ in reaches) > 0.6
    for factor in (rules.most, rules.least):
        assert asked.strengths(factor)
    # what was asked for is no further, and other quantities know no table
    near = safety_asked.Asked(made, quantities=("envelope",), numbers={"most": 1.2, "least": 0.95}).rules()
    assert (near.most, near.least) == (1.2, 0.95)
    assert safety_asked.Asked(made).rules().most == 10


def test_a_search_that_comes_to_the_end_of_the_table_says_so():
    told = {"divided": ["envelope"], "verdict": "stands", "factor_low": 1.7, "factor_high": None}
    assert results.says(told).startswith("the slope stands with the envelope of its rock divided by 1.7, as far as was")
    told |= {"verdict": "falls", "factor_low": None, "factor_high": 0.8}
    assert results.says(told).startswith("the slope fails with the envelope of its rock divided by 0.8, as far as was")
    told |= {"verdict": "found", "factor_low": 0.9, "factor_high": 0.92, "factor": 0.91}
    assert results.says(told).startswith("factor of safety 0.910")


def test_an_envelope_that_the_table_has_not_is_refused():
    with pytest.raises(
        safety_asked.SafetyError, match="soil, of the layer soil, is no rock of the table of calibrated"
    ):
        safety_asked.Asked(safety_asked.standing(section.load("circle"))[0], quantities=("envelope",))
    with pytest.raises(safety_asked.SafetyError, match="stands alone; leave friction, tension out"):
        safety_asked.Asked(section.load("acads_1a"), quantities=("friction", "envelope", "tension"))
    # a layer that is not divided may be any rock
    safety_asked.Asked(section.load("priest"), quantities=("envelope",), materials=("plane",))


# ---- contacts that exist ----------------------------------------------------------------------------
def physics():
    """Strengths of the contacts of the scene: {ids: (friction, rolling arm, tension)}."""
    told = {}
    for i in O.interactions:
        p, name = i.phys, type(i.phys).__name__
        if name == "CohFrictPhys":
            told[i.id1, i.id2] = (p.tangensOfFrictionAngle, p.maxRollPl, p.normalAdhesion, p.shearAdhesion)
        else:
            told[i.id1, i.id2] = (p.friction, p.rollingArm, p.tensileForce, p.residualFriction, p.residualRollingArm)
    return told


@pytest.mark.parametrize("soft", [False, True])
def test_contacts_that_exist_have_the_divided_strengths_and_those_to_come_too(tmp_path, soft):
    O.reset()
    made = sliding_block.block()
    asked = safety_asked.Asked(made, world=SOFT if soft else {})
    world = asked.make_world()
    built = slope.build(made, slope_packing.of(made), world)
    if soft:
        built.solver.bond()
    else:
        slope.hard(made).bond()
        built.solver.view()
    before = physics()
    slope.set_strengths(built, asked.strengths(2.0), world)
    after = physics()
    assert before.keys() == after.keys() and len(before) > 20
    for ids, values in before.items():
        if len(values) == 4:  # a soft bond: friction, rolling and shear are halved, tension stays
            expected = (values[0] / 2, values[1] / 2, values[2], values[3] / 2)
        else:
            expected = (values[0] / 2, values[1] / 2, values[2], values[3] / 2, values[4] / 2)
        assert after[ids] == pytest.approx(expected, rel=ROUNDING), ids
    assert math.tan(built.wall_material("plane").frictionAngle) == pytest.approx(sliding_block.FRICTION / 2)
    # and back again, to the last bit
    slope.set_strengths(built, asked.strengths(1.0), world)
    assert physics() == before


def test_each_figure_of_a_search_is_drawn_from_what_it_has(monkeypatch, tmp_path):
    """Displacements of all trials with a row; the mass that fails where it is known; neither without a row."""
    monkeypatch.setattr(
        pictures.safety, "displacements", lambda trials, bracket, path: ("displacements", bracket, path)
    )
    trial = {"trial": 1, "displacement_mean_m": [0.1], "verdict": "failed", "factor": 1.5}
    summary = {"trials": [trial], "factor_low": 1.0, "factor_high": 1.5, "failing_area_m2": None}
    made = sliding_block.block()
    assert pictures.figure(tmp_path, made, summary, "displacements") == ("displacements", (1.0, 1.5), None)
    assert pictures.figure(tmp_path, made, summary, "failing_mass") is None
    path = tmp_path / "displacements.png"
    assert pictures.draw(tmp_path, made, summary) == [("displacements", (1.0, 1.5), path)]
    assert pictures.figure(tmp_path, made, {**summary, "trials": [{"trial": 1}]}, "displacements") is None


# ---- stops, and the same bits -----------------------------------------------------------------------
def everything(folder):
    """Bytes of what a search has written and wall time is not part of."""
    told = json.loads((folder / "summary.json").read_text())
    told = {name: value for name, value in told.items() if not name.startswith("wall_")}
    names = ("series.csv", "start.npz", "rested.npz", "before_failure.npz", "failed.npz")
    return told, {name: (folder / name).read_bytes() for name in names}


class Halt(Exception):
    """As a kill: nothing is written any more."""


@pytest.mark.parametrize("world", [{}, SOFT], ids=["hard", "soft"])
def test_a_search_that_is_halted_and_resumed_has_the_same_bytes(tmp_path, monkeypatch, world):
    monkeypatch.setattr(driver, "CHECKPOINT_SECONDS", 0)  # at every row
    monkeypatch.setattr(driver, "CHECKPOINT_SHARE", 1e9)
    numbers = {"step": 0.2, "within": 0.2}
    asked = safety_asked.Asked(sliding_block.block(), world=world, numbers=numbers)
    O.reset()
    calls = []
    search.run(asked, tmp_path / "whole", lambda share, doing: calls.append(doing))
    first, rows = next(k for k, doing in enumerate(calls) if doing.startswith("in trial")), len(calls)
    assert rows - first > 40
    # while it is loaded, as the first trial begins, within another, in the last one
    for stop in (first // 2, first + 1, first + (rows - first) // 2, rows - 2)[bool(world) :]:
        folder, left = tmp_path / f"halted-{stop}", [stop]

        def halt(share, doing, left=left):
            left[0] -= 1
            if left[0] < 0:
                raise Halt

        O.reset()
        with pytest.raises(Halt):
            search.run(asked, folder, halt)
        O.reset()
        rest = []
        search.run(asked, folder, lambda share, doing, rest=rest: rest.append(doing))
        assert everything(folder) == everything(tmp_path / "whole"), stop
        # rigid disks go on from the row before; of springs a trial begins anew
        assert len(rest) < rows - stop + 3 if not world else len(rest) > rows - stop
    # one that has ended is not done again
    O.reset()
    before = (folder / "series.csv").stat().st_mtime_ns
    again = search.run(asked, folder, lambda *_: pytest.fail("it has ended"))
    assert again["verdict"] == "found" and (folder / "series.csv").stat().st_mtime_ns == before


def test_a_search_that_is_killed_goes_on_with_the_same_bytes(tmp_path):
    """At any access to its files, also while it is loaded."""
    source = tmp_path / "block.yaml"
    source.write_text(yaml.safe_dump(sliding_block.data()))

    def run(folder, look):
        script = ROOT / "tests" / "yade" / "killed_run.py"
        return shell.run("yade-nonsmooth", script, source, 0, tmp_path / folder, "factor", look, "--threads", 1)

    assert run("whole", 0).returncode == 0
    looks = int((tmp_path / "whole.looks").read_text())
    for k in range(KILLS):
        killed = run(f"killed-{k}", random.Random(k).randint(1, looks))
        assert killed.returncode in (-signal.SIGKILL, 128 + signal.SIGKILL), killed.stderr
        assert run(f"killed-{k}", 0).returncode == 0
        assert everything(tmp_path / f"killed-{k}") == everything(tmp_path / "whole"), k


def test_a_checkpoint_of_another_search_is_refused(tmp_path):
    asked = safety_asked.Asked(sliding_block.block(), numbers={"within": 0.1})
    O.reset()
    search.run(asked, tmp_path)
    other = dataclasses.replace(asked, quantities=("friction",))
    with pytest.raises(safety_asked.SafetyError, match="belongs to other settings"):
        search.run(other, tmp_path)


def test_any_number_of_threads_gives_the_same_bits(tmp_path):
    from yade.nonsmooth import campaign

    (one,) = campaign.factors_of_safety(sliding_block.block(), figures=False, within=0.05).runs
    for threads in (1, 2):
        folder = tmp_path / str(threads)
        folder.mkdir()
        processes.call(campaign.safety.FUNCTION, folder, one.arguments, threads)
    assert everything(tmp_path / "1") == everything(tmp_path / "2")


# ---- the records ------------------------------------------------------------------------------------
def test_a_search_is_opened_from_its_folder(tmp_path):
    summary, _ = found(tmp_path, numbers={"within": 0.05})
    run = runs.open_run(tmp_path)
    assert run.kind == "factor of safety" and run.summary == summary
    series = run.series
    assert (np.diff(series["step"]) > 0).all() and (np.diff(series["time_s"]) > 0).all()
    told = {t["trial"]: t for t in summary["trials"]}
    for trial in np.unique(series["trial"]):
        rows = series["trial"] == trial
        assert set(series["factor"][rows]) == {told[trial]["factor"]}
        assert series["displacement_mean_m"][rows][-1] == told[trial]["displacement_mean_m"]
        assert rows.sum() > 5
    assert {"start", "rested", "before_failure", "failed"} <= set(run.snapshots)
    shot = records.read_snapshot(run.snapshots["failed"])
    assert np.hypot(shot.x - run.snapshot("before_failure").x, shot.y - run.snapshot("before_failure").y).max() > 0
    assert all(one.name == name for name, one in run.columns.items())
    with pytest.raises(runs.RunError, match="give one of displacements, failing_mass"):
        run.figure("forces")


# ---- what is refused --------------------------------------------------------------------------------
@pytest.mark.parametrize(
    "values, said",
    [
        ({"section": 3}, "section 3: give a Section"),
        ({"quantities": ("friction", "colour")}, "quantities: 'colour': give some of friction, rolling_friction"),
        ({"quantities": ()}, "quantities"),
        ({"materials": ("granite",)}, "materials: 'granite': give some of rock, plane"),
        ({"materials": ("rock", "rock")}, "each once"),
        ({"world": {"name": "firm"}}, "world 'firm': give hard or soft"),
        ({"world": {"stiffness": 1e9}}, "stiffness: rigid disks have no such value"),
        ({"world": {"name": "soft"}}, "stiffness None: give Young's modulus"),
        ({"world": {**SOFT, "colour": 1}}, "give fields of worlds.Soft"),
        ({"world": "soft"}, "world 'soft': give a dictionary"),
        ({"numbers": 0.1}, "numbers 0.1: give a dictionary"),
        ({"numbers": {"colour": 1}}, "colour: no number of a search"),
        ({"numbers": {"step": -1}}, "step -1"),
    ],
)
def test_what_makes_no_sense_is_refused(values, said):
    with pytest.raises((safety_asked.SafetyError, reduction.StrengthReductionError), match=said):
        safety_asked.Asked(**{"section": sliding_block.block(), **values})


def test_a_table_that_rises_without_end_is_refused_or_left_dry():
    shipped = section.load("circle")
    with pytest.raises(safety_asked.SafetyError, match="stages.water.hold motion: the table rises without end"):
        safety_asked.Asked(shipped)
    dry, note = safety_asked.standing(shipped)
    assert dry.water.rate == 0 and dry.water.height(1e3) == 0 and "rises without end" in note
    assert safety_asked.Asked(dry).section.stages.water_hold == "never"
    wet, note = safety_asked.standing(shipped, 4.0)
    assert wet.water.height(1e3) == 4.0 and note is None
    held = shipped.with_values({"stages.water.hold": 3.0})
    assert safety_asked.standing(held) == (held, None) and safety_asked.Asked(held)
    # a table that does not stand there within the run
    longest = shipped.stages.end.time - shipped.stages.dry
    with pytest.raises(safety_asked.SafetyError, match=f"stands there {longest + 1:.3g} s after t0, and the run ends"):
        safety_asked.Asked(held.with_values({"water.table": {"rate": 3.0 / (longest + 1)}}))
    assert safety_asked.Asked(held.with_values({"water.table": {"rate": 3.0 / (longest - 1)}}))
    with pytest.raises(safety_asked.SafetyError, match="has no water"):
        safety_asked.standing(sliding_block.block(), 2.0)
    with pytest.raises(safety_asked.SafetyError, match="height of the water table"):
        safety_asked.standing(shipped, -1.0)
