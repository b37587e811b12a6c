"""The folders of the C++ half are those of doc/house.rst, each includes only from those that it may, and no file is
long. Needs no YADE.
"""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PKG = ROOT / "pkg"
#: {folder: what its files may include of ours, besides itself}
MAY_INCLUDE = {
    "contact/core": set(),
    "contact/plane": {"contact/core"},
    "contact/space": {"contact/core"},
    "contact/slip": set(),
    "neighbours": set(),
    "packing": {"neighbours"},
    "bindings": {"contact/core", "contact/plane", "contact/space", "contact/slip", "neighbours", "packing"},
}
LONGEST = 400  # lines


def sources():
    return sorted(p for p in PKG.rglob("*") if p.suffix in (".hpp", ".cpp", ".tpp", ".inc"))


def folder_of(path):
    return path.parent.relative_to(PKG).as_posix()


def included(text, here):
    """Files of ours that a source includes."""
    for bracket, name in re.findall(r'^\s*#include ([<"])([^>"]+)[>"]', text, re.M):
        found = (PKG / name) if bracket == "<" else (here / name).resolve()
        if found.is_file():
            yield found
        elif bracket == '"' and (PKG / name).is_file():
            yield PKG / name


def forbidden(files):
    """Includes of folders that a folder may not include: [(folder, what it includes)]."""
    found = set()
    for path, text in files:
        here = folder_of(path)
        if here not in MAY_INCLUDE:
            continue
        for other in included(text, path.parent):
            there = folder_of(other)
            if there != here and there not in MAY_INCLUDE[here]:
                found.add((here, there))
    return sorted(found)


def test_what_needs_no_yade_includes_no_engine_and_the_core_no_dimension():
    files = [(path, path.read_text()) for path in sources()]
    assert len(files) > 200
    assert forbidden(files) == []


@pytest.mark.parametrize(
    "file, line, arrow",
    [
        ("contact/core/sweeper.hpp", "#include <contact/plane/problem.hpp>", ("contact/core", "contact/plane")),
        ("contact/plane/law.hpp", "#include <contact/space/law.hpp>", ("contact/plane", "contact/space")),
        ("neighbours/cell.hpp", '#include "../dem/seam/Resident.hpp"', ("neighbours", "dem/seam")),
    ],
)
def test_an_include_of_another_folder_is_seen(file, line, arrow):
    path = PKG / file
    assert forbidden([(path, f"{line}\n{path.read_text()}")]) == [arrow]


def test_headers_of_yade_stand_in_dem_alone():
    """YADE's own folders are lib, core and pkg; the solver builds without them."""
    of_yade = re.compile(r"#include <(lib|core|pkg)/")
    found = {folder_of(path) for path in sources() if of_yade.search(path.read_text())}
    assert {folder for folder in found if not folder.startswith("dem/")} == set()
    assert "dem/engines" in found


def test_folders_are_those_of_the_page():
    page = (ROOT / "doc" / "house.rst").read_text().partition("Rooms of the Python half\n")[0]
    told = set(re.findall(r"``pkg/([\w/]+)``", page))
    folders = {folder_of(path) for path in sources()}
    assert folders <= told
    assert {folder for folder in told if not (PKG / folder).is_dir()} == set()


def test_no_file_is_long():
    assert {path.name: n for path in sources() if (n := len(path.read_text().splitlines())) > LONGEST} == {}
