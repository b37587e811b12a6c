"""A slope with some of its values varied: all combinations, each checked like a section file before anything runs; and a slope alone."""

from __future__ import annotations

import copy
import difflib
import itertools
import re

from .. import checkpoints, output_folder, processes, runs, section, section_checks, section_data
from .plan import Plan, PlanError, Planned

__all__ = ["FUNCTION", "put", "run_slope", "sweep"]

MOST = 10_000  # runs of a plan
LONGEST = 150  # characters of a folder's name; longer ones become numbers
FUNCTION = "campaign.slope_run:run"


def sweep(base, over, end=None, figures=False) -> Plan:
    """A Plan of all combinations of the values in ``over``, {key: values}, for the Section ``base``.

    A key is the way to a value in a section file, with dots: ``seed``, ``water.table.rate``, ``materials.soil.friction``, ``walls.DP.material``, where items
    of a list go by their name. ``end``: stop after so many seconds of simulated time; ``figures``: draw each run's too.

    Raises PlanError for a key that the section has not, for no or doubled values, and for more than :data:`MOST` runs; SectionError, naming the run, where a
    combination is no section.
    """
    over = {key: list(values) for key, values in over.items()}
    for key, values in over.items():
        if not values:
            raise PlanError(f"{key}: no value to run with; give one or more")
        if len({repr(v) for v in values}) < len(values):
            raise PlanError(f"{key}: {', '.join(map(str, values))}: a value stands twice; give each once")
    number = 1
    for values in over.values():
        number *= len(values)
    if number > MOST:
        raise PlanError(f"{' × '.join(str(len(v)) for v in over.values())} = {number} runs; a plan has {MOST} at most")
    whole, short = section_data.plain(base), _short(over)
    planned, notes = [], []
    for k, combination in enumerate(itertools.product(*over.values())):
        values = dict(zip(over, combination))
        name = "_".join(f"{short[key]}={_text(value)}" for key, value in values.items()) or "run"
        if len(name) > LONGEST:
            name = f"{k:04d}"
        data = copy.deepcopy(whole)
        for key, value in values.items():
            put(data, key, value)
        made = section.of(data, name)
        notes += section_checks.notes(made)
        planned.append(
            Planned(
                name,
                values,
                {"data": section_data.plain(made), "end": end, "figures": figures},
                float(sum(made.disk_counts())),
            )
        )
    return Plan(base.name, FUNCTION, tuple(planned), tuple(notes))


def run_slope(made, out, end=None, figures=False, resume=False, threads=1) -> runs.Run:
    """Runs one Section in the folder ``out``, in a process of its own, and opens the run; the process may have several ``threads``. The rest as for :func:`sweep`;
    ``resume``: go on from its checkpoint.

    Raises FolderError where another process works there, and processes.RunError where the run fails.
    """
    with output_folder.claimed(out, "slope.py", resume):
        if not resume:
            checkpoints.forget(out)
        processes.call(FUNCTION, out, {"data": section_data.plain(made), "end": end, "figures": figures}, threads)
    return runs.open_run(out)


def _short(over):
    """Names of keys in names of runs: the last word, or as many as tell them apart."""

    def last(key, count):
        return ".".join(key.split(".")[-count:])

    return {
        key: next(last(key, n) for n in range(1, 99) if sum(last(other, n) == last(key, n) for other in over) == 1)
        for key in over
    }


def _text(value):
    """A value in a name of a folder."""
    if isinstance(value, (list, tuple)):
        return "x".join(map(_text, value))
    return re.sub(r"[^\w.+-]", "-", str(value))


def put(data, key, value):
    """Puts a value into the plain data of a section, where the key leads (see :func:`sweep`). Raises PlanError where there is no such key."""
    place, way = data, key.split(".")
    for k, word in enumerate(way):
        last, so_far = k == len(way) - 1, ".".join(way[:k])
        if isinstance(place, list):
            names = [item.get("name") for item in place if isinstance(item, dict)]
            if word not in names or last:
                _refuse(key, word, so_far, names)
            place = place[names.index(word)]
            continue
        if not isinstance(place, dict) or not last and word not in place:
            _refuse(key, word, so_far, place if isinstance(place, dict) else ())
        if last:
            place[word] = value  # a word that no section has is refused when it is read
        else:
            place = place[word]


def _refuse(key, word, so_far, names):
    near = difflib.get_close_matches(word, [str(n) for n in names], 1)
    where = f"in {so_far} of the section" if so_far else "in the section"
    advice = (
        f"did you mean {near[0]!r}?"
        if near
        else f"there are {', '.join(map(str, names))}"
        if names
        else "nothing can be varied there"
    )
    raise PlanError(f"{key}: there is no {word!r} {where}; {advice}")
