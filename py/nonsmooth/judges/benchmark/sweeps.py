"""Sweeps alone: wall time for each contact and sweep by every path of the solver, and the bound that memory sets.

Timed is a sweep of the accelerated method, extrapolation included and residuals not: the difference between two solves
of one problem that make 20 and 120 sweeps from no impulses and look at the residual at their ends only. By all paths
but "reference" and "double" they are sweeps in single precision. What a solve does once (layout, velocities anew)
cancels. The paths take turns, so that whatever else the machine does hits all of them.

The bound: a sweep reads every number of every block once and writes the impulses. Memory is streamed through by one
thread, which reads, changes and writes back each number; bytes are counted once.
"""

from __future__ import annotations

import numpy as np

from ... import contact
from ...measure.statistics import spread

__all__ = ["FEW", "MANY", "PATHS", "bandwidth", "measure", "sweep_seconds"]

FEW, MANY = 20, 120  # sweeps of the two solves
TOLERANCE = 1e-5  # the finest of single precision, and not met from no impulses in so few sweeps
#: Ways through the solver that are timed: name -> (path, threads, precision), see contact.solve.
PATHS = {
    "reference": ("reference", 1, "double"),
    "portable": ("portable", 1, "mixed"),
    "double": ("best", 1, "double"),
    "best": ("best", 1, "mixed"),
    "best_two_threads": ("best", 2, "mixed"),
}
MEMORY_BYTES = 256_000_000  # more than any cache
STREAM_BYTES = 1_000_000_000  # passed over in all, for each size of working set


def sweep_seconds(problem, path, threads, precision, start="cold"):
    """Wall time of one sweep over the ContactProblem [s]; ``start``: see contact.solve. Raises RuntimeError where one of
    the solves ended early.
    """

    def solve(sweeps):
        solved = contact.solve(
            problem,
            start=start,
            tolerance=TOLERANCE,
            max_iterations=sweeps,
            check_every=sweeps,
            threads=threads,
            path=path,
            precision=precision,
        )
        if solved.iterations != sweeps:
            raise RuntimeError(
                f"a solve made {solved.iterations} sweeps instead of {sweeps}: no contact of the problem acts, so its sweeps cannot be timed"
            )
        return solved.seconds

    # the better of two, since what a large solve does once (layout, memory anew) takes as long as many sweeps, and not
    # always as long
    return (min(solve(MANY), solve(MANY)) - min(solve(FEW), solve(FEW))) / (MANY - FEW)


def bandwidth(size):
    """Rates [byte/s] at which passes over so many bytes go through them, one a pass; shape (n,)."""
    import _nonsmooth_contact

    passes = int(min(max(STREAM_BYTES // size, 5), 1000))
    return size / np.array(_nonsmooth_contact.stream_seconds(int(size), passes))


def measure(folder, problem, repeats):
    """Times the sweeps of a problem's file, and memory; a function for processes.call."""
    import _nonsmooth_contact

    loaded = contact.load(problem)
    count, size = len(loaded.length), _nonsmooth_contact.bytes_per_contact
    seconds = {name: np.empty(repeats) for name in PATHS}
    for k in range(repeats):
        for name, way in PATHS.items():
            seconds[name][k] = sweep_seconds(loaded, *way)
    best = np.median(seconds["best"])
    cached, memory = (float(np.median(bandwidth(b))) for b in (max(size * count, 1e4), MEMORY_BYTES))
    return {
        "contacts": count,
        "bytes_per_contact": size,
        "working_set_MB": 1e-6 * size * count,
        "ns_per_contact": {name: spread(1e9 * s / count) for name, s in seconds.items()},
        # pairs of one turn, so that a slow moment of the machine does not count for one of them alone
        "speedup_over_reference": {
            name: spread(seconds["reference"] / s) for name, s in seconds.items() if name != "reference"
        },
        "speedup_two_threads": spread(seconds["best"] / seconds["best_two_threads"]),
        "bandwidth_GB_per_s": {"working_set": 1e-9 * cached, "memory": 1e-9 * memory},
        "fraction_of_bandwidth_bound": {
            "working_set": size * count / cached / best,
            "memory": size * count / memory / best,
        },
        "repeats": repeats,
    }
