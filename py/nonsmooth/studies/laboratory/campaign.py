"""Biaxial tests side by side, and what they say together: ``summary.json``."""

from __future__ import annotations

import json
import math
from dataclasses import asdict
from pathlib import Path

import numpy as np

from ... import records
from ...measure import bands, cycles, fluctuations, strength
from ...measure.statistics import Estimate, over_seeds
from ...system import checks
from . import biaxial_test, sample_runs
from .sample_runs import CampaignError

__all__ = [
    "OF_TEST",
    "CampaignError",
    "bands_of",
    "by_pressure",
    "conjugate_bands",
    "measure",
    "name_of",
    "name_of_result",
    "number",
    "run",
    "summarise",
]

# snapshots (strain in per cent) in which bands are measured: as in the paper's Figure 9, and where its tests are on
# their plateau
BANDS_AT = {"bands": "1", "bands_late": "4"}
#: Numbers of a test's course, as biaxial.run returns them.
OF_COURSE = (
    "inertial_number rate_per_s time_step_s steps simulated_s height_m width_m wall_making_s wall_s wall_steps_s "
    "sweeps_mean unconverged overlap_worst_rel"
).split()


def name_of(test):
    """Name of a test's folder."""
    return f"{test.confining / 1e6:g}MPa-seed{test.shape.seed}"


def name_of_result(measured):
    """The same, of a test's dictionary in ``summary.json``."""
    return f"{measured['confining_Pa'] / 1e6:g}MPa-seed{measured['seed']}"


def run(tests, out, threads, resume=False, progress=lambda share, doing: None):
    """Runs biaxial Tests, as many at a time as ``threads``, each in ``out/tests/NAME``; returns what :func:`measure`
    says of each.

    ``resume``: keep tests that ended, and go on with others from their checkpoints. ``progress``: called with the share
    done and what is being done, now and then. Raises CampaignError or SampleError before anything runs where tests
    cannot be run or measured; CampaignError with the first failure after the others have ended.
    """
    tests = sample_runs.checked(tests, out, threads, biaxial_test.BiaxialTest)
    for test in tests:
        if test.forces_from is not None:
            remedy = f"give a strain from 0 to less than {test.strain:g}, where the test ends, or None"
            checks.number("forces_from", test.forces_from, CampaignError, remedy, least=0, below=test.strain)
        if test.strain < strength.SHORTEST:
            raise CampaignError(
                f"--strain {test.strain:g}: too short to measure a peak and what follows; give {strength.SHORTEST:g} or more"
            )
    made = [(name_of(test), test, biaxial_test.key_of(test)) for test in tests]
    advice = "; give each confining pressure and seed once"
    folders = sample_runs.run(made, out, threads, "studies.laboratory.biaxial:run", advice, resume, progress)
    return [measure(test, folder) for test, folder in zip(tests, folders)]


def measure(test, folder):
    """Figures of one test, a dictionary for ``summary.json``."""
    folder = Path(folder)
    found = json.loads((folder / "result.json").read_text())["found"]
    series = records.read_series(folder / "series.csv")
    plateau = (strength.PLATEAU * test.strain, test.strain)
    c = strength.curve(series, plateau)
    return {
        "confining_Pa": test.confining,
        "seed": test.shape.seed,
        "disks": found["disks"],
        "bonds": found["bonds"],
        "packing_fraction": found["packing_fraction"],
        "sigma1_peak_Pa": c.peak,
        "strain_peak": c.peak_strain,
        "later_share": strength.later_share(series),
        "sigma3_peak_Pa": c.peak_confining,
        "sigma1_residual_Pa": c.residual,
        "sigma1_residual_error_Pa": c.residual_error,
        "sigma3_residual_Pa": c.residual_confining,
        "residual_between_strains": plateau,
        "dilatancy_deg": number(c.dilatancy_deg),
        "volumetric_strain_end": c.volumetric_end,
        "platen_difference_rel": c.imbalance,
        **fluctuations.measure(series, plateau, found["height_m"] * found["width_m"], _disk_area(folder)),
        **cycles.measure(series, plateau),
        **{key: bands_of(folder, snapshot) for key, snapshot in BANDS_AT.items()},
        **{key: found[key] for key in OF_COURSE},
    }


def _disk_area(folder):
    """Mean area of a test's disks [m²]."""
    return float(np.mean(math.pi * records.read_snapshot(folder / "snapshots" / "begin.npz").r ** 2))


def bands_of(folder, snapshot):
    """Shear bands of a test in a snapshot, by name, or at its end where it ended before; a list of two dictionaries,
    None where there is none (see :func:`bands.find`).
    """
    begin = records.read_snapshot(folder / "snapshots" / "begin.npz")
    path = folder / "snapshots" / f"{snapshot}.npz"
    s = records.read_snapshot(path if path.exists() else folder / "snapshots" / "end.npz")
    return [
        None
        if b is None
        else {
            "angle_deg": b.angle_deg,
            "width_d": b.width,
            "rotation_rad": b.rotation,
            "contrast": b.contrast,
            "antithetic": b.antithetic,
        }
        for b in bands.find(s.x, s.y, s.r, s.angle - begin.angle)
    ]


#: Numbers of a test that :func:`by_pressure` has means of, besides those of its bands and breaks.
OF_TEST = (
    "strain_peak",
    "later_share",
    "dilatancy_deg",
    "volumetric_strain_end",
    "stress_fluctuation_rel",
    "contractions_per_percent",
    "contraction_with_drop",
    *cycles.NUMBERS,
)


def _numbers_of(t):
    """Numbers of a test, by name; None where it has none."""
    shares = t.get("broken_shares") or {}
    return {
        **{
            f"{kind}_deg": strength.apparent_deg(t[f"sigma3_{kind}_Pa"], t[f"sigma1_{kind}_Pa"])
            for kind in ("peak", "residual")
        },
        **{name: t.get(name) for name in OF_TEST},
        "band_width_d": _of_bands(t.get("bands"), "width_d"),
        "band_width_late_d": _of_bands(t.get("bands_late"), "width_d"),
        "bands_conjugate": float(conjugate_bands(t.get("bands")) == 2),
        "antithetic": _of_bands(t.get("bands"), "antithetic"),
        **{f"broken_{mode}": shares.get(mode) for mode in fluctuations.MODES},
    }


def conjugate_bands(found):
    """Number of conjugate bands among those of :func:`bands_of`: 2 where they lean to opposite sides, equally steep;
    else 1, the one that prevails, or 0 where there is none.
    """
    left, right = (band and band["angle_deg"] for band in found or (None, None))
    if None not in (left, right) and left * right < 0 and abs(left + right) <= bands.CONJUGATE:
        return 2
    return int((left, right) != (None, None))


def _of_bands(found, name):
    """Mean over the two bands of a test; None where one was not found."""
    values = [band and band[name] for band in found or (None,)]
    return None if None in values else float(np.mean(values))


def by_pressure(measured):
    """Means over seeds of tests under the same pressure: dictionaries with ``confining_Pa`` and by name, see
    statistics.over_seeds: apparent angles of friction of peak and plateau [°], the numbers of :data:`OF_TEST`, widths
    of bands at 1 % and at 4 % of strain, at 1 % too the share of tests with two conjugate bands and that of disks that
    turn against them, and the shares of bonds by what broke them.
    """
    found = {}
    for t in sorted(measured, key=lambda t: t["confining_Pa"]):
        found.setdefault(t["confining_Pa"], []).append(_numbers_of(t))
    return [
        {"confining_Pa": p} | {name: over_seeds([one[name] for one in tests]) for name in tests[0]}
        for p, tests in found.items()
    ]


def summarise(material, measured, wall_s=None, threads=None):
    """``summary.json``: per test, and per material with the mean and the 95 % confidence interval over seeds (null for
    one seed).

    Residual strengths are null where a plateau begins before :data:`strength.SOFTENED`.
    """
    by_seed = {}
    for m in measured:
        by_seed.setdefault(m["seed"], []).append(m)
    whole = {
        "material": asdict(material),
        "tests": measured,
        "by_pressure": by_pressure(measured),
        "seeds": sorted(by_seed),
        "threads": threads,
        "wall_s": wall_s,
        "fit": "line closest to tangent to the circles, least squares of relative misses; confidence over seeds by Student's t",
    }
    if len({m["confining_Pa"] for m in measured}) < 2:
        return {**whole, "note": "one confining pressure: no envelope"}
    whole["fit_confining_Pa"] = [m["confining_Pa"] for m in next(iter(by_seed.values()))]
    for kind in ("peak", "residual"):
        if kind == "residual" and min(m["residual_between_strains"][0] for m in measured) < strength.SOFTENED - 1e-9:
            names = (
                "cohesion_residual_kPa cohesion_residual_95_kPa friction_residual_deg friction_residual_95_deg "
                "misses_residual_rel"
            ).split()
            return {
                **whole,
                **dict.fromkeys(names),
                "note": f"no residual envelope: the strain ends before {strength.SOFTENED / strength.PLATEAU:g}",
            }
        fits = [
            strength.envelope([m[f"sigma3_{kind}_Pa"] for m in group], [m[f"sigma1_{kind}_Pa"] for m in group])
            for group in by_seed.values()
        ]
        cohesion = Estimate.of([1e-3 * f.cohesion for f in fits])
        friction = Estimate.of([f.friction_deg for f in fits])
        whole |= {
            f"cohesion_{kind}_kPa": cohesion.mean,
            f"cohesion_{kind}_95_kPa": number(cohesion.half_width),
            f"friction_{kind}_deg": friction.mean,
            f"friction_{kind}_95_deg": number(friction.half_width),
            f"misses_{kind}_rel": np.mean([f.misses for f in fits], axis=0).tolist(),
        }
    return whole


def number(value):
    """A number as JSON can hold it."""
    return None if math.isnan(value) else value
