"""Random programs of spheres in space, between a wall, facets and a box that may move; see random_programs.py.

    scripts/yade-nonsmooth tests/yade/random_programs_space.py --programs 500
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import random_programs as plane
from random_programs import NOT_PLAIN, disks, one, walls
from yade import O, utils
from yade.minieigenHP import Quaternion, Vector3
from yade.nonsmooth.world import space
from yade.wrapper import (
    InsertionSortCollider,
    InteractionLoop,
    Ip2_NscdMat_NscdMat_NscdPhys,
    Law2_ScGeom_NscdPhys_SignoriniCoulomb,
    NewtonIntegrator,
    NscdInteractionLoop,
    NscdMat,
    SpatialNewtonIntegrator,
)

# what does not depend on the dimension; YADE's collider does not outlive that all bodies go
SHARED = (
    "heavier grown let_go appended erased replaced put_back parted cleared bonded bonded_unseen unbonded "
    "bonds_set strengths_set friction_written forces_reset material_changed strengths_updated material_exchanged "
    "step_changed settings_changed reloaded saved time_reset energies_tracked forgotten refused refused_body raised "
    "redirection engine_added another_scene"
).split()
KINDS = {name: plane.KINDS[name] for name in SHARED}


def kind(looks="all", within=True, between=True, ways=plane.WAYS):
    """As random_programs.kind."""

    def note(function):
        KINDS[function.__name__] = dict(function=function, looks=looks, within=within, between=between, ways=ways)
        return function

    return note


def vector(dice, size):
    return Vector3(*(dice.uniform(-size, size) for _ in range(3)))


@kind("bodies")
def velocity(dice, ids):
    for i in ids:
        O.bodies[i].state.vel += vector(dice, 1)


@kind("bodies")
def spin(dice, ids):
    for i in ids:
        O.bodies[i].state.angVel = vector(dice, 3)


@kind("bodies")
def place(dice, ids):
    for i in ids:
        O.bodies[i].state.pos += vector(dice, 0.02)


@kind("bodies")
def turned(dice, ids):
    for i in ids:
        turn = Quaternion(vector(dice, 1).normalized(), dice.uniform(-0.02, 0.02))
        O.bodies[i].state.ori = turn * O.bodies[i].state.ori


@kind("bodies")
def blocked(dice, ids):
    for i in ids:
        O.bodies[i].state.blockedDOFs = dice.choice(("", "xyzXYZ", "xY", "XYZ", "z"))
        if O.bodies[i].state.blockedDOFs == "xyzXYZ":
            O.bodies[i].state.vel = O.bodies[i].state.angVel = (0, 0, 0)


@kind("none")
def pushed(dice):
    for i in dice.sample(disks(), 2):
        O.forces.setPermF(i, vector(dice, 1e4))


@kind("all")
def wall_moved(dice):
    O.bodies[walls()[-1]].state.pos += vector(dice, 0.01)


@kind("all")
def wall_driven(dice):
    O.bodies[walls()[-1]].state.vel = vector(dice, 0.2)


@kind("none")
def wall_erased(dice):
    if len(walls()) > 3:
        O.bodies.erase(walls()[-1])


@kind("none", within=False)
def gravity_changed(dice):
    one(NewtonIntegrator).gravity = vector(dice, 5) - Vector3(0, 0, 5)


@kind("none", within=False)
def functors_exchanged(dice):
    loop = one(InteractionLoop)
    loop.lawDispatcher.functors = [Law2_ScGeom_NscdPhys_SignoriniCoulomb(reach=dice.choice((plane.REACH, 0.05)))]
    loop.geomDispatcher.functors = [
        contact(interactionDetectionFactor=1 + plane.REACH) for _, contact in space.SHAPES.values()
    ]
    loop.physDispatcher.functors = [Ip2_NscdMat_NscdMat_NscdPhys()]


@kind("all", within=False, ways=NOT_PLAIN)
def engines_exchanged(dice):
    """New objects of the same kinds, or of YADE's own among ours."""
    new = []
    for e in O.engines:
        if isinstance(e, InteractionLoop) and dice.random() < 0.7:
            make = InteractionLoop if dice.random() < 0.3 else NscdInteractionLoop
            e = make(e.geomDispatcher.functors, e.physDispatcher.functors, e.lawDispatcher.functors)
        elif isinstance(e, InsertionSortCollider):  # it goes with the integrator that it has found
            e = InsertionSortCollider(e.boundDispatcher.functors, verletDist=e.verletDist)
        elif isinstance(e, NewtonIntegrator) and dice.random() < 0.7:
            make = NewtonIntegrator if dice.random() < 0.5 else SpatialNewtonIntegrator
            e = make(damping=0, gravity=e.gravity)
        new.append(e)
    O.engines = new


class Space:
    """What programs are made of: spheres."""

    kinds = KINDS

    @staticmethod
    def materials(dice):
        shared = dict(density=2500, bondCreationDistance=0.03, bondEllipseNormal=0.03, bondEllipseTangential=0.03)
        base = NscdMat(frictionAngle=0.4, tensileStrength=8e3, rollingFriction=0.05, twistingFriction=0.05, **shared)
        base.residualTensileStrength = dice.choice((0.0, 0.0, 500.0))
        O.materials.append(base)
        O.materials.append(NscdMat(frictionAngle=0.2, restitution=dice.choice((0.0, 0.3)), **shared))

    @staticmethod
    def populate(dice):
        """A corner of spheres, a few of them fixed, on a wall beside facets, with a box that may move."""
        O.bodies.append(utils.wall((0, 0, 0), 2, material=O.materials[0]))
        O.bodies.append(utils.facet([(0, -1, -1), (0, 5, -1), (0, 2, 5)], material=O.materials[1]))
        O.bodies.append(utils.facet([(-1, 0, -1), (2, 0, 5), (5, 0, -1)], material=O.materials[0]))
        O.bodies.append(utils.box((2.6, 1.4, 1.0), (0.3, 1.5, 1.2), fixed=True, material=O.materials[1]))
        for k in range(dice.randint(24, 40)):
            x, y, z = 0.36 + 0.69 * (k % 3), 0.36 + 0.69 * (k // 3 % 4), 0.36 + 0.66 * (k // 12)
            body = utils.sphere(
                (x + dice.uniform(-0.01, 0.01), y + dice.uniform(-0.01, 0.01), z + dice.uniform(-0.01, 0.01)),
                dice.uniform(0.32, 0.35),
                material=O.materials[int(dice.random() < 0.2)],
            )
            body.state.vel = vector(dice, 0.5)
            if dice.random() < 0.05:
                body.state.vel, body.state.blockedDOFs = (0, 0, 0), "xyzXYZ"
            O.bodies.append(body)

    @staticmethod
    def body(dice):
        at = (dice.uniform(0.5, 2), dice.uniform(0.5, 3), 4.0 + dice.uniform(0, 1.5))
        body = utils.sphere(at, dice.uniform(0.2, 0.4), material=O.materials[0])
        body.state.vel = vector(dice, 1)
        return body

    @staticmethod
    def three_bodies():
        O.materials.append(NscdMat(density=2500))
        O.bodies.append([utils.sphere((k, 0, 0.1 * k), 0.5) for k in range(3)])
        O.engines = space.engines(gravity=(0, 0, -1))

    @staticmethod
    def engines(dice):
        O.engines = space.engines(gravity=(0.5, 0.2, -9.81), reach=plane.REACH, tolerance=1e-6, maxIterations=100)
        one(InsertionSortCollider).verletDist = dice.choice((0, -0.1, -0.5))  # in every way the same

    @staticmethod
    def own_engines():
        """YADE's own engines."""
        new = []
        for e in O.engines:
            if isinstance(e, NscdInteractionLoop):
                e = InteractionLoop(e.geomDispatcher.functors, e.physDispatcher.functors, e.lawDispatcher.functors)
            elif isinstance(e, SpatialNewtonIntegrator):
                e = NewtonIntegrator(damping=0, gravity=e.gravity)
            new.append(e)
        O.engines = new

    @staticmethod
    def vectors_of(phys, geom):
        if not hasattr(phys, "rollingTorque"):
            return ()
        return (
            phys.normalForce,
            phys.shearForce,
            phys.rollingTorque,
            phys.twistingTorque,
            phys.currentTwistingArm,
            geom.normal,
            geom.contactPoint,
            geom.refR1,
        )


if __name__ == "__main__":
    sys.exit(plane.main(Space))
