#!/usr/bin/python3
"""Direct tension tests of a bonded rock: its tensile strength, where it breaks and how, as many tests at a time as
there are threads.

  scripts/tension_test.py [--material NAME|FILE] [--disks N …] [--seeds S …] [--inertia I …] [--out DIR] [--threads T] [--resume]
"""
import argparse
import sys
import time
from pathlib import Path

from tabulate import tabulate

if "yade" in sys.modules:  # started by the launcher
    from yade.nonsmooth import commands
    from yade.nonsmooth.commands import arguments
    from yade.nonsmooth.laboratory import materials, pressing, tension_campaign, tension_report, tension_test
    from yade.nonsmooth.system import output_folder
    from yade.nonsmooth.system.whole_files import write_json
else:  # YADE runs in processes of its own
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "py"))
    from nonsmooth import commands
    from nonsmooth.commands import arguments
    from nonsmooth.laboratory import materials, pressing, tension_campaign, tension_report, tension_test
    from nonsmooth.system import output_folder
    from nonsmooth.system.whole_files import write_json


def read_arguments():
    usual = tension_test.TensionTest
    parser = argparse.ArgumentParser(prog="tension_test.py", description=__doc__.partition("\n\n")[0])
    arguments.add_material(parser)
    parser.add_argument(
        "--disks",
        type=int,
        nargs="+",
        action=arguments.EachOnce,
        default=[2000],
        metavar="N",
        help="disks of a sample; several compare sizes (default: 2000)",
    )
    arguments.add_sample(parser)
    arguments.add_seeds(parser, [1, 2, 3, 4, 5], "seeds of the samples (default: 1 to 5)")
    parser.add_argument(
        "--inertia",
        type=arguments.positive,
        nargs="+",
        action=arguments.EachOnce,
        default=[usual.inertia],
        metavar="I",
        help=f"inertial number of the loading, the strain rate times √(m/σ_ext); several compare rates (default: {usual.inertia:g})",
    )
    parser.add_argument(
        "--grip",
        type=float,
        default=usual.grip,
        metavar="D",
        help="thickness of the parts at the platens whose bonds are ten times as strong, in mean diameters; 0: none (default: %(default)s)",
    )
    parser.add_argument(
        "--fallen",
        type=float,
        default=usual.fallen,
        metavar="SHARE",
        help="a test ends when its stress has fallen to this share of the peak (default: %(default)s)",
    )
    parser.add_argument(
        "--opening",
        type=arguments.positive,
        default=usual.opening,
        metavar="D",
        help="or when the platens have drawn apart by so many mean diameters (default: %(default)s)",
    )
    parser.add_argument(
        "--step", type=arguments.positive, default=usual.step, help="time step in √(m/σ_ext) (default: %(default)s)"
    )
    parser.add_argument(
        "--tolerance",
        type=arguments.positive,
        default=usual.tolerance,
        help="of the solver's residual (default: %(default)g)",
    )
    arguments.add_runs(parser, "out/tension", "tests")
    args = parser.parse_args()
    if args.diameter[0] > args.diameter[1]:
        parser.error(f"--diameter {args.diameter[0]:g} {args.diameter[1]:g}: give the smallest first")
    return args


def main():
    args, began = read_arguments(), time.monotonic()
    material, out = materials.load(args.material), Path(args.out)
    tests = [
        tension_test.TensionTest(
            material,
            pressing.Shape(disks, seed, *args.diameter, args.fraction, args.aspect),
            inertia,
            args.step,
            args.grip,
            args.fallen,
            args.opening,
            args.tolerance,
        )
        for disks in args.disks
        for inertia in args.inertia
        for seed in args.seeds
    ]
    output_folder.claim(out, "tension_test.py", args.resume)
    with arguments.bar() as progress:
        measured = tension_campaign.run(tests, out, args.threads, args.resume, progress)
    summary = tension_campaign.summarise(material, measured, time.monotonic() - began, args.threads)
    heads, rows = tension_report.table(summary)
    caption = f"Tension tests, seeds {', '.join(map(str, args.seeds))}; means with half of their 95 % interval"
    write_json(out / "summary.json", {**summary, "tables": [[caption, heads, rows]]})
    made = tension_report.draw(out, summary)
    print(tabulate(rows, heads, disable_numparse=True))
    print(f"results: {out}/summary.json, tests/*/series.csv, {', '.join(p.name for p in made)}")


commands.run(main, "what has ended is kept, go on with --resume")
