#!/usr/bin/env python3
"""A slope: any section, shipped or your own, from its packing to its rest, with figures and a video.

  scripts/slope.py --list
  scripts/slope.py --section NAME|FILE [--disks N] [--out DIR] [--threads T] [--seed S] [--mirror] [--size S] [--end SECONDS] [--resume] [--no-figures]
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

from yade.nonsmooth import commands
from yade.nonsmooth.studies.slope import slope_command

commands.run(
    lambda: slope_command.run("slope.py", __doc__.partition("\n\n")[0]),
    "where there is a checkpoint, --resume goes on from it",
)
