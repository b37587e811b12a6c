"""The report of a comparison as one HTML page with its figures in it; the first screen answers the questions."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path

from ... import report
from . import answers, figures
from .answers import number, spread
from .cases import modulus_label

__all__ = ["ReportSection", "common_sections", "tables_of", "write"]

TEMPLATE = Path(__file__).with_name("report.html.j2")


SHOWN = ("error", "overlap", "front_travel_m")  # of the convergence, in the figure, besides curves and key quantities


@dataclass
class ReportSection:
    """A part of the page: ``text`` (sentences), ``plots`` [(path of a PNG, caption)], ``tables`` [(caption, heads,
    rows)].
    """

    title: str
    text: list = field(default_factory=list)
    plots: list = field(default_factory=list)
    tables: list = field(default_factory=list)


def write(path, title, lead, questions, sections, machine):
    """Writes the page.

    ``lead``: sentences on what was compared; ``questions``: [(question, verdict, sentences)]; ``machine``: as
    benchmark.machine.describe tells.
    """
    # from the working folder, and not from the page's
    found = [replace(s, plots=[(Path(plot).absolute(), caption) for plot, caption in s.plots]) for s in sections]
    return report.write(path, TEMPLATE, title=title, lead=lead, questions=questions, sections=found, machine=machine)


def tables_of(sections):
    """Title, heads and rows of each table of ``sections``, as ``summary.json`` holds them: cells are words."""
    return [
        [s.title, list(heads), [[str(cell) for cell in row] for row in rows]]
        for s in sections
        for _, heads, rows in s.tables
    ]


def _percent(value):
    return "–" if value is None else f"{100 * value:.2g} %"


def common_sections(out, scenario, plan, outcomes, summary):
    """Sections that every scenario has: quantities, cost, work and precision, convergence, runs. Figures go to
    ``out/figures``.
    """
    folder = Path(out) / "figures"
    return [
        _quantities(summary),
        _overlaps(folder, scenario, plan, outcomes, summary),
        _work(folder, scenario, summary),
        _convergence(folder, scenario, summary),
        _runs(scenario, outcomes),
    ]


def _quantities(summary):
    rows = []
    for q in summary["quantities"].values():

        def cell(w):
            return spread(q[w]["mean"], q[w]["sd"], q["unit"])

        within = {None: "not told", True: "yes", False: "no"}[q["agree"]]
        off, half = number(q["difference"], q["unit"]), q["difference_95"]
        confidence = "–" if half is None else "± " + number(half, q["unit"])
        rows.append((q["means"], cell("hard"), cell("soft"), off, confidence, within))
    caption = (
        f"Means and standard deviations over seeds {', '.join(map(str, summary['seeds']))}; soft with "
        f"{modulus_label(summary['ensemble_stiffness_Pa'])}. "
        "Differences are soft minus hard of the same packing, with their 95 % confidence (Student's t)."
    )
    heads = ("quantity", "hard", "soft", "difference", "confidence", "the same")
    return ReportSection("All quantities", tables=[(caption, heads, rows)])


def _overlaps(folder, scenario, plan, outcomes, summary):
    sweep, hard = [outcomes[c] for c in plan.sweep], outcomes[plan.ensemble[0][0]]
    moduli, every = [o.case.stiffness for o in sweep], [*sweep, hard]
    *rest, hard_rest = (o.overlap_rest for o in every)
    *moving, hard_moving = (o.overlap for o in every)
    *rates, hard_rate = (o.cost.rate for o in every)
    *steps, hard_steps = (1 / o.cost.step_s for o in every)
    path = folder / "overlaps.png"
    overlaps = figures.overlaps(moduli, rest, moving, hard_rest, hard_moving, path, scenario.OVERLAP_WHEN)
    cost = figures.cost(moduli, rates, steps, hard_rate, hard_steps, folder / "cost.png")
    caption = f"Cost of a second of simulation {scenario.COST_WHEN}: steps alone, without records; one thread a run."
    shared = (
        "Wall times were taken while other runs of the comparison shared the machine; scripts/compare_hard_soft.py "
        "--cost measures them alone."
    )
    plots = [(overlaps, f"{scenario.OVERLAP} The same in both worlds."), (cost, caption)]
    return ReportSection("Overlaps and cost", [*answers.answer_cost(summary), shared], plots)


def _work(folder, scenario, summary):
    work = summary["work_precision"]

    def short(label):
        return label.removeprefix("soft, ").removeprefix("hard, ")

    worlds = ("hard", "soft", "soft_aside")

    def points(kind, world):
        return [(p["wall_s"], p["error"], short(p["label"])) for p in work[kind][world]]

    titles = {"against_hard": "against the finest hard run", "against_own": "against the finest run of its own world"}
    panels = [(title, *(points(kind, world) for world in worlds)) for kind, title in titles.items()]
    path = figures.work_precision(panels, work["scatter"], folder / "work_precision.png")
    rows = []
    for p in (p for world in worlds for p in work["against_hard"][world]):
        named = ((scenario.CURVES.get(n, n.removesuffix("_m").replace("_", " ")), v) for n, v in p["parts"].items())
        parts = ", ".join(f"{name} {number(v, digits=2)}" for name, v in named)
        error = "–" if p["error"] is None else number(p["error"])
        rows.append((p["label"], number(p["wall_s"], "s"), error, parts))
    text = [
        f"Error: root mean square of relative differences of {', '.join(scenario.CURVES.values())} and key quantities, against a reference run "
        f"of the same packing. "
        f"Hard runs vary by time step and tolerance, soft ones by stiffness, each with {summary['step_share']:g} of its stable step. "
        + (
            "With one seed the scatter is not known."
            if work["scatter"] is None
            else f"The scatter, the median of the same error between hard runs of different seeds, is {number(work['scatter'])}."
        )
        + (
            " The open mark is the run with the other kind of bonds, which is not among those that are compared at equal accuracy."
            if work["against_hard"]["soft_aside"]
            else ""
        )
    ]
    caption = (
        "Error against wall time; the lower left is better. In the grey band errors are below the scatter over seeds "
        "and tell nothing."
    )
    table = "Errors against the finest hard run", ("run", "wall time", "error", "its parts"), rows
    return ReportSection("Work and precision", text, [(path, caption)], [table])


def _convergence(folder, scenario, summary):
    found = summary["convergence"]
    rows = list(found["rows"].values())
    shown = [
        r for name, r in found["rows"].items() if name in SHOWN or name in scenario.KEYS or name in scenario.CURVES
    ]
    moduli = found["stiffnesses_Pa"]
    curves = [(r["means"], r["differences"], r["scatter"], r["power"], r["scale"]) for r in shown]
    caption = (
        "Relative difference of soft runs from the hard one of the same packing, against stiffness; dashed: the power "
        "of E that fits best."
    )
    plots = [(figures.convergence(moduli, curves, folder / "convergence.png"), caption)]
    forces = found["forces"]
    if any(c is not None for c in forces["correlation"]):
        between = list(zip(forces["hard_runs"], forces["hard_correlation"]))
        caption = (
            "Forces at the same contacts, soft against hard, and between hard runs of different numerics: in a packing "
            "with more contacts than it needs, forces are not unique."
        )
        plots.append((figures.network(moduli, forces["correlation"], between, folder / "network.png"), caption))
    verdict, table = {True: "yes", False: "no", None: "–"}, []
    for r in rows:
        differences = (number(d, digits=2) if d is not None else "–" for d in r["differences"])
        error = "" if r["power_error"] is None else f" ± {r['power_error']:.2f}"
        power = "–" if r["power"] is None else f"{r['power']:.2f}{error}"
        within = verdict[r["stiffest_within_scatter"]]
        table.append((r["means"], *differences, power, _percent(r["scatter"]), within))
    heads = (
        "difference from hard of",
        *(modulus_label(e) for e in found["stiffnesses_Pa"]),
        "power of E",
        "scatter over seeds",
        "stiffest within it",
    )
    text = [
        "What converges has a clearly negative power of E; the mean overlap must, with about −1. What stays at the level of the scatter over "
        "seeds does not converge any "
        "further: a chaotic motion depends on details that no stiffness settles, and so do single contact forces. What stays above it does not "
        "converge with the stiffnesses that were run."
    ]
    return ReportSection(
        "Convergence of soft to hard", text, plots, [("Relative differences by stiffness", heads, table)]
    )


def _runs(scenario, outcomes):
    rows = [
        (
            c.label,
            c.seed,
            o.cost.steps,
            number(o.cost.step_s, "s"),
            number(o.cost.simulated_s, "s"),
            number(o.cost.wall_s, "s"),
            number(o.cost.wall_s / o.cost.simulated_s, "s"),
            number(o.overlap, digits=2),
            "; ".join(o.notes) or "–",
        )
        for c, o in sorted(outcomes.items(), key=lambda item: item[0].name)
    ]
    heads = "run | seed | steps | time step | simulated | wall time | wall time a simulated second".split(" | ")
    heads += [f"mean overlap, {scenario.OVERLAP_WHEN[1]}", "remarks"]
    title = "Each run had one thread of its own; wall times are of the steps, without records."
    return ReportSection("All runs", tables=[(title, heads, rows)])
