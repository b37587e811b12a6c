"""The scene of Spheres in a world: walls, spheres, engines; and what is read of it."""

from __future__ import annotations

from dataclasses import asdict, dataclass

import numpy as np

from yade import O, utils
from yade.wrapper import RotationEngine

from .places import Places
from .walls import RoundWalls

__all__ = ["FRICTIONS", "Bodies", "contacts", "kinetic_energy", "open_gate", "places", "put", "take_out"]

FRICTIONS = ("friction", "rolling_friction", "twisting_friction")  # of a scene and of its material


@dataclass
class Bodies:
    """Ids in a scene: ``first`` sphere and their ``count`` (consecutive at the beginning), ``gate`` and ``turning``
    walls, lists.
    """

    first: int
    count: int
    gate: list
    turning: list

    def plain(self):
        """As JSON holds it."""
        return asdict(self)


def put(scene, world, at, r, top, still=False):
    """Fills YADE's scene anew with walls and spheres in a world, and sets engines and step; returns the
    :class:`Bodies`.

    ``at`` (n, 3), ``r`` (n,) [m]: of the spheres; ``top`` [m]: how high an open container is, of
    a test the edges of its cell (3,); ``still``: the gate's walls and those that turn stay, and impacts give nothing back.
    """
    stuff = scene.material()
    if still:
        stuff = type(stuff)(**{**asdict(stuff), "restitution": 0.0})
    O.reset()
    grains, rough, smooth = (O.materials[O.materials.append(world.material(m))] for m in (stuff, stuff, stuff.smooth()))
    walls = RoundWalls()
    scene.stand(walls, top)
    groups = {"wall": [], "gate": [], "turning": []}
    for corners, without, group in walls.facets:
        groups[group].append(
            O.bodies.append(utils.facet([tuple(map(float, c)) for c in corners], material=smooth if without else rough))
        )
    for centre, half, without, group in walls.boxes:
        groups[group].append(
            O.bodies.append(utils.box(centre, half, fixed=True, material=smooth if without else rough))
        )
    first = len(O.bodies)
    for place, radius in zip(at, r):
        O.bodies.append(utils.sphere(tuple(map(float, place)), float(radius), material=grains))
    turning = []
    if groups["turning"] and not still:
        turning = [
            RotationEngine(
                ids=groups["turning"],
                rotationAxis=(0, 1, 0),
                angularVelocity=scene.turning(),
                rotateAroundZero=True,
                zeroPoint=(0, 0, 0),
                dead=True,  # until the release
                label="turning",
            )
        ]
    # walls that are moved get their velocities before the contacts of a step are solved
    O.engines = world.engines(gravity=(0, 0, -scene.gravity), before=turning)
    O.dt = world.step_for([stuff])
    return Bodies(first, len(r), groups["gate"], groups["turning"])


def open_gate(bodies):
    """Takes the gate away, and sets what turns in motion."""
    for i in bodies.gate:
        O.bodies.erase(i)
    bodies.gate.clear()
    for engine in O.engines:
        if isinstance(engine, RotationEngine):
            engine.dead = False


def places(bodies, time_s=0.0, step=0):
    """The Places of the spheres that are there."""
    there = [(i - bodies.first, b) for i in range(bodies.first, bodies.first + bodies.count) if (b := O.bodies[i])]
    at = np.array([tuple(b.state.pos) for _, b in there], float).reshape(-1, 3)
    speed = np.array([b.state.vel.norm() for _, b in there], float)
    r = np.array([b.shape.radius for _, b in there], float)
    return Places(at, r, np.array([k for k, _ in there], int), speed, float(time_s), int(step))


def contacts(bodies):
    """The contacts of the spheres, arrays: ``first``, ``second`` int (n,), spheres from 0 on and walls below 0;
    ``normal`` (n,) and ``force`` (n, 3) [N], on the second by the first; ``branch`` (n, 3) [m] from the first one's
    centre to the second's, with the point of the contact for the centre of a wall.
    """
    rows = []
    for i in O.interactions:
        if i.isReal and (normal := i.phys.normalForce).squaredNorm() > 0:
            ends = [k - bodies.first if k >= bodies.first else -1 - k for k in (i.id1, i.id2)]
            a, b = (O.bodies[k].state.pos if k >= bodies.first else i.geom.contactPoint for k in (i.id1, i.id2))
            rows.append((*ends, normal.norm(), *(normal + i.phys.shearForce), *(b - a)))
    rows = np.array(sorted(rows), float).reshape(-1, 9)  # YADE's order changes with the file of a checkpoint
    first, second = rows[:, :2].T.astype(int)
    return {"first": first, "second": second, "normal": rows[:, 2], "force": rows[:, 3:6], "branch": rows[:, 6:]}


def kinetic_energy(bodies):
    """Of all spheres that are there, turning included [J]."""
    total = 0.0
    for i in range(bodies.first, bodies.first + bodies.count):
        b = O.bodies[i]
        if b is not None:
            total += 0.5 * (
                b.state.mass * b.state.vel.squaredNorm() + b.state.inertia[0] * b.state.angVel.squaredNorm()
            )
    return total


def take_out(bodies, height):
    """Erases the spheres below a ``height`` [m]; (how many, their mass [kg])."""
    gone = [
        b
        for i in range(bodies.first, bodies.first + bodies.count)
        if (b := O.bodies[i]) is not None and b.state.pos[2] < height
    ]
    mass = sum(b.state.mass for b in gone)
    for b in gone:
        O.bodies.erase(b.id)
    return len(gone), float(mass)
