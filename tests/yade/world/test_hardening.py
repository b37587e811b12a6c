"""harden(O): what becomes of materials, engines and the step; what is refused; scripts that run as they are."""
import math
import os
import re
import subprocess

import pytest
from shell import SCRIPTS
from yade import O, geom
from yade.minieigenHP import Quaternion, Vector3
from yade.nonsmooth import harden
from yade.nonsmooth.world.hardening import HardenError, comparison, lists, steps, strengths
from yade.utils import PWaveTimeStep, box, createInteraction, facet, sphere, wall
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
    Ig2_Sphere_Sphere_ScGeom6D,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_CohFrictMat_CohFrictMat_CohFrictPhys,
    Ip2_FrictMat_FrictMat_FrictPhys,
    Ip2_FrictMat_FrictMat_MindlinPhys,
    JCFpmMat,
    Law2_ScGeom6D_CohFrictPhys_CohesionMoment,
    Law2_ScGeom_CpmPhys_Cpm,
    Law2_ScGeom_FrictPhys_CundallStrack,
    MatchMaker,
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
            dict(restitution=0.6, rollingFriction=0.0125),  # a torque mR N is μ_r ℓ N, with ℓ = 4 m below
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
    hard, told = strengths.hard_material(soft(), diameter=4.0)
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


@pytest.mark.parametrize("damping", (0.0, 0.4))
def test_restitution_may_be_what_damping_leaves_of_springs(damping):
    """√((1 − λ)/(1 + λ)), and 1 where nothing takes energy; what functors and materials say holds before it."""
    box_of_spheres()
    O.engines[3].damping = damping
    harden(O, restitution="damping")
    assert {b.material.restitution for b in O.bodies} == {math.sqrt((1 - damping) / (1 + damping))}
    O.reset()
    box_of_spheres()
    O.engines[2].physDispatcher.functors = [Ip2_FrictMat_FrictMat_MindlinPhys(en=0.7)]
    harden(O, restitution="damping")
    assert {b.material.restitution for b in O.bodies} == {0.7}


def test_a_spring_and_its_rigid_contact_bounce_alike():
    """One sphere on the floor, with half of the damping that stops it: the same speed afterwards."""
    speeds = {}
    for hard in (False, True):
        O.reset()
        stuff = FrictMat(young=1e9, frictionAngle=0.3, density=2000)
        O.materials.append(stuff)
        O.bodies.append(box((0, 0, -1), (5, 5, 1), fixed=True, material=stuff))
        ball = O.bodies[O.bodies.append(sphere((0, 0, 0.502), 0.5, material=stuff))]
        ball.state.vel = (0, 0, -1)
        O.engines = soft_engines(gravity=(0, 0, 0))
        O.engines[3].damping = 0.2
        O.dt = 0.01 * PWaveTimeStep()
        if hard:
            harden(O, step=1e-3, restitution="damping")
        while ball.state.vel[2] <= 0 or any(i.isReal and not hard for i in O.interactions):
            O.run(1, True)
        speeds[hard] = ball.state.vel[2]
    # the first step of the spring is not damped as the others are
    assert speeds[True] == pytest.approx(math.sqrt(0.8 / 1.2), rel=1e-6)  # the tolerance of the solve
    assert speeds[False] == pytest.approx(speeds[True], rel=0.01)


def falling(stuffs, floor_stuff, functor):
    """Spheres of materials, 3 m apart, that fall on a floor at 1 m/s; the engines with a functor."""
    for stuff in (*stuffs, floor_stuff):
        if stuff.id < 0:
            O.materials.append(stuff)
    O.bodies.append(box((0, 0, -1), (50, 50, 1), fixed=True, material=floor_stuff))
    for k, stuff in enumerate(stuffs):
        ball = O.bodies[O.bodies.append(sphere((3 * k, 0, 0.51), 0.5, material=stuff))]
        ball.state.vel = (0, 0, -1)
    O.engines = soft_engines(gravity=(0, 0, 0))
    O.engines[2].physDispatcher.functors = [functor()]
    O.dt = 1e-5


def test_pairs_of_materials_keep_their_values():
    """A MatchMaker's restitution and friction of two materials, and of one with itself, are those of their contacts."""
    one, other, floor_stuff = (FrictMat(frictionAngle=0.5, density=2000, label=name) for name in ("a", "b", "floor"))
    falling(
        (one, other, floor_stuff),
        floor_stuff,
        lambda: Ip2_FrictMat_FrictMat_MindlinPhys(
            en=MatchMaker(matches=((one.id, floor_stuff.id, 0.9), (floor_stuff.id, other.id, 0.3), (floor_stuff.id, floor_stuff.id, 0.6))),
            frictAngle=MatchMaker(matches=((one.id, floor_stuff.id, 0.1),)),
        ),
    )  # fmt: skip
    told = harden(O, step=1e-3)
    O.run(30, True)
    assert [O.bodies[k].state.vel[2] for k in (1, 2, 3)] == pytest.approx([0.9, 0.3, 0.6], rel=1e-5)
    assert "materials #0 with #2" in str(told) and "restitution = 0.9" in str(told)
    for k in (1, 2):  # pressed down, they slide: friction of the pair, and the materials' own
        O.bodies[k].state.vel, O.bodies[k].state.pos = (2, 0, 0), (3 * k, 0, 0.5)
        O.bodies[k].state.angVel, O.bodies[k].state.blockedDOFs = (0, 0, 0), "XYZ"
    O.engines[-1].gravity = (0, 0, -10)
    O.run(100, True)
    slowed = [2 - O.bodies[k].state.vel[0] for k in (1, 2)]
    assert slowed == pytest.approx([math.tan(0.1), math.tan(0.5)], rel=1e-4)  # μ g t, 1 m/s


def test_a_pair_without_values_keeps_those_of_its_materials():
    """Two spheres that meet, with values for each of them and the floor alone: none of these is theirs."""
    one, other, floor_stuff = (FrictMat(frictionAngle=0.5, density=2000, label=name) for name in ("a", "b", "floor"))
    O.materials.append([one, other, floor_stuff])
    matches = ((0, 2, 0.9), (1, 2, 0.3))
    falling((one, other), floor_stuff, lambda: Ip2_FrictMat_FrictMat_MindlinPhys(en=MatchMaker(matches=matches)))
    for k, side in ((1, -1), (2, 1)):
        O.bodies[k].state.pos, O.bodies[k].state.vel = (0.51 * side, 0, 9), (-side, 0, 0)
    harden(O, step=1e-3)
    O.run(30, True)
    assert [O.bodies[k].state.vel[0] for k in (1, 2)] == pytest.approx([0, 0], abs=1e-5)


def test_pairs_of_a_material_that_comes_later():
    shots, steel = FrictMat(label="shots", density=2000), FrictMat(label="steel")
    O.materials.append(shots)
    falling((), steel, lambda: Ip2_FrictMat_FrictMat_MindlinPhys(en=MatchMaker(matches=((shots.id, 1, 0.4),))))
    told = harden(O, step=1e-3)
    ball = O.bodies[O.bodies.append(sphere((0, 0, 0.51), 0.5, material=shots))]
    ball.state.vel = (0, 0, -1)
    told.take(O.bodies)
    O.run(30, True)
    assert ball.state.vel[2] == pytest.approx(0.4, rel=1e-5)


def test_spheres_that_pass_through_each_other_still_do():
    """Where a script's loop has no contacts of spheres with spheres."""
    box_of_spheres()
    O.engines[2].geomDispatcher.functors = [Ig2_Facet_Sphere_ScGeom(), Ig2_Box_Sphere_ScGeom()]
    for k, speed in ((-1, -1), (-2, 1)):
        O.bodies[k].state.pos, O.bodies[k].state.vel = (0.3 * speed, 0, -0.5), (-speed, 0, 0)
    O.engines[3].gravity = (0, 0, 0)
    told = harden(O, step=1e-3)
    O.run(500, True)
    assert [O.bodies[k].state.pos[0] for k in (-1, -2)] == pytest.approx([0.2, -0.2], rel=1e-6)
    assert "no contacts of spheres with spheres" in str(told)


def test_a_belt_drags_and_stays():
    """A wall outside of NewtonIntegrator's mask is not moved by its velocity, which acts all the same."""
    stuff = FrictMat(frictionAngle=0.4, density=2000)
    O.materials.append(stuff)
    belt = O.bodies[O.bodies.append(facet([(-50, -50, 0), (50, -50, 0), (0, 90, 0)], material=stuff))]
    belt.state.vel, place = (0, 0.2, 0), Vector3(belt.state.pos)
    ball = O.bodies[O.bodies.append(sphere((0, 0, 0.5), 0.5, material=stuff))]
    ball.mask, ball.state.blockedDOFs = 3, "XYZ"
    O.engines = soft_engines()
    O.engines[3].mask = 2
    O.dt = 1e-4
    told = harden(O, step=1e-3)
    O.run(1000, True)
    assert belt.state.pos == place and "as belts" in str(told)
    assert ball.state.vel[1] == pytest.approx(0.2, rel=1e-3)
    # it slides until it is as fast, 0.2/(μ g), and then goes along
    assert ball.state.pos[1] == pytest.approx(0.2 - 0.5 * 0.2 * 0.2 / (math.tan(0.4) * 9.81), rel=0.01)


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


def wear(stuff):
    """Gives a sphere another material."""
    O.materials.append(stuff)
    O.bodies[-1].material = stuff


def wedge(room):
    """A sphere of 0.5 m between two boxes, both turned, that leave it ``room`` on each side of its centre."""
    for side in (-1, 1):
        way = side * (room + 1)
        place = (50 + way * math.cos(0.3), way * math.sin(0.3), 0)
        O.bodies.append(box(place, (1, 5, 5), fixed=True, orientation=Quaternion((0, 0, 1), 0.3)))
    O.bodies.append(sphere((50, 0, 0), 0.5))


def tie(gap):
    """A sphere that cohesion holds at a distance."""
    stuff = CohFrictMat(isCohesive=True, normalCohesion=1e6, shearCohesion=1e6)
    O.materials.append(stuff)
    one = O.bodies[12]
    one.material = stuff
    O.bodies.append(sphere(one.state.pos + Vector3(0.9 + gap, 0, 0), 0.45, material=stuff))
    O.engines[2].geomDispatcher.functors = [Ig2_Sphere_Sphere_ScGeom6D()]
    O.engines[2].physDispatcher.functors = [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True)]
    O.engines[2].lawDispatcher.functors = [Law2_ScGeom6D_CohFrictPhys_CohesionMoment()]
    createInteraction(12, len(O.bodies) - 1)


def test_a_sphere_between_boxes_with_room_is_taken():
    box_of_spheres()
    wedge(0.47)  # six hundredths of its radius on each side, which the solver takes back as far as it can
    assert harden(O).step > 0


def test_rolling_resistance_without_a_sphere_is_refused():
    with pytest.raises(HardenError, match="has mR = 0.1 m, whose share of a diameter is not known"):
        strengths.hard_material(ViscElMat(mR=0.1, mRtype=1))


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
        (lambda: wear(ViscElMat(mR=0.1, mRtype=2, label="v")), "material v has mRtype 2"),
        (lambda: wear(ViscElMat(lubrication=True, label="v")), "material v has lubrication"),
        (lambda: wedge(0.42), "sphere #39 lies in boxes #37 and #38"),
        (lambda: tie(2.0), "interaction #12+#37 holds spheres across a gap of 2 m"),
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


CLUMP = """
from yade import utils
O.bodies.appendClumped([utils.sphere((0, 0, 0), 0.5), utils.sphere((0.8, 0, 0), 0.5)])
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()]),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]
    ),
    NewtonIntegrator(),
]
O.dt = 1e-4
O.run(10, True)
"""


def test_what_cannot_go_hard_is_one_message(tmp_path):
    (tmp_path / "clump.py").write_text(CLUMP)
    done = launch(tmp_path, "--hard", "clump.py")
    assert done.returncode == 1 and "Traceback" not in done.stdout + done.stderr
    assert "clump.py: body #0 belongs to a clump" in done.stdout + done.stderr


CHANCE = """
import random
from yade import pack
sp = pack.SpherePack()
sp.makeCloud((0, 0, 0), (4, 4, 4), rMean=0.4, rRelFuzz=0.3)
print("DREW", random.random(), len(sp), sp[0][0])
sp.toSimulation()
O.engines = ENGINES
O.dt = 1e-4
O.saveTmp()
O.run(1000, True)
O.loadTmp()
""".replace(
    "ENGINES",
    "[ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()]), InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], "
    "[Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]), NewtonIntegrator(gravity=(0, 0, -9.81))]",
)


def test_a_script_of_chance_draws_the_same_in_both_runs_and_is_measured_before_it_loads(tmp_path):
    (tmp_path / "chance.py").write_text(CHANCE)
    done = launch(tmp_path, "--both", "--time", "0.05", "chance.py")
    assert done.returncode == 0, done.stderr
    drew = re.findall(r"DREW (.*)", done.stdout)
    assert len(drew) == 2 and drew[0] == drew[1]
    (time,) = re.findall(r"^simulated \[s\]\s+(\S+)\s+(\S+)", done.stdout, re.M)
    assert [float(one) for one in time] == pytest.approx([0.05, 0.05], rel=0.1)  # not 0, where the script goes back to
    (way,) = re.findall(r"^way \[m\]\s+(\S+)\s+(\S+)", done.stdout, re.M)
    # a free fall: g t²/2, less a fifth for the integrator's damping of springs; half a step early or late
    assert float(way[1]) == pytest.approx(0.5 * 9.81 * 0.05**2, rel=0.15)
    assert float(way[0]) == pytest.approx(0.8 * 0.5 * 9.81 * 0.05**2, rel=0.15)


def test_a_script_that_waits_for_something_ends_when_its_time_is_over(tmp_path):
    waits = CHANCE.replace("O.run(1000, True)", "while O.bodies[0].state.pos[2] > -1e9:\n    O.run(1000, True)")
    assert waits != CHANCE
    (tmp_path / "waits.py").write_text(waits)
    done = launch(tmp_path, "--hard", "--time", "0.05", "waits.py")
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("asks for further steps") == 1
    (time,) = re.findall(r"^simulated \[s\] +(\S+)", done.stdout, re.M)
    assert float(time) == pytest.approx(0.05, rel=0.1)  # half a step early or late


def test_the_kinetic_energy_that_is_told_has_that_of_turning():
    """Of a body that lies askew too, whose inertia is about its own axes: it turns about its second."""
    body = O.bodies[O.bodies.append(sphere((0, 0, 0), 0.5))]
    body.state.mass, body.state.inertia = 3.0, (1.0, 4.0, 9.0)
    body.state.vel, body.state.angVel = (2.0, 0, 0), (0.5, 0, 0)
    body.state.ori = Quaternion((0, 0, 1), math.pi / 2)
    O.bodies.append(sphere((9, 0, 0), 0.5, fixed=True))
    O.bodies[1].state.vel = (7.0, 0, 0)
    told = comparison._measured(O)["kinetic energy [J]"]
    assert told == pytest.approx(0.5 * 3 * 4 + 0.5 * 4 * 0.25, rel=1e-12)


def test_a_scene_that_is_rigid_is_not_hardened_again():
    box_of_spheres()
    O.engines = soft_engines()
    harden(O)
    engines, step = list(O.engines), O.dt
    with pytest.raises(RuntimeError, match="ContactDynamicsEngine, so the contacts are rigid already"):
        harden(O)
    assert list(O.engines) == engines and O.dt == step
