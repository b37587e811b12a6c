"""What the report says of slopes: deposits, motion, forces on walls, bonds, contact forces."""

from __future__ import annotations

from . import common, figures, slopes
from .report import ReportSection

__all__ = ["QUESTIONS", "modes_section", "sections"]

QUESTIONS = (
    (
        "Do both models fail at the same water table and run out as far, within the scatter over seeds?",
        ("water_at_failure_m", "front_travel_m"),
    ),
)
CLOCK = "time since the slope began to move [s]"


def sections(out, scenario, plan, outcomes, summary):
    """The slope's own sections; figures go to ``out/figures``."""
    folder, time = out / "figures", ("time_s", "time [s]", 1.0)
    made = common.deposit_section(folder, plan, outcomes, slopes.section_of(plan.ensemble[0][0]))
    made.append(common.motion_section(folder, plan, outcomes, CLOCK))
    forces = [
        ("fb_normal_N_per_m", "normal force on FB\n[MN/m]", 1e-6),
        ("dp_shear_N_per_m", "shear force on DP\n[MN/m]", 1e-6),
        ("dp_normal_effective_N_per_m", "effective normal force\non DP [MN/m]", 1e-6),
    ]
    path = folder / "forces.png"
    made.append(common.course_section("Forces on DP and FB", path, plan, outcomes, forces, time, stiffness=False))
    energy = [
        ("energy_kinetic_J", "kinetic energy [GJ/m]", 1e-9),
        ("bonds_alive", "bonds that hold", 1.0),
        ("water_m", "water table [m]", 1.0),
    ]
    path = folder / "energy.png"
    made.append(common.course_section("Kinetic energy, bonds, water", path, plan, outcomes, energy, time))
    caption = "Normal forces of contacts under compression, at rest before the water rises (t0)."
    made.append(common.force_section(folder, plan, outcomes, caption))
    made.append(modes_section(folder, plan, outcomes))
    if plan.fragile is not None:
        shown = [("bonds_alive", "bonds that hold", 1.0), ("front_m", "place of the front [m]", 1.0)]
        made.append(common.bonds_section(folder, plan, outcomes, shown, time))
    if plan.damping is not None:
        made.append(common.damping_section(folder, plan, outcomes, CLOCK))
    return made


def modes_section(folder, plan, outcomes):
    """Broken bonds by mode, hard and soft."""
    names = ("tension", "shear", "torque", "mixed")

    def share(o):
        made = max(1, o.series["bonds_alive"][0] + sum(o.series[f"bonds_broken_{m}"][0] for m in names))
        return {n: o.series[f"bonds_broken_{n}"][-1] / made for n in names}

    broken = [
        (label, colour, {n: [v[n] for v in found] for n in names})
        for label, colour, found in common.by_seed(plan, outcomes, share)
    ]
    text = [
        "The hard law knows how a bond broke. YADE's soft laws do not tell; here it is the threshold that the bond was nearest to when it was "
        "last seen whole, a row of the series before. "
        "Bonds that used less than half of each threshold then count as not known."
    ]
    return ReportSection(
        "Broken bonds by mode",
        text,
        [(figures.modes(broken, folder / "modes.png"), "Means over seeds, with standard deviations.")],
    )
