"""A comparison from its plan to its report."""

from __future__ import annotations

import time
from pathlib import Path

from ...running import kept_runs
from ...system import machine
from ...system.whole_files import write_json
from . import (
    answers,
    biaxial_report,
    biaxials,
    collapse_report,
    collapses,
    losses,
    report,
    runs,
    slope_report,
    slopes,
    spheres,
    summary,
    triaxial_report,
)
from .cases import HARD_NUMERICS, CaseError, plan

__all__ = ["PARTS", "SCENARIOS", "answered", "check_stiffnesses", "compare", "lacks"]

#: Experiment (see :mod:`outcomes`) and report of each scenario.
SCENARIOS = {
    "slope": (slopes, slope_report),
    "biaxial": (biaxials, biaxial_report),
    "column": (collapses.COLUMN, collapse_report),
    "pile": (collapses.PILE, collapse_report),
    "round-column": (spheres.COLUMN, collapse_report),
    "triaxial": (spheres.TRIAXIAL, triaxial_report),
}
#: Parts of the plan that a comparison can do without, see :mod:`cases`.
PARTS = ("numerics", "damping", "bonds")
COST_QUESTION = "Which costs less at equal accuracy, and by what factor?"


def compare(
    scenario,
    out,
    seeds,
    *,
    disks=None,
    source=None,
    stiffnesses=None,
    threads=1,
    resume=False,
    progress=lambda share, doing: None,
    without=(),
    options=None,
    **plan_options,
):
    """Runs all cases that are not kept, writes ``summary.json`` and ``report.html`` into ``out``; returns the summary
    and the answered questions.

    ``scenario``: a key of SCENARIOS; arguments that are None take the scenario's own; ``without``: names from PARTS
    that are left out; ``plan_options``: of cases.plan. Raises CaseError (or the scenario's own UserError) before
    anything runs for arguments that cannot be used, and CaseError after all runs have ended where one failed.
    """
    began, out = time.monotonic(), Path(out)
    experiment, pages = SCENARIOS[scenario]
    space = getattr(experiment, "SPACE", False)
    if space:
        if disks is not None:
            raise CaseError(f"--disks {disks}: the size of a {scenario} says how many spheres it has; give --size")
        disks, plan_options["model"] = experiment.count(options or {}), None
    disks = experiment.DISKS if disks is None else disks
    if disks < 1:
        raise CaseError(f"--disks {disks}: give a number above 0")
    if threads < 1:
        raise CaseError(f"--threads {threads}: give a number above 0")
    if not getattr(experiment, "MOVING", True):
        plan_options["damping_moving"] = None
    if stiffnesses is None and plan_options.get("ensemble") is None:
        plan_options["ensemble"] = experiment.ENSEMBLE_STIFFNESS
    # the finest numerics stay: they are the reference of the hard world, without which no run has an error
    parts = dict(
        numerics=HARD_NUMERICS[-1:] if "numerics" in without else HARD_NUMERICS,
        damping_run="damping" not in without,
        bonds_run=experiment.BONDS and "bonds" not in without,
    )
    chosen = plan(
        source or experiment.SOURCE,
        disks,
        seeds,
        stiffnesses or experiment.DEFAULT_STIFFNESSES,
        options=options,
        **{**plan_options, **parts},
    )
    cases = chosen.cases
    bonds, lost = losses.of_case(experiment, chosen.ensemble[0][1])
    check_stiffnesses(experiment, chosen.sweep)
    for case in cases if space else ():
        experiment.check(case)
    for case in {c.seed: c for c in cases}.values():
        progress(0.0, f"packing of seed {case.seed}")
        experiment.prepare(case)
    found = runs.run(experiment.run, cases, out, threads, resume, progress)
    outcomes = {case: experiment.measure(case, runs.folder_of(case, out), one) for case, one in zip(cases, found)}
    told = {
        **summary.summarise(experiment, chosen, outcomes),
        "machine": summary.clean(machine.describe()),
        "threads": threads,
        "bonds": bonds,
        "model_lacks": lost,
        # a run kept by a version that did not note it counts with what it noted of itself
        "runs_wall_s": sum(one.get("process_wall_s", one["wall_s"]) for one in found),
    }
    questions = [(text, *answers.answer_same(told, names)) for text, names in pages.QUESTIONS] + [
        (COST_QUESTION, *answers.answer_costs(told))
    ]
    (out / "figures").mkdir(parents=True, exist_ok=True)
    sections = [
        *pages.sections(out, experiment, chosen, outcomes, told),
        *report.common_sections(out, experiment, chosen, outcomes, told),
    ]
    told["tables"] = report.tables_of(sections)
    told["wall_s"] = time.monotonic() - began
    write_json(out / "summary.json", told)
    report.write(
        out / "report.html",
        f"Hard against soft: {scenario}",
        _lead(chosen, experiment, told),
        questions,
        sections,
        told["machine"],
    )
    return told, questions


def answered(folder, **arguments):
    """:func:`compare` in a process of its own: writes into the folder and returns ``questions`` with their answers,
    (text, verdict, sentences) each.
    """
    note = kept_runs.Progress(folder)
    _, questions = compare(out=folder, progress=lambda share, doing: note(share), **arguments)
    return {"questions": questions}


def check_stiffnesses(experiment, sweep):
    """Raises CaseError for soft cases of ``sweep`` that would refuse once they run, since their springs are too
    weak for the weight on them.
    """
    least = experiment.least_stiffness(sweep[0]) if hasattr(experiment, "least_stiffness") else 0.0
    weak, strong = ([f"{c.stiffness:g}" for c in sweep if (c.stiffness < least) == below] for below in (True, False))
    if weak:
        raise CaseError(
            f"--stiffness {','.join(weak)}: too weak for the weight of this {experiment.NAME}; its disks at the bottom would overlap more than "
            f"is let through; give {1.05 * least:.2g} Pa or more"
            + (f", as --stiffness {','.join(strong)}" if len(strong) > 1 else "")
        )


def lacks(told):
    """Sentences on what the soft model of a summary lacks beside what cohesion_moment does, none for that."""
    return [f"Lost with {told['model']}, beside what cohesion_moment loses: {line}." for line in told["model_lacks"]]


def _lead(chosen, experiment, told):
    hard, soft = chosen.ensemble[0]
    constant = soft.damping_moving in (None, soft.damping)
    rest = (
        f"{soft.damping:g}" if constant else f"{soft.damping:g} at rest, {soft.damping_moving:g} while the mass moves"
    )
    space = soft.model is None
    lost = "" if space else ", but for the residual tensile strength σ_res, which soft contacts do not have,"
    return [
        f"{experiment.TITLE}, {hard.disks} {'spheres' if space else 'disks'}, seeds {', '.join(map(str, told['seeds']))}: the same packings and{lost} "
        f"the same parameters with Contact Dynamics (“hard”) and with YADE's "
        f"{soft.model or 'springs without cohesion'} (“soft”). Soft contacts: Young's modulus {', '.join(f'{e:g}' for e in told['stiffnesses_Pa'])} Pa, {soft.stiffness:g} Pa "
        f"where seeds are compared; "
        f"{told['bonds']}; time step {soft.step:g} of the stability limit; non-viscous damping {rest}.",
        *lacks(told),
        f"The processes of all runs took {answers.number(told['runs_wall_s'], 's')} of wall time in sum, each on one thread, runs that were kept from earlier "
        f"sittings included; this sitting took {answers.number(told['wall_s'], 's')}, with {told['threads']} at a time.",
        "The scatter is the standard deviation over seeds, root mean square of both worlds'. Differences within it may be chance.",
    ]
