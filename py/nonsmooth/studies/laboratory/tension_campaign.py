"""Tension tests side by side, and what they say together: ``summary.json``. Needs no YADE."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

import numpy as np

from ... import records
from ...measure import fluctuations, fracture, tensile, weakest_cut
from ...measure.statistics import over_seeds
from . import sample_runs, tension_test

__all__ = ["OF_TEST", "measure", "name_of", "name_of_result", "run", "summarise"]

#: Numbers of a test's course, as tension.run returns them.
OF_COURSE = (
    "disks bonds broke packing_fraction height_m width_m speed_m_per_s inertial_number time_step_s steps simulated_s "
    "wall_making_s wall_s wall_steps_s sweeps_mean unconverged overlap_worst_rel"
).split()
#: Numbers of a test that :func:`summarise` has means of.
OF_TEST = (
    "tensile_strength_Pa",
    "tensile_strength_rel",
    "strain_peak",
    "opening_peak_d",
    "work_J_per_m2",
    "work_bonds_rel",
    "weakest_cut_rel",
    "break_height_rel",
    "break_angle_deg",
    "break_thickness_d",
)
BOTTOM = 0  # the number of the lower platen in a snapshot; the upper one's is 1


def name_of(test):
    """Name of a test's folder."""
    return f"{test.shape.count}-disks-I{test.inertia:g}-seed{test.shape.seed}"


def name_of_result(measured):
    """The same, of a test's dictionary in ``summary.json``."""
    return f"{measured['disks_asked']}-disks-I{measured['inertial_number']:g}-seed{measured['seed']}"


def run(tests, out, threads, resume=False, progress=lambda share, doing: None):
    """Runs TensionTests, as many at a time as ``threads``, each in ``out/tests/NAME``; returns what :func:`measure`
    says of each.

    ``resume``: keep tests that ended, and go on with others from their checkpoints. ``progress``: called with the share
    done and what is being done, now and then. Raises CampaignError or SampleError before anything runs where tests
    cannot be run; CampaignError with the first failure after the others have ended.
    """
    tests = sample_runs.checked(tests, out, threads, tension_test.TensionTest)
    made = [(name_of(test), test, tension_test.key_of(test)) for test in tests]
    advice = "; give each number of disks, rate and seed once"
    folders = sample_runs.run(made, out, threads, "studies.laboratory.tension:run", advice, resume, progress)
    return [measure(test, folder) for test, folder in zip(tests, folders)]


def measure(test, folder):
    """Figures of one test, a dictionary for ``summary.json``."""
    folder, strength = Path(folder), test.material.tensile_strength
    found = json.loads((folder / "result.json").read_text())["found"]
    series = records.read_series(folder / "series.csv")
    c = tensile.curve(series, test.yielding, found["width_m"])
    bonds = series.get("energy_bonds_J")  # soft contacts sum up no energies
    begin, end = (records.read_snapshot(folder / "snapshots" / f"{name}.npz") for name in ("begin", "end"))
    return {
        "seed": test.shape.seed,
        "disks_asked": test.shape.count,
        "tensile_strength_Pa": c.peak,
        "tensile_strength_rel": c.peak / strength,
        "strain_peak": c.strain,
        "opening_peak_d": c.opening / test.diameter,
        "work_J_per_m2": c.work,
        "work_bonds_rel": float(bonds[-1] / series["work_J"][-1]) if bonds is not None else None,
        "stress_end_rel": c.end_rel,
        "platen_difference_rel": c.imbalance,
        "bonds_broken": records.broken_bonds(series),
        "broken_shares": fluctuations.shares_of_breaks(series),
        **_break(test, begin, end, records.read_breaks(folder / "breaks.csv")),
        **_cut(test, begin, found["width_m"] * strength),
        **{name: found.get(name) for name in OF_COURSE},
    }


def _pairs(snapshot):
    """Pairs of disks that are bonded, (m, 2)."""
    chosen = snapshot.cbonded & (snapshot.cj >= 0)
    return np.column_stack((snapshot.ci[chosen], snapshot.cj[chosen]))


def _heights(test, begin):
    """Height of the lower platen, distance of both and thickness of a grip [m]."""
    bottom, top = begin.walls[begin.walls[:, 0] == 1, 1]
    return bottom, top - bottom, test.grip * test.diameter


def _break(test, begin, end, breaks):
    """Where the sample came apart; None where fewer than two bonds broke."""
    names = "break_height_rel break_angle_deg break_thickness_d break_bonds break_share parted break_in_grips".split()
    broken = np.column_stack((breaks["disk1"], breaks["disk2"]))
    found = fracture.find(begin.x, begin.y, begin.r, _pairs(end), broken[broken[:, 0] >= 0])
    if found is None:
        return dict.fromkeys(names)
    bottom, height, grip = _heights(test, begin)
    above = found.y - bottom
    values = above / height, found.angle_deg, found.thickness, found.bonds, found.share, found.through
    return dict(zip(names, (*values, not grip < above < height - grip), strict=True))


def _cut(test, begin, unit):
    """The weakest cut of the sample's bonds, in units of σ_ext W."""
    bonds, (bottom, height, grip) = _pairs(begin), _heights(test, begin)
    held = np.minimum(begin.y - bottom, bottom + height - begin.y) < grip
    strengths = test.material.tensile_strength * begin.r[bonds].sum(axis=1)
    strengths[held[bonds].all(axis=1)] *= tension_test.STRONG
    ends = [begin.ci[begin.cbonded & (begin.cj == -1 - wall)] for wall in (BOTTOM, BOTTOM + 1)]
    found = weakest_cut.find(begin.x, begin.y, bonds, strengths, test.material.friction, *ends)
    height_rel = float(np.mean(begin.y[bonds[found.bonds]]) - bottom) / height if len(found.bonds) else None
    return {"weakest_cut_rel": found.force / unit, "weakest_cut_height_rel": height_rel}


def summarise(material, measured, wall_s=None, threads=None):
    """``summary.json``: per test, and in ``groups`` the means over seeds of tests of one number of disks and one rate
    with half of their 95 % interval, see statistics.over_seeds.
    """
    groups = {}
    for t in measured:
        groups.setdefault((t["disks_asked"], t["inertial_number"]), []).append(t)
    return {
        "material": asdict(material),
        "tests": measured,
        "groups": [
            {
                "disks": disks,
                "inertial_number": inertia,
                "seeds": [t["seed"] for t in tests],
                "parted": sum(bool(t["parted"]) for t in tests),
                **{name: over_seeds([t[name] for t in tests]) for name in OF_TEST},
            }
            for (disks, inertia), tests in sorted(groups.items())
        ],
        "threads": threads,
        "wall_s": wall_s,
    }
