"""Spheres in space, one and two at a time, against what mechanics says: rest, sliding and rolling, spin, impacts, edges
of facets, thresholds of contacts, frames.
"""
import math

import numpy as np
import pytest
from contact_scenes import threads_allowed
from yade import O
from yade.minieigenHP import Quaternion, Vector3
from yade.nonsmooth import space
from yade.utils import box, createInteraction, facet, sphere, wall
from yade.wrapper import ContactDynamicsEngine, FaceGeom, NscdMat, NscdSpacePhys

pytestmark = pytest.mark.usefixtures("empty")

G, R, STEP = 9.81, 0.5, 1e-3


def material(friction=0.5, **others):
    stuff = NscdMat(density=2500, frictionAngle=math.atan(friction), **others)
    O.materials.append(stuff)
    return stuff


def add(body, stuff):
    body.material = stuff
    return O.bodies[O.bodies.append(body)]


def ball(place, stuff, radius=R, **state):
    body = add(sphere(place, radius, material=stuff), stuff)
    for name, value in state.items():
        setattr(body.state, name, value)
    return body


def begin(gravity=(0, 0, -G), step=STEP, tolerance=1e-9, **options):
    O.engines = space.engines(gravity=gravity, tolerance=tolerance, **options)
    O.dt = step


def facets(stuff, size=50.0):
    corners = [(-size, -size, 0), (size, -size, 0), (size, size, 0), (-size, size, 0)]
    return [add(facet([corners[0], corners[k], corners[k + 1]]), stuff) for k in (1, 2)]


FLOORS = {
    "facets": facets,
    "wall": lambda stuff: [add(wall(0, axis=2, sense=1), stuff)],
    "wall of two sides": lambda stuff: [add(wall(0, axis=2), stuff)],
    "box": lambda stuff: [add(box((0, 0, -1), (50, 50, 1), fixed=True), stuff)],
}
on_each_floor = pytest.mark.parametrize("floor", FLOORS.values(), ids=FLOORS)


def touching():
    return [i for i in O.interactions if i.isReal and i.phys.normal != 0]


@on_each_floor
def test_a_ball_at_rest_presses_with_its_weight(floor):
    stuff = material()
    floor(stuff)
    one = ball((0.3, 0.1, R), stuff)
    begin()
    O.run(50, True)
    (contact,) = touching()
    # rounding of a sum of the weight and its answer
    assert contact.phys.normal == pytest.approx(one.state.mass * G, rel=1e-12)
    assert isinstance(contact.geom, FaceGeom) and isinstance(contact.phys, NscdSpacePhys)
    assert Vector3(contact.phys.normalForce) == pytest.approx(Vector3(0, 0, one.state.mass * G), rel=1e-12)
    assert one.state.vel.norm() < 1e-15 and one.state.pos[2] == pytest.approx(R, abs=1e-15)


@on_each_floor
def test_a_ball_that_slides_comes_to_roll_at_five_sevenths_of_its_speed(floor):
    stuff = material(0.3)
    floor(stuff)
    speed = 2.0
    one = ball((-3, 0.1, R), stuff, vel=(speed, 0, 0))
    begin()
    until = 2 * speed / (7 * 0.3 * G)  # when it rolls
    steps = round(0.5 * until / STEP)
    O.run(steps, True)
    assert one.state.vel[0] == pytest.approx(speed - 0.3 * G * steps * STEP, rel=1e-9)  # constant deceleration, exact
    O.run(round(until / STEP), True)
    # angular momentum about the line on the floor is kept, whatever the step
    assert one.state.vel[0] == pytest.approx(5 / 7 * speed, rel=1e-9)
    assert one.state.angVel[1] == pytest.approx(one.state.vel[0] / R, rel=1e-9)
    assert abs(one.state.vel[2]) < 1e-12


def test_rolling_resistance_stops_a_ball_that_rolls():
    stuff = material(0.9, rollingFriction=0.02)
    FLOORS["wall"](stuff)
    one = ball((0, 0, R), stuff, vel=(1, 0, 0), angVel=(0, 1 / R, 0))
    begin()
    steps = 100
    O.run(steps, True)
    # torque mu_r l N with l the diameter against (7/5) m R a
    deceleration = 0.02 * 2 * R * G / (1.4 * R)
    assert one.state.vel[0] == pytest.approx(1 - deceleration * steps * STEP, rel=1e-9)


def test_twisting_resistance_stops_a_spin():
    stuff = material(0.5, twistingFriction=0.03)
    FLOORS["wall"](stuff)
    one = ball((0, 0, R), stuff, angVel=(0, 0, 5))
    begin()
    O.run(100, True)
    slowing = 0.03 * 2 * R * G / (0.4 * R * R)  # torque mu_tw l m g over 2/5 m R^2
    assert one.state.angVel[2] == pytest.approx(5 - slowing * 100 * STEP, rel=1e-9)
    O.run(3000, True)
    assert abs(one.state.angVel[2]) < 1e-9
    (contact,) = touching()
    assert abs(contact.phys.twistingTorque) <= 0.03 * 2 * R * contact.phys.normal * (1 + 1e-12)


def test_a_spin_about_the_normal_does_not_turn_a_sliding_ball():
    stuff = material(0.2)
    FLOORS["wall"](stuff)
    one = ball((0, 0, R), stuff, vel=(3, 1, 0), angVel=(0, 0, 40))
    begin()
    O.run(50, True)
    assert one.state.vel[1] / one.state.vel[0] == pytest.approx(1 / 3, rel=1e-9)
    assert one.state.angVel[2] == pytest.approx(40, rel=1e-12)


@pytest.mark.parametrize("restitution", (0.0, 0.5, 1.0))
def test_two_balls_meet_with_restitution(restitution):
    stuff = material(0.0, restitution=restitution)
    way = np.array([2.0, -1.0, 2.0]) / 3
    one = ball((0, 0, 0), stuff, vel=tuple(4 * way))
    other = ball(tuple(1.02 * way), stuff)
    begin(gravity=(0, 0, 0))
    O.run(30, True)
    u = 0.5 * (1 - restitution) * 4, 0.5 * (1 + restitution) * 4
    assert tuple(one.state.vel) == pytest.approx(tuple(u[0] * way), abs=1e-12)
    assert tuple(other.state.vel) == pytest.approx(tuple(u[1] * way), abs=1e-12)


def test_momentum_and_angular_momentum_are_kept():
    stuff = material(0.4, rollingFriction=0.05, twistingFriction=0.05)
    rng = np.random.default_rng(3)
    balls = []
    for k in range(27):
        place = np.array([k % 3, k // 3 % 3, k // 9], float) * 1.02
        body = ball(
            tuple(place), stuff, vel=tuple(rng.normal(size=3) - 0.5 * (place - 1)), angVel=tuple(rng.normal(size=3))
        )
        balls.append(body)
    begin(gravity=(0, 0, 0), relaxationRate=0)

    def momenta():
        p = sum((b.state.mass * b.state.vel for b in balls), Vector3.Zero)
        spin = sum(
            (b.state.mass * b.state.pos.cross(b.state.vel) + b.state.inertia[0] * b.state.angVel for b in balls),
            Vector3.Zero,
        )
        return np.array([*p, *spin])

    before = momenta()
    O.run(200, True)
    scale = sum(b.state.mass * b.state.vel.norm() for b in balls)
    # linear to rounding; angular also misses what a step's straight way makes of a contact's arm, of second order in the step
    assert np.abs(momenta() - before)[:3].max() < 1e-12 * scale
    assert np.abs(momenta() - before)[3:].max() < 1e-4 * scale


def test_facets_that_lie_in_one_plane_are_one_floor():
    """A ball that rolls over inner edges and vertices has one contact and no vertical velocity."""
    stuff = material(0.6)
    size = 1.3
    for i in range(6):
        for j in range(6):
            a, b = np.array([i, j]) * size - 1, np.array([i + 1, j + 1]) * size - 1
            add(facet([(*a, 0), (b[0], a[1], 0), (*b, 0)]), stuff)
            add(facet([(*a, 0), (*b, 0), (a[0], b[1], 0)]), stuff)
    speed = 2.0
    one = ball((0, 0.02, R), stuff, vel=(speed, 0.7 * speed, 0), angVel=(-0.7 * speed / R, speed / R, 0))
    begin(step=2e-3)
    worst = 0
    for _ in range(1000):
        O.step()
        worst = max(worst, abs(one.state.vel[2]))
        assert len(touching()) == 1
    assert one.state.pos[0] > 3.9 and worst < 1e-9 * speed
    assert one.state.vel[0] == pytest.approx(speed, rel=1e-9)


@pytest.mark.parametrize("turned", (0.0, 0.7))
def test_a_ball_on_a_ridge_has_one_contact_and_in_a_groove_two(turned):
    stuff = material(0.0)
    turn = Quaternion((0, 0, 1), turned)
    for sign, count in ((-1, 1), (1, 2)):
        O.reset()
        stuff = material(0.9)
        ridge = [turn * Vector3(-2, 0, 0), turn * Vector3(2, 0, 0)]
        for side in (-1, 1):
            add(facet([ridge[0], ridge[1], turn * Vector3(0.1, side * 3, 3.0 * sign)]), stuff)
        height = R if sign < 0 else R * math.sqrt(2)
        ball(turn * Vector3(0.2, 0, height), stuff)
        begin()
        O.step()
        O.step()
        assert len(touching()) == count


def test_a_facet_that_has_gone_along_the_edge_holds_nothing():
    """Two facets share an edge; over one of them a ball touches it alone, and the other one's edge once it is gone."""
    stuff = material(0.0)
    edge = [(0, -2, 0), (0, 2, 0)]
    add(facet([*edge, (-2, 0, 0)]), stuff)
    right = add(facet([*edge, (2, 0, 0)]), stuff)
    ball((0.02, 0, R - 1e-3), stuff)
    begin(gravity=(0, 0, 0))
    O.step()
    O.step()
    assert [i.geom.normal[0] for i in O.interactions if i.isReal and i.geom.penetrationDepth > 0] == [0]
    right.state.pos = (0, 10, 0)
    O.step()
    O.step()
    (normal,) = [i.geom.normal for i in O.interactions if i.isReal and i.geom.penetrationDepth > 0]
    assert normal[0] == pytest.approx(0.02 / R, rel=0.01)


def test_a_wall_that_moves_carries_a_ball():
    stuff = material(0.5)
    (floor,) = FLOORS["box"](stuff)
    floor.state.vel = (0.3, 0, 0.1)
    one = ball((0, 0, R), stuff)
    begin()
    O.run(1000, True)
    assert one.state.vel[2] == pytest.approx(0.1, abs=1e-12)
    # it rolls on a floor that moves: (2/7) of its speed is carried, as angular momentum about the contact says
    assert one.state.vel[0] == pytest.approx(2 / 7 * 0.3, rel=1e-9)


def test_a_floor_that_turns_about_an_axis_far_away_moves_as_its_points_do():
    stuff = material(0.0)
    floor = add(box((0, 0, -1), (50, 50, 1), fixed=True), stuff)
    floor.state.angVel = (0, -0.01, 0)  # rises on the right
    one = ball((10, 0, R), stuff)
    begin()
    O.step()
    assert one.state.vel[2] == pytest.approx(0.1, rel=1e-3)


def test_a_scene_that_is_turned_gives_the_turned_result():
    """Frame indifference: gravity, floor and balls turned together."""
    turn = Quaternion(Vector3(1, 2, 3).normalized(), 1.1)
    rng = np.random.default_rng(5)
    places = [np.array([k % 2, k // 2 % 2, k // 4], float) * 1.05 + rng.uniform(-0.01, 0.01, 3) for k in range(12)]

    def play(turn):
        O.reset()
        stuff = material(0.4, rollingFriction=0.03, twistingFriction=0.02, restitution=0.2)
        corners = [(-9, -9, -R), (9, -9, -R), (9, 9, -R), (-9, 9, -R)]
        for k in (1, 2):
            add(facet([turn * Vector3(*corners[n]) for n in (0, k, k + 1)]), stuff)
        balls = [ball(turn * Vector3(*p), stuff) for p in places]
        begin(gravity=turn * Vector3(0, 0, -G), tolerance=1e-12, maxIterations=20000, precision="double")
        O.run(60, True)
        back = turn.inverse()
        return np.array([[*(back * b.state.pos), *(back * b.state.vel), *(back * b.state.angVel)] for b in balls])

    straight = play(Quaternion.Identity)
    assert np.abs(play(turn) - straight).max() < 1e-9 * np.abs(straight).max()


def test_the_same_bits_on_any_number_of_threads_and_after_loading(tmp_path):
    def build():
        O.reset()
        stuff = material(0.4, rollingFriction=0.03)
        FLOORS["facets"](stuff)
        rng = np.random.default_rng(9)
        for k in range(60):
            ball(
                tuple(np.array([k % 4, k // 4 % 4, k // 16], float) + rng.uniform(0, 0.02, 3) + (0, 0, R)),
                stuff,
                radius=0.5,
            )
        begin(tolerance=1e-4)
        for engine in O.engines:
            engine.ompThreads = threads

    def state():
        return [tuple(b.state.pos) + tuple(b.state.vel) + tuple(b.state.angVel) for b in O.bodies]

    found = {}
    for threads in (1, 2):
        build()
        with threads_allowed(threads):
            ContactDynamicsEngine.advance(100)
        found[threads] = state()
    threads = 1
    build()
    O.run(40, True)
    O.save(str(tmp_path / "scene.yade"), quiet=True)
    O.load(str(tmp_path / "scene.yade"), quiet=True)
    O.run(60, True)
    assert found[1] == found[2] == state()


def test_sums_over_many_contacts_are_the_same_on_any_number_of_threads():
    """A bed of 12 x 12 x 9 balls has some 3,000 contacts, which are summed up in several parts, and breaks in order."""

    def found(threads):
        O.reset()
        stuff = material(0.4, rollingFriction=0.03, tensileStrength=5e3)
        FLOORS["wall"](stuff)
        rng = np.random.default_rng(4)
        for k in range(12 * 12 * 9):
            place = np.array([k % 12, k // 12 % 12, k // 144], float) + rng.uniform(0, 0.01, 3)
            ball(tuple(place + (0, 0, R)), stuff, vel=Vector3(rng.uniform(-3, 3, 3)))
        begin(tolerance=1e-3, reach=0.1)
        for engine in O.engines:
            engine.ompThreads = threads
        O.step()
        solver = next(engine for engine in O.engines if isinstance(engine, ContactDynamicsEngine))
        solver.bond()
        with threads_allowed(threads):
            solver.advance(20)
        modes = ("Tension", "Shear", "Torque", "Twisting", "Mixed")
        broken = sum(getattr(solver, f"broken{mode}") for mode in modes)
        assert solver.contacts > 2048 and broken > 20
        assert len(solver.breakTable()) == broken * 7 * 8  # doubles
        sums = "kineticEnergy potentialEnergy slidingLoss rollingLoss debondingLoss impactLoss overlapMean meanSpeed"
        return [getattr(solver, name) for name in sums.split()], solver.breakTable(), state_of_all()

    def state_of_all():
        return [tuple(b.state.pos) + tuple(b.state.vel) + tuple(b.state.angVel) for b in O.bodies]

    one = found(1)
    assert found(2) == one and found(3) == one


def test_a_contact_runs_from_the_lower_id_whatever_order_yade_keeps(tmp_path):
    from yade.nonsmooth import contact

    stuff = material()
    low, high = ball((0, 0, 0), stuff), ball((0, 0, 0.99), stuff)
    begin(gravity=(0, 0, 0))
    O.step()
    O.interactions.clear()
    createInteraction(high.id, low.id)
    O.step()
    (kept,) = (i for i in O.interactions if i.isReal)
    assert (kept.id1, kept.id2) == (high.id, low.id) and kept.geom.normal[2] == -1
    next(engine for engine in O.engines if isinstance(engine, ContactDynamicsEngine)).dump(str(tmp_path / "step.h5"))
    problem = contact.load(str(tmp_path / "step.h5"))
    assert problem.body.tolist() == [[low.id, high.id]] and problem.normal.tolist() == [[0, 0, 1]]


def test_energy_is_accounted_for():
    """Without gravity, whose work a step of first order knows up to the step alone."""
    stuff = material(0.4, rollingFriction=0.03, twistingFriction=0.02, restitution=0.3)
    rng = np.random.default_rng(4)
    for k in range(27):
        place = np.array([k % 3, k // 3 % 3, k // 9]) * 1.05 - 1.05
        ball(tuple(place), stuff, vel=tuple(rng.normal(size=3) - place), angVel=tuple(rng.normal(size=3)))
    begin(gravity=(0, 0, 0), tolerance=1e-9, maxIterations=5000, precision="double")
    O.run(800, True)
    energies = O.engines[-2].energies()
    parts = [energies[name] for name in ("sliding", "rolling", "impact")]
    assert min(parts) > 0
    assert abs(energies["error"]) < 1e-8 * sum(parts)  # what the solver's tolerance leaves


def test_a_scene_whose_bodies_stay_in_the_plane_is_solved_there():
    stuff = material()
    for x in (0, 0.99):
        ball((x, 0, 0), stuff, blockedDOFs="zXY")
    begin(gravity=(0, -G, 0))
    O.step()
    (contact,) = [i for i in O.interactions if i.isReal]
    assert type(contact.phys).__name__ == "NscdPhys"


BONDED = dict(tensileStrength=1e6, residualTensileStrength=0, rollingFriction=0.1, twistingFriction=0.2)


def test_a_bonded_tower_that_lands_loses_all_it_had_by_the_impact():
    """In its bond as on the floor."""
    stuff = material(0.5, tensileStrength=1e9, bondsToAll=True)
    facets(stuff)
    tower = [ball((0, 0, R + 2 * R * k + 0.01), stuff) for k in range(2)]
    begin(gravity=(0, 0, 0), tolerance=1e-12, maxIterations=20000, precision="double")
    O.step()
    assert O.engines[-2].bond() >= 1
    for one in tower:
        one.state.vel = (0, 0, -1.0)
    O.run(30, True)
    energies = O.engines[-2].energies()
    assert energies["impact"] == pytest.approx(sum(one.state.mass for one in tower) / 2, rel=1e-6)
    assert abs(energies["error"]) < 1e-6 * energies["impact"]


def bonded_pair(pull, torque=(0, 0, 0), friction=0.5, way=(1, 0, 0), step=1e-4, **others):
    """A ball that is held and one bonded to it along ``way``, which bears a force [N] and a torque [N m]; the contact
    after so many steps."""
    stuff = material(
        friction, **{**BONDED, **others}, bondsToAll=True, bondEllipseNormal=0.01, bondEllipseTangential=0.01
    )
    way = np.array(way, float) / np.linalg.norm(way)
    ball((0, 0, 0), stuff, blockedDOFs="xyzXYZ")
    one = ball(tuple(2 * R * way), stuff)
    begin(gravity=(0, 0, 0), step=step, tolerance=1e-12, precision="double", maxIterations=20000)
    O.step()
    assert O.engines[-2].bond() == 1
    O.forces.setPermF(one.id, pull)
    O.forces.setPermT(one.id, torque)
    return one


AREA = math.pi * R * R  # of a contact of two spheres: pi/4 l^2
STRENGTH = 1e6 * AREA  # F_a [N]


def loads(name, share):
    """Force and torque on a bonded ball at the origin of its contact's axes (x is the normal) that are ``share`` of its
    strength. A pull at the centre loads the normal alone; a shear force is accompanied by the torque that keeps the
    contact free of a moment."""
    length = 2 * R
    if name == "tension":
        return (share * STRENGTH, 0, 0), (0, 0, 0)
    if name == "shear":
        force = share * 0.5 * STRENGTH
        return (0, force, 0), (0, 0, -force * R * -1)  # T acts at -R x: torque about the centre is taken by the load
    if name == "rolling":
        return (0, 0, 0), (0, share * 0.1 * length * STRENGTH, 0)
    return (0, 0, 0), (share * 0.2 * length * STRENGTH, 0, 0)


@pytest.mark.parametrize("name, mode", (("tension", 1), ("rolling", 3), ("twisting", 5)))
def test_a_bond_bears_its_threshold_and_no_more(name, mode):
    """To a millionth, in tension, rolling and twisting."""
    for share, lives in ((1 - 1e-6, True), (1 + 1e-6, False)):
        O.reset()
        one = bonded_pair(*loads(name, share))
        before = one.state.vel.norm() + one.state.angVel.norm()
        O.run(20, True)
        moved = one.state.vel.norm() + one.state.angVel.norm() - before
        # above its threshold it accelerates by the millionth that is left
        assert (moved < 1e-12) == lives, (name, share, moved)


@pytest.mark.parametrize(
    "name, mode, counter", (("tension", 1, "Tension"), ("rolling", 3, "Torque"), ("twisting", 5, "Twisting"))
)
def test_a_bond_that_is_overloaded_breaks_in_the_mode_of_its_load(name, mode, counter):
    one = bonded_pair(*loads(name, 2.0), step=1e-3)
    solver = O.engines[-2]
    for _ in range(400):
        O.step()
        if getattr(solver, f"broken{counter}"):
            break
    assert getattr(solver, f"broken{counter}") == 1 and solver.bonds == 0


def test_a_bonded_pair_that_is_sheared_breaks_in_shear():
    stuff = material(0.1, **{**BONDED, "rollingFriction": 10, "twistingFriction": 10}, bondsToAll=True)
    ball((0, 0, 0), stuff, blockedDOFs="xyzXYZ")
    one = ball((2 * R, 0, 0), stuff, blockedDOFs="XYZ")
    begin(gravity=(0, 0, 0))
    O.step()
    O.engines[-2].bond()
    O.forces.setPermF(one.id, (0, 0, 3 * 0.1 * STRENGTH))
    for _ in range(200):
        O.step()
        if not O.engines[-2].bonds:
            break
    assert O.engines[-2].brokenShear == 1


def test_a_roll_is_no_twist():
    """A bond whose ellipsoid is thin about its axis bears a roll of twice that angle."""
    one = bonded_pair((0, 0, 0), rollingFriction=0, twistingFriction=1, bondEllipseTwisting=5e-4)
    one.state.angVel = (0, 0.5, 0)
    one.state.blockedDOFs = "xyzXYZ"
    O.run(20, True)
    assert O.engines[-2].bonds == 1


def test_without_a_bond_the_residual_twisting_friction_holds():
    stuff = material(0.5, twistingFriction=0.3, residualTwistingFriction=0.0)
    FLOORS["wall"](stuff)
    one = ball((0, 0, R), stuff, angVel=(0, 0, 5))
    begin()
    O.run(50, True)
    assert one.state.angVel[2] == pytest.approx(5, rel=1e-12)


def test_the_problem_of_a_step_is_written_and_solved_again(tmp_path):
    from yade.nonsmooth import contact

    stuff = material(0.4, rollingFriction=0.03, twistingFriction=0.02)
    FLOORS["box"](stuff)
    for k in range(8):
        ball((k % 2, k // 2 % 2, R + k // 4), stuff)
    begin(tolerance=1e-8, precision="double")
    O.run(3, True)
    O.engines[-2].dump(str(tmp_path / "step.h5"))
    problem = contact.load(str(tmp_path / "step.h5"))
    assert type(problem) is contact.SpaceProblem and len(problem.body) == O.engines[-2].candidates
    assert contact.residual(problem).relative == pytest.approx(O.engines[-2].residual, abs=1e-12)
    floor, balls = problem.body[problem.body[:, 0] == 0], problem.body[problem.body[:, 0] != 0]
    # from the floor to the ball, and from the ball of the lower id to the other
    assert len(floor) == 4 and len(balls) == 12 and np.all(balls[:, 0] < balls[:, 1])
