"""Taking disks out of the scene."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from yade import O
from yade.wrapper import ContactDynamicsEngine, NewtonIntegrator

__all__ = ["Taken", "take_out"]


class Taken(NamedTuple):
    """What disks had when they were taken out, arrays (n,): ``mass`` [kg/m], their ``kinetic`` energy, with that of
    their rotation, and ``potential`` energy, 0 at the origin [J/m].
    """

    mass: np.ndarray
    kinetic: np.ndarray
    potential: np.ndarray


def take_out(ids) -> Taken:
    """Erases disks by their ``ids`` from O.bodies, with all contacts and bonds that they have, which do not count as
    broken; what bodies are left keep place, velocity and what their other contacts bear. Between two steps.
    """
    # contacts may be known in arrays alone, and YADE erases those that it has
    ContactDynamicsEngine().view()
    gravity = next(e.gravity for e in O.engines if isinstance(e, NewtonIntegrator))
    rows = []
    for k in map(int, ids):
        s = O.bodies[k].state
        kinetic = 0.5 * (s.mass * (s.vel[0] ** 2 + s.vel[1] ** 2) + s.inertia[2] * s.angVel[2] ** 2)
        rows.append((s.mass, kinetic, -s.mass * (gravity[0] * s.pos[0] + gravity[1] * s.pos[1])))
        O.bodies.erase(k)
    return Taken(*np.array(rows, float).reshape(-1, 3).T)
