"""doc/recipes.rst: the scripts run, and give what physics asks for."""
import contextlib
import io
import math
import os
import re
import sys

import pytest
from shell import ROOT
from yade import O

pytestmark = pytest.mark.usefixtures("empty")


def said(name):
    """What a recipe prints."""
    path, names, out = os.path.join(ROOT, "doc", "examples", name), vars(sys.modules["__main__"]), io.StringIO()
    with open(path) as file:
        text = file.read()
    before = dict(names)
    try:
        with contextlib.redirect_stdout(out):
            exec(compile(text, path, "exec"), names)
    finally:
        names.clear()
        names.update(before)
    return out.getvalue()


def numbers(text, line):
    """The numbers of the line that begins with these words."""
    (found,) = [one for one in text.splitlines() if one.startswith(line)]
    return [float(n) for n in re.findall(r"-?\d+(?:\.\d+)?(?:e[-+]\d+)?", found[len(line) :])]


def test_a_conveyor_carries_disks_at_its_speed():
    text = said("conveyor.py")
    slowest, fastest = numbers(text, "speed on the belt [m/s]")
    # friction takes them to 2 m/s in less than 2 m, rolling friction of 0.05 ends what rolls: two thirds of g 2·0.05 in
    # 2 s; joints of the belt cost nothing
    assert slowest == pytest.approx(2, abs=1e-3) and fastest == pytest.approx(2, abs=1e-3)
    fed, gone = numbers(text, "disks fed")
    assert (
        fed == 19 and 7 <= gone <= 9
    )  # two a second; 9 m at 2 m/s, with some 2 s in which it still rolls backwards on the belt, are 6 s


def test_as_many_disks_go_as_come():
    text = said("feeding.py")
    fed, there, erased = numbers(text, "fed")
    assert fed == 990 and there + erased == fed
    _, _, rate = numbers(text, "a second: fed")
    # the outlet lets through more than is fed (Beverloo: some 0.6 m √(g 0.6 m) and disks of 0.004 m²), so the flow is
    # what comes
    assert rate == pytest.approx(100, abs=4)  # ten at a time: two feeds more or less in 5 s
    assert numbers(text, "deepest overlap")[0] < 0.02


def test_a_boulder_tumbles_and_holds():
    text = said("boulder.py")
    made, broken = numbers(text, "bonds made")
    assert (made, broken) == (90, 0)  # 37 disks in a hexagon touch at 90 places
    turns, speed, way = numbers(text, "turns")[0], *numbers(text, "turns")[-2:]
    assert turns > 3 and speed > 5 and way > 30
    assert abs(numbers(text, "error of the energy")[-1]) < 1e-3


def test_a_gas_has_the_pressure_of_its_energy():
    text = said("gas.py")
    measured, expected = numbers(text, "pressure [N/m]")
    # 20,000 impacts on the walls within 15 s scatter by 1 %, the equation of state is right to less
    assert measured == pytest.approx(expected, rel=0.03)
    kurtosis = numbers(text, "kurtosis")[0]
    assert kurtosis == pytest.approx(3, abs=0.5)  # 648 components: ± 0.2
