"""Forces on a section's walls, across its interfaces and on its obstacles, and the slip along them: a row for each in
``walls.csv``, and sums by role.

Forces on walls are means over the steps since the row before; those between disks, across interfaces and on obstacles
made of disks, are of the row's last step.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from yade import O

from ... import records
from ...model import roles
from ...world import tables
from ...world.wall_forces import WallForces
from . import slope
from .columns import WALL_COLUMNS

__all__ = ["Slip", "WallSeries"]


class Slip(NamedTuple):
    """``mean`` [m] of the disks that ``touched`` walls or interfaces, how many of them are ``weakened``; whether slip
    ``counts`` there.
    """

    mean: float
    weakened: int
    touched: int
    counts: bool


class WallSeries:
    """Of a built :class:`~nonsmooth.studies.slope.slope.Slope`, its disks' ``layers`` (count,); ``path``: the file;
    ``period``: see :class:`.wall_forces.WallForces`; ``mark``: of a checkpoint. ``there``: numbers of the disks that
    are there, which alone count."""

    def __init__(self, built, layers, path, period, mark=None):
        section = built.section
        self._slope, self._side = built, section.side
        self._of_role = {role: [wall.name for wall in section.of_role(role)] for role in roles.ROLES}
        # of slip surfaces one above another the sum is over the lowest: the others bear the same weight again
        self._lowest = [one.name for one in section.lowest_surfaces]
        self._of_role["slip"] = [name for name in self._of_role["slip"] if name in self._lowest]
        # a role that several walls share has a sum, and a peak, of its own
        shared = {
            (role,): [i for name in names for i in built.walls[name]]
            for role, names in self._of_role.items()
            if len(names) > 1
        }
        self._forces = WallForces({**built.walls, **shared}, period)
        self._interfaces = [(i, *section.numbers_of(i), slope.interface_law(built, i)) for i in section.interfaces]
        self._obstacles = [(layer.name, k) for k, layer in enumerate(section.layers) if layer.role == "obstacle"]
        self._layer_of = np.concatenate([np.full(built.first_disk, -1), layers])  # by body; -1: a wall
        self.there = np.arange(built.count)
        self.file = records.SeriesWriter(path, WALL_COLUMNS, resume_from=mark, overwrite=True)

    def forget(self):
        """Begins anew."""
        self._forces.forget()

    def hold(self):
        """Lets walls with slip laws keep the friction before slip until :meth:`forget_slip`: settling is how a slope is
        loaded, and nothing that its slip surface has been through.
        """
        self._set_held(True)

    def forget_slip(self):
        """Sets the slip along all walls and interfaces to zero; from now on slip laws act."""
        for material in self._laws().values():
            if hasattr(material, "forgetSlip"):
                material.forgetSlip()
        self._set_held(False)

    def _set_held(self, held):
        for material in self._laws().values():
            if hasattr(material, "held"):
                material.held = held

    def take(self):
        """Writes the rows of the time since the last call. Returns {role: (normal force, shear force where walls hold
        the mass back, peak of the normal force)} [N/m], zero where no wall, and no interface, has that role; and the
        same of each slip surface, {name: …}, where some lie one above another.
        """
        forces = {
            name: (normal, self._side * shear, peak) for name, (normal, shear, peak) in self._forces.take().items()
        }
        inside = self._between_disks()
        laws, slid = self._laws(), self._slid()
        rows = {name: forces[name] for name in self._slope.walls} | inside
        self.file.write(
            *(
                self._row(
                    name,
                    *force,
                    self._slip([laws[name]] if name in laws else []),
                    slid.get(name),
                    getattr(laws.get(name), "heat", None),
                )
                for name, force in rows.items()
            )
        )
        found = {
            role: forces[names[0] if len(names) == 1 else (role,)] if names else (0.0, 0.0, 0.0)
            for role, names in self._of_role.items()
        }
        for interface, *_ in self._interfaces:
            if interface.name in self._lowest:
                found["slip"] = tuple(a + b for a, b in zip(found["slip"], inside[interface.name]))
        return found, {name: rows[name] for name in self._slope.section.stacked}

    def slip(self, *names):
        """The Slip of disks along slip surfaces of these names, the lowest where none is given."""
        laws = self._laws()
        return self._slip([laws[name] for name in names or self._lowest])

    def weakened(self):
        """Whether the disks' slip along each wall and interface that weakens has passed D_c, as
        :attr:`.section.Section.weakening` has them: bool (count, number of those).
        """
        laws, built = self._laws(), self._slope
        found = [
            tables.slip(laws[one.name], built.first_disk, built.count) >= laws[one.name].criticalSlip
            for one in built.section.weakening
        ]
        return np.stack(found, axis=1) if found else np.zeros((built.count, 0), bool)

    def _laws(self):
        """{name: material} of all walls and interfaces."""
        return {name: self._slope.wall_material(name) for name in self._slope.walls} | {
            i.name: law for i, _, _, law in self._interfaces
        }

    def _between_disks(self):
        """{name: (normal, shear, normal again)} [N/m] of interfaces and obstacles in this step."""
        if not self._interfaces and not self._obstacles:
            return {}
        c = tables.contacts(self._slope.solver)
        # on the second body
        force = np.stack(
            [c["normal"] * c["nx"] - c["tangential"] * c["ny"], c["normal"] * c["ny"] + c["tangential"] * c["nx"]]
        )
        one, other = self._layer_of[c["id1"]], self._layer_of[c["id2"]]
        section, found = self._slope.section, {}
        for interface, lower, upper, _ in self._interfaces:
            on_upper = force[:, (one == lower) & (other == upper)].sum(axis=1) - force[
                :, (one == upper) & (other == lower)
            ].sum(axis=1)
            normal, shear = float(on_upper @ section.normal), -float(on_upper @ section.downslope)
            found[interface.name] = (normal, shear, normal)
        for name, k in self._obstacles:
            on_it = force[:, (other == k) & (one != k) & (one >= 0)].sum(axis=1) - force[
                :, (one == k) & (other != k) & (other >= 0)
            ].sum(axis=1)
            push = self._side * float(on_it[0])
            found[name] = (push, -float(on_it[1]), push)
        return found

    def _slid(self):
        """{name: energy dissipated by sliding on a wall [J/m]}; empty in a world that does not tell it."""
        losses = getattr(self._slope.solver, "wallSlidingLoss", None)
        if losses is None:
            return {}
        return {name: math.fsum(losses[i] for i in ids if i < len(losses)) for name, ids in self._slope.walls.items()}

    def _row(self, name, normal, shear, peak, slip, slid, heat):
        told = (
            (slip.mean, slip.weakened, slip.weakened / slip.touched if slip.touched else 0.0)
            if slip.counts
            else (None, None, None)
        )
        return dict(zip(WALL_COLUMNS, (O.iter, O.time, name, normal, shear, peak, *told, slid, heat), strict=True))

    def _slip(self, materials):
        """The Slip along walls or interfaces of these materials, those that do not weaken apart."""
        weak = [m for m in materials if hasattr(m, "meanSlip")]
        of_each = [self._slip_of(m) for m in weak]
        touched = sum(one.touched for one in of_each)
        mean = (
            of_each[0].mean
            if len(weak) == 1
            else sum(one.mean * one.touched for one in of_each) / touched
            if touched
            else 0.0
        )
        return Slip(mean, sum(one.weakened for one in of_each), touched, bool(weak))

    def _slip_of(self, material):
        """The Slip along one that weakens; it knows that of disks which are gone too."""
        built = self._slope
        if len(self.there) == built.count:
            return Slip(material.meanSlip(), material.weakenedCount(), material.slippedCount(), True)
        slip = tables.slip(material, built.first_disk, built.count)[self.there]
        touched, weakened = np.count_nonzero(slip > 0), np.count_nonzero(slip >= material.criticalSlip)
        return Slip(float(slip.sum()) / touched if touched else 0.0, weakened, touched, True)
