"""Motions of the ground as CSV files that :func:`.reading.read` reads back to the same bits."""

from __future__ import annotations

import numpy as np

from ...system import checks
from ...system.whole_files import write_atomically
from .motion import GroundMotion, GroundMotionError

__all__ = ["write_csv"]


def write_csv(motion, path) -> None:
    """Writes a GroundMotion as a CSV, whole or not at all; its name and source stand in comments. ``read(path,
    uneven=True)`` gives the same values.

    Raises GroundMotionError for what is no motion or no path, WriteError where the file cannot be written.
    """
    if not isinstance(motion, GroundMotion):
        raise GroundMotionError(
            f"motion {checks.shown(motion)}: give a GroundMotion, as ground_motion.read(file) returns one"
        )
    path = checks.path("path", path, GroundMotionError, "give the path of the file to write")
    lines = [f"# {' '.join(text.split())}" for text in (motion.name, motion.source)]
    lines.append("time_s,horizontal_m_per_s2,vertical_m_per_s2")
    rows = np.column_stack((motion.times, motion.horizontal, motion.vertical)).tolist()
    lines += [",".join(map(repr, row)) for row in rows]
    write_atomically(path, ("\n".join(lines) + "\n").encode())
