"""Small triaxial tests in both worlds: stresses of plates and contacts, worlds that agree, hard spheres that know no
stress of their own, runs that are halted and go on.
"""
import json
import math

import numpy as np
import pytest
from halted_courses import halt, without_wall
from yade import O
from yade.nonsmooth import records
from yade.nonsmooth.measure import triaxial as measures
from yade.nonsmooth.records import checkpoints
from yade.nonsmooth.studies.spheres import (
    cell,
    grains,
    places,
    pressing,
    recorded_course,
    scene,
    triaxial,
    triaxial_course,
)

pytestmark = pytest.mark.usefixtures("empty")

#: A dense sample of some 140 spheres, which rises to its peak.
SMALL = triaxial.TriaxialTest(size=5, friction_share=0.0, strain=0.05, inertia=1e-3)
STIFF = 1000  # Young's modulus over σ₃


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """{world: (folder, numbers)} of the test, made when it is asked for."""
    made = {}

    def of(world="hard"):
        if world not in made:
            O.reset()
            folder = tmp_path_factory.mktemp(world)
            values = {} if world == "hard" else dict(stiffness=STIFF * SMALL.pressure)
            made[world] = folder, triaxial_course.run(SMALL, grains.world_of(SMALL, world, **values), folder)
        return made[world]

    return of


@pytest.mark.parametrize("world", ("hard", "soft"))
def test_plates_bear_the_pressure_and_contacts_tell_the_same(runs, world):
    folder, told = runs(world)
    s = records.read_series(folder / "series.csv")
    assert tuple(s) == tuple(recorded_course.columns_of(triaxial.TriaxialTest))
    assert json.loads(json.dumps(told, allow_nan=False)) == told
    assert told["ended"] and told["strain"] == pytest.approx(SMALL.strain, abs=0.5 * triaxial_course.ROW_STRAIN)
    # at rest: what solver and springs leave open, a per cent of σ₃
    assert told["isotropic_pressure_rel"] == pytest.approx(1, abs=0.01)
    # σ₃ is held by the load of the plates, not by a servo: a row's mean misses it by their inertia alone
    assert measures.lateral(s) == pytest.approx(SMALL.pressure, rel=0.02)
    for name in ("left", "right", "front", "back"):
        assert np.mean(s[f"sigma_{name}_Pa"]) == pytest.approx(SMALL.pressure, rel=0.01)
    # bottom and top differ by the inertia of what is between, I² of σ₃; springs swing
    assert abs(told["plates_difference_rel"]) < (0.005 if world == "hard" else 0.02)
    # at the end of a row, beside means over it: 15 rows
    assert abs(told["contacts_difference_rel"]) < 0.05
    assert told["inertial_number"] == pytest.approx(SMALL.inertia / (1 - SMALL.strain), rel=0.01)
    # springs of this stiffness overlap by some 2 (σ₁ + 2 σ₃)/3 E in the mean, and by eight times that in the strongest
    # chains; the solver leaves 1e-4
    assert told["overlap_worst_rel"] < (0.001 if world == "hard" else 8 * 2 * 1.7 / STIFF)
    seen = places.read_all(folder)
    assert len(seen) == 2 and seen[0].time_s == 0 and len(seen[-1]) == told["spheres"]


def test_both_worlds_have_the_same_sample_and_bear_alike(runs):
    (one, hard), (other, soft) = runs(), runs("soft")
    first, second = places.read_all(one)[0], places.read_all(other)[0]
    assert np.array_equal(first.r, second.r)
    # springs yield by some 2 σ₃/E of a diameter in each contact: the edge by as much of itself, the volume three times,
    # and as much again since so few contacts as these samples have leave other ways to yield
    shrink = soft["isotropic_solid_fraction_whole"] / hard["isotropic_solid_fraction_whole"] - 1
    assert 0.5 * 3 * 2 / STIFF < shrink < 3 * 3 * 2 / STIFF
    a, b = (records.read_series(folder / "series.csv") for folder in (one, other))

    def borne(s):
        """Mean deviator over σ₃ once the elastic strain, some 2 σ₁/E, is past."""
        there = s["strain"] > 0.01
        return float(np.mean((measures.axial(s) / measures.lateral(s))[there])) - 1

    # springs of this stiffness make the sample denser by a per cent, and bear more: 4 to 35 % in six such samples, half of
    # that where they are ten times as stiff; and so few spheres rearrange in jumps, which both make at other strains
    assert 0.85 < borne(b) / borne(a) < 1.45 and borne(a) > 0.5
    assert soft["volumetric_strain_end"] == pytest.approx(hard["volumetric_strain_end"], abs=0.01)
    # a dense sample dilates
    assert hard["volumetric_strain_end"] > 0


def test_hard_spheres_know_no_stress_of_their_own(runs, tmp_path):
    """Four times the pressure halves the unit of time: powers of two, so the same strains to the last bits but few."""
    from dataclasses import replace

    folder, told = runs()
    again = triaxial_course.run(replace(SMALL, pressure=4 * SMALL.pressure), folder=tmp_path)
    a, b = (records.read_series(one / "series.csv") for one in (folder, tmp_path))
    assert b["time_s"] == pytest.approx(0.5 * a["time_s"], rel=1e-12)
    assert b["volumetric_strain"] == pytest.approx(a["volumetric_strain"], abs=1e-9)
    assert measures.axial(b) == pytest.approx(4 * measures.axial(a), rel=1e-6)
    assert again["peak_deg"] == pytest.approx(told["peak_deg"], abs=1e-6)


def test_a_test_that_was_halted_goes_on_with_the_same_bits(runs, tmp_path, monkeypatch):
    whole, told = runs()
    said = "at a strain of 0.02.* go on with --resume"
    halt(monkeypatch, triaxial_course.TriaxialCourse, 12, said, triaxial_course.run, SMALL, folder=tmp_path)
    assert checkpoints.exists(tmp_path)
    again = triaxial_course.run(SMALL, folder=tmp_path)
    assert without_wall(tmp_path / "series.csv") == without_wall(whole / "series.csv")
    assert {k: v for k, v in again.items() if k != "wall_s"} == {k: v for k, v in told.items() if k != "wall_s"}
    with pytest.raises(grains.SpheresError, match="belongs to other settings"):
        triaxial_course.run(triaxial.TriaxialTest(size=5, strain=0.06), folder=tmp_path)


def test_the_pressed_sample_rests_is_dense_and_made_once(monkeypatch):
    dense, loose = (
        pressing.pressed(triaxial.TriaxialTest(size=5, friction=0.5, friction_share=share)) for share in (0.0, 1.0)
    )
    monkeypatch.setattr(pressing, "_press", lambda test: pytest.fail("it is in the cache"))
    again = pressing.pressed(triaxial.TriaxialTest(size=5, friction=0.5, friction_share=0.0, pressure=3.0))
    assert np.array_equal(dense.at, again.at)
    volume = 4 / 3 * math.pi * float(np.sum(dense.r**3))
    # friction keeps a sample loose; between them lies some per cent of the volume
    assert 1.02 < np.prod(loose.edges) / np.prod(dense.edges) < 1.2
    # with the layers along the plates, which are less dense than the middle
    assert 0.5 < volume / np.prod(dense.edges) < 0.64
    for made in (dense, loose):
        assert (np.abs(made.at) + made.r[:, None] <= 0.5 * made.edges + 0.01 * made.r[:, None]).all()
        # pressed alike on all sides: the cell stays about a cube
        assert made.edges == pytest.approx(np.full(3, made.edges.mean()), rel=0.05)


@pytest.mark.parametrize("world", ("hard", "soft"))
def test_three_spheres_in_a_row_between_plates(world):
    """Spheres that touch each other and two plates: the force of the free plate goes through all contacts."""
    test = triaxial.TriaxialTest(diameter=0.02, size_spread=1)
    values = {} if world == "hard" else dict(stiffness=STIFF * test.pressure)
    at = np.array([(-0.02, 0, 0), (0, 0, 0), (0.02, 0, 0)])
    bodies = scene.put(test, grains.world_of(test, world, **values), at, np.full(3, 0.01), (0.06, 0.05, 0.05))
    plates = cell.Cell(test.pressure)
    plates.free(0, 0.01)
    for _ in range(2000 if world == "soft" else 50):
        plates.advance(1)
    pull = test.pressure * 0.05 * 0.05
    found = scene.contacts(bodies)
    # two between the spheres, and one with each plate; at rest to what the damping leaves
    assert len(found["normal"]) == 4 and found["normal"] == pytest.approx(pull, rel=0.01)
    assert sorted(zip(found["first"], found["second"])) == [(-2, 2), (-1, 0), (0, 1), (1, 2)]
    tensor = measures.stress(found["force"], found["branch"], float(np.prod(plates.edges())))
    assert tensor[0, 0] == pytest.approx(test.pressure, rel=0.01) and abs(tensor[2, 2]) < 1e-6 * test.pressure
    assert plates.stresses()[:2] == pytest.approx(test.pressure, rel=0.01)
    assert plates.stresses()[2:] == pytest.approx(0, abs=1e-6 * test.pressure)
    # hard ones stay where they touch, but for 1e-4 of a diameter in each contact, which the solver leaves; springs yield by pull/(E d/2) between spheres, and at a plate
    short = 0.06 - plates.edges()[0]
    wanted = 0 if world == "hard" else 4 * pull / (STIFF * test.pressure * 0.01)
    assert short == pytest.approx(wanted, rel=0.02, abs=4 * 1.1e-4 * 0.02)
    # a plate that is driven bears no pressure
    plates.drive(0, 0.0)
    plates.advance(1)
    assert tuple(O.forces.permF(1)) == (0, 0, 0)


def test_what_is_no_test_is_refused(tmp_path):
    with pytest.raises(grains.SpheresError, match="test 7: give a TriaxialTest"):
        triaxial_course.run(7, folder=tmp_path)
    with pytest.raises(grains.SpheresError, match="folder None"):
        triaxial_course.run(SMALL)
