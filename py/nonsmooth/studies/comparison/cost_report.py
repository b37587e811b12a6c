"""The report of :mod:`cost`."""

from __future__ import annotations

from pathlib import Path

from ...system.whole_files import write_json
from . import figures, report
from .answers import number
from .cases import modulus_label
from .course import lacks

__all__ = ["write"]

STATE_NAMES = {"moving": "during the avalanche", "rest": "at rest"}
ONE_STIFFNESS = (
    "One stiffness gives no exponent, of overlaps or of cost, so what soft contacts of equal overlap take is not known; "
    "give --stiffness two values or more."
)


def write(out, told):
    """Writes ``summary.json``, the figure and ``report.html`` of what cost.run found into ``out``; returns the answered
    questions.
    """
    out = Path(out)
    folder = out / "figures"
    folder.mkdir(parents=True, exist_ok=True)
    sentences = [_sentence(state, s) for state, s in told["states"].items()]
    factor = told["soft_over_hard_wall_equal_overlap"]
    verdict = "not known" if factor is None else f"{number(factor)} times"
    questions = [("How much longer do soft contacts take at equal mean overlap?", verdict, sentences)]
    plot = figures.cost_and_overlap(
        [(STATE_NAMES[state], s["hard"], s["soft"], s["equal_overlap"]) for state, s in told["states"].items()],
        folder / "cost_and_overlap.png",
    )
    rows = [
        (
            STATE_NAMES[state],
            label,
            number(one["time_step_s"], "s"),
            number(1e3 * one["wall_s_per_step"], "ms"),
            number(one["rate"], "s"),
            number(one["overlap_mean_rel"], digits=2),
            number(one["overlap_worst_rel"], digits=2),
            number(one["rate"] / s["hard"]["rate"]),
            str(one["contacts"]),
            number(one["mean_speed_m_per_s"], "m/s", 2),
        )
        for state, s in told["states"].items()
        for label, one in [("hard", s["hard"]), *((f"soft, {modulus_label(x['stiffness_Pa'])}", x) for x in s["soft"])]
    ]
    heads = (
        "state | contacts | time step | wall time a step | wall time a simulated second | mean overlap | "
        "largest overlap | over hard | contacts that touch or carry force | mean speed"
    ).split(" | ")
    powers = [
        f"{STATE_NAMES[state]} {number(s['overlap_power'], digits=2)} and {number(s['rate_power'], digits=2)}"
        for state, s in told["states"].items()
        if s["overlap_power"]
    ]
    section = report.ReportSection(
        "Cost and overlap",
        [
            "Overlaps fall as a power of the stiffness, and cost grows as another: " + "; ".join(powers) + "."
            if powers
            else ONE_STIFFNESS
        ],
        [
            (
                plot,
                "Wall time for a second of simulation against mean overlap, each soft point with its stiffness; the dashed line goes on to the "
                "overlap of the hard run.",
            )
        ],
        [
            (
                f"{told['disks']} disks, {told['threads']} threads, {told['steps_timed']} steps timed after {told['relax_s']:g} s of simulation in which "
                f"soft contacts take up their load.",
                heads,
                rows,
            )
        ],
    )
    told = {**told, "tables": report.tables_of([section])}
    write_json(out / "summary.json", told)
    lead = [
        f"The slope of {told['disks']} disks with the same places and velocities in both worlds, every process alone on {told['threads']} "
        f"thread{'s' if told['threads'] > 1 else ''}. Soft: "
        f"{told['model']}, {told['bonds']}, {told['step_share']:g} of the stable time step, non-viscous damping {told['damping']:g} at rest and "
        f"{told['damping_moving']:g} on the move.",
        *lacks(told),
    ]
    report.write(
        out / "report.html", "Hard against soft: cost at equal overlap", lead, questions, [section], told["machine"]
    )
    return questions


def _sentence(state, s):
    """What was found of one state, in words."""
    hard, stiffest, name = s["hard"], s["soft"][-1], STATE_NAMES[state]
    seconds = number(hard["rate"], "s")
    rigid = f"{name[0].upper()}{name[1:]} a second of simulation takes {seconds} of wall time with rigid disks"
    rock, end = number(s["rock_stiffness"]), " (extrapolated)." if s["rock_stiffness_extrapolated"] else "."
    if len({one["stiffness_Pa"] for one in s["soft"]}) < 2:
        soft, rigids = (number(one["overlap_mean_rel"], digits=2) for one in (stiffest, hard))
        return (
            f"{rigid}, and {number(stiffest['rate'] / hard['rate'])} times as long with soft contacts of "
            f"{modulus_label(stiffest['stiffness_Pa'])}, whose mean overlap is {soft} of the mean diameter, that of "
            f"rigid ones {rigids}. {ONE_STIFFNESS} A rock's stiffness, 10 GPa, would take {rock} times as long as "
            f"rigid disks{end}"
        )
    beyond = ""
    if s["equal_overlap_extrapolated"]:
        beyond = (
            f" (extrapolated: the stiffest that was run, {modulus_label(stiffest['stiffness_Pa'])}, overlaps "
            f"{number(stiffest['overlap_mean_rel'], digits=2)})"
        )
    return (
        f"{rigid}. Soft contacts of equal "
        f"mean overlap, {number(hard['overlap_mean_rel'], digits=2)} of the mean diameter, need {modulus_label(s['equal_overlap_stiffness_Pa'])} and "
        f"{number(s['equal_overlap'])} times as long{beyond}; at equal largest overlap, {number(hard['overlap_worst_rel'], digits=2)}, it is "
        f"{number(s['equal_worst_overlap'])} times ({modulus_label(s['equal_worst_overlap_stiffness_Pa'])}"
        f"{', extrapolated' if s['equal_worst_overlap_extrapolated'] else ''}), and at a rock's stiffness, 10 GPa, it is {rock} times{end}"
    )
