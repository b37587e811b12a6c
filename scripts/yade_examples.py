#!/usr/bin/python3
"""Runs YADE's own scripts with rigid contacts, and writes which run, what they show, and which are refused.

  scripts/yade_examples.py [--kind plain|periodic|clumps] [--only TEXT …] [--steps N] [--soft S] [--sources DIR] [--out DIR] [--threads T]
"""
import argparse
import sys
from pathlib import Path

from tabulate import tabulate

if "yade" in sys.modules:  # started by the launcher
    from yade.nonsmooth import commands
    from yade.nonsmooth.commands import arguments
    from yade.nonsmooth.judges.yade_scripts import table
    from yade.nonsmooth.system import cache
    from yade.nonsmooth.system.whole_files import write_json
else:  # YADE runs in processes of its own
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "py"))
    from nonsmooth import commands
    from nonsmooth.commands import arguments
    from nonsmooth.judges.yade_scripts import table
    from nonsmooth.system import cache
    from nonsmooth.system.whole_files import write_json


def read_arguments():
    parser = argparse.ArgumentParser(
        description="Runs YADE's own scripts (examples, tutorial, checks) with rigid contacts, each in a process, bounded in steps, and writes yade_scripts.json: which run, what they show beside the soft run, and which are refused with what message."
    )
    parser.add_argument(
        "--kind", choices=("plain", "periodic", "clumps"), default="plain", help="which list (default: plain)"
    )
    parser.add_argument("--only", nargs="+", default=(), metavar="TEXT", help="scripts whose path holds one of these")
    parser.add_argument(
        "--steps", type=int, default=300, metavar="N", help="most rigid steps of a script (default: %(default)s)"
    )
    parser.add_argument(
        "--soft",
        type=float,
        default=0,
        metavar="S",
        help="also run each as it is, for the same simulated time, up to S seconds of wall time (default: not)",
    )
    parser.add_argument(
        "--sources", type=Path, metavar="DIR", help="YADE's sources (default: those that the set-up has fetched)"
    )
    parser.add_argument(
        "--out",
        type=Path,
        default=Path("out/yade_scripts"),
        metavar="DIR",
        help="folder for the results (default: %(default)s)",
    )
    parser.add_argument("--threads", type=int, default=1, metavar="T", help="scripts at a time (default: 1)")
    return parser.parse_args()


def main():
    chosen = read_arguments()
    sources = chosen.sources or next(iter(sorted(cache.folder("packings").parent.glob("yade-*-source"))), None)
    if sources is None or not (sources / "examples").is_dir():
        sys.exit(
            f"yade_examples.py: there are no sources of YADE in {sources}: give --sources, or run scripts/setup.sh, which fetches them"
        )
    names = table.names(chosen.kind, chosen.only)
    if not names:
        sys.exit(f"yade_examples.py: no script's path holds {' or '.join(chosen.only)}")
    rows = table.run_all(names, sources, chosen.steps, chosen.soft, chosen.threads)
    made = table.tables(rows)
    chosen.out.mkdir(parents=True, exist_ok=True)
    write_json(
        chosen.out / "yade_scripts.json", {"kind": chosen.kind, "steps": chosen.steps, "scripts": rows, "tables": made}
    )
    for _, header, texts in made:
        print(tabulate([[text[:70] for text in row] for row in texts], headers=header), "\n")
    print(f"written: {chosen.out / 'yade_scripts.json'}")


if __name__ == "__main__":
    main()
