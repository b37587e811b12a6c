"""What is raised for water that cannot be computed, read or written."""

from ..errors import UserError

__all__ = ["WaterError"]


class WaterError(UserError):
    """A mesh, a condition, a field or a file of water cannot be used; the message says which, why and what would do."""
