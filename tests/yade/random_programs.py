"""Random programs: small scenes that are changed between and within steps, run in every way in which a scene can be
run. All that can be read in the end, and at each change on the way, is the same to the last bit. Of disks here; of spheres in random_programs_space.py.

    scripts/yade-nonsmooth tests/yade/random_programs.py --programs 500          the first 500
    scripts/yade-nonsmooth tests/yade/random_programs.py --first 137 -v          one of them, with what it does

The ways: ``O.step()`` (stepped), advance() that shows all, nothing, or single bodies (seen, unseen, alone), a run in
the background beside a thread that asks for tables and views (beside), and YADE's own collider, loop and integrator
with the same solver (plain). A program that a way cannot run is left out there and counted.
"""
import argparse
import math
import random
import sys
import threading
import time
from dataclasses import dataclass, field

import __main__
from yade import O, utils
from yade.minieigenHP import Quaternion, Vector3
from yade.nonsmooth import scene
from yade.wrapper import (
    Bo1_Arc_Aabb,
    Bo1_Segment_Aabb,
    Bo1_Sphere_Aabb,
    Collider,
    ContactDynamicsEngine,
    ForceEngine,
    Ig2_Arc_Sphere_ScGeom,
    Ig2_Segment_Sphere_ScGeom,
    Ig2_Sphere_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    Ip2_NscdMat_NscdMat_NscdPhys,
    Law2_ScGeom_NscdPhys_SignoriniCoulomb,
    NewtonIntegrator,
    NonsmoothTimeStepper,
    NscdInteractionLoop,
    NscdMat,
    PlanarGridCollider,
    PlanarNewtonIntegrator,
    PorePressureEngine,
    PyRunner,
    Segment,
    SlipWeakeningMat,
    Sphere,
    WallForceEngine,
)

REACH = 0.1
WAYS = ("stepped", "seen", "unseen", "alone", "beside", "plain")


# ---- what is there --------------------------------------------------------------------------------


def one(kind):
    """The first engine of a kind, null where there is none."""
    return next((e for e in O.engines if isinstance(e, kind)), None)


def solver():
    return one(ContactDynamicsEngine)


def disks():
    return [b.id for b in O.bodies if b and isinstance(b.shape, Sphere)]


def walls():
    return [b.id for b in O.bodies if b and not isinstance(b.shape, Sphere)]


def near_contacts():
    """Contacts that every way knows: YADE's collider finds walls later than ours, over gaps at which nothing acts."""
    return sorted(
        (
            (i.id1, i.id2)
            for i in O.interactions
            if i.isReal
            and O.interactions.has(i.id1, i.id2)
            and hasattr(i.phys, "bonded")
            and (i.phys.bonded or -i.geom.penetrationDepth < 0.02)
        ),
        key=lambda pair: (min(pair), max(pair)),
    )


def bits(value):
    if isinstance(value, float):
        return (value + 0.0).hex()  # a zero has no sign
    if isinstance(value, (Vector3, Quaternion)):
        return tuple(bits(v) for v in value)
    return value


def outcome():
    """All that every way gives, by name."""
    found = {"iter": O.iter, "time": bits(O.time), "dt": bits(O.dt)}
    for b in O.bodies:
        if b:
            s = b.state
            found[f"body {b.id}"] = [bits(v) for v in (s.pos, s.vel, s.angVel, s.ori, s.mass)] + [s.blockedDOFs]
    for a, b in near_contacts():
        i = O.interactions[a, b]
        p, g = i.phys, i.geom
        numbers = (
            p.normal,
            p.tangential,
            p.torque,
            p.length,
            p.friction,
            p.currentFriction,
            p.adhesion,
            g.penetrationDepth,
        )
        found[f"contact {min(a, b)} {max(a, b)}"] = [bits(v) for v in numbers] + [
            p.bonded,
            p.brokenMode,
            p.brokenStep,
            type(p).__name__,
            *(bits(v) for v in present().vectors_of(p, g)),
        ]
    c = solver()
    if c:
        for name in ("steps", "bonds", "brokenTension", "brokenShear", "brokenTorque", "brokenMixed", "unconverged"):
            found[name] = getattr(c, name)
        for name, value in c.energies().items():
            found[f"energy {name}"] = bits(value)
        found["breaks"] = bytes(c.breakTable())
        found["maxSpeed"] = bits(c.maxSpeed)
    for k, m in enumerate(O.materials):
        if isinstance(m, SlipWeakeningMat):
            found[f"slip {k}"] = [bits(m.slipOf(i)) for i in disks()]
            found[f"weakened {k}"] = m.weakenedCount()
    water = one(PorePressureEngine)
    if water:
        found["water"] = bytes(water.bodyTable()), water.wetCount, water.releasedCount
    sums = one(WallForceEngine)
    if sums:
        found["wall forces"] = [bits(v) for v in (sums.seconds, sums.normal, sums.shear, sums.peak)]
    return found


# ---- changes --------------------------------------------------------------------------------------

KINDS = {}  # by name: the function, what it looks at, and where it may be


def kind(looks="all", within=True, between=True, ways=WAYS):
    """``looks``: "all", "none", or "bodies", those that the function is given; ``ways``: those in which YADE itself can
    do it.
    """

    def note(function):
        KINDS[function.__name__] = dict(function=function, looks=looks, within=within, between=between, ways=ways)
        return function

    return note


NOT_PLAIN = tuple(w for w in WAYS if w != "plain")
NOT_BESIDE = tuple(w for w in WAYS if w != "beside")


@kind("bodies")
def velocity(dice, ids):
    for i in ids:
        O.bodies[i].state.vel += Vector3(dice.uniform(-1, 1), dice.uniform(-1, 1), 0)


@kind("bodies")
def spin(dice, ids):
    for i in ids:
        O.bodies[i].state.angVel = (0, 0, dice.uniform(-3, 3))


@kind("bodies")
def place(dice, ids):
    for i in ids:
        O.bodies[i].state.pos += Vector3(dice.uniform(-0.02, 0.02), dice.uniform(0, 0.03), 0)


@kind("bodies")
def turned(dice, ids):
    for i in ids:
        O.bodies[i].state.ori = Quaternion((0, 0, 1), dice.uniform(-0.02, 0.02)) * O.bodies[i].state.ori


@kind("bodies")
def blocked(dice, ids):
    for i in ids:
        O.bodies[i].state.blockedDOFs = dice.choice(("zXY", "xyzXYZ", "xzXY", "zXYZ", "zXY"))
        if O.bodies[i].state.blockedDOFs == "xyzXYZ":
            O.bodies[i].state.vel = O.bodies[i].state.angVel = (0, 0, 0)


@kind("bodies")
def heavier(dice, ids):
    for i in ids:
        factor = dice.choice((0.5, 2.0, 40.0))
        O.bodies[i].state.mass *= factor
        O.bodies[i].state.inertia *= factor


@kind("bodies", ways=NOT_PLAIN)  # behind YADE's loop a bond follows a new radius one step later
def grown(dice, ids):
    for i in ids:
        O.bodies[i].shape.radius *= dice.uniform(0.97, 1.01)


@kind("none")
def pushed(dice):
    for i in dice.sample(disks(), 2):
        O.forces.setPermF(i, (dice.uniform(-1e4, 1e4), dice.uniform(-1e4, 1e4), 0))


@kind("none", within=False)
def let_go(dice):
    for i in disks():  # O.forces.reset(resetAll=True) writes beyond its end where bodies have come since: YADE's own
        O.forces.setPermF(i, (0, 0, 0))


def a_disk(dice, position, stuff=None):
    body = scene.disk(position, dice.uniform(0.2, 0.4), stuff or O.materials[0])
    body.state.vel = (dice.uniform(-1, 1), dice.uniform(-1, 0), 0)
    return body


def fresh(dice):
    """A new body above all others."""
    return present().body(dice)


@kind("none")
def appended(dice):
    O.bodies.append(fresh(dice))


@kind("none")
def erased(dice):
    O.bodies.erase(dice.choice(disks()))


@kind("none")
def replaced(dice):
    """Another disk takes the id of one, at once."""
    i = dice.choice(disks())
    O.bodies.erase(i)
    O.bodies.insertAtId(fresh(dice), i)


@kind("none")
def put_back(dice):
    """An id that is free is used again, where there is one."""
    free = [i for i in range(len(O.bodies)) if O.bodies[i] is None]
    if free:
        O.bodies.insertAtId(fresh(dice), dice.choice(free))


@kind("all")
def parted(dice):
    pairs = near_contacts()
    if pairs:
        O.interactions.erase(*dice.choice(pairs))


@kind("none")
def cleared(dice):
    O.interactions.clear()


@kind("none", within=False, ways=NOT_PLAIN)  # YADE's collider does not outlive that all bodies go
def begun_anew(dice):
    O.interactions.clear()
    O.bodies.clear()
    present().populate(dice)


@kind("all", within=False)
def bonded(dice):
    solver().bond()


@kind("none", within=False)
def bonded_unseen(dice):
    solver().bond()


@kind("none", within=False)
def unbonded(dice):
    solver().unbond()


@kind("all")
def bonds_set(dice):
    pairs = near_contacts()
    for pair in dice.sample(pairs, min(3, len(pairs))):
        phys = O.interactions[pair].phys
        phys.bonded = not phys.bonded


@kind("all")
def strengths_set(dice):
    pairs = near_contacts()
    for pair in dice.sample(pairs, min(3, len(pairs))):
        phys = O.interactions[pair].phys
        name = dice.choice(
            ("friction", "residualFriction", "tensileForce", "rollingArm", "restitution", "ellipseNormal")
        )
        setattr(phys, name, {"restitution": 0.5, "tensileForce": 1e4}.get(name, 0.1 * dice.random()))


@kind("all")
def friction_written(dice):
    pairs = near_contacts()
    for pair in dice.sample(pairs, min(3, len(pairs))):
        if type(O.interactions[pair].phys).__name__ in ("NscdPhys", "NscdSpacePhys"):
            O.interactions[pair].phys.tangensOfFrictionAngle = dice.uniform(0, 0.8)


@kind("all")
def forces_reset(dice):
    for pair in near_contacts():
        O.interactions[pair].phys.normalForce = O.interactions[pair].phys.shearForce = (0, 0, 0)


@kind("none")
def material_changed(dice):
    m = dice.choice([m for m in O.materials if isinstance(m, NscdMat)])
    m.frictionAngle = dice.uniform(0, 0.7)
    m.tensileStrength = dice.choice((0.0, 2e3, 2e4))
    m.restitution = dice.choice((0.0, 0.0, 0.4))


@kind("none", within=False)
def strengths_updated(dice):
    solver().updateStrengths()


@kind("none")
def material_exchanged(dice):
    stuff = dice.choice(list(O.materials))
    for i in dice.sample(disks(), 3):
        O.bodies[i].material = stuff


@kind("none", within=False)
def wall_exchanged(dice):
    """A wall gets another material, often of another class, and its contacts take it up."""
    O.bodies[dice.choice(walls())].material = dice.choice(list(O.materials))
    solver().updateStrengths()


@kind("none")
def weakening_changed(dice):
    m = next(m for m in O.materials if isinstance(m, SlipWeakeningMat))
    m.weakening, m.criticalSlip = dice.choice(("step", "linear", "exponential")), dice.choice((0.01, 0.1, 1.0))


@kind("none")
def slip_forgotten(dice):
    next(m for m in O.materials if isinstance(m, SlipWeakeningMat)).forgetSlip()


@kind("all")
def wall_moved(dice):
    O.bodies[walls()[-1]].state.pos += Vector3(dice.uniform(-0.01, 0.01), dice.uniform(0, 0.01), 0)


@kind("all")
def wall_driven(dice):
    O.bodies[walls()[-1]].state.vel = (dice.uniform(-0.2, 0.2), dice.uniform(-0.1, 0.2), 0)


@kind("none", ways=NOT_PLAIN)  # ours ends the contacts that were made for the old shape
def wall_reshaped(dice):
    i = dice.choice(walls())
    O.bodies[i].shape = Segment(
        halfLength=O.bodies[i].shape.halfLength * dice.uniform(0.9, 1.1), sense=dice.choice((0, 1))
    )


@kind("none")
def wall_erased(dice):
    if len(walls()) > 3:
        O.bodies.erase(walls()[-1])


@kind("none")
def wall_added(dice):
    a = Vector3(dice.uniform(0, 6), dice.uniform(0.5, 2), 0)
    O.bodies.append(scene.segments([(a[0], a[1]), (a[0] + 2, a[1] + dice.uniform(-1, 1))], O.materials[0]))


@kind("none", within=False)
def gravity_changed(dice):
    one(NewtonIntegrator).gravity = (dice.uniform(-3, 3), dice.uniform(-10, 0), 0)


@kind("none", within=False)
def gravity_grown(dice):
    c = solver()
    c.finalGravity, c.gravityBegin, c.gravityRamp = (0, -9.81, 0), O.time, 20 * O.dt


@kind("none", within=False)
def step_changed(dice):
    O.dt = dice.choice((5e-4, 1e-3, 2e-3))


@kind("none", within=False)
def settings_changed(dice):
    c = solver()
    c.tolerance, c.method = dice.choice((1e-3, 1e-5, 1e-7)), dice.choice(("accelerated", "gaussSeidel"))
    c.precision, c.checkEvery = dice.choice(("mixed", "double")), dice.choice((3, 10))
    c.correctionSweeps, c.openGap = dice.choice((0, 5, 10)), dice.choice((0.0, 0.05))


@kind("none", within=False)
def reloaded(dice):
    O.saveTmp("random program")
    O.loadTmp("random program")


@kind("none")
def saved(dice):
    O.saveTmp("random program, saved alone")


@kind("none", within=False)
def time_reset(dice):
    O.resetTime()


@kind("none", within=False)
def functors_exchanged(dice):
    loop = one(InteractionLoop)
    loop.lawDispatcher.functors = [Law2_ScGeom_NscdPhys_SignoriniCoulomb(reach=REACH)]
    loop.geomDispatcher.functors = [
        k(interactionDetectionFactor=1 + REACH)
        for k in (Ig2_Sphere_Sphere_ScGeom, Ig2_Segment_Sphere_ScGeom, Ig2_Arc_Sphere_ScGeom)
    ]
    loop.physDispatcher.functors = [Ip2_NscdMat_NscdMat_NscdPhys()]


@kind("all", within=False, ways=NOT_PLAIN)
def engines_exchanged(dice):
    """New objects of the same kinds, or of YADE's own among ours."""
    plain = not isinstance(one(InteractionLoop), NscdInteractionLoop)
    mixed = dice.random() < 0.5
    new = []
    for e in O.engines:
        if isinstance(e, InteractionLoop) and dice.random() < 0.7:
            make = InteractionLoop if plain or (mixed and dice.random() < 0.5) else NscdInteractionLoop
            e = make(e.geomDispatcher.functors, e.physDispatcher.functors, e.lawDispatcher.functors)
        elif isinstance(e, Collider) and dice.random() < 0.7:
            make = InsertionSortCollider if plain or (mixed and dice.random() < 0.5) else PlanarGridCollider
            e = make(e.boundDispatcher.functors, verletDist=0 if make is InsertionSortCollider else -0.2)
        elif isinstance(e, NewtonIntegrator) and dice.random() < 0.7:
            make = NewtonIntegrator if plain or (mixed and dice.random() < 0.5) else PlanarNewtonIntegrator
            e = make(damping=0, gravity=e.gravity)
        new.append(e)
    O.engines = new


@kind("all", within=False)
def engine_added(dice):
    """An engine that might look at anything, or one that takes its turns; taken out again where it is there."""
    e = one(ForceEngine)
    if e:
        O.engines = [k for k in O.engines if k is not e and type(k) is not ForceEngine]
    else:
        O.engines = O.engines[:2] + [ForceEngine(force=(1.0, 0, 0), ids=[])] + O.engines[2:]


@kind("none", within=False)
def water_changed(dice):
    water = one(PorePressureEngine)
    if water:
        water.heights, water.times = [dice.uniform(0, 3)], [0]
        water.releaseDistance = dice.choice((0.05, 0.5, math.inf))
    else:
        made = PorePressureEngine(planeNormal=(0.1, 1, 0), heights=[1.5], times=[0], releaseDistance=0.1)
        O.engines = O.engines[:1] + [made] + O.engines[1:]


@kind("none", within=False)
def sums_begun(dice):
    old = one(WallForceEngine)
    ids = walls()[:2]
    if old:
        old.forget()
        old.ids, old.along = ids, [Vector3(1, 0, 0)] * len(ids)
    else:
        O.engines = O.engines + [WallForceEngine(ids=ids, along=[Vector3(1, 0, 0)] * len(ids))]


@kind("none")
def sums_ended(dice):
    if one(WallForceEngine):
        one(WallForceEngine).dead = True


@kind("none", within=False, ways=NOT_PLAIN)  # without it YADE's collider knows nothing of bodies that come and go
def redirection(dice):
    O.bodies.enableRedirection = dice.choice((True, False))


@kind("none", within=False)
def energies_tracked(dice):
    O.trackEnergy = not O.trackEnergy


@kind("none")
def forgotten(dice):
    solver().forgetEnergies()
    solver().forgetBreaks()
    if O.trackEnergy:
        O.energy.clear()


@kind("none", within=False)
def another_scene(dice):
    """A scene of its own in between, with bodies of the same ids."""
    O.switchScene()
    O.resetThisScene()
    present().three_bodies()
    O.dt = 1e-3
    O.step()
    O.switchScene()


@kind("none", within=False)
def stepper(dice):
    """A chooser of steps; taken out where it is there."""
    e = one(NonsmoothTimeStepper)
    if e:
        O.engines = [k for k in O.engines if not isinstance(k, NonsmoothTimeStepper)]
    else:
        O.engines = [NonsmoothTimeStepper(smallest=1e-4, largest=2e-3)] + O.engines


@kind("all", within=False)
def refused(dice):
    """A step without sense, which is refused as often as it is tried, and mended."""
    name, bad = dice.choice((("tolerance", math.nan), ("relaxationRate", 2.0), ("openGap", -1.0)))
    good = getattr(solver(), name)
    setattr(solver(), name, bad)
    refuse_steps(f"ContactDynamicsEngine: {name}")
    setattr(solver(), name, good)


@kind("bodies", within=False)
def refused_body(dice, ids):
    """The same, found later in the step; the body is as it was then."""
    state = O.bodies[ids[0]].state
    good = Vector3(state.vel)  # and no view of it
    state.vel = (math.nan, 0, 0)
    refuse_steps(f"body #{ids[0]} has a position or velocity")
    O.bodies[ids[0]].state.vel = good


def refuse_steps(words):
    left = 2
    while left > 0:
        try:
            O.step()
        except RuntimeError as error:
            if words in str(error):
                left -= 1
            elif "random_event" not in str(error):
                raise
        else:
            raise AssertionError(f"a step without sense was made: {words}")


@kind("none", between=False, ways=NOT_BESIDE)
def raised(dice):
    """An engine raises in the midst of a step, which is made again."""
    raise Raised


class Raised(Exception):
    pass


# ---- programs -------------------------------------------------------------------------------------


@dataclass
class Event:
    number: int
    step: int  # it is done when so many have been made, or in the one after
    name: str
    within: bool
    engine: int  # place in the list of engines before which it is done, within a step
    seed: int
    done: int = 0

    def __call__(self):
        """Within a step it may be asked for twice, where the step is made again: ``raised`` is done once."""
        if self.within:
            self.done += 1
            if self.name == "raised" and self.done > 1:
                return
        how = present().kinds[self.name]
        dice = random.Random(self.seed)
        how["function"](dice, *([self.ids()] if how["looks"] == "bodies" else []))

    def ids(self):
        """Bodies that it is for."""
        return random.Random(self.seed + 1).sample(disks(), 2)


def populate(dice):
    """A box of disks, some of them bonded, with a wall that weakens and one that may move."""
    stuff = dice.choice(list(O.materials)[:2])
    weak = O.materials[2]
    O.bodies.append(scene.segments([(0, 5), (0, 0)], O.materials[0], piece=2))
    O.bodies.append(scene.segments([(0, 0), (6, -0.3)], weak, piece=3))
    O.bodies.append(scene.segments([(6, -0.3), (6, 5)], O.materials[0], piece=2))
    O.bodies.append(scene.segments([(1, 4.6), (2.5, 4.2)], O.materials[1]))
    for k in range(dice.randint(20, 36)):
        x, y = 0.5 + 0.7 * (k % 7), 0.38 + 0.69 * (k // 7)
        body = scene.disk(
            (x + dice.uniform(-0.01, 0.01), y + dice.uniform(-0.01, 0.01)),
            dice.uniform(0.32, 0.35),
            stuff if dice.random() < 0.8 else O.materials[1],
        )
        body.state.vel = (dice.uniform(-0.5, 0.5), dice.uniform(-1, 0.5), 0)
        O.bodies.append(body)


def materials(dice):
    shared = dict(density=2500, bondCreationDistance=0.03, bondEllipseNormal=0.03, bondEllipseTangential=0.03)
    base = NscdMat(frictionAngle=0.4, tensileStrength=8e3, rollingFriction=0.05, layer=1, **shared)
    other = NscdMat(frictionAngle=0.2, layer=2, restitution=dice.choice((0.0, 0.3)), **shared)
    weak = SlipWeakeningMat(frictionAngle=0.5, criticalSlip=0.005, tensileStrength=1e3, bondsToAll=True, **shared)
    law = SlipWeakeningMat(frictionAngle=0.45, criticalSlip=0.03, **shared)
    if dice.random() < 0.5:
        base.interfaceLayers, base.interfaceLaws = [2], [law]
    for m in (base, other, weak):
        O.materials.append(m)


def own_engines():
    """YADE's own engines, which sort in every step: what a script moves is found at once. Boxes of disks are so large
    that walls are found as early as by ours.
    """
    new = []
    for e in O.engines:
        if isinstance(e, PlanarGridCollider):
            e = InsertionSortCollider(
                [Bo1_Sphere_Aabb(aabbEnlargeFactor=1 + 2.2 * REACH), Bo1_Segment_Aabb(), Bo1_Arc_Aabb()], verletDist=0
            )
        elif isinstance(e, NscdInteractionLoop):
            e = InteractionLoop(e.geomDispatcher.functors, e.physDispatcher.functors, e.lawDispatcher.functors)
        elif isinstance(e, PlanarNewtonIntegrator):
            e = NewtonIntegrator(damping=0, gravity=e.gravity)
        new.append(e)
    O.engines = new


class Plane:
    """What programs are made of: disks between segments."""

    kinds = KINDS
    materials, populate, own_engines = staticmethod(materials), staticmethod(populate), staticmethod(own_engines)

    @staticmethod
    def body(dice):
        return a_disk(dice, (dice.uniform(1.0, 5.0), 6.0 + dice.uniform(0, 1.5)))

    @staticmethod
    def three_bodies():
        O.materials.append(NscdMat(density=2500))
        O.bodies.append([scene.disk((k, 0), 0.5, O.materials[0]) for k in range(3)])
        O.engines = scene.engines(gravity=(0, -1, 0))

    @staticmethod
    def engines(dice):
        O.engines = scene.engines(gravity=(0.5, -9.81, 0), reach=REACH, tolerance=1e-6, maxIterations=100)

    @staticmethod
    def vectors_of(phys, geom):
        """What there is to compare of a contact, besides the numbers that are the same everywhere."""
        return ()


_running = [Plane]  # the world of the program that runs is the last one


def present():
    return _running[-1]


@dataclass
class Program:
    number: int
    steps: int = 90
    changes: int = 14
    events: list = field(default_factory=list)
    world: type = None  # Plane where it is None

    def __post_init__(self):
        self.world = self.world or Plane
        dice = random.Random(self.number)
        kinds = self.world.kinds
        names = sorted(kinds)
        for k in range(self.changes):
            name = dice.choice(names)
            how = kinds[name]
            within = how["within"] and (not how["between"] or dice.random() < 0.4)
            self.events.append(
                Event(
                    k,
                    dice.randint(1, self.steps - 2),
                    name,
                    within,
                    dice.choice((0, 1, 2, 3, 5)),
                    dice.randrange(1 << 30),
                )
            )
        self.events.append(
            Event(self.changes, 2, "bonded_unseen", False, 0, self.number)
        )  # so that there are bonds to break
        self.events.sort(key=lambda e: (e.step, e.number))

    def build(self, way):
        O.reset()
        O.trackEnergy = False
        dice = random.Random(self.number)
        self.world.materials(dice)
        self.world.populate(dice)
        self.world.engines(dice)
        O.dt = 1e-3
        if way == "plain":
            self.world.own_engines()
        if way == "unseen":
            for e in O.engines:
                e.ompThreads = 2
        runners = {}
        for e in self.events:
            if e.within:
                e.done = 0
                runner = PyRunner(command=f"random_event({e.number})", firstIterRun=e.step, iterPeriod=1 << 40, nDo=1)
                runners.setdefault(e.engine, []).append(runner)
        O.engines = [x for k, e in enumerate(O.engines) for x in [*runners.get(k, []), e]] + runners.get(5, [])
        __main__.random_event = lambda number: next(e for e in self.events if e.number == number)()

    def ways(self):
        return [w for w in WAYS if all(w in self.world.kinds[e.name]["ways"] for e in self.events)]

    def run(self, way, told=lambda text: None):
        """What there is at each change between steps, and in the end."""
        _running.append(self.world)
        try:
            return self._run(way, told)
        finally:
            _running.pop()

    def _run(self, way, told):
        self.build(way)
        made, rows = 0, []
        for e in [e for e in self.events if not e.within] + [None]:
            looks = self.world.kinds[e.name]["looks"] if e else "all"
            ids = e.ids() if looks == "bodies" else []
            rows.append(self.go(way, (e.step if e else self.steps) - made, looks, ids))
            made = e.step if e else self.steps
            if ids and e.ids() != ids:  # others, since bodies have come or gone meanwhile
                solver().view()
            if way != "unseen" and looks == "all":
                rows.append(outcome())
            if e:
                told(f"  {made:3d} {e.name}")
                e()
        rows.append(outcome())
        return rows

    def go(self, way, steps, looks, ids):
        """Makes steps; an exception ends the one that it came from, which is then made again. Returns what was
        raised.
        """
        said, shown = [], False
        while steps > 0:
            before = O.iter
            try:
                if (
                    way in ("stepped", "plain") or O._sceneObj.subStep >= 0
                ):  # advance() does not finish a step of O.step()'s
                    O.step()
                elif way == "beside":
                    beside(steps)
                else:
                    view = True if way == "seen" or looks == "all" else ids if way == "alone" else False
                    ContactDynamicsEngine.advance(steps, view=view)
                    shown = True
            except Exception as error:
                if "random_event" not in str(error):
                    raise
                said.append(O.iter)
            steps -= O.iter - before
        if (way == "unseen" and looks != "none") or (way == "alone" and (looks == "all" or not shown)):
            solver().view()
        return said


def beside(steps):
    """A run in the background, while this thread asks for whatever may be asked for."""
    O.run(steps)
    asked = 0
    while O.running:
        c = solver()
        (c.view, c.bodyTable, c.contactTable, c.energies, c.breakTable)[asked % 5]()
        asked += 1
        time.sleep(2e-4)
    while O._sceneObj.subStep >= 0:
        time.sleep(1e-4)
    O.wait()


def differences(a, b):
    """Where two ways differ: names, at most five."""
    for k, (x, y) in enumerate(zip(a, b)):
        if x == y:
            continue
        if not isinstance(x, dict):
            return [f"row {k}: {x} and {y}"]
        names = [n for n in sorted(x.keys() | y.keys()) if x.get(n) != y.get(n)]
        return [f"row {k}, {n}: {x.get(n)} and {y.get(n)}" for n in names[:5]]
    return [] if len(a) == len(b) else ["another number of rows"]


def check(program, ways=WAYS, told=lambda text: None):
    """Runs it in all ways; returns the differences by way, and the ways that were left out."""
    able = [w for w in program.ways() if w in ways]
    rows = {w: program.run(w, told if w == able[0] else lambda text: None) for w in able}
    wrong = {}
    for w in able[1:]:
        # only what both have looked at
        mine, first = ([r for r in rows[k] if isinstance(r, list)] + [rows[k][-1]] for k in (w, able[0]))
        whole = w not in ("unseen",)
        found = differences(rows[able[0]] if whole else first, rows[w] if whole else mine)
        if found:
            wrong[w] = found
    return wrong, [w for w in ways if w not in able]


def main(world=None):
    """Of a world, Plane where it is None."""
    parser = argparse.ArgumentParser(description="Runs random programs in every way and compares them.")
    parser.add_argument("--programs", type=int, default=1, help="how many (default: 1)")
    parser.add_argument("--first", type=int, default=0, help="number of the first (default: 0)")
    parser.add_argument("--ways", nargs="+", choices=WAYS, default=WAYS, help="ways to run (default: all)")
    parser.add_argument("-v", "--verbose", action="store_true", help="what each does")
    args = parser.parse_args()
    failed, left, begin = [], 0, time.time()
    for number in range(args.first, args.first + args.programs):
        program = Program(number, world=world)
        if args.verbose:
            print(f"program {number}: within steps", [(e.step, e.name) for e in program.events if e.within], flush=True)
        wrong, out = check(program, args.ways, print if args.verbose else lambda text: None)
        left += len(out)
        for way, found in wrong.items():
            print(f"program {number}, {way} is not {args.ways[0]}:", *found, sep="\n    ", flush=True)
        if wrong:
            failed.append(number)
    print(
        f"{args.programs} programs of {len((world or Plane).kinds)} kinds of change, {len(args.ways)} ways, {left} left out, {len(failed)} differ: {failed}; {time.time() - begin:.0f} s"
    )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
