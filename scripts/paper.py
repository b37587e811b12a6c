#!/usr/bin/python3
"""The paper's avalanche beside control runs: the shipped slope with and without weakening, with other releases from
water, and with a table that stops at t1; numbers and figures.

  scripts/paper.py [--only NAME …] [--disks N] [--seeds S …] [--out DIR] [--threads T] [--resume]
"""
import argparse
import sys
from pathlib import Path

from tabulate import tabulate

if "yade" in sys.modules:  # started by the launcher
    from yade.nonsmooth import commands
    from yade.nonsmooth.commands import arguments
    from yade.nonsmooth.studies.paper import paper_figures, paper_slopes
    from yade.nonsmooth.system import output_folder
    from yade.nonsmooth.system.whole_files import write_json
else:  # YADE runs in processes of its own
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "py"))
    from nonsmooth import commands
    from nonsmooth.commands import arguments
    from nonsmooth.studies.paper import paper_figures, paper_slopes
    from nonsmooth.system import output_folder
    from nonsmooth.system.whole_files import write_json


def read_arguments():
    parser = argparse.ArgumentParser(prog="paper.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument(
        "--only",
        nargs="+",
        choices=tuple(paper_slopes.VARIANTS),
        default=list(paper_slopes.VARIANTS),
        metavar="NAME",
        help=f"only these slopes: {', '.join(paper_slopes.VARIANTS)}",
    )
    arguments.add_disks(parser, paper_slopes.DISKS, "about how many disks of a slope")
    arguments.add_seeds(parser, list(paper_slopes.SEEDS), "of the packings (default: 1 2 3 4 5)")
    arguments.add_runs(parser, "out/paper", "runs")
    return parser.parse_args()


def main():
    args = read_arguments()
    out = Path(args.out)
    paper_slopes.check(args.only, args.disks, args.seeds)
    output_folder.claim(out, "paper.py", args.resume)
    with arguments.bar() as progress:
        found = paper_slopes.run(
            args.only,
            out,
            args.disks,
            args.seeds,
            threads=args.threads,
            resume=args.resume,
            progress=lambda share, ended: progress(share, f"{ended} slopes have ended"),
        )
    rows = paper_slopes.rows(found)
    changes, (heads, lines) = paper_slopes.changes(rows), paper_slopes.table(rows)
    told = {
        "disks": args.disks,
        "seeds": args.seeds,
        "slopes": {row["name"]: row for row in rows},
        "changes": {row["name"]: row for row in changes},
        "tables": [
            ["The shipped slope and its control runs", heads, lines],
            ["Characteristic times, counted from t0", *paper_slopes.table(rows, paper_slopes.TIMES)],
            [
                "Changes from the shipped slope of the same packing",
                *paper_slopes.table(changes, paper_slopes.TIMES | paper_slopes.CHANGES),
            ],
        ],
    }
    write_json(out / "paper_slopes.json", told)
    pictures = paper_figures.draw(found, out)
    print(tabulate(lines, heads))
    print(f"results: {', '.join([f'{out}/paper_slopes.json', *(path.name for path in pictures)])}")


commands.run(main, "what has ended is kept, go on with --resume")
