"""Impacts that follow from impacts in the same step: chains against impacts in the order of time, gases and their
balances, rest, limits.
"""
import math
import random

import numpy as np
import pytest
from yade import O
from yade.minieigenHP import Vector3
from yade.nonsmooth import scene, tables
from yade.wrapper import NscdMat

from contact_scenes import begin, contacts, engine, floor, free_disk, material, run, threads_allowed
from symmetries import Disk, Frame, Line, World, assert_same, play, shuffled

pytestmark = pytest.mark.usefixtures("empty")


def chain(count, gap, e, speed=10.0, diameter=1.0, density=1000.0, masses=None, way=None):
    """A disk that comes with a speed, and others at rest behind it, with gaps in diameters; ids. ``way``: its distance
    from the first of them, in diameters; ``masses``: factors of their densities."""
    ids, x = [], 0.0
    for k in range(count):
        stuff = NscdMat(density=density * (masses[k] if masses else 1), restitution=e, frictionAngle=0)
        O.materials.append(stuff)
        ids.append(O.bodies.append(scene.disk((x, 0), diameter / 2, stuff)))
        x += diameter * (1 + ((gap if way is None else way) if k == 0 else gap))
    O.bodies[ids[0]].state.vel = (speed, 0, 0)
    return ids


def speeds(ids):
    return np.array([O.bodies[k].state.vel[0] for k in ids])


def places(ids):
    return np.array([O.bodies[k].state.pos[0] for k in ids])


def masses_of(ids):
    return np.array([O.bodies[k].state.mass for k in ids])


class OrderOfTime:
    """Disks in a row, one impact after the other, each at its time: places and velocities [m, m/s] after some time,
    with e.
    """

    def __init__(self, x, v, m, e, diameter):
        self.x, self.v, self.m, self.e, self.d, self.impacts = np.array(x), np.array(v, float), m, e, diameter, 0
        self.least = 1e-9 * np.abs(v).max()

    def go(self, time):
        while True:
            closing = self.v[:-1] - self.v[1:]
            gaps = np.maximum(np.diff(self.x) - self.d, 0)
            when = np.where(closing > self.least, gaps / np.where(closing > self.least, closing, 1), math.inf)
            k = int(np.argmin(when))
            here = min(when[k], time)
            self.x += here * self.v
            time -= here
            if time == 0:
                return self
            p = (1 + self.e) * closing[k] / (1 / self.m[k] + 1 / self.m[k + 1])
            self.v[k] -= p / self.m[k]
            self.v[k + 1] += p / self.m[k + 1]
            self.impacts += 1


# ---- chains ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("count", [3, 5, 11, 20])
@pytest.mark.parametrize("gap", [1e-5, 3e-4, 0.003, 0.007, 0.0099, 0.01, 0.0137, 0.02])
def test_equal_elastic_disks_hand_their_speed_on_whatever_the_gaps(count, gap):
    ids = chain(count, gap, 1.0)
    begin(gravity=(0, 0, 0), tolerance=1e-4)  # the default: nothing is left to the solve
    energy = 50 * masses_of(ids)[0]
    run(60)
    assert speeds(ids) == pytest.approx([0] * (count - 1) + [10], abs=1e-10)  # rounding of 20 impacts at 10 m/s
    assert abs(engine().impactLoss) < 1e-11 * energy and abs(engine().energyError) < 1e-11 * energy
    assert engine().missedRestitution == 0
    # and in time: the last one flies since the first would have come to its place, less the diameters between
    assert places(ids)[-1] == pytest.approx(10 * O.time + count - 1, abs=1e-9)


@pytest.mark.parametrize("diameter, speed, dt", [(0.02, 3.0, 1e-4), (50.0, 40.0, 1e-2), (1e-3, 0.5, 2e-5)])
def test_chains_of_any_size_speed_and_step(diameter, speed, dt):
    ids = chain(9, 0.4 * speed * dt / diameter, 1.0, speed, diameter)
    begin(gravity=(0, 0, 0), dt=dt, tolerance=1e-4)
    run(20)
    assert speeds(ids) == pytest.approx([0] * 8 + [speed], abs=1e-11 * speed)


@pytest.mark.parametrize("e", [0.5, 0.9])
@pytest.mark.parametrize("count", [3, 5, 8])
@pytest.mark.parametrize("gap", [1e-4, 0.002, 0.007, 0.0137, 0.02])
def test_chains_go_as_impacts_in_the_order_of_time(count, gap, e):
    dice = random.Random(count)
    ids = chain(count, gap, e, masses=[math.exp(dice.uniform(0, 1)) for _ in range(count)], way=0.0123)
    m, x, v = masses_of(ids), places(ids), speeds(ids)
    known = OrderOfTime(x, v, m, e, 1.0)
    begin(gravity=(0, 0, 0), tolerance=1e-4)
    for _ in range(6):
        run(50)
        known.go(0.05)
        # m/s, m: that pairs come to rest at 1e-4 m/s, and rounding; so near, no two impacts have changed places
        assert speeds(ids) == pytest.approx(known.v, abs=1e-3)
        assert places(ids) == pytest.approx(known.x, abs=1e-5)
    assert known.impacts >= count - 1
    lost = 0.5 * (m @ v**2 - m @ speeds(ids) ** 2)
    assert engine().impactLoss == pytest.approx(lost, rel=1e-9) and m @ speeds(ids) == pytest.approx(m @ v, rel=1e-12)
    assert abs(engine().energyError) < 1e-10 * lost


@pytest.mark.parametrize("count", [3, 4, 10, 20])
def test_a_cradle_without_gaps_parts_as_one_and_keeps_its_energy(count):
    """Newton's law for all contacts at once: the first comes back, the others leave together with its speed of approach
    between.
    """
    ids = chain(count, 0.0, 1.0, way=0.0123)
    begin(gravity=(0, 0, 0), tolerance=1e-8)
    run(30)
    n = count - 1
    assert speeds(ids) == pytest.approx(
        [10 * (1 - n) / (1 + n)] + [20 / (1 + n)] * n, abs=1e-5
    )  # the solve's 1e-8, times n²
    assert speeds(ids) @ speeds(ids) == pytest.approx(100, rel=1e-5)


@pytest.mark.parametrize("gaps", [(0, 0.003), (0.003, 0), (1e-12, 0.003, 0, 0.002, 0.0005)])
def test_rows_of_which_some_touch_keep_their_energy(gaps):
    stuff = material(0.0, restitution=1.0)
    ids, x = [], 0.0
    for gap in (0.0042, *gaps, None):
        ids.append(free_disk(x, 0, stuff=stuff))
        x += 1 + (gap or 0)
    O.bodies[ids[0]].state.vel = (10, 0, 0)
    begin(gravity=(0, 0, 0), tolerance=1e-8)
    run(40)
    assert speeds(ids) @ speeds(ids) == pytest.approx(100, rel=1e-6) and speeds(ids).sum() == pytest.approx(
        10, rel=1e-12
    )
    assert np.all(np.diff(speeds(ids)) > -1e-6)  # nobody follows another any more: the solve's 1e-8, with a margin


def test_a_chain_between_walls_goes_to_and_fro():
    """Gaps of 2 mm, walls too: 10 m/s run through three gaps and a wall in a step, for a hundred steps."""
    stuff = material(0.0, restitution=1.0)
    for x in (-0.502, 2.506):
        O.bodies.append(scene.segments([(x, -2), (x, 2)], stuff))
    ids = [free_disk(1.002 * k, 0, stuff=stuff) for k in range(3)]
    m = masses_of(ids)[0]
    O.bodies[ids[0]].state.vel = (10, 0, 0)
    e = begin(gravity=(0, 0, 0), tolerance=1e-4)
    for step in range(1, 101):
        run(1)
        # the speed has gone 10 t; a turn through all is twice four gaps
        done = 10 * O.time / 0.002
        assert sorted(np.abs(speeds(ids))) == pytest.approx([0, 0, 10], abs=1e-9)
        total = sum(abs(O.forces.f(k)[0]) for k in range(2)) * O.dt  # the walls': each blow turns 2 m v
        assert total / (2 * m * 10) == pytest.approx(round(total / (2 * m * 10)), abs=1e-9) and total > 0
    assert e.kineticEnergy == pytest.approx(50 * m, rel=1e-11) and abs(e.energyError) < 1e-10 * m * 50
    assert e.missedRestitution == 0 and done > 400
    assert places(ids).min() > -0.0021 and places(ids).max() < 2.0061  # none is in a wall


# ---- gases ----------------------------------------------------------------------------------------


def closed_box(width, height, stuff):
    corners = [(0, 0), (width, 0), (width, height), (0, height), (0, 0)]
    return O.bodies.append(scene.segments(corners, stuff, piece=2))


def gas(e=1.0, mu=0.0, count=50, width=3.0, speed=3.0, seed=3, spread=0.3, walls=True):
    """Disks of 0.1 m to 0.3 m in a box, at random; ids."""
    dice = random.Random(seed)
    stuff = material(mu, restitution=e)
    if walls:
        closed_box(width, width, stuff)
    ids, put = [], []
    while len(ids) < count:
        r = 0.1 * (1 + spread * dice.uniform(-1, 1))
        x, y = dice.uniform(r, width - r), dice.uniform(r, width - r)
        if all(math.hypot(x - a, y - b) > r + c + 1e-4 for a, b, c in put):
            put.append((x, y, r))
            ids.append(O.bodies.append(scene.disk((x, y), r, stuff)))
            s = O.bodies[ids[-1]].state
            s.vel = (dice.gauss(0, speed), dice.gauss(0, speed), 0)
            s.angVel = (0, 0, dice.gauss(0, speed / r) if mu else 0)
    return ids


def totals(ids):
    """Energy [J], momentum [N s] and angular momentum about the origin [N m s] of disks."""
    states = [O.bodies[k].state for k in ids]
    energy = sum(0.5 * (s.mass * s.vel.squaredNorm() + s.inertia[2] * s.angVel[2] ** 2) for s in states)
    turning = sum(s.mass * s.pos.cross(s.vel)[2] + s.inertia[2] * s.angVel[2] for s in states)
    return energy, *(sum(s.mass * s.vel[axis] for s in states) for axis in (0, 1)), turning


def test_a_gas_of_elastic_disks_keeps_its_energy():
    """Half of the box is full: within 5 s each disk meets others and walls many times."""
    ids = gas()
    begin(gravity=(0, 0, 0), tolerance=1e-4, reach=0.2)
    energy = totals(ids)[0]
    contact, followed = engine(), 0
    for _ in range(5000):
        run(1)
        followed += contact.impactsFollowed
    assert followed > 1000
    assert totals(ids)[0] == pytest.approx(
        energy, rel=1e-5
    )  # impacts at walls that stay alone are the solve's, with 1e-4 of impulses, up and down
    assert abs(contact.energyError) < 1e-9 * energy and contact.missedRestitution < 1e-5 * energy
    assert contact.overlapWorstEver < 1e-4  # disks that pass each other at a wall's impact: (h v)²/2
    assert all(0 < O.bodies[k].state.pos[0] < 3 and 0 < O.bodies[k].state.pos[1] < 3 for k in ids)


@pytest.mark.parametrize("e, mu", [(1.0, 0.0), (0.8, 0.3)])
def test_what_meets_in_space_keeps_its_momenta_and_balance(e, mu):
    ids = gas(e, mu, walls=False, count=40, width=2.6)
    for k in ids:  # towards each other
        s = O.bodies[k].state
        s.vel -= 4 * (s.pos - Vector3(1.3, 1.3, 0))
    begin(gravity=(0, 0, 0))
    energy, *momenta = totals(ids)
    contact, followed = engine(), 0
    for _ in range(300):
        run(1)
        followed += contact.impactsFollowed
    after, *kept = totals(ids)
    assert followed > 50
    scale = energy**0.5 * sum(O.bodies[k].state.mass for k in ids) ** 0.5
    assert kept == pytest.approx(momenta, abs=1e-11 * scale)  # rounding of √(E M), times a metre for the third
    assert contact.impactLoss + contact.slidingLoss == pytest.approx(energy - after, abs=1e-9 * energy)
    assert abs(contact.energyError) < 1e-9 * energy
    if e == 1:
        assert after == pytest.approx(energy, rel=1e-10)
    else:
        assert after < 0.9 * energy and contact.slidingLoss > 0.01 * energy


GAS = World(
    disks=tuple(
        Disk(
            0.25 + 0.41 * (k % 5),
            0.3 + 0.43 * (k // 5),
            0.17 + 0.02 * math.sin(7 * k),
            (4 * math.sin(3 * k + 1), 4 * math.cos(5 * k)),
            9 * math.sin(k),
        )
        for k in range(20)
    ),
    walls=(Line(((0, 0), (2.2, 0), (2.2, 2.2), (0, 2.2), (0, 0)), piece=2),),
    stuffs={"rock": dict(frictionAngle=0.2, restitution=0.9), "ground": dict(frictionAngle=0.1, restitution=0.8)},
    gravity=(0, 0),  # what forces push is the solve's
    dt=2e-3,
    steps=60,
)


@pytest.mark.parametrize(
    "change", [Frame(mirrored=True), Frame(turn=0.7), Frame(speed=(3.0, -2.0)), Frame(length=0.01, time=0.1), "ids"]
)
def test_any_frame_and_any_ids_see_the_same_impacts(change):
    here = play(GAS)
    assert engine().steps == 60
    found = play(shuffled(GAS)) if change == "ids" else play(GAS, change)
    assert_same(found, here, 1e-6)  # some twenty impacts each make rounding grow by some ten times


def test_the_gas_is_the_same_after_save_and_load_and_on_two_threads(tmp_path):
    def course(threads, saved):
        O.reset()
        ids = gas(0.9, 0.2, count=30, width=2.4)
        begin(gravity=(0, -9.81, 0))
        for e in O.engines:
            e.ompThreads = threads
        for k in range(200):
            with threads_allowed(threads):
                run(1)
            if saved and k in (50, 101):
                O.save(str(tmp_path / "gas.yade.gz"), quiet=True)
                O.load(str(tmp_path / "gas.yade.gz"), quiet=True)
        return [tuple(O.bodies[k].state.pos) + tuple(O.bodies[k].state.vel) for k in ids], engine().impactLoss

    once = course(1, False)
    assert course(1, True) == once and course(2, False) == once


# ---- what the step's other parts have of them -----------------------------------------------------


def test_forces_and_reactions_are_the_sum_of_all_impacts_in_the_step():
    ids = chain(4, 0.002, 1.0)
    m = masses_of(ids)[0]
    begin(gravity=(0, 0, 0))
    run(1)  # 2, 4, 6 of its 10 mm
    assert engine().impactsFollowed == 3
    blow = 10 * m / O.dt
    assert [O.forces.f(k)[0] for k in ids] == pytest.approx([-blow, 0, 0, blow], abs=1e-9 * blow)
    table = tables.contacts(engine())
    assert list(table["normal"]) == pytest.approx([blow] * 3, rel=1e-12)
    assert [i.phys.normal for i in contacts() if i.phys.normal != 0] == pytest.approx([blow] * 3, rel=1e-12)
    assert engine().contacts == 3
    run(1)
    assert engine().contacts == 0 and [i.phys.normal for i in contacts()] == [0] * len(contacts())


def test_gaps_wider_than_the_solve_looks_at_are_known_to_impacts():
    ids = chain(4, 0.06, 1.0, speed=100.0)  # openGap 0.05: left out of the solve, as nothing approaches
    begin(gravity=(0, 0, 0), dt=3e-3, reach=0.2)
    run(1)
    assert speeds(ids) == pytest.approx([0, 0, 0, 100], abs=1e-9) and engine().impactsFollowed == 3
    assert places(ids)[-1] == pytest.approx(3 + 0.3, abs=1e-12)
    blow = 100 * masses_of(ids)[0] / O.dt
    assert list(tables.contacts(engine())["normal"]) == pytest.approx([blow] * 3, rel=1e-12)


def test_friction_and_spin_act_in_each_impact():
    """A disk with spin glances off one that stands before a wall; each impact slides, with Coulomb's law for its own
    impulse.
    """
    mu, e = 0.1, 0.8
    stuff = material(mu, restitution=e)
    O.bodies.append(scene.segments([(2.002, -5), (2.002, 5)], stuff))
    a, b = free_disk(0.5 - 0.002, 0, (10, 0, 0), stuff), free_disk(1.5, 0, stuff=stuff)
    O.bodies[a].state.angVel = (0, 0, 50)
    e_ = begin(gravity=(0, 0, 0), dt=5e-4)
    m, I = O.bodies[a].state.mass, O.bodies[a].state.inertia[2]
    before = totals([a, b])[0]
    run(1)
    # pair, at 0.2 ms: P = (1 + e)/2 m v; the wall turns the second one at 0.42 ms; they meet again at 0.7 ms, later
    # than this step
    p = (1 + e) / 2 * m * 10
    v2 = p / m
    q = (1 + e) * m * v2
    sa, sb = O.bodies[a].state, O.bodies[b].state
    assert sa.vel[0] == pytest.approx(10 - v2, rel=1e-10) and sb.vel[0] == pytest.approx(-e * v2, rel=1e-10)
    # the surface of the first moves up at the contact and takes the second along; that turns against it, and the wall's
    # friction then works on what it has
    assert sa.vel[1] == pytest.approx(-mu * p / m, rel=1e-10) and sa.angVel[2] == pytest.approx(
        50 - 0.5 * mu * p / I, rel=1e-10
    )
    up, spin = mu * p / m, -0.5 * mu * p / I
    slip = up + 0.5 * spin  # of its rim at the wall
    most, stick = mu * q, abs(slip) / (1 / m + 0.25 / I)
    t = -math.copysign(min(most, stick), slip)
    assert sb.vel[1] == pytest.approx(up + t / m, rel=1e-9) and sb.angVel[2] == pytest.approx(
        spin + 0.5 * t / I, rel=1e-9
    )
    assert e_.impactLoss + e_.slidingLoss == pytest.approx(before - totals([a, b])[0], rel=1e-10)
    assert e_.slidingLoss > 0 and e_.impactsFollowed == 2


@pytest.mark.parametrize("turn", [0, 40, 90])
def test_a_driven_wall_does_the_work_that_disks_have(turn):
    """Whichever way it goes."""
    stuff = material(0.0, restitution=1.0)
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    ends = [(-0.502 * c - y * s, -0.502 * s + y * c) for y in (-2, 2)]
    for k in O.bodies.append(scene.segments(ends, stuff)):
        O.bodies[k].state.vel = (5 * c, 5 * s, 0)
    ids = [free_disk(1.002 * k * c, 1.002 * k * s, stuff=stuff) for k in range(3)]
    e = begin(gravity=(0, 0, 0))
    run(20)
    assert totals(ids)[0] > 1 and e.wallWork == pytest.approx(totals(ids)[0], rel=1e-10)
    assert abs(e.energyError) < 1e-10 * e.wallWork


def test_a_gas_under_gravity_keeps_its_balance():
    ids = gas(count=30, width=2.4)
    e = begin(gravity=(0, -9.81, 0), tolerance=1e-4)
    run(1)
    start = e.kineticEnergy + e.potentialEnergy
    run(2000)
    # bodies move with the velocity of the step's end: ½ h m g times the change of speed since the beginning,
    # stepping.rst
    bound = 0.5 * O.dt * 9.81 * sum(O.bodies[k].state.mass for k in ids) * 6
    assert abs(e.energyError) < bound
    # where forces act impacts are the solve's, and what restitution could not give back is told
    lost = start - e.kineticEnergy - e.potentialEnergy
    assert 0 < e.missedRestitution < 2 * lost


def test_impacts_of_what_forces_hold_against_gravity_keep_their_balance():
    """On an air table that leans, or in water of their own weight, disks are pushed by nothing: their impacts are
    followed, and displace them along gravity.
    """
    ids = gas(count=40, width=2.4)
    for k in ids:
        O.forces.setPermF(k, (0, 9.81 * O.bodies[k].state.mass, 0))
    e = begin(gravity=(0, -9.81, 0), tolerance=1e-12)
    (energy, _, up, _), followed = totals(ids), 0
    for _ in range(500):
        run(1)
        followed += e.impactsFollowed
    assert followed > 100
    assert totals(ids)[0] == pytest.approx(energy, rel=1e-9)
    # bodies rise with the velocity of a step's end, and forces work on the mean one: ½ h g times what the momentum has
    # changed, stepping.rst
    assert e.energyError == pytest.approx(0.5 * O.dt * 9.81 * (totals(ids)[2] - up), abs=1e-9 * energy)


# ---- rest -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("e", [0.3, 0.6, 0.9])
def test_a_stack_with_restitution_comes_to_rest(e):
    stuff = material(0.3, restitution=e)
    floor(stuff)
    ids = [free_disk(0, 0.5 + 1.02 * (k + 1) - 1, stuff=stuff) for k in range(5)]
    begin()
    engine().advance(6000)
    assert max(abs(O.bodies[k].state.vel[1]) for k in ids) < 1e-3 * 9.81 * 1e-3
    loads = sorted(i.phys.normal for i in contacts() if i.phys.normal > 0)
    assert loads == pytest.approx([9.81 * masses_of(ids)[0] * (k + 1) for k in range(5)], rel=1e-6)


def test_a_stack_at_rest_is_hit_and_settles_again():
    stuff = material(0.3, restitution=0.5)
    floor(stuff)
    ids = [free_disk(0, 0.5 + k, stuff=stuff) for k in range(3)]
    begin()
    run(20)
    top = free_disk(0, 3.6, (0, -8, 0), stuff)
    e = engine()
    e.forgetEnergies()
    e.advance(4000)
    assert max(abs(O.bodies[k].state.vel[1]) for k in (*ids, top)) < 1e-5 and O.bodies[top].state.pos[
        1
    ] == pytest.approx(3.5, abs=1e-3)
    # bodies move with the velocity of a step's end: ½ h m g times the change of speed, stepping.rst
    assert e.energyError == pytest.approx(0.5 * O.dt * O.bodies[top].state.mass * 9.81 * 8, rel=1e-3)


def test_a_scene_at_rest_follows_no_impacts():
    stuff = material(0.3, restitution=0.9)
    floor(stuff)
    ids = [free_disk(1.0 * k, 0.5, stuff=stuff) for k in range(4)]
    e = begin()
    for _ in range(20):
        run(1)
        assert e.impactsFollowed == 0
    assert max(abs(O.bodies[k].state.vel[1]) for k in ids) < 1e-12


# ---- limits and what is told ----------------------------------------------------------------------


def caged(speed=10.0, room=1e-4):
    stuff = material(0.0, restitution=1.0)
    for x in (-0.5 - room, 0.5 + room):
        O.bodies.append(scene.segments([(x, -2), (x, 2)], stuff))
    return free_disk(0, 0, (speed, 0, 0), stuff)


def test_more_impacts_than_allowed_are_told(capfd):
    disk = caged()
    e = begin(gravity=(0, 0, 0))
    run(3)  # 50 to and fro in each step
    assert abs(O.bodies[disk].state.vel[0]) == pytest.approx(10, abs=1e-9) and e.overrunSteps == 0
    e.maxImpacts = 7
    capfd.readouterr()
    run(3)
    assert e.overrunSteps > 0
    said = capfd.readouterr().err
    assert "maxImpacts = 7" in said and "raise maxImpacts" in said
    assert abs(O.bodies[disk].state.vel[0]) <= 10 + 1e-9  # no energy comes of it
    # what the solve finds after the last of them is a part of the reaction
    reactions = {i.id1: i.phys.normal for i in contacts()}
    assert max(reactions.values()) > 0
    for wall in (0, 1):
        assert reactions.get(wall, 0) == pytest.approx(abs(O.forces.f(wall)[0]), rel=1e-12)


def test_without_impacts_that_are_followed_the_loss_is_told(capfd):
    ids = chain(5, 0.007, 1.0)
    e = begin(gravity=(0, 0, 0), maxImpacts=0)
    before = totals(ids)[0]
    run(300)
    lost = before - totals(ids)[0]
    assert lost > 0.3 * before and e.missedRestitution == pytest.approx(lost, rel=0.01)
    assert "restitution would have given back" in capfd.readouterr().err
    e.forgetEnergies()
    assert e.missedRestitution == 0


@pytest.mark.parametrize("gap", [1e-9, 1e-6, 1e-5])
@pytest.mark.parametrize("dt", [1e-4, 1e-3, 5e-3])
def test_what_is_placed_a_little_above_its_place_is_told_of_nothing(gap, dt, capfd):
    stuff = material(0.3, restitution=0.9)
    floor(stuff)
    for k in range(3):
        free_disk(0, 0.5 + k * (1 + gap) + gap, stuff=stuff)
    begin(dt=dt)
    run(20)
    assert "restitution" not in capfd.readouterr().err


def test_what_hangs_by_bonds_is_hit_by_the_solve_and_its_loss_told():
    stuff = material(0.0, restitution=1.0, tensileStrength=1e9, bondCreationDistance=1e-6)
    loose = material(0.0, restitution=1.0, bondCreationDistance=1e-6)
    ids = [free_disk(x, 0, stuff=loose) for x in (-2.006, -1.003)] + [free_disk(x, 0, stuff=stuff) for x in (0.0, 1.0)]
    e = begin(gravity=(0, 0, 0))
    run(1)
    assert e.bond() == 1
    O.bodies[ids[0]].state.vel = (10, 0, 0)
    before = totals(ids)[0]
    run(5)
    # the first hands its speed to the second, which meets two that hang together: −v/3 and 2 v/3
    assert speeds(ids) == pytest.approx([-10 / 3, 0, 20 / 3, 20 / 3], abs=1e-6)
    assert totals(ids)[0] == pytest.approx(before, rel=1e-6)


@pytest.mark.parametrize("value", [-1, -1000])
def test_a_limit_below_none_is_refused(value):
    free_disk()
    begin(maxImpacts=value)
    with pytest.raises(RuntimeError, match=f"maxImpacts = {value}: it must be 0 or more"):
        run(1)
