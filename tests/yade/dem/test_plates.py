"""Plates under a force or a stress: Newton's law where they are free, equilibrium where they press."""
import math

import pytest
from yade import O, pack
from yade.minieigenHP import Vector3
from yade.nonsmooth import scene
from yade.wrapper import NewtonIntegrator

from contact_scenes import G, begin, material, run, state

pytestmark = pytest.mark.usefixtures("empty")

ANGLES = [0.0, math.pi / 2, math.pi, -math.pi / 2, math.radians(30), math.radians(-127)]


def turned(x, y, angle):
    return x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle)


def lid(angle, **load):
    """A plate of 2 m that is pushed downwards in a scene that is turned by an angle."""
    return scene.plate([turned(1, 2, angle), turned(-1, 2, angle)], material(0.3), **load)


@pytest.mark.parametrize("angle", ANGLES)
def test_a_plate_without_a_mass_is_a_tenth_as_thick_as_long(angle):
    """Of disks' 2500 kg/m³ and 2 m: 0.1 times 2500 times 4, and a rod's inertia about its middle."""
    begin(gravity=(0, -G, 0), dt=1e-3)
    state = O.bodies[lid(angle, force=1.0).id].state
    assert state.mass == pytest.approx(1000.0) and tuple(state.inertia) == pytest.approx((1000 * 4 / 12,) * 3)


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("load, force", [(dict(force=300.0), 300.0), (dict(stress=200.0), 400.0)])
def test_a_free_plate_has_the_acceleration_force_by_mass(angle, load, force):
    begin(gravity=(0, -G, 0), dt=1e-3)
    engine = lid(angle, mass=50.0, **load)
    s, start = O.bodies[engine.id].state, O.bodies[engine.id].state.pos
    run(200)
    way = Vector3(*turned(0, -1, angle), 0)
    t = O.time
    # the weight is taken off; exact in Moreau-Jean stepping, to the solver's tolerance where a guide holds
    assert s.vel.dot(way) == pytest.approx(force / 50 * t, rel=1e-9)
    assert (s.pos - start).dot(way) == pytest.approx(force / 50 * t * (t + O.dt) / 2, rel=1e-9)
    across = Vector3(-way[1], way[0], 0)
    assert abs((s.pos - start).dot(across)) < 1e-9 and s.angVel[2] == 0
    assert engine.load == pytest.approx(force, rel=1e-12) and engine.width == pytest.approx(2)


@pytest.mark.parametrize("angle", [0.0, math.radians(30), math.radians(-30)])
def test_a_plate_with_weight_falls(angle):
    """A guide bears the weight across the way on either of its sides."""
    begin(gravity=(0, -G, 0), dt=1e-3)
    engine = lid(angle, mass=50.0, force=100.0, weightless=False)
    run(100)
    way = Vector3(*turned(0, -1, angle), 0)
    assert O.bodies[engine.id].state.vel.dot(way) == pytest.approx((2 + G * math.cos(angle)) * O.time, rel=1e-9)
    assert abs(O.bodies[engine.id].state.vel.dot(Vector3(-way[1], way[0], 0))) < 1e-9


@pytest.mark.parametrize("angle", [0.0, math.radians(30)])
@pytest.mark.parametrize("damping", [500.0, 1e7])
def test_a_damped_plate_comes_to_the_speed_force_by_damping(angle, damping):
    """Also where the damping is stiff beside the step, h c/m = 200."""
    begin(gravity=(0, 0, 0), dt=1e-3)
    engine = lid(angle, mass=50.0, force=1000.0, damping=damping)
    seen = []
    for _ in range(20):
        run(50)
        seen.append(O.bodies[engine.id].state.vel.dot(Vector3(*turned(0, -1, angle), 0)))
    assert seen == sorted(seen)  # no overshoot
    # F/c + h F/m, reached as 1 − exp(−c t/m), in a second here
    final = 1000 * (1 / damping + O.dt / 50)
    assert seen[-1] == pytest.approx(final * (1 - math.exp(-min(50, damping / 50))), rel=1e-4)


def box(angle, mu_side=0.0, width=1.0):
    """A floor and two smooth sides, turned; returns floor, left and right."""
    smooth, rough = material(mu_side, wall=True), material(0.4)

    def wall(a, b):
        return O.bodies.append(scene.segments([turned(*a, angle), turned(*b, angle)], smooth, sense=1))[0]

    floor, right, left = wall((-1, 0), (width + 1, 0)), wall((width, -1), (width, 4)), wall((0, 4), (0, -1))
    for k in range(50):
        x, y = 0.1 + 0.2 * (k % 5), 0.11 + 0.21 * (k // 5)
        r = 0.08 + 0.02 * ((7 * k) % 11) / 11
        O.bodies.append(scene.disk(turned(x, y, angle), r, rough))
    return floor, left, right


@pytest.mark.parametrize("angle", [0.0, math.radians(30), math.radians(-127)])
def test_a_floor_bears_the_stress_on_the_width_between_the_walls(angle):
    """The plate is wider than the box, so its own length is not what counts; no gravity, smooth sides."""
    begin(gravity=(0, 0, 0), dt=2e-3, tolerance=1e-9, maxIterations=5000)
    floor, left, right = box(angle)
    engine = scene.plate(
        [turned(2, 2.3, angle), turned(-1, 2.3, angle)],
        O.materials[0],
        stress=2e4,
        mass=300.0,
        between=(left, right),
        damping=3000,
    )
    run(1500)
    down = Vector3(*turned(0, -1, angle), 0)
    assert engine.width == pytest.approx(1, rel=1e-12) and engine.load == pytest.approx(2e4, rel=1e-12)
    assert O.forces.f(floor).dot(down) == pytest.approx(2e4, rel=1e-5)  # what 3 s leave of the motion
    # what the sides bear is in balance, since nothing rubs on them; a guide bears what friction asks for across the way
    across = Vector3(-down[1], down[0], 0)
    assert abs(O.forces.f(left).dot(across) + O.forces.f(right).dot(across)) < 1e-4 * 2e4


def test_two_plates_press_a_cloud_from_two_sides():
    """The servo of a biaxial test: each plate's load follows what the other leaves of its width; a cloud of YADE's
    comes to rest under both stresses, and takes half as much again on one side.
    """
    solver = begin(gravity=(0, 0, 0), dt=1e-3, tolerance=1e-6, maxIterations=1000)
    rough, smooth = material(0.5), material(0.0, wall=True)
    bottom, left = (
        O.bodies.append(scene.segments(line, smooth, sense=1))[0] for line in ([(-1, 0), (3, 0)], [(0, 3), (0, -1)])
    )
    heavy = dict(mass=2000.0, damping=2e5)
    right = scene.plate([(2, -1), (2, 3)], smooth, stress=1e5, **heavy)
    top = scene.plate([(3, 2), (-1, 2)], smooth, stress=1e5, between=(left, right.id), **heavy)
    right.between = [bottom, top.id]
    cloud = pack.SpherePack()
    cloud.makeCloud((0, 0, 0), (2, 2, 0), rMean=0.05, rRelFuzz=0.3, num=200, seed=1)
    O.bodies.append(scene.disks(cloud, rough))

    def stresses():
        width, height = O.bodies[right.id].state.pos[0], O.bodies[top.id].state.pos[1]
        assert (right.width, top.width) == pytest.approx((height, width), rel=1e-4)
        return -O.forces.f(left)[0] / height, -O.forces.f(bottom)[1] / width

    solver.advance(2000)
    assert stresses() == pytest.approx((1e5, 1e5), rel=2e-3)  # some disks still rattle
    top.stress = 1.5e5
    solver.advance(1600)
    assert stresses() == pytest.approx((1e5, 1.5e5), rel=5e-3)


def test_the_load_follows_the_walls_that_move():
    begin(gravity=(0, 0, 0), dt=1e-3)
    _, left, right = box(0.0)
    engine = scene.plate([(3, 3), (-1, 3)], O.materials[0], stress=1e3, mass=1e4, between=(left, right))
    O.bodies[right].state.vel = (0.5, 0, 0)
    run(1000)
    # by what the walls were apart when the last step began
    assert engine.load == pytest.approx(1e3 * (1 + 0.5 * 0.999), rel=1e-9)
    O.bodies[right].state.vel = (5, 0, 0)
    run(1000)
    assert engine.width == pytest.approx(4)  # no more than the plate is long


def test_between_inclined_walls_the_width_is_that_at_the_plate():
    begin(gravity=(0, 0, 0), dt=1e-3)
    stuff = material(0.3)
    left, right = (O.bodies.append(scene.segments([(s * 1, 0), (s * 3, 2)], stuff))[0] for s in (-1, 1))
    engine = scene.plate([(9, 1.5), (-9, 1.5)], stuff, stress=1e3, mass=1e9, between=(left, right))
    run(1)
    assert engine.width == pytest.approx(5, rel=1e-12)  # a funnel of 45°, 2 m wide at its foot


@pytest.mark.parametrize("angle", ANGLES)
def test_between_disks_the_width_is_that_of_their_centres_along_the_plate(angle):
    """Posts have no direction in which they could go on to the plate."""
    begin(gravity=(0, 0, 0), dt=1e-3)
    stuff = material(0.3)
    posts = [O.bodies.append(scene.disk(turned(*at, angle), 0.1, stuff, fixed=True)) for at in ((-1, 0.5), (1.5, 1.2))]
    ends = [turned(3, 2, angle), turned(-3, 2, angle)]
    engine = scene.plate(ends, stuff, stress=1e3, mass=1e9, between=posts)
    run(1)
    assert engine.width == pytest.approx(2.5, rel=1e-12) and engine.load == pytest.approx(2500, rel=1e-12)


@pytest.mark.parametrize("angle", [0.0, math.radians(30)])
def test_a_loaded_plate_goes_on_after_loading(angle, tmp_path):
    def press():
        O.reset()
        begin(gravity=(0, -G, 0), dt=2e-3, tolerance=1e-9, maxIterations=5000)
        _, left, right = box(angle)
        scene.plate(
            [turned(2, 2.3, angle), turned(-1, 2.3, angle)],
            O.materials[0],
            stress=2e4,
            between=(left, right),
            label="servo",
        )
        run(100)

    ids = range(54)
    press()
    run(50)
    straight = state(ids)
    press()
    O.save(str(tmp_path / "half.yade.bz2"))
    O.load(str(tmp_path / "half.yade.bz2"))
    run(50)
    assert state(ids) == straight


def test_it_may_be_pushed_along_itself():
    """A plate that shears: it moves along its length, under a force."""
    begin(gravity=(0, -G, 0), dt=1e-3)
    engine = scene.plate([(1, 2), (-1, 2)], material(0.3), force=20.0, mass=10.0, direction=(1, 0))
    run(100)
    assert O.bodies[engine.id].state.vel == pytest.approx((2 * O.time, 0, 0), rel=1e-9)
    with pytest.raises(ValueError, match="takes no stress"):
        scene.plate([(1, 2), (-1, 2)], material(0.3), stress=20.0, direction=(1, 0))


@pytest.mark.parametrize("angle", [0.0, math.radians(30)])
def test_it_works_beside_soft_contacts(angle):
    from yade.wrapper import ForceResetter

    O.engines = [ForceResetter(), NewtonIntegrator(damping=0, gravity=(0, -G, 0))]
    O.dt = 1e-3
    engine = lid(angle, mass=50.0, force=300.0, weightless=False)
    run(200)
    way = Vector3(*turned(0, -1, angle), 0)
    assert O.bodies[engine.id].state.vel.dot(way) == pytest.approx((6 + G * math.cos(angle)) * O.time, rel=1e-9)
    assert abs(O.bodies[engine.id].state.vel.dot(Vector3(-way[1], way[0], 0))) < 1e-12


def test_what_does_not_make_a_plate_is_told():
    stuff = material(0.3)
    O.engines = []
    with pytest.raises(LookupError, match="set O.engines"):
        scene.plate([(1, 2), (-1, 2)], stuff, force=1.0)
    assert len(O.bodies) == 0
    begin()
    for words, more in (
        ("mass = -1", dict(mass=-1)),
        ("direction = ", dict(direction=(0, 0))),
        ("two neighbouring vertices", dict(ends=[(1, 2), (1, 2)])),
    ):
        with pytest.raises(ValueError, match=words):
            scene.plate(**{**dict(ends=[(1, 2), (-1, 2)], material=stuff, force=1.0), **more})


@pytest.mark.parametrize(
    "attribute, value, words",
    [
        ("id", 99, "id = 99: there is no such body"),
        ("direction", (0, 0, 1), "give a vector in the x-y plane"),
        ("damping", -1.0, "damping = -1"),
        ("stress", float("nan"), "stress = nan"),
        ("between", [0], "give two bodies"),
        ("between", [0, 77], "id 77"),
        ("between", [0, 0], "parallel to the plate"),
    ],
)
def test_values_without_sense_are_refused(attribute, value, words):
    begin()
    O.bodies.append(scene.segments([(-1, 0), (1, 0)], material(0.3)))
    engine = lid(0.0, force=1.0)
    setattr(engine, attribute, value)
    with pytest.raises(RuntimeError) as error:
        O.step()
    assert words in str(error.value)
