"""What is measured of a reading of the paper: its rock's strengths, each of its samples, the water that its slope
bears, and how near these are to the paper. Needs no YADE.

How near is one number, the root mean square of :func:`misses`: differences from :data:`PAPER` by what they may be. The
load of a sample has two maxima, and which of them is the higher changes from packing to packing. A mean strain of the
peak would then be one that no sample has, so that the strains of all samples stand here, and each counts by its own
difference from the paper.
"""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np

from ... import records
from ...measure import strength, toe
from ...measure.statistics import over_seeds, told
from ...model import section
from ..laboratory import campaign

__all__ = [
    "FIGURE_9",
    "PAPER",
    "PRESSURES",
    "SHIPPED",
    "misses",
    "row",
    "samples_of",
    "series_of",
    "tables",
    "toe_water",
]

#: {number: (of the paper, what a reading may differ by)}: Table 1, Figure 10 (the strain of the peak, as its binary
#: logarithm), and [115].
PAPER = {
    "cohesion_peak_kPa": (88.0, 25.0),
    "friction_peak_deg": (38.5, 2.0),
    "cohesion_residual_kPa": (13.0, 13.0),
    "friction_residual_deg": (26.2, 2.0),
    "strain_peak": (0.01, 1.0),
    "water_highest_m": (22.5, 4.0),
}
PRESSURES = (0.5e6, 4e6, 8e6, 16e6)  # Pa; Figure 10 has the last three, the first tells the cohesion
FIGURE_10 = PRESSURES[1:]
FIGURE_9 = 8e6  # Pa, under which each sample is told
WINDOWS = {"4 to 6 %": (0.04, 0.06), "8 to 10 %": (0.08, 0.10)}  # of strain, of the residual strength of a sample
FRACTION = 0.84  # of the paper's packing ([104])
SHIPPED = "shipped"  # the reading that is


def row(summary, folder, slopes):
    """The numbers of a reading, a dictionary that JSON can hold.

    ``summary``: of its tests (:func:`.campaign.summarise`), in the ``folder``; ``slopes``: results of its slopes, none
    where they were not run. A number is None where no test tells it, as the cohesion of a single pressure. For each
    strength of :data:`PAPER` and for ``water_highest_m`` the mean over seeds and ``…_95``, half of the 95 % interval
    (None for one seed); ``water_highest_m_each``; ``strain_peak``: those of all samples, [[under 4, 8, 16 MPa], one
    list a seed]; ``samples``: see :func:`samples_of`; ``misses`` (see :func:`misses`) and their root mean square
    ``distance``, None where a number is missing.
    """
    found = {}
    for name in list(PAPER)[:4]:
        middle, unit = name.rsplit("_", 1)
        found |= {name: summary.get(name), f"{name}_95": summary.get(f"{middle}_95_{unit}")}
    found["strain_peak"] = [
        [t["strain_peak"] for t in summary["tests"] if t["seed"] == seed and t["confining_Pa"] in FIGURE_10]
        for seed in summary["seeds"]
    ]
    waters = [s["water_highest_m"] for s in slopes]
    mean = over_seeds(waters or [None])
    found |= {
        "water_highest_m": mean["mean"],
        "water_highest_m_95": mean["half_width"],
        "water_highest_m_each": waters,
        "samples": samples_of(summary["tests"], folder),
    }
    found["misses"] = misses(found)
    far = list(found["misses"].values())
    return found | {"distance": None if None in far else math.sqrt(np.mean(np.square(far)))}


def samples_of(tests, folder):
    """What each sample says under :data:`FIGURE_9`, a list of dictionaries, one a seed.

    ``tests``: dictionaries of :func:`.campaign.measure`; ``folder``: in which they were run. ``seed``, ``disks``;
    ``strain_peak``; ``deviator_peak_MPa``, the largest σ₁ − σ₃; ``cohesion_peak_kPa``, of this sample's envelope over
    all of its pressures, None of a single one; ``bands_at_1_percent``, 2 where two bands are conjugate at 1 % of
    strain, 1 where there is one that prevails, 0 without any; ``residual_deg``, {window: apparent angle of friction [°]
    of the mean stresses between the strains of :data:`WINDOWS`}, None where the test ends before.
    """
    found = []
    for t in sorted(tests, key=lambda t: t["seed"]):
        if t["confining_Pa"] != FIGURE_9:
            continue
        group = [one for one in tests if one["seed"] == t["seed"]]
        circles = [one["sigma3_peak_Pa"] for one in group], [one["sigma1_peak_Pa"] for one in group]
        series = series_of(t, folder)
        means = {name: strength.mean_between(series, *window) for name, window in WINDOWS.items()}
        found.append(
            {
                "seed": t["seed"],
                "disks": t["disks"],
                "strain_peak": t["strain_peak"],
                "deviator_peak_MPa": 1e-6 * (t["sigma1_peak_Pa"] - t["sigma3_peak_Pa"]),
                "cohesion_peak_kPa": 1e-3 * strength.envelope(*circles).cohesion if len(group) > 1 else None,
                "bands_at_1_percent": campaign.conjugate_bands(t["bands"]),
                "residual_deg": {
                    name: stresses and strength.apparent_deg(*stresses) for name, stresses in means.items()
                },
            }
        )
    return found


def series_of(test, folder):
    """The series of a test, its dictionary of :func:`.campaign.measure` or another one with ``confining_Pa`` and
    ``seed``, that was run in the ``folder``.
    """
    return records.read_series(Path(folder) / "tests" / campaign.name_of_result(test) / "series.csv")


def misses(row):
    """{number: difference from the paper by what it may be} for a dictionary with the numbers of :data:`PAPER`; 1 and
    less is within it, None where a number is missing. That of the peaks' strains is the root mean square over all
    samples."""
    found = {}
    for name, (wanted, allowed) in PAPER.items():
        value = row[name]
        if name == "strain_peak":
            octaves = [math.log2(strain / wanted) for strain in np.ravel(value)]
            value = math.sqrt(np.mean(np.square(octaves))) if octaves else None
        elif value is not None:
            value -= wanted
        found[name] = None if value is None else value / allowed
    return found


def toe_water():
    """The height of the water table at which Rankine's passive toe (:mod:`..toe`) fails, of the shipped section with
    the envelope of Table 1 and the paper's packing fraction, 0.84: {"disk", "bulk": on which volume the water acts:
    {"normal_m": along the normal of DP, "upright_m": upright, which is that by cos β}}."""
    shipped, found = section.load("jiufengershan"), {}
    for volume in ("disk", "bulk"):
        made = dataclasses.replace(shipped, water=dataclasses.replace(shipped.water, volume=volume))
        height = toe.passive(made, 1e3 * PAPER["cohesion_peak_kPa"][0], PAPER["friction_peak_deg"][0], FRACTION).water_m
        found[volume] = {"normal_m": height, "upright_m": height / math.cos(math.radians(shipped.dip))}
    return found


#: {number: (its head in a table, digits)}, of means.
SHOWN = {
    "cohesion_peak_kPa": ("peak cohesion [kPa]", 0),
    "friction_peak_deg": ("peak friction [°]", 1),
    "cohesion_residual_kPa": ("residual cohesion [kPa]", 0),
    "friction_residual_deg": ("residual friction [°]", 1),
    "water_highest_m": ("highest water [m]", 1),
}
PEAKS = "peaks at 0.5 to 2 % of strain"


def tables(rows):
    """Tables for rows of :func:`.readings.run`, [title, heads, lines] each, of texts: the numbers of each reading
    beside the paper's, the nearest first, and its samples under 8 MPa.
    """
    ordered = by_distance(rows)

    def mean(row, name):
        return told(row[name], row.get(f"{name}_95"), SHOWN[name][1])

    paper = {name: wanted for name, (wanted, _) in PAPER.items()}
    heads = ["reading", "platens", *(head for head, _ in SHOWN.values()), f"{PEAKS}, 4 to 16 MPa", "distance"]
    lines = [["the paper", "", *(mean(paper, name) for name in SHOWN), "all", ""]]
    lines += [
        [r["label"], r["platens"], *(mean(r, name) for name in SHOWN), _counted(np.ravel(r["strain_peak"])), _far(r)]
        for r in ordered
    ]
    # what several readings share stands under the one that was tested
    own = [r for r in ordered if r["samples"] and Path(r["folder"]).parts[-2:] == (r["name"], r["platens"])]
    samples = [[r["label"], r["platens"], *_of_samples(r["samples"])] for r in own]
    return [
        ["Readings", heads, lines],
        [
            "Samples under 8 MPa",
            [
                "reading",
                "platens",
                "strain of each peak [%]",
                PEAKS,
                "σ₁ − σ₃ at the peak [MPa]",
                "bands of each at 1 %",
                *(f"residual, {name} [°]" for name in WINDOWS),
            ],
            samples,
        ],
    ]


def by_distance(rows):
    """Rows of :func:`.readings.run`, those of a reading together and the nearest first: readings by their nearest
    row.
    """

    def far(row):
        return math.inf if row["distance"] is None else row["distance"]

    nearest = {}
    for row in rows:
        nearest[row["name"]] = min(nearest.get(row["name"], math.inf), far(row))
    order = list(nearest)
    return sorted(rows, key=lambda row: (nearest[row["name"]], order.index(row["name"]), far(row)))


def _far(row):
    return "–" if row["distance"] is None else f"{row['distance']:.2f}"


def _counted(strains):
    low, high = strength.FIGURE_10
    return f"{sum(low <= strain <= high for strain in strains)} of {len(strains)}"


def _of_samples(samples):
    """Texts of the samples of a reading: strains, which have two maxima, and bands one by one, the others as means."""
    strains = [s["strain_peak"] for s in samples]
    deviator = over_seeds([s["deviator_peak_MPa"] for s in samples])
    residual = [over_seeds([s["residual_deg"][name] for s in samples]) for name in WINDOWS]
    return [
        ", ".join(f"{100 * strain:.2f}" for strain in strains),
        _counted(strains),
        told(deviator["mean"], deviator["half_width"], 1),
        ", ".join(str(s["bands_at_1_percent"]) for s in samples),
        *(told(r["mean"], r["half_width"], 1) for r in residual),
    ]
