"""What scripts write into attributes of YADE's own classes of contacts: heard by the next step, or refused in words
that name it.
"""
import math

import pytest
from yade import O, utils
from yade.nonsmooth import scene
from yade.wrapper import (
    InsertionSortCollider,
    InteractionLoop,
    NewtonIntegrator,
    NscdMat,
    PlanarGridCollider,
    PlanarNewtonIntegrator,
    PyRunner,
    SlipWeakeningMat,
)

from contact_scenes import G, begin, contacts, engine, floor, free_disk, material, refused, run

pytestmark = pytest.mark.usefixtures("empty")

WAYS = ("arrays", "advance", "YADE's loop")


def slider(tilt, angle, way="arrays", stuff=None, **options):
    """A disk that may not turn on a slope of `tilt` [rad], at rest under friction; returns its id."""
    stuff = stuff or NscdMat(density=2500, frictionAngle=angle)
    O.materials.append(stuff)
    c, s = math.cos(tilt), math.sin(tilt)
    O.bodies.append(scene.segments([(-20 * c, 20 * s), (60 * c, -60 * s)], stuff, sense=1))
    disk = O.bodies.append(scene.disk((0.5 * s, 0.5 * c), 0.5, stuff))
    O.bodies[disk].state.blockedDOFs = "zXYZ"
    begin(dt=5e-3, **options)
    if way == "YADE's loop":
        plain()
    return disk


def plain():
    """YADE's own collider, loop and integrator in the place of ours."""
    swap = {
        PlanarGridCollider: lambda e: InsertionSortCollider(e.boundDispatcher.functors, verletDist=0.1),
        InteractionLoop: lambda e: InteractionLoop(
            e.geomDispatcher.functors, e.physDispatcher.functors, e.lawDispatcher.functors
        ),
        PlanarNewtonIntegrator: lambda e: NewtonIntegrator(damping=0, gravity=e.gravity),
    }
    O.engines = [next((make(e) for kind, make in swap.items() if isinstance(e, kind)), e) for e in O.engines]


def go(steps, way):
    if way == "advance":
        engine().advance(steps)
    else:
        run(steps)


def speed_after(time, tilt, mu):
    return G * (math.sin(tilt) - mu * math.cos(tilt)) * time


# ---- friction -------------------------------------------------------------------------------------


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("tilt, mu", [(math.radians(25), 0.1), (math.radians(40), 0.35)])
def test_set_contact_friction_counts_from_the_next_step_on(way, tilt, mu):
    disk = slider(tilt, tilt + 0.1, way)
    go(100, way)
    assert O.bodies[disk].state.vel.norm() < 1e-9  # m/s; it holds
    utils.setContactFriction(math.atan(mu))
    go(200, way)
    # the scheme is exact for a constant force
    assert O.bodies[disk].state.vel.norm() == pytest.approx(speed_after(1, tilt, mu), rel=1e-9)
    phys = O.interactions[0, disk].phys
    assert [phys.tangensOfFrictionAngle, phys.friction, phys.residualFriction, phys.currentFriction] == pytest.approx(
        [mu] * 4, rel=1e-12
    )


@pytest.mark.parametrize("way", WAYS)
def test_friction_that_is_written_to_one_contact_stays(way):
    disk = slider(0.4, 0.5, way)
    go(50, way)
    O.interactions[0, disk].phys.tangensOfFrictionAngle = 0.25
    go(100, way)
    assert O.bodies[disk].state.vel.norm() == pytest.approx(speed_after(0.5, 0.4, 0.25), rel=1e-9)
    assert O.interactions[0, disk].phys.tangensOfFrictionAngle == 0.25
    engine().updateStrengths()  # the materials' again
    go(1, way)
    assert O.interactions[0, disk].phys.tangensOfFrictionAngle == pytest.approx(math.tan(0.5), rel=1e-12)


def of_disks():
    return [i for i in contacts() if max(i.id1, i.id2) < 4]


def rows_of_disks(way):
    """Four disks in a row on a floor, which is body 4."""
    stuff = material(0.5)
    ids = [free_disk(x, 0.5, stuff=stuff) for x in range(4)]
    floor(stuff)
    begin(dt=1e-3)
    if way == "YADE's loop":
        plain()
    return ids


@pytest.mark.parametrize("way", WAYS)
def test_contacts_of_disks_hear_it_too(way):
    rows_of_disks(way)
    go(3, way)
    pairs = of_disks()
    assert len(pairs) == 3
    utils.setContactFriction(math.atan(0.2))
    go(2, way)
    assert [i.phys.friction for i in of_disks()] == pytest.approx([0.2] * 3, rel=1e-12)
    contacts_ = [i.phys.tangensOfFrictionAngle for i in contacts()]
    assert contacts_ == pytest.approx([0.2] * len(contacts_), rel=1e-12)


def test_a_bond_hears_it_and_its_residual_does_too():
    stuff = material(0.5, tensileStrength=1e6, residualFrictionAngle=0.3)
    for x in range(2):
        free_disk(x, 0, stuff=stuff)
    begin(gravity=(0, 0, 0))
    run(1)
    assert engine().bond() == 1
    run(1)
    contacts()[0].phys.tangensOfFrictionAngle = 0.1
    run(1)
    phys = contacts()[0].phys
    assert (phys.bonded, phys.currentFriction, phys.residualFriction) == (True, 0.1, 0.1)
    engine().unbond()
    run(1)
    assert contacts()[0].phys.currentFriction == 0.1


def test_a_runner_in_the_list_is_heard():
    disk = slider(math.radians(25), math.radians(35))
    O.engines = O.engines + [PyRunner(command="utils.setContactFriction(0.1)", firstIterRun=50, iterPeriod=1000, nDo=1)]
    engine().advance(150)
    # of the 150 steps 50 or 49 hold, by the numbering of steps
    least, most = (speed_after(n * 5e-3, math.radians(25), math.tan(0.1)) for n in (99, 100))
    assert least * (1 - 1e-9) <= O.bodies[disk].state.vel.norm() <= most * (1 + 1e-9)


@pytest.mark.parametrize("written", ["before", "after"])
def test_it_survives_save_and_load(tmp_path, written):
    disk = slider(0.4, 0.5)
    run(20)
    if written == "before":
        O.interactions[0, disk].phys.tangensOfFrictionAngle = 0.25
    O.save(str(tmp_path / "scene.yade.gz"))
    O.load(str(tmp_path / "scene.yade.gz"))
    assert O.interactions[0, disk].phys.currentFriction == pytest.approx(math.tan(0.5), rel=1e-12)
    if written == "after":
        O.interactions[0, disk].phys.tangensOfFrictionAngle = 0.25
    run(20)
    assert O.interactions[0, disk].phys.tangensOfFrictionAngle == 0.25


def test_nothing_is_heard_where_nothing_was_written(tmp_path):
    disk = slider(0.4, 0.5)
    run(20)
    O.save(str(tmp_path / "scene.yade.gz"))
    O.load(str(tmp_path / "scene.yade.gz"))
    run(1)
    phys = O.interactions[0, disk].phys
    assert phys.friction == phys.residualFriction == phys.currentFriction == math.tan(0.5)


def test_a_wall_that_weakens_goes_on_from_it_and_refuses_what_slip_has_taken():
    wall = SlipWeakeningMat(
        density=2500, frictionAngle=0.45, weakening="linear", criticalSlip=2.0, weakenedFrictionAngle=0.05
    )
    disk = slider(0.5, 0.45, stuff=wall)
    run(20)
    O.interactions[0, disk].phys.tangensOfFrictionAngle = 0.3
    run(1)
    left = 1 - wall.slipOf(disk) / 2
    weak = math.tan(0.05)
    assert 0.9 < left < 1 and O.interactions[0, disk].phys.currentFriction == pytest.approx(
        weak + (0.3 - weak) * left, rel=1e-2
    )
    run(400)
    assert wall.slipOf(disk) > 2
    O.interactions[0, disk].phys.tangensOfFrictionAngle = 0.02  # less than what is left
    run(1)
    assert O.interactions[0, disk].phys.currentFriction == 0.02
    O.interactions[0, disk].phys.tangensOfFrictionAngle = 0.3
    refused(f"interaction #0+#{disk}", "tangensOfFrictionAngle", "weakenedFrictionAngle", "updateStrengths()")
    engine().updateStrengths()
    run(1)


def test_a_peak_that_is_changed_alone_is_told_of(capfd):
    stuff = material(0.5, residualFrictionAngle=0.4, label="rock")
    free_disk(stuff=stuff)
    begin()
    run(2)
    assert "residualFrictionAngle" not in capfd.readouterr().err
    stuff.frictionAngle = 0.2
    run(3)
    told = capfd.readouterr().err
    assert told.count("residualFrictionAngle = 0.4") == 1 and "'rock'" in told and "-1" in told
    stuff.frictionAngle, stuff.residualFrictionAngle = 0.3, -1
    run(2)
    stuff.frictionAngle = 0.25
    run(2)
    assert "residualFrictionAngle" not in capfd.readouterr().err


# ---- what rigid contacts cannot hear ---------------------------------------------------------------


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize(
    "name, value, words",
    [
        ("kn", 1e6, ("phys.kn = 1000000", "no stiffness", "leave kn and ks 0")),
        ("ks", 1.0, ("phys.ks = 1", "no stiffness")),
        ("normalForce", (0, 5e3, 0), ("phys.normalForce = (0, 5000, 0)", "O.forces.setPermF")),
        ("shearForce", (1.0, 0, 0), ("phys.shearForce = (1, 0, 0)", "O.forces.setPermF")),
        ("tangensOfFrictionAngle", math.nan, ("friction nan", "finite")),
    ],
)
def test_what_a_rigid_contact_cannot_hear(way, name, value, words):
    disk = slider(0.4, 0.5, way)
    go(20, way)
    setattr(O.interactions[0, disk].phys, name, value)
    with pytest.raises(RuntimeError) as error:
        go(1, way)
    assert f"interaction #0+#{disk}" in str(error.value), str(error.value)
    for word in words:
        assert word in str(error.value), str(error.value)


@pytest.mark.parametrize("name", ["kn", "normalForce"])
def test_contacts_of_disks_refuse_it_too(name):
    rows_of_disks("arrays")
    run(3)
    setattr(of_disks()[0].phys, name, 1.0 if name == "kn" else (1, 0, 0))
    refused("interaction #", name)


def test_forces_that_are_set_to_zero_are_no_start_and_change_nothing_else():
    disk = slider(0.4, 0.5)
    run(20)
    phys = O.interactions[0, disk].phys
    held = phys.normalForce.norm()
    assert held == pytest.approx(O.bodies[disk].state.mass * G * math.cos(0.4), rel=1e-9)
    phys.normalForce = phys.shearForce = (0, 0, 0)
    run(1)
    assert O.interactions[0, disk].phys.normalForce.norm() == pytest.approx(held, rel=1e-9)


def test_growing_multiplies_stiffnesses_of_nothing():
    slider(0.4, 0.5)
    run(2)
    utils.growParticles(1.0)
    run(2)
