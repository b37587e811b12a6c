"""The problems in a file of tests/data that Siconos has answered, one by one: they lie side by side, each ending with its
floor, the one body that cannot move.
"""
from dataclasses import replace
from pathlib import Path

import numpy as np

DATA = Path(__file__).resolve().parents[1] / "data"
OF_BODIES = ("inverse_mass", "inverse_inertia", "free_velocity", "velocity", "position")


def cluster(contact, name, number):
    """One of them, with Siconos's answer in it. ``contact``: the package's module of that name, with YADE or without."""
    kept = contact.load(DATA / name)
    ends = np.concatenate([[0], np.flatnonzero(~kept.inverse_mass.any(axis=1)) + 1])
    bodies = slice(ends[number], ends[number + 1])
    contacts = (kept.body[:, 0] >= bodies.start) & (kept.body[:, 0] < bodies.stop)
    chosen = {
        key: value[bodies if key in OF_BODIES else contacts]
        for key, value in vars(kept).items()
        if key != "time_step" and value is not None
    }
    return replace(kept, **{**chosen, "body": chosen["body"] - np.int32(bodies.start)})
