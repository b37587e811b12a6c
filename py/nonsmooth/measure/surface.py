"""The surface of a mass and what lies below it."""

import numpy as np

from .ground import ground_of

__all__ = ["deposit_profile", "on_ground"]


def deposit_profile(snapshot, walls, bin_m=None):
    """Surface and base of the granular mass along x.

    Returns x, base, surface [m], each of shape (bins,), in the direction of the slope, NaN where there is no disk (or
    no wall below). The surface is the highest point of any disk in a bin of ``bin_m`` (default: three mean diameters),
    the base the lowest wall at that x, obstacles apart; the thickness, surface minus base, is vertical. Bins that hold
    less than a tenth of the mean number of disks are left out of the surface, so that single disks in flight do not
    count.
    """
    ground = ground_of(walls)
    bin_m, ahead = bin_m or 6 * float(snapshot.r.mean()), ground.side * snapshot.x
    low, high = (ahead - snapshot.r).min(), (ahead + snapshot.r).max()
    count = max(int(np.ceil((high - low) / bin_m)), 1)
    edges = low + bin_m * np.arange(count + 1)
    x = (edges[:-1] + edges[1:]) / 2
    surface = np.full(count, -np.inf)
    where = np.clip(((ahead - low) / bin_m).astype(int), 0, count - 1)
    np.maximum.at(surface, where, snapshot.y + snapshot.r)
    number = np.bincount(where, minlength=count)
    surface[number < 0.1 * number[number > 0].mean()] = np.nan
    surface[~np.isfinite(surface)] = np.nan
    x = ground.side * x
    return x, _base(x, ground), surface


def on_ground(x, walls):
    """Whether the lowest wall at each of ``x`` [m], (n,), is ground, the surface that a mass runs out over, and neither
    slip surface nor backstop: bool (n,). So the hollow in front of a backstop is none.
    """
    ground = ground_of(walls)
    return np.nan_to_num(_base(x, ground, ("ground",)), nan=np.inf) <= np.nan_to_num(_base(x, ground), nan=-np.inf)


def _base(x, ground, roles=None):
    """Height [m] of the lowest wall (of these ``roles``) at each of ``x``, NaN where there is none."""
    base = np.full(len(x), np.inf)
    for wall in ground.walls:
        if wall.role == "obstacle" or wall.buried or roles is not None and wall.role not in roles:
            continue
        for (xa, ya), (xb, yb) in zip(wall.vertices[:-1], wall.vertices[1:]):
            if xa == xb:
                continue
            if ground.side < 0:  # from the same end as in the mirror
                (xa, ya), (xb, yb) = (xb, yb), (xa, ya)
            inside = (x >= min(xa, xb)) & (x <= max(xa, xb))
            base[inside] = np.minimum(base[inside], ya + (yb - ya) * (x[inside] - xa) / (xb - xa))
    base[~np.isfinite(base)] = np.nan
    return base
