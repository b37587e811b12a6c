"""Shear bands of a sample, from how far its disks have turned (Taboada and Estrada 2009, section 5.2, Figure 9).

Disks in a band turn with it: counterclockwise in the one of two conjugate directions, clockwise in the other. For each
sense of turning, the mean rotation of strips at all angles and offsets (a Radon transform of the rotation) has its
largest value along the band. Its profile across the band gives the width at half of the height above what the rest of
the sample has.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

__all__ = ["CONJUGATE", "Band", "find"]

CONJUGATE = 10.0  # ° by which the inclinations of two bands that cross may differ; they are known to 3°
STRIP = 1.0  # d, width of a strip
ANGLES = np.radians(np.arange(35, 81, 1.0))  # of a band to the horizontal; the minor stress is horizontal


@dataclass(frozen=True)
class Band:
    """``angle_deg`` to the horizontal (negative: rising to the left); ``offset`` [m] from the sample's centre along the
    normal; ``width`` [d], with d the root of the mean square of the diameters; ``rotation`` [rad]: mean in its core;
    ``contrast``: that over the mean of the rest; ``antithetic``: of the area of its disks that have turned, the part of
    those that have turned against it (the paper's antithetic disks, [106]).
    """

    angle_deg: float
    offset: float
    width: float
    rotation: float
    contrast: float
    antithetic: float


def find(x, y, r, rotation):
    """The strongest band of each sense of turning: (rising to the right, rising to the left), None where nothing stands
    out twofold.

    ``x``, ``y``, ``r`` [m], ``rotation`` [rad] of each disk. With the minor stress horizontal, a band that rises to the
    right slips sinistrally, or counterclockwise.
    """
    d = math.sqrt(np.mean((2 * r) ** 2))
    x, y, area = x - 0.5 * (x.min() + x.max()), y - 0.5 * (y.min() + y.max()), r**2
    return tuple(_strongest(x, y, area, sign * rotation, sign, d) for sign in (1, -1))


def _strongest(x, y, area, rotation, sign, d):
    best, turned = None, np.maximum(0, rotation)
    for angle in ANGLES:
        for way in (1, -1):
            profile, centres = _profile(x, y, area, turned, way * angle, d)
            smooth = np.convolve(profile, np.ones(3) / 3, "same")
            k = int(np.argmax(smooth))
            if best is None or smooth[k] > best[0]:
                best = (smooth[k], way * angle, k, smooth, centres)
    height, angle, k, profile, centres = best
    rest = float(np.median(profile))
    if not height > 2 * rest or rest < 0:
        return None
    width = _width(profile, k, rest + 0.5 * (height - rest)) * STRIP
    inside = np.abs(_offset(x, y, angle) - centres[k]) <= 0.5 * width * d
    # what turns less than a tenth of the core's mean has not turned
    against, along = (float(area[inside & (way * rotation > 0.1 * height)].sum()) for way in (-1, 1))
    return Band(
        math.degrees(angle),
        float(centres[k]),
        width,
        sign * float(height),
        float(height / rest) if rest > 0 else math.inf,
        against / (against + along),
    )


def _offset(x, y, angle):
    """Distances [m] of points from the line through the origin at an ``angle`` to the horizontal, along its normal."""
    return -math.sin(angle) * x + math.cos(angle) * y


def _profile(x, y, area, turned, angle, d):
    """Mean rotation in strips parallel to ``angle``, and the offsets of their centres [m]; strips that the sample fills
    little are left out.
    """
    k = np.floor(_offset(x, y, angle) / (STRIP * d)).astype(int)
    low = k.min()
    filled = np.bincount(k - low, area)
    mean = np.bincount(k - low, area * turned) / np.maximum(filled, 1e-300)
    keep = filled > 0.4 * np.max(filled)
    first, last = np.flatnonzero(keep)[[0, -1]]
    return mean[first : last + 1], (np.arange(first, last + 1) + low + 0.5) * STRIP * d


def _width(profile, k, half):
    """Width at the height ``half`` around the index ``k``, in strips, with linear interpolation."""
    left = k
    while left > 0 and profile[left] > half:
        left -= 1
    right = k
    while right < len(profile) - 1 and profile[right] > half:
        right += 1
    a = (
        left + (half - profile[left]) / (profile[left + 1] - profile[left])
        if profile[left] <= half < profile[left + 1]
        else left
    )
    b = (
        right - (half - profile[right]) / (profile[right - 1] - profile[right])
        if profile[right] <= half < profile[right - 1]
        else right
    )
    return float(b - a)
