"""From a soft material or bond back to a Contact Dynamics material, where one exists."""

from __future__ import annotations

import dataclasses
import math

from ...model.section import Material
from .parameters import SoftError

__all__ = ["material_of"]

#: Relative difference of two ratios that must be one: of numbers written with some four digits.
SAME = 1e-4


def material_of(
    soft, diameter: float | None = None, *, residual: Material | None = None, name: str = "soft"
) -> Material:
    """The section.Material whose bonds have the thresholds of ``soft``.

    ``soft``: an interaction that is a CohFrictPhys bond, with ℓ of its geometry; or a CohFrictMat, JCFpmMat or
    FrictMat, then for two disks of ``diameter`` [m], and with another one σ_ext is another, as YADE's thresholds go
    with min(R)² and the law's with ℓ. ``residual``: a material for what a bond does not tell (residual strengths,
    ellipse, density); else residual values are the peak ones.

    The inverse of YADE's formulae with R = ℓ/2, where C_n is normalCohesion: F_a = C_n R², its shear part C_s R², and
    its rolling part ¼ C_n R³. The law has one F_a in all three thresholds (Taboada and Estrada 2009, eqs 2, 4 and 6),
    so a counterpart exists if C_s = μ_s C_n and, with moments, if the rolling part is F_a times the arm η R: for YADE's
    own ¼ C_n R³ if η is ¼. In JCFpm π R² stands for R².

    Raises SoftError where there is none, naming the attribute and its value.
    """
    kind = type(soft).__name__
    read = {"Interaction": _bond, "CohFrictMat": _coh_frict, "JCFpmMat": _jcfpm, "FrictMat": _frict}.get(kind)
    if read is None:
        raise SoftError(
            f"{kind}: no counterpart is known; give a CohFrictMat, JCFpmMat or FrictMat, or an interaction with CohFrictPhys"
        )
    if kind != "Interaction" and not (diameter and 0 < diameter < math.inf):
        raise SoftError(
            f"diameter {diameter!r}: give the disks' diameter [m], on which the strength of a {kind} depends"
        )
    values = read(soft, diameter)
    if residual is None:
        values = {
            "residual_friction": values["friction"],
            "residual_rolling_friction": values["rolling_friction"],
            "bonded": values["tensile_strength"] > 0,
            **values,
        }
        return Material(name=name, **values)
    return dataclasses.replace(residual, name=name, **values)


def _bond(interaction, _):
    p = interaction.phys
    if type(p).__name__ != "CohFrictPhys":
        raise SoftError(
            f"interaction {interaction.id1}-{interaction.id2}: its physics is {type(p).__name__}; give one with CohFrictPhys"
        )
    if p.cohesionBroken:
        raise SoftError(
            f"interaction {interaction.id1}-{interaction.id2}: cohesionBroken True, so it has no bond; give one that holds"
        )
    length = interaction.geom.refR1 + interaction.geom.refR2
    torque, arm = (p.rollingAdhesion, p.maxRollPl) if p.momentRotationLaw and p.kr > 0 else (0.0, 0.0)
    return _from_thresholds(
        p.normalAdhesion,
        p.shearAdhesion,
        torque,
        p.tangensOfFrictionAngle,
        arm,
        length,
        ("normalAdhesion", "shearAdhesion", "rollingAdhesion", "maxRollPl"),
    )


def _coh_frict(mat, diameter):
    radius = 0.5 * diameter
    moments = mat.momentRotationLaw and mat.alphaKr > 0
    if moments and mat.etaRoll < 0:
        raise SoftError(
            f"CohFrictMat: etaRoll {mat.etaRoll:g} makes rolling elastic without a threshold, which the law has not; give 0 or more"
        )
    arm = mat.etaRoll * radius if moments else 0.0
    if not mat.isCohesive:
        return dict(
            density=mat.density,
            **_from_thresholds(0.0, 0.0, 0.0, math.tan(mat.frictionAngle), arm, diameter, ("",) * 4),
        )
    if mat.normalCohesion < 0 or mat.shearCohesion < 0:
        raise SoftError(
            f"CohFrictMat: normalCohesion {mat.normalCohesion:g}, shearCohesion {mat.shearCohesion:g}; give strengths, 0 or more"
        )
    torque = 0.25 * mat.normalCohesion * radius**3 if moments else 0.0
    values = _from_thresholds(
        mat.normalCohesion * radius**2,
        mat.shearCohesion * radius**2,
        torque,
        math.tan(mat.frictionAngle),
        arm,
        diameter,
        ("normalCohesion", "shearCohesion", "rolling part normalCohesion R/4", "etaRoll R"),
    )
    return dict(density=mat.density, **values)


def _jcfpm(mat, diameter):
    area = math.pi * (0.5 * diameter) ** 2
    values = _from_thresholds(
        mat.tensileStrength * area,
        mat.cohesion * area,
        0.0,
        math.tan(mat.frictionAngle),
        0.0,
        diameter,
        ("tensileStrength", "cohesion", "", ""),
    )
    angle = mat.residualFrictionAngle if mat.residualFrictionAngle >= 0 else mat.frictionAngle
    return dict(density=mat.density, residual_friction=math.tan(angle), **values)


def _frict(mat, diameter):
    return dict(
        density=mat.density, **_from_thresholds(0.0, 0.0, 0.0, math.tan(mat.frictionAngle), 0.0, diameter, ("",) * 4)
    )


def _from_thresholds(tension, shear, torque, friction, arm, length, names):
    """Values of a Material from thresholds at N = 0 [N, N, N m], the coefficient of friction and the arm of rolling
    [m].
    """
    for name, found, factor, key in (
        (names[1], shear, friction, "the coefficient of friction"),
        (names[2], torque, arm, names[3]),
    ):
        if abs(found - factor * tension) > SAME * max(abs(found), abs(factor * tension)):
            raise SoftError(
                f"{name}: it makes {found:g} of the threshold at N = 0, and the law has {factor * tension:g}, {key} times {names[0]}; "
                f"change {name}, for no Contact Dynamics material has both"
            )
    return dict(tensile_strength=tension / length, friction=friction, rolling_friction=arm / length)
