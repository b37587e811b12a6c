"""YADE's engines that steer walls: those that ask for what rigid contacts have not are refused by name, and what moves
or loads bodies works as ever.
"""
import math

import pytest
import yade.wrapper
from yade import O, utils
from yade.minieigenHP import Vector3
from yade.nonsmooth import scene
from yade.wrapper import (
    BicyclePedalEngine,
    Bo1_Box_Aabb,
    CombinedKinematicEngine,
    ForceEngine,
    HarmonicMotionEngine,
    HarmonicRotationEngine,
    Ig2_Box_Sphere_ScGeom,
    KinemCNDEngine,
    KinemCTDEngine,
    RotationEngine,
    StepDisplacer,
    TorqueEngine,
    TranslationEngine,
    VESupportEngine,
)

from contact_scenes import G, begin, engine, floor, free_disk, material, run

pytestmark = pytest.mark.usefixtures("empty")

STIFFNESS, CELL = ("stiffness", "yade.nonsmooth.scene.plate"), ("periodic", "yade.nonsmooth.scene.plate")
REFUSED = {
    "TriaxialStressController": (*STIFFNESS, "state.vel", "scripts/biaxial.py"),
    "TriaxialCompressionEngine": (*STIFFNESS, "state.vel", "scripts/biaxial.py"),
    "ThreeDTriaxialEngine": (*STIFFNESS, "state.vel", "scripts/biaxial.py"),
    "KinemCNLEngine": STIFFNESS,
    "KinemCNSEngine": STIFFNESS,
    "PeriIsoCompressor": (*CELL, "scripts/biaxial.py"),
    "PeriTriaxController": (*CELL, "scripts/biaxial.py"),
    "Peri3dController": (*CELL, "scripts/biaxial.py"),
    "TriaxialStateRecorder": ("triaxial engine", "O.forces.f", "yade.nonsmooth.scene.plate"),
}


def made(name, folder):
    options = {"file": str(folder / "triaxial.txt")} if name == "TriaxialStateRecorder" else {}
    return getattr(yade.wrapper, name)(label="servo", **options)


@pytest.mark.parametrize("place", [0, 3, 5], ids=["first", "before", "after"])
@pytest.mark.parametrize("name", REFUSED)
def test_what_steers_by_stiffness_or_cell_is_refused_with_what_works(name, place, tmp_path):
    free_disk()
    begin()
    solver, others = engine(), list(O.engines)
    steering = made(name, tmp_path)
    O.engines = others[:place] + [steering] + others[place:]
    with pytest.raises(RuntimeError) as error:
        solver()  # alone: without their walls some of these engines end the process
    for words in (f"{name} 'servo'", *REFUSED[name]):
        assert words in str(error.value)
    steering.dead = True
    run(2)


# ---- what only moves bodies ------------------------------------------------------------------------

UP = dict(rotationAxis=(0, 0, 1))


def moved(motion):
    """Speed of a disk in front of an upright wall, body 0, which the engine ``motion`` moves for ten steps of 1 ms."""
    stuff = material(0)
    O.bodies.append(scene.segments([(0, 2), (0, -2)], stuff, sense=1))
    disk = free_disk(0.5, 0, stuff=stuff)
    begin(gravity=(0, 0, 0))
    others = list(O.engines)
    O.engines = others[:3] + [motion] + others[3:]
    run(10)
    return O.bodies[disk].state.vel, engine()


@pytest.mark.parametrize(
    "motion",
    [
        lambda: TranslationEngine(ids=[0], translationAxis=(1, 0, 0), velocity=0.3),
        # −A w sin(w t + φ): near its top for the whole of 10 ms
        lambda: HarmonicMotionEngine(ids=[0], A=(-0.3, 0, 0), f=(1 / (2 * math.pi), 0, 0), fi=(math.pi / 2, 0, 0)),
        lambda: StepDisplacer(ids=[0], mov=(3e-4, 0, 0), setVelocities=True),
        lambda: StepDisplacer(ids=[0], mov=(3e-4, 0, 0)),  # by its place
        lambda: CombinedKinematicEngine(
            ids=[0],
            comb=[
                TranslationEngine(translationAxis=(1, 0, 0), velocity=0.2),
                TranslationEngine(translationAxis=(1, 0, 0), velocity=0.1),
            ],
        ),
        # the lowest point of a circle of 0.3 m: at 1 rad/s it goes sideways; YADE's own sign
        lambda: BicyclePedalEngine(ids=[0], radius=0.3, angularVelocity=1, fi=math.pi / 2, **UP),
        # about a point 1 m below
        lambda: RotationEngine(ids=[0], angularVelocity=-0.3, rotateAroundZero=True, zeroPoint=(0, -1, 0), **UP),
        lambda: HarmonicRotationEngine(
            ids=[0], A=0.3, f=1 / (2 * math.pi), fi=math.pi / 2, rotateAroundZero=True, zeroPoint=(0, -1, 0), **UP
        ),
    ],
    ids=[
        "translation",
        "harmonic",
        "displacer by velocity",
        "displacer",
        "combined",
        "pedal",
        "rotation",
        "harmonic rotation",
    ],
)
def test_a_disk_gets_the_speed_of_a_wall_that_an_engine_moves(motion):
    velocity, solver = moved(motion())
    # what turns or swings has turned by 3e-3 rad, or 10 ms from its turning point, in the ten steps
    assert velocity[0] == pytest.approx(0.3, rel=1e-2)
    assert solver.overlapWorst < 1e-3 and solver.drivenSteps == 0


def shear_box():
    """Six boxes as YADE's engines of simple shear want them, the sides and what is in front far from the disk between
    floor and lid; ids as options, and the disk's.
    """
    stuff = material(0)
    ids = {}
    for name, centre, half in (
        ("id_boxleft", (-4.1, 0, 0), (0.1, 1, 2)),
        ("id_boxright", (4.1, 0, 0), (0.1, 1, 2)),
        ("id_boxfront", (0, 0, 3), (2, 2, 0.1)),
        ("id_boxback", (0, 0, -3), (2, 2, 0.1)),
        ("id_topbox", (0, 1.1, 0), (2, 0.1, 2)),
        ("id_boxbas", (0, -1.1, 0), (2, 0.1, 2)),
    ):
        ids[name] = O.bodies.append(utils.box(centre, half, fixed=True, material=stuff))
        O.bodies[ids[name]].bounded = name in ("id_topbox", "id_boxbas")
    disk = O.bodies.append(scene.disk((0, 0.5), 0.5, stuff))
    begin(gravity=(0, 0, 0))
    collider, loop = O.engines[1], O.engines[2]
    collider.boundDispatcher.functors = list(collider.boundDispatcher.functors) + [Bo1_Box_Aabb()]
    loop.geomDispatcher.functors = list(loop.geomDispatcher.functors) + [
        Ig2_Box_Sphere_ScGeom(interactionDetectionFactor=1.05)
    ]
    return ids, disk


def test_a_shear_box_that_is_driven_presses_and_shears():
    ids, disk = shear_box()
    O.engines = O.engines + [
        KinemCTDEngine(compSpeed=0.2, targetSigma=1e9, Key="", **ids)
    ]  # after the integrator: it reads forces
    run(20)
    assert O.bodies[disk].state.vel[1] == pytest.approx(-0.2, rel=1e-9)
    O.engines = O.engines[:-1] + [KinemCNDEngine(shearSpeed=0.3, gammalim=1, Key="", **ids)]
    run(5)
    assert O.bodies[ids["id_topbox"]].state.vel == Vector3(0.3, 0, 0)


# ---- what only loads bodies ------------------------------------------------------------------------


@pytest.mark.parametrize(
    "load, share",
    [
        (lambda disk: ForceEngine(ids=[disk], force=(0, -1e4, 0)), 1e4),
        # a spring of 1e5 N/m that begins 0.1 m below
        (lambda disk: VESupportEngine(bIds=[disk], k1=1e5, k2=1e5, c1=0, c2=0), 1e4),
    ],
    ids=["force", "support"],
)
def test_a_floor_bears_what_an_engine_loads_on_a_disk(load, share):
    stuff = material(0.5)
    ground = floor(stuff)
    disk = free_disk(0, 0.5, stuff=stuff)
    begin()
    O.bodies[disk].state.refPos = O.bodies[disk].state.pos - Vector3(0, 0.1, 0)
    others = list(O.engines)
    O.engines = others[:3] + [load(disk)] + others[3:]
    run(20)
    # a share of 1e-4 ℓ of the way to the spring's foot may be an overlap that stays
    assert -O.forces.f(ground)[1] == pytest.approx(O.bodies[disk].state.mass * G + share, rel=1e-3)


def test_a_torque_turns_a_free_disk():
    disk = free_disk()
    begin(gravity=(0, 0, 0))
    others = list(O.engines)
    O.engines = others[:3] + [TorqueEngine(ids=[disk], moment=(0, 0, 50))] + others[3:]
    run(10)
    assert O.bodies[disk].state.angVel[2] == pytest.approx(50 * 0.01 / O.bodies[disk].state.inertia[2], rel=1e-9)


@pytest.mark.parametrize(
    "kind", ["TriaxialStressController", "ThreeDTriaxialEngine", "KinemCNLEngine", "Peri3dController"]
)
def test_one_that_stands_before_the_solver_is_refused_before_it_acts(kind):
    """Its walls are not there, so that it would end the process."""
    floor(material(0.5))
    free_disk(0, 0.5, stuff=material(0.5))
    begin()
    others = list(O.engines)
    O.engines = others[:3] + [getattr(yade.wrapper, kind)()] + others[3:]
    with pytest.raises(RuntimeError, match=f"PlanarGridCollider: .*{kind}|{kind} "):
        O.step()
