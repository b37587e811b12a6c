"""PlanarGridCollider: the same contacts as with YADE's own collider and loop, and none that brute force would not
find.
"""
import math
import random

import pytest
from yade import O
from yade.nonsmooth import scene
from yade.wrapper import (
    Box,
    Body,
    Bo1_Box_Aabb,
    Bo1_Sphere_Aabb,
    BoxFactory,
    Collider,
    Ig2_Box_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    PlanarGridCollider,
    Sphere,
)

from contact_scenes import begin, bits, box, engine, loose_heap, material, run

REACH = 0.05


pytestmark = pytest.mark.usefixtures("empty")


def collider():
    return next(e for e in O.engines if isinstance(e, Collider))


def gas(count=150, side=30.0, speed=20.0, seed=3, far=None):
    """Disks of sizes one to ten that fly about in a box, by up to a radius a step: the small ones become faster than
    they begin. Returns their ids.
    """
    dice = random.Random(seed)
    stuff = material(0.3, restitution=1.0)
    box(stuff, side, side)
    ids = []
    while len(ids) < count:
        r = 0.2 * 10 ** dice.uniform(0, 1) if len(ids) % 9 == 0 else 0.2 * dice.uniform(1, 2)
        x, y = dice.uniform(r, side - r), dice.uniform(r, side - r)
        if all(
            math.hypot(x - O.bodies[i].state.pos[0], y - O.bodies[i].state.pos[1]) > r + O.bodies[i].shape.radius
            for i in ids
        ):
            ids.append(O.bodies.append(scene.disk((x, y), r, stuff)))
            turn = dice.uniform(0, 2 * math.pi)
            O.bodies[ids[-1]].state.vel = (speed * math.cos(turn), speed * math.sin(turn), 0)
    begin(gravity=(0, 0, 0), dt=5e-3, reach=REACH, far=far, verlet=0.3, tolerance=1e-6, maxIterations=2000)
    return ids


def near(ids):
    """Pairs of disks within reach, by brute force."""
    rows = [(i, O.bodies[i].state.pos[0], O.bodies[i].state.pos[1], O.bodies[i].shape.radius) for i in ids]
    return {
        (i, j)
        for k, (i, x, y, r) in enumerate(rows)
        for j, u, v, s in rows[k + 1 :]
        if math.hypot(x - u, y - v) <= (1 + REACH) * (r + s)
    }


def near_or_fast(ids, far):
    """Pairs of disks within ``far`` that are within reach, or may be in two steps by the speed of one of them against a
    disk that it may meet so soon.
    """
    rows = [
        (i, *tuple(O.bodies[i].state.pos)[:2], O.bodies[i].shape.radius, *tuple(O.bodies[i].state.vel)[:2]) for i in ids
    ]
    fastest, gaps = dict.fromkeys(ids, 0.0), {}
    for k, (i, x, y, r, vx, vy) in enumerate(rows):
        for j, u, v, s, wx, wy in rows[k + 1 :]:
            gap = math.hypot(x - u, y - v) - (r + s)
            if gap > far * (r + s):
                continue
            gaps[i, j], speed = (gap, r + s), math.hypot(vx - wx, vy - wy)
            for one in (i, j) if gap <= REACH * (r + s) + 2 * O.dt * speed else ():
                fastest[one] = max(fastest[one], speed)
    return {
        (i, j)
        for (i, j), (gap, length) in gaps.items()
        if gap <= REACH * length + 2 * O.dt * max(fastest[i], fastest[j])
    }


def disk_pairs(real=True):
    """Pairs of disks that have an interaction that is real, or potential."""

    def both(i):
        return isinstance(O.bodies[i.id1].shape, Sphere) and isinstance(O.bodies[i.id2].shape, Sphere)

    return {(min(i.id1, i.id2), max(i.id1, i.id2)) for i in O.interactions.all() if i.isReal == real and both(i)}


def step(ids):
    """A step; returns the pairs within reach at its beginning, by brute force."""
    expected = near(ids)
    O.step()
    return expected


def test_disks_have_the_contacts_that_brute_force_finds():
    ids = gas()
    seen = set()
    for _ in range(200):
        expected = step(ids)
        assert disk_pairs() == expected
        seen |= expected
    # contacts came and went; and pairs were kept over some steps
    assert len(seen) > 300 and 20 < collider().searches < 201


def test_far_disks_have_contacts_while_they_are_fast():
    far, seen = 1.5, set()
    ids = gas(far=far)
    for _ in range(100):
        expected, close = near_or_fast(ids, far), near(ids)
        O.step()
        assert disk_pairs() == expected
        seen |= expected - close
    assert len(seen) > 100
    for i in ids:
        O.bodies[i].state.vel = (0, 0, 0)
    expected = step(ids)  # the slow have those within reach alone
    assert disk_pairs() == expected


@pytest.mark.parametrize("speed", [5.0, 40.0])
def test_leaving_far_slow_disks_out_changes_no_bit(speed):
    found = []
    for sure in (REACH, 1.5):
        O.reset()
        gas(far=1.5, speed=speed)
        collider().sureReach = sure
        run(150)
        found.append((engine().bodyTable(), len(O.interactions)))
    assert found[0][0] == found[1][0]
    assert found[0][1] < found[1][1]


def test_a_disk_that_is_hit_meets_the_next_one_in_the_same_step():
    stuff = material(0.3, restitution=1.0)
    for x, v in ((0, 60.0), (1.1, 0), (2.3, 0)):
        O.bodies.append(scene.disk((x, 0), 0.5, stuff))
        O.bodies[-1].state.vel = (v, 0, 0)
    begin(gravity=(0, 0, 0), dt=5e-3, reach=REACH, far=0.6)
    O.step()  # 0.3 m are enough to hit the second, whose gap to the third is 0.2 m
    assert disk_pairs() == {(0, 1), (1, 2)}
    run(5)
    assert engine().overlapWorst < 1e-6


def test_bodies_that_vanish_and_appear_are_noticed():
    ids = gas(count=80)
    for k in range(60):
        if k % 10 == 5:
            O.bodies.erase(ids.pop(k % len(ids)))
        if k % 10 == 7:
            x, y, _ = O.bodies[ids[0]].state.pos
            ids.append(O.bodies.append(scene.disk((x + 0.3, y), 0.1, O.bodies[ids[0]].material)))  # on top of another
        expected = step(ids)
        assert disk_pairs() == expected


def test_interactions_that_a_script_erases_come_back():
    stuff = material(0.3)
    a, b = (O.bodies.append(scene.disk((x, 0), 0.5, stuff)) for x in (0, 1.01))
    begin(gravity=(0, 0, 0))
    run(2)
    assert O.interactions.has(a, b, True)
    O.interactions.erase(a, b)
    run(1)
    assert O.interactions.has(a, b, True)
    O.interactions.clear()
    run(1)
    assert O.interactions.has(a, b, True)
    O.interactions.erase(a, b)
    O.interactions.eraseNonReal()
    run(1)
    assert O.interactions.has(a, b, True)


def test_masks_are_heeded():
    stuff = material(0.3)
    a, b = (O.bodies.append(scene.disk((x, 0), 0.5, stuff)) for x in (0, 0.98))
    O.bodies[a].mask, O.bodies[b].mask = 1, 2
    begin(gravity=(0, 0, 0))
    run(3)
    assert len(O.interactions.all()) == 0


def test_potential_interactions_exist_with_walls_alone():
    gas(count=60)
    before, potential = set(), 0
    for _ in range(100):
        O.step()
        apart = disk_pairs(real=False)
        assert apart <= before  # what came apart in this step; the next one erases it
        before = disk_pairs()
        potential += len([i for i in O.interactions.all() if not i.isReal]) - len(apart)
    assert potential > 0


def test_potential_interactions_with_walls_end_when_disks_have_left():
    gas(count=60)
    largest = max(b.shape.radius for b in O.bodies if isinstance(b.shape, Sphere))
    left, before = 0, set()
    for _ in range(150):
        O.step()
        potential = set()
        for i in O.interactions.all():
            wall, disk = sorted((O.bodies[i.id1], O.bodies[i.id2]), key=lambda b: isinstance(b.shape, Sphere))
            if i.isReal or isinstance(wall.shape, Sphere):
                continue
            along = wall.state.ori * (wall.shape.halfLength, 0, 0)
            low, high = ([sign * abs(along[k]) + wall.state.pos[k] for k in (0, 1)] for sign in (-1, 1))
            apart = max(max(low[k] - disk.state.pos[k], disk.state.pos[k] - high[k], 0) for k in (0, 1))
            # along each axis within reach of the box and half a square's margin when pairs were looked up, and a
            # quarter gone since, and the step that was made after the collider
            assert (
                apart
                <= (2 * (1 + REACH) - 1) * disk.shape.radius
                + 3 * (1 + REACH) * largest / 2
                + O.dt * disk.state.vel.norm()
            )
            potential.add((wall.id, disk.id))
        left += len(before - potential)
        before = potential
    assert left > 10


def swapped(kind_of_collider=None, kind_of_loop=None):
    """Puts YADE's own engines in the place of ours."""
    engines = list(O.engines)
    for k, e in enumerate(engines):
        if kind_of_collider and isinstance(e, Collider):
            engines[k] = kind_of_collider(e.boundDispatcher.functors, verletDist=e.verletDist)
        if kind_of_loop and isinstance(e, InteractionLoop):
            engines[k] = kind_of_loop(e.geomDispatcher.functors, e.physDispatcher.functors, e.lawDispatcher.functors)
    O.engines = engines


@pytest.mark.parametrize("scene_of", ["gas", "heap"])
def test_every_pair_of_colliders_and_loops_has_the_same_bits(scene_of):
    def course(*kinds):
        O.reset()
        if scene_of == "gas":
            gas(count=100)
        else:
            stuff = material(0.3, rolling=0.1)
            box(stuff, 9, 6)
            loose_heap(stuff)
            begin(dt=4e-3, tolerance=1e-8)
        swapped(*kinds)
        run(250)
        return bits(), engine().totalIterations

    ours = course()
    assert ours[1] > 250
    assert course(InsertionSortCollider) == ours
    assert course(None, InteractionLoop) == ours
    assert course(InsertionSortCollider, InteractionLoop) == ours


def test_the_margin_changes_no_bit():
    found = []
    for margin in (0.0, 0.5, 3.0, -1.0):
        O.reset()
        gas(count=100, speed=4.0)  # slow enough that the margin decides when pairs are looked up
        collider().verletDist = margin
        run(120)
        found.append((bits(), collider().searches))
    assert len({b for b, _ in found}) == 1
    assert 5 < found[2][1] < found[1][1] < found[0][1] < 120


def test_a_loaded_scene_goes_on_with_the_same_bits(tmp_path):
    gas(count=100, far=1.5)
    run(60)
    O.save(str(tmp_path / "gas.yade.gz"))
    run(60)
    whole = bits()
    O.load(str(tmp_path / "gas.yade.gz"))
    run(60)
    assert bits() == whole


def test_moving_bodies_of_other_shapes_keep_their_contacts():
    stuff = material(0.3)
    plate = Body()
    plate.shape = Box(extents=(1, 0.5, 1))
    plate.material = stuff
    O.bodies.append(plate)
    plate.dynamic = False
    plate.state.vel = (5, 0, 0)  # passes over disks that rest
    ids = [O.bodies.append(scene.disk((3 + 1.2 * k, 0.99), 0.5, stuff)) for k in range(4)]
    begin(gravity=(0, 0, 0), dt=5e-3)
    O.engines = [
        PlanarGridCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.05), Bo1_Box_Aabb()], verletDist=0.05)
        if isinstance(e, Collider)
        else e
        for e in O.engines
    ]
    loop = next(e for e in O.engines if isinstance(e, InteractionLoop))
    loop.geomDispatcher.functors = list(loop.geomDispatcher.functors) + [Ig2_Box_Sphere_ScGeom()]
    met = set()
    for _ in range(320):
        O.step()
        for i in O.interactions:
            met |= {i.id1, i.id2} & set(ids)
    # those behind the plate are forgotten
    assert met == set(ids) and len([i for i in O.interactions.all() if 0 in (i.id1, i.id2)]) < 4


@pytest.mark.parametrize(
    "spoil, words",
    [
        (lambda: setattr(O, "periodic", True), ("periodic", "O.periodic = False")),
        (lambda: setattr(collider(), "verletDist", math.nan), ("verletDist", "nan")),
        (lambda: setattr(collider(), "sureReach", -0.1), ("sureReach", "-0.1", "not negative")),
    ],
)
def test_refuses_what_it_cannot_do(spoil, words):
    O.bodies.append(scene.disk((0, 0), 0.5, material()))
    begin(gravity=(0, 0, 0))
    spoil()
    with pytest.raises(RuntimeError) as error:
        O.step()
    assert all(word in str(error.value) for word in words)


def test_a_factory_of_yades_finds_the_places_that_are_free():
    """It asks the collider who has a part in a box, and takes one in which nobody has."""
    stuff = material(0.3)
    ids = [O.bodies.append(scene.disk((0, 0), 1.0, stuff, fixed=True))]
    O.bodies.append(scene.segments([(-3, -1.5), (3, -1.5)], stuff))
    begin(gravity=(0, 0, 0))
    factory = BoxFactory(extents=(2, 2, 0), center=(0, 0, 0), normal=(0, 0, 1), vMin=0, vMax=0, rMin=0.1, rMax=0.2)
    factory.massFlowRate, factory.materialId, factory.blockedDOFs, factory.maxParticles = 1e9, stuff.id, "xyzXYZ", 0
    for _ in range(15):
        run(1)
        factory.maxParticles += 1
        factory()
        assert len(factory.ids) == factory.maxParticles
    disks = [(*tuple(O.bodies[k].state.pos)[:2], O.bodies[k].shape.radius) for k in [*ids, *factory.ids]]
    assert all(math.hypot(x - u, y - v) > r + s for k, (x, y, r) in enumerate(disks) for u, v, s in disks[:k])
    assert all(abs(y + 1.5) > r for _, y, r in disks[1:])


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("wrong", [math.nan, math.inf])
@pytest.mark.parametrize("beside", [False, True])
def test_a_place_that_was_no_number_and_is_mended_has_contacts_again(axis, wrong, beside):
    stuff = material(0.5)
    O.bodies.append(scene.segments([(-5, 0), (5, 0)], stuff, sense=1))
    disk = O.bodies.append(scene.disk((0, 0.5), 0.5, stuff))
    if beside:
        O.bodies.append(scene.disk((2, 0.5), 0.5, stuff))
    begin()
    run(10)
    O.bodies[disk].state.pos = tuple(wrong if k == axis else v for k, v in enumerate((0, 0.5, 0)))
    with pytest.raises(RuntimeError):
        O.step()
    O.bodies[disk].state.pos, O.bodies[disk].state.vel = (0, 0.5, 0), (0, 0, 0)
    run(300)
    assert O.bodies[disk].state.pos[1] == pytest.approx(0.5, abs=1e-3)  # it lies on the floor


@pytest.mark.parametrize("wall", ["segment", "arc", "disk"])
@pytest.mark.parametrize("gap, near", [(0.09, 1), (0.11, 0), (0.3, 0)])
def test_what_is_farther_than_the_reach_is_no_contact_though_boxes_meet(wall, gap, near):
    """The reach is a tenth of a radius of 1 m; boxes are searched with a margin of half a metre."""
    stuff, rough = material(0.5), material(0.5)
    O.materials.append((stuff, rough))
    if wall == "segment":
        O.bodies.append(scene.segments([(-4, 0), (4, 0)], rough))
    elif wall == "arc":
        O.bodies.append(scene.arc((0, -5), 5.0, 0.3, math.pi - 0.3, rough, inside=False))
    else:
        O.bodies.append(scene.disk((0, -1), 1.0, rough, fixed=True))
    O.bodies.append(scene.disk((0, 1 + gap), 1.0, stuff))
    # between disks the reach is in parts of both radii
    O.engines, O.dt = scene.engines(gravity=(0, 0, 0), reach=0.05 if wall == "disk" else 0.1, verlet=0.5), 1e-3
    O.step()
    assert scene.contact_dynamics().candidates == near
