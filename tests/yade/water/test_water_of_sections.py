"""What a drawdown does to a long slope, by the forces on disks and the closed forms of every book-keeping. Needs no
YADE.
"""

import math
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "py"))
from nonsmooth import section  # noqa: E402
from nonsmooth.water import forces, of_section  # noqa: E402

DIP, THICK, PHI = 21.0, 10.0, 0.84
BETA = math.radians(DIP)


def at(s, h):
    """The place [m] s up the plane and h above it."""
    return [-s * math.cos(BETA) + h * math.sin(BETA), s * math.sin(BETA) + h * math.cos(BETA)]


def long_slope(density, **water):
    """A layer on a plane, under a reservoir; in a second state with water up to its surface."""
    base, surface = ([[x, -x * math.tan(BETA) + up / math.cos(BETA)] for x in (-190.0, 0.0)] for up in (0.0, THICK))
    lines = [
        {"time": 0.0, "points": [[-210.0, 120.0], [40.0, 120.0]]},
        {"time": 5.0, "points": surface},
    ]
    water["phreatic"] = {"lines": lines, **water.get("phreatic", {})}
    rock = {"friction": 0.5, "rolling_friction": 0.1, "bonded": False, "density": density}
    plane = {"friction": 0.5, "rolling_friction": 0.1, "bonded": False}
    return section.of(
        name="long",
        walls=[{"name": "plane", "material": "plane", "role": "slip", "vertices": [at(215, 0), at(-15, 0)]}],
        layers=[{"name": "rock", "material": "rock", "vertices": [*base, *surface[::-1]]}],
        materials={"rock": rock, "plane": plane},
        disks={"diameter": [0.5, 1.0], "packing_fraction": PHI},
        water=water,
    )


def factor(made, time):
    """Of safety of disks within the layer, by tan φ: normal over shear force on the plane."""
    rng = np.random.default_rng(7)
    x, y = np.array([at(s, h) for s, h in zip(rng.uniform(40, 160, 300), rng.uniform(0.2, THICK - 0.2, 300))]).T
    r = rng.uniform(0.25, 0.5, 300)
    share = {"packing_fraction": made.disks.packing_fraction} if made.water.volume == "bulk" else {}
    force = forces.on_disks(of_section.field(made), x, y, r, time, area=made.water.volume, **share)
    force[:, 1] -= made.materials["rock"].density * made.gravity * math.pi * r**2
    total = force.sum(axis=0)
    return -(total @ made.normal) / (total @ made.downslope)


#: weight of the bulk, book-keeping, and the factor of safety after a drawdown by that before it
CASES = {
    "N' stays": (2260 / PHI, {"volume": "bulk", "phreatic": {"flow": "along"}}, 1 - 1000 / 2260, 0.5575),
    "Morgenstern's B = 1": (2260 / PHI, {"volume": "bulk"}, 1 - 1000 / 2260 / math.cos(BETA) ** 2, 0.492),
    "the paper's bulk": (2500.0, {"volume": "bulk", "phreatic": {"flow": "along"}}, 1 - 1000 / 2100, 0.524),
    "volumes of disks": (2500.0, {"volume": "disk", "phreatic": {"flow": "along"}}, 1 - 1000 / 2500, 0.600),
}


@pytest.mark.parametrize("case", CASES)
def test_a_drawdown_leaves_the_share_of_safety_of_its_book_keeping(case):
    density, water, closed, printed = CASES[case]
    made = long_slope(density, **water)
    before, after = factor(made, 0.0), factor(made, 5.0)
    assert before == pytest.approx(1 / math.tan(BETA), rel=1e-10)  # under water as dry
    if "flow" in water.get("phreatic", {}):
        assert after / before == pytest.approx(closed, rel=1e-10)
    else:  # water that flows sideways pulls along the slope too
        weight, lift = density * PHI * 9.81, 9810.0
        push = lift * math.tan(BETA) * np.array([math.cos(BETA), math.sin(BETA)])  # of −∇p's horizontal part
        normal = weight * math.cos(BETA) - lift * math.cos(BETA) - push[1]
        shear = weight * math.sin(BETA) - lift * math.sin(BETA) + push[0]
        assert after == pytest.approx(normal / shear, rel=1e-10)
        # N' is that of the pressure γ_w z on the plane
        assert normal / (weight * math.cos(BETA)) == pytest.approx(closed, rel=1e-10)
    assert closed == pytest.approx(printed, abs=5e-4)
