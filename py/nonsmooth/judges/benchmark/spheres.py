"""Sweeps in space beside those in the plane, over packings that are made here: neither a slope nor YADE is needed.

Spheres lie in layers in each other's hollows in a box, disks in rows. Their radii differ by some percent, and of
each grain's neighbours those touch that are nearest to it. One step of gravity is solved from no impulses.
"""

from __future__ import annotations

import numpy as np

from ... import contact
from ...measure.statistics import spread
from . import sweeps

__all__ = ["disks", "measure", "spheres"]

STEP, GRAVITY, DENSITY = 5e-3, 9.81, 2500.0
FRICTION, ROLLING, TWISTING = 0.3, 0.05, 0.05
REACH = 0.012  # gaps [m] of grains of a metre that count as touching: with it a sphere touches nine others
COLD_TOLERANCE = 1e-4


def _grains(place, dice):
    """Radii of grains at places, and the pairs that touch: (n,), (c, 2)."""
    from scipy.spatial import cKDTree

    radius = dice.uniform(0.49, 0.502, len(place))
    pairs = cKDTree(place).query_pairs(2 * 0.502 + REACH, output_type="ndarray")
    pairs = pairs[np.lexsort(pairs.T[::-1])]
    gap = np.linalg.norm(place[pairs[:, 1]] - place[pairs[:, 0]], axis=1) - radius[pairs].sum(axis=1)
    return radius, pairs[gap < REACH]


def _contacts(place, radius, pairs):
    """Arrays of the contacts of grains with each other and with floor and sides, which are body n: (c, 2), (c, d),
    (c, 2), (c,).
    """
    way = place[pairs[:, 1]] - place[pairs[:, 0]]
    body, normal, lever = [pairs], [way / np.linalg.norm(way, axis=1)[:, None]], [radius[pairs] * (1, -1)]
    length = [radius[pairs].sum(axis=1)]
    low, high = place.min(axis=0), place.max(axis=0)
    for axis, inward in [(axis, sign) for axis in range(place.shape[1] - 1) for sign in (1, -1)] + [(-1, 1)]:
        out = place[:, axis] - low[axis] if inward > 0 else high[axis] - place[:, axis]
        there = np.flatnonzero(out < 0.6 if axis >= 0 else out == 0)  # rows are displaced by half a grain
        body.append(np.column_stack([np.full(len(there), len(place)), there]))
        normal.append(np.tile(inward * np.eye(place.shape[1])[axis], (len(there), 1)))
        lever.append(np.column_stack([0 * radius[there], -radius[there]]))
        length.append(2 * radius[there])
    return np.vstack(body).astype(np.int32), np.vstack(normal), np.vstack(lever), np.concatenate(length)


def spheres(columns=27, rows=27, seed=1) -> contact.SpaceProblem:
    """The problem of ``rows`` layers of ``columns`` by ``columns`` spheres [m, kg, s]."""
    c, b, a = np.mgrid[:rows, :columns, :columns].reshape(3, -1)
    place = np.column_stack(
        [a + 0.5 * ((b + c) % 2), np.sqrt(0.75) * (b + (c % 2) / 3), 0.5 + c * np.sqrt(2 / 3)]
    ).astype(float)
    radius, pairs = _grains(place, np.random.default_rng(seed))
    body, normal, lever, length = _contacts(place, radius, pairs)
    mass = DENSITY * 4 / 3 * np.pi * radius**3
    inverse, turning = np.append(1 / mass, 0), np.append(2.5 / (mass * radius**2), 0)
    free = np.zeros((len(inverse), 6))
    free[:-1, 2] = -GRAVITY * STEP
    count, one = len(length), np.ones(len(length))
    return contact.SpaceProblem(
        time_step=STEP,
        inverse_mass=np.column_stack([inverse] * 3),
        inverse_inertia=np.column_stack([turning] * 3 + [0 * turning] * 3),
        free_velocity=free,
        velocity=0 * free,
        body=body,
        normal=normal,
        lever=lever,
        bias=np.zeros((count, 7)),
        adhesion=0 * one,
        friction=FRICTION * one,
        rolling_arm=ROLLING * length,
        twisting_arm=TWISTING * length,
        length=length,
        warm_start=np.zeros((count, 6)),
        impulse=np.zeros((count, 6)),
        position=np.vstack([place, np.zeros(3)]),
    )


def disks(columns=300, rows=100, seed=1) -> contact.ContactProblem:
    """The problem of ``rows`` rows of ``columns`` disks, per metre of thickness [m, kg, s]."""
    b, a = np.mgrid[:rows, :columns].reshape(2, -1)
    place = np.column_stack([a + 0.5 * (b % 2), 0.5 + b * np.sqrt(0.75)]).astype(float)
    radius, pairs = _grains(place, np.random.default_rng(seed))
    body, normal, lever, length = _contacts(place, radius, pairs)
    mass = DENSITY * np.pi * radius**2
    inverse = np.append(1 / mass, 0)
    free = np.zeros((len(inverse), 3))
    free[:-1, 1] = -GRAVITY * STEP
    count, one = len(length), np.ones(len(length))
    return contact.ContactProblem(
        time_step=STEP,
        inverse_mass=np.column_stack([inverse, inverse, np.append(2 / (mass * radius**2), 0)]),
        free_velocity=free,
        velocity=0 * free,
        body=body,
        normal=normal,
        lever=np.column_stack([0 * one, lever[:, 0], 0 * one, lever[:, 1]]),
        bias=np.zeros((count, 3)),
        adhesion=0 * one,
        friction=FRICTION * one,
        rolling_arm=ROLLING * length,
        length=length,
        warm_start=np.zeros((count, 3)),
        impulse=np.zeros((count, 3)),
        position=np.vstack([place, np.zeros(2)]),
    )


def measure(folder, repeats, columns=27, rows=27, flat=(300, 100)) -> dict:
    """Times sweeps over spheres by every path, and over disks by the best, in turns; and how many a cold start takes. A
    function for processes.call.

    ``columns``, ``rows``: of the spheres; ``flat``: columns and rows of the disks.
    """
    import _nonsmooth_contact

    space, plane = spheres(columns, rows), disks(*flat)
    count = len(space.length)
    seconds = {name: np.empty(repeats) for name in (*sweeps.PATHS, "plane")}
    for k in range(repeats):
        for name, way in sweeps.PATHS.items():
            seconds[name][k] = sweeps.sweep_seconds(space, *way)
        seconds["plane"][k] = sweeps.sweep_seconds(plane, *sweeps.PATHS["best"])
    per_contact = {name: 1e9 * s / (len(plane.length) if name == "plane" else count) for name, s in seconds.items()}
    cold = contact.solve(space, start="cold", tolerance=COLD_TOLERANCE, max_iterations=5000)
    borne = cold.impulse[space.body[:, 0] == len(space.inverse_mass) - 1, 2].sum()  # by the floor and the sides
    weight = GRAVITY * STEP * (1 / space.inverse_mass[:-1, 0]).sum()
    return {
        "spheres": len(space.inverse_mass) - 1,
        "contacts": count,
        "contacts_plane": len(plane.length),
        "layers": rows,
        "bytes_per_contact": _nonsmooth_contact.bytes_per_contact_space,
        "ns_per_contact": {name: spread(ns) for name, ns in per_contact.items()},
        "over_plane": spread(per_contact["best"] / per_contact["plane"]),
        "speedup_over_reference": {
            name: spread(seconds["reference"] / s) for name, s in seconds.items() if name not in ("reference", "plane")
        },
        "speedup_two_threads": spread(seconds["best"] / seconds["best_two_threads"]),
        "cold_sweeps": cold.iterations,
        "cold_converged": cold.converged,
        "share_of_weight": borne / weight,
        "repeats": repeats,
    }
