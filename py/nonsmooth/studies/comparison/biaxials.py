"""The biaxial test in both worlds: the same pressed sample, platens, membrane and rate
(:mod:`yade.nonsmooth.laboratory.biaxial`).
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import asdict

import numpy as np

from ... import records
from ...measure import strength
from ...model import materials
from ...system import cache
from ...world import worlds
from ..laboratory import biaxial, pressing
from .cases import Case, CaseError
from .outcomes import Cost, Outcome, Quantity
from .slopes import forces_of

__all__ = ["CURVES", "DEFAULT_STIFFNESSES", "KEYS", "QUANTITIES", "disks_of", "measure", "prepare", "run", "test_of"]

NAME, TITLE = "biaxial", "Biaxial test"
SOURCE, DISKS = "wwr", 1000
#: Young's moduli [Pa]: with stresses of some MPa, contacts overlap by a tenth at the softest; one more decade would
#: cost as much as all others together.
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


def test_of(case: Case) -> biaxial.BiaxialTest:
    """The laboratory's test of a case; for a hard run with its step and tolerance.

    Raises CaseError for a strain that gives no strengths, SectionError for a material that cannot be used.
    """
    o, standard = case.options, {f.name: f.default for f in dataclasses.fields(biaxial.BiaxialTest)}
    strain = o.get("strain", STRAIN)
    if not strength.SHORTEST <= strain < 1:
        raise CaseError(
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
    return biaxial.BiaxialTest(
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
    pressing.prepare(test_of(case).shape, cache.folder("samples") / f"pressing-{case.disks}-{case.seed}")


def run(folder, **plain):
    """Runs a case in the (empty) scene, its records below ``folder``; returns numbers of the course."""
    case = Case(**plain)
    test = test_of(case)
    if case.world == "hard":
        return biaxial.run(folder, **asdict(test))
    world = worlds.Soft(
        case.stiffness,
        pressing.load(test.shape).diameters,
        model=case.model,
        damping=case.damping,
        step_share=case.step,
        verlet=0.1 * test.shape.d_min,
        fragile=case.fragile,
    )
    return biaxial.run(folder, world, **asdict(test))


def measure(case: Case, folder, found) -> Outcome:
    """What the records of a finished test say; tests are compared along their strain.

    Raises CaseError for a test that was kept without the wall time of its steps.
    """
    if "wall_steps_s" not in found:  # as of versions that counted rows and snapshots of hard tests as well
        raise CaseError(
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
