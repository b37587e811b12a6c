"""What reactions are to bodies and to whoever reads them: directions, torques on walls, places of impacts, restitution
under gravity, residual adhesion.
"""
import math

import pytest
from yade import O, utils
from yade.minieigenHP import Vector3
from yade.nonsmooth import scene

from contact_scenes import G, begin, contacts, engine, floor, free_disk, material, momenta, run


pytestmark = pytest.mark.usefixtures("empty")


# ---- directions -----------------------------------------------------------------------------------


def held_by(kind, free_first, angle=2.4):
    """A disk that rests on a disk, or on a wall, in the direction ``angle`` from it; ids of what holds it and of the
    disk.
    """
    stuff = material(0.6, 0.1)
    n, t = Vector3(math.cos(angle), math.sin(angle), 0), Vector3(-math.sin(angle), math.cos(angle), 0)

    def holder():
        if kind == "disk":
            return O.bodies.append(scene.disk((0, 0), 0.5, stuff, fixed=True))
        ends = [tuple(n * 0.5 + 0.3 * t + s * t)[:2] for s in (-2, 2)]
        return O.bodies.append(scene.segments(ends, stuff))[0]

    if free_first:
        disk = O.bodies.append(scene.disk(tuple(n)[:2], 0.5, stuff))
        return holder(), disk, n, t
    return holder(), O.bodies.append(scene.disk(tuple(n)[:2], 0.5, stuff)), n, t


@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("free_first", [False, True])
@pytest.mark.parametrize("kind", ["disk", "wall"])
def test_forces_are_told_as_they_act_on_the_second_body(kind, free_first, swapped):
    body, disk, n, t = held_by(kind, free_first)
    begin(gravity=(0, 0, 0))
    run(1)
    if swapped and kind == "disk":  # YADE may keep a pair the other way round
        i = contacts()[0]
        a, b = i.id1, i.id2
        O.interactions.erase(a, b)
        utils.createInteraction(b, a)
    pressing, shearing, twisting = 2000.0, 700.0, 90.0
    O.forces.setPermF(disk, -pressing * n + shearing * t)
    # takes back the moment about the contact point that the shear has
    O.forces.setPermT(disk, (0, 0, twisting - 0.5 * shearing))
    run(2)
    (i,) = contacts()
    on_disk = pressing * n - shearing * t  # rest: what acts from outside is taken; by 1e-12 of the solver, and rounding
    sign = 1 if i.id2 == disk else -1
    assert (i.phys.normalForce - sign * pressing * n).norm() < 1e-9 * pressing
    assert (i.phys.shearForce + sign * shearing * t).norm() < 1e-9 * pressing
    assert i.phys.normalForce.dot(i.geom.normal) > 0
    # as numbers: on the body of higher id, or on the disk of a wall, along its normal turned by +90° from the other
    direct = 1 if kind == "wall" or body < disk else -1
    assert i.phys.normal == pytest.approx(pressing, rel=1e-9)
    # both the normal and the body that it acts on turn round
    assert i.phys.tangential == pytest.approx(-shearing, rel=1e-9)
    assert i.phys.torque == pytest.approx(-direct * twisting, rel=1e-8)
    # and as forces on bodies; O.forces of the disk holds the push as well
    assert (O.forces.f(body) + on_disk).norm() < 1e-9 * pressing and O.forces.f(disk).norm() < 1e-9 * pressing


# ---- moments --------------------------------------------------------------------------------------


@pytest.mark.parametrize("sense", [0, 1])
def test_a_wall_feels_the_moment_of_what_lies_on_it(sense):
    stuff, slope = material(0.8, 0.2), 0.3
    along, up = Vector3(math.cos(slope), math.sin(slope), 0), Vector3(-math.sin(slope), math.cos(slope), 0)
    middle = Vector3(7, -2, 0)
    wall = O.bodies.append(scene.segments([tuple(middle + s * along)[:2] for s in (-6, 6)], stuff, sense=sense))[0]
    place = middle + 3.5 * along + 0.5 * up
    disk = O.bodies.append(scene.disk(tuple(place)[:2], 0.5, stuff))
    begin()
    weight = Vector3(0, -O.bodies[disk].state.mass * G, 0)
    push, twist = Vector3(300, -800, 0), 450.0
    O.forces.setPermF(disk, push)
    O.forces.setPermT(disk, (0, 0, twist))
    run(3)
    # statics: the wall takes all that acts on the disk, about any point; here its own middle
    assert (O.forces.f(wall) - weight - push).norm() < 1e-9 * weight.norm()
    assert O.forces.t(wall)[2] == pytest.approx((place - middle).cross(weight + push)[2] + twist, rel=1e-9)
    assert O.bodies[disk].state.vel.norm() < 1e-12


def test_a_plank_on_a_hinge_turns_under_a_disk():
    plank = O.bodies.append(scene.segments([(-3, 0), (3, 0)], material(0.0)))[0]
    p = O.bodies[plank].state
    p.mass, p.inertia, p.blockedDOFs = 500.0, Vector3(1, 1, 900.0), "xyzXY"
    disk = free_disk(2.0, 0.5, mu=0.0)
    s, h = O.bodies[disk].state, 1e-3
    begin(dt=h)
    run(1)
    # they stay together: −g h + P/m = a ω = −a² P/I
    impulse = G * h / (1 / s.mass + 2.0**2 / 900.0)
    assert s.vel[1] == pytest.approx(-G * h + impulse / s.mass, rel=1e-12)
    assert p.angVel[2] == pytest.approx(-2.0 * impulse / 900.0, rel=1e-12)
    assert O.forces.t(plank)[2] == pytest.approx(-2.0 * impulse / h, rel=1e-12) and O.forces.f(plank)[
        1
    ] == pytest.approx(-impulse / h, rel=1e-12)


@pytest.mark.parametrize("most", [1000, 0])
def test_contacts_give_no_moment_in_all(most):
    """Two free disks of different sizes that meet off centre, with friction: about any point the one loses what the
    other gets, be it an impact that is followed or one of the solve (``most``: maxImpacts)."""
    stuff = material(0.5, 0.05, restitution=0.3)
    pair = [O.bodies.append(scene.disk((x, y), r, stuff)) for x, y, r in ((3.0, 1.0, 0.4), (3.9, 1.6, 0.7))]
    O.bodies[pair[0]].state.vel, O.bodies[pair[0]].state.angVel = (3, 1.0, 0), (0, 0, -4)
    begin(gravity=(0, 0, 0), maxImpacts=most)
    linear, angular = momenta(pair)
    run(60)
    after, turned = momenta(pair)
    assert engine().impactLoss > 0 and engine().slidingLoss > 0
    scale = O.bodies[pair[0]].state.mass * 3
    # rounding, arms of 4 m
    assert (after - linear).norm() < 1e-12 * scale and turned == pytest.approx(angular, abs=1e-12 * 4 * scale)


@pytest.mark.parametrize("driver_first", [True, False])
def test_a_wheel_drives_another_by_the_ratio_of_their_radii(driver_first):
    stuff, driver, driven = material(0.5), 0.75, 0.25
    ids = [
        O.bodies.append(
            scene.disk((0, 0 if drives else driver + driven), driver if drives else driven, stuff, fixed=drives)
        )
        for drives in ((True, False) if driver_first else (False, True))
    ]
    big, small = ids if driver_first else ids[::-1]
    O.bodies[big].state.angVel = (0, 0, 2)
    O.bodies[small].state.blockedDOFs = "xzXY"
    begin(gravity=(0, 0, 0))
    O.forces.setPermF(small, (0, -1e6, 0))  # friction can give 500 N s in a step, and 2 · 3 I/r = 368 are asked
    run(2)
    assert O.bodies[small].state.angVel[2] == pytest.approx(-2 * driver / driven, rel=1e-9)  # 1e-12 is the solver's


# ---- impacts --------------------------------------------------------------------------------------


def bounces(e, mass, y, v, h, steps):
    """Height, speed and lost energy of a disk of 1 m that falls on a floor, step by step, by the rules of
    doc/theory/stepping.rst.
    """
    lost = 0.0
    for _ in range(steps):
        gap, free = y - 0.5, v - G * h
        least = -math.inf if gap > 0.05 else -max(gap, 0) / h
        if e > 0 and v < 0 and gap + h * v <= 0:
            least = -e * v
        before, v = v, max(free, least)
        lost -= 0.5 * mass * (v - free) * (v + before)
        y += h * v
        yield y, v, lost


@pytest.mark.parametrize("e", [0.0, 0.3, 0.8, 1.0])
def test_a_disk_bounces_step_by_step_as_the_rules_say(e):
    stuff = material(0.3, restitution=e)
    floor(stuff)
    disk = free_disk(0, 0.9, (0, -1.0, 0), stuff)
    s, h = O.bodies[disk].state, 2e-3
    begin(dt=h, relaxationRate=0)
    hits, before = [], -1.0
    for y, v, lost in bounces(e, s.mass, 0.9, -1.0, h, 900):
        O.step()
        # m/s, m: rounding, the solver's 1e-12
        assert s.vel[1] == pytest.approx(v, abs=1e-10) and s.pos[1] == pytest.approx(y, abs=1e-11)
        assert engine().impactLoss == pytest.approx(lost, abs=1e-9 * s.mass)
        if v - before > 1.5 * G * h:
            hits.append((before, v))
        before = v
    # physics: 0.4 m and 1 m/s give √(1 + 2 g 0.4) = 2.97 m/s, of which the share e is left, to the step's g h
    impact = math.sqrt(1 + 2 * G * 0.4)
    assert hits[0][0] == pytest.approx(-impact, abs=G * h)
    if e > 0:
        assert hits[0][1] == pytest.approx(e * impact, abs=G * h)
    if e == 1:
        assert len(hits) == 3  # a period is 0.6 s
    if e in (0.0, 0.3):
        assert s.pos[1] == pytest.approx(0.5, abs=1e-10) and abs(s.vel[1]) < 1e-10  # and rests, exactly on the floor


def test_an_impact_takes_place_where_bodies_touch():
    """The gap closes within a step and not more; the next step begins in touch, with the common speed."""
    light, heavy = O.bodies.append(scene.disk((0, 0), 0.5, material(0.0))), O.bodies.append(
        scene.disk((1.83, 0), 0.8, O.materials[0])
    )
    a, b, h = O.bodies[light].state, O.bodies[heavy].state, 1e-2
    a.vel, b.vel = (9.0, 0, 0), (-4.0, 0, 0)  # 13 m/s against a gap of 0.53 m: 4.08 steps
    begin(gravity=(0, 0, 0), dt=h, reach=0.2)
    run(4)
    assert (a.vel[0], b.vel[0]) == (9.0, -4.0)
    run(1)
    # what is left of the gap in this step, at the speed of the common centre
    common, gap = (9 * a.mass - 4 * b.mass) / (a.mass + b.mass), 0.53 - 4 * 0.13
    share = b.mass / (a.mass + b.mass)
    assert a.vel[0] == pytest.approx(common + share * gap / h, rel=1e-10) and b.vel[0] == pytest.approx(
        common - (1 - share) * gap / h, rel=1e-10
    )
    assert b.pos[0] - a.pos[0] == pytest.approx(1.3, abs=1e-12)
    run(1)
    assert (a.vel[0], b.vel[0]) == pytest.approx((common, common), rel=1e-10)
    assert b.pos[0] - a.pos[0] == pytest.approx(1.3, abs=1e-12)


@pytest.mark.parametrize("of_floor, of_disk", [(0.2, 0.7), (0.7, 0.2)])
def test_the_larger_of_two_coefficients_of_restitution_holds(of_floor, of_disk):
    floor(material(0.3, restitution=of_floor))
    s = O.bodies[free_disk(0, 0.5, (0, -2.0, 0), restitution=of_disk)].state
    begin()
    run(1)
    assert s.vel[1] == pytest.approx(0.7 * 2.0, rel=1e-12)


# ---- residual adhesion ----------------------------------------------------------------------------


@pytest.mark.parametrize("gap, adhesive", [(-0.004, True), (0.9e-3, True), (1.1e-3, False), (0.03, False)])
@pytest.mark.parametrize("share", [-3.0, 0.0, 0.9, 1.1])
@pytest.mark.parametrize("other", ["disk", "wall"])
def test_residual_adhesion_acts_while_bodies_touch(other, gap, adhesive, share):
    """A pull of ``share`` times the adhesion, at a gap within adhesionRange = 1e-3 ℓ or beyond it, which is known up to
    the reach of 0.05 ℓ.
    """
    strength, h = 2e4, 1e-3
    length, at = (0.7, 0.7) if other == "disk" else (0.9, 0.45)
    stuff = material(0.3, residualTensileStrength=strength / length)
    if other == "disk":
        O.bodies.append(scene.disk((0, 0), 0.25, stuff, fixed=True))
    else:
        O.bodies.append(scene.segments([(0, -3), (0, 3)], stuff))
    gap *= length
    disk = O.bodies.append(scene.disk((at + gap, 0), 0.45, stuff))
    s = O.bodies[disk].state
    O.forces.setPermF(disk, (share * strength, 0, 0))
    begin(gravity=(0, 0, 0), dt=h, relaxationRate=0)
    speed, range_of = 0.0, 1e-3 * length
    assert (gap <= range_of) == adhesive
    # of new contacts the loop itself knows the thresholds; those of the steps after are an Interaction's, which a
    # script has seen
    for _ in range(4):
        run(1)
        (i,) = contacts()
        free = speed + h * share * strength / s.mass
        adhesion = strength if gap <= range_of else 0.0
        closing = -max(gap, 0) / h  # the fastest approach that the gap allows
        speed = max(closing, free - h * adhesion / s.mass)
        assert i.phys.adhesion == pytest.approx(adhesion, rel=1e-12)
        assert s.vel[0] == pytest.approx(speed, abs=1e-12)
        assert i.phys.normal == pytest.approx(s.mass * (speed - free) / h, abs=1e-6)  # N, of 2e4
        gap += h * speed
        assert s.pos[0] == pytest.approx(at + gap, abs=1e-12)


# ---- what a step sums up --------------------------------------------------------------------------


def test_forces_and_torques_of_other_engines_work():
    """From rest: ½ m v² and ½ I ω², step by step exact, since the mean of the velocities before and after counts."""
    a, b = (O.bodies[free_disk(x, 0)].state for x in (0, 5))
    O.forces.setPermF(0, (200, -300, 0))
    O.forces.setPermT(1, (0, 0, 40))
    e = begin(gravity=(0, 0, 0))
    run(50)
    assert a.vel.norm() > 0 and b.angVel[2] > 0
    assert e.externalWork == pytest.approx(
        0.5 * a.mass * a.vel.squaredNorm() + 0.5 * b.inertia[2] * b.angVel[2] ** 2, rel=1e-12
    )
    run(1)
    assert abs(e.energyError) < 1e-11 * e.externalWork and e.kineticEnergy > 0


def test_figures_of_a_step_by_hand():
    stuff = material(0.0)
    floor(stuff)
    places, radii, speeds = ((0, 0.392), (3, 0.2), (7, 4)), (0.4, 0.2, 1.0), ((3, 0, 0), (0, 0, 0), (0, 4, 0))
    ids = [O.bodies.append(scene.disk(place, r, stuff)) for place, r in zip(places, radii)]
    O.bodies.append(scene.disk((20, 20), 1.0, stuff, fixed=True))  # held bodies do not count
    for k, v in zip(ids, speeds):
        O.bodies[k].state.vel = v
    O.bodies[ids[2]].state.angVel = (0, 0, 5)
    e = begin(gravity=(0, 0, 0), relaxationRate=0)
    run(1)
    masses = [O.bodies[k].state.mass for k in ids]
    mean = [sum(m * p[axis] for m, p in zip(masses, places)) / sum(masses) for axis in (0, 1)]
    assert tuple(e.centroid)[:2] == pytest.approx(mean, rel=1e-12)
    assert (e.meanSpeed, e.maxSpeed) == pytest.approx((7 / 3, 4), rel=1e-12)
    assert tuple(e.momentum)[:2] == pytest.approx((masses[0] * 3, masses[2] * 4), rel=1e-12)
    # two touch the floor, one of them by 0.01 of its diameter of 0.8 m
    assert (e.contacts, e.candidates) == (2, 2) and (e.overlapWorst, e.overlapMean) == pytest.approx(
        (0.01, 0.005), rel=1e-9
    )
    # I = ½ m r²
    assert e.kineticEnergy == pytest.approx(0.5 * (masses[0] * 9 + masses[2] * 16 + 0.5 * masses[2] * 25), rel=1e-12)
