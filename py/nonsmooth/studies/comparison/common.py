"""Sections of the report that several scenarios have: deposits, motion, courses, forces of contacts, damping."""

from __future__ import annotations

import numpy as np

from . import deposits, figures
from .cases import modulus_label
from .report import ReportSection

__all__ = [
    "bonds_section",
    "by_seed",
    "by_stiffness",
    "course_section",
    "damping_section",
    "deposit_section",
    "force_section",
    "motion_section",
]

WAYS = (("front", "way of the front [m]", 1.0), ("centroid", "way of the centre\nof mass [m]", 1.0))


def by_seed(plan, outcomes, pick):
    """Groups for figures.courses: hard and soft of all seeds; ``pick``: what of an Outcome is drawn."""
    label = modulus_label(plan.ensemble[0][1].stiffness)
    return [
        ("hard", figures.HARD, [pick(outcomes[h]) for h, _ in plan.ensemble]),
        (f"soft, {label}", figures.SOFT, [pick(outcomes[s]) for _, s in plan.ensemble]),
    ]


def by_stiffness(plan, outcomes, pick):
    """Groups for figures.courses: the hard run and all stiffnesses on the first packing."""
    moduli = [c.stiffness for c in plan.sweep]
    return [("hard", figures.HARD, [pick(outcomes[plan.ensemble[0][0]])])] + [
        (f"soft, {modulus_label(c.stiffness)}", figures.shade(c.stiffness, moduli), [pick(outcomes[c])])
        for c in plan.sweep
    ]


def curves(outcome):
    """The curves of an Outcome, {name: array}."""
    return outcome.curves


def series(outcome):
    """The series of an Outcome, {column: array}."""
    return outcome.series


def deposit_section(folder, plan, outcomes, walls):
    """A list with the section on deposits of the first seed, empty where a run left none; ``walls``: as style.as_walls
    takes them.
    """
    hard, soft = (outcomes[c] for c in plan.ensemble[0])
    if hard.deposit is None or soft.deposit is None:
        return []
    begin = deposits.outline(*hard.begin) if hard.begin is not None else None
    path, shared = folder / "deposits.png", deposits.overlap(hard.deposit, soft.deposit)
    caption = (
        f"The deposits of seed {hard.case.seed}; soft with {modulus_label(soft.case.stiffness)}. Pores are closed; the "
        "overlap is the area that both cover over the area that either covers."
    )
    figures.deposits_overlaid(hard.deposit, soft.deposit, begin, walls, shared, path)
    return [ReportSection("Deposits", plots=[(path, caption)])]


def motion_section(folder, plan, outcomes, clock):
    """Front and centre of mass against time; ``clock``: label of the time."""
    since, seed = ("abscissa", clock, 1.0), plan.ensemble[0][0].seed
    seeds = figures.courses(by_seed(plan, outcomes, curves), WAYS, since, folder / "motion_seeds.png")
    moduli = figures.courses(by_stiffness(plan, outcomes, curves), WAYS, since, folder / "motion_stiffness.png")
    plots = [(seeds, "All seeds."), (moduli, f"All stiffnesses, seed {seed}.")]
    return ReportSection("Front and centre of mass", plots=plots)


def course_section(title, path, plan, outcomes, columns, abscissa, stiffness=True):
    """Columns of the series; ``stiffness``: all stiffnesses on one packing, else all seeds."""
    groups = (by_stiffness if stiffness else by_seed)(plan, outcomes, series)
    caption = f"All stiffnesses, seed {plan.ensemble[0][0].seed}." if stiffness else "All seeds."
    return ReportSection(title, plots=[(figures.courses(groups, columns, abscissa, path), caption)])


def force_section(folder, plan, outcomes, caption):
    """P(N/⟨N⟩)."""
    groups = by_stiffness(plan, outcomes, lambda o: np.array(list(o.forces.values())))
    shown = [(label, colour, found[0]) for label, colour, found in groups]
    path = figures.force_distribution(shown, folder / "force_distribution.png")
    return ReportSection("Force distribution", plots=[(path, caption)])


def damping_section(folder, plan, outcomes, clock):
    """The run that keeps its damping, beside the one that does not."""
    throughout = outcomes[plan.damping]
    usual = next(outcomes[c] for c in plan.sweep if c.stiffness == plan.damping.stiffness)
    rest, moving = usual.case.damping, usual.case.damping_moving
    groups = [
        ("hard", figures.HARD, [outcomes[plan.ensemble[0][0]].curves]),
        (f"soft, damping {moving:g} on the move", figures.SOFT, [usual.curves]),
        (f"soft, damping {rest:g} throughout", figures.SHADES[4], [throughout.curves]),
    ]
    path = figures.courses(groups, WAYS, ("abscissa", clock, 1.0), folder / "damping.png")

    def part(e):
        return f"{(1 - e) / (1 + e):.2f} for λ = {e:g}"

    text = [
        "NewtonIntegrator's damping λ takes the part λ of every force that speeds a disk up, weight included, and adds it to forces that brake. "
        "A mass that slides down one slope "
        f"and comes to rest on another then stops after (1 − λ)/(1 + λ) of its way on the second: {part(rest)}, {part(moving)}. So damping is "
        f"{rest:g} at rest and "
        f"{moving:g} while the mass moves, with a linear passage below a tenth of its largest speed."
    ]
    return ReportSection(
        "What damping does", text, [(path, f"{modulus_label(throughout.case.stiffness)}, seed {throughout.case.seed}.")]
    )


def bonds_section(folder, plan, outcomes, columns, abscissa, pick=series):
    """The run with fragile bonds, beside the one with ductile ones, and the hard one; ``columns`` and ``abscissa`` of
    ``pick``.
    """
    fragile = outcomes[plan.fragile]
    usual = next(outcomes[c] for c in plan.sweep if c.stiffness == plan.fragile.stiffness)
    groups = [
        ("hard", figures.HARD, [pick(outcomes[plan.ensemble[0][0]])]),
        ("soft, ductile bonds", figures.SOFT, [pick(usual)]),
        ("soft, fragile bonds", figures.SHADES[4], [pick(fragile)]),
    ]
    path = figures.courses(groups, columns, abscissa, folder / "bond_kinds.png")
    text = [
        "A bond of the hard law yields at its thresholds and breaks when it has left a small ellipse (half axes of some hundredths of a diameter). YADE's law has both ends of "
        "this: fragile bonds break where they first reach a threshold, ductile ones yield and never break. Soft runs here take ductile bonds and break "
        "them at the same ellipse (BondEllipseEngine); one run with fragile bonds shows what the difference is worth. Fragile bonds hand their load to "
        "neighbours that are as near to their own thresholds."
    ]
    return ReportSection(
        "What brittle bonds do", text, [(path, f"{modulus_label(fragile.case.stiffness)}, seed {fragile.case.seed}.")]
    )
