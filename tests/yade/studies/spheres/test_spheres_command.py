"""scripts/spheres.py: every option reaches the scene or its world, bad input is one line before anything is computed,
and a small study writes what its page says.
"""
import json
from dataclasses import fields

import pytest
from yade.nonsmooth import errors
from yade.nonsmooth.running import kept_runs
from yade.nonsmooth.studies.spheres import grains, study

SOFT = ("--world", "soft", "--stiffness", "2e7")
#: Of each parameter of a scene another value than its default, which all kinds take.
OTHER = {
    "diameter": 0.02, "size_spread": 1.3, "density": 2000, "friction": 0.4, "rolling_friction": 0.1, "twisting_friction": 0.02,
    "restitution": 0.2, "gravity": 5.0, "aspect": 1.1, "size": 6, "opening": 5, "length": 8, "filling": 0.2, "froude": 0.02,
    "turns": 0.3, "pressure": 2e5, "strain": 0.1, "inertia": 5e-4, "friction_share": 0.5,
}  # fmt: skip


class Asked(errors.UserError):
    """The command has asked its study; nothing is computed."""


@pytest.fixture
def asked(in_process, monkeypatch, tmp_path):
    """Calls the command and returns what it asked its study for: cases, folder, threads, resume, duration."""

    def call(*words):
        seen = []

        def run(*arguments):
            seen.append(arguments)
            raise Asked("asked")

        monkeypatch.setattr(study, "run", run)
        done = in_process("spheres.py", *words, "--out", tmp_path / "out")
        assert seen, done.err
        return seen[0]

    return call


@pytest.mark.parametrize("kind", study.KINDS)
def test_every_parameter_of_a_scene_is_an_option(asked, kind):
    for one in fields(study.KINDS[kind]):
        if one.name == "seed":
            continue
        ((scene, _),) = asked(kind, f"--{one.name.replace('_', '-')}", OTHER[one.name])[0].values()
        assert type(scene) is study.KINDS[kind] and getattr(scene, one.name) == OTHER[one.name], one.name
        assert scene != study.KINDS[kind]()


def test_options_of_the_worlds_and_of_the_study(asked):
    (one,) = asked("column", "--path", 0.2, "--tolerance", 1e-3, "--reach", 0.3)[0].values()
    assert one[1] == {"name": "hard", "path": 0.2, "tolerance": 1e-3, "reach": 0.3}
    assert grains.world_of(one[0], **one[1]).reach == 0.3 and grains.world_of(one[0]).reach == 0.12
    (one,) = asked("pile", *SOFT, "--damping", 0.1, "--step-share", 0.4)[0].values()
    assert one[1] == {"name": "soft", "stiffness": 2e7, "damping": 0.1, "step_share": 0.4}
    _, out, threads, resume, duration, _ = asked("drum", "--threads", 3, "--duration", 7, "--resume")
    assert (out.name, threads, resume, duration) == ("out", 3, True, 7.0)
    assert asked("drum")[3:5] == (False, None) and asked("triaxial", "--angle", 20)[3:5] == (False, None)


def test_all_combinations_of_values_and_seeds_are_run(asked):
    cases = asked("pile", "--friction", "0.2,0.4", "--rolling-friction", "0,0.1", "--seeds", 4, 5)[0]
    assert len(cases) == 8 and "friction0.4-rolling-friction0.1-seed5" in cases
    scene, _ = cases["friction0.2-rolling-friction0.1-seed4"]
    assert (scene.friction, scene.rolling_friction, scene.seed) == (0.2, 0.1, 4)


@pytest.mark.parametrize(
    "words, said",
    (
        ((), "the following arguments are required"),
        (("heap",), "invalid choice: 'heap'"),
        (("column", "--aspect", "1,1"), "give each number once"),
        (("column", "--aspect", "tall"), "'tall': give numbers, separated by commas"),
        (("column", "--aspect", "0"), "aspect 0.0: give height over radius of the column"),
        (("column", "--opening", "5"), "unrecognized arguments: --opening"),
        (("hopper", "--opening", "50"), "opening 50.0: give the opening's diameter"),
        (("hopper", "--friction", "30"), "30 is no coefficient of friction"),
        (("drum", "--filling", "0.9"), "filling 0.9: give the share"),
        (("pile", "--seeds", 1, 1), "--seeds: 1 1: give each once"),
        (("pile", "--stiffness", 1e7), "stiffness 10000000.0 with world 'hard'"),
        (("pile", "--world", "soft"), "stiffness None: the soft world needs Young's modulus"),
        (("pile", *SOFT, "--restitution", 0.5), "restitution 0.5 with soft contacts"),
        (("pile", "--path", 0), "--path: 0: it must be positive"),
        (("pile", "--diameter", "1e-300"), "diameter 1e-300: give a number from 1e-06 to 1000 m"),
        (("pile", "--world", "soft", "--stiffness", "1e300"), "stiffness 1e+300: give a number above 0, to 1e+15"),
        (("column", "--path", "1e-9"), "path 1e-09: that is"),
        (("drum", "--size", 5, "--length", 3, "--filling", "0.1,0.5"), "size 5, length 3, filling 0.5: "),
        (("triaxial", "--duration", 3), "unrecognized arguments: --duration"),
        (("triaxial", "--gravity", 3), "unrecognized arguments: --gravity"),
        (("triaxial", "--inertia", 0.1), "inertia 0.1: give the inertial number"),
        (
            ("triaxial", *SOFT[:2], "--stiffness", 1e6),
            "stiffness 1e+06 Pa: spheres under 100000 Pa would overlap by 20 %",
        ),
    ),
)
def test_bad_input_is_one_line_before_anything_is_computed(in_process, tmp_path, words, said):
    out = tmp_path / "out"
    done = in_process("spheres.py", *words, *(("--out", out) if words else ()))
    assert done.status in (1, 2) and said in done.last and "Traceback" not in done.err
    assert not out.exists()


def test_another_study_does_not_take_the_place_of_halted_runs(in_process, tmp_path):
    folder = tmp_path / "runs" / "seed1"
    halted = study.planned("seed1", folder, study.KINDS["column"](size=3, aspect=0.6), {"name": "hard"})
    (folder / "checkpoint").mkdir(parents=True)
    (folder / "checkpoint" / "checkpoint.json").write_text("{}")
    kept_runs.begin(folder, halted.key, halted.function)
    words = ("column", "--size", 3, "--out", tmp_path)
    for more, said in (
        (("--aspect", 0.6), "holds a run that was halted, with its checkpoint"),
        (("--aspect", 0.7), "go on with it with --resume, or give another --out"),
        (
            ("--aspect", 0.7, "--resume"),
            "holds a run of other parameters that was halted; give the same ones, or another --out",
        ),
    ):
        done = in_process("spheres.py", *words, *more)
        assert done.status == 1 and said in done.last and str(folder) in done.last, done.err
    assert (folder / "checkpoint" / "checkpoint.json").read_text() == "{}"


def test_a_small_study_is_kept_and_drawn(in_process, tmp_path):
    words = ("column", "--size", 3, "--aspect", "0.6,1.2", "--threads", 1, "--out", tmp_path)
    done = in_process("spheres.py", *words)
    assert done.status == 0, done.err
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert set(summary["runs"]) == {"aspect0.6-seed1", "aspect1.2-seed1"} and len(summary["groups"]) == 2
    for name in summary["runs"]:
        assert {"series.csv", "snapshots", "course.png"} <= {p.name for p in (tmp_path / "runs" / name).iterdir()}
    assert (tmp_path / "column.png").stat().st_size > 10_000 and "run-out" in done.out
    # what has ended is kept, with its wall time
    again = in_process("spheres.py", *words, "--resume")
    assert again.status == 0
    other = json.loads((tmp_path / "summary.json").read_text())
    assert other["runs"] == summary["runs"]
