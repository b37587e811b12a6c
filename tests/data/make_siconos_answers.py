#!/usr/bin/env python3
"""Makes tests/data/siconos_clusters.h5: twenty random clusters, and what Siconos answers (see README.md there).

  PYTHONPATH=build/python tests/data/make_siconos_answers.py [--out FILE]
"""
import argparse
import tempfile
from dataclasses import fields
from pathlib import Path

import numpy as np
from nonsmooth import contact
from nonsmooth.judges.verification import disk_problems
from nonsmooth.judges.verification.siconos_solve import solve_with_siconos

from deflated import deflate

HERE = Path(__file__).resolve().parent
TOLERANCE = 1e-13  # on Siconos's own error; it stops where rounding lets it


def clusters():
    """Twenty clusters of 3 to 22 disks: those with an even number have friction alone, those with an odd one rolling
    resistance and cohesion too.
    """
    return [
        disk_problems.random_cluster(seed, 3 + seed, rolling=bool(seed % 2), cohesion=bool(seed % 2))
        for seed in range(20)
    ]


def joined(problems):
    """One problem of many that do not know of each other; the last body of each is its floor."""
    first, parts = 0, {
        field.name: [] for field in fields(contact.ContactProblem) if field.name != "play"
    }  # none of them has any
    for problem in problems:
        for name in parts:
            parts[name].append(getattr(problem, name) + (first if name == "body" else 0))
        first += len(problem.inverse_mass)
    step = parts.pop("time_step")[0]
    return contact.ContactProblem(
        time_step=step, **{name: np.concatenate(arrays).astype(arrays[0].dtype) for name, arrays in parts.items()}
    )


def main():
    parser = argparse.ArgumentParser(prog="make_siconos_answers.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument(
        "--out", default=HERE / "siconos_clusters.h5", type=Path, metavar="FILE", help="default: %(default)s"
    )
    out = parser.parse_args().out
    with tempfile.TemporaryDirectory() as folder:
        solved = []
        for number, problem in enumerate(clusters()):
            answer = solve_with_siconos(problem, folder, TOLERANCE, 1000000)
            print(
                f"{number}: {len(problem.length)} contacts, {answer.solver}, {answer.sweeps} sweeps, error {answer.own_error:.1e}, by our measure "
                f"{answer.residual.relative:.1e}"
            )
            solved.append(
                contact.ContactProblem(**{**vars(problem), "impulse": answer.impulse, "velocity": answer.velocity})
            )
        contact.save(Path(folder) / "joined.h5", joined(solved))
        deflate(Path(folder) / "joined.h5", out)
    print(f"{out}: {out.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main()
