"""The same problems solved by Siconos, which shares no line with our solver: cones, local solutions and stopping test
are its own.
"""

from __future__ import annotations

import numpy as np

from ... import contact
from . import disk_problems
from .agreement import of_one_step, of_random_problems
from .registry import check
from .siconos_solve import ROOT, OracleError

SUBJECT = "Against Siconos"


# ---- small random problems -----------------------------------------------------------------------
@check("Random clusters with friction, solved by Siconos too", subject=SUBJECT, seconds=3)
def siconos_random_friction(bench):
    """Three to 22 disks of random radii, masses and velocities fly at each other and at a floor; up to some 50
    contacts, some of them open. Every fifth disk cannot turn, every eighth cannot move sideways. Siconos's
    ``fc2d_driver`` (nonlinear Gauss-Seidel, each contact solved exactly) solves the same step in its own form: cone
    :math:`|T|\\le\\mu N`, normal velocity changed to :math:`U^n+\\mu|U^t|` (De Saxcé).

    Both forms have the same solutions, so velocities must agree to what both leave over. Forces of closed loops of
    contacts may differ: there they are not unique. Each solver is given the same number as tolerance on its own test:
    ours is the natural map relative to the rms impulse, Siconos's the same relative to the larger of :math:`|q|` and
    :math:`|p|`.
    """
    return of_random_problems(bench, _clusters())


@check(
    "Random clusters with friction, rolling resistance and cohesion, solved by Siconos too", subject=SUBJECT, seconds=3
)
def siconos_random_rolling_cohesion(bench):
    """The same as without rolling and cohesion, but two thirds of the contacts resist rolling with an arm up to
    :math:`0.2\\,\\ell` and two thirds bear tension. Siconos's ``rolling_fc2d_driver`` knows the cone
    :math:`|T|\\le\\mu\\hat N,\\ |\\Gamma|\\le\\mu_r\\ell\\hat N` with :math:`U^n+\\mu|U^t|+\\mu_r\\ell|w|`. Cohesion is
    put in by the shift :math:`\\hat N = N+F_a`, :math:`\\hat q = q - W(F_a,0,0)`: eqs 1 to 6 of the paper say nothing
    else.
    """
    return of_random_problems(bench, _clusters(rolling=True, cohesion=True))


def _clusters(**kind):
    return [disk_problems.random_cluster(seed, 3 + seed, **kind) for seed in range(20)]


# ---- steps of packings ---------------------------------------------------------------------------
@check("A packing of 5,000 disks at rest, solved by Siconos too", subject=SUBJECT, seconds=60, quick=10)
def siconos_packing(bench):
    """The packing that LMGC90 made (``tests/data``), at rest, with friction, from a cold start: all weight has yet to
    find its way to the floor. The packing is hyperstatic, so forces are not unique. Velocities are, but for disks that
    friction lets wedge or fall: both are solutions of Coulomb's law. A disk counts as one of those if the two solutions
    move it apart by more than a tenth of what a free disk gains in the step, although both leave far less over. A quick
    run takes the contacts of the lowest sixteenth of its height.
    """
    x, y, r = np.loadtxt(_data("lmgc90_5000_disks.txt.gz"), usecols=(0, 1, 2)).T
    width = 409.59035
    walls = [(0, 0, 0, 1), (0, 0, 1, 0), (width, 0, -1, 0)]
    # what overlaps LMGC90 left would lift the packing if they were taken back
    problem = disk_problems.of_disks(x, y, r, walls, relaxation=0, rolling=0)
    if bench.quick:
        problem = disk_problems.below(problem, y.max() / 16)
    return of_one_step(bench, problem, tolerance=1e-5, sweeps=30000)


@check("A slope at failure, solved by Siconos too", subject=SUBJECT, seconds=40, quick=None)
def siconos_slope_at_failure(bench):
    """A step of the paper's slope with 1,200 disks, just before the backstop reaches its strength (t₁;
    ``tests/data/slope_t1.h5``): bonds, rolling resistance, water; from a cold start. Siconos's rolling solver, cohesion
    shifted.
    """
    return of_one_step(bench, contact.load(_data("slope_t1.h5")), tolerance=1e-6, sweeps=60000)


@check("The moving avalanche, solved by Siconos too", subject=SUBJECT, seconds=30, quick=None)
def siconos_avalanche(bench):
    """A step of the same slope at its largest kinetic energy (t₄; ``tests/data/avalanche_t4.h5``): impacts, sliding,
    rolling and residual cohesion, from a cold start.
    """
    return of_one_step(bench, contact.load(_data("avalanche_t4.h5")), tolerance=1e-6, sweeps=60000)


def _data(name):
    path = ROOT / "tests" / "data" / name
    if not path.exists():
        raise OracleError(
            f"{path} is not there: this check needs the data of a source checkout (tests/data/README.md says where they come from)"
        )
    return path
