"""Files that are whole or not there: written beside, then renamed."""

from __future__ import annotations

import contextlib
import io
import json
import os
import secrets
import shutil
from pathlib import Path

import numpy as np

from ..errors import UserError

__all__ = [
    "WriteError",
    "beside",
    "empty",
    "remove",
    "remove_parts",
    "remove_parts_below",
    "sync_folder",
    "whole",
    "write_arrays",
    "write_atomically",
    "write_json",
]

PART = ".part-"  # begins the names of files that are being written


class WriteError(UserError, OSError):
    """A file that cannot be written; the message says which, why and what helps."""


@contextlib.contextmanager
def beside(path):
    """A path in the same folder and with the same suffix to write to: it takes the place of ``path`` when the block
    ends, and goes if the block raises.

    The folder is made if need be. Raises OSError, and what the block raises.
    """
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f"{PART}{secrets.token_hex(4)}-{path.name}")
    try:
        yield part
        os.replace(part, path)
    except BaseException:
        with contextlib.suppress(OSError):
            part.unlink()
        raise


def whole(folder, pattern):
    """Sorted paths of the files in ``folder`` that match a pattern, without those that are being written, or were when
    their process was killed.
    """
    return sorted(path for path in Path(folder).glob(pattern) if not path.name.startswith(PART))


def remove(paths, what):
    """Removes files, where they are there; ``what`` they are, for the message. Raises WriteError."""
    for path in paths:
        try:
            path.unlink(missing_ok=True)
        except OSError as error:
            raise WriteError(
                f"{path}: {what}, and cannot be removed ({error.strerror}); remove it, or give another folder"
            ) from None


def remove_parts(*folders):
    """Removes what killed processes left half-written in the folders; other processes must not be writing there. Raises
    WriteError.
    """
    for folder in folders:
        for path in Path(folder).glob(f"{PART}*"):
            try:
                path.unlink(missing_ok=True)
            except OSError as error:
                raise WriteError(
                    f"{path}: left from a run that was killed, and cannot be removed ({error.strerror}); remove it"
                ) from None


def remove_parts_below(folder, held):
    """The same in the folder and all below it, but for hidden ones, and those with a file of the name ``held``: another
    process may be writing there.
    """
    for path, below, _ in os.walk(folder):
        below[:] = [name for name in below if not name.startswith(".") and not Path(path, name, held).exists()]
        remove_parts(path)


def list_of(folder):
    """Paths of all that is in a folder; none where it is not there. Raises OSError."""
    return [*Path(folder).iterdir()] if Path(folder).exists() else []


def empty(folder, *spared):
    """Removes all that is in a folder, but for what has one of the names ``spared``; a folder that is not there is
    empty. Raises OSError.
    """
    for path in list_of(folder):
        if path.name not in spared:
            shutil.rmtree(path) if path.is_dir() and not path.is_symlink() else path.unlink()


def sync_folder(folder):
    """Has the operating system put the names of files, as they are now, on the disk."""
    number = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(number)
    except OSError:
        pass  # some file systems cannot
    finally:
        os.close(number)


def write_atomically(path, content) -> None:
    """Write `content` (bytes, or any buffer of them) beside `path`, then rename, so that a reader never meets half a
    file. Raises WriteError.
    """
    try:
        with beside(path) as part, part.open("wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
    except OSError as error:
        raise WriteError(
            f"{path}: cannot be written ({error.strerror}); " "give a folder that can be written and has room"
        ) from None


def write_arrays(path, /, compressed=False, **arrays) -> None:
    """Writes arrays as .npz, see write_atomically; ``compressed``: smaller, and slower to write. Raises WriteError."""
    content = io.BytesIO()
    (np.savez_compressed if compressed else np.savez)(content, **arrays)
    write_atomically(path, content.getvalue())


def write_json(path, plain, **how) -> None:
    """Writes plain data as JSON, one value a line, see write_atomically; ``how``: of json.dumps. Raises WriteError, and
    TypeError where JSON cannot hold the data.
    """
    write_atomically(path, (json.dumps(plain, indent=1, **how) + "\n").encode())
