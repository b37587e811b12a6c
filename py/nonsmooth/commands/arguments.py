"""What the laboratory's scripts share on the command line: types of arguments, and the progress bar."""

from __future__ import annotations

import argparse
import contextlib
import os
import sys

__all__ = [
    "EachOnce",
    "add_disks",
    "add_material",
    "add_out",
    "add_runs",
    "add_sample",
    "add_seeds",
    "add_threads",
    "bar",
    "positive",
    "pressures",
]


def pressures(least=1):
    """Type of a list of ``least`` or more different pressures, as "0.5,1,2"."""

    def read(text):
        try:
            values = [float(part) for part in text.split(",")]
        except ValueError:
            raise argparse.ArgumentTypeError(f"{text!r}: give pressures in MPa, separated by commas") from None
        if not all(v > 0 for v in values) or len(set(values)) < max(least, len(values)):
            raise argparse.ArgumentTypeError(
                f"{text!r}: give {'' if least < 2 else f'{least} or more '}positive pressures, each once"
            )
        return values

    return read


class EachOnce(argparse.Action):
    """Action of an option that takes several values, as seeds: a value that stands twice would be run once, and counted
    twice or not at all.
    """

    def __call__(self, parser, namespace, values, option_string=None):
        if len(set(values)) < len(values):
            raise argparse.ArgumentError(self, f"{' '.join(map(str, values))}: give each once")
        setattr(namespace, self.dest, values)


def positive(text):
    """Type of a number above 0."""
    try:
        value = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is no number") from None
    if not value > 0:
        raise argparse.ArgumentTypeError(f"{text}: it must be positive")
    return value


def each_once(text, read):
    """Values with commas between them, each made by ``read``. Raises ArgumentTypeError where one is given twice, and
    what ``read`` raises.
    """
    values = [read(part) for part in text.split(",")]
    if len(set(values)) < len(values):
        raise argparse.ArgumentTypeError(f"{text!r}: give each number once")
    return values


def add_world(parser, path, tolerance, fall):
    """Adds --world and what the rigid one alone has: --path and --tolerance, whose usual values are given; ``fall``: at
    whose speed a path is counted, in words.
    """
    parser.add_argument("--world", choices=("hard", "soft"), default="hard", help="contacts (default: hard)")
    parser.add_argument(
        "--path",
        type=positive,
        metavar="D",
        help=f"hard: time step, as mean diameters at the speed of {fall} (default: {path:g})",
    )
    parser.add_argument(
        "--tolerance", type=positive, metavar="R", help=f"hard: residual of a step (default: {tolerance:g})"
    )


def add_out(parser, out, what="the results"):
    """Adds --out, the folder for ``what``, in words; ``out``: the usual one."""
    parser.add_argument(
        "--out", type=_folder, default=out, metavar="DIR", help=f"folder for {what} (default: %(default)s)"
    )


def _folder(text):
    """A path that is given, and not an empty variable of a shell."""
    if not str(text).strip():
        raise argparse.ArgumentTypeError("it is empty: give a folder, . for this one")
    return text


def add_threads(parser, what, type=int):
    """Adds --threads; ``what``: of which there are so many, in words."""
    parser.add_argument(
        "--threads", type=type, default=os.cpu_count(), metavar="T", help=f"{what} (default: all cores)"
    )


def add_disks(parser, usual, what):
    """Adds --disks, ``what`` in words; ``usual``: their number where none is given."""
    parser.add_argument("--disks", type=int, default=usual, metavar="N", help=f"{what} (default: %(default)s)")


def add_material(parser):
    """--material of a sample: the paper's rock, or a file."""
    parser.add_argument(
        "--material",
        default="wwr",
        metavar="NAME|FILE",
        help="wwr, the paper's weakly weathered rock (default), or a material file",
    )


def add_sample(parser):
    """--diameter, --fraction, --aspect of a sample of the laboratory."""
    parser.add_argument(
        "--diameter",
        type=positive,
        nargs=2,
        default=(1.0, 4.0),
        metavar=("MIN", "MAX"),
        help="diameters [m] (default: 1 4)",
    )
    parser.add_argument(
        "--fraction",
        type=positive,
        default=0.848,
        help="packing fraction that the sample is made with (default: %(default)s)",
    )
    parser.add_argument("--aspect", type=positive, default=2.0, help="height over width (default: %(default)s)")


def add_seeds(parser, usual, what):
    """Adds --seeds, each once; ``what``: the help in words; ``usual``: a list, None where the command chooses them."""
    parser.add_argument("--seeds", type=int, nargs="+", action=EachOnce, default=usual, metavar="S", help=what)


def add_runs(parser, out, what):
    """Adds what commands that run many things side by side share.

    ``out``: their usual folder; ``what``: the things, as "tests".
    """
    add_out(parser, out)
    add_threads(parser, f"{what} at a time")
    parser.add_argument(
        "--resume", action="store_true", help=f"keep {what} in DIR that have ended, and go on with others"
    )


@contextlib.contextmanager
def bar():
    """A progress bar; gives a function to call with the share done and what is being done, in words."""
    from tqdm import tqdm

    from . import closing

    # a file gets a line every half a minute
    with closing(
        tqdm(
            total=1000,
            mininterval=0.5 if sys.stderr.isatty() else 30,
            bar_format="{desc} {percentage:3.0f}%|{bar}| {elapsed} gone, about {remaining} left",
        )
    ) as shown:

        def progress(share, doing):
            shown.set_description_str(doing, refresh=False)
            shown.update(int(1000 * share) - shown.n)

        yield progress
