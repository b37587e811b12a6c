"""Disks whose radius somebody changes: mass, inertia and contacts follow, whoever did it, and what does not follow is
told of.
"""
import math

import pytest
from yade import O, utils
from yade.nonsmooth import scene
from yade.wrapper import PyRunner

from contact_scenes import G, begin, contacts, engine, floor, free_disk, material, refused, run

pytestmark = pytest.mark.usefixtures("empty")


def is_disk(body, density=2500):
    r, s = body.shape.radius, body.state
    assert s.mass == pytest.approx(density * math.pi * r * r, rel=1e-12)
    assert tuple(s.inertia) == pytest.approx((0.5 * s.mass * r * r,) * 3, rel=1e-12)


def grow(disk, ratio):
    O.bodies[disk].shape.radius *= ratio


WAYS = {
    "growParticles": lambda disk, ratio: utils.growParticles(ratio),
    "growParticles without mass": lambda disk, ratio: utils.growParticles(ratio, updateMass=False),
    "growParticle": lambda disk, ratio: utils.growParticle(disk, ratio),
    "shape.radius": grow,
}


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("ratio", [2.0, 1.01, 0.3])
@pytest.mark.parametrize("radius", [0.5, 1e-5])
def test_a_disk_stays_a_disk(way, ratio, radius, capfd):
    stuff = material(0.3)
    disk = O.bodies.append(scene.disk((0, 0), radius, stuff))
    fixed = O.bodies.append(scene.disk((10, 0), radius, stuff, fixed=True))
    begin()
    run(2)
    WAYS[way](disk, ratio)
    run(1)
    is_disk(O.bodies[disk])
    is_disk(O.bodies[fixed])
    assert O.bodies[disk].shape.radius == pytest.approx(ratio * radius, rel=1e-12)
    told = capfd.readouterr().err
    assert f"the radius of body #{disk} was changed" in told and "its mass follows its area" in told
    run(5)
    assert "radius" not in capfd.readouterr().err
    # it falls as ever
    assert O.bodies[disk].state.vel[1] == pytest.approx(-8 * G * O.dt, rel=1e-12)


@pytest.mark.parametrize("radius", [0.5, 0.4])
@pytest.mark.parametrize("beside", [False, True])
@pytest.mark.parametrize("wrong", [math.inf, 1e200, math.nan, 0.0, -1.0])
def test_a_radius_without_sense_that_is_mended(wrong, beside, radius):
    """Mass, inertia and contacts follow from the last size that it had."""
    stuff = material(0.5)
    floor(stuff)
    disk = O.bodies.append(scene.disk((0, 0.5), 0.5, stuff))
    if beside:
        O.bodies.append(scene.disk((1, 0.5), 0.5, stuff))
    begin()
    run(10)
    O.bodies[disk].shape.radius = wrong
    for _ in range(2):
        refused(f"body #{disk} is a Sphere of radius", "give it a positive radius")
    O.bodies[disk].shape.radius = radius
    run(300)
    is_disk(O.bodies[disk])
    assert O.bodies[disk].state.pos[1] == pytest.approx(radius, abs=1e-3)  # it lies on the floor
    assert all(
        c.phys.length == pytest.approx(2 * radius if c.id1 == 0 and c.id2 == disk else 0.5 + radius)
        for c in contacts()
        if disk in (c.id1, c.id2)
    )


def test_it_grows_step_by_step_while_nobody_else_looks():
    stuff = material(0.3)
    disk = O.bodies.append(scene.disk((0, 0), 0.5, stuff))
    begin(gravity=(0, 0, 0))
    O.engines = O.engines + [PyRunner(command="utils.growParticles(1.01)", iterPeriod=10, initRun=False)]
    engine().advance(101)
    grown = 0.5 * 1.01**10
    assert O.bodies[disk].shape.radius == pytest.approx(grown, rel=1e-12)
    run(1)
    is_disk(O.bodies[disk])


def test_a_density_of_its_own_is_kept():
    """A disk with a mass that is not its material's: it follows in proportion."""
    disk = free_disk()
    s = O.bodies[disk].state
    s.mass, s.inertia = 10.0, (1.25, 1.25, 1.25)
    begin()
    run(1)
    grow(disk, 3)
    run(1)
    assert s.mass == pytest.approx(90, rel=1e-12) and s.inertia[2] == pytest.approx(0.5 * 90 * 1.5**2, rel=1e-12)


def test_a_sphere_stays_a_sphere():
    stuff = material(0.3)
    ids = [O.bodies.append(utils.sphere((x, 0, 0), 0.5, material=stuff)) for x in (0, 5)]
    for i in ids:
        O.bodies[i].state.blockedDOFs = "zXY"
    begin()
    run(1)
    grow(ids[0], 2)
    run(1)
    utils.growParticle(ids[1], 2)
    run(1)
    for i in ids:
        s = O.bodies[i].state
        assert s.mass == pytest.approx(4 / 3 * math.pi * 2500, rel=1e-12)
        assert s.inertia[2] == pytest.approx(0.4 * s.mass, rel=1e-12)


def test_what_a_script_has_chosen_stays(capfd):
    disk, odd = free_disk(), free_disk(10, stuff=material(0.3))
    begin()
    run(1)
    s = O.bodies[disk].state
    grow(disk, 2)
    s.mass, s.inertia = 7.0, (3.5, 3.5, 3.5)
    run(1)
    assert s.mass == 7 and s.inertia[2] == 3.5 and "radius" not in capfd.readouterr().err
    grow(odd, 2)
    O.bodies[odd].state.mass = 7.0  # and the inertia of before
    run(1)
    told = capfd.readouterr().err
    assert O.bodies[odd].state.mass == 7 and f"body #{odd}" in told and "stay as they were set" in told
    O.bodies[odd].state.mass = 9.0  # a mass alone needs no word
    run(1)
    assert O.bodies[odd].state.mass == 9 and "radius" not in capfd.readouterr().err


def test_the_mass_may_be_set_after_the_next_step():
    disk = free_disk()
    begin()
    run(1)
    mass = O.bodies[disk].state.mass
    grow(disk, 2)
    run(1)
    O.bodies[disk].state.mass = mass
    run(3)
    assert O.bodies[disk].state.mass == mass


def test_it_is_saved_with_what_follows(tmp_path):
    disk = free_disk()
    begin()
    run(2)
    utils.growParticles(1.5)
    O.save(str(tmp_path / "scene.yade.gz"))
    is_disk(O.bodies[disk])
    O.load(str(tmp_path / "scene.yade.gz"))
    is_disk(O.bodies[disk])
    run(1)
    is_disk(O.bodies[disk])


@pytest.mark.parametrize("way", ["step", "advance"])
def test_contacts_follow_with_length_thresholds_and_bonds(way):
    stuff = material(0.3, 0.1, tensileStrength=1e5, residualTensileStrength=1e4, bondCreationDistance=0.01)
    ground = floor(material(0.3, 0.1, tensileStrength=1e5, bondsToAll=True, wall=True))
    ids = [O.bodies.append(scene.disk((x, 0.5), 0.5, stuff)) for x in (0, 1)]
    begin(gravity=(0, 0, 0), relaxationRate=0)
    run(1)
    assert engine().bond() == 3
    run(1)
    O.interactions[ids[0], ids[1]].phys.tensileForce *= 3  # of its own
    run(1)
    ratio = 1.004
    for i in ids:
        O.bodies[i].shape.radius *= ratio
    engine().advance(1) if way == "advance" else run(1)
    assert engine().bonds == 3  # the marks are on the rims: the overlap of 0.4 % is within the ellipse of 2 %
    pair, wall = O.interactions[ids[0], ids[1]].phys, O.interactions[ground, ids[0]].phys
    assert pair.length == wall.length == pytest.approx(ratio, rel=1e-12)
    assert (pair.tensileForce, pair.adhesion) == pytest.approx((3e5 * ratio,) * 2, rel=1e-12)
    assert (wall.tensileForce, wall.adhesion) == pytest.approx((1e5 * ratio,) * 2, rel=1e-12)
    assert pair.residualTensileForce == pytest.approx(1e4 * ratio, rel=1e-12)
    assert pair.currentRollingArm == pair.rollingArm == pytest.approx(0.1 * ratio, rel=1e-12)
    assert (pair.ellipseNormal, pair.creationDistance) == pytest.approx((0.02 * ratio, 0.01 * ratio), rel=1e-12)
    depths = sorted(i.geom.penetrationDepth for i in contacts())
    assert depths == pytest.approx([(ratio - 1) / 2] * 2 + [ratio - 1], abs=1e-12)


def test_bonds_live_while_disks_grow_slowly():
    """Three times the size of the bond's ellipse, in small steps in which the overlap is taken back."""
    stuff = material(0.3, tensileStrength=1e9, bondCreationDistance=0.01)
    ids = [O.bodies.append(scene.disk((x, 0), 0.5, stuff)) for x in (0, 1)]
    begin(gravity=(0, 0, 0), relaxationRate=1, correctionSpeed=10)
    run(1)
    assert engine().bond() == 1
    for _ in range(60):
        utils.growParticles(1.001)
        run(3)
    assert engine().bonds == 1
    distance = O.bodies[ids[1]].state.pos[0] - O.bodies[ids[0]].state.pos[0]
    assert distance == pytest.approx(1.001**60, abs=1.5e-3)  # the slack, and the last growth
    assert contacts()[0].phys.length == pytest.approx(1.001**60, rel=1e-12)
