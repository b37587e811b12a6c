"""Sweeps that a problem needs from zero impulses, and how much of the weight they have brought to the ground by
then.
"""

from __future__ import annotations

from ... import contact
from ..verification import lmgc90_packing
from ..verification.lmgc90_packing import carried

__all__ = ["carried", "lmgc90", "measure", "solve_cold"]

LOOSE, TIGHT = 1e-4, 1e-7  # residuals of the solve and of what it is compared with
SWEEPS = 50_000  # at most; a slope whose bonds share the load may not get to the tight one


def solve_cold(problem):
    """Sweeps and restarts of a ContactProblem from zero impulses, and the share of the converged solution's load that
    walls and floor then bear.
    """
    loose = contact.solve(problem, start="cold", tolerance=LOOSE, max_iterations=SWEEPS)
    # late in a solve the residual rises and falls over tens of sweeps: seldom looked at, it causes fewer needless
    # restarts
    tight = contact.solve(problem, start="cold", tolerance=TIGHT, max_iterations=SWEEPS, check_every=50)
    return {
        "contacts": len(problem.length),
        "sweeps": loose.iterations,
        "restarts": loose.restarts,
        "converged": loose.converged,
        "residual": loose.relative,
        "share_of_weight": carried(problem, loose.impulse) / carried(problem, tight.impulse),
        "sweeps_tight": tight.iterations,
        "residual_tight": tight.relative,
    }


def measure(folder, problem):
    """A problem's file; a function for processes.call."""
    return solve_cold(contact.load(problem))


def lmgc90(folder):
    """LMGC90's packing at rest (tests/data); a function for processes.call. Raises FileNotFoundError where it is
    missing.
    """
    _, problem, _ = lmgc90_packing.step_problem(folder)
    return solve_cold(problem)
