"""The rooms of the package are those of doc/house.rst, and each imports only from those above it. Needs no YADE."""

import ast
import functools
import graphlib
import importlib
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "py" / "nonsmooth"
sys.path.insert(0, str(ROOT / "py"))
#: May import YADE when they are imported themselves: scenes, what runs in one, and what is a script for YADE.
IN_YADE = ("world", "course.driver", "studies", "judges", "running._process_worker")


def rooms():
    """Rooms in the order of the page, the lowest first."""
    page = (ROOT / "doc" / "house.rst").read_text()
    table = page.partition("Rooms of the Python half\n")[2].partition("\nWhere a new thing goes\n")[0]
    return [name for row in re.findall(r"^   \* - (.+)$", table, re.M) for name in re.findall(r"``([\w.]+)``", row)]


def sources():
    """{module: (source, whether it is a package)} of the package, its face as ""."""
    found = {}
    for path in PACKAGE.rglob("*.py"):
        parts = path.relative_to(PACKAGE).with_suffix("").parts
        package = parts[-1] == "__init__"
        found[".".join(parts[:-1] if package else parts)] = path.read_text(), package
    return found


def room_of(module, among):
    """The room that a module stands in, None for one that stands in none."""
    return max((room for room in among if f"{module}.".startswith(f"{room}.")), key=len, default=None)


def docstrings(tree):
    """Nodes of a module's texts that are read by people alone."""
    alone = (node.value for node in ast.walk(tree) if isinstance(node, ast.Expr))
    return {node for node in alone if isinstance(node, ast.Constant)}


def named(text, here, modules):
    """Modules that a text names for an import that a process makes later: "studies.laboratory.biaxial:run", as
    processes.call takes it, "..records" and "yade.nonsmooth.records", as importlib does, and commands with the latter
    in them; ``here``: the parts of the module that the text stands in.
    """
    names = set()
    for found, inner in re.findall(r"\b(?:yade\.)?nonsmooth\.([a-z_.]+)(?![A-Z.a-z_])(?: import ([a-z_]+))?", text):
        names.add(".".join(filter(None, (found.strip("."), inner))))  # not a class, of which a message tells
    if re.fullmatch(r"[a-z_.]+:[a-z_]+", text):
        names.add(text.partition(":")[0])
    if text in modules and "." in text:  # not with an attribute behind it, which is how keys of sections look
        names.add(text)
    if re.fullmatch(r"\.+[a-z_.]+", text):  # with no attribute behind it: ".csv" and ".gif" look so too
        names |= {".".join([*here[:k], text.strip(".")]) for k in range(len(here))} & modules
    face = importlib.import_module("nonsmooth").FACE
    for name in list(names):  # by its public name, or with an attribute behind it
        first = max((one for one in face if f"{name}.".startswith(f"{one}.")), key=len, default=None)
        whole = name if first is None else face[first] + name[len(first) :]
        names.add(whole if whole in modules else whole.rpartition(".")[0])
    return names & modules - {"", "studies"}  # which holds rooms


@functools.cache
def imports(module, source, package, modules):
    """Modules of the package that one imports, wherever in it, also those that a text names."""
    found, tree = set(), ast.parse(source)
    silent = docstrings(tree)
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                found |= named(alias.name, module.split("."), modules)
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and node not in silent:
            found |= named(node.value, module.split("."), modules)
        if not isinstance(node, ast.ImportFrom):
            continue
        if node.level:
            here = module.split(".") if module else []
            here = here if package else here[:-1]
            base = [*here[: len(here) - node.level + 1], *filter(None, (node.module or "").split("."))]
        elif re.match(r"(yade\.)?nonsmooth(\.|$)", node.module or ""):
            base = re.sub(r"^(yade\.)?nonsmooth\.?", "", node.module).split(".")
        else:
            continue
        for alias in node.names:
            inner = ".".join(filter(None, [*base, alias.name]))
            found.add(inner if inner in modules else ".".join(filter(None, base)))
    return found - {""}


def back_up(modules, among):
    """Imports from a room further down the page: [(module, what it imports)]."""
    order = {room: k for k, room in enumerate(among)}
    arrows = []
    for module, (source, package) in modules.items():
        for one in imports(module, source, package, frozenset(modules)) if module else ():
            here, there = room_of(module, among), room_of(one, among)
            if here != there and (here is None or there is None or order[there] > order[here]):
                arrows.append((module, one))
    return sorted(arrows)


def circle(modules):
    """Modules that import each other, each the next one, the last of them the first again: the first such circle that
    is found, None where there is none. A package's own module comes with each of its modules, to those outside of the
    package.
    """
    names, graph = frozenset(modules), {}
    for module, (source, package) in modules.items():
        graph[module] = set()
        for one in imports(module, source, package, names) if module else ():
            words = one.split(".")
            outer = {".".join(words[:k]) for k in range(1, len(words))} & names
            comes = {one, *(o for o in outer if not f"{module}.".startswith(f"{o}."))}
            graph[module] |= comes - {module}
    try:
        graphlib.TopologicalSorter(graph).prepare()
    except graphlib.CycleError as error:
        return error.args[1][::-1]
    return None


def test_every_module_stands_in_a_room_of_the_page():
    among, modules = rooms(), sources()
    assert len(among) == len(set(among))
    assert [m for m in modules if m and room_of(m, among) is None] == ["studies"]  # which holds rooms
    # and no room of the page is empty
    assert {room_of(m, among) for m in modules if m} >= set(among)


def test_nothing_lies_in_the_top_but_errors_contact_and_the_face():
    assert {p.name for p in PACKAGE.glob("*.py")} == {"__init__.py", "errors.py", "contact.py"}


def test_tests_stand_in_folders_as_the_package_has_rooms():
    """Besides those of the engines and of pages; a room with rooms in it has a folder of folders. No two files have one
    name, by which the mutants find them.
    """
    tests = ROOT / "tests" / "yade"
    files = sorted(path.relative_to(tests) for path in tests.rglob("test_*.py"))
    folders = {".".join(path.parts[:-1]) for path in files} - {"", "dem", "documentation"}
    known = {*rooms(), *(room.partition(".")[0] for room in rooms())}
    assert folders - known == set()
    assert {"model", "records", "world", "studies.slope", "judges"} <= folders
    assert len({path.name for path in files}) == len(files) > 140


def test_no_room_imports_from_one_below_it():
    """An order of all rooms that all imports keep has no circle between rooms either."""
    assert back_up(sources(), rooms()) == []


@pytest.mark.parametrize(
    "module, line",
    [
        ("system.keys", "from ..records import Snapshot"),
        ("measure.bands", "def late():\n    from ..figures import style"),
        ("studies.laboratory.walls", "from ..comparison import cases"),
        ("records.series", "from yade.nonsmooth.world import tables"),
        ("model.geometry", "from .. import campaign"),
        ("records.columns", "__getattr__ = lambda name: importlib.import_module('...studies.slope.columns', __name__)"),
        ("records.series", "import yade.nonsmooth.world.tables"),
        ("running.processes", "FUNCTION = 'studies.slope.slope_run:run'"),
        ("figures.moving", "COMMAND = f'import yade.nonsmooth.experiment; yade.nonsmooth.experiment.row({1})'"),
    ],
)
def test_an_import_that_runs_back_up_is_seen(module, line):
    modules = sources()
    source, package = modules[module]
    modules[module] = f"{source}\n{line}\n", package
    assert [found for found, _ in back_up(modules, rooms())] == [module]


def test_no_modules_import_each_other():
    assert circle(sources()) is None


@pytest.mark.parametrize(
    "module, line, found",
    [
        ("records.error", "from .series import SeriesWriter", {"records.error", "records.series"}),
        ("records.columns", "def late():\n    from . import RecordsError", {"records.columns", "records"}),
        ("campaign.plan", "from . import sweep", {"campaign.plan", "campaign.sweep"}),
        (
            "campaign.script_output",
            "FUNCTION = 'campaign.script_run:run'",
            {"campaign.script_output", "campaign.script_run"},
        ),
        ("system.checks", "from ..packing.files import Packing", None),
        (
            "world.hardening.domain",
            "COMMAND = 'from yade.nonsmooth.world.hardening import lists'",
            {"world.hardening.domain", "world.hardening.lists"},
        ),
        ("studies.slope.error", "import yade.nonsmooth.experiment", None),
    ],
)
def test_a_circle_is_seen(module, line, found):
    """``found``: its modules, None where they are many."""
    modules = sources()
    source, package = modules[module]
    modules[module] = f"{source}\n{line}\n", package
    seen = circle(modules)
    assert module in seen and (found is None or set(seen) == found)


def test_yade_is_imported_where_scenes_are():
    modules, guilty = sources(), []
    for module, (source, _) in modules.items():
        if any(f"{module}.".startswith(f"{room}.") for room in IN_YADE):
            continue
        for node in ast.parse(source).body:
            names = [node.module or ""] if isinstance(node, ast.ImportFrom) and not node.level else []
            names += [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            guilty += [module for name in names if re.match(r"yade(\.|$)", name)]
    assert guilty == []


def in_plain_python(code):
    """What a plain Python prints, with the package on its path and nothing of YADE's."""
    done = subprocess.run(
        ["/usr/bin/python3", "-c", f"import sys; sys.path.insert(0, {str(ROOT / 'py')!r})\n{code}"],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


def test_all_other_rooms_can_be_imported_without_yade():
    names = [f"nonsmooth.{m}" for m in sources() if m and not f"{m}.".startswith(tuple(f"{r}." for r in IN_YADE))]
    said = in_plain_python(
        f"import importlib\nfor name in {sorted(names)!r}: importlib.import_module(name)\nprint('yade' in sys.modules)"
    )
    assert said == ["False"] and len(names) > 100


def test_the_package_alone_loads_no_large_library():
    large = ("matplotlib", "pandas", "scipy", "shapely", "numpy")
    assert in_plain_python(f"import nonsmooth\nprint(*[m for m in {large!r} if m in sys.modules])") == []


def test_the_face_shows_each_module_where_it_stands():
    """``from nonsmooth import section`` and ``import nonsmooth.section`` give the module of its room, not a second one;
    others' attributes stay.
    """
    code = "\n".join(
        [
            "import importlib, nonsmooth",
            "for name, place in nonsmooth.FACE.items():",
            "    try:",
            "        real = importlib.import_module(f'nonsmooth.{place}')",
            "    except ModuleNotFoundError as error:",
            "        assert error.name == 'yade' or error.name.startswith('yade.'), (name, error)",
            "        continue",
            "    spec = real.__spec__",
            "    assert importlib.import_module(f'nonsmooth.{name}') is real, name",
            "    assert real.__spec__ is spec and spec.name == f'nonsmooth.{place}', name",
            "    if '.' not in name: assert getattr(nonsmooth, name) is real and name in dir(nonsmooth), name",
            "try:",  # and what is not there is not there
            "    import nonsmooth.laboratory.strength_",
            "except ModuleNotFoundError as error:",
            "    print(error.name)",
        ]
    )
    assert in_plain_python(code) == ["nonsmooth.laboratory.strength_"]


def test_a_name_that_is_not_there_is_refused():
    import nonsmooth

    with pytest.raises(AttributeError, match="no attribute 'sections_of_mine'"):
        nonsmooth.sections_of_mine  # noqa: B018
    with pytest.raises(ModuleNotFoundError):
        importlib.import_module("nonsmooth.sections_of_mine")


def test_what_is_public_says_what_it_is_and_is_listed():
    """Each module but the judges' lists its names, and each public function, class and method has a docstring."""
    silent, unlisted = [], []
    for module, (source, _) in sources().items():
        if any(part.startswith("_") for part in module.split(".")):
            continue
        tree = ast.parse(source)
        made = [n for n in tree.body if isinstance(n, (ast.FunctionDef, ast.ClassDef)) and not n.name.startswith("_")]
        inner = [
            k
            for n in made
            if isinstance(n, ast.ClassDef)
            for k in n.body
            if isinstance(k, ast.FunctionDef) and not k.name.startswith("_")
        ]
        silent += [f"{module}.{n.name}" for n in made + inner if not ast.get_docstring(n)]
        names = [n for n in tree.body if isinstance(n, ast.Assign) and getattr(n.targets[0], "id", "") == "__all__"]
        unlisted += [module] if made and not names and not module.startswith("judges.") else []
    assert silent == [] and unlisted == []


def test_no_two_classes_have_one_name():
    """So that a message, a page or a search says which is meant."""
    found = [
        n.name for source, _ in sources().values() for n in ast.walk(ast.parse(source)) if isinstance(n, ast.ClassDef)
    ]
    assert sorted({name for name in found if found.count(name) > 1}) == []


def test_no_lambda_has_a_name():
    """A function that has one is defined, so that a traceback says which it is."""
    named = [
        f"{path.relative_to(ROOT)}:{node.lineno}"
        for folder in ("py", "scripts", "tests", "doc", "cmake")
        for path in sorted((ROOT / folder).rglob("*.py"))
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Lambda) and isinstance(node.targets[0], ast.Name)
    ]
    assert not named
