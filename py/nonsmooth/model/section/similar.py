"""The same slope seen in a mirror, and at another size. Needs no YADE.

Two slopes of rock are similar (Froude) where lengths are in the ratio s and gravity and densities are the same: then
times and speeds are in the ratio √s, stresses and so strengths in the ratio s, forces on walls in the ratio s² (per
metre of thickness), and numbers without a unit are equal.
"""

from __future__ import annotations

import copy
import dataclasses

from ...system import checks
from . import building as section_building, data as section_data, powers, shaking as section_shaking, stated
from . import water as section_water
from .powers import original_value
from .reader import Document, SectionError
from .section import Section

__all__ = ["mirrored", "mirrored_packing", "original_value", "scaled", "scaled_packing", "with_disks_of"]

FACTORS = (1e-5, 1e3)  # of sizes: a slope of 2 km from 2 cm to 2,000 km

_OF_A_SECTION = checks.takes(
    SectionError, section=checks.kind(Section, "give a Section, as section.load('circle') returns one")
)
_OF_A_PACKING = checks.takes(
    SectionError, packing=checks.has("x y r", "give a Packing, as packing.of(section) returns one")
)


@_OF_A_SECTION
def mirrored(section: Section) -> Section:
    """The Section with left and right exchanged: every x changes its sign. Mirrored twice it is as it was, to the last
    bit.
    """
    made = _rebuilt(section, _mirrored(section_data.plain(section)))
    like = section.like and (mirrored(section.like[0]), section.like[1])
    made = dataclasses.replace(made, like=like, disks=section.disks, scale=section.scale)
    return stated.keep(made, _mirrored(stated.given(section)))


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
    return section_building.build(Document(section.source, data), section.source, Section)


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
    made = _rebuilt(section, powers.scaled(section_data.plain(section), factor))
    original, whole = (section.like[0], factor * section.like[1]) if section.like else (section, factor)
    disks = section.disks.scaled(factor)  # with the count that was asked for
    made = dataclasses.replace(made, disks=disks, scale=section.scale, like=(original, whole))
    return stated.keep(made, powers.scaled(stated.given(section), factor))


@_OF_A_SECTION
@checks.takes(
    SectionError,
    original=checks.kind(Section, "give the Section that this one is like"),
    factor=checks.real("give the ratio of sizes"),
)
def with_disks_of(section: Section, original: Section, factor: float) -> Section:
    """The Section as one that is packed as ``original``, ``factor`` times as large."""
    return section._packed_as(original, factor)
