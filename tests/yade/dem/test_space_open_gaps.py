"""Contacts of spheres over open gaps: which of them a solve leaves out, and what becomes of their neighbours."""
import numpy as np
import pytest
from yade import O
from yade.nonsmooth import contact, space
from yade.nonsmooth.world import sphere_worlds
from yade.utils import sphere, wall
from yade.wrapper import ContactDynamicsEngine, InteractionLoop, NscdMat, Sphere

pytestmark = pytest.mark.usefixtures("empty")

R, STEP = 0.5, 1e-3


def ball(place, speed=(0, 0, 0)):
    body = O.bodies[O.bodies.append(sphere(place, R, material=O.materials[0]))]
    body.state.vel = speed
    return body


@pytest.fixture
def floor():
    O.materials.append(NscdMat(density=2500, frictionAngle=0.3))
    return O.bodies[O.bodies.append(wall(0, axis=2, sense=1, material=O.materials[0]))]


def begin(gravity=(0, 0, 0), step=STEP, **options):
    O.engines = space.engines(gravity=gravity, tolerance=1e-9, **options)
    O.dt = step


def solver():
    return next(engine for engine in O.engines if isinstance(engine, ContactDynamicsEngine))


def test_a_contact_that_stays_open_is_left_out_and_bears_nothing(floor):
    lower, upper = ball((0, 0, R)), ball((0, 0, 3 * R))
    begin(gravity=(0, 0, -9.81))
    O.run(30, True)
    assert solver().candidates == 2
    between = O.interactions[lower.id, upper.id]
    assert between.phys.normal == pytest.approx(upper.state.mass * 9.81, rel=1e-8)  # ten tolerances
    # it flies up by 0.1 of a diameter, less than the reach and more than what is solved for, and is known all the time
    upper.state.pos += (0, 0, 0.1 * 2 * R)
    upper.state.vel = (0, 0, 0.01)
    O.run(1, True)
    assert between.isReal and solver().candidates == 1
    assert between.phys.normal == 0 and between.phys.normalForce == (0, 0, 0) and between.phys.shearForce == (0, 0, 0)
    O.run(1000, True)  # it is solved for again where it falls back
    assert solver().candidates == 2
    assert between.phys.normal == pytest.approx(upper.state.mass * 9.81, rel=1e-8)  # ten tolerances


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 1, 0), (1, 0, 2)])
def test_who_is_hit_in_a_step_stops_at_the_next(floor, order, tmp_path):
    """The flying one hits its neighbour, which nothing approaches yet, and that one the next: contacts 2-3, then 1-2,
    whatever order YADE's list has, then 4-5, which was there before."""
    places, speeds = (2.4, 1.2, 0), (0, 0, 100)
    made = {k: ball((places[k], 0, 9), (speeds[k], 0, 0)) for k in order}
    row = [made[k] for k in (2, 1, 0)]  # along their way
    far = [ball((x, 5, 9)) for x in (10, 11)]
    begin(step=1e-2, reach=0.5)
    O.step()
    solver().dump(str(tmp_path / "step.h5"))
    pairs = [tuple(pair) for pair in contact.load(str(tmp_path / "step.h5")).body.tolist()]
    ids = [body.id for body in row]
    assert pairs == [*sorted(tuple(sorted(pair)) for pair in zip(ids, ids[1:])), (far[0].id, far[1].id)]
    speeds = [body.state.vel[0] for body in row]
    # momentum is kept; each gap of 0.2 m closes in the step, and no more: to the solver's 1e-9
    assert sum(speeds) == pytest.approx(100, rel=1e-8)
    assert -np.diff(speeds) == pytest.approx([20, 20], rel=1e-7)


@pytest.mark.parametrize("seed", range(6))
def test_contacts_that_are_taken_in_together_stand_in_the_order_of_ids(floor, seed, tmp_path):
    """Six rows in which the flying one hits its neighbour, which hits the next: six contacts are taken in at once, and
    YADE's list has them in the order of places along its axis."""
    rng = np.random.default_rng(seed)
    rows = [[None] * 3 for _ in range(6)]
    for k in rng.permutation(18):
        row, place = divmod(int(k), 3)
        speed = (100, 0, 0) if place == 0 else (0, 0, 0)
        rows[row][place] = ball((1.2 * place + 0.3 * row, 5 * row, 9), speed)
    begin(step=1e-2, reach=0.5)
    O.step()
    solver().dump(str(tmp_path / "step.h5"))
    pairs = [tuple(pair) for pair in contact.load(str(tmp_path / "step.h5")).body.tolist()]
    expected = [tuple(sorted((a.id, b.id))) for row in rows for a, b in zip(row, row[1:])]
    assert pairs == sorted(expected)


def test_what_is_fast_does_not_overlap(floor):
    """Balls that fall by a tenth of their diameter a step, from heights that differ by less than that."""
    speed = 0.1 * 2 * R / STEP
    for k in range(20):
        ball((2 * k, 0, 3 * R + 0.0997 * k / 20), (0, 0, -speed))
    begin()
    assert sphere_worlds.HardSpheres.reach == space.REACH  # what holds here holds in the scenes
    worst = 0
    for _ in range(15):
        O.step()
        worst = max(worst, -min(b.state.pos[2] - R for b in O.bodies if isinstance(b.shape, Sphere)))
    # each stops on the floor to the solver's tolerance, 1e-9 of a step's way
    assert worst < 1e-8 and solver().contacts == 20


def test_a_contact_has_the_geometry_that_its_functor_would_give(floor):
    """Geometry is found without the functor once a contact is known; one of a derived class is asked in every step."""
    rng = np.random.default_rng(3)

    def found(asked):
        for body in [b.id for b in O.bodies if isinstance(b.shape, Sphere)]:
            O.bodies.erase(body)
        place = np.random.default_rng(3)
        for k in range(8):
            ball(tuple([k % 2, k // 2 % 2, k // 4 + R] + place.uniform(0, 0.01, 3)), tuple(place.uniform(-1, 1, 3)))
        begin(gravity=(0, 0, -9.81))
        if asked:  # YADE's own loop calls them all
            for k, engine in enumerate(O.engines):
                if isinstance(engine, InteractionLoop):
                    lists = engine.geomDispatcher, engine.physDispatcher, engine.lawDispatcher
                    O.engines = [*O.engines[:k], InteractionLoop(*(one.functors for one in lists)), *O.engines[k + 1 :]]
        O.run(40, True)
        real = sorted((i for i in O.interactions if i.isReal), key=lambda i: (i.id1, i.id2))
        first = min(b.id for b in O.bodies if isinstance(b.shape, Sphere))
        return [
            (i.id1 - first, i.id2 - first, *i.geom.normal, *i.geom.contactPoint, i.geom.penetrationDepth, i.phys.normal)
            for i in real
            if i.id1 != 0
        ]

    ours = found(False)
    assert len(ours) >= 8 and ours == found(True)
