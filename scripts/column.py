#!/usr/bin/env python3
"""Columns of grains that collapse, and piles: runout and final height against the aspect ratio, with hard or with soft
contacts.

  scripts/column.py [--aspect A,A,…] [--disks N] [--seeds S …] [--world hard|soft] [--out DIR] [--threads T] [--resume]
  scripts/column.py --kind pile --aspect 1 --disks 500
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

import argparse
from pathlib import Path

from yade.nonsmooth import commands, worlds
from yade.nonsmooth.commands import arguments
from yade.nonsmooth.figures import columns as figures, film
from yade.nonsmooth.heaps import grains, report, study
from yade.nonsmooth.system import output_folder
from yade.nonsmooth.system.whole_files import write_json

ASPECTS = "0.5,0.7,1,1.4,2,2.8,4,5.6,8,10"


def numbers(text):
    """Type of positive numbers with commas, each once."""
    return arguments.each_once(text, arguments.positive)


def read_arguments():
    usual = study.KINDS["column"]()
    parser = argparse.ArgumentParser(prog="column.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument(
        "--kind",
        choices=tuple(study.KINDS),
        default="column",
        help="a column that falls to one side, or a pile that loses both sides of its box (default: column)",
    )
    parser.add_argument(
        "--aspect",
        type=numbers,
        default=numbers(ASPECTS),
        metavar="A,…",
        help=f"height over width of columns; of piles, over half of the width (default: {ASPECTS})",
    )
    arguments.add_disks(
        parser, usual.disks, "disks of each; boxes of some hundred or fewer may miss it by some per cent, see the table"
    )
    arguments.add_seeds(parser, [1], "seeds of the packings (default: 1)")
    parser.add_argument(
        "--diameter", type=float, default=usual.diameter, metavar="M", help="mean diameter [m] (default: %(default)g)"
    )
    parser.add_argument(
        "--size-spread",
        type=float,
        default=usual.size_spread,
        metavar="K",
        help="largest over smallest diameter (default: %(default)g)",
    )
    parser.add_argument(
        "--friction", type=float, default=usual.friction, metavar="MU", help="of contacts (default: %(default)g)"
    )
    parser.add_argument(
        "--rolling-friction",
        type=float,
        default=usual.rolling_friction,
        metavar="MU",
        help="in units of the mean diameter of a pair; soft: with --model cohesion_moment alone (default: %(default)g)",
    )
    parser.add_argument(
        "--restitution",
        type=float,
        default=usual.restitution,
        metavar="E",
        help="of impacts; the soft world has none but what --damping leaves, and refuses another than 0 (default: %(default)g)",
    )
    parser.add_argument(
        "--base", choices=grains.BASES, default=usual.base, help="floor: a line, or glued disks (default: %(default)s)"
    )
    parser.add_argument("--base-friction", type=float, metavar="MU", help="of the floor (default: as --friction)")
    parser.add_argument(
        "--wall-friction",
        type=float,
        default=usual.wall_friction,
        metavar="MU",
        help="of the wall behind a column (default: %(default)g)",
    )
    parser.add_argument(
        "--packing",
        metavar="FILE",
        help="text file of x y r [m] to use instead of an own packing; --aspect, --disks, --seeds and sizes then do nothing",
    )
    arguments.add_world(parser, grains.PATH_PER_STEP, grains.TOLERANCE, "a free fall from the top")
    parser.add_argument("--stiffness", type=arguments.positive, metavar="PA", help="soft: Young's modulus [Pa]")
    parser.add_argument(
        "--damping", type=float, metavar="L", help=f"soft: YADE's damping of forces (default: {worlds.Soft.damping:g})"
    )
    parser.add_argument(
        "--damping-moving",
        type=float,
        metavar="L",
        help="soft: the same while the disks move, where it would brake them (default: as --damping)",
    )
    parser.add_argument(
        "--step-share",
        type=arguments.positive,
        metavar="S",
        help=f"soft: time step in units of its stability limit (default: {worlds.Soft.step_share:g})",
    )
    parser.add_argument(
        "--model",
        choices=("cohesion_moment", "jcfpm", "friction"),
        help=f"soft: contact model (default: {worlds.Soft.model})",
    )
    parser.add_argument(
        "--duration",
        type=arguments.positive,
        default=15.0,
        metavar="T",
        help="longest course, in units of √(H/g) (default: %(default)g)",
    )
    parser.add_argument(
        "--profiles",
        action="store_true",
        help="of columns: speed against height at three places behind the tip, at three times, over the seeds of each aspect ratio",
    )
    arguments.add_runs(parser, "out/column", "runs")
    args = parser.parse_args()
    if args.profiles and args.kind != "column":
        parser.error(
            f"--profiles with --kind {args.kind}: profiles are those behind the one tip of a column; leave it out, or take --kind column"
        )
    return args


def cases_of(args):
    """{name: (heap, world)} of the runs asked for."""
    shared = dict(
        diameter=args.diameter,
        size_spread=args.size_spread,
        friction=args.friction,
        rolling_friction=args.rolling_friction,
        restitution=args.restitution,
        base=args.base,
        base_friction=args.base_friction,
        wall_friction=args.wall_friction,
        disks=args.disks,
    )
    # those of the other world are handed over too: they are refused by name
    numerics = ("path", "tolerance", "stiffness", "damping", "damping_moving", "step_share", "model")
    given = {name: getattr(args, name) for name in numerics if getattr(args, name) is not None}
    world = dict(name=args.world, **given)
    kind = study.KINDS[args.kind]
    if args.packing:
        return {Path(args.packing).stem: (kind(**shared, packing=args.packing), world)}
    return {f"a{a:g}-seed{s}": (kind(**shared, aspect=a, seed=s), world) for a in args.aspect for s in args.seeds}


def main():
    args = read_arguments()
    out = Path(args.out)
    cases = cases_of(args)
    for heap, world in cases.values():  # before anything is computed
        study.world_of(heap, **world)
    output_folder.claim(out, "column.py", args.resume)
    with arguments.bar() as progress:
        found = study.run(
            cases,
            out,
            args.threads,
            args.resume,
            args.duration,
            lambda share: progress(share, f"{len(cases)} run{'s' if len(cases) > 1 else ''}"),
        )
    summary, folders = report.summarise(found), {name: out / "runs" / name for name in found}
    if args.kind == "column":
        summary["exponents_by_front"] = report.by_front(found, folders)
    if args.profiles:
        summary["profiles"] = report.profiles_by_aspect(cases, found, folders)
        summary["tables"] = [report.profiles_table(summary["profiles"])]
    write_json(out / "summary.json", summary)
    print(report.table(found, summary))
    drawn = []
    for name, (heap, _) in cases.items():
        folder = out / "runs" / name
        drawn.append(report.draw_collapse(heap, found[name], folder, folder / "collapse.png"))
    group = report.group(found)
    if (
        args.kind == "column" and len(set(group["aspect"])) > 1
    ):  # points beside the published laws, with fits where there are enough of them
        drawn.append(figures.runout({f"{report.counts(found)}, {args.world}": group}, out / "runout.png"))
    if args.profiles and summary["profiles"]:
        drawn.append(report.draw_profiles(summary["profiles"], cases, found, folders, out / "profiles.png"))
    films = (
        []
        if film.missing()
        else [report.film_collapse(cases[name][0], found[name], out / "runs" / name) for name in cases]
    )
    drawn += [path for path in films if path]
    if film.missing():
        print(f"no videos: {film.missing()}")
    print(f"results: {out}/summary.json, {', '.join(str(p) for p in drawn[-3:])}{' …' if len(drawn) > 3 else ''}")


commands.run(main, "what has ended is kept, go on with --resume")
