"""A slope that was killed while files were being written: a resume goes on with the same bits, draws what is whole, and
nothing half-written is left.
"""

import dataclasses

import leftovers
import pytest
import slope_scenes
from yade import O
from yade.nonsmooth import experiment, records, run_figures, section
from yade.nonsmooth.studies.slope import results, run_files

FILES = (
    "summary.json",
    "breaks.csv",
    "t0.npz",
    "end.npz",
    "forces.png",
    "avalanche.mp4",
    "snapshots/00000100.npz",
    "snapshots/00000200.npz",
    "snapshots/00000250.npz",
    "checkpoint/checkpoint.json",
    "checkpoint/scene-00000190-01234567.yade",
    "vtk/disks-00000100.vtu",
    "vtk/avalanche.pvd",
)


OF_CELLS = ("slip_surface.h5", "vtk/slip_surface-00000100.vtu", "vtk/slip_surface.pvd")


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    """A slope whose dry rest ends at 2 s."""
    yield section.load(str(slope_scenes.write_quick(tmp_path_factory.mktemp("section"), strong=True))).with_disks(150)
    O.reset()


def run(s, folder, end):
    O.reset()
    made = experiment.begin(s, folder)
    made.run(end=end)
    return made


def content(folder):
    """What a run has computed: its records, by name."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for pattern in ("*.csv", "*.npz", "snapshots/*")
        for path in sorted(folder.glob(pattern))
    }


def test_a_resume_goes_on_and_the_leftovers_go(small, tmp_path, monkeypatch):
    whole, broken = tmp_path / "whole", tmp_path / "broken"
    whole.mkdir()
    broken.mkdir()
    run(small, whole, 2.6)
    wanted = content(whole)
    assert {"series.csv", "breaks.csv", "t0.npz", "snapshots/00000250.npz"} <= set(wanted)
    run(small, broken, 1.9)
    leftovers.plant(broken, *FILES)
    O.reset()
    resumed = experiment.resume(small, broken)
    assert leftovers.found(broken) == []
    resumed.run(end=2.6)
    assert content(broken) == wanted
    # killed while the figures were made: they are made again, of whole snapshots alone
    leftovers.plant(broken, *FILES)
    shown = []
    monkeypatch.setattr(
        run_figures.video, "write_mp4", lambda files, *_, **__: (shown.extend(files), (None, "no video"))[1]
    )
    summary = results.summarise(broken, small, dataclasses.asdict(resumed.state))
    made, notes = run_figures.draw(broken, small, summary)
    # those half a second apart, 50 steps; between them are rows that may still become a characteristic time
    assert [path.name for path in shown] == [
        name.split("/")[1] for name in sorted(wanted) if name.startswith("snapshots/") and int(name[10:18]) % 50 == 0
    ] and notes == ["no video"]
    assert {"forces.png", "snapshots.png", "avalanche.pvd"} <= {path.name for path in made}
    O.reset()
    experiment.resume(small, broken).series.close()
    assert leftovers.found(broken) == []
    # and a fresh run takes them away too
    leftovers.plant(broken, *FILES)
    run(small, broken, 0.2)
    assert leftovers.found(broken) == [] and sorted(
        path.name for path in broken.rglob("*") if path.is_file()
    ) == sorted(
        [
            "breaks.csv",
            "checkpoint.json",
            "section.yaml",
            "series.csv",
            "walls.csv",
            "00000020.npz",  # its fastest row, which would be t4 if it failed dry
            *(path.name for path in broken.glob("checkpoint/scene-*")),
            *(path.name for path in broken.glob("vtk/*")),
        ]
    )


# ---- a folder in which no run has been ---------------------------------------------------------------
def put(folder, *names):
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text("mine")


USERS = (
    "energy.png",
    "deposit.png",
    "avalanche.mp4",
    "end.npz",
    "series.csv",
    "section.yaml",
    "slip_surface.h5",
    "vtk/mine.vtu",
    "snapshots/00000001.npz",
    "checkpoint/mine",
)


@pytest.mark.parametrize("name", USERS)
def test_a_file_that_no_run_has_left_is_neither_removed_nor_written_over(small, tmp_path, name):
    put(tmp_path, name)
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    told = name.removesuffix("/mine")
    assert run_files.foreign(tmp_path) == told
    O.reset()
    for begin in (lambda: experiment.begin(small, tmp_path), lambda: run(small, tmp_path, 0.1)):
        with pytest.raises(records.RecordsError, match=f"holds {told}, which no run has left there.*an empty folder"):
            begin()
    assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before


def test_files_of_a_user_beside_those_of_a_run_stay(small, tmp_path):
    """In the folder of a run its own files go; what has other names stays, also in the folders of snapshots and of
    ParaView's files.
    """
    run(small, tmp_path, 0.3)
    own = ("forces.png", "vtk/disks-00000100.vtu", "snapshots/00000001.npz", *OF_CELLS)
    put(tmp_path, *own)
    mine = ("mine.txt", "vtk/mine.vtu", "snapshots/best.npz", "snapshots/12345.npz")
    put(tmp_path, *mine)
    assert run_files.foreign(tmp_path) is None
    run(small, tmp_path, 0.1)
    assert all((tmp_path / name).exists() for name in mine)
    assert not any((tmp_path / name).exists() for name in own)


def test_a_run_that_was_killed_while_it_began_is_known(tmp_path):
    (tmp_path / "series.csv").write_bytes(b"")
    (tmp_path / "energy.png").write_bytes(b"old")
    assert run_files.foreign(tmp_path) is None
    (tmp_path / "series.csv").write_text("step,time_s,stage\n")
    assert run_files.foreign(tmp_path) is None
    (tmp_path / "series.csv").write_text("time,way\n")
    assert run_files.foreign(tmp_path) == "series.csv"
    (tmp_path / "key").write_text("")
    assert run_files.foreign(tmp_path) is None


def test_a_run_that_has_not_been_summarised_is_drawn(small, tmp_path):
    made = run(small, tmp_path, 0.3)
    assert not (tmp_path / "summary.json").exists()
    made.draw()
    assert (tmp_path / "summary.json").exists() and (tmp_path / "energy.png").exists()
    drawing = run_figures.Drawing(tmp_path, small, made.summarise())
    for name in ("foo", 3, None, "Forces"):
        with pytest.raises(records.RecordsError, match="^figure .*: give one of force_chains, forces"):
            drawing.figure(name, tmp_path / "foo.png")
    assert not (tmp_path / "foo.png").exists()
