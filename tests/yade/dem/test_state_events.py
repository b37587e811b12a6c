"""Each engine lives through each event: what is kept in memory alone does not matter.

After the event the scene is saved and loaded at once, so that all objects are new ones and know what a file knows, or
it goes on as it is: both ways end in the same bits. doc/state.rst has the table of what lives from step to step.
"""
import math

import pytest
import random_programs
from contact_scenes import begin, engine, material
from yade import O
from yade.minieigenHP import Vector3
from yade.nonsmooth import scene
from yade.wrapper import (
    Body,
    CourseRunner,
    NonsmoothTimeStepper,
    PlateLoadEngine,
    PorePressureEngine,
    PyRunner,
    SlipWeakeningMat,
    WallForceEngine,
)

pytestmark = pytest.mark.usefixtures("empty")


def a_heap():
    """Bonded disks on a wall that weakens; one wall is moved by its place, and bonds break."""
    stuff = material(
        0.4, 0.05, tensileStrength=2e4, residualTensileStrength=1e3, bondCreationDistance=0.03, layer=1, restitution=0.0
    )
    weak = material(0.5, kind=SlipWeakeningMat, criticalSlip=0.002)
    O.bodies.append(scene.segments([(0, 5), (0, 0), (5, -0.3), (5, 5)], weak, piece=3))
    for k in range(24):
        body = scene.disk((0.45 + 0.8 * (k % 6), 0.4 + 0.78 * (k // 6)), 0.395, stuff)
        body.state.vel = (0.3 * math.sin(k), -0.5, 0)
        O.bodies.append(body)
    begin(dt=1e-3, tolerance=1e-6, maxIterations=100, gravity=(1, -9.81, 0))


def in_front(made):
    O.engines = [made] + O.engines


def before_the_solver(made):
    O.engines = O.engines[:3] + [made] + O.engines[3:]


def with_water():
    a_heap()
    before_the_solver(PorePressureEngine(planeNormal=(0, 1, 0), heights=[2.0], times=[0], releaseDistance=0.02))


def with_wall_sums():
    a_heap()
    ids = random_programs.walls()[:2]
    O.engines = O.engines + [WallForceEngine(ids=ids, along=[Vector3(1, 0, 0)] * 2)]


def with_a_stepper():
    a_heap()
    in_front(NonsmoothTimeStepper(smallest=1e-4, largest=3e-3))


def with_a_plate():
    a_heap()
    plate = O.bodies.append(scene.segments([(5, 3.6), (0, 3.2)], O.materials[0]))[0]
    state = O.bodies[plate].state
    state.mass, state.blockedDOFs = 500.0, "zXYZ"
    rail = Body()
    rail.state.blockedDOFs = "xyzXYZ"
    rail.state.pos = state.pos
    rail = O.bodies.append(rail)
    before_the_solver(PlateLoadEngine(id=plate, force=3e4, direction=(0, -1, 0), rail=rail, origin=state.pos))


def with_a_course():
    a_heap()
    in_front(CourseRunner(command="", nextTime=0.01))


def plain():
    a_heap()
    random_programs.own_engines()


SCENES = {
    "solver": a_heap,
    "water": with_water,
    "wall sums": with_wall_sums,
    "stepper": with_a_stepper,
    "plate": with_a_plate,
    "course": with_a_course,
    "YADE's own": plain,
}


def disk(k):
    return random_programs.disks()[k]


def gone():
    O.bodies.erase(disk(9))


def used_again():
    i = disk(9)
    O.bodies.erase(i)
    O.bodies.insertAtId(scene.disk((2.5, 4.5), 0.3, O.materials[0]), i)


def used_again_later():
    i = disk(9)
    O.bodies.erase(i)
    O.step()
    O.bodies.insertAtId(scene.disk((2.5, 4.5), 0.3, O.materials[0]), i)


def refused():
    O.bodies[disk(4)].state.vel[0] = math.nan
    for _ in range(2):
        with pytest.raises(RuntimeError, match="not finite"):
            O.step()
    O.bodies[disk(4)].state.vel = (0.1, 0, 0)


def refused_early():
    engine().tolerance = -1.0
    with pytest.raises(RuntimeError, match="tolerance"):
        O.step()
    engine().tolerance = 1e-6


def exception():
    """In the step, before the solver."""
    before = O.engines
    O.engines = before[:3] + [PyRunner(command="raise ValueError('event')", iterPeriod=1, initRun=True)] + before[3:]
    with pytest.raises(RuntimeError):
        O.step()
    O.engines = before


def time_reset():
    O.resetTime()


def another_scene():
    random_programs.another_scene(None)


def larger():
    O.bodies.append(scene.disk((2.5, 4.5), 0.3, O.materials[0]))


def wall_moved():
    for _ in range(3):
        O.bodies[random_programs.walls()[0]].state.pos += Vector3(1e-3, 0, 0)
        O.step()


def contacts_cleared():
    O.interactions.clear()


EVENTS = [
    gone,
    used_again,
    used_again_later,
    refused,
    refused_early,
    exception,
    time_reset,
    another_scene,
    larger,
    wall_moved,
    contacts_cleared,
]


def course(build, event, loaded):
    O.reset()
    build()
    O.step()
    engine().bond()
    for _ in range(15):
        O.step()
    event()
    if loaded:
        O.saveTmp("event")
        O.loadTmp("event")
    for _ in range(25):
        O.step()
    return random_programs.outcome()


@pytest.mark.parametrize("event", EVENTS, ids=lambda e: e.__name__)
@pytest.mark.parametrize("which", SCENES)
def test_memory_alone_does_not_matter(which, event):
    stays, loaded = course(SCENES[which], event, False), course(SCENES[which], event, True)
    assert not random_programs.differences([stays], [loaded])
    assert sum(k.startswith("contact") for k in stays) > 10 and stays["steps"] > 35
