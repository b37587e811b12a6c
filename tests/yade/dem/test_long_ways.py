"""Steps in which a disk goes farther than its radius: they are told of, and what goes through a wall or another disk
that it never touched is refused before it is through.
"""
import math

import pytest
from yade import O, utils
from yade.nonsmooth import scene
from yade.wrapper import Bo1_Box_Aabb, Bo1_Wall_Aabb, Ig2_Box_Sphere_ScGeom, Ig2_Wall_Sphere_ScGeom, Segment

from contact_scenes import G, begin, engine, floor, free_disk, material, refused, run, threads_allowed

pytestmark = pytest.mark.usefixtures("empty")

NO_GRAVITY = dict(gravity=(0, 0, 0))


def far_ways(capfd):
    return [line for line in capfd.readouterr().err.splitlines() if "moves by more than its radius" in line]


def thrown(velocity, at=(0, 5), radius=0.5, stuff=None):
    disk = O.bodies.append(scene.disk(at, radius, stuff or O.materials[0]))
    O.bodies[disk].state.vel = (*velocity, 0)
    return disk


def test_a_disk_that_falls_in_a_step_that_is_far_too_long(capfd):
    """The first step takes it 2.45 m down, the second one would take it through the floor."""
    ground = floor(material(0.5))
    disk = thrown((0, 0), radius=1.0)
    begin(dt=0.5)
    run(1)
    way = G * 0.5**2  # g h²
    assert (engine().wayWorst, engine().wayWorstEver, engine().farSteps) == (*[pytest.approx(way, rel=1e-12)] * 2, 1)
    (told,) = far_ways(capfd)
    for words in (
        f"body #{disk}",
        "radius 1 m",
        "4.905 m/s",
        "2.4525 of its radii",
        "O.dt = 0.5 s",
        "Set O.dt = 0.102 s",
    ):
        assert words in told, told
    before = O.bodies[disk].state.pos
    refused(
        f"body #{disk}, a disk of radius 1 m, would go through body #{ground} (Segment)",
        "at 9.81 m/s, by 4.91 m in a step of O.dt = 0.5 s",
        "Set O.dt = 0.051 s or less",
        "bounded = False",
    )
    assert O.bodies[disk].state.pos == before
    O.dt = 0.0051  # and with what was asked for, or less, it lies there
    run(600)
    assert O.bodies[disk].state.pos[1] == pytest.approx(1, abs=1e-3)
    assert engine().wayWorst < 1 < engine().wayWorstEver


@pytest.mark.parametrize("velocity", [(0, -400), (300, -300), (-900, -500)])
def test_a_thrown_disk_and_the_step_that_would_do(velocity):
    floor(material(0.5))
    disk = thrown(velocity, at=(-velocity[0] / 500, 1))
    begin(dt=5e-3, **NO_GRAVITY)
    refused(f"body #{disk}", "would go through body #0")
    O.dt = 0.5 * 0.5 / math.hypot(*velocity)  # as the message says
    run(40)
    assert (
        O.bodies[disk].state.pos[1] > 0.4 and engine().farSteps == 0
    )  # it may come into the floor by a part of a step's way


def test_up_to_its_radius_nothing_is_told(capfd):
    floor(material(0.5))
    disk = thrown((99.9, 0))
    begin(dt=5e-3, **NO_GRAVITY)
    run(3)
    assert engine().farSteps == 0 and engine().wayWorst == pytest.approx(0.999, rel=1e-12)
    O.bodies[disk].state.vel = (100.1, 0, 0)
    run(12)
    assert engine().farSteps == 12 and len(far_ways(capfd)) == 2  # the first and the tenth


def test_what_flies_together_or_alone_meets_nothing(capfd):
    stuff = material(0.5)
    for k in range(4):
        thrown((1000, 1000), at=(1.5 * k, 0), stuff=stuff)
    begin(dt=5e-3, **NO_GRAVITY)
    run(3)
    assert engine().farSteps == 0 and engine().wayWorst == 0
    O.bodies[0].state.vel = (1000, 1120, 0)  # each is as far from the middle of the two velocities
    run(1)
    assert engine().wayWorst == pytest.approx(60 * 5e-3 / 0.5, rel=1e-12)


def test_a_wall_that_is_driven_goes_as_a_disk_would(capfd):
    stuff = material(0.5)
    wall = O.bodies.append(scene.segments([(0, 2), (0, -2)], stuff))[0]
    disk = thrown((0, 0), at=(2.8, 0))
    O.bodies[wall].state.vel = (200, 0, 0)
    begin(dt=5e-3, **NO_GRAVITY)
    run(2)
    assert engine().wayWorst == pytest.approx(2, rel=1e-12)
    refused(f"body #{disk}", f"would go through body #{wall}", "200 m/s")
    O.bodies[wall].state.vel = (80, 0, 0)
    run(5)
    assert O.bodies[disk].state.vel[0] == pytest.approx(80, rel=1e-9) and engine().wayWorst == pytest.approx(0)


@pytest.mark.parametrize(
    "sense, from_above, through", [(0, 1, 1), (0, -1, 1), (1, 1, 1), (1, -1, 0), (-1, 1, 0), (-1, -1, 1)]
)
def test_a_wall_holds_on_its_side(sense, from_above, through):
    O.bodies.append(scene.segments([(-20, 0), (20, 0)], material(0.5), sense=sense))
    disk = thrown((0, -1000 * from_above), at=(0, 2 * from_above))
    begin(dt=5e-3, **NO_GRAVITY)
    if through:
        refused(f"body #{disk}", "would go through body #0")
    else:
        run(2)


def test_a_one_sided_wall_pushes_back_what_is_less_than_a_radius_behind_it(capfd):
    O.bodies.append(scene.segments([(-20, 0), (20, 0)], material(0.5), sense=1))
    disk = thrown((0, -200), at=(0, 0.7))  # to 0.3 m below the line
    begin(dt=5e-3, **NO_GRAVITY)
    run(1)
    assert O.bodies[disk].state.pos[1] == pytest.approx(-0.3, rel=1e-9) and len(far_ways(capfd)) == 1
    run(200)  # at 1 m/s at most
    assert O.bodies[disk].state.pos[1] > 0.49


def test_what_passes_beside_a_wall_or_may_not_meet_it_is_let_pass():
    O.bodies.append(scene.segments([(-2, 0), (2, 0)], material(0.5)))
    disk = thrown((0, -1000), at=(2.1, 2))
    begin(dt=5e-3, **NO_GRAVITY)
    run(2)
    for apart in ("mask", "bounded"):
        O.bodies[disk].state.pos, O.bodies[disk].state.vel = (0, 2, 0), (0, -1000, 0)
        if apart == "mask":
            O.bodies[disk].mask, O.bodies[0].mask = 1, 2
        else:
            O.bodies[disk].mask, O.bodies[0].mask, O.bodies[0].bounded = 1, 1, False
        run(2)
        assert O.bodies[disk].state.pos[1] == pytest.approx(-8)
    O.bodies[0].bounded = True
    O.bodies[disk].state.pos = (0, 2, 0)
    refused("would go through body #0")


ARC = dict(centre=(1, 2), radius=3)


@pytest.mark.parametrize(
    "inside, at, velocity, span, through",
    [
        (True, (0, 0), (1000, 0), None, True),  # out of a drum
        (True, (-4, 0), (300, 0), None, False),  # into one that acts within, and stays there
        (True, (-4, 0), (2000, 0), None, True),  # and out on the other side
        (False, (-4, 0), (500, 0), None, True),  # into a roller
        (False, (-4, 0), (2000, 0), None, True),  # and through all of it
        (False, (0, 0), (1000, 0), None, False),
        (None, (0, 0), (1000, 0), None, True),
        (None, (-4, 0), (500, 0), None, True),
        (True, (0, 0), (1000, 0), (1, 2), False),  # the bowl is open there
        (True, (0, 0), (0, 1000), (1, 2), True),
        (True, (-4, 4), (2000, 0), None, False),  # beside it
    ],
)
def test_arcs(inside, at, velocity, span, through):
    centre = ARC["centre"]
    O.bodies.append(
        scene.arc(**ARC, start=(span or (0, 7))[0], end=(span or (0, 7))[1], material=material(0.5), inside=inside)
    )
    disk = thrown(velocity, at=(centre[0] + at[0], centre[1] + at[1]))
    begin(dt=5e-3, **NO_GRAVITY)
    if through:
        refused(f"body #{disk}", "would go through body #0 (Arc)")
    else:
        run(1)


@pytest.mark.parametrize("shape", ["box", "wall"])
def test_boxes_and_walls_of_yades(shape):
    stuff = material(0.5)
    O.bodies.append(
        utils.box((0, 0, 0), (5, 0.1, 1), fixed=True, material=stuff)
        if shape == "box"
        else utils.wall(0, 1, material=stuff)
    )
    disk = thrown((10, -1000), at=(0, 2))
    begin(dt=5e-3, **NO_GRAVITY)
    collider, loop = O.engines[1], O.engines[2]
    collider.boundDispatcher.functors = list(collider.boundDispatcher.functors) + [Bo1_Box_Aabb(), Bo1_Wall_Aabb()]
    loop.geomDispatcher.functors = list(loop.geomDispatcher.functors) + [
        Ig2_Box_Sphere_ScGeom(interactionDetectionFactor=1.05),
        Ig2_Wall_Sphere_ScGeom(),
    ]
    refused(f"body #{disk}", f"would go through body #0 ({shape.capitalize()})")
    O.bodies[disk].state.vel = (1000, -10, 0)  # along it
    run(1)


@pytest.mark.parametrize("fixed", [False, True])
@pytest.mark.parametrize("aside, passes", [(0, True), (0.9, True), (0.96, False), (1.5, False)])
def test_disks_that_pass_through_each_other(aside, passes, fixed):
    """``aside``: how far apart their centres come [m]; the sum of radii is 1 m, of which they may graze a twentieth."""
    stuff = material(0.5)
    other = O.bodies.append(scene.disk((2.5, aside), 0.5, stuff, fixed=fixed))
    disk = thrown((1000, 0), at=(0, 0))
    begin(dt=5e-3, **NO_GRAVITY)
    if passes:
        refused(f"body #{disk}", f"would go through body #{other} (Sphere)")
    else:
        run(1)
    assert O.bodies[disk].state.pos[0] == pytest.approx(0 if passes else 5)


def test_a_wall_that_it_touches_stops_the_fastest(capfd):
    """What is a contact is solved at any speed."""
    floor(material(0.0))
    disk = thrown((0, -1000), at=(0, 0.52))
    begin(dt=5e-3, **NO_GRAVITY)
    run(2)
    assert O.bodies[disk].state.pos[1] == pytest.approx(0.5, abs=1e-9)
    assert engine().farSteps == 0  # it goes 0.02 m


def test_it_is_the_same_on_any_number_of_threads():
    stuff = material(0.5)
    floor(stuff)
    for k in range(300):
        thrown(
            (100 * math.sin(k), 60 * math.cos(3 * k)), at=(1.2 * (k % 20), 2 + 1.2 * (k // 20)), radius=0.3 + 0.0005 * k
        )
    ways = []
    begin(dt=1e-4, **NO_GRAVITY)  # none meet
    for threads in (1, 2):
        for e in O.engines:
            e.ompThreads = threads
        with threads_allowed(threads):
            run(1)
        ways.append(engine().wayWorst)
        O.bodies[7].state.vel = (0, 0, 0)
    assert ways[0] == ways[1]
