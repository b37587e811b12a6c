"""The way of a mass's centre."""

from __future__ import annotations

__all__ = ["path"]


def path(series):
    """Places x and y [m] of the mass's centre in each row of a slope's ``series``, two arrays (rows,), without the
    jumps that it makes where disks are taken out of the mass: the way of what is left.
    """
    x, y = series["centroid_x_m"], series["centroid_y_m"]
    if "eroded_shift_x_m" not in series:
        return x, y
    return x - series["eroded_shift_x_m"], y - series["eroded_shift_y_m"]
