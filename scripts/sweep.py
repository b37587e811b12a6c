#!/usr/bin/python3
"""Many runs of a slope with some of its values varied, as many at a time as there are threads, and one table of what
they found.

  scripts/sweep.py --section NAME|FILE --over KEY=VALUE,VALUE,… [--over …] [--disks N] [--out DIR] [--threads T] [--resume]
  scripts/sweep.py --section NAME|FILE --over … --out DIR --plan     only write the plan, with files for Snakemake and Slurm
  scripts/sweep.py --out DIR --collect                               the table of runs that a cluster has done
"""
import argparse
import difflib
import sys
from pathlib import Path

from tabulate import tabulate

if "yade" in sys.modules:  # started by the launcher
    from yade.nonsmooth import campaign, commands, figures
    from yade.nonsmooth.commands import arguments, section_arguments
else:  # YADE runs in processes of its own
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "py"))
    from nonsmooth import campaign, commands, figures
    from nonsmooth.commands import arguments, section_arguments

NOTES = 3  # on what runs do, that are printed
SHOWN = ("verdict", "water_highest_m", "water_at_failure_m", "front_travel_m", "deposit_thickness_max_m")


def read_arguments():
    parser = argparse.ArgumentParser(prog="sweep.py", description=__doc__.partition("\n\n")[0])
    section_arguments.add(parser, needless=("--run", "--number", "--collect"))
    section_arguments.add_over(parser, "water.table.rate=0.5,1 or walls.DP.material=dp,ss")
    parser.add_argument(
        "--end",
        type=section_arguments.seconds,
        metavar="SECONDS",
        help="stop each run after so many seconds of simulated time",
    )
    parser.add_argument("--figures", action="store_true", help="figures of each run too")
    parser.add_argument(
        "--out", default="out/sweep", metavar="DIR", help="folder of the plan and its runs (default: %(default)s)"
    )
    arguments.add_threads(parser, "runs at a time", section_arguments.threads)
    parser.add_argument(
        "--resume", action="store_true", help="keep what has ended in DIR, and go on with what was halted"
    )
    parser.add_argument(
        "--draw",
        type=lambda text: text.split(","),
        metavar="NAME,…",
        help="draw these results against the first key that is varied besides the seed, with means over seeds: means.png",
    )
    parser.add_argument("--plan", action="store_true", help="only write the plan, with a Snakefile and a job for Slurm")
    parser.add_argument("--run", metavar="NAME", help="do one run of the plan in DIR")
    parser.add_argument(
        "--number",
        type=section_arguments.number(int, 0, 10**6, "a whole number from 0"),
        metavar="K",
        help="do run number K of the plan in DIR, from 0",
    )
    parser.add_argument("--collect", action="store_true", help="only collect the table of the plan in DIR")
    return parser.parse_args()


def main():
    args = read_arguments()
    if args.run is not None or args.number is not None:
        campaign.run_one(args.out, args.run if args.run is not None else args.number)
        return
    if args.collect:
        show(campaign.collect(args.out), args.out, args.draw, campaign.results_of(campaign.read(args.out)))
        return
    over = dict(args.over)
    if len(over) < len(args.over):
        raise campaign.PlanError("--over: a key stands twice; give all its values at once")
    if args.draw:
        key_of(over)  # before anything runs
    plan = campaign.sweep(section_arguments.read(args), over, end=args.end, figures=args.figures)
    known = campaign.results_of(plan)
    check_drawn(args.draw, known, args.section)
    print_notes(plan.notes)
    if args.plan:
        plan.write(args.out)
        print(f"{len(plan.runs)} runs planned in {args.out}: snakemake --cores N, or sbatch array.sh, in that folder")
        return
    with arguments.bar() as progress:

        def told(share, ended):
            progress(share, f"{ended} of {len(plan.runs)} runs")

        table = plan.run(args.out, args.threads, args.resume, told)
    show(table, args.out, args.draw, known)


def print_notes(notes):
    """The notes of the first runs, some lines; of the other runs how many there are. A note begins with the name of its
    run.
    """
    of_runs = {}
    for note in notes:
        of_runs.setdefault(note.partition(":")[0], []).append(note)
    shown = 0
    for k, lines in enumerate(of_runs.values()):
        if shown and shown + len(lines) > NOTES:
            print(f"and so for {len(of_runs) - k} more of the runs")
            return
        shown += len(lines)
        print("\n".join(lines))


def check_drawn(drawn, known, place):
    """Raises PlanError for a name in ``drawn`` that is none of the ``known`` results (None: they are not known)."""
    for name in (drawn or ()) if known is not None else ():
        if name not in known:
            near = difflib.get_close_matches(name, known, 3)
            raise campaign.PlanError(
                f"--draw {name}: no result is called so; "
                + (
                    f"did you mean {' or '.join(map(repr, near))}?"
                    if near
                    else f"there are {', '.join(known)}, in {place}"
                )
            )


def key_of(varied):
    """The first varied key besides the seed, against which results are drawn."""
    key = next((key for key in varied if key != campaign.SEED), None)
    if key is None:
        raise campaign.PlanError("--draw: only the seed was varied; give another key with --over")
    return key


def show(table, out, drawn, known=None):
    """The varied values and some results, and a figure of those that are ``drawn``; all are in the file. ``known``:
    names of results, which a table lacks where no run has a value.
    """
    absent = {name: [None] * len(table["run"]) for name in drawn or () if name not in table and name in (known or ())}
    varied = list(campaign.read(out).runs[0].values)
    names = [*varied, *(name for name in SHOWN if name in table)]
    print(tabulate({name: table[name] for name in names}, headers="keys", floatfmt=".4g"))
    made = f"results: {out}/table.csv, runs/*/summary.json"
    if drawn:
        rows = campaign.means(table | absent, varied)
        check_drawn(drawn, list(rows[0]["numbers"]), f"{out}/table.csv")
        figures.means(rows, key_of(varied), drawn, Path(out) / "means.png")
        made += ", means.png"
    print(made)


commands.run(main, "what has ended is kept, go on with --resume")
