"""Means and what is known of them: over seeds with Student's t, over blocks of a series, and spreads of wall times.
Needs no YADE.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

__all__ = ["Estimate", "half_width", "over_seeds", "spread", "standard_error", "told"]


def standard_error(values) -> float:
    """Of the mean of values that are independent, an array (n,); NaN for fewer than two."""
    values = np.asarray(values, float)
    return float(np.std(values, ddof=1) / math.sqrt(len(values))) if len(values) > 1 else math.nan


def half_width(error, freedom) -> float:
    """Half of the 95 % confidence interval of a figure with a standard ``error`` and so many degrees of ``freedom``
    (Student's t); NaN for none.
    """
    from scipy import stats

    return float(stats.t.ppf(0.975, freedom) * error) if freedom > 0 else math.nan


@dataclass(frozen=True)
class Estimate:
    """A mean over seeds with the half width of its 95 % confidence interval (Student's t); NaN for one seed."""

    mean: float
    half_width: float

    @classmethod
    def of(cls, values):
        """Of one value a seed, a sequence of one or more."""
        values = np.asarray(values, float)
        return cls(float(values.mean()), half_width(standard_error(values), len(values) - 1))


def over_seeds(values) -> dict:
    """``mean``, ``half_width`` of its 95 % interval and the ``values`` themselves, one a seed, as JSON can hold them:
    the first two None where a value is (a run that did not come to it), ``half_width`` also for one seed."""
    mean = Estimate.of([math.nan if v is None else v for v in values])

    def plain(v):
        return None if math.isnan(v) else v

    return {"mean": plain(mean.mean), "half_width": plain(mean.half_width), "values": list(values)}


def told(mean, half_width, digits, factor=1.0, sign="") -> str:
    """A mean and half of its interval times a ``factor``, as 1.2 ± 0.3; a dash where there is no mean, and the mean
    alone where it has no interval. ``sign``: "+" to write that of positive means.
    """
    if mean is None:
        return "–"
    return f"{factor * mean:{sign}.{digits}f}" + ("" if half_width is None else f" ± {factor * half_width:.{digits}f}")


def spread(values) -> dict:
    """Median, lower and upper quartile and mean of measured values, as JSON can hold them: wall times have a floor and
    rare large values, which a mean would follow."""
    low, middle, high = np.percentile(values, (25, 50, 75))
    return {"median": float(middle), "quartiles": [float(low), float(high)], "mean": float(np.mean(values))}
