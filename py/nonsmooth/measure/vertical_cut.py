"""The height to which a vertical face of rock stands, from its cohesion, angle of friction and tensile strength.

A plane at 45° + φ/2 through the foot slips at the height

    H_c = (4 c/γ) tan(45° + φ/2) ,

an upper bound, of which a log spiral gives :data:`LOG_SPIRAL`. Above the depth at which Rankine's active stress is the
tensile strength, K_a γ z − 2 c √K_a = −σ_t with K_a = tan²(45° − φ/2), the ground behind the face cracks:

    z_t = (2 c/γ) tan(45° + φ/2) − σ_t/(γ K_a) .

A wedge whose plane ends at a crack of that depth weighs γ (H² − z_t²) tan(45° − φ/2)/2 and slips at H = H_c − z_t
(Terzaghi 1943): half of H_c without tensile strength. The face stands to the smaller of this and the log spiral.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..errors import UserError
from ..system import checks

__all__ = ["LOG_SPIRAL", "VerticalCut", "VerticalCutError", "vertical_cut"]

LOG_SPIRAL = 0.966  # of the plane's height, that of the log spiral; it hardly depends on φ


class VerticalCutError(UserError, ValueError):
    """Strengths that no height follows from; the message says which and what would do."""


@dataclass(frozen=True)
class VerticalCut:
    """``height`` [m] to which the face stands; ``plane`` [m]: H_c; ``crack`` [m]: depth of the tension crack, z_t, from
    0 to half of H_c; ``cracked``: whether the crack, and not the log spiral, rules.
    """

    height: float
    plane: float
    crack: float
    cracked: bool


def vertical_cut(cohesion, friction_deg, tensile_strength, unit_weight) -> VerticalCut:
    """The VerticalCut of a rock of ``cohesion`` [Pa], angle of friction ``friction_deg`` [°], ``tensile_strength`` [Pa]
    (tension positive) and ``unit_weight`` γ [N/m³].

    Raises VerticalCutError for values of another kind, and for a tensile strength above c cot φ, where Coulomb's line
    ends.
    """
    checks.number("cohesion", cohesion, VerticalCutError, "give a cohesion above 0 in Pa", above=0)
    checks.number("friction_deg", friction_deg, VerticalCutError, "give degrees, from 0 to below 90", least=0, below=90)
    checks.number("unit_weight", unit_weight, VerticalCutError, "give a weight above 0 in N/m³", above=0)
    phi = math.radians(friction_deg)
    most = cohesion / math.tan(phi) if phi > 0 else math.inf
    remedy = f"give a strength from 0 to c cot φ = {most:.4g} Pa, where the line of cohesion and friction ends"
    checks.number("tensile_strength", tensile_strength, VerticalCutError, remedy, least=0, most=most)
    root = math.tan(math.pi / 4 + phi / 2)
    plane = 4 * cohesion / unit_weight * root
    crack = max(0.0, 0.5 * plane - tensile_strength / unit_weight * root**2)
    cracked = plane - crack < LOG_SPIRAL * plane
    return VerticalCut(plane - crack if cracked else LOG_SPIRAL * plane, plane, crack, cracked)
