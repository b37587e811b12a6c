"""Materials and engines of a scene with soft contacts, in the manner of :mod:`yade.nonsmooth.scene`."""

from __future__ import annotations

import math

from yade.wrapper import (
    BondEllipseEngine,
    Bo1_Arc_Aabb,
    Bo1_Segment_Aabb,
    Bo1_Sphere_Aabb,
    CohFrictMat,
    ForceResetter,
    FrictMat,
    Ig2_Arc_Sphere_ScGeom,
    Ig2_Segment_Sphere_ScGeom,
    Ig2_Sphere_Sphere_ScGeom,
    Ig2_Sphere_Sphere_ScGeom6D,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_CohFrictMat_CohFrictMat_CohFrictPhys,
    Ip2_FrictMat_FrictMat_FrictPhys,
    Ip2_JCFpmMat_JCFpmMat_JCFpmPhys,
    Ip2_NscdMat_FrictMat_WallPhys,
    JCFpmMat,
    Law2_ScGeom6D_CohFrictPhys_CohesionMoment,
    Law2_ScGeom_FrictPhys_CundallStrack,
    Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM,
    Law2_SegmentGeom_WallPhys_SlipWeakening,
    NewtonIntegrator,
    NscdMat,
    PyRunner,
)

from ...model.section import Material
from .. import materials
from .parameters import SoftError, refuse_closing

__all__ = ["engines", "engines_of", "material", "wall_material"]


def material(e, **others):
    """The material of disks for the :class:`~yade.nonsmooth.soft.Equivalent` ``e``, not yet in the scene; ``others``:
    further attributes.

    Its values are those of :meth:`~yade.nonsmooth.soft.Equivalent.attributes`. It rules contacts that are not bonded:
    its friction is the residual one. Its strengths give the bond's thresholds at the mean diameter. At other diameters
    they do not, since YADE multiplies by min(R)² and the law by ℓ; :func:`~yade.nonsmooth.soft.bonds.bond` sets each
    contact.
    """
    kind = {"cohesion_moment": CohFrictMat, "jcfpm": JCFpmMat, "friction": FrictMat}[e.model]
    return kind(**{**e.attributes(), **others})


def wall_material(e, wall, **others):
    """The material of walls, for every model; not yet in the scene.

    ``wall``: the section.Material of the wall, whose strengths alone rule as in the hard law, slip weakening included;
    or a coefficient of friction [-], for a wall without cohesion and rolling resistance.
    """
    options = dict(young=e.young, poisson=e.shear_ratio)
    if isinstance(wall, Material):
        refuse_closing(f"material {wall.name}: bonds_close true", wall.bonds_close)
        if wall.slip_law is not None:
            raise SoftError(f"material {wall.name}: slip_law, which no soft model has; take it away")
        return materials.wall_material(wall, **{**options, **others})
    return NscdMat(
        **{**options, **dict(density=e.material.density, frictionAngle=math.atan(wall), wall=True, layer=-1), **others}
    )


def engines(e, **options):
    """:func:`engines_of` the model and the damping of an :class:`~yade.nonsmooth.soft.Equivalent`, with its
    ``options``.
    """
    return engines_of(e.model, e.damping, **{**dict(rolling_ratio=e.rolling_ratio or 1.0), **options})


def engines_of(
    model, damping, rolling_ratio=1.0, gravity=(0, -9.81, 0), verlet=0.1, before=(), after=(), every=200, ductile=False
):
    """The list O.engines of a simulation with soft contacts; the scene's time step is the caller's, below
    ``Equivalent.step_limit``.

    ``rolling_ratio``: of walls' contacts, k_r/(k_s R²). ``gravity`` [m/s²], ``verlet``, ``before``, ``after`` as
    :func:`yade.nonsmooth.scene.engines` has them. There is no ``reach``: springs act once disks overlap, and bonds over
    a gap are made by :func:`~yade.nonsmooth.soft.bonds.bond`. ``every``: steps after which contacts whose bond broke
    get the residual strengths (:func:`~yade.nonsmooth.soft.bonds.weaken`). ``ductile``: with the engine that bonds need
    which yield instead of breaking at once.

    Disks touch Segment and Arc walls through WallPhys in all models, so walls take :func:`wall_material`. A material of
    the disks' kind will not do: CohesionMoment needs rotations that a Segment's geometry has not (it is a ScGeom, not a
    ScGeom6D, and YADE does not check), and JCFpm needs a JCFpmState on both bodies.
    """
    geometry = Ig2_Sphere_Sphere_ScGeom6D() if model == "cohesion_moment" else Ig2_Sphere_Sphere_ScGeom()
    own = {
        "cohesion_moment": lambda: (
            [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys()],
            # incremental, or thresholds of torques would not be kept (YADE's own warning)
            [Law2_ScGeom6D_CohFrictPhys_CohesionMoment(always_use_moment_law=True, useIncrementalForm=True)],
        ),
        "jcfpm": lambda: (
            [Ip2_JCFpmMat_JCFpmMat_JCFpmPhys(cohesiveTresholdIteration=0)],
            [Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM()],
        ),
        "friction": lambda: ([], []),
    }
    physics, laws = own[model]()
    residual = PyRunner(
        command="from yade.nonsmooth import soft; soft.weaken()", iterPeriod=every, label="softResidual"
    )
    return [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Segment_Aabb(), Bo1_Arc_Aabb()], verletDist=verlet),
        InteractionLoop(
            [geometry, Ig2_Segment_Sphere_ScGeom(), Ig2_Arc_Sphere_ScGeom()],
            [*physics, Ip2_FrictMat_FrictMat_FrictPhys(), Ip2_NscdMat_FrictMat_WallPhys(rollingRatio=rolling_ratio)],
            [*laws, Law2_ScGeom_FrictPhys_CundallStrack(), Law2_SegmentGeom_WallPhys_SlipWeakening()],
        ),
        *before,
        # weight is damped too, YADE's default: with forces of contacts damped alone, a disk on a wall never comes to
        # rest
        NewtonIntegrator(damping=damping, gravity=gravity),
        *([BondEllipseEngine(label="softBonds")] if ductile else []),
        *([residual] if laws else []),
        *after,
    ]
