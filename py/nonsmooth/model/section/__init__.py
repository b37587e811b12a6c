"""Sections: the slope to be computed, from a YAML file or from Python data, checked before anything runs.

`load` (a file) and `of` (data) give a `Section` or raise `SectionError` with one message that names the file, the
line, the key, the value and the remedy. SI units throughout (m, s, kg, N, Pa; a slice 1 m
thick), x to the right, y up. The format is explained in `sections/jiufengershan.yaml`, the
slope of Taboada and Estrada (2009), sections 5 and 6.
"""

from .erosion import Window
from .folder import FOLDER  # noqa: F401
from .loading import block, load, of, shipped
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
    SurfaceLaw,
    Stages,
    Wall,
    Water,
)
from .reader import SectionError
from .section import MOST_DISKS, Section

__all__ = [
    "Disks",
    "End",
    "Envelope",
    "Interface",
    "Layer",
    "MOST_DISKS",
    "Material",
    "Numerics",
    "Section",
    "SectionError",
    "Settle",
    "SlipWeakening",
    "SurfaceLaw",
    "Stages",
    "Wall",
    "Water",
    "Window",
    "block",
    "load",
    "of",
    "shipped",
]
