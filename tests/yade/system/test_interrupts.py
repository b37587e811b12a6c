"""Ctrl-C: one line and the status 130, from every command and at whatever moment it comes; what has ended is kept, and
runs go on with the same bytes.
"""

import json
import os
import re
import signal
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
import slope_scenes
from shell import ended, start, wait_for
from yade.nonsmooth import commands, records
from yade.nonsmooth.running import interrupts, processes, side_by_side
from yade.nonsmooth.system import output_folder

SLOPE = ("--disks", "300", "--threads", "1", "--seed", "1")


@pytest.fixture(scope="module")
def section(tmp_path_factory):
    return slope_scenes.write_quick(tmp_path_factory.mktemp("section"))


def rows(path):
    return path.read_bytes().count(b"\n") - 1 if path.exists() else 0


def test_ctrl_c_writes_a_checkpoint_and_the_run_goes_on_with_the_same_bytes(section, tmp_path):
    options = ("--section", section, *SLOPE, "--end", "3")
    assert ended(start("jiufengershan.py", *options, "--out", tmp_path / "whole"))[0] == 0
    out = tmp_path / "out"
    for number in range(2):
        # of 30 rows of 0.1 s; two new ones, so that it is on its way
        least = 2 + (rows(out / "series.csv") if number else 0)
        process = start("jiufengershan.py", *options, "--out", out, *(["--resume"] if number else []))
        wait_for(lambda least=least: rows(out / "series.csv") >= least, process)
        process.send_signal(signal.SIGINT)
        status, _, lines = ended(process)
        assert status == 130
        assert (
            re.fullmatch(
                r"stopped: at \d\.\d s of simulated time; the checkpoint is written, go on with --resume", lines[-2]
            )
            and lines[-1] == ""
        )
        series = records.read_series(out / "series.csv")
        told = json.loads((out / "checkpoint" / "checkpoint.json").read_text())
        assert told["step"] == series["step"][-1]
    assert ended(start("jiufengershan.py", *options, "--out", out, "--resume"))[0] == 0
    for name in ("series.csv", "breaks.csv"):
        assert (out / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()


@pytest.mark.parametrize(
    "name, arguments",
    [
        ("biaxial.py", ("--disks", 400, "--confining", "1", "--threads", 1)),
        ("biaxial_effects.py", ("--seeds", 1, "--threads", 1, "--only", "step")),
        ("tension_test.py", ("--disks", 400, "--seeds", 1, "--threads", 1)),
        ("wall_shear.py", ("--material", "dp", "--seeds", 1, "--threads", 1)),
        ("rocks.py", ("--threads", 1)),
        ("column.py", ("--disks", 400, "--aspect", "1", "--threads", 1)),
        ("compare_hard_soft.py", ("--scenario", "column", "--disks", 150, "--seeds", 1, "--threads", 1)),
        ("wedge.py", ()),
        ("verify.py", ("--quick", "--threads", 1)),
        ("calibrate.py", ("--cohesion", 50e3, "--friction", 30, "--threads", 1)),
        ("benchmark.py", ("--quick", "--disks", 600, "--threads", 1)),
        # still packing: no packing of this seed is in the cache
        ("jiufengershan.py", ("--disks", 20000, "--seed", 987)),
    ],
)
def test_ctrl_c_ends_every_command_with_one_line_and_status_130(tmp_path, name, arguments):
    out = tmp_path / "material.yaml" if name == "calibrate.py" else tmp_path
    process = start(name, *arguments, "--out", out)
    lock = tmp_path / ("material-calibration" if name == "calibrate.py" else "") / output_folder.LOCK
    wait_for(lambda: lock.exists() and name in lock.read_text(), process)
    time.sleep(1.0)  # into whatever it does then
    process.send_signal(signal.SIGINT)
    status, _, lines = ended(process)
    assert status == 130, lines
    assert lines[-2].startswith("stopped: ") and lines[-1] == "" and not any("error" in line for line in lines), lines


def test_ctrl_c_ends_runs_side_by_side_with_their_checkpoints(tmp_path):
    """A command that alone is told hands it on; the tests then go on where they were, with the bytes of undisturbed
    ones.
    """
    options = (
        "--disks",
        150,
        "--diameter",
        1,
        2,
        "--fraction",
        0.82,
        "--confining",
        "0.5,4",
        "--strain",
        0.03,
        "--sides",
        "rigid",
        "--threads",
        1,
    )
    assert ended(start("biaxial.py", *options, "--out", tmp_path / "whole"))[0] == 0
    out = tmp_path / "out"
    process = start("biaxial.py", *options, "--out", out)
    wait_for(lambda: any(rows(path) > 30 for path in out.glob("tests/*/series.csv")), process)
    process.send_signal(signal.SIGINT)
    status, _, lines = ended(process)
    assert status == 130 and re.fullmatch(
        r"stopped: [01] of 2 runs have ended and are kept, others have their checkpoint; go on with --resume", lines[-2]
    ), lines
    assert list(out.glob("tests/*/checkpoint/checkpoint.json")) and not (out / "summary.json").exists()
    assert ended(start("biaxial.py", *options, "--out", out, "--resume"))[0] == 0
    for path in (tmp_path / "whole").glob("tests/*/series.csv"):
        assert (out / path.relative_to(tmp_path / "whole")).read_bytes() == path.read_bytes()


def test_ctrl_c_stays_ignored_where_it_was():
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with interrupts.noted() as came:
            os.kill(os.getpid(), signal.SIGINT)
            assert not came()
    finally:
        signal.signal(signal.SIGINT, before)


@pytest.fixture
def heard():
    """Ctrl-C is heard, also in tests that run in the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_a_note_of_ctrl_c_is_never_lost(heard):
    with pytest.raises(KeyboardInterrupt), interrupts.noted() as came:
        assert not came()
        os.kill(os.getpid(), signal.SIGINT)
        assert came()
    with pytest.raises(KeyboardInterrupt), interrupts.noted() as came:
        os.kill(os.getpid(), signal.SIGINT)
        os.kill(os.getpid(), signal.SIGINT)
        raise AssertionError("the second ends the block at once")
    with pytest.raises(KeyboardInterrupt):  # and afterwards everything is as it was
        os.kill(os.getpid(), signal.SIGINT)
        time.sleep(1)


def test_ctrl_c_that_comes_while_an_object_ends_is_not_lost(heard):
    """Python tells an exception of ``__del__`` and forgets it: a command would go on to its end."""

    class Ends:
        def __del__(self):
            os.kill(os.getpid(), signal.SIGINT)
            for _ in range(10):
                pass

    def main():
        Ends()
        time.sleep(20)
        raise AssertionError("it was lost")

    with pytest.raises(SystemExit) as end:
        commands.run(main)
    assert end.value.code == 130


def test_what_else_is_lost_while_an_object_ends_is_told(monkeypatch):
    class Ends:
        def __del__(self):
            raise ValueError("beside the point")

    told = []
    monkeypatch.setattr(sys, "unraisablehook", lambda lost: told.append(str(lost.exc_value)))
    with interrupts.never_lost():
        Ends()
    Ends()
    assert told == ["beside the point"] * 2


def test_a_killed_command_leaves_no_run_behind(tmp_path):
    process = start("column.py", "--disks", 2000, "--aspect", "3", "--threads", 1, "--out", tmp_path)

    def workers():
        found = []
        for path in Path("/proc").glob("[0-9]*/stat"):
            try:
                fields = path.read_text().rsplit(")", 1)[1].split()
                if (
                    fields[1] == str(process.pid)
                    and fields[0] != "Z"
                    and b"_process_worker" in path.with_name("cmdline").read_bytes()
                ):
                    found.append(int(path.parent.name))
            except OSError:
                pass
        return found

    log = tmp_path / "runs" / "a3-seed1" / "log.txt"
    wait_for(lambda: workers() and log.exists() and "Running script" in log.read_text(), process)
    time.sleep(1.0)  # until it has told the system what it wants; it does so first
    (worker,) = workers()
    process.kill()
    process.wait()
    for _ in range(600):  # at most a minute, on a busy machine
        stat = Path(f"/proc/{worker}/stat")
        if not stat.exists() or stat.read_text().rsplit(")", 1)[1].split()[0] == "Z":
            break
        time.sleep(0.1)
    else:
        os.kill(worker, signal.SIGKILL)
        pytest.fail("the run goes on without its command")


@pytest.mark.parametrize("seconds", [0.0, 0.2, 0.5, 0.8])
def test_ctrl_c_that_comes_while_a_process_begins_is_heard(heard, tmp_path, monkeypatch, seconds):
    """YADE forgets one that comes while it starts, and the run would go to its end."""
    monkeypatch.setattr(processes, "_halted", False)
    with ThreadPoolExecutor(1) as pool:
        call = pool.submit(
            processes.call,
            "judges.verification.packings:shear",
            tmp_path,
            dict(count=1000, seed=1, inertia=1e-4, strain=1.0, step=0.1),
        )
        while not processes._running:
            time.sleep(0.01)
        time.sleep(seconds)
        processes._halt()
        with pytest.raises(processes.RunError, match="the run ended with status 130 and no result: stopped: "):
            call.result()


def test_a_request_is_refused_once_a_command_is_stopped(tmp_path, monkeypatch):
    monkeypatch.setattr(processes, "_halted", True)
    with pytest.raises(processes.RunError, match="stopped before it began"):
        processes.call(side_by_side.run, tmp_path, {})
