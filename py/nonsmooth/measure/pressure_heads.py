"""Pressure heads of a field of water on the slip surfaces of a section: what a piezometer there would read. Needs no
YADE.
"""

from __future__ import annotations

import numpy as np

from ..model import geometry
from ..water.fields import state_at

__all__ = ["SlipHeads"]

SAMPLES = 400  # along all slip surfaces


class SlipHeads:
    """Heads p/γ_w [m] of a :class:`~nonsmooth.water.fields.MeshField` along the slip surfaces of a Section, where they
    run within its layers, half a smallest disk above them.
    """

    def __init__(self, field, section):
        start, end = geometry.pieces([np.asarray(line, float) for _, line in section.slip_surfaces])
        along = end - start
        length = geometry.distance(*along.T)
        counts = np.maximum(1, np.rint(SAMPLES * length / length.sum()).astype(int))
        share = np.concatenate([(np.arange(n) + 0.5) / n for n in counts])
        piece = np.repeat(np.arange(len(counts)), counts)
        up = np.column_stack((-along[:, 1], along[:, 0])) / length[:, None]  # the mass is on the left
        points = (start + 0.5 * section.smallest * up)[piece] + share[:, None] * along[piece]
        inside = np.zeros(len(points), bool)
        for polygon in geometry.parts(section.outline):
            inside |= geometry.contains(polygon, *points.T)
        where = field.mesh.locate(points)
        wet = inside & (where >= 0)
        heads = field.mesh.at(field.pressures, points[wet], where[wet]) / section.water.unit_weight
        self.times, self._heads = field.times, heads
        self._weights = (length / counts)[piece][wet]
        self._length = float((length / counts)[piece][inside].sum())

    def mean(self, time) -> float:
        """The mean head [m] at a ``time`` [s] since t0, of the whole length; 0 counts where it is dry."""
        first, share = state_at(self.times, time)
        heads = self._heads[first]
        if share:
            heads = heads + share * (self._heads[first + 1] - heads)
        return float((np.maximum(heads, 0) * self._weights).sum()) / self._length if self._length else 0.0
