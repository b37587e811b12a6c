"""The six walls of a TriaxialStressController with rigid contacts.

YADE's controller moves a wall by what its stress misses over the stiffness of its contacts, which rigid ones have not.
Here a wall under a stress is a plate that its force F presses: in each step h F/m is added to its velocity, up to the
speed v, which is the controller's max_vel, and the solver finds how far it comes. With the mass m = F h/v a wall that
nothing holds goes at v at once, and one that is held bears F exactly. Strains go at the controller's rate, as before.
The controller itself measures: it stands behind the integrator, where O.forces has what contacts bear. It sets the
velocities of walls under a stress to zero, so they are kept in the command of the runner that presses, which is saved
with the scene.
"""

from __future__ import annotations

import math

from yade import O
from yade.wrapper import NewtonIntegrator

__all__ = ["KINDS", "RECORDER", "commands", "controller_of", "hold", "measure_often", "press", "speed_of"]

KINDS = ("TriaxialStressController", "TriaxialCompressionEngine")
RECORDER = "TriaxialStateRecorder"
_SIDES = (("left", "right"), ("bottom", "top"), ("back", "front"))  # low and high along x, y and z
_HELD = "xyzXYZ"
_FREE = ("yzXYZ", "xzXYZ", "xyXYZ")
_LOADING = 3  # TriaxialCompressionEngine.currentState in which it moves top and bottom by their positions
_ROOM = "from yade.nonsmooth.world.hardening import triaxial as _t"
_LEAST = 1e-3  # of the largest stress: what the mass of a wall under less follows from


def controller_of(engines):
    """The controller that acts; None where there is none."""
    return next((e for e in engines if type(e).__name__ in KINDS and not e.dead), None)


def speed_of(controller, density):
    """The speed [m/s] by which a step is chosen: of a wall that nothing holds, or of a sphere of this ``density``
    [kg/m³] that the largest stress σ pushes over its diameter, √(σ/ρ).
    """
    goals = (controller.goal1, controller.goal2, controller.goal3)
    stresses = [goal for k, goal in enumerate(goals) if controller.stressMask >> k & 1]
    stresses += [getattr(controller, f"sigma{name}", 0) for name in ("IsoCompaction", "LateralConfinement")]
    return max(controller.max_vel, math.sqrt(max(map(abs, stresses)) / density))


def measure_often(controller, longer):
    """Lets a controller measure in every step, and look for rest after the same time; ``longer``: new step over old."""
    controller.computeStressStrainInterval = 1
    controller.strainDamping **= longer  # of the rate of strain, a step
    if hasattr(controller, "testEquilibriumInterval"):
        controller.testEquilibriumInterval = max(1, round(controller.testEquilibriumInterval / longer))


def commands(speed, last=(0.0,) * 6):
    """Commands of two PyRunners, one before the solver and one behind the integrator; ``speed``: max_vel [m/s],
    ``last``: velocities [m/s] inwards that walls under a stress had at the end of the last step.
    """
    return f"{_ROOM}; _t.press({speed!r}, {tuple(last)!r})", f"{_ROOM}; _t.hold({speed!r})"


def _tell(speed, last):
    """Writes the command that presses anew."""
    pressing, _ = commands(speed, last)
    for engine in O.engines:
        if getattr(engine, "command", "").startswith(f"{_ROOM}; _t.press("):
            engine.command = pressing


def _walls(controller):
    """(axis, direction inwards, body, whether it is steered) of the six walls."""
    for axis, sides in enumerate(_SIDES):
        for side, inward in zip(sides, (1, -1)):
            body = O.bodies[getattr(controller, f"wall_{side}_id")]
            yield axis, inward, body, getattr(controller, f"wall_{side}_activated")


def _edges(controller, walls):
    """Edges [m] of the box between the walls."""
    thickness = controller.thickness
    if thickness < 0:  # as the controller finds it in its first step
        thickness = 2 * O.bodies[controller.wall_bottom_id].shape.extents[1]
    places = {(axis, inward): body.state.pos[axis] for axis, inward, body, _ in walls}
    return [places[axis, -1] - places[axis, 1] - thickness for axis in range(3)]


def press(speed, last):
    """Frees the walls that are under a stress, with the velocity that their force gives them in the step; arguments as
    in :func:`commands`."""
    controller = controller_of(O.engines)
    if controller is None:
        return
    controller.internalCompaction = False
    walls = list(_walls(controller))
    edges, goals = _edges(controller, walls), (controller.goal1, controller.goal2, controller.goal3)
    gravity = next(e.gravity for e in O.engines if isinstance(e, NewtonIntegrator) and not e.dead)
    largest = max((abs(g) for k, g in enumerate(goals) if controller.stressMask >> k & 1), default=0)
    for (axis, inward, body, steered), before in zip(walls, last):
        state, goal = body.state, goals[axis]
        if not (controller.stressMask >> axis & 1 and steered and largest > 0):
            state.blockedDOFs = _HELD
            if axis == 1 and _drives(controller):  # it moves them by their positions, which the solver does not see
                state.vel = (0, inward * 0.5 * controller.currentStrainRate * edges[1], 0)
            continue
        area = edges[(axis + 1) % 3] * edges[(axis + 2) % 3]
        state.blockedDOFs = _FREE[axis]
        state.mass = max(abs(goal), _LEAST * largest) * area * O.dt / speed
        pressed = before - goal * area * O.dt / state.mass  # compression is negative
        velocity = [0.0, 0.0, 0.0]
        velocity[axis] = inward * max(-speed, min(speed, pressed)) - gravity[axis] * O.dt  # without the wall's weight
        state.vel = velocity


def _drives(controller):
    """Whether a controller moves top and bottom by their positions."""
    loading = getattr(controller, "currentState", None) == _LOADING
    return loading and abs(controller.epsilonMax) > abs(controller.strain[1])


def hold(speed):
    """Blocks the walls again, as the controller wants them, keeps their velocities, and takes back what it will move by
    itself.
    """
    controller = controller_of(O.engines)
    if controller is None:
        return
    last = []
    for axis, inward, body, _ in _walls(controller):
        state = body.state
        last.append(float(inward * state.vel[axis]) if state.blockedDOFs != _HELD else 0.0)
        state.blockedDOFs = _HELD
        if axis == 1 and _drives(controller):
            state.pos -= state.vel * O.dt
    _tell(speed, last)
