"""Engines for rigid spheres in space, with facets, boxes and walls: what a script needs besides YADE's own classes."""

from __future__ import annotations

from yade.wrapper import (
    Bo1_Box_Aabb,
    Bo1_Facet_Aabb,
    Bo1_Sphere_Aabb,
    Bo1_Wall_Aabb,
    Box,
    ContactDynamicsEngine,
    Facet,
    ForceResetter,
    Ig2_Box_Sphere_FaceGeom,
    Ig2_Facet_Sphere_FaceGeom,
    Ig2_Sphere_Sphere_ScGeom,
    Ig2_Wall_Sphere_FaceGeom,
    InsertionSortCollider,
    Ip2_NscdMat_NscdMat_NscdPhys,
    Law2_ScGeom_NscdPhys_SignoriniCoulomb,
    NscdInteractionLoop,
    SpatialNewtonIntegrator,
    Sphere,
    Wall,
)

from ..system import checks
from .error import SceneError

__all__ = ["OPEN_GAP", "REACH", "SHAPES", "bounds", "engines", "loop"]

#: Gap up to which contacts are known beforehand [ℓ]: more than the longest way of a step, a tenth of a diameter, so that
#: what is fast does not overlap before it is seen.
REACH = 0.12
#: Gap beyond which the solve leaves out a contact that will not close [ℓ]. Open contacts slow sweeps down, in space more
#: than in the plane: there are more of them.
OPEN_GAP = 0.02

#: Shapes that rigid spheres can touch in space: the functors of their boxes and of their contacts with spheres.
SHAPES = {
    Sphere: (Bo1_Sphere_Aabb, Ig2_Sphere_Sphere_ScGeom),
    Facet: (Bo1_Facet_Aabb, Ig2_Facet_Sphere_FaceGeom),
    Box: (Bo1_Box_Aabb, Ig2_Box_Sphere_FaceGeom),
    Wall: (Bo1_Wall_Aabb, Ig2_Wall_Sphere_FaceGeom),
}


def bounds(reach, shapes=SHAPES):
    """Functors of boxes for a collider, so that gaps up to ``reach`` [ℓ] are seen; for a wall ℓ is the sphere's
    diameter. ``shapes``: as SHAPES, Sphere first."""
    # a wall knows a sphere up to 2 reach of its radii, see Ig2_Facet_Sphere_FaceGeom.interactionDetectionFactor
    return [Bo1_Sphere_Aabb(aabbEnlargeFactor=1 + 2 * reach)] + [bound() for bound, _ in shapes.values()][1:]


def loop(reach, adhesion_range=1e-3, shapes=SHAPES, **options):
    """The NscdInteractionLoop of rigid contacts in space; ``shapes``: as SHAPES; ``options``: its attributes."""
    return NscdInteractionLoop(
        [contact(interactionDetectionFactor=1 + reach) for _, contact in shapes.values()],
        [Ip2_NscdMat_NscdMat_NscdPhys()],
        [Law2_ScGeom_NscdPhys_SignoriniCoulomb(reach=reach, adhesionRange=adhesion_range)],
        **options,
    )


def engines(
    gravity=(0, 0, -9.81), reach=REACH, before=(), after=(), label="contactDynamics", adhesion_range=1e-3, **options
):
    """The list O.engines of a Contact Dynamics simulation of spheres in space, with facets, boxes and walls.

    ``gravity`` [m/s²]; ``reach``: gap up to which contacts are known beforehand, in units of ℓ, the sum of the radii
    or, at a wall, the sphere's diameter; ``before``: engines that add forces; ``after``: engines after the integrator,
    RotationEngine and its like; ``adhesion_range``: gap up to which the residual tensile strength acts, in units of ℓ;
    ``options``: attributes of ContactDynamicsEngine, whose openGap is OPEN_GAP here. Bodies are YADE's own (``sphere``, ``facet``, ``box``, ``wall``)
    with an NscdMat. Raises AttributeError for an option that the engine has not.
    """
    checks.numbers_of("gravity", gravity, SceneError, "give (x, y, z) [m/s²], as (0, 0, -9.81)", 3, 3)
    checks.number("reach", reach, SceneError, "give a gap in mean diameters, 0 or more", least=0)
    checks.number("adhesion_range", adhesion_range, SceneError, "give a gap in mean diameters, 0 or more", least=0)
    return [
        ForceResetter(),
        InsertionSortCollider(bounds(reach)),
        loop(reach, adhesion_range),
        *before,
        ContactDynamicsEngine(**{"label": label, "openGap": OPEN_GAP, **options}),
        SpatialNewtonIntegrator(damping=0, gravity=gravity),
        *after,
    ]
