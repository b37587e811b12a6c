"""Newmark's block against closed forms, symmetries and a plain integration by small steps. Needs no YADE."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

import synthetic_slope as package

newmark, motions, made_up = (
    package.load(name) for name in ("measure.newmark", "model.ground_motion", "model.ground_motion.synthetic")
)
G = 9.81
B = math.radians(30)
YIELDS = (0.1, 0.2, 0.4, 0.6, 0.8)


def block(n, **options):
    """On 30 degrees, with a yield of n g along the plane, and of (n + 1) g up it, which no motion here reaches."""
    return newmark.Block(30, (n + 0.5) / math.cos(B), **options)


def up_the_plane(motion):
    """A plane that falls to the right by 30 degrees: up it is to the left."""
    return motion.reversed().along(-30)


def noise(seed=1, n=400, size=4.0, uneven=False):
    dice = np.random.RandomState(seed)
    times = 0.01 * np.r_[0, np.cumsum(dice.uniform(0.5, 1.5, n - 1) if uneven else np.ones(n - 1))]

    def smooth():
        return np.convolve(dice.normal(size=n + 9), np.ones(10) / 10**0.5, mode="valid")

    return motions.GroundMotion(times, size * smooth(), 0.4 * size * smooth())


# ---- closed forms ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "a, n, duration, metres", [(0.5, 0.1, 0.2, 0.3924), (1.0, 0.5, 0.3, 0.44145), (0.4, 0.2, 1.0, 1.962)]
)
def test_a_rectangular_pulse(a, n, duration, metres):
    """½ g A T² (A/N − 1), to the last digits: nothing is sampled. It stops at V/(g N)."""
    found = newmark.slide(block(n), up_the_plane(made_up.rectangular(a * G, duration)))
    closed = 0.5 * G * a * duration**2 * (a / n - 1)
    assert closed == pytest.approx(metres, abs=1e-9)
    assert found.permanent == pytest.approx(closed, rel=1e-12)
    assert found.times[-1] == pytest.approx(a * duration / n, rel=1e-12)
    assert found.velocity[-1] == 0 and found.velocity.max() == pytest.approx(G * (a - n) * duration, rel=1e-12)


def sine_slide(a, n, omega, longest):
    """Slip [m] of a block under A g sin(ω t) from its yield to its stop, integrated by hand, and the time of the
    stop; after ``longest`` the motion is over.
    """
    begin = math.asin(n / a) / omega

    def speed(t):
        on = min(t, longest)
        return G * (a / omega * (math.cos(omega * begin) - math.cos(omega * on)) - n * (t - begin))

    stop = brentq(speed, (math.pi - omega * begin) / omega, 100 * longest)
    on = min(stop, longest)
    gained = (
        a / omega * (math.cos(omega * begin) * (on - begin) - (math.sin(omega * on) - math.sin(omega * begin)) / omega)
    )
    late = a / omega * (math.cos(omega * begin) - math.cos(omega * on)) * (stop - on)
    return G * (gained + late - 0.5 * n * (stop - begin) ** 2), stop


@pytest.mark.parametrize(
    "a, n, duration, metres", [(0.5, 0.1, 0.2, 0.14032), (1.0, 0.5, 0.3, 0.12202), (1.0, 0.8, 0.5, 0.04667)]
)
def test_a_half_sine(a, n, duration, metres):
    closed, stop = sine_slide(a, n, math.pi / duration, duration)
    assert closed == pytest.approx(metres, abs=6e-6)  # as printed
    found = newmark.slide(block(n), up_the_plane(made_up.half_sine(a * G, duration)))
    assert found.permanent == pytest.approx(closed, rel=2e-5)  # a thousand straight pieces for a sine
    assert found.times[-1] == pytest.approx(max(stop, duration), rel=1e-5)


@pytest.mark.parametrize("n, metres", zip(YIELDS, (1.182179, 0.891448, 0.466652, 0.195903, 0.046665)))
def test_a_cycle_of_a_sine(n, metres):
    closed, stop = sine_slide(1.0, n, 2 * math.pi, 1.0)
    assert stop < 1.0 and closed == pytest.approx(metres, abs=6e-7)
    motion = up_the_plane(made_up.sine(G, 1.0))
    for both_ways in (True, False):
        found = newmark.slide(block(n, both_ways=both_ways), motion)
        assert found.permanent == pytest.approx(closed, rel=2e-5)
    # of three cycles each slides as far: the block has come to rest before the next one
    assert newmark.slide(block(n), up_the_plane(made_up.sine(G, 1.0, 3))).permanent == pytest.approx(
        3 * closed, rel=2e-5
    )


@pytest.mark.parametrize("dip, friction, along, horizontal", [(10, math.tan(math.radians(30)), 0.39493, 0.36397)])
def test_yield_accelerations(dip, friction, along, horizontal):
    """g sin(φ − β)/cos φ, and g tan(φ − β)."""
    one = newmark.Block(dip, friction)
    assert one.yield_acceleration("along") == pytest.approx(along * G, rel=1e-4)
    assert one.yield_acceleration() == pytest.approx(horizontal * G, rel=1e-4)
    limit = one.yield_acceleration()
    for side in (1, -1):
        for share, slips in ((0.9999, False), (1.0001, True)):
            shaken = made_up.rectangular(share * limit, 1.0)
            turned = newmark.Block(dip, friction, side=side)
            found = newmark.slide(turned, shaken.reversed() if side == 1 else shaken)
            assert (found.permanent > 0) == slips
            # up the plane it bears more
            assert newmark.slide(turned, shaken if side == 1 else shaken.reversed()).permanent == 0
    for way in ("up", ["along"], None):
        with pytest.raises(newmark.NewmarkError, match="^way .*: give one of horizontal, along$"):
            one.yield_acceleration(way)


def test_cohesion_is_friction_under_a_constant_pressure():
    """c/m is as much as μ g cos β of friction, where nothing presses the block otherwise."""
    motion = up_the_plane(made_up.sine(G, 1.0))
    mass = 2500 * 10.0
    cohesion = 0.3 * G * math.cos(B) * mass
    bound = newmark.Block(30, 0.5, cohesion=cohesion, mass_per_area=mass)
    assert newmark.slide(bound, motion).permanent == pytest.approx(
        newmark.slide(newmark.Block(30, 0.8), motion).permanent
    )
    assert bound.yield_acceleration("along") == pytest.approx(newmark.Block(30, 0.8).yield_acceleration("along"))
    assert bound.yield_acceleration() > newmark.Block(30, 0.8).yield_acceleration()  # a shake out of the plane


# ---- what must not matter -------------------------------------------------------------------------------

SHAKEN = newmark.Block(20, 0.45)


@pytest.mark.parametrize("s", [0.1, 3.0])
def test_times_that_are_longer_by_a_factor_slide_by_its_square(s):
    motion = noise(uneven=True)
    longer = motions.GroundMotion(s * motion.times, motion.horizontal, motion.vertical)
    one, other = newmark.slide(SHAKEN, motion), newmark.slide(SHAKEN, longer)
    assert one.permanent > 0.01 and other.permanent == pytest.approx(s**2 * one.permanent, rel=1e-9)
    assert other.at(s * motion.times) == pytest.approx(s**2 * one.at(motion.times), rel=1e-9, abs=1e-12)


def test_accelerations_and_gravity_that_are_larger_by_a_factor_slide_by_it():
    motion = noise()
    larger = newmark.slide(newmark.Block(20, 0.45, gravity=2 * G), motion.scaled(factor=2))
    assert larger.permanent == pytest.approx(2 * newmark.slide(SHAKEN, motion).permanent, rel=1e-12)


@pytest.mark.parametrize("both_ways", [True, False])
def test_a_mirrored_slope_slides_as_far(both_ways):
    for seed in range(5):
        one, other = (newmark.Block(20, 0.45, side=side, both_ways=both_ways) for side in (1, -1))
        motion = noise(seed)
        left, right = newmark.slide(one, motion), newmark.slide(other, motion.reversed())
        assert np.array_equal(left.displacement, right.displacement) and np.array_equal(left.times, right.times)


def test_on_a_level_plane_both_ways_are_the_same():
    level, motion = newmark.Block(0, 0.2), noise(3)
    there, back = newmark.slide(level, motion), newmark.slide(level, motion.reversed())
    assert back.permanent == pytest.approx(-there.permanent, rel=1e-9) and abs(there.permanent) > 0.01
    assert back.at(motion.times) == pytest.approx(-there.at(motion.times), abs=1e-12)


@pytest.mark.parametrize("held", [SHAKEN, newmark.Block(0, 0.05)])  # the second one turns round without a rest
def test_pieces_that_are_cut_in_parts_change_nothing(held):
    motion = noise(uneven=True)
    times = np.sort(np.r_[motion.times, 0.5 * (motion.times[1:] + motion.times[:-1])])
    cut = motions.GroundMotion(times, *motion.acceleration(times).T)
    one, other = newmark.slide(held, motion), newmark.slide(held, cut)
    assert other.at(times) == pytest.approx(one.at(times), abs=1e-11)


def by_small_steps(one, motion, dt):
    """Slip at the end by implicit steps of ``dt``: the speed that friction leaves, or none."""
    edges = np.arange(motion.times[0], motion.times[-1] + 3.0, dt)
    drive, _, bears = one.drive_and_resistance(motion.mean_over(edges[:-1], edges[1:]))
    v = x = 0.0
    for d, s in zip(drive.tolist(), bears.tolist()):
        free = v + dt * d
        v = max(free - dt * s, 0.0) if free > 0 else min(free + dt * s, 0.0) if one.both_ways else 0.0
        x += dt * v
    return x


@pytest.mark.parametrize("both_ways", [True, False])
@pytest.mark.parametrize("seed", [1, 2])
def test_small_steps_come_nearer_as_they_become_smaller(seed, both_ways):
    motion, one = noise(seed, n=200), newmark.Block(12, 0.3, both_ways=both_ways)
    exact = newmark.slide(one, motion).permanent
    errors = [abs(by_small_steps(one, motion, dt) - exact) for dt in (4e-3, 1e-3, 2.5e-4)]
    assert errors[2] < 0.15 * errors[0] and errors[2] < 2e-3 * abs(exact)  # of the first order: a sixteenth


def test_a_block_slides_up_where_it_is_pushed_up_and_may():
    motion = made_up.sine(G, 1.0)
    free, held = (newmark.slide(newmark.Block(10, 0.3, both_ways=way), motion) for way in (True, False))
    assert free.displacement.min() < 0 and held.displacement.min() == 0 and held.permanent > free.permanent
    assert free.velocity.min() < 0 and held.velocity.min() >= 0


def test_a_block_turns_round_within_a_piece():
    """On a level plane, from a pull of −4 to one of 4 m/s² in 1 s against 1 m/s² of friction: v = −3 t + 4 t² until
    3/4 s, where the pull is 2 m/s²; then, with u = t − 3/4, u + 4 u²; after 1 s it comes to rest.
    """
    level = newmark.Block(0, 0.1, gravity=10.0)
    found = newmark.slide(level, motions.GroundMotion([0, 1], [4.0, -4.0]))
    left = -1.5 * 0.75**2 + 4 * 0.75**3 / 3
    speed, right = 0.25 + 4 * 0.25**2, 0.5 * 0.25**2 + 4 * 0.25**3 / 3
    assert found.displacement.min() == pytest.approx(left, rel=1e-12) and 0.75 == pytest.approx(found.times[1])
    assert found.velocity[2] == pytest.approx(speed, rel=1e-12)
    assert found.permanent == pytest.approx(left + right + 0.5 * speed**2, rel=1e-12)


def test_the_vertical_component_presses_the_block_and_relieves_it():
    """On a level plane, μ (g + a_y): a push of 3 m/s² over 1 s, with the ground going up and down by 4 m/s²."""
    level = newmark.Block(0, 0.25)
    for vertical in (4.0, -4.0, 0.0):
        motion = motions.GroundMotion([0, 1], [-3.0, -3.0], [vertical, vertical])
        gained = max(3.0 - 0.25 * (G + vertical), 0.0)
        after = (gained * 1.0) ** 2 / (2 * 0.25 * G)
        assert newmark.slide(level, motion).permanent == pytest.approx(0.5 * gained + after, abs=1e-14)


# ---- the slide ------------------------------------------------------------------------------------------


def test_a_slide_is_continuous_and_holds_at_any_time():
    found = newmark.slide(SHAKEN, noise(uneven=True))
    assert (np.diff(found.times) > 0).all() and found.displacement[0] == 0
    before = found.times[1:] - 1e-9
    assert found.at(before) == pytest.approx(found.displacement[1:], abs=1e-8)
    middle = 0.5 * (found.times[1:] + found.times[:-1])
    h = 1e-6 * np.diff(found.times)
    speed = (found.at(middle + h) - found.at(middle - h)) / (2 * h)
    later = np.interp(middle, found.times, found.velocity)
    assert speed == pytest.approx(later, abs=0.02) and np.corrcoef(speed, later)[0, 1] > 0.9999
    assert found.at([-5.0, 1e6]).tolist() == [0.0, found.permanent]


def test_a_motion_below_the_yield_moves_nothing():
    found = newmark.slide(SHAKEN, made_up.sine(0.9 * SHAKEN.yield_acceleration(), 1.0))
    assert found.permanent == 0 and not found.displacement.any() and found.times[-1] == 1.0


def test_a_pull_that_only_just_begins_ends_and_goes_on():
    """Drives that touch the resistance, cross it for a moment, and begin with it."""
    limit = newmark.Block(0, 0.25).yield_acceleration()
    for shape in ([1, 1 + 1e-15, 1], [0, 1, 0], [1, 2, 1], [1 + 1e-15, 1, 1 + 1e-15], [1, 1, 1], [2, 1, 0, 1, 2]):
        motion = motions.GroundMotion(100 + 0.01 * np.arange(len(shape)), -limit * np.array(shape, float))
        found = newmark.slide(newmark.Block(0, 0.25), motion)
        assert np.isfinite(found.displacement).all() and 0 <= found.permanent < 1e-2


# ---- what is no block -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "options, message",
    [
        (dict(dip="30"), "dip '30': give degrees, from 0 to less than 90"),
        (dict(dip=90), "dip 90: give degrees"),
        (dict(dip=-10), "dip -10: give degrees"),
        (dict(friction=-0.1), "friction -0.1: give a coefficient from 0"),
        (dict(friction=math.nan), "friction nan: give"),
        (dict(friction=0.5), "friction 0.5, cohesion 0 Pa on a dip of 30 degrees: the block slides without shaking; give a "
         "friction above 0.5774, or a cohesion"),
        (dict(cohesion=1e5), "cohesion 100000 Pa without mass_per_area: give density times thickness"),
        (dict(cohesion=-1), "cohesion -1: give a cohesion from 0 in Pa"),
        (dict(mass_per_area=0), "mass_per_area 0: give density times thickness in kg/m², above 0"),
        (dict(gravity=0), "gravity 0: give an acceleration above 0"),
        (dict(side=0), "side 0: give 1 where the plane falls to the right, -1 to the left"),
        (dict(side=[1]), r"side \[1\]: give 1 where"),
        (dict(both_ways=1), "both_ways 1: give True or False"),
    ],
)  # fmt: skip
def test_what_is_no_block(options, message):
    with pytest.raises(newmark.NewmarkError, match=f"^{message}"):
        newmark.Block(**{"dip": 30, "friction": 0.7, **options})


def test_a_block_that_flies_and_arguments_of_another_kind():
    with pytest.raises(
        newmark.NewmarkError, match="^motion at 1 s: the ground falls away from the block.*smaller motion$"
    ):
        newmark.slide(SHAKEN, motions.GroundMotion([0, 1], [0, 0], [0, -10.0]))
    with pytest.raises(newmark.NewmarkError, match="^block 'block': give a newmark.Block$"):
        newmark.slide("block", noise())
    with pytest.raises(newmark.NewmarkError, match="^motion .*: give a GroundMotion"):
        newmark.slide(SHAKEN, [1, 2])
