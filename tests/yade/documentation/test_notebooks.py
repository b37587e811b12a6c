"""The documentation's notebooks: executed anew by a plain kernel, they say what they say in the documentation."""

import json
import shutil

import pytest
import shell
from shell import ROOT

NOTEBOOKS = ROOT / "doc" / "notebooks"
PYTHON = "/usr/bin/python3"


def cells(path):
    return [cell for cell in json.loads(path.read_text())["cells"] if cell["cell_type"] == "code"]


def said(path):
    """What each cell of code has printed or returned, without pictures; and how many pictures each has."""
    texts = [
        [
            "".join(out.get("text") or out["data"].get("text/plain", ""))
            for out in cell["outputs"]
            if "image/png" not in out.get("data", {})
        ]
        for cell in cells(path)
    ]
    return texts, [sum("image/png" in out.get("data", {}) for out in cell["outputs"]) for cell in cells(path)]


@pytest.mark.parametrize(
    "name, pictures", [("slope", 3), ("columns", 4), ("laboratory", 2), ("slip_surfaces", 5), ("exercises", 3)]
)
def test_a_notebook_says_what_stands_in_the_documentation(tmp_path, name, pictures):
    """Word for word: the runs have the same bits wherever the same engines run."""
    mine = shutil.copy(NOTEBOOKS / f"{name}.ipynb", tmp_path)
    content = json.loads((NOTEBOOKS / f"{name}.ipynb").read_text())
    for cell in content["cells"]:
        if cell["cell_type"] == "code":
            cell["outputs"] = []
    (tmp_path / f"{name}.ipynb").write_text(json.dumps(content))
    done = shell.run(
        PYTHON,
        "-m",
        "nbconvert",
        "--to",
        "notebook",
        "--execute",
        "--inplace",
        mine,
        cwd=tmp_path,
        PYTHONPATH=str(ROOT / "py"),
    )
    assert done.returncode == 0, done.stderr[-3000:]
    before, now = said(NOTEBOOKS / f"{name}.ipynb"), said(tmp_path / f"{name}.ipynb")
    assert now == before and sum(now[1]) == pictures
    assert not any(
        cell["outputs"] and any(out.get("name") == "stderr" for out in cell["outputs"])
        for cell in cells(tmp_path / f"{name}.ipynb")
    )
    if name == "exercises":  # the numbers of doc/exercises.rst, which come from it
        written = tmp_path / "out" / "exercises" / "exercises.json"
        assert json.loads(written.read_text()) == json.loads((ROOT / "doc" / "measured" / "exercises.json").read_text())


def test_the_documentation_has_all_of_them():
    page = (ROOT / "doc" / "notebooks.rst").read_text()
    assert all(f"notebooks/{path.stem}\n" in page for path in NOTEBOOKS.glob("*.ipynb"))
