"""The packings that sweeps in space are timed on, and what is said of made-up times. No scene, no clock."""
from types import SimpleNamespace

import numpy as np
import pytest

from yade.nonsmooth import contact
from yade.nonsmooth.judges.benchmark import report, spheres


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
    found = spheres.headlines(spheres.measure(3, 4, 3, (5, 4)))
    assert found["space_sweep_ns_per_contact"] == pytest.approx(10_000)
    assert found["space_sweep_over_plane"] == pytest.approx(2)
    assert found["space_sweep_speedup_over_scalar"] == pytest.approx(4)
    assert found["space_sweep_speedup_two_threads"] == pytest.approx(2)
    assert found["space_cold_sweeps_to_1e-4"] == 77
    assert found["share_of_weight"] == pytest.approx(0.9)
    assert found["spheres"] == 48 and found["layers"] == 3
    table = report.space_table(found)
    for name, what in spheres.HEADLINES.items():
        assert any(
            line.startswith(what) and line.split()[-1] == f"{found[name]:.4g}" for line in table.splitlines()
        ), name
