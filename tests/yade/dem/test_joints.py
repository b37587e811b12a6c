"""Walls that meet are one wall to a disk, however they were made; walls that do not meet are not."""
import math
import random

import numpy as np
import pytest
from yade import O
from yade.nonsmooth import scene

from contact_scenes import G, begin, contacts, material, run

pytestmark = pytest.mark.usefixtures("empty")

SPEED, DT, RADIUS, PIECE, COUNT = 3.0, 5e-3, 0.5, 0.3, 100
LEFT = -5.0
# what a solve leaves of the speed at TIGHT's tolerance of 1e-12, over 1,200 steps
KEPT = 1e-8


def ends(k):
    return [(LEFT + PIECE * k, 0), (LEFT + PIECE * (k + 1), 0)]


def roller(stuff, y=RADIUS):
    """A disk that rolls to the right without slip, on a floor below it or, for a negative y, under a ceiling."""
    i = O.bodies.append(scene.disk((0, y), RADIUS, stuff))
    O.bodies[i].state.vel, O.bodies[i].state.angVel = (SPEED, 0, 0), (0, 0, -math.copysign(SPEED / RADIUS, y))
    return i


def kept(i, steps=1200):
    """The share of its speed and of its spin that a disk has after so many steps, over 60 joints."""
    run(steps)
    state = O.bodies[i].state
    return state.vel[0] / SPEED, abs(state.angVel[2]) * RADIUS / SPEED


def one_by_one(stuff):
    for k in range(COUNT):
        O.bodies.append(scene.segments(ends(k), stuff, sense=1))


def in_another_order(stuff):
    order = list(range(COUNT))
    random.Random(3).shuffle(order)
    for k in order:
        O.bodies.append(scene.segments(ends(k), stuff, sense=1))


def to_and_fro(stuff):
    """Two-sided walls that are travelled either way."""
    for k in range(COUNT):
        O.bodies.append(scene.segments(ends(k)[:: -1 if k % 2 else 1], stuff))


def to_and_fro_one_sided(stuff):
    """Each acts upwards: to the left of one that goes to the right, to the right of one that comes back."""
    for k in range(COUNT):
        O.bodies.append(scene.segments(ends(k)[:: -1 if k % 2 else 1], stuff, sense=-1 if k % 2 else 1))


def to_rounding(stuff):
    dice = random.Random(5)
    for k in range(COUNT):
        line = [(x + dice.uniform(-1e-10, 1e-10), dice.uniform(-1e-10, 1e-10)) for x, _ in ends(k)]
        O.bodies.append(scene.segments(line, stuff, sense=1))


def polylines_and_single_ones(stuff):
    for k in range(0, COUNT, 4):
        O.bodies.append(scene.segments([ends(k)[0], ends(k + 1)[0], ends(k + 1)[1]], stuff, sense=1))
        O.bodies.append(scene.segments(ends(k + 2), stuff, sense=1))
        O.bodies.append(scene.segments(ends(k + 3), stuff, sense=1))


WAYS = [one_by_one, in_another_order, to_and_fro, to_and_fro_one_sided, to_rounding, polylines_and_single_ones]


@pytest.mark.parametrize("lay", WAYS, ids=lambda way: way.__name__)
def test_a_disk_keeps_its_speed_over_joints_of_walls_made(lay):
    """box2d #341, godot #89458: before walls found each other such a floor took 5 % of the speed."""
    stuff = material(0.3)
    lay(stuff)
    i = roller(stuff)
    begin(dt=DT)
    assert kept(i) == pytest.approx((1, 1), abs=KEPT)
    assert O.bodies[i].state.pos[1] == pytest.approx(RADIUS, abs=1e-8)


@pytest.mark.parametrize("size, far", [(1e-5, 0.0), (1e3, 0.0), (1.0, 1e5)])
def test_joints_of_walls_of_any_size_and_far_from_the_origin(size, far):
    """A grain of 10 µm, a disk of a kilometre, and a floor 100 km away, where a coordinate has 1e-11 m."""
    stuff = material(0.3)
    for k in range(30):
        line = [(far + 0.3 * size * (k + n) - size, 0.01 * far) for n in (0, 1)]
        O.bodies.append(scene.segments(line, stuff, sense=1))
    i = O.bodies.append(scene.disk((far, 0.01 * far + 0.5 * size), 0.5 * size, stuff))
    speed = 3 * math.sqrt(size)
    s = O.bodies[i].state
    s.vel, s.angVel = (speed, 0, 0), (0, 0, -speed / (0.5 * size))
    begin(dt=5e-3 * math.sqrt(size))
    O.engines[1].verletDist = -0.7
    run(400)
    assert s.vel[0] == pytest.approx(speed, rel=1e-7) and s.pos[0] - far > 15 * 0.3 * size


@pytest.mark.parametrize(
    "piece, lengths", [(None, [5.0]), (7.0, [5.0]), (5.0, [5.0]), (4.9, [2.5, 2.5]), (2.0, 3 * [5 / 3])]
)
def test_pieces_of_a_wall_are_as_few_as_their_length_allows(piece, lengths):
    bodies = scene.segments([(0, 0), (3, 4)], material(0.5), piece=piece)
    assert [2 * b.shape.halfLength for b in bodies] == pytest.approx(lengths)


def test_walls_that_come_during_the_run_join_those_that_are_there():
    stuff = material(0.3)
    for k in range(25):
        O.bodies.append(scene.segments(ends(k), stuff, sense=1))
    i = roller(stuff)
    begin(dt=DT)
    for k in range(25, COUNT):
        run(16)
        O.bodies.append(scene.segments(ends(k), stuff, sense=1))
    assert kept(i, 0) == pytest.approx((1, 1), abs=KEPT) and O.bodies[i].state.pos[0] > 50 * PIECE


def test_a_wall_that_was_erased_and_made_again_joins_again():
    stuff = material(0.3)
    floor = O.bodies.append(scene.segments([ends(0)[0], ends(COUNT - 1)[1]], stuff, piece=PIECE, sense=1))
    i = roller(stuff)
    begin(dt=DT)
    for k in range(20, 78):
        run(15)
        O.bodies.erase(floor[k])  # well ahead of the disk
        O.bodies.append(scene.segments(ends(k), stuff, sense=1))
    assert kept(i, 150) == pytest.approx((1, 1), abs=KEPT)


def test_joints_hold_after_loading(tmp_path):
    stuff = material(0.3)
    one_by_one(stuff)
    i = roller(stuff)
    begin(dt=DT)
    run(300)
    O.save(str(tmp_path / "half.yade.bz2"))
    run(900)
    straight = O.bodies[i].state.pos, O.bodies[i].state.vel, O.bodies[i].state.angVel
    O.load(str(tmp_path / "half.yade.bz2"))
    run(900)
    assert (O.bodies[i].state.pos, O.bodies[i].state.vel, O.bodies[i].state.angVel) == straight
    assert straight[1][0] == pytest.approx(SPEED, rel=KEPT)


def test_walls_that_move_together_stay_joined():
    """A floor of single segments that goes to the left and up, as a train: in its frame nothing happens."""
    stuff = material(0.3)
    one_by_one(stuff)
    floor = range(COUNT)
    for k in floor:
        O.bodies[k].state.vel = (-1.0, 0.3, 0)
    i = roller(stuff)
    O.bodies[i].state.vel = (SPEED - 1.0, 0.3, 0)
    begin(dt=DT)
    run(1200)
    assert O.bodies[i].state.vel[0] == pytest.approx(SPEED - 1, abs=SPEED * KEPT)
    assert O.bodies[i].state.vel[1] == pytest.approx(0.3, abs=1e-8)


def test_the_loop_of_yade_finds_joints_by_itself():
    from yade.wrapper import InsertionSortCollider, InteractionLoop, NewtonIntegrator

    stuff = material(0.3)
    one_by_one(stuff)
    i = roller(stuff)
    begin(dt=DT)
    ours = O.engines
    collider, loop = ours[1], ours[2]
    O.engines = [
        ours[0],
        InsertionSortCollider(collider.boundDispatcher.functors, verletDist=0.05),
        InteractionLoop(loop.geomDispatcher.functors, loop.physDispatcher.functors, loop.lawDispatcher.functors),
        ours[3],
        NewtonIntegrator(damping=0, gravity=(0, -G, 0)),
    ]
    assert kept(i) == pytest.approx((1, 1), abs=KEPT)


# ---- corners --------------------------------------------------------------------------------------


def course(line, piecemeal, start, velocity, steps=400, sense=1, mu=0.3):
    """Rows (x, y, vx, vy, ω) of a disk that goes along a line of walls."""
    O.reset()
    stuff = material(mu)
    if piecemeal:
        for a, b in zip(line, line[1:]):
            O.bodies.append(scene.segments([a, b], stuff, sense=sense))
    else:
        O.bodies.append(scene.segments(line, stuff, sense=sense))
    i = O.bodies.append(scene.disk(start, RADIUS, stuff))
    O.bodies[i].state.vel = (*velocity, 0)
    begin(dt=1e-3)
    rows = []
    for _ in range(steps // 10):
        run(10)
        s = O.bodies[i].state
        rows.append((*tuple(s.pos)[:2], *tuple(s.vel)[:2], s.angVel[2]))
    return rows


@pytest.mark.parametrize(
    "line, steps",
    [
        ([(-3, 0), (0, 0), (0, 3)], 800),  # into a right angle
        ([(-3, 0), (0, 0), (3, 1)], 1200),  # up a kink
        ([(-3, 0), (0, 0), (3, -1)], 1200),  # over a kink
        ([(-3, 0), (0, 0), (0, -3)], 1200),  # over an edge
        ([(-3, 0), (0, 0), (-2, -1)], 1200),  # round an acute tip
    ],
)
def test_corners_of_single_walls_are_those_of_a_polyline(line, steps):
    both = [course(line, piecemeal, (-0.5, RADIUS), (1.0, 0), steps) for piecemeal in (False, True)]
    assert both[0] == both[1]  # to the last bit: the same walls in the same order


@pytest.mark.parametrize("angle", [-60, -40, -5, 5, 40, 85])
def test_a_one_sided_tip_is_touched_from_all_sides(angle):
    """A corner that turns by more than 90°: from below the first wall only the later one is seen, and has the tip
    there.
    """
    stuff = material(0.0)
    for line in ([(-3, 0), (0, 0)], [(0, 0), (-2, -1)]):
        O.bodies.append(scene.segments(line, stuff, sense=1))
    way = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    i = O.bodies.append(scene.disk((0.6 * way[0], 0.6 * way[1]), RADIUS, stuff))
    O.bodies[i].state.vel = (-way[0], -way[1], 0)
    begin(dt=1e-3, gravity=(0, 0, 0))
    run(150)
    assert tuple(O.bodies[i].state.pos)[:2] == pytest.approx((RADIUS * way[0], RADIUS * way[1]), abs=1e-9)
    assert [j.id1 for j in contacts() if j.geom.owned] == [0 if angle > 0 else 1]


def test_an_edge_is_a_corner_again_where_its_neighbour_has_gone():
    """A gate in a floor opens: a disk at rest over it goes down between two edges, touching one or both, and never
    through them.
    """
    stuff = material(0.0)
    floor = O.bodies.append(scene.segments([(-3, 0), (-0.3, 0), (0.3, 0), (3, 0)], stuff, sense=1))
    i = O.bodies.append(scene.disk((0.05, RADIUS), RADIUS, stuff))
    begin(dt=1e-3)
    run(20)
    O.bodies.erase(floor[1])
    nearest = 1.0
    for _ in range(100):
        run(10)
        x, y = tuple(O.bodies[i].state.pos)[:2]
        nearest = min(nearest, *(math.hypot(x - edge, y) for edge in (-0.3, 0.3)))
    # it hangs between both, 0.4 m above their line (0.3² + 0.4² = 0.5²)
    assert RADIUS - 2e-3 < nearest < RADIUS + 1e-6
    assert tuple(O.bodies[i].state.pos)[:2] == pytest.approx((0, 0.4), abs=5e-3)


def test_walls_that_move_apart_come_apart():
    """Two halves of a floor; the right one slides away: the left one's end is a corner from then on, round which a disk
    falls.
    """
    stuff = material(0.0)
    for line in ([(-3, 0), (0, 0)], [(0, 0), (3, 0)]):
        O.bodies.append(scene.segments(line, stuff, sense=1))
    i = O.bodies.append(scene.disk((0.1, RADIUS), RADIUS, stuff))
    begin(dt=1e-3)
    O.bodies[1].state.vel = (4.0, 0, 0)
    nearest = 1.0
    for _ in range(120):
        run(10)
        x, y = tuple(O.bodies[i].state.pos)[:2]
        nearest = min(nearest, math.hypot(x, y)) if x > 0 and y > 0 else nearest
    assert nearest == pytest.approx(RADIUS, abs=2e-3)  # one end or the other; a step's overlap at 1 m/s
    assert O.bodies[i].state.pos[1] < 0


def test_walls_that_shrink_come_apart():
    """Both halves of a floor, each about its middle: a disk that lay on their joint goes down between two edges."""
    stuff = material(0.0)
    for line in ([(-3, 0), (0, 0)], [(0, 0), (3, 0)]):
        O.bodies.append(scene.segments(line, stuff, sense=1))
    i = O.bodies.append(scene.disk((0, RADIUS), RADIUS, stuff))
    begin(dt=1e-3)
    run(20)
    for wall in (0, 1):
        O.bodies[wall].shape.halfLength = 1.4  # of 1.5: each end draws back by 0.1
    run(300)
    # an error of a ten-thousandth of the diameter is left as it is
    assert tuple(O.bodies[i].state.pos)[:2] == pytest.approx((0, math.sqrt(RADIUS**2 - 0.1**2)), abs=2e-4)
    assert [j.id1 for j in contacts() if j.phys.normal > 0] == [0, 1]


# ---- what is no joint -----------------------------------------------------------------------------


def test_the_foot_of_a_wall_on_another_is_no_bump_on_its_other_side():
    """A T: walls stand on a ceiling; a disk rolls along below it, with weight upwards."""
    stuff = material(0.3)
    O.bodies.append(scene.segments([(-5, 0), (25, 0)], stuff))
    for k in range(60):
        O.bodies.append(scene.segments([(0.2 + 0.3 * k, 0), (0.2 + 0.3 * k, 2)], stuff))
    i = roller(stuff, -RADIUS)
    begin(dt=DT, gravity=(0, G, 0))
    assert kept(i, 1200) == pytest.approx((1, 1), abs=KEPT)


def test_a_wall_that_stands_on_a_floor_stops_a_disk():
    stuff = material(0.0)
    O.bodies.append(scene.segments([(-5, 0), (25, 0)], stuff))
    O.bodies.append(scene.segments([(2, 0), (2, 2)], stuff))
    i = O.bodies.append(scene.disk((0, RADIUS), RADIUS, stuff))
    O.bodies[i].state.vel = (SPEED, 0, 0)
    begin(dt=DT)
    run(300)
    assert O.bodies[i].state.pos[0] == pytest.approx(2 - RADIUS, abs=2e-3) and abs(O.bodies[i].state.vel[0]) < 1e-9
    assert sorted(round(j.geom.normal[0]) for j in contacts()) == [-1, 0]


def test_walls_that_cross_both_hold_and_go_on():
    """An X: no end meets another wall, so nothing is joined; a disk lies in its upper quarter."""
    stuff = material(0.0)
    for line in ([(-2, -2), (2, 2)], [(-2, 2), (2, -2)]):
        O.bodies.append(scene.segments(line, stuff))
    i = O.bodies.append(scene.disk((0.2, 1.2), RADIUS, stuff))
    begin(dt=1e-3)
    run(1500)
    # it slides to and fro without friction, from impact to impact without restitution: at rest in the middle
    assert tuple(O.bodies[i].state.pos)[:2] == pytest.approx((0, RADIUS * math.sqrt(2)), abs=2e-3)
    assert len(contacts()) == 2


@pytest.mark.parametrize("gap", [1e-3, 0.01])
def test_ends_that_do_not_meet_are_two_corners(gap):
    """Across a slit a disk sinks by less than gap²/8r, and a free end is a bump of a step's path: it is slower
    afterwards, as ever.
    """
    stuff = material(0.0)
    for line in ([(-3, 0), (0, 0)], [(gap, 0), (3, 0)]):
        O.bodies.append(scene.segments(line, stuff))
    i = O.bodies.append(scene.disk((gap / 2, RADIUS), RADIUS, stuff))
    begin(dt=1e-3)
    run(300)
    # it rests on both corners
    assert O.bodies[i].state.pos[1] == pytest.approx(math.sqrt(RADIUS**2 - gap**2 / 4), abs=2e-6)
    assert len([j for j in contacts() if j.phys.normal > 0]) == 2


def test_walls_of_other_masks_are_not_joined():
    """A disk that one of two walls does not hold comes to the end of the other, which is a corner to it."""
    stuff = material(0.0)
    for line in ([(-3, 0), (0, 0)], [(0, 0), (3, 0)]):
        O.bodies.append(scene.segments(line, stuff))
    O.bodies[1].groupMask = 2
    i = O.bodies.append(scene.disk((0.2, 0.47), RADIUS, stuff))
    begin(dt=1e-3)
    run(2)
    assert [(j.id1, j.geom.owned) for j in contacts()] == [(0, True)]


@pytest.mark.parametrize("closed", [False, True])
def test_pieces_of_a_polyline_know_who_comes_next(closed):
    """Before any step, round a pentagon: each turns by 72° into the next one, the last into the first where it is
    closed.
    """
    corners = [(math.cos(a), math.sin(a)) for a in np.arange(5 + (not closed)) * math.radians(72)]
    pieces = [b.shape for b in scene.segments(corners, material(0.0), closed=closed)]
    assert len(pieces) == 5
    for k, shape in enumerate(pieces):
        last, first = k == 4 and not closed, k == 0 and not closed
        turn = (0, 0, 0) if last else (math.cos(math.radians(72)), math.sin(math.radians(72)), 0)
        assert tuple(shape.nextDirection) == pytest.approx(turn, abs=1e-12) and shape.hasPrevious is not first


@pytest.mark.parametrize("single", [False, True])
def test_who_has_a_corner(single):
    """The wedge outside a corner is that of the piece before it, round the whole of a closed wall; of walls made one by
    one it is that of the lower id.
    """
    stuff = material(0.0)
    square = [(0, 0), (0, 2), (2, 2), (2, 0)]  # clockwise, so that the left of its way is outside
    if single:
        for a, b in zip(square, square[1:] + square[:1]):
            O.bodies.append(scene.segments([a, b], stuff, sense=1))
    else:
        O.bodies.append(scene.segments(square, stuff, sense=1, closed=True))
    away = RADIUS * math.sqrt(0.5)
    for x, y in square:
        O.bodies.append(scene.disk((x + (x - 1) * away, y + (y - 1) * away), RADIUS, stuff))
    begin(dt=1e-3, gravity=(0, 0, 0))
    run(1)
    # the corner at which a closed polyline begins belongs to its last piece
    assert sorted((j.id2, j.id1) for j in contacts()) == [(4, 0 if single else 3), (5, 0), (6, 1), (7, 2)]


def test_a_corner_whose_named_follower_has_gone():
    """The follower that a piece of a polyline names was erased, and a wall that was made alone has its place: neither
    knows of the other, and the wedge is that of the lower id.
    """
    stuff = material(0.0)
    (alone,) = O.bodies.append(scene.segments([(0, 0), (0, -3)], stuff, sense=1))
    _, follower = O.bodies.append(scene.segments([(-3, 0), (0, 0), (0, -3)], stuff, sense=1))
    O.bodies.erase(follower)
    away = RADIUS * math.sqrt(0.5)
    O.bodies.append(scene.disk((away, away), RADIUS, stuff))
    begin(dt=1e-3, gravity=(0, 0, 0))
    run(1)
    assert [j.id1 for j in contacts()] == [alone]
