"""Records of a run: the time series (``series.csv``) and the snapshots (``.npz``).

Both can be read and written without YADE. All quantities are in SI units, forces and energies per metre of
thickness (the model is two-dimensional). Every failure is a :class:`RecordsError` that names the file, what is
wrong with it and what to do.
"""

import csv
import hashlib
import math
import os
import zipfile
import zlib
from dataclasses import dataclass, fields
from pathlib import Path
from typing import NamedTuple, Optional

import numpy as np

from .errors import UserError
from .whole_files import write_arrays, write_atomically
from .tables import BREAK_MODES


class RecordsError(UserError):
    """A record cannot be written or read; the message says which file, what is wrong and the remedy."""


class Column(NamedTuple):
    """What a column of the series means."""

    unit: str
    description: str
    integer: bool = False


def _count(description):
    return Column("1", description, True)


#: The known columns: name -> (unit, description, integer). A series may hold others; these are documented.
COLUMNS = {
    "step": _count("number of the time step, strictly increasing"),
    "time_s": Column("s", "simulated time"),
    "stage": _count("stage of the run in the step: 0 settling, 1 dry rest, 2 water or avalanche"),
    "water_m": Column("m", "height of the water table above its plane (DP), h_w"),
    "dp_normal_total_N_per_m": Column(
        "N/m", "total normal force on the slip surfaces (DP), N_DP = N'_DP + U_DP, mean over the row"
    ),
    "dp_normal_effective_N_per_m": Column(
        "N/m", "effective (contact) normal force on the slip surfaces, N'_DP, mean over the row"
    ),
    "dp_water_N_per_m": Column("N/m", "force of the pore water normal to its plane, U_DP"),
    "dp_shear_N_per_m": Column(
        "N/m",
        "shear force on the slip surfaces, T_DP, mean over the row; positive when the wall resists downslope motion",
    ),
    "fb_normal_N_per_m": Column("N/m", "normal force on the backstops (FB), N'_FB, mean over the row; 0 without one"),
    "fb_shear_N_per_m": Column("N/m", "shear force on the backstops, mean over the row"),
    "ss_normal_N_per_m": Column("N/m", "normal force on the walls that are ground (SS), mean over the row"),
    "ss_shear_N_per_m": Column("N/m", "shear force on the walls that are ground, mean over the row"),
    "dp_normal_peak_N_per_m": Column("N/m", "largest effective normal force on the slip surfaces in a step of the row"),
    "fb_normal_peak_N_per_m": Column("N/m", "largest normal force on the backstops in a step of the row"),
    "ss_normal_peak_N_per_m": Column("N/m", "largest normal force on the walls that are ground in a step of the row"),
    "wet_disks": _count("disks that feel pore pressure"),
    "released_disks": _count("disks that were wet and whose pore pressure has been released for good"),
    "speed_mean_m_per_s": Column("m/s", "mean speed of the disks"),
    "speed_max_m_per_s": Column("m/s", "largest speed of a disk"),
    "front_m": Column("m", "position x of the front, in the direction in which the slope falls"),
    "centroid_x_m": Column("m", "centre of mass, x"),
    "centroid_y_m": Column("m", "centre of mass, y"),
    "bonds_alive": _count("cohesive bonds that hold"),
    "bonds_broken_tension": _count("bonds broken in tension so far"),
    "bonds_broken_shear": _count("bonds broken in shear so far"),
    "bonds_broken_torque": _count("bonds broken by rolling so far"),
    "bonds_broken_mixed": _count("bonds broken in several modes at once so far"),
    "contacts": _count("contacts, bonded ones included"),
    "slip_mean_dp_m": Column("m", "mean cumulated slip of the disks that touch slip surfaces which weaken"),
    "weakened_disks": _count("disks whose slip on one of them has passed the critical slip D_c"),
    "iterations": _count("sweeps of the contact solver in the step"),
    "residual": Column("1", "residual of the contact solver at the end of the step"),
    "residual_N_per_m": Column("N/m", "the same as a force: rms over contacts of what the reactions miss of the law"),
    "tolerance": Column("1", "residual that the step was to reach"),
    "overlap_worst_rel": Column("1", "largest overlap, in units of the mean diameter of the pair"),
    "overlap_mean_rel": Column("1", "mean overlap of the contacts, in the same units"),
    "energy_kinetic_J": Column("J/m", "kinetic energy"),
    "energy_potential_J": Column("J/m", "potential energy of gravity"),
    "energy_water_J": Column("J/m", "work done by the pore water"),
    "energy_walls_J": Column("J/m", "work done by walls whose motion is given"),
    "energy_sliding_J": Column("J/m", "energy dissipated by sliding"),
    "energy_rolling_J": Column("J/m", "energy dissipated by rolling"),
    "energy_impact_J": Column("J/m", "energy dissipated by impacts"),
    "energy_bonds_J": Column("J/m", "energy dissipated by pulling contacts apart against their adhesion"),
    "energy_correction_J": Column("J/m", "energy added by the correction of overlaps"),
    "energy_error_rel": Column(
        "1", "what the energy balance leaves over, relative; 0 while settling, as it begins then"
    ),
}


#: The columns of ``walls.csv``, a row for each wall and time: name -> (unit, description, integer). Empty where a wall has no such number.
WALL_COLUMNS = {
    "step": COLUMNS["step"],
    "time_s": COLUMNS["time_s"],
    "wall": Column("-", "name of the wall, of the interface, or of the layer that is an obstacle"),
    "normal_N_per_m": Column(
        "N/m",
        "normal force on the wall, into it positive, mean over the row; across an interface, pressing positive, or the horizontal push of the mass on an "
        "obstacle of disks, downslope positive, in the last step",
    ),
    "shear_N_per_m": Column(
        "N/m",
        "shear force on the wall, mean over the row, or across an interface in the last step; positive when it resists downslope motion; on an obstacle of disks "
        "the downward force",
    ),
    "normal_peak_N_per_m": Column("N/m", "largest normal force in a step of the row; between disks that of the last"),
    "slip_mean_m": Column(
        "m", "mean cumulated slip of the disks that have touched a wall or an interface that weakens"
    ),
    "weakened_disks": _count("disks whose slip on it has passed the critical slip D_c"),
    "weakened_share": Column("1", "the same as a share of the disks that have touched it"),
    "energy_sliding_J": Column(
        "J/m", "energy dissipated by sliding on the wall since the balance began, after settling"
    ),
}

#: The four ways in which contacts dissipate energy.
LOSSES = ("energy_sliding_J", "energy_rolling_J", "energy_impact_J", "energy_bonds_J")


def _encode(name, value):
    """Text of one number such that reading it gives the same bits."""
    if value is None:
        return ""
    if isinstance(value, str):
        return '"' + value.replace('"', '""') + '"' if set(value) & set(',"') else value
    known = COLUMNS.get(name) or WALL_COLUMNS.get(name)
    integer = known.integer if known else isinstance(value, (bool, int, np.integer, np.bool_))
    if integer:
        if float(value) != int(value):
            raise ValueError("a count must be a whole number")
        return str(int(value))
    return repr(float(value))


def _number(text):
    try:
        return int(text)
    except ValueError:
        return float(text)


def kept(path, mark):
    """What was in a series' file at a :meth:`SeriesWriter.mark`, bytes; RecordsError where it is no longer there."""
    path = Path(path)
    if not path.exists():
        raise RecordsError(f"{path}: missing, so the run cannot be resumed; start it anew without --resume")
    with open(path, "rb") as file:
        data = file.read(mark["bytes"])
    if len(data) < mark["bytes"] or hashlib.sha256(data).hexdigest() != mark["sha256"]:
        wrong = (
            f"has {len(data)} bytes of the {mark['bytes']} it had then"
            if len(data) < mark["bytes"]
            else "has been changed since"
        )
        raise RecordsError(
            f"{path}: does not match the checkpoint, it {wrong}; restore the file from a copy, or start the "
            "run anew without --resume"
        )
    return data


class SeriesWriter:
    """Appends rows to a series file, each row in one unbuffered write.

    ``path``: the CSV file. ``columns``: names in order, beginning with ``step``. ``resume_from``: a :meth:`mark` that a
    checkpoint kept: what the file held then is kept byte for byte, and must still be the same; later rows and a
    half-written last line are removed. Without it a file that already holds rows is refused unless ``overwrite`` is true.

    A killed process loses no written row; call :meth:`sync` at checkpoints to be safe from a power failure too.
    Numbers are written so that reading them returns the same bits; equal runs give equal files.

    Raises :class:`RecordsError` for a file that cannot be written, that has other columns, or has a damaged row.
    """

    def __init__(self, path, columns, resume_from=None, overwrite=False):
        self.path = Path(path)
        self.columns = tuple(columns)
        self.last_step: Optional[int] = None
        self._file, self._sum = None, hashlib.sha256()
        if not self.columns or self.columns[0] != "step" or len(set(self.columns)) != len(self.columns):
            raise RecordsError(f"{self.path}: columns must be unique and begin with 'step', not {self.columns[:3]}...")
        self._header = (",".join(self.columns) + "\n").encode()
        try:
            if resume_from is None:
                self._refuse_to_overwrite(overwrite)
                self._file = open(self.path, "wb", buffering=0)
                self._size = 0
                self._append(self._header)
            else:
                kept = self._kept(resume_from)
                self._sum.update(kept)
                self._size = len(kept)
                self._file = open(self.path, "r+b", buffering=0)
                self._file.truncate(self._size)
                self._file.seek(self._size)
        except OSError as error:
            raise RecordsError(
                f"{self.path}: cannot be written ({error.strerror}); choose a folder that exists and is writable"
            ) from error

    def _refuse_to_overwrite(self, overwrite):
        if overwrite or not self.path.exists():
            return
        with open(self.path, "rb") as old:
            lines = sum(1 for _ in zip(old, range(2)))
        if lines > 1:
            raise RecordsError(
                f"{self.path}: already holds the rows of an earlier run; resume that run, move the file away "
                "or choose another folder"
            )

    def _kept(self, mark):
        """What was in the file at a :meth:`mark`; RecordsError where it is no longer there."""
        data = kept(self.path, mark)
        if not data.startswith(self._header):
            found = data.split(b"\n", 1)[0].decode(errors="replace")
            raise RecordsError(
                f"{self.path}: its columns are not those of this run (found '{found[:120]}'); resume with the version "
                "that wrote it, or start anew without --resume"
            )
        self.last_step = mark["last_step"]
        return data

    def _append(self, data):
        """Write all of ``data`` or nothing of it."""
        written = 0
        try:
            while written < len(data):
                written += self._file.write(data[written:])
        except OSError as error:
            try:
                self._file.truncate(self._size)
                self._file.seek(self._size)
            except OSError:
                pass
            raise RecordsError(
                f"{self.path}: a row could not be written ({error.strerror}); free some space and resume the run"
            ) from error
        self._size += len(data)
        self._sum.update(data)

    def write(self, *rows):
        """Append a row, or the rows of one step: mappings from column name to number, with exactly the columns of this series. A column of WALL_COLUMNS may be
        None, where it has no meaning.

        Raises :class:`RecordsError` for a missing or unknown column, a NaN or infinite number, a fractional count,
        or a step that does not increase; the file is then unchanged.
        """
        if self._file is None:
            raise RecordsError(f"{self.path}: the series has been closed; open a new SeriesWriter to go on")
        lines = [self._line(row) for row in rows]
        steps = {int(row["step"]) for row in rows}
        for step in steps:
            if self.last_step is not None and step <= self.last_step:
                raise RecordsError(
                    f"{self.path}: step {step} does not come after {self.last_step}; write each step once, in order"
                )
        self._append("".join(lines).encode())
        self.last_step = max(steps)

    def _line(self, row):
        missing = [name for name in self.columns if name not in row]
        unknown = [name for name in row if name not in self.columns]
        if missing or unknown:
            raise RecordsError(
                f"{self.path}: row lacks {missing or 'nothing'} and has unknown {unknown or 'nothing'}; "
                "give exactly the columns the series was opened with"
            )
        texts = []
        for name in self.columns:
            value = row[name]
            if not (name in WALL_COLUMNS and (value is None or isinstance(value, str))) and not math.isfinite(value):
                raise RecordsError(
                    f"{self.path}: {name} = {value} at step {row['step']}; the computation has gone wrong before this "
                    "row, go back to the last checkpoint with a smaller time step"
                )
            try:
                texts.append(_encode(name, value))
            except ValueError as error:
                raise RecordsError(f"{self.path}: {name} = {value} at step {row['step']}: {error}") from error
        return ",".join(texts) + "\n"

    def mark(self):
        """What a checkpoint keeps of the file as it is now: size [bytes], checksum, and last step (None where there is no row)."""
        return {"bytes": self._size, "sha256": self._sum.hexdigest(), "last_step": self.last_step}

    def sync(self):
        """Have the operating system put all rows on the disk."""
        if self._file is not None:
            os.fsync(self._file.fileno())

    def close(self):
        """Sync and close; a second call does nothing."""
        if self._file is not None:
            self.sync()
            self._file.close()
            self._file = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def _parse_row(path, number, line, columns):
    cells = line.rstrip("\n").split(",")
    try:
        if len(cells) != len(columns):
            raise ValueError(f"{len(cells)} numbers instead of {len(columns)}")
        return [_number(cell) for cell in cells]
    except ValueError as error:
        raise RecordsError(
            f"{path}, line {number}: damaged row ({error}); remove the line, or resume the run from an earlier checkpoint"
        ) from error


def read_series(path):
    """Read a series: dict from column name to an array of shape (rows,), int64 for counts, float64 otherwise.

    A half-written last line (a run that still goes on, or was killed) is left out. Raises :class:`RecordsError` if
    the file is missing, has no header, or a row is damaged.
    """
    path = Path(path)
    try:
        text = path.read_bytes().decode(errors="replace")
    except OSError as error:
        raise RecordsError(f"{path}: cannot be read ({error.strerror}); check the folder given") from error
    lines = text.split("\n")[:-1]  # what follows the last newline is empty or half-written
    if not lines or not lines[0].startswith("step"):
        raise RecordsError(f"{path}: has no header beginning with 'step'; it is not a series, or its run never began")
    columns = lines[0].split(",")
    rows = [_parse_row(path, number, line, columns) for number, line in enumerate(lines[1:], start=2)]
    series = {}
    for name, values in zip(columns, zip(*rows) if rows else [()] * len(columns)):
        integer = COLUMNS[name].integer if name in COLUMNS else bool(values) and all(type(v) is int for v in values)
        series[name] = np.array(values, dtype=np.int64 if integer else np.float64)
    return series


def read_walls(path):
    """Read ``walls.csv``: dict from column name to an array of shape (rows,): words for ``wall``, float64 for the others, NaN where a wall has no such number.

    A half-written last line is left out. Raises :class:`RecordsError` if the file is missing or damaged.
    """
    path = Path(path)
    try:
        text = path.read_bytes().decode()
        header, *rows = csv.reader(text[: text.rfind("\n") + 1].splitlines())
        if header != list(WALL_COLUMNS) or any(len(row) != len(header) for row in rows):
            raise ValueError("wrong columns")
        columns = dict(zip(header, zip(*rows) if rows else [()] * len(header)))
        return {
            name: np.array(cells, dtype=str)
            if name == "wall"
            else np.array([float(c) if c else math.nan for c in cells])
            for name, cells in columns.items()
        }
    except (OSError, ValueError) as error:
        raise RecordsError(
            f"{path}: cannot be read as the forces on walls ({getattr(error, 'strerror', None) or error}); check the folder given"
        ) from None


def since_settled(series):
    """The rows from the dry rest on, or all where there are none, and of a series that has no ``stage``."""
    if "stage" not in series or not (series["stage"] > 0).any():
        return series
    return {name: values[series["stage"] > 0] for name, values in series.items()}


BREAK_COLUMNS = ("step", "time_s", "disk1", "disk2", "mode", "x_m", "y_m")


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
    path = Path(path)
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


@dataclass
class Snapshot:
    """The slope at one instant. N disks, C contacts.

    Scalars: ``time_s`` [s], ``step``, ``water_m`` [m] (height of the water table above its plane).
    Disks, shape (N,): ``x``, ``y``, ``r`` [m], ``angle`` [rad], ``vx``, ``vy`` [m/s], ``layer`` (int, 0 lowest), and bool: ``wet`` (water acts on it now),
    ``released`` (was wet, and has moved so far downslope that water acts on it no longer), ``ever_wet``. And ``weakened``, bool of shape (N, W): the slip along each of
    the W walls and interfaces that weaken has passed the critical slip D_c, in the order of :attr:`.section.Section.weakening`. ``ever_wet`` and ``weakened`` are None
    where they are not known, as in files of earlier versions, whose ``released`` has disks that never were wet too.
    Contacts, shape (C,): ``ci``, ``cj`` disk indices (``cj = -1 - k`` for wall number k), ``cn``, ``ct`` normal and
    tangential force [N/m], compression positive, ``cbonded`` (bool), ``cx``, ``cy`` contact point [m]. They may all
    be left out (C = 0), as for the frames of a video.
    """

    time_s: float
    step: int
    x: np.ndarray
    y: np.ndarray
    r: np.ndarray
    angle: np.ndarray
    vx: np.ndarray
    vy: np.ndarray
    layer: np.ndarray
    wet: np.ndarray
    released: np.ndarray
    ci: np.ndarray
    cj: np.ndarray
    cn: np.ndarray
    ct: np.ndarray
    cbonded: np.ndarray
    cx: np.ndarray
    cy: np.ndarray
    water_m: float
    ever_wet: Optional[np.ndarray] = None
    weakened: Optional[np.ndarray] = None


_SCALARS = ("time_s", "step", "water_m")
_CONTACTS = ("ci", "cj", "cn", "ct", "cbonded", "cx", "cy")
_OPTIONAL = ("ever_wet", "weakened")
_DISKS = tuple(f.name for f in fields(Snapshot) if f.name not in _SCALARS + _CONTACTS)
_KINDS = dict.fromkeys(("layer", "ci", "cj"), np.int64) | dict.fromkeys(
    ("wet", "released", "ever_wet", "weakened", "cbonded"), bool
)


def _snapshot(arrays, source):
    """Check ``arrays`` and make a Snapshot of them; ``source`` names the file in messages."""
    wrong = lambda what, remedy: RecordsError(f"{source}: {what}; {remedy}")  # noqa: E731
    arrays = {name: value for name, value in arrays.items() if value is not None}
    if not any(name in arrays for name in _CONTACTS):
        arrays.update({name: np.zeros(0) for name in _CONTACTS})
    names = {f.name for f in fields(Snapshot) if f.name in arrays or f.name not in _OPTIONAL}
    missing, unknown = sorted(names - set(arrays)), sorted(set(arrays) - names)
    if missing or unknown:
        raise wrong(
            f"snapshot lacks {missing or 'nothing'} and has unknown {unknown or 'nothing'}",
            "give the arrays of nonsmooth.records.Snapshot",
        )
    checked = {}
    for name in names:
        value = np.asarray(arrays[name])
        if not np.isfinite(value).all():
            at = int(np.flatnonzero(~np.isfinite(value))[0]) if value.ndim else 0
            raise wrong(f"{name}[{at}] is not a finite number", "go back to an earlier snapshot or checkpoint")
        if name in _SCALARS:
            if value.ndim:
                raise wrong(f"{name} has shape {value.shape} instead of being one number", "give one number")
            checked[name] = int(value) if name == "step" else float(value)
        else:
            checked[name] = value.astype(_KINDS.get(name, np.float64), copy=False)
    for group, key in ((_DISKS, "x"), (_CONTACTS, "ci")):
        for name in group:
            if name not in checked:
                continue
            rows = checked[name].shape[:-1] if name == "weakened" else checked[name].shape
            if rows != (len(np.atleast_1d(checked[key])),):
                raise wrong(
                    f"{name} has shape {checked[name].shape} and {key} {checked[key].shape}",
                    "these arrays must be flat (weakened: with a column for each wall) and equally long",
                )
    count = len(checked["x"])
    if (checked["r"] <= 0).any():
        raise wrong(f"radius of disk {int(np.argmin(checked['r']))} is {checked['r'].min()}", "radii are positive")
    if ((checked["ci"] < 0) | (checked["ci"] >= count) | (checked["cj"] >= count)).any():
        raise wrong(f"a contact names a disk beyond the {count} there are", "check how indices are made")
    return Snapshot(**checked)


def write_snapshot(path, **arrays):
    """Write a snapshot (keywords: the attributes of :class:`Snapshot`) as ``.npz``; returns its path.

    Equal arrays give equal bytes. Raises :class:`RecordsError` for missing or unknown arrays, unequal lengths, a NaN or a bad index, and
    :class:`~yade.nonsmooth.whole_files.WriteError` for a file that cannot be written.
    """
    path = Path(path)
    snapshot = _snapshot(arrays, path)
    # not compressed: a fifth of the room is not worth most of the time, as coordinates hardly shrink
    write_arrays(path, **{name: value for name, value in vars(snapshot).items() if value is not None})
    return path


def read_snapshot(path):
    """Read a :class:`Snapshot`. Raises :class:`RecordsError` if it is missing, truncated or inconsistent."""
    path = Path(path)
    try:
        with np.load(path, allow_pickle=False) as data:
            arrays = {name: data[name] for name in data.files}
    except OSError as error:
        reason = error.strerror or str(error)
        raise RecordsError(f"{path}: cannot be read ({reason}); check the folder given") from error
    except (zipfile.BadZipFile, zlib.error, ValueError, EOFError, KeyError, AttributeError) as error:
        raise RecordsError(
            f"{path}: not a snapshot, or truncated ({error}); delete it and use another, or run again"
        ) from error
    return _snapshot(arrays, path)
