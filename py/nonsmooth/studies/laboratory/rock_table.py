"""The table of calibrated rocks, ``sections/rocks.json``, from which a section takes contact parameters for a cohesion
and an angle of friction; :mod:`..rocks` reads it.

What is measured is (c/σ_ext, φ) against μ_s at fixed ratios of all other strengths. Rigid disks know no stress but
σ_ext and σ₃, so that a rock whose strengths are all k times as large has, under k times the pressure, k times the
stresses at the same strains (similarity): c is proportional to σ_ext, φ does not depend on it, and a table over μ_s
alone is whole. All other contact parameters are those of the paper's rock.
"""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np

from ...measure import strength
from ...measure.statistics import half_width, over_seeds, told
from ...model import materials, rocks
from ...records import read_series
from . import biaxial_test, campaign
from .pressing import Shape

__all__ = [
    "CHECKED",
    "CHECK_SEEDS",
    "COUNT",
    "FIXED",
    "FRICTIONS",
    "PRESSURES",
    "SEEDS",
    "Entry",
    "added",
    "check",
    "checks",
    "entries",
    "left_out",
    "rock",
    "row",
    "rows",
    "run",
    "table",
    "variants",
]

FRICTIONS = (0.005, 0.01, 0.025, 0.05, 0.1, 0.15, 0.2, 0.3, 0.45)
SEEDS = (1, 2, 3, 4, 5)
COUNT = 1000  # disks; 2,000 bear the same (biaxial_effects.py)
PRESSURES = (0.4, 2.5, 10.0, 40.0)  # σ₃/σ_ext: about those of a calibration, 0.5 to 48 c
STRAIN = strength.ONSET  # at the end: what a sample bears as it begins to fail (strength.onset)
USUAL = 0.3  # friction of the variants, the paper's
FEW = 3  # samples of a variant: the same as the table's first, so that they differ by what is varied
SMALL = 500  # disks of the variant that says what a small sample does
FIXED = (  # parameters that all rocks of the table share
    "bonded",
    "rolling_friction",
    "residual_rolling_friction",
    "bond_ellipse",
    "bond_creation_distance",
    "restitution",
)
# (c [Pa], φ [°]) that a check asks for: between the rocks of the table, weak and strong
CHECKED = ((20e3, 25.0), (150e3, 34.0), (2e6, 40.0))
CHECK_SEEDS = (21, 22, 23, 24)  # samples that the table does not know


@dataclasses.dataclass(frozen=True)
class Entry:
    """A rock of the table or a variant of it: ``name`` for folders, what it is in words, its section.Material, how many
    disks its samples have, and how many samples at most.
    """

    name: str
    label: str
    material: object
    count: int = COUNT
    most: int = 1000

    def tests(self, seeds, pressures=PRESSURES):
        """Its biaxial Tests, a list; ``seeds`` of the samples."""
        return [
            biaxial_test.BiaxialTest(
                self.material, p * self.material.tensile_strength, Shape(self.count, seed), strain=STRAIN
            )
            for seed in seeds[: self.most]
            for p in pressures
        ]


def rock(friction, **changed):
    """The paper's rock with another friction μ_s (and μ_r) of its contacts; ``changed``: other fields of the
    section.Material.
    """
    return dataclasses.replace(
        materials.load("wwr"), friction=friction, residual_friction=friction, **changed, envelope=None
    )


def entries(frictions=FRICTIONS, count=COUNT):
    """The rocks of the table, a list of Entry."""
    return [Entry(f"friction-{mu:g}", f"μ_s = {mu:g}", rock(mu), count) for mu in frictions]


def variants(count=COUNT):
    """What the table's law leaves out, at the friction :data:`USUAL`: other residual values, and smaller samples."""
    return [
        Entry(
            "residual-strength-0",
            "no residual tensile strength",
            rock(USUAL, residual_tensile_strength=0.0),
            count,
            FEW,
        ),
        Entry(
            "residual-friction-half",
            "half of the friction after debonding",
            dataclasses.replace(rock(USUAL), residual_friction=USUAL / 2),
            count,
            FEW,
        ),
        Entry("small", f"samples of {SMALL} disks", rock(USUAL), SMALL, FEW),
    ]


def run(out, wanted, seeds=SEEDS, threads=1, resume=False, progress=lambda share, doing: None):
    """Tests Entries below ``out``; returns for each a dictionary, see :func:`row`. Raises as campaign.run does."""
    whole, done, found = sum(e.count for e in wanted), 0, []
    for entry in wanted:
        tests, folder = entry.tests(seeds), Path(out) / entry.name
        measured = campaign.run(
            tests,
            folder,
            threads,
            resume,
            lambda share, doing, d=done, e=entry: progress((d + share * e.count) / whole, f"{e.label}: {doing}"),
        )
        done += entry.count
        found.append(row(entry, [m | onset(folder, test) for m, test in zip(measured, tests, strict=True)]))
    return found


def onset(folder, test):
    """What a test of those below ``folder`` says of its sample as that begins to fail, see strength.onset:
    ``sigma3_onset_Pa``, ``sigma1_onset_Pa`` and ``strain_onset``.
    """
    minor, major, strain = strength.onset(read_series(Path(folder) / "tests" / campaign.name_of(test) / "series.csv"))
    return {"sigma3_onset_Pa": minor, "sigma1_onset_Pa": major, "strain_onset": strain}


def row(entry, measured):
    """What an Entry's tests say: friction of its contacts, ``cohesion_over_tensile_strength`` and
    ``friction_angle_deg`` over seeds (statistics.over_seeds), the former also ``cohesion_without_lowest`` pressure, and
    the principal stresses as samples begin to fail."""
    by_seed, unit = {}, entry.material.tensile_strength
    for m in measured:
        by_seed.setdefault(m["seed"], []).append(m)
    fits = [
        strength.envelope([m["sigma3_onset_Pa"] for m in group], [m["sigma1_onset_Pa"] for m in group])
        for group in by_seed.values()
    ]
    # the envelope is curved: that of higher pressures alone, as Table 1 has, cuts the axis higher
    lowest = min(m["confining_Pa"] for m in measured)
    without = [
        strength.envelope(
            [m["sigma3_onset_Pa"] for m in group if m["confining_Pa"] > lowest],
            [m["sigma1_onset_Pa"] for m in group if m["confining_Pa"] > lowest],
        )
        for group in by_seed.values()
    ]
    return {
        "name": entry.name,
        "label": entry.label,
        "friction": entry.material.friction,
        "cohesion_over_tensile_strength": over_seeds([f.cohesion / unit for f in fits]),
        "cohesion_without_lowest": over_seeds([f.cohesion / unit for f in without]),
        "friction_angle_deg": over_seeds([f.friction_deg for f in fits]),
        "disks": sorted({m["disks"] for m in measured}),
        "seeds": list(by_seed),
        "packing_fraction": float(np.mean([m["packing_fraction"] for m in measured])),
        "onsets": [
            {
                "seed": m["seed"],
                "confining_over_tensile_strength": m["sigma3_onset_Pa"] / unit,
                "axial_over_tensile_strength": m["sigma1_onset_Pa"] / unit,
                "strain": m["strain_onset"],
            }
            for m in measured
        ],
        "steps": sum(m["steps"] for m in measured),
        "wall_steps_s": sum(m["wall_steps_s"] for m in measured),
        "wall_s": sum(m["wall_s"] for m in measured),
    }


def table(found, others, command):
    """The table from what :func:`run` returned for :func:`entries` and :func:`variants`; ``command``: that makes it.

    Samples are taken to scatter alike in all rocks: the mean variance over the rocks, of ln c and of φ, with the
    degrees of freedom of one rock, since the seeds are the same in all.
    """
    found = sorted(found, key=lambda row: row["friction"])
    seeds, fractions = found[0]["seeds"], [row["packing_fraction"] for row in found]
    angles = np.array([row["friction_angle_deg"]["values"] for row in found])
    shares = np.log([row["cohesion_over_tensile_strength"]["values"] for row in found])
    scatter = {
        "cohesion_rel": float(np.sqrt(shares.var(axis=1, ddof=1).mean())),
        "friction_angle_deg": float(np.sqrt(angles.var(axis=1, ddof=1).mean())),
        "freedom": len(seeds) - 1,
        "disks": found[0]["disks"][-1],
    }
    names = ("cohesion_rel", "friction_angle_deg")

    def error(share):
        return {n: half_width(math.sqrt(share) * scatter[n], scatter["freedom"]) for n in names}

    wwr, shape = rock(USUAL), Shape(scatter["disks"], seeds[0])
    box = shape.section().disks
    higher, whole = (
        np.array([row[name]["mean"] for row in found])
        for name in ("cohesion_without_lowest", "cohesion_over_tensile_strength")
    )
    made = {
        "command": command,
        "law": "φ does not depend on σ_ext, c is proportional to it (similarity); ln μ_s is linear in φ, ln(c/σ_ext) linear in ln μ_s between the rocks",
        "fixed": {k: list(v) if isinstance(v := getattr(wwr, k), tuple) else v for k in FIXED},
        "usual": {
            "residual_friction_over_friction": 1.0,
            "residual_tensile_strength_over_tensile_strength": wwr.residual_tensile_strength / wwr.tensile_strength,
        },
        # what the variants have measured: strengths stay within what samples scatter
        "open": {
            "residual_friction": {"of": "friction", "from": 0.5, "to": 1.0},
            "residual_tensile_strength": {
                "of": "tensile_strength",
                "from": 0.0,
                "to": wwr.residual_tensile_strength / wwr.tensile_strength,
            },
        },
        "samples": {
            "disks": scatter["disks"],
            "seeds": seeds,
            "largest_over_smallest": box.d_max / box.d_min,
            "distribution": box.distribution,
            "packing_fraction": box.packing_fraction,
            "packing_fraction_pressed": float(np.mean(fractions)),
            "confining_over_tensile_strength": list(PRESSURES),
            "strain": STRAIN,
        },
        "scatter": scatter,
        "mean_95": error(1 / len(seeds)),
        "one_sample_95": error(1 + 1 / len(seeds)),
        # what other pressures make of c, root mean square over the rocks
        "curvature_rel": float(np.sqrt(np.mean((higher / whole - 1) ** 2))),
        "left_out": left_out(found),
        "rocks": found,
        "variants": others,
    }
    return made | {
        "tables": [["Calibrated rocks", *rows(found)], ["The rock with μ_s = 0.3, otherwise", *rows(others)]]
    }


def added(found, others, command):
    """The shipped table with the rocks of ``found`` besides, in place of those with the same friction; they need its
    seeds and its number of disks, as samples are taken to scatter alike. Arguments as of :func:`table`.
    """
    shipped = rocks.table()
    new = {row["friction"] for row in found}
    kept = [row for row in shipped["rocks"] if row["friction"] not in new]
    return table([*kept, *found], [*shipped["variants"], *others], f"{shipped['command']}, then {command}")


def left_out(found):
    """What the law misses where a rock between two others is left out, a list of dictionaries: the relative error of
    c/σ_ext at the μ_s that gives its φ, and that of φ at its μ_s. A gap between rocks is then twice as wide, which
    makes it about four times as large as it is with the rock."""
    angle, mu, share = (
        np.array(values)
        for values in (
            [row["friction_angle_deg"]["mean"] for row in found],
            [math.log(row["friction"]) for row in found],
            [math.log(row["cohesion_over_tensile_strength"]["mean"]) for row in found],
        )
    )
    missed = []
    for k in range(1, len(found) - 1):
        others = np.arange(len(found)) != k
        at = np.interp(angle[k], angle[others], mu[others])
        missed.append(
            {
                "friction": found[k]["friction"],
                "friction_angle_deg": float(np.interp(mu[k], mu[others], angle[others]) - angle[k]),
                "cohesion_rel": float(math.exp(np.interp(at, mu[others], share[others]) - share[k]) - 1),
            }
        )
    return missed


def rows(found):
    """(heads, lines) of texts for what :func:`run` returned: a line for each rock."""

    def text(value, *how):
        return told(value["mean"], value["half_width"], *how)

    return ["", "μ_s", "φ [°]", "c / σ_ext", f"c / σ_ext without {PRESSURES[0]:g} σ_ext", "disks", "samples"], [
        [
            row["label"],
            f"{row['friction']:g}",
            text(row["friction_angle_deg"], 1),
            text(row["cohesion_over_tensile_strength"], 2),
            text(row["cohesion_without_lowest"], 2),
            ", ".join(map(str, row["disks"])),
            str(len(row["seeds"])),
        ]
        for row in found
    ]


def checks(count=COUNT):
    """Entries of rocks that are asked for by :data:`CHECKED`, a list."""
    made = []
    for cohesion, angle in CHECKED:
        found = rocks.contacts(cohesion, angle)
        made.append(
            Entry(
                f"c-{1e-3 * cohesion:g}-phi-{angle:g}",
                f"c = {1e-3 * cohesion:g} kPa, φ = {angle:g}°",
                dataclasses.replace(
                    rock(found.friction),
                    tensile_strength=found.tensile_strength,
                    residual_tensile_strength=0.25 * found.tensile_strength,
                ),
                count,
            )
        )
    return made


def check(found, command):
    """What samples of rocks that were asked for have beside it, from what :func:`run` returned for :func:`checks`: a
    dictionary with a row for each, and how many samples are within the table's interval."""
    said, within, lines = rocks.table()["one_sample_95"], [], []
    for (cohesion, angle), row in zip(CHECKED, found):
        unit = rocks.contacts(cohesion, angle).tensile_strength
        row["asked"] = {"cohesion_Pa": cohesion, "friction_angle_deg": angle}
        row["cohesion_Pa"] = over_seeds([unit * v for v in row["cohesion_over_tensile_strength"]["values"]])
        off = [bool(abs(c / cohesion - 1) <= said["cohesion_rel"]) for c in row["cohesion_Pa"]["values"]]
        turned = [bool(abs(phi - angle) <= said["friction_angle_deg"]) for phi in row["friction_angle_deg"]["values"]]
        row["within"] = {"cohesion": sum(off), "friction_angle": sum(turned)}
        within += off + turned
        c, phi = row["cohesion_Pa"], row["friction_angle_deg"]
        lines.append(
            [
                row["label"],
                told(c["mean"], c["half_width"], 1, 1e-3),
                told(phi["mean"], phi["half_width"], 1),
                f"{sum(off)} and {sum(turned)} of {len(off)}",
            ]
        )
    heads = ["asked", "c [kPa]", "φ [°]", "samples within the interval"]
    return {
        "command": command,
        "one_sample_95": said,
        "within": sum(within),
        "of": len(within),
        "rows": found,
        "tables": [["Rocks that were asked for", heads, lines]],
    }
