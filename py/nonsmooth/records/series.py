"""The time series of a run, ``series.csv`` and ``walls.csv``: written row by row, and read."""

import csv
import hashlib
import math
import numbers
import os
from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from ..system import checks
from .breaks import BREAK_MODES
from .columns import STEP, Column
from .error import RecordsError

__all__ = [
    "SeriesWriter",
    "broken_bonds",
    "kept",
    "read_eroded",
    "read_series",
    "read_surfaces",
    "read_walls",
    "since_settled",
]


def _encode(column, value):
    """Text of one cell such that reading it gives the same bits."""
    if value is None:
        return ""
    if isinstance(value, str):
        return '"' + value.replace('"', '""') + '"' if set(value) & set(',"') else value
    if column.integer or (column.kind is None and isinstance(value, (bool, int, np.integer, np.bool_))):
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
        raise RecordsError(f"{path}: missing, so the run cannot be resumed; start a new run without --resume")
    with open(path, "rb") as file:
        data = file.read(mark["bytes"])
    if len(data) < mark["bytes"] or hashlib.sha256(data).hexdigest() != mark["sha256"]:
        wrong = (
            f"has {len(data)} bytes of the {mark['bytes']} it had then"
            if len(data) < mark["bytes"]
            else "has been changed since"
        )
        raise RecordsError(
            f"{path}: does not match the checkpoint, it {wrong}; restore the file from a copy, or start a "
            "new run without --resume"
        )
    return data


class SeriesWriter:
    """Appends rows to a series file, each row in one unbuffered write.

    ``path``: the CSV file. ``columns``: {name: Column} in order, beginning with ``step``, as :func:`.columns.declared`
    returns them; or names alone, of columns that then hold whole numbers and others as they come. ``resume_from``: a
    :meth:`mark` that a checkpoint kept: what the file held then is kept byte for byte, and must still be the same;
    later rows and a half-written last line are removed. Without it a file that already holds rows is refused unless
    ``overwrite`` is true.

    A killed process loses no written row; call :meth:`sync` at checkpoints to be safe from a power failure too.
    Numbers are written so that reading them returns the same bits; equal runs give equal files.

    Raises :class:`RecordsError` for a file that cannot be written, that has other columns, or has a damaged row.
    """

    def __init__(self, path, columns, resume_from=None, overwrite=False):
        self.path = Path(checks.path("path", path, RecordsError, "give the path of the file to write"))
        if isinstance(columns, str) or not isinstance(columns, Iterable):
            raise RecordsError(
                f"columns {checks.shown(columns)}: give the names of the columns, a list that begins with 'step'"
            )
        told = columns.items() if isinstance(columns, Mapping) else ()
        known = {"step": STEP} | {name: column for name, column in told if isinstance(column, Column)}
        self.columns = tuple(columns)
        self._declared = [known.get(name, Column(name, kind=None)) for name in self.columns]
        self.last_step = None
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
                data = self._kept(resume_from)
                self._sum.update(data)
                self._go_on(len(data))
        except OSError as error:
            raise RecordsError(
                f"{self.path}: cannot be written ({error.strerror}); choose a folder that exists and is writable"
            ) from error

    def _go_on(self, size):
        """Opens the file, and keeps its first ``size`` bytes."""
        self._file, self._size = open(self.path, "r+b", buffering=0), size
        self._file.truncate(size)
        self._file.seek(size)

    @property
    def closed(self):
        """Whether :meth:`close` has been called, and no :meth:`reopen` since."""
        return self._file is None

    def reopen(self):
        """Takes rows again after :meth:`close`; nothing happens to one that is open. Raises RecordsError where the file
        is no longer what it was then.
        """
        if self._file is not None:
            return
        self._kept(self.mark())
        try:
            self._go_on(self._size)
        except OSError as error:
            raise RecordsError(
                f"{self.path}: cannot be written ({error.strerror}); make it writable, or begin a new run in another folder"
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
                "that wrote it, or start a new run without --resume"
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
        """Append a row, or the rows of one step: mappings from column name to number, with exactly the columns of this
        series. What is optional may be None, where it has no meaning.

        Raises :class:`RecordsError` for a missing or unknown column, a NaN or infinite number, a fractional count,
        or a step that does not increase; the file is then unchanged.
        """
        if self._file is None:
            raise RecordsError(
                f"{self.path}: the series has been closed; call its reopen() to go on, or run() or attach() of the experiment that it belongs to"
            )
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
        for column in self._declared:
            name, value = column.name, row[column.name]
            may = (str,) * (column.kind is str) + (type(None),) * column.optional
            if isinstance(value, may):
                pass
            elif not isinstance(value, (numbers.Real, np.bool_)):
                raise RecordsError(f"{self.path}: {name} = {checks.shown(value)} at step {row['step']}: give a number")
            elif not math.isfinite(value):
                raise RecordsError(
                    f"{self.path}: {name} = {value} at step {row['step']}; the computation has gone wrong before this "
                    "row, go back to the last checkpoint with a smaller time step"
                )
            try:
                texts.append(_encode(column, value))
            except ValueError as error:
                raise RecordsError(f"{self.path}: {name} = {value} at step {row['step']}: {error}") from error
        return ",".join(texts) + "\n"

    def mark(self):
        """What a checkpoint keeps of the file as it is now: size [bytes], checksum, and last step (None where there is
        no row).
        """
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
    """Read a series of any study: dict from column name to an array of shape (rows,), int64 for what holds whole
    numbers alone (counts, as a writer writes them), float64 otherwise.

    A half-written last line (a run that still goes on, or was killed) is left out. Raises :class:`RecordsError` if
    the file is missing, has no header, or a row is damaged.
    """
    path = Path(checks.path("path", path, RecordsError, "give the path of a file of a run"))
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
        integer = name == "step" or bool(values) and all(type(v) is int for v in values)
        series[name] = np.array(values, dtype=np.int64 if integer else np.float64)
    return series


def read_walls(path):
    """Read ``walls.csv``: dict from column name to an array of shape (rows,): words for ``wall``, float64 for the
    others, NaN where a wall has no such number.

    A half-written last line is left out. Raises :class:`RecordsError` if the file is missing or damaged.
    """
    return _with_words(path, ("wall",), "the forces on walls")


def read_eroded(path):
    """Read ``eroded.csv``, the ledger of disks that were taken out of a slope: dict from column name to an array of
    shape (disks,): words for ``window`` and ``layer``, int64 for ``step`` and ``disk``, float64 for the others.

    A half-written last line is left out. Raises :class:`RecordsError` if the file is missing or damaged.
    """
    return _with_words(path, ("window", "layer"), "the ledger of disks that were taken out", ("step", "disk"))


def read_surfaces(path):
    """Read ``slip_surface.csv``, what slip laws have found in cells along walls: dict from column name to an array of
    shape (rows,): words for ``wall``, int64 for ``step`` and ``cell``, float64 for the others, NaN where a law has no
    such number.

    A half-written last line is left out. Raises :class:`RecordsError` if the file is missing or damaged.
    """
    return _with_words(path, ("wall",), "the cells of walls with slip laws", ("step", "cell"))


def _with_words(path, words, about, counts=()):
    """A table with several rows a step, whose third column is the first that holds ``words``; ``counts``: columns of
    whole numbers.
    """
    path = Path(checks.path("path", path, RecordsError, "give the path of a file of a run"))
    try:
        text = path.read_bytes().decode()
        header, *rows = csv.reader(text[: text.rfind("\n") + 1].splitlines())
        if (
            header[:3] != ["step", "time_s", words[0]]
            or not {*words, *counts} <= {*header}
            or any(len(row) != len(header) for row in rows)
        ):
            raise ValueError("wrong columns")
        columns = dict(zip(header, zip(*rows) if rows else [()] * len(header)))
        found = {
            name: np.array(cells, dtype=str)
            if name in words
            else np.array([float(c) if c else math.nan for c in cells])
            for name, cells in columns.items()
        }
        return found | {name: np.array(list(map(int, columns[name])), np.int64) for name in counts}
    except (OSError, ValueError) as error:
        raise RecordsError(
            f"{path}: cannot be read as {about} ({getattr(error, 'strerror', None) or error}); check the folder given"
        ) from None


def broken_bonds(series, row=-1) -> int:
    """How many bonds have broken, in any way, up to a ``row`` of a series that read_series gave."""
    return sum(int(series[f"bonds_broken_{mode}"][row]) for mode in BREAK_MODES[1:])


def since_settled(series):
    """The rows from the dry rest on, or all where there are none, and of a series that has no ``stage``."""
    if "stage" not in series or not (series["stage"] > 0).any():
        return series
    return {name: values[series["stage"] > 0] for name, values in series.items()}
