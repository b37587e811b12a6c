"""What is raised for a slope's run that cannot begin or go on."""

from ...errors import UserError

__all__ = ["ArgumentError", "EndError", "ExperimentError"]


class ExperimentError(UserError, RuntimeError):
    """The run cannot go on; the message says why and what helps."""


class ArgumentError(ExperimentError, ValueError):
    """What an experiment cannot be made of; nothing has been written then."""


class EndError(ExperimentError, ValueError):
    """An end of a run that is no time to come; nothing has been done then, and the run can go on with another."""
