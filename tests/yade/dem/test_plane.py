"""Forces, torques and gravity out of the x-y plane: refused before the step, with one message that names whose they
are, the value and what would do.
"""
import math

import pytest
from yade import O
from yade.nonsmooth import scene
from yade.wrapper import (
    ForceEngine,
    ForceRecorder,
    NewtonIntegrator,
    PlanarNewtonIntegrator,
    PyRunner,
    TorqueEngine,
    TorqueRecorder,
    UniaxialStrainer,
)

from contact_scenes import G, begin, engine, floor, free_disk, material, refused, run

pytestmark = pytest.mark.usefixtures("empty")


def lies(**options):
    stuff = material(0.3)
    floor(stuff)
    disk = free_disk(0, 0.5, stuff=stuff)
    begin(**options)
    return disk


@pytest.mark.parametrize("integrator", [PlanarNewtonIntegrator, NewtonIntegrator])
@pytest.mark.parametrize("gravity", [(0, 0, -9.81), (0, 0, 1e-3), (0, -9.81, -0.1), (3.0, -9.81, 2e-5)])
def test_gravity(gravity, integrator):
    disk = lies()
    O.engines = [integrator(damping=0, gravity=gravity) if isinstance(e, NewtonIntegrator) else e for e in O.engines]
    refused("ContactDynamicsEngine", integrator.__name__ + ".gravity = (", "out of the x-y plane", "components x and y")
    assert tuple(O.bodies[disk].state.vel) == (0, 0, 0)


@pytest.mark.parametrize("gravity", [(0, 0, 0), (0, -9.81, 0), (0, -9.81, 9e-6), (5, 0, -4e-6), (0, -9.81, 1e-20)])
def test_gravity_that_is_in_the_plane_but_for_rounding(gravity):
    lies(gravity=gravity)
    run(2)


def test_gravity_that_grows_out_of_the_plane():
    lies(gravity=(0, 0, 0), gravityRamp=1.0, finalGravity=(0, 0, -9.81))
    refused("finalGravity = (0, 0, -9.81", "(0, -9.81")
    engine().finalGravity = (0, -9.81, 0)
    O.step()


PUSHES = {
    "ForceEngine 'push'": lambda disk: ForceEngine(force=(5, 0, 2.5), ids=[disk], label="push"),
    "TorqueEngine": lambda disk: TorqueEngine(moment=(0, 3.5, 1), ids=[disk]),
    "O.forces.addF": lambda disk: PyRunner(command=f"O.forces.addF({disk}, (0, 0, 2.5))", iterPeriod=1, initRun=True),
    "addT": lambda disk: PyRunner(command=f"O.forces.addT({disk}, (3.5, 0, 0))", iterPeriod=1, initRun=True),
}


@pytest.mark.parametrize("who", PUSHES)
def test_forces_and_torques(who):
    disk = lies()
    push = PUSHES[who](disk)
    O.engines = O.engines[:3] + [push] + O.engines[3:]
    kind = ("force", "2.5") if "T" not in who.replace("ForceEngine", "") else ("torque", "3.5")
    refused(f"body #{disk} has the {kind[0]} (", kind[1], who, "x-y plane")
    push.dead = True


@pytest.mark.parametrize("perm", [True, False])
def test_forces_by_hand(perm):
    disk = lies()
    run(1)
    O.forces.setPermF(disk, (0, 0, -7.5)) if perm else O.forces.addF(disk, (0, 0, -7.5), permanent=True)
    refused(f"body #{disk}", "(0, 0, -7.5) N", "O.forces.setPermF", "components x and y alone")
    O.forces.setPermF(disk, (0, -7.5, 0))
    run(1)


def test_rounding_is_none_of_it():
    disk = lies()
    weight = O.bodies[disk].state.mass * G
    O.forces.setPermF(disk, (1, 1, 0.9e-6 * weight))
    run(2)
    O.forces.setPermF(disk, (1, 1, 1.1e-6 * weight))
    refused("out of the x-y plane")
    O.forces.setPermF(disk, (0, 0, 0))
    O.forces.setPermT(disk, (0.3e-6 * weight, 0, 0))  # the radius of gyration is 0.35 m
    run(2)
    O.forces.setPermT(disk, (0.4e-6 * weight, 0, 0))
    refused("torque", "z alone")


def test_forces_on_what_does_not_move_are_no_matter():
    lies()
    O.forces.setPermF(0, (0, 0, 1e6))
    O.forces.setPermT(0, (1e6, 0, 0))
    run(3)
    assert engine().unconverged == 0


# ---- engines that do what cannot be answered -------------------------------------------------------------------


def block_of_rock():
    stuff = material(0.5, 0.2, tensileStrength=1e5)
    ids = [free_disk(k % 3, k // 3, stuff=stuff) for k in range(15)]
    begin(gravity=(0, 0, 0), tolerance=1e-6)
    run(1)
    engine().bond()
    return ids


def strainer(ids, **options):
    return UniaxialStrainer(axis=1, strainRate=1e-2, posIds=ids[-3:], negIds=ids[:3], crossSectionArea=3.0, **options)


def test_a_strainer_that_has_freed_its_bodies_is_named():
    ids = block_of_rock()
    O.engines = O.engines + [strainer(ids)]
    O.step()
    refused(
        "UniaxialStrainer has overwritten it", "blockDisplacements=True", "blockRotations=True", "after the integrator"
    )


def test_a_strainer_finds_the_strength():
    ids = block_of_rock()
    O.engines = O.engines + [strainer(ids, blockDisplacements=True, blockRotations=True)]
    peak = 0
    for _ in range(60):
        engine().advance(20)
        peak = max(peak, O.engines[-1].avgStress)
    # three bonds of 1e5 Pa times 1 m on an area of 3 m
    assert peak == pytest.approx(1e5, rel=1e-3)


@pytest.mark.parametrize("kind", [ForceRecorder, TorqueRecorder])
@pytest.mark.parametrize("place", [0, 1, 2, 3, 5])
def test_a_recorder_that_stands_before_the_solver_is_named(place, kind, tmp_path):
    """YADE's own message is about threads. At the head of the list it reads forces of the step before, from the second
    step on.
    """
    disk = lies()
    run(1 if place == 0 else 0)
    others = list(O.engines)
    recorder = kind(ids=[disk], file=str(tmp_path / "record.txt"), iterPeriod=1, label="record")
    O.engines = others[:place] + [recorder] + others[place:]
    if place in (0, 5):
        run(3)
    else:
        refused(
            f"{kind.__name__} 'record' reads forces and stands before ContactDynamicsEngine",
            "put it after the integrator",
        )


def test_readers_of_forces_before_the_solver_are_refused():
    ids = block_of_rock()
    reader = strainer(ids, blockDisplacements=True, blockRotations=True)
    O.engines = O.engines[:3] + [reader] + O.engines[3:]
    refused(
        "UniaxialStrainer reads forces and stands before",
        "after the integrator (engines(after=[...]))",
        "blockDisplacements=True",
    )
    O.engines = [reader] + O.engines[:3] + O.engines[4:]  # before forces are reset: those of the last step
    run(2)
