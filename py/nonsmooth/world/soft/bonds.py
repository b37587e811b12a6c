"""Bonds of soft contacts: thresholds set contact by contact, and what is left of them after a break."""

from __future__ import annotations

import math

import numpy as np
from scipy.spatial import cKDTree

from yade import O, utils
from yade.minieigenHP import Vector3
from yade.wrapper import (
    BondEllipseEngine,
    CohFrictMat,
    CohFrictPhys,
    InteractionLoop,
    Ip2_CohFrictMat_CohFrictMat_CohFrictPhys,
    JCFpmMat,
    JCFpmPhys,
    NscdMat,
    Arc,
    Segment,
    Sphere,
    WallPhys,
)

from .parameters import SoftError, refuse_closing

__all__ = ["bond", "bond_walls", "bonded", "set_thresholds", "weaken"]

MATERIALS = {"cohesion_moment": CohFrictMat, "jcfpm": JCFpmMat}


def bond(e, ids=None, fragile=True):
    """Bonds all pairs of disks whose gap is at most Δ ℓ (Taboada and Estrada 2009, section 2.2.2); returns how many
    were new.

    ``ids``: the bodies of one layer, as bonds exist within a layer only; without them all disks of the scene. Call it
    once for each layer, after the engines are set; no step is needed before. Contacts over a gap are made, and existing
    ones kept with their force.

    YADE derives strengths of a contact from stresses times min(R)², so thresholds that are to grow with ℓ = R₁ + R₂ are
    set here, once, contact by contact: in "cohesion_moment" normalAdhesion = F_a = σ_ext ℓ, shearAdhesion = μ_s F_a,
    rollingAdhesion = μ_r ℓ F_a, tangensOfFrictionAngle = μ_s, maxRollPl = μ_r ℓ; in "jcfpm" FnMax = F_a, FsMax = μ_s
    F_a, tanFrictionAngle = μ_s. A bond over a gap is born without force; one of overlapping disks bears their overlap,
    but in "jcfpm" only what came after the contact was made.

    ``fragile``: bonds break where they reach a threshold, as YADE's laws have it. Otherwise they yield there, as in the
    hard law, and break when they leave their ellipse, which needs :func:`~yade.nonsmooth.soft.functors.engines` with
    ``ductile=True``; only "cohesion_moment" has such bonds.

    Raises SoftError for a model without bonds, for engines of another model, and for disks of another material.
    """
    if e.model not in MATERIALS:
        raise SoftError(f"model {e.model!r} has no bonds; take one of {', '.join(MATERIALS)}")
    functor, follower = _functor(e), None if fragile else _follower(e.model)
    ids = [b.id for b in O.bodies if isinstance(b.shape, Sphere)] if ids is None else list(ids)
    for k in ids:
        if not isinstance(O.bodies[k].material, MATERIALS[e.model]):
            raise SoftError(
                f"body {k}: material {type(O.bodies[k].material).__name__}, and {e.model} bonds disks of {MATERIALS[e.model].__name__}; "
                "make them of soft.material(...), or give the ids of those that are"
            )
    m = e.material
    if not m.bonded or len(ids) < 2:
        return 0
    places = np.array([O.bodies[k].state.pos for k in ids])[:, :2]
    radii = np.array([O.bodies[k].shape.radius for k in ids])
    pairs = (
        cKDTree(places)
        .query_pairs(2 * radii.max() * (1 + m.bond_creation_distance), output_type="ndarray")
        .reshape(-1, 2)
    )
    lengths = radii[pairs].sum(axis=1)
    gaps = np.hypot(*(places[pairs[:, 0]] - places[pairs[:, 1]]).T) - lengths
    near = gaps <= m.bond_creation_distance * lengths
    count = 0
    for (a, b), length in zip(pairs[near], lengths[near]):
        a, b = ids[a], ids[b]
        contact = O.interactions[a, b] if O.interactions.has(a, b, True) else utils.createInteraction(a, b)
        if not bonded(contact.phys):
            _make(e, contact, float(length), functor)
            if follower:
                contact.phys.fragile = False
                follower.add(
                    a,
                    b,
                    m.bond_ellipse[0] * length,
                    m.bond_ellipse[1] * length,
                    m.residual_friction,
                    m.residual_rolling_friction * length,
                )
            count += 1
    return count


def _follower(model="cohesion_moment"):
    """The engine that breaks ductile bonds; SoftError where there is none, or where the model has no such bonds."""
    if model != "cohesion_moment":
        raise SoftError(f"model {model!r} has fragile bonds alone; give fragile=True, or take cohesion_moment")
    for engine in O.engines:
        if isinstance(engine, BondEllipseEngine):
            return engine
    raise SoftError(
        "O.engines has no BondEllipseEngine, which ductile bonds need; set O.engines = soft.engines(e, ductile=True) first"
    )


def bond_walls(ids=None, fragile=True):
    """Bonds disks to walls whose material is made for it (``bondsToAll``, as ``bonded: true`` in a section file), where
    the gap is at most Δ ℓ; returns how many were new.

    ``ids``: of disks, default all; ``fragile`` as in :func:`bond`. Call it after the engines are set. A bond over a gap
    is born without force.

    Raises SoftError for ductile bonds (``fragile=False``) without a BondEllipseEngine in O.engines, for an Arc of such
    a material, and where the engines make other contacts with walls than WallPhys.
    """
    disks = [b for b in O.bodies if isinstance(b.shape, Sphere)] if ids is None else [O.bodies[k] for k in ids]
    centres, radii = np.array([b.state.pos for b in disks]).reshape(-1, 3)[:, :2], np.array(
        [b.shape.radius for b in disks]
    )
    count, follower = 0, None if fragile else _follower()
    for wall in O.bodies:
        m = wall.material
        if isinstance(wall.shape, Arc) and isinstance(m, NscdMat) and m.bondsToAll:
            raise SoftError(
                f"body {wall.id} is an Arc, to which soft bonds are not made: take segments, or bondsToAll=False"
            )
        if not isinstance(wall.shape, Segment) or not isinstance(m, NscdMat) or not m.bondsToAll:
            continue
        refuse_closing(f"body {wall.id}: bondsClose True", m.bondsClose)
        along, half = np.array(wall.state.ori * Vector3(1, 0, 0))[:2], wall.shape.halfLength
        away = centres - np.array(wall.state.pos)[:2]
        height = along[0] * away[:, 1] - along[1] * away[:, 0]
        height = height * wall.shape.sense if wall.shape.sense else np.abs(height)
        place = away @ along
        # as Segment has it: the centre stands above the segment, whose far end is the next one's
        near = (place >= -half) & (place < half) & (height > 0) & (height - radii <= m.bondCreationDistance * 2 * radii)
        for k in np.flatnonzero(near):
            i = disks[k].id
            contact = (
                O.interactions[wall.id, i]
                if O.interactions.has(wall.id, i, True)
                else utils.createInteraction(wall.id, i)
            )
            if not isinstance(contact.phys, WallPhys):
                raise SoftError(
                    f"body {wall.id}: contacts with walls are {type(contact.phys).__name__}; set O.engines = soft.engines(...) first"
                )
            if not contact.phys.bonded:
                p = contact.phys
                p.bonded, p.restPenetration, p.fragile = True, min(contact.geom.penetrationDepth, 0.0), fragile
                if follower:
                    follower.add(
                        wall.id,
                        i,
                        m.bondEllipseNormal * p.length,
                        m.bondEllipseTangential * p.length,
                        p.residualFriction,
                        p.residualRollingArm,
                    )
                count += 1
    return count


def _functor(e):
    """The functor that makes bonds of CohFrictPhys, None in "jcfpm"; SoftError where the engines are not those of the
    model.
    """
    functors = [
        f for engine in O.engines if isinstance(engine, InteractionLoop) for f in engine.physDispatcher.functors
    ]
    name = {"cohesion_moment": "Ip2_CohFrictMat_CohFrictMat_CohFrictPhys", "jcfpm": "Ip2_JCFpmMat_JCFpmMat_JCFpmPhys"}[
        e.model
    ]
    for f in functors:
        if type(f).__name__ == name:
            return f if isinstance(f, Ip2_CohFrictMat_CohFrictMat_CohFrictPhys) else None
    raise SoftError(f"O.engines has no {name}, which {e.model} needs; set O.engines = soft.engines(...) first")


def _make(e, contact, length, functor):
    p = contact.phys
    if functor is None:
        p.isCohesive = True
        set_thresholds(e, p, length)
        for k in (contact.id1, contact.id2):  # YADE divides by it when bonds break
            O.bodies[k].state.nbInitBonds += 1
        return
    functor.setCohesion(contact, True, False)
    set_thresholds(e, p, length)
    p.unp = min(contact.geom.penetrationDepth, 0.0)


def set_thresholds(e, physics, length):
    """Gives the physics of a bond of length ℓ [m] its thresholds, see :func:`bond`."""
    m, p = e.material, physics
    tension, shear, torque = e.thresholds(length)
    if isinstance(p, JCFpmPhys):
        p.FnMax, p.FsMax, p.tanFrictionAngle = tension, shear, m.friction
    else:
        p.normalAdhesion, p.shearAdhesion, p.rollingAdhesion = tension, shear, torque
        p.tangensOfFrictionAngle, p.maxRollPl = m.friction, m.rolling_friction * length


def bonded(physics):
    """Whether the physics of a contact is that of a bond that holds."""
    if isinstance(physics, CohFrictPhys):
        return not physics.cohesionBroken
    if isinstance(physics, WallPhys):
        return physics.bonded
    return isinstance(physics, JCFpmPhys) and physics.isCohesive


def weaken(contacts=None):
    """Gives contacts of disks that are not bonded the residual friction of their materials, and the arm μ_r ℓ, ℓ = R₁ +
    R₂.

    YADE keeps the peak values of a contact whose bond broke, and gives new contacts the arm 2 μ_r min(R). The weaker of
    the two materials' values holds, as in the hard law. ``contacts``: interactions to look at, without them all;
    :func:`~yade.nonsmooth.soft.functors.engines` calls it now and then.
    """
    for i in O.interactions if contacts is None else contacts:
        p = i.phys if i.isReal else None
        if bonded(p) or not isinstance(p, (CohFrictPhys, JCFpmPhys)):
            continue
        a, b = (O.bodies[k].material for k in (i.id1, i.id2))
        if isinstance(p, CohFrictPhys):
            p.tangensOfFrictionAngle = math.tan(min(a.frictionAngle, b.frictionAngle))
            p.maxRollPl = 0.5 * min(a.etaRoll, b.etaRoll) * (i.geom.refR1 + i.geom.refR2)
        else:
            p.tanFrictionAngle = math.tan(min(a.residualFrictionAngle, b.residualFrictionAngle))
