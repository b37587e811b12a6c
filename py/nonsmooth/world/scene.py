"""YADE bodies and engines for rigid disks: what a script needs besides YADE's own classes. Materials with the strengths
of a section.Material come from :mod:`.world.materials`.
"""

from __future__ import annotations

import math

import numpy as np

from yade import O, utils
from yade.wrapper import (
    Arc,
    Body,
    Bo1_Arc_Aabb,
    Bo1_Segment_Aabb,
    Bo1_Sphere_Aabb,
    ContactDynamicsEngine,
    ForceResetter,
    Ig2_Arc_Sphere_ScGeom,
    Ig2_Segment_Sphere_ScGeom,
    Ig2_Sphere_Sphere_ScGeom,
    Ip2_NscdMat_NscdMat_NscdPhys,
    Law2_ScGeom_NscdPhys_SignoriniCoulomb,
    NscdInteractionLoop,
    Material,
    NewtonIntegrator,
    PlanarGridCollider,
    PlanarNewtonIntegrator,
    PlateLoadEngine,
    Segment,
    Sphere,
)
from yade.minieigenHP import Quaternion, Vector3

from ..model import geometry
from ..system import checks
from .error import SceneError
from .materials import material, set_strengths, wall_material

__all__ = [
    "SceneError",
    "arc",
    "contact_dynamics",
    "disk",
    "disks",
    "engines",
    "join",
    "material",
    "plate",
    "segments",
    "set_strengths",
    "wall_material",
]


_PLACE = "give (x, y) [m], finite numbers"


def disk(centre, radius, material, fixed=False, color=None):
    """A disk as a YADE Sphere body in the plane z = 0, not yet in the scene.

    ``centre``: (x, y) [m]; ``radius`` [m]; ``material``: an NscdMat, whose density [kg/m³] gives the mass ρ π r² and
    the inertia m r²/2 per metre of thickness; its friction angle is 0.5 rad unless it says otherwise. Where
    ``shape.radius`` is changed later, mass and inertia follow. ``fixed``: block all degrees of freedom.

    Raises SceneError, a ValueError, for a radius that is not positive and finite, for a centre without two finite
    numbers, for what is no material, and for a centre out of the plane, as a script with z up has it.
    """
    checks.numbers_of("disk, centre", centre, SceneError, _PLACE, 2, 3)
    checks.number(f"disk at {tuple(centre)}: radius", radius, SceneError, "give a positive radius [m]", above=0)
    if not callable(material):  # as YADE's own makers take it
        _material(material)
    if len(centre) > 2 and centre[2] != 0:
        raise ValueError(
            f"disk at {tuple(centre)}: disks lie in the plane z = 0, and y is up; give (x, y), from a script with z up its x and z"
        )
    body = utils.sphere((centre[0], centre[1], 0), radius, material=material, fixed=fixed, color=color)
    return _as_disk(body, "xyzXYZ" if fixed else "zXY")


def _as_disk(body, blocked):
    """Gives a sphere's body the mass and the inertia of a disk."""
    radius = body.shape.radius
    mass = body.material.density * math.pi * (radius * radius)  # pow() may round sizes 1:4 differently
    body.state.mass = mass
    body.state.inertia = Vector3(1, 1, 1) * (0.5 * mass * (radius * radius))
    body.state.blockedDOFs = blocked
    return body


def disks(spheres, material=None, fixed=False, color=None):
    """Disks in the plane z = 0, as :func:`disk` makes one, of what YADE's makers give; a list of bodies, not yet in the
    scene.

    ``spheres``: a SpherePack, filled by makeCloud or from a file; spheres' bodies, as pack.regularHexa,
    pack.regularOrtho and ymport.text give them; or rows (x, y, radius) or (x, y, z, radius) [m], a list or an array. Or
    ids, as SpherePack.toSimulation gives them, of spheres that are in the scene: these become disks where they are, and
    are not to be appended again. ``material``: an NscdMat; None: bodies keep theirs. ``fixed``: block all degrees of
    freedom; what a body has blocked stays blocked. ``color``: of all; None: bodies keep theirs, others get random ones.

    A cloud is flat where its corners have one z: ``makeCloud((0, 0, 0), (2, 1, 0), rMean=0.05)``. Raises ValueError for
    spheres that do not lie in one plane z = const, for clumps, for a radius that is not positive and where a material
    is missing; TypeError for what holds no spheres.
    """
    bodies = _spheres(spheres, material, color)
    bad = [k for k, b in enumerate(bodies) if not (b.shape.radius > 0 and all(map(math.isfinite, b.state.pos)))]
    if bad:
        b = bodies[bad[0]]
        raise ValueError(
            f"sphere {bad[0]} has the radius {b.shape.radius:g} m and stands at {tuple(b.state.pos)}: give a positive radius and a finite place"
        )
    if any(b.isClump or b.isClumpMember for b in bodies):
        raise ValueError("the spheres are in clumps, which the engines do not know: bond disks instead")
    heights = [b.state.pos[2] for b in bodies]
    if bodies and max(heights) - min(heights) > 1e-6 * min(b.shape.radius for b in bodies):
        raise ValueError(
            f"the spheres do not lie in one plane: z is from {min(heights):g} to {max(heights):g} m. Disks lie in the x-y plane: make one layer "
            "(makeCloud with one z in both corners), or choose one by z"
        )
    for b in bodies:
        if material is not None:
            b.material = _material(material)
        if color is not None:
            b.shape.color = color
        b.state.pos = b.state.refPos = Vector3(b.state.pos[0], b.state.pos[1], 0)
        _as_disk(b, "xyzXYZ" if fixed else "".join(k for k in "xyzXYZ" if k in b.state.blockedDOFs or k in "zXY"))
    return bodies


_SPHERES = "give a SpherePack, bodies of spheres, their ids, or rows (x, y, radius)"


def _spheres(spheres, material, color):
    """Spheres' bodies of what :func:`disks` takes."""
    if hasattr(spheres, "toSimulation"):  # a SpherePack, whose rows of a clump have its number behind
        rows = list(spheres)
        if any(len(row) > 2 and row[2] >= 0 for row in rows):
            raise ValueError("the spheres are in clumps, which the engines do not know: bond disks instead")
        found = [(*row[0], row[1]) for row in rows]
    else:
        try:
            found = list(spheres)
        except TypeError:
            raise TypeError(f"spheres {checks.shown(spheres)}: {_SPHERES}") from None
    if found and all(isinstance(one, Body) for one in found):
        strange = [one for one in found if not isinstance(one.shape, Sphere)]
        if strange:
            raise TypeError(f"a body has a {type(strange[0].shape).__name__}: only spheres become disks")
        return found
    if found and all(isinstance(one, (int, np.integer)) for one in found):
        for i in found:
            if not (0 <= i < len(O.bodies) and O.bodies[int(i)] is not None):
                raise SceneError(f"spheres, id {i}: there is no such body in the scene; {_SPHERES}")
        return _spheres([O.bodies[int(i)] for i in found], material, color)
    try:
        table = np.array(found, float).reshape(len(found), -1)
    except (TypeError, ValueError):
        table = np.zeros((len(found), 0))
    if found and table.shape[1] not in (3, 4):
        raise TypeError(f"{type(spheres).__name__} holds no spheres: {_SPHERES}")
    if found and material is None:
        raise ValueError("material = None: rows and packs of spheres have none, give an NscdMat")
    places = [((x, y, *(z or (0,))), r) for x, y, *z, r in table]
    return [utils.sphere(place, r, material=material, color=color) for place, r in places]


def _check_length(name, value):
    if value is not None:
        checks.number(f"{name} =", value, SceneError, "give a positive length [m]", above=0)


def segments(vertices, material, piece=None, sense=0, closed=False, backwards=False):
    """Bodies of a wall along a polyline, fixed and not yet in the scene.

    ``vertices``: (n, 2) [m]. ``piece``: greatest length of a segment [m]; long oblique segments have large bounding
    boxes, so cut walls into pieces of some ten disk diameters. ``sense``: side that acts, see Segment.sense (+1: left
    of the direction of travel). Joints, of pieces and of corners, count as one wall: no doubled contact, no bump; so do
    those with walls of other calls, wherever ends meet (see Segment). ``backwards``: the list begins at the last
    vertex, and a corner belongs to the segment behind it, so that a mirrored wall has the mirrored bodies in the same
    order; not for a closed one. Raises ValueError for fewer than two vertices, one that is not finite or coincides with
    its neighbour, and for a ``piece`` or a ``sense`` that makes no sense.
    """
    _check_length("piece", piece)
    if not isinstance(sense, (int, np.integer)) or sense not in (-1, 0, 1):
        raise SceneError(
            f"sense = {checks.shown(sense)}: give +1 (the left of the way that vertices go acts), -1 (the right), or 0 (both)"
        )
    _material(material)
    try:
        points = [np.asarray(v, float) for v in vertices]
    except (TypeError, ValueError):
        raise SceneError(
            f"vertices {checks.shown(vertices)}: give a list of two or more (x, y) [m], finite numbers"
        ) from None
    if closed:
        points.append(points[0])
    if len(points) < 2:
        raise ValueError(f"a wall needs two vertices or more, not {len(points)}")
    for k, point in enumerate(points):
        if point.shape != (2,) or not np.all(np.isfinite(point)):
            raise ValueError(f"vertex {k} of a wall is {tuple(point)}: give two finite coordinates [m]")
    if backwards:
        points.reverse()
    cut = [points[0]]
    for a, b in zip(points[:-1], points[1:]):
        length = float(geometry.distance(*(b - a)))
        if not length > 0:
            raise ValueError(f"two neighbouring vertices of a wall coincide at ({a[0]:g}, {a[1]:g})")
        count = max(1, math.ceil(length / piece - 1e-9)) if piece else 1
        cut += [a + (b - a) * (k / count) for k in range(1, count + 1)]
    ends = [(b, a) if backwards else (a, b) for a, b in zip(cut[:-1], cut[1:])]
    angles = [math.atan2(b[1] - a[1], b[0] - a[0]) for a, b in ends]
    bodies = [
        _wall(Segment(halfLength=0.5 * float(geometry.distance(*(b - a))), sense=sense), 0.5 * (a + b), angle, material)
        for (a, b), angle in zip(ends, angles)
    ]
    for k in range(len(bodies) if closed else len(bodies) - 1):
        after = (k + 1) % len(bodies)
        turn = angles[after] - angles[k]
        join(bodies[k], bodies[after], Vector3(math.cos(turn), math.sin(turn), 0), backwards)
    return bodies


def arc(centre, radius, start, end, material, inside=True, piece=None):
    """Bodies of a wall along a circle, fixed and not yet in the scene: a bowl, a drum, a roller.

    ``centre``: (x, y) [m]; ``radius`` [m]; ``start``, ``end``: angles [rad] from the x axis, counter-clockwise from the
    one to the other; 2 π apart or more: the whole circle. ``inside``: the side that acts; False: the outside, None:
    both. ``piece``: greatest length of a piece [m], of some ten disk diameters where the arc is large beside many
    disks; None: one body. Each body's position is the circle's centre: set its angVel, or RotationEngine, and the wall
    turns in its place. Ends that meet segments or other arcs are joints, see Segment. Raises ValueError for a radius
    that is not positive, for an end that is not beyond the start, and for another ``inside``.
    """
    checks.numbers_of("arc, centre", centre, SceneError, _PLACE, 2, 3)
    checks.number("radius =", radius, SceneError, "give a positive length [m]", above=0)
    _check_length("piece", piece)
    for name, value in (("start", start), ("end", end)):
        checks.number(f"arc, {name}", value, SceneError, "give an angle [rad] from the x axis, counter-clockwise")
    if not (inside is None or isinstance(inside, (bool, np.bool_))):
        raise SceneError(
            f"inside {checks.shown(inside)}: give True (the inside acts), False (the outside) or None (both)"
        )
    _material(material)
    if not end > start:
        raise SceneError(
            f"an arc from start = {start:g} to end = {end:g} rad: give an end beyond the start, counter-clockwise"
        )
    opening = min(end - start, 2 * math.pi)
    count = max(1, math.ceil(radius * opening / piece - 1e-9)) if piece else 1
    sense = 0 if inside is None else 1 if inside else -1
    return [
        _wall(
            Arc(radius=radius, halfAngle=0.5 * opening / count, sense=sense),
            centre,
            start + (k + 0.5) * opening / count,
            material,
        )
        for k in range(count)
    ]


def _wall(shape, position, angle, material):
    body = Body()
    body.shape = shape
    body.state.pos = Vector3(position[0], position[1], 0)
    body.state.ori = Quaternion((0, 0, 1), angle)
    body.state.refPos, body.state.refOri = body.state.pos, body.state.ori
    body.state.blockedDOFs = "xyzXYZ"
    body.material = _material(material)
    return body


def _material(material):
    if isinstance(material, Material):
        return material
    try:
        return O.materials[material]
    except (KeyError, IndexError, TypeError):
        known = ", ".join(repr(m.label) for m in O.materials if m.label)
        raise SceneError(
            f"material {checks.shown(material)}: give a material, as NscdMat(...), or the label{f' ({known})' if known else ''} or number of one in O.materials"
        ) from None


@checks.takes(
    SceneError, **{name: checks.has("shape", "give a body, as segments(...) makes them") for name in ("one", "other")}
)
def join(one, other, along, backwards=False):
    """Makes two segments that meet count as one wall; ``one`` owns their corner. ``along``: the direction of ``other``
    in the frame of ``one``; ``backwards``: see :func:`segments`."""
    if backwards:
        one.shape.previousDirection, other.shape.hasNext = along, True
    else:
        one.shape.nextDirection, other.shape.hasPrevious = along, True


def engines(
    gravity=(0, -9.81, 0),
    reach=0.05,
    far=None,
    verlet=-0.2,
    before=(),
    after=(),
    label="contactDynamics",
    adhesion_range=1e-3,
    **options,
):
    """The list O.engines of a Contact Dynamics simulation.

    ``gravity`` [m/s²]; ``reach``: gap up to which contacts are known beforehand, in units of ℓ; ``far``: the same for
    disks that are fast enough to come so near in two steps, where that is more; ``verlet``: the collider's margin [m],
    negative: in smallest radii, which fits any size of disks; ``before``: engines that add forces, e.g.
    PorePressureEngine; ``after``: engines after the integrator; ``adhesion_range``: gap up to which the residual
    tensile strength acts, in units of ℓ; ``options``: attributes of ContactDynamicsEngine. Raises AttributeError for
    one that it has not.
    """
    checks.numbers_of("gravity", gravity, SceneError, "give (x, y, z) [m/s²], as (0, -9.81, 0)", 3, 3)
    checks.number("reach", reach, SceneError, "give a gap in mean diameters, 0 or more", least=0)
    if far is not None:
        checks.number("far", far, SceneError, "give a gap in mean diameters, 0 or more, or None", least=0)
    checks.number("verlet", verlet, SceneError, "give a margin [m], or below 0 a share of the smallest radius")
    checks.number("adhesion_range", adhesion_range, SceneError, "give a gap in mean diameters, 0 or more", least=0)
    solver = ContactDynamicsEngine(label=label, **options)
    far = max(reach, far or 0)
    sure = {"sureReach": reach} if far > reach else {}
    return [
        ForceResetter(),
        PlanarGridCollider(
            [Bo1_Sphere_Aabb(aabbEnlargeFactor=1 + far), Bo1_Segment_Aabb(), Bo1_Arc_Aabb()], verletDist=verlet, **sure
        ),
        NscdInteractionLoop(
            [
                Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1 + far),
                Ig2_Segment_Sphere_ScGeom(interactionDetectionFactor=1 + far),
                Ig2_Arc_Sphere_ScGeom(interactionDetectionFactor=1 + far),
            ],
            [Ip2_NscdMat_NscdMat_NscdPhys()],
            [Law2_ScGeom_NscdPhys_SignoriniCoulomb(reach=far, adhesionRange=adhesion_range)],
        ),
        *before,
        solver,
        PlanarNewtonIntegrator(damping=0, gravity=gravity),
        *after,
    ]


def plate(
    ends, material, force=0.0, stress=0.0, mass=None, direction=None, between=(), damping=0.0, weightless=True, label=""
):
    """A plate under a load, as a servo has it in other scripts: adds its body to O.bodies and the engine that loads it
    to O.engines; returns the engine, whose ``id`` is the body's.

    ``ends``: two points [m]; the plate acts on its left, as a segment with ``sense=1``, and is pushed there: from right
    to left for a lid. It moves along one direction, and does not turn. ``force`` [N] or ``stress`` [Pa], both per metre
    of thickness and free to change later (``engine.stress = 2e5``); the stress acts on the present width. ``mass``
    [kg]; None: ρ L²/10, a plate a tenth as thick as long. ``direction``: (x, y) of the way on which it is free and
    pushed; None: its normal. ``between``: ids of two walls at its sides, whose distance along the plate is its width;
    none: its own length is. ``damping``: [N s/m]; ``weightless``: the load is all that presses, and not the plate's
    weight as well; ``label``: of the engine. See PlateLoadEngine.

    Raises LookupError where O.engines has no integrator yet: set O.engines first; ValueError for a mass that is not
    positive, a direction without length and one that lies along the plate while a stress is given.
    """
    for name, value in (("force =", force), ("stress =", stress), ("damping =", damping)):
        checks.number(name, value, SceneError, "give a finite number")
    try:
        a, b = (np.array(checks.numbers_of("ends", end, SceneError, _PLACE, 2, 2)) for end in ends)
    except (TypeError, ValueError):
        raise SceneError(f"ends {checks.shown(ends)}: give two points (x, y) [m], finite numbers") from None
    (body,) = segments([a, b], material, sense=1)
    length = 2 * body.shape.halfLength
    normal = np.array([a[1] - b[1], b[0] - a[0]]) / length
    remedy = "give a direction in the x-y plane, (x, y)"
    way = (
        normal
        if direction is None
        else np.array(checks.numbers_of("direction =", direction, SceneError, remedy, 2, 3)[:2])
    )
    if not np.hypot(*way) > 0:
        raise ValueError(f"direction = {tuple(map(float, way))}: give a direction in the x-y plane, (x, y)")
    way = way / np.hypot(*way)
    if stress and abs(float(way @ normal)) < 1e-9:
        raise ValueError("a plate that moves along itself takes no stress: give a force, or another direction")
    mass = 0.1 * body.material.density * length * length if mass is None else mass
    checks.number("mass =", mass, SceneError, "give the plate a positive mass [kg]", above=0)
    place = _place_of_loads()
    body.state.mass = mass
    body.state.inertia = Vector3(1, 1, 1) * (mass * length * length / 12)
    axis = [k for k in (0, 1) if abs(way[1 - k]) < 1e-12]
    body.state.blockedDOFs = {0: "yzXYZ", 1: "xzXYZ"}[axis[0]] if axis else "zXYZ"
    engine = PlateLoadEngine(
        id=O.bodies.append(body),
        direction=Vector3(way[0], way[1], 0),
        force=force,
        stress=stress,
        between=list(between),
        damping=damping,
        weightless=weightless,
        origin=body.state.pos,
        label=label,
    )
    if not axis:
        rail = Body()
        rail.state.pos = rail.state.refPos = body.state.pos
        rail.state.blockedDOFs = "xyzXYZ"
        engine.rail = O.bodies.append(rail)
    O.engines = O.engines[:place] + [engine] + O.engines[place:]
    return engine


def _place_of_loads():
    """Where in O.engines an engine stands that adds forces."""
    for kind in (ContactDynamicsEngine, NewtonIntegrator):
        for k, engine in enumerate(O.engines):
            if isinstance(engine, kind):
                return k
    raise LookupError("O.engines has no integrator: set O.engines = engines(...) first, then make the plate")


def contact_dynamics():
    """The ContactDynamicsEngine in O.engines; raises LookupError where there is none."""
    for engine in O.engines:
        if isinstance(engine, ContactDynamicsEngine):
            return engine
    raise LookupError("O.engines has no ContactDynamicsEngine: set O.engines = engines(...) first")
