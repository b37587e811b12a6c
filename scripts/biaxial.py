#!/usr/bin/env python3
"""Biaxial tests of a granular rock (Taboada and Estrada 2009, section 5.2): strength, envelope, shear bands.

  scripts/biaxial.py [--material NAME|FILE] [--confining MPA,MPA,…] [--disks N] [--out DIR] [--threads T] [--seeds S …] [--resume]
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

import argparse
import dataclasses
import time
from pathlib import Path

from yade.nonsmooth import commands
from yade.nonsmooth.commands import arguments
from yade.nonsmooth.laboratory import biaxial, campaign, materials, pressing, report
from yade.nonsmooth.measure import strength
from yade.nonsmooth.system import output_folder
from yade.nonsmooth.system.whole_files import write_json

CYCLE_STRAIN = (
    0.03  # at the end, in which --cycle looks: some cycles, and the forces of no more than 300 rows on the disk
)


def read_arguments():
    parser = argparse.ArgumentParser(prog="biaxial.py", description=__doc__.partition("\n\n")[0])
    arguments.add_material(parser)
    parser.add_argument(
        "--confining",
        type=arguments.pressures(),
        default=[0.25, 0.5, 1, 2, 4, 8, 16],
        metavar="MPA,…",
        help="confining pressures [MPa] (default: 0.25 to 16)",
    )
    arguments.add_disks(parser, 5000, "disks of the sample")
    arguments.add_sample(parser)
    arguments.add_seeds(parser, [1], "seeds of the packings; several give confidence intervals")
    parser.add_argument(
        "--platens",
        choices=("smooth", "rough", "glued"),
        default=biaxial.BiaxialTest.platens,
        help="friction of the platens (default: %(default)s)",
    )
    parser.add_argument(
        "--sides",
        choices=("rigid", "flexible"),
        default=biaxial.BiaxialTest.sides,
        help="lateral boundaries (default: %(default)s)",
    )
    parser.add_argument(
        "--strain",
        type=arguments.positive,
        default=biaxial.BiaxialTest.strain,
        help="axial strain at the end (default: %(default)s)",
    )
    parser.add_argument(
        "--inertia",
        type=arguments.positive,
        default=biaxial.BiaxialTest.inertia,
        metavar="I",
        help="inertial number of the loading (default: %(default)g)",
    )
    parser.add_argument(
        "--step",
        type=arguments.positive,
        default=biaxial.BiaxialTest.step,
        help="time step in √(m/σ₃) (default: %(default)s)",
    )
    parser.add_argument(
        "--tolerance",
        type=arguments.positive,
        default=biaxial.BiaxialTest.tolerance,
        help="of the solver's residual (default: %(default)g)",
    )
    parser.add_argument(
        "--sample",
        choices=("pressed", "packed"),
        default="pressed",
        help="pressed: press the disks until they carry, then bond them (default); packed: bond them as they were packed, then let the pressure grow",
    )
    parser.add_argument(
        "--pressing-friction",
        type=float,
        metavar="MU",
        help="friction of contacts while a sample is pressed (default: 0)",
    )
    parser.add_argument(
        "--bond-distance",
        type=arguments.positive,
        metavar="L",
        help="largest gap that is bonded, in mean diameters, instead of the material's",
    )
    parser.add_argument(
        "--closing-bonds",
        action="store_true",
        help="bonds over gaps close freely, also where the material has them as struts",
    )
    parser.add_argument(
        "--cycle",
        action="store_true",
        help="keep the forces before and after the deepest drop of stress in the last part of the plateau, and draw that cycle",
    )
    arguments.add_runs(parser, "out/biaxial", "tests")
    args = parser.parse_args()
    if args.pressing_friction is not None:
        if not args.pressing_friction >= 0:
            parser.error(f"--pressing-friction {args.pressing_friction:g}: it must be 0 or more")
        if args.sample == "packed":
            parser.error(
                f"--pressing-friction {args.pressing_friction:g}: a sample that stays as it was packed has none; leave out --sample packed, or this"
            )
    if args.diameter[0] > args.diameter[1]:
        parser.error(f"--diameter {args.diameter[0]:g} {args.diameter[1]:g}: give the smallest first")
    return args


def main():
    args, began = read_arguments(), time.monotonic()
    material, out = materials.load(args.material), Path(args.out)
    output_folder.claim(out, "biaxial.py", args.resume)
    if args.bond_distance is not None:
        material = dataclasses.replace(material, bond_creation_distance=args.bond_distance)
    if args.closing_bonds:
        material = dataclasses.replace(material, bonds_close=True)
    friction = None if args.sample == "packed" else args.pressing_friction or 0.0
    tests = [
        biaxial.BiaxialTest(
            material,
            1e6 * p,
            pressing.Shape(args.disks, seed, *args.diameter, args.fraction, args.aspect, friction),
            args.strain,
            args.platens,
            args.sides,
            args.inertia,
            args.step,
            args.tolerance,
            forces_from=max(strength.PLATEAU * args.strain, args.strain - CYCLE_STRAIN) if args.cycle else None,
        )
        for seed in args.seeds
        for p in sorted(args.confining)
    ]
    with arguments.bar() as progress:
        measured = campaign.run(tests, out, args.threads, args.resume, progress)
    summary = campaign.summarise(material, measured, time.monotonic() - began, args.threads)
    write_json(out / "summary.json", summary)
    made = report.draw(out, summary)
    print(report.table(summary))
    print(
        f"{summary['wall_s']:.0f} s of wall time; results: {out}/summary.json, tests/*/series.csv, {', '.join(p.name for p in made)}"
    )


commands.run(main, "what has ended is kept, go on with --resume")
