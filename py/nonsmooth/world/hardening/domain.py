"""Bodies that leave a box are erased, as YADE's DomainLimiter does it."""

from __future__ import annotations

from yade import O

__all__ = ["limit"]


def limit(low, high, mask=-1):
    """Erases the spheres whose centres are outside of the corners ``low`` and ``high`` [m]; ``mask``: of bodies that are
    looked at, -1 or 0 all."""
    for body in [b for b in O.bodies if b is not None and b.dynamic]:
        inside = all(a <= x <= b for a, x, b in zip(low, body.state.pos, high))
        if not inside and (mask <= 0 or body.mask & mask):
            O.bodies.erase(body.id)
