"""What functions ask of the arguments that they are given: each check raises the caller's own error, in one sentence with the argument's name, its value and what would do. Needs no YADE."""

from __future__ import annotations

import math
import numbers
import os

__all__ = ["count", "number", "path", "shown", "text"]

LONGEST = 60  # characters of a value in a message


def shown(value):
    """A value as a message shows it, on one line and cut where it is long."""
    told = " ".join(repr(value).split())
    return told if len(told) <= LONGEST else f"{told[:LONGEST]}…"


def number(name, value, error, remedy, above=-math.inf, least=-math.inf, most=math.inf, below=math.inf):
    """The ``value`` as a float, finite, ``above`` and ``below`` these, from ``least`` to ``most``; raises ``error`` with "NAME VALUE: REMEDY" where it is not. A boolean is no number."""
    real = isinstance(value, numbers.Real) and not isinstance(value, bool)
    found = float(value) if real else math.nan
    if not (math.isfinite(found) and above < found < below and least <= found <= most):
        raise error(f"{name} {shown(value)}: {remedy}")
    return found


def count(name, value, error, remedy, least=1, most=math.inf):
    """The ``value`` as an int from ``least`` to ``most``; raises ``error`` as :func:`number`."""
    whole = isinstance(value, numbers.Integral) and not isinstance(value, bool)
    if not (whole and least <= value <= most):
        raise error(f"{name} {shown(value)}: {remedy}")
    return int(value)


def path(name, value, error, remedy):
    """The ``value``, a text or a path; raises ``error`` for what names no file or folder."""
    if not isinstance(value, (str, os.PathLike)) or not os.fspath(value):
        raise error(f"{name} {shown(value)}: {remedy}")
    return value


def text(name, value, error, remedy):
    """The ``value``, a text; raises ``error`` for anything else."""
    if not isinstance(value, str):
        raise error(f"{name} {shown(value)}: {remedy}")
    return value
