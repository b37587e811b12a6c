"""Steps that are made, or refused with the engine's words."""

from __future__ import annotations

from yade import O

from .errors import UserError

__all__ = ["StepError", "advance"]


class StepError(UserError, RuntimeError):
    """A step that an engine refused; the message is the engine's."""


def advance(steps=1):
    """Makes ``steps`` steps, none if that is 0 or less. Raises StepError where an engine refuses one.

    ``O.run(steps, wait=True)`` makes them in a thread of YADE's own. A refusal there is lost where it comes before the waiting begins, and the script goes on with
    a scene that has stopped; 0 steps never end; and Ctrl-C is not heard before the last.
    """
    for _ in range(steps):
        try:
            O.step()
        except (RuntimeError, ValueError) as refusal:
            raise StepError(f"step {O.iter}: {refusal}") from None
