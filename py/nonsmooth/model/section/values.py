"""The same section with other values. Needs no YADE.

A value that a section does not state follows from others: a residual friction from the peak, a time step from the
diameters and gravity, the unit weight of water from gravity. So a value is always changed in the plain data that were
given (:mod:`.stated`), and the section is built from these again: the result is that of a file with this value.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping

from ...system import checks
from . import building, powers
from .folder import SCHEMA
from .reader import SectionError, take
from .stated import Given, NoSuchKey, given, keep, keep_value, put, words

__all__ = ["Given", "NoSuchKey", "given", "keep", "keep_value", "put", "replaced", "short", "with_values", "words"]


def with_values(section, values, source=None):
    """The Section that a file with these ``values`` gives: {key: value}, where a key is the way to a value with dots,
    ``materials.soil.friction``, or its words as a tuple, and items of lists go by their names, ``walls.DP.material``.
    ``source``: what messages begin with, the section's own where it is left out.

    Values of a similar section (:mod:`.similar`) are those of its own size. Raises NoSuchKey for a key that leads
    nowhere, SectionError for what is no section, and for a key before one that holds it.
    """
    data = given(section)
    if not isinstance(values, Mapping):
        raise SectionError(
            f"{section.source}: values {checks.shown(values)}: give a dictionary {{key: value}}, as {{'materials.soil.friction': 0.4}}"
        )
    if lost := replaced(values):
        raise SectionError(f"{section.source}: {lost}")
    for key, value in values.items():
        put(data, key, value)
    said = section.source if source is None else source
    made = building.build(take(data, said, SCHEMA), said, type(section))
    if section.like is None:
        return made
    original, factor = section.like
    original = with_values(original, {key: powers.original_value(key, v, factor) for key, v in values.items()}, source)
    return keep(made._packed_as(original, factor), given(made))


def replaced(keys) -> str | None:
    """What is wrong where of two ``keys``, in this order, the second holds the first, so that its value would take the
    place of that of the first; None where none does."""
    ways = [".".join(map(str, key)) if isinstance(key, (tuple, list)) else str(key) for key in keys]
    for way, later in itertools.combinations(ways, 2):
        if way.startswith(later + "."):
            return f"{way} and {later}: the value of the second takes the place of that of the first; name {later} first, or give one of them"
    return None


def short(keys):
    """Names of keys with dots: the last word, or as many as tell them apart, {key: name}."""

    def last(key, count):
        return ".".join(key.split(".")[-count:])

    return {
        key: next(last(key, n) for n in range(1, 99) if sum(last(other, n) == last(key, n) for other in keys) == 1)
        for key in keys
    }
