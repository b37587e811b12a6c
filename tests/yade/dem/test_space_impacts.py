"""Impacts of spheres in space: the first four of the benchmark tests of Chung and Ooi (2011), Granular Matter 13,
643-656, as far as rigid bodies have an answer. Radii, speeds, friction and restitution are those of YADE's scripts of
the same names; stiffness, and how long an impact takes, have no counterpart.
"""
import math

import pytest
from yade import O
from yade.nonsmooth import space
from yade.utils import facet, sphere, wall
from yade.wrapper import NscdMat

pytestmark = pytest.mark.usefixtures("empty")


def material(friction=0.0, restitution=1.0):
    O.materials.append(NscdMat(density=2700, frictionAngle=math.atan(friction), restitution=restitution))
    return O.materials[-1]


def ball(place, radius, speed, stuff):
    body = O.bodies[O.bodies.append(sphere(place, radius, material=stuff))]
    body.state.vel = speed
    return body


def run(time, steps=40):
    O.engines = space.engines(gravity=(0, 0, 0), tolerance=1e-10)
    O.dt = time / steps
    O.run(steps, True)


def plane(stuff, kind):
    if kind == "wall":
        O.bodies.append(wall(0, axis=0, material=stuff))
        return
    far = 3.0
    corners = [(0, -far, -far), (0, far, -far), (0, far, far), (0, -far, far)]
    for k in (1, 2):
        O.bodies.append(facet([corners[0], corners[k], corners[k + 1]], material=stuff))


planes = pytest.mark.parametrize("kind", ("wall", "facets"))


@pytest.mark.parametrize("radius, speed", ((0.010, 10.0), (0.010, 0.2)))
def test_1_two_equal_spheres_exchange_their_velocities(radius, speed):
    stuff = material(friction=0.35)
    left = ball((-1.3 * radius, 0, 0), radius, (speed, 0, 0), stuff)
    right = ball((1.3 * radius, 0, 0), radius, (-speed, 0, 0), stuff)
    run(1.2 * radius / speed)
    # by momentum and energy; the solver's tolerance is 1e-10
    assert left.state.vel == pytest.approx((-speed, 0, 0), rel=1e-9, abs=1e-12)
    assert right.state.vel == pytest.approx((speed, 0, 0), rel=1e-9, abs=1e-12)


@planes
def test_2_a_sphere_comes_back_from_a_plane_as_fast_as_it_came(kind):
    stuff = material(friction=0.35)
    plane(stuff, kind)
    one = ball((-0.13, 0, 0), 0.1, (0.2, 0, 0), stuff)
    run(0.06 / 0.2)
    assert one.state.vel == pytest.approx((-0.2, 0, 0), rel=1e-9, abs=1e-12)


@planes
@pytest.mark.parametrize("restitution", [0.1 * k for k in range(11)])
def test_3_restitution_is_what_was_given(kind, restitution):
    stuff = material(restitution=restitution)
    plane(stuff, kind)
    one = ball((-0.033, 0, 0), 0.025, (3.9, 0, 0), stuff)
    run(0.016 / 3.9)
    assert one.state.vel[0] == pytest.approx(-3.9 * restitution, rel=1e-9, abs=1e-9)


@planes
@pytest.mark.parametrize("angle", (2, 5, 10, 20, 30, 40, 50, 60, 70, 85))
def test_4_an_oblique_impact_slides_or_comes_to_roll(kind, angle):
    friction, restitution, radius, speed = 0.092, 0.98, 0.0025, 3.9
    stuff = material(friction, restitution)
    plane(stuff, kind)
    normal, along = speed * math.cos(math.radians(angle)), speed * math.sin(math.radians(angle))
    one = ball((-1.3 * radius, 0, 0), radius, (normal, 0.6 * along, 0.8 * along), stuff)
    run(0.6 * radius / normal)
    # impulses over the mass: the normal one (1 + e) v_n, the tangential one what friction allows, or what stops the
    # point that touches, 2/7 of its speed
    change = min(friction * (1 + restitution) * normal, 2 / 7 * along)
    slides = change < 2 / 7 * along
    assert slides == (math.tan(math.radians(angle)) > 3.5 * friction * (1 + restitution))
    left = along - change
    assert one.state.vel == pytest.approx((-restitution * normal, 0.6 * left, 0.8 * left), rel=1e-8)
    # torque R x the tangential impulse over 2/5 m R²; the plane is on the side of +x, so that it rolls about n x v
    spin = 2.5 * change / radius
    assert one.state.angVel == pytest.approx((0, 0.8 * spin, -0.6 * spin), rel=1e-8)
