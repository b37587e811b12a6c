"""ContactDynamicsEngine in a scene: stacks, momentum, impact, driven walls, other engines, energies, refusals, save and
load.
"""
import ctypes
import math
import random
import threading
import time

import pytest
from shell import BUILD
from yade import O
from yade.minieigenHP import Quaternion
from yade.nonsmooth import contact, scene, tables
from yade.wrapper import (
    Collider,
    ContactDynamicsEngine,
    ForceEngine,
    ForceResetter,
    FrictMat,
    GlobalStiffnessTimeStepper,
    Ig2_Sphere_Sphere_ScGeom,
    InteractionLoop,
    Ip2_FrictMat_FrictMat_FrictPhys,
    Law2_ScGeom_FrictPhys_CundallStrack,
    NewtonIntegrator,
    PyRunner,
    TorqueEngine,
)

from contact_scenes import (
    G,
    begin,
    bits,
    box,
    contacts,
    engine,
    floor,
    free_disk,
    launch,
    loose_heap,
    material,
    momenta,
    refused,
    run,
)

pytestmark = pytest.mark.usefixtures("empty")


# ---- balance of forces and momentum ---------------------------------------------------------------


def test_loosely_solved_stack_does_not_creep():
    stuff = material(0.3, 0.1)
    wall = floor(stuff)
    disks = [O.bodies.append(scene.disk((0, 0.5 + k), 0.5, stuff)) for k in range(50)]
    begin(dt=5e-3, tolerance=1e-4, maxIterations=2000)
    run(500)
    weight, loads, top, heights = sum(O.bodies[d].state.mass * G for d in disks), [], O.bodies[disks[-1]].state, []
    for _ in range(1000):
        O.step()
        loads.append(-O.forces.f(wall)[1] / weight)
        heights.append(top.pos[1])
    # each of 50 contacts may overlap by 1e-4 of a diameter; it creeps into that, and not beyond
    assert 49.5 - 1.1 * 50 * 1e-4 < min(heights) and max(heights) < 49.5 + 1e-4
    # m, in 3.5 s; observed 8e-4
    assert sum(heights[-300:]) / 300 == pytest.approx(sum(heights[:300]) / 300, abs=1.5e-3)
    # a residual of 1e-4 leaves long waves of ± 4 % in a chain of 50 (its condition number is 4e3), but no bias
    assert sum(loads) / len(loads) == pytest.approx(1, abs=1e-3)
    assert 0.85 < min(loads) and max(loads) < 1.15
    assert engine().unconverged == 0


@pytest.mark.parametrize("tolerance", [1e-3, 1e-10])
def test_momentum_is_conserved_without_external_forces(tolerance):
    stuff = material(
        0.3,
        0.1,
        tensileStrength=2e4,
        residualTensileStrength=5e3,
        bondCreationDistance=0.3,
        restitution=0.3,
        bondEllipseNormal=0.1,
        bondEllipseTangential=0.1,
    )
    disks = loose_heap(stuff)
    dice = random.Random(2)
    for d in disks:
        O.bodies[d].state.vel = (dice.uniform(-1, 1), dice.uniform(-1, 1), 0)
        O.bodies[d].state.angVel = (0, 0, dice.uniform(-1, 1))
    begin(gravity=(0, 0, 0), dt=2e-3, tolerance=tolerance, reach=0.4)
    run(1)
    assert engine().bond() > 30
    linear, angular = momenta(disks)
    scale = sum(O.bodies[d].state.mass for d in disks)  # times 1 m/s; times 4 m for the angular momentum
    run(400)
    e = engine()
    broken = e.brokenTension + e.brokenShear + e.brokenTorque + e.brokenMixed
    assert broken >= 3 and e.bonds > 0 and e.slidingLoss > 0 and e.impactLoss > 0  # all that may happen does
    after, turned = momenta(disks)
    # whether solved or not: each impulse acts on two bodies with opposite signs; rounding of 400 steps
    assert (after - linear).norm() < 1e-11 * scale
    assert abs(turned - angular) < 1e-10 * scale
    assert (e.momentum - after).norm() < 1e-11 * scale


def test_fast_approach_is_solved_before_it_overlaps():
    # 40 m/s close 0.2 m in a step, four times openGap
    left, right = free_disk(-1, 0, (20, 0, 0)), free_disk(1, 0, (-20, 0, 0))
    begin(gravity=(0, 0, 0), dt=5e-3, reach=0.25)
    run(20)
    assert engine().overlapWorstEver < 1e-12
    assert O.bodies[left].state.vel.norm() < 1e-9 and O.bodies[right].state.vel.norm() < 1e-9  # e = 0, equal masses


def test_gaps_that_stay_open_are_left_out():
    stuff = material(0.3)
    near, far = 1.02, 1.15  # gaps of 0.02 and 0.15 of the diameter, at rest
    for y, distance in ((0, near), (5, far)):
        free_disk(0, y, stuff=stuff)
        free_disk(distance, y, stuff=stuff)
    e = begin(gravity=(0, 0, 0), reach=0.2)
    run(1)
    assert len(contacts()) == 2 and e.candidates == 1
    e.openGap = 0.2
    run(1)
    assert e.candidates == 2


@pytest.mark.parametrize("other", ["disk", "wall"])
def test_a_contact_that_pulled_and_is_left_out_bears_nothing(other):
    """Residual adhesion holds a disk that is drawn away; moved off by a script, it is open, and neither table nor
    contact has a pull any more.
    """
    stuff = material(0.3, residualTensileStrength=1e4)
    if other == "disk":
        O.bodies.append(scene.disk((0, 0), 0.5, stuff, fixed=True))
        distance = 1.0
    else:
        O.bodies.append(scene.segments([(0, -3), (0, 3)], stuff))
        distance = 0.5
    disk = free_disk(distance, 0, stuff=stuff)
    O.forces.setPermF(disk, (4e3, 1e3, 0))
    e = begin(gravity=(0, 0, 0), reach=0.2, relaxationRate=0)
    run(3)
    (i,) = contacts()
    pull = tables.contacts(e)
    assert pull["normal"][0] == pytest.approx(-4e3, rel=1e-5) == i.phys.normal  # it rolls a little
    O.forces.setPermF(disk, (0, 0, 0))
    O.bodies[disk].state.pos += (0.15, 0, 0)  # 0.15 ℓ; what is wider than 0.05 ℓ and does not close is not solved
    O.bodies[disk].state.vel = (0, 0, 0)
    run(1)
    assert e.candidates == 0
    told = tables.contacts(e)
    assert [told[name].tolist() for name in ("normal", "tangential", "torque")] == [[0.0]] * 3
    (i,) = contacts()
    assert (i.phys.normal, i.phys.tangential, i.phys.torque) == (0, 0, 0)
    assert i.phys.normalForce.norm() == i.phys.shearForce.norm() == 0
    assert O.bodies[disk].state.vel.norm() == 0


# ---- walls that move, blocked directions, other engines -------------------------------------------


@pytest.mark.parametrize(
    "make", [lambda e, n: run(n), lambda e, n: e.advance(n), lambda e, n: e.advance(n, view=False)]
)
def test_an_interaction_that_is_silenced_bears_nothing(make):
    """Of two disks on one that is held, one is silenced and falls freely through it, until it is heard again."""
    stuff = material(0.5)
    held, rests = free_disk(0, 0, stuff=stuff), free_disk(0, 1, stuff=stuff)
    other, falls = free_disk(5, 0, stuff=stuff), free_disk(5, 1, stuff=stuff)
    for i in (held, other):
        O.bodies[i].state.blockedDOFs = "xyzXYZ"
    e = begin()
    make(e, 20)
    e.view()
    contact = O.interactions[other, falls]
    contact.isActive = False
    make(e, 100)
    e.view()
    # semi-implicit Euler: speeds are exact, and a path of n steps is g h² n (n + 1) / 2
    assert O.bodies[falls].state.vel[1] == pytest.approx(-0.1 * G, rel=1e-12)
    assert O.bodies[falls].state.pos[1] == pytest.approx(1 - G * 1e-6 * 100 * 101 / 2, abs=1e-12)
    assert abs(O.bodies[rests].state.vel[1]) < 1e-9
    contact.isActive = True
    make(e, 1)
    e.view()
    assert abs(O.bodies[falls].state.vel[1]) < 1e-9  # an impact without restitution


def test_driven_wall_pushes_and_works():
    stuff = material(0.3)
    wall = O.bodies.append(scene.segments([(0, 5), (0, -5)], stuff))[0]
    O.bodies[wall].state.vel = (0.5, 0, 0)
    disk = free_disk(0.7, 0, stuff=stuff)
    begin(gravity=(0, 0, 0))
    run(1000)
    s, e = O.bodies[disk].state, engine()
    assert s.vel[0] == pytest.approx(0.5, rel=1e-10)
    assert s.pos[0] - O.bodies[wall].state.pos[0] == pytest.approx(0.5, abs=1e-9)
    # the wall gives m V²: half moves the disk, half is lost in the impact
    assert e.wallWork == pytest.approx(s.mass * 0.25, rel=1e-9)
    assert e.impactLoss == pytest.approx(0.5 * s.mass * 0.25, rel=1e-9)
    before = e.wallWork
    O.forces.setPermF(disk, (-1000, 0, 0))
    run(1000)
    assert s.vel[0] == pytest.approx(0.5, rel=1e-10)
    assert O.forces.f(wall)[0] == pytest.approx(-1000, rel=1e-9)
    assert engine().wallWork - before == pytest.approx(1000 * 0.5 * 1.0, rel=1e-9)  # F V t
    assert engine().externalWork == pytest.approx(-500, rel=2e-3)  # less the step in which the balance stands
    assert abs(engine().energyError) < 1e-6


def test_who_is_hit_hits_the_next_without_overlap():
    """The first disk closes its gap of 0.1 m in a step of 5 ms and passes on more than 20 m/s, far more than the second
    gap of 0.08 m needs.
    """
    stuff = material(0.0)
    for x, speed in ((0, 100), (1.1, 0), (2.18, 0), (3.26, 0)):
        O.bodies[free_disk(x, 0, stuff=stuff)].state.vel = (speed, 0, 0)
    begin(gravity=(0, 0, 0), dt=5e-3, reach=0.6)
    run(3)
    assert engine().overlapWorstEver < 1e-9  # the solve is exact to 1e-12
    assert engine().momentum[0] == pytest.approx(O.bodies[0].state.mass * 100, rel=1e-12)


def test_turning_wall_drags_a_disk():
    stuff = material(0.3)
    drum = O.bodies.append(scene.disk((0, 0), 1, stuff, fixed=True))
    O.bodies[drum].state.angVel = (0, 0, 1)
    disk = free_disk(0, 1.5, stuff=stuff)
    s = O.bodies[disk].state
    s.blockedDOFs = "xzXY"  # what turns it is friction, until it rolls on the drum
    O.forces.setPermF(disk, (0, -1000, 0))
    begin(gravity=(0, 0, 0))
    run(500)
    assert s.angVel[2] == pytest.approx(-300 * 0.5 / s.inertia[2] * O.time, rel=1e-9)  # μ N r
    run(4000)
    assert s.angVel[2] == pytest.approx(-2, rel=1e-9)  # 1 m of drum against 0.5 m of disk
    assert s.vel[0] == 0
    # the drum gives what turns the disk and, as much again, what slides away
    assert engine().wallWork == pytest.approx(2 * 0.5 * s.inertia[2] * 4, rel=1e-9)
    assert engine().slidingLoss == pytest.approx(0.5 * s.inertia[2] * 4, rel=1e-9)


def test_forces_of_other_engines_are_respected():
    stuff = material(0.3)
    floor(stuff)
    flying, pushed, turned = (
        free_disk(-5, 3, stuff=stuff),
        free_disk(5, 0.5, stuff=stuff),
        free_disk(-8, 9, stuff=stuff),
    )
    O.bodies[pushed].state.blockedDOFs = "zXYZ"
    mass = O.bodies[flying].state.mass
    begin(before=[ForceEngine(force=(2 * mass, 5 * mass, 0), ids=[flying, pushed])])
    O.forces.setPermT(turned, (0, 0, 40))
    run(100)
    t = O.time
    assert O.bodies[turned].state.angVel[2] == pytest.approx(40 * t / O.bodies[turned].state.inertia[2], rel=1e-12)
    assert tuple(O.bodies[flying].state.vel)[:2] == pytest.approx((2 * t, (5 - G) * t), rel=1e-12)
    # on the floor: 2 m against μ (m g − 5 m)
    assert O.bodies[pushed].state.vel[0] == pytest.approx((2 - 0.3 * (G - 5)) * t, rel=1e-9)
    O.forces.setPermF(pushed, (0, 6 * mass, 0))
    run(10)
    assert O.bodies[pushed].state.vel[1] > 0  # lifted: 11 m against m g


def test_blocked_directions_are_infinite_masses():
    stuff = material(0.3)
    held, mover = free_disk(0, 0, stuff=stuff), free_disk(1.2, 0.3, (-1, 0, 0), stuff=stuff)
    O.bodies[held].state.blockedDOFs = "xzXYZ"  # may move along y only
    begin(gravity=(0, 0, 0))
    run(500)
    a, b = O.bodies[held].state, O.bodies[mover].state
    assert a.vel[0] == 0 and a.pos[0] == 0 and a.angVel[2] == 0
    assert a.vel[1] < -0.01
    assert a.mass * (a.vel[1] + b.vel[1]) == pytest.approx(0, abs=1e-8)  # the free direction keeps its momentum


# ---- energy ---------------------------------------------------------------------------------------


def test_energy_of_a_block_that_slides_to_rest():
    stuff = material(0.3)
    floor(stuff)
    block = free_disk(0, 0.5, (2, 0, 0), stuff)
    O.bodies[block].state.blockedDOFs = "zXYZ"
    O.trackEnergy = True
    begin()
    run(1000)  # it rests after 2/(0.3 g) = 0.68 s
    s, e = O.bodies[block].state, engine()
    kinetic = 0.5 * s.mass * 4
    assert abs(s.vel[0]) < 1e-10
    assert s.pos[0] == pytest.approx(4 / (2 * 0.3 * G), abs=2 * O.dt)  # the step's first-order error is v h/2
    assert e.slidingLoss == pytest.approx(kinetic, rel=1e-9)
    assert abs(e.energyError) < 1e-9 * kinetic
    assert e.rollingLoss == 0 and abs(e.correctionEnergy) < 1e-9 * kinetic
    assert e.energies()["sliding"] == e.slidingLoss and e.energies()["error"] == e.energyError
    assert dict(O.energy.items())["contactSliding"] == pytest.approx(kinetic, rel=1e-9)


def test_energy_by_the_wall_that_was_slid_on():
    """Two blocks on floors of their own, one of two pieces that it passes from one to the other, and one on a disk that
    is held, which is no wall.
    """
    stuff = material(0.3)
    pieces, upper = (
        [O.bodies.append(b) for b in scene.segments(ends, stuff, sense=1)]
        for ends in (((-5, 0), (0.5, 0), (50, 0)), ((-5, 20), (50, 20)))
    )
    held = O.bodies.append(scene.disk((0, 40), 5.0, stuff))
    O.bodies[held].state.blockedDOFs = "xyzXYZ"
    blocks = [free_disk(0, y, (v, 0, 0), stuff) for y, v in ((0.5, 2), (20.5, 1), (45.5, 1))]
    for block in blocks:
        O.bodies[block].state.blockedDOFs = "zXYZ"
    begin()
    run(1000)  # all rest, after 0.68 s at most
    e, mass = engine(), O.bodies[blocks[0]].state.mass
    slid = list(e.wallSlidingLoss)
    assert len(slid) == max(upper) + 1 and all(slid[k] > 0 for k in pieces)
    # the way to the change of pieces costs μ m g of force along 0.5 m, but for the step in which it is passed
    assert slid[pieces[0]] == pytest.approx(0.3 * mass * G * 0.5, rel=0.03)
    assert slid[pieces[0]] + slid[pieces[1]] == pytest.approx(0.5 * mass * 4, rel=1e-9)
    assert slid[upper[0]] == pytest.approx(0.5 * mass, rel=1e-9)
    assert e.slidingLoss > sum(slid) + 0.01 * mass  # the third one has slid too
    O.saveTmp("walls")
    O.loadTmp("walls")
    assert list(engine().wallSlidingLoss) == slid
    engine().forgetEnergies()
    assert len(engine().wallSlidingLoss) == 0


def test_energy_of_a_collapse_closes():
    stuff = material(0.3, 0.1)
    box(stuff, 9.5, 12)
    loose_heap(stuff)
    O.trackEnergy = True
    begin(dt=1e-3, tolerance=1e-6, maxIterations=2000)
    run(3000)
    e = engine()
    given = e.slidingLoss + e.rollingLoss + e.impactLoss
    assert {"contactSliding", "contactRolling", "contactDebonding", "contactImpact"} <= set(O.energy.keys())
    assert given > 1e5  # J: 64 disks of about 1250 kg fall by some decimetres
    # potential energy is taken at the beginning of a step: first order, ½ m g h v, gone when all rests
    assert abs(e.energyError) < 1e-3 * given
    assert e.correctionEnergy < 1e-3 * given


# ---- saving, timing, threads ----------------------------------------------------------------------


def cohesive_heap():
    stuff = material(
        0.3, 0.1, tensileStrength=2e3, residualTensileStrength=1e3, residualFrictionAngle=0.2, bondCreationDistance=0.02
    )
    box(stuff, 9.5, 12)
    loose_heap(stuff)
    begin(dt=2e-3, tolerance=1e-4, maxIterations=300)


def test_save_and_load_continue_with_the_same_bits(tmp_path):
    cohesive_heap()
    run(800)
    assert engine().bond() > 20
    run(50)
    saved = str(tmp_path / "state.yade.gz")
    O.save(saved)
    run(200)
    e = engine()
    unbroken = (bits(), e.slidingLoss, e.brokenTension + e.brokenShear + e.brokenMixed, e.energyError, e.steps)
    O.reset()
    O.load(saved)
    assert type(O.bodies[0].material).__name__ == "NscdMat" and engine().bonds == 0  # not yet counted
    run(200)
    e = engine()
    assert (bits(), e.slidingLoss, e.brokenTension + e.brokenShear + e.brokenMixed, e.energyError, e.steps) == unbroken
    assert e.bonds > 0


def plain(e):
    """YADE's own engine in place of ours, with the same settings."""
    if isinstance(e, InteractionLoop):
        return InteractionLoop(e.geomDispatcher.functors, e.physDispatcher.functors, e.lawDispatcher.functors)
    return NewtonIntegrator(damping=0, gravity=e.gravity) if isinstance(e, NewtonIntegrator) else e


def test_own_loop_and_integrator_have_the_bits_of_yades():
    # bonds that break, contacts that come and go, walls: every field that a rigid contact has
    def course(engines_of):
        O.reset()
        cohesive_heap()
        O.engines = [engines_of(e) for e in O.engines]
        run(600)
        bonds = engine().bond()
        integrator().gravity = (6, -G, 0)
        run(400)
        geometry = sorted(
            (
                i.id1,
                i.id2,
                tuple(i.geom.normal),
                tuple(i.geom.contactPoint),
                i.geom.penetrationDepth,
                i.geom.refR1,
                i.geom.refR2,
                i.phys.bonded,
                i.phys.brokenMode,
                i.iterMadeReal,
            )
            for i in contacts()
        )
        return (
            bonds,
            bits(),
            [tuple(b.state.ori) for b in O.bodies],
            geometry,
            engine().brokenTension + engine().brokenShear + engine().brokenMixed,
        )

    ours, theirs = course(lambda e: e), course(plain)
    assert ours[0] > 20 and ours[4] > 0 and len(ours[3]) > 50
    assert ours == theirs


@pytest.mark.parametrize("blocked", ["", "x", "yZ", "zXY", "xyzXYZ"])
def test_own_integrator_has_the_bits_of_yades_out_of_the_plane_too(blocked):
    def flight(engines_of):
        O.reset()
        stuff = material(0.3)
        for k in range(3):  # turned and spinning in space; in the plane; spinning in it, but turned out of it
            disk = free_disk(2 * k, 0, stuff=stuff)
            state = O.bodies[disk].state
            state.blockedDOFs = blocked
            state.inertia = (2, 2, 2)
            state.vel, state.angVel = ((3, -2, 1), (1, 5, -7)) if k == 0 else ((1, 2, 0), (0, 0, 3))
            if k != 1:
                state.ori = Quaternion((1, 0, 2), 0.7)
        begin()
        O.engines = [
            ForceResetter(),
            ForceEngine(ids=[0, 1, 2], force=(10, 20, -5)),
            TorqueEngine(ids=[0, 1, 2], moment=(1, -2, 3)),
            engines_of(integrator()),
        ]
        O.engines[-1].gravity = (0.5, -G, 0.25)
        run(50)
        return [tuple(b.state.pos) + tuple(b.state.vel) + tuple(b.state.angVel) + tuple(b.state.ori) for b in O.bodies]

    assert flight(lambda e: e) == flight(plain)


def test_what_soft_laws_need_of_a_contact_of_disks_is_zero(tmp_path):
    cohesive_heap()
    walls = sum(1 for b in O.bodies if b.state.blockedDOFs == "xyzXYZ")

    def shears():
        return [i.geom.shearInc.norm() for i in contacts() if min(i.id1, i.id2) >= walls]

    for _ in range(400):  # those just made, and those that are followed
        run(1)
        assert not any(shears())
    assert len(shears()) > 50
    O.save(str(tmp_path / "state.yade.gz"))
    O.load(str(tmp_path / "state.yade.gz"))
    run(1)
    assert len(shears()) > 50 and not any(shears())
    O.engines = [plain(e) for e in O.engines]
    run(1)
    assert any(shears())  # as YADE's own loop has them


def test_what_an_engine_between_loop_and_solver_changes_counts_in_the_same_step():
    # the solver takes what the loop has read only where nothing that may change it stands between
    stuff = material(0.3)
    floor(stuff)
    disk = free_disk(0, 0.5, stuff=stuff)
    begin(dt=1e-3)
    run(2)
    at = next(k for k, e in enumerate(O.engines) if isinstance(e, ContactDynamicsEngine))
    O.engines = O.engines[:at] + [PyRunner(iterPeriod=1, command="O.bodies[1].state.vel = (0, 2, 0)")] + O.engines[at:]
    assert disk == 1
    O.step()
    # it was thrown up after the loop had read it: no reaction, and a step's weight less than the speed it was given
    assert O.bodies[disk].state.vel[1] == pytest.approx(2 - G * O.dt, rel=1e-12)


def test_own_integrator_leaves_clumps_to_yades():
    stuff = material(0.3)
    pair = [free_disk(0, 5, stuff=stuff), free_disk(1.2, 5, stuff=stuff)]
    O.bodies.clump(pair)
    begin()
    O.engines = [e for e in O.engines if isinstance(e, (ForceResetter, NewtonIntegrator))]
    refused("PlanarNewtonIntegrator", "clump", "NewtonIntegrator")


def test_one_and_two_threads_give_the_same_bits(tmp_path):
    script = tmp_path / "threads.py"
    script.write_text(
        """
import hashlib
from yade import nonsmooth
from contact_scenes import *
stuff = material(0.3, 0.1, tensileStrength=2e3, residualTensileStrength=1e3, bondCreationDistance=0.02)
box(stuff, 100, 40)
loose_heap(stuff, columns=90, rows=30)
begin(dt=4e-3, tolerance=1e-4, maxIterations=100)
run(300)
print("bonds", engine().bond())
run(50)
print("contacts", engine().candidates)
print("bits", [hashlib.sha256(table).hexdigest() for table in bits()], engine().slidingLoss.hex(), engine().energyError.hex())
"""
    )
    first, second = (launch(script, "--threads", threads) for threads in ("1", "2"))
    assert first.returncode == 0, first.stderr
    lines = [
        [line for line in r.stdout.splitlines() if line.startswith(("bonds", "contacts", "bits"))]
        for r in (first, second)
    ]
    assert len(lines[0]) == 3 and lines[0] == lines[1]
    assert int(lines[0][1].split()[1]) >= 2048  # four strips: the solver's own limit for more than one thread


def test_timing_counts_the_engine():
    O.timingEnabled = True
    cohesive_heap()
    run(20)
    e, spent = engine(), engine().stageSeconds
    assert e.execCount == 20 and e.execTime > 0
    assert list(spent) == ["collide", "interactions", "gather", "solve", "correct", "scatter", "integrate"] and all(
        s > 0 for s in spent.values()
    )
    # YADE's own timers stand around the same work
    for kind, stages in (
        (Collider, ("collide",)),
        (InteractionLoop, ("interactions",)),
        (ContactDynamicsEngine, ("gather", "solve", "correct", "scatter")),
        (NewtonIntegrator, ("integrate",)),
    ):
        assert (
            sum(spent[name] for name in stages) <= 1e-9 * next(x for x in O.engines if isinstance(x, kind)).execTime
        ), kind


def test_stages_of_yades_own_engines_are_left_to_yades_own_timers():
    simple_scene()
    O.engines = [plain(e) for e in O.engines]
    run(2)
    assert {name for name, seconds in engine().stageSeconds.items() if seconds == 0} == {"interactions", "integrate"}


# ---- refusals -------------------------------------------------------------------------------------


def simple_scene(**more):
    stuff = material(0.3, label="rock")
    floor(stuff)
    disk = free_disk(0, 0.5, stuff=stuff)
    begin(**more)
    return disk


def integrator():
    return next(e for e in O.engines if isinstance(e, NewtonIntegrator))


def test_refuses_damping():
    simple_scene()
    integrator().damping = 0.2
    refused("damping", "0.2", "damping=0")


def test_refuses_soft_time_steppers_unless_off():
    simple_scene()
    O.engines = [GlobalStiffnessTimeStepper(active=True)] + O.engines
    refused("GlobalStiffnessTimeStepper", "O.dt")
    O.engines[0].active = False
    O.step()


def test_refuses_a_wrong_order_and_a_missing_integrator():
    simple_scene()
    engines = O.engines
    at = [type(e).__name__ for e in engines].index("ContactDynamicsEngine")
    O.engines = engines[:at] + [engines[at + 1], engines[at]]
    refused("NewtonIntegrator", "before")
    O.engines = engines[: at + 1]
    refused("NewtonIntegrator", "add")


def test_refuses_bodies_that_leave_the_plane():
    disk = simple_scene()
    O.bodies[disk].state.blockedDOFs = ""
    refused(f"#{disk}", "zXY")


@pytest.mark.parametrize("attribute, word", [("mass", "mass"), ("vel", "finite")])
def test_refuses_unusable_states(attribute, word):
    disk = simple_scene()
    setattr(O.bodies[disk].state, attribute, {"mass": 0.0, "vel": (math.nan, 0, 0)}[attribute])
    refused(f"#{disk}", word)


def test_refuses_contacts_of_other_materials():
    soft = FrictMat(density=2500)
    O.materials.append(soft)
    for x in (0, 0.9):
        O.bodies.append(scene.disk((x, 0), 0.5, soft))
    begin()
    # a scene that was turned to Contact Dynamics by halves
    O.engines = [
        e
        if not isinstance(e, InteractionLoop)
        else InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]
        )
        for e in O.engines
    ]
    refused("#0", "#1", "FrictPhys", "NscdMat")


@pytest.mark.parametrize("name, value", [("tensileStrength", -1.0), ("restitution", 2.0), ("bondEllipseNormal", 0.0)])
def test_refuses_materials_without_sense(name, value, tmp_path):
    # in a process of its own: YADE makes contacts inside a parallel loop, where an exception ends the program
    script = tmp_path / "material.py"
    script.write_text(
        f"""
from yade import nonsmooth
from yade.nonsmooth import scene
O.materials.append(NscdMat(density=2500, label='rock', {name}={value}))
for x in (0, 0.9):
    O.bodies.append(scene.disk((x, 0), 0.5, O.materials[0]))
O.engines = scene.engines()
O.dt = 1e-3
O.step()
"""
    )
    result = launch(script)
    assert result.returncode != 0
    for word in ("rock", name, "must be"):
        assert word in result.stderr


@pytest.mark.parametrize(
    "name, value",
    [("tolerance", 0.0), ("maxIterations", 0), ("relaxationRate", 2.0), ("method", "jacobi"), ("checkEvery", 0)],
)
def test_refuses_wrong_settings(name, value):
    simple_scene(**{name: value})
    refused(name)


def test_unknown_settings_are_refused():
    with pytest.raises(Exception, match="iterationsMaximum"):
        scene.engines(iterationsMaximum=3)


def test_contacts_recalled_in_a_step_stand_in_the_order_of_ids(tmp_path):
    stuff = material(0.3)
    # the flying one hits its neighbour, which nothing approaches yet, and that one hits the next: contacts 1-2, then
    # 0-1, then 3-4 which was there before
    for x, speed in ((2.4, 0), (1.2, 0), (0, 100), (10, 0), (11, 0)):
        free_disk(x, 0, (speed, 0, 0), stuff)
    begin(gravity=(0, 0, 0), dt=1e-2, reach=0.5)
    O.step()
    engine().dump(str(tmp_path / "problem.h5"))
    problem = contact.load(tmp_path / "problem.h5")
    assert [tuple(b) for b in problem.body.tolist()] == [(0, 1), (1, 2), (3, 4)]
    speeds = [O.bodies[k].state.vel[0] for k in (0, 1, 2)]
    # each closes its gap of 0.2 m in the step, and no more
    assert sum(speeds) == pytest.approx(100, rel=1e-9)
    assert (speeds[1] - speeds[0], speeds[2] - speeds[1]) == pytest.approx((20, 20), rel=1e-9)


@pytest.mark.parametrize(
    "engines",
    [
        lambda: O.engines,
        lambda: O.engines + [ForceEngine(force=(0, 0, 0), ids=[])],
        lambda: [plain(e) for e in O.engines],
    ],
    ids=["arrays", "read anew", "YADE's own loop"],
)
def test_contacts_that_came_late_stand_in_the_order_of_ids_too(tmp_path, engines):
    """In the arrays, beside an engine that may change anything, so that all are read anew, and from the list where
    YADE's own loop has just made one; whoever looks afterwards finds them so too."""
    first, late, early = (free_disk(x, 0) for x in (0, -5, 1))
    begin(gravity=(0, 0, 0))
    O.engines = engines()
    run(2)
    O.bodies[late].state.pos = (-1, 0, 0)
    for _ in range(2):  # it comes in the first of them, and stays, or is read with the others, in the second
        run(1)
        engine().dump(str(tmp_path / "problem.h5"))
        assert contact.load(tmp_path / "problem.h5").body.tolist() == [[first, late], [first, early]]
        assert [(i.id1, i.id2) for i in O.interactions if i.isReal] == [(first, late), (first, early)]


def test_the_list_of_interactions_is_not_rewritten_while_a_viewer_walks_along_it():
    drawing = ctypes.CDLL(str(BUILD / "libnonsmooth_drawing_lock.so"))
    floor(material())
    free_disk(0, 0.5)
    free_disk(0, 1.5)
    begin()
    run(2)
    assert len(contacts()) == 2  # none is made or lost any more, which YADE itself has wait for a viewer
    O.resetTime()  # whoever looks when step 0 is over finds the list in order
    begun, end = threading.Event(), threading.Event()

    def draw():
        drawing.nonsmooth_begin_drawing()
        begun.set()
        end.wait()
        drawing.nonsmooth_end_drawing()

    viewer = threading.Thread(target=draw)
    viewer.start()
    begun.wait()
    try:
        O.run(1, False)
        time.sleep(0.3)  # a step takes less than a millisecond; one that comes late is not there either
        assert O.iter == 0
    finally:
        end.set()
        viewer.join()
    O.wait()
    assert O.iter == 1
