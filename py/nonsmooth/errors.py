"""The bases of errors that a user can mend, and of warnings: scripts print their message alone, one line, and no
traceback.
"""

__all__ = ["OldNameWarning", "UserError", "UserNote"]


class UserError(Exception):
    """Bad input, a file or folder that cannot be used, a run that cannot go on; the message names what is wrong and
    what helps.
    """

    def _render_traceback_(self):
        """What IPython shows in place of a traceback, by its own name: in a notebook the message stands alone too."""
        return [f"{type(self).__name__}: {self}"]


class UserNote(UserWarning):
    """What a user should know of a command that goes on; scripts print the message on one line."""


class OldNameWarning(UserNote, FutureWarning):
    """An old name that is still read; the message says where it stands and what to write instead."""
