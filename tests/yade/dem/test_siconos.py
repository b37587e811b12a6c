"""Siconos solves the same contact problems (tests/oracle); skipped where it is not installed, see oracles.py.
tests/contact holds kept answers.
"""

import subprocess
from dataclasses import replace

import docutils.core
import numpy as np
import pytest
from yade.nonsmooth import contact
from yade.nonsmooth.judges import verification
from yade.nonsmooth.judges.verification import Bench, disk_problems, siconos, siconos_solve

import kept_answers
import oracles
from contact_scenes import without_contacts
from held_claims import failed


@pytest.fixture(scope="module", autouse=True)
def program(request):
    return oracles.siconos(request.config)


def one_contact(adhesion=0.0):
    """A body of mass and inertia 1 on the ground, pushed so that W = 1 and q = (−1, 0.5, 0.2); μ_s = 0.3, μ_r ℓ = 0.1
    m.
    """
    three, free = np.zeros((1, 3)), np.array([[0.0, 0.0, 0.0], [-0.5, -1.0, 0.2]])
    return contact.ContactProblem(
        time_step=1.0,
        inverse_mass=np.array([[0.0] * 3, [1.0] * 3]),
        free_velocity=free,
        velocity=free,
        body=np.array([[0, 1]], np.int32),
        normal=np.array([[0.0, 1.0]]),
        lever=np.zeros((1, 4)),
        bias=three,
        adhesion=np.array([adhesion]),
        friction=np.array([0.3]),
        rolling_arm=np.array([0.1]),
        length=np.array([1.0]),
        warm_start=three,
        impulse=three,
    )


@pytest.mark.parametrize("adhesion", [0.0, 0.5])
@pytest.mark.parametrize("rolling", [True, False])
def test_one_contact(tmp_path, adhesion, rolling):
    problem = one_contact(adhesion)
    found = siconos_solve.solve_with_siconos(problem, tmp_path, 1e-12, 1000, rolling=rolling)
    shear, torque = 0.3 * (1 + adhesion), 0.1 * (1 + adhesion) * rolling
    assert found.converged
    assert found.impulse == pytest.approx(np.array([[1, -shear, -torque]]), abs=1e-11)
    # t = (−1, 0): the ground takes from U_t = −v_x
    assert found.velocity[1] == pytest.approx([-(0.5 - shear), 0, 0.2 - torque], abs=1e-11)
    if rolling:
        assert siconos_solve.solve_with_ours(problem, 1e-12, 1000).impulse == pytest.approx(found.impulse, abs=1e-11)


def test_contacts_without_work_carry_nothing(tmp_path):
    problem = one_contact()
    problem.inverse_mass[1] = [0, 1, 0]  # moves up and down only: two rows of W are empty
    found = siconos_solve.solve_with_siconos(problem, tmp_path, 1e-12, 1000)
    assert found.impulse == pytest.approx(np.array([[1.0, 0, 0]]), abs=1e-11)


def test_no_contacts(tmp_path):
    found = siconos_solve.solve_with_siconos(without_contacts(one_contact()), tmp_path, 1e-6, 10)
    assert found.velocity[1] == pytest.approx([-0.5, -1, 0.2]) and found.sweeps == 0


@pytest.mark.parametrize("check", [siconos.siconos_random_friction, siconos.siconos_random_rolling_cohesion])
def test_random_problems_agree(tmp_path, check):
    outcome = check(Bench(tmp_path))
    assert outcome.passed, failed(outcome.claims)


@pytest.mark.parametrize("number", [0, 9, 18, 19])
def test_kept_answers_are_what_siconos_says_today(tmp_path, number):
    problem = kept_answers.cluster(contact, "siconos_clusters.h5", number)
    answer = siconos_solve.solve_with_siconos(problem, tmp_path, 1e-13, 1000000)
    assert np.abs(answer.velocity - problem.velocity).max() < 1e-10  # the tolerance, times 1,000 for the condition of W
    assert len(problem.length) > number + 3


def test_a_step_of_a_packing_agrees_in_the_quick_form(tmp_path):
    outcome = siconos.siconos_packing(Bench(tmp_path, quick=True))
    assert outcome.passed, failed(outcome.claims)


@pytest.mark.parametrize("what", ["friction", "rolling_arm", "adhesion", "bias", "lever"])
def test_a_law_that_is_off_by_a_thousandth_would_show(tmp_path, what):
    problem = disk_problems.random_cluster(15, 18, rolling=True, cohesion=True)
    wrong = replace(problem, **{what: 1.001 * getattr(problem, what)})
    assert oracles.apart_from_siconos(problem, wrong, tmp_path) > 100 * 1e-7  # the limit of the checks


@pytest.mark.parametrize(
    "check", [c for c in verification.load_checks() if c.run.__module__ == siconos.__name__], ids=lambda c: c.name
)
def test_derivation_is_sound_markup(check):
    docutils.core.publish_parts(
        check.derivation, writer_name="html5", settings_overrides={"halt_level": 2, "report_level": 2}
    )


@pytest.mark.parametrize(
    "arguments, said",
    [
        ([], "usage"),
        (["nowhere.h5", "out.h5"], "nowhere.h5"),
        (["a", "b", "--tolerance", "-1"], "--tolerance"),
        (["a", "b", "--speed"], "--speed"),
    ],
)
def test_refuses_bad_input(program, tmp_path, arguments, said):
    done = subprocess.run([program, *arguments], capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 2 and said in done.stderr
