"""Strengths of rigid contacts from YADE's materials with springs.

A soft material says how strong a contact is, and how stiff. Strengths become those of an NscdMat, stiffnesses and
damping have no counterpart but restitution:

* ``frictionAngle`` and ``density`` stay; friction is the same with and without a bond.
* ``ViscElMat.en`` is the restitution; so is a functor's ``en``, where that is one number.
* ``ViscElMat.mR``: a length, the arm of a torque mR N: rolling friction mR by the mean diameter of the spheres.
  ``mRtype`` 2, a torque that grows with the speed, is refused.
* ``CohFrictMat.etaRoll`` and ``etaTwist``: rolling and twisting friction eta/2, where the material has
  ``momentRotationLaw``.
* ``CohFrictMat.normalCohesion`` c: the tensile strength of a bond, c/π: a force c R² on the area π/4 ℓ² of two equal
  spheres. Of disks it is c R/2, a force c R² on ℓ, with the mean radius.
* ``young``, ``poisson``, ``kn``, ``ks``, ``alphaKr``, ``tc`` and damping are dropped.
"""

from __future__ import annotations

import math

from yade.wrapper import CohFrictMat, FrictMat, MatchMaker, NscdMat, ViscElMat

from .error import HardenError

__all__ = ["hard_material", "pairs_of", "restitution_of", "restitution_of_damping", "set_pairs"]

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


def restitution_of_damping(damping):
    """The coefficient of restitution of springs without damping of their own under NewtonIntegrator's ``damping`` λ: it
    raises the spring's force by λ while that brakes, and lowers it by λ while that throws back.
    """
    return math.sqrt((1 - damping) / (1 + damping))


def pairs_of(functors):
    """{(lower id, higher id): {attribute of an NscdMat: value}} of the pairs of materials that Ip2 functors have values
    of their own for, by a MatchMaker.
    """
    found = {}
    for functor in functors:
        for name, attribute in (("frictAngle", "frictionAngle"), ("en", "restitution")):
            given = getattr(functor, name, None)
            for one, other, value in given.matches if isinstance(given, MatchMaker) else ():
                pair = tuple(sorted((int(one), int(other))))
                found.setdefault(pair, {})[attribute] = float(value)
    return found


def set_pairs(pairs, hard):
    """Gives rigid materials the values of :func:`pairs_of`; ``hard``: {id of the soft material: NscdMat}.

    Two different materials get a law of their contacts (NscdMat.interfaceLaws), for which each has a layer of its own.
    """
    for (one, other), values in sorted(pairs.items()):
        a, b = hard[one], hard[other]
        if one == other:
            for attribute, value in values.items():
                setattr(a, attribute, value)
    for (one, other), values in sorted(pairs.items()):
        a, b = hard[one], hard[other]
        if one == other:
            continue
        a.layer, b.layer = -2 - one, -2 - other  # negative ones bond nothing
        weaker = {
            name: min(getattr(a, name), getattr(b, name))
            for name in ("frictionAngle", "rollingFriction", "twistingFriction", "tensileStrength")
        }
        law = NscdMat(
            **{**weaker, "restitution": max(a.restitution, b.restitution), **values},
            bondsToAll=a.bondsToAll or b.bondsToAll,
        )
        a.interfaceLayers, a.interfaceLaws = [*a.interfaceLayers, b.layer], [*a.interfaceLaws, law]


def hard_material(soft, restitution=None, disk_radius=None, diameter=None):
    """An NscdMat with the strengths of ``soft``, not yet in the scene, and a sentence on what became what.

    ``restitution``: that of the functors, where they have one; a material's own ``en`` holds before it.
    ``disk_radius`` [m]: of the disks of a scene in the plane, per metre of thickness; None in space. ``diameter`` [m]:
    mean of the spheres that move. Raises HardenError for a class whose strengths are unknown, and for what rigid
    contacts have not.
    """
    name = type(soft).__name__
    if isinstance(soft, NscdMat):
        return soft, "stays"
    if name not in _KNOWN:
        raise HardenError(
            f"material {soft.label or '#' + str(soft.id)} is a {name}, whose strengths have no rigid counterpart here: give its bodies an NscdMat before harden()"
        )
    if getattr(soft, "lubrication", False):
        raise HardenError(
            f"material {soft.label or '#' + str(soft.id)} has lubrication, a force across gaps that rigid contacts have not: set lubrication = False"
        )
    # a wall may have none, and an NscdMat wants one
    density = soft.density if soft.density > 0 else _WALL_DENSITY
    values = dict(label=soft.label, density=density, frictionAngle=soft.frictionAngle, restitution=restitution or 0)
    if isinstance(soft, ViscElMat):
        if math.isfinite(soft.en):
            values["restitution"] = min(1.0, max(0.0, soft.en))
        values["rollingFriction"] = _rolling(soft, diameter)
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


def _rolling(soft, diameter):
    """Rolling friction of a ViscElMat."""
    if not soft.mR > 0:
        return 0.0
    name = soft.label or f"#{soft.id}"
    if soft.mRtype != 1:
        raise HardenError(
            f"material {name} has mRtype {soft.mRtype}, a rolling resistance that grows with the speed, which rigid contacts have not: set mRtype = 1, or mR = 0"
        )
    if diameter is None:
        raise HardenError(
            f"material {name} has mR = {soft.mR:g} m, whose share of a diameter is not known, since no sphere of the scene moves: set mR = 0, or call harden() once spheres are there"
        )
    return soft.mR / diameter
