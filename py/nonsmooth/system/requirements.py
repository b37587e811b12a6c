"""What a Python must have for this package: the list in requirements.txt, and one message where something of it is
missing. Needs no YADE.

The message names the package for Debian and for pip. It comes in place of Python's own when a module of this package
imports what is not installed, in a notebook without a traceback.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from functools import cache
from importlib.machinery import PathFinder
from pathlib import Path

from ..errors import UserError

__all__ = ["FILE", "MissingPackage", "Requirement", "listed", "remedy", "watch"]

_PACKAGE = __package__.rpartition(".")[0]
FILE = Path(__file__).resolve().with_name("requirements.txt")


class MissingPackage(UserError, ModuleNotFoundError):
    """A package that this one needs is not installed in the Python that runs; the message says which, and what installs
    it.
    """


@dataclass(frozen=True)
class Requirement:
    """A line of the list: names for ``pip`` and in ``debian``, the ``module`` of it that this package imports, None for
    a program, and what ``use`` is made of it.
    """

    pip: str
    debian: str
    module: str | None
    use: str


@cache
def listed() -> tuple[Requirement, ...]:
    """All Requirements, in the order of the list."""
    found = []
    for line in FILE.read_text(encoding="utf-8").splitlines():
        name, _, note = line.partition("#")
        if name.strip():
            names, _, use = note.partition(":")
            debian, module = (part.strip() for part in names.split(","))
            found.append(Requirement(name.strip(), debian, None if module == "-" else module, use.strip()))
    return tuple(found)


def remedy(*modules) -> str:
    """The commands that install what brings these modules, in words. Raises KeyError for a module that is not in the
    list.
    """
    known = {one.module: one for one in listed()}
    wanted = [known[name] for name in modules]
    return f"apt install {' '.join(one.debian for one in wanted)}, or pip install {' '.join(one.pip for one in wanted)}"


def watch():
    """Has imports by modules of this package that fail say what to install: raises MissingPackage there, in place of
    ModuleNotFoundError.

    Imports by others stay as they are, those of this package's own requirements too.
    """
    if not any(isinstance(one, _LastFinder) for one in sys.meta_path):
        sys.meta_path.append(_LastFinder())


class _LastFinder:
    """Stands behind all finders, so it is asked for modules that none of them has found."""

    def find_spec(self, name, path=None, target=None):
        modules = [one.module for one in listed() if one.module]
        if name not in modules:
            return None
        user = _importer()
        if not f"{user}.".startswith(f"{_PACKAGE}."):
            return None
        if sys.excepthook is sys.__excepthook__:
            sys.excepthook = _say_alone
        # those that would be missed next are named too: one call installs all
        more = [module for module in modules if module != name and PathFinder.find_spec(module) is None]
        also = f" ({', '.join(more)} {'is' if len(more) == 1 else 'are'} missing too)" if more else ""
        raise MissingPackage(
            f"{user} needs the module {name}, which is not installed for {sys.executable or 'this Python'}{also}: {remedy(name, *more)}",
            name=name,
        )


def _importer():
    """Name of the module whose import statement is on its way."""
    frame = sys._getframe(2)
    while frame and frame.f_globals.get("__name__", "").startswith("importlib"):
        frame = frame.f_back
    return frame.f_globals.get("__name__", "") if frame else ""


def _say_alone(kind, error, trace):
    """In a script: the message alone, as commands of this package print it."""
    if isinstance(error, MissingPackage):
        print(f"error: {error}", file=sys.stderr)
    else:
        sys.__excepthook__(kind, error, trace)
