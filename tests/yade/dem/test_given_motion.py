"""Walls that a script or an engine moves by their positions: what touches them gets the velocity of that motion, and a
wall that is placed gives none.
"""
import math

import pytest
from yade import O
from yade.minieigenHP import Quaternion, Vector3
from yade.nonsmooth import scene
from yade.wrapper import PyRunner

from contact_scenes import G, begin, engine, floor, free_disk, material, run

pytestmark = pytest.mark.usefixtures("empty")


def piston(gravity=(0, 0, 0), dt=1e-3, radius=0.5, **more):
    """An upright wall (body 0) and a disk that touches it and may not turn; returns the disk's id."""
    stuff = material(0.5, **more)
    O.bodies.append(scene.segments([(0, 4 * radius), (0, -4 * radius)], stuff, sense=1))
    disk = O.bodies.append(scene.disk((radius, 0), radius, stuff))
    O.bodies[disk].state.blockedDOFs = "zXYZ"
    begin(gravity=gravity, dt=dt)
    return disk


def pushes(way, period=1, body=0):
    O.engines = O.engines + [
        PyRunner(
            command=f"O.bodies[{body}].state.pos += Vector3({way[0]!r}, {way[1]!r}, 0)",
            iterPeriod=period,
            initRun=False,
        )
    ]


@pytest.mark.parametrize("period", [1, 2, 10])
@pytest.mark.parametrize("dt, speed, radius", [(1e-3, 1.0, 0.5), (5e-3, 0.2, 0.5), (1e-5, 0.02, 1e-4)])
def test_a_piston_gives_its_speed(period, dt, speed, radius):
    disk = piston(dt=dt, radius=radius)
    pushes((speed * dt * period, 0), period)
    engine().advance(40 * period)
    assert O.bodies[disk].state.vel[0] == pytest.approx(speed, rel=1e-9)
    # by the two first moves it has come late, and the overlap of these is taken back; it flies ahead within one move
    gap = O.bodies[disk].state.pos[0] - radius - O.bodies[0].state.pos[0]
    assert abs(gap) < 1.5 * speed * dt * period + 2e-4 * radius


def test_a_script_that_steps_by_itself_moves_it_too():
    disk = piston()
    for _ in range(50):
        O.bodies[0].state.pos += Vector3(1e-3, 0, 0)
        O.step()
    assert O.bodies[disk].state.vel[0] == pytest.approx(1, rel=1e-9)


@pytest.mark.parametrize("height", [0.0, -3.0, 250.0])
def test_a_lift_gives_its_speed_wherever_it_is(height):
    stuff = material(0.5)
    O.bodies.append(scene.segments([(-2, height), (2, height)], stuff, sense=1))
    disk = free_disk(0, height + 0.5, stuff=stuff)
    begin()
    pushes((0, 1e-3))
    engine().advance(100)
    assert O.bodies[disk].state.vel[1] == pytest.approx(1, rel=1e-9)


def test_a_piston_goes_on_where_other_walls_come_and_go():
    """A disk that is pressed on it has its speed in every step."""
    disk = piston(gravity=(-1.0, 0, 0))
    wall, seen = O.bodies[0], []
    for k in range(60):
        O.bodies[0].state.pos += Vector3(1e-3, 0, 0)
        if k == 20:
            (other,) = O.bodies.append(scene.segments([(50, -1), (50, 1)], wall.material))
        if k == 40:
            O.bodies.erase(other)
        O.step()
        seen.append(O.bodies[disk].state.vel[0])
    assert seen[5:] == pytest.approx([1] * 55, rel=1e-9)


def test_a_floor_that_is_moved_drags_a_block():
    stuff = material(0.5)
    ground = floor(stuff)
    block = free_disk(0, 0.5, stuff=stuff)
    O.bodies[block].state.blockedDOFs = "zXYZ"
    begin()
    pushes((2e-3, 0), body=ground)
    engine().advance(100)
    # µ g t but for the two first steps and that of the first move
    assert O.bodies[block].state.vel[0] == pytest.approx(0.5 * G * 0.098, rel=0.025)
    engine().advance(900)
    assert O.bodies[block].state.vel[0] == pytest.approx(2, rel=1e-9)
    lost = engine().slidingLoss
    assert lost == pytest.approx(0.5 * O.bodies[block].state.mass * 4, rel=0.02)  # as much as the block has got
    assert abs(engine().energyError) < 1e-9 * lost


def test_work_on_a_piston_is_that_of_its_speed():
    disk = piston(restitution=0)
    O.forces.setPermF(disk, (-1000.0, 0, 0))
    run(20)
    pushes((1e-3, 0))
    engine().advance(3)
    before = engine().wallWork
    engine().advance(100)
    assert engine().wallWork - before == pytest.approx(1000 * 0.1, rel=1e-6)


def test_a_disk_is_turned_by_a_wheel_that_is_turned_by_its_orientation():
    """Two disks that touch, one with all DOFs blocked and turned by 2 rad/s: the other rolls on it, with rims at one
    speed in the end.
    """
    stuff = material(0.5)
    wheel = O.bodies.append(scene.disk((0, 0), 0.5, stuff, fixed=True))
    disk = free_disk(1, 0, stuff=stuff)
    O.bodies[disk].state.blockedDOFs = "xyzXY"
    O.forces.setPermF(disk, (0, 0, 0))
    begin(gravity=(0, 0, 0))
    O.bodies[disk].state.blockedDOFs = "yzXY"
    O.forces.setPermF(disk, (-1e4, 0, 0))
    O.engines = O.engines + [
        PyRunner(
            command=f"O.bodies[{wheel}].state.ori = Quaternion((0, 0, 1), 2e-3) * O.bodies[{wheel}].state.ori",
            iterPeriod=1,
        )
    ]
    run(1000)
    assert O.bodies[disk].state.angVel[2] == pytest.approx(-2, rel=1e-9)


def test_a_spin_that_is_set_behind_the_solve_is_no_move():
    """The integrator turns a wheel farther than the solve has known: a disk that is pressed on it rolls with its spin,
    and no more.
    """
    stuff = material(0.5)
    wheel = O.bodies[O.bodies.append(scene.disk((0, 0), 0.5, stuff, fixed=True))].state
    disk = O.bodies[free_disk(1, 0, stuff=stuff)].state
    begin(gravity=(0, 0, 0))
    disk.blockedDOFs = "yzXY"
    O.forces.setPermF(1, (-1e4, 0, 0))
    run(1)
    solver = next(k for k, e in enumerate(O.engines) if e.label == engine().label)
    for spin in (2e-3, 4e-3, 6e-3):
        O.subStepping = True
        for _ in range(solver + 2):  # the step begins by a call of its own
            O.step()
        wheel.angVel = (0, 0, spin)
        while O.subStep >= 0:
            O.step()
        O.subStepping = False
        engine().advance(1)
        assert disk.angVel[2] == pytest.approx(-spin, rel=1e-9)


# ---- what is no motion ----------------------------------------------------------------------------


@pytest.mark.parametrize("way", [0.3, 1e-3, -1e-3, 30.0])
def test_a_wall_that_is_placed_once_gives_no_speed(way, capfd):
    disk = piston()
    run(20)
    O.bodies[0].state.pos = (way, 0, 0)
    O.bodies[disk].state.pos = (way + 0.5, 0, 0)  # placing a disk is no motion of its either
    run(20)
    assert O.bodies[disk].state.vel.norm() < 1e-12 and O.bodies[disk].state.pos[0] == pytest.approx(
        way + 0.5, abs=1e-12
    )
    assert "taken for a new place" not in capfd.readouterr().err


def test_a_wall_that_was_moved_and_stands_is_at_rest():
    disk = piston(gravity=(-1.0, 0, 0))
    for _ in range(20):
        O.bodies[0].state.pos += Vector3(1e-3, 0, 0)
        O.step()
    assert O.bodies[disk].state.vel[0] == pytest.approx(1, rel=1e-9)
    run(3000)  # it comes back to the wall, and stays
    assert abs(O.bodies[disk].state.vel[0]) < 1e-9
    assert O.bodies[disk].state.pos[0] - 0.5 == pytest.approx(O.bodies[0].state.pos[0], abs=2e-4)


@pytest.mark.parametrize("radius", [0.5, 0.05])
@pytest.mark.parametrize(
    "pause, jump, told",
    [(1, 1.01, True), (1, 0.99, False), (5, 0.11, True), (5, 0.09, False), (101, 0.01, True), (100, 0.01, False)],
)
def test_jumps_and_moves_after_long_are_places_and_are_told_of(pause, jump, told, radius, capfd):
    """Jumps in diameters of the smallest disk."""
    piston(radius=0.5)
    O.bodies.append(scene.disk((50, 50), radius, O.materials[0]))
    run(2)
    for _ in range(2):
        O.bodies[0].state.pos -= Vector3(jump * 2 * radius, 0, 0)  # away from the disk
        run(pause)
    run(1)
    words = capfd.readouterr().err
    assert ("taken for a new place" in words) == told
    if told:
        assert "body #0" in words and "state.vel" in words


def test_a_belt_that_is_put_back_keeps_its_own_velocity():
    stuff = material(0.5)
    ground = floor(stuff)
    block = free_disk(0, 0.5, stuff=stuff)
    O.bodies[block].state.blockedDOFs = "zXYZ"
    O.bodies[ground].state.vel = (1, 0, 0)
    begin()
    O.engines = O.engines + [PyRunner(command=f"O.bodies[{ground}].state.pos = Vector3(0, 0, 0)", iterPeriod=1)]
    run(1000)
    assert O.bodies[block].state.vel[0] == pytest.approx(1, rel=1e-9)
    assert O.bodies[ground].state.pos[0] == 0


def test_a_free_disk_that_is_moved_keeps_its_velocity():
    disk = free_disk(velocity=(3, 0, 0))
    begin(gravity=(0, 0, 0))
    for _ in range(10):
        O.bodies[disk].state.pos += Vector3(0, 1e-3, 0)
        O.step()
    assert tuple(O.bodies[disk].state.vel) == (3, 0, 0)


def test_another_body_of_the_same_id_has_not_moved():
    disk = piston()
    wall = O.bodies[0]
    for k in range(1, 4):
        O.bodies[0].state.pos += Vector3(1e-3, 0, 0)
        O.step()
    speed = O.bodies[disk].state.vel[0]
    O.bodies.erase(0)
    (other,) = scene.segments([(0.05, 2), (0.05, -2)], wall.material, sense=1)
    O.bodies.insertAtId(other, 0)
    O.bodies[disk].state.vel = (0, 0, 0)
    O.bodies[disk].state.pos = (0.55, 0, 0)
    run(3)
    assert speed == pytest.approx(1, rel=1e-9) and abs(O.bodies[disk].state.vel[0]) < 1e-12


@pytest.mark.parametrize("at", [10, 15])
def test_the_motion_goes_on_after_a_load_with_the_same_bits(at, tmp_path):
    disk = piston(gravity=(-1.0, 0, 0))
    pushes((1e-2, 0), 10)
    run(at + 40)
    O.save(str(tmp_path / "scene.yade.gz"))
    run(40)
    unbroken = [tuple(O.bodies[k].state.pos) + tuple(O.bodies[k].state.vel) for k in (0, disk)]
    O.load(str(tmp_path / "scene.yade.gz"))
    run(40)
    assert [tuple(O.bodies[k].state.pos) + tuple(O.bodies[k].state.vel) for k in (0, disk)] == unbroken


def test_a_plate_that_is_free_along_one_direction_is_moved_along_the_other():
    stuff = material(0.5)
    ground = floor(stuff)
    (plate,) = O.bodies.append(scene.segments([(2, 1), (-2, 1)], stuff, sense=1))
    O.bodies[plate].state.mass, O.bodies[plate].state.blockedDOFs = 100.0, "xzXYZ"
    block = free_disk(0, 0.5, stuff=stuff)
    O.bodies[block].state.blockedDOFs = "zXYZ"
    begin()
    pushes((1e-3, 0), body=plate)
    assert ground == 0
    run(3)
    run(50)
    # dragged by the plate's weight and held by the floor, which bears more: it stays
    assert abs(O.bodies[block].state.vel[0]) < 1e-9
    assert O.forces.f(block) is not None
    assert O.interactions[plate, block].phys.shearForce.norm() == pytest.approx(0.5 * 100 * G, rel=1e-6)
