#!/usr/bin/env python3
"""The lessons of scripts/examples, hard and soft: runs them with the parameters that doc/lessons.rst speaks of, and
keeps their numbers and a video of each.

  scripts/lessons.py [LESSON …] [--out DIR] [--threads T] [--resume] [--no-films]
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

import argparse
from pathlib import Path

from yade.nonsmooth import commands, lessons
from yade.nonsmooth.commands import arguments
from yade.nonsmooth.figures import film
from yade.nonsmooth.measure import statistics
from yade.nonsmooth.system import output_folder
from yade.nonsmooth.system.whole_files import write_json


def shown(value):
    """A number, or a mean over seeds with its interval."""
    return statistics.told(value["mean"], value["half_width"], 3) if isinstance(value, dict) else f"{value:g}"


def main():
    parser = argparse.ArgumentParser(prog="lessons.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument(
        "lessons", nargs="*", metavar="LESSON", help=f"some of {', '.join(lessons.CASES)} (default: all)"
    )
    arguments.add_runs(parser, "out/lessons", "runs")
    parser.add_argument(
        "--no-films", dest="films", action="store_false", help="leave the videos out, which take as long as the runs"
    )
    args = parser.parse_args()
    chosen, out = lessons.under(args.lessons), Path(args.out)
    output_folder.claim(out, "lessons.py", args.resume)
    lessons.merged({}, out / "lessons.json")  # refused before anything is run
    if args.films and film.missing():
        print(f"no videos: {film.missing()}")
    count = sum(len(case.seeds or (None,)) for cases in chosen.values() for case in cases.values())
    with arguments.bar() as progress:
        found = lessons.run(
            chosen, out, args.threads, args.resume, lambda share, ended: progress(share, f"{count} runs"), args.films
        )
    write_json(out / "lessons.json", lessons.merged(found, out / "lessons.json"))  # others keep their numbers
    for name, cases in found.items():
        for key, values in cases.items():
            told = [f"{k} {shown(v)}" for k, v in values.items() if k != "rows"]
            print(f"{name:8s} {key:15s} {', '.join(told)}")
    print(f"results: {out}/lessons.json, runs/*/output.txt{', film.mp4' if args.films and not film.missing() else ''}")


commands.run(main, "what has ended is kept, go on with --resume")
