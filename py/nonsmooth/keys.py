"""Keys: what a result that is kept was made of, so that none is taken for that of other input, engines or code. Needs no YADE."""

from __future__ import annotations

import ast
import functools
import hashlib
import json
from pathlib import Path

from . import installation

__all__ = ["code_key", "digest", "engines_key", "key_of", "making_key", "run_key", "statements"]

HOME = Path(__file__).resolve().parent


def key_of(plain) -> str:
    """Key of plain data (what JSON can hold)."""
    return hashlib.sha256(json.dumps(plain, sort_keys=True).encode()).hexdigest()


@functools.cache
def digest(path) -> str:
    """SHA-256 of a file's bytes; a Path is read once in a process."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def engines_key() -> str:
    """Key of the engines as they were built: what they have computed and a cache keeps is another build's, perhaps by its last bits, once they change."""
    return digest(installation.engines())


@functools.cache
def code_key() -> str:
    """Key of this package as it is: all of its Python, its schemas and its table of rocks. The shipped sections are input."""
    files = sorted(path for pattern in ("*.py", "*.schema.yaml", "rocks.json") for path in HOME.rglob(pattern))
    return key_of([[str(path.relative_to(HOME)), digest(path)] for path in files])


@functools.cache
def statements(path) -> str:
    """SHA-256 of what a Python file does: of its syntax tree without docstrings, so that neither comments nor layout count. A Path is read once in a process."""
    tree = ast.parse(path.read_bytes())
    for node in ast.walk(tree):
        if (
            isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef))
            and ast.get_docstring(node, clean=False) is not None
        ):
            del node.body[0]
    return hashlib.sha256(ast.dump(tree).encode()).hexdigest()


def making_key(*modules) -> str:
    """Key of what makes the disks that a cache keeps: the engines, and the statements of modules of this package, named from its top ("laboratory.pressing")."""
    files = (HOME.joinpath(*name.split(".")).with_suffix(".py") for name in modules)
    return key_of([engines_key(), *map(statements, files)])


def run_key(key) -> str:
    """Key of a run whose input has the ``key``: of the input, the engines and the code."""
    return key_of([key, engines_key(), code_key()])
