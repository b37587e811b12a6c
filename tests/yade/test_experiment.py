"""The slope's course: same bits on any number of threads and after a kill, and bad input refused before anything is lost."""

import json
import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
import slope_scenes

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "jiufengershan.py"
DISKS = "400"   # coarse: enough for walls, layers and water to act
END = "3"       # s: gravity's ramp, the dry rest, and some of the water's rise


@pytest.fixture(scope="module")
def section(tmp_path_factory):
    return slope_scenes.write_quick(tmp_path_factory.mktemp("section"), strong=True)


def run(section, out, *options, check=True, end=END, **kwargs):
    done = subprocess.run([SCRIPT, "--section", section, "--disks", DISKS, "--out", out, "--end", end, *options], capture_output=True,
                          text=True, **kwargs)
    if check:
        assert done.returncode == 0, done.stdout + done.stderr
    return done


@pytest.fixture(scope="module")
def unbroken(section, tmp_path_factory):
    out = tmp_path_factory.mktemp("unbroken")
    run(section, out, "--threads", "2")
    return out


def test_records_and_figures_are_there(unbroken):
    summary = json.loads((unbroken / "summary.json").read_text())
    assert summary["disks"] == pytest.approx(400, abs=4)  # counts of layers are rounded
    # so few disks have hardly a bulk; where it can be measured, it is a dense packing
    assert summary["packing_fraction"] is None or 0.80 < summary["packing_fraction"] < 0.90
    assert summary["finished"] is False and summary["failed_dry_s"] is None and summary["times_s"]["t0"] == pytest.approx(2.0)  # 1.5 + 0.5 s
    for name in ("series.csv", "force_chains.png", "forces.png", "snapshots.png", "energy.png", "solver.png"):
        assert (unbroken / name).stat().st_size > 1000


def test_one_thread_gives_the_same_bits(section, unbroken, tmp_path):
    run(section, tmp_path, "--threads", "1", "--no-figures")
    assert (tmp_path / "series.csv").read_bytes() == (unbroken / "series.csv").read_bytes()
    assert not list(tmp_path.glob("*.png")) and not (tmp_path / "vtk").exists()
    from yade.nonsmooth import results
    from yade.nonsmooth.section import load

    made, _ = results.draw(tmp_path, load(str(section)).with_disks(int(DISKS)), json.loads((tmp_path / "summary.json").read_text()))
    assert {"forces.png", "energy.png"} <= {path.name for path in made} and all(path.exists() for path in made)


def test_resumed_after_an_early_end_gives_the_same_bits(section, unbroken, tmp_path):
    run(section, tmp_path, "--no-figures", end="1.8")
    run(section, tmp_path, "--no-figures", "--resume")
    assert (tmp_path / "series.csv").read_bytes() == (unbroken / "series.csv").read_bytes()


def test_resumed_after_a_kill_gives_the_same_bits(section, unbroken, tmp_path):
    process = subprocess.Popen([SCRIPT, "--section", section, "--disks", DISKS, "--out", tmp_path], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               start_new_session=True)
    series = tmp_path / "series.csv"
    for _ in range(1200):  # killed some rows after the last checkpoint, at no particular moment
        if series.exists() and len(series.read_bytes().splitlines()) > 23:
            break
        time.sleep(0.1)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    run(section, tmp_path, "--resume")
    assert series.read_bytes() == (unbroken / "series.csv").read_bytes()


def refused(*options, **kwargs):
    done = subprocess.run([SCRIPT, *options], capture_output=True, text=True, **kwargs)
    assert done.returncode != 0
    assert "Traceback" not in done.stderr, done.stderr
    return done.stderr


def test_resume_without_a_checkpoint(tmp_path):
    message = refused("--disks", DISKS, "--out", tmp_path, "--resume")
    assert "checkpoint.json" in message and "without --resume" in message


def test_truncated_checkpoint_is_refused_and_nothing_is_lost(section, unbroken, tmp_path):
    out = tmp_path / "copy"
    shutil.copytree(unbroken, out)
    scene = next((out / "checkpoint").glob("scene-*.yade"))
    scene.write_bytes(scene.read_bytes()[:1000])
    before = (out / "series.csv").read_bytes()
    message = refused("--section", section, "--disks", DISKS, "--out", out, "--resume")
    assert scene.name in message and "truncated" in message
    assert (out / "series.csv").read_bytes() == before


def test_checkpoint_of_another_section(section, unbroken):
    assert "other settings" in refused("--section", section, "--disks", "450", "--out", unbroken, "--resume")


def test_unwritable_output(tmp_path):
    blocker = tmp_path / "file"
    blocker.write_text("")
    message = refused("--disks", DISKS, "--out", blocker / "out")
    assert "cannot be written" in message and "--out" in message


def test_unreadable_packing(tmp_path):
    path = tmp_path / "packing.txt"
    path.write_text("1.0 2.0 0.5\n1.0 nan 0.5\n")
    message = refused("--packing", path, "--out", tmp_path / "out")
    assert "packing.txt" in message and "2" in message


def test_unknown_key_in_the_section(tmp_path):
    path = tmp_path / "slope.yaml"
    text = slope_scenes.SHIPPED.read_text()
    path.write_text(text.replace("gravity: 9.81", "gravity: 9.81\ncolour: red"))
    message = refused("--section", path, "--out", tmp_path / "out")
    assert "slope.yaml" in message and "colour" in message




def test_a_slope_that_stands_still_is_solved_more_tightly(section, tmp_path):
    """Five seconds after the settling (1.5 s), with a table at rest; a rising one keeps the tolerance."""
    from yade.nonsmooth import records

    run(section, tmp_path / "dry", "--no-figures", "--water", "0", end="7.5")
    dry = records.read_series(tmp_path / "dry" / "series.csv")
    settled = dry["time_s"][dry["stage"] > 0][0]
    late = dry["time_s"] > settled + 5.1  # the rule is looked at once a row, 0.1 s
    assert (dry["speed_mean_m_per_s"] < 0.2).all()  # else it would count as moving
    assert set(dry["tolerance"][late]) == {0.25e-4} and set(dry["tolerance"][dry["time_s"] < settled + 4.9]) == {1e-4}
    run(section, tmp_path / "wet", "--no-figures", end="7.5")
    wet = records.read_series(tmp_path / "wet" / "series.csv")
    assert (wet["tolerance"] >= 1e-4).all()


def test_fast_disks_shorten_steps_and_rows_keep_their_distance(section, tmp_path):
    from yade.nonsmooth import records

    short = tmp_path / "short.yaml"
    short.write_text(section.read_text().replace("path: 0.1 ", "path: 1e-4 "))
    run(short, tmp_path / "whole", "--no-figures")
    series = records.read_series(tmp_path / "whole" / "series.csv")
    steps_a_second = np.diff(series["step"]) / np.diff(series["time_s"])
    assert steps_a_second.min() > 99 and steps_a_second.max() > 120  # 100 with the section's longest step of 10 ms
    tenths = series["time_s"] / 0.1
    assert np.abs(tenths - np.round(tenths)).max() <= 0.5 * 1e-2 / 0.1 + 1e-6  # half a step
    assert len(set(np.round(tenths))) == len(tenths)
    run(short, tmp_path / "broken", "--no-figures", end="1.8")
    run(short, tmp_path / "broken", "--no-figures", "--resume")
    assert (tmp_path / "broken" / "series.csv").read_bytes() == (tmp_path / "whole" / "series.csv").read_bytes()


def test_bonds_can_be_made_after_gravity_has_grown(section, unbroken, tmp_path):
    from yade.nonsmooth import records

    later = tmp_path / "later.yaml"
    later.write_text(section.read_text().replace("    ramp: 1.0", "    bond: after\n    ramp: 1.0"))
    run(later, tmp_path / "out", end="1.7")
    first, usual = (json.loads((folder / "summary.json").read_text()) for folder in (tmp_path / "out", unbroken))
    assert 300 > first["bonds_initial"] > 100 and first["bonds_initial"] != usual["bonds_initial"]  # 400 coarse disks have little more than 200 neighbours
    series = records.read_series(tmp_path / "out" / "series.csv")
    assert (series["bonds_alive"][series["stage"] == 0] == 0).all()
    assert series["bonds_alive"][series["stage"] > 0][0] > 0.9 * first["bonds_initial"]
