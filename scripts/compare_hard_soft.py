#!/usr/bin/env python3
"""The same experiment with rigid disks or spheres (Contact Dynamics) and with YADE's soft contacts, side by side.

  scripts/compare_hard_soft.py --scenario slope [--disks N] [--stiffness PA,PA,…] [--seeds S …] [--out DIR] [--threads T] [--resume]
  scripts/compare_hard_soft.py --scenario round-column|triaxial [--size N] [--stiffness PA,PA,…] [--seeds S …] [--out DIR] [--threads T] [--resume]
  scripts/compare_hard_soft.py --cost [--disks N] [--stiffness PA,PA,…] [--out DIR] [--threads T] [--resume]
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

from pathlib import Path

from yade.nonsmooth import commands
from yade.nonsmooth.commands import arguments
from yade.nonsmooth.studies.comparison import cost, cost_report, course, options
from yade.nonsmooth.system import output_folder


def tell(questions):
    for question, verdict, sentences in questions:
        print(f"\n{question} {verdict}")
        for sentence in sentences:
            print(f"  {sentence}")


def measure_cost(args, out):
    with arguments.bar() as progress:
        told = cost.run(
            out,
            args.source or cost.SOURCE,
            args.disks or cost.DISKS,
            args.threads,
            args.stiffness or cost.STIFFNESSES,
            args.steps,
            args.damping,
            args.damping_moving,
            args.step_share,
            args.resume,
            progress,
            args.model,
        )
    tell(cost_report.write(out, told))
    print(f"\nresults: {out}/report.html, summary.json, figures")


def main():
    args = options.read(__doc__.partition("\n\n")[0])
    out = Path(args.out)
    output_folder.claim(out, "compare_hard_soft.py", args.resume)
    if args.cost:
        return measure_cost(args, out)
    with arguments.bar() as progress:
        summary, questions = course.compare(
            args.scenario,
            out,
            args.seeds,
            disks=args.disks,
            source=args.source,
            stiffnesses=args.stiffness,
            ensemble=args.ensemble_stiffness,
            model=args.model,
            damping=args.damping,
            damping_moving=args.damping_moving,
            step_share=args.step_share,
            fragile=args.bonds == "fragile",
            without=args.without,
            threads=args.threads,
            resume=args.resume,
            progress=progress,
            options=options.scenario_options(args),
        )
    tell(questions)
    print(
        f"\n{summary['wall_s']:.0f} s of wall time in this sitting, {summary['runs_wall_s']:.0f} s in all runs together; results: {out}/report.html, "
        "summary.json, figures, runs/*"
    )


commands.run(main, "what has ended is kept, go on with --resume")
