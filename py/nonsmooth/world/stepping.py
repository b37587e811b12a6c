"""Steps that are made, or refused with the engine's words; and scenes that are followed to rest."""

from __future__ import annotations

from yade import O
from yade.wrapper import ContactDynamicsEngine

from ..errors import UserError

__all__ = ["StepError", "advance", "until"]


class StepError(UserError, RuntimeError):
    """A step that an engine refused; the message is the engine's."""


def advance(steps=None, until=None, view=True):
    """Makes ``steps`` steps, none if that is 0 or less, or as many as end before less than half a step is missing to
    the time ``until`` [s], or no more of either; one if nothing is said. Returns how many. ``view``: what of O.bodies
    and O.interactions is up to date afterwards, all of it, the states of some bodies (their ids), or nothing (False)
    until ``ContactDynamicsEngine.view()``. Raises StepError where an engine refuses one.

    This is ``ContactDynamicsEngine.advance`` in scenes of any engines. ``O.run(steps, wait=True)`` makes them in a
    thread of YADE's own, where 0 steps never end and Ctrl-C is not heard before the last.
    """
    if steps is None and until is None:
        steps = 1
    try:
        return ContactDynamicsEngine.advance(steps if steps is None else max(0, steps), until, view)
    except (RuntimeError, ValueError) as refusal:
        raise StepError(f"step {O.iter}: {refusal}") from None


def until(calm, limit, every=1, make=advance):
    """Makes ``every`` steps by ``make(every)``, again and again until ``calm()`` is true after them; returns whether it
    came to that within ``limit`` steps.

    Raises what ``make`` raises.
    """
    made = 0
    while made < limit:
        make(every)
        made += every
        if calm():
            return True
    return False
