"""Water table at which the toe of a slab reaches its passive strength, from a measured envelope of the rock. Needs no
YADE.

A slab of bulk weight γ, thickness H at its toe, dips by β on a plane with friction μ and is held by a backstop
perpendicular to the plane. Per metre of thickness, with W the weight of all layers, h the height of the water table
over the plane, U(h) what the water lifts along the normal and S(h) what it pushes down the plane, both by −∇p on the
volume of every disk below the table (Taboada and Estrada 2009, eq. 7; where it flows along the plane they are γ_w cos β
and nothing, eq. 18):

    push        P(h) = W sin β + S(h) − μ (W cos β − U(h))              the plane at its limit (paper, eq. 20),
    resistance  R(h) = ∫₀ᴴ [ K_p σ'(z, h) + 2 c √K_p ] dz ,  K_p = tan²(45° + φ/2)     Rankine's passive state along the slab,
    σ'(z, h) = γ cos β z − w max(0, z − H + h)                            effective normal stress at the depth z, w the lift per volume of bulk.

The toe fails where P = R. Neglected: the shear stress γ sin β z on planes parallel to the slab, friction on the
backstop, friction of the plane below the wedge, and that the toe fails progressively; the first lowers the resistance,
the next two raise it. So the height is an estimate to some 20 %.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from scipy.optimize import brentq
from shapely import affinity
from shapely.geometry import box

__all__ = ["Toe", "passive"]

SLICE = 0.01  # of the slab's length, in which its thickness at the toe is looked for


@dataclass(frozen=True)
class Toe:
    """``water_m``: height of the water table at failure, None where the toe bears any or not even the dry slab;
    ``thickness_m``: H; ``push``, ``resistance`` [N/m]: dry, and at failure where there is one; ``softening`` [N/m³]: by
    how much water of the height h takes the resistance, divided by h².
    """

    water_m: float | None
    thickness_m: float
    push_dry: float
    resistance_dry: float
    push_N_per_m: float | None
    softening: float = 0.0

    def resistance(self, height):
        """R [N/m] under a water table of a ``height`` [m] up to the thickness, a number or an array."""
        return self.resistance_dry - self.softening * height**2


def passive(section, cohesion, friction_deg, packing_fraction):
    """The Toe of a Section with water above a wall; ``cohesion`` [Pa], ``friction_deg`` [°] of its rock,
    ``packing_fraction`` of disks in the layers.

    Raises ValueError for a section without water above a wall.
    """
    water = section.water
    if water is None or water.wall is None:
        raise ValueError(f"{section.name}: its water table stands above no wall, so there is no slab")
    beta = math.radians(abs(water.dip))
    rock = section.materials[section.layers[0].material]
    plane = section.materials[section.wall(water.wall).material]
    # along the slab, the plane being the x axis; downslope is +x for a plane that falls to the right
    slab = affinity.rotate(section.outline, water.dip, origin=water.point)
    slab = affinity.translate(slab, 0.0, -water.point[1])
    x0, _, x1, _ = slab.bounds
    end = x1 - SLICE * (x1 - x0) if water.dip >= 0 else x0
    thickness = slab.intersection(box(end, -1e9, end + SLICE * (x1 - x0), 1e9)).bounds[3]
    bulk = rock.density * packing_fraction * section.gravity
    share = packing_fraction if water.volume == "disk" else 1.0
    lift, along = (share * part for part in _parts(water))
    weight = bulk * section.area
    k = math.tan(math.pi / 4 + math.radians(friction_deg) / 2) ** 2

    def push(h):
        wet = slab.intersection(box(x0, -1e9, x1, h)).area
        return weight * math.sin(beta) + along * wet - plane.friction * (weight * math.cos(beta) - lift * wet)

    dry = k * 0.5 * bulk * math.cos(beta) * thickness**2 + 2 * cohesion * math.sqrt(k) * thickness
    found = Toe(None, thickness, push(0.0), dry, None, 0.5 * k * lift)

    def miss(h):
        return push(h) - found.resistance(h)

    if not miss(0.0) < 0 < miss(thickness):
        return found
    height = brentq(miss, 0.0, thickness)
    return replace(found, water_m=height, push_N_per_m=push(height))


def _parts(water):
    """−∇p [N/m³] along the plane's normal and down the plane."""
    beta = math.radians(water.dip)
    if water.pressure_gradient == "parallel_seepage":
        return water.unit_weight * math.cos(beta), 0.0  # without what rounding leaves
    x, y = water.pressure_gradient_xy
    down = -x * math.cos(beta) + y * math.sin(beta)
    return -x * math.sin(beta) - y * math.cos(beta), down if water.dip >= 0 else -down
