"""One scene in both worlds: a disk comes to rest on a wall, a pair of disks is bonded, a disk slides on a slope."""
import dataclasses
import math

import pytest
from yade import O, wrapper
from yade.nonsmooth import experiment, scene, section, worlds
from yade.nonsmooth.studies.slope import slope
from yade.wrapper import ContactDynamicsEngine

ROCK = section.Material(
    "rock",
    friction=0.6,
    residual_friction=0.6,
    rolling_friction=0,
    residual_rolling_friction=0,
    density=2500.0,
    tensile_strength=1e5,
)
GROUND = section.Material(
    "ground", friction=0.2, residual_friction=0.2, rolling_friction=0, residual_rolling_friction=0, bonded=False
)
WORLDS = [worlds.Hard(time_step=2e-3), worlds.Soft(stiffness=1e8, diameter=(1.0, 1.0))]


def build(world, centres, slope=0.0):
    O.reset()
    rock = O.materials[O.materials.append(world.material(ROCK))]
    ground = O.materials[O.materials.append(world.wall_material(GROUND))]
    O.bodies.append(scene.segments([(-50, 0), (50, 0)], ground, sense=1))
    ids = O.bodies.append([scene.disk(c, 0.5, rock) for c in centres])
    O.engines = world.engines(gravity=(9.81 * math.sin(slope), -9.81 * math.cos(slope), 0))
    O.dt = world.step_for([ROCK])
    return list(ids)


@pytest.mark.parametrize("world", WORLDS, ids=lambda w: w.name)
def test_a_disk_falls_as_on_earth_unless_it_is_told_otherwise(world):
    """Ten steps from rest: v = g t, without damping."""
    if world.name == "soft":
        world = dataclasses.replace(world, damping=0.0)
    (i,) = build(world, [(0, 20.0)])
    O.engines = world.engines()
    O.run(10, wait=True)
    assert tuple(O.bodies[i].state.vel) == pytest.approx((0.0, -9.81 * O.time, 0.0), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("world", WORLDS, ids=lambda w: w.name)
def test_disk_rests_on_the_wall(world):
    (i,) = build(world, [(0, 0.5)])
    O.run(round(1.0 / O.dt), wait=True)
    # a spring E R yields by m g/(E R) = 4e-4 m; rigid disks not at all
    assert O.bodies[i].state.pos[1] == pytest.approx(0.5, abs=5e-4)
    assert O.bodies[i].state.vel.norm() < 1e-3


def test_the_margin_of_the_collider_goes_with_the_smallest_disk():
    """0.6 of its radius where nothing else is said: a number below 0 is in radii, one above 0 in metres, which would be
    another margin at another size.
    """
    hard = worlds.Hard(time_step=1e-3)
    collider = next(e for e in hard.engines() if isinstance(e, wrapper.Collider))
    assert (collider.verletDist, hard.verlet, WORLDS[1].verlet) == (-0.6, -0.6, -0.6)


@pytest.mark.parametrize("world", WORLDS, ids=lambda w: w.name)
def test_pairs_are_bonded(world):
    ids = build(world, [(0, 3), (1, 3), (2.1, 3)])
    assert world.bond([(ROCK, ids)]) == 1  # the third disk is 0.1 ℓ away, more than Δ = 0.02


@pytest.mark.parametrize("world", WORLDS, ids=lambda w: w.name)
def test_disk_slides_on_the_wall(world):
    """tan 45° > 3 μ for a disk that may roll: it slides with g (sin θ − μ cos θ), less what YADE's damping of the
    forces takes.
    """
    (i,) = build(world, [(0, 0.5)], slope=math.pi / 4)
    O.run(round(1.0 / O.dt), wait=True)
    free = 9.81 * math.sin(math.pi / 4) * (1 - 0.2)
    damped = (1 - world.damping) if world.name == "soft" else 1.0
    # two per cent: the soft contact swings about its depth at first
    assert O.bodies[i].state.vel[0] == pytest.approx(free * damped * O.time, rel=0.02)


def test_the_soft_step_is_a_share_of_the_smallest_limit():
    light = dataclasses.replace(ROCK, density=625.0)
    world = worlds.Soft(stiffness=1e8, diameter=(1.0, 1.0), step_share=0.3)
    limit = world.equivalent(ROCK).step_limit
    # a quarter of the mass: half of the period
    assert world.step_for([ROCK]) == pytest.approx(0.3 * limit, rel=1e-12) and world.step_for(
        [ROCK, light]
    ) == world.step_for([light, ROCK]) == pytest.approx(0.15 * limit, rel=1e-9)
    assert WORLDS[0].step_for([ROCK, light]) == 2e-3


@pytest.mark.parametrize("given", [None, "hard", 3, worlds.Soft])
def test_what_is_no_world_is_refused(given):
    with pytest.raises(worlds.WorldError, match=r"world .*: give worlds.Hard\(...\) or worlds.Soft\(...\), or None"):
        worlds.check(given)


def test_a_damping_on_the_move_is_of_springs_alone():
    soft = worlds.Soft(stiffness=1e8, diameter=(1.0, 2.0))
    for given in (None, 0.0, 0.9):
        worlds.check_damping(soft, given)
    worlds.check_damping("hard", None)
    for world in ("hard", worlds.Hard(time_step=1e-3)):
        with pytest.raises(worlds.WorldError, match="damping_moving 0.1: hard contacts have no damping; leave it out"):
            worlds.check_damping(world, 0.1)
    with pytest.raises(worlds.WorldError, match="damping_moving 1: give a number from 0 to less than 1"):
        worlds.check_damping(soft, 1)


def test_a_slope_of_rigid_disks_refuses_a_damping_before_it_removes_anything(tmp_path):
    built = slope.Slope(section.load("circle"), {}, 0, 0, ContactDynamicsEngine(), None)
    with pytest.raises(worlds.WorldError, match="damping_moving 0.1: hard"):
        experiment.Experiment(built, tmp_path / "out", damping_moving=0.1)
    assert not (tmp_path / "out").exists()
