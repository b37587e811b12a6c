#!/usr/bin/env python3
"""Spheres in space: round columns that collapse, hoppers, drums that turn, piles on a plate and triaxial tests, with hard
or with soft contacts.

scripts/spheres.py column|hopper|drum|pile|triaxial [options of the scene] [--seeds S …] [--world hard|soft] [--out DIR]
[--threads T] [--resume] scripts/spheres.py column --aspect 0.5,1,2 --size 6 scripts/spheres.py hopper --opening 5,6,7
--seeds 1 2 3
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

import argparse
import itertools
from dataclasses import fields
from pathlib import Path

from yade.nonsmooth import commands
from yade.nonsmooth.commands import arguments
from yade.nonsmooth.studies.spheres import grains, report, study, triaxial
from yade.nonsmooth.system import output_folder
from yade.nonsmooth.system.whole_files import write_json
from yade.nonsmooth.world import sphere_worlds as worlds

HELP = {
    "diameter": ("M", "mean diameter by number [m]"),
    "size_spread": ("K", "largest over smallest diameter"),
    "density": ("RHO", "of the spheres [kg/m³]"),
    "friction": ("MU,…", "of all contacts"),
    "rolling_friction": ("MU,…", "in units of the sum of the radii, at a wall of the diameter"),
    "twisting_friction": ("MU,…", "in the same units"),
    "restitution": ("E", "of impacts; the soft world has none but what --damping leaves, and refuses another than 0"),
    "gravity": ("G", "[m/s²]"),
    "aspect": ("A,…", "height over radius of what rests in the tube"),
    "size": ("N,…", "radius of the container, of a triaxial test the edge of its sample, in mean diameters"),
    "opening": ("N,…", "diameter of the opening in mean diameters"),
    "length": ("N", "length of the drum in mean diameters"),
    "filling": ("F,…", "share of the drum that is filled"),
    "froude": ("FR,…", "Froude number ω² R/g"),
    "turns": ("N", "how often the drum turns; the second half counts"),
    "pressure": ("PA,…", "σ₃, which the sides bear [Pa]"),
    "strain": ("E", "axial strain at the end; the last third counts for the critical state"),
    "inertia": ("I,…", "inertial number, the rate of strain in units of √(σ₃/ρ)/d"),
    "friction_share": ("S,…", "share of the friction while the sample is made: 1 loose, 0 dense"),
}
SOFT = {
    "stiffness": ("PA", arguments.positive, "Young's modulus [Pa], which has no default"),
    "damping": ("L", float, f"YADE's damping of forces (default: {worlds.SoftSpheres.damping:g})"),
    "step_share": (
        "S",
        arguments.positive,
        f"time step in units of its limit (default: {worlds.SoftSpheres.step_share:g})",
    ),
}
WHAT = {
    "column": "a round column on a floor, whose tube is taken away",
    "hopper": "a cylinder with a flat bottom, whose round opening is opened",
    "drum": "a drum that turns about a horizontal axis",
    "pile": "spheres on a round plate, whose tube is taken away: what stays has the angle of repose",
    "triaxial": "spheres between six plates, pressed alike on all sides, then compressed along one axis",
}


def numbers(text):
    """Type of numbers with commas, each once."""
    try:
        return arguments.each_once(text, float)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r}: give numbers, separated by commas") from None


def read_arguments():
    parser = argparse.ArgumentParser(prog="spheres.py", description=__doc__.partition("\n\n")[0])
    kinds = parser.add_subparsers(dest="kind", required=True, metavar="|".join(study.KINDS))
    for name, kind in study.KINDS.items():
        own = kinds.add_parser(name, help=WHAT[name], description=WHAT[name])
        usual = kind()
        for one in fields(kind):
            if one.name != "seed":
                letter, words = HELP[one.name]
                own.add_argument(
                    f"--{one.name.replace('_', '-')}",
                    type=numbers if letter.endswith("…") else float,
                    default=[getattr(usual, one.name)] if letter.endswith("…") else getattr(usual, one.name),
                    metavar=letter,
                    help=f"{words} (default: {getattr(usual, one.name):g})",
                )
        arguments.add_seeds(own, [1], "seeds of sizes and places (default: 1)")
        tested = name == triaxial.TriaxialTest.KIND
        speed = "√(σ₃/ρ)" if tested else "a free fall"
        arguments.add_world(own, grains.PATH_PER_STEP, grains.TOLERANCE, speed)
        own.add_argument(
            "--reach",
            type=arguments.positive,
            metavar="L",
            help=f"hard: gap up to which contacts are known beforehand, as mean diameters (default: {worlds.HardSpheres.reach:g})",
        )
        for key, (letter, kind_of, words) in SOFT.items():
            own.add_argument(f"--{key.replace('_', '-')}", type=kind_of, metavar=letter, help=f"soft: {words}")
        own.set_defaults(duration=None, angle=None)
        if tested:  # and ends at its strain
            words = "tell the friction with which the critical state has this angle, by those of --friction"
            own.add_argument("--angle", type=arguments.positive, metavar="DEG", help=words)
        else:
            own.add_argument(
                "--duration",
                type=arguments.positive,
                metavar="T",
                help="longest course, in units of √(h₀/g), of a drum √(R/g) (default: that of the scene)",
            )
        arguments.add_runs(own, f"out/{name}", "runs")
    return parser.parse_args()


def cases_of(args):
    """{name: (scene, world)} of the runs asked for: all combinations of values and seeds."""
    kind = study.KINDS[args.kind]
    names = [one.name for one in fields(kind) if one.name != "seed"]
    given = {name: getattr(args, name) for name in names}
    many = [name for name, value in given.items() if isinstance(value, list)]
    # those of the other world are handed over too: they are refused by name
    numerics = {
        key: getattr(args, key) for key in ("path", "tolerance", "reach", *SOFT) if getattr(args, key) is not None
    }
    world = {"name": args.world, **numerics}
    cases = {}
    for chosen in itertools.product(*(given[name] for name in many), args.seeds):
        values = dict(zip(many, chosen))
        told = [f"{name.replace('_', '-')}{values[name]:g}" for name in many if len(given[name]) > 1]
        label = "-".join([*told, f"seed{chosen[-1]}"])
        cases[label] = (kind(**{**given, **values, "seed": chosen[-1]}), world)
    return cases


def main():
    args = read_arguments()
    out = Path(args.out)
    cases = cases_of(args)
    for name, (scene, world) in cases.items():  # before anything is computed
        study.planned(name, out / name, scene, world, args.duration)
    output_folder.claim(out, "spheres.py", args.resume)
    words = f"{len(cases)} run{'s' if len(cases) > 1 else ''}"
    with arguments.bar() as progress:
        found = study.run(cases, out, args.threads, args.resume, args.duration, lambda share: progress(share, words))
    summary = report.summarise(found)
    if args.angle is not None:
        summary["calibration"] = report.calibrated(summary, args.angle)
    write_json(out / "summary.json", summary)
    print(report.table(summary))
    drawn = report.draw(summary, out)
    print(f"results: {out}/summary.json, {', '.join(str(p) for p in drawn[-3:])}{' …' if len(drawn) > 3 else ''}")


commands.run(main, "what has ended is kept, go on with --resume")
