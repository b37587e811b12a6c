"""What a section was given, before anything is filled in or derived, and the same section with other values. Needs no
YADE.

A value that a section does not state follows from others: a residual friction from the peak, a time step from the
diameters and gravity, the unit weight of water from gravity. So a value is always changed in the plain data that were
given, and the section is built from these again: the result is that of a file with this value.
"""

from __future__ import annotations

import copy
import dataclasses
import difflib
import itertools
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

from ...system import checks
from . import data as section_data
from .folder import SCHEMA
from .reader import SectionError, schema

__all__ = ["Given", "NoSuchKey", "given", "keep", "keep_value", "put", "replaced", "short", "with_values", "words"]

# fields of a Section, and the keys of a file that say them
_KEY = {
    **{
        name: name
        for name in (
            "name",
            "description",
            "gravity",
            "seed",
            "walls",
            "layers",
            "interfaces",
            "materials",
            "disks",
            "water",
            "shaking",
            "stages",
            "numerics",
            "unusual",
            "erosion",
        )
    },
    "pressed": "disks",
}


class NoSuchKey(SectionError):
    """A key that leads nowhere in a section; the message names the word and what there is."""


@dataclass(frozen=True)
class Given:
    """``data``: the keys and values of a section file, nothing filled in; ``fields``: of the Section that was built
    from them.
    """

    data: Mapping
    fields: Mapping


def keep(section, data):
    """The Section with these plain data as what it was given."""
    return dataclasses.replace(section, given=Given(data, {name: getattr(section, name) for name in _KEY}))


def keep_value(section, before, key, value):
    """The Section with what the Section ``before`` was given and this value."""
    data = given(before)
    put(data, key, value)
    return keep(section, data)


def given(section) -> dict:
    """Plain data of a section file that gives this Section, without what the section fills in or derives itself;
    `section.of` takes them.

    What `dataclasses.replace` has changed since counts as given, whole. A similar section (`like`) loses where it came
    from.
    """
    if not hasattr(section, "given"):
        raise SectionError(f"section {checks.shown(section)}: give a Section, as section.load('circle') returns one")
    if section.given is None:
        return section_data.plain(section)
    data = copy.deepcopy(dict(section.given.data))
    changed = {
        key
        for name, key in _KEY.items()
        if getattr(section, name) is not section.given.fields[name]
        and getattr(section, name) != section.given.fields[name]
    }
    if changed:
        whole = section_data.plain(section)
        for key in changed:
            data.pop(key, None)
            if key in whole:
                data[key] = whole[key]
    return data


def with_values(section, values, source=None):
    """The Section that a file with these ``values`` gives: {key: value}, where a key is the way to a value with dots,
    ``materials.soil.friction``, or its words as a tuple, and items of lists go by their names, ``walls.DP.material``.
    ``source``: what messages begin with, the section's own where it is left out.

    Values of a similar section (:mod:`.similar`) are those of its own size. Raises NoSuchKey for a key that leads
    nowhere, SectionError for what is no section, and for a key before one that holds it.
    """
    from . import loading, similar

    data = given(section)
    if not isinstance(values, Mapping):
        raise SectionError(
            f"{section.source}: values {checks.shown(values)}: give a dictionary {{key: value}}, as {{'materials.soil.friction': 0.4}}"
        )
    if lost := replaced(values):
        raise SectionError(f"{section.source}: {lost}")
    for key, value in values.items():
        put(data, key, value)
    made = loading.of(data, section.source if source is None else source)
    if section.like is None:
        return made
    original, factor = section.like
    original = with_values(original, {key: similar.original_value(key, v, factor) for key, v in values.items()}, source)
    return keep(similar.with_disks_of(made, original, factor), given(made))


def replaced(keys) -> str | None:
    """What is wrong where of two ``keys``, in this order, the second holds the first, so that its value would take the
    place of that of the first; None where none does."""
    ways = [".".join(map(str, key)) if isinstance(key, (tuple, list)) else str(key) for key in keys]
    for way, later in itertools.combinations(ways, 2):
        if way.startswith(later + "."):
            return f"{way} and {later}: the value of the second takes the place of that of the first; name {later} first, or give one of them"
    return None


def put(data, key, value):
    """Puts a value into the plain data of a section, where the ``key`` leads (see :func:`with_values`). Groups of keys
    that are not there yet are made. Raises NoSuchKey where the key leads nowhere."""
    place, way = data, words(key)
    key = ".".join(way)
    for k, word in enumerate(way):
        last, so_far = k == len(way) - 1, ".".join(way[:k])
        if isinstance(place, list):
            names = [_name(item) for item in place if isinstance(item, dict)]
            if word in names and last:
                raise NoSuchKey(
                    f"{key}: {word!r} is an item of {so_far} and no value; give one of its keys, {key}.material"
                )
            if word not in names:
                _refuse(key, word, so_far, names)
            place = place[names.index(word)]
            continue
        if isinstance(place, dict) and not last and word not in place and _is_group(way[: k + 1]):
            place[word] = {}
        if not isinstance(place, dict) or not last and word not in place:
            _refuse(key, word, so_far, place if isinstance(place, dict) else ())
        if last:
            place[word] = copy.deepcopy(value)  # a word that no section has is refused when it is read
        else:
            place = place[word]


def words(key):
    """The words of a key: of one with dots, or a tuple of them."""
    if isinstance(key, (tuple, list)) and key and all(isinstance(word, str) for word in key):
        return tuple(key)
    return tuple(
        checks.text("key", key, NoSuchKey, "give words with dots between them, as 'water.table.rate'").split(".")
    )


def short(keys):
    """Names of keys with dots: the last word, or as many as tell them apart, {key: name}."""

    def last(key, count):
        return ".".join(key.split(".")[-count:])

    return {
        key: next(last(key, n) for n in range(1, 99) if sum(last(other, n) == last(key, n) for other in keys) == 1)
        for key in keys
    }


def _name(item):
    """The name of an item of a list; an interface without one has those of its layers."""
    return item.get("name", "-".join(map(str, item.get("between", ()))))


@cache
def _whole():
    return schema(str(SCHEMA), ())


def _is_group(way):
    """Whether this way leads to a group of keys that a section may have, such as ``stages.end``; names of items are
    any.
    """
    place = _whole()
    for word in way:
        inside = place.get("items", place)  # an item of a list
        below = inside.get("properties", {}).get(word) if inside is place else inside
        if below is None:
            return False
        place = below
    return place.get("type") == "object" and "properties" in place


def _refuse(key, word, so_far, names):
    near = difflib.get_close_matches(word, [str(n) for n in names], 1)
    where = f"in {so_far} of the section" if so_far else "in the section"
    advice = (
        f"did you mean {near[0]!r}?"
        if near
        else f"there are {', '.join(map(str, names))}"
        if names
        else "items without names have no key of their own: give the whole list"
        if isinstance(names, list)
        else "nothing can be varied there"
    )
    raise NoSuchKey(f"{key}: there is no {word!r} {where}; {advice}")
