"""What cannot be made rigid."""

from ...errors import UserError

__all__ = ["HardenError"]


class HardenError(UserError, RuntimeError):
    """A part of a scene that rigid contacts have no counterpart for; the message names its class and what would do."""
