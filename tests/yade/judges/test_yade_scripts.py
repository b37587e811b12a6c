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
    "fails.py": (RUNS + "if O.dt > 1e-3:\n    raise ValueError('wrong')\n", "fails", "wrong"),
}


@pytest.fixture
def sources(tmp_path):
    folder = tmp_path / "sources" / "examples"
    folder.mkdir(parents=True)
    for name, (text, _, _) in SOURCES.items():
        (folder / name).write_text(text)
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
