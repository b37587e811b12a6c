"""A soak: disks or spheres in a drum that turns, for very many steps. What creeps shows: overlaps, energy and memory must
not grow.

The drum stays where it is, and gravity turns instead. That is the drum in its own frame but for centrifugal, Coriolis
and Euler forces, which are left out: they are ω²R/g of gravity (0.7 % of 500 disks), or vanish. Walls that move would
be one more source of error to tell from the others.
"""

from __future__ import annotations

import math
import time
from pathlib import Path

import numpy as np

from yade import O

from . import soak_drums

__all__ = ["ROWS", "TURNS_TO_JUDGE", "WAYS", "judge", "run", "steps_of"]

ROWS = 40  # over a soak; each tells of the steps since the one before
TURN = 100.0  # s a turn
TURNS_TO_JUDGE = 3
HELD = 10  # steps for which gravity keeps its direction, a fifth of a degree
WAYS = {
    "advance": "steps are made in the plugin's arrays, and shown each time gravity turns",
    "step": "O.step() for each, and so shown after each",
}


def run(grains, steps, seed=1, progress=lambda share, doing: None, way="advance", kind="disks"):
    """Turns a drum with ``grains`` disks or spheres (1 m wide, ± 20 %) for ``steps`` steps of 5 ms, one turn in 100 s;
    returns what JSON can hold.

    ``kind``: of soak_drums.KINDS; ``progress``: called with the share done and what is being done; ``way``: of WAYS. The scene is reset before. Rows
    hold, of every tenth step, the largest and the mean overlap [ℓ] and the mean kinetic energy [J]; what the energy
    balance misses as a share of all that was dissipated so far; the memory in use [MB]; sweeps; steps above the
    tolerance; and a checksum of bodies and contacts to the last bit, which is the same in both ways.
    """
    drum, step_s = soak_drums.KINDS[kind](grains, seed), soak_drums.STEP
    engine = drum.engine
    began, rows = time.monotonic(), []
    for k in range(ROWS):
        worst, sums, count, sweeps, missed = 0.0, np.zeros(2), 0, engine.totalIterations, engine.unconverged
        first, end = steps * k // ROWS, steps * (k + 1) // ROWS
        for step in range(first, end, HELD):
            drum.turn_to(2 * math.pi * step * step_s / TURN)
            if way == "step":
                for _ in range(min(HELD, end - step)):
                    O.step()
            else:
                engine.advance(min(HELD, end - step))
            worst, count = max(worst, engine.overlapWorst), count + 1
            sums += engine.kineticEnergy, engine.overlapMean
        lost = engine.slidingLoss + engine.rollingLoss + engine.impactLoss
        rows.append(
            {
                "step": O.iter,
                "turns": O.time / TURN,
                "overlap_worst_rel": worst,
                "overlap_mean_rel": sums[1] / count,
                "kinetic_J": sums[0] / count,
                "dissipated_J": lost,
                "energy_error_rel": engine.energyError / lost if lost > 0 else 0.0,
                "memory_MB": memory(),
                "sweeps_mean": (engine.totalIterations - sweeps) / (end - first),
                "unconverged": engine.unconverged - missed,
                "inside": drum.inside(),
                "bits": drum.checksum(),
            }
        )
        progress((k + 1) / ROWS, f"{O.time / TURN:.1f} turns")
    return {
        kind: grains,
        "steps": steps,
        "seed": seed,
        "way": way,
        "step_s": step_s,
        "turn_s": TURN,
        "drum_radius_m": drum.radius,
        "froude": (2 * math.pi / TURN) ** 2 * drum.radius / soak_drums.GRAVITY,
        "wall_s": time.monotonic() - began,
        "rows": rows,
        **judge(rows),
    }


def judge(rows):
    """Whether nothing grew: {"grew": [what did, in words], "ratios": {name: last third over the first}}, with the first
    tenth, in which the drum fills, left out.

    {"grew": None} where the drum has turned too little to tell.
    """
    if rows[-1]["turns"] < TURNS_TO_JUDGE:
        return {"grew": None, "ratios": {}}
    settled = rows[len(rows) // 10 :]
    third = max(1, len(settled) // 3)
    ratios, grew = {}, []
    # A drum's flow is uneven: means of a third of it differ by some per cent, a largest value by more, and more than
    # that may be chance where both are small. Memory is measured to a megabyte or so.
    for name, most, small in (
        ("overlap_worst_rel", 2.0, 1e-3),
        ("overlap_mean_rel", 1.25, 1e-5),
        ("kinetic_J", 1.25, 0),
        ("sweeps_mean", 1.25, 0),
        ("memory_MB", 1.02, 0),
    ):
        gather = max if name == "overlap_worst_rel" else lambda values: sum(values) / len(values)
        first, last = (gather([row[name] for row in part]) for part in (settled[:third], settled[-third:]))
        ratios[name] = last / first if first > 0 else 1.0
        if not (ratios[name] <= most or last <= small):
            grew.append(f"{name}: {first:.4g} in the first third, {last:.4g} in the last")
    errors = [abs(row["energy_error_rel"]) for row in settled]
    if not max(errors[-third:]) <= max(1.25 * max(errors[:third]), 1e-3):
        grew.append(
            f"energy_error_rel: {max(errors[:third]):.2g} of what was dissipated in the first third, {max(errors[-third:]):.2g} in the last"
        )
    if not all(row["inside"] == rows[0]["inside"] for row in rows):
        grew.append(f"grains left the drum: {rows[0]['inside']} were in it, and {rows[-1]['inside']} are")
    return {"grew": grew, "ratios": ratios}


def steps_of(turns):
    """Steps that a number of turns takes."""
    return math.ceil(turns * TURN / soak_drums.STEP)


def memory():
    """Memory of this process that is in use [MB]."""
    line = next(line for line in Path("/proc/self/status").read_text().splitlines() if line.startswith("VmRSS"))
    return int(line.split()[1]) / 1024
