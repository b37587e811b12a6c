"""The course of a heap: what is refused before it begins, when rows, frames and rest come, and the numbers of a result,
by hand.
"""
import math
import re
from types import SimpleNamespace

import numpy as np
import pytest
from yade import O
from yade.nonsmooth import scene as makers, worlds
from yade.nonsmooth.heaps import column, course, grains, preparation
from yade.nonsmooth.measure import heap as measures
from yade.wrapper import NewtonIntegrator

pytestmark = pytest.mark.usefixtures("empty")
FEW = dict(disks=60, aspect=1.0)


@pytest.fixture(scope="module")
def few():
    """A column of some sixty disks, packed once."""
    O.reset()
    c = column.Column(**FEW)
    preparation.prepared(c)
    return c


def hard(heap):
    return worlds.Hard(time_step=heap.time_step(path=0.2), tolerance=1e-3)


def scene_of(monkeypatch, table, gates=("right",), base="smooth", glued=()):
    """A Scene of made-up disks, in a box of 10 m from x = -3 m."""
    heap = SimpleNamespace(
        density=2000.0, gravity=10.0, base=base, gates=lambda: gates, place=lambda: -3.0, mean_diameter=lambda: 2.5
    )
    monkeypatch.setattr(preparation, "disk_table", lambda stand: table)
    return course.HeapScene(heap, None, SimpleNamespace(width=10.0), SimpleNamespace(base=list(glued)))


# ---- a scene ----------------------------------------------------------------------------------------


def test_rms_speed_is_in_units_of_the_fall_of_a_diameter(monkeypatch):
    """Speeds 5, 1 and 2 m/s: √(30/3) over √(10 · 2.5) m/s; of the first two √(26/2)."""
    table = {"vx": np.array([3.0, 0.0, 2.0]), "vy": np.array([4.0, -1.0, 0.0])}
    found = scene_of(monkeypatch, table)
    assert found.rms_speed() == pytest.approx(math.sqrt(10.0) / 5, rel=1e-12)  # rounding
    assert found.rms_speed(np.array([True, True, False])) == pytest.approx(math.sqrt(13.0) / 5, rel=1e-12)


@pytest.mark.parametrize(
    "gates, base, walls",
    [
        (("right",), "smooth", [4.0, 1.0]),
        (("left", "right"), "smooth", [1.0]),
        (("left", "right"), "rough", []),
        (("left",), "rough", [6.0]),
    ],
)
def test_walls_are_those_that_stand(monkeypatch, gates, base, walls):
    """Of a disk at (1, 1): 4 m from the left side, 6 m from the right one, 1 m above the floor."""
    found = scene_of(monkeypatch, {}, gates, base)._walls(np.array([1.0]), np.array([1.0]))
    assert [float(d[0]) for d in found] == walls


def test_glued_disks_count_as_contacts(monkeypatch):
    """Two disks of 1 m on a glued one of 1 m: the left one 0.06 m into it, the right one 3 mm away, so the mean of 3 %
    and nothing.
    """
    stuff = O.materials[O.materials.append(hard(column.Column(**FEW)).material(column.Column(**FEW).material()))]
    glued = [O.bodies.append(makers.disk((0.5, 0), 1.0, stuff, fixed=True))]
    table = {
        "x": np.array([-1.44, 2.503]),
        "y": np.array([0.0, 0.0]),
        "r": np.ones(2),
        "vx": np.zeros(2),
        "vy": np.zeros(2),
        "omega": np.zeros(2),
    }
    row, _ = scene_of(monkeypatch, table, ("left", "right"), "rough", glued).measure()
    assert row["overlap_worst_rel"] == pytest.approx(0.03, rel=1e-9)
    assert row["overlap_mean_rel"] == pytest.approx(0.015, rel=1e-9)
    none, _ = scene_of(monkeypatch, table, ("left", "right"), "rough").measure()
    assert none["overlap_worst_rel"] == none["overlap_mean_rel"] == 0.0


def test_a_release_takes_the_gates_and_nothing_else(few):
    built = column.build(few, hard(few))
    gates, others = list(built.stand.gates), [*built.stand.disks, *built.stand.walls, *built.stand.base]
    assert gates and all(O.bodies[i] is not None for i in (*gates, *others))
    built.release()
    assert all(O.bodies[i] is None for i in gates) and all(O.bodies[i] is not None for i in others)
    assert built.stand.gates == []


# ---- what is refused ----------------------------------------------------------------------------------


def test_the_stiffness_that_is_asked_for_is_enough(few, monkeypatch):
    """A disk bears ρ g H d on a spring of E R for each metre of thickness: 5 % of its diameter for E = ρ g H/(R · 5 %).
    So many pascals are let through, a tenth less is not, and what the message asks for is let through whatever its
    digits."""
    monkeypatch.setattr(preparation, "put", lambda *scene: None)

    def soft(e):
        return worlds.Soft(stiffness=e, diameter=few.diameters())

    for height in np.linspace(1.0, 1.5, 11):
        made = SimpleNamespace(height=height, x=None, y=None, r=None)
        monkeypatch.setattr(preparation, "prepared", lambda heap: made)
        least = few.density * few.gravity * height / (0.5 * few.mean_diameter()) / 0.05
        column.build(few, soft(1.001 * least))
        with pytest.raises(
            grains.HeapError, match=r"overlap by 5\.6 % of a diameter under the weight above"
        ) as refused:
            column.build(few, soft(0.9 * least))
        asked = float(re.search(r"give (\S+) or more", str(refused.value))[1])
        column.build(few, soft(asked))
        assert asked < 1.11 * least  # 5 % more, and rounded to two digits


def test_disks_that_do_not_rest_in_their_box_are_refused(few, monkeypatch):
    monkeypatch.setattr(course, "SETTLED_SPEED", 0.0)
    with pytest.raises(grains.HeapError, match=r"in the hard world: rms speed .* after 10 T, wanted 0; give a smaller"):
        column.run(few, hard(few))
    unit = math.sqrt(preparation.prepared(few).height / few.gravity)
    # in whole rows, twenty to T
    assert 10 * unit <= O.time <= 10.1 * unit


def test_without_a_world_it_is_of_rigid_disks(few):
    made = column.build(few)
    assert made.world == grains.hard(few) == worlds.Hard(time_step=few.time_step(), tolerance=1e-4)
    assert grains.hard(few, path=0.2, tolerance=1e-3) == hard(few)


def test_damping_while_it_moves_is_of_soft_contacts(few):
    with pytest.raises(worlds.WorldError, match="damping_moving 0.1: hard"):
        column.run(few, hard(few), damping_moving=0.1)


# ---- the course ---------------------------------------------------------------------------------------


def test_rows_and_frames_come_when_they_are_due(few):
    """Twenty rows to T; frames at 0, 0.5 T and the end of 0.8 T; a film's every tenth of T; none rests so early."""
    seen = []
    found = column.run(few, hard(few), duration=0.8, frames=(0.5, 0.0, 0.8, 3.0), progress=seen.append)
    unit = math.sqrt(found.height / few.gravity)
    every = max(1, round(unit / 20 / found.time_step))
    time = found.series["time_s"]
    assert np.diff(found.series["step"]).tolist() == [every] * (len(time) - 1) and found.series["step"][0] == 0
    assert time == pytest.approx(found.series["step"] * found.time_step, rel=1e-12)
    row = every * found.time_step
    assert 0.8 * unit - 1e-9 <= time[-1] < 0.8 * unit + row and not found.rested
    # each on the first row that is not before its time
    for at, wanted in zip(found.frames, (0.0, 0.5, 0.8)):
        assert wanted * unit - 1e-6 <= at < wanted * unit + row
    assert len(found.frames) == 3 and list(found.frames) == sorted(found.frames)
    assert len(found.film) == 9  # 0, 0.1, … 0.8 T
    for k, at in enumerate(found.film):
        assert 0.1 * k * unit - 1e-6 <= at < 0.1 * k * unit + row
    x, y = found.film[0.0]
    assert x.dtype == np.float32 and x == pytest.approx(found.frames[0.0][0].astype(np.float32))
    assert seen == pytest.approx(np.minimum(1.0, time / (0.8 * unit)), rel=1e-9)
    assert len(found.x) == len(found.r) == len(found.connected) == len(y)
    assert found.series["wall_s"][0] == 0 and np.all(np.diff(found.series["wall_s"]) > 0)


def test_rest_is_slow_for_half_a_fall(few, monkeypatch):
    """Every row counts as slow: it rests once it is half of T past the first row after T."""
    monkeypatch.setattr(course, "REST_SPEED", 1e9)
    found = column.run(few, hard(few), duration=9, frames=())
    unit, row = math.sqrt(found.height / few.gravity), found.series["time_s"][1]
    assert found.rested and found.frames == {}
    # the first slow row is the first after T, none before counts, and n of them cover n rows' time
    first = int(np.argmax(found.series["time_s"] > unit))
    assert len(found.series["time_s"]) - first == math.ceil(course.REST_TIME * unit / row - 1e-9)
    assert 1.5 * unit - row < found.series["time_s"][-1] <= 1.5 * unit + 2 * row
    assert found.width == pytest.approx(few.box()[0]) and found.world == "hard"


def test_a_result_says_none_where_there_is_no_slope():
    """Three disks in a row have no flank of three points; a heap of a file was not asked for a number of disks."""
    heap = SimpleNamespace(
        gravity=10.0, gates=lambda: ("right",), place=lambda: 0.0, packing="disks.txt", disks=4, plain=lambda: {}
    )
    series = {name: np.array([0.0, 1.0]) for name in course.COLUMNS}
    x, ones = np.array([0.5, 1.5, 2.5]), np.ones(3)
    found = course.HeapResult(
        heap, "soft", {"a": 1}, 2.0, 5.0, series, x, 0.5 * ones, 0.5 * ones, np.array([True, True, False]), False, 1e-3
    )
    told = found.summary()
    assert told["repose_deg"] == [None] and told["disks_asked"] is None and told["rested"] is False
    assert (told["disks"], told["connected_disks"], told["world"], told["settings"]) == (3, 2, "soft", {"a": 1})
    at, height = found.surface()
    # of the connected ones alone, 2 m wide: means over the tops of circles of 1 m
    assert at[-1] < 2.0 and height == pytest.approx(measures.surface(x, 0.5 * ones, 0.5 * ones, found.connected)[1])
    assert height.mean() == pytest.approx(0.5 + math.pi / 8, abs=0.01)


# ---- damping ------------------------------------------------------------------------------------------


def test_damping_follows_the_speed():
    """Speeds in turn: none yet, the largest, a twentieth of it, nothing: the damping at rest, that on the move, half of
    either below a tenth, and again that at rest.
    """
    O.engines = [NewtonIntegrator(damping=0.7)]
    speeds = iter([0.0, 4.0, 0.2, 0.0])
    made = SimpleNamespace(world=SimpleNamespace(damping=0.2), rms_speed=lambda: next(speeds))
    damping = course._Damping(made, 0.04)
    found = []
    for _ in range(4):
        damping()
        found.append(O.engines[0].damping)
    # without any motion yet there is no largest speed to compare with: as on the move
    assert found == pytest.approx([0.04, 0.04, 0.12, 0.2], rel=1e-12)
