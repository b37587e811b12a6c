"""The bonds that broke in a run, ``breaks.csv``."""

from pathlib import Path

import numpy as np

from ..tables import BREAK_MODES
from ..whole_files import write_atomically
from .. import checks
from . import given
from .error import RecordsError

BREAK_COLUMNS = ("step", "time_s", "disk1", "disk2", "mode", "x_m", "y_m")


@given.takes(
    breaks=given.columns("step time id1 id2 mode x y", "give broken bonds, as tables.breaks(engine) returns them")
)
def write_breaks(path, breaks, first_disk=0):
    """Write broken bonds, as :func:`yade.nonsmooth.tables.breaks` gives them, as CSV with the columns BREAK_COLUMNS.

    ``disk1`` is empty where the bond was one to a wall; ``mode`` is tension, shear, torque or mixed. The file is written beside and renamed.
    """
    lines = [",".join(BREAK_COLUMNS)]
    for step, time, a, b, mode, x, y in zip(
        *(breaks[name].tolist() for name in ("step", "time", "id1", "id2", "mode", "x", "y"))
    ):
        one = "" if a < first_disk else a - first_disk
        lines.append(f"{step},{time!r},{one},{b - first_disk},{BREAK_MODES[mode]},{x!r},{y!r}")
    write_atomically(Path(path), ("\n".join(lines) + "\n").encode())


def read_breaks(path):
    """Broken bonds: dict of arrays of shape (n,) by BREAK_COLUMNS; ``disk1`` is −1 at a wall, ``mode`` holds words.

    Raises :class:`RecordsError` for a file that is missing or damaged.
    """
    path = Path(checks.path("path", path, RecordsError, "give the path of a file of a run"))
    try:
        header, *rows = path.read_text().splitlines()
        if tuple(header.split(",")) != BREAK_COLUMNS:
            raise ValueError("wrong columns")
        cells = [row.split(",") for row in rows]
        columns = list(zip(*cells, strict=True)) if cells else [()] * len(BREAK_COLUMNS)
        numbers = [np.array([float(c) if c else -1.0 for c in column]) for k, column in enumerate(columns) if k != 4]
    except (OSError, ValueError) as error:
        raise RecordsError(f"{path}: cannot be read as a list of broken bonds ({error})") from None
    step, time, one, two, x, y = numbers
    return dict(
        zip(
            BREAK_COLUMNS,
            (step.astype(int), time, one.astype(int), two.astype(int), np.array(columns[4], dtype=str), x, y),
        )
    )
