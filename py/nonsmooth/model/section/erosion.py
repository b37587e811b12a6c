"""Windows of a section that move in time: disks whose centres come into one are taken out of the slope, as a river
takes them from its foot, or an excavator. Needs no YADE.

Times count from t0, when the dry rest has ended.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from shapely.geometry import MultiPoint, Polygon
from shapely.ops import unary_union

from .. import geometry, scales
from .parts import points_of

__all__ = ["Window", "notes", "plain", "windows"]

MOTION, NEVER = "motion", "never"
DOWN = (0.0, -1.0)


@dataclass(frozen=True)
class Window:
    """A polygon that takes out the disks of some layers whose centres are inside, from ``begin`` to ``end`` [s since
    t0]; where both are one time, once.

    ``vertices``: where it is at its begin, tuple of (x, y) [m]; ``velocity`` [m/s] from its begin on, or ``path``, its
    way from these vertices: tuple of (t [s since t0], x, y [m]), straight between them; ``opening`` [s]: in which it
    opens, from the side at which it begins in the ``direction``, at once where it is 0; ``layers``: names, none: all;
    ``hold``: "motion", it takes nothing while the slope moves, or "never".
    """

    name: str
    vertices: tuple[tuple[float, float], ...]
    begin: float
    end: float
    velocity: tuple[float, float] = (0.0, 0.0)
    path: tuple[tuple[float, float, float], ...] = ()
    opening: float = 0.0
    direction: tuple[float, float] = DOWN
    layers: tuple[str, ...] = ()
    hold: str = MOTION

    @property
    def moves(self) -> bool:
        """Whether its place depends on time."""
        return bool(self.path) or self.velocity != (0.0, 0.0)

    def way(self, time) -> tuple[float, float]:
        """How far it has come from its vertices at a ``time`` [s since t0]: (x, y) [m]."""
        if not self.path:
            gone = max(0.0, time - self.begin)
            return self.velocity[0] * gone, self.velocity[1] * gone
        t, x, y = np.transpose(self.path)
        return float(np.interp(time, t, x)), float(np.interp(time, t, y))

    def outline(self, time) -> np.ndarray:
        """Its vertices at a ``time`` [s since t0], (n, 2) [m]."""
        return np.array(self.vertices) + self.way(time)

    def open_share(self, time) -> float:
        """The part of its depth along the direction that is open at a ``time`` [s since t0], from 0 to 1."""
        return 1.0 if self.opening == 0 else min(1.0, max(0.0, (time - self.begin) / self.opening))

    def takes(self, x, y, time) -> np.ndarray:
        """Which points, arrays ``x``, ``y`` (n,) [m], lie in what is open at a ``time`` [s since t0], bool (n,)."""
        dx, dy = self.way(time)
        x, y = np.asarray(x, float) - dx, np.asarray(y, float) - dy
        inside, share = geometry.contains(Polygon(self.vertices), x, y), self.open_share(time)
        if share < 1:
            along, (low, high) = x * self.direction[0] + y * self.direction[1], self._depth(self.direction)
            inside &= along <= low + share * (high - low)
        return inside

    @property
    def swept(self):
        """A shapely shape that holds all places of the window."""
        inside = [t for t, *_ in self.path if self.begin < t < self.end]
        places = [self.outline(t) for t in (self.begin, *inside, self.end)]
        return unary_union([MultiPoint(np.vstack(two)).convex_hull for two in zip(places, places[1:])])

    def of_layers(self, section) -> np.ndarray:
        """Which layers of a Section it takes, bool (layers,)."""
        return np.array([not self.layers or layer.name in self.layers for layer in section.layers])

    def _depth(self, direction):
        along = np.array(self.vertices) @ direction
        return float(along.min()), float(along.max())


def plain(window: Window) -> dict:
    """The keys and values of a Window in a section file."""
    found = {
        "name": window.name,
        "vertices": [list(map(float, p)) for p in window.vertices],
        "begin": window.begin,
        "end": window.end,
        "hold": window.hold,
    }
    if window.path:
        found["path"] = [list(map(float, p)) for p in window.path]
    elif window.moves:
        found["velocity"] = list(map(float, window.velocity))
    if window.opening:
        found["opening"] = {"time": window.opening, "direction": list(map(float, window.direction))}
    if window.layers:
        found["layers"] = list(window.layers)
    return found


def notes(section) -> list[str]:
    """Sentences on windows of a Section which meet none of the layers that they take, wherever they come."""
    return [
        f"{section.source}: the window {window.name} meets no layer that it takes, and takes what comes to it alone"
        for window in section.erosion
        if not any(
            window.swept.intersects(layer.polygon)
            for layer, takes in zip(section.layers, window.of_layers(section))
            if takes
        )
    ]


def windows(section, document) -> tuple[Window, ...]:
    """The Windows of the data of a ``document``, which meet the schema, for the checked ``section`` without them.
    Raises SectionError at the first thing wrong with one.
    """
    found = []
    for i, raw in enumerate(document.data.get("erosion", ())):
        keys = ("erosion", i)
        if raw["name"] in [window.name for window in found]:
            document.refuse((*keys, "name"), f"{raw['name']!r} is taken", "give each window its own name")
        found.append(_window(raw, keys, section, document))
    return tuple(found)


def _window(raw, keys, section, document):
    def refuse(key, what, remedy):
        document.refuse((*keys, key), what, remedy)

    vertices = points_of(raw["vertices"])
    reason = geometry.invalid_reason(vertices)
    if reason:
        refuse("vertices", f"no simple polygon: {reason}", "list its vertices in order around it")
    begin, opening = float(raw["begin"]), float(raw.get("opening", {}).get("time", 0.0))
    end = float(raw.get("end", begin + opening))
    if end < begin:
        refuse("end", f"{end:g} s is before its begin, {begin:g} s", "give a later end, or none to take once")
    if opening > end - begin:
        opens = f"opens in {opening:g} s, and there are {end - begin:g} s from its begin to its end"
        refuse("opening", opens, "give a shorter `time`, or a later `end`")
    longest = section.stages.longest
    if begin >= longest:
        late = f"{begin:g} s after t0 is no time of the run, which ends {longest:g} s after t0 at the latest"
        refuse("begin", late, "begin earlier, or raise stages.end.time")
    for k, name in enumerate(raw.get("layers", ())):
        if name not in [layer.name for layer in section.layers] or name in raw["layers"][:k]:
            which = "no layer is called" if name not in raw["layers"][:k] else "named twice:"
            names = ", ".join(layer.name for layer in section.layers)
            refuse("layers", f"{which} {name!r}", f"give some of {names}, each once")
    made = Window(
        raw["name"],
        vertices,
        begin,
        end,
        tuple(map(float, raw.get("velocity", (0.0, 0.0)))),
        tuple(tuple(map(float, p)) for p in raw.get("path", ())),
        opening,
        _direction(raw, refuse),
        tuple(raw.get("layers", ())),
        raw.get("hold", MOTION),
    )
    _check_motion(made, raw, section, refuse)
    return made


def _direction(raw, refuse):
    x, y = map(float, raw.get("opening", {}).get("direction", DOWN))
    if (x, y) == (0.0, 0.0):
        refuse("opening", "its direction is zero", "give where it opens to, [0, -1] for from its top down")
    return x, y


def _check_motion(window, raw, section, refuse):
    if "velocity" in raw and "path" in raw:
        refuse("path", "is given beside a velocity", "keep one of the two")
    for before, after in zip(window.path, window.path[1:]):
        if after[0] <= before[0]:
            what = f"the time {after[0]:g} s does not follow {before[0]:g} s"
            refuse("path", what, "give the times in rising order")
    if not window.moves:
        return
    if window.end == window.begin:
        key = "path" if window.path else "velocity"
        refuse(key, "moves a window that takes once", "give its `end` [s since t0]")
    # what it jumps over between two looks at it, it does not take
    row = scales.of(section).row_seconds
    for (vx, vy), key in _velocities(window):
        speed = math.hypot(vx, vy)
        if not speed:
            continue
        low, high = window._depth((vx / speed, vy / speed))
        if speed * row > high - low:
            refuse(
                key,
                f"at {speed:.4g} m/s it goes {speed * row:.4g} m from one look at it to the next, {row:g} s later, "
                f"and is {high - low:.4g} m long in that direction, so that it jumps over disks",
                f"let it go {(high - low) / row:.3g} m/s at most, or make it longer",
            )


def _velocities(window):
    if not window.path:
        yield window.velocity, "velocity"
    for (t, x, y), (later, x1, y1) in zip(window.path, window.path[1:]):
        yield ((x1 - x) / (later - t), (y1 - y) / (later - t)), "path"
