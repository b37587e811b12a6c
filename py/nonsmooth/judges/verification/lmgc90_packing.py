"""The packing at rest by LMGC90 (``tests/data``): its arrays, the YADE scene of the step that was written out, and sums
over contacts.

Signs. LMGC90's contact has n from j to i and t = (n_y, −n_x), and its force acts on i. Ours runs from the lower disk to
the higher, from the wall to the disk, with t = n turned by +90°. All of LMGC90's pairs have i < j, walls last, so in
our frame N = fn, T = −ft, U^n = vn, U^t = −vt.

Times. LMGC90 (θ = 1/2) looks at the contacts where they are in the middle of the step, x + h/2 v, and allows gap + h vn
≥ 0 there. That is our step (θ = 1) begun at x + h/2 v, and it stays so from step to step: both move that point by h
v⁺."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from yade import O
from yade.wrapper import NscdMat

from ... import contact
from ...world import scene
from ...world.scene import contact_dynamics as engine

# number of disks; ids of the walls, in our scene and, less one, in LMGC90
DISKS, FLOOR, LEFT, RIGHT = (5000, 5000, 5001, 5002)
WIDTH, HEIGHT = 409.59035, 91.2221  # of the box [m]
TILT = (
    2.6794896585028633e-08  # of the sides about the middle of their height, outwards [rad]: LMGC90 reads rounded input
)
DENSITY, G, MU, H = 2500.0, 9.81, 0.3, 5e-3  # [kg/m³], [m/s²], -, [s]
ALERT = 0.05  # LMGC90 knows contacts up to this gap [m]
DATA = Path(__file__).resolve().parents[4] / "tests" / "data"


@dataclass(frozen=True)
class Dump:
    """LMGC90's step. Disks: arrays of length 5,000; contacts: of length 10,531, in LMGC90's order, frame and signs."""

    x: np.ndarray  # beginning of the step [m]
    y: np.ndarray
    r: np.ndarray
    velocity: np.ndarray  # (n, 3): beginning of the step [m/s, m/s, rad/s]
    velocity_end: np.ndarray  # (n, 3): its end
    pair: np.ndarray  # (c, 2) int: disk, disk or wall, as ids of our scene
    fn: np.ndarray  # [N]
    ft: np.ndarray
    gap_end: np.ndarray  # at the end of the step [m]
    vn: np.ndarray  # [m/s]
    vt: np.ndarray

    @property
    def mass(self):
        """Masses of the disks [kg/m], (n,)."""
        return DENSITY * math.pi * self.r**2

    @property
    def weight(self):
        """Of all disks [N]."""
        return G * self.mass.sum()

    @property
    def middle(self):
        """(n, 2): where LMGC90 looks at the contacts [m]."""
        return np.c_[self.x, self.y] + 0.5 * H * self.velocity[:, :2]


def load() -> Dump:
    """Reads the step; raises FileNotFoundError saying where the files are where there is no checkout around this
    package.
    """
    disks, contacts = DATA / "lmgc90_5000_disks.txt.gz", DATA / "lmgc90_5000_contacts.txt.gz"
    for path in (disks, contacts):
        if not path.exists():
            raise FileNotFoundError(
                f"{path} is missing: the packing by LMGC90 is part of the source repository (tests/data); run from a checkout"
            )
    d, c = np.loadtxt(disks), np.loadtxt(contacts)
    return Dump(d[:, 0], d[:, 1], d[:, 2], d[:, 3:6], d[:, 6:9], c[:, :2].astype(int) - 1, *c[:, 2:].T)


def build(dump: Dump, **options):
    """The step's beginning as the scene of YADE: disks are ids 0 to 4,999, then floor, left and right side; returns the
    engine.

    ``options``: attributes of ContactDynamicsEngine. The share of an overlap that a step takes back is 0 unless given,
    as in LMGC90.
    """
    stuff = NscdMat(density=DENSITY, frictionAngle=math.atan(MU))
    O.materials.append(stuff)
    O.bodies.append([scene.disk(c, r, stuff) for c, r in zip(dump.middle, dump.r)])
    lean = 0.5 * HEIGHT * TILT
    for a, b in (((0, 0), (WIDTH, 0)), ((-lean, HEIGHT), (lean, 0)), ((WIDTH - lean, 0), (WIDTH + lean, HEIGHT))):
        O.bodies.append(scene.segments([a, b], stuff, sense=1))
    for body, v in zip(O.bodies, dump.velocity.tolist()):
        body.state.vel = (v[0], v[1], 0)
        body.state.angVel = (0, 0, v[2])
    O.engines = scene.engines(gravity=(0, -G, 0), **{"relaxationRate": 0, "maxIterations": 20000, **options})
    O.dt = H
    return engine()


def warm_start(dump: Dump):
    """Gives the interactions of the scene just built LMGC90's forces; makes them by a step, after which the disks are
    put back.
    """
    solver = engine()
    tolerance, solver.tolerance = solver.tolerance, 1e3  # the step's own solution is not wanted
    O.step()
    solver.tolerance = tolerance
    for body, (x, y), (vx, vy, w) in zip(O.bodies, dump.middle.tolist(), dump.velocity.tolist()):
        body.state.pos, body.state.vel, body.state.angVel = (x, y, 0), (vx, vy, 0), (0, 0, w)
    for i in O.interactions:
        if i.isReal:
            i.phys.normal = i.phys.tangential = 0
    for (a, b), fn, ft in zip(dump.pair.tolist(), dump.fn.tolist(), dump.ft.tolist()):
        phys = O.interactions[a, b].phys
        phys.normal, phys.tangential = fn, -ft


def dump_step(path) -> contact.ContactProblem:
    """The contact problem of the scene's last step."""
    engine().dump(str(path))
    return contact.load(path)


def step_problem(folder):
    """LMGC90's step, our contact problem for it, and LMGC90's forces as impulses of that, shape (c, 3). Leaves no
    scene, and ``folder/step.h5``.
    """
    dump = load()
    build(dump, tolerance=1e-3)
    O.step()
    problem = dump_step(Path(folder) / "step.h5")
    O.reset()
    return dump, problem, impulses_of(dump, problem)[0]


def pair_keys(pairs) -> np.ndarray:
    """One number a pair of ids, whichever comes first."""
    pairs = np.asarray(pairs, np.int64)
    return pairs.min(axis=1) * 10**6 + pairs.max(axis=1)


def impulses_of(dump: Dump, problem: contact.ContactProblem):
    """LMGC90's forces as impulses of our problem, shape (c, 3), and for each of its contacts the index of ours.

    Raises ValueError if one is missing."""
    ours, theirs = pair_keys(problem.body), pair_keys(dump.pair)
    order = np.argsort(ours)
    at = order[np.searchsorted(ours, theirs, sorter=order).clip(max=len(ours) - 1)]
    missing = np.flatnonzero(ours[at] != theirs)
    if len(missing):
        raise ValueError(
            f"{len(missing)} of LMGC90's contacts are not in our problem, the first between {dump.pair[missing[0]] + 1}"
        )
    impulse = np.zeros((len(ours), 3))
    impulse[at, 0], impulse[at, 1] = H * dump.fn, -H * dump.ft
    return impulse, at


def with_radius_levers(problem: contact.ContactProblem, dump: Dump) -> contact.ContactProblem:
    """The same problem with LMGC90's levers, the radii, where ours reach to the middle of the gap."""
    radius = np.r_[dump.r, np.zeros(3)]
    lever = problem.lever.copy()
    i, j = problem.body.T
    lever[:, 1] = np.where(i < DISKS, radius[i], lever[:, 1])
    lever[:, 3] = np.where(j < DISKS, -radius[j], lever[:, 3])
    return replace(problem, lever=lever)


def relative_velocities(problem: contact.ContactProblem, velocity) -> np.ndarray:
    """(U^n, U^t, w) of every contact for velocities of shape (b, 3), shape (c, 3); by the formulas of problem.hpp,
    written again.
    """
    i, j = problem.body.T
    d, (nx, ny), l = velocity[j] - velocity[i], problem.normal.T, problem.lever
    wi, wj = velocity[i, 2], velocity[j, 2]
    return np.c_[
        nx * d[:, 0] + ny * d[:, 1] + l[:, 2] * wj - l[:, 0] * wi,
        nx * d[:, 1] - ny * d[:, 0] + l[:, 3] * wj - l[:, 1] * wi,
        d[:, 2],
    ]


def body_impulses(problem: contact.ContactProblem, impulse) -> np.ndarray:
    """Hᵀ P, shape (b, 3): what the contacts give to each body, walls included [N s, N s, N m s]."""
    i, j = problem.body.T
    (nx, ny), l, (n, t, r) = problem.normal.T, problem.lever, np.asarray(impulse).T
    force = np.c_[nx * n - ny * t, ny * n + nx * t]
    sums = np.zeros((len(problem.inverse_mass), 3))
    np.add.at(sums, j, np.c_[force, l[:, 2] * n + l[:, 3] * t + r])
    np.add.at(sums, i, -np.c_[force, l[:, 0] * n + l[:, 1] * t + r])
    return sums


def carried(problem, impulse) -> float:
    """Downward impulse on the bodies that cannot move [N s], for impulses of shape (c, 3); of any problem."""
    fixed = ~np.any(problem.inverse_mass, axis=1)
    return float(-body_impulses(problem, impulse)[fixed, 1].sum())


def velocities_of(problem: contact.ContactProblem, impulse) -> np.ndarray:
    """v_free + M⁻¹ Hᵀ P, shape (b, 3)."""
    return problem.free_velocity + problem.inverse_mass * body_impulses(problem, impulse)


@dataclass(frozen=True)
class Balance:
    """What carries the packing in a step, as shares of its weight."""

    floor: float
    sides: float  # by friction, upwards
    falling: float  # momentum that the disks gain in the step, downwards, over what the weight gives in a step

    @property
    def carried(self):
        """Force that floor and sides bear together [N/m]."""
        return self.floor + self.sides


def balance(dump: Dump, problem: contact.ContactProblem, impulse) -> Balance:
    """Sums of impulses of shape (c, 3) over the walls, and the momentum that they leave."""
    sums, weight = body_impulses(problem, impulse), H * dump.weight
    falling = -(dump.mass * (velocities_of(problem, impulse)[:DISKS, 1] - dump.velocity[:, 1])).sum()
    return Balance(
        float(-sums[FLOOR, 1] / weight), float(-(sums[LEFT, 1] + sums[RIGHT, 1]) / weight), float(falling / weight)
    )
