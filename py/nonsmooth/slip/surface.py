"""Cells of a wall whose friction a slip law finds: what a ``SlipSurfaceMat`` knows along its walls.

A script gives the law to the material, and asks for the cells when it wants to look::

    wall = SlipSurfaceMat(law=parameter_sets.law("vaiont"), density=2400, label="slide")
    O.bodies.append(scene.segments([(0, 100), (300, 0)], wall, piece=20))
    ...
    surface.cells(wall)["temperature"].max()
"""

from __future__ import annotations

import numpy as np

from ..system import checks
from .laws import SlipError

__all__ = ["COLUMNS", "cells", "units"]

#: Columns of all laws: {name: (name that the material gives it, unit, shape of a cell)}.
COLUMNS = {
    "begin_m": ("begin", "m", ()),
    "length_m": ("length", "m", ()),
    "ends_m": ("ends", "m", (2, 2)),
    "slip_m": ("slip", "m", ()),
    "slip_rate_m_per_s": ("slip_rate", "m/s", ()),
    "normal_stress_Pa": ("normal_stress", "Pa", ()),
    "friction": ("friction", "-", ()),
}

_SURFACE = checks.takes(SlipError, material=checks.has("cellTable", "give a SlipSurfaceMat"))


@_SURFACE
def units(material):
    """{column: unit} of the columns that the ``material``'s law keeps besides :data:`COLUMNS`."""
    return {name: unit for name, unit, _ in material.columns()}


@_SURFACE
def cells(material):
    """{column: array} of all cells of a ``SlipSurfaceMat``, a row a cell, in the order along its walls.

    :data:`COLUMNS`: where a cell begins along the walls and its length [m], (n,); its ends now, as (x, y), (n, 2, 2);
    slip, slip rate, normal stress and the friction in force, (n,). Then the law's own, (n,), or (n, nodes) where they
    are profiles across the zone, from its middle outwards; see :func:`units`. No rows before the first step. Raises
    SlipError for what is no such material.
    """
    count = material.cellCount()

    def read(name, shape):
        return np.frombuffer(material.cellTable(name)).reshape((count, *shape)).copy()

    found = {column: read(name, shape) for column, (name, _, shape) in COLUMNS.items()}
    return found | {name: read(name, (width,) if width > 1 else ()) for name, _, width in material.columns()}
