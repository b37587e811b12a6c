"""Where the spheres of a scene are at one instant, in memory and as .npz. Needs no YADE."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...system.whole_files import whole, write_arrays
from .grains import SpheresError

__all__ = ["Places", "read", "read_all", "write"]


@dataclass(frozen=True, eq=False)
class Places:
    """``at``: centres (n, 3) [m]; ``r``: radii (n,) [m]; ``number``: which of the spheres that a run began with each
    is, int (n,); ``speed``: (n,) [m/s]; ``time_s`` since the release [s], and ``step``.
    """

    at: np.ndarray
    r: np.ndarray
    number: np.ndarray
    speed: np.ndarray
    time_s: float = 0.0
    step: int = 0

    def __len__(self):
        return len(self.r)


def write(path, places):
    """Writes Places as ``path``, an .npz. Raises WriteError."""
    write_arrays(Path(path), **{name: np.asarray(value) for name, value in vars(places).items()})


def read(path):
    """The Places of a file. Raises SpheresError where there are none, or they cannot be read."""
    try:
        with np.load(path) as arrays:
            found = dict(arrays)
        return Places(**{name: value if value.ndim else value.item() for name, value in found.items()})
    except (OSError, ValueError, TypeError, KeyError) as error:
        raise SpheresError(f"{path}: holds no places of spheres ({error}); run it again") from None


def read_all(folder):
    """The Places of a run's folder in the order of time, the end last. Raises SpheresError where there are none."""
    found = [read(path) for path in whole(Path(folder) / "snapshots", "*.npz")]
    if not found:
        raise SpheresError(f"{folder}: has no snapshots, as runs that have not ended; run it again")
    return found
