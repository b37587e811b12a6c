"""A biaxial test as data: what is tested, and how; :mod:`biaxial` does it. Needs no YADE."""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace

from ...model import materials, section
from ...system import keys
from . import pressing

__all__ = ["CYCLE", "PHASES", "Test", "key_of"]

CYCLE = "cycle"  # folder of the forces of rows by their steps, and in the end of those of PHASES
PHASES = ("begin", "peak", "end")  # of a cycle of stress


@dataclass(frozen=True)
class Test:
    """What determines a test. ``confining``: σ₃ [Pa]; ``strain``: at the end.

    ``platens``: "smooth", "rough" (friction and rolling friction of the rock, no bonds) or "glued" (bonded as the rock is); ``sides``: "rigid" or
    "flexible"; ``inertia``: inertial number I of the loading; ``step``: time step in t_i; ``adhesion_range``: largest gap over which the
    residual tensile strength acts, in ℓ; ``forces_from``: strain from which on the forces of each row are kept for the pictures of a cycle of
    stress (:mod:`.cycles`), of which three stay in the end; None: none.
    """

    __test__ = False  # no test of pytest's

    material: section.Material
    confining: float
    shape: pressing.Shape
    strain: float = 0.1  # the plateau is the second half
    platens: str = "smooth"
    sides: str = "rigid"
    inertia: float = 1e-4
    step: float = 0.1
    tolerance: float = 1e-5
    max_iterations: int = 1000
    adhesion_range: float = 1e-3
    forces_from: float | None = None

    def __post_init__(self):
        object.__setattr__(self, "material", materials.bare(self.material))

    @classmethod
    def of(cls, plain):
        """From the plain data that `asdict` makes of a test."""
        plain = dict(plain)
        return cls(material=materials.of(plain.pop("material")), shape=pressing.Shape(**plain.pop("shape")), **plain)

    @property
    def platen(self):
        """Material of the platens."""
        if self.platens == "glued":
            return replace(self.material, name="platen", bonded=True)
        m = replace(self.material, name="platen", bonded=False, tensile_strength=0.0, residual_tensile_strength=0.0)
        return materials.smooth(m) if self.platens == "smooth" else m


def key_of(test):
    """What a checkpoint and the test that goes on from it must agree on."""
    return keys.key_of(asdict(test))
