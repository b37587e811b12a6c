"""What the report says of biaxial tests: stress and volume against strain, strengths, bonds, speeds, contact forces."""

from __future__ import annotations

from ...measure import strength
from . import common, figures
from .report import ReportSection
from .slope_report import modes_section

__all__ = ["QUESTIONS", "sections", "stress_section"]

QUESTIONS = (
    (
        "Do both models have the same peak and residual strength, within the scatter over seeds?",
        ("sigma1_peak_Pa", "sigma1_residual_Pa"),
    ),
)


STRAIN = ("abscissa", "axial strain [%]", 100.0)
COLUMNS = [("stress", "σ₁/σ₃ [-]", 1.0), ("volume", "volumetric strain [%]", 100.0)]


def stress_section(folder, plan, outcomes, window):
    """Stress and volume along the strain; ``window``: strain over which stresses are running means."""
    curves = common.by_seed(plan, outcomes, common.curves), common.by_stiffness(plan, outcomes, common.curves)
    seeds, moduli = (
        figures.courses(groups, COLUMNS, STRAIN, folder / f"stress_{name}.png")
        for groups, name in zip(curves, ("seeds", "stiffness"))
    )
    plots = [
        (seeds, f"All seeds. Stresses are running means over {100 * window:g} % of strain."),
        (moduli, f"All stiffnesses, seed {plan.ensemble[0][0].seed}."),
    ]
    return ReportSection("Stress and volume", plots=plots)


def sections(out, scenario, plan, outcomes, summary):
    """The scenario's own sections; figures go to ``out/figures``."""
    folder, along = out / "figures", ("strain", "axial strain [%]", 100.0)
    made = [stress_section(folder, plan, outcomes, strength.PEAK_WINDOW)]
    alive = [("bonds_alive", "bonds that hold", 1.0)]
    made.append(common.course_section("Bonds", folder / "bonds.png", plan, outcomes, alive, along))
    mean = [("speed_mean_m_per_s", "mean speed of disks [m/s]", 1.0)]
    speeds = common.course_section("Motion", folder / "speed.png", plan, outcomes, mean, along)
    speeds.text.append(
        "The series of a biaxial test holds no kinetic energy; the mean speed of its disks shows when the sample moves more than its platens."
    )
    made.append(speeds)
    made.append(modes_section(folder, plan, outcomes))
    caption = "Normal forces of contacts under compression, under the confining pressure before the test begins."
    made.append(common.force_section(folder, plan, outcomes, caption))
    if plan.fragile is not None:
        made.append(common.bonds_section(folder, plan, outcomes, COLUMNS, STRAIN, common.curves))
    return made
