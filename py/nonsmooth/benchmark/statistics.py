"""Medians and quartiles: wall times have a floor and rare large values, which a mean would follow."""

from __future__ import annotations

import numpy as np

__all__ = ["spread"]


def spread(values) -> dict:
    """Median, lower and upper quartile and mean of measured values, as JSON can hold them."""
    low, middle, high = np.percentile(values, (25, 50, 75))
    return {"median": float(middle), "quartiles": [float(low), float(high)], "mean": float(np.mean(values))}
