"""The command that runs a slope, of any section: scripts/slope.py, and scripts/jiufengershan.py for the paper's."""

from __future__ import annotations

import argparse
import math
import os
import sys
import time
from pathlib import Path

from tqdm import tqdm

from yade import O

from ... import commands, packing
from ...commands import section_arguments
from ...measure import characteristic_times
from ...model import section
from ...model.section import checks as section_checks
from ...packing import checks as packing_checks
from ...system import output_folder
from . import experiment, run_files, slope_packing, verdict

__all__ = ["run"]

QUIET = 5.0  # s between two lines of the progress bar in a file


def arguments(name, about, default):
    """What the command line gives, a namespace; see :func:`run`."""
    parser = argparse.ArgumentParser(prog=name, description=about)
    section_arguments.add(parser, default, ["--list"])
    if default is None:
        parser.add_argument(
            "--list", action="store_true", help="print the names of the shipped sections, one a line, and end"
        )
    parser.add_argument(
        "--packing", metavar="FILE", help="a text file of `x y r [layer]` instead of a packing of our own"
    )
    parser.add_argument("--out", metavar="DIR", help="folder for the results (default: out/ and the section's name)")
    parser.add_argument("--threads", type=section_arguments.threads, metavar="T", help="threads (default: all cores)")
    parser.add_argument(
        "--end",
        type=section_arguments.seconds,
        metavar="SECONDS",
        help="stop after so many seconds of simulated time, settling included",
    )
    parser.add_argument("--resume", action="store_true", help="go on from the last checkpoint in DIR")
    parser.add_argument(
        "--no-figures", action="store_true", help="tables alone: no figures, no video, nothing for ParaView"
    )
    return parser.parse_args()


def fill(args, s):
    """The packing, and the wall time it took [s]."""
    began = time.monotonic()
    if args.packing:
        made = packing.read_text(args.packing)
        packing_checks.check(made, s, args.packing)
        return made, time.monotonic() - began
    with commands.closing(tqdm(total=100, desc="packing", unit="%", leave=False)) as bar:
        made = slope_packing.of(s, progress=lambda share: bar.update(int(100 * share) - bar.n))
    return made, time.monotonic() - began


class Bar:
    """Simulated seconds against those foreseen, with the time left."""

    def __init__(self):
        self._shown = -math.inf
        self.bar = tqdm(
            total=1,
            unit="s",
            bar_format="{desc} {percentage:3.0f}%|{bar}| {n:.1f}/{total:.0f} s simulated, {elapsed} gone, about {remaining} left",
        )

    def __call__(self, stage, now, foreseen):
        self.bar.total = max(foreseen, now)
        self.bar.set_description_str(f"{stage:8s}", refresh=False)
        self.bar.n = now
        if sys.stderr.isatty() or time.monotonic() - self._shown > QUIET:
            self._shown = time.monotonic()
            self.bar.refresh()


def verdict_lines(summary):
    """What became of the slope, and what helps where it did not wait for the water."""
    said, title = summary["verdict_says"], verdict.TITLES[verdict.DRY]
    if summary["verdict"] != verdict.DRY:
        return f"{said[0].upper()}{said[1:]}.\n"
    return (
        f"\n{said.replace(title, title.upper(), 1)}. Take more disks (a foot of few disks is weak by chance; another seed may stand), a stronger rock, or more friction on the "
        "plane.\n\n"
    )


def number_line(name, summary):
    """A number of the summary; of one that there is not, why."""
    value = summary[name]
    if name == "energy_error_rel" and summary["times_s"]["t4"] is None and summary["verdict"] != verdict.SLID:
        return f"  {name:28s} -  (the slope has not moved off: it turned over too little energy to set an error beside)"
    if value is not None:
        return f"  {name:28s} {value:.4g}"
    why = characteristic_times.reason_of(name, summary["times_missing"])
    return f"  {name:28s} -" + (f"  ({why})" if why else "")


def run(name, about, default=None):
    """Runs the command ``name``; ``about``: what its help says; ``default``: the section where none is given."""
    args = arguments(name, about, default)
    if default is None and args.list:
        print("\n".join(section.shipped()))
        return
    s = section_arguments.read(args)
    for note in section_checks.notes(s):
        print(note, flush=True)
    out = Path(
        args.out or f"out/{Path(args.section).stem}{'-mirrored' * args.mirror}{f'-{args.size:g}' if args.size else ''}"
    )
    if not args.resume:
        run_files.check_folder(out)
    output_folder.claim(out, name)
    if args.resume:
        course = experiment.resume(s, out)
    else:
        made, seconds = fill(args, s)
        course = experiment.begin(s, out, packing=made)
        course.state.wall_packing_s = seconds
        fraction = packing.packing_fraction(made, s.outline)
        bulk = "no bulk between their edges" if fraction is None else f"packing fraction {fraction:.3f}"
        print(f"{len(made)} disks, {bulk}, results go to {out}", flush=True)
        for sentence in packing_checks.sparse_layers(made, s):
            print(sentence, flush=True)
    course.progress = Bar()
    with commands.closing(course.progress.bar):
        if not course.reached(args.end):  # nor is anything left to do but figures
            course.run(end=args.end, stands=True)
    if course.state.stage == "settle":
        print(verdict_lines(course.summarise(args.threads or os.cpu_count())), end="")
        print(f"stopped while settling, at {O.time:.1f} s; go on with --resume")
        return
    summary = course.summarise(args.threads or os.cpu_count())
    made, notes = ([], []) if args.no_figures else course.draw()
    for note in notes:
        print(note)
    print(
        f"\n{'finished' if summary['finished'] else 'stopped (go on with --resume)'} at {O.time:.1f} s of simulated time, "
        f"{summary['wall_s']:.0f} s of wall time"
    )
    for name in (
        "water_at_failure_m",
        "triggering_s",
        "weakening_s",
        "motion_s",
        "front_travel_m",
        "deposit_thickness_max_m",
        "energy_error_rel",
    ):
        print(number_line(name, summary))
    if summary.get("water_at_failure_over_passive"):
        print(
            f"the toe's passive strength, from the measured envelope, is reached at {summary['water_passive_m']:.1f} m of water "
            f"and a push of {1e-6 * summary['passive_force_N_per_m']:.0f} MN/m; the slope failed at {summary['water_at_failure_over_passive']:.2f} of that height, "
            f"with {summary['fb_force_at_failure_over_passive']:.2f} of that force on the backstop"
        )
    print(verdict_lines(summary), end="")
    print(f"results: {', '.join([f'{out}/summary.json', 'series.csv', *(p.name for p in made)])}")
