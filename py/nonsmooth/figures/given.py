"""What functions that draw ask of their arguments before they draw: rules of :func:`..checks.takes`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ..records import RecordsError
from ..records.given import FILE, SNAPSHOT
from ..system import checks

__all__ = ["CASES", "MATERIAL", "SCENE", "SECTION", "SERIES", "SNAPSHOT", "WALLS", "takes"]

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
PATH = (lambda v: v is None or FILE[0](v), "give the name of a PNG, or None for the figure itself")


def takes(**rules):
    """:func:`..checks.takes` with RecordsError, and the rule of ``path``, which all of them have."""
    return checks.takes(RecordsError, **rules, path=PATH)
