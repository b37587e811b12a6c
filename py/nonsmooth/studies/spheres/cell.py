"""The six plates around a sample of spheres without gravity: each stays, bears a pressure, or is driven. The same for
hard and for soft contacts.

The three low plates stay. A high one that bears a pressure is a body with a mass that is free along its normal: the
force σ A acts on it, and its motion is solved with the contacts, so nothing swings as where a velocity is set from the
force of the step before.
"""

from __future__ import annotations

import numpy as np

from yade import O

from ...world.stepping import advance

__all__ = ["FIRST_SPHERE", "PLATES", "Cell"]

#: Low and high ones of x, y and z, in the order of their ids.
PLATES = ("left", "right", "front", "back", "bottom", "top")
FIRST_SPHERE = len(PLATES)
FREE = ("yzXYZ", "xzXYZ", "xyXYZ")  # blocked DOFs of a plate that bears a pressure
HELD = "xyzXYZ"


class Cell:
    """The plates of :meth:`.triaxial.TriaxialTest.stand`, bodies 0 to 5 of the scene. ``pressure`` [Pa]: on those that
    are free.
    """

    def __init__(self, pressure):
        self.pressure = pressure
        self._pushes = np.zeros(3)  # N, on the high plates

    def high(self, axis):
        """State of the high plate across ``axis``."""
        return O.bodies[2 * axis + 1].state

    def free(self, axis, mass):
        """Lets the high plate across ``axis`` bear the pressure, as a body of ``mass`` [kg]."""
        state = self.high(axis)
        state.mass, state.blockedDOFs = mass, FREE[axis]

    def drive(self, axis, velocity):
        """Gives the high plate across ``axis`` a ``velocity`` [m/s] along it."""
        state = self.high(axis)
        state.blockedDOFs = HELD
        state.vel = tuple(velocity if k == axis else 0.0 for k in range(3))
        state.angVel = (0, 0, 0)

    def low(self):
        """Corner of the low plates [m], (3,)."""
        return np.array([O.bodies[2 * k].state.pos[k] + O.bodies[2 * k].shape.extents[k] for k in range(3)])

    def edges(self):
        """Distances of the plates' faces along x, y and z [m], (3,)."""
        high = np.array([self.high(k).pos[k] - O.bodies[2 * k + 1].shape.extents[k] for k in range(3)])
        return high - self.low()

    def areas(self):
        """Areas of the cell across x, y and z [m²], (3,)."""
        edges = self.edges()
        return np.prod(edges) / edges

    def advance(self, steps):
        """Makes ``steps`` steps under the pressure on the present areas."""
        areas = self.areas()
        for axis in range(3):
            free = self.high(axis).blockedDOFs == FREE[axis]
            self._pushes[axis] = self.pressure * areas[axis] if free else 0.0
            O.forces.setPermF(2 * axis + 1, tuple(-self._pushes[axis] if k == axis else 0.0 for k in range(3)))
        advance(steps, view=list(range(FIRST_SPHERE)))

    def stresses(self):
        """Stresses of the spheres on the plates in the last step [Pa], (6,) in the order of :data:`PLATES`; areas are
        those of its end.
        """
        found = np.empty(6)
        for axis in range(3):
            found[2 * axis] = -O.forces.f(2 * axis)[axis]
            # O.forces holds the push too
            found[2 * axis + 1] = O.forces.f(2 * axis + 1)[axis] + self._pushes[axis]
        return found / np.repeat(self.areas(), 2)
