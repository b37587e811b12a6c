"""Contacts of two bodies whose motions are both given: what the law says of that motion acts, and YADE's LawTester
finds the law's thresholds.
"""
import math

import pytest
from yade import O
from yade.nonsmooth import scene
from yade.wrapper import LawTester, PyRunner, RotationEngine, StepDisplacer

from contact_scenes import begin, contacts, engine, floor, material, refused, run

pytestmark = pytest.mark.usefixtures("empty")

STRENGTH, MU, ROLLING = 1e5, 0.5, 0.125
RESIDUAL, RESIDUAL_MU, RESIDUAL_ROLLING = 2e4, 0.25, 0.0625


def rock(**more):
    values = dict(
        tensileStrength=STRENGTH,
        residualTensileStrength=RESIDUAL,
        residualFrictionAngle=math.atan(RESIDUAL_MU),
        residualRollingFriction=RESIDUAL_ROLLING,
    )
    return material(MU, ROLLING, **{**values, **more})


def pair(angle=0.0, radii=(0.5, 0.5), swapped=False, stuff=None):
    """Two bonded disks that are held, the second one in the direction ``angle`` of the first; returns ℓ."""
    stuff = stuff or rock()
    length = sum(radii)
    places = [(0, 0), (length * math.cos(angle), length * math.sin(angle))]
    for k in (1, 0) if swapped else (0, 1):
        O.bodies.append(scene.disk(places[k], radii[k], stuff, fixed=True))
    begin(gravity=(0, 0, 0))
    O.step()
    assert engine().bond() == 1
    return length


def give_path(steps=1000, after=(), roll=0.0, **path):
    """Gives the two disks their path; the LawTester stands before the solver. ``roll`` [rad]: LawTester's own rotPath
    is one of angular velocities.
    """
    if roll:
        path["rotPath"] = [(0, 0, roll / O.dt)]
    tester = LawTester(ids=[0, 1], pathSteps=[steps], **{**dict(idWeight=0.5), **path})
    others = list(O.engines)
    O.engines = others[:3] + [tester, *after] + others[3:]
    return tester


def borne():
    """N, |T| and |Γ| of the one contact, which are the forces on its bodies."""
    (contact,) = contacts()
    p, n = contact.phys, contact.geom.normal
    first, second = O.forces.f(contact.id1), O.forces.f(contact.id2)
    assert (first + second).norm() == 0
    assert second.dot(n) == pytest.approx(p.normal, rel=1e-12, abs=1e-9)
    # what is left of the torques once that of the shear force is taken off both; torque and levers go from the lower id
    # to the higher
    sign = 1 if contact.id1 < contact.id2 else -1
    r1, r2 = contact.geom.refR1, contact.geom.refR2
    rolling = sign * (r1 * O.forces.t(contact.id2)[2] - r2 * O.forces.t(contact.id1)[2]) / (r1 + r2)
    assert rolling == pytest.approx(p.torque, rel=1e-9, abs=1e-6)
    return p.normal, abs(p.tangential), abs(p.torque)


TURNS = [0.0, 1.0, 2.5, -0.7]


@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("radii", [(0.5, 0.5), (0.2, 0.6)])
@pytest.mark.parametrize("angle", TURNS)
def test_a_bond_that_is_pulled_bears_its_tensile_strength(angle, radii, swapped):
    length = pair(angle, radii, swapped)
    give_path(steps=300, disPath=[(0.03, 0, 0)])
    force, zone = STRENGTH * length, 0.02 * length
    for _ in range(19):
        run(10)
        assert borne() == pytest.approx((-force, 0, 0), rel=1e-12, abs=1e-9)
    run(30)
    assert borne() == (0, 0, 0) and engine().bonds == 0 and engine().brokenTension == 1
    # by the step in which it ends, which is a 200th of the zone
    assert engine().wallWork == pytest.approx(force * zone, rel=0.01)
    assert engine().debondingLoss == pytest.approx(engine().wallWork, rel=1e-9)
    assert abs(engine().energyError) < 1e-9 * force * zone


@pytest.mark.parametrize("weight", [1, 0], ids=["by turning", "by passing"])
@pytest.mark.parametrize("angle", TURNS)
def test_a_bond_that_is_sheared_bears_its_shear_threshold(angle, weight):
    length = pair(angle)
    give_path(steps=300, disPath=[(0, 0.03, 0)], rotWeight=weight)
    force, zone = MU * STRENGTH * length, 0.02 * length
    for _ in range(19):
        run(10)
        assert borne() == pytest.approx((0, force, 0), rel=1e-12, abs=1e-9)
    run(30)
    # a contact without a bond that touches has its residual strengths
    assert engine().bonds == 0 and engine().brokenShear == 1
    assert borne() == pytest.approx((0, RESIDUAL_MU * RESIDUAL * length, 0), rel=1e-12, abs=1e-9)
    lost = force * zone + RESIDUAL_MU * RESIDUAL * length * 0.1 * zone
    assert engine().wallWork == pytest.approx(
        lost, rel=0.02
    )  # the step of the end, and the curvature of a path of 0.02 ℓ
    assert engine().slidingLoss == pytest.approx(engine().wallWork, rel=1e-9)
    assert engine().drivenSteps == 0


@pytest.mark.parametrize("radii", [(0.5, 0.5), (0.2, 0.6)])
def test_a_bond_that_is_rolled_bears_its_torque_threshold(radii):
    length = pair(0.4, radii)
    give_path(steps=300, roll=0.15)
    torque = ROLLING * length * STRENGTH * length
    for _ in range(30):
        run(10)
        assert borne() == pytest.approx((0, 0, torque), rel=1e-12, abs=1e-9)
    assert engine().rollingLoss == pytest.approx(torque * 0.15, rel=1e-9)
    assert engine().wallWork == pytest.approx(engine().rollingLoss, rel=1e-9)


def test_what_opens_bears_neither_shear_nor_torque():
    pair()
    give_path(steps=300, disPath=[(0.01, 0.005, 0)], roll=0.01)
    run(100)
    assert borne() == pytest.approx((-STRENGTH, 0, 0), rel=1e-12, abs=1e-9)


@pytest.mark.parametrize("way, share", [({"disPath": [(0, 0.01, 0)]}, (MU, 0)), ({"roll": 0.1}, (0, ROLLING))])
@pytest.mark.parametrize("load", [0.5, 1, 3])
def test_a_load_along_the_normal_raises_the_thresholds(load, way, share):
    pair()
    give_path(steps=200, after=[PyRunner(command="O.bodies[1].state.blockedDOFs = 'yzXYZ'", iterPeriod=1)], **way)
    O.forces.setPermF(1, (-load * STRENGTH, 0, 0))
    run(100)
    (contact,) = contacts()
    p = contact.phys
    held = STRENGTH * (1 + load)
    assert (p.normal, abs(p.tangential), abs(p.torque)) == pytest.approx(
        (load * STRENGTH, share[0] * held, share[1] * held), rel=1e-9, abs=1e-6
    )


def test_what_stands_or_goes_together_bears_nothing():
    pair(0.3)
    give_path(steps=100, disPath=[(0, 0.005, 0)])
    run(100)
    assert borne()[1] > 0
    run(5)  # the path has come to its end
    assert borne() == (0, 0, 0)
    for k in (0, 1):
        O.bodies[k].state.vel = (3, -2, 0)
    run(5)
    assert borne() == (0, 0, 0) and engine().bonds == 1


@pytest.mark.parametrize("speed", [0.1, 10.0])
def test_a_driven_wheel_of_bonded_disks_bears_nothing_while_it_turns(speed):
    pair()
    O.engines = (
        O.engines[:3]
        + [
            RotationEngine(
                ids=[0, 1], rotationAxis=(0, 0, 1), angularVelocity=speed, rotateAroundZero=True, zeroPoint=(7, 3, 0)
            )
        ]
        + O.engines[3:]
    )
    for _ in range(100):
        O.step()
        assert borne() == (0, 0, 0)
    assert engine().bonds == 1 and engine().drivenSteps == 0


def test_a_disk_that_is_moved_by_its_place_is_answered_too():
    pair()
    O.engines = O.engines + [StepDisplacer(ids=[1], mov=(1e-4, 0, 0))]
    run(20)
    assert borne() == pytest.approx((-STRENGTH, 0, 0), rel=1e-12)


def test_a_bond_to_a_wall_bears_its_strength_too():
    stuff = rock(wall=True, bondsToAll=True)
    floor(stuff)
    O.bodies.append(scene.disk((0, 0.5), 0.5, rock(), fixed=True))
    begin(gravity=(0, 0, 0))
    O.step()
    assert engine().bond() == 1
    O.bodies[1].state.vel = (0, 0.1, 0)
    run(10)
    assert O.forces.f(0)[1] == pytest.approx(STRENGTH, rel=1e-12)
    O.bodies[1].state.vel = (0.1, 0, 0)
    run(10)
    assert O.forces.f(0)[0] == pytest.approx(MU * STRENGTH, rel=1e-12)


def test_bodies_that_are_driven_into_each_other_are_told_of(capfd):
    pair()
    O.bodies[1].state.vel = (-0.1, 0, 0)
    run(20)
    assert borne() == (0, 0, 0) and engine().drivenSteps == 20
    told = [line for line in capfd.readouterr().err.splitlines() if "driven into each other" in line]
    assert len(told) == 2  # the 1st and the 10th
    for words in ("#0 and #1", "0.1 m/s", "state.blockedDOFs", "O.forces.setPermF"):
        assert words in told[0]


def test_all_pairs_that_are_driven_into_each_other_are_counted(capfd):
    for x, speed in (
        (0, 0.1),
        (1, 0),
        (2, -0.3),
        (3, -0.3),
        (4, -0.1),
    ):  # the third pair goes as one, the last one parts
        O.bodies.append(scene.disk((x, 0), 0.5, rock(), fixed=True))
        O.bodies[-1].state.vel = (speed, 0, 0)
    begin(gravity=(0, 0, 0))
    run(1)
    told = capfd.readouterr().err
    assert (
        "2 pairs of bodies with blocked DOFs are driven into each other, the fastest bodies #1 and #2, by 0.3 m/s"
        in told
    )


@pytest.mark.parametrize("turns", [False, True])
def test_a_shear_along_a_straight_line_parts_the_pair(turns):
    """Its distance grows by s²/(2 ℓ), so that the bond bears tension in the end; not where the velocity turns with the
    normal.
    """
    length = pair()
    for _ in range(60):
        normal = (O.bodies[1].state.pos - O.bodies[0].state.pos).normalized() if turns else (1, 0)
        O.bodies[1].state.vel = (-0.1 * normal[1], 0.1 * normal[0], 0)
        run(1)
    force = STRENGTH * length
    assert borne() == pytest.approx((0, MU * force, 0) if turns else (-force, 0, 0), rel=1e-12, abs=1e-9)


@pytest.mark.parametrize(
    "path, words",
    [
        (dict(disPath=[(1e-3, 0, 0), (1e-3, 0, 2e-3)]), ("disPath[1] = (0.001, 0, 0.002)", "third number 0")),
        (dict(rotPath=[(0.1, 0, 0)]), ("rotPath[0] = (0.1, 0, 0)", "the third one rolls")),
        (dict(rotPath=[(0, 0.1, 0)]), ("rotPath[0] = (0, 0.1, 0)", "the third one rolls")),
    ],
)
def test_paths_that_leave_the_plane_are_refused(path, words):
    pair()
    give_path(label="tester", **path)
    refused("LawTester 'tester'", *words)
