"""The numbers of doc/lessons.rst: what is read from what a lesson prints, and that the lessons still print what the
page says.
"""
import json
import re

import numpy as np
import pytest
import shell
from yade.nonsmooth import lessons
from yade.nonsmooth.figures import film

MEASURED = json.loads((shell.ROOT / "doc" / "measured" / "lessons.json").read_text())
PRINTED = """disks 288, bonds 777
run-out, by the column's width 2.638
water at failure by statics [m] 2.232 (3 of 8 rows)
disks 321, column [m]: 1.000 wide, 2.074 high
friction/tan(slope)   slid [m]
              0.50    4.141
              1.10   -1e-03
  3.0 s: water  0.900 m, mean displacement    0.0012 m, bonds 770
load 0.240  deflection of the tip [mm] 1.5000
load 0.480  deflection of the tip [mm] 3.2500
creep after 5 s [mm/min] 0.370000
kinetic energy [J] 8.56e-06
the slab stands
steps 1250
"""


def test_numbers_are_read_from_what_a_lesson_prints():
    assert lessons.numbers(PRINTED) == {
        "disks": 321,
        "bonds": 777,
        "run_out_by_the_column_s_width": 2.638,
        "water_at_failure_by_statics_m": 2.232,
        "load": 0.48,
        "deflection_of_the_tip_mm": 3.25,
        "creep_after_5_s_mm_min": 0.37,
        "kinetic_energy_j": 8.56e-06,
        "steps": 1250,
        "rows": [[0.5, 4.141], [1.1, -1e-3], [3.0, 0.9, 0.0012, 770]],
    }


def test_numbers_in_rows_that_begin_with_a_word_are_read():
    """As the table of the lesson with the LawTester."""
    text = "pull          0.0            100.0000              100.0000  0.0200\nroll        100.0             25.0000               24.9999  it holds\nsteps 4501\n"
    assert lessons.numbers(text) == {"rows": [[0.0, 100.0, 100.0, 0.02], [100.0, 25.0, 24.9999]], "steps": 4501}


def test_a_single_number_behind_a_gap_is_no_row():
    assert lessons.numbers("final height [m]   1.25\n") == {"final_height_m": 1.25}


def test_all_pairs_of_scripts_are_lessons_of_the_command():
    from yade.nonsmooth import campaign

    assert set(lessons.CASES) == set(campaign.lessons())
    assert all({"hard", "soft"} <= set(cases) for cases in lessons.CASES.values())


def test_a_lesson_that_is_run_alone_leaves_the_numbers_of_others(in_process, monkeypatch, tmp_path):
    path = tmp_path / "lessons.json"
    monkeypatch.setattr(lessons, "run", lambda chosen, *_: {name: {"hard": {"steps": 2.0}} for name in chosen})
    path.write_text(json.dumps({"drum": {"hard": {"steps": 1.0}}, "seesaw": {}, "pile": {"hard": {"steps": 1.0}}}))
    for words in (("pile", "incline"), ("pile", "incline", "--resume")):
        done = in_process("lessons.py", *words, "--out", tmp_path)
        assert done.status == 0, done.err
        found = json.loads(path.read_text())
        # in the order of the command; what is no lesson any more goes
        assert list(found) == ["incline", "pile", "drum"]
        assert [found[name]["hard"]["steps"] for name in found] == [2, 2, 1]
    assert in_process("lessons.py", "--out", tmp_path).status == 0
    assert list(json.loads(path.read_text())) == list(lessons.CASES)
    path.write_text("[1]")
    done = in_process("lessons.py", "pile", "--out", tmp_path)
    assert (
        done.status == 1
        and "lessons.json: cannot be read as the numbers of lessons" in done.last
        and path.read_text() == "[1]"
    )


def test_seeds_become_a_mean_with_its_interval():
    found = lessons.collect([dict(steps=1.0, rows=[[1.0]]), dict(steps=3.0, rows=[])])
    # of two values: Student's t of one degree of freedom, 12.706, by half of their distance
    assert found == {"steps": dict(mean=2.0, half_width=pytest.approx(12.706, rel=1e-4), values=[1.0, 3.0])}
    assert lessons.collect([dict(steps=1.0)]) == dict(steps=1.0)


def test_the_file_has_all_cases_and_the_page_reads_them():
    assert {name: set(cases) for name, cases in MEASURED.items()} == {
        name: set(cases) for name, cases in lessons.CASES.items()
    }
    page = (shell.ROOT / "doc" / "lessons.rst").read_text()
    told = set(re.findall(r":measured:`lessons (\w+)\.(\w+)\.", page))
    assert len(told) > 12 and all(case in MEASURED[name] for name, case in told)
    # no mean of runs is typed
    assert not re.search(r"\d\.\d+ ± ", page)


def test_a_lesson_that_is_not_there_is_refused_before_anything_is_run(in_process, tmp_path):
    done = in_process("lessons.py", "incline", "seesaw", "--out", tmp_path / "out")
    assert done.status == 1 and "lesson 'seesaw': there is none of this name; give some of incline, pile" in done.last
    assert not (tmp_path / "out").exists()


def test_the_command_runs_a_lesson_and_keeps_its_numbers(tmp_path):
    done = shell.run("lessons.py", "incline", "--out", tmp_path, "--threads", 1, "--no-films", limit=300)
    assert done.returncode == 0, done.stderr
    found = json.loads((tmp_path / "lessons.json").read_text())
    assert list(found) == ["incline"] and set(found["incline"]) == set(MEASURED["incline"])
    for case, values in found["incline"].items():
        # six blocks that touch nothing but their inclines: the digits printed
        assert values["steps"] == MEASURED["incline"][case]["steps"]
        assert np.array(values["rows"]) == pytest.approx(np.array(MEASURED["incline"][case]["rows"]), abs=1e-3)
    # g (sin θ − μ cos θ) at 25°
    for ratio, _, _, acceleration, _ in found["incline"]["hard"]["rows"]:
        assert acceleration == pytest.approx(9.81 * np.sin(np.radians(25)) * max(0, 1 - ratio), abs=2e-4)
    assert "incline  soft_undamped   steps 10000" in done.stdout and not list(tmp_path.rglob("film.mp4"))


def test_a_lessons_video_stands_beside_what_it_printed(tmp_path):
    """Called as the command calls it, in this process."""
    import sys

    from yade import O

    names, before = vars(sys.modules["__main__"]), dict(vars(sys.modules["__main__"]))
    O.reset()
    try:
        found = lessons.one(tmp_path, "incline", "hard", dict(seconds=0.2), seconds=1.0)
    finally:
        names.clear()
        names.update(before)
        O.reset()
    assert found["steps"] == 40 and len(found["rows"]) == 6
    assert "steps 40" in (tmp_path / "output.txt").read_text()
    assert (tmp_path / "film.mp4").exists() == (film.missing() is None)


def test_every_picture_of_the_pages_is_there_and_panels_come_in_order(monkeypatch):
    import sys

    pytest.importorskip("docutils")
    monkeypatch.syspath_prepend(str(shell.ROOT / "doc" / "ext"))
    import pictures

    monkeypatch.delitem(sys.modules, "pictures")
    pages = "\n".join(path.read_text() for path in (shell.ROOT / "doc").rglob("*.rst"))
    named = re.findall(r"\.\. picture:: (\S+)", pages)
    assert len(named) > 40 and not [name for name in named if not pictures.files(name)]
    assert [path.name for path in pictures.files("recipes.png")] == [f"recipes-{k}.png" for k in (1, 2, 3, 4)]
    assert [path.name for path in pictures.files("wedge.png")] == ["wedge.png"] and pictures.files("none.png") == []
    # all that lies there is on a page
    shown = {path.name for name in named for path in pictures.files(name)}
    kept = {path.name for path in (shell.ROOT / "doc" / "figures").glob("*.png")}
    assert kept - shown <= {"falling_block.png"}  # of the README
    assert pictures.shape(shell.ROOT / "doc" / "figures" / "lesson_beam-1.png") > 2 > pictures.WIDE
