"""The runs of a comparison below its folder, each in a process of its own; see
:mod:`yade.nonsmooth.running.side_by_side`.
"""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path

from ...running import processes, side_by_side
from ...system import keys
from .cases import CaseError, work_of

__all__ = ["folder_of", "run"]


def folder_of(case, out) -> Path:
    """Where a case's records are."""
    return Path(out) / "runs" / case.name


def run(function, cases, out, threads, resume=False, progress=lambda share, doing: None):
    """Calls ``function(folder, **case)`` for every case; returns what each returned, in their order, with
    ``process_wall_s``: wall time of its process [s].

    ``function``: of a module of this package, see processes.call. ``resume``: keep what has finished. ``progress``:
    called with the share done and what is being done. Raises CaseError with the first failure after all others
    have ended.
    """
    name = processes.named(function)
    made = [
        side_by_side.Run(
            c.name,
            folder_of(c, out),
            function,
            asdict(c),
            keys.key_of({"function": name, "case": asdict(c)}),
            work_of(c),
        )
        for c in cases
    ]
    return side_by_side.run(
        made,
        threads,
        resume,
        CaseError,
        "; finished runs are kept, go on with --resume",
        lambda share, ended: progress(share, f"{ended} of {len(made)} runs done"),
    )
