"""Text files that somebody else may have written, read whole: one sentence for what cannot be read. Needs no YADE."""

from __future__ import annotations

import os
import stat
from pathlib import Path

__all__ = ["read_lines"]


def read_lines(path, most, error, wanted):
    """The lines of a UTF-8 file, with or without a byte order mark, and with the ends of lines of any system, as a
    list. ``most``: bytes that it may have; ``wanted``: what kind of file was asked for, in words.

    Raises ``error`` for a file that is missing or unreadable, has no end, more bytes or others than text.
    """
    path = Path(path)
    try:
        with path.open("rb") as file:
            found = os.fstat(file.fileno())
            endless = stat.S_ISCHR(found.st_mode) or found.st_size > most
            raw = b"" if endless else file.read()
    except (OSError, ValueError) as wrong:  # ValueError: a zero in the name
        raise error(f"{path}: cannot be read ({getattr(wrong, 'strerror', None) or wrong}); give {wanted}") from None
    if endless:
        raise error(f"{path}: has no end, or more than {most} bytes; give {wanted}")
    try:
        return raw.decode("utf-8-sig").splitlines()
    except UnicodeDecodeError as wrong:
        raise error(f"{path}: byte {wrong.start} is no text; give {wanted}") from None
