"""What soft contacts tell of a scene (soft.measures), against forces, places and velocities of YADE's own."""
import dataclasses
import math

import numpy as np
import pytest
from yade import O
from yade.nonsmooth import scene, section, tables, worlds
from yade.nonsmooth.soft import measures
from yade.nonsmooth.soft.bonds import bonded
from yade.nonsmooth.soft.measures import Measures
from yade.wrapper import CohFrictPhys, FrictPhys, JCFpmPhys, WallPhys

from contact_scenes import run

ROCK = section.Material(
    "rock",
    friction=0.5,
    residual_friction=0.3,
    rolling_friction=0.1,
    residual_rolling_friction=0.1,
    tensile_strength=1e5,
    density=2500.0,
)
BONDED = dataclasses.replace(ROCK, name="bonded ground")
GROUND = section.Material(
    "ground", friction=0.4, residual_friction=0.4, rolling_friction=0.1, residual_rolling_friction=0.1, bonded=False
)
WORLD = worlds.Soft(stiffness=1e8, diameter=(1.0, 1.6), damping=0.0)
same = dict(rel=1e-9)  # rounding
MODES = ("brokenTension", "brokenShear", "brokenTorque", "brokenMixed")


pytestmark = pytest.mark.usefixtures("empty")


def begin(disks, gravity=(0, 0, 0), wall=False, world=WORLD, ground=GROUND):
    """Disks (x, y, r) of one rock, above a wall of ``ground`` along x if asked for; returns the Measures and the ids of
    the disks.
    """
    rock, ground = (O.materials[O.materials.append(m)] for m in (world.material(ROCK), world.wall_material(ground)))
    if wall:
        O.bodies.append(scene.segments([(-50, 0), (50, 0)], ground, sense=1))
    ids = list(O.bodies.append([scene.disk((x, y), r, rock) for x, y, r in disks]))
    O.engines, O.dt = world.engines(gravity=gravity), world.step_for([ROCK])
    return Measures(world, [(ROCK, ids)]), ids


@pytest.mark.parametrize("wall", [True, False])
@pytest.mark.parametrize("way", [1, -1])
def test_forces_are_those_on_the_second_body(wall, way):
    """The only contact of a disk that slides to one side: what it feels, along the normal and along that turned by
    +90°.
    """
    seen, ids = begin([(0, 0.499, 0.5)] if wall else [(0, 0, 0.8), (0, 1.299, 0.5)], wall=wall)
    second = ids[-1]
    O.bodies[second].state.vel = (0.3 * way, 0, 0)
    run(2)
    # contacts are looked at at a step's begin
    depth = (
        0.5 - O.bodies[second].state.pos[1]
        if wall
        else 1.3 - (O.bodies[ids[1]].state.pos - O.bodies[ids[0]].state.pos).norm()
    )
    run(1)
    table, force = tables.contacts(seen), O.forces.f(second)
    assert len(table["id2"]) == 1 and table["id2"][0] == second
    nx, ny = table["nx"][0], table["ny"][0]
    assert ny > 0.99 and table["normal"][0] > 0
    assert table["normal"][0] == pytest.approx(force[0] * nx + force[1] * ny, **same)
    # friction acts against the motion
    assert (
        table["tangential"][0] == pytest.approx(-force[0] * ny + force[1] * nx, **same)
        and way * table["tangential"][0] > 0
    )
    assert -table["gap"][0] == pytest.approx(depth, rel=1e-9) and depth > 0
    assert (
        seen.overlapWorst == seen.overlapMean == pytest.approx(-table["gap"][0] / (1.0 if wall else 1.3), **same)
        and seen.contacts == 1
    )


def test_a_walls_rolling_stiffness_is_that_of_its_shear_at_the_radius():
    """k_r = k_s R², unless a world has another ratio."""
    for world, ratio in ((WORLD, 1.0), (dataclasses.replace(WORLD, rolling_ratio=0.4), 0.4)):
        begin([(0, 0.499, 0.5)], wall=True, world=world)
        run(1)
        (phys,) = [i.phys for i in O.interactions if i.isReal]
        assert phys.kr == pytest.approx(ratio * phys.ks * 0.5**2, **same) and phys.kr > 0
        O.reset()


def test_energies_and_centre_by_hand():
    seen, ids = begin([(0.0, 3.0, 0.5), (4.0, -1.0, 0.8)], gravity=(2.0, -9.81, 0))
    O.step()
    for i, velocity, spin in zip(ids, ((3.0, -1.0, 0), (0.5, 2.0, 0)), (4.0, -7.0)):
        O.bodies[i].state.vel, O.bodies[i].state.angVel = velocity, (0, 0, spin)
    seen._step = None  # a script has changed the state since
    m = 2500 * math.pi * np.array([0.25, 0.64])
    x, y = np.array([tuple(O.bodies[i].state.pos)[:2] for i in ids]).T
    assert seen.potentialEnergy == pytest.approx(float((m * (9.81 * y - 2.0 * x)).sum()), **same)
    assert seen.kineticEnergy == pytest.approx(
        0.5 * float((m * [10.0, 4.25]).sum() + (0.5 * m * [0.25, 0.64] * [16.0, 49.0]).sum()), **same
    )
    assert seen.centroid == pytest.approx((float((m * x).sum() / m.sum()), float((m * y).sum() / m.sum())), **same)
    assert (seen.meanSpeed, seen.maxSpeed) == pytest.approx(
        (0.5 * (math.sqrt(10) + math.sqrt(4.25)), math.sqrt(10)), **same
    )


# ---- how bonds break ------------------------------------------------------------------------------
def broken(seen):
    """{name: bonds that broke so}, of those that any did."""
    return {name: getattr(seen, name) for name in MODES if getattr(seen, name)}


@pytest.mark.parametrize("model", ["cohesion_moment", "jcfpm"])
@pytest.mark.parametrize("other", ["disk", "wall"])
@pytest.mark.parametrize(
    "velocity, spin, mode",
    [
        ((0, 0.5, 0), 0.0, "tension"),
        ((0.5, 0, 0), 0.0, "shear"),
        ((-0.5, 0, 0), 0.0, "shear"),
        # it rolls on the other, which holds still or turns back: nothing slides where they touch
        ((0, 0, 0), 0.5, "torque"),
        ((0, 0, 0), -0.5, "torque"),
    ],
)
def test_a_bond_is_counted_by_how_it_broke(model, other, velocity, spin, mode):
    """A disk goes from the disk or the wall below it, to which it is bonded, by a given motion; looked at in every
    step. JCFpm's bonds of disks have no torque.
    """
    world = worlds.Soft(stiffness=1e8, diameter=(1.0, 1.6), damping=0.0, model=model)
    seen, ids = begin(
        [(0, 0, 0.5), (0, 1.0, 0.5)] if other == "disk" else [(0, 0.5, 0.5)],
        wall=other == "wall",
        world=world,
        ground=BONDED,
    )
    assert seen.bond() == 1 == seen.bonds and broken(seen) == {}
    for k in ids:
        O.bodies[k].state.blockedDOFs = "xyzXYZ"
    upper = O.bodies[ids[-1]].state
    upper.vel, upper.angVel = velocity, (0, 0, spin)
    if spin and other == "disk":
        O.bodies[ids[0]].state.angVel = (0, 0, -spin)
    elif spin:
        upper.vel = (-0.5 * spin, 0, 0)
    begun = O.iter
    while seen.bonds and O.iter < begun + 4000:
        O.step()
    if model == "jcfpm" and other == "disk" and mode == "torque":
        assert seen.bonds == 1 and broken(seen) == {}
        return
    assert seen.bonds == 0 and broken(seen) == {f"broken{mode.capitalize()}": 1}
    told = tables.breaks(seen)
    pair = (ids[0], ids[1]) if other == "disk" else (0, ids[0])
    assert (told["id1"].tolist(), told["id2"].tolist()) == ([pair[0]], [pair[1]])
    assert [tables.BREAK_MODES[k] for k in told["mode"]] == [mode] and told["step"][0] == O.iter
    # below the disk's centre, where they touched, but for half of what it has moved off
    place = (upper.pos[0], 0.5 if other == "disk" else 0)
    assert (told["x"][0], told["y"][0]) == pytest.approx(place, abs=0.05)


def test_a_bond_that_nobody_saw_loaded_broke_in_a_mixed_way():
    """Seen whole and without force, then when it was gone."""
    seen, ids = begin([(0, 0, 0.5), (0, 1.0, 0.5)])
    assert seen.bond() == 1
    for k, speed in zip(ids, (0.0, 0.5)):
        O.bodies[k].state.blockedDOFs, O.bodies[k].state.vel = "xyzXYZ", (0, speed, 0)
    (bond,) = [i.phys for i in O.interactions if i.isReal]
    while bonded(bond):
        O.step()
        assert O.iter < 4000
    assert seen.bonds == 0 and broken(seen) == {"brokenMixed": 1}
    assert [tables.BREAK_MODES[k] for k in tables.breaks(seen)["mode"]] == ["mixed"]


F_A = 1000.0  # N
OF_DISKS = dict(
    normalAdhesion=F_A, shearAdhesion=300.0, rollingAdhesion=100.0, tangensOfFrictionAngle=0.3, maxRollPl=0.1
)
OF_WALLS = dict(tensileForce=F_A, friction=0.3, rollingArm=0.1)
OF_JOINTS = dict(FnMax=F_A, FsMax=300.0, tanFrictionAngle=0.3)


@pytest.mark.parametrize(
    "made, has_torque",
    [
        (lambda: CohFrictPhys(**OF_DISKS), True),
        (lambda: WallPhys(**OF_WALLS), True),
        (lambda: JCFpmPhys(**OF_JOINTS), False),
    ],
    ids=["disks", "walls", "jcfpm"],
)
def test_a_mode_is_the_threshold_that_is_nearest(made, has_torque):
    """F_a = 1000 N, μ = 0.3 and an arm of 0.1 m: under a compression N the thresholds are μ (F_a + N) and 0.1 m (F_a +
    N), tension has F_a. Of the shares of each the largest counts, from a half on."""
    bond = made()
    for loads, mode in (
        ((-510, 0, 0), "tension"),
        ((-490, 0, 0), "mixed"),  # less than half of any
        ((0, 155, 0), "shear"),
        ((0, 145, 0), "mixed"),
        ((1000, 310, 0), "shear"),  # of 600 N under compression
        ((1000, 290, 0), "mixed"),
        ((-500, 90, 0), "shear"),  # of 150 N under tension 0.6, more than 0.5 of F_a
        ((-500, 70, 0), "tension"),
        ((0, 0, 55), "torque"),
        ((0, 0, 45), "mixed"),
        ((1000, 0, 110), "torque"),
        ((1000, 0, 90), "mixed"),
        ((1000, 400, 140), "torque"),  # 0.7 of its threshold, and 0.67 of that of shear
        ((1000, 400, 130), "shear"),
        ((-990, 0, 0), "tension"),
        ((0, 0, 0), "mixed"),
    ):
        if mode == "torque" and not has_torque:
            mode = "shear" if loads[1] else "mixed"
        assert tables.BREAK_MODES[measures._mode(bond, *loads)] == mode, loads


@pytest.mark.parametrize(
    "bond",
    [
        CohFrictPhys(**OF_DISKS | {"normalAdhesion": 0.0, "shearAdhesion": 0.0, "rollingAdhesion": 0.0}),
        WallPhys(**OF_WALLS | {"tensileForce": 0.0}),
        JCFpmPhys(**OF_JOINTS | {"FnMax": 0.0, "FsMax": 0.0}),
    ],
    ids=["disks", "walls", "jcfpm"],
)
def test_a_bond_without_cohesion_goes_as_soon_as_it_is_drawn_at(bond):
    """A threshold of nothing is passed by any force, and by none where there is none."""
    assert tables.BREAK_MODES[measures._mode(bond, -1e-9, 0.0, 0.0)] == "tension"
    assert tables.BREAK_MODES[measures._mode(bond, 0.0, 1e-9, 0.0)] == "shear"
    assert tables.BREAK_MODES[measures._mode(bond, 0.0, 0.0, 0.0)] == "mixed"


def test_a_contact_of_another_law_has_no_mode():
    assert tables.BREAK_MODES[measures._mode(FrictPhys(), -1e9, 1e9, 1e9)] == "mixed"


# ---- contacts and overlaps ------------------------------------------------------------------------
def test_overlaps_are_of_contacts_that_touch():
    """One pair overlaps by 1 % of its mean diameter, 1.3 m, one by 2 % of 1 m; a bond over a gap bears nothing and is
    none. Their mean is 1.5 %.
    """
    seen, ids = begin([(0, 0, 0.8), (1.3 * 0.99, 0, 0.5), (5, 0, 0.5), (5.98, 0, 0.5), (10, 0, 0.5), (11.005, 0, 0.5)])
    for k in ids:
        O.bodies[k].state.blockedDOFs = "xyzXYZ"
    assert seen.bond() == 3
    run(3)
    assert (seen.bonds, seen.contacts) == (3, 2) and len(tables.contacts(seen)["id1"]) == 3
    assert (seen.overlapMean, seen.overlapWorst) == pytest.approx((0.015, 0.02), rel=1e-9)
    # what was the worst stays the worst ever
    O.bodies[ids[3]].state.pos = (5.99, 0, 0)
    run(2)
    assert seen.overlapWorst == pytest.approx(0.01, rel=1e-9) and seen.overlapWorstEver == pytest.approx(0.02, rel=1e-9)
    # drawn apart, bonds bear a force and touch
    for k in (1, 3, 5):
        O.bodies[ids[k]].state.pos += (0.03, 0, 0)
    run(2)
    assert seen.contacts == seen.bonds > 0 and seen.overlapMean == 0.0 == seen.overlapWorst


def test_without_contacts_there_is_no_overlap():
    """YADE knows a pair of which boxes alone meet; it is none."""
    seen, ids = begin([(0, 0, 0.5), (1.35, 0, 0.8)])
    assert seen.bond() == 0
    run(1)
    assert O.interactions.has(*ids, False) and not O.interactions[ids[0], ids[1]].isReal
    assert (seen.contacts, seen.bonds, seen.overlapMean, seen.overlapWorst, seen.overlapWorstEver) == (0, 0, 0, 0, 0)
    assert all(len(tables.contacts(seen)[name]) == 0 for name in ("id1", "normal"))
    assert tables.breaks(seen)["step"].tolist() == [] and seen.forgetEnergies() is None


def test_bonds_of_disks_that_are_taken_out_have_not_broken():
    """Of three bonds in a row the end one goes with its disk; one that is drawn apart then is the only one that
    broke, and the last stays.
    """
    seen, ids = begin([(float(k), 0, 0.5) for k in range(4)])
    assert seen.bond() == 3
    for k in ids:
        O.bodies[k].state.blockedDOFs = "xyzXYZ"
    run(2)
    O.bodies.erase(ids[0])
    seen.forget_bodies([ids[0]])
    assert seen.disks["id"].tolist() == ids[1:]  # the table is read anew in the same step
    run(1)
    assert (seen.bonds, broken(seen)) == (2, {})
    O.bodies[ids[3]].state.vel = (5.0, 0, 0)
    for _ in range(4000):
        run(1)
        if seen.bonds == 1:
            break
    assert (seen.bonds, broken(seen)) == (1, {"brokenTension": 1})
    assert tables.breaks(seen)["id1"].tolist() == [ids[2]]


def test_masses_follow_the_disks_that_are_there():
    """A disk that is added is counted with its own mass."""
    seen, ids = begin([(0, 0, 0.5), (3, 0, 0.5)])
    assert seen.disks is seen.disks  # read once a step
    assert seen.disks["mass"].tolist() == pytest.approx([2500 * math.pi * 0.25] * 2, rel=1e-12)
    assert seen.centroid == pytest.approx((1.5, 0.0))
    O.bodies[ids[0]].state.vel = (1.0, 0, 0)
    O.step()
    assert seen.disks["mass"].tolist() == pytest.approx([2500 * math.pi * 0.25] * 2, rel=1e-12)
    assert seen.disks["x"].tolist() == pytest.approx([O.dt, 3.0]) and seen.disks["vx"].tolist() == [1.0, 0.0]
    O.bodies[ids[0]].state.pos, O.bodies[ids[0]].state.vel = (0, 0, 0), (0, 0, 0)
    O.step()
    more = O.bodies.append(scene.disk((3.0, 3.0), 1.0, O.bodies[ids[0]].material))
    assert seen.disks["id"].tolist() == [*ids, more]
    assert seen.disks["mass"].tolist() == pytest.approx([2500 * math.pi * r * r for r in (0.5, 0.5, 1.0)], rel=1e-12)
    assert seen.disks["inertia"].tolist() == pytest.approx(
        [1250 * math.pi * r**4 for r in (0.5, 0.5, 1.0)], rel=1e-12
    )
    assert seen.centroid == pytest.approx((0.25 * 3 / 1.5 + 3 / 1.5, 3 / 1.5), rel=1e-12)


def test_contacts_that_lose_their_bond_get_the_residual_friction_once():
    """Looking does the work of the engine that would, which is put to sleep: 0.3 of the rock for the bond's 0.5."""
    seen, ids = begin([(0, 0, 0.5), (0, 0.99, 0.5)], world=dataclasses.replace(WORLD, fragile=True))
    assert [e.dead for e in O.engines if e.label == "softResidual"] == [True]
    assert seen.bond() == 1
    (contact,) = [i.phys for i in O.interactions if i.isReal]
    assert contact.tangensOfFrictionAngle == pytest.approx(0.5)
    for k, speed in zip(ids, (0.0, 0.5)):
        O.bodies[k].state.blockedDOFs, O.bodies[k].state.vel = "xyzXYZ", (speed, 0, 0)
    while bonded(contact):
        O.step()
        assert O.iter < 4000
    assert contact.tangensOfFrictionAngle == pytest.approx(0.5)  # as YADE leaves it
    seen.look()
    assert contact.tangensOfFrictionAngle == pytest.approx(0.3)
    contact.tangensOfFrictionAngle = 0.7  # by a script since
    O.step()
    assert seen.contacts == 1 and contact.tangensOfFrictionAngle == pytest.approx(0.7)
