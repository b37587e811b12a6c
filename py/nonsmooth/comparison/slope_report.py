"""What the report says of slopes: deposits, motion, forces on walls, bonds, contact forces."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from . import deposits, figures, slopes
from .cases import modulus_label
from .report import Section

__all__ = ["QUESTIONS", "sections"]

QUESTIONS = (("Do both models fail at the same water table and run out as far, within the scatter over seeds?", ("water_at_failure_m", "front_travel_m")),)


def _groups(plan, outcomes, pick):
    """Hard and soft of all seeds."""
    label = modulus_label(plan.ensemble[0][1].stiffness)
    return [("hard", figures.HARD, [pick(outcomes[h]) for h, _ in plan.ensemble]), (f"soft, {label}", figures.SOFT, [pick(outcomes[s]) for _, s in plan.ensemble])]


def _by_stiffness(plan, outcomes, pick):
    """The hard run and all stiffnesses on the first packing."""
    moduli = [c.stiffness for c in plan.sweep]
    return [("hard", figures.HARD, [pick(outcomes[plan.ensemble[0][0]])])] + [
        (f"soft, {modulus_label(c.stiffness)}", figures.shade(c.stiffness, moduli), [pick(outcomes[c])]) for c in plan.sweep]


def sections(out, plan, outcomes, summary):
    """The slope's own sections; figures go to ``out/figures``."""
    folder = Path(out) / "figures"
    folder.mkdir(parents=True, exist_ok=True)
    hard, soft = (outcomes[c] for c in plan.ensemble[0])
    made = []
    if hard.deposit is not None and soft.deposit is not None:
        common = deposits.overlap(hard.deposit, soft.deposit)
        begin = deposits.outline(*hard.begin) if hard.begin is not None else None
        path = figures.deposits_overlaid(hard.deposit, soft.deposit, begin, slopes.section_of(hard.case), common, folder / "deposits.png")
        made.append(Section("Deposits", plots=[(path, f"The deposits of seed {hard.case.seed}. Pores are closed; the overlap is the area that both cover over the area that either covers.")]))
    ways = [("front", "way of the front [m]", 1.0), ("centroid", "way of the centre\nof mass [m]", 1.0)]
    since = ("abscissa", "time since the slope began to move [s]", 1.0)
    curves = lambda o: o.curves  # noqa: E731
    made.append(Section("Front and centre of mass", plots=[
        (figures.courses(_groups(plan, outcomes, curves), ways, since, folder / "motion_seeds.png"), "All seeds."),
        (figures.courses(_by_stiffness(plan, outcomes, curves), ways, since, folder / "motion_stiffness.png"), f"All stiffnesses, seed {hard.case.seed}.")]))
    forces = [("fb_normal_N_per_m", "normal force on FB\n[MN/m]", 1e-6), ("dp_shear_N_per_m", "shear force on DP\n[MN/m]", 1e-6),
              ("dp_normal_effective_N_per_m", "effective normal force\non DP [MN/m]", 1e-6)]
    clock = ("time_s", "time [s]", 1.0)
    all_of = lambda o: o.series  # noqa: E731
    made.append(Section("Forces on DP and FB", plots=[(figures.courses(_groups(plan, outcomes, all_of), forces, clock, folder / "forces.png"), "All seeds.")]))
    energy = [("energy_kinetic_J", "kinetic energy [GJ/m]", 1e-9), ("bonds_alive", "bonds that hold", 1.0), ("water_m", "water table [m]", 1.0)]
    made.append(Section("Kinetic energy, bonds, water", plots=[(figures.courses(_by_stiffness(plan, outcomes, all_of), energy, clock, folder / "energy.png"), f"All stiffnesses, seed {hard.case.seed}.")]))
    moduli = [c.stiffness for c in plan.sweep]
    groups = [("hard", figures.HARD, np.array(list(hard.forces.values())))] + [
        (f"soft, {modulus_label(c.stiffness)}", figures.shade(c.stiffness, moduli), np.array(list(outcomes[c].forces.values()))) for c in plan.sweep]
    made.append(Section("Force distribution", plots=[(figures.force_distribution(groups, folder / "force_distribution.png"), "Normal forces of contacts under compression, at rest before the water rises (t0).")]))
    names = ("tension", "shear", "torque", "mixed")
    share = lambda o: {n: o.series[f"bonds_broken_{n}"][-1] / max(1, o.series["bonds_alive"][0] + sum(o.series[f"bonds_broken_{m}"][0] for m in names)) for n in names}  # noqa: E731
    broken = [(label, colour, {n: [v[n] for v in found] for n in names}) for label, colour, found in _groups(plan, outcomes, share)]
    text = ["The hard law knows how a bond broke. YADE's soft laws do not tell; here it is the threshold that the bond was nearest to when it was last seen whole, up to 0.1 s before. "
            "Bonds that used less than half of each threshold then count as not known."]
    made.append(Section("Broken bonds by mode", text, [(figures.modes(broken, folder / "modes.png"), "Means over seeds, with standard deviations.")]))
    if plan.damping is not None:
        made.append(_damping(folder, plan, outcomes))
    return made


def _damping(folder, plan, outcomes):
    throughout = outcomes[plan.damping]
    usual = next(outcomes[c] for c in plan.sweep if c.stiffness == plan.damping.stiffness)
    groups = [("hard", figures.HARD, [outcomes[plan.ensemble[0][0]].curves]), (f"soft, damping {usual.case.damping_moving:g} on the move", figures.SOFT, [usual.curves]),
              (f"soft, damping {throughout.case.damping:g} throughout", figures.SHADES[4], [throughout.curves])]
    path = figures.courses(groups, [("front", "way of the front [m]", 1.0), ("centroid", "way of the centre\nof mass [m]", 1.0)],
                           ("abscissa", "time since the slope began to move [s]", 1.0), folder / "damping.png")
    e = throughout.case.damping
    text = [f"NewtonIntegrator's damping λ takes the part λ of every force that speeds a disk up, weight included, and adds it to forces that brake. A mass that slides down one slope "
            f"and comes to rest on another then stops after (1 − λ)/(1 + λ) of its way on the second: {(1 - e) / (1 + e):.2f} for λ = {e:g}, "
            f"{(1 - usual.case.damping_moving) / (1 + usual.case.damping_moving):.2f} for λ = {usual.case.damping_moving:g}. So damping is {usual.case.damping:g} at rest and "
            f"{usual.case.damping_moving:g} while the slope moves, with a linear passage below a tenth of the largest mean speed."]
    return Section("What damping does", text, [(path, f"{modulus_label(throughout.case.stiffness)}, seed {throughout.case.seed}.")])
