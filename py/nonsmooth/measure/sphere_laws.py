"""Published laws of round columns that collapse: axisymmetric, in space, as those of :mod:`.power_laws` in the
plane.
"""

from __future__ import annotations

from .power_laws import Law

__all__ = ["HEIGHT", "RUNOUT"]

#: Laws of the runout (r∞ − r₀)/r₀ against a = h₀/r₀. Lajeunesse et al. say that it goes as a, and as √a above 3: the
#: factor above makes both meet.
RUNOUT = (
    Law("Lube et al. (2004), experiments", 1.7, ((1.24, 1.0), (1.6, 0.5))),
    Law("Lajeunesse et al. (2004), experiments", 3.0, ((1.0, 1.0), (3.0**0.5, 0.5))),
)
#: Laws of the final height h∞/r₀ on the axis. Below the change the top is not reached; that of Lube et al. above it is
#: stated for a > 1.7.
HEIGHT = (
    Law("Lube et al. (2004), experiments", 1.0, ((1.0, 1.0), (0.88, 1 / 6))),
    Law("Lajeunesse et al. (2004), experiments", 0.74, ((1.0, 1.0), (0.74, 0.0))),
)
