"""A slope's course: one that fails by its own weight, one of another size, forces on walls between two rows, options without sense."""

import dataclasses
import json
import math
import subprocess
from pathlib import Path

import numpy as np
import pytest
import yaml

from yade import O
from yade.minieigenHP import Vector3
from yade.nonsmooth import experiment, packing, records, results, scales, section, slope
from yade.nonsmooth.wall_forces import WallForces

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "jiufengershan.py"
SHIPPED = ROOT / "py" / "nonsmooth" / "sections" / "jiufengershan.yaml"


def written(path, **keys):
    """The shipped section, packed loosely enough for few disks, with values set at paths such as stages__settle__ramp."""
    data = yaml.safe_load(SHIPPED.read_text())
    for way, value in {"disks__packing_fraction": 0.8, **keys}.items():
        *way, last = way.split("__")
        place = data
        for key in way:
            place = place[key]
        place[last] = value
    path.write_text(yaml.safe_dump(data, sort_keys=False))
    return path


@pytest.fixture(scope="module")
def failed(tmp_path_factory):
    """A run on a plane without friction, of rock without strength, which slides as soon as gravity has grown: its folder and what the command said."""
    folder = tmp_path_factory.mktemp("dry")
    source = written(folder / "weak.yaml", materials__dp__friction=0.0, materials__dp__residual_friction=0.0, materials__rock__tensile_strength=1.0,
                     materials__rock__residual_tensile_strength=0.0, materials__fb__tensile_strength=1.0, stages__settle__ramp=1.0, stages__dry=0.5,
                     stages__end__time=8.0, numerics__tolerance=1e-4, numerics__max_iterations=30)
    done = subprocess.run([SCRIPT, "--section", source, "--disks", "300", "--out", folder / "out", "--threads", "1"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder / "out", done.stdout


def test_a_slope_that_fails_dry_is_no_failure_by_water(failed):
    out, said = failed
    summary = json.loads((out / "summary.json").read_text())
    assert "THE SLOPE FAILED DRY, at " in said
    assert 1.0 < summary["failed_dry_s"] < 8.0  # gravity needs 1 s to grow; then g sin 21° is 3.5 m/s²
    for name in ("water_at_failure_m", "fb_force_dry_N_per_m", "fb_force_at_failure_N_per_m", "dp_shear_dry_N_per_m", "dp_shear_at_failure_N_per_m",
                 "triggering_s", "motion_s", "bulking_factor"):
        assert summary[name] is None, name
    assert [name for name, t in summary["times_s"].items() if t is None and name != "t5"] == ["t0", "t1", "t2", "t3"]
    assert summary["times_s"]["t4"] > summary["failed_dry_s"]
    series = records.read_series(out / "series.csv")
    assert summary["front_travel_m"] == pytest.approx(series["front_m"][-1] - series["front_m"][0])  # from the beginning
    assert summary["centroid_travel_m"] > 5  # some seconds at some m/s
    assert summary["energy_error_rel"] < 0.02  # of the rows since gravity has grown; before, the balance means nothing
    assert not (out / "deposit.png").exists() and (out / "energy.png").stat().st_size > 1000


def test_rows_begin_with_the_run_and_name_their_stage(failed):
    series = records.read_series(failed[0] / "series.csv")
    assert series["time_s"][0] == pytest.approx(0.1, abs=1e-9) and np.allclose(np.diff(series["time_s"]), 0.1, atol=0.006)
    assert (np.diff(series["stage"]) >= 0).all() and set(series["stage"]) == {0, 1, 2}
    assert (series["water_m"] == 0).all() and (series["wet_disks"] == 0).all()
    assert (series["energy_error_rel"][series["stage"] == 0] == 0).all()
    since = records.since_settled(series)
    assert set(since["stage"]) == {1, 2} and len(since["step"]) == np.count_nonzero(series["stage"])
    old = {name: values for name, values in series.items() if name != "stage"}
    assert records.since_settled(old) is old


def test_the_failure_is_found_also_where_it_comes_at_rest_or_late():
    """The rules alone, on states that a run has gone through."""
    slope_of = section.load("jiufengershan")
    t = 0.1 * np.arange(1, 301)
    series = {"time_s": t, "energy_kinetic_J": np.interp(t, [5, 10, 20], [0, 1, 0]), "speed_mean_m_per_s": np.interp(t, [5, 10, 20], [0, 9, 0]),
              "weakened_disks": np.where(t > 6, 10**6, 0), "stage": np.where(t < 7, 0, 2)}
    times = results.characteristic_times(series, slope_of, {"t0": 7.0, "moving": 6.0, "failed_dry": 6.0})
    assert [times[name] for name in ("t0", "t1", "t2", "t3")] == [None] * 4
    assert times["t4"] == pytest.approx(10) and times["t5"] == pytest.approx(20 - 0.02 * 10, abs=0.11)
    assert results.chosen_rows(series, {"failed_dry": 6.0}) is series
    assert results.chosen_rows(series, {})["time_s"][0] == pytest.approx(7.0)


class Stub:
    """What the course asks of the solver and of the water, as a run would have it."""

    def __init__(self, speed):
        self.meanSpeed, self.height, self.times, self.heights, self.tolerance = speed, 1.5, [], [], 1e-6


@pytest.mark.parametrize("at_t0, speeds, failed", [
    (1e-3, (1e-3, 0.25), False),         # stood, and water moves it
    (0.15, (0.1, 0.01, 0.25), False),    # comes to rest after t0
    (0.15, (0.17, 0.19, 0.21), True),    # never stood, and goes on
    (0.25, (0.3, 0.4), True)])           # on the move at t0
def test_only_a_slope_that_has_stood_fails_by_water(at_t0, speeds, failed, loaded, tmp_path, monkeypatch):
    run = experiment.Experiment(loaded, tmp_path)
    table = experiment.tables.bodies(loaded.solver)
    monkeypatch.setattr(experiment.tables, "bodies", lambda _: table)
    solver = run.slope.solver = Stub(at_t0)
    run.slope.water = Stub(0.0)
    monkeypatch.setattr(run, "snapshot", lambda *_, **__: None)
    monkeypatch.setattr(run, "checkpoint", lambda: None)
    s = run.state
    s.settled, s.stage = O.time - 100.0, "dry"
    run._dry()
    for solver.meanSpeed in speeds:
        s.speed_max = max(s.speed_max, solver.meanSpeed)
        run._water()
    assert s.moving is not None and (s.failed_dry is not None) == failed
    assert s.water_hold == (0.0 if at_t0 >= 0.2 else 1.5)  # where it was when the slope moved


# ---- sizes ----------------------------------------------------------------------------------------
def test_the_shipped_section_has_the_scales_that_it_had():
    shipped = section.load("jiufengershan")
    for s in (shipped, shipped.with_disks(3000)):
        assert dataclasses.astuple(scales.of(s)) == (0.1, 1.0, 5.0, 0.2, 0.02, 2.0, 60.0)  # to the last bit


@pytest.mark.parametrize("size, gravity", [(1e-3, 9.81), (1.0, 981.0), (10.0, 9.81)])
def test_scales_of_other_slopes(size, gravity):
    shipped = section.load("jiufengershan")
    layers = tuple(dataclasses.replace(layer, vertices=tuple((size * x, size * y) for x, y in layer.vertices)) for layer in shipped.layers)
    other = scales.of(dataclasses.replace(shipped, layers=layers, gravity=gravity, numerics=dataclasses.replace(shipped.numerics, time_step=1e-5)))
    speed, time = math.sqrt(size * gravity / 9.81), math.sqrt(size * 9.81 / gravity)
    assert (other.moving_speed, other.stopped_speed, other.going_speed, other.approach_speed) == pytest.approx((0.2 * speed, 0.02 * speed, 2 * speed, 60 * speed))
    assert other.still_seconds == pytest.approx(5 * time)
    for seconds, exact in ((other.row_seconds, 0.1 * time), (other.mean_seconds, time)):
        assert 1 / 1.6 < seconds / exact < 1.6  # the largest step among 1, 2, 5, 10 is 2.5, half of it by ratio 1.58
        assert float(f"{seconds:.0e}") == seconds and f"{seconds:.0e}"[0] in "125"
    assert other.mean_seconds >= other.row_seconds


def test_rows_are_no_closer_than_steps():
    shipped = section.load("jiufengershan")
    coarse = dataclasses.replace(shipped, numerics=dataclasses.replace(shipped.numerics, time_step=0.25))
    assert scales.of(coarse).row_seconds == 0.25


# ---- walls ----------------------------------------------------------------------------------------
@pytest.fixture
def loose(tmp_path):
    return section.load(written(tmp_path / "loose.yaml")).with_disks(300)


@pytest.fixture
def loaded(loose):
    """Disks that fall onto the shipped section's walls."""
    built = slope.build(loose, packing.pack(loose, 1))
    yield built
    O.reset()


def by_hand(built, name):
    """Normal and shear force on a wall, piece by piece."""
    normal = shear = 0.0
    for i in built.walls[name]:
        f, along = O.forces.f(i), O.bodies[i].state.ori * Vector3(1, 0, 0)
        normal += f[0] * along[1] - f[1] * along[0]
        shear += f[0] * along[0] + f[1] * along[1]
    return normal, shear


def test_forces_between_rows_are_counted(loaded):
    forces, seen = WallForces(loaded.walls), {name: [] for name in loaded.walls}
    for k in range(12):
        O.dt = (5e-3, 1e-2)[k % 2]
        O.step()
        forces.add(O.dt)
        for name in loaded.walls:
            seen[name].append((*by_hand(loaded, name), O.dt))
    found = forces.take()
    for name, rows in seen.items():
        normal, shear, step = np.array(rows).T
        wanted = ((normal * step).sum() / step.sum(), (shear * step).sum() / step.sum(), normal.max())
        assert found[name] == pytest.approx(wanted, rel=1e-9, abs=1e-3)  # N/m: rounding of sums of some 1e7
    assert found["DP"][2] > 1.02 * found["DP"][0] > 0  # packed just short of touching: the disks hit the plane
    O.step()
    forces.add(O.dt)
    assert forces.take()["DP"] == pytest.approx((*by_hand(loaded, "DP"), by_hand(loaded, "DP")[0]), rel=1e-9)  # what was before is forgotten


def test_rows_hold_means_and_peaks(loaded, tmp_path):
    run, normal = experiment.Experiment(loaded, tmp_path), []
    add = run.forces.add
    run.forces.add = lambda seconds: (add(seconds), normal.append((O.iter, *by_hand(loaded, "DP"), seconds)))
    run.run(end=0.5)
    series = records.read_series(tmp_path / "series.csv")
    step, force, _, seconds = np.array(normal).T
    assert len(series["step"]) == 5
    for k, (first, last) in enumerate(zip((2, *series["step"]), series["step"])):
        row = (step > first) & (step <= last)
        assert series["dp_normal_effective_N_per_m"][k] == pytest.approx((force * seconds)[row].sum() / seconds[row].sum(), rel=1e-9)
        assert series["dp_normal_peak_N_per_m"][k] == pytest.approx(force[row].max(), rel=1e-9)
    assert (series["dp_normal_peak_N_per_m"] >= series["dp_normal_effective_N_per_m"]).all()


# ---- options --------------------------------------------------------------------------------------
@pytest.mark.parametrize("option, value", [("--water", "nan"), ("--water", "-1"), ("--water", "inf"), ("--end", "-1"), ("--end", "nan"), ("--end", "0"),
                                           ("--disks", "0"), ("--disks", "1000000000000"), ("--disks", "300.5"), ("--seed", "-1"), ("--seed", "9" * 99), ("--threads", "5000")])
def test_options_without_sense(option, value, tmp_path):
    # one equals sign, so that -1 is no option
    done = subprocess.run([SCRIPT, f"{option}={value}" if option != "--threads" else "--threads", *(() if option != "--threads" else (value,)), "--out", tmp_path / "out"],
                          capture_output=True, text=True, timeout=60)
    assert done.returncode in (1, 2) and "Traceback" not in done.stderr and option in done.stderr.splitlines()[-1]
    assert not (tmp_path / "out").exists()


def test_water_on_a_section_without(tmp_path):
    text = SHIPPED.read_text()
    begin, end = text.index("\nwater:"), text.index("\nstages:")
    (tmp_path / "dry.yaml").write_text(text[:begin] + text[end:])
    done = subprocess.run([SCRIPT, "--section", tmp_path / "dry.yaml", "--water", "1", "--out", tmp_path / "out"], capture_output=True, text=True)
    assert done.returncode == 1 and "has no water" in done.stderr and "Traceback" not in done.stderr


def test_a_packing_of_another_slope(loose, tmp_path):
    made = packing.pack(loose, 1)
    packing.write_text(dataclasses.replace(made, layer=0 * made.layer), tmp_path / "p.txt")
    done = subprocess.run([SCRIPT, "--section", loose.source, "--disks", "300", "--packing", tmp_path / "p.txt", "--out", tmp_path / "out"], capture_output=True, text=True)
    assert done.returncode == 1 and "p.txt: no disk belongs to layer 1 (L2)" in done.stderr and "Traceback" not in done.stderr
