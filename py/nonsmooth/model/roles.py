"""What the walls of a section are for, and which way its slope falls. Needs no YADE.

    slip       a slip surface: the mass may slide along it, and its slip is counted
    backstop   what the mass leans against at its foot
    ground     what the mass runs out over, and everything else
    obstacle   what stands in its way

A section file says so with ``role``. Where it does not:

* slip is the wall from which water is measured, and each whose strength falls with slip; where there is none, and no
  interface is a slip surface, the one along which the layers lie longest;
* backstop is each other wall that layers lie against and that faces upslope, by 30° or more;
* ground are the others.

The slope falls along the chords of its slip surfaces, each taken downwards and added up.
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np
from shapely.geometry import LineString

__all__ = ["ROLES", "assigned", "chord", "dip_of"]

ROLES = ("slip", "backstop", "ground", "obstacle")

FACES = 0.5  # sine of the angle by which a backstop faces upslope, at least
LEANS = 10.0  # tolerances of the section: a shorter share of the layers' border is a corner


def assigned(section):
    """The walls of a Section, each with its role: a tuple of the same length. Given roles stay."""
    given = {w.name: w.role for w in section.walls if w.role is not None}
    lean = {w.name: _leaning(section, w) for w in section.walls}
    length = {name: math.fsum(lengths) for name, lengths in lean.items()}
    free = [w for w in section.walls if w.role is None]
    slip = [
        w.name
        for w in free
        if section.materials[w.material].slip_weakening
        or section.materials[w.material].slip_law
        or (section.water and section.water.wall == w.name)
    ]
    if not slip and "slip" not in given.values() and not any(i.role == "slip" for i in section.interfaces) and free:
        slip = [max(free, key=lambda w: length[w.name]).name]
    surfaces = [w.points for w in section.walls if given.get(w.name) == "slip" or w.name in slip]
    down = chord([*surfaces, *(section.line_of(i) for i in section.interfaces if i.role == "slip")])
    backstops = [
        w.name
        for w in free
        if w.name not in slip
        and length[w.name] > LEANS * section.tolerance
        and _facing(w, lean[w.name], down) <= -FACES
    ]

    def role(name):
        return "slip" if name in slip else "backstop" if name in backstops else "ground"

    return tuple(dataclasses.replace(w, role=w.role or role(w.name)) for w in section.walls)


def chord(lines):
    """The vector (x, y) [m] along which polylines, each of shape (n, 2) [m], fall from end to end, added up; a level
    one goes to the side of those that fall, and where none does to the right.
    """
    ways = [points[-1] - points[0] for points in lines if len(points) > 1]
    side = -1.0 if sum(np.sign(-way[1]) * way[0] for way in ways) < 0 else 1.0
    total = np.zeros(2)
    for way in ways:
        total += -way if way[1] > 0 or (way[1] == 0 and side * way[0] < 0) else way
    return total


def dip_of(dx, dy):
    """Angle [degrees] below the horizontal, to the right, of a line along (dx, dy)."""
    return math.degrees(math.atan2(-dy, dx) if dx >= 0 else math.atan2(dy, -dx))


def _leaning(section, wall):
    """For each piece of a wall the length [m] along which the border of what slides runs on it."""
    rims = [layer.polygon.exterior for layer in section.layers if layer.role == "mass"]
    pieces = [LineString(ends).buffer(3 * section.tolerance) for ends in zip(wall.vertices, wall.vertices[1:])]
    return [math.fsum(rim.intersection(piece).length for rim in rims) for piece in pieces]


def _facing(wall, lean, down):
    """Mean of (unit normal, into the mass) · (unit vector along ``down``) over where the mass leans against a wall;
    disks are on the left of a wall.
    """
    way = np.diff(wall.points, axis=0)
    sines = (-way[:, 1] * down[0] + way[:, 0] * down[1]) / np.hypot(*way.T)
    return float(np.average(sines, weights=lean)) / (math.hypot(*down) or 1.0)
