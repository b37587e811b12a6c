"""Speed along the floor against height in a mass that spreads: the border between what has come to rest and what flows,
and which of three regimes a profile shows (Taboada and Estrada 2009, section 4.2.4, Figure 7).

Behind its tip a spreading mass moves as a *plug* over a thin sheared sole ([67]); farther back its speed grows evenly
with height, a *simple shear* ([68]); at its rear a layer that flows lies on one that has come to rest, *two layers*
([69]). Two numbers of a profile u(z), 0 ≤ z ≤ h, with the largest speed U, tell them apart:

    fullness  f = ∫ u dz / (U h)      1 of a plug, 1/2 of a simple shear,
    rest      s = z_i / h             the share of the height below the border z_i, where u falls to a tenth of U.

A profile has two layers where s is above :data:`LAYERED`; else it is a plug where f is above :data:`PLUG`, midway
between the two, and a simple shear below. Needs no YADE.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

__all__ = ["REGIMES", "Profile", "border", "borders", "fullness", "measure", "midway", "profile", "regime"]

SLOW = 0.1  # of the largest speed of a profile: what is slower has come to rest; exponential tails have no end
LAYERED = 0.25  # of the height: what rests below makes two layers
PLUG = 0.75  # midway between the fullness of a simple shear and that of a plug
FILLED = 0.2  # of a layer's area that disks fill at least, or it is above the surface
REGIMES = ("plug", "simple shear", "two layers", "at rest")


@dataclass(frozen=True)
class Profile:
    """``z``: middles of layers [m], (n,); ``speed``: mean horizontal speed of the disks in each [m/s], (n,);
    ``height``: h [m]; ``border``: z_i [m]; ``fullness``: f; ``regime``: of :data:`REGIMES`."""

    z: np.ndarray
    speed: np.ndarray
    height: float
    border: float
    fullness: float
    regime: str


def midway(first, then):
    """Places and speeds from two looks at the same disks, each (time [s], x, y) with arrays (n,) [m]: x, y, u, v in the
    middle of the time between, by differences.
    """
    (t0, x0, y0), (t1, x1, y1) = first, then
    x0, y0, x1, y1 = (np.asarray(values, float) for values in (x0, y0, x1, y1))
    return 0.5 * (x0 + x1), 0.5 * (y0 + y1), (x1 - x0) / (t1 - t0), (y1 - y0) / (t1 - t0)


def profile(x, y, r, u, left, right, layer):
    """Mean ``u`` of the disks between two places ``left`` and ``right`` [m], in layers of a thickness ``layer`` [m]
    from y = 0 up, each disk by its area: middles of the layers [m] and speeds, (n,). Layers end below the first one
    that disks do not fill to :data:`FILLED`. Arrays x, y, r, u of (disks,).
    """
    inside = (x >= left) & (x < right) & (y >= 0)
    k, area = (y[inside] / layer).astype(int), np.pi * r[inside] ** 2
    filled, sums = np.bincount(k, area), np.bincount(k, area * u[inside])
    empty = np.flatnonzero(filled < FILLED * layer * (right - left))
    count = int(empty[0]) if len(empty) else len(filled)
    return layer * (np.arange(count) + 0.5), sums[:count] / filled[:count]


def border(z, speed):
    """Height [m] of the border between what rests and what flows: where the speed, from its largest value down, first
    falls to :data:`SLOW` of it; 0 where it does not. ``z``, ``speed``: (n,).
    """
    top = int(np.argmax(speed))
    limit = SLOW * speed[top]
    slow = np.flatnonzero(speed[:top] < limit)
    if not len(slow):
        return 0.0
    k = int(slow[-1])  # linear between the middles of two layers
    return float(z[k] + (z[k + 1] - z[k]) * (limit - speed[k]) / (speed[k + 1] - speed[k]))


def fullness(speed):
    """Mean speed over height by the largest one, of layers of one thickness; ``speed``: (n,)."""
    return float(np.mean(speed) / np.max(speed))


def regime(rest, full):
    """The regime, of :data:`REGIMES`, of a profile with the share ``rest`` of its height at rest and the fullness
    ``full``.
    """
    return "two layers" if rest > LAYERED else "plug" if full > PLUG else "simple shear"


def measure(x, y, r, u, left, right, layer, least=0.0):
    """The :class:`Profile` between two places, see :func:`profile`; None without disks there. A mass whose largest
    speed is not above ``least`` [m/s] is at rest to its surface.
    """
    z, speed = profile(x, y, r, u, left, right, layer)
    if not len(z):
        return None
    height = float(z[-1] + 0.5 * layer)
    if not speed.max() > least:
        return Profile(z, speed, height, height, float("nan"), "at rest")
    edge, full = border(z, speed), fullness(speed)
    return Profile(z, speed, height, edge, full, regime(edge / height, full))


def borders(x, y, r, u, edges, layer, least=0.0):
    """Height of the border [m] between neighbouring ``edges`` [m], (n + 1,): (n,), NaN where there are no disks.
    Arguments as of :func:`measure`.
    """
    found = (measure(x, y, r, u, a, b, layer, least) for a, b in zip(edges[:-1], edges[1:]))
    return np.array([np.nan if one is None else one.border for one in found])
