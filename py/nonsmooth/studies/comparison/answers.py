"""The first screen: the questions of a comparison answered in plain words, with numbers from ``summary.json``."""

from __future__ import annotations

VERDICTS = {
    True: "they differ by no more than two packings do",
    False: "they differ",
    None: "more seeds are needed to tell",
}

__all__ = ["answer_cost", "answer_costs", "answer_same", "number", "spread"]


def _prefix(value, unit):
    """Factor and letter in which a value is best read."""
    if unit not in ("N/m", "Pa", "N"):
        return 1.0, ""
    return next(((f, p) for f, p in ((1e12, "T"), (1e9, "G"), (1e6, "M"), (1e3, "k")) if abs(value) >= f), (1.0, ""))


def _digits(value, digits):
    text = f"{value:.{digits}g}"
    return f"{value:.0f}" if "e" in text and 1e-3 <= abs(value) < 1e6 else text


def number(value, unit="", digits=3):
    """A number with its unit for a reader; "not known" for None."""
    if value is None:
        return "not known"
    scale, prefix = _prefix(value, unit)
    return _digits(value / scale, digits) + ("" if unit in ("", "1") else f" {prefix}{unit}")


def spread(mean, sd, unit):
    """Mean ± standard deviation in one unit; "not known" where the mean is None."""
    if mean is None or sd is None:
        return number(mean, unit)
    scale, prefix = _prefix(mean, unit)
    return f"{_digits(mean / scale, 3)} ± {_digits(sd / scale, 2)}" + ("" if unit in ("", "1") else f" {prefix}{unit}")


def answer_same(summary, names):
    """Sentences on whether both worlds agree in the quantities ``names``: (verdict, sentences); the verdict is "yes",
    "no", "in part" where they agree in some, or "not told" where one of them needs more seeds."""
    sentences, verdicts = [], []
    seeds = len(summary["seeds"])
    for name in names:
        q = summary["quantities"][name]
        unit = q["unit"]
        values = [spread(q[world]["mean"], q[world]["sd"], unit) for world in ("hard", "soft")]
        text = f"{q['means'][0].upper()}{q['means'][1:]}: {values[0]} hard, {values[1]} soft"
        known = [sum(v is not None for v in q[world]["values"]) for world in ("hard", "soft")]
        if min(known) < seeds:
            text += f" (in {known[0]} hard and {known[1]} soft runs of {seeds} it came to that)"
        verdicts.append(q["agree"])
        if q["difference_95"] is None or q["scatter"] is None:
            text += "; with these runs difference cannot be told from scatter."
        else:
            text += (
                f". The difference of the same packings is {number(q['difference'], unit)} ± {number(q['difference_95'], unit)} (95 % confidence), the scatter over seeds "
                f"{number(q['scatter'], unit)}: {VERDICTS[q['agree']]}."
            )
        sentences.append(text)
    verdict = (
        "not told" if None in verdicts else ("yes" if all(verdicts) else ("no" if not any(verdicts) else "in part"))
    )
    if summary.get("deposit_overlap_fraction") is not None:
        text = f"Deposits of the same packing cover each other by {number(100 * summary['deposit_overlap_fraction'])} % of the area that either covers"
        if summary.get("deposit_overlap_m2") is not None:
            text += f" ({number(summary['deposit_overlap_m2'], 'm²')} in common)"
        between = summary.get("deposit_overlap_fraction_between_seeds")
        text += f"; hard deposits of different seeds by {number(100 * between)} %." if between is not None else "."
        sentences.append(text)
    return verdict, sentences


def answer_costs(summary):
    """Sentences on which world costs less at equal accuracy: (verdict, sentences); the verdict is "hard", "soft" or
    "not told".
    """
    work = summary["work_precision"]
    found, sentences = work["against_hard"]["compared"], []
    verdict = "not told"
    if found:
        verdict = "hard" if found["factor"] > 1 else "soft"
        cheaper = found["factor"] if found["factor"] > 1 else 1 / found["factor"]
        where = (
            "the scatter over seeds, below which errors tell nothing"
            if found["at_scatter"]
            else "the smallest that both reach"
        )
        sentences.append(
            f"At equal accuracy (error {number(found['error'])} against the finest hard run: {where}) {verdict} costs less, by a factor "
            f"of {number(cheaper)}: "
            f"“{found['hard_label']}” against “{found['soft_label']}”."
        )
    own = work["against_own"]["compared"]
    if own:
        sentences.append(
            f"Each against the finest run of its own world, at an error of {number(own['error'])}: a factor of {number(own['factor'])}, "
            f"soft over hard."
        )
    return verdict, sentences + [s for s in answer_cost(summary) if s]


def answer_cost(summary):
    """Sentences on wall time for a second of simulation."""
    factor = summary["soft_over_hard_wall_equal_overlap"]
    if factor is not None:
        beyond = (
            " That stiffness was not run: the factor is extrapolated." if summary["equal_overlap_extrapolated"] else ""
        )
        yield (
            f"At equal mean overlap ({number(summary['overlap_hard_rel'], digits=2)} of the mean diameter, which takes a Young's modulus of "
            f"{number(summary['stiffness_equal_overlap_Pa'], 'Pa', 2)}) a second of simulation costs soft contacts {number(factor)} times the "
            f"wall time of hard ones.{beyond}"
        )
    rock = summary["soft_over_hard_wall_rock_stiffness"]
    if rock is not None:
        yield f"At a rock's stiffness, 10 GPa, {number(rock)} times" + (
            " (extrapolated)." if summary["rock_stiffness_extrapolated"] else "."
        )
