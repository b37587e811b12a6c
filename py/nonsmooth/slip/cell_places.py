"""Where the cells of a wall lie on it: equal parts of a polyline, from one of its ends on. Needs no YADE."""

from __future__ import annotations

import numpy as np

__all__ = ["middles", "parts"]


def _ways(line):
    """Ways [m] of the vertices of a polyline from its beginning, (n,)."""
    return np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))))


def _at(line, shares):
    """Points of a polyline by their shares of its length, (m, 2)."""
    ways = _ways(line)
    return np.column_stack([np.interp(np.asarray(shares) * ways[-1], ways, axis) for axis in line.T])


def parts(points, count, near):
    """The ``count`` cells of a wall along ``points`` (n, 2) [m], each a polyline; the first is that whose middle is
    nearest to ``near``, (x, y).
    """
    line = np.asarray(points, float)
    first, last = _at(line, [0.5 / count, 1 - 0.5 / count])
    if np.hypot(*(last - near)) < np.hypot(*(first - near)):
        line = line[::-1]
    ways, ends = _ways(line), np.linspace(0, 1, count + 1)
    found = []
    for k, (begin, end) in enumerate(np.stack([_at(line, ends[:-1]), _at(line, ends[1:])], axis=1)):
        # vertices at an end of the cell are that end
        within = (ways > (ends[k] + 1e-9) * ways[-1]) & (ways < (ends[k + 1] - 1e-9) * ways[-1])
        found.append(np.vstack([begin, line[within], end]))
    return found


def middles(points, ends):
    """Middles of cells on a wall that was built along ``points`` (n, 2) [m], (count, 2): half way along each. ``ends``:
    of the cells now, in their order from one end of the wall, (count, 2, 2). Where the wall has moved as a whole since,
    by less than a quarter of a turn, the middles have too.
    """
    count = len(ends)
    if not count:
        return np.zeros((0, 2))
    now, shares, line = ends @ (1, 1j), np.arange(count) / count, np.asarray(points, float)
    fits = []
    for way in (line, line[::-1]):
        begin, middle, end = (_at(way, shares + more / count) @ (1, 1j) for more in (0.0, 0.5, 1.0))
        turn = np.ones(count, complex)  # also of a wall that ends where it begins
        np.divide(now[:, 1] - now[:, 0], end - begin, out=turn, where=end != begin)
        fits.append((np.abs(turn - 1).sum(), now[:, 0] + turn * (middle - begin)))
    found = min(fits, key=lambda one: one[0])[1]
    return np.column_stack([found.real, found.imag])
