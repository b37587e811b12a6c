"""What pore water does to disks: −∇p times an area, at each disk's centre, per metre of thickness.

Two areas may be meant, as in a section's ``water.volume``, and they go with two ways to count weights:

* ``disk``: the disk's own area, Archimedes' force on the solid. Summed over a bulk it is the packing fraction φ times
  the pressure's resultant.
* ``bulk``: the disk's share of the bulk, its area over φ, so that the sum is the whole resultant and a base is relieved
  of the pore pressure on it. This goes with disks that carry the weight of the saturated bulk. Disks that weigh what
  solids weigh lack the water in their pores, γ_w (1 − φ)/φ times their area: ``pore_water=True`` adds it where it is
  wet. In still water both are then one, buoyancy; in flowing water they are not (doc/theory/seepage).
"""

from __future__ import annotations

import math

import numpy as np

from ..system import checks
from .error import WaterError
from .fields import UNIT_WEIGHT

__all__ = ["AREAS", "ForceError", "critical_gradient", "on_disks"]

AREAS = ("disk", "bulk")


class ForceError(WaterError):
    """Forces of water that cannot be told: an argument without sense."""


def on_disks(
    field,
    x,
    y,
    r,
    time=0.0,
    *,
    area="disk",
    packing_fraction=None,
    pore_water=False,
    unit_weight=UNIT_WEIGHT,
    outside="refuse",
) -> np.ndarray:
    """Forces [N/m] of pore water on disks, (n, 2).

    ``field``: a MeshField or PhreaticLine (:mod:`~nonsmooth.water.fields`); ``x``, ``y``, ``r``: centres and radii [m],
    (n,); ``time`` [s]; ``area``: "disk" or "bulk"; ``packing_fraction``: φ, one number or (n,), for "bulk";
    ``pore_water``: see above, with ``unit_weight`` γ_w [N/m³]; ``outside``: what becomes of disks outside the field,
    "refuse" or "dry". Raises ForceError, and FieldError as the field.
    """
    if not hasattr(field, "gradient") or not hasattr(field, "pressure"):
        raise ForceError(f"field {checks.shown(field)}: give a MeshField or a PhreaticLine, as fields has them")
    x, y, r = (np.asarray(v, float).ravel() for v in (x, y, r))
    if not len(x) == len(y) == len(r) or not np.isfinite(np.concatenate((x, y, r))).all() or not np.all(r > 0):
        raise ForceError(
            f"x, y, r of {len(x)}, {len(y)} and {len(r)} numbers: give as many of each, finite, with radii above 0 [m]"
        )
    if area not in AREAS:
        raise ForceError(f"area {checks.shown(area)}: give 'disk' or 'bulk'")
    if pore_water and area != "bulk":
        raise ForceError("pore_water True: give area='bulk' with it; a disk's own area has no pores")
    own, points = math.pi * np.square(r), np.column_stack((x, y))
    if not len(x):
        return np.zeros((0, 2))
    if area == "disk":
        return -field.gradient(points, time, outside) * own[:, None]
    share = np.asarray(math.nan if packing_fraction is None else packing_fraction, float)
    if share.shape not in ((), r.shape) or not np.all((share > 0) & (share <= 1)):
        raise ForceError(
            f"packing_fraction {checks.shown(packing_fraction)}: give a number above 0 and up to 1, or one for "
            "each disk"
        )
    force = -field.gradient(points, time, outside) * (own / share)[:, None]
    if pore_water:
        wet = field.pressure(points, time, outside) > 0
        force[:, 1] -= np.where(wet, unit_weight * own * (1 - share) / share, 0.0)
    return force


def critical_gradient(packing_fraction, density, water_density=1000.0) -> float:
    """The upward hydraulic gradient at which grains of ``density`` [kg/m³] float: φ (ρ/ρ_w − 1), with φ = 1 − n.

    Raises ForceError for numbers without sense.
    """
    checks.number(
        "packing_fraction", packing_fraction, ForceError, "give a number above 0 and up to 1", above=0, most=1
    )
    for name, value in (("density", density), ("water_density", water_density)):
        checks.number(name, value, ForceError, "give a number above 0 [kg/m³]", above=0)
    return packing_fraction * (density / water_density - 1)
