"""An equivalent soft model in words: its parameters as a table, and what it does not have of the hard law."""

from __future__ import annotations

import math
from typing import NamedTuple

from .parameters import Equivalent

__all__ = ["Description", "describe"]

_ALWAYS = (
    "rigidity: contacts yield before they reach a threshold, and disks overlap by N/k_n",
    "restitution: a spring gives speed back, less what damping takes; in the hard law e alone decides",
    "free motion: damping takes the part λ of every force that speeds a disk up, so disks fall with (1 − λ) g",
    "walls: no residual tensile strength, and no elliptic zone where bonds are fragile",
    "residual tensile strength σ_res: a contact that is not bonded bears no tension, and the parts μ_s σ_res ℓ and μ_r ℓ σ_res ℓ of its other "
    "thresholds are missing",
)
_BONDED = (
    "elliptic zone: a fragile bond breaks when its threshold is reached, after its elastic elongation, and not after a path of ε_n ℓ or ε_t ℓ at the "
    "threshold; the energy of a break is smaller",
    "softening by steps: a contact keeps the peak friction of its broken bond until soft.weaken() is called",
)
#: Attributes of the disks' material: what they are, unit, in the hard law. JCFpmMat.frictionAngle is that of a bond,
#: see :func:`describe`.
_ATTRIBUTES = {
    "density": ("density", "kg/m³", "ρ"),
    "young": ("Young's modulus", "Pa", "rigid"),
    "poisson": ("shear over normal stiffness", "", "rigid"),
    "frictionAngle": ("friction angle without a bond", "rad", "atan of the residual μ_s"),
    "residualFrictionAngle": ("friction angle without a bond", "rad", "atan of the residual μ_s"),
    "normalCohesion": ("tensile strength", "Pa", "σ_ext ℓ/R², R = ℓ/2"),
    "shearCohesion": ("shear strength", "Pa", "μ_s σ_ext ℓ/R²"),
    "tensileStrength": ("tensile strength", "Pa", "σ_ext ℓ/(π R²), R = ℓ/2"),
    "cohesion": ("shear strength", "Pa", "μ_s σ_ext ℓ/(π R²)"),
    "etaRoll": ("rolling arm over R without a bond", "", "2 times the residual μ_r"),
    "etaTwist": ("twisting arm over R", "", "plane: no twist"),
    "alphaKr": ("rolling stiffness over k_s R²", "", "rigid"),
    "alphaKtw": ("twisting stiffness over k_s R²", "", "plane: no twist"),
    "momentRotationLaw": ("contacts resist rolling", "", "they do"),
    "fragile": ("bonds break at a threshold", "", "they yield first; see bond(…, fragile=False)"),
    "isCohesive": ("disks may be bonded", "", "bonded"),
}
_LOST = {
    "cohesion_moment": (
        *_BONDED,
        "a bond over a gap that breaks lets go even under compression; the disks meet after closing the gap",
        "rolling of new contacts: the arm is 2 μ_r min(R) until soft.weaken() makes it μ_r ℓ",
    ),
    "jcfpm": (
        *_BONDED,
        "moments: neither bonds nor contacts resist rolling (μ_r and its residual value)",
        "distance at rest: a contact counts overlap from where it was made; one that was made over a gap presses before the disks touch, as long "
        "as it lives",
    ),
    "friction": (
        "bonds: no tension, shear or torque threshold from cohesion; friction is the residual one from the start",
        "moments: contacts do not resist rolling (the residual value of μ_r); cohesion_moment without bonds is friction with rolling",
    ),
}


class Description(NamedTuple):
    """``rows``: (what, in YADE, value, in the hard law), texts; ``lost``: sentences. As a string, both as plain
    text.
    """

    rows: tuple[tuple[str, str, str, str], ...]
    lost: tuple[str, ...]

    def __str__(self):
        widths = [max(map(len, column)) for column in zip(*self.rows)]
        lines = ["  ".join(cell.ljust(w) for cell, w in zip(row, widths)).rstrip() for row in self.rows]
        return "\n".join([*lines, "", "Not in the soft model:", *(f"* {line}" for line in self.lost)])


def describe(e: Equivalent) -> Description:
    """Parameters at the mean diameter, for a contact of two equal disks, with those of the hard law beside them; and
    what is lost.

    Every attribute that :func:`~yade.nonsmooth.soft.functors.material` sets has a row; YADE's angles are in rad, the
    law's friction is a coefficient.
    """
    m, length = e.material, e.length
    kn, ks, kr = e.stiffnesses(0.5 * length, 0.5 * length)
    tension, shear, torque = e.thresholds(length)
    law = {
        "cohesion_moment": "Law2_ScGeom6D_CohFrictPhys_CohesionMoment",
        "jcfpm": "Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM",
        "friction": "Law2_ScGeom_FrictPhys_CundallStrack",
    }[e.model]
    names = {
        "cohesion_moment": ("normalAdhesion", "shearAdhesion", "rollingAdhesion"),
        "jcfpm": ("FnMax", "FsMax", "-"),
        "friction": ("-", "-", "-"),
    }[e.model]
    rows = [
        ("quantity", "in YADE", "value", "hard law"),
        ("contact law", law, "-", "Law2_ScGeom_NscdPhys_SignoriniCoulomb"),
        ("mean diameter ℓ", "-", f"{length:.6g} m", "ℓ"),
        ("normal stiffness", "kn", f"{kn:.6g} N/m", "rigid"),
        ("shear stiffness", "ks", f"{ks:.6g} N/m", "rigid"),
        ("rolling stiffness", "kr", f"{kr:.6g} N m" if kr else "none", "rigid"),
        ("tension threshold", names[0], _force(tension, "N"), "F_a = σ_ext ℓ"),
        ("shear threshold at N = 0", names[1], _force(shear, "N"), "μ_s F_a"),
        ("torque threshold at N = 0", names[2], _force(torque, "N m"), "μ_r ℓ F_a"),
    ]
    if e.model != "friction":
        rows.append(
            (
                "friction of a bond",
                "tanFrictionAngle" if e.model == "jcfpm" else "tangensOfFrictionAngle",
                f"{m.friction:.6g}",
                "μ_s",
            )
        )
    if e.model == "cohesion_moment":
        rows += [
            ("rolling arm of a bond", "maxRollPl", f"{m.rolling_friction * length:.6g} m", "μ_r ℓ"),
            (
                "rolling arm without a bond",
                "maxRollPl",
                f"{m.residual_rolling_friction * length:.6g} m",
                "residual μ_r ℓ",
            ),
        ]
    if tension:
        rows += [
            (
                "elongation of a bond at its break",
                "F_a/kn",
                f"{tension / kn:.3g} m",
                f"ε_n ℓ = {m.bond_ellipse[0] * length:.3g} m",
            ),
            (
                "energy of a break in tension",
                "F_a²/(2 kn)",
                f"{tension**2 / (2 * kn):.3g} J",
                f"F_a ε_n ℓ = {tension * m.bond_ellipse[0] * length:.3g} J",
            ),
        ]
    rows += [
        ("restitution of elastic disks", f"damping {e.damping:g}", f"{e.restitution:.3g}", f"e = {m.restitution:g}"),
        ("largest stable time step", "O.dt", f"{e.step_limit:.3g} s", "no such limit"),
    ]
    kind = {"cohesion_moment": "CohFrictMat", "jcfpm": "JCFpmMat", "friction": "FrictMat"}[e.model]
    for name, value in e.attributes().items():
        what, unit, law_has = _ATTRIBUTES[name]
        if (e.model, name) == ("jcfpm", "frictionAngle"):
            what, law_has = "friction angle of a bond", "atan μ_s"
        shown = str(value) if isinstance(value, bool) else f"{value:.6g} {unit}".rstrip()
        rows.append(
            (what, f"{kind}.{name}", shown + (f" (atan {math.tan(value):.6g})" if unit == "rad" else ""), law_has)
        )
    return Description(tuple(rows), _ALWAYS + _LOST[e.model])


def _force(value: float, unit: str) -> str:
    return f"{value:.6g} {unit}" if value else "none"
