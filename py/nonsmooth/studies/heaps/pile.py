"""A pile: disks rest in a box, both its sides are taken away at once, and what is left stands at its angle of repose.

The angle is that of a collapse, which moves and so comes to rest flatter than a pile that is poured grain by grain.
"""

from __future__ import annotations

from dataclasses import dataclass

from .grains import Heap
from .in_yade import __getattr__  # noqa: F401

__all__ = ["Pile", "build", "run"]


@dataclass(frozen=True)
class Pile(Heap):
    """A pile before its sides are taken away.

    ``aspect``: height over half of the width of the box; above some 0.7 all of the top is lost, so that the flanks
    meet. The other parameters are those of :class:`~yade.nonsmooth.heaps.grains.Heap`.
    """

    disks: int = 500
    aspect: float = 1.0

    KIND, ASPECT = "Pile", "height over half of the width of the box"

    def box_aspect(self):
        """Height over width of the box."""
        return 0.5 * self.aspect

    def place(self):
        """The box has its middle at x = 0."""
        return -0.5 * self.box()[0]

    def gates(self):
        """Both sides are taken away."""
        return ("left", "right")
