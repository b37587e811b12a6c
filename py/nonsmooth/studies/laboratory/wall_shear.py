"""Sliding test of a packing on a wall: strength of the line that bounds a slope (Taboada and Estrada 2009, section 3.3,
Table 1).

A flat block of disks, bonded so strongly that it stays rigid, lies on a Segment wall of the material to be tested. A
plate that is glued on, and can only rise and sink, presses it down with the force σ L. The wall is then pulled along at
a slow constant speed v. With N and T the force of the block on the wall,

    σ = N/L,  τ = T/L,      τ = c + μ σ  (least squares over the pressures).

Expected, as all contacts slip at once: μ = μ_s, c = μ_s Σ F_a / L = μ_s σ_ext Σ ℓ / L over the disks that are bonded to
the wall; Σ ℓ / L, the share of the line that disks cover, is what makes the two adhesions "approximately equal" in a
dense packing.
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np

from ... import packing, records
from ...course import driver
from ...errors import UserError
from ...model import materials, section
from ...records.columns import STEP, Column, declared
from ...running import side_by_side
from ...running.kept_runs import Progress
from ...system import keys

__all__ = ["COLUMNS", "SlideError", "SlideResult", "SlideTest", "run", "run_one", "slide", "strength_of"]

BLOCK_STRENGTH = 1e9  # Pa, of the block's own bonds
BLOCK_BONDS = 0.15  # ℓ; a disk that the block does not hold could roll between it and the wall
SPEED = 0.1  # m/s
TIME_STEP = 2e-3  # s
PEAK_SLIP = 0.005  # m, slip until which the peak is looked for: a quarter of the smallest bond's ellipse
PLATE_MASS = 0.2  # of the block's
PRESSING = 150  # steps in which the pressure grows
LENGTH, HEIGHT = 50.0, 6.0  # mean diameters
TOLERANCE = 1e-4  # a bonded beam converges slowly


#: Of a slide's ``series.csv``, a row for each step of the slip: {name: Column}.
COLUMNS = declared(
    STEP,
    Column("slip_m", "m", "way of the wall since it was pulled"),
    Column("normal_Pa", "Pa", "normal stress of the block on the wall, its force over its length"),
    Column("shear_Pa", "Pa", "shear stress, positive against the wall's way"),
)


class SlideError(UserError, RuntimeError):
    """Slides that could not be run; the message says which and why."""


@dataclass(frozen=True)
class SlideTest:
    """What determines a slide: the wall's ``material``, the normal stress ``pressure`` [Pa], and the ``seed`` of the
    block, with disks of ``d_min`` to
    ``d_max`` [m]."""

    material: section.Material
    pressure: float
    seed: int = 1
    d_min: float = 1.0
    d_max: float = 4.0

    def __post_init__(self):
        object.__setattr__(self, "material", materials.bare(self.material))

    @property
    def name(self):
        """Name of its folder."""
        return f"{self.material.name}-{self.pressure / 1e6:g}MPa-seed{self.seed}"

    @property
    def extent(self):
        """Length and height of the block [m]."""
        d = math.sqrt(self.d_min * self.d_max)
        return LENGTH * d, HEIGHT * d

    @property
    def way(self):
        """Slip at the end [m]; over its second half, beyond twice the ellipse of the largest bond (0.02 d_max), the
        residual is taken.
        """
        return 0.08 * self.d_max

    def block(self):
        """A section with one layer, the block: what `packing.pack` fills."""
        fraction = section.load("jiufengershan").disks.packing_fraction
        disks = section.Disks(self.d_min, self.d_max, "uniform_by_volume", fraction)
        return section.block(*self.extent, disks=disks, seed=self.seed, source="the block")


@dataclass(frozen=True)
class SlideResult:
    """What a test found: stresses [Pa] at the peak and after slip, and the share of the wall that bonded disks
    cover.
    """

    normal_peak: float
    shear_peak: float
    normal_residual: float
    shear_residual: float
    coverage: float
    disks: int


def slide(test, record=lambda row: None):
    """Does a SlideTest; fills the scene anew. ``record``: called with a row of :data:`COLUMNS`, a dictionary, for each
    step of the slip. Returns a SlideResult.
    """
    from yade import O

    from ...world import scene
    from ...world.stepping import advance

    block, material, pressure, (width, height) = test.block(), test.material, test.pressure, test.extent
    rock, made = block.materials["rock"], packing.cached_pack(block)
    O.reset()
    strong = replace(
        rock,
        tensile_strength=BLOCK_STRENGTH,
        bond_creation_distance=BLOCK_BONDS,
        friction=1.0,
        residual_friction=1.0,
        rolling_friction=1.0,
        residual_rolling_friction=1.0,
    )
    stuff, wall = scene.material(strong), scene.material(material, wall=True, bondsToAll=material.bonded, layer=-1)
    glue = scene.material(strong, wall=True, bondsToAll=True, layer=-1)
    O.materials.append((stuff, wall, glue))
    base, plate = (
        O.bodies.append(scene.segments(ends, what, sense=1))[0]
        for ends, what in ((((-width, 0), (3 * width, 0)), wall), (((3 * width, height), (-width, height)), glue))
    )
    O.bodies.append(
        [
            scene.disk((float(made.x[k]), float(made.y[k])), float(made.r[k]), stuff)
            for k in np.argsort(made.x, kind="stable")
        ]
    )
    O.engines = scene.engines(
        gravity=(0, 0, 0), reach=0.2, verlet=0.1 * test.d_min, tolerance=TOLERANCE, maxIterations=1000
    )
    O.dt = TIME_STEP
    mass = rock.density * float(np.sum(math.pi * made.r**2))
    load, state = pressure * width, O.bodies[plate].state
    state.mass, state.blockedDOFs = PLATE_MASS * mass, "xzXYZ"

    def step(share):
        O.forces.setPermF(plate, (0, -share * load, 0))
        advance(1, view=[plate, base])

    engine = scene.contact_dynamics()
    advance()  # finds the contacts
    engine.bond()
    for k in range(PRESSING):
        step((k + 1) / PRESSING)
    engine.view()
    bonded = [2 * _radius(O, i, base) for i in O.interactions if base in (i.id1, i.id2) and i.isReal and i.phys.bonded]

    def pull(speed):
        O.bodies[base].state.vel = (speed, 0, 0)
        step(1.0)
        force = O.forces.f(base)
        return O.iter, speed * O.dt, -force[1], -force[0]

    course = _Pull(test.way, width, pull, record)
    driver.drive(course)
    stresses = (force / width for force in (*course.peak, *np.mean(course.late, axis=0)))
    return SlideResult(*stresses, float(sum(bonded)) / width, len(made))


class _Pull(driver.Course):
    """The slip of a block that is pressed, along a ``way`` on a ``width`` [m]. ``pull``: makes a step at a speed [m/s],
    and returns its number, its way, normal and shear force.
    """

    unsaved = "a slide"

    def __init__(self, way, width, pull, record):
        super().__init__()
        self.way, self.width, self.pull, self.record = way, width, pull, record
        self.pulled, self.peak, self.late = 0.0, (0.0, 0.0), []

    def _over(self):
        return self.pulled >= self.way

    def _steps(self):
        return self.pull(SPEED * min(1.0, self.pulled / 1e-3 + 0.05))

    def _look(self, made):
        step, way, normal, shear = made
        self.pulled, width = self.pulled + way, self.width
        self.record({"step": step, "slip_m": self.pulled, "normal_Pa": normal / width, "shear_Pa": shear / width})
        if self.pulled < PEAK_SLIP and shear > self.peak[1]:
            self.peak = (normal, shear)
        if self.pulled > 0.5 * self.way:
            self.late.append((normal, shear))


def _radius(O, interaction, wall):
    other = interaction.id2 if interaction.id1 == wall else interaction.id1
    return O.bodies[other].shape.radius


def run_one(folder, **plain):
    """Does the SlideTest given as plain data, writes its ``series.csv`` into the folder, and returns its SlideResult
    as a dictionary.
    """
    test, note, folder = (
        SlideTest(**{**plain, "material": materials.of(plain["material"])}),
        Progress(folder),
        Path(folder),
    )
    with records.SeriesWriter(folder / "series.csv", COLUMNS, overwrite=True) as series:

        def record(row):
            series.write(row)
            note(row["slip_m"] / test.way)

        return asdict(slide(test, record))


def run(tests, out, threads, resume=False, progress=lambda share, doing: None):
    """Does SlideTests, as many at a time as ``threads``, each in ``out/tests/NAME``; returns their Slides. ``resume``:
    keep those that have ended.

    ``progress``: called with the share done and what is being done. Raises SlideError before anything runs where two
    have one name, and with the first failure after the others have ended.
    """
    tests = list(tests)
    made = [
        side_by_side.Run(t.name, Path(out) / "tests" / t.name, run_one, asdict(t), keys.key_of(asdict(t)))
        for t in tests
    ]
    side_by_side.check(made, SlideError, "; give each seed once, and each wall, under a file name of its own")
    for seed in sorted({t.seed for t in tests}):
        progress(0.0, f"packing of seed {seed}")
        packing.cached_pack(next(t for t in tests if t.seed == seed).block())
    found = side_by_side.run(
        made,
        threads,
        resume,
        SlideError,
        progress=lambda share, ended: progress(share, f"{ended} of {len(made)} slides done"),
    )
    names = SlideResult.__dataclass_fields__
    return [SlideResult(**{name: one[name] for name in names}) for one in found]


def strength_of(tests, slides):
    """Friction and cohesion of a wall from the Slides of SlideTests of one material and one block: a dictionary for
    ``summary.json``.
    """
    found = {
        "material": tests[0].material.name,
        "seed": tests[0].seed,
        "pressures_Pa": [t.pressure for t in tests],
        "coverage": float(np.mean([s.coverage for s in slides])),
        "disks": slides[0].disks,
        "slides": [asdict(s) for s in slides],
    }
    for kind in ("peak", "residual"):
        normal, shear = (np.array([getattr(s, f"{what}_{kind}") for s in slides]) for what in ("normal", "shear"))
        slope, cohesion = np.polyfit(normal, shear, 1)
        found |= {
            f"friction_{kind}": float(slope),
            f"friction_{kind}_deg": math.degrees(math.atan(slope)),
            f"cohesion_{kind}_kPa": 1e-3 * float(cohesion),
            f"misfit_{kind}_rel": float(np.max(np.abs(slope * normal + cohesion - shear) / shear)),
        }
    return found
