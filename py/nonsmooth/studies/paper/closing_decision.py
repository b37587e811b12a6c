"""Whether bonds that close freely become the default: the measure, which was written down before a test was made with
it, and what the tests say. Needs no YADE.

The paper does not say whether a bond that is made over a gap bears compression over it. The shipped one does, as a
strut; :doc:`/theory/law` has the other. A rock of other bonds meets the measure where it meets all of :data:`COUNTED`
and :data:`MEANS`, in one reading between one kind of platens, and loses none of the paper's numbers that the shipped
reading meets.
"""

from __future__ import annotations

from .reading_numbers import PAPER, PEAKS, SHIPPED, SHOWN

__all__ = ["CLOSING", "COUNTED", "MEANS", "SAMPLES", "table", "verdict", "verdicts"]

CLOSING = ("closing-0.015", "closing-0.02", "closing-0.025")  # the readings that may become the default
SHIPPED_PLATENS = "smooth"  # between which the shipped reading stands beside them
SAMPLES, DISKS = 5, 2000  # that the measure asks for: so many samples, of so many disks
LEAST = 4  # samples of them in which a criterion that is counted holds

#: {criterion: (what it says, of a sample under 8 MPa (reading_numbers.samples_of), lowest, highest)}, in at least LEAST
#: samples.
COUNTED = {
    "a": ("peak at 0.5 to 2 % of strain", "strain_peak", 0.005, 0.02),
    "b": ("two conjugate bands at 1 % of strain", "bands_at_1_percent", 2, 2),
}
#: {criterion: {number: (of the paper, what the mean over samples or slopes may differ by)}}.
MEANS = {
    "c": {"cohesion_peak_kPa": (88.0, 25.0), "friction_peak_deg": (38.5, 2.0)},
    "d": {"friction_residual_deg": (26.2, 2.0)},
    "e": {"water_highest_m": (22.5, 4.0)},
}

WHETHER = {True: "yes", False: "no", None: "undecided"}
WORDS = {name: SHOWN[name][0] if name in SHOWN else PEAKS for name in PAPER}


def verdict(row, shipped):
    """What the measure says of a reading. ``row``, ``shipped``: rows of :func:`.readings.run`, of the reading and of
    the shipped one.

    Returns a dictionary: ``name``, ``label``, ``platens``; ``criteria``, {criterion: {"found": text, "met": bool, None
    where nothing was run that tells it}}; ``lost``, numbers of PAPER that the shipped reading meets and this one does
    not; ``default``, whether it becomes the default: False where a criterion is not met or a number is lost, None where
    all that was tested is met but not all was tested. It is None too where not :data:`SAMPLES` samples of :data:`DISKS`
    disks were tested, which decide nothing.
    """
    samples = row["samples"]
    criteria = {}
    for key, (_, name, low, high) in COUNTED.items():
        count = sum(low <= sample[name] <= high for sample in samples)
        criteria[key] = {"found": f"{count} of {len(samples)}", "met": count >= LEAST if samples else None}
    for key, numbers in MEANS.items():
        found = ", ".join("–" if row[name] is None else f"{row[name]:.{SHOWN[name][1]}f}" for name in numbers)
        met = [row[n] is not None and abs(row[n] - wanted) <= allowed for n, (wanted, allowed) in numbers.items()]
        criteria[key] = {"found": found, "met": all(met) if all(_told(row, n) for n in numbers) else None}

    def meets(one, name):
        return one["misses"][name] is not None and abs(one["misses"][name]) <= 1

    lost = [name for name in PAPER if meets(shipped, name) and not meets(row, name) and _told(row, name)]
    met = [c["met"] for c in criteria.values()]
    default = False if False in met or lost else None if None in met else True
    # a packing has some per cent fewer or more disks than it was asked for
    asked = len(samples) == SAMPLES and all(abs(s["disks"] / DISKS - 1) < 0.1 for s in samples)
    return {
        "name": row["name"],
        "label": row["label"],
        "platens": row["platens"],
        "criteria": criteria,
        "lost": lost,
        "default": default if asked else None,
    }


def _told(row, name):
    """Whether what was run tells a number of a row. Slopes one of which did not fail have no mean, and were run."""
    return row[name] not in (None, []) or bool(row.get(f"{name}_each"))


def verdicts(rows):
    """A :func:`verdict` for each row of a reading of :data:`CLOSING`; none where the shipped reading is not among the
    rows of :func:`.readings.run`.
    """
    shipped = next((r for r in rows if (r["name"], r["platens"]) == (SHIPPED, SHIPPED_PLATENS)), None)
    return [verdict(r, shipped) for r in rows if r["name"] in CLOSING] if shipped else []


def table(found):
    """[title, heads, lines] of texts for what :func:`verdicts` returned, one or more."""
    heads = [f"{key}: {says}" for key, (says, *_) in COUNTED.items()]
    for key, numbers in MEANS.items():
        heads.append(f"{key}: " + ", ".join(f"{SHOWN[n][0]} {w:g} ± {a:g}" for n, (w, a) in numbers.items()))
    lines = [
        [
            v["label"],
            v["platens"],
            *(f"{c['found']}: {WHETHER[c['met']]}" for c in v["criteria"].values()),
            ", ".join(WORDS[name] for name in v["lost"]) or "none",
            WHETHER[v["default"]],
        ]
        for v in found
    ]
    return ["Closing bonds as the default", ["reading", "platens", *heads, "lost", "becomes the default"], lines]
