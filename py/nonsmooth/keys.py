"""Keys: what a result that is kept was made of, so that none is taken for that of other input, engines or code. Needs no YADE."""

from __future__ import annotations

import functools
import hashlib
import json
from pathlib import Path

from . import installation

__all__ = ["code_key", "digest", "engines_key", "key_of", "run_key"]


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
    """Key of this package as it is: all of its Python and its schemas. The shipped sections are input."""
    home = Path(__file__).resolve().parent
    files = sorted(path for pattern in ("*.py", "*.schema.yaml") for path in home.rglob(pattern))
    return key_of([[str(path.relative_to(home)), digest(path)] for path in files])


def run_key(key) -> str:
    """Key of a run whose input has the ``key``: of the input, the engines and the code."""
    return key_of([key, engines_key(), code_key()])
