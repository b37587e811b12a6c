"""One scene of spheres in space, two worlds: what a scene of spheres, facets and boxes takes from the contact model,
the same calls for hard and for soft contacts::

    world = sphere_worlds.HardSpheres(time_step=5e-4)
    world = sphere_worlds.SoftSpheres(stiffness=1e7, diameter=(0.008, 0.012))

    rock = O.materials[O.materials.append(world.material(m))]    # m: a SphereMaterial
    ...                                                          # spheres, facets and boxes of YADE's with it
    O.engines, O.dt = world.engines(), world.step_for([m])

As :mod:`.worlds` has it for disks in the plane. Walls of YADE's (``utils.wall``) are left out: the soft law with
rolling resistance has no contact with them. Values can be set and checked in any Python.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from ..errors import UserError
from ..system import checks

__all__ = ["HardSpheres", "SoftSpheres", "SphereMaterial", "SphereWorldError", "stable_step"]

NEIGHBOURS = 12  # of a sphere among others of its size
STIFFEST = 1e15  # Pa, a thousand times that of diamond; with much more squares of frequencies overflow
LARGEST_RATIO = 1e3  # of stiffnesses, for the same reason


class SphereWorldError(UserError, ValueError):
    """A value of a world of spheres that cannot be used; the message names it, and what would do."""


@dataclass(frozen=True)
class SphereMaterial:
    """Of spheres and walls: ``density`` [kg/m³]; ``friction``, ``rolling_friction`` and ``twisting_friction``, the last
    two in units of ℓ (the sum of the radii, at a wall the diameter); ``restitution``, of hard contacts alone.
    """

    density: float = 2500.0
    friction: float = 0.5
    rolling_friction: float = 0.0
    twisting_friction: float = 0.0
    restitution: float = 0.0

    def smooth(self):
        """The same without friction."""
        return SphereMaterial(self.density, 0.0, 0.0, 0.0, self.restitution)


@dataclass(frozen=True)
class HardSpheres:
    """Contact Dynamics. ``time_step`` [s]; ``tolerance``: of the solver's residual, relative; ``reach``: gap up to
    which contacts are known beforehand [ℓ], more than the way of a sphere in a step, or fast ones overlap;
    ``options``: further attributes of ContactDynamicsEngine.
    """

    time_step: float
    tolerance: float = 1e-4
    reach: float = 0.12  # that of space.engines, which YADE's Python alone can import
    options: dict = field(default_factory=dict)
    name = "hard"

    def __post_init__(self):
        for name in ("time_step", "tolerance", "reach"):
            checks.number(name, getattr(self, name), SphereWorldError, "give a number above 0", above=0)

    def material(self, m):
        """The material of spheres and walls for the SphereMaterial ``m``, not yet in the scene."""
        from yade.wrapper import NscdMat

        return NscdMat(
            density=m.density,
            frictionAngle=math.atan(m.friction),
            rollingFriction=m.rolling_friction,
            twistingFriction=m.twisting_friction,
            restitution=m.restitution,
        )

    def step_for(self, materials):
        """Time step [s] for these SphereMaterials."""
        return self.time_step

    def engines(self, gravity=(0, 0, -9.81), before=(), after=()):
        """The list O.engines; ``before``: engines that add forces, ``after``: engines after the integrator."""
        from . import space

        return space.engines(
            gravity=gravity, reach=self.reach, before=before, after=after, tolerance=self.tolerance, **self.options
        )


@dataclass(frozen=True)
class SoftSpheres:
    """Springs, by YADE's CohFrictMat and Law2_ScGeom6D_CohFrictPhys_CohesionMoment without cohesion.

    ``stiffness``: Young's modulus E [Pa], k_n = E R for two spheres of radius R and at a wall; ``diameter``: smallest
    and largest of the spheres [m]; ``damping``: NewtonIntegrator's; ``shear_ratio``: k_s/k_n; ``rolling_ratio``:
    k_r/(k_s R₁ R₂), of twisting too; ``step_share``: time step in units of its limit, :func:`stable_step`.
    """

    stiffness: float
    diameter: tuple[float, float]
    damping: float = 0.2
    shear_ratio: float = 0.3
    rolling_ratio: float = 1.0
    step_share: float = 0.5
    name = "soft"

    def __post_init__(self):
        remedy = f"give a number above 0, to {STIFFEST:g} at most [Pa]"
        checks.number("stiffness", self.stiffness, SphereWorldError, remedy, above=0, most=STIFFEST)
        remedy = f"give a number above 0, to {LARGEST_RATIO:g} at most"
        checks.number("shear_ratio", self.shear_ratio, SphereWorldError, remedy, above=0, most=LARGEST_RATIO)
        remedy = f"give 0 or more, to {LARGEST_RATIO:g} at most"
        checks.number("rolling_ratio", self.rolling_ratio, SphereWorldError, remedy, least=0, most=LARGEST_RATIO)
        remedy = "give a number from 0 to less than 1"
        checks.number("damping", self.damping, SphereWorldError, remedy, least=0, below=1)
        remedy = "the time step in units of its stability limit; give a number above 0, to 1 at most"
        checks.number("step_share", self.step_share, SphereWorldError, remedy, above=0, most=1)
        sizes = checks.numbers_of("diameter", self.diameter, SphereWorldError, "give (smallest, largest) [m]", 2, 2)
        if not 0 < sizes[0] <= sizes[1]:
            raise SphereWorldError(f"diameter {checks.shown(self.diameter)}: give (smallest, largest) [m], above 0")

    def material(self, m):
        """As :meth:`HardSpheres.material`. Raises SphereWorldError for a restitution, which the springs have not, and
        for rolling or twisting friction without a stiffness for it.
        """
        from yade.wrapper import CohFrictMat

        self.check(m)
        # the torque's arm is η times the smaller radius, that of the law ℓ
        return CohFrictMat(
            density=m.density,
            young=self.stiffness,
            poisson=self.shear_ratio,
            frictionAngle=math.atan(m.friction),
            isCohesive=False,
            momentRotationLaw=True,
            etaRoll=2 * m.rolling_friction,
            etaTwist=2 * m.twisting_friction,
            alphaKr=self.rolling_ratio,
            alphaKtw=self.rolling_ratio,
        )

    def check(self, m):
        """Raises SphereWorldError for a SphereMaterial with what the springs have not."""
        if m.restitution > 0:
            raise SphereWorldError(
                f"restitution {m.restitution:g} with soft contacts: springs have none of their own; give restitution 0 and choose the damping"
            )
        if self.rolling_ratio == 0 and (m.rolling_friction > 0 or m.twisting_friction > 0):
            raise SphereWorldError(
                "rolling_ratio 0: the material resists rolling or twisting, so its contacts need a stiffness; give more than 0"
            )

    def step_for(self, materials):
        """Time step [s] for these SphereMaterials: the share of the smallest limit."""
        ratios = self.shear_ratio, self.rolling_ratio
        return self.step_share * min(stable_step(m.density, self.stiffness, self.diameter, *ratios) for m in materials)

    def engines(self, gravity=(0, 0, -9.81), before=(), after=()):
        """As :meth:`HardSpheres.engines`."""
        from yade import wrapper as w

        return [
            w.ForceResetter(),
            w.InsertionSortCollider(
                [w.Bo1_Sphere_Aabb(), w.Bo1_Facet_Aabb(), w.Bo1_Box_Aabb()], verletDist=0.1 * self.diameter[0]
            ),
            w.InteractionLoop(
                [w.Ig2_Sphere_Sphere_ScGeom6D(), w.Ig2_Facet_Sphere_ScGeom6D(), w.Ig2_Box_Sphere_ScGeom6D()],
                [w.Ip2_CohFrictMat_CohFrictMat_CohFrictPhys()],
                # torques yield only where they are summed from step to step
                [w.Law2_ScGeom6D_CohFrictPhys_CohesionMoment(always_use_moment_law=True, useIncrementalForm=True)],
            ),
            *before,
            w.NewtonIntegrator(damping=self.damping, gravity=gravity),
            *after,
        ]


def stable_step(density, stiffness, diameter, shear_ratio=0.3, rolling_ratio=1.0):
    """The largest step [s] of springs between spheres: 2/√(12 λ), with λ the largest eigenvalue of one contact of two
    of the smallest, or of the smallest and the largest; each sphere's mass is shared by 12 contacts.

    ``density`` [kg/m³]; ``stiffness``: E [Pa]; ``diameter``: (smallest, largest) [m]; ratios as of
    :class:`SoftSpheres`.
    """
    small = 0.5 * diameter[0]
    largest = max(_greatest_square(density, stiffness, small, 0.5 * d, shear_ratio, rolling_ratio) for d in diameter)
    return 2 / math.sqrt(NEIGHBOURS * largest)


def _greatest_square(density, stiffness, radius1, radius2, shear_ratio, rolling_ratio):
    """Largest ω² [1/s²] of two free spheres in contact; freedoms along the normal, across it, and the turn about the
    third axis, of each.
    """
    kn = 2 * stiffness * radius1 * radius2 / (radius1 + radius2)
    ks = shear_ratio * kn
    rows = np.array([[-1, 0, 0, 1, 0, 0], [0, -1, -radius1, 0, 1, -radius2], [0, 0, -1, 0, 0, 1]], float)
    masses = np.repeat([density * 4 / 3 * math.pi * r**3 for r in (radius1, radius2)], 3)
    masses[[2, 5]] *= 0.4 * np.square([radius1, radius2])
    reduced = rows / np.sqrt(masses)
    stiff = np.diag([kn, ks, rolling_ratio * ks * radius1 * radius2])
    return float(np.linalg.eigvalsh(reduced.T @ stiff @ reduced)[-1])
