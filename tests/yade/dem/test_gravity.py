"""Gravity that grows by itself: ContactDynamicsEngine.finalGravity, gravityBegin, gravityRamp."""
import math

import pytest
from contact_scenes import G, begin, bits, box, engine, free_disk, loose_heap, material, refused, run
from yade import O
from yade.wrapper import NewtonIntegrator, NonsmoothTimeStepper, PorePressureEngine

pytestmark = pytest.mark.usefixtures("empty")
BEGIN, RAMP, FINAL = 0.031, 0.17, (0.6, -G, 0.0)


def newton():
    return next(e for e in O.engines if isinstance(e, NewtonIntegrator))


def grow(e, begin=BEGIN, ramp=RAMP, final=FINAL):
    e.finalGravity, e.gravityBegin, e.gravityRamp = final, begin, ramp


def share(time):
    return max(0.0, min(1.0, (time - BEGIN) / RAMP))


def test_it_grows_in_proportion_and_is_then_left_alone():
    disk = free_disk()
    e, fallen = begin(gravity=(0, 0, 0)), 0.0
    grow(e)
    for _ in range(260):
        due = share(O.time)
        O.step()
        assert tuple(newton().gravity) == tuple(due * g for g in FINAL)
        fallen += due * -G * O.dt
        assert e.gravityRamp == (RAMP if due < 1 else 0)
    assert O.bodies[disk].state.vel[1] == pytest.approx(fallen, rel=1e-12)  # 260 additions
    newton().gravity = (0, 1, 0)
    O.step()
    assert tuple(newton().gravity) == (0, 1, 0)


def test_there_is_no_ramp_unless_it_is_asked_for():
    free_disk()
    e = begin(gravity=(0, -1, 0))
    e.finalGravity, e.gravityBegin = (0, -G, 0), 0.0
    run(2)
    assert tuple(newton().gravity) == (0, -1, 0)


def slope_with_water():
    """Disks in a box, water among them, steps of many lengths."""
    stuff = material(0.3, 0.1, tensileStrength=2e3, residualTensileStrength=1e3, bondCreationDistance=0.1)
    box(stuff, 9.5, 12)
    loose_heap(stuff)
    water = PorePressureEngine(unitWeight=9810, planeNormal=(0.6, 0.8, 0), releaseDistance=0.3, times=[0], heights=[3])
    e = begin(gravity=(0, 0, 0), dt=2e-3, tolerance=1e-4, maxIterations=300)
    at = O.engines.index(next(x for x in O.engines if x.label == e.label))
    O.engines = [NonsmoothTimeStepper(smallest=5e-4, largest=2e-3, path=0.01), *O.engines[:at], water, *O.engines[at:]]
    return engine(), water


@pytest.mark.parametrize("resumed", [False, True])
def test_all_engines_see_in_a_step_what_is_due_in_it(resumed, tmp_path):
    found = []
    for by_hand in (True, False):
        O.reset()
        e, water = slope_with_water()
        run(1)
        e.bond()
        if not by_hand:
            grow(e)
        for k in range(300):
            if by_hand:
                newton().gravity = tuple(share(O.time) * g for g in FINAL)
            elif resumed and k == 60:
                O.save(str(tmp_path / "growing.yade.gz"))
                O.load(str(tmp_path / "growing.yade.gz"))
                e, water = engine(), next(x for x in O.engines if isinstance(x, PorePressureEngine))
                assert 0 < e.gravityRamp and 0 < share(O.time) < 1
            O.step()
        found.append((bits(), water.bodyTable(), water.releasedCount, e.energyError, O.time))
    assert found[0] == found[1] and 0 < found[0][2] < 64  # some are released, by the direction of gravity


@pytest.mark.parametrize(
    "name, value, words",
    [
        ("gravityRamp", -1.0, ("gravityRamp = -1", "0 or more")),
        ("gravityRamp", math.nan, ("gravityRamp = nan",)),
        ("gravityRamp", math.inf, ("gravityRamp = inf",)),
        ("gravityBegin", math.nan, ("gravityBegin = nan", "finite [s]")),
        ("finalGravity", (0, math.inf, 0), ("finalGravity = 0, inf, 0", "finite [m/s²]")),
    ],
)
def test_ramps_without_sense(name, value, words):
    free_disk()
    e = begin(gravity=(0, 0, 0))
    grow(e)
    setattr(e, name, value)
    refused(*words)
    assert tuple(newton().gravity) == (0, 0, 0)
