"""Errors of position are taken back by displacements: overlaps go, bonds find their length, and no velocity is left
behind.
"""
import math

import pytest
from yade import O
from yade.nonsmooth import scene

from contact_scenes import begin, engine, floor, free_disk, material, momenta, run

KAPPA = 0.2
SLIGHT = 1e-4  # ℓ, correctionSlack as it is unless set: an error that is left as it is


pytestmark = pytest.mark.usefixtures("empty")


def hexagonal_block(overlap, side=20, stuff=None):
    """Ids of side × side disks of 1 m in a hexagonal block whose neighbours overlap by that share of a diameter."""
    stuff = stuff or material(0.3)
    return [
        free_disk((i + 0.5 * (j % 2)) * (1 - overlap), j * math.sqrt(0.75) * (1 - overlap), stuff=stuff)
        for j in range(side)
        for i in range(side)
    ]


def relative_energy(disks):
    """Kinetic energy [J] of the disks relative to their centre of mass, and their mass [kg]."""
    states = [O.bodies[d].state for d in disks]
    mass = sum(s.mass for s in states)
    mean = sum((s.mass * s.vel for s in states), states[0].vel * 0) / mass
    return (
        sum(0.5 * s.mass * (s.vel - mean).squaredNorm() + 0.5 * s.inertia[2] * s.angVel[2] ** 2 for s in states),
        mass,
    )


def test_a_dense_block_in_free_fall_is_not_blown_apart():
    disks, overlap, dt = hexagonal_block(1e-3), 1e-3, 1e-3
    begin(dt=dt, relaxationRate=KAPPA)
    run(50)
    energy, mass = relative_energy(disks)
    # a bias κ g/h on the velocity gives every overlapping pair this speed in the very first step, half of it to each
    biased = 0.5 * mass * (0.5 * KAPPA * overlap / dt) ** 2
    assert energy < 1e-9 * biased
    # a pair's would be down to 0.8^50 = 1.4e-5 of itself; inside a block overlaps have to wait for the rim
    assert engine().overlapWorst < 0.1 * overlap + SLIGHT
    assert O.bodies[disks[0]].state.vel[1] == pytest.approx(-9.81 * 50 * dt, rel=1e-12)


def test_an_overlap_shrinks_by_its_share_a_step_and_the_centre_stays():
    stuff = material(0.3)
    a, b = free_disk(0, 0, stuff=stuff), free_disk(0.99, 0, stuff=stuff)
    begin(gravity=(0, 0, 0), relaxationRate=KAPPA, correctionSpeed=1e3)
    run(1)
    for step in range(1, 20):
        # geometry is read at the beginning of a step; rounding of a handful of operations
        gap = (O.bodies[b].state.pos - O.bodies[a].state.pos).norm() - 1
        assert gap + SLIGHT == pytest.approx((-0.01 + SLIGHT) * (1 - KAPPA) ** step, rel=1e-10)
        assert O.bodies[a].state.pos[0] + O.bodies[b].state.pos[0] == pytest.approx(0.99, abs=1e-14)
        assert O.bodies[a].state.vel.norm() == 0
        O.step()


@pytest.mark.parametrize("slack", [SLIGHT, 0.0])
@pytest.mark.parametrize("moved", [-0.004, 0.004])
def test_a_bond_finds_its_length_from_both_sides(moved, slack):
    stuff = material(0.3, 0.1, tensileStrength=1e6, bondEllipseNormal=0.02, bondEllipseTangential=0.02)
    a, b = free_disk(0, 0, stuff=stuff), free_disk(1.01, 0, stuff=stuff)
    begin(gravity=(0, 0, 0), relaxationRate=KAPPA, correctionSpeed=1e3, correctionSlack=slack)
    O.step()
    assert engine().bond() == 1
    O.bodies[b].state.pos += (moved, 0, 0)
    run(60)
    # 0.8^60 = 1.5e-6 of the 4 mm is left
    assert O.bodies[b].state.pos[0] - O.bodies[a].state.pos[0] == pytest.approx(
        1.01 + math.copysign(slack, moved), abs=1e-5 * abs(moved)
    )
    assert engine().bonds == 1 and O.bodies[b].state.vel.norm() == 0
    assert engine().energies()["debonding"] == 0


@pytest.mark.parametrize("slack", [SLIGHT, 0.0])
def test_what_a_bond_opens_by_is_not_taken_back(slack):
    """Drawn by 1.2 F_a for five steps a bond opens as a mass under 0.2 F_a does, then is slowed down by F_a until it
    stands, and keeps that length: though all of an error is taken back in a step, as fast as it asks."""
    strength, h = 1e5, 2e-3
    stuff = material(0.3, 0.1, tensileStrength=strength, bondEllipseNormal=0.1, bondEllipseTangential=0.1)
    O.bodies.append(scene.disk((0, 0), 0.5, stuff, fixed=True))
    free = free_disk(1, 0, stuff=stuff)
    e = begin(gravity=(0, 0, 0), dt=h, relaxationRate=1, correctionSpeed=1e3, correctionSlack=slack)
    s = O.bodies[free].state
    run(1)
    assert e.bond() == 1
    speed, place = 0.0, 1.0
    for step in range(60):
        O.forces.setPermF(free, ((1.2 if step < 5 else 0.0) * strength, 0, 0))
        run(1)
        speed = max(0.0, speed + h * (0.2 if step < 5 else -1.0) * strength / s.mass)
        place += h * speed
        assert (s.vel[0], s.pos[0]) == pytest.approx((speed, place), abs=1e-9)  # m; the bond opens by 0.4 mm
    assert e.bonds == 1 and speed == 0 and place > 1 + 3e-4
    assert e.energies()["correction"] == pytest.approx(0, abs=1e-9)


def test_nothing_is_taken_back_without_a_rate_or_sweeps():
    stuff = material(0.3)
    a, b = free_disk(0, 0, stuff=stuff), free_disk(0.99, 0, stuff=stuff)
    for options in ({"relaxationRate": 0}, {"correctionSweeps": 0}):
        begin(gravity=(0, 0, 0), **options)
        run(10)
        assert O.bodies[b].state.pos[0] - O.bodies[a].state.pos[0] == 0.99


def test_the_speed_of_a_correction_is_limited():
    stuff = material(0.3)
    a, b = free_disk(0, 0, stuff=stuff), free_disk(0.9, 0, stuff=stuff)
    begin(gravity=(0, 0, 0), relaxationRate=1, correctionSpeed=0.5, dt=1e-2)
    O.step()
    assert O.bodies[b].state.pos[0] - O.bodies[a].state.pos[0] == pytest.approx(0.9 + 0.5 * 1e-2, rel=1e-12)


def test_what_lifts_a_disk_is_counted():
    stuff = material(0.3)
    floor(stuff)
    disk = free_disk(0, 0.49, stuff=stuff)
    begin(relaxationRate=KAPPA, correctionSpeed=1e3)
    run(100)
    s, e = O.bodies[disk].state, engine()
    assert s.pos[1] == pytest.approx(0.5 - SLIGHT, abs=1e-9) and s.vel.norm() < 1e-12
    # from 0.49 m to there, as far as 0.8^99 lets it
    assert e.correctionEnergy == pytest.approx(s.mass * 9.81 * (0.01 - SLIGHT), rel=1e-7)
    assert abs(e.energyError) < 1e-9 * e.correctionEnergy + 1e-6  # J; rounding of m g y, 1e4 J


@pytest.mark.parametrize("kappa", [0.05, 0.5, 1.0])
@pytest.mark.parametrize("moved, bonded", [(-0.01, False), (-0.01, True), (0.01, True)])
def test_a_step_takes_back_the_share_kappa_and_no_more_than_the_speed_allows(kappa, moved, bonded):
    stuff = material(0.3, 0.1, tensileStrength=1e9, bondEllipseNormal=0.1, bondEllipseTangential=0.1)
    a, b = (O.bodies[free_disk(x, 0, stuff=stuff)].state for x in (0, 1))
    e, h = begin(gravity=(0, 0, 0), relaxationRate=kappa, correctionSpeed=1e3), 1e-3
    run(1)
    if bonded:
        assert e.bond() == 1
    b.pos += (moved, 0, 0)
    stays = math.copysign(SLIGHT, moved)
    for share in (10.0, 0.7, 0.0):  # of what the rate alone would take back, as a limit of speed
        gap = b.pos[0] - a.pos[0] - 1
        wanted = kappa * (stays - gap)
        e.correctionSpeed = share * abs(wanted) / h
        O.step()
        assert b.pos[0] - a.pos[0] - 1 == pytest.approx(gap + min(share, 1) * wanted, abs=1e-14)
        if kappa == 1.0:  # nothing is left; put it back
            b.pos += (gap - (b.pos[0] - a.pos[0] - 1), 0, 0)
    assert a.vel.norm() == b.vel.norm() == 0


def test_what_lifts_a_pile_is_counted_body_by_body():
    """The lower disk is lifted out of the floor, and the upper one with it and out of the lower one."""
    stuff = material(0.3)
    floor(stuff)
    low, high = (O.bodies[free_disk(0, y, stuff=stuff)].state for y in (0.48, 1.45))
    e = begin(relaxationRate=KAPPA, correctionSpeed=1e3, correctionSweeps=200)
    run(150)
    assert (low.pos[1], high.pos[1]) == pytest.approx((0.5 - SLIGHT, 1.5 - 2 * SLIGHT), abs=1e-9)  # 0.8^150
    assert e.correctionEnergy == pytest.approx(low.mass * 9.81 * (0.02 + 0.05 - 3 * SLIGHT), rel=1e-7)
    assert abs(e.energyError) < 1e-9 * low.mass * 9.81  # m g times a nanometre; rounding of m g y


def test_a_plank_on_a_hinge_turns_as_far_as_its_lever_asks():
    """κ of the overlap in one step, shared by inverse masses: Q = κ o/(1/m + a²/I), the disk moves by Q/m and the plank
    turns by −a Q/I.
    """
    plank = O.bodies[O.bodies.append(scene.segments([(-3, 0), (3, 0)], material(0.0)))[0]].state
    plank.mass, plank.inertia, plank.blockedDOFs = 500.0, (1, 1, 900.0), "xyzXY"
    s, arm, overlap = O.bodies[free_disk(2.0, 0.49, mu=0.0)].state, 2.0, 0.01 - SLIGHT
    begin(gravity=(0, 0, 0), relaxationRate=KAPPA, correctionSpeed=1e3)
    O.step()
    pseudo = KAPPA * overlap / (1 / s.mass + arm**2 / 900.0)
    assert s.pos[1] - 0.49 == pytest.approx(pseudo / s.mass, rel=1e-9)
    assert 2 * math.atan2(plank.ori[2], plank.ori[3]) == pytest.approx(-arm * pseudo / 900.0, rel=1e-9)
    assert s.vel.norm() == 0 and plank.angVel[2] == 0


def test_a_disk_that_slides_out_of_a_wall_keeps_its_speed():
    """What is held takes the angular momentum: only two free bodies get impulses that keep it."""
    stuff = material(0.0)
    floor(stuff)
    s = O.bodies[free_disk(0, 0.48, (3, 0, 0), stuff)].state
    e = begin(gravity=(0, 0, 0), relaxationRate=0.5, correctionSpeed=1e3)
    run(20)
    # 0.5^20
    assert s.pos[1] == pytest.approx(0.5 - SLIGHT, abs=1e-7) and tuple(s.vel) == (3, 0, 0) and e.correctionEnergy == 0


def test_a_bond_that_is_made_in_an_overlap_has_no_length():
    stuff = material(0.3, 0.1, tensileStrength=1e6, bondEllipseNormal=0.05, bondEllipseTangential=0.05)
    a, b = (O.bodies[free_disk(x, 0, stuff=stuff)].state for x in (0, 0.99))
    e = begin(gravity=(0, 0, 0), relaxationRate=0, correctionSpeed=1e3, correctionSlack=0)
    run(1)
    assert e.bond() == 1
    e.relaxationRate = 0.5
    run(40)
    assert b.pos[0] - a.pos[0] == pytest.approx(1, abs=1e-11) and e.bonds == 1  # 0.5^40


def test_forces_of_other_engines_do_no_work_on_displacements():
    """What lifts a disk is counted against its weight, whatever else holds or presses it: such a force has no
    potential, and its work is that on the path of the velocities.
    """
    stuff = material(0.3)
    floor(stuff)
    s = O.bodies[free_disk(0, 0.48, stuff=stuff)].state
    O.forces.setPermF(1, (0, 0.5 * s.mass * 9.81, 0))
    e = begin(relaxationRate=KAPPA, correctionSpeed=1e3)
    O.step()
    lifted = KAPPA * (0.02 - SLIGHT)
    assert s.pos[1] == pytest.approx(0.48 + lifted, abs=1e-12) and s.vel.norm() < 1e-14
    assert (
        e.correctionEnergy == pytest.approx(s.mass * 9.81 * lifted, rel=1e-10) and abs(e.externalWork) < 1e-10 * s.mass
    )
    O.step()
    assert abs(e.energyError) < 1e-9 * s.mass  # J; rounding of m g y


@pytest.mark.parametrize("gravity", [(0, 0, 0), (3, -9.81, 0)])
def test_drawing_apart_in_free_flight_gives_nothing(gravity):
    """Action and reaction: the centre of the two stays on its path, so their weight does no work on the
    displacements.
    """
    stuff = material(0.3)
    ids = [O.bodies.append(scene.disk(at, r, stuff)) for at, r in (((0, 0), 0.5), ((0.6, 0.8), 0.7))]
    for k in ids:
        O.bodies[k].state.vel = (1, 2, 0)
    e = begin(gravity=gravity, relaxationRate=KAPPA, correctionSpeed=1e3)
    run(100)
    apart = (O.bodies[ids[1]].state.pos - O.bodies[ids[0]].state.pos).norm()
    assert apart == pytest.approx(1.2 - 1.2 * SLIGHT, abs=1e-9)
    assert e.correctionEnergy == pytest.approx(0, abs=1e-12 * O.bodies[ids[1]].state.mass * 9.81)


@pytest.mark.parametrize("apart, bonded", [(0.98, False), (0.98, True), (1.03, True)])
def test_bodies_that_pass_each_other_get_what_keeps_their_angular_momentum(apart, bonded):
    """Two disks at the distance d pass each other at the speed u. A step displaces them to d', and L = ½ m d u stays:
    u' = u (1 − (d' − d)/d'), ΔK = ¼ m (u'² − u²).
    """
    stuff = material(0.0, tensileStrength=1e9, bondEllipseNormal=0.2, bondEllipseTangential=1.0)
    a, b = (O.bodies[free_disk(x, 0, stuff=stuff)].state for x in (0, 1))
    e = begin(gravity=(0, 0, 0), relaxationRate=0.5, correctionSpeed=1e3)
    run(1)
    if bonded:
        assert e.bond() == 1
    u, mass = 2.0, a.mass
    b.pos = (apart, 0, 0)
    a.vel, b.vel = (0, -0.5 * u, 0), (0, 0.5 * u, 0)
    e.forgetEnergies()
    d = apart
    O.step()
    found = apart - 0.5 * (apart - 1 - math.copysign(SLIGHT, apart - 1))  # d' along the normal that the contact has
    after = u * (1 - (found - d) / found)
    given = 0.25 * mass * (after**2 - u**2)
    assert b.vel[1] - a.vel[1] == pytest.approx(after, rel=1e-12) and abs(b.vel[0] - a.vel[0]) < 1e-12
    assert e.correctionEnergy == pytest.approx(given, rel=1e-10)
    assert e.slidingLoss == e.debondingLoss == e.impactLoss == 0
    O.step()
    assert abs(e.energyError) < 1e-12 * mass * u**2


def test_disks_are_not_pushed_into_others_that_they_do_not_touch_yet():
    stuff = material(0.3)
    ids = [free_disk(x, 0, stuff=stuff) for x in (0, 0.98, 1.981)]
    begin(gravity=(0, 0, 0), relaxationRate=1, correctionSpeed=1e3, correctionSweeps=200)
    run(3)
    x = [O.bodies[i].state.pos[0] for i in ids]
    # the chain's answer: the first pair needs 0.02, the second had 0.001 to spare
    assert x[1] - x[0] == pytest.approx(1 - SLIGHT, abs=1e-9) and x[2] - x[1] == pytest.approx(1 - SLIGHT, abs=1e-9)


def test_a_spinning_pair_keeps_its_angular_momentum_and_its_length():
    stuff = material(0.3, 0.1, tensileStrength=1e9, bondEllipseNormal=0.1, bondEllipseTangential=0.1)
    pair = [free_disk(-0.5, 0, (0, -1, 0), stuff), free_disk(0.5, 0, (0, 1, 0), stuff)]
    for d in pair:
        O.bodies[d].state.angVel = (0, 0, 2)
    begin(gravity=(0, 0, 0), dt=5e-3)
    O.step()
    assert engine().bond() == 1
    linear, angular = momenta(pair)
    run(2000)  # 10 s, three turns
    after, turned = momenta(pair)
    # equal and opposite at every step; rounding of 2000 steps
    assert (
        abs(turned - angular) < 1e-11 * abs(angular) and (after - linear).norm() < 1e-11 * O.bodies[pair[0]].state.mass
    )
    # every step overshoots by ω² h²/2 = 5e-5 of the length, of which four of five parts are left at κ = 0.2
    assert (O.bodies[pair[1]].state.pos - O.bodies[pair[0]].state.pos).norm() == pytest.approx(1, abs=5e-4)
    assert O.bodies[pair[0]].state.angVel[2] == pytest.approx(2, rel=0.02)
