"""Several runs of one kind from a dictionary of cases: their arguments checked, planned, and run side by side below one
folder. Needs no YADE.
"""

from __future__ import annotations

from collections.abc import Mapping

from ..running import side_by_side
from ..studies import runs
from ..system import checks, output_folder

__all__ = ["run"]


def run(cases, out, planned, command, threads, resume, error, remedies) -> list:
    """Runs ``cases``, {name: (what, {name: value})}, as many at a time as ``threads``, in ``out/runs/NAME``; returns
    the side_by_side.Runs that ``planned(name, folder, what, values)`` has made.

    ``command``: whose folder it is; ``remedies``: what to give for cases that are no such dictionary, and for one case
    that is no such pair. Raises ``error``, a class, for arguments that make no sense, before anything runs, and where a
    run fails, after the others have ended; FolderError where another process works in the folder.
    """
    checks.path("out", out, error, runs.FOLDER)
    threads = checks.count("threads", threads, error, runs.THREADS)
    for name, case in checks.mapping("cases", cases, error, remedies[0]).items():
        if not (isinstance(case, (tuple, list)) and len(case) == 2 and isinstance(case[1], Mapping)):
            raise error(f"case {name!r}, {checks.shown(case)}: {remedies[1]}")
    made = [planned(name, side_by_side.folder_of(out, name, error), *case) for name, case in cases.items()]
    with output_folder.claimed(out, command, resume):
        side_by_side.run(made, threads, resume, error)
    return made
