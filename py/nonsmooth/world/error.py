"""What is raised for what a scene cannot be made of."""

from ..errors import UserError

__all__ = ["SceneError"]


class SceneError(UserError, ValueError):
    """What no body, material or engine can be made of; the message names it and says what would do."""
