"""How cost grows with size: slopes from thousands to a million disks, each packed, bonded and loaded by its weight in a process of its own.

These slopes are not settled, which would take hours for the largest. The time step shrinks with the diameters, so that contacts are known as many
diameters ahead as in the section itself; the tolerance is that of the moving slope.
"""

from __future__ import annotations

import dataclasses
import os
import time
from pathlib import Path

from yade import O

from .. import contact, packing, slope
from . import cold_start, machine, states, sweeps
from .course import Course
from .statistics import spread
from .steps import TimedSteps

__all__ = ["SIZES", "measure", "run"]

SIZES = (5000, 20_000, 100_000, 1_000_000)
LOADING, STEPS = 60, 40  # steps before those that are timed, and those
REPEATS = 5              # timings of a sweep
COLD_CONTACTS = 500_000  # of the largest problem that is solved from zero impulses as far as cold_start asks


def _resident():
    """Memory of this process [byte]."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def measure(folder, source, disks, threads, steps=STEPS):
    """One size; a function for processes.call. Raises section.SectionError or packing.PackingError where the disks do not go in."""
    chosen = states.section_of(source, disks)
    numerics = dataclasses.replace(chosen.numerics, time_step=chosen.numerics.time_step * chosen.scale, tolerance=chosen.numerics.tolerance_moving)
    chosen = dataclasses.replace(chosen, numerics=numerics)
    began = time.perf_counter()
    packed = packing.pack(chosen)  # not from the cache: how long it takes is asked
    packing_s = time.perf_counter() - began
    before, began = _resident(), time.perf_counter()
    solver = slope.build(chosen, packed).solver
    scene = _scene_alone(solver) - before
    O.step()
    bonds, building_s = solver.bond(), time.perf_counter() - began
    timed = TimedSteps().run(0, warm_up=LOADING)
    begun = solver.totalIterations
    timed.run(steps, warm_up=0)
    memory = {"bytes_per_disk": (_resident() - before) / len(packed), "bytes_per_contact": (_resident() - before) / solver.candidates,
              "bytes_per_contact_scene": scene / solver.candidates}
    return {"disks": len(packed), "candidates": solver.candidates, "bonds": bonds, "packing_s": packing_s, "building_s": building_s, **memory,
            **timed.summary(), "sweeps_mean": (solver.totalIterations - begun) / steps, "time_step_s": O.dt, "steps": LOADING + steps,
            **_sweeps(solver, Path(folder) / "step.h5", threads)}


def _scene_alone(solver):
    """Makes a step so short that nothing moves, without the solver, which leaves interactions and no contact problem; memory of the process then [byte]."""
    step, O.dt, solver.dead = O.dt, 1e-9 * O.dt, True
    O.step()
    O.dt, solver.dead = step, False
    return _resident()


def _sweeps(solver, dumped, threads):
    """Sweeps of the present contact problem, as sweeps.measure has them, and from zero impulses, see cold_start."""
    solver.dump(str(dumped))
    problem = contact.load(dumped)
    dumped.unlink()
    count = len(problem.length)
    time_of = lambda threads: spread([1e9 * sweeps.sweep_seconds(problem, "best", threads) / count for _ in range(REPEATS)])  # noqa: E731
    found = {"sweep_ns_per_contact": {str(n): time_of(n) for n in sorted({1, threads})}}
    if count <= COLD_CONTACTS:
        found["cold_start"] = cold_start.solve_cold(problem)
    return found


def run(out, source, sizes, threads, progress=lambda share, doing: None):
    """Measures all sizes, one after the other; returns a dictionary that JSON can hold. Raises states.BenchmarkError with the first failure."""
    seconds = {size: 5 + 3e-3 * size for size in sizes}
    course = Course(out, sum(seconds.values()), progress)
    return {"machine": machine.describe(), "section": source, "threads": threads,
            "sizes": [course.call(f"scale-{size}", seconds[size], measure, {"source": source, "disks": size, "threads": threads}, threads) for size in sorted(sizes)]}
