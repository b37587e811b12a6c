"""The arguments that say which section a command is for, and what is changed in it. Needs no YADE."""

from __future__ import annotations

import argparse
import dataclasses
import sys

import yaml

from ..model import materials, section
from ..model.section import reader, similar

__all__ = ["add", "add_over", "number", "read", "seconds", "threads", "varied"]


def number(kind, low, high, what):
    """A reader for argparse: a number of the ``kind`` from ``low`` to ``high``, or a message that says what is
    needed.
    """

    def read(text):
        try:
            value = kind(text)
        except ValueError:
            value = None
        if value is None or not low <= value <= high:  # a NaN is not
            raise argparse.ArgumentTypeError(f"{text[:40]!r} is not allowed; give {what}")
        return value

    return read


seconds = number(float, 1e-9, 1e9, "seconds above 0, at most 1e9")
threads = number(int, 1, 1024, "a whole number from 1 to 1024")


def varied(text):
    """A reader for argparse: KEY=V,V,… as (key, values)."""
    key, sign, values = text.partition("=")
    try:
        found = reader.values(values)
    except yaml.YAMLError:
        found = None
    if not sign or not key or not found:
        raise argparse.ArgumentTypeError(f"{text[:60]!r}: give KEY=VALUE,VALUE,…, as seed=1,2,3")
    return key, found


def add_over(parser, example):
    """Adds --over, which names keys of the section file and their values; ``example``: of such words, for its help."""
    parser.add_argument(
        "--over",
        action="append",
        default=[],
        type=varied,
        metavar="KEY=V,V,…",
        help=f"values of a key of the section file, as {example}; several: all combinations",
    )


def add(parser, default=None, needless=()):
    """Adds them to an argparse parser; ``default``: the section where none is given, which is an error without it
    unless one of the words ``needless`` is there.
    """
    parser.add_argument(
        "--section",
        default=default,
        required=default is None and not set(needless) & set(sys.argv),
        metavar="NAME|FILE",
        help="a section file, or the name of a shipped one",
    )
    parser.add_argument("--mirror", action="store_true", help="the section with left and right exchanged")
    parser.add_argument(
        "--size",
        type=number(float, *similar.FACTORS, f"a factor from {similar.FACTORS[0]:g} to {similar.FACTORS[1]:g}"),
        metavar="S",
        help="the section S times as large, with times and strengths so that it does the same (Froude)",
    )
    parser.add_argument(
        "--rock",
        metavar="NAME|FILE",
        help="material of the layers instead of the section's: a material file, as calibrate.py writes it, or wwr, the paper's rock; with --size its strengths are those at the new size",
    )
    parser.add_argument(
        "--disks",
        type=number(int, 1, section.MOST_DISKS, f"a whole number from 1 to {section.MOST_DISKS}"),
        metavar="N",
        help="about N disks instead of the section's: all diameters are scaled",
    )
    parser.add_argument(
        "--seed",
        type=number(int, 0, 10**12, "a whole number from 0 to 1e12"),
        metavar="S",
        help="seed of the packing instead of the section's",
    )
    parser.add_argument(
        "--water",
        metavar="RATE",
        type=number(float, 0, 1e6, "m/s from 0 to 1e6"),
        help="rate at which the table rises [m/s] instead of the section's; 0: dry",
    )
    parser.add_argument(
        "--critical-slip",
        metavar="METRES",
        type=number(float, 1e-9, 1e9, "m from 1e-9 to 1e9"),
        help="critical distance D_c [m] instead of the section's: of slip on all slip surfaces that weaken, and of the release from water",
    )


def read(args) -> section.Section:
    """The Section that they ask for. Raises SectionError."""
    s = section.load(args.section)
    if args.size is not None:
        s = similar.scaled(s, args.size)
    if args.disks is not None:
        s = s.with_disks(args.disks)
    if args.mirror:  # last: areas of a mirrored outline differ in their last digits, and diameters would
        s = similar.mirrored(s)
    if args.rock is not None:
        s = s.with_rock(materials.data(args.rock, "--rock"))
    if args.seed is not None:
        s = dataclasses.replace(s, seed=args.seed)
    if args.water and s.water is None:
        raise section.SectionError(
            f"--water {args.water:g}: {s.source} has no water; add the key `water` to it, or leave --water out"
        )
    if args.water is not None and s.water_field is not None:
        raise section.SectionError(
            f"--water {args.water:g}: {s.source} has no water table that could rise, but a field of water; leave "
            "--water out"
        )
    if args.water is not None and s.water is not None:
        s = s.with_values({"water.table": {"rate": args.water}})
    if args.critical_slip is not None:
        s = s.with_critical_slip(args.critical_slip)
    return s
