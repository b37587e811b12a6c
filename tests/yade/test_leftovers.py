"""A slope that was killed while files were being written: a resume goes on with the same bits, draws what is whole, and nothing half-written is left."""

import dataclasses

import leftovers
import pytest
import slope_scenes
from yade import O
from yade.nonsmooth import experiment, results, run_figures, section, slope, slope_packing

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


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    """A slope whose dry rest ends at 2 s."""
    yield section.load(str(slope_scenes.write_quick(tmp_path_factory.mktemp("section"), strong=True))).with_disks(150)
    O.reset()


def run(s, folder, end):
    O.reset()
    made = experiment.Experiment(slope.build(s, slope_packing.of(s)), folder)
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
