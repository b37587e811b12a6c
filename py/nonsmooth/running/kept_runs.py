"""Runs in folders of their own: how far one is, and the result that it keeps, so that a resume does not repeat it."""

from __future__ import annotations

import json
import time
from pathlib import Path

from ..system import keys
from ..system.whole_files import WriteError, list_of, write_atomically, write_json

__all__ = ["MADE_BY", "Progress", "begin", "begun", "changed", "foreign", "forget", "forsake", "keep", "kept", "share"]

MADE_BY = "made_by.json"
NOTE_SECONDS = 1.0  # of wall time between two notes of how far a run is


class Progress:
    """Notes the share done in a run's folder, once in :data:`NOTE_SECONDS` at most."""

    def __init__(self, folder):
        self._path, self._shown = Path(folder) / "progress", 0.0

    def __call__(self, done):
        if time.monotonic() - self._shown > NOTE_SECONDS:
            write_atomically(self._path, f"{done:.4f}".encode())
            self._shown = time.monotonic()


def share(folder):
    """Share of a run that is done: 1 where its result is there, else what :class:`Progress` noted last, at most
    0.99.
    """
    folder = Path(folder)
    if (folder / "result.json").exists():
        return 1.0
    try:
        return min(0.99, float((folder / "progress").read_text()))
    except (OSError, ValueError):
        return 0.0


def begin(folder, key, function=None):
    """Notes what a run is of, before it writes anything else; ``key``: of its input, ``function``: which makes it, see
    keys.run_key. ``made_by.json`` keeps what the key is made of.
    """
    made = {"input": key, "engines": keys.engines_key(), "code": keys.made_by(function)}
    write_json(Path(folder) / MADE_BY, made)
    write_atomically(Path(folder) / "key", keys.run_key(key, function).encode())


def changed(folder, key=None, function=None):
    """What has changed since a run began in the folder: "input" (where a ``key`` is given), "engines", and files of
    this package, a list; None where no run has noted it.
    """
    try:
        made = json.loads((Path(folder) / MADE_BY).read_text())
        then = made["code"]
        now = keys.made_by(function) if function else {file: keys.hash_of(file) for file in then}
        found = [
            name for name, value in (("input", key), ("engines", keys.engines_key())) if value not in (None, made[name])
        ]
        return found + sorted(file for file in {*then, *now} if then.get(file) != now.get(file))
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None


def forsake(folder):
    """Notes that what is in the folder is of no run any more, and may be removed. Raises OSError."""
    if Path(folder).exists():
        write_atomically(Path(folder) / "key", b"")


def foreign(folder, *spared):
    """The name of a file or folder in a folder that no run has written to; None where a run has, or where it is empty
    but for what is ``spared``.
    """
    folder = Path(folder)
    if not folder.is_dir() or any((folder / name).exists() for name in ("key", "result.json")):
        return None
    return next((name for name in sorted(path.name for path in list_of(folder)) if name not in spared), None)


def begun(folder, key, function=None):
    """Whether what is in the folder is of a run of this input, these engines and this code."""
    try:
        return (Path(folder) / "key").read_text() == keys.run_key(key, function)
    except (OSError, ValueError):
        return False


def keep(folder, key, found, function=None):
    """Writes the result of a run; ``key``: of its input, ``function``: which made it, see keys.run_key. What it is of
    stands beside it: input, engines and code.
    """
    write_json(Path(folder) / "result.json", {"key": keys.run_key(key, function), "found": found})


def forget(folder):
    """Removes the result of an earlier run, and how far it was. Raises WriteError."""
    for name in ("result.json", "progress"):
        path = Path(folder) / name
        try:
            path.unlink(missing_ok=True)
        except OSError as error:
            raise WriteError(
                f"{path}: left from an earlier run, and cannot be removed ({error.strerror}); remove it, or give another --out"
            ) from None


def kept(folder, key, function=None):
    """The result that :func:`keep` wrote, None where there is none of this input, these engines and this code."""
    try:
        content = json.loads((Path(folder) / "result.json").read_text())
        return content["found"] if content["key"] == keys.run_key(key, function) else None
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return None
