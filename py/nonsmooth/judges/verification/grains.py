"""Who touches whom among disks in the plane or spheres in space, and how strong contacts are, for contact problems that are
made here.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

__all__ = ["Touching", "draw_strengths", "touching"]


class Touching(NamedTuple):
    """c contacts of n grains with each other, and behind them with walls, which are bodies n, n + 1, …"""

    body: np.ndarray  # (c, 2) int32
    normal: np.ndarray  # (c, d), from the first body to the second
    gap: np.ndarray  # (c,) [m]
    arm: np.ndarray  # (c, 2): from each centre to the middle of the gap, along the normal [m]
    length: np.ndarray  # (c,): sum of the radii, of a wall's contact the diameter [m]


def touching(place, r, walls, reach) -> Touching:
    """Contacts with a gap below ``reach`` [m] of grains at ``place`` (n, d) with radii ``r`` (n,), and of each with
    ``walls``: half-planes or half-spaces (a point's d coordinates, d of the normal into the free side).
    """
    pairs = cKDTree(place).query_pairs(2 * r.max() + reach, output_type="ndarray").reshape(-1, 2)
    i, j = np.sort(pairs, axis=1)[np.lexsort(np.sort(pairs, axis=1).T[::-1])].T
    way = place[j] - place[i]
    distance = np.linalg.norm(way, axis=1)
    gap = distance - r[i] - r[j]
    near = gap < reach
    i, j, gap, normal = i[near], j[near], gap[near], (way / distance[:, None])[near]
    parts = [
        (np.column_stack([i, j]), normal, gap, np.column_stack([r[i] + 0.5 * gap, -(r[j] + 0.5 * gap)]), r[i] + r[j])
    ]
    for k, wall in enumerate(walls):
        point, inward = np.reshape(np.asarray(wall, float), (2, -1))
        gap = (place - point) @ inward - r
        near = np.flatnonzero(gap < reach)
        gap, none = gap[near], np.zeros(len(near))
        body = np.column_stack([np.full(len(near), len(place) + k), near])
        arm = np.column_stack([none, -(r[near] + 0.5 * gap)])
        parts.append((body, np.tile(inward, (len(near), 1)), gap, arm, 2 * r[near]))
    body, normal, gap, arm, length = map(np.concatenate, zip(*parts))
    return Touching(body.astype(np.int32), normal, gap, arm, length)


def draw_strengths(problem, dice, impulse, *, rolling=False, twisting=False, cohesion=False):
    """Gives the contacts of a problem friction by chance, and two thirds of them what else is asked for, the others none of
    it; ``dice``: a numpy Generator; ``impulse``: h F_a of the strongest cohesion [N s].
    """
    contacts = len(problem.length)
    problem.friction[:] = dice.uniform(0.1, 0.5, contacts)

    def some():
        return dice.uniform(0, 1, contacts) * (dice.random(contacts) < 2 / 3)

    problem.rolling_arm[:] = 0.2 * problem.length * some() if rolling else 0
    if twisting:  # which disks do not know
        problem.twisting_arm[:] = 0.2 * problem.length * some()
    problem.adhesion[:] = impulse * some() if cohesion else 0
