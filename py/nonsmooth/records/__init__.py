"""Records of a run: the time series (``series.csv``, ``walls.csv``), cells along walls (``slip_surface.csv``,
``slip_surface.h5``), the bonds that broke (``breaks.csv``) and the snapshots (``.npz``).

All can be read and written without YADE. All quantities are in SI units, forces and energies per metre of
thickness (the model is two-dimensional). A study declares the columns of its series; an opened run says what they are
(``runs.open_run(folder).columns``). Every failure is a :class:`RecordsError` that names the file, what is wrong with it
and what to do.
"""

from .breaks import BREAK_COLUMNS, read_breaks, write_breaks
from .columns import LOSSES, OWN, Column, column, declared, own_columns, stem
from .error import RecordsError
from .series import SeriesWriter, broken_bonds, kept, read_eroded, read_series, read_surfaces, read_walls, since_settled
from .snapshots import Snapshot, in_both, read_snapshot, write_snapshot
from .surfaces import read_surface_arrays, since_set_back, surface_arrays, write_surface_arrays

__all__ = [
    "BREAK_COLUMNS",
    "LOSSES",
    "OWN",
    "Column",
    "RecordsError",
    "SeriesWriter",
    "Snapshot",
    "broken_bonds",
    "column",
    "declared",
    "in_both",
    "kept",
    "own_columns",
    "read_breaks",
    "read_eroded",
    "read_series",
    "read_snapshot",
    "read_surface_arrays",
    "read_surfaces",
    "read_walls",
    "since_set_back",
    "since_settled",
    "stem",
    "surface_arrays",
    "write_breaks",
    "write_snapshot",
    "write_surface_arrays",
]
