"""Sections from files, from plain data, and the shipped ones. Needs no YADE."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path

from ...system import checks
from . import building
from .folder import FOLDER, SCHEMA, shipped
from .parts import Layer
from .reader import SectionError, read, take
from .section import Section

__all__ = ["block", "load", "of", "shipped"]


def block(width: float, height: float, **fields) -> Section:
    """The shipped section with one layer, a block of its rock with a corner at the origin [m], that is not pressed:
    what samples are packed from. ``fields``: others of the Section.
    """
    corners = ((0.0, 0.0), (width, 0.0), (width, height), (0.0, height))
    return dataclasses.replace(
        load("jiufengershan"), layers=(Layer("block", "rock", corners),), pressed=False, **fields
    )


def load(path_or_name) -> Section:
    """Read and check a section: the path of a YAML file, or the name of a shipped one.

    Raises SectionError (a ValueError) with file, line, key, value and remedy.
    """
    names = ", ".join(shipped())
    path = Path(checks.path("section", path_or_name, SectionError, f"give the path of a YAML file, or one of: {names}"))
    try:
        # a folder of results may have the name of a shipped section
        given = (
            path.suffix in (".yaml", ".yml") or (path.exists() and not path.is_dir()) or path.name != str(path_or_name)
        )
    except (OSError, ValueError) as error:  # a name that no system takes
        raise SectionError(
            f"{str(path)[:60]!r}: no path ({getattr(error, 'strerror', None) or error}); give a path or one of: {', '.join(shipped())}"
        ) from None
    if not given:
        if path.name not in shipped():
            raise SectionError(
                f"{path}: neither a file nor a shipped section; give a path or one of: " f"{', '.join(shipped())}"
            )
        path = FOLDER / f"{path.name}.yaml"
    return building.build(read(path, SCHEMA), str(path), Section)


def of(data: Mapping | None = None, source: str = "section", **keys) -> Section:
    """A Section from data of Python: a dictionary with the keys of a section file, or these as keywords. Points may be
    tuples or arrays.

    Checked as a file is: raises SectionError with key, value and remedy, after `source`.
    """
    if not (data is None or isinstance(data, Mapping)):
        raise SectionError(f"{source}: data {checks.shown(data)}: give a dictionary with the keys of a section file")
    return building.build(take({**(data or {}), **keys}, source, SCHEMA), source, Section)
