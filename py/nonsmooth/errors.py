"""The bases of errors that a user can mend, and of warnings: scripts print their message alone, one line, and no traceback."""

__all__ = ["OldNameWarning", "UserError"]


class UserError(Exception):
    """Bad input, a file or folder that cannot be used, a run that cannot go on; the message names what is wrong and what helps."""


class OldNameWarning(FutureWarning):
    """An old name that is still read; the message says where it stands and what to write instead."""
