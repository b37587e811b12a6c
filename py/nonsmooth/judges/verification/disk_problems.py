"""Contact problems made from arrays of disks, without YADE: one step of a packing, and small random clusters."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from ...contact import ContactProblem
from .grains import draw_strengths, touching

__all__ = ["below", "of_disks", "random_cluster"]


def of_disks(
    x,
    y,
    r,
    walls=(),
    *,
    inverse_mass=None,
    free_velocity=None,
    density=2500.0,
    gravity=9.81,
    time_step=5e-3,
    reach=0.05,
    relaxation=0.2,
    friction=0.3,
    rolling=0.1,
) -> ContactProblem:
    """The first step of disks at rest, or with ``free_velocity`` (n, 3), by the same formulas as the engine's.

    ``x, y, r``: (n,) [m]; ``walls``: half-planes (x, y, n_x, n_y) with the normal into the free side; they become fixed
    bodies after the disks. ``inverse_mass``: (n, 3), default from ``density`` [kg/m³]; ``reach``: largest gap of a
    contact [m]; ``relaxation``: share of an overlap taken back; ``friction``, ``rolling``: μ_s and μ_r. No cohesion.
    Impulses and velocities of the solution are zero.
    """
    x, y, r = (np.asarray(v, float) for v in (x, y, r))
    count = len(x)
    if inverse_mass is None:
        mass = density * math.pi * r**2
        inverse_mass = np.column_stack([1 / mass, 1 / mass, 2 / (mass * r**2)])
    if free_velocity is None:
        free_velocity = np.tile([0.0, -gravity * time_step, 0.0], (count, 1))
    there = touching(np.column_stack([x, y]), r, walls, reach)
    gap, length, none = there.gap, there.length, np.zeros(len(there.gap))
    fixed = np.zeros((len(walls), 3))
    bias = np.zeros((len(gap), 3))
    bias[:, 0] = np.where(gap > 0, 1.0, relaxation) * gap / time_step
    places = np.vstack([np.column_stack([x, y]), np.reshape([w[:2] for w in walls], (-1, 2))])
    free_velocity = np.vstack([free_velocity, fixed])
    return ContactProblem(
        time_step=time_step,
        inverse_mass=np.vstack([inverse_mass, fixed]),
        free_velocity=free_velocity,
        velocity=free_velocity.copy(),
        body=there.body,
        normal=there.normal,
        lever=np.column_stack([none, there.arm[:, 0], none, there.arm[:, 1]]),
        bias=bias,
        adhesion=np.zeros(len(gap)),
        friction=np.full(len(gap), float(friction)),
        rolling_arm=rolling * length,
        length=length,
        warm_start=np.zeros((len(gap), 3)),
        impulse=np.zeros((len(gap), 3)),
        position=places,
    )


def below(problem, height) -> ContactProblem:
    """The problem with the contacts alone whose disks have their centres below a height [m]."""
    moves = problem.inverse_mass.any(axis=1)
    kept = np.all((problem.position[problem.body, 1] < height) | ~moves[problem.body], axis=1)
    own = {field.name for field in dataclasses.fields(problem)} - {
        "time_step",
        "inverse_mass",
        "free_velocity",
        "velocity",
        "position",
    }
    return dataclasses.replace(
        problem, **{name: value[kept] for name in own if (value := getattr(problem, name)) is not None}
    )


def random_cluster(seed, disks, *, rolling=False, cohesion=False) -> ContactProblem:
    """A step of ``disks`` disks that fly at each other and at a floor: radii, masses, places, velocities and strengths
    by chance.

    A fifth of the disks cannot turn and without rolling resistance one in eight cannot move sideways, so that blocks of
    W are not all of one form (with rolling resistance such a block is singular, which Siconos refuses). ``rolling``,
    ``cohesion``: contacts have these, a third of them none.
    """
    dice = np.random.default_rng(seed)
    x, y, r = _touching(dice, disks)
    mass = dice.uniform(1000, 4000, disks) * math.pi * r**2
    inverse_mass = np.column_stack([1 / mass, 1 / mass, 2 / (mass * r**2)])
    inverse_mass[dice.random(disks) < 0.2, 2] = 0
    inverse_mass[(dice.random(disks) < 0.125) & (not rolling), 0] = 0
    velocity = dice.normal(0, 1, (disks, 3)) - [0, 1, 0]
    velocity[inverse_mass == 0] = 0  # what is held does not move
    problem = of_disks(x, y, r, [(0, 0, 0, 1)], inverse_mass=inverse_mass, free_velocity=velocity, reach=0.03)
    stops = mass.mean()  # a disk of 1 m/s
    draw_strengths(problem, dice, stops, rolling=rolling, cohesion=cohesion)
    return problem


def _touching(dice, disks):
    """Disks put one after the other, each near contact with two bodies already there: (x, y, r)."""
    r = dice.uniform(0.3, 0.7, disks)
    x, y = [0.0], [r[0] + dice.uniform(-0.002, 0.01)]
    while len(x) < disks:
        k, own = len(x), r[len(x)]
        i, j = dice.integers(0, k, 2)
        gaps = dice.uniform(-0.002, 0.01, 2)
        if i == j:  # the floor is the second body
            b, a = own + gaps[0], r[i] + own + gaps[1]
            if abs(b - y[i]) >= a:
                continue
            px, py = x[i] + dice.choice([-1, 1]) * math.sqrt(a**2 - (b - y[i]) ** 2), b
        else:
            a, b, d = r[i] + own + gaps[0], r[j] + own + gaps[1], math.hypot(x[j] - x[i], y[j] - y[i])
            if d >= a + b or d <= abs(a - b):
                continue
            along = (a**2 - b**2 + d**2) / (2 * d)
            across = dice.choice([-1, 1]) * math.sqrt(max(0.0, a**2 - along**2))
            ex, ey = (x[j] - x[i]) / d, (y[j] - y[i]) / d
            px, py = x[i] + along * ex - across * ey, y[i] + along * ey + across * ex
        if py < own - 0.002 or any(math.hypot(px - x[m], py - y[m]) < r[m] + own - 0.002 for m in range(k)):
            continue
        x.append(px)
        y.append(py)
    return np.array(x), np.array(y), r
