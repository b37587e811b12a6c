"""Forces of the disks on the walls: their means over some steps, and the peaks, at a cost that no step notices."""

from __future__ import annotations

import math

from yade import O
from yade._utils import sumForces
from yade.minieigenHP import Vector3

__all__ = ["WallForces"]

RIGHT, UP = Vector3(1, 0, 0), Vector3(0, 1, 0)


class WallForces:
    """``walls``: {name: ids of its pieces}, which do not move. Call :meth:`add` after every step."""

    def __init__(self, walls):
        self._straight = {}  # name -> [(ids of the pieces that go one way, their direction)]; YADE sums over ids in C++
        for name, ids in walls.items():
            groups = []
            for i in ids:
                along = O.bodies[i].state.ori * RIGHT
                angle = math.atan2(along[1], along[0])
                if not groups or abs(angle - groups[-1][2]) > 1e-9:
                    groups.append(([], (along[0], along[1]), angle))
                groups[-1][0].append(i)
            self._straight[name] = [(members, way) for members, way, _ in groups]
        self._begin()

    def _begin(self):
        self._time = 0.0
        self._sums = {name: [0.0, 0.0] for name in self._straight}
        self._peaks = dict.fromkeys(self._straight, -math.inf)

    def now(self):
        """Force on each wall in the last step [N/m]: {name: (normal, positive into the wall; along its direction)}."""
        forces = {}
        for name, groups in self._straight.items():
            normal = shear = 0.0
            for ids, (c, s) in groups:
                x, y = sumForces(ids, RIGHT), sumForces(ids, UP)
                normal += x * s - y * c
                shear += x * c + y * s
            forces[name] = (normal, shear)
        return forces

    def add(self, seconds):
        """Counts the last step, which took so long [s]."""
        self._time += seconds
        for name, (normal, shear) in self.now().items():
            sums = self._sums[name]
            sums[0] += normal * seconds
            sums[1] += shear * seconds
            if normal > self._peaks[name]:
                self._peaks[name] = normal

    def take(self):
        """Means over the time added up, and the largest normal force [N/m]: {name: (normal, shear, peak)}; begins anew."""
        found = {name: (sums[0] / self._time, sums[1] / self._time, self._peaks[name]) for name, sums in self._sums.items()}
        self._begin()
        return found
