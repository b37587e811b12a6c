"""A pressed sample in the running scene, made of the rock that is to be tested, between its walls."""

from __future__ import annotations

import math

import numpy as np
from yade import O
from yade.wrapper import NscdMat

from .. import scene, tables
from ..stepping import advance
from . import pressing
from .walls import Walls

REST_STEPS = 100  # in which a pressed sample takes up the test's pressure


class Sample:
    """Handles of a sample that is in the scene: its ``walls``, id of its first disk, number of disks, and of bonds made (None after a resume)."""

    def __init__(self, walls, first_disk, count):
        self.engine, self.walls, self.first_disk, self.count, self.bonds = (
            scene.contact_dynamics(),
            walls,
            first_disk,
            count,
            None,
        )

    @classmethod
    def build(cls, shape, rock, platen, pressure, **solver):
        """Fills the (empty) scene; the sample is bonded and rests under ``pressure`` [Pa].

        A pressed sample takes up the pressure and is then bonded. One that was not pressed is bonded first, and the pressure then grows.

        ``shape``: of a sample that `pressing.prepare` made; ``rock``, ``platen``: section.Material of disks and of platens, sides have no friction;
        ``solver``: options of scene.engines, such as attributes of ContactDynamicsEngine.
        """
        pressed = pressing.load(shape)
        O.reset()
        # disks of a layer below -1 are never bonded
        stuff, rough = scene.material(rock, layer=0 if rock.bonded else -2), scene.material(
            platen, wall=True, bondsToAll=platen.bonded, layer=-1
        )
        smooth = NscdMat(frictionAngle=0.0, wall=True, layer=-1)
        O.materials.append((stuff, rough, smooth))
        walls = Walls.around(pressed.width, pressed.height, rough, smooth)
        ids = O.bodies.append(
            [scene.disk((float(x), float(y)), float(r), stuff) for x, y, r in zip(pressed.x, pressed.y, pressed.r)]
        )
        reach = max(0.2, 0.01 + rock.bond_creation_distance)
        O.engines = scene.engines(gravity=(0, 0, 0), reach=reach, verlet=0.1 * shape.d_min, **solver)
        made = cls(walls, ids[0], len(ids))
        O.dt = pressing.STEP * math.sqrt(made.mass / pressure)
        if shape.friction is None:
            made._bond_and_load(pressure)
        else:
            made._load_and_bond(pressure)
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

    def _free(self, share):
        """Lets two walls follow the pressure, with this share of the sample's mass each."""
        mass = share * self.mass * self.count
        for name in ("right", "top"):
            self.walls.free(name, mass)

    @property
    def mass(self):
        """Mean mass of a disk [kg/m]."""
        radii = [O.bodies[self.first_disk + k].shape.radius for k in range(self.count)]
        return O.bodies[self.first_disk].material.density * math.pi * float(np.mean(np.square(radii)))

    def disks_area(self):
        """Area of the disks [m²]."""
        return float(np.sum(math.pi * tables.bodies(self.engine)["r"] ** 2))
