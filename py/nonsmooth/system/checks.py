"""What functions ask of the arguments that they are given: each check raises the caller's own error, in one sentence
with the argument's name, its value and what would do. Needs no YADE.
"""

from __future__ import annotations

import functools
import inspect
import math
import numbers
import os
from collections.abc import Mapping

__all__ = ["count", "has", "holds", "kind", "mapping", "number", "numbers_of", "path", "real", "shown", "takes", "text"]

LONGEST, END = 60, 24  # characters of a value in a message, and of its end


def shown(value):
    """A value as a message shows it, on one line; where it is long its beginning and its end, as of a path."""
    told = " ".join(repr(value).split())
    return told if len(told) <= LONGEST else f"{told[:LONGEST - END]}…{told[-END:]}"


def number(name, value, error, remedy, above=-math.inf, least=-math.inf, most=math.inf, below=math.inf):
    """The ``value`` as a float, finite, ``above`` and ``below`` these, from ``least`` to ``most``; raises ``error``
    with "NAME VALUE: REMEDY" where it is not. A boolean is no number.
    """
    real = isinstance(value, numbers.Real) and not isinstance(value, bool)
    found = float(value) if real else math.nan  # which no bound lets through, as infinity
    if not (above < found < below and least <= found <= most):
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


def mapping(name, value, error, remedy):
    """The ``value``, a dictionary of one item or more whose keys are texts; raises ``error`` for anything else."""
    if not (isinstance(value, Mapping) and value and all(isinstance(key, str) for key in value)):
        raise error(f"{name} {shown(value)}: {remedy}")
    return value


def numbers_of(name, value, error, remedy, least=1, most=math.inf):
    """The ``value``, a list, tuple, array or YADE vector, as a tuple of finite floats, from ``least`` to ``most`` of
    them; raises ``error`` for anything else.
    """
    try:
        found = () if isinstance(value, (str, bytes)) else tuple(float(v) for v in value)
    except (TypeError, ValueError):
        found = ()
    if not (least <= len(found) <= most and all(map(math.isfinite, found))):
        raise error(f"{name} {shown(value)}: {remedy}")
    return found


def kind(kinds, remedy):
    """A rule of :func:`takes`: the argument is one of these classes."""
    return lambda value: isinstance(value, kinds), remedy


def has(names, remedy):
    """A rule of :func:`takes`: the argument has attributes with these ``names``, words in a text."""
    return lambda value: all(hasattr(value, name) for name in names.split()), remedy


def holds(names, remedy):
    """A rule of :func:`takes`: the argument is a dictionary that has these ``names``, words in a text."""
    return lambda value: isinstance(value, Mapping) and all(name in value for name in names.split()), remedy


def real(remedy):
    """A rule of :func:`takes`: the argument is a finite number."""
    return lambda value: isinstance(value, numbers.Real) and math.isfinite(value), remedy


def takes(error, **rules):
    """A decorator: the function raises ``error``, and does nothing else, where an argument that has been given breaks
    its rule: {argument: (function of a value, remedy)}.
    """

    def decorate(function):
        signature = inspect.signature(function)

        @functools.wraps(function)
        def checked(*given, **named):
            try:
                bound = signature.bind(*given, **named).arguments
            except TypeError:  # one is missing, or one too many: Python says which
                return function(*given, **named)
            for name, (fits, remedy) in rules.items():
                if name in bound and not fits(bound[name]):
                    raise error(f"{name} {shown(bound[name])}: {remedy}")
            return function(*given, **named)

        return checked

    return decorate


def text(name, value, error, remedy):
    """The ``value``, a text; raises ``error`` for anything else."""
    if not isinstance(value, str):
        raise error(f"{name} {shown(value)}: {remedy}")
    return value
