"""Disks at rest in the box on the floor, with hard contacts; made once and kept, so that both worlds begin with the
same places.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from yade import O
from yade.wrapper import ContactDynamicsEngine

from ... import packing
from ...system import cache, keys
from ...world import scene, tables, worlds
from ...world.stepping import until
from .grains import HeapError, sizes_along

__all__ = ["Prepared", "Stand", "cache_path", "disk_table", "prepared", "put"]

CACHE = cache.Cache("heaps", packing.Packing)

STEP = 0.05  # √(d/g)
TOLERANCE = 1e-5
SLACK = 1e-5  # ℓ, overlaps that stay; ten times as large ones would push springs, which begin with these places
REST_SPEED = 5e-3  # √(g d), rms; the solver creeps on at about half of it
LIMIT = 20_000  # steps
LOOSEST = 0.7  # packing fraction, the least that is tried
CHUNK = 200
# heights of the box beside it: glued disks, and the floor; what falls from the top at once rolls 13 in 6.5 T
ROUGH_REACH, FLOOR_REACH = (6.0, 15.0)


@dataclass(frozen=True, eq=False)
class Prepared:
    """Disks at rest in the box: centres ``x``, ``y`` and radii ``r`` [m], arrays of length n; ``width`` L₀ of the box
    and ``height`` H₀ of the disks [m].

    H₀ is twice the height of the centre of mass over the floor, which is that of the surface of a level column.
    """

    x: np.ndarray
    y: np.ndarray
    r: np.ndarray
    width: float
    height: float


@dataclass(frozen=True, eq=False)
class Stand:
    """Bodies of a scene: ids of ``disks`` (consecutive), ``base`` (glued disks), ``walls``, and ``gates`` (sides that
    can be taken away).
    """

    disks: list
    base: list
    walls: list
    gates: list


def cache_path(heap):
    """Where the prepared disks of a heap are kept. Neither restitution nor wall friction matter to them;
    engines and code do, so that a run has the same bits with and without a cache from earlier ones."""
    plain = {k: v for k, v in heap.plain().items() if k not in ("restitution", "wall_friction")}
    return CACHE.path(keys.key_of([plain, keys.making_key(__name__)]))


def prepared(heap):
    """The heap's disks at rest, from the cache or made in the running scene, which is emptied.

    They are packed just short of touching (or taken from the file) and settle between walls without friction. Raises
    PackingError, SampleError or HeapError where that cannot be done.
    """
    kept, (width, _) = CACHE.of(cache_path(heap), lambda: _settle(heap)), heap.box()
    area = kept.r**2
    return Prepared(kept.x, kept.y, kept.r, width, 2 * float(np.sum(area * kept.y) / np.sum(area)))


def _settle(heap):
    if heap.packing:
        made = heap.read()
        x, y, r = made.x - np.min(made.x - made.r) + heap.place(), made.y - np.min(made.y - made.r), made.r
    else:
        made = _packed(heap.shape().section())
        x, y, r = made.x + heap.place(), made.y, made.r
    order = np.argsort(x, kind="stable")  # neighbours in space are neighbours in memory
    fall = math.sqrt(heap.mean_diameter() / heap.gravity)
    world = worlds.Hard(time_step=STEP * fall, tolerance=TOLERANCE, options={"correctionSlack": SLACK})
    stand = put(heap, world, x[order], y[order], r[order], still=True)
    wanted = REST_SPEED * math.sqrt(heap.gravity * heap.mean_diameter())

    def speed():
        t = disk_table(stand)
        return math.sqrt(np.mean(t["vx"] ** 2 + t["vy"] ** 2))

    if not until(lambda: speed() <= wanted, LIMIT, CHUNK):
        raise HeapError(
            f"the disks do not come to rest in their box: rms speed {speed():.2g} m/s after {O.iter} steps, wanted {wanted:.2g} m/s; try another seed"
        )
    t = disk_table(stand)
    found = packing.Packing(t["x"], t["y"], t["r"], np.zeros(len(x)))
    O.reset()
    return found


def _packed(section):
    """A packing of the box; where its disks do not fit, as in small boxes, some per cent fewer."""
    fraction = section.disks.packing_fraction
    while True:
        try:
            return packing.cached_pack(replace(section, disks=replace(section.disks, packing_fraction=fraction)))
        except packing.PackingError:
            fraction -= 0.02
            if fraction < LOOSEST:
                raise


def put(heap, world, x, y, r, still=False):
    """Fills the scene anew with walls, floor and disks in a world, and sets engines and step; returns the
    :class:`Stand`.

    ``still``: without restitution, and without friction at the walls.
    """
    grains, floor = heap.material(), heap.floor_material()
    if still:
        grains, floor = (replace(m, restitution=0.0) for m in (grains, floor))
    O.reset()

    def add(m):
        return O.materials[O.materials.append(m)]

    stuff, ground = add(world.material(grains)), add(world.wall_material(floor))
    side, held = (
        add(
            world.wall_material(
                replace(floor, friction=f, residual_friction=f, rolling_friction=0.0, residual_rolling_friction=0.0)
            )
        )
        for f in (0.0, 0.0 if still else heap.wall_friction)
    )
    width, height = heap.box()
    x0, largest = heap.place(), heap.diameters()[1]
    x1, top = x0 + width, 2 * height + largest
    # sense +1: a wall acts to the left of its direction of travel
    sides = {"left": [(x0, top), (x0, -largest)], "right": [(x1, -largest), (x1, top)]}
    walls, gates = [], []
    for name, ends in sides.items():
        if name in heap.gates():
            gates += O.bodies.append(scene.segments(ends, side, sense=1))
        else:
            walls += O.bodies.append(scene.segments(ends, held, sense=1))
    far_left, far_right = (x0 - FLOOR_REACH * height if "left" in heap.gates() else x0, x1 + FLOOR_REACH * height)
    base = []
    if heap.base == "smooth":
        walls += O.bodies.append(scene.segments([(far_left, 0), (far_right, 0)], ground, sense=1))
    else:
        glued = add(world.material(floor))
        starts = {"right": (x1 + ROUGH_REACH * height, 1.0)}
        if "left" in heap.gates():
            starts["left"] = (ROUGH_REACH * height - x0, -1.0)
        for name, (reach, sign) in starts.items():
            radii = sizes_along(heap, reach, name)
            centres = sign * (2 * np.cumsum(radii) - radii)
            base += O.bodies.append(
                [scene.disk((float(c), -float(a)), float(a), glued, fixed=True) for c, a in zip(centres, radii)]
            )
            end = sign * 2 * float(np.sum(radii))
            floor_ends = [(end, 0), (far_right, 0)] if sign > 0 else [(far_left, 0), (end, 0)]
            walls += O.bodies.append(scene.segments(floor_ends, ground, sense=1))
    disks = O.bodies.append([scene.disk((float(a), float(b)), float(c), stuff) for a, b, c in zip(x, y, r)])
    O.engines, O.dt = world.engines(gravity=(0, -heap.gravity, 0)), world.step_for([grains])
    return Stand(list(disks), list(base), list(walls), list(gates))


def disk_table(stand):
    """State of the disks, as :func:`yade.nonsmooth.tables.bodies` gives it, in either world."""
    t = tables.bodies(ContactDynamicsEngine())  # it reads the scene; it need not be one of its engines
    own = t["id"] >= stand.disks[0]
    return {name: values[own] for name, values in t.items()}
