"""Claims: a figure, what it is held against, how far it may be off and why."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

__all__ = ["Claim", "Outcome", "at_least", "at_most", "between", "near"]


@dataclass(frozen=True)
class Claim:
    """One row of the report. ``low`` and ``high`` bound ``measured``, both allowed."""

    what: str  # the figure in words, e.g. "acceleration of a disk that rolls down 21°"
    measured: float
    low: float
    high: float
    expected: float | None = None  # None where only a range is claimed
    unit: str = ""
    against: str = "derivation"  # whom it is compared with, e.g. "Siconos", "LMGC90", "derivation"
    why: str = ""  # why just this tolerance

    def __post_init__(self):
        if not self.why:
            raise ValueError(f"the claim '{self.what}' does not say why its tolerance is what it is")
        if not self.low <= self.high:
            raise ValueError(f"the claim '{self.what}' allows nothing: {self.low} to {self.high}")

    @property
    def passed(self) -> bool:
        """Whether the measured number is finite and within its bounds, both of them included."""
        return bool(math.isfinite(self.measured) and self.low <= self.measured <= self.high)  # bounds may be NumPy's


def near(what, measured, expected, *, absolute=0.0, relative=0.0, **more) -> Claim:
    """``expected`` to within ``absolute`` plus ``relative`` times its size."""
    margin = absolute + relative * abs(expected)
    return Claim(what, float(measured), expected - margin, expected + margin, expected=float(expected), **more)


def between(what, measured, low, high, **more) -> Claim:
    """A Claim that a number lies between two bounds; ``more``: its other fields."""
    return Claim(what, float(measured), low, high, **more)


def at_most(what, measured, limit, **more) -> Claim:
    """A distance or an error, which cannot be negative: from 0 to ``limit``."""
    return Claim(what, float(measured), 0.0, limit, **more)


def at_least(what, measured, limit, **more) -> Claim:
    """A Claim that a number is not below a limit; ``more``: its other fields."""
    return Claim(what, float(measured), limit, math.inf, **more)


@dataclass
class Outcome:
    """What a check found. ``plots``: (matplotlib Figure or path of a PNG in the bench's folder, caption); ``tables``: (caption, heads, rows of text); ``remarks``: sentences;
    ``numbers``: what documentation shows besides, plain data by name."""

    claims: list[Claim] = field(default_factory=list)
    plots: list = field(default_factory=list)
    tables: list = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    numbers: dict = field(default_factory=dict)

    @property
    def passed(self) -> bool:
        """Whether there are claims and all hold."""
        return bool(self.claims) and all(claim.passed for claim in self.claims)
