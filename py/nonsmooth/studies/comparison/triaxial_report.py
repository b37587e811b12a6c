"""What the report says of triaxial tests: stress and volume against strain, strengths, packing."""

from __future__ import annotations

from ...measure import triaxial
from . import biaxial_report, common

__all__ = ["QUESTIONS", "sections"]

QUESTIONS = (
    ("Do both models have the same angle of friction, within the scatter over seeds?", ("peak_deg", "critical_deg")),
    (
        "Do samples of both have the same volume, within that scatter?",
        ("isotropic_solid_fraction", "volumetric_strain_end"),
    ),
)


def sections(out, scenario, plan, outcomes, summary):
    """The scenario's own sections; figures go to ``out/figures``."""
    folder = out / "figures"
    packing = [("solid_fraction", "solid fraction [-]", 1.0), ("coordination", "mean contacts\nof a sphere [-]", 1.0)]
    along = ("strain", "axial strain [%]", 100.0)
    return [
        biaxial_report.stress_section(folder, plan, outcomes, triaxial.PEAK_WINDOW),
        common.course_section("Packing in the middle", folder / "packing.png", plan, outcomes, packing, along),
    ]
