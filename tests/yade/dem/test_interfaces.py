"""Interfaces: disks of two layers whose contacts have a law of their own, bonded, weak or weakening with slip."""
import math

import pytest
from contact_scenes import G, begin, contacts, material, spoilt
from yade import O
from yade.nonsmooth import scene
from yade.nonsmooth.world.stepping import advance
from yade.wrapper import NscdMat, SlipWeakeningMat

pytestmark = pytest.mark.usefixtures("empty")

BASE, BLOCK = 1000.0, 0.5  # radii [m]: the base is flat to a part in a thousand over what a block slides here
LENGTH = BASE + BLOCK  # ℓ
WEIGHT = 2500 * math.pi * BLOCK**2 * G
# of the rock on both sides, which must not count
STRONG = dict(mu=1.5, tensileStrength=1e3, residualTensileStrength=1e3)


def block(law, swapped=False, both=False):
    """A block that cannot turn on a base that cannot move, of two layers with the law between them; returns its
    State.
    """
    base, rock = material(**STRONG, layer=0), material(**STRONG, layer=1)
    for one, other in ((base, rock), (rock, base)) if both else (((rock, base),) if swapped else ((base, rock),)):
        one.interfaceLayers, one.interfaceLaws = [other.layer], [law]
    O.bodies.append(scene.disk((0, -BASE), BASE, base, fixed=True))
    body = scene.disk((0, BLOCK), BLOCK, rock)
    body.state.blockedDOFs = "zXYZ"
    O.bodies.append(body)
    return body.state


def slid(state, tangent, seconds=1.0):
    """How far [m] the block goes where gravity has this slope."""
    angle, start = math.atan(tangent), state.pos[0]
    O.engines[-1].gravity = (G * math.sin(angle), -G * math.cos(angle), 0)
    advance(int(seconds / O.dt))
    return state.pos[0] - start


def onset(friction, adhesion=0.0):
    """tan θ at which W sin θ = μ (W cos θ + F_a), with F_a in units of the block's weight."""

    def sine(t):
        return t / math.sqrt(1 + t * t)

    low, high = 0.0, 50.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (
            (middle, high) if sine(middle) < friction * (1 / math.sqrt(1 + middle**2) + adhesion) else (low, middle)
        )
    return low


LAWS = {
    "weak": (lambda: NscdMat(frictionAngle=math.atan(0.2)), onset(0.2)),
    "bonded": (
        lambda: NscdMat(
            frictionAngle=math.atan(0.4),
            residualFrictionAngle=math.atan(0.1),
            tensileStrength=0.7 * WEIGHT / LENGTH,
            bondsToAll=True,
            bondEllipseNormal=1e-5,
            bondEllipseTangential=1e-5,
            bondCreationDistance=1e-3,
        ),
        onset(0.4, 0.7),
    ),
    "weakening": (
        lambda: SlipWeakeningMat(frictionAngle=math.atan(0.6), criticalSlip=0.05, weakenedFrictionAngle=math.atan(0.3)),
        onset(0.6),
    ),
}


@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize("name", LAWS)
def test_a_block_slides_at_the_angle_of_its_interfaces_law(name, swapped):
    """2 % below it stands, 2 % above it slides, in the angle's tangent; whichever of the two materials names the
    law.
    """
    law, tangent = LAWS[name]
    for factor, moves in ((0.98, False), (1.02, True)):
        O.reset()
        state = block(law(), swapped)
        solver = begin(dt=1e-3)
        advance()
        assert solver.bond() == (name == "bonded")
        way = slid(state, factor * tangent)
        assert way > 0.01 if moves else abs(way) < 1e-6, (factor, way)


def test_a_weakening_interface_loses_its_strength_by_the_slip_of_disks():
    law = LAWS["weakening"][0]()
    state = block(law, both=True)
    begin(dt=1e-3)
    advance()
    (contact,) = contacts()
    assert slid(state, 0.59) == pytest.approx(0, abs=1e-6) and contact.phys.currentFriction == pytest.approx(0.6)
    way = slid(state, 0.66, 0.6)  # a = g cos θ (0.66 - 0.6), so that D_c is passed after some 0.4 s
    assert way > 0.05 and contact.phys.currentFriction == pytest.approx(0.3)
    # both bodies have slipped what one went, although each is told of it by the one contact; the last step's is told
    # after it
    assert law.slippedCount() == 2 and law.weakenedCount() == 2 and law.meanSlip() == pytest.approx(way, rel=0.01)
    # and what holds it now is the rest: 2 % below it slows down, 2 % above it goes faster
    for factor, sign in ((0.98, -1), (1.02, 1)):
        before = state.vel[0]
        slid(state, factor * 0.3, 0.05)
        assert sign * (state.vel[0] - before) > 0
        felt = factor * 0.3 + state.pos[0] / BASE  # the base falls away
        assert state.vel[0] - before == pytest.approx(0.05 * G * (felt - 0.3) / math.sqrt(1 + felt**2), rel=0.02)


def test_a_contact_is_as_weak_as_its_weaker_disk():
    """Two blocks on one base: the first one's way has weakened the base, and so the second's contact, which has not
    slipped.
    """
    law = LAWS["weakening"][0]()
    first = block(law)
    second = scene.disk((3, BLOCK), BLOCK, O.bodies[1].material)
    second.state.blockedDOFs = "zXYZ"
    O.bodies.append(second)
    begin(dt=1e-3)
    advance()
    first.vel = (-1.0, 0, 0)  # away from it
    place = second.state.pos[0]
    advance(100)
    there = {i.id2: i.phys for i in contacts()}
    assert first.pos[0] < -0.05 and second.state.pos[0] == pytest.approx(place, abs=1e-4)
    assert there[1].currentFriction == pytest.approx(0.3) and there[2].currentFriction == pytest.approx(0.3)


def test_a_disk_with_several_contacts_slips_once_in_a_step():
    """A plank of three bonded disks that cannot turn: one that lies on two base disks slips as far as on one of them,
    not as on both.
    """
    # so that they touch
    law = SlipWeakeningMat(
        frictionAngle=math.atan(0.1),
        criticalSlip=1.0,
        weakenedFrictionAngle=math.atan(0.05),
        residualTensileStrength=1.0,
    )
    base, rock = material(1.0, layer=0, interfaceLayers=[1], interfaceLaws=[law]), material(1.0, layer=1)
    for x in (-0.6, 0.6):
        O.bodies.append(scene.disk((x, 0), 0.5, base, fixed=True))
    body = scene.disk((0, 0.8), 0.5, rock)
    body.state.blockedDOFs = "xyzXYZ"
    top = O.bodies.append(body)
    begin(gravity=(0, 0, 0))
    advance()
    assert len(contacts()) == 2
    # it turns on both, and sinks between them: with normals (±0.6, 0.8) it slides by 1 ∓ 0.06 m/s on them
    body.state.blockedDOFs, body.state.vel, body.state.angVel = "xyzXYZ", (0, -0.1, 0), (0, 0, -2.0)
    advance()
    # the farther of both is its own
    assert law.slippedCount() == 3 and 3 * law.meanSlip() == pytest.approx((0.94 + 1.06 + 1.06) * O.dt, rel=1e-9)
    told = [i.phys for i in contacts()]
    assert {p.body for p in told} == {0, 1} and {p.other for p in told} == {top}


def test_layers_without_an_interface_are_as_before():
    base, rock = material(0.5, layer=0, interfaceLayers=[7], interfaceLaws=[NscdMat(frictionAngle=0.1)]), material(
        0.3, layer=1, residualTensileStrength=10.0
    )
    O.bodies.append([scene.disk((0, 0), 0.5, base, fixed=True), scene.disk((0, 1), 0.5, rock)])
    begin()
    advance()
    (contact,) = contacts()
    assert (
        contact.phys.friction == pytest.approx(0.3)
        and contact.phys.residualTensileForce == 0
        and not contact.phys.bondable
    )


def test_saved_and_loaded_an_interface_goes_on(tmp_path):
    law = LAWS["weakening"][0]()
    state = block(law)
    begin(dt=1e-3)
    advance()
    slid(state, 0.66, 0.3)
    O.save(str(tmp_path / "s.yade.gz"))
    advance(200)
    there = O.bodies[1].state.pos[0], O.bodies[0].material.interfaceLaws[0].meanSlip()
    O.load(str(tmp_path / "s.yade.gz"))
    advance(200)
    assert (O.bodies[1].state.pos[0], O.bodies[0].material.interfaceLaws[0].meanSlip()) == there and there[1] > 0.05


@pytest.mark.parametrize(
    "laws, message",
    [
        ([], "that of interfaceLayers"),
        ([spoilt(NscdMat(), frictionAngle=2.0)], "frictionAngle"),
        ([spoilt(SlipWeakeningMat(), restitution=2.0)], "restitution"),
    ],
)
def test_an_interface_that_is_none_is_refused(laws, message):
    base, rock = material(0.5, layer=0, interfaceLayers=[1], interfaceLaws=laws), material(0.3, layer=1)
    O.bodies.append([scene.disk((0, 0), 0.5, base, fixed=True), scene.disk((0, 1), 0.5, rock)])
    begin()
    with pytest.raises(Exception, match=message):
        advance()
