"""Keys of what a cache keeps: other engines or other code make their own, other words do not."""

from pathlib import Path

import pytest

from yade.nonsmooth import packing, section
from yade.nonsmooth.heaps import column, preparation
from yade.nonsmooth.laboratory import pressing
from yade.nonsmooth.studies.slope import slope_packing, states
from yade.nonsmooth.system import cache, installation, keys

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
    "packings": (packing, lambda: packing.cache_path(SHIPPED)),
    "samples": (pressing, lambda: pressing.cache_path(pressing.Shape(count=150, seed=1))),
    "slopes": (slope_packing, lambda: slope_packing.cache_path(SHIPPED)),
    "heaps": (preparation, lambda: preparation.cache_path(column.Column(disks=100, aspect=2.0, seed=1))),
    "benchmark": (states, lambda: states.folder_of(SHIPPED)),
}


NOT_BEHIND = ("figures/forces.py", "figures/video.py", "report/page.py")  # of what is drawn


@pytest.mark.parametrize("cache", CACHES)
def test_other_code_or_engines_make_their_own(cache, monkeypatch):
    """Of each module behind a cache, and of none that is not; a statement of it is enough, wherever it is imported."""
    module, path = CACHES[cache]
    whole, behind, before = keys.statements, keys.made_by(module.__name__), path()
    assert path() == before
    # what gives disks their masses is behind all of them: it was forgotten twice; as were borders of regions and sweeps
    # of a packing
    own = Path(module.__file__).resolve().relative_to(keys.HOME).as_posix()
    wanted = {own, "packing/__init__.py", "model/geometry.py", "model/section/section.py"}
    wanted |= {"world/scene.py"} if cache != "packings" else set()
    assert wanted <= set(behind)
    modules = [file for file in behind if file.endswith(".py")]
    for file in modules:
        monkeypatch.setattr(keys, "statements", lambda p, file=file: "other" if p == keys.HOME / file else whole(p))
        assert path() != before, file
    for file in set(NOT_BEHIND) - set(behind):
        monkeypatch.setattr(keys, "statements", lambda p, file=file: "other" if p == keys.HOME / file else whole(p))
        assert path() == before, file
    monkeypatch.setattr(keys, "statements", whole)
    monkeypatch.setattr(keys, "engines_key", lambda: "others")
    assert (path() == before) == (cache == "packings")  # which no engine makes


@pytest.mark.parametrize("cache", CACHES)
def test_another_build_of_what_packs_makes_its_own(cache, monkeypatch):
    """By its bytes: it is no part of the engines."""
    module, path = CACHES[cache]
    file, whole, before = installation.file_of("_nonsmooth_packing"), keys.digest, path()
    assert file.is_file() and keys.made_by(module.__name__)["_nonsmooth_packing"] == whole(file)
    monkeypatch.setattr(keys, "digest", lambda p: "other" if p == file else whole(p))
    assert path() != before


def test_what_packs_is_behind_nothing_else():
    assert "_nonsmooth_packing" not in keys.made_by("measure.statistics") and "_nonsmooth_packing" in keys.made_by(None)


def test_figures_are_behind_no_packing():
    for cache in ("packings", "samples", "slopes", "heaps"):
        assert not {f for f in keys.made_by(CACHES[cache][0].__name__) if f.startswith(("figures/", "report/"))}


@pytest.fixture
def package(tmp_path, monkeypatch):
    """A package of these files, in place of this one: {file: text}."""

    def write(files):
        for name, text in files.items():
            (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / name).write_text(text)
        for cached in (keys._data, keys._asks_for, keys._closure, keys._calls):
            cached.cache_clear()

    monkeypatch.setattr(keys, "HOME", tmp_path)
    yield write
    monkeypatch.undo()
    for cached in (keys._data, keys._asks_for, keys._closure, keys._calls):
        cached.cache_clear()


FILES = {
    "__init__.py": "",
    "made.py": "from . import near\n\ndef run():\n    from .deep.inside import late\n    call('work:one')\n",
    "near.py": "from nonsmooth.absolute import x\nimport numpy\nfrom os import path\n",
    "absolute.py": "from yade.nonsmooth import by_yade\nfrom .made import run\n",
    "by_yade.py": "TABLE = 'rocks.json'\n",
    "work.py": "",
    "deep/__init__.py": "import importlib\nNAMES = {'a': 'lazy'}\ndef get(n):\n    return importlib.import_module(n)\n",
    "deep/inside.py": "from ..up import y\n",
    "deep/lazy.py": "",
    "deep/other.py": "",
    "up.py": "y = 'apart'\n",
    "apart.py": "",
    "rocks.json": "{}",
    "page.html.j2": "",
}


def test_imports_are_followed_wherever_they_stand(package):
    """Relative and absolute ones, in functions, in a circle, packages on the way, what they import when asked,
    functions that a process calls, and data; nothing else.
    """
    package(FILES)
    assert set(keys.made_by("made:run")) == set(FILES) - {"__init__.py", "deep/other.py", "apart.py", "page.html.j2"}
    assert set(keys.made_by("work")) == {"work.py"}
    for outside in (None, print, "elsewhere:run", ""):
        assert set(keys.made_by(outside)) == set(FILES), outside


def test_who_executes_a_script_is_made_by_all(package):
    package({**FILES, "work.py": "def one(text):\n    exec(compile(text, 'x', 'exec'), {})\n"})
    assert set(keys.made_by("work")) == set(keys.made_by("made")) == set(FILES)


def test_a_function_a_name_and_a_module_are_of_one_module():
    for one in (
        pressing.cache_path,
        "studies.laboratory.pressing:cache_path",
        "studies.laboratory.pressing",
        pressing.__name__,
    ):
        assert keys.module_of(one) == "studies.laboratory.pressing"
    assert keys.module_of(print) is keys.module_of("pressing") is keys.module_of(None) is None


@pytest.mark.parametrize("name", ["packings", "samples", "slopes", "heaps"])
def test_a_new_format_leaves_old_files_alone(name, monkeypatch):
    """A file of the same name would be there, and be made anew by each version in turn."""
    path = CACHES[name][1]
    before = path()
    monkeypatch.setattr(cache, "FORMAT", cache.FORMAT + 1)
    assert path() != before
    assert path().parent == before.parent
