"""The folder of a command's results: made, tried, and held by one process at a time."""

from __future__ import annotations

import contextlib
import fcntl
import os
from pathlib import Path

from ..errors import UserError
from .whole_files import remove_parts_below

__all__ = ["FolderError", "claim", "claimed"]

LOCK = ".run"  # locked while a process writes into the folder; holds the names of the commands that have, one a line

_held = {}


class FolderError(UserError):
    """A folder that results cannot be written to; the message says why and what helps."""


def claim(folder, command, resume=False):
    """Makes a folder for the results of ``command`` (a name) and holds it until this process ends; what killed
    processes have left half-written in it goes.

    Raises FolderError where nothing can be written there, where another process holds the folder, and for a ``resume``
    where other commands alone have written; WriteError where what is half-written cannot be removed.
    """
    folder = Path(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        place = folder.resolve()
        lock = _held.get(place) or open(folder / LOCK, "a+")
    except OSError as error:
        raise FolderError(
            f"{folder}: the output folder cannot be written ({error.strerror}); give another with --out"
        ) from None
    _held[place] = lock  # open as long as the process lives: the system unlocks it, however that ends
    alone = True
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        del _held[place]
        raise FolderError(
            f"{folder}: another run is writing into this folder; wait for its end, stop it, or give another with --out"
        ) from None
    except OSError:
        alone = False  # a file system without locks: nobody knows
    lock.seek(0)
    names = lock.read().splitlines()
    if resume and names and command not in names:
        raise FolderError(
            f"{folder}: holds what {' and '.join(names)} wrote, nothing of {command}: there is nothing to resume; give another --out, or leave out --resume"
        )
    if command not in names:
        try:
            lock.write(f"{command}\n")
            lock.flush()
            os.fsync(lock.fileno())
        except OSError as error:
            raise FolderError(
                f"{folder}: the output folder cannot be written ({error.strerror}); give another with --out, or free some space"
            ) from None
    if alone:
        remove_parts_below(folder, LOCK)


@contextlib.contextmanager
def claimed(folder, command, resume=False):
    """The same for a block, in a process that lives on, as a notebook's: others may claim the folder once the block has
    ended. Raises what :func:`claim` raises.
    """
    place = Path(folder).resolve()
    before = place in _held
    claim(folder, command, resume)
    try:
        yield
    finally:
        if not before:
            _held.pop(place).close()
