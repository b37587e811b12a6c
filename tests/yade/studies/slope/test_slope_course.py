"""A slope's course in its scene: one that fails by its own weight, what is done where the rules decide, forces on walls
between two rows, options without sense.
"""

import dataclasses
import json
from types import SimpleNamespace

import numpy as np
import pytest
import shell
import yaml
from slope_scenes import SHIPPED
from yade import O
from yade.minieigenHP import Vector3
from yade.nonsmooth import course, experiment, packing, records, section
from yade.nonsmooth.measure import characteristic_times
from yade.nonsmooth.studies.slope import slope
from yade.nonsmooth.studies.slope.monitoring import SlopeMonitor
from yade.nonsmooth.wall_forces import WallForces
from yade.wrapper import WallForceEngine


def written(path, **keys):
    """The shipped section, packed loosely enough for few disks, with values set at paths such as
    stages__settle__ramp.
    """
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
    """A run on a plane without friction, of rock without strength, which slides as soon as gravity has grown: its
    folder and what the command said.
    """
    folder = tmp_path_factory.mktemp("dry")
    source = written(
        folder / "weak.yaml",
        materials__dp__friction=0.0,
        materials__dp__residual_friction=0.0,
        materials__rock__tensile_strength=2e3,
        materials__rock__residual_tensile_strength=0.0,
        materials__fb__tensile_strength=2e3,
        stages__settle__ramp=1.0,
        stages__dry=0.5,
        stages__end__time=8.0,
        numerics__tolerance=1e-4,
        numerics__max_iterations=30,
    )
    done = shell.run("jiufengershan.py", "--section", source, "--disks", 300, "--out", folder / "out", "--threads", 1)
    assert done.returncode == 0, done.stdout + done.stderr
    return folder / "out", done.stdout


def test_a_slope_that_fails_dry_is_no_failure_by_water(failed):
    out, said = failed
    summary = json.loads((out / "summary.json").read_text())
    assert "THE SLOPE FAILED DRY, at " in said
    assert 1.0 < summary["failed_dry_s"] < 8.0  # gravity needs 1 s to grow; then g sin 21° is 3.5 m/s²
    for name in (
        "water_at_failure_m",
        "fb_force_dry_N_per_m",
        "fb_force_at_failure_N_per_m",
        "dp_shear_dry_N_per_m",
        "dp_shear_at_failure_N_per_m",
        "weakening_begins_s",
        "triggering_s",
        "weakening_s",
        "motion_s",
        "bulking_factor",
    ):
        assert summary[name] is None, name
    assert [name for name, t in summary["times_s"].items() if t is None and name != "t5"] == ["t0", "t1", "t2", "t3"]
    assert summary["times_s"]["t4"] > summary["failed_dry_s"]
    series = records.read_series(out / "series.csv")
    # from the beginning
    assert summary["front_travel_m"] == pytest.approx(series["front_m"][-1] - series["front_m"][0])
    assert summary["centroid_travel_m"] > 5  # some seconds at some m/s
    assert summary["energy_error_rel"] < 0.02  # of the rows since gravity has grown; before, the balance means nothing
    assert not (out / "deposit.png").exists() and (out / "energy.png").stat().st_size > 1000


def test_rows_begin_with_the_run_and_name_their_stage(failed):
    series = records.read_series(failed[0] / "series.csv")
    assert series["time_s"][0] == pytest.approx(0.1, abs=1e-9) and np.allclose(
        np.diff(series["time_s"]), 0.1, atol=0.006
    )
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
    series = {
        "time_s": t,
        "energy_kinetic_J": np.interp(t, [5, 10, 20], [0, 1, 0]),
        "speed_mean_m_per_s": np.interp(t, [5, 10, 20], [0, 9, 0]),
        "weakened_disks": np.where(t > 6, 10**6, 0),
        "stage": np.where(t < 7, 0, 2),
    }
    times = characteristic_times.of_run(series, slope_of, {"t0": 7.0, "moving": 6.0, "failed_dry": 6.0})
    assert [times[name] for name in ("t0", "t1", "t2", "t3")] == [None] * 4
    assert times["t4"] == pytest.approx(10) and times["t5"] == pytest.approx(20 - 0.02 * 10, abs=0.11)
    assert characteristic_times.chosen_rows(series, {"failed_dry": 6.0}) is series
    assert characteristic_times.chosen_rows(series, {})["time_s"][0] == pytest.approx(7.0)


class Stub:
    """What the course asks of the solver, of the water and of a wall's material, and the names of what it has them
    do.
    """

    def __init__(self):
        self.height, self.times, self.heights, self.tolerance, self.contacts, self.done = 0.0, [], [], 0.0, 900, []

    def bond(self):
        self.done.append("bond")
        return 800

    def __getattr__(self, name):  # forgetEnergies, forgetSlip, forgetReleases
        if not name.startswith("forget"):
            raise AttributeError(name)
        return lambda: self.done.append(name)


def test_what_the_course_decides_is_done(loaded, tmp_path, monkeypatch):
    """The rules are tested in test_course.py; here it is that they reach the scene."""
    run = experiment.Experiment(loaded, tmp_path)
    table, saved = experiment.tables.bodies(loaded.solver), []
    monkeypatch.setattr(experiment.tables, "bodies", lambda _: table)
    solver = run.slope.solver = Stub()
    water = run.slope.water = Stub()
    material = Stub()
    monkeypatch.setattr(type(run.slope), "wall_material", lambda *_: material)
    monkeypatch.setattr(run, "snapshot", lambda path, contacts=False: saved.append((path.name, contacts)))
    monkeypatch.setattr(run, "checkpoint", lambda: saved.append(run.state.stage))
    monkeypatch.setattr(run.monitor, "packing_fraction", lambda: 0.83)
    monkeypatch.setattr(
        run,
        "section",
        dataclasses.replace(
            run.section,
            stages=dataclasses.replace(
                run.section.stages, settle=dataclasses.replace(run.section.stages.settle, bond="after")
            ),
        ),
    )

    def decide(time, speed, height):
        run._decide(course.Seen(time, 1e-2, speed, height))

    run.state = course.State()
    decide(3.0, 1e-3, 0.0)  # gravity grows until 4 s
    assert (
        saved == solver.done == water.done == []
        and run._gravity(3.0)[1] == pytest.approx(-0.75 * 9.81)
        and run._gravity(5.0)[1] == -9.81
    )
    decide(5.0, 1e-3, 0.0)
    assert (
        saved == ["dry"]
        and solver.done == ["bond", "forgetEnergies"]
        and water.done == ["forgetReleases"]
        and material.done == ["forgetSlip"] * 3
    )
    assert (run.state.packing_fraction, run.state.bonds_initial, run.state.contacts_initial) == (
        0.83,
        800,
        900,
    ) and water.times == []
    decide(8.0, 1e-3, 0.0)
    # but for a thousandth of the area
    assert saved[1:] == [("t0.npz", True), "water"] and run.state.front0 == pytest.approx(
        np.max(table["x"] + table["r"]), abs=20
    )
    assert (water.times, water.heights, solver.tolerance) == ([8.0, 158.0], [0.0, 150.0], 0.0)
    numerics = run.section.numerics
    decide(20.0, 0.1, 12.0)
    assert solver.tolerance == numerics.tolerance and water.heights == [0.0, 150.0]
    run.state = course.noted(run.state, course.Seen(20.1, 1e-2, 0.3, 12.1), run.scales)
    decide(20.1, 0.3, 12.1)
    assert solver.tolerance == numerics.tolerance_moving and water.heights == [12.1]
    decide(22.1, 0.01, 12.1)
    # two seconds later than before
    assert solver.tolerance == numerics.tolerance and (water.times, water.heights) == ([10.0, 160.0], [0.0, 150.0])
    run.hard, run.damping = False, (0.2, 0.04)
    run.state = course.noted(run.state, course.Seen(40.0, 1e-2, 20.0, 30.0), run.scales)
    decide(40.0, 20.0, 30.0)
    assert run.newton.damping == pytest.approx(0.04, rel=1e-12) and saved[3:] == []
    decide(50.0, 0.1, 30.0)
    assert run.newton.damping == pytest.approx(0.2 - 0.16 * 0.05, rel=1e-12)  # 0.1 of a tenth of 20 m/s
    decide(55.0, 0.1, 30.0)
    assert saved[3:] == [("end.npz", True)] and run.state.stage == "done"


def looked_at(count=2, gone=None):
    """What SlopeMonitor.inside asks of a slope of so many disks, of which windows have taken some out."""
    built = SimpleNamespace(count=count, first_disk=10)
    eroding = None if gone is None else SimpleNamespace(disks=gone)
    return SimpleNamespace(section=section.load("jiufengershan"), slope=built, eroding=eroding)


@pytest.mark.parametrize("side", ["left", "right", "below", "above"])
def test_a_disk_that_leaves_the_section_is_refused(side):
    """On each side a tenth of the section's longer side beyond its box, and where it is nowhere at all."""
    run = looked_at()
    x0, y0, x1, y1 = run.section.bounds
    margin = 0.1 * max(x1 - x0, y1 - y0)
    middle = (0.5 * (x0 + x1), 0.5 * (y0 + y1))
    axis, end, way = {"left": (0, x0, -1), "right": (0, x1, 1), "below": (1, y0, -1), "above": (1, y1, 1)}[side]

    def place(at):
        return tuple(at if k == axis else middle[k] for k in (0, 1))

    def table(one):
        return {"id": [10, 11], "x": np.array([middle[0], one[0]]), "y": np.array([middle[1], one[1]])}

    SlopeMonitor.inside(run, table(place(end + way * (margin - 1e-3))), "out")
    for lost in (end + way * (margin + 1e-3), way * 1e9, np.nan):
        with pytest.raises(experiment.ExperimentError) as refused:
            SlopeMonitor.inside(run, table(place(lost)), "out")
        x, y = place(lost)
        assert str(refused.value).startswith(
            f"disk 1 left the section at t = {O.time:.3f} s: it is at ({x:.1f}, {y:.1f}) m; "
        )
        assert f"close the walls of {run.section.source} there" in str(refused.value)


@pytest.mark.parametrize("count", [1, 3])
def test_a_slope_whose_script_erases_or_adds_disks_is_refused(count):
    run = looked_at()
    with pytest.raises(
        experiment.ExperimentError,
        match=f"the scene has {count} disks, and the slope 2: .* neither erase nor add disks",
    ):
        SlopeMonitor.inside(run, {"x": np.zeros(count), "y": np.zeros(count)}, "out")
    gone = looked_at(5, gone=3)
    with pytest.raises(experiment.ExperimentError, match=f"the scene has {count} disks, and the slope 2: "):
        SlopeMonitor.inside(gone, {"x": np.zeros(count), "y": np.zeros(count)}, "out")


def test_a_disk_that_leaves_is_told_by_its_number_where_others_are_gone():
    run = looked_at(5, gone=3)
    with pytest.raises(experiment.ExperimentError, match="disk 4 left the section"):
        SlopeMonitor.inside(run, {"id": [11, 14], "x": np.array([0.0, 1e9]), "y": np.zeros(2)}, "out")


def test_a_row_that_sees_a_lost_disk_ends_the_run_and_is_not_written(loaded, tmp_path):
    run = experiment.Experiment(loaded, tmp_path)
    loaded.solver.view()  # O.bodies are as the course has left them: what is written there counts
    O.bodies[loaded.first_disk + 7].state.pos = (-5000, 300, 0)
    with pytest.raises(
        experiment.ExperimentError, match=r"^disk 7 left the section at t = 0.1\d\d s: it is at \(-5000.0, "
    ):
        run.run(end=0.3)
    assert len(records.read_series(tmp_path / "series.csv")["step"]) == 0


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
        for name in loaded.walls:
            seen[name].append((*by_hand(loaded, name), O.dt))
    found = forces.take()
    for name, rows in seen.items():
        normal, shear, step = np.array(rows).T
        wanted = ((normal * step).sum() / step.sum(), (shear * step).sum() / step.sum(), normal.max())
        assert found[name] == pytest.approx(wanted, rel=1e-9, abs=1e-3)  # N/m: rounding of sums of some 1e7
    assert found["DP"][2] > 1.02 * found["DP"][0] > 0  # packed just short of touching: the disks hit the plane
    O.step()
    # what was before is forgotten
    assert forces.take()["DP"] == pytest.approx((*by_hand(loaded, "DP"), by_hand(loaded, "DP")[0]), rel=1e-9)


def test_rows_hold_means_and_peaks(loaded, tmp_path, monkeypatch):
    run, normal, advance = experiment.Experiment(loaded, tmp_path), [], experiment.advance
    # steps without weight belong to no row
    assert O.iter == 2 and [e.seconds for e in O.engines if isinstance(e, WallForceEngine)] == [0, 0, 0]

    def step_by_step(until, view):
        while O.time < until - 0.5 * O.dt:
            before = O.time
            advance()
            normal.append((O.iter, *by_hand(loaded, "DP"), O.time - before))

    monkeypatch.setattr(experiment, "advance", step_by_step)
    run.run(end=0.5)
    series = records.read_series(tmp_path / "series.csv")
    step, force, _, seconds = np.array(normal).T
    assert len(series["step"]) == 5
    for k, (first, last) in enumerate(zip((2, *series["step"]), series["step"])):
        row = (step > first) & (step <= last)
        assert series["dp_normal_effective_N_per_m"][k] == pytest.approx(
            (force * seconds)[row].sum() / seconds[row].sum(), rel=1e-9
        )
        assert series["dp_normal_peak_N_per_m"][k] == pytest.approx(force[row].max(), rel=1e-9)
    assert (series["dp_normal_peak_N_per_m"] >= series["dp_normal_effective_N_per_m"]).all()


# ---- options --------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    "option, value",
    [
        ("--water", "nan"),
        ("--water", "-1"),
        ("--water", "inf"),
        ("--end", "-1"),
        ("--end", "nan"),
        ("--end", "0"),
        ("--disks", "0"),
        ("--disks", "1000000000000"),
        ("--disks", "300.5"),
        ("--seed", "-1"),
        ("--seed", "9" * 99),
        ("--threads", "5000"),
    ],
)
def test_options_without_sense(option, value, in_process, tmp_path):
    # one word, so that -1 is no option
    done = in_process("jiufengershan.py", f"{option}={value}", "--out", tmp_path / "out")
    assert done.status == 2 and "Traceback" not in done.err and option in done.last
    assert not (tmp_path / "out").exists()


def test_water_on_a_section_without(in_process, tmp_path):
    text = SHIPPED.read_text()
    begin, end = text.index("\nwater:"), text.index("\nstages:")
    (tmp_path / "dry.yaml").write_text(text[:begin] + text[end:])
    done = in_process("jiufengershan.py", "--section", tmp_path / "dry.yaml", "--water", 1, "--out", tmp_path / "out")
    assert done.status == 1 and "has no water" in done.last


def test_a_packing_of_another_slope(in_process, loose, tmp_path):
    made = packing.pack(loose, 1)
    packing.write_text(dataclasses.replace(made, layer=0 * made.layer), tmp_path / "p.txt")
    done = in_process(
        "jiufengershan.py",
        "--section",
        loose.source,
        "--disks",
        300,
        "--packing",
        tmp_path / "p.txt",
        "--out",
        tmp_path / "out",
    )
    assert done.status == 1 and "p.txt: no disk belongs to layer 1 (L2)" in done.last
