#!/usr/bin/env python3
"""Measures how fast steps and sweeps are on this machine, and writes benchmark.json.

  scripts/benchmark.py [--out DIR] [--quick] [--threads T] [--disks N] [--section FILE]
  scripts/benchmark.py --scale [N,N,…] [--out DIR] [--threads T] [--section FILE]
  scripts/benchmark.py --space [--out DIR] [--quick]
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
from yade.nonsmooth.judges.benchmark import report, scale, spheres, suite
from yade.nonsmooth.judges.benchmark.scale_figure import cost_by_size
from yade.nonsmooth.studies.slope import states
from yade.nonsmooth.system import machine, output_folder
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
        type=sizes,
        nargs="?",
        const=scale.SIZES,
        metavar="N,…",
        help=f"instead, how cost grows with size: numbers of disks (default: {','.join(map(str, scale.SIZES))}; the last one takes 10 to 20 minutes)",
    )
    parser.add_argument(
        "--space",
        action="store_true",
        help="instead, sweeps over 20,000 spheres beside those over disks: a minute or two",
    )
    args = parser.parse_args()
    if args.space and args.scale:
        parser.error("--space --scale: give one of them")
    if args.threads < 1:
        parser.error(f"--threads {args.threads}: give a whole number from 1")
    return args


def sizes(text):
    try:
        values = [int(part) for part in text.split(",")]
    except ValueError:
        values = [0]
    if min(values) < 1 or len(set(values)) < len(values):
        raise argparse.ArgumentTypeError(f"{text!r}: give numbers of disks, separated by commas, each once")
    return values


def measure_scale(args, out):
    for disks in args.scale:
        states.section_of(args.section, disks)
    with arguments.bar() as progress:
        found = scale.run(out, args.section, args.scale, args.threads, progress)
    write_json(out / "scale.json", found)
    print(report.scale_table(found))
    print(f"results: {out}/scale.json, {cost_by_size(found['sizes'], out / 'scale.png').name}")


def measure_space(args, out):
    found = spheres.headlines(spheres.measure((suite.QUICK if args.quick else suite.FULL).repeats))
    write_json(out / "space.json", {**found, "machine": machine.describe(), "quick": args.quick})
    print(report.space_table(found))
    print(f"results: {out}/space.json")


def main():
    args, began = read_arguments(), time.monotonic()
    out = Path(args.out)
    output_folder.claim(out, "benchmark.py")
    if args.scale:
        return measure_scale(args, out)
    if args.space:
        return measure_space(args, out)
    states.section_of(args.section, args.disks)  # refused before anything runs
    with arguments.bar() as progress:
        found = suite.run(
            out, args.section, args.disks, args.threads, suite.QUICK if args.quick else suite.FULL, progress
        )
    summary = {**report.summarise(found), "quick": args.quick, "wall_s": time.monotonic() - began}
    write_json(out / "benchmark.json", summary)
    print(report.table(summary))
    print(f"{summary['wall_s']:.0f} s of wall time; results: {out}/benchmark.json")


commands.run(main)
