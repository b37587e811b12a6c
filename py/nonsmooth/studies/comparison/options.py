"""What scripts/compare_hard_soft.py takes on its command line, what of it applies to which experiment, and the
defaults.

Options that do not apply are refused before anything is computed, so their parsers leave None: what was given can be
told from what was not.
"""

from __future__ import annotations

import argparse
import math
import os

from ...commands import arguments
from ...world.soft import MODELS
from ..laboratory.biaxial_test import BiaxialTest
from ..spheres.column import RoundColumn
from ..spheres.triaxial import TriaxialTest
from . import cost, course
from .cases import CaseError

__all__ = ["APPLIES", "DEFAULTS", "read", "scenario_options"]

#: Of each scenario, beside what all take: what its Case.options hold.
SCENARIO_OPTIONS = {
    "slope": ("end",),
    "biaxial": ("confining", "strain", "sides", "platens"),
    "column": ("aspect", "friction", "base"),
    "pile": ("aspect", "friction", "base"),
    "round-column": ("size", "aspect", "friction"),
    "triaxial": ("size", "friction", "confining", "strain"),
}
_ALL = ("stiffness", "ensemble_stiffness", "seeds", "damping", "step_share", "without")
_OWN = {
    "slope": ("disks", "model", "source", "bonds", "damping_moving"),
    "biaxial": ("disks", "model", "source", "bonds"),
    "column": ("disks", "model", "damping_moving"),
    "pile": ("disks", "model", "damping_moving"),
    "round-column": (),
    "triaxial": (),
}
#: Options that apply, by scenario and for "cost"; --out, --threads and --resume do to all.
APPLIES = {name: (*_ALL, *_OWN[name], *SCENARIO_OPTIONS[name]) for name in SCENARIO_OPTIONS} | {
    "cost": ("disks", "stiffness", "source", "model", "damping", "damping_moving", "step_share", "steps")
}
#: Those of options that apply and are not given; of the others the scenario's, or --cost's.
DEFAULTS = {
    "seeds": [1, 2, 3, 4, 5],
    "model": "cohesion_moment",
    "bonds": "ductile",
    "damping": 0.2,
    "damping_moving": 0.02,
    "step_share": 0.8,
    "without": [],
    "steps": 300,
}


def _stiffnesses(text):
    """Young's moduli [Pa], with commas."""
    try:
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r}: give Young's moduli [Pa] with commas, as 1e8,1e9,1e10") from None


def _parser(about):
    parser = argparse.ArgumentParser(prog="compare_hard_soft.py", description=about)
    add, usual = parser.add_argument, DEFAULTS
    add("--scenario", choices=tuple(course.SCENARIOS), default="slope", help="the experiment (default: %(default)s)")
    add(
        "--source",
        metavar="NAME|FILE",
        help="section of the slope, or material of the biaxial test, instead of the scenario's own",
    )
    add(
        "--disks",
        type=int,
        metavar="N",
        help=f"about so many disks, not of spheres, see --size (default: the scenario's; with --cost {cost.DISKS})",
    )
    add(
        "--stiffness",
        type=_stiffnesses,
        metavar="PA,…",
        help="Young's moduli [Pa] (default: the scenario's, three decades)",
    )
    add(
        "--ensemble-stiffness",
        type=arguments.positive,
        metavar="PA",
        help="the one that runs with every seed (default: the scenario's, or the upper middle one of --stiffness); others run with the first",
    )
    add(
        "--seeds",
        type=int,
        nargs="+",
        metavar="S",
        help=f"seeds of the packings (default: {' '.join(map(str, usual['seeds']))})",
    )
    add("--model", choices=MODELS, help=f"YADE's law (default: {usual['model']})")
    add(
        "--bonds",
        choices=("ductile", "fragile"),
        help="slope, biaxial: of soft runs with cohesion_moment: yielding before they break, as in the hard law, "
        f"or breaking at once (default: {usual['bonds']})",
    )
    add(
        "--damping",
        type=float,
        metavar="L",
        help=f"of soft runs at rest, non-viscous (default: {usual['damping']}, YADE's own)",
    )
    add(
        "--damping-moving",
        type=float,
        metavar="L",
        help=f"while the mass moves, where it would brake it; not of a biaxial test, not of spheres (default: {usual['damping_moving']})",
    )
    add(
        "--step-share",
        type=arguments.positive,
        metavar="S",
        help=f"time step of soft runs in units of its stability limit (default: {usual['step_share']})",
    )
    add(
        "--without",
        nargs="+",
        choices=course.PARTS,
        metavar="PART",
        help="leave out: numerics (hard runs of other steps and tolerances but for the finest, which errors are measured against), damping, bonds (one soft run each)",
    )
    add(
        "--cost",
        action="store_true",
        help=f"instead, time steps of the paper's slope ({cost.DISKS} disks) in both worlds on all threads, one process after the "
        "other",
    )
    add("--steps", type=int, metavar="N", help=f"with --cost: steps that are timed (default: {usual['steps']})")
    add("--end", type=arguments.positive, metavar="SECONDS", help="slope: simulated time after settling, at most")
    add(
        "--size",
        type=arguments.positive,
        metavar="N",
        help=f"round-column, triaxial: radius of the column, edge of the sample, in mean diameters (default: {RoundColumn.size:g}, {TriaxialTest.size:g})",
    )
    add(
        "--confining",
        type=arguments.positive,
        metavar="MPA",
        help=f"biaxial, triaxial: confining pressure [MPa] (default: 1, {1e-6 * TriaxialTest.pressure:g})",
    )
    add(
        "--strain",
        type=arguments.positive,
        help=f"biaxial, triaxial: axial strain at the end (default: 0.06, {TriaxialTest.strain:g})",
    )
    add("--sides", choices=("rigid", "flexible"), help=f"biaxial: lateral boundaries (default: {BiaxialTest.sides})")
    add(
        "--platens",
        choices=("smooth", "rough"),
        help=f"biaxial: friction of the platens (default: {BiaxialTest.platens})",
    )
    add(
        "--aspect",
        type=arguments.positive,
        help="column, pile, round-column: height over width (pile: over half of it; round-column: over the radius)",
    )
    add("--friction", type=float, metavar="MU", help="column, pile, round-column, triaxial: friction of contacts")
    add("--base", choices=("smooth", "rough"), help="column, pile: the floor")
    add("--out", default="out/compare", metavar="DIR", help="folder for the results (default: %(default)s)")
    add(
        "--threads",
        type=int,
        default=os.cpu_count(),
        metavar="T",
        help="runs at a time, each on one thread; with --cost, of each process (default: all cores)",
    )
    add("--resume", action="store_true", help="keep runs in DIR that have ended")
    return parser


def read(about, words=None):
    """The arguments (``words``, default: the command's) with the defaults put in; those that do not apply are None.

    Raises CaseError for options that do not apply and for numbers that cannot be used.
    """
    args = _parser(about).parse_args(words)
    if args.cost and args.scenario != "slope":
        raise CaseError(f"--cost with --scenario {args.scenario}: it is measured on the slope; leave --scenario out")
    subject = "cost" if args.cost else args.scenario
    every = dict.fromkeys(name for names in APPLIES.values() for name in names)
    idle = [name for name in every if getattr(args, name) is not None and name not in APPLIES[subject]]
    if idle:
        raise CaseError(
            f"{', '.join(f'{_flag(n)} {_plain(getattr(args, n))}' for n in idle)} with {'--cost' if args.cost else '--scenario ' + subject}: "
            f"that does not apply there; leave it out, or take {', '.join(map(_flag, APPLIES[subject]))}"
        )
    for name in every:
        values = getattr(args, name)
        for value in values if isinstance(values, list) else [values]:
            if isinstance(value, float) and not math.isfinite(value):
                raise CaseError(f"{_flag(name)} {_plain(values)}: give a finite number")
    for name, least in (("disks", 1), ("threads", 1), ("steps", cost.LOOKS)):
        value = getattr(args, name)
        if value is not None and value < least:
            raise CaseError(f"{_flag(name)} {value}: give {least} or more")
    if args.bonds is not None and args.model not in (None, "cohesion_moment"):
        has = "breaks bonds at once and has no others" if args.model == "jcfpm" else "has no bonds"
        raise CaseError(
            f"--bonds {args.bonds} with --model {args.model}: that model {has}; leave --bonds out, or take --model cohesion_moment"
        )
    for name in APPLIES[subject]:
        if getattr(args, name) is None:
            setattr(args, name, DEFAULTS.get(name))
    return args


def scenario_options(args):
    """Case.options of the arguments: {name: value}, pressures in Pa; what was not given is left out."""
    given = {name: getattr(args, name) for name in SCENARIO_OPTIONS[args.scenario] if getattr(args, name) is not None}
    return given | ({"confining": 1e6 * given["confining"]} if "confining" in given else {})


def _flag(name):
    return "--" + name.replace("_", "-")


def _plain(value):
    if isinstance(value, list):
        return ("," if isinstance(value[0], float) else " ").join(map(_plain, value))
    return f"{value:g}" if isinstance(value, float) else str(value)
