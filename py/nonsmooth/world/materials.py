"""YADE's materials of rigid contacts with the strengths of a section.Material."""

from __future__ import annotations

import math

from yade.wrapper import NscdMat, SlipSurfaceMat, SlipWeakeningMat

from ..system import checks
from .error import SceneError

__all__ = ["material", "set_strengths", "wall_material"]

_strengths = checks.takes(
    SceneError,
    m=checks.has(
        "density friction rolling_friction tensile_strength restitution slip_weakening slip_law",
        "give a section.Material; a script makes its own by NscdMat(...) or SlipWeakeningMat(...)",
    ),
)


@_strengths
def material(m, kind=NscdMat, **others):
    """A material with the strengths of the section.Material ``m``, not yet in the scene.

    ``kind``: NscdMat or a class derived from it; ``others``: further attributes, or other values. A wall may have no
    density; it then gets a rock's.
    """
    values = dict(
        density=m.density or 2500.0,
        **_strengths_of(m),
        bondEllipseNormal=m.bond_ellipse[0],
        bondEllipseTangential=m.bond_ellipse[1],
        bondCreationDistance=m.bond_creation_distance,
        bondsClose=m.bonds_close,
        restitution=m.restitution,
    )
    return kind(**{**values, **others})


@_strengths
def wall_material(m, **others):
    """The material of a wall, whose strengths alone rule contacts with it; not yet in the scene.

    ``m``: a section.Material; with ``m.slip_weakening`` a SlipWeakeningMat, with ``m.slip_law`` a SlipSurfaceMat, and
    bonds with disks of any layer if ``m.bonded``.
    """
    options = dict(wall=True, bondsToAll=m.bonded, layer=-1)
    if m.slip_law is not None:  # which says what friction is
        law = m.slip_law.make()
        friction = dict(frictionAngle=math.atan(law.friction()), residualFrictionAngle=-1.0)
        options |= dict(law=law, cellLength=m.slip_law.cell_length)
        return material(m, SlipSurfaceMat, **{**options, **friction, **others})
    weak = m.slip_weakening
    if weak is None:
        return material(m, **{**options, **others})
    options |= dict(criticalSlip=weak.critical_slip, weakening=weak.law, **_weakened_of(weak))
    return material(m, SlipWeakeningMat, **{**options, **others})


def _strengths_of(m):
    """Strengths of a section.Material as an NscdMat has them: {attribute: value}."""
    return dict(
        tensileStrength=m.tensile_strength,
        residualTensileStrength=m.residual_tensile_strength,
        frictionAngle=math.atan(m.friction),
        residualFrictionAngle=math.atan(m.residual_friction),
        rollingFriction=m.rolling_friction,
        residualRollingFriction=m.residual_rolling_friction,
    )


def _weakened_of(weak):
    """The same of what slip leaves, as a SlipWeakeningMat has it."""
    return dict(weakenedFrictionAngle=math.atan(weak.friction), weakenedTensileStrength=weak.tensile_strength)


@_strengths
def set_strengths(m, present):
    """Gives an NscdMat of the scene, ``present``, the strengths of the section.Material ``m``; contacts that exist take
    them up by ``ContactDynamicsEngine.updateStrengths()``.
    """
    values = _strengths_of(m)
    if isinstance(present, SlipSurfaceMat):
        del values["frictionAngle"], values["residualFrictionAngle"]  # its law's
    if m.slip_weakening is not None and isinstance(present, SlipWeakeningMat):
        values |= _weakened_of(m.slip_weakening)
    for name, value in values.items():
        setattr(present, name, value)
