"""How cost grows with size: slopes from thousands to a million disks, each packed, bonded and loaded by its weight in a
process of its own.

These slopes are not settled, which would take hours for the largest. The time step shrinks with the diameters, so that
contacts are known as many diameters ahead as in the section itself; the tolerance is that of the moving slope. What
memory such a slope takes in YADE's own hands, with bonded soft contacts (CohFrictMat) and an InsertionSortCollider, is
measured beside it.
"""

from __future__ import annotations

import dataclasses
import time
from pathlib import Path

from yade import O

from ... import contact, packing
from ...measure.statistics import spread
from ...packing import files as packing_files
from ...studies.slope import slope, states
from ...studies.slope.measuring import MeasuringCourse
from ...system import machine
from ...world import worlds
from ...world.stepping import advance
from . import cold_start, sweeps
from .steps import TimedSteps

__all__ = ["SIZES", "measure", "measure_soft_memory", "measure_sweeps", "run"]

SIZES = (5000, 20_000, 100_000, 1_000_000)
PROBLEM, PACKING = "step.h5", "packing.npz"
LOADING, STEPS = 60, 40  # steps before those that are timed, and those
REPEATS = 9  # timings of a sweep
COLD_CONTACTS = 500_000  # of the largest problem that is solved from zero impulses as far as cold_start asks
SOFT_DISKS = 100_000  # of the largest slope of soft contacts: their bonds are made in Python
SOFT_YOUNG = 1e9  # Pa; of no influence on memory


def measure(folder, source, disks, steps=STEPS):
    """One size; a function for processes.call. Leaves its packing and its last contact problem in ``folder``.

    Raises section.SectionError or packing.PackingError where the disks do not go in.
    """
    chosen = states.section_of(source, disks)
    numerics = dataclasses.replace(
        chosen.numerics, time_step=chosen.numerics.time_step * chosen.scale, tolerance=chosen.numerics.tolerance_moving
    )
    chosen = dataclasses.replace(chosen, numerics=numerics)
    began = time.perf_counter()
    packed = packing.pack(chosen)  # not from the cache: how long it takes is asked
    packing_s = time.perf_counter() - began
    packing_files.save(packed, Path(folder) / PACKING)
    before, began = machine.resident_bytes(), time.perf_counter()
    solver = slope.build(chosen, packed).solver
    advance(view=False)
    bonds, building_s = solver.bond(), time.perf_counter() - began
    timed = TimedSteps().run(0, warm_up=LOADING)
    begun = solver.totalIterations
    timed.run(steps, warm_up=0)
    grown = machine.resident_bytes() - before
    solver.view()  # from here on all contacts have interactions
    memory = {
        "bytes_per_disk": grown / len(packed),
        "bytes_per_contact": grown / solver.candidates,
        "bytes_per_contact_viewed": (machine.resident_bytes() - before) / solver.candidates,
    }
    return {
        "disks": len(packed),
        "candidates": solver.candidates,
        "bonds": bonds,
        "packing_s": packing_s,
        "building_s": building_s,
        **memory,
        **timed.summary(),
        "sweeps_mean": (solver.totalIterations - begun) / steps,
        "time_step_s": O.dt,
        "steps": LOADING + steps,
        **_dumped(solver, Path(folder) / PROBLEM),
    }


def _dumped(solver, path):
    """Writes the present contact problem; what it takes from zero impulses, see cold_start."""
    solver.dump(str(path))
    problem = contact.load(path)
    return {"cold_start": cold_start.solve_cold(problem)} if len(problem.length) <= COLD_CONTACTS else {}


def measure_soft_memory(folder, source, disks, packed):
    """Memory for each disk of a slope with bonded soft contacts, the file ``packed`` its packing, before it is loaded;
    a function for processes.call.

    Returns {"contacts", "bytes_per_disk"}.
    """
    chosen, packed = states.section_of(source, disks), packing_files.load(packed)
    before = machine.resident_bytes()
    # fragile bonds are YADE's own; others need an engine of ours
    world = worlds.Soft(
        stiffness=SOFT_YOUNG,
        diameter=(chosen.disks.d_min, chosen.disks.d_max),
        verlet=-chosen.numerics.verlet_distance,
        fragile=True,
    )
    built = slope.build(chosen, packed, world)
    advance()
    built.solver.bond()
    advance()  # and no more: bonds that break would leave fewer contacts in the same memory
    grown, contacts = machine.resident_bytes() - before, O.interactions.countReal()
    return {"contacts": contacts, "bytes_per_disk": grown / len(packed)}


def measure_sweeps(folder, problems, threads):
    """Times the sweeps of the problems' files in turns, so that a slow moment of the machine does not count for one of
    them alone; a function for processes.call. Returns {"sweeps": [{threads: spread of ns for each contact} for each
    file]}."""
    loaded = [contact.load(path) for path in problems]
    counts = sorted({1, threads})
    found = [{str(n): [] for n in counts} for _ in loaded]
    for _ in range(REPEATS):
        for problem, times in zip(loaded, found):
            for n in counts:
                times[str(n)].append(1e9 * sweeps.sweep_seconds(problem, "best", n, "mixed") / len(problem.length))
    return {"sweeps": [{n: spread(values) for n, values in times.items()} for times in found]}


def run(out, source, sizes, threads, progress=lambda share, doing: None):
    """Measures all sizes, one after the other; returns a dictionary that JSON can hold. Raises states.BenchmarkError
    with the first failure.
    """
    sizes = sorted(sizes)
    seconds, of_soft = {size: 10 + 1e-3 * size for size in sizes}, {
        size: 5 + 3e-4 * size for size in sizes if size <= SOFT_DISKS
    }
    of_sweeps = 5 + 1e-4 * sum(sizes)
    course = MeasuringCourse(out, sum(seconds.values()) + sum(of_soft.values()) + of_sweeps, progress)
    found, problems = [], []
    for size in sizes:
        home, asked = course.home / f"scale-{size}", {"source": source, "disks": size}
        found.append(course.call(home.name, seconds[size], measure, asked, threads))
        problems.append(home / PROBLEM)
        packed = home / PACKING
        if size in of_soft:
            found[-1]["soft_memory"] = course.call(
                f"scale-soft-{size}", of_soft[size], measure_soft_memory, {**asked, "packed": str(packed)}, threads
            )
        packed.unlink()
    timed = course.call(
        "scale-sweeps",
        of_sweeps,
        measure_sweeps,
        {"problems": [str(path) for path in problems], "threads": threads},
        threads,
    )
    for path in problems:
        path.unlink()  # the largest has half a gigabyte
    return {
        "machine": machine.describe(),
        "section": source,
        "threads": threads,
        "sizes": [{**one, "sweep_ns_per_contact": times} for one, times in zip(found, timed["sweeps"])],
    }
