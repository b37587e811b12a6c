"""A soak: disks in a drum that turns, for very many steps. What creeps shows: overlaps, energy and memory must not
grow.

The drum is a closed polygon of segments that stays where it is, and gravity turns instead. That is the drum in its own
frame but for centrifugal, Coriolis and Euler forces, which are left out: they are ω²R/g of gravity (0.7 % by default),
or vanish. Walls that move would be one more source of error to tell from the others.
"""

from __future__ import annotations

import hashlib
import math
import random
import time
from pathlib import Path

import numpy as np

from yade import O
from yade.wrapper import NewtonIntegrator, NscdMat

from ...world import scene

__all__ = ["ROWS", "TURNS_TO_JUDGE", "WAYS", "judge", "run", "steps_of"]

ROWS = 40  # over a soak; each tells of the steps since the one before
GRAVITY = 9.81  # m/s²
TURN = 100.0  # s a turn
STEP = 5e-3  # s
FILLED = 0.5  # share of the drum's area that the disks take, pores included
FRACTION = 0.8  # of the disks' area in that, about
SIDES = 60  # of the polygon
TURNS_TO_JUDGE = 3
HELD = 10  # steps for which gravity keeps its direction, a fifth of a degree
WAYS = {
    "advance": "steps are made in the plugin's arrays, and shown each time gravity turns",
    "step": "O.step() for each, and so shown after each",
}


def run(disks, steps, seed=1, progress=lambda share, doing: None, way="advance"):
    """Turns a drum with ``disks`` disks (1 m wide, ± 20 %) for ``steps`` steps of 5 ms, one turn in 100 s; returns what
    JSON can hold.

    ``progress``: called with the share done and what is being done; ``way``: of WAYS. The scene is reset before. Rows
    hold, of every tenth step, the largest and the mean overlap [ℓ] and the mean kinetic energy [J]; what the energy
    balance misses as a share of all that was dissipated so far; the memory in use [MB]; sweeps; steps above the
    tolerance; and a checksum of bodies and contacts to the last bit, which is the same in both ways.
    """
    engine, newton, radius = _fill(disks, seed)
    began, rows = time.monotonic(), []
    for k in range(ROWS):
        worst, sums, count, sweeps, missed = 0.0, np.zeros(2), 0, engine.totalIterations, engine.unconverged
        first, end = steps * k // ROWS, steps * (k + 1) // ROWS
        for step in range(first, end, HELD):
            angle = 2 * math.pi * step * STEP / TURN
            newton.gravity = (-GRAVITY * math.sin(angle), -GRAVITY * math.cos(angle), 0)
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
                "inside": _inside(radius),
                "bits": _checksum(engine),
            }
        )
        progress((k + 1) / ROWS, f"{O.time / TURN:.1f} turns")
    return {
        "disks": disks,
        "steps": steps,
        "seed": seed,
        "way": way,
        "step_s": STEP,
        "turn_s": TURN,
        "drum_radius_m": radius,
        "froude": (2 * math.pi / TURN) ** 2 * radius / GRAVITY,
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
        grew.append(f"disks left the drum: {rows[0]['inside']} were in it, and {rows[-1]['inside']} are")
    return {"grew": grew, "ratios": ratios}


def steps_of(turns):
    """Steps that a number of turns takes."""
    return math.ceil(turns * TURN / STEP)


def memory():
    """Memory of this process that is in use [MB]."""
    line = next(line for line in Path("/proc/self/status").read_text().splitlines() if line.startswith("VmRSS"))
    return int(line.split()[1]) / 1024


def _fill(disks, seed):
    """A drum with disks that hang in it on a wide lattice; returns engine, integrator and the drum's radius [m]."""
    O.reset()
    dice = random.Random(seed)
    radii = [dice.uniform(0.4, 0.6) for _ in range(disks)]
    radius = math.sqrt(sum(r * r for r in radii) / (FRACTION * FILLED))
    stuff = NscdMat(density=2500, frictionAngle=math.atan(0.5), rollingFriction=0.05)
    O.materials.append(stuff)
    corners = [(radius * math.cos(a), radius * math.sin(a)) for a in 2 * math.pi / SIDES * np.arange(SIDES)]
    O.bodies.append(scene.segments(corners, stuff, sense=1, closed=True))
    pitch = 1.22  # wider than the widest disk
    reach = int(radius / pitch) + 1
    places = sorted(
        (
            (pitch * a, pitch * b)
            for a in range(-reach, reach + 1)
            for b in range(-reach, reach + 1)
            if math.hypot(pitch * a, pitch * b) < radius * math.cos(math.pi / SIDES) - 0.62
        ),
        key=lambda p: (p[1], p[0]),
    )
    if len(places) < disks:
        raise ValueError(f"{disks} disks: only {len(places)} have a place in their drum to begin with; give 60 or more")
    O.bodies.append([scene.disk(place, r, stuff) for place, r in zip(places, radii)])
    O.engines = scene.engines(gravity=(0, -GRAVITY, 0), reach=0.1)
    O.dt = STEP
    return scene.contact_dynamics(), next(e for e in O.engines if isinstance(e, NewtonIntegrator)), radius


def _checksum(engine):
    """Of all bodies and contacts, these in the order of ids."""
    contacts = np.frombuffer(engine.contactTable()).reshape(-1, 12)
    order = np.lexsort((contacts[:, :2].max(axis=1), contacts[:, :2].min(axis=1)))
    return hashlib.sha256(engine.bodyTable() + contacts[order].tobytes()).hexdigest()


def _inside(radius):
    return sum(1 for b in O.bodies if type(b.shape).__name__ == "Sphere" and b.state.pos.norm() < radius)
