"""One step's contact problem, taken out of YADE, solved again without it."""

import functools
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from shell import BUILD
from yade import O
from yade.nonsmooth import contact, tables

from contact_scenes import begin, box, engine, loose_heap, material, run


pytestmark = pytest.mark.usefixtures("empty")


@pytest.fixture
def dumped(tmp_path):
    stuff = material(0.3, 0.1)
    box(stuff, 10, 12)
    loose_heap(stuff)
    begin(dt=2e-3, tolerance=1e-8)
    run(900)  # they have landed
    engine().dump(str(tmp_path / "step.h5"))
    return tmp_path / "step.h5"


def test_holds_what_yade_holds(dumped):
    problem, e = contact.load(dumped), engine()
    assert problem.time_step == O.dt and len(problem.normal) == e.candidates
    normal = {(i.id1, i.id2): i.phys.normal for i in O.interactions if i.isReal and i.phys.normal}
    found = {tuple(sorted(pair)): n / O.dt for pair, n in zip(problem.body.tolist(), problem.impulse[:, 0]) if n}
    assert found.keys() == {tuple(sorted(k)) for k in normal}
    for pair, force in normal.items():
        assert found[tuple(sorted(pair))] == pytest.approx(force, rel=1e-14)  # a product and a quotient with h
    bodies = tables.bodies(e)
    # the integrator adds the forces up itself: rounding
    assert np.abs(problem.velocity[bodies["id"], 1] - bodies["vy"]).max() < 1e-13


def test_solved_again_it_gives_the_same_bits(dumped):
    problem, e = contact.load(dumped), engine()
    again = contact.solve(problem, tolerance=e.tolerance, max_iterations=e.maxIterations, check_every=e.checkEvery)
    assert again.iterations == e.iterations and again.converged
    assert np.array_equal(again.impulse, problem.impulse) and np.array_equal(again.velocity, problem.velocity)


def test_each_path_solves_and_an_unknown_one_is_refused(dumped):
    problem = contact.load(dumped)
    solve = functools.partial(contact.solve, problem, tolerance=1e-8, max_iterations=20000, start="cold")
    best, reference = solve(path="best"), solve(path="reference")
    assert contact.paths()[-2:] == ("portable", "reference")
    for path in contact.paths()[:-1]:
        other = solve(path=path)
        assert np.array_equal(best.impulse, other.impulse) and np.array_equal(best.velocity, other.velocity), path
    # summed in another order
    assert reference.converged and contact.residual(problem, reference.impulse).relative < 1.001e-8
    assert best.seconds > 0
    # forces with friction are not unique, the motion is: a heap at rest moves in neither
    assert np.abs(reference.velocity - best.velocity).max() < 1e-5 * 9.81 * problem.time_step
    names = ", ".join(f"'{path}'" for path in ("best", *contact.paths()[:-1]))
    with pytest.raises(ValueError, match=f"path = 'fast': it must be {names}, or 'reference'"):
        contact.solve(problem, path="fast")


def test_residual_is_that_of_the_engine_and_of_numpy(dumped):
    problem = contact.load(dumped)
    r = contact.residual(problem)
    assert r.relative == pytest.approx(engine().residual, rel=1e-9)  # another order of the sum
    assert r.force_rms == pytest.approx(engine().residualForce, rel=1e-9)
    # the normal graph by hand, for contacts that press: U + b = 0 there
    i, j = problem.body.T
    u = np.einsum("ck,ck->c", problem.normal, problem.velocity[j, :2] - problem.velocity[i, :2])
    pressed = problem.impulse[:, 0] > 0
    assert np.abs((u + problem.bias[:, 0])[pressed]).max() <= r.speed_largest * (1 + 1e-6) + 1e-15
    worse = contact.residual(problem, 1.01 * problem.impulse)
    assert worse.force_rms > 100 * r.force_rms


def test_cold_and_plain_solves_balance_the_same_weight(dumped):
    problem = contact.load(dumped)
    for options in ({"start": "cold"}, {"method": "gaussSeidel"}):
        s = contact.solve(problem, tolerance=1e-8, max_iterations=100000, **options)
        assert s.converged
        # forces are not unique; velocities of the step are, to the residual's order
        assert np.abs(s.velocity - problem.velocity).max() < 1e-5


def test_file_round_trip(dumped, tmp_path):
    problem = contact.load(dumped)
    back = contact.load(contact.save(tmp_path / "again.h5", problem))
    assert np.array_equal(back.impulse, problem.impulse) and np.array_equal(back.body, problem.body)
    with pytest.raises(contact.ProblemError, match="friction has the shape"):
        contact.save(tmp_path / "bad.h5", replace(problem, friction=problem.friction[:-1]))
    with pytest.raises(contact.ProblemError, match="cannot be read"):
        contact.load(tmp_path / "nowhere.h5")


def test_works_without_yade(dumped):
    code = (
        f"import sys, nonsmooth.contact as c; p = c.load({str(dumped)!r}); s = c.solve(p, tolerance=1e-8, start='cold'); "
        "assert s.converged and 'yade' not in sys.modules; print(s.iterations)"
    )
    done = subprocess.run(
        ["/usr/bin/python3" if Path("/usr/bin/python3").exists() else sys.executable, "-c", code],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": str(BUILD / "python")},
    )
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) > 0


def test_needs_a_step():
    begin()
    with pytest.raises(RuntimeError, match="O.step"):
        engine().dump("never.h5")
