"""The course of a triaxial test in a world: the pressed sample comes to rest under σ₃, then the plate at high z is
driven down while those at high x and y bear σ₃; rows, places and checkpoints in a folder (:mod:`recorded_course`).

The driven plate comes to its speed over the strain :data:`RAMP`, as in the biaxial test.
"""

from __future__ import annotations

import numpy as np

from yade import O

from ...measure import triaxial as measures
from ...system import checks
from . import pressing, scene as scenes
from .cell import PLATES, Cell
from .grains import SpheresError, world_of
from .recorded_course import RecordedCourse, follow
from .triaxial import TriaxialTest

__all__ = ["ROW_STRAIN", "run"]

RAMP = 0.002  # strain in which the driven plate reaches its speed
ROW_STRAIN = 0.002  # between two rows
PARTS = 20  # of a row, after each of which the forces on the plates are read, with soft contacts; else each step
REST_LIMIT, REST_EVERY = 500.0, 4.0  # t_i, of the rest before the test and between two looks
REST_SPEED = 1e-2  # √(p/ρ), that half of the spheres have at most then: the sample has come to rest before
# mean diameters from the plates, of the boxes over which is measured: over one layer of spheres that lie along a plate,
# so that layers do not count; no more than a part of an edge
MARGINS, MOST_MARGIN = (2.0, 2.25, 2.5, 2.75), 0.3


class TriaxialCourse(RecordedCourse):
    """From rest under σ₃ to the end."""

    NAME = "test"

    def __init__(self, test, world, duration, folder, progress, told):
        super().__init__(test, world, duration, folder, progress, told)
        self.cell = Cell(test.pressure)
        if told["series"] is None:
            self._frame()

    @property
    def unit(self):
        """That of the inertial number, t_i [s]."""
        return self.scene.unit

    @property
    def strain(self):
        """Axial strain so far."""
        return 1 - float(self.cell.edges()[2]) / self.state["edges"][2]

    def _ended(self):
        return self.strain >= self.scene.strain - 0.5 * ROW_STRAIN

    _over = _ended

    def _where(self):
        return f"at a strain of {self.strain:.3f} of {self.scene.strain:g}"

    def _steps(self):
        """Those of a row; returns the mean stresses on the plates [Pa], (6,)."""
        every = max(1, round(ROW_STRAIN / self.scene.rate / O.dt))
        parts = np.array_split(np.arange(every), every if self.world.name == "hard" else min(every, PARTS))
        mean = np.zeros(6)
        for part in parts:
            self._drive(len(part))
            self.cell.advance(len(part))
            mean += self.cell.stresses() / len(parts)
        return mean

    def _drive(self, steps):
        """The speed grows with the time until half of twice RAMP's strain, as in the biaxial test."""
        share = min(1.0, (self.now + 0.5 * steps * O.dt) * self.scene.rate / (2 * RAMP))
        self.cell.drive(2, -share * self.scene.rate * self.state["edges"][2])

    def _look(self, mean):
        found = self._seen()
        s, test, edges = self.state, self.scene, self.cell.edges()
        low = self.cell.low()
        gaps = [
            one
            for k in range(3)
            for one in (found.at[:, k] - low[k] - found.r, low[k] + edges[k] - found.at[:, k] - found.r)
        ]
        tensor, inner = measured(test, self.cell, self.bodies, found)
        speed = abs(self.cell.high(2).vel[2])
        own = {
            "strain": self.strain,
            "volumetric_strain": float(np.prod(edges) / np.prod(s["edges"])) - 1,
            **{f"sigma_{name}_Pa": float(value) for name, value in zip(PLATES, mean)},
            "contacts_sigma1_Pa": float(tensor[2, 2]),
            "contacts_sigma3_Pa": float(0.5 * (tensor[0, 0] + tensor[1, 1])),
            **inner,
            "inertial_number": speed / float(edges[2]) * test.unit,
        }
        self._row(found, np.ones(len(found), bool), gaps, own)
        self._frame()
        self.progress(min(1.0, self.strain / test.strain))

    def _frame(self):
        kept, frames = self.state["kept"], self.scene.FRAMES
        if kept < len(frames) and self.strain >= frames[kept] - 1e-9 and not self._over():  # the end is kept anyway
            self._write(self._places())
            self.state["kept"] += 1

    def _results(self, series):
        return self.scene.results(series, self.state)


def measured(test, cell, bodies, found):
    """The stress tensor (3, 3) [Pa] by the contacts, and what is measured in the middle of the sample, as the columns
    have it; ``found``: the Places now.
    """
    contacts, edges, low = scenes.contacts(bodies), cell.edges(), cell.low()
    # a sphere in equilibrium has four contacts without friction, and two with it
    there, number = measures.backbone(
        contacts["first"], contacts["second"], contacts["normal"], len(found), 2 if test.friction > 0 else 4
    )
    rows = []
    for margin in MARGINS:
        away = np.minimum(margin * test.diameter, MOST_MARGIN * edges)
        box = low + away, low + edges - away
        inside = np.all((found.at > box[0]) & (found.at < box[1]), axis=1)
        rows.append((measures.solid_fraction(found.at, found.r, *box), *measures.coordination(there, number, inside)))
    means = (float(mean) for mean in np.mean(rows, axis=0))
    tensor = measures.stress(contacts["force"], contacts["branch"], float(np.prod(edges)))
    return tensor, dict(zip(("solid_fraction", "coordination", "rattlers"), means))


def _begin(test, world):
    """Puts the pressed sample into the world and lets it rest; what a :class:`TriaxialCourse` begins with."""
    ready = pressing.pressed(test)
    bodies = scenes.put(test, world, ready.at, ready.r, ready.edges)
    mass = sum(O.bodies[k].state.mass for k in range(bodies.first, bodies.first + bodies.count))
    cell = Cell(test.pressure)
    for axis in range(3):
        cell.free(axis, pressing.PLATE_MASS * mass)
    every = max(pressing.CHUNK, round(REST_EVERY * test.unit / O.dt))
    limit = round(REST_LIMIT * test.unit / O.dt)
    if not pressing.come_to_rest(cell, bodies, test.density, REST_SPEED, limit, every):
        told = ", ".join(f"{s / test.pressure:.3f}" for s in cell.stresses())
        raise SpheresError(
            f"the sample does not come to rest under {test.pressure:g} Pa in the {world.name} world: stresses on the plates are {told} of it; "
            "give a smaller time step or tolerance, or more damping"
        )
    tensor, isotropic = measured(test, cell, bodies, scenes.places(bodies))
    isotropic |= {"pressure_rel": float(np.trace(tensor)) / 3 / test.pressure}
    edges = [float(e) for e in cell.edges()]
    isotropic["solid_fraction_whole"] = float(4 / 3 * np.pi * np.sum(ready.r**3) / np.prod(edges))
    state = {"begin": O.iter, "edges": edges, "kept": 0, "spheres": len(ready.r), "isotropic": isotropic}
    return {"state": state | {"wall_s": 0.0, "wall_steps_s": 0.0}, "bodies": bodies.plain(), "series": None}


@checks.takes(SpheresError, test=checks.kind(TriaxialTest, "give a TriaxialTest"))
def run(test, world=None, folder=None, progress=lambda share: None) -> dict:
    """Runs a TriaxialTest in a ``world`` (of :mod:`.sphere_worlds`; None: :func:`.spheres.grains.world_of` of the
    test) with records in ``folder``; returns the numbers of the run, a dictionary that JSON can hold.

    A checkpoint in the folder is gone on from. ``progress``: called with the share of it that is done. Written:
    series.csv, ``snapshots`` (:mod:`.spheres.places`), and ``checkpoint``. Raises SpheresError or SphereWorldError for
    what cannot be used, for a sample that does not come to rest, and for a checkpoint of another test.
    """
    world = world_of(test) if world is None else world
    test.check_world(world)
    return follow(TriaxialCourse, _begin, test, world, None, folder, progress)
