"""The walls of a slope by their roles: which way it falls, where its foot is, where water stands above which plane."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..errors import UserError
from ..model import stacks
from ..model.roles import chord

__all__ = ["Ground", "GroundError", "WallLine", "ground_of"]


class GroundError(UserError, ValueError):
    """Walls that are none; the message says which, and what is needed."""


class WallLine(NamedTuple):
    """``vertices``: (n, 2) [m]; ``role``: see :mod:`.roles`, None where nobody said; ``buried``: an interface between
    layers, which is no wall.
    """

    name: str
    vertices: np.ndarray
    role: str | None = None
    buried: bool = False


class Ground:
    """Walls, and what follows from them.

    ``walls``: list of WallLine; ``side``: 1 for a slope that falls to the right, −1 to the left; ``water``: (points (n,
    2) [m], unit normal) of the plane from which water is measured, or None; ``layers``: their names, empty where they
    have none; ``mass``: numbers of the layers that are neither bed nor obstacle, None: all are mass; ``base``: name of
    the wall from which water is measured, None where it is measured from a plane of its own; ``weakening``: {number:
    WallLine} of those that weaken with slip, by their column of :attr:`.records.Snapshot.weakened`.
    """

    def __init__(self, walls, side, water, layers=(), mass=None, base=None, weakening=None):
        self.walls, self.side, self._water, self.layers, self.mass, self.base = walls, side, water, layers, mass, base
        self.weakening = weakening or {}

    def layer(self, number):
        """What a layer is called."""
        return self.layers[number] if number < len(self.layers) else f"layer {number + 1}"

    def of_role(self, *wanted):
        """The walls that have one of these roles."""
        return [wall for wall in self.walls if wall.role in wanted]

    def name(self, role):
        """The names of the walls of a role, joined; empty where there are none."""
        return ", ".join(wall.name for wall in self.of_role(role))

    @property
    def stacked(self):
        """Names of all slip surfaces where some lie one above another, see :mod:`..stacks`; empty where they lie side
        by side.
        """
        slip = self.of_role("slip")
        return tuple(wall.name for wall in slip) if any(stacks.levels([wall.vertices for wall in slip])) else ()

    @property
    def foot(self):
        """The end (x, y) [m] of the slip surfaces down the slope; the origin without one."""
        slip = self.of_role("slip")
        if not slip:
            return np.zeros(2)
        points = np.vstack([wall.vertices for wall in slip])
        return points[np.argmax(self.side * points[:, 0])]

    def beyond(self, x0, x1):
        """How the ground goes on from the outermost ends of the walls to the limits ``x0`` and ``x1`` [m] of a picture:
        pieces [(2, 2)] from left to right, none where walls reach that far. As the wall does where it is less steep
        than 45°, else level."""
        open_walls = [wall.vertices for wall in self.walls if not wall.buried]
        pieces = []
        for sense, limit in ((-1, x0), (1, x1)) if open_walls else ():
            line, place = max(
                ((line, k) for line in open_walls for k in range(len(line))),
                key=lambda one: (sense * one[0][one[1], 0], one[0][one[1], 1]),
            )
            end = line[place]
            if sense * (limit - end[0]) <= 0:
                continue
            inner = [line[k] for k in (place - 1, place + 1) if 0 <= k < len(line)]
            slopes = [(end[1] - y) / (end[0] - x) for x, y in inner if x != end[0]]
            slope = slopes[0] if slopes and abs(slopes[0]) < 1 else 0.0
            pieces.append(np.array(sorted([[limit, end[1] + slope * (limit - end[0])], end.tolist()])))
        return pieces

    def surface(self, x):
        """Height [m] of the ground at places ``x`` [m], an array (n,) that rises: that of the highest wall."""
        lines = [wall.vertices for wall in self.walls if not wall.buried] + self.beyond(x[0], x[-1])
        height = np.full(len(x), -np.inf)
        for line in lines:
            for a, b in zip(line[:-1], line[1:]):
                (xa, ya), (xb, yb) = sorted([a.tolist(), b.tolist()])
                on = (x >= xa) & (x <= xb)
                height[on] = np.maximum(height[on], np.interp(x[on], [xa, xb], [ya, yb]))
        return height

    @property
    def table_slope(self):
        """Rise of the water table over its way in x, where it is a plane of its own, as that of a reservoir, which is
        0; None where it follows a wall, or there is none.
        """
        return None if self._water is None or self.base is not None else -self._water[1][0] / self._water[1][1]

    def water_points(self, height):
        """Vertices (n, 2) [m] of a water table ``height`` [m] above its plane, along the plane's normal; None where no
        plane is known.
        """
        if self._water is None:
            return None
        points, normal = self._water
        return points + height * normal


def _plane(slip):
    """Points and unit normal of the first slip surface, None where there is none."""
    if not slip:
        return None
    points = slip[0].vertices
    way = points[-1] - points[0]
    normal = np.array([-way[1], way[0]]) / np.hypot(*way)
    return points, normal if normal[1] > 0 else -normal


def ground_of(walls):
    """The Ground of a Section; or of what has ``walls``, or of a list of walls: (name, vertices), (name, vertices,
    role), or objects with these attributes.

    Raises GroundError for a wall of less than two points.
    """
    if isinstance(walls, Ground):
        return walls
    found = []
    for wall in getattr(walls, "walls", walls):
        name, vertices, role = (
            (wall.name, wall.vertices, getattr(wall, "role", None)) if hasattr(wall, "vertices") else (*wall, None)[:3]
        )
        vertices = np.asarray(vertices, dtype=float)
        if vertices.ndim != 2 or vertices.shape[1] != 2 or len(vertices) < 2:
            raise GroundError(f"wall {name} has vertices of shape {vertices.shape}; give at least two points (x, y)")
        found.append(WallLine(str(name), vertices, role))
    if hasattr(walls, "interfaces"):
        found += [
            WallLine(i.name, line, i.role, buried=True) for i in walls.interfaces if len(line := walls.line_of(i))
        ]
    layers = [layer for layer in getattr(walls, "layers", ()) if hasattr(layer, "role")]
    mass = [k for k, layer in enumerate(layers) if layer.role == "mass"]
    slip = [wall for wall in found if wall.role == "slip"]
    side = getattr(walls, "side", -1.0 if slip and chord([wall.vertices for wall in slip])[0] < 0 else 1.0)
    water = _water_of(walls) if hasattr(walls, "water") else _plane(slip)
    return Ground(
        found,
        side,
        water,
        [layer.name for layer in layers],
        mass if len(mass) < len(layers) else None,
        walls.water.wall if getattr(walls, "water", None) else slip[0].name if slip else None,
        {k: wall for k, one in enumerate(getattr(walls, "weakening", ())) for wall in found if wall.name == one.name},
    )


def _water_of(section):
    """The water's plane of a Section, over its wall or over the layers; None where it has no water table."""
    water = section.water_table
    if water is None:
        return None
    normal = np.array(water.normal)
    if water.wall is not None:
        return section.wall(water.wall).points, normal
    reach = np.array([p[0] for layer in section.layers for p in layer.vertices])
    x = np.array([reach.min(), reach.max()])
    return np.column_stack([x, water.point[1] - (x - water.point[0]) * normal[0] / normal[1]]), normal
