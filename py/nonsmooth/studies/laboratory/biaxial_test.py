"""A biaxial test as data: what is tested, and how; :mod:`biaxial` does it. Needs no YADE."""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace

from ...model import materials, section
from ...records.columns import BONDS, STEP, TIME, Column, count, declared
from ...system import keys
from . import pressing

__all__ = ["COLUMNS", "CYCLE", "OF_SOLVER", "PHASES", "BiaxialTest", "Test", "key_of"]

CYCLE = "cycle"  # folder of the forces of rows by their steps, and in the end of those of PHASES
PHASES = ("begin", "peak", "end")  # of a cycle of stress

#: Of a test's ``series.csv``, {name: Column}: stresses are means over the row's steps.
COLUMNS = declared(
    STEP,
    TIME,
    Column("strain", "1", "axial strain 1 − H/H₀, compression positive"),
    Column("volumetric_strain", "1", "A/A₀ − 1, positive in dilation"),
    Column("sigma1_top_Pa", "Pa", "force on the upper platen over the sample's mean width (its area over its height)"),
    Column("sigma1_bottom_Pa", "Pa", "the same of the lower platen"),
    Column(
        "sigma3_left_Pa",
        "Pa",
        "stress on the left side; with flexible sides the pressure as it was set, which is what a membrane bears",
    ),
    Column("sigma3_right_Pa", "Pa", "the same of the right side"),
    Column("inertial_number", "1", "of the loading, the rate of the axial strain times √(m/σ₃)"),
    *BONDS,
    count("contacts", "contacts, bonded ones included"),
    Column("speed_mean_m_per_s", "m/s", "mean speed of the disks"),
    Column("iterations_mean", "1", "sweeps of the contact solver in a step; not with soft contacts"),
    Column(
        "residual_worst", "1", "largest residual of the contact solver at the end of a step; not with soft contacts"
    ),
    count("unconverged", "steps of the row that missed the tolerance; not with soft contacts"),
    Column("overlap_worst_rel", "1", "largest overlap, in units of the mean diameter of the pair"),
    Column(
        "energy_kinetic_J", "J/m", "kinetic energy, mean over the row; not with soft contacts, nor in earlier files"
    ),
)
#: Names of columns that only a test of rigid contacts has.
OF_SOLVER = ("iterations_mean", "residual_worst", "unconverged", "energy_kinetic_J")


@dataclass(frozen=True)
class BiaxialTest:
    """What determines a test. ``confining``: σ₃ [Pa]; ``strain``: at the end.

    ``platens``: "smooth", "rough" (friction and rolling friction of the rock, no bonds) or "glued" (bonded as the rock
    is); ``sides``: "rigid" or "flexible"; ``inertia``: inertial number I of the loading; ``step``: time step in t_i;
    ``adhesion_range``: largest gap over which the residual tensile strength acts, in ℓ; ``forces_from``: strain from
    which on the forces of each row are kept for the pictures of a cycle of stress (:mod:`.cycles`), of which three stay
    in the end; None: none.
    """

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


Test = BiaxialTest  # its name for scripts and notebooks


def key_of(test):
    """What a checkpoint and the test that goes on from it must agree on."""
    return keys.key_of(asdict(test))
