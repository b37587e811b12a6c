"""YADE's soft contacts (springs and friction, Cundall and Strack 1979) on the disks and walls of a slope, to compare
steps with.

The scene is what a YADE user would write: one FrictMat for disks and walls, Law2_ScGeom_FrictPhys_CundallStrack, half
of the P-wave time step. Disks have the masses of spheres, as that time step supposes. The collider keeps the margin it
has in the slope, but its boxes are not enlarged: springs need no contact that does not touch yet.
"""

from __future__ import annotations

import math

from yade import O, utils
from yade.minieigenHP import Vector3
from yade.wrapper import (
    Bo1_Segment_Aabb,
    Bo1_Sphere_Aabb,
    ForceResetter,
    FrictMat,
    Ig2_Segment_Sphere_ScGeom,
    Ig2_Sphere_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_FrictMat_FrictMat_FrictPhys,
    Law2_ScGeom_FrictPhys_CundallStrack,
    NewtonIntegrator,
)

__all__ = ["soften"]

YOUNG, POISSON, FRICTION, DAMPING = 2e8, 0.3, 0.3, 0.2


def soften(built):
    """Puts soft contacts in the place of the rigid ones of ``built``, the Slope in the scene; forces begin at zero."""
    gravity = built.section.gravity
    density = built.section.materials[built.section.layers[0].material].density
    O.interactions.clear()
    O.materials.append(
        FrictMat(young=YOUNG, poisson=POISSON, frictionAngle=math.atan(FRICTION), density=density, label="soft")
    )
    for body in O.bodies:
        body.material = O.materials["soft"]
    for k in range(built.first_disk, built.first_disk + built.count):
        body = O.bodies[k]
        r = body.shape.radius
        body.state.mass = 4 / 3 * math.pi * density * r**3
        body.state.inertia = Vector3(1, 1, 1) * (0.4 * body.state.mass * r**2)
    O.engines = [
        ForceResetter(),
        InsertionSortCollider(
            [Bo1_Sphere_Aabb(), Bo1_Segment_Aabb()], verletDist=-built.section.numerics.verlet_distance
        ),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom(), Ig2_Segment_Sphere_ScGeom()],
            [Ip2_FrictMat_FrictMat_FrictPhys()],
            [Law2_ScGeom_FrictPhys_CundallStrack()],
        ),
        NewtonIntegrator(damping=DAMPING, gravity=(0, -gravity, 0)),
    ]
    O.dt = 0.5 * utils.PWaveTimeStep()
