"""Tables of the running scene against YADE's own attributes, body by body and contact by contact."""
import math

import numpy as np
import pytest
from contact_scenes import begin, engine, material, run
from yade import O
from yade.minieigenHP import Quaternion
from yade.nonsmooth import scene, tables
from yade.nonsmooth.errors import UserError

ROUNDING = 1e-12  # of an angle that comes back from a quaternion


@pytest.fixture
def corner():
    """Two disks in a corner, pressed into it by an oblique gravity and turning, after some steps: ids of the floor, of
    the side, and of the first disk.
    """
    O.reset()
    stuff = material(0.3, 0.1)
    floor, side = (
        O.bodies.append(scene.segments(ends, stuff))[0] for ends in ([(-20, 0), (20, 0)], [(0, 20), (0, -20)])
    )
    first = O.bodies.append(scene.disk((0.5, 0.5), 0.5, stuff))
    second = O.bodies.append(scene.disk((1.765, 0.8), 0.8, stuff))
    O.bodies[first].state.ori, O.bodies[second].state.ori = Quaternion((0, 0, 1), 2.5), Quaternion((0, 0, 1), -0.4)
    O.bodies[first].state.angVel, O.bodies[second].state.vel, O.bodies[second].state.angVel = (
        (0, 0, 0.5),
        (-2.0, 0, 0),
        (0, 0, -2.0),
    )
    begin(gravity=(-4, -9.81, 0))
    run(3)
    yield floor, side, first
    O.reset()


def test_bodies_are_those_of_the_scene(corner):
    table = tables.bodies(engine())
    assert table["id"].tolist() == [corner[2], corner[2] + 1]
    for k, i in enumerate(table["id"].tolist()):
        state = O.bodies[i].state
        axis, angle = state.ori.toAxisAngle()[0], state.ori.toAxisAngle()[1]
        wanted = (*tuple(state.pos)[:2], O.bodies[i].shape.radius, *tuple(state.vel)[:2], state.angVel[2])
        assert tuple(table[name][k] for name in ("x", "y", "r", "vx", "vy", "omega")) == wanted
        assert math.remainder(table["angle"][k] - axis[2] * angle, 2 * math.pi) == pytest.approx(0, abs=ROUNDING)
    assert abs(table["angle"][0]) > 2 and table["vx"][1] != table["vy"][1]  # they can be told apart


def test_contacts_are_those_of_the_scene(corner):
    table = tables.contacts(engine())
    pairs = list(zip(table["id1"].tolist(), table["id2"].tolist()))
    assert (
        sorted(map(sorted, pairs)) == list(map(sorted, pairs))
        and len(pairs) == sum(i.isReal for i in O.interactions) >= 3
    )
    for k, (a, b) in enumerate(pairs):
        i = O.interactions[a, b]
        wanted = (
            i.phys.normal,
            i.phys.tangential,
            i.phys.torque,
            *tuple(i.geom.normal)[:2],
            -i.geom.penetrationDepth,
            *tuple(i.geom.contactPoint)[:2],
        )
        assert (
            tuple(table[name][k] for name in ("normal", "tangential", "torque", "nx", "ny", "gap", "x", "y")) == wanted
        )
        assert not table["bonded"][k] and table["broken"][k] == 0


def test_contacts_with_a_body_that_has_no_number_are_refused(corner):
    floor, side, first = corner  # the first disk lies on the floor
    for numbers in ({}, {side: 1}):
        with pytest.raises(UserError, match=f"wall_numbers: lacks body {floor}"):
            tables.loaded_contacts(engine(), first, numbers)
    for wrong in ("a", 1.5, -1, None):
        with pytest.raises(UserError, match="first_disk .*: give the id of disk 0"):
            tables.loaded_contacts(engine(), wrong, {floor: 0, side: 1})
    with pytest.raises(UserError, match="first_disk 1000"):
        tables.loaded_contacts(engine(), 1000, dict.fromkeys(range(1000), 0))


def test_loaded_contacts_name_disks_and_walls(corner):
    floor, side, first = corner
    found = tables.loaded_contacts(engine(), first, {floor: 0, side: 1})
    wanted = {}
    for i in O.interactions:
        if i.isReal and i.phys.normal != 0:
            low, high = sorted((i.id1, i.id2))
            wanted[high - first, {floor: -1, side: -2}.get(low, low - first)] = (
                i.phys.normal,
                i.phys.tangential,
                *tuple(i.geom.contactPoint)[:2],
            )
    assert {(0, -1), (0, -2), (1, -1), (1, 0)} >= set(wanted) >= {(0, -1), (1, 0)}
    assert {
        (int(a), int(b)): values
        for a, b, *values in zip(
            found["ci"], found["cj"], *(map(float, found[name]) for name in ("cn", "ct", "cx", "cy"))
        )
    } == {pair: list(values) for pair, values in wanted.items()}
    assert not found["cbonded"].any() and np.abs(found["ct"]).max() > 0


@pytest.mark.parametrize("owned", [False, True], ids=["from the bodies", "from the arrays"])
def test_rows_of_many_bodies_with_gaps(owned):
    """More than threads take at a time, with bodies that are no disks or gone between them; each moves in its own
    way.
    """
    O.reset()
    stuff = material(0.3, 0.1)
    made = []
    for k in range(9000):
        if k % 1000 == 500:
            O.bodies.append(scene.segments([(-500 - k, 0), (-500 - k, 1)], stuff))
        made.append(O.bodies.append(scene.disk((3.0 * (k % 100), 3.0 * (k // 100)), 0.5 + 1e-5 * k, stuff)))
        O.bodies[made[-1]].state.vel = (1e-3 * k, -2e-3 * k, 0)
    for i in made[::7]:
        O.bodies.erase(i)
    begin(gravity=(0, 0, 0))
    if owned:
        engine().advance(1, view=False)
    table = tables.bodies(engine())  # before anything else looks
    left = [(k, i) for k, i in enumerate(made) if k % 7]
    k = np.array([k for k, _ in left])
    moved = owned * O.dt
    assert table["id"].tolist() == [i for _, i in left]
    assert (table["r"] == 0.5 + 1e-5 * k).all()
    assert (table["vx"] == 1e-3 * k).all() and (table["vy"] == -2e-3 * k).all()
    assert (table["x"] == 3.0 * (k % 100) + 1e-3 * k * moved).all()
    assert (table["y"] == 3.0 * (k // 100) - 2e-3 * k * moved).all()
    O.reset()


def test_a_sphere_without_a_radius_is_no_row(corner):
    """Between two steps, of which the next one refuses it."""
    engine().view()
    O.bodies[corner[2]].shape.radius = 0.0
    assert tables.bodies(engine())["id"].tolist() == [corner[2] + 1]
