"""Every number that a script can set on a class of the plugin, tried with what makes no sense.

It is refused by its name, or is harmless, and HARMLESS says why; NOT_OURS has what nobody can refuse. Attributes are
found by themselves, so one that comes later is tried too, in the scenes of its class.
"""
import contextlib
import dataclasses
import math
import os
import pickle
import re
import resource
import sys
from types import SimpleNamespace

import pytest
from contact_scenes import G, begin, engine, floor, free_disk, material, run
from shell import ROOT
from soft_scenes import ROCK, WALL
from yade import O, utils, wrapper
from yade.minieigenHP import Vector3, Vector3i
from yade.nonsmooth import scene, section, soft, space
from yade.nonsmooth.slip.laws import SlipLaw
from yade.wrapper import (
    BondEllipseEngine,
    CourseRunner,
    GroundMotionEngine,
    InsertionSortCollider,
    InteractionLoop,
    NewtonIntegrator,
    NonsmoothTimeStepper,
    NscdInteractionLoop,
    NscdMat,
    PlanarGridCollider,
    PlanarNewtonIntegrator,
    PorePressureEngine,
    PorePressureField,
    SlipSurfaceMat,
    SlipWeakeningMat,
    WallForceEngine,
)

pytestmark = pytest.mark.usefixtures("empty")
NAN, INF, HUGE, MOST = math.nan, math.inf, 1e300, 2**31 - 1
OBLIQUE = (0.5, -G, 0)  # so that friction and rolling friction have something to hold

# ---- scenes ---------------------------------------------------------------------------------------

SCENES = {}


def acts(name, before=True, lists=(), only=None):
    """Registers a scene in which a class acts, by the class's name and, behind it, what is particular about the scene.

    ``before``: the object is there before the first step. ``lists``: its attributes that are lists and not empty.
    ``only``: attributes that are tried, of a class that has another scene for the rest.
    """

    def register(make):
        SCENES[name] = SimpleNamespace(make=make, before=before, lists=lists, only=only)
        return make

    return register


def nothing():
    pass


def looked(
    target, bed=None, resting=(), falling=(), push=lambda: Vector3(0, 0, 0), also=nothing, apply=nothing, settle=nothing
):
    """What a test looks at, and does.

    ``target``: finds the object whose numbers are tried. ``bed``: the floor that bears the bodies ``resting``, which
    stay where they are. ``falling``: disks that stay above their floor. ``push``: force on what rests besides its
    weight [N]. ``also``: asserts more. ``apply``: lets a new value come to what is there already. ``settle``: done
    after the first step.
    """
    places = {k: O.bodies[k].state.pos for k in resting}
    return SimpleNamespace(
        target=target,
        bed=bed,
        resting=list(resting),
        falling=list(falling),
        push=push,
        also=also,
        apply=apply,
        settle=settle,
        places=places,
    )


def of(kind):
    return next(e for e in O.engines if isinstance(e, kind))


def functor(kind):
    """The functor of a class in the loop's lists."""
    loop = of(InteractionLoop)
    lists = (loop.geomDispatcher, loop.physDispatcher, loop.lawDispatcher)
    return next(f for one in lists for f in one.functors if type(f).__name__ == kind)


def by_yade():
    """Puts YADE's own collider, loop and integrator in the place of the plugin's."""
    loop, sorter, newton = of(NscdInteractionLoop), of(PlanarGridCollider), of(PlanarNewtonIntegrator)
    others = {
        loop: InteractionLoop(loop.geomDispatcher.functors, loop.physDispatcher.functors, loop.lawDispatcher.functors),
        sorter: InsertionSortCollider(sorter.boundDispatcher.functors, verletDist=0.05),
        newton: NewtonIntegrator(damping=0, gravity=newton.gravity),
    }
    O.engines = [others.get(e, e) for e in O.engines]


def in_both_loops(name, **options):
    """As acts(), for a scene that is also tried with YADE's own loop."""

    def register(make):
        def make_by_yade():
            s = make()
            by_yade()
            return s

        acts(name, **options)(make)
        acts(f"{name} in YADE's loop", **options)(make_by_yade)
        return make

    return register


def disk(x, y, stuff, velocity=(0, 0, 0)):
    return free_disk(x, y, velocity, stuff)


def rough(**more):
    return material(0.6, 0.3, **more)


def weight(ids):
    return sum((O.bodies[k].state.mass for k in ids), 0.0) * of(NewtonIntegrator).gravity


# ---- engines


@acts("ContactDynamicsEngine")
def pile():
    """Three disks in a pile while gravity grows; one that falls onto another and bounces; one that lies too deep."""
    stuff, bouncy = rough(), rough(restitution=0.5)
    bed = floor(stuff)
    O.bodies.append(scene.segments([(30, 0), (40, 0)], stuff))
    three = [disk(x, y, stuff) for x, y in ((0, 0.5), (1, 0.5), (0.5, 0.5 + 0.75**0.5))]
    two = [disk(35, 0.5, bouncy), disk(35, 1.51, bouncy, (0, -1, 0))]
    deep = disk(32, 0.48, stuff)
    # residuals below 1e-7 would take thousands of sweeps: two disks of the pile press each other with next to nothing
    begin(gravity=(0, 0, 0), finalGravity=(0, -G, 0), gravityRamp=0.01, tolerance=1e-7)

    def also():
        state = O.bodies[deep].state
        assert 0.4799 < state.pos[1] < 0.5001 and state.vel.norm() < 1e-4

    return looked(engine, bed, three, two, also=also)


@acts("PlanarGridCollider")
def fast_disk():
    """A disk that comes fast, from beyond the reach of slow ones, to another that lies on a floor."""
    stuff = rough()
    floor(stuff)
    two = [disk(0, 0.5, stuff), disk(0, 1.7, stuff, (0, -20, 0))]
    begin(far=0.3, reach=0.05)
    return looked(lambda: of(PlanarGridCollider), falling=two)


def rest(gravity=OBLIQUE, **options):
    """A disk on a floor."""
    stuff = rough()
    bed = floor(stuff)
    low = disk(0, 0.5, stuff)
    begin(gravity=gravity, **options)
    return looked(lambda: of(PlanarNewtonIntegrator), bed, [low])


acts("PlanarNewtonIntegrator")(rest)


@acts("NonsmoothTimeStepper")
def stepped():
    """Two bonded disks on a floor, and the engine that chooses the step."""
    stuff = rough(tensileStrength=1e5, bondsToAll=True)
    bed = floor(stuff)
    two = [disk(0, 0.5, stuff), disk(0, 1.5, stuff)]
    begin(gravity=OBLIQUE)
    run(1)
    assert engine().bond() == 2
    chosen = NonsmoothTimeStepper()
    O.engines = [chosen, *O.engines]

    def also():
        assert 1e-3 < O.dt <= chosen.largest

    return looked(lambda: chosen, bed, two, also=also)


@acts("PorePressureEngine", lists=("times", "heights", "releasedShare"))
def water():
    """A disk under water on a floor."""
    stuff = rough()
    bed = floor(stuff)
    low = disk(0, 0.5, stuff)
    wet = PorePressureEngine(times=[0, 1], heights=[5, 5], releasedShare=[0, 0.25])
    begin(gravity=OBLIQUE, before=[wet])

    def lift():
        """As documented: −∇p V below the table, γ_w V cos β along the normal where no gradient is given."""
        size = max(map(abs, wet.planeNormal))
        normal, pull = Vector3(*(c / size for c in wet.planeNormal)).normalized(), Vector3(OBLIQUE).normalized()
        head, later = wet.heights
        height = head + (later - head) * (O.time - wet.times[0]) / (wet.times[1] - wet.times[0])
        if height <= 0 or (O.bodies[low].state.pos - wet.planePoint).dot(normal) >= height:
            return Vector3(0, 0, 0)
        gradient = wet.pressureGradient
        force = -gradient if gradient.norm() > 0 else wet.unitWeight * -pull.dot(normal) * normal
        acting = 1 - wet.releasedShare[low]
        return force * (math.pi * 0.5**2 * wet.volumeFactor * wet.thickness * acting)

    return looked(lambda: wet, bed, [low], push=lift)


@acts("PorePressureField", lists=("nodes", "triangles", "times", "pressures"))
def water_on_triangles():
    """A disk on a floor, in a field of pressures that falls upwards and to the left as long as it stays alone."""
    stuff = rough()
    bed = floor(stuff)
    low = disk(0, 0.5, stuff)
    field = PorePressureField(
        nodes=[(-9, -9, 0), (9, -9, 0), (0, 9, 0)],
        triangles=[(0, 1, 2)],
        times=[0, 1],
        pressures=[9e3, 9e3, 0, 9e3, 9e3, 0],
    )
    begin(gravity=OBLIQUE, before=[PorePressureEngine(field=field)])

    def lift():
        pressure, gradient = field.at(O.bodies[low].state.pos, O.time - O.dt)  # as the step began
        if pressure is None or pressure <= 0:
            return Vector3(0, 0, 0)
        return -gradient * math.pi * 0.5**2

    return looked(lambda: field, bed, [low], push=lift)


@acts("GroundMotionEngine", lists=("times", "horizontal", "vertical"))
def shaken():
    """A disk on a floor that begins to move."""
    stuff = rough()
    bed = floor(stuff)
    low = disk(0, 0.5, stuff)
    ground = GroundMotionEngine(times=[0, 1], horizontal=[0.5, 0.5], vertical=[0.25, 0.25])
    begin(gravity=OBLIQUE, before=[ground])

    def push():
        return -O.bodies[low].state.mass * ground.acceleration

    return looked(lambda: ground, bed, [low], push=push)


@acts("GroundMotionEngine of a wall", lists=("ids",), only=("ids",))
def shaken_wall():
    """A floor that sinks, a little slower than disks fall; a disk on it, which is carried along."""
    stuff = rough()
    bed = floor(stuff)
    low = disk(0, 0.5, stuff)
    ground = GroundMotionEngine(times=[0, 1], vertical=[-1, -1], ids=[bed])
    begin(gravity=(0, -G, 0), before=[ground])

    def also():
        assert (O.bodies[low].state.pos[1] - O.bodies[bed].state.pos[1]) == pytest.approx(0.5, abs=1e-6)
        assert O.forces.f(bed)[1] == pytest.approx(-O.bodies[low].state.mass * (G - 1), rel=1e-6)

    return looked(lambda: ground, also=also)


@acts("PlateLoadEngine", lists=("between",))
def pressed():
    """A plate that presses a disk onto a floor, between two walls."""
    stuff = rough()
    bed = floor(stuff)
    sides = [O.bodies.append(scene.segments(ends, stuff))[0] for ends in ([(2, -1), (2, 4)], [(-2, 4), (-2, -1)])]
    low = disk(0, 0.5, stuff)
    begin()
    load = scene.plate([(3, 1), (-3, 1)], stuff, stress=1e3, between=sides, damping=100.0)
    O.bodies[load.id].state.pos = (0, 1, 0)

    def push():
        # four metres of the plate between the walls; its weight is taken off
        along = load.force + 4 * load.stress * abs(load.direction.normalized()[1])
        return along * Vector3(0, load.direction.normalized()[1], 0) - weight([load.id])

    return looked(lambda: load, bed, [low, load.id], push=push)


@acts("PlateLoadEngine with a rail")
def guided():
    """A plate in an oblique way, whose guide holds it."""
    stuff = rough()
    bed = floor(stuff)
    low = disk(0, 0.5, stuff)
    begin(gravity=OBLIQUE)
    load = scene.plate([(12, 11), (11, 12)], stuff, force=100.0, damping=100.0)
    state = O.bodies[load.id].state
    start = state.pos

    def also():
        way = load.direction.normalized()
        gone = state.pos - start
        across = gone - gone.dot(way) * way
        assert across.norm() < 1e-6, f"the plate is off its way by {tuple(across)} m"
        assert gone.norm() < 1, f"the plate has gone by {tuple(gone)} m"

    return looked(lambda: load, bed, [low], also=also)


@acts("WallForceEngine", lists=("ids", "along"))
def counted():
    """What a floor bears of a disk is summed up."""
    stuff = rough()
    low = disk(0, 0.5, stuff)
    bed = floor(stuff)
    sums = WallForceEngine(ids=[bed], along=[(1, 0, 0)])
    begin(after=[sums])

    def also(sign=1):
        mean, shear, peak = sums.take()
        assert (mean, peak) == pytest.approx((sign * weight([low]).norm(),) * 2, rel=1e-6)
        assert abs(shear) < 1e-6 * abs(mean)

    return looked(lambda: sums, bed, [low], also=also, apply=sums.forget)


@acts("CourseRunner")
def course():
    """A command that is due in the thirteenth step, and, as it sets no other time, in all that follow."""
    s = rest()
    s.calls = sys.modules["__main__"].__dict__["calls"] = []  # where YADE runs commands
    runner = CourseRunner(command="calls.append(O.iter)", nextTime=0.012)
    O.engines = [runner, *O.engines]
    s.target = lambda: runner
    return s


# ---- materials and contacts


def stack(bond=False, **strengths):
    """Two disks of one material on a floor of another one like it."""
    stuff = rough(**{**dict(tensileStrength=1e5, residualTensileStrength=10.0, bondsToAll=True), **strengths})
    bed = floor(stuff)
    two = [disk(0, 0.5, stuff), disk(0, 1.5, stuff)]
    begin(gravity=OBLIQUE)
    if bond:
        run(1)
        assert engine().bond() == 2
    return stuff, bed, two


def take_up(ids):
    """Lets new values of materials come to contacts, and to the masses of disks."""

    def take():
        if O.iter > 0:
            engine().updateStrengths()
        scene.disks(ids)

    return take


@in_both_loops("NscdMat")
def two_of_a_material():
    stuff, bed, two = stack()
    return looked(lambda: stuff, bed, two, apply=take_up(two))


@in_both_loops("NscdMat of bonds")
def two_bonded_of_a_material():
    stuff, bed, two = stack(bond=True)
    return looked(lambda: stuff, bed, two, apply=take_up(two))


@acts("NscdMat of an interface", lists=("interfaceLayers",), only=("interfaceLayers", "layer"))
def two_layers():
    """Two disks of other layers, whose contact has a law of its own."""
    law = NscdMat(density=2500, frictionAngle=0.5, rollingFriction=0.2)
    stuff, other = rough(layer=1), rough(layer=2)
    stuff.interfaceLayers, stuff.interfaceLaws = [2], [law]
    bed = floor(other)
    two = [disk(0, 0.5, other), disk(0, 1.5, stuff)]
    begin(gravity=OBLIQUE)
    return looked(lambda: stuff, bed, two, apply=take_up(two))


def weakening():
    """A weakening wall on which one disk lies, and along which another one slides."""
    stuff = rough()
    wall = rough(kind=SlipWeakeningMat, criticalSlip=0.02, tensileStrength=10.0, weakenedFrictionAngle=0.1)
    wall.interfaceLayers, wall.interfaceLaws = [3], [NscdMat(density=2500, frictionAngle=0.2)]
    bed = floor(wall)
    low, slides = disk(0, 0.5, stuff), disk(5, 0.5, stuff, (2, 0, 0))
    O.bodies[slides].state.blockedDOFs = "zXYZ"
    begin(gravity=OBLIQUE)
    return wall, bed, low, slides


@in_both_loops("SlipWeakeningMat", lists=("interfaceLayers",))
def weak_wall():
    wall, bed, low, slides = weakening()
    return looked(lambda: wall, None, [low], [slides], apply=take_up([]))


@in_both_loops("SlipWeakeningPhys", before=False)
def sliding_contact():
    wall, bed, low, slides = weakening()
    return looked(lambda: O.interactions[bed, slides].phys, None, [low], [slides])


def heated():
    """The same on a wall whose friction a law finds in cells along it."""
    stuff = rough()
    law = SlipLaw("linear", friction=0.6, weakened_friction=0.1, critical_slip=0.5)
    wall = rough(kind=SlipSurfaceMat, law=law, tensileStrength=10.0)
    bed = floor(wall)
    low, slides = disk(0, 0.5, stuff), disk(5, 0.5, stuff, (2, 0, 0))
    O.bodies[slides].state.blockedDOFs = "zXYZ"
    begin(gravity=OBLIQUE)
    return wall, bed, low, slides


@in_both_loops("SlipSurfaceMat", lists=("interfaceLayers",))
def wall_with_cells():
    wall, bed, low, slides = heated()
    wall.interfaceLayers, wall.interfaceLaws = [3], [NscdMat(density=2500, frictionAngle=0.2)]
    return looked(lambda: wall, None, [low], [slides], apply=take_up([]))


@in_both_loops("SlipSurfacePhys", before=False)
def contact_with_a_cell():
    wall, bed, low, slides = heated()
    return looked(lambda: O.interactions[bed, slides].phys, None, [low], [slides])


for where, bond in (("", False), (" of a bond", True)):

    @in_both_loops("NscdPhys" + where, before=False)
    def contact_of_disks(bond=bond):
        _, bed, two = stack(bond)
        return looked(lambda: O.interactions[two[0], two[1]].phys, bed, two)

    @in_both_loops("NscdPhys" + where + " at a wall", before=False)
    def contact_with_a_wall(bond=bond):
        _, bed, two = stack(bond)
        return looked(lambda: O.interactions[bed, two[0]].phys, bed, two)


@in_both_loops("Law2_ScGeom_NscdPhys_SignoriniCoulomb")
def law():
    _, bed, two = stack()
    return looked(lambda: functor("Law2_ScGeom_NscdPhys_SignoriniCoulomb"), bed, two)


# ---- walls


@in_both_loops("Segment")
def joint():
    """Disks on a piece of a floor and where it meets another piece."""
    stuff = rough()
    pieces = O.bodies.append(scene.segments([(-20, 0), (0, 0), (20, 0)], stuff))
    two = [disk(-5, 0.5, stuff), disk(0, 0.5, stuff)]
    begin(gravity=OBLIQUE)
    return looked(lambda: O.bodies[pieces[0]].shape, None, two)


BOWL = ((0, 3), 3, math.radians(-150), math.radians(-30))


@in_both_loops("Arc")
def bowl():
    """A disk in a bowl."""
    stuff = rough()
    (bed,) = O.bodies.append(scene.arc(*BOWL, stuff))
    low = disk(0, 0.5, stuff)
    begin()
    return looked(lambda: O.bodies[bed].shape, bed, [low])


@in_both_loops("Ig2_Segment_Sphere_ScGeom")
def segment_functor():
    s = rest()
    s.target = lambda: functor("Ig2_Segment_Sphere_ScGeom")
    return s


@in_both_loops("Ig2_Arc_Sphere_ScGeom")
def arc_functor():
    s = bowl()
    s.target = lambda: functor("Ig2_Arc_Sphere_ScGeom")
    return s


# ---- in space


def ball_on(kind):
    """A ball at rest on a facet, a box or a wall; bonded where the material says so."""

    def make(bond=False):
        stuff = rough(tensileStrength=1e5, residualTensileStrength=10.0, bondsToAll=True, twistingFriction=0.1)
        bed = O.bodies.append(
            {
                "Facet": lambda: utils.facet([(-9, -9, 0), (9, -9, 0), (0, 9, 0)], material=stuff),
                "Box": lambda: utils.box((0, 0, -1), (9, 9, 1), fixed=True, material=stuff),
                "Wall": lambda: utils.wall(0, axis=2, sense=1, material=stuff),
            }[kind]()
        )
        low = O.bodies.append(utils.sphere((0, 0, 0.5), 0.5, material=stuff))
        O.engines, O.dt = space.engines(gravity=(0, 0, -G), tolerance=1e-9), 1e-3
        if bond:
            run(1)
            assert engine().bond() == 1
        return looked(lambda: functor(f"Ig2_{kind}_Sphere_FaceGeom"), bed, [low])

    return make


for kind in ("Facet", "Box", "Wall"):
    acts(f"Ig2_{kind}_Sphere_FaceGeom")(ball_on(kind))

for where, bond in (("", False), (" of a bond", True)):

    @acts("NscdSpacePhys" + where, before=False)
    def contact_in_space(bond=bond):
        s = ball_on("Wall")(bond)
        s.target = lambda: O.interactions[s.bed, s.resting[0]].phys
        return s


# ---- springs

STIFFNESS = 1e9
WEAK = dataclasses.replace(
    WALL,
    bonded=False,
    slip_weakening=section.SlipWeakening("step", critical_slip=0.05, friction=0.1, tensile_strength=0.0),
)


def springs(wall=WALL, bond=False, fragile=True, curved=False):
    """A disk on a wall, where its springs bear it: what a test looks at, and the wall's material."""
    e = soft.equivalent(ROCK, STIFFNESS, diameter=1.0, damping=0.5)
    rock, stuff = soft.material(e), soft.wall_material(e, wall)
    O.materials.append([rock, stuff])
    bed = O.bodies.append(scene.arc(*BOWL, stuff))[0] if curved else floor(stuff)
    low = disk(0 if curved else 0.3, 0.5, rock)
    state = O.bodies[low].state
    state.pos -= (0, state.mass * G / (STIFFNESS * 0.5), 0)
    O.engines, O.dt = soft.engines(e, gravity=(0, -G, 0) if curved else OBLIQUE, ductile=True), 0.1 * e.step_limit
    if bond:
        assert soft.bond_walls(fragile=fragile) == 1

    def settle():
        """Gives the springs along the wall and of rolling what holds the disk, which they come to slowly."""
        if curved or not O.interactions.has(bed, low, True):
            return
        i, along = O.interactions[bed, low], state.mass * OBLIQUE[0]
        i.phys.shearForce = (-along, 0, 0)
        i.phys.rollingTorque = along * (state.pos[1] - i.geom.contactPoint[1])
        state.vel, state.angVel = (0, 0, 0), (0, 0, 0)

    def anew():
        """A contact takes the values of materials and functors when it is made."""
        if O.iter > 0:
            O.interactions.erase(bed, low)
            run(1)
            settle()

    s = looked(lambda: O.interactions[bed, low].phys, bed, [low], apply=anew, settle=settle)
    return s, stuff, bed


@acts("WallPhys", before=False)
def spring():
    s, _, _ = springs()
    s.apply = nothing
    return s


@acts("WallPhys of a bond", before=False)
def bonded_spring():
    s, _, _ = springs(bond=True)
    s.apply = nothing
    return s


@acts("WallPhys of a ductile bond", before=False)
def ductile_spring():
    s, _, _ = springs(bond=True, fragile=False)
    s.apply = nothing
    return s


@acts("BondEllipseEngine")
def followed():
    s = ductile_spring()
    s.target = lambda: of(BondEllipseEngine)
    s.target().iterPeriod = 1
    return s


def with_springs(name, target, **options):
    @acts(name)
    def make():
        s, stuff, bed = springs(**options)
        s.target = lambda: target(stuff, bed)
        return s


with_springs("NscdMat of a soft wall", lambda stuff, bed: stuff)
with_springs("SlipWeakeningMat of a soft wall", lambda stuff, bed: stuff, wall=WEAK)
with_springs("Ip2_NscdMat_FrictMat_WallPhys", lambda stuff, bed: functor("Ip2_NscdMat_FrictMat_WallPhys"))
with_springs("Segment with springs", lambda stuff, bed: O.bodies[bed].shape)
with_springs("Arc with springs", lambda stuff, bed: O.bodies[bed].shape, curved=True)
with_springs("Ig2_Segment_Sphere_ScGeom with springs", lambda stuff, bed: functor("Ig2_Segment_Sphere_ScGeom"))
with_springs("Ig2_Arc_Sphere_ScGeom with springs", lambda stuff, bed: functor("Ig2_Arc_Sphere_ScGeom"), curved=True)

# ---- attributes, and values for them ----------------------------------------------------------------

# of YADE's own classes, to which the plugin gives a meaning
INHERITED = {
    "NscdMat": ("frictionAngle", "density"),
    "SlipWeakeningMat": ("frictionAngle", "density"),
    "SlipSurfaceMat": ("frictionAngle", "density"),
    "PlanarNewtonIntegrator": ("damping", "gravity", "mask"),
    "NscdPhys": ("tangensOfFrictionAngle", "normalForce", "shearForce", "kn", "ks"),
    "SlipWeakeningPhys": ("tangensOfFrictionAngle", "normalForce", "shearForce", "kn", "ks"),
    "SlipSurfacePhys": ("tangensOfFrictionAngle", "normalForce", "shearForce", "kn", "ks"),
    "NscdSpacePhys": ("tangensOfFrictionAngle", "normalForce", "shearForce", "kn", "ks"),
    "WallPhys": ("tangensOfFrictionAngle", "normalForce", "shearForce"),
}

# of lists that are empty in a new instance: an element, or None where elements are no numbers
ELEMENTS = {
    ("PorePressureEngine", "times"): 0.0,
    ("PorePressureEngine", "heights"): 0.0,
    ("PorePressureEngine", "releasedShare"): 0.0,
    ("PorePressureField", "nodes"): Vector3(0, 0, 0),
    ("PorePressureField", "triangles"): Vector3i(0, 0, 0),
    ("PorePressureField", "times"): 0.0,
    ("PorePressureField", "pressures"): 0.0,
    ("GroundMotionEngine", "times"): 0.0,
    ("GroundMotionEngine", "horizontal"): 0.0,
    ("GroundMotionEngine", "vertical"): 0.0,
    ("GroundMotionEngine", "ids"): 0,
    ("PlateLoadEngine", "between"): 0,
    ("WallForceEngine", "ids"): 0,
    ("WallForceEngine", "along"): Vector3(0, 0, 0),
    ("NscdMat", "interfaceLayers"): 0,
    ("NscdMat", "interfaceLaws"): None,
}


def classes():
    """Names of all classes that the plugin registers."""
    headers = sorted((ROOT / "pkg" / "dem").rglob("*.hpp"))
    return [
        name for h in headers for name in re.findall(r"^REGISTER_SERIALIZABLE\((\w+)\)", h.read_text("utf-8"), re.M)
    ]


def class_of(name):
    return name.split(" ")[0]


def parents(name):
    """The plugin's classes that a class is, itself the last."""
    return [k.__name__ for k in reversed(getattr(wrapper, name).__mro__) if k.__name__ in OURS]


OURS = classes()


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def is_vector(value):
    return type(value).__name__.startswith(("Vector", "Quaternion", "Matrix"))


def attributes(kind):
    """Of a class, those that are numbers, vectors or lists and can be set, with their values in a new instance."""
    own = {k for base in parents(kind) for k in getattr(wrapper, base).__dict__} | set(INHERITED.get(kind, ()))
    made, found = getattr(wrapper, kind)(), {}
    for key, value in made.dict().items():
        if key not in own or not (is_number(value) or is_vector(value) or isinstance(value, list)):
            continue
        with contextlib.suppress(ValueError):  # a value that is refused can be set
            try:
                setattr(made, key, value)
            except AttributeError:  # it cannot
                continue
        found[key] = value
    return found


def element_of(kind, key):
    for base in parents(kind):
        if (base, key) in ELEMENTS:
            return ELEMENTS[base, key]
    raise AssertionError(f"{kind}.{key} is a list: say in ELEMENTS of what, and give a scene in which it is not empty")


def values_for(value):
    return (NAN, -1, 0, MOST) if isinstance(value, int) else (NAN, INF, -1.0, 0.0, HUGE)


def cases():
    for name, s in SCENES.items():
        for key, value in attributes(class_of(name)).items():
            if isinstance(value, list):
                value = element_of(class_of(name), key) if key in s.lists else None
            if value is not None and (s.only is None or key in s.only):
                yield name, key, values_for(value)


CASES = list(cases())


def places(value):
    """Where in an attribute's value there are numbers: paths of indices."""
    if is_number(value):
        return [()]
    return [(0, *rest) for rest in places(value[0])] if isinstance(value, list) else [(k,) for k in range(len(value))]


def changed(old, place, value):
    if not place:
        return value
    new = list(old)
    new[place[0]] = changed(new[place[0]], place[1:], value)
    return new if isinstance(old, list) else type(old)(*new)


def path_of(key, place):
    return key + "".join(f"[{k}]" for k in place)


# ---- what is looked at ------------------------------------------------------------------------------


def numbers(value):
    if is_number(value):
        yield float(value)
    elif is_vector(value) or isinstance(value, (list, tuple)):
        for one in value:
            yield from numbers(one)


def figures():
    """All that the scene shows: (whose, object, attribute, value)."""
    seen = []
    for e in O.engines:
        seen.append((type(e).__name__, e))
        for key in ("boundDispatcher", "geomDispatcher", "physDispatcher", "lawDispatcher"):
            seen += [(type(f).__name__, f) for f in getattr(getattr(e, key, None), "functors", ())]
    for b in O.bodies:
        seen += [(f"the state of body #{b.id}", b.state), (f"the shape of body #{b.id}", b.shape)]
    for i in O.interactions:
        if i.isReal:
            seen += [(f"the geometry of #{i.id1}+#{i.id2}", i.geom), (f"the physics of #{i.id1}+#{i.id2}", i.phys)]
    for whose, one in seen:
        for key, value in one.dict().items() if one is not None else ():
            yield whose, one, key, value
    for b in O.bodies:
        for key in ("pos", "vel", "angVel", "ori"):
            yield f"body #{b.id}", b.state, key, getattr(b.state, key)
        for key, value in (("a force", O.forces.f(b.id)), ("a torque", O.forces.t(b.id))):
            yield f"body #{b.id}", None, key, value


# what contacts have of a material's number, which may be infinite where that may be
MADE_OF = {
    "bondEllipseNormal": "ellipseNormal",
    "bondEllipseTangential": "ellipseTangential",
    "bondCreationDistance": "creationDistance",
}


def assert_finite(target, key):
    """All numbers of the scene are, but for the one that was set."""
    for whose, one, name, value in figures():
        if not (name == key and type(one) is type(target)) and name != MADE_OF.get(key):
            assert all(map(math.isfinite, numbers(value))), f"{whose} has {name} = {value}"


def stays(s):
    """What rests is where it was, the floor bears it, and nothing has fallen through."""
    for k in s.resting:
        gone, velocity = O.bodies[k].state.pos - s.places[k], O.bodies[k].state.vel
        assert gone.norm() < 2e-6, f"body #{k} has moved by {tuple(gone)} m"
        assert velocity.norm() < 1e-4, f"body #{k} has the velocity {tuple(velocity)} m/s"
    for k in s.falling:
        place, velocity = O.bodies[k].state.pos, O.bodies[k].state.vel
        assert place[1] > 0.4999 and velocity.norm() < 25, f"body #{k} is at {tuple(place)} m, {tuple(velocity)} m/s"
    if s.bed is not None:
        due, borne = weight(s.resting) + s.push(), O.forces.f(s.bed)
        assert (borne - due).norm() < 1e-6 * max(
            due.norm(), 1e-3
        ), f"the floor bears {tuple(borne)} N of {tuple(due)} N"
    s.also()


# ---- what is harmless -------------------------------------------------------------------------------


def lies(s):
    """Nothing has gone through what bears it, but it may slide and roll."""
    for k in s.resting + s.falling:
        start = s.places.get(k, Vector3(0, 0.5, 0))
        state = O.bodies[k].state
        assert abs(state.pos[1] - start[1]) < 1e-4 and state.vel.norm() < 25, f"body #{k} is at {tuple(state.pos)} m"
    if s.bed is not None:
        due, borne = weight(s.resting) + s.push(), O.forces.f(s.bed)
        assert abs(borne[1] - due[1]) <= 1e-3 * abs(due[1]), f"the floor bears {tuple(borne)} N of {tuple(due)} N"


def falls(s):
    """The wall does not act where the first disk is."""
    state = O.bodies[s.resting[0]].state
    assert state.pos[1] < s.places[s.resting[0]][1] and state.vel[1] < 0


def lifts(s):
    """The plate goes up, and the floor bears the disk alone."""
    low, plate = s.resting
    assert O.bodies[plate].state.vel[1] > 0
    assert (O.forces.f(s.bed) - weight([low])).norm() < 1e-6 * weight([low]).norm()


def counts_backwards(s):
    s.also(-1)


def counts_nothing(s):
    with pytest.raises(RuntimeError, match="no step was counted"):
        s.target().take()


def is_finite(s):
    """It goes where the number sends it; that all is finite is looked at in any case."""


def is_called(s):
    """In every step since the time was set."""
    stays(s)
    assert s.calls == list(range(O.iter - len(s.calls), O.iter)) and len(s.calls) >= 20


def is_not_called(s):
    stays(s)
    assert s.calls == []


def is_not_guided(s):
    stays(s)
    assert not O.bodies[s.target().id].intrs()


def is_refused_with_a_bond(s):
    stays(s)
    s.target().bonded = True
    with pytest.raises(RuntimeError, match=r"phys\.ellipse(Normal|Tangential|Twisting) (-?nan|-1|0)"):
        run(1)


AS_IT_IS = "it is 0 already"
NOT_READ = "the law writes it in each step, and reads it in none"
BEGINS = "the solve begins with it, and finds the reaction that the law asks for"
NO_ONE = "a body of such a layer is not there"
EITHER_END = "its being zero or not is all that counts, and either end of a joint may have the corner"
NEVER_BREAKS = "a bond that never leaves its ellipse"
NO_MASS = "a wall has no mass of its material, so nobody asks for its density"
NO_FRICTION = ("without friction it slides", lies)
NO_ROLLING = ("nothing resists rolling", lies)

# {(scene, or how its name begins; attribute, or a component): {value: why, or why and what to look at}};
# None: refused in this scene, though not in all whose names begin so
HARMLESS = {
    # ---- the solver
    ("ContactDynamicsEngine", "maxIterations"): {MOST: "a solve ends when it is solved"},
    ("ContactDynamicsEngine", "relaxationRate"): {0: "overlaps stay as they are"},
    ("ContactDynamicsEngine", "correctionSpeed"): {
        0: "overlaps stay as they are",
        INF: "the share of an overlap that a step takes back has no other bound than relaxationRate",
        HUGE: "the share of an overlap that a step takes back has no other bound than relaxationRate",
    },
    ("ContactDynamicsEngine", "correctionSlack"): {0: "the least overlap is taken back"},
    ("ContactDynamicsEngine", "correctionSweeps"): {0: "overlaps stay as they are"},
    ("ContactDynamicsEngine", "openGap"): {
        0: "what is left out of a solve, and closes all the same, is called back",
        INF: "no contact is left out of a solve",
        HUGE: "no contact is left out of a solve",
    },
    ("ContactDynamicsEngine", "maxImpacts"): {
        0: "impacts are left to the solve",
        MOST: "impacts are followed until there are none, and each takes energy",
    },
    ("ContactDynamicsEngine", "finalGravity[0]"): {-1: "an oblique gravity", 0: AS_IT_IS},
    ("ContactDynamicsEngine", "finalGravity[1]"): {-1: "a weak gravity", 0: "no gravity"},
    ("ContactDynamicsEngine", "finalGravity[2]"): {0: AS_IT_IS},
    ("ContactDynamicsEngine", "gravityBegin"): {
        -1: "a ramp that has begun a second ago, and is over",
        0: AS_IT_IS,
        HUGE: "a ramp that has not begun",
    },
    ("ContactDynamicsEngine", "gravityRamp"): {
        0: "no ramp, and the integrator's gravity stays",
        HUGE: "a ramp that has hardly begun",
    },
    ("PlanarGridCollider", "verletDist"): {
        -1: "a margin of the smallest radius",
        0: "no margin beyond what disks may go in some steps",
        HUGE: "all pairs are followed",
    },
    ("PlanarGridCollider", "sureReach"): {
        INF: "all pairs within the reach have an interaction",
        HUGE: "all pairs within the reach have an interaction",
    },
    ("PlanarNewtonIntegrator", "damping"): {0: AS_IT_IS},
    ("PlanarNewtonIntegrator", "gravity[0]"): {-1: "an oblique gravity", 0: "gravity straight down"},
    ("PlanarNewtonIntegrator", "gravity[1]"): {-1: "a weak gravity", 0: ("gravity along the floor", lies)},
    ("PlanarNewtonIntegrator", "gravity[2]"): {0: AS_IT_IS},
    ("PlanarNewtonIntegrator", "mask"): {-1: "all bodies", 0: "all bodies"},
    ("NonsmoothTimeStepper", "largest"): {HUGE: "growth bounds the step"},
    ("NonsmoothTimeStepper", "path"): {HUGE: "contacts do not bound the step"},
    ("NonsmoothTimeStepper", "bondPath"): {HUGE: "bonds do not bound the step"},
    ("NonsmoothTimeStepper", "growth"): {INF: "the largest step at once", HUGE: "the largest step at once"},
    ("NonsmoothTimeStepper", "sweeps"): {0: "sweeps do not matter", MOST: "no step takes as many sweeps"},
    # ---- loads
    ("PorePressureEngine", "unitWeight"): {0: "water without weight lifts nothing"},
    ("PorePressureEngine", "planePoint[0]"): {-1: "a level plane is the same at any of its points", 0: AS_IT_IS},
    ("PorePressureEngine", "planePoint[1]"): {-1: "a table that is lower by a metre", 0: AS_IT_IS},
    ("PorePressureEngine", "planePoint[2]"): {-1: "a plane upright to the x-y plane is the same at any z", 0: AS_IT_IS},
    ("PorePressureEngine", "planeNormal[0]"): {-1: "a plane that dips by 45 degrees", 0: AS_IT_IS},
    ("PorePressureEngine", "planeNormal[2]"): {0: AS_IT_IS},
    ("PorePressureEngine", "times[0]"): {-1: "a time before the run", 0: AS_IT_IS},
    ("PorePressureEngine", "heights[0]"): {-1: "a table below the plane: dry", 0: "a table that rises from the plane"},
    ("PorePressureEngine", "pressureGradient[0]"): {-1: "a push of a newton for each cubic metre", 0: AS_IT_IS},
    ("PorePressureEngine", "pressureGradient[1]"): {-1: "a lift of a newton for each cubic metre", 0: AS_IT_IS},
    ("PorePressureEngine", "pressureGradient[2]"): {0: AS_IT_IS},
    ("PorePressureEngine", "releaseDistance"): {
        0: "a disk is released when it moves downslope, and this one rests",
        INF: "water always acts",
        HUGE: "water always acts",
    },
    ("PorePressureEngine", "releasedShare[0]"): {0: AS_IT_IS},
    ("PorePressureEngine", "volumeFactor"): {0: "no volume is lifted"},
    ("PorePressureEngine", "thickness"): {0: "no volume is lifted"},
    ("PorePressureEngine", "mask"): {-1: "all groups", 0: "all spheres", MOST: "all groups"},
    ("PorePressureField", "nodes[0][0]"): {-1: "another triangle", 0: "another triangle"},
    ("PorePressureField", "nodes[0][1]"): {-1: "another triangle", 0: "another triangle"},
    ("PorePressureField", "nodes[0][2]"): dict.fromkeys((NAN, INF, -1, 0, HUGE), "z is not read"),
    ("PorePressureField", "times[0]"): {-1: "a time before the run", 0: AS_IT_IS},
    ("PorePressureField", "pressures[0]"): {-1: "another pressure", 0: "another pressure"},
    ("GroundMotionEngine", "times[0]"): {-1: "a record that has begun", 0: AS_IT_IS},
    ("GroundMotionEngine", "horizontal[0]"): {-1: "a ground that first goes to the left", 0: "one that first stands"},
    ("GroundMotionEngine", "vertical[0]"): {-1: "a ground that first sinks", 0: "one that first stands"},
    ("GroundMotionEngine", "begin"): {-1: "a record that is over", 0: AS_IT_IS},
    ("GroundMotionEngine", "scale"): {-1: "the other way", 0: "the ground stands still"},
    ("GroundMotionEngine of a wall", "ids"): {0: AS_IT_IS},
    ("PlateLoadEngine", "direction[0]"): {
        -1: "an oblique push, of which what holds the plate takes its part",
        0: AS_IT_IS,
    },
    ("PlateLoadEngine", "direction[1]"): {-1: AS_IT_IS},
    ("PlateLoadEngine", "direction[2]"): {0: AS_IT_IS},
    ("PlateLoadEngine", "force"): {-1: "a force against the direction", 0: "no force"},
    ("PlateLoadEngine", "stress"): {-1: ("a stress that pulls", lifts), 0: "no stress"},
    ("PlateLoadEngine", "damping"): {0: "no damping"},
    ("PlateLoadEngine", "rail"): {-1: "none, as a plate that moves along an axis needs none"},
    ("PlateLoadEngine", "origin"): dict.fromkeys((NAN, INF, -1, 0, HUGE), "without a rail no way is asked for"),
    ("PlateLoadEngine with a rail", "direction[0]"): {-1: "another way", 0: "another way"},
    ("PlateLoadEngine with a rail", "direction[1]"): {-1: "another way", 0: "another way"},
    ("PlateLoadEngine with a rail", "stress"): {-1: "a stress that pulls, less than the force", 0: AS_IT_IS},
    ("PlateLoadEngine with a rail", "rail"): {
        -1: ("the guide is given up, and nothing pushes this plate aside, whose weight is taken off", is_not_guided)
    },
    ("PlateLoadEngine with a rail", "origin"): dict.fromkeys((NAN, INF, -1, 0, HUGE)),
    ("PlateLoadEngine with a rail", "origin[2]"): {-1: "a way in the x-y plane is the same at any z", 0: AS_IT_IS},
    ("WallForceEngine", "ids"): {0: ("a disk, on which the force is the opposite one", counts_backwards)},
    ("WallForceEngine", "along[0][0]"): {-1: ("a wall that is travelled backwards", counts_backwards)},
    ("WallForceEngine", "along[0][1]"): {0: AS_IT_IS},
    ("WallForceEngine", "along[0][2]"): {0: AS_IT_IS},
    ("WallForceEngine", "period"): {MOST: ("no step is counted, and take() says so", counts_nothing)},
    ("CourseRunner", "nextTime"): {
        -1: ("a time that has come", is_called),
        0: ("a time that has come", is_called),
        INF: ("a time that never comes", is_not_called),
        HUGE: ("a time that does not come", is_not_called),
    },
    # ---- materials
    ("NscdMat", "tensileStrength"): {0: "bonds without tension"},
    ("NscdMat", "residualTensileStrength"): {0: "contacts without tension"},
    ("NscdMat", "residualFrictionAngle"): {-1: "as frictionAngle", 0: NO_FRICTION},
    ("NscdMat", "rollingFriction"): {0: NO_ROLLING},
    ("NscdMat", "residualRollingFriction"): {-1: "as rollingFriction", 0: NO_ROLLING},
    ("NscdMat", "twistingFriction"): {0: NO_ROLLING},
    ("NscdMat", "residualTwistingFriction"): {-1: "as twistingFriction", 0: NO_ROLLING},
    ("NscdMat", "bondEllipseTwisting"): {-1: "twice the tangential half-axis", INF: NEVER_BREAKS, HUGE: NEVER_BREAKS},
    ("NscdMat", "bondEllipseNormal"): {INF: NEVER_BREAKS, HUGE: NEVER_BREAKS},
    ("NscdMat", "bondEllipseTangential"): {INF: NEVER_BREAKS, HUGE: NEVER_BREAKS},
    ("NscdMat", "bondCreationDistance"): {
        0: "bonds where disks touch",
        INF: "bonds wherever there is a contact",
        HUGE: "bonds wherever there is a contact",
    },
    ("NscdMat", "restitution"): {0: AS_IT_IS},
    ("NscdMat", "layer"): {-1: "a layer without bonds", 0: "a layer", MOST: "a layer"},
    ("NscdMat", "interfaceLayers"): dict.fromkeys((-1, 0, MOST), NO_ONE),
    ("NscdMat", "frictionAngle"): {0: NO_FRICTION},
    ("SlipWeakeningMat", "criticalSlip"): {INF: "a wall that never weakens", HUGE: "a wall that never weakens"},
    ("SlipWeakeningMat", "weakenedFrictionAngle"): {
        0: "no friction is left where the slip is great, and this disk has none"
    },
    ("SlipWeakeningMat", "weakenedTensileStrength"): {0: AS_IT_IS},
    ("SlipSurfaceMat", "cellLength"): {0: "eight mean diameters, as it is"},
    ("SlipSurfaceMat", "averagingSlip"): {0: "half a cell, as it is"},
    # what other contacts take, and these refuse, since the law alone says what friction is
    ("SlipSurfaceMat", "frictionAngle"): {0: None},
    ("SlipSurfaceMat", "residualFrictionAngle"): {0: None},
    ("SlipSurfacePhys", "tangensOfFrictionAngle"): {0: None},
    # ---- contacts
    ("NscdPhys", "normal"): {-1: BEGINS, 0: BEGINS},
    ("NscdPhys", "tangential"): {-1: BEGINS, 0: BEGINS},
    ("NscdPhys", "torque"): {-1: BEGINS, 0: BEGINS},
    ("NscdPhys", "restitution"): {0: AS_IT_IS},
    ("NscdPhys", "residualTensileForce"): {0: "a contact without tension"},
    ("NscdPhys", "residualFriction"): {0: NO_FRICTION},
    ("NscdPhys", "residualRollingArm"): {0: NO_ROLLING},
    ("NscdPhys", "tensileForce"): {0: "a bond without tension"},
    ("NscdPhys", "friction"): {0: NO_FRICTION},
    ("NscdPhys", "rollingArm"): {0: NO_ROLLING},
    ("NscdPhys", "creationDistance"): {
        0: "a bond where bodies touch",
        INF: "a bond at any gap",
        HUGE: "a bond at any gap",
    },
    ("NscdPhys", "tangensOfFrictionAngle"): {0: NO_FRICTION},
    ("NscdPhys", "kn"): {0: AS_IT_IS},
    ("NscdPhys", "ks"): {0: AS_IT_IS},
    ("NscdPhys", "normalForce[0]"): {0: AS_IT_IS},
    ("NscdPhys", "normalForce[2]"): {0: AS_IT_IS},
    ("NscdSpacePhys", "twistingArm"): {0: NO_ROLLING},
    ("NscdSpacePhys", "residualTwistingArm"): {0: NO_ROLLING},
    ("NscdSpacePhys", "normalForce[1]"): {0: AS_IT_IS},
    ("NscdSpacePhys", "shearForce[0]"): {0: AS_IT_IS},
    ("NscdPhys", "shearForce[1]"): {0: AS_IT_IS},
    ("NscdPhys", "shearForce[2]"): {0: AS_IT_IS},
    # ---- walls
    ("Segment", "sense"): {-1: ("the lower side acts, and the disk is above", falls), 0: "both sides act"},
    ("Segment", "nextDirection"): dict.fromkeys((NAN, INF, -1, 0, HUGE), EITHER_END),
    ("Segment", "previousDirection"): dict.fromkeys((NAN, INF, -1, 0, HUGE), EITHER_END),
    ("Arc", "sense"): {-1: ("the outside acts, and the disk is inside", falls), 0: "both sides act"},
    ("Law2_ScGeom_NscdPhys_SignoriniCoulomb", "reach"): {
        0: "a contact once bodies touch, and what they have gone into each other by then is taken back",
        HUGE: "a contact at any gap",
    },
    ("Law2_ScGeom_NscdPhys_SignoriniCoulomb", "adhesionRange"): {
        0: "tension where bodies touch",
        HUGE: "tension at any gap",
    },
    # ---- springs
    ("WallPhys", "length"): {0: "it is asked for where slip weakens the wall alone"},
    ("WallPhys", "tensileForce"): {0: "a bond without tension"},
    ("WallPhys", "friction"): {0: NO_FRICTION},
    ("WallPhys", "residualFriction"): {0: NO_FRICTION},
    ("WallPhys", "rollingArm"): {0: NO_ROLLING},
    ("WallPhys", "residualRollingArm"): {0: NO_ROLLING},
    ("WallPhys", "kr"): {0: "rolling changes no torque"},
    ("WallPhys", "rollingTorque"): {
        -1: ("the spring comes to its torque anew", lies),
        0: ("the spring comes to its torque anew", lies),
    },
    ("WallPhys", "restPenetration"): dict.fromkeys((-1, 0), "without a bond nobody asks for it"),
    ("WallPhys of a bond", "restPenetration"): {
        -1: ("a bond that is pressed by a metre throws the disk away", is_finite)
    },
    ("WallPhys of a ductile bond", "restPenetration"): {
        -1: ("a bond that is pressed by a metre throws the disk away", is_finite)
    },
    ("WallPhys", "tangensOfFrictionAngle"): dict.fromkeys((NAN, INF, -1, 0, HUGE), NOT_READ),
    ("WallPhys", "normalForce"): dict.fromkeys((NAN, INF, -1, 0, HUGE), NOT_READ),
    ("WallPhys", "shearForce[0]"): {
        -1: ("the spring comes to its force anew", lies),
        0: ("the spring comes to its force anew", lies),
        HUGE: ("the force is cut at its threshold", lies),
    },
    ("WallPhys", "shearForce[1]"): {0: AS_IT_IS},
    ("WallPhys", "shearForce[2]"): {0: AS_IT_IS},
    ("Ip2_NscdMat_FrictMat_WallPhys", "rollingRatio"): {0: "rolling changes no torque"},
}
for one in ("NscdMat", "SlipWeakeningMat"):
    HARMLESS[f"{one} of a soft wall", "density"] = dict.fromkeys((NAN, INF, -1, 0, HUGE), NO_MASS)
ELLIPSES = (("NscdPhys", "ellipseNormal"), ("NscdPhys", "ellipseTangential"), ("NscdSpacePhys", "ellipseTwisting"))
for kind, one in ELLIPSES:
    HARMLESS[kind, one] = {
        **dict.fromkeys((NAN, -1, 0), ("without a bond nobody asks for it", is_refused_with_a_bond)),
        **dict.fromkeys((INF, HUGE), NEVER_BREAKS),
    }
    for of_bonds in {f"{kind} of a bond", "NscdSpacePhys of a bond"}:
        HARMLESS[of_bonds, one] = dict.fromkeys((NAN, -1, 0))

UNSEEN = (
    "an attribute of YADE's own, which leaves no mark when it is set, "
    "and whose reader runs in threads that no exception may leave"
)

# what cannot be refused and is not tried, as HARMLESS has it
NOT_OURS = {
    ("WallPhys", "shearForce"): dict.fromkeys((NAN, INF), UNSEEN),
    ("WallPhys", "shearForce[1]"): dict.fromkeys((-1, HUGE), UNSEEN),
    ("WallPhys", "shearForce[2]"): dict.fromkeys((-1, HUGE), UNSEEN),
}
for one in ("NscdMat", "SlipWeakeningMat"):
    NOT_OURS[f"{one} of a soft wall", "frictionAngle"] = dict.fromkeys((NAN, INF, -1, HUGE), UNSEEN)


def told_of(table, name, path):
    """{value: what a table says} of an attribute in a scene; a scene counts before its class."""
    found = {}
    for base in parents(class_of(name))[:-1] + [" ".join(name.split(" ")[:k]) for k in range(1, name.count(" ") + 2)]:
        for key in (re.sub(r"\[.*", "", path), path):
            found.update(table.get((base, key), {}))
    return found


def names_it(message, key, value):
    """Whether a message has the attribute's name and its value."""
    text = {NAN: "-?nan", INF: "inf", HUGE: r"1e\+300"}.get(value) or rf"{value:.10g}(\.0+)?"
    return bool(re.search(rf"\b{key}\b", message) and re.search(rf"(?<![\w.#+-]){text}(?![\w.])", message))


def outcome(name, key, place, value, early):
    """What is wrong with what becomes of a value; None where nothing is."""
    O.reset()
    s = SCENES[name].make()
    if not early:
        run(1)
        s.settle()
        run(2)
    target = s.target()
    old = getattr(target, key)
    told = told_of(HARMLESS, name, path_of(key, place)).get(value)
    try:
        setattr(target, key, changed(old, place, value))
        s.apply()
        if early:
            run(1)
            s.settle()
        run(20)
    except Exception as error:
        message = str(error)
        if told:
            return f"HARMLESS says that it is taken, and it is not: {message}"
        if type(error).__name__ in ("TypeError", "ArgumentError", "OverflowError"):  # no number of that type
            return None
        return None if names_it(message, key, value) else f"the message does not name it: {message}"
    reason, check = told if isinstance(told, tuple) else (told, stays)
    try:
        assert_finite(target, key)
        check(s)
    except (Exception, pytest.fail.Exception) as error:
        return f"{'HARMLESS says' if told else 'nobody says'} that it is taken, and then {str(error) or repr(error)}"
    return None if reason else "it is taken, nobody says so, and nothing is seen of it"


def apart(work, seconds=3):
    """Calls a function in a child, which ends when it has computed so long, so that a loop without an end ends.

    With several threads, which a child would not have, it is called here.
    """
    if O.numThreads > 1:
        return work()
    into, out = os.pipe()
    child = os.fork()
    if not child:
        try:
            resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
            os.write(out, pickle.dumps(work()))
        finally:
            os._exit(0)
    os.close(out)
    with os.fdopen(into, "rb") as pipe:
        found = pipe.read()
    status = os.waitpid(child, 0)[1]
    return pickle.loads(found) if found else f"the step does not end, or the process does: signal {os.WTERMSIG(status)}"


def outcomes(name, key, value):
    """What is wrong in each place of an attribute, by what was done."""
    s = SCENES[name].make()
    if not SCENES[name].before:
        run(1)
    for place in places(getattr(s.target(), key)):
        if value in told_of(NOT_OURS, name, path_of(key, place)):
            continue
        # what may be a number of turns, or a way through a list
        call = apart if value == MOST or len(place) > 1 else lambda work: work()
        for early in (True, False) if SCENES[name].before else (False,):
            wrong = call(lambda: outcome(name, key, place, value, early))
            if wrong:
                yield f"{path_of(key, place)} = {value} {'before the first step' if early else 'in a run'}: {wrong}"


@pytest.mark.parametrize("name, key, values", CASES, ids=[f"{n}.{k}".replace(" ", "_") for n, k, _ in CASES])
def test_a_number_is_refused_by_its_name_or_harmless(name, key, values):
    wrong = []
    for value in values:
        O.reset()
        wrong += outcomes(name, key, value)
    if wrong:
        pytest.fail("\n".join(wrong), pytrace=False)


@pytest.mark.parametrize("name", SCENES)
def test_a_scene_in_which_nothing_is_set_rests(name):
    s = SCENES[name].make()
    run(1)
    s.settle()
    run(22)
    assert_finite(None, None)
    stays(s)


@pytest.mark.parametrize("kind", OURS)
def test_every_number_of_a_class_is_tried(kind):
    tried = {key for name, key, _ in CASES if class_of(name) == kind}
    none = {key for key, value in attributes(kind).items() if isinstance(value, list) and element_of(kind, key) is None}
    assert tried == attributes(kind).keys() - none, "give a scene in which the class acts, and its lists have elements"


def test_what_is_called_harmless_is_tried():
    for (base, path), told in [*HARMLESS.items(), *NOT_OURS.items()]:
        key = re.sub(r"\[.*", "", path)
        found = {v for n, k, values in CASES for v in values if k == key and (n + " ").startswith(base + " ")}
        assert told.keys() <= found, f"{base}.{path}"


def test_what_is_not_ours_is_an_attribute_of_yade():
    for base, path in NOT_OURS:
        assert re.sub(r"\[.*", "", path) in INHERITED[class_of(base)], f"{base}.{path}"
