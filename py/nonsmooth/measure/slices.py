"""The factor of safety of a slope by the method of slices, in Bishop's simplified form, on circles.

The ground above a circle is cut into vertical slices of width b. With W the weight of a slice, α the dip of its base, c
and φ the strength there, moments about the centre and vertical forces of each slice are in balance for

    F = Σ (c b + W tan φ)/m_α / Σ W sin α ,    m_α = cos α + sin α tan φ / F .

The factor of a slope is that of its worst circle. There is no water.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy import optimize

from ..errors import UserError

__all__ = ["Circle", "SlicesError", "Soil", "bishop", "ground", "worst_circle"]

SLICES = 100
CLOSE = 1e-9  # of the factor, from one iteration to the next
ITERATIONS = 200
LEAST_ARM = 0.1  # of m_α: a slice whose base is steeper than that pushes against the slide, and its circle is none
GRID = (7, 12, 9)  # circles tried first: places at the foot and at the crest, and bulges
STARTS = 3  # best circles of the grid, from which the search goes on


class SlicesError(UserError, ValueError):
    """A slope in which no circle can be searched; the message says why and what would do."""


@dataclass(frozen=True)
class Soil:
    """A part of the ground: its ``outline``, an array (n, 2) of vertices [m], ``cohesion`` [Pa], ``friction_deg`` [°]
    and ``unit_weight`` [N/m³].
    """

    outline: np.ndarray
    cohesion: float
    friction_deg: float
    unit_weight: float

    def spans(self, x):
        """Where it lies above and below each of the places ``x`` [m]: bottoms and tops [m], two arrays (m, len(x)) for
        its m uppermost, second, … spans, nan where it has no such span.
        """
        p, q = self.outline, np.roll(self.outline, -1, axis=0)
        (x0, y0), (x1, y1) = p.T[:, :, None], q.T[:, :, None]
        crossed = (np.minimum(x0, x1) <= x) & (x < np.maximum(x0, x1))
        with np.errstate(divide="ignore", invalid="ignore"):
            y = np.where(crossed, y0 + (y1 - y0) * (x - x0) / (x1 - x0), np.nan)
        y = np.sort(y, axis=0)  # nan last
        y = y[: 2 * ((int(crossed.sum(axis=0).max(initial=0)) + 1) // 2)]
        return y[0::2], y[1::2]


@dataclass(frozen=True)
class Circle:
    """A circle with its centre at (``x``, ``y``) and its ``radius`` [m], and the ``factor`` of the ground above it."""

    x: float
    y: float
    radius: float
    factor: float


def bishop(soils, x, y, radius, between) -> float:
    """F of the ground above the arc of a circle about (``x``, ``y``) [m] with a ``radius`` [m], between two places
    [m] where it leaves the ground; inf where the arc leaves the soils or the ground does not slide on it. ``soils``:
    Soils that do not overlap, in a sequence.
    """
    ends = np.linspace(*between, SLICES + 1)
    width, middle = ends[1] - ends[0], 0.5 * (ends[1:] + ends[:-1])
    under = radius**2 - (middle - x) ** 2
    if under.min() <= 0:
        return math.inf
    base, sine = y - np.sqrt(under), (middle - x) / radius
    weight, cohesion, tangent = np.zeros(SLICES), np.full(SLICES, np.nan), np.zeros(SLICES)
    for soil in soils:
        for bottom, top in zip(*soil.spans(middle)):
            inside = top > bottom  # false for nan
            weight[inside] += (soil.unit_weight * np.maximum(top - np.maximum(bottom, base), 0.0))[inside] * width
            here = inside & (bottom <= base) & (base <= top)
            cohesion[here], tangent[here] = soil.cohesion, math.tan(math.radians(soil.friction_deg))
    driving = float(weight @ sine)
    if np.isnan(cohesion).any() or abs(driving) <= CLOSE * float(weight.sum()):
        return math.inf
    if driving < 0:
        sine, driving = -sine, -driving
    cosine, factor = np.sqrt(under) / radius, 1.0
    for _ in range(ITERATIONS):
        arm = cosine + sine * tangent / factor
        if arm.min() < LEAST_ARM:
            return math.inf
        before, factor = factor, float(((cohesion * width + weight * tangent) / arm).sum() / driving)
        if abs(factor - before) <= CLOSE * factor:
            return factor
    return math.inf


def ground(soils, x):
    """The height of the ground [m] at the places ``x`` [m] over Soils, an array like x; nan where there is none."""
    x = np.atleast_1d(np.asarray(x, float))
    tops = np.concatenate([soil.spans(x)[1] for soil in soils])
    return np.fmax.reduce(tops, axis=0, initial=np.nan)


def worst_circle(soils, foot, crest, deepest=0.6) -> Circle:
    """The Circle with the smallest factor, of those that leave the ground over Soils at one place within ``foot`` and
    at another within ``crest``, two pairs of x [m], and bulge by up to ``deepest`` of their chord below it.

    Raises SlicesError where no circle between them lies within the soils.
    """

    def circle(p):
        x0, x1, bulge = p
        y0, y1 = ground(soils, (x0, x1))
        chord = math.hypot(x1 - x0, y1 - y0)
        if not (chord > 0 and 0 < bulge <= deepest):  # false for nan
            return None
        sagitta = bulge * chord
        radius = (0.25 * chord**2 + sagitta**2) / (2 * sagitta)
        off, way = (radius - sagitta) / chord, math.copysign(1.0, x1 - x0)
        x, y = 0.5 * (x0 + x1) - way * off * (y1 - y0), 0.5 * (y0 + y1) + way * off * (x1 - x0)
        return (x, y, radius) if max(y0, y1) <= y else None  # beyond its widest place it would lean over

    def factor(p):
        within = min(foot) <= p[0] <= max(foot) and min(crest) <= p[1] <= max(crest)
        found = circle(p) if within else None
        return math.inf if found is None else bishop(soils, *found, sorted(p[:2]))

    grid = [
        (factor(p), p)
        for p in (
            (a, b, s)
            for a in np.linspace(*foot, GRID[0])
            for b in np.linspace(*crest, GRID[1])
            for s in np.linspace(0.02, deepest, GRID[2])
        )
    ]
    best = sorted(grid)[:STARTS]
    if not math.isfinite(best[0][0]):
        raise SlicesError(
            f"no circle from x = {min(foot):g} to {max(foot):g} m up to {min(crest):g} to {max(crest):g} m lies within "
            "the soils: give places on the ground on both sides of the face"
        )
    size = [np.ptp(foot), np.ptp(crest), 1.0]

    def polished(start):
        simplex = np.array([start, *(np.add(start, 0.05 * np.eye(3)[k] * size) for k in range(3))])
        options = {"initial_simplex": simplex, "xatol": 1e-5, "fatol": 1e-7, "maxiter": 600}
        return optimize.minimize(factor, start, method="Nelder-Mead", options=options)

    found = min((polished(start) for f, start in best if math.isfinite(f)), key=lambda one: one.fun)
    return Circle(*map(float, circle(found.x)), float(found.fun))
