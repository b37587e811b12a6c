"""Strength and shear bands from made-up curves, circles and rotations whose answers are known. Needs no YADE."""

import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import synthetic_slope as synthetic  # noqa: E402

bands, strength, statistics = (
    synthetic.load(name) for name in ("measure.bands", "measure.strength", "measure.statistics")
)


# ---- curves and envelopes -------------------------------------------------------------------------


def test_envelope_finds_the_line_that_touches_all_circles():
    c, angle = 88e3, math.radians(38.5)
    minor = np.array([0.25, 0.5, 1, 2, 4, 8, 16]) * 1e6
    major = minor * math.tan(math.pi / 4 + angle / 2) ** 2 + 2 * c * math.tan(math.pi / 4 + angle / 2)
    found = strength.envelope(minor, major)
    # rounding
    assert found.cohesion == pytest.approx(c, rel=1e-9) and found.friction_deg == pytest.approx(38.5, rel=1e-9)
    assert np.abs(found.misses).max() < 1e-12
    assert found.strength(minor) == pytest.approx(major, rel=1e-9)
    # circles whose line would cut the axis below zero: without cohesion the best is the mean of t/s, weighed by s/t
    bent = strength.envelope(minor, minor * np.linspace(3.6, 4.4, 7))
    s, t = minor * (np.linspace(3.6, 4.4, 7) + 1) / 2, minor * (np.linspace(3.6, 4.4, 7) - 1) / 2
    assert bent.cohesion == 0 and math.sin(math.radians(bent.friction_deg)) == pytest.approx(
        (s / t).sum() / (s**2 / t**2).sum(), rel=1e-9
    )
    with pytest.raises(ValueError, match="two confining pressures"):
        strength.envelope([1e6, 1e6], [4e6, 4.1e6])


def made_curve(noise=0.0):
    strain = np.arange(1, 601) * 1e-4
    rng = np.random.default_rng(1)
    axial = 27e6 + 8e6 * np.exp(-(((strain - 0.015) / 0.006) ** 2)) + noise * rng.standard_normal(len(strain))
    # dε_v/dε₁ = 0.5 everywhere: sin ψ = 0.5/2.5
    return {
        "strain": strain,
        "volumetric_strain": 0.5 * strain,
        "sigma1_top_Pa": 1.01 * axial,
        "sigma1_bottom_Pa": 0.99 * axial,
        "sigma3_left_Pa": np.full(600, 8e6),
        "sigma3_right_Pa": np.full(600, 8.2e6),
    }


def early_curve(later=0.0):
    """A stress that rises to 5 MPa at 0.05 % of strain and has fallen to 4 at 0.2 %, where it stays; ``later`` [Pa] more
    from 1 % on. Rows are as fine as a biaxial test's where its platens take up their speed.
    """
    strain = np.r_[np.arange(1, 100) * 2e-5, np.arange(20, 301) * 1e-4]
    axial = np.interp(strain - np.diff(strain, prepend=0) / 2, [0, 5e-4, 2e-3], [1e6, 5e6, 4e6]) + later * (
        strain > 0.01
    )
    return {
        "strain": strain,
        "sigma1_top_Pa": 1.02 * axial,
        "sigma1_bottom_Pa": 0.98 * axial,
        "sigma3_left_Pa": 1e6 + 1e9 * strain,
        "sigma3_right_Pa": 1e6 + 1e9 * strain,
    }


def test_what_a_sample_bears_as_it_begins_to_fail_is_the_largest_stress_before_it_does():
    """Of the triangle's top, 0.02 % of strain wide, the mean is highest where both ends are as high: x before and 0.02 %
    - x after it, with slopes of 8 and 2/3 GPa: x = 0.02/13 %. What comes after half a per cent does not count, and a
    peak's window, ten times as wide, tells less.
    """
    x = 2e-4 * (2 / 3) / (8 + 2 / 3)
    mean = 5e6 - (8e9 * x**2 + 1e9 / 1.5 * (2e-4 - x) ** 2) / 2 / 2e-4
    for later in (0.0, 3e6):
        minor, major, strain = strength.onset(early_curve(later))
        # windows begin where rows do, which are a tenth of it apart
        assert major == pytest.approx(mean, rel=2e-3) and strain == pytest.approx(5e-4 - x + 1e-4, abs=2e-5)
        assert minor == pytest.approx(1e6 + 1e9 * strain, rel=0.02)  # of the same window
    _, wide = strength.running_mean(early_curve()["strain"], strength.axial_stress(early_curve()), strength.PEAK_WINDOW)
    assert wide.max() < 0.96 * mean
    with pytest.raises(ValueError, match="the test ended at a strain of 0.0020, before 0.005"):
        strength.onset({name: values[:100] for name, values in early_curve().items()})


def test_a_mean_between_two_strains_counts_what_rows_cover():
    """Rows of 0.1, 0.2 and 0.3 % of strain: the mean from 0.1 to 0.6 % is two and three parts of the last two; none
    where the test ends before.
    """
    series = {
        "strain": [0.001, 0.003, 0.006],
        "sigma1_top_Pa": [90.0, 11.0, 21.0],
        "sigma1_bottom_Pa": [90.0, 9.0, 19.0],
    }
    series |= {"sigma3_left_Pa": [0.0, 1.0, 2.0], "sigma3_right_Pa": [0.0, 3.0, 4.0]}
    assert strength.mean_between(series, 0.001, 0.006) == pytest.approx((2.6, 16.0), rel=1e-12)  # rounding
    # a last row that ends short of the window by less than half of it is its end
    assert strength.mean_between(series, 0.001, 0.0074) == pytest.approx((2.6, 16.0), rel=1e-12)
    assert strength.mean_between(series, 0.001, 0.0076) is None


def test_curve_measures_peak_plateau_and_dilatancy():
    c = strength.curve(made_curve(), (0.04, 0.06))
    assert c.peak == pytest.approx(35e6, rel=5e-3)  # the window of 0.2 % of strain takes (0.1/0.6)²/3 of the bump away
    assert c.peak_strain == pytest.approx(0.015, abs=1e-4)
    assert c.residual == pytest.approx(27e6, rel=1e-6) and c.residual_confining == pytest.approx(8.1e6, rel=1e-12)
    assert c.dilatancy_deg == pytest.approx(math.degrees(math.asin(0.2)), rel=1e-9)
    assert c.imbalance == pytest.approx(1.01 / 0.99 - 1, rel=1e-9)


def test_a_peak_is_a_mean_over_strain_and_not_over_rows():
    """Platens that take up their speed make rows that cover little strain; here the first ten cover 0.01 %, all others
    0.01 % each.
    """
    strain = np.concatenate((np.arange(1, 11) * 1e-5, np.arange(2, 101) * 1e-4))
    # 8 until 0.05 %, so that 0.2 % from the begin have the mean (5 * 8 + 15 * 2)/20
    stress = np.where(strain < 5.5e-4, 8.0, 2.0)
    begin, mean = strength.running_mean(strain, stress, 2e-3)
    assert mean[0] == pytest.approx(3.5, rel=1e-12) and begin[0] == 0 and begin[-1] == pytest.approx(0.008)  # rounding
    assert mean[-1] == pytest.approx(2.0, rel=1e-12) and len(begin) == 90
    c = strength.curve(
        {
            "strain": strain,
            "volumetric_strain": 0.5 * strain,
            "sigma1_top_Pa": stress,
            "sigma1_bottom_Pa": stress,
            "sigma3_left_Pa": 0 * strain,
            "sigma3_right_Pa": 0 * strain,
        },
        (0.005, 0.01),
    )
    assert (c.peak, c.peak_strain, c.residual) == pytest.approx((3.5, 1e-3, 2.0), rel=1e-12)


def test_the_shortest_test_can_be_measured():
    end = strength.SHORTEST - 1e-9  # a test ends once it is as near
    short = {
        name: np.interp(np.linspace(1, 40, 40) / 40 * end, made_curve()["strain"], values)
        for name, values in made_curve().items()
    }
    assert strength.curve(short, (strength.PLATEAU * strength.SHORTEST, strength.SHORTEST)).peak > 0


def test_a_curve_without_a_plateau_is_refused():
    short = {name: values[:300] for name, values in made_curve().items()}
    with pytest.raises(ValueError, match="before the plateau"):
        strength.curve(short, (0.04, 0.06))


def test_confidence_over_seeds_is_students():
    e = statistics.Estimate.of([38.0, 39.0, 40.0])
    # t(0.975, 2 degrees of freedom) has 5 digits
    assert e.mean == 39.0 and e.half_width == pytest.approx(4.3027 / math.sqrt(3), rel=1e-4)
    assert math.isnan(statistics.Estimate.of([38.0]).half_width)


@pytest.mark.parametrize("cohesion, friction_deg", [(0.0, 20.0), (5e3, 35.0), (2e6, 10.0), (88e3, 0.0), (1e3, 60.0)])
def test_cohesion_and_angle_come_back_from_circles(cohesion, friction_deg):
    """Of circles that touch τ = c + σ tan φ: σ₁ = σ₃ N + 2 c √N, N = tan²(45° + φ/2); two circles, or many."""
    n = math.tan(math.radians(45 + friction_deg / 2)) ** 2
    for minor in (np.array([1e5, 3e6]), np.geomspace(1e4, 1e7, 12)):
        major = minor * n + 2 * cohesion * math.sqrt(n)
        found = strength.envelope(minor, major)
        # rounding
        assert found.friction_deg == pytest.approx(friction_deg, abs=1e-6) and found.cohesion == pytest.approx(
            cohesion, abs=1e-7 * major.max()
        )
        assert found.strength(2.5e5) == pytest.approx(2.5e5 * n + 2 * cohesion * math.sqrt(n), rel=1e-9)
        s, t = (major + minor) / 2, (major - minor) / 2  # the line is as far from each centre as the radius
        assert (cohesion + s * math.tan(math.radians(friction_deg))) * math.cos(
            math.radians(friction_deg)
        ) == pytest.approx(t, rel=1e-9)


def test_misses_are_relative_and_outside_is_positive():
    """Three circles of one material, the middle one a tenth too strong: it stands out of the line, the others stay
    inside, and all count alike.
    """
    minor = np.array([1e5, 1e6, 1e7])
    major = minor * 3.0 + 2 * 50e3 * math.sqrt(3.0)
    major[1] = minor[1] + 1.1 * (major[1] - minor[1])
    low, middle, high = strength.envelope(minor, major).misses
    assert 0.02 < middle < 0.1 and -0.1 < low < 0 and -0.1 < high < 0
    scaled = strength.envelope(1e-3 * minor, 1e-3 * major)
    assert scaled.misses == pytest.approx((low, middle, high), rel=1e-6) and scaled.cohesion == pytest.approx(
        1e-3 * strength.envelope(minor, major).cohesion, rel=1e-6
    )
    s, t = (major + minor) / 2, (major - minor) / 2
    found = strength.envelope(minor, major)
    phi = math.radians(found.friction_deg)
    assert (low, middle, high) == pytest.approx(
        tuple((t - found.cohesion * math.cos(phi) - s * math.sin(phi)) / t), rel=1e-9
    )


def steps(values, strain):
    """Stress by strain: pieces of equal length with these values."""
    return np.asarray(values)[np.minimum((np.arange(len(strain)) * len(values)) // len(strain), len(values) - 1)]


def test_the_plateau_is_a_mean_with_its_error():
    """Five blocks from 3 % to 6 % of strain at 20 to 24 MPa: standard error √2.5/√5; the sides' mean, and the larger
    one of the platens' differences.
    """
    strain = np.arange(1, 601) * 1e-4
    axial = np.concatenate((np.full(299, 40e6), steps([20e6, 21e6, 22e6, 23e6, 24e6], np.arange(301))))
    top, bottom = np.where(strain < 0.03, 1.002, 0.97) * axial, np.where(strain < 0.03, 0.998, 1.03) * axial
    found = strength.curve(
        {
            "strain": strain,
            "volumetric_strain": -0.2 * strain,
            "sigma1_top_Pa": top,
            "sigma1_bottom_Pa": bottom,
            "sigma3_left_Pa": np.where(strain < 0.03, 4e6, 5e6),
            "sigma3_right_Pa": np.where(strain < 0.03, 6e6, 8e6),
        },
        (0.03, 0.06),
    )
    assert found.peak == pytest.approx(40e6, rel=1e-12) and found.peak_confining == pytest.approx(5e6, rel=1e-12)
    # 301 rows in five blocks
    assert found.residual == pytest.approx(22e6, rel=1e-3) and found.residual_confining == pytest.approx(
        6.5e6, rel=1e-12
    )
    assert found.residual_error == pytest.approx(1e6 * math.sqrt(2.5 / 5), rel=1e-2)
    assert found.imbalance == pytest.approx(1 - 0.97 / 1.03, rel=1e-9)
    assert found.dilatancy_deg == pytest.approx(
        math.degrees(math.asin(-0.2 / 1.8)), rel=1e-9
    ) and found.volumetric_end == pytest.approx(-0.012)


def test_dilatancy_is_that_of_the_peak():
    """The volume shrinks before 1.2 % of strain, grows by 0.4 of the strain up to 1.8 %, and no longer then; the peak
    is at 1.5 %.
    """
    strain = np.arange(1, 601) * 1e-4
    volume = np.interp(strain, [0, 0.012, 0.018, 0.06], [0, -0.002, 0.0004, 0.0004])
    assert strength.curve({**made_curve(), "volumetric_strain": volume}, (0.04, 0.06)).dilatancy_deg == pytest.approx(
        math.degrees(math.asin(0.4 / 2.4)), rel=1e-6
    )


def made_test(stress, strain=None):
    """A test's rows by its axial stress, all else nought."""
    strain = np.arange(1, len(stress) + 1) * 1e-4 if strain is None else strain
    none = np.zeros(len(strain))
    return {
        "strain": strain,
        "volumetric_strain": none,
        "sigma1_top_Pa": 1.5 * stress,
        "sigma1_bottom_Pa": 0.5 * stress,
        "sigma3_left_Pa": none,
        "sigma3_right_Pa": none,
    }


def test_the_share_of_the_later_peak_is_one_of_means():
    """10 Pa until 0.4 % of strain, 8 Pa from 0.8 to 1.2 %, 5 Pa elsewhere, and 20 Pa from 3 % on: windows of 0.2 % have
    these as their largest means.
    """
    strain = np.arange(1, 401) * 1e-4
    stress = np.full(400, 5.0)
    stress[strain < 0.00405], stress[(strain > 0.00805) & (strain < 0.01205)], stress[strain > 0.03005] = 10, 8, 20
    early, whole = ({k: v[:n] for k, v in made_test(stress).items()} for n in (250, 400))
    assert strength.axial_stress(whole) == pytest.approx(stress, rel=1e-12)  # rounding, here and below
    assert strength.later_share(early) == pytest.approx(8 / 10, rel=1e-9)
    assert strength.later_share(whole) == pytest.approx(8 / 20, rel=1e-9)  # what comes after 2 % is not of Figure 10
    none = made_test(np.where((strain > 0.00805) & (strain < 0.01205), 11.0, 10.0))
    assert strength.later_share(none) == pytest.approx(1.0, rel=1e-9)
    assert (
        strength.later_share({k: v[:50] for k, v in whole.items()}) is None
    )  # the last window has its middle at 0.4 %


def test_a_series_shorter_than_a_window_has_no_means():
    begin, mean = strength.running_mean(np.array([1e-3, 1.5e-3]), np.array([1.0, 1.0]), 2e-3)
    assert len(begin) == len(mean) == 0


def test_the_apparent_angle_is_that_of_one_circle():
    """σ₁/σ₃ = (1 + sin φ)/(1 − sin φ): 3 for 30°; no confinement is 90°, no difference 0°."""
    found = [strength.apparent_deg(minor, major) for minor, major in ((1e6, 3e6), (0.0, 2e6), (2e6, 2e6))]
    assert found == pytest.approx([30.0, 90.0, 0.0], abs=1e-9)


@pytest.mark.parametrize("rate, angle", [(-1.2, -90.0), (-1.0, -90.0), (2.0, 30.0)])
def test_dilatancy_has_no_sine_beyond_one(rate, angle):
    """sin ψ = v/(2 + v) for v = dε_v/dε₁; a sample that loses its whole length in volume, or more, has −1."""
    series = made_curve() | {"volumetric_strain": rate * made_curve()["strain"]}
    # 1e-6: near the end an arcsine has the root of the rounding
    assert strength.curve(series, (0.04, 0.06)).dilatancy_deg == pytest.approx(angle, abs=1e-5)


def test_two_rows_around_the_peak_have_no_dilatancy():
    """Rows 0.3 % of strain apart, of which two are within 0.25 % of the peak's middle, and three where rows are 0.15 %
    apart.
    """
    for apart, known in ((0.003, False), (0.0015, True)):
        strain = np.arange(1, 1 + round(0.06 / apart)) * apart
        stress = np.where(np.isclose(strain, 0.012), 9.0, 5.0)
        angle = strength.curve(made_test(stress, strain), (0.04, 0.06)).dilatancy_deg
        assert math.isfinite(angle) == known


def test_an_envelope_is_no_steeper_than_a_sine_of_0_999():
    """σ₁ = 10⁵ σ₃ would have sin φ = 1 − 2·10⁻⁵."""
    found = strength.envelope([1.0, 2.0, 4.0], [1e5, 2e5, 4e5])
    assert math.sin(math.radians(found.friction_deg)) == pytest.approx(0.999, rel=1e-9)
    with pytest.raises(ValueError, match="two confining pressures or more, not"):
        strength.envelope([1.0], [4.0])


# ---- bands ----------------------------------------------------------------------------------------


def test_bands_are_found_with_their_angle_and_width():
    rng = np.random.default_rng(2)
    x, y = rng.uniform(0, 100, 6000), rng.uniform(0, 200, 6000)
    r = np.full(6000, 1.0)

    # a band of 12 m, six diameters, that rises at 60° to the right through (45, 90); and a weaker one of 10 m at −55°
    def offset(deg, px, py):
        return -math.sin(math.radians(deg)) * (x - px) + math.cos(math.radians(deg)) * (y - py)

    rotation = (
        0.3 * (np.abs(offset(60, 45, 90)) < 6)
        - 0.2 * (np.abs(offset(-55, 50, 100)) < 5)
        + 0.01 * rng.standard_normal(6000)
    )
    left, right = bands.find(x, y, r, rotation)
    # a strip is 2 m wide, the band 120 m long
    assert left.angle_deg == pytest.approx(60, abs=3) and right.angle_deg == pytest.approx(-55, abs=3)
    assert left.width == pytest.approx(6, abs=1) and right.width == pytest.approx(5, abs=1)  # one strip
    assert left.rotation > 0.2 and right.rotation < -0.13
    # what turns against a band in it is where the other crosses it, and noise below a tenth does not count
    assert left.antithetic < 0.1 and right.antithetic < 0.25


def test_antithetic_disks_are_those_that_turn_against_the_band():
    """Every fourth disk of a band of 12 m turns half as far against it, and every fifth not at all."""
    rng = np.random.default_rng(4)
    x, y = rng.uniform(0, 100, 6000), rng.uniform(0, 200, 6000)
    within = np.abs(-math.sin(math.radians(60)) * (x - 45) + math.cos(math.radians(60)) * (y - 90)) < 6
    number = np.arange(6000)
    rotation = 0.4 * within * np.where(number % 4 == 0, -0.5, np.where(number % 5 == 0, 0.0, 1.0))
    for mirror in (1, -1):
        band = bands.find(mirror * x, y, np.ones(6000), mirror * rotation)[0 if mirror == 1 else 1]
        # of those that turn, 5 of 20 against 12 of 20; a band of some 600 disks
        assert band.antithetic == pytest.approx(5 / 17, abs=0.05)


def test_no_band_in_even_rotation():
    rng = np.random.default_rng(3)
    x, y = rng.uniform(0, 100, 4000), rng.uniform(0, 200, 4000)
    assert bands.find(x, y, np.ones(4000), rng.standard_normal(4000)) == (None, None)


def test_bands_are_mirrored_with_their_sample():
    """What turns counterclockwise in a band to the right turns clockwise in one to the left."""
    rng = np.random.default_rng(5)
    x, y, r = rng.uniform(0, 100, 5000), rng.uniform(0, 200, 5000), np.ones(5000)
    rotation = 0.3 * (
        np.abs(-math.sin(math.radians(57)) * (x - 45) + math.cos(math.radians(57)) * (y - 90)) < 6
    ) + 0.01 * rng.standard_normal(5000)
    (right, none), (nothing, left) = bands.find(x, y, r, rotation), bands.find(-x, y, r, -rotation)
    # a strip is 2 m wide, the band 120 m long
    assert none is None and nothing is None and (right.angle_deg, left.angle_deg) == pytest.approx((57.0, -57.0), abs=3)
    wanted = (right.width, -right.rotation, right.contrast, right.offset)
    # strips begin elsewhere
    assert (left.width, left.rotation, left.contrast, left.offset) == pytest.approx(wanted, rel=0.05)
    # of the band from the centre, (50, 100); a strip
    assert right.offset == pytest.approx(-math.sin(math.radians(57)) * -5 + math.cos(math.radians(57)) * -10, abs=2.0)
    assert right.contrast > 5 and right.rotation == pytest.approx(0.3, rel=0.05)
