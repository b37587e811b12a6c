"""Types of arguments that the laboratory's scripts share, for argparse."""

from __future__ import annotations

import argparse


def pressures(least=1):
    """Type of a list of ``least`` or more different pressures, as "0.5,1,2"."""

    def read(text):
        try:
            values = [float(part) for part in text.split(",")]
        except ValueError:
            raise argparse.ArgumentTypeError(f"{text!r}: give pressures in MPa, separated by commas") from None
        if not all(v > 0 for v in values) or len(set(values)) < max(least, len(values)):
            raise argparse.ArgumentTypeError(f"{text!r}: give {'' if least < 2 else f'{least} or more '}positive pressures, each once")
        return values

    return read


def positive(text):
    """Type of a number above 0."""
    try:
        value = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is no number") from None
    if not value > 0:
        raise argparse.ArgumentTypeError(f"{text}: it must be positive")
    return value
