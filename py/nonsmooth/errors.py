"""The base of errors that a user can mend: scripts print their message alone, one line, and no traceback."""

__all__ = ["UserError"]


class UserError(Exception):
    """Bad input, a file or folder that cannot be used, a run that cannot go on; the message names what is wrong and what helps."""
