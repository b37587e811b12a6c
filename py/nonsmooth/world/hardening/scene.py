"""harden(O): the scene that a script has built, with rigid contacts."""

from __future__ import annotations

import functools
import math
import textwrap

import numpy as np
from tabulate import tabulate

from yade.wrapper import ContactDynamicsEngine, NewtonIntegrator, NscdMat, PeriodicEngine, PyRunner, Sphere

from .. import space
from . import belts, triaxial
from .energies import hear_energies
from .error import HardenError
from .lists import hard_engines, loop_of, newton_of
from .room import refuse_far_bonds, refuse_wedged
from .steps import hard_step
from .strengths import hard_material, pairs_of, restitution_of, restitution_of_damping, set_pairs

__all__ = ["HardenError", "Hardened", "harden"]

_PLANE = "zXY"
_SPRINGS = ("VESupportEngine",)  # engines that need the step of springs
_BOND = "from yade.nonsmooth.world.scene import contact_dynamics as _c; _c().bond()"


class Hardened:
    """What became what, as :func:`harden` tells it: ``rows`` of (what, became), ``soft_step`` and ``step`` [s];
    ``str()`` is a table."""

    def __init__(self, rows, soft_step, step, materials, harden_one):
        self.rows, self.soft_step, self.step = rows, soft_step, step
        self._materials, self._harden_one = materials, harden_one

    def __str__(self):
        wrapped = [["\n".join(textwrap.wrap(text, width)) for text, width in zip(row, (44, 68))] for row in self.rows]
        return tabulate(wrapped, headers=["soft", "rigid"])

    def take(self, bodies):
        """Gives bodies that came later rigid materials too."""
        for body in bodies:
            if body is not None and body.material is not None and not isinstance(body.material, NscdMat):
                body.material = self._hard(body.material)

    def _hard(self, soft):
        if soft not in self._materials:
            self._materials[soft] = self._harden_one(soft)
        return self._materials[soft]


def harden(O, step=None, restitution=None, **options):
    """Turns the scene ``O``, built for springs, into one of rigid contacts; returns a :class:`Hardened`, which prints
    as a table of what became what and what was dropped.

    Materials with springs (FrictMat, CohFrictMat, ViscElMat) become NscdMats with their friction, rolling and
    twisting resistance, cohesion and restitution (:mod:`yade.nonsmooth.hardening.strengths`); the InteractionLoop
    gets the rigid law and geometry that sees open gaps; NewtonIntegrator's damping becomes 0, with a
    ContactDynamicsEngine before it; time steppers go. All that moves in the x-y plane alone (blockedDOFs "zXY") is
    solved there. Present interactions end, and are found again.

    ``step``: O.dt [s]; "soft": it stays; None: a tenth of the smallest sphere's diameter is the longest way in a step,
    or it stays where engines with springs of their own (VESupportEngine) are at work. Engines that act
    every so many steps act after the same time as before. ``restitution``: of all contacts, in place of what materials
    and functors say; "damping": where these say nothing, what NewtonIntegrator's damping λ leaves of an impact of
    springs, √((1 − λ)/(1 + λ)), 1 without damping; ``options``: attributes of ContactDynamicsEngine.

    Raises HardenError, a RuntimeError, for what has no rigid counterpart: clumps, periodic cells, shapes and laws other
    than those above, spheres wedged between boxes, cohesion across gaps; and for a scene that is rigid already. The
    scene is then as it was.
    """
    if any(isinstance(e, ContactDynamicsEngine) and not e.dead for e in O.engines):
        raise HardenError(
            "O.engines has a ContactDynamicsEngine, so the contacts are rigid already: call harden() once, on the soft scene"
        )
    if O.periodic:
        raise HardenError(
            "the cell is periodic, which rigid contacts are not yet: set O.periodic = False and bound the scene by walls"
        )
    bodies = [b for b in O.bodies if b is not None]
    clumps = [b.id for b in bodies if b.isClump or b.isClumpMember]
    if clumps:
        raise HardenError(
            f"body #{clumps[0]} belongs to a clump ({len(clumps)} such bodies), and clumps are not rigid bodies here yet: use single spheres"
        )
    loop = loop_of(O.engines)
    shapes = {type(b.shape) for b in bodies if b.shape is not None and b.bounded}
    moving = [b for b in bodies if isinstance(b.shape, Sphere) and b.dynamic]
    in_plane = bool(moving) and all(set(_PLANE) <= set(b.state.blockedDOFs) for b in moving)
    newton = newton_of(O.engines, bodies)
    refuse_wedged(bodies, moving)
    refuse_far_bonds(O.interactions, bodies, space.REACH)
    left, restitution = restitution == "damping", None if restitution == "damping" else restitution
    of_functors = restitution_of(loop.physDispatcher.functors) if restitution is None else restitution
    if left and of_functors is None:
        of_functors = restitution_of_damping(newton.damping)
    disk_radius = sum(b.shape.radius for b in moving) / len(moving) if in_plane else None
    diameter = 2 * sum(b.shape.radius for b in moving) / len(moving) if moving else None
    pairs = pairs_of(loop.physDispatcher.functors)
    materials, told = {}, []
    used = {b.material.id: b.material for b in bodies if b.material is not None}
    used |= {k: O.materials[k] for pair in pairs for k in pair if k not in used}  # of bodies that will come
    for soft in used.values():
        materials[soft], became = hard_material(soft, of_functors, disk_radius, diameter)
        if restitution is not None:
            materials[soft].restitution = restitution
        told.append((f"{type(soft).__name__} {soft.label!r}", f"NscdMat: {became}"))
    set_pairs(pairs, {soft.id: hard for soft, hard in materials.items()})
    told += [
        (f"materials #{one} with #{other}", ", ".join(f"{name} = {value:.3g}" for name, value in values.items()))
        for (one, other), values in sorted(pairs.items())
    ]
    soft_step = O.dt
    step = _step(O, bodies, moving) if step is None else soft_step if step == "soft" else step
    engines, rows = hard_engines(O.engines, shapes, in_plane, options)
    hear_energies()

    known = {soft.id: hard for soft, hard in materials.items()}
    of_bodies = [(body, known[body.material.id]) for body in bodies if body.material is not None]
    for hard in known.values():
        if hard.id < 0:
            O.materials.append(hard)
    for body, hard in of_bodies:
        body.material = hard
    O.interactions.clear()
    if any(m.tensileStrength > 0 for m in known.values()):
        engines.append(PyRunner(command=_BOND, nDo=1, iterPeriod=1, initRun=True))
        rows.append(
            (
                "cohesion of present contacts",
                "bonds where bodies are nearer than bondCreationDistance, made after the first step",
            )
        )
    if newton.mask > 0:  # the solver knows no mask: walls that it left out are put back, and drag as before
        command = belts.command_of([b for b in bodies if not b.dynamic and not b.mask & newton.mask])
        rows.append((f"NewtonIntegrator.mask = {newton.mask}", "mask = -1; walls outside of it stay, as belts"))
        if command:
            engines.append(PyRunner(command=command, iterPeriod=1, initRun=True))
        next(e for e in engines if isinstance(e, NewtonIntegrator) and not e.dead).mask = -1
    if steered := triaxial.controller_of(engines):
        triaxial.measure_often(steered, step / soft_step)
    O.engines = engines
    O.dt = step
    rows = told + rows + _keep_periods(engines, soft_step, step)
    rows.append((f"O.dt = {soft_step:.3g} s", f"O.dt = {step:.3g} s, {step / soft_step:.3g} times as long"))
    rows.append(("dimension", "the x-y plane" if in_plane else "space"))
    return Hardened(
        rows,
        soft_step,
        step,
        materials,
        functools.partial(_hard_alone, restitution=of_functors, disk_radius=disk_radius, diameter=diameter),
    )


def _hard_alone(soft, **options):
    return hard_material(soft, **options)[0]


def _step(O, bodies, moving):
    if any(type(e).__name__ in _SPRINGS and not e.dead for e in O.engines):
        return O.dt
    newton = newton_of(O.engines)
    places = np.array([b.state.pos for b in bodies if b.bounded], float).reshape(-1, 3)
    finite = places[np.all(np.isfinite(places), axis=1)]
    low, high = (finite.min(axis=0), finite.max(axis=0)) if len(finite) else (np.zeros(3), np.zeros(3))
    reach = float(np.linalg.norm(high - low))
    radii = [b.shape.radius for b in moving] or [r for e in O.engines for r in _coming(e)]
    speeds = [b.state.vel.norm() + (0 if b.dynamic else b.state.angVel.norm() * reach) for b in bodies]
    speeds += [
        abs(getattr(e, "angularVelocity", 0)) * reach
        + abs(getattr(e, "velocity", 0) if isinstance(getattr(e, "velocity", 0), (int, float)) else 0)
        for e in O.engines
        if not e.dead
    ]
    speeds += [e.vMax for e in O.engines if hasattr(e, "vMax") and not e.dead]
    if steered := triaxial.controller_of(O.engines):
        densities = [b.material.density for b in moving if b.material.density > 0]
        speeds.append(triaxial.speed_of(steered, min(densities, default=math.inf)))
    return hard_step(radii, speeds, newton.gravity, low, high, O.dt)


def _coming(engine):
    """Radii [m] of the spheres that an engine will make."""
    sizes = [0.5 * size for size in getattr(engine, "PSDsizes", ())]
    return [r for r in [*sizes, getattr(engine, "rMin", 0)] if r > 0]


def _keep_periods(engines, soft_step, step):
    """Engines that act every so many steps act after the same time as before."""
    rows = []
    for engine in engines:
        if isinstance(engine, PeriodicEngine) and engine.iterPeriod > 0:
            before, after = engine.iterPeriod, max(1, round(engine.iterPeriod * soft_step / step))
            if after == before:
                continue
            rows.append((f"{type(engine).__name__} every {before} steps", f"every {after} steps: after the same time"))
            engine.iterPeriod = after
    return rows
