"""Water in the slope: forces below the table, the table's height in time, release after D_c, save and load."""
import math

import numpy as np
import pytest
from yade import O
from yade.minieigenHP import Vector3
from yade.nonsmooth import pore_pressure, scene, tables
from yade.wrapper import NewtonIntegrator, PorePressureEngine, SlipWeakeningMat

from contact_scenes import G, begin, contacts, material, run

WATER = 9810
DIP = math.radians(21)
NORMAL = Vector3(math.sin(DIP), math.cos(DIP), 0)
DOWN = Vector3(math.cos(DIP), -math.sin(DIP), 0)


pytestmark = pytest.mark.usefixtures("empty")


def water(heights=(10,), times=(0,), normal=NORMAL, **more):
    return PorePressureEngine(
        unitWeight=WATER, planeNormal=normal, heights=list(heights), times=list(times), label="water", **more
    )


def disks_above_plane(places, radius=0.5, gravity=(0, -G, 0), apart=3.0, **more):
    """Disks whose centres stand at these heights above the dipping plane through the origin, far from each other, and
    water.
    """
    stuff = material(0.3)
    ids = [
        O.bodies.append(scene.disk(tuple(h * NORMAL - apart * k * DOWN)[:2], radius, stuff))
        for k, h in enumerate(places)
    ]
    begin(gravity=gravity, before=[water(**more)])
    return ids


def test_force_acts_below_the_table_along_the_planes_normal():
    wet, dry = disks_above_plane([9.999, 10.001])
    run(1)
    w = O.engines[3]
    expected = WATER * math.cos(DIP) * math.pi * 0.25 * NORMAL
    assert (w.totalForce - expected).norm() < 1e-12 * expected.norm()
    assert w.wetCount == 1 and w.isWet(wet) and not w.isWet(dry) and w.releasedCount == 0
    mass = O.bodies[wet].state.mass
    expected_velocity = (expected / mass + Vector3(0, -G, 0)) * O.dt
    assert (O.bodies[wet].state.vel - expected_velocity).norm() < 1e-13
    assert O.bodies[dry].state.vel[1] == pytest.approx(-G * O.dt, rel=1e-12) and O.bodies[dry].state.vel[0] == 0


def test_force_follows_size_thickness_and_volume_factor():
    disks_above_plane([5], radius=0.7, thickness=2, volumeFactor=1 / 0.84)
    run(1)
    expected = WATER * math.cos(DIP) * math.pi * 0.49 * 2 / 0.84
    assert O.engines[3].totalForce.norm() == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("mask, wet", [(0, (1, 1, 1)), (1, (1, 0, 1)), (2, (0, 1, 1)), (4, (0, 0, 0))])
def test_a_gradient_acts_as_it_is_on_the_bodies_of_a_mask(mask, wet):
    stuff, gradient, factor, thickness = material(0.3), Vector3(4000, -1500, 0), 1.3, 1.7
    radii, groups = (0.5, 0.8, 0.3), (1, 2, 3)
    ids = [O.bodies.append(scene.disk((3 * k, 1 - k), r, stuff)) for k, r in enumerate(radii)]
    for k, group in zip(ids, groups):
        O.bodies[k].mask = group
    high = O.bodies.append(scene.disk((-3, 60), 0.5, stuff))
    begin(before=[water(pressureGradient=gradient, mask=mask, volumeFactor=factor, thickness=thickness)])
    run(1)
    w, total = O.engines[3], Vector3(0, 0, 0)
    for k, r, in_it in zip(ids, radii, wet):
        s, force = O.bodies[k].state, -in_it * gradient * math.pi * r**2 * thickness * factor  # −∇p V
        total += force
        assert (s.vel - O.dt * (force / s.mass + Vector3(0, -G, 0))).norm() < 1e-13 and w.isWet(k) == bool(in_it)
    assert (w.totalForce - total).norm() < 1e-12 * gradient.norm() and w.wetCount == sum(wet)
    assert not w.isWet(high) and O.bodies[high].state.vel[0] == 0  # above the table


def force_of(**more):
    """Force on a disk by the water, its components' bits and all; and the engine."""
    O.reset()
    disks_above_plane([5], **more)
    run(1)
    return [c.hex() for c in O.engines[3].totalForce], O.engines[3]


def test_the_gradient_of_flow_along_the_plane_is_that_which_is_taken_without_one():
    own, _ = force_of()
    given, _ = force_of(pressureGradient=-(WATER * math.cos(DIP)) * NORMAL.normalized())
    assert [float.fromhex(c) for c in given] == pytest.approx([float.fromhex(c) for c in own], rel=1e-14)
    # still water lifts by the displaced weight, straight up
    still, _ = force_of(pressureGradient=(0, -WATER, 0))
    assert still == [c.hex() for c in (0.0, WATER * (math.pi * 0.5 * 0.5), 0.0)]


def test_the_old_name_is_the_force_per_volume_and_warns(capfd):
    new, w = force_of(pressureGradient=(-4000, 1500, 0))
    assert "old name" not in capfd.readouterr().err
    old, w = force_of(gradient=(4000, -1500, 0))
    said = capfd.readouterr().err
    assert old == new and "old name" in said and "pressureGradient=(-4000, 1500, 0)" in said
    assert [c.hex() for c in w.pressureGradient] == [c.hex() for c in (-4000.0, 1500.0, 0.0)]
    w.gradient = (0, 7, 0)
    assert "pressureGradient=(0, -7, 0)" in capfd.readouterr().err
    assert tuple(w.pressureGradient) == (0, -7, 0) and tuple(w.gradient) == (0, 7, 0)
    assert "gradient" not in w.dict()  # nor is it saved


def test_a_disk_that_may_not_move_at_all_stays_dry_and_one_that_may_turn_does_not():
    ids = disks_above_plane([5, 5, 5])
    for k, blocked in zip(ids, ("xyzXYZ", "xyzXY", "xzXYZ")):
        O.bodies[k].state.blockedDOFs = blocked
    run(1)
    assert [O.engines[3].isWet(k) for k in ids] == [False, True, True]


def test_plane_may_stand_anywhere_and_walls_stay_dry():
    stuff = material(0.3)
    fixed = O.bodies.append(scene.disk((0, 4), 0.5, stuff, fixed=True))
    a, b = (O.bodies.append(scene.disk((3 * k, 7 + k), 0.5, stuff)) for k in (1, 2))
    begin(before=[water((2.5,), normal=Vector3(0, 2, 0), planePoint=(100, 6, 0))])  # the normal need not be of length 1
    run(1)
    w = O.engines[3]
    assert w.isWet(a) and not w.isWet(b) and not w.isWet(fixed) and w.wetCount == 1
    assert w.totalForce[1] == pytest.approx(WATER * math.pi * 0.25, rel=1e-12)


def test_table_of_heights_is_linear_between_and_constant_outside():
    w = water((0, 10, 4), (2, 4, 8))
    for time, height in [(-1, 0), (0, 0), (2, 0), (2.5, 2.5), (4, 10), (6, 7), (8, 4), (100, 4)]:
        assert w.heightAt(time) == pytest.approx(height, abs=1e-14)
    assert water((), ()).heightAt(5) == 0
    assert water((3,), (7,)).heightAt(0) == 3
    with pytest.raises(Exception, match="times has 2"):
        water((1,), (0, 1)).heightAt(0)
    with pytest.raises(Exception, match="rise"):
        water((1, 2), (1, 0)).heightAt(0)


def test_rising_water_wets_one_disk_after_the_other():
    ids = disks_above_plane([1, 2, 3, 4], gravity=(0, 0, 0), heights=(0, 5), times=(0, 1))
    w = O.engines[3]
    w.unitWeight = 0  # nothing moves
    for height in (0.5, 1.5, 2.5, 3.5, 4.5):
        while O.time < height / 5:
            run(1)
        run(1)
        assert w.height == pytest.approx(5 * (O.time - O.dt), abs=1e-12)  # that of the step's beginning
        assert w.wetCount == int(height) and w.isWet(ids[0]) == (height > 1)


def test_dry_without_gravity_or_table():
    disks_above_plane([5], heights=(0,))
    run(1)
    assert O.engines[3].wetCount == 0 and O.engines[3].totalForce.norm() == 0


def test_release_is_for_good_after_the_distance_downslope():
    ids = disks_above_plane([5, 5], releaseDistance=0.5)
    w, (mover, other) = O.engines[3], ids
    w.unitWeight = 1e-9  # a force too small to matter
    next(e for e in O.engines if isinstance(e, NewtonIntegrator)).gravity = (0, -1e-9, 0)
    O.bodies[mover].state.vel = 1.0 * DOWN
    O.bodies[other].state.vel = 1.0 * NORMAL  # along the normal is not downslope, and upslope is not either
    run(495)
    assert w.releasedCount == 0 and w.wetCount == 2
    run(10)
    assert w.isReleased(mover) and not w.isReleased(other)
    assert w.releasedCount == 1 and w.wetCount == 1 and not w.isWet(mover)
    wet, released, ever_wet = tables.water(w, mover, 2)
    assert list(wet) == [False, True] and list(released) == [True, False] and list(ever_wet) == [True, True]
    assert not np.any(tables.water(w, other + 1, 2)) and not np.any(tables.water(None, mover, 2))
    O.bodies[mover].state.vel = -1.0 * DOWN
    O.bodies[other].state.vel = -1.0 * DOWN
    run(900)
    assert w.isReleased(mover) and w.releasedCount == 1  # back where it came from, and still released
    assert not w.isWet(mover)
    w.forgetReleases()
    run(1)
    assert w.releasedCount == 0 and w.wetCount == 2


def test_released_are_those_alone_that_were_wet():
    """Two disks go down the slope, one below and one above the table. The dry one stays dry, also where the table
    passes it later.
    """
    below, above, still = disks_above_plane([5, 15, 5], releaseDistance=0.5, heights=(10, 10, 30), times=(0, 1, 2))
    w = O.engines[3]
    w.unitWeight = 1e-9  # a force too small to matter
    next(e for e in O.engines if isinstance(e, NewtonIntegrator)).gravity = (0, -1e-9, 0)
    for k in (below, above):
        O.bodies[k].state.vel = 1.0 * DOWN
    run(600)

    def told():
        return [tuple(map(bool, row)) for row in zip(*tables.water(w, below, 3))]

    # wet, released, ever wet
    dry, released, wet = (False, False, False), (False, True, True), (True, False, True)
    assert told() == [released, dry, wet] and (w.releasedCount, w.wetCount) == (1, 1)
    run(1500)  # the table stands above all of them
    assert told() == [released, dry, wet] and (w.releasedCount, w.wetCount) == (1, 1)
    assert not w.isReleased(above) and not w.wasWet(above) and w.wasWet(below) and w.isReleased(below)
    w.forgetReleases()
    run(1)
    assert told() == [wet, wet, wet] and w.releasedCount == 0  # ways are counted anew


def test_what_was_wet_is_forgotten_with_the_ways():
    """A disk that was wet, and is dry when ways are counted anew, counts as one that never was: going down the slope it
    is not released.
    """
    (disk,) = disks_above_plane([5], releaseDistance=0.5, heights=(10, 10, 0, 0), times=(0, 0.05, 0.06, 1))
    w = O.engines[3]
    w.unitWeight = 1e-9  # a force too small to matter
    next(e for e in O.engines if isinstance(e, NewtonIntegrator)).gravity = (0, 0, 0)
    run(100)

    def told():
        return tuple(bool(part[0]) for part in tables.water(w, disk, 1))

    # wet, released, ever wet
    assert w.wasWet(disk) and not w.isWet(disk) and told() == (False, False, True)
    w.forgetReleases()
    assert not w.wasWet(disk) and not w.isReleased(disk) and told() == (False, False, False)
    O.bodies[disk].state.vel = 2.0 * DOWN
    run(400)  # 0.8 m
    assert not w.wasWet(disk) and not w.isReleased(disk) and w.releasedCount == 0 and told() == (False, False, False)


def test_a_released_share_takes_its_part_of_the_force():
    """Of three disks; bodies beyond the end of the list keep all of it."""
    ids = disks_above_plane([5, 5, 5], releasedShare=[0.25, 1.0])
    run(1)
    w = O.engines[3]
    whole = WATER * math.cos(DIP) * math.pi * 0.25 * NORMAL
    for k, acting in zip(ids, (0.75, 0, 1)):
        s = O.bodies[k].state
        assert (s.vel - O.dt * (acting * whole / s.mass + Vector3(0, -G, 0))).norm() < 1e-13
    assert (w.totalForce - 1.75 * whole).norm() < 1e-12 * whole.norm() and w.wetCount == 2
    assert [w.isWet(k) for k in ids] == [True, False, True]
    # released are those that were wet; this one never was
    assert not any(w.isReleased(k) for k in ids) and w.releasedCount == 0


def test_a_share_of_none_has_the_bits_of_no_list():
    assert force_of(releasedShare=[0.0])[0] == force_of()[0]


def test_a_share_may_come_back_and_is_forgotten_with_the_ways():
    ids = disks_above_plane([5, 5])
    w = O.engines[3]
    run(1)
    pore_pressure.release(w, ids[0], [1.0, 0.5])
    run(1)
    assert w.isReleased(ids[0]) and w.releasedCount == 1 and w.wetCount == 1
    assert tables.released_shares(w, ids[0], 2).tolist() == [1.0, 0.5]
    assert tables.released_shares(w, ids[1], 4).tolist() == [0.5, 0, 0, 0]
    assert tables.released_shares(None, 0, 2).tolist() == [0, 0]
    pore_pressure.release(w, ids[0], [0.9, 0.5])
    run(1)
    assert not w.isReleased(ids[0]) and w.isWet(ids[0]) and w.releasedCount == 0
    w.forgetReleases()
    run(1)
    assert tables.released_shares(w, ids[0], 2).tolist() == [0, 0]


@pytest.mark.parametrize("shares", [[0.5, 1.01], [-0.1], [math.nan], [[0.5]], 0.5])
def test_what_is_no_share_is_refused(shares):
    ids = disks_above_plane([5, 5])
    run(1)
    with pytest.raises(pore_pressure.PorePressureError, match="give a number from 0 to 1 for each body"):
        pore_pressure.release(O.engines[3], ids[0], shares)
    assert list(O.engines[3].releasedShare) == []
    if np.ndim(shares) == 1:
        O.engines[3].releasedShare = shares
        with pytest.raises(ValueError, match=r"releasedShare\[\d\] = .*: give a share from 0 to 1"):
            run(1)


def test_saved_and_loaded(tmp_path):
    ids = disks_above_plane([5, 15, 20, 5], releaseDistance=0.2, heights=(8, 12), times=(0, 10))
    O.bodies[ids[0]].state.vel = O.bodies[ids[1]].state.vel = 2.0 * DOWN
    run(150)
    O.engines[3].releasedShare = [0, 0, 0, 0.3]
    saved = str(tmp_path / "water.yade.gz")
    O.save(saved)
    run(200)
    unbroken = (
        [(O.bodies[i].state.pos, O.bodies[i].state.vel) for i in ids],
        O.engines[3].releasedCount,
        O.engines[3].height,
    )
    O.reset()
    O.load(saved)
    w = O.engines[3]
    assert w.label == "water" and w.isReleased(ids[0]) and w.heights == [8, 12]
    assert list(w.releasedShare) == [0, 0, 0, 0.3]
    w.heights = [0, 0]  # who was wet before is known from the file
    run(1)
    assert [w.isReleased(i) for i in ids] == [True, False, False, False] and w.releasedCount == 1
    assert [w.wasWet(i) for i in ids] == [True, False, False, True]
    w.heights = [8, 12]
    O.reset()
    O.load(saved)
    w = O.engines[3]
    run(200)
    assert ([(O.bodies[i].state.pos, O.bodies[i].state.vel) for i in ids], w.releasedCount, w.height) == unbroken


def test_buoyancy_lightens_a_disk_on_a_level_floor():
    stuff = material(0.3)
    floor = O.bodies.append(scene.segments([(-2, 0), (2, 0)], stuff))[0]
    O.bodies.append(scene.disk((0, 0.5), 0.5, stuff))
    begin(before=[water((10,), normal=Vector3(0, 1, 0))])
    run(50)
    # Archimedes: (ρ g − γ_w) π r², to the tolerance of the solve
    expected = (2500 * G - WATER) * math.pi * 0.25
    assert -O.forces.f(floor)[1] == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("height, slides", [(10, True), (0.2, False)])
def test_water_lets_a_block_slide(height, slides):
    # eq. (7): the normal force falls by γ_w cos β V, and with it the friction; on 21° with μ = 0.45 a dry block stays
    mu = 0.45
    wall = material(mu, kind=SlipWeakeningMat, criticalSlip=50)
    O.bodies.append(scene.segments([(0, 0), tuple(5 * DOWN)[:2]], wall, piece=0.5))
    block = O.bodies.append(scene.disk(tuple(0.3 * DOWN + 0.5 * NORMAL)[:2], 0.5, wall))
    s = O.bodies[block].state
    s.blockedDOFs = "zXYZ"
    begin(before=[water((height,))])
    run(500)
    relief = WATER / (2500 * G)
    a = G * (math.sin(DIP) - mu * math.cos(DIP) * (1 - relief)) if slides else 0
    assert (a > 0.3) == slides
    assert s.vel.dot(DOWN) == pytest.approx(a * O.time, rel=1e-9, abs=1e-12)
    weight = s.mass * G * math.cos(DIP)
    assert contacts()[0].phys.normal == pytest.approx(weight * (1 - relief if slides else 1), rel=1e-9)
