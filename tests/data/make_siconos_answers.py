#!/usr/bin/env python3
"""Makes tests/data/siconos_clusters.h5, or siconos_spheres.h5: twenty random clusters of disks or of spheres, and what
Siconos answers (see README.md there).

  PYTHONPATH=build/python tests/data/make_siconos_answers.py [--spheres] [--out FILE]
"""
import argparse
import tempfile
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
from nonsmooth import contact
from nonsmooth.judges.verification import disk_problems
from nonsmooth.judges.verification.siconos_solve import solve_with_siconos
from nonsmooth.judges.verification.space import sphere_problems

from deflated import deflate

HERE = Path(__file__).resolve().parent
TOLERANCE = 1e-13  # on Siconos's own error; it stops where rounding lets it


def clusters(made_by):
    """Twenty clusters of 3 to 22 disks or spheres: those with an even number have friction alone, those with an odd one rolling
    resistance and cohesion too.
    """
    return [
        made_by.random_cluster(seed, 3 + seed, rolling=bool(seed % 2), cohesion=bool(seed % 2)) for seed in range(20)
    ]


def joined(problems):
    """One problem of many that do not know of each other; the last body of each is its floor."""
    kind, first = type(problems[0]), 0
    parts = {field.name: [] for field in fields(kind) if getattr(problems[0], field.name) is not None}
    for problem in problems:
        for name in parts:
            parts[name].append(getattr(problem, name) + (first if name == "body" else 0))
        first += len(problem.inverse_mass)
    step = parts.pop("time_step")[0]
    return kind(
        time_step=step, **{name: np.concatenate(arrays).astype(arrays[0].dtype) for name, arrays in parts.items()}
    )


def main():
    parser = argparse.ArgumentParser(prog="make_siconos_answers.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument("--spheres", action="store_true", help="spheres in space (default: disks in the plane)")
    parser.add_argument(
        "--out", type=Path, metavar="FILE", help="default: siconos_clusters.h5 or siconos_spheres.h5 here"
    )
    asked = parser.parse_args()
    made_by, name = (sphere_problems, "spheres") if asked.spheres else (disk_problems, "clusters")
    out = asked.out or HERE / f"siconos_{name}.h5"
    with tempfile.TemporaryDirectory() as folder:
        solved = []
        for number, problem in enumerate(clusters(made_by)):
            answer = solve_with_siconos(problem, folder, TOLERANCE, 1000000)
            print(
                f"{number}: {len(problem.length)} contacts, {answer.solver}, {answer.sweeps} sweeps, error {answer.own_error:.1e}, by our measure "
                f"{answer.residual.relative:.1e}"
            )
            solved.append(replace(problem, impulse=answer.impulse, velocity=answer.velocity))
        contact.save(Path(folder) / "joined.h5", joined(solved))
        deflate(Path(folder) / "joined.h5", out)
    print(f"{out}: {out.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main()
