"""The biaxial test in both worlds: the same pressed sample, platens, membrane and rate (:mod:`yade.nonsmooth.laboratory.biaxial`)."""

from __future__ import annotations

import dataclasses
import math
import time
from dataclasses import asdict

import numpy as np

from .. import records
from ..kept_runs import Progress
from ..laboratory import biaxial, materials, pressing, strength
from ..packing_files import cache_folder
from .cases import Case, ComparisonError
from .outcomes import Cost, Outcome, Quantity
from .slopes import forces_of

__all__ = ["CURVES", "DEFAULT_STIFFNESSES", "KEYS", "QUANTITIES", "disks_of", "measure", "prepare", "run", "test_of"]

NAME, TITLE = "biaxial", "Biaxial test"
SOURCE, DISKS = "wwr", 1000
#: Young's moduli [Pa]: with stresses of some MPa, contacts overlap by a tenth at the softest; one more decade would cost as much as all others together.
DEFAULT_STIFFNESSES = (1e7, 1e8, 1e9, 1e10)
ENSEMBLE_STIFFNESS = 1e10  # Pa, for all seeds: below it the sample's elastic strain up to the peak is no longer small
CONFINING, STRAIN = 1e6, 0.06  # Pa; axial strain at the end, unless the case has others
KEYS = ("sigma1_peak_Pa", "sigma1_residual_Pa")
CURVES = {"stress": "σ₁ over σ₃", "volume": "volumetric strain"}
BONDS = True  # the kind of bonds matters
MOVING = False  # the mass has no stage of motion with a damping of its own
OVERLAP = (
    "Mean overlap of the contacts between disks that bear a force or a bond, in mean diameters of the pair, read from snapshots; a bond over a gap "
    "counts as 0."
)
OVERLAP_WHEN = ("before the test", "at its end")
COST_WHEN = "of the test"

QUANTITIES = (
    Quantity("sigma1_peak_Pa", "peak strength σ₁", "Pa"),
    Quantity("sigma1_residual_Pa", "residual strength σ₁", "Pa"),
    Quantity("strain_peak", "axial strain at the peak", "1"),
    Quantity("dilatancy_deg", "angle of dilatancy at the peak", "°"),
    Quantity("volumetric_strain_end", "volumetric strain in the end", "1"),
    Quantity("bonds_broken_share", "bonds broken, of those made", "1"),
)

RELAX_UNITS, REST_UNITS = 40.0, 20.0  # t_i in which the pressure grows on soft contacts, and for which it then rests
SWITCHES = 20  # times that the membrane is laid anew while the sample comes to rest in it
SAMPLES = 20  # of the forces on the walls, in a row of the series
SOFT_COLUMNS = tuple(
    name for name in biaxial.COLUMNS if name not in ("iterations_mean", "residual_worst", "unconverged")
)


def test_of(case: Case) -> biaxial.Test:
    """The laboratory's test of a case; for a hard run with its step and tolerance.

    Raises ComparisonError for a strain that gives no strengths, SectionError for a material that cannot be used.
    """
    o, standard = case.options, {f.name: f.default for f in dataclasses.fields(biaxial.Test)}
    strain = o.get("strain", STRAIN)
    if not strength.SHORTEST <= strain < 1:
        raise ComparisonError(
            f"--strain {strain:g}: give the axial strain at the end, from {strength.SHORTEST:g}, which has a peak and a plateau, to less than 1"
        )
    # pressed: soft contacts then begin without the work of bonds that were bent by the pressure
    shape = pressing.Shape(case.disks, case.seed, friction=0.0)
    numerics = (
        dict(step=standard["step"] * case.step, tolerance=standard["tolerance"] * case.tolerance)
        if case.world == "hard"
        else {}
    )
    platens = o.get("platens", standard["platens"])
    return biaxial.Test(
        materials.load(case.source),
        o.get("confining", CONFINING),
        shape,
        strain,
        platens,
        o.get("sides", standard["sides"]),
        o.get("inertia", standard["inertia"]),
        **numerics,
    )


def disks_of(case: Case):
    """Material of the disks, in a list, and their smallest and largest diameter [m]. Raises as :func:`test_of`."""
    test = test_of(case)
    return [test.material], (test.shape.d_min, test.shape.d_max)


def prepare(case: Case):
    """Presses the sample of a case, unless it is in the cache."""
    pressing.prepare(test_of(case).shape, cache_folder("samples") / f"pressing-{case.disks}-{case.seed}")


def run(folder, **plain):
    """Runs a case in the (empty) scene, its records below ``folder``; returns numbers of the course."""
    case = Case(**plain)
    test = test_of(case)
    if case.world == "hard":
        return biaxial.run(folder, **asdict(test))
    course, note = SoftCourse.begin_soft(test, folder, case), Progress(folder)
    course.run(note)
    from yade import O

    s = course.state
    return {
        "disks": s["disks"],
        "bonds": s["bonds"],
        "contacts": s["contacts"],
        "packing_fraction": s["fraction"],
        "rate_per_s": s["rate"],
        "time_step_s": O.dt,
        "steps": O.iter - s["begin"],
        "simulated_s": O.time - s["begin_time"],
        "wall_steps_s": s["wall_steps_s"],
        "overlap_worst_rel": course.sample.engine.overlapWorstEver,
    }


class _SoftSample:
    """As laboratory.sample.Sample, with Measures for an engine."""

    def __init__(self, engine, walls, first_disk, count):
        self.engine, self.walls, self.first_disk, self.count, self.bonds = engine, walls, first_disk, count, None

    @property
    def mass(self):
        """Mean mass of a disk [kg/m]."""
        return float(np.mean(self.engine.disks["mass"]))


class SoftCourse(biaxial.Course):
    """A test on soft contacts. Its step is that of its stiffness; forces on walls are means over :data:`SAMPLES` steps of a row."""

    columns = SOFT_COLUMNS

    @classmethod
    def begin_soft(cls, test, folder, case):
        """Puts the pressed sample into the scene; it takes up the pressure, comes to rest in its membrane, and is bonded.

        In the hard world bonds come before the membrane, where they do not feel the change.
        """
        from yade import O

        from .. import scene, worlds
        from ..laboratory.walls import Walls
        from ..soft.measures import Measures
        from ..stepping import advance

        shape, rock = test.shape, test.material
        pressed = pressing.load(shape)
        O.reset()
        world = worlds.Soft(
            case.stiffness,
            (2 * float(pressed.r.min()), 2 * float(pressed.r.max())),
            model=case.model,
            damping=case.damping,
            step_share=case.step,
            verlet=0.1 * shape.d_min,
            fragile=case.fragile,
        )
        smooth = dataclasses.replace(
            test.platen,
            name="side",
            bonded=False,
            tensile_strength=0.0,
            friction=0.0,
            residual_friction=0.0,
            rolling_friction=0.0,
            residual_rolling_friction=0.0,
        )
        stuff, rough, side = world.material(rock), world.wall_material(test.platen), world.wall_material(smooth)
        O.materials.append((stuff, rough, side))
        walls = Walls.around(pressed.width, pressed.height, rough, side)
        ids = O.bodies.append(
            [scene.disk((float(x), float(y)), float(r), stuff) for x, y, r in zip(pressed.x, pressed.y, pressed.r)]
        )
        O.engines = world.engines(gravity=(0, 0, 0))
        O.dt = world.step_for([rock])
        body = _SoftSample(Measures(world, [(rock, list(ids))]), walls, ids[0], len(ids))
        unit = math.sqrt(body.mass / test.confining)
        for name in ("right", "top"):
            walls.free(name, pressing.WALL_MASS * body.mass * body.count)
        ramp, steps = max(1, round(RELAX_UNITS * unit / O.dt)), round((RELAX_UNITS + REST_UNITS) * unit / O.dt)
        for k in range(steps):
            walls.pressure = test.confining * min(1.0, (k + 1) / ramp)
            walls.step()
        state = {"unit_s": unit, "rate": test.inertia / unit, "begin_time": O.time, "wall_s": 0.0, "wall_steps_s": 0.0}
        course = cls(test, folder, body, state)
        walls.drive("top")
        if test.sides == "flexible":
            # a membrane presses on other disks than a wall did: soft contacts feel a blow that would break bonds, so they are made when it has died away
            walls.remove("left", "right")
            for _ in range(SWITCHES):
                course._membrane()
                advance(max(1, round(REST_UNITS / SWITCHES * unit / O.dt)))
        body.bonds = body.engine.bond()
        height = walls.height()
        area = course._membrane() if test.sides == "flexible" else height * walls.width()
        if test.sides == "rigid" and test.platens != "smooth":
            walls.free("left", walls.state("right").mass)
        state |= {
            "height": height,
            "area": area,
            "bonds": body.bonds,
            "begin": O.iter,
            "begin_time": O.time,
            "disks": body.count,
            "contacts": body.engine.contacts,
            "fraction": float(np.sum(math.pi * pressed.r**2)) / area,
        }
        course.snapshot("begin")
        return course

    def run(self, progress=None):
        """Shears the sample to the end; ``progress``: called with the share done."""
        from yade import O

        s, test, walls = self.state, self.test, self.sample.walls
        per_row = max(SAMPLES, round(biaxial.ROW_STRAIN / (s["rate"] * O.dt)))
        parts = [len(p) for p in np.array_split(np.arange(per_row), SAMPLES)]
        while self.strain < test.strain - 1e-9:
            sums, began = {}, time.perf_counter()
            for part in parts:
                elapsed = (O.time - s["begin_time"]) * s["rate"]
                share = min(1.0, (elapsed + 0.5 * part * s["rate"] * O.dt) / (2 * biaxial.RAMP))
                walls.drive("top", (0, -share * s["rate"] * s["height"]))
                for _ in range(part):
                    walls.step()
                for name, force in walls.forces().items():
                    sums[name] = sums.get(name, 0.0) + force / SAMPLES
            s["wall_steps_s"] += time.perf_counter() - began
            area = self._membrane() if test.sides == "flexible" else walls.height() * walls.width()
            s["strain"] = self.strain
            self._row(sums, area, 0.0, 0.0, 0)
            if progress:
                progress(s["strain"] / test.strain)
        self.snapshot("end")
        self.series.close()


def measure(case: Case, folder, found) -> Outcome:
    """What the records of a finished test say; tests are compared along their strain.

    Raises ComparisonError for a test that was kept without the wall time of its steps.
    """
    if "wall_steps_s" not in found:  # as of versions that counted rows and snapshots of hard tests as well
        raise ComparisonError(
            f"{folder}: its result.json has no wall_steps_s, the wall time of steps alone; remove the folder and go on with --resume"
        )
    test = test_of(case)
    series = records.read_series(folder / "series.csv")
    c = strength.curve(series, (strength.PLATEAU * test.strain, test.strain))
    begins, stress = strength.running_mean(
        series["strain"], strength.axial_stress(series) / test.confining, strength.PEAK_WINDOW
    )
    strain = begins + strength.PEAK_WINDOW / 2
    volume = np.interp(strain, series["strain"], series["volumetric_strain"])
    broken = records.broken_bonds(series)
    values = {
        "sigma1_peak_Pa": c.peak,
        "sigma1_residual_Pa": c.residual,
        "strain_peak": c.peak_strain,
        "dilatancy_deg": c.dilatancy_deg if math.isfinite(c.dilatancy_deg) else None,
        "volumetric_strain_end": c.volumetric_end,
        "bonds_broken_share": broken / found["bonds"] if found["bonds"] else None,
    }
    begin, end = (records.read_snapshot(folder / "snapshots" / f"{name}.npz") for name in ("begin", "end"))
    return Outcome(
        case,
        values,
        {"abscissa": strain, "stress": stress, "volume": volume},
        series,
        None,
        None,
        forces_of(begin),
        overlap=_overlap(end),
        overlap_rest=_overlap(begin),
        cost=Cost(
            found["steps"],
            found["time_step_s"],
            found["wall_steps_s"],
            found["simulated_s"],
            found["wall_steps_s"] / found["simulated_s"],
        ),
    )


def _overlap(snapshot):
    """Mean overlap of the snapshot's contacts between disks [mean diameters]: those that bear a force or are bonded."""
    i, j = snapshot.ci[snapshot.cj >= 0], snapshot.cj[snapshot.cj >= 0]
    length = snapshot.r[i] + snapshot.r[j]
    gap = np.hypot(snapshot.x[i] - snapshot.x[j], snapshot.y[i] - snapshot.y[j]) - length
    return float(np.mean(np.maximum(-gap, 0) / length)) if len(i) else 0.0
