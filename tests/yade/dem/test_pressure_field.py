"""Pore pressure on triangles: values and gradients, still water, states in time, what is dry, save and load."""
import math

import numpy as np
import pytest
from scipy.spatial import Delaunay
from yade import O
from yade.minieigenHP import Vector3, Vector3i
from yade.nonsmooth import pore_pressure, scene
from yade.nonsmooth.water import fields, forces, mesh as meshes
from yade.wrapper import PorePressureEngine, PorePressureField

from contact_scenes import G, begin, bits, box, loose_heap, material, run

pytestmark = pytest.mark.usefixtures("empty")

WATER = 9810.0


def mesh(width=12.0, height=12.0, n=7, seed=3):
    """Triangles between points at random in a box, its corners and sides among them; arrays (n, 2) and (m, 3)."""
    dice = np.random.default_rng(seed)
    inner = dice.uniform((0, 0), (width, height), (n * n, 2))
    side = np.linspace(0, 1, n)[:, None]
    edges = [side * (width, 0), side * (width, 0) + (0, height), side * (0, height), side * (0, height) + (width, 0)]
    points = np.unique(np.vstack([inner, *edges]), axis=0)
    return points, Delaunay(points).simplices


def field(points, triangles, *states, times=()):
    return PorePressureField(
        nodes=[Vector3(x, y, 0) for x, y in points],
        triangles=[Vector3i(*map(int, t)) for t in triangles],
        times=list(times),
        pressures=[float(p) for state in states for p in state],
    )


def test_linear_pressures_are_met_everywhere():
    points, triangles = mesh()
    water = field(points, triangles, 3.0 + 2 * points[:, 0] - 5 * points[:, 1])
    dice = np.random.default_rng(1)
    for x, y in [*dice.uniform(0, 12, (300, 2)), *points]:  # nodes too, which belong to several triangles
        p, gradient = water.at(Vector3(x, y, 0))
        assert p == pytest.approx(3 + 2 * x - 5 * y, abs=1e-10)
        assert (gradient - Vector3(2, -5, 0)).norm() < 1e-9  # slivers of a thousandth lose three digits


@pytest.mark.parametrize("place", [(-1e-3, 5), (12.001, 5), (5, -1e-3), (5, 12.001), (1e300, 0)])
def test_outside_there_is_no_water(place):
    points, triangles = mesh()
    assert field(points, triangles, np.ones(len(points))).at(Vector3(*place, 0)) == (None, None)


@pytest.mark.parametrize("first", [(0, 1, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)])
def test_holes_and_gaps_between_triangles_are_outside(first):
    points = np.array([(0, 0), (1, 0), (0, 1), (1, 1), (2, 0), (2, 1)], float)
    water = field(points, [first, (4, 5, 3)], np.arange(6.0))
    assert water.at(Vector3(0.2, 0.2, 0))[0] == pytest.approx(0.6) and water.at(Vector3(1.8, 0.5, 0))[0] is not None
    for gap in ((0.9, 0.9), (0.55, 0.5), (1.2, 0.5)):
        assert water.at(Vector3(*gap, 0)) == (None, None)


def test_a_triangles_gradient_is_that_of_its_three_nodes():
    points = np.array([(0, 0), (2, 0), (0, 3), (4, 4)], float)
    water = field(points, [(0, 1, 2), (2, 1, 3)], [1.0, 5.0, 7.0, -3.0])
    assert water.at(Vector3(0.5, 0.5, 0)) == (pytest.approx(1 + 2 * 0.5 + 2 * 0.5), Vector3(2, 2, 0))
    # p = 7, 5, −3 at (0, 3), (2, 0), (4, 4): two equations for the gradient
    g = np.linalg.solve([[2, -3], [4, 1]], [-2, -10])
    assert (water.at(Vector3(2.2, 2.2, 0))[1] - Vector3(*g, 0)).norm() < 1e-13


@pytest.mark.parametrize("factor", [1.0, 1 / 0.84])
def test_still_water_carries_the_displaced_weight(factor):
    stuff = material(0.3)
    box(stuff, 12, 12)
    ids = loose_heap(stuff, columns=7, rows=7)
    points, triangles = mesh()
    level = 5.3
    water = PorePressureEngine(field=field(points, triangles, WATER * (level - points[:, 1])), volumeFactor=factor)
    begin(dt=1e-5, before=[water])
    run(1)
    wet = [k for k in ids if O.bodies[k].state.pos[1] < level]
    area = sum(math.pi * O.bodies[k].shape.radius ** 2 for k in wet)
    assert 10 < len(wet) < len(ids) and water.wetCount == len(wet)
    assert [water.isWet(k) for k in ids] == [k in wet for k in ids]
    assert (water.totalForce - Vector3(0, WATER * area * factor, 0)).norm() < 1e-10 * WATER * area


def test_ground_without_pressure_is_dry():
    """As that above the free surface of a seepage, which has no suction."""
    ids = [O.bodies.append(scene.disk((2 * k, 3), 0.4, material(0.3))) for k in range(4)]
    points, triangles = mesh()
    water = PorePressureEngine(field=field(points, triangles, 0 * points[:, 1]))
    begin(dt=1e-4, before=[water])
    run(1)
    assert water.wetCount == 0 and not any(water.isWet(k) or water.wasWet(k) for k in ids)


def test_the_table_above_a_plane_is_one_such_field():
    """Forces of parallel seepage, from a table and from its pressure on triangles."""
    dip, height = math.radians(21), 4.0
    normal = Vector3(math.sin(dip), math.cos(dip), 0)
    points, triangles = mesh(40, 40)
    points = points - 20
    pressure = WATER * math.cos(dip) * (height - points @ np.array(tuple(normal)[:2]))
    forces = []
    for more in (dict(times=[0], heights=[height]), dict(field=field(points, triangles, pressure))):
        O.reset()
        stuff = material(0.3)
        ids = [O.bodies.append(scene.disk((2 * k - 8, h), 0.4, stuff)) for k, h in enumerate((1, 2, 3, 4, 5, 6, 7))]
        water = PorePressureEngine(unitWeight=WATER, planeNormal=normal, **more)
        begin(dt=1e-4, before=[water])
        run(1)
        forces.append([tuple(O.bodies[k].state.vel) for k in ids] + [tuple(water.totalForce)])
        assert 0 < water.wetCount < len(ids)
    assert np.abs(np.array(forces[0]) - forces[1]).max() < 1e-9 * np.abs(forces[0]).max()


def test_states_are_interpolated_in_time_and_held_outside():
    points = np.array([(0, 0), (1, 0), (0, 1)], float)
    water = field(points, [(0, 1, 2)], [0, 0, 6], [4, 8, 12], [4, 0, 0], times=[1, 3, 4])

    def at(t):
        return water.at(Vector3(0, 0, 0), t)[0]

    for time, p in ((0, 0), (1, 0), (1.5, 1), (2, 2), (3, 4), (3.5, 4), (4, 4), (9, 4)):
        assert at(time) == pytest.approx(p, abs=1e-14)
    assert water.at(Vector3(0, 0, 0), 2)[1] == Vector3(4 - 2, 9 - 2, 0)
    assert water.at(Vector3(0, 0, 0), 3.25)[1] == Vector3(6 - 4, 9 - 4, 0)


def test_lists_that_are_set_later_act():
    water = field(np.array([(0, 0), (1, 0), (0, 1)], float), [(0, 1, 2)], [0, 0, 6])
    at = Vector3(0.25, 0.25, 0)
    assert water.at(at)[0] == 1.5
    water.pressures = [4, 4, 4]
    assert water.at(at) == (4, Vector3(0, 0, 0))
    water.nodes = [(1, 1, 0), (2, 1, 0), (1, 2, 0)]
    assert water.at(at) == (None, None)
    water.times = [0, 1]
    with pytest.raises(ValueError, match="pressures has 3 entries"):
        water.at(at)


def test_a_disk_is_released_from_a_field_as_from_a_table():
    stuff = material(0.0)
    points, triangles = mesh(40, 40)
    disk = O.bodies.append(scene.disk((5, 20), 0.5, stuff))
    slope = math.radians(30)
    pressure = WATER * (30 - points[:, 1])
    water = PorePressureEngine(
        field=field(points, triangles, pressure), planeNormal=(math.sin(slope), math.cos(slope), 0), releaseDistance=1.0
    )
    begin(dt=1e-3, gravity=(0, -G, 0), before=[water])
    O.bodies[disk].state.vel = (4, -2, 0)
    run(400)
    assert water.wasWet(disk) and water.isReleased(disk) and not water.isWet(disk) and water.releasedCount == 1


def test_saved_and_loaded_it_is_the_same(tmp_path):
    stuff = material(0.3)
    box(stuff, 12, 12)
    loose_heap(stuff, columns=5, rows=5)
    points, triangles = mesh()
    states = [WATER * (level - points[:, 1]) for level in (2.0, 9.0)]
    begin(dt=1e-3, before=[PorePressureEngine(field=field(points, triangles, *states, times=[0, 0.3]))])
    run(60)
    O.save(str(tmp_path / "scene.yade.bz2"))
    run(60)
    expected = bits()
    O.load(str(tmp_path / "scene.yade.bz2"))
    run(60)
    assert bits() == expected and any(e.wetCount > 5 for e in O.engines if isinstance(e, PorePressureEngine))


GOOD = dict(nodes=[(0, 0, 0), (1, 0, 0), (0, 1, 0)], triangles=[(0, 1, 2)], pressures=[1, 2, 3])


@pytest.mark.parametrize(
    "change, word",
    [
        (dict(nodes=[]), "nodes has 0 entries"),
        (dict(triangles=[]), "triangles 0"),
        (dict(pressures=[1, 2]), "pressures has 2 entries: give one for each of the 3 nodes"),
        (dict(times=[0, 1]), "at each of the 2 times, 6"),
        (dict(times=[1, 0], pressures=[1, 2, 3, 4, 5, 6]), "times must rise"),
        (dict(times=[math.nan]), "times[0] = nan"),
        (dict(pressures=[1, math.inf, 3]), "pressures[1] = inf"),
        (dict(nodes=[(0, 0, 0), (1, math.nan, 0), (0, 1, 0)]), "nodes[1][1] = nan"),
        (dict(triangles=[(0, 1, 3)]), "triangles[0] names the node 3, and there are 3"),
        (dict(triangles=[(0, 1, -1)]), "names the node -1"),
        (dict(nodes=[(0, 0, 0), (1, 0, 0), (2, 0, 0)]), "triangles[0] has no area"),
    ],
)
def test_what_has_no_sense_is_refused(change, word):
    water = PorePressureField(**(GOOD | change))
    with pytest.raises(ValueError) as error:
        water.at(Vector3(0.1, 0.1, 0))
    assert word in str(error.value) and "PorePressureField" in str(error.value)
    begin(before=[PorePressureEngine(field=water)])
    with pytest.raises(Exception, match="PorePressureField"):
        O.step()


def test_a_mesh_field_acts_as_its_forces_tell():
    """The engine's forces are those that water.forces computes without YADE, between two states in time."""
    stuff = material(0.3)
    box(stuff, 12, 12)
    ids = loose_heap(stuff, columns=7, rows=7)
    points, triangles = mesh()
    x, y = points.T
    states = [WATER * (4 + 0.3 * np.sin(x) - y), WATER * (9 - 0.1 * x - y)]
    told = fields.MeshField(meshes.Mesh.of(points, triangles), (0.0, 2.0), states)
    begin(dt=1e-3, before=[PorePressureEngine(field=pore_pressure.field(told, begin=-0.7), volumeFactor=1 / 0.8)])
    places = [O.bodies[k].state.pos for k in ids]
    x, y, r = np.array([(p[0], p[1], O.bodies[k].shape.radius) for k, p in zip(ids, places)]).T
    run(1)
    expected = forces.on_disks(told, x, y, r, 0.7, area="bulk", packing_fraction=0.8, outside="dry")
    water = O.engines[3]
    assert (water.totalForce - Vector3(*expected.sum(axis=0), 0)).norm() < 1e-9 * np.abs(expected).sum()
    wet = np.abs(expected).sum(axis=1) > 0
    assert [water.isWet(k) for k in ids] == wet.tolist() and 10 < wet.sum() < len(ids)


@pytest.mark.parametrize("arguments, word", [((3,), "give a MeshField"), ((None, math.inf), "begin inf")])
def test_what_is_no_field_is_refused(arguments, word):
    points, triangles = mesh()
    good = fields.MeshField(meshes.Mesh.of(points, triangles), (0.0,), [np.zeros(len(points))])
    with pytest.raises(pore_pressure.PorePressureError, match=word):
        pore_pressure.field(*(good if one is None else one for one in arguments))
