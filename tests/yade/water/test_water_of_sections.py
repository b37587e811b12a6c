"""What a drawdown does to a long slope, by the forces on disks and the closed forms of every book-keeping; seepage and
open water of sections. Needs no YADE.
"""

import math
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "py"))
from nonsmooth import section, similar  # noqa: E402
from nonsmooth.judges.verification.water import drawdown  # noqa: E402
from nonsmooth.judges.verification.water.drawdown import (
    BARE,
    BETA,
    FULL,
    at,
    factor,
    layer_on_a_plane,
    seeping,
)  # noqa: E402
from nonsmooth.water import WaterError, of_section, section_seepage  # noqa: E402


@pytest.mark.parametrize("case", drawdown.BOOKS)
def test_a_drawdown_leaves_the_share_of_safety_of_its_book_keeping(case):
    density, water, closed, printed = drawdown.BOOKS[case]
    made = layer_on_a_plane(density, **water)
    before, after = (factor(made, time) for time in (drawdown.BEFORE, drawdown.AFTER))
    assert before == pytest.approx(1 / math.tan(BETA), rel=1e-10)  # under water as dry
    assert after / before == pytest.approx(closed, rel=1e-10) and closed == pytest.approx(printed, abs=5e-4)


# ---- seepage ------------------------------------------------------------------------------------------
@pytest.fixture(scope="module")
def drawn_down():
    """A long slope under a reservoir, at once after a rapid drawdown, and when it has drained: (section, field)."""
    layers = {"rock": {"along": 2e-5, "across": 1e-5, "dip": math.degrees(BETA)}}
    made = seeping(FULL, BARE, {"time": 9.0, "reservoir": -100.0}, conductivity=layers)
    return made, of_section.field(made)


def test_a_rapid_drawdown_of_seeping_water_leaves_the_effective_stresses(drawn_down):
    made, _ = drawn_down
    before, after, drained = (factor(made, time) for time in (0.0, 5.0, 9.0))
    assert before == pytest.approx(1 / math.tan(BETA), rel=1e-10)
    assert after / before == pytest.approx(0.5575, rel=2e-3)  # of the mesh, and far from the ends
    assert drained > 1.2 * after


def test_a_rapid_drawdown_begins_from_the_state_before_it():
    """And not from that of the beginning, when the reservoir was low."""
    low, full, bare = (
        {"time": t, **state}
        for t, state in ((0.0, {"reservoir": 20.0}), (2.0, {"reservoir": 120.0}), (4.0, {"drained": False}))
    )
    course, short = (of_section.field(seeping(*states)) for states in ((low, full, bare), (full, bare)))
    x = np.linspace(-150, -40, 23)
    places = np.column_stack((x, -x * math.tan(BETA) + 0.5 * drawdown.THICK))  # within the layer
    found, known, first = course.pressure(places, 4.0), short.pressure(places, 4.0), course.pressure(places, 0.0)
    # meshes differ a little, as the level of the low reservoir is a line of one of them
    assert found == pytest.approx(known, rel=0.02, abs=2e3) and known.max() > 4e4
    assert np.abs(first - known).max() > 2e4


def test_open_water_stands_over_the_ground_at_the_level_of_the_time(drawn_down):
    made, field = drawn_down
    x = np.linspace(-185, -5, 60)
    ground = -x * math.tan(BETA) + drawdown.THICK / math.cos(BETA)
    over = np.column_stack((x, ground + 1.0))
    assert field.pressure(over, 0.0) == pytest.approx(9810 * (120 - over[:, 1]), rel=1e-12)
    assert field.gradient(over, 0.0) == pytest.approx(np.tile((0.0, -9810.0), (60, 1)), abs=1e-6)
    assert not field.pressure(over, 5.0).any()
    # and it presses on the face: p has no step there
    inside = np.column_stack((x, ground - 1e-6))
    assert field.pressure(inside, 0.0) == pytest.approx(9810 * (120 - ground), rel=1e-6)


def test_still_water_is_still_in_the_ground_and_over_it():
    made = seeping({"time": 0.0, "reservoir": 40.0})
    field = of_section.field(made)
    rng = np.random.default_rng(1)
    points = np.column_stack((rng.uniform(-185, -1, 400), rng.uniform(0, 80, 400)))
    base = -points[:, 0] * math.tan(BETA)
    points = points[points[:, 1] > base + 0.01]
    found = field.gradient(points, 0.0, outside="dry")
    deep = (points[:, 1] < 40.0)[:, None] * (0.0, -9810.0)
    assert found == pytest.approx(deep, abs=1e-6) and deep.any() and not deep.all()


def bank(x=0.0):
    """A bank of 20 m between two lakes, with its middle at ``x``."""
    rock = {"friction": 0.5, "rolling_friction": 0.1, "bonded": False, "density": 2000.0}
    ground = {"friction": 0.5, "rolling_friction": 0.1, "bonded": False}
    base, layer, left, right = (
        [[x + along, y] for along, y in line]
        for line in (
            [(-60.0, 0.5), (-40.0, 0.0), (40.0, 0.0), (60.0, -0.5)],
            [(-40.0, 0.0), (40.0, 0.0), (10.0, 20.0), (-10.0, 20.0)],
            [(-40.0, 0.0), (-10.0, 20.0)],
            [(10.0, 20.0), (40.0, 0.0)],
        )
    )
    return section.of(
        name="bank",
        walls=[{"name": "base", "material": "ground", "vertices": base}],
        layers=[{"name": "bank", "material": "rock", "vertices": layer}],
        materials={"rock": rock, "ground": ground},
        disks={"diameter": [1.0, 2.0]},
        water={
            "seepage": {
                "size": 3.0,
                "conductivity": 1e-6,
                "states": [
                    {"time": 0.0, "boundaries": [{"line": left, "reservoir": 15.0}, {"line": right, "reservoir": 5.0}]}
                ],
            }
        },
    )


@pytest.mark.parametrize("x", [0.0, 70.0, -300.0])
def test_two_reservoirs_stand_where_their_lines_are(x):
    """A bank of 20 m between two lakes, wherever it is; what none of them names is open to air."""
    made = bank(x)
    field = of_section.field(made)
    places = np.array([[-50.0, 3.0], [-35.0, 6.0], [50.0, 3.0], [35.0, 4.0], [50.0, 6.0], [-20.0, 15.5]]) + (x, 0.0)
    assert field.pressure(places, 0.0, outside="dry") / 9810 == pytest.approx([12, 9, 2, 1, 0, 0], abs=1e-9)
    heads = [float(field.pressure([[x + along, 0.5]])[0]) / 9810 + 0.5 for along in (-35.0, 0.0, 35.0)]
    assert 15.0 >= heads[0] > heads[1] > heads[2] >= 5.0


@pytest.mark.parametrize(
    "level, area", [(40.0, 120 * 40 - 1000), (20.0, 120 * 20 - 1000), (10.0, 2 * (20 * 10 + 10 * 15 / 2))]
)
def test_columns_of_open_water_fill_what_lies_over_the_ground(level, area):
    """Under a lake that drowns the bank, one that reaches its top, and one that reaches half of it, on either side."""
    corners = section_seepage._columns(bank(), level)
    areas = [0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)) for x, y in (one.T for one in corners)]
    # 5 m² more on the left are 5 m² less on the right
    assert min(areas) > 0 and sum(areas) == pytest.approx(area, rel=1e-12)


def test_the_flow_of_a_state_has_its_heads(drawn_down):
    made, field = drawn_down
    told = section_seepage.flow(made, field)
    for time in (0.0, 7.0, 9.0):
        head, flux, wet, largest = told(time)
        assert head == pytest.approx(field.at(time) / 9810 + field.mesh.nodes[:, 1])
        assert flux.shape == (len(field.mesh.triangles), 2) and np.all((wet >= 0) & (wet <= 1))
        assert not flux[wet == 0].any() and 1e-5 <= largest <= 2e-5


def test_rain_raises_the_water_and_an_artesian_base_lifts():
    dry = {"time": 0.0}
    heads = {
        "dry": of_section.field(seeping(dry)),
        "rain": of_section.field(seeping({**dry, "rain": 5e-6})),
        "base": of_section.field(seeping({**dry, "boundaries": [{"wall": "plane", "pressure_head": 4.0}]})),
    }
    along = np.array([at(s, 0.05) for s in np.linspace(40, 160, 20)])
    assert not heads["dry"].pressure(along).any()
    assert heads["rain"].pressure(along).min() > 9810 * 0.5
    assert heads["base"].pressure(along) == pytest.approx(4 * 9810, rel=0.05)


def test_a_slope_that_is_mirrored_has_mirrored_seepage(drawn_down):
    made, field = drawn_down
    there = of_section.field(similar.mirrored(made))
    x, y = np.array([at(s, 5.0) for s in np.linspace(30, 170, 40)]).T
    for time in (0.0, 5.0):
        assert there.pressure(np.column_stack((-x, y)), time) == pytest.approx(
            field.pressure(np.column_stack((x, y)), time), rel=1e-2
        )


REFUSED = {
    "a layer": ({"conductivity": {"clay": 1e-7}}, "no layer is called 'clay'", "give one of rock"),
    "no number": ({"conductivity": "low"}, "water.seepage.conductivity: 'low' is text", "[m/s]"),
    "zero": ({"conductivity": 0}, "0 is not allowed", "above 0"),
    "times": ({"states": [FULL, {**FULL}]}, "states[1].time: the time 0 s does not follow 0 s", "rising"),
    "first": ({"states": [BARE]}, "states[0].drained: the first state has none before it", "a later state"),
    "wall": (
        {"states": [{"time": 0, "boundaries": [{"wall": "DP", "head": 3}]}]},
        "no wall is called 'DP'",
        "give one of plane",
    ),
    "no place": ({"states": [{"time": 0, "boundaries": [{"head": 3}]}]}, "has neither `wall` nor `line`", "a line of"),
    "two kinds": (
        {"states": [{"time": 0, "boundaries": [{"wall": "plane", "head": 3, "inflow": 1}]}]},
        "has head and inflow",
        "give one of head",
    ),
    "false": (
        {"states": [{"time": 0, "boundaries": [{"wall": "plane", "closed": False}]}]},
        "false says nothing",
        "closed: true",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_refused_when_a_section_is_read(case):
    keys, *parts = REFUSED[case]
    with pytest.raises(section.SectionError) as error:
        layer_on_a_plane(2500.0, seepage={"size": 2.5, "conductivity": 1e-5, "states": [FULL], **keys})
    said = str(error.value)
    assert all(part in said for part in parts) and "\n" not in said, said


def test_a_line_off_the_border_is_refused_when_the_run_begins():
    made = seeping({"time": 0.0, "boundaries": [{"line": [[-100.0, 90.0], [-80.0, 90.0]], "head": 50.0}]})
    with pytest.raises(WaterError) as error:
        of_section.field(made)
    said = str(error.value)
    assert said.startswith("section: water.seepage") and "m from the layers' border" in said and "\n" not in said


def test_conditions_without_a_head_are_refused():
    closed = seeping({"time": 0.0, "boundaries": [{"line": [*line], "closed": True} for line in rims()]})
    with pytest.raises(WaterError, match=r"section: water.seepage.states\[0\]: conditions give no head anywhere"):
        of_section.field(closed)


def rims():
    """The free faces of the long slope."""
    base, surface = (
        [[x, -x * math.tan(BETA) + up / math.cos(BETA)] for x in (-190.0, 0.0)] for up in (0.0, drawdown.THICK)
    )
    return [[base[0], surface[0], surface[1], base[1]]]
