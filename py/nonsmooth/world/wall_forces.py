"""Forces of the disks on the walls: their means over some steps, and the peaks, at a cost that no step notices."""

from __future__ import annotations

import math

from yade import O
from yade.minieigenHP import Vector3
from yade.wrapper import Arc, WallForceEngine

__all__ = ["WallForces"]

RIGHT, UP = Vector3(1, 0, 0), Vector3(0, 1, 0)


class WallForces:
    """``walls``: {name: ids of its pieces}, segments or arcs, which do not move; their forces [N/m] are summed up by
    engines at the end of O.engines, and those that a loaded scene has go on. ``period``: only steps after which O.iter
    is a multiple of it count."""

    def __init__(self, walls, period=1):
        there = {tuple(e.ids): e for e in O.engines if isinstance(e, WallForceEngine)}
        self._engines = {
            name: there.get(tuple(ids)) or WallForceEngine(ids=list(ids), along=_along(ids), period=period)
            for name, ids in walls.items()
        }
        O.engines = O.engines + [e for ids, e in zip(walls.values(), self._engines.values()) if tuple(ids) not in there]

    def forget(self):
        """Begins anew."""
        for engine in self._engines.values():
            engine.forget()

    def take(self):
        """Means over the time since the last call, and the largest normal force [N/m]: {name: (normal, positive into
        the wall; shear along its direction; peak)}.
        """
        return {name: engine.take() for name, engine in self._engines.items()}


def _along(ids):
    """The directions of a wall's pieces, of an arc that of its chord, counter-clockwise; those in one line have the
    same to the last bit, so that their forces are added before anything else.
    """
    ways, last = [], None
    for i in ids:
        along = O.bodies[i].state.ori * (UP if isinstance(O.bodies[i].shape, Arc) else RIGHT)
        angle = math.atan2(along[1], along[0])
        if last is None or abs(angle - last) > 1e-9:
            way, last = Vector3(along[0], along[1], 0), angle
        ways.append(way)
    return ways
