"""YADE bodies, materials and engines for rigid disks: what a script needs besides YADE's own classes."""

from __future__ import annotations

import math

import numpy as np

from yade import O, utils
from yade.wrapper import (
    Body,
    Bo1_Segment_Aabb,
    Bo1_Sphere_Aabb,
    ContactDynamicsEngine,
    ForceResetter,
    Ig2_Segment_Sphere_ScGeom,
    Ig2_Sphere_Sphere_ScGeom,
    Ip2_NscdMat_NscdMat_NscdPhys,
    Law2_ScGeom_NscdPhys_SignoriniCoulomb,
    NscdInteractionLoop,
    NscdMat,
    PlanarGridCollider,
    PlanarNewtonIntegrator,
    Segment,
    SlipWeakeningMat,
)
from yade.minieigenHP import Quaternion, Vector3

from . import geometry

__all__ = ["contact_dynamics", "disk", "engines", "join", "material", "segments", "wall_material"]


def material(m, kind=NscdMat, **others):
    """A material with the strengths of the section.Material ``m``, not yet in the scene.

    ``kind``: NscdMat or a class derived from it; ``others``: further attributes, or other values. A wall may have no density; it then gets a rock's.
    """
    values = dict(
        density=m.density or 2500.0,
        tensileStrength=m.tensile_strength,
        residualTensileStrength=m.residual_tensile_strength,
        frictionAngle=math.atan(m.friction),
        residualFrictionAngle=math.atan(m.residual_friction),
        rollingFriction=m.rolling_friction,
        residualRollingFriction=m.residual_rolling_friction,
        bondEllipseNormal=m.bond_ellipse[0],
        bondEllipseTangential=m.bond_ellipse[1],
        bondCreationDistance=m.bond_creation_distance,
        restitution=m.restitution,
    )
    return kind(**{**values, **others})


def wall_material(m, **others):
    """The material of a wall, whose strengths alone rule contacts with it; not yet in the scene.

    ``m``: a section.Material; with ``m.slip_weakening`` a SlipWeakeningMat, and bonds with disks of any layer if ``m.bonded``.
    """
    options = dict(wall=True, bondsToAll=m.bonded, layer=-1)
    weak = m.slip_weakening
    if weak is None:
        return material(m, **{**options, **others})
    options |= dict(
        criticalSlip=weak.critical_slip,
        weakening=weak.law,
        weakenedFrictionAngle=math.atan(weak.friction),
        weakenedTensileStrength=weak.tensile_strength,
    )
    return material(m, SlipWeakeningMat, **{**options, **others})


def disk(centre, radius, material, fixed=False, color=None):
    """A disk as a YADE Sphere body in the plane z = 0, not yet in the scene.

    ``centre``: (x, y) [m]; ``radius`` [m]; ``material``: an NscdMat, whose density [kg/m³] gives the mass ρ π r² and the
    inertia m r²/2 per metre of thickness. ``fixed``: block all degrees of freedom.
    """
    body = utils.sphere((centre[0], centre[1], 0), radius, material=material, fixed=fixed, color=color)
    density = body.material.density
    mass = density * math.pi * (radius * radius)  # pow() may round sizes 1:4 differently
    body.state.mass = mass
    body.state.inertia = Vector3(1, 1, 1) * (0.5 * mass * (radius * radius))
    body.state.blockedDOFs = "xyzXYZ" if fixed else "zXY"
    return body


def segments(vertices, material, piece=None, sense=0, closed=False, backwards=False):
    """Bodies of a wall along a polyline, fixed and not yet in the scene.

    ``vertices``: (n, 2) [m]. ``piece``: greatest length of a segment [m]; long oblique segments have large bounding boxes, so cut
    walls into pieces of some ten disk diameters. ``sense``: side that acts, see Segment.sense (+1: left of the direction of
    travel). Joints, of pieces and of corners, count as one wall: no doubled contact, no bump. ``backwards``: the list begins at the last vertex, and a
    corner belongs to the segment behind it, so that a mirrored wall has the mirrored bodies in the same order; not for a closed one.
    """
    points = [np.asarray(v, float) for v in vertices]
    if closed:
        points.append(points[0])
    if len(points) < 2:
        raise ValueError(f"a wall needs two vertices or more, not {len(points)}")
    if backwards:
        points.reverse()
    cut = [points[0]]
    for a, b in zip(points[:-1], points[1:]):
        length = float(geometry.distance(*(b - a)))
        if not length > 0:
            raise ValueError(f"two neighbouring vertices of a wall coincide at ({a[0]:g}, {a[1]:g})")
        count = max(1, math.ceil(length / piece - 1e-9)) if piece else 1
        cut += [a + (b - a) * (k / count) for k in range(1, count + 1)]
    ends = [(b, a) if backwards else (a, b) for a, b in zip(cut[:-1], cut[1:])]
    angles = [math.atan2(b[1] - a[1], b[0] - a[0]) for a, b in ends]
    bodies = [_segment(a, b, angle, material, sense) for (a, b), angle in zip(ends, angles)]
    for k in range(len(bodies) if closed else len(bodies) - 1):
        after = (k + 1) % len(bodies)
        turn = angles[after] - angles[k]
        join(bodies[k], bodies[after], Vector3(math.cos(turn), math.sin(turn), 0), backwards)
    return bodies


def _segment(a, b, angle, material, sense):
    body = Body()
    body.shape = Segment(halfLength=0.5 * float(geometry.distance(*(b - a))), sense=sense)
    body.state.pos = Vector3(*(0.5 * (a + b)), 0)
    body.state.ori = Quaternion((0, 0, 1), angle)
    body.state.refPos, body.state.refOri = body.state.pos, body.state.ori
    body.state.blockedDOFs = "xyzXYZ"
    body.material = material if not isinstance(material, str) else O.materials[material]
    return body


def join(one, other, along, backwards=False):
    """Makes two segments that meet count as one wall; ``one`` owns their corner. ``along``: the direction of ``other`` in the frame of ``one``; ``backwards``: see
    :func:`segments`."""
    if backwards:
        one.shape.previousDirection, other.shape.hasNext = along, True
    else:
        one.shape.nextDirection, other.shape.hasPrevious = along, True


def engines(
    gravity=(0, -9.81, 0), reach=0.05, far=None, verlet=0.1, before=(), after=(), label="contactDynamics", **options
):
    """The list O.engines of a Contact Dynamics simulation.

    ``gravity`` [m/s²]; ``reach``: gap up to which contacts are known beforehand, in units of ℓ; ``far``: the same for disks that are fast
    enough to come so near in two steps, where that is more; ``verlet``: the collider's margin [m] (negative: in smallest radii); ``before``:
    engines that add forces, e.g. PorePressureEngine; ``after``: engines after the integrator; ``options``: attributes of ContactDynamicsEngine. Raises AttributeError for one that it has not.
    """
    solver = ContactDynamicsEngine(label=label, **options)
    far = max(reach, far or 0)
    sure = {"sureReach": reach} if far > reach else {}
    return [
        ForceResetter(),
        PlanarGridCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1 + far), Bo1_Segment_Aabb()], verletDist=verlet, **sure),
        NscdInteractionLoop(
            [
                Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1 + far),
                Ig2_Segment_Sphere_ScGeom(interactionDetectionFactor=1 + far),
            ],
            [Ip2_NscdMat_NscdMat_NscdPhys()],
            [Law2_ScGeom_NscdPhys_SignoriniCoulomb(reach=far)],
        ),
        *before,
        solver,
        PlanarNewtonIntegrator(damping=0, gravity=gravity),
        *after,
    ]


def contact_dynamics():
    """The ContactDynamicsEngine in O.engines; raises LookupError where there is none."""
    for engine in O.engines:
        if isinstance(engine, ContactDynamicsEngine):
            return engine
    raise LookupError("O.engines has no ContactDynamicsEngine: set O.engines = engines(...) first")
