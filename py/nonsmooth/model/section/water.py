"""Water of a section that is no table above a plane: below phreatic lines, with pressures from files, or seeping. Plain
data, and the checks that a schema cannot make. Needs no YADE.

Times are in s since t0, the end of the dry rest. Until then it is dry; from t0 to the first state's time the pressures
grow from 0 to those of this state, between two states they are linear in time, and after the last they stay.
"""

from __future__ import annotations

import hashlib
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .. import geometry
from . import seepage, water_release
from .field_water import FieldWater, rising
from .parts import points_of

__all__ = [
    "FieldFiles",
    "FieldWater",
    "KINDS",
    "PhreaticLines",
    "check",
    "check_end",
    "complete",
    "kind_of",
    "mirror",
    "plain",
    "read",
]

#: Keys below ``water``, of which a section has one, and those that go with each.
KINDS = {
    "table": ("plane", "table", "pressure_gradient"),
    "phreatic": ("phreatic",),
    "field": ("field",),
    "seepage": ("seepage",),
}


@dataclass(frozen=True)
class PhreaticLines(FieldWater):
    """Water below phreatic lines: `lines`, (time [s], points (x, y) [m] with rising x) of each state, between which
    heights are linear in time; `flow`: "sideways", p = γ_w (Y − y) below the height Y(x), or "along" the line, p = γ_w
    (Y − y) cos² α of its slope α.
    """

    lines: tuple[tuple[float, tuple[tuple[float, float], ...]], ...]
    flow: str


@dataclass(frozen=True)
class FieldFiles(FieldWater):
    """Pressures of files: `files`, one with all its times or one for each of the `times` [s], None for the file's own;
    `name` of the pressures in them; `scale`: lengths and pressures of the files are taken times this, and their own
    times `stretch`; `mirrored`: with left and right exchanged; `digests`: SHA-256 (hex) of the files.
    """

    files: tuple[str, ...]
    times: tuple[float, ...] | None
    name: str
    scale: float
    stretch: float
    mirrored: bool
    digests: tuple[str, ...]


def complete(document) -> None:
    """Fills in what other keys follow from when a section is mirrored or made larger, and where files are: paths of a
    section file are those from its own folder.
    """
    raw = document.data.get("water", {}).get("field")
    if raw is None:
        return
    for one in (raw, *raw.get("states", ())):
        if "file" in one:
            one["file"] = document.beside(one["file"])
    for name, value in (("scale", 1.0), ("stretch", 1.0), ("mirrored", False)):
        raw.setdefault(name, value)


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
        water_release.read(raw, document),
    )
    if "seepage" in raw:
        return seepage.read(raw["seepage"], common, document)
    return _phreatic(raw["phreatic"], common, document) if "phreatic" in raw else _files(raw["field"], common, document)


def plain(water) -> dict:
    """The keys and values of a section file that give this FieldWater."""
    common = {
        "unit_weight": water.unit_weight,
        "volume": water.volume,
        "outside": water.outside,
        "release_distance": water.release_distance,
        **water_release.plain(water.release),
    }
    if isinstance(water, PhreaticLines):
        lines = [{"time": time, "points": [list(p) for p in points]} for time, points in water.lines]
        return {"phreatic": {"lines": lines, "flow": water.flow}} | common
    if isinstance(water, seepage.SeepageStates):
        return {"seepage": seepage.plain(water)} | common
    files = [{"file": file, "sha256": digest} for file, digest in zip(water.files, water.digests)]
    if water.times is None:
        field = files[0]
    else:
        field = {"states": [{"time": time, **one} for time, one in zip(water.times, files)]}
    numbers = {"name": water.name, "scale": water.scale, "stretch": water.stretch, "mirrored": water.mirrored}
    return {"field": field | numbers} | common


def mirror(raw) -> None:
    """Mirrors the plain data of a section's water that is no table."""
    for line in raw.get("phreatic", {}).get("lines", ()):
        line["points"] = [[0.0 - x, y] for x, y in reversed(line["points"])]
    if "field" in raw:
        raw["field"]["mirrored"] = not raw["field"].get("mirrored", False)
    if "seepage" in raw:
        seepage.mirror(raw["seepage"])


def check(section, document) -> None:
    """Raise SectionError for water that does not fit the Section: lines that end within its layers, or that rise above
    the ground and are not level there.
    """
    if isinstance(section.water, PhreaticLines):
        _check_lines(section, document)


def check_end(section, document) -> None:
    """Raises SectionError where a section's run ends before its water comes to its last state, or its table to its last
    point.
    """
    raw, stages = document.data["water"], section.stages
    if "table" in raw:
        keys, entries = ("table", "points"), raw["table"].get("points", ())
        last = entries[-1][0] if entries else 0.0
    else:
        kind = kind_of(document)
        keys = (kind, "lines" if kind == "phreatic" else "states")
        entries = raw[kind].get(keys[1], ())
        last = entries[-1]["time"] if entries else 0.0
    longest = stages.longest
    if last > longest:
        document.refuse(
            ("water", *keys, len(entries) - 1),
            f"{last:g} s after t0 is no time of the run, which ends {longest:g} s after t0 at the latest",
            f"give stages.end.time of {math.ceil(stages.dry + last)} s and more",
        )


def _phreatic(raw, common, document):
    keys = ("water", "phreatic", "lines")
    rising(document, keys, raw["lines"])
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


def _files(raw, common, document):
    keys = ("water", "field")
    if ("file" in raw) == ("states" in raw):
        document.refuse(
            keys,
            f"has {'both' if 'file' in raw else 'neither'} `file` {'and' if 'file' in raw else 'nor'} `states`",
            "give one file with all its times, or states: [{time: s, file: PATH}, ...]",
        )
    entries = raw.get("states", [raw])
    if "states" in raw:
        rising(document, (*keys, "states"), entries)
    digests = []
    for k, one in enumerate(entries):
        where = (*keys, "states", k, "file") if "states" in raw else (*keys, "file")
        try:
            digests.append(hashlib.sha256(Path(one["file"]).read_bytes()).hexdigest())
        except OSError as error:
            document.refuse(
                where,
                f"{one['file']} cannot be read ({error.strerror or error})",
                "give an HDF5 file, or one that meshio reads; paths of a section file begin at its folder",
            )
        if one.get("sha256", digests[-1]) != digests[-1]:
            document.refuse(
                (*where[:-1], "sha256"),
                f"{one['file']} has the checksum {digests[-1]}",
                "give the file that was meant, or leave `sha256` out",
            )
    return FieldFiles(
        *common,
        tuple(one["file"] for one in entries),
        tuple(float(one["time"]) for one in entries) if "states" in raw else None,
        raw.get("name", "pressure"),
        float(raw["scale"]),
        float(raw["stretch"]),
        raw["mirrored"],
        tuple(digests),
    )


def _check_lines(section, document):
    reach = np.concatenate([layer.points[:, 0] for layer in section.layers])
    for k, (time, points) in enumerate(section.water.lines):
        keys, line = ("water", "phreatic", "lines", k, "points"), np.array(points)
        low, high = line[0, 0] - section.tolerance, line[-1, 0] + section.tolerance
        if section.water.outside == "refuse" and not (low <= reach.min() and reach.max() <= high):
            document.refuse(
                keys,
                f"the line at t = {time:g} s goes from x = {line[0, 0]:g} to x = {line[-1, 0]:g} m, and the layers "
                f"from {reach.min():g} to {reach.max():g} m",
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
