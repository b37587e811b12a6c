"""The list of checks, and what a check is given."""

from __future__ import annotations

import inspect
from dataclasses import dataclass, field
from pathlib import Path
from typing import Callable

__all__ = ["Bench", "Check", "check", "registered"]


@dataclass
class Bench:
    """What a check works with. ``quick``: smaller samples and fewer points, for minutes instead of an hour; ``folder``:
    for its files.
    """

    folder: Path
    quick: bool = False
    threads: int = 1
    progress: Callable[[str], None] = field(default=lambda text: None)


@dataclass(frozen=True)
class Check:
    """A check as it was registered: its function, and what a report says of it."""

    name: str  # of the function, with dashes
    title: str
    subject: str  # heading it stands under
    derivation: str  # the function's docstring: what is expected and why
    seconds: float  # roughly, in full
    quick_seconds: float | None  # the same with quick; None: left out of a quick run
    run: Callable[[Bench], object]

    @property
    def group(self) -> str:
        """The module of this package that it stands in, "water" of water.seepage: ``--only`` takes all of it."""
        return self.run.__module__.rpartition("verification.")[2].partition(".")[0]


_checks: dict[str, Check] = {}


def check(title, *, subject, seconds=1.0, quick=True):
    """Marks a function ``f(bench) -> Findings`` as a check; its docstring is printed in the report as the derivation.

    ``seconds``: roughly what it takes; ``quick``: seconds in a quick run, True for the same, None to leave it out
    there. Raises ValueError for a second check of the same name, or one without a docstring.
    """

    def mark(function):
        name = function.__name__.replace("_", "-")
        if name in _checks:
            raise ValueError(f"there are two checks named {name}")
        if not function.__doc__:
            raise ValueError(f"the check {name} has no docstring, which the report prints as its derivation")
        derivation = inspect.cleandoc(function.__doc__)
        _checks[name] = Check(name, title, subject, derivation, seconds, seconds if quick is True else quick, function)
        return function

    return mark


def registered() -> list[Check]:
    """All Checks of the modules that were imported, in the order of their definition."""
    return list(_checks.values())
