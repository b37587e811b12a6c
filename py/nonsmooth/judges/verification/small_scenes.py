"""Small YADE scenes that the analytic checks share."""

from __future__ import annotations

import math

from yade import O
from yade.wrapper import NewtonIntegrator, NscdMat

from ...world import scene
from ...world.scene import contact_dynamics as engine
from ...world.stepping import advance

G = 9.81  # m/s²
DENSITY = 2500  # kg/m³
#: Settings for checks of the law itself: what is then left of the solver's error does not show.
TIGHT = dict(tolerance=1e-12, maxIterations=20000)


def material(friction=0.3, rolling=0.0, **more):
    """A material in the scene: coefficients μ_s and μ_r, other attributes of NscdMat by name."""
    made = NscdMat(density=DENSITY, frictionAngle=math.atan(friction), rollingFriction=rolling, **more)
    O.materials.append(made)
    return made


def disk(x, y, stuff, radius=0.5, velocity=(0, 0), spin=0.0, blocked="zXY", fixed=False):
    """A disk in the scene; returns its body. ``blocked``: its blockedDOFs."""
    body = O.bodies[O.bodies.append(scene.disk((x, y), radius, stuff, fixed=fixed))]
    if not fixed:
        body.state.blockedDOFs = blocked
    body.state.vel = (*velocity, 0)
    body.state.angVel = (0, 0, spin)
    return body


def wall(vertices, stuff, piece=None, velocity=(0, 0)):
    """A wall along a polyline, in the scene; returns its bodies. A velocity [m/s] drives it."""
    bodies = [O.bodies[i] for i in O.bodies.append(scene.segments(vertices, stuff, piece=piece))]
    for body in bodies:
        body.state.vel = (*velocity, 0)
    return bodies


def begin(gravity=(0, 0, 0), dt=1e-3, **options):
    """Engines and time step; returns the ContactDynamicsEngine."""
    O.engines = scene.engines(gravity=gravity, **{**TIGHT, **options})
    for e in O.engines:
        e.ompThreads = 1  # a few bodies: threads would only wait for each other, for long on a busy machine
    O.dt = dt
    return engine()


def set_gravity(x, y):
    """Gravity [m/s²] from the next step on, e.g. once bonds are made."""
    next(e for e in O.engines if isinstance(e, NewtonIntegrator)).gravity = (x, y, 0)


def run(steps):
    """Makes so many steps."""
    advance(steps)


def contacts():
    """Real interactions in the order of (lower id, higher id)."""
    return sorted((i for i in O.interactions if i.isReal), key=lambda i: (min(i.id1, i.id2), max(i.id1, i.id2)))


def weight(body):
    """m g [N]."""
    return body.state.mass * G
