"""The motion of the ground in an earthquake as plain, checked data: read from a PEER .AT2 or a CSV file, given as
arrays, or made up (:mod:`.synthetic`). Needs no YADE.

`read` (a file) and `GroundMotion` (arrays) give a motion or raise `GroundMotionError` with one message that names the
file, the line, the value and the remedy. Accelerations are those of the ground in m/s², x to the right, y up. Nothing
is filtered, shifted, resampled or corrected but by a call that says so; what the ground has left of velocity and
displacement at the end is told (`GroundMotion.drift`, `GroundMotion.describe`).
"""

from .motion import BASELINES, Drift, GroundMotion, GroundMotionError
from .reading import UNITS, read
from .writing import write_csv

__all__ = ["BASELINES", "Drift", "GroundMotion", "GroundMotionError", "UNITS", "read", "write_csv"]
