#!/usr/bin/python3
"""The strengths of the rock and of the walls beside the paper's Table 1: biaxial tests and slides, as many at a time as
there are threads.

  scripts/table1.py [--disks N] [--seeds S …] [--confining MPA,…] [--material NAME|FILE] [--out DIR] [--threads T] [--resume]
"""
import argparse
import sys
from pathlib import Path

from tabulate import tabulate

if "yade" in sys.modules:  # started by the launcher
    from yade.nonsmooth import commands
    from yade.nonsmooth.commands import arguments
    from yade.nonsmooth.laboratory import biaxial_test, report, table1
    from yade.nonsmooth.system import output_folder
    from yade.nonsmooth.system.whole_files import write_json
else:  # YADE runs in processes of its own
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "py"))
    from nonsmooth import commands
    from nonsmooth.commands import arguments
    from nonsmooth.laboratory import biaxial_test, report, table1
    from nonsmooth.system import output_folder
    from nonsmooth.system.whole_files import write_json


def read_arguments():
    parser = argparse.ArgumentParser(prog="table1.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument(
        "--material",
        default="wwr",
        metavar="NAME|FILE",
        help="of the rock: wwr, the paper's weakly weathered rock (default), or a material file",
    )
    arguments.add_disks(parser, 5000, "disks of a sample")
    parser.add_argument(
        "--confining",
        type=arguments.pressures(2),
        default=[0.25, 0.5, 1, 2, 4, 8, 16],
        metavar="MPA,…",
        help="confining pressures [MPa] (default: 0.25 to 16)",
    )
    parser.add_argument(
        "--strain",
        type=arguments.positive,
        default=biaxial_test.BiaxialTest.strain,
        help="axial strain at the end (default: %(default)s)",
    )
    arguments.add_seeds(parser, [1, 2, 3, 4, 5], "seeds of the samples (default: 1 to 5)")
    parser.add_argument(
        "--slide-seeds",
        type=int,
        nargs="+",
        default=[1, 2],
        metavar="S",
        help="seeds of the blocks that slide on the walls (default: 1 2)",
    )
    parser.add_argument(
        "--slide-pressures",
        type=arguments.pressures(2),
        default=[0.25, 0.5, 1, 2],
        metavar="MPA,…",
        help="normal stresses on the walls [MPa] (default: 0.25,0.5,1,2)",
    )
    arguments.add_runs(parser, "out/table1", "tests")
    return parser.parse_args()


def main():
    args = read_arguments()
    out = Path(args.out)
    output_folder.claim(out, "table1.py", args.resume)
    with arguments.bar() as progress:
        told = table1.run(
            out,
            args.disks,
            args.seeds,
            [1e6 * p for p in args.confining],
            args.slide_seeds,
            [1e6 * p for p in args.slide_pressures],
            args.strain,
            args.material,
            args.threads,
            args.resume,
            progress,
        )
    report.draw(out / "rock", told["rock"])
    heads, rows = table1.table(told["rows"])
    caption = f"Table 1: {args.disks} disks, seeds {', '.join(map(str, args.seeds))}; means with half of their 95 % interval, the paper's values in brackets"
    tables = [[caption, heads, rows], ["Tests of the rock by pressure", *report.pressures(told["rock"])]]
    write_json(out / "table1.json", {**told, "tables": tables})
    print(tabulate(rows, heads, disable_numparse=True))
    print(f"results: {out}/table1.json, rock/*.png, rock/tests/*/series.csv, walls/tests/*/series.csv")


commands.run(main, "what has ended is kept, go on with --resume")
