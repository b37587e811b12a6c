"""Walls in the soft world: the strengths of the hard law, contact by contact, and their fall with slip."""
import dataclasses
import math

import numpy as np
import pytest
from soft_scenes import ROCK, SIGMA, WALL
from yade import O
from yade.nonsmooth import scene, section, soft, worlds
from yade.wrapper import BondEllipseEngine, WallPhys

RADIUS, LENGTH, E = 0.5, 1.0, 1e9
F_A = SIGMA * LENGTH
WEAK = dataclasses.replace(
    WALL,
    bonded=False,
    slip_weakening=section.SlipWeakening("step", critical_slip=0.05, friction=0.1, tensile_strength=0.0),
)
# as in test_soft.py: a ramp overshoots by less than a thousandth, springs turn the load by as much
RAMP = 5e-3


pytestmark = pytest.mark.usefixtures("empty")


def on_a_wall(m, model="cohesion_moment", turned=False, gap=0.0, bond=True, young=E, **more):
    """A disk at rest on a wall of the material, no gravity; returns its body. ``young``: the wall's modulus [Pa]."""
    e = soft.equivalent(ROCK, E, model, diameter=LENGTH, **{**dict(damping=0.5), **more})
    disks, wall = soft.material(e), soft.wall_material(e, m, young=young)
    O.materials.append([disks, wall])
    # enough pieces that the joint at x = 0 is near the disk
    O.bodies.append(scene.segments([(-5, 0), (5, 0)], wall, piece=2.5, sense=1))
    body = O.bodies[O.bodies.append(scene.disk((0.3, RADIUS + gap), RADIUS, disks))]
    O.engines, O.dt = soft.engines(e, gravity=(0, 0, 0)), 0.5 * e.step_limit
    if bond:
        assert soft.bond_walls() == (1 if m.bonded else 0)
    return body


def load(body, normal=0.0, shear=0.0, torque=0.0):
    O.forces.setPermF(body.id, (shear, -normal, 0))
    O.forces.setPermT(body.id, (0, 0, torque + RADIUS * shear))  # so that nothing rolls


def breaks_at(body, steps=8000, **most):
    """The share of the loads at which the wall's bond breaks."""
    contact = next(i for i in O.interactions if body.id in (i.id1, i.id2))
    for k in range(steps):
        load(body, **{key: value * 1.2 * k / steps for key, value in most.items()})
        O.step()
        if not contact.phys or not contact.phys.bonded:
            return 1.2 * k / steps
    return None


@pytest.mark.parametrize("of_wall, ratio", [(E, 0.3), (3 * E, 0.3), (E, 0.7)])
def test_springs_at_a_wall_are_force_over_displacement(of_wall, ratio):
    """A bond that is strained by given motions, each below its threshold. Paired as YADE pairs disks: k_n = 2 R E₁
    E₂/(E₁ + E₂), E R for equal ones; k_s is ``ratio`` times that; and k_r = k_s R²."""
    k_n = 2 * RADIUS * E * of_wall / (E + of_wall)
    k_s = ratio * k_n
    k_r, steps = k_s * RADIUS**2, 20
    for velocity, spin, stiffness in (((0, -1, 0), 0, k_n), ((1, 0, 0), 0, k_s), ((-RADIUS, 0, 0), 1, k_r)):
        O.reset()
        body = on_a_wall(WALL, young=of_wall, shear_ratio=ratio)
        body.state.blockedDOFs = "xyzXYZ"
        speed = 0.01 * F_A / (stiffness * steps * O.dt)  # comes to a hundredth of F_a [N], or to F_a m of torque
        body.state.vel, body.state.angVel = [speed * v for v in velocity], (0, 0, speed * spin)

        def borne():
            """By the spring that is strained: the force against the motion, or the rolling spring's torque."""
            force = O.forces.f(body.id)
            if not spin:
                return -sum(f * v for f, v in zip(force, velocity))
            assert abs(force[0]) < 1e-3 * F_A * 0.01  # it rolls: next to no shear
            return -O.forces.t(body.id)[2]

        O.run(5, wait=True)
        before = borne()
        O.run(steps, wait=True)
        assert borne() - before == pytest.approx(0.01 * F_A, rel=1e-3)  # the lever is shorter by the overlap
        phys = next(i.phys for i in O.interactions if body.id in (i.id1, i.id2))
        assert phys.bonded and (phys.kn, phys.ks, phys.kr) == pytest.approx((k_n, k_s, k_r), rel=1e-12)


@pytest.mark.parametrize("model", ["cohesion_moment", "jcfpm"])
def test_a_bond_to_a_wall_breaks_at_the_thresholds(model):
    assert breaks_at(on_a_wall(WALL, model), normal=-F_A) == pytest.approx(1, rel=RAMP)
    O.reset()
    assert breaks_at(on_a_wall(WALL, model), shear=0.5 * F_A) == pytest.approx(1, rel=RAMP)
    O.reset()
    assert breaks_at(on_a_wall(WALL, model), torque=0.2 * LENGTH * F_A) == pytest.approx(1, rel=RAMP)


def test_combined_loads_break_a_bond_to_a_wall_where_the_law_says():
    # |T| = μ (F_a + N) with N = x F_a, T = x F_a: x = μ/(1 − μ) = 1 for μ = 0.5
    assert breaks_at(on_a_wall(WALL), normal=F_A, shear=F_A) == pytest.approx(1, rel=RAMP)
    O.reset()
    # under tension, N = −x F_a/2, T = x F_a: x = μ/(1 + μ/2) = 0.4
    assert breaks_at(on_a_wall(WALL), normal=-0.5 * F_A, shear=F_A) == pytest.approx(0.4, rel=RAMP)


def test_a_bond_over_a_gap_is_born_without_force():
    body = on_a_wall(WALL, gap=0.01)
    O.step()
    assert O.forces.f(body.id).norm() == 0
    assert breaks_at(body, normal=-F_A) == pytest.approx(1, rel=RAMP)


def test_residual_friction_rules_once_the_bond_is_lost():
    body = on_a_wall(WALL, bond=False)
    body.state.blockedDOFs = "zXYZ"
    load(body, normal=2e4)
    O.run(4000, wait=True)
    body.state.vel = (1, 0, 0)
    O.run(200, wait=True)
    assert O.forces.f(body.id)[0] == pytest.approx(-0.3 * 2e4, rel=0.01)  # the normal force still trembles a little


def slide(world, seconds=0.5):
    """A disk that may not turn, pushed along a weakening wall; rows (time, slip, speed)."""
    O.reset()
    rock = O.materials[O.materials.append(world.material(ROCK))]
    wall = O.materials[O.materials.append(world.wall_material(WEAK))]
    O.bodies.append(scene.segments([(-2, 0), (8, 0)], wall, piece=0.11, sense=1))  # many joints on the way
    body = O.bodies[O.bodies.append(scene.disk((0, RADIUS), RADIUS, rock))]
    body.state.blockedDOFs = "zXYZ"
    O.engines, O.dt = world.engines(gravity=(4.0, -9.81, 0)), world.step_for([ROCK])
    rows = []
    while O.time < seconds:
        O.run(max(1, round(5e-3 / O.dt)), wait=True)
        rows.append((O.time, wall.slipOf(body.id), body.state.vel[0]))
    return np.array(rows)


def test_a_wall_weakens_after_the_same_slip_in_both_worlds():
    hard = slide(worlds.Hard(time_step=1e-3))
    gentle = slide(worlds.Soft(stiffness=1e9, diameter=(1.0, 1.0), damping=0.0))
    for rows in (hard, gentle):
        time, slip, speed = rows.T
        weak = int(np.argmax(slip > 0.05))
        before = np.polyfit(time[2:weak], speed[2:weak], 1)[0]
        after = np.polyfit(time[weak + 2 :], speed[weak + 2 :], 1)[0]
        # friction 0.3 until the slip is D_c, 0.1 from then on; an undamped soft contact swings, and loses up to 2 % at
        # joints
        assert before == pytest.approx(4.0 - 0.3 * 9.81, rel=0.05)
        assert after == pytest.approx(4.0 - 0.1 * 9.81, rel=0.03)
    weak_hard, weak_soft = (rows[np.argmax(rows[:, 1] > 0.05), 0] for rows in (hard, gentle))
    # until the spring is pressed in there is no friction: a lead of μ g/ω = 6 mm/s, which is 2 % of the time, and a row
    # is as much
    assert weak_soft == pytest.approx(weak_hard, rel=0.04)


def test_a_contact_that_sticks_does_not_slip():
    world = worlds.Soft(stiffness=1e8, diameter=(1.0, 1.0))
    rock = O.materials[O.materials.append(world.material(ROCK))]
    wall = O.materials[O.materials.append(world.wall_material(WEAK))]
    O.bodies.append(scene.segments([(-2, 0), (8, 0)], wall, piece=1, sense=1))
    body = O.bodies[O.bodies.append(scene.disk((0, RADIUS), RADIUS, rock))]
    body.state.pos -= (0, body.state.mass * 9.81 / (1e8 * RADIUS), 0)  # where its spring bears it
    body.state.blockedDOFs = "zXYZ"
    # the springs swing to twice 1.0, below 0.3 · 9.81
    O.engines, O.dt = world.engines(gravity=(1.0, -9.81, 0)), world.step_for([ROCK])
    O.run(2000, wait=True)
    assert wall.slipOf(body.id) == 0.0
    # the rest of the swing
    assert tuple(O.forces.f(body.id))[:2] == pytest.approx((-1.0 * body.state.mass, 9.81 * body.state.mass), rel=0.01)


def test_rolling_is_resisted_as_the_wall_says():
    """Without a bond a torque below μ_r ℓ N holds the disk, one above turns it."""
    for share, turns in ((0.9, False), (1.1, True)):
        O.reset()
        body = on_a_wall(dataclasses.replace(WALL, bonded=False))
        load(body, normal=1e5)
        O.run(3000, wait=True)
        for k in range(3000):
            load(body, normal=1e5, torque=share * 0.1 * LENGTH * 1e5 * min(1.0, k / 2000))
            O.step()
        moved = abs(body.state.rot()[2])
        assert (moved > 1e-3) == turns, moved


def test_a_wall_contact_is_saved_with_its_springs(tmp_path):
    body = on_a_wall(WALL)
    load(body, normal=1e4, shear=2e3, torque=1e3)
    O.run(3000, wait=True)
    O.save(str(tmp_path / "wall.yade.gz"))
    before = next(i.phys for i in O.interactions if isinstance(i.phys, WallPhys))
    seen = (before.bonded, before.rollingTorque, tuple(before.shearForce), before.length)
    O.load(str(tmp_path / "wall.yade.gz"))
    after = next(i.phys for i in O.interactions if isinstance(i.phys, WallPhys))
    assert (after.bonded, after.rollingTorque, tuple(after.shearForce), after.length) == seen
    assert math.isfinite(after.kn) and after.kn == pytest.approx(E * RADIUS)


def test_a_ductile_bond_to_a_wall_yields_and_breaks_at_its_ellipse():
    e = soft.equivalent(ROCK, E, diameter=LENGTH, damping=0.5)
    disks, wall = soft.material(e), soft.wall_material(e, WALL)
    O.materials.append([disks, wall])
    O.bodies.append(scene.segments([(-5, 0), (5, 0)], wall, sense=1))
    body = O.bodies[O.bodies.append(scene.disk((0.3, RADIUS), RADIUS, disks))]
    O.engines, O.dt = soft.engines(e, gravity=(0, 0, 0), ductile=True), 0.5 * e.step_limit
    assert soft.bond_walls(fragile=False) == 1
    O.engines[-2].iterPeriod = 1
    body.state.blockedDOFs = "xyzXYZ"
    steps = 4000
    body.state.vel = (0, 1.2 * 0.02 * LENGTH / (steps * O.dt), 0)
    while any(i.isReal and i.phys.bonded for i in O.interactions):
        height, borne = body.state.pos[1] - RADIUS, next(i for i in O.interactions if i.isReal).phys.normalForce.norm()
        O.step()
        assert height < 0.03 * LENGTH
    assert height == pytest.approx(0.02 * LENGTH, rel=1e-3)  # ε_n ℓ, to a step
    assert borne == pytest.approx(F_A, rel=1e-6)


def test_an_ellipse_without_size_is_refused():
    body = on_a_wall(WALL)
    wall = next(i.id1 for i in O.interactions if body.id == i.id2)
    followed = BondEllipseEngine()
    for axes in ((0.0, 0.1), (0.1, 0.0), (-1.0, 0.1), (0.1, math.nan)):
        with pytest.raises(ValueError, match="half-axes must be positive"):
            followed.add(wall, body.id, *axes, 0.3, 0.1)
    followed.add(wall, body.id, 0.1, 0.1, 0.3, 0.1)
    assert followed.count == 1
