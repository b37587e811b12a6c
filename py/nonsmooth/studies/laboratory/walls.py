"""Four straight walls around a sample without gravity: each stands, follows a pressure, or is driven."""

from __future__ import annotations

from yade import O

from ...world import scene
from ...world.stepping import advance

__all__ = ["SIDES", "Walls"]

SIDES = ("bottom", "right", "top", "left")
FREE_STATES = {"right": "yzXYZ", "top": "xzXYZ", "left": "yzXYZ"}  # blocked DOFs of a wall that follows the pressure
OUTWARDS = {"bottom": (1, -1), "right": (0, 1), "top": (1, 1), "left": (0, -1)}  # axis, sign


class Walls:
    """Handles of the walls: ``ids``, a dictionary by :data:`SIDES`; ``pressure`` [Pa] acts on those that are free."""

    def __init__(self, ids, pressure=0.0):
        self.ids, self.pressure = dict(ids), pressure
        self._pushes = {}  # N/m, what acts on the free walls in the present step

    @classmethod
    def around(cls, width, height, platen, side):
        """Adds the walls of a box with its corner at the origin; ``platen``: material of bottom and top, ``side``: of
        left and right, both in the scene.
        """
        far = 3 * (width + height)
        # each with the disks on its left
        lines = {
            "bottom": ((-far, 0), (far, 0)),
            "right": ((width, -far), (width, far)),
            "top": ((far, height), (-far, height)),
            "left": ((0, far), (0, -far)),
        }
        return cls(
            {
                name: O.bodies.append(scene.segments(ends, platen if name in ("bottom", "top") else side, sense=1))[0]
                for name, ends in lines.items()
            }
        )

    def state(self, wall):
        """The YADE State of a wall, by its name."""
        return O.bodies[self.ids[wall]].state

    def free(self, wall, mass):
        """Lets "right", "top" or "left" follow the pressure as a body of ``mass`` [kg/m]."""
        state = self.state(wall)
        state.mass = mass
        state.blockedDOFs = FREE_STATES[wall]

    def is_free(self, wall):
        """Whether a wall is there and follows a pressure."""
        return wall in self.ids and self.state(wall).blockedDOFs != "xyzXYZ"

    def drive(self, wall, velocity=(0, 0)):
        """Gives a wall its velocity [m/s], a pair."""
        state = self.state(wall)
        if state.blockedDOFs != "xyzXYZ":
            state.blockedDOFs = "xyzXYZ"
            O.forces.setPermF(self.ids[wall], (0, 0, 0))
            self._pushes.pop(wall, None)
        state.vel = (*velocity, 0)

    def remove(self, *names):
        """Takes walls away; what holds the sample then is the caller's business."""
        for name in names:
            O.bodies.erase(self.ids.pop(name))

    def place(self, wall):
        """Centre of a wall [m], a Vector3."""
        return self.state(wall).pos

    def lines(self):
        """Of each wall 0 where x, 1 where y is constant, and its value [m]: a list of pairs in the order of ``ids``."""
        return [(axis, self.place(wall)[axis]) for wall in self.ids for axis, _ in [OUTWARDS[wall]]]

    def height(self):
        """Distance of bottom and top [m]."""
        return self.place("top")[1] - self.place("bottom")[1]

    def width(self):
        """Distance of the sides [m]."""
        return self.place("right")[0] - self.place("left")[0]

    def step(self):
        """One step of the scene, with the pressure on the walls that are free. Of the bodies the walls alone are up to
        date after it, until the engine's ``view()``.
        """
        for wall in FREE_STATES:
            if self.is_free(wall):
                axis, sign = OUTWARDS[wall]
                self._pushes[wall] = push = self.pressure * (self.height() if axis == 0 else self.width())
                O.forces.setPermF(self.ids[wall], (-sign * push, 0, 0) if axis == 0 else (0, -sign * push, 0))
        advance(1, view=list(self.ids.values()))

    def forces(self):
        """Force of the disks on each wall in the last step [N/m], positive outwards."""
        found = {}
        for wall, i in self.ids.items():
            axis, sign = OUTWARDS[wall]
            found[wall] = sign * O.forces.f(i)[axis] + self._pushes.get(wall, 0.0)  # O.forces holds the push too
        return found

    def stresses(self):
        """Pressure of the disks on each of the four walls in the last step [Pa]; the lengths are those of the step's
        end.
        """
        width, height = self.width(), self.height()
        return {wall: force / (width if OUTWARDS[wall][0] == 1 else height) for wall, force in self.forces().items()}
