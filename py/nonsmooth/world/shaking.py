"""A scene under an earthquake: the engine that shakes it by a motion of the ground (doc/shaking)."""

from __future__ import annotations

from yade import O
from yade.wrapper import GroundMotionEngine

from ..errors import UserError
from ..model.ground_motion import GroundMotion
from ..system import checks

__all__ = ["ShakingError", "ground_motion"]


class ShakingError(UserError, ValueError):
    """A scene that cannot be shaken so."""


def ground_motion(motion, begin=None, walls=()) -> GroundMotionEngine:
    """The engine that shakes the scene by a GroundMotion (:mod:`~nonsmooth.model.ground_motion`); put it among the
    engines that add forces: ``scene.engines(before=[shaking.ground_motion(motion)])``, in a scene that is there before
    its ContactDynamicsEngine, or before the integrator of soft contacts.

    ``begin``: O.time [s] at which the record's time is 0, now unless given. ``walls``: ids of the bodies that move with
    the ground, all that the mass rests on; none: the frame moves instead, walls stay, and each free body bears
    −m times the ground's acceleration. Both give the same motion against the walls; walls that move have left their
    place by the motion's drift at the end.

    Raises ShakingError for what is no GroundMotion, no time, or no bodies of the scene.
    """
    if not isinstance(motion, GroundMotion):
        raise ShakingError(
            f"motion {checks.shown(motion)}: give a GroundMotion, as ground_motion.read(file) returns one"
        )
    remedy = "give a time [s], or none for now"
    begin = O.time if begin is None else checks.number("begin", begin, ShakingError, remedy)
    ids = [walls] if isinstance(walls, int) else list(walls)
    for one in ids:
        if not isinstance(one, int) or isinstance(one, bool) or not 0 <= one < len(O.bodies) or O.bodies[one] is None:
            raise ShakingError(
                f"walls has {checks.shown(one)}: give ids of bodies of the scene, as scene.segments has them appended"
            )
    return GroundMotionEngine(
        label="groundMotion",
        times=motion.times.tolist(),
        horizontal=motion.horizontal.tolist() if motion.horizontal.any() else [],
        vertical=motion.vertical.tolist() if motion.vertical.any() else [],
        begin=begin,
        ids=ids,
    )
