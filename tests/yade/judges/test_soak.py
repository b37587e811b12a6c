"""The soak: a short one runs and writes its result, and what grows is noticed."""
import json
import math

import pytest
import shell
from yade import O
from yade.nonsmooth.judges.verification import soak


def command(*arguments):
    return shell.run("soak.py", *arguments, limit=300)


@pytest.mark.parametrize("kind, volume", [("disks", math.pi / 4), ("spheres", math.pi / 6)])
def test_a_short_soak(tmp_path, kind, volume):
    done = command("--steps", 2000, f"--{kind}", 60, "--threads", 1, "--out", tmp_path / "soak.json")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "too few turns to judge by: 3 take 60000 steps" in done.stdout
    found = json.loads((tmp_path / "soak.json").read_text())
    rows = found["rows"]
    assert [row["step"] for row in rows] == list(range(50, 2001, 50)) and found["grew"] is None
    assert all(row["inside"] == 60 for row in rows)
    assert rows[-1]["turns"] == pytest.approx(0.1, rel=1e-9)
    # they have fallen and lie: by potential energy of order m g R, of which the balance, first order in the step,
    # misses a few thousandths at most
    fallen = 60 * 2500 * volume * 9.81 * (0.8 if kind == "disks" else 0.4)  # of their mass, by at least that [m]
    assert rows[-1]["dissipated_J"] > fallen and abs(rows[-1]["energy_error_rel"]) < 3e-3
    assert 0 < rows[-1]["overlap_worst_rel"] < 0.01
    other = command(
        "--steps", 2000, f"--{kind}", 60, "--threads", 1, "--way", "step", "--out", tmp_path / "stepped.json"
    )
    assert other.returncode == 0, other.stdout + other.stderr
    stepped = json.loads((tmp_path / "stepped.json").read_text())["rows"]
    assert len({row["bits"] for row in rows}) == len(rows)

    def forget(row):
        return {key: value for key, value in row.items() if key != "memory_MB"}

    assert [forget(row) for row in stepped] == [forget(row) for row in rows]
    O.reset()


@pytest.mark.parametrize(
    "arguments, words",
    [
        (("--steps", 399), ("--steps 399", "400 or more")),
        (("--disks", 59), ("--disks 59", "60 or more")),
        (("--spheres", 59), ("--spheres 59", "60 or more")),
    ],
)
def test_a_soak_that_says_nothing_is_refused(arguments, words):
    done = command(*arguments)
    assert done.returncode == 2 and all(word in done.stderr for word in words), done.stderr


def rows_with(**growing):
    """Forty rows of a drum in which nothing grows, but for columns that grow to a multiple."""
    flat = dict(
        turns=10.0,
        overlap_worst_rel=5e-3,
        overlap_mean_rel=1e-4,
        kinetic_J=1e5,
        sweeps_mean=50.0,
        memory_MB=200.0,
        energy_error_rel=1e-3,
        inside=500,
    )
    return [
        {name: value * (1 + (growing.get(name, 1) - 1) * k / 39) for name, value in flat.items()} for k in range(40)
    ]


def test_what_grows_is_noticed():
    assert soak.judge(rows_with())["grew"] == []
    assert soak.judge(rows_with(kinetic_J=1.2))["grew"] == []  # as uneven as a flow is
    for name, times in (
        ("overlap_worst_rel", 20),
        ("overlap_mean_rel", 2),
        ("kinetic_J", 2),
        ("sweeps_mean", 2),
        ("memory_MB", 1.1),
        ("energy_error_rel", 3),
    ):
        grew = soak.judge(rows_with(**{name: times}))["grew"]
        assert len(grew) == 1 and grew[0].startswith(name), grew
    assert "grains left the drum: 500.0 were in it, and 499" in soak.judge(rows_with(inside=0.998))["grew"][0]
    few = [{**row, "turns": 2.9} for row in rows_with(memory_MB=9)]
    assert soak.judge(few)["grew"] is None  # no judgement, rather than a wrong one
