#!/usr/bin/env python3
"""A soak: disks or spheres in a turning drum for very many steps. Overlap, energy and memory must not grow; the exit
status is 1 where one does.

  scripts/soak.py [--steps N] [--disks N | --spheres N] [--seed S] [--way advance|step] [--out FILE] [--threads T]
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

import argparse
from pathlib import Path

from yade.nonsmooth import commands
from yade.nonsmooth.commands import arguments
from yade.nonsmooth.judges.verification import soak
from yade.nonsmooth.system import machine, output_folder
from yade.nonsmooth.system.whole_files import write_json


def read_arguments():
    parser = argparse.ArgumentParser(prog="soak.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument(
        "--steps",
        type=int,
        default=1_000_000,
        metavar="N",
        help="time steps of 5 ms (default: %(default)s, half an hour)",
    )
    arguments.add_disks(parser, 500, "disks in the drum")
    parser.add_argument("--spheres", type=int, metavar="N", help="spheres in a drum in space, instead of disks")
    parser.add_argument("--seed", type=int, default=1, metavar="S", help="of their sizes (default: %(default)s)")
    parser.add_argument(
        "--way",
        choices=soak.WAYS,
        default="advance",
        help="; ".join(f"{name}: {what}" for name, what in soak.WAYS.items())
        + "; the bits are the same (default: %(default)s)",
    )
    parser.add_argument(
        "--out", default="out/soak.json", metavar="FILE", help="file for the result (default: %(default)s)"
    )
    arguments.add_threads(parser, "threads; one is enough for some hundred disks")
    args = parser.parse_args()
    if args.steps < 10 * soak.ROWS:
        parser.error(
            f"--steps {args.steps}: give {10 * soak.ROWS} or more, so that each of the {soak.ROWS} rows has some"
        )
    args.kind = "disks" if args.spheres is None else "spheres"
    args.grains = getattr(args, args.kind)
    if args.grains < 60:
        parser.error(f"--{args.kind} {args.grains}: give 60 or more, so that all find a place to fall from")
    return args


def main():
    args = read_arguments()
    out = Path(args.out)
    output_folder.claim(out.parent, "soak.py")
    with arguments.bar() as progress:
        found = soak.run(args.grains, args.steps, args.seed, progress, args.way, args.kind)
    write_json(out, {"machine": machine.describe(), **found})
    rows = found["rows"]
    first, last = rows[len(rows) // 10], rows[-1]
    print(
        f"{args.steps} steps of {args.grains} {args.kind}, {last['turns']:.1f} turns, {found['wall_s']:.0f} s of wall time. From step {first['step']} on: overlaps of at most "
        f"{max(row['overlap_worst_rel'] for row in rows[len(rows) // 10:]):.1e} of a diameter, {sum(row['unconverged'] for row in rows)} steps above the tolerance, "
        f"{last['energy_error_rel']:.1e} of what was dissipated missing in the energy balance, memory {first['memory_MB']:.1f} MB, then {last['memory_MB']:.1f} MB"
    )
    print(f"result: {out}")
    if found["grew"] is None:
        print(f"too few turns to judge by: {soak.TURNS_TO_JUDGE} take {soak.steps_of(soak.TURNS_TO_JUDGE)} steps")
        return
    print("last third over first: " + ", ".join(f"{name} {ratio:.3f}" for name, ratio in found["ratios"].items()))
    if found["grew"]:
        sys.exit("error: " + "; ".join(found["grew"]))
    print("nothing grew")


commands.run(main)
