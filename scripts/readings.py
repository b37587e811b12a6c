#!/usr/bin/python3
"""What the paper leaves open, read in several ways: for each reading the strengths of the rock and the water that its
slope bears, beside the paper's.

  scripts/readings.py [--only NAME …] [--platens KIND …] [--disks N] [--samples N] [--seeds S …] [--confining MPA,…] [--strain E] [--no-slopes] [--out DIR] [--threads T] [--resume]
"""
import argparse
import sys
from pathlib import Path

from tabulate import tabulate

if "yade" in sys.modules:  # started by the launcher
    from yade.nonsmooth import commands
    from yade.nonsmooth.commands import arguments
    from yade.nonsmooth.studies.laboratory import biaxial_test
    from yade.nonsmooth.studies.paper import closing_decision, reading_numbers, readings, readings_figure as figures
    from yade.nonsmooth.system import output_folder
    from yade.nonsmooth.system.whole_files import write_json
else:  # YADE runs in processes of its own
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "py"))
    from nonsmooth import commands
    from nonsmooth.commands import arguments
    from nonsmooth.studies.laboratory import biaxial_test
    from nonsmooth.studies.paper import closing_decision, reading_numbers, readings, readings_figure as figures
    from nonsmooth.system import output_folder
    from nonsmooth.system.whole_files import write_json


def read_arguments():
    parser = argparse.ArgumentParser(prog="readings.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument(
        "--only",
        nargs="+",
        choices=tuple(readings.READINGS),
        metavar="NAME",
        help=f"only these readings: {', '.join(readings.READINGS)}",
    )
    parser.add_argument(
        "--platens",
        nargs="+",
        choices=readings.PLATENS,
        default=readings.PLATENS,
        metavar="KIND",
        help="between which samples are tested, where a reading does not say so itself: smooth, rough or both (default: both)",
    )
    arguments.add_disks(parser, 3000, "about how many disks of a slope")
    parser.add_argument(
        "--samples", type=int, default=2000, metavar="N", help="disks of a sample (default: %(default)s)"
    )
    arguments.add_seeds(parser, [1, 2, 3, 4, 5], "of slopes and samples (default: 1 to 5)")
    parser.add_argument(
        "--confining",
        type=arguments.pressures(),
        default=[p / 1e6 for p in readings.PRESSURES],
        metavar="MPA,…",
        help="confining pressures [MPa]; a single one tells no cohesion (default: 0.5, 4, 8 and 16)",
    )
    parser.add_argument(
        "--strain",
        type=arguments.positive,
        default=biaxial_test.BiaxialTest.strain,
        help="axial strain at the end of a test (default: %(default)s)",
    )
    parser.add_argument("--no-slopes", action="store_true", help="samples alone, no slopes under rising water")
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
            args.platens,
            args.strain,
            [1e6 * p for p in args.confining],
            not args.no_slopes,
            threads=args.threads,
            resume=args.resume,
            progress=progress,
        )
    found = closing_decision.verdicts(rows)
    tables = reading_numbers.tables(rows) + ([closing_decision.table(found)] if found else [])
    of = {name: {row["platens"]: row for row in rows if row["name"] == name} for name in chosen}
    told = {
        "disks": args.disks,
        "samples": args.samples,
        "seeds": args.seeds,
        "confining_MPa": args.confining,
        "strain": args.strain,
        "slopes": not args.no_slopes,
        "paper": reading_numbers.PAPER,
        "toe_water": reading_numbers.toe_water(),
        "rows": of,
        "closing": found,
        "tables": tables,
    }
    write_json(out / "readings.json", told)
    pictures = [figures.beside(rows, out / "readings.png"), *figures.stress_strain_of(rows, out)]
    for title, heads, lines in tables:
        print(f"{title}\n{tabulate(lines, heads)}\n")
    print(f"results: {out}/readings.json, {', '.join(picture.name for picture in pictures)}")


commands.run(main, "what has ended is kept, go on with --resume")
