"""Runs side by side: each in a YADE process and a folder of its own, as many at a time as there are threads; what has
ended is kept for a resume.

Each process has one thread, so wall times of all runs are on the same footing; those of runs that share a machine's
memory with others are a little longer than alone.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable
from concurrent.futures import wait
from dataclasses import dataclass
from pathlib import Path

from ..records import checkpoints
from ..system import output_folder
from ..system.whole_files import WriteError, empty
from . import kept_runs, processes
from .interrupts import Interrupted

__all__ = ["Run", "check", "check_folders", "folder_of", "run"]

LOOK_SECONDS = 1.0  # between two looks at how far the runs are


@dataclass(frozen=True)
class Run:
    """One run. ``name``: for messages; ``folder``: of its records; ``function``, ``arguments``: see processes.call,
    which takes the function's name too; the function may note the share done with kept_runs.Progress. ``key``: of what
    its result depends on, but for engines and code; ``work``: what it costs beside the others, in any unit.
    """

    name: str
    folder: Path
    function: Callable | str
    arguments: dict
    key: str
    work: float = 1.0


def check(runs, error=processes.RunError, advice=""):
    """Raises ``error``, a class, with the ``advice`` where Runs share a folder: each would take the other's records for
    its own.
    """
    twice = [folder for folder, number in Counter(r.folder for r in runs).items() if number > 1]
    if twice:
        raise error(f"{', '.join(sorted(folder.name for folder in twice))}: two runs of one name{advice}")


def check_folders(runs, resume, error, go_on=False):
    """Raises ``error``, a class, where the folder of one of the Runs holds what no run has left there, or the checkpoint
    of a run that was halted, from which this one would not go on; arguments as of :func:`run`.
    """
    for r in runs:
        found = kept_runs.foreign(r.folder, output_folder.LOCK)
        if found is not None:
            raise error(
                f"{r.folder}: holds {found}, which no run has left there, and a run empties its folder; give an empty folder, a new one, or that of an earlier run"
            )
        if not go_on or not checkpoints.exists(r.folder) or (r.folder / "result.json").exists():
            continue
        if not resume:
            raise error(
                f"{r.folder}: holds a run that was halted, with its checkpoint, which a new run would remove; go on with it with --resume, or give another --out"
            )
        if "input" in (kept_runs.changed(r.folder, r.key, r.function) or ()):
            raise error(
                f"{r.folder}: holds a run of other parameters that was halted; give the same ones, or another --out"
            )


def folder_of(out, name, error):
    """The folder of a run below ``out``. Raises ``error``, a class, for a name that is no name of a folder in it."""
    if not isinstance(name, str) or not name or name in (".", "..") or Path(name).name != name:
        raise error(f"{name!r} as the name of a run: give a word that can be the name of a folder")
    return Path(out) / "runs" / name


def run(
    runs, threads, resume=False, error=processes.RunError, advice="", progress=lambda share, ended: None, go_on=False
):
    """Does all Runs, the costly ones first so that threads end together. Returns what their functions returned, in the
    order of ``runs``, each with ``process_wall_s``: wall time of its process [s].

    ``resume``: keep what has ended; ``go_on``: keep also what halted runs of the same input, engines and code have
    written, since their function goes on from it. All else in the folders is removed, but what
    :func:`check_folders` refuses. ``progress``: called about once a second with the share done of all work, and how many
    runs have ended. Raises ``error``, a class, before anything runs where Runs share a folder, and with the first
    failure (in the order of ``runs``) and the ``advice`` after the others have ended; interrupts.Interrupted after
    Ctrl-C.
    """
    runs = list(runs)
    check(runs, error)
    known = {r.folder: kept_runs.kept(r.folder, r.key, r.function) if resume else None for r in runs}
    check_folders([r for r in runs if known[r.folder] is None], resume, error, go_on)
    for r in runs:
        if known[r.folder] is None:
            kept_runs.forget(r.folder)
            if not (resume and go_on and kept_runs.begun(r.folder, r.key, r.function)):
                _clear(r.folder)
            r.folder.mkdir(parents=True, exist_ok=True)
            kept_runs.begin(r.folder, r.key, r.function)
    whole = sum(r.work for r in runs)
    futures = {}
    try:
        with processes.pool(threads) as pool:
            futures |= {r.folder: pool.submit(_one, r, known[r.folder]) for r in sorted(runs, key=lambda r: -r.work)}
            left = set(futures.values())
            while left:
                left = wait(left, timeout=LOOK_SECONDS).not_done
                progress(
                    sum(r.work * kept_runs.share(r.folder) for r in runs) / whole,
                    sum(f.done() for f in futures.values()),
                )
    except KeyboardInterrupt:
        ended = sum(f.done() and not f.cancelled() and not f.exception() for f in futures.values())
        raise Interrupted(
            f"{ended} of {len(runs)} runs have ended and are kept{', others have their checkpoint' if go_on else ''}; go on with --resume"
        ) from None
    failures = [f"{r.name}: {failed}" for r in runs if (failed := futures[r.folder].exception())]
    if failures:
        raise error(failures[0] + (f" (and {len(failures) - 1} more)" if len(failures) > 1 else "") + advice)
    return [futures[r.folder].result() for r in runs]


def _clear(folder):
    """Removes an earlier run; what another process might take for the new one's goes first, so that a kill on the way
    leaves none of it.
    """
    checkpoints.forget(folder)
    try:
        kept_runs.forsake(folder)
        empty(
            folder, output_folder.LOCK, "key"
        )  # the lock of a process which holds the folder, and the mark that runs may empty it
    except OSError as error:
        raise WriteError(
            f"{folder}: what an earlier run left there cannot be removed ({error.strerror}); remove it, or give another --out"
        ) from None


def _one(r, known):
    if known is not None:
        return known
    began = time.monotonic()
    found = processes.call(r.function, r.folder, r.arguments)
    found["process_wall_s"] = time.monotonic() - began
    kept_runs.keep(r.folder, r.key, found, r.function)
    return found
