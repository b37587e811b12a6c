"""Folders of a run that something has damaged: a resume says so in one line, or it goes on from what was saved. It
never goes on from anything else.

NONSMOOTH_FUZZ_CHECKPOINTS: how many damaged folders (default 100).
"""

import json
import math
import os
import shutil
from dataclasses import asdict
from pathlib import Path

import pytest
import shell
import slope_scenes
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from yade import O
from yade.nonsmooth import errors, experiment, section
from yade.nonsmooth.records import checkpoints
from yade.nonsmooth.system import whole_files

EXAMPLES = int(os.environ.get("NONSMOOTH_FUZZ_CHECKPOINTS", "100"))
DISKS = 200


def make(source, out, end):
    done = shell.run(
        "yade-nonsmooth",
        Path(__file__).resolve().parents[2] / "killed_run.py",
        source,
        DISKS,
        out,
        end,
        0,
        "--threads",
        1,
        limit=300,
    )
    assert done.returncode == 0, done.stderr
    return {path.relative_to(out).as_posix(): path.read_bytes() for path in sorted(out.rglob("*")) if path.is_file()}


class Saved:
    """A run's folder as {name: bytes}, what it was saved as, and the folders of an earlier checkpoint of it and of a
    run with other stages.
    """

    def __init__(self, home):
        source = slope_scenes.write_quick(home)
        self.section = section.load(str(source)).with_disks(DISKS)
        self.files, self.earlier = make(source, home / "late", "2.3"), make(source, home / "early", "1.9")
        source.write_text(source.read_text().replace("dry: 0.5", "dry: 0.3"))
        self.other = make(source, home / "other", "2.1")
        self.told = json.loads(self.files["checkpoint/checkpoint.json"])
        self.scene = f"checkpoint/{self.told['scene']}"
        self.series = self.files["series.csv"]

    @property
    def read(self):
        """Files that a resume reads."""
        return ["checkpoint/checkpoint.json", self.scene, "series.csv", "walls.csv"]


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    return Saved(tmp_path_factory.mktemp("saved"))


VALUES = [
    None,
    True,
    -1,
    0,
    2,
    10**30,
    1e308,
    math.nan,
    math.inf,
    "",
    "x",
    "../../series.csv",
    "scene-00000000-00000000.yade",
    [],
    [0],
    {},
    {"a": 1},
    "9" * 5000,
]


def flip(draw, files, saved):
    """One bit of a file that a resume reads."""
    name = draw(st.sampled_from(saved.read))
    content = bytearray(files[name])
    if content:
        content[draw(st.integers(0, len(content) - 1))] ^= 1 << draw(st.integers(0, 7))
    files[name] = bytes(content)


def cut(draw, files, saved):
    name = draw(st.sampled_from(saved.read))
    files[name] = files[name][: draw(st.integers(0, max(0, len(files[name]) - 1)))]


def splice(draw, files, saved):
    """Other bytes in the place of some."""
    name = draw(st.sampled_from(saved.read))
    place = draw(st.integers(0, len(files[name])))
    files[name] = files[name][:place] + draw(st.binary(max_size=40)) + files[name][place + draw(st.integers(0, 40)) :]


def lose(draw, files, saved):
    del files[draw(st.sampled_from(saved.read))]


def swap(draw, files, saved):
    """A file of an earlier checkpoint, or of another run."""
    source, name = draw(st.sampled_from([saved.earlier, saved.other])), draw(st.sampled_from(saved.read))
    files[name] = next(
        content
        for path, content in source.items()
        if path == name or name == saved.scene and path.startswith("checkpoint/scene-")
    )


def move(draw, files, saved):
    """The whole checkpoint of an earlier time, or of another run, beside this series."""
    for name in [n for n in files if n.startswith("checkpoint/")]:
        del files[name]
    files |= {
        n: c for n, c in draw(st.sampled_from([saved.earlier, saved.other])).items() if n.startswith("checkpoint/")
    }


def edit(draw, files, saved):
    """A value somewhere in checkpoint.json is another, or is gone."""
    told = json.loads(json.dumps(saved.told))
    place = told
    while True:
        key = draw(st.sampled_from(sorted(place) if isinstance(place, dict) else range(len(place))))
        if isinstance(place[key], (dict, list)) and place[key] and draw(st.booleans()):
            place = place[key]
            continue
        if draw(st.booleans()):
            place[key] = draw(st.sampled_from(VALUES))
        else:
            del place[key]
        break
    files["checkpoint/checkpoint.json"] = json.dumps(told).encode()


def rewrite(draw, files, saved):
    files["checkpoint/checkpoint.json"] = draw(
        st.sampled_from(
            [
                b"",
                b"null",
                b"[]",
                b"1",
                b'"x"',
                b"{}",
                b"NaN",
                b"[" * 100_000,
                b"\xff\xfe",
                b'{"format": 2}',
                b'{"format": 1e999}',
                b'{"format": true, "scene": 1}',
                b'{"format": 1, "scene": "scene-00000200.yade", "size": 5, "step": 200, "key": "x"}',
                b'{"format": ' + b"9" * 10_000 + b"}",
            ]
        )
    )


def leave(draw, files, saved):
    """What a killed process leaves: half-written files beside whole ones."""
    for name in draw(
        st.lists(
            st.sampled_from(
                ["series.csv", "t0.npz", "snapshots/00000250.npz", "checkpoint/checkpoint.json", saved.scene]
            ),
            min_size=1,
        )
    ):
        path = Path(name)
        files[str(path.with_name(f".part-0123abcd-{path.name}"))] = b"half"


DAMAGES = (flip, cut, splice, lose, swap, move, edit, rewrite, leave)


@settings(
    max_examples=EXAMPLES, derandomize=True, database=None, deadline=None, suppress_health_check=list(HealthCheck)
)
@given(damages=st.lists(st.sampled_from(DAMAGES), min_size=1, max_size=2), data=st.data())
def test_a_damaged_folder_is_one_message_or_goes_on_from_what_was_saved(saved, tmp_path_factory, damages, data):
    files = dict(saved.files)
    for damage in damages:
        try:
            damage(data.draw, files, saved)
        except KeyError:  # what it was to damage is gone already
            pass
    check(saved, files, tmp_path_factory.getbasetemp() / "damaged")


def check(saved, files, folder):
    shutil.rmtree(folder, ignore_errors=True)
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
    O.reset()
    try:
        run = experiment.resume(saved.section, folder)
    except errors.UserError as refusal:
        told = str(refusal)
        assert str(folder) in told and "\n" not in told and ("--resume" in told or "--out" in told), told
        assert {n: (folder / n).read_bytes() for n in files} == files  # nothing is lost
        return told
    run.series.close()
    # an earlier checkpoint of the same run, with a series that holds its rows, is as good: the rows after it are
    # computed again
    told = next(t for t in (saved.told, json.loads(saved.earlier["checkpoint/checkpoint.json"])) if t["step"] == O.iter)
    assert asdict(run.state) == told["state"] and run.slope.walls == told["walls"] and run.slope.count == told["count"]
    assert (folder / "series.csv").read_bytes() == saved.series[: told["series"]["bytes"]]
    assert not list(folder.rglob(".part-*"))
    return ""


def test_an_undamaged_folder_goes_on(saved, tmp_path):
    assert check(saved, saved.files, tmp_path / "out") == ""


def test_every_byte_of_the_checkpoint_file_counts(saved, tmp_path):
    """All single flips of one bit of checkpoint.json: refused, or no other content."""
    path = tmp_path / "checkpoint" / "checkpoint.json"
    path.parent.mkdir()
    content = saved.files["checkpoint/checkpoint.json"]
    refused = 0
    for place in range(len(content)):
        path.write_bytes(content[:place] + bytes([content[place] ^ 1]) + content[place + 1 :])
        try:
            found = checkpoints._told(path, "again", "anew", errors.UserError)
        except errors.UserError:
            refused += 1
        else:  # another format is another version's, and refused for that
            assert found["format"] != saved.told["format"] or found == {
                k: v for k, v in saved.told.items() if k != "sum"
            }
    assert refused > 0.6 * len(content)  # white space may change


def test_a_scene_with_one_flipped_bit_is_not_loaded(saved, tmp_path):
    for place in (0, 100, len(saved.files[saved.scene]) // 2, len(saved.files[saved.scene]) - 1):
        content = bytearray(saved.files[saved.scene])
        content[place] ^= 1
        assert "does not match its checksum" in check(
            saved, {**saved.files, saved.scene: bytes(content)}, tmp_path / "out"
        )


def test_leftovers_of_a_killed_process_end_no_resume(saved, tmp_path):
    parts = {
        name: b"half"
        for name in (
            ".part-01-t0.npz",
            "snapshots/.part-01-00000250.npz",
            "checkpoint/.part-01-checkpoint.json",
            f"checkpoint/.part-02-{saved.told['scene']}",
        )
    }
    assert check(saved, {**saved.files, **parts}, tmp_path / "out") == ""


def test_records_beyond_the_checkpoint_go_at_a_resume(saved, tmp_path):
    """They are of times that the run has not reached yet; a stop before them would show them as its own."""
    files = {n: c for n, c in saved.files.items() if not n.startswith("checkpoint/")}
    # at 1.9 s: the water rises from 2.0 s
    files |= {n: c for n, c in saved.earlier.items() if n.startswith("checkpoint/")}
    assert "t0.npz" in files and "snapshots/00000200.npz" in files
    check(saved, files, tmp_path / "out")
    assert not (tmp_path / "out" / "t0.npz").exists() and not (tmp_path / "out" / "snapshots" / "00000200.npz").exists()


def test_a_fresh_run_takes_the_checkpoint_away_first(saved, tmp_path, monkeypatch):
    """Stopped at the first thing that it writes or removes after that: there is no checkpoint, and no old record for
    it.
    """
    folder = tmp_path / "out"
    check(saved, saved.files, folder)
    forgotten = []
    monkeypatch.setattr(experiment.run_files, "forget", lambda f: forgotten.append(checkpoints.exists(f)) or 1 / 0)
    with pytest.raises(ZeroDivisionError):
        experiment.Experiment(
            experiment.slope.find(saved.section, saved.told["walls"], saved.told["first_disk"], saved.told["count"]),
            folder,
            layers=[],
        )
    assert forgotten == [False] and (folder / "series.csv").read_bytes() != b""


def test_a_checkpoint_of_the_same_step_does_not_take_the_place_of_the_last(saved, tmp_path, monkeypatch):
    """Killed between its scene and its checkpoint.json, the earlier one must still be whole."""
    check(saved, saved.files, tmp_path / "out")
    key = experiment.run_key(saved.section)
    O.bodies[O.bodies[len(O.bodies) - 1].id].state.vel = (1, 2, 0)
    real = whole_files.write_atomically

    def killed(path, content):
        if path.name == "checkpoint.json":
            raise KeyboardInterrupt
        real(path, content)

    monkeypatch.setattr(whole_files, "write_atomically", killed)
    with pytest.raises(KeyboardInterrupt):
        checkpoints.write(tmp_path / "out", key, {"state": {}})
    monkeypatch.undo()
    assert checkpoints.read(tmp_path / "out", key, errors.UserError)["state"] == saved.told["state"]
