"""Walls along a circle: bowls, drums, rollers, and their joints with segments."""
import math

import numpy as np
import pytest
from yade import O
from yade.nonsmooth import scene, scene_arrays
from yade.nonsmooth.wall_forces import WallForces
from yade.wrapper import SlipWeakeningMat

from contact_scenes import G, begin, contacts, material, run, state

pytestmark = pytest.mark.usefixtures("empty")

BOWL = (math.pi, 2 * math.pi)  # the lower half


def bowl(big, small, angle, mu=0.9, inside=True, where=(0.0, 0.0), piece=None, part=BOWL):
    """A disk at rest in a bowl, at that angle from its lowest point; returns its id."""
    stuff = material(mu)
    O.bodies.append(scene.arc(where, big, *part, stuff, inside=inside, piece=piece))
    path = big - small if inside else -(big + small)
    place = where[0] + path * math.sin(angle), where[1] - path * math.cos(angle)
    return O.bodies.append(scene.disk(place, small, stuff))


def energy(i, floor=0.0):
    s = O.bodies[i].state
    return 0.5 * s.mass * s.vel.squaredNorm() + 0.5 * s.inertia[2] * s.angVel[2] ** 2 + s.mass * G * (s.pos[1] - floor)


@pytest.mark.parametrize("mu", [0.0, 3.0])  # a disk rolls up to tan θ = 3 μ
@pytest.mark.parametrize("big, small, angle", [(2.0, 0.1, 60), (1.0, 0.3, 80), (20.0, 0.5, 45), (0.3, 0.01, 60)])
def test_a_swing_in_a_bowl_keeps_its_energy(big, small, angle, mu):
    """Rolling or sliding, ten swings at 1 ms; of a polygon of 60 pieces each swing takes 4 to 5 %."""
    i = bowl(big, small, math.radians(angle), mu)
    begin(dt=1e-3)
    low = -(big - small)
    first = energy(i, low)
    period = 2 * math.pi * math.sqrt((1.5 if mu else 1) * (big - small) / G)
    run(round(5 * 1.2 * period / O.dt))
    # the energy of the swing against that at the lowest point; a step of 1 ms is h²ω² = 1e-5 of it
    assert energy(i, low) == pytest.approx(first, rel=1e-3 if big > 0.5 else 5e-3)
    assert math.hypot(*tuple(O.bodies[i].state.pos)[:2]) == pytest.approx(big - small, abs=2e-5 * big)


@pytest.mark.parametrize("big, small, where", [(2.0, 0.1, (0, 0)), (1.0, 0.4, (300, -70)), (50.0, 1.0, (0, 0))])
def test_small_oscillations_have_the_exact_period(big, small, where):
    """2 π √(3 (R − r)/(2 g)) for a disk that rolls."""
    i = bowl(big, small, math.radians(2), where=where)
    period = 2 * math.pi * math.sqrt(1.5 * (big - small) / G)
    begin(dt=period / 4000)
    crossings, before = [], O.bodies[i].state.pos[0] - where[0]
    while len(crossings) < 9:
        run(1)
        now = O.bodies[i].state.pos[0] - where[0]
        if before * now < 0:
            crossings.append(O.time - O.dt * now / (now - before))
        before = now
    measured = 2 * (crossings[-1] - crossings[0]) / 8
    assert measured == pytest.approx(period * (1 + math.radians(2) ** 2 / 16), rel=2e-4)


@pytest.mark.parametrize("spin", [2.0, -0.7])
def test_a_drum_with_friction_turns_a_disk(spin):
    """Friction takes a disk at rest along until it rolls: its rim has the speed of the drum's, v + ω r = Ω R. It swings
    about the lowest point then, and its mean spin is ω r = Ω R.
    """
    big, small = 1.5, 0.2
    i = bowl(big, small, 0.0, mu=0.3, part=(0, 2 * math.pi))
    O.bodies[0].state.angVel = (0, 0, spin)
    begin(dt=1e-3)
    run(2000)
    s, spins = O.bodies[i].state, []
    for _ in range(200):
        run(20)
        x, y = tuple(s.pos)[:2]
        along = (-y * s.vel[0] + x * s.vel[1]) / math.hypot(x, y)
        # the directions of a step are those of its beginning: (v h/D)² of v, and less
        assert along + s.angVel[2] * small == pytest.approx(spin * big, rel=1e-4)
        spins.append(s.angVel[2] * small)
    assert sum(spins) / len(spins) == pytest.approx(spin * big, rel=0.1)


def test_a_drum_that_turns_feels_the_friction_at_its_radius():
    """A disk that cannot turn slides in a drum: torque μ N R about the drum's centre, and the way it lies where tan θ =
    μ.
    """
    big, small, mu = 1.5, 0.2, 0.3
    i = bowl(big, small, math.atan(mu), mu=mu, part=(0, 2 * math.pi))
    O.bodies[i].state.blockedDOFs = "zXYZ"
    O.bodies[0].state.angVel = (0, 0, 1.0)
    begin(dt=1e-3)
    run(300)
    weight = O.bodies[i].state.mass * G
    assert O.bodies[i].state.vel.norm() < 1e-6
    assert O.forces.t(0)[2] == pytest.approx(-weight * math.sin(math.atan(mu)) * big, rel=1e-6)
    assert O.forces.f(0)[1] == pytest.approx(-weight, rel=1e-6)


@pytest.mark.parametrize("mu, cosine", [(0.0, 2 / 3), (5.0, 4 / 7)])
def test_a_disk_leaves_the_outside_where_it_must(mu, cosine):
    """From a cylinder's top a disk that slides leaves at cos θ = 2/3, one that rolls at 4/7."""
    big, small = 1.0, 0.25
    i = bowl(big, small, math.radians(0.5), mu=mu, inside=False, part=(0, 2 * math.pi))
    begin(dt=2e-4)
    for _ in range(20000):
        run(1)
        touching = [c for c in contacts() if c.phys.normal > 0]
        if not touching:
            break
    x, y = tuple(O.bodies[i].state.pos)[:2]
    assert y / math.hypot(x, y) == pytest.approx(cosine, abs=5e-3)
    # what it started with is the height of the start
    assert energy(i, 0.0) == pytest.approx(O.bodies[i].state.mass * G * 1.25 * math.cos(math.radians(0.5)), rel=1e-3)


@pytest.mark.parametrize("separate", [False, True])
@pytest.mark.parametrize("speed, dt", [(3.0, 1e-3), (5.0, 2e-3)])
def test_a_disk_rolls_from_a_floor_onto_an_arc_and_back(speed, dt, separate):
    """A quarter pipe with a common tangent: the disk comes back with the speed it had."""
    stuff = material(0.9)
    floor = [(-6, 0), (0, 0)]
    if separate:
        for k in range(12):
            O.bodies.append(scene.segments([(-6 + 0.5 * k, 0), (-5.5 + 0.5 * k, 0)], stuff, sense=1))
    else:
        O.bodies.append(scene.segments(floor, stuff, sense=1))
    O.bodies.append(scene.arc((0, 4), 4, -math.pi / 2, 0, stuff))
    i = O.bodies.append(scene.disk((-1, 0.3), 0.3, stuff))
    s = O.bodies[i].state
    s.vel, s.angVel = (speed, 0, 0), (0, 0, -speed / 0.3)
    begin(dt=dt)
    high = 0.0
    while not (s.pos[0] < -1 and s.vel[0] < 0):
        run(10)
        high = max(high, s.pos[1])
        assert O.time < 10
    assert s.vel[0] == pytest.approx(-speed, rel=1e-3)
    assert s.angVel[2] == pytest.approx(speed / 0.3, rel=1e-3)
    assert high - 0.3 == pytest.approx(0.75 * speed**2 / G, rel=2e-3)


def test_pieces_of_an_arc_are_one_wall():
    """Cut into 15 pieces, or made of arcs in another order, it is the same wall."""
    ways = []
    for piece, part in ((None, BOWL), (0.4, BOWL), (None, None)):
        O.reset()
        i = bowl(2.0, 0.1, math.radians(60), piece=piece, part=part or (1.5 * math.pi, 2 * math.pi))
        if part is None:
            O.bodies.append(scene.arc((0, 0), 2.0, math.pi, 1.5 * math.pi, O.materials[0]))
        begin(dt=1e-3)
        run(4000)
        ways.append(tuple(tuple(O.bodies[i].state.pos)[:2]))
    assert np.array(ways[1]) == pytest.approx(np.array(ways[0]), abs=1e-7)
    assert np.array(ways[2]) == pytest.approx(np.array(ways[0]), abs=1e-7)


def test_a_wall_that_acts_on_both_sides():
    stuff = material(0.3)
    O.bodies.append(scene.arc((0, 0), 1, 0, 2 * math.pi, stuff, inside=None))
    inner, outer = (O.bodies.append(scene.disk((0, y), 0.2, stuff)) for y in (-0.7, 1.3))
    begin(dt=1e-3)
    run(1000)
    assert O.bodies[inner].state.pos[1] == pytest.approx(-0.8, abs=1e-4)
    assert O.bodies[outer].state.pos[1] == pytest.approx(1.2, abs=1e-4)
    weight = (O.bodies[inner].state.mass + O.bodies[outer].state.mass) * G
    assert O.forces.f(0)[1] == pytest.approx(-weight, rel=1e-6)


@pytest.mark.parametrize("inside", [True, False])
def test_a_one_sided_arc_holds_on_its_side_alone(inside):
    """From the other side disks come in, and are pushed through to the side that acts."""
    stuff = material(0.0)
    O.bodies.append(scene.arc((0, 0), 2, 0, 2 * math.pi, stuff, inside=inside))
    i = O.bodies.append(scene.disk((0, 2.4 if inside else 1.6), 0.3, stuff))
    O.bodies[i].state.vel = (0, -2 if inside else 2, 0)
    begin(dt=1e-3, gravity=(0, 0, 0))
    run(1500)
    assert (math.hypot(*tuple(O.bodies[i].state.pos)[:2]) < 2) == inside


def test_the_end_of_an_arc_is_a_corner():
    """Over the rim of a shell a disk that slides without friction turns about the end, touching nothing but it."""
    stuff = material(0.0)
    O.bodies.append(scene.arc((0, 0), 1, math.pi / 2, math.pi, stuff, inside=False))
    i = O.bodies.append(scene.disk((0.01, 1.3), 0.3, stuff))
    begin(dt=2e-4)
    nearest = 1.0
    for _ in range(2000):
        run(5)
        x, y = tuple(O.bodies[i].state.pos)[:2]
        nearest = min(nearest, math.hypot(x, y - 1))
        if y < 1:
            break
    assert O.bodies[i].state.pos[1] < 1 and nearest == pytest.approx(0.3, abs=1e-5)


@pytest.mark.parametrize("end", ["first", "last"])
@pytest.mark.parametrize("drop", [20, 80])
@pytest.mark.parametrize("arc_first", [True, False])
def test_a_corner_of_an_arc_and_a_segment_has_one_contact(arc_first, drop, end):
    """A cap of 60 degrees and a wall that falls away from one of its ends, the corner being convex: whoever presses on
    the corner, from any direction between the two, is held by one contact, against which it moves."""
    side = -1 if end == "last" else 1  # of the corner; arcs run counter-clockwise
    slope = math.radians(30 + drop)
    corner = np.array([side * math.sin(math.radians(30)), math.cos(math.radians(30))])
    for share in (0.02, 0.5, 0.98):
        O.reset()
        stuff = material(0.0)
        foot = corner + 2 * np.array([side * math.cos(slope), -math.sin(slope)])
        cap = scene.arc((0, 0), 1, math.radians(60), math.radians(120), stuff, inside=False)
        fall = scene.segments([corner, foot], stuff)
        for wall in (cap, fall) if arc_first else (fall, cap):
            O.bodies.append(wall)
        leaning = math.radians(30 + share * drop)
        away = np.array([side * math.sin(leaning), math.cos(leaning)])
        i = O.bodies.append(scene.disk(corner + 0.2 * away, 0.2, stuff))
        O.bodies[i].state.vel = (*(-away), 0)
        begin(gravity=(0, 0, 0))
        run(1)
        held = [c for c in contacts() if c.phys.normal > 0]
        assert len(held) == 1
        assert tuple(O.bodies[i].state.vel) == pytest.approx((0, 0, 0), abs=1e-9)
        assert tuple(held[0].geom.normal)[:2] == pytest.approx(away, abs=1e-6)


@pytest.mark.parametrize("at, holder", [(250, 0), (210, 0), (100, 1), (190, 1)])
def test_the_foot_of_a_wall_on_the_circle_of_an_arc(at, holder):
    """A wall outside a bowl from 200 to 340 degrees, whose foot lies on the bowl's circle, and a disk that is pressed
    there from within: the bowl alone holds it, and where that has ended the foot, which is a corner."""
    stuff = material(0.0)
    away = np.array([math.cos(math.radians(at)), math.sin(math.radians(at))])
    O.bodies.append(scene.arc((0, 0), 2, math.radians(200), math.radians(340), stuff))
    O.bodies.append(scene.segments([2 * away, 4 * away], stuff))
    i = O.bodies.append(scene.disk(1.7 * away, 0.3, stuff))
    begin(dt=1e-3, gravity=(*(G * away), 0))
    run(3)
    assert [(c.id1, c.id2) for c in contacts() if c.geom.owned] == [(holder, i)]
    assert tuple(O.bodies[i].state.vel) == pytest.approx((0, 0, 0), abs=1e-9)


def test_a_drum_turns_with_its_pieces_and_they_stay_one_wall():
    """Twelve pieces that turn about their common centre; disks in it go on as in a drum of one piece."""
    turned = []
    for piece in (None, 0.8):
        O.reset()
        i = bowl(1.5, 0.2, 0.3, mu=0.2, piece=piece, part=(0, 2 * math.pi))
        for b in O.bodies:
            if b.id != i:
                b.state.angVel = (0, 0, 1.0)
        begin(dt=1e-3)
        run(2500)
        turned.append((*tuple(O.bodies[i].state.pos)[:2], O.bodies[i].state.angVel[2]))
    assert turned[1] == pytest.approx(turned[0], abs=1e-6)


def test_a_bowl_goes_on_after_loading(tmp_path):
    i = bowl(2.0, 0.1, 1.0, piece=0.5)
    begin(dt=1e-3)
    run(200)
    O.save(str(tmp_path / "half.yade.bz2"))
    run(300)
    straight = state([i])
    O.load(str(tmp_path / "half.yade.bz2"))
    run(300)
    assert state([i]) == straight


def test_the_engines_of_yade_take_arcs():
    from yade.wrapper import InsertionSortCollider, InteractionLoop, NewtonIntegrator

    ways = []
    for plain in (False, True):
        O.reset()
        i = bowl(2.0, 0.1, 1.0, piece=0.5)
        begin(dt=1e-3)
        ours = O.engines
        if plain:
            collider, loop = ours[1], ours[2]
            lists = [d.functors for d in (loop.geomDispatcher, loop.physDispatcher, loop.lawDispatcher)]
            O.engines = [
                ours[0],
                InsertionSortCollider(collider.boundDispatcher.functors, verletDist=0.05),
                InteractionLoop(*lists),
                ours[3],
                NewtonIntegrator(damping=0, gravity=(0, -G, 0)),
            ]
        run(1500)
        ways.append(state([i]))
    assert ways[0] == ways[1]


def test_restitution_in_a_bowl_is_that_of_the_material():
    """A disk that falls into the middle of a bowl jumps to e² of its height."""
    stuff = material(0.0, restitution=0.6)
    O.bodies.append(scene.arc((0, 0), 2, *BOWL, stuff))
    i = O.bodies.append(scene.disk((0, -0.9), 0.1, stuff))
    begin(dt=1e-4)
    s = O.bodies[i].state
    while s.vel[1] <= 0:
        run(1)
    high = s.pos[1]
    while s.vel[1] > 0:
        run(1)
        high = max(high, s.pos[1])
    assert high + 1.9 == pytest.approx(0.36, rel=2e-3)


@pytest.mark.parametrize("restitution", [0.6, 1.0])
def test_a_disk_with_restitution_swings_and_does_not_jump(restitution):
    """In each step of a swing it approaches the wall by half of the turn of its path: what the chord gives back is not
    given back twice.
    """
    i = bowl(2.0, 0.1, 1.0, mu=0.0)
    O.materials[0].restitution = restitution
    begin(dt=5e-3)
    first, gap = energy(i, -1.9), 0.0
    for _ in range(300):
        run(2)
        gap = max(gap, 1.9 - math.hypot(*tuple(O.bodies[i].state.pos)[:2]))
    # a step turns it by 9e-3, a chord is 8e-5 m from its arc; velocities belong to the middle of the step, which is
    # 1e-3 of the energy
    assert gap < 3e-4 and energy(i, -1.9) == pytest.approx(first, rel=3e-3)


def test_an_overlap_is_taken_back_from_a_disk_that_races_round():
    """All but the slack of 1e-4 ℓ, where a step's chord is 1.2 mm from its arc and the overlap 1 mm."""
    stuff = material(0.0)
    O.bodies.append(scene.arc((0, 0), 1.3, 0, 2 * math.pi, stuff))
    i = O.bodies.append(scene.disk((0, -1.001), 0.3, stuff))
    O.bodies[i].state.vel = (10, 0, 0)
    begin(dt=5e-3, gravity=(0, 0, 0))
    run(100)
    assert math.hypot(*tuple(O.bodies[i].state.pos)[:2]) - 1 == pytest.approx(3e-5, abs=3.1e-5)


def test_a_disk_follows_the_outside_of_an_arc_without_gaps():
    """Over a crest: the chords of steps of 5 ms are 3e-5 m from the circle, their ends on it."""
    stuff = material(0.0)
    O.bodies.append(scene.arc((0, 0), 10, 0, math.pi, stuff, inside=False))
    i = O.bodies.append(scene.disk((-10.5 * math.sin(0.3), 10.5 * math.cos(0.3)), 0.5, stuff))
    s = O.bodies[i].state
    s.vel = (5 * math.cos(0.3), 5 * math.sin(0.3), 0)
    begin(dt=5e-3)
    while s.pos[0] < 3:
        run(1)
        assert math.hypot(s.pos[0], s.pos[1]) - 10.5 == pytest.approx(0, abs=1.2e-5)  # 5e-6 where it is fastest


@pytest.mark.parametrize("gap, kind", [(0.0, True), (5e-4, True)])
def test_disks_bond_to_an_arc(gap, kind):
    stuff = material(0.5)
    wall = material(0.5, wall=True, bondsToAll=True, layer=-1, tensileStrength=1e6)
    O.bodies.append(scene.arc((0, 0), 2, 0, 2 * math.pi, wall))
    i = O.bodies.append(scene.disk((0, 1.8 - gap), 0.2, stuff))
    engine = begin(dt=1e-3)
    run(1)
    assert engine.bond() == 1
    run(500)
    # it hangs below the top of the drum, by its gap and what it fell in the first step
    assert tuple(O.bodies[i].state.pos)[:2] == pytest.approx((0, 1.8 - gap), abs=2e-5)
    assert engine.bonds == 1


@pytest.mark.parametrize("inside", [True, False])
@pytest.mark.parametrize("small, turn", [(0.2, 0.03), (0.2, 0.1), (0.003, 0.01)])
def test_a_bond_to_a_drum_that_turns_holds(inside, small, turn):
    """A disk that is bonded to a drum of 1 m goes round with it, in steps of ``turn`` [rad], as it would with a disk of
    that size.
    """
    omega, dt = 3.0, turn / 3.0
    stuff = material(0.6, 0.5, tensileStrength=1e9, bondsToAll=True)
    drum = O.bodies.append(scene.arc((0, 0), 1, 0, 2 * math.pi, stuff, inside=inside))
    path = 1 - small if inside else 1 + small
    i = O.bodies.append(scene.disk((path, 0), small, stuff))
    for wall in drum:
        O.bodies[wall].state.angVel = (0, 0, omega)
    e = begin(gravity=(0, 0, 0), dt=dt)
    s = O.bodies[i].state
    s.vel, s.angVel = (0, omega * path, 0), (0, 0, omega)
    e.advance(1)
    assert e.bond() == 1
    behind = math.atan2(s.pos[1], s.pos[0]) - 2 * math.atan2(s.ori[2], s.ori[3])
    e.advance(round(4 * 2 * math.pi / turn))
    assert e.bonds == 1
    off = math.atan2(s.pos[1], s.pos[0]) - 2 * math.atan2(s.ori[2], s.ori[3]) - behind
    # slacks of its size, and what the first step, in which nobody knew that they turn as one, was off
    assert math.remainder(off, 2 * math.pi) * path == pytest.approx(0, abs=4e-4 * small + turn**3 / 2 * path)
    assert math.hypot(*tuple(s.pos)[:2]) == pytest.approx(path, abs=4e-4 * small)


def test_slip_along_an_arc_is_the_path():
    """Of a disk that cannot turn, down a bowl whose friction falls with slip."""
    stuff = material(0.5)
    wall = material(0.3, kind=SlipWeakeningMat, wall=True, criticalSlip=50)
    O.bodies.append(scene.arc((0, 0), 5, *BOWL, wall, piece=1))
    i = O.bodies.append(scene.disk((-4.5 * math.sin(1.0), -4.5 * math.cos(1.0)), 0.5, stuff))
    O.bodies[i].state.blockedDOFs = "zXYZ"
    begin(dt=1e-3)
    run(900)
    x, y = tuple(O.bodies[i].state.pos)[:2]
    path = 4.5 * (1.0 + math.atan2(x, -y))
    assert path > 2 and wall.slipOf(i) == pytest.approx(path, rel=1e-4)  # the chords of steps are shorter by 1e-6


def test_an_arc_is_drawn_as_it_stands():
    stuff = material(0.5)
    (k,) = O.bodies.append(scene.arc((1, 2), 2, 0, math.pi / 2, stuff))
    O.bodies.append(scene.disk((1, 2), 0.5, stuff))
    O.bodies[k].state.ori = O.bodies[k].state.ori  # as it is
    walls = np.array(scene_arrays.read(O).walls)
    assert walls.shape == (30, 2, 2)  # chords of 3°
    assert np.hypot(walls[..., 0] - 1, walls[..., 1] - 2) == pytest.approx(2, rel=1e-12)
    assert walls.min(axis=(0, 1)) == pytest.approx((1, 2), abs=1e-12)
    assert walls.max(axis=(0, 1)) == pytest.approx((3, 4), abs=1e-12)


@pytest.mark.parametrize(
    "words, more",
    [
        ("radius = -1", dict(radius=-1)),
        ("radius = 0", dict(radius=0)),
        ("piece = 0", dict(piece=0)),
        ("beyond the start", dict(start=1, end=1)),
        ("beyond the start", dict(start=3, end=1)),
        ("end inf: give an angle", dict(end=math.inf)),
    ],
)
def test_what_is_no_arc_is_told(words, more):
    with pytest.raises(ValueError, match=words):
        scene.arc(**{**dict(centre=(0, 0), radius=1, start=0, end=2, material=material(0.3)), **more})


@pytest.mark.parametrize("big, small, slope, dt", [(3.0, 0.2, 40, 1e-3), (10.0, 0.5, 30, 2e-3), (1.0, 0.05, 30, 5e-4)])
def test_a_disk_rolls_over_a_hill(big, small, slope, dt):
    """Floor, arc (its inside), incline, arc (its outside), and a floor on top, all with common tangents: what it loses
    of its speed is the height.
    """
    stuff, angle = material(2.0), math.radians(slope)
    foot = big * math.sin(angle), big * (1 - math.cos(angle))
    top = foot[0] + big * math.cos(angle), foot[1] + big * math.sin(angle)
    crest = top[0] + big * math.sin(angle), top[1] - big * math.cos(angle)
    high = crest[1] + big
    O.bodies.append(scene.segments([(-5 * big, 0), (0, 0)], stuff, sense=1))
    O.bodies.append(scene.arc((0, big), big, -math.pi / 2, angle - math.pi / 2, stuff))
    O.bodies.append(scene.segments([foot, top], stuff, sense=1))
    O.bodies.append(scene.arc(crest, big, math.pi / 2, math.pi / 2 + angle, stuff, inside=False))
    O.bodies.append(scene.segments([(crest[0], high), (crest[0] + 9 * big, high)], stuff, sense=1))
    i = O.bodies.append(scene.disk((-big, small), small, stuff))
    speed = math.sqrt(1.15 * 2 * G * high / 1.5)  # a little more than the hill asks for, so that it stays on the ground
    s = O.bodies[i].state
    s.vel, s.angVel = (speed, 0, 0), (0, 0, -speed / small)
    engine = begin(dt=dt, tolerance=1e-10)
    while s.pos[0] < crest[0] + 2 * big:
        run(20)
        assert O.time < 60
    assert s.vel[0] == pytest.approx(math.sqrt(speed**2 - 2 * G * high / 1.5), rel=1e-4)  # 1e-5 is seen
    assert s.pos[1] == pytest.approx(high + small, abs=1e-4 * big) and engine.overlapWorstEver < 1e-4


def test_forces_on_an_arc_are_counted_by_the_chords_of_its_pieces():
    """Six pieces, one of which has its middle at the lowest point, where a disk lies: its weight is the normal
    force.
    """
    stuff = material(0.3)
    drum = O.bodies.append(scene.arc((0, 0), 1, 0, 2 * math.pi, stuff, piece=1.05))
    i = O.bodies.append(scene.disk((0, -0.8), 0.2, stuff))
    begin(dt=1e-3)
    run(50)
    walls = WallForces({"drum": drum})
    run(50)
    normal, shear, peak = walls.take()["drum"]
    weight = O.bodies[i].state.mass * G
    assert len(drum) == 6 and (normal, peak) == pytest.approx((weight, weight), rel=1e-9)
    assert abs(shear) < 1e-9 * weight
