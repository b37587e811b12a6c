"""Which of the two worlds a study's arguments ask for: values of the other one are refused by name. Needs no YADE."""

from __future__ import annotations

from ..system import checks

__all__ = ["check_choice"]


def check_choice(name, rigid, soft, known, grains, error):
    """Checks the arguments of a world. ``name``: "hard" or "soft"; ``rigid``: {key: value} of the hard one, numbers
    above 0, without those that are left out; ``soft``: the same of the soft one, of which ``known`` are the keys;
    ``grains``: what the worlds are of, in words.

    Raises ``error`` with one message that names keys and values, and what would do.
    """
    for key, value in rigid.items():
        checks.number(key, value, error, "give a number above 0", above=0)
    if name not in ("hard", "soft"):
        raise error(f"world {checks.shown(name)}: give hard or soft")
    why, foreign, other = (
        (f"rigid {grains} have no such value", soft, "soft")
        if name == "hard"
        else ("springs have no such value, their step is step_share of its limit", rigid, "hard")
    )
    if foreign:
        told = ", ".join(f"{key} {checks.shown(value)}" for key, value in foreign.items())
        raise error(f"{told} with world {name!r}: {why}; leave it out, or take world {other!r}")
    unknown = [key for key in soft if key not in known]
    if unknown:
        raise error(f"{', '.join(unknown)}: no value of the soft world; give some of {', '.join(known)}")
    if name == "soft":
        remedy = "the soft world needs Young's modulus in Pa, above 0"
        checks.number("stiffness", soft.get("stiffness"), error, remedy, above=0)
