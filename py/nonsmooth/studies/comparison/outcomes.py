"""What every experiment hands to the comparison, whatever it is.

An experiment is a module (:mod:`slopes`, :mod:`biaxials`) or an object (:mod:`collapses`, :mod:`spheres`) with

* ``prepare(case)``, ``run(folder, **case)``, ``measure(case, folder, found)``: the disks, a run in a process of its
  own, and its :class:`Outcome`;
* ``disks_of(case)``: section.Materials of its disks, a list, and their smallest and largest diameter [m]. Raises
  UserError for a case that cannot be;
* ``least_stiffness(case)``, if it has one: Young's modulus [Pa] below which its soft runs would refuse;
* ``SPACE``, true of one of spheres: it has no ``disks_of``, but ``count(options)``, the number of spheres, and
  ``check(case)``, which raises UserError for a case that would refuse once it runs;
* ``QUANTITIES``, ``KEYS``, ``CURVES``: what is compared; ``DEFAULT_STIFFNESSES``, ``ENSEMBLE_STIFFNESS`` [Pa],
  ``SOURCE``, ``DISKS``: defaults;
* ``OVERLAP``: what its mean overlap is, a sentence; ``OVERLAP_WHEN``: when Outcome.overlap_rest and Outcome.overlap are
  taken; ``COST_WHEN``: what part of the course Cost.rate is of.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

from . import deposits
from .cases import Case

__all__ = ["Cost", "Outcome", "Quantity"]


@dataclass(frozen=True)
class Quantity:
    """An observable in words: ``name`` in summaries, what it ``means``, its ``unit``."""

    name: str
    means: str
    unit: str


@dataclass(frozen=True)
class Cost:
    """Of the steps alone, without records, in both worlds: ``steps``, ``step_s`` their length [s], ``wall_s`` [s],
    ``simulated_s`` [s].

    ``rate``: wall time for a second of simulation while the mass moves (of the whole run where that is not told apart).
    """

    steps: int
    step_s: float
    wall_s: float
    simulated_s: float
    rate: float


@dataclass
class Outcome:
    """One finished run.

    ``values``: {name of a Quantity: number or None}; ``curves``: {name: array} over ``curves["abscissa"]``, which
    begins at the event that runs are aligned by, all of one shape (n,); ``series``: the columns of series.csv, of shape
    (rows,); ``begin``, ``end``: (x, y, r) [m] of the disks then, of shape (disks,), or None; ``forces``: {(disk, disk
    or wall): normal force} [N/m] of contacts under compression in the state of reference; ``overlap``: mean overlap
    [mean diameters] while the mass moves, or at the end; ``overlap_rest``: in the state of reference.
    """

    case: Case
    values: dict
    curves: dict
    series: dict
    begin: tuple | None
    end: tuple | None
    forces: dict
    overlap: float
    overlap_rest: float
    cost: Cost
    notes: list = field(default_factory=list)

    @cached_property
    def deposit(self):
        """Outline of the disks at the end, None where there is no end."""
        return None if self.end is None else deposits.outline(*self.end)
