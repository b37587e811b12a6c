"""YADE's engines that steer walls: those that ask for what rigid contacts have not are refused by name, and what moves or loads bodies works as ever."""
import math

import pytest
import yade.wrapper
from yade import O
from yade.minieigenHP import Quaternion, Vector3
from yade.nonsmooth import scene
from yade.wrapper import (
    BicyclePedalEngine,
    Box,
    CombinedKinematicEngine,
    ForceEngine,
    HarmonicMotionEngine,
    HarmonicRotationEngine,
    KinemCNDEngine,
    KinemCTDEngine,
    RotationEngine,
    ServoPIDController,
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
    """Six boxes as YADE's engines for simple shear want them, front and back ones far away; their ids as options, and that of a disk between floor and lid."""
    stuff = material(0)
    from yade import utils

    ids = {}
    for name, centre, half in (
        ("id_boxleft", (-1.1, 0, 0), (0.1, 1, 2)),
        ("id_boxright", (1.1, 0, 0), (0.1, 1, 2)),
        ("id_boxfront", (0, 0, 3), (2, 2, 0.1)),
        ("id_boxback", (0, 0, -3), (2, 2, 0.1)),
        ("id_topbox", (0, 1.1, 0), (2, 0.1, 2)),
        ("id_boxbas", (0, -1.1, 0), (2, 0.1, 2)),
    ):
        ids[name] = O.bodies.append(utils.box(centre, half, fixed=True, material=stuff))
        O.bodies[ids[name]].bounded = name in ("id_topbox", "id_boxbas")
    return ids, O.bodies.append(scene.disk((0, 0.5), 0.5, stuff))
