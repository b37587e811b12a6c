"""The slope's command: same bits on any number of threads and after stops of all kinds, and bad input refused before
anything is lost.
"""

import json
import shutil

import pytest
import shell
from slope_scenes import SMALL
from yade import O
from yade.nonsmooth import records, run_figures

RECORDS = ("series.csv", "walls.csv", "breaks.csv", "t0.npz", "end.npz")
SLOPE = "jiufengershan.py"


def bytes_of(folder):
    return {name: (folder / name).read_bytes() for name in RECORDS} | {
        p.name: p.read_bytes() for p in (folder / "snapshots").iterdir()
    }


def test_another_number_of_threads_gives_the_same_bits(whole, tmp_path):
    """The command in a process of its own, on two threads where this one has one, else on one, against the run in this
    process.
    """
    threads = 2 if O.numThreads == 1 else 1
    done = shell.run(SLOPE, "--section", SMALL, "--out", tmp_path, "--threads", threads, "--no-figures")
    assert done.returncode == 0, done.stdout + done.stderr
    assert bytes_of(tmp_path) == bytes_of(whole.folder)
    told = json.loads((tmp_path / "summary.json").read_text())
    clocks = ("wall_s", "wall_packing_s", "threads")
    assert {k: v for k, v in told.items() if k not in clocks} == {
        k: v for k, v in whole.summary.items() if k not in clocks
    } and told["threads"] == threads
    for name in ("water_at_failure_m", "front_travel_m"):
        assert f"{name:28s} {told[name]:.4g}\n" in done.stdout
    assert (
        f"finished at {records.read_series(tmp_path / 'series.csv')['time_s'][-1]:.1f} s of simulated time"
        in done.stdout
    )
    assert (
        f"reached at {told['water_passive_m']:.1f} m of water" in done.stdout
        and f"failed at {told['water_at_failure_over_passive']:.2f} of that height" in done.stdout
    )
    assert not list(tmp_path.glob("*.png")) and not (tmp_path / "vtk").exists()


def test_figures_are_drawn_from_the_records(whole, tmp_path):
    made, notes = run_figures.draw(shutil.copytree(whole.folder, tmp_path / "out"), whole.section, whole.summary)
    assert {p.name for p in made} >= {
        "force_chains.png",
        "forces.png",
        "snapshots.png",
        "deposit.png",
        "energy.png",
        "solver.png",
    }
    assert all(p.stat().st_size > 1000 for p in made) and all("video" in note or "ffmpeg" in note for note in notes)


def test_an_early_end_and_a_resume_give_the_same_bits(whole, in_process, tmp_path):
    """Stopped while water acts, while the plane weakens and the table is held, while disks are released, and while it
    rests; each part goes on from a checkpoint.
    """
    s, state = whole.series, whole.state
    weakens = s["time_s"][(s["weakened_disks"] > 5) & (s["weakened_disks"] < 0.9 * s["weakened_disks"].max())][0]
    released = s["time_s"][s["released_disks"] > 0.5 * s["released_disks"].max()][0]
    stops = {
        "settles": 0.1,
        "wet": 0.5 * (state["t0"] + state["moving"]),
        "weakens": weakens,
        "released": released,
        "rests": state["resting_since"] + 0.1,
    }
    assert list(stops.values()) == sorted(stops.values())
    words = ("--section", SMALL, "--out", tmp_path, "--no-figures")
    for k, (name, end) in enumerate(stops.items()):
        done = in_process(SLOPE, *words, "--end", end, *(["--resume"] if k else []))
        assert done.status == 0 and "--resume" in done.out, done.err
        told = json.loads((tmp_path / "checkpoint" / "checkpoint.json").read_text())["state"]
        if name != "settles":
            assert (
                told["stage"] == "water"
                and (told["water_hold"] is not None) == (name != "wet")
                and (told["resting_since"] is not None) == (name == "rests")
            ), name
    assert s["wet_disks"][s["time_s"] < stops["wet"]][-1] > 20
    assert in_process(SLOPE, *words, "--resume").status == 0
    assert bytes_of(tmp_path) == bytes_of(whole.folder)
    again = in_process(SLOPE, *words, "--resume")  # it has ended: nothing is left to do
    assert again.status == 0 and bytes_of(tmp_path) == bytes_of(whole.folder)


def test_a_slope_that_stands_still_is_solved_more_tightly(in_process, tmp_path):
    """Some 1.06 s after the settling, with a table at rest; a rising one keeps the tolerance, see test_whole_slope."""
    done = in_process(SLOPE, "--section", SMALL, "--water", 0, "--end", 2.5, "--out", tmp_path, "--no-figures")
    assert done.status == 0, done.err
    s = records.read_series(tmp_path / "series.csv")
    settled = s["time_s"][s["stage"] == 0][-1]
    # looked at once a row, 0.02 s
    late, early = (s["time_s"] > settled + 1.06 + 0.04, s["time_s"] < settled + 1.06 - 0.02)
    assert (s["speed_mean_m_per_s"][s["stage"] == 2] < 0.04).all() and late.sum() > 10  # else it would count as moving
    assert set(s["tolerance"][late]) == {0.25e-4} and set(s["tolerance"][early]) == {1e-4}
    assert (s["water_m"] == 0).all() and (s["wet_disks"] == 0).all()


# ---- what is refused ------------------------------------------------------------------------------


@pytest.fixture
def refused(in_process):
    """The last line that the command says before it ends with status 1."""

    def call(*words):
        done = in_process(SLOPE, *words)
        assert done.status == 1 and "Traceback" not in done.err, done.err
        return done.last

    return call


@pytest.fixture
def settling(in_process, tmp_path):
    """The folder of a run that stopped while it settled."""
    assert in_process(SLOPE, "--section", SMALL, "--end", 0.1, "--out", tmp_path / "out").status == 0
    return tmp_path / "out"


def test_resume_without_a_checkpoint(refused, tmp_path):
    message = refused("--section", SMALL, "--out", tmp_path, "--resume")
    assert "checkpoint.json" in message and "without --resume" in message


def test_truncated_checkpoint_is_refused_and_nothing_is_lost(refused, settling):
    scene = next((settling / "checkpoint").glob("scene-*.yade"))
    scene.write_bytes(scene.read_bytes()[:1000])
    before = (settling / "series.csv").read_bytes()
    message = refused("--section", SMALL, "--out", settling, "--resume")
    assert scene.name in message and "truncated" in message
    assert (settling / "series.csv").read_bytes() == before


def test_checkpoint_of_another_section(refused, settling):
    for words in (("--disks", 250), ("--seed", 4), ("--water", 1)):
        assert "other settings" in refused("--section", SMALL, *words, "--out", settling, "--resume")


def test_unwritable_output(refused, tmp_path):
    blocker = tmp_path / "file"
    blocker.write_text("")
    message = refused("--section", SMALL, "--out", blocker / "out")
    assert "cannot be written" in message and "--out" in message


def test_unreadable_packing(refused, tmp_path):
    path = tmp_path / "packing.txt"
    path.write_text("1.0 2.0 0.5\n1.0 nan 0.5\n")
    message = refused("--packing", path, "--out", tmp_path / "out")
    assert "packing.txt" in message and "2" in message


def test_unknown_key_in_the_section(refused, tmp_path):
    path = tmp_path / "slope.yaml"
    path.write_text(SMALL.read_text().replace("gravity: 9.81", "gravity: 9.81\ncolour: red"))
    message = refused("--section", path, "--out", tmp_path / "out")
    assert "slope.yaml" in message and "colour" in message and not (tmp_path / "out").exists()
