"""Keys: what a result that is kept was made of, so that none is taken for that of other input, engines or code. Needs
no YADE.
"""

from __future__ import annotations

import ast
import functools
import hashlib
import json
import re
from pathlib import Path

from . import installation

__all__ = ["digest", "engines_key", "hash_of", "key_of", "made_by", "making_key", "module_of", "run_key", "statements"]

HOME = Path(__file__).resolve().parents[1]  # of the package
DATA = ("*.schema.yaml", "rocks.json", "*.j2")  # files of this package that its modules read
COMPILED = ("_nonsmooth_packing",)  # modules of which the engines hold nothing (see engines_key)


def key_of(plain) -> str:
    """Key of plain data (what JSON can hold)."""
    return hashlib.sha256(json.dumps(plain, sort_keys=True).encode()).hexdigest()


@functools.cache
def digest(path) -> str:
    """SHA-256 of a file's bytes; a Path is read once in a process."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def engines_key() -> str:
    """Key of the engines as they were built: what they have computed and a cache keeps is another build's, perhaps by
    its last bits, once they change.
    """
    return digest(installation.engines())


@functools.cache
def statements(path) -> str:
    """SHA-256 of what a Python file does: of its syntax tree without docstrings, so that neither comments nor layout
    count. A Path is read once in a process.
    """
    tree = _tree(path)
    for node in ast.walk(tree):
        if (
            isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef))
            and ast.get_docstring(node, clean=False) is not None
        ):
            del node.body[0]
    return hashlib.sha256(ast.dump(tree).encode()).hexdigest()


def _tree(path):
    return ast.parse(path.read_bytes())


def module_of(function) -> str | None:
    """The module that a function is of, named from the top of this package ("laboratory.pressing"); None for one
    outside of it. A function may be given by its name, as processes.call takes it ("studies.laboratory.pressing:run"),
    and a module by its own, with or without the package's (``__name__``)."""
    name = function.partition(":")[0] if isinstance(function, str) else getattr(function, "__module__", "")
    name = re.sub(r"^(yade\.)?nonsmooth\.", "", name)
    return name if name and _file(name.split(".")) else None


def _file(parts):
    """The file of a module of this package, None where there is none."""
    path = HOME.joinpath(*parts)
    return next((p for p in (path.with_suffix(".py"), path / "__init__.py") if parts and p.is_file()), None)


@functools.cache
def _data() -> dict:
    """Files that modules of this package read, by their names. The shipped sections are input."""
    files = (path for kind in DATA for path in HOME.rglob(kind))
    return {path.name: path for path in files}


def _all():
    """All files of this package that decide anything."""
    return {*HOME.rglob("*.py"), *_data().values()}


@functools.cache
def _asks_for(path) -> frozenset:
    """Files of this package that a module of it reads or imports, wherever in it: also by the name of a function that a
    process calls ("studies.laboratory.biaxial:run"), and of those modules of its own package that it imports when they
    are asked for."""
    tree = _tree(path)
    if any(isinstance(node, ast.Call) and getattr(node.func, "id", None) == "exec" for node in ast.walk(tree)):
        return frozenset(_all())  # it runs a script, which may import anything
    found, package = set(), path.relative_to(HOME).parts[:-1]
    names = {node.attr for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            top = re.sub(r"^(yade\.)?nonsmooth(\.|$)", "", node.module or "")
            if node.level == 0 and top == (node.module or ""):
                continue  # another package's
            base = (package[: len(package) - node.level + 1] if node.level else ()) + tuple(
                filter(None, top.split("."))
            )
            found |= {_file((*base, alias.name)) or _file(base) for alias in node.names}
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            name = node.value
            found.add(_data().get(name))
            if re.fullmatch(r"[\w.]+:\w+", name):
                found.add(_file(name.partition(":")[0].split(".")))
            elif "import_module" in names and name.isidentifier():
                found.add(_file((*package, name)))
    # a package is imported before what is in it
    found |= {
        _file(f.relative_to(HOME).parts[:k]) for f in found if f for k in range(1, len(f.relative_to(HOME).parts))
    }
    return frozenset(found - {None, path})


@functools.cache
def _closure(name):
    """The file of a module of this package, and those of all that it imports or reads, directly or not; all files for
    None.
    """
    if name is None:
        return _all()
    files, new = set(), {_file(name.split("."))}
    while new:
        files |= new
        new = {f for path in new if path.suffix == ".py" for f in _asks_for(path)} - files
    return files


def made_by(function=None) -> dict:
    """What decides, besides input and engines, what a ``function`` or a module of this package makes (see
    :func:`module_of`): {file: hash} of the statements of its module and of all modules that this imports, directly or
    not, of the data that they read, and by its name of what they call that is compiled. Of one outside of this package,
    or None: of all that is in it.
    """
    files = _closure(module_of(function))
    named = sorted(path.relative_to(HOME).as_posix() for path in files)
    return {file: hash_of(file) for file in (*named, *sorted(set().union(*map(_calls, files))))}


@functools.cache
def _calls(path) -> frozenset:
    """The names of compiled modules (:data:`COMPILED`) that a file of this package asks installation.module for."""
    calls = (node for node in ast.walk(_tree(path)) if isinstance(node, ast.Call)) if path.suffix == ".py" else ()
    asked = [c.args[0] for c in calls if getattr(c.func, "attr", None) == "module" and c.args]
    return frozenset(a.value for a in asked if isinstance(a, ast.Constant) and a.value in COMPILED)


def hash_of(file) -> str | None:
    """What :func:`made_by` has now for a file of this package; None where it is not there."""
    path = installation.file_of(file) if file in COMPILED else HOME / file
    if path is None or not path.is_file():
        return None
    return statements(path) if path.suffix == ".py" else digest(path)


def making_key(function) -> str:
    """Key of what makes the disks that a cache keeps: the engines, and all that :func:`made_by` has."""
    return key_of([engines_key(), made_by(function)])


def run_key(key, function=None) -> str:
    """Key of a run whose input has the ``key``, by a ``function`` (see :func:`module_of`): of the input, the engines
    and the code; without a function, of all code of this package.
    """
    return key_of([key, engines_key(), made_by(function)])
