"""What is measured in space: the packings that sweeps are timed on, the bed whose steps are, and what is said of made-up
times. No test here asserts a wall time.
"""
import json
import math
from types import SimpleNamespace

import numpy as np
import pytest

from yade import O
from yade.nonsmooth import contact
from yade.nonsmooth.judges.benchmark import (
    report,
    space_report,
    space_suite,
    sphere_bed,
    sphere_steps,
    spheres,
    suite,
    sweeps,
)
from yade.nonsmooth.studies.slope import measuring
from yade.wrapper import FrictMat, Sphere, Wall

pytestmark = pytest.mark.usefixtures("empty")


def distances(problem):
    grains = problem.body[:, 0] < len(problem.position) - 1
    i, j = problem.body[grains].T
    way = problem.position[j] - problem.position[i]
    return grains, way, np.linalg.norm(way, axis=1)


@pytest.mark.parametrize("made", [lambda: spheres.spheres(6, 5), lambda: spheres.disks(12, 8)])
def test_packings_touch_where_their_contacts_say_and_are_borne(made):
    problem = contact.check(made())
    grains, way, distance = distances(problem)
    assert np.allclose(problem.normal[grains], way / distance[:, None])
    # the nearest touch and no others, each pair once
    assert (distance - problem.length[grains]).max() < spheres.REACH
    assert len({tuple(pair) for pair in problem.body[grains]}) == grains.sum()
    # the walls push inwards
    inward = np.einsum(
        "kx,kx->k", problem.normal, problem.position[:-1].mean(axis=0) - problem.position[problem.body[:, 1]]
    )
    assert (inward[~grains] > 0).all() and (~grains).any()
    solution = contact.solve(problem, tolerance=1e-6, max_iterations=20_000)
    assert solution.converged
    # on the walls as a whole: momentum that gravity gives and the grains do not have
    mass = 1 / problem.inverse_mass[:-1, 0]
    gained = (mass * (solution.velocity - problem.free_velocity)[:-1, up(problem)]).sum()
    weight = spheres.GRAVITY * spheres.STEP * mass.sum()
    assert 0.8 * weight < gained < 1.01 * weight


def test_grains_lean_on_floor_and_sides_where_their_rows_end():
    """Rows along a side are displaced by half a grain, and lean on it all; on the floor lies the lowest layer alone."""
    problem = spheres.spheres(6, 5)
    wall = problem.body[:, 0] == len(problem.position) - 1
    counted = {tuple(n): int(c) for n, c in zip(*np.unique(problem.normal[wall], axis=0, return_counts=True))}
    sides = {(s * a, s * b, 0.0): 5 * 6 for a, b in ((1.0, 0.0), (0.0, 1.0)) for s in (1, -1)}
    assert counted == {**sides, (0.0, 0.0, 1.0): 6 * 6}


def up(problem):
    """Column of velocities along which gravity pulls."""
    return problem.normal.shape[1] - 1


def test_figures_follow_from_times(monkeypatch):
    cost = {("reference", 1): 0.040, ("portable", 1): 0.020, ("best", 1): 0.010, ("best", 2): 0.005}

    def solve(problem, start, tolerance, max_iterations, **others):
        if "path" not in others:  # the cold start
            weight = spheres.GRAVITY * spheres.STEP * (1 / problem.inverse_mass[:-1, 0]).sum()
            floor = problem.body[:, 0] == len(problem.inverse_mass) - 1
            impulse = np.zeros((len(problem.length), 6))
            impulse[floor, 2] = 0.9 * weight / floor.sum()
            return SimpleNamespace(iterations=77, converged=True, impulse=impulse)
        share = 0.5 if isinstance(problem, contact.ContactProblem) else 1
        seconds = share * cost[others["path"], others["threads"]] * max_iterations * len(problem.length) / 1000
        return SimpleNamespace(iterations=max_iterations, seconds=seconds)

    monkeypatch.setattr(contact, "solve", solve)
    found = spheres.measure("", 3, 4, 3, (5, 4))
    assert found["share_of_weight"] == pytest.approx(0.9)
    assert found["spheres"] == 48 and found["layers"] == 3
    told = space_report.summarise(whole(found))
    assert told["space_sweep_ns_per_contact"] == pytest.approx(10_000)
    assert told["space_sweep_over_plane"] == pytest.approx(2)
    assert told["space_sweep_speedup_over_scalar"] == pytest.approx(4)
    assert told["space_sweep_speedup_two_threads"] == pytest.approx(2)
    assert told["space_cold_sweeps_to_1e-4"] == 77
    # made-up steps: 30 ms at rest beside 10, 60 on the move beside 12; hard ones ten times as long as soft ones
    assert (told["space_step_ms"], told["space_soft_step_ms_moving"]) == (30.0, 12.0)
    assert (told["space_step_over_soft_step"], told["space_step_over_soft_step_moving"]) == (3.0, 5.0)
    assert (told["space_second_over_soft"], told["space_second_over_soft_moving"]) == pytest.approx((0.3, 0.5))
    # the other stiffness has a third of that step
    assert told["space_second_over_soft_10GPa_moving"] == pytest.approx(0.15)
    # at rest (30 - 8)/8 and (30 - 16)/16, on the move (60 - 40)/40 and (60 - 50)/50
    assert told["space_outside_sweeps_over_sweeps"] == pytest.approx(2.75)
    assert told["space_outside_sweeps_over_sweeps_moving"] == pytest.approx(0.5)
    assert told["space_outside_solve_over_solve"] == pytest.approx(0.875)
    assert told["space_outside_solve_over_solve_moving"] == pytest.approx(0.2)
    assert told["space_bytes_per_contact"] == 1400
    assert list(told) == [*space_report.HEADLINES, "space"]
    table = space_report.table(told).splitlines()[2:]
    for (name, what), line in zip(space_report.HEADLINES.items(), table):
        what = what.format(layers=3)
        assert line.startswith(what + "  ") and line[len(what) :].split()[0] == f"{told[name]:.4g}", name


def spread_of(value):
    return {"median": value, "quartiles": [0.9 * value, 1.1 * value], "mean": value}


def whole(sweeps):
    """What space_suite.run finds, with made-up steps on two threads, of which those of one are others."""

    def hard(state, threads, step, sweeps_ms, **stages):
        return {
            "state": state, "threads": threads, "step_ms": spread_of(step), "sweeps_ms": spread_of(sweeps_ms), "sweeps_mean": 20.0,
            "stage_ms": {name: spread_of(ms) for name, ms in stages.items()}, "contacts": 9, "candidates": 12, "time_step_s": 5e-3,
        }  # fmt: skip

    def soft(state, young, step):
        name = sphere_bed.softened(state, young)
        return {
            "state": name, "threads": 2, "step_ms": spread_of(step), "stage_ms": {"collide": spread_of(1.0)}, "contacts": 8,
            "time_step_s": 5e-4 if young < 5e9 else 1.5e-4,
        }  # fmt: skip

    turn = {"rest": [30.0], "moving": [60.0]}
    steps = [
        hard("rest", 1, 50.0, 30.0, solve=35.0, correct=5.0),
        hard("moving", 1, 90.0, 60.0, solve=70.0, correct=5.0),
        hard("rest", 2, 30.0, 8.0, solve=14.0, correct=2.0),
        hard("moving", 2, 60.0, 40.0, solve=45.0, correct=5.0),
        *(soft(state, young, ms) for state, ms in (("rest", 10.0), ("moving", 12.0)) for young in sphere_bed.YOUNGS),
    ]
    for one in steps:
        if one["threads"] == 2 and one["state"] not in turn:
            turn[one["state"]] = [one["step_ms"]["median"]]
    told = {one["state"]: one for one in steps}
    size = {
        "spheres": 500, "candidates": 2500, "building_s": 1.0, "stepping_s": 2.0, "steps": 100, "step_ms": spread_of(5.0), "sweeps_mean": 3.0,
        "sweep_ns_per_contact": {"1": spread_of(40.0), "2": spread_of(20.0)}, "bytes_per_contact": 1400, "bytes_per_contact_without_bodies": 900, "bytes_per_sphere": 7000,
    }  # fmt: skip
    return {
        "threads": 2, "sweeps": sweeps, "steps": steps, "ratios": {"2": sphere_steps._ratios(turn, told)}, "bed": {"spheres": 100},
        "sizes": [{**size, "bytes_per_contact": 1700}, size],
    }  # fmt: skip


def test_a_ratio_is_of_one_turn():
    """Steps of 20 and 60 ms beside 10 and 20: twice and three times, and a tenth of these for a second."""
    turns = {name: [10.0, 20.0] for name in sphere_bed.NAMES} | {"rest": [20.0, 60.0], "moving": [50.0, 100.0]}
    told = {name: {"time_step_s": 5e-3 if name in sphere_bed.HARD else 5e-4} for name in sphere_bed.NAMES}
    found = sphere_steps._ratios(turns, told)
    assert found["step_over_soft_rest_1e+09"]["median"] == pytest.approx(2.5)
    assert found["second_over_soft_rest_1e+10"]["median"] == pytest.approx(0.25)
    assert found["step_over_soft_moving_1e+09"]["quartiles"] == pytest.approx([5.0, 5.0])
    assert len(found) == 8


# ---- the file ---------------------------------------------------------------------------------------


def test_space_stands_beside_the_slope_in_one_file(tmp_path):
    path = tmp_path / "benchmark.json"
    report.keep(path, {"step_ms": 1, "machine": "a"}, space=False)
    report.keep(path, {"space_step_ms": 2, "space": {}}, space=True)
    assert json.loads(path.read_text()) == {"step_ms": 1, "machine": "a", "space_step_ms": 2, "space": {}}
    report.keep(path, {"soft_step_ms": 3}, space=False)  # what an earlier run found goes
    assert json.loads(path.read_text()) == {"soft_step_ms": 3, "space_step_ms": 2, "space": {}}
    for damaged in ("[1]", "{"):
        path.write_text(damaged)
        report.keep(path, {"space": {}}, space=True)
        assert json.loads(path.read_text()) == {"space": {}}


# ---- the bed ----------------------------------------------------------------------------------------


def gaps(packed):
    """Smallest gap of two spheres, and of a sphere and a wall that it may not pass [m]."""
    between = np.linalg.norm(packed.at[:, None] - packed.at, axis=2) - packed.r[:, None] - packed.r
    np.fill_diagonal(between, np.inf)
    walls = [packed.at - packed.r[:, None], np.array(packed.sides) - packed.at[:, :2] - packed.r[:, None]]
    return between.min(), min(w.min() for w in walls)


def test_spheres_are_poured_apart_and_between_their_walls():
    packed = sphere_bed.poured(300)
    assert min(gaps(packed)) > 0 and len(packed.r) == 300
    assert 0.4 <= packed.r.min() < 0.41 and 0.49 < packed.r.max() <= 0.5
    # 1.2 times as many layers as spheres along a side: (300/1.2)^(1/3) = 6.3, so 6, in layers of 36
    assert packed.sides == pytest.approx((6.6, 6.6)) and packed.at[:, 2].max() == pytest.approx(0.55 + 8 * 1.1)


@pytest.mark.parametrize("count, sides", [(7, (2.2, 2.2)), (12, (2.2, 2.2)), (30, (2.2, 6.6)), (60, (4.4, 6.6))])
def test_a_large_bed_is_made_of_copies_that_do_not_touch(count, sides):
    one = sphere_bed.poured(12)
    one = sphere_bed.Packed(one.at[::-1], one.r[::-1], one.sides)  # places in any order
    found = sphere_bed.tiled(one, count)
    assert found.at.shape == (count, 3) and found.r.shape == (count,) and found.sides == pytest.approx(sides)
    assert min(gaps(found)) > 0
    # the highest of the copies are left out
    copies = round(sides[0] * sides[1] / 2.2**2)
    assert found.at[:, 2].max() <= np.sort(np.repeat(one.at[:, 2], copies))[count - 1]
    # with their own radii
    radius = {round(z, 6): set() for z in one.at[:, 2]}
    for z, r in zip(one.at[:, 2], one.r):
        radius[round(z, 6)].add(r)
    assert all(r in radius[round(z, 6)] for z, r in zip(found.at[:, 2], found.r))


def test_the_states_are_what_they_are_called(tmp_path):
    made = sphere_bed.make(tmp_path, 60)
    assert made["spheres"] == 60 and 1 < made["settled_s"] < sphere_bed.SETTLE_SECONDS
    seen = {}
    for name in sphere_bed.NAMES:
        sphere_bed.load(tmp_path, name)
        balls = [b for b in O.bodies if isinstance(b.shape, Sphere)]
        seen[name] = SimpleNamespace(
            at=np.array([tuple(b.state.pos) for b in balls]),
            r=np.array([b.shape.radius for b in balls]),
            speed=np.array([b.state.vel.norm() for b in balls]),
            walls=sum(isinstance(b.shape, Wall) for b in O.bodies),
            soft=type(balls[0].material) is FrictMat,
            young=getattr(balls[0].material, "young", None),
            step=O.dt,
        )
    rest, moving = seen["rest"], seen["moving"]
    packed = sphere_bed.load_packed(tmp_path)
    assert np.array_equal(packed.at, rest.at) and np.array_equal(packed.r, rest.r)
    # hard spheres overlap by what the tolerance leaves, a thousandth at most
    assert min(gaps(packed)) > -1e-3 and rest.speed.mean() < sphere_bed.REST_SPEED
    assert (rest.walls, moving.walls) == (5, 4) and (rest.step, moving.step) == (5e-3, 5e-3)
    assert moving.speed.mean() > 10 * sphere_bed.REST_SPEED and moving.at[:, 0].max() > packed.sides[0]
    for name, hard in (("rest", rest), ("moving", moving)):
        steps = []
        for young in sphere_bed.YOUNGS:
            soft = seen[sphere_bed.softened(name, young)]
            assert soft.soft and not hard.soft and soft.young == young and soft.walls == hard.walls
            assert np.array_equal(soft.r, hard.r)
            # half of R √(ρ/E) of the smallest
            assert soft.step == pytest.approx(0.5 * rest.r.min() * math.sqrt(2600 / young), rel=1e-9)
            steps.append(soft.step)
        assert steps[0] / steps[1] == pytest.approx(math.sqrt(10), rel=1e-9)
    # springs yield by ρ g h/E of a diameter, here a ten-thousandth, and bounce: spheres stay to within a hundredth
    moved = np.linalg.norm(seen["soft_rest_1e+09"].at - rest.at, axis=1)
    assert np.median(moved) < 1e-2
    # what moves goes on as far as its speed says, for 300 steps
    went = np.linalg.norm(seen["soft_moving_1e+09"].at - moving.at, axis=1)
    assert np.mean(went) == pytest.approx(moving.speed.mean() * 300 * seen["soft_moving_1e+09"].step, rel=0.6)


def test_all_that_is_promised_is_measured_on_a_tiny_bed(tmp_path, monkeypatch):
    """In this process, as if each call had one of its own; two threads that wait for each other make a busy machine
    slow, so all sweeps have one.
    """

    def call(function, folder, arguments, threads):
        return json.loads(json.dumps(function(folder, **json.loads(json.dumps(arguments))), allow_nan=False))

    monkeypatch.setattr(measuring.processes, "call", call)
    monkeypatch.setitem(sweeps.PATHS, "best_two_threads", sweeps.PATHS["best"])
    shares = []
    found = space_suite.run(
        tmp_path,
        [150, 90],
        1,
        suite.Effort(10, 1, 1),
        lambda share, doing: shares.append(share),
        bed=60,
        layers=4,
        flat=(6, 5),
    )
    told = space_report.summarise(found)
    assert set(space_report.HEADLINES) <= set(told)
    for name in space_report.HEADLINES:
        assert math.isfinite(told[name]), name
    asked = "space_sweep_ns_per_contact space_sweep_speedup_over_scalar space_sweep_speedup_two_threads space_cold_sweeps_to_1e-4 space_step_over_soft_step space_second_over_soft"
    assert all(told[name] > 0 for name in asked.split())
    assert {(m["state"], m["threads"]) for m in found["steps"]} == {(n, 1) for n in sphere_bed.NAMES}
    for m in found["steps"]:
        # "other" is the rest: rounding; engines' own clocks lie inside the step's
        assert sum(s["mean"] for s in m["stage_ms"].values()) == pytest.approx(m["step_ms"]["mean"], rel=1e-9)
        hard = m["state"] in sphere_bed.HARD
        assert m["stage_ms"]["integrate"]["mean"] > 0
        assert ("solve" in m["stage_ms"]) == ("sweeps_ms" in m) == hard
        if hard:
            whole_solve = m["sweeps_ms"]["mean"] + m["solve_without_sweeps_ms"]
            assert whole_solve == pytest.approx(m["stage_ms"]["solve"]["mean"])
        # 60 spheres have some 200 contacts at rest, and fewer where they fall apart
        assert 30 < m["contacts"] < 400
    assert [(s["spheres"], s["steps"]) for s in found["sizes"]] == [(90, 100), (150, 100)]
    for s in found["sizes"]:
        # memory comes in pages, which so few spheres may find free
        assert s["bytes_per_contact_without_bodies"] <= s["bytes_per_contact"] <= s["bytes_per_contact_viewed"]
        assert s["bytes_per_sphere"] * s["spheres"] == pytest.approx(s["bytes_per_contact"] * s["candidates"])
        assert 1 < s["candidates"] / s["spheres"] < 8 and s["sweep_ns_per_contact"]["1"]["median"] > 0
    # problems are large, and are not kept
    assert not list(tmp_path.rglob(sphere_steps.PROBLEM))
    assert shares == sorted(shares) and shares[-1] <= 1
    assert "90" in space_report.table(told)
    json.dumps(told, allow_nan=False)
