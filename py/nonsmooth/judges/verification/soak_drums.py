"""Drums for the soak: disks in a closed polygon, and spheres in a round mantle between two ends."""

from __future__ import annotations

import hashlib
import math
import random

import numpy as np

from yade import O, utils
from yade.wrapper import NewtonIntegrator, NscdMat, Sphere

from ...studies.spheres import walls
from ...world import scene, space

__all__ = ["GRAVITY", "KINDS", "STEP", "Drum"]

GRAVITY = 9.81  # m/s²
STEP = 5e-3  # s
SIDES = 60  # of the polygon
PITCH = 1.22  # m, of the lattice on which grains hang to begin with; wider than the widest
LENGTH = 6.0  # m, of the drum of spheres


class Drum:
    """What a soak asks of a drum; ``radius`` [m]."""

    def __init__(self, radius, axis):
        self.radius = radius
        self._axis = axis
        self.engine = scene.contact_dynamics()
        self._newton = next(e for e in O.engines if isinstance(e, NewtonIntegrator))
        self._grains = [b.id for b in O.bodies if isinstance(b.shape, Sphere)]

    def turn_to(self, angle):
        """Turns gravity by an angle [rad] from the vertical, which is the second coordinate across the axis."""
        across = [-GRAVITY * math.sin(angle), -GRAVITY * math.cos(angle)]
        across.insert(self._axis, 0)
        self._newton.gravity = across

    def _places(self):
        return np.array([O.bodies[k].state.pos for k in self._grains])

    def inside(self):
        """How many grains are in the drum."""
        across = np.delete(self._places(), self._axis, axis=1)
        return int((np.hypot(*across.T) < self.radius).sum())


class _DiskDrum(Drum):
    def checksum(self):
        """Of all bodies and contacts to the last bit, these in the order of ids."""
        contacts = np.frombuffer(self.engine.contactTable()).reshape(-1, 12)
        order = np.lexsort((contacts[:, :2].max(axis=1), contacts[:, :2].min(axis=1)))
        return hashlib.sha256(self.engine.bodyTable() + contacts[order].tobytes()).hexdigest()


class _SphereDrum(Drum):
    def inside(self):
        """How many grains are in the drum, and between its ends."""
        along = np.abs(self._places()[:, self._axis])
        return min(super().inside(), int((along < 0.5 * LENGTH).sum()))

    def checksum(self):
        """Of all bodies and contacts to the last bit, these in the order of ids."""
        states = (O.bodies[k].state for k in self._grains)
        bodies = [(*s.pos, *s.vel, *s.ori, *s.angVel) for s in states]
        found = {}
        for i in O.interactions:
            if i.isReal:
                p = i.phys
                found[min(i.id1, i.id2), max(i.id1, i.id2)] = (
                    p.normal,
                    *p.shearForce,
                    *p.rollingTorque,
                    p.twistingTorque,
                )
        contacts = [(*pair, *found[pair]) for pair in sorted(found)]
        return hashlib.sha256(np.array(bodies).tobytes() + np.array(contacts).tobytes()).hexdigest()


def _material(**others):
    stuff = NscdMat(density=2500, frictionAngle=math.atan(0.5), **others)
    O.materials.append(stuff)
    return stuff


def _lattice(radius, margin, layers):
    """Places [m] across the axis, from below, and along it, in the order in which they are taken."""
    reach = int(radius / PITCH) + 1
    span = range(-reach, reach + 1)
    across = [(PITCH * a, PITCH * b) for a in span for b in span if math.hypot(PITCH * a, PITCH * b) < margin]
    return sorted(((x, y, z) for x, y in across for z in layers), key=lambda p: (p[1], p[0], p[2]))


def of_disks(count, seed):
    """A drum about z with ``count`` disks that hang in it on a wide lattice. Raises ValueError for too few."""
    O.reset()
    dice = random.Random(seed)
    radii = [dice.uniform(0.4, 0.6) for _ in range(count)]
    fraction, filled = 0.8, 0.5  # of the disks' area in what they take, about, and of that in the drum
    radius = math.sqrt(sum(r * r for r in radii) / (fraction * filled))
    stuff = _material(rollingFriction=0.05)
    corners = [(radius * math.cos(a), radius * math.sin(a)) for a in 2 * math.pi / SIDES * np.arange(SIDES)]
    O.bodies.append(scene.segments(corners, stuff, sense=1, closed=True))
    places = _lattice(radius, radius * math.cos(math.pi / SIDES) - 0.62, (0.0,))
    if len(places) < count:
        raise ValueError(f"{count} disks: only {len(places)} have a place in their drum to begin with; give 60 or more")
    O.bodies.append([scene.disk((x, y), r, stuff) for (x, y, _), r in zip(places, radii)])
    O.engines = scene.engines(gravity=(0, -GRAVITY, 0), reach=0.1)
    O.dt = STEP
    return _DiskDrum(radius, 2)


def of_spheres(count, seed):
    """A drum about y with ``count`` spheres that hang in it on a wide lattice; its ends are without friction."""
    O.reset()
    dice = random.Random(seed)
    radii = [dice.uniform(0.4, 0.6) for _ in range(count)]
    fraction, filled = 0.55, 0.35  # of volumes, as many as have a place to begin with
    radius = math.sqrt(4 / 3 * sum(r**3 for r in radii) / (fraction * filled * LENGTH))
    stuff = _material(rollingFriction=0.05, twistingFriction=0.05)
    ends = NscdMat(density=2500, frictionAngle=0)
    O.materials.append(ends)
    layers = [PITCH * (k - 1.5) for k in range(4)]
    while len(places := _lattice(radius, walls.inner(radius) - 0.62, layers)) < count:
        radius *= 1.02  # of few spheres most are near its walls
    half = 0.5 * LENGTH
    O.bodies.append([utils.facet(t, material=stuff) for t in walls.mantle(radius, -half, half, axis=1)])
    O.bodies.append([utils.wall(-s * half, axis=1, sense=s, material=ends) for s in (1, -1)])
    O.bodies.append([utils.sphere((x, y, z), r, material=stuff) for (x, z, y), r in zip(places, radii)])
    O.engines = space.engines(gravity=(0, 0, -GRAVITY))
    O.dt = STEP
    return _SphereDrum(radius, 1)


KINDS = {"disks": of_disks, "spheres": of_spheres}
