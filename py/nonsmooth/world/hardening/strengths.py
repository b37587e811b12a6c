"""Strengths of rigid contacts from YADE's materials with springs.

A soft material says how strong a contact is, and how stiff. Strengths become those of an NscdMat, stiffnesses and
damping have no counterpart but restitution:

============================  =========================================================================================
soft                          rigid
============================  =========================================================================================
frictionAngle                 frictionAngle, with and without a bond
density                       density
ViscElMat.en                  restitution; of a functor's ``en`` too, where that is one number
ViscElMat.mR                  rolling friction mR/2: a torque mR R N with R half of ℓ
CohFrictMat.etaRoll, etaTwist rolling and twisting friction eta/2, where the material has momentRotationLaw
CohFrictMat.normalCohesion    tensile strength of a bond: c/π, a force c R² on the area π/4 ℓ² of two equal spheres; of
                              disks c R/2, a force c R² on ℓ, with the mean radius
young, poisson, kn, ks,       dropped
alphaKr, tc, damping
============================  =========================================================================================
"""

from __future__ import annotations

import math

from yade.wrapper import CohFrictMat, FrictMat, MatchMaker, NscdMat, ViscElMat

from .error import HardenError

__all__ = ["hard_material", "restitution_of"]

# classes whose contacts have a rigid counterpart; those that are derived from them have laws of their own
_KNOWN = ("FrictMat", "CohFrictMat", "ViscElMat", "FrictMatCDM", "FrictViscoMat")
_WALL_DENSITY = 2500.0  # kg/m³, of no consequence: masses stay those that bodies have
_DROPPED = {
    "FrictMat": "young, poisson",
    "CohFrictMat": "young, poisson, alphaKr, alphaKtw, shearCohesion",
    "ViscElMat": "kn, ks, cn, cs, tc, et",
}


def restitution_of(functors):
    """The coefficient of restitution that Ip2 functors give all contacts; None where none of them has one number for
    it, which is where they read it from the materials."""
    for functor in functors:
        given = getattr(functor, "en", None)
        if isinstance(given, MatchMaker) and given.algo == "val" and not given.matches:
            given = given.val
        if isinstance(given, (int, float)) and 0 <= given <= 1:
            return float(given)
    return None


def hard_material(soft, restitution=None, disk_radius=None):
    """An NscdMat with the strengths of ``soft``, not yet in the scene, and a sentence on what became what.

    ``restitution``: that of the functors, where they have one; a material's own ``en`` holds before it.
    ``disk_radius`` [m]: of the disks of a scene in the plane, per metre of thickness; None in space. Raises
    HardenError for a class whose strengths are unknown.
    """
    name = type(soft).__name__
    if isinstance(soft, NscdMat):
        return soft, "stays"
    if name not in _KNOWN:
        raise HardenError(
            f"material {soft.label or '#' + str(soft.id)} is a {name}, whose strengths have no rigid counterpart here: give its bodies an NscdMat before harden()"
        )
    # a wall may have none, and an NscdMat wants one
    density = soft.density if soft.density > 0 else _WALL_DENSITY
    values = dict(label=soft.label, density=density, frictionAngle=soft.frictionAngle, restitution=restitution or 0)
    if isinstance(soft, ViscElMat):
        if math.isfinite(soft.en):
            values["restitution"] = min(1.0, max(0.0, soft.en))
        values["rollingFriction"] = 0.5 * soft.mR
    if isinstance(soft, CohFrictMat):
        if soft.momentRotationLaw:
            values["rollingFriction"] = 0.5 * max(0.0, soft.etaRoll)
            values["twistingFriction"] = 0.5 * max(0.0, soft.etaTwist)
        if soft.isCohesive and soft.normalCohesion > 0:
            per_area = 1 / math.pi if disk_radius is None else 0.5 * disk_radius
            values["tensileStrength"] = soft.normalCohesion * per_area
            values["bondsToAll"] = True
    hard = NscdMat(**values)
    told = ", ".join(
        f"{key} = {value:.3g}"
        for key, value in values.items()
        if key not in ("label", "density", "bondsToAll") and value
    )
    return hard, f"{told or 'no friction'}; dropped: {_DROPPED.get(name, 'stiffness and damping')}"
