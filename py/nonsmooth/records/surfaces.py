"""What slip laws have found in cells along walls, as arrays in time and space: from ``slip_surface.csv``, a row for each
cell and time, or from ``slip_surface.h5``, which a run leaves at its end.

The HDF5 file has a group for each wall, with its name (``/`` and ``%`` in it as in addresses of the web, ``%2F`` and
``%25``), and in it a dataset for each column: ``step`` and ``time_s`` (t,), :data:`PLACES` (c,), all others (t, c). Each
has its ``unit`` and its ``meaning`` as attributes. A column of which a wall's law knows nothing has no dataset there.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from urllib.parse import unquote

import numpy as np

from ..system import checks
from ..system.whole_files import WriteError, beside
from . import given
from .error import RecordsError
from .series import read_surfaces

__all__ = ["PLACES", "TIMES", "read_surface_arrays", "since_set_back", "surface_arrays", "write_surface_arrays"]

#: Columns that say where a cell lies, at the first time; a wall that a script moves has others later, which
#: ``slip_surface.csv`` has.
PLACES = ("x_m", "y_m", "length_m")
TIMES = ("step", "time_s")  # columns of a time
HDF5 = (".h5", ".hdf5")
_CELLS = checks.holds("wall cell time_s", "give columns of slip_surface.csv, as run.slip_surface")
_COLUMNS = checks.kind(Mapping, "give what the columns are, {name: Column}")


@checks.takes(RecordsError, cells=_CELLS)
def surface_arrays(cells) -> dict:
    """Columns of ``slip_surface.csv`` (:func:`.series.read_surfaces`) by walls: {wall: {column: array}}, ``step`` and
    ``time_s`` (t,), :data:`PLACES` (c,), all others (t, c) for t times and c cells; without the columns of which a
    wall's law knows nothing.

    A last time at which a wall has not all of its cells, as where a run was killed, is left out there. Raises
    RecordsError where a wall has other cells at another time.
    """
    return {wall: _of_wall(cells, wall) for wall in dict.fromkeys(np.asarray(cells["wall"]).tolist())}


def _of_wall(cells, wall):
    mine = np.flatnonzero(np.asarray(cells["wall"]) == wall)
    time = cells["time_s"][mine]
    count = int(np.sum(time == time[0]))
    times = len(mine) // count
    mine = mine[: times * count]
    time, number = (np.reshape(cells[name][mine], (times, count)) for name in ("time_s", "cell"))
    if not (np.array_equal(number, np.broadcast_to(np.arange(count), number.shape)) and (time == time[:, :1]).all()):
        raise RecordsError(
            f"the wall {wall} has not the same cells at all times in slip_surface.csv; give all rows of one run"
        )
    found = {}
    for name, values in cells.items():
        if name in ("wall", "cell"):
            continue
        table = values[mine].reshape(times, count)
        if not np.isnan(table).all():
            found[name] = table[:, 0] if name in TIMES else table[0] if name in PLACES else table
    return found


def read_surface_arrays(path) -> dict:
    """:func:`surface_arrays` of a run, from its ``slip_surface.csv``, or from its ``slip_surface.h5``, by the suffix
    (.h5, .hdf5): the same bits, of walls in alphabetical order. Raises RecordsError for a file that cannot be read as
    one of both.
    """
    path = Path(checks.path("path", path, RecordsError, "give the path of slip_surface.csv or slip_surface.h5"))
    if path.suffix.lower() not in HDF5:
        return surface_arrays(read_surfaces(path))
    import h5py

    try:
        with h5py.File(path, "r") as file:
            walls = dict(file)
            found = {unquote(name): {key: one[()] for key, one in walls[name].items()} for name in walls}
        if not all({"time_s", *PLACES} <= {*one} for one in found.values()):
            raise ValueError("no time_s, x_m, y_m and length_m in each group")
    except (OSError, RuntimeError, KeyError, ValueError, TypeError, AttributeError) as error:
        # whatever h5py meets in other files
        raise RecordsError(
            f"{path}: cannot be read as the cells of walls with slip laws ({' '.join(str(error).split())}); check the "
            "folder given, or read slip_surface.csv beside it"
        ) from None
    return found


@given.takes(surfaces=given.surfaces("time_s x_m y_m length_m"), columns=_COLUMNS)
def write_surface_arrays(surfaces, path, columns):
    """Writes :func:`surface_arrays` as HDF5, see above, whole or not at all; returns the path. ``columns``: what they
    are, {name: Column}. Equal arrays give equal bytes. Raises WriteError.
    """
    import h5py

    path = Path(path)
    try:
        with beside(path) as part, h5py.File(part, "w") as file:
            for wall, arrays in surfaces.items():
                group = file.create_group(_group(wall))
                for name, values in arrays.items():
                    made = group.create_dataset(name, data=values, track_times=False)
                    made.attrs.update(unit=columns[name].unit, meaning=columns[name].meaning)
    except OSError as error:
        raise WriteError(
            f"{path}: cannot be written ({error.strerror or error}); give a folder that can be written and has room"
        ) from None
    return path


def _group(wall):
    """The name of a wall's group: HDF5 takes ``/`` for a group in a group, and ``.`` for the group itself."""
    name = wall.replace("%", "%25").replace("/", "%2F")
    return "%2E" if name == "." else name


@checks.takes(RecordsError, surfaces=given.surfaces("time_s slip_m"))
def since_set_back(surfaces) -> dict:
    """:func:`surface_arrays` from the time on at which slip was last set back, as when a slope has settled; all where
    it never was.
    """
    falls = [
        float(one["time_s"][1:][(np.diff(one["slip_m"], axis=0) < 0).any(axis=1)].max(initial=-np.inf))
        for one in surfaces.values()
    ]
    begin = max(falls, default=-np.inf)
    return {
        wall: {name: values if name in PLACES else values[one["time_s"] >= begin] for name, values in one.items()}
        for wall, one in surfaces.items()
    }
