"""Release of pore pressure by local dilatancy in a slope's run: looked at at each row, from failure on.

The rules stand in :mod:`.course.dilatancy`, the measure in :mod:`.measure.local_packing`. The shares act in the engine,
which keeps them by body and is saved with the scene; what a run needs besides, of each disk at failure and since, goes
into its checkpoints.
"""

from __future__ import annotations

import math

import numpy as np

from yade import O

from ...course import dilatancy
from ...measure import local_packing
from ...world import pore_pressure, tables

__all__ = ["WaterRelease"]

LEFT = 1e-3  # released share that may still come back, below which nothing is left to come


class WaterRelease:
    """Of a built :class:`~nonsmooth.studies.slope.slope.Slope` whose section releases water by dilatancy; ``told``: of
    a checkpoint, see :meth:`content`.
    """

    def __init__(self, built, told=None):
        self.slope, self.rule = built, built.section.water.release
        diameter = math.sqrt(built.section.disks.mean_square)
        self.reach, self.void = self.rule.over * diameter, local_packing.VOID * diameter
        self.time = self.failed = self.largest = None
        if told is not None:
            self.time, self.largest = told["time"], np.array(told["largest"])
            self.failed = local_packing.Cells(np.array(told["area"]), np.array(told["solid"]))

    @property
    def relaxes(self):
        """Whether released pressure is still coming back."""
        if self.rule.drainage_time is None or self.time is None:
            return False
        return bool((self._shares() > LEFT).any())

    def look(self, disks, failed):
        """Notes the packing where the mass has ``failed``, and sets what is released from then on; ``disks``: table of
        the slope's disks (:func:`.tables.bodies`).
        """
        if self.time is None and not failed:
            return
        number = disks["id"] - self.slope.first_disk
        x, y, r = disks["x"], disks["y"], disks["r"]
        found = local_packing.cells(x, y, r, self.void)
        if self.time is None:
            count = self.slope.count
            self.time, self.largest = O.time, np.zeros(count)
            self.failed = local_packing.Cells(np.zeros(count), np.zeros(count))
            self.failed.area[number], self.failed.solid[number] = found.area, found.solid
            return
        then = local_packing.Cells(self.failed.area[number], self.failed.solid[number])
        now = dilatancy.dilation(*local_packing.area_shares(x, y, self.reach, found, then))
        shares, seconds = self._shares(), O.time - self.time
        shares[number], self.largest[number] = dilatancy.released(
            shares[number], self.largest[number], now, self.rule.dilation, seconds, self.rule.drainage_time
        )
        pore_pressure.release(self.slope.water, self.slope.first_disk, shares)
        self.time = O.time

    def content(self):
        """What a checkpoint keeps, as JSON has it; None before failure."""
        if self.time is None:
            return None
        lists = {"largest": self.largest, "area": self.failed.area, "solid": self.failed.solid}
        return {"time": self.time, **{name: values.tolist() for name, values in lists.items()}}

    def _shares(self):
        return tables.released_shares(self.slope.water, self.slope.first_disk, self.slope.count)
