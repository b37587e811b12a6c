"""Builds a section with its packing as a YADE scene, of rigid disks or, in another of the :mod:`worlds`, of soft
ones.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from yade import O
from yade.minieigenHP import Vector3
from yade.wrapper import ContactDynamicsEngine, NonsmoothTimeStepper, PorePressureEngine

from ...model import scales
from ...world import scene, shaking, worlds

__all__ = ["Slope", "build", "find", "hard", "is_hard", "order_of", "set_strengths"]

# A wall piece of this many mean diameters keeps its bounding box small and the pieces few.
PIECE = 8.0
REACH = 0.05  # gap [ℓ] up to which they are known in any case
# ℓ, overlaps and errors of bonds' lengths that stay: what is taken back below opens and shuts contacts, whose forces
# must be found anew in each step
SLACK = 1e-3
SHORTEST_STEP = 0.1  # of a section's time step, however fast its disks are
STEP_GROWTH = 1.2  # one bond that is torn apart shortens a step, and should not shorten the next dozen


@dataclass
class Slope:
    """Handles of a built scene. ``walls``: name -> ids of its pieces; ``first_disk``: id of disk 0 (ids are
    consecutive).

    ``solver``: what tells of the contacts and makes bonds: the ContactDynamicsEngine, or with soft contacts
    :class:`~.soft.measures.Measures`.
    """

    section: object
    walls: dict
    first_disk: int
    count: int
    solver: object
    water: object  # PorePressureEngine or None
    shaking: object = None  # GroundMotionEngine or None

    def wall_material(self, name):
        """Material of a wall."""
        return O.bodies[self.walls[name][0]].material


def _walls(section, world):
    """Adds the walls, from the crown's side on; consecutive ones that meet share their joint as pieces of one polyline
    do.
    """
    piece, backwards = PIECE * math.sqrt(section.disks.mean_square), section.side < 0
    ids, last = {}, None
    for wall in reversed(section.walls) if backwards else section.walls:
        material = O.materials[
            O.materials.append(world.wall_material(section.materials[wall.material], label=f"wall-{wall.name}"))
        ]
        bodies = scene.segments(wall.points, material, piece=piece, sense=1, backwards=backwards)
        start, end = (wall.points[0], wall.points[-1])[:: -1 if backwards else 1]
        if last is not None and np.allclose(last[1], start, rtol=0, atol=section.tolerance):
            along = bodies[0].state.ori * Vector3(1, 0, 0)
            scene.join(last[0], bodies[0], last[0].state.ori.conjugate() * along, backwards)
        ids[wall.name] = list(O.bodies.append(bodies))
        last = (bodies[-1], end)
    return {wall.name: ids[wall.name] for wall in section.walls}


def hard(section, slack=SLACK) -> worlds.Hard:
    """The world of rigid disks with the section's numerics; ``slack``: overlaps and errors of bonds' lengths that stay
    [ℓ].
    """
    n = section.numerics
    # bonds are made where contacts are known, so these must reach further than Δ
    reach = max(REACH, 0.01 + max(m.bond_creation_distance for m in section.materials.values()))
    # known early enough for disks that approach each other at such a speed; the fastest of the paper's slope reach 50
    # m/s
    speeds = scales.of(section)
    far = speeds.approach_speed * n.time_step / section.smallest
    return worlds.Hard(
        n.time_step,
        n.tolerance,
        reach,
        far,
        -n.verlet_distance,
        {"maxIterations": n.max_iterations, "correctionSlack": slack, "correctionSpeed": speeds.correction_speed},
    )


def order_of(section, packing) -> np.ndarray:
    """Numbers of the packing's disks in the order of their ids in the scene: along the slope, so that neighbours in
    space are neighbours in memory.
    """
    return np.argsort(packing.x * section.downslope[0] + packing.y * section.downslope[1], kind="stable")


def build(section, packing, world=None) -> Slope:
    """Fills the (empty) scene with walls, disks and engines; the disks are at rest and nothing is bonded yet.

    ``section``: a checked Section; ``packing``: a Packing whose layers are the section's; ``world``: one of
    :mod:`worlds`, :func:`hard` unless given. Raises WorldError for what is no world, and for interfaces in one that has
    none.
    """
    world = hard(section) if world is None else worlds.check(world)
    O.reset()
    walls = _walls(section, world)
    rocks = [section.materials[layer.material] for layer in section.layers]
    materials = [
        O.materials[O.materials.append(world.material(m, layer=k, label=_label(layer, k)))]
        for k, (layer, m) in enumerate(zip(section.layers, rocks))
    ]
    for interface in section.interfaces:
        world.interface(*(materials[k] for k in section.numbers_of(interface)), section.materials[interface.material])
    order = order_of(section, packing)
    disks = [
        scene.disk((float(packing.x[k]), float(packing.y[k])), float(packing.r[k]), materials[packing.layer[k]])
        for k in order
    ]
    ids = O.bodies.append(disks)
    before = []
    if section.water is not None:
        before.append(
            PorePressureEngine(
                label="porePressure",
                unitWeight=section.water.unit_weight,
                releaseDistance=section.release_distance,
                volumeFactor=1.0 if section.water.volume == "disk" else 1 / section.disks.packing_fraction,
                **_table(section),
            )
        )
    if section.shaking is not None:
        shaken = shaking.ground_motion(section.shaking.motion)
        shaken.dead = True  # until t0
        before.append(shaken)
    O.engines = world.engines(gravity=(0, -section.gravity, 0), before=before)
    n = section.numerics
    if world.name == "hard" and n.path:
        O.engines = [
            NonsmoothTimeStepper(
                label="timeStepper",
                smallest=SHORTEST_STEP * n.time_step,
                largest=n.time_step,
                path=n.path,
                growth=STEP_GROWTH,
            ),
            *O.engines,
        ]
    O.dt = world.step_for(rocks)
    built = find(section, walls, ids[0], len(ids))
    layer = packing.layer[order]
    built.solver = world.measures([(m, (ids[0] + np.flatnonzero(layer == k)).tolist()) for k, m in enumerate(rocks)])
    return built


def _table(section):
    """Attributes of the PorePressureEngine: those of a water table; of a field, which comes at t0, the normal to the
    way downslope alone.
    """
    w = section.water_table
    if w is None:
        return {"planeNormal": Vector3(*section.normal, 0)}
    return {
        "planePoint": Vector3(*w.point, 0),
        "planeNormal": Vector3(*w.normal, 0),
        "pressureGradient": Vector3(*w.pressure_gradient_xy, 0),
    }


def interface_law(slope: Slope, interface):
    """The material of an interface of a built Slope."""
    lower, upper = (O.materials[_label(slope.section.layers[k], k)] for k in slope.section.numbers_of(interface))
    return lower.interfaceLaws[list(lower.interfaceLayers).index(upper.layer)]


def is_hard(slope: Slope) -> bool:
    """Whether the disks of a built Slope are rigid."""
    return isinstance(slope.solver, ContactDynamicsEngine)


def set_strengths(slope: Slope, materials, world=None):
    """Gives walls, disks and interfaces of a built Slope, and all of its contacts, the strengths of ``materials``,
    {name: section.Material}, which have those of the section's names; ``world``: that it was built in.
    """
    section = slope.section
    pairs = [(slope.wall_material(wall.name), materials[wall.material]) for wall in section.walls]
    pairs += [(O.materials[_label(layer, k)], materials[layer.material]) for k, layer in enumerate(section.layers)]
    pairs += [(interface_law(slope, one), materials[one.material]) for one in section.interfaces]
    (hard(section) if world is None else world).set_strengths(pairs)


def find(section, walls, first_disk, count) -> Slope:
    """Handles of a scene that is there already, as after O.load."""
    engines = {type(e).__name__: e for e in O.engines}
    return Slope(
        section,
        walls,
        first_disk,
        count,
        engines.get("ContactDynamicsEngine"),
        engines.get("PorePressureEngine"),
        engines.get("GroundMotionEngine"),
    )


def _label(layer, number):
    return f"{layer.material}-{number}"


def layers_of(slope: Slope) -> np.ndarray:
    """Layer number of every disk, from the bottom, −1 of those that are gone; shape (count,)."""
    number = {_label(layer, k): k for k, layer in enumerate(slope.section.layers)}
    bodies = (O.bodies[slope.first_disk + k] for k in range(slope.count))
    return np.array([-1 if body is None else number[body.material.label] for body in bodies])
