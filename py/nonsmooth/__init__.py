"""Contact Dynamics (Nonlinear Gauss-Seidel, Moreau-Jean) for YADE: sections, scenarios, measurements, figures.

Modules stand in rooms, each of which imports only from those above it (doc/house.rst). Scripts take what :data:`FACE`
names from here: ``from yade.nonsmooth import section``.
"""

import importlib
import importlib.abc
import importlib.util
import sys

from .system import requirements

requirements.watch()
# Outside YADE (tests of pure Python parts) there are no engines to ask for.
if __name__ == "yade.nonsmooth":
    from .system import plugin

    plugin.require()

#: What scripts and notebooks build on (doc/python.rst), and where it stands;
#: ``import yade.nonsmooth.laboratory.campaign`` works too.
FACE = {
    "section": "model.section",
    "section_parts": "model.section.parts",
    "section_values": "model.section.values",
    "similar": "model.section.similar",
    "ground_motion": "model.ground_motion",
    "newmark": "measure.newmark",
    "packing_files": "packing.files",
    "parameters": "system.parameters",
    "scene": "world.scene",
    "scene_arrays": "world.scene_arrays",
    "shaking": "world.shaking",
    "pore_pressure": "world.pore_pressure",
    "tables": "world.tables",
    "worlds": "world.worlds",
    "soft": "world.soft",
    "hardening": "world.hardening",
    "space": "world.space",
    "wall_forces": "world.wall_forces",
    "experiment": "studies.slope.experiment",
    "runs": "studies.runs",
    "run_figures": "studies.slope.run_figures",
    "laboratory": "studies.laboratory",
    "laboratory.materials": "model.materials",
    "heaps": "studies.heaps",
    "lessons": "studies.lessons",
    "video": "figures.video",
    "paraview": "figures.paraview",
    "servers": "running.servers",
}

__all__ = [
    *(name for name in FACE if "." not in name),
    "campaign",
    "contact",
    "errors",
    "figures",
    "harden",
    "records",
    "slip",
    "water",
]


class _Face(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Imports a module by the name that it has in :data:`FACE`: the same module, not a second one."""

    def find_spec(self, name, path=None, target=None):
        if not name.startswith(f"{__name__}."):  # of all that a process imports
            return None
        short = name.removeprefix(f"{__name__}.")
        first = max((one for one in FACE if f"{short}.".startswith(f"{one}.")), key=len, default=None)
        if first is None:
            return None
        real = f"{__name__}.{FACE[first]}{short[len(first):]}"
        if importlib.util.find_spec(real) is None:
            return None
        spec = importlib.util.spec_from_loader(name, self)
        spec.loader_state = real
        return spec

    def create_module(self, spec):
        module = importlib.import_module(spec.loader_state)
        spec.loader_state = module.__spec__
        return module

    def exec_module(self, module):
        """It has run; its own spec comes back."""
        module.__spec__ = module.__spec__.loader_state


sys.meta_path.insert(0, _Face())


def __getattr__(name):
    if name == "harden":  # a function of its own, which reads as the one line that it is
        return importlib.import_module(f"{__name__}.world.hardening").harden
    if name in __all__:
        return importlib.import_module(f"{__name__}.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__():
    return sorted([*__all__, "FACE"])
