#!/usr/bin/env python3
"""Finds contact parameters of a granular rock for a wanted cohesion and angle of friction.

  scripts/calibrate.py --cohesion KPA --friction DEG [--residual-cohesion KPA --residual-friction DEG] --out material.yaml
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

import argparse
import dataclasses
import time
from pathlib import Path

from yade.nonsmooth import commands, output_folder, section
from yade.nonsmooth.laboratory import arguments, calibration, materials
from yade.nonsmooth.whole_files import write_json


def read_arguments():
    parser = argparse.ArgumentParser(prog="calibrate.py", description=__doc__.splitlines()[0])
    parser.add_argument("--cohesion", type=float, required=True, metavar="KPA", help="wanted peak cohesion [kPa]")
    parser.add_argument(
        "--friction", type=float, required=True, metavar="DEG", help="wanted peak angle of friction [°]"
    )
    parser.add_argument("--residual-cohesion", type=float, metavar="KPA", help="wanted residual cohesion [kPa]")
    parser.add_argument("--residual-friction", type=float, metavar="DEG", help="wanted residual angle of friction [°]")
    parser.add_argument(
        "--start", default="wwr", metavar="NAME|FILE", help="material whose other parameters are kept (default: wwr)"
    )
    parser.add_argument(
        "--coarse", type=int, default=1500, metavar="N", help="disks of the coarse samples (default: %(default)s)"
    )
    parser.add_argument(
        "--fine", type=int, default=5000, metavar="N", help="disks of the fine samples (default: %(default)s)"
    )
    parser.add_argument(
        "--seeds", type=int, nargs="+", default=[11, 12], metavar="S", help="seeds of the samples (default: 11 12)"
    )
    parser.add_argument(
        "--out",
        default="material.yaml",
        metavar="FILE",
        help="the material; a report stands beside it (default: %(default)s)",
    )
    parser.add_argument(
        "--threads", type=int, default=os.cpu_count(), metavar="T", help="tests at a time (default: all cores)"
    )
    parser.add_argument("--resume", action="store_true", help="keep the trials of an interrupted search")
    args = parser.parse_args()
    for name in ("cohesion", "friction"):
        if not getattr(args, name) > 0:
            parser.error(f"--{name} {getattr(args, name):g}: it must be positive")
    if not 6 < args.friction < 60:
        parser.error(
            f"--friction {args.friction:g}: granular samples reach 6° (no friction between disks) to about 60°"
        )
    if (args.residual_cohesion is None) != (args.residual_friction is None):
        parser.error("give both --residual-cohesion and --residual-friction, or neither")
    if args.residual_friction is not None and not 6 < args.residual_friction <= args.friction:
        parser.error(f"--residual-friction {args.residual_friction:g}: give more than 6° and no more than --friction")
    if args.residual_cohesion is not None and not 0 <= args.residual_cohesion <= args.cohesion:
        parser.error(f"--residual-cohesion {args.residual_cohesion:g}: give 0 or more, and no more than --cohesion")
    return args


def main():
    args, began = read_arguments(), time.monotonic()
    residual = (
        (1e3 * args.residual_cohesion, args.residual_friction) if args.residual_friction is not None else (None, None)
    )
    wanted = calibration.Wanted(1e3 * args.cohesion, args.friction, *residual)
    path = Path(args.out)
    work = path.with_name(path.stem + "-calibration")
    output_folder.claim(work, "calibrate.py", args.resume)
    say = lambda text: print(f"{text} ({time.monotonic() - began:.0f} s)", flush=True)  # noqa: E731
    with arguments.bar() as progress:
        search = calibration.Calibration(
            wanted, materials.load(args.start), work, args.threads, say, args.resume, progress
        )
        best, report = search.run((args.coarse, args.seeds), (args.fine, args.seeds))
    write_json(work / "report.json", {**report, "wall_s": time.monotonic() - began})
    c, angle = report["found"][:2]
    measured = section.Envelope(*map(float, (c, angle)))
    materials.save(
        dataclasses.replace(best, envelope=measured),
        path,
        f"Calibrated by scripts/calibrate.py for c = {args.cohesion:g} kPa, φ = {args.friction:g}°.\n"
        f"Samples of {args.fine} disks gave c = {1e-3 * c:.1f} kPa, φ = {angle:.2f}°.",
    )
    print(
        f"{path}: c = {1e-3 * c:.1f} kPa (wanted {args.cohesion:g}), φ = {angle:.2f}° (wanted {args.friction:g}); report: {work}/report.json"
    )
    known = ", ".join(f"{name} to {100 * error:.0f} %" for name, error in report["parameter_error_rel"].items())
    print(
        f"{report['given']}. With strengths known to {100 * calibration.SCALE:g} % and {calibration.DEGREES:g}°: {known}"
    )
    if not report["reached"]:
        print(
            f"NOT REACHED: the best trial misses the wanted strengths by up to {max(map(abs, report['misfit_in_tolerances'])):.1f} times the tolerance of "
            f"{100 * calibration.SCALE:g} % and {calibration.DEGREES:g}°; try another --start, or strengths that belong together",
            file=sys.stderr,
        )


commands.run(main, "what has ended is kept, go on with --resume")
