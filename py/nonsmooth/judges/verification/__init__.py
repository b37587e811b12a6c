"""What the law, the time stepping and the solver are held against: checks that compare with a derivation, with other
people's codes or with themselves at a finer step, and a report of them. ``scripts/verify.py`` runs them.

A check is a function marked by :func:`check`; it gets a :class:`Bench` and returns a :class:`Findings`: claims (one row
each in the report), plots and remarks. Checks stand in the modules named in :data:`MODULES`, by subject.
"""

import importlib

from .claims import Claim, Claims, Findings
from .registry import Bench, Check, check, registered

__all__ = ["MODULES", "Bench", "Check", "Claim", "Claims", "Findings", "check", "load_checks"]

#: Modules of this package that hold checks, in the report's order.
MODULES = (
    "contacts",
    "uneven",
    "bonds",
    "tumbling",
    "impacts",
    "impact_chains",
    "packings",
    "siconos",
    "space.siconos",
    "space.twisting",
    "lmgc90",
    "solver",
    "methods",
    "strength_convergence",
    "slope_convergence",
    "collapse",
    "safety",
    "triggers",
    "cuts",
    "avalanche",
    "paper",
    "water.seepage",
    "water.drawdown",
    "water.sections",
    "thermal",
)


def load_checks():
    """All checks, in the report's order."""
    for name in MODULES:
        importlib.import_module(f"{__name__}.{name}")
    return registered()
