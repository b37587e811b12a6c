"""Bonds over gaps that close freely (NscdMat.bondsClose): compression at touch, tension at their length, shear
everywhere; the same bits in any way to run them.
"""
import math
from dataclasses import replace

import numpy as np
import pytest
from yade import O
from yade.nonsmooth import scene

from contact_scenes import begin, contacts, engine, material, run
from symmetries import BINARY, FRAMES, Disk, Line, World, assert_bits, assert_same, on_threads, play, saved_and_loaded
from test_bonds import F_A, LENGTH, MU, RADIUS, ROLLING, SIGMA, load, strengths

GAP, ZONE = 0.008, 1e-3  # [ℓ]: wider than the half-axes of the ellipse, which closing does not leave
SLACK = 1.1e-4  # what errors of position may stay [ℓ], and some

pytestmark = pytest.mark.usefixtures("empty")


def pair(gap=GAP, angle=0.0, closes=(True, True), wall=False, dt=2e-3, **more):
    """A fixed disk, or a wall, and a free disk at `angle` over a gap [ℓ], bonded; returns the free one's id."""
    a, b = (material(**{**strengths(ZONE), "bondsClose": c, **more}) for c in closes)
    along = np.array([math.cos(angle), math.sin(angle)])
    if wall:
        a.wall = a.bondsToAll = True
        across = np.array([-along[1], along[0]])
        O.bodies.append(scene.segments([3 * across, -3 * across], a))
    else:
        O.bodies.append(scene.disk((0, 0), RADIUS, a, fixed=True))
    free = O.bodies.append(scene.disk(((RADIUS if wall else LENGTH) + gap) * along, RADIUS, b))
    begin(gravity=(0, 0, 0), dt=dt, maxIterations=5000)
    run(1)
    assert engine().bond() == 1
    return free


def pull_gently(free, **more):
    """So that the jerk at the bond's end is within its strength: half a per cent of it."""
    load(free, normal=-0.005 * F_A, **more)


def gap_of(free, wall=False):
    return O.bodies[free].state.pos.norm() - (RADIUS if wall else LENGTH)


@pytest.mark.parametrize("wall", [False, True])
@pytest.mark.parametrize("angle", [0.0, 2.0])
def test_a_pressed_bond_closes_in_free_flight_and_then_bears(angle, wall):
    free = pair(angle=angle, wall=wall)
    s = O.bodies[free].state
    load(free, normal=F_A, angle=angle)
    way = 0
    for k in range(1, 100):
        way += k * O.dt**2 * F_A / s.mass  # of steps of free flight
        if way > GAP:
            break
        run(1)
        assert gap_of(free, wall) == pytest.approx(GAP - way, abs=1e-12)
        assert contacts()[0].phys.normal == 0
    assert k > 5
    run(1)
    assert gap_of(free, wall) == pytest.approx(0, abs=1e-12)  # it comes to touch, and is stopped there
    assert contacts()[0].phys.normal > 0
    run(3)
    assert contacts()[0].phys.normal == pytest.approx(F_A, rel=1e-9)
    assert abs(gap_of(free, wall)) < 1e-12 and engine().bonds == 1
    e = engine()
    assert e.impactLoss == pytest.approx(F_A * GAP, rel=0.2)  # all that it fell; the last step cuts a part of it
    assert abs(e.energyError) < 1e-9 * F_A * GAP


def test_a_strut_bears_over_the_gap_as_ever():
    free = pair(closes=(False, False))
    load(free, normal=F_A)
    run(5)
    assert gap_of(free) == pytest.approx(GAP, abs=1e-12) and contacts()[0].phys.normal == pytest.approx(F_A, rel=1e-9)


@pytest.mark.parametrize("closes", [(True, False), (False, True)])
def test_one_of_two_particles_is_enough_and_a_wall_decides_alone(closes):
    free = pair(closes=closes)
    assert contacts()[0].phys.closes
    load(free, normal=F_A)
    run(30)
    assert abs(gap_of(free)) < 1e-12
    O.reset()
    pair(closes=closes, wall=True)
    assert contacts()[0].phys.closes == closes[0]


def test_a_pulled_bond_goes_back_to_its_length_holds_there_and_breaks_beyond():
    free = pair()
    load(free, normal=0.5 * F_A)
    run(40)
    assert abs(gap_of(free)) < 1e-12
    pull_gently(free)
    run(1)
    assert 0 < gap_of(free) < GAP and contacts()[0].phys.normal == 0  # it opens freely
    run(200)
    load(free, normal=-0.999 * F_A)
    run(60)
    assert gap_of(free) == pytest.approx(GAP, abs=SLACK)
    assert contacts()[0].phys.normal == pytest.approx(-0.999 * F_A, rel=1e-9)
    assert engine().bonds == 1 and O.bodies[free].state.vel.norm() < 1e-12
    load(free, normal=-1.01 * F_A)
    moved = 0
    while engine().bonds:
        moved = gap_of(free)
        run(1)
        assert O.iter < 3000
    e = engine()
    assert (e.brokenTension, e.brokenShear, e.brokenTorque, e.brokenMixed) == (1, 0, 0, 0)
    assert (
        GAP + 0.9 * ZONE <= moved <= GAP + 1.1 * ZONE
    )  # a half-axis beyond its length; a step takes it farther by a tenth at most


def test_a_jerk_that_is_more_than_the_bond_bears_breaks_it():
    """Nearly its strength over the whole gap: it has no rest of strength to be stopped by."""
    free = pair()
    O.bodies[free].state.pos = (LENGTH, 0, 0)
    load(free, normal=-0.999 * F_A)
    run(60)
    assert engine().bonds == 0 and engine().brokenTension == 1


@pytest.mark.parametrize("closed", [0.0, 0.5])
def test_shear_and_torque_hold_as_with_no_normal_force_and_break_so(closed):
    """At its length, and half closed: T_max = μ_s F_a, Γ_max = μ_r ℓ F_a."""
    for kind, most, mode in (("shear", MU * F_A, 2), ("torque", ROLLING * LENGTH * F_A, 3)):
        free = pair(rolling=ROLLING)
        s = O.bodies[free].state
        s.pos = (LENGTH + (1 - closed) * GAP, 0, 0)
        lever = RADIUS + 0.5 * (1 - closed) * GAP
        for share, holds in ((0.999, True), (1.01, False)):
            if kind == "shear":
                O.forces.setPermF(free, (0, share * most, 0))
                O.forces.setPermT(free, (0, 0, -lever * share * most))
            else:
                O.forces.setPermF(free, (0, 0, 0))
                O.forces.setPermT(free, (0, 0, share * most))
            run(20)
            if holds:
                p = contacts()[0].phys
                assert abs(p.normal) < 1e-9 * F_A and s.vel.norm() < 1e-9 and abs(s.angVel[2]) < 1e-9
                assert abs(p.tangential if kind == "shear" else p.torque) == pytest.approx(share * most, rel=1e-6)
        while engine().bonds:
            run(1)
            assert O.iter < 5000
        e = engine()
        assert [e.brokenTension, e.brokenShear, e.brokenTorque, e.brokenMixed][mode - 1] == 1
        O.reset()


def test_a_bond_that_has_yielded_closes_too_and_is_as_long_as_it_was_pulled():
    free = pair(gap=0.0, bondEllipseNormal=0.02)
    load(free, normal=-1.05 * F_A)
    run(40)
    load(free, normal=-0.5 * F_A)  # comes to rest, a little farther out
    run(60)
    longest = gap_of(free)
    assert 1e-3 < longest < 0.02 and engine().bonds == 1
    load(free, normal=F_A)
    run(60)
    assert abs(gap_of(free)) < 1e-12
    pull_gently(free)
    run(300)
    assert gap_of(free) == pytest.approx(longest, abs=2 * SLACK) and engine().bonds == 1


def test_a_jerk_at_the_end_of_the_chain_loses_what_an_impact_loses():
    free = pair()
    s, speed = O.bodies[free].state, 0.05
    s.pos, s.vel = (LENGTH + 0.5 * GAP, 0, 0), (speed, 0, 0)
    run(200)
    assert gap_of(free) == pytest.approx(GAP, abs=SLACK) and s.vel.norm() < 1e-12
    e = engine()
    kinetic = 0.5 * s.mass * speed**2
    assert e.impactLoss == pytest.approx(kinetic, rel=1e-9) and e.debondingLoss == 0
    assert abs(e.energyError) < 1e-9 * kinetic


def test_materials_can_change_their_mind():
    free = pair(closes=(False, False), bondEllipseNormal=0.02)
    for b in O.bodies:
        b.material.bondsClose = True
    engine().updateStrengths()
    load(free, normal=F_A)
    run(60)
    assert abs(gap_of(free)) < 1e-12
    contacts()[0].phys.closes = False  # a strut again, as long as at its creation: it takes back what it misses
    load(free)
    run(200)
    assert gap_of(free) == pytest.approx(GAP, abs=SLACK)


def test_a_row_that_is_pressed_closes_all_its_gaps_and_none_overlaps():
    stuff = material(0.3, tensileStrength=SIGMA, bondCreationDistance=0.03, bondEllipseNormal=1e-3, bondsClose=True)
    gaps = (0.004, 0.0, 0.02, 0.01)
    x = np.concatenate([[0], np.cumsum([LENGTH + g for g in gaps])])
    ids = [O.bodies.append(scene.disk((place, 0), RADIUS, stuff, fixed=place == 0)) for place in x]
    begin(gravity=(0, 0, 0), dt=2e-3)
    run(1)
    assert engine().bond() == 4
    O.forces.setPermF(ids[-1], (-3 * F_A, 0, 0))
    for _ in range(100):
        run(1)
        for i in contacts():
            assert -SLACK < -i.geom.penetrationDepth < gaps[i.id1] + SLACK
    assert O.bodies[ids[-1]].state.pos[0] == pytest.approx(4 * LENGTH, abs=5 * SLACK)
    assert all(i.phys.normal == pytest.approx(3 * F_A, rel=1e-6) for i in contacts()) and engine().bonds == 4
    O.forces.setPermF(ids[-1], (0.005 * F_A, 0, 0))
    run(500)
    O.forces.setPermF(ids[-1], (0.9 * F_A, 0, 0))
    run(50)
    # jerks at the ends of two bonds may have taken each beyond its length by the way of a step
    assert O.bodies[ids[-1]].state.pos[0] == pytest.approx(x[-1], abs=1e-3) and engine().bonds == 4


@pytest.mark.parametrize("beyond", [2e-3, 5e-3])
def test_what_a_bond_was_stretched_beyond_its_length_is_taken_back(beyond):
    """By displacements, up to what may stay, while the bond is pulled at its length: by a script that moves a disk,
    with an ellipse that holds it.
    """
    free = pair(bondEllipseNormal=0.05)
    load(free, normal=-0.5 * F_A)
    run(5)
    assert gap_of(free) == pytest.approx(GAP, abs=SLACK) and contacts()[0].phys.normal == pytest.approx(
        -0.5 * F_A, rel=1e-6
    )
    engine().view()
    O.bodies[free].state.pos += (beyond, 0, 0)
    run(1)
    assert gap_of(free) > GAP - SLACK
    run(200)
    assert gap_of(free) == pytest.approx(GAP, abs=SLACK) and engine().bonds == 1
    assert contacts()[0].phys.normal == pytest.approx(-0.5 * F_A, rel=1e-6)


def closing():
    """Chains of disks bonded over gaps that fall on a floor and on each other, and break."""
    disks = [
        Disk(x + 1.006 * k * np.cos(turn), y + 1.006 * k * np.sin(turn), 0.5, speed, spin)
        for x, y, turn, speed, spin in (
            (0.0, 0.6, 0.25, (0.5, -3.0), 0.0),
            (9.0, 0.7, 2.2, (-2.0, -2.0), 0.4),
            (-1.0, 3.4, 0.1, (0.0, -5.0), 0.0),
        )
        for k in range(6)
    ]
    rock = dict(
        frictionAngle=0.5,
        rollingFriction=0.02,
        tensileStrength=4e4,
        residualTensileStrength=1e3,
        bondEllipseNormal=0.03,
        bondEllipseTangential=0.03,
        bondCreationDistance=0.01,
        bondsClose=True,
    )
    return World(
        tuple(disks),
        (Line(((-20, -0.001), (20, -0.001)), piece=6.0),),
        dict(rock=rock, ground=dict(frictionAngle=0.4, rollingFriction=0.05, wall=True)),
        bond=1,
        steps=120,
        options=dict(reach=0.1, maxIterations=2000),
    )


WORLD = closing()


@pytest.fixture(scope="module")
def here():
    course = play(WORLD)
    bonds, *broken = course["counts"][-1, :4]
    assert bonds > 3 and sum(broken) > 0
    struts = play(replace(WORLD, stuffs={**WORLD.stuffs, "rock": {**WORLD.stuffs["rock"], "bondsClose": False}}))
    assert not np.array_equal(course["counts"], struts["counts"])  # it matters
    return course


@pytest.mark.parametrize("name", FRAMES)
def test_any_frame_sees_the_same_course(here, name):
    assert_same(play(WORLD, FRAMES[name]), here, 1e-9)  # as in test_symmetries_bonds.py


def test_powers_of_two_as_units_change_no_bit(here):
    assert_bits(play(WORLD, BINARY), here)


def test_a_scene_saved_and_loaded_while_bonds_close_changes_no_bit(here, tmp_path):
    assert_bits(play(WORLD, halfway=saved_and_loaded(tmp_path / "half.yade.gz")), here)


def test_one_and_two_threads_have_the_same_bits(here, tmp_path):
    for threads in (1, 2):
        assert_bits(on_threads("test_closing_bonds", tmp_path, threads), here)


@pytest.mark.parametrize(
    "left, names", [("bonds_close", "material rock: bonds_close true"), ("wall", "material wall: bonds_close true")]
)
def test_soft_contacts_refuse_them(left, names):
    from yade.nonsmooth import section, soft

    values = dict(
        friction=0.3, residual_friction=0.3, rolling_friction=0.0, residual_rolling_friction=0.0, density=2500.0
    )
    rock = section.Material(name="rock", tensile_strength=1e5, bonds_close=left == "bonds_close", **values)
    with pytest.raises(soft.SoftError, match=names):
        made = soft.equivalent(rock, 1e8, diameter=1.0)
        soft.wall_material(made, section.Material(name="wall", bonds_close=True, **values))
