"""Independent cases of a check, each in a YADE process of its own, as many at a time as there are threads, each result on disk.

Small scenes gain little from threads, so cases side by side use a machine better. What a case found is kept in the check's folder
under the case's values and is not computed again when an interrupted check is resumed (``scripts/verify.py --resume``).
"""

from __future__ import annotations

import json
import shutil

from .. import processes
from ..whole_files import write_atomically

__all__ = ["folder_of", "run_cases"]


def run_cases(bench, function, cases):
    """Calls ``function(folder, **case)`` for every case and returns what the calls returned, in the order of ``cases``.

    ``function``: of a module of this package, by name; it returns a dictionary that JSON can hold, to which ``wall_s`` [s] is added.
    ``folder``: an empty one for the case's files. ``cases``: dictionaries of numbers and short words. Raises RuntimeError with the end
    of its output where a case fails; the others are finished first.
    """
    cases, done = list(cases), 0
    bench.progress(f"{function.__name__}, {len(cases)} cases")

    def one(case):
        nonlocal done
        found = _one(bench.folder / "cases", function, case)
        done += 1
        bench.progress(f"{function.__name__}, {done} of {len(cases)} cases")
        return found

    with processes.pool(bench.threads) as pool:
        return [future.result() for future in [pool.submit(one, case) for case in cases]]


def name_of(function, case):
    """Name of a case's files: the function and the values, in the order of their names."""
    values = (f"{key}={value:g}" if isinstance(value, float) else f"{key}={value}" for key, value in sorted(case.items()))
    return ",".join((function.__name__.strip("_"), *values))


def folder_of(bench, function, case):
    """Folder in which a case left its files."""
    return bench.folder / "cases" / name_of(function, case)


def _one(home, function, case):
    name = name_of(function, case)
    path, folder = home / f"{name}.json", home / name
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        pass
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    found = processes.call(function, folder, case)
    write_atomically(path, json.dumps(found, indent=1).encode())
    return found
