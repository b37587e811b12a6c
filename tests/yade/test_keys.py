"""Keys of what a cache keeps: other engines or other code make their own, other words do not."""

import pytest

from yade.nonsmooth import keys, packing_files, section, slope_packing
from yade.nonsmooth.benchmark import states
from yade.nonsmooth.heaps import column, preparation
from yade.nonsmooth.laboratory import pressing

SOURCE = '''
"""Squares."""

def area(radius):
    """Area of a disk."""
    return 3.14 * (radius * radius)
'''


def of(tmp_path, source):
    path = tmp_path / f"{len(list(tmp_path.iterdir()))}.py"
    path.write_text(source)
    return keys.statements(path)


@pytest.mark.parametrize(
    "old, new",
    [
        ("Area of a disk.", "What a disk covers."),
        ("Squares.", ""),
        ("3.14 * (", "3.14 * (  # not pow()\n        "),
        ("def area", "\n\ndef area"),
    ],
)
def test_words_and_layout_do_not_count(tmp_path, old, new):
    assert old in SOURCE
    assert of(tmp_path, SOURCE.replace(old, new)) == of(tmp_path, SOURCE)


@pytest.mark.parametrize("old, new", [("(radius * radius)", "radius**2"), ("3.14", "3.1416"), ("area", "surface")])
def test_statements_count(tmp_path, old, new):
    assert of(tmp_path, SOURCE.replace(old, new)) != of(tmp_path, SOURCE)


def test_a_docstring_alone_is_a_body(tmp_path):
    source = 'class Error(Exception):\n    """A kind of its own."""\n'
    assert of(tmp_path, source) == of(tmp_path, source.replace("kind", "sort"))


SHIPPED = section.load("jiufengershan").with_disks(600)
CACHES = {
    "samples": (pressing, lambda: pressing.cache_path(pressing.Shape(count=150, seed=1))),
    "slopes": (slope_packing, lambda: slope_packing.cache_path(SHIPPED)),
    "heaps": (preparation, lambda: preparation.cache_path(column.Column(disks=100, aspect=2.0, seed=1))),
    "benchmark": (states, lambda: states.folder_of(SHIPPED)),
}


@pytest.mark.parametrize("cache", CACHES)
def test_other_code_or_engines_make_their_own(cache, monkeypatch):
    module, path = CACHES[cache]
    found = {path()}
    assert path() in found
    # what gives disks their masses is behind all of them: it was forgotten twice
    assert {"scene", "packing", module.__name__.removeprefix("yade.nonsmooth.")} <= set(module.MADE_BY)
    whole = keys.statements
    for name in module.MADE_BY:
        file = keys.HOME.joinpath(*name.split(".")).with_suffix(".py")
        monkeypatch.setattr(keys, "statements", lambda p, file=file: "other" if p == file else whole(p))
        found.add(path())
    monkeypatch.setattr(keys, "statements", whole)
    monkeypatch.setattr(keys, "engines_key", lambda: "others")
    found.add(path())
    assert len(found) == 2 + len(module.MADE_BY)


@pytest.mark.parametrize(
    "path",
    [CACHES["slopes"][1], CACHES["heaps"][1], lambda: packing_files.cache_path(SHIPPED)],
    ids=["slope", "heap", "packing"],
)
def test_a_new_format_leaves_old_files_alone(path, monkeypatch):
    """A file of the same name would be there, and refuse to be read."""
    before = path()
    monkeypatch.setattr(packing_files, "FORMAT", packing_files.FORMAT + 1)
    assert path() != before
    assert path().parent == before.parent
