#!/usr/bin/python3
"""Slides one block on a surface that weakens: at a given speed, or down a slope by its weight. Takes seconds, needs no
YADE.

  scripts/sliding_block.py --set vaiont --dip 22 --depth 100 --density 2400 --speed 0.1 [--value KEY=NUMBER …]
  scripts/sliding_block.py --law step --value friction=0.4 critical_slip=5 --dip 25 --depth 60 --density 2100
  scripts/sliding_block.py --set gabbro --speed 0.85 --normal-stress 1.5e6 [--time S] [--slip M] [--share X]
  scripts/sliding_block.py --list

Laws that share a heated zone go together: --law thermal_pressurization flash_heating. Several --set are drawn into one
figure. In DIR: block.csv (one a set), block.png, and summary.json with slip and time at shares of the first strength.
"""
import argparse
import sys
from pathlib import Path

if "yade" in sys.modules:  # started by the launcher
    from yade.nonsmooth import commands
    from yade.nonsmooth.commands import arguments
    from yade.nonsmooth.figures import sliding_block as figures
    from yade.nonsmooth.records import SeriesWriter
    from yade.nonsmooth.slip import block, laws, parameter_sets
    from yade.nonsmooth.system import output_folder
    from yade.nonsmooth.system.whole_files import write_json
else:  # the library of laws is found in the build
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "py"))
    from nonsmooth import commands
    from nonsmooth.commands import arguments
    from nonsmooth.figures import sliding_block as figures
    from nonsmooth.records import SeriesWriter
    from nonsmooth.slip import block, laws, parameter_sets
    from nonsmooth.system import output_folder
    from nonsmooth.system.whole_files import write_json

SHARES = (0.5, 0.1, 0.05, 0.01)


def value(text):
    """Type of KEY=NUMBER, or KEY=NUMBER,NUMBER…"""
    key, equals, numbers = text.partition("=")
    try:
        read = [float(one) for one in numbers.split(",")]
    except ValueError:
        read = []
    if not (key and equals and read):
        raise argparse.ArgumentTypeError(f"{text!r}: give KEY=NUMBER, or KEY=NUMBER,NUMBER where a law takes a list")
    return key, read[0] if len(read) == 1 else read


def read_arguments():
    parser = argparse.ArgumentParser(prog="sliding_block.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument("--law", nargs="+", metavar="NAME", help="a law, or several that share a heated zone")
    parser.add_argument("--set", nargs="+", metavar="NAME", help="named parameter sets, one block each")
    parser.add_argument(
        "--value",
        nargs="+",
        type=value,
        default=[],
        metavar="KEY=NUMBER",
        help="parameters of the law, or changed ones",
    )
    parser.add_argument("--list", action="store_true", help="tells laws with their parameters, and sets, and ends")
    parser.add_argument("--dip", type=float, metavar="DEG", help="of a slope that the block slides down by its weight")
    parser.add_argument(
        "--depth", type=arguments.positive, metavar="M", help="of a slope's block, normal to it (default: 100)"
    )
    parser.add_argument(
        "--density", type=arguments.positive, metavar="KG/M3", help="of a slope's block (default: 2400)"
    )
    parser.add_argument(
        "--speed", type=float, metavar="M/S", help="at first on a slope (default: 0.1), or all the time (default: 1)"
    )
    parser.add_argument("--normal-stress", type=arguments.positive, metavar="PA", help="without a slope (default: 1e6)")
    parser.add_argument("--step", type=arguments.positive, default=1e-3, metavar="S", help="time step (default: 1 ms)")
    parser.add_argument("--time", type=arguments.positive, default=10.0, metavar="S", help="longest (default: 10)")
    parser.add_argument("--slip", type=arguments.positive, metavar="M", help="longest (default: none)")
    parser.add_argument(
        "--share", type=float, default=0.0, metavar="X", help="of the first strength, at which it ends (default: none)"
    )
    arguments.add_out(parser, "out/block")
    args = parser.parse_args()
    if not args.list and bool(args.law) == bool(args.set):
        parser.error("give --law, or --set; --list tells them")
    if args.dip is None and (args.depth or args.density):
        parser.error("--depth and --density are of a slope: give --dip, or leave them out")
    if args.dip is not None and args.normal_stress:
        parser.error("--normal-stress with --dip: the weight on a slope gives it; leave one out")
    return args


def listed():
    """What there is to choose from, as lines."""
    for name, what in laws.known().items():
        yield f"{name}: {what}"
        for one in laws.parameters(name):
            usual = "" if one.required else f" (default: {one.fallback:g})"
            yield f"    {one.key:28s} [{one.unit}] {one.what}{usual}"
    for name, what in parameter_sets.known().items():
        yield f"--set {name}: {what}"
        for key, (number, ground, why) in parameter_sets.values(name).items():
            yield f"    {key:28s} {number} ({ground}: {why})"


def shares_of(course):
    """Slip [m] and time [s] at which the strength has fallen to shares of its first value; None where it has not."""
    share = course["strength_Pa"] / (course["strength_Pa"][0] or 1.0)
    found = {}
    for one in SHARES:
        below = (share <= one).nonzero()[0]
        at = None if not len(below) else below[0]
        found[f"{one:g}"] = (
            None if at is None else {name: float(course[name][at]) for name in ("time_s", "slip_m", "speed_m_per_s")}
        )
    return found


def main():
    args = read_arguments()
    if args.list:
        print("\n".join(listed()))
        return
    changed = dict(args.value)
    if args.set:
        chosen = {name: parameter_sets.law(name, **changed) for name in args.set}
    else:
        chosen = {"+".join(args.law): laws.SlipLaw(args.law, **changed)}
    if args.dip is None:
        drive = block.Driven(1.0 if args.speed is None else args.speed, args.normal_stress or 1e6)
    else:
        speed = 0.1 if args.speed is None else args.speed
        drive = block.OnSlope(args.dip, args.depth or 100.0, args.density or 2400.0, speed)
    until = block.Until(args.time, args.slip or float("inf"), args.share)
    courses = {name: block.slide(law, drive, args.step, until) for name, law in chosen.items()}
    out = Path(args.out)
    output_folder.claim(out, "sliding_block.py")
    summary = {}
    for name, course in courses.items():
        path = out / ("block.csv" if len(courses) == 1 else f"block-{name}.csv")
        columns = {key: block.COLUMNS[key] for key in course}
        with SeriesWriter(path, {"step": block.STEP, **columns}, overwrite=True) as series:
            for k, row in enumerate(zip(*course.values())):
                series.write({"step": k + 1, **dict(zip(course, map(float, row)))})
        summary[name] = {"end": {key: float(column[-1]) for key, column in course.items()}, "shares": shares_of(course)}
        told = ", ".join(
            f"{float(share):.0%} at {at['slip_m']:.3g} m and {at['time_s']:.3g} s"
            for share, at in summary[name]["shares"].items()
            if at
        )
        print(
            f"{name}: {course['slip_m'][-1]:.4g} m in {course['time_s'][-1]:.4g} s; strength {told or 'above one half'}"
        )
    write_json(out / "summary.json", summary)
    figures.sliding_block(list(courses.items()), out / "block.png")
    print(f"results: {out}/summary.json, block.png, block*.csv")


commands.run(main)
