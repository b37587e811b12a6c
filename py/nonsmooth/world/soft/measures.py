"""What soft contacts tell of a scene, under the names that ContactDynamicsEngine has for it, so that one course of an
experiment serves both.
"""

from __future__ import annotations

import numpy as np

from yade import O
from yade.wrapper import CohFrictPhys, ContactDynamicsEngine, JCFpmPhys, NewtonIntegrator, WallPhys

from .. import tables
from .bonds import bonded, weaken

__all__ = ["Measures"]

#: A bond that was further from all of its thresholds than this share when it was last looked at counts as broken in
#: "mixed" mode: it is not known how.
LEAST_SHARE = 0.5
TENSION, SHEAR, TORQUE, MIXED = (tables.BREAK_MODES.index(name) for name in ("tension", "shear", "torque", "mixed"))


def _seen(name):
    return property(lambda self: self.look()[name])


class Measures:
    """Speeds, contacts, overlaps and broken bonds of a scene with soft contacts.

    ``world``: the :class:`yade.nonsmooth.worlds.Soft`; ``groups``: pairs (section.Material, ids of its disks), as
    :meth:`~yade.nonsmooth.worlds.Soft.bond` takes them. Make it once O.engines are set. Attributes have the names,
    units and meaning of ContactDynamicsEngine's; what follows from the state of the disks is that at the end of the
    last step. Overlaps are in units of the mean diameter of the pair, or of the disk's at a wall; ``contacts`` touch or
    bear a force.

    YADE does not tell how a bond broke. Here it is the threshold that the bond was nearest to when :meth:`look` last
    saw it whole, so look often; a bond that used less than :data:`LEAST_SHARE` of each is counted in ``brokenMixed``.
    """

    def __init__(self, world, groups=()):
        self.world, self.groups = world, list(groups)
        for e in O.engines:  # look() does its work
            if e.label == "softResidual":
                e.dead = True
        self._tables = ContactDynamicsEngine()  # its table of bodies needs no contacts of its own
        self._step = self._looked = None
        self._whole, self._loose, self._breaks, self._radii = {}, {}, [], {}
        self.broken = dict.fromkeys((TENSION, SHEAR, TORQUE, MIXED), 0)
        self._masses = {}
        self.overlapWorstEver = 0.0

    # ---- bonds ----------------------------------------------------------------------------------
    def bond(self):
        """Bonds the groups; returns how many bonds there are."""
        made = self.world.bond(self.groups)
        self._looked = None
        self.look()
        return made

    def forgetEnergies(self):
        """Nothing to forget: no energies are summed up here."""

    def forget_bodies(self, ids):
        """Bodies were erased, these ``ids``: their bonds are gone and have not broken."""
        gone = set(ids)
        self._whole = {pair: told for pair, told in self._whole.items() if gone.isdisjoint(pair)}
        self._step = None

    def look(self):
        """Looks at all contacts: which bonds broke since the last look, and how. Contacts without a bond get their
        residual strengths.

        Once a step at most; whoever asks for contacts, overlaps or bonds makes it look. Returns what it found by the
        names of the attributes.
        """
        if self._looked == O.iter:
            return self._found
        self._looked = O.iter
        whole, rows, loose, weakened, weak = {}, [], {}, [], self._loose
        overlap = worst = 0.0
        touching = 0
        for i in O.interactions:  # which leaves out those that are not real
            id1, id2, g, p = i.id1, i.id2, i.geom, i.phys
            normal, force, shear, point, depth = (
                g.normal,
                p.normalForce,
                p.shearForce,
                g.contactPoint,
                g.penetrationDepth,
            )
            nx, ny, x, y = normal[0], normal[1], point[0], point[1]
            n, t = force[0] * nx + force[1] * ny, shear[1] * nx - shear[0] * ny
            ids = (id1, id2) if id1 < id2 else (id2, id1)
            torque = (
                p.moment_bending[2]
                if isinstance(p, CohFrictPhys)
                else p.rollingTorque
                if isinstance(p, WallPhys)
                else 0.0
            )
            holds = bonded(p)
            if holds:
                whole[ids] = (_mode(p, n, abs(t), abs(torque)), x, y)
            else:
                made = loose[ids] = i.iterMadeReal
                if weak.get(ids) != made:  # not yet seen without a bond
                    weakened.append(i)
            rows.append((id1, id2, n, t, torque, nx, ny, -depth, holds, 0, x, y))
            if depth >= 0 or n != 0:
                touching += 1
                if depth > 0:
                    share = depth / self._length(ids)
                    overlap += share
                    worst = max(worst, share)
        weaken(weakened)
        self._loose = loose
        for ids, (mode, x, y) in self._whole.items():
            if ids not in whole:
                self.broken[mode] += 1
                self._breaks.append((O.iter, O.time, *ids, mode, x, y))
        self._whole, self._rows = whole, rows
        self.overlapWorstEver = max(self.overlapWorstEver, worst)
        self._found = {
            "contacts": touching,
            "bonds": len(whole),
            "overlapMean": overlap / touching if touching else 0.0,
            "overlapWorst": worst,
            "brokenTension": self.broken[TENSION],
            "brokenShear": self.broken[SHEAR],
            "brokenTorque": self.broken[TORQUE],
            "brokenMixed": self.broken[MIXED],
        }
        return self._found

    contacts, bonds, overlapMean, overlapWorst, brokenTension, brokenShear, brokenTorque, brokenMixed = map(
        _seen,
        (
            "contacts",
            "bonds",
            "overlapMean",
            "overlapWorst",
            "brokenTension",
            "brokenShear",
            "brokenTorque",
            "brokenMixed",
        ),
    )

    def _length(self, ids):
        """ℓ of a pair [m]: sum of the radii, or the diameter of a disk at a wall."""
        radii = [
            self._radii[k] if k in self._radii else self._radii.setdefault(k, getattr(O.bodies[k].shape, "radius", 0.0))
            for k in ids
        ]
        return radii[0] + radii[1] if radii[0] and radii[1] else 2 * max(radii)

    # ---- disks ----------------------------------------------------------------------------------
    @property
    def disks(self):
        """Table of the disks, see :func:`yade.nonsmooth.tables.bodies`, with ``mass`` [kg]; of the present step."""
        if self._step != O.iter:
            self._table = tables.bodies(self)
            ids = self._table["id"]
            if self._masses.get("id") is None or not np.array_equal(self._masses["id"], ids):
                states = [O.bodies[int(k)].state for k in ids]
                self._masses = {
                    "id": ids,
                    "mass": np.array([s.mass for s in states]),
                    "inertia": np.array([s.inertia[2] for s in states]),
                }
            self._table |= self._masses
            self._step = O.iter
        return self._table

    @property
    def _speeds(self):
        return np.hypot(self.disks["vx"], self.disks["vy"])

    meanSpeed = property(lambda self: float(self._speeds.mean()))
    maxSpeed = property(lambda self: float(self._speeds.max()))

    @property
    def centroid(self):
        """Centre of mass of the disks [m], as the engine's attribute of this name."""
        t = self.disks
        return tuple(float(np.average(t[axis], weights=t["mass"])) for axis in ("x", "y"))

    @property
    def kineticEnergy(self):
        """Kinetic energy of the disks [J/m], with that of their rotation."""
        t = self.disks
        return float(0.5 * np.sum(t["mass"] * self._speeds**2 + t["inertia"] * t["omega"] ** 2))

    @property
    def potentialEnergy(self):
        """Potential energy of the disks [J/m], 0 at the origin."""
        gravity = next(e.gravity for e in O.engines if isinstance(e, NewtonIntegrator))
        t = self.disks
        return -float(np.sum(t["mass"] * (t["x"] * gravity[0] + t["y"] * gravity[1])))

    # ---- tables ---------------------------------------------------------------------------------
    def bodyTable(self):
        """Table of the bodies, as ContactDynamicsEngine.bodyTable()."""
        return self._tables.bodyTable()

    def contactTable(self):
        """Table of the contacts, as ContactDynamicsEngine.contactTable()."""
        self.look()
        return np.array(self._rows, float).tobytes()

    def breakTable(self):
        """Table of broken bonds, as ContactDynamicsEngine.breakTable()."""
        self.look()
        return np.array(self._breaks, float).tobytes()


def _mode(p, normal, shear, torque):
    """Index of the BREAK_MODES that a bond is nearest to: where the force is the largest part of its threshold."""
    if isinstance(p, CohFrictPhys):
        held = max(normal, -p.normalAdhesion)
        parts = {
            TENSION: _share(-normal, p.normalAdhesion),
            SHEAR: _share(shear, p.shearAdhesion + held * p.tangensOfFrictionAngle),
            TORQUE: _share(torque, p.rollingAdhesion + held * p.maxRollPl),
        }
    elif isinstance(p, WallPhys):
        held = max(0.0, p.tensileForce + normal)
        parts = {
            TENSION: _share(-normal, p.tensileForce),
            SHEAR: _share(shear, p.friction * held),
            TORQUE: _share(torque, p.rollingArm * held),
        }
    elif isinstance(p, JCFpmPhys):
        parts = {TENSION: _share(-normal, p.FnMax), SHEAR: _share(shear, p.FsMax + normal * p.tanFrictionAngle)}
    else:
        return MIXED
    mode = max(parts, key=parts.get)
    return mode if parts[mode] >= LEAST_SHARE else MIXED


def _share(force, threshold):
    return force / threshold if threshold > 0 else float(force > 0) * 1e9
