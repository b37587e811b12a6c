"""Round column and triaxial test of :mod:`yade.nonsmooth.studies.spheres` in both worlds."""

from __future__ import annotations

import dataclasses

import numpy as np

from ... import records
from ...measure import sphere_heaps, strength, triaxial as measures
from ...system import checks
from ...world import sphere_worlds
from ..spheres import grains, study
from .cases import Case, CaseError
from .outcomes import Cost, Outcome, Quantity

__all__ = ["COLUMN", "TRIAXIAL", "SphereExperiment"]


class SphereExperiment:
    """A scenario of spheres in space. ``KIND``: of spheres.study.KINDS; Case.options are parameters of that scene, with
    σ₃ as ``confining``, and the size among them says how many spheres there are.
    """

    SOURCE, DISKS = "", None
    SPACE = True
    BONDS = MOVING = False
    SAME = {"confining": "pressure"}  # of options, and what the scene calls them
    OVERLAP = (
        f"Mean overlap of pairs with a gap below {100 * sphere_heaps.NEAR:g} % of their mean diameter, walls too, in mean diameters (the sphere's at a "
        "wall), from places alone; a pair with a gap counts as 0."
    )

    def __init__(self, run):
        self.run = run  # of this module, so that a process finds it by its name

    def scene(self, options, seed):
        """The scene. Raises CaseError for ``options`` that it has not, SpheresError for values that cannot be used."""
        kind = study.KINDS[self.KIND]
        given = {self.SAME.get(name, name): value for name, value in options.items()}
        known = [one.name for one in dataclasses.fields(kind) if one.name != "seed"]
        strange = [name for name in given if name not in known]
        if strange:
            raise CaseError(f"options {checks.shown(strange[0])}: {self.NAME} has {', '.join(known)}")
        return kind(seed=seed, **given)

    def count(self, options):
        """Number of spheres. Raises as :meth:`scene`."""
        return self.scene(options, 0).count()

    def check(self, case: Case):
        """Raises UserError for a case that would refuse once it runs."""
        study.planned(case.name, case.name, self.scene(case.options, case.seed), world_of(case))

    def ran(self, folder, case: Case):
        """Runs a case in the (empty) scene, its records below ``folder``; returns the numbers of the run."""
        scene = self.scene(case.options, case.seed)
        return study.one(folder, self.KIND, dataclasses.asdict(scene), world_of(case), None)

    def _outcome(self, case, found, values, curves, series, overlap, rest, notes=()):
        wall, simulated = found["wall_s"], found["time_s"]
        cost = Cost(found["steps"], found["time_step_s"], wall, simulated, wall / simulated)
        return Outcome(case, values, curves, series, None, None, {}, float(overlap), float(rest), cost, list(notes))


def world_of(case):
    """Arguments of spheres.grains.world_of for a Case."""
    if case.world == "soft":
        return {"name": "soft", "stiffness": case.stiffness, "damping": case.damping, "step_share": case.step}
    # a sphere must not go farther in a step than contacts are known beforehand
    return {
        "name": "hard",
        "path": grains.PATH_PER_STEP * case.step,
        "tolerance": grains.TOLERANCE * case.tolerance,
        "reach": sphere_worlds.HardSpheres.reach * max(1.0, case.step),
    }


class RoundColumns(SphereExperiment):
    """A round column that collapses."""

    KIND, NAME, TITLE = "column", "round-column", "Collapse of a round column of spheres"
    QUANTITIES = (
        Quantity("runout_rel", "runout (r∞ − r₀)/r₀", "1"),
        Quantity("final_height_rel", "height in the end, H∞/r₀", "1"),
        Quantity("runout_99_rel", "runout of 99 % of the mass", "1"),
        Quantity("repose_deg", "slope of the flank", "°"),
        Quantity("rest_s", "time from the release to rest", "s"),
    )
    KEYS = ("runout_rel", "final_height_rel")
    CURVES = {"front": "the edge's way", "centroid": "the centre of mass's way"}
    DEFAULT_STIFFNESSES = (1e6, 1e7, 1e8)  # Pa; the softest overlaps by 0.2 % at the bottom of the default column
    ENSEMBLE_STIFFNESS = 1e7  # Pa, for all seeds
    OVERLAP_WHEN = ("at rest in the tube", "while moving")
    COST_WHEN = "after the release"

    def prepare(self, case: Case):
        """Makes the spheres at rest in their tube, unless they are in the cache."""
        from ..spheres import preparation

        preparation.prepared(self.scene(case.options, case.seed))

    def measure(self, case: Case, folder, found) -> Outcome:
        """What the records of a finished run say; ``found``: what the run returned. Runs are aligned by the release."""
        series = records.read_series(folder / "series.csv")
        values = {q.name: found.get(q.name) for q in self.QUANTITIES}
        values["rest_s"] = found["time_s"] if found["ended"] else None
        energy, overlap = series["energy_kinetic_J"], series["overlap_mean_rel"]
        curves = {
            "abscissa": series["time_s"],
            "front": series["edge_m"] - series["edge_m"][0],
            "centroid": series["centroid_z_m"][0] - series["centroid_z_m"],
        }
        notes = () if found["ended"] else ("stopped before it was at rest",)
        moving = overlap[energy > 0.01 * energy.max()].mean()
        return self._outcome(case, found, values, curves, series, moving, overlap[0], notes)


class TriaxialTests(SphereExperiment):
    """A triaxial test between smooth plates."""

    KIND, NAME, TITLE = "triaxial", "triaxial", "Triaxial test of spheres"
    QUANTITIES = (
        Quantity("peak_deg", "angle of friction at the peak", "°"),
        Quantity("critical_deg", "angle of friction in the critical state", "°"),
        Quantity("strain_peak", "axial strain at the peak", "1"),
        Quantity("volumetric_strain_end", "volumetric strain in the end", "1"),
        Quantity("isotropic_solid_fraction", "solid fraction after pressing", "1"),
        Quantity("solid_fraction_end", "solid fraction in the end", "1"),
    )
    KEYS = ("peak_deg", "critical_deg")
    CURVES = {"stress": "σ₁ over σ₃", "volume": "volumetric strain"}
    DEFAULT_STIFFNESSES = (2e7, 1e8, 5e8)  # Pa; under the default σ₃ contacts overlap by 1 % at the softest
    ENSEMBLE_STIFFNESS = 1e8  # Pa, for all seeds
    OVERLAP_WHEN = ("as the strain begins", "during the test")
    COST_WHEN = "of the test"

    def prepare(self, case: Case):
        """Presses the sample of a case, unless it is in the cache."""
        from ..spheres import pressing

        pressing.pressed(self.scene(case.options, case.seed))

    def measure(self, case: Case, folder, found) -> Outcome:
        """What the records of a finished test say; tests are compared along their strain."""
        series = records.read_series(folder / "series.csv")
        begins, major = strength.running_mean(series["strain"], measures.axial(series), measures.PEAK_WINDOW)
        _, minor = strength.running_mean(series["strain"], measures.lateral(series), measures.PEAK_WINDOW)
        strain = begins + measures.PEAK_WINDOW / 2
        volume = np.interp(strain, series["strain"], series["volumetric_strain"])
        curves = {"abscissa": strain, "stress": major / minor, "volume": volume}
        values = {q.name: found[q.name] for q in self.QUANTITIES}
        overlap = series["overlap_mean_rel"]
        return self._outcome(case, found, values, curves, series, overlap.mean(), overlap[0])


def run_column(folder, **plain):
    """Runs a round column in the (empty) scene, its records below ``folder``; ``plain``: a Case. Returns the numbers of
    the run.
    """
    return COLUMN.ran(folder, Case(**plain))


def run_triaxial(folder, **plain):
    """As :func:`run_column`, a triaxial test."""
    return TRIAXIAL.ran(folder, Case(**plain))


COLUMN, TRIAXIAL = RoundColumns(run_column), TriaxialTests(run_triaxial)
