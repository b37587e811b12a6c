"""Bonded bodies that spin and tumble: rigid motion exactly, the centrifugal force in the bonds, what bonds have slipped
without having yielded taken back.
"""
import math

import numpy as np
import pytest
from yade import O
from yade.minieigenHP import Quaternion
from yade.nonsmooth import scene
from yade.wrapper import NonsmoothTimeStepper

from contact_scenes import begin, contacts, engine, material, run

STRONG = 1e9
SLACK = 1e-4  # ContactDynamicsEngine.correctionSlack [ℓ]

pytestmark = pytest.mark.usefixtures("empty")


def rock(strength=STRONG, **more):
    return material(1.0, 0.5, tensileStrength=strength, **more)


def lattice(rings):
    """Places of a hexagonal boulder of disks of 1 m around the origin: 7, 19, 37 ... for 1, 2, 3 ... rings; for none a
    pair.
    """
    if rings == 0:
        return [(-0.5, 0.0), (0.5, 0.0)]
    side = range(-rings, rings + 1)
    return [(i + 0.5 * j, j * math.sqrt(0.75)) for i in side for j in side if abs(i + j) <= rings]


def tumbling(places, omega, dt, stuff=None, drift=(0, 0), at=(0, 0), gravity=(0, 0, 0), **options):
    """Bonded disks at `places` that turn with `omega` about the origin, which is at `at`; returns their ids."""
    stuff = stuff or rock()
    ids = [O.bodies.append(scene.disk((at[0] + x, at[1] + y), 0.5, stuff)) for x, y in places]
    begin(gravity=gravity, dt=dt, **{**dict(tolerance=1e-8), **options})
    engine().advance(1)
    engine().bond()
    for i, (x, y) in zip(ids, places):
        O.bodies[i].state.vel = (drift[0] - omega * y, drift[1] + omega * x, 0)
        O.bodies[i].state.angVel = (0, 0, omega)
        O.bodies[i].state.pos = (at[0] + x, at[1] + y, 0)
        O.bodies[i].state.ori = Quaternion((0, 0, 1), 0)
    engine().forgetEnergies()
    return ids


def sums(ids):
    """Momentum, angular momentum about the origin, and kinetic energy."""
    states = [O.bodies[i].state for i in ids]
    momentum = sum(s.mass * np.array([s.vel[0], s.vel[1]]) for s in states)
    angular = sum(s.mass * (s.pos[0] * s.vel[1] - s.pos[1] * s.vel[0]) + s.inertia[2] * s.angVel[2] for s in states)
    energy = sum(0.5 * s.mass * s.vel.squaredNorm() + 0.5 * s.inertia[2] * s.angVel[2] ** 2 for s in states)
    return momentum, angular, energy


def angle(state):
    return 2 * math.atan2(state.ori[2], state.ori[3])


def apart(spin, orbit):
    """The difference of two angles."""
    return abs((spin - orbit + math.pi) % (2 * math.pi) - math.pi)


def no_yield(energy):
    """No bond has broken, opened, slid or rolled since the balance began; ``energy``: of the whole [J]."""
    e = engine()
    assert e.brokenTension + e.brokenShear + e.brokenTorque + e.brokenMixed == 0 and e.debondingLoss == 0
    # what a bond still slips and rolls is what solves to their tolerance leave, step by step
    assert abs(e.slidingLoss) + abs(e.rollingLoss) + abs(e.impactLoss) < 1e-6 * energy


@pytest.mark.parametrize(
    "rings, omega, dt, turns",
    [(0, 10, 1e-2, 200), (0, 10, 5e-3, 50), (0, 0.1, 1e-2, 1), (0, 100, 1e-3, 100), (0, -20, 5e-3, 50)]
    + [(3, 10, 1e-2, 100), (3, 2, 5e-3, 5), (1, 100, 1e-3, 20)],
)
def test_bonded_bodies_tumble_freely_for_ever(rings, omega, dt, turns):
    places = lattice(rings)
    ids = tumbling(places, omega, dt, drift=(0.3, -0.2))
    bonds = engine().bonds or len(contacts())
    momentum, angular, energy = sums(ids)
    size = abs(angular)
    worst = 0
    steps = int(turns * 2 * math.pi / abs(omega) / dt)
    for _ in range(10):
        engine().advance(steps // 10)
        first, last = O.bodies[ids[0]].state, O.bodies[ids[-1]].state
        d = last.pos - first.pos
        orbit = math.atan2(d[1], d[0]) - math.atan2(places[-1][1] - places[0][1], places[-1][0] - places[0][0])
        worst = max(worst, *(apart(angle(O.bodies[i].state), orbit) for i in ids))
        length = math.hypot(places[-1][0] - places[0][0], places[-1][1] - places[0][1])
        assert d.norm() == pytest.approx(length, abs=2 * SLACK * length)
    after, turned, kept = sums(ids)
    assert engine().bonds == bonds == len([i for i in contacts() if i.phys.bonded])
    no_yield(energy)
    assert worst < 2 * SLACK  # the slack [ℓ] over half a diameter
    # equal and opposite in each step; rounding of so many
    assert abs(turned - angular) < 1e-9 * size
    assert np.abs(after - momentum).max() < 1e-9 * np.abs(momentum).max()
    assert kept == pytest.approx(energy, rel=1e-4)
    e = engine()
    assert abs(e.correctionEnergy) < 1e-4 * energy and abs(e.energyError) < 1e-9 * energy


def test_a_bond_bears_the_centrifugal_force():
    omega, dt = 10, 5e-3
    ids = tumbling(lattice(0), omega, dt)
    run(1)
    mass = O.bodies[ids[0]].state.mass
    for _ in range(50):
        run(1)
        bond = contacts()[0].phys
        assert bond.normal == pytest.approx(-mass * 0.5 * omega**2, rel=1e-6)  # m r ω²
        assert abs(bond.tangential) < 1e-6 * abs(bond.normal)
        assert O.forces.f(ids[0]).norm() == pytest.approx(mass * 0.5 * omega**2, rel=(omega * dt) ** 2)


@pytest.mark.parametrize("share, breaks", [(0.99, True), (1.01, False)])
def test_a_bond_breaks_when_the_centrifugal_force_is_more_than_it_bears(share, breaks):
    omega, mass = 10, 2500 * math.pi * 0.25
    stuff = rock(share * mass * 0.5 * omega**2, bondEllipseNormal=1e-3)
    ids = tumbling(lattice(0), omega, 2e-3, stuff)
    _, angular, energy = sums(ids)
    engine().advance(500)
    e = engine()
    assert e.brokenTension + e.brokenShear + e.brokenTorque + e.brokenMixed == int(breaks) == 1 - e.bonds
    _, after, kept = sums(ids)
    assert after == pytest.approx(angular, rel=1e-9)
    assert abs(engine().energyError) < 1e-9 * energy
    if breaks:
        # it yields along its ellipse of a thousandth and lets go: both fly on, with what their orbit had less the way's
        # work
        assert kept == pytest.approx(energy, rel=2e-3) and kept < energy
        assert engine().debondingLoss == pytest.approx(share * mass * 0.5 * omega**2 * 1e-3, rel=0.5)
        speeds = [O.bodies[i].state.vel for i in ids]
        assert (speeds[0] + speeds[1]).norm() < 1e-9
    else:
        assert kept == pytest.approx(energy, rel=1e-4) and engine().debondingLoss == 0


@pytest.mark.parametrize("rolling", [0.0, 0.5])
def test_a_boulder_without_rolling_friction_is_rigid_too(rolling):
    stuff = material(1.0, rolling, tensileStrength=STRONG)
    ids = tumbling(lattice(1), 10, 5e-3, stuff)
    _, angular, energy = sums(ids)
    engine().advance(2000)
    _, after, kept = sums(ids)
    assert engine().bonds == 12
    assert after == pytest.approx(angular, rel=1e-9) and kept == pytest.approx(energy, rel=1e-4)


def test_steps_of_the_time_stepper_keep_a_spinning_pair():
    ids = tumbling(lattice(0), 10, 1e-3)
    O.engines = [NonsmoothTimeStepper(largest=1e-2)] + O.engines
    _, angular, energy = sums(ids)
    engine().advance(until=4 * math.pi)  # twenty turns
    _, after, kept = sums(ids)
    assert engine().bonds == 1 and O.dt == pytest.approx(5e-3, rel=0.1)  # 0.05 of the diameter at ω r
    assert after == pytest.approx(angular, rel=1e-9) and kept == pytest.approx(energy, rel=1e-4)
    no_yield(energy)


def test_what_hangs_on_a_rotor_goes_round_with_it():
    stuff = rock()
    hub = O.bodies.append(scene.disk((0, 0), 0.5, stuff, fixed=True))
    arm = [O.bodies.append(scene.disk((k, 0), 0.5, stuff)) for k in (1, 2, 3)]
    begin(gravity=(0, 0, 0), dt=5e-3, tolerance=1e-10)
    run(1)
    assert engine().bond() == 3
    omega = 8
    O.bodies[hub].state.angVel = (0, 0, omega)
    for i in arm:
        O.bodies[i].state.vel, O.bodies[i].state.angVel = (0, omega * O.bodies[i].state.pos[0], 0), (0, 0, omega)
    engine().advance(int(20 * 2 * math.pi / omega / 5e-3))
    assert engine().bonds == 3
    no_yield(sums(arm)[2])
    mass = O.bodies[arm[0]].state.mass
    for k, i in enumerate(arm):
        p = O.bodies[i].state.pos
        assert p.norm() == pytest.approx(k + 1, abs=(k + 1) * SLACK)
        assert apart(math.atan2(p[1], p[0]), angle(O.bodies[hub].state)) < SLACK
    # the inner bond bears all three
    inner = next(i.phys for i in contacts() if i.id1 == hub or i.id2 == hub)
    assert inner.normal == pytest.approx(-mass * (1 + 2 + 3) * omega**2, rel=1e-3)


def slope_run(rings, seconds, dt, strength=STRONG, **options):
    """A bonded boulder let go above a slope of 40° that ends in a valley."""
    ground = material(0.5, 0.05, wall=True)
    O.bodies.append(scene.segments([(-60, 50.35), (0, 0), (40, 0), (60, 20)], ground, piece=5, sense=1))
    ids = tumbling(
        lattice(rings), -3, dt, rock(strength), drift=(1, 0), at=(-45, 44 + rings), gravity=(0, -9.81, 0), **options
    )
    O.engines[-1].gravity = (0, -9.81, 0)
    engine().advance(until=seconds)
    return ids


@pytest.mark.parametrize("rings, dt, options", [(1, 5e-3, {}), (3, 5e-3, dict(tolerance=1e-4)), (3, 1e-3, {})])
def test_a_boulder_tumbles_down_a_slope_in_one_piece(rings, dt, options):
    ids = slope_run(rings, 8, dt, **options)
    e = engine()
    assert e.bonds == len(contacts()) - len([i for i in contacts() if not i.phys.bonded])
    assert e.brokenTension + e.brokenShear + e.brokenTorque + e.brokenMixed == 0
    assert O.bodies[ids[0]].state.pos[0] > -20  # it has come down
    shape = [O.bodies[i].state for i in ids]
    for a, b in ((0, 1), (0, len(ids) - 1), (1, len(ids) // 2)):
        first, last = lattice(rings)[a], lattice(rings)[b]
        length = math.hypot(last[0] - first[0], last[1] - first[1])
        assert (shape[b].pos - shape[a].pos).norm() == pytest.approx(length, abs=3 * SLACK * length)
    assert max(apart(angle(s), angle(shape[0])) for s in shape) < 10 * SLACK


@pytest.mark.parametrize("slip, turn", [(0.005, 0.0), (-0.004, 0.0), (0.0, 0.006), (0.003, -0.004)])
def test_what_a_bond_has_slipped_without_yielding_is_taken_back(slip, turn):
    """A script turns one disk of a bonded pair that goes round by what makes it slip, or rolls it: the share κ goes in
    each step, the slack stays.
    """
    omega = 0.1  # 5e-4 rad a step
    ids = tumbling(lattice(0), omega, 5e-3)
    run(1)
    # α₁ r + α₂ r = slip and α₁ − α₂ = turn; seen from the contact each disk goes back by its angle
    for i, about in zip(ids, (0.5 * (2 * slip + turn), 0.5 * (2 * slip - turn))):
        O.bodies[i].state.ori *= Quaternion((0, 0, 1), -about)
    steps, kappa = 10, 0.2
    run(steps)
    spins = [-angle(O.bodies[i].state) for i in ids]
    d = O.bodies[ids[1]].state.pos - O.bodies[ids[0]].state.pos
    orbit = math.atan2(d[1], d[0])

    def left(error, slack):
        return math.copysign(max(0, abs(error) - slack) * (1 - kappa) ** steps + min(abs(error), slack), error)

    found = 0.5 * (spins[0] + spins[1] + 2 * orbit), spins[0] - spins[1]
    # 10 sweeps find nearly all of it; arcs are straight to 1e-5 of it
    assert found[0] == pytest.approx(left(slip, SLACK), abs=2e-5)
    assert found[1] == pytest.approx(left(turn, 2 * SLACK), abs=2e-5)
    # no velocity is left
    for i in ids:
        assert O.bodies[i].state.vel.norm() == pytest.approx(0.5 * omega, rel=1e-4)
        assert O.bodies[i].state.angVel[2] == pytest.approx(omega, rel=1e-4)
    assert engine().bonds == 1


@pytest.mark.parametrize("h", [5e-4, 2e-3])
def test_the_balance_of_a_pendulum_on_a_pin_stays_closed(h):
    """A disk that is bonded to a pin swings through 2 rad to either side: neither what is listed as error nor as
    correction grows.
    """
    stuff = rock()
    pin = O.bodies.append(scene.disk((0, 0), 1.0, stuff))
    bob = O.bodies.append(scene.disk((2 * math.sin(2.0), -2 * math.cos(2.0)), 1.0, stuff))
    O.bodies[pin].state.blockedDOFs = "xyzXY"
    e = begin(dt=h, tolerance=1e-8)
    e.advance(1)
    e.bond()
    e.forgetEnergies()
    e.advance(1)
    s = O.bodies[bob].state
    swing = s.mass * 9.81 * 2 * (1 - math.cos(2.0))
    e.advance(round(20 / h))
    assert e.bonds == 1
    # ½ h m g times the speed, stepping.rst: at most 8 m/s
    bound = 0.5 * h * s.mass * 9.81 * 8
    assert abs(e.energyError) < 1.5 * bound and abs(e.correctionEnergy) < 1.5 * bound < 0.05 * swing


def test_what_a_bond_has_yielded_in_shear_it_keeps():
    strength, mu = 1e5, 1.0
    stuff = rock(strength, bondEllipseTangential=0.1)
    ids = tumbling(lattice(0), 0, 1e-3, stuff)
    O.bodies[ids[0]].state.blockedDOFs = "xyzXYZ"
    O.bodies[ids[1]].state.blockedDOFs = "zXYZ"
    O.forces.setPermF(ids[1], (0, 1.01 * mu * strength, 0))
    while O.bodies[ids[1]].state.pos[1] < 0.02:
        O.step()
    O.forces.setPermF(ids[1], (0, 0, 0))
    run(50)  # it comes to rest
    rest = O.bodies[ids[1]].state.pos[1]
    assert engine().bonds == 1 and rest > 0.02
    run(1000)
    assert O.bodies[ids[1]].state.pos[1] == pytest.approx(rest, abs=1e-6)


def test_what_a_bond_has_yielded_in_shear_while_it_turns_it_keeps():
    """A disk that hangs on a rotor is pushed along its path until it has slipped; then it goes round with the rotor
    where it is.
    """
    strength, omega, h = 1e5, 2.0, 5e-3
    rotor, disk = tumbling(lattice(0), 0, h, rock(strength, bondEllipseTangential=0.5))
    hub, s = O.bodies[rotor].state, O.bodies[disk].state
    hub.blockedDOFs = "xyzXYZ"
    hub.vel, hub.angVel = (0, 0, 0), (0, 0, omega)
    s.vel, s.angVel = (0, omega, 0), (0, 0, omega)

    def ahead():
        """By what angle the disk is ahead of the rotor, about its middle."""
        d = s.pos - hub.pos
        return (math.atan2(d[1], d[0]) - angle(hub) + math.pi) % (2 * math.pi) - math.pi

    while ahead() < 0.02:
        d = s.pos - hub.pos
        O.forces.setPermF(disk, tuple(1.02 * strength * x for x in (-d[1], d[0], 0)))  # friction of bonds: 1
        run(1)
        assert O.time < 60
    O.forces.setPermF(disk, (0, 0, 0))
    run(20)  # its bond stops it
    kept = ahead()
    assert kept > 0.02 and engine().bonds == 1
    run(1000)
    assert ahead() == pytest.approx(kept, abs=2 * SLACK) and engine().bonds == 1


def test_saved_and_loaded_in_full_spin_it_has_the_same_bits(tmp_path):
    def bits():
        return [(tuple(b.state.pos), tuple(b.state.vel), tuple(b.state.angVel), tuple(b.state.ori)) for b in O.bodies]

    stuff = rock(5e4)
    ids = tumbling(lattice(2), 6, 5e-3, stuff)
    for i in ids[:5]:
        O.bodies[i].state.vel += (0, 3, 0)  # some bonds yield
    engine().advance(20)
    O.save(str(tmp_path / "spin.yade.gz"))
    engine().advance(30)
    wanted = bits()
    O.load(str(tmp_path / "spin.yade.gz"))
    engine().advance(30)
    assert bits() == wanted


def test_a_cluster_that_is_stopped_by_a_script_bears_nothing():
    ids = tumbling(lattice(0), 10, 5e-3)
    run(20)
    for i in ids:
        O.bodies[i].state.vel, O.bodies[i].state.angVel = (0, 0, 0), (0, 0, 0)
    run(2)
    assert abs(contacts()[0].phys.normal) < 1e-3
    assert all(O.bodies[i].state.vel.norm() < 1e-9 for i in ids)
