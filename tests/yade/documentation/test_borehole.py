"""doc/borehole.rst: its commands run as they are printed, and give what it says."""

import re
import shlex
import shutil

import pytest
import shell
from shell import ROOT

PAGE = (ROOT / "doc" / "borehole.rst").read_text()
COMMANDS = [shlex.split(line) for line in re.findall(r"^    ((?:python3|scripts/)\S* .*)$", PAGE, re.M)]
#: factor of a rigid slab, by the name of the section
SLAB = {"measured": 1.127, "storm": 0.824}


@pytest.fixture(scope="module")
def said(tmp_path_factory):
    """What each command prints, run one after the other in a folder that has the checkout's folders."""
    folder, told = tmp_path_factory.mktemp("borehole"), []
    for name in ("py", "doc", "scripts"):
        (folder / name).symlink_to(ROOT / name)
    for program, *arguments in COMMANDS:
        program = shutil.which("python3", path="/usr/bin") if program == "python3" else ROOT / program
        done = shell.run(program, *arguments, cwd=folder)
        assert done.returncode == 0, done.stderr
        told.append(done.stdout)
    return folder, told


def test_strengths_come_of_index_values(said):
    folder, (first, *_) = said
    for layer in ("siltstone", "weathered"):
        c, phi = re.search(rf"^{layer}: c = (\d+) kPa, phi = ([\d.]+) degrees$", first, re.M).groups()
        assert f"{c} kPa and {phi}°" in PAGE
    dip, phi = re.search(r"^bedding: dips ([\d.]+) degrees, phi = ([\d.]+) degrees", first, re.M).groups()
    assert f"{phi}° under" in PAGE and float(dip) == pytest.approx(22.3, abs=0.1)
    made = {p.name for p in (folder / "out" / "borehole").iterdir()}
    assert made >= {"dry.yaml", "measured.yaml", "storm.yaml", "section.png"}


def test_factors_are_those_of_the_page_and_near_a_rigid_slab_s(said):
    folder, (_, *searches) = said
    assert len(searches) == len(SLAB)
    for (name, slab), text in zip(SLAB.items(), searches):
        low, high = map(float, re.search(r"^found +[\d.]+ +([\d.]+) +([\d.]+)", text, re.M).groups())
        assert f"{low:.3f} to {high:.3f}" in PAGE
        assert high / low <= 1.0201 and 0.5 * (low + high) == pytest.approx(slab, rel=0.02)
        assert (folder / "out" / "borehole" / name / "runs" / "run" / "displacements.png").is_file()
