"""Contact problems in space made from arrays of spheres, without YADE: small random clusters, and a bed."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from ....contact import SpaceProblem
from ..grains import draw_strengths, touching

__all__ = ["bed", "of_other_bodies", "of_spheres", "random_cluster"]

FLOOR = (0, 0, 0, 0, 0, 1)
DOWN = np.array([0.0, 0.0, -1.0])


def of_spheres(
    place,
    r,
    walls=(),
    *,
    inverse_mass=None,
    turning=None,
    free_velocity=None,
    density=2500.0,
    gravity=9.81,
    time_step=5e-3,
    reach=0.05,
    relaxation=0.2,
    friction=0.3,
    rolling=0.0,
    twisting=0.0,
) -> SpaceProblem:
    """The first step of spheres at rest, or with ``free_velocity`` (n, 6), by the same formulas as the engine's.

    ``place``: (n, 3) [m]; ``r``: (n,) [m]; ``walls``: half-spaces (a point, the normal into the free side), six numbers
    each; they become fixed bodies after the spheres. ``inverse_mass``: (n, 3) [1/kg], and ``turning``: (n,), inverse
    moments of inertia [1/(kg m²)], default from ``density`` [kg/m³]; ``reach``: largest gap of a contact [m];
    ``relaxation``: share of an overlap taken back; ``friction``, ``rolling``, ``twisting``: μ_s, μ_r and μ_tw. No
    cohesion. Impulses and velocities of the solution are zero.
    """
    place, r = np.asarray(place, float), np.asarray(r, float)
    count, fixed = len(r), len(walls)
    mass = density * 4 / 3 * math.pi * r**3
    inverse_mass = np.column_stack([1 / mass] * 3) if inverse_mass is None else inverse_mass
    turning = 2.5 / (mass * r**2) if turning is None else turning
    if free_velocity is None:
        free_velocity = np.tile(np.append(gravity * time_step * DOWN, np.zeros(3)), (count, 1))
    free_velocity = np.vstack([free_velocity, np.zeros((fixed, 6))])
    turning = np.append(turning, np.zeros(fixed))
    there = touching(place, r, walls, reach)
    contacts = len(there.gap)
    bias = np.zeros((contacts, 7))
    bias[:, 0] = np.where(there.gap > 0, 1.0, relaxation) * there.gap / time_step
    return SpaceProblem(
        time_step=time_step,
        inverse_mass=np.vstack([inverse_mass, np.zeros((fixed, 3))]),
        inverse_inertia=np.column_stack([turning] * 3 + [0 * turning] * 3),
        free_velocity=free_velocity,
        velocity=free_velocity.copy(),
        body=there.body,
        normal=there.normal,
        lever=there.arm,
        bias=bias,
        adhesion=np.zeros(contacts),
        friction=np.full(contacts, float(friction)),
        rolling_arm=rolling * there.length,
        twisting_arm=twisting * there.length,
        length=there.length,
        warm_start=np.zeros((contacts, 6)),
        impulse=np.zeros((contacts, 6)),
        position=np.vstack([place, np.reshape([wall[:3] for wall in walls], (-1, 3))]),
    )


def bed(columns, rows, *, seed=1, rolling=0.0) -> SpaceProblem:
    """A step of gravity on ``rows`` layers of ``columns`` by ``columns`` spheres, in each other's hollows, on a floor
    between four walls.

    Radii differ by 2 %. Neighbours touch that are nearest to each other, some nine of each; they count as closed, for
    over their gaps of millimetres nothing would touch in a step.
    """
    c, b, a = np.mgrid[:rows, :columns, :columns].reshape(3, -1)
    place = np.column_stack([a + 0.5 * ((b + c) % 2), math.sqrt(0.75) * (b + (c % 2) / 3), 0.5 + c * math.sqrt(2 / 3)])
    r = np.random.default_rng(seed).uniform(0.49, 0.502, len(place))
    low, high = place.min(axis=0) - 0.5, place.max(axis=0) + 0.5
    sides = [(*(low if sign > 0 else high), *(sign * np.eye(3)[axis])) for axis in (0, 1) for sign in (1, -1)]
    problem = of_spheres(place, r, [FLOOR, *sides], reach=0.012, rolling=rolling)
    problem.bias[:] = 0
    return problem


def random_cluster(seed, spheres, *, rolling=False, twisting=False, cohesion=False) -> SpaceProblem:
    """A step of ``spheres`` spheres that fly at each other and at a floor: radii, masses, places, velocities and
    strengths by chance.

    A fifth of the spheres cannot turn, and without rolling resistance one in eight of the others cannot move along x,
    so that blocks of W are not all of one form. ``rolling``, ``twisting``, ``cohesion``: contacts have these, a third
    of them none.
    """
    dice = np.random.default_rng(seed)
    place, r = _touching(dice, spheres)
    mass = dice.uniform(1000, 4000, spheres) * 4 / 3 * math.pi * r**3
    inverse_mass, turning = np.column_stack([1 / mass] * 3), 2.5 / (mass * r**2)
    turning[dice.random(spheres) < 0.2] = 0
    inverse_mass[(dice.random(spheres) < 0.125) & (turning > 0) & (not rolling), 0] = 0
    velocity = dice.normal(0, 1, (spheres, 6)) + np.append(DOWN, np.zeros(3))
    velocity[:, :3][inverse_mass == 0] = 0  # what is held does not move
    velocity[turning == 0, 3:] = 0
    problem = of_spheres(
        place, r, [FLOOR], inverse_mass=inverse_mass, turning=turning, free_velocity=velocity, reach=0.03
    )
    stops = mass.mean()  # a sphere of 1 m/s
    draw_strengths(problem, dice, stops, rolling=rolling, twisting=twisting, cohesion=cohesion)
    return problem


def of_other_bodies(problem, seed) -> SpaceProblem:
    """The same problem of bodies that are no spheres: full tensors of inertia, and arms with a part across the normal, by
    chance. What cannot turn still cannot.
    """
    dice = np.random.default_rng(seed)
    inertia = problem.inverse_inertia.copy()
    for b, size in enumerate(inertia[:, 0]):
        axes = np.linalg.qr(dice.normal(size=(3, 3)))[0]
        tensor = size * axes @ np.diag(dice.uniform(0.4, 1.0, 3)) @ axes.T
        inertia[b] = tensor[[0, 1, 2, 1, 2, 0], [0, 1, 2, 2, 0, 1]]
    n = problem.normal
    arms = 0.3 * problem.length[:, None, None] * dice.normal(size=(len(n), 2, 3))
    arms -= np.einsum("cad,cd->ca", arms, n)[:, :, None] * n[:, None]
    return dataclasses.replace(problem, inverse_inertia=inertia, aside=arms.reshape(-1, 6))


def _touching(dice, spheres):
    """Spheres put one after the other, each near contact with up to three bodies already there: (places, radii)."""
    r = dice.uniform(0.3, 0.7, spheres)
    place = [np.array([0.0, 0.0, r[0] + dice.uniform(-0.002, 0.01)])]
    while len(place) < spheres:
        k, there = len(place), np.array(place)
        first = dice.integers(k)
        nearest = np.argsort(np.linalg.norm(there - there[first], axis=1), kind="stable")[1:9]
        others = dice.permutation(np.append(nearest, -1))[:2]  # -1: the floor
        reach = r[:k] + r[k] + dice.uniform(-0.002, 0.01, k)
        height = r[k] + dice.uniform(-0.002, 0.01)
        # planes that the new centre lies on, as seen from the first sphere's: the floor's, radical planes, one by chance
        planes = [(dice.normal(size=3), 0.0), (dice.normal(size=3), 0.0)]
        for other in others:
            way = there[other] - there[first]
            radical = 0.5 * (reach[first] ** 2 - reach[other] ** 2 + way @ way)
            planes.append((-DOWN, height - there[first, 2]) if other < 0 else (way, radical))
        normals, offsets = (np.array(v) for v in zip(*planes[-2:]))
        foot, along = np.linalg.lstsq(normals, offsets, rcond=None)[0], np.cross(*normals)
        square = reach[first] ** 2 - foot @ foot
        if square < 0 or not along.any():
            continue
        new = there[first] + foot + dice.choice([-1, 1]) * math.sqrt(square) / np.linalg.norm(along) * along
        if new[2] >= r[k] - 0.002 and np.all(np.linalg.norm(there - new, axis=1) >= r[:k] + r[k] - 0.002):
            place.append(new)
    return np.array(place), r
