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
    "largest overlap [radii]",
    "weight held",
    "soft: weight held",
    "soft: steps",
    "soft/hard wall time",
    "message",
]


def names(kind="plain", only=()):
    """Paths of the scripts of a ``kind`` (plain, periodic, clumps); those that hold one of the texts ``only``."""
    known = yaml.safe_load(Path(__file__).with_name("scripts.yaml").read_text())
    return [name for name in known[kind] if not only or any(text in name for text in only)]


def run_all(chosen, sources, steps, soft_limit, threads, limit=120):
    """Runs scripts hard, and then as they are for the same simulated time where ``soft_limit`` [s] of wall time is more
    than 0; a list of the dictionaries of one.run, with ``soft``: the numbers of the soft run or None."""

    def one(name):
        row = run(name, sources, "hard", steps=steps, limit=limit)
        row["soft"] = None
        if row["outcome"] == "runs" and soft_limit > 0:
            row["soft"] = run(name, sources, "soft", time=row["found"]["simulated [s]"], limit=soft_limit)["found"]
        return row

    with ThreadPoolExecutor(threads) as pool:
        return list(tqdm(pool.map(one, chosen), total=len(chosen), desc="scripts", unit="script"))


def tables(rows):
    """[title, header, rows of texts] for documentation pages: a summary, and all scripts."""
    counts = [[what, str(sum(row["outcome"] == what for row in rows))] for what in OUTCOMES]
    return [["Outcomes", ["outcome", "scripts"], counts], ["Scripts", _HEADER, [_texts(row) for row in rows]]]


def _texts(row):
    found, soft = row["found"] or {}, row["soft"] or {}

    def number(of, name, form=".3g"):
        return format(of[name], form) if of.get(name) is not None else ""

    ratio = soft["wall time [s]"] / found["wall time [s]"] if soft and found.get("wall time [s]") else None
    ran = row["outcome"] == "runs"
    return [
        row["script"],
        row["outcome"],
        number(found, "simulated [s]") if ran else "",
        number(found, "steps", "d") if ran else "",
        number(found, "largest overlap [radii]", ".1e") if ran else "",
        number(found, "weight held [share]") if ran else "",
        number(soft, "weight held [share]"),
        number(soft, "steps", "d"),
        "" if ratio is None else f"{ratio:.3g}",
        row["message"],
    ]
