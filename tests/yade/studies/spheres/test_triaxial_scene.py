"""A triaxial test as plain data: parameters, sizes, cloud, plates, scales; envelopes and tables of made-up runs."""
import math

import numpy as np
import pytest
from yade.nonsmooth import errors
from yade.nonsmooth.measure import sphere_heaps
from yade.nonsmooth.studies.spheres import grains, pressing, report, study, triaxial, walls

Triaxial = triaxial.TriaxialTest


@pytest.mark.parametrize(
    "wrong, said",
    (
        (dict(size=3), "size 3: give the sample's edge in mean diameters, from 4 to 60"),
        (dict(pressure=0), "pressure 0: give σ₃"),
        (dict(strain=0.01), "strain 0.01: give the axial strain, from 0.03 to 0.6"),
        (dict(inertia=0.1), "inertia 0.1: give the inertial number, above 0 and up to 0.01"),
        (dict(friction_share=2), "friction_share 2: give a share from 0 to 1"),
        (dict(friction=30), "friction 30: 30 is no coefficient of friction"),
        (dict(density=math.nan), "density nan"),
        (dict(size=60, size_spread=1), "that is .* spheres; give values for 1 to 200000"),
    ),
)
def test_wrong_parameters_are_named(wrong, said):
    with pytest.raises(grains.SpheresError, match=said):
        Triaxial(**wrong)


def test_springs_that_the_pressure_crushes_are_refused_with_what_would_do():
    with pytest.raises(grains.SpheresError, match=r"spheres under 100000 Pa would overlap by 20 %") as refused:
        grains.world_of(Triaxial(), "soft", stiffness=1e6)
    least = float(str(refused.value).split("give ")[1].split()[0])
    assert grains.world_of(Triaxial(), "soft", stiffness=least).stiffness == least
    with pytest.raises(errors.UserError, match="restitution 0.5 with soft contacts"):
        grains.world_of(Triaxial(restitution=0.5), "soft", stiffness=1e9)


def test_a_duration_is_refused():
    with pytest.raises(grains.SpheresError, match="duration 3: a triaxial test ends at its strain"):
        study.planned("one", "/tmp/none", Triaxial(), {}, duration=3)


def test_the_unit_of_time_is_that_of_the_inertial_number():
    """d = 0.02 m, ρ = 2500 kg/m³, σ₃ = 1e6 Pa: t_i = 1 ms."""
    one = Triaxial(diameter=0.02, pressure=1e6, inertia=5e-4)
    assert one.unit == pytest.approx(1e-3, rel=1e-12) and one.rate == pytest.approx(0.5, rel=1e-12)
    assert grains.world_of(one).time_step == pytest.approx(1e-4, rel=1e-12)
    assert grains.world_of(one, path=0.02).time_step == pytest.approx(2e-5, rel=1e-12)


def test_the_cloud_is_random_loose_and_the_seeds():
    one = Triaxial(size=8, seed=3)
    r = one.radii()
    at = one.sites(r)
    assert len(r) == one.count() and len(sphere_heaps.gaps(at, r, 0.0)[0]) == 0
    edge = one.cloud(r)
    assert (at - r[:, None] >= 0).all() and (at + r[:, None] <= edge).all()
    assert 4 / 3 * math.pi * np.sum(r**3) / edge**3 == pytest.approx(triaxial.LOOSE, rel=1e-9)
    # as dense in its halves, to what some hundred spheres scatter (they keep apart: less than 1/√n)
    assert np.mean(at < 0.5 * edge) == pytest.approx(0.5, abs=0.05)
    assert np.array_equal(at, Triaxial(size=8, seed=3).sites(r)) and not np.array_equal(
        at, Triaxial(size=8, seed=4).sites(r)
    )


def test_the_number_of_spheres_fills_the_size():
    one = Triaxial(size=10, size_spread=1, diameter=0.02)
    assert one.count() == pytest.approx(0.6 * 10**3 * 6 / math.pi, abs=0.5)


def test_six_plates_stand_around_the_cell():
    made = walls.RoundWalls()
    Triaxial().stand(made, (0.1, 0.2, 0.3))
    faces = []
    for k, (centre, half, smooth, group) in enumerate(made.boxes):
        assert smooth and group == "wall"
        axis, sign = k // 2, (-1, 1)[k % 2]
        faces.append(centre[axis] - sign * half[axis])
        # they cover the whole cell and more
        assert all(half[other] > 0.3 for other in range(3) if other != axis)
    assert faces == pytest.approx([-0.05, 0.05, -0.1, 0.1, -0.15, 0.15], rel=1e-12)


def test_what_does_not_matter_before_the_test_is_not_in_the_samples_key():
    assert pressing.cache_path(Triaxial(pressure=1e4)) == pressing.cache_path(Triaxial(strain=0.1, inertia=1e-4))
    assert pressing.cache_path(Triaxial(friction=0.4)) != pressing.cache_path(Triaxial())
    assert pressing.cache_path(Triaxial(friction_share=0)) != pressing.cache_path(Triaxial())


def run(pressure, seed, degrees=30.0, **scene):
    """Numbers of a run whose peak has this angle, and whose critical state has half of its sine."""
    sine = math.sin(math.radians(degrees))
    own = {name: 1.0 for name, _, _ in report.VALUES["triaxial"]}
    circles = {}
    for kind, s in (("peak", sine), ("critical", sine / 2)):
        circles |= {f"sigma3_{kind}_Pa": pressure, f"sigma1_{kind}_Pa": pressure * (1 + s) / (1 - s)}
    return {
        "scene": Triaxial(pressure=pressure, seed=seed, **scene).plain(), "world": "hard", "settings": {"tolerance": 1e-4},
        "spheres": 100, "ended": True, "steps": 50, "wall_s": 3.0, "overlap_worst_rel": 1e-4, **own, **circles,
    }  # fmt: skip


def test_the_envelope_is_the_laboratorys():
    """Without cohesion: the line through the origin, at the angle of the circles."""
    runs = {f"{p}-{s}": run(p, s) for p in (1e5, 2e5, 4e5) for s in (1, 2)}
    summary = report.summarise(runs | {"alone": run(1e5, 1, friction=0.2)})
    (found,) = summary["envelopes"]
    assert found["friction_peak_deg"] == pytest.approx(30, abs=1e-6)
    assert found["cohesion_peak_kPa"] == pytest.approx(0, abs=1e-6)
    assert found["friction_residual_deg"] == pytest.approx(math.degrees(math.asin(0.25)), abs=1e-6)
    assert found["asked"]["friction"] == Triaxial().friction and found["seeds"] == [1, 2]
    assert "envelope of the peak: c′ = " in report.table(summary) and "φ′ = 30.0°" in report.table(summary)
    ((_, header, rows),) = summary["tables"]
    assert len(rows) == 4 and rows[0][0] == "friction 0.5, pressure 100000" and len(header) == len(rows[0])


def test_the_friction_of_a_wanted_angle_is_told():
    runs = {
        f"{mu}-{seed}": run(1e5, seed, friction=mu) | {"critical_deg": 100 * mu + seed}
        for mu in (0.1, 0.2)
        for seed in (1, 3)
    }
    summary = report.summarise(runs)
    summary["calibration"] = report.calibrated(summary, 17.0)
    (found,) = summary["calibration"]
    # means of 12 and 22 degrees
    assert found["friction"] == pytest.approx(0.15) and found["world"] == "hard"
    assert "critical state of 17°, hard: friction 0.15" in report.table(summary)
    summary["calibration"] = report.calibrated(summary, 30.0)
    assert "critical state of 30°, hard: give more of --friction" in report.table(summary)


def test_one_pressure_has_no_envelope():
    assert report.summarise({"a": run(1e5, 1), "b": run(1e5, 2)})["envelopes"] == []
