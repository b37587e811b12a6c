"""The packing of a slope: layers filled with disks and, where the section asks for it (``disks.pressed``), pressed
until they carry.

A packing is made just short of touching (:mod:`.packing`). Pressed, its disks are let go without any friction, of their
own and of walls, and without bonds, each drawn by its weight along the normal of the nearest free face
(:mod:`.free_surface`): so the surface stays where it is whatever its shape, the crown and the toe need no hold, and
layers stay as flat as they were. Disks without friction come to rest in the densest places that the packing allows, as
those of the laboratory's pressed samples do (:mod:`.laboratory.pressing`; paper, 3.2.2: the pore volume should be low).
The layers are filled higher by what pressing takes, so that they have the section's thickness after it.

It ends when in a time of √(H/g), H the greatest depth, the mean depth of the mass has grown by less than :data:`CALM`
of itself, after :data:`LONGEST` such times at the latest.
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from yade import O
from yade.wrapper import NewtonIntegrator

from ... import packing
from ...model import free_surface
from ...model.section import similar
from ...packing.files import Packing
from ...system import keys
from ...world import tables
from ...world.stepping import advance
from . import slope

__all__ = ["CALM", "LONGEST", "cache_path", "of", "press"]

CALM = 1e-4
LONGEST = 12
TOLERANCE, MAX_ITERATIONS = 1e-5, 1000


def of(section, seed: int | None = None, progress=None) -> Packing:
    """The packing of a Section, made now or taken from the cache; one that is pressed is made in the running scene,
    which it empties.

    ``progress``: called now and then with a share done, 0 to 1. Raises what :func:`.packing.pack` raises.
    """
    if not section.pressed:
        return packing.cached_pack(section, seed, progress)
    if section.like:
        original, factor = section.like
        return similar.scaled_packing(of(original, section.seed if seed is None else seed, progress), factor)
    if section.side < 0:
        return similar.mirrored_packing(of(similar.mirrored(section), seed, progress))
    progress = progress or (lambda share: None)

    def make():
        loose = packing.cached_pack(section, seed, lambda share: progress(0.2 * share))
        return press(section, loose, lambda share: progress(0.2 + 0.8 * share))

    return packing.CACHE.of(cache_path(section, seed), make)


def cache_path(section, seed: int | None = None):
    """Where a pressed packing is kept: beside the packings. Other engines and other code press their own, so that a run
    has the same bits with and without a cache from earlier ones."""
    n = section.numerics
    key = keys.key_of(
        [section.key(), section.gravity, n.time_step, n.path, n.verlet_distance, keys.making_key(__name__)]
    )
    return packing.CACHE.path(key, f"-{section.seed if seed is None else seed}-pressed")


def press(section, made, progress=None) -> Packing:
    """A Packing of the Section, pressed in the running scene, which is emptied before and after."""
    built = slope.build(_smooth(section), made)
    order = slope.order_of(section, made)
    weight = made.r[order] ** 2 / math.fsum(made.r**2)
    newton = next(e for e in O.engines if isinstance(e, NewtonIntegrator))
    newton.gravity = (0, 0, 0)
    way, depth = free_surface.inward(section, made.x[order], made.y[order])
    mean, span = math.fsum(weight * depth), math.sqrt(float(depth.max()) / section.gravity)
    for k in range(LONGEST):
        _pull(built, section.gravity, way)
        advance(until=(k + 1) * span)
        t = tables.bodies(built.solver)
        way, depth = free_surface.inward(section, t["x"], t["y"])
        before, mean = mean, math.fsum(weight * depth)
        if progress:
            progress((k + 1) / LONGEST)
        if mean - before < CALM * mean:
            break
    places = np.empty((2, len(made)))
    places[:, order] = t["x"], t["y"]
    O.reset()
    return Packing(*places, made.r, made.layer)


def _pull(built, gravity, way):
    """Lets every disk be drawn by its weight along unit vectors (n, 2)."""
    for k, n in enumerate(way):
        pull = O.bodies[built.first_disk + k].state.mass * gravity * n
        O.forces.setPermF(built.first_disk + k, (float(pull[0]), float(pull[1]), 0))


def _smooth(section):
    """The Section with all frictions and strengths gone, and without water."""
    nothing = dict.fromkeys(
        (
            "friction",
            "residual_friction",
            "rolling_friction",
            "residual_rolling_friction",
            "tensile_strength",
            "residual_tensile_strength",
            "restitution",
        ),
        0.0,
    )
    materials = {
        name: dataclasses.replace(m, bonded=False, slip_weakening=None, slip_law=None, **nothing)
        for name, m in section.materials.items()
    }
    numerics = dataclasses.replace(section.numerics, tolerance=TOLERANCE, max_iterations=MAX_ITERATIONS)
    return dataclasses.replace(section, materials=materials, water=None, numerics=numerics)
