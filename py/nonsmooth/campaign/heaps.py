"""Columns and piles from any Python: each runs in a YADE process of its own, and is opened from its folder.

    from nonsmooth import campaign
    from nonsmooth.heaps import column

    c = column.Column(disks=300, aspect=1.5)
    cases = {"hard": (c, {}), "soft": (c, dict(name="soft", stiffness=1e8))}
    runs = campaign.run_heaps(cases, "out/columns", threads=2)
    runs["hard"].summary["runout_rel"], runs["soft"].figure()
"""

from __future__ import annotations

from ..running import side_by_side
from ..studies import runs
from ..studies.heaps import column, pile, study
from ..studies.heaps.grains import HeapError
from ..studies.runs import HeapRun
from ..system import checks, output_folder
from .cases import run as run_cases

__all__ = ["HeapRun", "open_heap", "run_column", "run_heaps", "run_pile"]

COMMAND = "column.py"  # which writes the same records
CASES = "give a dictionary {name: (Column or Pile, {value of its world: number})}, of one or more"


def open_heap(folder) -> HeapRun:
    """The HeapRun in a folder: that of run_column or run_pile, or one of ``runs`` below that of run_heaps or
    scripts/column.py. Raises RunError where it is none.
    """
    run = HeapRun(folder)
    if not (run.folder / runs.RESULT).is_file() or run._asked.get("kind") not in study.KINDS:
        raise runs.RunError(
            f"{folder}: no run of a column or pile has ended here; give the folder that was given to it"
        )
    return run


def run_heaps(cases, out, threads=1, resume=False, duration=study.DURATION) -> dict:
    """Runs ``cases``, {name: (Column or Pile, world)}, as many at a time as ``threads``, in ``out/runs/NAME``; returns
    {name: HeapRun}.

    ``world``: a dictionary, arguments of heaps.study.world_of: {} is rigid disks, ``dict(name="soft", stiffness=1e8)``
    springs, from the same places. ``resume``: keep runs of these parameters that have ended; ``duration``: see
    heaps.course.run. Raises HeapError or SoftError for values that cannot be used, before anything runs, HeapError
    where a run fails, after the others have ended, and FolderError where another process works in the folder.
    """
    made = run_cases(
        cases,
        out,
        lambda name, folder, *case: study.planned(name, folder, *case, duration),
        COMMAND,
        threads,
        resume,
        HeapError,
        (CASES, CASES),
    )
    return {one.name: HeapRun(one.folder) for one in made}


def run_column(made, out, world="hard", duration=study.DURATION, resume=False, **numerics) -> HeapRun:
    """Runs one Column in the folder ``out``, in a process of its own, and opens the run.

    ``world``: "hard", or "soft" with its ``stiffness`` [Pa]; ``numerics``: other arguments of heaps.study.world_of, as
    ``tolerance``, ``damping`` or ``model``. The rest as for :func:`run_heaps`, which does several side by side.
    """
    return _alone(made, column.Column, out, world, duration, resume, numerics)


def run_pile(made, out, world="hard", duration=study.DURATION, resume=False, **numerics) -> HeapRun:
    """As :func:`run_column`, one Pile."""
    return _alone(made, pile.Pile, out, world, duration, resume, numerics)


def _alone(made, kind, out, world, duration, resume, numerics):
    if type(made) is not kind:
        raise HeapError(f"{checks.shown(made)}: is no {kind.KIND}; give a heaps.{kind.KIND.lower()}.{kind.KIND}")
    checks.path("out", out, HeapError, runs.FOLDER)
    one = study.planned(str(out), out, made, {"name": world, **numerics}, duration)
    with output_folder.claimed(out, COMMAND, resume):
        side_by_side.run([one], 1, resume, HeapError)
    return HeapRun(out)
