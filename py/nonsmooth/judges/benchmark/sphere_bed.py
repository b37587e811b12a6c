"""A bed of spheres between walls on which steps in space are timed: at rest, on the move, and both on soft contacts;
saved as scenes, so that every measurement begins with the same places.

Spheres fall from a loose lattice between four walls and come to rest on hard contacts. On the move: one wall is taken
away, and the bed collapses for the time that a free fall takes from its top to the floor. Soft: FrictMat and
Law2_ScGeom_FrictPhys_CundallStrack in the places of a hard state and with its velocities, after so many steps that
gaps have closed and springs have taken up the weight. These springs have no resistance to rolling, and so cost less
than ones that have.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from yade import O, utils
from yade import wrapper as w

from ...records import checkpoints
from ...running.kept_runs import Progress
from ...studies.slope.states import BenchmarkError
from ...world import space
from ...world.scene import contact_dynamics
from ...world.stepping import advance, until

__all__ = [
    "HARD",
    "NAMES",
    "SPHERES",
    "YOUNGS",
    "Packed",
    "hard_scene",
    "load",
    "load_packed",
    "make",
    "soft_scene",
    "softened",
    "tiled",
]

SPHERES = 8000  # of the bed
SMALLEST, LARGEST = 0.8, 1.0  # diameters [m], uniform
DENSITY, FRICTION, ROLLING, TWISTING = 2600.0, 0.5, 0.02, 0.02
GRAVITY = 9.81
STEP = 5e-3  # s, of hard contacts
YOUNGS = (1e9, 10e9)  # Pa, of soft ones
DAMPING = 0.2  # of soft contacts, YADE's own usual one
STEP_SHARE = 0.5  # of the P-wave's time step
SOFT_STEPS = 300  # before a soft state is saved
HARD = ("rest", "moving")


def softened(name, young):
    """Name of the hard state ``name`` on soft contacts of this Young's modulus [Pa]."""
    return f"soft_{name}_{young:.0e}"


#: All states.
NAMES = (*HARD, *(softened(name, young) for name in HARD for young in YOUNGS))

LAYERS_OVER_SIDE = 1.2  # of the lattice from which spheres fall, in spheres
SPACING = 1.1  # m, of that lattice
ASIDE = 0.04  # m, at most, of a sphere beside its place in the lattice
REST_SPEED = 0.02  # mean speed that counts as rest [m/s]; a free fall over a diameter ends with 4
REST_SECONDS = 1.0  # of simulation after that
SETTLE_SECONDS = 30.0  # of simulation, by which a bed must have come to rest
LOOK = 20  # steps between two looks
KEY = "a bed of spheres"
PACKED = "packed.npz"


@dataclass(frozen=True)
class Packed:
    """Spheres between walls: ``at`` (n, 3), ``r`` (n,) [m]; ``sides``: lengths [m] along x and y, the walls standing at
    0 and there, and the floor at z = 0."""

    at: np.ndarray
    r: np.ndarray
    sides: tuple[float, float]


def poured(count, seed=1) -> Packed:
    """So many spheres in a loose lattice, none touching another."""
    side = max(1, round((count / LAYERS_OVER_SIDE) ** (1 / 3)))
    rng = np.random.default_rng(seed)
    k = np.arange(count)
    at = SPACING * np.column_stack((k % side, k // side % side, k // side**2)) + 0.5 * SPACING
    at[:, :2] += rng.uniform(-ASIDE, ASIDE, (count, 2))
    return Packed(at, 0.5 * rng.uniform(SMALLEST, LARGEST, count), (SPACING * side, SPACING * side))


def tiled(bed, count) -> Packed:
    """``count`` spheres of copies of a Packed bed beside each other along x and y, the highest left out."""
    copies = math.ceil(count / len(bed.r))
    along = max(1, math.isqrt(copies))
    across = math.ceil(copies / along)
    shifts = np.array([(i * bed.sides[0], j * bed.sides[1], 0.0) for i in range(along) for j in range(across)])
    at = (bed.at[:, None] + shifts).reshape(-1, 3)
    low = np.sort(np.argsort(at[:, 2], kind="stable")[:count])
    sides = (along * bed.sides[0], across * bed.sides[1])
    return Packed(at[low], np.repeat(bed.r, len(shifts))[low], sides)


def _fill(material, walls, at, r):
    O.reset()
    O.materials.append(material)
    for place, axis, sense in walls:
        O.bodies.append(utils.wall(place, axis=axis, sense=sense, material=material))
    first = len(O.bodies)
    for place, radius in zip(at.tolist(), r.tolist()):
        O.bodies.append(utils.sphere(place, radius, material=material))
    return first


def hard_scene(packed):
    """The Packed spheres and their walls on hard contacts, as YADE's scene; returns its ContactDynamicsEngine. The last
    wall is the one that may be taken away.
    """
    x, y = packed.sides
    material = w.NscdMat(
        density=DENSITY, frictionAngle=math.atan(FRICTION), rollingFriction=ROLLING, twistingFriction=TWISTING
    )
    _fill(material, [(0, 2, 1), (0, 1, 1), (y, 1, -1), (0, 0, 1), (x, 0, -1)], packed.at, packed.r)
    O.engines = space.engines(gravity=(0, 0, -GRAVITY))
    O.dt = STEP
    return contact_dynamics()


def soft_scene(young):
    """The present scene on soft contacts of Young's modulus ``young`` [Pa]: the same walls, places and velocities."""
    walls = [(b.state.pos[b.shape.axis], b.shape.axis, b.shape.sense) for b in O.bodies if isinstance(b.shape, w.Wall)]
    spheres = [b for b in O.bodies if isinstance(b.shape, w.Sphere)]
    at = np.array([tuple(b.state.pos) for b in spheres])
    r = np.array([b.shape.radius for b in spheres])
    motion = [(b.state.vel, b.state.angVel) for b in spheres]
    material = w.FrictMat(density=DENSITY, young=young, poisson=0.3, frictionAngle=math.atan(FRICTION))
    first = _fill(material, walls, at, r)
    for k, (velocity, spin) in enumerate(motion, first):
        O.bodies[k].state.vel, O.bodies[k].state.angVel = velocity, spin
    O.engines = [
        w.ForceResetter(),
        w.InsertionSortCollider([w.Bo1_Sphere_Aabb(), w.Bo1_Wall_Aabb()]),
        w.InteractionLoop(
            [w.Ig2_Sphere_Sphere_ScGeom(), w.Ig2_Wall_Sphere_ScGeom()],
            [w.Ip2_FrictMat_FrictMat_FrictPhys()],
            [w.Law2_ScGeom_FrictPhys_CundallStrack()],
        ),
        w.NewtonIntegrator(damping=DAMPING, gravity=(0, 0, -GRAVITY)),
    ]
    O.dt = STEP_SHARE * utils.PWaveTimeStep()


def make(folder, spheres):
    """Makes all states of a bed of so many spheres in ``folder``, and keeps its places at rest; a function for
    processes.call. Returns how long the settling took, and what has become of the bed.

    Raises BenchmarkError where it does not come to rest.
    """
    folder, note = Path(folder), Progress(folder)
    packed = poured(spheres)
    solver = hard_scene(packed)
    settled = until(
        lambda: O.time > 1 and solver.meanSpeed < REST_SPEED,
        round(SETTLE_SECONDS / STEP),
        LOOK,
        partial(_stepped, note),
    )
    if not settled:
        raise BenchmarkError(
            f"{spheres} spheres do not come to rest (mean speed {solver.meanSpeed:.2g} m/s after {O.time:.1f} s); take another number of them"
        )
    fallen_s = O.time
    advance(round(REST_SECONDS / STEP), view=False)
    solver.view()
    at = np.array([tuple(b.state.pos) for b in O.bodies if isinstance(b.shape, w.Sphere)])
    np.savez(folder / PACKED, at=at, r=packed.r, sides=packed.sides)
    checkpoints.write(folder / "rest", KEY, {})
    height = float((at[:, 2] + packed.r).max())
    O.bodies.erase(max(b.id for b in O.bodies if isinstance(b.shape, w.Wall)))
    advance(math.ceil(math.sqrt(2 * height / GRAVITY) / STEP), view=False)
    checkpoints.write(folder / "moving", KEY, {})
    for name in HARD:
        for young in YOUNGS:
            load(folder, name)
            soft_scene(young)
            advance(SOFT_STEPS, view=False)
            checkpoints.write(folder / softened(name, young), KEY, {})
    return {"settled_s": fallen_s, "height_m": height, "sides_m": list(packed.sides), "spheres": spheres}


def _stepped(note, steps):
    advance(steps, view=False)
    note(min(0.5, O.time / 10))


def load(folder, name):
    """Loads the state ``name``, of NAMES, that :func:`make` has left in ``folder``. Raises BenchmarkError where it is
    missing or damaged.
    """
    checkpoints.read(Path(folder) / name, KEY, BenchmarkError, "run again")


def load_packed(folder) -> Packed:
    """The bed at rest that :func:`make` has left in ``folder``."""
    with np.load(Path(folder) / PACKED) as kept:
        return Packed(kept["at"], kept["r"], tuple(kept["sides"].tolist()))
