"""Contact parameters of a rock that is asked for by its cohesion c and angle of friction φ, from a table of calibrated
rocks. Needs no YADE.

``sections/rocks.json`` has c/σ_ext and φ of samples with some frictions μ_s of their contacts
(:mod:`.laboratory.rock_table` measured them). The law:

    μ_s  from φ: ln μ_s linear in φ between the rocks of the table,
    σ_ext = c / (c/σ_ext), with ln(c/σ_ext) linear in ln μ_s between them.

The second is exact in σ_ext: rigid disks know no other stress than σ_ext and the pressure, so samples whose strengths
are all k times as large bear k times the stresses at the same strains. The first leaves an error, which the table
states beside the scatter of samples.

A rock without cohesion has contacts without tension, and the friction that the law has for its φ: samples whose bonds
bear nothing beside the pressure.
"""

from __future__ import annotations

import dataclasses
import functools
import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

__all__ = [
    "ASKED",
    "Contacts",
    "REACHED",
    "asked",
    "contacts",
    "friction_angle",
    "interval",
    "like_table",
    "other_samples",
    "reach",
    "reduced",
    "resolved",
    "table",
]

FILE = Path(__file__).resolve().parents[1] / "sections" / "rocks.json"
ASKED = ("cohesion", "friction_angle")  # the keys that ask for a rock of the table
# degrees of φ that samples of disks reach: without friction between disks, and with as much as there may be
REACHED = (6.0, 60.0)
# of exponentials, whose last bits are a processor's own, and a slope grows them; of these alone, so that strengths go
# with the cohesion to the last bit
DIGITS = 4


@dataclass(frozen=True)
class Contacts:
    """``friction`` μ_s and ``tensile_strength`` σ_ext [Pa] of contacts; what a sample, of as many disks as those of the
    table, may differ by from the c and φ that were asked for (half of the 95 % interval): ``cohesion_95_rel``,
    relative, under other pressures than the table's too, and ``friction_angle_95_deg`` [degrees].
    """

    friction: float
    tensile_strength: float
    cohesion_95_rel: float
    friction_angle_95_deg: float


@functools.cache
def table() -> dict:
    """The table, as its file has it."""
    return json.loads(FILE.read_text(encoding="utf-8"))


@functools.cache
def _columns():
    """φ [degrees], ln μ_s and ln(c/σ_ext) of the rocks, by rising φ: arrays (n,)."""
    rows = table()["rocks"]
    angle, mu, share = (
        np.array([value(row) for row in rows])
        for value in (
            lambda row: row["friction_angle_deg"]["mean"],
            lambda row: row["friction"],
            lambda row: row["cohesion_over_tensile_strength"]["mean"],
        )
    )
    return angle, np.log(mu), np.log(share)


def interval() -> tuple[float, float]:
    """The smallest and the largest angle of friction [degrees] of the table, inwards to a tenth."""
    angle = _columns()[0]
    return math.ceil(10 * angle[0]) / 10, math.floor(10 * angle[-1]) / 10


def friction_angle(friction: float) -> float:
    """φ [degrees] of the rocks of the table whose contacts have the friction μ_s; that of the nearest one outside."""
    angle, mu, _ = _columns()
    return float(np.interp(math.log(friction), mu, angle)) if friction > 0 else float(angle[0])


def contacts(cohesion: float, friction_angle: float) -> Contacts:
    """The Contacts for c [Pa], 0 or more, and φ [degrees], within the :func:`interval`; ValueError outside."""
    low, high = interval()
    if not (cohesion >= 0 and low <= friction_angle <= high):
        raise ValueError(
            f"c = {cohesion:g} Pa, φ = {friction_angle:g}°: the table holds c of 0 or more, φ from {low:g} to {high:g}°"
        )
    angle, mu, share = _columns()
    at = float(np.interp(friction_angle, angle, mu))
    over = float(np.interp(at, mu, share))
    known = table()
    sample = known["one_sample_95"]
    return Contacts(
        _rounded(math.exp(at)),
        cohesion / _rounded(math.exp(over)),
        math.hypot(sample["cohesion_rel"], known["curvature_rel"]),
        sample["friction_angle_deg"],
    )


def _rounded(value):
    return float(f"{value:.{DIGITS}g}")


def _fixed(bonded) -> dict:
    """What all rocks of the table share but that those without cohesion are not ``bonded``. The table is older than
    ``bonds_close``, and was measured without.
    """
    return {"bonds_close": False, **table()["fixed"], "bonded": bonded}


def resolved(raw: dict, refuse) -> dict:
    """The data of a material that is asked for by :data:`ASKED`, with contact parameters in their place, and what was
    asked for as the ``envelope``; other data as they are.

    ``refuse(keys, what, remedy)``: raises, for what the table cannot give or was not measured with.
    """
    given = [key for key in ASKED if key in raw]
    if not given:
        return raw
    cohesion, angle = (float(raw[key]) for key in ASKED)
    beside = f"is given beside cohesion: {cohesion:g} and friction_angle: {angle:g}"
    for key in ("friction", "tensile_strength", "envelope"):
        if key in raw:
            refuse(
                (key,),
                f"{raw[key]} {beside}, which say what it is"
                if key != "envelope"
                else f"{beside}, which are the envelope",
                f"leave {key} out, or give friction and tensile_strength of contacts instead of cohesion and friction_angle",
            )
    for key in {"slip_weakening", "slip_law"} & raw.keys():
        refuse(
            (key,),
            f"{beside}, and only walls weaken with slip, which have the friction of their contacts",
            "give the wall a material with friction instead of cohesion and friction_angle",
        )
    if cohesion > 0 and not raw.get("bonded", True):
        refuse(("bonded",), f"false {beside}, and cohesion is that of bonds", "leave bonded out, or give cohesion: 0")
    low, high = interval()
    search = f"scripts/calibrate.py --cohesion {cohesion:g} --friction {angle:g}"
    if not low <= angle <= high:
        refuse(
            ("friction_angle",),
            f"{angle:g} degrees is outside the table of calibrated rocks, which has {low:g} to {high:g} degrees",
            "give an angle within"
            + (f", or let {search} search the contact parameters" if REACHED[0] < angle < REACHED[1] else ""),
        )
    for key, value in _fixed(cohesion > 0).items():
        if key in raw and raw[key] != value:
            refuse(
                (key,),
                f"{raw[key]} {beside}, and the table of calibrated rocks was measured with {value}",
                f"leave {key} out, or let {search} --start FILE search the contact parameters of such a rock",
            )
    found = contacts(cohesion, angle)
    for key, span in table()["open"].items():
        # what was rounded to some digits is not refused
        least, most = (span[end] * getattr(found, span["of"]) for end in ("from", "to"))
        if key in raw and not least * (1 - 1e-3) <= raw[key] <= most * (1 + 1e-3):
            refuse(
                (key,),
                f"{raw[key]} {beside}, of which the table of calibrated rocks was measured with {least:g} to {most:g}",
                f"give a value within, leave {key} out, or let {search} --start FILE search the contact parameters of such a rock",
            )
    usual = table()["usual"]
    made = {
        "friction": found.friction,
        "tensile_strength": found.tensile_strength,
        "residual_friction": _rounded(usual["residual_friction_over_friction"] * found.friction),
        "residual_tensile_strength": usual["residual_tensile_strength_over_tensile_strength"] * found.tensile_strength,
        **table()["fixed"],
        "bonded": cohesion > 0,
        **{k: v for k, v in raw.items() if k not in ASKED},
    }
    return made | {"envelope": dict(zip(("cohesion", "friction_deg"), (cohesion, angle)))}


def like_table(material) -> bool:
    """Whether a section.Material has the contact parameters that are fixed in the table, so that the table may say what
    its others make.
    """

    def plain(value):
        return list(value) if isinstance(value, tuple) else value

    return all(plain(getattr(material, key)) == value for key, value in _fixed(material.bonded).items())


def asked(material) -> Contacts | None:
    """The Contacts of the table for the envelope of a section.Material whose contact parameters are these; None for
    another material.
    """
    e = material.envelope
    low, high = interval()
    if e is None or not (low <= e.friction_deg <= high and like_table(material)):
        return None
    if material.bonded != (e.cohesion > 0):
        return None
    found = contacts(e.cohesion, e.friction_deg)

    # of a scaled section another last digit
    def near(a, b):
        return math.isclose(a, b, rel_tol=1e-3)

    same = near(material.friction, found.friction) and near(material.tensile_strength, found.tensile_strength)
    return found if same else None


def reach(material) -> tuple[float, float]:
    """The smallest and the largest factor by which the envelope of a section.Material of the table (:func:`asked`) may
    be divided: tan φ over those of the table's ends.
    """
    tangent = math.tan(math.radians(material.envelope.friction_deg))
    low, high = (math.tan(math.radians(angle)) for angle in interval())
    return tangent / high, tangent / low


def reduced(material, factor):
    """A section.Material of the table (:func:`asked`) with its envelope divided by a ``factor``: the contacts that the
    table has for c/F and tan φ/F, and residual values in proportion to them.

    Raises ValueError for a factor beyond its :func:`reach`.
    """
    if factor == 1:  # the one that there is, which a scaled section has with other last digits
        return material
    e, (low, high) = material.envelope, interval()
    angle = math.degrees(math.atan(math.tan(math.radians(e.friction_deg)) / factor))
    if math.isclose(angle, low) or math.isclose(angle, high):  # the reach itself, but for rounding
        angle = min(max(angle, low), high)
    found = contacts(e.cohesion / factor, angle)
    friction = found.friction / material.friction
    tension = found.tensile_strength / material.tensile_strength if material.tensile_strength else 1.0
    return dataclasses.replace(
        material,
        friction=found.friction,
        residual_friction=material.residual_friction * friction,
        tensile_strength=found.tensile_strength,
        residual_tensile_strength=material.residual_tensile_strength * tension,
        envelope=dataclasses.replace(e, cohesion=e.cohesion / factor, friction_deg=angle),
    )


def other_samples(disks, pressed) -> str:
    """How the samples of the table differ from layers of the section_parts.Disks in a list, ``pressed`` or not, in
    words; "" where they do not.
    """
    samples = table()["samples"]
    ratio, kind, fraction = (samples[key] for key in ("largest_over_smallest", "distribution", "packing_fraction"))
    found = []
    if any(abs(d.d_max / d.d_min / ratio - 1) > 0.01 or d.distribution != kind for d in disks):
        found.append(f"diameters in the ratio 1 to {ratio:g} ({kind})")
    if any(abs(d.packing_fraction - fraction) > 0.01 for d in disks):
        found.append(f"a packing fraction of {fraction:g}")
    if not pressed:
        found.append("`pressed: true`")
    return ", ".join(found)
