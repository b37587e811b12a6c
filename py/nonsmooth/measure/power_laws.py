"""Published laws of the collapse of columns, and power laws fitted to runs.

Runout (L_f − L₀)/L₀ and final height H_f/L₀ against the aspect ratio a = H₀/L₀, in two dimensions. Exponents are those
of a power law, fitted as a line to logarithms, below and above the aspect ratio where the published law changes.
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass

import numpy as np
from scipy import stats

from ..errors import UserError
from .statistics import half_width

__all__ = ["HEIGHT", "RUNOUT", "Fit", "Law", "exponents", "fit"]


class PowerLawError(UserError, ValueError):
    """Values that no power law can be fitted to; the message says why."""


@dataclass(frozen=True)
class Law:
    """A published law: c aⁿ in pieces. ``pieces``: (factor c, exponent n) below and above the aspect ratio
    ``change``.
    """

    source: str
    change: float
    pieces: tuple[tuple[float, float], tuple[float, float]]

    def __call__(self, a):
        """The law at aspect ratios ``a``, an array."""
        (c1, n1), (c2, n2) = self.pieces
        a = np.asarray(a, float)
        return np.where(a < self.change, c1 * a**n1, c2 * a**n2)


#: Laws of the runout. Staron and Hinch: two-dimensional Contact Dynamics; Lube et al.: experiments between close walls.
RUNOUT = (
    Law("Staron and Hinch (2005), contact dynamics", 2.0, ((2.5, 1.0), (3.25, 0.7))),
    Law("Lube et al. (2005), experiments", 2.3, ((1.2, 1.0), (1.9, 2 / 3))),
)
#: Laws of the final height at the wall; below the change the top is not reached.
HEIGHT = (
    Law("Staron and Hinch (2005), contact dynamics", 0.7, ((1.0, 1.0), (0.65, 0.35))),
    Law("Lube et al. (2005), experiments", 1.15, ((1.0, 1.0), (1.0, 0.4))),
)


@dataclass(frozen=True)
class Fit:
    """c aⁿ: ``factor`` c, ``exponent`` n, the half width of its 95 % confidence interval (NaN for two points), and the
    number of ``points``.
    """

    factor: float
    exponent: float
    exponent_95: float
    points: int

    def __call__(self, a):
        """The fit at ``a``."""
        return self.factor * np.asarray(a, float) ** self.exponent

    def plain(self):
        """A dictionary for records, with None for an interval that two points do not give."""
        return asdict(self) | {"exponent_95": None if math.isnan(self.exponent_95) else self.exponent_95}


def fit(a, values):
    """Least-squares line through logarithms; a, values of shape (n,). Raises PowerLawError for less than two aspect
    ratios or a value not above 0.
    """
    a, values = np.asarray(a, float), np.asarray(values, float)
    if len(np.unique(a)) < 2:
        raise PowerLawError(f"{len(np.unique(a))} aspect ratios: a power law wants two or more")
    if not (values > 0).all():
        raise PowerLawError(f"{values.min():g} at a = {a[np.argmin(values)]:g}: a power law wants values above 0")
    line = stats.linregress(np.log(a), np.log(values))
    return Fit(math.exp(line.intercept), float(line.slope), half_width(line.stderr, len(a) - 2), len(a))


def exponents(a, values, change):
    """Fits below and above ``change``: a pair, with None where there are less than three aspect ratios.

    Two would fit any power law. Aspect ratios within 5 % of each other, as those of several seeds, count as one.
    """
    a, values = np.asarray(a, float), np.asarray(values, float)
    parts = (a < change, a >= change)
    return tuple(fit(a[p], values[p]) if len(np.unique(np.rint(np.log(a[p]) / 0.05))) > 2 else None for p in parts)
