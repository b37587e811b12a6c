"""Values of a section that no rock, soil or water has, and that are common ones in another unit: friction in degrees,
strengths in kPa, unit weights in kN/m³. Needs no YADE.

Such a value is refused with what it would be in the section's units. A section that means it lists its key in
``unusual``.
"""

from __future__ import annotations

import math

from .. import geometry
from ..scales import GRAVITY

__all__ = ["check", "check_material", "hint", "wrong"]

STEEPEST = 3.0  # coefficient of sliding friction, of 72°; no contact of rock or soil has it
ROLLING = 2.0  # of rolling friction in mean diameters: a grain would have to be rolled over more than its own length
DENSITY = (300.0, 10_000.0)  # kg/m³, from light snow or pumice to ores
WATER = (
    300.0,
    20_000.0,
)  # kg/m³, of the fluid; wide, as a file may state the unit weight on Earth, and a sweep change gravity
GRADIENT = (0.02, 50.0)  # of the unit weight of water
# of the weight by area of the slope, ρ g L: a strength below it does nothing there; 5 kPa on the paper's slope is five
# times as much
WEAKEST = 2e-4
NOMINAL = 2000.0  # kg/m³, ρ of that
LEAST_ANGLE = 3.0  # degrees, of a measured envelope; smaller ones are radians

#: Parameters of slip laws: {key: (least, most, what a value beyond is likely to be)}; rocks, clays and water have some
#: thousandth of the most, and a thousand times the least.
_ZONES = {
    "heat_capacity": (1e5, 1e8, "J/(m³ K): {0:g} MJ/(m³ K) are {1:g}", 1e6),
    "thermal_diffusivity": (0.0, 1e-3, "m²/s: {0:g} mm²/s are {1:g}", 1e-6),
    "pressurization_coefficient": (1e2, 1e8, "Pa/K: {0:g} MPa/K are {1:g}", 1e6),
    "thickness": (0.0, 2.0, "m: {0:g} mm are {1:g}", 1e-3),
}
_STRENGTHS = ("cohesion", "tensile_strength", "residual_tensile_strength")
_FRICTIONS = ("friction", "residual_friction")
_ROLLING = ("rolling_friction", "residual_rolling_friction")


def check(document) -> None:
    """Raise SectionError at the first value of a section, plain data that meet the schema, that looks like one in
    another unit and that is not listed in ``unusual``.
    """
    data = document.data
    gravity, meant = data.get("gravity", GRAVITY), data.get("unusual", ())
    area = math.fsum(geometry.area(layer["vertices"]) for layer in data["layers"])
    stress = NOMINAL * gravity * math.sqrt(area)
    for name, material in data["materials"].items():
        for keys, value in _values(material):
            _check(document, ("materials", name, *keys), _of_material(keys, value, gravity, stress), meant)
    water = data.get("water", {})
    weight = water.get("unit_weight", 1000.0 * gravity)
    _check(document, ("water", "unit_weight"), _unit_weight(weight, gravity), meant)
    if isinstance(water.get("pressure_gradient"), list):
        _check(document, ("water", "pressure_gradient"), _gradient(water["pressure_gradient"], weight), meant)


def check_material(document) -> None:
    """The same for a material file, by what needs no slope to compare with."""
    for keys, value in _values(document.data):
        _check(document, keys, _of_material(keys, value, GRAVITY, 0.0), None)


def hint(key, value) -> str:
    """What a number that is out of all bounds may be in the units of a section; ``key``: the last word of its key.
    Empty where that is not known.
    """
    found = _of_material((key,), value, GRAVITY, 0.0) or (
        _unit_weight(value, GRAVITY) if key == "unit_weight" else None
    )
    return found[1] if found else ""


def wrong(key, value) -> str:
    """What is wrong with a number of a material that stands in no section, and what may be meant, as one sentence;
    empty where nothing is.
    """
    return "; ".join(_of_material((key,), value, GRAVITY, 0.0) or ())


def _values(material):
    """((key, …), number) of a material's data."""
    for key, value in material.items():
        if isinstance(value, dict):
            yield from (((key, *words), inside) for words, inside in _values(value))
        elif _is_number(value):
            yield (key,), value


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _check(document, keys, found, meant):
    key = ".".join(keys)
    if found is None or (meant is not None and key in meant):
        return
    insist = f"; if it is meant, add `unusual: [{key}]` to the section" if meant is not None else ""
    document.refuse(keys, found[0], found[1] + insist)


def _of_material(keys, value, gravity, stress):
    """(what is wrong, what may be meant) of a number of a material; None where nothing is. ``stress`` [Pa]: the weight
    by area of the slope.
    """
    key = keys[-1]
    if key in _FRICTIONS and value > STEEPEST:
        angle = f": {value:g} degrees are {math.tan(math.radians(value)):.3g}" if value < 89 else ""
        return f"{value:g} is no coefficient of friction", f"friction is the tangent of an angle{angle}"
    if key in _ROLLING and value > ROLLING:
        return (
            f"{value:g} is no coefficient of rolling friction",
            "it is in mean diameters; grains of rock have some 0.1",
        )
    if key == "density" and not DENSITY[0] <= value <= DENSITY[1]:
        return f"{value:g} kg/m³ is no density of a rock or a soil", _density(value, gravity)
    if key in _STRENGTHS and 0 < value < WEAKEST * stress:
        return (
            f"{value:g} Pa is next to nothing beside the weight of this slope, some {_pascals(stress)}",
            f"strengths are in Pa: {value:g} kPa are {1e3 * value:g}, and 0 is none",
        )
    if "slip_law" in keys and key in _ZONES:
        low, high, unit, factor = _ZONES[key]
        if value > high or 0 < value < low:
            return f"{value:g} is no {key} of a slip zone", f"it is in {unit.format(value, factor * value)}"
    if key == "friction_deg" and value < LEAST_ANGLE:
        return (
            f"{value:g} degrees is no angle of friction",
            f"it is in degrees: {value:g} rad are {math.degrees(value):.3g}",
        )
    return None


def _density(value, gravity):
    unit = {"g/cm³": (1.0, 9.0, 1e3), "kN/m³": (9.0, 90.0, 1e3 / gravity), "N/m³": (DENSITY[1], 9e4, 1 / gravity)}
    for name, (low, high, factor) in unit.items():
        if low <= value <= high:
            return f"density is in kg/m³: {value:g} {name} are {value * factor:.4g}"
    return "density is in kg/m³, and rock has some 2500"


def _pascals(value):
    return (
        f"{1e-6 * value:.2g} MPa" if value >= 1e6 else f"{1e-3 * value:.2g} kPa" if value >= 1e3 else f"{value:.2g} Pa"
    )


def _unit_weight(value, gravity):
    if WATER[0] <= value / gravity <= WATER[1]:
        return None
    named = "kN/m³" if 3 <= value / gravity * 9.81 <= 100 else "kg/m³" if 300 <= value <= 3000 else ""
    meant = f": {value:g} {named} are {value * (1e3 if named == 'kN/m³' else gravity):g}" if named else ""
    return (
        f"{value:g} N/m³ is that of a fluid of {value / gravity:.3g} kg/m³",
        f"the unit weight of water is in N/m³, its density times gravity{meant or f': some {1000 * gravity:g}'}",
    )


def _gradient(value, weight):
    x, y = value
    size = math.hypot(x, y)
    if y > 0:
        return (
            f"[{x:g}, {y:g}] has a pressure that grows upwards",
            f"the gradient is that of the pressure, which grows downwards, and not the force: still water has [0, {-weight:g}]",
        )
    if size and not GRADIENT[0] <= size / weight <= GRADIENT[1]:
        scale = f": {size:g} kN/m³ are {1e3 * size:g}" if GRADIENT[0] <= 1e3 * size / weight <= GRADIENT[1] else ""
        return (
            f"[{x:g}, {y:g}] is {size / weight:.2g} of the unit weight of water, {weight:g} N/m³",
            f"the gradient is in N/m³{scale}",
        )
    return None
