"""YADE's own scripts with rigid contacts: what becomes of one that runs, one that is refused, one that lacks something."""
import json

import pytest
import shell
from yade.nonsmooth.judges.yade_scripts import one, table

RUNS = """
O.bodies.append(facet([(-5, -5, 0), (5, -5, 0), (0, 5, 0)]))
O.bodies.append(sphere((0, 0, 0.6), 0.5))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [LAW()]),
    NewtonIntegrator(damping=0.3, gravity=(0, 0, -9.81)),
]
O.dt = 0.1 * PWaveTimeStep()
O.run(100000)
""".replace(
    "LAW", "Law2_ScGeom_FrictPhys_CundallStrack"
)
SOURCES = {
    "runs.py": (RUNS, "runs", ""),
    "refused.py": ("O.periodic = True\n" + RUNS, "refused", "the cell is periodic"),
    "lacks.py": ("import a_module_that_is_not_there\n" + RUNS, "lacks", "a_module_that_is_not_there"),
    "checks/sees.py": (RUNS + "raise YadeCheckError('the spring is not where it was')\n", "differs", "the spring"),
    "fails.py": (RUNS + "if O.dt > 1e-3:\n    raise ValueError('wrong')\n", "fails", "wrong"),
}


def numbers(**more):
    """What one.run finds of three spheres of 0.2 m that have fallen by a metre."""
    return {
        "simulated [s]": 1.0, "step [s]": 1e-3, "kinetic energy [J]": 5.0, "spheres": 3, "factories": 0, "mean diameter [m]": 0.2,
        "mean x [m]": 0.0, "mean y [m]": 0.0, "mean z [m]": 0.0, "spread [m]": 0.5, "way [m]": 1.0, "largest overlap [radii]": 0.0,
        "damping": 0.0, "gravity [m/s²]": 10.0,
    } | more  # fmt: skip


@pytest.mark.parametrize(
    "found, soft, apart, explained, said",
    (
        ({}, {}, 0, 0.1, ""),
        ({"mean x [m]": 0.012, "mean z [m]": 0.016}, {}, 0.1, 0.1, ""),  # 3-4-5: 0.02 m
        ({"mean z [m]": 0.06}, {}, 0.3, 0.1, "spheres lie 0.3 diameters apart"),
        ({"spread [m]": 0.53}, {}, 0.15, 0.1, "0.15 diameters"),
        ({"mean z [m]": 0.06}, {"largest overlap [radii]": 0.4}, 0.3, 0.3, ""),  # springs sink
        # with damping 0.01 a fall of one second lags by 0.05 m, a quarter of a diameter
        ({"mean z [m]": 0.06}, {"damping": 0.01}, 0.3, 0.35, ""),
        ({"mean z [m]": 0.06, "way [m]": 0.01}, {"damping": 0.01}, 0.3, 0.15, "0.3 diameters"),  # but what lies does not
        ({"spheres": 0}, {}, None, None, ""),
        ({"spheres": 4}, {}, None, None, ""),
        ({"factories": 1, "mean z [m]": 9.0}, {}, None, None, ""),
        # both ended at an event: energies
        ({"simulated [s]": 2.0}, {"kinetic energy [J]": 5.4}, None, None, ""),
        ({"simulated [s]": 2.0}, {"kinetic energy [J]": 6.0}, None, None, "ended after 2 s with 5 J, the soft one after 1 s with 6 J"),
        ({"simulated [s]": 1.3, "step [s]": 0.4}, {}, 0, 0.1, ""),  # less than a step
    ),
)  # fmt: skip
def test_what_of_a_difference_is_explained(found, soft, apart, explained, said):
    told = table.compared(numbers(**found), numbers(**soft))
    assert told[:2] == pytest.approx((apart, explained)) and said in told[2] and bool(said) == bool(told[2])
    assert table.compared(None, numbers()) == table.compared(numbers(), None) == (None, None, "")


@pytest.fixture
def sources(tmp_path):
    folder = tmp_path / "sources" / "examples"
    folder.mkdir(parents=True)
    (folder / "checks").mkdir()
    for name, (text, _, _) in SOURCES.items():
        (folder / name).write_text(text.replace("O.run(100000)", "O.run(100)") if "checks" in name else text)
    return folder.parent


@pytest.mark.parametrize("name", SOURCES)
def test_what_becomes_of_a_script(sources, name):
    _, outcome, message = SOURCES[name]
    found = one.run(f"examples/{name}", sources, steps=40)
    assert (found["outcome"], message in found["message"]) == (outcome, True), found
    if outcome == "runs":
        assert found["found"]["steps"] == 40 and found["found"]["largest overlap [radii]"] < one.MOST_OVERLAP


def test_the_lists_have_the_scripts_that_were_found():
    assert [len(table.names(kind)) for kind in ("plain", "periodic", "clumps")] == [76, 25, 29]


def test_the_command_writes_what_became_of_the_scripts_asked_for(sources, tmp_path):
    script = sources / "examples" / "test" / "facet-sphere.py"
    script.parent.mkdir()
    script.write_text(RUNS)
    out = tmp_path / "out"
    words = (
        "--kind",
        "plain",
        "--only",
        "test/facet-sphere.py",
        "--steps",
        30,
        "--soft",
        30,
        "--sources",
        sources,
        "--threads",
        1,
    )
    done = shell.run("yade_examples.py", *words, "--out", out)
    assert done.returncode == 0, done.stderr
    (row,) = json.loads((out / "yade_scripts.json").read_text())["scripts"]
    assert row["outcome"] == "runs" and row["found"]["steps"] == 30
    assert row["soft"]["simulated [s]"] == pytest.approx(row["found"]["simulated [s]"], rel=0.1)
    assert row["soft"]["steps"] > 30
