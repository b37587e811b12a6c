"""What is raised for records that cannot be written or read."""

from ..errors import UserError

__all__ = ["RecordsError"]


class RecordsError(UserError):
    """A record cannot be written or read; the message says which file, what is wrong and the remedy."""
