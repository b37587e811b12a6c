"""NonsmoothTimeStepper: the step follows from speeds and bonds, is the same after loading, and does not change the
physics.
"""
import math

import pytest
from contact_scenes import G, begin, bits, box, engine, loose_heap, material, run
from yade import O
from yade.nonsmooth import scene
from yade.wrapper import CourseRunner, NonsmoothTimeStepper


pytestmark = pytest.mark.usefixtures("empty")


def stepper(**options):
    made = NonsmoothTimeStepper(**options)
    O.engines = [made] + O.engines
    return made


def pair(speed, stuff, bonded=False):
    """A fixed disk and a free one on its right, touching; the free one moves upwards."""
    O.bodies.append(scene.disk((0, 0), 1.0, stuff, fixed=True))
    free = O.bodies.append(scene.disk((2, 0), 1.0, stuff))
    begin(gravity=(0, 0, 0))
    if bonded:
        O.step()
        assert engine().bond() == 1
    O.bodies[free].state.vel = (0, speed, 0)
    return free


def test_grows_to_the_largest_where_nothing_moves():
    O.bodies.append(scene.disk((0, 0), 1.0, material(0.3)))
    begin(gravity=(0, 0, 0), dt=1e-3)
    s = stepper(largest=4e-3, growth=1.5)
    steps, limits = [], []
    for _ in range(5):
        O.step()
        steps.append(O.dt)
        limits.append(s.limit)
    assert steps == pytest.approx([1.5e-3, 2.25e-3, 3.375e-3, 4e-3, 4e-3], rel=1e-12) and limits == [3, 3, 3, 0, 0]
    O.dt = 1e-3
    O.step()
    assert O.dt == 1.5e-3


def test_a_step_that_an_exception_ended_does_not_grow_twice():
    """After the solver has been through it, in the third step of a scene; the next one grows from it as from any
    other.
    """
    O.bodies.append(scene.disk((0, 0), 1.0, material(0.3)))
    begin(gravity=(0, 0, 0), dt=1e-3)
    stepper(largest=1.0, growth=1.5)
    O.engines = O.engines + [CourseRunner(command="pass", dead=True)]
    run(2)
    O.engines[-1].dead = False
    for _ in range(3):
        with pytest.raises(RuntimeError, match="not the first of O.engines"):
            O.step()
        assert O.iter == 2 and O.dt == pytest.approx(1.5**3 * 1e-3, rel=1e-12)
    O.engines[-1].dead = True
    run(2)
    assert O.dt == pytest.approx(1.5**4 * 1e-3, rel=1e-12)


def test_contacts_bound_the_step():
    speed = 3.0
    pair(speed, material(0.0))
    s = stepper(largest=1.0, path=0.05, growth=1.5)
    while s.limit != 1:
        O.step()
        assert O.iter < 40
    # the free disk flies past, its speed against the fixed one stays; ℓ = 2 m
    assert O.dt == pytest.approx(0.05 * 2 / speed, rel=1e-12)


def test_bonds_bound_the_step_and_are_crossed_in_several():
    stuff = material(
        0.3, tensileStrength=1e3, bondEllipseNormal=0.02, bondEllipseTangential=0.01, bondCreationDistance=0.02
    )
    free = pair(0.0, stuff, bonded=True)
    O.bodies[free].state.vel = (2.0, 0, 0)
    s = stepper(largest=1.0, bondPath=0.25, growth=1.5)
    steps = 0
    while engine().brokenTension + engine().brokenMixed == 0:
        O.step()
        steps += 1
        assert steps < 1000
    assert steps >= 4 and s.limit in (1, 2)  # ε_n ℓ = 0.04 m in quarters at least


# ---- the rates, and what else bounds a step -------------------------------------------------------


def test_the_rate_of_two_disks_is_that_of_their_centres():
    stuff = material(0.0)
    for x, y, r, velocity in (
        (0, 0, 0.5, (1.0, 2.0, 0)),
        (1.2, 0, 0.7, (4.0, -2.0, 0)),
        (9, 9, 0.5, (50, 0, 0)),
    ):  # the last one touches nothing
        k = O.bodies.append(scene.disk((x, y), r, stuff))
        O.bodies[k].state.vel, O.bodies[k].state.angVel = velocity, (0, 0, 30)  # spins do not count
    e = begin(gravity=(0, 0, 0))
    O.step()
    assert e.contactRate == 0 and e.bondRate == 0  # found only for a stepper
    s = stepper(path=0.05, largest=1.0, growth=1e9)
    O.bodies[0].state.pos, O.bodies[1].state.pos = (0, 0, 0), (1.2, 0, 0)
    O.step()
    assert s.limit == 0 and O.dt == 1.0  # what the step before did not find bounds nothing
    O.dt = 1e-3
    O.bodies[0].state.pos, O.bodies[1].state.pos = (0, 0, 0), (1.2, 0, 0)
    s.largest = 1e-3
    O.step()
    assert e.contactRate == pytest.approx(5.0 / 1.2, rel=1e-12)  # |(3, −4)| over the sum of radii
    s.largest = 1.0
    O.step()
    assert O.dt == pytest.approx(0.05 / (5.0 / 1.2), rel=1e-12) and s.limit == 1


@pytest.mark.parametrize("velocity, rate", [((3.0, 0.2, 0), 0.2), ((3.0, 0, 0), 0.0), ((0.1, 0.6, 0), 0.6)])
def test_the_rate_at_a_wall_is_normal_to_it(velocity, rate):
    stuff, turn = material(0.0), 0.4
    c, sn = math.cos(turn), math.sin(turn)
    O.bodies.append(scene.segments([(-5 * c, -5 * sn), (5 * c, 5 * sn)], stuff))
    disk = O.bodies.append(scene.disk((-0.8 * sn, 0.8 * c), 0.8, stuff))
    O.bodies[disk].state.vel = (c * velocity[0] - sn * velocity[1], sn * velocity[0] + c * velocity[1], 0)
    begin(gravity=(0, 0, 0))
    stepper(largest=1e-3)
    O.step()
    assert engine().contactRate == pytest.approx(rate / 1.6, rel=1e-9, abs=1e-12)  # over the disk's diameter


@pytest.mark.parametrize("velocity, rate", [((2.0, 0.1, 0), "normal"), ((0.2, 0.8, 0), "shear")])
def test_the_rate_of_a_bond_is_that_at_which_it_crosses_its_ellipse(velocity, rate):
    strength, h = 1e3, 1e-3
    stuff = material(
        0.5, tensileStrength=strength, bondEllipseNormal=0.05, bondEllipseTangential=0.02, bondCreationDistance=0.02
    )
    free = pair(0.0, stuff, bonded=True)
    s = O.bodies[free].state
    s.vel = velocity
    stepper(largest=h, bondPath=0.25)
    O.step()
    e = engine()
    # it yields in tension with F_a, and then there is no friction and no torque: μ (F_a + N) = 0; ℓ = 2 m
    opening = velocity[0] - h * 2 * strength / s.mass
    assert s.vel[0] == pytest.approx(opening, rel=1e-12) and s.vel[1] == pytest.approx(velocity[1], rel=1e-12)
    normal, shear = opening / (0.05 * 2), velocity[1] / (0.02 * 2)
    assert e.bondRate == pytest.approx(max(normal, shear), rel=1e-12) and (normal > shear) == (rate == "normal")
    assert e.contactRate == pytest.approx(math.hypot(opening, velocity[1]) / 2, rel=1e-12)
    O.engines[0].largest = O.engines[0].path = 1.0
    O.engines[0].growth = 1e9
    O.step()
    assert O.dt == pytest.approx(0.25 / max(normal, shear), rel=1e-12) and O.engines[0].limit == 2


@pytest.mark.parametrize("faster", ["opens", "slides"])
@pytest.mark.parametrize("first", ["opens", "slides"])
def test_the_rate_of_bonds_is_the_largest_of_all(first, faster):
    """Two pairs far apart, one of which opens and the other slides, without friction: the faster one counts, whichever
    stands first."""
    strength, h = 1e3, 1e-3
    stuff = material(
        0.0, tensileStrength=strength, bondEllipseNormal=0.05, bondEllipseTangential=0.02, bondCreationDistance=0.02
    )
    kinds = ("opens", "slides") if first == "opens" else ("slides", "opens")
    speeds = {kind: 1.0 if kind == faster else 0.1 for kind in kinds}
    free = {}
    for k, kind in enumerate(kinds):
        O.bodies.append(scene.disk((20 * k, 0), 1.0, stuff, fixed=True))
        free[kind] = O.bodies[O.bodies.append(scene.disk((20 * k + 2, 0), 1.0, stuff))].state
    e = begin(gravity=(0, 0, 0), dt=h)
    O.step()
    assert e.bond() == 2
    free["opens"].vel, free["slides"].vel = (speeds["opens"], 0, 0), (0, speeds["slides"], 0)
    stepper(largest=h)
    O.step()
    opening = speeds["opens"] - h * 2 * strength / free["opens"].mass  # it yields with F_a; ℓ = 2 m
    rates = {"opens": opening / (0.05 * 2), "slides": speeds["slides"] / (0.02 * 2)}
    assert (
        e.bonds == 2 and e.bondRate == pytest.approx(rates[faster], rel=1e-9) and rates[faster] == max(rates.values())
    )


def pile_that_is_struck(**limits):
    stuff = material(0.3)
    O.bodies.append(scene.segments([(-5, 0), (5, 0)], stuff))
    for k in range(6):
        O.bodies.append(scene.disk((0, 0.5 + k), 0.5, stuff))
    begin(dt=1e-4, **limits)
    return stepper(largest=1.0, growth=1.5, path=1e9)


def strike():
    """A step with a blow on the top of the pile, which has to get down; each is another one, or the last reactions
    would answer it.
    """
    O.bodies[6].state.vel = (0.1, -1 - 0.1 * O.iter, 0)
    O.step()


def test_a_step_does_not_grow_after_one_of_more_sweeps_than_wanted():
    s = pile_that_is_struck()
    for more in (0, 1, 0, 1):
        O.dt, s.sweeps = 1e-4, 0
        strike()
        sweeps, was = engine().iterations, O.dt
        assert sweeps > 1 and engine().unconverged == 0 and s.limit == 3
        s.sweeps = sweeps - more  # as many as it took are none too many
        strike()
        assert (s.limit, O.dt) == ((4, was) if more else (3, 1.5 * was))


def test_a_step_does_not_grow_after_one_that_was_not_solved():
    s = pile_that_is_struck(maxIterations=1, checkEvery=1)
    strike()
    was = O.dt
    for _ in range(3):
        strike()
        assert (s.limit, O.dt) == (4, was)
    engine().maxIterations, engine().tolerance = 20000, 1e-6
    strike()
    assert (s.limit, O.dt) == (4, was) and engine().unconverged == 4
    strike()
    assert (s.limit, O.dt) == (3, 1.5 * was)


def test_no_step_is_smaller_than_the_smallest():
    pair(400.0, material(0.0))
    s = stepper(smallest=2e-4, largest=1e-2, path=0.05, growth=10)
    O.dt = 1e-5
    O.step()
    assert (s.limit, O.dt) == (5, 2e-4)  # ten times 1e-5 are less
    assert engine().contactRate == pytest.approx(200.0, rel=1e-12)
    O.step()
    assert s.limit == 1 and O.dt == pytest.approx(0.05 / 200, rel=1e-12)
    s.path = 0.03  # 1.5e-4 s
    O.step()
    assert (s.limit, O.dt) == (5, 2e-4)


def test_slides_as_far_as_with_a_fixed_step():
    stuff = material(0.3)
    O.bodies.append(scene.segments([(-1, 0), (40, 0)], stuff, piece=5))
    block = [O.bodies.append(scene.disk((x, 0.5), 0.5, stuff)) for x in (0, 1)]
    for k in block:
        O.bodies[k].state.blockedDOFs = "zXYZ"
        O.bodies[k].state.vel = (5, 0, 0)
    begin(dt=1e-3)
    stepper(largest=2e-2)
    for _ in range(1000):
        O.step()
        if abs(O.bodies[block[0]].state.vel[0]) < 1e-6:
            break
    way, stop = O.bodies[block[0]].state.pos[0], 5 / (0.3 * G)
    # v²/(2 μ g); the implicit step ends at rest up to one step late and is short by v h/2
    assert way == pytest.approx(25 / (2 * 0.3 * G), abs=5 * 2e-2 / 2 + 1e-9)
    assert O.time == pytest.approx(stop, abs=2 * 2e-2)


def test_saved_scenes_go_on_with_the_same_steps(tmp_path):
    stuff = material(0.3, 0.1, tensileStrength=2e3, bondCreationDistance=0.02)
    box(stuff, 9.5, 12)
    loose_heap(stuff)
    begin(dt=2e-3, tolerance=1e-4, maxIterations=300)
    stepper(largest=2e-2, path=0.002, sweeps=40)
    run(300)
    engine().bond()
    O.engines[-1].gravity = (6, -G, 0)  # it slides against the wall
    run(20)
    saved = str(tmp_path / "state.yade.gz")
    O.save(saved)

    def course():
        steps = []
        for _ in range(150):
            O.step()
            steps.append(O.dt)
        return steps, bits(), O.time, O.engines[0].limit

    unbroken = course()
    assert len(set(unbroken[0])) > 20 and max(unbroken[0]) <= 2e-2
    O.reset()
    O.load(saved)
    assert course() == unbroken


@pytest.mark.parametrize(
    "options, words",
    [
        (dict(path=0.0), ("path = 0", "positive")),
        (dict(largest=1e-5), ("largest", "smallest")),
        (dict(growth=0.5), ("growth = 0.5", "at least 1")),
        (dict(smallest=math.nan), ("smallest", "positive")),
    ],
)
def test_refuses_limits_without_sense(options, words):
    O.bodies.append(scene.disk((0, 0), 1.0, material(0.3)))
    begin()
    stepper(**options)
    with pytest.raises(RuntimeError) as error:
        O.step()
    assert all(word in str(error.value) for word in words), str(error.value)


def test_refuses_another_place_and_a_missing_solver():
    O.bodies.append(scene.disk((0, 0), 1.0, material(0.3)))
    begin()
    engines = O.engines
    O.engines = engines + [NonsmoothTimeStepper()]
    with pytest.raises(RuntimeError, match="first in O.engines"):
        O.step()
    O.engines = [NonsmoothTimeStepper()] + [e for e in engines if e is not engine()]
    with pytest.raises(RuntimeError, match="no ContactDynamicsEngine"):
        O.step()
