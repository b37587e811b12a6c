"""A run's snapshots in the course of time: at regular distances, and those of the rows that are its characteristic
times. Needs no YADE.

Which rows these are is known only afterwards. So a run keeps a snapshot of each row that may still become one
(:func:`.characteristic_times.kept_rows`), and removes it when that is over. What a checkpoint has seen stays until the
next one is written: a run that is killed and resumed has the files of one that was not.
"""

from __future__ import annotations

from array import array
from pathlib import Path

import numpy as np

from ... import course
from ...measure import characteristic_times
from ...model import scales
from ...system.whole_files import remove, whole

__all__ = ["FOLDER", "Frames", "nearest", "of_run", "regular"]

FOLDER = "snapshots"


class Frames:
    """Decides for each row of a run in ``folder``, of a Section, whether a snapshot is taken, and removes those that
    have become idle.

    ``series``, ``state``: of a run that is resumed, its rows up to the checkpoint and the fields of course.State as a
    mapping.
    """

    def __init__(self, folder, section, series=None, state=None):
        self.folder, self.section = Path(folder) / FOLDER, section
        self._rows = {name: array("d") for name in characteristic_times.columns(section)}
        self._extra, self._wanted, self._saved = (
            set(),
            set(),
            -1,
        )  # numbers of steps: on the disk between regular ones; wanted; of the last checkpoint
        if series is not None and len(series["step"]):
            for name, values in self._rows.items():
                values.extend(series[name].tolist())
            self._want(state)
            steps = series["step"][regular_rows(series, section, state["failed_dry"])].tolist()
            self._extra = {int(p.stem) for p in whole(self.folder, "*.npz") if p.stem.isdecimal()} - set(steps)
            self.saved()

    def path(self, step):
        """Where the snapshot of a step is."""
        return self.folder / f"{step:08d}.npz"

    def takes(self, row, regular, state):
        """Whether a snapshot is taken of a ``row`` of the series (a mapping), which comes next; ``regular``: whether it
        is in any case; ``state``: as after the row.
        """
        for name, values in self._rows.items():
            values.append(row[name])
        self._want(state)
        if not regular and row["step"] in self._wanted:
            self._extra.add(row["step"])
        return regular or row["step"] in self._wanted

    def tidy(self):
        """Removes what is idle, once the row's own snapshot is there; what was there at the last checkpoint stays.
        Raises WriteError.
        """
        self._remove({step for step in self._extra - self._wanted if step > self._saved})

    def saved(self):
        """A checkpoint has been written. Raises WriteError."""
        steps = self._rows["step"]
        self._saved = int(steps[-1]) if steps else -1
        self._remove(self._extra - self._wanted)

    def _want(self, state):
        series = {name: np.array(values) for name, values in self._rows.items()}
        rows = characteristic_times.kept_rows(series, self.section, state)
        self._wanted = set(series["step"][rows].astype(int).tolist())

    def _remove(self, steps):
        remove([self.path(step) for step in steps], "of a row that is no characteristic time")
        self._extra -= steps


def regular_rows(series, section, failed_dry):
    """Which rows of a series are those of regular snapshots, bool (rows,), see :func:`.course.slope.keeps_frame`;
    ``failed_dry`` [s]: when, or None.
    """
    number = np.rint(series["time_s"] / scales.of(section).row_seconds)
    counts = (series["stage"] > 0) | (series["time_s"] >= (np.inf if failed_dry is None else failed_dry))
    return counts & (number % course.FRAME_ROWS == 0)


def of_run(folder, series):
    """The run's snapshots in the course of time: (time [s], path); ``series``: all of its rows. Other files are none of
    the run's.
    """
    time_of = dict(zip(series["step"].astype(int).tolist(), series["time_s"].tolist()))
    return [
        (time_of[int(p.stem)], p)
        for p in whole(Path(folder) / FOLDER, "*.npz")
        if p.stem.isdecimal() and int(p.stem) in time_of
    ]


def regular(frames, series, section, failed_dry):
    """Those of :func:`of_run` that are at equal distances, for a video; arguments as of :func:`regular_rows`."""
    times = set(series["time_s"][regular_rows(series, section, failed_dry)].tolist())
    return [one for one in frames if one[0] in times]


def nearest(frames, time):
    """Snapshot file whose time is nearest; ``frames``: list of (time, path)."""
    return min(frames, key=lambda item: abs(item[0] - time))[1]
