"""The cache: what takes long to make is made once, and kept below ${XDG_CACHE_HOME:-~/.cache}/yade-nonsmooth. Needs no
YADE.

An entry is a file of arrays with a format and a checksum. Its name has the key of all that it was made of
(:mod:`.keys`), so it is never wrong, only old. It is written beside and renamed: two processes that miss the same entry
both make it, the last file stays, and no reader meets half of one. What is damaged is made anew, with a note. The time
of change of an entry is that of its last use. Other things that are kept as folders, such as saved scenes, lie in a
:func:`folder` too and are :func:`used`, so that they age in the same way.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import shutil
import time
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import numpy as np

from ..errors import UserError, UserNote
from . import checks
from .whole_files import list_of, write_arrays

__all__ = ["FOLDERS", "FORMAT", "Cache", "CacheError", "clear", "folder", "old", "used"]

FOLDERS = ("packings", "samples", "heaps", "benchmark")  # beside them lie the set-up's sources and builds
FORMAT = 3  # of the files; a new number makes old ones unused


class CacheError(UserError, ValueError):
    """An age that is none, or a folder that is not the cache's; the message says what would do."""


@dataclass(frozen=True)
class Cache:
    """Entries of one kind, in a :func:`folder` of the cache.

    ``write``: gives arrays and numbers, a dictionary by their names, for a value (by default its attributes); ``read``:
    makes the value of them, as arguments by name.
    """

    name: str
    read: Callable
    write: Callable = vars

    def path(self, key, tail="") -> Path:
        """The file of an entry: of its key (hexadecimal digits) and a ``tail``, which may say more. Files of another
        format have another name.
        """
        return folder(self.name) / f"{key[:32]}{tail}-v{FORMAT}.npz"

    def of(self, path, make):
        """The value of an entry; what ``make`` returns, which is kept, where there is none. Raises WriteError, and what
        ``make`` raises.
        """
        found = self.find(path)
        if found is None:
            found = make()
            self.keep(path, found)
        return found

    def find(self, path):
        """The value of an entry, which counts as used now; None where there is none, and, with a UserNote, where it is
        damaged, cannot be read or has another format.
        """
        try:
            with open(path, "rb") as file, np.load(file) as arrays:  # NumPy alone would leave a damaged one open
                stored = dict(arrays)
            version, checksum = int(stored.pop("format")), str(stored.pop("checksum"))
            if version != FORMAT:
                raise ValueError(f"format {version}, this version reads {FORMAT}")
            if checksum != _checksum(stored):
                raise ValueError("its content does not match its checksum")
        except FileNotFoundError:
            return None
        except Exception as error:  # NumPy's and zipfile's readers let through whatever a damaged file makes them meet
            said = " ".join(str(error).split()) or type(error).__name__
            warnings.warn(f"{path}: damaged, or of another version ({said}); it is made anew", UserNote)
            return None
        used(path)
        return self.read(**{name: value if value.ndim else value.item() for name, value in stored.items()})

    def keep(self, path, value) -> None:
        """Writes the entry of a value. Raises WriteError."""
        stored = {name: np.asarray(one) for name, one in self.write(value).items()}
        write_arrays(path, **stored, format=np.int64(FORMAT), checksum=np.array(_checksum(stored)))


def _checksum(stored):
    """SHA-256 (hex) of names, types, shapes and bits."""
    digest = hashlib.sha256()
    for name, value in sorted(stored.items()):
        digest.update(f"{name} {value.dtype.str} {value.shape} ".encode())
        digest.update(value.tobytes())
    return digest.hexdigest()


def folder(name) -> Path:
    """The folder of one of :data:`FOLDERS`, which may not be there. Raises CacheError for another name."""
    if name not in FOLDERS:
        raise CacheError(f"cache {checks.shown(name)}: there is none of this name; give one of {', '.join(FOLDERS)}")
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "yade-nonsmooth" / name


def used(path) -> None:
    """Notes that an entry, a file or a folder, is used now; nothing where it may not be written."""
    with contextlib.suppress(OSError):
        os.utime(path)


def old(days, *names) -> list[Path]:
    """Sorted paths of what nobody has used for more than so many days, in the folders ``names``, or in all; what killed
    processes left half-written too.

    Raises CacheError where ``days`` is no number from 0, and for an unknown name.
    """
    remedy = "give the days without use after which an entry is old, 0 or more"
    before = time.time() - 86400 * checks.number("days", days, CacheError, remedy, least=0)
    return sorted(path for name in names or FOLDERS for path in list_of(folder(name)) if _last_use(path) < before)


def _last_use(path):
    try:
        return path.stat().st_mtime
    except OSError:  # another process has cleared it
        return float("inf")


def clear(days, *names) -> list[Path]:
    """Removes what is :func:`old`, and returns the paths of what has gone. With a small ``days`` nothing else should be
    running: it may be writing there.
    """
    found = old(days, *names)
    for path in found:
        with contextlib.suppress(OSError):
            shutil.rmtree(path) if path.is_dir() and not path.is_symlink() else path.unlink()
    return [path for path in found if not os.path.lexists(path)]
