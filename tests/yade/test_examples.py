"""The pair of example scripts: a soft YADE script and its Contact Dynamics twin."""
import os
import re
import subprocess

import pytest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
EXAMPLES = os.path.join(ROOT, "scripts", "examples")
TWINS = ("soft_pile.py", "hard_pile.py")


def source(name):
    with open(os.path.join(EXAMPLES, name)) as file:
        return file.read()


def blocks(text):
    return re.findall(r"^# \[ (.*?)\n(.*?)^# \]\n", text, re.M | re.S)


def test_twins_differ_between_the_marks_only():
    soft, hard = (source(name) for name in TWINS)
    outside = [re.sub(r"^(# \[ .*?\n).*?(^# \]\n)", r"\1\2", text, flags=re.M | re.S) for text in (soft, hard)]
    assert outside[0] == outside[1]
    assert [title for title, _ in blocks(soft)] == ["material", "functors, engines, time step"]
    assert [title for title, _ in blocks(soft)] == [title for title, _ in blocks(hard)]
    (_, material), (_, engines) = blocks(hard)
    # nothing but assignments to these three inside the marks
    assert re.findall(r"^(\S+) =", material + engines, re.M) == ["rock", "O.engines", "O.dt"]
    assert "ContactDynamicsEngine" in engines and "ContactDynamicsEngine" not in outside[1].replace("Contact Dynamics", "")
    assert "CundallStrack" in blocks(soft)[1][1]


def result(name):
    environment = {k: v for k, v in os.environ.items() if k != "OMP_NUM_THREADS"}
    environment["NONSMOOTH_BUILD"] = os.path.dirname(os.environ["YADE_PREFIX"])
    done = subprocess.run([os.path.join(EXAMPLES, name), "2.5", "--threads", "1"], env=environment, text=True, capture_output=True, timeout=600)
    assert done.returncode == 0, done.stderr
    found = {key: float(re.search(rf"^{re.escape(key)} (\S+)$", done.stdout, re.M).group(1))
             for key in ("steps", "pile height [m]", "kinetic energy [J]", "lowest disk [m]")}
    return found


def test_twins_make_the_same_pile():
    soft, hard = (result(name) for name in TWINS)
    # Two random packings of 204 disks: between loose (0.80) and dense (0.84) lie 5 %, seeds differ by about 1 %, and the soft
    # disks overlap by some 0.3 % of a diameter
    assert hard["pile height [m]"] == pytest.approx(soft["pile height [m]"], rel=0.03)
    area = 204 * 3.1416 * (0.05**2 + 0.02**2 / 12)  # of radii between 0.04 and 0.06
    for pile in (soft, hard):
        assert 0.75 < area / (1.5 * pile["pile height [m]"]) < 0.86
        assert pile["kinetic energy [J]"] < 0.05  # they rest: 4,000 kg that fell by some decimetres had 1e4 J
        assert 0.039 < pile["lowest disk [m]"] < 0.06  # on the floor, not in it
    assert hard["steps"] == soft["steps"] / 10
