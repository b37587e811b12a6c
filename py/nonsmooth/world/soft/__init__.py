"""A Contact Dynamics material as YADE's own soft contact models have it: hard against soft, with equivalent
parameters::

    rock = section.load("jiufengershan").materials["rock"]
    e = soft.equivalent(rock, stiffness=1e9, model="cohesion_moment", diameter=(1.0, 2.0))
    O.materials.append(soft.material(e))
    ...                                  # disks by scene.disk, walls by scene.segments with soft.wall_material(...)
    O.engines, O.dt = soft.engines(e), 0.5 * e.step_limit
    soft.bond(e)
    print(soft.describe(e))

* :mod:`parameters`: the parameters of the soft model, and the largest time step;
* :mod:`description`: these as a table, and what is lost;
* :mod:`reverse`: the material of a soft material or bond, where there is one;
* :mod:`functors`: materials and engines of a scene;
* :mod:`measures`: speeds, overlaps and broken bonds of a scene, under the names of ContactDynamicsEngine;
* :mod:`bonds`: bonds with thresholds set contact by contact, and residual strengths.

The first three need no running simulation.
"""

import importlib

from .description import describe
from .parameters import MODELS, Equivalent, SoftError, equivalent
from .reverse import material_of

__all__ = [
    "MODELS",
    "Equivalent",
    "SoftError",
    "bond",
    "bond_walls",
    "describe",
    "engines",
    "engines_of",
    "equivalent",
    "material",
    "material_of",
    "wall_material",
    "weaken",
]

_IN_YADE = {
    "bond": "bonds",
    "bond_walls": "bonds",
    "weaken": "bonds",
    "engines": "functors",
    "engines_of": "functors",
    "material": "functors",
    "wall_material": "functors",
}


def __getattr__(name):
    """What needs YADE is imported when it is asked for."""
    if name in _IN_YADE:
        return getattr(importlib.import_module(f"{__name__}.{_IN_YADE[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
