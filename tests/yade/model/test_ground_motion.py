"""The motion of the ground: exact integrals, numbers, changes that are asked for, made-up motions, and what is refused.
Needs no YADE.
"""

import math

import numpy as np
import pytest

import synthetic_slope as package

motions, made_up, errors = (
    package.load(name) for name in ("model.ground_motion", "model.ground_motion.synthetic", "errors")
)
G = 9.80665  # of the unit g, and of Arias' intensity
TRIANGLE = motions.GroundMotion([1.0, 2.0, 4.0], [0.0, 3.0, 0.0], [0.0, -1.0, 1.0])


def noise(n=400, seed=1, uneven=False, vertical=True):
    dice = np.random.RandomState(seed)
    steps = dice.uniform(0.5, 1.5, n - 1) if uneven else np.ones(n - 1)
    times = 0.37 + 0.01 * np.r_[0, np.cumsum(steps)]
    return motions.GroundMotion(times, dice.normal(size=n), dice.normal(size=n) if vertical else None)


# ---- integrals ------------------------------------------------------------------------------------------


def test_a_triangle_by_hand():
    """3 (t − 1) m/s² up to 2 s, then down with 1.5 m/s³ to 4 s."""
    at = [0.0, 1.0, 1.5, 2.0, 3.0, 4.0, 9.0]
    assert TRIANGLE.acceleration(at)[:, 0] == pytest.approx([0, 0, 1.5, 3, 1.5, 0, 0], abs=1e-15)
    assert TRIANGLE.velocity(at)[:, 0] == pytest.approx([0, 0, 0.375, 1.5, 3.75, 4.5, 4.5], abs=1e-15)
    # t³/2, then 0.5 + 1.5 s + 1.5 s² − 0.25 s³, then 4.5 m/s
    assert TRIANGLE.displacement(at)[:, 0] == pytest.approx([0, 0, 0.0625, 0.5, 3.25, 7.5, 30.0], abs=1e-14)
    assert TRIANGLE.velocity(4.0)[1] == pytest.approx(-0.5) and TRIANGLE.velocity(3.0).shape == (2,)
    for call in (TRIANGLE.acceleration, TRIANGLE.velocity, TRIANGLE.displacement):
        assert call(np.zeros((2, 3))).shape == (2, 3, 2) and call(1.5).shape == (2,)
        assert call(np.array([[1.5], [3.0]]))[1, 0] == pytest.approx(call(3.0))
    assert TRIANGLE.drift.velocity == pytest.approx((4.5, -0.5))
    # −1/6, then −1/2 s − s²/2 + s³/6 of 2 s
    assert TRIANGLE.drift.displacement == pytest.approx((7.5, -1 / 6 - 1 - 2 + 4 / 3))


def test_before_and_after_the_record_the_ground_has_no_acceleration():
    pulse = motions.GroundMotion([0.0, 1.0], [2.0, 2.0])
    assert pulse.acceleration([-1e-9, 0, 1, 1 + 1e-9])[:, 0].tolist() == [0, 2, 2, 0]
    assert pulse.vertical.tolist() == [0, 0]


@pytest.mark.parametrize("uneven", [False, True])
def test_velocity_and_displacement_are_integrals_of_what_lies_below_them(uneven):
    """Against Simpson's rule within each piece, which is exact for the cubics here."""
    motion = noise(uneven=uneven)
    t = motion.times
    middle = 0.5 * (t[:-1] + t[1:])
    for whole, part in ((motion.velocity, motion.acceleration), (motion.displacement, motion.velocity)):
        grown = np.diff(t)[:, None] * (part(t[:-1]) + 4 * part(middle) + part(t[1:])) / 6
        if part == motion.acceleration:  # which is zero beyond the ends, and not at them
            assert part(t[[0, -1]])[:, 0] == pytest.approx(motion.horizontal[[0, -1]])
        assert np.cumsum(grown, axis=0) == pytest.approx(whole(t[1:]) - whole(t[0]), abs=1e-12)


@pytest.mark.parametrize("dt", [0.0007, 0.01, 0.013, 0.4, 3.0])
def test_means_over_steps_add_up_to_the_integral(dt):
    """Whatever the steps: they cut pieces anywhere, are longer than these, and begin before the record."""
    motion = noise(uneven=True)
    edges = np.arange(-0.1, motion.times[-1] + dt, dt)
    means = motion.mean_over(edges[:-1], edges[1:])
    assert means.shape == (len(edges) - 1, 2)
    assert np.sum(means * np.diff(edges)[:, None], axis=0) == pytest.approx(motion.drift.velocity, abs=1e-13)
    # and each is that of the piece it covers, by a fine sum
    fine = np.linspace(edges[1], edges[2], 200_001)
    middle = 0.5 * (fine[1:] + fine[:-1])
    assert means[1] == pytest.approx(motion.acceleration(middle).mean(axis=0), abs=2e-5)


def test_a_mean_is_asked_for_of_a_step_that_ends_later():
    assert TRIANGLE.mean_over(1.0, 2.0) == pytest.approx([1.5, -0.5])
    for begin, end in ((1.0, 1.0), (2.0, 1.0), ([0.0, 3.0], [1.0, 2.0])):
        with pytest.raises(motions.GroundMotionError, match="give steps that end after they begin"):
            TRIANGLE.mean_over(begin, end)
    for call in (TRIANGLE.velocity, TRIANGLE.displacement, TRIANGLE.acceleration):
        for value in ("1", None, [1, math.nan], [[1], [2, 3]], 1j):
            with pytest.raises(motions.GroundMotionError, match="^times .*: give seconds, finite numbers$"):
                call(value)


# ---- numbers --------------------------------------------------------------------------------------------


def test_peaks():
    motion = motions.GroundMotion([0, 1, 2, 3], [2.0, -4.0, 1.0, 1.0], [1.0, 1.0, 1.0, 1.0])
    assert motion.peak_acceleration() == 4 and motion.peak_acceleration("vertical") == 1
    # it turns at 1/3 s with 1/3 m/s, falls by 2/3 of 4/2 until 1 s and 4/5 of 4/2 until 1.8 s: −2.6 m/s
    assert motion.peak_velocity() == pytest.approx(-(1 / 3 - 4 / 3 - 1.6))
    assert motion.peak_velocity("vertical") == pytest.approx(3.0)
    for component in ("sideways", ["vertical"], 1):
        with pytest.raises(motions.GroundMotionError, match="^component .*: give one of horizontal, vertical$"):
            motion.peak_velocity(component)


def test_arias_intensity_and_duration_of_a_rectangle_and_of_a_ramp():
    rectangle = made_up.rectangular(2.0, 3.0)
    assert rectangle.arias_intensity() == pytest.approx(math.pi / (2 * G) * 12)
    assert rectangle.significant_duration() == pytest.approx(0.9 * 3)
    ramp = motions.GroundMotion([0, 1], [0, 6.0])
    assert ramp.arias_intensity() == pytest.approx(math.pi / (2 * G) * 12)
    assert ramp.significant_duration() == pytest.approx(0.95 ** (1 / 3) - 0.05 ** (1 / 3))  # t³
    assert ramp.significant_duration("vertical") == 0 == ramp.arias_intensity("vertical")
    # a whole number of sines: half of the square of the peak
    sine = made_up.sine(3.0, 2.0, cycles=4)
    assert sine.arias_intensity() == pytest.approx(math.pi / (2 * G) * 4.5 * 2, rel=2e-6)


def test_a_description_has_all_that_is_told():
    told = TRIANGLE.describe()
    for words in (
        "ground motion (arrays)", "3 values over 3 s, from 1 s on", "horizontal: PGA 3 m/s² (0.306 g), PGV 4.5 m/s",
        "horizontal, left at the end of the record: velocity 4.5 m/s, displacement 7.5 m", "vertical, left at the end",
    ):  # fmt: skip
        assert words in told
    assert "vertical: none" in made_up.rectangular(1, 1).describe()


# ---- other motions --------------------------------------------------------------------------------------


def test_a_motion_is_scaled_by_its_horizontal_peak_or_by_a_factor():
    for scaled in (TRIANGLE.scaled(peak=1.5), TRIANGLE.scaled(factor=0.5)):
        assert scaled.horizontal == pytest.approx([0, 1.5, 0]) and scaled.vertical == pytest.approx([0, -0.5, 0.5])
        assert scaled.source == "arrays; times 0.5"
    for options in ({}, dict(peak=1, factor=1), dict(peak=0), dict(factor=-1), dict(peak="1"), dict(factor=math.nan)):
        with pytest.raises(motions.GroundMotionError, match="give "):
            TRIANGLE.scaled(**options)
    with pytest.raises(motions.GroundMotionError, match="the horizontal motion is zero; give a factor"):
        motions.GroundMotion([0, 1], [0, 0]).scaled(peak=1)


def test_a_motion_that_is_reversed_begins_later_or_goes_along_a_line():
    back = TRIANGLE.reversed()
    assert back.horizontal == pytest.approx([0, -3, 0]) and back.vertical.tolist() == TRIANGLE.vertical.tolist()
    assert back.reversed().drift == TRIANGLE.drift
    late = TRIANGLE.starting(10.0)
    assert late.times.tolist() == [10, 11, 13] and late.drift == TRIANGLE.drift
    up = motions.GroundMotion([0, 1], [2, 2]).along(30)
    assert up.horizontal == pytest.approx([3**0.5] * 2) and up.vertical == pytest.approx([1, 1])
    assert motions.GroundMotion([0, 1], [2, 2]).along(-30).vertical == pytest.approx([-1, -1])
    with pytest.raises(motions.GroundMotionError, match="has a vertical component already"):
        TRIANGLE.along(10)
    for call in (up.along, late.starting, up.resampled):
        with pytest.raises(motions.GroundMotionError, match="give "):
            call("1")
    for angle in (90.5, -90.5):
        with pytest.raises(motions.GroundMotionError, match=f"^angle {angle}: give degrees from -90 to 90"):
            motions.GroundMotion([0, 1], [2, 2]).along(angle)


def test_resampled_values_lie_on_the_straight_pieces_and_end_with_the_record():
    again = TRIANGLE.resampled(0.7)
    assert again.times == pytest.approx([1.0, 1.7, 2.4, 3.1, 3.8, 4.0]) and again.times[-1] == 4.0
    assert again.horizontal == pytest.approx([0, 2.1, 2.4, 1.35, 0.3, 0])
    assert "resampled at 0.7 s" in again.source
    same = TRIANGLE.resampled(0.5)  # on all of its times: the same motion
    assert same.drift.displacement == pytest.approx(TRIANGLE.drift.displacement) and len(same.times) == 7
    for step in (0, -1, 3.1, 1e-9, math.nan):
        with pytest.raises(motions.GroundMotionError, match="^step .*: give seconds, from"):
            TRIANGLE.resampled(step)


def test_a_baseline_is_corrected_when_asked_and_only_then():
    motion = noise(uneven=True)
    scale = np.abs(motion.displacement(motion.times)).max()
    constant, line = motion.corrected("constant"), motion.corrected("line")
    assert max(np.abs(motion.drift.velocity)) > 0.01 and max(np.abs(motion.drift.displacement)) > 0.01
    assert constant.drift.velocity == pytest.approx((0, 0), abs=1e-13)
    assert constant.horizontal - motion.horizontal == pytest.approx(
        -motion.drift.velocity[0] / motion.duration, abs=1e-13
    )
    assert line.drift.velocity == pytest.approx((0, 0), abs=1e-13)
    assert line.drift.displacement == pytest.approx((0, 0), abs=1e-13 * max(1, scale))
    taken = np.polyfit(motion.times, motion.vertical - line.vertical, 1)
    assert np.polyval(taken, motion.times) == pytest.approx(motion.vertical - line.vertical, abs=1e-12)
    assert "constant taken from it, with no velocity at the end" in constant.source
    assert "line taken from it, with neither velocity nor displacement at the end" in line.source
    for baseline in ("filter", ["line"], None):
        with pytest.raises(motions.GroundMotionError, match="^baseline .*: give one of constant, line$"):
            motion.corrected(baseline)


# ---- what is no motion ----------------------------------------------------------------------------------


def test_arrays_are_kept_as_they_were():
    given = np.array([0.0, 1.0])
    motion = motions.GroundMotion([0, 1], given)
    given[0] = 5.0
    assert motion.horizontal[0] == 0.0 and not motion.times.flags.writeable
    with pytest.raises(ValueError):
        motion.horizontal[0] = 1.0


@pytest.mark.parametrize(
    "given, message",
    [
        (([0, 1], [1, 2, 3]), "times have 2 values, horizontal 3 and vertical 3: give one acceleration of each"),
        (([0, 1], [1, 2], [1]), "times have 2 values, horizontal 2 and vertical 1"),
        (([0], [1]), "times have 1 values"),
        (([], []), "times .*: give numbers|times have 0 values"),
        (([0, 1, 1], [1, 2, 3]), r"times\[2\] 1.0 comes after 1.0: give times that rise"),
        (([0, 2, 1], [1, 2, 3]), r"times\[2\] 1.0 comes after 2.0"),
        (([0, 1], [1, math.nan]), r"horizontal\[1\] nan: give a finite number"),
        (([0, 1], [1, 2], [math.inf, 1]), r"vertical\[0\] inf: give a finite number"),
        (([0, math.nan], [1, 2]), r"times\[1\] nan: give a finite number"),
        (([0, 1], [1, 981]), r"horizontal\[1\] 981: give m/s², at most 98"),
        (([0, 1e7], [1, 2]), r"times\[1\] 1e\+07: give s, at most 1e\+06"),
        (([0, 1], "ab"), "horizontal 'ab': give numbers"),
        (([0, 1], ["1", "2"]), r"horizontal \['1', '2'\]: give numbers"),
        (([0, 1], [1j, 2]), "horizontal .*: give numbers"),
        (([0, 1], np.array([1j, 2])), "horizontal .*: give numbers"),
        (([0, 1], [True, False]), "horizontal .*: give numbers"),
        (([0, 1], [[1, 2], [3, 4]]), "horizontal .*: give numbers"),
        (([0, 1], [[1], [3, 4]]), "horizontal .*: give numbers"),
        ((None, [1, 2]), "times None: give numbers"),
        (([0, 1], None), "horizontal None: give numbers"),
    ],
)
def test_what_is_no_motion_is_told_in_one_line(given, message):
    with pytest.raises(errors.UserError, match=f"^({message})") as refusal:
        motions.GroundMotion(*given)
    assert "\n" not in str(refusal.value)


def test_a_name_is_words():
    with pytest.raises(motions.GroundMotionError, match="^name 3: give words$"):
        motions.GroundMotion([0, 1], [1, 1], name=3)


# ---- made-up motions ------------------------------------------------------------------------------------


def test_pulses_and_sines():
    rectangle = made_up.rectangular(4.0, 0.2)
    assert rectangle.drift.velocity[0] == pytest.approx(0.8) and rectangle.duration == 0.2
    half = made_up.half_sine(4.0, 0.5)
    assert half.peak_acceleration() == 4.0 and half.duration == 0.5
    assert half.drift.velocity[0] == pytest.approx(2 * 4 * 0.5 / math.pi, rel=1e-6)
    sine = made_up.sine(9.81, 2.0, cycles=3)
    assert sine.duration == 1.5 and sine.peak_acceleration() == 9.81
    assert sine.drift.velocity[0] == pytest.approx(0, abs=1e-12)
    assert sine.peak_velocity() == pytest.approx(9.81 / (2 * math.pi), rel=1e-6)  # 2 a / ω
    assert sine.horizontal[: len(half.times)] == pytest.approx(9.81 / 4 * half.horizontal, abs=1e-14)
    assert np.array_equal(sine.horizontal[2000:4000], sine.horizontal[:2000])
    for motion in (rectangle, half, sine, made_up.stochastic(1, 10, 2, 1)):
        assert motion.name.startswith("synthetic") and motion.source.startswith("synthetic: ")


def test_a_made_up_earthquake_has_its_peak_and_the_same_bits_for_the_same_seed():
    one, same, other = (made_up.stochastic(3.0, 20.0, 2.0, seed) for seed in (7, 7, 8))
    assert np.array_equal(one.horizontal, same.horizontal) and not np.array_equal(one.horizontal, other.horizontal)
    assert one.peak_acceleration() == 3.0 and one.times[-1] == pytest.approx(20) and not one.vertical.any()
    both = made_up.stochastic(3.0, 20.0, 2.0, 7, vertical_peak=1.0)
    assert np.array_equal(both.horizontal, one.horizontal) and both.peak_acceleration("vertical") == 1.0
    assert abs(np.corrcoef(both.horizontal, both.vertical)[0, 1]) < 0.2  # 2,000 values, some 80 periods
    # written down, so that they stay what they are
    assert made_up.stochastic(1.0, 20.0, 2.0, 7).horizontal[[100, 500, 1000]].tolist() == PINNED


PINNED = [0.086670094, 0.174684752, -0.18163675]


def test_a_made_up_earthquake_has_the_frequency_and_the_envelope_that_were_asked_for():
    """Means over seeds: the largest power lies near the frequency, where the spectrum of Kanai and Tajimi has it; what
    is slow is missing; the square of the envelope, which is largest after a fifth, is followed.
    """
    for frequency in (1.0, 4.0):
        rows = [made_up.stochastic(1.0, 20.0, frequency, seed).horizontal for seed in range(60)]
        power = np.mean([np.abs(np.fft.rfft(row)) ** 2 for row in rows], axis=0)
        f = np.fft.rfftfreq(len(rows[0]), 0.01)
        smooth = np.convolve(power, np.ones(9) / 9, mode="same")
        assert f[np.argmax(smooth)] == pytest.approx(frequency, rel=0.25)  # a flat top, and 60 seeds
        assert frequency < 4 or power[np.searchsorted(f, 0.1)] < 0.05 * smooth.max()
        square = np.mean(np.square(rows), axis=0)
        centre = np.average(np.arange(len(square)), weights=square) * 0.01
        t = np.arange(1, 2001) * 0.01
        b = -0.2 * math.log(0.05) / (1 + 0.2 * (math.log(0.2) - 1))
        envelope = (t / 4) ** b * np.exp(b * (1 - t / 4))
        assert envelope.max() == pytest.approx(1) and envelope[-1] == pytest.approx(0.05)
        assert centre == pytest.approx(np.average(t, weights=envelope**2), rel=0.06)


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: made_up.rectangular(0, 1), "peak 0: give m/s² above 0"),
        (lambda: made_up.half_sine(1, -1), "duration -1: give seconds above 0"),
        (lambda: made_up.sine(1, "2"), "frequency '2': give Hz above 0"),
        (lambda: made_up.sine(1, 2, cycles=0.5), "cycles 0.5: give a whole number from 1 to 500"),
        (lambda: made_up.sine(200, 2), r"horizontal\[\d+\] .*: give m/s², at most 98"),
        (lambda: made_up.stochastic(1, 10, 2, seed=-1), "seed -1: give a whole number from 0"),
        (lambda: made_up.stochastic(1, 10, 2, seed=1.5), "seed 1.5: give a whole number"),
        (lambda: made_up.stochastic(1, 10, 2, seed=2**32), "seed 4294967296: give a whole number"),
        (lambda: made_up.stochastic(1, 10, 20, seed=1), "step 0.01: give seconds, from 1e-05 to 0.005"),
        (lambda: made_up.stochastic(1, 10, 2, 1, damping=0), "damping 0: give a number from 0.05 to 2"),
        (lambda: made_up.stochastic(1, 10, 2, 1, vertical_peak=-1), "vertical_peak -1: give 0 or more m/s²"),
    ],
)
def test_what_makes_no_motion(call, message):
    with pytest.raises(motions.GroundMotionError, match=f"^{message}"):
        call()
