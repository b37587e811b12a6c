"""A rectangular sample of bonded disks between two platens and two sides, in the running scene.

The sample is packed just short of touching, uniform by volume as the slope is (Taboada and Estrada 2009, sections 3.2.2 and 5.1), pressed on
all sides without gravity and without friction until it carries the pressure, which gives the densest isotropic state that its packing allows, and then
bonded. All walls are rigid lines without friction meanwhile.

Times are counted in t_i = √(m/σ₃), with m the mean mass of a disk per metre and σ₃ the pressure: equal packings under different pressures then go
through the same states as long as bonds do not matter.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np

SIDES = ("bottom", "right", "top", "left")
FREE_STATES = {"right": "yzXYZ", "top": "xzXYZ"}  # blocked DOFs of a wall that follows the pressure
WALL_MASS = 0.02     # of the sample's mass, of a wall that follows the pressure
PRESS_STEP = 0.05    # t_i, time step of the compression
PRESS_RAMP = 400     # steps in which the pressure grows
REST_SPEED = 3e-4    # √(σ₃/ρ), mean speed at rest; loose disks without friction fly about for ever
REST_STRESS = 0.01   # σ₃, what the mean on each of the four walls may differ from it at rest ...
REST_STEPS = 40      # ... over about so many steps; the walls go on swinging a little
PRESS_LIMIT = 6000   # steps


class SampleError(RuntimeError):
    """A sample that cannot be made; the message says why and what helps."""


@dataclass(frozen=True)
class Shape:
    """A sample: about ``count`` disks of ``d_min`` to ``d_max`` [m], packed to ``fraction``, ``aspect`` times as high as wide."""

    count: int
    seed: int
    d_min: float = 1.0
    d_max: float = 4.0
    fraction: float = 0.848
    aspect: float = 2.0

    @property
    def mean_square(self):
        """Mean square of the diameters [m²] by number, uniform by volume."""
        return self.d_min * self.d_max

    def section(self):
        """A section with one layer, the sample: what `packing.pack` fills."""
        from .. import section

        shipped = section.load("jiufengershan")
        disks = section.Disks(self.d_min, self.d_max, "uniform_by_volume", self.fraction)
        width = math.sqrt(self.count * math.pi / 4 * self.mean_square / self.fraction / self.aspect)
        for _ in range(4):  # the packing is looser along its border, so the box is a little larger
            corners = ((0.0, 0.0), (width, 0.0), (width, self.aspect * width), (0.0, self.aspect * width))
            made = dataclasses.replace(shipped, layers=(section.Layer("sample", "rock", corners),), disks=disks, seed=self.seed, source="the sample")
            width *= math.sqrt(self.count / max(1, sum(made.disk_counts())))
        if width < 4 * self.d_max:
            raise SampleError(f"{self.count} disks of {self.d_min:g} to {self.d_max:g} m make a sample {width:.3g} m wide, "
                              f"{width / self.d_max:.2g} of the largest disks: ask for more disks, or a smaller aspect than {self.aspect:g}")
        return made


class Sample:
    """Handles of a sample that is in the scene: ids of its walls (a dictionary by SIDES), of its first disk, and the number of disks."""

    def __init__(self, walls, first_disk, count):
        from yade import O

        from .. import scene

        self.scene, self.engine = O, scene.contact_dynamics()
        self.walls, self.first_disk, self.count = walls, first_disk, count
        self.pressure = 0.0

    # ---- making ---------------------------------------------------------------------------------
    @classmethod
    def build(cls, shape, rock, platen, tolerance, max_iterations):
        """Fills the (empty) scene. ``rock``, ``platen``: section.Material of disks and of platens; sides have no friction."""
        from yade import O

        from .. import packing, scene

        made = packing.cached_pack(shape.section())
        O.reset()
        stuff, rough, smooth = material_of(rock), material_of(platen, wall=True), material_of(platen, wall=True)
        smooth.frictionAngle = smooth.residualFrictionAngle = smooth.rollingFriction = smooth.residualRollingFriction = 0.0
        O.materials.append((stuff, rough, smooth))
        corners = shape.section().layers[0].points
        width, height = corners[2]
        far = 3 * (width + height)
        lines = {"bottom": ((-far, 0), (far, 0)), "right": ((width, -far), (width, far)), "top": ((far, height), (-far, height)),
                 "left": ((0, far), (0, -far))}  # each with the disks on its left
        walls = {name: O.bodies.append(scene.segments(ends, rough if name in ("bottom", "top") else smooth, sense=1))[0]
                 for name, ends in lines.items()}
        order = np.argsort(made.y, kind="stable")  # neighbours in space are neighbours in memory
        ids = O.bodies.append([scene.disk((float(made.x[k]), float(made.y[k])), float(made.r[k]), stuff) for k in order])
        reach = max(0.2, 0.01 + rock.bond_creation_distance)
        O.engines = scene.engines(gravity=(0, 0, 0), reach=reach, verlet=0.1 * shape.d_min, tolerance=tolerance, maxIterations=max_iterations)
        return cls(walls, ids[0], len(ids))

    @property
    def mass(self):
        """Mean mass of a disk [kg/m]."""
        return self.scene.bodies[self.first_disk].material.density * float(np.mean(math.pi * self._radii() ** 2))

    def _radii(self):
        from .. import tables

        return tables.bodies(self.engine)["r"] if self.engine.steps else np.array(
            [self.scene.bodies[self.first_disk + k].shape.radius for k in range(self.count)])

    def press(self, pressure, friction=0.0):
        """Presses the sample on all sides with ``pressure`` [Pa] until it rests.

        ``friction``: of the disks' contacts meanwhile. Raises SampleError if it does not come to rest.
        """
        O = self.scene
        rock = O.bodies[self.first_disk].material
        usual = {name: getattr(rock, name) for name in ("frictionAngle", "residualFrictionAngle", "rollingFriction", "residualRollingFriction")}
        rock.frictionAngle = rock.residualFrictionAngle = math.atan(friction)
        rock.rollingFriction = rock.residualRollingFriction = 0.0
        strengths = rock.residualTensileStrength
        rock.residualTensileStrength = 0.0
        unit = math.sqrt(self.mass / pressure)
        O.dt = PRESS_STEP * unit
        # heavy at first, so that the walls do not knock; light at last, so that they follow
        for name in FREE_STATES:
            self.free(name, self.mass * self.count)
        slow, calm, begin, mean = REST_SPEED * math.sqrt(pressure / rock.density), False, O.iter, dict.fromkeys(SIDES, 0.0)
        while not calm:
            k = O.iter - begin
            self.pressure = pressure * min(1.0, max(1e-3, k / PRESS_RAMP) ** 2)
            if k == 2 * PRESS_RAMP:
                for name in FREE_STATES:
                    self.free(name, WALL_MASS * self.mass * self.count)
            self.step()
            for name, stress in self.stresses().items():
                mean[name] += (stress - mean[name]) / REST_STEPS
            calm = k > 2 * PRESS_RAMP + REST_STEPS and self.engine.meanSpeed < slow and all(abs(s / pressure - 1) < REST_STRESS for s in mean.values())
            if k > PRESS_LIMIT:
                raise SampleError(f"the sample does not come to rest under {pressure:g} Pa: mean speed {self.engine.meanSpeed:g} m/s, wanted {slow:g} m/s, "
                                  f"stresses {mean}; try another seed")
        for k in range(self.count):
            state = O.bodies[self.first_disk + k].state
            state.vel = state.angVel = (0, 0, 0)
        for name, value in usual.items():
            setattr(rock, name, value)
        rock.residualTensileStrength = strengths
        self.engine.updateStrengths()

    # ---- walls ----------------------------------------------------------------------------------
    def free(self, wall, mass):
        """Lets a wall of ``mass`` [kg] follow the pressure."""
        state = self.scene.bodies[self.walls[wall]].state
        state.mass = mass
        state.blockedDOFs = FREE_STATES[wall]

    def drive(self, wall, velocity):
        """Gives a wall its velocity [m/s], a pair."""
        state = self.scene.bodies[self.walls[wall]].state
        if state.blockedDOFs != "xyzXYZ":
            state.blockedDOFs = "xyzXYZ"
            self.scene.forces.setPermF(self.walls[wall], (0, 0, 0))
        state.vel = (*velocity, 0)

    def is_free(self, wall):
        return wall in self.walls and self.scene.bodies[self.walls[wall]].state.blockedDOFs != "xyzXYZ"

    def remove_sides(self):
        """Takes the two sides away; what holds the sample then is the caller's business."""
        for name in ("left", "right"):
            self.scene.bodies.erase(self.walls.pop(name))

    def place(self, wall):
        return self.scene.bodies[self.walls[wall]].state.pos

    def height(self):
        """Distance of the platens [m]."""
        return self.place("top")[1] - self.place("bottom")[1]

    def width(self):
        """Distance of the sides [m]."""
        return self.place("right")[0] - self.place("left")[0]

    def step(self):
        """One step, with the pressure on the walls that are free."""
        if self.is_free("right"):
            self.scene.forces.setPermF(self.walls["right"], (-self.pressure * self.height(), 0, 0))
        if self.is_free("top"):
            self.scene.forces.setPermF(self.walls["top"], (0, -self.pressure * self.width(), 0))
        self.scene.step()

    def wall_forces(self):
        """Force of the disks on each wall in the last step [N/m], positive outwards."""
        found = {}
        for name, sign, axis in (("bottom", -1, 1), ("top", 1, 1), ("left", -1, 0), ("right", 1, 0)):
            if name not in self.walls:
                continue
            force = sign * self.scene.forces.f(self.walls[name])[axis]
            if self.is_free(name):  # O.forces holds the pressure too
                force += self.pressure * (self.height() if axis == 0 else self.width())
            found[name] = force
        return found

    def stresses(self):
        """Pressure of the disks on each of the four walls in the last step [Pa]."""
        width, height = self.width(), self.height()
        return {name: force / (width if name in ("bottom", "top") else height) for name, force in self.wall_forces().items()}


def material_of(m, wall=False):
    """NscdMat of a section.Material; ``wall``: its strengths alone rule contacts with it."""
    from yade.wrapper import NscdMat

    return NscdMat(
        density=m.density or 2500.0, tensileStrength=m.tensile_strength, residualTensileStrength=m.residual_tensile_strength,
        frictionAngle=math.atan(m.friction), residualFrictionAngle=math.atan(m.residual_friction), rollingFriction=m.rolling_friction,
        residualRollingFriction=m.residual_rolling_friction, bondEllipseNormal=m.bond_ellipse[0], bondEllipseTangential=m.bond_ellipse[1],
        bondCreationDistance=m.bond_creation_distance, restitution=m.restitution, wall=wall, layer=-1 if wall else 0)
