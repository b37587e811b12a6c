"""A slope that is killed at any moment, also over the folder of an earlier run, and goes on: the same bytes as one that
was never disturbed.

NONSMOOTH_KILLS: how many kills (default 4), every fourth over an old folder. Run NONSMOOTH_KILLS=40 after changes to
what runs write.
"""

import os
import random
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest
import shell
import slope_scenes
from shell import SCRIPTS

KILLS = int(os.environ.get("NONSMOOTH_KILLS", "4"))
DISKS, END = "600", "2.5"  # s: settled at 1.5, rows, bonds that break, the water's rise from 2.0
BEGINNING = (
    40  # accesses to files in which a run over an old folder removes the old records and writes its first checkpoints
)


def command(section, out, look, *options):
    return [
        str(word)
        for word in (
            SCRIPTS / "yade-nonsmooth",
            Path(__file__).resolve().parents[2] / "killed_run.py",
            section,
            DISKS,
            out,
            END,
            look,
            "--threads",
            1,
            *options,
        )
    ]


def run(*arguments):
    return shell.run(*command(*arguments))


@pytest.fixture(scope="module")
def section(tmp_path_factory):
    path = slope_scenes.write_quick(tmp_path_factory.mktemp("section"))
    # not pressed, and bonded before gravity grows: so that bonds break within the few seconds that are run
    path.write_text(path.read_text().replace("bond: after", "bond: before").replace("pressed: true", "pressed: false"))
    return path


@pytest.fixture(scope="module")
def whole(section, tmp_path_factory):
    """An undisturbed run: its folder, how often it looked at files, and its wall time [s]."""
    out, began = tmp_path_factory.mktemp("whole") / "out", time.monotonic()
    done = run(section, out, 0)
    assert done.returncode == 0, done.stderr
    # something to compare
    assert (
        len((out / "breaks.csv").read_text().splitlines()) > 5
        and len((out / "series.csv").read_text().splitlines()) > 5
    )
    return out, int(out.with_suffix(".looks").read_text()), time.monotonic() - began


@pytest.fixture(scope="module")
def other(section, tmp_path_factory):
    """A run with other stages, whose checkpoint the section's own does not fit."""
    changed = tmp_path_factory.mktemp("other") / "other.yaml"
    changed.write_text(section.read_text().replace("dry: 0.5", "dry: 0.3"))
    assert run(changed, changed.with_name("out"), 0).returncode == 0
    return changed.with_name("out")


def records_of(out):
    return {name: (out / name).read_bytes() for name in ("series.csv", "walls.csv", "breaks.csv")}


@pytest.mark.parametrize("number", range(KILLS))
def test_a_killed_run_goes_on_with_the_same_bytes(section, whole, other, tmp_path, number):
    unbroken, looks, seconds = whole
    chance, out = random.Random(number), tmp_path / "out"
    if number % 4 == 0:  # over the folder of an earlier run: the same one, or another
        shutil.copytree(unbroken if number % 8 == 0 else other, out)
    if number % 4 == 3:
        process = subprocess.Popen(
            command(section, out, 0), env=shell.environment(), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        time.sleep(chance.uniform(0.3, 1.0) * seconds)
        process.kill()
        process.wait()
    else:
        killed = run(section, out, chance.randint(1, BEGINNING if number % 4 == 0 else looks))
        assert killed.returncode in (-signal.SIGKILL, 128 + signal.SIGKILL), killed.stderr
    again = run(section, out, 0, "--resume")
    if again.returncode:  # killed before its first checkpoint, or before the old records were gone: one line says so
        assert "Traceback" not in again.stderr
        last = again.stderr.splitlines()[-1]
        assert last.startswith("error: ") and (
            "there is no checkpoint" in last or number % 8 == 4 and "other settings" in last
        ), again.stderr
        again = run(section, out, 0)
    assert again.returncode == 0, again.stderr
    assert records_of(out) == records_of(unbroken)
    assert not list(out.rglob(".part-*"))
