"""A plan of runs in its folder.

    plan.json              the runs: names, values, arguments
    Snakefile, array.sh    the same for a cluster, see :mod:`cluster`
    runs/NAME/             a run: its request, its records, and result.json once it has ended
    table.csv              a row for each run: its values and its results
    means.json             where seeds were varied: the results' means over them, for each combination of the other values and each verdict

A result is kept with the key of its input, the engines and this package's code; another's is made anew, and never
collected.
"""

from __future__ import annotations

import csv
import io
import json
import math
from dataclasses import asdict, dataclass, field
from pathlib import Path

from ..errors import UserError
from ..measure.statistics import over_seeds
from ..running import kept_runs, side_by_side
from ..studies import runs
from ..system import checks, installation, keys, output_folder
from ..system.whole_files import write_atomically, write_json
from . import cluster

__all__ = ["SEED", "Plan", "PlanError", "Planned", "collect", "means", "numbers", "read", "run_one"]

FILE, TABLE, MEANS, FORMAT = "plan.json", "table.csv", "means.json", 1
SEED = "seed"  # the key whose values are packings of one slope
VERDICT, MISSING = "verdict", "times_missing."  # of a slope's run, texts


class PlanError(UserError, RuntimeError):
    """A plan that cannot be read, run or collected; the message says why and what helps."""


@dataclass(frozen=True)
class Planned:
    """One run: its ``name``, which is that of its folder; the ``values`` that tell it from the others, for the table;
    ``arguments`` of the plan's function; ``work``: what it costs beside the others."""

    name: str
    values: dict
    arguments: dict
    work: float = 1.0

    @property
    def key(self):
        """Of its input."""
        return keys.key_of(self.arguments)


@dataclass(frozen=True)
class Plan:
    """Runs of one ``function``, "module:name" of this package (see processes.call); what it returns goes into the
    table. It goes on from what a halted run has left in its folder. ``notes``: sentences on what runs are allowed and
    may not be meant to do, not kept in the folder.
    """

    title: str
    function: str
    runs: tuple
    notes: tuple = field(default=(), compare=False)

    def write(self, out):
        """Writes the plan, and its files for a cluster, into the folder ``out``."""
        out = Path(out)
        content = {
            "format": FORMAT,
            "title": self.title,
            "function": self.function,
            "runs": [asdict(one) for one in self.runs],
        }
        write_json(out / FILE, content)
        cluster.write(out, self.title, {one.name: keys.run_key(one.key, self.function) for one in self.runs})

    def run(self, out, threads=1, resume=False, progress=lambda share, ended: None) -> dict:
        """Runs all, as many at a time as ``threads``, below the folder ``out``, and returns the table (see
        :func:`collect`).

        ``resume``: keep what has ended and go on with what was halted. ``progress``: called with the share done and the
        number of runs that have ended. Raises FolderError where another process works there, PlanError with the first
        failure after the others have ended, and interrupts.Interrupted after Ctrl-C.
        """
        checks.path("out", out, PlanError, runs.FOLDER)
        threads = checks.count("threads", threads, PlanError, runs.THREADS)
        installation.engines()
        advice = "; what has ended is kept, go on with --resume"
        with output_folder.claimed(out, "sweep.py", resume):
            self.write(out)
            made = [self._made(one, out) for one in self.runs]
            side_by_side.run(made, threads, resume, PlanError, advice, progress, go_on=True)
            return collect(out)

    def _made(self, one, out):
        return side_by_side.Run(
            one.name, Path(out) / "runs" / one.name, self.function, one.arguments, one.key, one.work
        )


def read(out) -> Plan:
    """The plan in a folder. Raises PlanError where there is none that can be read."""
    path = Path(checks.path("out", out, PlanError, "give the path of the folder of a plan")) / FILE
    try:
        content = json.loads(path.read_text())
        if content["format"] != FORMAT:
            raise PlanError(f"{path}: another version of this package wrote this plan; make it again with --plan")
        return Plan(content["title"], content["function"], tuple(Planned(**one) for one in content["runs"]))
    except FileNotFoundError:
        raise PlanError(f"{path}: there is no plan; make one with --plan, or give the folder of one") from None
    except (OSError, ValueError, KeyError, TypeError, RecursionError) as error:
        raise PlanError(f"{path}: the plan cannot be read ({error}); make it again with --plan") from None


def run_one(out, which):
    """Does one run of the plan in the folder ``out``, as a job of a cluster does: ``which``: its name, or its number
    from 0. Returns its result, which is kept; a run that has ended is not repeated, and one that was halted goes on.
    Raises PlanError where there is no such run, or where it fails.
    """
    plan = read(out)
    found = [one for k, one in enumerate(plan.runs) if which in (one.name, k)]
    if not found:
        what = (
            f"number {which}: give one from 0 to {len(plan.runs) - 1}"
            if isinstance(which, int)
            else f"run is called {which!r}: see {Path(out) / FILE}"
        )
        raise PlanError(f"{out}: no {what}")
    made = plan._made(found[0], out)
    with output_folder.claimed(made.folder, "sweep.py"):
        return side_by_side.run([made], 1, True, PlanError, go_on=True)[0]


def collect(out) -> dict:
    """Writes the table of the plan in the folder ``out``, and returns it: {column: list, a value for each run}; columns
    are the varied values, ``run`` (the name), what became of slopes (``verdict``) and why times did not come
    (``times_missing.t3``), and the numbers that the results have, None where one has no meaning.

    Raises PlanError where runs have not ended, or are of other input, engines or code.
    """
    plan = read(out)
    found = {one.name: kept_runs.kept(Path(out) / "runs" / one.name, one.key, plan.function) for one in plan.runs}
    missing = [name for name, result in found.items() if result is None]
    if missing:
        more = f" and {len(missing) - 3} more" if len(missing) > 3 else ""
        raise PlanError(
            f"{out}: {len(missing)} of {len(plan.runs)} runs have no result of this input, these engines and this code: {', '.join(missing[:3])}{more}; "
            "run them, or go on with --resume"
        )
    rows = [{"run": one.name, **one.values, **numbers(found[one.name])} for one in plan.runs]
    columns = list(dict.fromkeys(name for row in rows for name in row))
    table = {name: [row.get(name) for row in rows] for name in columns}
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerows([columns, *zip(*table.values())])
    write_atomically(Path(out) / TABLE, text.getvalue().encode())
    varied = list(plan.runs[0].values)
    if SEED in varied:
        content = {"title": plan.title, "varied": [key for key in varied if key != SEED], "rows": means(table, varied)}
        write_json(Path(out) / MEANS, content)
    return table


def means(table, varied) -> list:
    """Means over seeds of the numbers in a table (see :func:`collect`) for each combination of the other ``varied``
    keys and each verdict (:data:`yade.nonsmooth.studies.slope.verdict.MEANINGS`), as a slope that stood and one that
    failed have nothing in common that a mean would tell: dictionaries with ``values`` of these keys, ``verdict`` (None
    in a table that has none), ``seeds``, ``of``, the number of runs of this combination whatever became of them,
    ``times_missing``, {time: why it did not come, a list, one a run}, and ``numbers``, {name: see
    statistics.over_seeds}. Where no seed was varied each run is a row of its own. Raises PlanError for a table without
    the column ``run``, or without one of the ``varied`` keys.
    """
    checks.mapping(
        "table", table, PlanError, "give the table of a plan, {column: list}, as campaign.collect(...) returns it"
    )
    for key in ("run", *_keys(varied)):
        if key not in table:
            raise PlanError(
                f"{'varied' if key != 'run' else 'table'}: the table has no column {key!r}; it has {', '.join(table)}"
            )
    others = [key for key in varied if key != SEED]
    verdicts = table.get(VERDICT, [None] * len(table["run"]))
    rows, number = {}, {}
    for k in range(len(table["run"])):
        values = repr([table[key][k] for key in others])
        rows.setdefault((values, verdicts[k]), []).append(k)
        number[values] = number.get(values, 0) + 1
    reasons = [name for name in table if name.startswith(MISSING)]
    results = [name for name in table if name not in ("run", VERDICT, *reasons, *varied)]
    return [
        {
            "values": {key: table[key][found[0]] for key in others},
            "verdict": verdict,
            "seeds": [table[SEED][k] for k in found] if SEED in varied else [],
            "of": number[values],
            "times_missing": {name.removeprefix(MISSING): [table[name][k] for k in found] for name in reasons},
            "numbers": {name: over_seeds([table[name][k] for k in found]) for name in results},
        }
        for (values, verdict), found in rows.items()
    ]


def _keys(varied):
    """Keys that were varied. Raises PlanError where they are none."""
    if isinstance(varied, (list, tuple)) and all(isinstance(key, str) for key in varied):
        return varied
    raise PlanError(
        f"varied {checks.shown(varied)}: give the list of the keys that were varied, as ['seed', 'water.rate']"
    )


def numbers(result, prefix="") -> dict:
    """The numbers of a result, those of its dictionaries as `key.key`, its verdict and why times are missing; lists and
    other texts are left out.
    """
    found = {}
    for name, value in result.items():
        if isinstance(value, dict):
            found |= numbers(value, f"{prefix}{name}.")
        elif (
            value is None or isinstance(value, (bool, int, float)) or f"{prefix}{name}" == VERDICT or prefix == MISSING
        ):
            found[f"{prefix}{name}"] = None if isinstance(value, float) and not math.isfinite(value) else value
    return found
