"""Named parameter sets of slip laws (``parameter_sets.yaml``), each value with its source, and whether it is fitted
or a guess.
"""

from __future__ import annotations

import functools
from pathlib import Path

import numpy as np
import yaml

from ..system import checks
from .laws import SlipError, SlipLaw

__all__ = ["FORMS", "GROUNDS", "by_slip", "by_velocity", "law", "known", "values"]

#: What a value may rest on.
GROUNDS = ("source", "fitted", "guess")
_POINTS = 121


def by_velocity(static, dynamic, velocity):
    """Table of f = f_w + (f₀ − f_w)/(1 + V/V_w), ``static``, ``dynamic`` [-] and ``velocity`` V_w [m/s]: what a
    tabulated law takes. Between its points it is within 1e-3 of f₀ − f_w. Raises SlipError for a velocity that is not
    positive.
    """
    checks.number("velocity", velocity, SlipError, "give m/s above 0", above=0)
    speeds = velocity * np.logspace(-3, 3, _POINTS)
    return dict(slips=[0.0], velocities=speeds, friction_table=dynamic + (static - dynamic) / (1 + speeds / velocity))


def by_slip(static, distance, exponent):
    """Table of f = f₀ (1 + δ/d_c)^n, ``static`` [-], ``distance`` d_c [m] and ``exponent`` n, to 1,000 d_c: what a
    tabulated law takes. Between its points it is within 1e-3 of f₀. Raises SlipError for a distance that is not
    positive.
    """
    checks.number("distance", distance, SlipError, "give metres above 0", above=0)
    slips = distance * np.r_[0.0, np.logspace(-2, 3, _POINTS - 1)]
    return dict(slips=slips, velocities=[1.0], friction_table=static * (1 + slips / distance) ** exponent)


#: Tables that are written as a formula.
FORMS = {"velocity": by_velocity, "slip": by_slip}


@functools.cache
def _sets():
    return yaml.safe_load((Path(__file__).parent / "parameter_sets.yaml").read_text())


def known():
    """The sets' names, and each in a sentence: {name: sentence}."""
    return {name: " ".join(one["about"].split()) for name, one in _sets().items()}


def _set(name):
    if name not in _sets():
        raise SlipError(f"parameter set {checks.shown(name)}: it must be one of {', '.join(_sets())}")
    one = _sets()[name]
    if "like" not in one:
        return one
    base = _set(one["like"])
    return {**base, **one, "values": {**base["values"], **one["values"]}}


def values(name):
    """Of a set, where each value comes from: {key: (value, one of :data:`GROUNDS`, why)}; that of a form is its name.

    Raises SlipError for an unknown name.
    """
    one = _set(name)
    form = one.get("form", {})
    grounds = {"form": (form["name"], form)} if form else {}
    told = {key: (given["value"], given) for key, given in one["values"].items()} | grounds
    return {
        key: (value, *next((ground, given[ground]) for ground in GROUNDS if ground in given))
        for key, (value, given) in told.items()
    }


def law(name, **changed):
    """The :class:`.laws.SlipLaw` of a set, with some values ``changed``. Raises SlipError for an unknown name or key,
    or values that do not fit.
    """
    one = _set(name)
    given = {key: value["value"] for key, value in one["values"].items()}
    if "form" in one:
        form = {key: value for key, value in one["form"].items() if key not in ("name", *GROUNDS)}
        given |= FORMS[one["form"]["name"]](**form)
    return SlipLaw(one["law"], **{**given, **changed})
