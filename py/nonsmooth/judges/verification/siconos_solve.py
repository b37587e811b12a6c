"""Asks the program oracle/siconos_solve of the build folder (tests/oracle) to solve a contact problem, of
the plane or of space.
"""

from __future__ import annotations

import json
import os
import subprocess
import time
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ... import contact

__all__ = ["Answer", "OracleError", "error_by_siconos", "program", "solve_with_ours", "solve_with_siconos"]

ROOT = Path(__file__).resolve().parents[4]  # of the source checkout


class OracleError(RuntimeError):
    """Siconos cannot be asked, or did not answer; the message says what is missing."""


@dataclass(frozen=True)
class Answer:
    """What one of the two solvers found, and what our own measure says of it."""

    solver: str
    impulse: np.ndarray  # (c, 3) [N s, N s, N m s], in space (c, 6)
    velocity: np.ndarray  # (b, 3) [m/s, m/s, rad/s], in space (b, 6)
    sweeps: int
    seconds: float  # of the solve alone
    converged: bool  # by the solver's own test
    own_error: float  # the figure of that test
    residual: contact.Residual


def program() -> Path:
    """Path of siconos_solve; raises OracleError where it was not built."""
    path = Path(os.environ.get("NONSMOOTH_BUILD", ROOT / "build")) / "oracle" / "siconos_solve"
    if not path.exists():
        raise OracleError(
            f"{path} is not there: install libsiconos-numerics-dev and build again with scripts/setup.sh --tests"
        )
    return path


def solve_with_siconos(problem, folder, tolerance, max_iterations, check_every=1, rolling=True) -> Answer:
    """Siconos's nonlinear Gauss-Seidel from a cold start, on one thread; files go into ``folder``.

    ``tolerance``: on the error of Siconos, the natural map in scaled units relative to the norm of q, or to that
    of p where it is larger and the solver is another than rolling_fc2d (tests/oracle/siconos_solve.cpp); without ``rolling`` torques are left out and the solver for friction alone is
    asked.
    """
    source, target = Path(folder) / "problem.h5", Path(folder) / "siconos.h5"
    contact.save(source, problem)
    said = _ask(
        source,
        target,
        "--tolerance",
        repr(float(tolerance)),
        "--max-iterations",
        int(max_iterations),
        "--check-every",
        check_every,
        *([] if rolling else ["--without-rolling"]),
    )
    answer = contact.load(target)
    return Answer(
        f"Siconos {said['siconos']}, {said['solver']}",
        answer.impulse,
        answer.velocity,
        said["iterations"],
        said["seconds"],
        said["info"] == 0,
        said["error"],
        contact.residual(problem, answer.impulse),
    )


def error_by_siconos(problem, folder, impulse) -> tuple[float, float]:
    """What Siconos's own stopping test says of impulses of shape (c, 3), in space (c, 6), whoever found them: its error,
    and the size that this is relative to, over that of the impulses in the same scaled units, to which ours is.
    """
    source = Path(folder) / "measured.h5"
    contact.save(source, replace(problem, impulse=impulse))
    said = _ask(source, "--measure")
    return said["error"], said["scale_over_p"]


def _ask(*arguments):
    """The line of JSON that siconos_solve prints."""
    # OpenBLAS would keep threads waiting for products of 3 by 3
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    done = subprocess.run([str(program()), *map(str, arguments)], capture_output=True, text=True, env=environment)
    try:
        return json.loads(done.stdout.splitlines()[-1])
    except (IndexError, ValueError):
        said = (done.stderr or done.stdout).strip()[-300:]
        raise OracleError(f"siconos_solve gave no answer (status {done.returncode}): {said}") from None


def solve_with_ours(problem, tolerance, max_iterations, method="accelerated", check_every=1, start="cold") -> Answer:
    """Our solver, on one thread. ``tolerance``: on the natural map relative to the rms impulse; ``start``: as
    :func:`contact.solve` takes it.
    """
    began = time.perf_counter()
    found = contact.solve(
        problem, method=method, tolerance=tolerance, max_iterations=max_iterations, check_every=check_every, start=start
    )
    seconds = time.perf_counter() - began
    name = "ours" if method == "accelerated" else "ours, plain Gauss-Seidel"
    return Answer(
        name,
        found.impulse,
        found.velocity,
        found.iterations,
        seconds,
        found.converged,
        found.relative,
        contact.residual(problem, found.impulse),
    )
