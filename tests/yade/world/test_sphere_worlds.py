"""One scene of spheres in two worlds: weight, rolling and sliding by the same numbers; the step of springs; what is
refused.
"""
import math

import pytest
from yade import O
from yade.nonsmooth.world import sphere_worlds as worlds
from yade.utils import box, facet, sphere

pytestmark = pytest.mark.usefixtures("empty")

R, G = 0.5, 9.81
ROCK = worlds.SphereMaterial(friction=0.5, rolling_friction=0.02)
HARD = worlds.HardSpheres(time_step=1e-3, tolerance=1e-9)
# 1e8 Pa: the weight of a sphere, 1.3e4 N, sinks by 0.026 % of a radius; no damping, which would brake what rolls
SOFT = worlds.SoftSpheres(stiffness=1e8, diameter=(2 * R, 2 * R), damping=0.0)
BOTH = pytest.mark.parametrize("world", (HARD, SOFT), ids=("hard", "soft"))


def stand(world, stuff=ROCK, speed=0.0, floor="box", sink=0.0):
    made = O.materials[O.materials.append(world.material(stuff))]
    if floor == "box":
        O.bodies.append(box((0, 0, -1), (50, 50, 1), fixed=True, material=made))
    else:
        O.bodies.append(facet([(-50, -50, 0), (50, -50, 0), (0, 90, 0)], material=made))
    ball = O.bodies[O.bodies.append(sphere((0, 0, R - sink), R, material=made))]
    ball.state.vel, ball.state.angVel = (speed, 0, 0), (0, speed / R, 0)
    O.engines, O.dt = world.engines(), world.step_for([stuff])
    return ball


def run(seconds):
    O.run(max(1, round(seconds / O.dt)), True)


@BOTH
@pytest.mark.parametrize("floor", ("box", "facet"))
def test_rolling_resistance_is_the_same_in_both_worlds(world, floor):
    sink = 0 if world is HARD else 4 / 3 * math.pi * R**3 * 2500 * G / (SOFT.stiffness * R)
    ball = stand(world, speed=1.0, floor=floor, sink=sink)
    run(0.5)
    deceleration = 0.02 * 2 * R * G / (1.4 * R)  # torque μ_r ℓ N, ℓ the diameter, against 7/5 m R a
    # springs wind up before they yield: some per cent of half a second
    off = 1e-6 if world is HARD else 0.05
    assert 1 - ball.state.vel[0] == pytest.approx(deceleration * O.time, rel=off)
    assert ball.state.angVel[1] * R == pytest.approx(ball.state.vel[0], rel=off)


@BOTH
def test_a_sphere_that_slides_is_slowed_by_friction(world):
    stuff = worlds.SphereMaterial(friction=0.3)
    ball = stand(world, stuff, speed=2.0, sink=0 if world is HARD else 1.2e-4)
    ball.state.angVel = (0, 0, 0)
    run(0.1)
    # springs overshoot where they begin: a sphere that is put down sinks, and presses less and more in turns
    assert 2 - ball.state.vel[0] == pytest.approx(0.3 * G * O.time, rel=1e-6 if world is HARD else 0.05)


@BOTH
def test_without_friction_nothing_turns(world):
    stuff = ROCK.smooth()
    assert (stuff.friction, stuff.rolling_friction, stuff.density) == (0, 0, ROCK.density)
    ball = stand(world, stuff, speed=2.0)
    ball.state.angVel = (0, 0, 0)
    run(0.05)
    assert ball.state.vel[0] == pytest.approx(2.0, rel=1e-12) and abs(ball.state.angVel[1]) < 1e-12


def test_the_step_of_two_equal_spheres_is_that_of_their_spring():
    """With soft shear springs the fastest motion is along the normal: ω² = 2 k_n/m, k_n = E R, and 12 contacts."""
    mass = 2500 * 4 / 3 * math.pi * R**3
    expected = 2 / math.sqrt(12 * 2 * 1e8 * R / mass)
    assert worlds.stable_step(2500, 1e8, (2 * R, 2 * R), shear_ratio=0.1) == pytest.approx(expected, rel=1e-9)
    # with stiff ones it is the shear of two spheres that roll on each other: k_s (2/m + 2 R²/(2/5 m R²)) = 7 k_s/m
    expected = 2 / math.sqrt(12 * 7 * 0.5 * 1e8 * R / mass)
    assert worlds.stable_step(2500, 1e8, (2 * R, 2 * R), shear_ratio=0.5) == pytest.approx(expected, rel=1e-9)


def test_springs_of_spheres_in_a_heap_stay_calm_at_their_step():
    """Close-packed spheres under their weight gain no energy: the limit holds for all 12 contacts."""
    world = worlds.SoftSpheres(stiffness=1e7, diameter=(2 * R, 2 * R), damping=0.2, step_share=0.9)
    made = O.materials[O.materials.append(world.material(ROCK))]
    O.bodies.append(box((0, 0, -1), (50, 50, 1), fixed=True, material=made))
    for k in range(3):
        for i in range(4):
            for j in range(4):
                place = (i + 0.5 * ((j + k) % 2), math.sqrt(3) / 2 * j + k / math.sqrt(12), R + math.sqrt(2 / 3) * k)
                O.bodies.append(sphere(place, R, material=made))
    O.engines, O.dt = world.engines(gravity=(0, 0, 0)), world.step_for([ROCK])
    O.bodies[20].state.vel = (0, 0, 1e-3)
    energy = 0.5 * O.bodies[20].state.mass * 1e-6
    run(1.0)
    assert sum(0.5 * b.state.mass * b.state.vel.squaredNorm() for b in O.bodies if b.dynamic) < energy


@pytest.mark.parametrize(
    "make, said",
    (
        (lambda: worlds.HardSpheres(time_step=0), "^time_step 0: give a number above 0"),
        (lambda: worlds.HardSpheres(1e-3, tolerance=-1), "tolerance -1"),
        (lambda: worlds.SoftSpheres(0, (1, 1)), "stiffness 0"),
        (lambda: worlds.SoftSpheres(1e8, (1, 1), damping=1), "damping 1: give a number from 0 to less than 1"),
        (lambda: worlds.SoftSpheres(1e8, (2, 1)), r"diameter \(2, 1\): give \(smallest, largest\)"),
        (lambda: worlds.SoftSpheres(1e8, (1, 1), step_share=1.5), "step_share 1.5"),
        (lambda: SOFT.material(worlds.SphereMaterial(restitution=0.5)), "restitution 0.5 with soft contacts"),
        (
            lambda: worlds.SoftSpheres(1e8, (1, 1), rolling_ratio=0).material(ROCK),
            "rolling_ratio 0: the material resists rolling",
        ),
    ),
)
def test_what_a_world_refuses(make, said):
    with pytest.raises(worlds.SphereWorldError, match=said):
        make()
