#!/usr/bin/env python3
"""A video of any YADE script, which stays as it is: disks, walls, bonds and forces, with one view and one scale of
forces.

  scripts/film.py [--out FILE.mp4|FILE.gif] [--period S] [--frames N] [--fps F] [--no-forces] SCRIPT [ARGS]
  scripts/film.py --out fall.mp4 --period 0.02 scripts/examples/hard_pile.py
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

import argparse
from pathlib import Path

from yade import O
from yade.nonsmooth import commands, figures
from yade.nonsmooth.commands import arguments, section_arguments
from yade.nonsmooth.figures import film, moving


def read_arguments():
    parser = argparse.ArgumentParser(prog="film.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument(
        "--out", metavar="FILE", help="the video, .mp4 (by ffmpeg) or .gif (default: that of SCRIPT in this folder)"
    )
    parser.add_argument(
        "--period",
        type=arguments.positive,
        metavar="S",
        help="time of the scene between two frames [s] (default: each step at first, and less often the longer the run is)",
    )
    parser.add_argument(
        "--frames",
        type=int,
        default=moving.MOST,
        metavar="N",
        help="at most; where they do not suffice every second one is dropped and the period doubled (default: %(default)s)",
    )
    parser.add_argument(
        "--fps",
        type=section_arguments.number(
            float, film.LEAST_FPS, film.MOST_FPS, f"frames a second from {film.LEAST_FPS:g} to {film.MOST_FPS}"
        ),
        default=moving.FPS,
        metavar="F",
        help="frames a second in the video (default: %(default)s)",
    )
    parser.add_argument("--no-forces", dest="forces", action="store_false", help="draw disks, walls and bonds alone")
    parser.add_argument("--threads", help="of YADE; read by the launcher")
    parser.add_argument("script", metavar="SCRIPT", help="a YADE script")
    parser.add_argument(
        "arguments", metavar="ARGS", nargs=argparse.REMAINDER, help="what the script finds in sys.argv[1:]"
    )
    args = parser.parse_args()
    if args.frames < 2:
        parser.error(f"argument --frames: {args.frames} is no video; give 2 or more")
    if not os.access(args.script, os.R_OK):
        parser.error(f"the script {args.script} cannot be read")
    return args


def main():
    args = read_arguments()
    out = film.check(args.out or f"{Path(args.script).stem}.{'gif' if film.missing() else 'mp4'}")
    with open(args.script) as file:
        code = compile(file.read(), args.script, "exec")
    sys.argv = [args.script, *args.arguments]
    status = 0
    with figures.recording(O, period=args.period, most=args.frames, forces=args.forces) as made:
        try:
            exec(code, vars(sys.modules["__main__"]))  # where YADE runs scripts, and looks for what engines call
        except SystemExit as end:  # a script's way to end
            status = end.code
    if status:
        sys.exit(status)
    print(f"video: {made.write(out, args.fps)}")


commands.run(main, "no video is written: run it again")
