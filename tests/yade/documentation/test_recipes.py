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


def test_a_shaken_slope_slides_as_newmarks_block(tmp_path, monkeypatch):
    """doc/section_limits.rst: a block on a plane of the dip β slides while the ground pushes it by more than g tan(φ −
    β), and then gains a (cos β + μ sin β) − g (μ cos β − sin β).
    """
    monkeypatch.chdir(tmp_path)
    text = said("shaken_slope.py")
    g, mu, push, beta = 9.81, 0.7, 3.0, math.atan2(26.3, 62)
    driving, holding = push * (math.cos(beta) + mu * math.sin(beta)), g * (mu * math.cos(beta) - math.sin(beta))
    begin = math.asin(holding / driving)
    speed = (2 * driving * math.cos(begin) - holding * (math.pi - 2 * begin)) / (2 * math.pi)  # a period of 1 s
    # the hill is bonded, and not a block: its crown is thin, and its toe leans on the valley
    assert numbers(text, "shaken: largest mean speed [m/s]")[0] == pytest.approx(speed, rel=0.05)
    for when in ("before", "after"):
        assert numbers(text, f"{when}: largest mean speed [m/s]")[0] < 0.01 * speed
