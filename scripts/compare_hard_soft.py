#!/usr/bin/env python3
"""The same experiment with rigid disks (Contact Dynamics) and with YADE's soft contacts, side by side.

  scripts/compare_hard_soft.py --scenario slope [--disks N] [--stiffness PA,PA,…] [--seeds S …] [--out DIR] [--threads T] [--resume]
  scripts/compare_hard_soft.py --cost [--disks N] [--stiffness PA,PA,…] [--out DIR] [--threads T] [--resume]
"""
import os, sys
if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

import argparse
from pathlib import Path

from yade.nonsmooth import errors, records
from yade.nonsmooth.comparison import cost, cost_report, course
from yade.nonsmooth.laboratory import arguments


OPTIONS = {"slope": ("end",), "biaxial": ("confining", "strain", "sides", "platens"), "column": ("aspect", "friction", "base"),
           "pile": ("aspect", "friction", "base")}


def stiffnesses(text):
    """Young's moduli [Pa], with commas."""
    try:
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r}: give Young's moduli [Pa] with commas, as 1e8,1e9,1e10") from None


def read_arguments():
    parser = argparse.ArgumentParser(prog="compare_hard_soft.py", description=__doc__.splitlines()[0])
    parser.add_argument("--scenario", choices=course.SCENARIOS, default="slope", help="the experiment (default: %(default)s)")
    parser.add_argument("--source", metavar="NAME|FILE", help="section of the slope, or material of the biaxial test, instead of the scenario's own")
    parser.add_argument("--disks", type=int, metavar="N", help="about so many disks (default: the scenario's)")
    parser.add_argument("--stiffness", type=stiffnesses, metavar="PA,…", help="Young's moduli [Pa] (default: the scenario's, three decades)")
    parser.add_argument("--ensemble-stiffness", type=arguments.positive, metavar="PA",
                        help="the one that runs with every seed (default: the scenario's, or the upper middle one of --stiffness); others run with the first")
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3, 4, 5], metavar="S", help="seeds of the packings (default: 1 2 3 4 5)")
    parser.add_argument("--model", choices=("cohesion_moment", "jcfpm", "friction"), default="cohesion_moment", help="YADE's law (default: %(default)s)")
    parser.add_argument("--bonds", choices=("ductile", "fragile"), default="ductile",
                        help="of soft runs: yielding before they break, as in the hard law, or breaking at once (default: %(default)s)")
    parser.add_argument("--damping", type=float, default=0.2, metavar="L", help="of soft runs at rest, non-viscous (default: %(default)s, YADE's own)")
    parser.add_argument("--damping-moving", type=float, default=0.02, metavar="L", help="while the mass moves, where it would brake it (default: "
                                                                                        "%(default)s)")
    parser.add_argument("--step-share", type=arguments.positive, default=0.8, metavar="S", help="time step of soft runs in units of its stability "
                                                                                                "limit (default: %(default)s)")
    parser.add_argument("--without", nargs="+", choices=course.PARTS, default=[], metavar="PART",
                        help="leave out: numerics (hard runs of other steps and tolerances), damping, bonds (one soft run each)")
    parser.add_argument("--cost", action="store_true", help="instead, time steps of the paper's slope (20000 disks) in both worlds on all threads, "
                                                            "one process after the other")
    parser.add_argument("--steps", type=int, default=300, metavar="N", help="with --cost: steps that are timed (default: %(default)s)")
    parser.add_argument("--end", type=arguments.positive, metavar="SECONDS", help="slope: simulated time after settling, at most")
    parser.add_argument("--confining", type=arguments.positive, metavar="MPA", help="biaxial: confining pressure [MPa] (default: 1)")
    parser.add_argument("--strain", type=arguments.positive, help="biaxial: axial strain at the end (default: 0.06)")
    parser.add_argument("--sides", choices=("rigid", "flexible"), help="biaxial: lateral boundaries (default: flexible)")
    parser.add_argument("--platens", choices=("smooth", "rough"), help="biaxial: friction of the platens (default: rough)")
    parser.add_argument("--aspect", type=arguments.positive, help="column, pile: height over width (pile: over half of it)")
    parser.add_argument("--friction", type=float, metavar="MU", help="column, pile: friction of contacts")
    parser.add_argument("--base", choices=("smooth", "rough"), help="column, pile: the floor")
    parser.add_argument("--out", default="out/compare", metavar="DIR", help="folder for the results (default: %(default)s)")
    parser.add_argument("--threads", type=int, default=os.cpu_count(), metavar="T", help="runs at a time, each on one thread (default: all cores)")
    parser.add_argument("--resume", action="store_true", help="keep runs in DIR that have ended")
    return parser.parse_args()


def options_of(args):
    """What the scenario takes besides, of the options that were given."""
    taken = OPTIONS[args.scenario]
    given = {name: getattr(args, name) for names in OPTIONS.values() for name in names if getattr(args, name) is not None}
    for name in given:
        if name not in taken:
            raise errors.UserError(f"--{name} with --scenario {args.scenario}: it has no such option; leave it out, or take "
                                   f"{', '.join('--' + n for n in taken)}")
    return given | ({"confining": 1e6 * given["confining"]} if "confining" in given else {})


def tell(questions):
    for question, verdict, sentences in questions:
        print(f"\n{question} {verdict}")
        for sentence in sentences:
            print(f"  {sentence}")


def measure_cost(args, out):
    if args.scenario != "slope":
        raise errors.UserError(f"--cost with --scenario {args.scenario}: it is measured on the slope; leave --scenario out")
    with arguments.bar() as progress:
        told = cost.run(out, args.source or "jiufengershan", args.disks or 20000, args.threads, args.stiffness or cost.STIFFNESSES, args.steps,
                        args.damping,
                        args.damping_moving, args.step_share, args.resume, progress, args.model)
    tell(cost_report.write(out, told))
    print(f"\nresults: {out}/report.html, summary.json, figures")


def main():
    args = read_arguments()
    out = Path(args.out)
    records.check_writable(out)
    if args.cost:
        return measure_cost(args, out)
    with arguments.bar() as progress:
        summary, questions = course.compare(
            args.scenario, out, args.seeds, disks=args.disks, source=args.source, stiffnesses=args.stiffness, ensemble=args.ensemble_stiffness,
            model=args.model, damping=args.damping,
            damping_moving=args.damping_moving, step_share=args.step_share, fragile=args.bonds == "fragile", without=args.without, threads=args.threads, resume=args.resume,
            progress=progress,
            options=options_of(args))
    tell(questions)
    print(f"\n{summary['wall_s']:.0f} s of wall time; results: {out}/report.html, summary.json, figures, runs/*")


try:
    main()
except errors.UserError as error:
    sys.exit(f"error: {error}")
