"""Steps of spheres in space, hard and soft in turns; and how their cost and memory grow with the number of spheres."""

from __future__ import annotations

import time
from pathlib import Path

from ... import contact
from ...measure.statistics import spread
from ...system import machine
from . import sphere_bed, sweeps
from .steps import of_scene, summarise

__all__ = ["LOADING", "PROBLEM", "STEPS", "measure", "measure_size"]

LOADING, STEPS = 60, 40  # of a large bed: steps before those that are timed, and those
PROBLEM = "step.h5"


def measure(folder, states, steps, turns, threads):
    """Times so many steps of each state that sphere_bed.make has left in the folder ``states``, all in turns, ``turns``
    times, each from the saved state; a function for processes.call. ``threads``: those of this process, for the sweeps
    alone.

    Returns {"steps": a dictionary for each state, "ratios": {name: spread} of one turn each}. A hard state has
    ``sweeps_ms`` too: what its sweeps take of a step, their number times one sweep of the last step's problem from
    what that step began with, timed in the same turn; and ``solve_without_sweeps_ms``, mean: what else the solve does.
    """
    rows, turn_ms, sweeps_ms = ({name: [] for name in sphere_bed.NAMES} for _ in range(3))
    told, problem = {}, Path(folder) / PROBLEM
    for turn in range(turns):
        for name in sphere_bed.NAMES[:: 1 if turn % 2 == 0 else -1]:
            sphere_bed.load(states, name)
            timed, told[name] = of_scene(steps)
            rows[name] += timed.rows
            turn_ms[name].append(timed.summary()["step_ms"]["median"])
            if timed.solver:
                timed.solver.dump(str(problem))
                each = sweeps.sweep_seconds(contact.load(problem), "best", threads, "mixed", "warm")
                sweeps_ms[name].append(1e3 * told[name]["sweeps_mean"] * each)
    problem.unlink()
    found = [{"state": name, "threads": threads, **summarise(rows[name]), **told[name]} for name in sphere_bed.NAMES]
    for one in found:
        if one["state"] in sphere_bed.HARD:
            one["sweeps_ms"] = spread(sweeps_ms[one["state"]])
            one["solve_without_sweeps_ms"] = one["stage_ms"]["solve"]["mean"] - one["sweeps_ms"]["mean"]
    return {"steps": found, "ratios": _ratios(turn_ms, told)}


def _ratios(turn_ms, told):
    """A hard step over a soft one of the same turn, and the same for a second of simulation: {name: spread}."""
    found = {}
    for name in sphere_bed.HARD:
        for young in sphere_bed.YOUNGS:
            soft = sphere_bed.softened(name, young)
            over = [hard / other for hard, other in zip(turn_ms[name], turn_ms[soft])]
            longer = told[name]["time_step_s"] / told[soft]["time_step_s"]
            found[f"step_over_{soft}"] = spread(over)
            found[f"second_over_{soft}"] = spread([one / longer for one in over])
    return found


def measure_size(folder, states, spheres, steps=STEPS):
    """A bed of so many spheres, copies of the one at rest in the folder ``states`` beside each other, which takes up its
    weight from no forces in LOADING steps; ``steps`` more are timed. A function for processes.call. Leaves its last
    contact problem in ``folder``.

    Memory is what the process grows by, with what YADE keeps for each contact and with the bodies, or without what
    these had before the first step.
    """
    packed = sphere_bed.tiled(sphere_bed.load_packed(states), spheres)
    before, began = machine.resident_bytes(), time.perf_counter()
    solver = sphere_bed.hard_scene(packed)
    building_s, began = time.perf_counter() - began, time.perf_counter()
    bodies = machine.resident_bytes() - before
    timed, told = of_scene(steps, LOADING)
    stepping_s, grown = time.perf_counter() - began, machine.resident_bytes() - before
    solver.view()
    viewed = machine.resident_bytes() - before
    solver.dump(str(Path(folder) / PROBLEM))
    return {
        "spheres": spheres,
        "building_s": building_s,
        "stepping_s": stepping_s,
        "bytes_per_contact": grown / solver.candidates,
        "bytes_per_contact_viewed": viewed / solver.candidates,
        "bytes_per_contact_without_bodies": (grown - bodies) / solver.candidates,
        "bytes_per_sphere": grown / spheres,
        **timed.summary(),
        **told,
        "steps": LOADING + steps,
    }
