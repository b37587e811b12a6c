"""Factors of safety from any Python: a plan of searches, each in a process of its own, and one search, opened from its
folder.

    from nonsmooth import campaign, section

    plan = campaign.factors_of_safety(section.load("circle").with_disks(600), {"seed": [1, 2, 3]}, table=5.0)
    table = plan.run("out/safety", threads=2)
    table["factor"], table["factor_low"], table["factor_high"]
"""

from __future__ import annotations

from pathlib import Path

from ..model import section
from ..model.materials import REDUCED
from ..running import side_by_side
from ..studies import runs
from ..studies.safety import asked as safety_asked
from ..system import checks, output_folder
from .plan import Plan, PlanError
from .sweep import arguments_of, combinations

__all__ = ["factors_of_safety", "run_factor_of_safety"]

FUNCTION = "studies.safety.search_run:run"
COMMAND = "factor_of_safety.py"


def factors_of_safety(
    base, over=None, quantities=REDUCED, materials=None, world=None, table=None, figures=True, **numbers
) -> Plan:
    """A Plan of searches for the factor of safety: of the Section ``base``, or of all combinations of the values in
    ``over``, {key: values}, as :func:`.sweep.sweep` has them.

    ``quantities``, ``materials``, ``world``: what is divided, in which materials, in which world, see
    :class:`.safety.asked.Asked`; ``table``: height [m] at which the water table stands, None: the section's where that
    comes to stand, else dry; ``figures``: draw each search's too; ``numbers``: ``step``, ``within``, ``most`` and
    ``least``, see :mod:`.course.strength_reduction`. The table of the plan has ``factor`` with its bracket,
    ``factor_low`` and ``factor_high``, and the ``verdict``: "found", "stands" or "falls".

    Raises what :func:`.sweep.sweep` and :class:`.safety.asked.Asked` raise, before anything runs.
    """
    _check(base, "base")
    told, more = {}, {"quantities": quantities, "materials": materials, "world": world or {}, "numbers": numbers}

    def arguments(made):
        still, note = safety_asked.standing(made, table)
        asked = safety_asked.Asked(still, **more)  # refuses what cannot be searched
        if note:
            told.setdefault(note, None)
        plain = arguments_of(still, None, figures)
        del plain["end"]
        chosen = None if asked.materials is None else list(asked.materials)
        return plain | more | {"quantities": list(asked.quantities), "materials": chosen}

    planned, notes = combinations(base, over or {}, arguments)
    return Plan(base.name, FUNCTION, planned, (*notes, *told))


def run_factor_of_safety(made, out, resume=False, **options) -> runs.SafetyRun:
    """Searches the factor of safety of one Section in the folder ``out``, in a process of its own, and opens the
    search. ``options``: as of :func:`factors_of_safety` but ``over``; ``resume``: keep a search of these that has
    ended, and go on from the checkpoint of one that was halted.

    Raises what :func:`factors_of_safety` raises, FolderError where another process works there, and PlanError where the
    search fails.
    """
    _check(made, "made")
    checks.path("out", out, PlanError, runs.FOLDER)
    (one,) = factors_of_safety(made, **options).runs
    asked = side_by_side.Run(str(out), Path(out), FUNCTION, one.arguments, one.key)
    with output_folder.claimed(out, COMMAND, resume):
        side_by_side.run([asked], 1, resume, PlanError, go_on=True)
    return runs.SafetyRun(out)


def _check(made, name):
    if not isinstance(made, section.Section):
        raise PlanError(f"{name} {checks.shown(made)}: give a Section, as section.load('circle') returns one")
