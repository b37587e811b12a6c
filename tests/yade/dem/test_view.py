"""O.bodies, O.interactions and O.forces are true whenever somebody looks, and what was changed through them is taken
up, whether steps stay in arrays or not.
"""
import functools
import threading
import time

import numpy as np
import pytest
from yade import O
from yade.minieigenHP import Vector3
from yade.nonsmooth import scene
from yade.wrapper import (
    Collider,
    ForceEngine,
    InsertionSortCollider,
    InteractionLoop,
    NewtonIntegrator,
    NonsmoothTimeStepper,
    PorePressureEngine,
    PyRunner,
    SlipWeakeningMat,
)

from all_attributes import everything, plain
from contact_scenes import begin, engine, free_disk, loose_heap, material

STEPS = 240
REACH = 0.4  # mean diameters
pytestmark = pytest.mark.usefixtures("empty")


def busy(steps_of_time=False):
    """Bonded and loose disks fall on a wall that weakens, into water; a wall moves against them. Bonds break, contacts
    come and go.
    """
    stuff = material(
        0.5,
        0.05,
        tensileStrength=5e3,
        residualTensileStrength=1e3,
        layer=1,
        bondCreationDistance=0.35,
        bondEllipseNormal=0.02,
        bondEllipseTangential=0.02,
    )
    weak = material(0.4, kind=SlipWeakeningMat, criticalSlip=0.2, wall=True)
    O.bodies.append(scene.segments([(-3, 2.5), (0, -0.2), (10, -0.2), (13, 3)], weak, piece=2))
    ids = loose_heap(stuff, columns=7, rows=5)
    driven = free_disk(-2.0, 3.2, (1.5, 0, 0), stuff)
    water = PorePressureEngine(
        planePoint=(0, 0, 0), planeNormal=(0, 1, 0), times=[0, 0.3], heights=[0, 2.0], releaseDistance=0.5
    )
    begin(dt=2e-3, reach=REACH, tolerance=1e-6)
    O.engines = O.engines[:1] + [water] + O.engines[1:]
    if steps_of_time:
        O.engines = [NonsmoothTimeStepper(smallest=1e-4, largest=4e-3)] + O.engines
    O.step()
    assert engine().bond() > 10
    return ids, driven


def watched():
    """Python looks in every step, so that nothing stays in the arrays unseen."""
    O.engines = O.engines + [PyRunner(command="pass", iterPeriod=1, initRun=True)]


def beside_others():
    """An engine acts in every step that might change anything, so that all is read anew."""
    O.engines = O.engines + [ForceEngine(force=(0, 0, 0), ids=[])]


def own_engines(*kinds):
    """YADE's own engines in the place of ours of these kinds."""
    own = {
        Collider: lambda e: InsertionSortCollider(e.boundDispatcher.functors, verletDist=e.verletDist),
        InteractionLoop: lambda e: InteractionLoop(
            e.geomDispatcher.functors, e.physDispatcher.functors, e.lawDispatcher.functors
        ),
        NewtonIntegrator: lambda e: NewtonIntegrator(damping=0, gravity=e.gravity),
    }
    O.engines = [next((own[kind](e) for kind in kinds if isinstance(e, kind)), e) for e in O.engines]


def looked_at(way):
    """The list of engines by which a scene is looked at in that way, where it is one of engines."""
    if way == "watched":
        watched()
    if way == "beside others":
        beside_others()
    if way == "own engines":
        own_engines(Collider, InteractionLoop, NewtonIntegrator)


def advance(way, steps):
    if way == "stepped":
        for _ in range(steps):
            O.step()
    else:
        O.run(steps, wait=True)


def most_views(begin):
    """In a run that nobody watches: one each 0.05 s, for others who may look, and those at the ends of what this file
    runs.
    """
    return 10 + (time.monotonic() - begin) / 0.05


def course(way, build, change=None, halves=2):
    O.reset()
    made = build()
    looked_at(way)
    for half in range(halves):
        advance(way, STEPS // halves)
        if change and half == 0:
            change(made)
    return everything()


@pytest.mark.parametrize("adaptive", [False, True])
def test_all_that_python_can_read_is_the_same_in_every_way(adaptive):
    def build():
        return busy(adaptive)

    begin = time.monotonic()
    unwatched = course("run", build)
    assert engine().views < most_views(begin)
    assert engine().viewedBy == "the end of the run"
    assert (
        engine().brokenTension + engine().brokenShear + engine().brokenTorque + engine().brokenMixed > 5
        and engine().bonds > 5
    )
    assert any(i.isReal and type(i.phys).__name__ == "SlipWeakeningPhys" for i in O.interactions)
    watchers = course("watched", build)
    assert engine().views >= STEPS
    stepped, others = course("stepped", build), course("beside others", build)
    for k, what in enumerate(("bodies", "interactions", "forces", "engine", "step", "time")):
        assert unwatched[k] == watchers[k] == stepped[k] == others[k], what


def without_signs(row):
    """What is made of one interaction but for what soft laws alone need; a zero has no sign."""
    return [
        (key, np.add(value, 0.0).tolist() if isinstance(value, (float, Vector3)) else value)
        for part in (row.geom, row.phys)
        for key, value in sorted(part.dict().items())
        if key not in ("shearInc", "refR1", "refR2", "wallMaterial")
    ]


def test_interactions_are_what_yades_own_loop_makes_of_them():
    """With YADE's own loop and integrator geometry and thresholds are written by the functors themselves, in every
    step.
    """

    def end(own):
        O.reset()
        busy()
        if own:
            own_engines(InteractionLoop, NewtonIntegrator)
        rows = []
        for _ in range(6):
            O.run(STEPS // 6, wait=True)
            rows.append({(i.id1, i.id2): without_signs(i) for i in O.interactions if i.isReal})
        return rows

    ours, theirs = end(False), end(True)
    assert engine().brokenShear > 5
    disks = [key for key in ours[-1] if min(key) > 8]
    assert len(disks) > 20
    for a, b in zip(ours, theirs):
        assert a.keys() == b.keys()
        for key in a:
            assert a[key] == b[key], key


def found_by_boxes(rows):
    """Without walls that a disk is yet to come near to. YADE's collider has boxes of disks, which reach half as far
    beyond the rim as two of them together, and boxes of walls, which reach nowhere; so it finds such a wall some steps
    later than ours. Nothing acts over such gaps.
    """
    return [
        row
        for row in rows
        if not ("owned" in dict(row[1]) and -dict(row[1])["penetrationDepth"] > 0.5 * REACH * dict(row[1])["length"])
    ]


def test_two_thousand_steps_are_the_same_in_every_way_and_with_yades_own_engines():
    """On the way disks are taken away and put in, a bonded contact is ended, a disk is thrown, and what touches is
    bonded anew.
    """

    def end(way):
        O.reset()
        ids, driven = busy(steps_of_time=True)
        looked_at(way)
        rows = []
        for leg in range(10):
            if way == "advanced":
                engine().advance(200)
            elif way == "unseen":
                for _ in range(20):
                    engine().advance(10, view=False)
                engine().view()
            elif way == "one seen":
                for _ in range(200):
                    engine().advance(1, view=[driven])
                engine().view()
            else:
                advance(way, 200)
            walls = [plain(m) for m in O.materials if isinstance(m, SlipWeakeningMat)]
            counts = [
                getattr(engine(), name)
                for name in ("bonds", "brokenTension", "brokenShear", "brokenTorque", "brokenMixed", "totalIterations")
            ]
            rows.append(
                (
                    [(b.id, b.state.pos, b.state.vel, b.state.ori, b.state.angVel) for b in O.bodies if b],
                    walls,
                    counts,
                    sorted((sorted((i.id1, i.id2)), without_signs(i)) for i in O.interactions if i.isReal),
                )
            )
            O.bodies.erase(ids[3 * leg])
            free_disk(1.0 + leg, 9.0, (0.3 * leg - 1, -4, 0), O.bodies[ids[1]].material)
            contact = min(
                (i for i in O.interactions if i.isReal and i.phys.bonded),
                key=lambda i: sorted((i.id1, i.id2)),
                default=None,
            )
            if contact:
                O.interactions.erase(contact.id1, contact.id2)
            O.bodies[ids[31]].state.vel = (0, 3, 0)
            engine().bond()
        return rows

    expected = end("run")
    assert engine().steps > 2000 and engine().bonds > 0 and engine().brokenShear > 5
    for way in ("advanced", "unseen", "one seen", "watched", "stepped", "beside others", "own engines"):
        for leg, (a, b) in enumerate(zip(expected, end(way))):
            for what, x, y in zip(("bodies", "walls", "counts", "contacts"), a, b):
                if what == "contacts" and way == "own engines":
                    x, y = found_by_boxes(x), found_by_boxes(y)
                    assert len(x) > 20
                assert x == y, (way, leg, what)


def pair():
    return next(i for i in O.interactions if i.isReal and i.phys.bonded)


def changed(what):
    """A change that a script makes between two runs."""

    def body(name, value):
        return lambda made: setattr(O.bodies[made[0][11]].state, name, value)

    def phys(name, factor):
        def change(made):
            for i in O.interactions:
                if i.isReal:
                    setattr(
                        i.phys,
                        name,
                        factor * getattr(i.phys, name) if not isinstance(getattr(i.phys, name), bool) else factor,
                    )

        return change

    def erase_body(made):
        O.bodies.erase(made[0][5])

    def erase_interaction(made):
        i = pair()
        O.interactions.erase(i.id1, i.id2)

    def exchange(made):
        a, b = [i for i in O.interactions if i.isReal and i.phys.bonded][:2]
        a.phys, b.phys = b.phys, a.phys

    def insert(made):
        free_disk(4.0, 7.0, (0, -5, 0), O.bodies[made[0][0]].material)

    def silence(made):
        pair().isActive = False

    def material_of(made):
        for stuff in O.materials:
            stuff.frictionAngle = 0.1
        engine().updateStrengths()

    def radius(made):
        O.bodies[made[0][11]].shape.radius *= 0.8

    def block(made):
        O.bodies[made[0][3]].state.blockedDOFs = "xyzXYZ"

    def out_of_the_plane(made):
        b = O.bodies[made[0][3]].state
        b.blockedDOFs, b.vel, b.angVel = "xyzXYZ", (0, 0, 0), (1, 0, 0)

    def pushed(made):
        newton = next(k for k, e in enumerate(O.engines) if isinstance(e, InteractionLoop))
        O.engines = O.engines[:newton] + [ForceEngine(force=(4000, 0, 0), ids=[made[0][7]])] + O.engines[newton:]

    return {
        "pos": lambda made: setattr(
            O.bodies[made[0][11]].state,
            "pos",
            O.bodies[made[0][11]].state.pos + type(O.bodies[0].state.pos)(0.03, 0.05, 0),
        ),
        "vel": body("vel", (3, 1, 0)),
        "angVel": body("angVel", (0, 0, 4)),
        "mass": body("mass", 5000.0),
        "inertia": body("inertia", (900, 900, 900)),
        "ori": body("ori", ((0, 0, 1), 0.3)),
        "normal": phys("normal", 0.0),
        "tangential": phys("tangential", -1.0),
        "torque": phys("torque", 3.0),
        "restitution": phys("restitution", 0.0),
        "friction": phys("friction", 0.2),
        "residualFriction": phys("residualFriction", 0.2),
        "tensileForce": phys("tensileForce", 0.1),
        "residualTensileForce": phys("residualTensileForce", 5.0),
        "rollingArm": phys("rollingArm", 4.0),
        "residualRollingArm": phys("residualRollingArm", 0.0),
        "ellipseNormal": phys("ellipseNormal", 0.01),
        "ellipseTangential": phys("ellipseTangential", 0.1),
        "bonded": phys("bonded", False),
        "erased body": erase_body,
        "erased interaction": erase_interaction,
        "exchanged physics": exchange,
        "cleared interactions": lambda made: O.interactions.clear(),
        "inserted disk": insert,
        "isActive": silence,
        "materials": material_of,
        "radius": radius,
        "blockedDOFs": block,
        "out of the plane": out_of_the_plane,
        "unbond": lambda made: engine().unbond(),
        "resetTime": lambda made: O.resetTime(),
        "dt": lambda made: setattr(O, "dt", 1e-3),
        "integrator": lambda made: own_engines(NewtonIntegrator),
        "loop": lambda made: own_engines(InteractionLoop),
        "force": pushed,
    }[what]


CHANGES = [
    "pos",
    "vel",
    "angVel",
    "mass",
    "inertia",
    "ori",
    "normal",
    "tangential",
    "torque",
    "restitution",
    "friction",
    "residualFriction",
    "tensileForce",
    "residualTensileForce",
    "rollingArm",
    "residualRollingArm",
    "ellipseNormal",
    "ellipseTangential",
    "bonded",
    "erased body",
    "erased interaction",
    "exchanged physics",
    "cleared interactions",
    "inserted disk",
    "isActive",
    "materials",
    "radius",
    "blockedDOFs",
    "out of the plane",
    "unbond",
    "resetTime",
    "dt",
    "integrator",
    "loop",
    "force",
]


@functools.lru_cache
def untouched():
    return course("run", busy)[0]


@pytest.mark.parametrize("what", CHANGES)
def test_what_is_changed_between_two_runs_is_taken_up(what):
    unwatched = course("run", busy, changed(what))
    for way in ("watched", "stepped", "beside others"):
        assert course(way, busy, changed(what))[:3] == unwatched[:3], way
    if what not in ("restitution", "isActive", "dt", "integrator", "loop"):  # of which the disks may not feel anything
        assert untouched() != unwatched[0], "it changed nothing, so nothing was tested"


WITHIN = {
    "vel": lambda ids: setattr(O.bodies[ids[11]].state, "vel", (2, 1, 0)),
    "pos": lambda ids: setattr(O.bodies[ids[30]].state, "pos", O.bodies[ids[30]].state.pos + Vector3(0.02, 0.03, 0)),
    "mass": lambda ids: setattr(O.bodies[ids[2]].state, "mass", 1.1 * O.bodies[ids[2]].state.mass),
    "friction": lambda ids: [setattr(i.phys, "residualFriction", 0.1) for i in O.interactions if i.isReal],
    "bonded": lambda ids: setattr(pair().phys, "bonded", False),
    "erased interaction": lambda ids: O.interactions.erase(*(lambda i: (i.id1, i.id2))(pair())),
    "gravity": lambda ids: setattr(
        next(e for e in O.engines if isinstance(e, NewtonIntegrator)), "gravity", (1, -9, 0)
    ),
}


@pytest.mark.parametrize("place", ["first", "before the loop", "before the solver", "last"])
@pytest.mark.parametrize("what", WITHIN)
def test_what_a_script_changes_within_a_step_is_taken_up(what, place):
    """An engine that acts in two steps of the run, anywhere in the list."""

    def end(way):
        O.reset()
        made = busy()
        O.change = lambda: WITHIN[what](made[0])
        at = {
            "first": 0,
            "before the loop": next(k for k, e in enumerate(O.engines) if isinstance(e, InteractionLoop)),
            "before the solver": next(k for k, e in enumerate(O.engines) if e is engine() or e.label == engine().label),
            "last": len(O.engines),
        }[place]
        O.engines = O.engines[:at] + [PyRunner(command="O.change()", iterPeriod=75, nDo=2)] + O.engines[at:]
        looked_at(way)
        advance(way, STEPS)
        return everything()[:3]

    unwatched = end("run")
    for way in ("watched", "stepped", "beside others"):
        assert end(way) == unwatched, way
    assert unwatched[0] != untouched(), "it changed nothing, so nothing was tested"


def test_a_loaded_scene_goes_on_in_the_arrays_with_the_same_bits(tmp_path):
    busy()
    advance("run", 60)
    O.save(str(tmp_path / "half.yade.gz"))

    def rest(way):
        O.load(str(tmp_path / "half.yade.gz"))
        advance(way, STEPS)
        return everything()[:3]

    assert rest("run") == rest("stepped")
    assert engine().brokenTension + engine().brokenShear > 5


def test_what_is_saved_within_a_run_is_true(tmp_path):
    """A PyRunner saves the scene; what is loaded is what another run has at that step."""
    busy()
    O.engines = O.engines + [PyRunner(command=f"O.save('{tmp_path / 'within.yade.gz'}')", iterPeriod=70)]
    advance("run", STEPS)
    O.load(str(tmp_path / "within.yade.gz"))
    saved, step = engine().bodyTable(), O.iter
    O.reset()
    busy()
    advance("stepped", step)
    assert engine().bodyTable() == saved and 1 < step < STEPS


def test_engines_that_look_now_and_then_see_the_truth(tmp_path):
    """By step, by time and by the clock: each sees what a watcher of every step sees."""

    def seen(**period):
        O.reset()
        busy()
        rows, begin = [], time.monotonic()
        O.seen = lambda: rows.append(
            (
                O.iter,
                [plain(b.state) for b in O.bodies],
                plain([i.phys.normalForce for i in O.interactions if i.isReal]),
            )
        )
        O.engines = O.engines + [PyRunner(command="O.seen()", **period)]
        advance("run", STEPS)
        return {row[0]: row[1:] for row in rows}, engine().views - len(rows) < most_views(begin)

    every, _ = seen(iterPeriod=1, initRun=True)
    assert len(every) == STEPS
    for period in (
        dict(iterPeriod=17),
        dict(virtPeriod=0.05),
        dict(iterPeriod=1, firstIterRun=40, nDo=3),
        dict(iterPeriod=30, initRun=True),
    ):
        some, few = seen(**period)
        assert 1 < len(some) < 60 and few, period  # nobody else was shown anything
        assert all(every[step] == row for step, row in some.items()), period


@pytest.mark.parametrize("shown", ["now and then", "in every step"])
def test_what_is_saved_beside_a_run_in_the_background_is_of_one_moment(shown, tmp_path):
    """Falling freely all disks have the same speed, that of the step that the file names or of the two after it, since
    its number is written first; each file can be gone on with.

    Where a foreign engine has the bodies shown in every step, each step that went on meanwhile would be seen in the
    file.
    """
    stuff = material(0.5)
    O.bodies.append([scene.disk((3 * (k % 60), 3 * (k // 60)), 0.5, stuff) for k in range(3000)])
    begin(dt=1e-4, reach=0.4)
    if shown == "in every step":
        O.engines = O.engines + [ForceEngine(ids=[0], force=(0, 0, 0))]
    O.run()
    try:
        files = [str(tmp_path / f"{k}.yade.gz") for k in range(6)]
        for file in files:
            saver = threading.Thread(target=O.save, args=(file, True))
            saver.start()
            while saver.is_alive():
                len(O.interactions), O.bodies[0].state.pos  # a third thread looks
            saver.join()
    finally:
        O.pause()
    wait_for_the_end()
    steps = []
    for file in files:
        O.load(file, True)
        speeds = {b.state.vel[1] for b in O.bodies}
        assert len(speeds) == 1
        assert -speeds.pop() / (9.81 * O.dt) == pytest.approx(O.iter + 1, abs=1.01)  # rounding adds up to 1e-12 of it
        steps.append(O.iter)
        O.run(3, wait=True)
        assert O.iter == steps[-1] + 3
    assert steps == sorted(steps) and steps[-1] > steps[0]


def test_contacts_that_come_and_go_are_saved_beside_a_run_in_the_background(tmp_path):
    """Each bond that is saved is one of two disks that are there, and the scene goes on from each file as from
    itself.
    """
    busy()
    O.run()
    try:
        for k in range(40):
            O.save(str(tmp_path / f"{k}.yade"), True)
            time.sleep(0.01)
    finally:
        O.pause()
    wait_for_the_end()
    for k in range(40):
        O.load(str(tmp_path / f"{k}.yade"), True)
        assert all(O.bodies[i.id1] and O.bodies[i.id2] for i in O.interactions)
        O.run(10, wait=True)
        assert engine().residual <= 10 * engine().tolerance


def wait_for_the_end():
    """O.pause() does not wait for the step that is being made."""
    last = None
    while last != O.iter:
        last = O.iter
        time.sleep(0.3)


def test_others_see_a_run_in_the_background_and_what_they_write_is_not_lost():
    """Reads follow within some tenths of a second; a written velocity and a bond that is ended stay so."""
    ids, driven = busy()
    O.run()
    try:
        first = O.bodies[ids[0]].state.pos[1]
        until = time.time() + 30
        while O.bodies[ids[0]].state.pos[1] == first and time.time() < until:
            time.sleep(0.02)
        assert O.bodies[ids[0]].state.pos[1] != first
        O.bodies[driven].state.vel = (0, 400, 0)
        while O.bodies[driven].state.pos[1] < 100 and time.time() < until:
            time.sleep(0.02)
        assert O.bodies[driven].state.pos[1] >= 100
        O.bodies[driven].state.vel = (0, 0, 0)  # it may have hit another on its way, and fly to the side
        O.bodies[driven].state.pos = (-2000, 0, 0)
        while O.bodies[driven].state.pos[1] > -5 and time.time() < until:
            time.sleep(0.02)
        x, y, _ = O.bodies[driven].state.pos
        assert y <= -5 and abs(x + 2000) < 1  # from there it falls upright
    finally:
        O.pause()
    wait_for_the_end()
    before = everything()[:2]
    engine().view()
    assert everything()[:2] == before  # nothing was left in the arrays
