"""The pore pressures of a section that has a field of them (``section.water_field``), as one MeshField in the time since
t0.

**Lines.** Below a phreatic line the pressure is linear in each column between two vertices, so two triangles a column
hold it exactly. The columns reach over the whole section, also above the ground: where the line stands over it, there
is open water.

**Open water.** Its load on the ground needs no force of its own. The sum of −∇p over the disks of a body is the
pressure on its rim, the submerged face included; in effective stresses nothing acts on that face. What has its centre
outside of the ground and below the water's level, as a disk that sticks out, or that has rolled into a reservoir, feels
−∇p of still water.
"""

from __future__ import annotations

import numpy as np

from ..system import checks
from .fields import FieldError, MeshField
from .mesh import Mesh

__all__ = ["field"]

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
    return None if water is None else _from_dry(_below_lines(water, section))


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
        [np.column_stack((at, np.full(count, y))) for at, y in ((left, bottom), (right, bottom), (right, top), (left, top))],
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
