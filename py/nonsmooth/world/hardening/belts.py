"""Walls whose velocity drags what touches them while they stay where they are, as belts and conveyors."""

from __future__ import annotations

from yade import O

__all__ = ["command_of", "put_back"]


def command_of(bodies):
    """The command of a PyRunner that puts these ``bodies`` back to where they are now; "" where none of them moves."""
    places = {b.id: tuple(b.state.pos) for b in bodies if b.state.vel.norm() > 0}
    return f"from yade.nonsmooth.world.hardening import belts as _b; _b.put_back({places})" if places else ""


def put_back(places):
    """Puts bodies to their ``places``, {id: (x, y, z) [m]}; those that are gone are left out."""
    for i, place in places.items():
        body = O.bodies[i]
        if body is not None:
            body.state.pos = place
