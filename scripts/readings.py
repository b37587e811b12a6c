#!/usr/bin/python3
"""What the paper leaves open, read in several ways: for each reading the strengths of the rock and the water that its slope bears, beside the paper's.

  scripts/readings.py [--only NAME …] [--disks N] [--samples N] [--seeds S …] [--out DIR] [--threads T] [--resume]
"""
import argparse
import sys
from pathlib import Path

from tabulate import tabulate

if "yade" in sys.modules:  # started by the launcher
    from yade.nonsmooth import commands, output_folder
    from yade.nonsmooth.figures import readings as figures
    from yade.nonsmooth.laboratory import arguments, readings
    from yade.nonsmooth.whole_files import write_json
else:  # YADE runs in processes of its own
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "py"))
    from nonsmooth import commands, output_folder
    from nonsmooth.figures import readings as figures
    from nonsmooth.laboratory import arguments, readings
    from nonsmooth.whole_files import write_json


def read_arguments():
    parser = argparse.ArgumentParser(prog="readings.py", description=__doc__.splitlines()[0])
    parser.add_argument(
        "--only",
        nargs="+",
        choices=tuple(readings.READINGS),
        metavar="NAME",
        help=f"only these readings: {', '.join(readings.READINGS)}",
    )
    parser.add_argument(
        "--disks", type=int, default=3000, metavar="N", help="about how many disks of a slope (default: %(default)s)"
    )
    parser.add_argument(
        "--samples", type=int, default=2000, metavar="N", help="disks of a sample (default: %(default)s)"
    )
    parser.add_argument(
        "--seeds", type=int, nargs="+", default=[1, 2, 3], metavar="S", help="of slopes and samples (default: 1 2 3)"
    )
    arguments.add_runs(parser, "out/readings", "runs")
    return parser.parse_args()


def main():
    args = read_arguments()
    out = Path(args.out)
    output_folder.claim(out, "readings.py", args.resume)
    chosen = {name: one for name, one in readings.READINGS.items() if not args.only or name in args.only}
    with arguments.bar() as progress:
        rows = readings.run(
            chosen,
            out,
            args.disks,
            args.samples,
            args.seeds,
            threads=args.threads,
            resume=args.resume,
            progress=progress,
        )
    heads, lines = readings.table(rows)
    told = {
        "disks": args.disks,
        "samples": args.samples,
        "seeds": args.seeds,
        "paper": readings.PAPER,
        "rows": rows,
        "tables": [["Readings", heads, lines]],
    }
    write_json(out / "readings.json", told)
    picture = figures.tradeoff(rows, out / "readings.png")
    print(tabulate(lines, heads))
    print(f"results: {out}/readings.json, {picture.name}")


commands.run(main, "what has ended is kept, go on with --resume")
