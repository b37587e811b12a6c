"""The same slope seen in a mirror, and at another size. Needs no YADE.

Two slopes of rock are similar (Froude) where lengths are in the ratio s and gravity and densities are the same: then times and speeds are in the ratio √s,
stresses and so strengths in the ratio s, forces on walls in the ratio s² (per metre of thickness), and numbers without a unit are equal.
"""

from __future__ import annotations

import dataclasses
import math
from types import MappingProxyType

from .section import Section, SectionError

__all__ = ["mirrored", "mirrored_packing", "scaled", "scaled_packing"]

FACTORS = (1e-5, 1e3)  # of sizes: a slope of 2 km from 2 cm to 2,000 km


def mirrored(section: Section) -> Section:
    """The Section with left and right exchanged: every x changes its sign. Mirrored twice it is as it was, to the last bit."""
    flipped = lambda vertices: tuple((0.0 - x, y) for x, y in reversed(vertices))  # noqa: E731
    walls = tuple(dataclasses.replace(w, vertices=flipped(w.vertices)) for w in reversed(section.walls))
    layers = tuple(dataclasses.replace(layer, vertices=flipped(layer.vertices)) for layer in section.layers)
    water = section.water
    if water is not None:
        (x, y), slope = water.point, water.pressure_gradient
        if not isinstance(slope, str):
            slope = (0.0 - slope[0], slope[1])
        water = dataclasses.replace(water, point=(0.0 - x, y), dip=0.0 - water.dip, pressure_gradient=slope)
    like = section.like and (mirrored(section.like[0]), section.like[1])
    return dataclasses.replace(section, walls=walls, layers=layers, water=water, like=like)


def mirrored_packing(packing):
    """A Packing with left and right exchanged."""
    return dataclasses.replace(packing, x=0.0 - packing.x)


def scaled_packing(packing, factor):
    """A Packing ``factor`` times as large."""
    return dataclasses.replace(packing, x=factor * packing.x, y=factor * packing.y, r=factor * packing.r)


def scaled(section: Section, factor: float) -> Section:
    """The Section ``factor`` times as large, with all times, speeds and strengths so that it does the same, and with the same packing. Raises SectionError for a factor out of all bounds."""
    if not FACTORS[0] <= factor <= FACTORS[1]:
        raise SectionError(
            f"{section.source}: {factor:g} times as large; give a factor from {FACTORS[0]:g} to {FACTORS[1]:g}"
        )
    s, t = factor, math.sqrt(factor)
    grown = lambda vertices: tuple((s * x, s * y) for x, y in vertices)  # noqa: E731
    sizes = lambda items: tuple(
        dataclasses.replace(item, vertices=grown(item.vertices)) for item in items
    )  # noqa: E731
    materials = {name: _material(m, s) for name, m in section.materials.items()}
    water, stages = section.water, section.stages
    if water is not None:
        release = water.release_distance
        table = tuple((t * when, s * height) for when, height in water.table)
        water = dataclasses.replace(
            water,
            point=grown([water.point])[0],
            table=table,
            rate=t * water.rate,
            release_distance=release if isinstance(release, str) else s * release,
        )
    settle = dataclasses.replace(
        stages.settle,
        ramp=t * stages.settle.ramp,
        time_max=t * stages.settle.time_max,
        speed_rest=t * stages.settle.speed_rest,
    )
    end = dataclasses.replace(stages.end, time=t * stages.end.time, rest_hold=t * stages.end.rest_hold)
    hold = stages.water_hold if isinstance(stages.water_hold, str) else s * stages.water_hold
    numerics = dataclasses.replace(section.numerics, time_step=t * section.numerics.time_step)
    return dataclasses.replace(
        section,
        walls=sizes(section.walls),
        layers=tuple(layer.with_disks(s) for layer in sizes(section.layers)),
        materials=MappingProxyType(materials),
        disks=section.disks.scaled(s),
        water=water,
        stages=dataclasses.replace(stages, settle=settle, dry=t * stages.dry, water_hold=hold, end=end),
        numerics=numerics,
        like=(section.like[0], s * section.like[1]) if section.like else (section, s),
    )


def _material(material, s):
    weak, envelope = material.slip_weakening, material.envelope
    if weak is not None:
        weak = dataclasses.replace(
            weak, critical_slip=s * weak.critical_slip, tensile_strength=s * weak.tensile_strength
        )
    if envelope is not None:
        envelope = dataclasses.replace(envelope, cohesion=s * envelope.cohesion)
    return dataclasses.replace(
        material,
        tensile_strength=s * material.tensile_strength,
        residual_tensile_strength=s * material.residual_tensile_strength,
        slip_weakening=weak,
        envelope=envelope,
    )
