"""Seepage through a section: conductivities, and states with what happens at the border in each. Plain data, and the
checks that a schema cannot make. Needs no YADE.
"""

from __future__ import annotations

from dataclasses import dataclass

from .field_water import FieldWater, rising
from .parts import points_of

__all__ = ["Boundary", "SeepageState", "SeepageStates", "mirror", "plain", "read"]

#: What a part of the border may have; the value of the last two is true.
KINDS = ("head", "pressure_head", "reservoir", "inflow", "seepage_face", "closed")


@dataclass(frozen=True)
class Boundary:
    """A part of the border, by the name of a `wall` or a `line` of points (x, y) [m], and what it has: `kind`, one of
    :data:`KINDS`, and its `value` [m, m/s] (True of the last two).
    """

    wall: str | None
    line: tuple[tuple[float, float], ...] | None
    kind: str
    value: float | bool


@dataclass(frozen=True)
class SeepageState:
    """A state at a `time` [s]: level of a `reservoir` [m] on the free surface, or None; `rain` [m/s] on it;
    `boundaries`; `drained`: whether water has had time to flow (False: a rapid drawdown from the state before).
    """

    time: float
    reservoir: float | None
    rain: float
    boundaries: tuple[Boundary, ...]
    drained: bool


@dataclass(frozen=True)
class SeepageStates(FieldWater):
    """Steady seepage in each of the `states`, on a mesh with edges of `size` [m]; `conductivity`: (name, along, across,
    dip) [m/s, m/s, degrees] of each layer, from the bottom; `dry`: what dry ground conducts, by that of wet, or None.
    """

    size: float
    conductivity: tuple[tuple[str, float, float, float], ...]
    dry: float | None
    states: tuple[SeepageState, ...]


def read(raw, common, document) -> SeepageStates:
    """Of the data that meet the schema; ``common``: values of FieldWater."""
    keys = ("water", "seepage")
    rising(document, (*keys, "states"), raw["states"])
    states = []
    for k, one in enumerate(raw["states"]):
        where = (*keys, "states", k)
        if not one.get("drained", True) and k == 0:
            document.refuse(
                (*where, "drained"),
                "the first state has none before it from which a drawdown could begin",
                "give drained: false to a later state",
            )
        boundaries = [
            _boundary(b, document, (*where, "boundaries", i)) for i, b in enumerate(one.get("boundaries", ()))
        ]
        level = None if "reservoir" not in one else float(one["reservoir"])
        rain, drained = float(one.get("rain", 0.0)), one.get("drained", True)
        states.append(SeepageState(float(one["time"]), level, rain, tuple(boundaries), drained))
    dry = None if "dry" not in raw else float(raw["dry"])
    return SeepageStates(*common, float(raw["size"]), _conductivities(raw, document), dry, tuple(states))


def _conductivities(raw, document):
    keys, given = ("water", "seepage", "conductivity"), raw["conductivity"]
    names = [layer["name"] for layer in document.data["layers"]]
    if not isinstance(given, dict):
        return tuple((name, float(given), float(given), 0.0) for name in names)
    for name in given:
        if name not in names:
            document.refuse((*keys, name), f"no layer is called {name!r}", f"give one of {', '.join(names)}")
    for name in names:
        if name not in given:
            document.refuse(
                keys, f"no conductivity is given for the layer {name}", "give one for each layer, or one number for all"
            )
    found = []
    for name in names:
        one = given[name]
        if isinstance(one, dict):
            found.append((name, float(one["along"]), float(one["across"]), float(one.get("dip", 0.0))))
        else:
            found.append((name, float(one), float(one), 0.0))
    return tuple(found)


def _boundary(raw, document, keys):
    if ("wall" in raw) == ("line" in raw):
        document.refuse(
            keys,
            f"has {'both' if 'wall' in raw else 'neither'} `wall` {'and' if 'wall' in raw else 'nor'} `line`",
            "give the name of a wall, or a line of points on the layers' border",
        )
    kinds = [kind for kind in KINDS if kind in raw]
    if len(kinds) != 1:
        document.refuse(
            keys, f"has {' and '.join(kinds) or 'nothing that happens there'}", f"give one of {', '.join(KINDS)}"
        )
    names = [wall["name"] for wall in document.data["walls"]]
    if "wall" in raw and raw["wall"] not in names:
        document.refuse((*keys, "wall"), f"no wall is called {raw['wall']!r}", f"give one of {', '.join(names)}")
    kind = kinds[0]
    value = raw[kind]
    if isinstance(value, bool) and not value:
        document.refuse((*keys, kind), "false says nothing", f"give {kind}: true, or another kind")
    line = points_of(raw["line"]) if "line" in raw else None
    return Boundary(raw.get("wall"), line, kind, value if isinstance(value, bool) else float(value))


def plain(water) -> dict:
    """The data of a SeepageStates."""
    layers = {name: {"along": a, "across": b, "dip": dip} for name, a, b, dip in water.conductivity}
    return {
        "size": water.size,
        "conductivity": layers,
        **({} if water.dry is None else {"dry": water.dry}),
        "states": [
            {
                "time": one.time,
                **({} if one.reservoir is None else {"reservoir": one.reservoir}),
                "rain": one.rain,
                "drained": one.drained,
                "boundaries": [
                    {"wall": b.wall, b.kind: b.value}
                    if b.wall is not None
                    else {"line": [list(p) for p in b.line], b.kind: b.value}
                    for b in one.boundaries
                ],
            }
            for one in water.states
        ],
    }


def mirror(raw) -> None:
    """Mirrors the plain data of a seepage."""
    for state in raw["states"]:
        for one in state.get("boundaries", ()):
            if "line" in one:
                one["line"] = [[0.0 - x, y] for x, y in reversed(one["line"])]
    if isinstance(raw["conductivity"], dict):
        for one in raw["conductivity"].values():
            if isinstance(one, dict) and "dip" in one:
                one["dip"] = 0.0 - one["dip"]
