"""Cohesive bonds between two disks: thresholds of eqs (2), (4) and (6), the elliptic zone, residual strength,
layers.
"""
import math

import numpy as np
import pytest
from yade import O
from yade.minieigenHP import Quaternion
from yade.nonsmooth import scene, tables

from contact_scenes import begin, contacts, engine, material, run

RADIUS = 0.5
LENGTH = 2 * RADIUS
SIGMA, MU, ROLLING = 1e5, 0.3, 0.1
F_A = SIGMA * LENGTH
PUSH = 2e5  # N, the compression of the shear and torque tests
JUST = 1e-6  # the relative margin of issue 2, acceptance 5
ZONE = 1e-4  # a small ellipse [ℓ]: a margin of 1e-6 leaves it within seconds


pytestmark = pytest.mark.usefixtures("empty")


def strengths(zone):
    """Of a material whose bonds live in a circle of the radius `zone` [ℓ]."""
    return dict(
        tensileStrength=SIGMA,
        bondEllipseNormal=zone,
        bondEllipseTangential=zone,
        bondCreationDistance=0.01,
        mu=MU,
        rolling=ROLLING,
    )


def pair(gap=0.0, angle=0.0, bonded=1, layers=(0, 0), **more):
    """A fixed disk and a free one at `angle`, bonded; returns the free one's id."""
    a, b = (material(layer=layer, **{**strengths(ZONE), **more}) for layer in layers)
    O.bodies.append(scene.disk((0, 0), RADIUS, a, fixed=True))
    distance = LENGTH + gap
    free = O.bodies.append(scene.disk((distance * math.cos(angle), distance * math.sin(angle)), RADIUS, b))
    begin(gravity=(0, 0, 0), dt=0.02, maxIterations=5000)
    run(1)
    assert engine().bond() == bonded
    return free


def load(free, normal=0.0, shear=0.0, torque=0.0, angle=0.0):
    """Forces on the free disk in the contact's frame: compression, shear at the contact point, torque about it."""
    c, s = math.cos(angle), math.sin(angle)
    O.forces.setPermF(free, (-normal * c - shear * s, -normal * s + shear * c, 0))
    O.forces.setPermT(free, (0, 0, -RADIUS * shear + torque))  # takes back the moment that the shear's lever makes


MODES = {
    "tension": (1, lambda x: dict(normal=-F_A * x)),
    "shear": (2, lambda x: dict(normal=PUSH, shear=MU * (F_A + PUSH) * x)),
    "torque": (3, lambda x: dict(normal=PUSH, torque=ROLLING * LENGTH * (F_A + PUSH) * x)),
    "torque without compression": (3, lambda x: dict(torque=-ROLLING * LENGTH * F_A * x)),
}


@pytest.mark.parametrize("angle", [0.0, 2.0])
@pytest.mark.parametrize("name", MODES)
def test_bond_breaks_just_above_its_threshold_and_records_how(name, angle):
    mode, forces = MODES[name]
    free = pair(angle=angle)
    load(free, angle=angle, **forces(1 + JUST))
    run(1)
    phys = contacts()[0].phys
    assert phys.bonded  # it yields first, and breaks when the ellipse is left
    moved = 0
    for _ in range(10000):
        moved = O.bodies[free].state.pos.norm() - LENGTH
        O.step()
        if engine().bonds == 0:
            break
    e = engine()
    counts = [e.brokenTension, e.brokenShear, e.brokenTorque, e.brokenMixed]
    assert counts == [int(k == mode - 1) for k in range(4)]
    assert not phys.bonded and phys.brokenMode == mode and phys.brokenStep > 0
    table = tables.breaks(engine())
    assert table["step"].tolist() == [phys.brokenStep] and table["mode"].tolist() == [mode]
    assert table["time"][0] == pytest.approx(phys.brokenStep * O.dt) and table["id1"][0] < table["id2"][0]
    where = contacts()[0].geom.contactPoint
    assert np.hypot(table["x"][0] - where[0], table["y"][0] - where[1]) < 0.1  # the pair has hardly moved since
    engine().forgetBreaks()
    assert len(tables.breaks(engine())["step"]) == 0
    # it lived as long as the marked point was inside: the path is the half-axis and one step's move
    if name == "tension":
        assert ZONE <= moved / LENGTH <= 1.05 * ZONE


@pytest.mark.parametrize("rolling", [0.0, 10.0])
def test_a_bond_breaks_in_shear_whatever_its_rolling_friction(rolling):
    free = pair(rolling=rolling)
    O.bodies[free].state.blockedDOFs = "zXYZ"  # so that it can yield in shear alone
    load(free, normal=PUSH, shear=1.001 * MU * (F_A + PUSH))
    for _ in range(10000):
        O.step()
        if engine().bonds == 0:
            break
    e = engine()
    assert (e.brokenTension, e.brokenShear, e.brokenTorque, e.brokenMixed) == (0, 1, 0, 0)


def test_reactions_at_the_threshold():
    free = pair()
    load(free, normal=PUSH, shear=0.5 * MU * (F_A + PUSH), torque=0.5 * ROLLING * (F_A + PUSH))
    run(2)
    phys = contacts()[0].phys
    # positive on the free disk, in the frame of the contact; the solver's tolerance is 1e-12
    assert phys.normal == pytest.approx(PUSH, rel=1e-9)
    assert phys.tangential == pytest.approx(-0.5 * MU * (F_A + PUSH), rel=1e-9)
    assert phys.torque == pytest.approx(-0.5 * ROLLING * (F_A + PUSH), rel=1e-9)
    assert phys.normalForce.norm() == pytest.approx(PUSH, rel=1e-9)
    assert phys.shearForce.norm() == pytest.approx(0.5 * MU * (F_A + PUSH), rel=1e-9)
    assert phys.tensileForce == F_A and phys.length == LENGTH


def test_debonded_contact_slides_with_residual_friction_at_once():
    free = pair(residualFrictionAngle=math.atan(0.2), residualTensileStrength=0.25 * SIGMA)
    shear = 1.01 * MU * (F_A + PUSH)
    load(free, normal=PUSH, shear=shear)
    while engine().bonds:
        run(1)
        assert O.iter < 1000
    phys = contacts()[0].phys
    # the normal turns by about the ellipse's half-axis, which shifts N by shear times 1e-4
    expected = 0.2 * (0.25 * F_A + phys.normal)
    assert abs(phys.tangential) == pytest.approx(expected, rel=1e-9)
    assert phys.normal == pytest.approx(PUSH, rel=1e-3)


def test_bond_acts_across_an_open_gap():
    gap = 0.008 * LENGTH  # below Δ = 0.01 ℓ
    free = pair(gap=gap)
    s = O.bodies[free].state
    for normal in (-0.999 * F_A, 0.5 * F_A, 30 * F_A, -0.999 * F_A):
        load(free, normal=normal)
        run(30)
        assert s.pos[0] == pytest.approx(LENGTH + gap, abs=1e-12)
        assert contacts()[0].phys.normal == pytest.approx(normal, rel=1e-8)
    load(free, shear=(1 - JUST) * MU * F_A)
    O.forces.setPermT(free, (0, 0, -(RADIUS + gap / 2) * MU * F_A * (1 - JUST)))
    run(30)
    assert s.vel.norm() < 1e-9


def test_bond_opened_in_tension_keeps_its_new_length():
    free = pair(bondEllipseNormal=0.02)
    s = O.bodies[free].state
    load(free, normal=-1.05 * F_A)
    run(4)  # 2.5 m/s² for 0.08 s: opens by 0.01
    load(free, normal=0)
    run(60)
    opened = s.pos[0]
    assert LENGTH * (1 + 1e-4) < opened < LENGTH * 1.02 and engine().bonds == 1
    load(free, normal=5 * F_A)
    run(60)
    assert s.pos[0] == pytest.approx(opened, abs=1e-9)


def moved(normal=0.0, tangential=0.0, turned=(0.0, 0.0)):
    """Whether a bond with half-axes of 0.02 and 0.01 ℓ holds after its second disk was moved [ℓ], and both were turned
    [rad].
    """
    free = pair(bondEllipseNormal=0.02, bondEllipseTangential=0.01)
    O.bodies[free].state.blockedDOFs = "xyzXYZ"
    O.bodies[free].state.pos = (LENGTH * (1 + normal), LENGTH * tangential, 0)
    for k, angle in zip((0, free), turned):
        O.bodies[k].state.ori = Quaternion((0, 0, 1), angle)
    run(1)
    return contacts()[0].phys.bonded


@pytest.mark.parametrize("normal, tangential", [(1, 0), (0, 1), (0, -1), (0.8, 0.6), (0.6, -0.8)])
def test_a_bond_holds_inside_its_ellipse(normal, tangential):
    # the frame follows the disks, by angles of a hundredth: 1 % of the path along the other axis, which is as long
    # again at most
    assert moved(0.97 * 0.02 * normal, 0.97 * 0.01 * tangential)
    O.reset()
    assert not moved(1.03 * 0.02 * normal, 1.03 * 0.01 * tangential)


@pytest.mark.parametrize("turned", [(1, 0), (0, 1), (-0.5, 0.5), (0.5, 0.5), (3, -3)])
def test_a_bond_is_marked_where_the_disks_touch(turned):
    """Disks that turn by θ₁ and θ₂ move the two points apart by R (θ₁ + θ₂); those that roll on each other not at
    all.
    """
    share = abs(sum(turned))
    for path in (0.97, 1.03):  # of the half-axis; R = ℓ/2
        assert moved(turned=[path * 0.02 * t for t in turned]) == (path * share < 1)
        O.reset()


@pytest.mark.parametrize("gap, bonded", [(0.0099, 1), (0.0101, 0)])
def test_bonds_are_made_below_the_creation_distance(gap, bonded):
    pair(gap=gap * LENGTH, bonded=bonded)


def test_bonds_are_made_within_a_layer_only():
    pair(bonded=0, layers=(0, 1))
    O.reset()
    pair(bonded=1, layers=(3, 3))
    assert engine().bond() == 0  # it has one
    O.reset()
    pair(bonded=1, layers=(0, 1), bondsToAll=True)


@pytest.mark.parametrize("layers, share", [((0, 1), 0), ((3, 3), 1), ((-1, -1), 1)])
def test_residual_adhesion_acts_within_a_layer_and_not_between_two(layers, share):
    pair(bonded=int(layers == (3, 3)), layers=layers, residualTensileStrength=0.25 * SIGMA)
    assert contacts()[0].phys.residualTensileForce == share * 0.25 * F_A


def test_residual_adhesion_on_a_wall_is_the_walls():
    O.bodies.append(scene.segments([(-5, 0), (5, 0)], material(wall=True, layer=7, residualTensileStrength=3e4)))
    O.bodies.append(scene.disk((0, RADIUS), RADIUS, material(layer=0, residualTensileStrength=1e4)))
    begin()
    run(1)
    assert contacts()[0].phys.residualTensileForce == LENGTH * 3e4


def test_unbond_counts_nothing_as_broken():
    pair()
    run(1)
    assert engine().bonds == 1 and engine().unbond() == 1 and engine().unbond() == 0
    run(1)
    e = engine()
    assert e.bonds == 0 and e.brokenTension + e.brokenShear + e.brokenTorque + e.brokenMixed == 0
    assert contacts()[0].phys.brokenMode == 0


def test_weaker_of_two_disks_and_the_wall_alone():
    strong, weak = material(0.5, tensileStrength=4e4), material(0.3, tensileStrength=3e4)
    wall = material(0.7, tensileStrength=0, wall=True)
    O.bodies.append(scene.segments([(-5, 0), (5, 0)], wall))
    O.bodies.append(scene.disk((0, 0.5), 0.5, strong))
    O.bodies.append(scene.disk((1, 0.5), 0.5, weak))
    begin()
    run(1)
    by_pair = {(i.id1, i.id2): i.phys for i in contacts()}
    assert by_pair[1, 2].friction == pytest.approx(0.3, rel=1e-12) and by_pair[1, 2].tensileForce == 3e4
    assert by_pair[0, 1].friction == pytest.approx(0.7, rel=1e-12) and by_pair[0, 1].tensileForce == 0
    strong.frictionAngle = weak.frictionAngle = math.atan(0.1)
    engine().updateStrengths()
    assert by_pair[1, 2].friction == pytest.approx(0.1, rel=1e-12)


@pytest.mark.parametrize("opening, sliding, mode", [(0.65, 0.35, 1), (0.55, 0.45, 4), (0.45, 0.55, 4), (0.35, 0.65, 2)])
def test_a_break_is_named_by_what_makes_more_than_60_per_cent_of_the_path(opening, sliding, mode):
    free = pair(rolling=0.0, tensileStrength=1.0, bondEllipseNormal=0.02, bondEllipseTangential=0.02)
    O.bodies[free].state.vel, O.bodies[free].state.blockedDOFs = (opening, sliding, 0), "zXYZ"
    O.dt = 1e-3
    run(1)
    while engine().bonds:  # one newton does not slow it down
        run(1)
        assert O.iter < 100
    assert contacts()[0].phys.brokenMode == mode


@pytest.mark.parametrize("first, second", [(1, 2), (2, 1)])
def test_a_bond_that_is_made_again_is_named_by_its_own_path(first, second):
    """Broken in tension (1) and bonded again, a pair that is sheared off broke in shear (2), and the other way round:
    what the first bond had yielded is not the second one's.
    """
    free = pair(rolling=0.0, tensileStrength=1.0, bondEllipseNormal=0.02, bondEllipseTangential=0.02)
    s, e = O.bodies[free].state, engine()
    s.blockedDOFs, O.dt = "zXYZ", 1e-3
    for mode in (first, second):
        if not e.bonds:
            s.pos, s.vel = (LENGTH, 0, 0), (0, 0, 0)
            run(1)
            assert e.bond() == 1
        s.vel, begun = ((0.5, 0, 0) if mode == 1 else (0, 0.5, 0)), O.iter
        while e.bonds:  # one newton does not slow it down
            run(1)
            assert O.iter < begun + 100
        assert contacts()[0].phys.brokenMode == mode
    assert (e.brokenTension, e.brokenShear, e.brokenTorque, e.brokenMixed) == (1, 1, 0, 0)
    assert tables.breaks(e)["mode"].tolist() == [first, second]


def test_walls_bond_only_where_they_say_so():
    for to_all, bonds in ((False, 0), (True, 1)):
        O.reset()
        # of one layer
        disk, wall = material(tensileStrength=SIGMA), material(tensileStrength=SIGMA, wall=True, bondsToAll=to_all)
        O.bodies.append(scene.segments([(-5, 0), (5, 0)], wall))
        O.bodies.append(scene.disk((0, 0.5), 0.5, disk))
        begin(gravity=(0, 0, 0))
        run(1)
        assert engine().bond() == bonds
