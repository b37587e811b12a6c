"""What a section was given, before anything is filled in or derived: its plain data, kept beside what was built from
them, and values put into these. Needs no YADE.
"""

from __future__ import annotations

import copy
import dataclasses
import difflib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

from ...system import checks
from . import data as section_data
from .folder import SCHEMA
from .reader import SectionError, schema

__all__ = ["Given", "NoSuchKey", "given", "keep", "keep_value", "put", "words"]

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
