"""The bonds that broke in a run, ``breaks.csv``."""

from pathlib import Path

import numpy as np

from ..system import checks
from ..system.whole_files import write_atomically
from . import given
from .error import RecordsError

__all__ = ["BREAK_COLUMNS", "BREAK_MODES", "read_breaks", "write_breaks"]

NAMES = ("step", "time", "id1", "id2", "mode", "x", "y")  # of tables.breaks
#: How a bond broke, by NscdPhys.brokenMode.
BREAK_MODES = ("none", "tension", "shear", "torque", "mixed")
BREAK_COLUMNS = ("step", "time_s", "disk1", "disk2", "mode", "x_m", "y_m")


@given.takes(
    breaks=checks.holds("step time id1 id2 mode x y", "give broken bonds, as tables.breaks(engine) returns them")
)
def write_breaks(path, breaks, first_disk=0):
    """Write broken bonds, as :func:`yade.nonsmooth.tables.breaks` gives them, as CSV with the columns BREAK_COLUMNS.

    ``disk1`` is empty where the bond was one to a wall; ``mode`` is tension, shear, torque or mixed. The file is
    written beside and renamed.
    """
    checks.count("first_disk", first_disk, RecordsError, "give the id of disk 0, a whole number from 0", least=0)
    _check(breaks, first_disk)
    lines = [",".join(BREAK_COLUMNS)]
    for step, time, a, b, mode, x, y in zip(*(np.asarray(breaks[name]).tolist() for name in NAMES)):
        one = "" if a < first_disk else a - first_disk
        lines.append(f"{step},{time!r},{one},{b - first_disk},{BREAK_MODES[mode]},{x!r},{y!r}")
    write_atomically(Path(path), ("\n".join(lines) + "\n").encode())


def _check(breaks, first_disk):
    """Raises RecordsError for columns that are no broken bonds of disks from ``first_disk`` on."""
    columns = {name: np.asarray(breaks[name]) for name in NAMES}
    for name, values in columns.items():
        if values.shape != (np.size(columns["step"]),):
            raise RecordsError(
                f"breaks: {name} has shape {values.shape} and step {columns['step'].shape}; give flat arrays of one length"
            )
        whole = name in ("step", "id1", "id2", "mode")
        if len(values) and (values.dtype.kind not in ("iu" if whole else "iuf") or not np.isfinite(values).all()):
            raise RecordsError(
                f"breaks: {name} {checks.shown(values.tolist())}: give {'whole' if whole else 'finite'} numbers, as tables.breaks(engine) has them"
            )
    if len(columns["step"]) and not (1 <= columns["mode"].min() and columns["mode"].max() < len(BREAK_MODES)):
        raise RecordsError(
            f"breaks: mode {checks.shown(columns['mode'].tolist())}: give numbers of tables.BREAK_MODES from 1, {', '.join(BREAK_MODES[1:])}"
        )
    if (columns["id2"] < first_disk).any():
        raise RecordsError(
            f"first_disk {first_disk}: a bond broke between bodies {int(columns['id1'].min())} and {int(columns['id2'].min())}, before it; give the id of the first disk"
        )


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
