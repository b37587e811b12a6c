"""Water in a section: meshes, steady seepage, and pressure fields in time, with their forces on disks. Needs no YADE.

Lengths are in m, times in s, pressures in Pa, conductivities and rates of inflow in m/s; discharges, per metre of
thickness, in m²/s. x points to the right and y up. Every problem is a :class:`WaterError`.

:mod:`~nonsmooth.water.mesh` makes triangles of polygons, :mod:`~nonsmooth.water.conditions` says what happens at their
border, :mod:`~nonsmooth.water.seepage` computes heads, :mod:`~nonsmooth.water.fields` holds pressures in time,
:mod:`~nonsmooth.water.field_files` reads and writes them, and :mod:`~nonsmooth.water.forces` is what a disk feels.
"""

from .error import WaterError

__all__ = ["WaterError"]
