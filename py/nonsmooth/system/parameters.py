"""Parameters of a script, as ``utils.readParamsFromTable`` has read them, checked before the scene is made::

    utils.readParamsFromTable(seconds=2, friction=0.5, **numerics)
    from yade.params import table
    parameters.positive(table, "seconds", "dt")
    parameters.not_negative(table, "friction")

Each check raises ParameterError, a ValueError, with the name, the value and what would do. Needs no YADE.
"""

from __future__ import annotations

from ..errors import UserError
from . import checks

__all__ = ["ParameterError", "not_negative", "one_of", "positive", "whole", "within"]


class ParameterError(UserError, ValueError):
    """A parameter of a script that makes no sense; one message with its name, its value and what would do."""


def positive(table, *names):
    """Raises ParameterError unless each of the parameters is a number above 0."""
    for name in names:
        checks.number(name, getattr(table, name), ParameterError, "give a number above 0", above=0)


def not_negative(table, *names):
    """Raises ParameterError unless each of the parameters is 0 or a number above."""
    for name in names:
        checks.number(name, getattr(table, name), ParameterError, "give 0 or a number above", least=0)


def within(table, low, high, *names):
    """Raises ParameterError unless each of the parameters is a number from ``low`` to ``high``."""
    for name in names:
        remedy = f"give a number from {low:g} to {high:g}"
        checks.number(name, getattr(table, name), ParameterError, remedy, least=low, most=high)


def whole(table, *names, least=1):
    """Raises ParameterError unless each of the parameters is a whole number from ``least``."""
    for name in names:
        checks.count(name, getattr(table, name), ParameterError, f"give a whole number from {least}", least=least)


def one_of(table, values, *names):
    """Raises ParameterError unless each of the parameters is one of the ``values``."""
    for name in names:
        value = getattr(table, name)
        if value not in values:
            known = ", ".join(map(str, values))
            raise ParameterError(f"{name} {checks.shown(value)}: give one of {known}")
