"""Small scenes that several tests share."""
import contextlib
import ctypes
import dataclasses
import math
import os
import random

import numpy as np
import pytest
import shell
from yade import O
from yade.minieigenHP import Vector3
from yade.nonsmooth import scene
from yade.nonsmooth.scene import contact_dynamics as engine
from yade.wrapper import NscdMat

G = 9.81
_OPENMP = ctypes.CDLL("libgomp.so.1")
TIGHT = dict(tolerance=1e-12, maxIterations=20000)


@contextlib.contextmanager
def threads_allowed(most):
    """So many threads at most for engines that act in this thread of Python's (O.step and advance, not O.run): tests
    run in a YADE of one, where ``ompThreads`` alone changes nothing.
    """
    before = _OPENMP.omp_get_max_threads()
    _OPENMP.omp_set_num_threads(most)
    try:
        yield
    finally:
        _OPENMP.omp_set_num_threads(before)


def material(mu=0.3, rolling=0.0, kind=NscdMat, **more):
    """A material in the scene: friction and rolling coefficients, other attributes by name."""
    made = kind(density=2500, frictionAngle=math.atan(mu), rollingFriction=rolling, **more)
    O.materials.append(made)
    return made


def spoilt(thing, **values):
    """With values without sense, which it has though they are refused where they are set; steps refuse them too."""
    for name, value in values.items():
        with contextlib.suppress(ValueError):
            setattr(thing, name, value)
    return thing


def begin(gravity=(0, -G, 0), dt=1e-3, **options):
    """Engines in an empty scene; returns the ContactDynamicsEngine."""
    O.engines = scene.engines(gravity=gravity, **{**TIGHT, **options})
    O.dt = dt
    return engine()


def run(steps):
    for _ in range(steps):  # O.run(wait=True) sleeps 40 ms a call
        O.step()


def contacts():
    return [i for i in O.interactions if i.isReal]


def box(stuff, width, height):
    return O.bodies.append(scene.segments([(0, height), (0, 0), (width, 0), (width, height)], stuff, piece=2))


def floor(stuff):
    return O.bodies.append(scene.segments([(-20, 0), (20, 0)], stuff))[0]


def free_disk(x=0.0, y=0.0, velocity=(0, 0, 0), stuff=None, **more):
    """A disk of 1 m in diameter; returns its id."""
    disk = O.bodies.append(scene.disk((x, y), 0.5, stuff or material(**more)))
    O.bodies[disk].state.vel = velocity
    return disk


def loose_heap(stuff, columns=8, rows=8, seed=5, radius=(0.3, 0.5)):
    """Disks on a wide lattice above a floor, radii and places at random; returns their ids."""
    dice = random.Random(seed)
    return [
        O.bodies.append(
            scene.disk(
                (0.75 + 1.1 * a + dice.uniform(-0.04, 0.04), 0.6 + 1.1 * b + dice.uniform(-0.04, 0.04)),
                dice.uniform(*radius),
                stuff,
            )
        )
        for b in range(rows)
        for a in range(columns)
    ]


def refused(*words):
    """The next step is refused, in words that hold all these."""
    with pytest.raises(Exception) as error:
        O.step()
    for word in words:
        assert word in str(error.value), str(error.value)


def launch(script, *arguments):
    """Runs a script by the launcher in a process of its own."""
    # threads of a busy machine must not wait for each other in spin loops
    return shell.run(
        "yade-nonsmooth",
        script,
        *arguments,
        limit=300,
        PYTHONPATH=os.path.dirname(os.path.realpath(__file__)),
        OMP_WAIT_POLICY="passive"
    )


def state(ids):
    return [(O.bodies[i].state.pos, O.bodies[i].state.vel, O.bodies[i].state.angVel[2]) for i in ids]


def momenta(ids):
    """Linear momentum, and the angular one about the origin."""
    linear, angular = Vector3(0, 0, 0), 0.0
    for i in ids:
        s = O.bodies[i].state
        linear += s.mass * s.vel
        angular += s.mass * s.pos.cross(s.vel)[2] + s.inertia[2] * s.angVel[2]
    return linear, angular


def bits():
    """All bodies and contacts to the last bit, contacts in the order of ids (YADE's own order depends on the number of
    threads).
    """
    bodies, rows = engine().bodyTable(), np.frombuffer(engine().contactTable()).reshape(-1, 12)
    order = np.lexsort((rows[:, :2].max(axis=1), rows[:, :2].min(axis=1)))
    return bodies, rows[order].tobytes()


def without_contacts(problem):
    """The bodies of a ContactProblem or a SpaceProblem alone."""
    names = "body normal lever bias adhesion friction rolling_arm twisting_arm length warm_start impulse".split()
    return dataclasses.replace(
        problem, **{name: getattr(problem, name)[:0] for name in names if hasattr(problem, name)}
    )
