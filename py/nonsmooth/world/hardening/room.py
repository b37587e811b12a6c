"""Whether rigid bodies have room where a script has put them."""

from __future__ import annotations

import numpy as np

from yade.wrapper import Box, Sphere

from .error import HardenError

__all__ = ["refuse_far_bonds", "refuse_wedged"]

_DEEP = 0.1  # radii, of a sphere in boxes on two opposite sides, which no motion undoes


def refuse_far_bonds(interactions, bodies, reach):
    """Raises HardenError for cohesive interactions of spheres that are farther apart than ``reach`` [ℓ], as a script
    makes them between the nodes of a rope: rigid bonds are made where bodies nearly touch.
    """
    by_id = {b.id: b for b in bodies}
    for i in interactions:
        one, other = by_id.get(i.id1), by_id.get(i.id2)
        if not i.isReal or getattr(i.phys, "cohesionBroken", True) or one is None or other is None:
            continue
        if isinstance(one.shape, Sphere) and isinstance(other.shape, Sphere):
            length = one.shape.radius + other.shape.radius
            gap = (one.state.pos - other.state.pos).norm() - length
            if gap > reach * length:
                raise HardenError(
                    f"interaction #{i.id1}+#{i.id2} holds spheres across a gap of {gap:.3g} m, {gap / length:.2g} of their mean diameter, and rigid bonds are made where bodies nearly touch: put spheres between them"
                )


def refuse_wedged(bodies, moving):
    """Raises HardenError for a sphere of ``moving`` that lies deep in boxes on opposite sides, as springs can hold
    it.
    """
    boxes = [b for b in bodies if isinstance(b.shape, Box) and b.bounded and not b.dynamic]
    if len(boxes) < 2 or not moving:
        return
    places = np.array([tuple(b.state.pos) for b in moving])
    radii = np.array([b.shape.radius for b in moving])
    normals, depths = zip(*(_into(box, places, radii) for box in boxes))
    for k in range(len(boxes)):
        for j in range(k):
            against = np.sum(normals[k] * normals[j], axis=1) < -0.9
            deep = np.minimum(depths[k], depths[j]) > _DEEP * radii
            if (against & deep).any():
                at = int(np.flatnonzero(against & deep)[0])
                raise HardenError(
                    f"sphere #{moving[at].id} lies in boxes #{boxes[j].id} and #{boxes[k].id} on opposite sides, {100 * min(depths[k][at], depths[j][at]) / radii[at]:.0f} % of its radius deep: springs can hold it there, and a rigid sphere has no room; move the boxes apart"
                )


def _into(box, places, radii):
    """Directions (n, 3) from a box's surface to spheres, and how deep (n,) [m] these lie in it, negative across a
    gap.
    """
    turn = np.array([tuple(box.state.ori.conjugate() * axis) for axis in np.eye(3)]).T
    back = (places - np.array(tuple(box.state.pos))) @ turn.T
    half = np.array(tuple(box.shape.extents))
    nearest = np.clip(back, -half, half)
    away = back - nearest
    far = np.linalg.norm(away, axis=1)
    inside = far == 0
    if inside.any():  # through the nearest side
        gaps = half - np.abs(back[inside])
        side = np.argmin(gaps, axis=1)
        rows = np.arange(len(side))
        out = np.zeros((len(side), 3))
        out[rows, side] = np.where(back[inside][rows, side] < 0, -1.0, 1.0)
        away[inside] = out
        far = far.copy()
        far[inside] = -gaps[rows, side]
    unit = away / np.linalg.norm(away, axis=1)[:, None]
    return unit @ turn, radii - far
