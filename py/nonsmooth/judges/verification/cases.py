"""Independent cases of a check, each in a YADE process of its own, as many at a time as there are threads, each result
on disk.

What a case found is kept in a folder below the check's, and is not computed again when an interrupted check is resumed
(``scripts/verify.py --resume``).
"""

from __future__ import annotations

from ...running import processes, side_by_side
from ...system import keys

__all__ = ["folder_of", "run_cases"]


def run_cases(bench, function, cases):
    """Calls ``function(folder, **case)`` for every case and returns what the calls returned, in the order of ``cases``.

    ``function``: of a module of this package; it returns a dictionary that JSON can hold, to which ``wall_s`` and
    ``process_wall_s`` [s] are added. ``folder``: an empty one for the case's files. ``cases``: dictionaries of numbers
    and short words, all different. Raises processes.RunError with the end of its output where a case fails; the others
    are finished first.
    """
    cases, name = list(cases), processes.named(function)
    runs = [
        side_by_side.Run(
            name_of(function, case),
            folder_of(bench, function, case),
            function,
            case,
            keys.key_of({"function": name, "case": case}),
        )
        for case in cases
    ]
    bench.progress(f"{function.__name__}, {len(cases)} cases")
    return side_by_side.run(
        runs,
        bench.threads,
        resume=True,
        progress=lambda share, ended: bench.progress(f"{function.__name__}, {ended} of {len(cases)} cases"),
    )


def name_of(function, case):
    """Name of a case's folder: the function and the values, in the order of their names."""
    values = (
        f"{key}={value:g}" if isinstance(value, float) else f"{key}={value}" for key, value in sorted(case.items())
    )
    return ",".join((function.__name__.strip("_"), *values))


def folder_of(bench, function, case):
    """Folder in which a case left its files."""
    return bench.folder / "cases" / name_of(function, case)
