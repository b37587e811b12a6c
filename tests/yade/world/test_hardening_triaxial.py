"""A TriaxialStressController with rigid contacts: walls bear the stresses that it asks for, and strains go at its rate."""
import math

import numpy as np
import pytest
from yade import O, pack
from yade.nonsmooth import harden
from yade.utils import aabbWalls, unbalancedForce
from yade.wrapper import (
    Bo1_Box_Aabb,
    Bo1_Sphere_Aabb,
    FrictMat,
    ForceResetter,
    Ig2_Box_Sphere_ScGeom,
    Ig2_Sphere_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_FrictMat_FrictMat_FrictPhys,
    Law2_ScGeom_FrictPhys_CundallStrack,
    NewtonIntegrator,
    TriaxialCompressionEngine,
    TriaxialStateRecorder,
    TriaxialStressController,
)

pytestmark = pytest.mark.usefixtures("empty")

STRESS = 4e4


def sample(controller, *others, damping=0.2):
    """A loose cloud of some hundred spheres between six walls; the walls come first, as the controller expects."""
    for name, friction in (("spheres", 0.4), ("walls", 0)):
        stuff = FrictMat(young=5e7, poisson=0.3, frictionAngle=friction, density=2600, label=name)
        O.materials.append(stuff)
    O.bodies.append(aabbWalls([(0, 0, 0), (1, 1, 1)], thickness=0, material="walls"))
    cloud = pack.SpherePack()
    cloud.makeCloud((0, 0, 0), (1, 1, 1), rMean=0.09, rRelFuzz=0.2, num=110, seed=2)
    cloud.toSimulation(material="spheres")
    loop = InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Box_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_FrictPhys()],
        [Law2_ScGeom_FrictPhys_CundallStrack()],
    )
    collider = InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Box_Aabb()])
    O.engines = [ForceResetter(), collider, loop, controller, *others, NewtonIntegrator(damping=damping)]
    O.dt = 1e-4


def isotropic(**more):
    usual = dict(goal1=-STRESS, goal2=-STRESS, goal3=-STRESS, internalCompaction=False, stressMask=7)
    return TriaxialStressController(thickness=0, max_vel=0.5, **{**usual, **more})


def settle(controller, mean=STRESS):
    """Steps until the sample rests under the mean stress, by the test that YADE's scripts make."""
    for _ in range(80):
        O.run(20, True)
        if unbalancedForce() < 0.01 and abs(controller.meanStress + mean) < 0.01 * mean:
            return
    raise AssertionError(f"mean stress {controller.meanStress}, unbalanced {unbalancedForce()}")


def test_walls_bear_the_stress_that_is_asked_for():
    triax = isotropic()
    sample(triax)
    told = dict(harden(O).rows)
    assert "plates that bear it" in told["TriaxialStressController"]
    assert "NewtonIntegrator (damping = 0)" in told["NewtonIntegrator (damping = 0.2)"]
    assert not any("PyRunner" in what for what in told)  # what harden() adds is none of the script's
    settle(triax)
    # each pair of walls bears the goal, to what the sample still moves
    assert [triax.stress(k)[axis] for k, axis in ((0, 0), (2, 1), (4, 2))] == pytest.approx([-STRESS] * 3, rel=0.02)
    assert 0.45 < 1 - triax.porosity < 0.64  # between loose and close packings of spheres with friction
    # opposite walls bear the same, by momentum
    for low, high, axis in ((0, 1, 0), (2, 3, 1), (4, 5, 2)):
        assert triax.stress(low)[axis] == pytest.approx(triax.stress(high)[axis], rel=0.02)


def test_one_axis_strains_at_the_rate_and_the_others_bear_their_stress():
    triax = isotropic()
    sample(triax)
    harden(O)
    settle(triax)
    rate = 0.1
    triax.stressMask, triax.goal2 = 5, -rate
    O.run(40, True)
    begun, at, sides, along = triax.strain[1], O.time, [], []
    for _ in range(150):
        O.run(2, True)
        sides.append(0.5 * (triax.stress(0)[0] + triax.stress(4)[2]))
        along.append(triax.stress(2)[1])
    # the strain is logarithmic, and so is the rate
    assert triax.strain[1] - begun == pytest.approx(-rate * (O.time - at), rel=0.01)
    assert np.mean(sides) == pytest.approx(-STRESS, rel=0.05)
    # sin φ of some hundred spheres of μ = 0.42 between smooth walls; more than none, less than twice its arc tangent
    angle = math.asin((np.mean(along) - np.mean(sides)) / (np.mean(along) + np.mean(sides)))
    assert 0.25 < angle < 0.8


def test_a_saved_test_goes_on_with_the_same_bits(tmp_path):
    triax = isotropic()
    sample(triax)
    harden(O)
    O.run(200, True)
    O.save(str(tmp_path / "test.yade"))

    def later():
        O.run(60, True)
        return [tuple(b.state.pos) + tuple(b.state.vel) for b in O.bodies]

    expected = later()
    O.load(str(tmp_path / "test.yade"))
    assert later() == expected


def test_a_wall_that_nothing_holds_goes_at_its_speed():
    triax = isotropic()
    sample(triax)
    for k in [b.id for b in O.bodies if b.dynamic and max(abs(x - 0.5) for x in b.state.pos) > 0.3]:
        O.bodies.erase(k)  # what the walls would meet
    harden(O)
    O.run(1, True)
    gap = O.bodies[1].state.pos[0]
    O.run(10, True)
    assert gap - O.bodies[1].state.pos[0] == pytest.approx(10 * 0.5 * O.dt, rel=1e-9)


def test_a_wall_that_is_driven_back_bears_its_force_and_no_more():
    triax = isotropic()
    sample(triax)
    pusher, *others = [b for b in O.bodies if b.dynamic]
    for body in others[1:]:
        O.bodies.erase(body.id)
    others[0].state.pos = (0.5, 0.5, 0.5)
    harden(O)
    # a sphere that nothing stops against the wall at high x
    pusher.state.pos = (O.bodies[1].state.pos[0] - pusher.shape.radius, 0.5, 0.5)
    pusher.state.blockedDOFs = "XYZ"
    pusher.state.mass, pusher.state.vel = 1e9, (0.2, 0, 0)
    O.run(4, True)
    # at constant speed inertia takes nothing; the area of this step and that which the controller divides by differ by
    # the way of a step
    assert triax.stress(1)[0] == pytest.approx(-STRESS, rel=0.02)


def test_growing_spheres_become_walls_that_press():
    triax = isotropic(internalCompaction=True)
    sample(triax)
    assert "in the place of growing spheres" in dict(harden(O).rows)["TriaxialStressController"]
    radii = [b.shape.radius for b in O.bodies if b.dynamic]
    settle(triax)
    assert [b.shape.radius for b in O.bodies if b.dynamic] == radii


def test_the_older_engine_compacts_and_loads_and_its_recorder_writes(tmp_path):
    triax = TriaxialCompressionEngine(
        internalCompaction=False,
        sigmaIsoCompaction=-STRESS,
        sigmaLateralConfinement=-STRESS,
        max_vel=0.5,
        strainRate=0.1,
        thickness=0,
        StabilityCriterion=0.02,
        noFiles=True,
    )
    sample(triax, TriaxialStateRecorder(iterPeriod=10, file=str(tmp_path / "states.txt")))
    harden(O)
    for _ in range(60):
        O.run(20, True)
        if triax.currentState == 3:
            break
    assert triax.currentState == 3  # it has found rest under the stress
    triax.currentStrainRate = triax.strainRate  # which grows to it over thousands of soft steps
    O.run(20, True)
    begun, at = triax.strain[1], O.time
    O.run(100, True)
    assert triax.strain[1] - begun == pytest.approx(-0.1 * (O.time - at), rel=0.01)
    assert triax.stress(0)[0] == pytest.approx(-STRESS, rel=0.2)  # one moment of a small sample
    assert np.loadtxt(tmp_path / "states.txt", skiprows=1).shape[0] >= 10
