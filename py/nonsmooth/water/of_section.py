"""The pore pressures of a section that has a field of them (``section.water_field``), as one MeshField in the time
since t0.

**Lines.** Below a phreatic line the pressure is linear in each column between two vertices, so two triangles a column
hold it exactly. The columns reach over the whole section, also above the ground: where the line stands over it, there
is open water.

**Open water.** Its load on the ground needs no force of its own. The sum of −∇p over the disks of a body is the
pressure on its rim, the submerged face included; in effective stresses nothing acts on that face. What has its centre
outside of the ground and below the water's level, as a disk that sticks out, or that has rolled into a reservoir, feels
−∇p of still water.
"""

from __future__ import annotations

import dataclasses
import hashlib
from pathlib import Path

import numpy as np
from shapely.ops import polygonize, unary_union
from shapely.geometry import LineString

from ..model import geometry
from ..model.section.seepage import SeepageStates
from ..model.section.water import FieldFiles, PhreaticLines
from ..system import checks
from . import field_files, section_seepage
from .error import WaterError
from .fields import FieldError, MeshField
from .mesh import Mesh

__all__ = ["FILE", "field", "kept"]

FILE = "water.h5"  # of a run: its pressures in the time since t0
MARGIN = 0.1  # of a section's size: how far beyond its walls and layers a disk may come, as monitoring.inside has it


def field(section) -> MeshField | None:
    """The MeshField of a :class:`~nonsmooth.section.Section`, times in s since t0; None where it has no water but a
    table.

    Where its first state comes after t0, a state without any pressure at t0 is put before it. Raises WaterError for a
    section whose field cannot be had, with the section's name and the key before the reason.
    """
    if not hasattr(section, "water_field"):
        raise FieldError(f"section {checks.shown(section)}: give a Section, as section.load('circle') returns one")
    water = section.water_field
    if water is None:
        return None
    make = {PhreaticLines: _below_lines, FieldFiles: _of_files, SeepageStates: section_seepage.field}
    return _from_dry(make[type(water)](water, section))


def kept(section, found, folder):
    """Writes a section's field, a MeshField or None, into the ``folder`` of a run as :data:`FILE`, so that the run does
    not depend on the files that it came from; returns the Section that the folder's section file is to have. Raises
    WriteError.
    """
    if found is None:
        return section
    path = field_files.write(found, Path(folder) / FILE)
    if not isinstance(section.water, FieldFiles):
        return section
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    water = dataclasses.replace(
        section.water,
        files=(FILE,),
        times=None,
        name=field_files.NAME,
        scale=1.0,
        stretch=1.0,
        mirrored=False,
        digests=(digest,),
    )
    return dataclasses.replace(section, water=water)


def _from_dry(found):
    """The field with a state of no pressures at 0, where its first one comes later."""
    if found.times[0] <= 0:
        return found
    zero = np.zeros((1, found.pressures.shape[1]))
    return MeshField(found.mesh, np.concatenate(([0.0], found.times)), np.concatenate((zero, found.pressures)))


def _below_lines(water, section):
    """Of PhreaticLines: columns between all vertices of all lines, each with nodes of its own, as the slope changes
    from one to the next.
    """
    lines = [np.array(points) for _, points in water.lines]
    low, high = max(line[0, 0] for line in lines), min(line[-1, 0] for line in lines)
    if not low < high:
        raise FieldError(
            f"{section.source}: water.phreatic.lines: the lines have no x in common (the last begins at {low:g} m, the "
            f"first ends at {high:g} m); give lines that span the same part of the section"
        )
    x = np.unique(np.concatenate([[low, high], *(line[:, 0] for line in lines)]))
    x = x[(x >= low) & (x <= high)]
    x0, y0, x1, y1 = section.bounds
    margin = MARGIN * max(x1 - x0, y1 - y0)
    bottom, top = y0 - margin, y1 + margin
    count = len(x) - 1
    left, right = x[:-1], x[1:]
    corners = np.stack(
        [
            np.column_stack((at, np.full(count, y)))
            for at, y in ((left, bottom), (right, bottom), (right, top), (left, top))
        ],
        axis=1,
    )
    first = 4 * np.arange(count)[:, None]
    mesh = Mesh.of(corners.reshape(-1, 2), np.vstack((first + (0, 1, 2), first + (0, 2, 3))))
    pressures = []
    for line in lines:
        height = np.interp(x, *line.T)
        slope = np.diff(height) / np.diff(x)
        weight = water.unit_weight / (1 + slope**2 if water.flow == "along" else np.ones(count))
        ends = np.stack((height[:-1], height[1:], height[1:], height[:-1]), axis=1)
        pressures.append((weight[:, None] * (ends - corners[..., 1])).ravel())
    return MeshField(mesh, [time for time, _ in water.lines], pressures)


def _of_files(water, section):
    where = f"{section.source}: water.field"
    try:
        if water.times is None:
            found = field_files.read(water.files[0], water.name)
        else:
            found = field_files.read_series(list(zip(water.times, water.files)), water.name)
        sign = -1.0 if water.mirrored else 1.0
        old = found.mesh
        mesh = Mesh.of(old.nodes * (sign * water.scale, water.scale), old.triangles, old.layer, old.names)
        stretch = water.stretch if water.times is None else 1.0
        found = MeshField(mesh, found.times * stretch, found.pressures * water.scale)
    except WaterError as error:
        raise FieldError(f"{where}: {error}") from None
    if water.outside == "refuse":
        _require_cover(found.mesh, section, where, water.files[0])
    return found


def _require_cover(mesh, section, where, file):
    """Raises FieldError where the mesh of a file leaves out a place of the layers at which a disk's centre may lie."""
    rim = unary_union([LineString(ends) for ends in mesh.nodes[mesh.border]])
    held = [part for part in polygonize(rim) if mesh.locate(part.representative_point().coords)[0] >= 0]
    asked = section.outline.buffer(-0.5 * section.smallest)
    bare = asked.difference(unary_union(held).buffer(section.tolerance))
    largest = max(geometry.parts(bare), key=lambda part: part.area, default=None)
    if largest is not None:
        x, y = largest.representative_point().coords[0]
        box = ", ".join(f"{v:.6g}" for v in mesh.bounds)
        raise FieldError(
            f"{where}: {file}: its mesh, which lies within {box} m, does not cover the layers: it has no pressure at "
            f"({x:.6g}, {y:.6g}) m; give a mesh that covers them, or water.outside: dry"
        )
