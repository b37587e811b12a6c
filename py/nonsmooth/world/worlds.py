"""One scene, two worlds: what a scene of disks and walls takes from the contact model, the same calls for hard and for
soft contacts::

    world = worlds.Hard(time_step=2e-3)                          # Contact Dynamics
    world = worlds.Soft(stiffness=1e8, diameter=(0.01, 0.02))    # springs, YADE's own laws, see yade.nonsmooth.soft

    rock = O.materials[O.materials.append(world.material(m))]    # m: a section.Material
    ground = O.materials[O.materials.append(world.wall_material(wall))]
    ...                                                          # disks by scene.disk, walls by scene.segments
    O.engines, O.dt = world.engines(), world.step_for([m])
    world.bond([(m, ids)])

A world has a ``name``, "hard" or "soft", and nothing else that a scene needs to ask. Its values can be set and checked
in any Python; what makes materials, engines and bonds is asked for within YADE.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from ..errors import UserError
from ..system import checks
from . import soft

__all__ = ["Hard", "Soft", "WorldError", "check", "check_damping"]


class WorldError(UserError, ValueError):
    """A scene asks for what a contact model has not; the message says what helps."""


@dataclass(frozen=True)
class Hard:
    """Contact Dynamics.

    ``time_step`` [s]; ``tolerance``: of the solver's residual, relative; ``reach``: gap up to which contacts are known
    beforehand, in mean diameters; ``far``: the same for disks that are fast enough, None: not more; ``verlet``: the
    collider's margin [m], negative: in smallest radii; ``options``: further attributes of ContactDynamicsEngine.
    """

    time_step: float
    tolerance: float = 1e-5
    reach: float = 0.05
    far: float | None = None
    verlet: float = -0.6
    options: dict = field(default_factory=dict)
    name = "hard"

    def material(self, m, layer=0, **others):
        """The material of disks for the section.Material ``m``, not yet in the scene. Disks of different ``layer`` are
        never bonded.
        """
        from . import scene

        return scene.material(m, layer=layer if m.bonded else -2 - layer, **others)

    def wall_material(self, m, **others):
        """The material of a wall; with ``m.slip_weakening`` or ``m.slip_law`` it loses its strength as disks slip."""
        from . import scene

        return scene.wall_material(m, **others)

    def interface(self, lower, upper, m):
        """Gives contacts between disks of two materials of the scene, of different layers, the law of the
        section.Material ``m``.
        """
        from . import scene

        lower.interfaceLayers, lower.interfaceLaws = [*lower.interfaceLayers, upper.layer], [
            *lower.interfaceLaws,
            scene.wall_material(m, wall=False),
        ]

    def step_for(self, materials):
        """Time step [s] for these section.Materials of disks."""
        return self.time_step

    def engines(self, gravity=(0, -9.81, 0), before=(), after=()):
        """The list O.engines; ``before``: engines that add forces, ``after``: engines after the integrator."""
        from . import scene

        return scene.engines(
            gravity=gravity,
            reach=self.reach,
            far=self.far,
            verlet=self.verlet,
            before=before,
            after=after,
            tolerance=self.tolerance,
            **self.options,
        )

    def measures(self, groups=()):
        """What tells of the contacts, speeds and energies of the scene, and makes bonds: its ContactDynamicsEngine.
        ``groups``: see :meth:`Soft.measures`.
        """
        from . import scene

        return scene.contact_dynamics()

    def bond(self, groups=()):
        """Bonds close neighbours as their materials' layers allow; returns how many. Takes one step without gravity,
        which finds the contacts: call it in a scene at rest. ``groups``: not needed here, see :meth:`Soft.bond`.
        """
        from yade import O
        from yade.wrapper import NewtonIntegrator

        from . import scene
        from .stepping import advance

        newton = next(e for e in O.engines if isinstance(e, NewtonIntegrator))
        gravity, newton.gravity = newton.gravity, (0, 0, 0)
        advance(view=False)
        newton.gravity = gravity
        return scene.contact_dynamics().bond()

    def set_strengths(self, pairs):
        """Gives materials of the scene other strengths, and all contacts that exist too; bonds, forces and slip stay.
        ``pairs``: (material of the scene, section.Material), a list.
        """
        from . import scene

        for present, m in pairs:
            scene.set_strengths(m, present)
        scene.contact_dynamics().updateStrengths()


@dataclass(frozen=True)
class Soft:
    """Springs at contacts, by one of YADE's own models.

    ``stiffness``: Young's modulus [Pa]; ``diameter``: smallest and largest of the disks [m]; ``model``, ``damping``,
    ``shear_ratio``, ``rolling_ratio``: see :func:`yade.nonsmooth.soft.equivalent`; ``step_share``: time step in units
    of its stability limit; ``fragile``: bonds break where they reach a threshold (YADE's own way, and JCFpm's only
    one); otherwise they yield there as in the hard law, and break when they leave their ellipse; ``verlet`` as in
    :class:`Hard`.
    """

    stiffness: float
    diameter: tuple[float, float]
    model: str = "cohesion_moment"
    damping: float = 0.2
    shear_ratio: float = 0.3
    rolling_ratio: float = 1.0
    step_share: float = 0.5
    verlet: float = -0.6
    fragile: bool = False
    name = "soft"

    @property
    def ductile(self):
        """Whether bonds yield before they break."""
        return self.model == "cohesion_moment" and not self.fragile

    def equivalent(self, m):
        """The :class:`yade.nonsmooth.soft.Equivalent` of a section.Material."""
        return soft.equivalent(
            m,
            self.stiffness,
            self.model,
            diameter=self.diameter,
            shear_ratio=self.shear_ratio,
            rolling_ratio=self.rolling_ratio,
            damping=self.damping,
        )

    def material(self, m, layer=0, **others):
        """As :meth:`Hard.material`; which disks are bonded is told to :meth:`bond`."""
        return soft.material(self.equivalent(m), **others)

    def wall_material(self, m, **others):
        """As :meth:`Hard.wall_material`. Raises WorldError for a slip law that heats, which soft contacts do not know."""
        from . import scene

        if m.slip_law is not None:
            raise WorldError(
                f"material {m.name}: its slip_law needs rigid contacts: leave it out, or use Contact Dynamics"
            )
        return scene.wall_material(m, **{**dict(young=self.stiffness, poisson=self.shear_ratio), **others})

    def interface(self, lower, upper, m):
        """Raises WorldError: soft contacts have no interfaces."""
        raise WorldError(
            "interfaces between layers need rigid contacts: leave `interfaces` out of the section, or use Contact Dynamics"
        )

    def step_for(self, materials):
        """Time step [s] for these section.Materials of disks: the share of the smallest limit."""
        return self.step_share * min(self.equivalent(m).step_limit for m in materials)

    def engines(self, gravity=(0, -9.81, 0), before=(), after=()):
        """As :meth:`Hard.engines`."""
        return soft.engines_of(
            self.model,
            self.damping,
            self.rolling_ratio,
            gravity=gravity,
            verlet=self.verlet,
            before=before,
            after=after,
            ductile=self.ductile,
        )

    def measures(self, groups=()):
        """As :meth:`Hard.measures`, under the same names: :class:`yade.nonsmooth.soft.measures.Measures`. ``groups``:
        as of :meth:`bond`. Call it once O.engines are set.
        """
        from .soft.measures import Measures

        return Measures(self, groups)

    def bond(self, groups=()):
        """Bonds close neighbours within each group, a pair (section.Material, ids of its disks), and disks to walls
        that are bonded; returns how many. See :func:`yade.nonsmooth.soft.bond` and
        :func:`yade.nonsmooth.soft.bond_walls`.
        """
        made = sum(
            soft.bond(self.equivalent(m), ids, fragile=not self.ductile)
            for m, ids in groups
            if m.bonded and self.model != "friction"
        )
        return made + soft.bond_walls([i for _, ids in groups for i in ids], fragile=not self.ductile)

    def set_strengths(self, pairs):
        """As :meth:`Hard.set_strengths`; ``pairs``: of all materials of the scene's disks and walls."""
        from .soft import strengths

        strengths.change(self, pairs)


def check(world, kinds=(Hard, Soft)):
    """The ``world``, of one of these ``kinds``; raises WorldError for anything else."""
    if not isinstance(world, kinds):
        given = " or ".join(f"worlds.{kind.__name__}(...)" for kind in kinds)
        raise WorldError(f"world {checks.shown(world)}: give {given}, or None for rigid contacts")
    return world


def check_damping(world, moving):
    """Raises WorldError for a ``damping_moving``, the integrator's while disks move, that cannot be used in a
    ``world``, or by its name; None is none of its own.
    """
    if moving is None:
        return
    name = getattr(world, "name", world)
    if name != "soft":
        raise WorldError(
            f"damping_moving {moving!r}: {name} contacts have no damping; leave it out, or take the soft world"
        )
    checks.number("damping_moving", moving, WorldError, "give a number from 0 to less than 1", least=0, below=1)
