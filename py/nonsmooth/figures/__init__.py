"""Figures of a run, made from its records alone, and sketches of the law (no YADE, no display); pictures and videos of
any scene.

Every function takes data and returns the matplotlib Figure it draws. With the ``path`` of a PNG it writes the figure
there instead and returns the path; ``pdf=True`` writes a PDF beside it (disks and bars rasterised, text and lines as
vectors). Walls are given as a Section, as ``[(name, vertices (n, 2), role)]``, as objects with these attributes, or as
an object that has such ``walls``; see :mod:`nonsmooth.measure.ground`. Data that lack something raise
:class:`~nonsmooth.records.RecordsError`.
"""

from .controls import forces_against_water, speeds, with_and_without
from .forces import force_chains, forces_against_time
from .erosion import erosion
from .heated_slopes import heated_slopes
from .law import bond_zone, contact_law, water_forces
from .markers import markers
from .moving import animate, record, recording
from .numerics import energy, solver
from .profiles import deposit, snapshots
from .release import releases
from .runouts import runouts
from .scene import draw
from .shaking import shaking
from .slip_surface import slip_surface
from .sweep import means
from .toe import toe, toes
from .water import pore_pressures, seepage
from .weakening import weakening

__all__ = [
    "force_chains",
    "forces_against_time",
    "forces_against_water",
    "markers",
    "speeds",
    "with_and_without",
    "snapshots",
    "deposit",
    "draw",
    "animate",
    "record",
    "recording",
    "releases",
    "energy",
    "erosion",
    "heated_slopes",
    "means",
    "runouts",
    "shaking",
    "slip_surface",
    "solver",
    "toe",
    "toes",
    "weakening",
    "contact_law",
    "bond_zone",
    "water_forces",
    "seepage",
    "pore_pressures",
]
