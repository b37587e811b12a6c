"""Cases in YADE processes of their own, as many at a time as there are threads; each keeps its result, so that a resume repeats none.

Each process has one thread, so wall times of all runs are on the same footing; those of runs that share a machine's memory with others are a little
longer than alone.
"""

from __future__ import annotations

import shutil
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict
from pathlib import Path

from .. import checkpoints, processes
from ..kept_runs import NOTE_SECONDS, keep, kept, share
from .cases import ComparisonError

__all__ = ["folder_of", "found_of", "run"]


def folder_of(case, out) -> Path:
    """Where a case's records are."""
    return Path(out) / "runs" / case.name


def _key(function, case):
    return checkpoints.key_of({"function": f"{function.__module__}.{function.__name__}", "case": asdict(case)})


def found_of(function, case, out):
    """What a finished case returned, None where it has not finished or was another."""
    return kept(folder_of(case, out), _key(function, case))


def run(function, cases, out, threads, resume=False, progress=lambda share, doing: None):
    """Calls ``function(folder, **case)`` for every case; returns what each returned, in their order, with ``process_wall_s``: wall time of its process [s].

    ``function``: of a module of this package, see processes.call; it may write the share done with :class:`~yade.nonsmooth.kept_runs.Progress`.
    ``resume``: keep what has finished. ``progress``: called with the share done and what is being done. Raises ComparisonError with the first failure
    after all others have ended.
    """
    cases = list(cases)
    for case in cases:
        folder = folder_of(case, out)
        if not resume or found_of(function, case, out) is None:
            shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True, exist_ok=True)
    ended = threading.Event()
    watcher = threading.Thread(target=_watch, args=([folder_of(c, out) for c in cases], progress, ended), daemon=True)
    watcher.start()
    try:
        with ThreadPoolExecutor(max(1, threads)) as pool:
            futures = [pool.submit(_one, function, case, out) for case in cases]
            failures = [_failure(case, out, error) for case, f in zip(cases, futures) if (error := f.exception())]
    finally:
        ended.set()
        watcher.join()
    if failures:
        more = f" (and {len(failures) - 1} more)" if len(failures) > 1 else ""
        raise ComparisonError(f"{failures[0]}{more}; finished runs are kept, go on with --resume")
    return [f.result() for f in futures]


def _one(function, case, out):
    found = found_of(function, case, out)
    if found is None:
        folder, began = folder_of(case, out), time.monotonic()
        found = processes.call(function, folder, asdict(case))
        found["process_wall_s"] = time.monotonic() - began
        keep(folder, _key(function, case), found)
    return found


def _failure(case, out, error):
    """One line: the last of the error's own; with the place of the log, where it does not name it."""
    line = next((line.strip() for line in reversed(str(error).splitlines()) if line.strip()), type(error).__name__)
    log = folder_of(case, out) / "log.txt"
    return f"{case.name}: {line}" + ("" if str(log) in line else f" (all of it: {log})")


def _watch(folders, progress, ended):
    while not ended.wait(NOTE_SECONDS):
        shares = [share(folder) for folder in folders]
        progress(sum(shares) / len(shares), f"{sum(s >= 1 for s in shares)} of {len(shares)} runs done")
