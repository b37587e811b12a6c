"""Pore pressure of any flow of water for the engine that puts its force on disks (doc/theory/seepage)."""

from __future__ import annotations

from yade.minieigenHP import Vector3, Vector3i
from yade.wrapper import PorePressureField

from ..errors import UserError
from ..system import checks
from ..water.fields import MeshField

__all__ = ["PorePressureError", "field"]


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
