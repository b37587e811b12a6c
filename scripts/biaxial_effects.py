#!/usr/bin/env python3
"""Biaxial tests with other samples, disks, rates and steps: what the strength does not depend on, and what it does.

  scripts/biaxial_effects.py [--material NAME|FILE] [--disks N] [--seeds S …] [--out DIR] [--threads T] [--resume]
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

import argparse
from pathlib import Path

from tabulate import tabulate

from yade.nonsmooth import commands
from yade.nonsmooth.commands import arguments
from yade.nonsmooth.figures import biaxial as figures
from yade.nonsmooth.laboratory import effects, materials
from yade.nonsmooth.system import output_folder
from yade.nonsmooth.system.whole_files import write_json


def read_arguments():
    parser = argparse.ArgumentParser(prog="biaxial_effects.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument("--material", default="wwr", metavar="NAME|FILE", help="wwr (default), or a material file")
    arguments.add_disks(parser, effects.COUNT, "disks of the usual sample")
    parser.add_argument(
        "--confining",
        type=arguments.positive,
        default=effects.PRESSURE / 1e6,
        metavar="MPA",
        help="confining pressure [MPa] (default: %(default)g)",
    )
    arguments.add_seeds(parser, [1, 2, 3, 4], "seeds of the samples (default: 1 2 3 4)")
    parser.add_argument(
        "--only", nargs="+", choices=("disks", "diameter", "inertia", "step"), help="only these effects"
    )
    arguments.add_runs(parser, "out/biaxial_effects", "tests")
    return parser.parse_args()


def main():
    args = read_arguments()
    out = Path(args.out)
    material = materials.load(args.material)
    output_folder.claim(out, "biaxial_effects.py", args.resume)
    chosen = [
        e
        for e in effects.effects(material, args.seeds, args.disks, 1e6 * args.confining)
        if not args.only or e.name in args.only
    ]
    with arguments.bar() as progress:
        rows = effects.run(chosen, out, args.threads, args.resume, progress)
    heads, lines = effects.table(rows)
    told = {"confining_Pa": 1e6 * args.confining, "rows": rows, "tables": [["Effects", heads, lines]]}
    write_json(out / "summary.json", told)
    figures.effects(rows, out / "effects.png")
    print(tabulate(lines, heads))
    print(f"results: {out}/summary.json, effects.png")


commands.run(main, "what has ended is kept, go on with --resume")
