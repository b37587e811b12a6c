"""What laws of springs tell of their energies, in a scene whose contacts are rigid.

A script may ask the law that it once put into its loop. Of rigid contacts YADE would read numbers that they do not
have, and end the process. They hold no elastic energy; what they have dissipated is the solver's to tell.
"""

from __future__ import annotations

import functools

from yade import O, wrapper
from yade.wrapper import ContactDynamicsEngine, InteractionLoop, LawFunctor

__all__ = ["hear_energies"]

_ELASTIC = (
    "elasticEnergy",
    "normElastEnergy",
    "shearElastEnergy",
    "bendingElastEnergy",
    "twistElastEnergy",
    "totalElastEnergy",
    "adhesionEnergy",
)
_LOST = {
    "plasticDissipation": ("slidingLoss", "rollingLoss"),
    "normDampDissip": ("impactLoss",),
    "frictionDissipation": ("slidingLoss",),
    "normViscDissip": ("impactLoss",),
}
_heard = False


def hear_energies():
    """From now on such questions are answered for the contacts that the scene has."""
    global _heard
    if _heard:
        return
    _heard = True
    for name in dir(wrapper):
        kind = getattr(wrapper, name)
        if not (name.startswith("Law2_") and isinstance(kind, type) and issubclass(kind, LawFunctor)):
            continue
        for method in (*_ELASTIC, *_LOST):
            if callable(kind.__dict__.get(method)):
                setattr(kind, method, _answered(kind.__dict__[method], _LOST.get(method, ())))


def _answered(method, losses):
    @functools.wraps(method)
    def ask(law, *arguments):
        loops = [e for e in O.engines if isinstance(e, InteractionLoop)]
        if any(law == one for loop in loops for one in loop.lawDispatcher.functors):
            return method(law, *arguments)
        solvers = [e for e in O.engines if isinstance(e, ContactDynamicsEngine)]
        return float(sum(getattr(solver, name) for solver in solvers[:1] for name in losses))

    return ask
