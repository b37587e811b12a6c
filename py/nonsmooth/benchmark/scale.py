"""How cost grows with size: slopes from thousands to a million disks, each packed, bonded and loaded by its weight in a process of its own.

These slopes are not settled, which would take hours for the largest. The time step shrinks with the diameters, so that contacts are known as many
diameters ahead as in the section itself; the tolerance is that of the moving slope.
"""

from __future__ import annotations

import dataclasses
import os
import time

from yade import O

from .. import packing, slope
from . import machine, states
from .course import Course
from .steps import TimedSteps

__all__ = ["SIZES", "measure", "run"]

SIZES = (5000, 20_000, 100_000, 1_000_000)
LOADING, STEPS = 10, 20  # steps before those that are timed, and those


def _resident():
    """Memory of this process [byte]."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def measure(folder, source, disks, steps=STEPS):
    """One size; a function for processes.call. Raises section.SectionError or packing.PackingError where the disks do not go in."""
    chosen = states.section_of(source, disks)
    numerics = dataclasses.replace(chosen.numerics, time_step=chosen.numerics.time_step * chosen.scale, tolerance=chosen.numerics.tolerance_moving)
    chosen = dataclasses.replace(chosen, numerics=numerics)
    began = time.perf_counter()
    packed = packing.pack(chosen)  # not from the cache: how long it takes is asked
    packing_s = time.perf_counter() - began
    before, began = _resident(), time.perf_counter()
    solver = slope.build(chosen, packed).solver
    O.step()
    bonds, building_s = solver.bond(), time.perf_counter() - began
    timed = TimedSteps().run(0, warm_up=LOADING)
    sweeps, solving = solver.totalIterations, solver.stageSeconds[1]
    timed.run(steps, warm_up=0)
    sweeps, solving = solver.totalIterations - sweeps, solver.stageSeconds[1] - solving
    return {"disks": len(packed), "candidates": solver.candidates, "bonds": bonds, "packing_s": packing_s, "building_s": building_s,
            "bytes_per_disk": (_resident() - before) / len(packed), **timed.summary(), "sweeps_mean": sweeps / steps,
            # layout, residuals and velocities anew are part of it
            "solve_ns_per_contact_and_sweep": 1e9 * solving / max(sweeps, 1) / solver.candidates, "time_step_s": O.dt, "steps": steps}


def run(out, source, sizes, threads, progress=lambda share, doing: None):
    """Measures all sizes, one after the other; returns a dictionary that JSON can hold. Raises states.BenchmarkError with the first failure."""
    seconds = {size: 5 + 3e-3 * size for size in sizes}
    course = Course(out, sum(seconds.values()), progress)
    return {"machine": machine.describe(), "section": source, "threads": threads,
            "sizes": [course.call(f"scale-{size}", seconds[size], measure, {"source": source, "disks": size}, threads) for size in sorted(sizes)]}
