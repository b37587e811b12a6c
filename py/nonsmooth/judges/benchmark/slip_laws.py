"""What slip laws add to a step: the moving slope, all walls of which find their friction in cells, beside the same with
a friction that is given, in turns from the same state.

The law is thermal pressurization that diffuses, with a zone so thick that friction stays what it is: both slopes do the
same, and only the work differs.
"""

from __future__ import annotations

import math

from yade import O
from yade.wrapper import NscdMat, SlipSurfaceMat, Sphere

from ...measure.statistics import spread
from ...slip.laws import SlipLaw
from ...studies.slope import states
from ...world.scene import contact_dynamics
from . import steps

__all__ = ["FRICTION", "measure"]

FRICTION = 0.4  # of all walls
PARAMETERS = {
    "friction": FRICTION,
    "thickness": 1e3,
    "heat_capacity": 2.85e6,
    "thermal_diffusivity": 1.45e-7,
    "hydraulic_diffusivity": 7e-8,
    "pressurization_coefficient": 6.7e4,
}


def _given():
    return NscdMat(density=2500, frictionAngle=math.atan(FRICTION), wall=True)


def _found():
    return SlipSurfaceMat(density=2500, law=SlipLaw("thermal_pressurization", **PARAMETERS))


def _on_walls(make):
    """Gives the walls of the scene materials that ``make`` makes, one for each that they had; returns these."""
    walls = [body for body in O.bodies if not isinstance(body.shape, Sphere)]
    had = [body.material.id for body in walls]
    made = {k: make() for k in dict.fromkeys(had)}
    O.materials.append(list(made.values()))
    for body, k in zip(walls, had):
        body.material = made[k]
    contact_dynamics().updateStrengths()
    return list(made.values())


def measure(folder, source, disks, count, turns):
    """Times ``count`` steps of the moving slope with each kind of walls, ``turns`` times each; a function for
    processes.call. Returns the medians of each turn [ms] as "given_ms" and "found_ms", "over_step", what is added to a
    step by one without (see statistics.spread), and the number of "cells".

    Raises states.BenchmarkError where the state is missing.
    """
    kinds = {"given": _given, "found": _found}
    took, cells = {name: [] for name in kinds}, 0
    for turn in range(turns):
        for name in list(kinds)[:: 1 if turn % 2 == 0 else -1]:
            states.load(source, disks, "moving")
            materials = _on_walls(kinds[name])
            took[name].append(steps.TimedSteps().run(count).summary()["step_ms"]["median"])
            if name == "found":
                cells = sum(one.cellCount() for one in materials)
    over = [found / given - 1 for found, given in zip(took["found"], took["given"])]
    return {**{f"{name}_ms": values for name, values in took.items()}, "over_step": spread(over), "cells": cells}
