"""Any scene as it stands, as arrays, whoever made it. Reads YADE's objects by their attributes, and imports no YADE.

Disks are :class:`Sphere`; walls are Segment, Arc, Wall (along an axis), Box and Facet, seen along z. Contacts are hard
or soft; a force is that of the last step.
"""

from __future__ import annotations

import math
from dataclasses import MISSING, dataclass, fields

import numpy as np

from ..records import RecordsError
from ..system.whole_files import write_arrays

__all__ = ["Scene", "load", "read", "save"]

UNSET = (1.0, 1.0, 1.0)  # of a Sphere that nobody gave a colour


@dataclass(frozen=True, eq=False)
class Scene:
    """What is in a scene. Disks: ``x``, ``y``, ``r`` [m], ``material`` (order in which materials come), ``fixed``:
    arrays (n,). ``walls``: list of arrays (2, 2), lines from point to point; ``axes``: list of (0 or 1, place [m]),
    lines along y or x. Contacts: disks ``ci``, ``cj`` (negative: a wall), points ``cx``, ``cy`` [m], normal force
    ``cn`` [N], compression positive, ``bonded``: arrays (c,). ``colour``: (n, 3), the bodies' own as shares of red,
    green and blue; None where nobody has chosen them, see :func:`read`.
    """

    x: np.ndarray
    y: np.ndarray
    r: np.ndarray
    material: np.ndarray
    fixed: np.ndarray
    walls: list
    axes: list
    ci: np.ndarray
    cj: np.ndarray
    cx: np.ndarray
    cy: np.ndarray
    cn: np.ndarray
    bonded: np.ndarray
    colour: np.ndarray | None = None

    @property
    def nbytes(self):
        """Bytes of its arrays."""
        return sum(a.nbytes for a in vars(self).values() if isinstance(a, np.ndarray))


def read(O) -> Scene:
    """The scene in a YADE ``O``; a Scene as it is. Raises RecordsError where there is no disk in it.

    YADE gives each body a random colour where a script gives none. So colours count as chosen where disks share them:
    where there are half as many as disks, or fewer.
    """
    if isinstance(O, Scene):
        return O
    disks, walls, axes, order, kinds, colours = [], [], [], {}, {}, []
    for b in O.bodies:
        if b is None or b.shape is None:
            continue
        kind, (x, y) = type(b.shape).__name__, (b.state.pos[0], b.state.pos[1])
        if kind == "Sphere":
            order[b.id] = len(disks)
            colours.append(tuple(b.shape.color))
            disks.append(
                (
                    x,
                    y,
                    b.shape.radius,
                    kinds.setdefault(_id_of(b.material), len(kinds)),
                    "x" in b.state.blockedDOFs and "y" in b.state.blockedDOFs,
                )
            )
        elif kind == "Wall":
            axes += [(b.shape.axis, b.state.pos[b.shape.axis])] if b.shape.axis < 2 else []
        elif kind in ("Segment", "Arc", "Box", "Facet"):
            turn = b.state.ori.toRotationMatrix()
            corners = np.array(
                [
                    [x + sum(turn[0, k] * c[k] for k in range(3)), y + sum(turn[1, k] * c[k] for k in range(3))]
                    for c in _corners(kind, b.shape)
                ]
            )
            walls += [
                np.array([corners[k], corners[k - 1]]) for k in range(len(corners)) if kind in ("Box", "Facet") or k
            ]
    if not disks:
        raise RecordsError("there is no disk in the scene; draw it when its bodies have been appended")
    contacts = [one for i in O.interactions if i.isReal and (one := _contact(i, order))]
    x, y, r, material, fixed = (np.array(column) for column in zip(*disks))
    ci, cj, cx, cy, cn, bonded = (
        (np.array(column) for column in zip(*contacts))
        if contacts
        else (np.zeros(0, int), np.zeros(0, int), *np.zeros((3, 0)), np.zeros(0, bool))
    )
    own = np.clip(colours, 0, 1) if 2 * len(set(colours)) <= len(colours) and set(colours) != {UNSET} else None
    return Scene(
        x, y, r, material.astype(int), fixed.astype(bool), walls, axes, ci, cj, cx, cy, cn, bonded.astype(bool), own
    )


def save(scene, path):
    """Writes a Scene to a file, whole or not at all, which :func:`load` reads without YADE."""
    kept = {name: np.array(value) for name, value in vars(scene).items() if value is not None}
    write_arrays(path, compressed=True, **kept)


def load(path) -> Scene:
    """The Scene that :func:`save` wrote. Raises RecordsError for another file."""
    try:
        with np.load(path, allow_pickle=False) as data:
            found = {one.name: data[one.name] for one in fields(Scene) if one.default is MISSING or one.name in data}
    except (OSError, ValueError, KeyError) as error:
        raise RecordsError(f"{path}: is no scene that can be read ({error}); run the script again") from None
    found["axes"] = [(int(axis), float(at)) for axis, at in found["axes"]]
    return Scene(**found)


def _id_of(material):
    """What tells a material from others: its place in O.materials, or its name, where it was not appended there."""
    return None if material is None else (material.id, material.label)


def _corners(kind, shape):
    """Points of a wall's outline in its own frame."""
    if kind == "Segment":
        return [(-shape.halfLength, 0, 0), (shape.halfLength, 0, 0)]
    if kind == "Arc":  # chords of 3° or less
        count = max(1, math.ceil(2 * shape.halfAngle / math.radians(3)))
        angles = np.linspace(-shape.halfAngle, shape.halfAngle, count + 1)
        return [(shape.radius * math.cos(a), shape.radius * math.sin(a), 0.0) for a in angles]
    if kind == "Box":
        a, b = shape.extents[0], shape.extents[1]
        return [(-a, -b, 0), (a, -b, 0), (a, b, 0), (-a, b, 0)]
    return [tuple(v) for v in shape.vertices]


def _contact(i, order):
    """(disk, other disk or −1, point, force, whether bonded), None where no disk is in it."""
    if i.geom is None or i.phys is None or not hasattr(i.geom, "normal") or not hasattr(i.phys, "normalForce"):
        return None
    a, b = order.get(i.id1, -1), order.get(i.id2, -1)
    if a < 0:
        a, b = b, a
    if a < 0:
        return None
    bonded = (
        i.phys.bonded
        if hasattr(i.phys, "bonded")
        else not getattr(i.phys, "cohesionBroken", not getattr(i.phys, "isCohesive", False))
    )
    point = getattr(i.geom, "contactPoint", (0.0, 0.0))
    return a, b, point[0], point[1], sum(i.phys.normalForce[k] * i.geom.normal[k] for k in range(3)), bonded
