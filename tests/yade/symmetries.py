"""The same scene in another frame: mirrored, turned, shifted, moving, in other units, with other ids; and its course,
taken back to where the test thinks.

A World is plain data in one frame. `play` builds it in a Frame, runs it, and returns the Course as the first frame sees
it, so that a test reads
    assert_same(play(world, Frame(turn=0.7)), play(world), 1e-11)
"""
import sys
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from yade import O
from yade.nonsmooth import scene
from yade.wrapper import NonsmoothTimeStepper, NscdMat, PorePressureEngine, SlipWeakeningMat

from contact_scenes import begin, engine, launch, run

SAMPLES = 6  # of a course, evenly over its steps
# units of the attributes that have any
STUFF = {
    "density": "density",
    "tensileStrength": "stress",
    "residualTensileStrength": "stress",
    "weakenedTensileStrength": "stress",
    "criticalSlip": "length",
}
OPTIONS = {"correctionSpeed": "speed", "verlet": "length"}
STEPPER = {"smallest": "time", "largest": "time"}
WATER = {"unitWeight": "weight", "heights": "length", "times": "time", "releaseDistance": "length"}


@dataclass(frozen=True)
class Frame:
    """x' = length (R (M x) + shift + speed t): mirrored at the y axis by M, turned by R [rad]; units of length, time
    and density are factors.
    """

    turn: float = 0.0
    mirrored: bool = False
    shift: tuple = (0.0, 0.0)
    speed: tuple = (0.0, 0.0)
    length: float = 1.0
    time: float = 1.0
    density: float = 1.0

    @property
    def hand(self):
        """Sign of angles."""
        return -1 if self.mirrored else 1

    @property
    def matrix(self):
        quarters = self.turn / (0.5 * np.pi)
        c, s = (
            (round(np.cos(self.turn)), round(np.sin(self.turn)))
            if quarters == int(quarters)
            else (np.cos(self.turn), np.sin(self.turn))
        )
        return np.array([[c, -s], [s, c]]) @ np.diag([self.hand, 1])

    def unit(self, kind):
        """Factor of a quantity per metre of thickness, which no unit of length changes."""
        mass, speed = self.density * self.length**2, self.length / self.time
        force = mass * speed / self.time
        return {
            "none": 1.0,
            "length": self.length,
            "time": self.time,
            "density": self.density,
            "mass": mass,
            "speed": speed,
            "spin": 1 / self.time,
            "acceleration": speed / self.time,
            "force": force,
            "energy": force * self.length,
            "stress": force / self.length,
            "weight": force / self.length**2,
        }[kind]

    def out(self, vector, kind):
        return self.unit(kind) * (self.matrix @ np.asarray(vector, float))

    def back(self, vectors, kind):
        return np.asarray(vectors) @ self.matrix / self.unit(kind)

    def place(self, point, time=0.0):
        return self.out(point, "length") + self.length * (np.array(self.shift) + time * np.array(self.speed))

    def velocity(self, vector):
        return self.out(vector, "speed") + self.unit("speed") * np.array(self.speed)

    def scaled(self, values, kinds):
        """Attributes by name in this frame's units."""
        return {
            name: (np.multiply(value, self.unit(kinds[name])).tolist() if name in kinds else value)
            for name, value in values.items()
        }


HERE = Frame()


@dataclass(frozen=True)
class Disk:
    x: float
    y: float
    r: float = 0.5
    velocity: tuple = (0.0, 0.0)
    spin: float = 0.0
    stuff: str = "rock"
    blocked: str = "zXY"
    mask: int = 1


@dataclass(frozen=True)
class Line:
    vertices: tuple
    stuff: str = "ground"
    piece: float = None
    sense: int = 0
    velocity: tuple = (0.0, 0.0)


@dataclass(frozen=True)
class World:
    """``stuffs``: attributes of an NscdMat by name, of a SlipWeakeningMat where it has a criticalSlip; ``bond``: step
    after which bonds are made; ``turns``: {step: gravity from then on}; ``options``: of contact_scenes.begin;
    ``water``, ``stepper``: attributes of these engines; ``order``: disks in the order of their ids; ``walls_last``: the
    walls have the highest ids."""

    disks: tuple
    walls: tuple
    stuffs: dict
    gravity: tuple = (0.0, -9.81)
    dt: float = 2e-3
    steps: int = 300
    bond: int = None
    turns: dict = field(default_factory=dict)
    options: dict = field(default_factory=dict)
    water: dict = None
    stepper: dict = None
    order: tuple = None
    walls_last: bool = False


class Course(dict):
    """Arrays by name, the first axis along the samples; ``length`` [m], ``speed`` [m/s], ``mass`` [kg/m] and ``step``
    [s]: the scales of this world.
    """


def _build(world, frame):
    """The world in a frame; ids of the disks in the world's order, and those of each wall's pieces."""
    stuffs = {}
    for name, values in world.stuffs.items():
        kind = SlipWeakeningMat if "criticalSlip" in values else NscdMat
        stuffs[name] = kind(**frame.scaled({"density": 2500.0, **values}, STUFF))
    O.materials.append(list(stuffs.values()))
    ids, pieces = {}, []

    def add_walls():
        for line in world.walls:
            piece = line.piece and line.piece * frame.length
            bodies = O.bodies.append(
                scene.segments(
                    [frame.place(v) for v in line.vertices],
                    stuffs[line.stuff],
                    piece=piece,
                    sense=frame.hand * line.sense,
                )
            )
            for k in bodies:
                O.bodies[k].state.vel = (*frame.velocity(line.velocity), 0)
            pieces.append(bodies)

    if not world.walls_last:
        add_walls()
    for k in world.order or range(len(world.disks)):
        d = world.disks[k]
        ids[k] = O.bodies.append(scene.disk(frame.place((d.x, d.y)), d.r * frame.length, stuffs[d.stuff]))
        body = O.bodies[ids[k]]
        body.state.blockedDOFs, body.mask = d.blocked, d.mask
        body.state.vel, body.state.angVel = (*frame.velocity(d.velocity), 0), (
            0,
            0,
            frame.hand * d.spin * frame.unit("spin"),
        )
    if world.walls_last:
        add_walls()
    return [ids[k] for k in range(len(world.disks))], pieces


def _engines(world, frame):
    before = []
    if world.water is not None:
        w = dict(world.water)
        plane = {
            "planePoint": (*frame.place(w.pop("planePoint", (0, 0))), 0),
            "planeNormal": (*frame.out(w.pop("planeNormal", (0, 1)), "none"), 0),
        }
        if "pressureGradient" in w:
            plane["pressureGradient"] = (*frame.out(w.pop("pressureGradient"), "weight"), 0)
        before = [PorePressureEngine(**frame.scaled(w, WATER), **plane)]
    options = {"verlet": 0.1, "correctionSpeed": 1.0, **world.options}
    begin(
        gravity=(*frame.out(world.gravity, "acceleration"), 0),
        dt=world.dt * frame.time,
        before=before,
        **frame.scaled(options, OPTIONS),
    )
    if world.stepper is not None:
        O.engines = [
            NonsmoothTimeStepper(**frame.scaled({"smallest": 1e-4, "largest": 1e-2, **world.stepper}, STEPPER))
        ] + O.engines


def of(kind):
    """The engine of a kind in the scene, None where there is none."""
    return next((e for e in O.engines if isinstance(e, kind)), None)


def _sample(world, frame, ids, pieces):
    e, water = engine(), of(PorePressureEngine)
    states = [O.bodies[k].state for k in ids]
    time, began = O.time / frame.time, (O.time - O.dt) / frame.time
    walls, moments, slips = [], [], np.zeros(len(ids))
    origin = frame.place((0, 0), began)
    for line in pieces:
        force, moment = np.zeros(2), 0.0
        for k in line:
            s, f = O.bodies[k].state, np.array(O.forces.f(k))[:2]
            arm = np.array(s.pos)[:2] - O.dt * np.array(s.vel)[:2] - origin  # forces belong to the step's beginning
            force, moment = force + f, moment + arm[0] * f[1] - arm[1] * f[0] + O.forces.t(k)[2]
        walls.append(force)
        moments.append(moment)
        stuff = O.bodies[line[0]].material
        if isinstance(stuff, SlipWeakeningMat):
            slips += [stuff.slipOf(k) for k in ids]
    shift = frame.place((0, 0), time)
    found = {
        "time": time,
        "step": O.dt / frame.time,
        "place": frame.back([np.array(s.pos)[:2] - shift for s in states], "length"),
        "turned": frame.hand * np.array([2 * np.arctan2(s.ori[2], s.ori[3]) for s in states]),
        "velocity": frame.back([np.array(s.vel)[:2] - frame.velocity((0, 0)) for s in states], "speed"),
        "spin": frame.hand * np.array([s.angVel[2] for s in states]) / frame.unit("spin"),
        "force": frame.back([np.array(O.forces.f(k))[:2] for k in ids], "force"),
        "torque": frame.hand * np.array([O.forces.t(k)[2] for k in ids]) / frame.unit("energy"),
        "wall force": frame.back(np.reshape(walls, (-1, 2)), "force"),
        "wall moment": frame.hand * np.array(moments) / frame.unit("energy"),
        "losses": np.array([e.slidingLoss, e.rollingLoss, e.debondingLoss, e.impactLoss, e.correctionEnergy])
        / frame.unit("energy"),
        "overlap": np.array([e.overlapWorst, e.overlapMean]),
        "slip": slips / frame.unit("length"),
        "counts": np.array([e.bonds, e.brokenTension, e.brokenShear, e.brokenTorque, e.brokenMixed]),
        "wet": np.array([[water.isWet(k), water.isReleased(k)] if water else [False, False] for k in ids]),
        "water": frame.back(np.array(water.totalForce)[:2] if water else np.zeros(2), "force"),
    }
    stepper = of(NonsmoothTimeStepper)
    found["rates"] = np.array([e.contactRate, e.bondRate]) * frame.time
    found["limit"] = np.array([stepper.limit if stepper else -1])
    return found


def play(world, frame=HERE, prepared=lambda ids: None, halfway=lambda: None):
    """The Course of a world that is built and run in a frame, as HERE sees it; ``prepared``: called with the disks' ids
    once contacts are known, after a step.
    """
    O.reset()
    ids, pieces = _build(world, frame)
    _engines(world, frame)
    samples, peak = [], 1e-300
    for k in range(1, world.steps + 1):
        run(1)
        if k == 1:
            prepared(ids)
        if k == world.bond:
            assert engine().bond() > 0
        if k in world.turns:
            O.engines[-1].gravity = (*frame.out(world.turns[k], "acceleration"), 0)
        peak = max(peak, engine().maxSpeed)
        if k * SAMPLES % world.steps < SAMPLES:
            samples.append(_sample(world, frame, ids, pieces))
        if k == world.steps // 2:
            halfway()
    course = Course({name: np.array([s[name] for s in samples]) for name in samples[0]})
    radii = np.array([d.r for d in world.disks])
    course.length, course.mass, course.speed, course.step = (
        2 * radii.mean(),
        2500 * np.pi * (radii**2).mean(),
        peak / frame.unit("speed"),
        world.dt,
    )
    return course


def differences(found, expected):
    """{name: largest difference} of two courses, in the scales of ``expected``: ℓ, the greatest speed, what stops a
    disk in a step, a disk's energy; counts as they are. Overlaps are what a step left over: they agree a hundred times
    less than places do."""
    s = expected
    scales = {
        "place": s.length,
        "slip": s.length,
        "velocity": s.speed,
        "spin": s.speed / s.length,
        "force": s.mass * s.speed / s.step,
        "torque": s.mass * s.speed / s.step * s.length,
        "losses": s.mass * s.speed**2,
        "time": s.step,
        "step": s.step,
        "rates": s.speed / s.length,
        "overlap": 100.0,
    }
    scales |= {"wall force": scales["force"], "wall moment": scales["torque"], "water": scales["force"]}
    return {
        name: float(np.max(np.abs(found[name] - expected[name].astype(float)), initial=0) / scales.get(name, 1.0))
        for name in expected
    }


def assert_same(found, expected, tolerance, **others):
    """Two courses agree to ``tolerance`` in the scales of `differences`; ``others``: other tolerances by name, with _
    for a blank, None for what may differ.
    """
    others = {name.replace("_", " "): value for name, value in others.items()}
    far = {
        name: value
        for name, value in differences(found, expected).items()
        if others.get(name, tolerance) is not None and not value <= others.get(name, tolerance)
    }
    assert not far, far


def assert_bits(found, expected):
    """Two courses are the same to the last bit."""
    other = [name for name in expected if not np.array_equal(found[name], expected[name])]
    assert not other, {name: float(np.max(np.abs(found[name] - expected[name].astype(float)))) for name in other}


def saved_and_loaded(path):
    """What `play` does halfway so that the rest is of a scene that was saved to a file and loaded."""

    def again():
        O.save(str(path))
        O.reset()
        O.load(str(path))

    return again


def on_threads(module, folder, threads):
    """The course of a test module's WORLD, in a process of its own with so many threads for each engine."""
    script, found = folder / "threads.py", folder / f"{threads}.npz"
    home = str(Path(sys.modules[module].__file__).parent)
    script.write_text(
        f"""
import os, sys
import numpy as np
from yade import O
from symmetries import play
sys.path.insert(0, {home!r})
from {module} import WORLD
def asked(ids):
    for e in O.engines:
        e.ompThreads = int(os.environ["OMP_NUM_THREADS"])
np.savez(sys.argv[1], **play(WORLD, prepared=asked))
"""
    )
    done = launch(script, found, "--threads", threads)
    assert done.returncode == 0, done.stderr
    with np.load(found) as course:
        return dict(course)


def shuffled(world, seed=1):
    """The same world with its disks in another order of ids."""
    return replace(world, order=tuple(np.random.default_rng(seed).permutation(len(world.disks)).tolist()))


# Frames in which any world has the same course. Far away a place is known to 2^-52 of the distance only; a test says
# what that does to it.
FRAMES = {
    "mirror": Frame(mirrored=True),
    "quarter turn": Frame(turn=0.5 * np.pi),
    "turn": Frame(turn=0.7),
    "turned mirror": Frame(turn=-2.1, mirrored=True),
    "moving": Frame(speed=(3.0, -2.0)),
    "units": Frame(length=1e3, time=1 / 60, density=1e-3),  # mm, minutes, g/cm³
}
BINARY = Frame(length=4.0, time=0.5, density=8.0)  # products and quotients of all these are exact, roots too
