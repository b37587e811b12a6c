#!/usr/bin/env python3
"""Measures how fast steps and sweeps are on this machine, and writes benchmark.json.

  scripts/benchmark.py [--out DIR] [--quick] [--threads T] [--disks N] [--section FILE]
  scripts/benchmark.py --scale [N,N,…] [--out DIR] [--threads T] [--section FILE]
  scripts/benchmark.py --space [N,N,…] [--out DIR] [--quick] [--threads T]
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

import argparse
import time
from pathlib import Path

from yade.nonsmooth import commands
from yade.nonsmooth.commands import arguments
from yade.nonsmooth.judges.benchmark import report, scale, space_report, space_suite, suite
from yade.nonsmooth.judges.benchmark.scale_figure import cost_by_size
from yade.nonsmooth.studies.slope import states
from yade.nonsmooth.system import output_folder
from yade.nonsmooth.system.whole_files import write_json


def read_arguments():
    parser = argparse.ArgumentParser(prog="benchmark.py", description=__doc__.partition("\n\n")[0])
    arguments.add_out(parser, "out/benchmark")
    parser.add_argument(
        "--quick", action="store_true", help="fewer steps and repetitions: minutes, quartiles a little wider"
    )
    arguments.add_threads(parser, "threads of the steps, besides one")
    arguments.add_disks(parser, 20000, "disks of the slope")
    parser.add_argument(
        "--section",
        default="jiufengershan",
        metavar="FILE",
        help="a section file with walls DP and FB, or the name of a shipped one",
    )
    parser.add_argument(
        "--scale",
        type=sizes("disks"),
        nargs="?",
        const=scale.SIZES,
        metavar="N,…",
        help=f"instead, how cost grows with size: numbers of disks (default: {','.join(map(str, scale.SIZES))}; the last one takes 10 to 20 minutes)",
    )
    parser.add_argument(
        "--space",
        type=sizes("spheres"),
        nargs="?",
        const=space_suite.SIZES,
        metavar="N,…",
        help=f"instead, spheres in space: sweeps, steps beside soft ones, and a hundred steps of beds of so many (default: {','.join(map(str, space_suite.SIZES))})",
    )
    args = parser.parse_args()
    if args.space and args.scale:
        parser.error("--space --scale: give one of them")
    if args.threads < 1:
        parser.error(f"--threads {args.threads}: give a whole number from 1")
    return args


def sizes(grains):
    """Type of numbers of ``grains``, in words, with commas between them."""

    def read(text):
        try:
            values = [int(part) for part in text.split(",")]
        except ValueError:
            values = [0]
        if min(values) < 1 or len(set(values)) < len(values):
            raise argparse.ArgumentTypeError(f"{text!r}: give numbers of {grains}, separated by commas, each once")
        return values

    return read


def measure_scale(args, out):
    for disks in args.scale:
        states.section_of(args.section, disks)
    with arguments.bar() as progress:
        found = scale.run(out, args.section, args.scale, args.threads, progress)
    write_json(out / "scale.json", found)
    print(report.scale_table(found))
    print(f"results: {out}/scale.json, {cost_by_size(found['sizes'], out / 'scale.png').name}")


def measure_space(args, out, began):
    with arguments.bar() as progress:
        found = space_suite.run(out, args.space, args.threads, suite.QUICK if args.quick else suite.FULL, progress)
    summary = space_report.summarise({**found, "quick": args.quick, "wall_s": time.monotonic() - began})
    report.keep(out / "benchmark.json", summary, space=True)
    print(space_report.table(summary))
    print(f"{summary['space']['wall_s']:.0f} s of wall time; results: {out}/benchmark.json")


def main():
    args, began = read_arguments(), time.monotonic()
    out = Path(args.out)
    output_folder.claim(out, "benchmark.py")
    if args.scale:
        return measure_scale(args, out)
    if args.space:
        return measure_space(args, out, began)
    states.section_of(args.section, args.disks)  # refused before anything runs
    with arguments.bar() as progress:
        found = suite.run(
            out, args.section, args.disks, args.threads, suite.QUICK if args.quick else suite.FULL, progress
        )
    summary = {**report.summarise(found), "quick": args.quick, "wall_s": time.monotonic() - began}
    report.keep(out / "benchmark.json", summary, space=False)
    print(report.table(summary))
    print(f"{summary['wall_s']:.0f} s of wall time; results: {out}/benchmark.json")


commands.run(main)
