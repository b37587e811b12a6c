"""Ground motion: exact integrals of a record, blocks that slide on shaken slopes, moving frame against moving walls."""
import math

import numpy as np
import pytest
from yade import O
from yade.minieigenHP import Vector3
from yade.nonsmooth import scene, shaking
from yade.nonsmooth.ground_motion import GroundMotion
from yade.wrapper import GroundMotionEngine, NonsmoothTimeStepper

from contact_scenes import G, begin, bits, box, engine, free_disk, loose_heap, material, run

pytestmark = pytest.mark.usefixtures("empty")

DIP = math.radians(30)
ALONG, NORMAL = Vector3(math.cos(DIP), -math.sin(DIP), 0), Vector3(math.sin(DIP), math.cos(DIP), 0)

TIMES, EAST, UP = [0.1, 0.35, 0.6, 1.1], [0.0, 3.0, -2.0, 0.7], [0.5, -1.0, 0.0, 2.0]


def integrals(times, values, until):
    """∫ a dt and ∫∫ a dt dt of a record that is linear between its times, by Simpson's rule on each part, which is exact
    for both.
    """
    v = d = 0.0
    for t0, t1, a0, a1 in zip(times, times[1:], values, values[1:]):
        if until <= t0:
            break
        to = min(t1, until)
        end, h = a0 + (a1 - a0) * (to - t0) / (t1 - t0), to - t0
        middle = (a0 + end) / 2
        d += h * v + h**2 * (2 * a0 + end) / 6
        v += h * (a0 + 4 * middle + end) / 6
    return v, d + v * max(0.0, until - times[-1])


@pytest.mark.parametrize("until", [0.05, 0.2, 0.35, 0.6, 0.85, 1.1, 1.7])
def test_velocity_and_displacement_are_the_records_integrals(until):
    ground = GroundMotionEngine(times=TIMES, horizontal=EAST, vertical=UP, begin=2.0, scale=1.5)
    for axis, values in enumerate((EAST, UP)):
        v, d = integrals(TIMES, values, until)
        assert ground.velocityAt(2 + until)[axis] == pytest.approx(1.5 * v, rel=1e-12, abs=1e-14)
        assert ground.displacementAt(2 + until)[axis] == pytest.approx(1.5 * d, rel=1e-12, abs=1e-14)
    inside = TIMES[0] <= until <= TIMES[-1]
    expected = 1.5 * np.interp(until, TIMES, EAST) if inside else 0.0
    assert ground.accelerationAt(2 + until)[0] == pytest.approx(expected, rel=1e-12, abs=1e-14)


@pytest.mark.parametrize("dt", [1e-3, 0.0137, 0.4])  # shorter than the record's intervals, and longer
def test_impulses_of_steps_sum_up_to_the_integral(dt):
    ground = GroundMotionEngine(times=TIMES, horizontal=EAST, vertical=UP, begin=0.2)
    disk = free_disk()
    begin(gravity=(0, 0, 0), dt=dt, before=[ground])
    run(math.ceil(2.0 / dt))
    for axis, values in enumerate((EAST, UP)):
        v, _ = integrals(TIMES, values, 10.0)
        # sums of at most 2,000 roundings of numbers of about 1
        assert O.bodies[disk].state.vel[axis] == pytest.approx(-v, abs=1e-12)
    assert ground.acceleration == Vector3(0, 0, 0) and ground.totalForce == Vector3(0, 0, 0)
    v, d = integrals(TIMES, EAST, O.time - 0.2)
    assert ground.velocity[0] == pytest.approx(v, rel=1e-12) and ground.displacement[0] == pytest.approx(d, rel=1e-12)


def test_steps_of_changing_length_bring_the_same_impulse():
    ground = GroundMotionEngine(times=TIMES, horizontal=EAST)
    disk = free_disk()
    begin(gravity=(0, 0, 0), before=[ground])
    for h in (0.013, 0.21, 0.0007, 0.5, 0.9):
        O.dt = h
        run(1)
    assert O.bodies[disk].state.vel[0] == pytest.approx(-integrals(TIMES, EAST, 5.0)[0], abs=1e-13)


def test_force_is_mass_times_mean_acceleration_on_free_bodies_alone():
    ground = GroundMotionEngine(times=[0, 1], horizontal=[2, 4], vertical=[0, -1])
    stuff = material(0.3)
    disks = [O.bodies.append(scene.disk((3 * k, 5), r, stuff)) for k, r in enumerate((0.3, 0.5, 0.9))]
    held = O.bodies.append(scene.disk((-3, 5), 0.5, stuff))
    O.bodies[held].state.blockedDOFs = "xyzXYZ"
    begin(gravity=(0, 0, 0), dt=0.1, before=[ground])
    run(1)
    mean = Vector3(2.1, -0.05, 0)
    assert (ground.acceleration - mean).norm() < 1e-14
    mass = sum(O.bodies[k].state.mass for k in disks)
    assert (ground.totalForce + mass * mean).norm() < 1e-12 * mass
    for k in disks:
        assert (O.bodies[k].state.vel + 0.1 * mean).norm() < 1e-14
    assert O.bodies[held].state.vel == Vector3(0, 0, 0)


# ---- a block that slides --------------------------------------------------------------------------------------------
def block(yields, record, moving, dt=1e-2, until=3.0):
    """Permanent slip down a plane of 30 degrees that is shaken along itself [m], of a block that begins to slide down at
    ``yields`` g. ``record``: times [s] and accelerations of the ground up the slope [g], which push the block down.
    """
    mu = (yields + math.sin(DIP)) / math.cos(DIP)
    stuff = material(mu)
    plane = O.bodies.append(scene.segments([tuple(-60 * ALONG)[:2], tuple(60 * ALONG)[:2]], stuff))
    disk = free_disk(*tuple(0.5 * NORMAL)[:2], stuff=stuff)
    O.bodies[disk].state.blockedDOFs = "zXYZ"  # a block does not roll
    times, a = record
    up = -1 * ALONG
    ground = GroundMotionEngine(
        times=times, horizontal=[G * x * up[0] for x in a], vertical=[G * x * up[1] for x in a], begin=0.1
    )
    if moving == "walls":
        ground.ids = plane
    begin(dt=dt, before=[ground])
    first = (O.bodies[disk].state.pos - O.bodies[plane[0]].state.pos).dot(ALONG)
    run(round(until / dt))
    return (O.bodies[disk].state.pos - O.bodies[plane[0]].state.pos).dot(ALONG) - first


def pulse(amplitude, length):
    """A rectangular pulse; its flanks last a microsecond."""
    flank = 1e-6
    return [0, flank, length, length + flank], [0, amplitude, amplitude, 0]


def sine(amplitude, length, cycle=1.0):
    """From 0 to ``length`` [s] of a sine of which half a period takes ``cycle`` times that, in 2,000 parts."""
    t = np.linspace(0, length, 2001)
    return list(t), list(amplitude * np.sin(np.pi * t / (cycle * length)))


both = pytest.mark.parametrize("moving", ["frame", "walls"])


@both
@pytest.mark.parametrize("pulse_g, yields, length", [(0.5, 0.1, 0.2), (1, 0.5, 0.3), (0.4, 0.2, 1)])
def test_block_under_a_rectangular_pulse(pulse_g, yields, length, moving):
    expected = (pulse_g * G * length) ** 2 / (2 * G * yields) * (1 - yields / pulse_g)  # Newmark (1965)
    # places after steps of velocities of their ends: an error of the order of half a step's way, below 1 %
    assert block(yields, pulse(pulse_g, length), moving, dt=2e-3, until=length / yields + 1) == pytest.approx(
        expected, rel=0.01
    )


@both
def test_block_under_half_a_sine(moving):
    # integrated in closed form: slides from asin(N/A) on, until its velocity is zero again
    assert block(0.1, sine(0.5, 0.2), moving, dt=2e-3) == pytest.approx(0.14032, rel=0.01)


@both
@pytest.mark.parametrize(
    "yields, slip", [(0.1, 1.182179), (0.2, 0.891448), (0.4, 0.466652), (0.6, 0.195903), (0.8, 0.046665)]
)
def test_block_under_a_cycle_of_a_sine(yields, slip, moving):
    t = np.linspace(0, 1, 4001)
    record = list(t), list(np.sin(2 * np.pi * t))
    # friction is so high that nothing slides up: mu cos 30 + sin 30 is above 1 g
    assert block(yields, record, moving, dt=2e-3, until=11.0 if yields < 0.2 else 6.0) == pytest.approx(slip, rel=0.01)


# ---- two frames -----------------------------------------------------------------------------------------------------
def shaken_heap(moving, steps=400):
    stuff = material(0.4)
    walls = box(stuff, 10, 12)
    ids = loose_heap(stuff, columns=6, rows=5)
    t = np.linspace(0, 2, 81)
    ground = GroundMotionEngine(times=list(t), horizontal=list(4 * np.sin(7 * t)), vertical=list(2 * np.sin(11 * t)))
    if moving == "walls":
        ground.ids = walls
    begin(dt=2e-3, before=[ground])
    run(steps)
    return walls, ids, ground


def test_moving_walls_are_the_moving_frame():
    walls, ids, ground = shaken_heap("frame")
    base = O.bodies[walls[0]].state.pos
    still = np.array([tuple(O.bodies[k].state.pos - base)[:2] for k in ids])
    spread = np.array([tuple(O.bodies[k].state.vel)[:2] for k in ids])
    O.reset()
    walls, ids, ground = shaken_heap("walls")
    base, speed = O.bodies[walls[0]].state.pos, O.bodies[walls[0]].state.vel
    assert (speed - ground.velocity).norm() == 0 and speed.norm() > 0.1
    driven = np.array([tuple(O.bodies[k].state.pos - base)[:2] for k in ids])
    velocity = np.array([tuple(O.bodies[k].state.vel - speed)[:2] for k in ids])
    # the same problem in each step but for rounding, which 400 steps of a loose heap let grow
    assert np.abs(driven - still).max() < 1e-6 and np.abs(velocity - spread).max() < 1e-4
    assert np.abs(spread).max() > 0.1  # it moves


def test_bits_do_not_depend_on_who_looks():
    shaken_heap("frame", 100)
    seen = bits()
    O.reset()
    stuff = material(0.4)
    box(stuff, 10, 12)
    loose_heap(stuff, columns=6, rows=5)
    t = np.linspace(0, 2, 81)
    ground = GroundMotionEngine(times=list(t), horizontal=list(4 * np.sin(7 * t)), vertical=list(2 * np.sin(11 * t)))
    begin(dt=2e-3, before=[ground])
    engine().advance(100)
    assert bits() == seen


def test_saved_in_the_midst_it_goes_on_as_it_was(tmp_path):
    shaken_heap("walls", 150)
    O.save(str(tmp_path / "scene.yade.bz2"))
    run(100)
    expected = bits()
    O.load(str(tmp_path / "scene.yade.bz2"))
    run(100)
    assert bits() == expected


# ---- refusals -------------------------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    "values, word",
    [
        (dict(times=[0, 1], horizontal=[0, 1, 2]), "horizontal has 3 entries and times 2"),
        (dict(times=[0, 1], vertical=[1]), "vertical has 1 entries and times 2"),
        (dict(times=[0, 0], horizontal=[0, 1]), "times must rise"),
        (dict(times=[1, 0], horizontal=[0, 1]), "times must rise"),
        (dict(times=[0, math.nan], horizontal=[0, 1]), "times[1] = nan"),
        (dict(times=[0, 1], horizontal=[0, math.inf]), "horizontal[1] = inf"),
        (dict(times=[0, 1], vertical=[math.nan, 0]), "vertical[0] = nan"),
        (dict(times=[0, 1], vertical=[0, 0], scale=math.inf), "scale = inf"),
        (dict(times=[0, 1], vertical=[0, 0], begin=math.nan), "begin = nan"),
        (dict(times=[0, 1], vertical=[0, 0], ids=[7]), "ids has 7: there is no such body"),
        (dict(times=[0, 1], vertical=[0, 0], ids=[0]), "free to move"),
    ],
)
def test_what_has_no_sense_is_refused(values, word):
    free_disk()
    ground = GroundMotionEngine(**values)
    begin(before=[ground])
    with pytest.raises(ValueError) as error:
        ground()
    assert word in str(error.value) and "GroundMotionEngine" in str(error.value)


def test_a_step_that_another_engine_chooses_brings_its_own_mean():
    ground = GroundMotionEngine(times=TIMES, horizontal=EAST)
    disk = free_disk()
    begin(gravity=(0, 0, 0), before=[ground])
    O.engines = [NonsmoothTimeStepper(smallest=1e-3, largest=0.3), *O.engines]
    lengths = set()
    while O.time < 1.3:
        run(1)
        lengths.add(O.dt)
    assert len(lengths) > 10
    assert O.bodies[disk].state.vel[0] == pytest.approx(-integrals(TIMES, EAST, O.time)[0], abs=1e-12)


# ---- from a GroundMotion --------------------------------------------------------------------------------------------
def test_a_motion_becomes_an_engine():
    motion = GroundMotion(TIMES, EAST, UP)
    floor = O.bodies.append(scene.segments([(-5, 0), (5, 0)], material(0.3)))
    begin(dt=0.25)
    run(2)
    ground = shaking.ground_motion(motion, walls=floor)
    assert (ground.begin, list(ground.ids)) == (O.time, floor) and O.time == 0.5
    for time in (0.05, 0.3, 0.9, 1.5):
        for which in ("acceleration", "velocity", "displacement"):
            seen, told = getattr(ground, f"{which}At")(0.5 + time), getattr(motion, which)(time)
            assert tuple(seen)[:2] == pytest.approx(tuple(told), rel=1e-12, abs=1e-14), which
    level = shaking.ground_motion(GroundMotion(TIMES, EAST), begin=7)
    assert level.vertical == [] and level.begin == 7 and level.ids == []


@pytest.mark.parametrize(
    "arguments, word",
    [
        (dict(motion=[0, 1]), "give a GroundMotion"),
        (dict(begin=math.nan), "begin nan"),
        (dict(begin="now"), "begin 'now'"),
        (dict(walls=[3]), "walls has 3"),
        (dict(walls=["DP"]), "walls has 'DP'"),
        (dict(walls=[True]), "walls has True"),
    ],
)
def test_a_scene_that_cannot_be_shaken(arguments, word):
    free_disk()
    with pytest.raises(shaking.ShakingError) as error:
        shaking.ground_motion(**{"motion": GroundMotion(TIMES, EAST)} | arguments)
    assert word in str(error.value) and "\n" not in str(error.value)
