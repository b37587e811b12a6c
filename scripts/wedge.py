#!/usr/bin/env python3
"""The wedge on a joint, hard and soft: runs scripts/examples/hard_wedge.py and soft_wedge.py and draws displacement
against time.

  scripts/wedge.py [--seconds S] [--out DIR] [--resume]
"""
import os, sys

if "yade" not in sys.modules:  # started as it is: hand over to the launcher
    launcher = os.path.join(os.path.dirname(os.path.realpath(__file__)), "yade-nonsmooth")
    os.execv(launcher, [launcher, os.path.realpath(__file__), *sys.argv[1:]])

import argparse
import subprocess
from pathlib import Path

import numpy as np
from tqdm import tqdm
from yade.nonsmooth import commands, errors
from yade.nonsmooth.commands import arguments
from yade.nonsmooth.figures.creep import creep
from yade.nonsmooth.figures.style import LINES
from yade.nonsmooth.measure.creep import rate
from yade.nonsmooth.system import keys, output_folder
from yade.nonsmooth.system.whole_files import write_atomically, write_json

EXAMPLES = Path(sys.argv[0]).resolve().with_name("examples")
# (key, title of the panel, the joint and its water)
CASES = (
    ("dry", "dry, safety factor 1.04", dict(friction=0.60, water=0)),
    ("water", "water rises and falls, safety factor 1.13 to 1.01", dict(friction=0.65, water=0.5)),
)
# (key, label, colour, script, its numerics)
MODELS = (
    ("hard", "Contact Dynamics, steps of 5 ms", LINES["blue"], "hard_wedge.py", {}),
    ("soft", "springs, E = 1 GPa, damping 0.2", LINES["orange"], "soft_wedge.py", {}),
    ("soft_100MPa", "springs, E = 100 MPa, damping 0.2", LINES["purple"], "soft_wedge.py", dict(young=1e8, dt=1e-3)),
    ("soft_damping_0.02", "springs, E = 1 GPa, damping 0.02", LINES["grey"], "soft_wedge.py", dict(damping=0.02)),
)


class WedgeError(errors.UserError):
    """A run of an example failed."""


def read_arguments():
    parser = argparse.ArgumentParser(prog="wedge.py", description=__doc__.partition("\n\n")[0])
    parser.add_argument(
        "--seconds", type=float, default=60, metavar="S", help="simulated time [s] (default: %(default)g)"
    )
    arguments.add_out(parser, "out/wedge")
    parser.add_argument("--resume", action="store_true", help="keep the runs that DIR has already")
    args = parser.parse_args()
    if not 1 <= args.seconds < float("inf"):
        parser.error(f"argument --seconds: {args.seconds:g} is too short to see a creep; give 1 or more")
    return args


def curve(out, key, script, parameters, resume):
    """Arrays t [s], centroid and largest [mm] of a run, kept in ``out``/``key``.txt with what it is of in
    ``key``.key.
    """
    table, kept, part, mark = (out / f"{key}.{end}" for end in ("table", "txt", "part", "key"))
    wanted = "{}\n{}\n".format(
        " ".join([*parameters, "save"]), " ".join([*map(repr, parameters.values()), repr(part.name)])
    )
    made_of = keys.run_key([wanted, (EXAMPLES / script).read_text()])
    if not (resume and kept.exists() and mark.exists() and mark.read_text() == made_of):
        kept.unlink(missing_ok=True)  # before its key is: a kill between them must not pair it with others'
        write_atomically(table, wanted.encode())
        write_atomically(mark, made_of.encode())
        done = subprocess.run(
            [EXAMPLES / script],
            cwd=out,
            env={**os.environ, "YADE_BATCH": f"{table.name}:2"},
            stdin=subprocess.DEVNULL,
            text=True,
            capture_output=True,
        )
        if done.returncode:
            raise WedgeError(f"{script} with {table}: ended with status {done.returncode}: {done.stderr[-500:]}")
        os.replace(part, kept)
    found = np.genfromtxt(kept, names=True)
    # O.run may lose an engine's refusal (see yade.nonsmooth.world.stepping), and the script then ends as if nothing
    # were wrong
    if not found["t"].size or found["t"].max() < parameters["seconds"] - 0.2:
        raise WedgeError(
            f"{kept}: the run ended before {parameters['seconds']:g} s; see what {script} says with YADE_BATCH={table}:2, remove the file, and run again"
        )
    return found


def main():
    args = read_arguments()
    out = Path(args.out)
    output_folder.claim(out, "wedge.py", args.resume)
    panels, rows = [], []
    with commands.closing(tqdm(total=len(CASES) * len(MODELS), unit="run", leave=False)) as bar:
        for case, title, joint in CASES:
            curves = []
            for model, label, colour, script, numerics in MODELS:
                found = curve(
                    out, f"{case}_{model}", script, dict(seconds=args.seconds, **joint, **numerics), args.resume
                )
                rows.append(
                    dict(
                        case=case,
                        model=model,
                        displacement_mm=found["centroid"][-1],
                        largest_mm=found["largest"].max(),
                        creep_mm_per_min=rate(found["t"], found["centroid"], args.seconds),
                    )
                )
                curves.append((label, colour, found["t"], found["centroid"]))
                bar.update()
            panels.append((title, curves))
    creep(panels, out / "wedge.png")
    write_json(out / "summary.json", {"seconds": args.seconds, "runs": rows})
    print("case    model                displacement [mm]   largest of a disk [mm]   creep after 5 s [mm/min]")
    for r in rows:
        print("{case:7s} {model:20s} {displacement_mm:17.4f} {largest_mm:24.4f} {creep_mm_per_min:26.4f}".format(**r))
    print(f"results: {out}/summary.json, wedge.png")


commands.run(main, "what has ended is kept, go on with --resume")
