"""The course of a heap in a world: built at rest in its box, released, and followed until it rests."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field
from functools import cached_property

import numpy as np
from yade import O
from yade.wrapper import ContactDynamicsEngine, NewtonIntegrator

from ... import course as stages
from ...course import driver
from ...measure import heap as measures
from ...system import checks
from ...world import worlds
from ...world.stepping import advance, until
from . import preparation
from .columns import COLUMNS
from .grains import Heap, HeapError, hard

__all__ = ["COLUMNS", "HeapResult", "HeapScene", "build", "run"]

RECORDS = 20  # to T = √(H/g)
REST_SPEED = 0.02  # √(g d), rms speed of the connected disks at rest ...
REST_TIME = 0.5  # T, for so long
SETTLED_SPEED = 0.01  # √(g d), rms speed in the box before the release
SETTLE_LIMIT = 10.0  # T
DURATION = 15.0  # T
WEIGHT_OVERLAP = 0.05  # diameters, largest overlap under the heap's own weight that is let through
FRAMES = (0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0)  # T
FILM = 0.1  # T, between two frames of a video


@dataclass(frozen=True, eq=False)
class HeapScene:
    """A heap in the running scene: its parameters, its world, the disks as they were prepared, and the bodies' ids."""

    heap: Heap
    world: object
    prepared: preparation.Prepared
    stand: preparation.Stand

    def release(self):
        """Takes the gates away."""
        for i in self.stand.gates:
            O.bodies.erase(i)
        self.stand.gates.clear()

    def measure(self):
        """What a row of the series holds, from the scene as it is, but for ``step``, ``time_s`` and ``wall_s``; and
        which disks are connected, bool (n,).
        """
        t = preparation.disk_table(self.stand)
        x, y, r = t["x"], t["y"], t["r"]
        mass = self.heap.density * math.pi * r**2
        joined = measures.connected(x, y, r)
        left, right = measures.fronts(x, r, joined)
        kinetic = 0.5 * float(np.sum(mass * (t["vx"] ** 2 + t["vy"] ** 2 + 0.5 * (r * t["omega"]) ** 2)))
        mean, worst = measures.overlap(x, y, r, self._walls(x, y), self._glued)
        return {
            "front_m": right,
            "front_left_m": left,
            "farthest_m": float(np.max(x + r)),
            "height_m": float(np.max(measures.surface(x, y, r, joined)[1])),
            "centroid_x_m": float(np.average(x, weights=mass)),
            "centroid_y_m": float(np.average(y, weights=mass)),
            "energy_kinetic_J": kinetic,
            "energy_potential_J": self.heap.gravity * float(np.sum(mass * y)),
            "connected_disks": int(np.count_nonzero(joined)),
            "overlap_mean_rel": mean,
            "overlap_worst_rel": worst,
        }, joined

    def rms_speed(self, joined=slice(None)):
        """Root mean square of the disks' speed, in units of √(g d)."""
        t = preparation.disk_table(self.stand)
        return math.sqrt(
            np.mean((t["vx"] ** 2 + t["vy"] ** 2)[joined]) / (self.heap.gravity * self.heap.mean_diameter())
        )

    def _walls(self, x, y):
        """Distances of the disks from lines that are there."""
        place, width = self.heap.place(), self.prepared.width
        return [
            *([x - place] if "left" not in self.heap.gates() else []),
            *([place + width - x] if "right" not in self.heap.gates() else []),
            *([y] if self.heap.base == "smooth" else []),
        ]

    @cached_property
    def _glued(self):
        if not self.stand.base:
            return None
        bodies = [O.bodies[i] for i in self.stand.base]
        return tuple(
            np.array(column) for column in zip(*((b.state.pos[0], b.state.pos[1], b.shape.radius) for b in bodies))
        )


@dataclass(frozen=True, eq=False)
class HeapResult:
    """A run. ``heap``: its parameters; ``world``: name; ``settings``: of the world, a dictionary, with
    ``damping_moving`` if that was given.

    ``width``, ``height``: L₀ and H₀ [m] at rest in the box; for a pile L₀ is half of the box.
    ``series``: {name: array (rows,)} by :data:`COLUMNS`: step and time since the release; ``front_m``,
    ``front_left_m``: right and left edge of the connected disks (:func:`measures.connected`), ``farthest_m``: of any
    disk; ``height_m``: highest point of their surface; centre of mass; energies of all disks; overlaps by
    :func:`measures.overlap`; wall time of the steps.
    ``x``, ``y``, ``r``: disks in the end [m], (n,); ``connected``: bool (n,). ``frames``: {time [s]: (x, y)} on the
    way; ``film``: the same at equal distances of :data:`FILM`, in single precision.
    ``rested``: it came to rest within the time given. ``way_worst``: longest way of a disk in a step [its radius], None
    of soft ones. ``steps``, ``time_step`` [s], ``wall_s``: of the course after the release.
    """

    heap: Heap
    world: str
    settings: dict
    width: float
    height: float
    series: dict
    x: np.ndarray
    y: np.ndarray
    r: np.ndarray
    connected: np.ndarray
    rested: bool
    time_step: float
    way_worst: float | None = None
    frames: dict = field(default_factory=dict)
    film: dict = field(default_factory=dict)

    @property
    def aspect(self):
        """a = H₀/L₀ at rest in the box."""
        return self.height / self.width

    @property
    def runout(self):
        """(L_f − L₀)/L₀; for a pile, of the mean of both sides."""
        if "left" in self.heap.gates():
            return 0.5 * (self.series["front_m"][-1] - self.series["front_left_m"][-1]) / self.width - 1
        return (self.series["front_m"][-1] - self.heap.place()) / self.width - 1

    @property
    def final_height(self):
        """H_f/L₀."""
        return self.series["height_m"][-1] / self.width

    @property
    def steps(self):
        """Steps since the release."""
        return int(self.series["step"][-1])

    @property
    def wall_s(self):
        """Wall time of these steps [s]."""
        return float(self.series["wall_s"][-1])

    def surface(self):
        """x and height [m] of the surface in the end, see :func:`measures.surface`."""
        return measures.surface(self.x, self.y, self.r, self.connected)

    def repose(self):
        """Angles of the left and the right flank [degrees]; of a column, the right one alone."""
        angles = measures.repose(*self.surface())
        return angles if "left" in self.heap.gates() else angles[1:]

    def summary(self):
        """Numbers of the run, a dictionary that JSON can hold."""
        s = self.series

        def last(name):
            return float(s[name][-1])

        return {
            "world": self.world,
            "settings": self.settings,
            "heap": self.heap.plain(),
            "disks": len(self.x),
            "disks_asked": None if self.heap.packing else int(self.heap.disks),
            "width_m": self.width,
            "height_m": self.height,
            "aspect": self.aspect,
            "front_m": last("front_m"),
            "farthest_m": last("farthest_m"),
            "runout_rel": float(self.runout),
            "final_height_m": last("height_m"),
            "final_height_rel": float(self.final_height),
            "repose_deg": [None if math.isnan(a) else a for a in self.repose()],
            "connected_disks": int(np.count_nonzero(self.connected)),
            "rested": self.rested,
            "time_s": last("time_s"),
            "fall_time_s": math.sqrt(self.height / self.heap.gravity),
            "time_step_s": self.time_step,
            "steps": self.steps,
            "wall_s": self.wall_s,
            "overlap_mean_rel": float(np.mean(s["overlap_mean_rel"])),
            "overlap_worst_rel": float(np.max(s["overlap_worst_rel"])),
            "way_worst_rel": self.way_worst,
        }


_made_of = checks.takes(HeapError, heap=checks.kind(Heap, "give a Column or a Pile"))


@_made_of
def build(heap, world=None):
    """Fills the scene anew with a heap at rest in its box; returns the :class:`HeapScene`. ``world``: one of
    :mod:`yade.nonsmooth.worlds`, :func:`.grains.hard` unless given.

    The places are the same in both worlds. Raises PackingError, SampleError or HeapError where the disks cannot be
    prepared, HeapError for springs that the heap's own weight would crush and for grains with what the springs have
    not, see :meth:`Heap.check_world`, and WorldError for what is no world.
    """
    world = hard(heap) if world is None else worlds.check(world)
    heap.check_world(world)
    ready = preparation.prepared(heap)
    stiffness = getattr(world, "stiffness", math.inf)
    # the weight above a disk at the bottom, ρ g H d, over its spring E R (YADE's, for a slice 1 m thick), in diameters
    weight = heap.density * heap.gravity * ready.height / (0.5 * heap.mean_diameter())
    if weight > WEIGHT_OVERLAP * stiffness:
        raise HeapError(
            f"stiffness {stiffness:g} Pa: disks at the bottom would overlap by {100 * weight / stiffness:.2g} % of a diameter under the weight above; "
            f"give {1.05 * weight / WEIGHT_OVERLAP:.2g} or more"  # so much more that two digits are not less
        )
    return HeapScene(heap, world, ready, preparation.put(heap, world, ready.x, ready.y, ready.r))


class _Damping:
    """The integrator's damping by the disks' speed: the value at rest, and another on the move. Call it now and then
    after the release.
    """

    def __init__(self, scene, moving):
        self._scene, self._rest, self._moving, self._fastest = scene, scene.world.damping, moving, 0.0
        self._newton = next(e for e in O.engines if isinstance(e, NewtonIntegrator))

    def __call__(self):
        speed = self._scene.rms_speed()
        self._fastest = max(self._fastest, speed)
        self._newton.damping = stages.damping(
            stages.flowing(speed, self._fastest) if self._fastest > 0 else 1.0, self._rest, self._moving
        )


class _HeapCourse(driver.Course):
    """From the release to the rest on the floor; arguments as of :func:`run`."""

    def __init__(self, scene, duration, frames, progress, damping_moving):
        super().__init__()
        self.unsaved = f"a {scene.heap.KIND.lower()}"
        self.scene, self.progress, self.waiting = scene, progress, sorted(frames)
        self.unit = math.sqrt(scene.prepared.height / scene.heap.gravity)
        self.limit, self.every = duration * self.unit, max(1, round(self.unit / RECORDS / O.dt))
        self.rows, self.kept, self.film, self.calm = [], {}, {}, 0
        # springs yield under the weight first; hard disks have nothing to do
        if not until(lambda: scene.rms_speed() < SETTLED_SPEED, SETTLE_LIMIT * self.unit / O.dt, self.every):
            raise HeapError(
                f"the disks do not come to rest in their box in the {scene.world.name} world: rms speed {scene.rms_speed():.2g} √(g d) after {SETTLE_LIMIT:.0f} T, "
                f"wanted {SETTLED_SPEED:g}; give a smaller time step or tolerance, or more damping"
            )
        self.begin = O.iter
        scene.release()
        self.adapt = _Damping(scene, damping_moving) if damping_moving is not None else lambda: None
        self._look(None)

    @property
    def now(self):
        """Time since the release [s]."""
        return (O.iter - self.begin) * O.dt

    @property
    def rested(self):
        return self.calm * self.every * O.dt >= REST_TIME * self.unit

    def _over(self):
        return self.rested or self.now >= self.limit

    def _steps(self):
        self.adapt()
        advance(self.every, view=False)

    def _look(self, made):
        now, unit = self.now, self.unit
        row, self.joined = self.scene.measure()
        self.rows.append({"step": O.iter - self.begin, "time_s": now, **row, "wall_s": self.spent["wall_steps_s"]})
        t = preparation.disk_table(self.scene.stand)
        while self.waiting and now >= (self.waiting[0] - 1e-9) * unit:
            self.waiting.pop(0)
            self.kept[now] = (t["x"], t["y"])
        if now >= (len(self.film) * FILM - 1e-9) * unit:
            self.film[now] = (t["x"].astype(np.float32), t["y"].astype(np.float32))
        self.calm = self.calm + 1 if now > unit and self.scene.rms_speed(self.joined) < REST_SPEED else 0
        self.progress(min(1.0, now / self.limit))


@_made_of
def run(heap, world=None, duration=DURATION, frames=FRAMES, progress=lambda share: None, damping_moving=None):
    """Builds a heap in a ``world`` as :func:`build` does, lets it rest in its box, releases it, and follows it until it
    rests; returns the :class:`HeapResult`.

    ``duration``: longest course after the release, and ``frames``: times at which places are kept, both in units of T =
    √(H₀/g). At rest the rms speed of the connected disks has been below 0.02 √(g d) for 0.5 T. ``progress``: called now
    and then with the largest share of the duration that is done.
    ``damping_moving``: of soft contacts, the integrator's damping while the disks move, in place of the world's own, to
    which it returns in proportion below a tenth of their largest speed; None: the world's own throughout. Raises what
    :func:`build` raises, WorldError for a damping_moving that cannot be used, and HeapError for disks that do not come
    to rest in their box.
    """
    checks.number("duration", duration, HeapError, "give a number above 0, in units of T = √(H/g)", above=0)
    worlds.check_damping(world or "hard", damping_moving)
    course = _HeapCourse(build(heap, world), duration, frames, progress, damping_moving)
    driver.drive(course)
    prepared, world, t = course.scene.prepared, course.scene.world, preparation.disk_table(course.scene.stand)
    return HeapResult(
        heap,
        world.name,
        asdict(world) | ({"damping_moving": damping_moving} if damping_moving is not None else {}),
        (0.5 if "left" in heap.gates() else 1.0) * prepared.width,
        prepared.height,
        {name: np.array([row[name] for row in course.rows]) for name in COLUMNS},
        t["x"],
        t["y"],
        t["r"],
        course.joined,
        course.rested,
        O.dt,
        next((e.wayWorstEver for e in O.engines if isinstance(e, ContactDynamicsEngine)), None),
        course.kept,
        course.film,
    )
