"""Published laws and values of spheres in space: of round columns that collapse, as those of :mod:`.power_laws` in the
plane, and of packings under pressure.
"""

from __future__ import annotations

from typing import NamedTuple

from .power_laws import Law

__all__ = ["HEIGHT", "ISOTROPIC", "PLATEAU_FROM", "RUNOUT", "Packings"]

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


class Packings(NamedTuple):
    """Packings of spheres under an isotropic pressure: friction while they were made, packing fraction, and coordination
    of the spheres that bear, tuples of one length.
    """

    source: str
    friction: tuple
    solid_fraction: tuple
    coordination: tuple


#: Of equal spheres, in the limit of hard ones.
ISOTROPIC = Packings("Agnolin and Roux (2007), simulations", (0.0, 0.3), (0.639, 0.593), (6.0, 4.5))
#: Friction from which on the angle of friction in the critical state no longer grows, and whose statement that is.
PLATEAU_FROM = (0.3, "Gong et al. (2019), simulations of ellipsoids")
