"""Contacts with friction, rolling and restitution have the same course in any frame, with any ids, in any company."""
from dataclasses import replace

import numpy as np
import pytest
from yade import O, utils

from contact_scenes import contacts
from symmetries import BINARY, FRAMES, Disk, Frame, Line, World, assert_bits, assert_same, play, shuffled

# rounding of up to 300 steps, which impacts make grow (1e-12 to 4e-10 were seen); the solver's tolerance of 1e-12,
# likewise, where the order of contacts is another
ROUNDING, SOLVED = 1e-9, 1e-8


def heap(seed=4):
    """24 disks of several sizes that fly about in a box, collide and come to lie on each other."""
    dice = np.random.default_rng(seed)
    disks = tuple(
        Disk(
            0.7 + 1.05 * a + dice.uniform(-0.05, 0.05),
            0.55 + 1.05 * b + dice.uniform(-0.05, 0.05),
            dice.uniform(0.3, 0.5),
            tuple(dice.uniform(-2, 2, 2)),
            dice.uniform(-3, 3),
        )
        for b in range(4)
        for a in range(6)
    )
    return World(
        disks,
        (Line(((-0.2, 5), (0, 0), (4, -0.3), (6.8, 0.2), (7, 5)), piece=1.5, sense=1),),
        dict(
            rock=dict(frictionAngle=0.3, rollingFriction=0.05, restitution=0.2),
            ground=dict(frictionAngle=0.25, rollingFriction=0.1, restitution=0.4),
        ),
        dt=3e-3,
        steps=150,
        options=dict(maxIterations=3000),
    )


def pressed(seed=6):
    """24 disks that overlap by some per cent at the beginning: errors of position are taken back while the disks fall,
    turn, and meet the floor.
    """
    dice = np.random.default_rng(seed)
    disks = tuple(
        Disk(
            0.5 + 0.93 * (a + 0.5 * (b % 2)),
            0.47 + 0.81 * b,
            dice.uniform(0.47, 0.5),
            tuple(dice.uniform(-1, 1, 2)),
            dice.uniform(-2, 2),
        )
        for b in range(4)
        for a in range(6)
    )
    return World(
        disks,
        (Line(((-2, -0.25), (9, -0.25)), piece=2.0),),
        dict(rock=dict(frictionAngle=0.3, rollingFriction=0.1), ground=dict(frictionAngle=0.3)),
        dt=3e-3,
        steps=90,
        options=dict(maxIterations=3000),
    )


WORLDS = {"heap": heap(), "pressed": pressed()}


pytestmark = pytest.mark.usefixtures("empty")


@pytest.fixture(scope="module", params=WORLDS)
def known(request):
    """A world and its course as it stands here."""
    world = WORLDS[request.param]
    course = play(world)
    sliding, rolling, debonding, impact, given = np.abs(course["losses"][-1])
    # all that may happen does
    assert min(sliding, rolling, impact) > 1e-3 * course.mass * course.speed**2 and debonding == 0
    assert request.param != "pressed" or (
        given > 1e-3 * course.mass * course.speed**2 and course["overlap"][0, 0] > 0.001
    )
    return world, course


@pytest.mark.parametrize("name", FRAMES)
def test_any_frame_sees_the_same_course(known, name):
    world, here = known
    assert_same(play(world, FRAMES[name]), here, ROUNDING)


def test_powers_of_two_as_units_change_no_bit(known):
    world, here = known
    assert_bits(play(world, BINARY), here)


def test_far_from_the_origin_only_the_last_bits_of_places_are_lost(known):
    world, here = known
    far = 2.0**20
    # 2^-33 m between two numbers there: so much is a gap wrong, which a step makes a speed of 2^-33 m/dt; impacts make
    # it grow by some hundred times, and more
    lost = 2.0**-33 / here.step / here.speed
    assert_same(play(world, Frame(shift=(far, -far))), here, 1000 * lost, place=1000 * lost, wall_moment=1e6 * lost)


# ---- ids and orders -------------------------------------------------------------------------------


def uncorrected(world):
    """Errors of position are not solved for to a tolerance: what ten sweeps leave of them knows the order. So they stay
    here.
    """
    return replace(world, options={**world.options, "relaxationRate": 0})


@pytest.mark.parametrize(
    "change",
    [lambda w: replace(w, order=tuple(range(len(w.disks)))[::-1]), shuffled, lambda w: replace(w, walls_last=True)],
)
def test_ids_do_not_matter(known, change):
    if known[0] is WORLDS["pressed"]:
        pytest.skip("disks that are pressed into one another on all sides have forces that are not unique")
    world = uncorrected(known[0])
    assert_same(play(change(world)), play(world), SOLVED)


def test_the_order_in_which_yade_keeps_a_pair_does_not_matter(known):
    world = uncorrected(known[0])
    turned = []

    def turn(ids):
        disks = set(ids)
        for i in contacts():
            if {i.id1, i.id2} <= disks:
                a, b = i.id1, i.id2
                O.interactions.erase(a, b)
                turned.append((b, a))
        for b, a in turned:  # put back the other way round, without their reactions
            utils.createInteraction(b, a)
            assert O.interactions[b, a].id1 == b

    found = play(world, prepared=turn)
    assert turned
    assert_same(found, play(world), SOLVED)


# ---- walls in other pieces ------------------------------------------------------------------------


@pytest.mark.parametrize(
    "change",
    [
        lambda line: replace(line, piece=0.4),
        lambda line: replace(line, piece=None),
        lambda line: replace(line, vertices=line.vertices[::-1], sense=-line.sense),
    ],
    ids=["fine", "whole", "drawn backwards"],
)
def test_how_a_wall_is_cut_and_drawn_does_not_matter(known, change):
    world, here = known
    assert_same(play(replace(world, walls=tuple(change(line) for line in world.walls))), here, SOLVED)


# ---- company --------------------------------------------------------------------------------------


def beside(first, second, way):
    """Both worlds in one scene, the second moved by ``way`` [m]."""
    moved = tuple(replace(d, x=d.x + way, stuff="other " + d.stuff) for d in second.disks)
    walls = tuple(
        replace(line, vertices=tuple((x + way, y) for x, y in line.vertices), stuff="other " + line.stuff)
        for line in second.walls
    )
    return replace(
        first,
        disks=first.disks + moved,
        walls=first.walls + walls,
        stuffs=first.stuffs | {"other " + k: v for k, v in second.stuffs.items()},
    )


def part(course, disks, walls, way=0.0):
    """The course of some disks and walls of a world with others, by slices."""
    found = type(course)(course)
    for name in ("turned", "velocity", "spin", "force", "torque", "wet", "slip"):
        found[name] = course[name][:, disks]
    found["place"] = course["place"][:, disks] - np.array([way, 0.0])
    found["wall force"] = course["wall force"][:, walls]
    found["wall moment"] = course["wall moment"][:, walls] - way * found["wall force"][..., 1]
    return found


def test_two_distant_scenes_do_not_know_of_each_other():
    a, b, way = replace(WORLDS["heap"], steps=90), WORLDS["pressed"], 64.0
    both, alone = play(beside(a, b, way)), (play(a), play(b))
    for own, disks, walls, x in (
        (alone[0], slice(0, 24), slice(0, 1), 0.0),
        (alone[1], slice(24, 48), slice(1, 2), way),
    ):
        # one residual for both, relative to the mean of all; 64 m take six bits of a place
        assert_same(part(both, disks, walls, x), own, SOLVED, losses=None, overlap=None)
    # energies are those of both
    # J, of some 1e4
    assert both["losses"] == pytest.approx(alone[0]["losses"] + alone[1]["losses"], rel=1e-8, abs=1e-4)
    assert both["overlap"][:, 0] == pytest.approx(
        np.maximum(alone[0]["overlap"][:, 0], alone[1]["overlap"][:, 0]), abs=1e-9
    )
