"""Which part of a slip surface has lost its strength: where the disks on it have slipped further than D_c (Taboada and
Estrada 2009, section 5.3).
"""

import numpy as np

__all__ = ["downwards", "foot_length", "stretches", "stretch", "weakened_share"]

BIN = 3.0  # mean diameters, as the surface's
NEAR = 0.25  # mean diameters between a disk and the surface that it is on: in motion disks hop


def downwards(line, side=1.0):
    """The vertices (n, 2) [m] of a surface from its upper end on: the left one of a slope that falls to the right
    (``side`` 1), the right one of another (−1).
    """
    line = np.asarray(line, float)
    return line if side * line[0, 0] <= side * line[-1, 0] else line[::-1]


def weakened_share(snapshot, line, column, side=1.0):
    """What part of the disks on a surface is weakened there, along the surface.

    On an interface these are the disks of both its layers. ``line``: its vertices (n, 2) [m]; ``column``: its number in
    :attr:`.records.Snapshot.weakened`, which must be known; ``side``: see :func:`downwards`.
    Returns the edges of bins of about three mean diameters, (bins + 1,) [m] along the surface from its upper end, and
    the share in each, (bins,), NaN where no disk is.
    """
    line = downwards(line, side)
    diameter = 2 * float(snapshot.r.mean())
    leg = np.hypot(*np.diff(line, axis=0).T)
    length = float(leg.sum())
    edges = np.linspace(0.0, length, max(1, round(length / (BIN * diameter))) + 1)
    along, off = _projected(snapshot, line, leg)
    on = off <= snapshot.r + NEAR * diameter
    where = np.clip(np.searchsorted(edges, along[on], side="right") - 1, 0, len(edges) - 2)
    number = np.bincount(where, minlength=len(edges) - 1)
    weak = np.bincount(where, snapshot.weakened[on, column], minlength=len(edges) - 1)
    return edges, np.divide(weak, number, out=np.full(len(number), np.nan), where=number > 0)


def _projected(snapshot, line, leg):
    """Of each disk's centre: the place along a polyline that is nearest to it [m], and its distance from there [m];
    infinite beyond the ends.
    """
    along, off = np.zeros(len(snapshot.x)), np.full(len(snapshot.x), np.inf)
    for k, size in enumerate(leg):
        t = (line[k + 1] - line[k]) / size
        dx, dy = snapshot.x - line[k, 0], snapshot.y - line[k, 1]
        at = dx * t[0] + dy * t[1]
        within = (at >= 0 if k == 0 else at > -np.inf) & (at <= size if k == len(leg) - 1 else at < np.inf)
        at = np.clip(at, 0, size)
        away = np.where(within, np.hypot(dx - at * t[0], dy - at * t[1]), np.inf)
        nearer = away < off
        along[nearer], off[nearer] = leg[:k].sum() + at[nearer], away[nearer]
    return along, off


def _weak(share):
    """Which bins count as weakened, (bins,) bool."""
    return np.nan_to_num(share) >= 0.5


def stretches(edges, share):
    """Where at least half of the disks are weakened: list of (begin, end) [m], from :func:`weakened_share`."""
    weak = np.r_[False, _weak(share), False]
    begin, end = np.flatnonzero(~weak[:-1] & weak[1:]), np.flatnonzero(weak[:-1] & ~weak[1:])
    return [(float(edges[a]), float(edges[b])) for a, b in zip(begin, end)]


def foot_length(edges, share):
    """Length [m] of the lowest part of a surface where fewer than half of the disks are weakened, or none is; from
    :func:`weakened_share`.
    """
    weak = np.flatnonzero(_weak(share))
    return float(edges[-1] - edges[weak[-1] + 1 if len(weak) else 0])


def stretch(line, begin, end, side=1.0):
    """Vertices (n, 2) [m] of the part of a surface between two distances [m] from its upper end."""
    line = downwards(line, side)
    place = np.r_[0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T))]
    inner = place[(place > begin) & (place < end)]
    at = np.r_[begin, inner, end]
    return np.column_stack([np.interp(at, place, line[:, k]) for k in (0, 1)])
