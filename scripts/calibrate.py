#!/usr/bin/env python3
"""Finds contact parameters of a granular rock for a wanted cohesion and angle of friction.

  scripts/calibrate.py --cohesion PA --friction DEG [--residual-cohesion PA --residual-friction DEG] [--quick] --out material.yaml

It says first how long it takes. Where c and φ are within the table of calibrated rocks, a section may ask for them
straight, without a search: materials.NAME: {cohesion: PA, friction_angle: DEG}.
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

import argparse
import dataclasses
import time
from pathlib import Path

from yade.nonsmooth import commands, section
from yade.nonsmooth.commands import arguments
from yade.nonsmooth.laboratory import calibration, materials
from yade.nonsmooth.model import rocks
from yade.nonsmooth.system import output_folder
from yade.nonsmooth.system.whole_files import write_json


WEAKEST = 1000.0  # Pa; a smaller cohesion is one in kPa


def read_arguments():
    parser = argparse.ArgumentParser(prog="calibrate.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument("--cohesion", type=float, required=True, metavar="PA", help="wanted peak cohesion [Pa]")
    parser.add_argument(
        "--friction", type=float, required=True, metavar="DEG", help="wanted peak angle of friction [°]"
    )
    parser.add_argument("--residual-cohesion", type=float, metavar="PA", help="wanted residual cohesion [Pa]")
    parser.add_argument("--residual-friction", type=float, metavar="DEG", help="wanted residual angle of friction [°]")
    parser.add_argument(
        "--start", default="wwr", metavar="NAME|FILE", help="material whose other parameters are kept (default: wwr)"
    )
    parser.add_argument(
        "--quick",
        action="store_true",
        help="the coarse samples alone: minutes, and an answer as good as these samples, which is said",
    )
    parser.add_argument(
        "--coarse",
        type=int,
        metavar="N",
        help=f"disks of the coarse samples (default: 1500, with --quick {calibration.QUICK})",
    )
    parser.add_argument("--fine", type=int, metavar="N", help="disks of the fine samples (default: 5000)")
    arguments.add_seeds(
        parser, None, "seeds of the samples (default: 11 12, with --quick 11 to 14: smaller samples scatter more)"
    )
    parser.add_argument(
        "--out",
        default="material.yaml",
        metavar="FILE",
        help="the material; a report stands beside it (default: %(default)s)",
    )
    arguments.add_threads(parser, "tests at a time")
    parser.add_argument("--resume", action="store_true", help="keep the trials of an interrupted search")
    args = parser.parse_args()
    if args.quick and args.fine is not None:
        parser.error(f"--fine {args.fine} with --quick, which has no fine samples: leave one of them out")
    if args.coarse is None:
        args.coarse = calibration.QUICK if args.quick else 1500
    if args.fine is None:
        args.fine = 5000
    if args.seeds is None:
        args.seeds = [11, 12, 13, 14] if args.quick else [11, 12]
    for name in ("cohesion", "friction"):
        if not getattr(args, name) > 0:
            parser.error(f"--{name} {getattr(args, name):g}: it must be positive")
    for name in ("cohesion", "residual_cohesion"):
        value, option = getattr(args, name), f"--{name.replace('_', '-')}"
        if value is not None and 0 < value < WEAKEST:
            parser.error(
                f"{option} {value:g}: it is in Pa, as in sections, and {value:g} kPa are {1e3 * value:g}. For a rock that is so weak ask for a thousand times as much, and give "
                "a thousandth of its tensile strengths: strengths go with the cohesion"
            )
    low, high = rocks.REACHED
    if not low < args.friction < high:
        parser.error(
            f"--friction {args.friction:g}: granular samples reach {low:g}° (no friction between disks) to about {high:g}°"
        )
    if (args.residual_cohesion is None) != (args.residual_friction is None):
        parser.error("give both --residual-cohesion and --residual-friction, or neither")
    if args.residual_friction is not None and not low < args.residual_friction <= args.friction:
        parser.error(
            f"--residual-friction {args.residual_friction:g}: give more than {low:g}° and no more than --friction"
        )
    if args.residual_cohesion is not None and not 0 <= args.residual_cohesion <= args.cohesion:
        parser.error(f"--residual-cohesion {args.residual_cohesion:g}: give 0 or more, and no more than --cohesion")
    return args


def main():
    args, began = read_arguments(), time.monotonic()
    residual = (args.residual_cohesion, args.residual_friction) if args.residual_friction is not None else (None, None)
    wanted = calibration.Wanted(args.cohesion, args.friction, *residual)
    path = Path(args.out)
    work = path.with_name(path.stem + "-calibration")
    output_folder.claim(work, "calibrate.py", args.resume)

    def say(text):
        return print(f"{text} ({time.monotonic() - began:.0f} s)", flush=True)

    with arguments.bar() as progress:
        search = calibration.Calibration(
            wanted, materials.load(args.start, "--start"), work, args.threads, say, args.resume, progress
        )
        kinds = [(args.coarse, args.seeds)] if args.quick else [(args.coarse, args.seeds), (args.fine, args.seeds)]
        best, report = search.run(*kinds, **({"trials": (calibration.QUICK_TRIALS, 0)} if args.quick else {}))
    write_json(work / "report.json", {**report, "wall_s": time.monotonic() - began})
    c, angle = report["found"][:2]
    known = report["uncertainty_95"]
    measured = section.Envelope(*map(float, (c, angle)))
    told = (
        f"c = {1e-3 * c:.1f} ± {1e-3 * c * known['cohesion_rel']:.1f} kPa",
        f"φ = {angle:.2f} ± {known['friction_deg']:.1f}°",
    )
    samples = f"{known['samples']} sample{'s' if known['samples'] > 1 else ''} of {known['disks']} disks"
    materials.save(
        dataclasses.replace(best, envelope=measured),
        path,
        f"Calibrated by scripts/calibrate.py{' --quick' if args.quick else ''} for c = {1e-3 * args.cohesion:g} kPa, φ = {args.friction:g}°.\n"
        f"{samples[0].upper()}{samples[1:]} gave {told[0]}, {told[1]} (95 %, from the scatter of such samples).",
    )
    print(
        f"{path}: {told[0]} (wanted {1e-3 * args.cohesion:g}), {told[1]} (wanted {args.friction:g}), 95 % from the scatter of {samples}; report: {work}/report.json"
    )
    if args.quick:
        print("a quick search; without --quick samples are larger, and the report says how unique the answer is")
        if args.coarse < calibration.QUICK:
            print(
                f"samples of fewer than {calibration.QUICK} disks have less cohesion and more scatter than that: take --coarse {calibration.QUICK} or more"
            )
    else:
        errors = ", ".join(f"{name} to {100 * error:.0f} %" for name, error in report["parameter_error_rel"].items())
        print(
            f"{report['given']}. With strengths known to {100 * calibration.SCALE:g} % and {calibration.DEGREES:g}°: {errors}"
        )
    if not report["reached"]:
        print(
            f"NOT REACHED: the best trial misses the wanted strengths by up to {max(map(abs, report['misfit_in_tolerances'])):.1f} times the tolerance of "
            f"{100 * calibration.SCALE:g} % and {calibration.DEGREES:g}°; try another --start, or strengths that belong together",
            file=sys.stderr,
        )


commands.run(main, "what has ended is kept, go on with --resume")
