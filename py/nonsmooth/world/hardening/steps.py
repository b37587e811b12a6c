"""The time step of rigid contacts, from sizes and speeds: stiffness has no say in it."""

from __future__ import annotations

import math

import numpy as np

from .error import HardenError

__all__ = ["hard_step"]

_WAY = 0.1  # diameters of the smallest sphere that a body goes in a step


def hard_step(radii, speeds, gravity, low, high, soft_step):
    """A time step [s] in which no sphere goes farther than a tenth of the smallest diameter.

    ``radii`` (n,) [m]: of the spheres that move, or will come; ``speeds``: of all bodies [m/s], those of walls that turn
    at their rims; ``gravity`` (3,) [m/s²]; ``low``, ``high``: corners of the scene [m]. A sphere is taken to fall as far
    as the scene is high. Where nothing moves and nothing falls, the step is ten times the soft one, ``soft_step`` [s].
    Raises HardenError where there is no sphere.
    """
    if not len(radii):
        raise HardenError(
            "no sphere of the scene can move, so that no step can be chosen: give harden(O, step=...) [s]"
        )
    g = float(np.linalg.norm(gravity))
    diameter = 2 * float(np.min(radii))
    fall = 0.0
    if g > 0:
        down = np.asarray(gravity) / g
        corners = np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
        fall = float(np.ptp(corners @ down))
    fastest = max([math.sqrt(2 * g * fall), *map(float, speeds)])
    if g > 0:  # what lies still is pressed by gravity all the same
        fastest = max(fastest, math.sqrt(g * diameter))
    if not fastest > 0:
        return 10 * soft_step
    return _WAY * diameter / fastest
