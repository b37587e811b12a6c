#!/usr/bin/python3
"""Measures the table of calibrated rocks, from which a section takes contact parameters for a cohesion and an angle of
friction.

  scripts/rocks.py [--check | --add] [--disks N] [--frictions MU …] [--seeds S …] [--out DIR] [--threads T] [--resume]

The shipped table, py/nonsmooth/sections/rocks.json, is the rocks.json that it writes. With --add it measures the rocks
of --frictions alone, and those of the shipped table stay as they are. With --check it asks that table for rocks, and
measures them on other samples.
"""
import argparse
import sys
from pathlib import Path

from tabulate import tabulate

if "yade" in sys.modules:  # started by the launcher
    from yade.nonsmooth import commands
    from yade.nonsmooth.commands import arguments
    from yade.nonsmooth.figures import rock_table as figures
    from yade.nonsmooth.laboratory import rock_table
    from yade.nonsmooth.model import rocks
    from yade.nonsmooth.system import output_folder
    from yade.nonsmooth.system.whole_files import write_json
else:  # YADE runs in processes of its own
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "py"))
    from nonsmooth import commands
    from nonsmooth.commands import arguments
    from nonsmooth.figures import rock_table as figures
    from nonsmooth.laboratory import rock_table
    from nonsmooth.model import rocks
    from nonsmooth.system import output_folder
    from nonsmooth.system.whole_files import write_json


def read_arguments():
    parser = argparse.ArgumentParser(prog="rocks.py", description=__doc__.partition("\n\n")[0])
    kind = parser.add_mutually_exclusive_group()
    kind.add_argument(
        "--check", action="store_true", help="measure rocks that the shipped table was asked for, on samples of its own"
    )
    kind.add_argument(
        "--add", action="store_true", help="measure the rocks of --frictions, and keep those of the shipped table"
    )
    arguments.add_disks(parser, rock_table.COUNT, "disks of a sample")
    parser.add_argument(
        "--frictions",
        type=arguments.positive,
        nargs="+",
        default=list(rock_table.FRICTIONS),
        metavar="MU",
        help="friction coefficients of contacts (default: %(default)s)",
    )
    usual, checking = (" ".join(map(str, seeds)) for seeds in (rock_table.SEEDS, rock_table.CHECK_SEEDS))
    arguments.add_seeds(parser, None, f"seeds of the samples, two or more (default: {usual}; with --check {checking})")
    arguments.add_runs(parser, "out/rocks", "tests")
    args = parser.parse_args()
    if args.seeds is None:
        args.seeds = list(rock_table.CHECK_SEEDS if args.check else rock_table.SEEDS)
    for name, least in (("seeds", 2), ("frictions", 2)):
        values = getattr(args, name)
        if len(set(values)) < max(least, len(values)):
            parser.error(f"--{name} {' '.join(map(str, values))}: give {least} or more, each once")
    shipped = rocks.table()["samples"]
    if args.add and (args.seeds, args.disks) != (shipped["seeds"], shipped["disks"]):
        parser.error(
            f"--add with {args.disks} disks and seeds {' '.join(map(str, args.seeds))}: samples are compared with "
            f"those of the shipped table, which have {shipped['disks']} and {' '.join(map(str, shipped['seeds']))}; "
            "leave --disks and --seeds out"
        )
    return args


def main():
    args = read_arguments()
    out, command = Path(args.out), " ".join(["scripts/rocks.py", *sys.argv[1:]])
    output_folder.claim(out, "rocks.py", args.resume)
    usual = rock_table.entries(args.frictions, args.disks)
    if args.check:
        wanted = rock_table.checks(args.disks)
    else:
        wanted = usual if args.add else usual + rock_table.variants(args.disks)
    with arguments.bar() as progress:
        found = rock_table.run(out, wanted, args.seeds, args.threads, args.resume, progress)
    if args.check:
        told, path = rock_table.check(found, command), out / "rocks_check.json"
    else:
        made = rock_table.added if args.add else rock_table.table
        told, path = made(found[: len(usual)], found[len(usual) :], command), out / "rocks.json"
    write_json(path, told)
    if not args.check:
        figures.table(told, out / "rocks.png")
    for caption, heads, lines in told["tables"]:
        print(f"\n{caption}\n" + tabulate(lines, heads, disable_numparse=True))
    print(f"results: {path}, */tests/*/series.csv")


commands.run(main, "what has ended is kept, go on with --resume")
