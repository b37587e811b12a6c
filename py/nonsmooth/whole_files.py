"""Files that are whole or not there: written beside, then renamed."""

from __future__ import annotations

import contextlib
import io
import os
import tempfile
from pathlib import Path

import numpy as np

from .errors import UserError

__all__ = ["WriteError", "write_arrays", "write_atomically"]


class WriteError(UserError, OSError):
    """A file that cannot be written; the message says which, why and what helps."""


def write_atomically(path, content: bytes) -> None:
    """Write beside `path`, then rename, so that a reader never meets half a file. Raises WriteError."""
    path = Path(path)
    beside = None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=path.parent, prefix=f".{path.name}.", delete=False) as file:
            beside = file.name
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(beside, 0o666 & ~umask)
        os.replace(beside, path)
    except OSError as error:
        if beside:
            with contextlib.suppress(OSError):
                os.unlink(beside)
        raise WriteError(f"{path}: cannot be written ({error.strerror}); "
                           "give a folder that can be written and has room") from None


def write_arrays(path, /, compressed=False, **arrays) -> None:
    """Writes arrays as .npz, see write_atomically; ``compressed``: smaller, and slower to write. Raises WriteError."""
    content = io.BytesIO()
    (np.savez_compressed if compressed else np.savez)(content, **arrays)
    write_atomically(path, content.getvalue())
