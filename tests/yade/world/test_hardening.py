"""harden(O): what becomes of materials, engines and the step; what is refused; scripts that run as they are."""
import math
import os
import re
import subprocess

import pytest
from shell import SCRIPTS
from yade import O, geom
from yade.minieigenHP import Vector3
from yade.nonsmooth import harden
from yade.nonsmooth.world.hardening import HardenError, lists, steps, strengths
from yade.utils import PWaveTimeStep, box, facet, sphere, wall
from yade.wrapper import (
    Bo1_Box_Aabb,
    Bo1_Facet_Aabb,
    Bo1_Sphere_Aabb,
    CohFrictMat,
    ContactDynamicsEngine,
    ForceResetter,
    FrictMat,
    GlobalStiffnessTimeStepper,
    Ig2_Box_Sphere_ScGeom,
    Ig2_Facet_Sphere_ScGeom,
    Ig2_Sphere_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_FrictMat_FrictMat_FrictPhys,
    Ip2_FrictMat_FrictMat_MindlinPhys,
    JCFpmMat,
    Law2_ScGeom_CpmPhys_Cpm,
    Law2_ScGeom_FrictPhys_CundallStrack,
    NewtonIntegrator,
    NscdMat,
    PlanarGridCollider,
    PyRunner,
    ViscElMat,
)

pytestmark = pytest.mark.usefixtures("empty")


def soft_engines(*more, law=Law2_ScGeom_FrictPhys_CundallStrack, gravity=(0, 0, -9.81)):
    return [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb(), Bo1_Box_Aabb()]),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom(), Ig2_Box_Sphere_ScGeom()],
            [Ip2_FrictMat_FrictMat_FrictPhys()],
            [law()],
        ),
        NewtonIntegrator(damping=0.4, gravity=gravity),
        *more,
    ]


def box_of_spheres(stuff=None):
    stuff = stuff or FrictMat(frictionAngle=0.4, density=2000, label="rock")
    O.materials.append(stuff)
    O.bodies.append(geom.facetBox((0, 0, 0), (2, 2, 2), wallMask=31, material=stuff))
    for k in range(27):
        O.bodies.append(sphere((k % 3 - 1, k // 3 % 3 - 1.02, k // 9 - 1), 0.45, material=stuff))
    O.engines = soft_engines()
    O.dt = 0.5 * PWaveTimeStep()


def test_a_packing_settles_and_the_floor_bears_it():
    box_of_spheres()
    soft_step, masses = O.dt, [b.state.mass for b in O.bodies]
    told = harden(O, tolerance=1e-6)
    assert O.dt > 3 * soft_step and told.step == O.dt and told.soft_step == soft_step
    assert [b.state.mass for b in O.bodies] == masses
    # the scene's, so that what is made by its label later is of the same material
    assert all(O.materials[b.material.id].label == b.material.label and b.material.id >= 0 for b in O.bodies)
    O.run(round(4 / O.dt), True)
    weight = 9.81 * sum(b.state.mass for b in O.bodies if b.dynamic)
    held = -sum(O.forces.f(b.id)[2] for b in O.bodies if not b.dynamic)
    assert held == pytest.approx(weight, rel=1e-3)  # what still moves presses by no more
    assert O.engines[-2].overlapWorst < 1e-3
    for word in ("FrictMat 'rock'", "frictionAngle = 0.4", "ContactDynamicsEngine", "times as long", "space"):
        assert word in str(told)


@pytest.mark.parametrize(
    "soft, expected",
    (
        (lambda: FrictMat(frictionAngle=0.3, density=2700), dict(frictionAngle=0.3, density=2700, restitution=0)),
        (lambda: FrictMat(density=0), dict(density=2500)),
        (
            lambda: ViscElMat(frictionAngle=0.2, en=0.6, et=0.3, tc=1e-3, mR=0.05),
            dict(restitution=0.6, rollingFriction=0.025),
        ),
        (
            lambda: CohFrictMat(
                frictionAngle=0.5,
                normalCohesion=math.pi * 1e5,
                isCohesive=True,
                momentRotationLaw=True,
                etaRoll=0.2,
                etaTwist=0.1,
            ),
            dict(tensileStrength=1e5, rollingFriction=0.1, twistingFriction=0.05, bondsToAll=True),
        ),
        (
            lambda: CohFrictMat(isCohesive=False, normalCohesion=1e5, momentRotationLaw=False, etaRoll=0.2),
            dict(tensileStrength=0, rollingFriction=0),
        ),
    ),
)
def test_a_material_keeps_its_strengths(soft, expected):
    hard, told = strengths.hard_material(soft())
    assert isinstance(hard, NscdMat)
    for name, value in expected.items():
        assert getattr(hard, name) == pytest.approx(value, rel=1e-12), name
    assert "dropped" in told


def test_cohesion_in_the_plane_is_per_metre_of_thickness():
    """A force c R² of YADE's on two disks of radius R is σ ℓ."""
    radius, c = 0.3, 1e5
    hard, _ = strengths.hard_material(CohFrictMat(normalCohesion=c, isCohesive=True), disk_radius=radius)
    assert hard.tensileStrength * 2 * radius == pytest.approx(c * radius**2, rel=1e-12)


def test_restitution_comes_from_the_functor_or_the_caller():
    box_of_spheres()
    O.engines[2].physDispatcher.functors = [Ip2_FrictMat_FrictMat_MindlinPhys(en=0.7)]
    harden(O)
    assert {b.material.restitution for b in O.bodies} == {0.7}
    O.reset()
    box_of_spheres()
    harden(O, restitution=0.2)
    assert {b.material.restitution for b in O.bodies} == {0.2}


def test_the_step_is_a_tenth_of_the_smallest_diameter_at_the_greatest_speed():
    low, high = (0, 0, 0), (1, 1, 5)
    step = steps.hard_step([0.2, 0.5], [3.0], (0, 0, -10), low, high, 1e-5)
    assert step == pytest.approx(0.1 * 0.4 / 10.0, rel=1e-12)  # sqrt(2 g 5 m) = 10 m/s
    assert steps.hard_step([0.2], [20.0], (0, 0, -10), low, high, 1e-5) == pytest.approx(0.1 * 0.4 / 20, rel=1e-12)
    assert steps.hard_step([0.2], [0.0], (0, 0, 0), low, high, 1e-5) == pytest.approx(1e-4)
    with pytest.raises(HardenError, match="no sphere"):
        steps.hard_step([], [1.0], (0, 0, -10), low, high, 1e-5)


def test_engines_act_after_the_same_time():
    box_of_spheres()
    O.engines = O.engines + [PyRunner(command="pass", iterPeriod=1000, label="looks"), GlobalStiffnessTimeStepper()]
    soft_step = O.dt
    told = harden(O)
    (looks,) = [e for e in O.engines if e.label == "looks"]
    assert looks.iterPeriod * O.dt == pytest.approx(1000 * soft_step, abs=0.5 * O.dt)
    assert not any(isinstance(e, GlobalStiffnessTimeStepper) for e in O.engines)
    assert "GlobalStiffnessTimeStepper" in str(told)


def test_what_stays_in_the_plane_is_solved_there():
    O.materials.append(FrictMat())
    O.bodies.append(box((0, -1, 0), (5, 1, 1), fixed=True))
    for x in (0, 1):
        body = sphere((x, 0.5, 0), 0.5)
        body.state.blockedDOFs = "zXY"
        O.bodies.append(body)
    O.engines = soft_engines(gravity=(0, -9.81, 0))
    O.dt = 1e-5
    harden(O)
    assert any(isinstance(e, PlanarGridCollider) for e in O.engines)
    O.run(20, True)
    assert O.forces.f(0)[1] == pytest.approx(-2 * O.bodies[1].state.mass * 9.81, rel=1e-6)


def test_a_material_that_is_rigid_already_stays():
    box_of_spheres()
    own = NscdMat(density=2000, frictionAngle=0.1)  # of one body alone, and not among O.materials
    O.bodies[-1].material = own
    harden(O)
    assert O.bodies[-1].material == own
    assert all(isinstance(b.material, NscdMat) for b in O.bodies)


def test_a_step_of_the_caller_s_own():
    for step, expected in ((2e-4, 2e-4), ("soft", None)):
        O.reset()
        box_of_spheres()
        soft_step = O.dt
        harden(O, step=step)
        assert O.dt == (expected or soft_step)


def test_a_loop_that_does_not_run_says_nothing():
    """Nor does it become one that does."""
    box_of_spheres()
    idle = InteractionLoop([], [], [Law2_ScGeom_CpmPhys_Cpm()], dead=True)
    O.engines = O.engines[:2] + [idle] + O.engines[2:]
    harden(O)
    loops = [e for e in O.engines if isinstance(e, InteractionLoop) and not e.dead]
    assert len(loops) == 1 and len(loops[0].geomDispatcher.functors) > 0
    assert O.engines[2].dead and len(O.engines[2].geomDispatcher.functors) == 0


def unchanged(state):
    return [type(b.material).__name__ for b in O.bodies], [type(e).__name__ for e in O.engines], O.dt


@pytest.mark.parametrize(
    "spoil, message",
    (
        (lambda: setattr(O, "periodic", True), "periodic"),
        (lambda: O.bodies.appendClumped([sphere((9, 9, 9), 0.2), sphere((9, 9, 9.2), 0.2)]), "clump"),
        (lambda: setattr(O, "engines", O.engines[:2] + O.engines[3:]), "no InteractionLoop"),
        (lambda: setattr(O, "engines", O.engines[:3]), "NewtonIntegrator"),
        (
            lambda: setattr(O.engines[2].lawDispatcher, "functors", [Law2_ScGeom_CpmPhys_Cpm()]),
            "Law2_ScGeom_CpmPhys_Cpm",
        ),
        (lambda: setattr(O.bodies[30], "material", JCFpmMat(label="jointed")), "JCFpmMat"),
        (lambda: setattr(O.engines[3], "mask", 2), "mask = 2"),
    ),
)
def test_what_has_no_counterpart_is_refused_and_the_scene_stays(spoil, message):
    box_of_spheres()
    spoil()
    before = unchanged(None)
    with pytest.raises(HardenError, match=re.escape(message)):
        harden(O)
    assert unchanged(None) == before


def test_the_law_of_the_script_tells_no_elastic_energy():
    box_of_spheres()
    law = O.engines[2].lawDispatcher.functors[0]
    harden(O)
    O.run(50, True)
    assert law.elasticEnergy() == 0
    assert law.plasticDissipation() == O.engines[-2].slidingLoss


SCRIPT = """
from yade import geom
O.bodies.append(facet([(-5, -5, 0), (5, -5, 0), (0, 5, 0)]))
O.bodies.append(sphere((0, 0, 0.6), 0.5))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(damping=0.3, gravity=(0, 0, -9.81)),
    PyRunner(command="grow()", iterPeriod=100, nDo=2),
]
O.dt = 0.5 * PWaveTimeStep()
def grow():
    O.bodies.append(sphere((0, 2, 0.5), 0.3, material=O.materials[0]))
from yade import qt
qt.View()
O.run(400, True)
O.dt = 0.4 * PWaveTimeStep()
O.run(100, True)
print("AT", O.time, len(O.bodies), O.bodies[1].state.pos[2], type(O.bodies[2].material).__name__)
"""


def launch(folder, *words):
    return subprocess.run(
        [SCRIPTS / "yade-nonsmooth", "--threads", "1", *words],
        cwd=folder,
        capture_output=True,
        text=True,
        stdin=subprocess.DEVNULL,
    )


def test_a_script_runs_hard_as_it_is(tmp_path):
    (tmp_path / "soft.py").write_text(SCRIPT)
    done = launch(tmp_path, "--hard", "soft.py")
    assert done.returncode == 0, done.stderr
    (said,) = re.findall(r"AT (\S+) (\d+) (\S+) (\w+)", done.stdout)
    time, bodies, height, material = float(said[0]), int(said[1]), float(said[2]), said[3]
    soft_step = 0.5 * 0.5 / math.sqrt(1e7 / 1e3)  # 0.5 R sqrt(rho/E) of YADE's default material
    assert bodies >= 3 and material == "NscdMat"
    assert height == pytest.approx(0.5, abs=1e-3)  # it lies on the facet, whatever springs would let it sink
    # 400 of these steps, and 100 of the ones that the script chose next, 0.4/0.5 as long or less (a smaller sphere came)
    assert 400 * soft_step < time < 500 * soft_step * 1.1
    assert "rigid" in done.stdout and "wall time [s]" in done.stdout


def test_both_ways_are_told_beside_each_other(tmp_path):
    (tmp_path / "soft.py").write_text(SCRIPT)
    done = launch(tmp_path, "--both", "--time", "1.1", "soft.py")
    assert done.returncode == 0, done.stderr
    (steps,) = re.findall(r"^steps\s+(\d+)\s+(\d+)", done.stdout, re.M)
    assert int(steps[0]) > 3 * int(steps[1]) > 0


@pytest.mark.parametrize(
    "words, message",
    (
        (("--hard", "--both", "soft.py"), "give one of them"),
        (("--time", "1", "soft.py"), "--time is for --hard and --both"),
        (("--hard", "--time", "-1", "soft.py"), "positive"),
        (("--hard", "none.py"), "cannot be read"),
    ),
)
def test_wrong_options_are_refused(tmp_path, words, message):
    (tmp_path / "soft.py").write_text(SCRIPT)
    done = launch(tmp_path, *words)
    assert done.returncode != 0 and message in done.stdout + done.stderr
