"""Water of a section that is no table above a plane: below phreatic lines. Plain data, and the checks that a schema
cannot make. Needs no YADE.

Times are in s since t0, the end of the dry rest. Until then it is dry; from t0 to the first state's time the pressures
grow from 0 to those of this state, between two states they are linear in time, and after the last they stay.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from .. import geometry
from .parts import points_of

__all__ = ["FieldWater", "KINDS", "PhreaticLines", "check", "kind_of", "read"]

#: Keys below ``water``, of which a section has one, and those that go with each.
KINDS = {"table": ("plane", "table", "pressure_gradient"), "phreatic": ("phreatic",)}


@dataclass(frozen=True)
class FieldWater:
    """Water with a pressure of its own at each place: `unit_weight` γ_w [N/m³]; `volume`: "disk" or "bulk", on which
    −∇p acts; `release_distance`: as of :class:`.parts.Water`; `outside`: "refuse" a field that does not cover the
    layers, or take it for "dry" there.
    """

    unit_weight: float
    volume: str
    release_distance: str | float
    outside: str

    wall: ClassVar[None] = None  # of a plane, as of parts.Water
    rate: ClassVar[float] = 0.0


@dataclass(frozen=True)
class PhreaticLines(FieldWater):
    """Water below phreatic lines: `lines`, (time [s], points (x, y) [m] with rising x) of each state, between which
    heights are linear in time; `flow`: "sideways", p = γ_w (Y − y) below the height Y(x), or "along" the line, p = γ_w
    (Y − y) cos² α of its slope α.
    """

    lines: tuple[tuple[float, tuple[tuple[float, float], ...]], ...]
    flow: str


def kind_of(document) -> str:
    """The kind of a section's water, one of KINDS. Raises SectionError for keys of two kinds."""
    water = document.data["water"]
    given = [kind for kind, keys in KINDS.items() if any(key in water for key in keys)]
    if len(given) > 1:
        own = [next(key for key in KINDS[kind] if key in water) for kind in given]
        document.refuse(
            ("water", own[-1]),
            f"{' and '.join(own)} are given, which are different kinds of water",
            f"keep one: plane with table, {', '.join(kind for kind in KINDS if kind != 'table')}",
        )
    if given[0] != "table" and "hold" in document.data.get("stages", {}).get("water", {}):
        document.refuse(
            ("stages", "water", "hold"),
            f"a water table can be held, and this water is water.{given[0]}",
            f"leave `stages.water` out: the states of water.{given[0]} come at their times, and the last one stays",
        )
    return given[0]


def read(document) -> FieldWater:
    """The FieldWater of a document that meets the schema and has defaults filled in; checked but for what needs the
    whole section (:func:`check`).
    """
    raw = document.data["water"]
    common = (
        float(raw["unit_weight"]),
        raw["volume"],
        raw["release_distance"] if isinstance(raw["release_distance"], str) else float(raw["release_distance"]),
        raw.get("outside", "refuse"),
    )
    return _phreatic(raw["phreatic"], common, document)


def check(section, document) -> None:
    """Raise SectionError for water that does not fit the Section: lines that end within its layers, or that rise above
    the ground and are not level there.
    """
    if isinstance(section.water, PhreaticLines):
        _check_lines(section, document)


def _rising(document, keys, entries) -> None:
    """Raise SectionError for the first of `entries`, a list below the key path `keys`, whose time does not follow the
    one before.
    """
    for k, (before, after) in enumerate(zip(entries, entries[1:]), 1):
        if after["time"] <= before["time"]:
            document.refuse(
                (*keys, k, "time"),
                f"the time {after['time']:g} s does not follow {before['time']:g} s",
                "give the times in rising order",
            )


def _phreatic(raw, common, document):
    keys = ("water", "phreatic", "lines")
    _rising(document, keys, raw["lines"])
    for k, line in enumerate(raw["lines"]):
        for i, (a, b) in enumerate(zip(line["points"], line["points"][1:]), 1):
            if b[0] <= a[0]:
                document.refuse(
                    (*keys, k, "points", i),
                    f"the line goes from x = {a[0]:g} to x = {b[0]:g} m",
                    "give points with rising x, so that each x has one height",
                )
    lines = tuple((float(one["time"]), points_of(one["points"])) for one in raw["lines"])
    return PhreaticLines(*common, lines, raw.get("flow", "sideways"))


def _check_lines(section, document):
    reach = np.concatenate([layer.points[:, 0] for layer in section.layers])
    for k, (time, points) in enumerate(section.water.lines):
        keys, line = ("water", "phreatic", "lines", k, "points"), np.array(points)
        low, high = line[0, 0] - section.tolerance, line[-1, 0] + section.tolerance
        if section.water.outside == "refuse" and not (low <= reach.min() and reach.max() <= high):
            document.refuse(
                keys,
                f"the line at t = {time:g} s goes from x = {line[0, 0]:g} to x = {line[-1, 0]:g} m, and the layers from "
                f"{reach.min():g} to {reach.max():g} m",
                "give a line that spans the layers, or water.outside: dry",
            )
        above = _above_ground(section, line)
        if above is not None:
            (x, y), ground = above
            document.refuse(
                keys,
                f"at t = {time:g} s and x = {x:.6g} m the line lies at y = {y:.6g} m, above the ground at {ground:.6g} "
                "m, and is not level there",
                "let it be level where open water stands, with a point where the water's edge meets the ground, and "
                "run below the ground elsewhere",
            )


def _above_ground(section, line):
    """A place (x, y) where a phreatic line (n, 2) lies more than a largest disk above the ground and is not level, and
    the ground's height there; None where there is no such place.
    """
    layers = geometry.pieces([np.vstack((layer.points, layer.points[:1])) for layer in section.layers])
    walls = geometry.pieces([wall.points for wall in section.walls])
    vertices = np.concatenate([part[:, 0] for part in (*layers, *walls)])
    for a, b in zip(line[:-1], line[1:]):
        if abs(b[1] - a[1]) <= section.tolerance:
            continue
        cuts = np.unique(np.clip(np.concatenate((vertices, (a[0], b[0]))), a[0], b[0]))
        for x in np.sort(np.concatenate((cuts, 0.5 * (cuts[1:] + cuts[:-1])))):
            y = a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0])
            ground = _height(layers, x)
            ground = _height(walls, x) if np.isnan(ground) else ground
            if y > ground + section.largest:
                return (x, y), ground
    return None


def _height(pieces, x):
    """The greatest height [m] of segments (starts, ends) at x [m]; NaN where none is."""
    a, b = pieces
    low, high = np.minimum(a[:, 0], b[:, 0]), np.maximum(a[:, 0], b[:, 0])
    there = (low <= x) & (x <= high)
    if not there.any():
        return np.nan
    a, b, steep = a[there], b[there], (high - low)[there] > 0
    share = np.where(steep, (x - a[:, 0]) / np.where(steep, b[:, 0] - a[:, 0], 1.0), 0.0)
    return float(np.where(steep, a[:, 1] + share * (b[:, 1] - a[:, 1]), np.maximum(a[:, 1], b[:, 1])).max())
