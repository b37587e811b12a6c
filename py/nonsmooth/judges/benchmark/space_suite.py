"""All measurements of spheres in space, each in a YADE process of its own, one after the other."""

from __future__ import annotations

from pathlib import Path

from ...studies.slope.measuring import MeasuringCourse
from ...system import machine
from . import scale, sphere_bed, sphere_steps, spheres, steps
from .sphere_steps import PROBLEM

__all__ = ["SIZES", "run"]

SIZES = (100_000,)
LAYERS = 27  # of the spheres on which sweeps are timed, and as many along each side
FLAT = (300, 100)  # columns and rows of the disks beside them


def run(
    out, sizes, threads, effort, progress=lambda share, doing: None, bed=sphere_bed.SPHERES, layers=LAYERS, flat=FLAT
):
    """Times sweeps in space beside those in the plane, hard and soft steps of a bed of ``bed`` spheres, and those of
    beds of ``sizes`` spheres; returns everything as a dictionary that JSON can hold (see space_report.summarise).

    ``effort``: a suite.Effort, whose steps are those of all turns; ``out``: folder that keeps each process's log below
    ``runs``; ``layers``, ``flat``: see spheres.measure; ``progress``: called with the share done and what is being
    done. Raises states.BenchmarkError with the first failure.
    """
    counts, sizes = sorted({1, threads}), sorted(sizes)
    each = steps.BLOCK * -(-effort.steps // (effort.turns * steps.BLOCK))
    seconds = {
        "sweeps": 5 + 1.5e-4 * effort.repeats * layers**3,
        "bed": 10 + 0.02 * bed,
        "steps": 5 + effort.turns * (6 + 1e-5 * bed * (each + steps.WARM_UP) * 6),
        **{size: 10 + 1e-3 * size for size in sizes},
        "size-sweeps": 5 + 1e-4 * sum(sizes),
    }
    course = MeasuringCourse(out, sum(seconds.values()) + (len(counts) - 1) * seconds["steps"], progress)
    found = {"machine": machine.describe(), "threads": threads}
    found["sweeps"] = course.call(
        "space-sweeps",
        seconds["sweeps"],
        spheres.measure,
        {"repeats": effort.repeats, "columns": layers, "rows": layers, "flat": list(flat)},
        2,
    )
    home = course.home / "space-bed"
    found["bed"] = course.call(home.name, seconds["bed"], sphere_bed.make, {"spheres": bed}, threads)
    found["steps"], found["ratios"] = [], {}
    for count in counts:
        asked = {"states": str(home), "steps": each, "turns": effort.turns, "threads": count}
        timed = course.call(f"space-steps-{count}", seconds["steps"], sphere_steps.measure, asked, count)
        found["steps"] += timed["steps"]
        found["ratios"][str(count)] = timed["ratios"]
    found["sizes"], problems = [], []
    for size in sizes:
        asked = {"states": str(home), "spheres": size}
        found["sizes"].append(course.call(f"space-{size}", seconds[size], sphere_steps.measure_size, asked, threads))
        problems.append(course.home / f"space-{size}" / PROBLEM)
    if sizes:
        asked = {"problems": [str(path) for path in problems], "threads": threads}
        timed = course.call("space-size-sweeps", seconds["size-sweeps"], scale.measure_sweeps, asked, threads)
        found["sizes"] = [{**one, "sweep_ns_per_contact": ns} for one, ns in zip(found["sizes"], timed["sweeps"])]
    for path in problems:
        Path(path).unlink()  # that of a million spheres has some gigabytes
    return found
