"""The direct tension test: lattices whose strength is known exactly, balances, symmetries, and what runs of it are."""
import dataclasses
import json
import math
from dataclasses import asdict
from types import SimpleNamespace

import leftovers
import numpy as np
import pytest
from yade import O
from yade.nonsmooth import campaign as campaigns, records, runs, worlds
from yade.nonsmooth.laboratory import (
    materials,
    pressing,
    sample_course,
    sample_runs,
    tension,
    tension_campaign,
    tension_report,
    tension_test,
)
from yade.nonsmooth.figures import tension as figures
from yade.nonsmooth.measure import tensile
from yade.nonsmooth.world import tables

import drawn

ROCK = dataclasses.replace(materials.load("wwr"), name="rock")
SIGMA = ROCK.tensile_strength
HALF = ROCK.bond_ellipse[0]  # m, in which a bond of disks of 1 m yields until it breaks


pytestmark = pytest.mark.usefixtures("empty")


def lattice(rows, columns, shift):
    """Rows of equal disks of 1 m that touch: each above the other, or (``shift``) every other row between two others
    and one disk shorter; a pressing.Pressed.
    """
    step = math.sqrt(0.75) if shift else 1.0
    odd = [k % 2 if shift else 0 for k in range(rows)]
    x = np.concatenate([0.5 + 0.5 * o + np.arange(columns - o) for o in odd])
    y = np.concatenate([np.full(columns - o, 0.5 + k * step) for k, o in enumerate(odd)])
    return pressing.Pressed(x, y, np.full(len(x), 0.5), float(columns), float(y.max()) + 0.5)


def heap(length=1.0, mirrored=False):
    """24 disks of 0.8 to 1 m that do not quite touch, bonded over gaps; ``length``: unit [m]."""
    dice = np.random.default_rng(8)
    x, y = (v.ravel() for v in np.meshgrid(0.5 + np.arange(4), 0.5 + np.arange(6)))
    x, y, r = x + dice.uniform(-0.002, 0.002, 24), y, 0.5 - dice.uniform(0, 0.004, 24)
    x = 4.0 - x if mirrored else x
    return pressing.Pressed(length * x, length * y, length * r, 4.0 * length, 6.0 * length)


def made(sample, rock=ROCK, **more):
    """A test of a sample of disks of about 1 m, or of that unit."""
    unit = 2 * float(sample.r.max())
    shape = pressing.Shape(max(24, len(sample.r)), 1, unit, unit)
    return tension_test.TensionTest(rock, shape, **{"inertia": 1e-4, "step": 0.2, "grip": 0.0, **more})


@pytest.fixture
def pulled(tmp_path, monkeypatch):
    """Series and result of the test of a sample, as pulled(sample, world=..., **values of the test)."""

    def pull(sample, world=None, rock=ROCK, folder=tmp_path, **more):
        monkeypatch.setattr(pressing, "load", lambda shape: sample)
        found = tension.run(folder, world, **asdict(made(sample, rock, **more)))
        return records.read_series(folder / "series.csv"), found

    return pull


# ---- exact answers --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "rows, columns, shift, bears",
    [
        (6, 1, False, 1.0),  # a chain: F = σ_ext d, on a width d
        (6, 4, False, 1.0),  # four of them
        # between two rows 2 (n − 1) bonds at 30° to the pull, on the width n d
        (7, 5, True, 2 * 4 * math.sqrt(0.75) / 5),
    ],
    ids=["chain", "square", "triangular"],
)
def test_a_lattice_bears_what_the_bonds_of_a_cut_do(rows, columns, shift, bears, pulled, tmp_path):
    series, found = pulled(lattice(rows, columns, shift))
    stress = tensile.tension(series) / SIGMA
    assert found["broke"] and stress[-1] < 0.05
    # the solver's tolerance, and what disks overlap by where they were pressed; bonds that open turn towards the pull
    yields = (series["opening_m"] > 0.2 * HALF) & (series["opening_m"] < 0.5 * HALF)
    assert stress[yields] == pytest.approx(bears, rel=3e-4 if not shift else 3e-3)
    c = tensile.curve(series, HALF, found["width_m"])
    assert c.peak == pytest.approx(bears * SIGMA, rel=3e-4 if not shift else 0.02) and c.imbalance < 0.02
    # the least work parts one cut: its force over the half-axis; the most all of them
    least = bears * SIGMA * HALF * (1.0 if not shift else 0.8)
    assert 0.9 * least < c.work < (rows - 1) * 1.2 * bears * SIGMA * HALF
    # and it goes into the bonds
    lost = sum(series[name][-1] for name in records.LOSSES)
    assert series["energy_bonds_J"][-1] > (0.9 if shift else 0.97) * lost  # where bonds open aslant they slide too
    assert series["work_J"][-1] == pytest.approx(lost + series["energy_kinetic_J"][-1], rel=0.01)
    broken = records.read_breaks(tmp_path / "breaks.csv")
    assert len(broken["step"]) == records.broken_bonds(series) >= max(1, columns - 1)
    # platens hold ten times as much: none of their bonds is among them
    assert (broken["disk1"] >= 0).all()


def test_platens_bear_the_same_but_for_what_moves_the_disks(monkeypatch, tmp_path):
    """In each step: what the two platens do to the disks is their change of momentum."""
    monkeypatch.setattr(pressing, "load", lambda shape: lattice(5, 3, False))
    course = tension.TensionCourse.begin(made(lattice(5, 3, False)), tmp_path)
    engine, told = course.sample.engine, []
    mass = ROCK.density * math.pi / 4

    def momentum():
        return mass * float(np.sum(tables.bodies(engine)["vy"]))

    before = [momentum()]

    def passed(forces, steps):
        now = momentum()
        told.append((forces["bottom"] - forces["top"], (now - before[0]) / O.dt, -forces["top"]))
        before[0] = now

    course._passed = passed
    for _ in range(30):
        course._steps()
    net, change, pull = np.array(told).T
    assert np.abs(net - change).max() < 1e-9 * np.abs(pull).max()  # rounding
    assert np.abs(change).max() > 1e-6 * np.abs(pull).max()  # they do move


def test_platens_move_alike_and_reach_their_speed_in_the_ramp(monkeypatch, tmp_path):
    sample = lattice(5, 3, False)
    monkeypatch.setattr(pressing, "load", lambda shape: sample)
    course = tension.TensionCourse.begin(made(sample), tmp_path)
    walls, s = course.sample.walls, course.state
    unit = math.sqrt(ROCK.density * math.pi / 4 / SIGMA)
    assert s["speed"] == pytest.approx(1e-4 / unit * s["height"], rel=1e-9) and O.dt == pytest.approx(0.2 * unit)
    assert set(walls.ids) == {"bottom", "top"}  # the sides are free
    assert course._steps_in_a_row() == pytest.approx(HALF / tension.ROWS / s["speed"] / O.dt)
    for share in (0.25, 0.5, 1.0, 3.0):
        # in the time 2 RAMP ε_n d / v
        now = s["begin_time"] + share * 2 * tension.RAMP * made(sample).yielding / s["speed"]
        monkeypatch.setattr(tension, "O", SimpleNamespace(time=now, dt=O.dt))
        course._drive(0)
        speeds = [walls.state(name).vel[1] for name in ("top", "bottom")]
        assert speeds == pytest.approx([0.5 * s["speed"] * min(1, share), -0.5 * s["speed"] * min(1, share)])


# ---- symmetries -----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    """Series and result of the usual heap."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pressing, "load", lambda shape: heap())
        folder = tmp_path_factory.mktemp("plain")
        found = tension.run(folder, **asdict(made(heap())))
    O.reset()
    return records.read_series(folder / "series.csv"), found


def test_homothetic_samples_have_one_strength(plain, pulled):
    """Four times as large, bonds of a quarter of the strength: the same stresses in units of it to the last bits, at
    the same strains.
    """
    rock = dataclasses.replace(
        ROCK, tensile_strength=SIGMA / 4, residual_tensile_strength=ROCK.residual_tensile_strength / 4
    )
    series, found = pulled(heap(4.0), rock=rock)
    # of steps that end somewhere within the tolerance
    assert tensile.tension(series)[20:60] * 4 == pytest.approx(tensile.tension(plain[0])[20:60], rel=1e-3)
    peaks = [tensile.curve(s, HALF * k, f["width_m"]) for s, f, k in ((*plain, 1), (series, found, 4))]
    assert 4 * peaks[1].peak == pytest.approx(peaks[0].peak, rel=1e-3)
    assert peaks[1].strain == pytest.approx(peaks[0].strain, rel=0.05)


def test_a_mirrored_sample_has_the_same_strength(plain, pulled):
    series, found = pulled(heap(mirrored=True))
    one, other = (tensile.curve(s, HALF, f["width_m"]).peak for s, f in ((series, found), plain))
    assert one == pytest.approx(other, rel=2e-3)


def test_hard_and_soft_samples_have_one_strength(plain, pulled):
    """Stiff springs, 1e4 times the strength: the plateau of bonds that yield is the same, but for waves."""
    sample = heap()
    soft = worlds.Soft(1e9, (0.99, 1.0), damping=0.4, verlet=0.1)
    series, found = pulled(sample, soft, inertia=1e-3, opening=0.15)
    assert "iterations_mean" not in series and "energy_bonds_J" not in series
    one, other = (tensile.curve(s, HALF, f["width_m"]).peak for s, f in ((series, found), plain))
    assert one == pytest.approx(other, rel=0.05)


# ---- grips ----------------------------------------------------------------------------------------


def test_a_sample_breaks_between_its_grips(pulled, tmp_path):
    """A bond between a grip and the rock is the rock's, one within a grip ten times as strong."""
    sample = lattice(12, 2, False)
    pulled(sample, grip=1.6)  # rows at 0.5, 1.5, …: two in each grip
    stuff = [O.bodies[i].material.tensileStrength for i in range(4, 4 + len(sample.r))]
    strong = (np.minimum(sample.y, sample.height - sample.y) < 1.6).astype(float)
    assert stuff == pytest.approx(SIGMA * (1 + 9 * strong)) and strong.sum() == 8
    breaks = records.read_breaks(tmp_path / "breaks.csv")
    assert len(breaks["y_m"]) and (np.abs(breaks["y_m"] - sample.height / 2) < sample.height / 2 - 1.5).all()


@pytest.mark.parametrize(
    "more, told",
    [
        (dict(inertia=0.0), "inertia 0.0: give a number above 0"),
        (dict(step=-1), "step -1: give a number above 0"),
        (dict(fallen=1.0), "fallen 1.0: give a share of the peak between 0 and 1"),
        (dict(grip=4.0), "grip 4.0: give mean diameters from 0 to 1.67, a quarter of the sample's height"),
        (dict(opening=0.02), "opening 0.02: give mean diameters above 0.04, in which bonds of twice the mean break"),
        (dict(max_iterations=0), "max_iterations 0: give a whole number from 1"),
        (dict(adhesion_range=-1), "adhesion_range -1: give a gap in mean diameters, 0 or more"),
        (dict(rock=materials.load("dp")), "material dp: bonded False, .*give a material that is bonded"),
        (dict(rock=dataclasses.replace(ROCK, tensile_strength=0.0)), "tensile_strength 0 Pa.* it bears no tension"),
    ],
)
def test_a_test_without_sense_is_one_message(more, told):
    with pytest.raises(tension_test.TensionTestError, match=told):
        made(lattice(6, 4, False), **more)
    with pytest.raises(tension_test.TensionTestError, match="shape None: give a pressing.Shape"):
        tension_test.TensionTest(ROCK, None)


# ---- the course -----------------------------------------------------------------------------------


def test_a_test_ends_when_its_stress_has_fallen_for_good(pulled):
    series, found = pulled(heap())
    stress = tensile.tension(series)
    low = stress < 0.05 * stress.max()
    assert found["broke"] and low[-tension.LATE :].all() and not low[-tension.LATE - 1]


def test_low_rows_count_in_a_row():
    """Nine low rows, a high one, and ten low ones: only these end the test. Rows before any tension do not."""
    course = object.__new__(tension.TensionCourse)
    course.test, course.progress = made(heap()), None
    course.state = {"opening": 0.0, "height": 6.0, "width": 4.0, "peak": 0.0, "low": 0}
    course.sample = SimpleNamespace(walls=SimpleNamespace(height=lambda: 6.0))
    course.snapshot = course._row = lambda *_: None
    told = []
    for stress in (-5, 0, 100, *[4.9] * 9, 50, *[4.9] * 10):
        assert not course.broke
        course._look((dict.fromkeys(("top", "bottom"), -4.0 * stress), {}))
        told.append(course.state["low"])
    assert course.broke and told == [0, 0, 0, *range(1, 10), 0, *range(1, 11)]


def test_a_test_that_does_not_fall_ends_at_its_opening(pulled, tmp_path, monkeypatch):
    monkeypatch.setattr(tension, "LATE", 10**6)  # rows in which the stress would have to be low
    series, found = pulled(lattice(6, 2, False), opening=0.05)
    assert not found["broke"] and series["opening_m"][-1] == pytest.approx(0.05, abs=HALF / tension.ROWS)
    names = {path.stem for path in (tmp_path / "snapshots").iterdir()}
    assert names == {"begin", "peak", "0.5", "1", "2", "end"}
    for name, opening in (("0.5", 0.5), ("1", 1), ("2", 2)):  # of the first row that has come to it
        shot = records.read_snapshot(tmp_path / "snapshots" / f"{name}.npz")
        assert shot.step == series["step"][np.argmax(series["opening_m"] >= opening * HALF)]
    shot, stress = records.read_snapshot(tmp_path / "snapshots" / "peak.npz"), tensile.tension(series)
    assert shot.step == series["step"][np.argmax(stress)] and shot.walls.shape == (2, 2)


def test_a_test_goes_on_from_its_checkpoint(monkeypatch, tmp_path):
    test = made(heap())
    monkeypatch.setattr(pressing, "load", lambda shape: heap())
    whole, broken = tmp_path / "whole", tmp_path / "broken"
    for folder in (whole, broken):
        folder.mkdir()
    tension.run(whole, **asdict(test))

    class Stopped(Exception):
        pass

    course = tension.TensionCourse.begin(test, broken)

    def stop(share):
        if share > 0.06:
            raise Stopped

    with pytest.raises(Stopped):
        course.run(stop)
    course.checkpoint()
    O.reset()
    leftovers.plant(broken, "result.json", "snapshots/begin.npz", "checkpoint/checkpoint.json")
    tension.run(broken, **asdict(test))
    for name in ("series.csv", "breaks.csv", "snapshots/peak.npz", "snapshots/end.npz"):
        assert (broken / name).read_bytes() == (whole / name).read_bytes(), name
    assert leftovers.found(broken) == []
    with pytest.raises(sample_course.TestError, match="other settings"):
        tension.TensionCourse.resume(dataclasses.replace(test, inertia=2e-4), broken)


# ---- campaigns ------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def five(tmp_path_factory):
    """The folder of one small sample of the laboratory's, tested twice at two rates, and what was measured."""
    out = tmp_path_factory.mktemp("five")
    shape = pressing.Shape(150, 3, 1.0, 2.0, 0.82)
    tests = [tension_test.TensionTest(ROCK, shape, inertia=i, step=0.2, grip=2.0) for i in (3e-4, 1e-4)]
    return out, tests, campaigns.run_tension_tests(tests, out)


def test_runs_are_opened_and_say_what_was_measured(five):
    out, tests, found = five
    assert list(found) == ["150-disks-I0.0003-seed3", "150-disks-I0.0001-seed3"]
    run = runs.open_run(out / "tests" / "150-disks-I0.0001-seed3")
    assert (type(run), run.kind, run.test) == (runs.TensionRun, "tension test", tests[1])
    assert run.columns == tension_test.COLUMNS and set(run.snapshots) >= {"begin", "peak", "end"}
    told = run.strength
    assert told["tensile_strength_Pa"] == tensile.curve(run.series, tests[1].yielding, run.summary["width_m"]).peak
    # no test bears more than the weakest cut; disks that turn make it weaker
    assert 0.5 * told["weakest_cut_rel"] < told["tensile_strength_rel"] < told["weakest_cut_rel"]
    assert told["broke"] and told["parted"] and not told["break_in_grips"] and told["platen_difference_rel"] < 0.05
    # bonds take up most of the work; the rest slides and rolls
    assert (
        told["work_bonds_rel"] == run.series["energy_bonds_J"][-1] / run.series["work_J"][-1]
        and 0.5 < told["work_bonds_rel"] < 1
    )
    assert told["bonds_broken"] == len(run.breaks["step"]) and told["break_share"] > 0.7
    axes = run.figure().axes
    way, stress = drawn.points(drawn.line(axes[0], "seed 3")).T
    assert way == pytest.approx(1e3 * run.series["strain"]) and stress == pytest.approx(
        1e-3 * tensile.tension(run.series)
    )
    with pytest.raises(runs.RunError, match="no figure is called 'forces'; give tension"):
        run.figure("forces")


def test_one_test_alone_has_the_bits_of_a_campaigns(five, tmp_path):
    out, tests, found = five
    run = campaigns.run_tension_test(tests[0], tmp_path / "one")
    for name in ("series.csv", "breaks.csv", "snapshots/end.npz"):
        assert (run.folder / name).read_bytes() == (out / "tests" / list(found)[0] / name).read_bytes(), name
    before = (run.folder / "series.csv").stat().st_mtime_ns
    assert campaigns.run_tension_test(tests[0], tmp_path / "one", resume=True).strength == run.strength
    assert (run.folder / "series.csv").stat().st_mtime_ns == before


def test_a_campaign_sums_up_its_groups_and_is_drawn(five, tmp_path):
    out, tests, found = five
    measured = [run.strength for run in found.values()]
    summary = json.loads(json.dumps(tension_campaign.summarise(ROCK, measured, 1.0, 1)))
    assert [row["inertial_number"] for row in summary["groups"]] == [1e-4, 3e-4]
    for row, one in zip(summary["groups"], measured[::-1]):
        assert row["tensile_strength_Pa"] == {
            "mean": one["tensile_strength_Pa"],
            "half_width": None,
            "values": [one["tensile_strength_Pa"]],
        }
        assert row["seeds"] == [3] and row["parted"] == 1
    heads, lines = tension_report.table(summary)
    assert all(len(line) == len(heads) for line in lines)
    assert lines[0][:4] == ["150", "0.0001", "1", f"{1e-3 * measured[1]['tensile_strength_Pa']:.1f}"]
    ax = figures.strengths(summary["groups"]).axes[0]
    for marker, name in (("s", "tensile_strength_rel"), ("^", "weakest_cut_rel")):
        (drawn_means,) = (drawn.points(one) for one in ax.lines if one.get_marker() == marker)
        assert drawn_means == pytest.approx(np.array([[m["inertial_number"], m[name]] for m in measured[::-1]]))
    pictures = tension_report.draw(out, summary)
    assert [path.name for path in pictures] == ["tension.png", "tension_strengths.png"]
    assert all(path.stat().st_size > 10_000 for path in pictures)


def test_a_bond_of_a_grip_with_the_rock_is_the_rocks():
    """A chain of five disks, two in each grip: the one between them has the weakest bonds."""
    begin = records.Snapshot(
        0.0,
        0,
        np.zeros(5),
        np.arange(5) + 0.5,
        np.full(5, 0.5),
        ci=np.array([0, 4, 1, 2, 3, 4]),
        cj=np.array([-1, -2, 0, 1, 2, 3]),
        cbonded=np.ones(6, bool),
        walls=np.array([[1, 0.0], [1, 5.0]]),
    )
    test = SimpleNamespace(grip=2.1, diameter=1.0, material=ROCK)
    assert tension_campaign._cut(test, begin, SIGMA)["weakest_cut_rel"] == pytest.approx(1.0, rel=1e-4)
    # without it, all of the chain is grips
    test.grip = 2.6
    assert tension_campaign._cut(test, begin, SIGMA)["weakest_cut_rel"] == pytest.approx(10.0, rel=1e-4)


def test_a_campaign_that_makes_no_sense_is_refused_before_it_runs(tmp_path):
    test = tension_test.TensionTest(ROCK, pressing.Shape(150, 3, 1.0, 2.0, 0.82), grip=2.0)
    for tests, told in (
        (None, "give a list of tension_test.TensionTest"),
        ([], "give one tension_test.TensionTest or more"),
        (["wwr"], "give a list of tension_test.TensionTest"),
        ([test, test], "150-disks-I1e-05-seed3: two runs of one name; give each number of disks, rate and seed once"),
    ):
        with pytest.raises(sample_runs.CampaignError, match=told):
            campaigns.run_tension_tests(tests, tmp_path / "out")
    with pytest.raises(sample_runs.CampaignError, match="threads 0"):
        campaigns.run_tension_tests([test], tmp_path / "out", threads=0)
    assert not (tmp_path / "out" / "tests").exists()
