"""Pore pressure of any flow of water for the engine that puts its force on disks (doc/theory/seepage), and which share
of it no longer acts on each of them (doc/dilatancy).
"""

from __future__ import annotations

import numpy as np

from yade.minieigenHP import Vector3, Vector3i
from yade.wrapper import PorePressureField

from ..errors import UserError
from ..system import checks
from ..water.fields import MeshField

__all__ = ["PorePressureError", "field", "release"]


class PorePressureError(UserError, ValueError):
    """Pore pressure that a scene cannot have."""


def field(pressures, begin=0.0) -> PorePressureField:
    """What ``PorePressureEngine.field`` takes, of a MeshField (:mod:`~nonsmooth.water.fields`); a PhreaticLine becomes
    one by its ``on(mesh)``.

    ``begin``: O.time [s] at which the field's time is 0. Disks outside the mesh are dry. The engine's ``volumeFactor``
    says on which volume the gradient acts: 1, the disk's own, or 1/φ, its share of the bulk.

    Raises PorePressureError for what is no MeshField, and for a time that is none.
    """
    if not isinstance(pressures, MeshField):
        raise PorePressureError(
            f"pressures {checks.shown(pressures)}: give a MeshField, as water.fields.of_seepage(...) makes one"
        )
    begin = checks.number("begin", begin, PorePressureError, "give a time [s]")
    return PorePressureField(
        nodes=[Vector3(x, y, 0) for x, y in pressures.mesh.nodes.tolist()],
        triangles=[Vector3i(*three) for three in pressures.mesh.triangles.tolist()],
        times=(pressures.times + begin).tolist(),
        pressures=pressures.pressures.ravel().tolist(),
    )


def release(engine, first, shares):
    """Sets the share of the pore pressure, 0 to 1, that no longer acts on each of the bodies ``first`` to ``first +
    len(shares) - 1``, and on no other; ``engine``: the PorePressureEngine.

    Raises PorePressureError for what are no such shares. What is there: :func:`.tables.released_shares`.
    """
    given = np.asarray(shares, float)
    wrong = given.ndim != 1 or not ((given >= 0) & (given <= 1)).all()
    if wrong:
        raise PorePressureError(f"shares {checks.shown(shares)}: give a number from 0 to 1 for each body")
    checks.count("first", first, PorePressureError, "give the id of a body", least=0)
    engine.releasedShare = [0.0] * first + given.tolist()
