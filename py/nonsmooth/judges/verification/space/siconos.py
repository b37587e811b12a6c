"""Problems of spheres solved by Siconos too. It knows no twisting: :mod:`.twisting` holds that against a cone program."""

from __future__ import annotations

from ..agreement import of_one_step, of_random_problems
from ..registry import check
from . import sphere_problems

SUBJECT = "Spheres in space, against other methods"


@check("Random clusters of spheres with friction, solved by Siconos too", subject=SUBJECT, seconds=5)
def space_siconos_friction(bench):
    """Three to 22 spheres of random radii, masses and velocities fly at each other and at a floor; up to some 60
    contacts, some of them open. Every fifth sphere cannot turn, some of the others cannot move along x. Siconos's
    ``fc3d_driver`` (nonlinear Gauss-Seidel, each contact by Newton's method) solves the same step in its own form: the
    second-order cone :math:`|\\mathbf T|\\le\\mu N`, normal velocity changed to :math:`U^n+\\mu|\\mathbf U^t|` (De
    Saxcé).

    Both forms have the same solutions, so velocities must agree to what both leave over. What is compared, and how
    tolerances relate, is as for disks in the plane.
    """
    return of_random_problems(bench, _clusters())


@check(
    "Random clusters of spheres with friction, rolling resistance and cohesion, solved by Siconos too",
    subject=SUBJECT,
    seconds=10,
)
def space_siconos_rolling_cohesion(bench):
    """The same, but two thirds of the contacts resist rolling with an arm up to :math:`0.2\\,\\ell` and two thirds bear
    tension. Siconos's ``rolling_fc3d_driver`` knows the cone :math:`|\\mathbf T|\\le\\mu\\hat N,\\
    |\\boldsymbol\\Gamma|\\le\\mu_r\\ell\\hat N` with :math:`U^n+\\mu|\\mathbf U^t|+\\mu_r\\ell|\\mathbf w^r|`, five rows a
    contact. Cohesion is put in by the shift :math:`\\hat N=N+F_a`, as in the plane.
    """
    return of_random_problems(bench, _clusters(rolling=True, cohesion=True))


def _clusters(**kind):
    return [sphere_problems.random_cluster(seed, 3 + seed, **kind) for seed in range(20)]


@check("A bed of 1,000 spheres with friction, solved by Siconos too", subject=SUBJECT, seconds=60, quick=3)
def space_siconos_bed(bench):
    """Ten layers of ten by ten spheres lie in each other's hollows on a floor between four walls; radii differ by 2 %.
    The step is from a cold start: all weight has yet to find its way to the floor. The bed is hyperstatic, so forces
    are not unique. Nor are velocities of spheres that friction lets wedge or fall: one in twenty moves otherwise if our
    own solver begins with other impulses. The others are unique and must be Siconos's. Where Siconos moves more than
    those otherwise, its answer must be one of ours too: our solver, begun with Siconos's impulses, stays there. A quick
    run has 125 spheres.
    """
    return _bed(bench)


@check("The same bed with rolling resistance, solved by Siconos too", subject=SUBJECT, seconds=150, quick=5)
def space_siconos_bed_rolling(bench):
    """The bed whose contacts all resist rolling with :math:`\\mu_r=0.05`, by Siconos's ``rolling_fc3d_driver``."""
    return _bed(bench, rolling=0.05)


def _bed(bench, **kind):
    layers = 5 if bench.quick else 10
    problem = sphere_problems.bed(layers, layers, **kind)
    return of_one_step(bench, problem, tolerance=1e-7, sweeps=30000, loose=0.05, starts=5, check_every=10, drawn=1000)
