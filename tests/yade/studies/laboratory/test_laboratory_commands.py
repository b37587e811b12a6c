"""The laboratory's commands from their words to their files, with rocks that are made up or samples that are tiny."""
import json
import math

import pytest
from yade.nonsmooth import records
from yade.nonsmooth.laboratory import calibration, effects, materials
from yade.nonsmooth.measure import strength


def made_up(material, disks, with_residual):
    """c [Pa], φ [°] (and residual ones) of a rock whose strengths are known functions of its contacts, a little
    stronger in coarse samples.
    """
    m, coarse = material, 1.03 if disks < 1000 else 1.0
    found = [
        coarse * 0.9 * m.tensile_strength * m.friction**0.2,
        coarse * (45 + 7 * math.log(m.friction) + 3 * math.log(10 * m.rolling_friction)),
        0.5 * m.residual_tensile_strength,
        30 + 3 * math.log(m.friction) + 6 * math.log(10 * m.rolling_friction),
    ]
    return found if with_residual else found[:2]


@pytest.fixture
def trials(monkeypatch):
    """(material, disks, seeds) of every trial that calibrate.py asks for; the rock is made up."""
    made = []

    def test(self, material, disks, seeds):
        made.append((material, disks, seeds))
        return made_up(material, disks, self.wanted.with_residual)

    monkeypatch.setattr(calibration.Calibration, "test", test)
    monkeypatch.setattr(calibration.Calibration, "timed", lambda self: (3e-6, 1.5))
    return made


@pytest.mark.parametrize("residual", [(), ("--residual-cohesion", 6e3, "--residual-friction", 25)])
def test_calibrate_writes_a_material_that_has_the_strengths(in_process, trials, tmp_path, residual):
    out = tmp_path / "granite.yaml"
    words = (
        "--cohesion",
        60e3,
        "--friction",
        34,
        *residual,
        "--coarse",
        600,
        "--fine",
        2500,
        "--seeds",
        1,
        2,
        "--threads",
        1,
        "--out",
        out,
    )
    done = in_process("calibrate.py", *words)
    assert done.status == 0, done.err
    found = materials.load(out)
    strengths = made_up(found, 2500, bool(residual))
    # the search ends within 2 % and 0.7°
    assert strengths[0] == pytest.approx(60e3, rel=0.021) and strengths[1] == pytest.approx(34, abs=0.71)
    assert (found.envelope.cohesion, found.envelope.friction_deg) == pytest.approx(strengths[:2], rel=1e-9)
    if residual:
        assert strengths[2] == pytest.approx(6e3, abs=0.02 * 60e3) and strengths[3] == pytest.approx(25, abs=0.71)
    assert {disks for _, disks, _ in trials} == {600, 2500} and all(seeds == [1, 2] for *_, seeds in trials)
    report = json.loads((tmp_path / "granite-calibration" / "report.json").read_text())
    assert report["reached"] is True and report["wall_s"] >= 0 and len(report["trials"]) == len(trials)
    known = calibration.uncertainty(2500, [1, 2])
    told = (
        f"c = {1e-3 * strengths[0]:.1f} ± {1e-3 * strengths[0] * known['cohesion_rel']:.1f} kPa",
        f"φ = {strengths[1]:.2f} ± {known['friction_deg']:.1f}°",
    )
    assert f"{out}: {told[0]} (wanted 60), {told[1]} (wanted 34)" in done.out and "NOT REACHED" not in done.err
    text = out.read_text()
    assert "# Calibrated by scripts/calibrate.py for c = 60 kPa, φ = 34°." in text
    assert f"# 2 samples of 2500 disks gave {told[0]}, {told[1]} (95 %, from the scatter of such samples)." in text
    count = len(trials)
    again = in_process("calibrate.py", *words, "--resume")
    assert again.status == 0 and len(trials) == count and materials.load(out) == found  # all trials were kept


def test_a_quick_calibration_is_of_small_samples_and_says_so(in_process, trials, tmp_path):
    out = tmp_path / "quick.yaml"
    done = in_process("calibrate.py", "--cohesion", 60e3, "--friction", 34, "--quick", "--threads", 2, "--out", out)
    assert done.status == 0, done.err
    # how long it takes is said before any trial
    assert done.out.splitlines()[0].startswith(
        "1 to 4 trials of 16 tests (1000 disks) on 2 threads take about 84 s to 5.6 min"
    )
    assert {disks for _, disks, _ in trials} == {1000} and len(trials) <= 4
    strengths = made_up(materials.load(out), 1000, False)
    assert strengths[0] == pytest.approx(60e3, rel=0.021) and strengths[1] == pytest.approx(34, abs=0.71)
    known = calibration.uncertainty(1000, [11, 12, 13, 14])
    assert f"φ = {strengths[1]:.2f} ± {known['friction_deg']:.1f}° (wanted 34)" in done.out
    assert "4 samples of 1000 disks gave c = " in out.read_text() and "calibrate.py --quick for" in out.read_text()
    report = json.loads((tmp_path / "quick-calibration" / "report.json").read_text())
    assert report["quick"] is True and report["uncertainty_95"] == pytest.approx(known)


def test_calibrate_says_what_it_has_not_reached(in_process, trials, tmp_path):
    done = in_process(
        "calibrate.py",
        "--cohesion",
        60e3,
        "--friction",
        59,
        "--coarse",
        600,
        "--fine",
        2500,
        "--out",
        tmp_path / "m.yaml",
        "--threads",
        1,
    )
    # 45° + 7° ln 2 with the most friction
    assert done.status == 0 and done.last.startswith(
        "NOT REACHED: the best trial misses the wanted strengths by up to "
    )


def test_wall_shear_measures_what_the_wall_has(in_process, tmp_path):
    """Two slides on SS, bonded as nobody ships it: eq. 4 says friction 0.2 and a cohesion of 0.2 times the strength on
    the part that is covered.
    """
    words = (
        "--material",
        "ss",
        "--bonded",
        "--tensile-strength",
        200,
        "--pressures",
        "0.5,2",
        "--seeds",
        1,
        "--threads",
        2,
        "--out",
        tmp_path,
    )
    done = in_process("wall_shear.py", *words)
    assert done.status == 0, done.err
    (told,) = json.loads((tmp_path / "summary.json").read_text())["tests"]
    assert (told["material"], told["seed"], told["pressures_Pa"]) == ("ss", 1, [0.5e6, 2e6])
    # the solver's tolerance is 1e-4
    assert told["friction_peak"] == pytest.approx(0.2, rel=1e-3) and told["friction_residual"] == pytest.approx(
        0.2, rel=1e-3
    )
    assert told["cohesion_peak_kPa"] == pytest.approx(0.2 * 200 * told["coverage"], abs=0.5) and told[
        "cohesion_residual_kPa"
    ] == pytest.approx(0, abs=0.5)
    assert f"{'ss':10s} {1:4d} {0.2:16.3f} {math.degrees(math.atan(told['friction_peak'])):6.1f}" in done.out
    series = records.read_series(tmp_path / "tests" / "ss-2MPa-seed1" / "series.csv")
    # 0.08 of the largest disk
    assert series["normal_Pa"].mean() == pytest.approx(2e6, rel=0.01) and series["slip_m"][-1] == pytest.approx(
        0.32, abs=1e-3
    )
    assert (tmp_path / "wall_shear.png").stat().st_size > 10_000
    before = (tmp_path / "tests" / "ss-2MPa-seed1" / "series.csv").stat().st_mtime_ns
    assert in_process("wall_shear.py", *words, "--resume").status == 0
    assert (tmp_path / "tests" / "ss-2MPa-seed1" / "series.csv").stat().st_mtime_ns == before


def test_biaxial_effects_runs_and_tells_each_value(in_process, tmp_path, monkeypatch):
    """Real tests of a tiny sample: three time steps, one of them the usual one."""
    asked = effects.effects
    monkeypatch.setattr(effects, "effects", lambda *words: asked(*words, strain=0.012, sides="rigid", tolerance=1e-3))
    done = in_process(
        "biaxial_effects.py",
        "--disks",
        200,
        "--seeds",
        1,
        "--only",
        "step",
        "--confining",
        1,
        "--threads",
        2,
        "--out",
        tmp_path,
    )
    assert done.status == 0, done.err
    told = json.loads((tmp_path / "summary.json").read_text())
    assert told["confining_Pa"] == 1e6 and [(row["value"], row["usual"]) for row in told["rows"]] == [
        (0.2, False),
        (0.1, True),
        (0.05, False),
    ]
    # what each test's own curve says
    paths = [tmp_path / f"step-{h}" / "tests" / "1MPa-seed1" / "series.csv" for h in (0.2, 0.1, 0.05)]
    curves = [strength.curve(records.read_series(path), (0.006, 0.012)) for path in paths]
    for row, curve in zip(told["rows"], curves):
        for kind in ("peak", "residual"):
            minor = {"peak": curve.peak_confining, "residual": curve.residual_confining}[kind]
            major = getattr(curve, kind)
            # sin φ = (σ₁ - σ₃)/(σ₁ + σ₃); rounding
            assert math.sin(math.radians(row[f"{kind}_mean_deg"])) == pytest.approx((major - minor) / (major + minor))
            change = major / getattr(curves[1], kind) - 1
            assert row[f"{kind}_change_rel"] == pytest.approx(change, abs=1e-12)
    assert (
        (tmp_path / "effects.png").stat().st_size > 10_000
        and done.out.count("time step [t_i]") == 3
        and done.out.count("usual") == 1
    )
