"""Walls that weaken with slip, water, and bonds: a small slope has the same course in any frame."""
import numpy as np
import pytest
from yade import O
from yade.wrapper import Collider, InsertionSortCollider, InteractionLoop, NewtonIntegrator

from symmetries import BINARY, FRAMES, Disk, Line, World, assert_bits, assert_same, play, saved_and_loaded

ROUNDING = 1e-9  # as in test_symmetries_contacts.py
DIP = np.radians(21)
ALONG, NORMAL = np.array([np.cos(DIP), -np.sin(DIP)]), np.array([np.sin(DIP), np.cos(DIP)])


def slope(law="step"):
    """Eight bonded columns of three disks on a dipping wall that loses its strength after 5 cm; water rises among them,
    and lets go what has moved by 12 cm.

    Columns, and no block, for the reason that test_symmetries_bonds.py gives."""
    disks = tuple(
        Disk(*(1.3 * a + 0.02 * b) * ALONG + (0.5 + b * np.cos(0.02)) * NORMAL, 0.5, mask=3 if (a + b) % 3 else 2)
        for b in range(3)
        for a in range(8)
    )
    rock = dict(
        frictionAngle=0.5,
        rollingFriction=0.1,
        residualFrictionAngle=0.4,
        tensileStrength=3e4,
        bondEllipseNormal=0.02,
        bondEllipseTangential=0.02,
    )
    plane = dict(
        frictionAngle=np.arctan(0.42),
        rollingFriction=0.1,
        tensileStrength=1e3,
        criticalSlip=0.05,
        weakening=law,
        weakenedFrictionAngle=0.12,
        weakenedTensileStrength=200.0,
        bondsToAll=True,
        bondEllipseNormal=0.05,
        bondEllipseTangential=0.05,
    )
    valley = dict(frictionAngle=0.4, rollingFriction=0.1, wall=True)
    foot = 10.5 * ALONG
    walls = (
        Line((tuple(-3 * ALONG), tuple(foot)), "plane", piece=1.3, sense=1),
        Line((tuple(foot), tuple(foot + (6, 0))), "valley", piece=2.0, sense=1),
    )
    return World(
        disks,
        walls,
        dict(rock=rock, plane=plane, valley=valley),
        dt=4e-3,
        steps=280,
        bond=1,
        options=dict(reach=0.1, maxIterations=2000),
        water=dict(
            planeNormal=tuple(NORMAL),
            unitWeight=9810.0,
            times=[0.0, 0.217, 0.9],
            heights=[0.0, 1.0, 2.5],
            releaseDistance=0.12,
            volumeFactor=1.2,
            mask=1,
        ),
    )


WORLDS = {"step": slope("step"), "exponential": slope("exponential")}


pytestmark = pytest.mark.usefixtures("empty")


@pytest.fixture(scope="module", params=WORLDS)
def known(request):
    world = WORLDS[request.param]
    course = play(world)
    wet, slipped = course["wet"], course["slip"][-1]
    # some in the water, some not yet or no more
    assert wet[:, :, 0].any() and not wet[:, :, 0].all() and wet[-1, :, 1].any()
    assert (
        slipped.max() > 0.05
        and (slipped > 0).sum() >= 8
        and course["counts"][-1, 1:5].sum() > 0
        and course["counts"][-1, 0] > 0
    )
    return world, course


# the water's plane stands still, so the scene may move along with nothing
@pytest.mark.parametrize("name", [name for name in FRAMES if name != "moving"])
def test_any_frame_sees_the_same_course(known, name):
    world, here = known
    assert_same(play(world, FRAMES[name]), here, ROUNDING)


def test_powers_of_two_as_units_change_no_bit(known):
    world, here = known
    assert_bits(play(world, BINARY), here)


def test_a_scene_saved_and_loaded_in_between_changes_no_bit(known, tmp_path):
    world, here = known
    assert_bits(play(world, halfway=saved_and_loaded(tmp_path / "half.yade.gz")), here)


def test_yades_own_collider_loop_and_integrator_change_no_bit(known):
    world, here = known

    def yades(e):
        if isinstance(e, Collider):
            return InsertionSortCollider(e.boundDispatcher.functors, verletDist=e.verletDist)
        if isinstance(e, InteractionLoop):
            return InteractionLoop(e.geomDispatcher.functors, e.physDispatcher.functors, e.lawDispatcher.functors)
        return NewtonIntegrator(damping=0, gravity=e.gravity) if isinstance(e, NewtonIntegrator) else e

    def swap(ids):
        O.engines = [yades(e) for e in O.engines]

    assert_bits(play(world, prepared=swap), here)
