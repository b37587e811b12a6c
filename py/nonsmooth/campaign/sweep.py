"""A slope with some of its values varied: all combinations, each checked like a section file before anything runs; and
a slope alone.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Mapping

from ..model import section
from ..model.section import checks as section_checks, data as section_data, values as section_values
from ..records import checkpoints
from ..running import processes
from ..studies import runs
from ..studies.slope import results
from ..system import checks, output_folder
from .plan import Plan, PlanError, Planned

__all__ = ["FUNCTION", "arguments_of", "combinations", "results_of", "run_slope", "sweep"]

MOST = 10_000  # runs of a plan
LONGEST = 150  # characters of a folder's name; longer ones become numbers
FUNCTION = "studies.slope.slope_run:run"


def sweep(base, over, end=None, figures=False) -> Plan:
    """A Plan of all combinations of the values in ``over``, {key: values}, for the Section ``base``.

    A key is the way to a value in a section file, with dots: ``seed``, ``water.table.rate``,
    ``materials.soil.friction``, ``walls.DP.material``, where items of a list go by their name. Each run has what a file
    with its values gives (see :func:`.section_values.with_values`). ``end``: stop after so many seconds of simulated
    time; ``figures``: draw each run's too.

    Raises PlanError for what is no Section, no such dictionary or no time, for a key that the section has not, for
    no or doubled values, for a key before one that holds it, and for more than :data:`MOST` runs; SectionError,
    naming the run, where a combination is no section.
    """
    _check(base, "base", end)
    planned, notes = combinations(base, over, lambda made: arguments_of(made, end, figures))
    return Plan(base.name, FUNCTION, planned, notes)


def combinations(base, over, arguments) -> tuple:
    """What a Plan has of all combinations of the values in ``over``: its runs and its notes. ``arguments(section)``:
    those of the plan's function. The rest, and what it raises, as of :func:`sweep`.
    """
    remedy = "give a dictionary {key: values}, as {'seed': [1, 2]}"
    if not isinstance(over, Mapping):
        raise PlanError(f"over {checks.shown(over)}: {remedy}")
    for key, values in over.items():
        if not isinstance(key, (str, tuple)):
            raise PlanError(f"over, key {checks.shown(key)}: {remedy}")
        if isinstance(values, (str, Mapping)) or not isinstance(values, Iterable):
            raise PlanError(f"{key}: {checks.shown(values)}: give the values to run with, as [{checks.shown(values)}]")
    over = {key: list(values) for key, values in over.items()}
    for key, values in over.items():
        if not values:
            raise PlanError(f"{key}: no value to run with; give one or more")
        if len({repr(v) for v in values}) < len(values):
            raise PlanError(f"{key}: {', '.join(map(str, values))}: a value stands twice; give each once")
    if lost := section_values.replaced(over):
        raise PlanError(lost)
    number = 1
    for values in over.values():
        number *= len(values)
    if number > MOST:
        raise PlanError(f"{' × '.join(str(len(v)) for v in over.values())} = {number} runs; a plan has {MOST} at most")
    short, planned, notes = section_values.short(over), [], []
    for k, combination in enumerate(itertools.product(*over.values())):
        values = dict(zip(over, combination))
        name = "_".join(f"{short[key]}={_text(value)}" for key, value in values.items()) or "run"
        if len(name) > LONGEST:
            name = f"{k:04d}"
        try:
            made = section_values.with_values(base, values, name)
        except section_values.NoSuchKey as wrong:
            raise PlanError(str(wrong)) from None
        notes += section_checks.notes(made)
        planned.append(Planned(name, values, arguments(made), float(sum(made.disk_counts()))))
    if "disks.diameter" in over and (base.disks.count or "disks.count" in over):
        notes.insert(
            0,
            f"{base.source}: the number of disks is given too, by which all diameters are scaled: of disks.diameter only the ratio counts; leave --disks or "
            "disks.count out to vary the size",
        )
    return tuple(planned), tuple(notes)


def results_of(plan) -> list | None:
    """Names of the numbers that the runs of a Plan may have in their table, known before anything runs; None where they
    are no slopes.
    """
    if plan.function != FUNCTION:
        return None
    return results.numbers_of(section.of(plan.runs[0].arguments["data"], plan.runs[0].name))


def run_slope(made, out, end=None, figures=False, resume=False, threads=1) -> runs.Run:
    """Runs one Section in the folder ``out``, in a process of its own, and opens the run; the process may have several
    ``threads``. The rest as for :func:`sweep`; ``resume``: go on from its checkpoint.

    Raises PlanError for arguments that make no sense, FolderError where another process works there, and
    processes.RunError where the run fails.
    """
    _check(made, "made", end)
    checks.path("out", out, PlanError, runs.FOLDER)
    checks.count("threads", threads, PlanError, "give a whole number from 1, of the process")
    with output_folder.claimed(out, "slope.py", resume):
        if not resume:
            checkpoints.forget(out)
        processes.call(FUNCTION, out, arguments_of(made, end, figures), threads)
    return runs.open_run(out)


def _check(made, name, end):
    """Raises PlanError for what is no Section, and for an end that is no time."""
    if not isinstance(made, section.Section):
        raise PlanError(f"{name} {checks.shown(made)}: give a Section, as section.load('circle') returns one")
    if end is not None:
        checks.number("end", end, PlanError, "give seconds of simulated time, above 0, or None", above=0)


def arguments_of(made, end=None, figures=False):
    """What :data:`FUNCTION` takes for a Section, as plain data: with the section that a similar one is packed as."""
    arguments = {"data": section_data.plain(made), "end": end, "figures": figures}
    if made.like:
        original, factor = made.like
        arguments["like"] = {"data": section_data.plain(original), "factor": factor}
    return arguments


def _text(value):
    """A value in a name of a folder."""
    if isinstance(value, (list, tuple)):
        return "x".join(map(_text, value))
    return re.sub(r"[^\w.+-]", "-", str(value))
