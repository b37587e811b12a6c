#!/usr/bin/env python3
"""Holds the law, the time stepping and the solver against derivations, other codes and finer steps, and writes an HTML
report.

  scripts/verify.py [--out DIR] [--quick] [--only NAME …] [--threads T] [--resume] [--list]
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

import argparse
import time
from pathlib import Path

from tqdm import tqdm
from yade import config
from yade.nonsmooth import commands
from yade.nonsmooth.commands import arguments as options
from yade.nonsmooth.judges import verification
from yade.nonsmooth.judges.verification import report, runner, siconos_solve
from yade.nonsmooth.system import output_folder


def arguments():
    parser = argparse.ArgumentParser(prog="verify.py", description=__doc__.partition("\n\n")[0])
    options.add_out(parser, "out/verify", "the report")
    parser.add_argument(
        "--quick", action="store_true", help="the subset that takes minutes: smaller samples, fewer points"
    )
    parser.add_argument("--only", nargs="+", metavar="NAME", help="only these checks (see --list), or all of a module")
    parser.add_argument("--threads", type=int, metavar="T", help="threads (default: all cores)")
    parser.add_argument("--resume", action="store_true", help="keep what an earlier run in DIR has finished")
    parser.add_argument("--list", action="store_true", help="names the checks and ends")
    return parser.parse_args()


def chosen(checks, args):
    """The checks to run; ends with a message where a name is unknown."""
    known = {c.name for c in checks} | {c.group for c in checks}
    for name in args.only or ():
        if name not in known:
            sys.exit(f"error: --only {name}: there is no such check; --list names them")
    wanted = [c for c in checks if not args.only or c.name in args.only or c.group in args.only]
    return [c for c in wanted if not args.quick or args.only or c.quick_seconds is not None]


def at_hand(checks):
    """Without the checks that need a program which is not on this machine."""
    try:
        siconos_solve.program()
    except siconos_solve.OracleError as error:
        left = [c.name for c in checks if c.run.__module__.endswith(".siconos")]
        if left:
            print(f"left out, as Siconos is missing: {', '.join(left)} ({error})")
        return [c for c in checks if c.name not in left]
    return checks


def main():
    args = arguments()
    checks = verification.load_checks()
    if args.list:
        for c in checks:
            quick = "-" if c.quick_seconds is None else f"{c.quick_seconds:.0f} s"
            print(f"{c.group:14s} {c.name:34s} {c.seconds:5.0f} s, quick {quick:6s} {c.title}")
        return
    checks, out = at_hand(chosen(checks, args)), Path(args.out)
    output_folder.claim(out, "verify.py", args.resume)
    began, results = time.monotonic(), []
    cost = {c.name: (c.quick_seconds or c.seconds) if args.quick else c.seconds for c in checks}
    bar = tqdm(
        total=sum(cost.values()),
        unit="s",
        bar_format="{percentage:3.0f}%|{bar}| {elapsed} gone, about {remaining} left  {desc}",
    )

    def done(result):
        bar.update(cost[result.check.name])
        passed = sum(c.passed for c in result.claims)
        mark = "pass" if result.passed else "FAIL"
        bar.write(
            f"{mark}  {result.check.name:34s} {passed} of {len(result.claims)} claims, {result.wall_s:.1f} s"
            + (f"  {result.error}" if result.error else "")
        )
        for claim in result.claims:
            if not claim.passed:
                bar.write(
                    f"      {claim.what}: {claim.measured:.6g} {claim.unit}, allowed {claim.low:.6g} to {claim.high:.6g}"
                )

    def progress(check, text):
        bar.set_description_str(f"{check.name}: {text}")

    with commands.closing(bar):
        for result in runner.run_checks(
            checks,
            out,
            quick=args.quick,
            threads=args.threads or os.cpu_count(),
            resume=args.resume,
            progress=progress,
            done=done,
        ):
            results.append(result)
    page = report.write_report(out / "report.html", results, quick=args.quick, versions={"YADE": config.version})
    failed = [r.check.name for r in results if not r.passed]
    print(
        f"{len(results) - len(failed)} of {len(results)} checks hold, {time.monotonic() - began:.0f} s of wall time; report: {page}"
    )
    if failed:
        sys.exit(f"these do not hold: {', '.join(failed)}")


commands.run(main, "what has ended is kept, go on with --resume")
