"""What a campaign of tension tests shows: a table and figures."""

from __future__ import annotations

from pathlib import Path

from ... import records
from ...errors import UserError
from ...figures import tension as figures
from ...measure.statistics import told
from ...system import checks
from .tension_campaign import name_of_result

__all__ = ["draw", "table"]

#: {number of a group in the summary: (its head in a table, its factor, digits)}.
NUMBERS = {
    "tensile_strength_Pa": ("σ_t [kPa]", 1e-3, 1),
    "tensile_strength_rel": ("σ_t / σ_ext", 1, 3),
    "weakest_cut_rel": ("weakest cut / σ_ext", 1, 3),
    "strain_peak": ("strain at the peak [‰]", 1e3, 2),
    "work_J_per_m2": ("work [kJ/m²]", 1e-3, 2),
    "work_bonds_rel": ("of it in bonds [%]", 100, 0),
    "break_height_rel": ("break at height [%]", 100, 0),
    "break_angle_deg": ("inclination [°]", 1, 0),
    "break_thickness_d": ("thickness [d]", 1, 1),
}
_REMEDY = "give the summary of a campaign of tension tests, as scripts/tension_test.py keeps it in summary.json"


@checks.takes(UserError, summary=checks.holds("groups", _REMEDY))
def table(summary):
    """(heads, lines) of texts: a line for each number of disks and rate, means over seeds with half of their 95 %
    interval.
    """
    return ["disks", "I", "tests", *(head for head, _, _ in NUMBERS.values())], [
        [
            f"{row['disks']:,}",
            f"{row['inertial_number']:g}",
            f"{len(row['seeds'])}",
            *(told(row[name]["mean"], row[name]["half_width"], digits, f) for name, (_, f, digits) in NUMBERS.items()),
        ]
        for row in summary["groups"]
    ]


@checks.takes(UserError, summary=checks.holds("groups tests", _REMEDY))
def draw(out, summary):
    """Figures of a campaign in ``out``: ``tension.png``, curves and the broken sample of the tests with most disks, the
    slowest of them, and ``tension_strengths.png`` where there are several numbers of disks or rates. Returns their
    paths.
    """
    out = Path(checks.path("out", out, UserError, "give the path of the folder of the campaign"))
    chosen = max(summary["groups"], key=lambda row: (row["disks"], -row["inertial_number"]))
    tests = [
        t
        for t in summary["tests"]
        if (t["disks_asked"], t["inertial_number"]) == (chosen["disks"], chosen["inertial_number"])
    ]
    homes = [out / "tests" / name_of_result(t) for t in tests]
    curves = [(records.read_series(home / "series.csv"), t) for home, t in zip(homes, tests)]
    made = [figures.tests(curves, figures.Broken.of(homes[0], tests[0]), out / "tension.png")]
    if len(summary["groups"]) > 1:
        made.append(figures.strengths(summary["groups"], out / "tension_strengths.png"))
    return made
