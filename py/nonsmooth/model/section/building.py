"""From the data of a section, which meet the schema, to a checked Section. Needs no YADE."""

from __future__ import annotations

import copy
import dataclasses
from types import MappingProxyType

from ...slip import laws as slip_laws, parameter_sets
from .. import geometry, rocks, roles
from . import (
    checks as section_checks,
    defaults as section_defaults,
    erosion,
    shaking as section_shaking,
    stated,
    units as section_units,
    water as section_water,
    water_release,
)
from .parts import (
    Disks,
    End,
    Envelope,
    Interface,
    Layer,
    Material,
    Numerics,
    Settle,
    SlipWeakening,
    Stages,
    SurfaceLaw,
    Water,
    points_of,
)

__all__ = ["build", "material_from"]


def build(document, source: str, section_class):
    """Section from a document that meets the schema; the checks that a schema cannot make. ``section_class``:
    Section, which makes others like itself from here, and so stands above.
    """
    section_checks.check_extent(document)
    _take_old_names(document)
    section_shaking.complete(document)
    section_water.complete(document)
    section_units.check(document)
    kind = section_water.kind_of(document) if "water" in document.data else None
    given = copy.deepcopy(document.data)
    raw = document.data = section_defaults.filled(document.data)
    walls = section_checks.walls(document)
    size = raw["disks"]
    disks = Disks(*map(float, size["diameter"]), size["distribution"], float(size["packing_fraction"]))
    layers = tuple(
        Layer(v["name"], v["material"], points_of(v["vertices"]), v.get("role", "mass"), _own(v.get("disks"), disks))
        for v in raw["layers"]
    )
    interfaces = tuple(
        Interface(
            v.get("name", "-".join(v["between"])),
            tuple(v["between"]),
            v["material"],
            v.get("role"),
            v.get("flat", True),
        )
        for v in raw.get("interfaces", ())
    )
    stages = raw["stages"]
    section = section_class(
        name=raw["name"],
        description=raw.get("description", "").strip(),
        gravity=float(raw["gravity"]),
        walls=walls,
        layers=layers,
        materials=MappingProxyType(
            {k: material_from(k, v, document, ("materials", k)) for k, v in raw["materials"].items()}
        ),
        disks=disks,
        water=None,
        stages=Stages(
            Settle(**{k: v if k == "bond" else float(v) for k, v in stages["settle"].items()}),
            float(stages["dry"]),
            stages.get("water", {}).get("hold", "motion") if kind in (None, "table") else "never",
            End(**_floats(stages["end"])),
        ),
        numerics=Numerics(**raw["numerics"]),
        seed=raw["seed"],
        source=source,
        interfaces=interfaces,
        pressed=size.get("pressed", False),
        unusual=tuple(raw.get("unusual", ())),
        shaking=section_shaking.made(document),
    )
    section_checks.check(section, document)
    section_shaking.check_end(section, document)
    if "water" in raw:
        water = _water(raw["water"], section, document) if kind == "table" else section_water.read(document)
        section = dataclasses.replace(section, water=water)
        section_water.check(section, document)
        section_water.check_end(section, document)
    section = dataclasses.replace(section, walls=roles.assigned(section))
    section_checks.check_roles(section, document)
    if "water" in raw:
        if section.water.release_distance == "critical_slip" and not section.critical_slips:
            release = section_defaults.release_distance(section.area)
            section = dataclasses.replace(section, water=dataclasses.replace(section.water, release_distance=release))
        section_checks.check_release(section, document)
        section_checks.check_pressures(section, document)
    section = dataclasses.replace(section, erosion=erosion.windows(section, document))
    section = stated.keep(section, given)
    section = section.with_disks(size["count"]) if "count" in size else section
    section_checks.check_cells(section, document)
    return section


def _take_old_names(document) -> None:
    """Reads `water.gradient`, a force per volume where `pressure_gradient` is the gradient itself, with a warning that
    says what to write.
    """
    water = document.data.get("water", {})
    if "gradient" not in water:
        return
    if "pressure_gradient" in water:
        document.refuse(
            ("water", "gradient"), "is the old name of pressure_gradient, which is given too", "leave `gradient` out"
        )
    old = water.pop("gradient")
    new = "parallel_seepage" if old == "buoyant" else [0.0 - float(g) for g in old]
    document.warn(
        ("water", "gradient"),
        "is the old name of pressure_gradient"
        + ("" if old == "buoyant" else ", for the force per volume, which is −∇p"),
        f"write `pressure_gradient: {new}`",
    )
    water["pressure_gradient"] = new


def _own(raw, disks: Disks) -> Disks | None:
    """A layer's own disks: what it says, and the section's `disks` for the rest."""
    if raw is None:
        return None
    low, high = map(float, raw.get("diameter", (disks.d_min, disks.d_max)))
    return Disks(
        low,
        high,
        raw.get("distribution", disks.distribution),
        float(raw.get("packing_fraction", disks.packing_fraction)),
    )


def _floats(mapping) -> dict:
    return {k: float(v) for k, v in mapping.items()}


LEAVE_OUT = "leave one of them out, or set it to null where it is that of the base"


def _surface_law(raw, document, keys) -> SurfaceLaw:
    """The SurfaceLaw of a material's data, which get the friction that it has before slip."""
    asked = raw["slip_law"]
    if "set" in asked and "law" in asked:
        document.refuse((*keys, "slip_law"), "set and law are both there", LEAVE_OUT)
    if "slip_weakening" in raw:
        document.refuse((*keys, "slip_law"), "slip_weakening is there too", LEAVE_OUT)
    given = {
        k: tuple(map(float, v)) if isinstance(v, list) else float(v) for k, v in asked.get("parameters", {}).items()
    }
    law = asked.get("law", ())
    laws = (law,) if isinstance(law, str) else tuple(law)
    try:
        of_set = parameter_sets.law(asked["set"]).names if "set" in asked else ()
        if "friction" not in given and any(one.key == "friction" for one in slip_laws.parameters(*laws, *of_set)):
            given["friction"] = float(raw["friction"])
        made = SurfaceLaw(laws, asked.get("set"), tuple(given.items()), float(asked.get("cell_length", 0)))
        friction = made.make().friction()
    except slip_laws.SlipError as error:
        document.refuse((*keys, "slip_law"), str(error), "scripts/sliding_block.py --list tells laws and sets")
    for key in ("friction", "residual_friction"):
        if abs(raw[key] - friction) > 1e-5 * (1 + friction):  # as far as the message shows it
            document.refuse(
                (*keys, key),
                f"its slip law has the friction {friction:g} before slip",
                "give that, or leave it out" if key == "residual_friction" else f"give {friction:g}",
            )
    return made


def material_from(name: str, raw: dict, document, keys=()) -> Material:
    """A Material from its data, which meet the schema; one that is asked for by cohesion and angle of friction has
    contact parameters of the table (:mod:`.rocks`).

    ``keys``: of the data in the ``document``, whose SectionError says what cannot be had.
    """
    raw = dict(rocks.resolved(raw, lambda below, what, remedy: document.refuse((*keys, *below), what, remedy)))
    raw.setdefault("residual_friction", raw["friction"])
    raw.setdefault("residual_rolling_friction", raw["rolling_friction"])
    if "bond_ellipse" in raw:
        raw["bond_ellipse"] = tuple(map(float, raw["bond_ellipse"]))
    if "slip_weakening" in raw:
        raw["slip_weakening"] = SlipWeakening(**raw["slip_weakening"])
    if "slip_law" in raw:
        raw["slip_law"] = _surface_law(raw, document, keys)
    if "envelope" in raw:
        raw["envelope"] = Envelope(**_floats(raw["envelope"]))
    return Material(
        name, **{k: float(v) if isinstance(v, int) and not isinstance(v, bool) else v for k, v in raw.items()}
    )


def _water(raw: dict, section, document) -> Water:
    plane, wall = raw["plane"], None
    if isinstance(plane, str):
        names = [w.name for w in section.walls]
        if plane not in names:
            document.refuse(
                ("water", "plane"),
                f"no wall is called {plane!r}",
                f"give one of {', '.join(names)}, or {{point: [x, y], dip: degrees}}",
            )
        wall = section.wall(plane)
        if not geometry.straight(wall.vertices, section.tolerance):
            document.refuse(
                ("water", "plane"),
                f"the wall {plane} is not straight",
                "give a straight wall, or {point: [x, y], dip: degrees}",
            )
        dx, dy = wall.points[-1] - wall.points[0]
        if dx == 0:
            document.refuse(
                ("water", "plane"), f"the wall {plane} is vertical", "give a plane that dips less than 90 degrees"
            )
        point, dip = min(wall.vertices, key=lambda p: p[1]), roles.dip_of(dx, dy)
    else:
        point, dip = tuple(map(float, plane["point"])), float(plane["dip"])
    gradient = raw["pressure_gradient"]
    if not isinstance(gradient, str):
        gradient = tuple(map(float, gradient))
        if gradient == (0.0, 0.0):
            document.refuse(
                ("water", "pressure_gradient"),
                "is zero, so that water bears nothing",
                "leave the key `water` out for a dry slope",
            )
    table = raw["table"]
    points = points_of(table.get("points", [[0.0, 0.0]]))
    for i, (before, after) in enumerate(zip(points, points[1:]), 1):
        if after[0] <= before[0]:
            document.refuse(
                ("water", "table", "points", i),
                f"the time {after[0]:g} s does not follow {before[0]:g} s",
                "give the times in rising order",
            )
    return Water(
        float(raw["unit_weight"]),
        point,
        dip,
        gradient,
        raw["volume"],
        points,
        float(table.get("rate", 0.0)),
        raw["release_distance"] if isinstance(raw["release_distance"], str) else float(raw["release_distance"]),
        wall.name if wall else None,
        water_release.read(raw, document),
    )
