"""The energy that others bring between steps and take away, counted for itself: the balance closes whatever comes and
goes.
"""
import math
import random

import pytest
from yade import O, utils
from yade.minieigenHP import Vector3
from yade.nonsmooth import scene
from yade.wrapper import NewtonIntegrator, PyRunner

from contact_scenes import G, begin, box, engine, free_disk, loose_heap, material, run

pytestmark = pytest.mark.usefixtures("empty")

MASS = 2500 * math.pi * 0.25


def flight(**options):
    """One disk that flies freely with 3 m/s; returns its id. Energy: ½ m v² + m g y with the scheme's own ½ m g h v."""
    disk = free_disk(0, 10, (3, 4, 0))
    begin(**options)
    run(5)
    assert engine().broughtEnergy == 0
    return disk


def energy(disk):
    s = O.bodies[disk].state
    return 0.5 * s.mass * s.vel.squaredNorm() + 0.5 * s.inertia[2] * s.angVel[2] ** 2 + s.mass * G * s.pos[1]


def add(disk):
    other = O.bodies.append(scene.disk((20, 5), 0.3, O.materials[0]))
    O.bodies[other].state.vel = (1, 0, 0)


def put(name, value):
    return lambda disk: setattr(O.bodies[disk].state, name, value)


CHANGES = {
    "appended": add,
    "erased": lambda disk: O.bodies.erase(disk),
    "blocked": put("blockedDOFs", "xyzXYZ"),
    "moved": put("pos", (3, 14, 0)),
    "pushed": put("vel", (-7, 1, 0)),
    "spun": put("angVel", (0, 0, 5)),
    "mass": put("mass", 123.0),
    "grown": lambda disk: utils.growParticles(1.5),
}


@pytest.mark.parametrize("change", CHANGES)
def test_what_changes_bring(change):
    disk = flight()
    free_disk(40, 8, stuff=O.materials[0])  # not the only one
    run(1)
    brought, e = engine().broughtEnergy, engine()
    before = sum(energy(b.id) for b in O.bodies if b.state.blockedDOFs != "xyzXYZ")
    error = e.energyError
    CHANGES[change](disk)
    run(1)  # grown bodies get their mass in it
    moving = [b for b in O.bodies if b.state.blockedDOFs != "xyzXYZ"]
    # the same a step later: gravity's work is the fall, but for ½ m g² h² of the scheme in a step
    slack = 2 * sum(b.state.mass for b in moving) * (G * O.dt) ** 2
    after = sum(energy(b.id) for b in moving)
    assert e.broughtEnergy - brought == pytest.approx(after - before, abs=slack + 1e-9 * abs(after))
    run(20)
    # the scheme's own error alone: ½ m g h (v⁻ − v⁺), of all that moves
    mass = sum(b.state.mass for b in moving)
    assert abs(e.energyError - error) <= 1.01 * 0.5 * mass * G * O.dt * G * 22 * O.dt
    assert e.energies()["brought"] == e.broughtEnergy and e.energies()["error"] == e.energyError


def test_freed_bodies_bring_what_they_have():
    disk = flight()
    O.bodies[disk].state.blockedDOFs = "xyzXYZ"
    run(3)
    assert engine().kineticEnergy == 0
    taken = engine().broughtEnergy
    O.bodies[disk].state.blockedDOFs = "zXY"
    now = energy(disk)
    run(1)
    assert taken < 0 and engine().broughtEnergy - taken == pytest.approx(now, rel=1e-12)


def test_a_run_that_feeds_and_erases_disks_keeps_its_balance():
    stuff = material(0.4, 0.05)
    box(stuff, 9.5, 12)
    loose_heap(stuff, rows=3)
    begin(dt=2e-3, tolerance=1e-6, maxIterations=2000)
    e, dice = engine(), random.Random(3)
    fed = 0
    for _ in range(15):
        for x in range(4):
            disk = O.bodies.append(scene.disk((1 + 2.2 * x, 10 + dice.uniform(0, 0.2)), 0.4, stuff))
            O.bodies[disk].state.vel = (0, -2, 0)
            fed += energy(disk)
        for b in [b for b in O.bodies if b.shape.__class__.__name__ == "Sphere" and b.state.pos[1] < 0.9][:4]:
            O.bodies.erase(b.id)
        e.advance(60)
    lost = e.slidingLoss + e.rollingLoss + e.impactLoss
    assert fed > 4e6 and e.broughtEnergy > 1e6 and lost > 1e5  # J
    mass = sum(b.state.mass for b in O.bodies)
    # what the scheme leaves, ½ m g h Δv of the bodies that move
    assert abs(e.energyError) < 0.5 * mass * G * O.dt * 15


def test_gravity_that_changes_brings_energy_too():
    disk = flight()
    e = engine()
    y, error = O.bodies[disk].state.pos[1], e.energyError
    next(k for k in O.engines if isinstance(k, NewtonIntegrator)).gravity = (0, -2 * G, 0)
    run(1)
    assert e.broughtEnergy == pytest.approx(MASS * G * y, rel=1e-12)
    assert abs(e.energyError - error) < MASS * G * O.dt * G * O.dt


def test_nothing_is_brought_where_nobody_brings_anything():
    stuff = material(0.4, 0.05, tensileStrength=1e4)
    box(stuff, 9.5, 12)
    loose_heap(stuff)
    begin(dt=2e-3, tolerance=1e-4, maxIterations=300)
    O.engines = O.engines + [PyRunner(command="O.bodies[10].state.pos; O.forces.addF", iterPeriod=7)]
    for _ in range(20):
        engine().advance(20)
        O.step()
    assert engine().broughtEnergy == 0 and engine().contacts > 20


def test_the_balance_begins_anew_without_it():
    disk = flight()
    put("vel", (50, 0, 0))(disk)
    engine().forgetEnergies()
    run(2)
    assert engine().broughtEnergy == 0 and abs(engine().energyError) < MASS * G * G * O.dt * O.dt * 2


@pytest.mark.parametrize("change", ["before", "after", "none"])
def test_it_goes_on_after_a_load(change, tmp_path):
    disk = flight()
    if change == "before":
        add(disk)
    O.save(str(tmp_path / "scene.yade.gz"))
    if change == "after":
        add(disk)
    run(3)
    unbroken = (engine().broughtEnergy, engine().energyError)
    O.load(str(tmp_path / "scene.yade.gz"))
    if change == "after":
        add(disk)
    run(3)
    assert (engine().broughtEnergy, engine().energyError) == unbroken
    assert (unbroken[0] != 0) == (change != "none")


def test_a_driven_direction_of_a_body_that_is_free_along_another_is_the_walls_work():
    """A plate lifted at a given speed, free to move sideways: what lifts its weight works, and nobody else has brought
    anything.
    """
    (plate,) = O.bodies.append(scene.segments([(-1, 0), (1, 0)], material(0.3)))
    s = O.bodies[plate].state
    s.mass, s.blockedDOFs, s.vel = 100.0, "yzXYZ", (0, 2, 0)
    begin()
    run(101)
    e = engine()
    assert e.wallWork == pytest.approx(100 * G * 2 * 101e-3, rel=1e-9)
    assert e.broughtEnergy == 0 and abs(e.energyError) < 1e-9 * e.wallWork
