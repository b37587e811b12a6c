"""Siconos solves the same problems of spheres (tests/oracle); skipped where it is not installed, see oracles.py.
judges/test_space_oracles.py holds kept answers.
"""

from dataclasses import replace

import kept_answers
import numpy as np
import oracles
import pytest
from yade.nonsmooth import contact
from yade.nonsmooth.judges.verification import Bench, siconos_solve
from yade.nonsmooth.judges.verification.space import siconos, sphere_problems

from contact_scenes import without_contacts
from held_claims import failed


@pytest.fixture(scope="module", autouse=True)
def program(request):
    return oracles.siconos(request.config)


def one_contact(adhesion=0.0):
    """A sphere with mass 1 and radius 0.5 on the ground, its centre its point of contact (a lever of 0), so that W = 1
    in forces and 2.5/r² = 10 in torques; μ_s = 0.3, μ_r ℓ = 0.05 m.
    """
    problem = sphere_problems.of_spheres(
        [[0.0, 0.0, 0.5]],
        [0.5],
        [sphere_problems.FLOOR],
        density=6 / np.pi,
        free_velocity=np.array([[0.3, -0.4, -1.0, 0.6, 0.8, 5.0]]),
        friction=0.3,
        rolling=0.05,
    )
    problem.lever[:] = 0
    problem.adhesion[:] = adhesion
    return problem


@pytest.mark.parametrize("adhesion", [0.0, 0.5])
@pytest.mark.parametrize("rolling", [True, False])
def test_one_contact(tmp_path, adhesion, rolling):
    problem = one_contact(adhesion)
    found = siconos_solve.solve_with_siconos(problem, tmp_path, 1e-12, 1000, rolling=rolling)
    shear, torque = 0.3 * (1 + adhesion), 0.05 * (1 + adhesion) * rolling
    assert found.converged
    # against U_t = (0.3, −0.4) and w_r = (0.6, 0.8): the force slides where it is below 0.5, the torque below 1/10
    force, moment = -min(shear, 0.5) * np.array([0.6, -0.8]), -torque * np.array([0.6, 0.8])
    assert found.impulse == pytest.approx(np.array([[*force, 1, *moment, 0]]), abs=1e-11)
    turning = np.array([0.6, 0.8]) + 10 * moment
    assert found.velocity[0] == pytest.approx([0.3 + force[0], -0.4 + force[1], 0, *turning, 5], abs=1e-10)
    if rolling:
        assert siconos_solve.solve_with_ours(problem, 1e-12, 1000).impulse == pytest.approx(found.impulse, abs=1e-11)


def test_contacts_without_work_carry_nothing(tmp_path):
    problem = one_contact()
    problem.inverse_mass[0] = [0, 0, 1]  # moves up and down only: four rows of W are empty
    problem.inverse_inertia[0] = 0
    found = siconos_solve.solve_with_siconos(problem, tmp_path, 1e-12, 1000)
    assert found.impulse == pytest.approx(np.array([[0, 0, 1.0, 0, 0, 0]]), abs=1e-11)


def test_no_contacts(tmp_path):
    found = siconos_solve.solve_with_siconos(without_contacts(one_contact()), tmp_path, 1e-6, 10)
    assert found.velocity[0] == pytest.approx([0.3, -0.4, -1, 0.6, 0.8, 5]) and found.sweeps == 0


@pytest.mark.parametrize(
    "check",
    [
        siconos.space_siconos_friction,
        siconos.space_siconos_rolling_cohesion,
        siconos.space_siconos_bed,
        siconos.space_siconos_bed_rolling,
    ],
)
def test_quick_checks_hold(tmp_path, check):
    outcome = check(Bench(tmp_path, quick=True))
    assert outcome.passed, failed(outcome.claims)


@pytest.mark.parametrize("rolling", [True, False])
@pytest.mark.parametrize("seed", range(3))
def test_bodies_that_are_no_spheres_agree(tmp_path, seed, rolling):
    problem = sphere_problems.random_cluster(seed, 5, rolling=rolling, cohesion=rolling)
    problem = sphere_problems.of_other_bodies(problem, seed)
    theirs = siconos_solve.solve_with_siconos(problem, tmp_path, 1e-11, 200000)
    ours = siconos_solve.solve_with_ours(problem, 1e-11, 200000)
    assert theirs.converged and ours.converged
    # 1e-11 of what stops bodies of 1 m/s, times 1,000 for the condition of W
    assert np.abs(ours.velocity - theirs.velocity).max() < 1e-8 * np.abs(ours.velocity).max()


@pytest.mark.parametrize("number", [0, 9, 18, 19])
def test_kept_answers_are_what_siconos_says_today(tmp_path, number):
    problem = kept_answers.cluster(contact, "siconos_spheres.h5", number)
    answer = siconos_solve.solve_with_siconos(problem, tmp_path, 1e-13, 1000000)
    assert np.abs(answer.velocity - problem.velocity).max() < 1e-10  # the tolerance, times 1,000 for the condition of W


@pytest.mark.parametrize("what", ["friction", "rolling_arm", "adhesion", "bias", "lever"])
def test_a_law_that_is_off_by_a_thousandth_would_show(tmp_path, what):
    problem = sphere_problems.random_cluster(15, 18, rolling=True, cohesion=True)
    wrong = replace(problem, **{what: 1.001 * getattr(problem, what)})
    assert oracles.apart_from_siconos(problem, wrong, tmp_path) > 100 * 1e-7  # the limit of the checks


@pytest.mark.parametrize(
    "changed, said", [({"twisting_arm": 0.1}, "contact 0 resists twisting"), ({"play": 0.1}, "contact 0 has play")]
)
def test_refuses_what_siconos_does_not_know(tmp_path, changed, said):
    ((name, value),) = changed.items()
    problem = replace(one_contact(), **{name: np.array([value])})
    with pytest.raises(siconos_solve.OracleError, match=said):
        siconos_solve.solve_with_siconos(problem, tmp_path, 1e-6, 10)


def test_refuses_a_drive_along_one_tangent_alone(tmp_path):
    problem = one_contact()
    problem.inverse_mass[0, 0] = 0  # driven along x, free along y
    with pytest.raises(siconos_solve.OracleError, match="contact 0 is driven along a direction"):
        siconos_solve.solve_with_siconos(problem, tmp_path, 1e-6, 10)
