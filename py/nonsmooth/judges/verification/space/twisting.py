"""Twisting, and all four graphs together, against closed forms of one contact and against convex programs."""

from __future__ import annotations

import numpy as np

from .... import contact
from ..claims import Claims, Findings
from ..registry import check
from . import cone_program, sphere_problems
from .siconos import SUBJECT

TOLERANCE = 1e-12  # of our solver
EQUAL = 1e-6  # velocities, relative to the largest of their problem
PROVEN = 1e-10
PROVEN_WHY = "rounding, times a thousand: the root of the equations that the programs' states leave"
STATES = ("open", "sticks", "slips")


@check("One sphere that spins on a floor, by hand", subject=SUBJECT, seconds=2)
def space_one_contact(bench):
    """A sphere meets a floor with a velocity, and spins about the normal and across it. The impulse :math:`N` stops its
    fall, and :math:`\\hat N=N+hF_a`. A spin :math:`\\omega` about the normal is left with :math:`\\max(0,\\
    |\\omega|-\\mu_{tw}\\ell\\hat N/I)`. Without friction the same holds of what turns across the normal, with
    :math:`\\mu_r`. With friction and without rolling resistance :math:`\\mathbf T=-\\mathbf U^t\\min(1/W_t,\\mu\\hat
    N/|\\mathbf U^t|)` with :math:`W_t=1/m+r^2/I`. Our solver and the convex programs of the next check are both held
    to that.
    """
    ours, programs, stopped = [], [], 0
    count = 24
    for seed in range(count):
        problem = _one_sphere(seed)
        known = _by_hand(problem)
        stopped += known[5] == 0
        ours.append(_difference(_ours(problem).velocity[:1], known[None]))
        programs.append(_difference(cone_program.solve(problem).velocity[:1], known[None]))
    claims = Claims()
    why = "tolerances of 1e-12, times a hundred"
    claims.at_most("our velocities, largest difference over the largest velocity", max(ours), 1e-10, why)
    claims.at_most("velocities by convex programs, the same", max(programs), 1e-10, why)
    why = "so that both branches are asked: twisting alone stops a third to two thirds of these spins"
    claims.between("share of spheres whose spin about the normal stops", stopped / count, 0.2, 0.8, why)
    return Findings(claims)


@check("Twisting in small clusters, against convex programs", subject=SUBJECT, seconds=20)
def space_twisting(bench):
    """Siconos has no twisting. So two to four spheres that fly at each other and at a floor are solved by convex
    programs: with the thresholds held, impulses are the minimum of a convex quadratic over a product of half-lines,
    discs and intervals, which SciPy finds; thresholds follow from it, until they stay. The equations of the rows that
    stick, slip or are open are then solved to rounding, and what they take for granted is looked at again. Contacts
    have friction, and two thirds of them resist twisting with an arm up to :math:`0.2\\,\\ell`.
    """
    return _small_clusters(range(12), twisting=True)


@check("All four graphs in small clusters, against convex programs", subject=SUBJECT, seconds=20)
def space_all_graphs(bench):
    """The same with rolling resistance and cohesion, each at two thirds of the contacts."""
    return _small_clusters(range(12), rolling=True, twisting=True, cohesion=True)


def _small_clusters(seeds, **kind):
    rows, differences, proven, residuals = [], [], [], []
    seen = np.zeros(3, int)
    for seed in seeds:
        problem = sphere_problems.random_cluster(seed, 2 + seed % 3, **kind)
        ours, theirs = _ours(problem), cone_program.solve(problem)
        differences.append(_difference(ours.velocity, theirs.velocity))
        proven.append(theirs.violation)
        residuals.append(contact.residual(problem, theirs.impulse).relative)
        here = np.bincount(theirs.state[problem.twisting_arm > 0, 2], minlength=3)
        seen += here
        figures = (f"{value:.1e}" for value in (differences[-1], proven[-1], residuals[-1]))
        rows.append([str(seed), str(len(problem.length)), *map(str, here), *figures])
    claims = Claims(against="convex programs")
    why = "what is asked for; both know velocities to 1e-9 and better"
    claims.at_most("largest difference of velocities, over the largest velocity", max(differences), EQUAL, why)
    what = "largest miss of the law by the programs' answer, over the rms of velocities without impulses"
    claims.at_most(what, max(proven), PROVEN, PROVEN_WHY)
    what = "their relative residual in our measure, largest"
    claims.at_most(what, max(residuals), PROVEN, PROVEN_WHY)
    why = "so that each branch is asked several times"
    for name, times in zip(STATES, seen):
        claims.at_least(f"contacts that resist twisting, of which twisting {name}", times, 3, why)
    heads = [
        "seed",
        "contacts",
        "twisting: " + STATES[0],
        *STATES[1:],
        "velocities differ by",
        "law missed by",
        "residual",
    ]
    caption = "Small clusters: states of twisting, velocities of both, and what the answer of convex programs leaves"
    return Findings(claims, tables=[(caption, heads, rows)])


def _ours(problem):
    return contact.solve(problem, tolerance=TOLERANCE, max_iterations=200000, check_every=1, start="cold")


def _difference(velocity, other):
    """Largest difference of velocities [m/s, rad/s, spheres being of some metre], over the largest of them."""
    return float(np.abs(velocity - other).max() / np.abs(other).max())


def _one_sphere(seed):
    """A sphere that meets a floor: with friction or with rolling resistance, with twisting, every third with cohesion."""
    dice = np.random.default_rng(seed)
    r = dice.uniform(0.3, 0.7)
    velocity = np.append(dice.normal(0, 1, 2), [-1.0, *dice.normal(0, 1, 3)])
    strength = {"friction" if seed % 2 else "rolling": dice.uniform(0.05, 0.4)}
    problem = sphere_problems.of_spheres(
        [[0.0, 0.0, r]],
        [r],
        [sphere_problems.FLOOR],
        free_velocity=velocity[None],
        twisting=dice.uniform(0.02, 0.2),
        **{"friction": 0.0, **strength},
    )
    problem.adhesion[:] = 0 if seed % 3 else 0.5 / problem.inverse_mass[0, 0]
    return problem


def _by_hand(problem):
    """Velocity (6,) of that sphere at the end of the step."""
    velocity, mass, inertia = (
        problem.free_velocity[0].copy(),
        1 / problem.inverse_mass[0, 0],
        1 / problem.inverse_inertia[0, 0],
    )
    strength = mass * -velocity[2] + problem.adhesion[0]
    velocity[2] = 0
    for rows, arm in ((slice(3, 5), problem.rolling_arm[0]), (slice(5, 6), problem.twisting_arm[0])):
        turning = np.linalg.norm(velocity[rows])
        velocity[rows] *= max(0.0, 1 - arm * strength / (inertia * turning))
    down = np.array([0.0, 0.0, problem.lever[0, 1]])
    sliding = velocity[:3] + np.cross(velocity[3:], down)
    most = problem.friction[0] * strength / np.linalg.norm(sliding)
    pull = -sliding * min(most, 1 / (1 / mass + down[2] ** 2 / inertia))
    velocity[:3] += pull / mass
    velocity[3:] += np.cross(down, pull) / inertia
    return velocity
