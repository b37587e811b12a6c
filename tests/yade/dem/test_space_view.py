"""Contacts of spheres in space stay in arrays while nobody looks; whoever looks sees the truth, and what scripts write is
taken up, in every way in which a scene can be run.
"""
import math
import time

import pytest
from all_attributes import everything, plain
from contact_scenes import engine
from yade import O, utils
from yade.minieigenHP import Quaternion, Vector3
from yade.nonsmooth import space
from yade.wrapper import (
    ForceResetter,
    InteractionLoop,
    NewtonIntegrator,
    NscdMat,
    NscdSpacePhys,
    PyRunner,
    RotationEngine,
    SpatialNewtonIntegrator,
)

pytestmark = pytest.mark.usefixtures("empty")

STEPS = 400


def material(**others):
    stuff = NscdMat(density=2500, frictionAngle=math.atan(0.5), **others)
    O.materials.append(stuff)
    return stuff


def heap(*after):
    """Spheres, of which some overlap, fall into a corner of a wall, a facet and a box that turns; they roll and bounce."""
    stuff = material(rollingFriction=0.05, twistingFriction=0.05, residualTensileStrength=300, restitution=0.2)
    O.bodies.append(utils.wall((0, 0, 0), 2, material=stuff))
    O.bodies.append(utils.facet([(0, -1, -1), (0, 5, -1), (0, 2, 5)], material=stuff))
    paddle = O.bodies.append(utils.box((2.5, 1, 0.4), (0.1, 1, 0.4), fixed=True, material=stuff))
    for k in range(24):
        at = 0.36 + 0.7 * (k % 3), 0.1 + 0.67 * (k // 3 % 3), 0.4 + 0.72 * (k // 9) + 0.01 * k
        O.bodies.append(utils.sphere(at, 0.33 + 0.0005 * k, material=stuff))
        O.bodies[-1].state.vel = (0.3 - 0.05 * (k % 7), 0.1, -0.5)
    turns = RotationEngine(
        ids=[paddle], angularVelocity=0.5, rotationAxis=(0, 0, 1), rotateAroundZero=True, zeroPoint=(2.5, 1, 0.4)
    )
    O.engines = space.engines(after=[turns, *after], tolerance=1e-7)
    O.dt = 1e-3


def in_order(found):
    """The same with interactions in the order of ids, which YADE's list does not keep; those that are real, since
    others may have been met by a functor or not."""
    bodies, links, *rest = found
    real = sorted((min(a, b), max(a, b), made, *objects) for a, b, real, born, made, *objects in links if real)
    return bodies, real, *rest


WAYS = {
    "advance": lambda: engine().advance(STEPS),
    "step": lambda: [O.step() for _ in range(STEPS)],
    "run": lambda: O.run(STEPS, True),
    "unseen": lambda: (
        engine().advance(STEPS // 2, view=False),
        engine().advance(STEPS // 2, view=False),
        engine().view(),
    ),
}


def test_every_attribute_is_the_same_in_every_way():
    ends = {}
    for name, way in WAYS.items():
        for looks in (0, 1, 7):
            O.reset()
            heap(*([PyRunner(command="O.interactions", iterPeriod=looks)] if looks else []))
            way()
            ends[name, looks] = in_order(everything())
    first = ends["step", 0]
    assert len(first[1]) > 30
    assert sum(i.phys.normal > 0 for i in O.interactions if i.isReal) > 10
    for name, end in ends.items():
        for part, expected in zip(end, first):
            assert part == expected, name


def test_contacts_stay_as_they_were_seen_until_somebody_looks_again():
    heap()
    O.run(STEPS, True)
    engine().advance(1, view=False)  # which takes them

    def points():  # of contacts of spheres, which stay in arrays
        return {
            (i.id1, i.id2): plain(i.geom.contactPoint) for i in O.interactions if i.isReal and min(i.id1, i.id2) > 2
        }

    seen = points()
    engine().advance(5, view=False)
    stale = points()
    common = seen.keys() & stale.keys()
    assert len(common) > 10 and all(stale[pair] == seen[pair] for pair in common)
    engine().view()
    now = points()
    assert sum(now[pair] != seen[pair] for pair in common & now.keys()) > 10


def test_what_an_engine_in_the_midst_of_a_step_writes_and_ends_is_taken_up():
    """A friction that is written, a contact that is ended, and forces that are set to zero, before the solver."""

    def meddle():
        mine = sorted((i.id1, i.id2) for i in O.interactions if i.isReal and min(i.id1, i.id2) > 2)
        if O.iter == 50:
            O.interactions[mine[0]].phys.tangensOfFrictionAngle = 0.05
        if O.iter == 60:
            O.interactions.erase(*mine[1])
        if O.iter == 70:
            O.interactions[mine[2]].phys.normalForce = O.interactions[mine[2]].phys.shearForce = (0, 0, 0)

    ends = []
    for kind in (None, InteractionLoop):
        for period in (10, 1):
            O.reset()
            heap()
            loop = O.engines[2]
            if kind:
                loop = kind(loop.geomDispatcher.functors, loop.physDispatcher.functors, loop.lawDispatcher.functors)
            import __main__

            __main__.meddle = meddle
            O.engines = [*O.engines[:2], loop, PyRunner(command="meddle()", iterPeriod=period), *O.engines[3:]]
            O.run(STEPS, True)
            ends.append([(plain(b.state.pos), plain(b.state.vel), plain(b.state.angVel)) for b in O.bodies])
    assert all(end == ends[0] for end in ends[1:])


def test_a_friction_that_is_written_during_a_run_in_the_background_acts():
    """A ball in the groove of two fixed ones, held by friction against a gravity that is oblique to it, slides when both
    contacts have none any more."""
    stuff = material()
    for y in (-0.35, 0.35):
        O.bodies.append(utils.sphere((0, y, 0), 0.5, fixed=True, material=stuff))
    top = O.bodies[O.bodies.append(utils.sphere((0, 0, math.sqrt(1 - 0.35**2)), 0.5, material=stuff))]
    top.state.blockedDOFs = "XYZ"
    O.engines = space.engines(gravity=(1, 0, -9.81), tolerance=1e-9)
    O.dt = 1e-4
    O.run(200, True)
    assert abs(top.state.vel[0]) < 1e-6
    O.run()
    time.sleep(0.1)
    for i in O.interactions:
        i.phys.tangensOfFrictionAngle = 0
    begin = time.time()
    while top.state.vel[0] < 1e-2 and time.time() < begin + 20:
        time.sleep(0.01)
    O.pause()
    O.wait()
    assert top.state.vel[0] > 1e-2


def two_balls(distance, speed):
    """One that flies to another, or from it, on the x axis."""
    stuff = material()
    for k in range(2):
        O.bodies.append(utils.sphere((k * distance, 0, 0), 0.5, material=stuff))
    O.bodies[0].state.vel = (speed, 0, 0)
    O.engines = space.engines(gravity=(0, 0, 0), tolerance=1e-10)
    O.dt = 1e-3


def test_pairs_that_the_collider_finds_become_contacts_unseen():
    two_balls(6, 50)
    engine().advance(140, view=False)
    engine().view()
    assert O.bodies[1].state.vel[0] == pytest.approx(25, rel=1e-6)  # half of the momentum, as nothing bounces


def test_contacts_that_open_beyond_the_reach_end_unseen():
    two_balls(1.0, -20)
    O.step()
    assert O.interactions[0, 1].isReal
    engine().advance(20, view=False)
    engine().view()
    assert not any(i.isReal for i in O.interactions)


def test_a_force_that_is_written_unseen_is_refused_once_it_is_looked_at():
    two_balls(0.999, 0)
    engine().advance(3, view=False)
    O.interactions[0, 1].phys.normalForce = (1, 0, 0)
    with pytest.raises(RuntimeError, match="#0.*#1.*normalForce"):
        for _ in range(3):
            O.step()


def test_a_fixed_ball_that_is_let_go_during_a_run_in_the_background_is_borne():
    stuff = material()
    O.bodies.append(utils.wall((0, 0, 0), 2, material=stuff))
    ball = O.bodies[O.bodies.append(utils.sphere((0, 0, 0.5), 0.5, fixed=True, material=stuff))]
    O.bodies.append(utils.sphere((3, 0, 0.5), 0.5, material=stuff))
    O.engines = space.engines(tolerance=1e-9)
    O.dt = 1e-4
    O.run()
    time.sleep(0.02)
    ball.state.blockedDOFs = ""
    begin = O.iter
    while O.running and O.iter < begin + 5000:
        time.sleep(0.01)
    O.pause()
    O.wait()
    # for a step or two, in which its contact becomes one in space, it falls
    assert abs(ball.state.pos[2] - 0.5) < 1e-6 and type(O.interactions[0, 1].phys) is NscdSpacePhys


@pytest.mark.parametrize("loop", [None, InteractionLoop])
def test_a_fixed_ball_that_is_let_go_has_contacts_in_space(loop):
    """Its contact with the wall was made when neither could move; with both loops it bears the ball from then on."""
    stuff = material()
    O.bodies.append(utils.wall((0, 0, 0), 2, material=stuff))
    ball = O.bodies[O.bodies.append(utils.sphere((0, 0, 0.5), 0.5, fixed=True, material=stuff))]
    other = O.bodies[O.bodies.append(utils.sphere((3, 0, 0.5), 0.5, material=stuff))]
    O.engines = space.engines(tolerance=1e-9)
    if loop:
        old = O.engines[2]
        new = loop(old.geomDispatcher.functors, old.physDispatcher.functors, old.lawDispatcher.functors)
        O.engines = [*O.engines[:2], new, *O.engines[3:]]
    O.dt = 1e-3
    O.run(5, True)
    assert type(O.interactions[0, 1].phys) is not NscdSpacePhys
    ball.state.blockedDOFs = ""
    O.run(20, True)
    contacts = [O.interactions[0, b.id].phys for b in (ball, other)]
    assert all(type(p) is NscdSpacePhys for p in contacts)
    # what the other one bears, which was free from the beginning; to the solver's tolerance
    assert contacts[0].normal == pytest.approx(ball.state.mass * 9.81, rel=1e-7)
    assert contacts[0].friction == contacts[1].friction and contacts[0].length == contacts[1].length
    assert abs(ball.state.pos[2] - 0.5) < 1e-9


def test_a_bond_of_two_fixed_balls_holds_one_that_is_let_go():
    stuff = material(tensileStrength=1e6, bondCreationDistance=0.05, bondEllipseNormal=0.05, bondEllipseTangential=0.05)
    O.bodies.append(utils.sphere((0, 0, 1), 0.5, fixed=True, material=stuff))
    low = O.bodies[O.bodies.append(utils.sphere((0, 0, 0), 0.5, fixed=True, material=stuff))]
    O.bodies.append(utils.sphere((5, 0, 0), 0.5, material=stuff))
    O.engines = space.engines(tolerance=1e-9)
    O.dt = 1e-3
    O.run(2, True)
    assert engine().bond() == 1
    low.state.blockedDOFs = ""
    O.run(100, True)
    phys = O.interactions[0, 1].phys
    assert phys.bonded and phys.normal == pytest.approx(-low.state.mass * 9.81, rel=1e-7)
    assert abs(low.state.pos[2]) < 1e-9


# ---- the integrator -------------------------------------------------------------------------------


def tumbling(newton):
    """Bodies of which each is held and turned in another way, under forces."""
    stuff = material()
    for k, blocked in enumerate(("", "x", "yZ", "XYZ", "xyz", "xyzXYZ", "zX")):
        O.bodies.append(utils.sphere((2 * k, 0, 0), 0.3 + 0.1 * k, material=stuff))
        state = O.bodies[-1].state
        state.blockedDOFs = blocked
        state.vel, state.angVel = (0.1 * k, -1, 2), (1 - k, 2, 0.5 * k)
        state.ori = Quaternion(Vector3(1, k, -2).normalized(), 0.3 * k)
        O.forces.setPermF(k, (30, -20 * k, 10))
        O.forces.setPermT(k, (1, 2, -3 * k))
    O.engines = [ForceResetter(), newton]
    O.dt = 1e-3


@pytest.mark.parametrize("options", [{}, {"damping": 0.3}], ids=["plain", "damped"])
def test_the_integrator_has_the_bits_of_yades(options):
    ends = []
    for kind in (NewtonIntegrator, SpatialNewtonIntegrator):
        O.reset()
        tumbling(kind(**{"gravity": (0.5, -1, -9.81), "damping": 0, **options}))
        O.run(300, True)
        ends.append([plain(b.state) for b in O.bodies])
    assert ends[0] == ends[1]


def test_the_integrator_refuses_what_it_cannot_turn():
    tumbling(SpatialNewtonIntegrator(damping=0))
    O.bodies[2].state.blockedDOFs = ""
    O.bodies[2].aspherical = True
    with pytest.raises(RuntimeError, match="SpatialNewtonIntegrator: body #2 is aspherical.*NewtonIntegrator"):
        O.step()
