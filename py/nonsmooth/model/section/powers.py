"""Values of a section at another size: the powers of the ratio of lengths with which they go, see :mod:`.similar`.
Needs no YADE.
"""

from __future__ import annotations

import copy
import math

from . import stated

__all__ = ["POWERS", "original_value", "scaled"]

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
_NAMED = ("walls", "layers", "interfaces", "materials", "erosion")  # whose items have names
_BY_LAYER = "water.seepage.conductivity"  # whose keys are names of layers


def original_value(key, value, factor):
    """The value of a key of a section (see :mod:`.section_values`) that is ``factor`` times as large as its original,
    for the original.
    """
    words = stated.words(key)
    if len(words) == 1:
        return scaled({words[0]: value}, 1 / factor)[words[0]]
    if ".".join(words[:-1]) == _BY_LAYER:
        return _value(_BY_LAYER, {words[-1]: value}, 1 / factor)[words[-1]]
    if ".".join(words[:3]) == _BY_LAYER:
        words = words[:3] + words[4:]
    return _value(".".join(words[:1] + words[2:] if words[0] in _NAMED else words), value, 1 / factor)


def scaled(data, factor):
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
