"""Parameters of a soft contact model that stands for a Contact Dynamics material.

Formulae of YADE's models are those of its sources, version 2025.2.0: ``FrictPhys.cpp``,
``CohesiveFrictionalContactLaw.cpp``, ``JointedCohesiveFrictionalPM.cpp``, ``NewtonIntegrator.cpp``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...errors import UserError
from ...model.section import Material
from ...system import checks

__all__ = ["MODELS", "ROLLING_MODELS", "Equivalent", "SoftError", "equivalent"]

#: YADE's models: its cohesive law with moments, its rock model without them, springs with friction alone.
MODELS = ("cohesion_moment", "jcfpm", "friction")
#: Those whose contacts resist rolling, with a bond and without.
ROLLING_MODELS = ("cohesion_moment",)


class SoftError(UserError, ValueError):
    """A material, value or scene that has no counterpart on the other side; one message with key, value and remedy."""


@dataclass(frozen=True)
class Equivalent:
    """A soft contact model and its parameters; SI units, a slice 1 m thick.

    ``material``: the section.Material that it stands for (Taboada and Estrada 2009, section 2.2).
    ``model``: one of :data:`MODELS`.
    ``young``: FrictMat.young E [Pa]. ``shear_ratio``: FrictMat.poisson, which in YADE is k_s/k_n [-].
    ``rolling_ratio``: CohFrictMat.alphaKr, k_r/(k_s R₁ R₂) [-]; 0 in models without moments.
    ``damping``: NewtonIntegrator.damping λ [-], non-viscous: a part of each component of the force that always brakes.
    ``diameters``: smallest and largest [m]. ``contacts``: most contacts of a disk that ``step_limit`` reckons with.
    ``step_limit``: largest stable time step [s], see :func:`equivalent`.
    """

    material: Material
    model: str
    young: float
    shear_ratio: float
    rolling_ratio: float
    damping: float
    diameters: tuple[float, float]
    contacts: int
    step_limit: float

    @property
    def length(self) -> float:
        """Mean of the smallest and the largest diameter [m]: the ℓ of tables; each contact has its own."""
        return 0.5 * sum(self.diameters)

    @property
    def restitution(self) -> float:
        """Newton's e [-] of a head-on impact of elastic disks under the damping λ: √((1 − λ)/(1 + λ)).

        The spring's force is raised by λ while it brakes and lowered by λ while it throws back.
        """
        return math.sqrt((1 - self.damping) / (1 + self.damping))

    def stiffnesses(self, radius1: float, radius2: float) -> tuple[float, float, float]:
        """k_n and k_s [N/m] and k_r [N m] of a contact of disks with these radii [m] as YADE makes them.

        k_n = 2 E R₁ R₂/(R₁ + R₂), E R for equal disks and for a wall; k_s and k_r by their ratios.
        """
        kn = 2 * self.young * radius1 * radius2 / (radius1 + radius2)
        ks = self.shear_ratio * kn
        return kn, ks, self.rolling_ratio * ks * radius1 * radius2

    def thresholds(self, length: float, normal: float = 0.0) -> tuple[float, float, float]:
        """Greatest tension and shear force [N] and torque [N m] of a bond: F_a = σ_ext ℓ, μ_s (F_a + N), μ_r ℓ (F_a +
        N).

        ``length``: ℓ [m]; ``normal``: N [N], compression positive (Taboada and Estrada 2009, eqs 2, 4 and 6). What the
        model has not is 0: the torque in "jcfpm", and all but friction in "friction", which has the residual value.
        """
        m = self.material
        if self.model == "friction":
            return 0.0, max(0.0, m.residual_friction * normal), 0.0
        tension = m.tensile_strength * length if m.bonded else 0.0
        held = max(0.0, tension + normal)
        return tension, m.friction * held, m.rolling_friction * length * held if self.model in ROLLING_MODELS else 0.0

    def attributes(self) -> dict:
        """{name: value} of the disks' material in YADE (CohFrictMat, JCFpmMat or FrictMat), in its units: rad, Pa,
        kg/m³, bool, else [-].

        It rules contacts that are not bonded, so frictionAngle is the arc tangent of the residual friction; a JCFpmMat
        has both angles. Strengths are such that YADE's own formulae give the bond's thresholds at the mean diameter,
        normalCohesion = σ_ext ℓ/R² and tensileStrength = σ_ext ℓ/(π R²) with R = ℓ/2.
        """
        m = self.material
        values = dict(
            density=m.density, young=self.young, poisson=self.shear_ratio, frictionAngle=math.atan(m.residual_friction)
        )
        stress = 4 * self.thresholds(self.length)[0] / self.length**2
        if self.model == "cohesion_moment":
            # YADE's arm is η min(R), the law's μ_r ℓ
            return values | dict(
                normalCohesion=stress,
                shearCohesion=m.friction * stress,
                etaRoll=2 * m.residual_rolling_friction,
                etaTwist=0,
                alphaKr=self.rolling_ratio,
                alphaKtw=0,
                momentRotationLaw=True,
                fragile=True,
                isCohesive=m.bonded,
            )
        if self.model == "jcfpm":
            return values | dict(
                tensileStrength=stress / math.pi,
                cohesion=m.friction * stress / math.pi,
                frictionAngle=math.atan(m.friction),
                residualFrictionAngle=math.atan(m.residual_friction),
            )
        return values


def refuse_closing(what, closes):
    """SoftError where bonds are to close freely."""
    if closes:
        raise SoftError(
            f"{what}: a soft bond presses as soon as its gap begins to close; take it away, or take rigid contacts"
        )


def equivalent(
    material: Material,
    stiffness: float,
    model: str = "cohesion_moment",
    *,
    diameter,
    shear_ratio: float = 0.3,
    rolling_ratio: float = 1.0,
    damping: float = 0.2,
    contacts: int = 6,
) -> Equivalent:
    """The soft model that stands for ``material``.

    ``stiffness``: Young's modulus E [Pa]; YADE makes k_n = E R [N/m] of it for disks of radius R, see
    :meth:`Equivalent.stiffnesses`. Rigid disks have none, so it is free: high enough that F_a/k_n is small beside the
    ellipse's half-axis ε_n ℓ. ``diameter``: of the disks [m], one number or (smallest, largest). The other arguments
    are fields of :class:`Equivalent`; ``shear_ratio``, ``rolling_ratio`` and ``damping`` have no counterpart in the
    hard law and are choices (0.2 is YADE's own).

    The step's limit is 2/ω, with ω² = z λ: λ is the largest eigenvalue of one contact between two free disks that have
    mass ρ π R² and inertia m R²/2, and z the ``contacts`` of a disk. An assembly vibrates no faster, since z equal
    parts of a disk's mass may be given to its contacts (the largest eigenvalue of a sum is at most that of its parts).
    The pair is two of the smallest disks, or the smallest and the largest. Disks of one size have six neighbours at
    most; more of them touch a disk much larger than they are.

    Raises SoftError for a value that cannot be used.
    """
    if model not in MODELS:
        raise SoftError(f"model {model!r}: YADE has no such model here; give one of {', '.join(MODELS)}")
    sizes = (diameter, diameter) if np.isscalar(diameter) else tuple(diameter)
    if len(sizes) != 2 or not 0 < sizes[0] <= sizes[1] < math.inf:
        raise SoftError(f"diameter {diameter!r}: give one positive number [m], or (smallest, largest)")
    for key, value, least in (
        ("stiffness", stiffness, 0.0),
        ("shear_ratio", shear_ratio, 0.0),
        ("contacts", contacts, 0),
    ):
        checks.number(key, value, SoftError, f"give a number greater than {least:g}", above=least)
    checks.number("rolling_ratio", rolling_ratio, SoftError, "give 0 or more", least=0)
    checks.number("damping", damping, SoftError, "give a number from 0 to less than 1", least=0, below=1)
    if material.density is None:
        raise SoftError(
            f"material {material.name}: density None, and the step depends on the disks' mass; add `density` (kg/m³, of the disks)"
        )
    if material.slip_weakening:
        raise SoftError(
            f"material {material.name}: slip_weakening {material.slip_weakening.law!r}, which no soft model has; take it away"
        )
    refuse_closing(f"material {material.name}: bonds_close true", material.bonds_close)
    if model == "cohesion_moment" and material.rolling_friction > 0 and rolling_ratio == 0:
        raise SoftError(
            f"rolling_ratio 0: the material {material.name} resists rolling, so its contacts need a stiffness; give more than 0"
        )
    sizes = tuple(map(float, sizes))
    parameters = dict(
        material=material,
        model=model,
        young=float(stiffness),
        shear_ratio=float(shear_ratio),
        rolling_ratio=float(rolling_ratio) if model == "cohesion_moment" else 0.0,
        damping=float(damping),
        diameters=sizes,
        contacts=int(contacts),
    )
    made = Equivalent(step_limit=math.nan, **parameters)
    squares = [_greatest_square(made, 0.5 * sizes[0], 0.5 * other) for other in sizes]
    return Equivalent(step_limit=2 / math.sqrt(contacts * max(squares)), **parameters)


def _greatest_square(e: Equivalent, radius1: float, radius2: float) -> float:
    """Largest ω² [1/s²] of two free disks in contact; freedoms x, y and angle of the one, then of the other, normal
    along x.
    """
    rows = np.array([[-1, 0, 0, 1, 0, 0], [0, -1, -radius1, 0, 1, -radius2], [0, 0, -1, 0, 0, 1]], float)
    masses = np.repeat([e.material.density * math.pi * r**2 for r in (radius1, radius2)], 3)
    masses[[2, 5]] *= 0.5 * np.square([radius1, radius2])
    reduced = rows / np.sqrt(masses)
    return float(np.linalg.eigvalsh(reduced.T @ np.diag(e.stiffnesses(radius1, radius2)) @ reduced)[-1])
