"""What every experiment hands to the comparison, whatever it is."""

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
    """Of the steps alone, without records: ``steps``, ``step_s`` their length [s], ``wall_s`` [s], ``simulated_s`` [s].

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

    ``values``: {name of a Quantity: number or None}; ``curves``: {name: array} over ``curves["abscissa"]``, which begins at the event that runs are
    aligned by; ``series``: the columns of series.csv; ``begin``, ``end``: (x, y, r) [m] of the disks then, or None; ``forces``: {(disk, disk or wall):
    normal force} [N/m] of contacts under compression in the state of reference; ``overlap``: mean overlap [mean diameters] while the mass moves;
    ``overlap_rest``: in the state of reference.
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
