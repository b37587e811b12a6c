"""Claims: a figure, what it is held against, how far it may be off and why."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field

__all__ = ["Claim", "Claims", "Findings"]

_UNIT = re.compile(r"(.*) \[([^\[\]]+)\]", re.DOTALL)  # a name, and its unit


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


class Claims(list):
    """Claims of a check, in the report's order: each method adds one, and returns it.

    ``what`` ends with the figure's unit in brackets where it has one, ``why`` says why just this tolerance.
    ``against``: whom all are compared with where a claim does not say it itself.
    """

    def __init__(self, claims=(), against="derivation"):
        super().__init__(claims)
        self.against = against

    def between(self, what, measured, low, high, why, *, expected=None, against=None) -> Claim:
        """A number lies between two bounds, both allowed.

        Raises ValueError for a claim without a reason, or one that allows nothing.
        """
        named = _UNIT.fullmatch(what)
        what, unit = (named[1], named[2]) if named else (what, "")
        self.append(Claim(what, float(measured), low, high, expected, unit, against or self.against, why))
        return self[-1]

    def near(self, what, measured, expected, why, *, absolute=0.0, relative=0.0, against=None) -> Claim:
        """``expected`` to within ``absolute`` plus ``relative`` times its size."""
        margin = absolute + relative * abs(expected)
        low, high = expected - margin, expected + margin
        return self.between(what, measured, low, high, why, expected=float(expected), against=against)

    def at_most(self, what, measured, limit, why, *, against=None) -> Claim:
        """A distance or an error, which cannot be negative: from 0 to ``limit``."""
        return self.between(what, measured, 0.0, limit, why, against=against)

    def at_least(self, what, measured, limit, why, *, against=None) -> Claim:
        """A number is not below a limit."""
        return self.between(what, measured, limit, math.inf, why, against=against)


@dataclass
class Findings:
    """What a check found. ``plots``: (matplotlib Figure or path of a PNG in the bench's folder, caption); ``tables``:
    (caption, heads, rows of text); ``remarks``: sentences; ``numbers``: what documentation shows besides, plain data by
    name."""

    claims: list[Claim] = field(default_factory=list)
    plots: list = field(default_factory=list)
    tables: list = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    numbers: dict = field(default_factory=dict)

    @property
    def passed(self) -> bool:
        """Whether there are claims and all hold."""
        return bool(self.claims) and all(claim.passed for claim in self.claims)
