"""A pressed sample in the running scene, made of the rock that is to be tested, between its walls."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from yade import O

from ...model import materials
from ...world import scene, tables, worlds
from ...world.stepping import advance
from . import pressing
from .walls import Walls

__all__ = ["REST_UNITS", "Sample"]

REST_STEPS = 100  # in which a pressed sample takes up the test's pressure
RELAX_UNITS, REST_UNITS = 40.0, 20.0  # t_i in which the pressure grows on soft contacts, and for which it then rests


class Sample:
    """Handles of a sample that is in the scene: its ``walls``, id of its first disk, number of disks, and what tells of
    its contacts (``engine``, see :meth:`.worlds.Hard.measures`).

    ``bonds``: number of those made; ``mass``: mean mass of a disk [kg/m]; both None after a resume.
    """

    def __init__(self, walls, first_disk, count, engine=None):
        self.walls, self.first_disk, self.count = walls, first_disk, count
        self.engine = engine or scene.contact_dynamics()
        self.bonds = self.mass = None

    @classmethod
    def build(cls, shape, rock, platen, pressure, world=None, tolerance=1e-5, grips=None, **options):
        """Fills the (empty) scene; the sample rests under ``pressure`` [Pa], and is bonded where contacts are rigid.

        A pressed sample takes up the pressure and is then bonded. One that was not pressed is bonded first, and the
        pressure then grows.

        ``shape``: of a sample that `pressing.prepare` made; ``rock``, ``platen``: section.Material of disks and of
        platens, sides have no friction;
        ``world``: a :class:`.worlds.Soft`; None: rigid contacts, solved to ``tolerance``, with ``options`` of
        scene.engines, such as attributes of ContactDynamicsEngine. ``grips``: (thickness [m], section.Material) of what
        the disks are made of whose centres are so near to a platen; None: all are of the rock. Raises WorldError for
        another world: rigid contacts take their step from the test.
        """
        if world is not None:
            worlds.check(world, (worlds.Soft,))
        pressed = pressing.load(shape)
        O.reset()
        hard = world is None
        if hard:
            mass = scene.material(rock).density * math.pi * float(np.mean(np.square(pressed.r)))
            world = worlds.Hard(
                pressing.STEP * math.sqrt(mass / pressure),
                tolerance,
                reach=max(0.2, 0.01 + rock.bond_creation_distance),
                verlet=0.1 * shape.d_min,
                options=options,
            )
        side = replace(materials.smooth(platen), name="side", restitution=0.0)
        stuff, rough, smooth = world.material(rock), world.wall_material(platen), world.wall_material(side)
        O.materials.append((stuff, rough, smooth))
        stuffs, held = [stuff] * len(pressed.r), []
        if grips is not None:
            thickness, grip = grips
            strong = world.material(grip)
            O.materials.append(strong)
            held = np.flatnonzero(np.minimum(pressed.y, pressed.height - pressed.y) < thickness).tolist()
            for k in held:
                stuffs[k] = strong
        walls = Walls.around(pressed.width, pressed.height, rough, smooth)
        ids = O.bodies.append(
            [
                scene.disk((float(x), float(y)), float(r), m)
                for x, y, r, m in zip(pressed.x, pressed.y, pressed.r, stuffs)
            ]
        )
        O.engines, O.dt = world.engines(gravity=(0, 0, 0)), world.step_for([rock])
        # soft bonds are those of the first group that has both disks
        groups = [] if grips is None else [(grip, [ids[k] for k in held])]
        made = cls(walls, ids[0], len(ids), world.measures([*groups, (rock, list(ids))]))
        # the same mean, but for its last bits, which results keep
        made.mass = mass if hard else float(np.mean([O.bodies[i].state.mass for i in ids]))
        if not hard:
            made._relax(pressure)
        elif shape.friction is None:
            made._bond_and_load(pressure)
        else:
            made._load_and_bond(pressure)
        if hard:
            walls.step()
            made.engine.view()
        return made

    def _load_and_bond(self, pressure):
        self._free(pressing.WALL_MASS)
        self.walls.pressure = pressure
        for _ in range(REST_STEPS):
            self.walls.step()
        self.bonds = self.engine.bond()

    def _bond_and_load(self, pressure):
        advance()  # finds the contacts
        self.bonds = self.engine.bond()
        self._free(1.0)
        for k in range(pressing.RAMP + REST_STEPS):
            self.walls.pressure = pressure * min(1.0, (k + 1) / pressing.RAMP) ** 2
            self.walls.step()
        self._free(pressing.WALL_MASS)

    def _relax(self, pressure):
        self._free(pressing.WALL_MASS)
        unit = math.sqrt(self.mass / pressure)
        ramp, steps = max(1, round(RELAX_UNITS * unit / O.dt)), round((RELAX_UNITS + REST_UNITS) * unit / O.dt)
        for k in range(steps):
            self.walls.pressure = pressure * min(1.0, (k + 1) / ramp)
            self.walls.step()

    def _free(self, share):
        """Lets two walls follow the pressure, with this share of the sample's mass each."""
        mass = share * self.mass * self.count
        for name in ("right", "top"):
            self.walls.free(name, mass)

    def disks_area(self):
        """Area of the disks [m²]."""
        return float(np.sum(math.pi * tables.bodies(self.engine)["r"] ** 2))
