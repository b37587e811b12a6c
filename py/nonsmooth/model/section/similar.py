"""The same slope seen in a mirror, and at another size. Needs no YADE.

Two slopes of rock are similar (Froude) where lengths are in the ratio s and gravity and densities are the same: then
times and speeds are in the ratio √s, stresses and so strengths in the ratio s, forces on walls in the ratio s² (per
metre of thickness), and numbers without a unit are equal.
"""

from __future__ import annotations

import copy
import dataclasses
import math

from ...system import checks
from . import building as section_building, data as section_data, shaking as section_shaking, values as section_values
from . import water as section_water
from .reader import SectionError
from .section import Section
from .reader import Document

__all__ = ["mirrored", "mirrored_packing", "original_value", "scaled", "scaled_packing", "with_disks_of"]

FACTORS = (1e-5, 1e3)  # of sizes: a slope of 2 km from 2 cm to 2,000 km

# Powers of the ratio of lengths with which values go, by their keys without the names of items; for a list of pairs or
# triples one each. What is not here has no unit, or that of a density, of gravity or of a weight by volume.
TIME, LENGTH, SPEED, STRESS = 0.5, 1, 0.5, 1
POWERS = {
    "walls.vertices": LENGTH,
    "layers.vertices": LENGTH,
    "layers.disks.diameter": LENGTH,
    "disks.diameter": LENGTH,
    "materials.tensile_strength": STRESS,
    "materials.residual_tensile_strength": STRESS,
    "materials.slip_weakening.critical_slip": LENGTH,
    "materials.slip_law.cell_length": LENGTH,
    "materials.slip_weakening.tensile_strength": STRESS,
    "materials.envelope.cohesion": STRESS,
    "materials.cohesion": STRESS,
    "water.plane.point": LENGTH,
    "water.table.rate": SPEED,
    "water.table.points": (TIME, LENGTH),
    "water.release_distance": LENGTH,
    "water.release.drainage_time": TIME,
    "water.phreatic.lines.time": TIME,
    "water.phreatic.lines.points": LENGTH,
    "water.seepage.size": LENGTH,
    "water.seepage.conductivity": SPEED,
    "water.seepage.conductivity.along": SPEED,
    "water.seepage.conductivity.across": SPEED,
    "water.seepage.states.time": TIME,
    "water.seepage.states.reservoir": LENGTH,
    "water.seepage.states.rain": SPEED,
    "water.seepage.states.boundaries.line": LENGTH,
    "water.seepage.states.boundaries.head": LENGTH,
    "water.seepage.states.boundaries.pressure_head": LENGTH,
    "water.seepage.states.boundaries.reservoir": LENGTH,
    "water.seepage.states.boundaries.inflow": SPEED,
    "water.field.scale": LENGTH,
    "water.field.stretch": TIME,
    "water.field.states.time": TIME,
    "erosion.vertices": LENGTH,
    "erosion.begin": TIME,
    "erosion.end": TIME,
    "erosion.velocity": SPEED,
    "erosion.path": (TIME, LENGTH, LENGTH),
    "erosion.opening.time": TIME,
    "shaking.begin": TIME,
    "shaking.stretch": TIME,
    "stages.settle.ramp": TIME,
    "stages.settle.time_max": TIME,
    "stages.settle.speed_rest": SPEED,
    "stages.dry": TIME,
    "stages.water.hold": LENGTH,
    "stages.end.time": TIME,
    "stages.end.rest_hold": TIME,
    "numerics.time_step": TIME,
}
_OF_A_SECTION = checks.takes(
    SectionError, section=checks.kind(Section, "give a Section, as section.load('circle') returns one")
)
_OF_A_PACKING = checks.takes(
    SectionError, packing=checks.has("x y r", "give a Packing, as packing.of(section) returns one")
)
_NAMED = ("walls", "layers", "interfaces", "materials", "erosion")  # whose items have names
_BY_LAYER = "water.seepage.conductivity"  # whose keys are names of layers


@_OF_A_SECTION
def mirrored(section: Section) -> Section:
    """The Section with left and right exchanged: every x changes its sign. Mirrored twice it is as it was, to the last
    bit.
    """
    made = _rebuilt(section, _mirrored(section_data.plain(section)))
    like = section.like and (mirrored(section.like[0]), section.like[1])
    made = dataclasses.replace(made, like=like, disks=section.disks, scale=section.scale)
    return section_values.keep(made, _mirrored(section_values.given(section)))


def _mirrored(data):
    """Plain data of a section, mirrored."""

    def flipped(points):
        return [[0.0 - x, y] for x, y in points]

    data = copy.deepcopy(data)
    data["walls"] = [wall | {"vertices": flipped(reversed(wall["vertices"]))} for wall in reversed(data["walls"])]
    data["layers"] = [layer | {"vertices": flipped(reversed(layer["vertices"]))} for layer in data["layers"]]
    if "erosion" in data:
        data["erosion"] = [_mirrored_window(window, flipped) for window in data["erosion"]]
    water = data.get("water", {})
    if isinstance(water.get("plane"), dict):
        point, dip = water["plane"]["point"], water["plane"]["dip"]
        water["plane"] = {"point": flipped([point])[0], "dip": 0.0 - dip}
    section_water.mirror(water)
    if isinstance(water.get("pressure_gradient"), list):
        x, y = water["pressure_gradient"]
        water["pressure_gradient"] = [0.0 - x, y]
    if "shaking" in data:
        data["shaking"] = section_shaking.mirrored(data["shaking"])
    return data


def _mirrored_window(window, flipped):
    made = window | {"vertices": flipped(reversed(window["vertices"]))}
    if "velocity" in window:
        made["velocity"] = flipped([window["velocity"]])[0]
    if "path" in window:
        made["path"] = [[t, 0.0 - x, y] for t, x, y in window["path"]]
    if "direction" in window.get("opening", {}):
        made["opening"] = window["opening"] | {"direction": flipped([window["opening"]["direction"]])[0]}
    return made


def _rebuilt(section, data):
    """The Section of plain data that were those of a checked one, under its name."""
    return section_building.build(Document(section.source, data), section.source)


@_OF_A_PACKING
def mirrored_packing(packing):
    """A Packing with left and right exchanged."""
    return dataclasses.replace(packing, x=0.0 - packing.x)


@_OF_A_PACKING
@checks.takes(SectionError, factor=checks.real("give the ratio of sizes"))
def scaled_packing(packing, factor):
    """A Packing ``factor`` times as large."""
    return dataclasses.replace(packing, x=factor * packing.x, y=factor * packing.y, r=factor * packing.r)


@_OF_A_SECTION
def scaled(section: Section, factor: float) -> Section:
    """The Section ``factor`` times as large, with all times, speeds and strengths so that it does the same, and with
    the same packing. Raises SectionError for a factor out of all bounds.
    """
    remedy = f"give a factor from {FACTORS[0]:g} to {FACTORS[1]:g}"
    checks.number(f"{section.source}: factor", factor, SectionError, remedy, least=FACTORS[0], most=FACTORS[1])
    for name, material in section.materials.items():
        if material.slip_law is not None:
            raise SectionError(
                f"{section.source}: material {name}: a slip law that heats has no similar one, as heat spreads at its own "
                "rate; leave --size out, or the slip_law"
            )
    made = _rebuilt(section, _scaled(section_data.plain(section), factor))
    original, whole = (section.like[0], factor * section.like[1]) if section.like else (section, factor)
    disks = section.disks.scaled(factor)  # with the count that was asked for
    made = dataclasses.replace(made, disks=disks, scale=section.scale, like=(original, whole))
    return section_values.keep(made, _scaled(section_values.given(section), factor))


@_OF_A_SECTION
@checks.takes(
    SectionError,
    original=checks.kind(Section, "give the Section that this one is like"),
    factor=checks.real("give the ratio of sizes"),
)
def with_disks_of(section: Section, original: Section, factor: float) -> Section:
    """The Section as one that is packed as ``original``, ``factor`` times as large."""
    layers = tuple(
        dataclasses.replace(mine, disks=theirs.with_disks(factor).disks)
        for mine, theirs in zip(section.layers, original.layers)
    )
    disks = original.disks.scaled(factor)
    return dataclasses.replace(section, disks=disks, layers=layers, scale=original.scale, like=(original, factor))


def original_value(key, value, factor):
    """The value of a key of a section (see :mod:`.section_values`) that is ``factor`` times as large as its original,
    for the original.
    """
    words = section_values.words(key)
    if len(words) == 1:
        return _scaled({words[0]: value}, 1 / factor)[words[0]]
    if ".".join(words[:-1]) == _BY_LAYER:
        return _value(_BY_LAYER, {words[-1]: value}, 1 / factor)[words[-1]]
    if ".".join(words[:3]) == _BY_LAYER:
        words = words[:3] + words[4:]
    return _value(".".join(words[:1] + words[2:] if words[0] in _NAMED else words), value, 1 / factor)


def _scaled(data, factor):
    """Plain data of a section, ``factor`` times as large."""
    made = {}
    for key, value in data.items():
        if key not in _NAMED:
            made[key] = _value(key, value, factor)
        elif isinstance(value, dict):
            made[key] = {name: _value(key, item, factor) for name, item in value.items()}
        else:
            made[key] = [_value(key, item, factor) for item in value]
    return made


def _value(key, value, factor):
    if key == _BY_LAYER and isinstance(value, dict):
        return {name: _of_layer(one, factor) for name, one in value.items()}
    if isinstance(value, dict):
        return {word: _value(f"{key}.{word}", inside, factor) for word, inside in value.items()}
    if isinstance(value, list) and all(isinstance(item, dict) for item in value):
        return [_value(key, item, factor) for item in value]
    power = POWERS.get(key)
    return copy.deepcopy(value) if power is None else _times(value, power, factor)


def _of_layer(value, factor):
    """The conductivity of one layer: a number, or {along, across, dip}."""
    if not isinstance(value, dict):
        return _value(_BY_LAYER, value, factor)
    return {word: _value(f"{_BY_LAYER}.{word}", inside, factor) for word, inside in value.items()}


def _times(value, power, factor):
    if isinstance(value, (list, tuple)):
        pairs = isinstance(power, tuple)
        return [
            _times(v, power[k] if pairs and not isinstance(v, (list, tuple)) else power, factor)
            for k, v in enumerate(value)
        ]
    if isinstance(value, str) or not isinstance(value, (int, float)):
        return value  # a word, as critical_slip; or what the schema will refuse
    return (math.sqrt(factor) if power == 0.5 else factor) * value
