"""Other strengths for a scene of soft contacts: of its materials, and of the contacts that exist."""

from __future__ import annotations

import math

from yade import O
from yade.wrapper import CohFrictPhys, FrictPhys, JCFpmPhys, NscdMat, WallPhys

from .. import materials
from .bonds import bonded, set_thresholds, weaken

__all__ = ["change"]


def change(world, pairs):
    """Gives all materials of the scene and its contacts other strengths; bonds and forces stay. ``world``: a
    :class:`.worlds.Soft`; ``pairs``: (material of the scene, section.Material), a list with all of its materials.

    A ductile bond that breaks has the residual strengths of before until :func:`.bonds.weaken` sees it.
    """
    equivalents = {}
    for present, m in pairs:
        if isinstance(present, NscdMat):
            materials.set_strengths(m, present)
            continue
        equivalents[present.id] = world.equivalent(m)
        for name, value in equivalents[present.id].attributes().items():
            setattr(present, name, value)
    loose = []
    for i in O.interactions:
        p, (a, b) = i.phys, (O.bodies[k] for k in (i.id1, i.id2))
        if isinstance(p, WallPhys):
            _set_wall(p, a.material if isinstance(a.material, NscdMat) else b.material)
        elif bonded(p):
            set_thresholds(equivalents[a.material.id], p, a.shape.radius + b.shape.radius)
        elif isinstance(p, (CohFrictPhys, JCFpmPhys)):
            loose.append(i)
        elif isinstance(p, FrictPhys):
            p.tangensOfFrictionAngle = math.tan(min(a.material.frictionAngle, b.material.frictionAngle))
    weaken(loose)


def _set_wall(p, wall):
    """Gives a contact with a wall the strengths of its NscdMat, as the functor that makes it does."""
    p.tensileForce = wall.tensileStrength * p.length
    p.friction, p.residualFriction = math.tan(wall.frictionAngle), math.tan(wall.residualFrictionAngle)
    p.rollingArm = wall.rollingFriction * p.length
    p.residualRollingArm = wall.residualRollingFriction * p.length
