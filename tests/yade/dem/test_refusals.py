"""Scenes that would run and be wrong in silence, or crash: each is refused or handled, with one message that names
what, the value and what would do.
"""
import math

import pytest
from yade import O, utils
from yade.minieigenHP import Quaternion, Vector3
from yade.nonsmooth import scene
from yade.wrapper import (
    Bo1_Box_Aabb,
    Bo1_Facet_Aabb,
    Bo1_Segment_Aabb,
    Bo1_Sphere_Aabb,
    Bo1_Wall_Aabb,
    Body,
    Box,
    Collider,
    ContactDynamicsEngine,
    ForceEngine,
    ForceResetter,
    FrictMat,
    GlobalStiffnessTimeStepper,
    Ig2_Box_Sphere_ScGeom,
    Ig2_Facet_Sphere_ScGeom,
    Ig2_Segment_Sphere_ScGeom,
    Ig2_Sphere_Sphere_ScGeom,
    Ig2_Wall_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    NewtonIntegrator,
    NscdInteractionLoop,
    NscdMat,
    PlanarGridCollider,
    PyRunner,
    Segment,
    SlipWeakeningMat,
)

from contact_scenes import G, begin, contacts, engine, launch, material, refused, run, spoilt


pytestmark = pytest.mark.usefixtures("empty")


def free_disk(x=0.0, y=0.0, stuff=None, velocity=(0, 0, 0)):
    disk = O.bodies.append(scene.disk((x, y), 0.5, stuff or material()))
    O.bodies[disk].state.vel = velocity
    return disk


def rests_on_a_floor(**options):
    """Body 0 is a floor and body 1 a disk that lies on it."""
    stuff = material(0.3, label="rock")
    O.bodies.append(scene.segments([(-20, 0), (20, 0)], stuff))
    disk = free_disk(0, 0.5, stuff)
    begin(**options)
    return disk


def of(kind):
    return next(e for e in O.engines if isinstance(e, kind))


def replaced(kind, *others):
    """O.engines with others in the place of the one of a kind."""
    return [e for engine_ in O.engines for e in (others if isinstance(engine_, kind) else [engine_])]


def inserted(kind, other):
    """O.engines with another one before that of a kind."""
    return replaced(kind, other, of(kind))


# ---- the list of engines ---------------------------------------------------------------------------


def kill(kind):
    of(kind).dead = True


def scale_densities():
    O.engines = [GlobalStiffnessTimeStepper(active=False)] + O.engines  # else YADE does not switch it on
    O.step()
    of(NewtonIntegrator).densityScaling = True


@pytest.mark.parametrize(
    "spoil, words",
    [
        (lambda: setattr(of(NewtonIntegrator), "mask", 2), ("NewtonIntegrator.mask = 2", "mask=-1")),
        (scale_densities, ("densityScaling", "False")),
        (lambda: kill(NewtonIntegrator), ("PlanarNewtonIntegrator is dead", "dead = False")),
        (
            lambda: setattr(O, "engines", O.engines + [NewtonIntegrator(damping=0)]),
            ("second integrator", "NewtonIntegrator", "take one out"),
        ),
        (
            lambda: setattr(O, "engines", inserted(ContactDynamicsEngine, ContactDynamicsEngine())),
            ("two engines ContactDynamicsEngine", "take one out"),
        ),
        (
            lambda: setattr(O, "engines", replaced(ContactDynamicsEngine)),
            ("no ContactDynamicsEngine", "add one before NewtonIntegrator"),
        ),
        (lambda: kill(ContactDynamicsEngine), ("ContactDynamicsEngine 'contactDynamics'", "dead = False")),
        (lambda: kill(InteractionLoop), ("NscdInteractionLoop is dead", "dead = False")),
        (lambda: setattr(O, "engines", replaced(InteractionLoop)), ("no InteractionLoop", "NscdInteractionLoop(...)")),
        (lambda: kill(Collider), ("PlanarGridCollider is dead", "dead = False")),
        (lambda: setattr(O, "engines", replaced(Collider)), ("no collider", "PlanarGridCollider(...)")),
        (lambda: kill(ForceResetter), ("ForceResetter is dead", "dead = False")),
        (lambda: setattr(O, "engines", replaced(ForceResetter)), ("last reset in step", "ForceResetter() first")),
        (
            lambda: setattr(
                O, "engines", inserted(NewtonIntegrator, ForceEngine(force=(1, 0, 0), ids=[1], label="push"))
            ),
            ("ForceEngine 'push' stands between", "before"),
        ),
        (
            lambda: setattr(O, "engines", inserted(NewtonIntegrator, PyRunner(command="pass", iterPeriod=1))),
            ("PyRunner stands between", "after the integrator"),
        ),
    ],
)
def test_lists_of_engines_that_would_go_wrong(spoil, words):
    rests_on_a_floor()
    run(1)
    spoil()
    refused(*words)


def test_a_loop_behind_the_solver_is_refused():
    rests_on_a_floor()
    loop = of(InteractionLoop)
    engines = replaced(InteractionLoop)
    at = engines.index(next(e for e in engines if isinstance(e, ContactDynamicsEngine)))
    O.engines = engines[: at + 1] + [loop] + engines[at + 1 :]
    refused("NscdInteractionLoop stands after ContactDynamicsEngine", "put it before")


def test_dead_engines_that_nobody_needs_are_let_be():
    disk = rests_on_a_floor()
    spare = [
        NewtonIntegrator(damping=0.2, dead=True),
        ContactDynamicsEngine(dead=True),
        ForceEngine(force=(1e9, 0, 0), ids=[1], dead=True),
    ]
    O.engines = [
        e for engine_ in O.engines for e in ([*spare, engine_] if isinstance(engine_, NewtonIntegrator) else [engine_])
    ]
    run(3)
    assert abs(O.bodies[disk].state.vel[1]) < 1e-12 and O.bodies[disk].state.vel[0] == 0


def test_a_solver_forgotten_behind_yades_own_loop_is_told_of(tmp_path):
    script = tmp_path / "forgotten.py"
    script.write_text(
        """
from yade import nonsmooth
from contact_scenes import *
stuff = material(0.3)
O.bodies.append(scene.segments([(-5, 0), (5, 0)], stuff))
O.bodies.append(scene.disk((0, 0.5), 0.5, stuff))
begin()
engines = [e for e in O.engines if not isinstance(e, ContactDynamicsEngine)]
O.engines = [InteractionLoop(e.geomDispatcher.functors, e.physDispatcher.functors, e.lawDispatcher.functors) if isinstance(e, InteractionLoop) else e for e in engines]
run(12)
"""
    )
    done = launch(script)
    told = [line for line in done.stderr.splitlines() if "no ContactDynamicsEngine" in line]
    assert done.returncode == 0 and len(told) == 2, done.stderr  # the 1st and the 10th step
    assert "add one before NewtonIntegrator" in told[0]


@pytest.mark.parametrize(
    "name, value",
    [
        ("tolerance", math.inf),
        ("tolerance", math.nan),
        ("relaxationRate", math.nan),
        ("correctionSpeed", -1.0),
        ("correctionSlack", -0.1),
        ("correctionSlack", 1.0),
        ("correctionSlack", math.nan),
        ("correctionSpeed", math.nan),
        ("openGap", -0.1),
        ("openGap", math.nan),
    ],
)
def test_settings_without_sense(name, value):
    rests_on_a_floor(**{name: value})
    refused(f"{name} = {value:g}", "it must be")


# ---- forces that come late --------------------------------------------------------------------------


def late_push(disk):
    """The engine after the integrator adds to O.forces once the step is over."""
    O.engines = O.engines + [ForceEngine(force=(0, 2 * G * O.bodies[disk].state.mass, 0), ids=[disk])]
    O.step()
    O.engines = O.engines[:-1]


@pytest.mark.parametrize(
    "push", [late_push, lambda disk: O.forces.addF(disk, (0, 2 * G * O.bodies[disk].state.mass, 0))]
)
def test_a_force_added_after_a_step_is_answered_in_the_next(push):
    # twice its weight lifts a disk: with a reaction that knew nothing of it, as it was, it would rise by 2 g h instead
    # of g h
    disk = rests_on_a_floor()
    run(2)
    push(disk)
    O.step()
    assert O.bodies[disk].state.vel[1] == pytest.approx(G * O.dt, rel=1e-9)
    assert O.forces.f(0)[1] == 0


# ---- bodies -------------------------------------------------------------------------------------------


def test_disks_at_different_z():
    free_disk(0, 0), free_disk(0.8, 0)
    O.bodies[1].state.pos = (0.8, 0, 0.5)
    begin(gravity=(0, 0, 0))
    refused("body #1", "z = 0.5", "#0", "one z")
    # far apart too: they would pass each other
    O.bodies[1].state.pos = (0, 0, 3)
    refused("body #1", "z = 3")
    for b in O.bodies:  # where it is does not matter
        b.state.pos = (b.id, 0, -2)
    run(2)


def test_a_wall_that_leans_out_of_the_plane():
    plate = Body()
    plate.shape, plate.material = Box(extents=(5, 0.5, 5)), material(0.3)
    O.bodies.append(plate)
    plate.dynamic = False
    plate.state.pos = (0, -0.5, 0)
    plate.state.ori = Quaternion((1, 0, 0), 0.5)
    free_disk(0, 0.55)
    begin()
    O.engines = replaced(
        Collider, PlanarGridCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.05), Bo1_Box_Aabb()], verletDist=0.05)
    )
    loop = of(InteractionLoop)
    loop.geomDispatcher.functors = list(loop.geomDispatcher.functors) + [Ig2_Box_Sphere_ScGeom()]
    refused("#0+#1", "leaves the x-y plane", "z component")


@pytest.mark.parametrize(
    "attribute, value, word",
    [
        ("mass", -1.0, "mass = -1"),
        ("mass", math.nan, "mass = nan"),
        ("inertia", (1, 1, -2.0), "inertia = -2"),
        ("inertia", (1, 1, 0), "inertia = 0"),
    ],
)
def test_masses_without_sense(attribute, value, word):
    disk = rests_on_a_floor()
    setattr(O.bodies[disk].state, attribute, value)
    refused(f"body #{disk}", word, "positive")


@pytest.mark.parametrize("radius", [0.0, -0.5, math.nan])
def test_radii_without_sense(radius):
    disk = rests_on_a_floor()
    far = free_disk(0, 5)
    O.bodies[far].shape.radius = radius
    refused(f"body #{far}", "radius", "positive radius")
    assert disk != far


def test_a_body_without_a_state():
    disk = rests_on_a_floor()
    run(1)
    O.bodies[disk].state = None
    refused(f"body #{disk}", "no state")


def box_body(stuff):
    body = Body()
    body.shape, body.material = Box(extents=(1, 1, 1)), stuff
    body.dynamic = False
    return body


SHAPES = {
    "Facet": (
        lambda stuff: utils.facet([(-5, 0, -5), (5, 0, -5), (0, 0, 5)], material=stuff),
        Bo1_Facet_Aabb,
        Ig2_Facet_Sphere_ScGeom,
    ),
    "Box": (box_body, Bo1_Box_Aabb, Ig2_Box_Sphere_ScGeom),
    "Wall": (lambda stuff: utils.wall(0, axis=1, material=stuff), Bo1_Wall_Aabb, Ig2_Wall_Sphere_ScGeom),
}


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("collider", [PlanarGridCollider, InsertionSortCollider])
def test_shapes_that_a_list_of_engines_does_not_know(name, collider):
    make, bo1, ig2 = SHAPES[name]
    stuff = material(0.3)
    O.bodies.append(make(stuff))
    free_disk(0, 3, stuff)
    begin()
    spheres = [Bo1_Sphere_Aabb(aabbEnlargeFactor=1.05), Bo1_Segment_Aabb()]
    O.engines = replaced(Collider, collider(spheres, verletDist=0.05))
    refused("body #0", f"a {name}", "NscdInteractionLoop has no Ig2 functor", "bounded = False")
    loop = of(InteractionLoop)
    loop.geomDispatcher.functors = list(loop.geomDispatcher.functors) + [ig2()]
    refused("body #0", f"a {name}", f"{collider.__name__} has no Bo1 functor", "bounded = False")
    O.bodies[0].bounded = False  # the script's own wish
    O.step()
    O.bodies[0].bounded = True
    O.engines = replaced(Collider, collider([*spheres, bo1()], verletDist=0.05))
    O.step()


def test_disks_that_a_loop_does_not_know():
    free_disk(0, 0), free_disk(0.9, 0)
    begin(gravity=(0, 0, 0))
    of(InteractionLoop).geomDispatcher.functors = [Ig2_Segment_Sphere_ScGeom()]
    refused("no functor for two Spheres", "Ig2_Sphere_Sphere_ScGeom")
    of(InteractionLoop).geomDispatcher.functors = [Ig2_Sphere_Sphere_ScGeom()]
    O.step()


# ---- materials and strengths ------------------------------------------------------------------------

BAD = [
    ({"frictionAngle": 30.0}, "frictionAngle = 30"),
    ({"restitution": 2.0}, "restitution = 2"),
    ({"tensileStrength": -1.0}, "tensileStrength = -1"),
    ({"density": -1.0}, "density = -1"),
    ({"residualRollingFriction": math.nan}, "residualRollingFriction = nan"),
]
BAD_WALLS = [
    ({"weakenedFrictionAngle": 2.0}, "weakenedFrictionAngle = 2"),
    ({"weakenedFrictionAngle": -0.1}, "weakenedFrictionAngle = -0.1"),
    ({"weakenedTensileStrength": -5.0}, "weakenedTensileStrength = -5"),
]


def plain_loop():
    """YADE's own loop with the same functors: no exception may leave its threads."""
    loop = of(InteractionLoop)
    O.engines = replaced(
        InteractionLoop,
        InteractionLoop(loop.geomDispatcher.functors, loop.physDispatcher.functors, loop.lawDispatcher.functors),
    )


@pytest.mark.parametrize("loop", [lambda: None, plain_loop])
@pytest.mark.parametrize(
    "kind, values, words", [(NscdMat, v, w) for v, w in BAD] + [(SlipWeakeningMat, v, w) for v, w in BAD_WALLS]
)
def test_a_material_given_straight_to_a_body(kind, values, words, loop):
    disk = rests_on_a_floor()
    body = 0 if kind is SlipWeakeningMat else disk
    # not one of O.materials, which are looked at in every step
    O.bodies[body].material = spoilt(kind(density=2500.0, frictionAngle=0.3), **values)
    loop()
    refused(f"body #{body}", words, "must be")
    O.bodies[body].material = O.materials[0]
    refused("#0+#1", "updateStrengths()")  # the contact was made of the other
    engine().updateStrengths()
    run(2)
    assert abs(O.bodies[disk].state.vel[1]) < 1e-12


@pytest.mark.parametrize(
    "name, value, word",
    [
        ("residualFriction", -0.1, "friction -0.1"),
        ("residualRollingArm", math.nan, "rolling arm nan"),
        ("restitution", 1.5, "restitution 1.5"),
        ("residualFriction", math.inf, "friction inf"),
    ],
)
def test_strengths_set_by_hand(name, value, word):
    rests_on_a_floor()
    run(1)
    setattr(contacts()[0].phys, name, value)
    refused("#0+#1", word, "updateStrengths()")
    engine().updateStrengths()
    O.step()


@pytest.mark.parametrize(
    "stuff, word",
    [(FrictMat(), "FrictMat"), (spoilt(NscdMat(), restitution=3.0), "restitution = 3"), (None, "no material")],
)
def test_update_strengths_from_materials_that_have_none(stuff, word):
    disk = rests_on_a_floor()
    run(1)
    friction = contacts()[0].phys.friction
    O.bodies[disk].material = stuff
    with pytest.raises(Exception, match=word):
        engine().updateStrengths()
    assert contacts()[0].phys.friction == friction


def test_a_body_without_material_that_is_met():
    rests_on_a_floor()
    falling = free_disk(0, 1.6, velocity=(0, -10, 0))
    O.bodies[falling].material = None
    with pytest.raises(Exception, match=f"body #{falling} has no material.*NscdMat"):
        run(50)


# ---- bodies that are held -----------------------------------------------------------------------------


def test_no_reaction_stays_between_bodies_that_are_held():
    disk = rests_on_a_floor()
    run(3)
    weight = O.bodies[disk].state.mass * G
    assert contacts()[0].phys.normal == pytest.approx(weight, rel=1e-9) and O.forces.f(0)[1] == pytest.approx(
        -weight, rel=1e-9
    )
    O.bodies[disk].state.blockedDOFs = "xyzXYZ"
    run(1)
    phys = contacts()[0].phys
    assert (phys.normal, phys.tangential, phys.torque) == (0, 0, 0) and phys.normalForce == Vector3(0, 0, 0)
    assert O.forces.f(0) == Vector3(0, 0, 0) and O.forces.f(disk) == Vector3(0, 0, 0)
    O.bodies[disk].state.blockedDOFs = "zXY"
    run(2)
    assert contacts()[0].phys.normal == pytest.approx(weight, rel=1e-9)


# ---- overlaps -----------------------------------------------------------------------------------------


def test_the_worst_overlap_is_named_and_the_others_counted(capfd):
    stuff = material(0.3)
    for k, apart in enumerate((0.97, 0.9, 0.9, 1.2)):  # of two diameters of 1 m
        for x in (0, apart):
            O.bodies.append(scene.disk((x, 5 * k), 0.5, stuff))
    for x in (20, 20.3):  # a rough floor may be made so
        O.bodies.append(scene.disk((x, 0), 0.5, stuff, fixed=True))
    begin(gravity=(0, 0, 0))
    run(1)
    e = engine()
    assert e.overlapWorst == pytest.approx(0.1, abs=1e-12)
    # the first of two that are alike, in the order of ids
    assert tuple(e.overlapWorstPair) == (2, 3) and e.overlappedSteps == 1
    assert (
        "began with 2 pairs of bodies deep in each other, the worst bodies #2 and #3, by 10 %" in capfd.readouterr().err
    )
    run(400)
    assert e.overlappedSteps < 401 and e.overlapWorst < 0.05 and e.overlapWorstEver == pytest.approx(0.1, abs=1e-12)


def test_a_deep_overlap_is_told_loudly_and_seldom(tmp_path):
    script = tmp_path / "press.py"
    script.write_text(
        """
from yade import nonsmooth
from contact_scenes import *
stuff = material(0.3)
O.bodies.append(scene.segments([(-5, 0), (5, 0)], stuff))
O.bodies.append(scene.disk((0, 0.5), 0.5, stuff))
lid = O.bodies.append(scene.segments([(-5, 1), (5, 1)], stuff))[0]
O.bodies[lid].state.vel = (0, -1, 0)
begin(tolerance=1e-4, maxIterations=50)
run(400)
print("steps", engine().overlappedSteps)
"""
    )
    done = launch(script)
    steps = int(done.stdout.split("steps")[1])
    told = [line for line in done.stderr.splitlines() if "in each other" in line]
    assert (
        done.returncode == 0 and 100 <= steps < 400 and len(told) == 3
    ), done.stderr  # the 1st, the 10th and the 100th
    assert "bodies #" in told[0] and "#1" in told[0] and "lower O.dt" in told[0]


# ---- O.resetTime ----------------------------------------------------------------------------------------


def test_a_bond_that_broke_is_counted_once():
    stuff = material(0.3, tensileStrength=10.0, bondCreationDistance=0.02)
    free_disk(0, 0, stuff), free_disk(1, 0, stuff)
    begin(gravity=(0, 0, 0), reach=0.5)
    run(1)
    e = engine()
    assert e.bond() == 1
    O.bodies[1].state.vel = (5, 0, 0)
    run(20)
    assert e.brokenTension == 1 and contacts()[0].phys.brokenStep > 0
    O.bodies[1].state.vel = (0, 0, 0)
    O.resetTime()
    run(contacts()[0].phys.brokenStep + 3)  # the same number of a step again, and the contact is still there
    assert len(contacts()) == 1 and e.brokenTension == 1


def test_what_was_read_before_time_began_anew_is_not_read_again():
    disk = rests_on_a_floor(reach=0.4)
    run(10)
    O.resetTime()
    of(NscdInteractionLoop).loopOnSortedInteractions = True  # YADE's plain loop, which leaves no readings
    O.bodies[disk].state.pos = (0, 0.8, 0)  # in free fall over a contact that is known
    run(12)
    assert len(contacts()) == 1
    # step 9 had been read when the disk lay on the floor, and would hold it
    assert O.bodies[disk].state.vel[1] == pytest.approx(-12 * G * O.dt, rel=1e-12)


# ---- shapes that are replaced -----------------------------------------------------------------------


def test_a_wall_whose_shape_is_replaced():
    disk = rests_on_a_floor()
    run(3)
    O.bodies[0].shape = Segment(halfLength=20, sense=1)
    run(3)
    assert abs(O.bodies[disk].state.vel[1]) < 1e-12 and contacts()[0].phys.normal > 0
    O.bodies[0].shape = Box(extents=(5, 1, 1))
    refused("body #0", "a Box", "Ig2")
    loop = of(InteractionLoop)
    loop.geomDispatcher.functors = list(loop.geomDispatcher.functors) + [Ig2_Box_Sphere_ScGeom()]
    O.engines = replaced(
        Collider, PlanarGridCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.05), Bo1_Box_Aabb()], verletDist=0.05)
    )
    O.bodies[0].state.pos = (0, -1, 0)
    run(5)
    assert abs(O.bodies[disk].state.vel[1]) < 1e-12 and contacts()[0].phys.normal > 0
    O.bodies[0].shape = None  # nothing to touch any more
    run(3)
    assert O.bodies[disk].state.vel[1] == pytest.approx(-3 * G * O.dt, rel=1e-9)


def test_a_disk_that_becomes_a_wall():
    disk = rests_on_a_floor()
    above = O.bodies.append(scene.disk((0, -0.5), 0.5, O.materials[0], fixed=True))  # under the floor, in touch with it
    run(3)
    O.bodies[above].shape = Segment(halfLength=3)
    O.bodies[above].state.pos = (0, -3, 0)
    O.bodies[0].state.pos = (0, -10, 0)  # the floor goes
    run(1200)  # it falls by 3 m in 0.78 s
    assert O.bodies[disk].state.pos[1] == pytest.approx(-2.5, abs=1e-3)


# ---- warnings -------------------------------------------------------------------------------------------


def test_warnings_where_it_matters(tmp_path):
    """Impacts without weight and forces next to nothing are counted; what lasts is told."""
    script = tmp_path / "warnings.py"
    script.write_text(
        """
import sys
from yade import nonsmooth
from contact_scenes import *
stuff = material(0.3, 0.1)
if sys.argv[1] == "impacts":
    for k in range(12):
        O.bodies.append(scene.disk((1.02 * k, 0), 0.5, stuff))
    O.bodies[0].state.vel = (3, 0, 0)
    begin(gravity=(0, 0, 0), dt=1e-3, tolerance=1e-4, maxIterations=2000)  # as usual
    run(400)
else:
    box(stuff, 9.5, 12)
    loose_heap(stuff)
    begin(dt=5e-3, tolerance=1e-8, maxIterations=3)
    run(400)
print("counted", engine().unconverged, engine().unsolved)
"""
    )
    impacts, heap = launch(script, "impacts"), launch(script, "heap")
    counts = [[int(word) for word in done.stdout.split("counted")[1].split()] for done in (impacts, heap)]
    assert counts[0][0] > 0 and counts[0][1] == 0 and "not solved" not in impacts.stderr, (
        impacts.stdout + impacts.stderr
    )
    assert (
        counts[1][0] > 100 and counts[1][1] > 0 and "not solved" in heap.stderr and "Raise maxIterations" in heap.stderr
    ), (heap.stdout + heap.stderr)


@pytest.mark.parametrize("radius", [-0.5, 0.0, math.nan])
def test_a_radius_without_sense_is_refused_where_no_other_disk_is(radius):
    stuff = material(0.5)
    O.bodies.append(scene.segments([(-5, 0), (5, 0)], stuff, sense=1))
    disk = O.bodies.append(scene.disk((0, 0.5), 0.5, stuff))
    O.bodies[disk].shape.radius = radius
    begin()
    with pytest.raises(RuntimeError, match=f"body #{disk}.* is a Sphere of radius"):
        O.step()


@pytest.mark.parametrize("between", [0, 2])
def test_two_disks_need_a_functor(between):
    """Whatever bodies without a shape, or walls, stand between them."""
    stuff = material()
    free_disk(0, 0, stuff)
    for k in range(between):
        O.bodies.append(scene.segments([(5 + k, 0), (6 + k, 0)], stuff))
    free_disk(0.9, 0, stuff)
    begin(gravity=(0, 0, 0))
    loop = next(e for e in O.engines if isinstance(e, InteractionLoop))
    loop.geomDispatcher.functors = [Ig2_Segment_Sphere_ScGeom()]
    refused("Ig2_Sphere_Sphere_ScGeom", "would pass through each other")
