"""A direct tension test as data: what is tested, and how; :mod:`tension` does it. Needs no YADE."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, replace

from ...errors import UserError
from ...model import materials, section
from ...records.columns import BONDS, LOSSES, STEP, TIME, Column, count, declared
from ...system import checks, keys
from . import pressing
from .biaxial_test import OF_SOLVER

__all__ = ["COLUMNS", "OF_RIGID", "STRONG", "TensionTest", "TensionTestError", "key_of"]

STRONG = 10.0  # tensile strength of grips and platens over that of the rock
GLUE = 0.15  # ℓ, the largest gap between a disk and a platen that is bonded
PRESSURE = 0.1  # of the bonds' tensile strength, under which a sample is bonded before its sides go

_MEANINGS = ("by sliding", "by rolling", "by impacts", "in bonds, by their opening")
#: Of a test's ``series.csv``, {name: Column}: stresses are means over the row's steps.
COLUMNS = declared(
    STEP,
    TIME,
    Column("strain", "1", "axial strain H/H₀ − 1, extension positive"),
    Column("opening_m", "m", "by how much the platens have drawn apart, H − H₀"),
    Column(
        "tension_top_Pa", "Pa", "force on the upper platen over the sample's width before the test, tension positive"
    ),
    Column("tension_bottom_Pa", "Pa", "the same of the lower platen"),
    Column("work_J", "J/m", "work of both platens since the begin"),
    *BONDS,
    count("contacts", "contacts, bonded ones included"),
    Column("speed_mean_m_per_s", "m/s", "mean speed of the disks"),
    Column("iterations_mean", "1", "sweeps of the contact solver in a step; not with soft contacts"),
    Column(
        "residual_worst", "1", "largest residual of the contact solver at the end of a step; not with soft contacts"
    ),
    count("unconverged", "steps of the row that missed the tolerance; not with soft contacts"),
    Column("overlap_worst_rel", "1", "largest overlap, in units of the mean diameter of the pair"),
    Column("energy_kinetic_J", "J/m", "kinetic energy, mean over the row; not with soft contacts"),
    *(
        Column(name, "J/m", f"dissipated {how}, since the begin; not with soft contacts")
        for name, how in zip(LOSSES, _MEANINGS)
    ),
)
#: Names of columns that only a test of rigid contacts has.
OF_RIGID = (*OF_SOLVER, *LOSSES)


class TensionTestError(UserError, ValueError):
    """A test that makes no sense; the message names what, its value and what would do."""

    __test__ = False  # no test of pytest's


@dataclass(frozen=True)
class TensionTest:
    """What determines a test. Lengths are in mean diameters d, the root of the mean square of the disks' diameters.

    ``inertia``: inertial number I of the loading, ε̇ t_i with t_i = √(m/σ_ext); ``step``: time step in t_i; ``grip``:
    thickness of the parts at the platens whose bonds are :data:`STRONG` times as strong [d], 0: none; ``fallen``: the
    test is over when the stress has fallen to this share of its peak, or at the ``opening`` [d] of the platens;
    ``adhesion_range``: largest gap over which the residual tensile strength acts, in ℓ.

    Raises TensionTestError for values that make no test, and for a material without bonds that bear tension.
    """

    material: section.Material
    shape: pressing.Shape
    inertia: float = 1e-5
    step: float = 0.1
    grip: float = 3.0
    fallen: float = 0.05
    opening: float = 0.2
    tolerance: float = 1e-5
    max_iterations: int = 300
    adhesion_range: float = 1e-3

    def __post_init__(self):
        object.__setattr__(self, "material", materials.bare(self.material))
        m, wrong = self.material, TensionTestError
        if not isinstance(self.shape, pressing.Shape):
            raise wrong(f"shape {checks.shown(self.shape)}: give a pressing.Shape, as pressing.Shape(2000, seed=1)")
        if not (m.bonded and m.tensile_strength > 0 and min(m.bond_ellipse) > 0):
            raise wrong(
                f"material {m.name}: bonded {m.bonded}, tensile_strength {m.tensile_strength:g} Pa, bond_ellipse "
                f"{list(m.bond_ellipse)}: it bears no tension; give a material that is bonded, all of them above 0"
            )
        for name in ("inertia", "step", "tolerance"):
            checks.number(name, getattr(self, name), wrong, "give a number above 0", above=0)
        least = 2 * m.bond_ellipse[0]
        remedy = f"give mean diameters above {least:g}, in which bonds of twice the mean break"
        checks.number("opening", self.opening, wrong, remedy, above=least)
        checks.number("fallen", self.fallen, wrong, "give a share of the peak between 0 and 1", above=0, below=1)
        checks.count("max_iterations", self.max_iterations, wrong, "give a whole number from 1")
        checks.number("adhesion_range", self.adhesion_range, wrong, "give a gap in mean diameters, 0 or more", least=0)
        s = self.shape
        # what is left between the grips is as high as two of them, or more
        most = 0.25 * math.sqrt(s.count * s.aspect * math.pi / 4 / s.fraction)
        remedy = f"give mean diameters from 0 to {most:.3g}, a quarter of the sample's height"
        checks.number("grip", self.grip, wrong, remedy, least=0, most=most)

    @classmethod
    def of(cls, plain):
        """From the plain data that `asdict` makes of a test."""
        plain = dict(plain)
        return cls(material=materials.of(plain.pop("material")), shape=pressing.Shape(**plain.pop("shape")), **plain)

    @property
    def diameter(self):
        """The mean diameter d [m]."""
        return math.sqrt(self.shape.mean_square)

    @property
    def yielding(self):
        """Opening in which a bond of the mean diameter yields until it breaks [m]: the half-axis of its ellipse."""
        return self.material.bond_ellipse[0] * self.diameter

    @property
    def pressure(self):
        """The pressure [Pa] under which the sample is bonded."""
        return PRESSURE * self.material.tensile_strength

    @property
    def grips(self):
        """(thickness [m], section.Material) of the grips, None for none."""
        strong = replace(self.material, name="grip", tensile_strength=STRONG * self.material.tensile_strength)
        return (self.grip * self.diameter, strong) if self.grip > 0 else None

    @property
    def platen(self):
        """Material of the platens, which are glued on."""
        m = self.material
        return replace(m, name="platen", tensile_strength=STRONG * m.tensile_strength, bond_creation_distance=GLUE)


def key_of(test):
    """What a checkpoint and the test that goes on from it must agree on."""
    return keys.key_of(asdict(test))
