"""Every refusal and every limit of an engine's settings, from both sides: what just goes, and what does not, in words
that name it.
"""
import math

import pytest
from yade import O
from yade.nonsmooth import scene
from yade.wrapper import (
    BondEllipseEngine,
    Collider,
    ContactDynamicsEngine,
    DomainLimiter,
    ForceResetter,
    FrictMat,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_FrictMat_FrictMat_FrictPhys,
    Law2_ScGeom_FrictPhys_CundallStrack,
    Law2_ScGeom_NscdPhys_SignoriniCoulomb,
    Ip2_NscdMat_NscdMat_NscdPhys,
    NewtonIntegrator,
    NonsmoothTimeStepper,
    NscdInteractionLoop,
    NscdMat,
    PlanarNewtonIntegrator,
    PorePressureEngine,
    PyRunner,
    SlipWeakeningMat,
)

from contact_scenes import G, begin, contacts, engine, free_disk, material, refused, run


pytestmark = pytest.mark.usefixtures("empty")


def rests(**options):
    stuff = material(0.3, label="rock")
    O.bodies.append(scene.segments([(-5, 0), (5, 0)], stuff))
    disk = free_disk(0, 0.5, stuff=stuff)
    begin(**options)
    return disk


def swapped(kind, other):
    O.engines = [other(e) if isinstance(e, kind) else e for e in O.engines]


def plain_loop(e, physics=None, laws=None):
    return InteractionLoop(
        e.geomDispatcher.functors,
        e.physDispatcher.functors if physics is None else physics,
        e.lawDispatcher.functors if laws is None else laws,
    )


# ---- settings -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name, good, bad, words",
    [
        ("tolerance", (1e-300, 10.0), (0.0, -1e-9, 1e300, math.inf, math.nan), "positive and finite"),
        ("maxIterations", (1,), (0, -1), "at least 1"),
        ("checkEvery", (1,), (0, -1), "at least 1"),
        ("correctionSweeps", (0, 1), (-1, 2**31 - 1), "from 0 to 1000000"),
        ("relaxationRate", (0.0, 1.0), (-1e-9, 1 + 1e-9, math.nan), "from 0 to 1"),
        ("correctionSpeed", (0.0, 1e9), (-1e-9, math.nan), "0 or more"),
        ("correctionSlack", (0.0, 1 - 1e-9), (-1e-9, 1.0, math.nan), "from 0 to less than 1"),
        ("openGap", (0.0, 10.0), (-1e-9, math.nan), "0 or more"),
        ("method", ("accelerated", "gaussSeidel"), ("GaussSeidel", ""), "'accelerated' or 'gaussSeidel'"),
        ("precision", ("mixed", "double"), ("single", ""), "'mixed' or 'double'"),
        (
            "stoppingTest",
            ("naturalMap", "Quad", "Maxm", "QM/16"),
            ("", "quad"),
            "'naturalMap', 'Quad', 'Maxm' or 'QM/16'",
        ),
    ],
)
def test_settings_of_the_solver(name, good, bad, words):
    rests(maxIterations=5)
    for value in good:
        setattr(engine(), name, value)
        O.step()
    for value in bad:
        setattr(engine(), name, value)
        refused("ContactDynamicsEngine", name, "must be", words)


@pytest.mark.parametrize(
    "name, good, bad, words",
    [
        ("smallest", (1e-9, 1e-2), (0.0, -1.0, math.nan, math.inf), "positive"),
        ("path", (1e-9, 1e9), (0.0, -1.0, math.nan, math.inf), "positive"),
        ("bondPath", (1e-9, 1e9), (0.0, -1.0, math.nan, math.inf), "positive"),
        ("growth", (1.0, 1e9), (1 - 1e-9, math.nan), "at least 1"),
        ("largest", (1e-4, 1.0), (1e-4 - 1e-9, math.nan, math.inf), "not be below smallest = 0.0001"),
    ],
)
def test_settings_of_the_time_stepper(name, good, bad, words):
    rests()
    O.engines = [NonsmoothTimeStepper()] + O.engines
    for value in good:
        setattr(O.engines[0], name, value)
        O.step()
    for value in bad:
        setattr(O.engines[0], name, value)
        refused("NonsmoothTimeStepper", name, words)


BELOW = math.pi / 2 - 1e-9
STRENGTHS = [
    ("density", (1e-9, 1e9), (0.0, -1.0, math.nan), "positive"),
    ("tensileStrength", (0.0, 1e12), (-1e-9, math.nan), "0 or more"),
    ("residualTensileStrength", (0.0, 1e12), (-1e-9, math.nan), "0 or more"),
    ("frictionAngle", (0.0, BELOW), (-1e-9, math.pi / 2, 30.0, math.nan), "below π/2"),
    ("residualFrictionAngle", (-1.0, 0.0, BELOW), (math.pi / 2, math.nan, -math.inf), "below π/2"),
    ("rollingFriction", (0.0, 10.0), (-1e-9, math.nan), "0 or more"),
    ("residualRollingFriction", (-1.0, 0.0, 10.0), (math.nan, math.inf, -math.inf), "negative for the peak"),
    ("bondEllipseNormal", (1e-9, 10.0), (0.0, -1.0, math.nan), "positive"),
    ("bondEllipseTangential", (1e-9, 10.0), (0.0, -1.0, math.nan), "positive"),
    ("bondCreationDistance", (0.0, 10.0), (-1e-9, math.nan), "0 or more"),
    ("restitution", (0.0, 1.0), (-1e-9, 1 + 1e-9, math.nan), "from 0 to 1"),
]
WEAK = [
    ("weakenedFrictionAngle", (0.0, BELOW), (-1e-9, math.pi / 2, math.nan), "below π/2"),
    ("weakenedTensileStrength", (0.0, 1e12), (-1e-9, math.nan), "0 or more"),
    ("criticalSlip", (1e-9, 1e9, math.inf), (0.0, -1.0, math.nan), "positive"),
    ("weakening", ("step", "linear", "exponential"), ("Step", ""), "'step', 'linear' or 'exponential'"),
]


def spoil(stuff, name, value, words=""):
    """Sets an attribute to a value without sense. It is refused there, since scenes with soft contacts could not do so
    later, and has the value all the same. Those of YADE's own classes leave no mark."""
    if name in ("frictionAngle", "density"):
        return setattr(stuff, name, value)
    with pytest.raises(ValueError) as error:
        setattr(stuff, name, value)
    assert name in str(error.value) and "must be" in str(error.value) and words in str(error.value)


@pytest.mark.parametrize(
    "kind, name, good, bad, words",
    [(NscdMat, *row) for row in STRENGTHS]
    + [(SlipWeakeningMat, *row) for row in STRENGTHS[:1] + STRENGTHS[-1:] + WEAK],
)
def test_strengths_of_a_material_that_no_contact_has(kind, name, good, bad, words):
    rests()
    other = material(0.2, kind=kind, label="other")
    for value in good:
        setattr(other, name, value)
        O.step()
    for value in bad:
        spoil(other, name, value, words)
        refused(name, "must be", words)
        with pytest.raises(Exception, match=name):  # updateStrengths looks at the materials of bodies
            O.bodies[0].material = other
            engine().updateStrengths()
        O.bodies[0].material = O.materials[0]


@pytest.mark.parametrize("loop", [None, plain_loop])
@pytest.mark.parametrize(
    "name, value",
    [
        ("weakening", "Step"),
        ("criticalSlip", 0.0),
        ("residualTensileStrength", -1.0),
        ("bondCreationDistance", math.nan),
    ],
)
def test_a_wall_without_sense_that_is_met(name, value, loop):
    rests()
    O.bodies[0].material = stuff = SlipWeakeningMat(density=2500.0)
    spoil(stuff, name, value)
    if loop:
        swapped(InteractionLoop, loop)
    refused(name, "must be")


# ---- scenes ---------------------------------------------------------------------------------------


def test_a_step_of_no_length():
    rests()
    O.dt = 0
    refused("O.dt = 0", "positive time step")


def test_periodic_scenes():
    rests()
    swapped(Collider, lambda e: InsertionSortCollider(e.boundDispatcher.functors, verletDist=0.1))
    O.periodic = True
    O.cell.setBox(50, 50, 50)
    refused("ContactDynamicsEngine", "periodic", "O.periodic = False")


def test_a_periodic_scene_is_not_sent_from_one_engine_to_the_next():
    rests()
    O.periodic = True
    O.cell.setBox(50, 50, 50)
    with pytest.raises(RuntimeError, match="O.periodic = False") as error:
        O.step()
    assert "PlanarGridCollider" in str(error.value) and "InsertionSortCollider" not in str(error.value)


@pytest.mark.parametrize("place", ["end", "beginning"])
def test_a_domain_limiter_is_refused_before_it_ends_the_process(place):
    disk = rests()
    O.bodies[disk].state.pos = (100, 100, 0)  # outside: it would be erased in the first step
    limiter = DomainLimiter(lo=(-1, -1, -1), hi=(1, 5, 1), iterPeriod=1, label="limit")
    O.engines = O.engines + [limiter] if place == "end" else O.engines[:1] + [limiter] + O.engines[1:]
    if place == "beginning":
        O.bodies[disk].state.pos = (0, 0.5, 0)  # nobody of ours comes before it, so it has its turn
    refused("DomainLimiter 'limit'", "PyRunner", "O.bodies.erase(b.id)")
    limiter.dead = True
    command = "for b in [b for b in O.bodies if b.state.pos[1] > 3]: O.bodies.erase(b.id)"
    O.bodies[disk].state.pos = (100, 100, 0)
    O.engines = [e for e in O.engines if e is not limiter] + [PyRunner(command=command, iterPeriod=1)]
    run(3)
    assert O.bodies[disk] is None and len(O.bodies) == disk + 1


def test_clumps_meet_the_solver():
    stuff = material(0.3)
    O.bodies.appendClumped([scene.disk((x, 0), 0.5, stuff) for x in (0, 0.8)])
    begin()
    swapped(InteractionLoop, plain_loop)
    swapped(NewtonIntegrator, lambda e: NewtonIntegrator(damping=0, gravity=e.gravity))
    refused("ContactDynamicsEngine", "clump", "single disks, which bonds can hold together")


def test_an_aspherical_body_that_may_turn_any_way_is_not_the_planar_integrators():
    disk = free_disk()
    O.bodies[disk].aspherical = True
    O.bodies[disk].state.blockedDOFs = "z"
    O.engines, O.dt = [ForceResetter(), PlanarNewtonIntegrator(damping=0)], 1e-3
    refused("PlanarNewtonIntegrator", f"#{disk}", "aspherical", "NewtonIntegrator")
    O.bodies[disk].aspherical = False
    O.step()


def test_forces_that_are_no_numbers():
    disk = rests()
    O.forces.setPermF(disk, (math.nan, 0, 0))
    refused(f"body #{disk}", "force that is not finite", "engines that add forces")


@pytest.mark.parametrize(
    "name, value", [("pos", (math.inf, 0, 0)), ("vel", (0, math.nan, 0)), ("angVel", (0, 0, math.inf))]
)
def test_states_that_are_no_numbers(name, value):
    disk = rests()
    swapped(
        Collider, lambda e: InsertionSortCollider(e.boundDispatcher.functors, verletDist=0.1) if name == "pos" else e
    )
    setattr(O.bodies[disk].state, name, value)
    refused(f"body #{disk}", "position or velocity that is not finite")


@pytest.mark.parametrize("blocked", ["", "z", "zX", "zY", "XY"])
def test_bodies_that_may_leave_the_plane(blocked):
    disk = rests()
    O.bodies[disk].state.blockedDOFs = blocked
    refused(f"#{disk}", "can leave the x-y plane", "'zXY'")
    O.bodies[disk].state.blockedDOFs = "xyzXYZ"  # does not move at all
    O.step()


# ---- lists of engines and functors ----------------------------------------------------------------


def test_a_collider_behind_the_solver():
    rests()
    (collider,) = (e for e in O.engines if isinstance(e, Collider))
    rest = [e for e in O.engines if e is not collider and not isinstance(e, Collider)]
    O.engines = [
        e
        for engine_ in rest
        for e in ([engine_, collider] if isinstance(engine_, ContactDynamicsEngine) else [engine_])
    ]
    refused("PlanarGridCollider stands after ContactDynamicsEngine", "put it before")


@pytest.mark.parametrize(
    "without, words",
    [
        ("physics", ("functor Ip2 for NscdMat and NscdMat", "add Ip2_NscdMat_NscdMat_NscdPhys() to the second list")),
        (
            "laws",
            ("functor Law2 for SegmentGeom and NscdPhys", "Law2_ScGeom_NscdPhys_SignoriniCoulomb() to the third list"),
        ),
    ],
)
def test_a_loop_without_a_functor(without, words):
    rests()
    swapped(
        InteractionLoop,
        lambda e: NscdInteractionLoop(
            e.geomDispatcher.functors,
            [] if without == "physics" else [Ip2_NscdMat_NscdMat_NscdPhys()],
            [] if without == "laws" else e.lawDispatcher.functors,
        ),
    )
    refused("NscdInteractionLoop: bodies #0 and #1 touch", *words)


def test_a_body_that_touches_with_another_material():
    """The usual slip: YADE's makers give a body a FrictMat where a script names no material."""
    disk = rests()
    O.bodies[disk].material = FrictMat(label="default")
    refused(
        "NscdInteractionLoop: bodies #0 and #1", f"body #{disk} has another material, a FrictMat", "give it an NscdMat"
    )
    O.bodies[disk].material = O.bodies[0].material
    O.step()


def test_a_law_for_springs_in_a_rigid_scene():
    rests()
    swapped(
        InteractionLoop,
        lambda e: NscdInteractionLoop(
            e.geomDispatcher.functors, [Ip2_FrictMat_FrictMat_FrictPhys()], e.lawDispatcher.functors
        ),
    )
    refused(
        "functor Law2 for SegmentGeom and FrictPhys", "give both bodies an NscdMat", "Ip2_NscdMat_NscdMat_NscdPhys()"
    )


@pytest.mark.parametrize("loop", [plain_loop, None])
def test_another_material_is_refused_before_it_touches(loop):
    """YADE's loop would end the process at the first contact."""
    rests()
    if loop:
        swapped(InteractionLoop, loop)
    far = free_disk(0, 30)
    O.bodies[far].material = FrictMat(label="default")
    refused(
        f"body #{far} has another material, a FrictMat 'default'",
        "no Ip2 functor",
        "give it an NscdMat",
        "bounded = False",
    )
    O.bodies[far].bounded = False
    O.step()


HALVES = {
    "springs": ([Ip2_NscdMat_NscdMat_NscdPhys], [Law2_ScGeom_FrictPhys_CundallStrack]),
    "rigid": ([Ip2_FrictMat_FrictMat_FrictPhys], [Law2_ScGeom_NscdPhys_SignoriniCoulomb]),
}


@pytest.mark.parametrize("solver", [True, False])
@pytest.mark.parametrize("law", HALVES)
@pytest.mark.parametrize("who", ["PlanarGridCollider", "NscdInteractionLoop", "ContactDynamicsEngine"])
def test_a_script_that_was_converted_by_halves_is_refused_before_the_first_contact(who, law, solver):
    stuff = material(0.3)
    for x in (0, 3):
        free_disk(x, 0, stuff=stuff)
    begin()
    physics, laws = ([kind() for kind in kinds] for kinds in HALVES[law])
    if who != "PlanarGridCollider":
        swapped(Collider, lambda e: InsertionSortCollider(e.boundDispatcher.functors, verletDist=0.1))
    kind = NscdInteractionLoop if who == "NscdInteractionLoop" else InteractionLoop
    swapped(InteractionLoop, lambda e: kind(e.geomDispatcher.functors, physics, laws))
    O.engines = [e for e in O.engines if solver or not isinstance(e, ContactDynamicsEngine)]
    if law == "rigid" and who == "NscdInteractionLoop" and solver:
        return run(1)  # it names the bodies at their first contact
    if who == "ContactDynamicsEngine" and not solver:
        return run(1)  # nobody of ours: see below
    words = {
        "springs": (
            "Ip2_NscdMat_NscdMat_NscdPhys, whose contacts are rigid",
            "Law2_ScGeom_FrictPhys_CundallStrack, which",
        ),
        "rigid": (
            "Law2_ScGeom_NscdPhys_SignoriniCoulomb, the law of rigid contacts, and Ip2_FrictMat_FrictMat_FrictPhys",
        ),
    }[law]
    if law == "rigid" and who == "NscdInteractionLoop":
        words = ("contacts bear nothing",)
    refused(f"{who}: ", *words)
    if words[0] != "contacts bear nothing":
        refused("give it Ip2_NscdMat_NscdMat_NscdPhys() and Law2_ScGeom_NscdPhys_SignoriniCoulomb()")
        if not solver:
            refused("and O.engines a ContactDynamicsEngine before NewtonIntegrator")


def test_a_script_of_which_only_materials_and_their_functor_were_converted_is_told_of(capfd):
    """Nothing of ours comes before YADE's loop, which no exception may leave."""
    rests()
    swapped(Collider, lambda e: InsertionSortCollider(e.boundDispatcher.functors, verletDist=0.1))
    swapped(InteractionLoop, lambda e: plain_loop(e, laws=[Law2_ScGeom_FrictPhys_CundallStrack()]))
    O.engines = [e for e in O.engines if not isinstance(e, ContactDynamicsEngine)]
    run(3)
    told = [line for line in capfd.readouterr().err.splitlines() if "whose contacts are rigid" in line]
    assert len(told) == 1 and "O.engines a ContactDynamicsEngine" in told[0]


def test_soft_contacts_between_our_materials_are_let_be(capfd):
    """An NscdMat is a FrictMat too, and YADE's own functors make springs of it."""
    rests()
    swapped(
        InteractionLoop,
        lambda e: plain_loop(e, [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
    )
    O.engines = [e for e in O.engines if not isinstance(e, ContactDynamicsEngine)]
    O.dt = 1e-5
    run(3)
    assert contacts() and contacts()[0].phys.kn > 0 and "rigid" not in capfd.readouterr().err


def test_another_material_with_a_functor_of_its_own_is_let_be():
    rests()
    loop = next(e for e in O.engines if isinstance(e, InteractionLoop))
    loop.physDispatcher.functors = [Ip2_NscdMat_NscdMat_NscdPhys(), Ip2_FrictMat_FrictMat_FrictPhys()]
    O.bodies[free_disk(0, 30)].material = FrictMat()
    O.step()


def test_water_with_tables_that_do_not_fit():
    rests(before=[PorePressureEngine(times=[1, 2], heights=[1])])
    refused("PorePressureEngine", "times has 2", "heights 1")
    O.engines[3].heights = [1, 2]
    O.step()
    O.engines[3].times = [2, 1]
    refused("PorePressureEngine", "times must rise")


def test_bonds_that_a_bond_ellipse_engine_cannot_follow():
    stuff = material(0.3, bondCreationDistance=0.1)
    for x in (0, 1, 5):
        free_disk(x, 0, stuff=stuff)
    begin(gravity=(0, 0, 0))
    run(1)
    ellipses = BondEllipseEngine()
    for pair in ((0, 1), (0, 2), (0, 7)):
        with pytest.raises(ValueError, match=f"bodies {pair[0]} and {pair[1]} are not bonded"):
            ellipses.add(*pair, 0.1, 0.1, 0.3, 0.1)
    assert ellipses.count == 0 and len(contacts()) == 1


# ---- the Python side of a scene -------------------------------------------------------------------


def test_walls_without_length_and_scenes_without_a_solver():
    stuff = material(0.3)
    with pytest.raises(ValueError, match="two vertices or more, not 1"):
        scene.segments([(0, 0)], stuff)
    with pytest.raises(ValueError, match=r"coincide at \(1, 2\)"):
        scene.segments([(0, 0), (1, 2), (1, 2)], stuff)
    with pytest.raises(ValueError, match="coincide"):
        scene.segments([(0, 0), (0, 0)], stuff, closed=True)
    for bad in ((math.nan, 1), (1, -math.inf), (1, 2, 3)):
        with pytest.raises(ValueError, match=r"vertex 1 of a wall is .*: give two finite coordinates"):
            scene.segments([(0, 0), bad], stuff)
    for piece in (0, -1, math.nan, math.inf):
        with pytest.raises(ValueError, match=f"piece = {piece}: give a positive length"):
            scene.segments([(0, 0), (1, 0)], stuff, piece=piece)
    for sense in (2, -3, 0.5, math.nan):
        with pytest.raises(ValueError, match=f"sense = {sense}: give \\+1"):
            scene.segments([(0, 0), (1, 0)], stuff, sense=sense)
    for inside in (2, -1, "left"):
        with pytest.raises(ValueError, match=f"inside {inside!r}: give True .the inside acts., False"):
            scene.arc((0, 0), 1, 0, 3, stuff, inside=inside)
    O.engines = []
    with pytest.raises(LookupError, match="no ContactDynamicsEngine: set O.engines"):
        scene.contact_dynamics()
    begin()
    assert scene.contact_dynamics() is not None


def test_the_margin_of_the_search_goes_with_the_sizes():
    """Of 0.1 m at 1 m; micrometre disks have as many pairs as metre disks."""
    found = []
    for radius in (0.5, 0.5e-6):
        O.reset()
        stuff = material(0.3)
        for k in range(100):
            O.bodies.append(scene.disk((2.2 * radius * (k % 10), 2.2 * radius * (k // 10)), radius, stuff))
        begin(gravity=(0, 0, 0))
        O.step()
        found.append(next(e for e in O.engines if isinstance(e, Collider)).candidates)
    assert found == [180, 180]  # neighbours at 2.2 radii; the margin ends at 2.3


def test_a_material_without_a_friction_angle_has_half_a_radian():
    assert NscdMat().frictionAngle == 0.5 and "0.5 rad" in NscdMat.__doc__


# ---- what is told, not refused --------------------------------------------------------------------


def test_forces_that_nobody_resets_are_told_of_by_the_integrator(capfd):
    free_disk()
    O.engines, O.dt = [PlanarNewtonIntegrator(damping=0)], 1e-3
    run(3)
    assert "put ForceResetter() first" in capfd.readouterr().err
    O.engines[0].warnNoForceReset = False
    run(3)
    assert "ForceResetter" not in capfd.readouterr().err


def test_a_lasting_miss_is_told_after_ten_steps_and_a_heavy_one_at_once(capfd):
    """A step matters that misses ten tolerances, with forces of more than that share of a body's weight: told at the
    tenth in a row, and where it is more than the whole.
    """
    stuff, tolerance = material(0.3), 1e-6
    O.bodies.append(scene.segments([(-5, 0), (5, 0)], stuff))
    disks = [free_disk(0, 0.5 + k, stuff=stuff) for k in range(12)]
    O.bodies[disks[-1]].state.vel = (0, -0.4, 0)
    e = begin(tolerance=tolerance, maxIterations=3, checkEvery=1)
    weight, row, due, reasons = O.bodies[disks[0]].state.mass * G, 0, 0, set()
    for _ in range(200):
        missed = e.unconverged
        O.step()
        forces = e.residual > 10 * tolerance and e.residualForce > 10 * tolerance * weight
        matters = e.unconverged > missed and (forces or e.residualSpeedWorst > 0.3)
        row = row + 1 if matters else 0
        heavy = matters and e.residualForce > weight
        due += row == 10 or heavy
        assert e.unsolved == due
        warned = "was not solved" in capfd.readouterr().err
        assert warned == ((row == 10 or heavy) and due in (1, 10, 100))
        reasons |= {("lasts", row == 10), ("heavy", heavy), ("matters", bool(matters))}
    assert {("lasts", True), ("heavy", True), ("heavy", False), ("matters", True)} <= reasons, reasons


def test_an_overlap_names_the_tolerance_too(capfd):
    disk = rests(tolerance=0.03)
    O.bodies[disk].state.pos = (0, 0.4, 0)
    run(1)
    told = capfd.readouterr().err
    assert "in each other" in told and "lower tolerance (it is 0.03)" in told and "O.dt" in told


def test_bonds_are_counted_when_they_are_made_and_removed():
    stuff = material(0.3, tensileStrength=1e5)
    for k in range(4):
        free_disk(k, 0, stuff=stuff)
    e = begin(gravity=(0, 0, 0))
    run(1)
    assert (e.bond(), e.bonds) == (3, 3)
    assert (e.bond(), e.bonds) == (0, 3)
    e.advance(2)
    assert e.bonds == 3
    free_disk(4, 0, stuff=stuff)
    e.advance(2, view=False)
    assert (e.bond(), e.bonds) == (1, 4)
    assert (e.bond(), e.bonds) == (0, 4)
    assert (e.unbond(), e.bonds) == (4, 0)
    e.advance(1)
    assert e.bonds == 0


def test_bonds_of_contacts_that_have_no_interaction_are_counted_too():
    stuff = material(0.3, tensileStrength=1e5)
    for k in range(4):
        free_disk(k, 0, stuff=stuff)
    e = begin(gravity=(0, 0, 0))
    e.advance(1, view=False)
    assert (e.bond(), e.bonds) == (3, 3)
    e.advance(1, view=False)
    assert len(O.interactions) == 0
    assert (e.bond(), e.bonds) == (0, 3)
