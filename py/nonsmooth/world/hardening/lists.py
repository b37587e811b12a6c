"""O.engines of springs, turned into those of rigid contacts."""

from __future__ import annotations

from yade.wrapper import (
    Arc,
    Bo1_Arc_Aabb,
    Bo1_Segment_Aabb,
    Collider,
    ContactDynamicsEngine,
    DomainLimiter,
    ForceResetter,
    Ig2_Arc_Sphere_ScGeom,
    Ig2_Segment_Sphere_ScGeom,
    InsertionSortCollider,
    InteractionLoop,
    NewtonIntegrator,
    PlanarGridCollider,
    PlanarNewtonIntegrator,
    PyRunner,
    Segment,
    Sphere,
    TimeStepper,
)

from .. import space
from . import triaxial
from .error import HardenError

__all__ = ["hard_engines", "loop_of", "newton_of"]

# laws of springs, friction and damping between spheres; a law that is no contact of grains has no rigid counterpart
_LAWS = (
    "Law2_ScGeom_FrictPhys_CundallStrack",
    "Law2_ScGeom6D_CohFrictPhys_CohesionMoment",
    "Law2_ScGeom_ViscElPhys_Basic",
    "Law2_ScGeom_ViscoFrictPhys_CundallStrack",
    "Law2_ScGeom_MindlinPhys_Mindlin",
    "Law2_ScGeom_MindlinPhys_MindlinDeresiewitz",
    "Law2_ScGeom_MindlinPhys_HertzWithLinearShear",
    "Law2_ScGeom_NscdPhys_SignoriniCoulomb",
)
_SHAPES = {
    **space.SHAPES,
    Segment: (Bo1_Segment_Aabb, Ig2_Segment_Sphere_ScGeom),
    Arc: (Bo1_Arc_Aabb, Ig2_Arc_Sphere_ScGeom),
}


def loop_of(engines):
    """The InteractionLoop that runs; raises HardenError where there is none, or its law has no rigid counterpart."""
    loops = [e for e in engines if isinstance(e, InteractionLoop) and not e.dead]
    if not loops:
        raise HardenError(
            "O.engines has no InteractionLoop, so that nothing says which contacts the scene has: set O.engines as for soft contacts, then call harden()"
        )
    for law in loops[0].lawDispatcher.functors:
        if type(law).__name__ not in _LAWS:
            raise HardenError(
                f"{type(law).__name__} has no rigid counterpart: harden() takes frictional, visco-elastic, cohesive-frictional and Mindlin contacts of spheres ({', '.join(_LAWS[:-1])})"
            )
    return loops[0]


def newton_of(engines, bodies=None):
    """The NewtonIntegrator that runs; raises HardenError where there is not one of them, or where its mask leaves out some
    of the ``bodies`` that can move (None: they are not looked at).
    """
    newtons = [e for e in engines if isinstance(e, NewtonIntegrator) and not e.dead]
    if len(newtons) != 1:
        raise HardenError(
            f"O.engines has {len(newtons) or 'no'} NewtonIntegrator{'s' * (len(newtons) > 1)}, which moves rigid bodies: put one in, in the place of another integrator"
        )
    # walls that it leaves out stay, as belts: their velocity acts, and nothing moves them
    if newtons[0].mask > 0 and any(b.dynamic and not b.mask & newtons[0].mask for b in bodies or ()):
        raise HardenError(
            f"NewtonIntegrator.mask = {newtons[0].mask}: the solver takes bodies outside of the mask for moving; set mask = -1 and block the DOFs of bodies that must stay"
        )
    return newtons[0]


def hard_engines(engines, shapes, in_plane, options):
    """The list for rigid contacts, in the order of ``engines``, and rows (what, became) for the table.

    ``shapes``: classes of the shapes in the scene; ``in_plane``: whether all that moves stays in the x-y plane;
    ``options``: attributes of ContactDynamicsEngine. Raises HardenError for a shape that nothing rigid can touch, and
    for an integrator that is none of YADE's usual one.
    """
    unknown = sorted(kind.__name__ for kind in shapes if kind not in _SHAPES)
    if unknown:
        raise HardenError(
            f"bodies have the shapes {', '.join(unknown)}, which rigid spheres cannot touch yet: harden() takes {', '.join(kind.__name__ for kind in _SHAPES)}; set bounded = False for what nothing is to touch"
        )
    touched = {kind: functors for kind, functors in _SHAPES.items() if kind in shapes or kind is Sphere}
    newton = newton_of(engines)
    made, rows, behind = [], [], []  # behind: what measures after the integrator
    if not any(isinstance(e, ForceResetter) and not e.dead for e in engines):
        made.append(ForceResetter())
    for engine in engines:
        name = type(engine).__name__
        if engine.dead:
            made.append(engine)
        elif isinstance(engine, TimeStepper):
            rows.append((name, "dropped: the step of rigid contacts does not depend on stiffness"))
        elif isinstance(engine, Collider):
            made.append(_collider(engine, touched, in_plane))
            rows.append((name, f"{type(made[-1]).__name__}, which sees open gaps of {space.REACH:g} ℓ"))
        elif isinstance(engine, InteractionLoop):
            made.append(space.loop(space.REACH, shapes=touched, label=engine.label))
            if not _meet(engine):  # a script may leave spheres through each other
                made[-1].geomDispatcher.functors = made[-1].geomDispatcher.functors[1:]
                rows.append(("no contacts of spheres with spheres", "stays so"))
            laws = ", ".join(type(law).__name__ for law in engine.lawDispatcher.functors)
            rows.append((f"{name} ({laws})", "NscdInteractionLoop (Law2_ScGeom_NscdPhys_SignoriniCoulomb)"))
        elif type(engine).__name__ in (*triaxial.KINDS, triaxial.RECORDER):
            behind.append(engine)
            if engine is triaxial.controller_of(engines):
                rows.append((name, _triaxial(engine)))
        elif isinstance(engine, DomainLimiter):
            made.append(_limiter(engine))
            rows.append((name, "PyRunner, which erases the same bodies"))
        elif engine is newton:
            damping = engine.damping
            usual = {"label": "contactDynamics"} | ({} if in_plane else {"openGap": space.OPEN_GAP})
            press, hold = [], []
            if steered := triaxial.controller_of(engines):
                before, after = triaxial.commands(steered.max_vel)
                press, hold = ([PyRunner(command=c, iterPeriod=1, initRun=True)] for c in (before, after))
                steered.max_vel = 0
            moves = _integrator(engine, in_plane)
            made += [*press, ContactDynamicsEngine(**{**usual, **options}), moves, *hold]
            integrated = len(made)
            rows.append(
                (f"{name} (damping = {damping:g})", f"ContactDynamicsEngine and {type(moves).__name__} (damping = 0)")
            )
        else:
            made.append(engine)
    made[integrated:integrated] = behind
    return made, rows


def _triaxial(engine):
    grown = ", which press in the place of growing spheres" if engine.internalCompaction else ""
    return f"measures behind the integrator; walls under a stress are plates that bear it{grown}"


def _meet(loop):
    """Whether a loop of springs has contacts of spheres with each other."""
    return any(type(functor).__name__.startswith("Ig2_Sphere_Sphere_") for functor in loop.geomDispatcher.functors)


def _collider(old, shapes, in_plane):
    if in_plane:  # where no wall asks for twice the reach
        return PlanarGridCollider(space.bounds(0.5 * space.REACH, shapes), verletDist=-0.2, label=old.label)
    return InsertionSortCollider(
        space.bounds(space.REACH, shapes), label=old.label, avoidSelfInteractionMask=old.avoidSelfInteractionMask
    )


def _integrator(old, in_plane):
    if in_plane:
        return PlanarNewtonIntegrator(damping=0, gravity=old.gravity, label=old.label)
    old.damping = 0
    return old


def _limiter(old):
    """DomainLimiter ends the process where it erases a body that Python has made."""
    command = f"from yade.nonsmooth.world.hardening import domain as _d; _d.limit({tuple(old.lo)}, {tuple(old.hi)}, {old.mask})"
    return PyRunner(
        command=command,
        iterPeriod=old.iterPeriod,
        virtPeriod=old.virtPeriod,
        realPeriod=old.realPeriod,
        label=old.label,
    )
