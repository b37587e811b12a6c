"""What soft contacts tell of a scene (soft.measures), against forces, places and velocities of YADE's own."""
import math

import numpy as np
import pytest
from yade import O
from yade.nonsmooth import scene, section, tables, worlds
from yade.nonsmooth.soft.measures import Measures

from contact_scenes import run

ROCK = section.Material(
    "rock",
    friction=0.5,
    residual_friction=0.3,
    rolling_friction=0.1,
    residual_rolling_friction=0.1,
    tensile_strength=1e5,
    density=2500.0,
)
GROUND = section.Material(
    "ground", friction=0.4, residual_friction=0.4, rolling_friction=0.1, residual_rolling_friction=0.1, bonded=False
)
WORLD = worlds.Soft(stiffness=1e8, diameter=(1.0, 1.6), damping=0.0)
same = dict(rel=1e-9)  # rounding
MODES = ("brokenTension", "brokenShear", "brokenTorque", "brokenMixed")


pytestmark = pytest.mark.usefixtures("empty")


def begin(disks, gravity=(0, 0, 0), wall=False):
    """Disks (x, y, r) of one rock, above a wall along x if asked for; returns the Measures and the ids of the disks."""
    rock, ground = (O.materials[O.materials.append(m)] for m in (WORLD.material(ROCK), WORLD.wall_material(GROUND)))
    if wall:
        O.bodies.append(scene.segments([(-50, 0), (50, 0)], ground, sense=1))
    ids = list(O.bodies.append([scene.disk((x, y), r, rock) for x, y, r in disks]))
    O.engines, O.dt = WORLD.engines(gravity=gravity), WORLD.step_for([ROCK])
    return Measures(WORLD, [(ROCK, ids)]), ids


@pytest.mark.parametrize("wall", [True, False])
@pytest.mark.parametrize("way", [1, -1])
def test_forces_are_those_on_the_second_body(wall, way):
    """The only contact of a disk that slides to one side: what it feels, along the normal and along that turned by +90°."""
    seen, ids = begin([(0, 0.499, 0.5)] if wall else [(0, 0, 0.8), (0, 1.299, 0.5)], wall=wall)
    second = ids[-1]
    O.bodies[second].state.vel = (0.3 * way, 0, 0)
    run(2)
    # contacts are looked at at a step's begin
    depth = (
        0.5 - O.bodies[second].state.pos[1]
        if wall
        else 1.3 - (O.bodies[ids[1]].state.pos - O.bodies[ids[0]].state.pos).norm()
    )
    run(1)
    table, force = tables.contacts(seen), O.forces.f(second)
    assert len(table["id2"]) == 1 and table["id2"][0] == second
    nx, ny = table["nx"][0], table["ny"][0]
    assert ny > 0.99 and table["normal"][0] > 0
    assert table["normal"][0] == pytest.approx(force[0] * nx + force[1] * ny, **same)
    # friction acts against the motion
    assert (
        table["tangential"][0] == pytest.approx(-force[0] * ny + force[1] * nx, **same)
        and way * table["tangential"][0] > 0
    )
    assert -table["gap"][0] == pytest.approx(depth, rel=1e-9) and depth > 0
    assert (
        seen.overlapWorst == seen.overlapMean == pytest.approx(-table["gap"][0] / (1.0 if wall else 1.3), **same)
        and seen.contacts == 1
    )


def test_energies_and_centre_by_hand():
    seen, ids = begin([(0.0, 3.0, 0.5), (4.0, -1.0, 0.8)], gravity=(2.0, -9.81, 0))
    O.step()
    for i, velocity, spin in zip(ids, ((3.0, -1.0, 0), (0.5, 2.0, 0)), (4.0, -7.0)):
        O.bodies[i].state.vel, O.bodies[i].state.angVel = velocity, (0, 0, spin)
    seen._step = None  # a script has changed the state since
    m = 2500 * math.pi * np.array([0.25, 0.64])
    x, y = np.array([tuple(O.bodies[i].state.pos)[:2] for i in ids]).T
    assert seen.potentialEnergy == pytest.approx(float((m * (9.81 * y - 2.0 * x)).sum()), **same)
    assert seen.kineticEnergy == pytest.approx(
        0.5 * float((m * [10.0, 4.25]).sum() + (0.5 * m * [0.25, 0.64] * [16.0, 49.0]).sum()), **same
    )
    assert seen.centroid == pytest.approx((float((m * x).sum() / m.sum()), float((m * y).sum() / m.sum())), **same)
    assert (seen.meanSpeed, seen.maxSpeed) == pytest.approx(
        (0.5 * (math.sqrt(10) + math.sqrt(4.25)), math.sqrt(10)), **same
    )


@pytest.mark.parametrize(
    "velocity, spin, mode", [((0, 0.5, 0), 0.0, "brokenTension"), ((0.5, 0, 0), 0.0, "brokenShear")]
)
def test_a_bond_is_counted_by_how_it_broke(velocity, spin, mode):
    """One of two bonded disks goes; looked at in every step."""
    seen, ids = begin([(0, 0, 0.5), (0, 1.0, 0.5)])
    assert seen.bond() == 1 and seen.bonds == 1
    O.bodies[ids[0]].state.blockedDOFs = "xyzXYZ"
    O.bodies[ids[1]].state.blockedDOFs = "xyzXYZ"
    O.bodies[ids[1]].state.vel = velocity
    for _ in range(4000):
        O.step()
        if not seen.bonds:
            break
    assert seen.bonds == 0 and {name: getattr(seen, name) for name in MODES} == {
        name: int(name == mode) for name in MODES
    }
