"""Contact Dynamics (Nonlinear Gauss-Seidel, Moreau-Jean) for YADE: sections, scenarios, measurements, figures."""

from . import requirements

requirements.watch()
# Outside YADE (tests of pure Python parts) there are no engines to ask for.
if __name__ == "yade.nonsmooth":
    from . import _plugin

    _plugin.require()
