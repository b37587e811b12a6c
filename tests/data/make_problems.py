#!/usr/bin/env python3
"""Makes the contact problems of a slope that stand in tests/data: slope_t1.h5 and avalanche_t4.h5 (see README.md
there).

  tests/data/make_problems.py [--disks N] [--out DIR]
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", "scripts", "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

import argparse
import dataclasses
import tempfile
from pathlib import Path

from yade import O
from yade.nonsmooth import experiment, packing, records, section
from yade.nonsmooth.measure import characteristic_times

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from deflated import deflate

EVERY = 0.5  # s of the simulation between two problems that are kept for the choice


def arguments():
    parser = argparse.ArgumentParser(prog="make_problems.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument("--disks", type=int, default=1200, metavar="N", help="about N disks (default: %(default)s)")
    parser.add_argument(
        "--out",
        default=os.path.dirname(os.path.realpath(__file__)),
        metavar="DIR",
        help="default: the script's own folder",
    )
    parser.add_argument("--threads", type=int, metavar="T", help="threads; the result is the same with any number")
    return parser.parse_args()


def run(disks, folder):
    """Runs the shipped section; returns the characteristic times [s] and the problems by their time [s]."""
    chosen = section.load("jiufengershan").with_disks(disks)
    experiment_run = experiment.begin(chosen, folder, packing=packing.cached_pack(chosen))
    problems = {}

    def keep(stage, now, foreseen):
        steps = round(EVERY / O.dt)
        if stage == "water" and O.iter % steps == 0:
            problems[now] = folder / f"step-{O.iter:08d}.h5"
            experiment_run.slope.solver.dump(str(problems[now]))
        if O.iter % (20 * steps) == 0:
            print(f"{stage}: {now:.0f} of about {foreseen:.0f} s", flush=True)

    experiment_run.progress = keep
    experiment_run.run()
    times = characteristic_times.of_run(
        records.since_settled(records.read_series(folder / "series.csv")),
        chosen,
        dataclasses.asdict(experiment_run.state),
    )
    return times, problems


def main():
    args = arguments()
    with tempfile.TemporaryDirectory() as folder:
        times, problems = run(args.disks, Path(folder))
        print(times)
        for name, at in (("slope_t1.h5", times["t1"]), ("avalanche_t4.h5", times["t4"])):
            if at is None:
                sys.exit(f"error: the slope did not reach the moment of {name}")
            last = max(t for t in problems if t < at + 0.5 * O.dt)
            target = Path(args.out) / name
            deflate(problems[last], target)
            print(f"{target}: t = {last:.2f} s, {target.stat().st_size / 1000:.0f} kB")


main()
