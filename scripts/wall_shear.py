#!/usr/bin/env python3
"""Sliding tests of a packing on a wall (Taboada and Estrada 2009, section 3.3): friction and cohesion of DP, FB and SS
in Table 1.

  scripts/wall_shear.py [--material NAME|FILE …] [--pressures MPA,MPA,…] [--seeds S …] [--out DIR] [--threads T] [--resume]
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

import argparse
import dataclasses
from pathlib import Path

from yade.nonsmooth import commands, errors, records
from yade.nonsmooth.commands import arguments
from yade.nonsmooth.figures import wall_shear as figures
from yade.nonsmooth.laboratory import materials, wall_shear
from yade.nonsmooth.system import output_folder
from yade.nonsmooth.system.whole_files import write_json


def read_arguments():
    parser = argparse.ArgumentParser(prog="wall_shear.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument(
        "--material",
        nargs="+",
        default=["dp", "fb", "ss"],
        metavar="NAME|FILE",
        help="of the wall: dp, fb, ss, wwr or a material file (default: dp fb ss)",
    )
    parser.add_argument(
        "--bonded",
        action="store_true",
        help="bond the block to the wall in any case; dp and ss are shipped without bonds",
    )
    parser.add_argument(
        "--tensile-strength", type=float, metavar="KPA", help="of these bonds, instead of the material's [kPa]"
    )
    parser.add_argument(
        "--pressures",
        type=arguments.pressures(2),
        default=[0.25, 0.5, 1, 2],
        metavar="MPA,…",
        help="normal stresses [MPa] (default: 0.25,0.5,1,2)",
    )
    arguments.add_seeds(parser, [1, 2], "seeds of the packings (default: 1 2)")
    arguments.add_runs(parser, "out/wall_shear", "slides")
    return parser.parse_args()


def main():
    args = read_arguments()
    out = Path(args.out)
    chosen = []
    for name in args.material:
        m = materials.load(name)
        if args.bonded:
            m = dataclasses.replace(m, bonded=True)
        if args.tensile_strength is not None:
            m = dataclasses.replace(m, tensile_strength=1e3 * args.tensile_strength)
        if m.bonded and not m.tensile_strength > 0:
            raise errors.UserError(
                f"--bonded with {name}: its tensile strength is 0, so such bonds bear nothing; add --tensile-strength KPA"
            )
        chosen.append(m)
    output_folder.claim(out, "wall_shear.py", args.resume)
    groups = [[wall_shear.SlideTest(m, 1e6 * p, seed) for p in args.pressures] for m in chosen for seed in args.seeds]
    with arguments.bar() as progress:
        slides = wall_shear.run([t for group in groups for t in group], out, args.threads, args.resume, progress)
    n = len(args.pressures)
    found = [wall_shear.strength_of(group, slides[k * n : (k + 1) * n]) for k, group in enumerate(groups)]
    write_json(out / "summary.json", {"tests": found})
    print(
        "wall       seed   peak: friction  φ [°]   cohesion [kPa]   residual: friction  φ [°]   cohesion [kPa]   covered"
    )
    for f in found:
        print(
            f"{f['material']:10s} {f['seed']:4d} {f['friction_peak']:16.3f} {f['friction_peak_deg']:6.1f} {f['cohesion_peak_kPa']:16.1f} {f['friction_residual']:20.3f} "
            f"{f['friction_residual_deg']:6.1f} {f['cohesion_residual_kPa']:16.1f} {f['coverage']:9.2f}"
        )
    series = {t.name: records.read_series(out / "tests" / t.name / "series.csv") for group in groups for t in group}
    made = figures.slides(
        [(f, [series[t.name] for t in group]) for group, f in zip(groups, found)], out / "wall_shear.png"
    )
    print(f"results: {out}/summary.json, tests/*/series.csv, {made}")


commands.run(main, "what has ended is kept, go on with --resume")
