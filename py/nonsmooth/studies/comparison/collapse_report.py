"""What the report says of columns and piles, in the plane and in space."""

from __future__ import annotations

import numpy as np

from . import common

__all__ = ["QUESTIONS", "sections"]

QUESTIONS = (("Do both models run out as far, within the scatter over seeds?", ("runout_rel", "final_height_rel")),)


def sections(out, scenario, plan, outcomes, summary):
    """The scenario's own sections; figures go to ``out/figures``."""
    folder = out / "figures"
    hard = outcomes[plan.ensemble[0][0]]
    plane = hard.end is not None  # spheres have no outline and no forces
    made = []
    if plane:
        x, y, _ = hard.end
        floor = min(float(np.min(y)), 0.0)
        ground = [("floor", np.array([[float(np.min(x)) - 10, floor], [float(np.max(x)) + 10, floor]]))]
        made = common.deposit_section(folder, plan, outcomes, ground)
    made.append(common.motion_section(folder, plan, outcomes, "time since the release [s]"))
    unit = "J/m" if plane else "J"
    energy = [("energy_kinetic_J", f"kinetic energy [{unit}]", 1.0), ("height_m", "height [m]", 1.0)]
    path, time = folder / "energy.png", ("time_s", "time since the release [s]", 1.0)
    made.append(common.course_section("Kinetic energy and height", path, plan, outcomes, energy, time))
    if plane:
        caption = "Normal forces of contacts under compression, at rest before the release."
        made.append(common.force_section(folder, plan, outcomes, caption))
    if plan.damping is not None:
        made.append(common.damping_section(folder, plan, outcomes, "time since the release [s]"))
    return made
