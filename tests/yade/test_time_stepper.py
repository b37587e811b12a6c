"""NonsmoothTimeStepper: the step follows from speeds and bonds, is the same after loading, and does not change the physics."""
import math

import pytest
from contact_scenes import G, begin, bits, box, engine, loose_heap, material, run
from yade import O
from yade.nonsmooth import scene
from yade.wrapper import NonsmoothTimeStepper


@pytest.fixture(autouse=True)
def clean():
    O.reset()
    yield
    O.reset()


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
    stuff = material(0.3, tensileStrength=1e3, bondEllipseNormal=0.02, bondEllipseTangential=0.01, bondCreationDistance=0.02)
    free = pair(0.0, stuff, bonded=True)
    O.bodies[free].state.vel = (2.0, 0, 0)
    s = stepper(largest=1.0, bondPath=0.25, growth=1.5)
    steps = 0
    while engine().brokenTension + engine().brokenMixed == 0:
        O.step()
        steps += 1
        assert steps < 1000
    assert steps >= 4 and s.limit in (1, 2)  # ε_n ℓ = 0.04 m in quarters at least


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


@pytest.mark.parametrize("options, words", [
    (dict(path=0.0), ("path = 0", "positive")), (dict(largest=1e-5), ("largest", "smallest")), (dict(growth=0.5), ("growth = 0.5", "at least 1")),
    (dict(smallest=math.nan), ("smallest", "positive"))])
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
