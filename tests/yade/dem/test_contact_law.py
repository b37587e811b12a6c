"""A disk on walls of segments: sliding, rolling, joints, corners and slip (targets.md, section Analytic)."""
import math

import pytest
from yade import O
from yade.minieigenHP import Vector3
from yade.nonsmooth import scene, tables
from yade.wrapper import SlipWeakeningMat

from contact_scenes import G, begin, contacts, material, run

DIP = math.radians(21)
ALONG, NORMAL = Vector3(math.cos(DIP), -math.sin(DIP), 0), Vector3(math.sin(DIP), math.cos(DIP), 0)


pytestmark = pytest.mark.usefixtures("empty")


def incline(mu, rolling=0.0, radius=0.5, piece=0.25, turns=True, wall=None, length=8.0, dip=DIP):
    """A disk at rest at the top of an inclined wall of many pieces; returns its id."""
    along, normal = Vector3(math.cos(dip), -math.sin(dip), 0), Vector3(math.sin(dip), math.cos(dip), 0)
    stuff = material(mu, rolling)
    O.bodies.append(scene.segments([(0, 0), tuple(length * along)[:2]], wall or stuff, piece=piece))
    disk = O.bodies.append(scene.disk(tuple(0.35 * along + radius * normal)[:2], radius, stuff))
    if not turns:
        O.bodies[disk].state.blockedDOFs = "zXYZ"
    return disk


def follow(disk, acceleration, steps, dt=1e-3, tolerance=1e-9):
    """Runs and checks speed, place and that one contact at most acts. Exact in Moreau-Jean stepping, whose constant
    acceleration gives v = a t and x = a t (t + h)/2; the tolerance is the solver's and the rounding of many steps."""
    begin(dt=dt)
    start = O.bodies[disk].state.pos
    for _ in range(steps // 20):
        run(20)
        assert len(contacts()) == 1
    t, s = O.time, O.bodies[disk].state
    assert s.vel.dot(ALONG) == pytest.approx(acceleration * t, rel=tolerance, abs=1e-12)
    assert (s.pos - start).dot(ALONG) == pytest.approx(acceleration * t * (t + dt) / 2, rel=tolerance, abs=1e-12)
    assert abs(s.vel.dot(NORMAL)) < 1e-9  # no bump: joints are straight to rounding, 1e-16 m/h
    assert abs((s.pos - start).dot(NORMAL)) < 1e-9
    return s


@pytest.mark.parametrize("rolling", [0.0, 0.1, 0.15])
def test_rolls_over_joints(rolling):
    a = 2 / 3 * G * (math.sin(DIP) - 2 * rolling * math.cos(DIP))
    s = follow(incline(0.5, rolling), a, 2000)
    assert s.angVel[2] == pytest.approx(-s.vel.dot(ALONG) / 0.5, rel=1e-9)  # no slip: tan θ ≤ 3 μ_s − 4 μ_r


def test_one_contact_at_a_straight_joint():
    stuff = material(0.3)
    O.bodies.append(scene.segments([(-1, 0), (1, 0)], stuff, piece=1))
    disk = O.bodies.append(scene.disk((0, 0.5), 0.5, stuff))
    begin()
    run(50)
    assert len(contacts()) == 1
    weight = O.bodies[disk].state.mass * G
    assert contacts()[0].phys.normal == pytest.approx(weight, rel=1e-10)
    assert O.forces.f(0)[1] + O.forces.f(1)[1] == pytest.approx(-weight, rel=1e-10)


def test_concave_corner_has_one_contact_a_side():
    # a frictionless V of 45°: each side carries m g/√2, however it is cut
    stuff = material(0.0)
    O.bodies.append(scene.segments([(-3, 3), (0, 0), (3, 3)], stuff, piece=0.4))
    O.bodies.append(scene.disk((0, 0.5 * math.sqrt(2)), 0.5, stuff))
    begin()
    run(50)
    assert len(contacts()) == 2
    for i in contacts():
        assert i.phys.normal == pytest.approx(O.bodies[i.id2].state.mass * G / math.sqrt(2), rel=1e-8)
    assert contacts()[0].geom.normal.dot(contacts()[1].geom.normal) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("drop", [5, 30, 90])
def test_convex_corner_is_rounded_with_one_contact(drop):
    turn = math.radians(drop)
    stuff = material(0.0)
    O.bodies.append(scene.segments([(-3, 0), (0, 0), (3 * math.cos(turn), -3 * math.sin(turn))], stuff, piece=0.5))
    disk = O.bodies.append(scene.disk((-0.3, 0.5), 0.5, stuff))
    O.bodies[disk].state.vel = (0.8, 0, 0)
    begin(dt=2e-4)
    s = O.bodies[disk].state
    most, worst = 0, 0.0
    for _ in range(400):
        run(20)
        most = max(most, sum(i.phys.normal > 0 for i in contacts()))
        corner = s.pos.norm() if s.pos[0] > 0 and s.pos.dot((math.cos(turn), -math.sin(turn), 0)) < 0 else 0.5
        worst = max(worst, 0.5 - corner)
        if s.pos[1] < 0.4 or s.pos[0] > 1.5:
            break
    assert most == 1
    assert worst < 1e-6  # m: it went round the corner, not through it
    # energy: no friction, no bump; the time step's error is below m g h v
    drop_height = 0.5 - s.pos[1]
    assert drop_height > 0.05
    assert s.vel.norm() ** 2 == pytest.approx(0.8**2 + 2 * G * drop_height, rel=4e-3)


def test_a_wall_made_backwards_is_the_mirrored_wall():
    """Disks on a floor, in the wedge outside a convex corner and in a concave one: mirrored to the last bit, with the
    same bodies in the same order.
    """
    corners = [(-4, 0.5), (-1, 0), (2, -2.5), (5, -1)]

    def course(mirrored):
        O.reset()
        stuff, side = material(0.4, 0.1), -1 if mirrored else 1
        line = [(0 - x, y) for x, y in reversed(corners)] if mirrored else corners
        walls = scene.segments(line, stuff, piece=0.7, sense=1, backwards=mirrored)
        O.bodies.append(walls)
        for x, y in ((-2.5, 1.4), (-0.9, 0.9), (-0.7, 2.0), (0.9, -0.4), (2.1, -1.4), (3.5, -0.4)):
            O.bodies.append(scene.disk((side * x, y), 0.5, stuff))
        begin(dt=1e-3, tolerance=1e-10)
        found = []
        for _ in range(40):
            run(25)
            found += [
                (side * b.state.pos[0], b.state.pos[1], side * b.state.vel[0], b.state.vel[1], side * b.state.angVel[2])
                for b in O.bodies
            ]
        owned = [side * i.geom.normal[0] for i in contacts() if i.id1 < len(walls)]
        return found, [(i.id1, i.id2) for i in contacts()], owned, len(walls)

    here, there = course(False), course(True)
    assert here == there and len(here[2]) > 5
    # a disk did lie in the wedge: its contact's normal is neither wall's
    assert any(b.shape.hasNext for b in O.bodies if hasattr(b.shape, "hasNext"))


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("side", [1, -1])
def test_a_one_sided_wall_holds_on_its_side_alone(sense, side):
    """+1 is the left of the direction of travel. Behind the wall disks pass, but one whose centre is there by less than
    its radius is pushed through to the front.
    """
    stuff = material(0.3)
    O.bodies.append(scene.segments([(-5, 0), (5, 0)], stuff, sense=sense))
    speed, rate, slack = 0.2, 0.25, 1e-3
    touching, deep, leaving, beyond = (
        O.bodies.append(scene.disk((x, side * y), 0.5, stuff)) for x, y in ((-3, 0.5), (-1, 0.3), (1, 0.3), (3, 0.501))
    )
    for k in (touching, deep, leaving, beyond):
        O.bodies[k].state.vel = (0, side * speed * (1 if k == leaving else -1), 0)
    begin(gravity=(0, 0, 0), relaxationRate=rate, correctionSpeed=1e6, correctionSlack=slack)
    run(1)
    away = {
        k: (side * O.bodies[k].state.vel[1], side * O.bodies[k].state.pos[1]) for k in (touching, deep, leaving, beyond)
    }
    front = side == sense
    # in front overlaps are 0.2 m, behind the wall 0.8 m, less the slack that stays; 1e-12 of the solver
    out = rate * (0.2 - slack) if front else -rate * (0.8 - slack)
    assert away[deep] == pytest.approx((0 if front else -speed, 0.3 + out), abs=1e-11)
    assert away[leaving] == pytest.approx((speed if front else 0, 0.3 + out), abs=1e-11)
    # in front 1 mm is more than a step's path
    assert away[beyond] == pytest.approx((-speed, 0.501 - speed * O.dt), abs=1e-11)
    if front:
        assert away[touching] == pytest.approx((0, 0.5), abs=1e-11)


def test_a_two_sided_wall_holds_on_the_side_where_the_centre_is():
    stuff = material(0.3)
    O.bodies.append(scene.segments([(-5, 0), (5, 0)], stuff))
    disks = [O.bodies.append(scene.disk((x, y), 0.5, stuff)) for x, y in ((-2, 0.3), (2, -0.3))]
    begin(gravity=(0, 0, 0), relaxationRate=0.25, correctionSpeed=1e6, correctionSlack=0)
    run(1)
    assert [O.bodies[k].state.pos[1] for k in disks] == pytest.approx([0.3 + 0.25 * 0.2, -0.3 - 0.25 * 0.2], abs=1e-12)


# ---- slip along a wall ----------------------------------------------------------------------------


def weak_wall(**more):
    return material(0.3, kind=SlipWeakeningMat, **more)


def test_slip_survives_joints_and_is_the_path():
    wall = weak_wall(criticalSlip=50)
    disk = incline(0.7, turns=False, wall=wall)
    follow(disk, G * (math.sin(DIP) - 0.3 * math.cos(DIP)), 2000)  # the wall's friction rules, not the disk's
    path = (O.bodies[disk].state.pos - 0.35 * ALONG).dot(ALONG)
    assert path > 1.5  # 6 joints and more
    assert wall.slipOf(disk) == pytest.approx(path, rel=1e-9)  # sums of the same steps
    assert contacts()[0].phys.slip == wall.slipOf(disk)
    assert wall.slipOf(0) == 0 and wall.weakenedCount() == 0
    assert wall.meanSlip() == pytest.approx(path, rel=1e-9)


def test_rolling_is_no_slip():
    wall = weak_wall(criticalSlip=50)
    disk = incline(0.7, wall=wall)
    follow(disk, 2 / 3 * G * math.sin(DIP), 500)
    assert wall.slipOf(disk) < 1e-10  # m, over 0.3 m of rolling


def test_step_weakening_drops_friction_at_the_critical_slip():
    # a step of friction from 0.3 to 0.1 after 0.5 m: two parabolas
    wall = weak_wall(criticalSlip=0.5, weakenedFrictionAngle=math.atan(0.1))
    disk = incline(0.3, turns=False, wall=wall)
    dt, s = 1e-3, O.bodies[disk].state
    begin(dt=dt)
    strong, weak = (G * (math.sin(DIP) - mu * math.cos(DIP)) for mu in (0.3, 0.1))
    while wall.slipOf(disk) < 0.5:
        run(1)
        assert O.time < 2
        assert wall.weakenedCount() == (wall.slipOf(disk) >= 0.5)
    assert O.time == pytest.approx(math.sqrt(2 * 0.5 / strong), abs=2 * dt)
    v, t = s.vel.dot(ALONG), O.time
    assert v == pytest.approx(strong * t, rel=1e-9)
    run(300)
    assert s.vel.dot(ALONG) - v == pytest.approx(weak * (O.time - t), rel=1e-9)
    assert contacts()[0].phys.tangensOfFrictionAngle == pytest.approx(0.1, rel=1e-12)
    wall.forgetSlip()
    assert wall.slipOf(disk) == 0


@pytest.mark.parametrize(
    "law, left",
    [
        ("step", lambda share: 1.0 if share < 1 else 0.0),
        ("linear", lambda share: max(0.0, 1 - share)),
        ("exponential", lambda share: math.exp(-share)),
    ],
)
def test_friction_and_cohesion_fall_by_the_law_of_their_wall(law, left):
    """Two disks that do not turn are drawn along a wall at their own speeds; a step works with the slip before it, disk
    by disk.
    """
    strong, weak, cohesion, rest, critical, h = 0.5, 0.2, 3e3, 1e3, 0.2, 2e-3
    wall = material(
        strong,
        0.1,
        kind=SlipWeakeningMat,
        residualTensileStrength=cohesion,
        criticalSlip=critical,
        weakening=law,
        weakenedFrictionAngle=math.atan(weak),
        weakenedTensileStrength=rest,
    )
    O.bodies.append(scene.segments([(-5, 0), (9, 0)], wall, piece=0.7))
    fast, slow = disks = [O.bodies.append(scene.disk((x, 0.5), 0.5, wall)) for x in (0, 3)]
    speeds = {fast: 1.5, slow: -0.4}
    for k in disks:
        s = O.bodies[k].state
        s.blockedDOFs, s.vel = "xzXYZ", (speeds[k], 0, 0)
    begin(dt=h)
    weight, seen = O.bodies[fast].state.mass * G, set()
    for step in range(1, 201):
        before = {k: wall.slipOf(k) for k in disks}
        O.step()
        for i in contacts():
            share = left(before[i.id2] / critical)
            mu, adhesion = weak + (strong - weak) * share, rest + (cohesion - rest) * share
            seen.add(share)
            assert (i.phys.tangensOfFrictionAngle, i.phys.adhesion) == pytest.approx((mu, adhesion), rel=1e-12)
            assert i.phys.normal == pytest.approx(weight, rel=1e-9)
            # along −x, n turned by +90°
            assert i.phys.tangential == pytest.approx(math.copysign(mu * (weight + adhesion), speeds[i.id2]), rel=1e-9)
            assert i.phys.currentRollingArm == pytest.approx(0.1, rel=1e-12)  # which does not weaken
        for k in disks:
            assert wall.slipOf(k) == pytest.approx(abs(speeds[k]) * h * step, rel=1e-12)
        slips = [wall.slipOf(k) for k in disks]
        assert wall.weakenedCount() == sum(slip >= critical for slip in slips) and wall.meanSlip() == pytest.approx(
            sum(slips) / 2, rel=1e-12
        )
    count = len(O.bodies)
    assert tables.slip(wall, 0, count + 2).tolist() == [*(wall.slipOf(k) for k in range(count)), 0.0, 0.0]
    assert tables.slip(wall, disks[1], 1).tolist() == [wall.slipOf(disks[1])] and slips[1] > 0
    assert wall.weakenedCount() == 1 and len(seen) > (1 if law == "step" else 200)


def test_a_wall_never_gains_strength_by_slip_and_one_that_does_not_press_counts_none():
    wall = material(
        0.2,
        kind=SlipWeakeningMat,
        residualTensileStrength=1e3,
        criticalSlip=0.01,
        weakening="linear",
        weakenedFrictionAngle=math.atan(0.6),
        weakenedTensileStrength=5e3,
    )
    bare = material(0.3, kind=SlipWeakeningMat, criticalSlip=0.01)
    for y, stuff in ((0, wall), (10, bare)):
        O.bodies.append(scene.segments([(-5, y), (5, y)], stuff))
    pressed, touching = (O.bodies.append(scene.disk((0, y), 0.5, stuff)) for y, stuff in ((0.5, wall), (10.5, bare)))
    for k in (pressed, touching):
        O.bodies[k].state.blockedDOFs, O.bodies[k].state.vel = "xzXYZ", (1, 0, 0)
    begin(gravity=(0, 0, 0))
    run(30)
    phys = next(i.phys for i in contacts() if i.id2 == pressed)
    assert wall.slipOf(pressed) == pytest.approx(0.03, rel=1e-12)  # held by its cohesion alone
    assert phys.tangensOfFrictionAngle == pytest.approx(0.2, rel=1e-12) and phys.adhesion == 1e3
    # nothing presses, nothing holds
    assert bare.slipOf(touching) == 0 and bare.meanSlip() == 0 and bare.weakenedCount() == 0


def test_linear_weakening_follows_the_slip():
    wall = weak_wall(criticalSlip=2, weakening="linear")
    disk = incline(0.3, turns=False, wall=wall)
    begin()
    run(1200)
    # friction of a step is that of the slip before it
    before = wall.slipOf(disk)
    run(1)
    assert 0.1 < before < 1
    assert contacts()[0].phys.tangensOfFrictionAngle == pytest.approx(0.3 * (1 - before / 2), rel=1e-9)
