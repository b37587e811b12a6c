"""The script of seepage that the documentation prints, in a plain Python."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]


@pytest.mark.skipif(shutil.which("gmsh") is None, reason="Gmsh is not there (apt install gmsh)")
def test_a_lake_that_is_drawn_down(tmp_path):
    (tmp_path / "py").symlink_to(ROOT / "py")
    script = ROOT / "doc" / "examples" / "seepage.py"
    done = subprocess.run(["/usr/bin/python3", str(script)], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0 and done.stderr == "", done.stderr
    told = re.findall(r"^lake +(\d+) m: ([\d.e-]+) m2/s, water leaves up to ([\d.]+) m$", done.stdout, re.M)
    lakes, flows, ends = ([float(v) for v in column] for column in zip(*told))
    assert lakes == [14, 8, 3] and 2e-6 < min(flows) < max(flows) < 3.5e-6
    assert all(0 <= end - lake < 2 for lake, end in zip(lakes, ends)) and ends[2] > 4  # a seepage face
    assert sorted(p.name for p in (tmp_path / "out" / "seepage").iterdir()) == [
        "field.h5",
        "pressures.png",
        "seepage.png",
    ]
