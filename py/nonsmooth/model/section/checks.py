"""Checks of a section that a schema cannot make: names, sizes, and whether disks could fall out."""

from __future__ import annotations

import math

import numpy as np
from shapely.geometry import LineString, MultiPoint

from .. import geometry, rocks
from . import erosion
from .parts import Layer, Wall, points_of

__all__ = ["check", "check_extent", "check_release", "check_roles", "notes", "walls"]

MOST_VERTICES = 10_000  # of all walls and layers: what is compared pairwise stays a matter of seconds


def _at(point) -> str:
    return f"({point[0]:.8g}, {point[1]:.8g})"


def check_extent(document) -> None:
    """Raise SectionError where the vertices of walls and layers are too many, or all at one place."""
    vertices = [p for kind in ("walls", "layers") for item in document.data[kind] for p in item["vertices"]]
    if len(vertices) > MOST_VERTICES:
        document.refuse(
            ("walls",), f"walls and layers have {len(vertices)} vertices together", f"give at most {MOST_VERTICES}"
        )
    if not np.ptp(np.array(vertices, float), axis=0).max() >= 1e-5:
        document.refuse(("walls",), "walls and layers have no extent", "give coordinates in m, 1e-5 m apart or more")


def walls(document) -> tuple[Wall, ...]:
    """The walls, with vertices that meet within the tolerance made bit-identical."""
    raw = document.data["walls"]
    everything = np.vstack([item["vertices"] for item in (*raw, *document.data["layers"])]).astype(float)
    tolerance = 1e-6 * math.dist(everything.min(axis=0), everything.max(axis=0))
    known, count = np.empty_like(everything), 0
    result = []
    for item in raw:
        vertices = []
        for p in points_of(item["vertices"]):
            same = np.flatnonzero(geometry.distance(*(known[:count] - p).T) <= tolerance)
            if len(same):
                p = tuple(known[same[0]].tolist())
            known[count] = p
            count += 1
            vertices.append(p)
        result.append(Wall(item["name"], item["material"], tuple(vertices), item.get("apart", False), item.get("role")))
    return tuple(result)


def check(section, document) -> None:
    """Raise SectionError at the first thing wrong with `section`."""
    _check_names(section, document)
    _check_interfaces(section, document)
    _check_materials(section, document)
    for keys, d in (
        (("disks", "diameter"), section.disks),
        *((("layers", i, "disks", "diameter"), layer.disks) for i, layer in enumerate(section.layers)),
    ):
        if d and d.d_min > d.d_max:
            document.refuse(
                keys, f"the smallest, {d.d_min:g} m, exceeds the largest, {d.d_max:g} m", "give the smaller one first"
            )
    _check_walls(section, document)
    _check_layers(section, document)
    section._check_room("disks.diameter", "give smaller diameters or thicker layers")
    step = section.numerics.time_step
    if step > section.longest_step and "count" not in document.data["disks"]:
        document.refuse(
            ("numerics", "time_step"),
            f"in {step:g} s the smallest disk, {section.smallest:g} m, would fall past its own diameter",
            f"give less than {section.longest_step:.2g} s",
        )


def check_roles(section, document) -> None:
    """Raise SectionError for a section whose walls are no slip surface: nothing says then which way its slope falls."""
    for i, interface in enumerate(section.interfaces):
        if interface.role == "slip" and len(section.line_of(interface)) < 2:
            document.refuse(
                ("interfaces", i, "role"),
                f"the layers {' and '.join(interface.between)} do not touch",
                "give role slip to an interface of layers that do",
            )
    if section.slip_surfaces:
        return
    document.refuse(
        ("walls",),
        "none of them has the role slip, and no interface has it",
        "give `role: slip` to the wall along which the mass may slide",
    )


def check_release(section, document) -> None:
    """Raise SectionError for a section with water whose release goes by the critical slip, of which there are
    several.
    """
    if section.release_distance is not None:
        return
    slips = ", ".join(f"{value:g} m ({name})" for name, value in section.critical_slips.items())
    document.refuse(
        ("water", "release_distance"),
        f"goes by the critical slip, of which there are several, {slips}, and none of the water's plane",
        "give a distance [m]",
    )


def notes(section) -> list[str]:
    """Sentences on what is allowed, and may not be meant: a release from water by another distance than the critical
    slip, where the paper has one for both; water that runs up the slope; windows that meet no layer; slip laws with
    more friction than the mass has; and what materials that are asked for by cohesion and angle of friction are made
    of, with what else they depend on."""
    kinds = (_release_notes, _water_notes, erosion.notes, _slip_law_notes, _rock_notes)
    return [note for kind in kinds for note in kind(section)]


def _release_notes(section):
    slips, release = section.critical_slips, section.release_distance
    if release is None or math.isinf(release) or not slips or release in slips.values():
        return
    listed = ", ".join(f"{value:g} m ({name})" for name, value in slips.items())
    yield (
        f"{section.source}: disks are released from the water after {release:g} m downslope, and the critical slip is {listed}; for one distance leave "
        "water.release_distance out, or give --critical-slip"
    )


def _water_notes(section):
    """A sign that was not meant shows as water that runs up the slope."""
    water = section.water_table
    if water is None:
        return
    if water.wall is None and abs(water.dip) >= 1 and abs(section.dip) >= 1 and water.dip * section.dip < 0:
        ways = ["to the right" if dip > 0 else "to the left" for dip in (water.dip, section.dip)]
        yield (
            f"{section.source}: the water's plane dips {abs(water.dip):.3g}° {ways[0]}, and the slope falls {ways[1]}; a dip to the left is negative"
        )
    elif not isinstance(water.pressure_gradient, str) and water.pressure_gradient[0] * section.side > 0:
        x, y = water.pressure_gradient
        yield (
            f"{section.source}: pressure_gradient [{x:g}, {y:g}] pushes the slope up, as the force of water is minus the gradient; for water that flows down it "
            f"x has the other sign"
        )


def _slip_law_notes(section):
    """A surface that is stronger than what lies on it is none: the mass then shears above it."""
    masses = {layer.material: section.materials[layer.material] for layer in section.layers}
    bears = {
        name: math.tan(math.radians(m.envelope.friction_deg if m.envelope else rocks.friction_angle(m.friction)))
        for name, m in masses.items()
    }
    weak = min(bears, key=bears.get)
    for name in dict.fromkeys(wall.material for wall in section.with_slip_law):
        law = section.materials[name].slip_law.make()
        most = max(law.friction(), law.values.get("peak_friction", 0.0))
        if most > bears[weak]:
            yield (
                f"{section.source}: the slip law of {name} has a friction of up to {most:g}, and {weak}, that lies on such walls, bears {bears[weak]:.2g} by friction "
                "alone; slip may leave the wall, which then does not heat; give the law less friction, or the layers more"
            )


def _rock_notes(section):
    rough = [(w.name, w.material) for w in section.walls] + [(i.name, i.material) for i in section.interfaces]
    for name, material in section.materials.items():
        found = rocks.asked(material)
        if found is None:
            continue
        e = material.envelope
        yield (
            f"{section.source}: {name} has c = {1e-3 * e.cohesion:.4g} kPa ± {100 * found.cohesion_95_rel:.0f} % and φ = {e.friction_deg:.4g} ± "
            f"{found.friction_angle_95_deg:.1f}° (95 % of samples of {rocks.table()['scatter']['disks']} disks), by contacts with σ_ext = {1e-3 * found.tensile_strength:g} kPa and μ_s = {found.friction:g}"
        )
        if borders := [border for border, of in rough if of == name]:
            yield (
                f"{section.source}: {', '.join(borders)} has the friction of the contacts of {name}, {found.friction:g}, and not its angle of friction; "
                f"for a surface of {e.friction_deg:.4g}° give it a material of its own with friction: {math.tan(math.radians(e.friction_deg)):.3g}"
            )
        made = [layer for layer in section.layers if layer.material == name]
        if made and (differs := rocks.other_samples([layer.disks or section.disks for layer in made], section.pressed)):
            yield (
                f"{section.source}: {name} was measured on samples with {differs}; scripts/biaxial.py measures what others have"
            )


def check_cells(section, document) -> None:
    """Refuses cells of slip laws that are shorter than a disk: most would have no contact."""
    least = math.sqrt(section.disks.mean_square)
    for wall in section.with_slip_law:
        length = section.materials[wall.material].slip_law.cell_length
        if 0 < length < least:
            document.refuse(
                ("materials", wall.material, "slip_law", "cell_length"),
                f"{length:g} m is less than a mean diameter, {least:.3g} m",
                f"give {least:.3g} or more, or leave it out: eight mean diameters",
            )


def check_pressures(section, document) -> None:
    """Refuses water that leaves a disk after a way where a slip law has a pore pressure of its own: the weight that it
    gives back would come in the middle of weakening.
    """
    x0, _, x1, _ = section.bounds
    for wall in section.with_slip_law:
        law = section.materials[wall.material].slip_law.make()
        if "thermal_pressurization" in law.names and section.release_distance < x1 - x0:
            document.refuse(
                ("water", "release_distance"),
                f"{section.release_distance:g} m, and the slip law of the wall {wall.name} has a pore pressure of its own, "
                "over that of the water",
                "give 1.0e+5, farther than any disk goes, so that the water stays",
            )


def _check_names(section, document) -> None:
    for kind, items in (("walls", section.walls), ("layers", section.layers)):
        names = [item.name for item in items]
        for i, item in enumerate(items):
            if item.name in names[:i]:
                document.refuse((kind, i, "name"), f"{item.name!r} is taken", "give each its own name")
            if item.material not in section.materials:
                document.refuse(
                    (kind, i, "material"),
                    f"{item.material!r} is not defined",
                    f"add it to `materials`, or give one of {', '.join(section.materials)}",
                )


def _check_interfaces(section, document) -> None:
    layers, seen = [layer.name for layer in section.layers], {}
    taken = {item.name for item in (*section.walls, *section.layers)}
    for i, interface in enumerate(section.interfaces):
        for name in interface.between:
            if name not in layers:
                document.refuse(
                    ("interfaces", i, "between"), f"no layer is called {name!r}", f"give two of {', '.join(layers)}"
                )
        if interface.between[0] == interface.between[1]:
            document.refuse(
                ("interfaces", i, "between"), f"both are {interface.between[0]}", "give two different layers"
            )
        pair = frozenset(interface.between)
        if pair in seen:
            document.refuse(
                ("interfaces", i, "between"),
                f"{' and '.join(interface.between)} have an interface already, {seen[pair]}",
                "keep one of the two",
            )
        seen[pair] = interface.name
        if interface.material not in section.materials:
            document.refuse(
                ("interfaces", i, "material"),
                f"{interface.material!r} is not defined",
                f"add it to `materials`, or give one of {', '.join(section.materials)}",
            )
        if interface.name in taken:
            document.refuse(
                ("interfaces", i, "name" if "name" in document.data["interfaces"][i] else "between"),
                f"the name {interface.name!r} is taken",
                "give each its own `name`",
            )
        taken.add(interface.name)


def _check_materials(section, document) -> None:
    for name, material in section.materials.items():
        raw = document.data["materials"][name]
        if material.bonded and not {"tensile_strength", "cohesion"} & raw.keys():
            document.refuse(
                ("materials", name),
                "a bonded material without tensile_strength",
                "give tensile_strength [Pa], or bonded: false",
            )
    for layer in section.layers:
        material = section.materials[layer.material]
        if material.density is None:
            document.refuse(
                ("materials", material.name),
                f"no density, and layer {layer.name} is made of it",
                "give density [kg/m³]",
            )
        for key in ("slip_weakening", "slip_law"):
            if getattr(material, key):
                document.refuse(
                    ("materials", material.name, key),
                    f"layer {layer.name} is made of this material",
                    f"give {key} to materials of walls only",
                )
    for interface in section.interfaces:
        if section.materials[interface.material].slip_law:
            document.refuse(
                ("materials", interface.material, "slip_law"),
                f"the interface {interface.name} has this material",
                "give slip_law to materials of walls only",
            )


def _check_walls(section, document) -> None:
    lines = []
    for i, wall in enumerate(section.walls):
        for a, b in zip(wall.vertices, wall.vertices[1:]):
            if a == b:
                document.refuse(("walls", i, "vertices"), f"two vertices in a row at {_at(a)}", "remove one")
        line = LineString(wall.vertices)
        if not line.is_simple:
            document.refuse(("walls", i, "vertices"), "the wall crosses itself", "correct the order of its vertices")
        lines.append(line)
    _check_crossings(section, lines, document)
    joined, waiting = set(), [next((i for i, w in enumerate(section.walls) if not w.apart), 0)]
    while waiting:  # walls reached from the first one through joints
        i = waiting.pop()
        joined.add(i)
        ends = [p for p in (section.walls[i].vertices[0], section.walls[i].vertices[-1])]
        for j, other in enumerate(section.walls):
            tips = (other.vertices[0], other.vertices[-1])
            if (
                j not in joined
                and j not in waiting
                and any(p in other.vertices for p in ends) | any(p in section.walls[i].vertices for p in tips)
            ):
                waiting.append(j)
    for i, wall in enumerate(section.walls):
        if i in joined or wall.apart:
            continue
        tips = (wall.vertices[0], wall.vertices[-1])
        gap, mine, other, theirs = min(
            (math.dist(p, q), p, section.walls[j].name, q)
            for j in joined
            for q in section.walls[j].vertices
            for p in tips
        )
        document.refuse(
            ("walls", i, "vertices"),
            f"a hole of {gap:.4g} m: the wall's end {_at(mine)} does not meet "
            f"{other}, whose nearest vertex is {_at(theirs)}",
            "make them the same point, or set `apart: true` if the gap is wanted",
        )


def _check_crossings(section, lines, document) -> None:
    """Refuse walls that cross or cover each other; they may share vertices, and end on one another."""
    for i, (wall, line) in enumerate(zip(section.walls, lines)):
        for other, crossed in zip(section.walls[:i], lines):
            if not line.intersects(crossed):
                continue
            shared = {*wall.vertices} & {*other.vertices}
            ends = {wall.vertices[0], wall.vertices[-1], other.vertices[0], other.vertices[-1]}
            common = line.intersection(crossed).difference(MultiPoint([*shared, *ends]).buffer(3 * section.tolerance))
            if not common.is_empty:
                where = common.representative_point().coords[0]
                document.refuse(
                    ("walls", i, "vertices"),
                    f"the wall crosses or covers {other.name} at {_at(where)}",
                    "let walls meet at vertices only",
                )


def _check_sense(section, document) -> None:
    """Refuse walls listed the wrong way round: the side to the left of a wall's direction acts."""
    remedy = "list its vertices the other way round"
    table, tolerance = geometry.edges(section.outline), section.tolerance
    finish = table.start + table.length[:, None] * table.direction
    for i, wall in enumerate(section.walls):
        for a, b in zip(wall.points, wall.points[1:]):
            length = float(geometry.distance(*(b - a)))
            t = (b - a) / length
            (along0, off0), (along1, off1) = (((p - a) @ t, (p - a) @ (-t[1], t[0])) for p in (table.start, finish))
            on = (np.abs(off0) <= 3 * tolerance) & (np.abs(off1) <= 3 * tolerance)
            on &= (
                np.minimum(np.maximum(along0, along1), length) - np.maximum(np.minimum(along0, along1), 0)
                > 10 * tolerance
            )
            if np.any(on & (along1 < along0)):  # the outline has the layers on its left
                document.refuse(
                    ("walls", i, "vertices"),
                    f"from {_at(a)} to {_at(b)} the layers lie to the right of the wall",
                    remedy,
                )
    for end, name in ((0, "begin"), (-1, "end")):
        passed = {p for wall in section.walls for p in (wall.vertices[1:-1] + (wall.vertices[-1 - end],))}
        at = {}
        for i, wall in enumerate(section.walls):
            p = wall.vertices[end]
            other = at.setdefault(p, wall.name)
            if other != wall.name and p not in passed:
                document.refuse(
                    ("walls", i, "vertices"),
                    f"both {other} and {wall.name} {name} at {_at(p)}, so one of them acts on its other side",
                    f"{remedy}, or those of {other}: one wall goes on where another ends",
                )


def _check_layers(section, document) -> None:
    tolerance = section.tolerance
    for i, layer in enumerate(section.layers):
        reason = geometry.invalid_reason(layer.vertices)
        if reason:
            document.refuse(
                ("layers", i, "vertices"), f"no simple polygon: {reason}", "list the vertices in order around the layer"
            )
        if layer.polygon.buffer(-10 * tolerance).is_empty:
            document.refuse(
                ("layers", i, "vertices"),
                f"the layer is thinner than {20 * tolerance:.2g} m",
                "give it some thickness, or leave it out",
            )
    for i, layer in enumerate(section.layers):
        for j in range(i):
            _check_overlap(section.layers[j], layer, j, i, tolerance, document)
    for i, layer in enumerate(section.layers):
        core = layer.polygon.buffer(-3 * tolerance)
        for wall in section.walls:
            cut = LineString(wall.vertices).intersection(core)
            if cut.length > 10 * tolerance:
                where = cut.representative_point().coords[0]
                document.refuse(
                    ("layers", i, "vertices"),
                    f"the wall {wall.name} runs through the layer at {_at(where)}",
                    "keep layers on one side of a wall",
                )
    hole = geometry.uncovered(section.outline, [w.vertices for w in section.walls], tolerance)
    if hole:
        i = min(range(len(section.layers)), key=lambda k: section.layers[k].polygon.distance(LineString(hole)))
        document.refuse(
            ("layers", i, "vertices"),
            f"disks could fall out: no wall below the layer from {_at(hole[0])} " f"to {_at(hole[1])}",
            "extend a wall along it, or move the layer onto a wall",
        )
    _check_sense(section, document)


def _check_overlap(lower: Layer, upper: Layer, j: int, i: int, tolerance: float, document) -> None:
    common = lower.polygon.intersection(upper.polygon)
    if common.buffer(-2 * tolerance).is_empty:
        return
    where = common.representative_point().coords[0]
    document.refuse(
        ("layers", i, "vertices"),
        f"overlaps layer {lower.name} by {common.area:.4g} m² around {_at(where)}",
        "move the vertices so that the layers touch at most",
    )
