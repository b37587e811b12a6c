"""Disks that the windows of a section take out of the running slope, with their ledger: a row for each disk in
``eroded.csv``.

A disk that is gone is no body any more. What is left keeps its ids and its numbers, so records tell which disks they
have (:attr:`.records.Snapshot.number`).
"""

from __future__ import annotations

import math

import numpy as np

from yade import O

from ... import records
from ...world import erosion
from . import slope
from .columns import LEDGER_COLUMNS
from .error import ExperimentError

__all__ = ["Eroding"]


class Eroding:
    """Of a built :class:`~nonsmooth.studies.slope.slope.Slope`, its disks' ``layers`` (count,), and which are of its
    ``mass``, bool (count,), None: all; ``path``: of the
    ledger; ``mark``: of a checkpoint.

    ``disks``: how many are gone.
    """

    def __init__(self, built, layers, mass, path, mark=None):
        self._slope, self._layers, self._of_mass = built, layers, mass
        self.file = records.SeriesWriter(path, LEDGER_COLUMNS, resume_from=mark, overwrite=True)
        gone = records.read_eroded(path)
        self.disks, self._mass = len(gone["disk"]), gone["mass_kg_per_m"].tolist()
        self._energy = [*gone["energy_kinetic_J"].tolist(), *gone["energy_potential_J"].tolist()]

    @property
    def energy(self):
        """Kinetic and potential energy of all disks that are gone, when they were taken out [J/m]."""
        return math.fsum(self._energy)

    @property
    def turned(self):
        """The same with all signs positive: what rounding goes with."""
        return math.fsum(map(abs, self._energy))

    def columns(self, state):
        """The columns of the series that tell of it."""
        return {
            "eroded_disks": self.disks,
            "eroded_kg_per_m": math.fsum(self._mass),
            "energy_eroded_J": self.energy,
            "eroded_shift_x_m": state.eroded_shift_x,
            "eroded_shift_y_m": state.eroded_shift_y,
        }

    def take(self, due, disks):
        """Takes out what is inside of the windows that are ``due``, [(Window, time [s since t0])], and notes it; of a
        disk in several the first takes it. ``disks``: the table of those that are there. Returns which are left, bool
        (n,). Raises ExperimentError, and takes nothing, where none of the mass would be left.
        """
        numbers = disks["id"] - self._slope.first_disk
        layers, taken, left = self._layers[numbers], [], np.ones(len(numbers), bool)
        for window, time in due:
            inside = left & window.of_layers(self._slope.section)[layers]
            inside[inside] = window.takes(disks["x"][inside], disks["y"][inside], time)
            taken += [((window.name, time), k) for k in np.flatnonzero(inside).tolist()]
            left &= ~inside
        if not taken:
            return left
        if not (left if self._of_mass is None else left & self._of_mass[numbers]).any():
            raise ExperimentError(
                f"at t = {O.time:.3f} s the window {taken[-1][0][0]} takes the last disks of the mass out; let windows "
                f"of {self._slope.section.source} leave some"
            )
        ids = [int(disks["id"][k]) for _, k in taken]
        had = erosion.take_out(ids)
        self.file.write(
            *(self._row(by, k, disks, *one) for (by, k), one in zip(taken, zip(*(v.tolist() for v in had))))
        )
        self.disks += len(ids)
        self._mass += had.mass.tolist()
        self._energy += [*had.kinetic.tolist(), *had.potential.tolist()]
        if not slope.is_hard(self._slope):
            self._slope.solver.forget_bodies(ids)
        return left

    def _row(self, by, k, disks, mass, kinetic, potential):
        number = int(disks["id"][k]) - self._slope.first_disk
        return {
            "step": O.iter,
            "time_s": O.time,
            "window": by[0],
            "window_time_s": by[1],
            "disk": number,
            "layer": self._slope.section.layers[self._layers[number]].name,
            "mass_kg_per_m": mass,
            "x_m": float(disks["x"][k]),
            "y_m": float(disks["y"][k]),
            "r_m": float(disks["r"][k]),
            "vx_m_per_s": float(disks["vx"][k]),
            "vy_m_per_s": float(disks["vy"][k]),
            "energy_kinetic_J": kinetic,
            "energy_potential_J": potential,
        }
