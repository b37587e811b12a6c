#!/usr/bin/python3
"""The factor of safety of a slope: its strengths are divided by a factor that grows until it fails, and the factor at
which it fails is closed in by bisection.

  scripts/factor_of_safety.py --section NAME|FILE [--table METRES] [--seeds S …] [--divide NAME,…]
      [--materials NAME,…] [--disks N] [--out DIR] [--threads T] [--resume]
  scripts/factor_of_safety.py --section NAME|FILE --over KEY=VALUE,VALUE,… [--over …]
      all combinations, as scripts/sweep.py has them
"""
import argparse
import sys
from pathlib import Path

from tabulate import tabulate

if "yade" in sys.modules:  # started by the launcher
    from yade.nonsmooth import campaign, commands, figures
    from yade.nonsmooth.commands import arguments, section_arguments
    from yade.nonsmooth.model import materials
else:  # YADE runs in processes of its own
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "py"))
    from nonsmooth import campaign, commands, figures
    from nonsmooth.commands import arguments, section_arguments
    from nonsmooth.model import materials

SHOWN = ("verdict", "factor", "factor_low", "factor_high", "failing_area_m2")


def names(text):
    """Type of names with commas."""
    return [name.strip() for name in text.split(",")]


def read_arguments():
    parser = argparse.ArgumentParser(prog="factor_of_safety.py", description=__doc__.partition("\n\n")[0])
    section_arguments.add(parser)
    factor = section_arguments.number(float, 1e-6, 1e6, "a factor from 1e-6 to 1e6")
    part = section_arguments.number(float, 1e-4, 1, "a share of the factor from 1e-4 to 1")
    parser.add_argument(
        "--table",
        type=section_arguments.number(float, 0, 1e6, "a height [m], 0 or more"),
        metavar="METRES",
        help="height above its plane at which the water table stands (default: the section's where that comes to "
        "stand, else dry)",
    )
    parser.add_argument(
        "--divide",
        type=names,
        default=list(materials.REDUCED),
        metavar="NAME,…",
        help=f"what is divided, some of {', '.join(materials.QUANTITIES)} (default: {','.join(materials.REDUCED)})",
    )
    parser.add_argument(
        "--materials",
        type=names,
        metavar="NAME,…",
        help="materials of the section in which it is divided (default: all)",
    )
    parser.add_argument(
        "--step",
        type=part,
        default=0.1,
        metavar="P",
        help="growth of the factor from trial to trial (default: %(default)g)",
    )
    parser.add_argument(
        "--within",
        type=part,
        default=0.02,
        metavar="P",
        help="width of the bracket, by the factor (default: %(default)g)",
    )
    parser.add_argument(
        "--most",
        type=factor,
        default=10.0,
        metavar="F",
        help="a slope that stands at F stands for ever (default: %(default)g)",
    )
    parser.add_argument(
        "--least",
        type=factor,
        default=0.05,
        metavar="F",
        help="a slope that fails at F never stands (default: %(default)g)",
    )
    parser.add_argument("--world", choices=("hard", "soft"), default="hard", help="contacts (default: hard)")
    parser.add_argument("--stiffness", type=arguments.positive, metavar="PA", help="soft: Young's modulus [Pa]")
    arguments.add_seeds(parser, None, "seeds of the packings, one search each (default: the section's)")
    section_arguments.add_over(parser, "materials.soil.friction=0.4,0.6")
    parser.add_argument("--no-figures", action="store_true", help="numbers alone")
    arguments.add_out(parser, "out/safety", "the plan and its searches")
    arguments.add_threads(parser, "searches at a time", section_arguments.threads)
    parser.add_argument(
        "--resume", action="store_true", help="keep what has ended in DIR, and go on with what was halted"
    )
    return parser.parse_args()


def varied(args):
    """What is varied: {key: values}."""
    over = dict(args.over)
    if len(over) < len(args.over):
        raise campaign.PlanError("--over: a key stands twice; give all its values at once")
    if args.seeds is not None:
        if campaign.SEED in over:
            raise campaign.PlanError("--seeds: --over has the seeds too; give them once")
        over[campaign.SEED] = args.seeds
    return over


def main():
    args = read_arguments()
    over = varied(args)
    world = {} if args.world == "hard" else {"name": args.world}
    if args.stiffness is not None:
        world["stiffness"] = args.stiffness
    plan = campaign.factors_of_safety(
        section_arguments.read(args),
        over,
        quantities=args.divide,
        materials=args.materials,
        world=world,
        table=args.table,
        figures=not args.no_figures,
        step=args.step,
        within=args.within,
        most=args.most,
        least=args.least,
    )
    for note in plan.notes[:3]:
        print(note)
    with arguments.bar() as progress:

        def told(share, ended):
            progress(share, f"{ended} of {len(plan.runs)} searches")

        table = plan.run(args.out, args.threads, args.resume, told)
    show(table, args, over)


def show(table, args, over):
    """The factors, and their figure where a number was varied."""
    print(tabulate({name: table[name] for name in (*over, *SHOWN) if name in table}, headers="keys", floatfmt=".4g"))
    made = f"results: {args.out}/table.csv, runs/*/summary.json"
    key = next((key for key in over if key != campaign.SEED), None)
    if key is not None and any(value is not None for value in table["factor"]):
        figures.means(campaign.means(table, list(over)), key, ["factor"], Path(args.out) / "factors.png")
        made += ", factors.png"
    if not args.no_figures:
        made += ", runs/*/displacements.png, failing_mass.png"
    print(made)


commands.run(main, "what has ended is kept, go on with --resume")
