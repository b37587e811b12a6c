#!/usr/bin/env python3
"""Measures how fast steps and sweeps are on this machine, and writes benchmark.json.

  scripts/benchmark.py [--out DIR] [--quick] [--threads T] [--disks N] [--section FILE]
"""
import os, sys
if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

import argparse
import json
import time
from pathlib import Path

from yade.nonsmooth import packing, records, section
from yade.nonsmooth.benchmark import report, states, suite
from yade.nonsmooth.laboratory import arguments
from yade.nonsmooth.packing_files import write_atomically


def read_arguments():
    parser = argparse.ArgumentParser(prog="benchmark.py", description=__doc__.splitlines()[0])
    parser.add_argument("--out", default="out/benchmark", metavar="DIR", help="folder for the results (default: %(default)s)")
    parser.add_argument("--quick", action="store_true", help="fewer steps and repetitions: minutes, quartiles a little wider")
    parser.add_argument("--threads", type=int, default=os.cpu_count(), metavar="T", help="threads of the steps, besides one (default: all cores)")
    parser.add_argument("--disks", type=int, default=20000, metavar="N", help="disks of the slope (default: %(default)s)")
    parser.add_argument("--section", default="jiufengershan", metavar="FILE", help="a section file with walls DP and FB, or the name of a shipped one")
    return parser.parse_args()


def main():
    args, began = read_arguments(), time.monotonic()
    out = Path(args.out)
    records.check_writable(out)
    states.section_of(args.section, args.disks)  # refused before anything runs
    with arguments.bar() as progress:
        found = suite.run(out, args.section, args.disks, args.threads, suite.QUICK if args.quick else suite.FULL, progress)
    summary = {**report.summarise(found), "quick": args.quick, "wall_s": time.monotonic() - began}
    write_atomically(out / "benchmark.json", json.dumps(summary, indent=1).encode())
    print(report.table(summary))
    print(f"{summary['wall_s']:.0f} s of wall time; results: {out}/benchmark.json")


try:
    main()
except (section.SectionError, packing.PackingError, records.RecordsError, states.BenchmarkError) as error:
    sys.exit(f"error: {error}")
