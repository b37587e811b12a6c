"""What functions that write files of a run ask of their arguments before they write: rules of :func:`..checks.takes`.
"""

import os
from collections.abc import Mapping

from ..system import checks
from .error import RecordsError

__all__ = ["BREAKS", "ENTRIES", "FILE", "surfaces", "takes"]

FILE = (lambda v: isinstance(v, (str, os.PathLike)) and bool(os.fspath(v)), "give the path of the file to write")

ENTRIES = (
    lambda v: isinstance(v, (list, tuple)) and all(isinstance(one, (list, tuple)) and len(one) == 2 for one in v),
    "give a list of (time, file) pairs",
)

BREAKS = checks.holds("time_s mode x_m y_m", "give broken bonds, as run.breaks or records.read_breaks(path) has them")


def surfaces(names):
    """A rule: arrays by walls that have these columns, words in a text."""
    fits = checks.holds(names, "")[0]
    return (
        lambda v: isinstance(v, Mapping) and all(map(fits, v.values())),
        "give arrays by walls, as run.slip_surface_arrays or records.read_surface_arrays(path) has them",
    )


def takes(**rules):
    """:func:`..checks.takes` with RecordsError, and the rule of ``path``, which all of them have."""
    return checks.takes(RecordsError, **rules, path=FILE)
