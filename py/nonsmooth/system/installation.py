"""Where the YADE that runs scenes is, and its engines: from within it, or from a plain Python (a notebook, a cluster's
login node). Needs no YADE.

Within YADE it is the one that runs. A plain Python finds that of the checkout which this package lies in, built below
``build`` or ``$NONSMOOTH_BUILD``; or the one that the plugin is installed in.
"""

from __future__ import annotations

import importlib
import importlib.util
import os
import shutil
import sys
from pathlib import Path

from ..errors import UserError

__all__ = ["InstallationError", "command", "engines", "file_of", "module"]

_PACKAGE = Path(__file__).resolve().parents[1]
_CHECKOUT = _PACKAGE.parents[1]
# the folder of a YADE's libraries, where this package is installed in its py/yade
_INSTALLED = Path(__file__).parents[4]


class InstallationError(UserError, RuntimeError):
    """There is no YADE with the plugin; the message says what would make one."""


def _within():
    """The configuration of the YADE that runs this, or None."""
    return sys.modules.get("yade.config") if __name__.startswith("yade.") else None


def command(threads) -> list:
    """The words that run a script in YADE, without graphics; the script and its arguments follow. Raises
    InstallationError.
    """
    here, prefix = _within(), os.environ.get("YADE_PREFIX")  # set where the plugin is used from its build folder
    if here:
        return [
            str(Path(prefix or here.prefix) / "bin" / ("yade" if prefix else f"yade{here.suffix}")),
            "-n",
            "-x",
            f"-j{threads}",
        ]
    engines()
    program = _prefix() / "bin" / "yade"
    found = str(program) if program.exists() else shutil.which("yade")
    if found is None:
        raise InstallationError("no program is called yade: put its folder into PATH")
    return [found, "-n", "-x", f"-j{threads}"]


def engines() -> Path:
    """The library of the plugin's engines. Raises InstallationError where there is none."""
    here, name = _within(), "nonsmooth_engines.so"
    found = [Path(here.libDir, name)] if here else [*sorted(_prefix().glob(f"lib/*/yade*/{name}")), _INSTALLED / name]
    path = next((p for p in found if p.is_file()), None)
    if path is None:
        raise InstallationError(
            f"the plugin is not built: run {_CHECKOUT}/scripts/setup.sh first, or name its build folder in NONSMOOTH_BUILD"
        )
    return path


def modules() -> Path:
    """The folder of the checkout's build in which modules stand that need no YADE."""
    return _prefix().parent / "python"


def _look_beside():
    """Outside YADE, which has them on the path, modules are looked for in the build as well, as the last place."""
    beside = str(modules())
    if beside not in sys.path:
        sys.path.append(beside)


def module(name):
    """A module of this build that needs no YADE, by its name. Raises InstallationError where it is not built."""
    _look_beside()
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name != name:
            raise
        raise InstallationError(
            f"the module {name} is not built; run scripts/setup.sh, and have build/python on the PYTHONPATH"
        ) from None


def file_of(name) -> Path | None:
    """The file of such a module, None where it is not built."""
    _look_beside()
    found = importlib.util.find_spec(name)
    return Path(found.origin) if found else None


def _prefix():
    return Path(os.environ.get("NONSMOOTH_BUILD") or _CHECKOUT / "build") / "prefix"
