"""Which share of the pore pressure local dilatancy has released: functions of numbers alone. Needs no YADE.

Taboada and Estrada (2009) release a disk from water by its way downslope, and name the dilatancy around it as the
better criterion (section 5.4, paragraph 113). The rules here:

* the mass fails where the course says that it moves (:mod:`yade.nonsmooth.course.slope`). What was dilated before is no
  part of it;
* the dilation around a disk is 1 - φ/φ₀: the area share φ of the disks around it, by that of the same disks when the
  mass failed (:mod:`..measure.local_packing`). A disk that stands alone, then or now, has no pores around it that could
  bear pressure: its dilation is 1;
* it releases the share (1 - φ/φ₀)/ε of the pressure, from 0 to 1, where ε is the dilation that releases all of it;
* released is released: where the mass gets denser again, the pressure does not come back. With a drainage time T water
  flows into the wider pores, and what is released falls as exp(-t/T), while new dilation, beyond the largest that there
  was, adds to it. So an endless T is the first rule, and a short one releases nothing.
"""

from __future__ import annotations

import math

import numpy as np

__all__ = ["dilation", "released"]


def dilation(share, at_failure):
    """1 - φ/φ₀ around each disk, of shape (n,), by its area shares now and at failure; 1 where one of them is 0."""
    return 1 - np.divide(share, at_failure, out=np.zeros(len(share)), where=at_failure > 0)


def released(before, largest, now, whole, seconds=0.0, drainage_time=None):
    """The released shares of the pressure, and the largest dilations until now, both of shape (n,).

    ``before``, ``largest``: the same of the last look, ``seconds`` ago; ``now``: the :func:`dilation`; ``whole``: ε;
    ``drainage_time`` T [s], None: endless.
    """
    new = np.clip(np.maximum(largest, now) / whole, 0, 1)
    if drainage_time is None:
        return np.maximum(before, new), np.maximum(largest, now)
    added = new - np.clip(largest / whole, 0, 1)
    return np.minimum(before * math.exp(-seconds / drainage_time) + added, 1.0), np.maximum(largest, now)
