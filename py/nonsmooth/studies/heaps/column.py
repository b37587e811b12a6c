"""Collapse of a column of grains on a plane (Lube et al. 2005; Staron and Hinch 2005; Balmforth and Kerswell 2005), in
two dimensions.

Disks rest between a wall at x = 0, which stays, and a gate at x = L₀, which is taken away at once. The column of height
H₀ = a L₀ falls and spreads to the front L_f. The wall has no friction unless asked for, so it may also be read as the
plane of symmetry of a column that is 2 L₀ wide and falls to both sides.
"""

from __future__ import annotations

from dataclasses import dataclass

from .grains import Heap
from .in_yade import __getattr__  # noqa: F401

__all__ = ["Column", "GranularColumn", "build", "run"]


@dataclass(frozen=True)
class GranularColumn(Heap):
    """A column before its collapse.

    ``aspect``: a = H₀/L₀ of the box that is filled; the column settles by some per cent, and its own aspect ratio is
    measured then. The other parameters are those of :class:`~yade.nonsmooth.heaps.grains.Heap`.
    """

    aspect: float = 2.0

    KIND, ASPECT = "Column", "height over width of the column"

    def place(self):
        """The wall stands at x = 0."""
        return 0.0

    def gates(self):
        """The right side is taken away."""
        return ("right",)


Column = GranularColumn  # its name for scripts and notebooks
