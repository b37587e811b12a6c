"""Slopes under a field of water: when it acts, what it carries, what a run tells of it, and its bits after a resume."""

import argparse

import numpy as np
import pytest
from slope_scenes import SMALL
from yade import O
from yade.nonsmooth import experiment, records, section, tables, worlds
from yade.nonsmooth.model.section.folder import SCHEMA
from yade.nonsmooth.model.section.reader import read
from yade.nonsmooth.commands import section_arguments
from yade.nonsmooth.judges.verification.water.sections import displaced, uplift
from yade.nonsmooth.studies.safety import asked
from yade.nonsmooth.studies.slope import slope
from yade.nonsmooth.water import field_files, forces
from yade.nonsmooth.water.fields import MeshField
from yade.nonsmooth.water.mesh import grid

pytestmark = pytest.mark.usefixtures("empty")
RISE = {
    "phreatic": {
        "lines": [
            {"time": 0.2, "points": [[-40.0, 16.9], [0.0, 0.5], [5.0, 0.5]]},
            {"time": 1.0, "points": [[-40.0, 18.6], [-20.0, 11.2], [0.0, 1.9], [10.0, 1.9]]},
        ]
    }
}
FAR = {"line": [[50.0, 3.0], [55.0, 3.0]], "head": 1.0}  # on no border
LAKE = {"volume": "bulk", "phreatic": {"lines": [{"time": 0.0, "points": [[-40.0, 8.0], [10.0, 8.0]]}]}}


def made(water, **stages):
    """The small slope with other water."""
    data = read(SMALL, SCHEMA).data
    data["water"] = water
    data["stages"] = {**{k: v for k, v in data["stages"].items() if k != "water"}, **stages}
    return section.of(data)


@pytest.fixture(scope="module")
def stood(tmp_path_factory):
    """The slope under rising lines from its packing to its end: (folder, series, summary, state)."""
    O.reset()
    folder = tmp_path_factory.mktemp("stood")
    course = experiment.begin(made(RISE, end={"time": 6.0, "rest_fraction": 0.03, "rest_hold": 0.3}), folder)
    course.run()
    summary = course.summarise()
    O.reset()
    return folder, records.read_series(folder / "series.csv"), summary, course.state


def test_water_acts_from_t0_on_and_grows_to_the_first_state(stood):
    _, series, _, state = stood
    before = series["time_s"] <= state.t0 + 1e-9
    assert before.sum() > 10 and not series["wet_disks"][before].any() and not series["water_m"][before].any()
    growing = (series["time_s"] > state.t0 + 0.02) & (series["time_s"] < state.t0 + 0.2)
    force = series["dp_water_N_per_m"][growing]
    since = series["time_s"][growing] - state.t0
    # a step begins with the water of its begin
    assert force / force[-1] == pytest.approx((since - 5e-3) / (since[-1] - 5e-3), rel=0.02) and force[-1] > 0


def test_the_run_tells_of_the_pressure_on_the_slip_surface(stood):
    folder, series, summary, state = stood
    field = experiment.of_section.field(section.load(str(folder / "section.yaml")))
    line = np.linspace((-35.9, 16.74), (-0.05, 0.0233), 2001) + 0.25 * np.array([0.4226, 0.9063])
    mean = np.maximum(field.pressure(line, 1.0) / 9810, 0).mean()
    assert series["water_m"][-1] == pytest.approx(mean, rel=0.02) and mean > 0.5
    assert summary["water_highest_m"] == series["water_m"].max()
    assert f"a mean pressure head of {series['water_m'].max():.4g} m on the slip surface" in summary["verdict_says"]


def test_a_slope_stands_only_after_the_last_state(stood):
    _, series, summary, state = stood
    assert summary["verdict"] == "stood" and state.quiet_since >= state.t0 + 1.0
    assert state.table_since >= state.t0 + 1.0 - 1e-9  # and is still only then
    assert series["time_s"][-1] < state.settled + 6.0


def test_still_water_under_a_reservoir_carries_the_displaced_weight(tmp_path):
    """Disks whose centres lie in the layers, stick out of the face or lie in the water above it: all the same."""
    course = experiment.begin(made(LAKE), tmp_path)
    course.run(end=0.6)
    weight, below, count = displaced(course, 8.0)
    assert 0 < below < count and course.slope.water.wetCount == below
    assert uplift(course) == pytest.approx((0.0, weight), rel=1e-10, abs=1e-10 * weight)


def test_disks_in_a_reservoir_bear_the_same_as_those_in_the_ground(tmp_path):
    """A disk that sticks out of the submerged face, one that lies in the water, and one above its level."""
    chosen = made(LAKE)
    places = [(-10.0, 7.0), (-4.0, 6.9), (-1.0, 7.5), (-12.0, 9.5)]  # in the layer, near its face, out of it, dry
    x, y = np.transpose(places)
    packed = experiment.Packing(x, y, np.full(4, 0.4), np.zeros(4, int))
    course = experiment.Experiment(slope.build(chosen, packed), tmp_path)
    course.slope.water.field = experiment.pore_pressure.field(course.field, 0.0)
    O.step()
    wet = tables.water(course.slope.water, course.slope.first_disk, 4)[0]
    assert np.array_equal(wet, tables.bodies(course.slope.solver)["y"] < 8.0) and wet.sum() == 3
    whole = 3 * 9810 * np.pi * 0.4**2 / chosen.disks.packing_fraction
    assert tuple(course.slope.water.totalForce)[:2] == pytest.approx((0.0, whole), rel=1e-10, abs=1e-10 * whole)


def test_forces_of_the_engine_are_those_of_the_field(tmp_path):
    """And U that a row tells is their part along the slope's normal."""
    course = experiment.begin(made(RISE), tmp_path)
    course.run(end=1.1)
    t, state = tables.bodies(course.slope.solver), course.state
    series = records.read_series(tmp_path / "series.csv")
    since = O.time - O.dt - state.t0  # of the begin of the last step
    expected = forces.on_disks(course.field, t["x"], t["y"], t["r"], since, area="disk", outside="dry")
    total = np.array(tuple(course.slope.water.totalForce)[:2])
    assert total == pytest.approx(expected.sum(axis=0), rel=1e-2) and total @ course.section.normal > 0
    assert series["dp_water_N_per_m"][-1] == pytest.approx(total @ course.section.normal, rel=1e-12)


@pytest.mark.parametrize("end", [0.42, 0.9])
def test_a_resumed_run_has_the_same_bits(end, stood, tmp_path):
    """From before the water and from between two of its states."""
    folder, _, _, state = stood
    chosen = section.load(str(folder / "section.yaml"))
    course = experiment.begin(chosen, tmp_path)
    course.run(end=end)
    course.checkpoint()
    assert (course.state.t0 is None) == (end < state.t0)
    O.reset()
    course = experiment.resume(chosen, tmp_path)
    course.run()
    for name in ("series.csv", "walls.csv"):
        assert (tmp_path / name).read_bytes() == (folder / name).read_bytes(), name
    one, other = (records.read_snapshot(place / "end.npz") for place in (folder, tmp_path))
    for name in ("x", "y", "vx", "vy", "angle", "wet", "water_m"):
        assert np.array_equal(getattr(one, name), getattr(other, name)), name


def test_soft_contacts_have_the_same_water(tmp_path):
    world = worlds.Soft(1e8, (0.5, 1.0))
    chosen = made(LAKE, settle={"ramp": 0.3, "time_max": 0.4, "speed_rest": 0.01}, dry=0.02)
    course = experiment.begin(chosen, tmp_path, world=world)
    course.run(end=0.5)
    weight, *_ = displaced(course, 8.0)
    assert course.state.stage == "water" and uplift(course)[1] == pytest.approx(weight, rel=1e-10)


def test_a_slope_that_fails_dry_gets_no_water(tmp_path):
    data = read(SMALL, SCHEMA).data
    data["water"], data["materials"]["dp"]["friction"] = LAKE, 0.0
    del data["stages"]["water"]
    course = experiment.begin(section.of(data), tmp_path)
    course.run(end=1.5)
    series = records.read_series(tmp_path / "series.csv")
    assert course.state.failed_dry is not None and course.state.t0 is not None
    assert not series["wet_disks"].any() and course.slope.water.field is None


def test_a_run_does_not_need_the_file_of_its_field_again(tmp_path):
    """It is resumed, and its section loaded, without it."""
    mesh = grid(np.linspace(-50, 20, 8), np.linspace(-20, 35, 8))
    path = field_files.write(
        MeshField(mesh, [0.3], [9810 * (2 - 0.4 * mesh.nodes[:, 0] - mesh.nodes[:, 1])]), tmp_path / "f.h5"
    )
    chosen = made({"field": {"file": str(path)}})
    course = experiment.begin(chosen, tmp_path / "run")
    course.run(end=0.4)
    course.checkpoint()
    path.unlink()
    O.reset()
    course = experiment.resume(chosen, tmp_path / "run")
    course.run(end=0.9)
    assert course.slope.water.wetCount > 0
    assert section.load(str(tmp_path / "run" / "section.yaml")).water_field.scale == 1
    (tmp_path / "run" / "water.h5").unlink()
    O.reset()
    with pytest.raises(experiment.ExperimentError, match="water.h5: there is no such file.*without --resume"):
        experiment.resume(chosen, tmp_path / "run")


def test_seepage_under_a_reservoir_carries_the_displaced_weight(tmp_path):
    """With a submerged face, and disks that stick out of it; a rapid drawdown then leaves their forces as they were but
    for those in the open water.
    """
    states = [{"time": 0.0, "reservoir": 8.0}, {"time": 0.1, "reservoir": 8.0}, {"time": 0.3, "drained": False}]
    water = {"volume": "bulk", "seepage": {"size": 1.5, "conductivity": 1e-5, "states": states}}
    course = experiment.begin(made(water), tmp_path)
    course.run(end=0.56)
    weight, below, count = displaced(course, 8.0)
    assert 0 < below < count and course.slope.water.wetCount == below
    assert uplift(course) == pytest.approx((0.0, weight), rel=1e-10, abs=1e-10 * weight)
    course.run(end=0.9)
    assert uplift(course)[0] > 0.1 * weight and 0.5 * weight < uplift(course)[1] < weight


def test_rates_and_heights_of_a_table_are_refused():
    parser = argparse.ArgumentParser()
    section_arguments.add(parser, default="rain")
    with pytest.raises(section.SectionError, match="--water 0.5: .*rain.yaml has no water table.*leave --water out"):
        section_arguments.read(parser.parse_args(["--water", "0.5"]))
    chosen = section.load("rain")
    assert asked.standing(chosen) == (chosen, None)
    with pytest.raises(asked.SafetyError, match="--table 2: .* has no water table, .*leave --table out"):
        asked.standing(chosen, 2.0)


def test_a_field_that_cannot_be_had_is_refused_before_anything_is_done(tmp_path):
    water = {"seepage": {"size": 1.5, "conductivity": 1e-5, "states": [{"time": 0.0, "boundaries": [FAR]}]}}
    with pytest.raises(experiment.WaterError, match="^section: water.seepage"):
        experiment.begin(made(water), tmp_path / "run")
    assert not (tmp_path / "run").exists()
