"""Errors of runs against a reference, the scatter of chaotic motion, work against precision, and rates of convergence.

**Error.** Two runs differ by what a reader of their results would see; each part is relative, so that a number says the
same of all:

* front and centre of mass: root mean square over time of the difference of their ways, from the moment that the mass
  begins to move and until both rest, in units of the reference's largest way (for other experiments: their curves over
  their abscissa);
* deposit: 1 minus the area that both cover over the area that either covers;
* key quantities of the scenario, such as the water table at failure: the difference over the reference's value.

The error is the root mean square of these parts. **Scatter** is the median of the same error over all pairs of seeds of
one world with the same numerics: a difference below it may be chance. An avalanche is chaotic, so errors of one world's
own runs against each other do not fall to zero with the step, but to what a small disturbance does.

**Work.** The cost to an accuracy e is the smallest wall time of the runs of a world whose error is at most e. Two
worlds are compared at the smallest error that both reach, but not below the scatter, where a smaller error says
nothing.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from . import deposits

__all__ = [
    "ConvergenceFit",
    "Work",
    "compare_work",
    "curve_difference",
    "error",
    "force_difference",
    "loglog",
    "parts",
    "power_law",
    "scatter",
    "soft_rate",
]

POINTS = 400  # of the abscissa on which curves are compared


def curve_difference(abscissa, values, reference_abscissa, reference):
    """Root mean square difference of two curves over the reference's largest value; NaN where that is 0.

    ``abscissa``, ``values``: of shape (n,), ascending; ``reference_abscissa``, ``reference``: of shape (m,), in the
    same units. Both begin at abscissa 0, and a curve that has ended keeps its last value.
    """
    end = max(abscissa[-1], reference_abscissa[-1])
    if end <= 0:
        return 0.0
    at = np.linspace(0.0, end, POINTS)
    a, b = np.interp(at, abscissa, values), np.interp(at, reference_abscissa, reference)
    size = float(np.max(np.abs(b)))
    return float(np.sqrt(np.mean((a - b) ** 2))) / size if size > 0 else math.nan


def parts(one, reference, key_quantities=()):
    """The parts of the error of an Outcome against another: {name: number}, relative; those that cannot be told are
    left out.

    ``key_quantities``: names of Outcome.values that count as well.
    """
    found = {}
    for name in one.curves:
        if name != "abscissa" and name in reference.curves:
            found[name] = curve_difference(
                one.curves["abscissa"], one.curves[name], reference.curves["abscissa"], reference.curves[name]
            )
    if one.deposit is not None and reference.deposit is not None:
        found["deposit"] = 1 - deposits.overlap(one.deposit, reference.deposit)
    for name in key_quantities:
        a, b = one.values.get(name), reference.values.get(name)
        if a is not None and b:
            found[name] = abs(a - b) / abs(b)
    return {name: value for name, value in found.items() if math.isfinite(value)}


def error(one, reference, key_quantities=()):
    """Root mean square of the :func:`parts`, a relative number; NaN without any."""
    values = list(parts(one, reference, key_quantities).values())
    return math.sqrt(sum(v * v for v in values) / len(values)) if values else math.nan


def scatter(outcomes, key_quantities=()):
    """Median of the errors of all pairs of ``outcomes``, a list of Outcome (both ways round); NaN for fewer than
    two.
    """
    found = [error(a, b, key_quantities) for a, b in itertools.permutations(outcomes, 2)]
    return float(np.median(found)) if found else math.nan


def force_difference(one, reference):
    """Of normal forces [N/m] at the same contacts, both {pair: force}: root mean square difference over the reference's
    mean, and the coefficient of correlation.

    Contacts that only one of them has count with a zero in the other. NaN, NaN for fewer than three contacts.
    """
    pairs = sorted(set(one) | set(reference))
    if not one or not reference or len(pairs) < 3:
        return math.nan, math.nan
    a, b = (np.array([forces.get(pair, 0.0) for pair in pairs]) for forces in (one, reference))
    mean = np.mean(list(reference.values()))
    return (
        float(np.sqrt(np.mean((a - b) ** 2)) / mean),
        float(np.corrcoef(a, b)[0, 1]) if a.std() > 0 and b.std() > 0 else math.nan,
    )


@dataclass(frozen=True)
class ConvergenceFit:
    """y = ``scale`` x^``power``; ``power_error``: standard error, NaN for two points; ``points``: how many there
    were.
    """

    power: float
    scale: float
    power_error: float
    points: int

    def __call__(self, x):
        return self.scale * np.asarray(x, float) ** self.power


def power_law(x, y):
    """:class:`ConvergenceFit` to ``x``, ``y``, both of shape (n,), by least squares of the logarithms; values that are
    not positive are left out.

    None where fewer than two points of different x are left.
    """
    x, y = np.asarray(x, float), np.asarray(y, float)
    good = np.isfinite(x) & np.isfinite(y) & (x > 0) & (y > 0)
    x, y = np.log(x[good]), np.log(y[good])
    if len(set(x.tolist())) < 2:
        return None
    power, constant = np.polyfit(x, y, 1)
    spread = math.nan
    if len(x) > 2:
        rest = y - power * x - constant
        spread = math.sqrt(float(np.sum(rest**2)) / (len(x) - 2) / float(np.sum((x - x.mean()) ** 2)))
    return ConvergenceFit(float(power), math.exp(constant), spread, len(x))


def loglog(at, x, y):
    """y at ``at``, straight lines between the logarithms; and whether that lies outside the points, along the last line
    there.

    ``at``: a number; ``x``, ``y``: of shape (n,), positive, two points of different x or more, else (NaN, True).
    """
    order = np.argsort(x, kind="stable")
    x, y = np.log(np.asarray(x, float)[order]), np.log(np.asarray(y, float)[order])
    keep = np.r_[True, np.diff(x) > 0] if len(x) else np.zeros(0, bool)
    x, y = x[keep], y[keep]
    if len(x) < 2 or not at > 0:
        return math.nan, True
    p = math.log(at)
    k = int(np.clip(np.searchsorted(x, p) - 1, 0, len(x) - 2))
    value = y[k] + (y[k + 1] - y[k]) * (p - x[k]) / (x[k + 1] - x[k])
    return math.exp(value), not x[0] - 1e-9 <= p <= x[-1] + 1e-9


def soft_rate(modulus, moduli, steps, walls):
    """Wall time [s] for a second of simulation on soft contacts of a Young's modulus [Pa], and whether that lies
    outside those that were run.

    ``moduli`` [Pa], ``steps`` [s], ``walls`` [s]: of the runs their moduli, time steps and wall times a step, each of
    shape (n,). The step goes with the stability limit, as the inverse root of the modulus; what a step takes depends on
    the modulus through the number of contacts only, so beyond the runs it is that of the nearest.
    """
    order = np.argsort(moduli)
    moduli, steps, walls = (np.asarray(v, float)[order] for v in (moduli, steps, walls))
    if not len(moduli) or not (math.isfinite(modulus) and modulus > 0):
        return math.nan, True
    wall = math.exp(np.interp(math.log(modulus), np.log(moduli), np.log(walls)))
    beyond = not moduli[0] * (1 - 1e-9) <= modulus <= moduli[-1] * (1 + 1e-9)
    nearest = int(np.argmin(np.abs(np.log(moduli / modulus))))
    step = steps[nearest] * math.sqrt(moduli[nearest] / modulus)
    return wall / step, beyond


@dataclass(frozen=True)
class Work:
    """Two worlds at one accuracy.

    ``error`` compared at; ``hard``, ``soft``: indices of the cheapest runs that reach it; ``factor``: soft over hard in
    wall time.

    ``at_scatter``: whether the accuracy is the scatter, below which nothing can be told.
    """

    error: float
    hard: int
    soft: int
    factor: float
    at_scatter: bool


def compare_work(hard, soft, floor=0.0):
    """:class:`Work` of two lists of (wall time [s], error), ``floor``: the scatter (NaN: none); None where a world has
    no run that counts.
    """
    hard, soft = ([(float(w), float(e)) for w, e in points] for points in (hard, soft))
    known = [[e for w, e in points if math.isfinite(e) and w > 0] for points in (hard, soft)]
    if not all(known):
        return None
    reached = max(min(e) for e in known)
    floor = floor if math.isfinite(floor) else 0.0
    target = max(reached, floor)

    def cheapest(points):
        return min(
            (k for k, (w, e) in enumerate(points) if math.isfinite(e) and w > 0 and e <= target * (1 + 1e-12)),
            key=lambda k: points[k][0],
        )

    a, b = cheapest(hard), cheapest(soft)
    return Work(target, a, b, soft[b][0] / hard[a][0], floor > reached)
