"""State that outlives what it belongs to: bodies that are gone, ids that are used again, materials that were exchanged,
steps that were refused, files that were loaded in between. tests/README.md has the table of all members that live from
step to step."""
import contextlib
import gc
import math
import re
import time

import numpy as np
import pytest
import yade
from contact_scenes import begin, contacts, engine, floor, free_disk, loose_heap, material, run
from yade import O
from yade.minieigenHP import Quaternion, Vector3
from yade.nonsmooth import contact, scene, tables
from yade.wrapper import (
    Bo1_Segment_Aabb,
    Bo1_Sphere_Aabb,
    BondEllipseEngine,
    Collider,
    ContactDynamicsEngine,
    CourseRunner,
    ForceResetter,
    FrictMat,
    Ig2_Sphere_Sphere_ScGeom6D,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_CohFrictMat_CohFrictMat_CohFrictPhys,
    Law2_ScGeom6D_CohFrictPhys_CohesionMoment,
    CohFrictMat,
    NewtonIntegrator,
    NonsmoothTimeStepper,
    NscdMat,
    PlateLoadEngine,
    PorePressureEngine,
    PyRunner,
    Segment,
    SlipWeakeningMat,
    WallForceEngine,
)

pytestmark = pytest.mark.usefixtures("empty")
G = 9.81


def plain_engines():
    """YADE's own collider, loop and integrator in the place of ours."""
    own = {
        Collider: lambda e: InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.05), Bo1_Segment_Aabb()]),
        InteractionLoop: lambda e: InteractionLoop(
            e.geomDispatcher.functors, e.physDispatcher.functors, e.lawDispatcher.functors
        ),
        NewtonIntegrator: lambda e: NewtonIntegrator(damping=0, gravity=e.gravity),
    }
    O.engines = [next((make(e) for kind, make in own.items() if isinstance(e, kind)), e) for e in O.engines]


def either(way):
    if way == "plain":
        plain_engines()


WAYS = pytest.mark.parametrize("way", ["arrays", "plain"])


def from_now_on(name, value, monkeypatch):
    """A function for a PyRunner's command, which is run in __main__."""
    import __main__

    monkeypatch.setattr(__main__, name, value, raising=False)


def weak(slip=0.1, friction=0.2, left=0.0):
    return material(friction, kind=SlipWeakeningMat, weakenedFrictionAngle=math.atan(left), criticalSlip=slip)


def slider(stuff, speed=3.0, steps=150):
    """A disk that cannot turn slides along a floor of the first material; returns floor and disk."""
    wall, disk = floor(stuff), free_disk(0, 0.5, (speed, 0, 0), mu=0.0)
    O.bodies[disk].state.blockedDOFs = "zXYZ"
    begin()
    run(steps)
    return wall, disk


# ---- written to beside a run ----------------------------------------------------------------------


@pytest.mark.parametrize("paused", [False, True])
@pytest.mark.parametrize(
    "name, value", [("angVel", (0, 0, 1.0)), ("vel", (1.0, 0, 0)), ("ori", Quaternion((0, 0, 1), 0.3))]
)
def test_a_body_that_is_written_to_beside_a_run_goes_on(name, value, paused):
    """Two disks fly side by side, and one is written to: its way is the other's, to the last step."""
    one, other = (free_disk(0, y, (1.0, 0, 0)) for y in (0, 3))
    begin(gravity=(0, 0, 0), dt=1e-6)
    O.step()
    state, turns = O.bodies[one].state, 0
    O.run()
    if paused:
        time.sleep(0.1)
        O.pause()
        setattr(state, name, value)
    else:
        for turns in range(20):
            setattr(state, name, Vector3(1.0, 0, 1e-7 * turns) if name == "vel" else value)
            time.sleep(0.01)
        O.pause()
    while O._sceneObj.subStep >= 0:
        time.sleep(0.001)
    time.sleep(0.1)
    assert O.iter > 200
    assert state.pos[0] == pytest.approx(O.bodies[other].state.pos[0], rel=1e-9)  # rounding of sums of steps


def test_a_servo_that_sets_a_velocity_beside_a_run_moves_its_wall(capfd):
    wall = floor(material())
    O.bodies[wall].state.vel = (0, -1, 0)
    begin(gravity=(0, 0, 0), dt=1e-5)
    O.step()
    O.run()
    for k in range(10):
        time.sleep(0.05)
        O.bodies[wall].state.vel = (0, -1 - 1e-6 * k, 0)
    O.pause()
    time.sleep(0.2)
    engine().view()
    assert -O.bodies[wall].state.pos[1] == pytest.approx(O.time, rel=2e-5)  # of which the servo changes 1e-5
    assert "was moved by state.pos" not in capfd.readouterr().err


def saved_number(path, name):
    """What a contact has under a hidden name: the first number of that attribute in a saved scene."""
    return float(re.search(rf"<{name}[^>]*>\s*(?:<x>)?([-+.e\d]+)<", path.read_text()).group(1))


def test_a_contact_that_is_written_to_beside_a_run_keeps_what_its_bond_has_yielded(tmp_path):
    """A bond is drawn out step by step; a script writes into its physics, and what it has yielded since the last look
    is not lost.
    """
    stuff = material(
        0.4, tensileStrength=10.0, bondCreationDistance=0.1, bondEllipseNormal=0.5, bondEllipseTangential=0.5
    )
    one, other = (O.bodies.append(scene.disk((x, 0), 0.5, stuff, fixed=True)) for x in (0, 1.0))
    begin(gravity=(0, 0, 0), dt=1e-5)
    run(2)
    assert engine().bond() == 1
    O.bodies[other].state.blockedDOFs = "yzXYZ"
    O.bodies[other].state.vel = (0.1, 0, 0)
    O.bodies[other].state.mass = 1e6
    O.step()
    O.run()
    for k in range(20):
        time.sleep(0.01)
        O.interactions[one, other].phys.creationDistance = 1e-3 * k
    O.pause()
    time.sleep(0.1)
    O.step()
    path = O.bodies[other].state.pos[0] - 1.0
    assert O.interactions[one, other].phys.bonded and path > 1e-3
    O.save(str(tmp_path / "drawn.xml"))
    for name in ("yieldPath", "restGap"):  # all but the steps that begin and end it
        assert saved_number(tmp_path / "drawn.xml", name) == pytest.approx(path, abs=5e-6), name


@pytest.mark.parametrize(
    "what", ["updateStrengths", "bond", "unbond", "contactTable", "breakTable", "energies", "forgetBreaks"]
)
def test_whatever_is_asked_for_beside_a_run(what):
    stuff = material(0.4, tensileStrength=3e4, layer=0, bondCreationDistance=0.04)
    O.bodies.append(scene.segments([(-3, 20), (-3, 0), (12, 0), (12, 20)], stuff, piece=2))
    for i in loose_heap(stuff, columns=12, rows=12):
        O.bodies[i].state.vel = (math.sin(7 * i), math.cos(5 * i), 0)
    begin(tolerance=1e-4, maxIterations=200)
    run(2)
    O.run()
    end, asked = time.time() + 0.7, 0
    while time.time() < end:
        getattr(engine(), what)()
        asked += 1
    O.pause()
    time.sleep(0.1)
    O.step()
    assert asked > 3 and O.iter > 20


# ---- exchanged materials --------------------------------------------------------------------------


@pytest.mark.parametrize(
    "first, second, friction",
    [
        (lambda: weak(0.1, 0.2), lambda: material(0.5, wall=True), 0.5),
        (lambda: material(0.5, wall=True), lambda: weak(0.01, 0.2), 0.0),  # it weakens while it slides on
        (lambda: weak(0.1, 0.2), lambda: weak(1e9, 0.2), 0.2),
        (lambda: weak(1e9, 0.2), lambda: weak(0.01, 0.3, 0.1), 0.1),
    ],
    ids=["weak to plain", "plain to weak", "weakened to strong", "strong to weak"],
)
@WAYS
def test_a_wall_takes_the_law_of_its_new_material(first, second, friction, way):
    wall, disk = slider(first())
    either(way)
    O.step()
    O.bodies[wall].material = new = second()
    engine().updateStrengths()
    run(20)
    speed = O.bodies[disk].state.vel[0]
    run(20)
    assert speed - O.bodies[disk].state.vel[0] == pytest.approx(friction * G * 0.02, abs=1e-9)  # Coulomb, to rounding
    phys = O.interactions[wall, disk].phys
    assert type(phys).__name__ == ("SlipWeakeningPhys" if isinstance(new, SlipWeakeningMat) else "NscdPhys")
    assert phys.currentFriction == pytest.approx(friction, abs=1e-15)
    if isinstance(new, SlipWeakeningMat):
        assert 0 < new.slipOf(disk) < 0.2 and phys.wallMaterial is not None


def test_a_bond_survives_that_its_wall_weakens_now():
    stuff = material(0.4, tensileStrength=1e6, bondCreationDistance=0.1, bondsToAll=True, wall=True)
    wall, disk = floor(stuff), free_disk(0, 0.5)
    begin()
    run(2)
    assert engine().bond() == 1
    run(2)
    before = {k: repr(v) for k, v in O.interactions[wall, disk].phys.dict().items()}
    O.bodies[wall].material = material(
        0.4, kind=SlipWeakeningMat, tensileStrength=1e6, bondCreationDistance=0.1, bondsToAll=True, criticalSlip=1.0
    )
    engine().updateStrengths()
    phys = O.interactions[wall, disk].phys
    assert type(phys).__name__ == "SlipWeakeningPhys" and phys.bonded
    assert {k: repr(v) for k, v in phys.dict().items() if k in before} == before
    O.bodies[disk].state.vel = (0, 1.0, 0)
    run(50)
    assert engine().bonds == 1 and abs(O.bodies[disk].state.vel[1]) < 1e-9


def test_a_body_that_no_rigid_contact_can_have_is_named_before_anything_is_changed():
    wall, disk = slider(material(0.3, wall=True), steps=3)
    other = free_disk(5, 0.5, mu=0.1)
    run(2)
    O.bodies[wall].material.frictionAngle = 0.7
    O.bodies[other].material = FrictMat()
    friction = O.interactions[wall, disk].phys.friction
    with pytest.raises(RuntimeError, match=f"body #{other} has a FrictMat"):
        engine().updateStrengths()
    assert O.interactions[wall, disk].phys.friction == friction


# ---- collider -------------------------------------------------------------------------------------


@pytest.mark.parametrize("value, found", [(0.5, 1), (0.2, 0)])
def test_a_sure_reach_that_is_changed_counts_at_once(value, found):
    """Two disks at rest with a gap of 0.3 diameters: they have an interaction within the sure reach alone."""
    stuff = material(tensileStrength=1e4, bondCreationDistance=0.05)
    free_disk(0, stuff=stuff), free_disk(1.3, stuff=stuff)
    begin(gravity=(0, 0, 0), reach=0.05, far=0.6)
    collider = next(e for e in O.engines if isinstance(e, Collider))
    for sure, count in ((0.06, 0), (value, found), (0.06, 0), (0.35, 1)):
        collider.sureReach = sure
        run(2)
        assert len(contacts()) == count, sure


@pytest.mark.parametrize("seen", [True, False])
def test_without_redirection_nobody_tells_of_bodies_that_come_and_go(seen):
    stuff = material(0.3)
    O.bodies.enableRedirection = False
    wall, disk = floor(stuff), free_disk(0, 0.5, stuff=stuff)
    free_disk(3, 0.5, stuff=stuff)
    begin()
    run(3)
    steps = (lambda n: run(n)) if seen else (lambda n: engine().advance(n, view=False))
    O.bodies.erase(wall)
    steps(10)
    engine().view()
    assert O.bodies[disk].state.vel[1] == pytest.approx(-G * 0.01, rel=1e-12)  # it falls
    O.bodies.insertAtId(scene.segments([(-5, -0.1), (5, -0.1)], stuff)[0], wall)
    steps(300)
    engine().view()
    assert O.bodies[disk].state.pos[1] == pytest.approx(0.4, abs=2e-3)  # and is caught by the new one
    O.bodies.erase(disk)
    O.bodies.insertAtId(scene.disk((0, 2), 0.25, stuff), disk)
    steps(10)
    engine().view()
    assert O.bodies[disk].state.vel[1] == pytest.approx(-G * 0.01, rel=1e-12)


def test_what_was_shown_alone_is_forgotten_once_all_is_shown():
    stuff = material()
    floor(stuff)
    ids = [free_disk(1.0 * (k % 30) - 15, 0.5 + k // 30, stuff=stuff) for k in range(300)]
    begin()
    run(3)
    engine().advance(3, view=ids[200:])
    engine().view()
    O.bodies.clear(), O.interactions.clear()
    floor(stuff), free_disk(0, 0.5, stuff=stuff)
    run(3)
    assert O.bodies[1].state.pos == Vector3(0, 0.5, 0) and engine().contacts == 1


def test_a_contact_of_bodies_that_came_after_the_collider_ran(monkeypatch):
    """A runner between collider and loop adds two disks and their interaction: it stays within the law's reach, as with
    YADE's collider.
    """
    stuff = material()
    free_disk(stuff=stuff)
    begin(gravity=(0, 0, 0), reach=0.05, far=0.6)

    def add():
        if len(O.bodies) == 1:
            ids = [free_disk(5, stuff=stuff), free_disk(6.02, stuff=stuff)]
            yade.utils.createInteraction(*ids)

    from_now_on("add_late", add, monkeypatch)
    O.engines = O.engines[:2] + [PyRunner(command="add_late()", iterPeriod=1, initRun=True)] + O.engines[2:]
    run(3)
    assert [(i.id1, i.id2) for i in contacts()] == [(1, 2)]


# ---- bonds ----------------------------------------------------------------------------------------


@WAYS
def test_a_break_is_counted_once_though_the_scene_was_saved_within_its_step(way, monkeypatch, tmp_path):
    stuff = material(0.4, tensileStrength=1e3, bondCreationDistance=0.05)
    O.bodies.append(scene.disk((0, 0), 0.5, stuff, fixed=True))
    disk = free_disk(1.0, stuff=stuff)
    begin(gravity=(0, 0, 0))
    either(way)
    run(2)
    engine().bond()
    O.bodies[disk].state.vel = (8, 0, 0)
    path = tmp_path / "within.yade.gz"

    def look():
        i = O.interactions[0, 1] if O.interactions.has(0, 1) else None
        if i and i.isReal and i.phys.brokenMode and not path.exists():
            O.save(str(path))

    from_now_on("look_for_break", look, monkeypatch)
    O.engines = O.engines[:3] + [PyRunner(command="look_for_break()", iterPeriod=1)] + O.engines[3:]
    run(20)
    whole = engine().brokenTension, tables.breaks(engine())["step"].tolist()
    assert path.exists() and whole[0] == 1 and len(whole[1]) == 1
    O.load(str(path))
    run(20)
    assert (engine().brokenTension, tables.breaks(engine())["step"].tolist()) == whole


@pytest.mark.parametrize("seen", [True, False])
@WAYS
def test_a_bond_that_a_script_sets_is_a_bond(way, seen):
    """Where none was made it is made as the bodies are, and breaks as one of ``bond()`` does, in the same step."""

    def course(by_hand):
        O.reset()
        stuff = material(0.4, tensileStrength=100.0, bondCreationDistance=0.1)
        a = O.bodies.append(scene.disk((0, 0), 0.5, stuff, fixed=True))
        b = free_disk(1.0, stuff=stuff)
        begin(gravity=(0, 0, 0))
        either(way)
        run(2)
        if by_hand:
            O.interactions[a, b].phys.bonded = True
        else:
            assert engine().bond() == 1
        O.bodies[b].state.vel = (5, 0.3, 0)
        steps = [engine().advance(20, view=seen) for _ in range(5)]
        engine().view()
        assert steps == [20] * 5
        return engine().breakTable(), engine().brokenTension, O.bodies[b].state.pos, O.bodies[b].state.vel

    mine, theirs = course(True), course(False)
    assert mine == theirs and mine[1] == 1


def test_a_bond_that_is_set_again_is_a_new_one():
    stuff = material(0.4, tensileStrength=100.0, bondCreationDistance=0.1)
    a = O.bodies.append(scene.disk((0, 0), 0.5, stuff, fixed=True))
    b = free_disk(1.0, stuff=stuff)
    begin(gravity=(0, 0, 0))
    run(2)
    engine().bond()
    O.bodies[b].state.vel = (3, 0, 0)
    run(10)  # 0.03 m, beyond its ellipse
    phys = O.interactions[a, b].phys
    assert not phys.bonded and phys.brokenMode == 1 and engine().brokenTension == 1
    O.bodies[b].state.vel = (0, 0, 0)
    phys.bonded = True
    run(3)
    phys = O.interactions[a, b].phys
    assert phys.bonded and phys.brokenMode == 0 and phys.brokenStep == -1 and engine().bonds == 1
    phys.bonded = False
    run(1)
    distance = O.bodies[b].state.pos[0]
    O.bodies[b].state.pos = (distance * math.cos(0.05), distance * math.sin(0.05), 0)  # out of its former ellipse
    run(1)
    O.interactions[a, b].phys.bonded = True
    run(2)
    assert engine().bonds == 1 and engine().brokenTension == 1 and engine().brokenShear == 0


@pytest.mark.parametrize("plain", [False, True])
def test_bonds_that_are_made_after_a_load_are_those_of_before(plain, tmp_path):
    """The gaps of contacts are not in YADE's files; contacts over gaps beyond the distance of creation stay without."""

    def course(loaded):
        O.reset()
        stuff = material(0.5, tensileStrength=1e4, bondCreationDistance=0.02)
        floor(stuff)
        for k in range(12):
            O.bodies.append(
                scene.disk((-2 + 1.02 * (k % 4) + 0.05 * (k // 4), 0.6 + 1.0 * (k // 4)), 0.4 + 0.01 * k, stuff)
            )
        begin()
        if plain:
            plain_engines()
        run(40)
        if loaded:
            O.save(str(tmp_path / "gaps.yade.gz"))
            O.load(str(tmp_path / "gaps.yade.gz"))
        made, known = engine().bond(), len(contacts())
        table = tables.contacts(engine())["gap"].tolist()
        run(20)
        return made, known, table, [O.bodies[i].state.pos for i in range(1, 13)]

    mine = course(True)
    assert mine == course(False) and 0 < mine[0] < mine[1]


def test_water_forgets_who_was_gone_when_the_scene_was_saved(tmp_path):
    begin()
    free_disk(-20, 1, stuff=material())
    disk = free_disk(0, 1, stuff=O.materials[0])
    O.engines = O.engines[:3] + [PorePressureEngine(planeNormal=(0, 1, 0), heights=[2.0], times=[0])] + O.engines[3:]
    run(2)
    O.bodies.erase(disk)
    O.save(str(tmp_path / "gone.yade.gz"))
    O.load(str(tmp_path / "gone.yade.gz"))
    O.bodies.insertAtId(scene.disk((0, 8), 0.5, O.materials[0]), disk)
    run(1)
    water = next(e for e in O.engines if isinstance(e, PorePressureEngine))
    assert not water.wasWet(disk) and water.isWet(0)


def test_a_look_between_loop_and_solver_changes_nothing():
    """What the loop has found of bonds that slide and turn is still known to the solver when all was read again in
    between.
    """

    def course(command):
        O.reset()
        stuff = material(0.4, 0.02, tensileStrength=3e3, bondCreationDistance=0.05)
        ids = [free_disk(0.99 * (k % 5), 0.99 * (k // 5), stuff=stuff) for k in range(20)]
        for k in ids:
            O.bodies[k].state.vel, O.bodies[k].state.angVel = (math.sin(k), math.cos(3 * k), 0), (0, 0, 2.0)
        begin(gravity=(0, 0, 0), dt=5e-3, tolerance=1e-6, correctionSlack=0)
        O.engines = O.engines[:3] + [PyRunner(command=command, iterPeriod=1, initRun=True)] + O.engines[3:]
        run(2)
        engine().bond()
        run(60)
        return [O.bodies[k].state.pos for k in ids], engine().energies()

    assert course("pass") == course("contactDynamics.view()")


@WAYS
@pytest.mark.parametrize("name", ["ellipseNormal", "ellipseTangential"])
@pytest.mark.parametrize("value", [math.nan, 0.0, -1.0])
def test_a_bond_without_an_ellipse(name, value, way):
    stuff = material(0.4, tensileStrength=100.0, bondCreationDistance=0.1)
    O.bodies.append(scene.disk((0, 0), 0.5, stuff, fixed=True))
    free_disk(1.0, stuff=stuff)
    begin(gravity=(0, 0, 0))
    either(way)
    run(2)
    engine().bond()
    setattr(contacts()[0].phys, name, value)
    with pytest.raises(RuntimeError, match=f"phys.{name} {'nan' if math.isnan(value) else int(value)};"):
        run(1)
    setattr(contacts()[0].phys, name, 0.02)
    run(1)
    assert engine().bonds == 1


def soft_bonds():
    stuff = CohFrictMat(
        young=1e6,
        poisson=0.3,
        density=2500,
        frictionAngle=0.5,
        isCohesive=True,
        normalCohesion=1e9,
        shearCohesion=1e9,
        momentRotationLaw=True,
    )
    O.materials.append(stuff)
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb()]),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom6D()],
            [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True)],
            [Law2_ScGeom6D_CohFrictPhys_CohesionMoment()],
        ),
        BondEllipseEngine(iterPeriod=1),
        NewtonIntegrator(damping=0),
    ]
    O.dt = 1e-5
    for k in range(3):
        O.bodies.append(yade.utils.sphere((0.99 * k, 0, 0), 0.5, material=stuff))
    O.step()
    for i in O.interactions:
        i.phys.fragile = False


def ellipses():
    return next(e for e in O.engines if isinstance(e, BondEllipseEngine))


def test_a_soft_bond_can_be_followed_before_the_first_step_of_a_loaded_scene(tmp_path):
    soft_bonds()
    O.save(str(tmp_path / "soft.yade.gz"))
    for _ in range(5):
        O.load(str(tmp_path / "soft.yade.gz"))
        ellipses().add(0, 1, 0.02, 0.02, 0.3, 0.1)
        ellipses().add(1, 2, 0.02, 0.02, 0.3, 0.1)
        run(2)
        assert ellipses().count == 2 and ellipses().broken == 0


@pytest.mark.parametrize("loaded", [False, True])
def test_a_soft_bond_of_later_bodies_is_not_taken_for_the_one_that_was_followed(loaded, tmp_path):
    soft_bonds()
    ellipses().add(0, 1, 0.02, 0.02, 0.3, 0.1)
    ellipses().add(1, 2, 0.02, 0.02, 0.3, 0.1)
    run(2)
    if loaded:
        O.save(str(tmp_path / "soft.yade.gz"))
        O.load(str(tmp_path / "soft.yade.gz"))
        run(1)
    O.engines[2].physDispatcher.functors[0].setCohesionNow = True
    O.bodies.erase(2)
    O.bodies.insertAtId(yade.utils.sphere((0.99, 0.99, 0), 0.5, material=O.materials[0]), 2)  # elsewhere at #1
    run(3)
    assert O.interactions[1, 2].isReal and not O.interactions[1, 2].phys.cohesionBroken
    assert ellipses().broken == 0 and ellipses().count == 1


# ---- ids that are used again ----------------------------------------------------------------------


def rain(height=100.0):
    water = PorePressureEngine(planeNormal=(0, 1, 0), heights=[height], times=[0], releaseDistance=5)
    O.engines = O.engines[:1] + [water] + O.engines[1:]
    return water


def used_again(disk, made, how, tmp_path):
    """Puts another body in the place of one, after a load or with all others."""
    if how == "loaded":
        O.save(str(tmp_path / "again.yade.gz"))
        O.load(str(tmp_path / "again.yade.gz"))
    if how == "cleared":
        O.interactions.clear()
        before = [(b.shape, b.state) for b in O.bodies]
        O.bodies.clear()
        for shape, state in before[:disk]:
            body = yade.wrapper.Body(shape=shape, state=state, material=O.materials[0])
            O.bodies.append(body)
        assert O.bodies.append(made()) == disk
    else:
        O.bodies.erase(disk)
        if how == "later":
            run(2)
        O.bodies.insertAtId(made(), disk)


HOW = pytest.mark.parametrize("how", ["at once", "later", "loaded", "cleared"])


@HOW
def test_water_knows_a_body_from_the_one_that_had_its_id(how, tmp_path):
    stuff = material()
    begin(gravity=(1, -G, 0))
    rain()
    free_disk(-20, 1, stuff=stuff)
    disk = free_disk(0, 1, stuff=stuff)
    run(2)
    O.bodies[disk].state.pos = (10, 1, 0)
    run(1)
    water = next(e for e in O.engines if isinstance(e, PorePressureEngine))
    assert water.isReleased(disk) and not water.isWet(disk)
    used_again(disk, lambda: scene.disk((20, 1), 0.5, O.materials[0]), how, tmp_path)
    water = next(e for e in O.engines if isinstance(e, PorePressureEngine))
    run(1)
    assert water.isWet(disk) and not water.isReleased(disk) and water.releasedCount == 0
    assert water.isWet(0)
    O.bodies[disk].state.pos = (26, 1, 0)  # 6 m from where it came
    run(1)
    assert water.isReleased(disk)


@HOW
def test_a_released_share_belongs_to_a_body_and_not_to_its_id(how, tmp_path):
    stuff = material()
    begin(gravity=(1, -G, 0))
    rain()
    free_disk(-20, 1, stuff=stuff)
    disk = free_disk(0, 1, stuff=stuff)
    run(1)
    next(e for e in O.engines if isinstance(e, PorePressureEngine)).releasedShare = [0.5, 1.0]
    run(1)
    water = next(e for e in O.engines if isinstance(e, PorePressureEngine))
    assert water.isReleased(disk) and not water.isReleased(0) and water.wetCount == 1
    used_again(disk, lambda: scene.disk((20, 1), 0.5, O.materials[0]), how, tmp_path)
    water = next(e for e in O.engines if isinstance(e, PorePressureEngine))
    run(1)
    assert water.isWet(disk) and not water.isReleased(disk) and water.releasedShare[disk] == 0
    assert water.releasedShare[0] == (0 if how == "cleared" else 0.5)


@HOW
def test_slip_belongs_to_a_body_and_not_to_its_id(how, tmp_path):
    wall, disk = slider(weak(0.1, 0.5))
    stuff = O.bodies[wall].material
    assert stuff.slipOf(disk) > 0.2 and stuff.weakenedCount() == 1

    def another():
        made = scene.disk((-5, 0.5), 0.5, O.materials[-1])
        made.state.blockedDOFs = "zXYZ"
        return made

    used_again(disk, another, how, tmp_path)
    stuff = O.bodies[wall].material
    assert stuff.slipOf(disk) == 0 and stuff.slippedCount() == 0 and not any(tables.slip(stuff, 0, len(O.bodies)))
    run(3)
    assert stuff.slipOf(disk) == 0
    assert O.interactions[wall, disk].phys.currentFriction == pytest.approx(0.5)


def test_the_slip_of_a_body_that_is_gone_is_remembered_until_its_id_is_used_again(tmp_path):
    wall, disk = slider(weak(0.1, 0.5))
    stuff = O.bodies[wall].material
    slip = stuff.slipOf(disk)
    O.bodies.erase(disk)
    run(2)
    O.save(str(tmp_path / "gone.yade.gz"))
    O.load(str(tmp_path / "gone.yade.gz"))
    run(2)
    assert O.bodies[wall].material.slipOf(disk) == slip and O.bodies[wall].material.slippedCount() == 1


def test_the_slip_of_another_scene_is_not_taken_for_that_of_this_one():
    wall, disk = slider(weak(0.1, 0.5))
    stuff = O.bodies[wall].material
    slip = stuff.slipOf(disk)
    O.switchScene()
    O.resetThisScene()
    other = O.bodies.append(scene.disk((0, 5), 0.5, material()))
    assert other == wall and free_disk(3, 5) == disk
    assert stuff.slipOf(disk) == slip  # of the scene that waits
    O.switchScene()
    run(1)
    assert stuff.slipOf(disk) >= slip


def test_a_material_that_is_used_in_a_new_scene_begins_without_slip():
    wall, disk = slider(weak(0.1, 0.5))
    stuff = O.bodies[wall].material
    assert stuff.slipOf(disk) > 0.2
    O.reset()
    O.materials.append(stuff)
    wall, disk = slider(stuff, speed=0.0, steps=2)
    assert O.interactions[wall, disk].phys.currentFriction == pytest.approx(0.5)
    assert stuff.slipOf(disk) == 0


def test_a_rail_that_is_gone_is_named():
    plate = O.bodies.append(scene.segments([(-1, 0), (1, 0)], material()))[0]
    O.bodies[plate].state.mass = 10.0
    O.bodies[plate].state.blockedDOFs = "zXYZ"
    begin()
    rail = O.bodies.append(yade.wrapper.Body())
    O.bodies[rail].state.blockedDOFs = "xyzXYZ"
    O.engines = O.engines[:1] + [PlateLoadEngine(id=plate, force=1.0, direction=(1, 1, 0), rail=rail)] + O.engines[1:]
    run(2)
    O.bodies.erase(rail)
    with pytest.raises(RuntimeError, match=f"rail = {rail}: there is no such body"):
        run(1)
    O.bodies.insertAtId(scene.disk((5, 0), 0.5, O.materials[0]), rail)
    with pytest.raises(RuntimeError, match=f"rail = {rail}: that body has a shape"):
        run(1)


# ---- numbers of steps that come again -------------------------------------------------------------


def test_slip_along_an_interface_counts_though_steps_have_the_same_number():
    def course(reset):
        O.reset()
        law = SlipWeakeningMat(density=2500, frictionAngle=0.1, criticalSlip=1e9)
        base = material(0.3, layer=0, interfaceLayers=[1], interfaceLaws=[law])
        O.bodies.append(scene.disk((0, 0), 0.5, base, fixed=True))
        disk = free_disk(0, 1.0, stuff=material(0.3, layer=1))
        begin()
        for _ in range(20):
            state = O.bodies[disk].state
            state.pos, state.vel, state.angVel = (0, 1.0, 0), (1, 0, 0), (0, 0, 0)
            O.step()
            if reset:
                O.resetTime()
        return law.slipOf(disk)

    assert course(True) == course(False) > 0.019  # of 20 steps of 1 mm, less what friction takes


def test_joints_of_walls_are_looked_up_in_each_step_though_it_has_the_same_number():
    """Behind YADE's own loop. A disk rolls over the joint of two walls, one of which comes to its place within the run:
    there is no bump.
    """

    def course(reset):
        O.reset()
        stuff = material(0.0)
        walls = O.bodies.append(scene.segments([(-5, 0), (0, 0), (5, 0)], stuff, piece=5))
        disk = free_disk(-1.0, 0.5, (2.0, 0, 0), stuff=stuff)
        begin()
        plain_engines()
        O.bodies[walls[1]].state.pos += Vector3(0, -1, 0)
        for k in range(1000):
            if k == 3:
                O.bodies[walls[1]].state.pos += Vector3(0, 1, 0)
            O.step()
            if reset:
                O.resetTime()
        return O.bodies[disk].state.pos, O.bodies[disk].state.vel

    assert course(True) == course(False)
    assert course(True)[1][0] == pytest.approx(2.0, abs=1e-12)


# ---- steps that are refused, or made again --------------------------------------------------------


@pytest.mark.parametrize("view", [True, False])
def test_what_is_mended_after_a_refusal_counts(view):
    """The solver refuses its settings before it looks at bodies, which collider and loop have left in the arrays: they
    are shown, and taken again.
    """
    disk = free_disk(0, 5)
    begin(gravity=(0, 0, 0))
    engine().advance(2, view=view)
    engine().tolerance = math.nan
    with pytest.raises(RuntimeError, match="tolerance = nan"):
        O.step()
    O.bodies[disk].state.vel = (3, 0, 0)
    engine().tolerance = 1e-6
    run(10)
    assert O.bodies[disk].state.pos[0] == pytest.approx(0.03, rel=1e-12)


@pytest.mark.parametrize("by", ["advance", "step"])
def test_engines_that_are_exchanged_while_nothing_is_shown(by):
    """YADE's collider would look at bodies as they were: advance() shows them first, and a step is refused."""
    stuff = material()
    floor(stuff), free_disk(0, 3, stuff=stuff)
    begin()
    engine().advance(500, view=False)
    plain_engines()
    if by == "advance":
        engine().advance(500)
    else:
        with pytest.raises(RuntimeError, match="O.engines was changed while O.bodies was not up to date"):
            O.step()
        run(500)
    mine = O.bodies[1].state.pos, O.bodies[1].state.vel
    O.reset()
    stuff = material()
    floor(stuff), free_disk(0, 3, stuff=stuff)
    begin()
    plain_engines()
    run(1000)
    assert (O.bodies[1].state.pos, O.bodies[1].state.vel) == mine


@pytest.mark.parametrize("way", ["stepped", "unseen"])
def test_forces_that_a_script_has_reset_are_found_anew_and_kept(way):
    """They let one solve begin with none; what it finds is there afterwards."""
    stuff = material()
    floor(stuff)
    disks = [free_disk(0, 0.5, stuff=stuff), free_disk(0, 1.5, stuff=stuff)]
    begin()
    run(5)
    phys = O.interactions[disks[0], disks[1]].phys
    phys.normalForce = phys.shearForce = (0, 0, 0)
    if way == "stepped":
        run(2)
    else:
        engine().advance(2, view=False)
        engine().view()
    weight = O.bodies[disks[1]].state.mass * G
    phys = O.interactions[disks[0], disks[1]].phys
    assert phys.normal == pytest.approx(weight, rel=1e-9) and phys.normalForce[1] == pytest.approx(weight, rel=1e-9)


def test_the_sums_of_a_wall_after_a_force_was_added_behind_the_integrator(monkeypatch):
    wall, disk = floor(material()), free_disk(0, 0.5)
    begin()
    from_now_on("push_late", lambda: O.forces.setPermF(disk, (0, -1.0, 0)), monkeypatch)
    sums = WallForceEngine(ids=[wall], along=[Vector3(1, 0, 0)])
    O.engines = O.engines + [PyRunner(command="push_late()", iterPeriod=1, initRun=True), sums]
    run(5)
    assert sums.take()[0] == pytest.approx(O.bodies[disk].state.mass * G, rel=1e-3)


# ---- what Python has made, where its lock is not held ---------------------------------------------


@pytest.mark.parametrize("what", ["shape", "functors", "material", "physics", "engines", "all"])
def test_what_python_has_made_may_end_in_an_advance(what):
    """Nobody but the engines holds it any more when contacts and walls let it go, in steps that are made without
    Python's lock.
    """
    stuff = material(0.3)
    wall = floor(SlipWeakeningMat(density=2500, criticalSlip=1.0))
    ids = [free_disk(1.2 * k, 0.5, stuff=stuff) for k in range(8)]
    begin()
    run(2)
    loop, collider = O.engines[2], O.engines[1]
    if what in ("shape", "all"):
        O.bodies[wall].shape = Segment(halfLength=30)
    if what in ("functors", "all"):
        loop.geomDispatcher.functors = [type(f)(interactionDetectionFactor=1.05) for f in loop.geomDispatcher.functors]
        loop.lawDispatcher.functors = [type(f)() for f in loop.lawDispatcher.functors]
        collider.boundDispatcher.functors = [type(f)() for f in collider.boundDispatcher.functors]
    if what in ("material", "all"):
        O.bodies[wall].material = stuff
        engine().updateStrengths()
    if what in ("physics", "all"):
        for i in contacts():
            i.phys = type(i.phys)(**{k: v for k, v in i.phys.dict().items() if k in ("friction", "residualFriction")})
    if what in ("engines", "all"):
        O.engines = [type(e)(**{}) if isinstance(e, ForceResetter) else e for e in O.engines]
    del loop, collider
    for k, i in enumerate(ids):
        O.bodies[i].state.vel = (0, 3.0 + k, 0)
    with contextlib.suppress(RuntimeError):  # a physics that Python has made lacks a length, and is refused
        for _ in range(20):
            engine().advance(20, view=False)
    gc.collect()
    O.interactions.clear()
    engine().advance(50)
    assert O.bodies[ids[3]].state.pos[1] > 0.4


def test_a_problem_is_not_half_of_a_step_that_was_refused(tmp_path):
    stuff = material(tensileStrength=1e4, bondCreationDistance=0.05)
    floor(stuff)
    ids = [free_disk(0.99 * (k % 5), 0.5 + 0.98 * (k // 5), stuff=stuff) for k in range(20)]
    begin()
    run(3)
    engine().dump(str(tmp_path / "good.h5"))
    one = contacts()[5].phys
    friction, one.residualFriction = one.residualFriction, math.nan
    O.bodies[ids[3]].state.vel = (7, 0, 0)
    with pytest.raises(RuntimeError, match="phys.residualFriction nan"):
        run(1)
    with pytest.raises(RuntimeError, match="the last step was refused"):
        engine().dump(str(tmp_path / "mixed.h5"))
    assert not (tmp_path / "mixed.h5").exists()
    one.residualFriction = friction
    run(1)
    engine().dump(str(tmp_path / "next.h5"))
    assert not np.array_equal(
        contact.load(tmp_path / "good.h5").free_velocity, contact.load(tmp_path / "next.h5").free_velocity
    )


@pytest.mark.parametrize("where", [2, -1])
@pytest.mark.parametrize("saved", [False, True])
def test_a_step_that_is_made_again_has_the_same_length(where, saved, monkeypatch, tmp_path):
    """An engine raises in the sixth step; before the solve, or after all."""
    stuff = material()
    floor(stuff), free_disk(0, 5, stuff=stuff)
    begin(dt=1e-4)
    raised = []

    def fail():
        if O.iter == 5 and not raised:
            raised.append(1)
            raise ValueError("once")

    from_now_on("fail_once", fail, monkeypatch)
    engines = [NonsmoothTimeStepper(smallest=1e-5, largest=1e-2, growth=1.1)] + O.engines
    at = where if where > 0 else len(engines)
    O.engines = engines[:at] + [PyRunner(command="fail_once()", iterPeriod=1, initRun=True)] + engines[at:]
    run(5)
    with pytest.raises(Exception):
        O.step()
    assert O.dt == pytest.approx(1e-4 * 1.1**6, rel=1e-14)
    if saved:
        O.save(str(tmp_path / "broken.yade.gz"))
        O.load(str(tmp_path / "broken.yade.gz"))
    O.step()
    assert O.iter == 6 and O.dt == pytest.approx(1e-4 * 1.1**6, rel=1e-14)
    O.step()
    assert O.dt == pytest.approx(1e-4 * 1.1**7, rel=1e-14)
    for k in range(3):
        O.resetTime()
        O.step()
        assert O.dt == pytest.approx(1e-4 * 1.1 ** (8 + k), rel=1e-14)  # these are new steps


def test_a_wall_that_is_moved_by_its_place_does_not_count_a_refused_step():
    """It is moved by 1 mm in every tenth step up to the fortieth; steps in between are refused and made again. The disk
    that it drags cannot tell.
    """

    def course(refused):
        O.reset()
        stuff = material(0.6)
        wall = floor(stuff)
        disk = free_disk(0, 0.5, stuff=stuff)
        O.bodies[disk].state.blockedDOFs = "zXYZ"
        begin(gravity=(0, -G, 0))
        speeds = []
        for k in range(80):
            if k % 10 == 0 and k <= 40:
                O.bodies[wall].state.pos += Vector3(1e-3, 0, 0)
            if refused and k in (33, 36):
                contacts()[0].phys.restitution = 7.0  # found after the solver has looked how walls were moved
                for _ in range(4):
                    with pytest.raises(RuntimeError, match="restitution 7"):
                        O.step()
                contacts()[0].phys.restitution = 0.0
            O.step()
            speeds.append(O.bodies[disk].state.vel[0])
        return speeds

    assert course(True) == course(False)


def test_an_advance_within_a_step_is_refused(monkeypatch):
    floor(material()), free_disk(0, 2)
    begin()
    said = []

    def go():
        runner.nextTime = 1e9
        with pytest.raises(RuntimeError, match="has begun and is not over") as error:
            ContactDynamicsEngine.advance(5)
        said.append(str(error.value))

    from_now_on("go_on_within", go, monkeypatch)
    runner = CourseRunner(command="go_on_within()", nextTime=0.0105)
    O.engines = [runner] + O.engines
    run(20)
    assert O.iter == 20 and len(said) == 1
    assert ContactDynamicsEngine.advance(3) == 3 and O.iter == 23


def test_a_course_runner_that_has_not_run_is_asked_ahead_of_a_loaded_scene(tmp_path):
    """Engine.scene of one that has not acted is nobody's: who looks ahead must not ask it."""
    floor(material()), free_disk(0, 2)
    begin()
    O.engines = [CourseRunner(command="", nextTime=0.005)] + O.engines + [CourseRunner(command="", nextTime=1e9)]
    O.save(str(tmp_path / "runner.yade.gz"))
    for _ in range(3):
        O.load(str(tmp_path / "runner.yade.gz"))
        assert ContactDynamicsEngine.advance(4, view=False) == 4


@pytest.mark.parametrize(
    "name, value", [("mass", 1e-320), ("mass", math.inf), ("inertia", 1e-320), ("inertia", math.inf)]
)
def test_a_mass_that_nothing_can_be_divided_by_is_named(name, value):
    floor(material())
    disk = free_disk(0, 0.5)
    begin()
    run(2)
    setattr(O.bodies[disk].state, name, value if name == "mass" else (1, 1, value))
    with pytest.raises(RuntimeError, match=f"body #{disk} can move but has mass"):
        run(1)


@pytest.mark.parametrize("late", [False, True])
@pytest.mark.parametrize("way", ["arrays", "plain", "unseen"])
def test_two_centres_at_one_place_have_no_normal(late, way):
    stuff = material()
    one, other = free_disk(0, stuff=stuff), free_disk(0.0 if not late else 1.0, stuff=stuff)
    begin(gravity=(0, 0, 0))
    either(way)
    if late:
        run(2)
        O.bodies[other].state.pos = (0, 0, 0)
    with pytest.raises(RuntimeError, match=rf"#{one}\+#{other} has no normal: the centres are at one place"):
        ContactDynamicsEngine.advance(1, view=way != "unseen")


# ---- sums -----------------------------------------------------------------------------------------


def test_the_balance_closes_when_bodies_are_erased():
    """A gas without gravity, whose balance has no error of the step's length."""
    stuff = material(0.4, rolling=0.05)
    O.bodies.append(scene.segments([(0, 12), (0, 0), (9, 0), (9, 12)], stuff, piece=3))
    ids = loose_heap(stuff)
    for k in ids:
        O.bodies[k].state.vel = (5 * math.sin(3 * k), 5 * math.cos(7 * k), 0)
    begin(gravity=(0, 0, 0))
    for i in ids[::7]:
        run(20)
        O.bodies.erase(i)
    run(20)
    energies = engine().energies()
    assert energies["brought"] < -1e4  # what they have taken with them
    assert (
        energies["impact"] > 1e5 and abs(energies["error"]) < 1e-9 * energies["impact"]
    )  # rounding of some thousand sums


def test_energies_are_added_to_their_names_after_they_were_cleared():
    stuff = material(0.3)
    wall, disk = slider(stuff, steps=3)
    O.trackEnergy = True
    O.energy["another"] = 1.0
    run(5)
    O.energy.clear()
    O.energy["mine"] = 2.0
    before = engine().slidingLoss
    run(5)
    assert O.energy["mine"] == 2.0
    assert O.energy["contactSliding"] == pytest.approx(engine().slidingLoss - before, rel=1e-12)


# ---- soft walls -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name, value",
    [("weakening", "Step"), ("criticalSlip", 0.0), ("criticalSlip", math.nan), ("weakenedFrictionAngle", 2.0)],
)
@pytest.mark.parametrize("late", [False, True])
def test_a_wall_that_would_never_weaken_is_refused_where_it_is_set(name, value, late):
    """YADE's own engines could not refuse it in a step: no exception may leave the threads of its loop."""
    with pytest.raises(ValueError, match=f"{name} = .*must be"):
        if late:
            setattr(SlipWeakeningMat(), name, value)
        else:
            SlipWeakeningMat(**{name: value})
