"""Numbers that users can set and that nothing could be computed with: refused in the step, by name, or the first time
that they matter.
"""

import math

import pytest
from yade import O
from yade.minieigenHP import Quaternion
from yade.nonsmooth import scene
from yade.wrapper import (
    ContactDynamicsEngine,
    ForceResetter,
    Ig2_Arc_Sphere_ScGeom,
    Ig2_Segment_Sphere_ScGeom,
    PorePressureEngine,
    Sphere,
    WallForceEngine,
)

from contact_scenes import G, begin, contacts, engine, floor, free_disk, material, run, spoilt

pytestmark = pytest.mark.usefixtures("empty")
NAN, INF = math.nan, math.inf


def refused(words):
    with pytest.raises(RuntimeError, match=words):
        run(1)


# ---- walls ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("in_a_run", [False, True])
@pytest.mark.parametrize(
    "kind, name, value",
    [("segment", "halfLength", v) for v in (-1.0, 0.0, NAN, INF)]
    + [("arc", "radius", v) for v in (-1.0, 0.0, NAN, INF)]
    + [("arc", "halfAngle", v) for v in (-1.0, 0.0, NAN, 4.0)]
    + [(kind, "sense", v) for kind in ("segment", "arc") for v in (2, -2)],
)
def test_a_wall_that_no_disk_could_touch(kind, name, value, in_a_run):
    stuff = material(0.3)
    made = (
        scene.segments([(-2, 0), (2, 0)], stuff) if kind == "segment" else scene.arc((0, -2), 2, 0.1, 3, stuff, False)
    )
    (wall,) = O.bodies.append(made)
    free_disk(0, 0.5, stuff=stuff)
    begin()
    if in_a_run:
        run(3)
    spoilt(O.bodies[wall].shape, **{name: value})
    refused(f"body #{wall} is a wall with {name} = .*: give")


def test_a_wall_without_an_orientation():
    stuff = material(0.3)
    wall = floor(stuff)
    free_disk(0, 0.5, stuff=stuff)
    begin()
    O.bodies[wall].state.ori = Quaternion(NAN, NAN, NAN, NAN)
    refused(f"body #{wall} has an orientation that is not finite")


# ---- how far functors and the law look ------------------------------------------------------------


@pytest.mark.parametrize("value", [NAN, INF, -1.0])
@pytest.mark.parametrize("name", ["reach", "adhesionRange"])
def test_a_law_that_looks_nowhere(name, value):
    stuff = material(0.3)
    floor(stuff)
    free_disk(0, 0.5, stuff=stuff)
    begin()
    setattr(O.engines[2].lawDispatcher.functors[0], name, value)
    refused(rf"Law2_ScGeom_NscdPhys_SignoriniCoulomb\.{name} = .*: give 0 or more")


@pytest.mark.parametrize("value", [NAN, INF, 0.5, -1.0, 1.0, 1.2])
@pytest.mark.parametrize("which", [0, 1, 2])
def test_functors_that_look_for_less_than_contacts(which, value):
    stuff = material(0.3)
    floor(stuff)
    free_disk(0, 0.5, stuff=stuff)
    begin()
    functor = O.engines[2].geomDispatcher.functors[which]
    spoilt(functor, interactionDetectionFactor=value)
    if value >= 1 and math.isfinite(value):
        return run(2)
    refused(rf"{type(functor).__name__}\.interactionDetectionFactor = .*: give 1 or more")


@pytest.mark.parametrize("kind", [Ig2_Segment_Sphere_ScGeom, Ig2_Arc_Sphere_ScGeom])
def test_functors_of_walls_take_a_look_as_far_as_a_contact_and_no_less(kind):
    for value in (1.0, 1.5):
        assert kind(interactionDetectionFactor=value).interactionDetectionFactor == value
    for value in (1 - 1e-9, NAN, INF):
        with pytest.raises((RuntimeError, ValueError), match="interactionDetectionFactor"):
            kind(interactionDetectionFactor=value)


@pytest.mark.parametrize("value", [NAN, INF])
def test_boxes_without_an_end(value):
    stuff = material(0.3)
    floor(stuff)
    free_disk(0, 0.5, stuff=stuff)
    begin()
    run(1)
    O.engines[1].boundDispatcher.functors[0].aabbEnlargeFactor = value
    refused(r"Bo1_Sphere_Aabb\.aabbEnlargeFactor = .*: give a finite factor")


# ---- water ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["unitWeight", "volumeFactor", "thickness"])
@pytest.mark.parametrize("value", [NAN, INF, -INF])
def test_water_of_no_weight(name, value):
    free_disk()
    begin()
    water = PorePressureEngine(times=[0], heights=[5], **{name: value})
    O.engines = [O.engines[0], water, *O.engines[1:]]
    with pytest.raises(ValueError, match=f"{name} = .*: it must be 0 or more, and finite"):
        run(1)


@pytest.mark.parametrize("name", ["planePoint", "planeNormal", "pressureGradient"])
def test_water_of_no_place(name):
    free_disk()
    begin()
    water = PorePressureEngine(times=[0], heights=[5], **{name: (0, NAN, 0)})
    O.engines = [O.engines[0], water, *O.engines[1:]]
    with pytest.raises(ValueError, match=rf"{name}\[1\] = nan: give a finite number"):
        run(1)
    setattr(water, name, (0, 1, 0))
    run(1)
    water.planeNormal = (0, 0, 0)
    with pytest.raises(ValueError, match="planeNormal = .*: give the direction"):
        run(1)


@pytest.mark.parametrize("bad", [NAN, INF, -INF])
def test_a_table_of_water_has_numbers(bad):
    with pytest.raises(ValueError, match=r"heights\[1\] = .*: give a finite number"):
        PorePressureEngine(times=[0, 1], heights=[0, bad]).heightAt(0.5)
    with pytest.raises(ValueError, match=r"times\[0\] = .*: give a finite number"):
        PorePressureEngine(times=[bad, 1], heights=[0, 3]).heightAt(0.5)


def test_water_that_never_lets_go_needs_no_distance():
    free_disk()
    begin(gravity=(0, 0, 0))
    water = PorePressureEngine(times=[0], heights=[5], releaseDistance=INF)
    O.engines = [O.engines[0], water, *O.engines[1:]]
    run(1)
    assert water.wetCount == 1
    water.releaseDistance = NAN
    with pytest.raises(ValueError, match="releaseDistance = nan"):
        run(1)


# ---- what is gone, and what never comes -----------------------------------------------------------


def test_forces_of_a_wall_that_was_erased():
    stuff = material(0.3)
    wall = floor(stuff)
    free_disk(0, 0.5, stuff=stuff)
    begin()
    counted = WallForceEngine(ids=[wall], along=[(1, 0, 0)])
    O.engines = [*O.engines, counted]
    run(5)
    O.bodies.erase(wall)
    refused(f"id {wall}: there is no such body; take an erased one out of ids and along")
    counted.ids, counted.along = [], []
    run(1)


def test_a_time_that_never_comes():
    O.engines = [ForceResetter()]
    O.dt = 0
    free_disk()
    with pytest.raises(RuntimeError, match=r"after 1 steps O\.dt = 0, and until = 1 s never comes"):
        ContactDynamicsEngine.advance(until=1.0)
    assert ContactDynamicsEngine.advance(5, until=1.0) == 5


def test_a_bond_that_is_made_anew_has_not_broken():
    stuff = material(0.3, tensileStrength=100.0, bondCreationDistance=0.05)
    a, b = (free_disk(x, 0, stuff=stuff) for x in (0, 1))
    O.bodies[a].state.blockedDOFs = "xyzXYZ"
    begin(gravity=(0, 0, 0))
    run(1)
    assert engine().bond() == 1
    O.bodies[b].state.vel = (8, 0, 0)
    while engine().bonds:
        run(1)
    (broken,) = [i for i in contacts() if i.phys.brokenMode]
    assert broken.phys.brokenStep == O.iter - 1
    O.bodies[b].state.vel, O.bodies[b].state.pos = (0, 0, 0), (1, 0, 0)
    run(1)
    assert engine().bond() == 1
    run(1)
    phys = O.interactions[a, b].phys
    assert phys.bonded and (phys.brokenMode, phys.brokenStep) == (0, -1)


@pytest.mark.parametrize("gone", ["bodies", "shapes"])
def test_contacts_whose_bodies_are_gone(gone):
    stuff = material(0.3, tensileStrength=1e5)
    floor(stuff)
    for k in range(3):
        free_disk(k, 0.5, stuff=stuff)
    e = begin()
    run(2)
    if gone == "bodies":
        O.bodies.clear()
    else:
        for b in O.bodies:
            b.shape = None
    e.updateStrengths()
    assert e.bond() == 0


@pytest.mark.parametrize("blocked", ["zXY", "xzXY"])
def test_a_body_that_may_move_and_has_lost_its_shape(blocked):
    stuff = material(0.3)
    ground = floor(stuff)
    disk, other = free_disk(0, 0.5, stuff=stuff), free_disk(2, 0.5, stuff=stuff)
    begin()
    run(2)
    O.bodies[disk].shape = None
    O.bodies[disk].state.blockedDOFs = blocked
    refused(rf"body #{disk} may move and has no shape .*Sphere\(radius=...\).*bounded = False")
    O.bodies[disk].shape = Sphere(radius=0.5)
    run(20)
    assert abs(O.bodies[disk].state.vel[1]) < 1e-9
    O.bodies[ground].shape = O.bodies[disk].shape = None  # a wall may be taken away so
    O.bodies[disk].bounded = False
    run(3)
    assert O.bodies[other].state.vel[1] == pytest.approx(-3 * G * O.dt, rel=1e-9)


@pytest.mark.parametrize("fixed", [False, True])
@pytest.mark.parametrize("turn", [(5, 0, 0), (0, -2, 1)])
def test_rotation_out_of_the_plane_is_told_of(turn, fixed, capfd):
    stuff = material(0.3)
    floor(stuff)
    roller = O.bodies.append(scene.disk((0, 0.5), 0.5, stuff, fixed=fixed))
    begin()
    O.bodies[roller].state.angVel = turn
    run(12)
    told = [line for line in capfd.readouterr().err.splitlines() if "rotation about x or y drags nothing" in line]
    assert len(told) == 2  # the first and the tenth
    assert (
        f"body #{roller} has state.angVel = (%g, %g," % turn[:2] in told[0]
        and "set its first two numbers to 0" in told[0]
    )
    O.bodies[roller].state.angVel = (0, 0, 1)
    run(100)
    assert "drags nothing" not in capfd.readouterr().err


@pytest.mark.parametrize("where", ["orientation", "torque", "gravity"])
def test_a_body_with_no_number(where):
    disk = free_disk()
    begin()
    run(2)
    if where == "orientation":
        O.bodies[disk].state.ori = Quaternion(NAN, 0, 0, NAN)
    elif where == "torque":
        O.forces.setPermT(disk, (0, 0, NAN))
    else:
        O.engines[-1].gravity = (0, NAN, 0)
    refused(
        {
            "orientation": f"body #{disk} has an orientation that is not finite",
            "torque": f"body #{disk} has a torque that is not finite",
            "gravity": r"NewtonIntegrator\.gravity = .*: give finite components",
        }[where]
    )
