"""Samples of triaxial tests as they are before: spheres of a random cloud, pressed on all sides until they bear, with
hard contacts; made once and kept, so that both worlds begin with the same places.

Hard spheres know no stress of their own: under any pressure they come to rest in the same places. So a sample is made
under one pressure, whose value sets the unit of time t_i alone.

First plates and spheres move towards one corner as one shrinking body, at the rate :data:`RATE`/t_i, so that the sample
stays uniform; where the plates bear half of the pressure, they are let free under the whole of it.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace

import numpy as np

from yade import O

from ...system import cache, keys
from ...world import sphere_worlds as worlds
from ...world.scene import contact_dynamics
from ...world.stepping import until
from . import scene as scenes
from .cell import Cell
from .grains import SpheresError

__all__ = ["CACHE", "PLATE_MASS", "PressedSpheres", "cache_path", "come_to_rest", "pressed"]

PRESSURE = 1e5  # Pa
RATE = 0.02  # 1/t_i
PATH = 0.1  # t_i, of a step
PLATE_MASS = 0.05  # of the spheres' mass, of a plate that bears the pressure
# of the pressure, on the plates at which they are let free, a mean over so many steps: plates that are driven crush what
# bears within some more
MET, MET_STEPS = 0.5, 2
# tolerances of the solver, and speeds in units of √(p/ρ) that half of the spheres have at most where it comes to them
# (rattlers fly about for long): what the solver leaves open agitates spheres without friction, as much as it is
STAGES = ((1e-4, 1e-2), (1e-5, 1e-3))
REST_STRESS = 0.01  # p, what the mean on each plate may differ from it at rest
CHUNK = 40  # steps over which that mean is taken
LIMIT = 20_000  # steps of a stage
#: Parameters that do not matter to hard spheres before the test.
LATER = ("restitution", "pressure", "strain", "inertia")


@dataclass(frozen=True, eq=False)
class PressedSpheres:
    """Spheres at rest: centres ``at`` (n, 3) and radii ``r`` (n,) [m] in a cell with the ``edges`` (3,) [m], in whose
    middle the origin is.
    """

    at: np.ndarray
    r: np.ndarray
    edges: np.ndarray


CACHE = cache.Cache("samples", PressedSpheres)


def cache_path(test):
    """Where the pressed sample of a TriaxialTest is kept: by its parameters, engines and code."""
    plain = {key: value for key, value in test.plain().items() if key not in LATER}
    return CACHE.path(keys.key_of([plain, keys.making_key(__name__)]))


def pressed(test):
    """The :class:`PressedSpheres` sample of a TriaxialTest, from the cache or made in the running scene, which is emptied.

    Raises SpheresError where the spheres do not come to rest.
    """
    return CACHE.of(cache_path(test), lambda: _press(test))


def come_to_rest(cell, bodies, density, speed, limit, every):
    """Goes on until half of the spheres have at most a ``speed`` [√(p/ρ)] under the pressure of the cell and all plates
    bear it, or ``limit`` steps; whether it came to that. ``every``: steps between two looks.
    """
    pressure, least = cell.pressure, max(1, every // CHUNK)
    mean = np.zeros(6)

    def chunk(_):
        mean[:] = 0
        parts = range(0, every, least)
        for _ in parts:
            cell.advance(least)
            mean[:] += cell.stresses() / len(parts)

    def calm():
        slow = np.median(scenes.places(bodies).speed) < speed * np.sqrt(pressure / density)
        return slow and np.all(np.abs(mean / pressure - 1) < REST_STRESS)

    return until(calm, limit, every, chunk)


def _press(test):
    at, r = test.sites(test.radii()), test.radii()
    order = np.lexsort(at.T[[1, 0, 2]])  # neighbours in space are neighbours in memory
    at, r = at[order], r[order]
    own = replace(test, pressure=PRESSURE, restitution=0.0)
    share = {name: test.friction_share * getattr(test, name) for name in scenes.FRICTIONS}
    world = worlds.HardSpheres(PATH * own.unit, STAGES[0][0])
    edges = np.full(3, test.cloud(r))
    low = -0.5 * edges
    bodies = scenes.put(replace(own, **share), world, at + low, r, edges)
    cell, rate, mass = Cell(PRESSURE), RATE / own.unit, 0.0
    for k, place in enumerate(at):
        body = O.bodies[bodies.first + k]
        body.state.vel = tuple(float(v) for v in -rate * place)
        mass += body.state.mass
    for axis in range(3):
        cell.drive(axis, -rate * edges[axis])
    mean = np.zeros(6)

    def shrink(steps):
        mean[:] = 0
        for _ in range(steps):
            cell.advance(1)
            mean[:] += cell.stresses() / steps

    met = until(lambda: mean.mean() > MET * PRESSURE, LIMIT, MET_STEPS, shrink)
    for axis in range(3):
        cell.free(axis, PLATE_MASS * mass)
    rests = met
    for tolerance, speed in STAGES:
        contact_dynamics().tolerance = tolerance
        rests = rests and come_to_rest(cell, bodies, test.density, speed, LIMIT, CHUNK)
    if not rests:
        raise SpheresError(
            f"the sample does not come to rest under pressure in {LIMIT} steps: stresses on the plates "
            f"{', '.join(f'{s / PRESSURE:.3f}' for s in cell.stresses())} of it; try another seed"
        )
    middle, found = cell.low() + 0.5 * cell.edges(), scenes.places(bodies)
    made = PressedSpheres(found.at - middle, found.r, cell.edges())
    O.reset()
    return made
