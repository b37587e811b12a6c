"""What functions that draw ask of their arguments before they draw: rules of :func:`..checks.takes`."""

from __future__ import annotations

import numbers
import os
from collections.abc import Iterable, Mapping
from pathlib import Path

from matplotlib.backend_bases import FigureCanvasBase

from ..records import RecordsError
from ..records.given import FILE
from ..records.snapshots import given_with as snapshot
from ..system import checks

__all__ = [
    "CASES",
    "LABELLED",
    "MATERIAL",
    "PATH",
    "SCENE",
    "SECTION",
    "SERIES",
    "SNAPSHOT",
    "SNAPSHOTS",
    "WALLS",
    "WET",
    "cases",
    "snapshot",
    "takes",
]

SNAPSHOT = snapshot("layer")
SERIES = checks.kind(Mapping, "give columns {name: array}, as run.series or records.read_series(path) has them")
SECTION = checks.has("walls layers downslope", "give a Section, as section.load('circle') returns one")
MATERIAL = checks.has(
    "friction tensile_strength bond_ellipse", "give a section.Material, as section.load('circle').materials['soil']"
)
ROWS = (
    lambda v: isinstance(v, (list, tuple)) and all(isinstance(one, Mapping) for one in v),
    "give rows, a list of dictionaries, as campaign.means(...) returns them",
)
SCENE = checks.has("bodies interactions", "give YADE's O")
DRAWN = (lambda v: hasattr(v, "bodies") or hasattr(v, "walls"), "give YADE's O, or a Scene, as run.scene() returns one")
WALLS = (
    lambda v: hasattr(v, "walls")
    or isinstance(v, (list, tuple))
    and not any(isinstance(one, (str, int, float)) for one in v),
    "give a Section, or walls as [(name, vertices, role)]",
)
CASES = (
    lambda v: isinstance(v, Iterable) and not isinstance(v, (str, Mapping)),
    "give a list of cases, as the function's description has them",
)


def cases(each, *parts):
    """The rule of a list of cases, of which ``each`` is, in words, a tuple of ``parts``: rules or None where anything
    will do; alone, a part is no tuple. Others than lists and tuples, which can be read but once, are let through as
    they are."""

    def fits(case):
        if len(parts) == 1:
            return parts[0][0](case)
        told = isinstance(case, (list, tuple)) and len(case) == len(parts)
        return told and all(rule is None or rule[0](part) for rule, part in zip(parts, case))

    def all_fit(value):
        return CASES[0](value) and (not isinstance(value, (list, tuple)) or all(map(fits, value)))

    return all_fit, f"give a list of cases, each {each}"


LABELLED = cases("(label, Snapshot)", None, SNAPSHOT)
WET = cases("(label, Snapshot), of a slope", None, snapshot("layer", "wet", "released", "water_m"))
SNAPSHOTS = cases("a Snapshot, as run.snapshot('end') returns one", SNAPSHOT)


def _is_number(value):
    return isinstance(value, numbers.Real) and not isinstance(value, bool)


def _are_times(value):
    value = getattr(value, "times", value)
    return value is None or isinstance(value, Mapping) and all(v is None or _is_number(v) for v in value.values())


def _is_figure(value):
    """Whether matplotlib writes files of this name: without a suffix it would choose one, and the file would have
    another name.
    """
    return value is None or FILE[0](value) and Path(os.fspath(value)).suffix[1:].lower() in _SUFFIXES


_SUFFIXES = FigureCanvasBase.get_supported_filetypes()
PATH = (_is_figure, "give the name of a PNG, as figure.png, or of a PDF or SVG, or None for the figure itself")
TIMES = (_are_times, "give {'t0': seconds, …}, None for a time that did not come, as run.summary['times_s'] has them")


def _above(least, what):
    return lambda v: _is_number(v) and least < v < float("inf"), f"give {what}"


#: Rules of options that several figures have, by their names.
_OPTIONS = dict(
    times=TIMES,
    window=_above(0, "the seconds that a mean is over, above 0"),
    limit=_above(0, "a number above 0, 0.02 for 2 %"),
    moving=_above(0, "a speed in m/s, above 0"),
    number=(
        lambda v: isinstance(v, numbers.Integral) and not isinstance(v, bool) and v >= 1,
        "give a whole number from 1",
    ),
    friction_deg=(lambda v: v is None or _is_number(v) and 0 <= v < 90, "give degrees from 0 to less than 90, or None"),
)


def takes(**rules):
    """:func:`..checks.takes` with RecordsError, and the rules of options that several of them have."""
    return checks.takes(RecordsError, **{**_OPTIONS, **rules})
