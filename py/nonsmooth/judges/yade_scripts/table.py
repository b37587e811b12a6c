"""All of YADE's scripts, side by side in processes, and the table of what became of them."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import yaml
from tqdm import tqdm

from .one import OUTCOMES, run

__all__ = ["names", "run_all", "tables"]

_HEADER = [
    "script",
    "outcome",
    "time [s]",
    "steps",
    "soft: steps",
    "largest overlap [radii]",
    "soft: largest overlap",
    "apart [diameters]",
    "explained",
    "soft/hard wall time",
    "message",
]
NEAR = 0.1  # mean diameters, by which the spheres of both runs may lie apart on average ...
ENDS = 0.1  # of the time, by which both may end apart to be compared at all
CLOUDS = 0.05  # of the number of spheres, by which clouds of a script without a seed may differ
ENERGY = 0.1  # of the kinetic energy, by which it may differ where both ended by themselves, at an event of the script


def names(kind="plain", only=()):
    """Paths of the scripts of a ``kind`` (plain, periodic, clumps); those that hold one of the texts ``only``."""
    known = yaml.safe_load(Path(__file__).with_name("scripts.yaml").read_text())
    return [name for name in known[kind] if not only or any(text in name for text in only)]


def run_all(chosen, sources, steps, soft_limit, threads, limit=120):
    """Runs scripts hard, and then as they are for the same simulated time where ``soft_limit`` [s] of wall time is more
    than 0; a list of the dictionaries of one.run, with ``soft``: the numbers of the soft run or None, ``apart`` and
    ``explained``: see :func:`compared`; what is not explained "differs".
    """

    def one(name):
        row = run(name, sources, "hard", steps=steps, limit=limit)
        row["soft"] = None
        if row["outcome"] == "runs" and soft_limit > 0:
            row["soft"] = run(name, sources, "soft", time=row["found"]["simulated [s]"], limit=soft_limit)["found"]
        row["apart"], row["explained"], said = compared(row["found"], row["soft"])
        if said:
            row["outcome"], row["message"] = "differs", said
        return row

    with ThreadPoolExecutor(threads) as pool:
        return list(tqdm(pool.map(one, chosen), total=len(chosen), desc="scripts", unit="script"))


def compared(found, soft):
    """How far the spheres of a rigid run are from where those of the soft one are, how much of it is explained (both in
    mean diameters, None where there is nothing to compare), and a sentence on what is not, "" where all is.

    ``found``, ``soft``: numbers of one.run, or None. Apart are the spheres' mean places, or their spreads about these
    where that is more. Explained are a tenth of a diameter, the overlap of springs, and with damping λ what a body
    falls less in the time t, λ g t²/2, up to the way that the rigid ones have gone: NewtonIntegrator's damping slows
    a free fall too. Where both ended at different times, at an event that the script waits for, kinetic energies are
    compared.
    """
    if not found or not soft:
        return None, None, ""
    time, other = (one.get("simulated [s]", 0) for one in (found, soft))
    if abs(time - other) > max(ENDS * max(time, other), found.get("step [s]", 0)):
        energies = [one["kinetic energy [J]"] for one in (found, soft)]
        if abs(energies[0] - energies[1]) > ENERGY * max(energies):
            return (
                None,
                None,
                (
                    f"ended after {time:.3g} s with {energies[0]:.3g} J, the soft one after {other:.3g} s with {energies[1]:.3g} J"
                ),
            )
        return None, None, ""
    numbers = [one.get("spheres", 0) for one in (found, soft)]
    if found.get("factories") or not min(numbers) or max(numbers) - min(numbers) > CLOUDS * max(numbers):
        return None, None, ""
    size = found["mean diameter [m]"]
    names = [f"mean {axis} [m]" for axis in "xyz"]
    way = sum((found[name] - soft[name]) ** 2 for name in names) ** 0.5
    apart = max(way, abs(found["spread [m]"] - soft["spread [m]"])) / size
    fall = 0.5 * soft.get("damping", 0) * soft.get("gravity [m/s²]", 0) * other**2 / size
    explained = NEAR + 0.5 * soft["largest overlap [radii]"] + min(fall, found.get("way [m]", 0) / size)
    said = "" if apart <= explained else f"spheres lie {apart:.2g} diameters apart from those of the soft run"
    return apart, explained, said


def tables(rows):
    """[title, header, rows of texts] for documentation pages: a summary, and all scripts."""
    counts = [[what, str(sum(row["outcome"] == what for row in rows))] for what in OUTCOMES]
    return [["Outcomes", ["outcome", "scripts"], counts], ["Scripts", _HEADER, [_texts(row) for row in rows]]]


def _texts(row):
    found, soft = row["found"] or {}, row["soft"] or {}

    def number(of, name, form=".3g"):
        return format(of[name], form) if of.get(name) is not None else ""

    ratio = soft["wall time [s]"] / found["wall time [s]"] if soft and found.get("wall time [s]") else None
    return [
        row["script"],
        row["outcome"],
        number(found, "simulated [s]"),
        number(found, "steps", "d"),
        number(soft, "steps", "d"),
        number(found, "largest overlap [radii]", ".1e"),
        number(soft, "largest overlap [radii]", ".1e"),
        number(row, "apart", ".2g"),
        number(row, "explained", ".2g"),
        "" if ratio is None else f"{ratio:.3g}",
        row["message"],
    ]
